//! Camera shots as a function of time: those of the script and those of the strongest emotion (GEVH
//! 3.5.4.1), eased from one to the next.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::order::sort_by_number;
use raconteur_eml::{CameraAngle, ClauseKind, ControlSource, ShotKind};
use raconteur_stage::{Angle, Camera, EmotionEnvelope, EmotionTimeline, EmotionType, Shot};

use crate::lower::control_source::{ActiveControl, leaders};
use crate::lower::script::Script;

/// Minimum duration of an emotion's shot, seconds. Designed: an image is read in three to four
/// seconds.
pub(crate) const MIN_SECS: f64 = 4.0;
/// Duration of a camera move between such shots, seconds. Designed.
const MOVE_SECS: f64 = 2.0;
/// Minimum distance change of a cut, in steps. All such shots face the figure from the front, so
/// the line of action is never crossed (180° rule), and they are less than 30° apart: a cut with a
/// smaller change would be a jump cut (30° rule), so the camera moves instead.
const CUT_STEPS: i32 = 2;

/// Camera shot set by a script: size, angle and transition from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShotCue {
    pub(crate) start_secs: f64,
    transition_secs: f64,
    by: ControlSource,
    /// Shot size; `None`: unchanged.
    shot: Option<Shot>,
    /// Angle; `None`: unchanged.
    angle: Option<Angle>,
}

/// Returns the camera shots of a script, sorted by time.
pub(crate) fn shots(script: &Script) -> Vec<ShotCue> {
    let clauses = script.timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &script.document.clause(timed.clause).kind {
            ClauseKind::Camera(camera) => Some(ShotCue {
                start_secs: timed.start_secs,
                transition_secs: camera.transition_secs,
                by: camera.by,
                shot: camera.shot.map(|kind| match kind {
                    ShotKind::ExtremeCloseUp => Shot::ExtremeClose,
                    ShotKind::CloseUp => Shot::Close,
                    ShotKind::Medium => Shot::Medium,
                    ShotKind::Full => Shot::Full,
                    ShotKind::Long => Shot::Long,
                    ShotKind::Storyteller => Shot::Storyteller,
                }),
                angle: camera.angle.map(|angle| match angle {
                    CameraAngle::Eye => Angle::Eye,
                    CameraAngle::High => Angle::High,
                    CameraAngle::Low => Angle::Low,
                }),
            }),
            _ => None,
        })
        .collect()
}

/// Camera shot from a time on, with the end of the transition to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CameraShot {
    pub(crate) start_secs: f64,
    /// End of the transition to it.
    settled_secs: f64,
    pub(crate) shot: Shot,
    pub(crate) angle: Angle,
    /// True if an emotion requests it: it keeps hands in frame, however close it is.
    pub(crate) is_by_emotion: bool,
    /// True if the script sets it.
    pub(crate) is_written: bool,
}

/// Inputs of a performance's shot plan: default shot, script cues, emotions and settings.
pub(crate) struct ShotPlanInput<'a> {
    /// Default shot, at eye height.
    pub(crate) usual: Shot,
    /// Scripted shots.
    pub(crate) cues: Vec<ShotCue>,
    /// Emotions.
    pub(crate) emotions: &'a EmotionTimeline,
    /// True if emotions control the camera unless a script does.
    pub(crate) follows: bool,
    /// True if the camera moves; false if it only cuts.
    pub(crate) moves: bool,
}

/// Camera shots of a performance, sorted by time; at least one.
pub(crate) struct ShotSequence {
    first: CameraShot,
    later: Vec<CameraShot>,
}

impl ShotSequence {
    /// Plans the camera shots of a performance.
    pub(crate) fn new(mut shooting: ShotPlanInput<'_>) -> Self {
        sort_by_number(&mut shooting.cues, |c| c.start_secs);
        let ShotPlanInput { usual, cues, .. } = &shooting;
        let leads: Vec<(f64, ControlSource)> = cues.iter().map(|c| (c.start_secs, c.by)).collect();
        let same =
            |a: Option<&EmotionEnvelope>, b: Option<&EmotionEnvelope>| shot_for(a) == shot_for(b);
        let taken = leaders(&leads, shooting.emotions, shooting.follows, MIN_SECS, same);
        let first = CameraShot {
            start_secs: f64::NEG_INFINITY,
            settled_secs: f64::NEG_INFINITY,
            shot: *usual,
            angle: Angle::Eye,
            is_by_emotion: false,
            is_written: false,
        };
        let mut now = first;
        let take = |&(start_secs, leader): &(f64, ActiveControl)| {
            let (transition_secs, shot, angle, is_felt) = match leader {
                ActiveControl::Script(i) => {
                    let cue = &cues[i];
                    let (shot, angle) = (cue.shot.unwrap_or(now.shot), cue.angle);
                    (cue.transition_secs, shot, angle.unwrap_or(now.angle), false)
                }
                ActiveControl::Emotion(felt) => {
                    let (shot, angle) = shot_for(felt.as_ref()).unwrap_or((*usual, Angle::Eye));
                    let steps = (nearness(shot) - nearness(now.shot)).abs();
                    let cuts = steps >= CUT_STEPS || !shooting.moves;
                    (
                        if cuts { 0.0 } else { MOVE_SECS },
                        shot,
                        angle,
                        felt.is_some(),
                    )
                }
            };
            now = CameraShot {
                start_secs,
                settled_secs: start_secs + transition_secs,
                shot,
                angle,
                is_by_emotion: is_felt,
                is_written: matches!(leader, ActiveControl::Script(_)),
            };
            now
        };
        Self {
            first,
            later: taken.iter().map(take).collect(),
        }
    }

    /// Returns the settled shot at a time, and the shots in transition.
    fn transition_at(&self, time_secs: f64) -> (&CameraShot, &[CameraShot]) {
        let begun = self.later.partition_point(|v| v.start_secs <= time_secs);
        let begun = &self.later[..begun];
        let settled = begun.iter().rposition(|v| v.settled_secs <= time_secs);
        match settled {
            Some(i) => (&begun[i], &begun[i + 1..]),
            None => (&self.first, begun),
        }
    }

    /// Returns the current or destination shot at a time.
    pub(crate) fn sample(&self, time_secs: f64) -> &CameraShot {
        let (base, moving) = self.transition_at(time_secs);
        moving.last().unwrap_or(base)
    }

    /// Returns all shots after the first, sorted by time.
    pub(crate) fn later(&self) -> &[CameraShot] {
        &self.later
    }

    /// Returns true if the camera is between two shots at a time.
    pub(crate) fn moves(&self, time_secs: f64) -> bool {
        !self.transition_at(time_secs).1.is_empty()
    }

    /// Returns true if the shots at a time make room for hands.
    pub(crate) fn makes_room(&self, time_secs: f64) -> bool {
        let (base, moving) = self.transition_at(time_secs);
        let is_close =
            |v: &CameraShot| nearness(v.shot) > nearness(Shot::Medium) && !v.is_by_emotion;
        !is_close(base) && !moving.iter().any(is_close)
    }

    /// Returns the camera at a time; `frame` gives that of a shot at eye height. Only shots in
    /// transition are evaluated.
    pub(crate) fn camera(&self, time_secs: f64, frame: impl Fn(&CameraShot) -> Camera) -> Camera {
        let (base, moving) = self.transition_at(time_secs);
        let shown = |take: &CameraShot| frame(take).raised(take.angle.elevation_rad());
        moving.iter().fold(shown(base), |camera, take| {
            let way_secs = take.settled_secs - take.start_secs;
            let s = minimum_jerk((time_secs - take.start_secs) / way_secs);
            camera.towards(&shown(take), s)
        })
    }
}

/// Returns the shot that an emotion requests: distance by its potential, angle by its type.
fn shot_for(felt: Option<&EmotionEnvelope>) -> Option<(Shot, Angle)> {
    felt.map(|f| (EmotionType::distance(f.potential), f.kind.angle))
}

/// Returns the closeness of a shot, in steps.
fn nearness(shot: Shot) -> i32 {
    match shot {
        Shot::Long => 0,
        Shot::Full => 1,
        Shot::Medium | Shot::Storyteller => 2,
        Shot::Close => 3,
        Shot::ExtremeClose => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::DVec3;
    use raconteur_stage::FramingMargin;

    fn views(body: &str) -> ShotSequence {
        let text = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let script = Script::read(&text, None);
        assert_eq!(script.diagnostics, []);
        ShotSequence::new(ShotPlanInput {
            usual: Shot::Medium,
            cues: shots(&script),
            emotions: &EmotionTimeline::default(),
            follows: true,
            moves: true,
        })
    }

    fn still(shot: Shot) -> Camera {
        shot.frame(DVec3::ZERO, 1.7, 1.78, FramingMargin::default())
    }

    fn camera_of(take: &CameraShot) -> Camera {
        still(take.shot)
    }

    #[test]
    fn a_cut_is_at_once_and_a_transition_eases() {
        let views = views(
            "<r:camera time='2' shot='full'/><r:camera time='4' shot='closeUp' transition='2'/>",
        );
        let at = |t: f64| views.camera(t, camera_of);
        assert_eq!(at(1.999), still(Shot::Medium));
        assert_eq!(at(2.0), still(Shot::Full));
        assert_eq!(at(4.0), still(Shot::Full));
        let halfway = still(Shot::Full).towards(&still(Shot::Close), 0.5);
        assert!(
            (at(5.0).eye_in_world - halfway.eye_in_world).length() < 1e-9,
            "the camera is halfway in the transition"
        );
        assert_eq!(at(6.0), still(Shot::Close));
        // No frame of a film moves further than the ease allows: 1.875 times the mean.
        let way = (still(Shot::Full).eye_in_world - still(Shot::Close).eye_in_world).length();
        let mut fastest: f64 = 0.0;
        for frame in 0..100 {
            let t = 4.0 + 0.02 * f64::from(frame);
            let step = at(t + 0.02).eye_in_world - at(t).eye_in_world;
            fastest = fastest.max(step.length() / 0.02);
        }
        assert!(fastest < 1.88 * way / 2.0, "{fastest}");
    }

    #[test]
    fn what_is_left_out_stays() {
        let views = views(
            "<r:camera time='1' shot='full'/><r:camera time='2' angle='low'/>\
             <r:camera time='3' shot='long'/>",
        );
        let low = |shot: Shot| still(shot).raised(Angle::Low.elevation_rad());
        assert_eq!(views.camera(2.5, camera_of), low(Shot::Full));
        assert_eq!(views.camera(3.5, camera_of), low(Shot::Long));
    }

    #[test]
    fn a_transition_that_is_cut_short_goes_on_from_where_it_was() {
        let views = views(
            "<r:camera time='0' shot='full' transition='4'/>\
             <r:camera time='2' shot='closeUp' transition='1'/>",
        );
        let before = views.camera(2.0 - 1e-6, camera_of);
        let after = views.camera(2.0 + 1e-6, camera_of);
        assert!(
            (before.eye_in_world - after.eye_in_world).length() < 1e-4,
            "the interrupted transition does not jump"
        );
        assert_eq!(views.camera(9.0, camera_of), still(Shot::Close));
    }
}

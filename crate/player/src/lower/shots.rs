//! What the camera shows, as a function of time: the shots that a script takes
//! (GEVH 3.5.4.1), eased from one to the next.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::order::sort_by_number;
use raconteur_eml::{CameraAngle, ClauseKind, ShotKind};
use raconteur_stage::{Camera, Shot};

use crate::lower::script::Script;

/// How far the camera of a high angle is above one at eye height, and of a low angle
/// below it, about what it looks at; radians. Designed: one sees the difference, and the
/// face in both.
const HIGH_RAD: f64 = 0.30;
const LOW_RAD: f64 = 0.20;

/// A shot that a script takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShotCue {
    pub(crate) start_secs: f64,
    transition_secs: f64,
    /// None: unchanged.
    shot: Option<Shot>,
    /// Above eye height, radians; none: unchanged.
    elevation_rad: Option<f64>,
}

/// The shots of a script by time.
pub(crate) fn shots(script: &Script) -> Vec<ShotCue> {
    let clauses = script.timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &script.document.clause(timed.clause).kind {
            ClauseKind::Camera(camera) => Some(ShotCue {
                start_secs: timed.start_secs,
                transition_secs: camera.transition_secs,
                shot: camera.shot.map(|kind| match kind {
                    ShotKind::ExtremeCloseUp => Shot::ExtremeClose,
                    ShotKind::CloseUp => Shot::Close,
                    ShotKind::Medium => Shot::Medium,
                    ShotKind::Full => Shot::Full,
                    ShotKind::Long => Shot::Long,
                }),
                elevation_rad: camera.angle.map(|angle| match angle {
                    CameraAngle::Eye => 0.0,
                    CameraAngle::High => HIGH_RAD,
                    CameraAngle::Low => -LOW_RAD,
                }),
            }),
            _ => None,
        })
        .collect()
}

/// The shot from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TimedShot {
    start_secs: f64,
    /// When the transition to it ends.
    settled_secs: f64,
    shot: Shot,
    elevation_rad: f64,
}

/// The shots of a performance by time, of which there is always one.
pub(crate) struct ShotSequence {
    first: TimedShot,
    later: Vec<TimedShot>,
}

impl ShotSequence {
    /// The shots of a performance that begins with a shot at eye height.
    pub(crate) fn new<'a>(shot: Shot, cues: impl Iterator<Item = &'a ShotCue>) -> Self {
        let mut later: Vec<ShotCue> = cues.copied().collect();
        sort_by_number(&mut later, |c| c.start_secs);
        let first = TimedShot {
            start_secs: f64::NEG_INFINITY,
            settled_secs: f64::NEG_INFINITY,
            shot,
            elevation_rad: 0.0,
        };
        let mut now = first;
        let view = |cue: &ShotCue| {
            now = TimedShot {
                start_secs: cue.start_secs,
                settled_secs: cue.start_secs + cue.transition_secs,
                shot: cue.shot.unwrap_or(now.shot),
                elevation_rad: cue.elevation_rad.unwrap_or(now.elevation_rad),
            };
            now
        };
        Self {
            first,
            later: later.iter().map(view).collect(),
        }
    }

    /// The settled shot at a time, and those in transition.
    fn taken(&self, time_secs: f64) -> (&TimedShot, &[TimedShot]) {
        let begun = self.later.partition_point(|v| v.start_secs <= time_secs);
        let begun = &self.later[..begun];
        let settled = begun.iter().rposition(|v| v.settled_secs <= time_secs);
        match settled {
            Some(i) => (&begun[i], &begun[i + 1..]),
            None => (&self.first, begun),
        }
    }

    /// Whether the shots of a time make room for hands.
    pub(crate) fn makes_room(&self, time_secs: f64) -> bool {
        let (base, moving) = self.taken(time_secs);
        let is_close = |v: &TimedShot| matches!(v.shot, Shot::Close | Shot::ExtremeClose);
        !is_close(base) && !moving.iter().any(is_close)
    }

    /// The camera at a time; `frame` gives that of a shot at eye height. Looks at no more
    /// shots than are in transition.
    pub(crate) fn camera(&self, time_secs: f64, frame: impl Fn(Shot) -> Camera) -> Camera {
        let (base, moving) = self.taken(time_secs);
        let shown = |view: &TimedShot| frame(view.shot).raised(view.elevation_rad);
        moving.iter().fold(shown(base), |camera, view| {
            let way_secs = view.settled_secs - view.start_secs;
            let s = minimum_jerk((time_secs - view.start_secs) / way_secs);
            camera.towards(&shown(view), s)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::DVec3;
    use raconteur_stage::Room;

    fn views(body: &str) -> ShotSequence {
        let text = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let script = Script::read(&text, None);
        assert_eq!(script.diagnostics, []);
        ShotSequence::new(Shot::Medium, shots(&script).iter())
    }

    fn still(shot: Shot) -> Camera {
        shot.frame(DVec3::ZERO, 1.7, 1.78, Room::default())
    }

    #[test]
    fn a_cut_is_at_once_and_a_transition_eases() {
        let views = views(
            "<r:camera time='2' shot='full'/><r:camera time='4' shot='closeUp' transition='2'/>",
        );
        let at = |t: f64| views.camera(t, still);
        assert_eq!(at(1.999), still(Shot::Medium));
        assert_eq!(at(2.0), still(Shot::Full));
        assert_eq!(at(4.0), still(Shot::Full));
        let halfway = still(Shot::Full).towards(&still(Shot::Close), 0.5);
        assert!((at(5.0).eye_in_world - halfway.eye_in_world).length() < 1e-9);
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
        let low = |shot: Shot| still(shot).raised(-LOW_RAD);
        assert_eq!(views.camera(2.5, still), low(Shot::Full));
        assert_eq!(views.camera(3.5, still), low(Shot::Long));
    }

    #[test]
    fn a_transition_that_is_cut_short_goes_on_from_where_it_was() {
        let views = views(
            "<r:camera time='0' shot='full' transition='4'/>\
             <r:camera time='2' shot='closeUp' transition='1'/>",
        );
        let before = views.camera(2.0 - 1e-6, still);
        let after = views.camera(2.0 + 1e-6, still);
        assert!((before.eye_in_world - after.eye_in_world).length() < 1e-4);
        assert_eq!(views.camera(9.0, still), still(Shot::Close));
    }
}

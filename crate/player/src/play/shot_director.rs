//! Presentation of the figure: shots and lights of the script and of emotions, the page's own view,
//! and the visibility switches.

use raconteur_base::DVec3;
use raconteur_stage::{
    Camera, EmotionTimeline, FramingMargin, Illumination, QUICK_ZOOM, SLOW_ZOOM, Shot, Span, View,
    Visibility,
};

use crate::lower::control_source::Channels;
use crate::lower::lamps::{LampSequence, LightChannel};
use crate::lower::plan::ScriptPlan;
use crate::lower::shots::{CameraShot, ShotPlanInput, ShotSequence};
use crate::lower::visibility::{Switch, VisibilityTrack};
use crate::options::Options;

/// Director of the image: camera shots, light and visibility of the figure at any time, from script
/// and emotions.
pub(crate) struct ShotDirector {
    /// Default shot.
    shot: Shot,
    /// True if emotions move the camera; false if it cuts.
    moves: bool,
    /// The channels that express emotions.
    channels: Channels,
    shots: ShotSequence,
    lamps: LampSequence,
    /// The page's own view, which replaces the shot.
    view: Option<View>,
    /// Share of the image height that captions take at its lower edge.
    captions: f64,
    geometry: VisibilityTrack,
}

/// Figure to be framed by the camera: the floor under it and its stature.
pub(crate) struct FramedFigure {
    /// The floor under the figure, world, metres.
    pub(crate) floor_in_world: DVec3,
    pub(crate) stature_m: f64,
}

impl ShotDirector {
    /// Creates the framing of a story.
    pub(crate) fn new(options: &Options, story: &ScriptPlan, feelings: &EmotionTimeline) -> Self {
        let mut geometry = VisibilityTrack::default();
        geometry.retell(&story.geometry);
        let nothing = ShotPlanInput {
            usual: options.shot,
            cues: Vec::new(),
            emotions: &EmotionTimeline::default(),
            follows: false,
            moves: false,
        };
        let mut picture = Self {
            shot: options.shot,
            moves: options.moving_camera,
            channels: story.channels,
            shots: ShotSequence::new(nothing),
            lamps: LampSequence::default(),
            view: None,
            captions: 0.0,
            geometry,
        };
        picture.rebuild([story].into_iter(), feelings);
        picture
    }

    /// Rebuilds the shots and lights of all plans and of the emotions.
    pub(crate) fn rebuild<'p>(
        &mut self,
        plans: impl Iterator<Item = &'p ScriptPlan> + Clone,
        feelings: &EmotionTimeline,
    ) {
        self.shots = ShotSequence::new(ShotPlanInput {
            usual: self.shot,
            cues: plans.clone().flat_map(|p| &p.shots).copied().collect(),
            emotions: feelings,
            follows: self.channels.camera,
            moves: self.moves,
        });
        let lamps = plans.flat_map(|p| &p.lamps).copied().collect();
        let light = LightChannel {
            follows: self.channels.light,
            is_strict: self.channels.strict_light,
        };
        self.lamps = LampSequence::new(lamps, feelings, light);
    }

    /// Replaces the story's channels and switches.
    pub(crate) fn retell(&mut self, story: &ScriptPlan) {
        self.channels = story.channels;
        self.geometry.retell(&story.geometry);
    }

    /// Adds the switches of a live fragment.
    pub(crate) fn join(&mut self, fragment: &[Switch]) {
        self.geometry.join(fragment);
    }

    /// Removes the switches of live fragments after a time.
    pub(crate) fn interrupt(&mut self, at_secs: f64) {
        self.geometry.interrupt(at_secs);
    }

    /// Shows the whole figure from a direction; `None` returns to the shot.
    pub(crate) fn set_view(&mut self, view: Option<View>) {
        self.view = view;
    }

    /// Keeps hands and feet above this share of the image height at its lower edge.
    pub(crate) fn set_captions(&mut self, share: f64) {
        self.captions = share;
    }

    /// Returns true if the surroundings of the figure are animated.
    pub(crate) fn moves(&self) -> bool {
        self.moves
    }

    /// Returns the camera shots of the performance.
    pub(crate) fn shots(&self) -> &ShotSequence {
        &self.shots
    }

    /// Returns the visible parts of the figure at a time.
    pub(crate) fn visibility(&self, time_secs: f64) -> Visibility {
        self.geometry.sample(time_secs)
    }

    /// Returns the illumination of the stage at a time.
    pub(crate) fn illumination(&self, time_secs: f64) -> Illumination {
        self.lamps.sample(time_secs)
    }

    /// Returns the camera at a time, for an image of `aspect` (width over height); `room` gives the
    /// margin for hands at that time from the span at rest and the fastest zoom.
    pub(crate) fn camera(
        &self,
        time_secs: f64,
        aspect: f64,
        subject: &FramedFigure,
        room: impl Fn((Span, f64)) -> FramingMargin,
    ) -> Camera {
        let (floor_in_world, stature_m) = (subject.floor_in_world, subject.stature_m);
        let frame = |shot: Shot, room: FramingMargin| {
            let room = FramingMargin {
                captions: self.view.map_or(self.captions, |_| 0.0),
                ..room
            };
            shot.frame(floor_in_world, stature_m, aspect, room)
        };
        let usual = || room((Span::at_rest(aspect), SLOW_ZOOM));
        let of = |take: &CameraShot| {
            let elevation_rad = take.angle.elevation_rad();
            let room = |rest| {
                let room = room(rest);
                FramingMargin {
                    span: room.span.seen_from(elevation_rad),
                    ..room
                }
            };
            match take.shot {
                // The lens zooms in and leaves room for the hands.
                near @ (Shot::Medium | Shot::Close | Shot::ExtremeClose) if take.is_by_emotion => {
                    let rest = near.emotion_span(stature_m, aspect);
                    let zoom = if self.moves { QUICK_ZOOM } else { SLOW_ZOOM };
                    frame(Shot::Storyteller, room((rest, zoom)))
                }
                shot => frame(shot, room((Span::at_rest(aspect), SLOW_ZOOM))),
            }
        };
        match self.view {
            Some(view) => view.apply(&frame(Shot::Full, usual())),
            None => self.shots.camera(time_secs, of),
        }
    }
}

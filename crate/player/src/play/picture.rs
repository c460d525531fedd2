//! How the figure is shown: the script's shots, the page's own view, and the drawing's switches.

use raconteur_base::DVec3;
use raconteur_stage::{Camera, Room, Shot, Shown, View};

use crate::lower::geometry::{Geometry, Switch};
use crate::lower::plan::ScriptPlan;
use crate::lower::shots::ShotSequence;

/// How the figure is shown at any time.
pub(crate) struct Picture {
    /// The shot until the script takes another.
    shot: Shot,
    shots: ShotSequence,
    /// The page's own view, in place of the shot.
    view: Option<View>,
    /// Share of the picture's height that captions take at its lower edge.
    captions: f64,
    geometry: Geometry,
}

/// Position and size of the figure in a picture.
pub(crate) struct Subject {
    /// The floor under the figure, world, metres.
    pub(crate) floor_in_world: DVec3,
    pub(crate) stature_m: f64,
    /// The room for its gestures.
    pub(crate) room: Room,
}

impl Picture {
    /// The picture of a story that begins with a shot.
    pub(crate) fn new(shot: Shot, story: &ScriptPlan) -> Self {
        let mut geometry = Geometry::default();
        geometry.retell(&story.geometry);
        Self {
            shot,
            shots: ShotSequence::new(shot, story.shots.iter()),
            view: None,
            captions: 0.0,
            geometry,
        }
    }

    /// Takes the shots of all plans anew.
    pub(crate) fn take_shots<'p>(&mut self, plans: impl Iterator<Item = &'p ScriptPlan>) {
        self.shots = ShotSequence::new(self.shot, plans.flat_map(|p| &p.shots));
    }

    /// Takes what the story switches, in place of what it switched before.
    pub(crate) fn retell(&mut self, story: &[Switch]) {
        self.geometry.retell(story);
    }

    /// Takes what a live fragment switches.
    pub(crate) fn join(&mut self, fragment: &[Switch]) {
        self.geometry.join(fragment);
    }

    /// Leaves out what live fragments would switch after a time.
    pub(crate) fn interrupt(&mut self, at_secs: f64) {
        self.geometry.interrupt(at_secs);
    }

    /// Shows the whole figure from this side; by none, the shot again.
    pub(crate) fn set_view(&mut self, view: Option<View>) {
        self.view = view;
    }

    /// Keeps hands and feet above this share of the picture's height at its lower edge.
    pub(crate) fn set_captions(&mut self, share: f64) {
        self.captions = share;
    }

    /// Whether the shots of a time make room for hands.
    pub(crate) fn makes_room(&self, time_secs: f64) -> bool {
        self.shots.makes_room(time_secs)
    }

    /// What of the figure is drawn at a time.
    pub(crate) fn shown(&self, time_secs: f64) -> Shown {
        self.geometry.at(time_secs)
    }

    /// The camera at a time, for a picture of `aspect` (width over height).
    pub(crate) fn camera(&self, time_secs: f64, aspect: f64, subject: &Subject) -> Camera {
        let frame = |shot: Shot| {
            let Subject {
                floor_in_world,
                stature_m,
                room,
            } = *subject;
            let room = Room {
                captions: self.view.map_or(self.captions, |_| 0.0),
                ..room
            };
            shot.frame(floor_in_world, stature_m, aspect, room)
        };
        match self.view {
            Some(view) => view.of(&frame(Shot::Full)),
            None => self.shots.camera(time_secs, frame),
        }
    }
}

//! Position of the whole figure: `vh-move` as a function of time.

use raconteur_base::order::sort_by_number;
use raconteur_base::{DAffine3, DQuat, DVec3};

use super::RootMotion;
use super::path::TimedPath;
use crate::limb::RigidFrame;

/// Motions of the whole figure over the story, in order of time.
#[derive(Clone, Debug, Default)]
pub(super) struct RootTrack {
    moves: Vec<(f64, TimedPath)>,
}

/// Default frame of a figure.
const HOME: RigidFrame = RigidFrame {
    position: DVec3::ZERO,
    rotation: DQuat::IDENTITY,
};

impl RootTrack {
    pub(super) fn new(moves: &[RootMotion]) -> Self {
        let finite = |m: &&RootMotion| m.time_secs.is_finite();
        let mut order: Vec<&RootMotion> = moves.iter().filter(finite).collect();
        sort_by_number(&mut order, |m| m.time_secs);
        let mut track = Self::default();
        for m in order {
            // Before its first motion, the figure is already at the start of that motion.
            let now = if track.moves.is_empty() {
                TimedPath::new(&m.path, &HOME, true).start()
            } else {
                track.frame(m.time_secs)
            };
            track
                .moves
                .push((m.time_secs, TimedPath::new(&m.path, &now, true)));
        }
        track
    }

    fn frame(&self, time_secs: f64) -> RigidFrame {
        let begun = self.moves.partition_point(|(at, _)| *at <= time_secs);
        match self.moves.get(begun.saturating_sub(1)) {
            Some((at, curve)) => curve.sample(time_secs - at),
            None => HOME,
        }
    }

    /// Returns the start of each motion and its duration, seconds; infinite in a loop.
    pub(super) fn motions(&self) -> Vec<(f64, f64)> {
        self.moves
            .iter()
            .map(|(at, curve)| (*at, curve.secs()))
            .collect()
    }

    /// Returns world from figure axes; `None` if the figure never moves.
    pub(super) fn sample(&self, time_secs: f64) -> Option<DAffine3> {
        (!self.moves.is_empty()).then(|| {
            let frame = self.frame(time_secs);
            DAffine3::from_rotation_translation(frame.rotation, frame.position)
        })
    }
}

//! Where the whole figure is: `vh-move` as a function of time.

use raconteur_base::order::sort_by_number;
use raconteur_base::{DAffine3, DQuat, DVec3};

use super::Move;
use super::path::Curve;
use crate::limb::Frame;

/// The figure's motions in order.
#[derive(Clone, Debug, Default)]
pub(super) struct RootTrack {
    moves: Vec<(f64, Curve)>,
}

/// Where a figure stands of which nothing is said.
const HOME: Frame = Frame {
    position: DVec3::ZERO,
    rotation: DQuat::IDENTITY,
};

impl RootTrack {
    pub(super) fn new(moves: &[Move]) -> Self {
        let finite = |m: &&Move| m.time_secs.is_finite();
        let mut order: Vec<&Move> = moves.iter().filter(finite).collect();
        sort_by_number(&mut order, |m| m.time_secs);
        let mut track = Self::default();
        for m in order {
            // Before its first motion the figure already stands where that begins.
            let now = if track.moves.is_empty() {
                Curve::new(&m.path, &HOME, true).start()
            } else {
                track.frame(m.time_secs)
            };
            track
                .moves
                .push((m.time_secs, Curve::new(&m.path, &now, true)));
        }
        track
    }

    fn frame(&self, time_secs: f64) -> Frame {
        let begun = self.moves.partition_point(|(at, _)| *at <= time_secs);
        match self.moves.get(begun.saturating_sub(1)) {
            Some((at, curve)) => curve.at(time_secs - at),
            None => HOME,
        }
    }

    /// When each motion begins and how long it takes, seconds; infinite in a loop.
    pub(super) fn motions(&self) -> Vec<(f64, f64)> {
        self.moves
            .iter()
            .map(|(at, curve)| (*at, curve.secs()))
            .collect()
    }

    /// World from figure axes; none where the figure never moves.
    pub(super) fn at(&self, time_secs: f64) -> Option<DAffine3> {
        (!self.moves.is_empty()).then(|| {
            let frame = self.frame(time_secs);
            DAffine3::from_rotation_translation(frame.rotation, frame.position)
        })
    }
}

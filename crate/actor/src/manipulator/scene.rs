//! The figure without manipulators, at any time.

use raconteur_body::{Pose, Skeleton};

/// Skeleton and pose of the figure at one time.
#[derive(Clone, Copy)]
pub(super) struct FigureState<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) pose: &'a Pose,
}

/// Context for compiling commands: the skeleton, and the pose of the figure without manipulators at
/// any time.
pub(super) struct CommandContext<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) idle: &'a dyn Fn(f64, &mut Pose),
}

impl CommandContext<'_> {
    pub(super) fn idle(&self, time_secs: f64) -> Pose {
        let mut pose = Pose::zero();
        (self.idle)(time_secs, &mut pose);
        pose
    }
}

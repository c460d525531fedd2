//! What moves a figure besides gestures and idle life: animation players and manipulators.
//!
//! Few stories use them, and they are large. A browser fetches their code only for those that
//! do, so everybody else reaches them through this module alone, and only where a script asks
//! for them: `web/tools/split.mjs` cuts there. Its functions are never inlined, or the code
//! would come along.

use raconteur_base::{DAffine3, Side};
use raconteur_body::{Pose, Skeleton};

use crate::animation::{Animated, Players};
use crate::gesture::ArmScript;
use crate::manipulator::{Manipulators, Reached};
use crate::performance::Performance;

/// Players and manipulators of one performance.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    players: Players,
    manipulators: Manipulators,
}

impl Motion {
    /// Prepares the players; manipulators are at rest until [`Motion::lead`].
    #[inline(never)]
    pub(crate) fn new(performance: &Performance, skeleton: &Skeleton) -> Box<Self> {
        let players = Players::new(&performance.players, &performance.library, skeleton).0;
        Box::new(Self {
            players,
            manipulators: Manipulators::at_rest(skeleton, performance.sex),
        })
    }

    /// The same performance with its manipulators ready; `idle` poses the figure as it is
    /// without them at a time.
    #[inline(never)]
    pub(crate) fn lead(
        &self,
        performance: &Performance,
        skeleton: &Skeleton,
        idle: &dyn Fn(f64, &mut Pose),
    ) -> Box<Self> {
        let script = &performance.manipulators;
        Box::new(Self {
            players: self.players.clone(),
            manipulators: Manipulators::new(script, skeleton, performance.sex, idle),
        })
    }

    /// As [`Players::apply`].
    #[inline(never)]
    pub(crate) fn animate(&self, skeleton: &Skeleton, t: f64, pose: &mut Pose) -> Option<Animated> {
        self.players.apply(skeleton, t, pose)
    }

    /// As [`Manipulators::world_from_figure`].
    #[inline(never)]
    pub(crate) fn world_from_figure(&self, t: f64) -> Option<DAffine3> {
        self.manipulators.world_from_figure(t)
    }

    /// As [`Manipulators::lean`].
    #[inline(never)]
    pub(crate) fn lean(&self, skeleton: &Skeleton, t: f64, pose: &mut Pose) {
        self.manipulators.lean(skeleton, t, pose);
    }

    /// As [`Manipulators::limbs`].
    #[inline(never)]
    pub(crate) fn limbs(
        &self,
        skeleton: &Skeleton,
        t: f64,
        pose: &mut Pose,
    ) -> [Option<Reached>; 4] {
        self.manipulators.limbs(skeleton, t, pose)
    }

    /// As [`Manipulators::head`].
    #[inline(never)]
    pub(crate) fn head(&self, skeleton: &Skeleton, t: f64, pose: &mut Pose) {
        self.manipulators.head(skeleton, t, pose);
    }
}

/// As [`Animated::blend_arm`].
#[inline(never)]
pub(crate) fn blend_arm(
    animated: &Animated,
    side: Side,
    rest_share: f64,
    finger_share: f64,
    pose: &mut Pose,
) {
    animated.blend_arm(side, rest_share, finger_share, pose);
}

/// The scripts of the arms as a figure sees them that the performance moves about.
#[inline(never)]
pub(crate) fn seen_on_the_way(performance: &Performance) -> [ArmScript; 2] {
    let way = performance.manipulators.figure_from_world();
    performance.arms.each_ref().map(|script| match &way {
        Some(way) => script.seen_by(way),
        None => script.clone(),
    })
}

//! Swinging hair over time: steps of its chains that follow the clock.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::{DAffine3, DQuat};
use raconteur_body::skeleton::Drive;
use raconteur_body::springs::{STEPS_PER_S, SpringState};
use raconteur_body::{Skeleton, Springs};

use super::segments::{SegmentGrid, Segments, Simulation, WarmUpPolicy};

/// Segments of 1.6 s with 0.8 s warm-up, after which a hundredth of a chain's earlier swing is
/// left, which the blend into the next segment absorbs.
const CUT: SegmentGrid = SegmentGrid {
    segment: 96,
    warm_up: 48,
    pace: WarmUpPolicy::Together,
};
/// Final steps of a segment in which it blends into the next one.
const BLEND: i64 = 24;

/// Callback that solves the joint transforms at a time, seconds, with every spring chain at rest.
pub(crate) type Posture<'a> = dyn FnMut(f64, &mut Vec<DAffine3>) + 'a;

/// Chains on a figure that moves.
struct DrivenChains<'a, 'p> {
    springs: &'a Springs,
    skeleton: &'a Skeleton,
    posture: &'a mut Posture<'p>,
    world: &'a mut Vec<DAffine3>,
    /// The step for which `world` is solved; its chains hang as they were left.
    solved: Option<i64>,
}

impl DrivenChains<'_, '_> {
    fn solve(&mut self, step: i64) {
        (self.posture)(step as f64 / STEPS_PER_S, self.world);
        self.solved = Some(step);
    }
}

impl Simulation<SpringState> for DrivenChains<'_, '_> {
    fn rest(&mut self, swing: &mut SpringState, step: i64) {
        self.solve(step);
        self.springs.rest(self.world, swing);
    }

    fn step(&mut self, swing: &mut SpringState, step: i64) {
        // Both runs take the same step consecutively.
        if self.solved != Some(step) {
            self.solve(step);
        }
        self.springs.step(self.skeleton, self.world, swing);
    }
}

/// Simulated spring chains of one figure (hair, hanging cloth); gives their state at any time.
pub(crate) struct SwingingParts {
    segments: Segments<SpringState>,
    /// Room to solve joints in.
    world: Vec<DAffine3>,
}

impl SwingingParts {
    /// Creates the simulation; `None` if there are no spring chains.
    pub(crate) fn new(springs: &Springs, joints: usize) -> Option<Self> {
        (!springs.is_empty()).then(|| Self {
            segments: Segments::new(CUT, springs.swing()),
            world: Vec::with_capacity(joints),
        })
    }

    /// Clears the simulation, because the figure's motion has changed.
    pub(crate) fn forget(&mut self) {
        self.segments.forget();
    }

    /// Rotates the chains of joints solved for a time; `posture` gives those of other times.
    pub(crate) fn advance_to(
        &mut self,
        (skeleton, springs): (&Skeleton, &Springs),
        time_secs: f64,
        posture: &mut Posture<'_>,
        joints: &mut [DAffine3],
    ) {
        let exact = time_secs * STEPS_PER_S;
        let step = exact.ceil();
        let share = 1.0 - (step - exact);
        let mut carried = DrivenChains {
            springs,
            skeleton,
            posture,
            world: &mut self.world,
            solved: None,
        };
        let step = step as i64;
        self.segments.advance_to(step, &mut carried);
        let left = CUT.segment - step.rem_euclid(CUT.segment);
        let way = minimum_jerk((BLEND - left) as f64 / BLEND as f64);
        let (now, next) = self.segments.states_mut();
        let other = (left < BLEND).then_some((next, share, way));
        springs.show(skeleton, joints, now, share, other);
    }
}

/// Blends the rotations of spring joints towards those of another pose of the skeleton by a share.
/// `original` is a buffer.
pub(crate) fn blend_chains(
    skeleton: &Skeleton,
    joints: &mut [DAffine3],
    (towards, share): (&[DAffine3], f64),
    original: &mut Vec<DAffine3>,
) {
    original.clear();
    original.extend_from_slice(joints);
    for (i, joint) in skeleton.joints().iter().enumerate() {
        let (Some(parent), Drive::Spring(..)) = (joint.parent, joint.drive) else {
            continue;
        };
        let [own, other] = [&original[..], towards].map(|pose| pose[parent].inverse() * pose[i]);
        let [from, to] = [own, other].map(|local| DQuat::from_mat3(&local.matrix3));
        let turned = from.slerp(to, share).normalize();
        joints[i] = joints[parent] * DAffine3::from_rotation_translation(turned, own.translation);
    }
}

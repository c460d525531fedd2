//! Swinging chains of joints: hair and hanging cloth.
//!
//! Data and rules are those of the glTF extension `VRMC_springBone` 1.0: each joint of a chain is a
//! pendulum whose end is drawn to its rest position, pulled down, damped, kept at its distance and
//! kept out of spheres and capsules attached to other joints. The rules are iterated at a fixed
//! rate, so that the same motion always gives the same swing.

mod renumbered;
#[cfg(test)]
mod tests;

use raconteur_base::{DAffine3, DMat3, DQuat, DVec3};

use crate::skeleton::Skeleton;

pub(crate) use renumbered::place;

/// Simulation steps per second: the rate for which drag is given in files.
pub const STEPS_PER_S: f64 = 60.0;
/// Number of times that a chain is pushed out of colliders in a step: leaving one may enter
/// another.
const PUSHES: usize = 3;
/// Cosine of the maximum turn of a link from its rest direction, independent of its parents: 17°.
/// Designed: hair that stands off farther looks windblown, and passes through colliders in quick
/// motion.
const MAX_SWING_COS: f64 = 0.956;
/// Cosine of the maximum deflection of a link by colliders, 30°. This keeps a raised shoulder from
/// pushing hair into the face.
const MAX_PUSH_COS: f64 = 0.866;
/// Displacement in one step from which a joint counts as teleported, metres.
const LEAP_M: f64 = 0.3;
/// Largest movement of an end relative to its joint in one step, metres: 0.9 m/s. An end that slips to the other side of a
/// collider takes some steps. Designed.
const MAX_STEP_M: f64 = 0.015;

/// Link of a spring chain: its joint and the physical parameters of its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringLink {
    /// Index of the joint in the skeleton.
    pub joint: usize,
    /// Force towards the rest position, metres per second for each step.
    pub stiffness: f64,
    /// Gravity as a vector, world, metres a second for each step.
    pub gravity: DVec3,
    /// Share of the speed lost in a step, 0..1.
    pub drag: f64,
    /// Collision radius of the end, metres.
    pub radius_m: f64,
}

/// Spring chain, such as a strand of hair or a hanging piece of cloth. Each joint except the first
/// is attached to the previous one; the last is only an end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chain {
    /// Links, from the root to the end.
    pub links: Vec<SpringLink>,
    /// Colliders that act on the chain, as indices into [`Springs::colliders`].
    pub colliders: Vec<usize>,
}

/// Capsule attached to a joint, which keeps spring chains out of the body; a sphere if both ends
/// coincide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collider {
    /// Index of the joint in the skeleton.
    pub joint: usize,
    /// The ends of its middle line in the joint's frame, metres.
    pub ends: [DVec3; 2],
    /// Radius, metres.
    pub radius_m: f64,
}

/// Spring chains of a figure (hair, hanging cloth) with their colliders; simulated after each pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Springs {
    /// Spring chains, those nearer to the root first.
    pub chains: Vec<Chain>,
    /// Colliders of the chains.
    pub colliders: Vec<Collider>,
}

/// State of the spring simulation: present and previous position of each link's end (all but the
/// last of a chain), world, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringState {
    now: Vec<DVec3>,
    before: Vec<DVec3>,
    /// Room for the ends of a step and for the colliders' middle lines.
    next: Vec<DVec3>,
    lines: Vec<[DVec3; 2]>,
}

impl SpringState {
    /// Returns the position of an end a share of a step before the last step.
    fn position_at(&self, end: usize, share: f64) -> DVec3 {
        self.before[end].lerp(self.now[end], share)
    }
}

/// A joint whose end is to be placed.
struct HangingJoint<'a> {
    link: &'a SpringLink,
    /// Index of the end.
    end: usize,
    /// True for the first joint of a chain.
    is_first: bool,
    /// World, metres.
    joint: DVec3,
    /// Vector from the joint to its end at rest, world, metres.
    arm: DVec3,
    /// Vector from the joint to its end with no joint of the chain rotated, world, metres.
    still: DVec3,
}

impl HangingJoint<'_> {
    /// Returns the end in the direction of a point, within the range of colliders' deflection.
    fn towards(&self, point: DVec3) -> DVec3 {
        let direction = clamp_direction(self.still, point - self.joint, MAX_PUSH_COS);
        self.joint + direction * self.arm.length()
    }
}

/// Rules by which ends are placed.
struct Placement<'a> {
    /// Wanted position of an end, world, metres.
    wanted: &'a dyn Fn(&HangingJoint<'_>) -> DVec3,
    /// Positions of the ends one step before, which limit their movement. `None` places ends that
    /// are already outside of the colliders: a blend of two states passes straight from one to the
    /// other.
    before: Option<&'a [DVec3]>,
}

impl Placement<'_> {
    /// Returns a position no farther from that of the previous step, relative to the joint, than an
    /// end moves in one.
    fn limited(&self, hung: &HangingJoint<'_>, end: DVec3) -> DVec3 {
        let Some((before, joint_before)) = self.before.and_then(|ends| {
            let above = hung.end.checked_sub(1).filter(|_| !hung.is_first)?;
            Some((ends[hung.end], ends[above]))
        }) else {
            return end;
        };
        let carried = hung.joint + (before - joint_before);
        let way = end - carried;
        if way.length_squared() <= MAX_STEP_M * MAX_STEP_M {
            return end;
        }
        hung.towards(carried + way.clamp_length_max(MAX_STEP_M))
    }
}

impl Springs {
    /// Returns true if the figure has no spring chains.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.chains.is_empty()
    }

    /// Creates the state of a spring simulation for all chains; call [`Springs::rest`] before the
    /// first step.
    #[must_use]
    pub fn swing(&self) -> SpringState {
        let ends: usize = self
            .chains
            .iter()
            .map(|c| c.links.len().saturating_sub(1))
            .sum();
        let now = vec![DVec3::ZERO; ends];
        SpringState {
            before: now.clone(),
            next: now.clone(),
            now,
            lines: vec![[DVec3::ZERO; 2]; self.colliders.len()],
        }
    }

    /// Places all ends at rest in a solved pose.
    pub fn rest(&self, world: &[DAffine3], swing: &mut SpringState) {
        swing.now.clear();
        for chain in &self.chains {
            let ends = chain.links.iter().skip(1);
            swing.now.extend(ends.map(|l| world[l.joint].translation));
        }
        swing.before.clone_from(&swing.now);
    }

    /// Advances the simulation by 1 / [`STEPS_PER_S`] and rotates the chains of a solved pose
    /// accordingly. `swing` must have been at rest once.
    pub fn step(&self, skeleton: &Skeleton, world: &mut [DAffine3], swing: &mut SpringState) {
        let mut next = core::mem::take(&mut swing.next);
        let mut lines = core::mem::take(&mut swing.lines);
        let wanted = |hung: &HangingJoint<'_>| {
            let (now, before) = (swing.now[hung.end], swing.before[hung.end]);
            let rest = hung.joint + hung.arm;
            let speed = now - before;
            if rest.distance(now) > LEAP_M || speed.length() > LEAP_M {
                return rest;
            }
            let SpringLink {
                stiffness,
                gravity,
                drag,
                ..
            } = *hung.link;
            let pull = hung.arm.normalize_or_zero() * stiffness + gravity;
            now + speed * (1.0 - drag) + pull / STEPS_PER_S
        };
        let placement = Placement {
            wanted: &wanted,
            before: Some(&swing.now),
        };
        self.place(skeleton, world, &mut lines, &mut next, &placement);
        swing.lines = lines;
        swing.next =
            core::mem::replace(&mut swing.before, core::mem::replace(&mut swing.now, next));
    }

    /// Rotates the chains of a solved posture to their ends, a share of a step before the last
    /// step; with a second spring state, blended towards it by a share.
    pub fn show(
        &self,
        skeleton: &Skeleton,
        world: &mut [DAffine3],
        swing: &mut SpringState,
        share: f64,
        other: Option<(&SpringState, f64, f64)>,
    ) {
        let mut next = core::mem::take(&mut swing.next);
        let mut lines = core::mem::take(&mut swing.lines);
        let wanted = |hung: &HangingJoint<'_>| {
            let own = swing.position_at(hung.end, share);
            other.map_or(own, |(other, share, way)| {
                own.lerp(other.position_at(hung.end, share), way)
            })
        };
        let placement = Placement {
            wanted: &wanted,
            before: None,
        };
        self.place(skeleton, world, &mut lines, &mut next, &placement);
        swing.next = next;
        swing.lines = lines;
    }

    /// Places the ends of all chains, from the roots outwards: each at its wanted position,
    /// limited by its distance and the colliders. Writes them to `ends`.
    fn place(
        &self,
        skeleton: &Skeleton,
        world: &mut [DAffine3],
        lines: &mut Vec<[DVec3; 2]>,
        ends: &mut Vec<DVec3>,
        placement: &Placement<'_>,
    ) {
        let line = |c: &Collider| c.ends.map(|e| world[c.joint].transform_point3(e));
        lines.clear();
        lines.extend(self.colliders.iter().map(line));
        ends.clear();
        let joints = skeleton.joints();
        let hang = |world: &[DAffine3], joint: usize| {
            let joint = &joints[joint];
            let local = skeleton.local(joint, DQuat::IDENTITY, DQuat::IDENTITY);
            joint.parent.map_or(local, |p| world[p] * local)
        };
        for chain in &self.chains {
            let mut still = None;
            for (i, pair) in chain.links.windows(2).enumerate() {
                let link = &pair[0];
                let frame = hang(world, link.joint);
                let local = skeleton.local(&joints[link.joint], DQuat::IDENTITY, DQuat::IDENTITY);
                let unturned = still.map_or(frame, |above: DAffine3| above * local);
                still = Some(unturned);
                let end_in_joint = joints[pair[1].joint].translation_in_parent;
                let hung = HangingJoint {
                    link,
                    end: ends.len(),
                    is_first: i == 0,
                    joint: frame.translation,
                    arm: frame.matrix3 * end_in_joint,
                    still: unturned.matrix3 * end_in_joint,
                };
                let wanted = (placement.wanted)(&hung);
                let end = if placement.before.is_none() {
                    hung.towards(wanted)
                } else {
                    self.kept_out(chain, lines, &hung, wanted)
                };
                let end = placement.limited(&hung, end);
                ends.push(end);
                world[link.joint] = turned(frame, hung.arm, end - hung.joint);
            }
            if let Some(last) = chain.links.last() {
                world[last.joint] = hang(world, last.joint);
            }
        }
    }

    /// Returns a position at the end's distance from its joint, outside the chain's colliders.
    fn kept_out(
        &self,
        chain: &Chain,
        lines: &[[DVec3; 2]],
        hung: &HangingJoint<'_>,
        wanted: DVec3,
    ) -> DVec3 {
        let length = hung.arm.length();
        let held =
            |p: DVec3| hung.joint + (p - hung.joint).normalize_or(hung.arm / length) * length;
        let mut end =
            hung.joint + clamp_direction(hung.still, wanted - hung.joint, MAX_SWING_COS) * length;
        for _ in 0..PUSHES {
            let before = end;
            for &c in &chain.colliders {
                let [a, b] = lines[c];
                let along = b - a;
                let t = (end - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
                let off = end - (a + along * t.clamp(0.0, 1.0));
                let least = self.colliders[c].radius_m + hung.link.radius_m;
                if off.length_squared() < least * least {
                    end = held(end + off.normalize_or(DVec3::Y) * (least - off.length()));
                }
            }
            if end == before {
                break;
            }
        }
        hung.towards(end)
    }
}

/// Returns the direction of `to`, clamped so the cosine of its angle to an arm is not less than a
/// minimum.
fn clamp_direction(arm: DVec3, to: DVec3, least: f64) -> DVec3 {
    let rest = arm.normalize_or_zero();
    let to = to.normalize_or(rest);
    let cosine = to.dot(rest);
    if cosine >= least {
        return to;
    }
    let aside = (to - rest * cosine).normalize_or(rest.any_orthonormal_vector());
    rest * least + aside * (1.0 - least * least).sqrt()
}

/// Returns a frame rotated the shortest way so its arm points along `to`.
fn turned(frame: DAffine3, arm: DVec3, to: DVec3) -> DAffine3 {
    let (Some(from), Some(to)) = (arm.try_normalize(), to.try_normalize()) else {
        return frame;
    };
    let turn = DMat3::from_quat(DQuat::from_rotation_arc(from, to));
    DAffine3 {
        matrix3: turn * frame.matrix3,
        translation: frame.translation,
    }
}

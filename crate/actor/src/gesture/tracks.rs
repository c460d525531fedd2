//! Wrist and hand rotation over the whole story, each with nodes at its own times.

use raconteur_base::curve::{last_at_or_before, minimum_jerk, smooth};
use raconteur_base::profile::Profile;
use raconteur_base::{DQuat, DVec3, Length};

use super::path::{ArcPath, flowing};
use super::{InterpolationSpace, RestingHand, Transition};
use crate::ArmRig;
use crate::limb::arm::ArmPosture;

/// Returns the segment between two nodes that contains a time: the index of its first node, the
/// share of its time, its length in seconds. `None` before the first node and from the last on.
pub(super) fn piece_at(times: &[f64], time_secs: f64) -> Option<(usize, f64, f64)> {
    let i = last_at_or_before(times, time_secs)?;
    let length = times.get(i + 1)? - times[i];
    let s = if length > 0.0 {
        (time_secs - times[i]) / length
    } else {
        0.0
    };
    Some((i, s, length))
}

/// Returns 1 for rest, which has no place, 0 for a place.
fn rest_share<T>(place: Option<&T>) -> f64 {
    f64::from(u8::from(place.is_none()))
}

/// Node of a wrist track: position at one time (`None` at rest) and the motion to the next node.
#[derive(Clone, Copy, Debug)]
pub(super) struct WristNode {
    /// Position; `None` is rest, which moves.
    pub(super) place: Option<DVec3>,
    /// Velocity of the wrist at the node, m/s.
    pub(super) velocity: DVec3,
    /// Bulge of the piece that starts here, metres.
    pub(super) arch: DVec3,
    /// Profile of the segment that starts here; `None` uses the planner's.
    pub(super) profile: Option<Profile>,
    /// Index of the piece's arm movement when it is interpolated by joint.
    swing: Option<u32>,
}

/// A movement of shoulder and elbow.
#[derive(Clone, Copy, Debug)]
struct ArmSwing {
    ends: [ArmPosture; 2],
    /// Errors of the postures at their places, metres.
    errors: [DVec3; 2],
}

/// Wrist positions of one arm over the whole story.
#[derive(Clone, Debug, Default)]
pub(super) struct WristTrack {
    pub(super) times: Vec<f64>,
    pub(super) nodes: Vec<WristNode>,
    swings: Vec<ArmSwing>,
}

impl WristTrack {
    /// Returns the wrist position at a time and the share of rest in it, 0 to 1; `rest` is the
    /// resting position at that time.
    pub(super) fn sample(&self, rig: &ArmRig, time_secs: f64, rest: DVec3) -> (DVec3, f64) {
        let Some((i, s, length)) = piece_at(&self.times, time_secs) else {
            return (rest, 1.0);
        };
        let (a, b) = (&self.nodes[i], &self.nodes[i + 1]);
        let from = a.place.unwrap_or(rest);
        let along = b.place.unwrap_or(rest) - from;
        let m = a.profile.unwrap_or_default().sample(s);
        let bow = ArcPath {
            along,
            arch: a.arch,
        };
        let wrist = if let Some(swing) = a.swing {
            let ArmSwing { ends, errors } = &self.swings[swing as usize];
            rig.wrist_of(&ends[0].lerp(&ends[1], m)) + errors[0].lerp(errors[1], m)
        } else if a.profile.is_some() {
            from + along * m
        } else if a.velocity == DVec3::ZERO && b.velocity == DVec3::ZERO {
            from + bow.after(m)
        } else {
            from + flowing(&bow, [a.velocity, b.velocity], length, s)
        };
        let [share, to] = [a, b].map(|n| rest_share(n.place.as_ref()));
        (wrist, share + (to - share) * m.clamp(0.0, 1.0))
    }

    /// Returns the time of the last node; minus infinity when there is none.
    pub(super) fn last_secs(&self) -> f64 {
        self.times.last().copied().unwrap_or(f64::NEG_INFINITY)
    }

    /// Returns the position of the last node; `None` at rest.
    pub(super) fn last(&self) -> Option<DVec3> {
        self.nodes.last().and_then(|n| n.place)
    }

    /// Adds a node, reached from the last one by `course`.
    pub(super) fn push(
        &mut self,
        rig: &ArmRig,
        time_secs: f64,
        place: Option<DVec3>,
        course: Transition,
    ) {
        if let Some(last) = self.nodes.last_mut() {
            last.profile = course.profile;
            if course.space == Some(InterpolationSpace::Joint)
                && let (Some(from), Some(to)) = (last.place, place)
            {
                let ends = [from, to].map(|wrist| rig.posture(wrist));
                let errors = [0, 1].map(|k| [from, to][k] - rig.wrist_of(&ends[k]));
                last.swing = Some(self.swings.len() as u32);
                self.swings.push(ArmSwing { ends, errors });
            }
        }
        self.times.push(time_secs);
        self.nodes.push(WristNode {
            place,
            velocity: DVec3::ZERO,
            arch: DVec3::ZERO,
            profile: None,
            swing: None,
        });
    }

    /// Returns true if the planner may shape the segment that starts at a node.
    pub(super) fn is_free(&self, i: usize) -> bool {
        self.nodes[i].profile.is_none() && self.nodes[i].swing.is_none()
    }

    /// Removes the last node.
    pub(super) fn pop(&mut self) {
        self.times.pop();
        self.nodes.pop();
    }
}

/// Rotation of a hand at one time, and its transition to the next node.
#[derive(Clone, Copy, Debug)]
struct HandNode {
    /// Rotation; `None` is rest, which moves.
    hand: Option<DQuat>,
    /// Position of the wrist at that time; set when the whole track is complete.
    wrist: DVec3,
    course: Transition,
}

/// Hand rotations of one arm over the whole story.
#[derive(Clone, Debug, Default)]
pub(super) struct HandTrack {
    pub(super) times: Vec<f64>,
    nodes: Vec<HandNode>,
}

impl HandTrack {
    /// Returns, for each node, true if it is not rest.
    pub(super) fn turned(&self) -> impl Iterator<Item = bool> {
        self.nodes.iter().map(|node| node.hand.is_some())
    }

    /// Returns the hand rotation at a time for the current wrist position, and the share of rest in
    /// it, 0 to 1.
    pub(super) fn sample(
        &self,
        rig: &ArmRig,
        time_secs: f64,
        rest: &RestingHand,
        wrist: DVec3,
    ) -> (DQuat, f64) {
        let Some((i, s, _)) = piece_at(&self.times, time_secs) else {
            return (rest.hand, 1.0);
        };
        let (a, b) = (&self.nodes[i], &self.nodes[i + 1]);
        let m = match a.course.profile {
            Some(profile) => profile.sample(s),
            None => minimum_jerk(s),
        };
        let placed = |node: &HandNode| match node.hand {
            Some(hand) => RestingHand {
                wrist: node.wrist,
                hand,
            },
            None => *rest,
        };
        let hand = turned(rig, &placed(a), &placed(b), wrist, m, a.course.space);
        let [share, to] = [a, b].map(|n| rest_share(n.hand.as_ref()));
        (hand, share + (to - share) * m.clamp(0.0, 1.0))
    }

    pub(super) fn last_secs(&self) -> f64 {
        self.times.last().copied().unwrap_or(f64::NEG_INFINITY)
    }

    /// Returns the last rotation; `None` at rest.
    pub(super) fn last(&self) -> Option<DQuat> {
        self.nodes.last().and_then(|n| n.hand)
    }

    /// Adds a node, reached from the last one by `course`.
    pub(super) fn push(&mut self, time_secs: f64, hand: Option<DQuat>, course: Transition) {
        if let Some(last) = self.nodes.last_mut() {
            last.course = course;
        }
        self.times.push(time_secs);
        self.nodes.push(HandNode {
            hand,
            wrist: DVec3::ZERO,
            course: Transition::default(),
        });
    }

    /// Removes nodes later than a time.
    pub(super) fn forget_after(&mut self, time_secs: f64) {
        let keep = self.times.partition_point(|t| *t <= time_secs);
        self.times.truncate(keep);
        self.nodes.truncate(keep);
    }

    /// Notes where the wrist is at each node.
    pub(super) fn record_positions(&mut self, wrist_at: impl Fn(f64) -> DVec3) {
        for (time, node) in self.times.iter().zip(&mut self.nodes) {
            node.wrist = wrist_at(*time);
        }
    }
}

/// Interpolates the hand rotation on the path from one place to another. Unless the script
/// specifies otherwise, small turns take the short way in the world, so a palm held down stays
/// down. Large turns follow the wrist angles relative to the forearm, because the short way in the
/// world might be impossible for an arm.
fn turned(
    rig: &ArmRig,
    from: &RestingHand,
    to: &RestingHand,
    wrist: DVec3,
    m: f64,
    space: Option<InterpolationSpace>,
) -> DQuat {
    if m == 0.0 || from.hand == to.hand {
        return from.hand;
    }
    if m == 1.0 {
        return to.hand;
    }
    let by_wrist = match space {
        Some(InterpolationSpace::Cartesian) => 0.0,
        Some(InterpolationSpace::Joint) => 1.0,
        None => smooth((from.hand.angle_between(to.hand) - 0.6) / 0.9),
    };
    let straight = from.hand.slerp(to.hand, m);
    if by_wrist <= 0.0 {
        return straight.normalized();
    }
    let a = rig.angles_of_hand(from.wrist, from.hand);
    let b = rig.angles_of_hand(to.wrist, to.hand);
    // What a wrist cannot bend to is off at both ends; the path begins and ends where they are.
    let off =
        |end: &RestingHand, angles| end.hand * rig.hand_from_angles(end.wrist, angles).inverse();
    let off = off(from, &a).slerp(off(to, &b), m);
    let bent = off * rig.hand_from_angles(wrist, &a.lerp(&b, m));
    straight.slerp(bent, by_wrist).normalized()
}

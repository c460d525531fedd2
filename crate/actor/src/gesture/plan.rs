//! From a script to a motion: nodes in time with quintic pieces between them.

use raconteur_base::curve::{last_at_or_before, minimum_jerk, smooth};
use raconteur_base::{DQuat, DVec3, Side, ops};
use raconteur_body::Skeleton;
use raconteur_body::hand_shape::HandAngles;

use super::{ArmScript, HandKey, Rest, Span};
use crate::ArmRig;
use crate::gesture::space::BodySpace;

/// Hands flow directly into a stroke that begins this soon, seconds. Designed.
const FLOW_SECS: f64 = 1.1;
/// Up to this gap hands sink half-way to the ready place between strokes, seconds. Designed.
const SINK_SECS: f64 = 2.3;
/// Longest hold after a stroke, seconds. Designed (holds of some 0.3 to 0.6 s are common).
const HOLD_SECS: f64 = 0.55;
/// How far a held hand sinks, metres: nobody holds quite still.
const HOLD_DRIFT_M: f64 = 0.007;
/// Time for returning to rest, as a multiple of reaching the same distance: retractions
/// are slower than preparations.
const RETRACT_SLOWNESS: f64 = 1.25;
/// Height of the arch of a free movement, as a share of its length and per metre of it.
/// Designed; people's unconstrained reaches are slightly curved, and long ones swing out
/// around the body.
const ARCH_SHARE: f64 = 0.08;
const ARCH_PER_M: f64 = 0.14;
/// A key that repeats the place of the one before within this distance keeps it, metres.
const SAME_PLACE_M: f64 = 1e-6;

/// What a hand should do at one time.
#[derive(Clone, Copy, Debug)]
pub struct HandTarget {
    /// Wrist; in the world for scripted places, relative to the zero pose of the trunk at
    /// rest. [`HandTarget::rest_share`] says how much of either.
    pub wrist: DVec3,
    /// Hand rotation, likewise.
    pub hand: DQuat,
    /// Finger angles.
    pub shape: HandAngles,
    /// 1 at rest (the hand goes with the trunk), 0 in a gesture (it is in the world).
    pub rest_share: f64,
}

/// Which phase an arm is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandState {
    /// At rest.
    Rest,
    /// On its way to a stroke, in it, held, or returning.
    Busy,
}

/// The motion of one arm over the whole story.
#[derive(Clone, Debug)]
pub struct ArmPlan {
    times: Vec<f64>,
    nodes: Vec<Node>,
    rest: Rest,
    rig: ArmRig,
}

/// Where the arm is at one time. The piece to the next node uses this node's `arch`.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// `None` is rest, which moves.
    place: Option<Placed>,
    shape: HandAngles,
    velocity: DVec3,
    /// Bulge of the piece that starts here, metres.
    arch: DVec3,
}

#[derive(Clone, Copy, Debug)]
struct Placed {
    wrist: DVec3,
    hand: DQuat,
}

impl ArmPlan {
    /// Plans one arm. Keys at impossible times or places (not finite) are left out.
    #[must_use]
    pub fn new(script: &ArmScript, skeleton: &Skeleton, side: Side, seed: u64) -> Self {
        let rig = ArmRig::new(skeleton, side);
        let space = BodySpace::new(skeleton);
        let rest = Rest::new(skeleton, &rig, &space, side, seed);
        let mut planner = Planner {
            rig: &rig,
            space: &space,
            rest: &rest,
            side,
            out: Vec::new(),
        };
        for phrase in phrases(script) {
            planner.add(&phrase);
        }
        planner.finish();
        let (times, nodes) = planner.out.into_iter().unzip();
        Self {
            times,
            nodes,
            rest,
            rig,
        }
    }

    /// What the hand should do at a time. O(log n), no allocation.
    #[must_use]
    pub fn at(&self, time_secs: f64) -> HandTarget {
        let rest = self.rest.at(time_secs);
        let at_rest = Placed {
            wrist: rest.wrist,
            hand: rest.hand,
        };
        let resting = HandTarget {
            wrist: rest.wrist,
            hand: rest.hand,
            shape: Rest::shape(),
            rest_share: 1.0,
        };
        let Some(i) = last_at_or_before(&self.times, time_secs) else {
            return resting;
        };
        let (Some(a), Some(b)) = (self.nodes.get(i), self.nodes.get(i + 1)) else {
            return resting;
        };
        let length = self.times[i + 1] - self.times[i];
        let s = if length > 0.0 {
            (time_secs - self.times[i]) / length
        } else {
            0.0
        };
        let (from, to) = (a.place.unwrap_or(at_rest), b.place.unwrap_or(at_rest));
        let m = minimum_jerk(s);
        let wrist = from.wrist
            + (to.wrist - from.wrist) * m
            + a.velocity * (length * start_slope(s))
            + b.velocity * (length * end_slope(s))
            + a.arch * arch(s);
        let share = |p: Option<Placed>| if p.is_none() { 1.0 } else { 0.0 };
        // Fingers form a little before the hand arrives.
        let fingers = minimum_jerk((s * 1.2).min(1.0));
        HandTarget {
            wrist,
            hand: self.turned(&from, &to, wrist, m),
            shape: a.shape.lerp(&b.shape, fingers),
            rest_share: share(a.place) + (share(b.place) - share(a.place)) * m,
        }
    }

    /// Hand rotation on the way from one place to another. Small turns take the short way
    /// in the world, so that a palm kept down stays down; large ones turn as a wrist does,
    /// by the angles that the forearm sees: the short way in the world might lead through
    /// what no arm can do.
    fn turned(&self, from: &Placed, to: &Placed, wrist: DVec3, m: f64) -> DQuat {
        if m <= 0.0 {
            return from.hand;
        }
        if m >= 1.0 {
            return to.hand;
        }
        let straight = from.hand.slerp(to.hand, m);
        let by_wrist = smooth((from.hand.angle_between(to.hand) - 0.6) / 0.9);
        if by_wrist <= 0.0 {
            return straight;
        }
        let a = self.rig.angles_of_hand(from.wrist, from.hand);
        let b = self.rig.angles_of_hand(to.wrist, to.hand);
        let bent = self.rig.hand_from_angles(wrist, &a.lerp(&b, m));
        straight.slerp(bent, by_wrist)
    }

    /// Whether the arm is busy at a time.
    #[must_use]
    pub fn state_at(&self, time_secs: f64) -> HandState {
        let between = last_at_or_before(&self.times, time_secs)
            .and_then(|i| Some((self.nodes.get(i)?, self.nodes.get(i + 1)?)));
        match between {
            Some((a, b)) if a.place.is_some() || b.place.is_some() => HandState::Busy,
            _ => HandState::Rest,
        }
    }
}

/// Zero displacement with slope 1 at the start, slope 0 at the end, no acceleration at
/// either: the quintic of minimum jerk for an initial velocity.
fn start_slope(s: f64) -> f64 {
    s - s * s * s * (6.0 - s * (8.0 - 3.0 * s))
}

/// The same for a final velocity.
fn end_slope(s: f64) -> f64 {
    -s * s * s * (4.0 - s * (7.0 - 3.0 * s))
}

/// A bump of height 1 with neither speed nor acceleration at its ends.
fn arch(s: f64) -> f64 {
    let u = 4.0 * s * (1.0 - s);
    u * u * u
}

/// Time for a movement of this length, seconds: Fitts's law (1954,
/// doi:10.1037/h0055392) with a target width of 5 cm; slope and limits designed.
fn reach_secs(distance_m: f64) -> f64 {
    (0.30 + 0.16 * ops::ln(1.0 + distance_m / 0.05) / core::f64::consts::LN_2).clamp(0.35, 0.9)
}

/// A run of keys within one switched-on span, with the time to hold the last.
struct Phrase {
    keys: Vec<HandKey>,
    hold_until: f64,
    /// No later than this the hand may begin to do something else: the switch-off.
    must_end: f64,
}

/// The script's strokes by time, cut to the switched-on spans.
fn phrases(script: &ArmScript) -> Vec<Phrase> {
    let always = [Span {
        start_secs: f64::NEG_INFINITY,
        end_secs: f64::INFINITY,
    }];
    let spans = if script.on.is_empty() {
        &always[..]
    } else {
        &script.on
    };
    let mut out: Vec<Phrase> = script
        .strokes
        .iter()
        .filter_map(|stroke| {
            let first = stroke
                .keys
                .iter()
                .map(|k| k.time_secs)
                .fold(f64::INFINITY, f64::min);
            let span = spans
                .iter()
                .find(|s| s.start_secs <= first && first <= s.end_secs)?;
            let mut keys: Vec<HandKey> = stroke
                .keys
                .iter()
                .filter(|k| {
                    k.time_secs.is_finite()
                        && k.time_secs <= span.end_secs
                        && k.wrist_in_world.is_none_or(DVec3::is_finite)
                        && k.hand_in_world.is_none_or(DQuat::is_finite)
                })
                .copied()
                .collect();
            keys.sort_by(|a, b| a.time_secs.total_cmp(&b.time_secs));
            let last = keys.last()?.time_secs;
            let end = if stroke.end_secs.is_finite() {
                stroke.end_secs
            } else {
                last
            };
            Some(Phrase {
                hold_until: end.max(last).min(span.end_secs),
                keys,
                must_end: span.end_secs,
            })
        })
        .collect();
    out.sort_by(|a, b| a.keys[0].time_secs.total_cmp(&b.keys[0].time_secs));
    // Where strokes overlap, the later one wins from its first key on.
    for i in 1..out.len() {
        let next = out[i].keys[0].time_secs;
        let before = &mut out[i - 1];
        before.keys.retain(|k| k.time_secs < next - 1e-9);
        before.hold_until = before.hold_until.min(next);
    }
    out.retain(|p| !p.keys.is_empty());
    out
}

struct Planner<'a> {
    rig: &'a ArmRig,
    space: &'a BodySpace,
    rest: &'a Rest,
    side: Side,
    out: Vec<(f64, Node)>,
}

impl Planner<'_> {
    /// Adds a phrase after what is there.
    fn add(&mut self, phrase: &Phrase) {
        let first = phrase.keys[0].time_secs;
        // A return to rest that cannot be finished in time is not begun.
        while self.out.len() > 1
            && self
                .out
                .last()
                .is_some_and(|(t, n)| n.place.is_none() && *t > first - 0.35)
        {
            self.out.pop();
        }
        let hold = match self.out.last().copied() {
            None => None,
            Some((held_until, node)) => self.leave(held_until, node, first),
        };
        let nodes = self.resolve(&phrase.keys, hold);
        if hold.is_none() {
            // From rest: set out in time to be there.
            let from = self.rest.at(first - 0.6).wrist;
            let to = nodes[0].1.place.map_or(from, |p| p.wrist);
            let earliest = self.out.last().map_or(f64::NEG_INFINITY, |n| n.0);
            let start = (first - reach_secs(from.distance(to))).max(earliest);
            self.push(start, rest_node());
        }
        for (time, node) in nodes {
            self.push(time, node);
        }
        if let Some((last, node)) = self.out.last().copied()
            && phrase.hold_until > last
        {
            self.push(phrase.hold_until, sunk(&node, phrase.hold_until - last));
        }
        if phrase.must_end.is_finite()
            && let Some((t, node)) = self.out.last().copied()
        {
            // Switched off: return at once.
            self.retract(t, &node, 0.0);
        }
    }

    /// Leaves the place held since `held_until` towards a stroke at `next`. Returns the
    /// node that the stroke flows from, or `None` after a return to rest.
    fn leave(&mut self, held_until: f64, node: Node, next: f64) -> Option<Node> {
        let place = node.place?;
        let gap = next - held_until;
        if gap <= FLOW_SECS {
            // Hold until it is time to go.
            let depart = (next - 0.85).max(held_until + 0.35 * gap);
            let held = sunk(&node, depart - held_until);
            if depart > held_until + 0.05 {
                self.push(depart, held);
            }
            return Some(held);
        }
        if gap <= SINK_SECS {
            let hold = (0.25 * gap).min(0.4);
            self.push(held_until + hold, sunk(&node, hold));
            let wrist = place.wrist.lerp(self.rest.ready(), 0.5);
            let halfway = Node {
                place: Some(Placed {
                    wrist: self.space.keep_out(wrist),
                    hand: place.hand.slerp(self.rig.relaxed_hand(wrist), 0.4),
                }),
                shape: node.shape.lerp(&Rest::shape(), 0.5),
                velocity: DVec3::ZERO,
                arch: DVec3::ZERO,
            };
            self.push(held_until + hold + 0.42 * gap, halfway);
            return Some(halfway);
        }
        self.retract(held_until, &node, HOLD_SECS);
        None
    }

    /// Holds for a while, then returns to rest.
    fn retract(&mut self, from: f64, node: &Node, hold: f64) {
        let Some(place) = node.place else { return };
        if hold > 0.0 {
            self.push(from + hold, sunk(node, hold));
        }
        let start = from + hold;
        let distance = place.wrist.distance(self.rest.at(start + 1.0).wrist);
        let length = (reach_secs(distance) * RETRACT_SLOWNESS).min(1.15);
        self.push(start + length, rest_node());
    }

    /// Fills in what keys keep from before them.
    fn resolve(&self, keys: &[HandKey], before: Option<Node>) -> Vec<(f64, Node)> {
        let mut place = before.and_then(|n| n.place);
        let mut shape = before.map_or_else(Rest::shape, |n| n.shape);
        let mut relaxed = place.is_none();
        let mut nodes: Vec<(f64, Node)> = Vec::with_capacity(keys.len());
        for key in keys {
            shape = key.shape.unwrap_or(shape);
            let wrist = key.wrist_in_world.or(place.map(|p| p.wrist));
            let wrist = wrist.or_else(|| key.hand_in_world.map(|_| self.rest.ready()));
            if let Some(wrist) = wrist {
                let wrist = self.rig.within_reach(self.space.keep_out(wrist));
                relaxed &= key.hand_in_world.is_none();
                let kept = place.map(|p| p.hand).filter(|_| !relaxed);
                let hand = key
                    .hand_in_world
                    .or(kept)
                    .unwrap_or_else(|| self.rig.relaxed_hand(wrist));
                place = Some(Placed { wrist, hand });
            }
            let node = Node {
                place,
                shape,
                velocity: DVec3::ZERO,
                arch: DVec3::ZERO,
            };
            match nodes.last_mut() {
                // Two keys at one time: the later word counts.
                Some(last) if key.time_secs - last.0 < 1e-6 => last.1 = node,
                _ => nodes.push((key.time_secs, node)),
            }
        }
        nodes
    }

    fn push(&mut self, time: f64, node: Node) {
        // Times never run backwards, whatever a script says.
        let time = self.out.last().map_or(time, |last| time.max(last.0));
        self.out.push((time, node));
    }

    /// Returns to rest after the last phrase, then shapes the path.
    fn finish(&mut self) {
        if let Some((t, node)) = self.out.last().copied() {
            self.retract(t, &node, HOLD_SECS);
        }
        self.pass_through();
        for i in 1..self.out.len() {
            let arch = self.arch_between(i - 1, i);
            self.out[i - 1].1.arch = arch;
        }
    }

    /// Gives keys between two movements in much the same direction the speed to pass
    /// through instead of stopping: the harmonic mean of both speeds along the bisector,
    /// less the sharper the turn, so that the path never overshoots.
    fn pass_through(&mut self) {
        for i in 1..self.out.len().saturating_sub(1) {
            let [a, b, c] = [i - 1, i, i + 1].map(|k| (self.out[k].0, self.out[k].1.place));
            let (Some(pa), Some(pb), Some(pc)) = (a.1, b.1, c.1) else {
                continue;
            };
            let (before, after) = (pb.wrist - pa.wrist, pc.wrist - pb.wrist);
            let (ta, tc) = (b.0 - a.0, c.0 - b.0);
            // A hold begins or ends with the hand at rest.
            let still = |v: DVec3| v.length() < 2.0 * HOLD_DRIFT_M;
            if ta < 1e-3 || tc < 1e-3 || still(before) || still(after) {
                continue;
            }
            let (va, vc) = (before.length() / ta, after.length() / tc);
            let (da, dc) = (before.normalize(), after.normalize());
            let agreement = smooth(da.dot(dc).max(0.0));
            let along = (da + dc).try_normalize().unwrap_or(DVec3::ZERO);
            self.out[i].1.velocity = along * (agreement * 2.0 * va * vc / (va + vc));
        }
    }

    /// Bulge of the piece between two nodes: outwards, forwards and around the body.
    fn arch_between(&self, a: usize, b: usize) -> DVec3 {
        let ((ta, from), (tb, to)) = (self.out[a], self.out[b]);
        let at = |node: &Node, t: f64| {
            node.place
                .map_or_else(|| self.rest.at(t).wrist, |p| p.wrist)
        };
        let (p, q) = (at(&from, ta), at(&to, tb));
        let along = q - p;
        let length = along.length();
        if length < SAME_PLACE_M.max(2.0 * HOLD_DRIFT_M) {
            return DVec3::ZERO;
        }
        let direction = along / length;
        let outwards = DVec3::new(0.8 * self.side.sign(), 0.0, 0.6);
        let square = outwards - direction * direction.dot(outwards);
        let bulge = length.min(0.9);
        let mut arch_m = square * (bulge * (ARCH_SHARE + ARCH_PER_M * bulge));
        // Grow the bulge until the way is free; the rest is eased out on the way.
        for _ in 0..4 {
            let mut worst = DVec3::ZERO;
            for k in 1..12 {
                let s = f64::from(k) / 12.0;
                let at = p + along * minimum_jerk(s) + arch_m * arch(s);
                let out = self.space.way_out(at) / arch(s).max(0.35);
                if out.length_squared() > worst.length_squared() {
                    worst = out;
                }
            }
            if worst.length() < 0.005 {
                break;
            }
            arch_m += worst.clamp_length_max(0.15);
        }
        arch_m
    }
}

fn rest_node() -> Node {
    Node {
        place: None,
        shape: Rest::shape(),
        velocity: DVec3::ZERO,
        arch: DVec3::ZERO,
    }
}

/// A node after a hold of some seconds.
fn sunk(node: &Node, held_secs: f64) -> Node {
    let drop = HOLD_DRIFT_M * (held_secs / HOLD_SECS).clamp(0.0, 1.0);
    let place = node.place.map(|p| Placed {
        wrist: p.wrist - DVec3::Y * drop,
        hand: p.hand,
    });
    Node {
        place,
        velocity: DVec3::ZERO,
        arch: DVec3::ZERO,
        ..*node
    }
}

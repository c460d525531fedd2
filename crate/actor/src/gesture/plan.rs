//! From a script to a motion: nodes in time with quintic pieces between them.

use raconteur_base::curve::{last_at_or_before, minimum_jerk, smooth};
use raconteur_base::{DQuat, DVec3, Side, ops};
use raconteur_body::Skeleton;
use raconteur_body::hand_shape::HandAngles;

use super::fingers::FingerTrack;
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
/// Share by which the fingers of a held hand give way to their relaxed shape. Designed.
const HOLD_SOFTENING: f64 = 0.16;
/// Time for returning to rest, as a multiple of reaching the same distance: retractions
/// are slower than preparations.
const RETRACT_SLOWNESS: f64 = 1.25;
/// Height of the arch of a free movement, as a share of its length and per metre of it.
/// Designed; people's unconstrained reaches are slightly curved, and long ones swing out
/// around the body.
const ARCH_SHARE: f64 = 0.08;
const ARCH_PER_M: f64 = 0.09;
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
    fingers: FingerTrack,
    rest: Rest,
    rig: ArmRig,
}

/// Where the arm is at one time. The piece to the next node uses this node's `arch`.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// `None` is rest, which moves.
    place: Option<Placed>,
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
            fingers: FingerTrack::default(),
        };
        for phrase in phrases(script) {
            planner.add(&phrase);
        }
        planner.finish();
        let (times, nodes) = planner.out.into_iter().unzip();
        Self {
            times,
            nodes,
            fingers: planner.fingers,
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
            shape: self.fingers.at(time_secs),
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
        HandTarget {
            wrist,
            hand: turned(&self.rig, &from, &to, wrist, m),
            shape: resting.shape,
            rest_share: share(a.place) + (share(b.place) - share(a.place)) * m,
        }
    }

    /// The time that the hand needs from where it is at `from_secs`, or from rest, to the
    /// first key of a stroke that nobody saw coming, seconds. `None` for a key that moves the
    /// fingers only.
    #[must_use]
    pub fn time_to(&self, from_secs: f64, wrist_in_world: Option<DVec3>) -> f64 {
        let places = [self.at(from_secs).wrist, self.rest.at(from_secs).wrist];
        let far = |to: DVec3| {
            places
                .map(|p| p.distance(to))
                .into_iter()
                .fold(0.0, f64::max)
        };
        reach_secs(wrist_in_world.map_or(0.0, far))
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

/// Hand rotation on the way from one place to another. Small turns take the short way in the
/// world, so that a palm kept down stays down; large ones turn as a wrist does, by the angles
/// that the forearm sees: the short way in the world might lead through what no arm can do.
fn turned(rig: &ArmRig, from: &Placed, to: &Placed, wrist: DVec3, m: f64) -> DQuat {
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
    let a = rig.angles_of_hand(from.wrist, from.hand);
    let b = rig.angles_of_hand(to.wrist, to.hand);
    let bent = rig.hand_from_angles(wrist, &a.lerp(&b, m));
    straight.slerp(bent, by_wrist)
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
            raconteur_base::order::sort_by_number(&mut keys, |k| k.time_secs);
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
    raconteur_base::order::sort_by_number(&mut out, |p| p.keys[0].time_secs);
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
    fingers: FingerTrack,
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
            let last = self.out.last().map_or(f64::NEG_INFINITY, |n| n.0);
            self.fingers.forget_after(last);
        }
        let hold = match self.out.last().copied() {
            None => None,
            Some((held_until, node)) => self.leave(held_until, node, first),
        };
        let left = self.out.last().map_or(first, |n| n.0);
        let nodes = self.resolve(&phrase.keys, hold.map(|place| (left, place)));
        if hold.is_none() {
            // From rest: set out in time to be there.
            let from = self.rest.at(first - 0.6).wrist;
            let to = nodes[0].1.map_or(from, |p| p.wrist);
            let earliest = self.out.last().map_or(f64::NEG_INFINITY, |n| n.0);
            let start = (first - reach_secs(from.distance(to))).max(earliest);
            self.push(start, Node::at(None));
            self.fingers.push(start, self.fingers.last());
        }
        for (time, place) in nodes {
            self.push(time, Node::at(place));
        }
        for key in &phrase.keys {
            if let Some(shape) = key.shape {
                self.fingers.push(key.time_secs, shape);
            }
        }
        if let Some((last, node)) = self.out.last().copied() {
            self.hold(last, &node, phrase.hold_until);
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
    fn leave(&mut self, held_until: f64, node: Node, next: f64) -> Option<Placed> {
        let gap = next - held_until;
        let place = match node.place {
            Some(place) => place,
            None if gap <= FLOW_SECS => return None,
            None => {
                self.retract(held_until, &node, HOLD_SECS);
                return None;
            }
        };
        if gap <= FLOW_SECS {
            // Hold until it is time to go.
            let depart = (next - 0.85).max(held_until + 0.35 * gap);
            if depart > held_until + 0.05 {
                self.hold(held_until, &node, depart);
            }
            return self.out.last().and_then(|n| n.1.place);
        }
        if gap <= SINK_SECS {
            let hold = (0.25 * gap).min(0.4);
            self.hold(held_until, &node, held_until + hold);
            let wrist = place.wrist.lerp(self.rest.ready(), 0.5);
            let halfway = Placed {
                wrist: self.space.keep_out(wrist),
                hand: place.hand.slerp(self.rig.relaxed_hand(wrist), 0.4),
            };
            let there = held_until + hold + 0.42 * gap;
            self.push(there, Node::at(Some(halfway)));
            let fingers = self.fingers.last().lerp(&Rest::shape(), 0.5);
            self.fingers.push(there, fingers);
            return Some(halfway);
        }
        self.retract(held_until, &node, HOLD_SECS);
        None
    }

    /// Holds what is reached at `from` until a later time: it sinks a little, and the
    /// fingers ease.
    fn hold(&mut self, from: f64, node: &Node, until: f64) {
        if until <= from {
            return;
        }
        let share = ((until - from) / HOLD_SECS).min(1.0);
        let sunk = node.place.map(|p| Placed {
            wrist: p.wrist - DVec3::Y * (HOLD_DRIFT_M * share),
            hand: p.hand,
        });
        self.push(until, Node::at(sunk));
        // Fingers that have keys of their own to the end of a stroke begin to ease there.
        let shape = self.fingers.last();
        self.fingers.push(from, shape);
        self.fingers
            .push(until, shape.lerp(&Rest::shape(), HOLD_SOFTENING * share));
    }

    /// Holds for a while, then returns to rest.
    fn retract(&mut self, from: f64, node: &Node, hold: f64) {
        let start = from + hold;
        self.hold(from, node, start);
        let rest = self.rest.at(start + 1.0).wrist;
        let distance = node.place.map_or(0.0, |p| p.wrist.distance(rest));
        let length = (reach_secs(distance) * RETRACT_SLOWNESS).min(1.15);
        self.push(start + length, Node::at(None));
        self.fingers.push(start + length, Rest::shape());
    }

    /// The place at each key's time. Wrist and hand keep their own clocks: a key that says
    /// nothing of one lies on its way, from `before` or a key, to the next key that does.
    fn resolve(
        &self,
        keys: &[HandKey],
        before: Option<(f64, Placed)>,
    ) -> Vec<(f64, Option<Placed>)> {
        // What flows in from an earlier stroke is a key before the first.
        let left = before.map_or(f64::NEG_INFINITY, |b| b.0);
        let mut times = vec![left.min(keys[0].time_secs)];
        times.extend(keys.iter().map(|k| k.time_secs));
        let reachable = |w: DVec3| self.rig.within_reach(self.space.keep_out(w));
        let mut wrists = vec![before.map(|b| b.1.wrist)];
        wrists.extend(keys.iter().map(|k| k.wrist_in_world.map(reachable)));
        let mut hands = vec![before.map(|b| b.1.hand)];
        hands.extend(keys.iter().map(|k| k.hand_in_world));
        if before.is_none() && wrists[1].is_none() && hands[1].is_some() {
            wrists[1] = Some(self.rest.ready());
        }
        fill(&times, &mut wrists, |a, b, s| a.1.lerp(b.1, s));
        let at = wrists.clone();
        fill(&times, &mut hands, |a, b, s| {
            let placed = |i: usize, hand| at[i].map(|wrist| Placed { wrist, hand });
            match (placed(a.0, a.1), placed(b.0, b.1)) {
                (Some(from), Some(to)) => {
                    turned(self.rig, &from, &to, from.wrist.lerp(to.wrist, s), s)
                }
                _ => a.1.slerp(b.1, s),
            }
        });
        let (wrists, hands) = (&wrists[1..], &hands[1..]);
        let mut nodes: Vec<(f64, Option<Placed>)> = Vec::with_capacity(keys.len());
        for (i, key) in keys.iter().enumerate() {
            let place = wrists[i].map(|wrist| Placed {
                wrist,
                hand: hands[i].unwrap_or_else(|| self.rig.relaxed_hand(wrist)),
            });
            let only_fingers = key.wrist_in_world.is_none() && key.hand_in_world.is_none();
            if i > 0 && only_fingers {
                continue;
            }
            match nodes.last_mut() {
                // Two keys at one time: the later word counts.
                Some(last) if key.time_secs - last.0 < 1e-6 => last.1 = place,
                _ => nodes.push((key.time_secs, place)),
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

impl Node {
    /// A node at which the hand stops.
    fn at(place: Option<Placed>) -> Self {
        Self {
            place,
            velocity: DVec3::ZERO,
            arch: DVec3::ZERO,
        }
    }
}

/// Gives values without one what lies, by time, between the values around them, or else
/// the last value before. `blend` takes two values with their places in the list.
fn fill<T: Copy>(
    times: &[f64],
    values: &mut [Option<T>],
    blend: impl Fn((usize, T), (usize, T), f64) -> T,
) {
    let mut before: Option<(usize, T)> = None;
    for i in 0..values.len() {
        if let Some(value) = values[i] {
            before = Some((i, value));
            continue;
        }
        let Some(a) = before else { continue };
        let next = (i + 1..values.len()).find_map(|k| values[k].map(|v| (k, v)));
        values[i] = Some(match next {
            Some(b) => {
                let length = times[b.0] - times[a.0];
                let s = if length > 0.0 {
                    (times[i] - times[a.0]) / length
                } else {
                    1.0
                };
                blend(a, b, s)
            }
            None => a.1,
        });
    }
}

//! Growth of hair from its root along the combing field.

use raconteur_base::{DVec3, ops};

use super::comb::{Field, step, stray};
use super::space::Space;

/// Minimum height of hair over the skin, metres.
pub(super) const CLEAR_M: f64 = 0.0012;
/// Rate at which a hair turns to its preferred direction, 1/m.
const TURN_PER_M: f64 = 40.0;
/// Share of its excess height by which a hair descends per step.
const DRAWN: f64 = 0.25;
/// Share of its missing height by which a hair is pushed out per step.
const PUSHED: f64 = 0.55;

/// Look-ahead distance for shoulders, metres.
const AHEAD_M: f64 = 0.03;
/// Heights from which hair may lie on a shoulder, and below which it always does, metres.
const UNDER_JAW_M: [f64; 2] = [-0.08, -0.12];
/// Breadth from the middle within which hair hangs past the neck, metres.
const BESIDE_NECK_M: [f64; 2] = [0.072, 0.110];
/// Hair rooted behind this falls down the back, all other before the shoulders, metres.
const BACK_Z_M: f64 = -0.070;

/// Growth parameters of one hair, from which its path is traced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Growth {
    pub(super) root: DVec3,
    pub(super) normal: DVec3,
    /// Metres.
    pub(super) length: f64,
    pub(super) step: f64,
    /// Target height, and the length within which it is reached, metres.
    pub(super) offset: f64,
    pub(super) rise: f64,
    /// Angle at which it leaves the skin, radians.
    pub(super) lift: f64,
    /// Amplitude of bends in both directions, and their frequency per metre.
    pub(super) bend: [f64; 2],
}

/// Points at equal steps from the root, one more than the length needs.
pub(super) fn grow(space: &Space, field: &Field, g: &Growth, seed: u64) -> Vec<DVec3> {
    let flat = |d: DVec3, n: DVec3| (d - n * d.dot(n)).normalize_or(DVec3::NEG_Y);
    let mut at = g.root - g.normal * 0.0006;
    let first = flat(field.direction(g.root, g.root, 0.0), g.normal);
    let mut direction = first * ops::cos(g.lift) + g.normal * ops::sin(g.lift);
    let mut out = vec![at];
    let count = (g.length / g.step).ceil() as usize + 1;
    let share = 1.0 - ops::exp(-TURN_PER_M * g.step);
    for k in 1..=count {
        let arc = (k - 1) as f64 * g.step;
        let (n, height) = (space.normal(at), space.height(at));
        // Far from the head, the combing has no effect.
        let near = ops::exp(-(height - g.offset).max(0.0) / 0.02);
        let comb = flat(field.direction(g.root, at, arc), n) * near;
        let w = field.gravity(arc);
        let fade = step(0.0, 0.03, arc);
        let wanted = comb * (1.0 - w)
            + DVec3::NEG_Y * w
            + draped(space, g.root, at)
            + stray(seed + 21, at, g.bend[1]) * (g.bend[0] * fade);
        direction = direction
            .lerp(wanted.normalize_or(direction), share)
            .normalize_or(direction);
        let mut next = at + direction * g.step;
        let want = (g.offset * (1.0 - ops::exp(-arc / g.rise))).max(CLEAR_M);
        let (n, height) = (space.normal(next), space.height(next));
        let error = want - height;
        next += n * if error > 0.0 {
            error * PUSHED
        } else {
            error.max(-0.004) * DRAWN * ops::exp(-(height - want).max(0.0) / 0.012)
        };
        next = space.pushed(next, CLEAR_M);
        direction = (next - at).normalize_or(direction);
        at += direction * g.step;
        out.push(at);
    }
    out
}

/// Returns the direction of hair that reaches a shoulder: hair of the back of the head turns behind
/// it, the rest in front, and all of it towards the neck. Otherwise hair would slide down the arms
/// and fan out.
fn draped(space: &Space, root: DVec3, at: DVec3) -> DVec3 {
    let below = at + DVec3::NEG_Y * AHEAD_M;
    let near = step(2.0 * AHEAD_M, 0.3 * AHEAD_M, space.height(below));
    let level =
        step(0.15, 0.75, space.normal(below).y) * step(UNDER_JAW_M[0], UNDER_JAW_M[1], at.y);
    let way = if root.z > BACK_Z_M { 1.0 } else { -1.0 };
    let beside = step(BESIDE_NECK_M[0], BESIDE_NECK_M[1], at.x.abs());
    let inwards = DVec3::X * (-0.7 * at.x.signum() * beside * step(-0.02, UNDER_JAW_M[0], at.y));
    DVec3::Z * (1.6 * way * near * level) + inwards
}

/// Evens a path out, its first two points left where they are.
pub(super) fn smooth(path: &mut [DVec3], times: usize) {
    for _ in 0..times {
        let before = path.to_vec();
        for i in 2..before.len().saturating_sub(1) {
            path[i] = before[i] * 0.5 + (before[i - 1] + before[i + 1]) * 0.25;
        }
    }
}

/// Returns the point of the path at arc length `arc` metres, its points `step` apart.
fn along(path: &[DVec3], step: f64, arc: f64) -> DVec3 {
    let i = (arc / step).clamp(0.0, path.len() as f64 - 1.001);
    let k = i as usize;
    path[k].lerp(path[k + 1], i - k as f64)
}

/// Returns the unit direction of the path at point `i`.
pub(super) fn tangent(path: &[DVec3], i: usize) -> DVec3 {
    let (a, b) = (i.saturating_sub(1), (i + 1).min(path.len() - 1));
    (path[b] - path[a]).normalize_or(DVec3::NEG_Y)
}

/// Points of a path at equal shares of a length.
pub(super) fn sampled(path: &[DVec3], step: f64, length: f64, spans: usize) -> Vec<DVec3> {
    (0..=spans)
        .map(|i| along(path, step, length * i as f64 / spans as f64))
        .collect()
}

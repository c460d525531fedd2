//! Paths between positions: through some without a stop, and curved around the body.

use raconteur_base::curve::smooth;
use raconteur_base::{DVec3, Length};

use super::{HOLD_DRIFT_M, Planner};
use crate::gesture::pace::SAME_PLACE_M;
use crate::gesture::path::{ArcPath, reach_secs};

/// Height of the arch of a free movement, as a share of its length and per metre of it.
/// Designed; people's unconstrained reaches are slightly curved, and long ones swing out
/// around the body.
const ARCH_SHARE: f64 = 0.08;
const ARCH_PER_M: f64 = 0.09;

impl Planner<'_> {
    /// Gives keys between two movements in similar directions a speed to pass through instead of
    /// stopping: the harmonic mean of both speeds along the bisector, reduced by the sharpness of
    /// the turn, so the path never overshoots.
    pub(super) fn pass_through(&mut self) {
        let track = &mut self.out.wrist;
        for i in 1..track.nodes.len().saturating_sub(1) {
            let places = [i - 1, i, i + 1].map(|k| track.nodes[k].place);
            let [Some(pa), Some(pb), Some(pc)] = places else {
                continue;
            };
            if !(track.is_free(i - 1) && track.is_free(i)) {
                continue;
            }
            let (before, after) = (pb - pa, pc - pb);
            let [ta, tb, tc] = [i - 1, i, i + 1].map(|k| track.times[k]);
            let (ta, tc) = (tb - ta, tc - tb);
            // The hand is at rest at the start and the end of a hold.
            let still = |v: DVec3| v.magnitude() < 2.0 * HOLD_DRIFT_M;
            if ta < 1e-3 || tc < 1e-3 || still(before) || still(after) {
                continue;
            }
            let (va, vc) = (before.magnitude() / ta, after.magnitude() / tc);
            let (da, dc) = (before.normalized(), after.normalized());
            let agreement = smooth(da.dot(dc).max(0.0));
            let along = (da + dc).try_normalized().unwrap_or(DVec3::ZERO);
            track.nodes[i].velocity = along * (agreement * 2.0 * va * vc / (va + vc));
        }
    }

    /// Returns the bulge of the wrist path between two nodes, outwards, forwards and around the
    /// body, metres.
    pub(super) fn arch_between(&self, a: usize, b: usize) -> DVec3 {
        let track = &self.out.wrist;
        let at = |k: usize| {
            let rest = || self.rest.sample(track.times[k]).wrist;
            track.nodes[k].place.unwrap_or_else(rest)
        };
        let (p, q) = (at(a), at(b));
        let along = q - p;
        let length = along.magnitude();
        if length < SAME_PLACE_M.max(2.0 * HOLD_DRIFT_M) {
            return DVec3::ZERO;
        }
        let direction = along / length;
        let outwards = DVec3::new(0.8 * self.side.sign(), 0.0, 0.6);
        let square = outwards - direction * direction.dot(outwards);
        // A motion with little time takes the straight path.
        let leisure = ((track.times[b] - track.times[a]) / reach_secs(length)).min(1.0);
        let bulge = length.min(0.9) * leisure;
        let mut bow = ArcPath {
            along,
            arch: square * (bulge * (ARCH_SHARE + ARCH_PER_M * bulge)),
        };
        // The bulge grows until the path is clear; the path eases out the remaining penetration.
        for _ in 0..4 {
            let mut worst = DVec3::ZERO;
            for k in 1..12 {
                let u = f64::from(k) / 12.0;
                let out = self.space.wrist_exit_displacement(p + bow.place(u))
                    / (4.0 * u * (1.0 - u)).max(0.35);
                if out.length_squared() > worst.length_squared() {
                    worst = out;
                }
            }
            if worst.magnitude() < 0.005 {
                break;
            }
            bow.arch += worst.clamp_length_max(0.15);
        }
        bow.arch
    }
}

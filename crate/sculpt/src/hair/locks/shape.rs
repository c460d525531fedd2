//! Shaping of a grown hair path: it gathers, waves, is cut, or removed.

use std::f64::consts::TAU;

use raconteur_base::{DVec3, ops};

use super::{Grower, Hair, Lock};
use crate::hair::comb::step;
use crate::hair::grow::tangent;
use crate::hair::style::{Comb, Length};
use crate::texture::space_noise;

/// Hair is tied within this distance of the tie, metres.
const TIED_M: f64 = 0.012;
/// Rejection limits: cards that turn by more within 12 mm (radians), that point outward by more of
/// their length, that stand off farther (metres).
const MAX_TURN: f64 = 0.70;
/// Waves shorter than this are curls, metres.
const CURL_M: f64 = 0.08;
const MAX_OUTWARD: f64 = 0.55;
const MAX_HEIGHT_M: f64 = 0.036;
/// Distance on a shoulder beyond which hair is dropped, metres.
const MAX_WIDTH_M: f64 = 0.122;

impl Grower<'_> {
    /// Draws a path to its lock's, the farther from the root the more; depth stays.
    pub(super) fn gather(&self, path: &mut [DVec3], lock: &Lock, share: f64, length: f64) {
        let step_m = self.step();
        let is_short = self.is_short();
        let guide = |k: usize| lock.path[k.min(lock.path.len() - 1)];
        let far = path
            .iter()
            .enumerate()
            .map(|(k, p)| p.distance(guide(k)))
            .fold(0.0, f64::max);
        // Diverging locks are not dragged across one another.
        let near = if is_short {
            step(0.035, 0.013, far)
        } else {
            step(0.06, 0.022, far)
        };
        for (k, p) in path.iter_mut().enumerate() {
            let arc = k as f64 * step_m;
            let w = share
                * near
                * if is_short {
                    ops::pow((arc / length).clamp(0.0, 1.0), 1.3)
                } else {
                    step(0.04, 0.2, arc)
                };
            let off = *p - guide(k);
            let n = self.space.hull_normal(*p);
            *p = guide(k) + off * (1.0 - w) + n * (off.dot(n) * w * 0.8);
        }
    }

    /// Waves that neighbours nearly share.
    pub(super) fn wave(&self, path: &mut [DVec3], lock: &Lock, own_phase: f64) {
        let [reach, pace] = self.style.wave;
        let reach = reach * self.params.wave * (1.0 + 0.25 * lock.character[1]);
        if reach <= 0.0 {
            return;
        }
        let pace = pace * (1.0 + 0.1 * lock.character[2]);
        let phase = 1.5 * space_noise(self.params.seed + 31, lock.root * 9.0)
            + 0.18 * lock.character[0]
            + own_phase;
        let straight = path.to_vec();
        for (k, p) in path.iter_mut().enumerate() {
            let arc = k as f64 * self.step();
            let n = self.space.hull_normal(straight[k]);
            let side = tangent(&straight, k).cross(n).normalize_or_zero();
            let amount = reach * step(0.045, 0.14, arc);
            let turn = TAU * arc / pace + phase;
            *p += side * (amount * ops::sin(turn)) + n * (0.55 * amount * ops::cos(turn + 0.5));
        }
    }

    /// Returns the length at which the hair ends, metres from its root; turns the ends of a hem in.
    pub(super) fn trim(&self, path: &mut [DVec3], hair: &Hair<'_>, length: f64) -> Option<f64> {
        let Hair { layer, root, .. } = hair;
        let dice = [3, 4].map(|k| hair.dice.unit(k));
        let step_m = self.step();
        let last = (path.len() - 2) as f64 * step_m;
        let cut = match self.style.length {
            Length::Short { .. } => length,
            Length::ToTie => {
                let Comb::Tied(tie) = self.style.comb else {
                    return None;
                };
                let at = path.iter().position(|p| p.distance(tie) < TIED_M);
                let end = at.unwrap_or_else(|| {
                    (0..path.len())
                        .min_by(|a, b| path[*a].distance(tie).total_cmp(&path[*b].distance(tie)))
                        .unwrap_or(0)
                });
                (end as f64 * step_m * (1.0 - 0.6 * layer.uneven * dice[0])).max(0.03)
            }
            Length::Hem {
                hem,
                layered,
                front,
            } => {
                let front = front * step(0.0, 0.06, root.position.z);
                let line = hem * self.params.length - front
                    + layered * layer.uneven * ops::pow(dice[0], 1.5)
                    + 0.004 * space_noise(self.params.seed + 5, root.position * 30.0);
                let end = path
                    .iter()
                    .position(|p| p.y < line)
                    .unwrap_or(path.len() - 1);
                let shorter = if layer.uneven > 1.2 {
                    0.45 + 0.55 * dice[1]
                } else if layer.uneven > 0.2 && dice[1] < 0.25 {
                    1.0 - dice[1]
                } else {
                    1.0
                };
                (end as f64 * step_m).max(0.05).min(length) * shorter
            }
        }
        .min(last);
        if matches!(self.style.length, Length::Hem { .. }) {
            for (k, p) in path.iter_mut().enumerate() {
                let e = ((k as f64 * step_m - cut + 0.05) / 0.05).clamp(0.0, 1.0);
                // On a shoulder there is no room to turn in.
                let e = e * step(0.012, 0.03, self.space.whole.sample(*p));
                *p -= self.space.hull_normal(*p) * (0.009 * e * e);
            }
        }
        Some(cut)
    }

    pub(super) fn is_wearable(&self, path: &[DVec3], length: f64) -> bool {
        if matches!(self.style.length, Length::Short { .. }) {
            return true;
        }
        let step_m = self.step();
        let end = ((length / step_m) as usize).min(path.len() - 1);
        for k in (4..end.saturating_sub(3)).filter(|k| *k as f64 * step_m > 0.012) {
            let (a, b) = (path[k] - path[k - 3], path[k + 3] - path[k]);
            // Curls turn by nature.
            let is_curl = self.style.wave[1] < CURL_M;
            if !is_curl && a.angle_between(b) > MAX_TURN {
                return false;
            }
            let p = path[k];
            if p.x.abs() > MAX_WIDTH_M {
                return false;
            }
            if p.y > -0.09 && k as f64 * step_m > 0.03 {
                let out = tangent(path, k).dot(self.space.hull_normal(p));
                if out > MAX_OUTWARD || self.space.height_without_ears(p) > MAX_HEIGHT_M {
                    return false;
                }
            }
        }
        true
    }
}

//! Baked light within hair: the share of all directions from which light reaches a point through
//! the surrounding hair.
//!
//! Strands are distributed over a grid of densities, and light loses `exp(−optical depth)` on its
//! path (Beer–Lambert). The renderer takes the direction from the hull's normal: on a bob, the
//! transmittance along it is 1.85 times the mean.

use std::f64::consts::TAU;

use raconteur_base::{DVec3, ops};

use super::card::Card;
use super::grid::{Grid, Lattice};
use super::space::{SkinPoint, Space};

/// Pitch of the grid of densities, metres.
const PITCH_M: f64 = 0.005;
/// Optical depth of a metre of hair whose cards cover a square metre in a cubic one.
const DEPTH: f64 = 0.33;
/// Area of cards per cubic metre above which cards only overlap. Without this limit, hair gathered
/// over a shoulder would be black.
const MAX_DENSE: f32 = 600.0;
/// Directions on the sphere.
const DIRECTIONS: usize = 40;
/// Steps of a ray and their length, metres.
const STEPS: usize = 26;
const STEP_M: f64 = 0.006;
/// Optical depth of a metre inside the head, for each metre of depth.
const HEAD_DEPTH: f64 = 9e4;
/// Optical depth beyond which no light passes.
const DARK: f64 = 6.0;

/// Occluders of the light on hair: a density grid of the strands and the head.
pub(super) struct Shade<'a> {
    space: &'a Space,
    density: Grid,
}

/// Returns the opacity of a strip of the atlas.
fn fullness(strip: u32) -> f64 {
    match strip {
        0..5 => 1.0,
        5..10 => 0.62,
        10..13 => 0.3,
        _ => 0.08,
    }
}

/// Directions evenly over the sphere (Fibonacci's spiral).
fn directions() -> impl Iterator<Item = DVec3> {
    (0..DIRECTIONS).map(|i| {
        let y = 1.0 - (2.0 * i as f64 + 1.0) / DIRECTIONS as f64;
        let r = (1.0 - y * y).sqrt();
        let turn = i as f64 * TAU * 0.618_034;
        DVec3::new(r * ops::cos(turn), y, r * ops::sin(turn))
    })
}

impl<'a> Shade<'a> {
    pub(super) fn new(space: &'a Space, cards: &[Card]) -> Self {
        let of = space.whole.lattice;
        let lattice = Lattice {
            low: of.low,
            pitch: PITCH_M,
            size: of
                .size
                .map(|n| ((n - 1) as f64 * of.pitch / PITCH_M) as usize + 1),
        };
        let mut density = Grid::new(lattice, |_| 0.0);
        let volume = PITCH_M * PITCH_M * PITCH_M;
        for card in cards {
            let full = fullness(card.strip);
            for i in 1..card.rows.len() {
                let (a, b) = (card.rows[i - 1].middle(), card.rows[i].middle());
                let area = full * a.distance(b) * 0.5 * (card.width(i - 1) + card.width(i));
                let parts = (a.distance(b) / PITCH_M).ceil().max(1.0) as usize;
                for k in 0..parts {
                    let at = a.lerp(b, (k as f64 + 0.5) / parts as f64);
                    density.splat(at, area / parts as f64 / volume);
                }
            }
        }
        let mut density = density.blurred(1);
        for d in &mut density.values {
            *d = d.min(MAX_DENSE);
        }
        Self { space, density }
    }

    /// Returns the share of light that reaches `p` from `d`, starting `off` metres away.
    fn transmittance(&self, p: DVec3, d: DVec3, off: f64) -> f64 {
        let mut depth = 0.0;
        let mut at = p + d * off;
        for _ in 0..STEPS {
            if !self.density.lattice.contains(at) {
                break;
            }
            depth += self.density.sample(at) * STEP_M * DEPTH;
            let height = self.space.whole.sample(at);
            if height < -0.002 {
                depth -= height * STEP_M * HEAD_DEPTH;
            }
            if depth > DARK {
                return 0.0;
            }
            at += d * STEP_M;
        }
        ops::exp(-depth)
    }

    /// Returns the mean share over all directions at a position in the hair.
    pub(super) fn mean(&self, p: DVec3) -> f64 {
        directions()
            .map(|d| self.transmittance(p, d, STEP_M))
            .sum::<f64>()
            / DIRECTIONS as f64
    }

    /// Returns the mean share over the directions above a point of the skin.
    pub(super) fn on_skin(&self, s: &SkinPoint) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for d in directions().filter(|d| d.dot(s.normal) > 0.05) {
            // The head's own shade is known already: rays begin above the skin.
            sum += self.through_hair(s.position + s.normal * 0.002, d);
            count += 1.0;
        }
        if count > 0.0 { sum / count } else { 1.0 }
    }

    /// Returns the share of light transmitted by the hair alone to `p` from `d`.
    fn through_hair(&self, p: DVec3, d: DVec3) -> f64 {
        let depth: f64 = (0..STEPS)
            .map(|k| p + d * (k as f64 * STEP_M))
            .take_while(|at| self.density.lattice.contains(*at))
            .map(|at| self.density.sample(at) * STEP_M * DEPTH)
            .sum();
        // The running sums of a blur leave remainders below zero.
        ops::exp(-depth.max(0.0))
    }
}

/// Length from which a card's rows have their own light, metres; on shorter ones a part of the
/// mean, or dark roots would show as scales.
const OWN_LIGHT_M: f64 = 0.08;

/// Bakes the light into every row of every card.
pub(super) fn bake(shade: &Shade<'_>, cards: &mut [Card]) {
    for card in cards {
        for row in &mut card.rows {
            row.light = shade.mean(row.middle() + row.hull * 0.001);
        }
        let count = card.rows.len() as f64;
        let mean = card.rows.iter().map(|r| r.light).sum::<f64>() / count;
        let own = (card.length() / OWN_LIGHT_M).min(1.0);
        for row in &mut card.rows {
            row.light = mean + (row.light - mean) * own;
        }
    }
}

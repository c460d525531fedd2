//! Under-cap: paint on the scalp below the cards, so that no skin shines through. It consists of
//! short strokes along the combing, over a ground even further inside the line.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec2, DVec3, noise, ops};

use super::comb::{Field, step};
use super::line::{HALF_M, Line, flat};
use super::locks::normal;
use super::roots::Root;
use super::space::Space;
use super::style::{Comb, Style};
use crate::texture::space_noise;

/// Side of the map of the flat scalp, texels.
const SIDE: usize = 1024;
/// Strokes and steps of a stroke.
const STROKES: usize = 13_000;
const STEPS: usize = 9;
/// Width of a stroke, texels.
const STROKE: f64 = 0.62;
/// Share of the even ground.
const GROUND: f64 = 0.93;
/// Share of the painted hair that covers a parting.
const ON_PARTING: f64 = 0.60;
/// Tone where nothing is painted.
const PLAIN: f64 = 0.45;
/// Distance from the head without ears above which skin counts as ear, metres.
const ON_EAR_M: f64 = 0.004;

/// Scalp of a head: its distance field, its hairline and the combing field of the hair.
pub(super) struct Scalp {
    pub(super) space: Space,
    pub(super) line: Line,
    pub(super) field: Field,
}

/// Hair painted on the scalp below the hair cards, so that the skin does not show between them.
pub(crate) struct Cap {
    /// Share of hair and its tone, on the flat scalp.
    strokes: Vec<[f32; 2]>,
    scalp: Scalp,
    solid: f64,
    /// Linear RGB of hair at its root.
    colour: [f64; 3],
    seed: u64,
}

impl Cap {
    pub(super) fn new(
        scalp: Scalp,
        style: &Style,
        places: &[Root],
        colour: [f64; 3],
        seed: u64,
    ) -> Self {
        let mut cap = Self {
            strokes: vec![[0.0, PLAIN as f32]; SIDE * SIDE],
            scalp,
            solid: style.solid,
            colour,
            seed,
        };
        cap.draw(style, places);
        cap
    }

    fn draw(&mut self, style: &Style, places: &[Root]) {
        let length = if matches!(style.comb, Comb::Coily) {
            0.006
        } else {
            0.013
        };
        let pace = length / STEPS as f64;
        for (i, root) in (0i64..).zip(places.iter().take(STROKES * 3)) {
            let dice = |k: u64| noise::unit(self.seed + 5, k, i);
            let dense =
                ops::pow(step(-0.007, 0.010, root.inside), 1.3) * self.off_parting(root.position);
            if dice(0) > dense {
                continue;
            }
            let reach = 0.5 + 0.8 * dice(1);
            let own = reach * (0.40 + 0.60 * step(-0.006, 0.008, root.inside));
            let share = 0.16 + 0.84 * step(-0.006, 0.012, root.inside);
            let width = STROKE * (0.50 + 0.50 * step(-0.004, 0.01, root.inside));
            let tone = (0.5 + 0.24 * normal(self.seed + 6, 3, i)).clamp(0.0, 1.0);
            let mut at = root.position;
            for k in 0..(own * STEPS as f64) as usize {
                let n = self.scalp.space.normal(at);
                let d = self.scalp.field.direction(root.position, at, 0.0);
                let d = (d - n * d.dot(n)).normalize_or(DVec3::NEG_Y)
                    + super::comb::stray(self.seed + 9, at, 250.0) * 0.22;
                let next = at + d.normalize_or(DVec3::NEG_Y) * pace;
                let thin = 1.0 - 0.45 * k as f64 / STEPS as f64;
                self.stroke(flat(at), flat(next), width * thin, share * thin, tone);
                at = next;
            }
        }
    }

    fn stroke(&mut self, from: DVec2, to: DVec2, width: f64, share: f64, tone: f64) {
        let texel = |p: DVec2| (p / HALF_M + 1.0) * 0.5 * SIDE as f64;
        let (a, b) = (texel(from), texel(to));
        let count = (2.0 * a.distance(b)).ceil().clamp(1.0, 64.0) as usize;
        for k in 0..count {
            let p = a.lerp(b, k as f64 / count as f64);
            let low = (p - width - 0.5).floor().max(DVec2::ZERO);
            let high = (p + width + 0.5).min(DVec2::splat(SIDE as f64 - 1.0));
            for y in low.y as usize..=high.y as usize {
                for x in low.x as usize..=high.x as usize {
                    let d = DVec2::new(x as f64 + 0.5, y as f64 + 0.5).distance(p);
                    let c = ((width + 0.35 - d).clamp(0.0, 1.0) * share) as f32;
                    let [had, was] = &mut self.strokes[y * SIDE + x];
                    if c > *had {
                        *had += (c - *had) * 0.7;
                    }
                    *was += (tone as f32 - *was) * 0.6 * c;
                }
            }
        }
    }

    /// Returns the coverage of painted hair near the parting: reduced on the parting, where skin is
    /// visible between roots, 1 away from it.
    fn off_parting(&self, p: DVec3) -> f64 {
        let ragged = 0.0003 * space_noise(self.seed + 2, p * 500.0);
        lerp(
            ON_PARTING,
            1.0,
            step(0.0, 0.0024, self.scalp.field.off_parting(p) + ragged),
        )
    }

    /// Returns the colour of hair at a position of the head's skin, in the frame of the head,
    /// metres, and its coverage; `None` away from the scalp.
    pub(crate) fn sample(&self, p: DVec3) -> Option<([f64; 3], f64)> {
        let q = self.scalp.space.frame.place(p);
        if q.y < -0.10 || self.scalp.space.height_without_ears(q) > ON_EAR_M {
            return None;
        }
        let inside = self.scalp.line.distance(q);
        if inside < -0.02 {
            return None;
        }
        let texel = ((flat(q) / HALF_M + 1.0) * 0.5 * SIDE as f64 - 0.5)
            .clamp(DVec2::ZERO, DVec2::splat(SIDE as f64 - 1.001));
        let cell = texel.floor();
        let f = texel - cell;
        let first = cell.y as usize * SIDE + cell.x as usize;
        let read = |k: usize| {
            let v = |i: usize| f64::from(self.strokes[i][k]);
            let low = v(first) + (v(first + 1) - v(first)) * f.x;
            let high = v(first + SIDE) + (v(first + SIDE + 1) - v(first + SIDE)) * f.x;
            low + (high - low) * f.y
        };
        let ragged = 0.003 * space_noise(self.seed + 3, q * 220.0);
        let ground = GROUND * step(0.003, self.solid, inside + ragged) * self.off_parting(q);
        let (drawn, tone) = (read(0), read(1));
        let tone = if ground > drawn { 0.75 * tone } else { tone };
        let colour = self.colour.map(|c| c * (0.28 + 1.25 * tone));
        Some((colour, drawn.max(ground)))
    }
}

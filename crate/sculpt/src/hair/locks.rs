//! Locks: cards of every layer, drawn to the guides of their locks, waved and cut.

mod shape;

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, noise, ops};

use super::card::{Card, CardLayout};
use super::comb::{Field, step};
use super::grow::{Growth, grow, smooth};
use super::layers::Layer;
use super::line::angles;
use super::roots::{Root, spread};
use super::space::Space;
use super::style::{Comb, Length, Style};
use super::{HairParams, HairStyle};

/// Length of a step of hair that hangs and of short hair, metres.
const LONG_STEP_M: f64 = 0.004;
const SHORT_STEP_M: f64 = 0.003;
/// Maximum path length of hair cut at a hem, beyond the hem itself, metres.
const OVER_HEM_M: f64 = 0.26;
/// Lock of hair: its root, the path of its middle, and its own character.
struct Lock {
    root: DVec3,
    path: Vec<DVec3>,
    /// Nearly normal numbers.
    character: [f64; 4],
}

/// A hair that is about to grow: its layer and the layer's number, its root, its chances.
struct Hair<'a> {
    layer: &'a Layer,
    number: u64,
    root: &'a Root,
    dice: HairRandom,
}

/// Generator of all hair cards of one head from its combing field, style and roots.
pub(super) struct Grower<'a> {
    pub(super) space: &'a Space,
    pub(super) field: &'a Field,
    pub(super) style: &'a Style,
    pub(super) params: &'a HairParams,
    pub(super) places: &'a [Root],
}

/// Returns a roughly normal random number with standard deviation 1. Rounded once, unlike
/// `noise::normal`, from which it may differ in the last bit: the hair of all figures was grown
/// with it.
pub(super) fn normal(seed: u64, id: u64, i: i64) -> f64 {
    (0..4)
        .map(|k| noise::unit(seed, id * 4 + k, i))
        .sum::<f64>()
        .mul_add(1.732, -3.464)
}

/// The random numbers of one hair.
struct HairRandom {
    seed: u64,
    i: i64,
}

impl HairRandom {
    fn unit(&self, k: u64) -> f64 {
        noise::unit(self.seed, k, self.i)
    }

    fn bell(&self, k: u64) -> f64 {
        normal(self.seed, 10 + k, self.i)
    }
}

impl Grower<'_> {
    /// Grows all hair cards, from the scalp outwards.
    pub(super) fn cards(&self) -> Vec<Card> {
        let locks = self.locks();
        let mut out = Vec::new();
        for (number, layer) in (0..).zip(self.style.layers) {
            let roots = spread(self.places, |r| self.spacing(layer, r));
            for (i, root) in (0..).zip(roots) {
                let hair = Hair {
                    layer,
                    number,
                    root: &root,
                    dice: HairRandom {
                        seed: self.params.seed + 1000 * (number + 1),
                        i,
                    },
                };
                out.extend(self.strand(&hair, &locks));
            }
        }
        out.extend(self.baby_hairs());
        out
    }

    /// Returns the root spacing of a layer at a position, 0 if none start there.
    fn spacing(&self, layer: &Layer, root: &Root) -> f64 {
        let parting = self.field.off_parting(root.position);
        let is_hanging = matches!(self.style.length, Length::Hem { .. });
        // Hair rooted in front of and below the ear would hang over the cheek.
        let p = root.position;
        let before_ear = is_hanging && p.x.abs() > 0.052 && p.y < 0.004 && p.z > -0.012;
        let is_beyond = layer.parting > 0.0 && parting > layer.parting;
        if root.inside < layer.inside || before_ear || parting < 0.0007 || is_beyond {
            return 0.0;
        }
        let dense = 0.5 + 0.5 * step(0.0, 0.022, root.inside);
        layer.spacing * dense * (0.42 + 0.58 * step(0.002, 0.018, parting))
    }

    fn is_short(&self) -> bool {
        matches!(self.style.length, Length::Short { .. })
    }

    fn is_shaved(&self) -> bool {
        self.params.style == HairStyle::Buzz
    }

    fn step(&self) -> f64 {
        match self.style.length {
            Length::Short { .. } => SHORT_STEP_M,
            _ => LONG_STEP_M,
        }
    }

    /// Returns the full length of hair rooted at a position, metres.
    fn length(&self, root: DVec3) -> f64 {
        match self.style.length {
            Length::Hem { hem, .. } => OVER_HEM_M - hem * self.params.length,
            Length::Short { side, top } => {
                let (azimuth, elevation) = angles(root);
                let nape = step(115.0, 175.0, azimuth.abs()) * step(18.0, -22.0, elevation);
                self.params.length * (side + top * step(4.0, 52.0, elevation)) * (1.0 - 0.25 * nape)
            }
            Length::ToTie => match self.style.comb {
                Comb::Tied(tie) => 1.35 * tie.distance(root) + 0.03,
                _ => 0.1,
            },
        }
    }

    fn locks(&self) -> Vec<Lock> {
        let style = self.style;
        let roots = spread(self.places, |r| {
            if r.inside > 0.003 { style.locks } else { 0.0 }
        });
        let offset = style.layers[style.layers.len() / 2].offset;
        (0..)
            .zip(roots)
            .map(|(i, r)| {
                let g = Growth {
                    root: r.position,
                    normal: self.space.normal(r.position),
                    length: 1.2 * self.length(r.position),
                    step: self.step(),
                    offset: offset * self.params.volume,
                    rise: style.rise,
                    lift: 0.45,
                    bend: style.bend,
                };
                let mut path = grow(self.space, self.field, &g, self.params.seed);
                smooth(&mut path, 4);
                Lock {
                    root: r.position,
                    path,
                    character: [0, 1, 2, 3].map(|k| normal(self.params.seed, 40 + k, i)),
                }
            })
            .collect()
    }

    /// Returns one card; `None` if the result is implausible.
    fn strand(&self, hair: &Hair<'_>, locks: &[Lock]) -> Option<Card> {
        let is_hanging = matches!(self.style.length, Length::Hem { .. });
        let g = self.growth(hair);
        let mut path = grow(self.space, self.field, &g, self.params.seed);
        smooth(&mut path, if self.is_short() { 1 } else { 4 });
        let lock = locks.iter().min_by(|a, b| {
            let d = |l: &Lock| l.root.distance_squared(hair.root.position);
            d(a).total_cmp(&d(b))
        })?;
        self.gather(&mut path, lock, hair.layer.gather, g.length);
        self.wave(&mut path, lock, 0.12 * hair.dice.bell(1));
        if matches!(self.style.comb, Comb::Parted) {
            for p in &mut path {
                *p = off_face(*p);
            }
        }
        smooth(&mut path, if self.is_short() { 1 } else { 5 });
        let length = self.trim(&mut path, hair, g.length)?;
        for (k, p) in path.iter_mut().enumerate() {
            let arc = k as f64 * g.step;
            *p = self.space.pushed(
                *p,
                0.0005 + (0.6 * g.offset).min(0.006) * step(0.0, 0.02, arc),
            );
            if is_hanging && arc > 0.01 {
                *p = self.space.over_ear(*p, 0.0015 + 0.3 * g.offset);
            }
        }
        if is_hanging {
            smooth(&mut path, 2);
        }
        if !self.is_wearable(&path, length) {
            return None;
        }
        let laid = self.card_layout(hair, lock, length);
        Some(Card::along(self.space, &path, g.step, &laid))
    }

    /// Returns the growth parameters of a hair of a layer from a root.
    fn growth(&self, hair: &Hair<'_>) -> Growth {
        let Hair {
            layer, root, dice, ..
        } = hair;
        let edge = step(0.0, 0.018, root.inside);
        let parting = self.field.off_parting(root.position);
        let full = self.length(root.position) * layer.length;
        let is_short = self.is_short();
        let length = if is_short {
            full * (0.8 + 0.4 * dice.unit(0))
        } else {
            full
        };
        let low = if is_short {
            (length / 0.035).clamp(0.45, 1.2)
        } else {
            1.0
        };
        // Very short hair lies closer, because its ends would look like scales.
        let low_lift = if is_short && !self.is_shaved() {
            lerp(0.45, 1.0, step(0.018, 0.04, length))
        } else {
            1.0
        };
        let offset = layer.offset
            * self.params.volume
            * (0.4 + 0.6 * edge)
            * (1.0 + 0.18 * dice.bell(0)).clamp(0.6, 1.5)
            * (0.6 + 0.4 * step(0.0, 0.04, parting))
            * low
            + 0.0012 * dice.unit(1);
        Growth {
            root: root.position,
            normal: root.normal,
            length,
            step: self.step(),
            offset,
            rise: self.style.rise,
            lift: layer.lift
                * low_lift
                * (0.3 + 0.7 * step(0.0, 0.045, parting))
                * (0.3 + 0.7 * edge)
                * (0.7 + 0.6 * dice.unit(2)),
            bend: self.style.bend,
        }
    }

    /// Returns the layout of a card of this length.
    fn card_layout(&self, hair: &Hair<'_>, lock: &Lock, length: f64) -> CardLayout {
        let Hair {
            layer,
            number,
            root,
            dice,
        } = hair;
        let edge = step(0.0, 0.018, root.inside);
        let parting = self.field.off_parting(root.position);
        let is_short = self.is_short();
        let spread = f64::from(layer.strips[1] - layer.strips[0]);
        let mut strip = layer.strips[0] + (dice.unit(5) * spread) as u32;
        // Dense strips would end on the bare skin like chips.
        if root.inside < 0.006
            || root.inside < 0.010 && dice.unit(6) < 0.6
            || is_short && length < 0.02
        {
            strip = 9 + (dice.unit(7) * 5.0) as u32;
        }
        let taper = if is_short {
            [lerp(0.35, 0.75, edge), 1.0, 0.22]
        } else {
            let is_hanging = matches!(self.style.length, Length::Hem { .. });
            [
                lerp(0.2, 0.45, edge),
                1.0,
                if is_hanging { 0.45 } else { 0.8 },
            ]
        };
        // Tones of short cards that differ much would show as scales.
        let vary = if is_short { 0.07 } else { 0.15 };
        CardLayout {
            length,
            width: layer.width
                * (0.75 + 0.5 * dice.unit(8))
                * (0.45 + 0.55 * step(0.0, 0.022, root.inside))
                * (0.55 + 0.45 * step(0.002, 0.018, parting)),
            taper,
            spans: layer.spans,
            strip,
            is_mirrored: dice.unit(9) < 0.5,
            roll: layer.roll * dice.bell(2) * (0.2 + 0.8 * step(0.002, 0.03, root.inside)),
            tint: (0.5 + vary * (lock.character[3] + dice.bell(3))).clamp(0.0, 1.0),
            layer: *number as usize,
            whole: length,
        }
    }

    /// Returns fine short hair along the hairline; for hanging hair, only at forehead and temples.
    fn baby_hairs(&self) -> Vec<Card> {
        let is_hanging = matches!(self.style.length, Length::Hem { .. });
        let roots = spread(self.places, |r| {
            let p = r.position;
            let is_line = r.inside > -0.0015 && r.inside < 0.006;
            let is_front = p.y > -0.002 && p.z > 0.0;
            match (is_line, is_front) {
                (true, true) if is_hanging => 0.0036,
                (true, true) => 0.0048,
                (true, false) if !is_hanging => 0.0075,
                _ => 0.0,
            }
        });
        let seed = self.params.seed + 77;
        (0..)
            .zip(roots)
            .map(|(i, r)| {
                let dice = |k: u64| noise::unit(seed, k, i);
                let length =
                    (0.016 + 0.03 * ops::pow(dice(0), 1.5)).min(0.8 * self.length(r.position));
                let g = Growth {
                    root: r.position,
                    normal: r.normal,
                    length,
                    step: SHORT_STEP_M,
                    offset: 0.002 + 0.002 * dice(1),
                    rise: 0.01,
                    lift: 0.3 + 0.3 * dice(2),
                    bend: [0.15, 40.0],
                };
                let mut path = grow(self.space, self.field, &g, seed);
                smooth(&mut path, 2);
                Card::along(
                    self.space,
                    &path,
                    g.step,
                    &CardLayout {
                        length,
                        width: 0.0042 * (0.7 + 0.6 * dice(3)),
                        taper: [0.5, 1.0, 0.35],
                        spans: 3,
                        strip: 12 + (dice(4) * 4.0) as u32,
                        is_mirrored: dice(5) < 0.5,
                        roll: 0.3 * normal(seed, 9, i),
                        // Fine hair is pale.
                        tint: (0.8 + 0.15 * normal(seed, 8, i)).clamp(0.0, 1.0),
                        layer: self.style.layers.len(),
                        whole: 0.12,
                    },
                )
            })
            .collect()
    }
}

/// Keeps hair from hanging over the face: moves it beside the cheeks and behind their front.
fn off_face(p: DVec3) -> DVec3 {
    let f = step(0.022, 0.055, p.z) * step(0.050, 0.012, p.y);
    let out = (0.068 - p.x.abs()).max(0.0) * f;
    DVec3::new(
        p.x + out * p.x.signum(),
        p.y,
        p.z - 0.55 * f * (p.z - 0.028).max(0.0),
    )
}

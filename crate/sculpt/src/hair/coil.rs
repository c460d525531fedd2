//! Coily hair: patches inside the mass, and tufts that protrude from it.

use std::f64::consts::TAU;

use raconteur_base::{DVec3, noise, ops};

use super::card::{Card, CardLayout};
use super::comb::step;
use super::layers::Layer;
use super::line::angles;
use super::locks::{Grower, normal};
use super::roots::{Root, spread};
use super::style::Length;
use crate::texture::space_noise;

/// Distance of a path's points, metres.
const STEP_M: f64 = 0.002;
/// Radius of a tuft's coil and its length for each turn, metres.
const COIL_M: f64 = 0.0022;
const COIL_TURN_M: f64 = 0.011;

/// Path that a card follows, with its layout along it, as in [`CardLayout`].
struct CoilPath<'a> {
    path: &'a [DVec3],
    length: f64,
    taper: [f64; 3],
    whole: f64,
}

impl Grower<'_> {
    /// Cards of coily hair, from the scalp outwards.
    pub(super) fn coils(&self) -> Vec<Card> {
        let mut out = Vec::new();
        for (number, layer) in (0..).zip(self.style.layers) {
            let roots = spread(self.places, |r| {
                if r.inside < layer.inside {
                    0.0
                } else {
                    layer.spacing * (0.55 + 0.45 * step(0.0, 0.012, r.inside))
                }
            });
            for (i, root) in (0..).zip(roots) {
                out.push(if layer.lift > 0.3 {
                    self.tuft(layer, number, &root, i)
                } else {
                    self.patch(layer, number, &root, i)
                });
            }
        }
        out
    }

    /// Returns the thickness of the hair mass over a position, metres.
    fn thickness(&self, root: &Root) -> f64 {
        let Length::Short { side, top } = self.style.length else {
            return 0.0;
        };
        let (_, elevation) = angles(root.position);
        let uneven = 1.0 + 0.1 * space_noise(self.params.seed + 77, root.position * 40.0);
        let line = 0.35 + 0.65 * step(0.0, 0.016, root.inside);
        self.params.length * (side + top * step(-12.0, 48.0, elevation)) * uneven * line
    }

    /// Builds a tuft of coily hair that runs from inside the mass of hair to its surface.
    fn tuft(&self, layer: &Layer, number: u64, root: &Root, i: i64) -> Card {
        let seed = self.params.seed + 1000 * (number + 1);
        let dice = |k: u64| noise::unit(seed, k, i);
        let bell = |k: u64| normal(seed, 10 + k, i);
        let thick = self.thickness(root);
        let length = (thick * (layer.length - layer.offset) * (0.85 + 0.3 * dice(0))).max(0.004);
        let n = root.normal;
        let spread = DVec3::new(bell(0), bell(1), bell(2));
        let aside = (spread - n * spread.dot(n)).normalize_or_zero();
        let d = (n + aside * (layer.lift + 0.3 * dice(1))).normalize_or(n);
        let bend = DVec3::new(bell(3), bell(4), bell(5)) * 8.0;
        let e1 = d.any_orthonormal_vector();
        let e2 = d.cross(e1);
        let count = (length / STEP_M) as usize + 3;
        let path: Vec<DVec3> = (0..count)
            .map(|k| {
                let s = k as f64 * STEP_M;
                // A coil winds about its own middle, wider towards its tip.
                let turn = TAU * (s / COIL_TURN_M + dice(2));
                let wound =
                    (e1 * ops::cos(turn) + e2 * ops::sin(turn)) * (COIL_M * (s / 0.006).min(1.0));
                let p = root.position + n * (thick * layer.offset) + d * s + bend * (s * s) + wound;
                self.space.pushed(p, 0.0008)
            })
            .collect();
        let wound = CoilPath {
            path: &path,
            length,
            taper: [0.7, 1.0, 0.85],
            whole: length / (layer.length - layer.offset).max(0.2),
        };
        self.coil(layer, number, root, i, &wound)
    }

    /// Returns a flat patch at its layer's depth.
    fn patch(&self, layer: &Layer, number: u64, root: &Root, i: i64) -> Card {
        let seed = self.params.seed + 1000 * (number + 1);
        let dice = |k: u64| noise::unit(seed, k, i);
        let bell = |k: u64| normal(seed, 10 + k, i);
        let any = DVec3::new(bell(0), bell(1), bell(2));
        let n = root.normal;
        let along = (any - n * any.dot(n)).normalize_or(DVec3::X);
        let length = layer.length * (0.7 + 0.6 * dice(0));
        let depth = self.thickness(root) * layer.offset;
        let count = (length / STEP_M) as usize + 3;
        let path: Vec<DVec3> = (0..count)
            .map(|k| {
                let s = k as f64 * STEP_M;
                let p = root.position + along * (s - 0.5 * length);
                let wave = 0.85 + 0.25 * ops::sin(160.0 * s + TAU * dice(1));
                p + self.space.normal(p) * (depth * wave - self.space.height(p))
            })
            .collect();
        let wound = CoilPath {
            path: &path,
            length,
            taper: [0.8, 1.0, 0.8],
            whole: 50.0 * length,
        };
        self.coil(layer, number, root, i, &wound)
    }

    fn coil(&self, layer: &Layer, number: u64, root: &Root, i: i64, wound: &CoilPath<'_>) -> Card {
        let seed = self.params.seed + 1000 * (number + 1) + 500;
        let dice = |k: u64| noise::unit(seed, k, i);
        let strips = f64::from(layer.strips[1] - layer.strips[0]);
        Card::along(
            self.space,
            wound.path,
            STEP_M,
            &CardLayout {
                length: wound.length,
                width: layer.width
                    * (0.75 + 0.5 * dice(0))
                    * (0.55 + 0.45 * step(0.0, 0.015, root.inside)),
                taper: wound.taper,
                spans: layer.spans,
                strip: layer.strips[0] + (dice(1) * strips) as u32,
                is_mirrored: dice(2) < 0.5,
                roll: layer.roll * normal(seed, 9, i),
                tint: (0.5 + 0.17 * normal(seed, 8, i)).clamp(0.0, 1.0),
                layer: number as usize,
                whole: wound.whole,
            },
        )
    }
}

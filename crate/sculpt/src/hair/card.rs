//! Hair cards: strips of two columns along paths.

use raconteur_base::{DVec3, ops};

use super::colour::Palette;
use super::grow::{sampled, tangent};
use super::space::{Frame, Space};
use crate::assemble::PartWithNormals;
use crate::part::{JointRef, MeshPart, PartVertex};
use raconteur_body::figure::Material;

/// Number of strips of strands side by side in u in the renderer's atlas.
pub(super) const STRIPS: f64 = 16.0;
/// Share of a strip that is left free at either side.
const MARGIN: f64 = 0.016;
/// Minimum height of the edges of a card over the skin, metres.
const EDGE_M: f64 = 0.0008;
/// Drop of a card's sides below its middle, relative to half its width.
const BOW: f64 = 0.10;
/// Share of the card's own normal in the one that it is lit by; the rest is the hull's.
const OWN_NORMAL: f64 = 0.25;

/// Layout of a hair card along its path: length, width, taper and number of spans.
#[derive(Clone, Copy, Debug)]
pub(super) struct CardLayout {
    /// Metres.
    pub(super) length: f64,
    /// Full width, metres.
    pub(super) width: f64,
    /// Width at the root, at a third and at the tip over the full one.
    pub(super) taper: [f64; 3],
    pub(super) spans: usize,
    /// Strip of the atlas.
    pub(super) strip: u32,
    pub(super) is_mirrored: bool,
    /// Turn about its own middle line, radians.
    pub(super) roll: f64,
    /// Darker or lighter, 0..1.
    pub(super) tint: f64,
    pub(super) layer: usize,
    /// Length of a whole hair of which this is the beginning, metres.
    pub(super) whole: f64,
}

/// Function that returns the joint weights of a row of a card; arguments: the card, the row, the
/// distance from the root in metres.
pub(super) type Joints<'a> = dyn Fn(&Card, usize, f64) -> Vec<(JointRef, f64)> + 'a;

/// One row of a hair card: two vertices, one at each side, with their directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) sides: [DVec3; 2],
    /// Direction of the hair.
    pub(super) tangent: DVec3,
    /// Normal of the card.
    pub(super) facing: DVec3,
    /// Normal of the head as one hull.
    pub(super) hull: DVec3,
    /// v in the atlas, 0 at the root.
    pub(super) v: f64,
    /// Share of a whole hair's length that precedes it, 0..1.
    pub(super) share: f64,
    /// Share of light that reaches it, 0..1.
    pub(super) light: f64,
}

impl Row {
    pub(super) fn middle(&self) -> DVec3 {
        (self.sides[0] + self.sides[1]) * 0.5
    }
}

/// Hair card: a textured strip that stands for a lock of hair, frame of the hair.
#[derive(Clone, Debug)]
pub(super) struct Card {
    pub(super) rows: Vec<Row>,
    pub(super) strip: u32,
    is_mirrored: bool,
    pub(super) tint: f64,
    pub(super) layer: usize,
    /// True if it hangs from a tie, not from the scalp.
    pub(super) is_free: bool,
}

impl Card {
    /// Lays a card along a path whose points are `step` metres apart, facing away from the head.
    pub(super) fn along(space: &Space, path: &[DVec3], step: f64, laid: &CardLayout) -> Self {
        let clear = |p: DVec3| space.pushed(p, EDGE_M);
        Self::laid(path, step, laid, &|p| space.hull_normal(p), &clear)
    }

    /// Builds a card along a path with points `step` apart, facing away from the core that it winds
    /// around.
    pub(super) fn around(
        path: &[DVec3],
        step: f64,
        outward: &dyn Fn(DVec3) -> DVec3,
        laid: &CardLayout,
    ) -> Self {
        Self::laid(path, step, laid, outward, &|p| p)
    }

    fn laid(
        path: &[DVec3],
        step: f64,
        laid: &CardLayout,
        outward: &dyn Fn(DVec3) -> DVec3,
        clear: &dyn Fn(DVec3) -> DVec3,
    ) -> Self {
        let length = laid.length.min((path.len() - 2) as f64 * step);
        let middle = sampled(path, step, length, laid.spans);
        let mut hull: Vec<DVec3> = middle.iter().map(|p| outward(*p)).collect();
        for _ in 0..2 {
            let before = hull.clone();
            for i in 1..laid.spans {
                hull[i] = (before[i - 1] + before[i] * 2.0 + before[i + 1]).normalize_or(before[i]);
            }
        }
        let (sine, cosine) = (ops::sin(laid.roll), ops::cos(laid.roll));
        let row = |i: usize| {
            let tangent = tangent(&middle, i);
            let flat = (hull[i] - tangent * hull[i].dot(tangent)).normalize_or(hull[i]);
            let level = tangent.cross(flat);
            let across = level * cosine + flat * sine;
            let facing = flat * cosine - level * sine;
            let t = i as f64 / laid.spans as f64;
            let half = 0.5 * laid.width * tapered(laid.taper, t);
            let side = |sign: f64| {
                let p = middle[i] + across * (sign * half) - facing * (BOW * half);
                // The root lies in the skin.
                if i > 0 { clear(p) } else { p }
            };
            Row {
                sides: [side(-1.0), side(1.0)],
                tangent,
                facing,
                hull: hull[i],
                v: t,
                share: (t * length / laid.whole).min(1.0),
                light: 1.0,
            }
        };
        Self {
            rows: (0..=laid.spans).map(row).collect(),
            strip: laid.strip.min(STRIPS as u32 - 1),
            is_mirrored: laid.is_mirrored,
            tint: laid.tint,
            layer: laid.layer,
            is_free: false,
        }
    }

    /// Marks the card as hair that hangs from a tie, not from the scalp.
    pub(super) fn free(self) -> Self {
        Self {
            is_free: true,
            ..self
        }
    }

    /// Returns the width of the card at row `i`, metres.
    pub(super) fn width(&self, i: usize) -> f64 {
        self.rows[i].sides[0].distance(self.rows[i].sides[1])
    }

    /// Returns the length of the card from root to tip, metres.
    pub(super) fn length(&self) -> f64 {
        let rows = self.rows.windows(2);
        rows.map(|w| w[0].middle().distance(w[1].middle())).sum()
    }

    /// Returns the texture coordinate u at either side of the card.
    pub(super) fn across(&self) -> [f64; 2] {
        let first = f64::from(self.strip) / STRIPS;
        let sides = [first + MARGIN / STRIPS, first + (1.0 - MARGIN) / STRIPS];
        if self.is_mirrored {
            [sides[1], sides[0]]
        } else {
            sides
        }
    }
}

fn tapered([root, third, tip]: [f64; 3], t: f64) -> f64 {
    const THIRD: f64 = 0.35;
    if t < THIRD {
        root + (third - root) * t / THIRD
    } else {
        third + (tip - third) * (t - THIRD) / (1.0 - THIRD)
    }
}

/// Creates an empty mesh part for hair.
pub(super) fn empty(name: &str, material: &Material) -> MeshPart {
    MeshPart {
        name: name.to_owned(),
        material: material.clone(),
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

/// Joins all cards into one mesh part in the frame of the head.
pub(super) fn piece(
    material: &Material,
    frame: &Frame,
    cards: &[Card],
    palette: &Palette,
    joints: &Joints<'_>,
) -> PartWithNormals {
    let mut part = empty("hair", material);
    let mut normals = Vec::new();
    for (id, card) in (0..).zip(cards) {
        let grey = palette.grey_of(id);
        let across = card.across();
        let mut arc = 0.0;
        for (i, row) in card.rows.iter().enumerate() {
            let base = part.vertices.len() as u32;
            let [r, g, b] = palette.shade(row.share, card.tint, grey);
            if i > 0 {
                arc += row.middle().distance(card.rows[i - 1].middle());
            }
            let weights = joints(card, i, arc);
            let facing = row.facing * row.facing.dot(row.hull).signum();
            let n = facing * OWN_NORMAL + row.hull * (1.0 - OWN_NORMAL);
            let n = (n - row.tangent * n.dot(row.tangent)).normalize_or(row.hull);
            for (u, p) in across.into_iter().zip(row.sides) {
                part.vertices.push(PartVertex {
                    position: frame.place_back(p),
                    uv: [u, row.v],
                    // The square root of the share: eight bits then resolve dark areas.
                    color: [r, g, b, row.light.max(0.0).sqrt()],
                    weights: weights.clone(),
                });
                normals.push(frame.direction_back(n));
            }
            if i + 1 < card.rows.len() {
                part.faces.push(outward(card, i, base));
            }
        }
    }
    PartWithNormals {
        part,
        normals: Some(normals),
    }
}

/// Returns the quad between rows `i` and `i + 1` of a card, counter-clockwise from outside.
fn outward(card: &Card, i: usize, base: u32) -> Vec<u32> {
    let (a, b) = (&card.rows[i], &card.rows[i + 1]);
    let face = (b.sides[0] - a.sides[0]).cross(a.sides[1] - a.sides[0]);
    if face.dot(a.hull) >= 0.0 {
        vec![base, base + 2, base + 3, base + 1]
    } else {
        vec![base, base + 1, base + 3, base + 2]
    }
}

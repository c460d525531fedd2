//! Ring of the mouth: its fibres, the meeting lips, and the teeth behind them.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side};

use super::arch::arch;
use super::fit::{Skin, nearest_on, push};
use super::{narrow, ramp};
use crate::head::{LipPlace, Soft};
use crate::part::{MeshPart, TEETH};
use raconteur_body::skeleton::{Bone, Drive};
use raconteur_tissue::Muscle;
use raconteur_tissue::tissue::{Attachment, Column, FibreCurve, FibrePoint, LipNode, Tissue};

/// Position of the corner, and of the middle of the lower lip; see [`LipPlace`].
const CORNER: u8 = 12;
const LAST: u8 = 24;
/// Rings with fibres, from the vermilion of the lips outwards, and their outward coordinate.
const RINGS: [(u8, f32); 3] = [(6, 0.0), (2, 0.5), (0, 1.0)];
/// Ring on which the lips touch at rest.
const CONTACT: u8 = 10;
/// Distance beyond its outermost fibre to which the ring moves the skin, mm on the reference head.
const BEYOND_MM: f64 = 14.0;
/// Share of a gap between the lips that the upper lip closes.
const UPPER_CLOSES: f64 = 0.36;
/// Depth of the fibres under the skin, metres.
const UNDER_M: f64 = 0.0022;

/// Nodes of the lips by position.
struct LipNodes(BTreeMap<LipPlace, usize>);

impl LipNodes {
    fn from_soft(soft: &Soft) -> Self {
        let nodes = soft.nodes.iter().enumerate();
        Self(nodes.filter_map(|(i, n)| Some((n.lip?, i))).collect())
    }

    /// Returns the node on a ring; midline nodes have no side.
    fn node(&self, ring: u8, position: u8, side: Side) -> Option<usize> {
        let side = if position == 0 || position == LAST {
            Side::Left
        } else {
            side
        };
        let place = LipPlace {
            ring,
            position,
            side,
        };
        self.0.get(&place).copied()
    }
}

/// The first points of the ring's fibres: of the upper lip, then the lower, from the inside out.
type FirstPoints = [[usize; 3]; 2];

/// Columns of the lips by position and side.
type Columns = BTreeMap<(u8, Side), u16>;

/// Fibres, columns, pairs and teeth.
pub(super) fn mouth(
    soft: &Soft,
    skin: &Skin,
    rigid: &[&MeshPart],
    out: &mut Tissue,
    holds: &mut [Vec<Attachment>],
) {
    let lips = LipNodes::from_soft(soft);
    let firsts = ring_fibres(soft, skin, &lips, out);
    hold_lips(&lips, &firsts, holds);
    hold_around(soft, skin, &firsts, out, holds);
    let columns = join_lips(skin, &lips, rigid, out);
    close_lips(&lips, &columns, out);
    let mm = f64::from(out.scale) * 1e-3;
    spread_around_lips(soft, skin, &lips.0, &columns, mm, out);
    let of = |bone: Bone| {
        arch(rigid, |v| {
            v.weights.iter().any(|(j, _)| j.0 == Drive::Bone(bone))
        })
    };
    out.arches = [of(Bone::Skull), of(Bone::Chin)];
}

/// Lays the fibres of orbicularis oris along the lips.
fn ring_fibres(soft: &Soft, skin: &Skin, lips: &LipNodes, out: &mut Tissue) -> FirstPoints {
    let mut firsts = [[0usize; 3]; 2];
    for (r, &(ring, far)) in RINGS.iter().enumerate() {
        for is_lower in [false, true] {
            let at = |k: u8| if is_lower { LAST - k } else { k };
            let right = (1..=CORNER)
                .rev()
                .map(|k| lips.node(ring, at(k), Side::Right));
            let left = (0..=CORNER).map(|k| lips.node(ring, at(k), Side::Left));
            let points: Vec<FibrePoint> = right
                .chain(left)
                .flatten()
                .map(|i| FibrePoint {
                    rest: narrow(skin.places[i] - skin.normals[i] * UNDER_M),
                    outwards: narrow(skin.normals[i]),
                    jaw: soft.nodes[i].jaw as f32,
                })
                .collect();
            let muscle = if is_lower {
                Muscle::OrbicularisOrisLower
            } else {
                Muscle::OrbicularisOrisUpper
            };
            let course = FibreCurve::Oris { is_lower, out: far };
            firsts[usize::from(is_lower)][r] = push(out, muscle, course, &points);
        }
    }
    firsts
}

/// Attaches the nodes of the lips to the fibres, each to the two between which it lies.
fn hold_lips(lips: &LipNodes, firsts: &FirstPoints, holds: &mut [Vec<Attachment>]) {
    let hold = |lip: LipPlace, r: usize, weight: f64| {
        let is_lower = lip.position > CORNER;
        let k = if is_lower {
            LAST - lip.position
        } else {
            lip.position
        };
        let aside = i32::from(k) * if lip.side == Side::Left { 1 } else { -1 };
        let point = (aside + i32::from(CORNER)) as usize;
        // A hold lies between two points.
        let last = 2 * usize::from(CORNER);
        let before = point.min(last - 1);
        Attachment {
            point: (firsts[usize::from(is_lower)][r] + before) as u16,
            on: (point - before) as f32,
            weight: weight as f32,
        }
    };
    for (&lip, &i) in &lips.0 {
        let ring = f64::from(lip.ring);
        let (inner, outer, share) = match lip.ring {
            6.. => (0, 0, 0.0),
            2..=5 => (0, 1, (6.0 - ring) / 4.0),
            _ => (1, 2, (2.0 - ring) / 2.0),
        };
        let strength = 1.0 - 0.9 * ramp(11.0, 16.0, ring);
        let parts = [(inner, 1.0 - share), (outer, share)];
        for (r, share) in parts {
            if share * strength > 0.01 {
                holds[i].push(hold(lip, r, share * strength));
            }
        }
    }
}

/// Hangs the skin around the lips on their outermost fibres.
fn hold_around(
    soft: &Soft,
    skin: &Skin,
    firsts: &FirstPoints,
    out: &Tissue,
    holds: &mut [Vec<Attachment>],
) {
    let mm = f64::from(out.scale) * 1e-3;
    let (outermost, count) = (RINGS.len() - 1, 2 * usize::from(CORNER) + 1);
    let chains = [false, true].map(|low| {
        let first = firsts[usize::from(low)][outermost];
        (first, out.points[first..first + count].to_vec())
    });
    let middle = usize::from(CORNER);
    let nearer = |halves: &[(usize, f64, f64); 2]| halves[0].2.min(halves[1].2);
    for (i, n) in soft.nodes.iter().enumerate() {
        if n.lip.is_some() || n.is_inside {
            continue;
        }
        let near = chains
            .iter()
            .map(|(first, points)| {
                let halves = [&points[..=middle], &points[middle..]];
                (first, halves.map(|half| nearest_on(half, skin.places[i])))
            })
            .min_by(|a, b| nearer(&a.1).total_cmp(&nearer(&b.1)));
        let Some((first, halves)) = near else {
            continue;
        };
        let beyond = (nearer(&halves) - UNDER_M).max(0.0);
        let whole = n.mobility * (1.0 - ramp(0.0, BEYOND_MM * mm, beyond));
        let left = share_of_left(halves[0].2, halves[1].2, mm);
        for ((point, on, _), (before, share)) in
            halves.into_iter().zip([(0, 1.0 - left), (middle, left)])
        {
            let weight = whole * share;
            if weight > 0.01 {
                holds[i].push(Attachment {
                    point: (first + before + point) as u16,
                    on: on as f32,
                    weight: weight as f32,
                });
            }
        }
    }
}

/// Creates the columns and pairs by which the lips meet.
fn join_lips(skin: &Skin, lips: &LipNodes, rigid: &[&MeshPart], out: &mut Tissue) -> Columns {
    let mm = f64::from(out.scale) * 1e-3;
    let edge = teeth_edge(rigid);
    let mut columns = Columns::new();
    for side in Side::BOTH {
        for k in 0..CORNER {
            if k == 0 && side == Side::Right {
                continue;
            }
            let pair = (
                lips.node(CONTACT, k, side),
                lips.node(CONTACT, LAST - k, side),
            );
            let (Some(above), Some(below)) = pair else {
                continue;
            };
            columns.insert((k, side), out.columns.len() as u16);
            let x = skin.places[below].x;
            out.columns.push(Column {
                contact: [above as u16, below as u16],
                edge: narrow(edge(x) + DVec3::new(0.0, -0.4, 0.9) * mm),
                bites: (1.0 - ramp(0.35, 0.85, f64::from(k) / f64::from(CORNER))) as f32,
            });
            for ring in 7..=11 {
                if let (Some(a), Some(b)) =
                    (lips.node(ring, k, side), lips.node(ring, LAST - k, side))
                {
                    out.pairs.push([a as u16, b as u16]);
                }
            }
        }
    }
    columns
}

/// Sets the weight with which each node of the lips follows its column when they close.
fn close_lips(lips: &LipNodes, columns: &Columns, out: &mut Tissue) {
    for (&lip, &i) in &lips.0 {
        let ring = f64::from(lip.ring);
        let much = (0.5 + 0.5 * ramp(0.0, 5.0, ring)) * (1.0 - ramp(11.0, 15.0, ring));
        let Some(closing) = closing(lip, i, much, columns) else {
            continue;
        };
        if much > MIN_CLOSING {
            out.lips.push(closing);
        }
        if (4..=11).contains(&lip.ring) {
            out.before_teeth.push(i as u16);
        }
    }
}

/// Minimum closing weight; nodes below it stay.
const MIN_CLOSING: f64 = 0.01;

/// Returns a node's closing with a position of the lips, by this weight; `None` without a column.
fn closing(lip: LipPlace, node: usize, much: f64, columns: &Columns) -> Option<LipNode> {
    let k = lip.position.min(LAST - lip.position);
    let side = if k == 0 { Side::Left } else { lip.side };
    let column = *columns.get(&(k, side))?;
    let closes = if lip.position < CORNER {
        -UPPER_CLOSES
    } else {
        1.0 - UPPER_CLOSES
    };
    Some(LipNode {
        node: node as u16,
        column,
        closes: (closes * much) as f32,
    })
}

/// Makes the skin around the lips follow them partly when they close.
fn spread_around_lips(
    soft: &Soft,
    skin: &Skin,
    lips: &BTreeMap<LipPlace, usize>,
    columns: &Columns,
    mm: f64,
    out: &mut Tissue,
) {
    let rim: Vec<(LipPlace, usize)> = lips
        .iter()
        .filter(|(lip, _)| lip.ring == 0)
        .map(|(lip, i)| (*lip, *i))
        .collect();
    for (i, n) in soft.nodes.iter().enumerate() {
        if n.lip.is_some() || n.is_inside {
            continue;
        }
        let distance = |at: &(LipPlace, usize)| skin.places[at.1].distance(skin.places[i]);
        let nearest = |side: Side| {
            rim.iter()
                .filter(|(lip, _)| lip.side == side || matches!(lip.position, 0 | LAST))
                .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        let (Some(right), Some(left)) = (nearest(Side::Right), nearest(Side::Left)) else {
            continue;
        };
        let least = distance(right).min(distance(left));
        let whole = 0.5 * n.mobility * (1.0 - ramp(0.0, 13.0 * mm, least));
        let share = if left.1 == right.1 {
            0.0
        } else {
            share_of_left(distance(right), distance(left), mm)
        };
        for ((lip, _), share) in [(right, 1.0 - share), (left, share)] {
            let much = whole * share;
            let closing = closing(*lip, i, much, columns);
            out.lips.extend(closing.filter(|_| much > MIN_CLOSING));
        }
    }
}

/// Returns the weight of the left half for a node attached to both halves of the mouth, from its
/// distances to the right and to the left one: equal in the middle, so the result does not jump.
fn share_of_left(right: f64, left: f64, mm: f64) -> f64 {
    let apart = 0.5 * mm;
    ramp(-apart, apart, right - left)
}

/// Returns the edge of the upper teeth as a function of the distance from the midline, world.
fn teeth_edge(rigid: &[&MeshPart]) -> impl Fn(f64) -> DVec3 {
    let upper: Vec<DVec3> = rigid
        .iter()
        .filter(|part| part.name == TEETH)
        .flat_map(|part| &part.vertices)
        .filter(|v| {
            v.weights
                .iter()
                .any(|(j, _)| j.0 == Drive::Bone(Bone::Skull))
        })
        .map(|v| v.position)
        .collect();
    move |x: f64| {
        let near = |p: &&DVec3| (p.x - x).abs() < 0.003 && p.z > 0.0;
        let low = upper
            .iter()
            .filter(near)
            .map(|p| p.y)
            .fold(f64::MAX, f64::min);
        // The foremost point near the edge.
        let edge = upper.iter().filter(near).filter(|p| p.y < low + 0.0015);
        let z = edge.map(|p| p.z).fold(f64::MIN, f64::max);
        if low < f64::MAX {
            DVec3::new(x, low, z)
        } else {
            DVec3::ZERO
        }
    }
}

//! Fitting of muscles between skull and skin, and selection of the skin bound to them.

use raconteur_base::{DAffine3, DVec3, Side};

use super::layout::{Moves, Runs, Sheet};
use super::{narrow, ramp};
use crate::bones::hit;
use crate::head::Soft;
use crate::part::MeshPart;
use raconteur_tissue::Muscle;
use raconteur_tissue::tissue::{Attachment, Fibre, FibreCurve, FibrePoint, Link, Tissue};

/// Points of a linear fibre.
const POINTS: usize = 7;
/// Depth of soft tissue with no bone under the skin (cheek, floor of the mouth), metres.
const FLESH_M: f64 = 0.011;
/// Depth of the lining inside mouth and nose, metres.
const LINING_M: f64 = 0.003;
/// Thickness of a lip to its lining, metres.
const LIP_M: f64 = 0.005;
/// Tolerance within which nodes count as near as the nearest one, metres. More would mix both sides
/// of a fold, such as next to the wings of the nose.
const ABOUT_AS_NEAR_M: f64 = 1e-4;
/// Weight below which attachments are dropped.
const MIN_HOLD: f64 = 0.02;

/// Nodes of the skin in the world, with their depths to the bones beneath.
pub(super) struct Skin {
    pub(super) places: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    pub(super) depths: Vec<f64>,
}

impl Skin {
    pub(super) fn new(soft: &Soft, place: &DAffine3, bones: &[MeshPart]) -> Self {
        let places: Vec<DVec3> = soft
            .nodes
            .iter()
            .map(|n| place.transform_point3(n.place))
            .collect();
        let quads: Vec<Vec<u32>> = soft.quads.iter().map(|q| q.to_vec()).collect();
        let normals = raconteur_base::surface::vertex_normals(&places, &quads);
        let triangles: Vec<[DVec3; 3]> = bones
            .iter()
            .flat_map(|part| part.triangles_about_middles(|_| true))
            .collect();
        let depths = soft
            .nodes
            .iter()
            .zip(places.iter().zip(&normals))
            .map(|(node, (&p, &n))| {
                if node.is_inside {
                    return LINING_M;
                }
                if node.lip.is_some_and(|lip| lip.ring > 1) {
                    return LIP_M;
                }
                let hits = triangles.iter().filter_map(|t| hit(t, p, -n));
                hits.fold(FLESH_M, f64::min).max(0.0025)
            })
            .collect();
        Self {
            places,
            normals,
            depths,
        }
    }

    /// Returns the skin around a position: of the nearest node that is not lining, averaged with
    /// those about as near, so that the result does not jump where the halves of the face meet.
    fn nearest(&self, soft: &Soft, p: DVec3) -> NearbySkin {
        let outside = || {
            let nodes = (0..self.places.len()).filter(|&i| !soft.nodes[i].is_inside);
            nodes.map(|i| (i, self.places[i].distance(p)))
        };
        let least = outside().map(|(_, d)| d).fold(f64::MAX, f64::min);
        let mut near = NearbySkin::default();
        let mut sum = 0.0;
        for (i, distance) in outside() {
            let weight = 1.0 - ramp(0.0, ABOUT_AS_NEAR_M, distance - least);
            if weight > 0.0 {
                sum += weight;
                near.height += (p - self.places[i]).dot(self.normals[i]) * weight;
                near.normal += self.normals[i] * weight;
                near.depth += self.depths[i] * weight;
                near.jaw += soft.nodes[i].jaw * weight;
            }
        }
        if sum > 0.0 {
            near.height /= sum;
            near.depth /= sum;
            near.jaw /= sum;
        }
        near.normal = near.normal.normalize_or_zero();
        near
    }

    /// Places a point under the skin, at a share of the depth to the bone.
    fn sunk(&self, soft: &Soft, mut p: DVec3, share: f64) -> FibrePoint {
        let mut near = self.nearest(soft, p);
        // Over curved skin, other nodes become the nearest along the path.
        for _ in 0..4 {
            p -= near.normal * (near.height + share * near.depth);
            near = self.nearest(soft, p);
        }
        FibrePoint {
            rest: narrow(p),
            outwards: narrow(near.normal),
            jaw: near.jaw as f32,
        }
    }
}

/// Skin around a position.
#[derive(Clone, Copy, Debug, Default)]
struct NearbySkin {
    /// Height of the position above the skin, metres.
    height: f64,
    normal: DVec3,
    depth: f64,
    jaw: f64,
}

/// Resamples a polyline into segments of equal length.
fn resample(line: &[DVec3], count: usize) -> Vec<DVec3> {
    let lengths: Vec<f64> = line.windows(2).map(|w| w[0].distance(w[1])).collect();
    let whole: f64 = lengths.iter().sum();
    (0..count)
        .map(|k| {
            let mut rest = whole * k as f64 / (count - 1) as f64;
            for (w, length) in line.windows(2).zip(&lengths) {
                if rest <= *length {
                    return w[0].lerp(w[1], rest / length.max(1e-9));
                }
                rest -= length;
            }
            line[line.len() - 1]
        })
        .collect()
}

/// Returns the nearest position on a chain of points: the preceding point, the fraction of the
/// segment, and the distance.
pub(super) fn nearest_on(points: &[FibrePoint], p: DVec3) -> (usize, f64, f64) {
    let at = |k: usize| DVec3::from_array(points[k].rest.map(f64::from));
    let mut best = (0, 0.0, f64::MAX);
    for k in 0..points.len() - 1 {
        let (a, b) = (at(k), at(k + 1));
        let on = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
        let distance = p.distance(a.lerp(b, on));
        if distance < best.2 {
            best = (k, on, distance);
        }
    }
    best
}

/// Adds a fibre to the tissue; returns the index of its first point.
pub(super) fn push(
    out: &mut Tissue,
    muscle: Muscle,
    course: FibreCurve,
    points: &[FibrePoint],
) -> usize {
    let first = out.points.len();
    out.points.extend_from_slice(points);
    out.fibres.push(Fibre {
        muscle,
        course,
        first: first as u16,
        count: points.len() as u8,
    });
    first
}

/// Head to which muscles are fitted: its skin, and the map from the mean head.
pub(super) struct Site<'a> {
    pub(super) soft: &'a Soft,
    pub(super) skin: &'a Skin,
    /// Map from the mean head, millimetres, to this world.
    pub(super) carried: &'a dyn Fn([f64; 3]) -> DVec3,
}

/// Fits a sheet of fibres on all sides that it has.
pub(super) fn sheet(
    sheet: &Sheet,
    site: &Site<'_>,
    out: &mut Tissue,
    holds: &mut [Vec<Attachment>],
) {
    for &(side, muscle) in &sheet.muscles {
        let mut fibres: Vec<(usize, Vec<FibrePoint>)> = Vec::new();
        for fibre in &sheet.fibres {
            let flip = |p: [f64; 3]| (site.carried)([p[0] * side.sign(), p[1], p[2]]);
            let line: Vec<DVec3> = fibre.iter().map(|p| flip(*p)).collect();
            let (course, points) = match sheet.runs {
                Runs::Linear => (FibreCurve::Linear, site.along(&line)),
                Runs::Towards(centre) => (
                    FibreCurve::Towards(narrow(flip(centre))),
                    site.around(&line),
                ),
            };
            let first = push(out, muscle, course, &points);
            if let Some([middle, half, taken]) = sheet.ring {
                let weight = taken / sheet.fibres.len() as f64;
                link(out, side, first + points.len() - 1, middle, half, weight);
            }
            fibres.push((first, points));
        }
        attach(sheet, side, &fibres, site, out, holds);
    }
}

impl Site<'_> {
    /// Returns the points of a linear fibre, from the bone to a depth under the skin.
    fn along(&self, line: &[DVec3]) -> Vec<FibrePoint> {
        let sunk = |(k, p)| {
            let t = k as f64 / (POINTS - 1) as f64;
            self.skin.sunk(self.soft, p, 0.8 - 0.45 * ramp(0.0, 0.6, t))
        };
        resample(line, POINTS)
            .into_iter()
            .enumerate()
            .map(sunk)
            .collect()
    }

    /// Returns the points of a closed fibre, which lies entirely in the skin.
    fn around(&self, line: &[DVec3]) -> Vec<FibrePoint> {
        let sunk = |p: &DVec3| self.skin.sunk(self.soft, *p, 0.4);
        line.iter().chain(line.first()).map(sunk).collect()
    }
}

/// Hangs skin on fibres of a sheet on one side: each node on the nearest of them.
fn attach(
    sheet: &Sheet,
    side: Side,
    fibres: &[(usize, Vec<FibrePoint>)],
    site: &Site<'_>,
    out: &Tissue,
    holds: &mut [Vec<Attachment>],
) {
    let mm = f64::from(out.scale) * 1e-3;
    let [whole, none] = sheet.reach.map(|r| r * mm);
    let is_round = sheet.runs != Runs::Linear;
    for (i, node) in site.soft.nodes.iter().enumerate() {
        if node.lip.is_some() || is_round && node.is_inside {
            continue;
        }
        let p = site.skin.places[i];
        let near = fibres
            .iter()
            .map(|(first, points)| (first, points.len(), nearest_on(points, p)))
            .min_by(|a, b| a.2.2.total_cmp(&b.2.2));
        let Some((first, count, (point, on, distance))) = near else {
            continue;
        };
        let mobility = match sheet.moves {
            Moves::Face => node.mobility,
            Moves::Aside | Moves::Ear => node.mobility_aside,
        };
        let free = if sheet.ring.is_some() {
            1.0 - ring_share(out, &holds[i]).min(1.0)
        } else {
            1.0
        };
        // The ear is stiff, and follows the end of the fibre as a whole.
        let is_own = sheet.moves == Moves::Ear && p.x * side.sign() > 0.0;
        let rooted = if is_own { node.ear_root } else { 0.0 };
        let over = mobility * free * (1.0 - ramp(whole, none, distance));
        for (point, on, share) in [(point, on, over * (1.0 - rooted)), (count - 2, 1.0, rooted)] {
            let weight = sheet.pull * share;
            if weight > MIN_HOLD {
                holds[i].push(Attachment {
                    point: (first + point) as u16,
                    on: on as f32,
                    weight: weight as f32,
                });
            }
        }
    }
}

/// Returns the weight with which a node is attached to the ring of the mouth.
fn ring_share(out: &Tissue, holds: &[Attachment]) -> f64 {
    let is_ring = |h: &&Attachment| {
        let point = h.point;
        out.fibres.iter().any(|f| {
            matches!(f.course, FibreCurve::Oris { .. })
                && (f.first..f.first + u16::from(f.count)).contains(&point)
        })
    };
    holds
        .iter()
        .filter(is_ring)
        .map(|h| f64::from(h.weight))
        .sum()
}

/// Attaches the end of a fibre to the ring of the mouth around a position.
fn link(out: &mut Tissue, side: Side, end: usize, middle: f64, half: f64, weight: f64) {
    let rings: Vec<(usize, usize, bool)> = out
        .fibres
        .iter()
        .filter_map(|f| match f.course {
            FibreCurve::Oris { is_lower, .. } => {
                Some((usize::from(f.first), usize::from(f.count), is_lower))
            }
            _ => None,
        })
        .collect();
    for (first, count, is_lower) in rings {
        for k in 0..count {
            // Points run from the right corner to the left; positions count from the middle
            // of the upper lip to that of the lower, and beyond it on the other side.
            let aside = k as f64 - (count - 1) as f64 / 2.0;
            let own = aside * side.sign();
            let position = if is_lower { 24.0 - own } else { own };
            let share = 1.0 - ramp(0.0, 1.0, (position - middle).abs() / half);
            if share * weight > MIN_HOLD {
                out.links.push(Link {
                    end: end as u16,
                    ring: (first + k) as u16,
                    weight: (share * weight) as f32,
                });
            }
        }
    }
}

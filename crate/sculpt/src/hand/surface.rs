//! Hand skin: the subdivided cage on the field, smoothed, with relief.

use raconteur_base::{DVec3, curve, ops};

use super::anatomy::{Anatomy, FINGER_COUNT};
use super::cage::Cage;
use super::field::Field;
use super::nail::Nail;
use crate::subdivide::{edge_faces, subdivide};
use raconteur_base::surface::vertex_normals;

/// Skin of the mean adult hand as a refined mesh; frame and units of [`super::anatomy`].
pub(super) struct Skin {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    pub(super) faces: Vec<Vec<u32>>,
    /// Weight of each vertex in each finger's tube.
    pub(super) ownership: Vec<[f64; FINGER_COUNT]>,
    pub(super) neighbours: Vec<Vec<u32>>,
    /// The open edge on the forearm, in order around it.
    pub(super) rim: Vec<u32>,
}

/// Returns the bell function exp(−x²).
pub(super) fn bell(x: f64) -> f64 {
    ops::exp(-x * x)
}

/// Returns the largest ownership share of the four fingers; the thumb is excluded.
pub(super) fn finger_share(ownership: &[f64; FINGER_COUNT]) -> f64 {
    ownership[1..].iter().copied().fold(0.0, f64::max)
}

fn any_share(ownership: &[f64; FINGER_COUNT]) -> f64 {
    ownership.iter().copied().fold(0.0, f64::max)
}

/// Returns the mean of the values at the neighbours of a vertex.
pub(super) fn mean_around<T>(values: &[T], around: &[u32]) -> T
where
    T: Copy + core::iter::Sum + core::ops::Mul<f64, Output = T>,
{
    around.iter().map(|&j| values[j as usize]).sum::<T>() * (1.0 / around.len() as f64)
}

/// Subdivides the cage once and shapes it.
pub(super) fn build(anatomy: &Anatomy, field: &Field<'_>, cage: &Cage) -> Skin {
    let fine = subdivide(&cage.faces, cage.positions.len(), 1);
    let mut positions = fine.apply(&cage.positions);
    let ownership: Vec<[f64; FINGER_COUNT]> = fine
        .stencils
        .iter()
        .map(|s| {
            core::array::from_fn(|f| {
                s.iter()
                    .map(|&(i, w)| cage.ownership[i as usize][f] * w)
                    .sum()
            })
        })
        .collect();
    let edges = edge_faces(&fine.faces);
    let mut neighbours = vec![Vec::new(); positions.len()];
    for &(a, b) in edges.keys() {
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    let rim = trace_rim(&fine.faces, &edges);
    let mut on_rim = vec![false; positions.len()];
    for &v in &rim {
        on_rim[v as usize] = true;
    }
    let rim_y = rim.first().map_or(0.0, |&v| positions[v as usize].y);

    for p in &mut positions {
        *p = field.project(*p, 6, 0.7);
    }
    // Fingers keep the cage's rings; palm, webs and the base of the thumb are smoothed.
    let thumb = &anatomy.fingers[0];
    let looseness: Vec<f64> = (0..positions.len())
        .map(|i| {
            if on_rim[i] {
                return 0.0;
            }
            let palm = 1.0 - curve::smooth((any_share(&ownership[i]) - 0.55) / 0.3);
            if ownership[i][0] <= 0.3 {
                return palm;
            }
            let local = thumb.local(positions[i]);
            let leaning = 9.0 * (local.z / 11.0).clamp(-1.0, 1.0);
            palm.max(curve::smooth((thumb.along(0.90) - local.y + leaning) / 8.0))
        })
        .collect();
    for _ in 0..8 {
        let normals = vertex_normals(&positions, &fine.faces);
        let before = positions.clone();
        for (i, p) in positions.iter_mut().enumerate() {
            if looseness[i] > 0.0 {
                let d = mean_around(&before, &neighbours[i]) - before[i];
                let tangential = d - normals[i] * d.dot(normals[i]);
                *p = field.project(*p + tangential * (0.6 * looseness[i]), 1, 0.8);
            }
        }
    }
    for (i, p) in positions.iter_mut().enumerate() {
        *p = field.project(*p, 4, 0.8);
        if on_rim[i] {
            p.y = rim_y;
        }
    }

    let normals = vertex_normals(&positions, &fine.faces);
    for (i, p) in positions.iter_mut().enumerate() {
        *p += normals[i] * relief(anatomy, *p, normals[i], &ownership[i]);
        press_below_nails(anatomy, p, &ownership[i]);
    }
    let normals = vertex_normals(&positions, &fine.faces);
    Skin {
        positions,
        normals,
        faces: fine.faces,
        ownership,
        neighbours,
        rim,
    }
}

/// Follows the open edges once round.
fn trace_rim(
    faces: &[Vec<u32>],
    edges: &std::collections::BTreeMap<(u32, u32), Vec<u32>>,
) -> Vec<u32> {
    let open = |a: u32, b: u32| {
        edges
            .get(&(a.min(b), a.max(b)))
            .is_some_and(|f| f.len() == 1)
    };
    let mut next = std::collections::BTreeMap::new();
    for face in faces {
        for k in 0..face.len() {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            if open(a, b) {
                next.insert(a, b);
            }
        }
    }
    let mut rim = Vec::with_capacity(next.len());
    let mut at = next.keys().next().copied();
    while let Some(v) = at {
        rim.push(v);
        at = next.get(&v).copied().filter(|_| rim.len() < next.len());
    }
    rim
}

/// Returns the height of nail folds, tendons, knuckles, wrinkles and creases along the normal, mm.
/// Only features for a mesh spacing of 2 to 4 mm; finer lines are in the colours.
fn relief(anatomy: &Anatomy, p: DVec3, normal: DVec3, ownership: &[f64; FINGER_COUNT]) -> f64 {
    let look = &anatomy.look;
    let mut h = 0.0;
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        let mine = ownership[f];
        if mine <= 0.05 {
            continue;
        }
        let local = finger.local(p);
        let section = finger.section(local.y);
        let joints = finger.joints();
        let m = curve::smooth((mine - 0.4) / 0.3);
        if mine > 0.5 && local.z < 0.5 {
            let (e, v) = Nail::for_finger(f).outline(finger, local);
            // No fold at the free edge.
            let fold = 1.0 - curve::smooth((v - 0.55) / 0.35);
            h += finger.girth * fold * (0.5 * bell((e - 0.75) / 0.75))
                - 0.45 * fold * curve::smooth((0.25 - e) / 0.55);
        }
        let dorsal = curve::smooth((-local.z / section.dorsal - 0.15) / 0.5) * m;
        let palmar = curve::smooth((local.z / section.palmar + 0.25) / 0.6) * m;
        for (k, strength) in [(1, 1.0), (2, 0.6)] {
            let d = local.y - joints[k];
            // Slack skin forms folds over the bent side and sinks on the inner one.
            let folds = bell((d - 3.6) / 0.9) + bell((d + 3.6) / 0.9);
            h += dorsal * strength * 0.3 * bell(d / 4.5)
                - dorsal * strength * look.creases * (0.16 * bell(d / 0.9) + 0.14 * folds);
            h -= palmar * strength * 0.45 * look.creases * bell(d / 1.1);
        }
        if f > 0 {
            h -= palmar * 0.35 * bell((local.y - finger.along(0.405)) / 1.2);
        }
    }
    let body = ownership.iter().sum::<f64>();
    let dorsal = curve::smooth((-normal.z - 0.2) / 0.5) * f64::from(u8::from(body < 0.5));
    let palmar = curve::smooth((normal.z - 0.3) / 0.5) * f64::from(u8::from(body < 0.3));
    for f in 1..FINGER_COUNT {
        // Extensor tendons from the wrist to the knuckles.
        let from = DVec3::new(2.0, 4.0, 0.0) * 0.8 + anatomy.metacarpal_base[f - 1] * 0.2;
        let to = anatomy.fingers[f].origin;
        let t = ((p.y - from.y) / (to.y - from.y)).clamp(0.0, 1.15);
        let aside = p.x - (from.x + (to.x - from.x) * t);
        h += dorsal
            * 0.95
            * look.tendons
            * bell(aside / 2.6)
            * curve::smooth((t - 0.12) / 0.4)
            * curve::smooth((1.08 - t) / 0.12);
        if f < 4 {
            let valley = (anatomy.fingers[f].origin + anatomy.fingers[f + 1].origin) / 2.0;
            h -= dorsal
                * 1.5
                * look.hollows
                * bell((p.x - valley.x) / 4.5)
                * bell((p.y - valley.y - 4.0) / 10.0);
        }
    }
    h -= palmar * 3.2 * bell((p.x + 2.0) / 15.0) * bell((p.y - 52.0) / 24.0);
    // The long palmar tendon at the wrist.
    h += palmar
        * bell((p.x - 3.0) / 2.6)
        * curve::smooth((6.0 - p.y) / 12.0)
        * curve::smooth((p.y + 70.0) / 30.0);
    for crease in &super::crease::CREASES {
        let (d, fade) = crease.distance_and_depth(p);
        h -= palmar * fade * crease.depth_mm * 0.6 * look.creases * bell(d / 1.8);
    }
    h
}

/// Presses the skin under a nail plate below it, including under its free edge.
fn press_below_nails(anatomy: &Anatomy, p: &mut DVec3, ownership: &[f64; FINGER_COUNT]) {
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        let mut local = finger.local(*p);
        if ownership[f] <= 0.5 || local.z >= 0.0 {
            continue;
        }
        let (plate, width, v) = Nail::for_finger(f).plate(finger, local.x, local.y);
        let under =
            curve::smooth((width * 0.98 - local.x.abs()) / 1.8) * curve::smooth((v - 0.10) / 0.12);
        local.z += under * (plate + 0.4 - local.z).max(0.0);
        *p = finger.point(local);
    }
}

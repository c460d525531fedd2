//! Fingernails: the outline on the skin, and the plate, a separate shell that is rigid to the last
//! bone.

use raconteur_base::{DVec3, curve, ops};

use super::anatomy::Finger;

/// Position and width of a nail on its finger.
#[derive(Clone, Copy)]
pub(super) struct Nail {
    /// Joint coordinate of the root.
    pub(super) root: f64,
    /// Joint coordinate where plate and skin part.
    pub(super) end: f64,
    /// Half width of the plate as a fraction of the finger's half width.
    pub(super) width: f64,
}

impl Nail {
    /// Returns the nail of a finger, thumb 0 to little finger 4.
    pub(super) fn for_finger(f: usize) -> Self {
        let (root, end, width) = match f {
            0 => (2.37, 2.86, 0.82),
            4 => (2.39, 2.87, 0.78),
            _ => (2.39, 2.87, 0.79),
        };
        Self { root, end, width }
    }

    /// Returns the signed distance to the outline of the nail, mm, negative on the plate; and the
    /// position along it, −1 at the root to 1 at the end.
    pub(super) fn outline(self, finger: &Finger, local: DVec3) -> (f64, f64) {
        let (root, end) = (finger.along(self.root), finger.along(self.end));
        let (middle, half) = ((root + end) / 2.0, (end - root) / 2.0);
        let width = finger.section(middle).half_width * self.width;
        let v = (local.y - middle) / half;
        // The root is rounder than the free edge.
        let n = if v < 0.0 { 2.9 } else { 3.6 };
        let k = ops::pow(
            ops::pow((local.x / width).abs(), n) + ops::pow(v.abs(), n) + 1e-9,
            1.0 / n,
        );
        ((k - 1.0) * width.min(half), v)
    }

    /// Returns the plate's surface over a point of the finger: palmar coordinate (negative), half
    /// width there, and position along the plate, 0 at the buried root to 1 at the free edge.
    ///
    /// The plate follows the finger's cross-section, with its sides tucked in, and continues
    /// straight where the pulp rounds off.
    pub(super) fn plate(self, finger: &Finger, lateral: f64, along: f64) -> (f64, f64, f64) {
        let (root, end) = (finger.along(self.root), finger.along(self.end));
        let width = finger.section((root + end) / 2.0).half_width * self.width * 1.04;
        let straight_from = finger.along(2.5);
        let section = finger.section(along.min(straight_from));
        let slope = (finger.section(straight_from).dorsal
            - finger.section(straight_from - 3.0).dorsal)
            / 3.0;
        let beyond = (along - straight_from).max(0.0);
        let dorsal = section.dorsal + 0.7 * slope * beyond - 0.008 * beyond * beyond;
        let u = (lateral.abs() / width).min(1.1);
        let v = (along - root + 1.3) / (end - root + 3.0);
        let x = (lateral / section.half_width).abs().min(0.98);
        let curve = ops::pow(1.0 - ops::pow(x, 2.25), 1.0 / 2.25);
        let tuck = 0.5 * u * u * u * u * u;
        let root_dip = 0.75 * ((0.13 - v) / 0.13).max(0.0);
        (-dorsal * curve + 0.02 + tuck + root_dip, width, v)
    }
}

/// Mesh of a nail plate in the bind pose.
pub(super) struct Plate {
    pub(super) positions: Vec<DVec3>,
    pub(super) faces: Vec<Vec<u32>>,
    /// Across −1..1 and along 0 (root) to 1 (free edge).
    pub(super) parameters: Vec<(f64, f64)>,
}

const ACROSS: usize = 8;
const ALONG: usize = 5;
const THICKNESS: f64 = 0.5;

/// Builds the nail plate of a finger, which ends `free_mm` beyond the nail's end: a closed shell.
/// Its underside is visible only at the free edge, where it has a lip; behind that it spans
/// straight from side to side, inside the finger.
pub(super) fn plate(finger: &Finger, f: usize, free_mm: f64) -> Plate {
    let nail = Nail::for_finger(f);
    let (root, end) = (
        finger.along(nail.root) - 1.3,
        finger.along(nail.end) + free_mm,
    );
    let length = end - root;
    let mut local = Vec::new();
    let mut parameters = Vec::new();
    for j in 0..=ALONG {
        // Rows are denser at the free edge, whose outline is visible.
        let v = 1.0 - ops::pow(1.0 - j as f64 / ALONG as f64, 1.25);
        for i in 0..=ACROSS {
            // Columns crowd at the sides, where the section curves most.
            let u = ops::sin((i as f64 / ACROSS as f64 - 0.5) * core::f64::consts::PI * 0.86)
                / ops::sin(0.43 * core::f64::consts::PI);
            let width = nail.plate(finger, 0.0, root + length * v).1;
            let rounded_root = 1.0 - 0.55 * ops::pow(((0.30 - v) / 0.30).max(0.0), 2.6);
            let rounded_end = 1.0 - 0.13 * ops::pow(((v - 0.8) / 0.2).max(0.0), 2.0);
            let x = u * width * rounded_root * rounded_end;
            // The free edge is an arc whose corners draw back.
            let bow = ops::pow(u.abs(), 2.6);
            let along = root + length * v - 0.16 * length * bow * curve::smooth((v - 0.6) / 0.4)
                + bow * (1.0 - v) * (1.0 - v) * (1.0 - v) * 1.5;
            local.push(DVec3::new(x, along, nail.plate(finger, x, along).0));
            parameters.push((u, v));
        }
    }
    let index = |i: usize, j: usize| (j * (ACROSS + 1) + i) as u32;
    // The lip hangs between the two corners of the free edge.
    let lip_from = local.len() as u32;
    for i in 1..ACROSS {
        let edge = index(i, ALONG) as usize;
        local.push(local[edge] + DVec3::new(0.0, -0.1, THICKNESS));
        parameters.push(parameters[edge]);
    }
    let lip = |i: usize| match i {
        0 => index(0, ALONG),
        ACROSS => index(ACROSS, ALONG),
        _ => lip_from + i as u32 - 1,
    };
    let mut faces = Vec::new();
    for j in 0..ALONG {
        for i in 0..ACROSS {
            // Lateral × along is palmar, so the dorsal side has the opposite winding.
            faces.push(vec![
                index(i, j),
                index(i, j + 1),
                index(i + 1, j + 1),
                index(i + 1, j),
            ]);
        }
    }
    for i in 0..ACROSS {
        let mut face = vec![index(i + 1, ALONG), index(i, ALONG), lip(i), lip(i + 1)];
        face.dedup();
        if face.first() == face.last() {
            face.pop();
        }
        faces.push(face);
    }
    // Underside: rows of the two sides, and the ends as strips.
    for j in 0..ALONG {
        faces.push(vec![
            index(0, j),
            index(ACROSS, j),
            index(ACROSS, j + 1),
            index(0, j + 1),
        ]);
    }
    for i in 1..ACROSS {
        faces.push(vec![index(0, 0), index(i, 0), index(i + 1, 0)]);
        faces.push(vec![lip(0), lip(i + 1), lip(i)]);
    }
    Plate {
        positions: local.into_iter().map(|p| finger.point(p)).collect(),
        faces,
        parameters,
    }
}

//! Distance of a face from a reference: a mesh of a human face in an OBJ file, with an accompanying
//! list of the 68 landmarks of the iBUG scheme.
//!
//! The reference serves only for measurement: none of its vertices enters a figure. Alignment is by
//! similarity, first on landmarks, then on closest points.

use std::collections::BTreeMap;

use raconteur_base::DVec3;
use serde_json::Value;

use crate::cells::Cells;
use crate::measure::landmark_mm;
use crate::scan::{BadLine, Scan};
use crate::similarity::Similarity;
use crate::surface::on_triangle;
use raconteur_body::annotation::Annotations;
use raconteur_body::figure::Figure;

/// Published face mesh with 68 landmarks, against which generated faces are compared; in its own
/// units.
#[derive(Clone, Debug)]
pub struct ReferenceFace {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Triangles around each point.
    around: Vec<Vec<u32>>,
    /// Points of the 68 landmarks.
    landmarks: Vec<u32>,
}

/// Error returned when a reference face cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceFaceError {
    /// A line of the OBJ file is no number or points outside.
    #[error("line {0} of the mesh is not understood")]
    Line(usize),
    /// The list of landmarks is missing or wrong.
    #[error("the list of landmarks holds no 68 vertices of the mesh")]
    Landmarks,
    /// The figure's own names do not suffice.
    #[error("the figure has no landmark {0}")]
    Figure(&'static str),
}

/// Number of vertices of the face area; the vertices after it are eyes, teeth and sockets.
const FACE_AREA: usize = 9409;

/// iBUG landmark and our name.
const PAIRS: [(usize, &str); 12] = [
    (8, "gn"),
    (27, "n"),
    (30, "prn"),
    (33, "sn"),
    (36, "ex_r"),
    (39, "en_r"),
    (42, "en_l"),
    (45, "ex_l"),
    (48, "ch_r"),
    (54, "ch_l"),
    (51, "ls"),
    (57, "li"),
];

impl ReferenceFace {
    /// Reads the mesh (OBJ) and its list of landmarks (JSON with `idx_to_landmark_verts`).
    ///
    /// # Errors
    /// Returns a [`ReferenceFaceError`] that describes the first problem.
    pub fn read(obj: &str, landmarks: &str) -> Result<Self, ReferenceFaceError> {
        let scan = Scan::read(obj).map_err(|BadLine(line)| ReferenceFaceError::Line(line))?;
        let mut triangles: Vec<[u32; 3]> = scan.triangles().collect();
        let mut points = scan.points;
        points.truncate(FACE_AREA);
        triangles.retain(|t| t.iter().all(|&v| (v as usize) < points.len()));
        let list: Value =
            serde_json::from_str(landmarks).map_err(|_| ReferenceFaceError::Landmarks)?;
        let landmarks: Vec<u32> = list["idx_to_landmark_verts"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|v| u32::try_from(v.as_u64()?).ok())
            .filter(|&v| (v as usize) < points.len())
            .collect();
        if landmarks.len() != 68 {
            return Err(ReferenceFaceError::Landmarks);
        }
        let mut around = vec![Vec::new(); points.len()];
        for (t, triangle) in (0u32..).zip(&triangles) {
            for &v in triangle {
                around[v as usize].push(t);
            }
        }
        Ok(Self {
            points,
            triangles,
            around,
            landmarks,
        })
    }
}

/// Statistics of the distance of a face from the reference face, millimetres of the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Root of the mean square.
    pub rms_mm: f64,
    /// 95th percentile of the distances.
    pub p95_mm: f64,
    /// Root of the mean square over the landmarks used.
    pub landmarks_mm: f64,
    /// Scale from the yardstick's units to millimetres of the face.
    pub scale: f64,
    /// Number of compared points.
    pub count: usize,
}

/// Cell size for the nearest-vertex search, millimetres.
const CELL_MM: f64 = 6.0;

/// Returns the nearest point within about a cell's width; `None` if there is none.
fn nearest(cells: &Cells, points: &[DVec3], p: DVec3) -> Option<u32> {
    let distance = |v: u32| points[v as usize].distance_squared(p);
    cells
        .neighbours(p)
        .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

/// Returns the vertices of the visible face, millimetres: skin in front, without ears, neck, the
/// inside of lips, lids and nostrils. Selected by direction: surfaces turned more than 80° away
/// from a viewer in front are excluded, as is skin covered by other skin.
fn visible_face(figure: &Figure, names: &Annotations) -> Result<Vec<DVec3>, ReferenceFaceError> {
    let need = |name: &'static str| {
        landmark_mm(figure, names, name).ok_or(ReferenceFaceError::Figure(name))
    };
    let (n, gn, left, right) = (need("n")?, need("gn")?, need("zy_l")?, need("zy_r")?);
    let skin = names.landmark("n").map_or(0, |l| l.mesh);
    let mesh = &figure.meshes[skin];
    let half = (left.x - right.x) / 2.0 * 0.9;
    let height = n.y - gn.y;
    // The compared segments exclude eyes, ears, nostrils and the rest.
    let mut counts = vec![false; mesh.positions.len()];
    for s in names.segments.iter().filter(|s| s.mesh == skin) {
        let hidden = ["ears", "rest", "eyes and lids", "nose base"];
        if hidden.contains(&s.name.as_str()) {
            continue;
        }
        for &[first, count] in &s.runs {
            let run = first as usize..(first + count) as usize;
            if let Some(run) = counts.get_mut(run) {
                run.fill(true);
            }
        }
    }
    // The front-most skin in each cell of a frontal grid: skin 4 mm behind it is covered.
    let at = |i: usize| DVec3::from_array(mesh.positions[i].map(f64::from)) * 1e3;
    let frontal = |p: DVec3| [(p.x / 2.5).round() as i32, (p.y / 2.5).round() as i32];
    let mut front: BTreeMap<[i32; 2], f64> = BTreeMap::new();
    for i in 0..mesh.positions.len() {
        let p = at(i);
        let z = front.entry(frontal(p)).or_insert(f64::MIN);
        *z = z.max(p.z);
    }
    Ok((0..mesh.positions.len())
        .filter(|&i| {
            let p = at(i);
            counts[i]
                && mesh.normals[i][2] > 0.17
                && (p.x - n.x).abs() < half
                && p.y > gn.y - 0.02 * height
                && p.y < n.y + 0.45 * height
                && front.get(&frontal(p)).is_none_or(|&z| p.z > z - 4.0)
        })
        .map(at)
        .collect())
}

const ROUNDS: usize = 12;

/// Aligns the yardstick to the figure and measures from the figure's visible face to it.
///
/// # Errors
/// Returns [`ReferenceFaceError::Figure`] if the figure lacks a landmark.
pub fn deviation(
    figure: &Figure,
    names: &Annotations,
    yardstick: &ReferenceFace,
) -> Result<Deviation, ReferenceFaceError> {
    let pairs = PAIRS
        .iter()
        .map(|&(i, name)| {
            let ours = landmark_mm(figure, names, name).ok_or(ReferenceFaceError::Figure(name))?;
            Ok((yardstick.points[yardstick.landmarks[i] as usize], ours))
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut fit = Similarity::best(&pairs);
    let face = visible_face(figure, names)?;
    let mut distances = Vec::new();
    for _ in 0..ROUNDS {
        let placed: Vec<DVec3> = yardstick.points.iter().map(|&p| fit.apply(p)).collect();
        let cells = Cells::new(&placed, CELL_MM);
        let mut matches = Vec::with_capacity(face.len());
        distances.clear();
        for &p in &face {
            let Some(near) = nearest(&cells, &placed, p) else {
                distances.push(CELL_MM * 2.0);
                continue;
            };
            let mut best = (f64::MAX, DVec3::ZERO);
            for &t in &yardstick.around[near as usize] {
                let corners = yardstick.triangles[t as usize].map(|v| placed[v as usize]);
                let q = on_triangle(p, corners);
                if q.distance_squared(p) < best.0 {
                    best = (q.distance_squared(p), q);
                }
            }
            if best.0 < f64::MAX {
                distances.push(best.0.sqrt());
                let source = fit.undo(best.1);
                matches.push((source, p));
            }
        }
        fit = Similarity::best(&matches);
    }
    distances.sort_by(f64::total_cmp);
    let mean = distances.iter().map(|d| d * d).sum::<f64>() / distances.len().max(1) as f64;
    let at_landmarks = pairs
        .iter()
        .map(|&(a, b)| fit.apply(a).distance_squared(b))
        .sum::<f64>()
        / pairs.len() as f64;
    Ok(Deviation {
        rms_mm: mean.sqrt(),
        p95_mm: distances
            .get(distances.len() * 95 / 100)
            .copied()
            .unwrap_or(f64::INFINITY),
        landmarks_mm: at_landmarks.sqrt(),
        scale: fit.scale,
        count: distances.len(),
    })
}

//! Generated head fitted to an imported head, and the resulting figure.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side};
use raconteur_body::annotation::{Annotations, Landmark};
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};
use raconteur_body::skeleton::{Bone, Drive, FaceJoints};
use raconteur_tissue::Tissue;
use raconteur_tissue::tissue::FibreCurve;

use super::{Landmarks, REACH_M};
use crate::assemble::{Blueprint, PartWithNormals, assemble};
use crate::build::{build_face, face_tissue, leave_to_tissue};
use crate::built::AnnotatedFigure;
use crate::mannequin::Mannequin;
use crate::part::{JointRef, MOUTH_BAG, MeshPart, PartVertex};
use crate::people::FigureParams;
use crate::scan::Scan;
use crate::similarity::Similarity;
use crate::subdivide::{firsts, welded};
use crate::surface::{Place, Surface};
use crate::tissue::Warp;
use raconteur_base::surface::vertex_normals;

/// Minimum cosine between the normals of matched positions.
const FACING: f64 = 0.4;
/// Number of rounds in which unmatched vertices follow their neighbours; the next constant is the
/// number of smoothing rounds for the others.
const SPREAD: usize = 60;
const EVEN: usize = 4;
/// Minimum distance of lids from the centre of their eye; the next constant is the maximum backward
/// shift of the eye for it, metres.
const LID_RADIUS_M: f64 = 0.0130;
const MAX_BACK_M: f64 = 0.003;
/// Depth behind the borders of the lips at which the mouth follows the teeth, metres.
const BEHIND_LIPS_M: f64 = 0.016;
/// Distances from the generated skin at which a position starts to follow the tissue less, and at
/// which it no longer follows, metres.
const FOLLOWS_M: [f64; 2] = [0.006, 0.015];
/// Skin of a head without colours, linear RGB.
const SKIN: [f64; 3] = [0.50, 0.29, 0.21];

/// Generated head, bent and laid onto an imported head mesh that is to be rigged.
pub(super) struct FittedHead {
    made: Mannequin,
    /// Generated skin and mouth cavity before and after fitting, world, metres.
    before: Surface,
    after: Surface,
    /// Part and vertex of each point.
    sources: Vec<(usize, usize)>,
    warp: Warp,
}

/// Bends our head through the landmarks and lays it on the other's surface.
pub(super) fn fit_head(made: Mannequin, warp: Warp, theirs: &Surface) -> FittedHead {
    let mut sources = Vec::new();
    let mut points = Vec::new();
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for (p, part) in made.head_parts.iter().enumerate() {
        if p > 0 && part.name != MOUTH_BAG {
            continue;
        }
        let first = points.len() as u32;
        points.extend(part.vertices.iter().map(|v| v.position));
        sources.extend((0..part.vertices.len()).map(|v| (p, v)));
        faces.extend(
            part.faces
                .iter()
                .map(|f| f.iter().map(|v| v + first).collect()),
        );
    }
    let (first, welded) = (firsts(&points), welded(&points, &faces));
    let bent: Vec<DVec3> = points.iter().map(|&p| warp.place(p * 1e3) * 1e-3).collect();
    let normals = vertex_normals(&bent, &welded);
    let lips = lips(&made);
    let middle = lips
        .map(|p| warp.place(p * 1e3) * 1e-3 - p)
        .into_iter()
        .sum::<DVec3>()
        / 2.0;
    let inside = lips.map(|p| p.z).into_iter().fold(f64::MAX, f64::min) - BEHIND_LIPS_M;
    let found: Vec<Option<DVec3>> = (0..points.len())
        .map(|v| {
            if sources[v].0 > 0 {
                // The mouth bag follows the lips, and deeper in the mouth the teeth.
                return (points[v].z < inside).then_some(points[v] + middle - bent[v]);
            }
            let place = theirs.nearest(bent[v], |place| place.normal.dot(normals[v]) > FACING)?;
            Some(place.at - bent[v])
        })
        .collect();
    let shifts = spread(&found, &neighbours(&welded, points.len()));
    let shifts = first.iter().map(|&v| shifts[v as usize]);
    let laid = bent.iter().zip(shifts).map(|(&p, s)| p + s).collect();
    let triangles: Vec<[u32; 3]> = faces
        .iter()
        .flat_map(|f| {
            f[1..]
                .windows(2)
                .map(|w| [f[0], w[0], w[1]])
                .collect::<Vec<_>>()
        })
        .collect();
    FittedHead {
        made,
        before: Surface::new(points, triangles.clone(), 2.0 * REACH_M),
        after: Surface::new(laid, triangles, 2.0 * REACH_M),
        sources,
        warp,
    }
}

/// Returns the midpoints of the upper and the lower lip border of the generated head.
fn lips(made: &Mannequin) -> [DVec3; 2] {
    let skin = &made.head_parts[0];
    ["ls", "li"].map(|name| {
        let own = made.head.landmarks.iter().find(|(n, _)| n == name);
        own.map_or(DVec3::ZERO, |(_, v)| skin.vertices[*v as usize].position)
    })
}

/// Returns the neighbours of each point; coincident vertices count as one.
fn neighbours(welded: &[Vec<u32>], count: usize) -> Vec<Vec<u32>> {
    let mut all = vec![Vec::new(); count];
    for face in welded {
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            all[a as usize].push(b);
            all[b as usize].push(a);
        }
    }
    all
}

/// Returns displacements for all points: unmatched ones follow their neighbours, and all are
/// slightly smoothed.
fn spread(found: &[Option<DVec3>], neighbours: &[Vec<u32>]) -> Vec<DVec3> {
    let mut shifts: Vec<DVec3> = found.iter().map(|f| f.unwrap_or(DVec3::ZERO)).collect();
    let mean = |shifts: &[DVec3], v: usize| {
        let near = &neighbours[v];
        let sum: DVec3 = near.iter().map(|&u| shifts[u as usize]).sum();
        sum / near.len().max(1) as f64
    };
    for round in 0..SPREAD + EVEN {
        shifts = (0..shifts.len())
            .map(|v| match found[v] {
                Some(own) if round < SPREAD => own,
                Some(_) => (shifts[v] + mean(&shifts, v)) / 2.0,
                None => mean(&shifts, v),
            })
            .collect();
    }
    shifts
}

impl FittedHead {
    /// Returns the displacement of the skin nearest to a generated position.
    fn shift(&self, p: DVec3) -> DVec3 {
        let Some(place) = self.before.nearest(p, |_| true) else {
            return self.warp.place(p * 1e3) * 1e-3 - p;
        };
        let moved = |v: u32| self.after.points[v as usize] - self.before.points[v as usize];
        let corners = place.corners.iter().zip(place.shares);
        corners.map(|(&v, share)| moved(v) * share).sum()
    }

    /// Builds the figure of the imported head.
    pub(super) fn figure(
        mut self,
        scan: &Scan,
        theirs: &Surface,
        landmarks: &Landmarks,
        fit: &Similarity,
        params: &FigureParams,
    ) -> AnnotatedFigure {
        let ours = self.reference(params);
        let skin = self.skin(scan, theirs);
        let middle = self.contact_shift();
        let eyes = Side::BOTH.map(|side| self.eye_shift(side, &skin));
        let mut pieces = vec![skin];
        for part in self.made.head_parts.clone().into_iter().skip(1) {
            pieces.push(self.moved(part, middle, eyes));
        }
        let place = self.made.world_from_head;
        let hinge = place.transform_point3(self.made.head.jaw_hinge);
        let moved_hinge = hinge + self.shift(hinge);
        self.made.joints.positions[Bone::Chin.index()] = moved_hinge;
        let eye_centres = self
            .made
            .head
            .eye_centres
            .map(|p| place.transform_point3(p));
        let mut figure = assemble(&Blueprint {
            name: params.name.clone(),
            positions_in_world: self.made.joints.positions,
            bind_rotations: self.made.joints.rotations,
            face: FaceJoints {
                eye_centres: [eye_centres[0] + eyes[0], eye_centres[1] + eyes[1]],
            },
            stature_m: params.person.stature_m,
            lid_closure_rad: self.made.head.lid_closure_rad,
            pieces: pieces.into_iter().map(PartWithNormals::from).collect(),
            chains: Vec::new(),
            images: Vec::new(),
        });
        figure.sex = Some(params.person.sex);
        figure.tissue = Some(self.tissue(ours, moved_hinge, middle));
        leave_to_tissue(&mut figure);
        let mesh = figure
            .meshes
            .iter()
            .position(|m| m.name == SCAN)
            .unwrap_or(0);
        let annotations = Annotations {
            landmarks: landmarks
                .iter()
                .filter_map(|(name, &p)| {
                    let place = theirs.nearest(fit.apply(p), |_| true)?;
                    let best =
                        (0..3).max_by(|&a, &b| place.shares[a].total_cmp(&place.shares[b]))?;
                    Some(Landmark {
                        name: name.clone(),
                        mesh,
                        vertex: place.corners[best],
                    })
                })
                .collect(),
            ..Annotations::default()
        };
        AnnotatedFigure {
            figure,
            annotations,
        }
    }

    /// Returns the tissue of the generated head before fitting.
    fn reference(&self, params: &FigureParams) -> Tissue {
        let built = build_face(params);
        built.figure.tissue.clone().unwrap_or_else(|| {
            face_tissue(&self.made.head, self.made.world_from_head, &built.figure)
        })
    }

    /// Builds the skin part of the imported mesh, with the joint weights and node weights of the
    /// fitted head.
    fn skin(&self, scan: &Scan, theirs: &Surface) -> MeshPart {
        let normals = vertex_normals(&theirs.points, &scan.faces);
        let mut part = MeshPart {
            name: SCAN.to_owned(),
            material: Material {
                kind: MaterialKind::Skin,
                base_color: [1.0; 4],
                roughness: 0.48,
                double_sided: false,
                maps: TextureMaps::default(),
            },
            vertices: Vec::with_capacity(theirs.points.len()),
            faces: scan.faces.clone(),
            morphs: Vec::new(),
            bound: Vec::new(),
        };
        for (v, (&p, n)) in theirs.points.iter().zip(&normals).enumerate() {
            let facing = |place: &Place| place.normal.dot(*n) > 0.0;
            let place = self.after.nearest(p, facing);
            let [r, g, b] = scan.colors.get(v).copied().unwrap_or(SKIN);
            let rest = vec![(JointRef(Drive::Bone(Bone::Skull)), 1.0)];
            part.vertices.push(PartVertex {
                position: p,
                uv: [0.0; 2],
                color: [r, g, b, 1.0],
                weights: place.map_or(rest, |place| self.weights(&place)),
            });
            if let Some(row) = place
                .map(|place| self.row(p, &place))
                .filter(|r| !r.is_empty())
            {
                part.bound.push((v as u32, row));
            }
        }
        part
    }

    fn source(&self, corner: u32) -> &PartVertex {
        let (part, v) = self.sources[corner as usize];
        &self.made.head_parts[part].vertices[v]
    }

    /// Returns the joint weights at a generated position.
    fn weights(&self, place: &Place) -> Vec<(JointRef, f64)> {
        let mut all: Vec<(JointRef, f64)> = Vec::new();
        for (&corner, share) in place.corners.iter().zip(place.shares) {
            let own = &self.source(corner).weights;
            let sum: f64 = own.iter().map(|w| w.1).sum();
            for &(joint, weight) in own {
                let weight = weight / sum * share;
                match all.iter_mut().find(|w| w.0 == joint) {
                    Some(known) => known.1 += weight,
                    None => all.push((joint, weight)),
                }
            }
        }
        all.retain(|w| w.1 > 1e-4);
        all
    }

    /// Returns the nodes that a position follows, with less weight the farther it is from the
    /// generated skin.
    fn row(&self, p: DVec3, place: &Place) -> Vec<(u32, f64)> {
        let [near, far] = FOLLOWS_M;
        let away = raconteur_base::curve::smooth((place.at.distance(p) - near) / (far - near));
        let mut all: BTreeMap<u32, f64> = BTreeMap::new();
        for (&corner, share) in place.corners.iter().zip(place.shares) {
            let (part, v) = self.sources[corner as usize];
            let bound = &self.made.head_parts[part].bound;
            let Ok(at) = bound.binary_search_by_key(&(v as u32), |row| row.0) else {
                continue;
            };
            for &(node, weight) in &bound[at].1 {
                *all.entry(node).or_default() += weight * share * (1.0 - away);
            }
        }
        all.into_iter().filter(|(_, w)| *w > 1e-4).collect()
    }

    /// Returns the displacement of the lips in the middle.
    fn contact_shift(&self) -> DVec3 {
        let shifts = lips(&self.made).map(|p| self.shift(p));
        (shifts[0] + shifts[1]) / 2.0
    }

    /// Returns the displacement of an eye: the mean of its corners and the middles of its lids,
    /// shifted back so that lids can slide over it.
    fn eye_shift(&self, side: Side, skin: &MeshPart) -> DVec3 {
        let end = if side == Side::Left { "l" } else { "r" };
        let names = ["en", "ex", "ps", "pi"].map(|n| format!("{n}_{end}"));
        let own = self.made.head.landmarks.iter();
        let shifts: Vec<DVec3> = own
            .filter(|(n, _)| names.contains(n))
            .map(|(_, v)| self.after.points[*v as usize] - self.before.points[*v as usize])
            .collect();
        let shift = shifts.iter().sum::<DVec3>() / shifts.len().max(1) as f64;
        let centre = self.made.head.eye_centres[side.index()];
        let centre = self.made.world_from_head.transform_point3(centre) + shift;
        let lids = [Drive::UpperLid(side), Drive::LowerLid(side)];
        let is_lid = |v: &&PartVertex| {
            let share = v.weights.iter().filter(|w| lids.contains(&w.0.0));
            share.map(|w| w.1).sum::<f64>() > 0.5
        };
        let back = skin.vertices.iter().filter(is_lid).filter_map(|v| {
            let d = v.position - centre;
            let off = LID_RADIUS_M * LID_RADIUS_M - d.truncate().length_squared();
            (off > 0.0).then(|| d.z - off.sqrt())
        });
        shift + DVec3::Z * back.fold(0.0, f64::min).max(-MAX_BACK_M)
    }

    /// Fits a generated part to the other head: teeth and tongue follow the lips, eyeballs their
    /// corners, lining, lashes and brows the skin near them.
    fn moved(&self, mut part: MeshPart, middle: DVec3, eyes: [DVec3; 2]) -> MeshPart {
        if part.name == MOUTH_BAG {
            let laid = self.sources.iter().zip(&self.after.points);
            let bag = laid.filter(|((part, _), _)| *part > 0).map(|(_, p)| p);
            for (v, p) in part.vertices.iter_mut().zip(bag) {
                v.position = *p;
            }
            return part;
        }
        for v in &mut part.vertices {
            let side = usize::from(v.position.x < 0.0);
            v.position += match part.material.kind {
                MaterialKind::Eye | MaterialKind::Cornea => eyes[side],
                MaterialKind::Mouth if part.name.starts_with("caruncle") => eyes[side],
                MaterialKind::Teeth | MaterialKind::Mouth => middle,
                _ => self.shift(v.position),
            };
        }
        part
    }

    /// Moves the tissue of the generated head onto the imported head.
    fn tissue(&self, mut ours: Tissue, hinge: DVec3, middle: DVec3) -> Tissue {
        let wide = |p: [f32; 3]| DVec3::from_array(p.map(f64::from));
        let narrow = |p: DVec3| p.to_array().map(|x| x as f32);
        let moved = |p: &mut [f32; 3]| *p = narrow(wide(*p) + self.shift(wide(*p)));
        ours.hinge = narrow(hinge);
        ours.rest.iter_mut().for_each(moved);
        ours.points.iter_mut().for_each(|p| moved(&mut p.rest));
        for fibre in &mut ours.fibres {
            if let FibreCurve::Towards(place) = &mut fibre.course {
                moved(place);
            }
        }
        for column in &mut ours.columns {
            column.edge = narrow(wide(column.edge) + middle);
        }
        for arch in &mut ours.arches {
            arch.origin = narrow(wide(arch.origin) + middle);
        }
        ours
    }
}

/// Name of the other's mesh.
pub(super) const SCAN: &str = "scan";

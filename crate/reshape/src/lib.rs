//! New faces for figures: the skin takes the shape of a face model, and all parts in it or on it
//! follow (F&H 5.1 has no such feature; its faces do not move).
//!
//! Scope: skin, tissue, eyes, teeth and brows for a new face; donor hair and beards, fitted to it;
//! glasses, jewellery and hats; positions of freckles, moles and other marks.
//! Out of scope: face models (the crate takes their numbers), hair generation (`sculpt`), and
//! motion.

mod accessory;
mod carry;
mod donor;
mod hairs;
mod look;
mod scalp;
mod speckle;
mod surface_point;
#[cfg(test)]
mod tests;

use std::sync::OnceLock;

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DVec3};

pub use self::accessory::{Accessory, AccessoryKind};
use self::carry::{CarriedMesh, SkinAnchor};
pub use self::donor::HairDonor;
pub use self::look::{Hair, HairDonors, Look};
pub use self::scalp::ScalpPaint;
pub use self::speckle::{Speckle, SpeckleKind};
pub use self::surface_point::{Chart, SurfacePoint};
use raconteur_body::face::Tissue;
use raconteur_body::figure::{Figure, MaterialKind, Mesh};
use raconteur_body::skeleton::{Bone, Drive, Skeleton};

/// Position of the skull joint in the frame of a head, whose origin is between the tragions,
/// metres.
pub const SKULL_IN_HEAD_M: DVec3 = DVec3::new(0.0, -0.018, -0.008);
/// Height in the frame of the head at which a face blends into the neck of the body, and the
/// distance below it beyond which nothing moves, metres.
const NECK_FROM_M: f64 = -0.088;
const NECK_M: f64 = 0.047;
/// Minimum height of the chin above the start of the neck, metres.
const UNDER_CHIN_M: f64 = 0.0045;

/// New face for a figure: skin, colours and inner parts. Frame of the head: origin between the
/// tragions, x left, y up, z front; metres.
#[derive(Clone, Copy, Debug)]
pub struct NewFace<'a> {
    /// Vertices of the skin, x, y and z of each; those of the figure's head in their order.
    pub skin: &'a [f64],
    /// Factors of linear red, green and blue at each of them; empty to leave colours.
    pub tone: &'a [f64],
    /// Inner parts of the head.
    pub organs: NewOrgans,
    /// Factor of the colour of the irises, linear.
    pub iris: [f64; 3],
    /// Factor of the colour of brows and lashes, linear.
    pub brows: [f64; 3],
}

impl<'a> NewFace<'a> {
    /// Builds a face from the numbers of a face model. The factors are those of each vertex, of the
    /// irises and of the brows, one after another, or empty.
    #[must_use]
    pub fn from_numbers(skin: &'a [f64], factors: &'a [f64], organs: NewOrgans) -> Self {
        let (tone, rest) = factors.split_at(factors.len().saturating_sub(6));
        let colour = |rest: &[f64]| <[f64; 3]>::try_from(rest).unwrap_or([1.0; 3]);
        let (iris, brows) = rest.split_at(rest.len() / 2);
        Self {
            skin,
            tone,
            organs,
            iris: colour(iris),
            brows: colour(brows),
        }
    }
}

/// Inner parts of a new face (eyes, lids, chin), in the frame of the head; metres and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewOrgans {
    /// Centres of the left and the right eyeball.
    pub eye_centres: [DVec3; 2],
    /// Turn of the upper lid that closes the eye, left and right.
    pub lid_closure_rad: [f64; 2],
    /// Height of the chin's lowest point.
    pub chin: f64,
}

impl NewOrgans {
    /// Parses consecutive numbers in the order of the fields; `None` unless there are exactly nine
    /// finite ones.
    #[must_use]
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let all: [f64; 9] = numbers.try_into().ok()?;
        let at = |i: usize| DVec3::new(all[i], all[i + 1], all[i + 2]);
        all.iter().all(|x| x.is_finite()).then(|| Self {
            eye_centres: [at(0), at(3)],
            lid_closure_rad: [all[6], all[7]],
            chin: all[8],
        })
    }
}

/// Error returned when a figure cannot be given a face.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReshapeError {
    /// The figure is not one of those that faces are made for.
    #[error("the figure has no head that a face of the model fits: {why}")]
    OtherHead {
        /// Description of the missing item.
        why: &'static str,
    },
    /// The face is of another model.
    #[error("the face has {found} vertices, the head of the figure has {expected}")]
    OtherFace {
        /// Vertices of the face.
        found: usize,
        /// Vertices of the head.
        expected: usize,
    },
    /// There is no hair donor of this name.
    #[error("there is no hair donor {0:?}")]
    NoDonor(String),
    /// A number of the face is not finite.
    #[error("the face holds a number that is not finite")]
    NotFinite,
}

/// Figure prepared to receive new faces: all parts of its head are anchored to its skin.
///
/// # Examples
///
/// ```no_run
/// use raconteur_body::read::read_figure;
/// use raconteur_reshape::{NewFace, NewOrgans, Reshaper};
///
/// # fn example(skin: &[f64], organs: &[f64]) -> Result<(), Box<dyn std::error::Error>> {
/// let figure = read_figure("sofia", &std::fs::read("../../assets/figures/sofia.glb")?)?;
/// let reshaper = Reshaper::new(figure, skin.len() / 3)?;
/// let organs = NewOrgans::from_numbers(organs).ok_or("other numbers")?;
/// let reshaped = reshaper.with_face(&NewFace::from_numbers(skin, &[], organs))?;
/// assert_eq!(reshaped.skeleton.joints().len(), reshaper.figure().skeleton.joints().len());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Reshaper {
    figure: Figure,
    /// Mesh of the skin; its first vertices are the head's.
    head: usize,
    vertices: usize,
    /// Origin of the head's frame, world, metres.
    origin: DVec3,
    /// Triangles of the head.
    triangles: Vec<[u32; 3]>,
    /// First vertex at the position of each vertex: seams of the texture share one normal.
    first: Vec<u32>,
    /// Binding of each mesh to the skin.
    meshes: Vec<Option<CarriedMesh>>,
    /// Nodes and points of fibres of the tissue.
    nodes: Vec<SkinAnchor>,
    points: Vec<SkinAnchor>,
    /// Midpoint of the line where the lips meet: reference of teeth, gums and tongue.
    lips: SkinAnchor,
    /// Mask of the skin vertices with the figure's own hair, computed on first use.
    scalp: OnceLock<Vec<bool>>,
}

fn wide(p: [f32; 3]) -> DVec3 {
    DVec3::from_array(p.map(f64::from))
}

fn narrow(p: DVec3) -> [f32; 3] {
    p.to_array().map(|x| x as f32)
}

/// Returns the height in the frame of the head at which a face with the given chin blends into the
/// neck, metres.
fn neck_from(chin: f64) -> f64 {
    NECK_FROM_M.min(chin + UNDER_CHIN_M)
}

/// Returns the displacement of a vertex to its position on a face, metres, frame of the head.
fn moved(place: DVec3, own: DVec3, neck_from: f64) -> DVec3 {
    let lower = own.y.min(place.y);
    (place - own) * (1.0 - smooth((neck_from - lower) / NECK_M))
}

/// Returns the midpoint of the line where the lips meet, world; the hinge of the jaw if the tissue
/// has no lips.
fn middle_of_lips(tissue: &Tissue) -> DVec3 {
    let places = tissue.columns.iter().filter_map(|column| {
        let [upper, lower] = column.contact.map(|n| tissue.rest.get(usize::from(n)));
        Some((wide(*upper?) + wide(*lower?)) / 2.0)
    });
    let middle = places.min_by(|a, b| a.x.abs().total_cmp(&b.x.abs()));
    middle.unwrap_or_else(|| wide(tissue.hinge))
}

impl Reshaper {
    /// Prepares a figure whose head begins with the skin of a face model of `vertices` vertices.
    ///
    /// # Errors
    /// Returns an error if the figure has another head.
    pub fn new(figure: Figure, vertices: usize) -> Result<Self, ReshapeError> {
        let other = |why| ReshapeError::OtherHead { why };
        let is_head = |m: &Mesh| m.material.kind == MaterialKind::Skin && m.name == "head";
        let head = figure.meshes.iter().position(is_head);
        let head = head.ok_or_else(|| other("it has no mesh named head"))?;
        let tissue = figure.tissue.as_ref();
        let tissue = tissue.ok_or_else(|| other("it has no tissue"))?;
        let skin = &figure.meshes[head];
        if vertices == 0 || skin.positions.len() < vertices {
            return Err(other("its head has too few vertices"));
        }
        let skull = figure.inverse_bind.get(Bone::Skull.index());
        let skull = skull.ok_or_else(|| other("it has no skull"))?;
        let is_own = |t: &[u32; 3]| t.iter().all(|&v| (v as usize) < vertices);
        let corners = skin.indices.as_chunks::<3>().0;
        let triangles: Vec<[u32; 3]> = corners.iter().copied().filter(is_own).collect();
        // No part of the body uses the head's vertices.
        let is_mixed = |t: &[u32; 3]| !is_own(t) && t.iter().any(|&v| (v as usize) < vertices);
        if corners.iter().any(is_mixed) {
            return Err(other("its head is grown together with other parts"));
        }
        let places: Vec<DVec3> = skin.positions[..vertices]
            .iter()
            .map(|&p| wide(p))
            .collect();
        let near = carry::Skin::new(&places);
        let meshes = figure.meshes.iter().map(|m| CarriedMesh::bind(m, &near));
        let meshes = (0..).zip(meshes);
        Ok(Self {
            meshes: meshes
                .map(|(i, carried)| carried.filter(|_| i != head))
                .collect(),
            nodes: tissue.rest.iter().map(|&p| near.anchor(wide(p))).collect(),
            points: tissue
                .points
                .iter()
                .map(|p| near.anchor(wide(p.rest)))
                .collect(),
            lips: near.anchor(middle_of_lips(tissue)),
            scalp: OnceLock::new(),
            origin: skull.inverse().translation - SKULL_IN_HEAD_M,
            first: carry::firsts(&places),
            triangles,
            vertices,
            head,
            figure,
        })
    }

    /// Returns the original figure.
    #[must_use]
    pub fn figure(&self) -> &Figure {
        &self.figure
    }

    /// Returns the figure with a new face.
    ///
    /// # Errors
    /// Returns an error if the face is from another model, or contains a number that is not finite.
    pub fn with_face(&self, face: &NewFace<'_>) -> Result<Figure, ReshapeError> {
        let (places, tone) = (face.skin.as_chunks::<3>().0, face.tone.as_chunks::<3>().0);
        if places.len() != self.vertices || !(tone.is_empty() || tone.len() == self.vertices) {
            return Err(ReshapeError::OtherFace {
                found: places.len(),
                expected: self.vertices,
            });
        }
        if !face.skin.iter().chain(face.tone).all(|x| x.is_finite()) {
            return Err(ReshapeError::NotFinite);
        }
        let moved = self.moved(places, face.organs.chin);
        let mut figure = self.figure.clone();
        self.move_skin(&mut figure.meshes[self.head], &moved);
        let eyes = self.move_eyes(&mut figure, &face.organs);
        let lips = self.lips.evaluate(&moved);
        for (mesh, carried) in figure.meshes.iter_mut().zip(&self.meshes) {
            if let Some(carried) = carried {
                carried.carry(&mut mesh.positions, &moved, eyes, lips);
            }
        }
        self.move_tissue(&mut figure, &moved, lips);
        figure.lid_closure_rad = face.organs.lid_closure_rad;
        if !tone.is_empty() {
            self.paint(&mut figure, tone, face);
        }
        Ok(figure)
    }

    /// Returns the displacement of each vertex of the skin, metres: zero on the neck of the body.
    fn moved(&self, places: &[[f64; 3]], chin: f64) -> Vec<DVec3> {
        let from = neck_from(chin);
        let skin = &self.figure.meshes[self.head].positions;
        let one = |(place, own): (&[f64; 3], &[f32; 3])| {
            moved(DVec3::from_array(*place), wide(*own) - self.origin, from)
        };
        let moved: Vec<DVec3> = places.iter().zip(skin).map(one).collect();
        // Vertices that a seam of the texture doubles go together.
        self.first.iter().map(|&v| moved[v as usize]).collect()
    }

    fn move_skin(&self, mesh: &mut Mesh, moved: &[DVec3]) {
        for (p, by) in mesh.positions.iter_mut().zip(moved) {
            *p = narrow(wide(*p) + *by);
        }
        let mut normals = vec![DVec3::ZERO; self.vertices];
        for t in &self.triangles {
            let [a, b, c] = t.map(|v| wide(mesh.positions[v as usize]));
            let area = (b - a).cross(c - a);
            for v in t {
                normals[self.first[*v as usize] as usize] += area;
            }
        }
        for (n, first) in mesh.normals.iter_mut().zip(&self.first) {
            if let Some(normal) = normals[*first as usize].try_normalize() {
                *n = narrow(normal);
            }
        }
    }

    /// Moves the joints of eyes and lids. Returns the displacement of the left and the right eye.
    fn move_eyes(&self, figure: &mut Figure, organs: &NewOrgans) -> [DVec3; 2] {
        let mut moved = [DVec3::ZERO; 2];
        let mut joints = figure.skeleton.joints().to_vec();
        for (i, joint) in joints.iter_mut().enumerate() {
            let (Drive::Eye(side) | Drive::UpperLid(side) | Drive::LowerLid(side)) = joint.drive
            else {
                continue;
            };
            let world = figure.inverse_bind[i].inverse();
            let to = organs.eye_centres[side.index()] + self.origin;
            let by = to - world.translation;
            moved[side.index()] = by;
            let place = DAffine3 {
                translation: to,
                ..world
            };
            figure.inverse_bind[i] = place.inverse();
            let parent = joint.parent.map(|p| figure.inverse_bind[p]);
            joint.translation_in_parent = parent.map_or(to, |from| from.transform_point3(to));
        }
        let stature = figure.skeleton.stature_m();
        if let Some(skeleton) = Skeleton::from_joints(joints, stature) {
            figure.skeleton = skeleton;
        }
        moved
    }

    /// Moves the nodes of the tissue with the skin, and its data of the teeth with the lips.
    fn move_tissue(&self, figure: &mut Figure, moved: &[DVec3], lips: DVec3) {
        let Some(tissue) = &mut figure.tissue else {
            return;
        };
        for column in &mut tissue.columns {
            column.edge = narrow(wide(column.edge) + lips);
        }
        for arch in &mut tissue.arches {
            arch.origin = narrow(wide(arch.origin) + lips);
        }
        for (p, near) in tissue.rest.iter_mut().zip(&self.nodes) {
            *p = narrow(wide(*p) + near.evaluate(moved));
        }
        for (p, near) in tissue.points.iter_mut().zip(&self.points) {
            p.rest = narrow(wide(p.rest) + near.evaluate(moved));
        }
    }

    fn paint(&self, figure: &mut Figure, tone: &[[f64; 3]], face: &NewFace<'_>) {
        // Hands and the neck of the body get the mean of the head.
        let count = tone.len().max(1) as f64;
        let mean = core::array::from_fn(|i| tone.iter().map(|t| t[i]).sum::<f64>() / count);
        for (i, mesh) in figure.meshes.iter_mut().enumerate() {
            let own = if i == self.head { tone } else { &[] };
            match mesh.material.kind {
                MaterialKind::Skin | MaterialKind::Nail => carry::tint(mesh, own, mean),
                MaterialKind::Lash => carry::tint(mesh, &[], face.brows),
                MaterialKind::Eye => carry::tint(mesh, &[], face.iris),
                _ => {}
            }
        }
    }
}

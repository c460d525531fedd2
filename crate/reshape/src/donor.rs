//! Hair of one head on another.

use raconteur_base::DVec3;

use super::carry::{Skin, SkinAnchor};
use super::hairs::{self, BEARD};
use super::{NewFace, ReshapeError, Reshaper, SKULL_IN_HEAD_M, moved, narrow, neck_from, wide};
use raconteur_body::figure::{Figure, MaterialKind, Mesh};
use raconteur_body::skeleton::{Bone, Drive};

/// Hair of another figure, anchored to the skin on which it grew, so that it can be fitted to other
/// heads.
#[derive(Clone, Debug)]
pub struct HairDonor {
    /// Every `every`th vertex of the donor's skin, from the first on; frame of the head, metres.
    places: Vec<DVec3>,
    every: usize,
    /// Origin of that head's frame in the world.
    origin: DVec3,
    /// Vertices of the face model.
    vertices: usize,
    hair: Vec<(Mesh, Vec<SkinAnchor>)>,
}

impl HairDonor {
    /// Takes the hair of a file. Its mesh `head` must begin with the skin of a face model of
    /// `vertices` vertices, or with every second, third … vertex of that skin.
    ///
    /// # Errors
    /// Returns an error if the figure has another head.
    pub fn new(figure: &Figure, vertices: usize) -> Result<Self, ReshapeError> {
        let other = |why| ReshapeError::OtherHead { why };
        let head = figure.meshes.iter().find(|m| m.name == "head");
        let head = head.ok_or_else(|| other("it has no mesh named head"))?;
        let count = head.positions.len().min(vertices);
        if count == 0 {
            return Err(other("its head has too few vertices"));
        }
        let every = vertices.div_ceil(count);
        if vertices.div_ceil(every) != count {
            return Err(other("its head has no even share of the vertices"));
        }
        let skull = figure.inverse_bind.get(Bone::Skull.index());
        let skull = skull.ok_or_else(|| other("it has no skull"))?;
        let origin = skull.inverse().translation - SKULL_IN_HEAD_M;
        let world: Vec<DVec3> = head.positions[..count].iter().map(|&p| wide(p)).collect();
        let skin = Skin::new(&world);
        let joints = joints(figure);
        let places = world.iter().map(|p| *p - origin).collect();
        let is_hair = |m: &Mesh| m.material.kind == MaterialKind::Hair;
        let hair = figure.meshes.iter().filter(|m| is_hair(m)).map(|m| {
            let mut mesh = m.clone();
            for joint in mesh.joints.iter_mut().flatten() {
                *joint = joints.get(usize::from(*joint)).copied().unwrap_or(0);
            }
            let near = if mesh.name == BEARD {
                tuft_anchors(&mesh, &skin)
            } else {
                let places = mesh.positions.iter();
                places.map(|&p| skin.anchor(wide(p))).collect()
            };
            (mesh, near)
        });
        Ok(Self {
            hair: hair.collect(),
            places,
            every,
            origin,
            vertices,
        })
    }

    /// Fits the hair to a face, on the skeleton of another figure; dynamic hair of the donor
    /// becomes rigid.
    pub(super) fn fit_hair(
        &self,
        to: &Reshaper,
        face: &NewFace<'_>,
    ) -> Result<Vec<Mesh>, ReshapeError> {
        let skin = face.skin.as_chunks::<3>().0;
        if skin.len() != self.vertices {
            return Err(ReshapeError::OtherFace {
                found: skin.len(),
                expected: self.vertices,
            });
        }
        let from = neck_from(face.organs.chin);
        let places = skin.iter().step_by(self.every).zip(&self.places);
        let moved: Vec<DVec3> = places
            .map(|(place, own)| moved(DVec3::from_array(*place), *own, from))
            .collect();
        let by = to.origin - self.origin;
        let lent = self.hair.iter().map(|(mesh, near)| {
            let mut mesh = mesh.clone();
            for (p, near) in mesh.positions.iter_mut().zip(near) {
                *p = narrow(wide(*p) + near.evaluate(&moved) + by);
            }
            mesh
        });
        Ok(lent.collect())
    }
}

/// Returns the skin anchors of tufts: each tuft follows the skin around its root as a whole, so
/// none sinks in.
fn tuft_anchors(mesh: &Mesh, skin: &Skin<'_>) -> Vec<SkinAnchor> {
    let roots = hairs::roots_of(mesh);
    let normals = mesh.normals.iter().zip(roots);
    normals
        .map(|(&normal, root)| skin.near_outside(root, wide(normal)))
        .collect()
}

/// Returns, for each joint of the donor, the equivalent joint common to all figures: the bone from
/// which it hangs.
fn joints(figure: &Figure) -> Vec<u16> {
    let joints = figure.skeleton.joints();
    let skull = Bone::Skull.index();
    let own = |mut at: usize| loop {
        match joints[at].drive {
            Drive::Spring(..) | Drive::Fixed => match joints[at].parent {
                Some(parent) => at = parent,
                None => return skull as u16,
            },
            // Bones and standard helpers are the same in every figure.
            _ => return at as u16,
        }
    };
    (0..joints.len()).map(own).collect()
}

//! Lid edges: they shade the eye, and its tears gather there.

use glam::Vec3;
use raconteur_base::{DAffine3, DVec3, Side};
use raconteur_body::skeleton::Drive;
use raconteur_body::{Figure, MaterialKind};

/// Distance from the middle of the eye within which lid vertices are its lining or inside the
/// globe, metres: the globe's radius is 12 mm.
const LINING_M: f64 = 0.0121;

/// Edge of a lid, as a plane through the centre of the eye and its corners; used to shade the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LidEdge {
    /// The lid's joint.
    joint: usize,
    /// Unit normal of the plane in the bind pose, towards the area covered by the lid.
    covered: DVec3,
}

impl LidEdge {
    /// Finds the lid edges of a figure: upper and lower lid of the left eye, then of the right;
    /// `None` for missing lids.
    pub(crate) fn from_figure(figure: &Figure) -> [Option<Self>; 4] {
        [
            Self::find(figure, Side::Left, true),
            Self::find(figure, Side::Left, false),
            Self::find(figure, Side::Right, true),
            Self::find(figure, Side::Right, false),
        ]
    }

    /// Finds the edge from the skin that is attached to the lid's joint only and is in front of the
    /// middle of the eye: the part nearest to the other lid is the edge.
    fn find(figure: &Figure, side: Side, upper: bool) -> Option<Self> {
        let drive = if upper {
            Drive::UpperLid(side)
        } else {
            Drive::LowerLid(side)
        };
        let joints = figure.skeleton.joints();
        let joint = joints.iter().position(|j| j.drive == drive)?;
        let centre = figure.inverse_bind.get(joint)?.inverse().translation;
        let sign = if upper { 1.0 } else { -1.0 };
        let mut edge: Option<(f64, DVec3)> = None;
        for mesh in &figure.meshes {
            if mesh.material.kind != MaterialKind::Skin {
                continue;
            }
            for ((p, js), ws) in mesh.positions.iter().zip(&mesh.joints).zip(&mesh.weights) {
                let held: f32 = js
                    .iter()
                    .zip(ws)
                    .filter(|(j, _)| usize::from(**j) == joint)
                    .map(|(_, w)| w)
                    .sum();
                let d = Vec3::from(*p).as_dvec3() - centre;
                // Within 3 mm of the middle, and not the lining behind the lid.
                if held < 0.9 || d.x.abs() > 0.003 || d.z < 0.003 || d.length() < LINING_M {
                    continue;
                }
                let height = sign * d.y / d.z;
                if edge.is_none_or(|(h, _)| height < h) {
                    edge = Some((height, d));
                }
            }
        }
        let (_, d) = edge?;
        let covered = DVec3::new(0.0, d.z, -d.y).try_normalize()? * sign;
        Some(Self { joint, covered })
    }

    /// Returns the plane in the world: its unit normal towards the area covered by the lid, then
    /// its distance from the origin, negative, metres. All 0 without such a lid.
    pub(crate) fn plane(
        edge: Option<Self>,
        world_from_joint: &[DAffine3],
        joint_from_bind: &[DAffine3],
    ) -> [f32; 4] {
        let found = edge.and_then(|e| {
            let world_from_bind =
                *world_from_joint.get(e.joint)? * *joint_from_bind.get(e.joint)?;
            let n = world_from_bind
                .transform_vector3(e.covered)
                .try_normalize()?;
            let distance = -n.dot(world_from_joint.get(e.joint)?.translation);
            Some(n.as_vec3().extend(distance as f32).into())
        });
        found.unwrap_or([0.0; 4])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::{DQuat, ops};
    use raconteur_body::figure::{Material, Mesh, TextureMaps};
    use raconteur_body::{Pose, Skeleton};

    /// Returns a figure with only skin on the left upper lid, at these heights above the middle of
    /// the eye, radians.
    fn lid(angles: &[f64]) -> (Figure, DVec3) {
        let skeleton = Skeleton::example();
        let mut bind = Vec::new();
        skeleton.solve(&Pose::zero(), &mut bind);
        let upper = Drive::UpperLid(Side::Left);
        let joint = skeleton.joints().iter().position(|j| j.drive == upper);
        let joint = joint.unwrap_or(0);
        let centre = bind[joint].translation;
        let n = angles.len();
        let mesh = Mesh {
            name: "lid".to_owned(),
            material: Material {
                kind: MaterialKind::Skin,
                base_color: [1.0; 4],
                roughness: 0.5,
                double_sided: false,
                maps: TextureMaps::default(),
            },
            positions: angles
                .iter()
                .map(|&a| (centre + on_globe(a)).as_vec3().into())
                .collect(),
            normals: vec![[0.0, 0.0, 1.0]; n],
            uvs: vec![[0.0; 2]; n],
            colors: vec![[255; 4]; n],
            joints: vec![[joint as u16, 0, 0, 0]; n],
            weights: vec![[1.0, 0.0, 0.0, 0.0]; n],
            indices: Vec::new(),
            morphs: Vec::new(),
            coarser: Vec::new(),
            binding: None,
        };
        let figure = Figure {
            name: "lid".to_owned(),
            inverse_bind: bind.iter().map(DAffine3::inverse).collect(),
            skeleton,
            meshes: vec![mesh],
            morph_names: Vec::new(),
            lid_closure_rad: [0.6; 2],
            sex: None,
            dominant_hand: Side::Right,
            images: Vec::new(),
            tissue: None,
            springs: raconteur_body::Springs::default(),
        };
        (figure, centre)
    }

    fn on_globe(angle: f64) -> DVec3 {
        let (s, c) = ops::sincos(angle);
        DVec3::new(0.0, s, c) * 0.013
    }

    #[test]
    fn the_edge_is_found_and_turns_with_the_lid() {
        let (figure, centre) = lid(&[0.8, 0.3, 0.5]);
        let [upper, rest @ ..] = LidEdge::from_figure(&figure);
        assert!(
            rest.iter().all(Option::is_none),
            "the other lids have no edge"
        );
        for closed in [0.0, 0.2, 0.4] {
            let turn = DAffine3::from_translation(centre)
                * DAffine3::from_quat(DQuat::from_rotation_x(closed))
                * DAffine3::from_translation(-centre);
            let world: Vec<DAffine3> = figure
                .inverse_bind
                .iter()
                .map(|m| turn * m.inverse())
                .collect();
            let plane = LidEdge::plane(upper, &world, &figure.inverse_bind).map(f64::from);
            let beyond = |angle: f64| {
                let p = centre + on_globe(angle);
                plane[0] * p.x + plane[1] * p.y + plane[2] * p.z + plane[3]
            };
            let edge = 0.3 - closed;
            assert!(beyond(edge).abs() < 1e-5, "{closed}: {}", beyond(edge));
            assert!(
                beyond(edge + 0.1) > 1e-3 && beyond(edge - 0.1) < -1e-3,
                "the edge separates both sides"
            );
        }
    }

    #[test]
    fn a_figure_without_lids_has_no_edges() {
        let (mut figure, _) = lid(&[0.3]);
        figure.meshes.clear();
        assert!(
            LidEdge::from_figure(&figure).iter().all(Option::is_none),
            "a figure without lids has no edges"
        );
        assert_eq!(LidEdge::plane(None, &[], &[]), [0.0; 4]);
    }
}

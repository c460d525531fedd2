//! Solids of a figure for collision: hands as chains of capsules, trunk, neck and head as stacks of
//! slices, all measured on its meshes.

use raconteur_actor::gesture::contact::{Capsule, TIP_SHARE};
use raconteur_actor::kinematics::world_from_bone;
use raconteur_base::{DAffine3, DQuat, DVec3, Side, ops};
use raconteur_body::figure::MaterialKind;
use raconteur_body::hand_shape::finger_bones;
use raconteur_body::{Bone, Figure, Pose};

/// Height of a slice, metres.
const SLICE_M: f64 = 0.02;
/// Sectors of a slice.
const SECTORS: usize = 36;
/// Weight from which on a vertex belongs to a bone.
const OWN_WEIGHT: f32 = 0.5;
/// Radii of fingers and palm of figures without meshes, for a stature of 1.7 m, metres.
const RADII_M: [f64; 2] = [0.008, 0.012];

/// Capsule of a hand, from a bone to another bone or to its tip.
#[derive(Clone, Copy, Debug)]
struct Link {
    from: Bone,
    to: End,
    radius_m: f64,
}

#[derive(Clone, Copy, Debug)]
enum End {
    Bone(Bone),
    /// A position in the frame of `from`, metres.
    Tip(DVec3),
}

/// Collision capsules of one hand.
#[derive(Clone, Debug)]
pub(super) struct Hand {
    links: Vec<Link>,
}

impl Hand {
    /// Measures a hand.
    pub(super) fn new(figure: &Figure, side: Side) -> Self {
        let wrist = Bone::on(side, "wrist");
        let scale = figure.skeleton.scale();
        let mut links = Vec::new();
        for finger in finger_bones(side).chunks_exact(3) {
            let offset = |bone: Bone| figure.skeleton.joints()[bone.index()].translation_in_parent;
            let tip = offset(finger[2]) * TIP_SHARE;
            let ends = [
                (wrist, End::Bone(finger[0]), RADII_M[1]),
                (finger[0], End::Bone(finger[1]), RADII_M[0]),
                (finger[1], End::Bone(finger[2]), RADII_M[0]),
                (finger[2], End::Tip(tip), RADII_M[0]),
            ];
            for (from, to, usual) in ends {
                let end = match to {
                    End::Bone(bone) => offset(bone),
                    End::Tip(tip) => tip,
                };
                let measured = (from != wrist).then(|| thickness_m(figure, from, end));
                let radius_m = measured.flatten().unwrap_or(usual * scale);
                links.push(Link { from, to, radius_m });
            }
        }
        Self { links }
    }

    /// Returns its capsules in the present pose.
    pub(super) fn capsules<'a>(
        &'a self,
        world_from_joint: &'a [DAffine3],
    ) -> impl Iterator<Item = Capsule> + 'a {
        self.links.iter().map(|link| {
            let from = world_from_joint[link.from.index()];
            let to = match link.to {
                End::Bone(bone) => world_from_joint[bone.index()].translation,
                End::Tip(tip) => from.transform_point3(tip),
            };
            Capsule {
                ends: [from.translation, to],
                radius_m: link.radius_m,
            }
        })
    }
}

/// Vertices of skin and clothes that belong to a bone, in its frame, metres.
fn vertices(figure: &Figure, bone: Bone) -> impl Iterator<Item = DVec3> + '_ {
    let solid = |kind: MaterialKind| !matches!(kind, MaterialKind::Hair | MaterialKind::Lash);
    let meshes = figure.meshes.iter().filter(move |m| solid(m.material.kind));
    let bone_from_world = figure.inverse_bind.get(bone.index()).copied();
    meshes.flat_map(move |mesh| {
        let weights = mesh.joints.iter().zip(&mesh.weights);
        mesh.positions
            .iter()
            .zip(weights)
            .filter(move |(_, (joints, weights))| {
                let own = joints.iter().zip(*weights).filter(|(j, _)| {
                    let joint = figure.skeleton.joints().get(usize::from(**j));
                    joint.is_some_and(|j| j.drive.bone() == Some(bone))
                });
                own.map(|(_, w)| w).sum::<f32>() > OWN_WEIGHT
            })
            .filter_map(move |(p, _)| {
                let world = DVec3::from_array(p.map(f64::from));
                bone_from_world.map(|b| b.transform_point3(world))
            })
    })
}

/// Returns the median distance of a bone's skin from its axis, which ends at `end`, metres; `None`
/// if it has no skin.
fn thickness_m(figure: &Figure, bone: Bone, end: DVec3) -> Option<f64> {
    let axis = end.try_normalize()?;
    let mut radii: Vec<f64> = vertices(figure, bone)
        .filter(|p| (0.0..end.length()).contains(&p.dot(axis)))
        .map(|p| (p - axis * p.dot(axis)).length())
        .collect();
    raconteur_base::order::sort_by_number(&mut radii, |r| *r);
    radii.get(radii.len() / 2).copied()
}

/// A segment of the body that moves with one bone.
#[derive(Clone, Debug)]
struct BodySegment {
    bone: Bone,
    /// The zero pose's world from the bone.
    zero: DAffine3,
    bottom_m: f64,
    /// The axis runs upwards here.
    axis: [f64; 2],
    /// Greatest distance of the surface from the axis in each sector of each slice, metres.
    slices: Vec<[f64; SECTORS]>,
}

impl BodySegment {
    fn new(figure: &Figure, bone: Bone) -> Option<Self> {
        let zero = world_from_bone(&figure.skeleton, &Pose::zero(), bone);
        let points: Vec<DVec3> = vertices(figure, bone)
            .map(|p| zero.transform_point3(p))
            .collect();
        let first = points.first()?;
        let (low, high) = points
            .iter()
            .fold((*first, *first), |(l, h), p| (l.min(*p), h.max(*p)));
        let middle = (low + high) * 0.5;
        let count = ((high.y - low.y) / SLICE_M).ceil() as usize + 1;
        let mut segment = Self {
            bone,
            zero,
            bottom_m: low.y,
            axis: [middle.x, middle.z],
            slices: vec![[0.0; SECTORS]; count],
        };
        for p in &points {
            let (slice, sector, r) = segment.place(*p)?;
            let most = &mut segment.slices[slice][sector];
            *most = most.max(r);
        }
        Some(segment)
    }

    /// Returns slice, sector and distance from the axis of a point in the zero pose.
    fn place(&self, p: DVec3) -> Option<(usize, usize, f64)> {
        let slice = (p.y - self.bottom_m) / SLICE_M;
        if !(slice >= 0.0 && slice < self.slices.len() as f64) {
            return None;
        }
        let (x, z) = (p.x - self.axis[0], p.z - self.axis[1]);
        let turn = ops::atan2(x, z) / core::f64::consts::TAU + 0.5;
        let sector = ((turn * SECTORS as f64) as usize).min(SECTORS - 1);
        Some((slice as usize, sector, ops::hypot(x, z)))
    }

    /// Returns the penetration depth of a sphere; negative or `None` outside; metres.
    fn depth_m(&self, world_from_joint: &[DAffine3], at: DVec3, radius_m: f64) -> Option<f64> {
        let moved = world_from_joint[self.bone.index()];
        let p = self
            .zero
            .transform_point3(moved.inverse().transform_point3(at));
        let (slice, sector, r) = self.place(p)?;
        let surface = self.slices[slice][sector];
        // No vertices there: the segment is open, as a trunk is where the arm begins.
        (surface > 0.0).then_some(surface + radius_m - r)
    }
}

/// Collision slices of a figure's trunk, neck and head.
#[derive(Clone, Debug)]
pub(super) struct Body {
    trunk: Vec<BodySegment>,
    head: Vec<BodySegment>,
}

impl Body {
    /// Measures a figure; one without meshes has no obstacles.
    pub(super) fn new(figure: &Figure) -> Self {
        let segments = |bones: &[Bone]| {
            bones
                .iter()
                .filter_map(|b| BodySegment::new(figure, *b))
                .collect()
        };
        Self {
            trunk: segments(&[Bone::Sacroiliac, Bone::Lumbar, Bone::Thoracic]),
            head: segments(&[Bone::Cervical, Bone::Skull, Bone::Chin]),
        }
    }

    /// Returns the penetration depth of a capsule in the trunk and in the head, metres; 0 outside.
    pub(super) fn depths_m(&self, world_from_joint: &[DAffine3], capsule: &Capsule) -> [f64; 2] {
        [&self.trunk, &self.head].map(|segments| {
            let places = [0.0, 0.5, 1.0].map(|s| capsule.ends[0].lerp(capsule.ends[1], s));
            let depths = segments.iter().flat_map(|segment| {
                places.map(|at| {
                    segment
                        .depth_m(world_from_joint, at, capsule.radius_m)
                        .unwrap_or(0.0)
                })
            });
            depths.fold(0.0, f64::max)
        })
    }
}

/// Returns the rotation of a bone relative to its parent.
pub(super) fn local_rotation(world_from_joint: &[DAffine3], bone: Bone) -> DQuat {
    let own = world_from_joint[bone.index()].matrix3;
    let parent = bone.parent().map(|p| world_from_joint[p.index()].matrix3);
    DQuat::from_mat3(&parent.map_or(own, |p| p.transpose() * own)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_body::read::read_figure;

    #[test]
    fn what_is_inside_the_figure_is_found_and_what_is_outside_is_not() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../assets/figures/sofia.glb"
        );
        let figure = read_figure("sofia", &std::fs::read(path).expect("a file")).expect("a figure");
        let body = Body::new(&figure);
        let mut world = Vec::new();
        figure.skeleton.solve(&Pose::zero(), &mut world);
        let near = |bone: Bone, offset: DVec3| {
            let at = world[bone.index()].translation + offset;
            let capsule = Capsule {
                ends: [at, at + DVec3::X * 0.01],
                radius_m: 0.01,
            };
            body.depths_m(&world, &capsule)
        };
        // In the middle of the belly, and in the middle of the head.
        let [trunk, head] = near(Bone::Lumbar, DVec3::Y * 0.05);
        assert!(trunk > 0.06 && head == 0.0, "{trunk} {head}");
        let [trunk, head] = near(Bone::Skull, DVec3::new(0.0, 0.08, 0.03));
        assert!(head > 0.05 && trunk == 0.0, "{trunk} {head}");
        for bone in [Bone::Lumbar, Bone::Thoracic, Bone::Skull] {
            assert_eq!(near(bone, DVec3::Z * 0.4), [0.0; 2]);
        }
        // Fingers are a centimetre thick, and the palm lies between its bones.
        for side in Side::BOTH {
            let hand = Hand::new(&figure, side);
            let capsules: Vec<Capsule> = hand.capsules(&world).collect();
            assert_eq!(capsules.len(), 20);
            assert!(
                capsules.iter().all(|c| (0.004..0.02).contains(&c.radius_m)),
                "the radii of the fingers are between 4 and 20 mm"
            );
        }
    }
}

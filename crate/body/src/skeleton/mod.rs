//! Skeleton of a figure: bones, helper joints and their hierarchy.

mod bone;
mod drive;
#[cfg(test)]
mod tests;

use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side};

use crate::face::Jaw;
pub use bone::{Bone, zero_frames};
pub use drive::{Drive, twist_about_x};

/// The stature for which lengths are designed that grow with the figure, metres.
const DESIGN_STATURE_M: f64 = 1.7;

/// Joint of a figure's skeleton: name, parent, offset, zero rotation and source of its rotation.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Node name in glTF: the bone's name, or `helper_…`.
    pub name: String,
    /// Index of the parent joint, always smaller than this joint's own; `None` for the root.
    pub parent: Option<usize>,
    /// Origin in the parent's frame, metres. Independent of the pose.
    pub translation_in_parent: DVec3,
    /// Parent from joint in the zero pose.
    pub zero_rotation: DQuat,
    /// Source of its rotation.
    pub drive: Drive,
}

/// Skeleton of one figure. The first 54 joints are [`Bone::ALL`]; helper joints follow, each a
/// leaf, then spring chains.
#[derive(Clone, Debug)]
pub struct Skeleton {
    joints: Vec<Joint>,
    stature_m: f64,
}

/// Positions of the helper joints of the face: the centres of the eyeballs.
#[derive(Clone, Copy, Debug)]
pub struct FaceJoints {
    /// Centres of the eyeballs in the bind pose, world, left and right.
    pub eye_centres: [DVec3; 2],
}

/// Returns the helper joints of every generated figure, with their glTF names, in order.
#[must_use]
pub fn standard_helpers() -> Vec<(String, Drive)> {
    let mut helpers = Vec::new();
    for side in Side::BOTH {
        let s = if side == Side::Left { "l" } else { "r" };
        for part in ["scapula", "shoulder", "elbow", "wrist", "hip", "knee"] {
            helpers.push((
                format!("helper_{s}_{part}_half"),
                Drive::half(Bone::on(side, part)),
            ));
        }
        for finger in ["index", "middle", "ring", "pinky", "thumb"] {
            for i in 0..3 {
                let part = format!("{finger}{i}");
                helpers.push((
                    format!("helper_{s}_{part}_half"),
                    Drive::half(Bone::on(side, &part)),
                ));
            }
        }
        // The forearm's skin follows pronation by thirds from elbow to wrist, the upper
        // arm's its turn about itself from shoulder to elbow.
        for (n, share) in [(1, 1.0 / 3.0), (2, 2.0 / 3.0)] {
            helpers.push((
                format!("helper_{s}_upperarm_twist{n}"),
                Drive::Part(Bone::on(side, "shoulder"), 1.0, share),
            ));
            helpers.push((
                format!("helper_{s}_forearm_twist{n}"),
                Drive::Twist(Bone::on(side, "wrist"), share),
            ));
        }
        helpers.push((format!("helper_{s}_eye"), Drive::Eye(side)));
        helpers.push((format!("helper_{s}_upper_lid"), Drive::UpperLid(side)));
        helpers.push((format!("helper_{s}_lower_lid"), Drive::LowerLid(side)));
    }
    helpers.push((
        "helper_cervical_half".to_owned(),
        Drive::Share(Bone::Cervical, 0.5),
    ));
    helpers.push((
        "helper_skull_half".to_owned(),
        Drive::Share(Bone::Skull, 0.5),
    ));
    helpers
}

impl Skeleton {
    /// Builds a skeleton from the world positions and orientations of the bones in the
    /// bind pose, and the eyes' centres. Helpers of [`standard_helpers`] are added.
    ///
    /// `bind_rotations` are the world-from-bone rotations in the bind pose: the zero frames,
    /// rotated by the bind pose. Skinning depends only on differences between the bind pose and the
    /// zero pose.
    #[must_use]
    pub fn from_bind(
        positions_in_world: &[DVec3; Bone::COUNT],
        bind_rotations: &[DQuat; Bone::COUNT],
        face: FaceJoints,
        stature_m: f64,
    ) -> Self {
        let zero = zero_frames();
        let local = |parent: usize, p: DVec3| {
            bind_rotations[parent].inverse() * (p - positions_in_world[parent])
        };
        let mut joints: Vec<Joint> = Bone::ALL
            .iter()
            .map(|&bone| {
                let i = bone.index();
                let parent = bone.parent().map(Bone::index);
                Joint {
                    name: bone.name().to_owned(),
                    parent,
                    translation_in_parent: parent
                        .map_or(positions_in_world[i], |p| local(p, positions_in_world[i])),
                    zero_rotation: parent.map_or(zero[i], |p| zero[p].inverse() * zero[i]),
                    drive: Drive::Bone(bone),
                }
            })
            .collect();
        for (name, drive) in standard_helpers() {
            let skull = Bone::Skull.index();
            let (parent, translation_in_parent, zero_rotation) = match drive {
                Drive::Share(bone, _) | Drive::Part(bone, ..) => {
                    let own = &joints[bone.index()];
                    (own.parent, own.translation_in_parent, own.zero_rotation)
                }
                Drive::Twist(bone, share) => {
                    let own = &joints[bone.index()];
                    (
                        own.parent,
                        own.translation_in_parent * share,
                        own.zero_rotation,
                    )
                }
                Drive::Eye(side) | Drive::UpperLid(side) | Drive::LowerLid(side) => (
                    Some(skull),
                    local(skull, face.eye_centres[side.index()]),
                    // In the zero pose, the eye frame has the world's axes, so that its x axis is
                    // the axis of lid closure and vertical gaze.
                    zero[skull].inverse(),
                ),
                Drive::Bone(_) | Drive::Spring(..) | Drive::Fixed => continue,
            };
            joints.push(Joint {
                name,
                parent,
                translation_in_parent,
                zero_rotation,
                drive,
            });
        }
        Self { joints, stature_m }
    }

    /// Returns the male example of GEVH table A.1, 77 units tall, in its zero pose. The table has
    /// no eyes; theirs are set at the skull's usual place.
    #[must_use]
    pub fn example() -> Self {
        let face = FaceJoints {
            eye_centres: [
                DVec3::new(0.031, 1.80, 0.08),
                DVec3::new(-0.031, 1.80, 0.08),
            ],
        };
        let positions = Bone::ALL.map(Bone::example_position_m);
        let stature_m = 77.0 * raconteur_base::METRES_PER_INCH;
        Self::from_bind(&positions, &zero_frames(), face, stature_m)
    }

    /// Creates a skeleton from joints in order, parents first, the first 54 being the bones. `None`
    /// for any other order.
    #[must_use]
    pub fn from_joints(joints: Vec<Joint>, stature_m: f64) -> Option<Self> {
        let ordered = joints
            .iter()
            .enumerate()
            .all(|(i, j)| j.parent.is_none_or(|p| p < i));
        let bones = joints.len() >= Bone::COUNT
            && Bone::ALL
                .iter()
                .all(|b| joints[b.index()].drive == Drive::Bone(*b));
        (ordered && bones).then_some(Self { joints, stature_m })
    }

    /// Returns all joints: the 54 bones, the helpers, then spring chains.
    #[must_use]
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Adds a joint that swings, and rests at `parent_from_joint` while its parent is in the bind
    /// pose. Returns its index.
    pub fn hang(
        &mut self,
        name: String,
        parent: usize,
        parent_from_joint: DAffine3,
        drive: Drive,
    ) -> usize {
        self.joints.push(Joint {
            name,
            parent: Some(parent),
            translation_in_parent: parent_from_joint.translation,
            zero_rotation: DQuat::from_mat3(&parent_from_joint.matrix3),
            drive,
        });
        self.joints.len() - 1
    }

    /// Returns the standing height in metres, barefoot.
    #[must_use]
    pub fn stature_m(&self) -> f64 {
        self.stature_m
    }

    /// Returns the scale of the figure relative to one of 1.7 m, for which designed lengths are
    /// written.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.stature_m / DESIGN_STATURE_M
    }

    /// Metres in one EML unit for this figure: stature / 77 (design section 3).
    #[must_use]
    pub fn metres_per_eml_unit(&self) -> f64 {
        self.stature_m / 77.0
    }

    /// Returns the distance of a bone from its parent, metres.
    #[must_use]
    pub fn offset_length_m(&self, bone: Bone) -> f64 {
        self.joints[bone.index()].translation_in_parent.magnitude()
    }

    /// Returns the excess distance of a bone from its parent, metres: the part of `distance_m`
    /// beyond its length. The lower jaw slides in its joint, but not out of it.
    #[must_use]
    pub fn stretched_m(&self, bone: Bone, distance_m: f64) -> f64 {
        let slack = if bone == Bone::Chin {
            Jaw::MAX_SLIDE_M
        } else {
            0.0
        };
        // NaN stays NaN.
        let off = (distance_m - self.offset_length_m(bone)).abs() - slack;
        if off < 0.0 { 0.0 } else { off }
    }

    /// Returns the transform from joint to parent for a joint rotated by `own` from the zero pose
    /// while its bone is rotated by `turn`.
    #[must_use]
    pub fn local(&self, joint: &Joint, own: DQuat, turn: DQuat) -> DAffine3 {
        let rotation = joint.zero_rotation * own;
        let rise = joint.drive.rise(turn) * self.stature_m;
        DAffine3::from_rotation_translation(rotation, joint.translation_in_parent + rotation * rise)
    }
}

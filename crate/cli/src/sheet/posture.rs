//! Poses for a contact sheet, without a story.

use raconteur_actor::FaceRig;
use raconteur_base::{DAffine3, DMat3, DQuat, DVec3, NodeState, Side};
use raconteur_body::skeleton::zero_frames;
use raconteur_body::{Bone, Figure, HandShape, Pose, Skeleton};
use raconteur_tissue::{FaceControls, Network};

/// Builder of a pose for a contact sheet, with the controls of the face.
pub(crate) struct Posture<'a> {
    figure: &'a Figure,
    pose: Pose,
    face: FaceControls,
}

/// Posed figure ready for rendering: joint transforms, morph weights and state of the facial
/// tissue.
pub(crate) struct PosedFigure {
    /// World from joint.
    pub(crate) world_from_joint: Vec<DAffine3>,
    /// Weights of the figure's morph targets, one each.
    pub(crate) morph_weights: Vec<f32>,
    /// Nodes of its face's tissue; empty if it has none.
    pub(crate) tissue: Vec<NodeState>,
}

/// Directions for the left side; the right mirrors them.
fn on(side: Side, v: [f64; 3]) -> DVec3 {
    DVec3::new(v[0] * side.sign(), v[1], v[2])
}

/// Axes from a direction and a second one made square to it.
fn axes(first: DVec3, second: DVec3) -> DMat3 {
    let x = first.normalize_or(DVec3::X);
    let y = (second - x * x.dot(second)).normalize_or(x.any_orthonormal_vector());
    DMat3::from_cols(x, y, x.cross(y))
}

impl<'a> Posture<'a> {
    /// Returns an upright posture, arms hanging.
    pub(crate) fn standing(figure: &'a Figure) -> Self {
        let mut posture = Self {
            figure,
            pose: Pose::zero(),
            face: FaceControls::default(),
        };
        for side in Side::BOTH {
            posture.arm(side, [0.20, -0.98, -0.04], [0.10, -0.95, 0.16]);
            posture.hand(side, [0.02, -1.0, 0.10], [-1.0, 0.0, -0.25]);
            posture.shape(side, HandShape::RELAXED);
        }
        posture
    }

    /// Sets the directions of upper arm and forearm, left side, world; the elbow stays on its
    /// hinge.
    pub(crate) fn arm(&mut self, side: Side, upper: [f64; 3], fore: [f64; 3]) {
        let (upper, fore) = (on(side, upper).normalize(), on(side, fore).normalize());
        let bend = upper.angle_between(fore).max(0.02);
        let [shoulder, elbow, wrist] = ["shoulder", "elbow", "wrist"].map(|b| Bone::on(side, b));
        let joints = self.figure.skeleton.joints();
        let hinge = DQuat::from_rotation_z(bend);
        let along_upper = joints[elbow.index()].translation_in_parent;
        let along_fore = joints[elbow.index()].zero_rotation
            * (hinge * joints[wrist.index()].translation_in_parent);
        let turn =
            DQuat::from_mat3(&(axes(upper, fore) * axes(along_upper, along_fore).transpose()));
        self.set_in_world(shoulder, turn);
        self.pose.set(elbow, hinge);
    }

    /// Directions of the fingers and out of the palm, left side, world.
    pub(crate) fn hand(&mut self, side: Side, fingers: [f64; 3], palm: [f64; 3]) {
        let zero = axes(DVec3::X * side.sign(), DVec3::NEG_Y);
        let wanted = axes(on(side, fingers), on(side, palm));
        let wrist = Bone::on(side, "wrist");
        let turn = DQuat::from_mat3(&(wanted * zero.transpose()));
        self.set_in_world(wrist, turn * zero_frames()[wrist.index()]);
    }

    /// Fingers of one hand.
    pub(crate) fn shape(&mut self, side: Side, shape: &HandShape) {
        shape.apply(side, &mut self.pose);
    }

    /// Rotates a bone by a rotation given in the axes of the zero pose's world.
    pub(crate) fn turn(&mut self, bone: Bone, by: DQuat) {
        let zero = zero_frames()[bone.index()];
        let own = self.pose.rotation(bone);
        self.pose.set(bone, (zero.inverse() * by * zero) * own);
    }

    /// Turns the whole figure about the vertical, radians; positive to its left.
    pub(crate) fn facing(&mut self, yaw_rad: f64) {
        self.pose.root_rotation = DQuat::from_rotation_y(yaw_rad);
    }

    /// Closes the lids by a share.
    pub(crate) fn lids(&mut self, share: f64) {
        self.face.upper_lid = [share; 2];
    }

    /// Sets the controls of the face.
    pub(crate) fn face(&mut self, controls: FaceControls) {
        self.face = controls;
    }

    /// Solves the joints.
    pub(crate) fn posed(mut self) -> PosedFigure {
        let mut morph_weights = vec![0.0; self.figure.morph_names.len()];
        let rig = FaceRig::new(self.figure);
        rig.write(&self.face, [0.0; 2], &mut self.pose, &mut morph_weights);
        let mut tissue = Vec::new();
        if let Some(soft) = &self.figure.tissue {
            tissue.resize(soft.rest.len(), NodeState::default());
            let mut network = Network::new(soft);
            network.settle(soft, &self.face);
            network.write(soft, 1.0, &mut tissue);
        }
        let mut world_from_joint = Vec::new();
        self.figure
            .skeleton
            .solve(&self.pose, &mut world_from_joint);
        PosedFigure {
            world_from_joint,
            morph_weights,
            tissue,
        }
    }

    /// Sets the world rotation of a bone, independent of its ancestors.
    fn set_in_world(&mut self, bone: Bone, wanted: DQuat) {
        let skeleton: &Skeleton = &self.figure.skeleton;
        let mut world = Vec::new();
        skeleton.solve(&self.pose, &mut world);
        let joint = &skeleton.joints()[bone.index()];
        let parent = joint
            .parent
            .map_or(DQuat::IDENTITY, |p| DQuat::from_mat3(&world[p].matrix3));
        self.pose.set(
            bone,
            ((parent * joint.zero_rotation).inverse() * wanted).normalize(),
        );
    }
}

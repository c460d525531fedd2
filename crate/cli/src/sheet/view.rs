//! Views of a figure, derived from its joints.

use raconteur_base::{DAffine3, DVec3, Side, ops};
use raconteur_body::{Bone, Drive, Figure};
use raconteur_stage::Camera;

/// Landmarks of a posed figure at which cameras are aimed; world, metres.
pub(crate) struct FigurePoints<'a> {
    figure: &'a Figure,
    world_from_joint: &'a [DAffine3],
}

/// Distance between pupils as a share of stature, for a figure without eye joints:
/// 62 mm of 1.7 m.
const PUPILS_OF_STATURE: f64 = 0.0365;

impl<'a> FigurePoints<'a> {
    pub(crate) fn new(figure: &'a Figure, world_from_joint: &'a [DAffine3]) -> Self {
        Self {
            figure,
            world_from_joint,
        }
    }

    fn bone(&self, bone: Bone) -> DVec3 {
        self.world_from_joint[bone.index()].translation
    }

    /// Centres of the eyeballs, left and right.
    pub(crate) fn eyes(&self) -> [DVec3; 2] {
        let joints = self.figure.skeleton.joints();
        let eye = |side| joints.iter().position(|j| j.drive == Drive::Eye(side));
        let skull = self.world_from_joint[Bone::Skull.index()];
        Side::BOTH.map(|side| match eye(side) {
            Some(i) => self.world_from_joint[i].translation,
            // The skull's axes: x up, y to the front, z to the left.
            None => {
                let s = self.figure.skeleton.stature_m();
                skull.transform_point3(DVec3::new(
                    0.030 * s,
                    0.045 * s,
                    0.5 * PUPILS_OF_STATURE * s * side.sign(),
                ))
            }
        })
    }

    /// Returns the distance between the eyes, metres, the scale of views of the face.
    pub(crate) fn pupils_m(&self) -> f64 {
        let [l, r] = self.eyes();
        l.distance(r)
            .max(0.5 * PUPILS_OF_STATURE * self.figure.skeleton.stature_m())
    }

    /// Returns the point between the eyes, world, metres.
    pub(crate) fn between_eyes(&self) -> DVec3 {
        let [l, r] = self.eyes();
        l.midpoint(r)
    }

    /// Returns the centre of a hand, world, metres.
    pub(crate) fn hand(&self, side: Side) -> DVec3 {
        let wrist = self.bone(Bone::on(side, "wrist"));
        let knuckle = self.bone(Bone::on(side, "middle0"));
        wrist + (knuckle - wrist) * 1.05
    }

    /// Returns the distance from wrist to knuckle, metres, the scale of views of a hand.
    pub(crate) fn palm_m(&self, side: Side) -> f64 {
        self.bone(Bone::on(side, "wrist"))
            .distance(self.bone(Bone::on(side, "middle0")))
            .max(0.02 * self.figure.skeleton.stature_m())
    }

    pub(crate) fn elbow(&self, side: Side) -> DVec3 {
        self.bone(Bone::on(side, "elbow"))
    }

    pub(crate) fn stature_m(&self) -> f64 {
        self.figure.skeleton.stature_m()
    }
}

/// Vertical field of view, radians: a long lens.
const FOV_Y_RAD: f64 = 0.30;

/// Returns a camera in front of `target` (at +z, rotated by `yaw_rad` to its left and raised by
/// `pitch_rad`) that sees `half_height_m` above and below it.
pub(crate) fn before(target: DVec3, half_height_m: f64, yaw_rad: f64, pitch_rad: f64) -> Camera {
    let distance = half_height_m / ops::tan(0.5 * FOV_Y_RAD);
    let (flat, up) = (ops::cos(pitch_rad), ops::sin(pitch_rad));
    let towards = DVec3::new(ops::sin(yaw_rad) * flat, up, ops::cos(yaw_rad) * flat);
    Camera {
        eye_in_world: target + towards * distance,
        target_in_world: target,
        fov_y_rad: FOV_Y_RAD,
        near_m: 0.2 * distance,
        ..Camera::default()
    }
}

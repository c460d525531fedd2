//! Conversion of EML's units and axes to the engine's.
//!
//! EML keeps the axes of GEVH's skeleton: x to the character's left, y up, z *back*, lengths in
//! skeleton units of which the figure is 77 high. The engine is right-handed with z to the front,
//! in metres. Only this module converts between them.

use raconteur_base::DVec3;
use raconteur_body::{Bone, Skeleton};

/// Height of the shoulders above, and their setback behind, the speaker's origin (the
/// sacroiliac) in GEVH table A.1, skeleton units: 62.52 − 37.82 and 1.46.
const SHOULDERS_ABOVE_ORIGIN: f64 = 24.70;
const SHOULDERS_BEHIND_ORIGIN: f64 = 1.46;

/// Conversion from EML coordinates (skeleton units, z to the back) to the engine's (metres, z to
/// the front) for one figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    metres_per_unit: f64,
    speaker_origin_in_world: DVec3,
}

impl Units {
    /// Returns the units of a figure at the world's origin.
    ///
    /// The speaker's origin is derived from the shoulders instead of the pelvis, because the hips
    /// of the example skeleton are higher than anatomical ones, and positions in a script are meant
    /// relative to the arms.
    #[must_use]
    pub fn from_skeleton(skeleton: &Skeleton) -> Self {
        let mut world = Vec::new();
        skeleton.solve(&raconteur_body::Pose::zero(), &mut world);
        let metres_per_unit = skeleton.metres_per_eml_unit();
        let at = |bone: Bone| world[bone.index()].translation;
        let shoulders = (at(Bone::LShoulder) + at(Bone::RShoulder)) * 0.5;
        let offset = DVec3::new(0.0, SHOULDERS_ABOVE_ORIGIN, -SHOULDERS_BEHIND_ORIGIN);
        Self {
            metres_per_unit,
            speaker_origin_in_world: shoulders - offset * metres_per_unit,
        }
    }

    /// Converts a direction or displacement from EML axes to engine axes, without scaling.
    #[must_use]
    pub fn axis(eml: [f64; 3]) -> DVec3 {
        DVec3::new(eml[0], eml[1], -eml[2])
    }

    /// Returns the length of one EML unit, metres.
    #[must_use]
    pub fn metres(&self) -> f64 {
        self.metres_per_unit
    }

    /// Converts yaw, pitch and roll in degrees to the engine's convention (radians; see
    /// `raconteur_actor::manipulator::path`): turns about axes in the mirror plane of the two
    /// frames change sign. EML turns by roll first, then pitch, then yaw, like DirectX, whose
    /// conventions GEVH's figures share.
    #[must_use]
    pub fn angles(eml_deg: [f64; 3]) -> [f64; 3] {
        let [yaw, pitch, roll] = eml_deg.map(f64::to_radians);
        [-yaw, -pitch, roll]
    }

    /// Converts an angular velocity about EML's axes, degrees per second, to engine axes, rad/s.
    #[must_use]
    pub fn angular(eml_deg: [f64; 3]) -> DVec3 {
        let [x, y, z] = eml_deg.map(f64::to_radians);
        DVec3::new(-x, -y, z)
    }

    /// Converts a point in speaker coordinates (origin: sacroiliac) to world coordinates, metres.
    #[must_use]
    pub fn speaker_point(&self, eml: [f64; 3]) -> DVec3 {
        self.speaker_origin_in_world + Self::axis(eml) * self.metres_per_unit
    }

    /// Converts a point in EML's world coordinates (origin: the floor under the figure) to engine
    /// coordinates, metres.
    #[must_use]
    pub fn world_point(&self, eml: [f64; 3]) -> DVec3 {
        Self::axis(eml) * self.metres_per_unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_those_of_the_mirrored_frame() {
        use raconteur_base::DMat3;
        let angles = [20.0_f64, -35.0, 50.0];
        let [yaw, pitch, roll] = angles.map(f64::to_radians);
        let eml = DMat3::from_rotation_y(yaw)
            * DMat3::from_rotation_x(pitch)
            * DMat3::from_rotation_z(roll);
        let [yaw, pitch, roll] = Units::angles(angles);
        let engine = DMat3::from_rotation_y(yaw)
            * DMat3::from_rotation_x(pitch)
            * DMat3::from_rotation_z(roll);
        for v in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, -0.2, 0.9]] {
            let turned = Units::axis((eml * DVec3::from_array(v)).to_array());
            assert!(
                turned.distance(engine * Units::axis(v)) < 1e-12,
                "the axis turns as in the mirrored frame"
            );
        }
        // A small turn by an angular velocity agrees with the angles.
        let small = 1e-6_f64;
        let by_yaw = DMat3::from_rotation_y(Units::angles([small, 0.0, 0.0])[0]) * DVec3::Z;
        let by_rate = Units::angular([0.0, small, 0.0]).cross(DVec3::Z);
        assert!(
            (by_yaw - DVec3::Z).distance(by_rate) < 1e-12,
            "the turn by yaw equals the turn by rate"
        );
    }

    #[test]
    fn on_the_example_skeleton_the_origin_is_its_sacroiliac() {
        let skeleton = Skeleton::example();
        let units = Units::from_skeleton(&skeleton);
        let d = units.speaker_point([0.0; 3]) - DVec3::new(0.0, 37.82, 0.0) * 0.0254;
        assert!(d.length() < 1e-4, "{d}");
        // GEVH 3.6.1: the greeting hand is above the head and within reach of the arm.
        let hand = units.speaker_point([-7.0, 45.0, 3.0]);
        let shoulder = Bone::RShoulder.example_position_m();
        assert!(
            (hand - shoulder).length() < 22.86 * 0.0254,
            "the hand is within the length of the arm"
        );
        assert!(hand.z < shoulder.z, "the hand is behind the shoulder");
    }
}

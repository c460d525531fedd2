//! Surfaces moved by joints, and their touchable parts.

use raconteur_base::{DAffine3, DVec3};

use crate::figure::{MaterialKind, Mesh};

/// Maximum depth below another surface, and lateral distance, within which a surface cannot be
/// touched, metres.
const UNDER_M: [f64; 2] = [0.03, 0.009];

impl MaterialKind {
    /// Returns true if hair rests on it rather than passing through.
    #[must_use]
    pub fn stops_hair(self) -> bool {
        !matches!(
            self,
            Self::Cornea | Self::Eye | Self::Hair | Self::Lash | Self::Mouth | Self::Teeth
        )
    }
}

impl Mesh {
    /// Returns position and unit normal of a vertex; `moved` takes each joint's frame from the bind
    /// pose to its present place, world; a zero normal stays zero.
    #[must_use]
    pub fn skinned(&self, moved: &[DAffine3], vertex: usize) -> [DVec3; 2] {
        let of = |list: &[[f32; 3]]| DVec3::from_array(list[vertex].map(f64::from));
        let (at, normal) = (of(&self.positions), of(&self.normals));
        let joints = self.joints[vertex].iter().zip(self.weights[vertex]);
        let mut sum = [DVec3::ZERO; 2];
        for (joint, weight) in joints.filter(|j| j.1 > 0.0) {
            let m = &moved[usize::from(*joint)];
            sum[0] += m.transform_point3(at) * f64::from(weight);
            sum[1] += m.transform_vector3(normal) * f64::from(weight);
        }
        [sum[0], sum[1].normalize_or_zero()]
    }
}

/// Returns true if a point of a surface, with its normal, lies close under another: skin under
/// cloth.
#[must_use]
pub fn lies_under([at, normal]: [DVec3; 2], [upper, upper_normal]: [DVec3; 2]) -> bool {
    let off = upper - at;
    let up = off.dot(normal);
    up > 0.001
        && up < UNDER_M[0]
        && upper_normal.dot(normal) > 0.3
        && (off - normal * up).length() < UNDER_M[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cloth_hides_the_skin_under_it_and_not_that_beside_it() {
        let skin = [DVec3::ZERO, DVec3::Y];
        assert!(
            lies_under(skin, [DVec3::Y * 0.01, DVec3::Y]),
            "cloth above the skin hides it"
        );
        assert!(
            !lies_under(skin, [DVec3::Y * -0.01, DVec3::Y]),
            "cloth below the skin does not hide it"
        );
        assert!(
            !lies_under(skin, [DVec3::Y * 0.01, DVec3::NEG_Y]),
            "cloth that faces away does not hide the skin"
        );
        assert!(
            !lies_under(skin, [DVec3::new(0.02, 0.01, 0.0), DVec3::Y]),
            "cloth next to the skin does not hide it"
        );
    }
}

//! Levels of detail of an image: 0 is the finest.

use raconteur_base::DVec3;
use raconteur_body::MaterialKind;
use raconteur_stage::Camera;

use crate::Quality;
use crate::figure::Shadow;
use crate::options::LEVELS;
use crate::view::View;

/// Resolution, pixels per metre, from which all of the hair is rendered: a head is 90 pixels high
/// there, and cards are about one pixel wide. Below it, triangles smaller than pixels are
/// disproportionately expensive.
const ALL_HAIR: f64 = 400.0;

/// Levels of detail of a figure in one image; 0 is the finest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Detail {
    /// Level of detail of everything except hair.
    pub(crate) figure: usize,
    hair: usize,
}

impl Detail {
    /// Chooses the levels for a quality, and for the head's distance as given by `pixels_per_m`, if
    /// any.
    pub(crate) fn new(quality: Quality, pixels_per_m: Option<f64>) -> Self {
        let figure = quality.level_of_detail();
        let is_far = pixels_per_m.is_some_and(|p| p < ALL_HAIR);
        Self {
            figure,
            hair: (figure + usize::from(is_far)).min(LEVELS - 1),
        }
    }

    /// Returns the level for a kind of material.
    pub(crate) fn level_for(self, kind: MaterialKind) -> usize {
        match kind {
            MaterialKind::Hair => self.hair,
            _ => self.figure,
        }
    }

    /// Returns the level of a shadow caster. Hair's shadow is too soft to resolve every second
    /// card.
    pub(crate) fn of_caster(self, shadow: Shadow) -> usize {
        match shadow {
            Shadow::Strands => (self.hair + 1).min(LEVELS - 1),
            _ => self.figure,
        }
    }
}

/// Returns the pixels per metre at a position, world, in an image of a height in pixels; `None`
/// behind the camera.
pub(crate) fn pixels_per_m(camera: &Camera, view: &View, height: u32, place: DVec3) -> Option<f64> {
    let depth = (place - camera.eye_in_world).dot(view.forward);
    (depth > 0.0).then(|| 0.5 * f64::from(height) / (view.half_height * depth))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hair_of_a_far_head_is_one_level_coarser_and_never_beyond_the_last() {
        let near = Detail::new(Quality::High, Some(1000.0));
        let far = Detail::new(Quality::High, Some(200.0));
        assert_eq!(near.level_for(MaterialKind::Hair), 0);
        assert_eq!(far.level_for(MaterialKind::Hair), 1);
        assert_eq!(far.level_for(MaterialKind::Skin), 0);
        assert_eq!(far.of_caster(Shadow::Strands), 2);
        assert_eq!(far.of_caster(Shadow::Solid), 0);
        let lowest = Detail::new(Quality::Lowest, Some(200.0));
        assert_eq!(lowest.level_for(MaterialKind::Hair), LEVELS - 1);
        assert_eq!(lowest.of_caster(Shadow::Strands), LEVELS - 1);
        assert_eq!(
            Detail::new(Quality::High, None).level_for(MaterialKind::Hair),
            0
        );
    }

    #[test]
    fn a_camera_of_a_right_angle_sees_four_metres_two_metres_off() {
        let camera = Camera {
            eye_in_world: DVec3::new(0.0, 0.0, 2.0),
            target_in_world: DVec3::ZERO,
            fov_y_rad: core::f64::consts::FRAC_PI_2,
            ..Camera::default()
        };
        let view = View::new(&camera, 1.0);
        let seen = pixels_per_m(&camera, &view, 360, DVec3::ZERO).expect("before the camera");
        assert!((seen - 90.0).abs() < 1e-6, "{seen}");
        assert_eq!(pixels_per_m(&camera, &view, 360, DVec3::Z * 3.0), None);
    }
}

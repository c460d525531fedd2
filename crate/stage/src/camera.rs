//! Camera and shots that frame the speaker.

use raconteur_base::curve::lerp;
use raconteur_base::{DQuat, DVec3, Length, ops};

use crate::storyteller::{AT_REST, BUST, FACE, HEAD, Span, aside_in};

/// Pinhole camera that renders a frame.
///
/// # Examples
///
/// ```
/// use raconteur_base::DVec3;
/// use raconteur_stage::camera::{FramingMargin, Shot};
///
/// let margin = FramingMargin::default();
/// let medium = Shot::Medium.frame(DVec3::ZERO, 1.7, 16.0 / 9.0, margin);
/// let full = Shot::Full.frame(DVec3::ZERO, 1.7, 16.0 / 9.0, margin);
/// assert!(full.eye_in_world.z > medium.eye_in_world.z, "the whole figure needs more distance");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Optical centre, world, metres.
    pub eye_in_world: DVec3,
    /// Point in the centre of the image.
    pub target_in_world: DVec3,
    /// Vertical field of view, radians.
    pub fov_y_rad: f64,
    /// Distance of the near plane, metres.
    pub near_m: f64,
    /// Distance of the far plane, metres.
    pub far_m: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            eye_in_world: DVec3::new(0.0, 1.35, 3.2),
            target_in_world: DVec3::new(0.0, 1.25, 0.0),
            fov_y_rad: 0.45,
            near_m: 0.1,
            far_m: 40.0,
        }
    }
}

impl Camera {
    /// Returns the camera that shows a span of a figure at `feet_in_world` from the present
    /// direction. The figure is offset by `aside` from the centre, share of half the image height,
    /// positive to the right.
    fn narrowed_to(
        &self,
        span: Span,
        feet_in_world: DVec3,
        stature_m: f64,
        aspect: f64,
        aside: f64,
    ) -> Self {
        let [bottom, top] = [span.bottom, span.top].map(|s| feet_in_world.y + s * stature_m);
        let half_height = 0.5 * (top - bottom);
        let half_width = half_height * aspect;
        // The camera follows an off-centre figure only as far as necessary.
        let play = half_width - half_height * aside.abs() - 0.5 * AT_REST * stature_m;
        let across = 1.0 - (play / STAGE_HALF_WIDTH_M).clamp(0.0, 1.0);
        let eye = self.eye_in_world.with_x(across * feet_in_world.x);
        let depth = eye.z - FOLLOWED_DEPTH * feet_in_world.z;
        let [down, up] = [bottom, top].map(|y| ops::atan2(y - eye.y, depth));
        let pitch = 0.5 * (down + up);
        Self {
            eye_in_world: eye,
            // The camera turns in place, so that the figure keeps looking at the same viewer.
            target_in_world: DVec3::new(
                eye.x - aside * half_height,
                eye.y + depth * ops::tan(pitch),
                eye.z - depth,
            ),
            fov_y_rad: up - down,
            ..*self
        }
    }

    /// Returns the camera that shows the same above a share of the image height at its lower edge.
    fn above_captions(self, share: f64) -> Self {
        let arm = self.target_in_world - self.eye_in_world;
        let level = ops::hypot(arm.x, arm.z);
        let top = ops::atan2(arm.y, level) + 0.5 * self.fov_y_rad;
        let fov_y_rad = self.fov_y_rad / (1.0 - share);
        let pitch = top - 0.5 * fov_y_rad;
        let target = arm.with_y(level * ops::tan(pitch));
        Self {
            target_in_world: self.eye_in_world + target,
            fov_y_rad,
            ..self
        }
    }

    /// Returns the camera a share `s` of the way to another, 0..1.
    #[must_use]
    pub fn towards(self, to: &Self, s: f64) -> Self {
        Self {
            eye_in_world: self.eye_in_world.lerp(to.eye_in_world, s),
            target_in_world: self.target_in_world.lerp(to.target_in_world, s),
            fov_y_rad: lerp(self.fov_y_rad, to.fov_y_rad, s),
            ..self
        }
    }

    /// Returns the camera rotated about its target, upwards by `elevation_rad`; it stays above the
    /// floor, y = 0.
    #[must_use]
    pub fn raised(mut self, elevation_rad: f64) -> Self {
        let arm = self.eye_in_world - self.target_in_world;
        let eye = self.target_in_world + DQuat::from_rotation_x(-elevation_rad) * arm;
        self.eye_in_world = eye.with_y(eye.y.max(MIN_EYE_M));
        self
    }
}

/// Minimum height of the lens, metres: a lower one would look along the floor. Designed.
const MIN_EYE_M: f64 = 0.12;

/// Shot size of a figure, in film terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shot {
    /// The figure, small, in the room around it.
    Long,
    /// Head to feet.
    Full,
    /// Head to chest, the eyes on the upper third; wider while a gesture needs it.
    Storyteller,
    /// Head to mid thigh; gestures stay in frame.
    Medium,
    /// Head and shoulders.
    Close,
    /// Brow to mouth.
    ExtremeClose,
}

/// Additional space that gestures need in the image. Close shots leave no space for hands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FramingMargin {
    /// Height of the highest fingertip above the floor, metres.
    pub top_m: f64,
    /// Distance of the outermost fingertip from the middle, metres.
    pub half_width_m: f64,
    /// Span that the storyteller's shot currently shows.
    pub span: Span,
    /// Share of the image height that captions take at its lower edge: hands and feet stay above
    /// it. 0 to [`MAX_CAPTIONS`].
    pub captions: f64,
    /// Horizontal offset of the figure in a wide image of the storyteller's shot, share of half its
    /// height, positive to the right.
    pub aside: f64,
}

/// Maximum share of the image reserved for captions; larger captions may cover something.
pub const MAX_CAPTIONS: f64 = 0.4;

/// Expected lateral range of a figure, metres; within it the gestures stay in frame. Designed.
pub(crate) const STAGE_HALF_WIDTH_M: f64 = 1.2;
/// Share of a figure's motion to and from the camera that the camera follows: the figure grows as
/// it approaches, but its head stays in frame. Designed.
pub(crate) const FOLLOWED_DEPTH: f64 = 0.7;

/// Vertical extent that must be in frame, as shares of stature from the floor, and half the width
/// that gestures need.
struct Extent {
    bottom: f64,
    top: f64,
    half_width: f64,
}

impl Shot {
    fn extent(self) -> Extent {
        match self {
            Self::Long => Extent {
                bottom: -0.30,
                top: 1.50,
                half_width: 0.80,
            },
            Self::Full => Extent {
                bottom: -0.03,
                top: 1.08,
                half_width: 0.50,
            },
            Self::Storyteller | Self::Medium => Extent {
                bottom: 0.42,
                top: 1.10,
                half_width: 0.31,
            },
            Self::Close => Extent {
                bottom: 0.77,
                top: 1.05,
                half_width: 0.15,
            },
            Self::ExtremeClose => Extent {
                bottom: 0.86,
                top: 1.01,
                half_width: 0.08,
            },
        }
    }

    /// Returns the span that the shot shows for an emotion, while no gesture needs more, in an
    /// image of `aspect`: close shots show the whole face.
    #[must_use]
    pub fn emotion_span(self, stature_m: f64, aspect: f64) -> Span {
        match self {
            Self::Medium => BUST.with_head(stature_m, aspect),
            Self::Close => HEAD.with_head(stature_m, aspect),
            Self::ExtremeClose => FACE.with_head(stature_m, aspect),
            _ => Span::at_rest(aspect),
        }
    }

    /// Returns the camera for this shot of a figure of the given stature standing at
    /// `feet_in_world` and facing +z, in an image of `aspect` (width over height). A tall image
    /// moves the camera back until the width fits; any image, until the gestures fit. The camera
    /// follows a figure that leaves the origin only as far as necessary, so its walking stays
    /// visible.
    #[must_use]
    pub fn frame(
        self,
        feet_in_world: DVec3,
        stature_m: f64,
        aspect: f64,
        room: FramingMargin,
    ) -> Camera {
        let captions = room.captions.clamp(0.0, MAX_CAPTIONS);
        if self == Self::Storyteller {
            let from = Self::Medium.frame(feet_in_world, stature_m, aspect, room);
            let span = room.span.above_captions_in(captions, aspect);
            let aside = aside_in(aspect, room.aside);
            return from.narrowed_to(span, feet_in_world, stature_m, aspect, aside);
        }
        let mut extent = self.extent();
        if matches!(self, Self::Full | Self::Medium) {
            // Even a hand stretched straight up is within 1.35 of stature.
            extent.top = extent.top.max(room.top_m / stature_m).min(1.35);
            extent.half_width = extent
                .half_width
                .max(room.half_width_m / stature_m)
                .min(0.55);
        }
        // A long lens flatters a face: 0.36 rad is about 66 mm on full frame.
        let fov_y_rad = 0.36;
        let half_height = 0.5 * (extent.top - extent.bottom) * stature_m;
        let half_width = extent.half_width * stature_m;
        let tangent = ops::tan(0.5 * fov_y_rad);
        let aspect = aspect.clamp(0.2, 5.0);
        // The lens looks slightly down, which brings the upper corners nearer to it: 3 %.
        let distance = 1.03 * (half_height / tangent).max(half_width / (tangent * aspect));
        // A tall image shows the additional area below the shot, down to the feet, because space
        // above a head is empty.
        let spare = distance * tangent - half_height;
        let below = (extent.bottom - Self::Full.extent().bottom).max(0.0) * stature_m;
        let height = 0.5 * (extent.top + extent.bottom) * stature_m - spare.min(0.5 * below);
        let play = distance * tangent * aspect - half_width;
        let across = 1.0 - (play / STAGE_HALF_WIDTH_M).min(1.0);
        let middle = feet_in_world * DVec3::new(across, 1.0, FOLLOWED_DEPTH) + DVec3::Y * height;
        // The lens is at chest to eye height and looks slightly down or up as needed.
        let eye_height = feet_in_world.y + (0.80 * stature_m).max(middle.y - feet_in_world.y);
        let camera = Camera {
            eye_in_world: DVec3::new(middle.x, eye_height, middle.z + distance),
            target_in_world: middle,
            fov_y_rad,
            ..Camera::default()
        };
        match self {
            Self::Long | Self::Full => camera.above_captions(captions),
            // The other shots end at the thigh or higher, below resting hands or above all.
            _ => camera,
        }
    }
}

/// Maximum elevation of the view, radians: straight down there is no upper edge.
const MAX_TILT_RAD: f64 = 1.5;

/// Offset of the camera from that of the shot, for inspecting the figure from another direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Azimuth around the figure, radians; positive to its left.
    pub turn_rad: f64,
    /// Elevation, radians; positive raises the camera.
    pub tilt_rad: f64,
    /// Zoom factor relative to the shot.
    pub zoom: f64,
    /// Offset of the image centre to the right, metres.
    pub right_m: f64,
    /// Upward offset, metres.
    pub up_m: f64,
}

impl View {
    /// Returns the camera for this view of the target of `camera`.
    #[must_use]
    pub fn apply(&self, camera: &Camera) -> Camera {
        let distance = (camera.eye_in_world - camera.target_in_world).magnitude();
        let (sin, cos) = ops::sincos(self.turn_rad);
        let (rise, level) = ops::sincos(self.tilt_rad.clamp(-MAX_TILT_RAD, MAX_TILT_RAD));
        let target_in_world =
            camera.target_in_world + DVec3::new(cos * self.right_m, self.up_m, -sin * self.right_m);
        let towards_eye = DVec3::new(sin * level, rise, cos * level);
        Camera {
            eye_in_world: target_in_world + towards_eye * (distance / self.zoom.clamp(0.25, 32.0)),
            target_in_world,
            ..*camera
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_goes_round_and_nearer_and_keeps_what_it_looks_at() {
        let shot = Shot::Full.frame(DVec3::ZERO, 1.7, 1.6, FramingMargin::default());
        let distance = (shot.eye_in_world - shot.target_in_world).length();
        let view = View {
            turn_rad: std::f64::consts::FRAC_PI_2,
            tilt_rad: 0.0,
            zoom: 2.0,
            right_m: 0.0,
            up_m: 0.3,
        };
        let seen = view.apply(&shot);
        let middle = shot.target_in_world + DVec3::Y * 0.3;
        assert!(
            (seen.target_in_world - middle).length() < 1e-12,
            "the target moves up by 30 cm"
        );
        // From the figure's left, at half the distance.
        let eye = middle + DVec3::X * (0.5 * distance);
        assert!(
            (seen.eye_in_world - eye).length() < 1e-9,
            "the camera is on the left at half the distance"
        );
        // Its right edge is then the figure's back.
        let aside = View {
            right_m: 0.2,
            ..view
        };
        let moved = aside.apply(&shot).target_in_world - middle;
        assert!(
            (moved - DVec3::NEG_Z * 0.2).length() < 1e-9,
            "the target moves sideways by 20 cm"
        );
        let above = View {
            tilt_rad: 9.0,
            ..view
        };
        let from = above.apply(&shot);
        assert!(
            (from.eye_in_world - from.target_in_world).y < 0.5 * distance,
            "the tilt of the view is limited"
        );
    }

    #[test]
    fn a_narrow_picture_stands_further_back() {
        let wide = Shot::Medium.frame(DVec3::ZERO, 1.7, 16.0 / 9.0, FramingMargin::default());
        let tall = Shot::Medium.frame(DVec3::ZERO, 1.7, 390.0 / 844.0, FramingMargin::default());
        assert!(
            tall.eye_in_world.z > wide.eye_in_world.z,
            "the camera of a tall image is farther away"
        );
        for c in [wide, tall] {
            assert!(
                c.eye_in_world.z > c.near_m && c.eye_in_world.z < c.far_m,
                "the character is between the near and the far plane"
            );
        }
    }

    #[test]
    fn a_raised_hand_is_in_the_picture() {
        let room = FramingMargin {
            top_m: 2.05,
            half_width_m: 0.7,
            ..FramingMargin::default()
        };
        for aspect in [0.46, 1.0, 1.78] {
            let c = Shot::Medium.frame(DVec3::ZERO, 1.66, aspect, room);
            let forward = (c.target_in_world - c.eye_in_world).normalize();
            let up = (DVec3::Y - forward * forward.y).normalize();
            for x in [-0.7, 0.7] {
                let to_hand = DVec3::new(x, 2.05, 0.0) - c.eye_in_world;
                let depth = to_hand.dot(forward);
                let limit = ops::tan(c.fov_y_rad / 2.0);
                assert!(to_hand.dot(up) / depth < limit * 1.001, "{aspect}");
                assert!(to_hand.x.abs() / depth < limit * aspect * 1.001, "{aspect}");
            }
        }
    }

    #[test]
    fn feet_stand_above_captions_and_the_crown_stays() {
        for captions in [0.0, 0.1, 0.2, 0.4] {
            for aspect in [0.46, 1.0, 1.78] {
                for shot in [Shot::Long, Shot::Full] {
                    let of = |captions: f64| {
                        let room = FramingMargin {
                            captions,
                            ..FramingMargin::default()
                        };
                        let c = shot.frame(DVec3::ZERO, 1.66, aspect, room);
                        let forward = (c.target_in_world - c.eye_in_world).normalize();
                        let up = (DVec3::Y - forward * forward.y).normalize();
                        let limit = ops::tan(c.fov_y_rad / 2.0);
                        move |y: f64| {
                            let to = DVec3::Y * y - c.eye_in_world;
                            // From the lower edge, 0 to 1.
                            0.5 + 0.5 * to.dot(up) / (to.dot(forward) * limit)
                        }
                    };
                    let (plain, above) = (of(0.0), of(captions));
                    assert!(above(0.0) > captions, "{shot:?} {aspect} {captions}");
                    assert!(
                        (above(1.72) - (captions + (1.0 - captions) * plain(1.72))).abs() < 0.01,
                        "the crown keeps its height above the captions"
                    );
                }
            }
        }
    }

    #[test]
    fn a_figure_that_goes_to_the_edge_of_the_stage_stays_in_the_picture() {
        for shot in [Shot::Long, Shot::Full, Shot::Medium, Shot::Close] {
            for aspect in [0.46, 1.0, 1.78] {
                let feet = DVec3::new(STAGE_HALF_WIDTH_M, 0.0, 0.5);
                let c = shot.frame(feet, 1.66, aspect, FramingMargin::default());
                let crown = feet + DVec3::new(0.09, 1.66, 0.0) - c.eye_in_world;
                let forward = (c.target_in_world - c.eye_in_world).normalize();
                let up = (DVec3::Y - forward * forward.y).normalize();
                let limit = ops::tan(c.fov_y_rad / 2.0) * crown.dot(forward);
                assert!(crown.x < limit * aspect, "{shot:?} {aspect}");
                assert!(crown.dot(up) < limit, "{shot:?} {aspect}");
                // The displacement is visible.
                assert!(crown.x > 0.05 * limit * aspect, "{shot:?} {aspect}");
            }
        }
    }

    #[test]
    fn angles_look_down_and_up_from_above_the_floor() {
        for shot in [Shot::Long, Shot::Full, Shot::Medium, Shot::Close] {
            let level = shot.frame(DVec3::ZERO, 1.66, 1.78, FramingMargin::default());
            let (high, low) = (level.raised(0.35), level.raised(-0.25));
            assert!(
                high.eye_in_world.y > level.eye_in_world.y + 0.1,
                "the high angle is above the level one"
            );
            assert!(
                low.eye_in_world.y < level.eye_in_world.y - 0.1,
                "the low angle is below the level one"
            );
            assert!(
                low.eye_in_world.y >= MIN_EYE_M,
                "the low angle stays above the floor"
            );
        }
    }

    #[test]
    fn the_crown_and_the_gesture_space_are_in_the_picture() {
        for shot in [Shot::Long, Shot::Full, Shot::Medium, Shot::Close] {
            for aspect in [0.46, 1.0, 1.78] {
                let c = shot.frame(DVec3::ZERO, 1.66, aspect, FramingMargin::default());
                let forward = (c.target_in_world - c.eye_in_world).normalize();
                let up = (DVec3::Y - forward * forward.y).normalize();
                let to_crown = DVec3::new(0.0, 1.66, 0.0) - c.eye_in_world;
                let y = to_crown.dot(up) / to_crown.dot(forward);
                assert!(y < ops::tan(c.fov_y_rad / 2.0), "{shot:?} {aspect}: {y}");
            }
        }
    }
}

//! The storyteller's shot: head to chest with the eyes on the upper third of the frame, wider only
//! while a gesture needs it; to the waist on a phone in portrait orientation.
//!
//! The camera has the position of a medium shot and zooms, so that the figure's gaze does not
//! depend on its hands.

use raconteur_base::curve::{lerp, minimum_jerk, smooth};
use raconteur_base::ops;

/// Height of the eyes, share of stature (ANSUR, men and women: 0.93–0.94).
const EYES: f64 = 0.933;
/// Height of the image around the eyes while no gesture needs more, share of stature: a head takes
/// more than a quarter of it. In a narrow image it is [`AT_REST_NARROW`], which reaches the waist.
/// Designed.
pub(crate) const AT_REST: f64 = 0.47;
const AT_REST_NARROW: f64 = 0.54;
/// Height of the throat, share of stature: captions may lie below it while hands rest. Designed.
const THROAT: f64 = 0.80;
/// Minimum lowering of the image while hands come near its lower edge, and the distance that counts
/// as near, shares of stature. Designed.
const PULLED: f64 = 0.05;
const NEAR_EDGE: f64 = 0.10;
/// Share of the image above the eyes.
const ABOVE: f64 = 1.0 / 3.0;
/// Limits up to which gestures are followed, shares of stature: hands at the thighs, a hand
/// stretched straight up, and arms spread with bent elbows.
const MIN_HEIGHT: f64 = 0.36;
const MAX_HEIGHT: f64 = 1.35;
const MAX_HALF_WIDTH: f64 = 0.55;
/// Aspect (width over height) from which a narrow image shows hands only up to [`NARROW_MAX`]: on
/// an upright phone a face matters more. Designed.
const NARROW: f64 = 0.85;
/// Aspect ratio, width over height, from which an image shows the hands at all times. Designed.
pub const BROAD: f64 = 1.0;
/// Maximum span that a narrow image shows for hands, share of stature: from below the waist up.
/// Hands beyond it briefly leave the image. Designed.
const NARROW_MAX: f64 = 0.64;
/// Share of the caption space that a narrow image reserves: hands may rest behind captions.
/// Designed.
const NARROW_CAPTIONS: f64 = 0.4;
/// Spans of shots for emotions, shares of stature: from the chest up, head and shoulders, and the
/// face with room for nods. Designed.
pub(crate) const BUST: Span = Span {
    bottom: 0.66,
    top: 1.08,
};
pub(crate) const HEAD: Span = Span {
    bottom: 0.76,
    top: 1.06,
};
pub(crate) const FACE: Span = Span {
    bottom: 0.835,
    top: 1.045,
};
/// Distance to which hands are held out, share of stature. Designed.
const HELD_OUT: f64 = 0.22;
/// Aspects between which the figure moves aside, width over height: up to the first it is centred,
/// from the second on it is as far aside as its set requests. Designed.
const MIDDLE: f64 = 1.0;
const ASIDE: f64 = 1.25;
/// Half the width of a turning head, share of stature.
const HEAD_HALF_WIDTH: f64 = 0.085;
/// Maximum zoom speed for one gesture, share of the image height per second. Two may move the upper
/// and the lower edge at once. Designed: it is not noticeable.
pub const SLOW_ZOOM: f64 = 0.05;
/// Zoom speed for shots of emotions, as fast as a camera operator's, because hands come before the
/// lens within seconds. Designed.
pub const QUICK_ZOOM: f64 = 0.25;
/// Peak speed of a minimum-jerk motion over its mean.
const PEAK: f64 = 1.875;

/// Lowering of a held space, metres: invisible.
const HELD_M: f64 = 1e-4;

/// Returns the narrowness of an image of `aspect`, 0 to 1.
fn narrow(aspect: f64) -> f64 {
    ((BROAD - aspect) / (BROAD - NARROW)).clamp(0.0, 1.0)
}

/// Returns the horizontal offset of a figure in an image of `aspect` (width over height) for a set
/// that requests `aside`: share of half the image height, positive to the right.
#[must_use]
pub fn aside_in(aspect: f64, aside: f64) -> f64 {
    aside * smooth((aspect - MIDDLE) / (ASIDE - MIDDLE))
}

/// Space taken by the hands or the whole body, which the camera keeps in the image; metres from the
/// floor and from the middle of the figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TakenSpace {
    /// Height of the highest fingertip or of the crown, metres.
    pub top_m: f64,
    /// Height of the lowest fingertip or of the feet, metres.
    pub bottom_m: f64,
    /// Distance of the outermost fingertip from the middle, metres.
    pub half_width_m: f64,
}

impl TakenSpace {
    /// Returns the space of a whole body of a stature, with the arms half spread.
    #[must_use]
    pub fn of_body(stature_m: f64) -> Self {
        Self {
            top_m: 1.08 * stature_m,
            bottom_m: -0.03 * stature_m,
            half_width_m: 0.5 * stature_m,
        }
    }

    /// Returns the space with a small margin, which a narrow image shows whole, too.
    #[must_use]
    pub fn with_margin(self) -> Self {
        Self {
            bottom_m: self.bottom_m - HELD_M,
            ..self
        }
    }

    /// Returns the space limited to the range in which hands are followed.
    #[must_use]
    pub fn within_reach(self, stature_m: f64) -> Self {
        Self {
            top_m: self.top_m.min(MAX_HEIGHT * stature_m),
            bottom_m: self.bottom_m.max(MIN_HEIGHT * stature_m),
            half_width_m: self.half_width_m.min(MAX_HALF_WIDTH * stature_m),
        }
    }
}

/// Time span of a gesture and the space that it takes, to which the camera zooms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gesture {
    /// Start, story time, seconds.
    pub from_secs: f64,
    /// Seconds, not before `from_secs`.
    pub to_secs: f64,
    /// Space taken during the gesture.
    pub space: TakenSpace,
}

/// Vertical span of a figure that the image shows, shares of stature from the floor under it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    pub(crate) bottom: f64,
    pub(crate) top: f64,
}

impl Default for Span {
    /// Returns the span that the image shows if no gesture needs more.
    fn default() -> Self {
        Self::about_eyes(AT_REST)
    }
}

impl Span {
    /// Returns a span of a height about the eyes, share of stature.
    fn about_eyes(height: f64) -> Self {
        Self {
            bottom: EYES - (1.0 - ABOVE) * height,
            top: EYES + ABOVE * height,
        }
    }

    /// Returns the span of an image of `aspect` (width over height) while no gesture needs more.
    #[must_use]
    pub fn at_rest(aspect: f64) -> Self {
        Self::about_eyes(lerp(AT_REST, AT_REST_NARROW, narrow(aspect)))
    }

    /// Returns the span extended for a turning head, in an image of `aspect`.
    #[must_use]
    pub(crate) fn with_head(self, stature_m: f64, aspect: f64) -> Self {
        let head = TakenSpace {
            top_m: self.top * stature_m,
            bottom_m: self.bottom * stature_m,
            half_width_m: HEAD_HALF_WIDTH * stature_m,
        };
        self.including_hands(&head, stature_m, aspect)
    }

    fn height(self) -> f64 {
        self.top - self.bottom
    }

    /// Returns the span a share of the way to another, 0..1.
    #[must_use]
    pub fn towards(self, to: Self, share: f64) -> Self {
        Self {
            bottom: lerp(self.bottom, to.bottom, share),
            top: lerp(self.top, to.top, share),
        }
    }

    /// Returns the span that keeps hands above a share of the image height at its lower edge, for
    /// an image that shows `at_rest` while they rest.
    #[must_use]
    fn above_captions(self, share: f64, at_rest: f64) -> Self {
        // A gesture that widens the frame extends down to its lower edge.
        let spare = (THROAT - at_rest) * (1.0 - smooth((at_rest - self.bottom) / PULLED));
        // A closer frame has correspondingly less spare space.
        let lowest = self.bottom + spare * (self.height() / AT_REST).min(1.0);
        Self {
            bottom: self
                .bottom
                .min(self.top - (self.top - lowest) / (1.0 - share)),
            ..self
        }
    }

    /// Returns the vertical span of the figure for a camera at this elevation, radians, positive from
    /// above. From above, hands held out in front appear lower than from eye height; from below,
    /// higher.
    #[must_use]
    pub fn seen_from(self, elevation_rad: f64) -> Self {
        let shift = HELD_OUT * ops::sincos(elevation_rad).0 * (self.height() / AT_REST).min(1.0);
        Self {
            bottom: self.bottom - shift.max(0.0),
            top: self.top - shift.min(0.0),
        }
    }

    /// Returns the union with another span.
    fn and(self, other: Self) -> Self {
        Self {
            bottom: self.bottom.min(other.bottom),
            top: self.top.max(other.top),
        }
    }

    /// Returns the span extended by the space of hands, in an image of `aspect` (width over
    /// height).
    #[must_use]
    pub fn including_hands(self, space: &TakenSpace, stature_m: f64, aspect: f64) -> Self {
        let held = self.and(Self {
            bottom: space.bottom_m / stature_m,
            top: space.top_m / stature_m,
        });
        let wide = 2.0 * space.half_width_m / (stature_m * aspect);
        let more = (wide - held.height()).max(0.0);
        // A tall image shows the additional area below the gesture, down to the feet.
        let below = ((1.0 - ABOVE) * more).min(held.bottom.max(0.0));
        Self {
            bottom: held.bottom - below,
            top: held.top + more - below,
        }
    }

    /// Returns the span that keeps hands above captions in an image of `aspect`; a narrow image
    /// does so only partly, to keep the face large.
    #[must_use]
    pub(crate) fn above_captions_in(self, share: f64, aspect: f64) -> Self {
        let at_rest = Self::at_rest(aspect).bottom;
        self.above_captions(share * lerp(1.0, NARROW_CAPTIONS, narrow(aspect)), at_rest)
    }

    /// Returns the span for a gesture: all of it, but in a narrow image no more than from below the
    /// waist up for hands. A whole body is shown whole.
    fn for_gesture(self, space: &TakenSpace, stature_m: f64, aspect: f64) -> Self {
        let mut needed = self.including_hands(space, stature_m, aspect);
        // Hands near the lower edge get air below them, and are not behind captions.
        if space.bottom_m < (self.bottom + NEAR_EDGE) * stature_m {
            needed.bottom = needed.bottom.min(self.bottom - PULLED);
        }
        // A lower extent than the followed hands belongs to the body or to a held pose.
        let is_body = space.bottom_m < MIN_HEIGHT * stature_m - 0.5 * HELD_M;
        let more = needed.height() - self.height();
        if is_body || more <= 0.0 {
            return needed;
        }
        let allowed = (NARROW_MAX.max(self.height()) - self.height()).min(more);
        self.towards(needed, lerp(1.0, allowed / more, narrow(aspect)))
    }

    /// Returns the span at a time: everything the current gestures need, and of those before and
    /// after it as much as limits the zoom to `zoom`, share of the image height per second for each
    /// gesture: [`SLOW_ZOOM`] or [`QUICK_ZOOM`].
    #[must_use]
    pub fn visible_span(
        self,
        gestures: &[Gesture],
        zoom: f64,
        time_secs: f64,
        stature_m: f64,
        aspect: f64,
    ) -> Self {
        gestures.iter().fold(self, |shown, g| {
            let off = (g.from_secs - time_secs)
                .max(time_secs - g.to_secs)
                .max(0.0);
            let needed = self.for_gesture(&g.space, stature_m, aspect);
            let way_secs = PEAK * ops::ln(needed.height() / self.height()) / zoom;
            if off >= way_secs {
                return shown;
            }
            let share = 1.0 - minimum_jerk(off / way_secs);
            shown.and(self.towards(needed, share))
        })
    }
}

#[cfg(test)]
mod tests {
    use raconteur_base::DVec3;

    use super::*;
    use crate::camera::STAGE_HALF_WIDTH_M;
    use crate::{FramingMargin, Shot};

    const STATURE_M: f64 = 1.66;

    fn seen(span: Span, aspect: f64) -> impl Fn(DVec3) -> [f64; 2] {
        let room = FramingMargin {
            span,
            ..FramingMargin::default()
        };
        let c = Shot::Storyteller.frame(DVec3::ZERO, STATURE_M, aspect, room);
        let forward = (c.target_in_world - c.eye_in_world).normalize();
        let up = (DVec3::Y - forward * forward.y).normalize();
        let limit = ops::tan(0.5 * c.fov_y_rad);
        move |p: DVec3| {
            let to = p - c.eye_in_world;
            let depth = to.dot(forward) * limit;
            [to.x / (depth * aspect), to.dot(up) / depth]
        }
    }

    #[test]
    fn the_eyes_lie_on_the_upper_third_and_the_head_takes_a_quarter() {
        for aspect in [0.46, 0.75, 1.0, 1.78] {
            let at = seen(Span::at_rest(aspect), aspect);
            let y = |share: f64| at(DVec3::Y * (share * STATURE_M))[1];
            assert!((y(EYES) - 1.0 / 3.0).abs() < 0.02, "{aspect}: {}", y(EYES));
            // From menton to vertex.
            let least = if aspect < BROAD { 0.23 } else { 0.27 };
            assert!(0.5 * (y(1.0) - y(0.868)) > least, "{aspect}");
        }
        // The waist is visible on a phone, not on a desktop (ANSUR: 0.61 to 0.62).
        assert!(
            Span::at_rest(0.46).bottom < 0.6 && Span::at_rest(1.78).bottom > 0.61,
            "the waist is visible on a phone only"
        );
    }

    #[test]
    fn a_figure_aside_stays_so_and_its_hands_are_seen() {
        let room = FramingMargin {
            aside: 0.36,
            ..FramingMargin::default()
        };
        for (aspect, expected) in [
            (0.46, 0.0),
            (1.0, 0.0),
            (1.25, 0.36),
            (1.78, 0.36),
            (2.4, 0.36),
        ] {
            let c = Shot::Storyteller.frame(DVec3::ZERO, STATURE_M, aspect, room);
            let middle =
                Shot::Storyteller.frame(DVec3::ZERO, STATURE_M, aspect, FramingMargin::default());
            assert_eq!(
                c.eye_in_world, middle.eye_in_world,
                "it is looked at the same"
            );
            let half = ops::tan(0.5 * c.fov_y_rad) * (c.eye_in_world.z - c.target_in_world.z);
            let x = (DVec3::ZERO - c.target_in_world).x / half;
            assert!((x - expected).abs() < 0.02, "{aspect}: {x}");
        }
    }

    #[test]
    fn hands_and_throat_are_above_captions_and_the_head_stays_a_fifth() {
        for captions in [0.0, 0.1, 0.2] {
            let at_rest = Span::default().bottom;
            let span = Span::default().above_captions(captions, at_rest);
            let share = |y: f64| (y - span.bottom) / span.height();
            assert!(share(THROAT) >= captions - 1e-9, "{captions}");
            assert!(share(1.0) - share(0.868) > 0.25, "{captions}");
            // Hands of a gesture at any height.
            for bottom in [0.40, 0.56, 0.60, 0.65, 0.70] {
                let space = TakenSpace {
                    top_m: 0.9 * STATURE_M,
                    bottom_m: bottom * STATURE_M,
                    half_width_m: 0.3,
                };
                let wide = Span::default().for_gesture(&space, STATURE_M, 1.78);
                let above = wide.above_captions(captions, at_rest);
                let hands = (bottom - above.bottom) / above.height();
                assert!(hands >= captions - 1e-9, "{captions} {bottom}: {hands}");
                assert_eq!(above.top, wide.top);
            }
        }
    }

    #[test]
    fn a_gesture_is_in_the_picture_while_it_lasts_and_the_zoom_is_slow() {
        let space = TakenSpace {
            top_m: 2.0,
            bottom_m: 0.9,
            half_width_m: 0.7,
        };
        let gestures =
            [(120.0, 121.0), (125.0, 127.0), (160.0, 160.5)].map(|(from_secs, to_secs)| Gesture {
                from_secs,
                to_secs,
                space,
            });
        for aspect in [1.0, 1.33, 1.78] {
            let at =
                |t: f64| Span::default().visible_span(&gestures, SLOW_ZOOM, t, STATURE_M, aspect);
            assert_eq!(at(0.0), Span::default());
            for t in [120.0, 121.0, 126.0, 160.2] {
                let on = seen(at(t), aspect);
                for p in [DVec3::new(0.7, 2.0, 0.0), DVec3::new(-0.7, 0.9, 0.0)] {
                    assert!(
                        on(p).iter().all(|x| x.abs() < 1.01),
                        "{aspect} {t} {:?}",
                        on(p)
                    );
                }
            }
            let mut most = 0.0f64;
            for i in 0..15_000 {
                let t = f64::from(i) * 0.02;
                let rate = ops::ln(at(t + 0.02).height() / at(t).height()) / 0.02;
                most = most.max(rate.abs());
            }
            assert!(most < 0.1 && most > 0.01, "{aspect}: {most}");
        }
    }

    #[test]
    fn a_narrow_picture_stays_at_the_hips_for_hands_and_shows_a_whole_body() {
        let of = |space: TakenSpace, aspect: f64| {
            let gestures = [Gesture {
                from_secs: 1.0,
                to_secs: 2.0,
                space,
            }];
            let at = |t: f64| {
                Span::at_rest(aspect).visible_span(&gestures, SLOW_ZOOM, t, STATURE_M, aspect)
            };
            (at(1.5).height(), at(1.5))
        };
        let hands = TakenSpace {
            top_m: 1.5,
            bottom_m: 0.9,
            half_width_m: 0.5,
        };
        for aspect in [0.46, 0.6, 0.8] {
            let (height, span) = of(hands, aspect);
            assert!((height - NARROW_MAX).abs() < 1e-9, "{aspect}: {height}");
            // From menton to vertex, above captions of two lines, in pixels of a phone 390 wide.
            let shown = span.above_captions_in(0.15, aspect).height();
            let face = (1.0 - 0.868) / shown * 390.0 / aspect;
            assert!(face > 85.0, "{aspect}: {face}");
            assert!(span.bottom < 0.53 && span.top > 1.04, "{span:?}");
        }
        let (between, all) = (of(hands, 0.95).0, of(hands, 1.0).0);
        assert!(
            between.min(all) >= Span::at_rest(1.0).height(),
            "{between} {all}"
        );
        let (body, _) = of(TakenSpace::of_body(STATURE_M), 0.46);
        assert!(body > 1.1, "{body}");
    }

    #[test]
    fn a_figure_at_the_edge_of_the_stage_stays_in_the_picture() {
        for aspect in [0.46, 1.0, 1.78] {
            let feet = DVec3::new(STAGE_HALF_WIDTH_M, 0.0, 0.5);
            let c = Shot::Storyteller.frame(feet, STATURE_M, aspect, FramingMargin::default());
            let crown = feet + DVec3::new(0.09, STATURE_M, 0.0) - c.eye_in_world;
            let forward = (c.target_in_world - c.eye_in_world).normalize();
            let up = (DVec3::Y - forward * forward.y).normalize();
            let limit = ops::tan(0.5 * c.fov_y_rad) * crown.dot(forward);
            assert!(
                crown.x < limit * aspect && crown.dot(up) < limit,
                "{aspect}"
            );
        }
    }
}

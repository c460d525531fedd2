//! Controls of a face at one time.

use raconteur_base::curve::lerp;

use super::{CLOSES_JAW, MUSCLES};

/// Four degrees of freedom of the lower jaw in speech (F&H section 3.1.1): pitch and yaw,
/// horizontal and vertical position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jaw {
    /// Turn about the figure's left, positive opens; radians, 0 to 0.35.
    pub pitch_rad: f64,
    /// Turn about up, positive to the figure's left; radians, −0.1 to 0.1.
    pub yaw_rad: f64,
    /// Slide forwards, metres, −0.004 to 0.008.
    pub forward_m: f64,
    /// Slide downwards, metres, 0 to 0.004.
    pub down_m: f64,
}

impl Jaw {
    /// Minimum and maximum of pitch and yaw, radians, and of the slide forwards and downwards,
    /// metres. Designed for speech and expression, within an adult's limits of some 30° and a
    /// centimetre.
    pub const RANGES: [[f64; 2]; 4] = [[0.0, 0.35], [-0.1, 0.1], [-0.004, 0.008], [0.0, 0.004]];

    /// Maximum slide of the jaw's joint from its rest position, metres.
    pub const MAX_SLIDE_M: f64 = 0.009;
}

/// Controls of a face at one time: muscle contractions, and direct parameters for movements without
/// a muscle here (F&H section 3.1.2). The caller clamps values to their range.
///
/// # Examples
///
/// ```
/// use raconteur_tissue::FaceControls;
///
/// let rest = FaceControls::default();
/// let mut open = rest.clone();
/// open.jaw.pitch_rad = 0.2;
/// let half = rest.lerp(&open, 0.5);
/// assert!((half.jaw.pitch_rad - 0.1).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceControls {
    /// Contraction of each [`Muscle`](super::Muscle), 0 relaxed to 1.
    pub contraction: [f64; MUSCLES],
    /// Protrusion (positive) or retraction of the upper and of the lower lip by the ring of
    /// the mouth, −1 to 1.
    pub protrusion: [f64; 2],
    /// Strength with which the ring of the mouth closes the lips, regardless of the jaw: 0 not at
    /// all, 1 they touch and press (p, b, m).
    pub seal: f64,
    /// Movement of the lower lip to the edge of the upper teeth (f, v), 0 to 1.
    pub bite: f64,
    /// Position of the lower jaw.
    pub jaw: Jaw,
    /// Left and right upper lid: 0 as set by the gaze, 1 closed, −1 wide open.
    pub upper_lid: [f64; 2],
    /// Left and right lower lid: 0 at rest, 1 raised as in a tight squint.
    pub lower_lid: [f64; 2],
    /// Tip of the tongue raised to the ridge behind the teeth, 0 to 1.
    pub tongue_tip: f64,
    /// Back of the tongue raised to the velum, 0 to 1.
    pub tongue_back: f64,
    /// Tongue between the teeth, 0 to 1.
    pub tongue_out: f64,
    /// Change of the blood in the skin of the face, −1 (pallor) to 1 (blush); 0 is usual.
    pub blush: f64,
}

impl Default for FaceControls {
    /// Returns the controls of a face at rest.
    fn default() -> Self {
        Self {
            contraction: [0.0; MUSCLES],
            protrusion: [0.0; 2],
            seal: 0.0,
            bite: 0.0,
            jaw: Jaw::default(),
            upper_lid: [0.0; 2],
            lower_lid: [0.0; 2],
            tongue_tip: 0.0,
            tongue_back: 0.0,
            tongue_out: 0.0,
            blush: 0.0,
        }
    }
}

/// Function that maps a value, given another face's value and the range.
type Change<'a> = &'a dyn Fn(f64, f64, [f64; 2]) -> f64;

impl FaceControls {
    /// Clamps every value to its range. Contractions from all sources are summed (F&H section
    /// 4.3.5); this limits the sums. NaN becomes 0.
    pub fn limit(&mut self) {
        let own = *self;
        self.change(&own, &|value, _, [low, high]| {
            if value.is_nan() {
                0.0
            } else {
                value.clamp(low, high)
            }
        });
    }

    /// Interpolates every value from this face to another by a share (0 to 1).
    #[must_use]
    pub fn lerp(&self, to: &Self, share: f64) -> Self {
        let mut between = *self;
        between.change(to, &|from, to, _| lerp(from, to, share));
        between
    }

    /// Closes the lower jaw by the contraction of the muscles that raise it, against any other
    /// opening control: one at full contraction closes it completely. Lateral and forward slides
    /// and rotations follow their controls. Call it after all additions.
    pub fn raise_jaw(&mut self) {
        for (muscle, percent) in CLOSES_JAW {
            let contraction = self.contraction[muscle.index()];
            if contraction > 0.0 {
                let left = 1.0 - 0.01 * f64::from(percent) * contraction.min(1.0);
                self.jaw.pitch_rad *= left;
                self.jaw.down_m *= left;
            }
        }
    }

    /// Moves both upper lids a share (0 to 1) of the distance from their position to closed: a
    /// blink, which closes them from any expression. Call it last.
    pub fn close_lids(&mut self, share: f64) {
        self.upper_lid = self.upper_lid.map(|lid| lerp(lid, 1.0, share));
    }

    fn change(&mut self, other: &Self, to: Change<'_>) {
        let (share, signed) = ([0.0, 1.0], [-1.0, 1.0]);
        let each = |values: &mut [f64], others: &[f64], range: [f64; 2]| {
            for (value, other) in values.iter_mut().zip(others) {
                *value = to(*value, *other, range);
            }
        };
        each(&mut self.contraction, &other.contraction, share);
        each(&mut self.protrusion, &other.protrusion, signed);
        each(&mut self.upper_lid, &other.upper_lid, signed);
        each(&mut self.lower_lid, &other.lower_lid, share);
        let jaw = &other.jaw;
        for (value, other, range) in [
            (&mut self.seal, other.seal, share),
            (&mut self.bite, other.bite, share),
            (&mut self.tongue_tip, other.tongue_tip, share),
            (&mut self.tongue_back, other.tongue_back, share),
            (&mut self.tongue_out, other.tongue_out, share),
            (&mut self.blush, other.blush, signed),
            (&mut self.jaw.pitch_rad, jaw.pitch_rad, Jaw::RANGES[0]),
            (&mut self.jaw.yaw_rad, jaw.yaw_rad, Jaw::RANGES[1]),
            (&mut self.jaw.forward_m, jaw.forward_m, Jaw::RANGES[2]),
            (&mut self.jaw.down_m, jaw.down_m, Jaw::RANGES[3]),
        ] {
            *value = to(*value, other, range);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns controls in which every value is `value`.
    fn all(value: f64) -> FaceControls {
        let mut face = FaceControls::default();
        face.change(&FaceControls::default(), &|_, _, _| value);
        face
    }

    #[test]
    fn every_value_is_brought_into_its_range() {
        let [mut low, mut high, mut none] = [-9.0, 9.0, f64::NAN].map(all);
        low.limit();
        high.limit();
        none.limit();
        assert_eq!(none, FaceControls::default());
        assert_eq!(
            (low.contraction, high.contraction),
            ([0.0; MUSCLES], [1.0; MUSCLES])
        );
        assert_eq!((low.protrusion, high.protrusion), ([-1.0; 2], [1.0; 2]));
        assert_eq!((low.upper_lid, low.lower_lid), ([-1.0; 2], [0.0; 2]));
        assert_eq!((low.blush, low.seal, high.bite), (-1.0, 0.0, 1.0));
        assert_eq!(
            (high.tongue_tip, high.tongue_back, high.tongue_out),
            (1.0, 1.0, 1.0)
        );
        let jaw = |face: FaceControls| {
            let Jaw {
                pitch_rad,
                yaw_rad,
                forward_m,
                down_m,
            } = face.jaw;
            [pitch_rad, yaw_rad, forward_m, down_m]
        };
        assert_eq!(jaw(low), Jaw::RANGES.map(|[least, _]| least));
        assert_eq!(jaw(high), Jaw::RANGES.map(|[_, most]| most));
        let slides =
            [low, high].map(|face| raconteur_base::ops::hypot(face.jaw.forward_m, face.jaw.down_m));
        assert!(
            slides.into_iter().all(|slide| slide < Jaw::MAX_SLIDE_M),
            "the jaw slides less than its maximum"
        );
    }

    #[test]
    fn a_mixture_lies_between_and_ends_where_it_should() {
        let (a, b) = (all(0.25), all(0.75));
        assert_eq!(a.lerp(&b, 0.5), all(0.5));
        assert_eq!((a.lerp(&b, 0.0), a.lerp(&b, 1.0)), (a, b));
    }

    #[test]
    fn one_muscle_that_raises_the_jaw_closes_it_and_two_no_further() {
        let masseters = CLOSES_JAW.map(|(muscle, _)| muscle.index());
        for (asked, left) in [
            ([0.0, 0.0], 1.0),
            ([0.5, 0.0], 0.5),
            ([0.0, 0.5], 0.5),
            ([0.5, 0.5], 0.25),
            ([1.0, 0.0], 0.0),
            ([1.0, 1.0], 0.0),
            ([7.0, f64::NAN], 0.0),
            ([-1.0, f64::NAN], 1.0),
        ] {
            let mut face = all(0.003);
            for (muscle, asked) in masseters.into_iter().zip(asked) {
                face.contraction[muscle] = asked;
            }
            face.raise_jaw();
            let Jaw {
                pitch_rad,
                yaw_rad,
                forward_m,
                down_m,
            } = face.jaw;
            assert_eq!([pitch_rad, down_m], [0.003 * left; 2], "{asked:?}");
            assert_eq!([yaw_rad, forward_m], [0.003; 2]);
        }
    }

    #[test]
    fn a_blink_closes_wide_eyes_too() {
        for lid in [-1.0, 0.0, 0.4, 1.0] {
            let mut face = all(lid);
            face.close_lids(0.5);
            assert!(
                (face.upper_lid[0] - (lid + 1.0) / 2.0).abs() < 1e-12,
                "half a blink moves the lid halfway to closed"
            );
            face.close_lids(1.0);
            assert_eq!(face.upper_lid, [1.0; 2]);
        }
    }
}

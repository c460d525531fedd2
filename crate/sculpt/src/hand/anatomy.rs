//! Joints, bone lengths and cross-sections of the mean adult hand.
//!
//! Frame of this folder, unless specified otherwise: right hand, millimetres, x radial (towards the
//! thumb), y distal (towards the fingertips), z palmar, wrist joint at the origin. The fingers are
//! straight and slightly splayed, so that their surfaces do not merge.
//!
//! Bone lengths after Buryanov and Kotiuk 2010, "Proportions of hand segments" (Int. J. Morphol.
//! 28(3), 755–758); cross-sections are chosen by eye.

use raconteur_base::{DMat3, DVec3, curve};

use raconteur_body::hand_shape::{FingerAngles, HandAngles, ThumbAngles};

/// Fingers are counted thumb 0, index 1, middle 2, ring 3, little 4.
pub(super) const FINGER_COUNT: usize = 5;

/// The angles in which the hand is modelled.
pub(super) const BIND_ANGLES: HandAngles = {
    const fn splayed(deg: f64) -> FingerAngles {
        FingerAngles {
            mcp_flexion: 0.0,
            mcp_abduction: deg.to_radians(),
            pip_flexion: 0.0,
            dip_flexion: 0.0,
        }
    }
    HandAngles {
        fingers: [splayed(7.0), splayed(1.0), splayed(-5.5), splayed(-13.0)],
        thumb: ThumbAngles {
            cmc_flexion: 0.0,
            cmc_abduction: 0.0,
            cmc_rotation: 0.0,
            mcp_flexion: 0.0,
            ip_flexion: 0.0,
        },
    }
};

/// Smooth curve through keys (cubic Hermite, slopes by central differences), constant beyond its
/// ends; gives a cross-section dimension by position.
pub(super) struct Curve {
    keys: Vec<(f64, f64)>,
    slopes: Vec<f64>,
}

impl Curve {
    pub(super) fn new(xs: &[f64], ys: &[f64]) -> Self {
        let n = xs.len();
        let slopes = (0..n)
            .map(|i| {
                let chord = |a: usize, b: usize| (ys[b] - ys[a]) / (xs[b] - xs[a]);
                if i == 0 {
                    chord(0, 1)
                } else if i == n - 1 {
                    chord(n - 2, n - 1)
                } else {
                    // The slope of the parabola through three uneven keys.
                    let (before, after) = (xs[i] - xs[i - 1], xs[i + 1] - xs[i]);
                    (after * chord(i - 1, i) + before * chord(i, i + 1)) / (before + after)
                }
            })
            .collect();
        Self {
            keys: xs.iter().copied().zip(ys.iter().copied()).collect(),
            slopes,
        }
    }

    pub(super) fn sample(&self, x: f64) -> f64 {
        let last = self.keys.len() - 1;
        let x = x.clamp(self.keys[0].0, self.keys[last].0);
        let i = self
            .keys
            .partition_point(|k| k.0 < x)
            .saturating_sub(1)
            .min(last - 1);
        let ((x0, y0), (x1, y1)) = (self.keys[i], self.keys[i + 1]);
        let width = x1 - x0;
        curve::hermite(
            y0,
            self.slopes[i] * width,
            y1,
            self.slopes[i + 1] * width,
            (x - x0) / width,
        )
    }
}

/// Half extents of a finger's cross-section: sideways, to the back and to the palm; mm.
#[derive(Clone, Copy)]
pub(super) struct Section {
    pub(super) half_width: f64,
    pub(super) dorsal: f64,
    pub(super) palmar: f64,
}

/// Effect of sex and age on a hand, in addition to its length and breadth. Directions are common
/// anatomical knowledge (men's fingers are thick and their tendons prominent; children's taper;
/// with age fat leaves the back and joints thicken); amounts are designed.
#[derive(Clone, Copy, Debug)]
pub(super) struct HandBuild {
    /// Thickness of the fingers against the palm's breadth, 1 for the mean adult.
    girth: f64,
    /// Additional width of a finger's root relative to its middle, as a share.
    taper: f64,
    /// Thickening of middle and last joints, as a share.
    knots: f64,
    /// Extensor tendons, 1 for the mean adult.
    pub(super) tendons: f64,
    /// Hollows between the knuckles, likewise.
    pub(super) hollows: f64,
    /// Folds over the joints and creases of the palm, likewise.
    pub(super) creases: f64,
    /// Radius added to the heads of the metacarpals, mm.
    pub(super) heads_mm: f64,
    /// Length of the nails beyond the pulp, mm.
    pub(super) free_edge_mm: f64,
    /// Length of the index finger against the ring finger's, as a share of the mean (the
    /// 2D : 4D ratio is about 0.95 in men and 0.965 in women).
    index: f64,
}

impl HandBuild {
    /// Returns the build of a hand for a sex (0 male to 1 female) and an age in years.
    pub(super) fn from_sex_and_age(sex: f64, age_years: f64) -> Self {
        let child = 1.0 - curve::smooth((age_years - 8.0) / 10.0);
        let old = curve::smooth((age_years - 40.0) / 38.0);
        let man = (1.0 - sex) * (1.0 - child);
        let woman = sex * (1.0 - child);
        Self {
            girth: 1.0 + 0.035 * man - 0.015 * woman + 0.03 * child,
            taper: 0.015 * woman + 0.07 * child,
            knots: 0.02 * man - 0.045 * child + 0.07 * old,
            tendons: 1.25 * man + 0.8 * woman + 0.1 * child + 0.8 * old,
            hollows: 1.05 * man + 0.8 * woman + 0.3 * child + 0.9 * old,
            creases: 1.0 - 0.3 * child + 0.45 * old,
            heads_mm: 0.2 * man - 0.6 * child + 0.5 * old,
            free_edge_mm: 0.8 * man + 1.8 * woman + 0.6 * child,
            index: 1.0 + 0.012 * (sex - 0.5),
        }
    }

    /// Factors of a section's width and height at a joint coordinate.
    fn factors(&self, q: f64) -> (f64, f64) {
        let bell = |x: f64| raconteur_base::ops::exp(-x * x);
        let knots = self.knots * (bell((q - 1.0) / 0.17) + 0.85 * bell((q - 2.0) / 0.15));
        let shaft = self.girth * (1.0 + self.taper * (1.0 - q / 1.5));
        (shaft * (1.0 + knots), shaft * (1.0 + 0.6 * knots))
    }

    fn curve(&self, qs: &[f64], values: &[f64], wide: bool) -> Curve {
        let scaled: Vec<f64> = qs
            .iter()
            .zip(values)
            .map(|(&q, v)| {
                let (width, height) = self.factors(q);
                v * if wide { width } else { height }
            })
            .collect();
        Curve::new(qs, &scaled)
    }
}

/// One finger in the bind pose: joints, local frame and cross-sections.
pub(super) struct Finger {
    /// First joint: the saddle joint of the thumb, the knuckle of the others.
    pub(super) origin: DVec3,
    /// Columns: lateral (radial side), along, palmar.
    pub(super) frame: DMat3,
    /// Lengths of the three bones; the last reaches the soft tip.
    pub(super) lengths: [f64; 3],
    /// Thickness against the index finger.
    pub(super) girth: f64,
    half_width: Curve,
    dorsal: Curve,
    palmar: Curve,
}

impl Finger {
    /// Converts a point to the coordinates of the finger: lateral, along, palmar.
    pub(super) fn local(&self, p: DVec3) -> DVec3 {
        self.frame.transpose() * (p - self.origin)
    }

    /// Converts lateral, along and palmar coordinates of the finger to a point.
    pub(super) fn point(&self, local: DVec3) -> DVec3 {
        self.origin + self.frame * local
    }

    /// Distances of the four joints (the last is the tip) along the finger.
    pub(super) fn joints(&self) -> [f64; 4] {
        let [a, b, c] = self.lengths;
        [0.0, a, a + b, a + b + c]
    }

    /// Converts a distance along the finger to a joint coordinate: 0, 1, 2 at the joints, 3 at the
    /// tip, linear between.
    pub(super) fn joint_coordinate(&self, along: f64) -> f64 {
        let joints = self.joints();
        for k in 0..3 {
            if along < joints[k + 1] || k == 2 {
                return k as f64 + (along - joints[k]) / self.lengths[k];
            }
        }
        3.0
    }

    /// Converts a joint coordinate to the distance along the finger, mm.
    pub(super) fn along(&self, q: f64) -> f64 {
        let k = (q.floor().max(0.0) as usize).min(2);
        self.joints()[k] + (q - k as f64) * self.lengths[k]
    }

    pub(super) fn section(&self, along: f64) -> Section {
        let q = self.joint_coordinate(along);
        Section {
            half_width: self.half_width.sample(q) * self.girth,
            dorsal: self.dorsal.sample(q) * self.girth,
            palmar: self.palmar.sample(q) * self.girth,
        }
    }
}

/// Joints, bones and cross-sections of the mean adult hand; right hand, mm.
pub(super) struct Anatomy {
    /// Sex and age.
    pub(super) look: HandBuild,
    pub(super) fingers: [Finger; FINGER_COUNT],
    /// Carpal end of each metacarpal, index to little finger.
    pub(super) metacarpal_base: [DVec3; 4],
    /// Section of forearm and wrist over y.
    pub(super) forearm_half_width: Curve,
    pub(super) forearm_dorsal: Curve,
    pub(super) forearm_palmar: Curve,
}

/// Keys of a finger's section over the joint coordinate: wide at the middle joint,
/// waisted shafts, palmar pads, flat back.
const FINGER_Q: [f64; 13] = [
    -0.3, 0.0, 0.32, 0.58, 0.82, 1.0, 1.25, 1.55, 1.82, 2.0, 2.2, 2.4, 2.62,
];
const FINGER_WIDTH: [f64; 13] = [
    10.4, 10.4, 9.9, 9.2, 9.2, 9.75, 9.0, 8.45, 8.4, 8.6, 8.35, 8.1, 7.55,
];
const FINGER_DORSAL: [f64; 13] = [
    10.0, 10.4, 8.8, 7.7, 8.2, 9.0, 7.6, 6.8, 6.9, 7.35, 6.5, 6.0, 5.2,
];
const FINGER_PALMAR: [f64; 13] = [
    10.0, 10.0, 10.3, 10.2, 8.8, 8.1, 9.2, 9.0, 7.5, 7.0, 8.2, 8.5, 7.2,
];

const THUMB_Q: [f64; 12] = [
    -0.1, 0.2, 0.6, 0.85, 1.0, 1.2, 1.5, 1.8, 2.0, 2.2, 2.4, 2.64,
];
const THUMB_WIDTH: [f64; 12] = [
    10.0, 10.5, 10.8, 10.6, 10.9, 10.3, 9.7, 10.1, 10.9, 10.9, 10.7, 9.6,
];
const THUMB_DORSAL: [f64; 12] = [9.0, 9.5, 9.3, 9.6, 10.4, 9.0, 8.2, 8.4, 9.2, 7.6, 6.8, 5.8];
const THUMB_PALMAR: [f64; 12] = [
    11.0, 12.0, 12.0, 11.2, 10.8, 10.6, 10.4, 9.2, 8.2, 9.6, 9.9, 8.2,
];

const FOREARM_Y: [f64; 8] = [-95.0, -60.0, -35.0, -16.0, -4.0, 6.0, 16.0, 26.0];
const FOREARM_WIDTH: [f64; 8] = [37.0, 33.5, 30.5, 29.3, 29.0, 28.8, 28.0, 26.0];
const FOREARM_DORSAL: [f64; 8] = [25.0, 22.0, 19.6, 18.6, 17.4, 16.0, 14.5, 13.0];
const FOREARM_PALMAR: [f64; 8] = [25.0, 22.0, 19.6, 18.2, 17.6, 17.0, 15.5, 13.0];

/// Converts a direction from the left hand's zero pose (x distal, y dorsal, z radial) to the frame
/// of the anatomy.
fn from_left_zero(v: DVec3) -> DVec3 {
    DVec3::new(v.z, v.x, -v.y)
}

impl Anatomy {
    /// Creates the anatomy of a hand of mean adult length and breadth.
    pub(super) fn new(look: HandBuild) -> Self {
        let world = BIND_ANGLES.left_world();
        let finger = |i: usize, origin: [f64; 3], lengths: [f64; 3], girth: f64| {
            let q = world[3 * i];
            Finger {
                origin: DVec3::from_array(origin),
                frame: DMat3::from_cols(
                    from_left_zero(q * DVec3::Z),
                    from_left_zero(q * DVec3::X),
                    -from_left_zero(q * DVec3::Y),
                ),
                lengths,
                girth,
                half_width: look.curve(&FINGER_Q, &FINGER_WIDTH, true),
                dorsal: look.curve(&FINGER_Q, &FINGER_DORSAL, false),
                palmar: look.curve(&FINGER_Q, &FINGER_PALMAR, false),
            }
        };
        // The thumb bends about its local y axis, rolled; see `hand_shape`.
        let rolled = world[12]
            * raconteur_base::DQuat::from_rotation_x(raconteur_body::hand_shape::THUMB_ROLL_RAD);
        let along = from_left_zero(rolled * DVec3::X);
        let lateral = -from_left_zero(rolled * DVec3::Y);
        let thumb = Finger {
            origin: DVec3::new(20.5, 10.0, 9.0),
            frame: DMat3::from_cols(lateral, along, lateral.cross(along)),
            lengths: [46.2, 31.6, 28.0],
            girth: 1.0,
            half_width: look.curve(&THUMB_Q, &THUMB_WIDTH, true),
            dorsal: look.curve(&THUMB_Q, &THUMB_DORSAL, false),
            palmar: look.curve(&THUMB_Q, &THUMB_PALMAR, false),
        };
        let [a, b, c] = [39.8, 22.8, 20.6].map(|l| l * look.index);
        Self {
            look,
            fingers: [
                thumb,
                finger(0, [24.5, 86.0, 0.0], [a, b, c], 1.0),
                finger(1, [4.5, 89.0, -2.0], [44.0, 26.5, 21.6], 1.03),
                finger(2, [-14.5, 83.0, -0.5], [40.8, 25.4, 21.3], 0.965),
                finger(3, [-31.0, 74.0, 3.5], [32.7, 18.3, 19.6], 0.85),
            ],
            metacarpal_base: [
                DVec3::new(14.0, 20.0, -1.0),
                DVec3::new(3.0, 20.0, -3.0),
                DVec3::new(-8.0, 23.0, -2.0),
                DVec3::new(-17.0, 20.0, 0.0),
            ],
            forearm_half_width: Curve::new(&FOREARM_Y, &FOREARM_WIDTH),
            forearm_dorsal: Curve::new(&FOREARM_Y, &FOREARM_DORSAL),
            forearm_palmar: Curve::new(&FOREARM_Y, &FOREARM_PALMAR),
        }
    }
}

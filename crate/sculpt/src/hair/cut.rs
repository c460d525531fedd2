//! Cuts of beards: area, length and combing direction.

use raconteur_base::DVec3;
use raconteur_base::curve::lerp;
use serde::{Deserialize, Serialize};

/// Height of the lips' middle on the common head, mm.
pub(super) const LIPS_Y: f64 = -46.0;
/// Half the breadth of the upper lip on the common head (the reference head of hair and beard
/// layouts), mm.
const LIP_HALF: f64 = 33.0;
/// Upper edge of a beard that follows the jaw, by distance from the middle, on the common head, mm: the
/// chin, the jaw, before the ear. Chosen by eye.
const JAW: [[f64; 2]; 7] = [
    [0.0, -67.0],
    [18.0, -68.0],
    [34.0, -66.0],
    [48.0, -57.0],
    [58.0, -44.0],
    [66.0, -30.0],
    [74.0, -16.0],
];

/// Cut of a beard: the areas of the face on which it grows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BeardCut {
    /// Cheeks, chin and upper lip.
    #[default]
    Full,
    /// The upper lip, combed down and aside.
    Moustache,
    /// The upper lip, its ends grown long and turned up.
    Handlebar,
    /// The point of the chin.
    Goatee,
    /// Upper lip and chin, joined at the corners of the mouth.
    Circle,
    /// Along the jaw from ear to ear; the lips are free.
    Curtain,
}

/// Linear step: returns 0 at `from` and before, 1 at `to` and beyond; `from` may be greater than
/// `to`.
pub(super) fn slope(from: f64, to: f64, x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// Interpolates the height of a line of points by distance from the middle, in ascending order.
pub(super) fn height_of(line: &[[f64; 2]; 7], x: f64) -> f64 {
    let next = line.iter().position(|e| e[0] >= x).unwrap_or(6).max(1);
    let ([a, low], [b, high]) = (line[next - 1], line[next]);
    lerp(low, high, ((x - a) / (b - a)).clamp(0.0, 1.0))
}

/// Returns true if a position of the common head (mm) is on the upper lip.
pub(super) fn on_lip(q: DVec3) -> bool {
    q.y > LIPS_Y && q.x.abs() < LIP_HALF
}

/// Returns the density of a moustache of this half width at a position.
fn lip(half: f64, q: DVec3) -> f64 {
    slope(half, half - 7.0, q.x.abs()) * slope(-51.0, -45.0, q.y)
}

/// Returns the density of a chin tuft of this half width, including the growth under the lower lip.
fn chin(half: f64, q: DVec3) -> f64 {
    let x = q.x.abs();
    let tuft = slope(half, half - 8.0, x) * slope(-58.0, -66.0, q.y);
    let patch = slope(8.0, 4.0, x) * slope(-50.0, -54.0, q.y);
    tuft.max(patch)
}

impl BeardCut {
    /// Returns the share of a full beard that grows at a position of the common head (mm).
    pub(super) fn share(self, q: DVec3) -> f64 {
        let x = q.x.abs();
        match self {
            Self::Full => 1.0,
            Self::Moustache => lip(34.0, q),
            Self::Handlebar => lip(31.0, q),
            Self::Goatee => chin(27.0, q),
            Self::Circle => {
                let beside = slope(39.0, 34.0, x) * slope(22.0, 26.0, x) * slope(-36.0, -42.0, q.y);
                lip(36.0, q).max(chin(38.0, q)).max(beside)
            }
            Self::Curtain => slope(-2.0, 5.0, height_of(&JAW, x) - q.y),
        }
    }

    /// Returns the length of hair at a position of the upper lip, metres: longer next to its
    /// middle.
    pub(super) fn lip_m(self, q: DVec3) -> f64 {
        let aside = slope(4.0, 20.0, q.x.abs());
        match self {
            Self::Moustache => 0.0105 + 0.004 * aside,
            Self::Handlebar => 0.0095 + 0.0115 * aside,
            _ => 0.0105 * (0.75 + 0.35 * aside),
        }
    }

    /// Returns the relative root spacing on the upper lip compared with the rest.
    pub(super) fn lip_spacing(self) -> f64 {
        match self {
            Self::Moustache | Self::Handlebar => 0.42,
            _ => 0.6,
        }
    }

    /// Returns the combing direction at a position of the upper lip.
    pub(super) fn lip_combed(self, q: DVec3) -> DVec3 {
        let side = if q.x < 0.0 { -1.0 } else { 1.0 };
        let from_middle = slope(0.0, 9.0, q.x.abs());
        match self {
            Self::Handlebar => DVec3::new(side * from_middle * 2.4, -0.75 + 0.3 * from_middle, 0.0),
            Self::Moustache => DVec3::new(side * from_middle * 1.25, -0.85, 0.0),
            _ => DVec3::new(side * from_middle * 1.1, -0.85, 0.0),
        }
    }

    /// Returns the rise of the tip of a tuft over a straight one at a position, shares of its
    /// length.
    pub(super) fn rise(self, q: DVec3) -> f64 {
        match self {
            Self::Handlebar => 0.75 * slope(10.0, 26.0, q.x.abs()),
            _ => 0.0,
        }
    }

    /// Returns the clearance of tips from the lips, metres.
    pub(super) fn lip_margin(self) -> f64 {
        match self {
            Self::Handlebar => 0.004,
            _ => 0.0055,
        }
    }

    /// Spans of a tuft.
    pub(super) fn spans(self) -> u32 {
        if self == Self::Handlebar { 3 } else { 1 }
    }
}

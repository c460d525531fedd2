//! Hair styles: tables of numbers in the frame of hair, metres and radians.

use raconteur_base::DVec3;

use super::HairStyle;
use super::layers::{BUZZ, COILY, CURLED, FALLING, Layer, SHORT, TIED, TOUSLED};

/// Combing pattern of a style: the preferred directions of the hair.
#[derive(Clone, Copy, Debug)]
pub(super) enum Comb {
    /// Away from a parting to both sides, and from the crown to all.
    Parted,
    /// One direction on top, another at the sides, a third behind.
    Combed {
        /// Direction of the hair on top; x points to the side of the parting.
        top: DVec3,
        side: DVec3,
        back: DVec3,
        /// Amount by which locks stray.
        stray: f64,
    },
    /// Round a whorl at the crown, every lock as it likes.
    Whorl,
    /// Towards a tie point.
    Tied(DVec3),
    /// Hair on end, in coils.
    Coily,
}

/// Rule for the length of a hair by the position of its root.
#[derive(Clone, Copy, Debug)]
pub(super) enum Length {
    /// Cut at a height, with layers up to `layered` above it; longer by `front` at the sides of the
    /// face.
    Hem { hem: f64, layered: f64, front: f64 },
    /// Short: length at the sides, and the additional length on top.
    Short { side: f64, top: f64 },
    /// Up to the tie point.
    ToTie,
}

/// Definition of a hair style: combing, length, waves and layers of cards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub(super) comb: Comb,
    pub(super) length: Length,
    /// Distance of the locks' roots.
    pub(super) locks: f64,
    /// Sideways reach of waves and their length.
    pub(super) wave: [f64; 2],
    /// Amplitude of bends in both directions, and their frequency per metre.
    pub(super) bend: [f64; 2],
    /// Rate at which it reaches its height.
    pub(super) rise: f64,
    /// Distance inside the hairline at which the scalp is fully painted.
    pub(super) solid: f64,
    pub(super) layers: &'static [Layer],
}

const PARTED: Style = Style {
    comb: Comb::Parted,
    length: Length::Hem {
        hem: -0.150,
        layered: 0.035,
        front: 0.012,
    },
    locks: 0.019,
    wave: [0.0078, 0.108],
    bend: [0.10, 14.0],
    rise: 0.032,
    solid: 0.016,
    layers: &FALLING,
};

/// Short combed hair; base of other styles, which set direction and length.
const SHORT_CUT: Style = Style {
    comb: Comb::Whorl,
    length: Length::Short {
        side: 0.025,
        top: 0.027,
    },
    locks: 0.016,
    // No waves.
    wave: [0.0, 1.0],
    bend: [0.22, 55.0],
    rise: 0.012,
    solid: 0.022,
    layers: &SHORT,
};

const TIED_BACK: Style = Style {
    comb: Comb::Tied(TIE),
    length: Length::ToTie,
    locks: 0.022,
    wave: [0.0, 1.0],
    bend: [0.06, 20.0],
    rise: 0.02,
    solid: 0.014,
    layers: &TIED,
};

/// Start of a braid.
pub(super) const NAPE: DVec3 = DVec3::new(0.0, -0.030, -0.094);
/// Tie point of a ponytail and a bun.
pub(super) const TIE: DVec3 = DVec3::new(0.0, 0.030, -0.098);

/// Returns the parameters of a style; `None` for a bald head.
#[expect(clippy::too_many_lines, reason = "a table: one row for each style")]
pub(super) fn style(of: HairStyle) -> Option<Style> {
    Some(match of {
        HairStyle::Bald => return None,
        HairStyle::Bob => PARTED,
        HairStyle::Long => Style {
            length: Length::Hem {
                hem: -0.235,
                layered: 0.05,
                front: 0.0,
            },
            wave: [0.0012, 0.12],
            ..PARTED
        },
        HairStyle::Curly => Style {
            length: Length::Hem {
                hem: -0.125,
                layered: 0.07,
                front: 0.0,
            },
            wave: [0.0105, 0.046],
            bend: [0.22, 24.0],
            layers: &CURLED,
            ..PARTED
        },
        HairStyle::Wavy => Style {
            length: Length::Hem {
                hem: -0.205,
                layered: 0.05,
                front: 0.0,
            },
            wave: [0.0115, 0.072],
            ..PARTED
        },
        HairStyle::Swept => Style {
            comb: Comb::Combed {
                top: DVec3::new(-0.42, 0.0, -1.0),
                side: DVec3::new(0.0, -0.55, -1.0),
                back: DVec3::new(0.0, -1.15, -0.3),
                stray: 0.16,
            },
            ..SHORT_CUT
        },
        HairStyle::Balding => Style {
            comb: Comb::Combed {
                top: DVec3::new(-0.3, -0.3, -0.6),
                side: DVec3::new(0.0, -0.75, -0.9),
                back: DVec3::new(0.0, -1.15, -0.2),
                stray: 0.16,
            },
            length: Length::Short {
                side: 0.017,
                top: 0.010,
            },
            solid: 0.024,
            ..SHORT_CUT
        },
        HairStyle::Crop => Style {
            comb: Comb::Combed {
                top: DVec3::new(-0.75, 0.0, 0.75),
                side: DVec3::new(0.0, -1.0, -0.25),
                back: DVec3::new(0.0, -1.2, -0.3),
                stray: 0.22,
            },
            length: Length::Short {
                side: 0.020,
                top: 0.030,
            },
            locks: 0.015,
            bend: [0.25, 60.0],
            solid: 0.018,
            ..SHORT_CUT
        },
        HairStyle::Tousled => Style {
            length: Length::Short {
                side: 0.030,
                top: 0.034,
            },
            locks: 0.0165,
            bend: [0.35, 34.0],
            rise: 0.014,
            solid: 0.016,
            layers: &TOUSLED,
            ..SHORT_CUT
        },
        HairStyle::Buzz => Style {
            comb: Comb::Combed {
                top: DVec3::new(-0.2, 0.0, 0.8),
                side: DVec3::new(0.0, -1.0, 0.1),
                back: DVec3::new(0.0, -1.0, -0.3),
                stray: 0.3,
            },
            length: Length::Short {
                side: 0.006,
                top: 0.003,
            },
            locks: 0.02,
            bend: [0.3, 90.0],
            rise: 0.004,
            solid: 0.014,
            layers: &BUZZ,
            ..SHORT_CUT
        },
        HairStyle::Bun | HairStyle::Ponytail => TIED_BACK,
        HairStyle::Braid => Style {
            comb: Comb::Tied(NAPE),
            ..TIED_BACK
        },
        HairStyle::Coily => Style {
            comb: Comb::Coily,
            length: Length::Short {
                side: 0.008,
                top: 0.026,
            },
            locks: 0.02,
            bend: [0.0, 1.0],
            rise: 0.0,
            solid: 0.010,
            layers: &COILY,
            ..SHORT_CUT
        },
    })
}

//! The styles: tables of numbers in the frame of hair, metres and radians.

use raconteur_base::DVec3;

use super::HairStyle;

/// Cards of one height over the scalp.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layer {
    /// Distance of the roots.
    pub(super) spacing: f64,
    /// Height over the skin that the hair comes to.
    pub(super) offset: f64,
    /// Width of a card.
    pub(super) width: f64,
    /// The strips of the atlas it uses, the second one excluded: 0–4 dense, 5–9 less so, 10–12
    /// loose, 13–15 single hairs.
    pub(super) strips: [u32; 2],
    /// Spans of a card.
    pub(super) spans: usize,
    /// Angle at which hair leaves the skin.
    pub(super) lift: f64,
    /// Share by which it gathers into its lock.
    pub(super) gather: f64,
    /// Length against the style's.
    pub(super) length: f64,
    /// How much of the length cards lose at random, 0..1.
    pub(super) uneven: f64,
    /// Spread of the turn about their own middle line.
    pub(super) roll: f64,
    /// How far inside the hairline the roots begin.
    pub(super) inside: f64,
    /// How far from the parting they end; 0 where they do not.
    pub(super) parting: f64,
}

/// Which way hair is combed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Comb {
    /// Away from a parting to both sides, and from the crown to all.
    Parted,
    /// One way on top, another at the sides, a third behind.
    Combed {
        /// On top; x is turned to the parting's side.
        top: DVec3,
        side: DVec3,
        back: DVec3,
        /// How far locks stray.
        stray: f64,
    },
    /// Round a whorl at the crown, every lock as it likes.
    Whorl,
    /// To a place where it is tied.
    Tied(DVec3),
    /// On end, in coils.
    Coily,
}

/// How long hair is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Length {
    /// Cut at a height, `layered` by as much above it; longer by `front` beside the face.
    Hem { hem: f64, layered: f64, front: f64 },
    /// Short: at the sides, and how much more on top.
    Short { side: f64, top: f64 },
    /// As far as the place where it is tied.
    ToTie,
}

/// A style.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub(super) comb: Comb,
    pub(super) length: Length,
    /// Distance of the locks' roots.
    pub(super) locks: f64,
    /// Sideways reach of waves and their length.
    pub(super) wave: [f64; 2],
    /// How much hair bends this way and that, and how often a metre.
    pub(super) bend: [f64; 2],
    /// How fast it comes to its height.
    pub(super) rise: f64,
    /// How far inside the line the scalp is painted fully.
    pub(super) solid: f64,
    pub(super) layers: &'static [Layer],
}

const LAYER: Layer = Layer {
    spacing: 0.015,
    offset: 0.004,
    width: 0.024,
    strips: [0, 5],
    spans: 9,
    lift: 0.25,
    gather: 0.25,
    length: 1.0,
    uneven: 0.0,
    roll: 0.06,
    inside: 0.002,
    parting: 0.0,
};

const FALLING: [Layer; 6] = [
    Layer {
        spacing: 0.0185,
        offset: 0.0064,
        width: 0.0257,
        spans: 8,
        lift: 0.14,
        ..LAYER
    },
    Layer {
        spacing: 0.0142,
        offset: 0.0144,
        width: 0.0190,
        strips: [0, 7],
        spans: 15,
        lift: 0.25,
        gather: 0.45,
        roll: 0.10,
        inside: 0.0012,
        ..LAYER
    },
    Layer {
        spacing: 0.0146,
        offset: 0.0208,
        width: 0.0140,
        strips: [3, 10],
        spans: 15,
        lift: 0.33,
        gather: 0.6,
        uneven: 0.5,
        roll: 0.13,
        inside: 0.001,
        ..LAYER
    },
    Layer {
        spacing: 0.0175,
        offset: 0.0248,
        width: 0.0088,
        strips: [6, 13],
        spans: 15,
        lift: 0.38,
        gather: 0.7,
        uneven: 1.0,
        roll: 0.2,
        inside: 0.001,
        ..LAYER
    },
    // Narrow cards cover the rows of roots beside the parting and round the crown.
    Layer {
        spacing: 0.0085,
        offset: 0.0105,
        width: 0.0085,
        strips: [2, 9],
        spans: 7,
        lift: 0.16,
        gather: 0.3,
        length: 0.36,
        roll: 0.08,
        parting: 0.016,
        ..LAYER
    },
    Layer {
        spacing: 0.032,
        offset: 0.024,
        width: 0.0118,
        strips: [13, 16],
        spans: 15,
        lift: 0.44,
        gather: 0.3,
        uneven: 1.4,
        roll: 0.48,
        inside: 0.0007,
        ..LAYER
    },
];

/// Curls need more spans a card, so there are fewer, wider and looser ones.
const fn curled(layer: Layer) -> Layer {
    Layer {
        spacing: 1.32 * layer.spacing,
        offset: 1.45 * layer.offset,
        width: 0.9 * layer.width,
        strips: [layer.strips[0] + 3, layer.strips[1]],
        spans: if layer.spans > 9 { 24 } else { 2 * layer.spans },
        gather: 0.8 * layer.gather,
        ..layer
    }
}

const CURLED: [Layer; 6] = [
    curled(FALLING[0]),
    curled(FALLING[1]),
    curled(FALLING[2]),
    curled(FALLING[3]),
    curled(FALLING[4]),
    curled(FALLING[5]),
];

const SHORT: [Layer; 4] = [
    Layer {
        spacing: 0.00554,
        offset: 0.0018,
        width: 0.0077,
        strips: [3, 10],
        spans: 3,
        lift: 0.22,
        gather: 0.2,
        length: 0.95,
        roll: 0.25,
        inside: 0.001,
        ..LAYER
    },
    Layer {
        spacing: 0.00588,
        offset: 0.0045,
        width: 0.00735,
        strips: [3, 10],
        spans: 4,
        lift: 0.42,
        gather: 0.45,
        roll: 0.25,
        inside: 0.0015,
        ..LAYER
    },
    Layer {
        spacing: 0.01008,
        offset: 0.007,
        width: 0.0056,
        strips: [7, 13],
        spans: 4,
        lift: 0.6,
        gather: 0.6,
        length: 1.08,
        roll: 0.25,
        inside: 0.002,
        ..LAYER
    },
    Layer {
        spacing: 0.01596,
        offset: 0.010,
        width: 0.0056,
        strips: [12, 16],
        spans: 4,
        lift: 0.8,
        gather: 0.2,
        length: 1.2,
        roll: 0.25,
        inside: 0.001,
        ..LAYER
    },
];

const TOUSLED: [Layer; 4] = [
    Layer {
        spacing: 0.0088,
        offset: 0.0030,
        width: 0.01188,
        strips: [0, 5],
        spans: 5,
        lift: 0.35,
        gather: 0.2,
        length: 0.9,
        roll: 0.35,
        inside: 0.001,
        ..LAYER
    },
    Layer {
        spacing: 0.0088,
        offset: 0.0085,
        width: 0.01008,
        strips: [1, 10],
        spans: 6,
        lift: 0.65,
        gather: 0.62,
        roll: 0.35,
        inside: 0.0015,
        ..LAYER
    },
    Layer {
        spacing: 0.00986,
        offset: 0.0130,
        width: 0.00756,
        strips: [5, 12],
        spans: 6,
        lift: 0.85,
        gather: 0.8,
        length: 1.08,
        roll: 0.35,
        inside: 0.002,
        ..LAYER
    },
    Layer {
        spacing: 0.01848,
        offset: 0.017,
        width: 0.00648,
        strips: [12, 16],
        spans: 6,
        lift: 1.0,
        gather: 0.3,
        length: 1.2,
        roll: 0.35,
        inside: 0.001,
        ..LAYER
    },
];

const TIED: [Layer; 4] = [
    Layer {
        spacing: 0.0112,
        offset: 0.0025,
        width: 0.01584,
        spans: 8,
        lift: 0.10,
        gather: 0.1,
        ..LAYER
    },
    Layer {
        spacing: 0.01,
        offset: 0.0055,
        width: 0.01254,
        strips: [0, 9],
        spans: 9,
        lift: 0.16,
        gather: 0.25,
        roll: 0.10,
        inside: 0.001,
        ..LAYER
    },
    Layer {
        spacing: 0.0128,
        offset: 0.0085,
        width: 0.00792,
        strips: [5, 12],
        spans: 9,
        lift: 0.22,
        gather: 0.4,
        roll: 0.16,
        inside: 0.001,
        ..LAYER
    },
    Layer {
        spacing: 0.0208,
        offset: 0.0095,
        width: 0.00528,
        strips: [12, 16],
        spans: 8,
        lift: 0.3,
        gather: 0.1,
        uneven: 0.7,
        roll: 0.3,
        inside: 0.0007,
        ..LAYER
    },
];

const BUZZ: [Layer; 1] = [Layer {
    spacing: 0.00468,
    offset: 0.003,
    width: 0.00638,
    strips: [10, 14],
    spans: 2,
    lift: 0.9,
    gather: 0.0,
    roll: 0.5,
    inside: 0.0005,
    ..LAYER
}];

/// Patches that lie, then tufts that stand: offsets and lengths are shares of the thickness.
const COILY: [Layer; 5] = [
    Layer {
        spacing: 0.0105,
        offset: 0.30,
        width: 0.0165,
        strips: [0, 5],
        spans: 4,
        length: 0.018,
        roll: 0.5,
        inside: 0.007,
        ..LAYER
    },
    Layer {
        spacing: 0.0100,
        offset: 0.62,
        width: 0.0150,
        strips: [0, 10],
        spans: 4,
        length: 0.017,
        roll: 0.5,
        inside: 0.009,
        ..LAYER
    },
    Layer {
        spacing: 0.0066,
        offset: 0.10,
        width: 0.0130,
        strips: [0, 10],
        spans: 3,
        lift: 0.45,
        length: 1.0,
        roll: 1.2,
        inside: 0.0015,
        ..LAYER
    },
    Layer {
        spacing: 0.0105,
        offset: 0.40,
        width: 0.0105,
        strips: [5, 12],
        spans: 3,
        lift: 0.8,
        length: 1.03,
        roll: 1.2,
        inside: 0.004,
        ..LAYER
    },
    Layer {
        spacing: 0.017,
        offset: 0.5,
        width: 0.009,
        strips: [10, 15],
        spans: 3,
        lift: 0.6,
        length: 1.14,
        roll: 1.2,
        inside: 0.004,
        ..LAYER
    },
];

const PARTED: Style = Style {
    comb: Comb::Parted,
    length: Length::Hem {
        hem: -0.150,
        layered: 0.035,
        front: 0.012,
    },
    locks: 0.030,
    wave: [0.0078, 0.108],
    bend: [0.10, 14.0],
    rise: 0.032,
    solid: 0.016,
    layers: &FALLING,
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

/// Where a plait begins.
pub(super) const NAPE: DVec3 = DVec3::new(0.0, -0.030, -0.094);
/// Where a tail and a knot are tied.
pub(super) const TIE: DVec3 = DVec3::new(0.0, 0.030, -0.098);

/// The numbers of a style; `None` for a bald head.
pub(super) fn style(of: HairStyle) -> Option<Style> {
    Some(match of {
        HairStyle::Bald => return None,
        HairStyle::Bob => PARTED,
        HairStyle::Long => Style {
            length: Length::Hem {
                hem: -0.235,
                layered: 0.03,
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
            length: Length::Short {
                side: 0.0195,
                top: 0.027,
            },
            locks: 0.016,
            wave: [0.0, 1.0],
            bend: [0.22, 55.0],
            rise: 0.012,
            solid: 0.022,
            layers: &SHORT,
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
            locks: 0.016,
            wave: [0.0, 1.0],
            bend: [0.22, 55.0],
            rise: 0.012,
            solid: 0.024,
            layers: &SHORT,
        },
        HairStyle::Crop => Style {
            comb: Comb::Combed {
                top: DVec3::new(-0.75, 0.0, 0.75),
                side: DVec3::new(0.0, -1.0, -0.25),
                back: DVec3::new(0.0, -1.2, -0.3),
                stray: 0.22,
            },
            length: Length::Short {
                side: 0.014,
                top: 0.032,
            },
            locks: 0.015,
            wave: [0.0, 1.0],
            bend: [0.25, 60.0],
            rise: 0.012,
            solid: 0.018,
            layers: &SHORT,
        },
        HairStyle::Tousled => Style {
            comb: Comb::Whorl,
            length: Length::Short {
                side: 0.030,
                top: 0.034,
            },
            locks: 0.0165,
            wave: [0.0, 1.0],
            bend: [0.35, 34.0],
            rise: 0.014,
            solid: 0.016,
            layers: &TOUSLED,
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
            wave: [0.0, 1.0],
            bend: [0.3, 90.0],
            rise: 0.004,
            solid: 0.014,
            layers: &BUZZ,
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
            wave: [0.0, 1.0],
            bend: [0.0, 1.0],
            rise: 0.0,
            solid: 0.010,
            layers: &COILY,
        },
    })
}

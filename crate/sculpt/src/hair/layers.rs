//! Card layers of each kind of hair, from the skin outward.

/// Layer of hair cards at one height over the scalp, with their spacing and size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layer {
    /// Distance of the roots.
    pub(super) spacing: f64,
    /// Target height of the hair over the skin.
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
    /// Random reduction of the card length, 0..1.
    pub(super) uneven: f64,
    /// Spread of the turn about their own middle line.
    pub(super) roll: f64,
    /// Distance inside the hairline at which roots start.
    pub(super) inside: f64,
    /// Distance from the parting at which roots end; 0 if they do not.
    pub(super) parting: f64,
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

pub(super) const FALLING: [Layer; 6] = [
    Layer {
        spacing: 0.0185,
        offset: 0.0064,
        width: 0.0257,
        spans: 8,
        lift: 0.14,
        gather: 0.1,
        uneven: 0.2,
        ..LAYER
    },
    Layer {
        spacing: 0.0146,
        offset: 0.0144,
        width: 0.0190,
        strips: [0, 7],
        spans: 15,
        lift: 0.25,
        gather: 0.3,
        uneven: 0.45,
        roll: 0.10,
        inside: 0.0012,
        ..LAYER
    },
    Layer {
        spacing: 0.0151,
        offset: 0.0208,
        width: 0.0140,
        strips: [3, 10],
        spans: 15,
        lift: 0.33,
        gather: 0.5,
        uneven: 0.5,
        roll: 0.13,
        inside: 0.001,
        ..LAYER
    },
    Layer {
        spacing: 0.0188,
        offset: 0.0222,
        width: 0.0088,
        strips: [6, 13],
        spans: 15,
        lift: 0.33,
        gather: 0.62,
        uneven: 1.0,
        roll: 0.2,
        inside: 0.001,
        ..LAYER
    },
    // Narrow cards cover the rows of roots next to the parting and around the crown.
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
        offset: 0.0185,
        width: 0.0118,
        strips: [13, 16],
        spans: 15,
        lift: 0.32,
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

pub(super) const CURLED: [Layer; 6] = [
    curled(FALLING[0]),
    curled(FALLING[1]),
    curled(FALLING[2]),
    curled(FALLING[3]),
    curled(FALLING[4]),
    curled(FALLING[5]),
];

pub(super) const SHORT: [Layer; 4] = [
    Layer {
        spacing: 0.0060,
        offset: 0.0018,
        width: 0.0080,
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
        spacing: 0.00615,
        offset: 0.0045,
        width: 0.0075,
        strips: [3, 10],
        spans: 4,
        lift: 0.42,
        gather: 0.45,
        roll: 0.25,
        inside: 0.0015,
        ..LAYER
    },
    Layer {
        spacing: 0.0105,
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
        spacing: 0.0166,
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

pub(super) const TOUSLED: [Layer; 4] = [
    Layer {
        spacing: 0.0088,
        offset: 0.0038,
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
        offset: 0.0090,
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

pub(super) const TIED: [Layer; 4] = [
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

pub(super) const BUZZ: [Layer; 1] = [Layer {
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

/// Layers of coily hair: flat patches, then standing tufts. Offsets and lengths are shares of the
/// thickness.
pub(super) const COILY: [Layer; 5] = [
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
        spacing: 0.0052,
        offset: 0.10,
        width: 0.0072,
        strips: [3, 12],
        spans: 4,
        lift: 0.45,
        length: 1.0,
        roll: 1.2,
        inside: 0.0015,
        ..LAYER
    },
    Layer {
        spacing: 0.0066,
        offset: 0.40,
        width: 0.0062,
        strips: [5, 12],
        spans: 4,
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

//! Short hair: buzz, crop, a boy's tousle, and hair swept back.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, ops};

use super::cut::{Cut, LAYER, Layer, Locks, Weave, Where, slope};
use super::{HairParams, HairStyle};

const fn layer(cards: usize, spans: usize, height: f64, width: f64, open: [f64; 2]) -> Layer {
    Layer {
        cards,
        spans,
        height,
        width,
        open,
        ..LAYER
    }
}

const fn fine(cards: usize, width: f64, longest: f64) -> Layer {
    Layer {
        cards,
        spans: 3,
        height: 0.002,
        width,
        open: [0.75, 0.95],
        length: 0.7,
        longest,
        roots: Where::Hairline,
        weave: Weave::Loose,
    }
}

const SWEPT: [Layer; 5] = [
    layer(110, 3, 0.0025, 0.022, [0.7, 0.75]),
    layer(170, 4, 0.0055, 0.018, [0.75, 0.9]),
    Layer {
        weave: Weave::Loose,
        ..layer(160, 4, 0.0085, 0.015, [0.85, 1.0])
    },
    Layer {
        weave: Weave::Wisp,
        ..layer(40, 4, 0.0105, 0.007, [0.9, 1.0])
    },
    fine(120, 0.008, 0.032),
];

const TOUSLED: [Layer; 5] = [
    layer(120, 4, 0.0040, 0.021, [0.62, 0.72]),
    layer(200, 5, 0.0085, 0.018, [0.70, 0.88]),
    layer(190, 5, 0.0125, 0.016, [0.78, 1.0]),
    Layer {
        weave: Weave::Loose,
        ..layer(90, 5, 0.0160, 0.012, [0.85, 1.0])
    },
    fine(110, 0.008, 0.026),
];

const CROP: [Layer; 4] = [
    layer(150, 3, 0.0025, 0.015, [0.45, 0.6]),
    layer(240, 4, 0.0050, 0.013, [0.6, 0.85]),
    Layer {
        weave: Weave::Loose,
        ..layer(120, 4, 0.0080, 0.011, [0.75, 1.0])
    },
    fine(120, 0.007, 0.018),
];

const BUZZ: [Layer; 2] = [
    Layer {
        weave: Weave::Loose,
        ..layer(420, 2, 0.0080, 0.012, [0.7, 0.95])
    },
    fine(100, 0.006, 0.006),
];

/// Hair that ends before it hangs.
pub(super) struct Short {
    style: HairStyle,
    parting_x: f64,
    wave: f64,
}

impl Short {
    pub(super) fn new(p: &HairParams) -> Self {
        Self {
            style: p.style,
            parting_x: p.parting_x,
            wave: p.wave,
        }
    }

    /// Combed straight back, and down at the sides and behind.
    fn back(at: DVec3) -> DVec3 {
        let side = if at.x < 0.0 { -1.0 } else { 1.0 };
        let sideburn = slope(0.034, 0.022, at.y) * slope(-0.012, -0.004, at.z);
        let rear = slope(-0.03, -0.06, at.z);
        let high = slope(0.05, 0.09, at.y);
        let d = DVec3::new(0.15 * side, lerp(-0.5, 0.12, high), -1.0);
        let d = d.lerp(DVec3::new(0.1 * side, -1.2, -0.55), rear);
        d.lerp(DVec3::new(0.0, -1.0, 0.06), sideburn)
    }

    /// Radiating from the whorl with a turn, forward over the brow.
    fn whorl(at: DVec3) -> DVec3 {
        let from = at - DVec3::new(0.012, 0.112, -0.056);
        let radial = from.try_normalize().unwrap_or(DVec3::Z);
        let turn = DVec3::Y.cross(radial) * (0.5 * ops::exp(-from.length() / 0.05));
        let sideburn = slope(0.034, 0.022, at.y) * slope(-0.012, -0.004, at.z);
        // The fringe is combed to one side.
        let fringe = slope(0.02, 0.07, at.z) * slope(0.06, 0.085, at.y);
        let d = radial + turn + DVec3::new(-0.55, 0.0, 0.15) * fringe;
        let sides = slope(0.045, 0.07, at.x.abs()) * slope(0.09, 0.05, at.y);
        (d + DVec3::new(0.0, -0.5, -0.25) * sides).lerp(DVec3::NEG_Y, sideburn)
    }
}

impl Cut for Short {
    fn layers(&self) -> &[Layer] {
        match self.style {
            HairStyle::Swept => &SWEPT,
            HairStyle::Tousled => &TOUSLED,
            HairStyle::Buzz => &BUZZ,
            _ => &CROP,
        }
    }

    fn locks(&self) -> Locks {
        let (count, gather, unruly) = match self.style {
            HairStyle::Swept => (70, 0.35, 0.22),
            HairStyle::Tousled => (90, 0.42, 0.50),
            HairStyle::Buzz => (40, 0.0, 0.2),
            _ => (90, 0.35, 0.28),
        };
        Locks {
            count,
            gather,
            unruly,
        }
    }

    fn parting(&self, _at: DVec3) -> f64 {
        0.0
    }

    fn comb(&self, at: DVec3) -> DVec3 {
        match self.style {
            HairStyle::Swept => Self::back(at),
            HairStyle::Tousled => Self::whorl(at),
            _ => {
                // To the side of the parting, forward in front.
                let side = if at.x < self.parting_x { -1.0 } else { 1.0 };
                let top = slope(0.07, 0.10, at.y) * slope(-0.03, 0.03, at.z);
                Self::whorl(at).lerp(DVec3::new(0.8 * side, 0.1, 0.15), 0.6 * top)
            }
        }
    }

    fn lift(&self, at: DVec3) -> f64 {
        let top = slope(0.05, 0.10, at.y);
        let front = slope(0.03, 0.075, at.z) * top;
        match self.style {
            HairStyle::Swept => 0.24 + 0.20 * top + 0.35 * front,
            HairStyle::Tousled => {
                let whorl = at.distance(DVec3::new(0.012, 0.112, -0.056)) / 0.024;
                0.22 + 0.35 * top + 0.55 * ops::exp(-whorl * whorl)
            }
            HairStyle::Buzz => 0.95,
            _ => 0.85,
        }
    }

    fn bend(&self, at: DVec3, root: DVec3, t: f64) -> DVec3 {
        let down = DVec3::NEG_Y * (0.10 + 0.22 * t);
        match self.style {
            HairStyle::Swept => {
                let behind = slope(-0.05, -0.08, at.z);
                // Over the ear to behind it.
                let ear = slope(0.055, 0.040, at.y)
                    * slope(0.005, -0.004, at.z)
                    * slope(-0.04, -0.03, at.z);
                down + DVec3::new(0.0, 0.25 * ear, -0.12 - 0.5 * ear)
                    + DVec3::NEG_Y * (0.25 * behind)
            }
            HairStyle::Tousled => {
                let fringe = slope(0.03, 0.07, root.z) * slope(0.06, 0.08, root.y);
                down * (1.0 + 0.9 * fringe) + DVec3::new(-0.10 * fringe, 0.0, 0.0)
            }
            _ => down,
        }
    }

    fn length(&self, root: DVec3) -> f64 {
        let by_height = |low: f64, ear: f64, high: f64| {
            lerp(low, ear, slope(-0.045, 0.03, root.y)) + (high - ear) * slope(0.03, 0.10, root.y)
        };
        let sideburn = slope(0.03, 0.015, root.y) * slope(-0.014, -0.004, root.z);
        let full = match self.style {
            HairStyle::Swept => by_height(0.022, 0.036, 0.070),
            HairStyle::Tousled => {
                let fringe = slope(0.045, 0.075, root.z);
                by_height(0.022, 0.042, 0.074) * (1.0 - 0.1 * fringe)
            }
            HairStyle::Buzz => 0.008,
            _ => by_height(0.012, 0.018, 0.036),
        };
        full * (1.0 - 0.55 * sideburn)
    }

    fn hem(&self, root: DVec3, at: DVec3) -> Option<f64> {
        // A fringe ends over the brows.
        let lock = 0.10 * root.x
            + 0.007 * ops::sin(root.x * 210.0 + 1.0)
            + 0.006 * ops::sin(root.x * 520.0 + root.y * 390.0);
        (at.z > 0.05).then_some(0.053 + lock)
    }

    fn volume(&self, at: DVec3) -> f64 {
        let top = slope(0.05, 0.10, at.y);
        lerp(0.6, 1.15, top) * lerp(0.7, 1.0, slope(-0.045, 0.0, at.y))
    }

    fn cling(&self, _at: DVec3) -> f64 {
        match self.style {
            HairStyle::Tousled => 0.28,
            HairStyle::Buzz => 0.0,
            HairStyle::Swept => 0.28,
            _ => 0.15,
        }
    }

    fn wave(&self) -> f64 {
        self.wave
    }
}

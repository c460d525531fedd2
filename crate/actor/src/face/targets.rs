//! Conversion from face controls to morph target weights.
//!
//! Figures without tissue have targets with ARKit names, modelled or composed when the figure was
//! made. This module maps muscles to these targets. Most of the map is linear, a sparse table; the
//! lips over an open jaw are not.

use raconteur_body::face::{ARKIT, FaceControls, Jaw, MUSCLES, Muscle};
use raconteur_body::figure::{JAW_OPEN_RAD, MOUTH_CLOSE_RAD};

use MorphTarget as T;
use Muscle as M;

/// Distance of the lips in front of the jaw's hinge, metres: a downward slide opens them like a
/// turn by the slide divided by this distance. Designed.
const LIPS_M: f64 = 0.09;

/// A morph target, or the pair of its left and right halves.
#[allow(
    dead_code,
    reason = "the table of muscles alone names some, by their names"
)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum MorphTarget {
    JawOpen,
    JawForward,
    /// Sideways shift of the jaw, to the left and to the right.
    Jaw,
    Blink,
    LookUp,
    LookDown,
    LookIn,
    LookOut,
    Wide,
    Squint,
    CheekSquint,
    CheekPuff,
    Sneer,
    BrowDown,
    BrowInner,
    BrowOuter,
    Close,
    Funnel,
    Pucker,
    /// Sideways shift of the mouth, to the left and to the right.
    Mouth,
    Smile,
    Frown,
    Dimple,
    Stretch,
    RollLower,
    RollUpper,
    ShrugLower,
    ShrugUpper,
    Press,
    LowerDown,
    UpperUp,
    TongueUp,
    TongueOut,
}

impl MorphTarget {
    pub(super) const COUNT: usize = Self::TongueOut as usize + 1;

    /// Targets that represent a joint of the face: they must not be written where the joint itself
    /// carries skin.
    pub(super) const OF_JAW: [Self; 3] = [T::JawOpen, T::JawForward, T::Jaw];
    pub(super) const OF_LIDS: [Self; 1] = [T::Blink];
    pub(super) const OF_EYES: [Self; 4] = [T::LookUp, T::LookDown, T::LookIn, T::LookOut];
    /// Targets that move parts other than skin.
    pub(super) const OF_TONGUE: [Self; 2] = [T::TongueUp, T::TongueOut];
}

/// ARKit's names without `Left` and `Right`, in the order of [`MorphTarget`]; the tongue's first
/// is our own.
pub(super) const NAMES: [&str; T::COUNT] = [
    "jawOpen",
    "jawForward",
    "jaw",
    "eyeBlink",
    "eyeLookUp",
    "eyeLookDown",
    "eyeLookIn",
    "eyeLookOut",
    "eyeWide",
    "eyeSquint",
    "cheekSquint",
    "cheekPuff",
    "noseSneer",
    "browDown",
    "browInnerUp",
    "browOuterUp",
    "mouthClose",
    "mouthFunnel",
    "mouthPucker",
    "mouth",
    "mouthSmile",
    "mouthFrown",
    "mouthDimple",
    "mouthStretch",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthShrugUpper",
    "mouthPress",
    "mouthLowerDown",
    "mouthUpperUp",
    "tongueUp",
    "tongueOut",
];

/// Returns the index of a target by ARKit's name. Evaluated by the compiler, which rejects unknown
/// names.
const fn place(name: &str) -> usize {
    let mut k = 0;
    while k < NAMES.len() {
        if is_same(NAMES[k].as_bytes(), name.as_bytes()) {
            return k;
        }
        k += 1;
    }
    panic!("the table of muscles names a target that there is not")
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    let mut k = 0;
    while k < a.len() && k < b.len() && a[k] == b[k] {
        k += 1;
    }
    k == a.len() && k == b.len()
}

/// Weight of a target of its side for a fully contracted muscle (of a pair the left one), percent,
/// from the table of muscles ([`ARKIT`]). Nasalis and depressor septi have none: no target moves
/// the nostrils alone. The frontal belly's target is common to both sides and takes their mean.
static TABLE: [(Muscle, usize, u8); ARKIT.len()] = {
    let mut table = [(ARKIT[0].0, 0, 0); ARKIT.len()];
    let mut k = 0;
    while k < table.len() {
        let (muscle, target, percent) = ARKIT[k];
        table[k] = (muscle, place(target), percent);
        k += 1;
    }
    table
};

/// Weights of all morph targets, left and right; equal for a target in the middle.
pub(super) type Weights = [[f64; 2]; T::COUNT];

/// Returns the weights driven by muscles, jaw and tongue. [`FaceRig`](super::FaceRig) handles
/// blinking lids and turning eyes. Values of `controls` are in their ranges.
pub(super) fn of_controls(controls: &FaceControls) -> Weights {
    let mut weights = linear(&controls.contraction);
    let w = &mut weights;
    let mean = |pair: [f64; 2]| 0.5 * (pair[0] + pair[1]);
    let round = mean(controls.protrusion.map(|p| p.max(0.0)));
    let back = controls.protrusion.map(|p| (-p).max(0.0));
    let ring = mean(
        [M::OrbicularisOrisUpper, M::OrbicularisOrisLower].map(|m| controls.contraction[m.index()]),
    );
    let (seal, bite) = (controls.seal, controls.bite);

    let Jaw {
        pitch_rad,
        yaw_rad,
        forward_m,
        down_m,
    } = controls.jaw;
    let open_rad = pitch_rad + down_m / LIPS_M;
    w[T::JawOpen as usize] = [open_rad / JAW_OPEN_RAD; 2];
    w[T::JawForward as usize] = [forward_m / Jaw::RANGES[2][1]; 2];
    let aside = yaw_rad / Jaw::RANGES[1][1];
    w[T::Jaw as usize] = [aside, -aside];

    // The jaw separates the lips; the orbicularis oris retains part of their contact.
    let kept = (1.0 - seal) * (1.0 - 0.35 * ring) * (1.0 - 0.3 * round);
    w[T::Close as usize] = [(1.0 - kept) * open_rad / MOUTH_CLOSE_RAD; 2];
    // Lips that are pushed forward make a funnel when open and a kiss when not.
    let opening = (kept * open_rad / MOUTH_CLOSE_RAD).min(1.0);
    let puff = mean([0, 1].map(|i| controls.contraction[M::BuccinatorLeft.index() + i]));
    for (target, keep, more) in [
        (T::Pucker, 1.0, 1.15 * round * (1.0 - 0.4 * opening)),
        (T::Funnel, 0.0, 0.9 * round * opening),
        (T::RollUpper, 1.0 - round, 0.6 * back[0] + 0.1 * seal),
        (
            T::RollLower,
            1.0 - round,
            0.6 * back[1] + 0.12 * seal + 0.75 * bite,
        ),
        (T::Press, 1.0 - round, 0.35 * seal),
        (T::ShrugLower, 1.0 - bite, 0.0),
        (T::UpperUp, 1.0, 0.25 * bite),
        // Rounded lips cannot smile.
        (T::Smile, 1.0 - 0.75 * round, 0.0),
        // Cheeks puff against sealed lips; otherwise they draw in the corners of the mouth.
        (T::CheekPuff, 0.0, seal * puff),
        (T::Dimple, 1.0 - seal, 0.0),
    ] {
        w[target as usize] = w[target as usize].map(|weight| weight * keep + more);
    }
    // Targets that separate the lips yield to closures.
    for (target, most) in [
        (T::UpperUp, 1.0 - seal),
        (T::Sneer, 1.0 - seal),
        (T::LowerDown, 1.0 - seal.max(bite)),
    ] {
        w[target as usize] = w[target as usize].map(|weight| weight.min(most));
    }
    let [left, right] = w[T::Mouth as usize];
    w[T::Mouth as usize] = [left - right, right - left];

    for (i, lid) in controls.lower_lid.into_iter().enumerate() {
        w[T::Squint as usize][i] += 0.7 * lid;
    }
    w[T::TongueUp as usize] = [controls.tongue_tip; 2];
    w[T::TongueOut as usize] = [controls.tongue_out * (1.0 - seal); 2];
    weights
}

/// Returns the linear part of the target weights: the sum over muscle contractions (0 to 1) by the
/// table.
fn linear(contraction: &[f64; MUSCLES]) -> Weights {
    let mut weights = [[0.0; 2]; T::COUNT];
    for &(muscle, target, percent) in &TABLE {
        for (side, weight) in weights[target].iter_mut().enumerate() {
            let own = muscle.index() + muscle.side().map_or(0, |_| side);
            *weight += 0.01 * f64::from(percent) * contraction[own];
        }
    }
    weights
}

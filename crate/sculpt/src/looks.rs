//! Appearance of a face apart from its shape, as numbers: skin, lips, irises, brows. Texture
//! examples are generated from them, and they can be applied to a figure again.

use raconteur_base::{noise, ops};

use crate::FigureParams;
use crate::model::Traits;
use crate::skin::SkinParams;

/// Number of values in a [`Look`].
pub const COUNT: usize = 17;

/// Names of a look's numbers, in order. All but the age are shares, 0 to 1 unless said otherwise.
pub const NAMES: [&str; COUNT] = [
    "melanin",
    "blood",
    "contrast of the skin",
    "age of the skin",
    "freckles",
    "moles",
    "sun",
    "vessels",
    "beard shadow",
    "redness of the lips",
    "line of the lashes",
    "lightness of the iris",
    "blue of the iris",
    "lightness of the brows",
    "redness of the brows",
    "density of the brows",
    "height of the brows",
];

/// Names of the colours derived from a look: logarithms of linear red, green and blue.
pub const COLOURS: [&str; 6] = [
    "red part of the iris",
    "green part of the iris",
    "blue part of the iris",
    "red part of the brows",
    "green part of the brows",
    "blue part of the brows",
];

/// Appearance of a face apart from its shape: numbers in the order of [`NAMES`].
pub type Look = [f64; COUNT];

const MELANIN: usize = 0;
const BLOOD: usize = 1;
const CONTRAST: usize = 2;
const AGE: usize = 3;
const FRECKLES: usize = 4;
const MOLES: usize = 5;
const SUN: usize = 6;
const VESSELS: usize = 7;
const BEARD: usize = 8;
const LIPS: usize = 9;
const LASHES: usize = 10;
const IRIS_LIGHT: usize = 11;
const IRIS_BLUE: usize = 12;
const BROW_LIGHT: usize = 13;
const BROW_RED: usize = 14;
const BROW_DENSITY: usize = 15;
const BROW_HEIGHT: usize = 16;

/// Unit of [`AGE`], years: all numbers vary by about as much.
const AGE_UNIT_YEARS: f64 = 128.0;
/// Unit of [`MOLES`].
const MAX_MOLES: f64 = 24.0;

/// Darkest and lightest melanin of mostly European, Asian and African skin: mean and deviation.
/// Designed after the spread of the individual typology angle (Chardon et al. 1991,
/// doi:10.1111/j.1467-2494.1991.tb00561.x), in shares of the model's range.
const ANCESTRIES: [[f64; 2]; 3] = [[0.17, 0.06], [0.27, 0.06], [0.82, 0.10]];

/// Returns the look of example number `index` of a crowd: traits that depend on sex, age and
/// ancestry follow them, the rest is independent. The same seed gives the same look.
#[must_use]
pub fn random(traits: &Traits, seed: u64, index: u64) -> Look {
    // The sum of three, scaled to the deviation 1: a bell without far ends.
    let bell = |k: i64| -> f64 {
        (0..3)
            .map(|j| noise::signed(seed ^ 0x10_0c, index, 3 * k + j))
            .sum()
    };
    let around = |k: usize, mean: f64, deviation: f64| mean + deviation * bell(k as i64);
    let a = traits.ancestry;
    let whole = a.european + a.asian + a.african;
    let shares = [a.european, a.asian, a.african].map(|s| s / whole);
    let mixed = |column: usize| -> f64 { (0..3).map(|i| shares[i] * ANCESTRIES[i][column]).sum() };
    let melanin = around(MELANIN, mixed(0), mixed(1));
    let [years, sex] = [traits.age_years, traits.sex];
    let grown = ((years - 13.0) / 6.0).clamp(0.0, 1.0);
    let old = ((years - 35.0) / 40.0).clamp(0.0, 1.0);
    let european = shares[0];
    let mut look = [0.0; COUNT];
    look[MELANIN] = melanin;
    look[BLOOD] = around(BLOOD, 0.5, 0.12);
    look[CONTRAST] = around(CONTRAST, 1.0, 0.2);
    look[AGE] = (years + 6.0 * bell(AGE as i64)) / AGE_UNIT_YEARS;
    look[FRECKLES] = around(FRECKLES, 0.12 + 0.12 * european, 0.2);
    look[MOLES] = around(MOLES, 0.25, 0.15);
    look[SUN] = around(SUN, 0.1 + 0.45 * old, 0.15);
    look[VESSELS] = around(VESSELS, 0.05 + 0.35 * old * european, 0.12);
    look[BEARD] = around(
        BEARD,
        0.55 * (1.0 - sex) * grown,
        0.05 + 0.2 * (1.0 - sex) * grown,
    );
    look[LIPS] = around(LIPS, 0.40 + 0.12 * sex * grown, 0.14);
    look[LASHES] = around(LASHES, 0.28 + 0.3 * sex * grown, 0.12);
    look[IRIS_LIGHT] = around(IRIS_LIGHT, 0.12 + 0.45 * european, 0.1 + 0.16 * european);
    look[IRIS_BLUE] = around(IRIS_BLUE, 0.1 + 0.5 * european, 0.08 + 0.26 * european);
    look[BROW_LIGHT] = around(
        BROW_LIGHT,
        0.12 + 0.3 * european + 0.2 * old,
        0.06 + 0.1 * european,
    );
    look[BROW_RED] = around(BROW_RED, 0.2 + 0.25 * european - 0.2 * old, 0.12);
    look[BROW_DENSITY] = around(BROW_DENSITY, 1.0 + 0.1 * (1.0 - sex), 0.2);
    look[BROW_HEIGHT] = around(BROW_HEIGHT, 1.05 - 0.12 * sex, 0.16);
    look
}

fn between(x: f64, low: f64, high: f64) -> f64 {
    x.clamp(low, high)
}

fn mix(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

/// Returns the linear RGB of the iris: from dark brown to light, and from amber to blue where it is
/// light.
#[must_use]
pub fn iris(look: &Look) -> [f64; 3] {
    let light = between(look[IRIS_LIGHT], 0.0, 1.0);
    let blue = between(look[IRIS_BLUE], 0.0, 1.0);
    let dark = [0.055, 0.030, 0.016];
    let bright = mix([0.30, 0.20, 0.085], [0.17, 0.27, 0.40], blue);
    mix(dark, bright, ops::pow(light, 1.3))
}

/// The darkest brows, linear RGB.
const DARK_BROW: [f64; 3] = [0.014, 0.011, 0.009];

/// Returns the linear RGB of the lightest brow, from blond (`red` 0) to red (1).
fn bright_brow(red: f64) -> [f64; 3] {
    mix([0.52, 0.46, 0.38], [0.50, 0.22, 0.09], red)
}

/// Returns the linear RGB of the brows, from black to light blond, with a variable share of brown
/// or red.
#[must_use]
pub fn brows(look: &Look) -> [f64; 3] {
    let light = between(look[BROW_LIGHT], 0.0, 1.0);
    let red = between(look[BROW_RED], 0.0, 1.0);
    mix(DARK_BROW, bright_brow(red), ops::pow(light, 1.6))
}

/// Returns the numbers of a look, then the natural logarithms of its [`COLOURS`].
#[must_use]
pub fn numbers(look: &Look) -> Vec<f64> {
    let colours = iris(look).into_iter().chain(brows(look));
    let logarithms = colours.map(ops::ln);
    look.iter().copied().chain(logarithms).collect()
}

/// Returns the skin of a look; parameters not in a look come from `like`.
#[must_use]
pub fn skin(look: &Look, like: &SkinParams) -> SkinParams {
    let share = |i: usize| between(look[i], 0.0, 1.0);
    SkinParams {
        melanin: share(MELANIN),
        blood: share(BLOOD),
        contrast: between(look[CONTRAST], 0.2, 2.0),
        age_years: between(AGE_UNIT_YEARS * look[AGE], 1.0, 95.0),
        freckles: between(look[FRECKLES], 0.0, 1.6),
        moles: (MAX_MOLES * share(MOLES)).round() as u32,
        sun: share(SUN),
        vessels: share(VESSELS),
        beard: share(BEARD),
        lips: share(LIPS),
        lash_line: share(LASHES),
        ..*like
    }
}

/// Returns the look of a figure: the inverse of [`dress`] where its colours are those of looks.
#[must_use]
pub fn look_of(figure: &FigureParams) -> Look {
    let skin = &figure.skin;
    let luma = |c: [f64; 3]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    let share = |x: f64, dark: f64, bright: f64| between((x - dark) / (bright - dark), 0.0, 1.0);
    let (eye, brow) = (figure.head.iris, figure.head.brow.colour);
    let mut look = [0.0; COUNT];
    look[MELANIN] = skin.melanin;
    look[BLOOD] = skin.blood;
    look[CONTRAST] = skin.contrast;
    look[AGE] = skin.age_years / AGE_UNIT_YEARS;
    look[FRECKLES] = skin.freckles;
    look[MOLES] = f64::from(skin.moles) / MAX_MOLES;
    look[SUN] = skin.sun;
    look[VESSELS] = skin.vessels;
    look[BEARD] = skin.beard;
    look[LIPS] = skin.lips;
    look[LASHES] = skin.lash_line;
    look[IRIS_LIGHT] = ops::pow(share(luma(eye), 0.034, 0.24), 1.0 / 1.3);
    look[IRIS_BLUE] = share(eye[2] / eye[0].max(1e-3), 0.3, 2.3);
    look[BROW_RED] = share(brow[0] / brow[1].max(1e-3), 1.13, 2.3);
    let lightest = luma(bright_brow(look[BROW_RED]));
    look[BROW_LIGHT] = ops::pow(share(luma(brow), luma(DARK_BROW), lightest), 1.0 / 1.6);
    look[BROW_DENSITY] = figure.head.brow.density;
    look[BROW_HEIGHT] = figure.head.brow.height;
    look
}

/// Returns the figure with its skin, irises and brows changed to a look.
#[must_use]
pub fn dress(figure: FigureParams, look: &Look) -> FigureParams {
    let mut figure = figure;
    figure.skin = skin(look, &figure.skin);
    figure.head.iris = iris(look);
    figure.head.brow.colour = brows(look);
    figure.head.brow.density = between(look[BROW_DENSITY], 0.3, 1.6);
    figure.head.brow.height = between(look[BROW_HEIGHT], 0.6, 1.5);
    figure
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::people::preset;

    #[test]
    fn a_figure_dressed_in_its_own_look_keeps_its_skin() {
        for name in ["sofia", "kenji", "amara", "papous"] {
            let own = preset(name).expect("a figure");
            let again = dress(own.clone(), &look_of(&own));
            assert_eq!(again.skin, own.skin, "{name}");
            let off =
                |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
            assert!(
                off(again.head.iris, own.head.iris) < 0.06,
                "{name}: {:?}",
                again.head.iris
            );
            assert!(
                off(again.head.brow.colour, own.head.brow.colour) < 0.06,
                "{name}: {:?}",
                again.head.brow.colour
            );
        }
    }
}

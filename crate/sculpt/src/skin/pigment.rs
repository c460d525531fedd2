//! Skin colour from its pigments: melanin in the epidermis, blood in the dermis.
//!
//! Two layers after Jacques: a filter of melanin, passed twice, over a semi-infinite dermis whose
//! diffuse reflectance follows from scattering and absorption. Optical properties: Jacques 2013,
//! "Optical properties of biological tissues: a review", doi:10.1088/0031-9155/58/11/R37 (melanin,
//! blood, scattering of skin; *paper*). Layering and ranges: Jacques 1998, "Skin optics", Oregon
//! Medical Laser Center; close to Krishnaswamy and Baranoski 2004,
//! doi:10.1111/j.1467-8659.2004.00764.x, and Donner and Jensen 2006,
//! doi:10.2312/EGWR/EGSR06/409-417. Integrated over the visible spectrum under D65 with the
//! matching functions of Wyman, Sloan and Shirley 2013 (JCGT 2(2)).

use raconteur_base::ops;

/// Pigment composition of a piece of skin, from which [`colour`] computes its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pigments {
    /// Volume fraction of melanosomes in the epidermis; 0.013–0.06 light, 0.11–0.16
    /// moderate, 0.18–0.43 dark (Jacques 1998; *paper*).
    pub melanosomes: f64,
    /// Volume fraction of blood in the dermis; 0.002 at rest, up to 0.07 flushed (Jacques
    /// 2013; *paper*).
    pub blood: f64,
    /// Share of oxygenated haemoglobin, 0..1.
    pub oxygen: f64,
}

/// Wavelengths, nm: first and step.
const FIRST_NM: f64 = 400.0;
const STEP_NM: f64 = 10.0;

/// Molar extinction of oxygenated and deoxygenated haemoglobin, cm⁻¹/(mol/l), 400–700 nm
/// (Prahl's tabulation of Gratzer and Kollias, Oregon Medical Laser Center; *measured*),
/// and CIE standard illuminant D65 (relative; *measured*).
#[rustfmt::skip]
const SPECTRA: [[f64; 3]; 31] = [
    [266_232.0, 223_296.0, 82.75], [466_840.0, 303_956.0, 91.49],
    [480_360.0, 407_560.0, 93.43], [246_072.0, 528_600.0, 86.68],
    [102_580.0, 413_280.0, 104.86], [62_816.0, 103_292.0, 117.01],
    [44_480.0, 23_388.8, 117.81], [33_209.2, 16_156.4, 114.86],
    [26_629.2, 14_550.0, 115.92], [23_684.4, 16_684.0, 108.81],
    [20_932.8, 20_862.0, 109.35], [20_035.2, 25_773.6, 107.80],
    [24_202.4, 31_589.6, 104.79], [39_956.8, 39_036.4, 107.69],
    [53_236.0, 46_592.0, 104.41], [43_016.0, 53_412.0, 104.05],
    [32_613.2, 53_788.0, 100.00], [44_496.0, 45_072.0, 96.33],
    [50_104.0, 37_020.0, 95.79], [14_400.8, 28_324.4, 88.69],
    [3_200.0, 14_677.2, 90.01], [1_506.0, 9_443.6, 89.60],
    [942.0, 6_509.6, 87.70], [610.0, 5_148.8, 83.29],
    [442.0, 4_345.2, 83.70], [368.0, 3_750.1, 80.03],
    [319.6, 3_226.6, 80.21], [294.0, 2_795.1, 82.28],
    [277.6, 2_407.9, 78.28], [276.0, 2_052.0, 69.72],
    [290.0, 1_794.3, 71.61],
];

/// Haemoglobin in whole blood over its molar mass, mol/l (150 g/l; Jacques 2013).
const HAEMOGLOBIN_MOL_PER_L: f64 = 150.0 / 64_500.0;
/// Thickness of the epidermis that a ray crosses twice, cm (Jacques 1998; *paper*).
const EPIDERMIS_CM: f64 = 0.006;
/// Reduced scattering of melanosomes at 500 nm, cm⁻¹, falling with the wavelength squared.
/// *Designed*, so that the darkest skin matches its measured reflectance (see the tests); without
/// it no blue would be reflected, and dark skin would be orange.
const MELANOSOME_SCATTERING: f64 = 57.0;

/// Returns the diffuse reflectance in a band of the spectrum, 0..1. `band` is the index into the
/// spectra.
fn reflectance_in(band: usize, skin: &Pigments) -> f64 {
    let nm = FIRST_NM + STEP_NM * band as f64;
    let [oxygenated, deoxygenated, _] = SPECTRA[band];
    // Absorption, cm⁻¹.
    let base = 0.244 + 85.3 * ops::exp(-(nm - 154.0) / 66.2);
    let melanosome = 6.6e11 * ops::pow(nm, -3.33);
    let molar = skin.oxygen * oxygenated + (1.0 - skin.oxygen) * deoxygenated;
    let blood = core::f64::consts::LN_10 * HAEMOGLOBIN_MOL_PER_L * molar;
    let epidermis = skin.melanosomes * melanosome + (1.0 - skin.melanosomes) * base;
    let dermis = skin.blood * blood + (1.0 - skin.blood) * base;
    // Reduced scattering of skin, cm⁻¹: a Rayleigh and a Mie part. The review's data sets
    // run from 30 to 69 at 500 nm with a mean of 46; the upper part fits faces.
    let nominal = nm / 500.0;
    let scattering = 60.0 * (0.409 * ops::pow(nominal, -4.0) + 0.591 * ops::pow(nominal, -0.702));
    let ratio = scattering / dermis;
    // Monte Carlo fit for a semi-infinite medium (Jacques 1999, Oregon Medical Laser Center).
    let path = 6.3744 + 0.35688 * ops::exp(ops::ln(ratio) / 3.4739);
    let below = ops::exp(-path / (3.0 * (1.0 + ratio)).sqrt());
    let passed = below * ops::exp(-2.0 * epidermis * EPIDERMIS_CM);
    // Light scattered back once within the epidermis.
    let back = skin.melanosomes * MELANOSOME_SCATTERING / (nominal * nominal);
    let lost = epidermis + back;
    passed + back / (2.0 * lost) * (1.0 - ops::exp(-2.0 * lost * EPIDERMIS_CM))
}

/// Returns the CIE 1931 colour-matching functions at a wavelength in nm (Wyman, Sloan and Shirley
/// 2013, multi-lobe fit).
fn matching(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, centre: f64, low: f64, high: f64| {
        let t = (nm - centre) * if nm < centre { low } else { high };
        height * ops::exp(-0.5 * t * t)
    };
    [
        lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323)
            - lobe(0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    ]
}

/// XYZ to linear sRGB (IEC 61966-2-1).
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.2406, -1.5372, -0.4986],
    [-0.9689, 1.8758, 0.0415],
    [0.0557, -0.2040, 1.0570],
];

fn rgb_of(reflectance: impl Fn(usize) -> f64) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for (band, row) in SPECTRA.iter().enumerate() {
        let light = row[2] * reflectance(band);
        let m = matching(FIRST_NM + STEP_NM * band as f64);
        for (sum, x) in xyz.iter_mut().zip(m) {
            *sum += light * x;
        }
    }
    RGB_FROM_XYZ.map(|row| row.iter().zip(xyz).map(|(a, b)| a * b).sum())
}

/// Returns the linear RGB of skin under white light, each 0..1.
#[must_use]
pub fn colour(skin: &Pigments) -> [f64; 3] {
    let white = rgb_of(|_| 1.0);
    let own = rgb_of(|band| reflectance_in(band, skin));
    core::array::from_fn(|i| (own[i] / white[i]).clamp(0.0, 1.0))
}

/// Points of the table along melanin and blood, spaced evenly in the logarithm.
const MELANIN_STEPS: usize = 40;
const BLOOD_STEPS: usize = 40;
const MELANIN_RANGE: [f64; 2] = [0.004, 0.6];
const BLOOD_RANGE: [f64; 2] = [0.0006, 0.2];
/// Number of oxygen saturation steps in the table. Red rises steeply towards full saturation in
/// skin rich in blood (deoxygenated haemoglobin absorbs ten times as much at 650 nm), so two would
/// not suffice.
const OXYGEN_STEPS: usize = 8;
const OXYGEN_RANGE: [f64; 2] = [0.3, 1.0];

/// Lookup table of skin colours by melanin, blood and oxygen, the values of [`colour`]; fast enough
/// for a million texels.
#[derive(Clone, Debug)]
pub struct Palette {
    table: Vec<[f32; 3]>,
    melanin_log: [f64; 2],
    blood_log: [f64; 2],
}

impl Palette {
    /// Computes the entries of the table.
    #[must_use]
    pub fn new() -> Self {
        let logs = |r: [f64; 2]| r.map(ops::ln);
        let (melanin_log, blood_log) = (logs(MELANIN_RANGE), logs(BLOOD_RANGE));
        let at = |r: [f64; 2], i: usize, n: usize| {
            ops::exp(r[0] + (r[1] - r[0]) * i as f64 / (n - 1) as f64)
        };
        let mut table = Vec::with_capacity(OXYGEN_STEPS * MELANIN_STEPS * BLOOD_STEPS);
        for o in 0..OXYGEN_STEPS {
            let [from, to] = OXYGEN_RANGE;
            let oxygen = from + (to - from) * o as f64 / (OXYGEN_STEPS - 1) as f64;
            for m in 0..MELANIN_STEPS {
                for b in 0..BLOOD_STEPS {
                    let rgb = colour(&Pigments {
                        melanosomes: at(melanin_log, m, MELANIN_STEPS),
                        blood: at(blood_log, b, BLOOD_STEPS),
                        oxygen,
                    });
                    table.push(rgb.map(|x| x as f32));
                }
            }
        }
        Self {
            table,
            melanin_log,
            blood_log,
        }
    }

    /// Returns linear RGB; `ln_melanosomes` and `ln_blood` are natural logarithms of the fractions,
    /// clamped to the table's range.
    #[must_use]
    pub fn sample(&self, ln_melanosomes: f64, ln_blood: f64, oxygen: f64) -> [f64; 3] {
        let cell = |r: [f64; 2], x: f64, n: usize| {
            let t = ((x - r[0]) / (r[1] - r[0])).clamp(0.0, 1.0) * (n - 1) as f64;
            let i = (t as usize).min(n - 2);
            (i, t - i as f64)
        };
        let (m, fm) = cell(self.melanin_log, ln_melanosomes, MELANIN_STEPS);
        let (b, fb) = cell(self.blood_log, ln_blood, BLOOD_STEPS);
        let (o, fo) = cell(OXYGEN_RANGE, oxygen, OXYGEN_STEPS);
        let mut rgb = [0.0; 3];
        for (d, wo) in [(0, 1.0 - fo), (1, fo)] {
            for (dm, wm) in [(0, 1.0 - fm), (1, fm)] {
                for (db, wb) in [(0, 1.0 - fb), (1, fb)] {
                    let row =
                        &self.table[((o + d) * MELANIN_STEPS + m + dm) * BLOOD_STEPS + b + db];
                    let w = wo * wm * wb;
                    for (x, t) in rgb.iter_mut().zip(row) {
                        *x += w * f64::from(*t);
                    }
                }
            }
        }
        rgb
    }
}

impl Default for Palette {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn skin(melanosomes: f64, blood: f64) -> Pigments {
        Pigments {
            melanosomes,
            blood,
            oxygen: 0.75,
        }
    }

    #[test]
    fn more_melanin_is_darker_in_every_channel_and_relatively_redder() {
        for blood in [0.002, 0.006, 0.02] {
            let mut last = colour(&skin(0.01, blood));
            for i in 1..20 {
                let now = colour(&skin(0.01 * ops::pow(1.2, f64::from(i)), blood));
                assert!(
                    (0..3).all(|c| now[c] < last[c]),
                    "more melanin darkens every channel"
                );
                assert!(
                    now[0] / now[1] > last[0] / last[1],
                    "more melanin increases red relative to green"
                );
                // The reflection of the darkest skin is greyer again.
                assert!(
                    i > 14 || now[1] / now[2] > last[1] / last[2],
                    "more melanin increases green relative to blue"
                );
                last = now;
            }
        }
    }

    #[test]
    fn more_blood_is_redder_and_less_oxygen_bluer() {
        for melanin in [0.01, 0.05, 0.15] {
            let mut last = colour(&skin(melanin, 0.001));
            for i in 1..20 {
                let now = colour(&skin(melanin, 0.001 * ops::pow(1.25, f64::from(i))));
                assert!(
                    now[0] / now[1] > last[0] / last[1],
                    "more blood increases red relative to green"
                );
                assert!(now[1] < last[1], "more blood darkens green");
                last = now;
            }
            let pale = |oxygen| {
                colour(&Pigments {
                    oxygen,
                    ..skin(melanin, 0.02)
                })
            };
            let (full, spent) = (pale(0.95), pale(0.4));
            assert!(
                spent[0] < full[0] && spent[0] / spent[2] < full[0] / full[2],
                "less oxygen makes the skin bluer"
            );
        }
    }

    #[test]
    fn reflectance_is_where_spectrophotometers_find_it() {
        // Light European cheek or forehead: about 0.25 at 450 nm, 0.35 at 550, 0.6 at 650;
        // very dark skin: about 0.05, 0.06, 0.15 (Angelopoulou 2001,
        // "Understanding the color of human skin", Proc. SPIE 4299; read from plots, within a
        // third).
        let at = |nm: usize, s: &Pigments| reflectance_in((nm - 400) / 10, s);
        let (light, dark) = (skin(0.02, 0.006), skin(0.43, 0.006));
        for (nm, of_light, of_dark) in [(450, 0.25, 0.05), (550, 0.35, 0.06), (650, 0.6, 0.15)] {
            for (who, measured) in [(&light, of_light), (&dark, of_dark)] {
                let r = at(nm, who);
                assert!((r / measured - 1.0).abs() < 0.34, "{nm} nm: {r}");
            }
        }
    }

    #[test]
    fn a_blush_has_a_closed_form() {
        // The shader of the skin computes with it: `flushed` of the renderer's skin.wgsl.
        let closed = |x: f64| [0.15, 0.65, 0.62].map(|k| ops::exp(-k * (ops::exp(x / 2.0) - 1.0)));
        // Faster blood contains more oxygen.
        for (x, oxygen) in [(-1.2, 0.70), (-0.4, 0.72), (0.5, 0.80), (1.15, 0.86)] {
            for melanosomes in [0.02, 0.06, 0.2] {
                let rest = colour(&skin(melanosomes, 0.011));
                let now = colour(&Pigments {
                    oxygen,
                    ..skin(melanosomes, 0.011 * ops::exp(x))
                });
                for (c, share) in closed(x).into_iter().enumerate() {
                    let error = now[c] - rest[c] * share;
                    // Light scattered back by melanosomes has not passed the blood, so the
                    // deviation on dark skin is below visibility.
                    let most = (0.03 * rest[c] * share).max(0.0125);
                    assert!(error.abs() < most, "{x} {melanosomes} {c}: {error}");
                }
            }
        }
    }

    #[test]
    fn the_table_agrees_with_the_model() {
        let palette = Palette::new();
        for m in [0.012, 0.033, 0.11] {
            for b in [0.0015, 0.007, 0.045] {
                let (table, model) = (
                    palette.sample(ops::ln(m), ops::ln(b), 0.75),
                    colour(&skin(m, b)),
                );
                for c in 0..3 {
                    assert!((table[c] - model[c]).abs() < 0.006, "{table:?} {model:?}");
                }
            }
        }
    }
}

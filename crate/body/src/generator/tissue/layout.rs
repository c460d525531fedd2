//! Where the mimic muscles lie on the reference head: grids of a few points, carried over to
//! each figure by its landmarks and fitted between skull and skin there (F&H section 3.1.2,
//! "Building Muscles").
//!
//! Origins and insertions after Prometheus (Schünke, Schulte and Schumacher), as told in F&H
//! section 3.1.1 and table 3.1; places on the mean head (millimetres, left half; origin
//! between the tragions, x left, y up, z front) are chosen by eye against its named points.

use crate::face::Muscle;

use Muscle as M;

/// A muscle of the left side, or of the middle: each fibre from its origin over points
/// between to where it ends in the skin.
pub(super) struct Strand {
    pub(super) muscle: Muscle,
    /// Fibres; each a few places on or over the skin, which are put under it.
    pub(super) fibres: &'static [&'static [[f64; 3]]],
    /// How far from a fibre the skin still follows in full, and where it follows no more, mm.
    pub(super) reach: [f64; 2],
    /// How much of the fibre's movement the skin over it takes.
    pub(super) pull: f64,
    /// Whether its ends are grown into the ring of the mouth: middle of the place along it,
    /// as [`crate::generator::head::LipPlace::position`] counts, half its width there, and how
    /// much of its movement the ring takes.
    pub(super) ring: Option<[f64; 3]>,
}

/// Linear muscles.
#[rustfmt::skip]
pub(super) const STRANDS: &[Strand] = &[
    Strand { muscle: M::FrontalisMedialLeft, reach: [7.0, 17.0], pull: 0.95, ring: None, fibres: &[
        &[[7.0, 78.0, 87.0], [8.0, 64.0, 92.0], [8.5, 52.0, 96.0], [9.0, 41.0, 97.0]],
        &[[18.0, 77.0, 85.0], [19.0, 64.0, 90.0], [19.5, 54.0, 95.0], [19.0, 43.0, 96.5]],
    ] },
    Strand { muscle: M::FrontalisLateralLeft, reach: [7.0, 17.0], pull: 0.95, ring: None, fibres: &[
        &[[34.0, 76.0, 79.0], [35.0, 64.0, 84.0], [35.5, 54.0, 88.0], [34.0, 44.0, 91.0]],
        &[[47.0, 74.0, 70.0], [48.0, 63.0, 75.0], [48.5, 53.0, 79.0], [47.0, 43.0, 83.5]],
    ] },
    Strand { muscle: M::CorrugatorLeft, reach: [4.5, 12.0], pull: 0.9, ring: None, fibres: &[
        &[[4.0, 33.0, 95.5], [11.0, 37.5, 96.5], [20.0, 43.5, 96.0], [29.0, 46.0, 93.0]],
        &[[4.0, 37.0, 96.5], [12.0, 42.0, 97.0], [22.0, 48.0, 95.5], [31.0, 50.0, 92.0]],
    ] },
    Strand { muscle: M::DepressorSuperciliiLeft, reach: [4.5, 12.0], pull: 0.85, ring: None, fibres: &[
        &[[9.0, 23.0, 91.0], [11.5, 31.0, 93.5], [15.0, 42.0, 96.8], [18.0, 48.0, 96.5]],
    ] },
    Strand { muscle: M::Procerus, reach: [5.0, 12.0], pull: 0.9, ring: None, fibres: &[
        &[[0.0, 10.0, 107.0], [0.0, 20.0, 98.5], [0.0, 31.0, 96.0], [0.0, 43.0, 97.8]],
    ] },
    Strand { muscle: M::NasalisLeft, reach: [3.0, 8.0], pull: 0.8, ring: None, fibres: &[
        &[[28.0, -30.0, 91.5], [24.0, -26.0, 93.0], [20.8, -22.6, 96.0], [18.6, -19.4, 101.2]],
    ] },
    Strand { muscle: M::DepressorSepti, reach: [4.0, 10.0], pull: 0.8, ring: None, fibres: &[
        &[[0.0, -33.0, 105.0], [0.0, -27.0, 105.5], [0.0, -22.0, 112.0], [0.0, -16.0, 118.0]],
    ] },
    Strand { muscle: M::LevatorLabiiAlaequeLeft, reach: [3.5, 10.0], pull: 0.85, ring: None, fibres: &[
        &[[9.0, 14.0, 95.0], [12.0, 3.0, 98.0], [15.0, -7.0, 98.5], [17.5, -17.0, 101.0]],
    ] },
    Strand { muscle: M::LevatorLabiiAlaequeLeft, reach: [3.5, 9.0], pull: 0.8, ring: Some([4.0, 7.0, 0.8]), fibres: &[
        &[[11.0, 12.0, 92.5], [16.0, -3.0, 93.5], [19.5, -19.0, 94.5], [15.0, -36.0, 103.5]],
    ] },
    Strand { muscle: M::LevatorLabiiLeft, reach: [4.5, 12.0], pull: 0.8, ring: Some([5.0, 9.0, 0.8]), fibres: &[
        &[[26.0, -3.0, 87.5], [23.5, -14.0, 92.0], [21.0, -26.0, 94.0], [16.0, -38.0, 102.5]],
        &[[35.0, -3.0, 85.5], [30.0, -15.0, 90.0], [25.5, -28.0, 93.0], [20.0, -40.0, 99.5]],
    ] },
    Strand { muscle: M::ZygomaticusMinorLeft, reach: [4.5, 12.0], pull: 0.8, ring: Some([8.0, 6.0, 0.8]), fibres: &[
        &[[48.0, -5.0, 81.0], [40.0, -17.0, 87.0], [31.0, -29.0, 91.5], [23.0, -41.0, 98.0]],
    ] },
    Strand { muscle: M::ZygomaticusMajorLeft, reach: [6.0, 16.0], pull: 0.8, ring: Some([12.0, 7.5, 0.8]), fibres: &[
        &[[58.0, -4.0, 72.0], [49.0, -18.0, 82.0], [39.0, -32.0, 88.0], [27.5, -46.5, 92.5]],
        &[[61.0, -9.0, 69.0], [52.0, -23.0, 79.0], [41.0, -37.0, 86.0], [28.0, -49.0, 91.5]],
    ] },
    Strand { muscle: M::LevatorAnguliLeft, reach: [4.0, 11.0], pull: 0.75, ring: Some([11.0, 6.5, 0.75]), fibres: &[
        &[[28.0, -14.0, 90.5], [28.5, -25.0, 91.5], [28.5, -36.0, 92.0], [27.0, -47.0, 92.0]],
    ] },
    Strand { muscle: M::RisoriusLeft, reach: [5.0, 14.0], pull: 0.8, ring: Some([12.0, 7.5, 0.8]), fibres: &[
        &[[60.0, -45.0, 58.0], [50.0, -47.5, 71.0], [39.0, -48.5, 84.5], [27.5, -48.7, 91.0]],
        &[[58.0, -52.0, 58.0], [48.5, -53.0, 71.0], [38.0, -52.0, 84.0], [27.5, -50.5, 91.0]],
    ] },
    Strand { muscle: M::BuccinatorLeft, reach: [8.0, 20.0], pull: 0.6, ring: Some([12.0, 3.5, 0.6]), fibres: &[
        &[[62.0, -36.0, 56.0], [52.0, -40.0, 70.0], [40.0, -44.0, 84.0], [28.0, -48.0, 91.0]],
    ] },
    Strand { muscle: M::DepressorAnguliLeft, reach: [5.0, 13.0], pull: 0.8, ring: Some([13.0, 6.5, 0.8]), fibres: &[
        &[[36.0, -77.0, 74.0], [34.0, -68.0, 83.0], [31.5, -59.0, 89.0], [28.0, -50.0, 91.5]],
        &[[28.0, -80.0, 84.0], [28.5, -70.0, 89.5], [29.0, -60.0, 91.0], [27.5, -51.0, 92.0]],
    ] },
    Strand { muscle: M::DepressorLabiiLeft, reach: [5.0, 12.0], pull: 0.85, ring: Some([19.0, 9.0, 0.85]), fibres: &[
        &[[24.0, -80.0, 89.0], [20.0, -73.0, 94.5], [16.5, -65.0, 96.5], [12.0, -57.5, 101.0]],
        &[[14.0, -82.0, 97.5], [12.5, -75.0, 99.0], [10.0, -67.0, 98.5], [7.0, -58.5, 102.5]],
    ] },
    Strand { muscle: M::MentalisLeft, reach: [6.0, 15.0], pull: 0.7, ring: Some([22.0, 10.0, 0.3]), fibres: &[
        &[[5.0, -65.5, 98.5], [5.5, -70.0, 99.0], [6.5, -76.0, 101.0], [8.0, -83.0, 100.5]],
    ] },
    Strand { muscle: M::PlatysmaLeft, reach: [9.0, 20.0], pull: 0.7, ring: Some([14.0, 6.0, 0.4]), fibres: &[
        &[[34.0, -104.0, 38.0], [37.0, -88.0, 62.0], [38.5, -74.0, 75.0], [34.0, -58.0, 87.0]],
        &[[18.0, -98.0, 50.0], [22.0, -91.0, 68.0], [27.0, -80.0, 84.0], [28.0, -64.0, 90.5]],
    ] },
];

/// The ring about the eye: muscle, reach of the skin over it, and how much it takes.
pub(super) const AROUND_EYE: ([f64; 2], f64) = ([5.0, 12.0], 0.9);
/// Places of the ring on the left half of the mean head, from the inner corner over the brow,
/// and where it draws to: the medial palpebral ligament.
pub(super) const EYE_RING: [[f64; 3]; 13] = [
    [12.0, 19.0, 88.0],
    [12.5, 31.0, 92.5],
    [20.0, 40.0, 95.0],
    [30.5, 42.0, 92.0],
    [42.0, 42.0, 86.5],
    [53.0, 38.0, 78.0],
    [59.0, 29.0, 70.0],
    [60.0, 19.0, 67.0],
    [57.0, 7.0, 71.5],
    [47.0, -1.0, 81.0],
    [34.0, -3.0, 86.0],
    [22.0, -1.0, 90.0],
    [13.0, 8.0, 91.0],
];
pub(super) const EYE_CENTRE: [f64; 3] = [27.0, 20.0, 82.0];

/// Where skin shows its blood: places of the mean head (left half), how far around, mm, and
/// how much. Cheeks first, then nose, chin and forehead (by eye).
pub(super) const FLUSH: [([f64; 3], f64, f64); 6] = [
    ([44.0, -16.0, 84.0], 17.0, 1.0),
    ([28.0, -12.0, 91.0], 13.0, 0.7),
    ([0.0, -10.0, 119.0], 13.0, 0.6),
    ([0.0, -80.0, 101.0], 16.0, 0.35),
    ([18.0, 58.0, 94.0], 26.0, 0.25),
    ([0.0, -45.0, 106.0], 14.0, 0.35),
];

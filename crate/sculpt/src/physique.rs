//! Heights, lengths, breadths and girths of a body, compared with surveys.
//!
//! As in anthropometry, heights and lengths are taken between bones palpable through the skin, and
//! girths with a tape that bridges hollows: on the figure's own bones, on its neck, and on the body
//! under its clothes. The arm first hangs from the shoulder, because the figure's rest pose holds
//! it away.
//!
//! Adults: ANSUR II (Gordon et al. 2014; 4082 men, 1986 women of the US Army, mean age 30). Means
//! of each sex are the survey's. Deviations are those within a sex, derived from the deviation of
//! both sexes together (published for all 6068) with the same coefficient of variation in both.
//! Girths of trunk and legs: Heinz, Peterson, Johnson and Kerk 2003,
//! doi:10.1080/10691898.2003.11910711 (247 men, 260 women, young and active), because soldiers are
//! heavy for their stature. Loss of height with age: 3 cm for men and 5 cm for women from 30 to 70
//! (Sorkin, Muller and Andres 1999, Am. J. Epidemiol. 150), all of it above the legs; thickening of
//! the neck: slope over the age of ANSUR II's subjects; of the trunk: designed. At nine: stature is
//! the median of the CDC's growth charts of 2000; the other shares are designed, in the order of
//! size of Snyder et al. 1977 (UM-HSRI-77-17), not read again.

use std::collections::BTreeMap;

use raconteur_base::{DVec2, DVec3, ops};

use super::bones;
use super::built::AnnotatedFigure;
use super::measure::{Reading, landmark_mm};
use super::people::FigureParams;
use super::person::Person;
use super::statistics::{Row, Source};
use super::torso::{Field, Joints, Regions};
use raconteur_body::skeleton::Bone;

/// A body that can be measured, bind pose, metres.
struct Physique<'a> {
    params: &'a FigureParams,
    built: &'a AnnotatedFigure,
    /// Points of the left half's and the middle's bones by name.
    bones: BTreeMap<String, Vec<DVec3>>,
    field: Field,
}

/// Function that takes a measure, metres; `None` if the figure lacks the required data.
type Measurer = fn(&Physique<'_>) -> Option<f64>;

struct Definition {
    name: &'static str,
    landmarks: &'static str,
    row: Row,
    take: Measurer,
}

#[expect(
    clippy::too_many_arguments,
    reason = "a table: one argument for each of its columns"
)]
const fn define(
    name: &'static str,
    landmarks: &'static str,
    adult: [[f64; 2]; 2],
    at_nine: [f64; 2],
    per_year: [f64; 2],
    source: Source,
    take: Measurer,
) -> Definition {
    let [mean, sd] = adult;
    Definition {
        name,
        landmarks,
        row: Row::new(mean, sd, at_nine, per_year, source),
        take,
    }
}

/// Height loss of the body above the legs, millimetres per year after thirty.
const SHRINKING: [f64; 2] = [-0.75, -1.25];
const STEADY: [f64; 2] = [0.0, 0.0];

/// All measures of the body: means of men and women and their standard deviations in millimetres,
/// share at the age of nine, change per year.
#[rustfmt::skip]
#[allow(
    clippy::redundant_closure_for_method_calls,
    reason = "a method of a type with a lifetime is not general enough for the pointer"
)]
const DEFINITIONS: [Definition; 20] = [
    define("stature", "v-floor", [[1756.2, 1628.5], [68.8, 63.8]], [0.76, 0.818], SHRINKING, Source::Ansur,
        |b| b.landmark("v").map(|p| p.y)),
    define("cervicale_height", "c7-floor", [[1517.3, 1395.7], [63.7, 58.6]], [0.742, 0.803], SHRINKING, Source::Ansur,
        |b| b.farthest("cervical7", DVec3::NEG_Z).map(|p| p.y)),
    define("suprasternale_height", "ss-floor", [[1437.0, 1333.0], [63.3, 58.7]], [0.742, 0.803], SHRINKING, Source::Ansur,
        |b| b.farthest("sternum", DVec3::Y).map(|p| p.y)),
    define("acromial_height", "acr-floor", [[1440.7, 1335.1], [63.1, 58.5]], [0.742, 0.803], SHRINKING, Source::Ansur,
        |b| b.acromion().map(|p| p.y)),
    define("radiale_height", "rad-floor", [[1105.5, 1023.8], [48.4, 44.9]], [0.742, 0.80], SHRINKING, Source::Ansur,
        |b| Some(b.acromion()?.y - b.upper_arm()?)),
    define("wrist_height", "sty-floor", [[848.7, 791.7], [40.3, 37.6]], [0.735, 0.79], SHRINKING, Source::Ansur,
        |b| Some(b.acromion()?.y - b.upper_arm()? - b.forearm()?)),
    define("trochanterion_height", "tro-floor", [[900.9, 845.4], [48.7, 45.7]], [0.749, 0.798], STEADY, Source::Ansur,
        |b| b.outermost("l_femur").map(|p| p.y)),
    define("crotch_height", "crotch-floor", [[846.5, 781.1], [46.5, 42.9]], [0.73, 0.79], STEADY, Source::Ansur,
        |b| b.crotch()),
    define("knee_height", "patella-floor", [[488.4, 449.0], [28.1, 25.9]], [0.746, 0.808], STEADY, Source::Ansur,
        |b| b.middle("l_patella").map(|p| p.y)),
    define("biacromial_breadth", "acr_l-acr_r", [[415.7, 365.3], [19.6, 17.2]], [0.70, 0.79], STEADY, Source::Ansur,
        |b| b.acromion().map(|p| 2.0 * p.x)),
    define("hip_breadth", "widest hips", [[345.7, 353.8], [24.8, 25.4]], [0.69, 0.70], STEADY, Source::Ansur,
        |b| Some(b.widest(0.47..0.56))),
    define("upper_arm_length", "acr-rad", [[335.2, 311.3], [17.8, 16.5]], [0.746, 0.80], STEADY, Source::Ansur,
        |b| b.upper_arm()),
    define("forearm_length", "rad-sty", [[267.9, 241.3], [15.8, 14.3]], [0.735, 0.81], STEADY, Source::Ansur,
        |b| b.forearm()),
    define("foot_length", "pte-acp", [[271.2, 246.2], [13.2, 12.0]], [0.78, 0.85], STEADY, Source::Ansur,
        |b| b.foot()),
    define("neck_girth", "below larynx", [[397.65, 329.8], [25.2, 20.9]], [0.705, 0.83], [0.268, 0.197], Source::Ansur,
        |b| b.neck_girth()),
    define("chest_girth", "round the ribs", [[1009.9, 860.6], [72.1, 60.3]], [0.645, 0.755], [0.3, 0.3], Source::Heinz,
        |b| Some(b.chest_girth())),
    define("waist_girth", "narrowest waist", [[845.3, 698.0], [87.8, 75.9]], [0.70, 0.83], [1.5, 1.5], Source::Heinz,
        |b| Some(b.least_girth(0.57..0.645))),
    define("hip_girth", "widest seat", [[977.6, 956.5], [62.3, 69.4]], [0.716, 0.735], STEADY, Source::Heinz,
        |b| Some(b.largest_girth(0.47..0.56))),
    define("thigh_girth", "below the seat", [[565.0, 572.0], [42.5, 46.4]], [0.70, 0.69], [-0.3, -0.3], Source::Heinz,
        |b| Some(b.leg_girth(0.30..0.31))),
    define("calf_girth", "widest calf", [[372.1, 350.1], [26.5, 26.1]], [0.715, 0.77], [-0.3, -0.3], Source::Heinz,
        |b| Some(b.leg_girth(1.2..1.5))),
];

/// Soft tissue behind the heel and before the toes together, metres (designed).
const FOOT_PADS_M: f64 = 0.014;

impl Physique<'_> {
    fn landmark(&self, name: &str) -> Option<DVec3> {
        landmark_mm(&self.built.figure, &self.built.annotations, name).map(|p| p * 1e-3)
    }

    fn joint(&self, bone: Bone) -> DVec3 {
        self.built.figure.inverse_bind[bone.index()]
            .inverse()
            .translation
    }

    fn farthest(&self, bone: &str, way: DVec3) -> Option<DVec3> {
        let points = self.bones.get(bone)?.iter().copied();
        points.max_by(|a, b| a.dot(way).total_cmp(&b.dot(way)))
    }

    fn middle(&self, bone: &str) -> Option<DVec3> {
        let points = self.bones.get(bone)?;
        Some(points.iter().sum::<DVec3>() / points.len() as f64)
    }

    /// Returns the upper edge of the outermost centimetre of a bone; `None` for an unknown bone.
    fn outermost(&self, bone: &str) -> Option<DVec3> {
        let edge = self.farthest(bone, DVec3::X)?.x;
        let near = self.bones.get(bone)?.iter().filter(|p| p.x > edge - 0.01);
        let top = near.map(|p| p.y).fold(f64::MIN, f64::max);
        Some(DVec3::new(edge, top, 0.0))
    }

    fn acromion(&self) -> Option<DVec3> {
        self.outermost("l_scapula")
    }

    /// Returns the ends of the radius (bone), at the elbow and at the wrist, along the forearm.
    fn radius(&self) -> Option<[DVec3; 2]> {
        let way = (self.joint(Bone::LWrist) - self.joint(Bone::LElbow)).normalize();
        Some([
            self.farthest("l_radius", -way)?,
            self.farthest("l_radius", way)?,
        ])
    }

    /// Returns the length from the acromion down to the radius of the hanging arm, metres.
    fn upper_arm(&self) -> Option<f64> {
        let shoulder = self.joint(Bone::LShoulder);
        let [elbow, _] = self.radius()?;
        let along = (self.joint(Bone::LElbow) - shoulder).normalize();
        Some(self.acromion()?.y - shoulder.y + (elbow - shoulder).dot(along))
    }

    fn forearm(&self) -> Option<f64> {
        let [elbow, wrist] = self.radius()?;
        let along = (self.joint(Bone::LWrist) - self.joint(Bone::LElbow)).normalize();
        Some((wrist - elbow).dot(along))
    }

    fn foot(&self) -> Option<f64> {
        let heel = self.farthest("l_calcaneus", DVec3::NEG_Z)?.z;
        let toe = |i: u8| self.farthest(&format!("l_toe{i}"), DVec3::Z).map(|p| p.z);
        Some(toe(1)?.max(toe(2)?) - heel + FOOT_PADS_M)
    }

    /// Returns a height in metres from its shares of stature for an adult and for a child of nine.
    fn height(&self, adult: f64, boy: f64) -> f64 {
        let body = self.params.body();
        (adult + (boy - adult) * body.child()) * body.stature_m
    }

    fn is_inside(&self, p: DVec3, regions: Regions) -> bool {
        self.field.value(p, regions, 1.0) < 0.0
    }

    /// Returns the lowest point of the trunk between the legs.
    fn crotch(&self) -> Option<f64> {
        let s = self.params.person.stature_m;
        (0..200)
            .map(|i| (0.42 + 0.0005 * f64::from(i)) * s)
            .find(|&y| {
                (-12..=12).any(|i| {
                    let p = DVec3::new(0.0, y, 0.005 * f64::from(i));
                    self.is_inside(p, Regions::TRUNK_ONLY)
                })
            })
    }

    fn girth_at(&self, y: f64, regions: Regions) -> f64 {
        let z = self.params.body().stoop_m(y);
        tape(&self.field, DVec3::new(0.0, y, z), regions)
    }

    fn heights(&self, share: core::ops::Range<f64>) -> impl Iterator<Item = f64> + use<'_> {
        let s = self.params.person.stature_m;
        (0..=18).map(move |i| s * (share.start + (share.end - share.start) * f64::from(i) / 18.0))
    }

    fn largest_girth(&self, share: core::ops::Range<f64>) -> f64 {
        let girths = self
            .heights(share)
            .map(|y| self.girth_at(y, Regions::LOWER));
        girths.fold(0.0, f64::max)
    }

    /// Returns the smallest girth between ribs and hips.
    fn least_girth(&self, share: core::ops::Range<f64>) -> f64 {
        let girths = self
            .heights(share)
            .map(|y| self.girth_at(y, Regions::LOWER));
        girths.fold(f64::MAX, f64::min)
    }

    /// Returns the girth of the chest, metres: at the nipples for men, above the breasts for women.
    fn chest_girth(&self) -> f64 {
        let body = self.params.body();
        let adult = if body.sex > 0.5 { 0.752 } else { 0.72 };
        self.girth_at(self.height(adult, 0.70), Regions::TRUNK_ONLY)
    }

    fn widest(&self, share: core::ops::Range<f64>) -> f64 {
        let half = |y: f64| {
            let depths = (-10..=10).map(|i| 0.01 * f64::from(i));
            let out = depths.map(|z| {
                (0..600)
                    .map(|i| 0.0005 * f64::from(i))
                    .filter(|&x| self.is_inside(DVec3::new(x, y, z), Regions::LOWER))
                    .fold(0.0, f64::max)
            });
            out.fold(0.0, f64::max)
        };
        2.0 * self.heights(share).map(half).fold(0.0, f64::max)
    }

    /// Returns the largest girth of the leg between two parameters (0 hip, 1 knee, 2 ankle),
    /// metres.
    fn leg_girth(&self, share: core::ops::Range<f64>) -> f64 {
        let [hip, knee, ankle] = [Bone::LHip, Bone::LKnee, Bone::LSubtalar].map(|b| self.joint(b));
        (0..=8)
            .map(|i| {
                let t = share.start + (share.end - share.start) * f64::from(i) / 8.0;
                let centre = if t < 1.0 {
                    hip.lerp(knee, t)
                } else {
                    knee.lerp(ankle, t - 1.0)
                };
                tape(&self.field, centre, Regions::LEG_ONLY)
            })
            .fold(0.0, f64::max)
    }

    /// Returns the girth of the neck's skin below the larynx, perpendicular to the neck, metres.
    fn neck_girth(&self) -> Option<f64> {
        let axis = (self.joint(Bone::Skull) - self.joint(Bone::Cervical)).normalize();
        let place = self.landmark("lar")? - axis * 0.006;
        let across = DVec3::X;
        let ahead = across.cross(axis);
        let names = &self.built.annotations;
        let mesh = &self.built.figure.meshes[names.landmark("lar")?.mesh];
        let at = |v: u32| DVec3::from_array(mesh.positions[v as usize].map(f64::from)) - place;
        // The body's own neck continues down to the shoulders, and the hands are far away.
        let middle = self.joint(Bone::Cervical);
        let mut cuts = Vec::new();
        for t in mesh.indices.chunks_exact(3) {
            let p = [at(t[0]), at(t[1]), at(t[2])];
            for k in 0..3 {
                let (a, b) = (p[k], p[(k + 1) % 3]);
                let (da, db) = (a.dot(axis), b.dot(axis));
                if da.min(db) < 0.0 && da.max(db) >= 0.0 {
                    let q = a.lerp(b, da / (da - db));
                    let beside = q + place - middle;
                    if beside.reject_from_normalized(axis).length() > 0.105 {
                        continue;
                    }
                    cuts.push(DVec2::new(q.dot(across), q.dot(ahead)));
                }
            }
        }
        Some(hull_length(&cuts))
    }
}

/// Returns the length of a tape measure around a body at the height of an interior point, metres.
pub(super) fn tape(field: &Field, centre: DVec3, regions: Regions) -> f64 {
    const RAYS: usize = 120;
    let points: Vec<DVec2> = (0..RAYS)
        .map(|i| {
            let (s, c) = ops::sincos(core::f64::consts::TAU * i as f64 / RAYS as f64);
            let d = DVec3::new(c, 0.0, s);
            let (mut low, mut high) = (0.0, 0.4);
            for _ in 0..30 {
                let middle = 0.5 * (low + high);
                let p = centre + d * middle;
                // The field mirrors itself: the other leg begins at the middle.
                let other_side = centre.x > 0.0 && p.x < 0.0;
                if !other_side && field.value(p, regions, 1.0) < 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            DVec2::new(c * low, s * low)
        })
        .collect();
    hull_length(&points)
}

/// Returns the perimeter of the convex hull of points (Andrew 1979: both halves from sorted
/// points).
fn hull_length(points: &[DVec2]) -> f64 {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |in_order: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in in_order {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>()
    };
    half(&mut sorted.iter().copied()) + half(&mut sorted.iter().rev().copied())
}

/// Returns every measure of the body that can be taken on a figure built from parameters, with the
/// norms for the person's sex and age.
#[must_use]
pub fn body_readings(
    params: &FigureParams,
    person: Person,
    built: &AnnotatedFigure,
) -> Vec<Reading> {
    let body = Physique {
        params,
        built,
        bones: bones::build(params, built)
            .into_iter()
            .map(|b| (b.name, b.vertices.iter().map(|v| v.position).collect()))
            .collect(),
        field: Field::new(&params.body(), &Joints::place(&params.body())),
    };
    DEFINITIONS
        .iter()
        .filter_map(|d| {
            Some(Reading {
                name: d.name,
                landmarks: d.landmarks,
                mm: (d.take)(&body)? * 1e3,
                norm: d.row.norm_at(person.sex, person.age_years),
                source: d.row.source.citation(),
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::people;
    use crate::tests::soundness::{people_built, shipped};

    #[test]
    fn bodies_measure_like_their_sex_and_age() {
        for name in people_built() {
            let (params, built) = shipped(name);
            let all = body_readings(params, params.person, built);
            assert_eq!(all.len(), DEFINITIONS.len(), "{name}");
            for r in all {
                assert!(r.deviations().abs() <= 1.0, "{name}: {r:?}");
            }
        }
    }

    #[test]
    fn a_tape_bridges_hollows_and_is_not_led_astray_by_points_at_one_place() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from_array);
        let inside = [[0.5, 0.4], [0.9, 0.1]].map(DVec2::from_array);
        let points = [&square[..], &inside, &square[1..3]].concat();
        assert!(
            (hull_length(&points) - 4.0).abs() < 1e-12,
            "the hull ignores inner and repeated points"
        );
    }

    #[test]
    fn a_taller_heavier_man_measures_more() {
        let mut params = people::preset("papous").unwrap();
        let small = body_readings(&params, params.person, &shipped("papous").1);
        params.person.stature_m = 1.85;
        params.person.build = 0.8;
        let large = body_readings(&params, params.person, &crate::build(&params));
        for (s, l) in small.iter().zip(&large) {
            // The head, including the neck's skin, keeps the size of its own statistics.
            let most = if s.name == "neck_girth" { 0.98 } else { 1.03 };
            assert!(l.mm > s.mm * most, "{} {} {}", s.name, s.mm, l.mm);
        }
    }
}

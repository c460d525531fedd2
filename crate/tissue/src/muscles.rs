//! Muscles at work: where the points of their fibres go (F&H section 3.1.2, "Muscle
//! Deformation").

use super::tissue::{Course, Fibre, FibrePoint, Tissue};
use super::{FaceControls, Muscle};

use Muscle as M;

/// How a muscle contracts: share of its length that it loses at full contraction, and how
/// much thicker its middle becomes, millimetres on the reference head. Designed: by what the
/// skin at its end was seen to travel.
const MECHANICS: [([Muscle; 2], f32, f32); 20] = [
    ([M::FrontalisMedialLeft, M::FrontalisMedialRight], 0.24, 0.4),
    (
        [M::FrontalisLateralLeft, M::FrontalisLateralRight],
        0.24,
        0.4,
    ),
    ([M::CorrugatorLeft, M::CorrugatorRight], 0.26, 1.6),
    (
        [M::DepressorSuperciliiLeft, M::DepressorSuperciliiRight],
        0.2,
        0.6,
    ),
    ([M::Procerus, M::Procerus], 0.16, 0.6),
    (
        [M::OrbicularisOculiLeft, M::OrbicularisOculiRight],
        0.13,
        1.2,
    ),
    ([M::NasalisLeft, M::NasalisRight], 0.34, 0.6),
    ([M::DepressorSepti, M::DepressorSepti], 0.22, 0.0),
    (
        [M::LevatorLabiiAlaequeLeft, M::LevatorLabiiAlaequeRight],
        0.2,
        1.0,
    ),
    ([M::LevatorLabiiLeft, M::LevatorLabiiRight], 0.26, 1.2),
    (
        [M::ZygomaticusMinorLeft, M::ZygomaticusMinorRight],
        0.22,
        1.8,
    ),
    (
        [M::ZygomaticusMajorLeft, M::ZygomaticusMajorRight],
        0.24,
        2.8,
    ),
    ([M::LevatorAnguliLeft, M::LevatorAnguliRight], 0.22, 0.8),
    ([M::RisoriusLeft, M::RisoriusRight], 0.22, 0.6),
    ([M::BuccinatorLeft, M::BuccinatorRight], 0.14, -1.6),
    ([M::DepressorAnguliLeft, M::DepressorAnguliRight], 0.22, 1.0),
    ([M::DepressorLabiiLeft, M::DepressorLabiiRight], 0.24, 0.8),
    ([M::MentalisLeft, M::MentalisRight], 0.4, 1.4),
    ([M::OrbicularisOrisUpper, M::OrbicularisOrisLower], 0.6, 0.5),
    ([M::PlatysmaLeft, M::PlatysmaRight], 0.1, 0.8),
];

/// How far the reddest part of the lips comes forward at full protrusion, and the outermost
/// fibres; and how far they go back at full retraction. Millimetres on the reference head.
/// Designed.
const FORWARD_MM: [f32; 2] = [8.0, 4.0];
const BACK_MM: [f32; 2] = [3.2, 0.8];
/// The corners come forward further, as the ring gets shorter.
const CORNER_FORWARD_MM: f32 = 2.4;
/// How far protruding lips turn out and retracted ones roll in.
const ROLL_MM: f32 = 0.9;

fn mechanics(muscle: Muscle) -> (f32, f32) {
    let found = MECHANICS.iter().find(|(pair, ..)| pair.contains(&muscle));
    found.map_or((0.0, 0.0), |(_, shortens, bulges)| {
        (*shortens, *bulges * 1e-3)
    })
}

/// The muscles of a face, and where contractions bring them.
#[derive(Clone, Debug)]
pub(super) struct Muscles {
    /// Middle of the mouth at rest.
    mouth: [f32; 3],
    /// Half its width.
    half_width: f32,
    /// How far each point of a fibre has moved, without the jaw.
    pub(super) moved: Vec<[f32; 3]>,
}

fn add(a: &mut [f32; 3], b: [f32; 3], share: f32) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += b * share;
    }
}

fn less(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

impl Muscles {
    pub(super) fn new(tissue: &Tissue) -> Self {
        let mut low = [f32::MAX; 3];
        let mut high = [f32::MIN; 3];
        for fibre in &tissue.fibres {
            if matches!(fibre.course, Course::Oris { out, .. } if out <= 0.0) {
                for point in points_of(tissue, fibre) {
                    for k in 0..3 {
                        low[k] = low[k].min(point.rest[k]);
                        high[k] = high[k].max(point.rest[k]);
                    }
                }
            }
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 3], [0.0; 3]);
        }
        Self {
            mouth: core::array::from_fn(|k| 0.5 * (low[k] + high[k])),
            half_width: (0.5 * (high[0] - low[0])).max(1e-3),
            moved: vec![[0.0; 3]; tissue.points.len()],
        }
    }

    /// Moves the points as the controls say. Values beyond their ranges are cut.
    pub(super) fn contract(&mut self, tissue: &Tissue, controls: &FaceControls) {
        let of = |muscle: Muscle| controls.contraction[muscle.index()].clamp(0.0, 1.0) as f32;
        for fibre in &tissue.fibres {
            let first = usize::from(fibre.first);
            let points = points_of(tissue, fibre);
            let (shortens, bulges) = mechanics(fibre.muscle);
            let moved = &mut self.moved[first..first + points.len()];
            match fibre.course {
                Course::Linear => {
                    let c = of(fibre.muscle);
                    linear(points, c * shortens, c * bulges * tissue.scale, moved);
                }
                Course::Towards(centre) => {
                    let c = of(fibre.muscle);
                    for (point, moved) in points.iter().zip(moved) {
                        let way = less(centre, point.rest);
                        *moved = way.map(|x| x * c * shortens);
                        add(moved, point.outwards, c * bulges * tissue.scale);
                    }
                }
                Course::Oris { is_lower, out } => {
                    let lips = [M::OrbicularisOrisUpper, M::OrbicularisOrisLower].map(of);
                    let protrusion = controls.protrusion.map(|p| p.clamp(-1.0, 1.0) as f32);
                    let (own, other) = if is_lower { (1, 0) } else { (0, 1) };
                    for (point, moved) in points.iter().zip(moved) {
                        let aside =
                            ((point.rest[0] - self.mouth[0]) / self.half_width).clamp(-1.0, 1.0);
                        // At the corner the halves of the ring are one.
                        let shared = 0.5 * aside * aside * aside * aside;
                        let mix = |v: [f32; 2]| v[own] + (v[other] - v[own]) * shared;
                        let lip = Lip {
                            contraction: mix(lips) * shortens,
                            protrusion: mix(protrusion),
                            bulge: mix(lips) * bulges * tissue.scale,
                            down: if is_lower { -1.0 } else { 1.0 },
                            out,
                            corner: aside * aside,
                        };
                        *moved =
                            lip.moved(less(point.rest, self.mouth), point.outwards, tissue.scale);
                    }
                }
            }
        }
        for link in &tissue.links {
            let end = self.moved[usize::from(link.end)];
            add(&mut self.moved[usize::from(link.ring)], end, link.weight);
        }
    }
}

fn points_of<'a>(tissue: &'a Tissue, fibre: &Fibre) -> &'a [FibrePoint] {
    let first = usize::from(fibre.first);
    &tissue.points[first..first + usize::from(fibre.count)]
}

/// Points go along the fibre towards its first; its middle bulges.
fn linear(points: &[FibrePoint], shorter: f32, bulge: f32, moved: &mut [[f32; 3]]) {
    let last = points.len() - 1;
    for (k, moved) in moved.iter_mut().enumerate() {
        let at = k as f32 * (1.0 - shorter);
        let before = (at as usize).min(last - 1);
        let on = at - before as f32;
        let (a, b) = (points[before].rest, points[before + 1].rest);
        let t = k as f32 / last as f32;
        *moved = core::array::from_fn(|c| a[c] + (b[c] - a[c]) * on - points[k].rest[c]);
        add(moved, points[k].outwards, bulge * 4.0 * t * (1.0 - t));
    }
}

/// The ring of the mouth at one of its points.
struct Lip {
    contraction: f32,
    protrusion: f32,
    bulge: f32,
    /// 1 in the upper lip, −1 in the lower.
    down: f32,
    out: f32,
    corner: f32,
}

impl Lip {
    /// `from` is the way from the middle of the mouth.
    fn moved(&self, from: [f32; 3], outwards: [f32; 3], scale: f32) -> [f32; 3] {
        let c = self.contraction * (1.0 - 0.45 * self.out);
        let mm = 1e-3 * scale;
        let between = |[inner, outer]: [f32; 2]| inner + (outer - inner) * self.out;
        let forth = self.protrusion.max(0.0);
        let back = (-self.protrusion).max(0.0);
        let free = 1.0 - self.corner;
        let roll = ROLL_MM * mm * (1.0 - self.out) * free * self.down * self.protrusion;
        let forward = between(FORWARD_MM) + CORNER_FORWARD_MM * self.corner;
        let mut moved = [
            -c * from[0] + 0.05 * back * from[0],
            -0.25 * c * from[1] + roll,
            (forth * forward - back * between(BACK_MM) * free) * mm,
        ];
        add(&mut moved, outwards, self.bulge * (1.0 - self.out));
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MUSCLES;

    #[test]
    fn every_muscle_has_its_mechanics() {
        assert_eq!(Muscle::all().count(), MUSCLES);
        for muscle in Muscle::all() {
            assert!(mechanics(muscle).0 > 0.0, "{muscle:?}");
        }
    }

    #[test]
    fn a_linear_fibre_gets_shorter_towards_its_origin() {
        let points: Vec<FibrePoint> = (0..6u8)
            .map(|k| FibrePoint {
                rest: [0.01 * f32::from(k), 0.0, 0.0],
                outwards: [0.0, 0.0, 1.0],
                jaw: 0.0,
            })
            .collect();
        let mut moved = vec![[0.0; 3]; 6];
        linear(&points, 0.3, 0.002, &mut moved);
        for (k, m) in moved.iter().enumerate() {
            let travelled = 0.3 * 0.01 * k as f32;
            assert!((m[0] + travelled).abs() < 1e-7, "{k} {m:?}");
            assert!(m[2] >= 0.0 && m[2] < 0.0021);
        }
        assert_eq!(moved[0], [0.0; 3]);
    }
}

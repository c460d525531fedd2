//! Properties of contracting muscles, on randomly generated mouths.

use raconteur_base::noise;

use super::*;
use crate::FaceControls;
use crate::tissue::Link;

/// Rounding error of sums of a few dozen positions of at most a decimetre, in `f32`.
const ROUNDED_M: f32 = 1e-6;
const MOUTHS: u64 = 40;
const FACES: i64 = 25;
/// Points of half a ring.
const RING: u16 = 25;
/// Linear muscles of these mouths; the first of each pair of fibres is the left one.
const LINEAR: [Muscle; 8] = [
    M::ZygomaticusMajorLeft,
    M::ZygomaticusMajorRight,
    M::LevatorAnguliLeft,
    M::DepressorAnguliLeft,
    M::RisoriusLeft,
    M::RisoriusRight,
    M::DepressorLabiiLeft,
    M::MentalisLeft,
];

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
    along_course(&points, 0.3, &mut moved);
    for (k, m) in moved.iter().enumerate() {
        let travelled = 0.3 * 0.01 * k as f32;
        assert!((m[0] + travelled).abs() < 1e-7, "{k} {m:?}");
    }
    assert_eq!(moved[0], [0.0; 3]);
}

/// A mouth: a ring of two halves, and linear muscles of one or two fibres grown into it.
fn mouth(seed: u64) -> Tissue {
    let u = |id: u64, k: i64| noise::unit(seed, id, k) as f32;
    let mut out = Tissue {
        scale: 0.8 + 0.4 * u(0, 0),
        ..Tissue::default()
    };
    let outwards = [0.0, 0.0, 1.0];
    let put = |out: &mut Tissue, muscle, course, places: Vec<[f32; 3]>| {
        let first = out.points.len() as u16;
        let point = |rest| FibrePoint {
            rest,
            outwards,
            jaw: 0.0,
        };
        out.points.extend(places.into_iter().map(point));
        out.fibres.push(Fibre {
            muscle,
            course,
            first,
            count: (out.points.len() - usize::from(first)) as u8,
        });
        first
    };
    for (is_lower, muscle, up) in [
        (false, M::OrbicularisOrisUpper, 0.006),
        (true, M::OrbicularisOrisLower, -0.006),
    ] {
        let place = |k: u16| {
            let x = f32::from(k) / f32::from(RING - 1) * 2.0 - 1.0;
            [0.025 * x, up * (1.0 - x * x), -0.008 * x * x]
        };
        let course = FibreCurve::Oris { is_lower, out: 0.0 };
        put(&mut out, muscle, course, (0..RING).map(place).collect());
    }
    for (m, muscle) in LINEAR.into_iter().enumerate() {
        let id = 10 * (m as u64 + 1);
        let fibres = 1 + i64::from(u(id, 0) > 0.5);
        for fibre in 0..fibres {
            let at = (u(id + 1, fibre) * f32::from(2 * RING - 1)) as u16;
            let grown = out.points[usize::from(at)].rest;
            let jitter = |id: u64, c: usize| u(id, 3 * fibre + c as i64) - 0.5;
            let end = [0, 1, 2].map(|c| grown[c] + 0.004 * jitter(id + 2, c));
            let origin = [0, 1, 2].map(|c| end[c] + 0.1 * jitter(id + 3, c));
            // A bowed course of uneven pieces.
            let places = (0..7).map(|k| {
                let t =
                    (k as f32 + 0.3 * (u(id + 4, k) - 0.5) * f32::from(u8::from(k % 6 != 0))) / 6.0;
                let mut p = [0, 1, 2].map(|c| origin[c] + (end[c] - origin[c]) * t);
                p[2] += 0.012 * t * (1.0 - t);
                p
            });
            let first = put(&mut out, muscle, FibreCurve::Linear, places.collect());
            for ring in 0..2 * RING {
                let off = f32::from(ring.abs_diff(at)) / 6.0;
                if off < 1.0 {
                    out.links.push(Link {
                        end: first + 6,
                        ring,
                        weight: 0.8 * (1.0 - off) / fibres as f32,
                    });
                }
            }
        }
    }
    out
}

fn face(seed: u64, i: i64) -> FaceControls {
    let u = |id: u64| noise::unit(seed, 1000 + id, i);
    let mut c = FaceControls::default();
    for (k, x) in (0u64..).zip(&mut c.contraction) {
        if u(2 * k) < 0.4 {
            *x = u(2 * k + 1);
        }
    }
    c.protrusion = [200, 201].map(|k| {
        if u(k) < 0.5 {
            2.0 * u(k + 5) - 1.0
        } else {
            0.0
        }
    });
    c
}

fn contracted(tissue: &Tissue, controls: &FaceControls) -> Vec<[f32; 3]> {
    let mut muscles = muscles(tissue);
    contract(&mut muscles, tissue, controls);
    muscles.moved
}

fn muscles(tissue: &Tissue) -> Muscles {
    Muscles::new(tissue, &Anatomy::SHIPPED)
}

fn contract(muscles: &mut Muscles, tissue: &Tissue, controls: &FaceControls) {
    muscles.contract(tissue, &controls.contraction, controls.protrusion);
}

fn farthest(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    a.iter()
        .zip(b)
        .map(|(a, b)| distance(*a, *b))
        .fold(0.0, f32::max)
}

/// Returns the same mouth with its links and its linear muscles, which come last, in reverse order.
fn turned_round(tissue: &Tissue) -> (Tissue, Vec<usize>) {
    let mut other = tissue.clone();
    other.fibres.reverse();
    other.points.clear();
    let mut came_from = Vec::new();
    for fibre in &mut other.fibres {
        let own = range_of(fibre);
        fibre.first = other.points.len() as u16;
        other.points.extend_from_slice(&tissue.points[own.clone()]);
        came_from.extend(own);
    }
    let now = |point: u16| {
        let at = came_from.iter().position(|&p| p == usize::from(point));
        at.expect("a point") as u16
    };
    other.links.reverse();
    for link in &mut other.links {
        (link.end, link.ring) = (now(link.end), now(link.ring));
    }
    (other, came_from)
}

#[test]
fn relaxed_muscles_rest() {
    for seed in 0..MOUTHS {
        let moved = contracted(&mouth(seed), &FaceControls::default());
        assert!(
            farthest(&moved, &vec![[0.0; 3]; moved.len()]) < ROUNDED_M,
            "relaxed muscles do not move"
        );
    }
}

#[test]
fn the_order_of_muscles_links_and_contractions_changes_nothing() {
    for seed in 0..MOUTHS {
        let tissue = mouth(seed);
        let (other, came_from) = turned_round(&tissue);
        let (mut one, mut two) = (muscles(&tissue), muscles(&tissue));
        let mut reversed = muscles(&other);
        for i in 0..FACES {
            let [a, b] = [face(seed, 2 * i), face(seed, 2 * i + 1)];
            let both = a.lerp(&b, 0.5);
            // Through one face, and through the other.
            contract(&mut one, &tissue, &a);
            contract(&mut one, &tissue, &both);
            contract(&mut two, &tissue, &b);
            contract(&mut two, &tissue, &both);
            assert_eq!(one.moved, two.moved, "{seed}");
            contract(&mut reversed, &other, &both);
            let there: Vec<[f32; 3]> = came_from.iter().map(|&p| one.moved[p]).collect();
            assert!(farthest(&reversed.moved, &there) < ROUNDED_M, "{seed}");
        }
    }
}

#[test]
fn what_is_grown_together_keeps_its_distance() {
    let mut seen = 0;
    for seed in 0..MOUTHS {
        let tissue = mouth(seed);
        let mut muscles = muscles(&tissue);
        let ends: Vec<_> = muscles.junctions.whole_ends().collect();
        for i in 0..FACES {
            contract(&mut muscles, &tissue, &face(seed, i));
            for (end, places) in &ends {
                let apart = |moved: &dyn Fn(usize) -> [f32; 3]| {
                    let at = |p: usize| plus(tissue.points[p].rest, moved(p));
                    let centre = [0, 1, 2].map(|k| {
                        let all = places.iter().map(|(p, share)| at(*p)[k] * share);
                        all.sum::<f32>()
                    });
                    distance(at(*end), centre)
                };
                let (rest, now) = (apart(&|_| [0.0; 3]), apart(&|p| muscles.moved[p]));
                let off = (now - rest).abs();
                assert!(off < ROUNDED_M, "{seed}: {rest} m, then {now} m");
                seen += 1;
            }
        }
    }
    assert!(seen > 1000, "{seen}");
}

#[test]
fn a_fibre_keeps_its_origin_and_the_proportions_of_its_segments() {
    for seed in 0..MOUTHS {
        let tissue = mouth(seed);
        let mut muscles = muscles(&tissue);
        for i in 0..FACES {
            let controls = face(seed, i);
            contract(&mut muscles, &tissue, &controls);
            for fibre in tissue
                .fibres
                .iter()
                .filter(|f| f.course == FibreCurve::Linear)
            {
                let points = points_of(&tissue, fibre);
                let moved = &muscles.moved[range_of(fibre)];
                assert!(
                    distance(moved[0], [0.0; 3]) < ROUNDED_M,
                    "the origin of the fibre stays fixed"
                );
                // Without the bulge, which is along +z here and 0 at both ends.
                let (_, bulges) = Anatomy::SHIPPED.mechanics(fibre.muscle);
                let most = bulges.abs() + THICK_MM * 1e-3;
                let at = |k: usize| plus(points[k].rest, moved[k]);
                let pieces: Vec<[f32; 2]> = (1..points.len())
                    .map(|k| {
                        let rest = distance(points[k - 1].rest, points[k].rest);
                        [rest, distance(at(k - 1), at(k))]
                    })
                    .collect();
                let whole = [0, 1].map(|w| pieces.iter().map(|p| p[w]).sum::<f32>());
                for [rest, now] in pieces {
                    let wanted = rest / whole[0] * whole[1];
                    assert!((now - wanted).abs() < 2.0 * most * tissue.scale, "{seed}");
                }
            }
        }
    }
}

#[test]
fn the_stronger_has_more_of_its_way_and_the_weaker_gives() {
    // Two muscles in the middle of the ring that pull to opposite sides.
    let mut tissue = mouth(3);
    tissue.fibres.truncate(2);
    tissue.links.clear();
    tissue.points.truncate(usize::from(2 * RING));
    let ring = RING / 2;
    let grown = tissue.points[usize::from(ring)].rest;
    for (muscle, side) in [(M::RisoriusLeft, 1.0), (M::RisoriusRight, -1.0)] {
        let first = tissue.points.len() as u16;
        tissue.points.extend((0..7u8).map(|k| FibrePoint {
            rest: [
                grown[0] + side * 0.01 * (6.0 - f32::from(k)),
                grown[1],
                grown[2],
            ],
            outwards: [0.0, 0.0, 1.0],
            jaw: 0.0,
        }));
        tissue.fibres.push(Fibre {
            muscle,
            course: FibreCurve::Linear,
            first,
            count: 7,
        });
        // Over half of the ring, because a cord yields almost nothing at a single point.
        tissue
            .links
            .extend((RING / 4..=3 * RING / 4).map(|ring| Link {
                end: first + 6,
                ring,
                weight: 0.8,
            }));
    }
    let ask = |left: f64, right: f64| {
        let mut c = FaceControls::default();
        c.contraction[M::RisoriusLeft.index()] = left;
        c.contraction[M::RisoriusRight.index()] = right;
        contracted(&tissue, &c)
    };
    let x = |left: f64, right: f64| ask(left, right)[usize::from(ring)][0];
    assert!(x(0.8, 0.8).abs() < ROUNDED_M, "equals hold each other");
    let alone = x(0.8, 0.0);
    assert!(alone > 0.005, "{alone}");
    let mut last = alone;
    for step in 1..=8 {
        let now = x(0.8, 0.2 * f64::from(step).min(4.0));
        assert!(now <= last && now > -ROUNDED_M, "{step}");
        last = now;
    }
    // A stretched muscle gets longer, and thinner in its middle; a contracting one bulges.
    let moved = ask(0.8, 0.0);
    let (puller, pulled) = (usize::from(2 * RING) + 3, usize::from(2 * RING) + 10);
    assert!(
        moved[puller][2] > 0.0 && moved[pulled][2] < -1e-4,
        "{moved:?}"
    );
    assert!(
        moved[usize::from(2 * RING) + 13][0] > 0.5 * alone,
        "the stronger muscle keeps more than half of its path"
    );
}

#[test]
fn a_bowed_fibre_straightens_before_it_stretches() {
    let points: Vec<FibrePoint> = (0..7u8)
        .map(|k| {
            let t = f32::from(k) / 6.0;
            FibrePoint {
                rest: [0.06 * t, 0.05 * t * (1.0 - t), 0.0],
                outwards: [0.0, 0.0, 1.0],
                jaw: 0.0,
            }
        })
        .collect();
    let length = length_of(&points, |k| points[k].rest);
    let mut scratch = Vec::new();
    let mut bow = f32::MAX;
    for pulled in [0.0, 0.002, 0.004, 0.01, 0.02] {
        let mut moved = vec![[0.0; 3]; 7];
        let end = [pulled, 0.0, 0.0];
        let longer = stretched(&points, length, end, &mut moved, &mut scratch);
        let now = points[3].rest[1] + moved[3][1];
        assert!(now < bow + 1e-6, "{pulled}");
        bow = now;
        if 0.06 + pulled < length {
            assert!(longer < 1.02, "{pulled}: {longer}");
        } else {
            assert!(
                (longer - (0.06 + pulled) / length).abs() < 0.01 && now < 1e-4,
                "the fibre straightens before it stretches"
            );
        }
    }
}

//! Proportions compared with surveys, and soundness of the cage.
//!
//! Adults: Heinz, Peterson, Johnson and Kerk 2003, doi:10.1080/10691898.2003.11910711, 247 men
//! (177.7 cm) and 260 women (164.9 cm), young and active; means and standard deviations in
//! centimetres. Sitting height as a share of stature: Fredriks et al. 2005,
//! doi:10.1136/adc.2004.050799.

use raconteur_base::DVec3;

use super::*;
use crate::physique::tape;
use raconteur_body::skeleton::Bone;

fn person(sex: f64, age_years: f64, stature_m: f64, build: f64) -> BodyParams {
    BodyParams {
        sex,
        age_years,
        stature_m,
        build,
        bust: sex,
    }
}

fn body(p: &BodyParams) -> (Joints, Field) {
    let joints = Joints::place(p);
    let field = Field::new(p, &joints);
    (joints, field)
}

/// Chest, waist, hip, thigh and calf of a body, centimetres.
fn girths(p: &BodyParams) -> [f64; 5] {
    let (joints, field) = body(p);
    let s = p.stature_m;
    let flat = |share: f64, regions: Regions| {
        let centre = DVec3::new(0.0, share * s, 0.0);
        100.0 * tape(&field, centre, regions)
    };
    let waist = (0..12)
        .map(|i| flat(0.59 + 0.005 * f64::from(i), Regions::LOWER))
        .fold(f64::MAX, f64::min);
    let hip = (0..12)
        .map(|i| flat(0.485 + 0.006 * f64::from(i), Regions::LOWER))
        .fold(0.0, f64::max);
    let leg = |t: f64| {
        let (a, b, c) = (
            joints.position_of(Bone::LHip),
            joints.position_of(Bone::LKnee),
            joints.position_of(Bone::LSubtalar),
        );
        let centre = if t < 1.0 {
            a.lerp(b, t)
        } else {
            b.lerp(c, t - 1.0)
        };
        100.0 * tape(&field, centre, Regions::LEG_ONLY)
    };
    let calf = (0..8)
        .map(|i| leg(1.2 + 0.04 * f64::from(i)))
        .fold(0.0, f64::max);
    // The survey measures a woman's chest above the breasts.
    let chest = if p.sex > 0.5 { 0.752 } else { 0.72 };
    [
        flat(chest, Regions::TRUNK_ONLY),
        waist,
        hip,
        leg(0.30),
        calf,
    ]
}

#[test]
fn girths_of_adults_lie_within_a_standard_deviation() {
    let names = ["chest", "waist", "hip", "thigh", "calf"];
    let man = [
        (100.99, 7.21),
        (84.53, 8.78),
        (97.76, 6.23),
        (56.50, 4.25),
        (37.21, 2.65),
    ];
    let woman = [
        (86.06, 6.03),
        (69.80, 7.59),
        (95.65, 6.94),
        (57.20, 4.64),
        (35.01, 2.61),
    ];
    for (p, survey) in [
        (person(0.0, 30.0, 1.7775, 0.0), man),
        (person(1.0, 30.0, 1.6487, 0.0), woman),
    ] {
        let own = girths(&p);
        let misses: Vec<String> = (0..5)
            .filter(|&k| (own[k] - survey[k].0).abs() > survey[k].1)
            .map(|k| format!("{} {:.1} of {:?}", names[k], own[k], survey[k]))
            .collect();
        assert!(misses.is_empty(), "sex {}: {misses:?}", p.sex);
    }
}

#[test]
fn joints_lie_where_anatomy_has_them() {
    for age in [9.0, 12.0, 16.0, 35.0, 70.0] {
        for sex in [0.0, 1.0] {
            let p = person(sex, age, 1.6, 0.0);
            let (joints, _) = body(&p);
            let hip = joints.position_of(Bone::LHip).y / p.stature_m;
            assert!((0.50..0.53).contains(&hip), "hips at {hip}");
            // The seat is about 0.048 of stature below the hips.
            let sitting = 1.0 - (hip - 0.048);
            let (mean, sd) = if age < 12.0 {
                (0.533, 0.013)
            } else {
                (0.522, 0.014)
            };
            if !(11.0..17.0).contains(&age) {
                assert!((sitting - mean).abs() < sd, "{age}: {sitting}");
            }
            let knee = joints.position_of(Bone::LKnee).y / p.stature_m;
            assert!((0.265..0.29).contains(&knee), "knees at {knee}");
        }
    }
}

#[test]
fn age_sex_and_build_shape_the_body() {
    let man = person(0.0, 30.0, 1.75, 0.0);
    let old = person(0.0, 75.0, 1.75, 0.0);
    let boy = person(0.0, 9.0, 1.34, 0.0);
    let heavy = person(0.0, 30.0, 1.75, 1.0);
    let [_, waist, hip, thigh, ..] = girths(&man);
    let aged = girths(&old);
    assert!(
        aged[1] > waist + 4.0 && aged[3] < thigh,
        "belly and thin legs"
    );
    assert!(
        girths(&heavy)[1] > waist * 1.08,
        "the waist grows with the build"
    );
    let small = girths(&boy);
    assert!(
        small[1] / small[2] > waist / hip + 0.02,
        "a child has no waist"
    );
    let shoulder = |p: &BodyParams| Joints::place(p).position_of(Bone::LShoulder).x / p.stature_m;
    assert!(
        shoulder(&boy) < shoulder(&man),
        "the shoulders of the boy are narrower"
    );
    let forward = |p: &BodyParams| {
        let j = Joints::place(p);
        j.position_of(Bone::Skull).z - j.position_of(Bone::Thoracic).z
    };
    assert!(forward(&old) > forward(&man) + 0.02, "age stoops");
    // The head's share: from the skull's joint upwards.
    let head = |p: &BodyParams| 1.0 - Joints::place(p).position_of(Bone::Skull).y / p.stature_m;
    assert!(
        head(&boy) > head(&man) * 1.15,
        "the head of the boy is relatively larger"
    );
}

#[test]
fn the_cage_is_sound_for_every_body() {
    for (sex, age, stature, build) in [
        (0.0, 8.0, 1.25, -0.5),
        (1.0, 13.0, 1.5, 0.0),
        (1.0, 35.0, 1.66, 0.0),
        (0.0, 80.0, 1.68, 0.8),
        (0.5, 40.0, 1.95, -1.0),
    ] {
        let p = person(sex, age, stature, build);
        let (joints, field) = body(&p);
        let cage = Cage::new(&field, &joints);
        let edges = crate::subdivide::edge_faces(&cage.shell.faces);
        assert!(edges.values().all(|f| f.len() <= 2), "manifold");
        let used = cage.shell.faces.iter().flatten().copied();
        let used: std::collections::BTreeSet<u32> = used.collect();
        let far = used
            .iter()
            .map(|&v| {
                field
                    .value(cage.shell.points[v as usize], Regions::ALL, 1.0)
                    .abs()
            })
            .fold(0.0, f64::max);
        assert!(far < 0.03, "{far} m off the body");
        for &v in &used {
            let sum: f64 = cage.shell.weights[v as usize]
                .refs()
                .iter()
                .map(|w| w.1)
                .sum();
            assert!(
                (sum - 1.0).abs() < 1e-9,
                "the weights of a vertex add up to 1"
            );
        }
    }
}

//! Faces on a shipped figure.

mod look;
mod points;

use raconteur_base::noise;

use super::*;
use raconteur_body::read::read_figure;

const SOFIA: &[u8] = include_bytes!("../../../assets/figures/sofia.glb");
/// Vertices of the skin of our heads.
const VERTICES: usize = 16_594;

fn sofia() -> Reshaper {
    Reshaper::new(read_figure("sofia", SOFIA).expect("a figure"), VERTICES).expect("our head")
}

/// The skin that the figure has, in the frame of the head.
fn own(reshaper: &Reshaper) -> Vec<f64> {
    let skin = &reshaper.figure.meshes[reshaper.head].positions[..VERTICES];
    let places = skin.iter().map(|&p| wide(p) - reshaper.origin);
    places.flat_map(|p| p.to_array()).collect()
}

fn organs(reshaper: &Reshaper) -> NewOrgans {
    let joints = reshaper.figure.skeleton.joints().iter().enumerate();
    let mut eye_centres = [DVec3::ZERO; 2];
    for (i, joint) in joints {
        if let Drive::Eye(side) = joint.drive {
            let world = reshaper.figure.inverse_bind[i].inverse();
            eye_centres[side.index()] = world.translation - reshaper.origin;
        }
    }
    NewOrgans {
        eye_centres,
        lid_closure_rad: reshaper.figure.lid_closure_rad,
        chin: -0.083,
    }
}

fn face<'a>(skin: &'a [f64], tone: &'a [f64], organs: NewOrgans) -> NewFace<'a> {
    NewFace {
        skin,
        tone,
        organs,
        iris: [1.0; 3],
        brows: [1.0; 3],
    }
}

#[test]
fn a_figure_with_its_own_face_is_itself() {
    let reshaper = sofia();
    let (skin, organs) = (own(&reshaper), organs(&reshaper));
    let same = reshaper
        .with_face(&face(&skin, &[], organs))
        .expect("a face");
    for (a, b) in same.meshes.iter().zip(&reshaper.figure.meshes) {
        for (p, q) in a.positions.iter().zip(&b.positions) {
            assert!((wide(*p) - wide(*q)).length() < 1e-6, "{}", a.name);
        }
    }
    let mesh = |f: &Figure| f.meshes[reshaper.head].clone();
    let (before, after) = (mesh(&reshaper.figure), mesh(&same));
    let turned = before.normals.iter().zip(&after.normals);
    let off = turned
        .filter(|(a, b)| wide(**a).dot(wide(**b)) < 0.985)
        .count();
    // Stored normals are rounded to 8 bits.
    assert!(off < VERTICES / 100, "{off}");
}

/// A slightly enlarged face: everything in the head follows, and nothing below it.
#[test]
fn what_lies_in_and_on_the_face_goes_along() {
    let reshaper = sofia();
    let (skin, mut organs) = (own(&reshaper), organs(&reshaper));
    let larger: Vec<f64> = skin.iter().map(|x| x * 1.04).collect();
    organs.eye_centres = organs.eye_centres.map(|p| p * 1.04);
    let changed = reshaper
        .with_face(&face(&larger, &[], organs))
        .expect("a face");
    for (mesh, before) in changed.meshes.iter().zip(&reshaper.figure.meshes) {
        let pairs = mesh.positions.iter().zip(&before.positions);
        for (p, q) in pairs {
            let (p, q) = (wide(*p), wide(*q));
            let at = q - reshaper.origin;
            let wanted = at * 0.04;
            // Locks are some distance from their skin.
            let most = match mesh.material.kind {
                MaterialKind::Lash => 1.5e-3,
                MaterialKind::Hair if at.y > 0.02 => 3e-3,
                _ => f64::MAX,
            };
            assert!((p - q - wanted).length() < most, "{}: {at}", mesh.name);
            if at.y < -0.2 {
                assert_eq!(p, q, "{}", mesh.name);
            }
        }
    }
    let (was, is) = (&reshaper.figure, &changed);
    let eye = |f: &Figure| {
        let joints = f.skeleton.joints().iter();
        let i = joints
            .clone()
            .position(|j| matches!(j.drive, Drive::Eye(_)));
        f.inverse_bind[i.expect("an eye")].inverse().translation
    };
    assert!(
        (eye(is) - eye(was) - organs.eye_centres[0] * (0.04 / 1.04)).length() < 1e-6,
        "the eyes move with the face"
    );
    let nodes = |f: &Figure| f.tissue.clone().expect("tissue").rest;
    for (p, q) in nodes(is).iter().zip(&nodes(was)) {
        let at = wide(*q) - reshaper.origin;
        if at.y > -0.08 {
            // Those in the mouth have skin only far before them.
            let is_inside = at.x.abs() < 0.03 && at.z < 0.075;
            let most = if is_inside { 3e-3 } else { 1e-3 };
            assert!((wide(*p) - wide(*q) - at * 0.04).length() < most, "{at}");
        }
    }
}

/// The mouth cavity is joined to the lips, and the texture has a seam: both stay closed under a
/// face that moves every vertex independently.
#[test]
fn seams_stay_closed() {
    let reshaper = sofia();
    let (skin, organs) = (own(&reshaper), organs(&reshaper));
    let shaken: Vec<f64> = (0..)
        .zip(&skin)
        .map(|(i, x)| x + 1e-3 * noise::signed(3, 1, i))
        .collect();
    let changed = reshaper
        .with_face(&face(&shaken, &[], organs))
        .expect("a face");
    let head = |f: &Figure| f.meshes[reshaper.head].positions[..VERTICES].to_vec();
    let (before, after) = (head(&reshaper.figure), head(&changed));
    let mut places = std::collections::BTreeMap::new();
    for (p, q) in before.iter().zip(&after) {
        assert_eq!(places.entry(p.map(f32::to_bits)).or_insert(*q), q);
    }
    let bag = |f: &Figure| f.meshes.iter().find(|m| m.name == "mouth_bag").cloned();
    let bags = [&reshaper.figure, &changed].map(|f| bag(f).expect("a mouth"));
    let pairs = bags[0].positions.iter().zip(&bags[1].positions);
    let sewn = pairs.filter_map(|(p, q)| Some((places.get(&p.map(f32::to_bits))?, q)));
    let sewn: Vec<_> = sewn.collect();
    assert!(sewn.len() > 20, "{}", sewn.len());
    assert!(
        sewn.iter().all(|(skin, bag)| skin == bag),
        "the seam vertices coincide"
    );
}

#[test]
fn a_tone_darkens_skin_and_hands_alike() {
    let reshaper = sofia();
    let (skin, organs) = (own(&reshaper), organs(&reshaper));
    let tone: Vec<f64> = (0..3 * VERTICES as i64)
        .map(|i| 0.2 + 0.02 * noise::signed(1, 2, i))
        .collect();
    let dark = reshaper
        .with_face(&face(&skin, &tone, organs))
        .expect("a face");
    for (mesh, before) in dark.meshes.iter().zip(&reshaper.figure.meshes) {
        if mesh.material.kind != MaterialKind::Skin {
            continue;
        }
        for (v, (c, b)) in mesh.colors.iter().zip(&before.colors).enumerate() {
            for i in 0..3 {
                let now = f64::from(c[i]) * f64::from(mesh.material.base_color[i]);
                let wanted = tone.get(3 * v + i).unwrap_or(&0.2) * f64::from(b[i]);
                assert!((now - wanted).abs() < 0.6, "{}: {now} {wanted}", mesh.name);
            }
            assert_eq!(c[3], b[3]);
        }
    }
}

#[test]
fn strangers_are_named() {
    let reshaper = sofia();
    let (skin, organs) = (own(&reshaper), organs(&reshaper));
    let told = |skin: &[f64], tone: &[f64]| {
        let error = reshaper.with_face(&face(skin, tone, organs));
        error.expect_err("a stranger").to_string()
    };
    assert!(
        told(&skin[3..], &[]).contains("16593 vertices"),
        "the error names the number of vertices"
    );
    assert!(
        told(&skin, &[1.0; 6]).contains("vertices"),
        "the error names the wrong vertices"
    );
    let mut broken = skin.clone();
    broken[7] = f64::NAN;
    assert!(
        told(&broken, &[]).contains("not finite"),
        "the error names the value that is not finite"
    );
    let other = Reshaper::new(reshaper.figure.clone(), VERTICES - 100);
    assert!(
        matches!(other, Err(ReshapeError::OtherHead { .. })),
        "another head is rejected"
    );
    assert_eq!(NewOrgans::from_numbers(&[0.0; 8]), None);
}

//! Tests of packs.

use proptest::prelude::*;

use super::*;
use crate::age_model::AgeModel;
use crate::sample::{examples, labelled};
use crate::segment::Segment;

fn model() -> FaceModel {
    let faces = examples(30, 60, 5);
    let shape = FaceSpace::learn(&faces)
        .expect("corresponding")
        .truncated(12);
    let (own, labels) = labelled(&shape, &faces, 2);
    let values: Vec<Vec<f64>> = faces
        .iter()
        .map(|f| vec![f[0] + 1.0, f[1] - f[2]])
        .collect();
    FaceModel {
        reference: Vec::new(),
        life: AgeModel::default(),
        cage: DependentNumbers::learn(&shape, &own, &values),
        organs: DependentNumbers::default(),
        people: Vec::new(),
        landmarks: Vec::new(),
        texture: None,
        attributes: vec![NamedAttribute {
            feature: None,
            group: "mouth".to_owned(),
            terms: ["narrow".to_owned(), "wide".to_owned()],
            derived: None,
            attribute: Attribute::learn("width of the mouth", &shape, &own, &labels)
                .expect("a direction"),
        }],
        examples: own,
        triangles: vec![[0, 1, 2], [2, 1, 19]],
        segments: Segments::new(
            vec![Segment {
                name: "face".to_owned(),
                parent: None,
                runs: vec![[0, 20]],
            }],
            20,
        )
        .expect("a hierarchy"),
        shape,
    }
}

#[test]
fn a_pack_holds_its_model_to_a_small_part_of_a_deviation() {
    let model = model();
    let bytes = model.to_bytes().expect("it fits");
    assert_eq!(bytes, model.to_bytes().expect("it fits"));
    let again = FaceModel::from_bytes(&bytes).expect("a pack");
    let face = &model.examples[4];
    let pairs = model
        .shape
        .face(face)
        .into_iter()
        .zip(again.shape.face(face));
    for (a, b) in pairs {
        assert!((a - b).abs() < 0.01, "{a} {b}");
    }
    let [a, b] = [&model, &again].map(|m| m.cage.evaluate(face));
    assert!(
        a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 0.01),
        "the pack restores the cage"
    );
    assert_eq!(again.attributes[0].terms[1], "wide");
    assert_eq!(
        (&again.triangles, &again.segments),
        (&model.triangles, &model.segments)
    );
    // Rounded again, it is as near.
    let twice = FaceModel::from_bytes(&again.to_bytes().expect("it fits")).expect("a pack");
    for (a, b) in again
        .shape
        .face(face)
        .into_iter()
        .zip(twice.shape.face(face))
    {
        assert!((a - b).abs() < 0.01, "{a} {b}");
    }
    for i in 0..again.shape.dimensions() {
        for j in 0..=i {
            let pairs = again.shape.mode(i).iter().zip(again.shape.mode(j));
            let product: f64 = pairs.map(|(a, b)| a * b).sum();
            assert!(
                (product - f64::from(u8::from(i == j))).abs() < 1e-12,
                "the packed modes are orthonormal"
            );
        }
    }
}

#[test]
fn what_follows_a_shape_is_told_from_it() {
    let faces = examples(50, 30, 6);
    let shape = FaceSpace::learn(&faces).expect("corresponding");
    let own = labelled(&shape, &faces, 0).0;
    let values: Vec<Vec<f64>> = faces.iter().map(|f| vec![f[3] * 2.0 + 0.5]).collect();
    let follower = DependentNumbers::learn(&shape, &own, &values);
    for (face, value) in own.iter().zip(&values) {
        assert!(
            (follower.evaluate(face)[0] - value[0]).abs() < 1e-9,
            "the follower predicts the value of the face"
        );
    }
}

#[test]
fn strangers_are_named() {
    let bytes = model().to_bytes().expect("it fits");
    let mut other = bytes.clone();
    other[6] = 9;
    for (bytes, why) in [
        (&b""[..], "not a face pack"),
        (b"{\"json\": 1}", "not a face pack"),
        (&other, "another version"),
        (&bytes[..bytes.len() - 1], "pack of faces cannot be read"),
        (&bytes[..9], "pack of faces cannot be read"),
    ] {
        let told = FaceModel::from_bytes(bytes)
            .expect_err("a stranger")
            .to_string();
        assert!(told.contains(why), "{told}");
    }
}

proptest! {
    #[test]
    fn no_change_of_a_pack_panics(at in 8..4000_usize, byte: u8, cut in 0..4000_usize) {
        let mut bytes = model().to_bytes().expect("it fits");
        let at = at % bytes.len();
        bytes[at.max(8)] = byte;
        let _ = FaceModel::from_bytes(&bytes);
        bytes.truncate(cut);
        let _ = FaceModel::from_bytes(&bytes);
    }
}

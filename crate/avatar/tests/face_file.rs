//! Figure files of faces.

use raconteur_avatar::{FaceFile, face_file};
use raconteur_base::DVec3;
use raconteur_body::annotation::annotations;
use raconteur_body::figure::{Figure, Image, MaterialKind};
use raconteur_body::read::read_figure;
use raconteur_body::{Bone, Drive};
use raconteur_reshape::{Look, NewFace, NewOrgans, SKULL_IN_HEAD_M};

const SOFIA: &[u8] = include_bytes!("../../../assets/figures/sofia.glb");
const PAPOUS: &[u8] = include_bytes!("../../../assets/figures/papous.glb");
/// Vertices of the skin of our heads.
const VERTICES: usize = 16_594;

/// Returns the figure's own skin and inner parts of the head, slightly enlarged.
fn larger(figure: &Figure) -> (Vec<f64>, NewOrgans) {
    let skull = figure.inverse_bind[Bone::Skull.index()].inverse();
    let origin = skull.translation - SKULL_IN_HEAD_M;
    let head = figure.meshes.iter().find(|m| m.name == "head");
    let places = head.expect("a head").positions[..VERTICES].iter();
    let skin = places.flat_map(|p| {
        let p = DVec3::from_array(p.map(f64::from)) - origin;
        (p * 1.03).to_array()
    });
    let mut eye_centres = [DVec3::ZERO; 2];
    for (joint, bind) in figure.skeleton.joints().iter().zip(&figure.inverse_bind) {
        if let Drive::Eye(side) = joint.drive {
            eye_centres[side.index()] = (bind.inverse().translation - origin) * 1.03;
        }
    }
    let organs = NewOrgans {
        eye_centres,
        lid_closure_rad: figure.lid_closure_rad,
        chin: -0.085,
    };
    (skin.collect(), organs)
}

#[test]
fn a_file_holds_face_hair_and_paint_and_is_read_as_any_figure() {
    let sofia = read_figure("sofia", SOFIA).expect("a figure");
    let (skin, organs) = larger(&sofia);
    let look: Look = serde_json::from_str(
        r#"{ "beard": { "from": "papous" }, "wear": [{ "kind": "round-glasses", "colour": [0.1, 0.1, 0.1] }] }"#,
    )
    .expect("a look");
    let paint = Image {
        mime_type: "image/jpeg".to_owned(),
        bytes: b"\xff\xd8painted".to_vec(),
    };
    let parts = || FaceFile {
        name: "ida",
        glb: SOFIA,
        face: NewFace::from_numbers(&skin, &[], organs),
        look: &look,
        lenders: vec![("papous".to_owned(), PAPOUS.to_vec())],
        skin: Some(paint.clone()),
    };
    let glb = face_file(parts()).expect("a file");
    assert!(
        glb == face_file(parts()).expect("the same file"),
        "the same parts make the same file"
    );
    let ida = read_figure("ida", &glb).expect("a figure");
    let has = |name: &str| ida.meshes.iter().any(|m| m.name == name);
    assert!(
        has("beard") && has("glasses") && has("hair"),
        "beard, glasses and hair are in the figure"
    );
    let picture = ida.meshes[0].material.maps.base_color.expect("a picture");
    assert_eq!(ida.images[picture], paint);
    assert_eq!(ida.images.len(), sofia.images.len());
    assert!(
        ida.tissue.is_some() && !ida.springs.is_empty(),
        "the figure has tissue and springs"
    );
    // The names keep their positions, and the skin is at the position of the face.
    let names = |glb: &[u8]| annotations(glb).expect("names");
    assert_eq!(names(&glb), names(SOFIA));
    let (again, _) = larger(&ida);
    let pairs = again.as_chunks::<3>().0.iter().zip(skin.as_chunks::<3>().0);
    // The neck merges into that of the body.
    for (now, wanted) in pairs.filter(|(_, wanted)| wanted[1] > -0.05) {
        let off = DVec3::from_array(*now) / 1.03 - DVec3::from_array(*wanted);
        assert!(off.length() < 5e-4, "{wanted:?} {off}");
    }
    assert!(
        ida.meshes
            .iter()
            .any(|m| m.material.kind == MaterialKind::Skin),
        "the figure has skin"
    );
}

#[test]
fn what_cannot_be_written_is_named() {
    let sofia = read_figure("sofia", SOFIA).expect("a figure");
    let (skin, organs) = larger(&sofia);
    let told = |glb: &[u8], skin: &[f64], look: &str| {
        let look: Look = serde_json::from_str(look).expect("a look");
        let made = face_file(FaceFile {
            name: "it",
            glb,
            face: NewFace::from_numbers(skin, &[], organs),
            look: &look,
            lenders: Vec::new(),
            skin: None,
        });
        made.expect_err("a fault").to_string()
    };
    assert!(
        told(&SOFIA[..5000], &skin, "{}").len() > 10,
        "the error for a truncated face has a message"
    );
    assert!(
        told(SOFIA, &skin[300..], "{}").contains("head"),
        "the error names the missing head"
    );
    let stranger = r#"{ "hair": { "from": "nobody" } }"#;
    assert!(
        told(SOFIA, &skin, stranger).contains("nobody"),
        "the error names the unknown person"
    );
}

//! Edits of faces on a plane.

use raconteur_base::{noise, ops};

use super::*;
use crate::age_model::AgeModel;
use crate::attribute::Attribute;
use crate::pack::{DependentNumbers, LookNumber, TextureModel};
use crate::sample::labelled;
use crate::segment::{Half, Segment, Segments};

const SIDE: usize = 60;
const VERTICES: usize = SIDE * SIDE;

/// Smooth waves over the plane, a random sum for each face.
fn faces(count: u64, seed: u64) -> Vec<Vec<f64>> {
    let wave = |face: u64, k: usize| noise::signed(seed, face, k as i64) / (1.0 + k as f64);
    let value = |face: u64, v: usize, axis: usize| -> f64 {
        let at = [v % SIDE, v / SIDE].map(|x| x as f64 / SIDE as f64);
        (0..8)
            .map(|k| {
                let [x, y] = at;
                let phase = 6.0 * (x * (k % 3) as f64 + y * (k / 3) as f64) + axis as f64;
                0.002 * wave(face, k) * ops::sin(phase)
            })
            .sum()
    };
    let place = |v: usize, axis: usize| match axis {
        0 => 0.003 * ((v % SIDE) as f64 - SIDE as f64 / 2.0 + 0.5),
        1 => 0.003 * (v / SIDE) as f64,
        _ => 0.0,
    };
    let face = |face: u64| {
        let all = (0..VERTICES).flat_map(|v| (0..3).map(move |axis| (v, axis)));
        all.map(|(v, axis)| place(v, axis) + value(face, v, axis))
            .collect()
    };
    (0..count).map(face).collect()
}

fn segment(name: &str, parent: Option<u32>, rows: core::ops::Range<usize>) -> Segment {
    Segment {
        name: name.to_owned(),
        parent,
        runs: vec![[(rows.start * SIDE) as u32, (rows.len() * SIDE) as u32]],
    }
}

fn named(attribute: Attribute) -> NamedAttribute {
    NamedAttribute {
        feature: None,
        group: "mouth".to_owned(),
        terms: ["less".to_owned(), "more".to_owned()],
        derived: None,
        attribute,
    }
}

fn learned(space: &FaceSpace, all: &[Vec<f64>]) -> Vec<NamedAttribute> {
    let learn = |seed: u64| {
        let (own, labels) = labelled(space, all, seed);
        let name = format!("attribute {seed}");
        named(Attribute::learn(&name, space, &own, &labels).expect("a direction"))
    };
    (0..3).map(learn).collect()
}

/// Of faces that are planes.
pub(crate) fn editor() -> Editor {
    let shapes = faces(40, 1);
    let textures: Vec<Vec<f64>> = faces(40, 2)
        .into_iter()
        .zip(0..)
        .map(|(mut t, i)| {
            t.push(0.1 * noise::signed(4, i, 0));
            t
        })
        .collect();
    let [shape, space] = [&shapes, &textures].map(|all| FaceSpace::learn(all).expect("faces"));
    let own = |space: &FaceSpace, all: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let all = all.iter().map(|f| space.coefficients(f));
        all.collect::<Result<_, _>>().expect("corresponding")
    };
    let [examples, looks] = [own(&shape, &shapes), own(&space, &textures)];
    let organs: Vec<Vec<f64>> = shapes
        .iter()
        .map(|f| (0..9).map(|k| f[3 * (190 * k + 7) + 2]).collect())
        .collect();
    let at = |x: usize, y: usize| (y * SIDE + x) as u32;
    let squares = (0..SIDE - 1).flat_map(|y| (0..SIDE - 1).map(move |x| (x, y)));
    let triangles = squares.flat_map(|(x, y)| {
        let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        [[a, b, c], [b, d, c]]
    });
    let segments = vec![
        segment("face", None, 0..20),
        segment("eyes and lids", Some(0), 20..22),
        segment("nose", Some(0), 22..40),
        segment("chin tip", Some(0), 40..60),
    ];
    let texture = TextureModel {
        looks: vec![LookNumber {
            name: "lightness of the iris".to_owned(),
            weight: 1.0,
        }],
        attributes: learned(&space, &textures),
        life: AgeModel::default(),
        figures: vec![("sofia".to_owned(), looks[3].clone())],
        examples: looks,
        space,
    };
    Editor::new(FaceModel {
        reference: Vec::new(),
        cage: DependentNumbers::default(),
        organs: DependentNumbers::learn(&shape, &examples, &organs),
        triangles: triangles.collect(),
        segments: Segments::new(segments, VERTICES).expect("a hierarchy"),
        attributes: learned(&shape, &shapes),
        life: AgeModel::default(),
        people: Vec::new(),
        landmarks: Vec::new(),
        examples,
        shape,
        texture: Some(texture),
    })
    .expect("a mesh")
}

fn farthest(a: &[f64], b: &[f64], vertices: impl Iterator<Item = usize>) -> f64 {
    let off = |v: usize| (3 * v..3 * v + 3).map(move |k| (a[k] - b[k]).abs());
    vertices.flat_map(off).fold(0.0, f64::max)
}

#[test]
fn one_more_of_an_attribute_is_one_more_of_its_value() {
    let editor = editor();
    for part in [Part::Shape, Part::Texture] {
        let mut face = editor.example(7).expect("a face");
        for name in ["attribute 0", "attribute 2"] {
            let before = editor.value(&face, part, name).expect("an attribute");
            let change = editor.attribute_change(part, name, &Region::whole_head());
            face.add(&change.expect("an attribute"), 0.4);
            let after = editor.value(&face, part, name).expect("an attribute");
            assert!((after - before - 0.4).abs() < 1e-9, "{part:?} {name}");
        }
    }
}

#[test]
fn an_attribute_changes_alone_on_every_face() {
    let editor = editor();
    let names: Vec<String> = editor
        .attributes(Part::Shape)
        .iter()
        .map(|a| a.attribute.name.clone())
        .collect();
    let (first, kept) = names.split_first().expect("attributes");
    let kept: Vec<&str> = kept.iter().map(String::as_str).collect();
    let change = editor.change_alone(Part::Shape, first, &kept).expect("it");
    for seed in 0..20 {
        let mut face = editor.random(seed);
        let value = |face: &Face, name: &str| editor.value(face, Part::Shape, name).expect("it");
        let before: Vec<f64> = names.iter().map(|n| value(&face, n)).collect();
        face.add(&change, 0.7);
        for (i, (name, before)) in names.iter().zip(before).enumerate() {
            let wanted = if i == 0 { 0.7 } else { 0.0 };
            let now = value(&face, name) - before;
            assert!((now - wanted).abs() < 1e-6, "{name} {now}");
        }
    }
    let none = editor.change_alone(Part::Shape, "moustache", &[]);
    assert!(
        none.expect_err("none").to_string().contains("moustache"),
        "the error names the missing attribute"
    );
}

#[test]
fn a_segment_changes_and_the_far_rest_does_not() {
    let editor = editor();
    let region = editor.region(&["nose"], None).expect("a segment");
    let before = editor.average();
    let other = editor.example(5).expect("a face");
    let mut face = before.clone();
    editor.import(&mut face, &other, Part::Shape, &region);
    let rows =
        |rows: core::ops::Range<usize>| rows.flat_map(|r| (0..SIDE).map(move |c| r * SIDE + c));
    // In the middle, the segment is the other's; 10 rows beyond the blended border, it is
    // unchanged.
    assert!(
        farthest(&face.shape, &other.shape, rows(30..32)) < 2e-4,
        "the edited segment is near the other face"
    );
    assert!(
        farthest(&face.shape, &before.shape, rows(0..12)) < 0.05e-3,
        "the first distant part is unchanged"
    );
    assert!(
        farthest(&face.shape, &before.shape, rows(50..60)) < 0.05e-3,
        "the second distant part is unchanged"
    );
    assert_eq!(face.texture, before.texture);
    // The eyes are next to it: their centres hardly move with it, the chin less.
    let go = |i: usize| (face.organs[i] - before.organs[i]) / (other.organs[i] - before.organs[i]);
    assert!(go(0) < 0.6 && go(8).abs() < 0.2, "{} {}", go(0), go(8));
}

#[test]
fn halves_are_apart_and_a_move_is_one() {
    let editor = editor();
    let left = editor
        .region(&["nose"], Some(Half::Left))
        .expect("a segment");
    let before = editor.average();
    let mut face = before.clone();
    let up = Affine {
        translation_m: [0.0, 0.0, 0.01],
        ..Affine::NONE
    };
    editor.transform(&mut face, &up, &left);
    let at = |row: usize, column: usize| 3 * (row * SIDE + column) + 2;
    let by = |i: usize| face.shape[i] - before.shape[i];
    assert!((by(at(31, 50)) - 0.01).abs() < 1e-3, "{}", by(at(31, 50)));
    assert!(by(at(31, 10)).abs() < 0.05e-3, "{}", by(at(31, 10)));
    let mut turned = before.clone();
    let round = Affine {
        turn_rad: [0.0, 0.0, core::f64::consts::TAU],
        scale: [1.0; 3],
        translation_m: [0.0; 3],
    };
    editor.transform(&mut turned, &round, &Region::whole_head());
    assert!(
        farthest(&turned.shape, &before.shape, 0..VERTICES) < 1e-12,
        "a full turn restores the shape"
    );
}

#[test]
fn caricature_and_detail_are_of_one_part() {
    let editor = editor();
    let before = editor.example(9).expect("a face");
    let mut face = before.clone();
    editor.caricature(&mut face, Part::Shape, 1.5, &Region::whole_head());
    let [own, more] = [&before, &face].map(|f| editor.coefficients(f, Part::Shape).expect("ours"));
    for (a, b) in own.iter().zip(&more) {
        assert!(
            (b - 1.5 * a).abs() < 1e-9,
            "the caricature scales the difference by 1.5"
        );
    }
    assert_eq!(face.texture, before.texture);
    let mut sharp = before.clone();
    editor.add_detail(&mut sharp, &before, Part::Texture, USUAL_DETAIL);
    assert!(
        sharp.shape == before.shape && sharp.texture != before.texture,
        "detail changes the texture and not the shape"
    );
    editor.add_detail(&mut sharp, &before, Part::Texture, -USUAL_DETAIL);
    assert!(
        farthest(&sharp.texture, &before.texture, 0..VERTICES) < 1e-12,
        "the opposite detail restores the texture"
    );
}

#[test]
fn constraints_hold_in_segments_through_random_edits() {
    let editor = editor();
    let nose = editor.region(&["nose"], None).expect("a segment");
    let held = |name: &str, value: f64, region: &Region| Constraint {
        part: Part::Shape,
        name: name.to_owned(),
        value,
        region: region.clone(),
    };
    let all = [
        held("attribute 0", 0.5, &nose),
        held("attribute 1", -0.2, &Region::whole_head()),
    ];
    let mut face = editor.example(2).expect("a face");
    for edit in 0..100 {
        let name = format!("attribute {}", edit % 3);
        let change = editor.attribute_change(Part::Shape, &name, &Region::whole_head());
        face.add(&change.expect("an attribute"), noise::signed(8, 1, edit));
        editor.constrain(&mut face, &all).expect("they agree");
        for constraint in &all {
            let value = editor.value(&face, Part::Shape, &constraint.name);
            assert!(
                (value.expect("an attribute") - constraint.value).abs() < 1e-9,
                "the constraint holds after each edit"
            );
        }
    }
    let against = [all[0].clone(), held("attribute 0", 0.9, &nose)];
    let before = face.clone();
    let told = editor
        .constrain(&mut face, &against)
        .expect_err("it cannot be");
    assert!(told.to_string().contains("attribute 0 at 0.90"), "{told}");
    assert_eq!(face, before);
}

/// The remaining freedom beside the constraints is orthogonal to the change, in standard
/// deviations: no other face that meets them is nearer.
#[test]
fn constraints_change_a_face_as_little_as_can_be_in_deviations() {
    let editor = editor();
    let whole = |value: f64| -> Vec<Constraint> {
        let one = |k: u64| Constraint {
            part: Part::Shape,
            name: format!("attribute {k}"),
            value,
            region: Region::whole_head(),
        };
        (0..3).map(one).collect()
    };
    let own = |face: &Face| editor.coefficients(face, Part::Shape).expect("ours");
    let mut face = editor.example(0).expect("a face");
    let before = own(&face);
    editor
        .constrain(&mut face, &whole(0.5))
        .expect("they agree");
    let change: Vec<f64> = own(&face).iter().zip(&before).map(|(a, b)| a - b).collect();
    for seed in 0..20 {
        let mut other = editor.random(seed);
        editor
            .constrain(&mut other, &whole(0.0))
            .expect("they agree");
        let product = editor.model().shape.product(&change, &own(&other));
        assert!(product.abs() < 1e-9, "{seed}: {product}");
    }
}

#[test]
fn a_figure_s_own_texture_changes_nothing_of_it() {
    let editor = editor();
    let texture = editor.model().texture.as_ref().expect("textures");
    let own = texture.space.face(&texture.figures[0].1);
    let factors = texture.factors(&own, "sofia").expect("known");
    assert!(
        factors.skin.iter().all(|f| (f - 1.0).abs() < 1e-12),
        "the own texture has factors of 1"
    );
    assert_eq!(factors.skin.len(), 3 * VERTICES);
    assert_eq!(texture.factors(&own, "nobody"), None);
}

#[test]
fn what_there_is_not_is_named() {
    let editor = editor();
    let face = editor.average();
    let told = [
        editor
            .example(99)
            .map(|_| ())
            .expect_err("none")
            .to_string(),
        editor
            .region(&["beak"], None)
            .map(|_| ())
            .expect_err("none")
            .to_string(),
        editor
            .value(&face, Part::Shape, "glow")
            .map(|_| ())
            .expect_err("none")
            .to_string(),
    ];
    assert!(
        told[0].contains("no face 99") && told[1].contains("beak") && told[2].contains("glow"),
        "the errors name the missing face, segment and attribute"
    );
}

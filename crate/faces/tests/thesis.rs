//! Observations of F&H about their model, checked in this one.

mod common;

use raconteur_faces::{Constraint, Editor, Face, Part, Region};

fn add(editor: &Editor, face: &mut Face, name: &str, amount: f64) {
    let change = editor.attribute_change(Part::Shape, name, &Region::whole_head());
    face.add(&change.expect("an attribute"), amount);
}

fn value(editor: &Editor, face: &Face, name: &str) -> f64 {
    editor.value(face, Part::Shape, name).expect("an attribute")
}

/// Figure 5.3: a narrow mouth brings a smaller nose and rounder eyes. The longer face oval of the
/// figure does not appear with these examples, whose heads keep the breadth given by surveys.
#[test]
fn features_go_together_as_they_do_in_people() {
    let editor = common::editor();
    let mut face = editor.average();
    let name = "width of the mouth";
    let change = editor.change_with_all(Part::Shape, name, &Region::whole_head());
    face.add(&change.expect("an attribute"), -1.0);
    let of = |name: &str| value(&editor, &face, name);
    assert!(
        of("breadth of the alar wings") < -0.1,
        "the alar wings become narrower"
    );
    assert!(of("length of the nose") < -0.1, "the nose becomes shorter");
    assert!(of("opening of the eyes") > 0.05, "the eyes open wider");
}

/// A change of one slider leaves the other features close to their values.
#[test]
fn features_change_apart() {
    let editor = common::editor();
    let whole = Region::whole_head();
    let features: Vec<&str> = editor
        .attributes(Part::Shape)
        .iter()
        .filter(|a| {
            a.derived.is_none() && !["overall", "ethnicity", "life"].contains(&a.group.as_str())
        })
        .map(|a| a.attribute.name.as_str())
        .collect();
    let others = |face: &Face, name: &str| -> f64 {
        let square = |other: &&&str| value(&editor, face, other).powi(2);
        features
            .iter()
            .filter(|n| **n != name)
            .map(|n| square(&n))
            .sum()
    };
    let (mut sums, mut worse) = ([0.0; 2], 0);
    for name in &features {
        let changed = |change: Result<_, _>| {
            let mut face = editor.average();
            face.add(&change.expect("an attribute"), 1.0);
            assert!(
                (value(&editor, &face, name) - 1.0).abs() < 1e-6,
                "the attribute changes by 1"
            );
            others(&face, name)
        };
        let apart = changed(editor.attribute_change(Part::Shape, name, &whole));
        let with_all = changed(editor.change_with_all(Part::Shape, name, &whole));
        sums = [sums[0] + apart, sums[1] + with_all];
        worse += usize::from(apart >= with_all);
    }
    // Features measured relative to the height of the face change with others of that kind.
    assert!(worse <= 3, "{worse}");
    assert!(sums[0] < 0.5 * sums[1], "{sums:?}");
}

/// Figure 3.8: other brows make a face look like the other sex, unless sex is constrained.
#[test]
fn a_held_sex_stays_while_the_brows_rise() {
    let editor = common::editor();
    let brows = "distance between brows and eyes";
    let mut face = editor.average();
    add(&editor, &mut face, "sex", -0.6);
    let change = editor.change_with_all(Part::Shape, brows, &Region::whole_head());
    face.add(&change.expect("an attribute"), 0.8);
    assert!(
        (value(&editor, &face, "sex") + 0.6).abs() > 0.05,
        "the sex changes without a constraint"
    );
    let held = [("sex", -0.6), (brows, 0.8)].map(|(name, value)| Constraint {
        part: Part::Shape,
        name: name.to_owned(),
        value,
        region: Region::whole_head(),
    });
    editor.constrain(&mut face, &held).expect("they agree");
    assert!(
        (value(&editor, &face, "sex") + 0.6).abs() < 1e-4,
        "the constrained sex is unchanged"
    );
    assert!(
        (value(&editor, &face, brows) - 0.8).abs() < 1e-4,
        "the brows reach their value"
    );
}

/// Figure 5.8: the same four values over faces of the database.
#[test]
fn four_constraints_hold_over_the_database() {
    let editor = common::editor();
    let values = [
        ("weight", 0.5),
        ("width of the mouth", -0.4),
        ("distance of the brows", 0.3),
        ("length of the nose", 0.2),
    ];
    let held = values.map(|(name, value)| Constraint {
        part: Part::Shape,
        name: name.to_owned(),
        value,
        region: Region::whole_head(),
    });
    for index in 0..40 {
        let mut face = editor.example(index).expect("a face");
        let before = face.clone();
        editor.constrain(&mut face, &held).expect("they agree");
        for (name, wanted) in values {
            let found = value(&editor, &face, name);
            assert!((found - wanted).abs() < 1e-4, "{index} {name}: {found}");
        }
        assert!(face.shape != before.shape, "the edit changes the shape");
    }
}

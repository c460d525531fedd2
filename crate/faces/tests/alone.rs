//! Separate features: a feature moves its own segment, and the rest stays.

mod common;

use faer::Mat;
use raconteur_faces::{Editor, Face, Part, Region};

/// Twelve edits, and the segments in which each is meant.
const EDITS: [(&str, &[&str]); 12] = [
    ("length of the nose", &["nose"]),
    ("profile of the nose", &["nose"]),
    ("breadth of the alar wings", &["nose"]),
    ("cheekbones", &["cheeks"]),
    ("cheeks", &["cheeks"]),
    ("breadth of the chin", &["chin"]),
    ("curve of the left brow", &["eyes"]),
    ("distance of the eyes", &["eyes"]),
    ("opening of the eyes", &["eyes"]),
    ("width of the mouth", &["mouth"]),
    ("lips", &["mouth"]),
    ("size of the ears", &["ears"]),
];

/// Aligns one shape to another by rotation and translation (Kabsch 1976).
fn aligned(from: &[f64], to: &[f64]) -> Vec<f64> {
    let [from, to] = [from, to].map(|p| p.as_chunks::<3>().0);
    let count = from.len() as f64;
    let mean = |all: &[[f64; 3]]| -> [f64; 3] {
        core::array::from_fn(|k| all.iter().map(|p| p[k]).sum::<f64>() / count)
    };
    let (a, b) = (mean(from), mean(to));
    let both = Mat::<f64>::from_fn(3, 3, |i, j| {
        let pairs = from.iter().zip(to);
        pairs.map(|(p, q)| (p[i] - a[i]) * (q[j] - b[j])).sum()
    });
    let svd = both.thin_svd().expect("finite");
    let turn = svd.V() * svd.U().transpose();
    let at = |p: &[f64; 3], i: usize| -> f64 {
        (0..3).map(|k| turn[(i, k)] * (p[k] - a[k])).sum::<f64>() + b[i]
    };
    from.iter()
        .flat_map(|p| [0, 1, 2].map(|i| at(p, i)))
        .collect()
}

/// Returns the share of the squared displacement between two aligned shapes that lies within
/// segments.
fn inside(editor: &Editor, before: &Face, after: &Face, segments: &[&str]) -> f64 {
    let all = &editor.model().segments;
    let chosen: Vec<usize> = segments
        .iter()
        .map(|s| all.find(s).expect("a segment"))
        .collect();
    let mask = all.mask(&chosen, editor.model().vertices());
    let after = aligned(&after.shape, &before.shape);
    let ways = after
        .as_chunks::<3>()
        .0
        .iter()
        .zip(before.shape.as_chunks::<3>().0);
    let squares = ways.map(|(p, q)| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>());
    let [own, all] = squares
        .zip(&mask)
        .fold([0.0; 2], |[own, all], (square, share)| {
            [own + square * share, all + square]
        });
    own / all
}

#[test]
fn an_edit_of_a_feature_stays_in_its_segment_and_reaches_its_value() {
    let editor = common::editor();
    let mut wrong = Vec::new();
    for (name, segments) in EDITS {
        for amount in [-1.0, 1.0] {
            let before = editor.average();
            let mut after = before.clone();
            let change = editor.attribute_change(Part::Shape, name, &Region::whole_head());
            after.add(&change.expect("an attribute"), amount);
            let share = inside(&editor, &before, &after, segments);
            let value = editor.value(&after, Part::Shape, name);
            let value = value.expect("an attribute");
            if share < 0.8 || (value - amount).abs() > 1e-6 {
                wrong.push(format!(
                    "{name} {amount}: {share:.2} inside, value {value:.2}"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Every feature, tested on people other than the average.
#[test]
fn every_feature_reaches_its_value_alone_on_any_face() {
    let editor = common::editor();
    for named in editor.attributes(Part::Shape) {
        let Some(feature) = &named.feature else {
            continue;
        };
        let name = &named.attribute.name;
        let segments: Vec<&str> = feature.segments.iter().map(String::as_str).collect();
        for seed in 0..5 {
            let before = editor.random(seed);
            let mut after = before.clone();
            let change = editor.change_alone(Part::Shape, name, &[]);
            after.add(&change.expect("an attribute"), 0.5);
            let value = |face: &Face| editor.value(face, Part::Shape, name).expect("an attribute");
            let more = value(&after) - value(&before);
            assert!((more - 0.5).abs() < 1e-6, "{name} of {seed}: {more}");
            let share = inside(&editor, &before, &after, &segments);
            assert!(share > 0.6, "{name} of {seed}: {share}");
        }
    }
}

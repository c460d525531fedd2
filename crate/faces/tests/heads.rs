//! Parts of the shipped heads.

mod common;

use raconteur_faces::Part;

/// Parts that witnesses choose.
const PARTS: [&str; 7] = [
    "nose", "mouth", "eyes", "chin", "cheeks", "forehead", "ears",
];
/// Distance from a part at which the blend has ended, metres.
const BLEND_M: f64 = 0.045;

/// An imported part fades out softly, and nothing moves beyond the blend.
#[test]
fn beyond_its_blend_a_part_moves_nothing() {
    let editor = common::editor();
    let model = editor.model();
    let places = model.shape.mean().as_chunks::<3>().0;
    for name in PARTS {
        let index = model.segments.find(name).expect("a segment");
        let mask = model.segments.mask(&[index], model.vertices());
        let own: Vec<&[f64; 3]> = places
            .iter()
            .zip(&mask)
            .filter(|(_, m)| **m > 0.0)
            .map(|(p, _)| p)
            .collect();
        let square =
            |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>();
        let far: Vec<usize> = (0..places.len())
            .filter(|&v| {
                own.iter()
                    .all(|p| square(p, &places[v]) > BLEND_M * BLEND_M)
            })
            .collect();
        assert!(far.len() > 1000, "{name}: {}", far.len());
        let region = editor.region(&[name], None).expect("a segment");
        let mut most = 0.0_f64;
        for pair in 0..10 {
            let mut face = editor.example(31 * pair).expect("a head");
            let before = face.shape.clone();
            let from = editor.example(977 - 67 * pair).expect("a head");
            editor.import(&mut face, &from, Part::Shape, &region);
            let (a, b) = (before.as_chunks::<3>().0, face.shape.as_chunks::<3>().0);
            most = far
                .iter()
                .map(|&v| square(&a[v], &b[v]).sqrt())
                .fold(most, f64::max);
        }
        assert!(most < 0.05e-3, "{name}: {:.4} mm", 1e3 * most);
    }
}

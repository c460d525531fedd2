//! Invariants of every style.

use std::sync::OnceLock;

use raconteur_base::DVec3;

use super::*;
use crate::cells::Cells;
use crate::head;
use crate::part::PartVertex;
use crate::people::{NAMES, preset};
use raconteur_body::skeleton::{Bone, Drive};

/// The heads of the people with the hair they wear.
fn people() -> &'static [(Head, HairParams)] {
    static HEADS: OnceLock<Vec<(Head, HairParams)>> = OnceLock::new();
    HEADS.get_or_init(|| {
        NAMES
            .iter()
            .map(|n| {
                let p = preset(n).unwrap();
                (head::build(&p.person, &p.head), p.hair)
            })
            .collect()
    })
}

/// The room about each of their bare heads.
fn spaces() -> &'static [Space] {
    static SPACES: OnceLock<Vec<Space>> = OnceLock::new();
    SPACES.get_or_init(|| people().iter().map(|(h, _)| Space::new(h, &[])).collect())
}

/// Hair of one style on one head.
struct Worn {
    head: &'static Head,
    space: &'static Space,
    style: HairStyle,
    name: &'static str,
    grown: Grown,
}

impl Worn {
    fn cards(&self) -> impl Iterator<Item = &PartWithNormals> {
        self.grown.pieces.iter().filter(|p| p.part.name == "hair")
    }
}

/// Every style, each on a head that is not its wearer's; made once.
fn worn() -> &'static [Worn] {
    static WORN: OnceLock<Vec<Worn>> = OnceLock::new();
    WORN.get_or_init(|| {
        HairStyle::NAMES
            .iter()
            .enumerate()
            .map(|(i, &(style, name))| {
                let whose = (i + 2) % people().len();
                let (head, own) = &people()[whose];
                let p = HairParams {
                    style,
                    beard: None,
                    ..*own
                };
                Worn {
                    head,
                    space: &spaces()[whose],
                    style,
                    name,
                    grown: hair(head, &p, &[]),
                }
            })
            .collect()
    })
}

fn triangles(part: &MeshPart) -> usize {
    part.faces.iter().map(|f| f.len() - 2).sum()
}

#[test]
fn every_style_grows() {
    for w in worn() {
        let name = w.name;
        for piece in &w.grown.pieces {
            let part = &piece.part;
            let normals = piece.normals.as_ref().unwrap();
            assert_eq!(normals.len(), part.vertices.len());
            for (v, n) in part.vertices.iter().zip(normals) {
                assert!(v.position.is_finite() && n.is_finite(), "{name}");
                assert!(v.position.length() < 0.5, "{name} {}", v.position);
                let sum: f64 = v.weights.iter().map(|w| w.1).sum();
                assert!((sum - 1.0).abs() < 1e-9, "{name} {sum}");
                assert!(
                    v.uv.iter().chain(&v.color).all(|c| (0.0..=1.0).contains(c)),
                    "texture coordinates and colours are between 0 and 1"
                );
            }
        }
        let scalp: usize = w.cards().map(|p| triangles(&p.part)).sum();
        assert_eq!(scalp == 0, w.style == HairStyle::Bald, "{name} {scalp}");
        assert!(scalp <= 24_000, "{name} {scalp}");
        assert_eq!(w.grown.skin_light.len(), w.head.skin().vertices.len());
        assert!(
            w.grown.skin_light.iter().all(|l| (0.0..=1.0).contains(l)),
            "the light of the skin is between 0 and 1"
        );
    }
}

#[test]
fn hair_keeps_clear_of_the_skin() {
    for w in worn() {
        let space = w.space;
        for piece in w.cards() {
            // Middles of the rows; roots go into the skin.
            let rows = piece.part.vertices.chunks_exact(2);
            let heights: Vec<f64> = rows
                .filter(|r| r[0].uv[1] > 0.3)
                .map(|r| {
                    let at = (r[0].position + r[1].position) / 2.0;
                    space.whole.sample(space.frame.place(at))
                })
                .collect();
            let deep = heights.iter().filter(|h| **h < -0.0005).count();
            assert!(
                deep * 100 <= heights.len(),
                "{}: {deep} of {} in the skin",
                w.name,
                heights.len()
            );
        }
    }
}

#[test]
fn the_scalp_is_covered_from_all_sides() {
    /// Distance within which a card covers a position, metres.
    const COVERED_M: f64 = 0.022;
    // Above every point well inside the line there is a card, within the thickness of a style.
    for w in worn().iter().filter(|w| w.style != HairStyle::Bald) {
        let space = w.space;
        let line = Line::new(&HairParams {
            style: w.style,
            square: true,
            recession: 1.0,
            ..HairParams::default()
        });
        let rows: Vec<DVec3> = w
            .cards()
            .flat_map(|p| p.part.vertices.chunks_exact(2))
            .map(|r| space.frame.place((r[0].position + r[1].position) / 2.0))
            .collect();
        let cells = Cells::new(&rows, COVERED_M);
        let mut bare = 0;
        let wanted: Vec<DVec3> = space
            .skin
            .iter()
            .map(|s| s.position)
            .filter(|p| line.smooth_distance(*p) > 0.02 && space.height_without_ears(*p) < 0.002)
            .collect();
        for p in &wanted {
            let mut about = cells.neighbours(*p).map(|i| rows[i as usize]);
            let near = about.any(|r| r.distance_squared(*p) < COVERED_M * COVERED_M);
            bare += usize::from(!near);
        }
        assert!(
            bare * 50 <= wanted.len(),
            "{}: {bare} of {} bare",
            w.name,
            wanted.len()
        );
    }
}

#[test]
fn light_is_less_within_the_hair_than_on_it() {
    let bob = worn().iter().find(|w| w.style == HairStyle::Bob).unwrap();
    let light: Vec<f64> = bob
        .cards()
        .flat_map(|p| &p.part.vertices)
        .map(|v| v.color[3])
        .collect();
    let (inner, outer) = light.split_at(light.len() / 2);
    let mean = |l: &[f64]| l.iter().sum::<f64>() / l.len() as f64;
    assert!(
        mean(outer) > 1.15 * mean(inner),
        "{} {}",
        mean(inner),
        mean(outer)
    );
}

#[test]
fn beards_leave_the_lips_free() {
    for (head, own) in people() {
        let p = HairParams {
            style: HairStyle::Bald,
            beard: Some(BeardParams {
                length_m: 0.02,
                cut: BeardCut::Full,
                density: 1.0,
            }),
            ..*own
        };
        let pieces = hair(head, &p, &[]).pieces;
        let beard = pieces.iter().find(|p| p.part.name == "beard").unwrap();
        for row in beard.part.vertices.chunks_exact(2) {
            let root = (row[0].position + row[1].position) / 2.0;
            let lip = head
                .scalp
                .lips
                .iter()
                .map(|l| l.distance(root))
                .fold(f64::MAX, f64::min);
            assert!(row[0].uv[1] > 0.0 || lip > 5e-4, "{lip}");
        }
        // The beard opens with the jaw: parts on the chin move with it.
        let jaw = |v: &PartVertex| {
            let chin = Drive::Bone(Bone::Chin);
            v.weights
                .iter()
                .filter(|w| w.0.0 == chin)
                .map(|w| w.1)
                .sum::<f64>()
        };
        assert!(
            beard.part.vertices.iter().any(|v| jaw(v) > 0.95),
            "the beard follows the jaw"
        );
        assert!(!beard.part.morphs.is_empty(), "the beard has morph targets");
    }
}

#[test]
fn the_same_seed_grows_the_same_hair() {
    let (head, own) = &people()[2];
    let bytes = |p: &HairParams| -> Vec<u64> {
        hair(head, p, &[])
            .pieces
            .iter()
            .flat_map(|p| &p.part.vertices)
            .flat_map(|v| v.position.to_array().map(f64::to_bits))
            .collect()
    };
    assert_eq!(bytes(own), bytes(own));
    assert_ne!(bytes(own), bytes(&HairParams { seed: 12, ..*own }));
}

#[test]
fn recession_moves_the_line_back() {
    let line = |recession| {
        Line::new(&HairParams {
            recession,
            ..HairParams::default()
        })
    };
    let (young, old) = (line(0.0), line(1.0));
    let temple = DVec3::new(0.045, 0.065, 0.06);
    assert!(
        old.smooth_distance(temple) < young.smooth_distance(temple) - 0.01,
        "the hairline of the temple recedes"
    );
    let back = DVec3::new(0.0, 0.0, -0.09);
    assert!(
        (old.smooth_distance(back) - young.smooth_distance(back)).abs() < 1e-9,
        "the hairline of the back stays in place"
    );
}

#[test]
fn melanin_darkens_and_grey_lightens() {
    let tone = |eumelanin: f64, grey: f64| {
        HairColour {
            eumelanin,
            pheomelanin: 0.05,
            grey,
        }
        .linear_rgb()
    };
    for i in 0..3 {
        assert!(
            tone(0.1, 0.0)[i] > tone(0.4, 0.0)[i],
            "more melanin darkens light hair"
        );
        assert!(
            tone(0.4, 0.0)[i] > tone(1.5, 0.0)[i],
            "more melanin darkens brown hair"
        );
        assert!(
            tone(0.4, 0.9)[i] > tone(0.4, 0.2)[i],
            "grey lightens the hair"
        );
        assert!(
            (0.0..=1.0).contains(&tone(0.0, 0.0)[i]),
            "the lightest tone is between 0 and 1"
        );
    }
    // Red hair is redder than brown.
    let red = HairColour {
        eumelanin: 0.1,
        pheomelanin: 0.5,
        grey: 0.0,
    }
    .linear_rgb();
    let brown = tone(0.4, 0.0);
    assert!(
        red[0] / red[2] > brown[0] / brown[2],
        "red hair has more red than brown hair"
    );
}

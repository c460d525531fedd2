//! What must hold for every style on every head.

use std::sync::OnceLock;

use raconteur_base::DVec3;

use super::ground::{EAR_MARGIN, Ground};
use super::*;
use crate::generator::head;
use crate::generator::part::Part;
use crate::generator::people::{NAMES, preset};

/// The heads of the three people with the hair they wear.
fn people() -> &'static [(Head, HairParams)] {
    static HEADS: OnceLock<Vec<(Head, HairParams)>> = OnceLock::new();
    HEADS.get_or_init(|| {
        NAMES
            .iter()
            .map(|n| {
                let p = preset(n).unwrap();
                (head::build(&p.head), p.hair)
            })
            .collect()
    })
}

/// A body that is never near.
fn away(p: DVec3) -> (f64, DVec3) {
    (1.0, p.normalize_or_zero())
}

fn corners(t: &[u32], part: &Part) -> f64 {
    let p = |i: usize| part.vertices[t[i] as usize].position;
    (p(1) - p(0)).cross(p(2) - p(0)).length()
}

fn triangles(part: &Part) -> usize {
    part.faces.iter().map(|f| f.len() - 2).sum()
}

#[test]
fn every_style_grows_on_every_head() {
    for (head, own) in people() {
        for (style, name) in HairStyle::NAMES {
            let p = HairParams { style, ..*own };
            let pieces = hair(head, &p, &away);
            for piece in &pieces {
                let part = &piece.part;
                assert_eq!(
                    piece.normals.as_ref().map(Vec::len),
                    Some(part.vertices.len())
                );
                for (v, n) in part.vertices.iter().zip(piece.normals.iter().flatten()) {
                    assert!(v.position.is_finite() && n.is_finite(), "{name}");
                    assert!(v.position.length() < 0.5, "{name} {}", v.position);
                    let sum: f64 = v.weights.iter().map(|w| w.1).sum();
                    assert!((sum - 1.0).abs() < 1e-9, "{name} {sum}");
                    assert!(v.uv.iter().all(|c| (0.0..=1.0).contains(c)));
                }
                assert!(part.faces.iter().all(|f| corners(f, part) >= 0.0));
            }
            let scalp: usize = pieces
                .iter()
                .filter(|p| p.part.name == "hair")
                .map(|p| triangles(&p.part))
                .sum();
            assert_eq!(scalp == 0, style == HairStyle::Bald, "{name} {scalp}");
        }
    }
}

#[test]
fn hair_keeps_within_its_budget() {
    for (head, own) in people() {
        for (style, name) in HairStyle::NAMES {
            let p = HairParams { style, ..*own };
            let pieces = hair(head, &p, &away);
            let lash = head
                .parts
                .iter()
                .filter(|p| p.material.kind == MaterialKind::Lash);
            let parts = || pieces.iter().map(|p| &p.part).chain(lash.clone());
            let faces: usize = parts().map(triangles).sum();
            let vertices: usize = parts().map(|p| p.vertices.len()).sum();
            assert!(faces <= 16_000, "{name} {faces}");
            let bytes = 25 * vertices + 6 * faces;
            assert!(bytes <= 400_000, "{name} {bytes}");
            // What a beard's morphs take: index, position, normal.
            let moved: usize = pieces
                .iter()
                .flat_map(|p| &p.part.morphs)
                .map(|m| m.deltas.len())
                .sum();
            assert!(moved * 9 <= 160_000, "{name} {moved}");
        }
    }
}

#[test]
fn hair_keeps_clear_of_skin_and_ears() {
    for (head, own) in people() {
        let ground = Ground::new(head, &away);
        for (style, name) in HairStyle::NAMES {
            let p = HairParams { style, ..*own };
            for piece in hair(head, &p, &away)
                .iter()
                .filter(|p| p.part.name == "hair")
            {
                // Middles of the rows; roots go into the skin and sides bend round the head.
                let v = &piece.part.vertices;
                let mut deep = 0;
                let mut count = 0;
                for row in v.chunks_exact(2).filter(|r| r[0].uv[1] > 0.3) {
                    let at = (row[0].position + row[1].position) / 2.0;
                    count += 1;
                    let low = ground.skin.height(at).is_some_and(|(h, _)| h < 0.0002);
                    deep += usize::from(low);
                    let ear = head.scalp.ears.iter().any(|e| {
                        let d = (at - e.centre) / (e.radii + DVec3::splat(0.2 * EAR_MARGIN));
                        d.length_squared() < 0.8
                    });
                    assert!(!ear, "{name} {at}");
                }
                assert!(deep * 200 <= count, "{name}: {deep} of {count}");
            }
        }
    }
}

#[test]
fn beards_leave_the_lips_free() {
    for (head, own) in people() {
        let p = HairParams {
            beard: Some(BeardParams {
                length_m: 0.02,
                moustache: true,
            }),
            ..*own
        };
        let pieces = hair(head, &p, &away);
        let beard = pieces.iter().find(|p| p.part.name == "beard").unwrap();
        for root in beard.part.vertices.iter().filter(|v| v.uv[1] == 0.0) {
            let lip = head
                .scalp
                .lips
                .iter()
                .map(|l| l.distance(root.position))
                .fold(f64::MAX, f64::min);
            assert!(lip > 5e-4, "{lip}");
        }
        // It opens with the jaw: what hangs on the chin moves with it.
        let jaw = |v: &crate::generator::part::PartVertex| {
            let chin = crate::skeleton::Drive::Bone(crate::skeleton::Bone::Chin);
            v.weights
                .iter()
                .filter(|w| w.0.0 == chin)
                .map(|w| w.1)
                .sum::<f64>()
        };
        assert!(beard.part.vertices.iter().any(|v| jaw(v) > 0.95));
        assert!(!beard.part.morphs.is_empty());
    }
}

#[test]
fn the_same_seed_grows_the_same_hair() {
    let (head, own) = &people()[0];
    let bytes = |p: &HairParams| -> Vec<u64> {
        hair(head, p, &away)
            .iter()
            .flat_map(|p| &p.part.vertices)
            .flat_map(|v| v.position.to_array().map(f64::to_bits))
            .collect()
    };
    assert_eq!(bytes(own), bytes(own));
    assert_ne!(bytes(own), bytes(&HairParams { seed: 12, ..*own }));
}

#[test]
fn recession_and_thinning_uncover_the_scalp() {
    let (head, own) = &people()[0];
    let covered = |p: &HairParams| cover(head, p).iter().sum::<f64>();
    let full = covered(own);
    let old = HairParams {
        recession: 0.8,
        thinning: 0.7,
        ..*own
    };
    assert!(covered(&old) < 0.93 * full, "{} {full}", covered(&old));
    let bald = HairParams {
        style: HairStyle::Bald,
        ..*own
    };
    assert_eq!(covered(&bald), 0.0);
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
        assert!(tone(0.1, 0.0)[i] > tone(0.4, 0.0)[i]);
        assert!(tone(0.4, 0.0)[i] > tone(1.5, 0.0)[i]);
        assert!(tone(0.4, 0.9)[i] > tone(0.4, 0.2)[i]);
        assert!((0.0..=1.0).contains(&tone(0.0, 0.0)[i]));
    }
    // Red hair is redder than brown.
    let red = HairColour {
        eumelanin: 0.1,
        pheomelanin: 0.5,
        grey: 0.0,
    }
    .linear_rgb();
    let brown = tone(0.4, 0.0);
    assert!(red[0] / red[2] > brown[0] / brown[2]);
}

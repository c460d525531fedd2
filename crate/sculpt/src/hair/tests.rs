//! What must hold for every style on every head.

use std::sync::OnceLock;

use raconteur_base::DVec3;

use super::ground::Ground;
use super::*;
use crate::head;
use crate::part::MeshPart;
use crate::people::{NAMES, preset};

/// The heads of the people with the hair they wear.
fn people() -> &'static [(Head, HairParams)] {
    static HEADS: OnceLock<Vec<(Head, HairParams)>> = OnceLock::new();
    HEADS.get_or_init(|| {
        NAMES
            .iter()
            .map(|n| {
                let p = preset(n).unwrap();
                (
                    head::build(&p.person, &p.head, p.hair.colour.linear_rgb()),
                    p.hair,
                )
            })
            .collect()
    })
}

/// Hair of one style on one head.
struct Grown {
    head: &'static Head,
    own: &'static HairParams,
    style: HairStyle,
    name: &'static str,
    pieces: Vec<Piece>,
}

/// Every style on every head, made once.
fn grown() -> &'static [Grown] {
    static GROWN: OnceLock<Vec<Grown>> = OnceLock::new();
    GROWN.get_or_init(|| {
        let mut all = Vec::new();
        for (head, own) in people() {
            for (style, name) in HairStyle::NAMES {
                let p = HairParams { style, ..*own };
                all.push(Grown {
                    head,
                    own,
                    style,
                    name,
                    pieces: hair(head, &p, &away),
                });
            }
        }
        all
    })
}

/// A body that is never near.
fn away(p: DVec3) -> (f64, DVec3) {
    (1.0, p.normalize_or_zero())
}

fn triangles(part: &MeshPart) -> usize {
    part.faces.iter().map(|f| f.len() - 2).sum()
}

#[test]
fn every_style_grows_on_every_head() {
    for g in grown() {
        let name = g.name;
        for piece in &g.pieces {
            let part = &piece.part;
            let normals = piece.normals.as_ref().unwrap();
            assert_eq!(normals.len(), part.vertices.len());
            for (v, n) in part.vertices.iter().zip(normals) {
                assert!(v.position.is_finite() && n.is_finite(), "{name}");
                assert!(v.position.length() < 0.5, "{name} {}", v.position);
                let sum: f64 = v.weights.iter().map(|w| w.1).sum();
                assert!((sum - 1.0).abs() < 1e-9, "{name} {sum}");
                assert!(v.uv.iter().all(|c| (0.0..=1.0).contains(c)));
            }
        }
        let scalp: usize = g
            .pieces
            .iter()
            .filter(|p| p.part.name == "hair")
            .map(|p| triangles(&p.part))
            .sum();
        assert_eq!(scalp == 0, g.style == HairStyle::Bald, "{name} {scalp}");
    }
}

#[test]
fn hair_keeps_within_its_budget() {
    for g in grown() {
        let name = g.name;
        let lash = g
            .head
            .parts
            .iter()
            .filter(|p| p.material.kind == MaterialKind::Lash);
        let parts = || g.pieces.iter().map(|p| &p.part).chain(lash.clone());
        let faces: usize = parts().map(triangles).sum();
        let vertices: usize = parts().map(|p| p.vertices.len()).sum();
        assert!(faces <= 16_000, "{name} {faces}");
        // A long style with a beard may take more than what people wear; 90,000 are brows and lashes.
        let most = if g.style == g.own.style {
            450_000
        } else {
            570_000
        };
        let bytes = 25 * vertices + 6 * faces;
        assert!(bytes <= most, "{name} {bytes}");
        // What a beard's morphs take: index, position, normal.
        let moved: usize = g
            .pieces
            .iter()
            .flat_map(|p| &p.part.morphs)
            .map(|m| m.deltas.len())
            .sum();
        assert!(moved * 9 <= 160_000, "{name} {moved}");
    }
}

#[test]
fn hair_keeps_clear_of_skin_and_ears() {
    for g in grown() {
        let name = g.name;
        let ground = Ground::new(g.head, &away);
        for piece in g.pieces.iter().filter(|p| p.part.name == "hair") {
            // Middles of the rows; roots go into the skin and sides bend round the head. A
            // share of rows of 0.38 is a quarter of the length: they are closer at the root.
            let (mut deep, mut through, mut count) = (0, 0, 0);
            let rows = piece.part.vertices.chunks_exact(2);
            for row in rows.filter(|r| r[0].uv[1] > 0.38) {
                let at = (row[0].position + row[1].position) / 2.0;
                let low = ground.skin.height(at).is_some_and(|(h, _)| h < 0.0002);
                let ear = g.head.scalp.ears.iter().any(|e| {
                    let d = (at - e.centre) / e.radii;
                    d.length_squared() < 0.8
                });
                count += 1;
                deep += usize::from(low);
                through += usize::from(ear);
            }
            assert!(deep * 100 <= count, "{name}: {deep} of {count} in the skin");
            assert!(
                through * 200 <= count,
                "{name}: {through} of {count} in an ear"
            );
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
        // It opens with the jaw: what hangs on the chin moves with it.
        let jaw = |v: &crate::part::PartVertex| {
            let chin = raconteur_body::skeleton::Drive::Bone(raconteur_body::skeleton::Bone::Chin);
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

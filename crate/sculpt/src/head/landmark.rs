//! Named points of head and face on the rendered surface.
//!
//! Names after Farkas 1994 and Kolar & Salter 1997; paired ones end in `_l` and `_r`. Most are
//! vertices of the cage, whose limit positions are rendered vertices of every head; those defined
//! as an extreme are searched.

use raconteur_base::{DVec3, Side};

use super::Shape;
use super::cage::{Key, Zone};

use Key::{Ear, Eye, Grid, Mouth};

/// Landmarks on the midline: standard name and cage vertex.
const MIDDLE: [(&str, Key); 31] = [
    ("tr", Grid(0, 0)),
    ("m", Grid(0, 2)),
    ("on", Grid(0, 3)),
    ("g", Grid(0, 4)),
    ("gl'", Grid(0, 5)),
    ("n", Grid(0, 6)),
    ("se", Grid(0, 7)),
    ("k", Grid(0, 8)),
    ("st", Grid(0, 9)),
    ("prn'", Grid(0, 10)),
    ("prn", Grid(0, 11)),
    ("c'", Grid(0, 12)),
    ("c", Grid(0, 13)),
    ("sn", Grid(0, 14)),
    ("ssn", Grid(0, 15)),
    ("ss", Grid(0, 16)),
    ("ls", Mouth(1, 0)),
    ("ls'", Mouth(3, 0)),
    ("sts", Mouth(4, 0)),
    ("sto", Mouth(5, 0)),
    ("sti", Mouth(4, 12)),
    ("li'", Mouth(3, 12)),
    ("li", Mouth(1, 12)),
    ("sl", Grid(0, 21)),
    ("spg", Grid(0, 22)),
    ("pg", Grid(0, 23)),
    ("gn", Grid(0, 24)),
    ("me", Grid(0, 25)),
    ("cv", Grid(0, 27)),
    ("lar", Grid(0, 28)),
    ("i", Grid(20, 12)),
];

/// Landmarks that occur on both sides: standard name and cage vertex.
const PAIRED: [(&str, Key); 50] = [
    ("ft", Grid(8, 3)),
    ("fmt", Grid(8, 4)),
    ("zy", Grid(10, 8)),
    ("zm", Grid(8, 10)),
    ("chk", Grid(8, 12)),
    ("go", Grid(11, 24)),
    ("go'", Grid(10, 24)),
    ("jw", Grid(8, 24)),
    ("id", Grid(6, 24)),
    ("tb", Grid(4, 24)),
    ("t", Grid(12, 9)),
    ("ms", Grid(15, 12)),
    ("ast", Grid(16, 8)),
    ("sc", Grid(4, 3)),
    ("sci", Eye(1, 4)),
    ("os", Grid(6, 4)),
    ("or", Grid(6, 8)),
    ("or'", Eye(1, 12)),
    ("mf", Grid(4, 6)),
    ("ek", Grid(8, 6)),
    ("en", Eye(5, 0)),
    ("en'", Eye(3, 0)),
    ("ex", Eye(5, 8)),
    ("ex'", Eye(3, 8)),
    ("ps", Eye(5, 4)),
    ("pi", Eye(5, 12)),
    ("cs", Eye(3, 4)),
    ("ci", Eye(3, 12)),
    ("al'", Grid(3, 11)),
    ("al", Grid(4, 12)),
    ("ac", Grid(5, 12)),
    ("sbal", Grid(1, 14)),
    ("nsa", Grid(2, 12)),
    ("nsl", Grid(3, 13)),
    ("nsb", Grid(3, 14)),
    ("c''", Grid(1, 13)),
    ("cph", Mouth(1, 2)),
    ("mlfs", Mouth(1, 4)),
    ("ch", Mouth(1, 6)),
    ("mvi", Mouth(1, 9)),
    ("nlf", Grid(5, 15)),
    ("mod", Grid(4, 18)),
    ("sa", Ear(4, 5)),
    ("sba", Ear(4, 14)),
    ("pa", Ear(4, 8)),
    ("pra", Ear(7, 0)),
    ("obs", Ear(3, 3)),
    ("obi", Ear(3, 15)),
    ("tu", Ear(4, 7)),
    ("atr", Ear(8, 14)),
];

/// Returns true if a vertex of the cage has a name.
pub(super) fn is_named(key: Key) -> bool {
    MIDDLE.iter().chain(&PAIRED).any(|(_, own)| *own == key)
}

fn farthest(shape: &Shape, keep: impl Fn(DVec3, Zone) -> bool, size: impl Fn(DVec3) -> f64) -> u32 {
    let mut best = (f64::MIN, 0);
    for (face, &zone) in shape.surface.faces.iter().zip(&shape.surface.zones) {
        for &v in face {
            let p = shape.positions[v as usize];
            if keep(p, zone) && size(p) > best.0 {
                best = (size(p), v);
            }
        }
    }
    best.1
}

/// Returns the landmarks: name and vertex of the rendered surface.
pub(super) fn landmarks(shape: &Shape) -> Vec<(String, u32)> {
    let vertex = |key, side| shape.surface.vertex_of(shape.cage.vertex(key, side));
    let mut all: Vec<(String, u32)> = Vec::new();
    for (name, key) in MIDDLE {
        if let Some(v) = vertex(key, Side::Left) {
            all.push((name.to_owned(), v));
        }
    }
    for (name, key) in PAIRED {
        for (side, end) in [(Side::Left, "l"), (Side::Right, "r")] {
            if let Some(v) = vertex(key, side) {
                all.push((format!("{name}_{end}"), v));
            }
        }
    }
    let skull = |z: Zone| matches!(z, Zone::Grid(..) | Zone::Crown);
    let glabella = shape.limit(Grid(0, 4), Side::Left);
    all.push((
        "v".to_owned(),
        farthest(shape, |p, z| skull(z) && p.x.abs() < 1.0, |p| p.y),
    ));
    all.push((
        "op".to_owned(),
        farthest(
            shape,
            |p, z| skull(z) && p.x.abs() < 1.0 && p.y > 0.0,
            |p| (p - glabella).length(),
        ),
    ));
    for (side, end) in [(Side::Left, "l"), (Side::Right, "r")] {
        all.push((
            format!("eu_{end}"),
            farthest(shape, |p, z| skull(z) && p.y > 35.0, |p| p.x * side.sign()),
        ));
    }
    all
}

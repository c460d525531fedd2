//! Coarser levels of hair: fewer cards with fewer spans. A simplifier would leave triangles that
//! are not strips. This module selects the cards to remove: those that receive least light, as
//! others hide them, evenly over the scalp.

use std::collections::BTreeMap;

use raconteur_base::DVec3;
use raconteur_body::figure::Mesh;

/// Levels of detail of hair cards: share of a card's spans that remain, and maximum number of
/// triangles of a mesh.
const LEVELS: [(f64, usize); 2] = [(0.6, 7_600), (0.3, 2_700)];

/// Hair card: its vertices lie row by row, two to a row.
struct Card {
    first: u32,
    rows: u32,
    /// Mean openness, 0..255.
    light: f64,
}

/// Finds the hair cards of a mesh, in the order of its vertices.
fn cards(mesh: &Mesh) -> Vec<Card> {
    let mut ends: Vec<(u32, u32)> = Vec::new();
    for t in mesh.indices.chunks_exact(3) {
        let (low, high) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
        match ends.last_mut() {
            Some((_, last)) if low <= *last => *last = high.max(*last),
            _ => ends.push((low, high)),
        }
    }
    ends.into_iter()
        .map(|(first, last)| {
            let vertices = first as usize..=last as usize;
            let count = (last - first + 1) as usize;
            let sum: f64 = mesh.colors[vertices].iter().map(|c| f64::from(c[3])).sum();
            Card {
                first,
                rows: count as u32 / 2,
                light: sum / count as f64,
            }
        })
        .collect()
}

/// Side of the cells of the scalp that lose cards alike, metres.
const CELL_M: f64 = 0.025;

/// Returns the cards in order of priority: the most lit card of each cell of the scalp, then the
/// next of each, so that no cell goes bald.
fn spread(mesh: &Mesh, cards: &[Card]) -> Vec<usize> {
    let cell =
        |c: &Card| mesh.positions[c.first as usize].map(|x| (f64::from(x) / CELL_M).floor() as i32);
    let mut by_light: Vec<usize> = (0..cards.len()).collect();
    by_light.sort_by(|&a, &b| cards[b].light.total_cmp(&cards[a].light).then(a.cmp(&b)));
    let mut taken: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    let mut ranked: Vec<(usize, usize)> = by_light
        .into_iter()
        .map(|i| {
            let rank = taken.entry(cell(&cards[i])).or_default();
            *rank += 1;
            (*rank, i)
        })
        .collect();
    ranked.sort_by_key(|(rank, _)| *rank);
    ranked.into_iter().map(|(_, i)| i).collect()
}

/// Returns the index lists of the levels of detail after the finest.
pub(super) fn coarser(mesh: &Mesh) -> Vec<Vec<u32>> {
    let levels = LEVELS.iter();
    levels
        .map(|&(share, most)| thinned(mesh, share, most))
        .collect()
}

/// Returns the triangles of a reduced set of cards: this share of a card's spans, and at most
/// `most` triangles.
pub(super) fn thinned(mesh: &Mesh, share: f64, most: usize) -> Vec<u32> {
    let cards = cards(mesh);
    let spans = |c: &Card| ((f64::from(c.rows - 1) * share).round() as u32).max(1);
    let mut room = most as u32;
    let mut kept = vec![false; cards.len()];
    for i in spread(mesh, &cards) {
        let wanted = 2 * spans(&cards[i]);
        if wanted > room {
            break;
        }
        room -= wanted;
        kept[i] = true;
    }
    let cards = cards.iter().zip(kept).filter(|(_, kept)| *kept);
    cards.flat_map(|(c, _)| strip(mesh, c, spans(c))).collect()
}

/// Returns the triangles of a card that is reduced to `spans` spans.
fn strip(mesh: &Mesh, card: &Card, spans: u32) -> Vec<u32> {
    let row = |i: u32| card.first + 2 * ((i * (card.rows - 1) + spans / 2) / spans);
    let at = |v: u32| DVec3::from_array(mesh.positions[v as usize].map(f64::from));
    (0..spans)
        .flat_map(|i| {
            let (a, b) = (row(i), row(i + 1));
            let face = (at(b) - at(a)).cross(at(a + 1) - at(a));
            let outward = DVec3::from_array(mesh.normals[a as usize].map(f64::from));
            if face.dot(outward) >= 0.0 {
                [a, b, b + 1, a, b + 1, a + 1]
            } else {
                [a, a + 1, b + 1, a, b + 1, b]
            }
        })
        .collect()
}

//! Fairing of noses. Heads are fitted to the population's measures by pulls at single points, which
//! leave a sharp ridge on the bridge of the nose and a notch at its root that no real nose has.

use anyhow::{Context as _, Result};
use raconteur_faces::{SoftMask, VertexNeighbours};
use raconteur_sculpt::examples::Example;

use super::crossing::WeldedSkin;

/// Segments in which skin is fair.
const FAIRED: [&str; 2] = ["nose root", "nose bridge"];
/// Number of times that the finest detail is removed there.
const TIMES: usize = 4;

/// Removes ridges and notches from the noses of heads.
pub(super) fn fair(examples: &mut [Example]) -> Result<()> {
    let first = examples.first().context("a head")?;
    let joined = WeldedSkin::weld(&first.skin, &first.triangles);
    let vertices = first.skin.len() / 3;
    let neighbours =
        VertexNeighbours::from_triangles(joined.triangles(), vertices).context("a skin")?;
    let runs = first.segments.iter().filter(|s| FAIRED.contains(&s.name));
    let mut mask = vec![0.0; vertices];
    for [start, count] in runs.flat_map(|s| &s.runs) {
        for v in *start..start + count {
            mask[joined.stands_for(v) as usize] = 1.0;
        }
    }
    let soft = neighbours.softened(&mask);
    for example in examples {
        take_detail(&mut example.skin, &neighbours, &soft, &joined);
    }
    Ok(())
}

fn take_detail(
    skin: &mut [f64],
    neighbours: &VertexNeighbours,
    soft: &SoftMask,
    joined: &WeldedSkin,
) {
    for _ in 0..TIMES {
        let detail = neighbours.detail(skin);
        for (v, (place, by)) in (0u32..).zip(
            skin.as_chunks_mut::<3>()
                .0
                .iter_mut()
                .zip(detail.as_chunks::<3>().0),
        ) {
            if joined.stands_for(v) != v {
                continue;
            }
            let share = soft.weight(v as usize);
            for (x, d) in place.iter_mut().zip(by) {
                *x -= share * d;
            }
        }
    }
    for v in 0..(skin.len() / 3) as u32 {
        let of = joined.stands_for(v) as usize;
        skin.copy_within(3 * of..3 * of + 3, 3 * v as usize);
    }
}

//! Generator of a face's tissue: nodes of its skin, muscles fitted between skull and skin, and
//! their obstacles (F&H section 3.1.2).

mod arch;
mod fit;
mod layout;
mod mouth;
#[cfg(test)]
mod tests;
mod warp;

use raconteur_base::{DAffine3, DVec3, Side};

use self::fit::Skin;
use self::layout::{FLUSH, Sheet};
pub(crate) use self::warp::Warp;
use super::head::{LipPlace, Soft, SoftNode};
use super::part::MeshPart;
use raconteur_tissue::Tissue;
use raconteur_tissue::tissue::Attachment;

/// Millimetres from mid-brow to chin on the mean head, by which other heads are measured.
const REFERENCE_MM: f64 = 131.0;

fn narrow(p: DVec3) -> [f32; 3] {
    p.to_array().map(|x| x as f32)
}

/// Returns a smooth step: 0 below `low`, 1 above `high`.
fn ramp(low: f64, high: f64, x: f64) -> f64 {
    raconteur_base::curve::smooth((x - low) / (high - low))
}

/// Returns the lateral stiffness of a node. Inside the corner of the mouth, where the rings of both
/// lips crowd, the lining follows its neighbours.
fn grip(node: &SoftNode) -> f64 {
    let is_fold = |lip: LipPlace| lip.ring >= 8 && (11..=13).contains(&lip.position);
    if node.lip.is_some_and(is_fold) {
        0.3
    } else {
        node.grip
    }
}

/// Builds the tissue of a head at `place` (world from head). `bones` are its skull and lower jaw
/// and `rigid` its teeth and gums, world, bind pose; `hinge` is the jaw's.
pub(crate) fn tissue(
    soft: &Soft,
    place: &DAffine3,
    bones: &[MeshPart],
    rigid: &[&MeshPart],
    hinge: DVec3,
) -> Tissue {
    with(&layout::shipped(), soft, place, bones, rigid, hinge)
}

/// Builds the tissue of a head with the muscles of the given sheets.
fn with(
    sheets: &[Sheet],
    soft: &Soft,
    place: &DAffine3,
    bones: &[MeshPart],
    rigid: &[&MeshPart],
    hinge: DVec3,
) -> Tissue {
    let skin = Skin::new(soft, place, bones);
    let warp = Warp::mirrored(&soft.landmarks);
    let carried = |p: [f64; 3]| {
        let own = warp.place(DVec3::from_array(p)) * 1e-3;
        place.transform_point3(own)
    };
    let mirrored = |p: [f64; 3], side: Side| [p[0] * side.sign(), p[1], p[2]];
    let span = carried([0.0, 42.0, 97.8]).distance(carried([0.0, -89.3, 96.0]));
    let mut out = Tissue {
        scale: (span * 1e3 / REFERENCE_MM) as f32,
        hinge: narrow(hinge),
        rest: skin.places.iter().map(|&p| narrow(p)).collect(),
        jaw: soft.nodes.iter().map(|n| n.jaw as f32).collect(),
        depth: skin.depths.iter().map(|&d| d as f32).collect(),
        grip: soft.nodes.iter().map(|n| grip(n) as f32).collect(),
        quads: soft.quads.iter().map(|q| q.map(|i| i as u16)).collect(),
        ..Tissue::default()
    };
    let mut holds: Vec<Vec<Attachment>> = vec![Vec::new(); soft.nodes.len()];
    mouth::mouth(soft, &skin, rigid, &mut out, &mut holds);
    let site = fit::Site {
        soft,
        skin: &skin,
        carried: &carried,
    };
    for sheet in sheets {
        fit::sheet(sheet, &site, &mut out, &mut holds);
    }
    out.starts.push(0);
    for own in holds {
        out.attachments.extend(own);
        out.starts.push(out.attachments.len() as u32);
    }
    let blood: Vec<(DVec3, f64, f64)> = FLUSH
        .iter()
        .flat_map(|&(p, around, much)| {
            Side::BOTH.map(|side| (carried(mirrored(p, side)), around * 1e-3, much))
        })
        .collect();
    out.flush = skin
        .places
        .iter()
        .map(|p| {
            let of = |&(at, around, much): &(DVec3, f64, f64)| {
                much * (1.0 - ramp(0.3 * around, around, p.distance(at)))
            };
            blood.iter().map(of).fold(0.0, f64::max) as f32
        })
        .collect();
    out
}

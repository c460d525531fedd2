//! Rigging of imported heads: adds muscles, tissue, jaw, eyes and lids (F&H section 3.1.2,
//! "Creating New Animatable Head Models").
//!
//! The generated head is bent to the other through landmarks and projected onto its surface; each
//! vertex of the other takes the data at its position: joint weights, and the tissue nodes that it
//! follows. Bones, fibres and teeth keep their depths below the skin.

mod fitted_head;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use self::fitted_head::fit_head;
use super::built::AnnotatedFigure;
use super::head::Head;
use super::mannequin::Mannequin;
use super::part::MeshPart;
use super::people::FigureParams;
use super::scan::Scan;
use super::similarity::Similarity;
use super::surface::Surface;
use super::tissue::Warp;

/// Names of the landmarks that an imported head must provide.
pub const NEEDED: [&str; 14] = [
    "n", "prn", "sn", "ls", "li", "gn", "en_l", "en_r", "ex_l", "ex_r", "ch_l", "ch_r", "zy_l",
    "zy_r",
];
/// Search distance from the deformed head to the surface of the other, metres.
const REACH_M: f64 = 0.012;

/// Error returned when an imported head cannot be rigged.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RigError {
    /// Landmarks are missing.
    #[error("these landmarks are wanted too: {0}")]
    Missing(String),
    /// The mesh is empty.
    #[error("the mesh has no faces")]
    Empty,
    /// The landmarks do not match a face.
    #[error("the landmark {name} lies {mm:.0} mm from where the others have it")]
    Astray {
        /// Landmark name.
        name: String,
        /// Distance.
        mm: f64,
    },
}

/// Maximum distance of a landmark from that of the generated head after alignment, millimetres: a
/// larger one means swapped left and right, or a wrong vertex number.
const ASTRAY_MM: f64 = 45.0;

/// Landmarks of an imported head: positions by name, in the mesh's own units and axes.
pub type Landmarks = BTreeMap<String, DVec3>;

/// Rigs a head. The figure contains only the head, on the skeleton of `params`, at the size of its
/// head; mouth, teeth, tongue, eyes, lashes and brows are generated.
///
/// # Errors
/// Returns a [`RigError`] that describes the problem.
pub fn rig(
    scan: &Scan,
    landmarks: &Landmarks,
    params: &FigureParams,
) -> Result<AnnotatedFigure, RigError> {
    let missing: Vec<&str> = NEEDED
        .into_iter()
        .filter(|n| !landmarks.contains_key(*n))
        .collect();
    if !missing.is_empty() {
        return Err(RigError::Missing(missing.join(", ")));
    }
    if scan.faces.is_empty() {
        return Err(RigError::Empty);
    }
    let made = Mannequin::from_params(params);
    let pairs = pairs(&made.head, &made.head_parts[0], landmarks);
    let to_ours: Vec<(DVec3, DVec3)> = pairs
        .iter()
        .map(|(_, own, theirs)| (*theirs, *own))
        .collect();
    let fit = Similarity::best(&to_ours);
    for (name, own, theirs) in &pairs {
        let mm = fit.apply(*theirs).distance(*own) * 1e3;
        if mm.is_nan() || mm >= ASTRAY_MM {
            return Err(RigError::Astray {
                name: (*name).to_owned(),
                mm,
            });
        }
    }
    let points: Vec<DVec3> = scan.points.iter().map(|&p| fit.apply(p)).collect();
    let bends: Vec<(DVec3, DVec3)> = pairs
        .iter()
        .map(|(_, own, theirs)| (*own * 1e3, fit.apply(*theirs) * 1e3))
        .collect();
    let theirs = Surface::new(points, scan.triangles().collect(), REACH_M);
    let laid = fit_head(made, Warp::new(&bends), &theirs);
    Ok(laid.figure(scan, &theirs, landmarks, &fit, params))
}

/// Landmarks that both heads have: name, ours in the world, theirs.
fn pairs<'a>(
    head: &'a Head,
    skin: &MeshPart,
    landmarks: &Landmarks,
) -> Vec<(&'a str, DVec3, DVec3)> {
    let own = head.landmarks.iter();
    own.filter_map(|(name, v)| {
        let theirs = landmarks.get(name)?;
        Some((name.as_str(), skin.vertices[*v as usize].position, *theirs))
    })
    .collect()
}

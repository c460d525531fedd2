//! Bones are inside the skin, have the right number and are closed.

use std::sync::OnceLock;

use super::head_skin::to_triangle;
use super::*;
use crate::subdivide::edge_faces;
use crate::tests::soundness::shipped;

struct Case {
    params: &'static FigureParams,
    built: &'static AnnotatedFigure,
    parts: Vec<MeshPart>,
}

fn sofia() -> &'static Case {
    static MADE: OnceLock<Case> = OnceLock::new();
    MADE.get_or_init(|| {
        let (params, built) = shipped("sofia");
        let parts = build(params, built);
        Case {
            params,
            built,
            parts,
        }
    })
}

fn named(name: &str) -> &'static MeshPart {
    sofia().parts.iter().find(|p| p.name == name).unwrap()
}

#[test]
fn every_bone_is_closed_and_looks_outwards() {
    for part in &sofia().parts {
        let edges = edge_faces(&part.faces);
        assert!(edges.values().all(|f| f.len() == 2), "{}", part.name);
        let solid = Solid {
            points: part.vertices.iter().map(|v| v.position).collect(),
            faces: part.faces.clone(),
        };
        assert!(solid.volume() > 1e-8, "{} {}", part.name, solid.volume());
        assert!(
            part.vertices.iter().all(|v| v.position.is_finite()),
            "all vertices of the bone are finite"
        );
    }
}

#[test]
fn there_are_29_bones_from_elbow_to_fingertip_on_each_side() {
    let fingers = ["thumb", "index", "middle", "ring", "pinky"];
    let carpals = [
        "scaphoid",
        "lunate",
        "triquetrum",
        "pisiform",
        "trapezium",
        "trapezoid",
        "capitate",
        "hamate",
    ];
    for side in ["l", "r"] {
        let own = sofia().parts.iter().filter(|p| {
            let bare = p.name.strip_prefix(&format!("{side}_"));
            bare.is_some_and(|n| {
                carpals.contains(&n)
                    || fingers.iter().any(|f| n.starts_with(f))
                    || n == "radius"
                    || n == "ulna"
            })
        });
        assert_eq!(own.count(), 29);
    }
}

/// Returns the skin triangles of the head, for counting ray crossings.
fn skin_triangles() -> Vec<[DVec3; 3]> {
    let mut out = Vec::new();
    for mesh in &sofia().built.figure.meshes {
        if mesh.material.kind == MaterialKind::Skin {
            out.extend(mesh.indices.chunks_exact(3).map(|t| {
                [t[0], t[1], t[2]]
                    .map(|v| DVec3::from_array(mesh.positions[v as usize].map(f64::from)))
            }));
        }
    }
    out
}

#[test]
fn skull_and_jaw_lie_under_the_skin_everywhere() {
    let skin = skin_triangles();
    for name in ["skull", "cheekbones", "mandible"] {
        let part = named(name);
        let mut least = f64::INFINITY;
        for v in part.vertices.iter() {
            let near = skin.iter().filter(|t| (t[0] - v.position).length() < 0.02);
            least = near
                .map(|t| to_triangle(t, v.position))
                .fold(least, f64::min);
        }
        assert!(least >= 0.0015, "{name} {least}");
    }
}

#[test]
fn the_skull_is_as_large_as_a_head_and_carries_a_face() {
    let extent = |part: &MeshPart, axis: fn(DVec3) -> f64| {
        let values = part.vertices.iter().map(|v| axis(v.position));
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    let skull = named("skull");
    // Women's skulls: about 175 mm long and 138 mm broad (Howells 1973; recalled).
    let (long, broad) = (extent(skull, |p| p.z), extent(skull, |p| p.x));
    assert!((0.155..0.195).contains(&long), "{long}");
    assert!((0.120..0.155).contains(&broad), "{broad}");
    let jaw = named("mandible");
    let broad = extent(jaw, |p| p.x);
    assert!((0.085..0.125).contains(&broad), "{broad}");
}

#[test]
fn bones_of_trunk_and_limbs_lie_inside_the_body() {
    let case = sofia();
    let frame = Frame::new(case.params, &case.built.figure);
    for part in &case.parts {
        let bare = part.name.trim_start_matches("l_").trim_start_matches("r_");
        let checked = [
            "femur", "tibia", "fibula", "humerus", "clavicle", "scapula", "pelvis", "sternum",
        ];
        if !checked.contains(&bare) && !bare.starts_with("rib") {
            continue;
        }
        for v in &part.vertices {
            let d = frame.field.value(v.position, Regions::ALL, 1.0);
            assert!(d < -0.0015, "{} {d}", part.name);
        }
    }
}

#[test]
fn layers_hold_what_they_say() {
    let case = sofia();
    let of = |layer| layered(case.params, case.built, layer);
    let (skin, bones, all) = (of(Layer::Skin), of(Layer::Bones), of(Layer::All));
    assert_eq!(skin.meshes.len() + bones.meshes.len(), all.meshes.len());
    assert_eq!(bones.skeleton.joints().len(), skin.skeleton.joints().len());
    let triangles: usize = bones.meshes.iter().map(|m| m.indices.len() / 3).sum();
    assert!((8_000..60_000).contains(&triangles), "{triangles}");
}

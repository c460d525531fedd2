//! Invariants of every head.

use std::sync::OnceLock;

use raconteur_base::{DQuat, DVec3, Side};

use super::cage::Zone;
use super::*;
use crate::assemble;
use raconteur_base::self_intersection::crossings;

use crate::crossing::farthest_from_mirrored;
use crate::people::{NAMES, preset};
use crate::subdivide::{edge_faces, welded};
use raconteur_body::skeleton::{Bone, Drive};

/// Returns the person and head parameters of a named figure.
fn one(name: &str) -> (Person, HeadParams) {
    let p = preset(name).unwrap();
    (p.person, p.head)
}

fn symmetric_shape(name: &str) -> Shape {
    let (person, head) = one(name);
    Shape::build(&person, &head.bound, 0.0)
}

/// The heads of the figures.
fn heads() -> impl Iterator<Item = (&'static str, &'static Head)> {
    static HEADS: OnceLock<[Head; NAMES.len()]> = OnceLock::new();
    let heads = HEADS.get_or_init(|| {
        NAMES.map(|name| {
            let p = preset(name).unwrap();
            build(&p.person, &p.head)
        })
    });
    NAMES.into_iter().zip(heads)
}

fn sofia() -> &'static Head {
    heads().next().map(|h| h.1).unwrap()
}

fn symmetric() -> &'static Shape {
    static SHAPE: OnceLock<Shape> = OnceLock::new();
    SHAPE.get_or_init(|| symmetric_shape("sofia"))
}

/// Skins a vertex with the given rotations of jaw and left upper lid.
fn skinned(head: &Head, v: &PartVertex, offset: DVec3, jaw_rad: f64, lid_rad: f64) -> DVec3 {
    let p = v.position + offset;
    let mut sum = DVec3::ZERO;
    for &(joint, w) in &v.weights {
        let (centre, angle) = match joint.0 {
            Drive::Bone(Bone::Chin) => (head.jaw_hinge, jaw_rad),
            Drive::UpperLid(Side::Left) => (head.eye_centres[0], lid_rad),
            _ => (DVec3::ZERO, 0.0),
        };
        sum += (centre + DQuat::from_rotation_x(angle) * (p - centre)) * w;
    }
    sum
}

#[test]
fn no_edge_has_three_faces_and_only_neck_lips_and_lid_linings_are_open() {
    for (who, head) in heads() {
        for p in &head.parts {
            let edges = edge_faces(&p.faces);
            let at = format!("{who} {}", p.name);
            assert!(edges.values().all(|f| f.len() <= 2), "{at}");
            assert!(p.faces.iter().all(|f| f.len() == 3 || f.len() == 4), "{at}");
        }
        let skin = head.skin();
        let positions: Vec<DVec3> = skin.vertices.iter().map(|v| v.position).collect();
        let edges = edge_faces(&welded(&positions, &skin.faces));
        assert!(edges.values().all(|f| f.len() <= 2), "{who}");
        let lips = head.parts[1].vertices.iter().map(|v| v.position);
        let lips: Vec<DVec3> = lips.collect();
        for (&(a, b), _) in edges.iter().filter(|e| e.1.len() == 1) {
            for v in [a, b] {
                let p = skin.vertices[v as usize].position;
                let neck = p.y < -0.13;
                // The bag continues there.
                let lip = lips.contains(&p);
                let mut globes = head.eye_centres.iter();
                // The lids' lining ends behind the front of the globe.
                let lining = globes.any(|c| (p - *c).length() < 0.0135 && p.z < c.z + 0.009);
                assert!(neck || lip || lining, "{who} {p}");
            }
        }
    }
}

#[test]
fn without_asymmetry_the_halves_mirror_each_other() {
    for (who, shape) in symmetric_people() {
        let (far, at) = farthest_from_mirrored(&shape.positions, 0.5);
        assert!(far < 0.1, "{who}: {far} mm at {at}");
    }
}

#[test]
fn closed_lids_leave_no_slit() {
    for (who, shape) in symmetric_people() {
        let slit = largest_slit(shape);
        assert!(slit < 0.5, "{who}: {slit} mm");
    }
}

/// Between closed lids, mm.
fn largest_slit(shape: &Shape) -> f64 {
    let centre = shape.fitted.globe;
    let q = DQuat::from_rotation_x(shape.rig.closure_rad[0]);
    // The lash edge: x, angle above the globe's equator, distance from the lids' axis.
    let mut edges: [Vec<(f64, f64, f64)>; 2] = [Vec::new(), Vec::new()];
    for ((c, s), &p) in shape
        .coordinates
        .iter()
        .zip(&shape.shares)
        .zip(&shape.positions)
    {
        if (c.eye - 5.0).abs() > 1e-6 || p.x < 0.0 {
            continue;
        }
        let posed = p.lerp(centre + q * (p - centre), s.upper_lid);
        let height = raconteur_base::ops::atan2(posed.y - centre.y, posed.z - centre.z);
        let arm = raconteur_base::ops::hypot(posed.y - centre.y, posed.z - centre.z);
        if c.eye_upper > 0.4 {
            edges[0].push((posed.x, height, arm));
        }
        if c.eye_upper < -0.4 {
            edges[1].push((posed.x, height, arm));
        }
    }
    let [upper, mut lower] = edges;
    lower.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(
        upper.len() > 20 && lower.len() > 20,
        "both lids have more than 20 vertices"
    );
    // Within a millimetre of the outer corner the edge turns round: no slit, but its rounding.
    let corner = lower.iter().map(|e| e.0).fold(f64::MIN, f64::max);
    let slits = upper.into_iter().filter(|e| e.0 < corner - 1.0);
    let slits = slits.filter_map(|(x, height, arm)| {
        let i = lower.windows(2).position(|w| w[0].0 <= x && x <= w[1].0)?;
        let (a, b) = (lower[i], lower[i + 1]);
        let line = a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0);
        Some((height - line) * arm)
    });
    slits.fold(f64::MIN, f64::max)
}

/// Vertices of the first part in the band where the lips touch: on the upper lip and the
/// lower, without the corners.
fn contact(name: &str, head: &Head) -> [Vec<usize>; 2] {
    let shape = people().find(|p| p.0 == name).map(|p| p.1).unwrap();
    let skin = head.skin();
    let jaw = |v: usize| {
        let w = skin.vertices[v].weights.iter();
        let own = w.filter(|w| w.0.0 == Drive::Bone(Bone::Chin));
        own.map(|w| w.1).sum::<f64>()
    };
    let band = behind(skin, &shape.positions)
        .into_iter()
        .enumerate()
        .filter(|&(_, v)| (4.0..=5.0).contains(&shape.coordinates[v as usize].mouth))
        .map(|(i, _)| i)
        .filter(|&i| skin.vertices[i].position.x.abs() < 0.016);
    let (upper, lower) = band.partition(|&i| jaw(i) < 0.45);
    [upper, lower]
}

/// Returns the widest gap along the lips, metres: in each millimetre of breadth, between the
/// nearest points of upper and lower lip.
fn lip_gap(name: &str, head: &Head, jaw_rad: f64, morph: &str, weight: f64) -> f64 {
    let skin = head.skin();
    let mut moved = vec![DVec3::ZERO; skin.vertices.len()];
    if let Some(m) = skin.morphs.iter().find(|m| m.name == morph) {
        for &(v, d) in &m.deltas {
            moved[v as usize] = d * weight;
        }
    }
    let [upper, lower] = contact(name, head);
    assert!(
        upper.len() > 40 && lower.len() > 40,
        "both lips have more than 40 vertices"
    );
    let at = |v: &usize| skinned(head, &skin.vertices[*v], moved[*v], jaw_rad, 0.0);
    (-14..=14)
        .map(|i| {
            let x = f64::from(i) * 1e-3;
            let here = |v: &&usize| (skin.vertices[**v].position.x - x).abs() < 1.2e-3;
            let pairs = upper.iter().filter(here).flat_map(|u| {
                let near = lower.iter().filter(here);
                near.map(move |l| at(u).distance(at(l)))
            });
            pairs.fold(f64::MAX, f64::min)
        })
        .fold(0.0, f64::max)
}

#[test]
fn lips_meet_at_rest_and_stay_sealed_while_the_jaw_opens() {
    for (who, head) in heads() {
        let rest = lip_gap(who, head, 0.0, "", 0.0);
        assert!(rest < 0.7e-3, "{who}: {rest}");
        for jaw in [0.05, 0.1, 0.2] {
            let open = lip_gap(who, head, jaw, "", 0.0);
            assert!(open > 0.06 * jaw, "{who}: {open}");
            let gap = lip_gap(who, head, jaw, "mouthClose", jaw / morph::CLOSE_JAW_RAD);
            assert!(gap < 1.5e-3, "{who}: {gap} at {jaw}");
        }
    }
}

#[test]
fn weights_are_positive_and_sum_to_one() {
    for p in heads().flat_map(|h| &h.1.parts) {
        for v in &p.vertices {
            let sum: f64 = v.weights.iter().map(|w| w.1).sum();
            assert!(
                (sum - 1.0).abs() < 1e-9 && v.weights.iter().all(|w| w.1 > 0.0),
                "{}",
                p.name
            );
            assert!(
                v.position.is_finite() && v.color.iter().all(|c| (0.0..=1.0).contains(c)),
                "position and colour of the vertex are valid"
            );
        }
    }
}

#[test]
fn the_upper_lid_turned_by_its_closure_covers_the_pupil() {
    for (who, head) in heads() {
        let pupil = head.eye_centres[0];
        let covers = |lid: f64| {
            head.skin().vertices.iter().any(|v| {
                let p = skinned(head, v, DVec3::ZERO, 0.0, lid);
                let before = (p - pupil).truncate().abs();
                before.max_element() < 0.002 && p.z > pupil.z + 0.0115
            })
        };
        assert!(!covers(0.0) && covers(head.lid_closure_rad[0]), "{who}");
    }
}

#[test]
fn the_same_parameters_give_the_same_head() {
    let (a, b) = (symmetric(), symmetric_shape("sofia"));
    assert_eq!(a.positions, b.positions);
    assert_eq!(a.rig.closure_rad, b.rig.closure_rad);
}

#[test]
fn the_head_measures_like_a_womans() {
    // Menton to vertex 218 mm for women (Gordon et al. 2014, ANSUR II, menton–top of head;
    // standard deviation about 10 mm).
    let [low, high] = sofia().extent;
    assert!((high - low - 0.218).abs() < 0.015, "{}", high - low);
    let eyes = sofia().eye_centres[0].x - sofia().eye_centres[1].x;
    assert!((eyes - 0.0617).abs() < 0.004, "{eyes}");
    assert_eq!(sofia().neck_rim.len(), 40);
}

/// Heads as they are shipped.
fn people() -> impl Iterator<Item = (&'static str, &'static Shape)> {
    static SHAPES: OnceLock<[Shape; NAMES.len()]> = OnceLock::new();
    let shapes = SHAPES.get_or_init(|| {
        NAMES.map(|name| {
            let (person, head) = one(name);
            Shape::build(&person, &head.bound, head.asymmetry)
        })
    });
    NAMES.into_iter().zip(shapes)
}

/// The same, mirror-symmetric.
fn symmetric_people() -> impl Iterator<Item = (&'static str, &'static Shape)> {
    static SHAPES: OnceLock<[Shape; NAMES.len()]> = OnceLock::new();
    let shapes = SHAPES.get_or_init(|| NAMES.map(symmetric_shape));
    NAMES.into_iter().zip(shapes)
}

#[test]
fn every_person_has_the_same_topology() {
    for (who, other) in people() {
        assert_eq!(symmetric().surface.faces, other.surface.faces, "{who}");
    }
}

#[test]
fn the_skin_does_not_cross_itself() {
    for (who, shape) in people().chain(symmetric_people()) {
        let faces = shape.surface.faces.iter().zip(&shape.surface.zones);
        let (triangles, zones): (Vec<[u32; 3]>, Vec<Zone>) = faces
            .flat_map(|(face, &zone)| {
                let drawn = assemble::triangles(face, &shape.positions);
                drawn.into_iter().map(move |t| (t, zone))
            })
            .unzip();
        let found = crossings(&shape.positions, &triangles);
        let first = found.first().map(|&[a, b]| {
            let at = shape.positions[triangles[a][0] as usize];
            (zones[a], zones[b], at)
        });
        assert!(found.is_empty(), "{who}: {} at {first:?}", found.len());
    }
}

#[test]
fn no_face_is_degenerate_or_flipped() {
    for (who, shape) in people().chain(symmetric_people()) {
        let normals = vertex_normals(&shape.positions, &shape.surface.faces);
        for (face, zone) in shape.surface.faces.iter().zip(&shape.surface.zones) {
            let p = |i: usize| shape.positions[face[i] as usize];
            let across = (p(2) - p(0)).cross(p(face.len() - 1) - p(1));
            // Half a hundredth of a square millimetre.
            assert!(across.length() > 1e-2, "{who}: {zone:?} at {}", p(0));
            let mean: DVec3 = face.iter().map(|&v| normals[v as usize]).sum();
            let turn = across.normalize().dot(mean.normalize());
            // The crease of a hooded lid is a fold of nearly 90°; a larger angle is a flip.
            assert!(turn > 0.0, "{who}: {turn} {zone:?} at {}", p(0));
        }
    }
}

#[test]
fn one_hundred_landmarks_lie_where_their_names_say() {
    let head = sofia();
    assert!(head.landmarks.len() >= 100, "{}", head.landmarks.len());
    let at = |name: &str| {
        let found = head.landmarks.iter().find(|l| l.0 == name);
        let vertex = found.unwrap_or_else(|| panic!("a landmark {name}")).1;
        head.skin().vertices[vertex as usize].position
    };
    let names: std::collections::BTreeSet<&str> =
        head.landmarks.iter().map(|l| l.0.as_str()).collect();
    assert_eq!(names.len(), head.landmarks.len());
    // From above to below, and from front to back.
    for pair in ["v", "tr", "g", "n", "prn", "sn", "ls", "li", "sl", "gn"].windows(2) {
        assert!(at(pair[0]).y > at(pair[1]).y, "{pair:?}");
    }
    assert!(
        at("prn").z > at("n").z && at("n").z > at("ex_l").z && at("op").z < at("t_l").z,
        "the depth order of the landmarks"
    );
    assert!(
        at("eu_l").x > at("zy_l").x && at("zy_l").x > at("ex_l").x,
        "the landmark of the skull is outside the cheekbone"
    );
    assert!(
        at("ex_l").x > at("en_l").x && at("en_l").x > 0.0 && at("en_r").x < 0.0,
        "the landmarks of the eyes are on their sides"
    );
}

#[test]
fn segments_cover_the_skin_once() {
    let head = sofia();
    let mut owners = vec![0; head.skin().vertices.len()];
    for (i, s) in head.segments.iter().enumerate() {
        assert!(
            s.parent.is_none_or(|p| p < i),
            "the parent precedes its segment"
        );
        for &[first, count] in &s.runs {
            for owner in &mut owners[first as usize..(first + count) as usize] {
                *owner += 1;
            }
        }
    }
    assert!(
        owners.iter().all(|&n| n == 1),
        "each vertex belongs to one segment"
    );
    for s in &head.segments {
        let inner = ["face", "eyes", "nose", "mouth", "chin"].contains(&s.name);
        assert_eq!(s.runs.is_empty(), inner, "{}", s.name);
    }
}

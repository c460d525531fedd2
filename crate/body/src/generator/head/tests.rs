//! What must hold for every head.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use raconteur_base::{DQuat, DVec3, Side, mirror_vector};

use super::*;
use crate::generator::people::preset;
use crate::generator::subdivide::{edge_faces, welded};
use crate::skeleton::{Bone, Drive};

fn shape_of(name: &str) -> Shape {
    let p = preset(name).unwrap();
    let head = HeadParams {
        asymmetry: 0.0,
        ..p.head
    };
    Shape::of(&p.person, &head)
}

fn sofia() -> &'static Head {
    static HEAD: OnceLock<Head> = OnceLock::new();
    HEAD.get_or_init(|| {
        let p = preset("sofia").unwrap();
        build(&p.person, &p.head, p.hair.colour.linear_rgb())
    })
}

fn symmetric() -> &'static Shape {
    static SHAPE: OnceLock<Shape> = OnceLock::new();
    SHAPE.get_or_init(|| shape_of("sofia"))
}

fn part(name: &str) -> &'static Part {
    sofia()
        .parts
        .iter()
        .find(|p| p.name == name)
        .unwrap_or_else(|| panic!("a part {name}"))
}

/// Skins a vertex with the given turns of jaw and left upper lid.
fn skinned(v: &PartVertex, offset: DVec3, jaw_rad: f64, lid_rad: f64) -> DVec3 {
    let head = sofia();
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
    for (p, name) in sofia().parts.iter().map(|p| (p, &p.name)) {
        let edges = edge_faces(&p.faces);
        assert!(edges.values().all(|f| f.len() <= 2), "{name}");
        assert!(
            p.faces.iter().all(|f| f.len() == 3 || f.len() == 4),
            "{name}"
        );
    }
    let skin = part("head");
    let positions: Vec<DVec3> = skin.vertices.iter().map(|v| v.position).collect();
    for (&(a, b), faces) in &edge_faces(&welded(&positions, &skin.faces)) {
        if faces.len() == 1 {
            for v in [a, b] {
                let p = skin.vertices[v as usize].position;
                let neck = p.y < -0.13;
                let lips = p.x.abs() < 0.03 && (-0.053..-0.04).contains(&p.y);
                let mut globes = sofia().eye_centres.iter();
                // The lids' lining ends behind the front of the globe.
                let lining = globes.any(|c| (p - *c).length() < 0.0135 && p.z < c.z + 0.009);
                assert!(neck || lips || lining, "{p}");
            }
        }
    }
}

#[test]
fn without_asymmetry_the_halves_mirror_each_other() {
    let cell = |p: DVec3| (p * 2.0).round().to_array().map(|x| x as i64);
    let shape = symmetric();
    let mut by_cell: BTreeMap<[i64; 3], Vec<DVec3>> = BTreeMap::new();
    for &p in &shape.positions {
        by_cell.entry(cell(p)).or_default().push(p);
    }
    for &p in &shape.positions {
        let q = mirror_vector(p);
        let [x, y, z] = cell(q);
        let near =
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        let found = near
            .filter_map(|[i, j, k]| by_cell.get(&[x + i, y + j, z + k]))
            .flatten()
            .any(|r| (*r - q).length() < 0.1);
        assert!(found, "{p}");
    }
}

#[test]
fn closed_lids_leave_no_slit() {
    let shape = symmetric();
    let centre = shape.globe;
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
    assert!(upper.len() > 20 && lower.len() > 20);
    // Within a millimetre of the outer corner the edge turns round: no slit, but its rounding.
    let corner = lower.iter().map(|e| e.0).fold(f64::MIN, f64::max);
    for (x, height, arm) in upper.into_iter().filter(|e| e.0 < corner - 1.0) {
        let Some(i) = lower.windows(2).position(|w| w[0].0 <= x && x <= w[1].0) else {
            continue;
        };
        let (a, b) = (lower[i], lower[i + 1]);
        let line = a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0);
        let slit_mm = (height - line) * arm;
        assert!(slit_mm < 0.5, "{slit_mm} mm at {x}");
    }
}

/// Gaps between the lips' contact lines, vertical and forward, metres; the second number is
/// the largest.
fn lip_gap(jaw_rad: f64, morph: &str, weight: f64) -> f64 {
    let bag = part("mouth_bag");
    let mut moved = vec![DVec3::ZERO; bag.vertices.len()];
    if let Some(m) = bag.morphs.iter().find(|m| m.name == morph) {
        for &(v, d) in &m.deltas {
            moved[v as usize] = d * weight;
        }
    }
    // The bag's rim is the contact line; its upper half has little weight on the jaw.
    let rim = edge_faces(&bag.faces)
        .iter()
        .filter(|(_, f)| f.len() == 1)
        .flat_map(|(&(a, b), _)| [a as usize, b as usize])
        .collect::<std::collections::BTreeSet<usize>>();
    let jaw = |v: usize| {
        let w = bag.vertices[v].weights.iter();
        w.filter(|w| w.0.0 == Drive::Bone(Bone::Chin))
            .map(|w| w.1)
            .sum::<f64>()
    };
    let at = |v: usize| skinned(&bag.vertices[v], moved[v], jaw_rad, 0.0);
    let middle = |v: &usize| bag.vertices[*v].position.x.abs() < 0.016;
    let upper: Vec<usize> = rim
        .iter()
        .copied()
        .filter(|&v| jaw(v) < 0.45)
        .filter(middle)
        .collect();
    let lower: Vec<usize> = rim.iter().copied().filter(|&v| jaw(v) > 0.55).collect();
    assert!(upper.len() > 8 && lower.len() > 8);
    upper
        .iter()
        .map(|&u| {
            lower
                .iter()
                .map(|&l| (at(u) - at(l)).length())
                .fold(f64::MAX, f64::min)
        })
        .fold(0.0, f64::max)
}

#[test]
fn lips_meet_at_rest_and_stay_sealed_while_the_jaw_opens() {
    assert!(lip_gap(0.0, "", 0.0) < 0.7e-3, "{}", lip_gap(0.0, "", 0.0));
    for jaw in [0.05, 0.1, 0.2] {
        assert!(
            lip_gap(jaw, "", 0.0) > 0.06 * jaw,
            "{}",
            lip_gap(jaw, "", 0.0)
        );
        let gap = lip_gap(jaw, "mouthClose", jaw / morph::CLOSE_JAW_RAD);
        assert!(gap < 1.5e-3, "{gap} at {jaw}");
    }
}

#[test]
fn weights_are_positive_and_sum_to_one() {
    for p in &sofia().parts {
        for v in &p.vertices {
            let sum: f64 = v.weights.iter().map(|w| w.1).sum();
            assert!(
                (sum - 1.0).abs() < 1e-9 && v.weights.iter().all(|w| w.1 > 0.0),
                "{}",
                p.name
            );
            assert!(v.position.is_finite() && v.color.iter().all(|c| (0.0..=1.0).contains(c)));
        }
    }
}

#[test]
fn the_upper_lid_turned_by_its_closure_covers_the_pupil() {
    let head = sofia();
    let pupil = head.eye_centres[0];
    let covers = |lid: f64| {
        part("head").vertices.iter().any(|v| {
            let p = skinned(v, DVec3::ZERO, 0.0, lid);
            (p.x - pupil.x).abs() < 0.002 && (p.y - pupil.y).abs() < 0.002 && p.z > pupil.z + 0.0115
        })
    };
    assert!(!covers(0.0) && covers(head.lid_closure_rad[0]));
}

#[test]
fn the_same_parameters_give_the_same_head() {
    let (a, b) = (symmetric(), shape_of("sofia"));
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
    assert!(sofia().scalp.triangles.len() > 1000);
    assert_eq!(sofia().neck_rim.len(), 40);
}

/// A man of 70 and a boy of 9, mirror-symmetric.
fn others() -> &'static [Shape; 2] {
    static SHAPES: OnceLock<[Shape; 2]> = OnceLock::new();
    SHAPES.get_or_init(|| ["papous", "nuno"].map(shape_of))
}

fn shapes() -> impl Iterator<Item = &'static Shape> {
    core::iter::once(symmetric()).chain(others())
}

#[test]
fn every_person_has_the_same_topology() {
    let one = symmetric();
    for other in others() {
        assert_eq!(one.surface.faces, other.surface.faces);
    }
}

#[test]
fn no_face_is_degenerate_or_flipped() {
    for (who, shape) in ["sofia", "papous", "nuno"].iter().zip(shapes()) {
        let normals = vertex_normals(&shape.positions, &shape.surface.faces);
        for (face, zone) in shape.surface.faces.iter().zip(&shape.surface.zones) {
            // What is hidden behind lids, lips and in canals may crease.
            if matches!(
                zone,
                Zone::Eye(5..) | Zone::Mouth(4..) | Zone::Nostril(1..) | Zone::Ear(_)
            ) {
                continue;
            }
            let p = |i: usize| shape.positions[face[i] as usize];
            let across = (p(2) - p(0)).cross(p(face.len() - 1) - p(1));
            assert!(across.length() > 1e-4, "{zone:?} at {}", p(0));
            let mean: DVec3 = face.iter().map(|&v| normals[v as usize]).sum();
            if face.len() == 4 {
                let turn = across.normalize().dot(mean.normalize());
                // The crease of a hooded lid is a fold of nearly 90°; beyond it lies a flip.
                assert!(turn > 0.0, "{who}: {turn} {zone:?} at {}", p(0));
            }
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
        head.parts[0].vertices[vertex as usize].position
    };
    let names: std::collections::BTreeSet<&str> =
        head.landmarks.iter().map(|l| l.0.as_str()).collect();
    assert_eq!(names.len(), head.landmarks.len());
    // From above to below, and from front to back.
    for pair in ["v", "tr", "g", "n", "prn", "sn", "ls", "li", "sl", "gn"].windows(2) {
        assert!(at(pair[0]).y > at(pair[1]).y, "{pair:?}");
    }
    assert!(at("prn").z > at("n").z && at("n").z > at("ex_l").z && at("op").z < at("t_l").z);
    assert!(at("eu_l").x > at("zy_l").x && at("zy_l").x > at("ex_l").x);
    assert!(at("ex_l").x > at("en_l").x && at("en_l").x > 0.0 && at("en_r").x < 0.0);
}

#[test]
fn segments_cover_the_skin_once() {
    let head = sofia();
    let mut owners = vec![0; head.parts[0].vertices.len()];
    for (i, s) in head.segments.iter().enumerate() {
        assert!(s.parent.is_none_or(|p| p < i));
        for &[first, count] in &s.runs {
            for owner in &mut owners[first as usize..(first + count) as usize] {
                *owner += 1;
            }
        }
    }
    assert!(owners.iter().all(|&n| n == 1));
    for s in &head.segments {
        let inner = ["face", "eyes", "nose", "mouth", "chin"].contains(&s.name);
        assert_eq!(s.runs.is_empty(), inner, "{}", s.name);
    }
}

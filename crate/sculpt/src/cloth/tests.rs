//! Clothes of the three named figures: fit, soundness, budgets and behaviour in poses.

mod throat;

use std::collections::BTreeMap;
use std::sync::OnceLock;

use raconteur_base::{DAffine3, DQuat, DVec3, Side};

use super::{Dressed, Wearer, dress};
use crate::assemble::{Blueprint, PartWithNormals, assemble};
use crate::mannequin::Mannequin;
use crate::part::MeshPart;
use crate::people::{NAMES, preset};
use crate::subdivide::edge_faces;
use crate::torso::{Field, Joints, Regions, Shell};
use raconteur_body::figure::Figure;
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::{Bone, FaceJoints};

struct Model {
    name: &'static str,
    field: Field,
    skin: Vec<[DVec3; 3]>,
    joints: Joints,
    clothes: Dressed,
    figure: Figure,
}

fn make(name: &'static str) -> Model {
    let params = preset(name).unwrap();
    let Mannequin {
        head_parts,
        joints,
        field,
        cage,
        neck,
        ..
    } = Mannequin::from_params(&params);
    let clothes = dress(
        &Wearer::new(&params.body(), &field, &cage, &joints, &neck),
        &params.wardrobe,
    );
    let eye = joints.position_of(Bone::Skull);
    let figure = assemble(&Blueprint {
        name: name.to_owned(),
        positions_in_world: joints.positions,
        bind_rotations: joints.rotations,
        face: FaceJoints {
            eye_centres: [eye, eye],
        },
        stature_m: params.person.stature_m,
        lid_closure_rad: [0.6; 2],
        pieces: clothes
            .parts
            .iter()
            .cloned()
            .map(PartWithNormals::from)
            .collect(),
        chains: Vec::new(),
        images: Vec::new(),
    });
    Model {
        name,
        field,
        skin: head_parts[0].triangles_about_middles(|_| true),
        joints,
        clothes,
        figure,
    }
}

fn models() -> &'static [Model] {
    static MADE: OnceLock<Vec<Model>> = OnceLock::new();
    MADE.get_or_init(|| NAMES.into_iter().map(make).collect())
}

/// The sheets that cover the body, without trimmings.
const SHEETS: [&str; 4] = ["sweater", "cardigan", "hoodie", "trousers"];

#[test]
fn clothes_keep_within_their_budgets() {
    for m in models() {
        let triangles: usize = m.figure.meshes.iter().map(|x| x.indices.len() / 3).sum();
        let vertices: usize = m.figure.meshes.iter().map(|x| x.positions.len()).sum();
        let bytes = 25 * vertices + 6 * triangles;
        assert!(triangles <= 26_200, "{}: {triangles} triangles", m.name);
        assert!(bytes <= 650_000, "{}: {bytes} bytes", m.name);
        assert!(
            m.figure.meshes.len() <= 6,
            "{}: {}",
            m.name,
            m.figure.meshes.len()
        );
    }
}

#[test]
fn no_skin_comes_through_at_rest() {
    for m in models() {
        let sheets = m
            .clothes
            .parts
            .iter()
            .filter(|p| SHEETS.contains(&p.name.as_str()));
        for part in sheets {
            for v in &part.vertices {
                let d = m.field.value(v.position, Regions::ALL, 1.0);
                assert!(d > 5e-4, "{} {} {}: {d}", m.name, part.name, v.position);
            }
        }
    }
}

#[test]
fn cloth_is_sound() {
    for m in models() {
        for part in &m.clothes.parts {
            let edges = edge_faces(&part.faces);
            assert!(
                edges.values().all(|f| f.len() <= 2),
                "{} {}",
                m.name,
                part.name
            );
            for v in &part.vertices {
                assert!(
                    v.position.is_finite() && v.uv.iter().all(|x| x.abs() <= 1.0),
                    "{}",
                    part.name
                );
                assert!(
                    v.color.iter().all(|c| (0.0..=1.0 + 1e-9).contains(c)),
                    "{}",
                    part.name
                );
                assert!(!v.weights.is_empty(), "the cloth vertex has weights");
            }
        }
    }
}

#[test]
fn every_visible_edge_has_a_band() {
    for m in models() {
        let of = |names: &[&str]| -> Vec<DVec3> {
            let parts = m
                .clothes
                .parts
                .iter()
                .filter(|p| names.contains(&p.name.as_str()));
            parts
                .flat_map(|p| p.vertices.iter().map(|v| v.position))
                .collect()
        };
        let trims = of(&["band", "trim", "collar", "trousers"]);
        for part in &m.clothes.parts {
            if !["sweater", "cardigan", "hoodie"].contains(&part.name.as_str()) {
                continue;
            }
            // Ends of cloth, not the seams of texture coordinates.
            let welded = weld(part);
            for ((a, _), faces) in edge_faces(&welded) {
                if faces.len() == 1 {
                    let p = part.vertices[a as usize].position;
                    let near = trims.iter().map(|q| q.distance(p)).fold(f64::MAX, f64::min);
                    assert!(near < 0.02, "{} {} {p}: {near}", m.name, part.name);
                }
            }
        }
    }
}

fn weld(part: &MeshPart) -> Vec<Vec<u32>> {
    let mut first = BTreeMap::new();
    let names: Vec<u32> = part
        .vertices
        .iter()
        .zip(0u32..)
        .map(|(v, i)| {
            let key = v.position.to_array().map(|x| (x * 1e6).round() as i64);
            *first.entry(key).or_insert(i)
        })
        .collect();
    let rename = |f: &Vec<u32>| f.iter().map(|&v| names[v as usize]).collect();
    part.faces.iter().map(rename).collect()
}

#[test]
fn the_same_person_is_dressed_the_same() {
    let again = make("nuno");
    let first = models().iter().find(|m| m.name == "nuno").unwrap();
    for (a, b) in again.figure.meshes.iter().zip(&first.figure.meshes) {
        assert_eq!(
            (&a.positions, &a.indices, &a.colors),
            (&b.positions, &b.indices, &b.colors)
        );
    }
}

/// The bind pose with rotations in world axes added.
fn posed(figure: &Figure, turns: &[(Bone, DQuat)]) -> Vec<DAffine3> {
    let world = |b: Bone| {
        figure.inverse_bind[b.index()]
            .inverse()
            .to_scale_rotation_translation()
            .1
    };
    let mut pose = Pose::zero();
    for bone in Bone::ALL {
        let local = bone
            .parent()
            .map_or(world(bone), |p| world(p).inverse() * world(bone));
        let zero = figure.skeleton.joints()[bone.index()].zero_rotation;
        pose.set(bone, zero.inverse() * local);
    }
    for &(bone, turn) in turns {
        let b = world(bone);
        pose.set(bone, pose.rotation(bone) * (b.inverse() * turn * b));
    }
    let mut joints = Vec::new();
    figure.skeleton.solve(&pose, &mut joints);
    joints
        .iter()
        .zip(&figure.inverse_bind)
        .map(|(w, b)| *w * *b)
        .collect()
}

/// Returns the stretch of the edges (1st and 99th percentile) and the share of triangles that are
/// inverted, relative to their skinned normals.
fn strain(figure: &Figure, skin: &[DAffine3]) -> (f64, f64, f64) {
    let mut stretch = Vec::new();
    let (mut turned, mut all) = (0usize, 0usize);
    for mesh in &figure.meshes {
        let rest = |i: u32| DVec3::from_array(mesh.positions[i as usize].map(f64::from));
        let blend = |i: u32, of: &dyn Fn(&DAffine3) -> DVec3| -> DVec3 {
            let v = i as usize;
            (0..4)
                .map(|k| of(&skin[usize::from(mesh.joints[v][k])]) * f64::from(mesh.weights[v][k]))
                .sum()
        };
        let moved = |i: u32| blend(i, &|m| m.transform_point3(rest(i)));
        for t in mesh.indices.chunks_exact(3) {
            let (p, q) = (
                [0, 1, 2].map(|k| rest(t[k])),
                [0, 1, 2].map(|k| moved(t[k])),
            );
            for k in 0..3 {
                let l = (k + 1) % 3;
                // Grooves of seams are too short to measure.
                if p[k].distance(p[l]) > 5e-3 {
                    stretch.push(q[k].distance(q[l]) / p[k].distance(p[l]));
                }
            }
            let normal = (p[1] - p[0]).cross(p[2] - p[0]);
            let carried: DVec3 = t
                .iter()
                .map(|&i| blend(i, &|m| m.transform_vector3(normal)))
                .sum();
            let now = (q[1] - q[0]).cross(q[2] - q[0]);
            all += 1;
            turned += usize::from(now.dot(carried) < -0.3 * now.length() * carried.length());
        }
    }
    stretch.sort_by(f64::total_cmp);
    let at = |share: f64| stretch[(stretch.len() as f64 * share) as usize];
    (at(0.01), at(0.99), turned as f64 / all as f64)
}

#[test]
fn raised_arms_and_bent_elbows_are_borne() {
    for m in models() {
        let mut turns = Vec::new();
        for side in Side::BOTH {
            let up = |a: f64| DQuat::from_rotation_z(side.sign() * a);
            // From 48° below to 70° above the horizontal; the scapula takes 0.42 of it.
            turns.push((Bone::on(side, "scapula"), up(2.06 * 0.42)));
            turns.push((Bone::on(side, "shoulder"), up(2.06 * 0.58)));
            let axis = Joints::arm_axis().cross(DVec3::Z) * DVec3::new(1.0, side.sign(), 1.0);
            let bend = DQuat::from_axis_angle(axis, side.sign() * 2.44);
            turns.push((Bone::on(side, "elbow"), bend));
        }
        let (short, long, turned) = strain(&m.figure, &posed(&m.figure, &turns));
        assert!(long < 3.0 && short > 0.15, "{}: {short} {long}", m.name);
        assert!(turned < 0.01, "{}: {turned} inside out", m.name);
    }
}

#[test]
fn sitting_is_borne() {
    for m in models() {
        let mut turns = Vec::new();
        for side in Side::BOTH {
            let bend = |deg: f64| DQuat::from_rotation_x(deg.to_radians());
            turns.push((Bone::on(side, "hip"), bend(-90.0)));
            turns.push((Bone::on(side, "knee"), bend(90.0)));
        }
        let (short, long, turned) = strain(&m.figure, &posed(&m.figure, &turns));
        assert!(long < 3.0 && short > 0.1, "{}: {short} {long}", m.name);
        assert!(turned < 0.02, "{}: {turned} inside out", m.name);
        assert!(
            m.joints.position_of(Bone::LHip).y > 0.0,
            "the hip of the seated figure is above the floor"
        );
    }
}

#[test]
fn no_sheet_has_a_hole_or_a_face_turned_over() {
    for m in models() {
        let (name, parts) = (m.name, &m.clothes.parts);
        let tops = ["sweater", "cardigan", "hoodie"];
        for part in parts.iter().filter(|p| tops.contains(&p.name.as_str())) {
            // Charts duplicate the vertices where they meet, so positions count.
            let mut places = BTreeMap::new();
            let mut points = Vec::new();
            let of: Vec<u32> = part
                .vertices
                .iter()
                .map(|v| {
                    *places
                        .entry(v.position.to_array().map(f64::to_bits))
                        .or_insert_with(|| {
                            points.push(v.position);
                            points.len() as u32 - 1
                        })
                })
                .collect();
            let faces = part.faces.iter();
            let shell = Shell {
                points,
                weights: Vec::new(),
                faces: faces
                    .map(|f| f.iter().map(|&v| of[v as usize]).collect())
                    .collect(),
            };
            // Hem, two cuffs, and the neck or the open front.
            let least = shell.loops().iter().map(Vec::len).min();
            assert_eq!(shell.loops().len(), 4, "{name}, {}: {least:?}", part.name);
        }
    }
}

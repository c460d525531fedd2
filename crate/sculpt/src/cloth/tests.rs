//! Clothes of the three named figures: fit, soundness, budgets, and how they bear poses.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use raconteur_base::{DAffine3, DQuat, DVec3, Side, ops};

use super::{Dressed, Wearer, dress};
use crate::assemble::{Blueprint, Piece, assemble};
use crate::mannequin::Mannequin;
use crate::part::MeshPart;
use crate::people::{NAMES, preset};
use crate::subdivide::edge_faces;
use crate::torso::{Field, Joints, Regions, Shell};
use raconteur_body::figure::Figure;
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::{Bone, FacePlaces};

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
    } = Mannequin::of(&params);
    let clothes = dress(
        &Wearer::new(&params.body(), &field, &cage, &joints, &neck),
        &params.wardrobe,
    );
    let eye = joints.at(Bone::Skull);
    let figure = assemble(&Blueprint {
        name: name.to_owned(),
        positions_in_world: joints.positions,
        bind_rotations: joints.rotations,
        face: FacePlaces {
            eye_centres: [eye, eye],
        },
        stature_m: params.person.stature_m,
        lid_closure_rad: [0.6; 2],
        pieces: clothes.parts.iter().cloned().map(Piece::from).collect(),
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
                assert!(!v.weights.is_empty());
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

/// Stretch of the edges (1st and 99th percentile) and the share of triangles that end up
/// inside out, against their normals carried along.
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
        assert!(m.joints.at(Bone::LHip).y > 0.0);
    }
}

/// Points all over a part, a few millimetres apart.
fn points_on(part: &MeshPart) -> impl Iterator<Item = DVec3> {
    const STEPS: usize = 6;
    let triangles = part.triangles_about_middles(|_| true);
    triangles.into_iter().flat_map(|[a, b, c]| {
        (0..=STEPS).flat_map(move |i| {
            (0..=STEPS - i).map(move |j| {
                let (s, t) = (i as f64 / STEPS as f64, j as f64 / STEPS as f64);
                a + (b - a) * s + (c - a) * t
            })
        })
    })
}

/// Where a ray first meets a triangle, and whether from its front.
fn met(from: DVec3, way: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<(f64, bool)> {
    let (u, v) = (*b - *a, *c - *a);
    let h = way.cross(v);
    let area = u.dot(h);
    if area.abs() < 1e-15 {
        return None;
    }
    let d = from - *a;
    let s = d.dot(h) / area;
    let q = d.cross(u);
    let t = way.dot(q) / area;
    let along = v.dot(q) / area;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && along > 0.0).then_some((along, area > 0.0))
}

/// Triangles by the levels that they reach through, so that a ray is not tried on all of them.
struct Levels<'a>(BTreeMap<i32, Vec<&'a [DVec3; 3]>>);

impl<'a> Levels<'a> {
    const HEIGHT_M: f64 = 0.01;

    fn level(y: f64) -> i32 {
        (y / Self::HEIGHT_M).floor() as i32
    }

    fn of(triangles: &'a [[DVec3; 3]]) -> Self {
        let mut levels: BTreeMap<i32, Vec<&[DVec3; 3]>> = BTreeMap::new();
        for t in triangles {
            let low = t.iter().map(|p| p.y).fold(f64::MAX, f64::min);
            let high = t.iter().map(|p| p.y).fold(f64::MIN, f64::max);
            for level in Self::level(low)..=Self::level(high) {
                levels.entry(level).or_default().push(t);
            }
        }
        Self(levels)
    }

    /// All triangles that reach between two heights, some twice.
    fn between(&self, low: f64, high: f64) -> impl Iterator<Item = &'a [DVec3; 3]> {
        let range = Self::level(low)..=Self::level(high);
        self.0.range(range).flat_map(|(_, all)| all.iter().copied())
    }
}

#[test]
fn a_collar_lies_against_the_neck_all_round() {
    const SECTORS: usize = 72;
    /// What lies farther from a collar is not what it lies on, metres.
    const FAR_M: f64 = 0.1;
    for m in models() {
        let skin = Levels::of(&m.skin);
        let collar = m.clothes.parts.iter().find(|p| p.name == "collar");
        let middle = m.field.neck_centre(m.joints.at(Bone::Cervical).y);
        let mut round = vec![Vec::new(); SECTORS];
        for p in points_on(collar.unwrap()) {
            let turn = (ops::atan2(p.x, p.z - middle.z) / core::f64::consts::TAU).rem_euclid(1.0);
            round[(turn * SECTORS as f64) as usize % SECTORS].push(p);
        }
        for (k, points) in round.iter().enumerate() {
            let top = points.iter().map(|p| p.y).fold(f64::MIN, f64::max);
            let edge = points.iter().filter(|p| p.y > top - 0.005);
            // How far the skin is, inwards or where it slopes down; what lies in it is not off.
            let off = edge.map(|p| {
                let level = (m.field.neck_centre(p.y) - *p).normalize();
                let to = |way: DVec3| {
                    let low = p.y + (way.y * FAR_M).min(0.0);
                    let near = skin.between(low, p.y);
                    near.filter_map(move |t| met(*p, way, t))
                };
                let down = (level + DVec3::NEG_Y).normalize();
                let hits = to(level).chain(to(down)).map(|h| h.0);
                let distance = hits.fold(f64::MAX, f64::min);
                // Below its rim the skin is the body's.
                match to(-level).next() {
                    Some(_) => 0.0,
                    None if distance < FAR_M => distance,
                    None => m.field.value(*p, Regions::ALL, 1.0),
                }
            });
            let off = off.fold(f64::MAX, f64::min);
            // The thickness of a sweater's rib and a millimetre; a T-shirt falls into no hollow.
            assert!(off < 0.006, "{} at {}°: {off} m", m.name, 5 * k);
        }
    }
}

#[test]
fn nothing_is_seen_from_behind_at_the_throat() {
    /// Rays of a view lie at most √(0.04² + 0.064²) from its middle, metres.
    const BEAM_M: f64 = 0.076;
    for m in models() {
        let y = m.joints.at(Bone::Cervical).y;
        let middle = m.field.neck_centre(y);
        let near = |t: &[DVec3; 3]| t.iter().any(|p| p.distance(middle) < 0.2);
        let cloth: Vec<(&str, [DVec3; 3])> = m
            .clothes
            .parts
            .iter()
            .flat_map(|p| {
                let triangles = p.triangles_about_middles(|_| true).into_iter();
                triangles.map(|t| (p.name.as_str(), t))
            })
            .filter(|(_, t)| near(t))
            .collect();
        for view in 0..15 {
            let (yaw, pitch) = (
                0.3 * (f64::from(view / 3) - 2.0),
                0.4 * (f64::from(view % 3) - 1.0),
            );
            let (up, flat) = ops::sincos(pitch);
            let (aside, ahead) = ops::sincos(yaw);
            let towards = DVec3::new(aside * flat, up, ahead * flat);
            let front = middle + DVec3::new(0.0, 0.0, m.field.neck_radius());
            // No ray of a view is farther from its middle one.
            let reached = |t: &&[DVec3; 3]| {
                let aside = t.map(|p| (p - front).reject_from_normalized(towards).length());
                let size = t[0].distance(t[1]).max(t[0].distance(t[2]));
                aside.iter().any(|d| *d < BEAM_M + size)
            };
            let skin: Vec<&[DVec3; 3]> = m.skin.iter().filter(reached).collect();
            let cloth: Vec<_> = cloth.iter().filter(|c| reached(&&c.1)).collect();
            for i in 0..231 {
                let (x, up) = (
                    0.004 * f64::from(i % 21 - 10),
                    0.008 * f64::from(i / 21 - 8),
                );
                let from = front + DVec3::new(x, up, 0.0) + towards;
                let skin = skin.iter().filter_map(|t| met(from, -towards, t));
                let skin = skin.map(|s| s.0).fold(f64::MAX, f64::min);
                let first = cloth
                    .iter()
                    .filter_map(|(name, t)| {
                        met(from, -towards, t).map(|(d, front)| (d, front, name))
                    })
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((d, front, name)) = first {
                    // Below the head's skin the body's own lies up to 11 mm under its field.
                    let inside = |along: f64| {
                        m.field.value(from - towards * along, Regions::ALL, 1.0) < -0.012
                    };
                    let steps = (d / 0.004) as usize;
                    let hidden = || (200..steps).any(|i| inside(0.004 * i as f64));
                    assert!(
                        front || d > skin || hidden(),
                        "{} {name} from {yaw}, {pitch}: {x}, {up}",
                        m.name
                    );
                }
            }
        }
    }
}

#[test]
fn no_sheet_has_a_hole_or_a_face_turned_over() {
    for m in models() {
        let (name, parts) = (m.name, &m.clothes.parts);
        let tops = ["sweater", "cardigan", "hoodie"];
        for part in parts.iter().filter(|p| tops.contains(&p.name.as_str())) {
            // Charts double the vertices where they meet: places count.
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

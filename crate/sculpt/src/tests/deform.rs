//! Tests of bent joints: loss of volume and self-intersection of skin.
//!
//! **Local volume.** The piece consists of the faces whose centres lie between two planes
//! perpendicular to the limb, slightly before and after the joint, at rest; every open edge loop of
//! that piece is closed by a fan to its centre. The enclosed volume is computed by the divergence
//! theorem, at rest and for the same faces posed.
//!
//! **Crossing.** As in [`crossing`](crate::crossing). In the crease, skin presses on skin, which a
//! posed surface without contact can only show as overlap: triangles of the hollow side, within 1.3
//! radii of the limb along it from the joint, do not count.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use raconteur_base::{DAffine3, DQuat, DVec3, Side};

use crate::assemble::{Blueprint, PartWithNormals, assemble};
use crate::part::{MeshPart, PartVertex};
use crate::tests::soundness::shipped;
use crate::torso::{Cage, Field, Joints};
use raconteur_base::self_intersection::crossings;
use raconteur_body::figure::{Figure, Material, MaterialKind, Mesh, TextureMaps};
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::{Bone, FaceJoints};

/// Sofia, and the shell of her body under the clothes on its own skeleton.
struct Case {
    figure: &'static Figure,
    body: Figure,
}

fn sofia() -> &'static Case {
    static MADE: OnceLock<Case> = OnceLock::new();
    MADE.get_or_init(|| {
        let (params, built) = shipped("sofia");
        let joints = Joints::place(&params.body());
        let field = Field::new(&params.body(), &joints);
        let (shell, _) = Cage::new(&field, &joints).shell.subdivided(1);
        let part = MeshPart {
            name: "body".to_owned(),
            material: Material {
                kind: MaterialKind::Skin,
                base_color: [1.0; 4],
                roughness: 0.5,
                double_sided: false,
                maps: TextureMaps::default(),
            },
            vertices: shell
                .points
                .iter()
                .zip(&shell.weights)
                .map(|(p, w)| PartVertex {
                    position: *p,
                    uv: [0.0; 2],
                    color: [1.0; 4],
                    weights: w.refs(),
                })
                .collect(),
            faces: shell.faces.clone(),
            morphs: Vec::new(),
            bound: Vec::new(),
        };
        let body = assemble(&Blueprint {
            name: "body".to_owned(),
            positions_in_world: joints.positions,
            bind_rotations: joints.rotations,
            face: FaceJoints {
                eye_centres: [DVec3::new(0.03, 1.5, 0.08), DVec3::new(-0.03, 1.5, 0.08)],
            },
            stature_m: params.person.stature_m,
            lid_closure_rad: [0.6; 2],
            pieces: vec![PartWithNormals::from(part)],
            chains: Vec::new(),
            images: Vec::new(),
        });
        Case {
            figure: &built.figure,
            body,
        }
    })
}

fn bind_of(figure: &Figure, bone: Bone) -> DAffine3 {
    figure.inverse_bind[bone.index()].inverse()
}

fn turn_of(figure: &Figure, bone: Bone) -> DQuat {
    bind_of(figure, bone).to_scale_rotation_translation().1
}

/// The bind pose with rotations added to bones, each in the bone's own axes.
fn posed(figure: &Figure, turns: &[(Bone, DQuat)]) -> Vec<DAffine3> {
    let mut pose = Pose::zero();
    for bone in Bone::ALL {
        let world = turn_of(figure, bone);
        let local = bone
            .parent()
            .map_or(world, |p| turn_of(figure, p).inverse() * world);
        let zero = figure.skeleton.joints()[bone.index()].zero_rotation;
        pose.set(bone, zero.inverse() * local);
    }
    for (bone, q) in turns {
        pose.set(*bone, pose.rotation(*bone) * *q);
    }
    let mut world = Vec::new();
    figure.skeleton.solve(&pose, &mut world);
    world
        .iter()
        .zip(&figure.inverse_bind)
        .map(|(w, b)| *w * *b)
        .collect()
}

/// A piece of a mesh around a joint.
struct Cut<'a> {
    mesh: &'a Mesh,
    triangles: Vec<[u32; 3]>,
    loops: Vec<Vec<u32>>,
}

fn rest(mesh: &Mesh, v: u32) -> DVec3 {
    DVec3::from_array(mesh.positions[v as usize].map(f64::from))
}

fn middle(mesh: &Mesh, t: &[u32; 3]) -> DVec3 {
    t.iter().map(|&v| rest(mesh, v)).sum::<DVec3>() / 3.0
}

impl<'a> Cut<'a> {
    fn new(mesh: &'a Mesh, keep: impl Fn(DVec3) -> bool) -> Self {
        // Vertices at one position are one: seams of texture coordinates are not edges.
        let mut first: BTreeMap<[i64; 3], u32> = BTreeMap::new();
        let mut one = |v: u32| {
            let key = mesh.positions[v as usize].map(|x| (f64::from(x) * 1e6).round() as i64);
            *first.entry(key).or_insert(v)
        };
        let mut triangles: Vec<[u32; 3]> = mesh
            .indices
            .chunks_exact(3)
            .map(|t| [t[0], t[1], t[2]])
            .filter(|t| keep(middle(mesh, t)))
            .map(|t| t.map(&mut one))
            .collect();
        triangles.retain(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        let mut next: BTreeMap<u32, u32> = BTreeMap::new();
        let directed: BTreeMap<(u32, u32), ()> = triangles
            .iter()
            .flat_map(|t| (0..3).map(|k| ((t[k], t[(k + 1) % 3]), ())))
            .collect();
        for (a, b) in directed.keys() {
            if !directed.contains_key(&(*b, *a)) {
                next.insert(*b, *a);
            }
        }
        let mut loops = Vec::new();
        while let Some((start, mut at)) = next.pop_first() {
            let mut ring = vec![start];
            while at != start {
                ring.push(at);
                match next.remove(&at) {
                    Some(n) => at = n,
                    None => break,
                }
            }
            loops.push(ring);
        }
        assert!(triangles.len() > 40, "{} triangles", triangles.len());
        Self {
            mesh,
            triangles,
            loops,
        }
    }

    fn place(&self, skin: &[DAffine3]) -> BTreeMap<u32, DVec3> {
        let mesh = self.mesh;
        self.triangles
            .iter()
            .flatten()
            .map(|&v| {
                let p = rest(mesh, v);
                let i = v as usize;
                let q = (0..4)
                    .map(|k| {
                        let m = skin[usize::from(mesh.joints[i][k])];
                        m.transform_point3(p) * f64::from(mesh.weights[i][k])
                    })
                    .sum();
                (v, q)
            })
            .collect()
    }

    fn volume(&self, at: &BTreeMap<u32, DVec3>) -> f64 {
        // About a point near by: caps and sides then cancel well.
        let origin = at.values().sum::<DVec3>() / at.len() as f64;
        let six =
            |a: DVec3, b: DVec3, c: DVec3| (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
        let sides: f64 = self
            .triangles
            .iter()
            .map(|t| six(at[&t[0]], at[&t[1]], at[&t[2]]))
            .sum();
        let caps: f64 = self
            .loops
            .iter()
            .map(|ring| {
                let centre = ring.iter().map(|v| at[v]).sum::<DVec3>() / ring.len() as f64;
                (0..ring.len())
                    .map(|i| six(at[&ring[i]], at[&ring[(i + 1) % ring.len()]], centre))
                    .sum::<f64>()
            })
            .sum();
        sides + caps
    }

    /// Counts crossing pairs among the triangles accepted by `counts` at their rest position.
    fn crossings(&self, at: &BTreeMap<u32, DVec3>, counts: impl Fn(DVec3) -> bool) -> usize {
        let counted: Vec<[u32; 3]> = self
            .triangles
            .iter()
            .filter(|t| counts(middle(self.mesh, t)))
            .copied()
            .collect();
        let mut points = vec![DVec3::ZERO; self.mesh.positions.len()];
        for (&v, &p) in at {
            points[v as usize] = p;
        }
        crossings(&points, &counted).len()
    }
}

/// A joint's trial: the mesh, the faces around it, the bend, and where the hollow is.
struct Trial<'a> {
    name: &'a str,
    figure: &'a Figure,
    mesh: &'a Mesh,
    joint: DVec3,
    along: DVec3,
    /// Towards the inside of the bend.
    hollow: DVec3,
    reach: (f64, f64),
    /// Radius of the limb, metres.
    thickness: f64,
    turns: Vec<(Bone, DQuat)>,
}

impl Trial<'_> {
    /// Share of the local volume that is lost, and crossings outside the crease.
    fn run(&self) -> (f64, usize) {
        let local = |p: DVec3| p - self.joint;
        let keep = |p: DVec3| {
            let d = local(p);
            let t = d.dot(self.along);
            t > -self.reach.0
                && t < self.reach.1
                && (d - self.along * t).length() < self.thickness * 1.6
        };
        let cut = Cut::new(self.mesh, keep);
        let before = cut.place(&posed(self.figure, &[]));
        let after = cut.place(&posed(self.figure, &self.turns));
        let loss = 1.0 - cut.volume(&after) / cut.volume(&before);
        let counts = |p: DVec3| {
            let d = local(p);
            d.dot(self.hollow) < 0.0 || d.dot(self.along).abs() > 1.3 * self.thickness
        };
        let crossings = cut.crossings(&after, counts);
        println!(
            "{}: loss {:.1} %, {crossings} crossings",
            self.name,
            loss * 100.0
        );
        (loss, crossings)
    }
}

fn check(trials: &[Trial<'_>]) {
    for (trial, (loss, crossings)) in trials.iter().map(|t| (t, t.run())) {
        assert!(loss < 0.15, "{}: {:.1} % lost", trial.name, loss * 100.0);
        assert_eq!(crossings, 0, "{}", trial.name);
    }
}

fn mesh_of(figure: &Figure, near: DVec3, kind: MaterialKind) -> &Mesh {
    let distance = |m: &&Mesh| {
        m.positions
            .iter()
            .map(|p| DVec3::from_array(p.map(f64::from)).distance(near))
            .fold(f64::INFINITY, f64::min)
    };
    figure
        .meshes
        .iter()
        .filter(|m| m.material.kind == kind)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .unwrap()
}

fn direction(figure: &Figure, from: Bone, to: Bone) -> DVec3 {
    (bind_of(figure, to).translation - bind_of(figure, from).translation).normalize()
}

#[test]
fn bent_fingers_keep_their_volume() {
    let figure = sofia().figure;
    let mut trials = Vec::new();
    let names =
        ["index", "middle", "ring", "pinky"].map(|f| (0..3).map(move |k| format!("{f}{k}")));
    let names: Vec<String> = names.into_iter().flatten().collect();
    for name in &names {
        let bone = Bone::on(Side::Left, name);
        let frame = bind_of(figure, bone);
        // The knuckle's piece would include the webs; fingers bend 90° at the middle joint, 70° at
        // the last.
        let degrees: f64 = match name.as_bytes()[name.len() - 1] {
            b'0' => continue,
            b'1' => 90.0,
            _ => 70.0,
        };
        trials.push(Trial {
            name,
            figure,
            mesh: mesh_of(figure, frame.translation, MaterialKind::Skin),
            joint: frame.translation,
            along: frame.transform_vector3(DVec3::X),
            hollow: frame.transform_vector3(DVec3::NEG_Y),
            reach: (0.0125, 0.0115),
            thickness: 0.0095,
            turns: vec![(bone, DQuat::from_rotation_z(-degrees.to_radians()))],
        });
    }
    check(&trials);
}

#[test]
fn bent_limbs_keep_their_volume() {
    let body = &sofia().body;
    let mesh = &body.meshes[0];
    let z = |deg: f64| DQuat::from_rotation_z(deg.to_radians());
    let at = |b: Bone| bind_of(body, b).translation;
    let along = direction(body, Bone::LShoulder, Bone::LElbow);
    let in_bone = |b: Bone, world: DQuat| {
        let q = turn_of(body, b);
        q.inverse() * world * q
    };
    let elbow = |name| Trial {
        name,
        figure: body,
        mesh,
        joint: at(Bone::LElbow),
        along,
        hollow: DVec3::Z,
        reach: (0.06, 0.06),
        thickness: 0.055,
        turns: vec![(Bone::LElbow, z(140.0))],
    };
    let shin = direction(body, Bone::LKnee, Bone::LSubtalar);
    let knee = Trial {
        name: "knee 120°",
        joint: at(Bone::LKnee),
        along: shin,
        hollow: DVec3::NEG_Z,
        reach: (0.09, 0.09),
        thickness: 0.085,
        turns: vec![(
            Bone::LKnee,
            in_bone(Bone::LKnee, DQuat::from_rotation_x(120f64.to_radians())),
        )],
        ..elbow("")
    };
    check(&[elbow("elbow 140°"), knee]);
}

#[test]
fn a_raised_shoulder_keeps_its_volume() {
    // 160° from hanging arms: 118° from the rest pose, 42 % of it by the shoulder girdle.
    let body = &sofia().body;
    let mesh = &body.meshes[0];
    let shoulder = bind_of(body, Bone::LShoulder).translation;
    let along = direction(body, Bone::LShoulder, Bone::LElbow);
    let up = |b: Bone, deg: f64| {
        let q = turn_of(body, b);
        (
            b,
            q.inverse() * DQuat::from_rotation_z(deg.to_radians()) * q,
        )
    };
    let turns = vec![
        up(Bone::LScapula, 118.0 * 0.42),
        up(Bone::LShoulder, 118.0 * 0.58),
    ];
    let cut = Cut::new(mesh, |p| {
        p.x > shoulder.x - 0.055
            && p.y > shoulder.y - 0.13
            && (p - shoulder).dot(along) < 0.11
            && p.y < shoulder.y + 0.1
    });
    let before = cut.place(&posed(body, &[]));
    let after = cut.place(&posed(body, &turns));
    let loss = 1.0 - cut.volume(&after) / cut.volume(&before);
    // Above the joint, the neck's slope meets the upper arm: that is the hollow of this bend.
    let crossings = cut.crossings(&after, |p| p.y < shoulder.y);
    println!(
        "shoulder: loss {:.1} %, {crossings} crossings",
        loss * 100.0
    );
    assert!(loss < 0.15, "{:.1} % lost", loss * 100.0);
    assert_eq!(crossings, 0);
}

#[test]
fn bent_and_twisted_wrists_keep_their_volume() {
    let figure = sofia().figure;
    let wrist = bind_of(figure, Bone::LWrist);
    let mesh = mesh_of(figure, wrist.translation, MaterialKind::Skin);
    let palmar = wrist.transform_vector3(DVec3::Z);
    let trial = |name, hollow: DVec3, q: DQuat| Trial {
        name,
        figure,
        mesh,
        joint: wrist.translation,
        along: direction(figure, Bone::LElbow, Bone::LWrist),
        hollow,
        reach: (0.035, 0.03),
        thickness: 0.03,
        turns: vec![(Bone::LWrist, q)],
    };
    let y = |deg: f64| DQuat::from_rotation_y(deg.to_radians());
    // The direction of rotation about the thumb's side that turns the palm inwards.
    let sign = if (y(70.0) * DVec3::X).z > 0.0 {
        1.0
    } else {
        -1.0
    };
    check(&[
        trial("wrist flexed 70°", palmar, y(70.0 * sign)),
        trial("wrist extended 70°", -palmar, y(-70.0 * sign)),
        trial(
            "wrist twisted 75°",
            palmar,
            DQuat::from_rotation_x(75f64.to_radians()),
        ),
        trial(
            "wrist twisted −75°",
            palmar,
            DQuat::from_rotation_x(-75f64.to_radians()),
        ),
    ]);
}

#[test]
fn the_sleeve_keeps_its_volume() {
    let figure = sofia().figure;
    let joint = bind_of(figure, Bone::LElbow).translation;
    check(&[Trial {
        name: "sleeve, elbow 140°",
        figure,
        mesh: mesh_of(figure, joint, MaterialKind::Cloth),
        joint,
        along: direction(figure, Bone::LShoulder, Bone::LElbow),
        hollow: DVec3::Z,
        reach: (0.07, 0.07),
        thickness: 0.065,
        turns: vec![(Bone::LElbow, DQuat::from_rotation_z(140f64.to_radians()))],
    }]);
}

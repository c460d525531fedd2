//! How the parts of a figure come together.

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, Side};

use super::assemble::{Blueprint, Piece, assemble};
use super::bones;
use super::built::Built;
use super::cloth::finish::openness;
use super::cloth::{Wearer, dress};
use super::hair;
use super::hand::{self, HandParams, HandSheet};
use super::head::Head;
use super::levels;
use super::mannequin::Mannequin;
use super::part::{self, MeshPart, PartVertex};
use super::people::FigureParams;
use super::skin;
use super::springs;
use super::tissue;
use super::torso::{CM, Cage, Field, Joints, Shell};
use raconteur_base::surface::vertex_normals;
use raconteur_body::annotation::{Annotations, Landmark, Segment};
use raconteur_body::figure::{Figure, Maps, Material, MaterialKind};
use raconteur_body::skeleton::{Bone, FacePlaces, zero_frames};
use raconteur_tissue::Tissue;

/// The skin's pictures among a figure's images.
const SKIN_MAPS: Maps = Maps {
    base_color: Some(0),
    normal: Some(1),
    wrinkles: Some(2),
};

/// Clothes that hair may touch lie within this distance of the middle of the head, metres.
const NEAR_HEAD_M: f64 = 0.45;

/// Builds a figure. The same parameters give the same figure to the bit.
#[must_use]
pub fn build(params: &FigureParams) -> Built {
    let Mannequin {
        head,
        world_from_head,
        mut head_parts,
        mut joints,
        field,
        cage,
        neck: collar_line,
    } = Mannequin::of(params);
    let body = params.body();
    let wearer = Wearer::new(&body, &field, &cage, &joints, &collar_line);
    let clothes = dress(&wearer, &params.wardrobe);

    let near_head = near(&clothes.parts, world_from_head);
    let mut grown = hair::hair(&head, &params.hair, &near_head);
    for v in grown.pieces.iter_mut().flat_map(|h| &mut h.part.vertices) {
        v.position = world_from_head.transform_point3(v.position);
    }
    for p in grown.chains.iter_mut().flat_map(|c| &mut c.points) {
        *p = world_from_head.transform_point3(*p);
    }
    for (v, light) in head_parts[0].vertices.iter_mut().zip(&grown.skin_light) {
        v.color[3] *= light;
    }

    let mut pieces: Vec<Piece> = Vec::new();
    let hand = params.hands();
    let hands = Side::BOTH.map(|side| place_hand(&hand, side, &mut joints));
    let maps = skin::bake(&params.skin, &head.sheet, &hands[0].1, grown.cap.as_ref());
    pieces.extend(head_parts.into_iter().map(Piece::from));
    pieces.extend(
        hands
            .into_iter()
            .flat_map(|(parts, _)| parts)
            .map(Piece::from),
    );
    pieces.push(neck(&field, &cage, &head, world_from_head).into());
    pieces.extend(clothes.parts.into_iter().map(Piece::from));
    pieces.extend(grown.pieces);

    for piece in &mut pieces {
        let material = &mut piece.part.material;
        if material.kind == MaterialKind::Skin {
            material.maps = SKIN_MAPS;
        }
    }

    let mut figure = assemble(&Blueprint {
        name: params.name.clone(),
        positions_in_world: joints.positions,
        bind_rotations: joints.rotations,
        face: FacePlaces {
            eye_centres: head
                .eye_centres
                .map(|p| world_from_head.transform_point3(p)),
        },
        stature_m: params.person.stature_m,
        lid_closure_rad: head.lid_closure_rad,
        pieces,
        chains: grown.chains.clone(),
        images: vec![maps.colour, maps.normal, maps.wrinkles],
    });
    figure.sex = Some(params.person.sex);
    figure.springs = springs::of(&figure, &grown.chains);
    figure.tissue = Some(face_tissue(&head, world_from_head, &figure));
    leave_to_tissue(&mut figure);
    let annotations = annotations(&head, &figure);
    levels::add(&mut figure, &annotations);
    levels::sort_triangles(&mut figure);
    Built {
        figure,
        annotations,
    }
}

/// The surface of clothes about the head, in its frame: what hair lies on.
pub(super) fn near(clothes: &[MeshPart], world_from_head: DAffine3) -> Vec<hair::Sample> {
    let head_from_world = world_from_head.inverse();
    clothes
        .iter()
        .flat_map(|part| {
            let positions: Vec<DVec3> = part.vertices.iter().map(|v| v.position).collect();
            let normals = vertex_normals(&positions, &part.faces);
            positions.into_iter().zip(normals)
        })
        .map(|(p, normal)| hair::Sample {
            position: head_from_world.transform_point3(p),
            normal,
        })
        .filter(|s| s.position.length() < NEAR_HEAD_M)
        .collect()
}

/// Builds the head alone, with what moves under its skin, on the skeleton of the whole: enough to
/// try what a face does, in a fraction of the time. It has no hair, hands, clothes or maps.
#[must_use]
pub fn build_face(params: &FigureParams) -> Built {
    let made = Mannequin::of(params);
    let place = made.world_from_head;
    let mut figure = assemble(&Blueprint {
        name: params.name.clone(),
        positions_in_world: made.joints.positions,
        bind_rotations: made.joints.rotations,
        face: FacePlaces {
            eye_centres: made.head.eye_centres.map(|p| place.transform_point3(p)),
        },
        stature_m: params.person.stature_m,
        lid_closure_rad: made.head.lid_closure_rad,
        pieces: made.head_parts.into_iter().map(Piece::from).collect(),
        chains: Vec::new(),
        images: Vec::new(),
    });
    figure.sex = Some(params.person.sex);
    figure.tissue = Some(face_tissue(&made.head, place, &figure));
    leave_to_tissue(&mut figure);
    let annotations = annotations(&made.head, &figure);
    Built {
        figure,
        annotations,
    }
}

/// What moves under the skin of the face.
pub(super) fn face_tissue(head: &Head, place: DAffine3, figure: &Figure) -> Tissue {
    let mut rigid: Vec<MeshPart> = head.parts.clone();
    rigid.retain(|p| matches!(p.name.as_str(), part::TEETH | part::GUMS));
    for v in rigid.iter_mut().flat_map(|p| &mut p.vertices) {
        v.position = place.transform_point3(v.position);
    }
    let hinge = place.transform_point3(head.jaw_hinge);
    let rigid: Vec<&MeshPart> = rigid.iter().collect();
    tissue::tissue(&head.soft, &place, &bones::of_head(figure), &rigid, hinge)
}

/// The head's names on the mesh that its skin became: that mesh begins with the head.
fn annotations(head: &Head, figure: &Figure) -> Annotations {
    let name = &head.skin().name;
    let Some(mesh) = figure.meshes.iter().position(|m| m.name == *name) else {
        return Annotations::default();
    };
    Annotations {
        landmarks: head
            .landmarks
            .iter()
            .map(|(name, vertex)| Landmark {
                name: name.clone(),
                mesh,
                vertex: *vertex,
            })
            .collect(),
        segments: head
            .segments
            .iter()
            .map(|s| Segment {
                name: s.name.to_owned(),
                parent: s.parent,
                mesh,
                runs: s.runs.clone(),
            })
            .collect(),
    }
}

/// A hand in the world and its skin for the maps; its finger joints replace the skeleton's.
fn place_hand(params: &HandParams, side: Side, joints: &mut Joints) -> (Vec<MeshPart>, HandSheet) {
    let built = hand::build(params, side);
    let wrist = Bone::on(side, "wrist");
    let bind = joints.rotations[wrist.index()];
    let turn: DQuat = bind * zero_frames()[wrist.index()].inverse();
    let place = DAffine3::from_rotation_translation(turn, joints.at(wrist));
    for (bone, p) in built.joints {
        joints.positions[bone.index()] = place.transform_point3(p);
    }
    for (bone, q) in built.bind_in_wrist {
        joints.rotations[bone.index()] = bind * q;
    }
    let mut parts = built.parts;
    for part in &mut parts {
        for v in &mut part.vertices {
            // The end of the forearm draws in, so that it stays inside the cuff.
            let up = v.position.dot(built.forearm_direction);
            let axis = built.forearm_direction * up;
            v.position = axis + (v.position - axis) * (1.0 - 0.28 * smooth((up - 0.015) / 0.025));
            v.position = place.transform_point3(v.position);
        }
    }
    (parts, built.sheet)
}

/// The body's own neck, just below the head's skin and inside the collar.
fn neck(field: &Field, cage: &Cage, head: &Head, place: DAffine3) -> MeshPart {
    let (mut shell, _) = cage.part(|t| Cage::is_above(t, 0.826)).subdivided(1);
    let rim = head
        .neck_rim
        .iter()
        .map(|p| place.transform_point3(*p).y)
        .fold(f64::MIN, f64::max);
    let normals = shell.normals();
    for (p, n) in shell.points.iter_mut().zip(&normals) {
        // Two sheets at one place would flicker; above the rim the head's skin leaves the
        // body's, and this one must stay below it.
        let hidden = smooth((p.y - rim) / (1.5 * CM));
        *p -= *n * (0.2 + 0.9 * hidden) * CM;
    }
    let shell = shell.select(|f| {
        shell.faces[f]
            .iter()
            .any(|&v| shell.points[v as usize].y < rim + 1.0 * CM)
    });
    let material = Material {
        kind: MaterialKind::Skin,
        base_color: [1.0; 4],
        roughness: 0.48,
        double_sided: false,
        maps: Maps::default(),
    };
    let mut part = plain_part("neck", &shell, field, &material, [1.0; 3]);
    // Colours go on from the head's lower edge, darker inside the collar.
    let edge: Vec<&PartVertex> = head
        .skin()
        .vertices
        .iter()
        .filter(|v| place.transform_point3(v.position).y < rim + 1.5 * CM)
        .collect();
    for v in &mut part.vertices {
        let local = place.inverse().transform_point3(v.position);
        let near = edge.iter().min_by(|a, b| {
            a.position
                .distance_squared(local)
                .total_cmp(&b.position.distance_squared(local))
        });
        if let Some(near) = near {
            v.uv = near.uv;
            v.color = near.color;
            v.color[3] *= 0.75;
        }
    }
    part
}

fn plain_part(
    name: &str,
    shell: &Shell,
    field: &Field,
    material: &Material,
    rgb: [f64; 3],
) -> MeshPart {
    let normals = shell.normals();
    let [r, g, b] = rgb;
    MeshPart {
        name: name.to_owned(),
        material: material.clone(),
        vertices: shell
            .points
            .iter()
            .zip(&shell.weights)
            .zip(&normals)
            .map(|((p, w), n)| PartVertex {
                position: *p,
                uv: [p.x, p.y],
                color: [r, g, b, openness(field, *p, *n)],
                weights: w.refs(),
            })
            .collect(),
        faces: shell.faces.clone(),
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

/// Drops the morph targets of what follows the tissue: nothing moves it twice.
pub(super) fn leave_to_tissue(figure: &mut Figure) {
    for mesh in figure.meshes.iter_mut().filter(|m| m.binding.is_some()) {
        mesh.morphs.clear();
    }
    let used: Vec<bool> = (0..figure.morph_names.len())
        .map(|i| {
            figure
                .meshes
                .iter()
                .any(|m| m.morphs.iter().any(|t| t.target == i))
        })
        .collect();
    let kept = |i: usize| used[..i].iter().filter(|u| **u).count();
    for morph in figure.meshes.iter_mut().flat_map(|m| &mut m.morphs) {
        morph.target = kept(morph.target);
    }
    let mut place = 0..;
    figure
        .morph_names
        .retain(|_| place.next().is_some_and(|i| used[i]));
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use super::*;
    use crate::posed::{self, bind_pose, turn};
    use crate::tests::soundness::shipped;
    use raconteur_body::pose::Pose;
    use raconteur_body::read::read_figure;
    use raconteur_body::write::to_packed_glb;

    /// Sofia and her file, made once for all tests.
    fn sofia() -> (&'static Figure, &'static [u8]) {
        static MADE: OnceLock<Vec<u8>> = OnceLock::new();
        let Built {
            figure,
            annotations,
        } = &shipped("sofia").1;
        (
            figure,
            MADE.get_or_init(|| to_packed_glb(figure, annotations)),
        )
    }

    fn skinned(figure: &Figure, pose: &Pose, mesh: &raconteur_body::Mesh) -> Vec<DVec3> {
        let moved = posed::moved(figure, pose);
        let at = |v| mesh.skinned(&moved, v)[0];
        (0..mesh.positions.len()).map(at).collect()
    }

    #[test]
    fn every_vertex_is_sound() {
        let (figure, _) = sofia();
        for mesh in &figure.meshes {
            let n = mesh.positions.len();
            assert!(
                mesh.indices.iter().all(|&i| (i as usize) < n),
                "{}",
                mesh.name
            );
            for v in 0..n {
                let sum: f32 = mesh.weights[v].iter().sum();
                assert!((sum - 1.0).abs() < 1e-5, "{} {v} {sum}", mesh.name);
                assert!(
                    mesh.joints[v]
                        .iter()
                        .all(|&j| usize::from(j) < figure.skeleton.joints().len())
                );
                assert!(
                    mesh.positions[v]
                        .iter()
                        .chain(&mesh.uvs[v])
                        .all(|x| x.is_finite())
                );
                let length: f32 = mesh.normals[v].iter().map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 1e-3, "{} {v}", mesh.name);
            }
        }
    }

    #[test]
    fn the_budgets_hold() {
        let (figure, bytes) = sofia();
        let triangles: usize = figure.meshes.iter().map(|m| m.indices.len() / 3).sum();
        assert!(triangles <= 110_000, "{triangles} triangles");
        assert!(bytes.len() <= 2_400_000, "{} bytes", bytes.len());
        assert!(figure.meshes.len() <= 20, "{} meshes", figure.meshes.len());
    }

    #[test]
    fn she_is_as_tall_as_asked_and_stands_on_the_floor() {
        let (figure, _) = sofia();
        let heights = || {
            let solid = figure
                .meshes
                .iter()
                .filter(|m| m.material.kind != MaterialKind::Hair);
            solid.flat_map(|m| &m.positions).map(|p| f64::from(p[1]))
        };
        let (low, high) = (
            heights().fold(f64::MAX, f64::min),
            heights().fold(f64::MIN, f64::max),
        );
        assert!((high - 1.66).abs() < 0.005, "{high}");
        // Shoes reach to the floor within their sole's pattern.
        assert!(low.abs() < 0.005, "{low}");
    }

    /// Triangles, each with its least corner first: a packed file may turn them.
    fn turned(indices: &[u32]) -> Vec<[u32; 3]> {
        let triangles = indices.as_chunks::<3>().0.iter().copied();
        triangles
            .map(|mut t| {
                let least = (0..3).min_by_key(|&i| t[i]).unwrap_or(0);
                t.rotate_left(least);
                t
            })
            .collect()
    }

    #[test]
    fn the_file_gives_the_figure_back() {
        let (figure, bytes) = sofia();
        let back = read_figure("sofia", bytes).unwrap();
        assert_eq!(back.morph_names, figure.morph_names);
        assert_eq!(back.meshes.len(), figure.meshes.len());
        for (a, b) in back.meshes.iter().zip(&figure.meshes) {
            assert_eq!((&a.name, &a.colors), (&b.name, &b.colors));
            assert_eq!(a.joints, b.joints);
            assert_eq!(turned(&a.indices), turned(&b.indices), "{}", a.name);
            let levels = |m: &raconteur_body::Mesh| -> Vec<Vec<[u32; 3]>> {
                m.coarser.iter().map(|l| turned(l)).collect()
            };
            assert_eq!(levels(a), levels(b), "{}", a.name);
            for (p, q) in a
                .positions
                .iter()
                .flatten()
                .zip(b.positions.iter().flatten())
            {
                // Half a step of the file's grid.
                assert!((p - q).abs() < 1.7e-5, "{} {p} {q}", a.name);
            }
        }
        assert!(read_figure("sofia", &bytes[..bytes.len() / 2]).is_err());
    }

    #[test]
    fn the_bind_pose_leaves_every_vertex_in_place() {
        let (figure, _) = sofia();
        let pose = bind_pose(figure);
        for mesh in &figure.meshes {
            for (p, q) in skinned(figure, &pose, mesh).iter().zip(&mesh.positions) {
                let q = DVec3::from_array(q.map(f64::from));
                assert!(p.distance(q) < 1e-6, "{} {p} {q}", mesh.name);
            }
        }
    }

    #[test]
    fn raised_arms_and_bent_elbows_stretch_the_sweater_little() {
        let (figure, _) = sofia();
        let mesh = figure.meshes.iter().find(|m| m.name == "sweater").unwrap();
        let mut pose = bind_pose(figure);
        for side in Side::BOTH {
            let up = |a: f64| DQuat::from_rotation_z(side.sign() * a);
            // To 70° above the horizontal; the scapula takes 0.42 of it.
            turn(
                &mut pose,
                figure,
                Bone::on(side, "scapula"),
                up(2.06 * 0.42),
            );
            turn(
                &mut pose,
                figure,
                Bone::on(side, "shoulder"),
                up(2.06 * 0.58),
            );
            let axis = Joints::arm_axis().cross(DVec3::Z) * DVec3::new(1.0, side.sign(), 1.0);
            turn(
                &mut pose,
                figure,
                Bone::on(side, "elbow"),
                DQuat::from_axis_angle(axis, side.sign() * 2.44),
            );
        }
        let posed = skinned(figure, &pose, mesh);
        let rest = |i: u32| DVec3::from_array(mesh.positions[i as usize].map(f64::from));
        let mut stretch: Vec<f64> = mesh
            .indices
            .chunks_exact(3)
            .flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
            .map(|(a, b)| {
                posed[a as usize].distance(posed[b as usize]) / rest(a).distance(rest(b)).max(1e-4)
            })
            .collect();
        stretch.sort_by(f64::total_cmp);
        let at = |share: f64| stretch[(stretch.len() as f64 * share) as usize];
        // The worst is the armpit, whose cloth is gathered in the rest pose.
        assert!(at(0.99) < 3.3, "{}", at(0.99));
        assert!(at(0.01) > 0.15, "{}", at(0.01));
    }
}

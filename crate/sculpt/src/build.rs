//! Assembly of a figure's parts.

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, Side};

use super::assemble::{Blueprint, PartWithNormals, assemble};
use super::bones;
use super::built::AnnotatedFigure;
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
use raconteur_body::figure::{Figure, Material, MaterialKind, TextureMaps};
use raconteur_body::skeleton::{Bone, FaceJoints, zero_frames};
use raconteur_tissue::Tissue;

/// Indices of the skin's textures among a figure's images.
const SKIN_MAPS: TextureMaps = TextureMaps {
    base_color: Some(0),
    normal: Some(1),
    wrinkles: Some(2),
};

/// Maximum distance from the centre of the head at which hair may touch clothes, metres.
const NEAR_HEAD_M: f64 = 0.45;

/// Builds a figure. The same parameters give a bit-identical figure.
#[must_use]
pub fn build(params: &FigureParams) -> AnnotatedFigure {
    let Mannequin {
        head,
        world_from_head,
        mut head_parts,
        mut joints,
        field,
        cage,
        neck: collar_line,
    } = Mannequin::from_params(params);
    let body = params.body();
    let wearer = Wearer::new(&body, &field, &cage, &joints, &collar_line);
    let clothes = dress(&wearer, &params.wardrobe);

    let near_head = clothes_near_head(&clothes.parts, world_from_head);
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

    let mut pieces: Vec<PartWithNormals> = Vec::new();
    let hand = params.hands();
    let hands = Side::BOTH.map(|side| place_hand(&hand, side, &mut joints));
    let maps = skin::bake(&params.skin, &head.sheet, &hands[0].1, grown.cap.as_ref());
    pieces.extend(head_parts.into_iter().map(PartWithNormals::from));
    pieces.extend(
        hands
            .into_iter()
            .flat_map(|(parts, _)| parts)
            .map(PartWithNormals::from),
    );
    pieces.push(neck(&field, &cage, &head, world_from_head).into());
    pieces.extend(clothes.parts.into_iter().map(PartWithNormals::from));
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
        face: FaceJoints {
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
    figure.springs = springs::build_springs(&figure, &grown.chains);
    figure.tissue = Some(face_tissue(&head, world_from_head, &figure));
    leave_to_tissue(&mut figure);
    let annotations = annotations(&head, &figure);
    levels::add(&mut figure, &annotations);
    levels::sort_triangles(&mut figure);
    AnnotatedFigure {
        figure,
        annotations,
    }
}

/// Returns the surface of clothes around the head, in its frame: hair rests on it.
pub(super) fn clothes_near_head(
    clothes: &[MeshPart],
    world_from_head: DAffine3,
) -> Vec<hair::Sample> {
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

/// Builds only the head with its face tissue, on the full skeleton: enough to test facial animation
/// in a fraction of the time. It has no hair, hands, clothes or maps.
#[must_use]
pub fn build_face(params: &FigureParams) -> AnnotatedFigure {
    let made = Mannequin::from_params(params);
    let place = made.world_from_head;
    let mut figure = assemble(&Blueprint {
        name: params.name.clone(),
        positions_in_world: made.joints.positions,
        bind_rotations: made.joints.rotations,
        face: FaceJoints {
            eye_centres: made.head.eye_centres.map(|p| place.transform_point3(p)),
        },
        stature_m: params.person.stature_m,
        lid_closure_rad: made.head.lid_closure_rad,
        pieces: made
            .head_parts
            .into_iter()
            .map(PartWithNormals::from)
            .collect(),
        chains: Vec::new(),
        images: Vec::new(),
    });
    figure.sex = Some(params.person.sex);
    figure.tissue = Some(face_tissue(&made.head, place, &figure));
    leave_to_tissue(&mut figure);
    let annotations = annotations(&made.head, &figure);
    AnnotatedFigure {
        figure,
        annotations,
    }
}

/// Returns the soft tissue of the face.
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

/// Returns the landmarks and segments of the head on the mesh that contains its skin; that mesh
/// begins with the head.
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

/// Builds a hand in world coordinates with the skin for its texture maps; its finger joints replace
/// those of the skeleton.
fn place_hand(params: &HandParams, side: Side, joints: &mut Joints) -> (Vec<MeshPart>, HandSheet) {
    let built = hand::build(params, side);
    let wrist = Bone::on(side, "wrist");
    let bind = joints.rotations[wrist.index()];
    let turn: DQuat = bind * zero_frames()[wrist.index()].inverse();
    let place = DAffine3::from_rotation_translation(turn, joints.position_of(wrist));
    for (bone, p) in built.joints {
        joints.positions[bone.index()] = place.transform_point3(p);
    }
    for (bone, q) in built.bind_in_wrist {
        joints.rotations[bone.index()] = bind * q;
    }
    let mut parts = built.parts;
    for part in &mut parts {
        for v in &mut part.vertices {
            // The end of the forearm narrows, so that it stays inside the cuff.
            let up = v.position.dot(built.forearm_direction);
            let axis = built.forearm_direction * up;
            v.position = axis + (v.position - axis) * (1.0 - 0.28 * smooth((up - 0.015) / 0.025));
            v.position = place.transform_point3(v.position);
        }
    }
    (parts, built.sheet)
}

/// Builds the body's own neck, just below the head's skin and inside the collar.
fn neck(field: &Field, cage: &Cage, head: &Head, place: DAffine3) -> MeshPart {
    let (mut shell, _) = cage.extract(|t| Cage::is_above(t, 0.826)).subdivided(1);
    let rim = head
        .neck_rim
        .iter()
        .map(|p| place.transform_point3(*p).y)
        .fold(f64::MIN, f64::max);
    let normals = shell.normals();
    for (p, n) in shell.points.iter_mut().zip(&normals) {
        // Two coincident sheets would flicker; above the rim, the head's skin leaves the body's,
        // and this one must stay below it.
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
        maps: TextureMaps::default(),
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

/// Removes the morph targets of meshes driven by the tissue, so that nothing moves twice.
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
mod tests;

//! Tests of the built hand, both sides.

use raconteur_base::{DAffine3, mirror_vector};

use super::*;
use crate::subdivide::{edge_faces, welded};
use crate::{assemble, people};
use raconteur_base::self_intersection::crossings;
use raconteur_base::surface::vertex_normals;
use raconteur_body::hand_shape::{HandShape, finger_bones};
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::{Drive, FaceJoints, Skeleton};

fn sofia(side: Side) -> Hand {
    build(&mean_hand(1.0, 35.0, 1.66, [0.5, 0.285, 0.205]), side)
}

#[test]
fn the_skin_is_a_manifold_open_at_the_wrist_only() {
    let hand = sofia(Side::Left);
    let positions: Vec<DVec3> = hand.skin().vertices.iter().map(|v| v.position).collect();
    let edges = edge_faces(&welded(&positions, &hand.skin().faces));
    let open = edges.values().filter(|f| f.len() == 1).count();
    assert_eq!(open, hand.wrist_rim.len());
    assert!(
        edges.values().all(|f| f.len() <= 2),
        "no edge has more than two faces"
    );
    let rim = |i: usize| hand.skin().vertices[hand.wrist_rim[i] as usize].position;
    for i in 0..hand.wrist_rim.len() {
        assert!(
            (rim(i).x - rim(0).x).abs() < 1e-9,
            "the wrist rim is planar"
        );
        assert!(
            (rim(i) - rim((i + 1) % hand.wrist_rim.len())).length() < 0.01,
            "neighbouring points of the rim are close"
        );
    }
    assert!(
        edge_faces(&hand.parts[1].faces)
            .values()
            .all(|f| f.len() == 2),
        "the nails are closed"
    );
}

#[test]
fn faces_look_outwards() {
    for side in Side::BOTH {
        for part in sofia(side).parts {
            let volume: f64 = part
                .faces
                .iter()
                .flat_map(|f| (1..f.len() - 1).map(|i| [f[0], f[i], f[i + 1]]))
                .map(|t| {
                    let [a, b, c] = t.map(|i| part.vertices[i as usize].position);
                    a.dot(b.cross(c)) / 6.0
                })
                .sum();
            assert!(volume > 1e-7, "{} {volume}", part.name);
        }
    }
}

/// The hands of the figures, left.
fn shipped() -> impl Iterator<Item = (&'static str, Hand)> {
    people::NAMES.into_iter().filter_map(|name| {
        let params = people::preset(name)?.hands();
        Some((name, build(&params, Side::Left)))
    })
}

#[test]
fn no_skin_crosses_itself_or_folds_over() {
    for (name, hand) in shipped() {
        let skin = hand.skin();
        let points: Vec<DVec3> = skin.vertices.iter().map(|v| v.position).collect();
        let faces = welded(&points, &skin.faces);
        let triangles: Vec<[u32; 3]> = faces
            .iter()
            .flat_map(|f| assemble::triangles(f, &points))
            .collect();
        let found = crossings(&points, &triangles);
        let first = found
            .first()
            .map(|&[a, _]| points[triangles[a][0] as usize]);
        assert!(found.is_empty(), "{name}: {} at {first:?}", found.len());
        let normals = vertex_normals(&points, &faces);
        for t in triangles {
            let [a, b, c] = t.map(|v| points[v as usize]);
            let across = (b - a).cross(c - a);
            let mean: DVec3 = t.iter().map(|&v| normals[v as usize]).sum();
            // Half a hundredth of a square millimetre.
            assert!(across.length() > 1e-8, "{name}: {} at {a}", across.length());
            assert!(across.dot(mean) > 0.0, "{name}: {a}");
        }
    }
}

#[test]
fn left_and_right_mirror_each_other() {
    let (l, r) = (sofia(Side::Left), sofia(Side::Right));
    for (l, r) in l.parts.iter().zip(&r.parts) {
        for (l, r) in l.vertices.iter().zip(&r.vertices) {
            assert!(
                (mirror_vector(l.position) - r.position).length() < 1e-12,
                "the vertices mirror each other"
            );
            assert_eq!(l.color, r.color);
            assert_eq!(l.weights.len(), r.weights.len());
        }
    }
    for (l, r) in l.joints.iter().zip(&r.joints) {
        assert_eq!(l.0.mirrored(), r.0);
        assert!(
            (mirror_vector(l.1) - r.1).length() < 1e-12,
            "the landmarks mirror each other"
        );
    }
}

#[test]
fn weights_sum_to_one_over_at_most_four_joints_of_the_skeleton() {
    let known: Vec<Drive> = raconteur_body::skeleton::standard_helpers()
        .into_iter()
        .map(|h| h.1)
        .collect();
    for part in sofia(Side::Right).parts {
        for v in &part.vertices {
            assert!(
                !v.weights.is_empty() && v.weights.len() <= 4,
                "each vertex has one to four weights"
            );
            assert!(
                (v.weights.iter().map(|w| w.1).sum::<f64>() - 1.0).abs() < 1e-9,
                "the weights of a vertex add up to 1"
            );
            for (joint, _) in &v.weights {
                assert!(
                    matches!(joint.0, Drive::Bone(_)) || known.contains(&joint.0),
                    "{joint:?}"
                );
            }
        }
    }
}

#[test]
fn length_breadth_and_detail_are_as_asked() {
    let params = mean_hand(0.0, 35.0, 1.756, [0.45, 0.25, 0.18]);
    let hand = build(&params, Side::Left);
    let skin = hand.skin();
    let tip = skin
        .vertices
        .iter()
        .map(|v| v.position.x)
        .fold(0.0, f64::max);
    // The wrist's crease is 8 of 189 parts of the hand behind the joint.
    assert!(
        (tip * (1.0 + 8.0 / 181.0) / params.length_m - 1.0).abs() < 0.02,
        "{tip}"
    );
    let thumb: Vec<Drive> = hand.joints[12..].iter().map(|j| Drive::Bone(j.0)).collect();
    let knuckles = skin.vertices.iter().filter(|v| {
        let way = v.position.x / params.length_m;
        way > 72.0 / 189.0 && way < 0.50 && v.weights.iter().all(|w| !thumb.contains(&w.0.0))
    });
    let z: Vec<f64> = knuckles.map(|v| v.position.z).collect();
    let breadth =
        z.iter().copied().fold(f64::MIN, f64::max) - z.iter().copied().fold(f64::MAX, f64::min);
    assert!((breadth / params.breadth_m - 1.0).abs() < 0.02, "{breadth}");
    assert!(
        skin.vertices.len() >= 1500,
        "the skin has at least 1500 vertices"
    );
    let triangles: usize = hand
        .parts
        .iter()
        .flat_map(|p| &p.faces)
        .map(|f| f.len() - 2)
        .sum();
    assert!(triangles <= 12_000, "{triangles}");
}

#[test]
fn building_twice_gives_the_same_bits() {
    let (a, b) = (sofia(Side::Left), sofia(Side::Left));
    for (a, b) in a.parts.iter().zip(&b.parts) {
        for (a, b) in a.vertices.iter().zip(&b.vertices) {
            assert_eq!(
                a.position.to_array().map(f64::to_bits),
                b.position.to_array().map(f64::to_bits)
            );
        }
    }
}

/// A skeleton whose left hand is this one, the rest the example's; in the bind pose the
/// arm is that of the zero pose.
pub(super) fn skeleton_with(hand: &Hand, side: Side) -> Skeleton {
    let mut positions = Bone::ALL.map(Bone::example_position_m);
    let mut rotations = zero_frames();
    let wrist = if side == Side::Left {
        Bone::LWrist
    } else {
        Bone::RWrist
    };
    for ((bone, p), (_, q)) in hand.joints.iter().zip(&hand.bind_in_wrist) {
        positions[bone.index()] = positions[wrist.index()] + *p;
        rotations[bone.index()] = zero_frames()[wrist.index()] * *q;
    }
    let eyes = [DVec3::new(0.03, 1.7, 0.08), DVec3::new(-0.03, 1.7, 0.08)];
    Skeleton::from_bind(
        &positions,
        &rotations,
        FaceJoints { eye_centres: eyes },
        1.956,
    )
}

pub(super) fn solved(skeleton: &Skeleton, side: Side, angles: &HandAngles) -> Vec<DAffine3> {
    let mut pose = Pose::zero();
    for (bone, q) in angles.rotations(side) {
        pose.set(bone, q);
    }
    let mut world = Vec::new();
    skeleton.solve(&pose, &mut world);
    world
}

#[test]
fn the_bind_angles_pose_the_skeleton_as_the_hand_was_built() {
    for side in Side::BOTH {
        let hand = sofia(side);
        let skeleton = skeleton_with(&hand, side);
        let world = solved(&skeleton, side, &BIND_ANGLES);
        let wrist = if side == Side::Left {
            Bone::LWrist
        } else {
            Bone::RWrist
        };
        for ((bone, p), (_, q)) in hand.joints.iter().zip(&hand.bind_in_wrist) {
            let at = world[bone.index()];
            let asked = wrist.example_position_m() + *p;
            assert!((at.translation - asked).length() < 1e-9, "{}", bone.name());
            let along = at.transform_vector3(DVec3::X);
            let asked = zero_frames()[wrist.index()] * (*q * DVec3::X);
            assert!((along - asked).length() < 1e-9, "{}", bone.name());
        }
    }
}

#[test]
fn a_fist_closes_and_a_pinch_meets() {
    for side in Side::BOTH {
        let hand = sofia(side);
        let skeleton = skeleton_with(&hand, side);
        let last = finger_bones(side);
        let tip = |world: &[DAffine3], f: usize, soft_m: f64| {
            world[last[3 * f + 2].index()].transform_point3(DVec3::X * soft_m)
        };
        let fist = solved(&skeleton, side, HandShape::ALL[14].angles());
        let wrist = if side == Side::Left {
            Bone::LWrist
        } else {
            Bone::RWrist
        };
        for f in 0..4 {
            assert!(
                (tip(&fist, f, 0.019) - fist[wrist.index()].translation).length() < 0.085,
                "the fingertips of the fist are near the wrist"
            );
        }
        let pinch = solved(&skeleton, side, HandShape::ALL[24].angles());
        assert!(
            (tip(&pinch, 0, 0.019) - tip(&pinch, 4, 0.026)).length() < 0.03,
            "the tips of the pinch meet"
        );
    }
}

#[test]
fn the_bones_lie_inside_the_hand() {
    for (sex, age, stature) in [(1.0, 35.0, 1.66), (0.0, 70.0, 1.72), (0.0, 9.0, 1.34)] {
        let params = mean_hand(sex, age, stature, [0.5, 0.3, 0.2]);
        let anatomy = Anatomy::new(HandBuild::from_sex_and_age(sex, age));
        let field = Field::new(&anatomy);
        let cage = cage::build(&anatomy, &field);
        let place = Placement::new(
            &params,
            Side::Right,
            &surface::build(&anatomy, &field, &cage),
        );
        let bones = skeleton::bones(&params, Side::Right);
        assert_eq!(bones.len(), 27);
        let hand = build(&params, Side::Right);
        let skin = &hand.skin().vertices;
        for bone in bones {
            for p in &bone.solid.points {
                let (length, breadth) = (place.length_scale, place.breadth_scale);
                let mm = DVec3::new(p.z / breadth, -p.x / length, -p.y / breadth);
                // The field's distance is not to be relied on deep inside.
                assert!(field.distance(mm) < 0.0, "{} {mm}", bone.name);
                let near = skin.iter().map(|v| v.position.distance_squared(*p));
                let nearest = near.fold(f64::INFINITY, f64::min).sqrt();
                assert!(nearest > 0.0012, "{} {mm} {nearest}", bone.name);
            }
        }
    }
}

#[test]
fn ten_nails_cost_little() {
    let triangles: usize = Side::BOTH
        .iter()
        .flat_map(|&side| sofia(side).parts[1].faces.clone())
        .map(|f| f.len() - 2)
        .sum();
    assert!(triangles <= 1_200, "{triangles}");
}

/// Returns the perimeter of the skin at a height along the hand (unscaled frame converted to
/// millimetres of the built hand), over the faces whose vertices `keep` accepts.
fn girth_mm(hand: &Hand, at_mm: f64, keep: impl Fn(usize) -> bool) -> f64 {
    let skin = hand.skin();
    let position = |v: u32| skin.vertices[v as usize].position * 1000.0;
    let mut sum = 0.0;
    for face in &skin.faces {
        if !face.iter().all(|&v| keep(v as usize)) {
            continue;
        }
        let mut cuts = Vec::new();
        for k in 0..face.len() {
            let (a, b) = (position(face[k]), position(face[(k + 1) % face.len()]));
            if (a.x < at_mm) != (b.x < at_mm) {
                cuts.push(a.lerp(b, (at_mm - a.x) / (b.x - a.x)));
            }
        }
        if let [a, b] = cuts[..] {
            sum += a.distance(b);
        }
    }
    sum
}

fn within(what: &str, value: f64, (mean, sd): (f64, f64)) {
    assert!(
        (value - mean).abs() <= sd,
        "{what}: {value:.1} against {mean} ± {sd}"
    );
}

/// Returns the placement of a left hand with these measures.
fn placed(params: &HandParams, anatomy: &Anatomy) -> Placement {
    let field = Field::new(anatomy);
    let cage = cage::build(anatomy, &field);
    let surface = surface::build(anatomy, &field, &cage);
    Placement::new(params, Side::Left, &surface)
}

/// Lengths of a finger's metacarpal and phalanges, metres.
fn segments_m(anatomy: &Anatomy, place: &Placement, f: usize) -> [f64; 4] {
    let finger = &anatomy.fingers[f];
    let at = |along: f64| place.position(finger.point(DVec3::new(0.0, along, 0.0)));
    let [a, b, c, d] = finger.joints().map(at);
    let base = place.position(anatomy.metacarpal_base[f - 1]);
    [
        base.distance(a),
        a.distance(b),
        b.distance(c),
        c.distance(d),
    ]
}

#[test]
fn hands_of_both_sexes_measure_as_surveys_say() {
    // Mean and SD, mm: ANSUR II 2012, all adults (men n = 4082, women n = 1986).
    let ansur = [
        (
            0.0,
            1.756,
            [
                (193.28, 9.95),
                (88.26, 4.39),
                (116.46, 6.23),
                (175.92, 8.96),
                (212.28, 10.24),
            ],
        ),
        (
            1.0,
            1.63,
            [
                (181.08, 10.06),
                (78.15, 3.84),
                (108.70, 5.94),
                (154.79, 7.83),
                (186.55, 8.82),
            ],
        ),
    ];
    // Buryanov and Kotiuk 2010, table I, both sexes: metacarpal and phalanges, index to
    // little finger; mean and SD (recalled in the source's copy), mm.
    let bones = [
        [(68.12, 6.27), (39.78, 4.94), (22.38, 2.51)],
        [(64.6, 5.38), (44.63, 3.81), (26.33, 3.0)],
        [(58.0, 5.06), (41.37, 3.87), (25.65, 3.29)],
        [(53.69, 4.36), (32.74, 2.77), (18.11, 2.54)],
    ];
    let tips = [19.66, 21.35, 21.25, 19.69];
    let mut segments = [[0.0; 4]; 4];
    for (sex, stature, survey) in ansur {
        let params = mean_hand(sex, 35.0, stature, [0.5; 3]);
        let hand = build(&params, Side::Left);
        let anatomy = Anatomy::new(HandBuild::from_sex_and_age(sex, 35.0));
        let place = placed(&params, &anatomy);
        let vertices = &hand.skin().vertices;
        let tip = vertices.iter().map(|v| v.position.x).fold(0.0, f64::max) * 1000.0;
        let scale = place.length_scale * 1000.0;
        within("length", tip + CREASE_MM * scale, survey[0]);
        within("breadth", params.breadth_m * 1000.0, survey[1]);
        // Palm length ends at the crease of the middle finger's root.
        let middle = &anatomy.fingers[2];
        let crease = middle.point(DVec3::new(0.0, middle.along(0.405), 0.0)).y;
        within("palm", (crease + CREASE_MM) * scale, survey[2]);
        let wrist = girth_mm(&hand, -14.0 * scale, |_| true);
        within("wrist", wrist, survey[3]);
        let thumb: Vec<Drive> = hand.joints[12..].iter().map(|j| Drive::Bone(j.0)).collect();
        let no_thumb = |v: usize| {
            vertices[v]
                .weights
                .iter()
                .all(|w| !thumb.contains(&w.0.0) || w.1 < 0.4)
        };
        let around = girth_mm(&hand, 78.0 * scale, no_thumb);
        within("circumference", around, survey[4]);
        for f in 1..5 {
            let own = segments_m(&anatomy, &place, f);
            for (sum, length) in segments[f - 1].iter_mut().zip(own) {
                *sum += length * 500.0;
            }
        }
    }
    for f in 0..4 {
        for k in 0..3 {
            within(
                &format!("finger {f} segment {k}"),
                segments[f][k],
                bones[f][k],
            );
        }
        // The last phalanx with its soft tip; SD of the bone.
        within(&format!("finger {f} tip"), segments[f][3], (tips[f], 2.2));
    }
}

#[test]
fn sex_and_age_show() {
    let width = |sex: f64, age: f64, q: f64| {
        let anatomy = Anatomy::new(HandBuild::from_sex_and_age(sex, age));
        let finger = &anatomy.fingers[2];
        finger.section(finger.along(q)).half_width
    };
    assert!(
        width(0.0, 35.0, 1.4) > width(1.0, 35.0, 1.4) * 1.03,
        "the male finger is wider"
    );
    assert!(
        width(0.0, 75.0, 1.0) > width(0.0, 35.0, 1.0) * 1.04,
        "the old finger is wider"
    );
    // A child's finger tapers; its joints do not protrude.
    let knot = |age: f64| width(0.5, age, 1.0) / width(0.5, age, 1.4);
    assert!(
        knot(9.0) < knot(35.0) && knot(35.0) < knot(75.0),
        "the knuckles grow with age"
    );
}

use raconteur_base::{DAffine3, DQuat, DVec3, noise, ops};

use super::*;
use crate::pose::Pose;
use crate::skeleton::{Bone, Drive};

/// Returns a skeleton with a chain of three links attached to the skull next to the neck, and its
/// colliders.
fn hung(gravity: f64) -> (Skeleton, Springs) {
    let mut skeleton = Skeleton::example();
    let mut world = Vec::new();
    skeleton.solve(&Pose::zero(), &mut world);
    let skull = Bone::Skull.index();
    let turn = world[skull].matrix3;
    let mut parent = (skull, world[skull].translation);
    let mut links = Vec::new();
    for l in 0..4u8 {
        let at = world[skull].translation + DVec3::new(0.09, 0.05 - 0.05 * f64::from(l), 0.0);
        let local = DAffine3::from_translation(turn.transpose() * (at - parent.1));
        let joint = skeleton.hang(format!("hair_0_{l}"), parent.0, local, Drive::Spring(0, l));
        parent = (joint, at);
        links.push(SpringLink {
            joint,
            stiffness: 0.35,
            gravity: DVec3::NEG_Y * gravity,
            drag: 0.45,
            radius_m: 0.004,
        });
    }
    let collider = |bone: Bone, ends: [DVec3; 2], radius_m| Collider {
        joint: bone.index(),
        ends,
        radius_m,
    };
    let springs = Springs {
        chains: vec![Chain {
            links,
            colliders: vec![0, 1],
        }],
        colliders: vec![
            collider(Bone::Skull, [DVec3::ZERO; 2], 0.07),
            collider(Bone::Cervical, [DVec3::ZERO, DVec3::X * 0.08], 0.05),
        ],
    };
    (skeleton, springs)
}

/// The posture of a head that turns and nods as it likes.
fn posture(skeleton: &Skeleton, step: i64, still_from: i64) -> Vec<DAffine3> {
    let mut pose = Pose::zero();
    let t = step.min(still_from);
    let angle = |k: u64| 1.2 * (noise::unit(7, k, t / 15) - 0.5);
    let turn = DQuat::from_rotation_x(angle(0)) * DQuat::from_rotation_y(angle(1));
    pose.set(Bone::Skull, turn);
    let mut world = Vec::new();
    skeleton.solve(&pose, &mut world);
    world
}

fn ends(springs: &Springs, world: &[DAffine3]) -> Vec<DVec3> {
    let links = springs.chains.iter().flat_map(|c| &c.links);
    links.map(|l| world[l.joint].translation).collect()
}

#[test]
fn what_hangs_straight_stays_at_rest() {
    let (skeleton, springs) = hung(0.2);
    let mut world = Vec::new();
    skeleton.solve(&Pose::zero(), &mut world);
    let rest = ends(&springs, &world);
    let mut swing = springs.swing();
    springs.rest(&world, &mut swing);
    for _ in 0..120 {
        springs.step(&skeleton, &mut world, &mut swing);
    }
    for (a, b) in rest.iter().zip(ends(&springs, &world)) {
        assert!(a.distance(b) < 1e-9, "{a} {b}");
    }
}

#[test]
fn links_keep_their_length_and_clear_of_colliders_and_come_to_rest() {
    let (skeleton, springs) = hung(0.12);
    let mut swing = springs.swing();
    springs.rest(&posture(&skeleton, 0, 600), &mut swing);
    let mut most_swing = 0.0f64;
    let mut last = Vec::new();
    for step in 1..=720 {
        let mut world = posture(&skeleton, step, 600);
        let rest = ends(&springs, &world);
        springs.step(&skeleton, &mut world, &mut swing);
        let at = ends(&springs, &world);
        for (pair, link) in at.windows(2).zip(&springs.chains[0].links) {
            assert!(
                (pair[0].distance(pair[1]) - 0.05).abs() < 1e-9,
                "the link keeps its length"
            );
            for c in &springs.colliders {
                let [a, b] = c.ends.map(|e| world[c.joint].transform_point3(e));
                let t = (pair[1] - a).dot(b - a) / (b - a).length_squared().max(1e-12);
                let off = pair[1].distance(a.lerp(b, t.clamp(0.0, 1.0)));
                // The length constraint may push back a link that a collider has pushed out.
                assert!(off > c.radius_m - 0.003, "{step} {off} {}", link.radius_m);
            }
        }
        most_swing = most_swing.max(rest[3].distance(at[3]));
        if step >= 719 {
            last.push(at[3]);
        }
    }
    assert!(most_swing > 0.02, "{most_swing}");
    assert!(last[0].distance(last[1]) < 1e-6, "the chain comes to rest");
}

#[test]
fn links_turn_no_farther_than_they_may() {
    // Colliders much larger than the free space push as far as possible.
    let (skeleton, mut springs) = hung(2.0);
    springs.colliders[0].radius_m = 0.12;
    let mut swing = springs.swing();
    springs.rest(&posture(&skeleton, 0, 600), &mut swing);
    let mut most = 1.0f64;
    for step in 1..=300 {
        let mut world = posture(&skeleton, step, 600);
        let still = ends(&springs, &world);
        springs.step(&skeleton, &mut world, &mut swing);
        let at = ends(&springs, &world);
        for (a, b) in still.windows(2).zip(at.windows(2)) {
            let turned = (a[1] - a[0]).angle_between(b[1] - b[0]);
            most = most.min(ops::cos(turned));
        }
    }
    assert!(most > MAX_PUSH_COS - 1e-9, "{most}");
    assert!(most < MAX_SWING_COS, "{most}");
}

#[test]
fn between_steps_ends_go_straight_and_one_swing_takes_over_from_another() {
    let (skeleton, springs) = hung(0.12);
    let mut swing = springs.swing();
    springs.rest(&posture(&skeleton, 0, 600), &mut swing);
    for step in 1..=40 {
        springs.step(&skeleton, &mut posture(&skeleton, step, 600), &mut swing);
    }
    let mut other = springs.swing();
    springs.rest(&posture(&skeleton, 40, 600), &mut other);
    let world = posture(&skeleton, 40, 600);
    let shown = |swing: &mut SpringState, share: f64, other: Option<(&SpringState, f64, f64)>| {
        let mut world = world.clone();
        springs.show(&skeleton, &mut world, swing, share, other);
        ends(&springs, &world)[3]
    };
    let now = shown(&mut swing, 1.0, None);
    let half = shown(&mut swing, 0.5, None);
    let before = shown(&mut swing, 0.0, None);
    assert!(now.distance(before) > 1e-4, "the chain end moves");
    assert!(
        half.distance(now.lerp(before, 0.5)) < 0.1 * now.distance(before),
        "the chain end is near the midpoint between steps"
    );
    let taken = shown(&mut swing, 1.0, Some((&other, 1.0, 1.0)));
    let own = shown(&mut other, 1.0, None);
    assert!(
        taken.distance(own) < 1e-12,
        "the chain takes over the state of the other swing"
    );
}

#[test]
fn a_leap_of_the_figure_leaves_the_chain_at_rest() {
    let (skeleton, springs) = hung(0.0);
    let mut swing = springs.swing();
    springs.rest(&posture(&skeleton, 0, 0), &mut swing);
    let mut pose = Pose::zero();
    pose.root_offset_in_world = DVec3::X;
    for _ in 0..3 {
        let mut world = Vec::new();
        skeleton.solve(&pose, &mut world);
        let rest = ends(&springs, &world);
        springs.step(&skeleton, &mut world, &mut swing);
        assert!(
            rest[3].distance(ends(&springs, &world)[3]) < 1e-6,
            "the chain is at rest after the leap"
        );
    }
}

#[test]
fn other_numbers_lose_chains_and_colliders_whose_joints_are_lost() {
    let (_, springs) = hung(0.12);
    let shifted = springs.renumbered(&|j| (j != Bone::Skull.index()).then_some(j + 1));
    assert_eq!(shifted.colliders.len(), 1);
    assert_eq!(shifted.chains[0].colliders, [0]);
    assert_eq!(
        shifted.chains[0].links[0].joint,
        springs.chains[0].links[0].joint + 1
    );
    let lost = springs.renumbered(&|j| (j != springs.chains[0].links[2].joint).then_some(j));
    assert!(
        lost.chains.is_empty(),
        "a chain with a lost joint is removed"
    );
}

//! Inverse kinematics of an arm on the same random targets: the closed form of this project, and
//! two iterative solvers on the maintained library `k`. Budget of a solve: 2 µs.
//!
//! `k` has seven joints of the same arm and starts each target from a bent arm. Its own solver uses
//! the pseudo-inverse; damped least squares is built on its Jacobian.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use k::nalgebra as na;
use k::prelude::*;
use raconteur_actor::limb::chain::{LimbBase, LimbRig};
use raconteur_actor::limb::obstacles::Obstacles;
use raconteur_actor::limb::solve::{AT_EASE, SolutionCriteria};
use raconteur_actor::limb::swivel::SwivelCriteria;
use raconteur_actor::limb::{BodySpace, RigidFrame, Sex};
use raconteur_base::{DAffine3, DQuat, DVec3, Side, noise};
use raconteur_body::{Bone, Pose, Skeleton};

const TARGETS: i64 = 1024;
/// Distance at which a target counts as reached.
const METRES: f64 = 1e-4;
const RADIANS: f64 = 1e-3;

fn targets(base: &LimbBase, reach_m: f64) -> Vec<RigidFrame> {
    let target = |i| {
        let r = |k| noise::signed(41, k, i);
        let direction = DVec3::new(r(0), r(1), r(2))
            .try_normalize()
            .unwrap_or(DVec3::Z);
        RigidFrame {
            position: base.origin + direction * reach_m * (0.4 + 0.55 * noise::unit(41, 3, i)),
            rotation: DQuat::from_xyzw(r(4), r(5), r(6), r(7)).normalize(),
        }
    };
    (0..TARGETS).map(target).collect()
}

/// The same arm for `k`: shoulder of three joints, elbow, wrist of three; hanging at zero.
fn chain(upper_m: f64, fore_m: f64) -> k::SerialChain<f64> {
    let node = |name: &str, axis: na::Vector3<f64>, down_m: f64| {
        k::NodeBuilder::new()
            .name(name)
            .joint_type(k::JointType::Rotational {
                axis: na::Unit::new_normalize(axis),
            })
            .translation(na::Translation3::new(0.0, -down_m, 0.0))
            .finalize()
            .into()
    };
    let (x, y, z) = (na::Vector3::x(), na::Vector3::y(), na::Vector3::z());
    let nodes: Vec<k::Node<f64>> = vec![
        node("abduction", z, 0.0),
        node("flexion", -x, 0.0),
        node("roll", -y, 0.0),
        node("elbow", -x, upper_m),
        node("pronation", -y, fore_m),
        node("deviation", -x, 0.0),
        node("bend", z, 0.0),
    ];
    for pair in nodes.windows(2) {
        pair[1].set_parent(&pair[0]);
    }
    k::SerialChain::from_end(&nodes[6])
}

/// Solves by damped least squares on the library's Jacobian; returns true if the target was
/// reached.
fn damped(chain: &k::SerialChain<f64>, target: &na::Isometry3<f64>) -> bool {
    for _ in 0..60 {
        let end = chain.end_transform();
        let linear = target.translation.vector - end.translation.vector;
        let angular = end.rotation.rotation_to(&target.rotation).scaled_axis();
        if linear.norm() < METRES && angular.norm() < RADIANS {
            return true;
        }
        let error = na::Vector6::new(
            linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
        );
        let jacobian = k::jacobian(chain);
        let square = &jacobian * jacobian.transpose() + na::DMatrix::identity(6, 6) * 1e-4;
        let Some(factors) = square.cholesky() else {
            return false;
        };
        let step = jacobian.transpose() * factors.solve(&error);
        let now = chain.joint_positions();
        let next: Vec<f64> = now.iter().zip(step.iter()).map(|(a, b)| a + b).collect();
        chain.set_joint_positions_unchecked(&next);
        chain.update_transforms();
    }
    false
}

const BENT: [f64; 7] = [0.3, 0.6, 0.2, 1.2, 0.2, 0.1, 0.1];

fn solvers(c: &mut Criterion) {
    let skeleton = Skeleton::example();
    let zero = Pose::zero();
    let rig = LimbRig::new(&skeleton, Side::Left, true, Sex::Male);
    let base = rig.base(&rig.trunk(&skeleton, &zero), None);
    let [_, reach_m] = rig.distances_m(false);
    let targets = targets(&base, reach_m);
    let mut next = {
        let mut n = 0;
        move || {
            n = (n + 1) % targets.len();
            targets[n]
        }
    };
    closed_form(c, &skeleton, &rig, &base, &mut next);
    numerical(c, &skeleton, &base, &mut next);
}

/// The engine's own solver, from the bare formulas to a chosen pose.
fn closed_form(
    c: &mut Criterion,
    skeleton: &Skeleton,
    rig: &LimbRig,
    base: &LimbBase,
    next: &mut impl FnMut() -> RigidFrame,
) {
    let elbow = |target: &RigidFrame| {
        let to = (target.position - base.origin).normalize();
        (DVec3::NEG_Y - to * to.dot(DVec3::NEG_Y)).normalize_or(DVec3::NEG_Z)
    };
    c.bench_function("closed form: eight solutions, elbow given", |b| {
        b.iter(|| {
            let target = next();
            black_box(rig.solutions(&target, elbow(&target), base, false))
        });
    });
    c.bench_function("closed form: eight solutions of table 3.1", |b| {
        b.iter(|| black_box(rig.table_solutions(&next(), base)));
    });
    let space = BodySpace::new(skeleton, None);
    let obstacles = Obstacles {
        body: &space,
        body_from_figure: DAffine3::IDENTITY,
        head: space.head(),
        other_forearm: Some([Bone::RElbow, Bone::RWrist].map(Bone::example_position_m)),
    };
    let comfort = SwivelCriteria {
        obstacles: Some(&obstacles),
        ..SwivelCriteria::default()
    };
    c.bench_function("closed form: swivel, solutions, limits, bones", |b| {
        b.iter(|| {
            let target = next();
            let swivel = rig.swivel_for(&target, base, &comfort);
            let elbow = rig.elbow_at(&target, base, swivel);
            let found = rig.solutions(&target, elbow, base, true);
            let choice = SolutionCriteria {
                limited: 1.0,
                current: None,
                preferred: &AT_EASE,
            };
            let chosen = rig.choose(&found, &target, base, &choice);
            black_box(chosen.map(|joints| rig.posed(&joints, base)))
        });
    });
}

/// Benchmarks two solvers of a maintained library, which approach the target iteratively.
fn numerical(
    c: &mut Criterion,
    skeleton: &Skeleton,
    base: &LimbBase,
    next: &mut impl FnMut() -> RigidFrame,
) {
    let upper_m = skeleton.offset_length_m(Bone::LElbow);
    let fore_m = skeleton.offset_length_m(Bone::LWrist);
    let chain = chain(upper_m, fore_m);
    let theirs = |target: &RigidFrame| {
        let p = target.position - base.origin;
        let q = target.rotation;
        na::Isometry3::from_parts(
            na::Translation3::new(p.x, p.y, p.z),
            na::UnitQuaternion::from_quaternion(na::Quaternion::new(q.w, q.x, q.y, q.z)),
        )
    };
    let start = || {
        chain.set_joint_positions_unchecked(&BENT);
        chain.update_transforms();
    };
    let (mut asked, mut met) = (0_u32, 0_u32);
    c.bench_function("k's Jacobian with damped least squares", |b| {
        b.iter(|| {
            start();
            asked += 1;
            met += u32::from(damped(&chain, &theirs(&next())));
        });
    });
    println!("damped least squares met {met} of {asked} targets");
    let (mut asked, mut met) = (0_u32, 0_u32);
    let solver = k::JacobianIkSolver::new(METRES, RADIANS, 0.5, 60);
    c.bench_function("k's own solver", |b| {
        b.iter(|| {
            start();
            asked += 1;
            met += u32::from(solver.solve(&chain, &theirs(&next())).is_ok());
        });
    });
    println!("k's own solver met {met} of {asked} targets");
}

criterion_group!(benches, solvers);
criterion_main!(benches);

//! Spheres inside skin and clothes that keep chains out in any arm pose.

use raconteur_base::{DAffine3, DQuat, DVec3, Side};
use raconteur_body::figure::Figure;
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::Bone;
use raconteur_body::surface::lies_under;

use crate::posed;

/// Distance from a chain within which the surface must not collide with hair, metres.
const NEAR_M: f64 = 0.09;
/// Surface within this distance of a chain bounds the spheres, metres.
const BOUND_M: f64 = 0.25;
/// Cell size for sampling the surface, one point per cell, metres.
const CELL_M: f64 = 0.008;
/// Maximum number of spheres of a figure; the next constants are their minimum radius, and the
/// depth under the surface to which a position counts as covered, metres.
const MAX_SPHERES: usize = 96;
const MIN_RADIUS_M: f64 = 0.012;
const SLACK_M: f64 = 0.003;
/// Maximum protrusion of a sphere from the surface, in any pose, metres.
const OUT_M: f64 = 0.008;
/// Distance of spheres from chains at rest: the hair between them and the skin, metres.
const CLEAR_M: f64 = 0.012;
/// Points of the surface that a further sphere must gain.
const MIN_GAIN: usize = 3;
/// Number of sampled poses: the bind pose, and arms hanging, level and raised.
const POSES: usize = 4;
/// Directions of the left arm in all poses but the first.
const ARMS: [DVec3; POSES - 1] = [
    DVec3::new(0.25, -0.95, 0.1),
    DVec3::new(0.95, 0.05, 0.3),
    DVec3::new(0.25, 0.95, 0.15),
];
/// Share of an elevation above horizontal contributed by the shoulder blade (Inman, Saunders and
/// Abbott 1944, Journal of Bone and Joint Surgery 26, 1–30).
const BLADE_SHARE: f64 = 0.33;
/// Rotation of the head to either side, radians.
const HEAD_TURN: f64 = 0.9;

/// Surface point that chains may touch.
#[derive(Clone, Copy)]
struct Point {
    /// Position in each sampled pose, world.
    at: [DVec3; POSES],
    normal: [DVec3; POSES],
    /// The joints that carry most of it, the first more than the second.
    joints: [usize; 2],
}

/// Collision sphere that moves with a joint; hair must stay outside it.
#[derive(Clone, Copy)]
pub(super) struct Ball {
    /// Centre in each sampled pose, world.
    middle: [DVec3; POSES],
    pub(super) radius: f64,
    pub(super) joint: usize,
}

impl Ball {
    /// Returns the centre in the bind pose, world.
    pub(super) fn bound(&self) -> DVec3 {
        self.middle[0]
    }

    fn contains(&self, p: &Point, pose: usize) -> bool {
        self.middle[pose].distance(p.at[pose]) < self.radius + SLACK_M
    }
}

/// Returns a few spheres that together cover as much of the surface as possible, the best first.
pub(super) fn inside(figure: &Figure, chains: &[DVec3]) -> Vec<Ball> {
    let moved = poses(figure);
    let surface = touchable(surface(figure, chains, &moved));
    let skull = figure.inverse_bind[Bone::Skull.index()]
        .inverse()
        .translation;
    let turned = [-HEAD_TURN, 0.0, HEAD_TURN].map(DQuat::from_rotation_y);
    let reached: Vec<DVec3> = chains
        .iter()
        .flat_map(|c| turned.map(|t| skull + t * (*c - skull)))
        .collect();
    let reached = &reached;
    let near = |pose: usize| {
        let is_near = move |p: &&Point| nearest(reached, p.at[pose]) < NEAR_M;
        surface.iter().filter(is_near).map(move |p| (pose, *p))
    };
    let near: Vec<(usize, Point)> = (0..POSES).flat_map(near).collect();
    let balls: Vec<Ball> = near
        .iter()
        .flat_map(|(pose, p)| p.joints.map(|j| ball(&surface, p, j, *pose, &moved)))
        .map(|b| Ball {
            radius: b.radius.min(nearest(chains, b.bound()) - CLEAR_M),
            ..b
        })
        .filter(|b| b.radius > MIN_RADIUS_M)
        .collect();
    chosen(&balls, &near)
}

/// Returns the transforms from the bind pose to each sampled pose, world, for each joint.
fn poses(figure: &Figure) -> [Vec<DAffine3>; POSES] {
    let bind = posed::bind_pose(figure);
    core::array::from_fn(|i| {
        let mut pose = bind.clone();
        if let Some(left) = i.checked_sub(1).map(|i| ARMS[i]) {
            for side in Side::BOTH {
                lift(&mut pose, figure, side, left);
            }
        }
        posed::moved(figure, &pose)
    })
}

/// Points an arm.
fn lift(pose: &mut Pose, figure: &Figure, side: Side, left: DVec3) {
    let at = |part| {
        let bind = figure.inverse_bind[Bone::on(side, part).index()].inverse();
        bind.translation
    };
    let now = (at("elbow") - at("shoulder")).normalize_or_zero();
    let mirror = if side == Side::Left { 1.0 } else { -1.0 };
    let wanted = DVec3::new(mirror * left.x, left.y, left.z).normalize();
    let turn = DQuat::from_rotation_arc(now, wanted);
    let share = if wanted.y > 0.3 { BLADE_SHARE } else { 0.0 };
    let blade = DQuat::IDENTITY.slerp(turn, share);
    posed::turn(pose, figure, Bone::on(side, "scapula"), blade);
    posed::turn(
        pose,
        figure,
        Bone::on(side, "shoulder"),
        blade.inverse() * turn,
    );
}

fn nearest(all: &[DVec3], p: DVec3) -> f64 {
    let squared = all.iter().map(|q| q.distance_squared(p));
    squared.fold(f64::MAX, f64::min).sqrt()
}

/// Points of the surface about the chains, one in each small cube and for each of two sides.
fn surface(figure: &Figure, chains: &[DVec3], moved: &[Vec<DAffine3>; POSES]) -> Vec<Point> {
    let mut taken = std::collections::BTreeSet::new();
    let mut out = Vec::new();
    for mesh in figure
        .meshes
        .iter()
        .filter(|m| m.material.kind.stops_hair())
    {
        for v in 0..mesh.positions.len() {
            let in_poses = moved.each_ref().map(|m| mesh.skinned(m, v));
            let [at, normal] = in_poses[0];
            if nearest(chains, at) > BOUND_M {
                continue;
            }
            let cell = (at / CELL_M).floor().to_array().map(|x| x as i64);
            let side = normal.to_array().map(|x| x > 0.0);
            if !taken.insert((cell, side)) {
                continue;
            }
            let weights = mesh.weights[v];
            let mut most = [0, 1, 2, 3];
            most.sort_by(|&a, &b| weights[b].total_cmp(&weights[a]));
            out.push(Point {
                at: in_poses.map(|p| p[0]),
                normal: in_poses.map(|p| p[1]),
                joints: [most[0], most[1]].map(|k| usize::from(mesh.joints[v][k])),
            });
        }
    }
    out
}

/// Returns the points not covered by another surface in the bind pose.
fn touchable(mut all: Vec<Point>) -> Vec<Point> {
    let bound = |p: &Point| [p.at[0], p.normal[0]];
    let covered: Vec<bool> = all
        .iter()
        .map(|p| all.iter().any(|q| lies_under(bound(p), bound(q))))
        .collect();
    let mut is_covered = covered.into_iter();
    all.retain(|_| is_covered.next() == Some(false));
    all
}

/// Returns the largest sphere inside the surface that touches it at a point in a pose (the
/// shrinking ball of Ma, Bae and Choi 2012, doi:10.1007/s00371-011-0594-7, in one pass), and that
/// does not protrude in any other.
fn ball(
    surface: &[Point],
    p: &Point,
    joint: usize,
    pose: usize,
    moved: &[Vec<DAffine3>; POSES],
) -> Ball {
    let (touched, normal) = (p.at[pose], p.normal[pose]);
    let bound = |q: &Point| {
        let off = touched - q.at[pose];
        let down = off.dot(normal);
        let radius = off.length_squared() / (2.0 * down);
        // The inner side of a sleeve bounds nothing.
        let outward = q.at[pose] - (touched - normal * radius);
        (down > 1e-6 && q.normal[pose].dot(outward) > 0.0).then_some(radius)
    };
    let radius = surface.iter().filter_map(bound).fold(BOUND_M, f64::min);
    let middle = touched - normal * radius;
    let in_bind = moved[pose][joint].inverse().transform_point3(middle);
    let middle = moved.each_ref().map(|m| m[joint].transform_point3(in_bind));
    let reach = |q: &Point| {
        let reached = (0..POSES).map(|i| q.at[i].distance(middle[i]));
        reached.fold(f64::MAX, f64::min) + OUT_M
    };
    Ball {
        middle,
        radius: surface.iter().map(reach).fold(radius, f64::min),
        joint,
    }
}

/// Selects the balls that each cover the most remaining points.
fn chosen(balls: &[Ball], near: &[(usize, Point)]) -> Vec<Ball> {
    let held: Vec<Vec<usize>> = balls
        .iter()
        .map(|b| {
            let is_held = |&i: &usize| b.contains(&near[i].1, near[i].0);
            (0..near.len()).filter(is_held).collect()
        })
        .collect();
    let mut open = vec![true; near.len()];
    let mut out = Vec::new();
    for _ in 0..MAX_SPHERES {
        let gain = |b: usize| held[b].iter().filter(|&&i| open[i]).count();
        let Some(best) = (0..balls.len()).max_by_key(|&b| gain(b)) else {
            break;
        };
        if gain(best) < MIN_GAIN {
            break;
        }
        for &i in &held[best] {
            open[i] = false;
        }
        out.push(balls[best]);
    }
    out
}

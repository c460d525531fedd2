//! What swings on a figure: the joints of its chains, and the spheres that keep them out of
//! head, neck, shoulders and clothes.

use raconteur_base::{DAffine3, DVec3, Side};
use raconteur_body::figure::{Figure, MaterialKind, Mesh};
use raconteur_body::skeleton::{Bone, Drive, Skeleton};
use raconteur_body::springs::{Chain, Collider, Link, Springs};

use super::hair::HairChain;

/// Surface within this distance of a chain is to be kept clear of, metres.
const NEAR_M: f64 = 0.09;
/// Surface within this distance of a chain bounds the spheres, metres.
const BOUND_M: f64 = 0.25;
/// One point of the surface is kept in a cube of this side, metres.
const CELL_M: f64 = 0.006;
/// Surface that lies at most so far under another, and beside it, cannot be touched, metres.
const UNDER_M: [f64; 2] = [0.03, 0.007];
/// Spheres of a figure at most, the least of their radii, and how far under the surface a place
/// counts as kept clear of, metres.
const MOST: usize = 56;
const LEAST_RADIUS_M: f64 = 0.012;
const SLACK_M: f64 = 0.003;
/// Points of the surface that a further sphere must gain.
const LEAST_GAIN: usize = 3;
/// Radii of sleeved arms, shares of stature. Designed.
const UPPER_ARM: f64 = 0.029;
const FOREARM: f64 = 0.024;
/// Clearance that ends of chains keep at most, and what is left of it at rest, metres.
const MOST_CLEAR_M: f64 = 0.018;
const PLAY_M: f64 = 0.0005;

/// Adds the joints of chains to a skeleton whose joints have `frames` in the bind pose.
pub(super) fn hang(chains: &[HairChain], skeleton: &mut Skeleton, frames: &[DAffine3]) {
    let skull = Bone::Skull.index();
    let axes = DAffine3::from_mat3(frames[skull].matrix3);
    let mut of_chain = 0u8..;
    for chain in chains {
        let Some(c) = of_chain.next() else { break };
        if chain.points.len() < 2 {
            continue;
        }
        let mut parent = (skull, frames[skull].translation);
        for (l, p) in (0u8..).zip(&chain.points) {
            let local = axes.matrix3.transpose() * (*p - parent.1);
            let joint = skeleton.hang(
                format!("hair_{c}_{l}"),
                parent.0,
                DAffine3::from_translation(local),
                Drive::Spring(c, l),
            );
            parent = (joint, *p);
        }
    }
}

/// A point of what chains may meet.
#[derive(Clone, Copy)]
struct Point {
    at: DVec3,
    normal: DVec3,
    /// The joint that carries most of it.
    joint: usize,
}

/// A sphere that touches the surface from inside.
struct Ball {
    middle: DVec3,
    radius: f64,
    joint: usize,
}

/// The springs of a figure whose chains have been hung.
pub(super) fn of(figure: &Figure, chains: &[HairChain]) -> Springs {
    let all: Vec<DVec3> = chains.iter().flat_map(|c| c.points.clone()).collect();
    if all.is_empty() {
        return Springs::default();
    }
    let surface = touchable(surface(figure, &all));
    let balls = chosen(&surface, &all);
    let ball = |b: &Ball| {
        let at = figure.inverse_bind[b.joint].transform_point3(b.middle);
        Collider {
            joint: b.joint,
            ends: [at, at],
            radius_m: b.radius,
        }
    };
    let mut colliders: Vec<Collider> = balls.iter().map(ball).collect();
    colliders.extend(arms(figure));
    let joint = |c: usize, l: usize| {
        let wanted = Drive::Spring(c as u8, l as u8);
        figure.skeleton.joints().iter().position(|j| j.drive == wanted)
    };
    let link = |c: usize, chain: &HairChain, l: usize| {
        let end = chain.points[(l + 1).min(chain.points.len() - 1)];
        let clear = |b: &Ball| end.distance(b.middle) - b.radius;
        let least = balls.iter().map(clear).fold(f64::MAX, f64::min);
        Some(Link {
            joint: joint(c, l)?,
            stiffness: chain.stiffness,
            gravity: DVec3::NEG_Y * chain.gravity,
            drag: chain.drag,
            radius_m: (least - PLAY_M).clamp(0.0, MOST_CLEAR_M),
        })
    };
    let chain = |(c, chain): (usize, &HairChain)| {
        let links: Option<Vec<Link>> = (0..chain.points.len()).map(|l| link(c, chain, l)).collect();
        Some(Chain {
            links: links.filter(|l| l.len() > 1)?,
            colliders: (0..colliders.len()).collect(),
        })
    };
    Springs {
        chains: chains.iter().enumerate().filter_map(chain).collect(),
        colliders: colliders.clone(),
    }
}

/// Arms, which come to the hair when they are raised.
fn arms(figure: &Figure) -> impl Iterator<Item = Collider> + '_ {
    let links = Side::BOTH.map(|side| {
        let [shoulder, elbow, wrist] =
            ["shoulder", "elbow", "wrist"].map(|part| Bone::on(side, part));
        [(shoulder, elbow, 0.35, UPPER_ARM), (elbow, wrist, 0.0, FOREARM)]
    });
    links.into_iter().flatten().map(|(bone, next, from, radius)| {
        let end = figure.skeleton.joints()[next.index()].translation_in_parent;
        Collider {
            joint: bone.index(),
            ends: [end * from, end],
            radius_m: radius * figure.skeleton.stature_m(),
        }
    })
}

/// Whether hair may touch a mesh.
fn is_solid(mesh: &Mesh) -> bool {
    use MaterialKind::{Cornea, Eye, Hair, Lash, Mouth, Teeth};
    !matches!(mesh.material.kind, Cornea | Eye | Hair | Lash | Mouth | Teeth)
}

fn nearest(all: &[DVec3], p: DVec3) -> f64 {
    let squared = all.iter().map(|q| q.distance_squared(p));
    squared.fold(f64::MAX, f64::min).sqrt()
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// Points of the surface about the chains, one in each small cube and for each of two sides.
fn surface(figure: &Figure, chains: &[DVec3]) -> Vec<Point> {
    let mut taken = std::collections::BTreeSet::new();
    let mut out = Vec::new();
    for mesh in figure.meshes.iter().filter(|m| is_solid(m)) {
        for (i, (p, n)) in mesh.positions.iter().zip(&mesh.normals).enumerate() {
            let (at, normal) = (wide(*p), wide(*n));
            if nearest(chains, at) > BOUND_M {
                continue;
            }
            let cell = (at / CELL_M).floor().to_array().map(|x| x as i64);
            let side = normal.to_array().map(|x| x > 0.0);
            if !taken.insert((cell, side)) {
                continue;
            }
            let weights = mesh.weights[i];
            let most = (0..4).max_by(|&a, &b| weights[a].total_cmp(&weights[b]));
            out.push(Point {
                at,
                normal,
                joint: usize::from(mesh.joints[i][most.unwrap_or(0)]),
            });
        }
    }
    out
}

/// What no other surface covers.
fn touchable(all: Vec<Point>) -> Vec<Point> {
    let covers = |p: &Point, q: &Point| {
        let off = q.at - p.at;
        let up = off.dot(p.normal);
        up > 0.001
            && up < UNDER_M[0]
            && q.normal.dot(p.normal) > 0.3
            && (off - p.normal * up).length() < UNDER_M[1]
    };
    let covered: Vec<bool> = all.iter().map(|p| all.iter().any(|q| covers(p, q))).collect();
    let mut is_covered = covered.into_iter();
    let mut all = all;
    all.retain(|_| is_covered.next() == Some(false));
    all
}

/// The largest sphere inside the surface that touches it at a point (the shrinking ball of Ma,
/// Bae and Choi 2012, doi:10.1007/s00371-011-0594-7, in one pass).
fn ball(surface: &[Point], p: &Point) -> Ball {
    let bound = |q: &Point| {
        let off = p.at - q.at;
        let down = off.dot(p.normal);
        let radius = off.length_squared() / (2.0 * down);
        let middle = p.at - p.normal * radius;
        // The inner side of a sleeve bounds nothing.
        (down > 1e-6 && q.normal.dot(q.at - middle) > 0.0).then_some(radius)
    };
    let radius = surface.iter().filter_map(bound).fold(BOUND_M, f64::min);
    Ball {
        middle: p.at - p.normal * radius,
        radius,
        joint: p.joint,
    }
}

/// Few spheres that together keep clear of as much as they can, the best first.
fn chosen(surface: &[Point], chains: &[DVec3]) -> Vec<Ball> {
    let near: Vec<&Point> = surface
        .iter()
        .filter(|p| nearest(chains, p.at) < NEAR_M)
        .collect();
    let mut balls: Vec<Ball> = near.iter().map(|p| ball(surface, p)).collect();
    balls.retain(|b| b.radius > LEAST_RADIUS_M);
    let holds = |b: &Ball, p: &Point| b.middle.distance(p.at) < b.radius + SLACK_M;
    let held: Vec<Vec<usize>> = balls
        .iter()
        .map(|b| (0..near.len()).filter(|&i| holds(b, near[i])).collect())
        .collect();
    let mut open = vec![true; near.len()];
    let mut out = Vec::new();
    for _ in 0..MOST {
        let gain = |b: usize| held[b].iter().filter(|&&i| open[i]).count();
        let Some(best) = (0..balls.len()).max_by_key(|&b| gain(b)) else {
            break;
        };
        if gain(best) < LEAST_GAIN {
            break;
        }
        for &i in &held[best] {
            open[i] = false;
        }
        let Ball { middle, radius, joint } = balls[best];
        out.push(Ball { middle, radius, joint });
    }
    out
}

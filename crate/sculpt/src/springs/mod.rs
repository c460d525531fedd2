//! Swinging parts of a figure: the joints of its chains, and the spheres that keep them out of
//! head, neck, shoulders and clothes.

mod balls;

use raconteur_base::{DAffine3, DVec3, Side};
use raconteur_body::figure::Figure;
use raconteur_body::skeleton::{Bone, Drive, Skeleton};
use raconteur_body::springs::{Chain, Collider, SpringLink, Springs};

use balls::Ball;

/// Radii of sleeved arms, shares of stature. Designed.
const UPPER_ARM: f64 = 0.029;
const FOREARM: f64 = 0.024;
/// Maximum clearance of the ends of chains; the next constant is the remainder at rest, metres.
const MAX_CLEAR_M: f64 = 0.05;
const PLAY_M: f64 = 0.0005;

/// Parameters of a hanging, swinging chain of joints in the hair.
#[derive(Clone, Debug, PartialEq)]
pub struct HairChain {
    /// Joints from the root, then the end; metres.
    pub points: Vec<DVec3>,
    /// Stiffness, defined as in [`Link`](raconteur_body::springs::SpringLink).
    pub stiffness: f64,
    /// Downwards; as in [`Link`](raconteur_body::springs::SpringLink).
    pub gravity: f64,
    /// Drag, defined as in [`Link`](raconteur_body::springs::SpringLink).
    pub drag: f64,
}

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

/// Builds the springs of a figure whose chains have been attached.
pub(super) fn build_springs(figure: &Figure, chains: &[HairChain]) -> Springs {
    let all: Vec<DVec3> = chains.iter().flat_map(|c| c.points.clone()).collect();
    if all.is_empty() {
        return Springs::default();
    }
    let balls = balls::inside(figure, &all);
    let ball = |b: &Ball| {
        let at = figure.inverse_bind[b.joint].transform_point3(b.bound());
        Collider {
            joint: b.joint,
            ends: [at, at],
            radius_m: b.radius,
        }
    };
    // The last one wins where two push against each other: hair is rather in an arm than in the face.
    let mut colliders: Vec<Collider> = arms(figure).chain(balls.iter().map(ball)).collect();
    colliders.sort_by_key(|c| rank(figure, c.joint));
    let joint = |c: usize, l: usize| {
        let wanted = Drive::Spring(c as u8, l as u8);
        figure
            .skeleton
            .joints()
            .iter()
            .position(|j| j.drive == wanted)
    };
    let link = |c: usize, chain: &HairChain, l: usize| {
        let end = chain.points[(l + 1).min(chain.points.len() - 1)];
        let clear = |b: &Ball| end.distance(b.bound()) - b.radius;
        let least = balls.iter().map(clear).fold(f64::MAX, f64::min);
        Some(SpringLink {
            joint: joint(c, l)?,
            stiffness: chain.stiffness,
            gravity: DVec3::NEG_Y * chain.gravity,
            drag: chain.drag,
            radius_m: (least - PLAY_M).clamp(0.0, MAX_CLEAR_M),
        })
    };
    let chain = |(c, chain): (usize, &HairChain)| {
        let links: Option<Vec<SpringLink>> =
            (0..chain.points.len()).map(|l| link(c, chain, l)).collect();
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

/// Returns the rank of a joint's colliders in the collision order: head after neck after all
/// others.
fn rank(figure: &Figure, joint: usize) -> u8 {
    match figure.skeleton.joints()[joint].drive {
        Drive::Bone(Bone::Skull | Bone::Chin) | Drive::Share(Bone::Skull, _) => 2,
        Drive::Bone(Bone::Cervical) | Drive::Share(Bone::Cervical, _) => 1,
        _ => 0,
    }
}

/// Returns the colliders of the arms, which touch the hair when raised.
fn arms(figure: &Figure) -> impl Iterator<Item = Collider> + '_ {
    let links = Side::BOTH.map(|side| {
        let [shoulder, elbow, wrist] =
            ["shoulder", "elbow", "wrist"].map(|part| Bone::on(side, part));
        [
            (shoulder, elbow, 0.12, UPPER_ARM),
            (elbow, wrist, 0.0, FOREARM),
        ]
    });
    links
        .into_iter()
        .flatten()
        .map(|(bone, next, from, radius)| {
            let end = figure.skeleton.joints()[next.index()].translation_in_parent;
            Collider {
                joint: bone.index(),
                ends: [end * from, end],
                radius_m: radius * figure.skeleton.stature_m(),
            }
        })
}

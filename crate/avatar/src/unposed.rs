//! Bind pose of a figure whose nodes are in another pose.
//!
//! Many files are saved in the middle of a movement. The inverse bind matrices still contain the
//! pose in which the modeller bound the skin, mostly a T or an A, which is a better rest pose than
//! a step or a turn of the trunk.

use raconteur_base::{DAffine3, DMat4, DQuat, DVec3};

use super::humanoid::Humanoid;
use super::tree::Tree;
use raconteur_body::read::ReadError;
use raconteur_body::read::accessor::Source;
use raconteur_body::skeleton::Bone;

/// Maximum relative difference of bone lengths between the two poses. Beyond it, the node
/// transforms also shape the figure and must be kept.
const SAME_LENGTH: f64 = 0.03;
/// Maximum disagreement between skins about a joint's position, as a share of the trunk's length.
const SAME_PLACE: f64 = 0.02;
/// Cosine of the angle (20°) between the trunk and an axis of the bind space within which this axis
/// is up.
const ALONG_AXIS: f64 = 0.94;

/// Cosine of the maximum lean of the hips (45°) in a movement; a lying figure is not set upright
/// here.
const MAX_LEAN: f64 = 0.7;

/// Joints with their binds, joint from the skin's own space.
type Binds = Vec<(usize, DAffine3)>;

/// Returns the world transform of every node in the bind pose; `None` if it is unavailable or not a
/// pure pose.
pub(super) fn world(
    tree: &Tree<'_>,
    humanoid: &Humanoid,
    source: &mut Source<'_>,
) -> Result<Option<Vec<DAffine3>>, ReadError> {
    let (Some(hips), Some(head)) = (humanoid.get(Bone::Sacroiliac), humanoid.get(Bone::Skull))
    else {
        return Ok(None);
    };
    let mut skins: Vec<Binds> = Vec::new();
    for skin in &tree.root.skins {
        let Some(accessor) = skin.inverse_bind_matrices else {
            continue;
        };
        let matrices: Vec<[f32; 16]> = source.dense(accessor, "inverse bind matrices")?;
        let binds = matrices
            .into_iter()
            .map(|m| DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from))));
        skins.push(skin.joints.iter().copied().zip(binds).collect());
    }
    Ok(joined(tree, humanoid, &skins, hips, head).filter(|world| is_a_pose(tree, humanoid, world)))
}

fn joined(
    tree: &Tree<'_>,
    humanoid: &Humanoid,
    skins: &[Binds],
    hips: usize,
    head: usize,
) -> Option<Vec<DAffine3>> {
    let has = |skin: &Binds, node: usize| skin.iter().any(|b| b.0 == node);
    let main = skins.iter().find(|s| has(s, hips) && has(s, head))?;
    let bind_of = |skin: &Binds, node: usize| skin.iter().find(|b| b.0 == node).map(|b| b.1);
    let mut space = tree.world[hips] * bind_of(main, hips)?;
    let place = |space: DAffine3, bind: DAffine3| space * bind.inverse();
    // The hips may lean in the saved pose; the skin's own upright direction does not.
    let trunk = place(space, bind_of(main, head)?).translation - tree.place(hips);
    let up = trunk.try_normalize()?;
    let m = space.matrix3;
    let axes = [m.x_axis, m.y_axis, m.z_axis].map(DVec3::normalize_or_zero);
    if let Some(axis) = axes
        .into_iter()
        .flat_map(|a| [a, -a])
        .find(|a| a.dot(up) > ALONG_AXIS && a.y > MAX_LEAN)
    {
        let turn = DAffine3::from_quat(DQuat::from_rotation_arc(axis, DVec3::Y));
        let at = DAffine3::from_translation(tree.place(hips));
        space = at * turn * at.inverse() * space;
    }

    let mut placed: Vec<Option<DAffine3>> = vec![None; tree.parents.len()];
    for (node, bind) in main {
        *placed.get_mut(*node)? = Some(place(space, *bind));
    }
    for skin in skins {
        // A skin with its own space is anchored to a joint known to both, or to the duplicate of a
        // joint in another skeleton.
        let known = |n: usize| placed.get(n).copied().flatten();
        let shared = skin.iter().find_map(|(n, bind)| {
            let at = known(*n).or_else(|| known(humanoid.double_of(tree, *n)?));
            Some(at? * *bind)
        });
        let Some(space) = shared else {
            continue;
        };
        for (node, bind) in skin {
            let here = place(space, *bind);
            let slot = placed.get_mut(*node)?;
            match slot {
                None => *slot = Some(here),
                Some(known) => {
                    let off = known.translation.distance(here.translation);
                    if off.is_nan() || off > SAME_PLACE * trunk.length() {
                        return None;
                    }
                }
            }
        }
    }
    let mut world = tree.world.clone();
    for &node in &tree.order {
        world[node] = match (placed[node], tree.parents[node]) {
            (Some(own), _) => own,
            (None, Some(p)) => world[p] * (tree.world[p].inverse() * tree.world[node]),
            (None, None) => world[node],
        };
    }
    world.iter().all(DAffine3::is_finite).then_some(world)
}

/// Returns true if the bones have the same lengths as in the nodes' pose.
fn is_a_pose(tree: &Tree<'_>, humanoid: &Humanoid, world: &[DAffine3]) -> bool {
    Bone::ALL.iter().all(|bone| {
        let pair = humanoid
            .get(*bone)
            .zip(bone.parent().and_then(|p| humanoid.get(p)));
        pair.is_none_or(|(node, parent)| {
            let now = tree.place(node).distance(tree.place(parent));
            let then = world[node].translation.distance(world[parent].translation);
            (now - then).abs() <= SAME_LENGTH * now.max(then)
        })
    })
}

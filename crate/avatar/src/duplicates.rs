//! Additional skeletons in the same file, such as clothes with own bones of the same names.
//!
//! Their joints and all descendants move with the body's joint of the same name.

use std::collections::HashMap;

use super::error::DiagnosticSink;
use super::humanoid::Humanoid;
use super::names::{NodeRole, slot_of};
use super::tree::Tree;
use raconteur_body::skeleton::Bone;

/// Maximum distance between the first joint of another skeleton and its counterpart, as a share of
/// the trunk's length; a more distant skeleton belongs to something else.
const SAME_BODY: f64 = 0.25;
/// Maximum difference in position and rotation between a joint and its duplicate, as a share of the
/// trunk's length and in radians.
const SAME_JOINT: f64 = 0.02;
/// Maximum number of compared parts; a body has about 70, and a trunk with too many joints is not a
/// body.
const MAX_PARTS: usize = 256;

/// Joints that have no part, each with the node of the body that it doubles, by node.
pub(super) fn find(
    humanoid: &Humanoid,
    tree: &Tree<'_>,
    notes: &mut DiagnosticSink,
) -> Vec<(usize, usize)> {
    let body = PerformingSkeleton::from_humanoid(humanoid, tree);
    let (is_joint, tops) = (tree.joints(), tree.tops());
    let trunk = body.trunk_length(humanoid);
    // Whether a skeleton coincides with the body's, by its first joint with a duplicate.
    let mut stands: Vec<Option<bool>> = vec![None; tops.len()];
    let mut twins = Vec::new();
    for &node in tree.order.iter().filter(|&&n| is_joint[n]) {
        if body.has_part[node] {
            continue;
        }
        let Some(like) = body.double(node) else {
            continue;
        };
        let near = || tree.place(node).distance(tree.place(like)) <= SAME_BODY * trunk;
        if *stands[tops[node]].get_or_insert_with(near) {
            twins.push((node, like));
        }
    }
    twins.sort_unstable();
    // A skin all of whose joints have no part and no double would only go with the hips.
    let mut moved = body.is_below.clone();
    for (node, _) in &twins {
        moved[*node] = true;
    }
    for &node in &tree.order {
        moved[node] |= tree.parents[node].is_some_and(|p| moved[p]);
    }
    let still = |joints: &[usize]| joints.iter().all(|&j| !moved.get(j).is_some_and(|m| *m));
    if tree.root.skins.iter().any(|s| still(&s.joints)) {
        notes.add(
            "skeleton-apart",
            "another skeleton has no bones of the body's names where the body's are; what it carries is stiff",
            "skin it to the body's skeleton, or give its bones the names of the body's",
        );
    }
    twins
}

/// The skeleton that performs.
struct PerformingSkeleton<'a> {
    tree: &'a Tree<'a>,
    /// Nodes that play a part.
    has_part: Vec<bool>,
    /// Nodes with a role, and their descendants.
    is_below: Vec<bool>,
    /// First of these nodes of each name; nodes with a role take precedence.
    named: HashMap<&'a str, usize>,
    /// Roles derived from names, with their nodes.
    slots: Vec<(NodeRole, usize)>,
}

impl<'a> PerformingSkeleton<'a> {
    fn from_humanoid(humanoid: &Humanoid, tree: &'a Tree<'a>) -> Self {
        let mut has_part = vec![false; tree.parents.len()];
        let bones = humanoid.bones.iter().chain(&humanoid.eyes).flatten();
        let others = humanoid.further.iter().map(|f| &f.0);
        let tips = humanoid.tips.iter().map(|t| &t.1);
        for &node in bones.chain(others).chain(tips) {
            has_part[node] = true;
        }
        let mut is_below = has_part.clone();
        for &node in &tree.order {
            is_below[node] |= tree.parents[node].is_some_and(|p| is_below[p]);
        }
        let mut named = HashMap::new();
        let mut slots = Vec::new();
        for kept in [&has_part, &is_below] {
            for &node in tree.order.iter().filter(|&&n| kept[n]) {
                named.entry(tree.own_name(node)).or_insert(node);
            }
        }
        for &node in tree.order.iter().filter(|&&n| has_part[n]) {
            if slots.len() < MAX_PARTS
                && let Some((slot, _)) = slot_of(tree.own_name(node))
            {
                slots.push((slot, node));
            }
        }
        Self {
            tree,
            has_part,
            is_below,
            named,
            slots,
        }
    }

    fn trunk_length(&self, humanoid: &Humanoid) -> f64 {
        let ends = humanoid
            .get(Bone::Sacroiliac)
            .zip(humanoid.get(Bone::Skull));
        ends.map_or(0.0, |(hips, head)| {
            self.tree.place(hips).distance(self.tree.place(head))
        })
    }

    /// Returns the body node that a joint duplicates: the one with the same name, with or without a
    /// copy number, or the same role. Below the body's own joints only the name of a node with a
    /// role counts, because rigs have helpers there.
    fn double(&self, node: usize) -> Option<usize> {
        let name = self.tree.own_name(node);
        let apart = !self.is_below[node];
        let named = |name: &str| {
            let found = self.named.get(name).filter(|_| !name.is_empty());
            found.copied().filter(|&n| apart || self.has_part[n])
        };
        let by_name = named(name).or_else(|| named(without_copy(name)?));
        if by_name.is_some() || !apart {
            return by_name.filter(|&n| n != node);
        }
        let (slot, _) = slot_of(name)?;
        let mut parts = self.slots.iter().filter(|p| p.0 == slot).map(|p| p.1);
        match slot {
            // Trunks have varying numbers of joints; the nearest joint counts.
            NodeRole::Torso => parts.min_by(|&a, &b| {
                let off = |n: usize| self.tree.place(n).distance(self.tree.place(node));
                off(a).total_cmp(&off(b))
            }),
            NodeRole::Arm(_) | NodeRole::Leg(_) => None,
            NodeRole::Bone(_) | NodeRole::Finger(..) | NodeRole::Eye(_) => parts.next(),
        }
    }
}

/// Returns a name without the number of a copy ("Hips.001", "Hips_1"); `None` if it has no such
/// number.
fn without_copy(name: &str) -> Option<&str> {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let bare = bare
        .strip_suffix(['.', '_'])
        .filter(|b| b.len() + 1 < name.len())?;
    Some(bare)
}

impl Humanoid {
    /// Returns the node that a joint duplicates exactly, with the same position and rotation.
    pub(super) fn double_of(&self, tree: &Tree<'_>, node: usize) -> Option<usize> {
        let at = self.twins.binary_search_by_key(&node, |t| t.0).ok()?;
        let like = self.twins[at].1;
        let (hips, head) = self.get(Bone::Sacroiliac).zip(self.get(Bone::Skull))?;
        let trunk = tree.place(hips).distance(tree.place(head));
        let [a, b] = [node, like].map(|n| tree.world[n].to_scale_rotation_translation());
        let one = a.2.distance(b.2) <= SAME_JOINT * trunk && a.1.angle_between(b.1) <= SAME_JOINT;
        one.then_some(like)
    }
}

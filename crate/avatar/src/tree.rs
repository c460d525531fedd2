//! Nodes of an imported file.

use raconteur_base::{DAffine3, DVec3};

use raconteur_body::read::document::Document;

/// Node tree of an imported file with world transforms and parents.
pub(super) struct Tree<'a> {
    pub(super) root: &'a Document<'a>,
    /// World from node, in the file's own unit and facing.
    pub(super) world: Vec<DAffine3>,
    pub(super) parents: Vec<Option<usize>>,
    /// Nodes, parents before children.
    pub(super) order: Vec<usize>,
}

impl<'a> Tree<'a> {
    /// Builds the tree; `world` comes from the reader, which has rejected cycles and shared
    /// children.
    pub(super) fn new(root: &'a Document<'a>, world: Vec<DAffine3>) -> Self {
        let mut parents = vec![None; root.nodes.len()];
        for (i, node) in root.nodes.iter().enumerate() {
            for &child in &node.children {
                parents[child] = Some(i);
            }
        }
        let mut order: Vec<usize> = (0..parents.len())
            .filter(|&i| parents[i].is_none())
            .collect();
        let mut done = 0;
        while let Some(&i) = order.get(done) {
            done += 1;
            order.extend(&root.nodes[i].children);
        }
        Self {
            root,
            world,
            parents,
            order,
        }
    }

    pub(super) fn place(&self, node: usize) -> DVec3 {
        self.world[node].translation
    }

    /// Returns an iterator over a node and its ancestors, from the node to the root.
    pub(super) fn upwards(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        core::iter::successors(Some(node), |&n| self.parents[n])
    }

    pub(super) fn is_above(&self, ancestor: usize, node: usize) -> bool {
        self.upwards(node).any(|n| n == ancestor)
    }

    /// Returns a node's name without the prefix of the whole rig.
    pub(super) fn own_name(&self, node: usize) -> &'a str {
        let root: &'a Document<'a> = self.root;
        let name = root.nodes[node].name.as_str();
        name.rsplit([':', '|']).next().unwrap_or(name)
    }

    /// Returns, for each node, true if it is a joint of a skin; true for all if the file has no
    /// skin.
    pub(super) fn joints(&self) -> Vec<bool> {
        let mut is_joint = vec![self.root.skins.is_empty(); self.root.nodes.len()];
        for &joint in self.root.skins.iter().flat_map(|s| &s.joints) {
            if let Some(slot) = is_joint.get_mut(joint) {
                *slot = true;
            }
        }
        is_joint
    }

    /// Returns, for each node, the highest ancestor connected only through joints: the root of its
    /// skeleton. A node that is not a joint represents itself.
    pub(super) fn tops(&self) -> Vec<usize> {
        let is_joint = self.joints();
        let mut tops: Vec<usize> = (0..is_joint.len()).collect();
        for &node in &self.order {
            if let Some(parent) = self.parents[node].filter(|&p| is_joint[node] && is_joint[p]) {
                tops[node] = tops[parent];
            }
        }
        tops
    }
}

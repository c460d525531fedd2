//! Swinging chains attached to the skeleton of a figure.

use raconteur_base::DAffine3;

use super::document::Document;
use crate::skeleton::{Drive, Skeleton};
use crate::springs::Springs;

/// Attaches the spring chains to the skeleton, where their nodes' names are unique.
pub(super) fn hang(root: &Document<'_>, world: &[DAffine3], skeleton: &mut Skeleton) -> Springs {
    let name = |node: usize| root.nodes.get(node).map(|n| n.name.as_str());
    let known = |skeleton: &Skeleton, node: usize| {
        let name = name(node)?;
        skeleton.joints().iter().position(|j| j.name == name)
    };
    for (c, chain) in (0..=u8::MAX).zip(&root.springs.chains) {
        for (l, link) in (0..=u8::MAX).zip(&chain.links) {
            let parent = root
                .nodes
                .iter()
                .position(|n| n.children.contains(&link.joint));
            let (Some(parent), Some(name)) = (parent, name(link.joint)) else {
                break;
            };
            let (Some(ours), None) = (known(skeleton, parent), known(skeleton, link.joint)) else {
                break;
            };
            let local = world[parent].inverse() * world[link.joint];
            if !local.is_finite() {
                break;
            }
            skeleton.hang(name.to_owned(), ours, local, Drive::Spring(c, l));
        }
    }
    root.springs.renumbered(&|node| known(skeleton, node))
}

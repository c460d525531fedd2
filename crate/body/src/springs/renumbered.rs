//! Renumbering of springs for a skeleton with other joint numbers.

use super::{Chain, Collider, SpringLink, Springs};

impl Springs {
    /// Returns the springs with renumbered joints. A chain that loses a joint is disabled, and so
    /// is a collider.
    #[must_use]
    pub fn renumbered(&self, joint: &dyn Fn(usize) -> Option<usize>) -> Self {
        let link = |l: &SpringLink| {
            let joint = joint(l.joint)?;
            Some(SpringLink { joint, ..*l })
        };
        let read: Vec<Option<Collider>> = self
            .colliders
            .iter()
            .map(|c| {
                let joint = joint(c.joint)?;
                Some(Collider { joint, ..*c })
            })
            .collect();
        let chain = |chain: &Chain| {
            let links: Option<Vec<SpringLink>> = chain.links.iter().map(link).collect();
            Some(Chain {
                links: links?,
                colliders: chain
                    .colliders
                    .iter()
                    .filter_map(|c| place(&read, *c))
                    .collect(),
            })
        };
        Self {
            chains: self.chains.iter().filter_map(chain).collect(),
            colliders: read.iter().flatten().copied().collect(),
        }
    }
}

/// Returns the index of a collider among the valid ones.
pub(crate) fn place(read: &[Option<Collider>], number: usize) -> Option<usize> {
    read.get(number)?.as_ref()?;
    Some(read[..number].iter().flatten().count())
}

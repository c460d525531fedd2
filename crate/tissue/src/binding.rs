//! Binding of a mesh's vertices to the nodes of the tissue.

use raconteur_base::NodeState;

/// Binding of mesh vertices to tissue nodes: a sparse matrix, one row per vertex. The nodes include
/// the jaw's rotation, so when rendered the renderer moves the jaw's weight of bound vertices to
/// the skull.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Binding {
    /// Indices of the bound vertices, ascending.
    pub vertices: Vec<u32>,
    /// Start of each vertex's row in `nodes` and `weights`, plus one entry for the end.
    pub starts: Vec<u32>,
    /// Indices of the nodes that the vertices follow.
    pub nodes: Vec<u16>,
    /// Their weights. Rows sum to 1, or to less where a vertex only follows in part.
    pub weights: Vec<f32>,
}

impl Binding {
    /// Returns, for each bound vertex, its index and the weighted sums of the nodes' displacements
    /// and changes of normals. Missing nodes have no effect.
    pub fn apply<'a>(
        &'a self,
        nodes: &'a [NodeState],
    ) -> impl Iterator<Item = (usize, [f32; 3], [f32; 3])> + 'a {
        self.vertices
            .iter()
            .zip(self.starts.windows(2))
            .map(|(v, row)| {
                let (mut moved, mut turned) = ([0.0; 3], [0.0; 3]);
                let own = row[0] as usize..row[1] as usize;
                let terms = self.nodes[own.clone()].iter().zip(&self.weights[own]);
                for (node, weight) in terms {
                    let Some(node) = nodes.get(usize::from(*node)) else {
                        continue;
                    };
                    for k in 0..3 {
                        moved[k] += weight * node.displacement[k];
                        turned[k] += weight * node.normal_delta[k];
                    }
                }
                (*v as usize, moved, turned)
            })
    }
}

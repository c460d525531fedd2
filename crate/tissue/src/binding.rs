//! How the vertices of a mesh follow the nodes of the tissue.

use raconteur_base::NodeState;

/// Which vertices of a mesh follow which nodes: a sparse matrix of one row a vertex. What is
/// bound has no share of the lower jaw left when it is drawn: its nodes carry the jaw's turn,
/// so that the renderer moves such weights to the skull.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Binding {
    /// The vertices, rising.
    pub vertices: Vec<u32>,
    /// Where the row of each begins in `nodes` and `weights`; one more for the end.
    pub starts: Vec<u32>,
    /// Indices of nodes.
    pub nodes: Vec<u16>,
    /// Their weights. Rows sum to 1, or to less where a vertex only follows in part.
    pub weights: Vec<f32>,
}

impl Binding {
    /// What the nodes do to each bound vertex: the vertex, and the weighted sums of the nodes'
    /// displacements and changes of normals. Nodes that are not there do nothing.
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

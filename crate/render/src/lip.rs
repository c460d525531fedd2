//! Lip opening: light enters the mouth between the lips.

use raconteur_body::Figure;
use raconteur_body::face::NodeState;

/// Opening for a figure without lip nodes, millimetres.
const OPEN_MM: f32 = 100.0;

/// Vertex pairs along the mouth where the lips meet; they measure its opening, which lets light
/// into the mouth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lips {
    /// Nodes of the upper and of the lower lip.
    contact: Vec<[u16; 2]>,
    /// Size of the face against the reference head.
    scale: f32,
}

impl Lips {
    pub(crate) fn from_figure(figure: &Figure) -> Self {
        let tissue = figure.tissue.as_ref();
        tissue.map_or_else(Self::default, |tissue| Self {
            contact: tissue.columns.iter().map(|c| c.contact).collect(),
            scale: tissue.scale.max(0.1),
        })
    }

    /// Returns the largest increase of the lips' distance over rest, millimetres on the reference
    /// head; a large value without lip nodes. Missing nodes are at rest.
    pub(crate) fn apart_mm(&self, nodes: &[NodeState]) -> f32 {
        let height = |i: u16| nodes.get(usize::from(i)).map_or(0.0, |n| n.displacement[1]);
        let apart = self.contact.iter().map(|&[a, b]| height(a) - height(b));
        let widest = apart.fold(None, |most: Option<f32>, x| {
            Some(most.map_or(x, |m| m.max(x)))
        });
        widest.map_or(OPEN_MM, |m| 1e3 * m.max(0.0) / self.scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_place_tells() {
        let lips = Lips {
            contact: vec![[0, 1], [2, 3]],
            scale: 0.5,
        };
        let at = |y: f32| NodeState {
            displacement: [0.0, y, 0.0],
            ..NodeState::default()
        };
        let nodes = [0.0, -0.002, 0.001, -0.003].map(at);
        assert!(
            (lips.apart_mm(&nodes) - 8.0).abs() < 1e-4,
            "the distance between the lips in millimetres"
        );
        assert_eq!(lips.apart_mm(&[0.0, 0.001, 0.0, 0.0].map(at)), 0.0);
        assert_eq!(lips.apart_mm(&[]), 0.0);
        assert_eq!(Lips::default().apart_mm(&nodes), OPEN_MM);
    }
}

//! Binding of imported geometry to the joints of this skeleton.

use raconteur_base::{DVec3, Side};

use super::align::Alignment;
use super::frames::RestSkeleton;
use super::geometry::{Geometry, INFLUENCES};
use super::humanoid::Humanoid;
use super::tree::Tree;
use raconteur_body::figure::{Mesh, Morph};
use raconteur_body::skeleton::Bone;

/// Displacements below this are the exporter's noise, metres.
const STILL_M: f64 = 1e-5;

/// Mapping from the nodes of an imported file to the figure's joints; converts skinning weights.
pub(super) struct Binding {
    joint_of_node: Vec<u16>,
    limbs: Vec<Limb>,
}

/// Upper arm or forearm, whose skin follows a twist little by little.
struct Limb {
    /// The joint that carries it in their rig.
    joint: u16,
    /// The joints that share it in ours, from the body outwards.
    joints: [u16; 3],
    from: DVec3,
    /// Vector along the limb, divided by its squared length and multiplied by the number of steps
    /// between joints; gives a vertex's position along it.
    along: DVec3,
}

impl Limb {
    /// Returns the two joints that share a position on the limb, with weights.
    fn shared(&self, p: DVec3) -> [(u16, f64); 2] {
        let t = (p - self.from).dot(self.along).clamp(0.0, 2.0);
        let i = usize::from(t >= 1.0);
        let f = t - i as f64;
        [(self.joints[i], 1.0 - f), (self.joints[i + 1], f)]
    }
}

/// Returns the joint for each node, from the nodes with a role: nodes without such an ancestor
/// follow the hips.
fn carried(tree: &Tree<'_>, own: &[Option<u16>]) -> Vec<u16> {
    let mut joint_of_node = vec![Bone::Sacroiliac.index() as u16; own.len()];
    for &node in &tree.order {
        if let Some(joint) = own[node].or(tree.parents[node].map(|p| joint_of_node[p])) {
            joint_of_node[node] = joint;
        }
    }
    joint_of_node
}

impl Binding {
    /// Maps every node to the nearest ancestor with a role, and every joint of another skeleton to
    /// the joint that it duplicates.
    pub(super) fn new(
        tree: &Tree<'_>,
        humanoid: &Humanoid,
        rest: &RestSkeleton,
        jaw_moves: bool,
    ) -> Self {
        let joints = rest.skeleton.joints();
        let index = |name: String| joints.iter().position(|j| j.name == name);
        let mut own: Vec<Option<u16>> = vec![None; tree.parents.len()];
        for (node, bone) in &humanoid.further {
            own[*node] = Some(bone.index() as u16);
        }
        for bone in Bone::ALL {
            if let Some(node) = humanoid.get(bone) {
                let bone = if bone == Bone::Chin && !jaw_moves {
                    Bone::Skull
                } else {
                    bone
                };
                own[node] = Some(bone.index() as u16);
            }
        }
        for side in Side::BOTH {
            let letter = if side == Side::Left { 'l' } else { 'r' };
            if let Some(node) = humanoid.eyes[side.index()] {
                own[node] = index(format!("helper_{letter}_eye")).map(|i| i as u16);
            }
        }
        let mut joint_of_node = carried(tree, &own);
        for &(node, like) in &humanoid.twins {
            own[node] = Some(joint_of_node[like]);
        }
        if !humanoid.twins.is_empty() {
            joint_of_node = carried(tree, &own);
        }
        let limb = |side: Side, from: &str, to: &str, joints: [String; 3], steps: f64| {
            let [from, to] = [from, to].map(|p| Bone::on(side, p).index());
            let line = rest.places[to] - rest.places[from];
            let [a, b, c] = joints.map(&index);
            Some(Limb {
                joint: from as u16,
                joints: [a? as u16, b? as u16, c? as u16],
                from: rest.places[from],
                along: line * (steps / line.length_squared().max(1e-12)),
            })
        };
        let limbs = Side::BOTH.into_iter().flat_map(|side| {
            let s = if side == Side::Left { 'l' } else { 'r' };
            let [upper1, upper2, fore1, fore2] = [
                "upperarm_twist1",
                "upperarm_twist2",
                "forearm_twist1",
                "forearm_twist2",
            ]
            .map(|part| format!("helper_{s}_{part}"));
            let [shoulder, elbow] = ["shoulder", "elbow"].map(|p| format!("bone_{s}_{p}"));
            // The arm's own twist is whole at the elbow, the wrist's at the wrist.
            [
                limb(side, "shoulder", "elbow", [upper1, upper2, shoulder], 2.0),
                limb(side, "elbow", "wrist", [elbow, fore1, fore2], 3.0),
            ]
        });
        let limbs = limbs.flatten().collect();
        Self {
            joint_of_node,
            limbs,
        }
    }

    /// Returns the four joints with the greatest weights for a vertex, greatest first, with weights
    /// that sum to 1.
    fn joints_of(
        &self,
        nodes: &[u32; INFLUENCES],
        shares: &[f32; INFLUENCES],
        at: DVec3,
        rigid: bool,
    ) -> ([u16; 4], [f32; 4]) {
        let mut sums: Vec<(u16, f64)> = Vec::with_capacity(2 * INFLUENCES);
        let mut add = |joint: u16, share: f64| match sums.iter_mut().find(|s| s.0 == joint) {
            Some(sum) => sum.1 += share,
            None => sums.push((joint, share)),
        };
        for (&node, &share) in nodes.iter().zip(shares).filter(|(_, s)| **s > 0.0) {
            let joint = self.joint_of_node[node as usize];
            match self.limbs.iter().find(|l| l.joint == joint && !rigid) {
                None => add(joint, f64::from(share)),
                Some(limb) => {
                    for (joint, part) in limb.shared(at) {
                        add(joint, part * f64::from(share));
                    }
                }
            }
        }
        sums.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        sums.truncate(4);
        let total: f64 = sums.iter().map(|s| s.1).sum();
        let (mut joints, mut weights) = ([0; 4], [0.0; 4]);
        for (i, (joint, share)) in sums.into_iter().enumerate() {
            joints[i] = joint;
            weights[i] = (share / total.max(1e-12)) as f32;
        }
        (joints, weights)
    }

    /// Builds a mesh of the figure. `morph_names` is sorted and contains every shape name.
    pub(super) fn mesh(&self, g: Geometry, alignment: &Alignment, morph_names: &[String]) -> Mesh {
        let to_ours = alignment.ours_from_theirs;
        let (scale, turn, _) = to_ours.to_scale_rotation_translation();
        let narrow = |v: DVec3| v.to_array().map(|x| x as f32);
        let positions: Vec<DVec3> = g
            .positions
            .iter()
            .map(|p| to_ours.transform_point3(*p))
            .collect();
        let bound: Vec<_> = positions
            .iter()
            .zip(g.nodes.iter().zip(&g.shares))
            .map(|(at, (nodes, shares))| self.joints_of(nodes, shares, *at, g.rigid))
            .collect();
        let morphs = g
            .shapes
            .into_iter()
            .filter_map(|shape| {
                let rows = shape
                    .vertices
                    .iter()
                    .zip(shape.positions.iter().zip(&shape.normals));
                let rows: Vec<_> = rows
                    .map(|(v, (p, n))| (*v, turn * *p * scale.x, turn * *n))
                    .filter(|(_, p, n)| p.length() > STILL_M || n.length() > 0.01)
                    .collect();
                let target = morph_names
                    .binary_search_by(|n| n.as_str().cmp(shape.name))
                    .ok()?;
                (!rows.is_empty()).then(|| Morph {
                    target,
                    vertices: rows.iter().map(|r| r.0).collect(),
                    position_deltas: rows.iter().map(|r| narrow(r.1)).collect(),
                    normal_deltas: rows.iter().map(|r| narrow(r.2)).collect(),
                })
            })
            .collect();
        Mesh {
            name: g.name,
            material: g.surface.material,
            positions: positions.into_iter().map(narrow).collect(),
            normals: g.normals.iter().map(|n| narrow(turn * *n)).collect(),
            uvs: g.uvs,
            colors: g.colors,
            joints: bound.iter().map(|b| b.0).collect(),
            weights: bound.iter().map(|b| b.1).collect(),
            indices: g.indices,
            morphs,
            coarser: Vec::new(),
            binding: None,
        }
    }
}

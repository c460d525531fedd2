//! Mapping from nodes to bones.

use raconteur_base::Side;
use serde_json::Value;

use super::error::{DiagnosticSink, ImportError};
use super::names::{NodeRole, slot_of};
use super::tree::Tree;
use raconteur_body::skeleton::Bone;

/// Assignment of the file's nodes to bones of a humanoid.
pub(super) struct Humanoid {
    /// The joint of each bone.
    pub(super) bones: [Option<usize>; Bone::COUNT],
    /// Eyeballs, left and right.
    pub(super) eyes: [Option<usize>; 2],
    /// Tips of fingers, by the finger's last bone.
    pub(super) tips: Vec<(Bone, usize)>,
    /// Further nodes that move with a bone.
    pub(super) further: Vec<(usize, Bone)>,
    /// Joints of other skeletons, each with the node that it moves with.
    pub(super) twins: Vec<(usize, usize)>,
}

/// Bones that a performer needs.
const REQUIRED_BONES: [Bone; 6] = [
    Bone::Sacroiliac,
    Bone::Skull,
    Bone::LShoulder,
    Bone::RShoulder,
    Bone::LElbow,
    Bone::RElbow,
];

/// Words for [`REQUIRED_BONES`], as makers of rigs name them.
const NEEDED_WORDS: [&str; 6] = [
    "hips",
    "head",
    "left upper arm",
    "right upper arm",
    "left lower arm",
    "right lower arm",
];

impl Humanoid {
    /// Finds the bones by VRM's table where there is one, by names elsewhere.
    pub(super) fn find(
        json: &Value,
        tree: &Tree<'_>,
        notes: &mut DiagnosticSink,
    ) -> Result<Self, ImportError> {
        let named = vrm_bones(json, tree.root.nodes.len()).unwrap_or_else(|| candidates(tree));
        let mut found = Self::assign(&named, tree);
        found.resolve_other_conventions(tree);
        let missing: Vec<&str> = REQUIRED_BONES
            .iter()
            .zip(NEEDED_WORDS)
            .filter(|(b, _)| found.bones[b.index()].is_none())
            .map(|(_, word)| word)
            .collect();
        if !missing.is_empty() {
            return Err(ImportError::NotHumanoid(format!(
                "no bone is named as the {}",
                missing.join(", ")
            )));
        }
        found.trunk(&named, tree);
        found.palms(tree);
        found.report(notes);
        Ok(found)
    }

    pub(super) fn get(&self, bone: Bone) -> Option<usize> {
        self.bones[bone.index()]
    }

    fn assign(named: &[(usize, String)], tree: &Tree<'_>) -> Self {
        let mut bones = [None; Bone::COUNT];
        let mut eyes = [None; 2];
        let mut fingers: Vec<(Bone, u32, usize)> = Vec::new();
        let mut best = [u8::MAX; Bone::COUNT];
        let mut limbs: [(Bone, Vec<usize>); 4] =
            [Bone::LShoulder, Bone::RShoulder, Bone::LHip, Bone::RHip]
                .map(|first| (first, Vec::new()));
        for (node, name) in named {
            match slot_of(name) {
                Some((NodeRole::Bone(bone), bend)) if bend < best[bone.index()] => {
                    best[bone.index()] = bend;
                    bones[bone.index()] = Some(*node);
                }
                Some((NodeRole::Eye(side), _)) => {
                    eyes[side.index()].get_or_insert(*node);
                }
                Some((NodeRole::Finger(first, order), _)) => fingers.push((first, order, *node)),
                Some((NodeRole::Arm(side), _)) => limbs[side.index()].1.push(*node),
                Some((NodeRole::Leg(side), _)) => limbs[2 + side.index()].1.push(*node),
                _ => {}
            }
        }
        for (first, nodes) in &mut limbs {
            nodes.sort_by_key(|n| tree.upwards(*n).count());
            let parts = match first {
                Bone::LShoulder | Bone::RShoulder => &[0, 1, 2][..],
                // Between ankle and toes our foot has a joint more.
                _ => &[0, 1, 2, 4],
            };
            for (step, node) in parts.iter().zip(nodes) {
                bones[first.index() + step].get_or_insert(*node);
            }
        }
        // Rigs count a finger's joints from 0 or from 1 and may leave some out.
        fingers.sort_by_key(|f| (f.0, f.1));
        fingers.dedup_by_key(|f| (f.0, f.1));
        let mut tips = Vec::new();
        for row in fingers.chunk_by(|a, b| a.0 == b.0) {
            for (i, (first, _, node)) in row.iter().enumerate() {
                match i {
                    0..3 => bones[first.index() + i] = Some(*node),
                    3 => tips.push((Bone::ALL[first.index() + 2], *node)),
                    _ => {}
                }
            }
        }
        Self {
            bones,
            eyes,
            tips,
            further: Vec::new(),
            twins: Vec::new(),
        }
    }

    /// Rigs that name their joints by another custom.
    fn resolve_other_conventions(&mut self, tree: &Tree<'_>) {
        for side in Side::BOTH {
            let [scapula, shoulder] =
                ["scapula", "shoulder"].map(|part| Bone::on(side, part).index());
            // "Shoulder, elbow, wrist" names the upper arm's joint.
            if self.bones[shoulder].is_none() {
                self.bones[shoulder] = self.bones[scapula].take();
            }
        }
        if self.get(Bone::Skull).is_none() {
            self.bones[Bone::Skull.index()] = self.bones[Bone::Cervical.index()].take();
        }
        if self.get(Bone::Sacroiliac).is_none()
            && let (Some(l), Some(r)) = (self.get(Bone::LHip), self.get(Bone::RHip))
        {
            let common = tree.upwards(l).skip(1).find(|&n| tree.is_above(n, r));
            self.bones[Bone::Sacroiliac.index()] = common;
        }
    }

    /// Divides the joints between hips and head among the trunk's and the neck's bones.
    fn trunk(&mut self, named: &[(usize, String)], tree: &Tree<'_>) {
        let (Some(hips), Some(head)) = (self.get(Bone::Sacroiliac), self.get(Bone::Skull)) else {
            return;
        };
        let arms = [Bone::LShoulder, Bone::RShoulder].map(|b| self.get(b));
        let mut between: Vec<usize> = tree
            .upwards(head)
            .skip(1)
            .take_while(|&n| n != hips)
            .collect();
        between.reverse();
        let mut neck: Vec<usize> = Vec::new();
        if tree.is_above(hips, head) {
            let carries_arm = |n: usize| arms.iter().flatten().any(|&a| tree.is_above(n, a));
            let first_of_neck = between
                .iter()
                .rposition(|&n| carries_arm(n))
                .map_or(0, |i| i + 1);
            neck = between.split_off(first_of_neck);
            if first_of_neck == 0 {
                // If the arms are attached to the hips, names must distinguish trunk from neck.
                let named_neck = self.get(Bone::Cervical);
                let cut = neck.iter().position(|&n| Some(n) == named_neck);
                let rest = neck.split_off(cut.unwrap_or(neck.len()));
                between = core::mem::replace(&mut neck, rest);
            }
        } else {
            between = named
                .iter()
                .filter(|(_, name)| matches!(slot_of(name), Some((NodeRole::Torso, _))))
                .map(|(node, _)| *node)
                .collect();
            let hips_at = tree.place(hips);
            between.sort_by(|a, b| {
                let away = |n: usize| tree.place(n).distance(hips_at);
                away(*a).total_cmp(&away(*b))
            });
        }
        // Nodes at one position (a foot's joint and the mesh below it) have one role.
        let start = tree.place(hips);
        let end = neck.first().map_or(tree.place(head), |&n| tree.place(n));
        let along = |n: usize| {
            let axis = end - start;
            (tree.place(n) - start).dot(axis) / axis.length_squared().max(1e-30)
        };
        // The thoracic joint is at 0.55 of the distance from hips to neck.
        let chest = (usize::from(between.len() > 1)..between.len()).min_by(|&a, &b| {
            let off = |i: usize| (along(between[i]) - 0.55).abs();
            off(a).total_cmp(&off(b))
        });
        for (i, &node) in between.iter().enumerate() {
            let bone = if chest.is_some_and(|c| i >= c) {
                Bone::Thoracic
            } else {
                Bone::Lumbar
            };
            if (i == 0 && bone == Bone::Lumbar) || chest == Some(i) {
                self.bones[bone.index()] = Some(node);
            }
            self.further.push((node, bone));
        }
        if let Some(&first) = neck.first() {
            self.bones[Bone::Cervical.index()] = Some(first);
            self.further
                .extend(neck.iter().map(|&n| (n, Bone::Cervical)));
        }
    }

    /// Uses the joints between lower arm and fingers as the hand if a rig has none.
    fn palms(&mut self, tree: &Tree<'_>) {
        for side in Side::BOTH {
            let [elbow, wrist] = ["elbow", "wrist"].map(|part| Bone::on(side, part));
            let Some(forearm) = self.get(elbow).filter(|_| self.get(wrist).is_none()) else {
                continue;
            };
            for finger in ["index", "middle", "ring", "pinky"] {
                let first = Bone::on(side, &format!("{finger}0"));
                let Some(root) = self.get(first) else {
                    continue;
                };
                if !tree.is_above(forearm, root) {
                    continue;
                }
                let palm = tree.upwards(root).skip(1).take_while(|&n| n != forearm);
                for node in palm.collect::<Vec<_>>() {
                    self.bones[wrist.index()].get_or_insert(node);
                    if !self.further.contains(&(node, wrist)) {
                        self.further.push((node, wrist));
                    }
                }
            }
        }
    }

    /// Reports missing limbs.
    fn report(&self, notes: &mut DiagnosticSink) {
        let lacks = |parts: &[&str]| {
            Side::BOTH
                .iter()
                .any(|&s| parts.iter().any(|p| self.get(Bone::on(s, p)).is_none()))
        };
        if lacks(&["hip", "knee"]) {
            notes.add(
                "legs-missing",
                "there are no legs, or no bones for them",
                "show the figure from the waist up",
            );
        }
        if lacks(&["wrist"]) {
            notes.add(
                "hands-missing",
                "there are no bones for the hands; their position is estimated",
                "",
            );
        }
        if lacks(&["index0", "middle0", "thumb0"]) {
            notes.add(
                "fingers-missing",
                "some fingers have no bones; hand shapes do not show",
                "",
            );
        } else if lacks(&["index2", "middle2", "ring0", "pinky0", "thumb2"]) {
            notes.add(
                "fingers-short",
                "some joints of fingers are missing; hand shapes are coarse",
                "",
            );
        }
        if self.get(Bone::Thoracic).is_none() {
            notes.add(
                "spine-missing",
                "the spine has no joints; the trunk is stiff",
                "",
            );
        }
    }

    /// Exchanges left and right.
    pub(super) fn swap_sides(&mut self) {
        let old = self.bones;
        for bone in Bone::ALL {
            self.bones[bone.index()] = old[bone.mirrored().index()];
        }
        self.eyes.swap(0, 1);
        for (_, bone) in &mut self.further {
            *bone = bone.mirrored();
        }
        for (bone, _) in &mut self.tips {
            *bone = bone.mirrored();
        }
    }
}

/// Returns true if the file has a VRM bone table.
pub(super) fn has_vrm_table(json: &Value) -> bool {
    let extensions = &json["extensions"];
    ["VRM", "VRMC_vrm"]
        .iter()
        .any(|name| !extensions[name]["humanoid"]["humanBones"].is_null())
}

/// Nodes and the names of their bones by a VRM extension, 0.x or 1.0.
fn vrm_bones(json: &Value, node_count: usize) -> Option<Vec<(usize, String)>> {
    let node_of = |v: &Value| {
        let node = v["node"].as_u64().and_then(|n| usize::try_from(n).ok());
        node.filter(|n| *n < node_count)
    };
    let one = json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"].as_object();
    let zero = json["extensions"]["VRM"]["humanoid"]["humanBones"].as_array();
    let mut list: Vec<(usize, String)> = match (one, zero) {
        (Some(table), _) => table
            .iter()
            .filter_map(|(name, v)| Some((node_of(v)?, name.clone())))
            .collect(),
        (None, Some(rows)) => rows
            .iter()
            .filter_map(|v| Some((node_of(v)?, v["bone"].as_str()?.to_owned())))
            .collect(),
        (None, None) => return None,
    };
    list.sort();
    (!list.is_empty()).then_some(list)
}

/// Returns the nodes that may be bones: the joints of skins if there are any, because rigs often
/// name a mesh after the part that it covers. Those of the skeleton with the most roles come first,
/// so that a separate clothes skeleton does not control the body.
fn candidates(tree: &Tree<'_>) -> Vec<(usize, String)> {
    let root = tree.root;
    let mut is_joint = tree.joints();
    // The parents of joints count too: some exporters skin nothing to the hips.
    for &node in tree.order.iter().rev() {
        if let (true, Some(p)) = (is_joint[node], tree.parents[node]) {
            is_joint[p] = true;
        }
    }
    let mut list: Vec<(usize, String)> = tree
        .order
        .iter()
        .filter(|&&n| is_joint[n])
        .map(|&n| (n, root.nodes[n].name.clone()))
        .collect();
    let tops = tree.tops();
    let mut parts = vec![0u32; tops.len()];
    for (node, name) in &list {
        parts[tops[*node]] += u32::from(slot_of(name).is_some());
    }
    list.sort_by_key(|(node, _)| core::cmp::Reverse(parts[tops[*node]]));
    list
}

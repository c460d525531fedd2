//! Contacts of the skin: the other lip, the teeth, the bone.

use super::lanes::{Vector, dot, vector, xyz};
use super::springs::Springs;
use super::tissue::{Arch, Tissue};

/// Minimum distance between a lip and the teeth, metres: the lip's inner skin.
const BEFORE_TEETH_M: f32 = 0.0004;
/// Minimum thickness of skin over a bone, metres.
const OVER_BONE_M: f32 = 0.0012;

/// Rigid movement of the lower jaw relative to the bind pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct JawPlace {
    /// Rows of the rotation.
    turn: [[f32; 3]; 3],
    /// Columns of the rotation.
    columns: [Vector; 3],
    hinge: [f32; 3],
    slide: [f32; 3],
}

impl JawPlace {
    /// Creates the movement: pitch about the figure's left after yaw about up, radians, both at the
    /// hinge, and a slide; metres.
    pub(super) fn new(hinge: [f32; 3], pitch_rad: f64, yaw_rad: f64, slide: [f32; 3]) -> Self {
        let (sp, cp) = raconteur_base::ops::sincos(pitch_rad);
        let (sy, cy) = raconteur_base::ops::sincos(yaw_rad);
        let [sp, cp, sy, cy] = [sp, cp, sy, cy].map(|x| x as f32);
        let turn = [
            [cy, sy * sp, sy * cp],
            [0.0, cp, -sp],
            [-sy, cy * sp, cy * cp],
        ];
        Self {
            turn,
            columns: [0, 1, 2].map(|k| vector([turn[0][k], turn[1][k], turn[2][k]])),
            hinge,
            slide,
        }
    }

    pub(super) fn turned(&self, v: [f32; 3]) -> Vector {
        let [x, y, z] = self.columns;
        x * v[0] + y * v[1] + z * v[2]
    }

    /// Returns the current position of a point of the jaw.
    pub(super) fn moved(&self, p: [f32; 3]) -> Vector {
        let v = self.turned([0, 1, 2].map(|k| p[k] - self.hinge[k]));
        vector(self.hinge) + v + vector(self.slide)
    }

    /// Returns the position on the jaw of a point in the world.
    fn unmoved(&self, p: Vector) -> [f32; 3] {
        let p = xyz(p);
        let v = [0, 1, 2].map(|k| p[k] - self.hinge[k] - self.slide[k]);
        [0, 1, 2].map(|k| {
            self.hinge[k] + self.turn[0][k] * v[0] + self.turn[1][k] * v[1] + self.turn[2][k] * v[2]
        })
    }
}

impl Arch {
    /// Returns the distance by which a point must move away from the axis to lie in front of the
    /// teeth, and the direction; `None` if it already does, or if there are no teeth.
    fn inside(&self, p: [f32; 3]) -> Option<(f32, [f32; 2])> {
        let (x, z) = (p[0] - self.origin[0], p[2] - self.origin[2]);
        let (rows, columns) = (usize::from(self.rows), usize::from(self.columns));
        let up = (p[1] - self.origin[1]) / self.step_m;
        let along = 0.5 * (Self::direction(x, z) + 1.0) * (columns as f32 - 1.0);
        let is_beside = (0.0..rows as f32 - 1.0).contains(&up) && (0.0..).contains(&along);
        if z <= 0.0 || !is_beside {
            return None;
        }
        let (row, column) = (up as usize, (along as usize).min(columns - 2));
        let (u, v) = (up - row as f32, along - column as f32);
        let at = |r: usize, c: usize| self.radii[r * columns + c];
        let corners = [
            at(row, column),
            at(row, column + 1),
            at(row + 1, column),
            at(row + 1, column + 1),
        ];
        // Beyond the edge of the teeth there is no obstacle.
        if corners.contains(&0.0) {
            return None;
        }
        let low = corners[0] + (corners[1] - corners[0]) * v;
        let high = corners[2] + (corners[3] - corners[2]) * v;
        let face = low + (high - low) * u + BEFORE_TEETH_M;
        let own = (x * x + z * z).sqrt();
        (own < face && own > 1e-6).then(|| (face - own, [x / own, z / own]))
    }
}

/// Maximum penetration depth of each kind of contact, metres; a diagnostic of the simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenetrationDepths {
    /// A lip in the other.
    pub lips_m: f32,
    /// A lip in the teeth or gums.
    pub teeth_m: f32,
    /// Skin in a bone.
    pub bone_m: f32,
}

/// Collision constraints of the tissue nodes with bones, teeth and lips.
#[derive(Clone, Debug)]
pub(super) struct Contacts {
    /// Nodes with bone under them, with the room they have at rest above the least.
    over_bone: Vec<(u16, f32)>,
}

impl Contacts {
    pub(super) fn new(tissue: &Tissue, springs: &Springs) -> Self {
        let mut is_lip = vec![false; tissue.rest.len()];
        for node in &tissue.before_teeth {
            is_lip[usize::from(*node)] = true;
        }
        for lip in &tissue.lips {
            is_lip[usize::from(lip.node)] = true;
        }
        let over_bone = (0u16..)
            .zip(&tissue.depth)
            .filter(|(node, _)| {
                let node = usize::from(*node);
                !is_lip[node] && !springs.is_led(node)
            })
            .map(|(node, depth)| (node, (depth - OVER_BONE_M).max(0.0)))
            .collect();
        Self { over_bone }
    }

    /// Returns true if a node lies over a bone.
    pub(super) fn is_over_bone(&self, node: usize) -> bool {
        let known = &self.over_bone;
        known
            .binary_search_by_key(&node, |(n, _)| usize::from(*n))
            .is_ok()
    }

    /// Resolves penetrations of nodes; returns their depth.
    pub(super) fn resolve(
        &self,
        tissue: &Tissue,
        springs: &mut Springs,
        bones: &[[Vector; 2]],
        jaw: &JawPlace,
    ) -> PenetrationDepths {
        let mut depths = PenetrationDepths::default();
        for &(node, room) in &self.over_bone {
            let i = usize::from(node);
            let [place, outwards] = bones[i];
            let height = dot(springs.places[i] - place, outwards);
            let deep = -room - height;
            if deep > 0.0 {
                depths.bone_m = depths.bone_m.max(deep);
                springs.shift(i, outwards * deep);
            }
        }
        depths.teeth_m = Self::free_teeth(tissue, springs, jaw);
        depths.lips_m = Self::part_lips(tissue, springs);
        // A lip moved off the other may be behind the edge of the teeth.
        if depths.lips_m > 0.0 {
            Self::free_teeth(tissue, springs, jaw);
        }
        depths
    }

    /// Moves the lips in front of the teeth; returns the penetration depth.
    fn free_teeth(tissue: &Tissue, springs: &mut Springs, jaw: &JawPlace) -> f32 {
        let mut deepest: f32 = 0.0;
        for &node in &tissue.before_teeth {
            let i = usize::from(node);
            let p = springs.position(i);
            if let Some((deep, [x, z])) = tissue.arches[0].inside(xyz(p)) {
                deepest = deepest.max(deep);
                springs.shift(i, vector([x * deep, 0.0, z * deep]));
            }
            let p = springs.position(i);
            if let Some((deep, [x, z])) = tissue.arches[1].inside(jaw.unmoved(p)) {
                deepest = deepest.max(deep);
                springs.shift(i, jaw.turned([x * deep, 0.0, z * deep]));
            }
        }
        deepest
    }

    /// Separates the lips; returns the penetration depth.
    pub(super) fn part_lips(tissue: &Tissue, springs: &mut Springs) -> f32 {
        let mut deepest: f32 = 0.0;
        for [above, below] in &tissue.pairs {
            let (a, b) = (usize::from(*above), usize::from(*below));
            let least = (tissue.rest[a][1] - tissue.rest[b][1]).max(0.0);
            let height = |i: usize| springs.position(i).as_array()[1];
            let deep = least - (height(a) - height(b));
            if deep > 0.0 {
                deepest = deepest.max(deep);
                springs.shift(a, vector([0.0, 0.4 * deep, 0.0]));
                springs.shift(b, vector([0.0, -0.6 * deep, 0.0]));
            }
        }
        deepest
    }
}

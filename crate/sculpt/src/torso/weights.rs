//! Skinning weights during smoothing: sparse, over bones and helper joints.

use raconteur_base::Side;

use crate::part::JointRef;
use raconteur_body::skeleton::{Bone, Drive};

/// Joint of a skinning weight; its order does not depend on floating-point values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rig {
    /// A bone of the table.
    Bone(Bone),
    /// The half-turn helper of a bone.
    Half(Bone),
    /// The forearm's helpers: 1 or 2 thirds of the wrist's twist.
    Twist(Bone, u8),
    /// The upper arm's helpers: the shoulder's swing and 1 or 2 thirds of its twist.
    Swing(Bone, u8),
}

impl Rig {
    /// Returns the joint as a reference for mesh parts.
    #[must_use]
    pub fn joint(self) -> JointRef {
        JointRef(match self {
            Self::Bone(b) => Drive::Bone(b),
            Self::Half(b) => Drive::half(b),
            Self::Twist(b, thirds) => Drive::Twist(b, f64::from(thirds) / 3.0),
            Self::Swing(b, thirds) => Drive::Part(b, 1.0, f64::from(thirds) / 3.0),
        })
    }

    fn bone(self) -> Bone {
        match self {
            Self::Bone(b) | Self::Half(b) | Self::Twist(b, _) | Self::Swing(b, _) => b,
        }
    }

    fn mirrored(self) -> Self {
        match self {
            Self::Bone(b) => Self::Bone(b.mirrored()),
            Self::Half(b) => Self::Half(b.mirrored()),
            Self::Twist(b, t) => Self::Twist(b.mirrored(), t),
            Self::Swing(b, t) => Self::Swing(b.mirrored(), t),
        }
    }
}

/// Skinning weights of one vertex, sorted by joint, summing to 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weights(Vec<(Rig, f64)>);

impl Weights {
    /// Returns weights that assign everything to one joint.
    #[must_use]
    pub fn one(rig: Rig) -> Self {
        Self(vec![(rig, 1.0)])
    }

    /// Returns weights that assign everything to one bone.
    #[must_use]
    pub fn bone(bone: Bone) -> Self {
        Self::one(Rig::Bone(bone))
    }

    /// Returns the weighted sum of several weights.
    #[must_use]
    pub fn mix<'a>(terms: impl Iterator<Item = (&'a Self, f64)>) -> Self {
        let mut all: Vec<(Rig, f64)> = terms
            .flat_map(|(w, s)| w.0.iter().map(move |&(r, x)| (r, x * s)))
            .collect();
        all.sort_by_key(|t| t.0);
        let mut out: Vec<(Rig, f64)> = Vec::with_capacity(6);
        for (rig, w) in all {
            match out.last_mut() {
                Some(last) if last.0 == rig => last.1 += w,
                _ => out.push((rig, w)),
            }
        }
        // Far tails of the smoothing would only cost time.
        out.retain(|t| t.1 > 1e-4);
        let sum: f64 = out.iter().map(|t| t.1).sum();
        if sum > 0.0 {
            for t in &mut out {
                t.1 /= sum;
            }
        }
        Self(out)
    }

    /// Interpolates linearly to `other`: `s` = 0 gives self, 1 gives `other`.
    #[must_use]
    pub fn lerp(&self, other: &Self, s: f64) -> Self {
        Self::mix([(self, 1.0 - s), (other, s)].into_iter())
    }

    /// Returns the joints with their weights, for a vertex of a mesh part.
    #[must_use]
    pub fn refs(&self) -> Vec<(JointRef, f64)> {
        self.0.iter().map(|&(r, w)| (r.joint(), w)).collect()
    }

    /// Returns the sum of the weights of one arm, from the shoulder down.
    #[must_use]
    pub fn arm(&self, side: Side) -> f64 {
        let (first, last) = (Bone::on(side, "shoulder"), Bone::on(side, "thumb2"));
        self.sum(|b| b >= first && b <= last)
    }

    /// Returns the sum of the weights of one leg, from the hip down.
    #[must_use]
    pub fn leg(&self, side: Side) -> f64 {
        let (first, last) = (Bone::on(side, "hip"), Bone::on(side, "metatarsal"));
        self.sum(|b| b >= first && b <= last)
    }

    fn sum(&self, keep: impl Fn(Bone) -> bool) -> f64 {
        self.0
            .iter()
            .filter(|t| keep(t.0.bone()))
            .map(|t| t.1)
            .sum()
    }

    /// Returns the same weights on the joints of the other side.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mut out: Vec<_> = self.0.iter().map(|&(r, w)| (r.mirrored(), w)).collect();
        out.sort_by_key(|t| t.0);
        Self(out)
    }
}

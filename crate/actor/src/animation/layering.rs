//! Motion layers: rotations, the figure's position and its feet, each with the share by which it
//! covers the layers below.
//!
//! Legs are blended by foot position in addition to joint angles. Two layers that both plant a foot
//! on the same spot keep it there during their transition; blended joint angles alone would move
//! it.

use raconteur_base::{DQuat, DVec3, Side};
use raconteur_body::Bone;

use super::groups::BoneSet;

/// Foot of a blended pose: ball position (world), rotation, and the share by which it covers lower
/// layers, 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FootWeight {
    /// Position of its ball, world, metres. A foot that rises on its ball stays there while it
    /// blends into a flat one.
    pub(crate) ball_in_world: DVec3,
    pub(crate) rotation: DQuat,
    pub(crate) share: f64,
}

/// Weighted blend of motion layers of a figure: rotations, root and feet with their shares, 0 to 1.
/// A value with share 0 is undefined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlendedLayers {
    pub(crate) rotations: [DQuat; Bone::COUNT],
    pub(crate) shares: [f64; Bone::COUNT],
    pub(crate) root: DVec3,
    pub(crate) root_share: f64,
    pub(crate) feet: [FootWeight; 2],
}

impl BlendedLayers {
    /// The empty blend.
    pub(crate) const EMPTY: Self = Self {
        rotations: [DQuat::IDENTITY; Bone::COUNT],
        shares: [0.0; Bone::COUNT],
        root: DVec3::ZERO,
        root_share: 0.0,
        feet: [FootWeight {
            ball_in_world: DVec3::ZERO,
            rotation: DQuat::IDENTITY,
            share: 0.0,
        }; 2],
    };

    /// Adds a bone's rotation to a mean.
    pub(crate) fn add_bone(&mut self, bone: Bone, rotation: DQuat, share: f64) {
        let i = bone.index();
        if let Some(s) = add_share(&mut self.shares[i], share) {
            self.rotations[i] = between(self.rotations[i], rotation, s);
        }
    }

    /// Adds a place of the figure to a mean.
    pub(crate) fn add_root(&mut self, root: DVec3, share: f64) {
        if let Some(s) = add_share(&mut self.root_share, share) {
            self.root = self.root.lerp(root, s);
        }
    }

    /// Adds a foot's place to a mean.
    pub(crate) fn add_foot(&mut self, side: usize, ball: DVec3, rotation: DQuat, share: f64) {
        let foot = &mut self.feet[side];
        if let Some(s) = add_share(&mut foot.share, share) {
            foot.ball_in_world = foot.ball_in_world.lerp(ball, s);
            foot.rotation = between(foot.rotation, rotation, s);
        }
    }

    /// Returns the bones that hide all layers below. A leg is included only when its foot and the
    /// figure's place are covered, too.
    pub(crate) fn covered(&self) -> BoneSet {
        let mut covered = BoneSet::NONE;
        for bone in Bone::ALL {
            if self.shares[bone.index()] >= 1.0 {
                covered = covered.with(bone);
            }
        }
        for side in Side::BOTH {
            if self.feet[side.index()].share.min(self.root_share) < 1.0 {
                covered = covered.without(BoneSet::leg(side));
            }
        }
        covered
    }

    /// Lays `above` over this.
    pub(crate) fn cover(&mut self, above: &Self) {
        self.join(above, |a, b| a + b - a * b, |b, sum| b / sum);
    }

    /// Blends towards `to` by a share.
    pub(crate) fn fade(&mut self, to: &Self, share: f64) {
        self.join(to, |a, b| a + (b - a) * share, |b, sum| b * share / sum);
    }

    /// Joins another blend: `sum` returns the new share of two shares, `part` the other's part of
    /// the value, from the other's share and the new one.
    fn join(
        &mut self,
        other: &Self,
        sum: impl Fn(f64, f64) -> f64,
        part: impl Fn(f64, f64) -> f64,
    ) {
        let blend = |own: &mut f64, others: f64| {
            let new = sum(*own, others);
            let s = if new > 0.0 {
                part(others, new).clamp(0.0, 1.0)
            } else {
                0.0
            };
            *own = new;
            s
        };
        for i in 0..Bone::COUNT {
            if other.shares[i] > 0.0 || self.shares[i] > 0.0 {
                let s = blend(&mut self.shares[i], other.shares[i]);
                self.rotations[i] = between(self.rotations[i], other.rotations[i], s);
            }
        }
        let s = blend(&mut self.root_share, other.root_share);
        self.root = self.root.lerp(other.root, s);
        for (own, foot) in self.feet.iter_mut().zip(&other.feet) {
            let s = blend(&mut own.share, foot.share);
            own.ball_in_world = own.ball_in_world.lerp(foot.ball_in_world, s);
            own.rotation = between(own.rotation, foot.rotation, s);
        }
    }
}

/// Adds to a sum of shares. Returns the new share's part of the sum.
fn add_share(sum: &mut f64, share: f64) -> Option<f64> {
    if share <= 0.0 {
        return None;
    }
    *sum += share;
    Some(share / *sum)
}

/// Interpolates two rotations by slerp; the end points are returned bit-exact.
fn between(a: DQuat, b: DQuat, s: f64) -> DQuat {
    if s <= 0.0 {
        a
    } else if s >= 1.0 {
        b
    } else {
        a.slerp(b, s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(angle: f64, share: f64) -> BlendedLayers {
        let mut l = BlendedLayers::EMPTY;
        l.add_bone(Bone::Skull, DQuat::from_rotation_x(angle), share);
        l
    }

    fn skull(l: &BlendedLayers) -> (f64, f64) {
        let i = Bone::Skull.index();
        (l.rotations[i].angle_between(DQuat::IDENTITY), l.shares[i])
    }

    #[test]
    fn what_covers_wholly_hides_what_is_below() {
        let mut l = layer(1.0, 1.0);
        l.cover(&layer(0.2, 1.0));
        let (angle, share) = skull(&l);
        assert!(
            (angle - 0.2).abs() < 1e-9 && (share - 1.0).abs() < 1e-12,
            "full cover hides the layer below"
        );
        let mut l = layer(1.0, 1.0);
        l.cover(&layer(0.2, 0.25));
        assert!(
            (skull(&l).0 - 0.8).abs() < 1e-9,
            "the upper layer counts by its share"
        );
        // Without a layer below, the value counts fully and the share is that of the layer.
        let mut l = BlendedLayers::EMPTY;
        l.cover(&layer(0.2, 0.25));
        assert!(
            (skull(&l).0 - 0.2).abs() < 1e-9 && (skull(&l).1 - 0.25).abs() < 1e-12,
            "without a layer below, the angle counts fully"
        );
    }

    #[test]
    fn a_fade_begins_and_ends_exactly() {
        for (share, angle, cover) in [(0.0, 1.0, 0.5), (1.0, 0.2, 1.0)] {
            let mut l = layer(1.0, 0.5);
            l.fade(&layer(0.2, 1.0), share);
            assert!(
                (skull(&l).0 - angle).abs() < 1e-9 && (skull(&l).1 - cover).abs() < 1e-12,
                "the fade has the expected angle and cover"
            );
        }
    }

    #[test]
    fn a_mean_weighs_its_parts() {
        let mut l = layer(1.0, 0.75);
        l.add_bone(Bone::Skull, DQuat::IDENTITY, 0.25);
        assert!(
            (skull(&l).0 - 0.75).abs() < 1e-9 && (skull(&l).1 - 1.0).abs() < 1e-12,
            "the mean weighs its parts and covers fully"
        );
    }
}

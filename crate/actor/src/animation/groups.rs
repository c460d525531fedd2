//! Bone sets and the default body groups of GEVH fig. 3.3.

use raconteur_base::Side;
use raconteur_body::Bone;

/// Set of bones; selects the bones that a clip, track or player moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BoneSet(u64);

impl BoneSet {
    /// Set without any bone.
    pub const NONE: Self = Self(0);
    /// Set of all bones.
    pub const ALL: Self = Self((1 << Bone::COUNT) - 1);

    /// Returns true if the set contains a bone.
    #[must_use]
    pub fn has(self, bone: Bone) -> bool {
        self.0 & (1 << bone.index()) != 0
    }

    /// Returns true if the set is empty.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns the set with one bone added.
    #[must_use]
    pub fn with(self, bone: Bone) -> Self {
        Self(self.0 | 1 << bone.index())
    }

    /// Returns the union of both sets.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns the intersection of both sets.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Returns the bones of this set that the other does not contain.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Returns the bits of all bones from one to another in the order of [`Bone::ALL`], both
    /// included.
    const fn range(from: Bone, to: Bone) -> u64 {
        let (from, to) = (from as u64, to as u64);
        ((1 << (to - from + 1)) - 1) << from
    }

    /// Returns the bones of one leg, from the hip to the toes.
    #[must_use]
    pub fn leg(side: Side) -> Self {
        Self(match side {
            Side::Left => Self::range(Bone::LHip, Bone::LMetatarsal),
            Side::Right => Self::range(Bone::RHip, Bone::RMetatarsal),
        })
    }
}

/// Default body groups in the order of their tracks. Together they contain all bones, each bone
/// exactly once. The wrist belongs to the arm, as in GEVH 3.2.3, and the pelvis to the torso; the
/// place of the whole figure belongs to the legs.
pub const BODY_GROUPS: [(&str, BoneSet); 8] = [
    ("head", BoneSet(BoneSet::range(Bone::Cervical, Bone::Chin))),
    (
        "torso",
        BoneSet(1 | BoneSet::range(Bone::Lumbar, Bone::Thoracic)),
    ),
    (
        "left_arm",
        BoneSet(BoneSet::range(Bone::LScapula, Bone::LWrist)),
    ),
    (
        "right_arm",
        BoneSet(BoneSet::range(Bone::RScapula, Bone::RWrist)),
    ),
    (
        "left_hand",
        BoneSet(BoneSet::range(Bone::LIndex0, Bone::LThumb2)),
    ),
    (
        "right_hand",
        BoneSet(BoneSet::range(Bone::RIndex0, Bone::RThumb2)),
    ),
    (
        "left_leg",
        BoneSet(BoneSet::range(Bone::LHip, Bone::LMetatarsal)),
    ),
    (
        "right_leg",
        BoneSet(BoneSet::range(Bone::RHip, Bone::RMetatarsal)),
    ),
];

/// Returns the bones of a default body group (GEVH fig. 3.3) by name, for example `left_arm`;
/// `None` for an unknown name.
#[must_use]
pub fn body_group(name: &str) -> Option<BoneSet> {
    let found = BODY_GROUPS.iter().find(|(n, _)| *n == name);
    found.map(|(_, bones)| *bones)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_groups_share_out_all_bones() {
        let mut sum = BoneSet::NONE;
        for (name, bones) in BODY_GROUPS {
            assert!(sum.and(bones).is_empty(), "{name}");
            sum = sum.or(bones);
        }
        assert_eq!(sum, BoneSet::ALL);
        assert!(
            body_group("left_hand").is_some_and(|g| g.has(Bone::LPinky2)),
            "the left hand group contains the little finger"
        );
        assert_eq!(body_group("left_leg"), Some(BoneSet::leg(Side::Left)));
        assert_eq!(body_group("tail"), None);
    }
}

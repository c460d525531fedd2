//! Rest postures: of one arm, and of both.

use raconteur_base::Side;

/// Rest posture of one arm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RestSpot {
    /// Hanging at the side.
    #[default]
    Hanging,
    /// In front of the belly, the fingertips near those of the other hand.
    Belly,
    /// In front of the hips, the hands loosely one over the other.
    Clasped,
    /// In front of the chest, fingertips together.
    Fingertips,
    /// One hand holds the other at the wrist; the dominant hand holds.
    WristHeld,
    /// On the hip.
    Hip,
    /// At the pocket, the fingers hidden by the hand's back.
    Pocket,
    /// Behind the back.
    Behind,
    /// Arms folded.
    Folded,
}

/// Rest posture of both arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestPosture {
    /// Both arms hanging.
    Hanging,
    /// Both hands in front of the belly.
    Belly,
    /// Hands loosely clasped.
    Clasped,
    /// Fingertips together.
    Fingertips,
    /// One hand holding the other's wrist.
    WristHeld,
    /// One hand on the hip, the other hanging.
    OneOnHip,
    /// One hand at the pocket, the other hanging.
    OneInPocket,
    /// One hand in front of the belly, the other hanging.
    OneAtBelly,
    /// Both hands behind the back.
    Behind,
    /// Arms folded.
    Folded,
}

impl RestPosture {
    /// All postures.
    pub const ALL: [Self; 10] = [
        Self::Hanging,
        Self::Belly,
        Self::Clasped,
        Self::Fingertips,
        Self::WristHeld,
        Self::OneOnHip,
        Self::OneInPocket,
        Self::OneAtBelly,
        Self::Behind,
        Self::Folded,
    ];

    /// Returns the name of the posture in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hanging => "hanging",
            Self::Belly => "belly",
            Self::Clasped => "clasped",
            Self::Fingertips => "fingertips",
            Self::WristHeld => "wrist-held",
            Self::OneOnHip => "one-on-hip",
            Self::OneInPocket => "one-in-pocket",
            Self::OneAtBelly => "one-at-belly",
            Self::Behind => "behind",
            Self::Folded => "folded",
        }
    }

    /// Returns the posture of the left and right arm; `lead` is the arm of a one-handed posture.
    #[must_use]
    pub fn spots(self, lead: Side) -> [RestSpot; 2] {
        use RestSpot as S;
        let one = |spot: S| match lead {
            Side::Left => [spot, S::Hanging],
            Side::Right => [S::Hanging, spot],
        };
        match self {
            Self::Hanging => [S::Hanging; 2],
            Self::Belly => [S::Belly; 2],
            Self::Clasped => [S::Clasped; 2],
            Self::Fingertips => [S::Fingertips; 2],
            Self::WristHeld => [S::WristHeld; 2],
            Self::OneOnHip => one(S::Hip),
            Self::OneInPocket => one(S::Pocket),
            Self::OneAtBelly => one(S::Belly),
            Self::Behind => [S::Behind; 2],
            Self::Folded => [S::Folded; 2],
        }
    }

    /// Returns true if the hands touch in the posture.
    pub(super) fn touches(self) -> bool {
        matches!(self, Self::Clasped | Self::Fingertips | Self::WristHeld)
    }

    /// Returns true if the hands can come to the posture and leave it again in a short time: near
    /// the body's middle, and apart.
    pub(super) fn is_near(self) -> bool {
        matches!(self, Self::Belly | Self::OneAtBelly)
    }
}

impl RestSpot {
    /// All rest postures of one arm, in the order of their numbers.
    pub const ALL: [Self; 9] = [
        Self::Hanging,
        Self::Belly,
        Self::Clasped,
        Self::Fingertips,
        Self::WristHeld,
        Self::Hip,
        Self::Pocket,
        Self::Behind,
        Self::Folded,
    ];

    /// Returns the name of the posture in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hanging => "hanging",
            Self::Belly => "belly",
            Self::Clasped => "clasped",
            Self::Fingertips => "fingertips",
            Self::WristHeld => "wrist-held",
            Self::Hip => "hip",
            Self::Pocket => "pocket",
            Self::Behind => "behind",
            Self::Folded => "folded",
        }
    }

    /// Returns the posture by which an arm comes from one posture to another, if not directly:
    /// from behind the back it hangs first.
    pub(super) fn between(self, to: Self) -> Option<Self> {
        let is_behind = self == Self::Behind || to == Self::Behind;
        (is_behind && self != to && self != Self::Hanging && to != Self::Hanging)
            .then_some(Self::Hanging)
    }

    /// Returns true if a gesture cannot begin from there without a detour.
    pub(super) fn is_far(self) -> bool {
        matches!(self, Self::Behind | Self::Folded)
    }

    /// Returns true if one arm can rest like this while the other one gestures.
    pub(super) fn is_single(self) -> bool {
        matches!(self, Self::Hanging | Self::Belly | Self::Hip | Self::Pocket)
    }
}

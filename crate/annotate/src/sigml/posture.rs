//! Postures of the hands: configuration and location.

use raconteur_base::DVec3;
use raconteur_eml::ShapeKey;

use super::shapes;
use crate::xml::Element;

/// Posture of one hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HandPose {
    pub(super) shape: ShapeKey,
    /// Distance from the wrist to the fingertips, skeleton units.
    pub(super) reach: f64,
    /// Direction of the fingers before it is mirrored.
    pub(super) fingers: DVec3,
    /// Letters of the palm as a direction, before they are mirrored.
    pub(super) palm: DVec3,
    /// Factors of the components of directions, ±1.
    pub(super) mirror: DVec3,
    /// Rotation about the palm's normal, about the fingers, and across both, degrees.
    pub(super) wrist_deg: DVec3,
    /// Position of the hand, speaker coordinates, skeleton units.
    pub(super) position: DVec3,
    /// Part of the hand that is at the position.
    pub(super) contact: Contact,
}

/// Part of a hand that is at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Contact {
    /// The middle of the hand.
    Middle,
    /// The middle of the hand, or the fingertips if they point at the body.
    Either,
    /// The fingertips.
    Tips,
}

impl HandPose {
    /// Returns the usual posture of a hand, 1 for the right and −1 for the left one: a flat hand in
    /// front of the stomach.
    pub(super) fn neutral(side: f64) -> Self {
        Self {
            shape: ShapeKey { id: 1, blend: None },
            reach: shapes::reach("hamflathand"),
            fingers: DVec3::NEG_Z,
            palm: DVec3::X,
            mirror: DVec3::new(side, 1.0, 1.0),
            wrist_deg: DVec3::ZERO,
            position: DVec3::new(-7.0 * side, 14.0, -15.0),
            contact: Contact::Middle,
        }
    }
}

/// Change of one hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Change {
    pub(super) shape: Option<(ShapeKey, f64)>,
    pub(super) fingers: Option<DVec3>,
    pub(super) palm: Option<DVec3>,
    pub(super) mirror: Option<DVec3>,
    pub(super) place: Option<(DVec3, Contact)>,
}

impl Change {
    /// Applies the change to a pose.
    pub(super) fn apply(&self, pose: &mut HandPose) {
        if let Some((shape, reach)) = self.shape {
            (pose.shape, pose.reach) = (shape, reach);
        }
        if let Some(mirror) = self.mirror {
            pose.mirror = mirror;
        }
        pose.fingers = self.fingers.unwrap_or(pose.fingers);
        pose.palm = self.palm.unwrap_or(pose.palm);
        if let Some((position, contact)) = self.place {
            (pose.position, pose.contact) = (position, contact);
        }
    }

    /// Returns true if the change has a position.
    pub(super) fn moves(&self) -> bool {
        self.place.is_some()
    }

    /// Adds a later change.
    pub(super) fn add(&mut self, later: &Self) {
        self.shape = later.shape.or(self.shape);
        self.fingers = later.fingers.or(self.fingers);
        self.palm = later.palm.or(self.palm);
        self.mirror = later.mirror.or(self.mirror);
        self.place = later.place.or(self.place);
    }
}

/// Changes of the dominant and the other hand.
pub(super) type Changes = [Change; 2];

/// Hands of a sign and the symmetry between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hands {
    /// True for each hand that a common posture or motion moves: the dominant, the other.
    pub(super) moves: [bool; 2],
    /// Factors of the components of directions for the other hand.
    pub(super) mirror: DVec3,
    /// True if the hands move in turn.
    pub(super) is_alternating: bool,
}

impl Hands {
    /// Reads the hands of a `sign_manual`.
    pub(super) fn read(manual: &Element) -> Self {
        let flag = |name: &str| matches!(manual.value(name), Some("true" | "1"));
        let factor = |name: &str| if flag(name) { -1.0 } else { 1.0 };
        let is_both = flag("both_hands");
        let is_other = flag("nondominant") && !is_both;
        Self {
            moves: [!is_other, is_both || is_other],
            mirror: DVec3::new(factor("lr_symm"), factor("ud_symm"), factor("oi_symm")),
            is_alternating: flag("outofphase"),
        }
    }

    /// Returns the factors of directions for a hand.
    pub(super) fn mirror_of(&self, hand: usize) -> DVec3 {
        if hand == 0 { DVec3::ONE } else { self.mirror }
    }

    /// Returns the factors of motions for a hand: alternating hands move against each other.
    pub(super) fn motion_mirror(&self, hand: usize) -> DVec3 {
        let mirror = self.mirror_of(hand);
        let is_against = hand == 1 && self.is_alternating;
        if is_against { -mirror } else { mirror }
    }
}

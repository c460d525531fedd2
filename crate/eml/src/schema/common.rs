//! Attributes shared by several elements.

use super::Attribute;
use crate::Manipulator;

/// Changes in percent up to a factor of four and its inverse: further, a voice is no voice.
pub(super) const FOURFOLD: [f64; 2] = [-75.0, 300.0];

/// Limb to move.
pub(super) const MANIPULATOR: Attribute =
    Attribute::choice("manipulator", Manipulator::WORDS, "The limb, or the head.").required();

/// Position of the end of a limb; required in some elements.
pub(super) const POSITION: [Attribute; 3] = [
    Attribute::placed(
        "posX",
        "Position: units to the speaker's left; the speaker is about 77 units tall.",
    )
    .unit("units"),
    Attribute::placed("posY", "Position: units upwards.").unit("units"),
    Attribute::placed("posZ", "Position: units to the back.").unit("units"),
];

/// Orientation of the end of a limb.
pub(super) const ORIENTATION: [Attribute; 3] = [
    Attribute::placed("yaw", "Orientation: yaw.")
        .default("0")
        .unit("°"),
    Attribute::placed("pitch", "Orientation: pitch.")
        .default("0")
        .unit("°"),
    Attribute::placed("roll", "Orientation: roll.")
        .default("0")
        .unit("°"),
];

/// Function that defines a path.
pub(super) const FUNCTION: [Attribute; 2] = [
    Attribute::identifier(
        "functionName",
        "The function: segment, or another one that the player supports.",
    )
    .required(),
    Attribute::flag(
        "isLooping",
        "Whether the function restarts after its period.",
    )
    .default("false"),
];

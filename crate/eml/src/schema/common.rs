//! Attributes that several elements have.

use super::Attribute;
use crate::Manipulator;

/// Which limb moves.
pub(super) const MANIPULATOR: Attribute = Attribute::choice(
    "manipulator",
    Manipulator::WORDS,
    doc!("The limb, or the head."),
)
.required();

/// Where the end of a limb goes; whether it must be said differs.
pub(super) const POSITION: [Attribute; 3] = [
    Attribute::number(
        "posX",
        doc!("Position: units to the speaker's left; the speaker is about 77 units tall."),
    )
    .unit("units"),
    Attribute::number("posY", doc!("Position: units upwards.")).unit("units"),
    Attribute::number("posZ", doc!("Position: units to the back.")).unit("units"),
];

/// How the end of a limb is turned there.
pub(super) const ORIENTATION: [Attribute; 3] = [
    Attribute::number("yaw", doc!("Orientation: yaw."))
        .default("0")
        .unit("°"),
    Attribute::number("pitch", doc!("Orientation: pitch."))
        .default("0")
        .unit("°"),
    Attribute::number("roll", doc!("Orientation: roll."))
        .default("0")
        .unit("°"),
];

/// Along what something moves.
pub(super) const FUNCTION: [Attribute; 2] = [
    Attribute::identifier(
        "functionName",
        doc!("The function: segment, or another one that the player knows."),
    )
    .required(),
    Attribute::flag(
        "isLooping",
        doc!("Whether the function starts again after its period."),
    )
    .default("false"),
];

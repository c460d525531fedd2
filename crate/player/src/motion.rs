//! From clauses of animation players and manipulators to what the actor is asked.
//!
//! Few stories use them, and a browser fetches their code only for those that do. All of it is
//! reached through this module alone, and only where a script asks for it ([`asked`](crate::script::asked)):
//! `web/tools/split.mjs` cuts there. Its functions are never inlined, or the code would come
//! along.

use raconteur_actor::animation::PlayerCommand;
use raconteur_actor::{Library, ManipulatorScript};
use raconteur_body::Skeleton;
use raconteur_eml::{Diagnostic, Document, Span};
use raconteur_stage::Room;

use crate::gestures::Reach;
use crate::script::Script;
use crate::units::Units;
use crate::{animations, manipulators};

/// What a script asks of manipulators, and of players by time.
#[inline(never)]
pub(crate) fn lower(
    script: &Script,
    units: &Units,
) -> (ManipulatorScript, Vec<(f64, PlayerCommand)>) {
    let (document, timeline) = (&script.document, &script.timeline);
    (
        manipulators::script(document, timeline, units),
        animations::commands(document, timeline).0,
    )
}

/// What is wrong with the clauses of manipulators.
#[inline(never)]
pub(crate) fn problems(script: &Script, units: &Units, reach: &Reach) -> Vec<Diagnostic> {
    manipulators::problems(&script.document, units, reach)
}

/// What commands of players cannot do.
#[inline(never)]
pub(crate) fn without_effect(script: &Script, skeleton: &Skeleton) -> Vec<Diagnostic> {
    animations::problems(&script.document, &script.timeline, skeleton)
}

/// As [`animations::wanted`].
#[inline(never)]
pub(crate) fn wanted(document: &Document) -> Vec<(&str, Span)> {
    animations::wanted(document)
}

/// As [`animations::hint`].
#[inline(never)]
pub(crate) fn hint(name: &str) -> Option<String> {
    animations::hint(name)
}

/// As [`Library::add`].
#[inline(never)]
pub(crate) fn learn(library: &mut Library, name: &str, text: &str) -> Result<(), String> {
    library.add(name, text)
}

/// As [`manipulators::together`].
#[inline(never)]
pub(crate) fn together(scripts: &[&ManipulatorScript]) -> ManipulatorScript {
    manipulators::together(scripts.iter().copied())
}

/// As [`manipulators::room`].
#[inline(never)]
pub(crate) fn room(script: &ManipulatorScript, hand_length_m: f64) -> Room {
    manipulators::room(script, hand_length_m)
}

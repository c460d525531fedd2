//! The Expression Markup Language (GEVH appendix D): text to typed document to
//! timeline.
//!
//! Does: parse EML and recover from anything malformed in it, check it against
//! one table of elements ([`schema::ELEMENTS`]), report problems as data with
//! byte spans ([`Diagnostic`]), and resolve every time expression to seconds
//! ([`Timeline::resolve`]).
//! Does not: read files, fetch entities or references, know how speech is made
//! (it asks [`Durations`]) or what a clause does to a body.
//!
//! Values keep EML's own units and axes: seconds, degrees, skeleton units; `x` to
//! the speaker's left, `y` up, `z` to the back. Whoever acts on them converts.

mod decimal;
mod diagnostic;
mod document;
mod durations;
mod gesture;
mod parse;
pub mod schema;
mod sorted;
mod span;
mod suggest;
mod syntax;
mod time_expr;
mod timeline;
mod voice;
mod work;

pub use diagnostic::{Diagnostic, Severity};
pub use document::{Clause, ClauseId, ClauseKind, Document, Group};
pub use durations::{Durations, EstimatedDurations, PhoneTime, VoiceTiming, WordTime};
pub use gesture::{Coords, GestureKey, Handedness, Key, MotionKey, PalmKey, ShapeKey, Track};
pub use parse::{
    Limits, Parsed, parse, parse_bytes, parse_fragment, parse_fragment_with, parse_with,
};
/// A name or another short text: up to 23 bytes need no allocation, and copies are cheap.
pub use smol_str::SmolStr as Name;
pub use sorted::SortedMap;
pub use span::{LineIndex, Position, Span};
pub use time_expr::{NameTerm, TimeExpr};
pub use timeline::{Resolved, TimedClause, Timeline};
pub use voice::{DivKind, Mark, MarkEvent, Piece, VoiceText, Word};

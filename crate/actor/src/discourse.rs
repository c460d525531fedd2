//! Discourse structure of a performance: paragraphs, referents with a place, direct speech of
//! characters, and tension. Trunk, feet, head and gaze follow it.

use raconteur_base::DVec3;

/// Structure of what a figure says, as far as its body shows it; story time. The lists may be in
/// any order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Discourse {
    /// Start times of paragraphs, seconds.
    pub paragraphs: Vec<f64>,
    /// Mentions of referents that have a place.
    pub mentions: Vec<Mention>,
    /// Direct speech of characters.
    pub roles: Vec<RoleSpan>,
    /// Tension over time; without keys, 0.5 throughout.
    pub tension: Vec<TensionKey>,
}

/// Mention of a referent that has a place on the stage: head and gaze turn towards it (So et al.
/// 2009, doi:10.1111/j.1551-6709.2008.01006.x).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mention {
    /// Start of the first word of the mention, seconds.
    pub start_secs: f64,
    /// End of its last word, seconds.
    pub end_secs: f64,
    /// Place of the referent, in the axes of the figure, metres.
    pub place_in_figure: DVec3,
}

/// Direct speech of one character: the storyteller turns to the character's side, and back to the
/// listener as narrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoleSpan {
    /// Start of the first word, seconds.
    pub start_secs: f64,
    /// End of the last word, seconds.
    pub end_secs: f64,
    /// Side of the character, −1 (right) to 1 (left).
    pub side: f64,
}

/// Tension of the story from a time on; between keys it changes linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensionKey {
    /// Time of the key, seconds.
    pub at_secs: f64,
    /// Tension, 0 (relaxed) to 1 (climax).
    pub tension: f64,
}

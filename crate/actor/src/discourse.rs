//! Discourse structure of a performance: paragraphs, referents with a place, direct speech of
//! characters, and tension. Trunk, feet, head and gaze follow it.

use raconteur_base::DVec3;
use raconteur_base::curve::lerp;
use raconteur_base::order::sort_by_number;

use crate::time_span::TimeSpan;

/// Size of body movements at tension 0 and 1; the mean is 1 at tension 0.5. Designed after
/// Rühlemann 2024 (doi:10.3389/fpsyg.2024.1477263): gestures grow to the climax of a story.
const SIZE_BY_TENSION: [f64; 2] = [0.7, 1.3];

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
    /// Intervals of hushed speech, a secret: start and end, seconds. The figure leans in.
    pub hushed: Vec<TimeSpan>,
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

impl Discourse {
    /// Returns the discourse with its usable parts only, sorted by time: finite times and places,
    /// sides and tension within their ranges.
    #[must_use]
    pub fn usable(&self) -> Self {
        let mut kept = self.clone();
        kept.paragraphs.retain(|t| t.is_finite());
        kept.mentions.retain(|m| {
            m.start_secs.is_finite() && m.end_secs.is_finite() && m.place_in_figure.is_finite()
        });
        kept.roles
            .retain(|r| r.start_secs.is_finite() && r.end_secs.is_finite() && r.side.is_finite());
        for role in &mut kept.roles {
            role.side = role.side.clamp(-1.0, 1.0);
        }
        kept.tension
            .retain(|key| key.at_secs.is_finite() && key.tension.is_finite());
        for key in &mut kept.tension {
            key.tension = key.tension.clamp(0.0, 1.0);
        }
        kept.hushed
            .retain(|span| span.start_secs.is_finite() && span.end_secs.is_finite());
        sort_by_number(&mut kept.hushed, |span| span.start_secs);
        sort_by_number(&mut kept.paragraphs, |t| *t);
        sort_by_number(&mut kept.mentions, |m| m.start_secs);
        sort_by_number(&mut kept.roles, |r| r.start_secs);
        sort_by_number(&mut kept.tension, |key| key.at_secs);
        kept
    }

    /// Returns the tension at a time, 0 to 1, for sorted keys; 0.5 without keys.
    #[must_use]
    pub fn tension_at(&self, time_secs: f64) -> f64 {
        let keys = &self.tension;
        let next = keys.partition_point(|key| key.at_secs <= time_secs);
        let before = next.checked_sub(1).map(|i| keys[i]);
        match (before, keys.get(next)) {
            (Some(a), Some(b)) => {
                let share = (time_secs - a.at_secs) / (b.at_secs - a.at_secs).max(1e-9);
                lerp(a.tension, b.tension, share)
            }
            (Some(key), None) => key.tension,
            (None, Some(key)) => key.tension,
            (None, None) => 0.5,
        }
    }

    /// Returns the size of body movements that the tension at a time gives; 1 at tension 0.5.
    pub(crate) fn size_at(&self, time_secs: f64) -> f64 {
        let [least, most] = SIZE_BY_TENSION;
        lerp(least, most, self.tension_at(time_secs))
    }
}

impl RoleSpan {
    /// Returns the side of the character who speaks at a time, from spans sorted by time; `None`
    /// for the narrator.
    pub(crate) fn side_at(roles: &[Self], time_secs: f64) -> Option<f64> {
        let begun = roles.partition_point(|role| role.start_secs <= time_secs);
        let role = &roles[begun.checked_sub(1)?];
        (time_secs < role.end_secs).then_some(role.side)
    }
}

//! Discourse structure of a script's speech: paragraphs, referents with a place, direct speech and
//! tension.
//!
//! Each script is lowered on its own. Referents and characters belong to the whole performance:
//! a place set by the story also holds in the live fragments that join it, and a character keeps
//! its side. A later script changes nothing before it.

mod pointing;
mod referents;
mod roles;
mod spoken;
mod tension;
#[cfg(test)]
mod tests;

use raconteur_actor::{Discourse, GestureStroke, TensionKey};
use raconteur_base::order::sort_by_number;
use raconteur_eml::ClauseKind;

use crate::lower::cast::Cast;
use crate::lower::cues::UtteranceCue;
use crate::lower::gestures;
use crate::lower::script::Script;
use crate::lower::units::Units;
use pointing::Shoulders;
use referents::GesturePlace;
pub(crate) use referents::PlaceCue;
use roles::{Roles, Turn};
use spoken::{MarkedUtterance, TimedWord};

/// Discourse structure of one script; story time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DiscoursePlan {
    /// Start times of paragraphs, seconds.
    paragraphs: Vec<f64>,
    /// Tension at the start of each sentence.
    tension: Vec<TensionKey>,
    /// Places set by `r:place`.
    pub(crate) places: Vec<PlaceCue>,
    /// Places set by gestures.
    gestures: Vec<GesturePlace>,
    /// Words, by time.
    words: Vec<TimedWord>,
    /// Turns of the speakers, in order.
    turns: Vec<Turn>,
}

impl DiscoursePlan {
    /// Lowers the speech of a script. `strokes` and `switches` are those of its gestures.
    pub(crate) fn new(
        script: &Script,
        utterances: &[UtteranceCue],
        strokes: &[Vec<GestureStroke>; 2],
        switches: &[(f64, bool)],
        cast: &Cast,
    ) -> Self {
        let utterances = spoken::utterances(script, utterances);
        let words = spoken::timed_words(&utterances);
        let [left, right] = cast.reach.shoulders_in_world;
        let shoulders = Shoulders {
            middle: (left + right) * 0.5,
            scale: cast.figure.skeleton.scale(),
        };
        let on = gestures::on_spans(switches);
        let speakers = roles::speakers(&utterances);
        let turns = roles::turns(&utterances, &speakers);
        let of_characters = roles::has_roles(&turns).then_some(&*speakers);
        Self {
            paragraphs: paragraphs(&utterances),
            tension: tension::tension(&script.document, &utterances, of_characters),
            places: places(script, &cast.units),
            gestures: pointing::gesture_places(strokes, &on, &words, &shoulders),
            words,
            turns,
        }
    }

    /// Removes everything that has not begun at a time, and ends the rest there. Places that are
    /// set stay set.
    pub(crate) fn cut(&mut self, at_secs: f64) {
        self.paragraphs.retain(|start| *start < at_secs);
        self.tension.retain(|key| key.at_secs < at_secs);
        self.places.retain(|place| place.start_secs < at_secs);
        self.gestures.retain(|place| place.start_secs < at_secs);
        self.words.retain(|word| word.start_secs < at_secs);
        self.turns.retain(|turn| turn.start_secs < at_secs);
        let gestures = self.gestures.iter_mut().map(|place| &mut place.end_secs);
        let words = self.words.iter_mut().map(|word| &mut word.end_secs);
        let turns = self.turns.iter_mut().map(|turn| &mut turn.end_secs);
        let ends = gestures.chain(words).chain(turns);
        ends.for_each(|end| *end = end.min(at_secs));
    }
}

/// Returns the discourse structure of a performance: the story and its fragments in order of
/// arrival. `carried` are places of removed fragments.
pub(crate) fn together<'p>(
    plans: impl Iterator<Item = &'p DiscoursePlan> + Clone,
    carried: &'p [PlaceCue],
) -> Discourse {
    let mut words: Vec<&TimedWord> = plans.clone().flat_map(|plan| &plan.words).collect();
    sort_by_number(&mut words, |word| word.start_secs);
    let places = carried
        .iter()
        .chain(plans.clone().flat_map(|plan| &plan.places));
    let gestures = plans.clone().flat_map(|plan| &plan.gestures);
    let mut roles = Roles::default();
    plans.clone().for_each(|plan| roles.add(&plan.turns));
    let paragraphs = plans.clone().flat_map(|plan| &plan.paragraphs).copied();
    Discourse {
        paragraphs: paragraphs.collect(),
        mentions: referents::mentions(places, gestures, &words),
        roles: roles.finish(),
        tension: plans.flat_map(|plan| &plan.tension).copied().collect(),
    }
}

/// Returns the start times of paragraphs: of each utterance, and of the paragraphs inside.
fn paragraphs(utterances: &[MarkedUtterance<'_>]) -> Vec<f64> {
    let of_utterance = |utterance: &MarkedUtterance<'_>| {
        let inside = utterance.words.iter().skip(1);
        let inside = inside.filter(|word| word.begins_paragraph);
        let starts = inside.map(|word| word.start_secs);
        std::iter::once(utterance.start_secs)
            .chain(starts)
            .collect::<Vec<f64>>()
    };
    utterances.iter().flat_map(of_utterance).collect()
}

/// Returns the places that a script sets.
fn places(script: &Script, units: &Units) -> Vec<PlaceCue> {
    let clauses = script.timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &script.document.clause(timed.clause).kind {
            ClauseKind::Place(place) => Some(PlaceCue {
                start_secs: timed.start_secs,
                name: place.name.clone(),
                words: referents::words_of(place.words.as_deref().unwrap_or_default()),
                place_in_figure: units.speaker_point([place.x, place.y, place.z]),
            }),
            _ => None,
        })
        .collect()
}

//! Discourse structure of a script's speech: paragraphs, referents with a place, direct speech and
//! tension.
//!
//! Each script is lowered on its own. Referents and characters belong to the whole performance:
//! a place set by the story also holds in the live fragments that join it, and a character keeps
//! its side. A later script changes nothing before it.

mod hushed;
mod pointing;
mod referents;
mod roles;
mod spoken;
mod tension;
#[cfg(test)]
mod tests;

use raconteur_actor::{Discourse, GestureStroke, Mention, TensionKey, TimeSpan};
use raconteur_base::order::sort_by_number;
use raconteur_eml::ClauseKind;
use raconteur_stage::{Gesture, TakenSpace};

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
    /// Intervals of hushed speech, by time.
    hushed: Vec<TimeSpan>,
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
            hushed: hushed::spans(&utterances),
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
        self.hushed.retain(|span| span.start_secs < at_secs);
        self.places.retain(|place| place.start_secs < at_secs);
        self.gestures.retain(|place| place.start_secs < at_secs);
        self.words.retain(|word| word.start_secs < at_secs);
        self.turns.retain(|turn| turn.start_secs < at_secs);
        let gestures = self.gestures.iter_mut().map(|place| &mut place.end_secs);
        let words = self.words.iter_mut().map(|word| &mut word.end_secs);
        let turns = self.turns.iter_mut().map(|turn| &mut turn.end_secs);
        let hushed = self.hushed.iter_mut().map(|span| &mut span.end_secs);
        let ends = gestures.chain(words).chain(turns).chain(hushed);
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
        hushed: plans
            .clone()
            .flat_map(|plan| &plan.hushed)
            .copied()
            .collect(),
        tension: plans.flat_map(|plan| &plan.tension).copied().collect(),
    }
}

/// Space of a hand that indicates a referent at a side: height of its top and bottom and distance
/// from the middle, shares of the stature. *Designed* for the gesture of the actor.
const INDICATED: [f64; 3] = [0.8, 0.55, 0.38];
/// Time that the gesture takes before and after a mention, seconds.
const INDICATED_SECS: [f64; 2] = [0.8, 1.2];

/// Returns the space that hands need to indicate the referents that are mentioned.
pub(crate) fn indicated_spaces(
    discourse: &Discourse,
    stature_m: f64,
) -> impl Iterator<Item = Gesture> {
    let aside = |mention: &&Mention| {
        let place = mention.place_in_figure;
        place.x.abs() > 0.3 * place.z.abs()
    };
    let mentions = discourse.mentions.iter().filter(aside);
    mentions.map(move |mention| {
        let [top_m, bottom_m, half_width_m] = INDICATED.map(|share| share * stature_m);
        Gesture {
            from_secs: mention.start_secs - INDICATED_SECS[0],
            to_secs: mention.end_secs + INDICATED_SECS[1],
            space: TakenSpace {
                top_m,
                bottom_m,
                half_width_m,
            },
        }
    })
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

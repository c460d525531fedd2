//! A guess of which tier holds what, from the names and values of the tiers.

use raconteur_eml::quoted;

use super::{Elan, Mapping, Tier};
use crate::gestura::{Dimension, GestureClass, Level, PhaseKind, Vocabulary, letters};
use crate::names::*;

/// Share of the values of a tier that must be of a list.
const TELLING_SHARE: f64 = 0.6;
/// Mean number of words up to which the annotations of a tier are single words.
const SINGLE_WORDS: f64 = 1.3;

/// Returns a mapping for a file without one, and what it assumes, for people.
#[must_use]
pub fn guess(elan: &Elan) -> (Mapping, Vec<String>) {
    let mut guess = Guess {
        elan,
        taken: vec![false; elan.tiers.len()],
        mapping: Mapping::default(),
        told: Vec::new(),
    };
    guess.layers();
    if let Some(tier) = guess.tier_of::<GestureClass>() {
        guess.take(GESTURES.into(), tier);
    }
    if let Some(tier) = guess.tier_of::<Level>() {
        guess.take(LEVELS.into(), tier);
    }
    guess.speech();
    (guess.mapping, guess.told)
}

struct Guess<'a> {
    elan: &'a Elan,
    taken: Vec<bool>,
    mapping: Mapping,
    told: Vec<String>,
}

impl Guess<'_> {
    fn take(&mut self, track: String, tier: usize) {
        self.taken[tier] = true;
        let name = &self.elan.tiers[tier].name;
        self.told
            .push(format!("{track} from the tier {}", quoted(name)));
        self.mapping.tiers.insert(track, name.clone());
    }

    /// Returns the free tiers that fulfil a condition.
    fn free(&self, is: impl Fn(&Tier) -> bool) -> Vec<usize> {
        let tiers = self.elan.tiers.iter().enumerate();
        tiers
            .filter(|(i, tier)| !self.taken[*i] && !tier.annotations.is_empty() && is(tier))
            .map(|(i, _)| i)
            .collect()
    }

    /// Returns the first tier whose values are mostly of a list.
    fn tier_of<V: Vocabulary>(&self) -> Option<usize> {
        self.free(|tier| share::<V>(tier) >= TELLING_SHARE)
            .first()
            .copied()
    }

    /// Takes a layer for each tier of phases, and the tier of phrases of the same hand.
    fn layers(&mut self) {
        let phases = self.free(|tier| share::<PhaseKind>(tier) >= TELLING_SHARE);
        let phrases = self.free(|tier| share::<Dimension>(tier) >= TELLING_SHARE);
        for (number, &tier) in phases.iter().enumerate() {
            let side = hand(&self.elan.tiers[tier].name);
            // With one tier of phases, the names of the others do not matter.
            let is_same = |name: &str| phases.len() == 1 || hand(name) == side;
            let layer = side.map_or_else(|| format!("layer{}", number + 1), str::to_owned);
            self.take(format!("{PHASES}.{layer}"), tier);
            let same = phrases.iter().copied();
            let same = same
                .filter(|&other| !self.taken[other])
                .find(|&other| is_same(&self.elan.tiers[other].name));
            if let Some(same) = same {
                self.take(format!("{PHRASES}.{layer}"), same);
            }
            for (attribute, words) in FORM {
                let named = self.free(|tier| has_word(&tier.name, words) && is_same(&tier.name));
                if let Some(&named) = named.first() {
                    self.take(format!("{PHASES}.{layer}.{attribute}"), named);
                }
            }
        }
    }

    /// Takes the tiers of words and of utterances.
    fn speech(&mut self) {
        let words = self.free(|tier| {
            words_each(tier) <= SINGLE_WORDS
                && has_word(&tier.name, &["word", "token", "wort", "palavra"])
        });
        if let Some(&tier) = words.first() {
            self.take(WORDS.into(), tier);
        }
        let names = [
            "utter", "speech", "sentence", "clause", "transcri", "text", "spch", "fala",
        ];
        let named = self.free(|tier| has_word(&tier.name, &names));
        let long = self.free(|tier| words_each(tier) > SINGLE_WORDS);
        if let Some(&tier) = named.first().or(long.first()) {
            let is_words = !self.mapping.tiers.contains_key(WORDS)
                && words_each(&self.elan.tiers[tier]) <= SINGLE_WORDS;
            self.take(if is_words { WORDS } else { UTTERANCES }.into(), tier);
        }
    }
}

/// Attributes of a phase, with parts of the names of their tiers.
const FORM: [(&str, &[&str]); 3] = [
    (HAND_SHAPES, &["shape", "forma"]),
    (PALM_ORIENTATIONS, &["palm", "orient"]),
    (MOTION, &["motion", "movement", "trajectory", "position"]),
];

/// Returns the share of the values of a tier that are of a list, aliases counted.
fn share<V: Vocabulary>(tier: &Tier) -> f64 {
    let mapping = Mapping::default();
    let is_known = |value: &str| {
        let word = mapping.word(value);
        V::from_word(&word).is_some() || (is_phase::<V>() && letters(&word) == "hold")
    };
    let known = tier
        .annotations
        .iter()
        .filter(|a| is_known(&a.value.value))
        .count();
    known as f64 / tier.annotations.len().max(1) as f64
}

/// Returns true if a list has the stroke: holds without a kind then belong to it.
fn is_phase<V: Vocabulary>() -> bool {
    V::from_word("stroke").is_some()
}

/// Returns the mean number of words of an annotation.
fn words_each(tier: &Tier) -> f64 {
    let words = tier
        .annotations
        .iter()
        .map(|a| a.value.value.split_whitespace().count());
    words.sum::<usize>() as f64 / tier.annotations.len().max(1) as f64
}

fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_lowercase();
    words.iter().any(|word| name.contains(word))
}

/// Returns the hand that a name tells.
fn hand(name: &str) -> Option<&'static str> {
    let name = name.to_lowercase();
    let mut parts = name.split(|c: char| !c.is_alphanumeric());
    parts.find_map(|part| match part {
        "rh" | "r" | "right" | "rechts" | "direita" => Some("right"),
        "lh" | "l" | "left" | "links" | "esquerda" => Some("left"),
        _ => part
            .starts_with("right")
            .then_some("right")
            .or(part.starts_with("left").then_some("left")),
    })
}

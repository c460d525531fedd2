//! Delivery of a plan by a storyteller: the length of each pause, the rate of each sentence, and
//! the style of direct speech.
//!
//! Pauses are drawn from log-normal distributions (Campione and Véronis 2002, six thousand pauses
//! of five languages), because speakers' pauses vary in length. The draws depend on the words
//! alone, so the same text always has the same delivery. Tense parts are faster and have shorter
//! pauses, as in tales near a climax and in dialogue. Direct speech has its own pitch, range and
//! rate (Doukhan et al. 2011; Klewitz and Couper-Kuhlen 1999). Medians and factors are *designed*
//! between these.

use std::collections::BTreeMap;

use raconteur_base::noise::{self, hash, signed, unit};
use raconteur_base::ops;
use raconteur_base::text::quotes::Quotes;

use crate::content::{Setting, Speaker};
use crate::plan::{Plan, Planned};
use crate::spoken::Token;
use crate::style::Style;
use raconteur_speech::bundle::SentenceKind;

/// Standard deviation of the logarithm of a pause.
const SPREAD: f64 = 0.35;
/// Minimum and maximum of default pauses, seconds.
const PAUSE_SECS: (f64, f64) = (0.2, 2.5);
/// Median pauses, seconds: after a comma, and after a semicolon, a colon or a dash.
const PHRASE_SECS: f64 = 0.24;
const CLAUSE_SECS: f64 = 0.38;
/// Factor for the pause between sentences before and after direct speech.
const TURN: f64 = 1.3;
/// Effect of sentence length on the pause: longer after a long sentence, shorter after a short one
/// (Kazlauskienė 2020). Number of words of a neutral sentence, the exponent of the ratio, and the
/// bounds.
const LENGTH: (f64, f64, f64, f64) = (11.0, 0.25, 0.85, 1.3);

/// Tension of plain narration; the next constants are added by the text.
const CALM: f64 = 0.45;
const EXCLAIMED: f64 = 0.2;
const ASKED: f64 = 0.05;
const QUOTED: f64 = 0.1;
const OPENING: f64 = -0.15;
const CLOSING: f64 = -0.12;
const TRAILING: f64 = -0.2;
/// A sentence may be so much more or less tense by chance.
const CHANCE: f64 = 0.12;
/// Effect of a unit of tension on the logarithm of the speech rate, and of pauses.
const PACE: f64 = 0.3;
const PAUSES: f64 = -0.7;

/// Effect of direct speech without its own voice on the narrator's: factors for pitch, range and
/// speech rate.
const SPEECH: (f64, f64, f64) = (1.06, 1.08, 1.03);

/// Applies the delivery to a plan. `tension` is 0 to 1 if set by the author.
pub(crate) fn deliver(plan: &mut Plan, tension: Option<f64>) {
    let quoted = quoted(plan);
    let of_sentence = |planned: &Planned| -> Vec<bool> {
        let tokens = planned.sentence.tokens.iter();
        tokens
            .map(|t| quoted.get(t.word).copied().unwrap_or(false))
            .collect()
    };
    let quotes: Vec<Vec<bool>> = plan.sentences.iter().map(of_sentence).collect();
    let count = plan.sentences.len();
    for at in 0..count {
        let opens = at == 0 || plan.sentences[at - 1].ends_paragraph;
        let closes = at + 1 == count;
        let turns = quotes.get(at + 1).is_some_and(|next| {
            next.first() != quotes[at].last()
                || next.first() == Some(&true) && speech_begins(plan, at + 1)
        });
        let planned = &mut plan.sentences[at];
        let tension = tension.unwrap_or_else(|| tension_of(planned, &quotes[at], opens, closes));
        let over = tension - CALM;
        planned.sentence.pace = ops::exp(PACE * over);
        rests(planned, ops::exp(PAUSES * over), turns);
    }
    speak_directly(plan, &quotes);
}

/// Returns true if direct speech starts with this sentence.
fn speech_begins(plan: &Plan, at: usize) -> bool {
    let first = plan.sentences[at].sentence.tokens.first();
    let word = first.and_then(|t| plan.words.get(t.word));
    word.is_some_and(|word| word.starts_with(['\u{201c}', '\u{201e}', '\u{ab}', '"']))
}

/// Returns the tension of a text.
fn tension_of(planned: &Planned, quoted: &[bool], opens: bool, closes: bool) -> f64 {
    let sentence = &planned.sentence;
    let kind = match sentence.kind {
        SentenceKind::Exclamation => EXCLAIMED,
        SentenceKind::Question => ASKED,
        _ => 0.0,
    };
    let when = |holds: bool, change: f64| if holds { change } else { 0.0 };
    let trails = sentence
        .tokens
        .last()
        .is_some_and(|t| t.punctuation.contains("..."));
    let chance = signed(seed(&sentence.tokens), 1, 0);
    let tension = CALM
        + kind
        + when(quoted.contains(&true), QUOTED)
        + when(opens, OPENING)
        + when(closes, CLOSING)
        + when(trails, TRAILING)
        + CHANCE * chance;
    tension.clamp(0.0, 1.0)
}

/// Sets the usual pauses within and after a sentence.
fn rests(planned: &mut Planned, factor: f64, turns: bool) {
    let tokens = &planned.sentence.tokens;
    let seed = seed(tokens);
    let drawn = |median_secs: f64, at: usize| {
        let secs = median_secs * factor * ops::exp(SPREAD * normal(seed, at as i64));
        secs.clamp(PAUSE_SECS.0, PAUSE_SECS.1)
    };
    planned.rests = (0..tokens.len())
        .map(|at| match tokens[at].punctuation.as_str() {
            "" => 0.0,
            marks if marks.starts_with(',') => drawn(PHRASE_SECS, at),
            _ => drawn(CLAUSE_SECS, at),
        })
        .collect();
    let authors = planned.pauses.last().copied().flatten().is_some();
    if !authors && !planned.continues {
        let (usual, power, least, most) = LENGTH;
        let long = ops::exp(power * ops::ln(tokens.len().max(1) as f64 / usual));
        let turn = if turns { TURN } else { 1.0 };
        planned.pause_secs = drawn(
            planned.pause_secs * long.clamp(least, most) * turn,
            tokens.len(),
        );
    }
}

/// Returns the random seed for the pauses of a sentence.
fn seed(tokens: &[Token]) -> u64 {
    let letters = tokens.iter().flat_map(|t| t.text.bytes());
    letters.fold(0, |seed, byte| hash(seed, u64::from(byte), 0))
}

/// Returns a nearly normal random number with standard deviation 1.
fn normal(seed: u64, at: i64) -> f64 {
    noise::normal(core::array::from_fn(|i| unit(seed, 2 + i as u64, at)))
}

/// Returns, for each word, true if it is between quotation marks.
fn quoted(plan: &Plan) -> Vec<bool> {
    let mut quotes = Quotes::default();
    plan.words.iter().map(|word| quotes.read(word)).collect()
}

/// Gives direct speech without another voice its own style.
fn speak_directly(plan: &mut Plan, quotes: &[Vec<bool>]) {
    let mut made: BTreeMap<usize, usize> = BTreeMap::new();
    let Plan {
        sentences, styles, ..
    } = plan;
    for (planned, quoted) in sentences.iter_mut().zip(quotes) {
        if planned.speaker != Speaker::default() {
            continue;
        }
        for (token, _) in planned
            .sentence
            .tokens
            .iter_mut()
            .zip(quoted)
            .filter(|(_, q)| **q)
        {
            let own = *made.entry(token.style).or_insert_with(|| {
                styles.push(spoken_by_another(&styles[token.style]));
                styles.len() - 1
            });
            token.style = own;
        }
    }
}

/// Returns a style for direct speech; the author's settings stay.
fn spoken_by_another(style: &Style) -> Style {
    let (pitch, range, pace) = SPEECH;
    let mut style = style.clone();
    for (amount, factor) in [
        (&mut style.pitch_middle, pitch),
        (&mut style.pitch_range, range),
        (&mut style.rate, pace),
    ] {
        if amount.value.is_none() {
            *amount = amount.with(Setting::Factor(factor));
        }
    }
    style
}

#[cfg(test)]
mod tests;

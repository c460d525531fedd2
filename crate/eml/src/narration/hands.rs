//! Hand gestures for a plain text.

use std::fmt::Write as _;

use raconteur_base::text::function_words::is_function_word;

use super::escaped;
use super::sentences::Sentence;

/// Minimum number of words between beats, and before the first. *Designed*.
const BETWEEN_BEATS: usize = 4;
/// Delay of words after the start of a waving hand, seconds: the hand is already moving when they
/// are spoken; starting together, the words would wait for it.
const WAVE_LATER: &str = "0.65s";

/// A hand is raised in greeting to these.
const GREETINGS: &str = "hello hi hey welcome goodbye bye greetings hallo willkommen tschüss servus \
                         olá oi tchau adeus bem-vindo bem-vindos bem-vinda bem-vindas";
/// Markup of a sentence with gesture markers, and the gestures timed by them.
pub(super) struct GesturedSentence {
    pub(super) text: String,
    pub(super) gestures: String,
}

fn has(list: &str, word: &str) -> bool {
    list.split_ascii_whitespace().any(|own| own == word)
}

/// Letters, digits, apostrophes and hyphens of a word, small.
fn bare(word: &str) -> String {
    let kept = word
        .chars()
        .filter(|c| c.is_alphanumeric() || matches!(c, '\'' | '’' | '-'));
    kept.collect::<String>().to_lowercase()
}

/// Returns the `index`th sentence with gestures: a wave at greetings, and beats on stressed and
/// long words.
pub(super) fn performed(sentence: &Sentence, index: usize) -> GesturedSentence {
    let is_first = index == 0;
    let mut since = if is_first { 0 } else { BETWEEN_BEATS };
    let (mut said, mut gestures) = (Vec::new(), String::new());
    for (i, word) in sentence.words.iter().enumerate() {
        let own = bare(&word.text);
        let mut text = escaped(&word.text);
        if word.is_stressed {
            text = format!("<emph>{text}</emph>");
        }
        since += 1;
        let greets = has(GREETINGS, &own);
        let is_heavy = own.chars().count() >= 4 && !is_function_word(&own);
        if greets || word.is_stressed && since > 1 || since >= BETWEEN_BEATS && is_heavy {
            since = 0;
            let mark = format!("g{index}w{i}");
            if greets {
                wave(&mut gestures, &mark, is_first && i < BETWEEN_BEATS);
            } else {
                beat(&mut gestures, &mark);
            }
            text = format!("<tm name='{mark}'/>{text}");
        }
        said.push(text);
    }
    GesturedSentence {
        text: said.join(" "),
        gestures,
    }
}

/// A hand's shape, its palm (angle and normal) and its path (seconds; EML's axes).
struct Motion {
    hand: &'static str,
    shape: u8,
    palm: [f64; 4],
    path: [[f64; 4]; 2],
}

/// Gesture of a wave: one open hand is raised.
const WAVE: Motion = Motion {
    hand: "right",
    shape: 7,
    palm: [120.0, 0.0, 0.0, -1.0],
    path: [[0.0, -7.0, 42.0, 3.0], [0.15, -13.0, 40.0, 3.0]],
};
/// Beat gesture: both half-open hands move down a little.
const BEAT: Motion = Motion {
    hand: "both",
    shape: 4,
    palm: [90.0, 0.6, 0.8, 0.0],
    path: [[0.0, -5.0, 14.0, -11.0], [0.2, -6.0, 11.0, -13.0]],
};

fn wave(out: &mut String, mark: &str, is_first: bool) {
    let time = match is_first {
        true => format!("{mark}+{WAVE_LATER}"),
        false => format!("{mark}-0.1s"),
    };
    gesture(out, &time, &WAVE);
}

fn beat(out: &mut String, mark: &str) {
    gesture(out, &format!("{mark}-0.1s"), &BEAT);
}

fn gesture(out: &mut String, time: &str, motion: &Motion) {
    let Motion {
        hand,
        shape,
        palm: [a, x, y, z],
        path,
    } = motion;
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "<gesture-key time='{time}' duration='0.5' handedness='{hand}'><hand-shapes><key time='0' \
         id='{shape}'/></hand-shapes><palms><key time='0' a='{a}' x='{x}' y='{y}' \
         z='{z}'/></palms><motion coords='speaker'>"
    );
    for [secs, x, y, z] in path {
        let _ = write!(out, "<key time='{secs}' x='{x}' y='{y}' z='{z}'/>");
    }
    out.push_str("</motion></gesture-key>");
}

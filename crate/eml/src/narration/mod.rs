//! Conversion of plain text to a script: consecutive sentences, gestures from greetings, capitals
//! and long words, emotions from emoticons.
//!
//! Scope: the script of a typed or displayed text, that of a clause of a streamed text, and the
//! split points of such a text.
//! Out of scope: pronunciation; words and sentences are those of [`raconteur_base::text`], as
//! everywhere.

mod hands;
mod sentences;
mod split;

use std::fmt::Write as _;

pub use split::{ClauseSplit, split_clauses};

use sentences::{Sentence, phrases, sentences};

/// Potential of an emoticon's emotion, of 10. *Designed*.
const POTENTIAL: f64 = 4.0;
/// Start time of the first word, seconds. It is short because the author of typed text waits for
/// it.
const BEGINS: &str = "0.15";
/// Silence between two sentences, and between two phrases of one, seconds.
const SENTENCE_GAP: &str = "0.35s";
const PHRASE_GAP: &str = "0.05s";

/// Options for converting plain text to a script: language, division into phrases and length limit.
#[derive(Clone, Copy, Debug)]
pub struct NarrationOptions<'a> {
    /// The text's, a tag of BCP 47.
    pub language: &'a str,
    /// True to speak sentences phrase by phrase, for a slow voice: playback starts after the first
    /// phrase.
    pub is_phrased: bool,
    /// Maximum length of the narrated text, in characters.
    pub max_chars: usize,
}

/// EML fragment for a part of a text, and the emotion at its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NarratedFragment {
    /// Clauses of EML in a script of their own.
    pub fragment: String,
    /// A word of emotion.
    pub emotion: String,
}

/// Returns the script that narrates a text, in its canonical form; `None` if it has no word.
#[must_use]
pub fn narrate(text: &str, telling: &NarrationOptions<'_>) -> Option<String> {
    let head: String = text.chars().take(telling.max_chars).collect();
    let mut all = sentences(&head, telling.language);
    if telling.is_phrased {
        all = all.iter().flat_map(phrases).collect();
    }
    let (clauses, _) = clauses_of(&all, BEGINS, "neutral")?;
    let language = escaped(telling.language);
    let head = format!("<head><r:performer language='{language}'/></head>");
    let parsed = crate::parse(&script(&head, &clauses));
    Some(crate::write(&parsed.document))
}

/// Returns the fragment that continues the narration after a text that ended with the emotion
/// `felt`; `None` if it has no word.
#[must_use]
pub fn continue_narration(text: &str, language: &str, felt: &str) -> Option<NarratedFragment> {
    let all = sentences(text, language);
    let (clauses, feels) = clauses_of(&all, "0", felt)?;
    Some(NarratedFragment {
        fragment: script("", &clauses),
        emotion: feels,
    })
}

fn script(head: &str, clauses: &str) -> String {
    format!(
        "<eml xmlns:r='urn:raconteur:eml:1' name='said' r:lead='delay'>{head}<body>{clauses}</body></eml>\n"
    )
}

/// Escapes a text for markup. Characters not allowed in XML become spaces.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' | '<' | '>' | '"' | '\'' => {
                // Writing to a string cannot fail.
                let _ = write!(out, "&#{};", u32::from(c));
            }
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Returns the clauses that narrate sentences, the first at `begins`, after the emotion `felt`; and
/// the final emotion. `None` without a sentence.
fn clauses_of(all: &[Sentence], begins: &str, felt: &str) -> Option<(String, String)> {
    let last = all.len().checked_sub(1)?;
    let mut out = "<gesture-is-on time='0' isOn='true'/>".to_owned();
    let (mut before, mut feels) = (begins.to_owned(), felt.to_owned());
    for (i, sentence) in all.iter().enumerate() {
        let emotion = sentence.emotion.unwrap_or("neutral");
        if emotion != feels {
            out += &format!("<r:emotion time='{before}' type='{emotion}'");
            if emotion != "neutral" {
                out += &format!(" potential='{POTENTIAL}'");
            }
            out += "/>";
            emotion.clone_into(&mut feels);
        }
        let performed = hands::performed(sentence, i);
        out += &format!(
            "<voice-text time='{before}' timeId='v{i}'><div type='sentence'>{}</div><tm \
             name='e{i}'/></voice-text>",
            performed.text
        );
        out += &performed.gestures;
        let gap = if sentence.continues {
            PHRASE_GAP
        } else {
            SENTENCE_GAP
        };
        before = format!("e{i}+{gap}");
    }
    out += &format!("<null time='e{last}+1.2s'/>");
    Some((out, feels))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn script_of(text: &str) -> String {
        let telling = NarrationOptions {
            language: "en",
            is_phrased: false,
            max_chars: 600,
        };
        let script = narrate(text, &telling).unwrap_or_default();
        let parsed = crate::parse(&script);
        assert!(
            parsed.diagnostics.is_empty(),
            "{text}: {:?}",
            parsed.diagnostics
        );
        script
    }

    fn count(script: &str, what: &str) -> usize {
        script.matches(what).count()
    }

    #[test]
    fn sentences_follow_each_other_and_a_greeting_is_waved() {
        let script = script_of("Hello there! Shall I tell you a secret?");
        assert_eq!(count(&script, "<voice-text"), 2);
        assert_eq!(count(&script, "e0+0.35'"), 1, "{script}");
        assert!(script.contains("g0w0"), "{script}");
        assert!(script.contains("handedness='right'"), "{script}");
        assert!(
            script.contains("e1+1.2'"),
            "the script contains the time after the second sentence"
        );
    }

    #[test]
    fn emoticons_are_felt_and_not_said_each_for_its_sentence() {
        let script = script_of("You came! :) I waited all day. :( Well… So <3");
        assert!(
            !script.contains(":)") && !script.contains(":(") && !script.contains("&lt;3"),
            "the script contains no emoticons"
        );
        let felt: Vec<&str> = script
            .split("<r:emotion")
            .skip(1)
            .filter_map(|tag| tag.split("type='").nth(1)?.split('\'').next())
            .collect();
        assert_eq!(felt, ["joy", "distress", "neutral", "love"]);
    }

    #[test]
    fn capitals_are_stressed_where_they_are_words_and_nothing_is_lowered() {
        let script = script_of("It was SO dark when NASA and the US met at the WHO.");
        assert_eq!(count(&script, "<emph"), 1, "{script}");
        assert!(script.contains(">SO</emph>"), "{script}");
        for kept in ["NASA", "US", "WHO."] {
            assert!(script.contains(kept), "{script}");
        }
    }

    #[test]
    fn abbreviations_and_signs_stay_in_their_sentence() {
        let script = script_of("Dr. Lee pays 5 % more in the U.S. today. 2 + 2 = 4.");
        assert_eq!(count(&script, "<voice-text"), 2, "{script}");
        assert!(
            script.contains("5 %") && script.contains("2 + 2 = 4."),
            "{script}"
        );
    }

    #[test]
    fn what_has_no_word_tells_nothing_and_markup_stays_text() {
        for text in ["", "   ", "!!!", ":)", "…\n\n", "🙂"] {
            assert_eq!(continue_narration(text, "en", "neutral"), None, "{text}");
        }
        let long = "word ".repeat(5000);
        let text = format!(
            "<voice-say content=\"x\"/> & \"quotes\" ]]> &amp; \u{202e}abc \u{1} 🙂🙂 ﷽ {long}"
        );
        let script = script_of(&text);
        assert!(
            !script.contains("<voice-say") && !script.contains('🙂'),
            "the markup is escaped and emoji are removed"
        );
        assert!(script.len() < 40 * 600, "{}", script.len());
    }

    #[test]
    fn long_sentences_are_parted_into_phrases_for_slow_voices() {
        let text = "After they had eaten, the old man told them a tale that nobody knew any more, and slept.";
        let telling = NarrationOptions {
            language: "en",
            is_phrased: true,
            max_chars: 600,
        };
        let script = narrate(text, &telling).expect("words");
        assert_eq!(count(&script, "<voice-text"), 3, "{script}");
        assert_eq!(count(&script, "+0.05'"), 2);
    }
}

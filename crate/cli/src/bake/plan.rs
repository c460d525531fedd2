//! From content to sentences: what the engine is asked to say in one breath, and the
//! silences between.

use anyhow::{Result, ensure};
use raconteur_player::speech::{Content, Segment};

/// Silence between two sentences where the author asks for none in particular, seconds.
/// *Designed*: read stories pause about half a second between sentences.
pub(crate) const SENTENCE_PAUSE_SECS: f64 = 0.45;

/// The longest silence that an utterance may ask for, seconds. Longer ones belong between
/// clauses, where they cost no sound.
const LONGEST_SILENCE_SECS: f64 = 60.0;

/// Festival's reader is not made for endless words; pieces of this many characters are
/// far beyond any real one.
const LONGEST_TOKEN: usize = 40;

/// The engine's work grows faster than the sentence; a text without full stops is parted
/// after this many tokens.
const LONGEST_SENTENCE: usize = 100;

/// What the engine hears as punctuation, and how much of it after one token is enough.
const PUNCTUATION: &str = ",.;:!?";
const LONGEST_PUNCTUATION: usize = 3;

/// Words after which a full stop does not end a sentence.
const ABBREVIATIONS: [&str; 9] = ["mr", "mrs", "ms", "dr", "st", "prof", "vs", "no", "etc"];

/// What the engine reads as one token.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Token {
    /// Index of the word that it belongs to ([`Content::words`]).
    pub(crate) word: usize,
    /// Visible ASCII without quotes and backslashes.
    pub(crate) text: String,
    /// Punctuation after it, ASCII; may be empty.
    pub(crate) punctuation: String,
    /// Emphasis: 0 reduced … 1 none … 2 strong.
    pub(crate) emphasis: f64,
    /// Length of the silence after it, where the author asks for one, seconds.
    pub(crate) pause_secs: Option<f64>,
}

/// Spoken in one go.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sentence {
    /// Its tokens, at least one.
    pub(crate) tokens: Vec<Token>,
}

impl Sentence {
    /// Silence between this sentence and the next, seconds.
    pub(crate) fn pause_secs(&self) -> f64 {
        self.tokens
            .last()
            .and_then(|t| t.pause_secs)
            .unwrap_or(SENTENCE_PAUSE_SECS)
    }
}

/// An utterance, ready for the engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Plan {
    /// Silence that the author asks for before the first word, seconds.
    pub(crate) lead_pause_secs: f64,
    /// In order.
    pub(crate) sentences: Vec<Sentence>,
    /// The words as written, in order.
    pub(crate) words: Vec<String>,
}

/// Splits content into sentences: at boundaries, and after `.`, `!` or `?` when the next
/// word does not begin small. A break inside a sentence does not split it, so that the
/// melody goes on across it.
///
/// # Errors
/// When the silences add up to more than a minute.
pub(crate) fn plan(content: &Content) -> Result<Plan> {
    let mut plan = Plan::default();
    let mut open = Sentence::default();
    let mut silence_secs = 0.0;
    for segment in &content.segments {
        match segment {
            Segment::Break { msec } => {
                let secs = f64::from(*msec) / 1000.0;
                silence_secs += secs;
                let last = match open.tokens.last_mut() {
                    Some(token) => Some(token),
                    None => plan.sentences.last_mut().and_then(|s| s.tokens.last_mut()),
                };
                match last {
                    Some(token) => {
                        token.pause_secs = Some(token.pause_secs.unwrap_or(0.0) + secs);
                    }
                    None => plan.lead_pause_secs += secs,
                }
            }
            Segment::Boundary => plan.close(&mut open),
            Segment::Text { text, emphasis } => {
                for written in text.split_whitespace() {
                    plan.word(&mut open, written, *emphasis);
                }
            }
        }
    }
    plan.close(&mut open);
    ensure!(
        silence_secs <= LONGEST_SILENCE_SECS,
        "its breaks add up to {silence_secs} s; an utterance may hold {LONGEST_SILENCE_SECS} s of them"
    );
    Ok(plan)
}

impl Plan {
    fn close(&mut self, open: &mut Sentence) {
        if !open.tokens.is_empty() {
            self.sentences.push(core::mem::take(open));
        }
    }

    /// Adds one white-space separated piece of text.
    fn word(&mut self, open: &mut Sentence, written: &str, emphasis: f64) {
        if !written.chars().any(char::is_alphanumeric) {
            // Punctuation on its own, as after the end of an emphasised word, belongs to
            // the word before; a dash parts it from the next.
            if let Some(last) = open.tokens.last_mut() {
                let ascii = ascii(written);
                last.punctuation
                    .extend(ascii.chars().filter(|c| PUNCTUATION.contains(*c)));
                if last.punctuation.is_empty() && ascii.contains('-') {
                    last.punctuation.push(',');
                }
                last.punctuation.truncate(LONGEST_PUNCTUATION);
            }
            return;
        }
        let begins_small = written
            .chars()
            .find(|c| c.is_alphanumeric())
            .is_some_and(char::is_lowercase);
        let ended = open.tokens.last().is_some_and(ends_sentence) && !begins_small;
        if ended || open.tokens.len() >= LONGEST_SENTENCE {
            self.close(open);
        }
        let word = self.words.len();
        self.words.push(written.to_owned());
        for (text, punctuation) in pieces(written) {
            open.tokens.push(Token {
                word,
                text,
                punctuation,
                emphasis,
                pause_secs: None,
            });
        }
    }
}

fn ends_sentence(token: &Token) -> bool {
    let stop_only = token.punctuation.contains('.') && !token.punctuation.contains(['!', '?']);
    let lower = token.text.to_ascii_lowercase();
    let abbreviated = stop_only && ABBREVIATIONS.contains(&lower.as_str());
    token.punctuation.contains(['.', '!', '?']) && !abbreviated
}

/// The tokens of one written word with the punctuation after each: split at dashes and
/// slashes, quotes and brackets taken off, letters folded to ASCII.
fn pieces(written: &str) -> Vec<(String, String)> {
    let ascii = ascii(written);
    let parts: Vec<&str> = ascii
        .split(['/', '|'])
        .flat_map(|s| s.split("--"))
        .filter(|s| s.bytes().any(|b| b.is_ascii_alphanumeric()))
        .collect();
    let mut out = Vec::new();
    for (i, part) in parts.iter().enumerate() {
        let body =
            part.trim_matches(|c: char| !(c.is_ascii_alphanumeric() || "$%#&+'".contains(c)));
        let body = body.trim_matches('\'');
        let after = &part[part.rfind(body).unwrap_or(0) + body.len()..];
        let mut punctuation: String = after.chars().filter(|c| PUNCTUATION.contains(*c)).collect();
        if punctuation.is_empty() && i + 1 < parts.len() {
            punctuation.push(',');
        }
        punctuation.truncate(LONGEST_PUNCTUATION);
        let letters: Vec<char> = body.chars().collect();
        let chunks: Vec<String> = letters
            .chunks(LONGEST_TOKEN)
            .map(|c| c.iter().collect())
            .collect();
        let last = chunks.len().saturating_sub(1);
        for (k, chunk) in chunks.into_iter().enumerate() {
            out.push((
                chunk,
                if k == last {
                    punctuation.clone()
                } else {
                    String::new()
                },
            ));
        }
    }
    out
}

/// Visible ASCII without double quotes and backslashes: letters lose their accents,
/// typographic punctuation becomes plain, other signs vanish.
fn ascii(written: &str) -> String {
    let mut out = String::new();
    for c in written.chars() {
        match c {
            '"' | '\\' => {}
            '\u{2019}' | '\u{2018}' => out.push('\''),
            '\u{2013}' | '\u{2014}' => out.push_str("--"),
            '\u{2026}' => out.push_str("..."),
            c if c.is_ascii_graphic() => out.push(c),
            c if c.is_alphanumeric() => {
                let folded = deunicode::deunicode_char(c).unwrap_or("");
                out.extend(folded.chars().filter(char::is_ascii_alphanumeric));
            }
            _ => {}
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(t: &str) -> Segment {
        Segment::Text {
            text: t.to_owned(),
            emphasis: 1.0,
        }
    }

    fn show(plan: &Plan) -> Vec<String> {
        let token = |t: &Token| match t.pause_secs {
            Some(s) => format!("{}:{}{} <{s}>", t.word, t.text, t.punctuation),
            None => format!("{}:{}{}", t.word, t.text, t.punctuation),
        };
        plan.sentences
            .iter()
            .map(|s| s.tokens.iter().map(token).collect::<Vec<_>>().join(" "))
            .collect()
    }

    fn planned(segments: Vec<Segment>) -> Plan {
        plan(&Content { segments }).unwrap()
    }

    #[test]
    fn sentences_end_where_a_listener_hears_an_end() {
        let cases: [(&str, &[&str]); 7] = [
            ("Hello world!", &["0:Hello 1:world!"]),
            ("He ran. She sat.", &["0:He 1:ran.", "2:She 3:sat."]),
            (
                "\u{201c}Stop!\u{201d} said the goat.",
                &["0:Stop! 1:said 2:the 3:goat."],
            ),
            ("Mr. Ox came.", &["0:Mr. 1:Ox 2:came."]),
            (
                "Wait\u{2014}what? 3 of us",
                &["0:Wait, 0:what?", "1:3 2:of 3:us"],
            ),
            (
                "so \u{2013} it's a well-known caf\u{e9}\u{2026}",
                &["0:so, 1:it's 2:a 3:well-known 4:cafe..."],
            ),
            ("...", &[]),
        ];
        for (input, expected) in cases {
            assert_eq!(show(&planned(vec![text(input)])), expected, "{input}");
        }
    }

    #[test]
    fn breaks_belong_to_the_word_before_and_add_up() {
        let b = |msec| Segment::Break { msec };
        let p = planned(vec![
            b(250),
            text("One"),
            b(100),
            b(200),
            text("two."),
            b(600),
            text("Three"),
        ]);
        assert_eq!(p.lead_pause_secs, 0.25);
        assert_eq!(
            show(&p),
            ["0:One <0.30000000000000004> 1:two. <0.6>", "2:Three"]
        );
        assert_eq!(p.sentences[0].pause_secs(), 0.6);
        assert_eq!(p.sentences[1].pause_secs(), SENTENCE_PAUSE_SECS);
        let p = planned(vec![text("One"), Segment::Boundary, b(0), text("two")]);
        assert_eq!(show(&p), ["0:One <0>", "1:two"]);
    }

    #[test]
    fn punctuation_after_emphasis_belongs_to_the_word_before() {
        let ant = Segment::Text {
            text: "ant".to_owned(),
            emphasis: 1.5,
        };
        let p = planned(vec![
            text("an"),
            ant.clone(),
            text(".\u{201d} He ran, an"),
            ant,
            text("\u{2013} so"),
        ]);
        assert_eq!(show(&p), ["0:an 1:ant.", "2:He 3:ran, 4:an 5:ant, 6:so"]);
    }

    #[test]
    fn the_words_are_those_of_the_content() {
        let segments = vec![
            text(
                "\u{201c}Ja,\u{201d} \u{2014} na\u{ef}ve  R&B, 100% \u{1f600} \u{4f60}\u{597d} x/y",
            ),
            text("(\\\"end\\\")"),
        ];
        let content = Content { segments };
        assert_eq!(plan(&content).unwrap().words, content.words());
    }

    #[test]
    fn tokens_hold_nothing_that_could_leave_a_string() {
        let nasty = "a\"b\\c \"(system\u{a0}\"rm\") `x` $(y) \u{0}z\u{7} caf\u{e9}\")";
        for s in planned(vec![
            text(nasty),
            text(&"\"\\".repeat(50)),
            text(&"x".repeat(500)),
        ])
        .sentences
        {
            for t in s.tokens {
                let fine = |c: char| c.is_ascii_graphic() && c != '"' && c != '\\';
                assert!(
                    t.text.chars().all(fine) && t.text.len() <= LONGEST_TOKEN,
                    "{:?}",
                    t.text
                );
                assert!(
                    t.punctuation.chars().all(|c| ",.;:!?".contains(c)) && t.punctuation.len() <= 3
                );
            }
        }
    }

    #[test]
    fn a_text_without_full_stops_is_parted() {
        let p = planned(vec![text(&"and ".repeat(1000))]);
        assert!(p.sentences.len() == 10 && p.words.len() == 1000);
    }

    #[test]
    fn an_hour_of_silence_is_refused() {
        let content = Content {
            segments: vec![text("Hm"), Segment::Break { msec: 3_600_000 }],
        };
        assert!(plan(&content).is_err());
    }
}

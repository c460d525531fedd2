//! Conversion of content to sentences: the text of one engine request with its speaker and
//! language, and the silences in between.

mod settle;

use crate::content::{Boundary, Content, Division, Speaker};
use crate::language;
use crate::resolve::{Item, resolve};
use crate::spoken::{Sentence, Token};
use crate::style::Style;
use crate::text::{Lexicon, SayAs, speakable};
use raconteur_base::text::language::Language;
use raconteur_base::text::script::Script;
use raconteur_base::text::word::Word;
use raconteur_base::text::{sentence, signs};
use raconteur_speech::bundle::SentenceKind;

/// Default silence between two sentences, seconds. *Designed*: read stories pause for 0.5 to 0.9 s
/// between sentences.
pub const SENTENCE_PAUSE_SECS: f64 = 0.6;

/// Silence between two paragraphs, seconds. *Designed*: 1 to 1.6 s.
pub const PARAGRAPH_PAUSE_SECS: f64 = 1.15;

/// Silence where only the speaker or the language changes. *Designed*.
const CHANGE_PAUSE_SECS: f64 = 0.22;

/// Maximum silence in an utterance, seconds. Longer ones belong between clauses, where they need no
/// audio.
const MAX_SILENCE_SECS: f64 = 60.0;

/// Maximum number of tokens in a sentence: an engine's work grows faster than the sentence. Text
/// without full stops is split after this number.
const MAX_SENTENCE_TOKENS: usize = 100;

/// The most tokens of an utterance: some hours of speech.
const MAX_TOKENS: usize = 100_000;

/// Utterance prepared for speech engines: sentences, words, pauses and recordings.
///
/// # Examples
///
/// ```
/// use raconteur_voice::markup::plain;
/// use raconteur_voice::plan::plan;
/// use raconteur_voice::text::Lexicon;
///
/// let content = plain::read("It is 3 o'clock. Good night!");
/// let plan = plan(&content, "en", "flite", &Lexicon::default()).expect("a short text");
/// assert_eq!(plan.sentences.len(), 2);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Silence before the first word requested by the author, seconds.
    pub lead_pause_secs: f64,
    /// Sentences in the order of speech.
    pub sentences: Vec<Planned>,
    /// The words as written, in order, each with the signs on their own that belong to it.
    pub words: Vec<String>,
    /// The styles that tokens refer to.
    pub styles: Vec<Style>,
    /// Recordings, by the word that follows them.
    pub sounds: Vec<Sound>,
    /// Emoticons as emotion words, by the word that follows them.
    pub emoticons: Vec<(usize, &'static str)>,
}

/// Sentence with additional data for the baker, the program that synthesises speech ahead of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planned {
    /// Sentence to pass to the engine.
    pub sentence: Sentence,
    /// Silence after each token, if requested by the author, seconds.
    pub pauses: Vec<Option<f64>>,
    /// Usual length of a pause after each token, seconds; 0 or missing: as made by the engine.
    pub rests: Vec<f64>,
    /// Speaker that the markup requests.
    pub speaker: Speaker,
    /// Silence after it, seconds.
    pub pause_secs: f64,
    /// A paragraph ends with it.
    pub ends_paragraph: bool,
    /// True if the same sentence continues with the next: only the voice changes.
    pub continues: bool,
}

/// Recording that an utterance requests between or under its words.
#[derive(Clone, Debug, PartialEq)]
pub struct Sound {
    /// Index of the word that follows it.
    pub word: usize,
    /// Path or URL as written by the author.
    pub src: String,
    /// True if the recording plays under the speech.
    pub background: bool,
    /// Amplitude factor; 1 plays the recording unchanged.
    pub level: f64,
}

/// Error returned when an utterance cannot be prepared for engines.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The utterance requests too much silence.
    #[error("its breaks add up to {0:.1} s; an utterance may hold 60 s of them")]
    TooMuchSilence(f64),
    /// Utterance with more than 100,000 tokens.
    #[error("it has more than 100000 tokens; part it into several utterances")]
    TooLong,
}

/// Splits content into sentences: at divisions, and after `.`, `!` or `?` if the next word does not
/// start with a lower-case letter. A break inside a sentence does not split it, so the intonation
/// continues across it, unless it requests final intonation. `language` is the voice's, as a BCP 47
/// tag; `engine` the name of the engine that will speak.
///
/// # Errors
/// Returns an error if the silences add up to more than a minute, or the content is too long.
pub fn plan(
    content: &Content,
    language: &str,
    engine: &str,
    lexicon: &Lexicon,
) -> Result<Plan, PlanError> {
    let resolved = resolve(content, engine);
    let mut planner = Planner {
        plan: Plan {
            styles: resolved.styles,
            ..Plan::default()
        },
        open: Planned::default(),
        waiting: Vec::new(),
        signs: Vec::new(),
        is_over: false,
        script: None,
        language,
        lexicon,
        silence_secs: 0.0,
        tokens: 0,
    };
    for item in &resolved.items {
        planner.item(item);
    }
    planner.separate();
    // Signs after the last pause are shown with the preceding word.
    if let Some(word) = planner.plan.words.last_mut() {
        let left = core::mem::take(&mut planner.signs);
        left.iter().for_each(|sign| signs::attach(word, sign));
    }
    planner.close(SENTENCE_PAUSE_SECS);
    if planner.silence_secs > MAX_SILENCE_SECS {
        return Err(PlanError::TooMuchSilence(planner.silence_secs));
    }
    if planner.tokens > MAX_TOKENS {
        return Err(PlanError::TooLong);
    }
    Ok(planner.plan)
}

/// Written word, or isolated signs, not yet converted to tokens.
struct Waiting {
    /// Word to which the tokens belong.
    word: usize,
    is_sign: bool,
    text: String,
    /// Signs that are not read with it: the mark behind a word that is spelled.
    after: String,
    style: usize,
    together: Option<usize>,
}

struct Planner<'a> {
    plan: Plan,
    open: Planned,
    /// Words read together, because nothing separates them.
    waiting: Vec<Waiting>,
    /// Signs on their own since the last word.
    signs: Vec<String>,
    /// The open sentence ends before the next word.
    is_over: bool,
    /// Script of the pending words if it differs from the script of the voice's language.
    script: Option<Script>,
    language: &'a str,
    lexicon: &'a Lexicon,
    silence_secs: f64,
    tokens: usize,
}

impl Planner<'_> {
    fn item(&mut self, item: &Item) {
        match item {
            Item::Word {
                text,
                style,
                together,
                behind,
            } => {
                self.settle_signs(Some((text, *style, *together)));
                // Spelled text contains its own signs, and no others.
                let is_spelled = self.plan.styles[*style].say_as == Some(SayAs::Literal);
                let behind = if is_spelled { *behind } else { 0 };
                let (read, after) = text.split_at(text.len() - behind);
                self.waiting.push(Waiting {
                    word: self.plan.words.len() - 1,
                    is_sign: false,
                    text: read.to_owned(),
                    after: after.to_owned(),
                    style: *style,
                    together: *together,
                });
            }
            Item::Punctuation(signs) => self.signs.push(signs.clone()),
            Item::Emoticon(word) => self.plan.emoticons.push((self.plan.words.len(), word)),
            Item::Break { msec, boundary } => {
                self.separate();
                self.pause(f64::from(*msec) / 1000.0, *boundary);
            }
            Item::Division(division) => {
                self.separate();
                self.close(match division {
                    Division::Sentence => SENTENCE_PAUSE_SECS,
                    Division::Paragraph => PARAGRAPH_PAUSE_SECS,
                });
            }
            Item::Audio {
                src,
                background,
                level,
            } => {
                self.separate();
                self.plan.sounds.push(Sound {
                    word: self.plan.words.len(),
                    src: src.clone(),
                    background: *background,
                    level: *level,
                });
            }
            Item::Mark(_) => {}
        }
    }

    /// Ends the current run of words.
    fn separate(&mut self) {
        if !self.waiting.is_empty() {
            self.settle_signs(None);
        }
        self.flush_pending();
    }

    /// Returns true if words of two styles may be read as one text.
    fn alike(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.plan.styles[a], &self.plan.styles[b]);
        a.language == b.language && a.say_as == b.say_as && a.speaker == b.speaker
    }

    fn last_planned(&mut self) -> Option<&mut Planned> {
        if self.open.sentence.tokens.is_empty() {
            self.plan.sentences.last_mut()
        } else {
            Some(&mut self.open)
        }
    }

    fn pause(&mut self, secs: f64, boundary: Option<Boundary>) {
        self.silence_secs += secs;
        let Some(last) = self.last_planned() else {
            self.plan.lead_pause_secs += secs;
            return;
        };
        if let (Some(token), Some(pause)) =
            (last.sentence.tokens.last_mut(), last.pauses.last_mut())
        {
            *pause = Some(pause.unwrap_or(0.0) + secs);
            token.pause = *pause > Some(0.0);
            if let Some(boundary) = boundary {
                token.punctuation = match boundary {
                    Boundary::Question => "?",
                    Boundary::Exclamation => "!",
                    Boundary::Statement => ".",
                    Boundary::Comma => ",",
                }
                .to_owned();
            }
        }
        if matches!(
            boundary,
            Some(Boundary::Question | Boundary::Exclamation | Boundary::Statement)
        ) {
            self.close(SENTENCE_PAUSE_SECS);
        }
    }

    /// Ends the open sentence; a longer silence wins when several ends fall together.
    fn close(&mut self, pause_secs: f64) {
        let ends_paragraph = pause_secs >= PARAGRAPH_PAUSE_SECS;
        if self.open.sentence.tokens.is_empty() {
            if let Some(last) = self.plan.sentences.last_mut()
                && last.pauses.last().is_some_and(Option::is_none)
            {
                last.pause_secs = last.pause_secs.max(pause_secs);
                last.ends_paragraph |= ends_paragraph;
                last.continues = false;
            }
            return;
        }
        self.is_over = false;
        let mut done = core::mem::take(&mut self.open);
        let last = done.sentence.tokens.last();
        let signs = last.map_or("", |t| t.punctuation.as_str());
        done.sentence.kind = if signs.contains('?') {
            SentenceKind::Question
        } else if signs.contains('!') {
            SentenceKind::Exclamation
        } else if signs.contains([',', ';', ':']) {
            SentenceKind::Continuation
        } else {
            SentenceKind::Statement
        };
        done.ends_paragraph = ends_paragraph;
        done.pause_secs = done.pauses.last().copied().flatten().unwrap_or(pause_secs);
        self.plan.sentences.push(done);
    }

    /// Turns the waiting words into tokens.
    fn flush_pending(&mut self) {
        let waiting = core::mem::take(&mut self.waiting);
        let Some(first) = waiting.first() else {
            return;
        };
        let style = self.plan.styles[first.style].clone();
        let language = match &style.language {
            Some(name) => language::tag(name).unwrap_or_else(|| self.language.to_owned()),
            None => match self.script {
                Some(script) => script.language().to_owned(),
                None => self.language.to_owned(),
            },
        };
        let read =
            |words: &[&str]| speakable(words, &language, style.say_as.as_ref(), self.lexicon);
        let written: Vec<&str> = waiting.iter().map(|w| w.text.as_str()).collect();
        let replaced = first.together.is_some() && (style.instead.is_some() || style.ipa.is_some());
        let mut tokens = match &style.instead {
            Some(instead) if replaced => {
                let words: Vec<&str> = instead.split_whitespace().collect();
                let spoken = read(&words);
                if words.len() == written.len() {
                    spoken
                } else {
                    // The first word owns all of it, so that captions light up in time.
                    let mut all = vec![Vec::new(); written.len()];
                    all[0] = spoken.into_iter().flatten().collect();
                    all
                }
            }
            _ => read(&written),
        };
        if replaced {
            if let Some(ipa) = &style.ipa {
                // One pronunciation for everything inside.
                let one = tokens.iter_mut().flatten().next();
                if let Some(mut one) = one.cloned() {
                    one.ipa = Some(ipa.clone());
                    tokens = vec![Vec::new(); written.len()];
                    tokens[0].push(one);
                }
            }
            // Signs after the words stay there.
            let last = written.last().map_or("", |w| *w);
            let signs = &last[last.trim_end_matches([',', '.', ';', ':', '!', '?']).len()..];
            if let Some(token) = tokens.iter_mut().flatten().next_back()
                && token.punctuation.is_empty()
            {
                token.punctuation = signs.chars().take(3).collect();
            }
        }
        for (word, tokens) in waiting.iter().zip(&mut tokens) {
            let signs = word.after.chars().filter(|c| ",.;:!?".contains(*c));
            if let Some(token) = tokens.last_mut().filter(|t| t.punctuation.is_empty()) {
                token.punctuation = signs.take(3).collect();
            }
        }
        let ends = self.sentence_ends(&waiting, &language);
        for ((word, tokens), ends) in waiting.iter().zip(tokens).zip(ends) {
            if !word.is_sign || !tokens.is_empty() {
                self.begin_word(word, &style.speaker, &language);
            }
            self.is_over |= ends;
            for token in tokens {
                self.tokens += 1;
                if self.tokens > MAX_TOKENS {
                    return;
                }
                self.open.sentence.tokens.push(Token {
                    word: word.word,
                    text: token.text,
                    ipa: token.ipa,
                    punctuation: token.punctuation,
                    emphasis: self.plan.styles[word.style].emphasis,
                    pause: false,
                    style: word.style,
                });
                self.open.pauses.push(None);
            }
        }
    }

    /// Returns, for each of some words, true if a sentence ends after it.
    fn sentence_ends(&self, waiting: &[Waiting], language: &str) -> Vec<bool> {
        let whole: Vec<String> = waiting
            .iter()
            .map(|w| [w.text.as_str(), &w.after].concat())
            .collect();
        let words: Vec<Word<'_>> = whole.iter().map(|word| Word::parse(word)).collect();
        let language = Language::from_tag(language);
        (0..words.len())
            .map(|at| sentence::ends_after(&words, at, language))
            .collect()
    }

    /// Ends the sentence before a word that starts another, or that has another speaker.
    fn begin_word(&mut self, word: &Waiting, speaker: &Speaker, language: &str) {
        let begins_small = word
            .text
            .chars()
            .find(|c| c.is_alphanumeric())
            .is_some_and(char::is_lowercase);
        if (self.is_over && !begins_small) || self.open.sentence.tokens.len() >= MAX_SENTENCE_TOKENS
        {
            self.close(SENTENCE_PAUSE_SECS);
        }
        self.is_over = false;
        let same = self.open.speaker == *speaker && self.open.sentence.language == language;
        if !self.open.sentence.tokens.is_empty() && !same {
            self.close(CHANGE_PAUSE_SECS);
            if let Some(last) = self.plan.sentences.last_mut() {
                last.continues = true;
            }
        }
        if self.open.sentence.tokens.is_empty() {
            self.open.speaker = speaker.clone();
            self.open.sentence.language = language.to_owned();
        }
    }
}

#[cfg(test)]
mod tests;

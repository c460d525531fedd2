//! Speech features for planners: phone boundaries, pauses, accents, pitch contour, turns and
//! questions on the story clock.

use raconteur_base::order::sort_by_number;
use raconteur_speech::bundle::SentenceKind;
use raconteur_speech::phones::Class;
use raconteur_speech::{TimedUtterance, Utterance};

use super::extreme::Extreme;
use super::{MAX_TIME_SECS, Manner, PlanBasis, accent, pitch, text};

/// Silence at least this long is a pause, seconds. Designed: closures of stops are shorter.
const PAUSE_SECS: f64 = 0.15;
/// Silence at least this long ends a turn, seconds. Designed: a second or two are a pause
/// in a story.
const TURN_SECS: f64 = 3.0;
/// Filler words in the supported languages.
const FILLERS: [&str; 9] = ["uh", "uhm", "erm", "hm", "mhm", "äh", "ähm", "öhm", "hã"];
/// Words that count as fillers only when lengthened, because they are ordinary words as well.
const DRAWN_FILLERS: [&str; 5] = ["er", "um", "eh", "ah", "m"];

/// Kind of boundary at which a pause occurs: between words, phrases, sentences or turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum BoundaryKind {
    /// Words of one phrase.
    Words,
    /// Intonational phrases of one sentence.
    Phrases,
    /// Sentences.
    Sentences,
    /// Turns.
    Turns,
}

/// Silence in speech, or a filler word in its place, with the boundary at which it occurs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pause {
    pub(super) start_secs: f64,
    pub(super) end_secs: f64,
    pub(super) parts: BoundaryKind,
    pub(super) is_filled: bool,
}

/// Interval of an accented syllable, story time, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AccentedSyllable {
    pub(super) start_secs: f64,
    pub(super) end_secs: f64,
}

/// Question in speech with the pause after it; the speaker looks at the listener.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Question {
    pub(super) start_secs: f64,
    /// Start and end of its last word.
    pub(super) last_word_secs: [f64; 2],
    pub(super) end_secs: f64,
}

/// Speech features used to plan expressions, story time: phone boundaries, pauses, accents, pitch
/// extrema, questions and turns.
#[derive(Clone, Debug, Default)]
pub(super) struct SpeechFeatures {
    /// Phone boundaries, ascending.
    pub(super) boundaries: Vec<f64>,
    pub(super) pauses: Vec<Pause>,
    pub(super) stresses: Vec<AccentedSyllable>,
    /// Rises and falls of the voice, utterance by utterance.
    pub(super) extremes: Vec<Extreme>,
    pub(super) questions: Vec<Question>,
    /// Start times of words that negate, ascending.
    pub(super) negations: Vec<f64>,
    /// Start of the first sound, start of the last word and end of the last sound of each
    /// turn.
    pub(super) turns: Vec<[f64; 3]>,
}

/// The last audible phone up to now.
struct LastPhone {
    end_secs: f64,
    /// Boundary that ends with it.
    parts: BoundaryKind,
    /// Index of the question that the phone ends; `None` if it ends none.
    question: Option<usize>,
}

impl SpeechFeatures {
    /// Extracts the features from utterances sorted by time, with finite times.
    pub(super) fn new(utterances: &[&TimedUtterance], manner: &Manner, seed: u64) -> Self {
        let mut heard = Self::default();
        let mut last: Option<LastPhone> = None;
        for (i, u) in utterances.iter().enumerate() {
            heard.add(u, &mut last);
            heard.add_melody(u, manner, seed.wrapping_add(i as u64));
        }
        if let Some(question) = last.and_then(|l| l.question) {
            heard.questions[question].end_secs += 1.0;
        }
        sort_by_number(&mut heard.boundaries, |t| *t);
        heard.boundaries.dedup();
        sort_by_number(&mut heard.stresses, |s| s.start_secs);
        sort_by_number(&mut heard.negations, |t| *t);
        sort_by_number(&mut heard.pauses, |p| p.start_secs);
        // A filler with the silence around it is one pause.
        heard.pauses.dedup_by(|later, earlier| {
            let joins = later.start_secs <= earlier.end_secs;
            if joins {
                earlier.end_secs = earlier.end_secs.max(later.end_secs);
                earlier.parts = earlier.parts.max(later.parts);
                earlier.is_filled |= later.is_filled;
            }
            joins
        });
        heard
    }

    /// Adds an utterance.
    fn add(&mut self, timed: &TimedUtterance, last: &mut Option<LastPhone>) {
        let u = &*timed.utterance;
        let (ends, questions) = ends_of(u);
        let at = |secs: f64| timed.story_secs(secs);
        let first_question = self.questions.len();
        for &(first, word) in &questions {
            let [first, last] = [&u.words[first], &u.words[word]];
            self.questions.push(Question {
                start_secs: at(first.start_secs),
                last_word_secs: [at(last.start_secs), at(last.end_secs)],
                end_secs: at(last.end_secs),
            });
        }
        for phone in &u.phones {
            let (start_secs, end_secs) = (at(phone.start_secs), at(phone.end_secs));
            let fits = start_secs.abs() < MAX_TIME_SECS && end_secs.abs() < MAX_TIME_SECS;
            if !fits || end_secs <= start_secs {
                continue;
            }
            self.boundaries.extend([start_secs, end_secs]);
            if phone.row.targets().class == Class::Silence {
                continue;
            }
            let word = phone.word.filter(|w| *w < u.words.len());
            let word_start_secs = word.map_or(start_secs, |w| at(u.words[w].start_secs));
            self.sound(start_secs, end_secs, word_start_secs, last.as_ref());
            // Phones outside words end nothing.
            let parts = word.map_or(BoundaryKind::Words, |w| ends[w]);
            let question = word.and_then(|w| questions.binary_search_by_key(&w, |q| q.1).ok());
            *last = Some(LastPhone {
                end_secs,
                parts,
                question: question.map(|q| first_question + q),
            });
        }
        for (i, word) in u.words.iter().enumerate() {
            let (start_secs, end_secs) = (at(word.start_secs), at(word.end_secs));
            if super::negation::is_negation(&word.text) && start_secs.abs() < MAX_TIME_SECS {
                self.negations.push(start_secs);
            }
            if is_filler(&word.text) && start_secs < end_secs && end_secs < MAX_TIME_SECS {
                self.pauses.push(Pause {
                    start_secs,
                    end_secs,
                    parts: ends[i].min(BoundaryKind::Phrases),
                    is_filled: true,
                });
            }
        }
        // An utterance ends a sentence, unless it declares a continuation.
        if let Some(last) = last.as_mut() {
            let goes_on = u
                .sentences
                .last()
                .is_some_and(|s| s.kind == SentenceKind::Continuation);
            last.parts = if goes_on {
                BoundaryKind::Phrases
            } else {
                last.parts.max(BoundaryKind::Sentences)
            };
        }
    }

    /// Adds a phone after the last one, and a pause if there is silence between them.
    fn sound(&mut self, start_secs: f64, end_secs: f64, word_secs: f64, last: Option<&LastPhone>) {
        let turn = self.turns.last_mut();
        if let Some((last, turn)) = last.zip(turn) {
            let silent_secs = start_secs - last.end_secs;
            let is_turn = silent_secs >= TURN_SECS;
            if silent_secs >= PAUSE_SECS {
                self.pauses.push(Pause {
                    start_secs: last.end_secs,
                    end_secs: start_secs,
                    parts: if is_turn {
                        BoundaryKind::Turns
                    } else {
                        last.parts
                    },
                    is_filled: false,
                });
                if let Some(question) = last.question {
                    self.questions[question].end_secs += silent_secs.min(1.0);
                }
            }
            if !is_turn {
                if word_secs > turn[1] && word_secs <= start_secs {
                    turn[1] = word_secs;
                }
                turn[2] = turn[2].max(end_secs);
                return;
            }
        }
        self.turns.push([start_secs, start_secs, end_secs]);
    }

    /// Adds the rises and falls of the voice, and the accents of an utterance. Accents that the
    /// bundle does not mark are placed at the highest pitch, or on some of the longer words.
    fn add_melody(&mut self, timed: &TimedUtterance, manner: &Manner, seed: u64) {
        let u = &*timed.utterance;
        let known = accent::known(u);
        let before = self.extremes.len();
        let from_sound = manner.basis == PlanBasis::Audio
            && pitch::extremes(timed, manner.pitch_threshold, &mut self.extremes);
        let accents = match &self.extremes[before..] {
            _ if !known.is_empty() => known,
            extremes if from_sound => pitch::accents(timed, extremes),
            _ => text::accents(u, seed),
        };
        if !from_sound {
            text::extremes(timed, &accents, &mut self.extremes);
        }
        for accent in &accents {
            let [start_secs, end_secs] =
                [accent.start_secs, accent.end_secs].map(|secs| timed.story_secs(secs));
            if start_secs < end_secs && start_secs.abs() < MAX_TIME_SECS && end_secs < MAX_TIME_SECS
            {
                self.stresses.push(AccentedSyllable {
                    start_secs,
                    end_secs,
                });
            }
        }
    }

    /// Returns the question asked at a time, including the pause after it.
    pub(super) fn question_at(&self, time_secs: f64) -> Option<&Question> {
        let begun = self
            .questions
            .partition_point(|q| q.start_secs <= time_secs);
        let last = &self.questions[begun.checked_sub(1)?];
        (time_secs < last.end_secs).then_some(last)
    }

    /// Returns the phone boundary nearest to a time within the interval `from` to `to`; `None` if
    /// there is none.
    pub(super) fn boundary_within(&self, at_secs: f64, from: f64, to: f64) -> Option<f64> {
        let next = self.boundaries.partition_point(|b| *b < at_secs);
        let distance = |b: &f64| (b - at_secs).abs();
        let [before, after] = [next.wrapping_sub(1), next].map(|i| self.boundaries.get(i));
        let near = match (before, after) {
            (Some(a), Some(b)) if distance(a) <= distance(b) => a,
            (a, b) => b.or(a)?,
        };
        // The nearest boundary can be too close to the previous key while the next one is not.
        let within = |b: &&f64| from <= **b && **b <= to;
        [Some(near), before, after]
            .into_iter()
            .flatten()
            .find(within)
            .copied()
    }

    /// Returns the phone boundary nearest to a time; the time itself if none is within 0.2 s.
    pub(super) fn snapped(&self, at_secs: f64) -> f64 {
        const NEAR_SECS: f64 = 0.2;
        let (from, to) = (at_secs - NEAR_SECS, at_secs + NEAR_SECS);
        self.boundary_within(at_secs, from, to).unwrap_or(at_secs)
    }
}

/// Returns the boundary that ends with each word of an utterance, and the first and last word of
/// each question. Sentences that the bundle does not mark are detected by punctuation.
fn ends_of(u: &Utterance) -> (Vec<BoundaryKind>, Vec<(usize, usize)>) {
    let mut ends = vec![BoundaryKind::Words; u.words.len()];
    let mut questions = Vec::new();
    for phrase in &u.phrases {
        let end = phrase.first_word.saturating_add(phrase.words);
        if let Some(end) = end.checked_sub(1).and_then(|last| ends.get_mut(last)) {
            *end = BoundaryKind::Phrases;
        }
    }
    let mut first = 0;
    let mut end = |last: usize, kind: SentenceKind| {
        if last < ends.len() && first <= last {
            ends[last] = match kind {
                SentenceKind::Continuation => BoundaryKind::Phrases,
                _ => BoundaryKind::Sentences,
            };
            if kind == SentenceKind::Question {
                questions.push((first, last));
            }
            first = last + 1;
        }
    };
    for sentence in &u.sentences {
        let after = sentence.first_word.saturating_add(sentence.words);
        if let Some(last) = after.checked_sub(1) {
            end(last, sentence.kind);
        }
    }
    if u.sentences.is_empty() {
        for (i, word) in u.words.iter().enumerate() {
            let text = word
                .text
                .trim_end_matches(['"', '\'', '”', '’', '»', '«', '“', ')']);
            if text.ends_with('?') {
                end(i, SentenceKind::Question);
            } else if text.ends_with(['.', '!', '…']) {
                end(i, SentenceKind::Statement);
            }
        }
    }
    (ends, questions)
}

/// Returns true if a word fills a pause: "errr", "ähm".
fn is_filler(text: &str) -> bool {
    let mut letters = ['\0'; 4];
    let (mut count, mut run, mut is_drawn) = (0, 0, false);
    for letter in text.chars().filter(|c| c.is_alphabetic()) {
        let letter = match letter {
            'Ä' => 'ä',
            'Ö' => 'ö',
            'Ã' => 'ã',
            other => other.to_ascii_lowercase(),
        };
        if count > 0 && letters[count - 1] == letter {
            run += 1;
            is_drawn |= run >= 3;
            continue;
        }
        if count == letters.len() {
            return false;
        }
        letters[count] = letter;
        (count, run) = (count + 1, 1);
    }
    let said = |filler: &str| filler.chars().eq(letters[..count].iter().copied());
    FILLERS.iter().any(|f| said(f)) || is_drawn && DRAWN_FILLERS.iter().any(|f| said(f))
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_speech::bundle::{Phrase, Sentence};
    use raconteur_speech::{Phone, Word};
    use std::sync::Arc;

    /// Creates a test utterance of one-phone words with their lengths, seconds; a negative length
    /// is silence.
    fn say(words: &[(&str, f64)]) -> Utterance {
        let mut u = Utterance::default();
        let mut now = 0.0;
        for (text, secs) in words {
            let end_secs = now + secs.abs();
            let word = (*secs > 0.0).then_some(u.words.len());
            let symbol = if word.is_some() { "aa" } else { "pau" };
            u.phones.push(Phone::new(symbol, now, end_secs, word));
            if word.is_some() {
                u.words.push(Word {
                    text: (*text).to_owned(),
                    start_secs: now,
                    end_secs,
                    emphasized: false,
                });
            }
            now = end_secs;
        }
        u.duration_secs = now;
        u
    }

    fn timed_utterance(start_secs: f64, utterance: Utterance) -> TimedUtterance {
        TimedUtterance {
            start_secs,
            utterance: Arc::new(utterance),
        }
    }

    #[test]
    fn pauses_part_words_phrases_sentences_and_turns() {
        let mut first = say(&[
            ("a", 0.2),
            ("", -0.3),
            ("b", 0.2),
            ("", -0.4),
            ("c", 0.2),
            ("", -0.1),
            ("d", 0.3),
            ("", -0.5),
        ]);
        first.phrases = vec![
            Phrase {
                first_word: 0,
                words: 2,
                tone: String::new(),
            },
            Phrase {
                first_word: 2,
                words: 2,
                tone: String::new(),
            },
        ];
        first.sentences = vec![Sentence {
            first_word: 0,
            words: 4,
            kind: SentenceKind::Statement,
        }];
        let first = timed_utterance(1.0, first);
        let second = timed_utterance(4.0, say(&[("e", 0.5), ("", -0.5)]));
        let third = timed_utterance(9.0, say(&[("f?", 0.5)]));
        let heard = SpeechFeatures::new(&[&first, &second, &third], &Manner::default(), 1);
        let parts: Vec<BoundaryKind> = heard.pauses.iter().map(|p| p.parts).collect();
        assert_eq!(
            parts,
            [
                BoundaryKind::Words,
                BoundaryKind::Phrases,
                BoundaryKind::Sentences,
                BoundaryKind::Turns
            ]
        );
        let third_pause = heard.pauses[2];
        assert!(
            (third_pause.start_secs - 2.7).abs() < 1e-9 && third_pause.end_secs == 4.0,
            "the bounds of the third pause"
        );
        assert_eq!(heard.turns, [[1.0, 4.0, 4.5], [9.0, 9.0, 9.5]]);
        // A question waits for an answer.
        assert_eq!(heard.questions.len(), 1);
        assert_eq!(heard.questions[0].end_secs, 10.5);
    }

    #[test]
    fn fillers_are_pauses_with_the_silence_around_them() {
        let words = [
            ("something", 0.4),
            ("", -0.2),
            ("errr...", 0.5),
            ("", -0.3),
            ("else", 0.4),
        ];
        let heard =
            SpeechFeatures::new(&[&timed_utterance(0.0, say(&words))], &Manner::default(), 1);
        assert_eq!(heard.pauses.len(), 1);
        let pause = heard.pauses[0];
        assert!(
            pause.is_filled && (pause.start_secs - 0.4).abs() < 1e-9,
            "the filled pause starts with the silence before it"
        );
        assert!(
            (pause.end_secs - 1.4).abs() < 1e-9,
            "the filled pause ends with the silence after it"
        );
        for (text, is) in [
            ("Uhm,", true),
            ("ÄHM", true),
            ("hmmm", true),
            ("ummm", true),
            // Words of German and Portuguese.
            ("er", false),
            ("um", false),
            ("eh", false),
            ("error", false),
            ("", false),
        ] {
            assert_eq!(is_filler(text), is, "{text}");
        }
    }

    #[test]
    fn the_nearest_boundary_within_bounds_is_found() {
        let heard = SpeechFeatures {
            boundaries: vec![1.0, 2.0, 3.0],
            ..SpeechFeatures::default()
        };
        assert_eq!(heard.boundary_within(1.4, 0.0, 9.0), Some(1.0));
        assert_eq!(heard.boundary_within(1.4, 1.2, 9.0), Some(2.0));
        assert_eq!(heard.boundary_within(1.4, 1.2, 1.9), None);
        assert_eq!(heard.snapped(2.9), 3.0);
        assert_eq!(heard.snapped(2.5), 2.5);
    }
}

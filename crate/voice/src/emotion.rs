//! Emotion of each word of an utterance, and the resulting number of pauses.

use crate::plan::{Plan, Planned};
use crate::prosody::Prosody;
use crate::realise::phrases_of;
use crate::spoken::Spoken;
use raconteur_speech::emotion::{self, EmotionPoint};

/// Emotion over a span of words of an utterance.
#[derive(Clone, Debug, PartialEq)]
pub struct EmotionSpan {
    /// Emotion word.
    pub name: String,
    /// Position in the emotion space at full strength.
    pub place: EmotionPoint,
    /// Index of the first word of the span, where the emotion starts to rise.
    pub first_word: usize,
    /// Index of the word at whose start the emotion is strongest; one past the last word means the
    /// end of that word.
    pub apex_word: usize,
    /// Index of the last word of the span, at whose end the emotion is over.
    pub last_word: usize,
    /// True if the emotion rises and falls linearly, as for emoticons; otherwise it is constant
    /// over the span.
    pub fades: bool,
}

impl EmotionSpan {
    /// Returns the strength at a word, 0 to 1.
    #[must_use]
    pub fn strength(&self, word: usize) -> f64 {
        if !(self.first_word..=self.last_word).contains(&word) {
            return 0.0;
        }
        if !self.fades {
            return 1.0;
        }
        let middle = word as f64 + 0.5;
        let (first, apex) = (self.first_word as f64, self.apex_word as f64);
        let end = self.last_word as f64 + 1.0;
        if middle < apex {
            (middle - first) / (apex - first)
        } else {
            (end - middle) / (end - apex)
        }
    }
}

/// Returns the emotions of an utterance: the one elicited by the script for all of it, where markup
/// sets none; those of markup; and emoticons, each over its intonational phrase or, between two,
/// over both (F&H 4.3.5). `phrases` are first and last words.
#[must_use]
pub fn emotion_spans(
    plan: &Plan,
    phrases: &[(usize, usize)],
    elicited: Option<&(String, EmotionPoint)>,
) -> Vec<EmotionSpan> {
    let mut out: Vec<EmotionSpan> = Vec::new();
    let mut last: Option<(usize, Option<&(String, EmotionPoint)>)> = None;
    let tokens = plan.sentences.iter().flat_map(|s| &s.sentence.tokens);
    for token in tokens {
        let styled = plan.styles.get(token.style);
        let of_markup = styled.and_then(|s| s.emotion.as_ref());
        let asked = of_markup.or(elicited);
        let goes_on = last.is_some_and(|(_, before)| before == asked);
        match (asked, out.last_mut()) {
            (Some(_), Some(open)) if goes_on => open.last_word = token.word,
            (Some((name, place)), _) if !place.is_neutral() => out.push(EmotionSpan {
                name: name.clone(),
                place: *place,
                first_word: token.word,
                apex_word: token.word,
                last_word: token.word,
                fades: false,
            }),
            _ => {}
        }
        last = asked
            .filter(|(_, place)| !place.is_neutral())
            .map(|one| (token.word, Some(one)));
    }
    for (before, name) in &plan.emoticons {
        let Some(place) = emotion::place(name) else {
            continue;
        };
        let of = |word: usize| {
            let found = phrases.iter().find(|(a, b)| (*a..=*b).contains(&word));
            found.copied()
        };
        let left = before.checked_sub(1).and_then(of);
        let right = of(*before);
        let Some((first_word, _)) = left.or(right) else {
            continue;
        };
        let (_, last_word) = right.or(left).unwrap_or((first_word, first_word));
        out.push(EmotionSpan {
            name: (*name).to_owned(),
            place,
            first_word,
            apex_word: *before,
            last_word,
            fades: true,
        });
    }
    out
}

/// Returns the combined position of all emotions at a word.
#[must_use]
pub fn place_of(emotions: &[EmotionSpan], word: usize) -> EmotionPoint {
    emotions.iter().fold(EmotionPoint::default(), |sum, one| {
        let part = one.place.scaled(one.strength(word));
        EmotionPoint {
            activation: sum.activation + part.activation,
            evaluation: sum.evaluation + part.evaluation,
            power: sum.power + part.power,
        }
        .scaled(1.0)
    })
}

/// Returns the phrases of all sentences, each as the indices of its first and last word in the
/// utterance, both included.
#[must_use]
pub fn word_phrases(sentences: &[Planned], spoken: &[Spoken]) -> Vec<(usize, usize)> {
    let mut out = Vec::new();
    for (planned, spoken) in sentences.iter().zip(spoken) {
        let tokens = &planned.sentence.tokens;
        for (first, last) in phrases_of(spoken, tokens.len()) {
            out.push((tokens[first].word, tokens[last].word));
        }
    }
    out
}

/// The pause that an emotion adds, seconds: Festival's mean one.
const ADDED_PAUSE_SECS: f64 = 0.2;
/// Assumed number of words per pause for a voice without pauses. *Designed*.
pub const WORDS_A_PAUSE: f64 = 8.0;
/// Minimum number of tokens between pauses, or between a pause and an end.
const MIN_TOKENS: usize = 2;

/// Pause inside a sentence not requested by the author.
struct InsertedPause {
    sentence: usize,
    token: usize,
    secs: f64,
}

/// Pauses inside the sentences of an utterance, and the emotion's effect on their number.
struct PauseCount {
    own: Vec<InsertedPause>,
    /// Number of pauses requested by the author.
    asked: usize,
    words: f64,
    /// Mean factor on their number.
    factor: f64,
}

impl PauseCount {
    fn count(
        sentences: &[Planned],
        spoken: &[Spoken],
        places: &dyn Fn(usize) -> EmotionPoint,
    ) -> Self {
        let mut own = Vec::new();
        let (mut words, mut factor, mut asked) = (0.0, 0.0, 0);
        for (i, (planned, spoken)) in sentences.iter().zip(spoken).enumerate() {
            let (mut start, mut token) = (0.0, None);
            for segment in &spoken.segments {
                let secs = segment.end_secs - start;
                start = segment.end_secs;
                if segment.is_silent()
                    && let Some(token) = token
                    && token + 1 < planned.sentence.tokens.len()
                    && planned.pauses.get(token).copied().flatten().is_none()
                {
                    own.push(InsertedPause {
                        sentence: i,
                        token,
                        secs,
                    });
                }
                token = segment.token.or(token);
            }
            let inside = planned
                .pauses
                .split_last()
                .map_or(&[][..], |(_, inside)| inside);
            asked += inside.iter().filter(|p| p.is_some_and(|p| p > 0.0)).count();
            for token in &planned.sentence.tokens {
                words += 1.0;
                factor += Prosody::from_point(places(token.word)).number_of_pauses;
            }
        }
        Self {
            own,
            asked,
            words,
            factor: if words > 0.0 { factor / words } else { 1.0 },
        }
    }

    /// Returns the target number of the voice's own pauses; `None` if emotion changes nothing.
    fn target_pauses(&self) -> Option<usize> {
        if (self.factor - 1.0).abs() < 1e-9 {
            return None;
        }
        // Where the author pauses often enough, as in verse, a voice adds no pauses.
        let usual = ((self.own.len() + self.asked) as f64).max(self.words / WORDS_A_PAUSE);
        Some(((usual * self.factor).round() as usize).saturating_sub(self.asked))
    }
}

/// Returns the pauses after an emotion has added or removed some inside the sentences of an
/// utterance (F&H table 4.5, number of pauses): for each sentence, tokens with the silence after
/// them, seconds. The author's pauses stay.
#[must_use]
pub fn moved_pauses(
    sentences: &[Planned],
    spoken: &[Spoken],
    places: &dyn Fn(usize) -> EmotionPoint,
) -> Vec<Vec<(usize, f64)>> {
    let mut moved = vec![Vec::new(); sentences.len()];
    let count = PauseCount::count(sentences, spoken, places);
    let Some(wanted) = count.target_pauses() else {
        return moved;
    };
    let mut own = count.own;
    if wanted < own.len() {
        own.sort_by(|a, b| a.secs.total_cmp(&b.secs));
        for pause in &own[..own.len() - wanted] {
            moved[pause.sentence].push((pause.token, 0.0));
        }
        return moved;
    }
    for _ in own.len()..wanted {
        let Some((sentence, token)) = longest_run_middle(sentences, &own, &moved) else {
            break;
        };
        moved[sentence].push((token, ADDED_PAUSE_SECS));
    }
    moved
}

/// Returns the token in the middle of the longest run without a pause, with its sentence; `None`
/// without a run.
fn longest_run_middle(
    sentences: &[Planned],
    own: &[InsertedPause],
    moved: &[Vec<(usize, f64)>],
) -> Option<(usize, usize)> {
    let mut best: Option<(usize, usize, usize)> = None;
    for (i, planned) in sentences.iter().enumerate() {
        let asked = planned.pauses.iter().enumerate();
        let mut stops: Vec<usize> = own
            .iter()
            .filter(|pause| pause.sentence == i)
            .map(|pause| pause.token + 1)
            .chain(moved[i].iter().map(|(t, _)| t + 1))
            .chain(asked.filter(|(_, p)| p.is_some()).map(|(t, _)| t + 1))
            .chain([0, planned.sentence.tokens.len()])
            .collect();
        stops.sort_unstable();
        for pair in stops.windows(2) {
            let length = pair[1] - pair[0];
            if length >= 2 * MIN_TOKENS && best.is_none_or(|(_, _, most)| length > most) {
                best = Some((i, pair[0] + length / 2 - 1, length));
            }
        }
    }
    best.map(|(sentence, token, _)| (sentence, token))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::{Content, Segment};
    use crate::plan::plan;
    use crate::text::Lexicon;

    fn planned(text: &str) -> Plan {
        plan(&Content::plain(text), "de", "test", &Lexicon::default()).unwrap()
    }

    #[test]
    fn emoticons_span_their_phrase_or_the_two_between_which_they_stand() {
        // F&H 4.3.5 and table 4.2.
        let plan = planned("es gingen ins ;-) Endlose hinaus bis ans Grab :-( das war");
        let phrases = [(0, 4), (5, 7), (8, 9)];
        let emotions = emotion_spans(&plan, &phrases, None);
        let spans: Vec<_> = emotions
            .iter()
            .map(|f| (f.name.as_str(), f.first_word, f.apex_word, f.last_word))
            .collect();
        assert_eq!(spans, [("kidding", 0, 3, 4), ("distress", 5, 8, 9)]);
        let strengths: Vec<f64> = (0..6).map(|w| emotions[0].strength(w)).collect();
        assert!(
            strengths[0] < strengths[1] && strengths[1] < strengths[2],
            "the strength rises to the apex"
        );
        assert!(
            strengths[3] > strengths[4] && strengths[5] == 0.0,
            "the strength falls after the apex"
        );
    }

    #[test]
    fn what_is_elicited_is_felt_in_every_word() {
        let plan = planned("Eins zwei drei.");
        let hate = ("hate".to_owned(), emotion::place("hate").unwrap());
        let felt = emotion_spans(&plan, &[(0, 2)], Some(&hate));
        assert_eq!(felt.len(), 1);
        assert_eq!((felt[0].first_word, felt[0].last_word), (0, 2));
        assert_eq!(place_of(&felt, 1).activation, 60.0);
        assert!(
            place_of(&felt, 3).is_neutral(),
            "a word outside the span is neutral"
        );
    }

    #[test]
    fn pauses_of_the_author_are_pauses_already() {
        let pause = || Segment::Break {
            msec: 200,
            boundary: None,
        };
        let line = |text: &str| Segment::Text(text.to_owned());
        let content = Content {
            segments: vec![
                line("one two three four"),
                pause(),
                line("five six seven eight"),
                pause(),
                line("nine ten eleven twelve"),
            ],
        };
        let plan = plan(&content, "en", "test", &Lexicon::default()).unwrap();
        let spoken = Spoken::default();
        let added = |activation| {
            let place = EmotionPoint {
                activation,
                ..EmotionPoint::default()
            };
            moved_pauses(&plan.sentences, core::slice::from_ref(&spoken), &|_| place)
                .concat()
                .len()
        };
        // Two pauses are as many as they should be, one more is half as many again.
        assert_eq!([added(10.0), added(70.0), added(-70.0)], [0, 1, 0]);
    }

    #[test]
    fn excitement_makes_more_pauses_and_calm_fewer() {
        let plan = planned("one two three four five six seven eight nine ten eleven twelve");
        let segments = (0..12)
            .flat_map(|t| {
                let of = |symbol: &str, end_secs, token| crate::spoken::Segment {
                    symbol: symbol.to_owned(),
                    end_secs,
                    token,
                };
                let end = f64::from(t as u32) + 1.0;
                let mut out = vec![of("aa", end - 0.3, Some(t))];
                if t == 3 || t == 7 {
                    out.push(of("pau", end, None));
                }
                out
            })
            .collect();
        let spoken = Spoken {
            segments,
            ..Spoken::default()
        };
        let count = |activation| {
            let place = EmotionPoint {
                activation,
                ..EmotionPoint::default()
            };
            moved_pauses(&plan.sentences, core::slice::from_ref(&spoken), &|_| place).remove(0)
        };
        assert!(count(0.0).is_empty(), "a neutral emotion moves no pauses");
        assert_eq!(count(70.0).len(), 1);
        assert!(count(70.0)[0].1 > 0.0, "excitement adds pauses");
        assert_eq!(count(-70.0).len(), 1);
        assert_eq!(count(-70.0)[0].1, 0.0);
    }
}

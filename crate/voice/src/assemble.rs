//! Assembly of an utterance's sentences: one audio track with its silences and recordings, and the
//! times of its content.

use raconteur_base::ops;

use crate::emotion::EmotionSpan;
use crate::plan::{Plan, Planned, Sound};
use crate::realise::phrases_of;
use crate::signal::f0;
use crate::signal::intensity;
use crate::spoken::Spoken;
use raconteur_speech::bundle::{
    Accent, Emotion, FRAME_SECS, Phone, Phrase, SILENCE, SOUND, Sentence, Syllable, Utterance,
    Word, code_of_db, code_of_hz,
};

/// Silence before the first word, seconds: time for a caption or the mouth to get ready.
const LEAD_SECS: f64 = 0.12;

/// Silence after the last word, seconds: the voice dies away in it.
const TAIL_SECS: f64 = 0.15;

/// Duration of the engine's own silence retained after and before speech, with a fade: breath and
/// decay not covered by the phone labels.
const FADE_OUT_SECS: f64 = 0.06;
const FADE_IN_SECS: f64 = 0.03;

/// Gain of a recording while somebody speaks over it: a factor for 12 dB.
const DUCKED: f64 = 0.25;
/// Time within which a recording fades down or up around speech over it, seconds.
const DUCK_SECS: f64 = 0.25;

/// Maximum sample value: −1.5 dB, which leaves the encoders half a decibel below −1.
const PEAK: f64 = 0.84;
/// Amplitude above which peaks are rounded off: the sharp peaks of loud voices, one in each period.
const KNEE: f64 = 0.7;

/// The window of intensity, seconds: two periods of a low voice.
const INTENSITY_WINDOW_SECS: f64 = 0.032;

/// Synthesised sentence, ready to be assembled to an utterance.
pub struct SpokenSentence {
    /// Final audio and times.
    pub spoken: Spoken,
    /// Factor for pauses not set by the text: from speech rate and emotions.
    pub pauses: f64,
    /// Silences to add after tokens, and those to leave out, which are 0; seconds.
    pub moved_pauses: Vec<(usize, f64)>,
}

/// Assembled audio of an utterance, and its data except keys and audio files.
#[derive(Clone, Debug, PartialEq)]
pub struct Speech {
    /// Mono, −1 to 1.
    pub samples: Vec<f64>,
    /// Sample rate, Hz.
    pub rate_hz: f64,
    /// Utterance with all times and frames, without key and audio files.
    pub utterance: Utterance,
}

/// Recording that is mixed into an utterance, decoded to the sample rate of the utterance.
pub struct Recording {
    /// Mono samples.
    pub samples: Vec<f64>,
}

/// Assembles the spoken sentences of a plan. All sounds have `rate_hz`; there is a recording for
/// each of the plan's sounds.
#[must_use]
pub fn assemble(
    plan: &Plan,
    sentences: &[SpokenSentence],
    recordings: &[Recording],
    felt: &[EmotionSpan],
    rate_hz: f64,
) -> Speech {
    let mut assembly = Assembly {
        tape: AudioBuilder {
            rate_hz,
            samples: Vec::new(),
            marks: Vec::new(),
            sounds: plan.sounds.iter().zip(recordings).collect(),
            backgrounds: Vec::new(),
        },
        utterance: Utterance::default(),
        gap_secs: LEAD_SECS + plan.lead_pause_secs,
        before: &[],
        first_word: 0,
    };
    for (planned, sentence) in plan.sentences.iter().zip(sentences) {
        assembly.sentence(planned, sentence);
    }
    // An author's pause at the very end is part of the utterance, a usual one is not.
    let asked = plan
        .sentences
        .last()
        .and_then(|s| s.pauses.last().copied().flatten());
    let tail_secs = match plan.sentences.is_empty() {
        true => assembly.gap_secs,
        false => TAIL_SECS + asked.unwrap_or(0.0),
    };
    let Assembly {
        mut tape,
        utterance,
        before,
        ..
    } = assembly;
    tape.silence(tail_secs, before, &[]);
    tape.sounds_before(usize::MAX);
    tape.finish(plan, utterance, felt)
}

/// Utterance under construction from its joined sentences.
struct Assembly<'a> {
    tape: AudioBuilder<'a>,
    utterance: Utterance,
    /// Silence before the next sentence, seconds.
    gap_secs: f64,
    /// Engine audio after the last phone.
    before: &'a [f64],
    /// First word of the current sentence, which may be spoken in several runs.
    first_word: usize,
}

impl<'a> Assembly<'a> {
    fn sentence(&mut self, planned: &Planned, sentence: &'a SpokenSentence) {
        let segments = &sentence.spoken.segments;
        let Some(last) = segments.iter().rposition(|s| !s.is_silent()) else {
            self.gap_secs += planned.pause_secs;
            return;
        };
        let phone_of = self.phones(planned, sentence, last);
        let samples = &sentence.spoken.samples;
        let end_secs = samples.len() as f64 / self.tape.rate_hz;
        self.before = self.slice(samples, segments[last].end_secs, end_secs);
        let authors = planned.pauses.last().copied().flatten().is_some();
        let pace = if authors { 1.0 } else { sentence.pauses };
        self.gap_secs = planned.pause_secs * pace;
        describe(&mut self.utterance, sentence, planned, &phone_of);
        if !planned.continues {
            let next_word = planned.sentence.tokens.last().map_or(0, |t| t.word + 1);
            self.utterance.sentences.push(Sentence {
                first_word: self.first_word,
                words: next_word.saturating_sub(self.first_word),
                kind: planned.sentence.kind,
            });
            self.first_word = next_word;
        }
    }

    /// Puts the segments up to the `last` on tape, with the pauses between them; the phone that each
    /// became.
    fn phones(
        &mut self,
        planned: &Planned,
        sentence: &'a SpokenSentence,
        last: usize,
    ) -> Vec<usize> {
        let SpokenSentence { spoken, pauses, .. } = sentence;
        let pause_after = |token: usize| {
            let asked = planned.pauses.get(token).copied().flatten();
            asked.or_else(|| sentence.moved(token))
        };
        let mut phone_of = vec![0; spoken.segments.len()];
        let mut start_secs = 0.0;
        let mut last_token = None;
        for (i, segment) in spoken.segments.iter().enumerate().take(last + 1) {
            let sound = self.slice(&spoken.samples, start_secs, segment.end_secs);
            match (segment.is_silent(), last_token) {
                // Silence before the sentence is part of the gap.
                (true, None) => {}
                (true, Some(token)) => {
                    // A pause inside the sentence: the author's length, else the usual one.
                    let next = spoken.segments[i..].iter().find_map(|s| s.token);
                    let asked = pause_after(token).filter(|_| next != Some(token));
                    let own_secs = segment.end_secs - start_secs;
                    let usual = planned.rests.get(token).filter(|secs| **secs > 0.0);
                    let own_secs = usual.copied().unwrap_or(own_secs) * pauses;
                    self.tape.silence(asked.unwrap_or(own_secs), sound, sound);
                }
                (false, before) => {
                    let token = segment.token.unwrap_or(0);
                    match before {
                        None => {
                            let after = self.slice(&spoken.samples, 0.0, start_secs);
                            self.tape.silence(self.gap_secs, self.before, after);
                        }
                        Some(before) if before != token && !spoken.segments[i - 1].is_silent() => {
                            // The engine makes no pause where the text sets one.
                            if let Some(secs) = pause_after(before).filter(|secs| *secs > 0.0) {
                                self.tape.silence(secs, &[], &[]);
                            }
                        }
                        Some(_) => {}
                    }
                    let word = planned.sentence.tokens.get(token).map(|t| t.word);
                    self.tape.sounds_before(word.unwrap_or(0));
                    self.tape.speech(&segment.symbol, word, sound);
                    last_token = Some(token);
                }
            }
            phone_of[i] = self.tape.marks.len().saturating_sub(1);
            start_secs = segment.end_secs;
        }
        phone_of
    }

    /// Returns the samples between two times.
    fn slice(&self, samples: &'a [f64], from_secs: f64, to_secs: f64) -> &'a [f64] {
        let rate_hz = self.tape.rate_hz;
        let index = |secs: f64| ((secs * rate_hz).round().max(0.0) as usize).min(samples.len());
        &samples[index(from_secs)..index(to_secs).max(index(from_secs))]
    }
}

impl SpokenSentence {
    fn moved(&self, token: usize) -> Option<f64> {
        let found = self.moved_pauses.iter().find(|(t, _)| *t == token);
        found.map(|(_, secs)| *secs)
    }
}

/// Syllables, accents and phrases of a sentence, by phone and word.
fn describe(
    utterance: &mut Utterance,
    sentence: &SpokenSentence,
    planned: &Planned,
    phone_of: &[usize],
) {
    for syllable in &sentence.spoken.syllables {
        let last = (syllable.first + syllable.count).max(1) - 1;
        let (Some(first), Some(last)) = (phone_of.get(syllable.first), phone_of.get(last)) else {
            continue;
        };
        if !syllable.accent.is_empty() {
            utterance.accents.push(Accent {
                syllable: utterance.syllables.len(),
                label: syllable.accent.clone(),
            });
        }
        utterance.syllables.push(Syllable {
            first_phone: *first,
            phones: last + 1 - first,
            stress: syllable.stress,
        });
    }
    let tokens = &planned.sentence.tokens;
    for (_, last) in phrases_of(&sentence.spoken, tokens.len()) {
        let first_word = utterance
            .phrases
            .last()
            .map_or(0, |p| p.first_word + p.words);
        // A word spoken as several tokens belongs to the phrase of its last one.
        let word = tokens[last].word;
        if tokens.get(last + 1).is_some_and(|t| t.word == word) || word < first_word {
            continue;
        }
        let breaks = sentence.spoken.breaks.iter();
        utterance.phrases.push(Phrase {
            first_word,
            words: word + 1 - first_word,
            tone: breaks
                .clone()
                .find(|(token, _)| *token == last)
                .map_or(String::new(), |(_, tone)| tone.clone()),
        });
    }
}

/// Audio under construction, with the ends of its phones.
struct AudioBuilder<'a> {
    rate_hz: f64,
    samples: Vec<f64>,
    marks: Vec<Mark>,
    /// Remaining recordings.
    sounds: std::collections::VecDeque<(&'a Sound, &'a Recording)>,
    /// Recordings under the speech, with their first samples.
    backgrounds: Vec<(usize, &'a Sound, &'a Recording)>,
}

struct Mark {
    symbol: String,
    word: Option<usize>,
    end: usize,
}

impl AudioBuilder<'_> {
    fn speech(&mut self, symbol: &str, word: Option<usize>, sound: &[f64]) {
        self.samples.extend_from_slice(sound);
        self.marks.push(Mark {
            symbol: symbol.to_owned(),
            word,
            end: self.samples.len(),
        });
    }

    /// Plays the recordings before a word.
    fn sounds_before(&mut self, word: usize) {
        while let Some((sound, recording)) = self.sounds.front().copied() {
            if sound.word > word {
                return;
            }
            self.sounds.pop_front();
            if sound.background {
                self.backgrounds
                    .push((self.samples.len(), sound, recording));
            } else {
                let loud = recording.samples.iter().map(|s| s * sound.level);
                self.samples.extend(loud);
                self.marks.push(Mark {
                    symbol: SOUND.to_owned(),
                    word: None,
                    end: self.samples.len(),
                });
            }
        }
    }

    /// Adds silence of this length that starts with `before` and ends with `after`.
    fn silence(&mut self, secs: f64, before: &[f64], after: &[f64]) {
        let count = |secs: f64| (secs.max(0.0) * self.rate_hz).round() as usize;
        let length = count(secs);
        let out = count(FADE_OUT_SECS).min(length * 2 / 3).min(before.len());
        let r#in = count(FADE_IN_SECS).min(length / 3).min(after.len());
        let begin = self.samples.len();
        self.samples.resize(begin + length, 0.0);
        for (i, sample) in before[..out].iter().enumerate() {
            self.samples[begin + i] = sample * (1.0 - (i + 1) as f64 / out as f64);
        }
        for (i, sample) in after[after.len() - r#in..].iter().enumerate() {
            self.samples[begin + length - r#in + i] = sample * (i as f64 / r#in as f64);
        }
        let end = self.samples.len();
        match self.marks.last_mut() {
            Some(last) if last.symbol == SILENCE => last.end = end,
            _ if length > 0 => self.marks.push(Mark {
                symbol: SILENCE.to_owned(),
                word: None,
                end,
            }),
            _ => {}
        }
    }

    /// Mixes the recordings under the speech, attenuated while somebody speaks.
    fn mix(&mut self) {
        if self.backgrounds.is_empty() {
            return;
        }
        let mut level = vec![1.0; self.samples.len()];
        let mut start = 0;
        for mark in &self.marks {
            if mark.word.is_some() {
                level[start..mark.end].fill(DUCKED);
            }
            start = mark.end;
        }
        // A one-pole filter in both directions: soft before a word begins, loud after it has ended.
        let keep = ops::exp(-3.0 / (DUCK_SECS * self.rate_hz));
        let smooth = |level: &mut dyn Iterator<Item = &mut f64>| {
            let mut now = None;
            for value in level {
                let next = now.map_or(*value, |now: f64| {
                    (now * keep + *value * (1.0 - keep)).min(now.max(*value))
                });
                *value = next;
                now = Some(next);
            }
        };
        smooth(&mut level.iter_mut());
        smooth(&mut level.iter_mut().rev());
        for (at, sound, recording) in &self.backgrounds {
            let under = self.samples[*at..].iter_mut().zip(&level[*at..]);
            for ((sample, level), recorded) in under.zip(&recording.samples) {
                *sample += recorded * sound.level * level;
            }
        }
        // Sound that is longer than the speech fades out with it.
        let fade = ((0.1 * self.rate_hz) as usize).min(self.samples.len());
        let end = self.samples.len();
        for (i, sample) in self.samples[end - fade..].iter_mut().enumerate() {
            *sample *= 1.0 - i as f64 / fade as f64;
        }
    }

    /// Mixes, and turns marks into times.
    fn finish(mut self, plan: &Plan, mut utterance: Utterance, felt: &[EmotionSpan]) -> Speech {
        // Whole milliseconds, so that the bundle's duration equals the file's.
        let milli = self.rate_hz / 1000.0;
        let length_msec = (self.samples.len() as f64 / milli).ceil();
        let length = (length_msec * milli).round() as usize;
        self.samples.resize(length, 0.0);
        self.mix();
        for sample in &mut self.samples {
            let over = sample.abs() - KNEE;
            if over > 0.0 {
                let rounded = (PEAK - KNEE) * (1.0 - ops::exp(-over / (PEAK - KNEE)));
                *sample = (KNEE + rounded).copysign(*sample);
            }
        }
        let msec = |index: usize| (index as f64 / milli).round();
        utterance.duration_secs = length_msec / 1000.0;
        let mut start_secs = 0.0;
        for mark in &self.marks {
            let end_secs = msec(mark.end) / 1000.0;
            let phone = Phone::new(&mark.symbol, start_secs, end_secs, mark.word);
            utterance.phones.push(phone);
            start_secs = end_secs;
        }
        if let Some(last) = utterance.phones.last_mut() {
            last.end_secs = utterance.duration_secs;
        }
        words(&mut utterance, plan);
        emotions(&mut utterance, felt);
        let track = f0::track_voice(&self.samples, self.rate_hz, FRAME_SECS);
        let frames = (utterance.duration_secs / FRAME_SECS).floor() as usize + 1;
        let secs = |i: usize| i as f64 * FRAME_SECS;
        utterance.f0 = (0..frames)
            .map(|i| code_of_hz(track.hz_at(secs(i))))
            .collect();
        utterance.intensity = intensity_codes(&self.samples, self.rate_hz, utterance.duration_secs);
        Speech {
            samples: self.samples,
            rate_hz: self.rate_hz,
            utterance,
        }
    }
}

/// Returns the intensity of a sound as bundle codes, one for each [`FRAME_SECS`] of its length in
/// seconds.
#[must_use]
pub fn intensity_codes(samples: &[f64], rate_hz: f64, duration_secs: f64) -> Vec<u8> {
    let db = intensity::intensity(samples, rate_hz, FRAME_SECS, INTENSITY_WINDOW_SECS);
    let frames = (duration_secs / FRAME_SECS).floor() as usize + 1;
    (0..frames)
        .map(|i| code_of_db(db.db_at(i as f64 * FRAME_SECS)))
        .collect()
}

/// Sets the times of words from those of their phones, and their positions in the text.
fn words(utterance: &mut Utterance, plan: &Plan) {
    let mut spans: Vec<Option<(f64, f64)>> = vec![None; plan.words.len()];
    for phone in &utterance.phones {
        if let Some(span) = phone.word.and_then(|w| spans.get_mut(w)) {
            let start_secs = span.map_or(phone.start_secs, |s| s.0);
            *span = Some((start_secs, phone.end_secs));
        }
    }
    for (text, span) in plan.words.iter().zip(spans) {
        // A word without audio, for example signs that the engine skips, takes no time.
        let silent_secs = utterance.words.last().map_or(0.0, |w| w.end_secs);
        let (start_secs, end_secs) = span.unwrap_or((silent_secs, silent_secs));
        if !utterance.text.is_empty() {
            utterance.text.push(' ');
        }
        utterance.text_starts.push(utterance.text.len());
        utterance.text.push_str(text);
        utterance.words.push(Word {
            text: text.clone(),
            start_secs,
            end_secs,
            emphasized: false,
        });
    }
}

fn emotions(utterance: &mut Utterance, felt: &[EmotionSpan]) {
    for one in felt {
        let words = &utterance.words;
        let (Some(first), Some(last)) = (words.get(one.first_word), words.get(one.last_word))
        else {
            continue;
        };
        let apex = words
            .get(one.apex_word)
            .map_or(last.end_secs, |w| w.start_secs);
        utterance.emotions.push(Emotion {
            name: one.name.clone(),
            start_secs: first.start_secs,
            apex_secs: apex.clamp(first.start_secs, last.end_secs),
            end_secs: last.end_secs,
            activation: one.place.activation,
            evaluation: one.place.evaluation,
            power: one.place.power,
        });
    }
}

#[cfg(test)]
mod tests;

//! Puts the sentences of an utterance together: one sound with silences where they belong,
//! and the times of words and phones in it.

use anyhow::{Result, ensure};
use raconteur_player::speech::{Phone, Word};

use super::emphasis;
use super::festival::Spoken;
use super::plan::Plan;

/// Silence before the first word, seconds: what a caption or a mouth needs to get ready.
const LEAD_SECS: f64 = 0.12;

/// Silence after the last word, seconds: the voice dies away in it.
const TAIL_SECS: f64 = 0.15;

/// How much of the engine's own silence is kept after and before speech, fading: breath and
/// decay that the phone labels do not cover.
const FADE_OUT_SECS: f64 = 0.06;
const FADE_IN_SECS: f64 = 0.03;

/// Loudness of the speech without its pauses, root mean square against full scale.
const LOUDNESS: f64 = 0.1;

/// No sample goes beyond this: -1.5 dB, which leaves the encoders half a decibel below -1.
const PEAK: f64 = 0.84;

/// One utterance, ready to encode.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Track {
    /// Mono, -1 to 1.
    pub(crate) samples: Vec<f64>,
    /// Samples a second.
    pub(crate) rate_hz: u32,
    /// Length, seconds; whole milliseconds.
    pub(crate) duration_secs: f64,
    /// One for each word of the plan.
    pub(crate) words: Vec<Word>,
    /// They tile the duration.
    pub(crate) phones: Vec<Phone>,
}

/// Assembles the sentences that the engine spoke for a plan.
///
/// # Errors
/// When the engine's sound and times do not belong together.
pub(crate) fn assemble(plan: &Plan, spoken: Vec<Spoken>) -> Result<Track> {
    let rate_hz = spoken.first().map_or(32_000, |s| s.rate_hz);
    ensure!(
        spoken.iter().all(|s| s.rate_hz == rate_hz),
        "the engine changed its sample rate"
    );
    let rate = f64::from(rate_hz);
    let mut tape = Tape {
        rate,
        samples: Vec::new(),
        marks: Vec::new(),
    };
    let mut gap_secs = LEAD_SECS + plan.lead_pause_secs;
    let mut before: Vec<f64> = Vec::new();
    for (sentence, spoken) in plan.sentences.iter().zip(spoken) {
        let spoken = emphasis::apply(sentence, spoken);
        let length_secs = spoken.samples.len() as f64 / rate;
        let labelled_secs = spoken.segments.last().map_or(0.0, |s| s.end_secs);
        ensure!(
            (length_secs - labelled_secs).abs() < 0.05,
            "the engine's sound lasts {length_secs} s but its phones {labelled_secs} s"
        );
        let cut = |from_secs: f64, to_secs: f64| {
            let index = |secs: f64| ((secs * rate).round() as usize).min(spoken.samples.len());
            &spoken.samples[index(from_secs)..index(to_secs)]
        };
        let voiced = |s: &super::festival::Segment| s.symbol != "pau";
        let Some(last) = spoken.segments.iter().rposition(voiced) else {
            continue;
        };
        let mut begun = false;
        let mut start_secs = 0.0;
        let mut last_word = None;
        for (i, segment) in spoken.segments.iter().enumerate().take(last + 1) {
            let sound = cut(start_secs, segment.end_secs);
            if voiced(segment) {
                if !begun {
                    tape.silence(gap_secs, &before, cut(0.0, start_secs));
                    begun = true;
                }
                tape.speech(&segment.symbol, segment.word, sound);
                last_word = segment.word;
            } else if begun {
                // A pause inside the sentence: the author's length, else the engine's.
                let next = spoken.segments[i..]
                    .iter()
                    .find(|s| voiced(s))
                    .and_then(|s| s.word);
                let asked = last_word
                    .filter(|w| next != Some(*w))
                    .and_then(|w| sentence.tokens.iter().rfind(|t| t.word == w))
                    .and_then(|t| t.pause_secs);
                tape.silence(asked.unwrap_or(segment.end_secs - start_secs), sound, sound);
            }
            start_secs = segment.end_secs;
        }
        before = cut(start_secs, length_secs).to_vec();
        gap_secs = sentence.pause_secs();
    }
    // An author's pause at the very end is part of the utterance, a usual one is not.
    let asked = plan
        .sentences
        .last()
        .and_then(|s| s.tokens.last())
        .and_then(|t| t.pause_secs);
    let tail_secs = match plan.sentences.is_empty() {
        true => gap_secs,
        false => TAIL_SECS + asked.unwrap_or(0.0),
    };
    tape.silence(tail_secs, &before, &[]);
    Ok(tape.finish(plan, rate_hz))
}

/// The sound so far and where its phones end.
struct Tape {
    rate: f64,
    samples: Vec<f64>,
    marks: Vec<Mark>,
}

struct Mark {
    symbol: String,
    word: Option<usize>,
    end: usize,
}

impl Tape {
    fn speech(&mut self, symbol: &str, word: Option<usize>, sound: &[f64]) {
        self.samples.extend_from_slice(sound);
        self.marks.push(Mark {
            symbol: symbol.to_owned(),
            word,
            end: self.samples.len(),
        });
    }

    /// Adds silence of this length that begins as `before` does and ends as `after` does.
    fn silence(&mut self, secs: f64, before: &[f64], after: &[f64]) {
        let count = |secs: f64| (secs.max(0.0) * self.rate).round() as usize;
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
            Some(last) if last.symbol == "pau" => last.end = end,
            _ if length > 0 => self.marks.push(Mark {
                symbol: "pau".to_owned(),
                word: None,
                end,
            }),
            _ => {}
        }
    }

    /// Sets the loudness and turns marks into times.
    fn finish(mut self, plan: &Plan, rate_hz: u32) -> Track {
        // Whole milliseconds, so that the duration in the bundle is that of the file.
        let milli = (rate_hz / 1000).max(1) as usize;
        let length = self.samples.len().div_ceil(milli) * milli;
        self.samples.resize(length, 0.0);
        self.level();
        let secs = |index: usize| (index as f64 / self.rate * 1000.0).round() / 1000.0;
        let duration_secs = secs(length);
        let mut phones: Vec<Phone> = Vec::with_capacity(self.marks.len());
        let mut start_secs = 0.0;
        for mark in &self.marks {
            let end_secs = secs(mark.end);
            phones.push(Phone {
                symbol: mark.symbol.clone(),
                start_secs,
                end_secs,
                word: mark.word,
            });
            start_secs = end_secs;
        }
        if let Some(last) = phones.last_mut() {
            last.end_secs = duration_secs;
        }
        let mut spans: Vec<Option<(f64, f64)>> = vec![None; plan.words.len()];
        for phone in &phones {
            if let Some(span) = phone.word.and_then(|w| spans.get_mut(w)) {
                let start_secs = span.map_or(phone.start_secs, |s| s.0);
                *span = Some((start_secs, phone.end_secs));
            }
        }
        let mut words: Vec<Word> = Vec::with_capacity(plan.words.len());
        for (text, span) in plan.words.iter().zip(spans) {
            // A word without a sound, say of signs that the engine skips, takes no time.
            let silent_secs = words.last().map_or(0.0, |w| w.end_secs);
            let (start_secs, end_secs) = span.unwrap_or((silent_secs, silent_secs));
            words.push(Word {
                text: text.clone(),
                start_secs,
                end_secs,
            });
        }
        Track {
            samples: self.samples,
            rate_hz,
            duration_secs,
            words,
            phones,
        }
    }

    fn level(&mut self) {
        let (mut power, mut count, mut start) = (0.0, 0_usize, 0);
        for mark in &self.marks {
            if mark.symbol != "pau" {
                power += self.samples[start..mark.end]
                    .iter()
                    .map(|s| s * s)
                    .sum::<f64>();
                count += mark.end - start;
            }
            start = mark.end;
        }
        let peak = self.samples.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
        if count == 0 || power <= 0.0 {
            return;
        }
        let gain = (LOUDNESS / (power / count as f64).sqrt()).min(PEAK / peak);
        for sample in &mut self.samples {
            *sample *= gain;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::festival::Segment;
    use super::super::plan;
    use super::*;
    use raconteur_player::speech::{Content, Segment as Said};

    const RATE_HZ: u32 = 8_000;

    fn said(segments: Vec<Said>) -> Plan {
        plan::plan(&Content { segments }).unwrap()
    }

    fn text(t: &str) -> Said {
        Said::Text {
            text: t.to_owned(),
            emphasis: 1.0,
        }
    }

    /// Speech is ±0.5, silence 0; `phones` are symbol, length and word.
    fn spoken(phones: &[(&str, f64, Option<usize>)]) -> Spoken {
        let mut out = Spoken {
            samples: Vec::new(),
            rate_hz: RATE_HZ,
            segments: Vec::new(),
        };
        let mut end_secs = 0.0;
        for (symbol, secs, word) in phones {
            end_secs += secs;
            let end = (end_secs * f64::from(RATE_HZ)).round() as usize;
            let value = if *symbol == "pau" { 0.0 } else { 0.5 };
            while out.samples.len() < end {
                out.samples.push(if out.samples.len().is_multiple_of(2) {
                    value
                } else {
                    -value
                });
            }
            out.segments.push(Segment {
                symbol: (*symbol).to_owned(),
                end_secs,
                word: *word,
            });
        }
        out
    }

    fn show(track: &Track) -> String {
        let phone = |p: &Phone| format!("{} {:.3}", p.symbol, p.end_secs);
        track
            .phones
            .iter()
            .map(phone)
            .collect::<Vec<_>>()
            .join(", ")
    }

    #[test]
    fn lead_tail_and_the_pause_between_sentences_are_ours() {
        let plan = said(vec![text("Oh. Ah.")]);
        let sentence = |w| {
            spoken(&[
                ("pau", 0.2, None),
                ("ow", 0.3, Some(w)),
                ("pau", 0.25, None),
            ])
        };
        let track = assemble(&plan, vec![sentence(0), sentence(1)]).unwrap();
        assert_eq!(
            show(&track),
            "pau 0.120, ow 0.420, pau 0.870, ow 1.170, pau 1.320"
        );
        assert_eq!(track.duration_secs, 1.32);
        assert_eq!(track.samples.len(), 10_560);
        let words: Vec<_> = track
            .words
            .iter()
            .map(|w| (w.text.as_str(), w.start_secs, w.end_secs))
            .collect();
        assert_eq!(words, [("Oh.", 0.12, 0.42), ("Ah.", 0.87, 1.17)]);
    }

    #[test]
    fn breaks_have_their_length_inside_between_and_around() {
        let b = |msec| Said::Break { msec };
        let plan = said(vec![
            b(100),
            text("Oh"),
            b(500),
            text("ah."),
            b(1000),
            text("Eh"),
            b(200),
        ]);
        let first = [
            ("pau", 0.2, None),
            ("ow", 0.3, Some(0)),
            ("pau", 0.11, None),
            ("aa", 0.2, Some(1)),
            ("pau", 0.2, None),
        ];
        let second = [("pau", 0.2, None), ("eh", 0.3, Some(2)), ("pau", 0.2, None)];
        let track = assemble(&plan, vec![spoken(&first), spoken(&second)]).unwrap();
        assert_eq!(
            show(&track),
            "pau 0.220, ow 0.520, pau 1.020, aa 1.220, pau 2.220, eh 2.520, pau 2.870"
        );
    }

    #[test]
    fn the_sound_is_loud_where_phones_speak_and_still_where_they_pause() {
        let plan = said(vec![text("Oh, ah")]);
        let track = assemble(
            &plan,
            vec![spoken(&[
                ("pau", 0.2, None),
                ("ow", 0.3, Some(0)),
                ("pau", 0.15, None),
                ("aa", 0.2, Some(1)),
                ("pau", 0.2, None),
            ])],
        )
        .unwrap();
        assert_eq!(
            show(&track),
            "pau 0.120, ow 0.420, pau 0.570, aa 0.770, pau 0.920"
        );
        for phone in &track.phones {
            let index = |secs: f64| (secs * f64::from(RATE_HZ)).round() as usize;
            let cut = &track.samples[index(phone.start_secs)..index(phone.end_secs)];
            let rms = (cut.iter().map(|s| s * s).sum::<f64>() / cut.len() as f64).sqrt();
            let expected = if phone.symbol == "pau" { 0.0 } else { LOUDNESS };
            assert!((rms - expected).abs() < 1e-3, "{} {rms}", phone.symbol);
        }
    }

    #[test]
    fn a_word_that_the_engine_skips_takes_no_time_and_no_words_are_silence() {
        let plan = said(vec![text("Oh 你 ah")]);
        let track = assemble(
            &plan,
            vec![spoken(&[("ow", 0.3, Some(0)), ("aa", 0.3, Some(2))])],
        )
        .unwrap();
        assert_eq!(
            (track.words[1].start_secs, track.words[1].end_secs),
            (0.42, 0.42)
        );
        let track = assemble(&said(vec![Said::Break { msec: 500 }]), Vec::new()).unwrap();
        assert_eq!(show(&track), "pau 0.620");
        assert!(track.samples.iter().all(|s| *s == 0.0));
    }

    #[test]
    fn sound_that_does_not_fit_its_times_is_refused() {
        let mut bad = spoken(&[("ow", 0.3, Some(0))]);
        bad.samples.truncate(100);
        assert!(assemble(&said(vec![text("Oh")]), vec![bad]).is_err());
    }
}

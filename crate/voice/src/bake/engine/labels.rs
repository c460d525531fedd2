//! Normalisation of an engine's phones: silences are merged, times begin at 0, leave no gap and end
//! with the audio, and every phone belongs to a token.

use anyhow::{Result, ensure};

use super::wave::Wave;
use crate::spoken::{Segment, Spoken, SpokenSyllable};
use raconteur_speech::bundle::SILENCE;

/// Phones shorter than this are no phones, seconds. *Designed*: no glottal pulse fits.
const MIN_SECS: f64 = 0.0005;

/// Phone with its time and token, as reported by an engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Phone {
    /// Symbol of the phone in the engine; empty for silence.
    pub(super) symbol: String,
    /// Seconds from the start of the sentence.
    pub(super) end_secs: f64,
    /// Index of its token.
    pub(super) token: Option<usize>,
    /// Index of its syllable in [`Labels::syllables`].
    pub(super) syllable: Option<usize>,
}

/// Phones, syllables and phrase breaks of a sentence, as reported by an engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Labels {
    /// Phones in order.
    pub(super) phones: Vec<Phone>,
    /// Stress (0 none, 1 primary, 2 secondary) and pitch accent, in order.
    pub(super) syllables: Vec<(u8, String)>,
    /// Phrase breaks, as in [`Spoken::breaks`].
    pub(super) breaks: Vec<(usize, String)>,
}

/// Returns true if the symbol is one of the names of silence.
pub(super) fn is_silence(symbol: &str) -> bool {
    matches!(
        symbol,
        "" | SILENCE | "brth" | "h#" | "#" | "ssil" | "SIL" | "sil" | "_" | "_:" | "_::"
    )
}

/// Returns silence for a sentence with nothing to speak.
pub(super) fn nothing(rate_hz: f64, phone_set: &str) -> Spoken {
    let secs = 0.1;
    Spoken {
        samples: vec![0.0; (secs * rate_hz) as usize],
        rate_hz,
        phone_set: phone_set.to_owned(),
        segments: vec![Segment {
            symbol: SILENCE.to_owned(),
            end_secs: secs,
            token: None,
        }],
        ..Spoken::default()
    }
}

/// Combines audio and phones. Boundaries move `lag_secs` later, to their audible position. Audio
/// after the last phone ends in silence; phones after the end of the audio are cut off.
///
/// # Errors
/// Returns an error if times are not finite or decrease, if there is no audio, or if phones
/// continue for a fifth of a second after the end of the audio.
pub(super) fn finish(
    labels: &Labels,
    wave: Wave,
    phone_set: &str,
    lag_secs: f64,
) -> Result<Spoken> {
    ensure!(
        !wave.samples.is_empty() && wave.rate_hz > 0.0,
        "the engine made no sound"
    );
    let sound_secs = wave.samples.len() as f64 / wave.rate_hz;
    let tokens = owners(&labels.phones);
    let mut spoken = Spoken {
        rate_hz: wave.rate_hz,
        phone_set: phone_set.to_owned(),
        breaks: labels.breaks.clone(),
        ..Spoken::default()
    };
    let mut syllable = None;
    let (mut told_secs, mut end_secs) = (0.0, 0.0);
    for (phone, token) in labels.phones.iter().zip(tokens) {
        ensure!(
            phone.end_secs.is_finite() && phone.end_secs >= told_secs,
            "the phone {} ends at {} s, before it begins",
            phone.symbol,
            phone.end_secs
        );
        told_secs = phone.end_secs;
        let next_secs = (told_secs + lag_secs).clamp(end_secs, sound_secs.max(end_secs));
        if next_secs - end_secs < MIN_SECS {
            continue;
        }
        end_secs = next_secs;
        if is_silence(&phone.symbol) {
            silence(&mut spoken, end_secs);
            syllable = None;
            continue;
        }
        let index = spoken.segments.len();
        spoken.segments.push(Segment {
            symbol: phone.symbol.clone(),
            end_secs,
            token: Some(token),
        });
        match phone.syllable.filter(|s| *s < labels.syllables.len()) {
            Some(s) if syllable == Some(s) => {
                if let Some(last) = spoken.syllables.last_mut() {
                    last.count += 1;
                }
            }
            Some(s) => {
                let (stress, accent) = labels.syllables[s].clone();
                spoken.syllables.push(SpokenSyllable {
                    first: index,
                    count: 1,
                    stress,
                    accent,
                });
                syllable = Some(s);
            }
            None => syllable = None,
        }
    }
    ensure!(
        told_secs <= sound_secs + 0.2,
        "phones end at {told_secs} s, the sound at {sound_secs} s"
    );
    close(&mut spoken, sound_secs);
    spoken.samples = wave.samples;
    Ok(spoken)
}

/// Extends the last segment to the end of the audio: silence is appended after an audible one.
fn close(spoken: &mut Spoken, sound_secs: f64) {
    let end_secs = spoken.segments.last().map_or(0.0, |s| s.end_secs);
    match spoken.segments.last_mut() {
        Some(last) if last.is_silent() || sound_secs - end_secs < 0.01 => {
            last.end_secs = sound_secs;
        }
        _ => silence(spoken, sound_secs),
    }
}

/// Makes the sentence silent until a time.
fn silence(spoken: &mut Spoken, end_secs: f64) {
    match spoken.segments.last_mut() {
        Some(last) if last.is_silent() => last.end_secs = end_secs,
        _ => spoken.segments.push(Segment {
            symbol: SILENCE.to_owned(),
            end_secs,
            token: None,
        }),
    }
}

/// Returns the token of every phone: a phone without a token belongs to that of the preceding
/// phone, at the start to the first.
fn owners(phones: &[Phone]) -> Vec<usize> {
    let mut token = phones.iter().find_map(|p| p.token).unwrap_or(0);
    phones
        .iter()
        .map(|p| {
            token = p.token.unwrap_or(token);
            token
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(phones: &[(&str, f64, Option<usize>, Option<usize>)]) -> Labels {
        Labels {
            phones: phones
                .iter()
                .map(|(symbol, end_secs, token, syllable)| Phone {
                    symbol: (*symbol).to_owned(),
                    end_secs: *end_secs,
                    token: *token,
                    syllable: *syllable,
                })
                .collect(),
            syllables: vec![(0, String::new()), (1, "H*".to_owned())],
            breaks: Vec::new(),
        }
    }

    fn sound(secs: f64) -> Wave {
        Wave {
            samples: vec![0.0; (secs * 1000.0) as usize],
            rate_hz: 1000.0,
        }
    }

    fn told(spoken: &Spoken) -> Vec<(&str, i64, Option<usize>)> {
        spoken
            .segments
            .iter()
            .map(|s| {
                (
                    s.symbol.as_str(),
                    (s.end_secs * 1e3).round() as i64,
                    s.token,
                )
            })
            .collect()
    }

    #[test]
    fn silences_are_one_and_every_sound_has_a_token() {
        let labels = labels(&[
            ("h#", 0.1, None, None),
            ("_", 0.2, None, None),
            ("h", 0.3, None, Some(0)),
            ("e", 0.3, Some(0), Some(0)),
            ("l", 0.4, Some(0), Some(1)),
            ("ow", 0.5, None, Some(1)),
            ("_:", 0.6, Some(0), None),
            ("?", 0.7, None, None),
        ]);
        let spoken = finish(&labels, sound(1.0), "radio", 0.0).unwrap();
        assert_eq!(
            told(&spoken),
            [
                ("pau", 200, None),
                ("h", 300, Some(0)),
                ("l", 400, Some(0)),
                ("ow", 500, Some(0)),
                ("pau", 600, None),
                ("?", 700, Some(0)),
                ("pau", 1000, None)
            ]
        );
        let syllables: Vec<_> = spoken
            .syllables
            .iter()
            .map(|s| (s.first, s.count, s.stress, s.accent.as_str()))
            .collect();
        assert_eq!(syllables, [(1, 1, 0, ""), (2, 2, 1, "H*")]);
    }

    #[test]
    fn a_lag_moves_all_ends_but_the_last() {
        let labels = labels(&[
            ("pau", 0.1, None, None),
            ("m", 0.2, Some(0), None),
            ("pau", 0.3, None, None),
        ]);
        let ends = |lag_secs| -> Vec<i64> {
            let spoken = finish(&labels, sound(0.3), "radio", lag_secs).unwrap();
            told(&spoken).iter().map(|s| s.1).collect()
        };
        assert_eq!(ends(0.0), [100, 200, 300]);
        assert_eq!(ends(0.009), [109, 209, 300]);
        assert_eq!(ends(-0.02), [80, 180, 300]);
        assert_eq!(ends(0.15), [250, 300], "what is past the end is cut off");
    }

    #[test]
    fn times_that_cannot_be_are_errors() {
        for bad in [
            labels(&[("m", f64::NAN, Some(0), None)]),
            labels(&[("m", 0.2, Some(0), None), ("a", 0.1, Some(0), None)]),
            labels(&[("m", 0.6, Some(0), None)]),
        ] {
            assert!(
                finish(&bad, sound(0.3), "radio", 0.0).is_err(),
                "impossible times are rejected"
            );
        }
        assert!(
            finish(&Labels::default(), sound(0.0), "radio", 0.0).is_err(),
            "empty labels are rejected"
        );
        let empty = finish(&Labels::default(), sound(0.3), "radio", 0.0).unwrap();
        assert_eq!(told(&empty), [("pau", 300, None)]);
    }
}

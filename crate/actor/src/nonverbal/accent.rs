//! Accented syllables of an utterance (F&H section 4.3.5).

use raconteur_speech::Utterance;

/// Strength of the accents of an emphasised word; 1 is an ordinary accent. Designed.
const EMPHASIS_ACCENT: f64 = 1.4;
/// Maximum duration of the accent of an emphasised word without known syllables, seconds. Designed.
const SYLLABLE_SECS: f64 = 0.3;

/// Accented syllable of an utterance with its interval, strength and ToBI label; head and gaze
/// react to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Accent {
    /// Seconds from the start of the utterance.
    pub(super) start_secs: f64,
    /// Seconds from the start of the utterance.
    pub(super) end_secs: f64,
    /// 0..2; 1 is an ordinary accent.
    pub(super) strength: f64,
    /// ToBI label of the accent, for example `H*`; empty or `*` if unknown.
    pub(super) label: String,
}

/// Returns the accents of an utterance in order of time. Without known accents, it uses the
/// beginnings of emphasised words.
pub(super) fn known(u: &Utterance) -> Vec<Accent> {
    let is_emphasized = |word: usize| u.words.get(word).is_some_and(|w| w.emphasized);
    let known = u.accents.iter().filter_map(|accent| {
        let ([start_secs, end_secs], word) = u.accented(accent)?;
        let strong = word.is_some_and(is_emphasized);
        Some(Accent {
            start_secs,
            end_secs,
            strength: if strong { EMPHASIS_ACCENT } else { 1.0 },
            label: accent.label.clone(),
        })
    });
    let known: Vec<Accent> = known.collect();
    if !known.is_empty() {
        return known;
    }
    let emphasized = u.words.iter().filter(|w| w.emphasized);
    emphasized
        .map(|w| Accent {
            start_secs: w.start_secs,
            end_secs: w.start_secs + (w.end_secs - w.start_secs).min(SYLLABLE_SECS),
            strength: EMPHASIS_ACCENT,
            label: String::new(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_speech::bundle::{Accent as Label, Syllable};
    use raconteur_speech::{Phone, Word};

    /// Creates a test utterance of two words with one syllable each, the second emphasised.
    fn two_words() -> Utterance {
        let word = |start_secs: f64, emphasized| Word {
            text: "word".to_owned(),
            start_secs,
            end_secs: start_secs + 0.5,
            emphasized,
        };
        Utterance {
            words: vec![word(0.0, false), word(0.5, true)],
            phones: (0..4)
                .map(|i| {
                    let start_secs = 0.25 * f64::from(i);
                    Phone::new("aa", start_secs, start_secs + 0.25, Some(i as usize / 2))
                })
                .collect(),
            syllables: [0, 2]
                .map(|first_phone| Syllable {
                    first_phone,
                    phones: 2,
                    stress: 1,
                })
                .to_vec(),
            ..Utterance::default()
        }
    }

    #[test]
    fn accents_last_as_long_as_their_syllables() {
        let mut u = two_words();
        u.accents = [0, 1, 7]
            .map(|syllable| Label {
                syllable,
                label: "H*".to_owned(),
            })
            .to_vec();
        let accents = known(&u);
        let times: Vec<[f64; 2]> = accents.iter().map(|a| [a.start_secs, a.end_secs]).collect();
        assert_eq!(times, [[0.0, 0.5], [0.5, 1.0]]);
        assert_eq!(accents[0].label, "H*");
        assert!(
            accents[0].strength < accents[1].strength,
            "the second accent is stronger"
        );
    }

    #[test]
    fn without_accents_emphasised_words_have_them() {
        let accents = known(&two_words());
        assert_eq!(accents.len(), 1);
        assert_eq!((accents[0].start_secs, accents[0].end_secs), (0.5, 0.8));
        assert!(
            accents[0].strength > 1.0 && accents[0].label.is_empty(),
            "an emphasised word has an accent without a label"
        );
    }
}

//! Comparison of an utterance's audio with its bundle: pauses are silent, plosives burst at their
//! phones, vowels are voiced.

use crate::manner::{Manner, manner};
use crate::signal::{bursts, f0, intensity};
use raconteur_speech::bundle::{SILENCE, Utterance};

/// A burst is at its phone when it is no further from it than this, seconds.
const BURST_SECS: f64 = 0.02;
/// Distance from a plosive within which a burst may be its own, seconds.
const ASTRAY_SECS: f64 = 0.05;
/// A pause fades from the speech before it for this long and into the speech after it for
/// half of it, seconds.
const FADE_SECS: f64 = 0.06;
/// Time between frames of the pitch, seconds.
const STEP_SECS: f64 = 0.005;

/// Proportion of cases in which a condition holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Proportion {
    /// Number of cases in which it holds.
    pub count: usize,
    /// Total number of cases.
    pub of: usize,
}

impl Proportion {
    fn count(&mut self, holds: bool) {
        self.count += usize::from(holds);
        self.of += 1;
    }

    /// Adds the counts of another proportion.
    pub fn add(&mut self, other: Self) {
        self.count += other.count;
        self.of += other.of;
    }

    /// Returns the proportion in percent; 100 if there are no cases.
    #[must_use]
    pub fn percent(self) -> f64 {
        if self.of == 0 {
            100.0
        } else {
            100.0 * self.count as f64 / self.of as f64
        }
    }
}

/// Energy over samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Power {
    sum: f64,
    count: usize,
}

impl Power {
    fn measure(sound: &[f64]) -> Self {
        Self {
            sum: sound.iter().map(|s| s * s).sum(),
            count: sound.len(),
        }
    }

    fn add(&mut self, other: Self) {
        self.sum += other.sum;
        self.count += other.count;
    }

    fn db(self) -> f64 {
        intensity::decibels(self.sum / self.count.max(1) as f64)
    }
}

/// Measurements of synthesised audio, compared with the phones of its labels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeasuredSpeech {
    /// Plosive bursts that were found, at their phones.
    pub bursts: Proportion,
    /// Vowels whose middles are voiced, except final ones.
    pub vowels: Proportion,
    /// Final vowels whose middles are voiced: the last ones before pauses, in syllables without
    /// stress. Speakers of some languages whisper them (for Portuguese: doi:10.1159/000439599).
    pub final_vowels: Proportion,
    speech: Power,
    pauses: Power,
}

impl MeasuredSpeech {
    /// Adds the measurements of another audio.
    pub fn add(&mut self, other: &Self) {
        self.bursts.add(other.bursts);
        self.vowels.add(other.vowels);
        self.final_vowels.add(other.final_vowels);
        self.speech.add(other.speech);
        self.pauses.add(other.pauses);
    }

    /// Returns the level of speech above the level of its pauses, decibels.
    #[must_use]
    pub fn pauses_under_db(&self) -> f64 {
        self.speech.db() - self.pauses.db()
    }
}

/// Listens to the sound of an utterance, one channel.
#[must_use]
pub fn measure_speech(
    utterance: &Utterance,
    phone_set: &str,
    samples: &[f64],
    rate_hz: f64,
) -> MeasuredSpeech {
    let mut heard = MeasuredSpeech::default();
    let track = f0::track_voice(samples, rate_hz, STEP_SECS);
    let part = |from: f64, to: f64| {
        let at = |secs: f64| ((secs.max(0.0) * rate_hz) as usize).min(samples.len());
        let (from, to) = (at(from), at(to));
        Power::measure(&samples[from..to.max(from)])
    };
    for (i, phone) in utterance.phones.iter().enumerate() {
        let (from, to) = (phone.start_secs, phone.end_secs);
        if phone.symbol == SILENCE {
            heard
                .pauses
                .add(part(from + FADE_SECS, to - FADE_SECS / 2.0));
            continue;
        }
        heard.speech.add(part(from, to));
        match manner(phone_set, &phone.symbol) {
            Manner::Plosive => {
                if let Some(there) = burst(utterance, i, phone_set, samples, rate_hz) {
                    heard.bursts.count(there);
                }
            }
            Manner::Vowel => {
                let (middle, sixth) = ((from + to) / 2.0, (to - from) / 6.0);
                let share = track.voiced_share(middle - sixth, middle + sixth);
                let vowels = if is_final(utterance, i, phone_set) {
                    &mut heard.final_vowels
                } else {
                    &mut heard.vowels
                };
                vowels.count(share > 0.0);
            }
            _ => {}
        }
    }
    heard
}

/// Returns true if a vowel is the last one before a pause, in a syllable without stress.
fn is_final(utterance: &Utterance, index: usize, phone_set: &str) -> bool {
    let rest = utterance.phones.iter().skip(index + 1);
    let mut rest = rest.take_while(|phone| phone.symbol != SILENCE);
    let mut syllables = utterance.syllables.iter();
    let unstressed = syllables.any(|syllable| {
        let phones = syllable.first_phone..syllable.first_phone + syllable.phones;
        syllable.stress == 0 && phones.contains(&index)
    });
    unstressed && !rest.any(|phone| manner(phone_set, &phone.symbol) == Manner::Vowel)
}

/// Returns true if the burst of a plosive is at its phone; `None` if there is no clear burst.
fn burst(
    utterance: &Utterance,
    index: usize,
    phone_set: &str,
    samples: &[f64],
    rate_hz: f64,
) -> Option<bool> {
    let phone = &utterance.phones[index];
    let is_sharp = |symbol: &str| {
        matches!(
            manner(phone_set, symbol),
            Manner::Plosive | Manner::Fricative
        )
    };
    // Two plosives in a row share a burst.
    let next = utterance.phones.get(index + 1);
    if next.is_some_and(|n| manner(phone_set, &n.symbol) == Manner::Plosive) {
        return None;
    }
    let within = |secs: f64| {
        let (from, to) = (phone.start_secs - secs, phone.end_secs + secs);
        bursts::find(samples, rate_hz, from, to)
    };
    if within(BURST_SECS).is_some() {
        return Some(true);
    }
    let astray = within(ASTRAY_SECS)?;
    // Friction begins sharply as well: friction at another consonant belongs to that one.
    let of_another = utterance.phones.iter().enumerate().any(|(k, other)| {
        let at = other.start_secs - BURST_SECS..other.end_secs + BURST_SECS;
        k != index && is_sharp(&other.symbol) && at.contains(&astray.secs)
    });
    (!of_another).then_some(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::ops;
    use raconteur_speech::bundle::{Phone, Syllable};

    const RATE_HZ: f64 = 16_000.0;

    /// Returns phones of a tenth of a second each, and a sound with a click at the given time after
    /// the start of the plosive.
    fn spoken(click_secs: f64, hz: f64) -> (Utterance, Vec<f64>) {
        let mut utterance = Utterance::default();
        for (i, symbol) in ["pau", "aa", "t", "aa", "pau"].into_iter().enumerate() {
            let start_secs = 0.1 * i as f64;
            let word = (symbol != "pau").then_some(0);
            let phone = Phone::new(symbol, start_secs, start_secs + 0.1, word);
            utterance.phones.push(phone);
        }
        let mut samples = vec![0.0; 8_000];
        for (i, sample) in samples.iter_mut().enumerate() {
            let secs = i as f64 / RATE_HZ;
            if (0.1..0.2).contains(&secs) || (0.35..0.4).contains(&secs) {
                *sample = (1..5)
                    .map(|h| 0.05 * ops::sin(secs * hz * f64::from(h) * core::f64::consts::TAU))
                    .sum();
            }
            let click = secs - 0.2 - click_secs;
            if (0.0..0.01).contains(&click) {
                // Noise of a kind: every second sample up, every second down.
                *sample += if i % 2 == 0 { 0.3 } else { -0.3 };
            }
        }
        (utterance, samples)
    }

    #[test]
    fn a_burst_is_at_its_phone_or_it_is_not() {
        let heard = |secs| {
            let (utterance, samples) = spoken(secs, 150.0);
            measure_speech(&utterance, "radio", &samples, RATE_HZ).bursts
        };
        assert_eq!(heard(0.08), Proportion { count: 1, of: 1 });
        assert_eq!(heard(0.135), Proportion { count: 0, of: 1 });
        assert_eq!(heard(9.0).of, 0);
    }

    #[test]
    fn vowels_are_voiced_and_pauses_are_still() {
        let (utterance, samples) = spoken(0.08, 150.0);
        let heard = measure_speech(&utterance, "radio", &samples, RATE_HZ);
        assert_eq!(heard.vowels.of, 2);
        assert!(
            heard.pauses_under_db() > 35.0,
            "the pauses are at least 35 dB below the speech"
        );
        let mut unstressed = utterance;
        for (first_phone, stress) in [(1, 0), (2, 0)] {
            let phones = first_phone;
            unstressed.syllables.push(Syllable {
                first_phone,
                phones,
                stress,
            });
        }
        let heard = measure_speech(&unstressed, "radio", &samples, RATE_HZ);
        assert_eq!((heard.vowels.of, heard.final_vowels.of), (1, 1));
        let (utterance, silent) = spoken(0.08, 0.0);
        let heard = measure_speech(&utterance, "radio", &silent, RATE_HZ);
        assert_eq!(heard.vowels.count, 0);
        assert_eq!(Proportion::default().percent(), 100.0);
    }
}

//! espeak-ng: formant voices of about a hundred languages.

mod traced;
mod voices;

use crate::spoken::{Sentence, Spoken};
use anyhow::{Context as _, Result};

pub use super::espeak_events::{Event, EventKind, Synthesis};
use super::labels::{self, Labels, Phone};
use super::wave::Wave;
use super::{Engine, VoiceInfo, matching, punctuation};
use crate::ipa::{self, Set};
pub use traced::{TracedText, named};

/// Loudest sample of a closure. *Designed*: a hundredth of the usual level.
const QUIET: u16 = 100;

/// Longest closure, seconds. *Designed*.
const MAX_CLOSURE_SECS: f64 = 0.12;

/// Environment that runs espeak-ng: the installed library, or a stub without it.
pub trait Host: Send + Sync {
    /// Returns the version of espeak-ng.
    ///
    /// # Errors
    /// Returns an error if espeak-ng is not available.
    fn version(&self) -> Result<String>;

    /// Returns the files below a folder of espeak-ng's data, sorted, as paths relative to that
    /// folder.
    ///
    /// # Errors
    /// Returns an error if the data is not available.
    fn files(&self, folder: &str) -> Result<Vec<String>>;

    /// Returns the text of a file of its data; empty if it does not exist.
    ///
    /// # Errors
    /// Returns an error if the data is not available.
    fn text(&self, path: &str) -> Result<String>;

    /// Speaks texts with a voice: one [`Synthesis`] for each. The result does not depend on the
    /// order of the texts. In texts, `[[` and `]]` enclose mnemonics.
    ///
    /// # Errors
    /// Returns an error if espeak-ng has no such voice, or if it fails.
    fn speak(&self, voice: &str, texts: &[String]) -> Result<Vec<Synthesis>>;
}

/// Speech engine based on espeak-ng, run by a host.
pub struct Espeak<H>(pub H);

impl<H: Host> Engine for Espeak<H> {
    fn version(&self) -> Result<String> {
        Ok(format!("espeak-ng {}", self.0.version()?))
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        voices::all(&self.0)
    }

    fn voice(&self, name: &str) -> Result<Option<VoiceInfo>> {
        voices::named(&self.0, name)
    }

    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        let base = voices::known(voice, &self.0)?;
        let set = set(base);
        let voice = &voice.replacen(base, &voices::file_of(base), 1);
        let mut texts = Vec::with_capacity(sentences.len());
        for sentence in sentences {
            texts.push(Text::from_sentence(sentence, set)?);
        }
        let written: Vec<String> = texts.iter().map(|t| t.written.clone()).collect();
        let said = self.0.speak(voice, &written)?;
        texts
            .iter()
            .zip(said)
            .map(|(text, said)| text.to_spoken(&said, &self.0, voice, set))
            .collect()
    }
}

/// Returns the phone set of a language.
fn set(language: &str) -> Set {
    match language.split('-').next() {
        Some("de") => Set::EspeakDe,
        Some("pt") => Set::EspeakPt,
        _ => Set::Espeak,
    }
}

/// Returns the name of a phone set in bundles.
fn phone_set(set: Set) -> &'static str {
    match set {
        Set::EspeakDe => "espeak-de",
        Set::EspeakPt => "espeak-pt",
        _ => "espeak",
    }
}

/// A sentence as the library reads it.
#[derive(Debug, Default)]
struct Text {
    written: String,
    /// For every spoken token: the number of characters before it, and its index.
    starts: Vec<(usize, usize)>,
}

impl Text {
    /// Puts tokens together. Brackets, with which phones could be written, are left out.
    fn from_sentence(sentence: &Sentence, set: Set) -> Result<Self> {
        let mut text = Self::default();
        let mut length = 0;
        for (t, token) in sentence.tokens.iter().enumerate() {
            let word = match &token.ipa {
                Some(ipa) => {
                    mnemonics(ipa, set).with_context(|| format!("the word {:?}", token.text))?
                }
                None => readable(&token.text),
            };
            if word.is_empty() {
                continue;
            }
            let ends = (t + 1 == sentence.tokens.len()).then_some(sentence.kind);
            let piece = format!("{word}{} ", punctuation(token, ends));
            text.starts.push((length, t));
            length += piece.chars().count();
            text.written.push_str(&piece);
        }
        Ok(text)
    }

    /// Returns the token that contains a character, counted from 1; `None` before the first.
    fn token(&self, position: usize) -> Option<usize> {
        let after = self.starts.partition_point(|(start, _)| *start < position);
        Some(self.starts.get(after.checked_sub(1)?)?.1)
    }

    fn to_spoken(
        &self,
        said: &Synthesis,
        host: &dyn Host,
        voice: &str,
        set: Set,
    ) -> Result<Spoken> {
        let rate_hz = f64::from(said.rate_hz);
        if said.samples.is_empty() || self.starts.is_empty() {
            return Ok(labels::nothing(rate_hz, phone_set(set)));
        }
        let mut labels = self.labels(said);
        self.split_shared_phones(&mut labels, host, voice, set)?;
        syllables(&mut labels, &said.marked, set)?;
        let wave = Wave {
            samples: said
                .samples
                .iter()
                .map(|s| f64::from(*s) / 32_768.0)
                .collect(),
            rate_hz,
        };
        labels::finish(&labels, wave, phone_set(set), 0.0)
    }

    /// Returns the phones and their tokens, as far as events specify them.
    fn labels(&self, said: &Synthesis) -> Labels {
        let mut labels = Labels::default();
        let mut starts: Vec<usize> = Vec::new();
        let (mut token, mut word) = (None, None);
        for Event { sample, what } in &said.events {
            match what {
                EventKind::Word(position) => {
                    token = self.token(*position);
                    word = Some(*sample);
                }
                // A change of language within a sentence.
                EventKind::Phone(symbol) if symbol.starts_with('(') => {}
                EventKind::Phone(symbol) => {
                    // A stop's event is its burst; that of its word precedes its closure.
                    starts.push(word.take().unwrap_or(*sample));
                    labels.phones.push(Phone {
                        // A t that a vowel after it may change; the sound is that of t.
                        symbol: if symbol == "t2" { "t" } else { symbol }.to_owned(),
                        token: token.filter(|_| !labels::is_silence(symbol)),
                        ..Phone::default()
                    });
                }
                EventKind::End => {
                    if let Some(last) = token
                        && labels.breaks.last().is_none_or(|b| b.0 < last)
                    {
                        labels.breaks.push((last, String::new()));
                    }
                }
            }
        }
        share(&mut starts, &labels.phones);
        closures(&mut starts, &labels.phones, &said.samples, said.rate_hz);
        let end = said.samples.len();
        for (i, phone) in labels.phones.iter_mut().enumerate() {
            let next = starts.get(i + 1).copied().unwrap_or(end).min(end);
            phone.end_secs = next as f64 / f64::from(said.rate_hz);
        }
        labels
    }

    /// Assigns phones to tokens that the library reads together with the preceding token (*of a*,
    /// *on the*): their isolated pronunciation determines the split.
    fn split_shared_phones(
        &self,
        labels: &mut Labels,
        host: &dyn Host,
        voice: &str,
        set: Set,
    ) -> Result<()> {
        let tokens: Vec<usize> = self.starts.iter().map(|s| s.1).collect();
        let has = |labels: &Labels, t: usize| labels.phones.iter().any(|p| p.token == Some(t));
        let mut at = 0;
        while at < tokens.len() {
            let silent = tokens[at + 1..]
                .iter()
                .take_while(|t| !has(labels, **t))
                .count();
            if silent > 0 && has(labels, tokens[at]) {
                let words: Vec<String> = (at..=at + silent).map(|i| self.word(i)).collect();
                let said = host.speak(voice, &words)?;
                let known: Vec<(usize, String)> = said
                    .iter()
                    .enumerate()
                    .flat_map(|(i, s)| s.marked.iter().map(move |m| (at + i, bare(m))))
                    .collect();
                let heard: Vec<usize> = (0..labels.phones.len())
                    .filter(|i| labels.phones[*i].token == Some(tokens[at]))
                    .collect();
                let pairs = matching::matched(&known, &heard, |k, h| {
                    unlike(&k.1, &bare(&labels.phones[*h].symbol), set)
                })?;
                let mut token = tokens[at];
                for (index, pair) in heard.into_iter().zip(pairs) {
                    token = pair.map_or(token, |k| tokens[known[k].0]);
                    labels.phones[index].token = Some(token);
                }
            }
            at += 1 + silent;
        }
        Ok(())
    }

    /// Returns the written form of one of [`Text::starts`].
    fn word(&self, index: usize) -> String {
        let start = self.starts[index].0;
        let end = self.starts.get(index + 1).map_or(usize::MAX, |s| s.0);
        self.written.chars().skip(start).take(end - start).collect()
    }
}

/// Gives time to phones that start where the next one does: the library lets a vowel end as the
/// following nasal or lateral and reports it only at the end. It gets the last third of the vowel.
/// *Designed*.
fn share(starts: &mut [usize], phones: &[Phone]) {
    for i in 1..starts.len().saturating_sub(1) {
        let sounds = |p: &Phone| !labels::is_silence(&p.symbol);
        if starts[i + 1] == starts[i]
            && sounds(&phones[i])
            && !phones[i].symbol.starts_with('_')
            && sounds(&phones[i - 1])
            && phones[i - 1].token == phones[i].token
        {
            starts[i] -= (starts[i] - starts[i - 1].min(starts[i])) / 3;
        }
    }
}

/// Moves the start of stops to their closure. Their events are at the burst, and the silence of
/// about 40 ms before it (*measured*: vowels sound until 39 ms before the event of a voiceless
/// stop) would belong to the preceding phone.
fn closures(starts: &mut [usize], phones: &[Phone], samples: &[i16], rate_hz: u32) {
    let longest = (MAX_CLOSURE_SECS * f64::from(rate_hz)) as usize;
    for i in 1..starts.len().min(phones.len()) {
        let stop = phones[i]
            .symbol
            .starts_with(['p', 't', 'k', 'b', 'd', 'g', 'c']);
        if !stop || labels::is_silence(&phones[i - 1].symbol) {
            continue;
        }
        let (before, burst) = (starts[i - 1], starts[i].min(samples.len()));
        // At least half of the phone before stays.
        let earliest = burst.saturating_sub(longest).max(before.midpoint(burst));
        let quiet = samples[earliest.min(burst)..burst]
            .iter()
            .rev()
            .take_while(|s| s.unsigned_abs() <= QUIET)
            .count();
        starts[i] = burst - quiet;
    }
}

/// Returns a mnemonic without marks of stress and length.
fn bare(name: &str) -> String {
    name.trim_matches(['\'', ',', '%', '=']).to_owned()
}

/// Returns the difference of two mnemonics.
fn unlike(a: &str, b: &str, set: Set) -> u32 {
    if a == b {
        0
    } else if ipa::is_vowel(a, set) == ipa::is_vowel(b, set) {
        2
    } else {
        5
    }
}

/// Parts the phones of each token into syllables, with the stress of their vowels.
fn syllables(labels: &mut Labels, marked: &[String], set: Set) -> Result<()> {
    let stress = |name: &str| match name.as_bytes().first() {
        Some(b'\'') => 1,
        Some(b',') => 2,
        _ => 0,
    };
    let known: Vec<(String, u8)> = marked
        .iter()
        .filter(|m| !m.starts_with(['_', '(']))
        .map(|m| (bare(m), stress(m)))
        .collect();
    let heard: Vec<(usize, String)> = labels
        .phones
        .iter()
        .enumerate()
        .filter(|(_, p)| p.token.is_some() && !p.symbol.starts_with('_'))
        .map(|(i, p)| (i, bare(&p.symbol)))
        .collect();
    let pairs = matching::matched(&known, &heard, |k, h| unlike(&k.0, &h.1, set))?;
    let mut at = 0;
    while at < heard.len() {
        let token = labels.phones[heard[at].0].token;
        let count = heard[at..]
            .iter()
            .take_while(|(i, _)| labels.phones[*i].token == token)
            .count();
        let word = &heard[at..at + count];
        let mut starts = ipa::starts(word.iter().map(|(_, name)| name.as_str()), set);
        starts.push(count);
        for pair in starts.windows(2) {
            let stress = (at + pair[0]..at + pair[1])
                .filter_map(|h| pairs[h])
                .map(|k| known[k].1)
                .filter(|s| *s > 0)
                .min()
                .unwrap_or(0);
            for (index, _) in &word[pair[0]..pair[1]] {
                labels.phones[*index].syllable = Some(labels.syllables.len());
            }
            labels.syllables.push((stress, String::new()));
        }
        at += count;
    }
    Ok(())
}

/// Returns the readable part of a token: letters, digits and characters within words.
fn readable(text: &str) -> String {
    let kept: String = text
        .chars()
        .map(|c| if c == '\u{2019}' { '\'' } else { c })
        .filter(|c| {
            // Combining marks are letters' parts.
            c.is_alphanumeric() || "'-.%&+@€$£°/".contains(*c) || ('\u{300}'..'\u{370}').contains(c)
        })
        .take(super::MAX_CHARACTERS)
        .collect();
    if kept
        .chars()
        .any(|c| c.is_alphanumeric() || "%&+@€$£°".contains(c))
    {
        kept
    } else {
        String::new()
    }
}

/// Converts an IPA pronunciation to the library's input: mnemonics in double brackets.
fn mnemonics(ipa: &str, set: Set) -> Result<String> {
    let mut out = "[[".to_owned();
    for syllable in ipa::syllables(ipa, set)? {
        for phone in &syllable.phones {
            // Stress marks precede the vowel.
            if ipa::is_vowel(phone, set) {
                out.push_str(
                    ["", "'", ","]
                        .get(usize::from(syllable.stress))
                        .unwrap_or(&""),
                );
            }
            out.push_str(phone);
            // A separator prevents reading it as one mnemonic with the next.
            out.push('|');
        }
    }
    out.push_str("]]");
    Ok(out)
}

#[cfg(test)]
mod tests;

//! flite 2: small voices of American English.
//!
//! It prints phones and their times without words, so each token is also spoken separately, and the
//! phones of the sentence are matched with those of its tokens.

use std::fs;
use std::path::Path;

use crate::content::Gender;
use crate::spoken::{Sentence, Spoken};
use anyhow::{Context as _, Result, ensure};

use super::super::program::Program;
use super::labels::{self, Labels, Phone};
use super::{Engine, VoiceInfo, matching, punctuation, scheme, wave};
use crate::ipa::{self, Set};

const FLITE: Program = Program {
    name: "flite",
    package: "flite",
};

/// General voices: name, sex, sample rate in hertz, synthesis method, and delay of the audio
/// relative to the labels, seconds. *Measured* on 53 to 60 s of each: vowels end late before
/// voiceless sounds by 5 (awb), 14 (kal16), 10 (rms) and 21 ms (slt; medians of 68 to 70), and the
/// bursts of stops that lie within 20 ms of their labels rise with these shifts from 88 to 100 of
/// 128, stay 133 of 136 without one, 125 of 138, and rise from 59 to 65 of 70.
const VOICES: [(&str, Gender, f64, &str, f64); 5] = [
    (
        "awb",
        Gender::Male,
        16_000.0,
        "statistical, from clusters",
        0.010,
    ),
    ("kal", Gender::Male, 8_000.0, "diphones", 0.0),
    ("kal16", Gender::Male, 16_000.0, "diphones", 0.0),
    (
        "rms",
        Gender::Male,
        16_000.0,
        "statistical, from clusters",
        0.005,
    ),
    (
        "slt",
        Gender::Female,
        16_000.0,
        "statistical, from clusters",
        0.015,
    ),
];

/// Environment that runs flite, for example the installed program.
pub trait Host: Send + Sync {
    /// Runs flite with arguments in a folder that contains some files, by name and text, and
    /// returns its output; with `sound`, also the WAV that it writes as [`SOUND`].
    ///
    /// # Errors
    /// Returns an error if flite is not available or fails.
    fn run(&self, arguments: &[&str], files: &[(&str, &str)], sound: bool) -> Result<Output>;
}

/// Output of one run of flite.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Output {
    /// Standard output of the program.
    pub printed: String,
    /// Bytes of the WAV file; empty if not requested.
    pub wave: Vec<u8>,
}

/// Name of the WAV file to which flite writes the audio.
pub const SOUND: &str = "said.wav";

/// Host that runs the flite program installed on this machine.
pub(super) struct Installed;

impl Host for Installed {
    fn run(&self, arguments: &[&str], files: &[(&str, &str)], sound: bool) -> Result<Output> {
        let folder = tempfile::tempdir().context("making a folder for the engine")?;
        let path: &Path = folder.path();
        for (name, text) in files {
            fs::write(path.join(name), text)?;
        }
        let mut command = FLITE.command();
        command.args(arguments).current_dir(path);
        let printed = FLITE.run(command)?;
        let wave = if sound {
            wave::bytes(&path.join(SOUND))?
        } else {
            Vec::new()
        };
        Ok(Output { printed, wave })
    }
}

/// Speech engine based on flite, run by a host.
pub struct Flite<H>(pub H);

impl<H: Host> Engine for Flite<H> {
    fn version(&self) -> Result<String> {
        let said = match self.0.run(&["--version"], &[], false) {
            Ok(said) => said.printed,
            // It prints its version and then fails.
            Err(error) if format!("{error:#}").contains("version:") => format!("{error:#}"),
            Err(error) => return Err(error),
        };
        let number = said
            .split_once("flite-")
            .map(|(_, rest)| rest.split(|c: char| c.is_whitespace() || c == '-'))
            .and_then(|mut words| words.next());
        Ok(format!("flite {}", number.unwrap_or("unknown")))
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        let said = self.0.run(&["-lv"], &[], false)?.printed;
        let has = |name: &str| said.split_whitespace().any(|w| w == name);
        Ok(VOICES
            .iter()
            .filter(|v| has(v.0))
            .map(|(name, gender, rate_hz, what, _)| VoiceInfo {
                name: (*name).to_owned(),
                language: if *name == "awb" { "en-GB" } else { "en-US" }.to_owned(),
                gender: Some(*gender),
                phone_set: "radio".to_owned(),
                rate_hz: *rate_hz,
                what: (*what).to_owned(),
            })
            .collect())
    }

    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        let Some((_, _, rate_hz, _, lag_secs)) = VOICES.iter().find(|v| v.0 == voice) else {
            let names: Vec<&str> = VOICES.iter().map(|v| v.0).collect();
            anyhow::bail!(
                "flite has no voice {voice:?}; there are {}",
                names.join(", ")
            );
        };
        sentences
            .iter()
            .map(|sentence| {
                let text = Text::from_sentence(sentence)?;
                if text.words.is_empty() {
                    return Ok(labels::nothing(*rate_hz, "radio"));
                }
                text.to_spoken(&self.0, voice, *lag_secs)
            })
            .collect()
    }
}

/// A sentence as flite reads it.
#[derive(Debug, Default)]
struct Text {
    /// Index and text of each spoken token.
    words: Vec<(usize, String)>,
    /// The whole.
    written: String,
    /// Pronunciations, in its format of lexicon entries.
    lexicon: String,
}

impl Text {
    fn from_sentence(sentence: &Sentence) -> Result<Self> {
        let mut text = Self::default();
        for (t, token) in sentence.tokens.iter().enumerate() {
            let word = match &token.ipa {
                Some(ipa) => {
                    // A word in no lexicon, in letters only.
                    let name = format!("raconteuri{}", scheme::spelled(t));
                    text.lexicon.push_str(&format!("{name} nil :"));
                    for syllable in ipa::syllables(ipa, Set::Radio)
                        .with_context(|| format!("the word {:?}", token.text))?
                    {
                        for phone in &syllable.phones {
                            let mark = match ipa::is_vowel(phone, Set::Radio) {
                                true if syllable.stress > 0 => "1",
                                true => "0",
                                false => "",
                            };
                            text.lexicon.push_str(&format!(" {phone}{mark}"));
                        }
                    }
                    text.lexicon.push('\n');
                    name
                }
                None => scheme::plain(&token.text),
            };
            if word.is_empty() {
                continue;
            }
            let ends = (t + 1 == sentence.tokens.len()).then_some(sentence.kind);
            let mark = punctuation(token, ends);
            text.written.push_str(&format!("{word}{mark} "));
            text.words.push((t, word));
        }
        Ok(text)
    }

    fn to_spoken(&self, host: &dyn Host, voice: &str, lag_secs: f64) -> Result<Spoken> {
        let Output {
            printed: timed,
            wave: sound,
        } = self.run(host, voice, &self.written, "-psdur", SOUND)?;
        let heard = timed_phones(&timed)?;
        // Two empty lines separate tokens that are spoken separately.
        let words: Vec<&str> = self.words.iter().map(|(_, w)| w.as_str()).collect();
        let parted = format!("{}\n\n\n", words.join("\n\n\n"));
        let alone = self.run(host, voice, &parted, "-ps", "none")?.printed;
        let alone: Vec<&str> = alone.lines().filter(|l| !l.trim().is_empty()).collect();
        ensure!(
            alone.len() == words.len(),
            "flite spoke {} of {} words alone",
            alone.len(),
            words.len()
        );
        let known: Vec<(usize, &str)> = self
            .words
            .iter()
            .zip(alone)
            .flat_map(|((token, _), line)| {
                let phones = line.split_whitespace().filter(|p| !labels::is_silence(p));
                phones.map(|p| (*token, p))
            })
            .collect();
        let labels = joined(&known, heard)?;
        let sound = wave::decode(&sound).context("reading the sound")?;
        labels::finish(&labels, sound, "radio", lag_secs)
    }

    /// Runs flite on a text. Texts go through files.
    fn run(
        &self,
        host: &dyn Host,
        voice: &str,
        text: &str,
        print: &str,
        sound: &str,
    ) -> Result<Output> {
        let mut arguments = vec!["-voice", voice];
        let mut files = vec![("text.txt", text)];
        if !self.lexicon.is_empty() {
            arguments.extend(["-add_lex", "lexicon.txt"]);
            files.push(("lexicon.txt", &self.lexicon));
        }
        if print == "-ps" {
            arguments.extend(["-f", "text.txt"]);
        } else {
            // In a file, a sentence would be split at its marks; an argument is not split.
            arguments.extend(["-t", text]);
        }
        arguments.extend([print, "-o", sound]);
        host.run(&arguments, &files, sound == SOUND)
    }
}

/// Reads `pau:0.164 hh:0.255`.
fn timed_phones(said: &str) -> Result<Vec<(String, f64)>> {
    said.split_whitespace()
        .map(|field| {
            let (symbol, end) = field.rsplit_once(':').context("a phone without a time")?;
            let end_secs: f64 = end.parse().with_context(|| format!("the time {end:?}"))?;
            Ok((symbol.to_owned(), end_secs))
        })
        .collect()
}

/// Matches the phones of the sentence with the tokens of the isolated words. Phones that no
/// isolated word has belong to the preceding token.
fn joined(known: &[(usize, &str)], heard: Vec<(String, f64)>) -> Result<Labels> {
    let sounds: Vec<usize> = (0..heard.len())
        .filter(|i| !labels::is_silence(&heard[*i].0))
        .collect();
    let pairs = matching::matched(known, &sounds, |(_, k), h| {
        let h = heard[*h].0.as_str();
        match (
            *k == h,
            ipa::is_vowel(k, Set::Radio) == ipa::is_vowel(h, Set::Radio),
        ) {
            (true, _) => 0,
            (_, true) => 2,
            _ => 5,
        }
    })?;
    let mut labels = Labels::default();
    let mut tokens = vec![None; heard.len()];
    for (index, pair) in sounds.iter().zip(pairs) {
        tokens[*index] = pair.map(|k| known[k].0);
    }
    let mut last = known.first().map(|k| k.0);
    for ((symbol, end_secs), token) in heard.into_iter().zip(tokens) {
        let silent = labels::is_silence(&symbol);
        last = token.or(last);
        labels.phones.push(Phone {
            symbol,
            end_secs,
            token: last.filter(|_| !silent),
            syllable: None,
        });
    }
    syllables(&mut labels);
    Ok(labels)
}

/// Splits the phones of each token into syllables, and phrases at silences. flite does not print
/// stress.
fn syllables(labels: &mut Labels) {
    let mut at = 0;
    while at < labels.phones.len() {
        let token = labels.phones[at].token;
        let count = labels.phones[at..]
            .iter()
            .take_while(|p| p.token == token)
            .count();
        if token.is_none() {
            // A silence ends a phrase, unless it is the first.
            if let Some(last) = labels.phones[..at].last().and_then(|p| p.token) {
                labels.breaks.push((last, String::new()));
            }
            at += count;
            continue;
        }
        let word = &labels.phones[at..at + count];
        let mut starts = ipa::starts(word.iter().map(|p| p.symbol.as_str()), Set::Radio);
        starts.push(count);
        for pair in starts.windows(2) {
            for phone in &mut labels.phones[at + pair[0]..at + pair[1]] {
                phone.syllable = Some(labels.syllables.len());
            }
            labels.syllables.push((0, String::new()));
        }
        at += count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Output of flite 2.2 for "Hello, the 25." with the voice slt, and for each token.
    const SAID: &str = "pau:0.164 hh:0.233 ax:0.282 l:0.381 ow:0.506 pau:0.6 dh:0.65 ax:0.7 \
        t:0.8 w:0.85 eh:0.9 n:1.0 t:1.05 iy:1.1 f:1.2 ay:1.3 v:1.4 pau:1.5\n";

    #[test]
    fn phones_of_a_sentence_find_their_tokens() {
        // Spoken separately, "the" has another vowel, and 25 has an additional t.
        let alone = [
            (0, "hh ax l ow"),
            (2, "dh iy"),
            (3, "t w eh n t t iy f ay v"),
        ];
        let known: Vec<(usize, &str)> = alone
            .iter()
            .flat_map(|(t, phones)| phones.split_whitespace().map(|p| (*t, p)))
            .collect();
        let labels = joined(&known, timed_phones(SAID).unwrap()).unwrap();
        let of = |token| labels.phones.iter().filter(|p| p.token == token).count();
        assert_eq!(
            [of(Some(0)), of(Some(2)), of(Some(3)), of(None)],
            [4, 2, 9, 3]
        );
        assert_eq!(labels.breaks, [(0, String::new()), (3, String::new())]);
        assert_eq!(labels.syllables.len(), 2 + 1 + 3);
    }

    #[test]
    fn times_that_cannot_be_read_are_errors() {
        assert!(
            timed_phones("pau").is_err(),
            "a phone without a time is rejected"
        );
        assert!(
            timed_phones("pau:x").is_err(),
            "an unreadable time is rejected"
        );
        assert!(
            timed_phones("\n").unwrap().is_empty(),
            "an empty line has no phones"
        );
    }

    #[test]
    fn a_pronunciation_is_an_entry_of_the_lexicon() {
        let token = crate::spoken::Token {
            text: "tomato".to_owned(),
            ipa: Some("təˈmɑːtoʊ".to_owned()),
            ..Default::default()
        };
        let sentence = Sentence {
            tokens: vec![token],
            ..Sentence::default()
        };
        let text = Text::from_sentence(&sentence).unwrap();
        assert_eq!(text.lexicon, "raconteuriba nil : t ax0 m aa1 t ow0\n");
        assert_eq!(text.words, [(0, "raconteuriba".to_owned())]);
    }
}

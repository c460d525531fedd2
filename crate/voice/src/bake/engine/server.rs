//! Server that speaks sentences and returns times in a format of [`crate::align`], queried by a
//! page; `docs/voices.md` describes the messages.

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use super::{Engine, VoiceInfo, aligned, labels, punctuation, wave};
use crate::align::{detect, read};
use crate::content::Gender;
use crate::spoken::{Sentence, Spoken};
use raconteur_speech::bundle::SentenceKind;

/// Environment that queries a speech server: in a web page, the page's own code.
pub trait Host: Send + Sync {
    /// Returns the voices that the page's owner lists, as a JSON list of [`Voice`].
    ///
    /// # Errors
    /// Returns an error if the page does not provide the list.
    fn voices(&self) -> Result<String>;

    /// Returns the server's answer to a [`Request`] in JSON.
    ///
    /// # Errors
    /// Returns [`super::Pending`] until the server answers, and an error if it does not answer.
    fn ask(&self, request: &str) -> Result<Answer>;
}

/// Voice of a speech server.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Voice {
    /// Name of the voice on the server.
    pub name: String,
    /// BCP 47 language tag of the voice.
    pub language: String,
    /// `female` or `male`, where it is one.
    pub gender: Option<String>,
    /// Phone set, if the times do not specify it: one of [`raconteur_speech::phones::PHONE_SETS`].
    pub phone_set: Option<String>,
}

/// Request to a speech server: one sentence to synthesise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Request<'a> {
    /// Voice, one of those that the server provides.
    pub voice: &'a str,
    /// BCP 47 language tag of the sentence.
    pub language: &'a str,
    /// Text of the sentence, with punctuation.
    pub text: String,
    /// Words only, in order; numbers and abbreviations are written out.
    pub words: Vec<&'a str>,
}

/// Answer of a speech server: audio and the times of words and phones.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answer {
    /// Audio as a WAV file.
    pub sound: Vec<u8>,
    /// Times of words and phones, in any format that [`detect`] recognises.
    pub times: String,
}

/// Speech engine that queries a server through its host.
pub struct Server<H>(pub H);

impl<H: Host> Engine for Server<H> {
    fn version(&self) -> Result<String> {
        Ok("server".to_owned())
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        let told: Vec<Voice> =
            serde_json::from_str(&self.0.voices()?).context("the voices of the server")?;
        Ok(told.into_iter().map(info).collect())
    }

    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        let voices = self.voices()?;
        let voice = voices
            .iter()
            .find(|v| v.name == voice)
            .with_context(|| format!("the server has no voice {voice:?}"))?;
        sentences
            .iter()
            .map(|s| self.speak_sentence(voice, s))
            .collect()
    }
}

fn info(voice: Voice) -> VoiceInfo {
    VoiceInfo {
        gender: match voice.gender.as_deref() {
            Some("female") => Some(Gender::Female),
            Some("male") => Some(Gender::Male),
            _ => None,
        },
        name: voice.name,
        language: voice.language,
        phone_set: voice.phone_set.unwrap_or_else(|| "radio".to_owned()),
        rate_hz: 0.0,
        what: "of a server".to_owned(),
    }
}

impl<H: Host> Server<H> {
    fn speak_sentence(&self, voice: &VoiceInfo, sentence: &Sentence) -> Result<Spoken> {
        let words: Vec<&str> = sentence.tokens.iter().map(|t| t.text.as_str()).collect();
        if !words.iter().any(|w| w.chars().any(char::is_alphanumeric)) {
            return Ok(labels::nothing(16_000.0, &voice.phone_set));
        }
        let request = Request {
            voice: &voice.name,
            language: &sentence.language,
            text: written(sentence),
            words: words.clone(),
        };
        let answer = self.0.ask(&serde_json::to_string(&request)?)?;
        let times = answer.times.as_bytes();
        let format = detect("", times).context("the server returns times in an unknown format")?;
        let alignment = read(format, times).context("the phones reported by the server")?;
        let wave = wave::decode(&answer.sound).context("the audio of the server")?;
        aligned::combine(&alignment, wave, &words, &voice.phone_set)
    }
}

/// Returns the words of a sentence with their punctuation.
fn written(sentence: &Sentence) -> String {
    let last = sentence.tokens.len().saturating_sub(1);
    let words = sentence.tokens.iter().enumerate().map(|(t, token)| {
        let ends: Option<SentenceKind> = (t == last).then_some(sentence.kind);
        format!("{}{}", token.text, punctuation(token, ends))
    });
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake::encode::wave_of;
    use crate::spoken::Token;

    struct Fake(&'static str);

    impl Host for Fake {
        fn voices(&self) -> Result<String> {
            Ok(
                r#"[{"name":"ann","language":"de","gender":"female","phoneSet":"sampa"}]"#
                    .to_owned(),
            )
        }

        fn ask(&self, request: &str) -> Result<Answer> {
            assert_eq!(
                request,
                r#"{"voice":"ann","language":"de","text":"Ja, \"gut\"?","words":["Ja","\"gut\""]}"#
            );
            Ok(Answer {
                sound: wave_of(&vec![0.1; 8_000], 16_000)?,
                times: self.0.to_owned(),
            })
        }
    }

    fn spoken_words(times: &'static str) -> Result<Vec<Spoken>> {
        let token = |text: &str, punctuation: &str| Token {
            text: text.to_owned(),
            punctuation: punctuation.to_owned(),
            ..Token::default()
        };
        let sentence = Sentence {
            tokens: vec![token("Ja", ","), token("\"gut\"", "")],
            kind: SentenceKind::Question,
            language: "de".to_owned(),
            ..Sentence::default()
        };
        Server(Fake(times)).speak("ann", &[sentence])
    }

    const TALKING: &str = r#"{"words":["Ja","gut"],"wtimes":[0,200],"wdurations":[200,300],"visemes":["ih","aa","kk","ou","DD"],"vtimes":[0,100,200,300,400],"vdurations":[100,100,100,100,100]}"#;

    #[test]
    fn a_sentence_gets_its_sound_and_the_times_of_its_words() {
        let spoken = spoken_words(TALKING).unwrap();
        let tokens: Vec<_> = spoken[0].segments.iter().map(|s| s.token).collect();
        assert_eq!(spoken[0].samples.len(), 8_000);
        assert!(
            tokens.contains(&Some(0)) && tokens.contains(&Some(1)),
            "{tokens:?}"
        );
        assert_eq!(
            Server(Fake("")).voices().unwrap()[0].gender,
            Some(Gender::Female)
        );
    }

    #[test]
    fn times_that_make_no_sense_are_errors() {
        for bad in ["", "no times", "{}", "<maryxml>"] {
            assert!(spoken_words(bad).is_err(), "{bad}");
        }
        assert!(
            Server(Fake(TALKING)).speak("bob", &[]).is_err(),
            "impossible times are rejected"
        );
    }
}

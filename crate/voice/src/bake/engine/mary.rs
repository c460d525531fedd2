//! MARY TTS, a server: its input is RawMaryXML, and its output MaryXML with times, and the audio.

use core::fmt::Write as _;

use crate::align::{Format, read};
use crate::content::Gender;
use crate::spoken::{Sentence, Spoken};
use anyhow::{Context as _, Result, ensure};
use quick_xml::escape::partial_escape;
use raconteur_speech::bundle::SentenceKind;

use super::{Engine, VoiceInfo, aligned, http, labels, punctuation, wave};
use crate::ipa::{self, Set};

/// Speech engine that queries a MARY server at an address.
pub(super) struct Mary {
    address: String,
}

impl Mary {
    /// Creates the engine for a server address of the form `host:port`.
    pub(super) fn new(address: &str) -> Result<Self> {
        ensure!(
            is_address(address),
            "{address:?} is not a server address of the form host:port"
        );
        Ok(Self {
            address: address.to_owned(),
        })
    }

    fn text(&self, path: &str) -> Result<String> {
        let reply = http::post(&self.address, path, &[])
            .context("a MARY server is started with marytts-server; its usual port is 59125")?;
        Ok(String::from_utf8_lossy(&reply).into_owned())
    }

    fn sentence(&self, voice: &VoiceInfo, sentence: &Sentence) -> Result<Spoken> {
        let Some(document) = document(sentence, &voice.language)? else {
            return Ok(labels::nothing(16_000.0, "sampa"));
        };
        let locale = voice.language.replace('-', "_");
        let ask = |output: &str| {
            let form = [
                ("INPUT_TEXT", document.as_str()),
                ("INPUT_TYPE", "RAWMARYXML"),
                ("OUTPUT_TYPE", output),
                ("LOCALE", &locale),
                ("VOICE", &voice.name),
                ("AUDIO", "WAVE_FILE"),
            ];
            http::post(&self.address, "/process", &form)
        };
        let times = ask("REALISED_ACOUSTPARAMS")?;
        let alignment = read(Format::MaryXml, &times).context("the phones reported by MARY")?;
        let wave = wave::decode(&ask("AUDIO")?).context("what MARY says")?;
        let tokens: Vec<&str> = sentence.tokens.iter().map(|t| t.text.as_str()).collect();
        aligned::combine(&alignment, wave, &tokens, "sampa")
    }
}

impl Engine for Mary {
    fn version(&self) -> Result<String> {
        let said = self.text("/version")?;
        let number = said
            .split_whitespace()
            .find(|w| w.starts_with(|c: char| c.is_ascii_digit()));
        Ok(format!("marytts {}", number.unwrap_or("unknown")))
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        let mut out: Vec<VoiceInfo> = self.text("/voices")?.lines().filter_map(voice).collect();
        out.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(out)
    }

    fn speak(&self, name: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        let voices = self.voices()?;
        let voice = voices
            .iter()
            .find(|v| v.name == name)
            .with_context(|| format!("the MARY server has no voice {name:?}"))?;
        sentences.iter().map(|s| self.sentence(voice, s)).collect()
    }
}

/// Returns true if this is `host:port` and nothing that could be more than that in a request.
fn is_address(address: &str) -> bool {
    address.rsplit_once(':').is_some_and(|(host, port)| {
        !host.is_empty()
            && host
                .bytes()
                .all(|b| b.is_ascii_alphanumeric() || b"-._[]:".contains(&b))
            && port.parse::<u16>().is_ok()
    })
}

/// Parses a line such as `cmu-slt-hsmm en_US female hmm`.
fn voice(line: &str) -> Option<VoiceInfo> {
    let mut fields = line.split_whitespace();
    let (name, locale, gender) = (fields.next()?, fields.next()?, fields.next()?);
    let what = match fields.next() {
        Some("hmm") => "hidden Markov models",
        Some("unitselection") => "units of recorded speech",
        _ => "",
    };
    Some(VoiceInfo {
        name: name.to_owned(),
        language: locale.replace('_', "-"),
        gender: match gender {
            "female" => Some(Gender::Female),
            "male" => Some(Gender::Male),
            _ => None,
        },
        phone_set: "sampa".to_owned(),
        rate_hz: 0.0,
        what: what.to_owned(),
    })
}

/// Returns the RawMaryXML of a sentence; `None` if there is nothing to speak.
fn document(sentence: &Sentence, language: &str) -> Result<Option<String>> {
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<maryxml version=\"0.5\" xmlns=\"http://mary.dfki.de/2002/MaryXML\" xml:lang=\"{}\"><p><s>",
        escaped(language)
    );
    let mut said = false;
    for (i, token) in sentence.tokens.iter().enumerate() {
        let text = escaped(&token.text);
        if !text.chars().any(char::is_alphanumeric) {
            continue;
        }
        said = true;
        out.push_str("<t");
        if token.emphasis > 0.5 {
            out.push_str(" accent=\"H*\"");
        }
        if let Some(ipa) = &token.ipa {
            let syllables = ipa::syllables(ipa, Set::Sampa)
                .with_context(|| format!("the word {:?}", token.text))?;
            let written: Vec<String> = syllables
                .iter()
                .map(|s| {
                    let mark = ["", "' ", ", "].get(usize::from(s.stress)).unwrap_or(&"");
                    format!("{mark}{}", s.phones.join(" "))
                })
                .collect();
            let _ = write!(out, " ph=\"{}\"", escaped(&written.join(" - ")));
        }
        let _ = write!(out, ">{text}</t>");
        let ends: Option<SentenceKind> = (i + 1 == sentence.tokens.len()).then_some(sentence.kind);
        let mark = punctuation(token, ends);
        if !mark.is_empty() {
            let _ = write!(out, "<t>{}</t>", escaped(&mark));
        }
        if token.pause {
            out.push_str("<boundary breakindex=\"4\"/>");
        }
    }
    out.push_str("</s></p></maryxml>");
    Ok(said.then_some(out))
}

/// Escapes a text for XML, without characters that XML cannot contain.
fn escaped(text: &str) -> String {
    let held: String = text
        .chars()
        .filter(|c| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}'))
        .collect();
    // Apostrophes are marks of stress in transcriptions and stay as they are.
    partial_escape(&held).replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spoken::Token;
    use std::io::{BufRead as _, BufReader, Read as _, Write as _};
    use std::net::TcpListener;
    use std::thread;

    fn sentence(words: &[(&str, Option<&str>)]) -> Sentence {
        let tokens = words.iter().map(|(text, ipa)| Token {
            text: (*text).to_owned(),
            ipa: ipa.map(str::to_owned),
            emphasis: 0.5,
            ..Token::default()
        });
        Sentence {
            tokens: tokens.collect(),
            ..Sentence::default()
        }
    }

    #[test]
    fn texts_stay_texts_in_the_document() {
        let nasty = sentence(&[("</t>\"&\u{0}a", None), ("-", None), ("b", Some("ˈbiː"))]);
        let told = document(&nasty, "en-US").unwrap().unwrap();
        assert!(
            told.contains("<t>&lt;/t&gt;&quot;&amp;a</t><t ph=\"' b i:\">b</t>"),
            "{told}"
        );
        assert!(
            document(&sentence(&[("-", None)]), "en-US")
                .unwrap()
                .is_none(),
            "a sentence without words has no document"
        );
    }

    /// Starts a test server that answers `count` requests with prepared documents.
    fn server(count: usize) -> (String, thread::JoinHandle<Vec<String>>) {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let worker = thread::spawn(move || {
            let answer = |listener: &TcpListener| {
                let (mut stream, _) = listener.accept().unwrap();
                let mut reader = BufReader::new(stream.try_clone().unwrap());
                let (mut first, mut length) = (String::new(), 0);
                reader.read_line(&mut first).unwrap();
                loop {
                    let mut line = String::new();
                    reader.read_line(&mut line).unwrap();
                    if let Some((name, value)) = line.split_once(':')
                        && name.eq_ignore_ascii_case("Content-Length")
                    {
                        length = value.trim().parse().unwrap();
                    }
                    if line.trim().is_empty() {
                        break;
                    }
                }
                let mut body = vec![0; length];
                reader.read_exact(&mut body).unwrap();
                let asked = String::from_utf8(body).unwrap();
                let reply = if first.contains("/voices") {
                    b"one en_US female hmm\ntwo de male unitselection\n".to_vec()
                } else if asked.contains("OUTPUT_TYPE=AUDIO") {
                    let mut out = std::io::Cursor::new(Vec::new());
                    let spec = hound::WavSpec {
                        channels: 1,
                        sample_rate: 16_000,
                        bits_per_sample: 16,
                        sample_format: hound::SampleFormat::Int,
                    };
                    let mut writer = hound::WavWriter::new(&mut out, spec).unwrap();
                    (0..4_800).for_each(|_| writer.write_sample(100_i16).unwrap());
                    writer.finalize().unwrap();
                    out.into_inner()
                } else {
                    br#"<maryxml xmlns="http://mary.dfki.de/2002/MaryXML" version="0.5" xml:lang="en-US"><p><s><phrase><t ph="a">a<syllable ph="a" stress="1"><ph d="200" end="0.2" p="a"/></syllable></t></phrase></s></p></maryxml>"#.to_vec()
                };
                let head = format!("HTTP/1.0 200 OK\r\nContent-Length: {}\r\n\r\n", reply.len());
                stream.write_all(head.as_bytes()).unwrap();
                stream.write_all(&reply).unwrap();
                asked
            };
            (0..count).map(|_| answer(&listener)).collect()
        });
        (address, worker)
    }

    #[test]
    fn a_server_is_asked_for_times_and_sound() {
        let (address, worker) = server(3);
        let mary = Mary::new(&address).unwrap();
        let spoken = mary.speak("one", &[sentence(&[("a", None)])]).unwrap();
        let asked = worker.join().unwrap();
        assert!(asked[1].contains("LOCALE=en_US&VOICE=one"), "{asked:?}");
        assert_eq!(spoken[0].samples.len(), 4_800);
        let told: Vec<_> = spoken[0]
            .segments
            .iter()
            .map(|s| (s.symbol.as_str(), s.token))
            .collect();
        assert_eq!(told, [("a", Some(0)), ("pau", None)]);
    }

    #[test]
    fn nothing_but_an_address_is_one() {
        for (address, fine) in [
            ("localhost:59125", true),
            ("[::1]:59125", true),
            ("localhost", false),
            (":80", false),
            ("a b:80", false),
            ("a\r\nX: y:80", false),
            ("a:99999", false),
        ] {
            assert_eq!(is_address(address), fine, "{address}");
        }
    }

    #[test]
    fn a_voice_that_the_server_lacks_and_a_server_that_is_not_there_are_errors() {
        let (address, worker) = server(1);
        let mary = Mary::new(&address).unwrap();
        assert!(
            mary.speak("three", &[sentence(&[("a", None)])]).is_err(),
            "a missing voice is rejected"
        );
        worker.join().unwrap();
        assert!(mary.version().is_err(), "nobody listens any more");
        assert!(
            Mary::new("localhost").is_err(),
            "an address without a port is rejected"
        );
    }
}

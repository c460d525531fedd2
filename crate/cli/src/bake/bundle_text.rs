//! The text of a bundle: JSON that a person can read and a version control system can
//! compare, one utterance to a block, one list of words or phones to a line.

use std::io::{self, Write};

use anyhow::Result;
use raconteur_player::speech::Bundle;
use serde::Serialize as _;
use serde_json::Serializer;
use serde_json::ser::Formatter;

/// Objects and lists this deep stand on one line: bundle, utterances and utterance are
/// spread out, the lists of an utterance are not.
const SPREAD: usize = 3;

/// Writes a bundle; [`Bundle::from_json`] reads it again.
///
/// # Errors
/// When a field cannot be written as JSON.
pub(crate) fn write(bundle: &Bundle) -> Result<String> {
    let mut bytes = Vec::new();
    bundle.serialize(&mut Serializer::with_formatter(
        &mut bytes,
        Blocks { depth: 0 },
    ))?;
    bytes.push(b'\n');
    Ok(String::from_utf8(bytes)?)
}

struct Blocks {
    depth: usize,
}

impl Blocks {
    fn open<W: Write + ?Sized>(&mut self, out: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.depth += 1;
        out.write_all(bracket)
    }

    fn close<W: Write + ?Sized>(&mut self, out: &mut W, bracket: &[u8]) -> io::Result<()> {
        let spread = self.depth <= SPREAD;
        self.depth = self.depth.saturating_sub(1);
        if spread {
            self.line(out)?;
        }
        out.write_all(bracket)
    }

    fn item<W: Write + ?Sized>(&self, out: &mut W, first: bool) -> io::Result<()> {
        match (first, self.depth <= SPREAD) {
            (true, true) => self.line(out),
            (true, false) => Ok(()),
            (false, true) => out.write_all(b",").and_then(|()| self.line(out)),
            (false, false) => out.write_all(b", "),
        }
    }

    fn line<W: Write + ?Sized>(&self, out: &mut W) -> io::Result<()> {
        out.write_all(b"\n")?;
        (0..self.depth).try_for_each(|_| out.write_all(b"  "))
    }
}

impl Formatter for Blocks {
    fn begin_array<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.open(out, b"[")
    }

    fn end_array<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.close(out, b"]")
    }

    fn begin_array_value<W: Write + ?Sized>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.item(out, first)
    }

    fn begin_object<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.open(out, b"{")
    }

    fn end_object<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.close(out, b"}")
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.item(out, first)
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        out.write_all(b": ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_player::speech::{AudioFile, Phone, Utterance, Word};

    #[test]
    fn what_is_written_is_read_again() {
        let utterance = |key: &str| Utterance {
            key: key.to_owned(),
            text: "\u{201c}Hi\u{201d} \\ \"you\"".to_owned(),
            duration_secs: 1.234,
            audio: vec![AudioFile {
                file: "a.opus".to_owned(),
                mime: "audio/ogg; codecs=opus".to_owned(),
            }],
            words: vec![Word {
                text: "Hi".to_owned(),
                start_secs: 0.1,
                end_secs: 0.3,
            }],
            phones: vec![Phone {
                symbol: "pau".to_owned(),
                start_secs: 0.0,
                end_secs: 0.1,
                word: None,
            }],
        };
        for utterances in [
            vec![],
            vec![utterance("a")],
            vec![utterance("a"), utterance("b")],
        ] {
            let bundle = Bundle {
                format: "raconteur-speech".to_owned(),
                version: 1,
                language: "en-US".to_owned(),
                phone_set: "radio".to_owned(),
                voice: "v".to_owned(),
                engine: "e".to_owned(),
                utterances,
            };
            let text = write(&bundle).unwrap();
            assert_eq!(
                Bundle::from_json(text.as_bytes()).unwrap(),
                bundle,
                "{text}"
            );
        }
    }
}

//! Decoding of a script's bytes to text. Only this module knows the invalid bytes: in the text,
//! their replacement could also be a character of the author.

use raconteur_base::encoding;

use crate::parse::reject_binary;
use crate::{Diagnostic, Limits, Parsed, Span, parse_with};

/// Script text decoded from bytes, with the diagnostic of encoding errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Decoded {
    /// Text, with U+FFFD replacing bytes that are not UTF-8.
    pub text: String,
    /// First encoding error, with the number of places. Its span refers to the text.
    pub problem: Option<Diagnostic>,
}

/// Decodes the bytes of a script. A text that [`crate::parse`] refuses as a whole, UTF-16 or a
/// binary file, is left to it.
#[must_use]
pub fn decode(bytes: Vec<u8>) -> Decoded {
    let bytes = match String::from_utf8(bytes) {
        Ok(text) => {
            return Decoded {
                text,
                problem: None,
            };
        }
        Err(error) => error.into_bytes(),
    };
    let places: usize = bytes
        .utf8_chunks()
        .map(|chunk| usize::from(!chunk.invalid().is_empty()))
        .sum();
    let first = bytes.utf8_chunks().next();
    let at = first.map_or(0, |chunk| chunk.valid().len());
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let problem = reject_binary(&text)
        .is_none()
        .then(|| undecoded(&bytes, at, places));
    Decoded { text, problem }
}

/// Parses a script from bytes that should be UTF-8, with the conversion of [`decode`]; spans refer
/// to its text.
#[must_use]
pub fn parse_bytes(bytes: &[u8], limits: &Limits) -> Parsed {
    let decoded = decode(bytes.to_vec());
    let mut parsed = parse_with(&decoded.text, limits);
    parsed.diagnostics.splice(0..0, decoded.problem);
    parsed
}

fn undecoded(bytes: &[u8], at: usize, places: usize) -> Diagnostic {
    let more = match places {
        0 | 1 => String::new(),
        2 => ", and at one more place".to_owned(),
        n => format!(", and at {} more places", n - 1),
    };
    let message = if encoding::is_utf16(bytes) {
        format!("this is UTF-16, not UTF-8 text{more}")
    } else {
        format!("byte {at} is not UTF-8 text{more}; the bytes there are lost")
    };
    let span = Span::from_offsets(at, at + char::REPLACEMENT_CHARACTER.len_utf8());
    Diagnostic::error("eml::not-utf8", span, message).hint(encoding::SAVE_AS_UTF8)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_replacement_character_that_was_written_is_text() {
        let written = "<eml><body><voice-text time='0'>a \u{fffd} b</voice-text></body></eml>";
        let decoded = decode(written.as_bytes().to_vec());
        assert_eq!((decoded.text.as_str(), decoded.problem), (written, None));
        let parsed = parse_bytes(written.as_bytes(), &Limits::default());
        assert_eq!(parsed.diagnostics, []);
        assert_eq!(crate::parse(written).diagnostics, []);
    }

    proptest! {
        #[test]
        fn bytes_that_are_no_text_are_told_among_written_ones(
            before in "[a-z\u{fffd}\u{e9}]{0,20}", after in "[a-z\u{fffd}]{0,20}", byte in 0x80_u8..=0xbf, twice: bool,
        ) {
            let mut bytes = before.clone().into_bytes();
            bytes.push(byte);
            bytes.extend_from_slice(after.as_bytes());
            if twice {
                bytes.push(0xff);
            }
            let decoded = decode(bytes);
            let problem = decoded.problem.expect("one");
            prop_assert_eq!(problem.span.start as usize, before.len());
            prop_assert_eq!(problem.span.slice(&decoded.text), "\u{fffd}");
            prop_assert_eq!(problem.message.contains("one more place"), twice);
        }
    }
}

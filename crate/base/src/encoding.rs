//! UTF-8 validation of bytes, with the position and reason of each fault.

use std::fmt;

/// Number of bytes of a text used to detect its encoding.
const TELLING: usize = 256;

/// Hint for fixing [`NotUtf8`]: save the file as UTF-8.
pub const SAVE_AS_UTF8: &str = "save the file as UTF-8";

/// Error returned when bytes are not UTF-8 text, with the position of the first invalid byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotUtf8 {
    /// Offset of the first invalid byte.
    pub at: usize,
    /// First invalid byte.
    pub byte: u8,
    /// Line of the invalid byte, from 1.
    pub line: usize,
    /// Column of the invalid byte in characters, from 1.
    pub column: usize,
    /// True if the whole text looks like UTF-16.
    pub is_utf16: bool,
}

impl fmt::Display for NotUtf8 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_utf16 {
            return write!(f, "this is UTF-16 text, not UTF-8; {SAVE_AS_UTF8}");
        }
        let Self {
            at,
            byte,
            line,
            column,
            ..
        } = self;
        write!(
            f,
            "this is not UTF-8 text: byte {at} is {byte:#04x}, line {line} column {column}; {SAVE_AS_UTF8}"
        )
    }
}

impl std::error::Error for NotUtf8 {}

/// Converts bytes to text, with the position of the first byte that is not UTF-8 on failure.
///
/// # Errors
/// Returns an error if the bytes are not UTF-8 or look like UTF-16. UTF-16 that contains only ASCII
/// characters and has no byte order mark is formally valid UTF-8, with a NUL in every other byte.
pub fn utf8(bytes: &[u8]) -> Result<&str, NotUtf8> {
    let is_utf16 = is_utf16(bytes);
    let at = match str::from_utf8(bytes) {
        Ok(text) if !is_utf16 => return Ok(text),
        Ok(_) => 0,
        Err(error) => error.valid_up_to(),
    };
    let before = &bytes[..at];
    let line_start = before
        .iter()
        .rposition(|&b| b == b'\n')
        .map_or(0, |i| i + 1);
    let begins_character = |b: &&u8| **b & 0xc0 != 0x80;
    Err(NotUtf8 {
        at,
        byte: bytes.get(at).copied().unwrap_or_default(),
        line: 1 + before.iter().filter(|&&b| b == b'\n').count(),
        column: 1 + before[line_start..].iter().filter(begins_character).count(),
        is_utf16,
    })
}

/// Returns true if bytes look like UTF-16 (or UTF-32), of either byte order, with or without a byte
/// order mark: between a quarter and five sixths of the first ones are NUL. Texts already decoded
/// as UTF-8, with U+FFFD for the mark, match, too.
#[must_use]
pub fn is_utf16(bytes: &[u8]) -> bool {
    let begin = &bytes[..bytes.len().min(TELLING)];
    let nul = begin.iter().filter(|&&b| b == 0).count();
    let marked = matches!(begin, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]);
    marked || (nul * 4 >= begin.len() && nul * 6 <= begin.len() * 5 && nul > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_first_byte_that_does_not_fit_is_found(
            before in "[a-zé😀\n]{0,40}", byte in 0x80_u8..=0xff, after in "[a-z]{0,9}",
        ) {
            // A lone continuation byte or a lone first byte, before ASCII.
            let mut bytes = before.clone().into_bytes();
            bytes.push(byte);
            bytes.extend(after.bytes());
            let error = utf8(&bytes).unwrap_err();
            let (lines, last) = match before.rsplit_once('\n') {
                Some((lines, last)) => (lines.matches('\n').count() + 1, last),
                None => (0, before.as_str()),
            };
            prop_assert_eq!((error.at, error.byte), (before.len(), byte));
            prop_assert_eq!((error.line, error.column), (lines + 1, last.chars().count() + 1));
        }

        #[test]
        fn utf16_is_known_in_every_form(body in "[ -~é]{4,300}", mark: bool, big: bool) {
            let text = format!("{}<eml><body>{body}", if mark { "\u{feff}" } else { "" });
            let unit = |u: u16| if big { u.to_be_bytes() } else { u.to_le_bytes() };
            let bytes: Vec<u8> = text.encode_utf16().flat_map(unit).collect();
            let error = utf8(&bytes).unwrap_err();
            prop_assert!(error.is_utf16, "{}", error);
            prop_assert!(is_utf16(String::from_utf8_lossy(&bytes).as_bytes()));
        }

        #[test]
        fn utf8_is_left_alone(text in "[\t\n -\u{10ffff}]*") {
            prop_assert_eq!(utf8(text.as_bytes()), Ok(text.as_str()));
        }
    }

    #[test]
    fn nothing_but_nul_is_no_text_but_no_utf16_either() {
        assert!(!is_utf16(&[0; 4096]), "NUL bytes are not UTF-16");
        assert!(!is_utf16(b""), "empty text is not UTF-16");
    }
}

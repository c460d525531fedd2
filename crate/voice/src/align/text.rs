//! Text in any encoding, with lines and fields that know their position.

use super::Fault;

/// Error in a text, with its byte offset in the decoded text.
#[derive(Debug)]
pub(super) struct TextError {
    pub(super) at: usize,
    pub(super) message: String,
}

impl TextError {
    pub(super) fn new(at: usize, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { at, message }
    }

    /// Converts the error to a fault with line and column instead of an offset.
    pub(super) fn in_text(self, text: &str) -> Fault {
        let (line, column) = place(text, self.at);
        Fault {
            line,
            column,
            message: self.message,
        }
    }
}

/// Returns line and column (in characters), both from 1, of a byte offset.
pub(super) fn place(text: &str, at: usize) -> (u32, u32) {
    LineCounter::new(text).to(at)
}

/// Converts ascending byte offsets to line and column in one pass. CR, LF and CRLF end a line.
pub(super) struct LineCounter<'a> {
    rest: std::iter::Peekable<std::str::CharIndices<'a>>,
    line: u32,
    column: u32,
    after_cr: bool,
}

impl<'a> LineCounter<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            rest: text.char_indices().peekable(),
            line: 1,
            column: 1,
            after_cr: false,
        }
    }

    pub(super) fn to(&mut self, at: usize) -> (u32, u32) {
        while let Some((_, c)) = self.rest.next_if(|(i, _)| *i < at) {
            match c {
                '\n' if self.after_cr => {}
                '\n' | '\r' => {
                    self.line = self.line.saturating_add(1);
                    self.column = 1;
                }
                _ => self.column = self.column.saturating_add(1),
            }
            self.after_cr = c == '\r';
        }
        (self.line, self.column)
    }
}

/// Decodes by byte order mark (UTF-8, UTF-16 of either order), else as UTF-8 where it is
/// UTF-8, else as Latin-1: labels of European corpora are often that old.
pub(super) fn decode(bytes: &[u8]) -> Result<String, Fault> {
    let utf16 = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).map(|b| unit([b[0], b[1]]));
        let mut text = String::with_capacity(bytes.len() / 2);
        for c in char::decode_utf16(units) {
            match c {
                Ok(c) => text.push(c),
                Err(_) => {
                    let end = text.len();
                    return Err(
                        TextError::new(end, "half of a UTF-16 surrogate pair").in_text(&text)
                    );
                }
            }
        }
        if bytes.len() % 2 == 1 {
            return Err(
                TextError::new(text.len(), "UTF-16 with an odd number of bytes").in_text(&text),
            );
        }
        Ok(text)
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        _ => {
            let rest = bytes.strip_prefix(&[0xef, 0xbb, 0xbf]).unwrap_or(bytes);
            Ok(match str::from_utf8(rest) {
                Ok(text) => text.to_owned(),
                Err(_) => rest.iter().map(|b| char::from(*b)).collect(),
            })
        }
    }
}

/// Lines without their ends, each with the byte that it begins at.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let rest = text.get(at..).filter(|rest| !rest.is_empty())?;
        let begin = at;
        let end = rest.find(['\n', '\r']).unwrap_or(rest.len());
        let ending = if rest[end..].starts_with("\r\n") {
            2
        } else {
            1
        };
        at = (begin + end + ending).min(text.len());
        Some((begin, &rest[..end]))
    })
}

/// Returns the white-space separated fields of a line, each with its byte offset.
pub(super) fn fields(at: usize, line: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut begin = 0;
    std::iter::from_fn(move || {
        let rest = &line[begin..];
        let skipped = rest.len() - rest.trim_start().len();
        let field = rest.split_whitespace().next()?;
        let found = (at + begin + skipped, field);
        begin += skipped + field.len();
        Some(found)
    })
}

/// Parses a finite number.
pub(super) fn number(at: usize, field: &str) -> Result<f64, TextError> {
    match field.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(TextError::new(
            at,
            format!("{:?} is not finite", clip(field)),
        )),
        Err(_) => Err(TextError::new(
            at,
            format!("{:?} is not a number", clip(field)),
        )),
    }
}

/// Returns the beginning of a text, for use in a message.
pub(super) fn clip(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_word_in_five_encodings() {
        let utf16 = |unit: fn(u16) -> [u8; 2]| -> Vec<u8> {
            "\u{feff}für 😀".encode_utf16().flat_map(unit).collect()
        };
        assert_eq!(decode("für 😀".as_bytes()).ok().as_deref(), Some("für 😀"));
        assert_eq!(
            decode("\u{feff}für".as_bytes()).ok().as_deref(),
            Some("für")
        );
        assert_eq!(
            decode(&utf16(u16::to_le_bytes)).ok().as_deref(),
            Some("für 😀")
        );
        assert_eq!(
            decode(&utf16(u16::to_be_bytes)).ok().as_deref(),
            Some("für 😀")
        );
        assert_eq!(decode(b"f\xfcr").ok().as_deref(), Some("für"));
    }

    #[test]
    fn broken_utf16_is_refused_where_it_breaks() {
        let odd = decode(b"\xff\xfea\0\n\0b").unwrap_err();
        assert_eq!((odd.line, odd.column), (2, 1));
        let half = decode(b"\xfe\xff\0a\xd8\x00\0b").unwrap_err();
        assert_eq!((half.line, half.column), (1, 2));
    }

    #[test]
    fn lines_end_in_three_ways() {
        let text = "a\r\nbb\rc\n\nd";
        let found: Vec<_> = lines(text).collect();
        assert_eq!(found, [(0, "a"), (3, "bb"), (6, "c"), (8, ""), (9, "d")]);
        assert_eq!(place(text, 4), (2, 2));
        assert_eq!(place(text, 9), (5, 1));
        let parts: Vec<_> = fields(10, "  é x\t12 ").collect();
        assert_eq!(parts, [(12, "é"), (15, "x"), (17, "12")]);
    }
}

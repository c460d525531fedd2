//! Decoding of files: a byte order mark decides, else the XML declaration, else UTF-8.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};
use raconteur_eml::{Diagnostic, Span};

/// Length of the start of a file that may hold an XML declaration, bytes.
const DECLARATION_LENGTH: usize = 200;

/// Decodes the bytes of a file. Reports an encoding that is unknown, and bytes that are not text in
/// it.
#[must_use]
pub fn decode(bytes: &[u8]) -> (String, Vec<Diagnostic>) {
    let mut problems = Vec::new();
    let encoding = encoding(bytes, &mut problems);
    // A byte order mark takes precedence and is removed.
    let (text, used, malformed) = encoding.decode(bytes);
    if malformed {
        let at = text.find(char::REPLACEMENT_CHARACTER).unwrap_or(0);
        let at = u32::try_from(at).unwrap_or(u32::MAX);
        let message = format!("some bytes are not text in {}; they are lost", used.name());
        problems.push(Diagnostic::error(
            "annotate::encoding",
            Span::new(at, at.saturating_add(3)),
            message,
        ));
    }
    (text.into_owned(), problems)
}

fn encoding(bytes: &[u8], problems: &mut Vec<Diagnostic>) -> &'static Encoding {
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return encoding;
    }
    match bytes {
        [b'<', 0, ..] => return UTF_16LE,
        [0, b'<', ..] => return UTF_16BE,
        _ => {}
    }
    let start = &bytes[..bytes.len().min(DECLARATION_LENGTH)];
    let start = String::from_utf8_lossy(start);
    let Some(label) = declared(&start) else {
        return UTF_8;
    };
    // Bytes in which the declaration is readable are not UTF-16, whatever it says.
    match Encoding::for_label(label.as_bytes()) {
        Some(encoding) if encoding != UTF_16LE && encoding != UTF_16BE => encoding,
        Some(_) => UTF_8,
        None => {
            let message = format!(
                "the encoding {} is unknown; the file is read as UTF-8",
                raconteur_eml::quoted(label)
            );
            problems.push(Diagnostic::warning(
                "annotate::encoding",
                Span::new(0, 0),
                message,
            ));
            UTF_8
        }
    }
}

/// Returns the encoding that an XML declaration names.
fn declared(start: &str) -> Option<&str> {
    let declaration = start.trim_start().strip_prefix("<?xml")?;
    let declaration = declaration.split_once("?>")?.0;
    let (_, value) = declaration.split_once("encoding")?;
    let value = value.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    value[1..].split_once(quote).map(|(label, _)| label)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(bytes: &[u8]) -> String {
        let (text, problems) = decode(bytes);
        assert_eq!(problems, [], "{text}");
        text
    }

    #[test]
    fn mark_and_declaration_tell_the_encoding() {
        let latin = b"<?xml version='1.0' encoding=\"ISO-8859-1\"?><a>\xe9</a>";
        assert!(text(latin).ends_with("<a>é</a>"), "declared");
        assert_eq!(text("\u{feff}<a>é</a>".as_bytes()), "<a>é</a>");
        for big in [false, true] {
            let unit = |u: u16| {
                if big {
                    u.to_be_bytes()
                } else {
                    u.to_le_bytes()
                }
            };
            for source in ["\u{feff}<a>é</a>", "<a>é</a>"] {
                let bytes: Vec<u8> = source.encode_utf16().flat_map(unit).collect();
                assert_eq!(text(&bytes), "<a>é</a>");
            }
        }
    }

    #[test]
    fn what_is_not_text_is_told() {
        let (text, problems) = decode(b"<a>\xff</a>");
        assert_eq!(problems[0].code, "annotate::encoding");
        assert_eq!(problems[0].span.slice(&text), "\u{fffd}");
        let (_, problems) = decode(b"<?xml version='1.0' encoding='klingon'?><a/>");
        assert_eq!(problems[0].code, "annotate::encoding");
    }
}

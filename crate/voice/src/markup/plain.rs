//! Plain text file: paragraphs between blank lines, and verse.

use crate::content::{Boundary, Content, Division, Segment};

use super::levels::PAUSES;
use super::xml::legal;

/// Lines of verse are shorter, characters. Prose is broken near 72 or not at all.
const VERSE: usize = 60;

/// Reads plain text. Blank lines separate paragraphs. A line end inside a paragraph of short lines
/// is a small pause as before a comma, unless the line already ends with punctuation of a sentence
/// or clause. All line ends and a byte order mark are accepted. Characters not allowed in documents
/// become U+FFFD.
#[must_use]
pub fn read(text: &str) -> Content {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let text = legal(text).replace("\r\n", "\n").replace('\r', "\n");
    let mut segments = Vec::new();
    let lines: Vec<&str> = text.split('\n').map(str::trim).collect();
    for paragraph in lines.split(|line| line.is_empty()) {
        if paragraph.is_empty() {
            continue;
        }
        let is_verse = paragraph.len() > 1
            && paragraph
                .iter()
                .all(|line| line.chars().take(VERSE).count() < VERSE);
        if !segments.is_empty() {
            segments.push(Segment::Division(Division::Paragraph));
        }
        for (i, line) in paragraph.iter().enumerate() {
            if i > 0 {
                segments.push(between(paragraph[i - 1], is_verse));
            }
            segments.push(Segment::Text((*line).to_owned()));
        }
    }
    Content { segments }
}

/// Returns the separator between a line and the next one of its paragraph.
fn between(line: &str, is_verse: bool) -> Segment {
    let closing = [
        '"', '\'', ')', ']', '\u{201d}', '\u{201c}', '\u{2019}', '\u{bb}', '\u{ab}',
    ];
    let ends = line
        .trim_end_matches(closing)
        .ends_with(['.', '!', '?', '\u{2026}', ':', ';', ',']);
    if is_verse && !ends {
        let [_, (_, small), ..] = PAUSES;
        Segment::Break {
            msec: small as u32,
            boundary: Some(Boundary::Comma),
        }
    } else {
        Segment::Text("\n".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verse_pauses_at_its_line_ends_and_prose_does_not() {
        let verse =
            read("\u{feff}Two rivers met\r\nand ran as one.\r\nAnd then\r\n\r\n\r\nThe sea\r\n");
        let pause = Segment::Break {
            msec: 150,
            boundary: Some(Boundary::Comma),
        };
        let text = |t: &str| Segment::Text(t.to_owned());
        assert_eq!(
            verse.segments,
            [
                text("Two rivers met"),
                pause,
                text("and ran as one."),
                text("\n"),
                text("And then"),
                Segment::Division(Division::Paragraph),
                text("The sea")
            ]
        );
        let prose = read(&format!("{}\nshort", "word ".repeat(13)));
        assert!(
            prose.segments.iter().all(|s| matches!(s, Segment::Text(_))),
            "prose has text segments only"
        );
        assert_eq!(prose.words().len(), 14);
        assert_eq!(read(" \n\r\n"), Content::default());
    }
}

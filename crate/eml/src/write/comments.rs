//! Comments of a text.

use quick_xml::Reader;
use quick_xml::events::Event;

/// Comment of an EML document with its byte position.
#[derive(Clone, Copy)]
pub(super) struct Comment<'s> {
    /// Offset of its first byte.
    pub(super) start: u32,
    /// The whole comment, its marks included.
    pub(super) text: &'s str,
}

/// Comments of an EML document, divided into those before, inside and after the root element.
#[derive(Default)]
pub(super) struct Comments<'s> {
    pub(super) before: Vec<Comment<'s>>,
    pub(super) inside: Vec<Comment<'s>>,
    pub(super) after: Vec<Comment<'s>>,
}

/// Returns the comments of a well-formed text, or those up to its first error.
pub(super) fn collect_comments(source: &str) -> Comments<'_> {
    let mut found = Comments::default();
    let mut reader = Reader::from_str(source);
    let (mut depth, mut rooted) = (0_usize, false);
    loop {
        let start = reader.buffer_position();
        let event = reader.read_event();
        let end = reader.buffer_position();
        match event {
            Ok(Event::Start(_)) => (depth, rooted) = (depth + 1, true),
            Ok(Event::Empty(_)) => rooted = true,
            Ok(Event::End(_)) => depth = depth.saturating_sub(1),
            Ok(Event::Comment(_)) => {
                let (Ok(from), Ok(to)) = (usize::try_from(start), usize::try_from(end)) else {
                    return found;
                };
                let list = match (rooted, depth) {
                    (false, _) => &mut found.before,
                    (true, 0) => &mut found.after,
                    (true, _) => &mut found.inside,
                };
                list.push(Comment {
                    start: u32::try_from(start).unwrap_or(u32::MAX),
                    text: &source[from..to],
                });
            }
            Ok(Event::Eof) | Err(_) => return found,
            Ok(_) => {}
        }
    }
}

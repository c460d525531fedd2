//! Splitter of a byte stream into EML fragments.
//!
//! A fragment ends with the line in which all its elements are closed, or at an empty line. A mind
//! may therefore send one line or pretty-printed clauses, and malformed input ends at the next
//! empty line.

/// Splitter of a byte stream into EML fragments, one per connection. Memory is bounded by the
/// limit.
pub(crate) struct Framer {
    /// Current fragment, at most one byte longer than the limit.
    text: Vec<u8>,
    limit: usize,
    /// Elements that are open.
    depth: usize,
    state: State,
    /// True if only white space has arrived since the last end of line.
    blank: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Text,
    /// After `<`, before the kind of markup is known.
    Markup,
    /// Inside a tag.
    Tag {
        closing: bool,
        /// The last byte was `/`.
        slash: bool,
        quote: Option<u8>,
    },
    /// After `<!`: number of bytes that match `--` or `[CDATA[`.
    Declaration(usize),
    /// In a comment, a CDATA section or an instruction: number of matched bytes of its end.
    Until(&'static [u8], usize),
}

const OPEN_CDATA: &[u8] = b"[CDATA[";

impl Framer {
    /// Creates a splitter; a fragment longer than `limit` bytes is truncated to one byte more.
    pub(crate) fn new(limit: usize) -> Self {
        Self {
            text: Vec::new(),
            limit,
            depth: 0,
            state: State::Text,
            blank: true,
        }
    }

    /// Processes bytes; returns the fragments that they complete, in order.
    pub(crate) fn push(&mut self, bytes: &[u8]) -> Vec<String> {
        let mut fragments = Vec::new();
        for &byte in bytes {
            if self.text.len() <= self.limit {
                self.text.push(byte);
            }
            if byte == b'\n' {
                let over = self.blank || (self.depth == 0 && self.state == State::Text);
                self.blank = true;
                if over {
                    fragments.extend(self.finish());
                    continue;
                }
            } else {
                self.blank &= byte.is_ascii_whitespace();
            }
            self.step(byte);
        }
        fragments
    }

    /// Returns the rest of the stream, or of a line, as the last fragment; `None` if it is blank.
    pub(crate) fn finish(&mut self) -> Option<String> {
        let text = std::mem::take(&mut self.text);
        (self.depth, self.state, self.blank) = (0, State::Text, true);
        let text = String::from_utf8_lossy(&text);
        let text = text.trim_end_matches(['\r', '\n']);
        (!text.trim().is_empty()).then(|| text.to_owned())
    }

    fn step(&mut self, byte: u8) {
        self.state = match (self.state, byte) {
            (State::Text, b'<') => State::Markup,
            (State::Text, _) => State::Text,
            (State::Markup, b'!') => State::Declaration(0),
            (State::Markup, b'?') => State::Until(b"?>", 0),
            (State::Markup, b'>') => State::Text,
            (State::Markup, _) => State::Tag {
                closing: byte == b'/',
                slash: false,
                quote: None,
            },
            (State::Tag { closing, quote, .. }, _) if quote.is_some() => State::Tag {
                closing,
                slash: false,
                quote: quote.filter(|q| *q != byte),
            },
            (State::Tag { closing: true, .. }, b'>') => {
                self.depth = self.depth.saturating_sub(1);
                State::Text
            }
            (State::Tag { slash, .. }, b'>') => {
                self.depth += usize::from(!slash);
                State::Text
            }
            (State::Tag { closing, .. }, _) => State::Tag {
                closing,
                slash: byte == b'/',
                quote: matches!(byte, b'"' | b'\'').then_some(byte),
            },
            (State::Declaration(1), b'-') if self.text.ends_with(b"--") => State::Until(b"-->", 0),
            (State::Declaration(0), b'-') => State::Declaration(1),
            (State::Declaration(n), _) if OPEN_CDATA.get(n) == Some(&byte) => {
                if n + 1 == OPEN_CDATA.len() {
                    State::Until(b"]]>", 0)
                } else {
                    State::Declaration(n + 1)
                }
            }
            (State::Declaration(_), b'>') => State::Text,
            (State::Declaration(_), _) => State::Declaration(OPEN_CDATA.len()),
            (State::Until(end, seen), _) if end.get(seen) == Some(&byte) => {
                if seen + 1 == end.len() {
                    State::Text
                } else {
                    State::Until(end, seen + 1)
                }
            }
            // `--->` and `]]]>` also end the section: a repeated first byte keeps the count.
            (State::Until(end, seen), _) if seen == end.len() - 1 && byte == end[0] => {
                State::Until(end, seen)
            }
            (State::Until(end, _), _) => State::Until(end, usize::from(byte == end[0])),
        };
    }
}

/// Checks the invariants for any bytes and any division into packets: the same fragments, none
/// empty, none longer than the limit.
///
/// # Panics
/// Panics if an invariant does not hold.
pub fn assert_valid(bytes: &[u8]) {
    const LIMIT: usize = 64;
    let fragments = |packet: usize| {
        let mut framer = Framer::new(LIMIT);
        let mut all: Vec<String> = bytes.chunks(packet).flat_map(|p| framer.push(p)).collect();
        all.extend(framer.finish());
        all
    };
    let whole = fragments(bytes.len().max(1));
    for packet in [1, 2, 7] {
        assert_eq!(whole, fragments(packet));
    }
    for fragment in &whole {
        // A byte that is not UTF-8 becomes three.
        assert!(
            !fragment.trim().is_empty() && fragment.len() <= 3 * (LIMIT + 1),
            "the fragment is not empty and within its limit"
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn saved_streams_hold_together() {
        let folder =
            std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/saved/serve_framing");
        for entry in std::fs::read_dir(folder).expect("a folder of streams") {
            let bytes = std::fs::read(entry.expect("an entry").path()).expect("a stream");
            assert_valid(&bytes);
            super::super::greeting::assert_valid(&bytes);
        }
    }

    proptest! {
        #[test]
        fn streams_of_markup_hold_together(bytes in "([<>/!?'\"a\n\r -]|<!--|-->|<!\\[CDATA\\[|\\]\\]>){0,80}") {
            assert_valid(bytes.as_bytes());
        }
    }

    /// Returns the fragments of a test stream, and checks that the division into packets has no
    /// effect.
    fn frames(stream: &str) -> Vec<String> {
        let whole = {
            let mut framer = Framer::new(60);
            let mut all = framer.push(stream.as_bytes());
            all.extend(framer.finish());
            all
        };
        let mut framer = Framer::new(60);
        let mut bytewise: Vec<String> = stream.bytes().flat_map(|b| framer.push(&[b])).collect();
        bytewise.extend(framer.finish());
        assert_eq!(whole, bytewise);
        whole
    }

    #[test]
    fn a_line_with_everything_closed_is_a_fragment() {
        assert_eq!(
            frames("<null/>\n<null/><null/>\r\n"),
            ["<null/>", "<null/><null/>"]
        );
        assert_eq!(
            frames("<seq>\n <null/>\n</seq>\n<null/>"),
            ["<seq>\n <null/>\n</seq>", "<null/>"]
        );
        assert_eq!(
            frames("<a b='>/' c=\"</a>\">\n</a>\n"),
            ["<a b='>/' c=\"</a>\">\n</a>"]
        );
        assert_eq!(frames("<a><![CDATA[</a>\n]]]></a>\n<b/>\n").len(), 2);
        assert_eq!(frames("<!-- <a> --->\n<?x <a> ?>\n<!DOCTYPE a>\n").len(), 3);
        assert_eq!(frames("hello\n\n\n@2.5\n"), ["hello", "@2.5"]);
    }

    #[test]
    fn an_empty_line_ends_what_is_malformed() {
        assert_eq!(frames("<a b='\n\n<null/>\n"), ["<a b='", "<null/>"]);
        assert_eq!(frames("<!-- x\n \n<null/>\n"), ["<!-- x\n ", "<null/>"]);
    }

    #[test]
    fn memory_is_bounded() {
        let long = format!("<a>{}</a>\n<null/>\n", "x".repeat(1000));
        let frames = frames(&long);
        assert_eq!((frames[0].len(), frames[1].as_str()), (61, "<null/>"));
    }
}

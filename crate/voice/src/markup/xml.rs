//! Tags and texts of a document, with `quick-xml` as the tokenizer: bounded, without a DTD, and
//! with the position of everything.

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};

use super::{MAX_DOCUMENT_BYTES, NAMESPACE, Problem};

/// Maximum nesting depth of elements. The output for the deepest markup, with its sentences and
/// paragraphs, stays below.
const MAX_ELEMENT_DEPTH: usize = 400;
/// Maximum number of elements in a document.
const MAX_ELEMENTS: usize = 200_000;
/// Maximum number of attributes of an element.
const MAX_ATTRIBUTES: usize = 32;
/// Maximum number of prefixes declared at one position.
const MAX_PREFIXES: usize = 64;
/// Maximum length of an attribute value, bytes: each word's style may store some.
const MAX_VALUE_LENGTH: usize = 1000;
/// Maximum number of reported problems.
const MAX_PROBLEMS: usize = 100;

const SSML: &str = "http://www.w3.org/2001/10/synthesis";

/// Token of an XML document: start tag, end tag or text.
pub(crate) enum Token {
    Start(Tag),
    End,
    Text(String),
}

/// Start tag with its attributes and position.
pub(crate) struct Tag {
    /// Without its prefix.
    pub(crate) name: String,
    /// Namespace of the element.
    pub(crate) space: Space,
    pub(crate) attributes: Vec<Attribute>,
    /// Byte where it begins.
    pub(crate) at: usize,
    /// True if the element is written as an empty element.
    pub(crate) is_empty: bool,
}

/// Attribute of a start tag.
pub(crate) struct Attribute {
    /// Without its prefix, except `xml:`.
    pub(crate) name: String,
    pub(crate) space: Space,
    pub(crate) value: String,
}

/// Namespace of an element or attribute name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Space {
    /// The document's own language, or none.
    Own,
    /// Namespace of Raconteur, [`NAMESPACE`].
    Ours,
    /// Another namespace.
    Other,
}

impl Tag {
    /// Returns the value of an attribute of the document's language, case-insensitively.
    pub(crate) fn get(&self, name: &str) -> Option<&str> {
        self.find(Space::Own, name)
    }

    /// Returns the value of an attribute in [`NAMESPACE`]; `None` if it is absent.
    pub(crate) fn own_attribute(&self, name: &str) -> Option<&str> {
        self.find(Space::Ours, name)
    }

    fn find(&self, space: Space, name: &str) -> Option<&str> {
        let is = |a: &&Attribute| a.space == space && a.name.eq_ignore_ascii_case(name);
        Some(&self.attributes.iter().find(is)?.value)
    }
}

/// XML reader that returns a document piece by piece and collects its problems.
pub(crate) struct Pieces<'a> {
    source: &'a str,
    reader: Reader<&'a [u8]>,
    /// Names of the open elements as they are written.
    open: Vec<String>,
    /// True if `</emph>` closes `<EMPH>`.
    any_case: bool,
    /// Prefixes in scope with the depth of their element.
    prefixes: Vec<(String, Space, usize)>,
    elements: usize,
    problems: Vec<Problem>,
}

impl<'a> Pieces<'a> {
    /// Creates a reader at the start of a document; `any_case` accepts end tags in any case.
    pub(crate) fn new(source: &'a str, any_case: bool) -> Result<Self, Problem> {
        let source = source.strip_prefix('\u{feff}').unwrap_or(source);
        let mut reader = Reader::from_str(source);
        let config = reader.config_mut();
        config.expand_empty_elements = true;
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        let pieces = Self {
            source,
            reader,
            open: Vec::new(),
            any_case,
            prefixes: Vec::new(),
            elements: 0,
            problems: Vec::new(),
        };
        if source.len() > MAX_DOCUMENT_BYTES {
            return Err(pieces.problem(0, format!("longer than {MAX_DOCUMENT_BYTES} bytes")));
        }
        Ok(pieces)
    }

    /// Returns the next token; `None` at the end.
    pub(crate) fn next(&mut self) -> Result<Option<Token>, Problem> {
        loop {
            let at = self.position();
            let event = match self.reader.read_event() {
                Ok(event) => event,
                Err(error) => {
                    let at = usize::try_from(self.reader.error_position()).unwrap_or(at);
                    return Err(self.problem(at, error.to_string()));
                }
            };
            return Ok(Some(match event {
                Event::Start(tag) | Event::Empty(tag) => Token::Start(self.start(&tag, at)?),
                Event::End(tag) => {
                    self.end(tag.name().0, at)?;
                    Token::End
                }
                Event::Text(text) => Token::Text(legal(&text.xml10_content())),
                Event::CData(text) => Token::Text(legal(&text.xml10_content())),
                Event::GeneralRef(reference) => {
                    let name = reference.xml10_content();
                    let c = match reference.resolve_char_ref() {
                        Ok(Some(c)) => c,
                        Ok(None) => self.entity(&name, at)?,
                        Err(error) => return Err(self.problem(at, error.to_string())),
                    };
                    Token::Text(legal(c.encode_utf8(&mut [0; 4])))
                }
                Event::DocType(text) => {
                    self.doctype(&text.into_inner(), at)?;
                    continue;
                }
                Event::Comment(_) | Event::PI(_) | Event::Decl(_) => continue,
                Event::Eof => {
                    return match self.open.last() {
                        Some(name) => Err(self.problem(at, format!("<{name}> is not closed"))),
                        None => Ok(None),
                    };
                }
            }));
        }
    }

    /// Reports a problem at a byte offset, and continues.
    pub(crate) fn report(&mut self, at: usize, message: impl Into<String>) {
        if self.problems.len() < MAX_PROBLEMS {
            let problem = self.problem(at, message);
            self.problems.push(problem);
        }
    }

    /// Creates a problem at a byte offset.
    pub(crate) fn problem(&self, at: usize, message: impl Into<String>) -> Problem {
        let before = self.source.as_bytes().get(..at).unwrap_or_default();
        let begin = before
            .iter()
            .rposition(|&b| b == b'\n')
            .map_or(0, |i| i + 1);
        // Bytes that begin a character.
        let characters = before[begin..].iter().filter(|&&b| b & 0xc0 != 0x80);
        Problem {
            line: 1 + before.iter().filter(|&&b| b == b'\n').count(),
            column: 1 + characters.count(),
            message: message.into(),
        }
    }

    /// Returns the collected problems.
    pub(crate) fn into_problems(self) -> Vec<Problem> {
        self.problems
    }

    fn position(&self) -> usize {
        usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX)
    }

    fn start(&mut self, tag: &BytesStart<'_>, at: usize) -> Result<Tag, Problem> {
        self.elements += 1;
        if self.elements > MAX_ELEMENTS {
            return Err(self.problem(at, format!("more than {MAX_ELEMENTS} elements")));
        }
        if self.open.len() >= MAX_ELEMENT_DEPTH {
            return Err(self.problem(at, format!("more than {MAX_ELEMENT_DEPTH} elements deep")));
        }
        let written = tag.name().0;
        self.open.push(written.to_owned());
        let mut found: Vec<(String, String)> = Vec::new();
        for attribute in tag.attributes().with_checks(false) {
            let attribute = attribute.map_err(|e| self.problem(at, e.to_string()))?;
            let name = attribute.key.0;
            if found.len() >= MAX_ATTRIBUTES {
                let message = format!("more than {MAX_ATTRIBUTES} attributes");
                return Err(self.problem(at, message));
            }
            if found.iter().any(|(n, _)| n == name) {
                return Err(self.problem(at, format!("the attribute {name} is given twice")));
            }
            if attribute.value.len() > MAX_VALUE_LENGTH {
                self.report(
                    at,
                    format!("{name} is longer than {MAX_VALUE_LENGTH} bytes, and ignored"),
                );
                continue;
            }
            let value = attribute
                .normalized_value(XmlVersion::Implicit1_0)
                .map_err(|e| self.problem(at, e.to_string()))?;
            found.push((name.to_owned(), legal(&value)));
        }
        for (name, value) in &found {
            let prefix = match name.split_once(':') {
                Some(("xmlns", prefix)) => prefix,
                _ => continue,
            };
            if self.prefixes.len() >= MAX_PREFIXES {
                let message = format!("more than {MAX_PREFIXES} prefixes");
                return Err(self.problem(at, message));
            }
            let space = match value.as_str() {
                NAMESPACE => Space::Ours,
                SSML => Space::Own,
                _ => Space::Other,
            };
            self.prefixes
                .push((prefix.to_owned(), space, self.open.len()));
        }
        let attributes = found
            .into_iter()
            .filter(|(name, _)| name != "xmlns" && !name.starts_with("xmlns:"))
            .map(|(name, value)| {
                let (space, local) = self.place(&name);
                Attribute {
                    name: local.to_owned(),
                    space,
                    value,
                }
            })
            .collect();
        let (space, name) = self.place(written);
        Ok(Tag {
            name: name.to_owned(),
            space,
            attributes,
            at,
            is_empty: self.source[..self.position()].ends_with("/>"),
        })
    }

    /// Returns the namespace of a name, and the name without its prefix.
    fn place<'n>(&self, name: &'n str) -> (Space, &'n str) {
        match name.split_once(':') {
            None | Some(("xml", _)) => (Space::Own, name),
            Some((prefix, local)) => {
                let known = self.prefixes.iter().rev().find(|(p, _, _)| p == prefix);
                (known.map_or(Space::Other, |(_, space, _)| *space), local)
            }
        }
    }

    fn end(&mut self, name: &str, at: usize) -> Result<(), Problem> {
        let depth = self.open.len();
        self.prefixes.retain(|(_, _, d)| *d < depth);
        let Some(open) = self.open.pop() else {
            return Err(self.problem(at, format!("</{name}> has no start tag")));
        };
        let same = open == name || (self.any_case && open.eq_ignore_ascii_case(name));
        if !same {
            return Err(self.problem(at, format!("</{name}> where <{open}> is open")));
        }
        Ok(())
    }

    fn entity(&self, name: &str, at: usize) -> Result<char, Problem> {
        Ok(match name {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            "apos" => '\'',
            _ => return Err(self.problem(at, format!("&{name}; is not known"))),
        })
    }

    /// Accepts a document type name without declarations; Festival's own examples have an empty
    /// pair of brackets.
    fn doctype(&self, text: &str, at: usize) -> Result<(), Problem> {
        let outside_quotes = text.split(['"', '\'']).step_by(2);
        let declares = outside_quotes
            .flat_map(str::chars)
            .skip_while(|&c| c != '[')
            .any(|c| !matches!(c, '[' | ']') && !c.is_whitespace());
        if declares || text.contains("<!") {
            return Err(self.problem(at, "declarations in the document type are refused"));
        }
        Ok(())
    }
}

/// Replaces each character that XML cannot contain by U+FFFD.
pub(crate) fn legal(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\t' | '\n' | '\r' => c,
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => char::REPLACEMENT_CHARACTER,
            _ => c,
        })
        .collect()
}

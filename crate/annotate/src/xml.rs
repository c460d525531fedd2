//! XML files as trees of elements that know their position.
//!
//! Namespaces are ignored, because files of one format exist with and without them. A document type
//! declaration is not read, so no entity can be defined.

use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use raconteur_eml::{Diagnostic, Span, quoted};

/// Maximum length of a file, bytes.
pub const MAX_BYTES: usize = 16 << 20;
/// Maximum nesting of elements.
const MAX_DEPTH: usize = 64;
/// Maximum number of elements of a file.
const MAX_ELEMENTS: usize = 500_000;
/// Maximum number of attributes of an element.
const MAX_ATTRIBUTES: usize = 64;

/// Element of an XML file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Element {
    /// Name without prefix.
    pub name: String,
    /// Span of the start tag.
    pub tag: Span,
    /// Attributes in source order.
    pub attributes: Vec<Attribute>,
    /// Child elements in source order.
    pub children: Vec<Element>,
    /// Character data directly inside, without that of children.
    pub text: Text,
    /// Byte offset in the text of the parent at which the element stands.
    pub position: usize,
}

/// Attribute of an element.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name without prefix.
    pub name: String,
    /// Value with resolved references.
    pub text: Text,
}

/// Text of an element or attribute, with its position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Text {
    /// Characters with resolved references, without surrounding white space.
    pub value: String,
    /// Span in the source; empty if there is no text.
    pub span: Span,
    /// True if the value equals the source under the span, so offsets in it are source offsets.
    exact: bool,
}

impl From<String> for Text {
    /// Creates a text without a place in a file.
    fn from(value: String) -> Self {
        Self {
            value,
            ..Self::default()
        }
    }
}

impl Text {
    /// Returns another value at the same place.
    #[must_use]
    pub(crate) fn with_value(&self, value: String) -> Self {
        Self {
            value,
            span: self.span,
            exact: false,
        }
    }

    /// Returns the span of bytes `start` to `end` of the value. The whole text if it contains
    /// references, which makes offsets differ.
    #[must_use]
    pub fn span_within(&self, start: usize, end: usize) -> Span {
        if self.exact {
            let shifted = |at: usize| self.span.start.saturating_add(offset(at));
            Span::new(shifted(start), shifted(end))
        } else {
            self.span
        }
    }
}

impl Element {
    /// Returns an attribute by name, case-insensitively.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Text> {
        let mut found = self.attributes.iter();
        Some(&found.find(|a| a.name.eq_ignore_ascii_case(name))?.text)
    }

    /// Returns the value of an attribute; `None` if it is absent or empty.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<&str> {
        let value = self.attribute(name)?.value.as_str();
        (!value.is_empty()).then_some(value)
    }

    /// Returns the finite number of an attribute. Reports a text that is none as `code`.
    pub fn number(
        &self,
        name: &str,
        code: &'static str,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<f64> {
        let text = self.attribute(name).filter(|text| !text.value.is_empty())?;
        let number = text.value.parse::<f64>().ok().filter(|n| n.is_finite());
        if number.is_none() {
            let message = format!("`{name}` is {}, not a number", quoted(&text.value));
            problems.push(Diagnostic::error(code, text.span, message));
        }
        number
    }

    /// Returns the children of a name, case-insensitively.
    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        let is_named = move |child: &&Element| child.name.eq_ignore_ascii_case(name);
        self.children.iter().filter(is_named)
    }

    /// Returns the first child of a name.
    #[must_use]
    pub fn child(&self, name: &str) -> Option<&Element> {
        let mut children = self.children.iter();
        children.find(|child| child.name.eq_ignore_ascii_case(name))
    }
}

/// Parses a file. Malformed markup is reported; the result is then what precedes it. `None` without
/// any element.
pub fn parse(source: &str, problems: &mut Vec<Diagnostic>) -> Option<Element> {
    if source.len() > MAX_BYTES {
        let message = format!("the file is longer than {MAX_BYTES} bytes");
        problems.push(Diagnostic::error(
            "xml::too-large",
            Span::new(0, 0),
            message,
        ));
        return None;
    }
    let mut builder = Builder {
        source,
        reader: Reader::from_str(source),
        open: Vec::new(),
        root: None,
        elements: 0,
    };
    let fault = builder.read().err();
    while !builder.open.is_empty() {
        builder.close();
    }
    let is_whole = fault.is_none();
    problems.extend(fault);
    if builder.root.is_none() && is_whole {
        let message = "this is not an XML file: it has no element";
        problems.push(Diagnostic::error("xml::empty", Span::new(0, 0), message));
    }
    builder.root
}

struct Builder<'a> {
    source: &'a str,
    reader: Reader<&'a [u8]>,
    open: Vec<Element>,
    root: Option<Element>,
    elements: usize,
}

impl<'a> Builder<'a> {
    fn read(&mut self) -> Result<(), Diagnostic> {
        loop {
            let start = self.position();
            let event = self.reader.read_event().map_err(|error| {
                let at = usize::try_from(self.reader.error_position()).unwrap_or(start);
                malformed(at, error.to_string())
            })?;
            let end = self.position();
            match event {
                Event::Start(tag) => self.start(&tag, start, end)?,
                Event::Empty(tag) => {
                    self.start(&tag, start, end)?;
                    self.close();
                }
                Event::End(_) => self.close(),
                Event::Text(text) => self.text(&text, start),
                Event::CData(text) => self.text(&text, start + "<![CDATA[".len()),
                Event::GeneralRef(name) => {
                    let character = name.resolve_char_ref();
                    let character = character.map_err(|e| malformed(start, e.to_string()))?;
                    match (character, resolve_predefined_entity(&name)) {
                        (Some(c), _) => self.reference(c.encode_utf8(&mut [0; 4]), start, end),
                        (None, Some(text)) => self.reference(text, start, end),
                        (None, None) => {
                            let name = quoted(&name);
                            return Err(malformed(start, format!("{name} is not an entity")));
                        }
                    }
                }
                Event::Eof if self.open.is_empty() => return Ok(()),
                Event::Eof => {
                    let name = self.open.last().map_or("", |open| &open.name);
                    let message = format!("the file ends inside `{name}`");
                    return Err(malformed(start, message));
                }
                Event::Decl(_) | Event::PI(_) | Event::DocType(_) | Event::Comment(_) => {}
            }
        }
    }

    fn position(&self) -> usize {
        usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX)
    }

    fn start(&mut self, tag: &BytesStart<'_>, start: usize, end: usize) -> Result<(), Diagnostic> {
        self.elements += 1;
        if self.open.len() >= MAX_DEPTH || self.elements > MAX_ELEMENTS {
            let message = format!(
                "more than {MAX_DEPTH} levels or {MAX_ELEMENTS} elements; reading stops here"
            );
            return Err(Diagnostic::error(
                "xml::too-large",
                span(start, end),
                message,
            ));
        }
        let mut attributes = Vec::new();
        // The check for duplicates is quadratic in their number.
        for attribute in tag.attributes().with_checks(false).take(MAX_ATTRIBUTES) {
            let attribute = attribute.map_err(|e| malformed(start, e.to_string()))?;
            let raw = &*attribute.value;
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value = value.map_err(|e| malformed(start, e.to_string()))?;
            let at = self.offset_of(raw).unwrap_or(start);
            attributes.push(Attribute {
                name: attribute.key.local_name().into_inner().to_owned(),
                text: trimmed(Text {
                    exact: value == raw,
                    value: value.into_owned(),
                    span: span(at, at + raw.len()),
                }),
            });
        }
        let position = self.open.last().map_or(0, |open| open.text.value.len());
        self.open.push(Element {
            position,
            name: tag.local_name().into_inner().to_owned(),
            tag: span(start, end),
            attributes,
            ..Element::default()
        });
        Ok(())
    }

    /// Returns the offset of a part of the source.
    fn offset_of(&self, part: &str) -> Option<usize> {
        let offset = (part.as_ptr() as usize).checked_sub(self.source.as_ptr() as usize)?;
        (self.source.get(offset..offset + part.len()) == Some(part)).then_some(offset)
    }

    fn text(&mut self, text: &str, at: usize) {
        let Some(open) = self.open.last_mut() else {
            return;
        };
        let known = &mut open.text;
        let span = span(at, at + text.len());
        if known.value.is_empty() {
            // Leading white space is dropped at the end with the rest.
            (known.span, known.exact) = (span, true);
        } else {
            known.exact &= known.span.end == span.start;
            known.span = known.span.to(span);
        }
        known.value.push_str(text);
    }

    fn reference(&mut self, text: &str, start: usize, end: usize) {
        if let Some(open) = self.open.last_mut() {
            open.text.value.push_str(text);
            open.text.span = if open.text.span == Span::default() {
                span(start, end)
            } else {
                open.text.span.to(span(start, end))
            };
            open.text.exact = false;
        }
    }

    fn close(&mut self) {
        let Some(mut element) = self.open.pop() else {
            return;
        };
        let white = element.text.value.len() - element.text.value.trim_start().len();
        element.text = trimmed(element.text);
        for child in &mut element.children {
            let position = child.position.saturating_sub(white);
            child.position = position.min(element.text.value.len());
        }
        match self.open.last_mut() {
            Some(parent) => parent.children.push(element),
            // Only the first root counts.
            None if self.root.is_none() => self.root = Some(element),
            None => {}
        }
    }
}

/// Removes white space around a text.
fn trimmed(text: Text) -> Text {
    let value = text.value.trim();
    if value.len() == text.value.len() {
        return text;
    }
    let before = text.value.len() - text.value.trim_start().len();
    Text {
        span: text.span_within(before, before + value.len()),
        value: value.to_owned(),
        ..text
    }
}

fn malformed(at: usize, message: String) -> Diagnostic {
    Diagnostic::error("xml::malformed", span(at, at), message)
}

/// Converts a byte offset of a file, which is limited to [`MAX_BYTES`].
fn offset(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

fn span(start: usize, end: usize) -> Span {
    Span::new(offset(start), offset(end))
}

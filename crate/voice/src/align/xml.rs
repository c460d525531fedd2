//! XML as a stream of pieces that know their position. Namespaces are ignored, because files of one
//! dialect exist with and without them.

use std::borrow::Cow;

use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::text::{TextError, number};

/// Deeper nesting is refused.
const MAX_DEPTH: usize = 256;

/// Start tag of an XML element, with its position.
pub(super) struct Element<'a> {
    tag: BytesStart<'a>,
    /// Byte of its `<`.
    pub(super) at: usize,
}

impl Element<'_> {
    /// Returns the name of the element without its prefix.
    pub(super) fn name(&self) -> &str {
        self.tag.local_name().into_inner()
    }

    /// Returns the value of an attribute, selected by its name without prefix; `None` if it is
    /// absent.
    pub(super) fn attribute(&self, name: &str) -> Result<Option<String>, TextError> {
        // The check for duplicates is quadratic in their number.
        for attribute in self.tag.attributes().with_checks(false) {
            let attribute = attribute.map_err(|e| TextError::new(self.at, e.to_string()))?;
            if attribute.key.local_name().into_inner() == name {
                let value = attribute.normalized_value(XmlVersion::Implicit1_0);
                let value = value.map_err(|e| TextError::new(self.at, e.to_string()))?;
                return Ok(Some(value.into_owned()));
            }
        }
        Ok(None)
    }

    /// Returns the numeric value of an attribute; `None` if it is absent or empty.
    pub(super) fn number(&self, name: &str) -> Result<Option<f64>, TextError> {
        match self.attribute(name)? {
            Some(value) if !value.trim().is_empty() => number(self.at, &value).map(Some),
            _ => Ok(None),
        }
    }
}

/// Event of the XML reader: start tag, end tag or text.
pub(super) enum XmlEvent<'a> {
    Start(Element<'a>),
    End(String),
    Text(Cow<'a, str>),
}

/// XML reader that returns a stream of events.
pub(super) struct Xml<'a> {
    reader: Reader<&'a [u8]>,
    depth: usize,
    /// The end of an empty element that has begun.
    ending: Option<String>,
    begun: bool,
}

impl<'a> Xml<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            reader: Reader::from_str(text),
            depth: 0,
            ending: None,
            begun: false,
        }
    }

    fn offset(&self) -> usize {
        usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX)
    }

    /// Returns the next event; `None` at the end of a complete document.
    pub(super) fn next(&mut self) -> Result<Option<XmlEvent<'a>>, TextError> {
        if let Some(name) = self.ending.take() {
            self.depth -= 1;
            return Ok(Some(XmlEvent::End(name)));
        }
        loop {
            let at = self.offset();
            let event = self.reader.read_event().map_err(|e| {
                let at = usize::try_from(self.reader.error_position()).unwrap_or(at);
                TextError::new(at, e.to_string())
            })?;
            let piece = match event {
                Event::Start(tag) => {
                    self.open(at)?;
                    XmlEvent::Start(Element { tag, at })
                }
                Event::Empty(tag) => {
                    self.open(at)?;
                    self.ending = Some(tag.local_name().into_inner().to_owned());
                    XmlEvent::Start(Element { tag, at })
                }
                Event::End(tag) => {
                    self.depth = self.depth.saturating_sub(1);
                    XmlEvent::End(tag.local_name().into_inner().to_owned())
                }
                Event::Text(text) => XmlEvent::Text(text.into_inner()),
                Event::CData(text) => XmlEvent::Text(text.into_inner()),
                Event::GeneralRef(name) => {
                    let c = name.resolve_char_ref();
                    match c.map_err(|e| TextError::new(at, e.to_string()))? {
                        Some(c) => XmlEvent::Text(Cow::Owned(c.to_string())),
                        None => match resolve_predefined_entity(&name) {
                            Some(text) => XmlEvent::Text(Cow::Borrowed(text)),
                            None => {
                                return Err(TextError::new(at, "an entity that is not defined"));
                            }
                        },
                    }
                }
                Event::Eof if self.depth > 0 => {
                    return Err(TextError::new(at, "the file ends inside an element"));
                }
                Event::Eof if !self.begun => return Err(TextError::new(at, "no element")),
                Event::Eof => return Ok(None),
                Event::Decl(_) | Event::PI(_) | Event::DocType(_) | Event::Comment(_) => continue,
            };
            return Ok(Some(piece));
        }
    }

    fn open(&mut self, at: usize) -> Result<(), TextError> {
        self.begun = true;
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(TextError::new(
                at,
                format!("more than {MAX_DEPTH} elements deep"),
            ));
        }
        Ok(())
    }
}

//! Writer of tags and texts.

use core::fmt::Write as _;

use quick_xml::escape::partial_escape;

use super::divisions::{DivisionTag, tags};
use super::xml::legal;
use super::{NAMESPACE, build};
use crate::content::{Content, Division, Markup, Segment, Setting};
use crate::style::MAX_FACTOR;

/// Attributes of an element to write: name and value.
pub(crate) type Attributes = Vec<(&'static str, String)>;

/// Element to write, with its attributes.
#[derive(Default)]
pub(crate) struct Element {
    pub(crate) name: &'static str,
    pub(crate) attributes: Attributes,
}

impl Element {
    /// Creates an element without attributes.
    pub(crate) fn new(name: &'static str) -> Self {
        Self {
            name,
            attributes: Vec::new(),
        }
    }

    /// Returns the element with an additional attribute.
    pub(crate) fn with(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// Adds an attribute if it has a value.
    pub(crate) fn with_some(self, name: &'static str, value: Option<&str>) -> Self {
        match value {
            Some(value) if !value.is_empty() => self.with(name, value),
            _ => self,
        }
    }

    /// Adds a setting: as `text` and, if that is parsed differently, exactly in `ours`.
    pub(crate) fn with_setting(
        self,
        (name, ours): (&'static str, &'static str),
        setting: Setting,
        text: Option<String>,
        read: impl Fn(&str) -> Option<Vec<Setting>>,
    ) -> Self {
        let is_exact = text.as_deref().and_then(read) == Some(vec![setting]);
        let element = match text {
            Some(text) => self.with(name, text),
            None => self,
        };
        if is_exact {
            element
        } else {
            element.with(ours, build::exact_text(setting))
        }
    }
}

/// Writer that converts a content to elements of a markup language, SABLE or SSML.
pub(crate) trait MarkupWriter {
    /// Returns the element of a markup; `None` if nothing needs to be written.
    fn markup(&mut self, markup: &Markup) -> Option<Element>;
    /// Returns the element of a pause, a recording or a mark; `None` if nothing needs to be
    /// written.
    fn point(&mut self, segment: &Segment) -> Option<Element>;
    /// Notes that the most recently written markup ends.
    fn end(&mut self);
    /// Returns the element of a division.
    fn division(&self, division: Division) -> Element;
}

/// Writes the content as elements, without a root element.
pub(crate) fn body(content: &Content, language: &mut impl MarkupWriter) -> String {
    let mut out = String::new();
    // Names of the open elements; `None` for markup that is not written.
    let mut open: Vec<Option<&'static str>> = Vec::new();
    let divisions = tags(&content.segments);
    for (segment, tags) in content.segments.iter().zip(divisions) {
        match segment {
            Segment::Text(text) => escape(&mut out, text, false),
            Segment::Open(markup) => {
                let element = language.markup(markup);
                if let Some(element) = &element {
                    start(&mut out, element, ">");
                }
                open.push(element.map(|e| e.name));
            }
            Segment::Close => {
                if let Some(name) = open.pop() {
                    language.end();
                    end(&mut out, name);
                }
            }
            Segment::Division(_) => {
                for tag in tags {
                    match tag {
                        DivisionTag::Start(d) => start(&mut out, &language.division(d), ">"),
                        DivisionTag::End(d) => end(&mut out, Some(language.division(d).name)),
                        DivisionTag::Empty(d) => start(&mut out, &language.division(d), "/>"),
                    }
                }
            }
            point => {
                if let Some(element) = language.point(point) {
                    start(&mut out, &element, "/>");
                }
            }
        }
    }
    while let Some(name) = open.pop() {
        end(&mut out, name);
    }
    out
}

/// Returns the declaration of Raconteur's namespace for the root element; empty if the body does
/// not use it.
pub(crate) fn declaration(body: &str) -> String {
    if body.contains(" r:") || body.contains("<r:") {
        format!(" xmlns:r=\"{NAMESPACE}\"")
    } else {
        String::new()
    }
}

fn start(out: &mut String, element: &Element, close: &str) {
    // Writing into a string cannot fail.
    let _ = write!(out, "<{}", element.name);
    for (name, value) in &element.attributes {
        let _ = write!(out, " {name}=\"");
        escape(out, value, true);
        out.push('"');
    }
    out.push_str(close);
}

fn end(out: &mut String, name: Option<&str>) {
    if let Some(name) = name {
        let _ = write!(out, "</{name}>");
    }
}

/// Appends a text with XML special characters escaped.
pub(crate) fn escape(out: &mut String, text: &str, is_value: bool) {
    let legal = legal(text);
    let text = partial_escape(&legal);
    if !is_value {
        out.push_str(&text);
        return;
    }
    // `escape` writes apostrophes as references, too, and readers make spaces of lines and tabs in values.
    for c in text.chars() {
        match c {
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\t' => out.push_str("&#9;"),
            _ => out.push(c),
        }
    }
}

/// Returns the element of an emotion, in Raconteur's namespace; `None` for other markup.
pub(crate) fn emotion(markup: &Markup) -> Option<Element> {
    let Markup::Emotion {
        name,
        activation,
        evaluation,
        power,
    } = markup
    else {
        return None;
    };
    let axis = |x: &f64| {
        if x.is_finite() {
            x.clamp(-100.0, 100.0)
        } else {
            0.0
        }
    };
    Some(
        Element::new("r:emotion")
            .with("name", name.as_str())
            .with("activation", axis(activation).to_string())
            .with("evaluation", axis(evaluation).to_string())
            .with("power", axis(power).to_string()),
    )
}

/// Returns a loudness setting without infinities: gains are limited to the maximum.
pub(crate) fn loudness(setting: Setting) -> Setting {
    match setting {
        Setting::Value(gain) if gain > MAX_FACTOR => Setting::Value(MAX_FACTOR),
        Setting::Factor(f64::INFINITY) => Setting::Value(MAX_FACTOR),
        setting => setting,
    }
}

/// Returns the amplitude of a recording; `None` counts as silence.
pub(crate) fn gain(level: f64) -> f64 {
    if level.is_finite() {
        level.max(0.0)
    } else {
        0.0
    }
}

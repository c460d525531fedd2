//! The language as a RELAX NG schema: the same content as the reference page.

use super::children_of;
use crate::schema::{Attribute, Content, ELEMENTS, Element, Kind, Presence};
use std::fmt::Write as _;

/// Decimals as EML writes them.
const NUMBER: &str = r"[+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?";
/// A number of seconds, or one with a unit.
const SECONDS: &str = r"\s*\+?\s*([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?\s*[smh]?\s*";

/// Returns the RELAX NG schema of EML in XML syntax, for validating editors.
#[must_use]
pub fn relax_ng() -> String {
    let mut out = Indented::default();
    out.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    out.open(
        "grammar xmlns=\"http://relaxng.org/ns/structure/1.0\" \
         datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\"",
    );
    out.open("start");
    out.line("<ref name=\"eml\"/>");
    out.close("start");
    for element in ELEMENTS {
        define(&mut out, element);
    }
    out.close("grammar");
    out.text
}

/// Returns the name of the schema pattern of an element.
fn pattern_of(element: &Element) -> String {
    let shared = ELEMENTS.iter().filter(|e| e.name == element.name).count() > 1;
    if shared {
        format!("{}-in-{}", element.name, element.parents.join("-"))
    } else {
        element.name.to_owned()
    }
}

fn define(out: &mut Indented, element: &Element) {
    out.open(&format!("define name=\"{}\"", pattern_of(element)));
    let namespace = if element.extension {
        crate::EXTENSIONS
    } else {
        ""
    };
    out.open(&format!(
        "element name=\"{}\" ns=\"{namespace}\"",
        element.name
    ));
    for attribute in element.all_attributes() {
        if !element.one_of.contains(&attribute.name) {
            let required = attribute.default == Presence::Required;
            self::attribute(out, attribute, required);
        }
    }
    one_of(out, element, element.one_of);
    content(out, element);
    out.close("element");
    out.close("define");
}

/// Writes a choice that requires at least one of the named attributes.
fn one_of(out: &mut Indented, element: &Element, names: &[&str]) {
    let find = |name: &str| element.attributes.iter().find(|a| a.name == name);
    if names.is_empty() {
        return;
    }
    out.open("choice");
    for (place, name) in names.iter().enumerate() {
        out.open("group");
        find(name).into_iter().for_each(|a| attribute(out, a, true));
        for later in &names[place + 1..] {
            find(later)
                .into_iter()
                .for_each(|a| attribute(out, a, false));
        }
        out.close("group");
    }
    out.close("choice");
}

fn attribute(out: &mut Indented, attribute: &Attribute, required: bool) {
    if !required {
        out.open("optional");
    }
    let namespace = if attribute.extension {
        crate::EXTENSIONS
    } else {
        ""
    };
    out.open(&format!(
        "attribute name=\"{}\" ns=\"{namespace}\"",
        attribute.name
    ));
    value(out, attribute.kind);
    out.close("attribute");
    if !required {
        out.close("optional");
    }
}

fn value(out: &mut Indented, kind: Kind) {
    match kind {
        Kind::Text | Kind::Url | Kind::NumberOrText => out.line("<text/>"),
        Kind::Name => out.matching(r"\s*[\p{L}_][\p{L}\p{N}_.]*\s*"),
        Kind::Identifier => out.matching(r"\s*\S(.|\s)*"),
        Kind::Path => out.matching(r"[^/:\\][^:\\]*"),
        Kind::Color => out.matching("#[0-9a-fA-F]{6}"),
        Kind::Time => out.matching(
            r"\s*[+\-]?\s*[0-9.\p{L}_][0-9.\p{L}\p{N}_]*(\s*[+\-]?\s*[0-9.\p{L}_][0-9.\p{L}\p{N}_]*)*\s*",
        ),
        Kind::Seconds { .. } => out.matching(SECONDS),
        Kind::KeyTime => out.matching(&format!(r"({SECONDS})|(\s*\+?[0-9.]+\s*%\s*)")),
        Kind::Numbers => out.matching(&format!(r"\s*({NUMBER}(\s+{NUMBER})*)?\s*")),
        Kind::Number { least, most } => numbers(out, "double", &least.to_string(), &most.to_string()),
        Kind::Integer { least, most } => numbers(out, "integer", &least.to_string(), &most.to_string()),
        Kind::Bool => out.words(&["true", "false", "1", "0"]),
        Kind::Choice(words) => out.words(words),
        Kind::Level { words, percent, .. } => {
            out.open("choice");
            out.words(words);
            let end = if percent.is_some() { "%?" } else { "" };
            out.matching(&format!("{NUMBER}{end}"));
            out.close("choice");
        }
        Kind::NumberOrBool => {
            out.open("choice");
            out.words(&["true", "false"]);
            out.matching(NUMBER);
            out.close("choice");
        }
    }
}

fn numbers(out: &mut Indented, kind: &str, least: &str, most: &str) {
    out.open(&format!("data type=\"{kind}\""));
    out.line(&format!("<param name=\"minInclusive\">{least}</param>"));
    out.line(&format!("<param name=\"maxInclusive\">{most}</param>"));
    out.close("data");
}

fn content(out: &mut Indented, element: &Element) {
    match element.content {
        Content::Empty => {}
        Content::Text => out.line("<text/>"),
        Content::Mixed => {
            out.open("mixed");
            any_of(out, element);
            out.close("mixed");
        }
        Content::Elements => {
            let free = |e: &Element| {
                e.max_per_parent.is_none() && !element.required_children.contains(&e.name)
            };
            if children_of(element).all(free) {
                any_of(out, element);
                return;
            }
            out.open("interleave");
            for child in children_of(element) {
                some_of(out, child, element.required_children.contains(&child.name));
            }
            out.close("interleave");
        }
    }
}

fn any_of(out: &mut Indented, element: &Element) {
    out.open("zeroOrMore");
    out.open("choice");
    for child in children_of(element) {
        out.line(&format!("<ref name=\"{}\"/>", pattern_of(child)));
    }
    out.close("choice");
    out.close("zeroOrMore");
}

/// Writes the allowed number of a child in its parent.
fn some_of(out: &mut Indented, child: &Element, required: bool) {
    let reference = format!("<ref name=\"{}\"/>", pattern_of(child));
    let Some(most) = child.max_per_parent else {
        let pattern = if required { "oneOrMore" } else { "zeroOrMore" };
        out.open(pattern);
        out.line(&reference);
        out.close(pattern);
        return;
    };
    out.open("group");
    for nth in 0..most {
        let optional = nth > 0 || !required;
        if optional {
            out.open("optional");
        }
        out.line(&reference);
        if optional {
            out.close("optional");
        }
    }
    out.close("group");
}

/// XML with one line a tag.
#[derive(Default)]
struct Indented {
    text: String,
    depth: usize,
}

impl Indented {
    fn line(&mut self, text: &str) {
        let _ = writeln!(self.text, "{:width$}{text}", "", width = 2 * self.depth);
    }

    fn open(&mut self, tag: &str) {
        self.line(&format!("<{tag}>"));
        self.depth += 1;
    }

    fn close(&mut self, name: &str) {
        self.depth -= 1;
        self.line(&format!("</{name}>"));
    }

    fn matching(&mut self, pattern: &str) {
        self.open("data type=\"string\"");
        self.line(&format!("<param name=\"pattern\">{pattern}</param>"));
        self.close("data");
    }

    fn words(&mut self, words: &[&str]) {
        self.open("choice");
        for word in words {
            self.line(&format!("<value>{word}</value>"));
        }
        self.close("choice");
    }
}

//! Reference page.

use super::{children_of, display_name};
use crate::schema::{Attribute, Content, ELEMENTS, Element, Kind, Presence};
use std::fmt::Write as _;

/// Introduction of the page, before the elements.
const START: &str = include_str!("introduction.md");

/// The parts of the page: a title, and how the sources of its elements begin.
const PARTS: [(&str, &[&str]); 5] = [
    ("Core and time", &["GEVH D.1", "GEVH D.2"]),
    ("Body", &["GEVH D.3"]),
    ("Speech", &["GEVH D.4", "SABLE"]),
    ("Gesture", &["GEVH D.5"]),
    ("Extensions", &["Extension"]),
];

/// Returns the language reference page as Markdown.
#[must_use]
pub fn markdown() -> String {
    let mut out = START.to_owned();
    out.push_str("\n## Attributes of every clause\n\n");
    table(&mut out, crate::schema::TIMED.iter());
    for (title, sources) in PARTS {
        let _ = writeln!(out, "\n## {title}");
        for element in ELEMENTS {
            if sources.iter().any(|s| element.source.starts_with(s)) {
                section(&mut out, element);
            }
        }
    }
    out.push_str("\n## Diagnostics\n\n| code | description |\n|---|---|\n");
    for (code, doc) in super::CODES {
        let _ = writeln!(out, "| `{code}` | {doc} |");
    }
    out
}

fn section(out: &mut String, element: &Element) {
    let name = display_name(element.extension, element.name);
    let same = ELEMENTS.iter().filter(|e| e.name == element.name).count();
    match element.parents {
        [parent] if same > 1 => {
            let _ = writeln!(out, "\n### {name} in {parent}\n");
        }
        _ => {
            let _ = writeln!(out, "\n### {name}\n");
        }
    }
    let _ = writeln!(out, "{} *{}*\n", element.doc, element.source);
    let children: Vec<String> = children_of(element)
        .map(|e| display_name(e.extension, e.name))
        .collect();
    let parents = match element.parents {
        [] => "root element".to_owned(),
        parents => format!(
            "allowed in {}",
            names(parents.iter().map(|p| (*p).to_owned()))
        ),
    };
    let is_clause = children.len() > 20;
    let holds = match element.content {
        Content::Empty => "empty".to_owned(),
        Content::Text => "contains text".to_owned(),
        Content::Mixed => "contains text and speech markup".to_owned(),
        Content::Elements if is_clause => "contains clauses".to_owned(),
        Content::Elements => format!("contains {}", names(children.into_iter())),
    };
    let _ = write!(out, "{}; {holds}", capital(&parents));
    if !element.required_children.is_empty() {
        let required = element.required_children.iter().map(|c| (*c).to_owned());
        let _ = write!(out, "; requires at least one {}", names(required));
    }
    if let Some(most) = element.max_per_parent {
        let _ = write!(out, "; at most {most} per parent");
    }
    if !element.one_of.is_empty() {
        let some = element.one_of.iter().map(|c| (*c).to_owned());
        let _ = write!(out, "; requires one of {}", names(some));
    }
    out.push_str(".\n");
    if !element.aliases.is_empty() {
        let aliases = element.aliases.iter().map(|a| (*a).to_owned());
        let _ = writeln!(out, "\nAlso written {}.", names(aliases));
    }
    if !element.attributes.is_empty() {
        out.push('\n');
        table(out, element.attributes.iter());
    }
    if !element.decision.is_empty() {
        let _ = writeln!(out, "\n> {}", element.decision);
    }
    let _ = writeln!(out, "\n```xml\n{}\n```", element.example);
}

fn table<'a>(out: &mut String, attributes: impl Iterator<Item = &'a Attribute>) {
    out.push_str("| attribute | value | default | meaning |\n|---|---|---|---|\n");
    for attribute in attributes {
        let default = match attribute.default {
            Presence::Required => "required".to_owned(),
            Presence::Optional => "—".to_owned(),
            Presence::Default(text) => format!("`{text}`"),
        };
        let mut value = kind(attribute.kind);
        if !attribute.unit.is_empty()
            && !matches!(attribute.kind, Kind::Seconds { .. } | Kind::Time)
        {
            let _ = write!(value, ", {}", attribute.unit);
        }
        let aliases: String = attribute
            .aliases
            .iter()
            .map(|a| format!(" (also `{a}`)"))
            .collect();
        let words: String = attribute
            .word_aliases
            .iter()
            .map(|(alias, word)| format!(" `{alias}` is read as `{word}`."))
            .collect();
        let beside: String = attribute
            .conditional_kinds
            .iter()
            .map(|b| format!(" With {}='{}': {}.", b.attribute, b.word, kind(b.kind)))
            .collect();
        let _ = writeln!(
            out,
            "| `{}`{aliases} | {value} | {default} | {}{beside}{words} |",
            display_name(attribute.extension, attribute.name),
            attribute.doc
        );
    }
}

fn kind(kind: Kind) -> String {
    let all = |words: &[&str]| -> String {
        let words: Vec<String> = words.iter().map(|w| format!("`{w}`")).collect();
        words.join(", ")
    };
    match kind {
        Kind::Text => "text".to_owned(),
        Kind::Name => "name of a time".to_owned(),
        Kind::Identifier => "name".to_owned(),
        Kind::Path => "relative path".to_owned(),
        Kind::Url => "address".to_owned(),
        Kind::Bool => "`true`, `false`, `1`, `0`".to_owned(),
        Kind::Number { least, most } => range("number", least, most),
        Kind::Integer { least, most } => range("whole number", least as f64, most as f64),
        Kind::Seconds { most } => range("seconds", -crate::schema::MAX_NUMBER, most),
        Kind::Time => "time expression".to_owned(),
        Kind::KeyTime => "seconds or percent".to_owned(),
        Kind::Choice(words) => all(words),
        Kind::Level {
            words,
            numbers: [least, most],
            percent,
        } => {
            let number = range("number", least, most);
            match percent {
                Some([least, most]) => format!(
                    "{}, signed percent, {least} to {most}, or {number}",
                    all(words)
                ),
                None => format!("{}, or {number}", all(words)),
            }
        }
        Kind::NumberOrBool => "number, `true`, `false`".to_owned(),
        Kind::NumberOrText => "number or text".to_owned(),
        Kind::Numbers => "numbers".to_owned(),
        Kind::Color => "`#rrggbb`".to_owned(),
    }
}

fn range(what: &str, least: f64, most: f64) -> String {
    let bound = crate::schema::MAX_NUMBER;
    match (least > -bound, most < bound) {
        (true, true) => format!("{what}, {least} to {most}"),
        (true, false) => format!("{what}, at least {least}"),
        (false, true) => format!("{what}, at most {most}"),
        (false, false) => what.to_owned(),
    }
}

fn names(names: impl Iterator<Item = String>) -> String {
    let mut all: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    all.dedup();
    all.join(", ")
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    let first = chars.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(chars).collect()
}

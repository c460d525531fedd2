//! The language as JSON, for the completion and hover of editors.

use super::display_name;
use crate::schema::{Attribute, Content, ELEMENTS, Element, Kind, Presence};

/// Returns the language as JSON for editors: `{"namespace", "prefix", "elements": [...],
/// "diagnostics": [...]}`.
#[must_use]
pub fn json() -> String {
    let elements: Vec<String> = ELEMENTS.iter().map(|e| element(e)).collect();
    let codes: Vec<String> = super::CODES
        .iter()
        .map(|(code, doc)| {
            format!(
                "    {{\"code\": {}, \"doc\": {}}}",
                string(code),
                string(doc)
            )
        })
        .collect();
    format!(
        "{{\n  \"namespace\": {},\n  \"prefix\": {},\n  \"elements\": [\n{}\n  ],\n  \
         \"diagnostics\": [\n{}\n  ]\n}}\n",
        string(crate::EXTENSIONS),
        string(crate::EXTENSIONS_PREFIX),
        elements.join(",\n"),
        codes.join(",\n")
    )
}

fn element(element: &Element) -> String {
    let content = match element.content {
        Content::Empty => "empty",
        Content::Elements => "elements",
        Content::Text => "text",
        Content::Mixed => "mixed",
    };
    let children = super::children_of(element).map(|e| display_name(e.extension, e.name));
    let mut children: Vec<String> = children.collect();
    children.dedup();
    let mut fields = vec![
        field(
            "name",
            &string(&display_name(element.extension, element.name)),
        ),
        field("doc", &string(element.doc)),
        field("source", &string(element.source)),
    ];
    if !element.decision.is_empty() {
        fields.push(field("decision", &string(element.decision)));
    }
    if !element.aliases.is_empty() {
        fields.push(field("aliases", &strings(element.aliases)));
    }
    fields.push(field(
        "clause",
        if element.is_clause() { "true" } else { "false" },
    ));
    fields.push(field("content", &string(content)));
    fields.push(field("parents", &strings(element.parents)));
    let children: Vec<&str> = children.iter().map(String::as_str).collect();
    fields.push(field("children", &strings(&children)));
    if !element.required_children.is_empty() {
        fields.push(field(
            "requiredChildren",
            &strings(element.required_children),
        ));
    }
    if !element.one_of.is_empty() {
        fields.push(field("oneOf", &strings(element.one_of)));
    }
    if let Some(most) = element.max_per_parent {
        fields.push(field("mostPerParent", &most.to_string()));
    }
    fields.push(field("example", &string(element.example)));
    let attributes: Vec<String> = element
        .all_attributes()
        .map(|a| format!("        {}", attribute(a)))
        .collect();
    let list = if attributes.is_empty() {
        "[]".to_owned()
    } else {
        format!("[\n{}\n      ]", attributes.join(",\n"))
    };
    fields.push(field("attributes", &list));
    format!("    {{\n      {}\n    }}", fields.join(",\n      "))
}

fn attribute(attribute: &Attribute) -> String {
    let kind = match attribute.kind {
        Kind::Text => "text",
        Kind::Name => "name",
        Kind::Identifier => "identifier",
        Kind::Path => "path",
        Kind::Url => "url",
        Kind::Bool => "boolean",
        Kind::Number { .. } => "number",
        Kind::Integer { .. } => "integer",
        Kind::Seconds { .. } => "seconds",
        Kind::Time => "time",
        Kind::KeyTime => "keyTime",
        Kind::Choice(_) => "choice",
        Kind::Level { .. } => "level",
        Kind::NumberOrBool => "numberOrBoolean",
        Kind::NumberOrText => "numberOrText",
        Kind::Numbers => "numbers",
        Kind::Color => "color",
    };
    let mut fields = vec![
        field(
            "name",
            &string(&display_name(attribute.extension, attribute.name)),
        ),
        field("doc", &string(attribute.doc)),
        field("kind", &string(kind)),
    ];
    match attribute.kind {
        Kind::Choice(words) => fields.push(field("words", &strings(words))),
        Kind::Level {
            words,
            numbers: [least, most],
            percent,
        } => {
            fields.push(field("words", &strings(words)));
            fields.push(field("least", &least.to_string()));
            fields.push(field("most", &most.to_string()));
            if let Some([least, most]) = percent {
                fields.push(field("leastPercent", &least.to_string()));
                fields.push(field("mostPercent", &most.to_string()));
            }
        }
        Kind::Seconds { most } if most < crate::schema::MAX_NUMBER => {
            fields.push(field("most", &most.to_string()));
        }
        Kind::Bool => fields.push(field("words", &strings(&["true", "false"]))),
        Kind::Number { least, most } => {
            fields.push(field("least", &least.to_string()));
            fields.push(field("most", &most.to_string()));
        }
        // JSON's numbers are exact up to 2 to the power of 53.
        Kind::Integer { least, most } => {
            fields.push(field("least", &least.to_string()));
            if most < 1 << 53 {
                fields.push(field("most", &most.to_string()));
            }
        }
        _ => {}
    }
    match attribute.default {
        Presence::Required => fields.push(field("required", "true")),
        Presence::Optional => {}
        Presence::Default(text) => fields.push(field("default", &string(text))),
    }
    if !attribute.unit.is_empty() {
        fields.push(field("unit", &string(attribute.unit)));
    }
    if !attribute.aliases.is_empty() {
        fields.push(field("aliases", &strings(attribute.aliases)));
    }
    format!("{{{}}}", fields.join(", "))
}

fn field(name: &str, value: &str) -> String {
    format!("\"{name}\": {value}")
}

fn strings(texts: &[&str]) -> String {
    let texts: Vec<String> = texts.iter().map(|text| string(text)).collect();
    format!("[{}]", texts.join(", "))
}

/// Returns a JSON string literal. The table has no control characters.
fn string(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

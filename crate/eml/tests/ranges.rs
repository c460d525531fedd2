//! Attribute limits: a value beyond the limits of the table is reported exactly once, in any
//! element. The texts are the elements' own examples.

use raconteur_eml::parse;
use raconteur_eml::reference::whole_example;
use raconteur_eml::schema::{Attribute, ELEMENTS, Element, Kind};

/// Returns values that an attribute of a kind rejects.
fn beyond(kind: Kind) -> Vec<String> {
    let all = |values: &[&str]| values.iter().map(|v| (*v).to_owned()).collect();
    match kind {
        Kind::Number { least, most } => {
            let step = (most - least) / 8.0;
            vec![(least - step).to_string(), (most + step).to_string()]
        }
        Kind::Integer { least, most } => {
            let mut values = vec![(least as f64 - 1.0).to_string()];
            // Numbers of hand shapes have words of their own for it.
            if most < i64::MAX {
                values.push((most as f64 + 1.0).to_string());
            }
            values
        }
        Kind::KeyTime => all(&["-1", "1e9"]),
        Kind::Seconds { most } => vec!["-1".to_owned(), (most * 1.1).to_string()],
        Kind::Level {
            numbers, percent, ..
        } => {
            let outside = |[least, most]: [f64; 2]| [least - 0.5, most + 0.5];
            let changes = percent.into_iter().flat_map(outside);
            let changes = changes.map(|change| format!("{change:+}%"));
            let numbers = outside(numbers).map(|number| number.to_string());
            changes.chain(numbers).collect()
        }
        Kind::Bool => all(&["2", "-1"]),
        Kind::Choice(_) => all(&["none-of-these-words"]),
        Kind::Color => all(&["#fffff", "#ggffff"]),
        Kind::Path => all(&["../x", "/x"]),
        Kind::Url => all(&["file:///x"]),
        // Elements with references to them, and attributes that are read together with others.
        Kind::Name | Kind::Identifier | Kind::Text | Kind::Time => Vec::new(),
        Kind::NumberOrBool | Kind::NumberOrText | Kind::Numbers => Vec::new(),
    }
}

/// Returns the offset of an element's start tag in its example, and its name there.
fn tag_of(element: &Element, text: &str) -> (usize, String) {
    let prefix = if element.extension { "r:" } else { "" };
    let name = format!("<{prefix}{}", element.name);
    let parents = element.parents.iter();
    // One of several with a name is found in its own parent.
    let within = parents.filter_map(|p| text.find(&format!("<{p}"))).min();
    let from = if element.name == "key" {
        within.unwrap_or(0)
    } else {
        0
    };
    let mut places = text[from..].match_indices(&name).map(|(i, _)| i + from);
    let ends =
        |i: &usize| !text[i + name.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '-');
    (
        places.find(ends).expect("an example uses its element"),
        name,
    )
}

/// The example of an element with an attribute set to a value.
fn with(element: &Element, attribute: &Attribute, value: &str) -> String {
    let mut text = whole_example(element.example);
    let needs_prefix = attribute.extension && !element.extension;
    let prefix = if needs_prefix { "r:" } else { "" };
    let name = format!(" {prefix}{}='", attribute.name);
    let (start, tag) = tag_of(element, &text);
    let end = start + text[start..].find('>').expect("a tag ends");
    match text[start..end].find(&name) {
        Some(place) => {
            let from = start + place + name.len();
            let to = from + text[from..].find('\'').expect("a value ends");
            text.replace_range(from..to, value);
        }
        None => text.insert_str(start + tag.len(), &format!("{name}{value}'")),
    }
    if needs_prefix && !text.contains("xmlns:r=") {
        text = text.replacen("<eml", "<eml xmlns:r='urn:raconteur:eml:1'", 1);
    }
    text
}

/// Diagnostics of references to an element that was dropped.
const CONSEQUENCES: [&str; 2] = ["eml::unknown-set", "eml::unknown-name"];

fn one_problem(text: &str) {
    let mut found = parse(text).diagnostics;
    found.retain(|d| !CONSEQUENCES.contains(&d.code));
    assert_eq!(found.len(), 1, "{text}\n{found:#?}");
    if found[0].code == "eml::out-of-range" {
        let tells = found[0]
            .hints
            .iter()
            .any(|h| h.contains("the nearest value is"));
        assert!(tells, "{found:#?}");
    }
}

#[test]
fn a_value_beyond_its_range_is_told_once() {
    let mut checked = 0;
    for element in ELEMENTS {
        for attribute in element.all_attributes() {
            for value in beyond(attribute.kind) {
                one_problem(&with(element, attribute, &value));
                checked += 1;
            }
            for beside in attribute.conditional_kinds {
                let text = whole_example(element.example);
                assert!(text.contains(beside.attribute), "{text}");
                for value in beyond(beside.kind) {
                    let text = with(element, attribute, &value);
                    let (place, _) = tag_of(element, &text);
                    let other = format!(" {}='", beside.attribute);
                    let from =
                        place + text[place..].find(&other).expect("it is there") + other.len();
                    let to = from + text[from..].find('\'').expect("a value ends");
                    one_problem(&[&text[..from], beside.word, &text[to..]].concat());
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 150, "{checked}");
}

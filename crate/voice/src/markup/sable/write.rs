//! Writer of SABLE 1.0.

use super::{AGES, GENDERS, MODES, ORDERS, word_of};
use crate::content::{Content, Division, Markup, Segment, Setting};
use crate::markup::levels::{EMPHASES, Property, boundary_sign};
use crate::markup::write::{Element, MarkupWriter, body, declaration, emotion, gain, loudness};
use crate::text::SayAs;

/// Writes a document of SABLE 1.0. [`super::read()`] restores content whose words have the same
/// styles. Features that SABLE lacks (emotions, changes that percentages cannot express exactly)
/// use [`crate::markup::NAMESPACE`]. Characters that XML cannot contain become U+FFFD; empty
/// attribute texts count as none.
#[must_use]
pub fn write(content: &Content) -> String {
    let body = body(content, &mut Sable);
    let declaration = declaration(&body);
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<SABLE{declaration}>{body}</SABLE>\n")
}

struct Sable;

/// Adds the attribute of a property's setting to an element.
fn set(
    element: Element,
    property: Property,
    names: (&'static str, &'static str),
    setting: Option<Setting>,
) -> Element {
    match setting {
        // A setting without effect needs no element.
        Some(setting) if property.write(setting).is_some() => {
            element.with_setting(names, setting, property.write(setting), |text| {
                property.read(text).map(|s| vec![s])
            })
        }
        _ => element,
    }
}

impl MarkupWriter for Sable {
    fn markup(&mut self, markup: &Markup) -> Option<Element> {
        Some(match markup {
            Markup::Emphasis(level) if level.is_finite() => {
                let level = level.clamp(0.0, 2.0);
                let word = word_of(&EMPHASES, &level);
                Element::new("EMPH").with("LEVEL", word.map_or(level.to_string(), str::to_owned))
            }
            Markup::Pitch {
                base,
                middle,
                range,
            } => {
                let element = Element::new("PITCH");
                let element = set(element, Property::Height, ("BASE", "r:base"), *base);
                let element = set(element, Property::Height, ("MIDDLE", "r:middle"), *middle);
                set(element, Property::Range, ("RANGE", "r:range"), *range)
            }
            Markup::Rate(rate) => {
                let element = Element::new("RATE");
                set(element, Property::Speed, ("SPEED", "r:speed"), Some(*rate))
            }
            Markup::Volume(volume) => {
                let element = Element::new("VOLUME");
                let names = ("LEVEL", "r:level");
                let volume = loudness(*volume);
                set(element, Property::Loudness, names, Some(volume))
            }
            Markup::Pronunciation { ipa, sub, origin } => Element::new("PRON")
                .with_some("IPA", ipa.as_deref())
                .with_some("SUB", sub.as_deref())
                .with_some("ORIGIN", origin.as_deref()),
            Markup::SayAs(kind) => say_as(kind),
            Markup::Language(language) => Element::new("LANGUAGE").with_some("ID", Some(language)),
            Markup::Speaker(speaker) => Element::new("SPEAKER")
                .with_some("GENDER", speaker.gender.and_then(|g| word_of(&GENDERS, &g)))
                .with_some("AGE", speaker.age.and_then(|a| word_of(&AGES, &a)))
                .with_some("NAME", speaker.name.as_deref()),
            Markup::Engine { id, data } => Element::new("ENGINE")
                .with("ID", id.as_str())
                .with("DATA", data.as_str()),
            feeling @ Markup::Emotion { .. } => emotion(feeling)?,
            Markup::Emphasis(_) | Markup::Other => return None,
        })
    }

    fn point(&mut self, segment: &Segment) -> Option<Element> {
        Some(match segment {
            Segment::Break { msec, boundary } => Element::new("BREAK")
                .with("MSEC", msec.to_string())
                .with_some("TYPE", boundary.map(boundary_sign)),
            Segment::Audio {
                src,
                background,
                level,
            } => Element::new("AUDIO")
                .with("SRC", src.as_str())
                .with_some("MODE", background.then_some("background"))
                .with("LEVEL", gain(*level).to_string()),
            Segment::Mark(name) => Element::new("MARKER").with("MARK", name.as_str()),
            Segment::Text(_) | Segment::Division(_) | Segment::Open(_) | Segment::Close => {
                return None;
            }
        })
    }

    fn end(&mut self) {}

    fn division(&self, division: Division) -> Element {
        Element::new("DIV").with(
            "TYPE",
            match division {
                Division::Sentence => "sentence",
                Division::Paragraph => "paragraph",
            },
        )
    }
}

fn say_as(kind: &SayAs) -> Element {
    let (mode, kind) = match kind {
        SayAs::Date(Some(order)) => (&SayAs::Date(None), word_of(&ORDERS, order)),
        SayAs::Net { email: true } => (&SayAs::Net { email: false }, Some("email")),
        kind => (kind, None),
    };
    let mode = word_of(&MODES, mode).unwrap_or_default();
    let element = Element::new("SAYAS").with("MODE", mode);
    match kind {
        Some(kind) => element.with("MODETYPE", kind.to_ascii_uppercase()),
        None => element,
    }
}

//! Reader of SABLE.

use super::{AGES, GENDERS, MODES, ORDERS, of_word};
use crate::content::{Content, Division, Markup, Segment, Setting, Speaker};
use crate::markup::Problem;
use crate::markup::build::{self, Meaning, emotion, exact, filled, needs, pause_msec, word};
use crate::markup::levels::{self, MODERATE_EMPHASIS, Property};
use crate::markup::xml::{Pieces, Space, Tag};
use crate::text::SayAs;

/// Reads a document of SABLE 0.2 or 1.0, or a part of one without its root. Names and words may
/// have any case; a document type may be named. Unknown elements and attributes, and unreadable
/// values, are reported and otherwise ignored; their content is kept.
///
/// # Errors
///
/// Returns an error if the text is not well-formed XML, declares entities, or exceeds the limits of
/// [`crate::markup`] on length, depth or amount of markup.
pub fn read(text: &str) -> Result<(Content, Vec<Problem>), Problem> {
    let mut is_first = true;
    build::read(text, true, |tag, pieces| {
        let mut meaning = match tag.space {
            Space::Own => element(tag, pieces, is_first),
            Space::Ours if tag.name.eq_ignore_ascii_case("emotion") => emotion(tag, pieces).into(),
            Space::Ours | Space::Other => unknown(tag, pieces),
        };
        is_first = false;
        if let Some(mark) = filled(tag.get("MARK")) {
            meaning.points.insert(0, Segment::Mark(mark));
        }
        meaning
    })
}

fn unknown(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    pieces.report(
        tag.at,
        format!("unknown element {}; its text is kept", tag.name),
    );
    Meaning::default()
}

/// Returns the attributes of an element of SABLE 0.2 except `MARK`, by its upper-case name; `None`
/// for an unknown one.
fn attributes_of(upper: &str) -> Option<&'static [&'static str]> {
    Some(match upper {
        // An experiment in the DTD only.
        "BC" | "SABLE" | "MARKER" => &[],
        "EMPH" | "VOLUME" => &["LEVEL"],
        "BREAK" => &["LEVEL", "MSEC", "TYPE"],
        "PITCH" => &["BASE", "MIDDLE", "MED", "RANGE"],
        "RATE" => &["SPEED"],
        "AUDIO" => &["SRC", "MODE", "LEVEL"],
        "ENGINE" => &["ID", "DATA"],
        "PRON" => &["IPA", "SUB", "ORIGIN"],
        "SAYAS" => &["MODE", "MODETYPE"],
        "LANGUAGE" => &["ID", "CODE"],
        "SPEAKER" => &["GENDER", "AGE", "NAME"],
        "DIV" => &["TYPE"],
        _ => return None,
    })
}

fn element(tag: &Tag, pieces: &mut Pieces<'_>, is_first: bool) -> Meaning {
    let upper = tag.name.to_ascii_uppercase();
    let Some(known) = attributes_of(&upper) else {
        return unknown(tag, pieces);
    };
    if upper == "BC" {
        return Meaning::default();
    }
    for attribute in &tag.attributes {
        let name = attribute.name.as_str();
        let is_known =
            name.eq_ignore_ascii_case("MARK") || known.iter().any(|k| k.eq_ignore_ascii_case(name));
        if attribute.space == Space::Own && !is_known {
            pieces.report(tag.at, format!("{upper} has no attribute {name}"));
        }
    }
    match upper.as_str() {
        "SABLE" if !is_first => {
            pieces.report(tag.at, "SABLE inside a document has no effect");
            Meaning::default()
        }
        "EMPH" => emphasis(tag, pieces).into(),
        "BREAK" => pause(tag, pieces).into(),
        "PITCH" => pitch(tag, pieces),
        "RATE" => {
            let speed = setting(tag, pieces, Property::Speed, "SPEED", "speed");
            all(speed, Markup::Rate)
        }
        "VOLUME" => {
            let level = setting(tag, pieces, Property::Loudness, "LEVEL", "level");
            all(level, Markup::Volume)
        }
        "AUDIO" => audio(tag, pieces),
        "ENGINE" => engine(tag, pieces),
        "MARKER" => {
            if filled(tag.get("MARK")).is_none() {
                pieces.report(tag.at, "MARKER needs a MARK");
            }
            Meaning::default()
        }
        "PRON" => pronunciation(tag, pieces).into(),
        "SAYAS" => say_as(tag, pieces),
        "LANGUAGE" => match filled(tag.get("ID")) {
            Some(language) => Markup::Language(language).into(),
            None => needs(tag, pieces, "an ID"),
        },
        "SPEAKER" => Markup::Speaker(Speaker {
            gender: word(tag, pieces, "GENDER", |w| of_word(&GENDERS, w)),
            age: word(tag, pieces, "AGE", |w| of_word(&AGES, w)),
            name: filled(tag.get("NAME")),
        })
        .into(),
        "DIV" => division(tag, pieces),
        _ => Meaning::default(),
    }
}

fn pronunciation(tag: &Tag, pieces: &mut Pieces<'_>) -> Markup {
    let attribute = |name| filled(tag.get(name));
    let (ipa, sub, origin) = (attribute("IPA"), attribute("SUB"), attribute("ORIGIN"));
    if ipa.is_none() && sub.is_none() && origin.is_none() {
        pieces.report(tag.at, "PRON needs IPA or SUB");
    }
    Markup::Pronunciation { ipa, sub, origin }
}

fn division(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    let divisions = [
        ("sentence", Division::Sentence),
        ("paragraph", Division::Paragraph),
    ];
    Meaning {
        division: word(tag, pieces, "TYPE", |w| of_word(&divisions, w))
            .or(Some(Division::Sentence)),
        ..Meaning::default()
    }
}

fn all(settings: Vec<Setting>, markup: fn(Setting) -> Markup) -> Meaning {
    Meaning {
        markups: settings.into_iter().map(markup).collect(),
        ..Meaning::default()
    }
}

/// Returns the settings of a property from an attribute; the exact attribute of Raconteur's
/// namespace has priority.
fn setting(
    tag: &Tag,
    pieces: &mut Pieces<'_>,
    property: Property,
    name: &str,
    ours: &str,
) -> Vec<Setting> {
    if let Some(exact) = tag.own_attribute(ours).and_then(exact) {
        return exact;
    }
    let read = word(tag, pieces, name, |text| property.read(text));
    read.into_iter().collect()
}

fn emphasis(tag: &Tag, pieces: &mut Pieces<'_>) -> Markup {
    let level = word(tag, pieces, "LEVEL", levels::emphasis);
    Markup::Emphasis(level.unwrap_or(MODERATE_EMPHASIS))
}

fn pause(tag: &Tag, pieces: &mut Pieces<'_>) -> Segment {
    let of_level = word(tag, pieces, "LEVEL", levels::pause);
    let msec = word(tag, pieces, "MSEC", |text| {
        levels::number(text.trim()).filter(|msec| *msec >= 0.0)
    });
    let [.., (_, medium), _] = levels::PAUSES;
    let (msec, is_cut) = pause_msec(msec.or(of_level).unwrap_or(medium));
    if is_cut {
        pieces.report(tag.at, format!("a pause is cut to {msec} ms"));
    }
    Segment::Break {
        msec,
        boundary: word(tag, pieces, "TYPE", levels::boundary),
    }
}

fn pitch(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    let base = setting(tag, pieces, Property::Height, "BASE", "base");
    // The DTD specifies MIDDLE, and Festival reads MED.
    let named = if tag.get("MIDDLE").is_some() {
        "MIDDLE"
    } else {
        "MED"
    };
    let middle = setting(tag, pieces, Property::Height, named, "middle");
    let range = setting(tag, pieces, Property::Range, "RANGE", "range");
    Meaning {
        markups: build::pitch(&base, &middle, &range),
        ..Meaning::default()
    }
}

fn audio(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    let Some(src) = filled(tag.get("SRC")) else {
        return needs(tag, pieces, "a SRC");
    };
    let modes = [("background", true), ("insertion", false)];
    let level = word(tag, pieces, "LEVEL", |text| {
        levels::number(text.trim()).filter(|level| *level >= 0.0)
    });
    Segment::Audio {
        src,
        background: word(tag, pieces, "MODE", |w| of_word(&modes, w)).unwrap_or(false),
        level: level.unwrap_or(1.0),
    }
    .into()
}

fn engine(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    match (filled(tag.get("ID")), tag.get("DATA")) {
        (Some(id), Some(data)) => Markup::Engine {
            id,
            data: data.to_owned(),
        }
        .into(),
        _ => needs(tag, pieces, "an ID and DATA"),
    }
}

fn say_as(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    if tag.get("MODE").is_none() {
        return needs(tag, pieces, "a MODE");
    }
    let Some(mode) = word(tag, pieces, "MODE", |w| of_word(&MODES, w)) else {
        return Meaning::default();
    };
    let kind = tag
        .get("MODETYPE")
        .map(|kind| kind.trim().to_ascii_lowercase());
    let known = match (&mode, kind.as_deref()) {
        (_, None) => Some(mode),
        (SayAs::Date(_), Some(order)) => of_word(&ORDERS, order).map(|o| SayAs::Date(Some(o))),
        (SayAs::Time, Some("hm" | "hms")) => Some(SayAs::Time),
        (SayAs::Net { .. }, Some("email")) => Some(SayAs::Net { email: true }),
        (SayAs::Net { .. }, Some("url")) => Some(SayAs::Net { email: false }),
        _ => None,
    };
    if known.is_none() {
        let kind = kind.unwrap_or_default();
        pieces.report(
            tag.at,
            format!("MODETYPE=\"{kind}\" does not go with its MODE"),
        );
    }
    Markup::SayAs(known.unwrap_or(mode)).into()
}

//! Reader of SSML.

use super::prosody::{self, Settings, decibels};
use super::{AGES, GENDERS, KINDS, sampa};
use crate::content::{Content, Division, Markup, Segment, Setting, Speaker};
use crate::markup::Problem;
use crate::markup::build::{self, Meaning, emotion, exact, filled, needs, pause_msec, word};
use crate::markup::levels::{self, MODERATE_EMPHASIS};
use crate::markup::sable::{ORDERS, of_word};
use crate::markup::xml::{Pieces, Space, Tag};
use crate::text::SayAs;

/// SSML pause strengths as SABLE levels: weak is small, medium medium, and x-strong large; the
/// others lie between.
const STRENGTHS: [(&str, f64); 6] = [
    ("none", 0.0),
    ("x-weak", 0.5),
    ("weak", 1.0),
    ("medium", 2.0),
    ("strong", 2.5),
    ("x-strong", 3.0),
];

/// SSML's words for emphasis.
const EMPHASES: [&str; 4] = ["strong", "moderate", "none", "reduced"];

/// Reads a document of SSML 1.1, or a part of one without its root. A document type may be named.
/// Unknown features, and those that a [`Content`] cannot express, are reported and otherwise
/// ignored; their text is kept. Recordings are assumed to exist: their alternative text is omitted.
///
/// # Errors
///
/// Returns an error if the text is not well-formed XML, declares entities, or exceeds the limits of
/// [`crate::markup`] on length, depth or amount of markup.
pub fn read(text: &str) -> Result<(Content, Vec<Problem>), Problem> {
    read_beside(text, &|_| true)
}

/// Reads a document like [`read`]; `is_there` returns true if a recording exists at an address or
/// path. Otherwise its alternative text is spoken (SSML 1.1, section 3.3.1), with a report.
///
/// # Errors
///
/// Returns the same errors as [`read`].
pub fn read_beside(
    text: &str,
    is_there: &dyn Fn(&str) -> bool,
) -> Result<(Content, Vec<Problem>), Problem> {
    build::read(text, false, |tag, pieces| match tag.space {
        Space::Own if tag.name == "audio" => audio(tag, pieces, is_there),
        Space::Own => element(tag, pieces),
        Space::Ours => own_element(tag, pieces),
        Space::Other => unknown(tag, pieces),
    })
}

fn unknown(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    pieces.report(
        tag.at,
        format!("unknown element {}; its text is kept", tag.name),
    );
    Meaning::default()
}

fn own_element(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    match tag.name.as_str() {
        "emotion" => emotion(tag, pieces).into(),
        "engine" => match (filled(tag.get("id")), tag.get("data")) {
            (Some(id), Some(data)) => Markup::Engine {
                id,
                data: data.to_owned(),
            }
            .into(),
            _ => {
                pieces.report(tag.at, "engine needs an id and data");
                Meaning::default()
            }
        },
        "pronunciation" => Markup::Pronunciation {
            ipa: filled(tag.get("ipa")),
            sub: filled(tag.get("sub")),
            origin: filled(tag.get("origin")),
        }
        .into(),
        _ => unknown(tag, pieces),
    }
}

fn element(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    let mut meaning = match tag.name.as_str() {
        "speak" | "lang" => Meaning::default(),
        "token" | "w" => Meaning {
            is_token: true,
            ..Meaning::default()
        },
        "p" | "s" => Meaning {
            division: Some(if tag.name == "p" {
                Division::Paragraph
            } else {
                Division::Sentence
            }),
            ..Meaning::default()
        },
        "voice" => voice(tag, pieces).into(),
        "prosody" => prosody(tag, pieces),
        "emphasis" => emphasis(tag, pieces).into(),
        "break" => pause(tag, pieces).into(),
        "say-as" => say_as(tag, pieces),
        "phoneme" => phoneme(tag, pieces),
        "sub" => match filled(tag.get("alias")) {
            Some(alias) => Markup::Pronunciation {
                ipa: None,
                sub: Some(alias),
                origin: None,
            }
            .into(),
            None => needs(tag, pieces, "an alias"),
        },
        "mark" => match filled(tag.get("name")) {
            Some(name) => Segment::Mark(name).into(),
            None => needs(tag, pieces, "a name"),
        },
        "desc" => {
            return Meaning {
                silent: true,
                ..Meaning::default()
            };
        }
        "meta" | "metadata" | "lexicon" => {
            pieces.report(tag.at, format!("{} is ignored", tag.name));
            return Meaning {
                silent: true,
                ..Meaning::default()
            };
        }
        "lookup" => {
            pieces.report(tag.at, "lookup is ignored; its text is kept");
            Meaning::default()
        }
        _ => return unknown(tag, pieces),
    };
    // The attribute in this project's namespace can specify a language that is not a tag, and a
    // root's language that is not the content's.
    let language = tag.own_attribute("language").or(tag.get("xml:lang"));
    match filled(language) {
        Some(language) => meaning.markups.insert(0, Markup::Language(language)),
        None if tag.name == "lang" && language.is_none() => {
            return needs(tag, pieces, "xml:lang");
        }
        None => {}
    }
    meaning
}

/// Returns the settings of an SSML attribute; the exact attribute of Raconteur's namespace has
/// priority.
fn settings(
    tag: &Tag,
    pieces: &mut Pieces<'_>,
    (name, ours): (&str, &str),
    read: fn(&str) -> Option<Settings>,
) -> Vec<Setting> {
    if let Some(exact) = tag.own_attribute(ours).and_then(exact) {
        return exact;
    }
    let Some((settings, note)) = word(tag, pieces, name, read) else {
        return Vec::new();
    };
    if let Some(note) = note {
        pieces.report(tag.at, note);
    }
    settings
}

fn prosody(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    for name in ["contour", "duration"] {
        if tag.get(name).is_some() {
            pieces.report(tag.at, format!("{name} is ignored"));
        }
    }
    let base = tag
        .own_attribute("base")
        .and_then(exact)
        .unwrap_or_default();
    let middle = settings(tag, pieces, ("pitch", "middle"), prosody::height);
    let range = settings(tag, pieces, ("range", "range"), prosody::height);
    let rate = settings(tag, pieces, ("rate", "rate"), prosody::rate);
    let volume = settings(tag, pieces, ("volume", "volume"), prosody::loudness);
    let mut markups = build::pitch(&base, &middle, &range);
    markups.extend(rate.into_iter().map(Markup::Rate));
    markups.extend(volume.into_iter().map(Markup::Volume));
    Meaning {
        markups,
        ..Meaning::default()
    }
}

fn emphasis(tag: &Tag, pieces: &mut Pieces<'_>) -> Markup {
    if let Some(level) = tag.own_attribute("level").and_then(levels::emphasis) {
        return Markup::Emphasis(level);
    }
    let level = word(tag, pieces, "level", |text| {
        let known = EMPHASES.contains(&text.trim());
        levels::emphasis(text).filter(|_| known)
    });
    Markup::Emphasis(level.unwrap_or(MODERATE_EMPHASIS))
}

fn pause(tag: &Tag, pieces: &mut Pieces<'_>) -> Segment {
    let strength = word(tag, pieces, "strength", |w| of_word(&STRENGTHS, w));
    let time = word(tag, pieces, "time", msec);
    let medium = levels::pause_of_level(2.0);
    let of_strength = strength.map_or(medium, levels::pause_of_level);
    let (msec, is_cut) = pause_msec(time.unwrap_or(of_strength));
    if is_cut {
        pieces.report(tag.at, format!("a pause is cut to {msec} ms"));
    }
    Segment::Break {
        msec,
        boundary: tag.own_attribute("type").and_then(levels::boundary),
    }
}

/// Parses a duration in seconds or milliseconds and returns milliseconds.
fn msec(text: &str) -> Option<f64> {
    let text = text.trim();
    let (digits, exponent) = match text.strip_suffix("ms") {
        Some(digits) => (digits, 0),
        None => (text.strip_suffix('s')?, 3),
    };
    levels::shifted(digits.trim_end(), exponent).filter(|msec| *msec >= 0.0)
}

fn voice(tag: &Tag, pieces: &mut Pieces<'_>) -> Markup {
    for name in ["languages", "variant", "required", "ordering"] {
        if tag.get(name).is_some() {
            pieces.report(tag.at, format!("{name} of a voice is ignored"));
        }
    }
    let gender = |text: &str| {
        if text.trim().is_empty() {
            Some(None)
        } else {
            of_word(&GENDERS, text)
        }
    };
    let age = word(tag, pieces, "age", |text| {
        let years = levels::number(text.trim()).filter(|years| *years >= 0.0)?;
        AGES.iter().find(|(_, _, below)| years < *below)
    });
    // A list of names, the best first.
    let mut names = tag.get("name").unwrap_or_default().split_ascii_whitespace();
    let first = names.next().map(str::to_owned);
    let name = filled(tag.own_attribute("name")).or(first);
    if tag.own_attribute("name").is_none() && names.next().is_some() {
        pieces.report(tag.at, "only the first name of a voice counts");
    }
    Markup::Speaker(Speaker {
        gender: word(tag, pieces, "gender", gender).flatten(),
        age: age.map(|(age, _, _)| *age),
        name,
    })
}

fn say_as(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    let Some(text) = tag.get("interpret-as") else {
        return needs(tag, pieces, "interpret-as");
    };
    let Some(kind) = of_word(&KINDS, text) else {
        pieces.report(tag.at, format!("interpret-as=\"{text}\" is not known"));
        return Meaning::default();
    };
    if tag.get("detail").is_some() {
        pieces.report(tag.at, "detail is ignored");
    }
    let format = tag.get("format").map(str::to_ascii_lowercase);
    let formatted = match (&kind, format.as_deref()) {
        (_, None) => Some(kind),
        (SayAs::Date(_), Some(order)) => of_word(&ORDERS, order).map(|o| SayAs::Date(Some(o))),
        (SayAs::Time, Some("hms12" | "hms24" | "hm" | "hms")) => Some(SayAs::Time),
        (SayAs::Net { .. }, Some("email")) => Some(SayAs::Net { email: true }),
        (SayAs::Net { .. }, Some("uri" | "url")) => Some(SayAs::Net { email: false }),
        (SayAs::Literal, Some("characters" | "glyphs")) => Some(SayAs::Literal),
        (SayAs::Cardinal, Some("ordinal")) => Some(SayAs::Ordinal),
        (SayAs::Cardinal, Some("telephone")) => Some(SayAs::Phone),
        (SayAs::Cardinal, Some("cardinal")) => Some(SayAs::Cardinal),
        _ => None,
    };
    if formatted.is_none() {
        let format = format.unwrap_or_default();
        pieces.report(tag.at, format!("format=\"{format}\" is ignored"));
    }
    Markup::SayAs(formatted.unwrap_or(kind)).into()
}

fn phoneme(tag: &Tag, pieces: &mut Pieces<'_>) -> Meaning {
    let Some(ph) = filled(tag.get("ph")) else {
        return needs(tag, pieces, "ph");
    };
    let alphabet = tag.get("alphabet").unwrap_or("ipa").to_ascii_lowercase();
    let ipa = match alphabet.as_str() {
        "ipa" => Some(ph),
        "x-sampa" | "xsampa" => sampa::to_ipa(&ph),
        _ => None,
    };
    if ipa.is_none() {
        let message = format!("a pronunciation in {alphabet:?} is not understood");
        pieces.report(tag.at, message);
        return Meaning::default();
    }
    Markup::Pronunciation {
        ipa,
        sub: None,
        origin: None,
    }
    .into()
}

fn audio(tag: &Tag, pieces: &mut Pieces<'_>, is_there: &dyn Fn(&str) -> bool) -> Meaning {
    // Without an address, its content is spoken.
    let Some(src) = filled(tag.get("src")) else {
        return Meaning::default();
    };
    if !tag.is_empty && !is_there(&src) {
        let message =
            format!("there is no recording {src:?} next to the story; its text is spoken instead");
        pieces.report(tag.at, message);
        return Meaning::default();
    }
    for name in [
        "clipBegin",
        "clipEnd",
        "repeatCount",
        "repeatDur",
        "speed",
        "fetchtimeout",
    ] {
        if tag.get(name).is_some() {
            pieces.report(tag.at, format!("{name} of a recording is ignored"));
        }
    }
    let of_ours = tag
        .own_attribute("level")
        .and_then(|text| levels::number(text.trim()));
    let of_sound = word(tag, pieces, "soundLevel", decibels);
    Meaning {
        points: vec![Segment::Audio {
            src,
            background: tag.own_attribute("mode") == Some("background"),
            level: of_ours.or(of_sound).unwrap_or(1.0).max(0.0),
        }],
        silent: true,
        ..Meaning::default()
    }
}

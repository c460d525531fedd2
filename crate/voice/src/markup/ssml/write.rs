//! Writer of SSML.

use super::prosody::{
    decibels, decibels_text, height, height_text, loudness, loudness_text, rate_of_words, rate_text,
};
use super::{AGES, GENDERS, KINDS};
use crate::content::{Content, Division, Markup, Segment, Setting, Speaker};
use crate::markup::build::exact_text;
use crate::markup::levels::{EMPHASES, boundary_sign};
use crate::markup::sable::{ORDERS, word_of};
use crate::markup::write::{
    Element, MarkupWriter, body, declaration, emotion, escape, gain, loudness as finite,
};
use crate::style::Style;
use crate::text::SayAs;

/// Writes a document of SSML 1.1. `language` is the default BCP 47 tag. [`super::read()`] restores
/// content whose words have the same styles: if SSML lacks an exact equivalent, attributes and
/// elements in [`crate::markup::NAMESPACE`] give the exact value next to the closest one.
/// Characters that XML cannot contain become U+FFFD; empty attribute texts count as none.
#[must_use]
pub fn write(content: &Content, language: &str) -> String {
    let mut ssml = Ssml {
        styles: vec![Style::default()],
    };
    let body = body(content, &mut ssml);
    let mut tag = String::new();
    escape(&mut tag, language, true);
    // The root's language is no markup of the content's.
    let declaration = declaration(" r:");
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<speak version=\"1.1\" \
         xmlns=\"http://www.w3.org/2001/10/synthesis\"{declaration} xml:lang=\"{tag}\" \
         r:language=\"\">{body}</speak>\n"
    )
}

struct Ssml {
    /// The settings inside each open markup; never empty. SSML counts the rate from the
    /// voice's own, and a content from its surroundings.
    styles: Vec<Style>,
}

impl MarkupWriter for Ssml {
    fn markup(&mut self, markup: &Markup) -> Option<Element> {
        // No engine is selected: pitch, rate and volume depend on none.
        let style = self.styles.last().map(|s| s.with(markup, ""));
        let style = style.unwrap_or_default();
        let element = element(markup, &style);
        self.styles.push(style);
        element
    }

    fn end(&mut self) {
        if self.styles.len() > 1 {
            self.styles.pop();
        }
    }

    fn point(&mut self, segment: &Segment) -> Option<Element> {
        Some(match segment {
            Segment::Break { msec, boundary } => Element::new("break")
                .with("time", format!("{msec}ms"))
                .with_some("r:type", boundary.map(boundary_sign)),
            Segment::Audio {
                src,
                background,
                level,
            } => {
                let element = Element::new("audio").with("src", src.as_str());
                let level = gain(*level);
                let near = (level > 0.0).then(|| decibels_text(level));
                let is_exact = near.as_deref().and_then(decibels) == Some(level);
                let element = match near {
                    Some(_) if level == 1.0 => element,
                    Some(near) => element.with("soundLevel", near),
                    None => element.with("soundLevel", "-200dB"),
                };
                let exact = (!is_exact).then(|| level.to_string());
                element
                    .with_some("r:level", exact.as_deref())
                    .with_some("r:mode", background.then_some("background"))
            }
            Segment::Mark(name) => Element::new("mark").with("name", name.as_str()),
            Segment::Text(_) | Segment::Division(_) | Segment::Open(_) | Segment::Close => {
                return None;
            }
        })
    }

    fn division(&self, division: Division) -> Element {
        Element::new(match division {
            Division::Sentence => "s",
            Division::Paragraph => "p",
        })
    }
}

/// Returns true if a setting changes anything.
fn is_setting(setting: &Setting) -> bool {
    match setting {
        Setting::Default => true,
        Setting::Factor(x) | Setting::Value(x) => x.is_finite() && *x > 0.0,
    }
}

/// Returns the SSML element of a markup within content of style `style`; `None` if it needs no
/// element.
fn element(markup: &Markup, style: &Style) -> Option<Element> {
    Some(match markup {
        Markup::Emphasis(level) if level.is_finite() => {
            let level = level.clamp(0.0, 2.0);
            let far = |x: f64| (x - level).abs();
            let near = EMPHASES
                .iter()
                .min_by(|(_, a), (_, b)| far(*a).total_cmp(&far(*b)));
            let element = Element::new("emphasis").with_some("level", near.map(|(word, _)| *word));
            match near {
                Some((_, near)) if *near == level => element,
                _ => element.with("r:level", level.to_string()),
            }
        }
        Markup::Pitch {
            base,
            middle,
            range,
        } => pitch(*base, *middle, *range),
        Markup::Rate(setting) => rate(*setting, style),
        Markup::Volume(setting) => volume(finite(*setting)),
        Markup::Pronunciation { ipa, sub, origin } => {
            pronunciation(ipa.as_deref(), sub.as_deref(), origin.as_deref())
        }
        Markup::SayAs(kind) => say_as(kind),
        Markup::Language(language) => lang(language),
        Markup::Speaker(speaker) => voice(speaker),
        Markup::Engine { id, data } => Element::new("r:engine")
            .with("id", id.as_str())
            .with("data", data.as_str()),
        feeling @ Markup::Emotion { .. } => emotion(feeling)?,
        Markup::Emphasis(_) | Markup::Other => return None,
    })
}

fn pitch(base: Option<Setting>, middle: Option<Setting>, range: Option<Setting>) -> Element {
    let [base, middle, range] = [base, middle, range].map(|s| s.filter(is_setting));
    let read = |text: &str| height(text).map(|(settings, _)| settings);
    let mut element = Element::new("prosody");
    if let Some(setting) = middle {
        let names = ("pitch", "r:middle");
        element = element.with_setting(names, setting, Some(height_text(setting)), read);
    } else if let Some(setting) = base {
        // Other readers treat the base line as the pitch; this reader leaves the middle unchanged.
        element = element
            .with("pitch", height_text(setting))
            .with("r:middle", exact_text(Setting::Factor(1.0)));
    }
    if let Some(setting) = base {
        element = element.with("r:base", exact_text(setting));
    }
    if let Some(setting) = range {
        let names = ("range", "r:range");
        element = element.with_setting(names, setting, Some(height_text(setting)), read);
    }
    element
}

fn rate(setting: Setting, style: &Style) -> Element {
    let element = Element::new("prosody");
    if !is_setting(&setting) {
        return element;
    }
    match (setting, style.rate.value) {
        (Setting::Default, _) => element.with("rate", "default"),
        // The percentage is of the voice's own rate, with everything around it.
        (_, None) => element.with("rate", rate_text(style.rate.factor)),
        (_, Some(words)) => element
            .with("rate", rate_of_words(words * style.rate.factor))
            .with("r:rate", exact_text(setting)),
    }
}

fn volume(setting: Setting) -> Element {
    let element = Element::new("prosody");
    let is_silent = matches!(setting, Setting::Factor(x) | Setting::Value(x) if x == 0.0);
    if is_silent {
        return element.with("volume", "silent");
    }
    if !is_setting(&setting) {
        return element;
    }
    let text = Some(loudness_text(setting));
    element.with_setting(("volume", "r:volume"), setting, text, |text| {
        loudness(text).map(|(settings, _)| settings)
    })
}

fn pronunciation(ipa: Option<&str>, sub: Option<&str>, origin: Option<&str>) -> Element {
    let filled = |part: Option<&str>| part.is_some_and(|p| !p.is_empty());
    match (filled(ipa), filled(sub), filled(origin)) {
        (true, false, false) => Element::new("phoneme")
            .with("alphabet", "ipa")
            .with_some("ph", ipa),
        (false, true, false) => Element::new("sub").with_some("alias", sub),
        _ => Element::new("r:pronunciation")
            .with_some("ipa", ipa)
            .with_some("sub", sub)
            .with_some("origin", origin),
    }
}

fn say_as(kind: &SayAs) -> Element {
    let (kind, format) = match kind {
        SayAs::Date(Some(order)) => (&SayAs::Date(None), word_of(&ORDERS, order)),
        SayAs::Net { email } => (
            &SayAs::Net { email: false },
            Some(if *email { "email" } else { "uri" }),
        ),
        kind => (kind, None),
    };
    Element::new("say-as")
        .with_some("interpret-as", word_of(&KINDS, kind))
        .with_some("format", format)
}

fn lang(language: &str) -> Element {
    let is_tag = language.split('-').enumerate().all(|(i, part)| {
        (1..=8).contains(&part.len())
                && part.bytes().all(|b| b.is_ascii_alphanumeric())
                // `German` is a name, and has the shape of a tag.
                && (i > 0 || part.len() < 4)
    });
    let element = Element::new("lang");
    if is_tag {
        element.with("xml:lang", language)
    } else {
        element.with("xml:lang", "und").with("r:language", language)
    }
}

fn voice(speaker: &Speaker) -> Element {
    let age = speaker
        .age
        .and_then(|age| AGES.iter().find(|(a, _, _)| *a == age));
    let age = age.map(|(_, years, _)| years.to_string());
    let gender = speaker.gender.and_then(|g| word_of(&GENDERS, &Some(g)));
    let element = Element::new("voice")
        .with_some("gender", gender)
        .with_some("age", age.as_deref());
    match speaker.name.as_deref() {
        // A space would part two names.
        Some(name) if name.contains(|c: char| c.is_ascii_whitespace()) => element
            .with(
                "name",
                name.split_ascii_whitespace().collect::<Vec<_>>().join("_"),
            )
            .with("r:name", name),
        name => element.with_some("name", name),
    }
}

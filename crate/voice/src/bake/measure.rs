//! Effects of SABLE's markup and emotions on a voice, measured in its final audio: one line for
//! each setting, with the requested and the measured value.

mod row;

use self::row::{ACCENT_SLOPE, Unit};
pub use self::row::{Row, SLOPE_TOLERANCE, TOLERANCE};
use crate::assemble::Speech;
use crate::compare::{Difference, Melody, amplitude, compare, frequency};
use crate::content::Content;
use crate::emotion;
use crate::language;
use crate::markup::sable;
use crate::prosody::{AccentShape, Prosody};
use crate::realise;
use crate::text::Lexicon;
use anyhow::{Context as _, Result};
use raconteur_speech::bundle::{SILENCE, db_of_code};
use raconteur_speech::emotion::EmotionPoint;

use super::cast::{Cast, Role};
use super::speak::{self, RenderInput};

/// The test text, by language: all kinds of sounds, several accents, a comma or two.
const TEXTS: [(&str, [&str; 3]); 3] = [
    (
        "en",
        [
            "When we were young, our mother would",
            "always",
            "read to me by the warm yellow lamp in the garden room, and nobody knew why. \
             The old man lived alone in a yellow house near the river. \
             In the evening he would carry his lantern down to the water, and wait there for \
             a little boat to bring him news of his brother.",
        ],
    ),
    (
        "de",
        [
            "Als wir noch Kinder waren, las uns die Mutter",
            "immer",
            "wieder am gelben Licht der Lampe vor, und niemand wusste, warum. \
             Der alte Mann wohnte allein in einem gelben Haus am Wasser. \
             Am Abend trug er seine Laterne zum Ufer hinunter, und wartete dort auf ein \
             kleines Boot, das ihm von seinem Bruder Nachricht bringen sollte.",
        ],
    ),
    (
        "pt",
        [
            "Quando a gente era nova, a nossa m\u{e3}e lia",
            "sempre",
            "uma hist\u{f3}ria longa na luz amarela da sala, e ningu\u{e9}m sabia o motivo. \
             O velho morava sozinho numa casa amarela na margem do rio. \
             De noite levava a lanterna para a \u{e1}gua, e ali ficava \u{e0} espera de um \
             barco pequeno com not\u{ed}cias do irm\u{e3}o.",
        ],
    ),
];

/// Choice of the markup settings whose effect on the audio is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Settings {
    /// Every value of every attribute, and every dimension of emotion in both directions.
    All,
    /// The first value of each attribute, and each dimension up.
    OneOfAKind,
}

struct MeasurementSetup<'a> {
    cast: &'a Cast,
    settings: Settings,
    role: &'a Role,
    texts: [&'static str; 3],
    plain: Speech,
}

/// Measures a voice: SABLE's attributes, then the rules of emotion.
///
/// # Errors
/// Returns an error if the engine fails, or speaks other words under another setting.
pub fn measure(cast: &Cast, settings: Settings) -> Result<Vec<Row>> {
    let role = &cast.primary;
    let primary = language::primary(&role.voice.language);
    let (_, texts) = TEXTS
        .iter()
        .find(|(tag, _)| *tag == primary)
        .with_context(|| format!("there is no text to measure in {}", role.voice.language))?;
    let mut lab = MeasurementSetup {
        cast,
        settings,
        role,
        texts: *texts,
        plain: Speech {
            samples: Vec::new(),
            rate_hz: 0.0,
            utterance: Default::default(),
        },
    };
    lab.plain = lab.speak(&texts.join(" "), None)?;
    let mut rows = lab.attributes()?;
    rows.extend(lab.emphasis()?);
    rows.extend(lab.breaks()?);
    rows.extend(lab.emotions()?);
    Ok(rows)
}

impl MeasurementSetup<'_> {
    /// Returns the values of one kind of setting that are measured.
    fn of_a_kind<'v, T>(&self, values: &'v [T]) -> &'v [T] {
        match self.settings {
            Settings::All => values,
            Settings::OneOfAKind => &values[..values.len().min(1)],
        }
    }

    fn speak(&self, text: &str, emotion: Option<EmotionPoint>) -> Result<Speech> {
        let (content, _) = sable::read(&format!("<SABLE>{text}</SABLE>"))?;
        self.speak_content(&content, emotion)
    }

    fn speak_content(&self, content: &Content, emotion: Option<EmotionPoint>) -> Result<Speech> {
        let named = emotion.map(|place| ("measured".to_owned(), place));
        let work = RenderInput {
            content,
            role: self.role,
            emotion: named.as_ref(),
            tension: None,
            pace: 1.0,
        };
        let casting = speak::cast(&work, self.cast, &Lexicon::default())?;
        speak::speak(&work, &casting, self.cast, &|_| Ok(Vec::new()))
    }

    fn words(&self) -> usize {
        self.plain.utterance.words.len()
    }

    fn against(&self, changed: &Speech, first: usize, last: usize) -> Result<Difference> {
        let set = &self.role.voice.phone_set;
        compare(&self.plain, changed, set, first, last)
            .context("the engine speaks other phones with other settings")
    }

    /// Attributes around everything.
    fn attributes(&self) -> Result<Vec<Row>> {
        let last = self.words() - 1;
        let mut rows = Vec::new();
        for Attribute {
            tag,
            name,
            property,
            heard,
            values,
        } in ATTRIBUTES
        {
            for (value, asked) in self.of_a_kind(values) {
                let setting = format!("{tag} {name}=\"{value}\"");
                let text = self.texts.join(" ");
                let changed = self.speak(&format!("<{setting}>{text}</{tag}>"), None)?;
                let difference = self.against(&changed, 0, last)?;
                rows.push(Row::factor(&setting, property, *asked, heard(&difference)));
            }
        }
        Ok(rows)
    }

    /// Emphasis on one word.
    fn emphasis(&self) -> Result<Vec<Row>> {
        let mut rows = Vec::new();
        let [before, word, after] = self.texts;
        let index = before.split_whitespace().count();
        for level in self.of_a_kind(&["strong", "moderate", "reduced"]) {
            let setting = format!("EMPH LEVEL=\"{level}\"");
            let changed =
                self.speak(&format!("{before} <{setting}>{word}</EMPH> {after}"), None)?;
            let heard = self.against(&changed, index, index)?;
            let level = crate::markup::levels::emphasis(level).unwrap_or(1.0);
            let (longer, higher, louder) = realise::emphasis(level);
            rows.push(Row::factor(&setting, "length", longer, heard.duration));
            rows.push(Row::new(
                &setting,
                "semitones",
                Unit::Semitones,
                higher,
                heard.semitones,
            ));
            rows.push(Row::new(
                &setting,
                "decibels",
                Unit::Decibels,
                louder,
                heard.db,
            ));
        }
        Ok(rows)
    }

    /// Breaks in the middle of a sentence.
    fn breaks(&self) -> Result<Vec<Row>> {
        let mut rows = Vec::new();
        let [before, word, after] = self.texts;
        for &(setting, secs) in self.of_a_kind(&[
            ("BREAK LEVEL=\"small\"", 0.15),
            ("BREAK LEVEL=\"medium\"", 0.35),
            ("BREAK LEVEL=\"large\"", 0.8),
            ("BREAK MSEC=\"500\"", 0.5),
            ("BREAK MSEC=\"1500\"", 1.5),
        ]) {
            let spoken = self.speak(&format!("{before} {word} <{setting}/> {after}"), None)?;
            let index = before.split_whitespace().count();
            rows.push(Row::new(
                setting,
                "seconds",
                Unit::Seconds,
                secs,
                silence(&spoken, index),
            ));
        }
        Ok(rows)
    }

    /// Measures each dimension alone, half way up and down (F&H table 4.5).
    fn emotions(&self) -> Result<Vec<Row>> {
        let mut rows = Vec::new();
        let last = self.words() - 1;
        let both = |name| [50.0, -50.0].map(|sign: f64| (name, sign));
        let dimensions = ["activation", "evaluation", "power"].map(both);
        for &(name, sign) in dimensions.iter().flat_map(|d| self.of_a_kind(d)) {
            let mut place = EmotionPoint::default();
            match name {
                "activation" => place.activation = sign,
                "evaluation" => place.evaluation = sign,
                _ => place.power = sign,
            }
            let changed = self.speak(&self.texts.join(" "), Some(place))?;
            let heard = self.against(&changed, 0, last)?;
            let asked = Prosody::from_point(place);
            let setting = format!("{name} {sign:+}");
            let melody = heard.melody.context("too little of it is voiced")?;
            rows.extend(self.number_of_pauses(&setting, &asked, &heard));
            for (property, asked, heard) in factors(&asked, &heard, &melody) {
                if (asked - 1.0).abs() > 1e-9 {
                    rows.push(Row::factor(&setting, property, asked, heard));
                }
            }
            for (property, asked, heard) in sums(&asked, place, &melody) {
                if asked.abs() > 1e-9 {
                    rows.push(Row::new(&setting, property, Unit::Semitones, asked, heard));
                }
            }
        }
        Ok(rows)
    }

    /// Measures the number of pauses, which changes in whole steps.
    fn number_of_pauses(&self, setting: &str, asked: &Prosody, heard: &Difference) -> Option<Row> {
        let before = heard.pauses.0 as f64;
        let usual = before.max(self.words() as f64 / emotion::WORDS_A_PAUSE);
        let wanted = (usual * asked.number_of_pauses).round();
        (wanted != before && asked.number_of_pauses != 1.0).then(|| {
            let before = before.max(1.0);
            let heard = heard.pauses.1 as f64 / before;
            Row::factor(setting, "number of pauses", wanted / before, heard)
        })
    }
}

/// Returns the requested and the measured factor of each property.
fn factors(asked: &Prosody, heard: &Difference, melody: &Melody) -> [(&'static str, f64, f64); 8] {
    [
        ("pitch", asked.pitch, frequency(melody.semitones)),
        ("range", asked.range, melody.range),
        ("range dynamics", asked.range_dynamics, melody.range_growth),
        (ACCENT_SLOPE, asked.accent_slope, melody.accent_slope),
        (
            "vowels, nasals, liquids",
            asked.sonorant_duration / asked.rate,
            heard.sonorant_duration,
        ),
        (
            "plosives, fricatives",
            asked.obstruent_duration / asked.rate,
            heard.obstruent_duration,
        ),
        (
            "pause duration",
            asked.pause_duration / asked.rate,
            heard.pause_duration,
        ),
        ("amplitude", asked.volume, amplitude(heard.db)),
    ]
}

/// Returns the requested and the measured change of each property in semitones.
fn sums(asked: &Prosody, place: EmotionPoint, melody: &Melody) -> [(&'static str, f64, f64); 5] {
    let semitones = |factor: f64| 12.0 * libm::log2(factor);
    let tilt = match asked.accent_shape {
        Some(AccentShape::Rising) => realise::SHAPE_SEMITONES,
        Some(AccentShape::Falling) => -realise::SHAPE_SEMITONES,
        _ => 0.0,
    };
    // The first of a sentence rises.
    let alternation = match asked.accent_shape {
        Some(AccentShape::Alternating) => realise::SHAPE_SEMITONES,
        _ => 0.0,
    };
    let end = match asked.ends_high {
        Some(high) => {
            let sign = if high { 1.0 } else { -1.0 };
            sign * realise::BOUNDARY_SEMITONES * place.power.abs() / 100.0
        }
        None => 0.0,
    };
    let accent = realise::ACCENT_SEMITONES * (asked.accent_prominence - 1.0);
    [
        (
            "pitch dynamics, st",
            semitones(asked.pitch_dynamics),
            melody.rise,
        ),
        ("accent prominence, st", accent, melody.accent),
        ("accent shape, st", tilt, melody.accent_tilt),
        ("phrase ends, st", end, melody.end),
        (
            "accents alternate, st",
            alternation,
            melody.accent_alternation,
        ),
    ]
}

/// SABLE attribute with its acoustic effect.
struct Attribute {
    tag: &'static str,
    name: &'static str,
    /// Affected property, and its measurement.
    property: &'static str,
    heard: fn(&Difference) -> f64,
    /// Values with their factors.
    values: &'static [(&'static str, f64)],
}

fn pitch_heard(difference: &Difference) -> f64 {
    difference
        .melody
        .map_or(f64::NAN, |m| frequency(m.semitones))
}

const ATTRIBUTES: [Attribute; 5] = [
    Attribute {
        tag: "RATE",
        name: "SPEED",
        property: "pace",
        heard: |d| 1.0 / d.duration,
        values: &[
            ("-30%", 0.7),
            ("+30%", 1.3),
            ("slowest", 0.6),
            ("slow", 0.8),
            ("fast", 1.2),
            ("fastest", 1.5),
        ],
    },
    Attribute {
        tag: "PITCH",
        name: "BASE",
        property: "pitch",
        heard: pitch_heard,
        values: &[
            ("-20%", 0.8),
            ("+30%", 1.3),
            ("lowest", 0.8),
            ("highest", 1.2),
        ],
    },
    Attribute {
        tag: "PITCH",
        name: "MIDDLE",
        property: "pitch",
        heard: pitch_heard,
        values: &[("-20%", 0.8), ("+30%", 1.3), ("low", 0.9), ("high", 1.1)],
    },
    Attribute {
        tag: "PITCH",
        name: "RANGE",
        property: "range",
        heard: |d| d.melody.map_or(f64::NAN, |m| m.range),
        values: &[
            ("-50%", 0.5),
            ("+50%", 1.5),
            ("smallest", 0.8),
            ("largest", 1.2),
        ],
    },
    Attribute {
        tag: "VOLUME",
        name: "LEVEL",
        property: "amplitude",
        heard: |d| amplitude(d.db),
        values: &[
            ("-50%", 0.5),
            ("+50%", 1.5),
            ("quiet", 0.5),
            ("loud", 1.5),
            ("loudest", 2.0),
        ],
    },
];

/// Returns the duration of silence after a word in the audio: from 30 dB below the speech until the
/// level rises again.
fn silence(track: &Speech, word: usize) -> f64 {
    let u = &track.utterance;
    let speech = u
        .phones
        .iter()
        .filter(|p| p.symbol != SILENCE)
        .map(|p| frame(u, (p.start_secs + p.end_secs) / 2.0))
        .fold(f64::NEG_INFINITY, f64::max);
    let Some(pause) = u
        .phones
        .iter()
        .find(|p| p.symbol == SILENCE && p.start_secs >= u.words[word].end_secs - 1e-6)
    else {
        return 0.0;
    };
    let middle = (pause.start_secs + pause.end_secs) / 2.0;
    let is_still = |secs: f64| frame(u, secs) < speech - 30.0;
    let step = 0.001;
    let reach = |sign: f64| {
        let mut secs = 0.0;
        while secs < pause.end_secs - pause.start_secs && is_still(middle + sign * secs) {
            secs += step;
        }
        secs
    };
    reach(-1.0) + reach(1.0)
}

/// Returns the intensity at a time, decibels, interpolated linearly between frames.
fn frame(u: &raconteur_speech::Utterance, secs: f64) -> f64 {
    let place = (secs / raconteur_speech::bundle::FRAME_SECS).max(0.0);
    let at = |i: usize| u.intensity.get(i).map_or(-100.0, |code| db_of_code(*code));
    let low = place as usize;
    at(low) + (at(low + 1) - at(low)) * (place - low as f64)
}

//! Annotation tiers, as in Praat and ELAN: selection of those with phones, words, syllables and
//! pitch contour.

use super::draft::{Draft, Kind, Point, Raw, is_silence};
use super::text::{TextError, clip};

const PHONES: [&str; 11] = [
    "phones",
    "phone",
    "phonemes",
    "phoneme",
    "phonetic",
    "phn",
    "mau",
    "segments",
    "segment",
    "allophones",
    "sounds",
];
const WORDS: [&str; 8] = [
    "words",
    "word",
    "ort",
    "ort-mau",
    "orthography",
    "tokens",
    "token",
    "wrd",
];
const SYLLABLES: [&str; 4] = ["syllables", "syllable", "syl", "mas"];
const TONES: [&str; 5] = ["tones", "tone", "tobi", "accents", "intonation"];
const BREAKS: [&str; 3] = ["breaks", "break", "break indices"];

/// Annotation tier as written in the file: intervals or points.
pub(super) struct Tier {
    /// Name of the tier, in lower case.
    pub(super) name: String,
    pub(super) at: usize,
    pub(super) intervals: Vec<Raw>,
    pub(super) points: Vec<Point>,
    /// True if the tier has points, not intervals.
    pub(super) is_points: bool,
}

/// Returns true if a tier has one of the names; aligners put the speaker before the name (`anna -
/// words`), annotators after it (`words@anna`).
fn named(tier: &Tier, names: &[&str]) -> bool {
    let last = tier.name.rsplit(" - ").next().unwrap_or_default();
    let own = last.split('@').next().unwrap_or_default().trim();
    names.contains(&own)
}

/// Selects the first tier of each kind by name.
pub(super) fn choose(mut tiers: Vec<Tier>, draft: &mut Draft, at: usize) -> Result<(), TextError> {
    let mut found = [false; 5];
    for tier in &mut tiers {
        let kinds: [&[&str]; 5] = [&PHONES, &WORDS, &SYLLABLES, &TONES, &BREAKS];
        let Some(kind) = kinds.iter().position(|names| named(tier, names)) else {
            continue;
        };
        if found[kind] || tier.is_points != (kind > 2) {
            continue;
        }
        found[kind] = true;
        let intervals = std::mem::take(&mut tier.intervals);
        let points = std::mem::take(&mut tier.points);
        match kind {
            0 => draft.segments = intervals,
            1 => draft.words = intervals,
            2 => {
                let spoken = intervals.iter().filter(|i| !is_silence(&i.label));
                draft.syllables = spoken.map(|i| (i.start, i.end, stress(&i.label))).collect();
            }
            3 => {
                for point in points {
                    if point.label.contains('*') {
                        draft.accents.push(point);
                    } else {
                        draft.tones.push((point, None));
                    }
                }
            }
            _ => {
                for mut point in points {
                    let index = point.label.trim().chars().next();
                    let index = index.and_then(|c| c.to_digit(7));
                    if let Some(index) = index.and_then(|i| u8::try_from(i).ok()) {
                        point.label.clear();
                        draft.tones.push((point, Some(index)));
                    }
                }
            }
        }
    }
    if found[0] || found[1] {
        return Ok(());
    }
    // A grid of a single tier needs no name: its labels identify it.
    let mut whole = tiers.iter_mut().filter(|t| !t.is_points);
    match (whole.next(), whole.next()) {
        (Some(only), None) => {
            draft.segments = std::mem::take(&mut only.intervals);
            draft.kind = Kind::Unsure;
            Ok(())
        }
        (first, _) => {
            let at = first.map_or(at, |t| t.at);
            let names: Vec<String> = tiers.iter().take(10).map(|t| clip(&t.name)).collect();
            let message = format!("no tier of phones or words among {names:?}");
            Err(TextError::new(at, message))
        }
    }
}

/// Stress as syllable tiers mark it.
fn stress(label: &str) -> u8 {
    match label.trim().chars().next() {
        Some('\'' | 'ˈ' | '"' | '1') => 1,
        Some(',' | 'ˌ' | '%' | '2') => 2,
        _ => 0,
    }
}

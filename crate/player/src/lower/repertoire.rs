//! The library's music (GEVH 3.5.4.3): three pieces of each valence, of which a performance plays
//! one.

use raconteur_base::noise;
use raconteur_eml::Document;
use raconteur_stage::emotion::Valence;

use crate::lower::music_stem::MusicStem;

/// Random stream of the choice of music; other uses of the seed have other numbers.
const CHOICE: u64 = 0x6d75_7369;

/// Piece of music in the library: a loop with a second stem that arousal adds.
#[derive(Debug, PartialEq)]
pub(crate) struct LibraryPiece {
    pub(crate) name: &'static str,
    /// A bar, seconds.
    pub(crate) bar_secs: f64,
}

const fn piece(name: &'static str, beats: f64, beats_a_minute: f64) -> LibraryPiece {
    LibraryPiece {
        name,
        bar_secs: 60.0 * beats / beats_a_minute,
    }
}

/// Fast.
static POSITIVE: [LibraryPiece; 3] = [
    piece("positive-lively", 4.0, 132.0),
    piece("positive-reel", 4.0, 144.0),
    piece("positive-waltz", 3.0, 150.0),
];
/// Neutral pieces, of medium tempo.
static NEUTRAL: [LibraryPiece; 3] = [
    piece("neutral", 4.0, 100.0),
    piece("neutral-stroll", 4.0, 96.0),
    piece("neutral-round", 3.0, 108.0),
];
/// Slow.
static NEGATIVE: [LibraryPiece; 3] = [
    piece("negative-calm", 3.0, 54.0),
    piece("negative-lament", 4.0, 64.0),
    piece("negative-heavy", 4.0, 60.0),
];

/// Returns the pieces of `assets/music` for a valence.
fn library(valence: Valence) -> &'static [LibraryPiece; 3] {
    match valence {
        Valence::Positive => &POSITIVE,
        Valence::Neutral => &NEUTRAL,
        Valence::Negative => &NEGATIVE,
    }
}

impl LibraryPiece {
    /// Returns the stems of the piece; the one for arousal follows the level `rise` over story
    /// time.
    pub(crate) fn voices(&self, rise: Vec<(f64, f64)>) -> Vec<MusicStem> {
        let voice = |ending: &str, share| MusicStem {
            file: format!("{}{ending}.opus", self.name),
            library: true,
            loops: true,
            share,
        };
        vec![voice("", Vec::new()), voice("-rise", rise)]
    }
}

/// Selection of library pieces for a performance: one for each valence, drawn by its seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Repertoire {
    seed: u64,
}

impl Repertoire {
    pub(crate) const fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// Chooses the pieces of a script by its own seed, if any, else by the host's.
    pub(crate) fn choose(document: &Document, otherwise: u64) -> Self {
        let own = document.environment.as_ref().and_then(|e| e.seed);
        Self::new(own.map_or(otherwise, u64::from))
    }

    /// Returns the piece for a valence, the same throughout the performance.
    pub(crate) fn piece(self, valence: Valence) -> &'static LibraryPiece {
        let pieces = library(valence);
        let drawn = noise::hash(self.seed, CHOICE, valence as i64);
        &pieces[(drawn % pieces.len() as u64) as usize]
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    const VALENCES: [Valence; 3] = [Valence::Negative, Valence::Neutral, Valence::Positive];

    fn file(piece: &LibraryPiece, ending: &str) -> std::path::PathBuf {
        let path = format!("../../assets/music/{}{ending}", piece.name);
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
    }

    fn score(piece: &LibraryPiece, ending: &str) -> serde_json::Value {
        let text = std::fs::read_to_string(file(piece, ending)).expect(piece.name);
        serde_json::from_str(&text).expect(piece.name)
    }

    #[test]
    fn a_script_may_draw_for_itself() {
        let drawn = |attributes: &str| {
            let text = format!(
                "<eml xmlns:r='urn:raconteur:eml:1'><head><r:environment {attributes}/></head>\
                 <body><null time='1'/></body></eml>"
            );
            let parsed = raconteur_eml::parse(&text);
            assert_eq!(parsed.diagnostics, []);
            Repertoire::choose(&parsed.document, 5)
        };
        assert_eq!(drawn(""), Repertoire::new(5));
        assert_eq!(drawn("seed='12'"), Repertoire::new(12));
    }

    #[test]
    fn tempi_are_fast_medium_and_slow_as_the_scores_have_them() {
        for (valence, tempi) in [
            (Valence::Positive, 120.0..=150.0),
            (Valence::Neutral, 90.0..=110.0),
            (Valence::Negative, 48.0..=72.0),
        ] {
            for piece in library(valence) {
                for ending in [".json", "-rise.json"] {
                    let score = score(piece, ending);
                    let number = |name: &str| score[name].as_f64().expect(name);
                    let bpm = number("bpm");
                    assert!(tempi.contains(&bpm), "{}: {bpm}", piece.name);
                    let bar_secs = 60.0 * number("beats") / bpm;
                    assert!((bar_secs - piece.bar_secs).abs() < 1e-9, "{}", piece.name);
                }
            }
        }
    }

    /// Returns the length of an Ogg Opus file, samples at 48 kHz (RFC 7845, section 4): the
    /// position of the last page less the initial skip.
    fn opus_samples(path: &std::path::Path) -> u64 {
        let bytes = std::fs::read(path).expect("a file");
        let page = bytes
            .windows(4)
            .rposition(|w| w == b"OggS")
            .expect("a page");
        let head = bytes
            .windows(8)
            .position(|w| w == b"OpusHead")
            .expect("a head");
        let end = bytes[page + 6..page + 14]
            .try_into()
            .map(u64::from_le_bytes);
        let skip = bytes[head + 10..head + 12]
            .try_into()
            .map(u16::from_le_bytes);
        end.expect("8 bytes") - u64::from(skip.expect("2 bytes"))
    }

    #[test]
    fn both_stems_of_a_piece_are_equally_long_and_whole_bars() {
        for piece in VALENCES.iter().flat_map(|v| library(*v)) {
            let [base, rise] = ["", "-rise"].map(|ending| {
                let score = score(piece, &format!("{ending}.json"));
                let form = score["form"].as_array().expect("a form").clone();
                let bars: Vec<_> = form.iter().map(|s| s["bars"].clone()).collect();
                let chords: Vec<_> = form.iter().map(|s| s["chords"].clone()).collect();
                let samples = opus_samples(&file(piece, &format!("{ending}.opus")));
                let mp3 = std::fs::metadata(file(piece, &format!("{ending}.mp3"))).expect("an mp3");
                (bars, chords, score["tail"].clone(), samples, mp3.len())
            });
            assert_eq!(base, rise, "{}", piece.name);
            let bars: f64 = base.0.iter().filter_map(serde_json::Value::as_f64).sum();
            let samples = (bars * piece.bar_secs * 48_000.0).round();
            assert_eq!(base.3 as f64, samples, "{}", piece.name);
            assert!(
                (20.0..=30.5).contains(&(samples / 48_000.0)),
                "{}",
                piece.name
            );
            assert_eq!(base.2.as_f64(), Some(0.0), "{} repeats", piece.name);
        }
    }

    #[test]
    fn the_seed_alone_draws_and_reaches_every_piece() {
        let names = |seed| VALENCES.map(|v| Repertoire::new(seed).piece(v).name);
        assert_eq!(names(7), names(7));
        let all: BTreeSet<_> = (0..400).map(names).collect();
        // Each valence draws for itself.
        assert_eq!(all.len(), 27);
        let pieces: BTreeSet<_> = all.into_iter().flatten().collect();
        assert_eq!(pieces.len(), 9);
        for (i, valence) in VALENCES.into_iter().enumerate() {
            let mut counts = [0; 3];
            for seed in 0..3000 {
                let name = names(seed)[i];
                let drawn = library(valence).iter().position(|p| p.name == name);
                counts[drawn.expect("a piece of the valence")] += 1;
            }
            // Four standard deviations of a third of 3000 draws are 103.
            assert!(
                counts.iter().all(|n: &i32| (n - 1000).abs() < 103),
                "{counts:?}"
            );
        }
    }
}

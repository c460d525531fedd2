//! Score format: tracks, patterns of one bar or more, and a form that plays them over chords.
//! `assets/music/README.md` describes it for composers.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result, bail, ensure};
use serde::Deserialize;

use super::harmony::{Chord, chord, pitch};
use super::instrument::Instrument;
use super::note::Note;

/// The longest piece without its tail, seconds.
const MAX_SECS: f64 = 1200.0;
/// Maximum number of notes and cells in a piece; a cell that holds notes counts for each.
const MAX_WORK: usize = 1_000_000;

/// Musical score as written in JSON: tempo, loudness, tracks, patterns and form.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Score {
    /// Title of the piece.
    pub(crate) title: String,
    /// Quarter notes a minute.
    pub(crate) bpm: f64,
    /// Quarter notes a bar.
    pub(crate) beats: u32,
    /// Seed of noise and of small differences of loudness.
    pub(crate) seed: u64,
    /// Integrated loudness of the whole, LUFS.
    pub(crate) loudness: f64,
    /// Seconds that the last notes may ring after the last bar; 0 makes a piece that repeats.
    pub(crate) tail: f64,
    tracks: Vec<Track>,
    patterns: BTreeMap<String, Pattern>,
    form: Vec<Section>,
}

/// Track of a score: instrument, level, pan and effect sends.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Track {
    name: String,
    /// Instrument of the track.
    pub(crate) instrument: Instrument,
    /// Level, dB.
    pub(crate) level: f64,
    /// Stereo position, -1 (left) to 1 (right).
    #[serde(default)]
    pub(crate) pan: f64,
    /// Reverb send, 0..1.
    #[serde(default)]
    pub(crate) room: f64,
    /// Share that echoes after three eighths, 0..1.
    #[serde(default)]
    pub(crate) echo: f64,
    /// Attenuation by each stroke of the kick drum (ducking), 0..1.
    #[serde(default)]
    pub(crate) duck: f64,
    /// Lowest note for degrees of a chord.
    #[serde(default = "middle")]
    low: String,
}

fn middle() -> String {
    "C4".to_owned()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pattern {
    track: String,
    /// Bars of the pattern, one text each, divided into as many equal cells as it has words. The
    /// bars repeat.
    bars: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Section {
    name: String,
    bars: u32,
    /// Bars are divided by `|`, and equally between the chords of a bar; they repeat.
    #[serde(default)]
    chords: String,
    /// Patterns, each with a level in dB if it has one: `arp:-3`, or `arp:-20>0` for a swell.
    play: Vec<String>,
}

/// Track with the notes that it plays in the whole piece.
pub(crate) struct Part {
    /// Track.
    pub(crate) track: Track,
    /// Notes, sorted by start.
    pub(crate) notes: Vec<Note>,
}

impl Score {
    /// Reads a score.
    ///
    /// # Errors
    /// Returns an error if the text is not JSON of this format, or its numbers are invalid.
    pub(crate) fn read(json: &str) -> Result<Self> {
        let score: Self = serde_json::from_str(json).context("the score cannot be read")?;
        ensure!(
            (20.0..=400.0).contains(&score.bpm),
            "bpm is 20 to 400, not {}",
            score.bpm
        );
        ensure!(
            (1..=16).contains(&score.beats),
            "beats is 1 to 16, not {}",
            score.beats
        );
        ensure!(
            (-60.0..=-6.0).contains(&score.loudness),
            "loudness is -60 to -6 LUFS, not {}",
            score.loudness
        );
        ensure!(
            (0.0..=30.0).contains(&score.tail),
            "tail is 0 to 30 s, not {}",
            score.tail
        );
        for track in &score.tracks {
            let shares = [track.room, track.echo, track.duck, track.pan.abs()];
            ensure!(
                (-120.0..=24.0).contains(&track.level)
                    && shares.iter().all(|s| (0.0..=1.0).contains(s)),
                "track {}: level is -120 to 24 dB, pan -1 to 1, room, echo and duck 0 to 1",
                track.name
            );
        }
        let length = score.length_secs();
        ensure!(
            length <= MAX_SECS,
            "the piece is {length} s long; {MAX_SECS} is the limit"
        );
        Ok(score)
    }

    fn bar_secs(&self) -> f64 {
        f64::from(self.beats) * 60.0 / self.bpm
    }

    /// Returns the length of the piece without its tail, seconds.
    pub(crate) fn length_secs(&self) -> f64 {
        let bars: f64 = self.form.iter().map(|s| f64::from(s.bars)).sum();
        bars * self.bar_secs()
    }

    /// Names of the sections and when they begin, seconds.
    pub(crate) fn sections(&self) -> Vec<(&str, f64)> {
        let mut bar = 0;
        let mut at = |section: &Section| {
            let start = f64::from(bar) * self.bar_secs();
            bar += section.bars;
            start
        };
        self.form.iter().map(|s| (s.name.as_str(), at(s))).collect()
    }

    /// Returns every track with its notes.
    ///
    /// # Errors
    /// Returns an error if a name, a chord or a cell is invalid, or there are too many notes.
    pub(crate) fn parts(&self) -> Result<Vec<Part>> {
        let mut parts: Vec<Part> = self.tracks.iter().cloned().map(Part::new).collect();
        let mut first_bar = 0;
        let mut work = 0;
        for section in &self.form {
            let chords = section.chords()?;
            for entry in &section.play {
                let (name, swell) = level(entry)?;
                let pattern = self
                    .patterns
                    .get(name)
                    .with_context(|| format!("section {}: no pattern {name}", section.name))?;
                let part = parts
                    .iter_mut()
                    .find(|p| p.track.name == pattern.track)
                    .with_context(|| format!("pattern {name}: no track {}", pattern.track))?;
                let low = pitch(&part.track.low)?;
                let mut held = Vec::new();
                for bar in 0..section.bars {
                    let text = pattern
                        .bars
                        .get(bar as usize % pattern.bars.len().max(1))
                        .with_context(|| format!("pattern {name} has no bars"))?;
                    let cells: Vec<&str> = text.split_whitespace().collect();
                    for (i, cell) in cells.iter().enumerate() {
                        let inside = (f64::from(bar) + i as f64 / cells.len() as f64)
                            / f64::from(section.bars);
                        let start =
                            f64::from(first_bar) + f64::from(bar) + i as f64 / cells.len() as f64;
                        let at = Cell {
                            start_secs: start * self.bar_secs(),
                            length_secs: self.bar_secs() / cells.len() as f64,
                            gain: gain(swell.0 + (swell.1 - swell.0) * inside),
                            low,
                            chord: chord_at(
                                &chords,
                                f64::from(bar) + i as f64 / cells.len() as f64,
                            ),
                        };
                        let (notes_before, held_before) = (part.notes.len(), held.len());
                        at.play(cell, &mut held, &mut part.notes)
                            .with_context(|| format!("pattern {name}, bar {text:?}"))?;
                        // Held cells and notes cost time too.
                        work += 1 + held_before + (part.notes.len() - notes_before);
                        ensure!(
                            work <= MAX_WORK,
                            "pattern {name}: more than {MAX_WORK} notes and cells"
                        );
                    }
                }
            }
            first_bar += section.bars;
        }
        for part in &mut parts {
            part.notes
                .sort_by(|a, b| a.start_secs.total_cmp(&b.start_secs));
        }
        Ok(parts)
    }
}

impl Part {
    fn new(track: Track) -> Self {
        Self {
            track,
            notes: Vec::new(),
        }
    }
}

impl Section {
    /// Returns the chords of each bar of the section; empty if it has none.
    fn chords(&self) -> Result<Vec<Vec<Chord>>> {
        if self.chords.is_empty() {
            return Ok(Vec::new());
        }
        let bars = self.chords.split('|');
        bars.map(|bar| bar.split_whitespace().map(chord).collect())
            .collect::<Result<_>>()
            .with_context(|| format!("section {}", self.name))
    }
}

/// Returns the chord at a position, in bars from the start of its section.
fn chord_at(chords: &[Vec<Chord>], bars: f64) -> Option<&Chord> {
    let bar = chords.get(bars as usize % chords.len().max(1))?;
    // Cells of three in a bar of two chords: a time that is a rounding error below belongs above.
    let inside = (bars - bars.floor() + 1e-9) * bar.len() as f64;
    bar.get(inside as usize).or(bar.last())
}

/// Splits an entry into the pattern name and its level at start and end, dB; 0 dB without one.
fn level(entry: &str) -> Result<(&str, (f64, f64))> {
    let Some((name, levels)) = entry.split_once(':') else {
        return Ok((entry, (0.0, 0.0)));
    };
    let number = |text: &str| -> Result<f64> {
        let db: f64 = text.parse().with_context(|| format!("{entry}: no level"))?;
        ensure!(db.is_finite() && db <= 24.0, "{entry}: no level");
        Ok(db)
    };
    let (from, to) = levels.split_once('>').unwrap_or((levels, levels));
    Ok((name, (number(from)?, number(to)?)))
}

/// Returns the amplitude factor of a level in dB.
pub(crate) fn gain(db: f64) -> f64 {
    libm::pow(10.0, db / 20.0)
}

/// Cell of a bar.
struct Cell<'a> {
    start_secs: f64,
    length_secs: f64,
    gain: f64,
    low: f64,
    chord: Option<&'a Chord>,
}

impl Cell<'_> {
    /// Plays the text of a cell; `held` are the notes that a following `-` extends.
    fn play(&self, text: &str, held: &mut Vec<usize>, notes: &mut Vec<Note>) -> Result<()> {
        match text {
            "." => held.clear(),
            "-" => {
                for &i in held.iter() {
                    notes[i].length_secs += self.length_secs;
                }
            }
            _ => {
                held.clear();
                let (names, stress) = match text.as_bytes().last() {
                    Some(b'!') => (&text[..text.len() - 1], 1.35),
                    Some(b'?') => (&text[..text.len() - 1], 0.55),
                    _ => (text, 1.0),
                };
                for name in names.split('+') {
                    for pitch in self.pitches(name)? {
                        held.push(notes.len());
                        notes.push(Note {
                            start_secs: self.start_secs,
                            length_secs: self.length_secs,
                            pitch,
                            velocity: stress * self.gain,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    fn pitches(&self, name: &str) -> Result<Vec<f64>> {
        if name == "x" {
            return Ok(vec![0.0]);
        }
        if name.starts_with(|c: char| c.is_ascii_uppercase()) {
            return Ok(vec![pitch(name)?]);
        }
        let chord = self.chord.context("there is no chord here")?;
        Ok(match name {
            "*" => chord.close(self.low),
            "b" => vec![chord.bass(self.low)],
            _ => match name.parse::<u32>() {
                Ok(degree @ 1..=24) => vec![chord.degree(degree, self.low)],
                _ => bail!("{name:?} is not a note"),
            },
        })
    }
}

/// Checks the invariants for any text: it is rejected, or its notes lie in the piece.
///
/// # Panics
/// Panics if an invariant does not hold.
pub fn assert_valid(text: &str) {
    let Ok((score, parts)) = Score::read(text).and_then(|s| s.parts().map(|p| (s, p))) else {
        return;
    };
    let end_secs = score.length_secs() + 1e-6;
    assert!(
        end_secs.is_finite() && score.sections().iter().all(|(_, at)| *at <= end_secs),
        "the score has a finite end after all its sections"
    );
    for note in parts.iter().flat_map(|part| &part.notes) {
        assert!(
            note.start_secs >= 0.0 && note.start_secs <= end_secs,
            "{note:?}"
        );
        assert!(
            note.length_secs >= 0.0 && note.length_secs <= end_secs,
            "{note:?}"
        );
        assert!(
            note.pitch.is_finite() && note.velocity.is_finite(),
            "{note:?}"
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saved_scores_are_refused_or_hold_together() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut texts = 0;
        for folder in ["fuzz/saved/score", "assets/music"] {
            for entry in std::fs::read_dir(root.join(folder)).expect("a folder of scores") {
                let path = entry.expect("an entry").path();
                if path.extension().is_none_or(|e| e == "json") {
                    assert_valid(&std::fs::read_to_string(path).expect("a score"));
                    texts += 1;
                }
            }
        }
        assert!(texts >= 4, "only {texts} scores");
    }

    const SCORE: &str = r#"{
        "title": "t", "bpm": 120, "beats": 4, "seed": 1, "loudness": -20, "tail": 0,
        "tracks": [{"name": "k", "instrument": "kick", "level": 0},
                   {"name": "p", "instrument": "pluck", "level": 0, "low": "C3"}],
        "patterns": {"four": {"track": "k", "bars": ["x . x! ."]},
                     "arp": {"track": "p", "bars": ["1 3 5 -", "* - - ."]}},
        "form": [{"name": "a", "bars": 1, "play": ["four"]},
                 {"name": "b", "bars": 2, "chords": "Am | C/E F", "play": ["four", "arp:-6>0"]}]
    }"#;

    #[test]
    fn notes_fall_where_they_are_written() {
        let score = Score::read(SCORE).expect("a score");
        assert_eq!(score.length_secs(), 6.0);
        assert_eq!(score.sections(), [("a", 0.0), ("b", 2.0)]);
        let parts = score.parts().expect("parts");
        let starts: Vec<f64> = parts[0].notes.iter().map(|n| n.start_secs).collect();
        assert_eq!(starts, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        let played: Vec<_> = parts[1]
            .notes
            .iter()
            .map(|n| (n.start_secs, n.length_secs, n.pitch))
            .collect();
        // The first, third and fifth tone of A minor from A3 upwards; then the C nearest above C3,
        // held over the bar.
        let first = [(2.0, 0.5, 57.0), (2.5, 0.5, 64.0), (3.0, 1.0, 72.0)];
        assert_eq!(played[..3], first);
        assert_eq!(
            played[3..],
            [(4.0, 1.5, 48.0), (4.0, 1.5, 52.0), (4.0, 1.5, 55.0)]
        );
        let v = |i: usize| parts[1].notes[i].velocity;
        assert!(
            (v(0) - gain(-6.0)).abs() < 1e-12 && v(0) < v(1) && v(2) < v(3),
            "the written dynamics set the gains"
        );
    }

    #[test]
    fn what_means_nothing_is_named() {
        for (from, to, said) in [
            ("* - - .", "* - h .", "\"h\" is not a note"),
            ("Am |", "Hm |", "Hm"),
            ("\"arp:-6>0\"", "\"harp\"", "no pattern harp"),
            ("\"kick\"", "\"gong\"", "gong"),
            ("120", "0", "bpm"),
        ] {
            let text = SCORE.replace(from, to);
            let error = Score::read(&text).and_then(|s| s.parts().map(|_| ()));
            let message = format!("{:#}", error.expect_err(said));
            assert!(message.contains(said), "{message}");
        }
    }
}

//! Names of notes and chords.

use anyhow::{Context as _, Result, bail, ensure};

/// Chord: pitch classes of its tones from the root upwards, and the pitch class of its bass.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chord {
    root: f64,
    /// Semitones above the root, rising.
    tones: &'static [f64],
    bass: f64,
}

/// Kinds of chords and their tones in semitones above the root.
const KINDS: [(&str, &[f64]); 15] = [
    ("", &[0.0, 4.0, 7.0]),
    ("m", &[0.0, 3.0, 7.0]),
    ("7", &[0.0, 4.0, 7.0, 10.0]),
    ("maj7", &[0.0, 4.0, 7.0, 11.0]),
    ("m7", &[0.0, 3.0, 7.0, 10.0]),
    ("6", &[0.0, 4.0, 7.0, 9.0]),
    ("m6", &[0.0, 3.0, 7.0, 9.0]),
    ("sus2", &[0.0, 2.0, 7.0]),
    ("sus4", &[0.0, 5.0, 7.0]),
    ("7sus4", &[0.0, 5.0, 7.0, 10.0]),
    ("add9", &[0.0, 4.0, 7.0, 14.0]),
    ("madd9", &[0.0, 3.0, 7.0, 14.0]),
    ("maj9", &[0.0, 4.0, 7.0, 11.0, 14.0]),
    ("m9", &[0.0, 3.0, 7.0, 10.0, 14.0]),
    ("dim", &[0.0, 3.0, 6.0]),
];

/// Splits a name into a pitch class, 0 for C, and the rest.
fn class(name: &str) -> Result<(f64, &str)> {
    let mut rest = name.chars();
    let natural = match rest.next() {
        Some('C') => 0.0,
        Some('D') => 2.0,
        Some('E') => 4.0,
        Some('F') => 5.0,
        Some('G') => 7.0,
        Some('A') => 9.0,
        Some('B') => 11.0,
        _ => bail!("{name:?} is not a note"),
    };
    let after = rest.as_str();
    Ok(match after.as_bytes().first() {
        Some(b'#') => (natural + 1.0, &after[1..]),
        Some(b'b') => (natural - 1.0, &after[1..]),
        _ => (natural, after),
    })
}

/// Parses the MIDI number of a note such as `F#4`; C4 is 60.
///
/// # Errors
/// Returns an error if `name` is not a note.
pub(crate) fn pitch(name: &str) -> Result<f64> {
    let (class, octave) = class(name)?;
    let octave: i8 = octave
        .parse()
        .with_context(|| format!("{name:?} has no octave"))?;
    ensure!((0..=8).contains(&octave), "{name:?} is not from C0 to B8");
    Ok(12.0 * (f64::from(octave) + 1.0) + class)
}

/// Parses a chord such as `Am7` or `C/E`.
///
/// # Errors
/// Returns an error if `name` is not a chord.
pub(crate) fn chord(name: &str) -> Result<Chord> {
    let (above, below) = match name.split_once('/') {
        Some((above, below)) => (above, Some(below)),
        None => (name, None),
    };
    let (root, kind) = class(above)?;
    let (_, tones) = KINDS
        .iter()
        .find(|(name, _)| *name == kind)
        .with_context(|| format!("{name:?} is not a chord"))?;
    let bass = match below {
        Some(note) => class(note)?.0,
        None => root,
    };
    Ok(Chord { root, tones, bass })
}

/// Returns the lowest pitch of a pitch class that is not below `low`.
fn above(class: f64, low: f64) -> f64 {
    low + (class - low).rem_euclid(12.0)
}

impl Chord {
    /// Returns the bass note of the chord at or above `low`, as a pitch.
    pub(crate) fn bass(&self, low: f64) -> f64 {
        above(self.bass, low)
    }

    /// Returns its n-th tone counted from the root at or above `low`, from 1; higher degrees
    /// continue in the next octave.
    pub(crate) fn degree(&self, n: u32, low: f64) -> f64 {
        let n = n.max(1) as usize - 1;
        let octave = 12.0 * (n / self.tones.len()) as f64;
        above(self.root, low) + self.tones[n % self.tones.len()] + octave
    }

    /// Returns all chord tones within the octave above `low`, ascending, so that voices move little
    /// from chord to chord.
    pub(crate) fn close(&self, low: f64) -> Vec<f64> {
        let mut all: Vec<f64> = self
            .tones
            .iter()
            .map(|t| above(self.root + t, low))
            .collect();
        all.sort_by(f64::total_cmp);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_and_chords_have_their_pitches() {
        assert_eq!(pitch("A4").expect("a note"), 69.0);
        assert_eq!(pitch("Bb3").expect("a note"), 58.0);
        let am = chord("Am7/G").expect("a chord");
        assert_eq!(am.bass(28.0), 31.0);
        assert_eq!(
            [1, 2, 3, 4, 5].map(|n| am.degree(n, 57.0)),
            [57.0, 60.0, 64.0, 67.0, 69.0]
        );
        assert_eq!(am.close(60.0), [60.0, 64.0, 67.0, 69.0]);
        for bad in ["H", "Am77", "", "c"] {
            assert!(chord(bad).is_err(), "{bad}");
        }
    }
}

//! Music piece as its voices and its play times.

use raconteur_eml::ControlSource;

/// Stem of a piece of music: one of the files that play together, with its share over time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MusicStem {
    pub(crate) file: String,
    pub(crate) library: bool,
    /// True if it repeats.
    pub(crate) loops: bool,
    /// Level relative to the piece at story times, by time, linear between them; empty: 1.
    pub(crate) share: Vec<(f64, f64)>,
}

/// Music that plays from a time on: stems, volume and fade.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MusicClause {
    pub(crate) start_secs: f64,
    /// Source of control from then on.
    pub(crate) by: ControlSource,
    /// Stems; empty for silence.
    pub(crate) voices: Vec<MusicStem>,
    pub(crate) volume: f64,
    pub(crate) fade_secs: f64,
}

impl MusicClause {
    /// Creates a clause that fades the music to silence.
    pub(crate) fn silence(start_secs: f64, fade_secs: f64) -> Self {
        Self {
            start_secs,
            by: ControlSource::Emotion,
            voices: Vec::new(),
            volume: 1.0,
            fade_secs,
        }
    }
}

//! Notes.

/// Note of a track: start and length in seconds, pitch as a MIDI number, and velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Note {
    /// Seconds from the start.
    pub(crate) start_secs: f64,
    /// Duration for which it is held, seconds.
    pub(crate) length_secs: f64,
    /// MIDI number; meaningless for drums.
    pub(crate) pitch: f64,
    /// Loudness, 1 for a plain note.
    pub(crate) velocity: f64,
}

//! Output of espeak-ng: audio and its events.

/// Type of an event that espeak-ng reports with the audio.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A word begins, at this character of the text, counted from 1.
    Word(usize),
    /// A phone begins: its mnemonic, with marks of stress.
    Phone(String),
    /// A sentence or a clause ends.
    End,
}

/// Event that espeak-ng reports at a position of the audio.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// Samples from the start.
    pub sample: usize,
    /// Type of the event.
    pub what: EventKind,
}

/// Speech synthesised by espeak-ng, with its events.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Synthesis {
    /// Mono samples.
    pub samples: Vec<i16>,
    /// Sample rate, Hz.
    pub rate_hz: u32,
    /// Events in the order of the library.
    pub events: Vec<Event>,
    /// The mnemonics of the phones as they were before they met their neighbours, with
    /// marks of stress, which events do not have.
    pub marked: Vec<String>,
}

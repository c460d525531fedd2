//! What espeak-ng gives: a sound, and what happens in it.

/// What happens at a moment of the sound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A word begins, at this character of the text, counted from 1.
    Word(usize),
    /// A phone begins: its mnemonic, with marks of stress.
    Phone(String),
    /// A sentence or a clause ends.
    End,
}

/// A moment of the sound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// Samples from the start.
    pub sample: usize,
    /// What happens then.
    pub what: EventKind,
}

/// What was said.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Synthesis {
    /// Mono.
    pub samples: Vec<i16>,
    /// Samples a second.
    pub rate_hz: u32,
    /// In the order in which the library tells.
    pub events: Vec<Event>,
    /// The mnemonics of the phones as they were before they met their neighbours, with
    /// marks of stress, which events do not have.
    pub marked: Vec<String>,
}

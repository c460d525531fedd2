//! Files of the annotation tool ANVIL: tracks of elements with attributes, and the specifications
//! that declare them.

mod from_transcription;
mod read;
mod specification;
mod spread;
mod subdivisions;
mod to_transcription;
mod write;

use raconteur_eml::{Diagnostic, Span};

use crate::gestura::{Interval, Setting};
use crate::xml::Text;

pub use from_transcription::from_transcription;
pub use read::read;
pub use specification::{GESTURA, Specification, check};
pub use to_transcription::to_transcription;
pub use write::write;

/// Annotation file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Annotation {
    /// Path of the specification.
    pub specification: Option<String>,
    /// Recordings.
    pub media: Vec<Media>,
    /// Notes about the file.
    pub info: Vec<Info>,
    /// Tracks in the order of the file.
    pub tracks: Vec<Track>,
}

/// Recording of an annotation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Media {
    /// Kind of the recording: `video` or `audio`.
    pub kind: String,
    /// Path or address.
    pub source: String,
    /// True if the others follow its time.
    pub is_master: bool,
}

/// Note about an annotation file, such as its coder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Info {
    /// Name of the note.
    pub key: String,
    /// Type of the value, such as `String`.
    pub kind: String,
    /// Text of the note.
    pub text: String,
}

/// Track: elements of one type.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// Groups and name, joined by points.
    pub name: String,
    /// Relation of its elements to time.
    pub kind: TrackKind,
    /// Elements in the order of the file.
    pub elements: Vec<TrackElement>,
    /// Place in the file.
    pub span: Span,
}

/// Relation of the elements of a track to time.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum TrackKind {
    /// Elements have start and end times.
    #[default]
    Primary,
    /// Elements cover runs of elements of another track.
    Span(String),
    /// Elements coincide with single elements of another track.
    Singleton(String),
    /// Elements have times inside an element of another track.
    Subdivision(String),
    /// Without elements that matter here: `waveform`, `set` and so on.
    Other(String),
}

impl TrackKind {
    /// Returns the track that the elements refer to.
    #[must_use]
    pub fn reference(&self) -> Option<&str> {
        match self {
            Self::Span(name) | Self::Singleton(name) | Self::Subdivision(name) => Some(name),
            Self::Primary | Self::Other(_) => None,
        }
    }

    /// Returns the name of the kind in files.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Primary => "primary",
            Self::Span(_) => "span",
            Self::Singleton(_) => "singleton",
            Self::Subdivision(_) => "subdivision",
            Self::Other(kind) => kind,
        }
    }
}

/// Element of a track.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrackElement {
    /// Number by which other tracks refer to it.
    pub index: usize,
    /// Time span, directly or by reference.
    pub extent: Extent,
    /// Attributes in the order of the file.
    pub attributes: Vec<(String, Text)>,
    /// Remark of the coder.
    pub comment: Option<String>,
    /// Place in the file.
    pub span: Span,
}

/// Extent of an element in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// Start and end.
    Times(Interval),
    /// Numbers of the first and last element covered in the referenced track.
    Elements(usize, usize),
}

impl Default for Extent {
    fn default() -> Self {
        Self::Elements(0, 0)
    }
}

impl TrackElement {
    /// Returns an attribute by name, case-insensitively.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Text> {
        let mut attributes = self.attributes.iter();
        Some(&attributes.find(|(n, _)| n.eq_ignore_ascii_case(name))?.1)
    }

    /// Returns the text of an attribute; `None` if it is absent or empty.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<String> {
        let text = self.attribute(name)?;
        (!text.value.is_empty()).then(|| text.value.clone())
    }
}

impl Annotation {
    /// Returns the settings among the notes of the file: those whose key has a point.
    pub(super) fn settings(&self) -> Vec<Setting> {
        let setting = |info: &Info| {
            let (element, attribute) = info.key.split_once('.')?;
            Some(Setting {
                element: element.to_owned(),
                attribute: attribute.to_owned(),
                value: info.text.clone(),
            })
        };
        self.info.iter().filter_map(setting).collect()
    }

    /// Reports remarks of the coder, which a transcription does not have.
    pub(crate) fn check_remarks(&self, problems: &mut Vec<Diagnostic>) {
        let elements = self.tracks.iter().flat_map(|track| &track.elements);
        let mut remarks = elements.filter(|element| element.comment.is_some());
        if let Some(first) = remarks.next() {
            let message = match remarks.count() {
                0 => "the remark on this element is not read".to_owned(),
                more => format!("the remarks on this element and {more} others are not read"),
            };
            let problem = Diagnostic::warning("anvil::remarks", first.span, message);
            problems.push(problem);
        }
    }

    /// Returns a track by its name, case-insensitively.
    #[must_use]
    pub fn track(&self, name: &str) -> Option<&Track> {
        let mut tracks = self.tracks.iter();
        tracks.find(|track| track.name.eq_ignore_ascii_case(name))
    }
}

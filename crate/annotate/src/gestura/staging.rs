//! Prosody of words (C.3.1), and events on stage: emotions, camera, light, music (an addition to
//! GestuRA, in the terms of EML).

use std::ops::RangeInclusive;

use raconteur_eml::Span;

use super::Interval;

/// Attributes of an element of EML, in the order of the file.
pub type Attributes = Vec<(String, String)>;

/// Manner in which words are spoken: a container of EML's spoken text around them, or, of elements
/// without content such as `break`, before the first of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Prosody {
    /// Element of EML, such as `emph` or `speaker`.
    pub element: String,
    /// Attributes of the element.
    pub attributes: Attributes,
    /// Indices of the words.
    pub words: RangeInclusive<usize>,
    /// Place in the file.
    pub span: Span,
}

/// Event on stage: a clause of EML.
#[derive(Clone, Debug, PartialEq)]
pub struct Staging {
    /// Element of EML, such as `emotion` or `camera`.
    pub element: String,
    /// Attributes of the element; without `duration`, an element that has one lasts as long as the
    /// interval.
    pub attributes: Attributes,
    /// Time span; only its start matters to elements without a duration.
    pub interval: Interval,
    /// Place in the file.
    pub span: Span,
}

/// Setting of the whole performance: an attribute of an element in EML's head, or of `eml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Element: `performer`, `environment` or `eml`.
    pub element: String,
    /// Attribute.
    pub attribute: String,
    /// Value.
    pub value: String,
}

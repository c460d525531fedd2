//! Files of the annotation tool ELAN (EAF 2.x and 3.x): tiers of annotations between time slots, or
//! below the annotations of other tiers.

mod guess;
mod mapping;
mod read;

use raconteur_eml::Span;

use crate::gestura::Interval;
use crate::xml::Text;

pub use guess::guess;
pub use mapping::{Mapping, to_annotation};
pub use read::read;

/// Annotation file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Elan {
    /// Recordings, the leading one first.
    pub media: Vec<String>,
    /// Author of the file.
    pub author: Option<String>,
    /// Tiers in the order of the file.
    pub tiers: Vec<Tier>,
}

/// Tier of an annotation file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tier {
    /// Name.
    pub name: String,
    /// Tier to whose annotations its own belong.
    pub parent: Option<String>,
    /// Annotations in the order of time.
    pub annotations: Vec<Annotation>,
    /// Place in the file.
    pub span: Span,
}

/// Annotation of a tier.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Annotation {
    /// Time span.
    pub interval: Interval,
    /// Value.
    pub value: Text,
    /// Place in the file.
    pub span: Span,
}

//! Faces as numbers: a morphable model (F&H 3.2 and 5.1).
//!
//! Does: spaces of shape and texture over faces that correspond, attributes learned from labels, and
//! constraints that hold them; ratings of people that such labels come from; segments and how they are
//! blended; a file for all of it.
//! Does not: make examples (`sculpt` does), draw, or know of pages.

mod attribute;
#[cfg(target_arch = "wasm32")]
mod bindings;
mod blend;
mod edit;
mod error;
mod feature;
#[cfg(any(test, target_arch = "wasm32"))]
mod lately;
mod life;
mod lips;
mod pack;
mod person;
mod rating;
#[cfg(test)]
mod sample;
mod segment;
mod space;
mod untangle;

pub use attribute::Attribute;
pub use blend::{Neighbours, SoftMask};
#[cfg(feature = "learn")]
pub use edit::FeatureMeasure;
pub use edit::{Affine, Change, Constraint, Editor, Face, Part, Region, USUAL_DETAIL};
pub use error::FaceError;
pub use feature::Feature;
pub use life::Life;
pub use pack::{
    FaceModel, Factors, Follower, LookNumber, MOST_BYTES, MOST_MODES, NamedAttribute, TextureModel,
};
pub use person::Personal;
pub use rating::{Agreement, AttributeRatings, RatingError, Ratings};
pub use segment::{Half, Segment, Segments};
pub use space::FaceSpace;

//! Faces as numbers: a morphable model (F&H 3.2 and 5.1).
//!
//! Scope: spaces of shape and texture over corresponding faces, attributes learned from labels, and
//! their constraints; people's ratings as the source of such labels; segments and their blending; a
//! file for all of it.
//! Out of scope: example generation (`sculpt`), rendering, and web pages.

mod age_model;
mod attribute;
#[cfg(target_arch = "wasm32")]
mod bindings;
mod blend;
#[cfg(any(test, target_arch = "wasm32"))]
mod change_cache;
mod edit;
mod error;
mod feature;
mod lips;
mod order_constraints;
mod pack;
mod person;
mod rating;
#[cfg(test)]
mod sample;
mod segment;
mod space;
mod vertex_lists;

pub use age_model::AgeModel;
pub use attribute::Attribute;
pub use blend::{SoftMask, VertexNeighbours};
#[cfg(feature = "learn")]
pub use edit::FeatureMeasure;
pub use edit::{Affine, Change, Constraint, Editor, Face, Part, Region, USUAL_DETAIL};
pub use error::FaceError;
pub use feature::Feature;
pub use pack::{
    DependentNumbers, FaceModel, Factors, LookNumber, MAX_BYTES, MAX_MODES, NamedAttribute,
    TextureModel,
};
pub use person::PersonRecord;
pub use rating::{Agreement, AttributeRatings, RatingError, Ratings};
pub use segment::{Half, Segment, Segments};
pub use space::FaceSpace;

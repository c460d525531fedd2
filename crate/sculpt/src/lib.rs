//! Figure generator, based on anthropometry.
//!
//! Each region (head, hands, body, clothes, hair) yields [`part::MeshPart`]s in metres, engine
//! frame, bind pose; [`assemble`] joins them on one skeleton and [`write`] stores glTF.

pub mod assemble;
mod atlas;
pub mod bones;
mod build;
mod built;
mod cells;
pub mod cloth;
pub mod crossing;
pub mod examples;
pub mod hair;
pub mod hand;
pub mod head;
pub mod labels;
mod least_squares;
mod lend;
mod levels;
pub mod looks;
mod mannequin;
pub mod measure;
pub mod model;
pub mod part;
pub mod people;
pub mod person;
pub mod physique;
pub mod population;
mod posed;
pub mod reference_face;
pub mod rigging;
pub mod scan;
mod similarity;
pub mod skin;
pub mod solid;
mod springs;
pub mod statistics;
pub mod subdivide;
mod surface;
#[cfg(test)]
mod tests;
mod texture;
pub(crate) mod tissue;
pub mod torso;

pub use build::{build, build_face};
pub use built::AnnotatedFigure;
pub use lend::lender;
pub use people::FigureParams;
pub use person::Person;

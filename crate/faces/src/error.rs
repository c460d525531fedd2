//! Errors of creating or using a face model.

/// Error returned when a face model cannot be created or used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FaceError {
    /// Too few examples to learn a face space.
    #[error("a face space needs at least two examples, and there are {found}")]
    TooFew {
        /// Number found.
        found: usize,
    },
    /// An example has another length than the first.
    #[error("example {example} has {found} numbers, the first has {expected}")]
    Correspondence {
        /// Index of the example.
        example: usize,
        /// Numbers it has.
        found: usize,
        /// Numbers it should have.
        expected: usize,
    },
    /// A number of an example is not finite.
    #[error("example {example} holds a number that is not finite")]
    NotFinite {
        /// Index of the example.
        example: usize,
    },
    /// Labels do not belong to the examples.
    #[error("{name} has {found} labels for {expected} examples")]
    Labels {
        /// The attribute.
        name: String,
        /// Number of labels.
        found: usize,
        /// Number of examples.
        expected: usize,
    },
    /// All labels are equal and define no direction.
    #[error("the labels of {name} are all the same, or the faces do not differ with them")]
    NoDirection {
        /// The attribute.
        name: String,
    },
    /// No face meets the constraints.
    #[error("no face holds {name} at {value:.2} together with the constraints before it")]
    Contradiction {
        /// Name of the constraint that conflicts with others.
        name: String,
        /// Value required by the constraint.
        value: f64,
    },
    /// A file is no pack of faces, or not one that can be read.
    #[error("the pack of faces cannot be read: {why}")]
    BadPack {
        /// Description of the problem.
        why: String,
    },
    /// The attribute does not exist.
    #[error("there is no attribute {name} here")]
    NoAttribute {
        /// Requested name.
        name: String,
    },
    /// The segment does not exist.
    #[error("there is no segment {name}")]
    NoSegment {
        /// Requested name.
        name: String,
    },
    /// The database has no such face.
    #[error("there is no face {index} in a database of {count}")]
    NoExample {
        /// Requested index.
        index: usize,
        /// Number of faces available.
        count: usize,
    },
    /// The part for texture was not read.
    #[error("this pack has shapes alone, and no textures")]
    NoTexture,
}

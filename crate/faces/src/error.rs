//! Why a face model could not be made or used.

/// Why a face model could not be made or used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FaceError {
    /// There were too few examples.
    #[error("a face space needs at least two examples, and there are {found}")]
    TooFew {
        /// How many there were.
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
        /// How many labels there are.
        found: usize,
        /// How many examples.
        expected: usize,
    },
    /// Labels that do not differ say nothing.
    #[error("the labels of {name} are all the same, or the faces do not differ with them")]
    NoDirection {
        /// The attribute.
        name: String,
    },
    /// Constraints that no face meets.
    #[error("no face holds {name} at {value:.2} together with the constraints before it")]
    Contradiction {
        /// The constraint that contradicts others.
        name: String,
        /// What it was to be held at.
        value: f64,
    },
    /// A file is no pack of faces, or not one that can be read.
    #[error("the pack of faces cannot be read: {why}")]
    BadPack {
        /// What is wrong with it.
        why: String,
    },
    /// There is no such attribute.
    #[error("there is no attribute {name} here")]
    NoAttribute {
        /// What was asked for.
        name: String,
    },
    /// There is no such segment.
    #[error("there is no segment {name}")]
    NoSegment {
        /// What was asked for.
        name: String,
    },
    /// The database has no such face.
    #[error("there is no face {index} in a database of {count}")]
    NoExample {
        /// What was asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// The part for texture was not read.
    #[error("this pack has shapes alone, and no textures")]
    NoTexture,
}

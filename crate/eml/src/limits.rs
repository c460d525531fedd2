//! Limits on the cost of a document.

/// Limits on the size and processing cost of a document, against hostile input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Length of the source in bytes; longer ones are refused. Default 16 MiB.
    pub bytes: usize,
    /// Nesting of elements; deeper ones are dropped. Default 64, at most 256.
    pub depth: usize,
    /// Clauses in the document; later ones are dropped. Default 200 000.
    pub clauses: usize,
    /// Clauses in the timeline, each repetition counted; groups whose repetitions go
    /// beyond play once. A document with more clauses than that plays all of them once.
    /// Default 200 000.
    pub timed_clauses: usize,
    /// Maximum number of words spoken by one clause; later ones are not spoken. Default 20 000:
    /// more than two hours.
    pub clause_words: usize,
    /// Maximum number of words spoken by the whole document; later ones are not spoken. Default 200
    /// 000: a long novel, a day and a night of speech.
    pub words: usize,
    /// Attributes an element; later ones are ignored. Default 64.
    pub attributes: usize,
    /// Diagnostics, of one kind at most [`crate::MAX_PER_KIND`]; the rest is counted. Default
    /// 200.
    pub diagnostics: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            bytes: 16 << 20,
            depth: 64,
            clauses: 200_000,
            timed_clauses: 200_000,
            clause_words: 20_000,
            words: 200_000,
            attributes: 64,
            diagnostics: 200,
        }
    }
}

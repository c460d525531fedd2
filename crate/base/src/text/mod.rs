//! How written language is parted: words and the signs around them, abbreviations, capitals,
//! numerals, and where sentences end.
//!
//! Whoever reads a text asks here (the baker, the captions, scripts made of plain text), so that
//! the same text has the same words and sentences wherever it comes from.

pub mod abbreviation;
pub mod capitals;
mod capitals_lists;
pub mod language;
pub mod months;
pub mod roman;
pub mod script;
pub mod sentence;
pub mod signs;
pub mod starters;
pub mod word;

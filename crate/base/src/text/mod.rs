//! Segmentation of written language: words and adjacent signs, abbreviations, capitals, numerals,
//! and sentence ends.
//!
//! All readers of text (the baker, the captions, scripts made of plain text) use this module, so
//! that the same text has the same words and sentences everywhere.

pub mod abbreviation;
pub mod capitals;
mod capitals_lists;
pub mod function_words;
pub mod language;
pub mod months;
pub mod quotes;
pub mod roman;
pub mod script;
pub mod sentence;
pub mod signs;
pub mod starters;
pub mod word;

//! SABLE 0.2 and 1.0.

mod read;
mod write;

pub use read::read;
pub use write::write;

use crate::content::{Age, Gender};
use crate::text::{Order, SayAs};

/// SABLE's words for ages.
const AGES: [(&str, Age); 5] = [
    ("older", Age::Older),
    ("middle", Age::Middle),
    ("younger", Age::Younger),
    ("teen", Age::Teen),
    ("child", Age::Child),
];

/// SABLE's words for sexes.
const GENDERS: [(&str, Gender); 2] = [("male", Gender::Male), ("female", Gender::Female)];

/// MODETYPE of dates.
pub(in crate::markup) const ORDERS: [(&str, Order); 6] = [
    ("dmy", Order::Dmy),
    ("mdy", Order::Mdy),
    ("ymd", Order::Ymd),
    ("ym", Order::Ym),
    ("my", Order::My),
    ("md", Order::Md),
];

/// MODE values of SAYAS with the meaning without a MODETYPE.
const MODES: [(&str, SayAs); 13] = [
    ("literal", SayAs::Literal),
    ("date", SayAs::Date(None)),
    ("time", SayAs::Time),
    ("phone", SayAs::Phone),
    ("net", SayAs::Net { email: false }),
    ("postal", SayAs::Postal),
    ("currency", SayAs::Currency),
    ("math", SayAs::Math),
    ("fraction", SayAs::Fraction),
    ("measure", SayAs::Measure),
    ("ordinal", SayAs::Ordinal),
    ("cardinal", SayAs::Cardinal),
    ("name", SayAs::Name),
];

/// Looks up a word, in any case.
pub(in crate::markup) fn of_word<T: Copy>(table: &[(&str, T)], word: &str) -> Option<T> {
    let found = table
        .iter()
        .find(|(w, _)| w.eq_ignore_ascii_case(word.trim()));
    found.map(|(_, value)| *value)
}

/// Returns the word for a value in a table; `None` if there is none.
pub(in crate::markup) fn word_of<T: PartialEq>(
    table: &[(&'static str, T)],
    value: &T,
) -> Option<&'static str> {
    table
        .iter()
        .find(|(_, v)| v == value)
        .map(|(word, _)| *word)
}

//! SSML 1.1 (W3C Recommendation of 7 September 2010).

mod prosody;
mod read;
mod sampa;
mod write;

pub use read::{read, read_beside};
pub use write::write;

use crate::content::{Age, Gender};
use crate::text::SayAs;

/// Age in years written for an age group, and the upper bound for reading it.
const AGES: [(Age, f64, f64); 5] = [
    (Age::Child, 8.0, 13.0),
    (Age::Teen, 15.0, 20.0),
    (Age::Younger, 25.0, 35.0),
    (Age::Middle, 45.0, 60.0),
    (Age::Older, 70.0, f64::INFINITY),
];

/// SSML genders; `neutral` is none.
const GENDERS: [(&str, Option<Gender>); 3] = [
    ("male", Some(Gender::Male)),
    ("female", Some(Gender::Female)),
    ("neutral", None),
];

/// Values of `interpret-as`. SSML leaves them open; those of the W3C's note of 2005 come first
/// where it has one, then those known by engines. The first of a kind is written.
const KINDS: [(&str, SayAs); 23] = [
    ("characters", SayAs::Literal),
    ("spell-out", SayAs::Literal),
    ("verbatim", SayAs::Literal),
    ("digits", SayAs::Literal),
    ("date", SayAs::Date(None)),
    ("time", SayAs::Time),
    ("telephone", SayAs::Phone),
    ("phone", SayAs::Phone),
    ("net", SayAs::Net { email: false }),
    ("url", SayAs::Net { email: false }),
    ("uri", SayAs::Net { email: false }),
    ("email", SayAs::Net { email: true }),
    ("address", SayAs::Postal),
    ("postal", SayAs::Postal),
    ("currency", SayAs::Currency),
    ("math", SayAs::Math),
    ("fraction", SayAs::Fraction),
    ("measure", SayAs::Measure),
    ("unit", SayAs::Measure),
    ("ordinal", SayAs::Ordinal),
    ("cardinal", SayAs::Cardinal),
    ("number", SayAs::Cardinal),
    ("name", SayAs::Name),
];

//! Grammar of each language.

use super::english::English;
use super::german::German;
use super::grammar::{Grammar, Grammars};
use super::language::Language;
use super::portuguese::Portuguese;

impl Grammars for Language {
    fn grammar(self) -> &'static dyn Grammar {
        match self {
            Self::English => &English,
            Self::German => &German,
            Self::Portuguese => &Portuguese,
        }
    }
}

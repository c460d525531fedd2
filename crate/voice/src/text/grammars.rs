//! Which grammar a language has.

use super::english::English;
use super::german::German;
use super::grammar::Grammar;
use super::language::Language;
use super::portuguese::Portuguese;

impl Language {
    /// The grammar of the language.
    pub(super) fn grammar(self) -> &'static dyn Grammar {
        match self {
            Self::English => &English,
            Self::German => &German,
            Self::Portuguese => &Portuguese,
        }
    }
}

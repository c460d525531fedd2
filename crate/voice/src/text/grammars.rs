//! Which grammar a language has.

use super::english::English;
use super::german::German;
use super::grammar::Grammar;
use super::language::Language;
use super::portuguese::Portuguese;

/// What has a grammar.
pub(super) trait Grammars {
    /// The grammar of the language.
    fn grammar(self) -> &'static dyn Grammar;
}

impl Grammars for Language {
    fn grammar(self) -> &'static dyn Grammar {
        match self {
            Self::English => &English,
            Self::German => &German,
            Self::Portuguese => &Portuguese,
        }
    }
}

//! Closed lists of words, as annotation tools offer them.

/// Closed list of words of an annotation.
pub trait Vocabulary: Copy + PartialEq + Sized + 'static {
    /// All values with their words.
    const WORDS: &'static [(Self, &'static str)];

    /// Returns the word of the value.
    #[must_use]
    fn word(self) -> &'static str {
        let mut words = Self::WORDS.iter();
        words
            .find(|(value, _)| *value == self)
            .map_or("", |(_, word)| word)
    }

    /// Returns the value of a word. Case, spaces and signs do not count.
    #[must_use]
    fn from_word(text: &str) -> Option<Self> {
        let text = letters(text);
        let mut words = Self::WORDS.iter();
        words
            .find(|(_, word)| letters(word) == text)
            .map(|(value, _)| *value)
    }

    /// Returns the words as a list for a message.
    #[must_use]
    fn list() -> String {
        let words: Vec<&str> = Self::WORDS.iter().map(|(_, word)| *word).collect();
        words.join(", ")
    }
}

/// Returns the letters and digits of a text in lower case.
pub(crate) fn letters(text: &str) -> String {
    text.chars()
        .filter(|c| c.is_alphanumeric())
        .flat_map(char::to_lowercase)
        .collect()
}

macro_rules! vocabulary {
    ($(#[$doc:meta])* $name:ident { $($(#[$value_doc:meta])* $value:ident = $word:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum $name {
            $($(#[$value_doc])* $value,)*
        }

        impl $crate::gestura::Vocabulary for $name {
            const WORDS: &'static [(Self, &'static str)] = &[$((Self::$value, $word),)*];
        }
    };
}
pub(crate) use vocabulary;

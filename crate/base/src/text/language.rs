//! Languages with rules for numbers, dates and signs.

/// Language whose numbers, dates and signs can be read aloud. Variants are in the order of the
/// columns in all word tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// English.
    English,
    /// German.
    German,
    /// Portuguese of Portugal.
    Portuguese,
}

impl Language {
    /// Returns the language of a BCP 47 tag by its primary subtag (RFC 5646); `None` if it is not
    /// supported.
    #[must_use]
    pub fn from_tag(tag: &str) -> Option<Self> {
        let primary = tag.split(['-', '_']).next().unwrap_or_default();
        match primary.to_ascii_lowercase().as_str() {
            "en" => Some(Self::English),
            "de" => Some(Self::German),
            "pt" => Some(Self::Portuguese),
            _ => None,
        }
    }

    /// Returns the column of this language from a table row `[English, German, Portuguese]`.
    #[must_use]
    pub fn pick<T: Copy>(self, row: [T; 3]) -> T {
        row[self as usize]
    }

    /// Returns the word spoken for the decimal sign in a number: "comma" for `,`, otherwise
    /// "point", in this language.
    #[must_use]
    pub fn decimal_word(self, sign: char) -> &'static str {
        match sign {
            ',' => self.pick(["comma", "Komma", "vírgula"]),
            _ => self.pick(["point", "Punkt", "ponto"]),
        }
    }

    /// Returns the decimal sign of the language, `.` or `,`; the other one groups thousands.
    #[must_use]
    pub fn decimal_sign(self) -> char {
        self.pick(['.', ',', ','])
    }
}

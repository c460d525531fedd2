//! Languages with rules for numbers, dates and signs.

/// A language whose numbers, dates and signs are read here. The order is that of the
/// columns in every table of words.
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
    /// Decided by the primary subtag of a BCP 47 tag (RFC 5646).
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

    /// This language's column of a table row `[English, German, Portuguese]`.
    #[must_use]
    pub fn pick<T: Copy>(self, row: [T; 3]) -> T {
        row[self as usize]
    }

    /// The word for a decimal sign.
    #[must_use]
    pub fn decimal_word(self, sign: char) -> &'static str {
        match sign {
            ',' => self.pick(["comma", "Komma", "vírgula"]),
            _ => self.pick(["point", "Punkt", "ponto"]),
        }
    }

    /// The decimal sign of the language; the other one of `,` and `.` groups thousands.
    #[must_use]
    pub fn decimal_sign(self) -> char {
        self.pick(['.', ',', ','])
    }
}

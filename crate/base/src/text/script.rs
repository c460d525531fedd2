//! Scripts and their languages: a voice reads the scripts of its own language.

/// Script of writing (ISO 15924); decides which texts a voice can read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Script {
    /// Latin.
    Latin,
    /// Greek.
    Greek,
    /// Cyrillic.
    Cyrillic,
    /// Armenian.
    Armenian,
    /// Hebrew.
    Hebrew,
    /// Arabic.
    Arabic,
    /// Devanagari.
    Devanagari,
    /// Bengali.
    Bengali,
    /// Tamil.
    Tamil,
    /// Thai.
    Thai,
    /// Georgian.
    Georgian,
    /// Hangul.
    Hangul,
    /// Hiragana and katakana.
    Kana,
    /// Chinese characters.
    Han,
}

use Script::{
    Arabic, Armenian, Bengali, Cyrillic, Devanagari, Georgian, Greek, Han, Hangul, Hebrew, Kana,
    Latin, Tamil, Thai,
};

/// Scripts with their names, the language that is looked for first, and all that are written in
/// them (Chinese is looked for as Mandarin, `cmn`); every other language is written in Latin letters.
const SCRIPTS: [(Script, &str, &str, &str); 14] = [
    (Latin, "Latin letters", "en", ""),
    (Greek, "Greek letters", "el", "el"),
    (
        Cyrillic,
        "Cyrillic letters",
        "ru",
        "ru uk be bg mk sr kk ky mn tg tt",
    ),
    (Armenian, "Armenian letters", "hy", "hy hyw"),
    (Hebrew, "Hebrew letters", "he", "he iw yi"),
    (Arabic, "Arabic letters", "ar", "ar fa ur ps ug sd ckb"),
    (Devanagari, "Devanagari", "hi", "hi mr ne sa kok"),
    (Bengali, "Bengali letters", "bn", "bn as"),
    (Tamil, "Tamil letters", "ta", "ta"),
    (Thai, "Thai letters", "th", "th"),
    (Georgian, "Georgian letters", "ka", "ka"),
    (Hangul, "Hangul", "ko", "ko"),
    (Kana, "kana", "ja", "ja"),
    (Han, "Chinese characters", "cmn", "zh cmn yue hak ja ko"),
];

impl Script {
    /// Returns the script of a word: that of its letters, if there are at least two and all are of
    /// one script, or one that is a word on its own. `None` for digits, signs, single letters as in
    /// formulas, and mixtures with Latin letters.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        let mut letters = word.chars().filter(|c| c.is_alphabetic());
        let mut script = of_letter(letters.next()?)?;
        let mut count = 1;
        for letter in letters {
            let other = of_letter(letter)?;
            match (script, other) {
                (Han, Kana) => script = Kana,
                (Kana, Han) => {}
                _ if other != script => return None,
                _ => {}
            }
            count += 1;
        }
        (count > 1 || matches!(script, Latin | Han | Kana | Hangul)).then_some(script)
    }

    /// Returns the English name of the script, for messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        SCRIPTS[self as usize].1
    }

    /// Returns the default language for reading a word in the script when its own is unknown (ISO
    /// 639-1).
    #[must_use]
    pub fn language(self) -> &'static str {
        SCRIPTS[self as usize].2
    }

    /// Returns true if a language, given as a BCP 47 tag, is written in this script.
    #[must_use]
    pub fn is_read_in(self, tag: &str) -> bool {
        let primary = tag.split(['-', '_']).next().unwrap_or_default();
        let primary = primary.to_ascii_lowercase();
        let has = |languages: &str| languages.split(' ').any(|own| own == primary);
        match self {
            Latin => true,
            other => has(SCRIPTS[other as usize].3),
        }
    }
}

/// Returns the script of a letter; `None` for a letter of no listed script.
fn of_letter(c: char) -> Option<Script> {
    Some(match u32::from(c) {
        0x41..=0x24f | 0x1e00..=0x1eff | 0x2c60..=0x2c7f | 0xfb00..=0xfb06 | 0xff21..=0xff5a => {
            Latin
        }
        0x370..=0x3ff | 0x1f00..=0x1fff => Greek,
        0x400..=0x52f | 0x1c80..=0x1c8f => Cyrillic,
        0x531..=0x58f => Armenian,
        0x591..=0x5ff | 0xfb1d..=0xfb4f => Hebrew,
        0x600..=0x6ff | 0x750..=0x77f | 0x8a0..=0x8ff | 0xfb50..=0xfdff | 0xfe70..=0xfeff => Arabic,
        0x900..=0x97f => Devanagari,
        0x980..=0x9ff => Bengali,
        0xb80..=0xbff => Tamil,
        0xe01..=0xe5b => Thai,
        0x10a0..=0x10ff | 0x1c90..=0x1cbf => Georgian,
        0x1100..=0x11ff | 0x3130..=0x318f | 0xac00..=0xd7af => Hangul,
        0x3041..=0x30ff | 0x31f0..=0x31ff | 0xff66..=0xff9f => Kana,
        0x3005..=0x3007
        | 0x3400..=0x4dbf
        | 0x4e00..=0x9fff
        | 0xf900..=0xfaff
        | 0x20000..=0x323af => Han,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_the_script_of_their_letters() {
        for (word, script) in [
            ("wall.", Some(Latin)),
            ("שלום", Some(Hebrew)),
            ("مرحبا،", Some(Arabic)),
            ("你好，世界", Some(Han)),
            ("こんにちは", Some(Kana)),
            ("食べる", Some(Kana)),
            ("Привет!", Some(Cyrillic)),
            ("안녕", Some(Hangul)),
            ("π", None),
            ("μm", None),
            ("42", None),
            ("ﬁne", Some(Latin)),
            ("ＦＵＬＬ", Some(Latin)),
        ] {
            assert_eq!(Script::from_word(word), script, "{word}");
        }
        for (at, row) in SCRIPTS.iter().enumerate() {
            assert_eq!(row.0 as usize, at);
            assert!(
                row.0.is_read_in(row.2),
                "a word is read in the language of its script"
            );
        }
        assert!(
            !Hebrew.is_read_in("en-US") && Han.is_read_in("ja") && Latin.is_read_in("de"),
            "the scripts readable in each language"
        );
    }
}

//! Modes of SABLE's SAYAS. A word that does not fit its mode is read unmarked, so that "due on" in
//! a marked date is unchanged.

use super::grammar::{Form, Grammars as _};
use super::language::Language;
use super::number::Number;
use super::read::{Reader, Reading};
use super::word::Word;
use super::{Order, SayAs, date, roman, spelling};

/// Parts of addresses [English, German, Portuguese], written without the last full stop.
const STREETS: [&[(&str, &str)]; 3] = [
    &[
        ("St", "Street"),
        ("Rd", "Road"),
        ("Ave", "Avenue"),
        ("Dr", "Drive"),
        ("Blvd", "Boulevard"),
        ("Ln", "Lane"),
        ("Ct", "Court"),
        ("Sq", "Square"),
        ("Pl", "Place"),
        ("Apt", "Apartment"),
        ("N", "North"),
        ("S", "South"),
        ("E", "East"),
        ("W", "West"),
        ("PO", "pee oh"),
    ],
    &[
        ("Str", "Straße"),
        ("str", "straße"),
        ("Pl", "Platz"),
        ("St", "Sankt"),
        ("Nr", "Nummer"),
    ],
    &[
        ("R", "Rua"),
        ("Av", "Avenida"),
        ("Pç", "Praça"),
        ("Pr", "Praça"),
        ("Lg", "Largo"),
        ("Tv", "Travessa"),
        ("Dto", "direito"),
        ("Esq", "esquerdo"),
        ("Apt", "apartado"),
    ],
];

impl Reader<'_> {
    /// Reads the word at `at` in `mode`, where it fits.
    pub(super) fn read_as(&self, mode: &SayAs, at: usize, word: &Word<'_>) -> Option<Reading> {
        let language = self.language;
        match mode {
            SayAs::Literal => {
                // The signs are read, so they are no punctuation too; a comma parts words.
                let comma = if at + 1 < self.words.len() { "," } else { "" };
                let spoken = spelling::literal(&word.raw, language) + comma;
                Some(Reading::one(spoken))
            }
            SayAs::Date(order) => self.marked_date(at, word, *order),
            SayAs::Time => self.time(at, word),
            SayAs::Phone => {
                let digits = word.core.contains(|c: char| c.is_ascii_digit());
                let comma = if at + 1 < self.words.len() && word.end.is_empty() {
                    ","
                } else {
                    ""
                };
                digits.then(|| Reading::one(spelling::phone(&word.core, language) + comma))
            }
            SayAs::Net { email } => {
                let address =
                    spelling::is_net(&word.core) || *email || word.core.contains(['.', '/', '@']);
                let said =
                    word.core.contains(|c: char| !c.is_alphabetic()) || self.words.len() == 1;
                (address && said).then(|| Reading::one(spelling::net(&word.core, language)))
            }
            SayAs::Postal => self.postal(word),
            SayAs::Currency => self.money(at, word),
            SayAs::Math => {
                let formula = word.raw.trim_end_matches(['.', ',', ';', ':', '?']);
                Some(Reading::one(self.runs(formula, true)))
            }
            SayAs::Fraction => self.fraction(at, word),
            SayAs::Measure => self.measure(at, word),
            SayAs::Ordinal => {
                let n = self.counted(word)?;
                let grammar = language.grammar();
                let before = at.checked_sub(1).map_or("", |at| self.previous(at));
                let ending = match word.core.chars().next_back() {
                    Some('ª') => "a",
                    Some('º') => "o",
                    _ => match (language, self.previous(at), self.next_after_stop(at)) {
                        // Without context, the dictionary form applies.
                        (Language::German, "", "") => "e",
                        (_, previous, next) => grammar.ending(before, previous, next),
                    },
                };
                let last = at + 1 == self.words.len();
                Some(
                    Reading::one(grammar.ordinal(n, ending))
                        .owning_stop(last && language != Language::German),
                )
            }
            SayAs::Cardinal => {
                if let Some(n) = roman::value(&word.core) {
                    return Some(Reading::one(language.grammar().cardinal(n, Form::Alone)));
                }
                let number = Number::parse(&word.core, language)?;
                Some(Reading::one(number.cardinal(language, Form::Alone)))
            }
            SayAs::Name => {
                let n = roman::value(&word.core).filter(|_| at > 0)?;
                // A single letter in a name is an initial, but "Karl V." and "Napoleon I".
                let single = word.core.len() == 1 && !matches!(word.core.as_str(), "I" | "V" | "X");
                let last = at + 1 == self.words.len() || !self.words[at + 1].is_capital();
                (!single && last).then(|| {
                    let stop = language != Language::German || at + 1 == self.words.len();
                    Reading::one(roman::ruler(n, self.previous(at), language)).owning_stop(stop)
                })
            }
        }
    }

    /// Returns the number in "3", "3rd", "3.", "3.º" or "III"; `None` for other words.
    fn counted(&self, word: &Word<'_>) -> Option<u64> {
        if let Some(n) = roman::value(&word.core) {
            return Some(n);
        }
        let digits = word
            .core
            .trim_end_matches(|c: char| c.is_alphabetic() || c == '.');
        Number::parse(digits, self.language)?.natural()
    }

    /// Reads a date in one word, or in two or three words of digits.
    fn marked_date(&self, at: usize, word: &Word<'_>, order: Option<Order>) -> Option<Reading> {
        // At most four words are looked at: a date has three.
        let parts: Vec<&str> = self.words.iter().take(4).map(|w| w.core.as_str()).collect();
        let digits = |part: &&str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if at == 0 && (2..=3).contains(&parts.len()) && parts.iter().all(digits) {
            let date = date::parse(&parts.join("-"), order, self.language, self.month_first)?;
            let mut spoken = vec![self.say_date(at, &date)];
            spoken.resize(parts.len(), String::new());
            return Some(Reading { spoken, ends: true });
        }
        if let Some(date) = date::parse(&word.core, order, self.language, self.month_first) {
            return Some(Reading::one(self.say_date(at, &date)));
        }
        let year = word
            .core
            .parse()
            .ok()
            .filter(|_| (3..=4).contains(&word.core.len()) && digits(&word.core.as_str()))?;
        Some(Reading::one(self.language.grammar().year(year)))
    }

    /// Reads a word of a postal address.
    fn postal(&self, word: &Word<'_>) -> Option<Reading> {
        let core = word.core.as_str();
        if let Some((_, said)) = STREETS[self.language as usize]
            .iter()
            .find(|(short, _)| *short == core)
        {
            return Some(Reading::one(*said).owning_stop(false));
        }
        if self.language == Language::German
            && word.dotted()
            && let Some(stem) = core.strip_suffix("str")
        {
            return Some(Reading::one(format!("{stem}straße")).owning_stop(false));
        }
        let digits = core.chars().filter(char::is_ascii_digit).count();
        let capital = core.chars().any(char::is_uppercase);
        // Codes: five digits or more, four in two parts, or letters with digits.
        if digits >= 4 || digits > 0 && capital && digits < core.len() {
            let letters = core
                .chars()
                .filter(|c| c.is_alphanumeric())
                .collect::<String>();
            let code = if capital { letters } else { core.to_owned() };
            return Some(Reading::one(match capital {
                true => spelling::literal(&code, self.language),
                false => spelling::phone(&code, self.language),
            }));
        }
        None
    }
}

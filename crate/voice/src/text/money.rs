//! Amounts of money: $3.50, 20 €, R$ 5, $3.5 million.

use super::grammar::Form;
use super::language::Language;
use super::number::{Number, cardinal_of_digits};

/// Currency: the singular and plural names of its unit and of its hundredth, in each language.
pub(super) struct Currency {
    signs: &'static [&'static str],
    unit: [[&'static str; 2]; 3],
    cent: [[&'static str; 2]; 3],
    /// Feminine in Portuguese.
    feminine: bool,
}

const CENTS: [[&str; 2]; 3] = [["cent", "cents"], ["Cent", "Cent"], ["cêntimo", "cêntimos"]];

const CURRENCIES: &[Currency] = &[
    Currency {
        signs: &["R$", "BRL"],
        unit: [["real", "reais"], ["Real", "Real"], ["real", "reais"]],
        cent: [
            ["centavo", "centavos"],
            ["Centavo", "Centavos"],
            ["centavo", "centavos"],
        ],
        feminine: false,
    },
    Currency {
        signs: &["US$", "$", "USD"],
        unit: [
            ["dollar", "dollars"],
            ["Dollar", "Dollar"],
            ["dólar", "dólares"],
        ],
        cent: CENTS,
        feminine: false,
    },
    Currency {
        signs: &["\u{20ac}", "EUR"],
        unit: [["euro", "euros"], ["Euro", "Euro"], ["euro", "euros"]],
        cent: CENTS,
        feminine: false,
    },
    Currency {
        signs: &["\u{a3}", "GBP"],
        unit: [["pound", "pounds"], ["Pfund", "Pfund"], ["libra", "libras"]],
        cent: [["penny", "pence"], ["Penny", "Pence"], ["péni", "pence"]],
        feminine: true,
    },
    Currency {
        signs: &["\u{a5}", "JPY"],
        unit: [["yen", "yen"], ["Yen", "Yen"], ["iene", "ienes"]],
        cent: [["sen", "sen"], ["Sen", "Sen"], ["sen", "sen"]],
        feminine: false,
    },
    Currency {
        signs: &["CHF"],
        unit: [
            ["franc", "francs"],
            ["Franken", "Franken"],
            ["franco", "francos"],
        ],
        cent: [
            ["centime", "centimes"],
            ["Rappen", "Rappen"],
            ["cêntimo", "cêntimos"],
        ],
        feminine: false,
    },
    Currency {
        signs: &["\u{20b9}", "INR"],
        unit: [
            ["rupee", "rupees"],
            ["Rupie", "Rupien"],
            ["rupia", "rupias"],
        ],
        cent: [["paisa", "paise"], ["Paisa", "Paise"], ["paisa", "paise"]],
        feminine: true,
    },
    Currency {
        signs: &["\u{a2}", "ct"],
        unit: CENTS,
        cent: CENTS,
        feminine: false,
    },
];
/// Words of magnitude between an amount and its currency, with the readings for one and for more if
/// abbreviated.
const MAGNITUDES: [&[(&str, [&str; 2])]; 3] = [
    &[
        ("thousand", ["thousand"; 2]),
        ("million", ["million"; 2]),
        ("billion", ["billion"; 2]),
        ("trillion", ["trillion"; 2]),
        ("bn", ["billion"; 2]),
    ],
    &[
        ("Mio", ["Million", "Millionen"]),
        ("Mrd", ["Milliarde", "Milliarden"]),
        ("Million", ["Million"; 2]),
        ("Millionen", ["Millionen"; 2]),
        ("Milliarde", ["Milliarde"; 2]),
        ("Milliarden", ["Milliarden"; 2]),
        ("Tsd", ["tausend"; 2]),
    ],
    &[
        ("mil", ["mil"; 2]),
        ("milhão", ["milhão de"; 2]),
        ("milhões", ["milhões de"; 2]),
        ("bilião", ["bilião de"; 2]),
        ("biliões", ["biliões de"; 2]),
    ],
];

/// Returns the currency with the sign `text`; `None` if there is none.
pub(super) fn currency(text: &str) -> Option<&'static Currency> {
    CURRENCIES
        .iter()
        .find(|currency| currency.signs.contains(&text))
}

/// Splits `text` into a currency and the rest, with the sign before or after; a minus may precede
/// the sign.
pub(super) fn split_currency(text: &str) -> Option<(&'static Currency, String)> {
    let (minus, body) = match text.strip_prefix(super::number::is_minus) {
        Some(body) => ("-", body),
        None => ("", text),
    };
    CURRENCIES.iter().find_map(|currency| {
        currency.signs.iter().find_map(|sign| {
            let rest = body
                .strip_prefix(sign)
                .or_else(|| body.strip_suffix(sign))?;
            let digits = rest.chars().any(|c| c.is_ascii_digit());
            digits.then(|| (currency, format!("{minus}{rest}")))
        })
    })
}

/// Parts the letters that English sets after an amount from it: 1.5bn, 3m, 20k.
pub(super) fn suffixed(text: &str, language: Language) -> Option<(&str, &'static str)> {
    let end = text.rfind(|c: char| c.is_ascii_digit())? + 1;
    let (amount, suffix) = text.split_at_checked(end)?;
    let magnitude = match suffix {
        "k" | "K" => "thousand",
        "m" | "M" | "mn" => "million",
        "b" | "bn" | "B" => "billion",
        "tn" => "trillion",
        _ => return None,
    };
    (language == Language::English).then_some((amount, magnitude))
}

/// Returns the reading of a magnitude after `number`.
pub(super) fn magnitude(word: &str, number: &Number, language: Language) -> Option<&'static str> {
    let row = MAGNITUDES[language as usize]
        .iter()
        .find(|(name, _)| *name == word)?;
    Some(row.1[usize::from(!number.is_one())])
}

impl Currency {
    /// Returns the singular (`one`) or plural name of the unit.
    pub(super) fn name(&self, one: bool, language: Language) -> &'static str {
        language.pick(self.unit)[usize::from(!one)]
    }

    /// Returns the form of numbers before the unit, by the gender of its name.
    pub(super) fn form(&self, language: Language) -> Form {
        match language {
            Language::Portuguese if self.feminine => Form::Feminine,
            _ => Form::Masculine,
        }
    }

    /// Returns an amount in words, with its unit and hundredths.
    pub(super) fn amount(&self, number: &Number, language: Language) -> String {
        let cents = match &number.decimals {
            Some((_, digits)) if digits.len() == 2 => digits.parse::<u64>().ok(),
            _ => None,
        };
        let Some(cents) = cents else {
            let count = number.cardinal(language, self.form(language));
            let round = number
                .natural()
                .is_some_and(|n| n > 0 && n.is_multiple_of(1_000_000));
            let of = if round && language == Language::Portuguese {
                "de "
            } else {
                ""
            };
            return format!("{count} {of}{}", self.name(number.is_one(), language));
        };
        let units = Number {
            decimals: None,
            ..number.clone()
        };
        let minor = language.pick(self.cent)[usize::from(cents != 1)];
        let count = cardinal_of_digits(&cents.to_string(), language, Form::Masculine);
        let nothing = units.whole.bytes().all(|b| b == b'0');
        match (nothing && !units.negative, cents) {
            (_, 0) => self.amount(&units, language),
            (true, _) => format!("{count} {minor}"),
            (false, _) => {
                let major = self.amount(&units, language);
                match language {
                    Language::English => format!("{major} and {count} {minor}"),
                    // "Drei Euro fünfzig": the hundredths are not named.
                    Language::German => {
                        format!(
                            "{major} {}",
                            cardinal_of_digits(&cents.to_string(), language, Form::Alone)
                        )
                    }
                    Language::Portuguese => format!("{major} e {count} {minor}"),
                }
            }
        }
    }
}

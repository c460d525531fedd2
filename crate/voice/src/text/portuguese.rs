//! European Portuguese numbers, dates and times: "dezasseis", the long scale ("mil milhões"), and
//! "e" before the last group where that group is short or round.

use super::date::{Date, MONTHS};
use super::grammar::{Form, Grammar};
use super::language::Language;
use super::time::Clock;

/// Grammar of European Portuguese for numbers, dates and times.
pub(super) struct Portuguese;

const ONES: [&str; 20] = [
    "zero",
    "um",
    "dois",
    "três",
    "quatro",
    "cinco",
    "seis",
    "sete",
    "oito",
    "nove",
    "dez",
    "onze",
    "doze",
    "treze",
    "catorze",
    "quinze",
    "dezasseis",
    "dezassete",
    "dezoito",
    "dezanove",
];
const TENS: [&str; 10] = [
    "",
    "",
    "vinte",
    "trinta",
    "quarenta",
    "cinquenta",
    "sessenta",
    "setenta",
    "oitenta",
    "noventa",
];
const HUNDREDS: [&str; 10] = [
    "",
    "cento",
    "duzentos",
    "trezentos",
    "quatrocentos",
    "quinhentos",
    "seiscentos",
    "setecentos",
    "oitocentos",
    "novecentos",
];
/// Names of 10^6 and 10^12, one and more.
const SCALES: [[&str; 2]; 3] = [["", ""], ["milhão", "milhões"], ["bilião", "biliões"]];
const ORDINAL_ONES: [&str; 10] = [
    "", "primeiro", "segundo", "terceiro", "quarto", "quinto", "sexto", "sétimo", "oitavo", "nono",
];
const ORDINAL_TENS: [&str; 10] = [
    "",
    "décimo",
    "vigésimo",
    "trigésimo",
    "quadragésimo",
    "quinquagésimo",
    "sexagésimo",
    "septuagésimo",
    "octogésimo",
    "nonagésimo",
];
const ORDINAL_HUNDREDS: [&str; 10] = [
    "",
    "centésimo",
    "ducentésimo",
    "tricentésimo",
    "quadringentésimo",
    "quingentésimo",
    "sexcentésimo",
    "septingentésimo",
    "octingentésimo",
    "nongentésimo",
];
/// Nouns in -a that are masculine.
const MASCULINE_IN_A: &[&str] = &[
    "dia",
    "mapa",
    "planeta",
    "cometa",
    "poeta",
    "artista",
    "turista",
    "jornalista",
    "pirata",
    "guarda",
    "quilograma",
    "grama",
    "programa",
    "problema",
    "sistema",
    "tema",
    "poema",
    "drama",
    "clima",
    "fantasma",
    "idioma",
    "diploma",
    "telegrama",
    "esquema",
    "cinema",
];
const FEMININE_ENDINGS: &[&str] = &[
    "a", "ção", "são", "dade", "gem", "tude", "mulher", "vez", "voz", "mãe", "noite", "parte",
    "cidade", "luz", "flor", "mão", "chave", "árvore",
];

/// Words that are no nouns and end as feminine ones do.
const NO_NOUNS: &[&str] = &[
    "para", "ela", "elas", "essa", "esta", "aquela", "nada", "agora", "ainda", "fora", "era",
    "uma", "pela", "contra", "sua", "minha", "toda", "cada", "na", "da", "disse", "será", "são",
    "não", "então", "senão",
];

/// Returns `n` from 1 to 999 in words.
fn below_thousand(n: u64, form: Form) -> String {
    if n == 100 {
        return "cem".to_owned();
    }
    let mut parts: Vec<String> = Vec::new();
    if n >= 100 {
        let hundreds = HUNDREDS[(n / 100 % 10) as usize];
        parts.push(match form {
            Form::Feminine => hundreds.replace("tos", "tas"),
            _ => hundreds.to_owned(),
        });
    }
    let rest = n % 100;
    if rest >= 20 {
        parts.push(TENS[(rest / 10) as usize].to_owned());
    }
    let ones = if rest < 20 { rest } else { rest % 10 };
    match (ones, form) {
        (0, _) => {}
        (1, Form::Feminine) => parts.push("uma".to_owned()),
        (2, Form::Feminine) => parts.push("duas".to_owned()),
        _ => parts.push(ONES[ones as usize].to_owned()),
    }
    parts.join(" e ")
}

/// Returns an ordinal's words in the masculine; empty for zero.
fn ordinal_words(n: u64) -> Vec<&'static str> {
    let powers = [
        (1_000_000_000_000, "bilionésimo"),
        (1_000_000, "milionésimo"),
        (1000, "milésimo"),
    ];
    for (power, name) in powers {
        if n >= power {
            // "Milésimo", but "segundo milésimo".
            let mut words = if n / power > 1 {
                ordinal_words(n / power)
            } else {
                Vec::new()
            };
            words.push(name);
            words.extend(ordinal_words(n % power));
            return words;
        }
    }
    [
        ORDINAL_HUNDREDS[(n / 100 % 10) as usize],
        ORDINAL_TENS[(n / 10 % 10) as usize],
        ORDINAL_ONES[(n % 10) as usize],
    ]
    .into_iter()
    .filter(|word| !word.is_empty())
    .collect()
}

fn feminine(word: &str) -> String {
    match word.strip_suffix('o') {
        Some(stem) => format!("{stem}a"),
        None => word.to_owned(),
    }
}

fn counted(count: u64, one: &str, more: &str, form: Form) -> String {
    let noun = if count == 1 { one } else { more };
    format!("{} {noun}", Portuguese.cardinal(count, form))
}

impl Grammar for Portuguese {
    fn cardinal(&self, n: u64, form: Form) -> String {
        if n == 0 {
            return ONES[0].to_owned();
        }
        let mut spoken = String::new();
        // From the highest group of three digits down; the lower of each pair carries the pair's
        // name, so that 10^9 is "mil milhões".
        for power in (0..6).rev() {
            let group = n / 1000u64.pow(power) % 1000;
            let pair = n / 1_000_000u64.pow(power / 2) % 1_000_000;
            let [one, more] = SCALES[(power / 2) as usize];
            let form = if power < 2 { form } else { Form::Masculine };
            if group > 0 {
                let last = n.is_multiple_of(1000u64.pow(power));
                if !spoken.is_empty() {
                    let joined = last && (group < 100 || group.is_multiple_of(100));
                    spoken += if joined { " e " } else { " " };
                }
                match (power % 2, group) {
                    (1, 1) => spoken += "mil",
                    (1, _) => spoken += &format!("{} mil", below_thousand(group, form)),
                    _ => spoken += &below_thousand(group, form),
                }
            }
            if power % 2 == 0 && power > 0 && pair > 0 {
                spoken += " ";
                spoken += if pair == 1 { one } else { more };
            }
        }
        spoken
    }

    fn ordinal(&self, n: u64, ending: &str) -> String {
        if n == 0 {
            return ONES[0].to_owned();
        }
        let words = ordinal_words(n);
        let words: Vec<String> = words
            .into_iter()
            .map(|word| {
                if ending == "a" {
                    feminine(word)
                } else {
                    word.to_owned()
                }
            })
            .collect();
        words.join(" ")
    }

    fn ending(&self, _before: &str, previous: &str, next: &str) -> &'static str {
        let after_article = matches!(
            previous.to_lowercase().as_str(),
            "a" | "à" | "da" | "na" | "pela" | "uma"
        );
        if after_article || self.form_before(next) == Form::Feminine {
            "a"
        } else {
            "o"
        }
    }

    fn year(&self, n: u64) -> String {
        self.cardinal(n, Form::Alone)
    }

    fn decimals(&self, digits: &str) -> String {
        // "Três vírgula catorze", but "três vírgula zero cinco" and longer ones by digits.
        match digits.parse() {
            Ok(n) if digits.len() <= 2 && !digits.starts_with('0') => self.cardinal(n, Form::Alone),
            _ => super::number::digits(digits, Language::Portuguese),
        }
    }

    fn fraction(&self, numerator: u64, denominator: u64) -> Option<String> {
        let part = match denominator {
            2 => "meio".to_owned(),
            3 => "terço".to_owned(),
            4..=10 | 100 | 1000 => self.ordinal(denominator, "o"),
            11..1000 => format!("{} avo", self.cardinal(denominator, Form::Alone)),
            _ => return None,
        };
        let plural = if numerator == 1 { "" } else { "s" };
        Some(format!(
            "{} {part}{plural}",
            self.cardinal(numerator, Form::Masculine)
        ))
    }

    fn mixed(&self, whole: u64, numerator: u64, denominator: u64) -> Option<String> {
        let fraction = match (numerator, denominator) {
            (1, 2) => "meio".to_owned(),
            _ => self.fraction(numerator, denominator)?,
        };
        Some(format!(
            "{} e {fraction}",
            self.cardinal(whole, Form::Alone)
        ))
    }

    fn date(&self, date: &Date, _ending: &str) -> String {
        let mut parts = Vec::new();
        if let Some(day) = date.day {
            parts.push(self.cardinal(u64::from(day), Form::Masculine));
        }
        if let Some(month) = date.month {
            parts.push(MONTHS[month as usize - 1][Language::Portuguese as usize].to_owned());
        }
        if let Some(year) = date.year {
            parts.push(self.year(year));
        }
        parts.join(" de ")
    }

    fn clock(&self, clock: &Clock) -> String {
        let mut parts = vec![counted(clock.hour, "hora", "horas", Form::Feminine)];
        if let Some(minute) = clock.minute
            && minute > 0
        {
            parts.push(counted(minute, "minuto", "minutos", Form::Masculine));
        }
        if let Some(second) = clock.second
            && second > 0
        {
            parts.push(counted(second, "segundo", "segundos", Form::Masculine));
        }
        match parts.as_slice() {
            [hours, minutes, seconds] => format!("{hours}, {minutes} e {seconds}"),
            _ => parts.join(" e "),
        }
    }

    fn form_before(&self, noun: &str) -> Form {
        let noun = noun.to_lowercase();
        if noun.chars().count() < 3 || NO_NOUNS.contains(&noun.as_str()) {
            return Form::Alone;
        }
        let single = match noun.strip_suffix("ções") {
            Some(stem) => format!("{stem}ção"),
            None => match noun.strip_suffix("gens") {
                Some(stem) => format!("{stem}gem"),
                None => match noun.as_str() {
                    "vezes" => "vez".to_owned(),
                    "mulheres" => "mulher".to_owned(),
                    "mãos" => "mão".to_owned(),
                    "flores" => "flor".to_owned(),
                    "vozes" => "voz".to_owned(),
                    "luzes" => "luz".to_owned(),
                    other => other.strip_suffix('s').unwrap_or(other).to_owned(),
                },
            },
        };
        let feminine = FEMININE_ENDINGS
            .iter()
            .any(|ending| single.ends_with(ending));
        if feminine && !MASCULINE_IN_A.contains(&single.as_str()) && !single.ends_with("ista") {
            Form::Feminine
        } else {
            Form::Masculine
        }
    }
}

//! German numbers, dates and times. Numbers below a million are one word (Duden, *Schreibung von
//! Zahlen*), split after "tausend" only where a token would be too long.

use super::TOKEN_CHARS;
use super::date::{Date, MONTHS};
use super::grammar::{Form, Grammar};
use super::language::Language;
use super::time::Clock;

/// German grammar of numbers, dates and times.
pub(super) struct German;

const ONES: [&str; 20] = [
    "null",
    "ein",
    "zwei",
    "drei",
    "vier",
    "fünf",
    "sechs",
    "sieben",
    "acht",
    "neun",
    "zehn",
    "elf",
    "zwölf",
    "dreizehn",
    "vierzehn",
    "fünfzehn",
    "sechzehn",
    "siebzehn",
    "achtzehn",
    "neunzehn",
];
const TENS: [&str; 10] = [
    "", "", "zwanzig", "dreißig", "vierzig", "fünfzig", "sechzig", "siebzig", "achtzig", "neunzig",
];
/// Names of 10^6, 10^9, 10^12 and 10^15, one and more.
const SCALES: [[&str; 2]; 4] = [
    ["Million", "Millionen"],
    ["Milliarde", "Milliarden"],
    ["Billion", "Billionen"],
    ["Billiarde", "Billiarden"],
];
/// Articles and prepositions after which an adjective ends in -en.
const OBLIQUE: &[&str] = &[
    "am", "vom", "zum", "zur", "im", "beim", "dem", "den", "des", "einem", "einen", "eines",
    "einer", "keinem", "keinen", "bis", "seit", "ab", "vor", "nach", "seinem", "seinen", "seiner",
    "ihrem", "ihren", "ihrer", "meinem", "meinen", "meiner", "diesem", "diesen", "jedem", "jeden",
    "ihres", "seines", "dieses",
];
/// Articles after which it ends in -e.
const DIRECT: &[&str] = &[
    "der", "die", "das", "dieser", "diese", "jeder", "jede", "eine", "ihre", "seine", "meine",
    "ins", "ans",
];
/// Prepositions that make "der" a feminine dative: "in der dritten Klasse".
const PREPOSITIONS: &[&str] = &[
    "in", "an", "auf", "aus", "bei", "mit", "nach", "seit", "von", "zu", "vor", "hinter", "neben",
    "unter", "über", "zwischen", "während", "wegen", "trotz", "ab",
];
const NEUTER: &[&str] = &[
    "kapitel",
    "buch",
    "kind",
    "jahr",
    "mal",
    "bild",
    "lied",
    "semester",
    "jahrhundert",
    "haus",
    "spiel",
    "tor",
    "gebot",
    "quartal",
    "rennen",
    "stück",
    "obergeschoss",
    "heft",
];
const FEMININE_ENDINGS: &[&str] = &[
    "e", "ung", "heit", "keit", "schaft", "ion", "tät", "frau", "uhr", "nacht", "stadt", "hand",
];
/// Nouns in -e that are not feminine.
const MASCULINE_IN_E: &[&str] = &[
    "name",
    "junge",
    "käse",
    "kunde",
    "kollege",
    "gedanke",
    "ende",
    "auge",
    "buchstabe",
];

fn below_hundred(n: u64) -> String {
    match (n / 10 % 10, n % 10) {
        (0 | 1, _) => ONES[(n % 20) as usize].to_owned(),
        (tens, 0) => TENS[tens as usize].to_owned(),
        (tens, ones) => format!("{}und{}", ONES[ones as usize], TENS[tens as usize]),
    }
}

/// Returns `n` from 1 to 999 in German, with "ein" (not "eins") at its end.
fn below_thousand(n: u64) -> String {
    match (n / 100, n % 100) {
        (0, rest) => below_hundred(rest),
        (hundreds, 0) => format!("{}hundert", ONES[(hundreds % 20) as usize]),
        (hundreds, rest) => {
            format!(
                "{}hundert{}",
                ONES[(hundreds % 20) as usize],
                below_hundred(rest)
            )
        }
    }
}

/// Returns the words before the last `n % 100` of a number below a million.
fn down_to_hundreds(n: u64) -> String {
    let mut word = String::new();
    if n >= 1000 {
        word = below_thousand(n / 1000) + "tausend";
    }
    if !(n / 100).is_multiple_of(10) {
        word += &below_thousand(n % 1000 / 100 * 100);
    }
    word
}

fn parted(word: String) -> String {
    if word.chars().count() <= TOKEN_CHARS {
        return word;
    }
    word.replacen("tausend", "tausend ", 1)
}

fn capital(word: &str) -> String {
    let mut chars = word.chars();
    match chars.next() {
        Some(first) => first.to_uppercase().chain(chars).collect(),
        None => String::new(),
    }
}

/// Returns the millions and above in words.
fn high(n: u64) -> Vec<String> {
    let mut parts = Vec::new();
    for (index, [one, more]) in SCALES.iter().enumerate().rev() {
        match n / 1000u64.pow(index as u32 + 2) % 1000 {
            0 => {}
            1 => parts.push(format!("eine {one}")),
            group => parts.push(format!("{} {more}", counted(group))),
        }
    }
    parts
}

/// Returns a number below a thousand as counted before a feminine plural: "einhunderteins".
fn counted(group: u64) -> String {
    let word = below_thousand(group);
    if group % 100 == 1 { word + "s" } else { word }
}

/// Returns the ordinal without its ending: "dritt", "zwanzigst".
fn ordinal_stem(n: u64) -> String {
    if n >= 1_000_000 {
        let mut parts = high(n);
        if !n.is_multiple_of(1_000_000) {
            parts.push(ordinal_stem(n % 1_000_000));
            return parts.join(" ");
        }
        let last = parts.pop().unwrap_or_default();
        let (count, scale) = last.split_once(' ').unwrap_or(("", &last));
        let scale = scale
            .strip_suffix("nen")
            .map_or(scale.to_owned(), |s| format!("{s}n"));
        let scale = scale
            .trim_end_matches("en")
            .trim_end_matches('e')
            .to_lowercase();
        // Alone it has no count: "der millionste", as "der hundertste".
        let count = match count {
            "eine" if parts.is_empty() => "",
            "eine" => "ein",
            count => count,
        };
        parts.push(format!("{count}{scale}st"));
        return parts.join(" ");
    }
    if matches!(n, 100 | 1000) {
        return if n == 100 { "hundertst" } else { "tausendst" }.to_owned();
    }
    let rest = n % 100;
    let tail = match rest {
        0 if n == 0 => "nullt".to_owned(),
        0 => "st".to_owned(),
        1 => "erst".to_owned(),
        3 => "dritt".to_owned(),
        7 => "siebt".to_owned(),
        8 => "acht".to_owned(),
        2..20 => format!("{}t", below_hundred(rest)),
        _ => format!("{}st", below_hundred(rest)),
    };
    parted(down_to_hundreds(n) + &tail)
}

impl Grammar for German {
    fn cardinal(&self, n: u64, form: Form) -> String {
        match (n, form) {
            (0, _) => return ONES[0].to_owned(),
            (1, Form::Masculine) => return "ein".to_owned(),
            (1, Form::Feminine) => return "eine".to_owned(),
            _ => {}
        }
        let mut parts = high(n);
        let low = n % 1_000_000;
        if low > 0 {
            let mut word = down_to_hundreds(low);
            match low % 100 {
                0 => {}
                1 => word += "eins",
                rest => word += &below_hundred(rest),
            }
            parts.push(parted(word));
        }
        parts.join(" ")
    }

    fn ordinal(&self, n: u64, ending: &str) -> String {
        ordinal_stem(n) + ending
    }

    fn ending(&self, before: &str, previous: &str, next: &str) -> &'static str {
        let (before, previous) = (before.to_lowercase(), previous.to_lowercase());
        if OBLIQUE.contains(&previous.as_str())
            || previous == "der" && PREPOSITIONS.contains(&before.as_str())
        {
            return "en";
        }
        if DIRECT.contains(&previous.as_str()) {
            return "e";
        }
        // Without an article the adjective shows the gender itself: "drittes Kapitel".
        match self.form_before(next) {
            Form::Feminine => "e",
            _ if NEUTER.contains(&next.to_lowercase().as_str()) => "es",
            _ => "er",
        }
    }

    fn year(&self, n: u64) -> String {
        if !(1100..2000).contains(&n) {
            return self.cardinal(n, Form::Alone);
        }
        let rest = match n % 100 {
            0 => String::new(),
            1 => "eins".to_owned(),
            rest => below_hundred(rest),
        };
        format!("{}hundert{rest}", below_hundred(n / 100))
    }

    fn decimals(&self, digits: &str) -> String {
        super::number::digits(digits, Language::German)
    }

    fn fraction(&self, numerator: u64, denominator: u64) -> Option<String> {
        Some(match (numerator, denominator) {
            (1, 2) => "einhalb".to_owned(),
            (_, 2) => format!("{} Halbe", self.cardinal(numerator, Form::Masculine)),
            (_, 3..=1000) => format!(
                "{} {}",
                self.cardinal(numerator, Form::Masculine),
                capital(&(ordinal_stem(denominator) + "el"))
            ),
            _ => return None,
        })
    }

    fn mixed(&self, whole: u64, numerator: u64, denominator: u64) -> Option<String> {
        let fraction = self.fraction(numerator, denominator)?;
        Some(match (whole, denominator) {
            (0..1_000_000, 2) => self.cardinal(whole, Form::Masculine) + &fraction,
            _ => format!("{} {fraction}", self.cardinal(whole, Form::Alone)),
        })
    }

    fn date(&self, date: &Date, ending: &str) -> String {
        let mut parts = Vec::new();
        if let Some(day) = date.day {
            parts.push(self.ordinal(u64::from(day), ending));
        }
        if let Some(month) = date.month {
            parts.push(MONTHS[month as usize - 1][Language::German as usize].to_owned());
        }
        if let Some(year) = date.year {
            parts.push(self.year(year));
        }
        parts.join(" ")
    }

    fn clock(&self, clock: &Clock) -> String {
        let mut spoken = self.cardinal(clock.hour, Form::Masculine) + " Uhr";
        if let Some(minute) = clock.minute
            && (minute > 0 || clock.second.is_some())
        {
            spoken += " ";
            spoken += &self.cardinal(minute, Form::Alone);
        }
        match clock.second {
            Some(1) => spoken += " und eine Sekunde",
            Some(second) => {
                spoken += &format!(" und {} Sekunden", self.cardinal(second, Form::Alone));
            }
            None => {}
        }
        spoken
    }

    fn form_before(&self, noun: &str) -> Form {
        let noun = noun.to_lowercase();
        if noun.is_empty() {
            return Form::Alone;
        }
        let feminine = FEMININE_ENDINGS.iter().any(|ending| noun.ends_with(ending));
        if feminine && noun != "uhr" && !MASCULINE_IN_E.contains(&noun.as_str()) {
            Form::Feminine
        } else {
            Form::Masculine
        }
    }
}

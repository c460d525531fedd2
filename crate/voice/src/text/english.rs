//! English numbers, dates and times. Numbers are read with "and" ("one hundred and one"), which is
//! usual in Britain and understood everywhere.

use super::date::{Date, MONTHS};
use super::grammar::{Form, Grammar};
use super::language::Language;
use super::time::{Clock, Half};

/// English grammar of numbers, dates and times.
pub(super) struct English;

const ONES: [&str; 20] = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
];
const TENS: [&str; 10] = [
    "", "", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety",
];
const SCALES: [&str; 6] = [
    "",
    "thousand",
    "million",
    "billion",
    "trillion",
    "quadrillion",
];

fn below_hundred(n: u64) -> String {
    match (n / 10 % 10, n % 10) {
        (0 | 1, _) => ONES[(n % 20) as usize].to_owned(),
        (tens, 0) => TENS[tens as usize].to_owned(),
        (tens, ones) => format!("{} {}", TENS[tens as usize], ONES[ones as usize]),
    }
}

fn below_thousand(n: u64) -> String {
    match (n / 100, n % 100) {
        (0, rest) => below_hundred(rest),
        (hundreds, 0) => format!("{} hundred", below_hundred(hundreds)),
        (hundreds, rest) => {
            format!(
                "{} hundred and {}",
                below_hundred(hundreds),
                below_hundred(rest)
            )
        }
    }
}

/// Returns the plural of a fraction or decade name: "thirds", "nineties".
pub(super) fn plural(word: &str) -> String {
    match word.strip_suffix('y') {
        Some(stem) => format!("{stem}ies"),
        None if word.ends_with("half") => word.replace("half", "halves"),
        None if word.ends_with('x') => format!("{word}es"),
        None => format!("{word}s"),
    }
}

fn part_name(denominator: u64) -> Option<String> {
    match denominator {
        2 => Some("half".to_owned()),
        4 => Some("quarter".to_owned()),
        // "Twenty-firsts" is not English: such fractions are read with "over".
        n if n > 1 && n <= 1000 && n % 10 != 1 && n % 10 != 2 || matches!(n, 11 | 12) => {
            Some(English.ordinal(n, ""))
        }
        _ => None,
    }
}

impl Grammar for English {
    fn cardinal(&self, n: u64, _form: Form) -> String {
        if n < 1000 {
            return below_thousand(n);
        }
        let mut parts = Vec::new();
        for (power, scale) in SCALES.iter().enumerate().skip(1).rev() {
            let group = n / 1000u64.pow(power as u32) % 1000;
            if group > 0 {
                parts.push(format!("{} {scale}", below_thousand(group)));
            }
        }
        match n % 1000 {
            0 => {}
            rest @ 1..100 => parts.push(format!("and {}", below_hundred(rest))),
            rest => parts.push(below_thousand(rest)),
        }
        parts.join(" ")
    }

    fn ordinal(&self, n: u64, _ending: &str) -> String {
        let cardinal = self.cardinal(n, Form::Alone);
        let (head, last) = match cardinal.rsplit_once(' ') {
            Some((head, last)) => (format!("{head} "), last),
            None => (String::new(), cardinal.as_str()),
        };
        let last = match last {
            "one" => "first".to_owned(),
            "two" => "second".to_owned(),
            "three" => "third".to_owned(),
            "five" => "fifth".to_owned(),
            "eight" => "eighth".to_owned(),
            "nine" => "ninth".to_owned(),
            "twelve" => "twelfth".to_owned(),
            other => match other.strip_suffix('y') {
                Some(stem) => format!("{stem}ieth"),
                None => format!("{other}th"),
            },
        };
        head + &last
    }

    fn ending(&self, _before: &str, _previous: &str, _next: &str) -> &'static str {
        ""
    }

    fn year(&self, n: u64) -> String {
        let (century, rest) = (n / 100, n % 100);
        match (century, rest) {
            (10..=99, 10..) => format!("{} {}", below_hundred(century), below_hundred(rest)),
            (10..=99, 0) if !century.is_multiple_of(10) => {
                format!("{} hundred", below_hundred(century))
            }
            (11..=19, _) => format!("{} oh {}", below_hundred(century), below_hundred(rest)),
            _ => self.cardinal(n, Form::Alone),
        }
    }

    fn decimals(&self, digits: &str) -> String {
        super::number::digits(digits, Language::English)
    }

    fn fraction(&self, numerator: u64, denominator: u64) -> Option<String> {
        let part = part_name(denominator)?;
        let count = self.cardinal(numerator, Form::Alone);
        Some(match numerator {
            1 => format!("{count} {part}"),
            _ => format!("{count} {}", plural(&part)),
        })
    }

    fn mixed(&self, whole: u64, numerator: u64, denominator: u64) -> Option<String> {
        let fraction = match (numerator, denominator) {
            (1, 2) => "a half".to_owned(),
            (1, 4) => "a quarter".to_owned(),
            _ => self.fraction(numerator, denominator)?,
        };
        Some(format!(
            "{} and {fraction}",
            self.cardinal(whole, Form::Alone)
        ))
    }

    fn date(&self, date: &Date, _ending: &str) -> String {
        let month = date
            .month
            .map(|m| MONTHS[m as usize - 1][Language::English as usize]);
        let day = date.day.map(|d| self.ordinal(u64::from(d), ""));
        let mut spoken = match (day, month) {
            (Some(day), Some(month)) if date.day_first => format!("the {day} of {month}"),
            (Some(day), Some(month)) => format!("{month} {day}"),
            (Some(day), None) => format!("the {day}"),
            (None, Some(month)) => month.to_owned(),
            (None, None) => String::new(),
        };
        if let Some(year) = date.year {
            if date.day.is_some() {
                spoken.push(',');
            }
            spoken.push(' ');
            spoken += &self.year(year);
        }
        spoken.trim().to_owned()
    }

    fn clock(&self, clock: &Clock) -> String {
        let hour = self.cardinal(clock.hour, Form::Alone);
        let mut spoken = match (clock.hour, clock.minute.unwrap_or(0), clock.half) {
            (0, 0, None) if clock.second.is_none() => "midnight".to_owned(),
            (_, 0, Some(_)) => hour,
            (1..=12, 0, None) => format!("{hour} o'clock"),
            (_, 0, None) => format!("{hour} hundred"),
            (_, minute @ 1..10, _) => format!("{hour} oh {}", below_hundred(minute)),
            (_, minute, _) => format!("{hour} {}", below_hundred(minute)),
        };
        if let Some(second) = clock.second {
            let noun = if second == 1 { "second" } else { "seconds" };
            spoken += &format!(" and {} {noun}", below_hundred(second));
        }
        match clock.half {
            Some(Half::Morning) => spoken + " eigh em",
            Some(Half::Afternoon) => spoken + " pee em",
            None => spoken,
        }
    }

    fn form_before(&self, _noun: &str) -> Form {
        Form::Masculine
    }
}

//! Ordinals with digits (1st, 3.º, 3.), days before and after months, decades.

use super::date::{self, Date};
use super::grammar::{Form, Grammars as _};
use super::language::Language;
use super::number::Number;
use super::read::{Reader, Reading};
use super::word::Word;
use super::{Order, english, roman};

fn digits_and_rest(text: &str) -> Option<(u64, &str)> {
    let end = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    let (digits, rest) = text.split_at(end);
    if digits.len() > 15 {
        return None;
    }
    Some((digits.parse().ok()?, rest))
}

/// Returns the suffix that English writes after the ordinal of `n`.
fn english_suffix(n: u64) -> &'static str {
    match (n / 10 % 10, n % 10) {
        (1, _) => "th",
        (_, 1) => "st",
        (_, 2) => "nd",
        (_, 3) => "rd",
        _ => "th",
    }
}

impl Reader<'_> {
    /// Reads a number written as an ordinal, a day next to a month, or a decade.
    pub(super) fn ordinal(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let (n, rest) = digits_and_rest(&word.core)?;
        // "19th-century", "1980er-Jahre": the ordinal alone, then the rest.
        if let Some((head, tail)) = word.core.split_once('-')
            && !rest.starts_with('-')
            && tail.starts_with(char::is_alphabetic)
        {
            let head = Word::parse(head);
            let Reading { spoken, .. } = self.ordinal(at, &head)?;
            return Some(Reading::one(format!(
                "{} {}",
                spoken.concat(),
                self.runs(tail, false)
            )));
        }
        match self.language {
            Language::English => self.english_ordinal(at, n, rest),
            Language::German => self.german_ordinal(at, word, n, rest),
            Language::Portuguese => {
                let grammar = self.language.grammar();
                let ending = match rest {
                    ".os" | "os" | ".as" | "as" => {
                        let ending = if rest.ends_with("os") { "o" } else { "a" };
                        let words = grammar.ordinal(n, ending).replace(' ', "s ");
                        return Some(Reading::one(words + "s"));
                    }
                    "º" | ".º" | "o" | ".o" => "o",
                    "ª" | ".ª" | "a" | ".a" => "a",
                    _ => return None,
                };
                Some(Reading::one(grammar.ordinal(n, ending)))
            }
        }
    }

    fn english_ordinal(&self, at: usize, n: u64, rest: &str) -> Option<Reading> {
        let grammar = self.language.grammar();
        let ordinal = grammar.ordinal(n, "");
        if rest.eq_ignore_ascii_case(english_suffix(n)) {
            return Some(Reading::one(ordinal));
        }
        if matches!(rest, "s" | "'s" | "\u{2019}s") {
            let decade = n.is_multiple_of(10) && (20..100).contains(&n)
                || n.is_multiple_of(10) && (1100..2100).contains(&n);
            let count = if n < 1000 {
                grammar.cardinal(n, Form::Alone)
            } else {
                grammar.year(n)
            };
            return match n {
                _ if decade => Some(Reading::one(english::plural(&count))),
                100 | 1000 => Some(Reading::one(english::plural(
                    count.trim_start_matches("one "),
                ))),
                _ if rest == "s" => None,
                _ => Some(Reading::one(count + "'s")),
            };
        }
        let day = rest.is_empty() && (1..=31).contains(&n);
        let abbreviated = |word: &str| {
            date::MONTHS
                .iter()
                .any(|row| word.len() >= 3 && row[0].starts_with(word))
        };
        if day
            && (date::is_month(self.previous(at), self.language) || abbreviated(self.previous(at)))
        {
            return Some(Reading::one(ordinal));
        }
        if day
            && (date::is_month(self.next(at), self.language)
                || abbreviated(self.next_after_stop(at)))
        {
            let article = if self.previous(at).eq_ignore_ascii_case("the") {
                ""
            } else {
                "the "
            };
            return Some(Reading::one(format!("{article}{ordinal} of")));
        }
        None
    }

    fn german_ordinal(&self, at: usize, word: &Word<'_>, n: u64, rest: &str) -> Option<Reading> {
        let grammar = self.language.grammar();
        if let Some(ending) = ["te", "ten", "ter", "tes", "tem"]
            .iter()
            .find_map(|suffix| {
                (rest == *suffix || rest.strip_prefix('s') == Some(*suffix)).then(|| &suffix[1..])
            })
        {
            return Some(Reading::one(grammar.ordinal(n, ending)));
        }
        if matches!(rest, "er" | "ern") && n % 100 != 1 {
            return Some(Reading::one(grammar.year(n) + rest));
        }
        if !rest.is_empty() || word.end != "." {
            return None;
        }
        // "Ich habe 3." ends a sentence; "am 3. Oktober" and "der 3. Mann" do not.
        let next = self.next_after_stop(at);
        let (before, previous) = self.led_by(at);
        let noun = next.starts_with(char::is_uppercase);
        // A lower-case letter after the stop continues the sentence: "er wurde 1. und sie 2.".
        let goes_on = next.starts_with(char::is_lowercase);
        // "Es war der 3. Es regnete": such a word more likely begins a sentence.
        let starts = [
            "Es", "Er", "Sie", "Ich", "Wir", "Du", "Ihr", "Das", "Die", "Der", "Dann", "Und",
            "Aber", "In", "Im", "Am", "Da", "So", "Ein", "Eine", "Doch", "Nun",
        ]
        .contains(&next);
        let article = [
            "der", "die", "das", "den", "dem", "des", "am", "vom", "zum", "zur", "im", "beim",
            "ein", "eine", "einen", "einem", "einer", "jeder", "jede", "jedes", "jeden", "jedem",
            "ihr", "ihre", "ihren", "sein", "seine", "seinen", "seinem", "mein", "meine", "meinen",
            "meinem", "bis", "ins",
        ]
        .contains(&previous.to_lowercase().as_str());
        let ruler = !article
            && previous.chars().next().is_some_and(char::is_uppercase)
            && at > 0
            && roman::is_ruler(previous, self.language);
        if ruler {
            return Some(
                Reading::one(roman::ruler(n, previous, self.language)).owning_stop(next.is_empty()),
            );
        }
        let month = date::is_month(next, self.language) || next == "Jh" || next == "Jahrhundert";
        if !(month || goes_on || noun && (article || at == 0)) {
            return None;
        }
        let ending = grammar.ending(before, previous, next);
        Some(Reading::one(grammar.ordinal(n, ending)).owning_stop(starts))
    }

    /// Returns the two words before the word at `at`. In "am 1. und 2. Mai" the article of the
    /// first day also belongs to the second.
    fn led_by(&self, at: usize) -> (&str, &str) {
        let mut anchor = at;
        // More than these never share an article.
        for _ in 0..4 {
            let joined = matches!(self.previous(anchor), "und" | "oder" | "bis");
            let day = |at: usize| self.previous(at).starts_with(|c: char| c.is_ascii_digit());
            if !joined || anchor < 3 || !day(anchor - 1) {
                break;
            }
            anchor -= 2;
        }
        let before = anchor.checked_sub(1).map_or("", |at| self.previous(at));
        (before, self.previous(anchor))
    }

    /// Reads a date in digits; the preceding words determine the ending of the German day.
    pub(super) fn date(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let german = self.language == Language::German;
        // "25.12." has its stop as its own.
        let short = (german && word.dotted())
            .then(|| word.core.split_once('.'))
            .flatten()
            .filter(|(_, month)| month.len() <= 2);
        // "n.º 12/2008" is no December.
        let numbered = matches!(
            self.previous(at).to_lowercase().as_str(),
            "n.º" | "nº" | "n" | "no" | "nr" | "número" | "nummer" | "number" | "lei"
        );
        let own_stop = short.is_some();
        let date = match short {
            Some((day, month)) => {
                let text = format!("{month}.{day}");
                date::parse(&text, Some(Order::Md), self.language, false)
            }
            None if numbered => None,
            None => date::parse(&word.core, None, self.language, self.month_first),
        };
        let date = date?;
        Some(
            Reading::one(self.say_date(at, &date))
                .owning_stop(!own_stop || at + 1 == self.words.len()),
        )
    }

    /// Returns a date in words.
    pub(super) fn say_date(&self, at: usize, date: &Date) -> String {
        let grammar = self.language.grammar();
        let (before, previous) = self.led_by(at);
        let month = date.month.and_then(|m| date::MONTHS.get(m as usize - 1));
        let month = month.map_or("", |row| self.language.pick(*row));
        grammar.date(date, grammar.ending(before, previous, month))
    }

    /// Returns true if a plain number is a year, by its size and the adjacent words.
    pub(super) fn is_year(&self, at: usize, number: &Number) -> bool {
        let shaped = number.whole.len() == 4 && !number.grouped;
        let Some(n) = number
            .natural()
            .filter(|n| shaped && (1000..2100).contains(n))
        else {
            return false;
        };
        let next = self.next(at);
        // Few years of the eleventh century are met without saying so.
        let led = matches!(
            self.previous(at).to_lowercase().as_str(),
            "year" | "in" | "since" | "until" | "before" | "after" | "of" | "by"
        );
        if n < 1100 && !led {
            return false;
        }
        match self.language {
            // "1998 people" is a count; so is a number before a plural.
            Language::English => {
                let small = next.chars().all(char::is_lowercase);
                let verb = matches!(
                    next,
                    "was"
                        | "is"
                        | "has"
                        | "as"
                        | "does"
                        | "this"
                        | "its"
                        | "thus"
                        | "always"
                        | "perhaps"
                        | "us"
                );
                let plural = small
                    && !verb
                    && (next.ends_with('s')
                        || matches!(next, "people" | "men" | "women" | "children"));
                !plural
            }
            Language::German => {
                let noun = next.chars().next().is_some_and(char::is_uppercase);
                let led = matches!(
                    self.previous(at).to_lowercase().as_str(),
                    "jahr"
                        | "jahre"
                        | "jahren"
                        | "jahres"
                        | "im"
                        | "in"
                        | "seit"
                        | "von"
                        | "bis"
                        | "ab"
                        | "um"
                        | "anno"
                );
                n < 2000 && (!noun || led || date::is_month(self.previous(at), self.language))
            }
            // The reading differs only where a feminine noun is counted.
            Language::Portuguese => matches!(
                self.previous(at).to_lowercase().as_str(),
                "em" | "de" | "desde" | "até" | "ano" | "anos" | "a" | "e" | "entre"
            ),
        }
    }
}

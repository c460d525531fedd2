//! Words with digits: money, times, dates, telephone numbers, fractions, measures, ranges and plain
//! numbers, the clearest kind first.

use super::grammar::{Form, Grammars as _};
use super::language::Language;
use super::number::{self, Number};
use super::read::{Reader, Reading};
use super::runs::vulgar;
use super::word::Word;
use super::{SayAs, date, measure, money, spelling, time};

fn all_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

impl Reader<'_> {
    /// Reads a word with digits as an amount, date, time or other known kind; `None` if it is none
    /// of them.
    pub(super) fn amount(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        self.money(at, word)
            .or_else(|| self.time(at, word))
            .or_else(|| self.phone(at, word))
            .or_else(|| self.date(at, word))
            .or_else(|| self.fraction(at, word))
            .or_else(|| self.ordinal(at, word))
            .or_else(|| self.measure(at, word))
            .or_else(|| self.range(word))
            .or_else(|| self.two_numbers(word))
            .or_else(|| self.prefixed(at, word))
            .or_else(|| self.number(at, word))
    }

    /// Reads money: the currency sign is attached, or the sign or a magnitude is in the following
    /// words.
    pub(super) fn money(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let language = self.language;
        let next = self.next(at);
        if let Some((currency, text)) = money::split_currency(&word.core) {
            if let Some((amount, magnitude)) = money::suffixed(&text, language) {
                let amount = Number::parse(amount, language)?.cardinal(language, Form::Alone);
                let unit = currency.name(false, language);
                return Some(Reading::one(format!("{amount} {magnitude} {unit}")));
            }
            let number = Number::parse(&text, language)?;
            // "$3.5 million": the unit follows the magnitude.
            if let Some(magnitude) = money::magnitude(next, &number, language) {
                let unit = currency.name(false, language);
                return Some(Reading::several([
                    number.cardinal(language, Form::Masculine),
                    format!("{magnitude} {unit}"),
                ]));
            }
            return Some(Reading::one(currency.amount(&number, language)));
        }
        let number = Number::parse(&word.core, language)?;
        if let Some(currency) = money::currency(next) {
            let cents = number
                .decimals
                .as_ref()
                .is_some_and(|(_, digits)| digits.len() == 2);
            let amount = currency.amount(&number, language);
            // Hundredths follow the unit, so the sign's word is not spoken.
            if cents {
                return Some(Reading::several([amount, String::new()]));
            }
            let (count, unit) = amount.rsplit_once(' ')?;
            return Some(Reading::several([count.to_owned(), unit.to_owned()]));
        }
        let magnitude = money::magnitude(self.next_after_stop(at), &number, language)?;
        let currency = money::currency(self.next_after_stop(at + 1))?;
        let form = if language == Language::German {
            Form::Feminine
        } else {
            Form::Masculine
        };
        Some(Reading::several([
            number.cardinal(language, form),
            magnitude.to_owned(),
            currency.name(false, language).to_owned(),
        ]))
    }

    /// Reads a time of day, with the following words that belong to it.
    pub(super) fn time(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let grammar = self.language.grammar();
        let core = word.core.as_str();
        let next = self.next(at);
        let marked = matches!(self.say_as, Some(SayAs::Time));
        let german_hour = self.language == Language::German && next == "Uhr";
        let clock = time::parse(core, ':')
            .or_else(|| {
                (german_hour || marked)
                    .then(|| time::parse(core, '.'))
                    .flatten()
            })
            .or_else(|| {
                (self.language == Language::Portuguese)
                    .then(|| time::parse_with_h(core))
                    .flatten()
            });
        let hour = Number::parse(core, self.language).and_then(|n| n.natural());
        let Some(mut clock) = clock else {
            // "2 pm", "14 Uhr": an hour that only the next word makes one.
            let hour = hour.filter(|&hour| hour <= 24)?;
            if german_hour {
                return Some(Reading::several([
                    grammar.cardinal(hour, Form::Masculine),
                    "Uhr".to_owned(),
                ]));
            }
            let half = self
                .half_after(at)
                .filter(|_| hour <= 12 && self.language == Language::English)?;
            let said = if half == time::Half::Morning {
                "eigh em"
            } else {
                "pee em"
            };
            return Some(
                Reading::several([grammar.cardinal(hour, Form::Alone), said.to_owned()])
                    .owning_stop(self.sentence_ends(at + 1)),
            );
        };
        if clock.half.is_none()
            && self.language == Language::English
            && let Some(half) = self.half_after(at)
        {
            clock.half = Some(half);
            let spoken = grammar.clock(&clock);
            let cut =
                spoken.len() - spoken.rsplitn(3, ' ').take(2).map(str::len).sum::<usize>() - 1;
            let (hour, half) = spoken.split_at_checked(cut)?;
            return Some(
                Reading::several([hour.trim().to_owned(), half.trim().to_owned()])
                    .owning_stop(self.sentence_ends(at + 1)),
            );
        }
        let unit = self.language.pick(["", "Uhr", "horas"]);
        let spoken = grammar.clock(&clock);
        if !unit.is_empty() && (next == unit || next == "h") {
            return Some(Reading::several([spoken, String::new()]));
        }
        let own_stop = core.contains('.') && clock.half.is_some();
        Some(Reading::one(spoken).owning_stop(!own_stop || self.sentence_ends(at)))
    }

    /// Returns true if a sentence can end after the word at `at`.
    fn sentence_ends(&self, at: usize) -> bool {
        let dotted = self
            .words
            .get(at)
            .is_some_and(|word| word.core.contains('.'));
        !dotted || self.words.get(at + 1).is_none_or(Word::is_capital)
    }

    /// Returns true if the word at `at` continues or is a telephone number: after a country code,
    /// after an area code in brackets, or in a grouping that only telephone numbers have.
    fn in_phone(&self, at: usize) -> bool {
        let group = |at: usize| {
            self.words
                .get(at)
                .is_some_and(|w| all_digits(&w.core) && w.core.len() > 1)
        };
        let mut first = at;
        // No number has more groups.
        while first > 0
            && at - first < 6
            && (group(first - 1) || self.words[first - 1].core.starts_with('+'))
            && self.words[first - 1].end.is_empty()
        {
            first -= 1;
        }
        let starts = self.words.get(first).map_or("", |w| w.core.as_str());
        let code = starts
            .strip_prefix('+')
            .is_some_and(|code| code.len() <= 3 && all_digits(code));
        let mut last = at;
        while last < first + 7
            && group(last + 1)
            && self.words.get(last).is_some_and(|w| w.end.is_empty())
        {
            last += 1;
        }
        let widths: Vec<usize> = (first..=last)
            .filter_map(|at| self.words.get(at))
            .map(|w| w.core.len())
            .collect();
        let national = self.language == Language::Portuguese
            && widths == [3, 3, 3]
            && starts.starts_with(['2', '3', '8', '9']);
        // "Tel. 21 345 67 89"
        let told = matches!(
            self.previous(first).to_lowercase().as_str(),
            "tel" | "telefon" | "telefone" | "telemóvel" | "telephone" | "phone" | "fax"
        ) && widths.iter().sum::<usize>() > 5;
        code && last > first || national || told
    }

    /// Reads a telephone number, or one written group of it.
    fn phone(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let core = word.core.as_str();
        let digits = core.chars().filter(char::is_ascii_digit).count();
        let others = core
            .chars()
            .all(|c| c.is_ascii_digit() || matches!(c, '+' | '-' | '(' | ')' | '/'));
        let widths: Vec<usize> = core.split('-').map(str::len).collect();
        let grouped = self.language == Language::English
            && core.split('-').all(all_digits)
            && matches!(widths.as_slice(), [3, 4] | [3, 3, 4] | [1, 3, 3, 4]);
        // An area code: 030/123456.
        let area = core.starts_with('0') && digits >= 7 && core.matches(['/', '-']).count() == 1;
        let whole = others && (core.starts_with('+') && digits >= 7 || grouped || area);
        let bracketed = self.language == Language::English
            && word.opens
            && word.closes
            && all_digits(core)
            && digits == 3
            && self
                .words
                .get(at + 1)
                .is_some_and(|next| next.core.split('-').map(str::len).eq([3, 4]));
        let group = all_digits(core.strip_prefix('+').unwrap_or(core)) && self.in_phone(at);
        if !(whole || bracketed || group) {
            return None;
        }
        let more = self
            .words
            .get(at + 1)
            .is_some_and(|next| all_digits(&next.core) && self.in_phone(at + 1));
        let comma = if more && word.end.is_empty() { "," } else { "" };
        Some(Reading::one(spelling::phone(core, self.language) + comma))
    }

    /// Reads a fraction below one, alone or after a whole number.
    pub(super) fn fraction(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let grammar = self.language.grammar();
        let core = word.core.as_str();
        let marked = matches!(self.say_as, Some(SayAs::Fraction));
        if let Some(last) = core.chars().next_back()
            && let Some((numerator, denominator)) = vulgar(last)
        {
            let whole = &core[..core.len() - last.len_utf8()];
            let fraction = grammar.fraction(numerator, denominator)?;
            if whole.is_empty() {
                return Some(Reading::one(self.fraction_after_whole(at, &fraction)));
            }
            let whole = Number::parse(whole, self.language)?.natural()?;
            return grammar
                .mixed(whole, numerator, denominator)
                .map(Reading::one);
        }
        let (numerator, denominator) = core.split_once(['/', '\u{2044}'])?;
        if !all_digits(numerator)
            || !all_digits(denominator)
            || numerator.len().max(denominator.len()) > 15
        {
            return None;
        }
        let (numerator, denominator): (u64, u64) =
            (numerator.parse().ok()?, denominator.parse().ok()?);
        let clear = (1..=100).contains(&denominator) && (1..denominator).contains(&numerator);
        if !clear && !marked {
            return None;
        }
        let fraction = grammar.fraction(numerator, denominator).unwrap_or_else(|| {
            format!(
                "{} {} {}",
                grammar.cardinal(numerator, Form::Alone),
                self.language.pick(["over", "durch", "sobre"]),
                grammar.cardinal(denominator, Form::Alone)
            )
        });
        Some(Reading::one(self.fraction_after_whole(at, &fraction)))
    }

    /// Returns "and three quarters" after a whole number.
    fn fraction_after_whole(&self, at: usize, fraction: &str) -> String {
        let whole =
            at > 0 && self.words[at - 1].end.is_empty() && all_digits(&self.words[at - 1].core);
        match self.language {
            Language::German => fraction.to_owned(),
            _ if !whole => fraction.to_owned(),
            _ => format!("{} {fraction}", self.language.pick(["and", "", "e"])),
        }
    }

    /// Reads a quantity with its unit attached or in the next word.
    pub(super) fn measure(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let language = self.language;
        let marked = matches!(self.say_as, Some(SayAs::Measure));
        let (sign, core) = match word.core.strip_prefix('±') {
            Some(rest) => (
                spelling::sign('±', language).unwrap_or_default().to_owned() + " ",
                rest,
            ),
            None => (String::new(), word.core.as_str()),
        };
        if let Some((text, unit)) = measure::split_unit(core) {
            if let Some(number) = Number::parse(text, language) {
                let count = number.cardinal(language, unit.form(language));
                return Some(Reading::one(format!(
                    "{sign}{count} {}",
                    unit.name(number.is_one(), language)
                )));
            }
            // A range with its unit: "10-20%".
            let range = self.range_of(text)?;
            return Some(Reading::one(format!(
                "{range} {}",
                unit.name(false, language)
            )));
        }
        let unit = measure::apart(self.next(at), marked)?;
        let (count, one) = match Number::parse(core, language) {
            Some(number) => (
                number.cardinal(language, unit.form(language)),
                number.is_one(),
            ),
            None => (self.range_of(core)?, false),
        };
        let unit_word = &self.words[at + 1];
        let own = unit_word.dotted()
            && self
                .words
                .get(at + 2)
                .is_some_and(|next| !next.is_capital());
        Some(
            Reading::several([sign + &count, unit.name(one, language).to_owned()])
                .owning_stop(!own),
        )
    }

    /// Reads two numbers of which the first is not part of the second: "50/50", "24/7".
    fn two_numbers(&self, word: &Word<'_>) -> Option<Reading> {
        let (first, second) = word.core.split_once('/')?;
        let is_short = |text: &str| all_digits(text) && text.len() <= 3;
        if !is_short(first) || !is_short(second) {
            return None;
        }
        let said = [first, second].map(|part| {
            Number::parse(part, self.language)
                .map_or_else(String::new, |n| n.cardinal(self.language, Form::Alone))
        });
        Some(Reading::one(said.join(" ")))
    }

    /// Reads a number with a prefix: "pre-1990s", "post-2008", "mid-19th".
    fn prefixed(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let (prefix, number) = word.core.split_once('-')?;
        if prefix.is_empty() || !prefix.chars().all(char::is_lowercase) || number.contains('-') {
            return None;
        }
        let number = Word::parse(number);
        if !number.core.starts_with(|c: char| c.is_ascii_digit()) {
            return None;
        }
        let reading = self
            .ordinal(at, &number)
            .or_else(|| self.number(at, &number))?;
        let [said] = reading.spoken.as_slice() else {
            return None;
        };
        Some(Reading::one(format!("{prefix} {said}")))
    }

    fn range(&self, word: &Word<'_>) -> Option<Reading> {
        self.range_of(&word.core).map(Reading::one)
    }

    /// Returns a range such as "10-20" in words, years as years; `None` if the text is no range.
    fn range_of(&self, text: &str) -> Option<String> {
        let grammar = self.language.grammar();
        if let Some((from, to)) = text.split_once('/') {
            // "1848/49": a winter, a season, a school year.
            let years = from.len() == 4 && to.len() == 2 && all_digits(from) && all_digits(to);
            let (from, to) = (from.parse().ok()?, to.parse().ok()?);
            let follows = (1100..2100).contains(&from) && (from + 1) % 100 == to;
            return (years && follows).then(|| {
                format!(
                    "{} {}",
                    grammar.year(from),
                    grammar.cardinal(to, Form::Alone)
                )
            });
        }
        let (from, to) = text.split_once(['-', '\u{2013}', '\u{2212}'])?;
        if !all_digits(from) || !all_digits(to) {
            let (from, to) = (
                Number::parse(from, self.language)?,
                Number::parse(to, self.language)?,
            );
            let word = self.language.pick(["to", "bis", "a"]);
            let said = |n: &Number| n.cardinal(self.language, Form::Alone);
            return (!to.negative).then(|| format!("{} {word} {}", said(&from), said(&to)));
        }
        if self.language == Language::Portuguese && from.len() == 4 && to.len() == 3 {
            // A post code.
            return Some(spelling::phone(text, self.language));
        }
        let years = from.len() == 4
            && matches!(to.len(), 2 | 4)
            && matches!(from.as_bytes(), [b'1' | b'2', ..]);
        let said = |digits: &str| match digits.parse() {
            Ok(n) if years && digits.len() == 4 => grammar.year(n),
            _ => number::cardinal_of_digits(digits, self.language, Form::Alone),
        };
        Some(format!(
            "{} {} {}",
            said(from),
            self.language.pick(["to", "bis", "a"]),
            said(to)
        ))
    }

    /// Reads a plain number: a year, a count, or groups of three digits over several words.
    fn number(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let language = self.language;
        let grammar = language.grammar();
        let mut number = Number::parse(&word.core, language)?;
        let groups = self.groups_after(at, word);
        for group in 0..groups {
            number.whole += &self.words[at + 1 + group].core;
        }
        let marked = matches!(
            self.say_as,
            Some(SayAs::Cardinal | SayAs::Measure | SayAs::Currency | SayAs::Math)
        );
        if groups == 0
            && !marked
            && self.is_year(at, &number)
            && let Some(n) = number.natural()
        {
            return Some(Reading::one(grammar.year(n)));
        }
        let noun = self.next(at + groups);
        let magnitude = money::magnitude(self.next_after_stop(at), &number, language).is_some();
        let form = match language {
            Language::English => Form::Alone,
            // One of a million is "eine Million"; "um milhão".
            Language::German if magnitude => Form::Feminine,
            Language::Portuguese if magnitude => Form::Masculine,
            // German shows a noun by its capital; after an adjective no more is known.
            Language::German if !noun.chars().next().is_some_and(char::is_uppercase) => Form::Alone,
            Language::German if noun == "Uhr" => Form::Masculine,
            _ if noun.chars().all(char::is_alphabetic) && !date::is_month(noun, language) => {
                grammar.form_before(noun)
            }
            _ => Form::Alone,
        };
        let mut spoken = vec![number.cardinal(language, form)];
        spoken.extend((0..groups).map(|_| String::new()));
        Some(Reading { spoken, ends: true })
    }

    /// Returns the number of following words that continue a number grouped by spaces: "20 000".
    /// English groups by commas; only zeros are unambiguous there.
    fn groups_after(&self, at: usize, word: &Word<'_>) -> usize {
        let head = word
            .core
            .strip_prefix(number::is_minus)
            .unwrap_or(&word.core);
        if !all_digits(head) || head.len() > 3 || head.starts_with('0') {
            return 0;
        }
        // Five groups of three reach 10^18, beyond which no number has a name.
        (0..5)
            .take_while(|group| {
                let next = self.next(at + group);
                let spaced = self.language != Language::English || next == "000";
                spaced && next.len() == 3 && all_digits(next)
            })
            .count()
    }
}

//! Kind of a word's text, and the reader of that kind.

use super::grammar::{Form, Grammars as _};
use super::language::Language;
use super::word::Word;
use super::{SayAs, abbreviation, money, number, roman, spelling, time};
use raconteur_base::text::capitals::{self, CapitalContext};

/// Reading of one or more words: the spoken phrase for each of them, which may be empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Reading {
    pub(super) spoken: Vec<String>,
    /// A full stop after the last word ends a sentence, and is not the word's own.
    pub(super) ends: bool,
}

impl Reading {
    /// Creates the reading of one word as `phrase`.
    pub(super) fn one(phrase: impl Into<String>) -> Self {
        Self::several([phrase.into()])
    }

    /// Creates the reading of several words, each with its phrase.
    pub(super) fn several<const N: usize>(phrases: [String; N]) -> Self {
        Self {
            spoken: phrases.into(),
            ends: true,
        }
    }

    /// Marks its full stop as part of the word.
    pub(super) fn owning_stop(mut self, ends: bool) -> Self {
        self.ends = ends;
        self
    }
}

/// Phrase for "per item" in [English, German, Portuguese].
const EACH: [&str; 3] = [
    "second minute hour day night week month year person head child kilometre kilo litre",
    "sekunde minute stunde tag nacht woche monat jahr person kopf kind kilometer kilo liter",
    "segundo minuto hora dia noite semana mês ano pessoa cabeça criança quilómetro quilo litro",
];

/// Returns the value of a Roman numeral with an English ordinal ending: "XIXth"; `None` for other
/// words.
fn counted(word: &str) -> Option<u64> {
    let stem = ["th", "st", "nd", "rd"]
        .iter()
        .find_map(|end| word.strip_suffix(end))?;
    roman::value(stem).filter(|_| stem.len() > 1)
}

/// Returns true if a Roman numeral before a word is an ordinal, in English.
fn is_counted(next: &str) -> bool {
    [
        "century",
        "centuries",
        "millennium",
        "dynasty",
        "Century",
        "Dynasty",
        "Legion",
        "legion",
        "Corps",
        "Olympiad",
        "edition",
        "Congress",
    ]
    .contains(&next)
}

/// Reader that converts the words of a text in one language to spoken words.
pub(super) struct Reader<'a> {
    pub(super) words: &'a [Word<'a>],
    pub(super) language: Language,
    /// Dates like 12/25/1998.
    pub(super) month_first: bool,
    pub(super) say_as: Option<&'a SayAs>,
}

impl<'a> Reader<'a> {
    /// Creates a reader of `words`; `tag` is the whole language tag, whose region determines the
    /// order of English dates.
    pub(super) fn new(
        words: &'a [Word<'a>],
        language: Language,
        tag: &str,
        say_as: Option<&'a SayAs>,
    ) -> Self {
        let tag = tag.to_ascii_lowercase();
        let region = tag.split(['-', '_']).skip(1).find(|part| part.len() == 2);
        Self {
            words,
            language,
            month_first: language == Language::English && matches!(region, None | Some("us")),
            say_as,
        }
    }

    /// Returns the preceding word, if nothing separates the two.
    pub(super) fn previous(&self, at: usize) -> &str {
        match at.checked_sub(1).and_then(|before| self.words.get(before)) {
            Some(word) if !word.closes && matches!(word.end.as_str(), "" | ".") => &word.core,
            _ => "",
        }
    }

    /// Returns the following word, if nothing separates the two.
    pub(super) fn next(&self, at: usize) -> &str {
        match (self.words.get(at), self.words.get(at + 1)) {
            (Some(word), Some(next)) if word.end.is_empty() && !word.closes && !next.opens => {
                &next.core
            }
            _ => "",
        }
    }

    /// Returns the next word, even after a full stop; empty if there is none.
    pub(super) fn next_after_stop(&self, at: usize) -> &str {
        match (self.words.get(at), self.words.get(at + 1)) {
            (Some(word), Some(next)) if matches!(word.end.as_str(), "" | ".") => &next.core,
            _ => "",
        }
    }

    /// Reads the word at `at`, and those after it that belong to it.
    pub(super) fn read(&self, at: usize) -> Reading {
        let Some(word) = self.words.get(at) else {
            return Reading::one("");
        };
        if let Some(mode) = self.say_as
            && let Some(reading) = self.read_as(mode, at, word)
        {
            return reading;
        }
        self.read_unmarked(at, word)
    }

    /// Reads a word as [`Reader::read`] does, but ignores the mode of the markup.
    pub(super) fn read_unmarked(&self, at: usize, word: &Word<'_>) -> Reading {
        let core = word.core.as_str();
        if core.is_empty() {
            return Reading::one("");
        }
        if core.contains(|c: char| c.is_numeric() || matches!(c, 'º' | 'ª'))
            && !spelling::is_net(core)
            && let Some(reading) = self.amount(at, word)
        {
            return reading;
        }
        if let Some(found) = abbreviation::expand(self.words, at, self.language) {
            let spoken = found.spoken.into_iter().map(|said| match found.is_spelled {
                true => spelling::literal(&said, self.language),
                false => said,
            });
            return Reading {
                spoken: spoken.collect(),
                ends: found.ends,
            };
        }
        if core.contains(['.', ':', '@', '/']) && spelling::is_net(core) {
            return Reading::one(spelling::net(core, self.language));
        }
        if word.is_plain() {
            return self.plain(at, word);
        }
        if let Some(reading) = self.lone_sign(at, core) {
            return reading;
        }
        if let Some(rate) = self.rate(at, core) {
            return rate;
        }
        Reading::one(self.runs(core, false))
    }

    /// Reads a rate per time or per unit: "litres/day" after a number.
    fn rate(&self, at: usize, core: &str) -> Option<Reading> {
        let (counted, each) = core.split_once('/')?;
        let is_rate = self.previous(at).starts_with(|c: char| c.is_ascii_digit())
            && counted.chars().all(char::is_alphabetic)
            && self
                .language
                .pick(EACH)
                .split(' ')
                .any(|own| own == each.to_lowercase());
        let per = self.language.pick(["per", "pro", "por"]);
        is_rate.then(|| Reading::one(format!("{counted} {per} {each}")))
    }

    /// Reads a word of letters, in most cases as itself.
    fn plain(&self, at: usize, word: &Word<'_>) -> Reading {
        let core = word.core.as_str();
        let numeral = core.strip_suffix("'s").unwrap_or(core);
        if let Some(n) = counted(core).filter(|_| self.language == Language::English) {
            return Reading::one(self.language.grammar().ordinal(n, ""));
        }
        if !word.is_capital() || numeral.chars().skip(1).any(char::is_lowercase) {
            return Reading::one(self.letters(core, CapitalContext::Nothing));
        }
        if core.len() == 3
            && money::currency(core).is_some()
            && let Some(reading) = self.lone_sign(at, core)
        {
            return reading;
        }
        if let Some(numeral) = self.numeral(at, word) {
            return numeral;
        }
        let around = capitals::around(self.words, at, self.language);
        Reading::one(self.letters(core, around))
    }

    /// Reads a Roman numeral if its meaning is clear; otherwise returns `None`.
    fn numeral(&self, at: usize, word: &Word<'_>) -> Option<Reading> {
        let language = self.language;
        let (core, genitive) = match word.core.strip_suffix("'s") {
            Some(stem) => (stem, "'s"),
            None => (word.core.as_str(), ""),
        };
        let n = roman::value(core)?;
        let (previous, next) = (self.previous(at), self.next_after_stop(at));
        // After a word such as "drip" or "fluids", "IV" is not a four, and a four never follows
        // "an".
        let drips = previous.eq_ignore_ascii_case("an")
            || [
                "drip",
                "fluid",
                "fluids",
                "line",
                "lines",
                "therapy",
                "bag",
                "antibiotics",
            ]
            .contains(&next);
        if language == Language::English && core == "IV" && drips {
            return None;
        }
        // "I" is a word of English.
        if language == Language::English && core == "I" && !self.next(at).is_empty() {
            return None;
        }
        // The stop of a German numeral is its own: "Heinrich VIII. war König".
        let own_stop = language == Language::German && at + 1 < self.words.len();
        if let Some(numeral) = roman::after(previous, core, language) {
            return Some(Reading::one(numeral + genitive).owning_stop(!own_stop));
        }
        let grammar = language.grammar();
        let noun = next.starts_with(char::is_uppercase);
        let before = at.checked_sub(1).map_or("", |at| self.previous(at));
        let article = matches!(previous, "der" | "die" | "das" | "den" | "dem" | "des");
        if language == Language::German && word.dotted() && own_stop && (noun || article) {
            let ending = grammar.ending(before, previous, next);
            return (core.len() > 1 || article)
                .then(|| Reading::one(grammar.ordinal(n, ending)).owning_stop(false));
        }
        // "The XIX century", "no século XIX"; the latter is read above.
        if language == Language::English && core.len() > 1 && is_counted(next) {
            return Some(Reading::one(grammar.ordinal(n, "")));
        }
        // With two letters or more, those without C, D, L and M have no other meaning.
        if core.len() < 2 || !core.chars().all(|c| matches!(c, 'I' | 'V' | 'X')) {
            return None;
        }
        Some(Reading::one(match language {
            Language::Portuguese if noun && n <= 10 => {
                grammar.ordinal(n, grammar.ending(before, previous, next))
            }
            _ => grammar.cardinal(n, Form::Alone) + genitive,
        }))
    }

    /// Returns letters as a word, or their names for an acronym; `around` describes the
    /// neighbouring words. Capitals that form a word are converted to lower case: some engines
    /// spell others by their own rules.
    pub(super) fn letters(&self, word: &str, around: CapitalContext) -> String {
        const HYPHENS: [char; 3] = ['-', '\u{2010}', '\u{2011}'];
        let parts: Vec<&str> = word.split(HYPHENS).collect();
        if parts.len() > 1 {
            // "US-Präsident": a part joined to lower-case letters is a name.
            let around = match word.contains(char::is_lowercase) {
                true => CapitalContext::Name,
                false => around,
            };
            let spelled = |part: &&str| capitals::is_acronym(part, around, self.language);
            if parts.iter().any(spelled) {
                let said = parts.iter().map(|part| match part.chars().count() {
                    1 => spelling::literal(part, self.language),
                    _ => self.read_part(part, around),
                });
                return said.collect::<Vec<_>>().join(" ");
            }
        }
        self.read_part(word, around)
    }

    /// Returns the reading of a word without hyphens.
    fn read_part(&self, word: &str, around: CapitalContext) -> String {
        let named = matches!(self.say_as, Some(SayAs::Name));
        let acronym = |word: &str| !named && capitals::is_acronym(word, around, self.language);
        if acronym(word) {
            return spelling::literal(word, self.language);
        }
        // "CDs": the plural of an acronym.
        if let Some(stem) = word
            .strip_suffix("'s")
            .or_else(|| word.strip_suffix("\u{2019}s"))
            .or_else(|| word.strip_suffix('s'))
            && acronym(stem)
        {
            let s = if self.language == Language::German {
                "s"
            } else {
                "'s"
            };
            let plural = if word.contains(['\'', '\u{2019}']) {
                s
            } else {
                "s"
            };
            return spelling::literal(stem, self.language) + plural;
        }
        let letters = word.chars().filter(|c| c.is_alphabetic()).count();
        if letters > 1 && !named && !word.contains(char::is_lowercase) {
            return word.to_lowercase();
        }
        word.to_owned()
    }

    /// Reads a sign that is a separate word.
    fn lone_sign(&self, at: usize, core: &str) -> Option<Reading> {
        let next = self.next(at);
        if let Some(currency) = money::currency(core) {
            let amount = number::Number::parse(next, self.language);
            return Some(match amount {
                Some(amount) => {
                    Reading::several([String::new(), currency.amount(&amount, self.language)])
                }
                None => Reading::one(currency.name(false, self.language)),
            });
        }
        let mut chars = core.chars();
        let (Some(sign), None) = (chars.next(), chars.next()) else {
            return None;
        };
        let said = match sign {
            '/' => self.language.pick(["or", "oder", "ou"]),
            '-' => return Some(Reading::one("")),
            _ => spelling::sign(sign, self.language)?,
        };
        Some(Reading::one(said))
    }

    /// Returns the half of the day if the word at `at` is that of the preceding hour.
    pub(super) fn half_after(&self, at: usize) -> Option<time::Half> {
        time::half(self.next(at))
    }
}

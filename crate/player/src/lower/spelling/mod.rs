//! Conversion of spelling to phones, for a text without a baked voice: the mouth shapes, by rules
//! of English, German and Portuguese; letter by letter in other languages.
//!
//! A rule is `before[letters]after phones`, in lower case, with spaces between phones and `|` or a
//! new line between rules. Contexts consist of letters and classes: `_` the word's edge, `#` one
//! without an apostrophe, `V` a vowel, `C` a consonant, `F` one of e, i, y; `S`, before, a vowel
//! anywhere before; `T`, behind, two more syllables; `%`, behind, an English ending. Of the
//! matching rules, the one with the most letters applies, and of those the first.

mod english;
mod german;
mod letters;
mod portuguese;
#[cfg(test)]
mod tests;

use letters::{bare, composed};

/// The most phones of a word: longer words are mimed from their beginning.
pub(crate) const MAX_PHONES: usize = 64;

/// Endings that leave the vowel before them long.
const ENDINGS: [&str; 8] = ["e", "es", "ed", "er", "ers", "ing", "ings", "ely"];

/// Phones of a letter sequence in a context.
struct Rule {
    before: &'static str,
    letters: &'static str,
    after: &'static str,
    phones: &'static str,
}

/// Letter-to-sound rules of a language; gives the phones of words without recorded speech, for lip
/// motion.
pub(crate) struct Speller {
    /// Rules sorted by their first letter, the longest first.
    rules: Vec<Rule>,
    /// Letters with marks that have rules of their own.
    marked: &'static str,
}

impl Speller {
    /// Returns the rules for a BCP 47 tag by its primary subtag; English if the language is
    /// unknown.
    pub(crate) fn from_language_tag(tag: Option<&str>) -> Self {
        let tag = tag.unwrap_or("en").to_ascii_lowercase();
        let (primary, region) = tag.split_once(['-', '_']).unwrap_or((&tag, ""));
        let brazil = match region {
            "br" => portuguese::BRAZIL,
            _ => "",
        };
        let (words, tables, marked) = match primary {
            "en" => (english::WORDS, ["", english::RULES], "é"),
            "de" => (german::WORDS, ["", german::RULES], "äöüß"),
            "pt" => (
                portuguese::WORDS,
                [brazil, portuguese::RULES],
                "áàâãéêíóôõúç",
            ),
            _ => ("", ["", ""], "äöüãõçßάέήίόύώй"),
        };
        let mut rules: Vec<Rule> = entries(words).filter_map(word).collect();
        rules.extend(tables.into_iter().flat_map(entries).filter_map(rule));
        rules.extend(entries(letters::RULES).filter_map(rule));
        // The sort is stable: among rules of equal length, the first comes first.
        rules.sort_by_cached_key(|r| (first(r), core::cmp::Reverse(r.letters.chars().count())));
        Self { rules, marked }
    }

    /// Returns the phones of a word in the phone set `radio`, one to [`MAX_PHONES`].
    pub(crate) fn spell(&self, word: &str) -> Vec<&'static str> {
        let word = self.letters(word);
        let mut phones = Vec::new();
        let mut at = 0;
        while at < word.len() && phones.len() < MAX_PHONES {
            let (taken, found) = self.rule_at(&word, at);
            let twice = at > 0 && word[at] == word[at - 1] && word[at].is_alphabetic();
            let doubled = twice && phones.last() == Some(&found);
            if !doubled {
                phones.extend(found.split_ascii_whitespace());
            }
            at += taken;
        }
        phones.truncate(MAX_PHONES);
        if phones.is_empty() {
            phones.push("ax");
        }
        phones
    }

    /// Returns the number of letters matched at a position and their phones. A letter of an unknown
    /// script counts as a syllable.
    fn rule_at(&self, word: &[char], at: usize) -> (usize, &'static str) {
        let letter = word[at];
        let from = self.rules.partition_point(|r| first(r) < Some(letter));
        let here = self.rules[from..].iter();
        let mut here = here.take_while(|r| first(r) == Some(letter));
        match here.find(|rule| rule.fits(word, at)) {
            Some(rule) => (rule.letters.chars().count(), rule.phones),
            None if letter.is_alphanumeric() => (1, "ax"),
            None => (1, ""),
        }
    }

    /// Returns a word in lower case, with the diacritics that the rules know, truncated after
    /// [`MAX_PHONES`].
    fn letters(&self, word: &str) -> Vec<char> {
        let mut letters: Vec<char> = Vec::new();
        for c in word.chars().flat_map(char::to_lowercase) {
            let made = letters.last().and_then(|&last| composed(last, c));
            if let Some(made) = made.filter(|&made| self.marked.contains(made)) {
                letters.pop();
                letters.push(made);
                continue;
            }
            match c {
                '’' => letters.push('\''),
                '\u{300}'..='\u{36f}' => {}
                _ if self.marked.contains(c) => letters.push(c),
                _ => letters.push(bare(c)),
            }
            if letters.len() == 4 * MAX_PHONES {
                break;
            }
        }
        letters
    }
}

impl Rule {
    fn fits(&self, word: &[char], at: usize) -> bool {
        let end = at + self.letters.chars().count();
        let here = word.get(at..end);
        here.is_some_and(|here| here.iter().copied().eq(self.letters.chars()))
            && fits_before(self.before, &word[..at])
            && fits_behind(self.after, &word[end..])
    }
}

/// Returns the rules of a table as written.
fn entries(table: &'static str) -> impl Iterator<Item = &'static str> {
    table.split(['|', '\n']).filter(|entry| !entry.is_empty())
}

/// Parses a rule of the form `before[letters]after phones`; `None` if it is malformed.
fn rule(entry: &'static str) -> Option<Rule> {
    let (before, rest) = entry.split_once('[')?;
    let (letters, rest) = rest.split_once(']')?;
    let (after, phones) = rest.split_once(' ').unwrap_or((rest, ""));
    Some(Rule {
        before,
        letters,
        after,
        phones,
    })
}

/// Parses an exception entry: a whole word and its phones.
fn word(entry: &'static str) -> Option<Rule> {
    let (letters, phones) = entry.split_once(' ')?;
    Some(Rule {
        before: "#",
        letters,
        after: "_",
        phones,
    })
}

/// Returns the first letter that a rule matches.
fn first(rule: &Rule) -> Option<char> {
    rule.letters.chars().next()
}

fn is_vowel(letter: char) -> bool {
    matches!(bare(letter), 'a' | 'e' | 'i' | 'o' | 'u' | 'y')
}

/// Returns true if a context class or letter matches a letter; at the word's edge nothing matches.
fn is_of(class: char, letter: Option<char>) -> bool {
    let inside = letter.is_some_and(char::is_alphanumeric);
    match (class, letter) {
        ('_', _) => !inside,
        ('#', _) => !inside && letter != Some('\''),
        (_, None) => false,
        ('V', Some(c)) => is_vowel(c),
        ('C', Some(c)) => c.is_alphabetic() && !is_vowel(c),
        ('F', Some(c)) => matches!(bare(c), 'e' | 'i' | 'y'),
        (_, Some(c)) => c == class,
    }
}

/// Returns true if a context matches the letters before a position.
fn fits_before(context: &str, word: &[char]) -> bool {
    let mut rest = word;
    for class in context.chars().rev() {
        if class == 'S' {
            return stem(rest).any(is_vowel);
        }
        if !is_of(class, rest.last().copied()) {
            return false;
        }
        rest = &rest[..rest.len().saturating_sub(1)];
    }
    true
}

/// Returns the preceding letters of the same word, backwards.
fn stem(word: &[char]) -> impl Iterator<Item = char> {
    let letters = word.iter().rev().copied();
    letters.take_while(|c| c.is_alphabetic())
}

/// Returns true if a context matches the letters after a position.
fn fits_behind(context: &str, word: &[char]) -> bool {
    let mut rest = word;
    for class in context.chars() {
        match class {
            '%' => return ENDINGS.iter().any(|ending| is_rest(ending, rest)),
            'T' => return syllables(rest) >= 2,
            _ if !is_of(class, rest.first().copied()) => return false,
            _ => rest = rest.get(1..).unwrap_or_default(),
        }
    }
    true
}

/// Returns true if this ending is the whole rest of the word.
fn is_rest(ending: &str, word: &[char]) -> bool {
    let letters = ending.chars().chain(['_']);
    let mut places = letters.enumerate();
    places.all(|(i, class)| is_of(class, word.get(i).copied()))
}

/// Returns the number of vowel groups in the rest of a word, two at most.
fn syllables(word: &[char]) -> usize {
    let mut before = false;
    let letters = word.iter().take_while(|c| c.is_alphabetic());
    let begins = letters.filter(|&&c| {
        let begins = is_vowel(c) && !before;
        before = is_vowel(c);
        begins
    });
    begins.take(2).count()
}

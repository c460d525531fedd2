//! Written word: its readable part, and the punctuation around it.

use std::borrow::Cow;

/// Written word, split into its readable part and the punctuation around it.
#[derive(Debug, Clone)]
pub struct Word<'a> {
    /// The whole word with its punctuation, letters and their marks composed (NFC).
    pub raw: Cow<'a, str>,
    /// The word without surrounding quotes, brackets, dashes and punctuation; may be empty.
    pub core: String,
    /// The punctuation of `,.;:!?` after it, an ellipsis being a full stop.
    pub end: String,
    /// A bracket or dash before it parts it from the word before.
    pub opens: bool,
    /// A bracket or dash after it parts it from the word after.
    pub closes: bool,
}

/// Combining marks with the letters they join, and the composed letters in the same order
/// (Unicode, Latin-1 Supplement and Latin Extended-A).
const COMPOSED: &[(char, &str, &str)] = &[
    ('\u{300}', "aeiouAEIOU", "àèìòùÀÈÌÒÙ"),
    ('\u{301}', "aeiouycnszAEIOUYCNSZ", "áéíóúýćńśźÁÉÍÓÚÝĆŃŚŹ"),
    ('\u{302}', "aeiouAEIOU", "âêîôûÂÊÎÔÛ"),
    ('\u{303}', "anoANO", "ãñõÃÑÕ"),
    ('\u{308}', "aeiouyAEIOU", "äëïöüÿÄËÏÖÜ"),
    ('\u{30a}', "auAU", "åůÅŮ"),
    ('\u{30c}', "csznredCSZNRED", "čšžňřěďČŠŽŇŘĚĎ"),
    ('\u{327}', "csCS", "çşÇŞ"),
];

/// Composes letters and combining marks of `text` where Latin has a precomposed letter.
#[must_use]
pub fn composed(text: &str) -> Cow<'_, str> {
    if !text.chars().any(|c| ('\u{300}'..='\u{327}').contains(&c)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::new();
    for c in text.chars() {
        let letter = out.chars().next_back().and_then(|base| {
            let (_, bases, letters) = COMPOSED.iter().find(|(mark, ..)| *mark == c)?;
            letters.chars().nth(bases.chars().position(|b| b == base)?)
        });
        match letter {
            Some(letter) => {
                out.pop();
                out.push(letter);
            }
            None => out.push(c),
        }
    }
    Cow::Owned(out)
}

/// Splits a precomposed letter into its base and combining mark; `None` for any other letter.
#[must_use]
pub fn decomposed(letter: char) -> Option<(char, char)> {
    COMPOSED.iter().find_map(|(mark, bases, letters)| {
        let at = letters.chars().position(|c| c == letter)?;
        Some((bases.chars().nth(at)?, *mark))
    })
}

/// Returns true if `c` belongs to a word: a letter of any script, or a combining mark.
#[must_use]
pub fn is_letter(c: char) -> bool {
    // Ordinal signs are letters to Unicode; they are read as numbers' endings here.
    c.is_alphabetic() && !matches!(c, 'ª' | 'º')
        || matches!(c, '\u{300}'..='\u{36f}' | '\u{94d}' | '\u{9cd}' | '\u{e47}'..='\u{e4e}')
}

/// Returns true if `c` joins letters to one word.
#[must_use]
pub fn is_joiner(c: char) -> bool {
    matches!(c, '\'' | '\u{2019}' | '-' | '\u{2010}' | '\u{2011}')
}

/// Makes an ellipsis before a small letter a comma: it ends no sentence.
pub fn soften_ellipses(words: &mut [Word<'_>]) {
    for at in 1..words.len() {
        let goes_on = words[at].core.starts_with(char::is_lowercase);
        let word = &mut words[at - 1];
        let ellipsis = word.raw.contains('\u{2026}') || word.raw.contains("...");
        if goes_on && ellipsis && word.end == "." {
            word.end = ",".to_owned();
        }
    }
}

/// Makes lone hyphens, colons and slashes between numbers minuses and divisions, where an
/// equals sign shows that this is a sum.
pub fn mark_sums(words: &mut [Word<'_>]) {
    if !words.iter().any(|word| word.core == "=") {
        return;
    }
    let number = |word: &Word<'_>| word.core.starts_with(|c: char| c.is_ascii_digit());
    for at in 1..words.len().saturating_sub(1) {
        if !number(&words[at - 1]) || !number(&words[at + 1]) {
            continue;
        }
        let word = &mut words[at];
        let sign = match word.raw.as_ref() {
            "-" | "\u{2013}" => "\u{2212}",
            ":" | "/" => "÷",
            "·" | "*" => "×",
            _ => continue,
        };
        word.core = sign.to_owned();
        word.forget_signs();
    }
}

/// Returns true for signs that carry meaning at a word's edge.
fn means(c: char) -> bool {
    is_letter(c) || c.is_alphanumeric() || "+−$€£¥₹¢@#§°%‰=<>^×÷±√∞≠≤≥≈&/~".contains(c)
}

fn is_dash(c: char) -> bool {
    matches!(c, '\u{2012}'..='\u{2015}' | '-' | '\u{2212}')
}

impl<'a> Word<'a> {
    /// Splits a written word into its readable part and punctuation.
    #[must_use]
    pub fn parse(written: &'a str) -> Self {
        let raw = composed(written.trim());
        let mut opens = false;
        let mut start = raw.len();
        let mut before = ' ';
        for (at, c) in raw.char_indices() {
            let rest = &raw[at + c.len_utf8()..];
            let next = rest.chars().next().unwrap_or(' ');
            // "-5", "-$5" and ".5" begin with their sign; "--5" does not.
            let signed = match c {
                '-' => (next.is_ascii_digit() || "$€£¥".contains(next)) && before != '-',
                '.' => next.is_ascii_digit() && before != '.',
                _ => means(c),
            };
            if signed {
                start = at;
                break;
            }
            opens |=
                matches!(c, '(' | '[' | '{') || is_dash(c) && c != '-' || c == '-' && next == '-';
            before = c;
        }
        let body = &raw[start..];
        let core = body.trim_end_matches(|c| !means(c));
        let tail = if core.is_empty() {
            raw.as_ref()
        } else {
            &body[core.len()..]
        };
        let mut closes =
            tail.contains([')', ']', '}', '\u{2013}', '\u{2014}']) || tail.contains("--");
        closes |= core.is_empty() && tail == "-";
        let mut end = String::new();
        for c in tail.chars() {
            let sign = if c == '\u{2026}' { '.' } else { c };
            // Three different signs suffice, as in "?!".
            if ",.;:!?".contains(sign) && !end.contains(sign) && end.len() < 3 {
                end.push(sign);
            }
        }
        // "5,- €" has no hundredths.
        let round = tail.starts_with(",-") || tail.starts_with(",\u{2013}");
        if round && core.ends_with(|c: char| c.is_ascii_digit()) {
            end.clear();
            closes = false;
        }
        let core = core.to_owned();
        Self {
            core,
            end,
            opens,
            closes,
            raw,
        }
    }

    /// Forgets that brackets, dashes and signs around it part or end anything.
    pub fn forget_signs(&mut self) {
        self.opens = false;
        self.closes = false;
        self.end.clear();
    }

    /// Returns true if a full stop follows immediately, which may belong to an abbreviation.
    #[must_use]
    pub fn dotted(&self) -> bool {
        self.end.starts_with('.')
    }

    /// Returns true if it consists of letters only, which need no processing.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.core.chars().all(|c| is_letter(c) || is_joiner(c))
    }

    /// Returns true if the word begins with a capital.
    #[must_use]
    pub fn is_capital(&self) -> bool {
        self.core.chars().next().is_some_and(char::is_uppercase)
    }
}

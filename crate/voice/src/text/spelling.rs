//! Names of letters, digits and signs; literal reading, telephone numbers, internet addresses, and
//! spelled capitals.
//!
//! A letter's name is a respelling that engines read correctly as a separate word (tested by
//! listening to espeak-ng); engines treat single letters as articles or prepositions.

use super::grammar::{Form, Grammars as _};
use super::language::Language;
use super::number;
use raconteur_base::text::capitals::is_pronounceable;

/// Names of a to z [English, German, Portuguese].
const LETTERS: [[&str; 3]; 26] = [
    ["eigh", "ah", "á"],
    ["bee", "beh", "bê"],
    ["see", "zeh", "cê"],
    ["dee", "deh", "dê"],
    ["ee", "eh", "éh"],
    ["ef", "eff", "efe"],
    ["jee", "geh", "guê"],
    ["eytch", "hah", "agá"],
    ["eye", "ih", "i"],
    ["jay", "jott", "jota"],
    ["kay", "kah", "capa"],
    ["ell", "ell", "ele"],
    ["em", "emm", "eme"],
    ["en", "enn", "ene"],
    ["oh", "oh", "ó"],
    ["pee", "peh", "pê"],
    ["cue", "kuh", "quê"],
    ["ar", "err", "erre"],
    ["ess", "ess", "esse"],
    ["tee", "teh", "tê"],
    ["you", "uh", "u"],
    ["vee", "fau", "vê"],
    ["double you", "weh", "dáblio"],
    ["ex", "iks", "xis"],
    ["why", "ypsilon", "ípsilon"],
    ["zee", "zett", "zê"],
];
/// Signs [English, German, Portuguese].
const SIGNS: &[(char, [&str; 3])] = &[
    ('.', ["dot", "Punkt", "ponto"]),
    (',', ["comma", "Komma", "vírgula"]),
    (';', ["semicolon", "Semikolon", "ponto e vírgula"]),
    (':', ["colon", "Doppelpunkt", "dois pontos"]),
    (
        '!',
        ["exclamation mark", "Ausrufezeichen", "ponto de exclamação"],
    ),
    (
        '?',
        ["question mark", "Fragezeichen", "ponto de interrogação"],
    ),
    ('\'', ["apostrophe", "Apostroph", "apóstrofo"]),
    ('\u{2019}', ["apostrophe", "Apostroph", "apóstrofo"]),
    ('"', ["quote", "Anführungszeichen", "aspas"]),
    ('(', ["open parenthesis", "Klammer auf", "abre parêntesis"]),
    (')', ["close parenthesis", "Klammer zu", "fecha parêntesis"]),
    (
        '[',
        [
            "open bracket",
            "eckige Klammer auf",
            "abre parêntesis recto",
        ],
    ),
    (
        ']',
        [
            "close bracket",
            "eckige Klammer zu",
            "fecha parêntesis recto",
        ],
    ),
    (
        '{',
        ["open brace", "geschweifte Klammer auf", "abre chaveta"],
    ),
    (
        '}',
        ["close brace", "geschweifte Klammer zu", "fecha chaveta"],
    ),
    ('-', ["dash", "Bindestrich", "hífen"]),
    ('\u{2013}', ["dash", "Gedankenstrich", "travessão"]),
    ('\u{2014}', ["dash", "Gedankenstrich", "travessão"]),
    ('_', ["underscore", "Unterstrich", "traço inferior"]),
    ('/', ["slash", "Schrägstrich", "barra"]),
    ('\\', ["backslash", "Rückstrich", "barra invertida"]),
    ('@', ["at", "ätt", "arroba"]),
    ('#', ["hash", "Raute", "cardinal"]),
    ('&', ["and", "und", "e"]),
    ('*', ["asterisk", "Stern", "asterisco"]),
    ('+', ["plus", "plus", "mais"]),
    ('=', ["equals", "gleich", "igual a"]),
    ('<', ["less than", "kleiner als", "menor que"]),
    ('>', ["greater than", "größer als", "maior que"]),
    ('%', ["percent", "Prozent", "por cento"]),
    ('\u{2030}', ["per mille", "Promille", "por mil"]),
    ('~', ["tilde", "Tilde", "til"]),
    ('^', ["caret", "Zirkumflex", "circunflexo"]),
    ('|', ["bar", "senkrechter Strich", "barra vertical"]),
    ('$', ["dollar", "Dollar", "dólar"]),
    ('\u{20ac}', ["euro", "Euro", "euro"]),
    ('\u{a3}', ["pound", "Pfund", "libra"]),
    ('\u{a5}', ["yen", "Yen", "iene"]),
    ('\u{a7}', ["section", "Paragraf", "parágrafo"]),
    ('\u{b0}', ["degrees", "Grad", "graus"]),
    ('\u{a9}', ["copyright", "Copyright", "direitos de autor"]),
    (
        '\u{ae}',
        ["registered", "eingetragene Marke", "marca registada"],
    ),
    ('\u{2122}', ["trademark", "Marke", "marca"]),
    ('\u{2026}', ["ellipsis", "Auslassungspunkte", "reticências"]),
    ('\u{d7}', ["times", "mal", "vezes"]),
    ('\u{f7}', ["divided by", "geteilt durch", "a dividir por"]),
    ('\u{b1}', ["plus or minus", "plus minus", "mais ou menos"]),
    ('\u{2212}', ["minus", "minus", "menos"]),
    ('\u{2260}', ["is not equal to", "ungleich", "diferente de"]),
    (
        '\u{2264}',
        [
            "less than or equal to",
            "kleiner gleich",
            "menor ou igual a",
        ],
    ),
    (
        '\u{2265}',
        [
            "greater than or equal to",
            "größer gleich",
            "maior ou igual a",
        ],
    ),
    (
        '\u{2248}',
        [
            "approximately equals",
            "ungefähr gleich",
            "aproximadamente igual a",
        ],
    ),
    (
        '\u{221a}',
        ["square root of", "Wurzel aus", "raiz quadrada de"],
    ),
    ('\u{221e}', ["infinity", "unendlich", "infinito"]),
    ('\u{3c0}', ["pi", "pi", "pi"]),
    ('\u{2192}', ["arrow", "Pfeil", "seta"]),
];
/// Names of the marks on letters: grave, acute, circumflex, tilde, diaeresis, ring,
/// caron, cedilla.
const MARKS: &[(char, [&str; 3])] = &[
    ('\u{300}', ["grave", "Gravis", "grave"]),
    ('\u{301}', ["acute", "Akut", "agudo"]),
    ('\u{302}', ["circumflex", "Zirkumflex", "circunflexo"]),
    ('\u{303}', ["tilde", "Tilde", "til"]),
    ('\u{308}', ["diaeresis", "Trema", "trema"]),
    ('\u{30a}', ["ring", "Ring", "anel"]),
    ('\u{30c}', ["caron", "Hatschek", "caron"]),
    ('\u{327}', ["cedilla", "Cedille", "cedilha"]),
];
/// Top-level domains by which a name with dots is recognised as an address.
const DOMAINS: &[&str] = &[
    "com", "org", "net", "edu", "gov", "info", "io", "de", "pt", "uk", "eu", "at", "ch", "br",
    "fr", "es", "us",
];

/// Returns the name of a sign; `None` if it has none.
pub(super) fn sign(c: char, language: Language) -> Option<&'static str> {
    SIGNS
        .iter()
        .find(|(sign, _)| *sign == c)
        .map(|(_, names)| language.pick(*names))
}

/// Returns the name of a character; `None` if it has none (space, emoji).
pub(super) fn character(c: char, language: Language) -> Option<String> {
    if let Some(digit) = c.to_digit(10) {
        return Some(language.grammar().cardinal(u64::from(digit), Form::Alone));
    }
    let lower = c.to_lowercase().next().unwrap_or(c);
    if lower.is_ascii_lowercase() {
        return Some(
            language
                .pick(LETTERS[(lower as usize - 'a' as usize) % 26])
                .to_owned(),
        );
    }
    let own = match (lower, language) {
        ('ä', Language::German) => Some("äh"),
        ('ö', Language::German) => Some("öh"),
        ('ü', Language::German) => Some("üh"),
        ('ß', _) => Some(language.pick(["sharp ess", "Esszett", "esse duplo"])),
        ('ç', Language::Portuguese) => Some("cê de cedilha"),
        _ => sign(c, language),
    };
    if let Some(name) = own {
        return Some(name.to_owned());
    }
    if let Some((base, mark)) = super::word::decomposed(lower) {
        let mark = MARKS.iter().find(|(sign, _)| *sign == mark)?;
        return Some(format!(
            "{} {}",
            character(base, language)?,
            language.pick(mark.1)
        ));
    }
    // A letter of another script: the engine may know it.
    c.is_alphabetic().then(|| c.to_string())
}

/// Returns the names of all characters of a text.
pub(super) fn literal(text: &str, language: Language) -> String {
    let names: Vec<String> = text
        .chars()
        .filter_map(|c| character(c, language))
        .take(super::WORD_TOKENS)
        .collect();
    names.join(" ")
}

/// Reads a telephone number: single digits, in the written groups; a long group is split in threes.
pub(super) fn phone(text: &str, language: Language) -> String {
    let mut groups: Vec<String> = Vec::new();
    for run in text
        .split(|c: char| !c.is_ascii_digit())
        .filter(|run| !run.is_empty())
    {
        let bytes: Vec<char> = run.chars().take(super::WORD_TOKENS).collect();
        let width = if bytes.len() > 4 { 3 } else { 4 };
        let mut rest = bytes.as_slice();
        while !rest.is_empty() {
            // No single digit is left at the end: 5551234 is 555 1234.
            let cut = if rest.len() <= 4 { rest.len() } else { width };
            let (group, tail) = rest.split_at(cut);
            groups.push(number::digits(&group.iter().collect::<String>(), language));
            rest = tail;
        }
    }
    let digits = groups.join(", ");
    match text.trim_start().starts_with('+') {
        true => format!("{} {digits}", sign('+', language).unwrap_or_default()),
        false => digits,
    }
}

/// Returns true if `text` looks like an e-mail address or a URL.
pub(super) fn is_net(text: &str) -> bool {
    if text.contains("://") || text.starts_with("www.") {
        return true;
    }
    if let Some((user, host)) = text.split_once('@') {
        return !user.is_empty() && host.contains('.') && !host.contains('@');
    }
    let host = text.split('/').next().unwrap_or_default();
    match host.rsplit_once('.') {
        Some((name, domain)) => {
            DOMAINS.contains(&domain)
                && name.chars().filter(|c| c.is_alphabetic()).count() > 2
                && name
                    .chars()
                    .all(|c| c.is_alphanumeric() || matches!(c, '.' | '-'))
        }
        None => false,
    }
}

/// Reads an e-mail address or URL, without the scheme, which is not spoken.
pub(super) fn net(text: &str, language: Language) -> String {
    let text = text.split_once("://").map_or(text, |(_, rest)| rest);
    let text = text
        .strip_prefix("mailto:")
        .unwrap_or(text)
        .trim_end_matches('/');
    let mut spoken: Vec<String> = Vec::new();
    let mut run = String::new();
    for c in text.chars().take(super::WORD_TOKENS).chain([' ']) {
        if c.is_alphabetic() {
            run.push(c);
            continue;
        }
        if !run.is_empty() {
            let word = std::mem::take(&mut run);
            let said = word == "com" || word == "org" || is_pronounceable(&word);
            spoken.push(if said { word } else { literal(&word, language) });
        }
        if c != ' ' {
            spoken.extend(character(c, language));
        }
    }
    spoken.join(" ")
}

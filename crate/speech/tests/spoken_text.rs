//! Text as written against text as spoken: tables of cases, every year's number, and what
//! must hold whatever is written.
#![cfg(feature = "bake")]

use raconteur_speech::text::{
    Lexicon, LexiconProblem, Order, SayAs, TOKEN_CHARS, Token, WORD_TOKENS, speakable,
};

fn joined(tokens: &[Token]) -> String {
    let words: Vec<String> =
        tokens.iter().map(|token| format!("{}{}", token.text, token.punctuation)).collect();
    words.join(" ")
}

/// As one line; with `|` between written words where `parted`.
fn spoken(text: &str, language: &str, say_as: Option<&SayAs>, parted: bool) -> String {
    let written: Vec<&str> = text.split_whitespace().collect();
    let spoken = speakable(&written, language, say_as, &Lexicon::default());
    assert_eq!(spoken.len(), written.len(), "{text}");
    if parted {
        let words: Vec<String> = spoken.iter().map(|tokens| joined(tokens)).collect();
        return words.join(" | ");
    }
    joined(&spoken.concat())
}

fn mode(name: &str) -> SayAs {
    match name {
        "literal" => SayAs::Literal,
        "date" => SayAs::Date(None),
        "dmy" => SayAs::Date(Some(Order::Dmy)),
        "mdy" => SayAs::Date(Some(Order::Mdy)),
        "ymd" => SayAs::Date(Some(Order::Ymd)),
        "ym" => SayAs::Date(Some(Order::Ym)),
        "my" => SayAs::Date(Some(Order::My)),
        "md" => SayAs::Date(Some(Order::Md)),
        "time" => SayAs::Time,
        "phone" => SayAs::Phone,
        "email" => SayAs::Net { email: true },
        "url" => SayAs::Net { email: false },
        "postal" => SayAs::Postal,
        "currency" => SayAs::Currency,
        "math" => SayAs::Math,
        "fraction" => SayAs::Fraction,
        "measure" => SayAs::Measure,
        "ordinal" => SayAs::Ordinal,
        "cardinal" => SayAs::Cardinal,
        "name" => SayAs::Name,
        other => panic!("no mode {other}"),
    }
}

/// Runs the table of a language: `in => out`, or `{mode} in => out`; an `out` with `|`
/// tells which tokens are of which written word.
fn table(text: &str, language: &str, least: usize) {
    let mut wrong = Vec::new();
    let mut cases = 0;
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")) {
        let (written, expected) = line.split_once(" => ").expect(line);
        let (say_as, written) = match written.strip_prefix('{') {
            Some(rest) => {
                let (name, written) = rest.split_once("} ").expect(line);
                (Some(mode(name)), written)
            }
            None => (None, written),
        };
        let found = spoken(written, language, say_as.as_ref(), expected.contains('|'));
        let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        if squeezed(&found) != squeezed(expected) {
            wrong.push(format!("{written}\n  expected {expected}\n  found    {found}"));
        }
        cases += 1;
    }
    assert!(wrong.is_empty(), "{} of {cases}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(cases >= least, "only {cases} cases");
}

#[test]
fn english_is_read_as_its_table_says() {
    table(include_str!("text/en.txt"), "en", 60);
}

#[test]
fn german_is_read_as_its_table_says() {
    table(include_str!("text/de.txt"), "de", 50);
}

#[test]
fn portuguese_is_read_as_its_table_says() {
    table(include_str!("text/pt.txt"), "pt-PT", 50);
}

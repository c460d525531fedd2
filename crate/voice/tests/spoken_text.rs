//! Written text compared with spoken text: tables of cases, every year's number, and invariants of
//! any text.

use raconteur_voice::text::{
    Lexicon, LexiconProblem, Order, SayAs, TOKEN_CHARS, Token, WORD_TOKENS, speakable,
};

fn joined(tokens: &[Token]) -> String {
    let words: Vec<String> = tokens
        .iter()
        .map(|token| format!("{}{}", token.text, token.punctuation))
        .collect();
    words.join(" ")
}

/// Returns the spoken text as one line; with `|` between written words if `parted`.
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

/// Runs the table of a language: `in => out`, or `{mode} in => out`; an `out` with `|` marks the
/// tokens of each written word.
fn table(text: &str, language: &str, least: usize) {
    let mut wrong = Vec::new();
    let mut cases = 0;
    for line in text
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with("# "))
    {
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
            wrong.push(format!(
                "{written}\n  expected {expected}\n  found    {found}"
            ));
        }
        cases += 1;
    }
    assert!(
        wrong.is_empty(),
        "{} of {cases}:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
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

fn lexicon(text: &str) -> Lexicon {
    Lexicon::parse(text).expect("a good lexicon")
}

#[test]
fn a_lexicon_goes_before_everything() {
    let lexicon = lexicon(
        "\u{feff}# for everybody\r\ngif = jiff   # not with a hard g\r\nC++ = see plus plus\n\
         [de]\nBeat = Beeaht\nKnabe = /ˈknaːbə/\n[*]\nDr. = Drummer\n",
    );
    assert!(
        !lexicon.is_empty() && Lexicon::default().is_empty(),
        "only the filled lexicon is not empty"
    );
    let say = |text: &str, language: &str| {
        let written: Vec<&str> = text.split_whitespace().collect();
        speakable(&written, language, None, &lexicon)
    };
    assert_eq!(
        joined(&say("A Gif, (C++)!", "en").concat()),
        "A jiff, see plus plus!"
    );
    assert_eq!(joined(&say("Dr. Beat", "en").concat()), "Drummer. Beat");
    let german = say("Der Beat: „Knabe“.", "de-AT").concat();
    assert_eq!(joined(&german), "Der Beeaht: Knabe.");
    assert_eq!(german[2].ipa.as_deref(), Some("ˈknaːbə"));
    assert!(
        german[1].ipa.is_none(),
        "a respelled word has no pronunciation"
    );
    // It also serves languages that are not read here.
    assert_eq!(joined(&say("un gif.", "fr").concat()), "un jiff.");
}

#[test]
fn a_bad_lexicon_is_told_its_line_and_column() {
    for (text, line, column, problem) in [
        ("a = b\nno sign", 2, 1, LexiconProblem::NoEquals),
        ("  two words = b", 1, 3, LexiconProblem::NoWord),
        ("= b", 1, 1, LexiconProblem::NoWord),
        ("ä = /a", 1, 5, LexiconProblem::OpenIpa),
        ("a = 12", 1, 5, LexiconProblem::NothingSaid),
        ("a = //", 1, 5, LexiconProblem::NothingSaid),
        ("a = /", 1, 5, LexiconProblem::OpenIpa),
        ("a =", 1, 4, LexiconProblem::NothingSaid),
        ("[d e]", 1, 1, LexiconProblem::BadHead),
        (
            "a = b\n[de]\na = c\n\na = d",
            5,
            1,
            LexiconProblem::Twice("a".to_owned()),
        ),
        (&"x".repeat(1001), 1, 1, LexiconProblem::TooLong),
    ] {
        let error = Lexicon::parse(text).expect_err(text);
        assert_eq!(
            (error.line, error.column, &error.problem),
            (line, column, &problem),
            "{text}"
        );
    }
}

#[test]
fn other_languages_keep_their_words() {
    assert_eq!(
        spoken("L’an 1998, à 14h : « déjà » !", "fr", None, true),
        "L’an | 1998, | à | 14h: |  |  | déjà! |  | "
    );
    assert_eq!(spoken("Привет, мир!", "ru", None, false), "Привет, мир!");
}

#[test]
fn the_region_orders_english_dates() {
    let american = "March fourth, nineteen ninety eight";
    let british = "the third of April, nineteen ninety eight";
    assert_eq!(spoken("3/4/1998", "en-US", None, false), american);
    assert_eq!(spoken("3/4/1998", "en", None, false), american);
    assert_eq!(spoken("3/4/1998", "en-GB", None, false), british);
}

#[test]
fn marks_apart_from_their_letters_are_joined_to_them() {
    assert_eq!(spoken("scho\u{308}n", "de", None, false), "schön");
    assert_eq!(
        spoken("corac\u{327}a\u{303}o", "pt", None, false),
        "coração"
    );
}

/// Returns a counter mixed by SplitMix64's finaliser, so that the cases are reproducible.
fn mixed(index: u64) -> u64 {
    let mut z = index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

const MODES: &[&str] = &[
    "literal", "date", "dmy", "mdy", "ymd", "ym", "my", "md", "time", "phone", "email", "url",
    "postal", "currency", "math", "fraction", "measure", "ordinal", "cardinal", "name",
];

/// Checks the invariants for any input.
fn check(written: &[&str], language: &str, say_as: Option<&SayAs>) {
    let spoken = speakable(written, language, say_as, &Lexicon::default());
    assert_eq!(spoken.len(), written.len());
    for (word, tokens) in written.iter().zip(&spoken) {
        assert!(tokens.len() <= WORD_TOKENS, "{word}");
        for token in tokens {
            let length = token.text.chars().count();
            assert!((1..=TOKEN_CHARS).contains(&length), "{word}: {token:?}");
            assert!(
                token.punctuation.chars().all(|c| ",.;:!?".contains(c)),
                "{word}: {token:?}"
            );
            assert!(token.punctuation.len() <= 3, "{word}: {token:?}");
            let allowed = |c: char| {
                c.is_alphabetic() || "'-".contains(c) || !c.is_ascii() && !c.is_alphanumeric()
            };
            if language != "fr" {
                assert!(token.text.chars().all(allowed), "{word}: {token:?}");
                assert!(
                    token.text.chars().any(char::is_alphabetic),
                    "{word}: {token:?}"
                );
            }
        }
    }
}

#[test]
fn whatever_is_written_is_spoken_within_bounds() {
    // Fragments with a meaning for the readers, and any character.
    let fragments = [
        "1", "12", "1998", "007", "½", "²", "º", "ª", ".º", "st", ".", ",", "/", "-", "–", "—",
        "…", ":", "'", "’", "\"", "„", "(", ")", "$", "€", "R$", "%", "°C", "km", "km/h", "@", "#",
        "&", "+", "−", "^", "=", "<=", "h", "pm", "a.m.", "Uhr", "XIV", "I", "z", "B", "p", "ex",
        "Mio", "million", "milhões", "Dr", "St", "No", "Nr", "n", "www.", "http://", ".com", "A",
        "é", "ß", "\u{301}", "\u{200d}", "\u{feff}", "😀", "字", "ا", "\0", "ª", "Henry",
        "Ludwigs", "am", "der", "December", "s", "er", "te",
    ];
    for round in 0..20_000u64 {
        let mut words: Vec<String> = Vec::new();
        for word in 0..1 + mixed(round) % 5 {
            let mut text = String::new();
            for part in 0..mixed(round * 31 + word) % 6 {
                let pick = mixed(round * 977 + word * 31 + part);
                if pick.is_multiple_of(5) {
                    text.extend(char::from_u32((pick >> 8) as u32 % 0x11_0000));
                } else {
                    text += fragments[(pick >> 8) as usize % fragments.len()];
                }
            }
            words.push(text);
        }
        let written: Vec<&str> = words.iter().map(String::as_str).collect();
        let language = ["en", "de", "pt", "fr"][(round % 4) as usize];
        let say_as = MODES
            .get((round / 4) as usize % (2 * MODES.len()))
            .map(|name| mode(name));
        check(&written, language, say_as.as_ref());
    }
}

#[test]
fn long_words_are_bounded() {
    let digits = "1234567890".repeat(1000);
    let letters = "ab".repeat(20_000);
    let signs = "+@#€½".repeat(4000);
    let dashes = vec!["—"; 20_000];
    for language in ["en", "de", "pt", "fr"] {
        for name in MODES {
            for word in [&digits, &letters, &signs] {
                check(&[word], language, Some(&mode(name)));
            }
        }
        for word in [&digits, &letters, &signs] {
            check(&[word, "€", word], language, None);
        }
        check(&dashes, language, None);
    }
    assert_eq!(
        spoken(&"7".repeat(19), "en", None, false)
            .split(' ')
            .count(),
        19
    );
}

#[test]
fn plain_words_pass_unchanged() {
    let letters = [
        'a', 'e', 'n', 'r', 's', 't', 'l', 'ö', 'ã', 'ß', 'ç', 'é', 'm', 'k',
    ];
    for round in 0..3000u64 {
        let length = 6 + mixed(round) % 8;
        let mut word: String = (0..length)
            .map(|at| letters[mixed(round * 37 + at) as usize % letters.len()])
            .collect();
        if round.is_multiple_of(3) {
            word.insert(0, 'Z');
        }
        for language in ["en", "de", "pt"] {
            assert_eq!(spoken(&word, language, None, false), word);
        }
    }
}

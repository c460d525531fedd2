//! Numbers in words, read back: an independent inverse of each language's grammar.

use raconteur_voice::text::{Lexicon, SayAs, speakable};

fn spoken(n: u64, language: &str) -> String {
    let digits = n.to_string();
    let tokens = speakable(
        &[&digits],
        language,
        Some(&SayAs::Cardinal),
        &Lexicon::default(),
    );
    let words: Vec<&str> = tokens[0].iter().map(|token| token.text.as_str()).collect();
    words.join(" ")
}

/// Numerals by their effect on the current value: addition or multiplication.
type Numerals = [(&'static str, u64)];

const ENGLISH: &Numerals = &[
    ("zero", 0),
    ("one", 1),
    ("two", 2),
    ("three", 3),
    ("four", 4),
    ("five", 5),
    ("six", 6),
    ("seven", 7),
    ("eight", 8),
    ("nine", 9),
    ("ten", 10),
    ("eleven", 11),
    ("twelve", 12),
    ("thirteen", 13),
    ("fourteen", 14),
    ("fifteen", 15),
    ("sixteen", 16),
    ("seventeen", 17),
    ("eighteen", 18),
    ("nineteen", 19),
    ("twenty", 20),
    ("thirty", 30),
    ("forty", 40),
    ("fifty", 50),
    ("sixty", 60),
    ("seventy", 70),
    ("eighty", 80),
    ("ninety", 90),
    ("and", 0),
    ("hundred", 100),
    ("thousand", 1000),
    ("million", 1_000_000),
    ("billion", 1_000_000_000),
    ("trillion", 1_000_000_000_000),
    ("quadrillion", 1_000_000_000_000_000),
];
const GERMAN: &Numerals = &[
    ("null", 0),
    ("eine", 1),
    ("eins", 1),
    ("ein", 1),
    ("zwei", 2),
    ("drei", 3),
    ("vier", 4),
    ("fünf", 5),
    ("sechs", 6),
    ("sieben", 7),
    ("acht", 8),
    ("neun", 9),
    ("zehn", 10),
    ("elf", 11),
    ("zwölf", 12),
    ("sechzehn", 16),
    ("siebzehn", 17),
    ("zwanzig", 20),
    ("dreißig", 30),
    ("vierzig", 40),
    ("fünfzig", 50),
    ("sechzig", 60),
    ("siebzig", 70),
    ("achtzig", 80),
    ("neunzig", 90),
    ("und", 0),
    ("hundert", 100),
    ("tausend", 1000),
    ("Millionen", 1_000_000),
    ("Million", 1_000_000),
    ("Milliarden", 1_000_000_000),
    ("Milliarde", 1_000_000_000),
    ("Billionen", 1_000_000_000_000),
    ("Billion", 1_000_000_000_000),
    ("Billiarde", 1_000_000_000_000_000),
];
const PORTUGUESE: &Numerals = &[
    ("zero", 0),
    ("um", 1),
    ("dois", 2),
    ("três", 3),
    ("quatro", 4),
    ("cinco", 5),
    ("seis", 6),
    ("sete", 7),
    ("oito", 8),
    ("nove", 9),
    ("dez", 10),
    ("onze", 11),
    ("doze", 12),
    ("treze", 13),
    ("catorze", 14),
    ("quinze", 15),
    ("dezasseis", 16),
    ("dezassete", 17),
    ("dezoito", 18),
    ("dezanove", 19),
    ("vinte", 20),
    ("trinta", 30),
    ("quarenta", 40),
    ("cinquenta", 50),
    ("sessenta", 60),
    ("setenta", 70),
    ("oitenta", 80),
    ("noventa", 90),
    ("e", 0),
    ("cem", 100),
    ("cento", 100),
    ("duzentos", 200),
    ("trezentos", 300),
    ("quatrocentos", 400),
    ("quinhentos", 500),
    ("seiscentos", 600),
    ("setecentos", 700),
    ("oitocentos", 800),
    ("novecentos", 900),
    ("mil", 1000),
    ("milhão", 1_000_000),
    ("milhões", 1_000_000),
    ("bilião", 1_000_000_000_000),
    ("biliões", 1_000_000_000_000),
];

/// Returns the value of number words; `run_together` for German, where the longest matching numeral
/// comes first ("zehn" follows "drei" in "dreizehn" and adds to it).
fn value(words: &str, numerals: &Numerals, run_together: bool) -> Option<u64> {
    let mut values = Vec::new();
    for word in words.split(' ') {
        let mut rest = word;
        while !rest.is_empty() {
            let fits = |(name, _): &&(&str, u64)| {
                if run_together {
                    rest.starts_with(name)
                } else {
                    rest == *name
                }
            };
            let (name, value) = numerals
                .iter()
                .filter(fits)
                .max_by_key(|(name, _)| name.len())?;
            values.push(*value);
            rest = &rest[name.len()..];
        }
    }
    // Portuguese hundreds are separate words; those of the others multiply.
    let multiplies = |value: u64| value >= 1000 || value == 100 && numerals != PORTUGUESE;
    let (mut whole, mut group) = (0, 0);
    for value in values {
        if !multiplies(value) {
            group += value;
        } else if value >= 1_000_000 {
            whole += group.max(1) * value;
            group = 0;
        } else if value == 1000 {
            group = group.max(1) * 1000;
        } else {
            // Only the last count of the group is of hundreds: 2000 + 3 hundred.
            let count = group % 1000;
            group += count * 100 - count;
        }
    }
    Some(whole + group)
}

fn cases() -> impl Iterator<Item = u64> {
    let mixed = (1..3000u64).map(|index| {
        let scattered = index.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 13;
        scattered % 10u64.pow(4 + (index % 12) as u32)
    });
    (0..=2000)
        .chain(mixed)
        .chain([1_000_000_000_000_000, 999_999_999_999_999])
}

#[test]
fn number_words_mean_their_number() {
    for n in cases() {
        for (language, numerals) in [("en", ENGLISH), ("de", GERMAN), ("pt", PORTUGUESE)] {
            let words = spoken(n, language);
            assert_eq!(
                value(&words, numerals, language == "de"),
                Some(n),
                "{language}: {words}"
            );
        }
    }
}

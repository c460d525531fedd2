//! Agreement of text sources: the same text has the same words, sentences and readings in EML,
//! typed in a box, written between tags, and streamed in pieces; and captions contain the whole
//! text.

use raconteur_eml::narration::{NarrationOptions, continue_narration, narrate, split_clauses};
use raconteur_eml::{ClauseKind, VoiceText, parse};
use raconteur_voice::plan::{Plan, plan};
use raconteur_voice::text::Lexicon;
use raconteur_voice::{Source, speech_requests};

/// Spoken and displayed form of a text.
#[derive(Debug, PartialEq)]
struct SpokenAndShown {
    /// With their signs, as captions show them.
    words: Vec<String>,
    /// The tokens of each word, joined.
    spoken: Vec<String>,
    /// Indices of the words with which sentences begin, but the first.
    begins: Vec<usize>,
}

fn add(heard: &mut SpokenAndShown, plan: &Plan, shown: Vec<String>, is_whole: bool) {
    let base = heard.words.len();
    assert_eq!(
        plan.words, shown,
        "captions of the document and of the bundle"
    );
    heard.words.extend(shown);
    heard.spoken.resize(heard.words.len(), String::new());
    for (at, sentence) in plan.sentences.iter().enumerate() {
        for token in &sentence.sentence.tokens {
            let word = &mut heard.spoken[base + token.word];
            *word += &format!("{} ", token.text);
        }
        let first = sentence
            .sentence
            .tokens
            .first()
            .map_or(0, |token| base + token.word);
        if base > 0 && at == 0 || at > 0 && is_whole {
            heard.begins.push(first);
        }
    }
    assert!(
        is_whole || plan.sentences.len() <= 1,
        "a clause is one sentence: {:?}",
        plan.words
    );
}

/// Returns the spoken and displayed form of scripts; `is_whole` means that a clause may have
/// several sentences.
fn heard_of<'s>(
    scripts: impl IntoIterator<Item = &'s str>,
    language: &str,
    is_whole: bool,
) -> SpokenAndShown {
    let mut heard = SpokenAndShown {
        words: Vec::new(),
        spoken: Vec::new(),
        begins: Vec::new(),
    };
    for script in scripts {
        let parsed = parse(script);
        assert!(
            parsed.diagnostics.is_empty(),
            "{script}: {:?}",
            parsed.diagnostics
        );
        let shown = parsed
            .document
            .clauses
            .iter()
            .filter_map(|clause| match &clause.kind {
                ClauseKind::VoiceText(text) => Some(shown(text)),
                _ => None,
            });
        for (request, shown) in speech_requests(&parsed.document).iter().zip(shown) {
            let Source::Content(content) = &request.source else {
                panic!("{request:?}");
            };
            let plan = plan(content, language, "test", &Lexicon::default()).unwrap();
            add(&mut heard, &plan, shown, is_whole);
        }
    }
    heard
}

fn shown(text: &VoiceText) -> Vec<String> {
    text.words().into_iter().map(|word| word.text).collect()
}

fn in_eml(text: &str, language: &str) -> SpokenAndShown {
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
    let script = format!("<eml><body><voice-text time='0'>{escaped}</voice-text></body></eml>");
    heard_of([script.as_str()], language, true)
}

fn in_box(text: &str, language: &str, is_phrased: bool) -> SpokenAndShown {
    let telling = NarrationOptions {
        language,
        is_phrased,
        max_chars: 100_000,
    };
    let script = narrate(text, &telling).unwrap();
    heard_of([script.as_str()], language, false)
}

fn in_pieces(text: &str, length: usize, language: &str) -> SpokenAndShown {
    let chars: Vec<char> = text.chars().collect();
    let (mut rest, mut clauses) = (String::new(), Vec::new());
    for piece in chars.chunks(length) {
        rest.extend(piece);
        let found = split_clauses(&rest, language, false);
        clauses.extend(found.clauses.iter().map(|clause| (*clause).to_owned()));
        rest = found.rest.to_owned();
    }
    clauses.extend(
        split_clauses(&rest, language, true)
            .clauses
            .iter()
            .map(|clause| (*clause).to_owned()),
    );
    let told: Vec<String> = clauses
        .iter()
        .filter_map(|clause| Some(continue_narration(clause, language, "neutral")?.fragment))
        .collect();
    heard_of(told.iter().map(String::as_str), language, false)
}

/// Elements of generated texts in each language: abbreviations with possible following words, ends
/// of sentences, capitals, symbols and numbers.
struct Rules {
    language: &'static str,
    abbreviated: &'static [&'static str],
    plain: &'static [&'static str],
    capitals: &'static [&'static str],
    symbols: &'static [&'static str],
    numbers: &'static [&'static str],
    ends: &'static [&'static str],
}

const RULES: [Rules; 3] = [
    Rules {
        language: "en",
        abbreviated: &[
            "Dr. Lee met",
            "at 5 p.m. we saw",
            "J. R. R. Tolkien wrote",
            "e.g. London had",
            "No. 7 is",
            "Prof. Dr. Klee took",
            "the U.S. Army sent",
            "Mr. and Mrs. Brown ate",
            "vs. Spain we won",
            "St. Ives lost",
            "on Main St. we met",
            "Smith & Co. Ltd. sold",
            "cf. Fig. 3 and",
            "p. 12 shows",
        ],
        plain: &[
            "the old man",
            "a red cat",
            "nobody",
            "she",
            "his house by the sea",
            "everything we know",
        ],
        capitals: &[
            "NASA",
            "the US",
            "the WHO",
            "the BBC",
            "HELP ME",
            "the END",
            "A HUGE dog",
            "NO",
            "our IT team",
            "CDs",
            "STOP RIGHT NOW",
            "HTML",
            "a US-based firm",
            "IT WAS MY CAT",
            "AT&T",
        ],
        symbols: &[
            "5 % of",
            "2 + 2 = 4 and",
            "Fox & Cub",
            "~ 10",
            "€ 5 or 5 €",
            "— so —",
            "a × b",
            "< 3 >",
            "§ 5",
            "“ quoted ”",
        ],
        numbers: &[
            "1,000,000",
            "3.50",
            "10:30",
            "the 3rd",
            "1999",
            "50/50",
            "5 km",
            "World War II",
            "the XIX century",
            "May 5, 1990",
            "-3.5 °C",
        ],
        ends: &[
            ".",
            "!",
            "?",
            "…",
            ".\u{201d}",
            "!?",
            ", and then",
            "; so",
            ":",
            " — but",
        ],
    },
    Rules {
        language: "de",
        abbreviated: &[
            "z. B. Berlin hat",
            "Dr. Klee kam",
            "d.h. Montag",
            "Herr Prof. Dr. Lang aß",
            "bzw. Anna",
            "Nr. 7 ist",
            "am 3. Oktober war",
            "die 2. Tür",
            "Ludwig XIV. sah",
            "am 24.12. kommt",
            "usw. Danach ging",
            "ca. Hundert",
            "St. Pauli verlor",
        ],
        plain: &[
            "der alte Mann",
            "eine Katze",
            "niemand",
            "sie",
            "sein Haus am Meer",
        ],
        capitals: &[
            "die NASA",
            "die EU",
            "DAS IST MEIN HUND",
            "HILFE",
            "der US-Präsident",
            "ARD und ZDF",
            "NEIN",
            "CDs",
            "die GmbH",
        ],
        symbols: &[
            "5 % von",
            "2 + 2 = 4 und",
            "Fuchs & Sohn",
            "€ 5 oder 5 €",
            "— so —",
            "§ 5",
            "„ ja “",
        ],
        numbers: &[
            "1.250,50 €",
            "14:30 Uhr",
            "30 km/h",
            "1/2 Liter",
            "1999",
            "3,5 °C",
            "50/50",
        ],
        ends: &[".", "!", "?", "…", "!?", ", und dann", "; so", ":"],
    },
    Rules {
        language: "pt",
        abbreviated: &[
            "o Sr. João viu",
            "a Dra. Ana",
            "p. ex. Lisboa tem",
            "o n.º 7 é",
            "a Sra. D. Maria",
            "etc. Depois",
            "o séc. XIX foi",
            "a pág. 12",
            "D. João II viu",
        ],
        plain: &["o velho", "uma gata", "ninguém", "ela", "a casa dele"],
        capitals: &[
            "a NASA",
            "a UE",
            "os EUA",
            "NÃO VÁS JÁ",
            "SOCORRO",
            "a RTP",
            "o IVA",
            "CDs",
        ],
        symbols: &[
            "5 % de",
            "2 + 2 = 4 e",
            "Costa & Filhos",
            "€ 5 ou 5 €",
            "— assim —",
            "§ 5",
        ],
        numbers: &[
            "1.250,50 €",
            "14:30",
            "30 km/h",
            "1/2 litro",
            "1999",
            "3,5 °C",
            "50/50",
        ],
        ends: &[".", "!", "?", "…", "!?", ", e depois", "; assim", ":"],
    },
];

/// A text of two to five parts, each of one of the kinds and with an end.
fn text_of(rules: &Rules, kind: usize, seed: i64) -> String {
    let mut at = 0;
    let mut unit = || {
        at += 1;
        raconteur_base::noise::unit(seed as u64, kind as u64, at)
    };
    let mut pick = |list: &[&'static str]| list[(unit() * list.len() as f64) as usize % list.len()];
    let own = [
        rules.abbreviated,
        rules.capitals,
        rules.symbols,
        rules.numbers,
    ][kind];
    let mut text = String::new();
    for part in 0..2 + seed % 4 {
        let mut words = [pick(own), pick(rules.plain)];
        if seed % 3 == part % 3 {
            words.reverse();
        }
        let mut words = words.join(" ");
        if part % 2 == 0 && text.ends_with(['.', '!', '?', '…']) {
            let first = words.chars().next().unwrap();
            words = first.to_uppercase().chain(words.chars().skip(1)).collect();
        }
        if !text.is_empty() {
            text.push(' ');
        }
        text += &words;
        text += pick(rules.ends);
    }
    text
}

#[test]
fn a_text_is_the_same_in_eml_in_a_box_and_in_pieces() {
    let mut sentences = 0;
    for rules in &RULES {
        for kind in 0..4 {
            for seed in 0..200 {
                let text = text_of(rules, kind, seed);
                let language = rules.language;
                let eml = in_eml(&text, language);
                assert_eq!(in_box(&text, language, false), eml, "{text}");
                let phrased = in_box(&text, language, true);
                assert_eq!((&phrased.words, &phrased.spoken), (&eml.words, &eml.spoken));
                for length in [1, 2, 3, 4, 5, 6, 7] {
                    let told = in_pieces(&text, length, language);
                    assert_eq!(told.words, eml.words, "{length}: {text}");
                    assert_eq!(told.spoken, eml.spoken, "{length}: {text}");
                    for begin in &eml.begins {
                        assert!(
                            told.begins.contains(begin),
                            "{begin} of {told:?}, {length}: {text}"
                        );
                    }
                }
                // Captions have all that is written.
                let shown: String = eml.words.concat();
                let bare = |text: &str| {
                    text.chars()
                        .filter(|c| !c.is_whitespace())
                        .collect::<String>()
                };
                assert_eq!(bare(&shown), bare(&text), "{text}");
                sentences += eml.begins.len();
            }
        }
    }
    assert!(sentences > 1000, "{sentences}");
}

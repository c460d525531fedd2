//! Audio with times from another program: its words are matched to tokens by order and spelling.

use crate::align::{Alignment, IPA, Units, phone_of_viseme};
use crate::ipa;
use crate::spoken::Spoken;
use anyhow::{Result, ensure};
use raconteur_speech::bundle::SILENCE;
use raconteur_speech::phones;

use super::labels::{self, Labels, Phone};
use super::matching;
use super::wave::Wave;

/// Share of the tokens that must be found.
const MIN_FOUND: f64 = 0.5;

/// Maximum number of unknown phones listed.
const MAX_UNKNOWN: usize = 12;

/// Combines audio and alignment. `tokens` are the expected words; `phone_set` applies if the
/// alignment does not specify one. Mouth shapes become phones that look like them; if there are
/// only words, each is spelled with one phone per letter, of equal lengths.
///
/// # Errors
/// Returns an error if fewer than half of the tokens are among the words, or in the same cases as
/// [`labels::finish`].
pub(super) fn combine(
    alignment: &Alignment,
    wave: Wave,
    tokens: &[&str],
    phone_set: &str,
) -> Result<Spoken> {
    let token_of = tokens_of(alignment, tokens)?;
    let mut labels = Labels::default();
    let set = match &alignment.units {
        Units::Phones { set: Some(IPA) } => {
            times(alignment, &token_of, &mut labels, |label| {
                ipa::in_sampa(label).unwrap_or_else(|| vec![label])
            });
            "sampa"
        }
        Units::Phones { set } => {
            times(alignment, &token_of, &mut labels, |label| vec![label]);
            set.unwrap_or(phone_set)
        }
        Units::Visemes { set } => {
            times(alignment, &token_of, &mut labels, |label| {
                vec![phone_of_viseme(*set, label).unwrap_or(SILENCE)]
            });
            "radio"
        }
        Units::None => {
            spell(alignment, &token_of, tokens, &mut labels);
            "radio"
        }
    };
    accents(alignment, &mut labels);
    labels::finish(&labels, wave, set, 0.0)
}

/// Returns the phones of an alignment unknown to the mouth, each once, in order.
pub(super) fn unknown_phones<'a>(alignment: &'a Alignment, phone_set: &str) -> Vec<&'a str> {
    let Units::Phones { set } = alignment.units else {
        return Vec::new();
    };
    let set = set.unwrap_or(phone_set);
    let known = |label: &str| match set {
        IPA => ipa::in_sampa(label).is_some(),
        set => labels::is_silence(label) || phones::find(set, label).is_some(),
    };
    let mut unknown: Vec<&str> = Vec::new();
    for segment in &alignment.segments {
        let label = segment.label.as_str();
        if !label.is_empty() && !known(label) && !unknown.contains(&label) {
            unknown.push(label);
        }
        if unknown.len() == MAX_UNKNOWN {
            break;
        }
    }
    unknown
}

/// Returns the token index of each aligned word; `None` for a word without a token.
fn tokens_of(alignment: &Alignment, tokens: &[&str]) -> Result<Vec<Option<usize>>> {
    let known: Vec<String> = tokens.iter().map(|t| folded(t)).collect();
    let heard: Vec<String> = alignment.words.iter().map(|w| folded(&w.label)).collect();
    let pairs = matching::matched(&known, &heard, |k, h| {
        if k == h {
            0
        } else if k.starts_with(h.as_str()) || h.starts_with(k.as_str()) {
            2
        } else {
            // Another spelling, such as a number in words, at the same position.
            5
        }
    })?;
    let found = pairs.iter().flatten().count();
    ensure!(
        alignment.words.is_empty() || found as f64 >= MIN_FOUND * tokens.len() as f64,
        "it has {} words, of which {found} are among the {} of the text",
        heard.len(),
        tokens.len()
    );
    // A pair may be two spellings of one word, mostly numbers; if almost none are equal, the
    // alignment belongs to another text.
    let is_same = |(heard, at): (&String, &Option<usize>)| {
        at.and_then(|at| known.get(at)).is_some_and(|known| {
            known.starts_with(heard.as_str()) || heard.starts_with(known.as_str())
        }) || heard.contains(|c: char| c.is_ascii_digit())
    };
    let same = heard
        .iter()
        .zip(&pairs)
        .filter(|pair| is_same(*pair))
        .count();
    ensure!(
        alignment.words.is_empty() || 4 * same >= heard.len().min(tokens.len()),
        "of its {} words {same} are those of the text: it is of something else",
        heard.len()
    );
    // A word that is no token is a part of the one before it: 25 is two words.
    let mut last = pairs.iter().flatten().next().copied();
    Ok(pairs
        .into_iter()
        .map(|pair| {
            last = pair.or(last);
            last
        })
        .collect())
}

/// Letters and digits, small, without accents.
fn folded(text: &str) -> String {
    deunicode::deunicode(text)
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .map(|c| c.to_ascii_lowercase())
        .collect()
}

/// Copies the segments; one with several phones is divided evenly between them.
fn times<'a>(
    alignment: &'a Alignment,
    token_of: &[Option<usize>],
    labels: &mut Labels,
    phones: impl Fn(&'a str) -> Vec<&'a str>,
) {
    let syllable = |i: usize| {
        let after = alignment
            .syllables
            .partition_point(|s| s.first_segment <= i);
        let last = after.checked_sub(1)?;
        let s = alignment.syllables[last];
        (i < s.first_segment + s.count).then_some(last)
    };
    for (i, segment) in alignment.segments.iter().enumerate() {
        let word = alignment.word_of(i);
        let symbols = phones(&segment.label);
        let (count, length_secs) = (symbols.len(), segment.end_secs - segment.start_secs);
        for (k, symbol) in symbols.into_iter().enumerate() {
            // The last one ends with the segment, to the bit.
            let left = (count - 1 - k) as f64 / count as f64;
            labels.phones.push(Phone {
                token: word.and_then(|w| token_of.get(w).copied().flatten()),
                symbol: symbol.to_owned(),
                end_secs: segment.end_secs - length_secs * left,
                syllable: syllable(i),
            });
        }
    }
    labels.syllables = alignment
        .syllables
        .iter()
        .map(|s| (s.stress.min(2), String::new()))
        .collect();
}

/// Spells words, and signs as the text reads them. *Designed*: the phone of the radio set that each
/// letter most resembles visually.
fn spell(alignment: &Alignment, token_of: &[Option<usize>], tokens: &[&str], labels: &mut Labels) {
    const LETTERS: [&str; 26] = [
        "ae", "b", "k", "d", "eh", "f", "g", "hh", "ih", "jh", "k", "l", "m", "n", "ao", "p", "k",
        "r", "s", "t", "uh", "v", "w", "s", "iy", "z",
    ];
    let mut end_secs = 0.0;
    let mut before = None;
    for (word, token) in alignment.words.iter().zip(token_of) {
        if word.start_secs > end_secs {
            labels.phones.push(Phone {
                symbol: SILENCE.to_owned(),
                end_secs: word.start_secs,
                ..Phone::default()
            });
        }
        let mut letters = folded(&word.label);
        if letters.is_empty() {
            // A sign that is not read aloud is part of the preceding word.
            let own = token.filter(|t| before != Some(*t));
            let read = own.and_then(|t| tokens.get(t)).map(|t| folded(t));
            letters = read.filter(|r| !r.is_empty()).unwrap_or("e".to_owned());
        }
        before = *token;
        let phones: Vec<&str> = letters
            .bytes()
            .map(|b| {
                LETTERS
                    .get(usize::from(b.wrapping_sub(b'a')))
                    .unwrap_or(&"ax")
            })
            .copied()
            .collect();
        let count = phones.len() as f64;
        let length_secs = word.end_secs - word.start_secs;
        for (i, symbol) in phones.into_iter().enumerate() {
            labels.phones.push(Phone {
                symbol: symbol.to_owned(),
                end_secs: word.start_secs + length_secs * (i + 1) as f64 / count,
                token: *token,
                syllable: None,
            });
        }
        end_secs = word.end_secs;
    }
}

/// Assigns accents to syllables and ends to phrases.
fn accents(alignment: &Alignment, labels: &mut Labels) {
    for accent in &alignment.accents {
        let at = labels
            .phones
            .partition_point(|p| p.end_secs < accent.at_secs);
        if let Some(s) = labels.phones.get(at).and_then(|p| p.syllable)
            && let Some((_, label)) = labels.syllables.get_mut(s)
        {
            label.clone_from(&accent.label);
        }
    }
    for tone in &alignment.tones {
        // The end of a phrase is the end of its last phone, or a rounding away.
        let end = labels
            .phones
            .partition_point(|p| p.end_secs < tone.at_secs + 0.005);
        let last = labels.phones[..end]
            .iter()
            .rev()
            .find(|p| !labels::is_silence(&p.symbol))
            .and_then(|p| p.token);
        if let Some(last) = last
            && labels.breaks.last().is_none_or(|b| b.0 < last)
        {
            labels.breaks.push((last, tone.label.clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::align::{Format, read};

    const MARY: &str = r#"<maryxml xmlns="http://mary.dfki.de/2002/MaryXML" version="0.5" xml:lang="en-US"><p><s><phrase>
        <t accent="H*" ph="' h @ l">Hullo<syllable accent="H*" ph="h @" stress="1"><ph d="100" end="0.1" p="h"/><ph d="100" end="0.2" p="@"/><ph d="100" end="0.3" p="l"/></syllable></t>
        <t>,</t><t ph="j u">you<syllable ph="j u"><ph d="100" end="0.4" p="j"/><ph d="100" end="0.5" p="u:"/></syllable></t>
        <boundary breakindex="5" tone="L-L%" duration="100"/></phrase></s></p></maryxml>"#;

    fn silence(secs: f64) -> Wave {
        Wave {
            samples: vec![0.0; (secs * 1000.0) as usize],
            rate_hz: 1000.0,
        }
    }

    #[test]
    fn phones_find_tokens_through_words() {
        let alignment = read(Format::MaryXml, MARY.as_bytes()).unwrap();
        let spoken = combine(&alignment, silence(0.7), &["Hullo", "you"], "sampa").unwrap();
        let tokens: Vec<Option<usize>> = spoken.segments.iter().map(|s| s.token).collect();
        let expected = [Some(0), Some(0), Some(0), Some(1), Some(1), None];
        assert_eq!(tokens, expected);
        assert_eq!(spoken.syllables[0].accent, "H*");
        assert_eq!(
            (spoken.syllables[0].stress, spoken.syllables[1].stress),
            (1, 0)
        );
        assert_eq!(spoken.breaks, [(1, "L-L%".to_owned())]);
        assert!(
            combine(
                &alignment,
                silence(0.7),
                &["a", "b", "c", "d", "e"],
                "sampa"
            )
            .is_err(),
            "words that do not match the alignment are rejected"
        );
    }

    #[test]
    fn phones_in_ipa_move_the_mouth_as_those_of_arpabet_do() {
        let grid = |phones: [&str; 6]| {
            let mut text =
                "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n0 0.6 <exists> 2\n\
                \"IntervalTier\" \"words\" 0 0.6 2 0 0.3 \"you\" 0.3 0.6 \"raise\"\n\
                \"IntervalTier\" \"phones\" 0 0.6 6\n"
                    .to_owned();
            for (i, phone) in phones.iter().enumerate() {
                let (from, to) = (i as f64 / 10.0, (i + 1) as f64 / 10.0);
                text += &format!("{from} {to} \"{phone}\"\n");
            }
            read(Format::TextGrid, text.as_bytes()).unwrap()
        };
        let rows = |alignment: &Alignment| {
            let spoken = combine(alignment, silence(0.6), &["you", "raise"], "radio").unwrap();
            let rows = spoken.segments.iter().filter(|s| !s.is_silent());
            let rows = rows.map(|s| phones::find(&spoken.phone_set, &s.symbol).unwrap().name);
            rows.collect::<Vec<_>>()
        };
        let arpabet = grid(["Y", "UW1", "", "R", "EY1", "Z"]);
        let ipa = grid(["j", "ʉː", "", "ɹ", "ej", "z"]);
        assert_eq!(rows(&ipa), rows(&arpabet));
        assert!(
            unknown_phones(&ipa, "radio").is_empty(),
            "all IPA phones exist in the radio set"
        );
        let odd = grid(["j", "ʉː", "n", "ɹ", "ej", "ʘ"]);
        assert_eq!(unknown_phones(&odd, "radio"), ["ʘ"]);
        let other = grid(["Y", "UW1", "spn", "R", "EY1", "spn"]);
        assert_eq!(unknown_phones(&other, "radio"), ["spn"]);
    }

    #[test]
    fn a_sign_is_spelled_as_it_is_read() {
        let vtt = "WEBVTT\n\n00:00.000 --> 00:00.300\nup\n\n00:00.300 --> 00:00.600\n&\n";
        let alignment = read(Format::WebVtt, vtt.as_bytes()).unwrap();
        let spoken = combine(&alignment, silence(0.6), &["Up", "and"], "radio").unwrap();
        let own = spoken.segments.iter().filter(|s| s.token == Some(1));
        let symbols: Vec<&str> = own.map(|s| s.symbol.as_str()).collect();
        assert_eq!(symbols, ["ae", "n", "d"]);
    }

    #[test]
    fn words_of_another_text_are_refused() {
        let words = |all: &[&str]| {
            let cues = all
                .iter()
                .enumerate()
                .map(|(i, word)| format!("00:0{i}.000 --> 00:0{i}.900\n{word}\n\n"));
            let vtt = format!("WEBVTT\n\n{}", cues.collect::<String>());
            read(Format::WebVtt, vtt.as_bytes()).unwrap()
        };
        let text = ["We", "lit", "the", "lamp"];
        for wrong in [&["big", "red", "fast", "cars"][..], &["big", "red", "fast"]] {
            let told = tokens_of(&words(wrong), &text).unwrap_err().to_string();
            assert!(told.contains("something else"), "{told}");
        }
        for right in [
            &["We", "lit", "the", "lamp"][..],
            &["we", "lid", "the", "lamb"],
        ] {
            assert!(tokens_of(&words(right), &text).is_ok(), "{right:?}");
        }
        assert!(
            tokens_of(&words(&["25"]), &["twenty", "five"]).is_ok(),
            "a number in digits matches its words"
        );
    }

    #[test]
    fn words_alone_are_spelled() {
        let vtt = "WEBVTT\n\n00:00.100 --> 00:00.500\nmap\n\n00:00.500 --> 00:00.900\n25\n";
        let alignment = read(Format::WebVtt, vtt.as_bytes()).unwrap();
        let spoken = combine(&alignment, silence(1.0), &["Map", "25"], "radio").unwrap();
        let told: Vec<(&str, Option<usize>)> = spoken
            .segments
            .iter()
            .map(|s| (s.symbol.as_str(), s.token))
            .collect();
        assert_eq!(
            told,
            [
                ("pau", None),
                ("m", Some(0)),
                ("ae", Some(0)),
                ("p", Some(0)),
                ("ax", Some(1)),
                ("ax", Some(1)),
                ("pau", None)
            ]
        );
    }
}

//! Sound whose times another program wrote: its words find their tokens by their order and
//! spelling.

use crate::align::{Alignment, Units, phone_of_viseme};
use crate::spoken::Spoken;
use anyhow::{Result, ensure};
use raconteur_speech::bundle::SILENCE;

use super::labels::{self, Labels, Phone};
use super::matching;
use super::wave::Wave;

/// Share of the tokens that must be found.
const LEAST_FOUND: f64 = 0.5;

/// Brings sound and alignment together. `tokens` are what was to be said; `phone_set` is
/// what the phones are of where the alignment does not tell. Where there are mouth shapes
/// instead of phones, each becomes a phone that looks like it; where there are only words,
/// each is spelled with a phone a letter, of equal lengths.
///
/// # Errors
/// When fewer than half of the tokens are among the words, or as [`labels::finish`].
pub(super) fn spoken(
    alignment: &Alignment,
    wave: Wave,
    tokens: &[&str],
    phone_set: &str,
) -> Result<Spoken> {
    let token_of = tokens_of(alignment, tokens)?;
    let mut labels = Labels::default();
    let set = match &alignment.units {
        Units::Phones { set } => {
            times(alignment, &token_of, &mut labels, |label| {
                Some(label.to_owned())
            });
            set.unwrap_or(phone_set)
        }
        Units::Visemes { set } => {
            times(alignment, &token_of, &mut labels, |label| {
                phone_of_viseme(*set, label).map(str::to_owned)
            });
            "radio"
        }
        Units::None => {
            spell(alignment, &token_of, &mut labels);
            "radio"
        }
    };
    accents(alignment, &mut labels);
    labels::finish(&labels, wave, set, 0.0)
}

/// The token of each word.
fn tokens_of(alignment: &Alignment, tokens: &[&str]) -> Result<Vec<Option<usize>>> {
    let known: Vec<String> = tokens.iter().map(|t| folded(t)).collect();
    let heard: Vec<String> = alignment.words.iter().map(|w| folded(&w.label)).collect();
    let pairs = matching::matched(&known, &heard, |k, h| {
        if k == h {
            0
        } else if k.starts_with(h.as_str()) || h.starts_with(k.as_str()) {
            2
        } else {
            // Another spelling, such as a number in words, at the same place.
            5
        }
    })?;
    let found = pairs.iter().flatten().count();
    ensure!(
        alignment.words.is_empty() || found as f64 >= LEAST_FOUND * tokens.len() as f64,
        "it has {} words, of which {found} are among the {} of the text",
        heard.len(),
        tokens.len()
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

/// Takes the segments as they are. What the other program has no phone for is silence.
fn times(
    alignment: &Alignment,
    token_of: &[Option<usize>],
    labels: &mut Labels,
    phone: impl Fn(&str) -> Option<String>,
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
        let symbol = phone(&segment.label).unwrap_or_else(|| SILENCE.to_owned());
        let word = alignment.word_of(i);
        labels.phones.push(Phone {
            token: word.and_then(|w| token_of.get(w).copied().flatten()),
            symbol,
            end_secs: segment.end_secs,
            syllable: syllable(i),
        });
    }
    labels.syllables = alignment
        .syllables
        .iter()
        .map(|s| (s.stress.min(2), String::new()))
        .collect();
}

/// Spells words. *Designed*: which phone of the radio set a letter looks most like.
fn spell(alignment: &Alignment, token_of: &[Option<usize>], labels: &mut Labels) {
    const LETTERS: [&str; 26] = [
        "ae", "b", "k", "d", "eh", "f", "g", "hh", "ih", "jh", "k", "l", "m", "n", "ao", "p", "k",
        "r", "s", "t", "uh", "v", "w", "s", "iy", "z",
    ];
    let mut end_secs = 0.0;
    for (word, token) in alignment.words.iter().zip(token_of) {
        if word.start_secs > end_secs {
            labels.phones.push(Phone {
                symbol: SILENCE.to_owned(),
                end_secs: word.start_secs,
                ..Phone::default()
            });
        }
        let phones: Vec<&str> = folded(&word.label)
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

/// Gives syllables their accents and phrases their ends.
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
        let spoken = spoken(&alignment, silence(0.7), &["Hullo", "you"], "sampa").unwrap();
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
            super::spoken(
                &alignment,
                silence(0.7),
                &["a", "b", "c", "d", "e"],
                "sampa"
            )
            .is_err()
        );
    }

    #[test]
    fn words_alone_are_spelled() {
        let vtt = "WEBVTT\n\n00:00.100 --> 00:00.500\nmap\n\n00:00.500 --> 00:00.900\n25\n";
        let alignment = read(Format::WebVtt, vtt.as_bytes()).unwrap();
        let spoken = spoken(&alignment, silence(1.0), &["Map", "25"], "radio").unwrap();
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

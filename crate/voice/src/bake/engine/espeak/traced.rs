//! Output of an espeak-ng build whose events name phones by the International Phonetic Alphabet:
//! its phones as mnemonics, the symbols of the phone sets.

use anyhow::Result;

use super::super::matching;
use super::{Event, EventKind, Synthesis, set};
use crate::ipa::{self, Set};

/// Speech and events that a tracing build of espeak-ng returns for a text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TracedText {
    /// Mono samples.
    pub samples: Vec<i16>,
    /// Sample rate, Hz.
    pub rate_hz: u32,
    /// Events; [`EventKind::Phone`] contains IPA letters with stress marks; empty for silence.
    pub events: Vec<Event>,
    /// The text's mnemonics, a low line between those of a word, a space between words.
    pub marked: String,
}

/// Renames the events of a text to those of a voice that spoke mnemonics.
///
/// # Errors
/// Returns an error if the text is too long.
pub fn named(said: TracedText, voice: &str) -> Result<Synthesis> {
    let set = set(voice.split('+').next().unwrap_or_default());
    let marked = mnemonics(&said.marked);
    let mut events = said.events;
    let mut heard: Vec<&mut String> = events
        .iter_mut()
        .filter_map(|e| match &mut e.what {
            EventKind::Phone(symbol) => Some(symbol),
            _ => None,
        })
        .collect();
    let pairs = matching::matched(&marked, &heard, |k, h| unlike(k, h, set))?;
    for (symbol, pair) in heard.iter_mut().zip(pairs) {
        let known = pair.map(|k| &marked[k]);
        **symbol = match known.filter(|k| unlike(k, symbol, set) < 5) {
            Some(known) => super::bare(known),
            None => mnemonic_of(symbol, set).unwrap_or_else(|| "_:".to_owned()),
        };
    }
    Ok(Synthesis {
        samples: said.samples,
        rate_hz: said.rate_hz,
        events,
        marked,
    })
}

/// Splits words into mnemonics. A leading underscore is a pause; a single bar separates clauses.
fn mnemonics(marked: &str) -> Vec<String> {
    let mut out = Vec::new();
    for word in marked.split_whitespace().filter(|w| *w != "|") {
        let mut pause = false;
        for piece in word.split('_') {
            if piece.is_empty() {
                pause = true;
                continue;
            }
            let mark = if pause { "_" } else { "" };
            out.push(format!("{mark}{piece}"));
            pause = false;
        }
    }
    out
}

/// Returns the difference of a mnemonic and IPA letters.
fn unlike(mnemonic: &str, letters: &str, set: Set) -> u32 {
    let own = super::bare(mnemonic);
    // A glide that is no more than a colour of its neighbours has no letter either.
    let is_mute = own.starts_with('_') || own == ";";
    match mnemonic_of(letters, set) {
        None => 5 * u32::from(!is_mute),
        Some(_) if is_mute => 5,
        Some(named) => super::unlike(&own, &named, set),
    }
}

/// Returns the mnemonic for letters without context; `None` for silence.
fn mnemonic_of(letters: &str, set: Set) -> Option<String> {
    let letters = letters.trim_matches(['ˈ', 'ˌ']);
    if letters.is_empty() {
        return None;
    }
    // A change of language within a sentence stays as it is.
    let syllables = ipa::syllables(letters, set).ok();
    let first = syllables.and_then(|all| Some((*all.first()?.phones.first()?).to_owned()));
    Some(first.unwrap_or_else(|| letters.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spoken_words(marked: &str, heard: &[&str], voice: &str) -> Vec<String> {
        let events = heard.iter().enumerate().map(|(sample, symbol)| Event {
            sample,
            what: EventKind::Phone((*symbol).to_owned()),
        });
        let traced = TracedText {
            events: events.collect(),
            marked: marked.to_owned(),
            ..TracedText::default()
        };
        let said = named(traced, voice).unwrap();
        said.events
            .into_iter()
            .map(|e| match e.what {
                EventKind::Phone(symbol) => symbol,
                other => panic!("{other:?}"),
            })
            .collect()
    }

    #[test]
    fn letters_become_the_mnemonics_of_their_place() {
        // espeak-ng's output for "meinem Garten, sagte".
        let heard = [
            "m", "ˌaɪ", "n", "ə", "m", "ɡ", "ˈa", "ɾ", "t", "ə", "n", "", "", "z", "ˈɑː", "ɡ", "t",
            "ə", "", "",
        ];
        assert_eq!(
            spoken_words("m_,aI_n_@_m g_'a_r_t_@_n | z_'A:_g_t_@", &heard, "de").join(" "),
            "m aI n @ m g a r t @ n _: _: z A: g t @ _: _:"
        );
    }

    #[test]
    fn pauses_and_glides_without_letters_keep_their_place() {
        assert_eq!(
            spoken_words(
                "d_E_r _!_'a_l_t",
                &["d", "ɛ", "ɾ", "", "ˈa", "l", "t"],
                "de"
            )
            .join(" "),
            "d E r _! a l t"
        );
        assert_eq!(
            spoken_words("w_aI_;_A@", &["w", "aɪ", "", "ɑːɹ"], "en-us").join(" "),
            "w aI ; A@"
        );
    }

    #[test]
    fn letters_that_no_mnemonic_stands_for_tell_as_much_as_they_can() {
        let out = spoken_words("", &["ˈiː", "☃", "", "(en)"], "de");
        assert_eq!(out[0], "i:");
        assert_eq!(out[2..], ["_:".to_owned(), "(en)".to_owned()]);
    }
}

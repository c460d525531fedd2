//! The utterance of a clause: as it was baked, or estimated.

use std::sync::Arc;

use raconteur_eml::{VoiceText, VoiceTiming};
use raconteur_speech::{Phone, Utterance, Word};

/// What a clause says: what was baked for it, with words as the script writes them; without
/// that, the words at their estimated times.
pub(crate) fn of(
    text: &VoiceText,
    timing: &VoiceTiming,
    baked: Option<&Arc<Utterance>>,
) -> Arc<Utterance> {
    match baked {
        Some(baked) => as_written(text, baked),
        None => Arc::new(estimated(text, timing)),
    }
}

/// A baked utterance with the words as the script writes them. Only the bundle has the words
/// of files and of SABLE documents.
fn as_written(text: &VoiceText, baked: &Arc<Utterance>) -> Arc<Utterance> {
    let written = text.words();
    let mut pairs = written.iter().zip(&baked.words);
    let same = written.len() >= baked.words.len()
        && pairs.all(|(written, word)| written.text == word.text && !written.emphasized);
    let mut utterance = Arc::clone(baked);
    if written.is_empty() || same {
        return utterance;
    }
    let words = &mut Arc::make_mut(&mut utterance).words;
    words.truncate(written.len());
    for (word, written) in words.iter_mut().zip(written) {
        word.text = written.text;
        word.emphasized = written.emphasized;
    }
    utterance
}

/// The words of a text at their estimated times.
fn estimated(text: &VoiceText, timing: &VoiceTiming) -> Utterance {
    let words = text.words().into_iter().zip(&timing.words);
    let words: Vec<Word> = words
        .map(|(written, time)| Word {
            text: written.text,
            start_secs: time.start_secs,
            end_secs: time.end_secs,
            emphasized: written.emphasized,
        })
        .collect();
    Utterance {
        phones: estimated_phones(&words, timing.duration_secs),
        duration_secs: timing.duration_secs,
        words,
        ..Utterance::default()
    }
}

/// Phones for a text that was not baked, so that the lips move with the captions: one
/// consonant and one vowel for every three letters of a word. Designed; a diagnostic reports
/// the missing voice.
fn estimated_phones(words: &[Word], duration_secs: f64) -> Vec<Phone> {
    const SYLLABLES: [[&str; 2]; 4] = [["m", "aa"], ["d", "eh"], ["s", "iy"], ["n", "ow"]];
    let mut phones = Vec::new();
    let mut push = |symbol: &str, start_secs: f64, end_secs: f64, word: Option<usize>| {
        if end_secs > start_secs {
            phones.push(Phone::new(symbol, start_secs, end_secs, word));
        }
    };
    let mut now = 0.0;
    for (index, word) in words.iter().enumerate() {
        let (start, end) = (word.start_secs, word.end_secs);
        push("pau", now, start, None);
        let letters = word.text.chars().filter(|c| c.is_alphanumeric()).count();
        let syllables = letters.div_ceil(3).clamp(1, 8);
        let step = (end - start) / syllables as f64;
        for s in 0..syllables {
            let from = start + step * s as f64;
            let [consonant, vowel] = SYLLABLES[(index + s) % SYLLABLES.len()];
            push(consonant, from, from + 0.4 * step, Some(index));
            push(vowel, from + 0.4 * step, from + step, Some(index));
        }
        now = end;
    }
    push("pau", now, duration_secs, None);
    phones
}

#[cfg(test)]
mod tests {
    use crate::Script;
    use crate::lower::cues::{UtteranceCue, utterances};
    use raconteur_speech::Bundle;

    /// What a script says.
    fn said(eml: &str, bundle: Option<&str>) -> Vec<UtteranceCue> {
        utterances(&Script::read(eml, bundle.map(str::as_bytes)))
    }

    #[test]
    fn what_was_baked_keeps_its_melody_and_is_written_as_in_the_script() {
        let eml = include_str!("../../../../assets/stories/hello-world/story.eml");
        let json = include_str!("../../../../assets/stories/hello-world/voice/speech.json");
        let cues = said(eml, Some(json));
        let bundle = Bundle::from_json(json.as_bytes()).expect("a bundle");
        let (said, baked) = (&cues[0].timed.utterance, &bundle.utterances[0]);
        assert_eq!((&said.f0, &said.phones), (&baked.f0, &baked.phones));
        assert_eq!(
            (&said.accents, &said.phrases),
            (&baked.accents, &baked.phrases)
        );
        assert_eq!(said.words.len(), baked.words.len());
    }

    #[test]
    fn what_was_not_baked_has_words_and_phones_at_estimated_times() {
        let eml = "<eml><body><voice-text>one <emph>two</emph> three</voice-text></body></eml>";
        let cues = said(eml, None);
        let said = &cues[0].timed.utterance;
        let emphasized: Vec<bool> = said.words.iter().map(|w| w.emphasized).collect();
        assert_eq!(emphasized, [false, true, false]);
        assert!(cues[0].estimated && said.audio.is_empty() && said.f0.is_empty());
        assert_eq!(said.phones[0].start_secs, 0.0);
        let last = said.phones.last().expect("phones");
        assert!((last.end_secs - said.duration_secs).abs() < 1e-9);
    }
}

//! Utterance of a clause: baked or estimated.

use std::sync::Arc;

use raconteur_eml::{VoiceText, VoiceTiming};
use raconteur_speech::phones::{Class, find};
use raconteur_speech::{Phone, Utterance, Word};

use crate::lower::spelling::Speller;

/// Returns the utterance of a clause: the baked one, with words as written in the script; else the
/// words at their estimated times, with estimated lip animation for a language (a BCP 47 tag).
pub(crate) fn utterance_of(
    text: &VoiceText,
    timing: &VoiceTiming,
    baked: Option<&Arc<Utterance>>,
    language: Option<&str>,
) -> Arc<Utterance> {
    match baked {
        Some(baked) => as_written(text, baked),
        None => Arc::new(estimated(text, timing, language)),
    }
}

/// Returns a baked utterance (synthesised ahead of time) with the words as the script writes them.
/// Words of files and SABLE documents come only from the bundle.
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

/// Returns an utterance with the words of a text at their estimated times.
fn estimated(text: &VoiceText, timing: &VoiceTiming, language: Option<&str>) -> Utterance {
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
        phones: estimated_phones(&words, timing.duration_secs, language),
        duration_secs: timing.duration_secs,
        words,
        ..Utterance::default()
    }
}

/// Returns estimated phones for the lip animation of unbaked text: each word by its spelling, its
/// phones at their share of its time.
fn estimated_phones(words: &[Word], duration_secs: f64, language: Option<&str>) -> Vec<Phone> {
    let speller = Speller::from_language_tag(language);
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
        let spelled = speller.spell(&word.text);
        let weights = spelled.iter().map(|symbol| weight(symbol));
        let secs = (end - start) / weights.sum::<f64>();
        let (mut from, mut weighed) = (start, 0.0);
        for symbol in spelled {
            weighed += weight(symbol);
            let to = (start + secs * weighed).min(end);
            push(symbol, from, to, Some(index));
            from = to;
        }
        now = end;
    }
    push("pau", now, duration_secs, None);
    phones
}

/// Returns the relative duration of a phone: vowels are longer. *Designed*.
fn weight(symbol: &str) -> f64 {
    match find("radio", symbol).map(|phone| phone.class) {
        Some(Class::Vowel | Class::Diphthong) => 1.6,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use crate::Script;
    use crate::lower::cues::{UtteranceCue, utterances};
    use raconteur_speech::Bundle;

    /// Returns the utterances of a script.
    fn spoken_words(eml: &str, bundle: Option<&str>) -> Vec<UtteranceCue> {
        utterances(&Script::read(eml, bundle.map(str::as_bytes)))
    }

    #[test]
    fn what_was_baked_keeps_its_melody_and_is_written_as_in_the_script() {
        let eml = include_str!("../../../../assets/stories/hello-world/story.eml");
        let json = include_str!("../../../../assets/stories/hello-world/voice/speech.json");
        let cues = spoken_words(eml, Some(json));
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
        let cues = spoken_words(eml, None);
        let said = &cues[0].timed.utterance;
        let emphasized: Vec<bool> = said.words.iter().map(|w| w.emphasized).collect();
        assert_eq!(emphasized, [false, true, false]);
        assert!(
            cues[0].estimated && said.audio.is_empty() && said.f0.is_empty(),
            "the utterance without a bake is estimated and silent"
        );
        assert_eq!(said.phones[0].start_secs, 0.0);
        let last = said.phones.last().expect("phones");
        assert!(
            (last.end_secs - said.duration_secs).abs() < 1e-9,
            "the last word ends with the utterance"
        );
    }

    /// Returns the phone symbols of an utterance, word by word.
    fn mimed(said: &UtteranceCue) -> Vec<String> {
        let utterance = &said.timed.utterance;
        let word = |i| {
            let phones = utterance.phones.iter().filter(|p| p.word == Some(i));
            phones.map(|p| &*p.symbol).collect::<Vec<_>>().join(" ")
        };
        (0..utterance.words.len()).map(word).collect()
    }

    #[test]
    fn what_was_not_baked_is_mimed_in_its_language() {
        let text = "<voice-text>vier Wale</voice-text>\
            <voice-text><r:language id='en'>four whales</r:language></voice-text>";
        let head = "<r:performer language='de'/>";
        let eml = |head: &str| {
            let open = "<eml xmlns:r='urn:raconteur:eml:1'>";
            format!("{open}<head>{head}</head><body>{text}</body></eml>")
        };
        let german = spoken_words(&eml(head), None);
        assert_eq!(mimed(&german[0]), ["f iy ah", "v aa l ax"]);
        assert_eq!(mimed(&german[1]), ["f ao r", "w ey l z"]);
        let poem = include_str!(
            "../../../../assets/stories/virtual-poets/zwei-parallelen/voice/speech.json"
        );
        assert_eq!(
            mimed(&spoken_words(&eml(""), Some(poem))[0]),
            mimed(&german[0])
        );
        assert_ne!(mimed(&spoken_words(&eml(""), None)[0]), mimed(&german[0]));
    }

    #[test]
    fn phones_share_the_time_of_their_word() {
        let text = "Bumblebees 1984 hum, \u{e4}\u{65e5} don’t &amp; x<break msec='300'/> 99%";
        let eml = format!("<eml><body><voice-text>{text}</voice-text></body></eml>");
        let cues = spoken_words(&eml, None);
        let said = &cues[0].timed.utterance;
        let mut now = 0.0;
        for phone in &said.phones {
            assert!(
                (phone.start_secs - now).abs() < 1e-9 && phone.end_secs > phone.start_secs,
                "each phone starts where the last one ends"
            );
            now = phone.end_secs;
            let Some(word) = phone.word.map(|word| &said.words[word]) else {
                continue;
            };
            assert!(
                phone.start_secs >= word.start_secs && phone.end_secs <= word.end_secs,
                "each phone is within its word"
            );
        }
        assert!(
            (now - said.duration_secs).abs() < 1e-9,
            "the last phone ends with the utterance"
        );
        let secs = |k: usize| said.phones[k].end_secs - said.phones[k].start_secs;
        assert!((secs(1) - 1.6 * secs(0)).abs() < 1e-9, "a vowel is longer");
    }
}

//! Bytes as the JSON of a speech bundle.
#![no_main]

use raconteur_speech::Bundle;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(bundle) = Bundle::from_json(bytes) else {
        return;
    };
    for utterance in &bundle.utterances {
        for t in [-1.0, 0.0, 0.5, utterance.duration_secs, f64::MAX] {
            let _ = utterance.word_at(t);
            let _ = utterance.phone_at(t);
        }
    }
});

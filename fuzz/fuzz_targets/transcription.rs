//! Bytes as a transcription in any format, and its script.
#![no_main]

use raconteur_annotate::{Anchoring, anvil, import, read_transcription, xml};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let read = read_transcription(bytes, None);
    for problem in &read.diagnostics {
        assert!(problem.span.end as usize <= read.text.len(), "{problem:?}");
    }
    // What was read is written as a file that is read again.
    let text = anvil::write(&anvil::from_transcription(&read.transcription));
    assert!(xml::parse(&text, &mut Vec::new()).is_some());
    for anchoring in [Anchoring::Words, Anchoring::Seconds] {
        let imported = import(bytes, None, anchoring);
        let _ = raconteur_eml::parse(&raconteur_eml::write(&imported.document));
    }
});

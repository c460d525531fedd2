//! Bytes as an alignment in the format selected by the first byte.
#![no_main]

use raconteur_voice::align::{Format, detect, read};

const FORMATS: [Format; 15] = [
    Format::TextGrid,
    Format::RhubarbTsv,
    Format::RhubarbJson,
    Format::RhubarbXml,
    Format::XLabel,
    Format::Htk,
    Format::FestivalUtterance,
    Format::MaryXml,
    Format::MaryDurations,
    Format::Mbrola,
    Format::WebVtt,
    Format::TalkingHead,
    Format::SubRip,
    Format::Eaf,
    Format::WordTimes,
];

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((choice, bytes)) = bytes.split_first() else {
        return;
    };
    let _ = detect("", bytes);
    let Ok(alignment) = read(FORMATS[usize::from(*choice) % FORMATS.len()], bytes) else {
        return;
    };
    let mut end_secs = 0.0;
    for (i, segment) in alignment.segments.iter().enumerate() {
        assert!(segment.start_secs == end_secs && segment.end_secs > end_secs);
        end_secs = segment.end_secs;
        let _ = alignment.word_of(i);
    }
    let mut end_secs = 0.0;
    for word in &alignment.words {
        assert!(word.start_secs >= end_secs && word.end_secs > word.start_secs);
        end_secs = word.end_secs;
    }
    for syllable in &alignment.syllables {
        assert!(syllable.count > 0);
        assert!(syllable.first_segment + syllable.count <= alignment.segments.len());
    }
});

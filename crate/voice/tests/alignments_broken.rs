//! Truncated, modified or generated alignments: none panics, and each result is consistent. The
//! test starts from the files of `tests/align` and of the fuzz target.

mod support;

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use raconteur_voice::align::{Format, MAX_BYTES, MAX_JSON_BYTES, detect, read};
use support::{FORMATS, files, folder};

fn contents(folder: &Path) -> impl Iterator<Item = Vec<u8>> + use<> {
    files(folder)
        .into_iter()
        .map(|path| fs::read(path).unwrap())
}

fn originals() -> Vec<(Format, Vec<u8>)> {
    let of = |(name, format): &(&str, Format)| {
        let format = *format;
        contents(&folder(name)).map(move |bytes| (format, bytes))
    };
    FORMATS.iter().flat_map(of).collect()
}

/// Reads a file and checks the invariants of every alignment.
fn read_holds(format: Format, bytes: &[u8]) {
    let _ = detect("", bytes);
    let alignment = match read(format, bytes) {
        Ok(alignment) => alignment,
        Err(fault) => {
            assert!(
                fault.line > 0 && fault.column > 0 && !fault.message.is_empty(),
                "the error has a line, a column and a message"
            );
            return;
        }
    };
    let mut end_secs = 0.0;
    for segment in &alignment.segments {
        assert_eq!(segment.start_secs, end_secs);
        assert!(
            segment.end_secs > segment.start_secs,
            "the segment has a positive duration"
        );
        end_secs = segment.end_secs;
    }
    let mut end_secs = 0.0;
    for word in &alignment.words {
        assert!(
            word.start_secs >= end_secs && word.end_secs > word.start_secs,
            "the word starts after the last one and has a duration"
        );
        end_secs = word.end_secs;
    }
    for syllable in &alignment.syllables {
        assert!(syllable.count > 0, "the syllable has segments");
        assert!(
            syllable.first_segment + syllable.count <= alignment.segments.len(),
            "the syllable refers to segments"
        );
    }
    for i in 0..=alignment.segments.len() {
        assert!(
            alignment
                .word_of(i)
                .is_none_or(|w| w < alignment.words.len()),
            "the word of the segment exists"
        );
    }
}

#[test]
fn every_file_cut_anywhere_is_refused_or_read() {
    for (format, bytes) in originals() {
        let step = bytes.len() / 97 + 1;
        for length in (0..bytes.len()).step_by(step) {
            read_holds(format, &bytes[..length]);
        }
    }
}

#[test]
fn every_file_as_every_format_is_refused_or_read() {
    let originals = originals();
    for (_, bytes) in &originals {
        for (_, format) in FORMATS {
            read_holds(format, bytes);
        }
    }
}

#[test]
fn what_fuzzing_has_kept_is_refused_or_read() {
    let saved = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/saved/alignment");
    let saved: Vec<_> = contents(&saved).collect();
    assert!(saved.len() >= 10, "only {} inputs", saved.len());
    for input in saved {
        let (choice, bytes) = input.split_first().unwrap();
        read_holds(FORMATS[usize::from(*choice) % FORMATS.len()].1, bytes);
    }
}

#[test]
fn too_much_is_refused() {
    let xml = vec![b' '; MAX_BYTES + 1];
    assert!(
        read(Format::MaryXml, &xml).is_err(),
        "an oversized XML file is rejected"
    );
    assert!(
        read(Format::RhubarbJson, &xml[..=MAX_JSON_BYTES]).is_err(),
        "an oversized JSON file is rejected"
    );
    let long = format!("<maryxml><t sampa='{}'/></maryxml>", "a".repeat(1001));
    assert!(
        read(Format::MaryXml, long.as_bytes()).is_err(),
        "1001 phones in one token are rejected"
    );
    let many = "a 1\n".repeat(1_000_001);
    let fault = read(Format::Mbrola, many.as_bytes()).unwrap_err();
    assert_eq!((fault.line, fault.column), (1_000_001, 1));
    let deep = format!("<maryxml>{}", "<p>".repeat(300));
    assert!(
        read(Format::MaryXml, deep.as_bytes())
            .unwrap_err()
            .message
            .contains("deep"),
        "the error for deep nesting"
    );
}

#[test]
fn repairs_beyond_a_hundred_are_counted() {
    let overlaps: String = (0..200)
        .map(|i| format!("{} {} a\n", i * 1_000_000, (i + 2) * 1_000_000))
        .collect();
    let alignment = read(Format::Htk, overlaps.as_bytes()).unwrap();
    assert_eq!(alignment.segments.len(), 200);
    assert_eq!(alignment.warnings.len(), 101);
    assert_eq!(alignment.warnings[100].message, "99 repairs more");
}

/// Pieces that readers care about.
const PIECES: [&str; 24] = [
    "\"", "<", ">", "-", "\n", "\r", " ", "0", "9", ".", "1e308", "-1e9", "nan", "inf", "#", ";",
    "/>", "&", "é", "\u{feff}", "\0", "}", "]", "-->",
];

proptest! {
    #[test]
    fn changed_files_are_refused_or_read(
        pick in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0..24_usize, 0..6_usize), 1..8),
    ) {
        let originals = originals();
        let (format, mut bytes) = pick.get(&originals).clone();
        for (place, piece, drop) in changes {
            let from = place.index(bytes.len() + 1).min(bytes.len());
            let to = (from + drop).min(bytes.len());
            bytes.splice(from..to, PIECES[piece].bytes());
        }
        read_holds(format, &bytes);
    }

    #[test]
    fn random_bytes_are_refused_or_read(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for (_, format) in FORMATS {
            read_holds(format, &bytes);
        }
    }
}

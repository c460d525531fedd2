//! Alignments as written by other programs: each file of `tests/align/<format>` is read and
//! summarised in a few lines that must equal those of the `.told` file next to it. For an
//! unreadable file, the summary is its fault.
//!
//! With `UPDATE=1` in the environment, the `.told` files are written again, for review.

mod support;

use std::fmt::Write;
use std::fs;
use std::path::Path;

use raconteur_voice::align::{Alignment, Format, Units, VisemeSet, detect, read};
use support::{FORMATS, files, folder};

/// A time to the microsecond without noughts at its end.
fn t(secs: f64) -> String {
    let written = format!("{secs:.6}");
    written
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}

fn told(alignment: &Alignment) -> String {
    let Alignment {
        units,
        segments,
        words,
        syllables,
        accents,
        tones,
        f0,
        emotions,
        warnings,
    } = alignment;
    let mut told = match units {
        Units::Phones { set } => format!("phones {}", set.unwrap_or("of no known set")),
        Units::Visemes {
            set: VisemeSet::Rhubarb,
        } => "visemes of Rhubarb".to_owned(),
        Units::Visemes {
            set: VisemeSet::Oculus,
        } => "visemes of OpenXR".to_owned(),
        Units::None => "words only".to_owned(),
    };
    if !segments.is_empty() {
        told.push_str("\nsegments 0");
    }
    for s in segments {
        let label = if s.label.is_empty() { "·" } else { &s.label };
        write!(told, " {label} {}", t(s.end_secs)).unwrap();
    }
    for (i, w) in words.iter().enumerate() {
        let own = (0..segments.len())
            .filter(|s| alignment.word_of(*s) == Some(i))
            .count();
        let (start, end) = (t(w.start_secs), t(w.end_secs));
        write!(told, "\nword {start} {end} {:?} of {own}", w.label).unwrap();
    }
    if !syllables.is_empty() {
        told.push_str("\nsyllables");
    }
    for s in syllables {
        let all = &segments[s.first_segment..s.first_segment + s.count];
        let phones: Vec<&str> = all.iter().map(|s| s.label.as_str()).collect();
        write!(told, " {}/{}", phones.join("-"), s.stress).unwrap();
    }
    for a in accents {
        write!(told, "\naccent {} {}", t(a.at_secs), a.label).unwrap();
    }
    for tone in tones {
        write!(
            told,
            "\ntone {} {:?} {:?}",
            t(tone.at_secs),
            tone.label,
            tone.break_index
        )
        .unwrap();
    }
    if !f0.is_empty() {
        told.push_str("\nf0");
    }
    for (secs, hz) in f0 {
        write!(told, " {}:{}", t(*secs), t(*hz)).unwrap();
    }
    for (secs, name) in emotions {
        write!(told, "\nemotion {} {name}", t(*secs)).unwrap();
    }
    for w in warnings {
        write!(told, "\nrepaired: {w}").unwrap();
    }
    told + "\n"
}

#[test]
fn files_of_every_format_tell_what_is_written_beside_them() {
    let update = std::env::var_os("UPDATE").is_some();
    for (set, format) in FORMATS {
        let paths = files(&folder(set));
        let good = paths.iter().filter(|p| !name(p).starts_with("bad_"));
        assert!(good.count() >= 5, "{set}");
        assert!(paths.iter().any(|p| name(p).starts_with("bad_")), "{set}");
        for path in paths {
            let read = read(format, &fs::read(&path).unwrap());
            let is_bad = name(&path).starts_with("bad_");
            assert_eq!(read.is_err(), is_bad, "{}: {read:?}", path.display());
            let told = match read {
                Ok(alignment) => {
                    assert_tiles(&alignment);
                    told(&alignment)
                }
                Err(fault) => format!("refused: {fault}\n"),
            };
            let beside = path.with_extension("told");
            if update {
                fs::write(&beside, &told).unwrap();
            }
            let wanted = fs::read_to_string(&beside).unwrap_or_default();
            assert_eq!(told, wanted, "{}", path.display());
        }
    }
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// Checks the invariants of every alignment.
fn assert_tiles(alignment: &Alignment) {
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
        assert!(!word.label.is_empty(), "the word has a label");
        end_secs = word.end_secs;
    }
    let mut after = 0;
    for syllable in &alignment.syllables {
        assert!(
            syllable.first_segment >= after && syllable.count > 0 && syllable.stress <= 2,
            "the syllable follows the last one and is valid"
        );
        after = syllable.first_segment + syllable.count;
    }
    assert!(
        after <= alignment.segments.len(),
        "the syllables refer to segments"
    );
    assert!(
        alignment.f0.is_sorted_by(|a, b| a.0 <= b.0),
        "the pitch points are sorted by time"
    );
    assert!(
        alignment
            .f0
            .iter()
            .all(|(secs, hz)| *secs >= 0.0 && *hz > 0.0),
        "the pitch points have valid times and frequencies"
    );
    assert!(
        alignment
            .accents
            .is_sorted_by(|a, b| a.at_secs <= b.at_secs),
        "the accents are sorted by time"
    );
    assert!(
        alignment.tones.is_sorted_by(|a, b| a.at_secs <= b.at_secs),
        "the tones are sorted by time"
    );
    assert!(
        alignment.warnings.len() <= 101,
        "the number of warnings is bounded"
    );
    assert!(
        alignment
            .warnings
            .iter()
            .all(|w| w.line > 0 && w.column > 0),
        "each warning has a line and a column"
    );
    for i in 0..=alignment.segments.len() {
        assert!(
            alignment
                .word_of(i)
                .is_none_or(|w| w < alignment.words.len()),
            "the word of the segment exists"
        );
    }
}

/// Festival 2.5.0 wrote the same utterance in three formats; `utt.save.segs` and `utt.save.words`
/// round to four digits.
#[test]
fn an_utterance_of_festival_and_its_label_files_agree() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/align");
    let whole = |format, name| read(format, &fs::read(folder.join(name)).unwrap()).unwrap();
    let utterance = whole(Format::FestivalUtterance, "festival/hello_kal_full.utt");
    let segments = whole(Format::XLabel, "xlabel/hello_kal.segs");
    let words = whole(Format::XLabel, "xlabel/hello_kal_words.words");
    assert_eq!(segments.segments.len(), utterance.segments.len());
    for (a, b) in utterance.segments.iter().zip(&segments.segments) {
        assert_eq!(a.label, b.label);
        assert!((a.end_secs - b.end_secs).abs() < 1e-4, "{a:?} {b:?}");
    }
    assert_eq!(words.words.len(), utterance.words.len());
    for (a, b) in utterance.words.iter().zip(&words.words) {
        assert_eq!(a.label, b.label);
        assert!((a.end_secs - b.end_secs).abs() < 1e-4, "{a:?} {b:?}");
    }
}

#[test]
fn formats_are_told_by_content_even_without_a_name() {
    for (set, format) in FORMATS {
        for path in files(&folder(set))
            .iter()
            .filter(|p| !name(p).starts_with("bad_"))
        {
            let bytes = fs::read(path).unwrap();
            assert_eq!(
                detect(&name(path), &bytes),
                Some(format),
                "{}",
                path.display()
            );
            assert_eq!(
                detect("", &bytes),
                Some(format),
                "{} unnamed",
                path.display()
            );
        }
    }
    for (name, bytes) in [
        ("a.wav", &b"RIFF\x10\0\0\0WAVEfmt "[..]),
        ("a.txt", b"Hello there"),
        ("", b""),
    ] {
        assert_eq!(detect(name, bytes), None, "{name}");
    }
    assert_eq!(detect("broken.TextGrid", b"oops"), Some(Format::TextGrid));
}

//! Recordings of people: a folder with an audio file for each utterance and, next to it, another
//! program's times; otherwise, its intensity provides approximate times.

use std::path::{Path, PathBuf};

use crate::align::{Alignment, FORMS, MAX_BYTES, detect, read};
use crate::plan::Plan;
use crate::spoken::{Sentence, Spoken};
use anyhow::{Context as _, Result, bail};

use super::loudness::{self, SpokenUnit};
use super::{Engine, Recorded, Remark, VoiceInfo, aligned, wave};
use crate::files::{input, inside};

/// File name endings of alignments, most informative first.
const ENDINGS: [&str; 10] = [
    "TextGrid", "utt", "xml", "lab", "pho", "eaf", "json", "tsv", "vtt", "srt",
];

/// Phone set of recordings whose alignment does not specify one.
const PHONE_SET: &str = "radio";

/// Engine that uses recordings from a folder instead of synthesised speech.
pub(super) struct Recordings {
    folder: PathBuf,
}

impl Recordings {
    pub(super) fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// Returns the audio file of an utterance: `KEY.wav` with sixteen hexadecimal digits, or its
    /// position from 1 with or without a leading zero (`07.wav`, `7.wav`).
    fn sound(&self, key: u64, place: usize) -> Result<Option<PathBuf>> {
        let number = place.saturating_add(1);
        let names = [
            format!("{key:016x}"),
            format!("{number:02}"),
            number.to_string(),
        ];
        for name in names {
            let found = inside::find(&self.folder, &format!("{name}.wav"))?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }
}

impl Engine for Recordings {
    fn version(&self) -> Result<String> {
        Ok("recordings 2".to_owned())
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        Ok(Vec::new())
    }

    fn speak(&self, _voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        if sentences.is_empty() {
            return Ok(Vec::new());
        }
        bail!(
            "{} contains no recording of it; name it after the utterance's key or its position: 01.wav",
            self.folder.display()
        )
    }

    fn voice(&self, name: &str) -> Result<Option<VoiceInfo>> {
        // Any voice; the name is the author's.
        Ok(Some(VoiceInfo {
            name: name.to_owned(),
            language: "und".to_owned(),
            phone_set: PHONE_SET.to_owned(),
            what: "recordings".to_owned(),
            ..VoiceInfo::default()
        }))
    }

    fn state(&self, key: u64, place: usize) -> Result<String> {
        let Some(sound) = self.sound(key, place)? else {
            return Ok(String::new());
        };
        let alignment =
            alignment_of(&sound).with_context(|| format!("the recording {}", sound.display()))?;
        let (name, times) = alignment.unwrap_or_default();
        let bytes = wave::bytes(&sound)?;
        Ok(format!(
            "{:016x} {name} {:016x}",
            digest(&bytes),
            digest(&times)
        ))
    }

    fn recorded(&self, key: u64, place: usize, plan: &Plan) -> Result<Option<Recorded>> {
        let Some(sound) = self.sound(key, place)? else {
            return Ok(None);
        };
        let told = || format!("the recording {}", sound.display());
        let tokens = || plan.sentences.iter().flat_map(|s| &s.sentence.tokens);
        let Some((name, bytes)) = alignment_of(&sound).with_context(told)? else {
            let said = tokens().map(|t| SpokenUnit {
                text: &t.text,
                ends: !t.punctuation.is_empty(),
            });
            let said: Vec<SpokenUnit<'_>> = said.collect();
            let spoken =
                loudness::align_by_loudness(wave::read(&sound)?, &said).with_context(told)?;
            let remarks = vec![by_loudness(&sound)];
            return Ok(Some(Recorded { spoken, remarks }));
        };
        let format = detect(&name, &bytes)
            .with_context(|| format!("{name} is of no form that is read, which are {FORMS}"))
            .with_context(told)?;
        let alignment = read(format, &bytes)
            .with_context(|| name.clone())
            .with_context(told)?;
        let wave = wave::read(&sound)?;
        let texts: Vec<&str> = tokens().map(|t| t.text.as_str()).collect();
        let spoken = aligned::combine(&alignment, wave, &texts, PHONE_SET).with_context(told)?;
        let remarks = remarks(&name, &alignment);
        Ok(Some(Recorded { spoken, remarks }))
    }
}

/// Returns the remark about a sound without an alignment.
fn by_loudness(sound: &Path) -> Remark {
    let name = sound.file_name().unwrap_or_default().to_string_lossy();
    Remark {
        code: "lips-by-loudness",
        message: format!(
            "{name} has no alignment file: its words are distributed by their letters, and the lips follow the loudness only"
        ),
        hint: "add one of the same name next to it, for example a TextGrid of the Montreal Forced Aligner",
    }
}

/// Returns the remarks about an alignment file of this name.
fn remarks(name: &str, alignment: &Alignment) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let unknown = aligned::unknown_phones(alignment, PHONE_SET);
    if !unknown.is_empty() {
        remarks.push(Remark {
            code: "phones-unknown",
            message: format!(
                "{name} has phones that are not known, for which the mouth is hardly open: {}",
                unknown.join(" ")
            ),
            hint: "name them in ARPABET, SAMPA or IPA",
        });
    }
    if let [first, others @ ..] = alignment.warnings.as_slice() {
        let more = match others.len() {
            0 => String::new(),
            n => format!(", and {n} more like it"),
        };
        remarks.push(Remark {
            code: "alignment-repaired",
            message: format!("{name}, {first}{more}"),
            hint: "",
        });
    }
    remarks
}

/// Returns the 64-bit FNV-1a hash (draft-eastlake-fnv), used to detect changes of a file.
fn digest(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, b| {
        (hash ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Returns the name and content of the alignment next to a sound, if there is one.
fn alignment_of(sound: &Path) -> Result<Option<(String, Vec<u8>)>> {
    for ending in ENDINGS {
        let name = sound.with_extension(ending);
        let name = name.file_name().unwrap_or_default().to_string_lossy();
        let folder = sound.parent().unwrap_or(Path::new("."));
        if let Some(path) = inside::find(folder, &name)? {
            let bytes = input::bytes(&path, MAX_BYTES as u64).context("the alignment")?;
            return Ok(Some((name.into_owned(), bytes)));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Planned;
    use crate::spoken::Token;
    use std::fs;

    const GRID: &str = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n0.5\n<exists>\n2\n\
        \"IntervalTier\"\n\"words\"\n0\n0.5\n3\n0\n0.1\n\"\"\n0.1\n0.3\n\"me\"\n0.3\n0.5\n\"too\"\n\
        \"IntervalTier\"\n\"phones\"\n0\n0.5\n5\n0\n0.1\n\"sil\"\n0.1\n0.2\n\"M\"\n0.2\n0.3\n\"IY1\"\n0.3\n0.4\n\"T\"\n0.4\n0.5\n\"UW1\"\n";

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let spec = hound::WavSpec {
            channels: 2,
            sample_rate: 8_000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        for name in ["000000000123abcd.wav", "03.wav", "4.wav"] {
            let mut writer = hound::WavWriter::create(folder.path().join(name), spec).unwrap();
            (0..8_000).for_each(|_| writer.write_sample(100_i16).unwrap());
            writer.finalize().unwrap();
        }
        fs::write(folder.path().join("000000000123abcd.TextGrid"), GRID).unwrap();
        fs::write(folder.path().join("03.TextGrid"), GRID).unwrap();
        folder
    }

    fn plan(sentences: &[&str]) -> Plan {
        let planned = |text: &&str| Planned {
            sentence: Sentence {
                tokens: text
                    .split(' ')
                    .map(|w| Token {
                        text: w.to_owned(),
                        ..Token::default()
                    })
                    .collect(),
                ..Sentence::default()
            },
            ..Planned::default()
        };
        Plan {
            sentences: sentences.iter().map(planned).collect(),
            ..Plan::default()
        }
    }

    #[test]
    fn recordings_are_found_by_key_or_place() {
        let folder = folder();
        let recordings = Recordings::new(folder.path().to_owned());
        let me_too = plan(&["Me", "too"]);
        for (key, place) in [(0x0123_abcd, 9), (0, 2)] {
            let recorded = recordings.recorded(key, place, &me_too).unwrap().unwrap();
            assert!(recorded.remarks.is_empty(), "the recording has no remarks");
            let spoken = recorded.spoken;
            let tokens: Vec<_> = spoken.segments.iter().map(|s| s.token).collect();
            assert_eq!(tokens[..5], [None, Some(0), Some(0), Some(1), Some(1)]);
            assert_eq!((spoken.rate_hz, spoken.samples.len()), (8_000.0, 4_000));
        }
        assert!(
            recordings.recorded(0xffff, 0, &me_too).unwrap().is_none(),
            "a text without a recording is not found"
        );
        let alone = recordings.recorded(0, 3, &me_too).unwrap().unwrap();
        let codes: Vec<&str> = alone.remarks.iter().map(|r| r.code).collect();
        assert_eq!(codes, ["lips-by-loudness"]);
        assert_ne!(recordings.state(0, 3).unwrap(), "");
        let others = plan(&["quite another text", "than this"]);
        assert!(
            recordings.recorded(0, 2, &others).is_err(),
            "a recording of another text is rejected"
        );
        assert!(
            recordings.speak("", &[Sentence::default()]).is_err(),
            "a recording engine does not speak other text"
        );
    }

    #[test]
    fn what_is_odd_or_of_another_form_is_named() {
        let folder = folder();
        let recordings = Recordings::new(folder.path().to_owned());
        let grid = folder.path().join("03.TextGrid");
        fs::write(
            &grid,
            GRID.replace("\"T\"", "\"qqq\"")
                .replace("0\n0.1\n\"sil\"\n", "0\n0.11\n\"sil\"\n"),
        )
        .unwrap();
        let recorded = recordings.recorded(0, 2, &plan(&["Me", "too"])).unwrap();
        let remarks = recorded.unwrap().remarks;
        let codes: Vec<&str> = remarks.iter().map(|r| r.code).collect();
        assert_eq!(codes, ["phones-unknown", "alignment-repaired"]);
        assert!(
            remarks.iter().all(|r| r.message.contains("03.TextGrid")),
            "the remarks name the label file"
        );
        assert!(remarks[0].message.contains("qqq"), "{remarks:?}");
        fs::remove_file(grid).unwrap();
        fs::write(folder.path().join("03.json"), "[1, 2]").unwrap();
        let error = recordings
            .recorded(0, 2, &plan(&["Me", "too"]))
            .unwrap_err();
        let error = format!("{error:#}");
        for part in ["03.wav", "03.json", "TextGrid", "Whisper"] {
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn a_changed_recording_changes_the_state() {
        let folder = folder();
        let recordings = Recordings::new(folder.path().to_owned());
        let before = recordings.state(0, 2).unwrap();
        assert_eq!(recordings.state(0, 2).unwrap(), before);
        assert_eq!(recordings.state(0, 7).unwrap(), "");
        let changed = GRID.replace("\"me\"", "\"we\"");
        fs::write(folder.path().join("03.TextGrid"), changed).unwrap();
        assert_ne!(recordings.state(0, 2).unwrap(), before);
    }
}

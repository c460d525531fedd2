//! Files of `tests/align`.

use std::fs;
use std::path::{Path, PathBuf};

use raconteur_voice::align::Format;

/// The folders of `tests/align` and the formats of the files in them.
pub(crate) const FORMATS: [(&str, Format); 15] = [
    ("textgrid", Format::TextGrid),
    ("rhubarb_tsv", Format::RhubarbTsv),
    ("rhubarb_json", Format::RhubarbJson),
    ("rhubarb_xml", Format::RhubarbXml),
    ("xlabel", Format::XLabel),
    ("htk", Format::Htk),
    ("festival", Format::FestivalUtterance),
    ("mary_xml", Format::MaryXml),
    ("mary_durations", Format::MaryDurations),
    ("mbrola", Format::Mbrola),
    ("webvtt", Format::WebVtt),
    ("talking_head", Format::TalkingHead),
    ("subrip", Format::SubRip),
    ("eaf", Format::Eaf),
    ("word_times", Format::WordTimes),
];

/// Returns the files of a folder except its `.told` listings, sorted by name.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_none_or(|e| e != "told"));
    paths.sort();
    paths
}

/// The folder of a format.
pub(crate) fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/align")
        .join(name)
}

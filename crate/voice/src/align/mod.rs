//! Times of words and phones from other programs.
//!
//! Scope: reading alignments of a dozen formats from bytes, in any of four encodings, into one
//! structure; correcting and reporting faults.
//! Out of scope: file access, alignment itself, and conversion of the phone set.
//!
//! Corrections, with a warning: intervals out of order are sorted; an interval that overlaps the
//! next ends at its start; parts before 0 are cut off; empty intervals are removed; silence fills
//! gaps (those up to 1.5 ms, the rounding of times in whole milliseconds, are closed without a
//! warning). Rejected: times that are not finite or beyond 24 hours, files with only negative
//! times, more than 64 MiB or a million intervals, and violations of a format.

mod draft;
mod eaf;
mod labels;
mod mary;
mod mbrola;
mod rhubarb;
mod sampa;
mod sniff;
mod talking_head;
mod text;
mod textgrid;
mod tiers;
mod timings;
mod utterance;
mod viseme;
mod webvtt;
mod xml;

pub use sniff::detect;
pub use viseme::{VisemeSet, phone_of_viseme, rhubarb_viseme};

use draft::Draft;

/// Maximum size of an alignment file, bytes.
pub const MAX_BYTES: usize = 64 << 20;

/// Maximum size of a JSON file, bytes; each byte may take twenty in memory.
pub const MAX_JSON_BYTES: usize = 16 << 20;

/// Maximum number of intervals, points and events in one file.
pub const MAX_INTERVALS: usize = 1_000_000;

/// Latest accepted time, seconds.
pub const MAX_SECS: f64 = 86_400.0;

/// The set of phones that are named in the International Phonetic Alphabet.
pub const IPA: &str = "ipa";

/// Supported formats, for messages.
pub const FORMS: &str = "Praat's TextGrid, ELAN's EAF, WebVTT, SubRip, JSON of words with times (Whisper, Google), \
    Rhubarb's TSV, JSON and XML, arrays of talking heads, MaryXML, Festival's utterances, xlabel, HTK's labels and MBROLA's .pho";

/// Format of an alignment file, which gives the times of phones and words in a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Praat's TextGrid, long or short text.
    TextGrid,
    /// Rhubarb Lip Sync, tab-separated: a start and a mouth shape per line.
    RhubarbTsv,
    /// Rhubarb Lip Sync, JSON.
    RhubarbJson,
    /// Rhubarb Lip Sync, XML.
    RhubarbXml,
    /// ESPS xlabel: a header to `#`, then end, colour and label per line. Festival's
    /// `utt.save.segs` and `utt.save.words`.
    XLabel,
    /// HTK and HTS labels in units of 100 ns, with short or full-context names; MLF.
    Htk,
    /// Festival's `utt.save`.
    FestivalUtterance,
    /// MARY's XML with phones; see [`read`] for that without times.
    MaryXml,
    /// MARY's `REALISED_DURATIONS`.
    MaryDurations,
    /// MBROLA's `.pho`: phone, milliseconds, and pairs of percent and hertz.
    Mbrola,
    /// WebVTT whose cues are words or have times within.
    WebVtt,
    /// SubRip, the captions of files `.srt`.
    SubRip,
    /// ELAN's annotations.
    Eaf,
    /// JSON of words and their times, as recognisers of speech write it: Whisper, Google and
    /// their like.
    WordTimes,
    /// JSON of arrays for talking heads in browsers: `words`, `wtimes`, `wdurations`,
    /// `visemes`, `vtimes`, `vdurations`, times in milliseconds.
    TalkingHead,
}

/// Label with its time interval, in seconds from the start of the recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// Begin, at least 0.
    pub start_secs: f64,
    /// End, after the begin.
    pub end_secs: f64,
    /// Label text; `""` is silence.
    pub label: String,
}

/// Type of the segment labels of an alignment: phones, visemes or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// Phones. The set is one of [`raconteur_speech::phones::PHONE_SETS`], or [`IPA`]: the first
    /// with the most known labels, if it knows at least four of five. A caller that knows the
    /// language can choose better: `espeak` may mean `espeak-de`.
    Phones {
        /// The set's name.
        set: Option<&'static str>,
    },
    /// Shapes of the mouth.
    Visemes {
        /// Set of mouth shapes.
        set: VisemeSet,
    },
    /// Words only, without segments.
    None,
}

/// Syllable as a run of adjacent segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Syllable {
    /// Index of its first segment.
    pub first_segment: usize,
    /// Number of segments, at least 1.
    pub count: usize,
    /// Stress: 0 none, 1 primary, 2 secondary.
    pub stress: u8,
}

/// Pitch accent of an alignment: its time and its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Accent {
    /// Middle of the accented syllable, in seconds.
    pub at_secs: f64,
    /// Label as written, usually ToBI: `H*`, `l+h*`.
    pub label: String,
}

/// Phrase boundary of an alignment: its time, boundary tone and break index.
#[derive(Clone, Debug, PartialEq)]
pub struct Tone {
    /// End of the phrase, before its pause, in seconds.
    pub at_secs: f64,
    /// Boundary tone as written (`L-L%`), or empty.
    pub label: String,
    /// ToBI break index, 0..6.
    pub break_index: Option<u8>,
}

/// Alignment of a recording, as read from a file: the times of its phones, words and prosody.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// Type of the segment labels.
    pub units: Units,
    /// Phones or visemes. They begin at 0 and leave no gap; silence is `""`.
    pub segments: Vec<Interval>,
    /// Words in order, without overlaps; silences are omitted.
    pub words: Vec<Interval>,
    /// Syllables in order.
    pub syllables: Vec<Syllable>,
    /// Pitch accents in order of time.
    pub accents: Vec<Accent>,
    /// Boundaries in order of time.
    pub tones: Vec<Tone>,
    /// Pitch: seconds and hertz, in order of time.
    pub f0: Vec<(f64, f64)>,
    /// Emotions (seconds of the apex, name), in order of time.
    pub emotions: Vec<(f64, String)>,
    /// Repaired faults. After a hundred, only their number is reported.
    pub warnings: Vec<Fault>,
}

impl Alignment {
    /// Returns the word that contains the middle of a segment.
    #[must_use]
    pub fn word_of(&self, segment: usize) -> Option<usize> {
        let segment = self.segments.get(segment)?;
        let middle_secs = segment.start_secs.midpoint(segment.end_secs);
        let after = self.words.partition_point(|w| w.start_secs <= middle_secs);
        let last = after.checked_sub(1)?;
        (middle_secs < self.words[last].end_secs).then_some(last)
    }
}

/// Fault in an alignment file: the reason for its rejection, or for a repair.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {message}")]
pub struct Fault {
    /// Line number, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// Description of the fault.
    pub message: String,
}

/// Reads an alignment. UTF-8, UTF-16 with a byte order mark, and Latin-1 are understood.
///
/// If a format gives only the start or only the end of a segment, the neighbouring segment gives
/// the other. MaryXML without times (F&H table 4.3) gets 80 ms for each phone and 200 ms for each
/// boundary, with a warning, because its order is still useful. A last mouth shape without an end
/// lasts 100 ms.
///
/// # Errors
/// Returns a [`Fault`] with line and column if the file is not in the format, is too large, or has
/// impossible times.
pub fn read(format: Format, bytes: &[u8]) -> Result<Alignment, Fault> {
    let most = match format {
        Format::RhubarbJson | Format::TalkingHead | Format::WordTimes => MAX_JSON_BYTES,
        _ => MAX_BYTES,
    };
    if bytes.len() > most {
        return Err(Fault {
            line: 1,
            column: 1,
            message: format!("{} bytes; at most {most} are read", bytes.len()),
        });
    }
    let text = text::decode(bytes)?;
    let mut draft = Draft::default();
    let read = match format {
        Format::TextGrid => textgrid::read(&text, &mut draft),
        Format::RhubarbTsv => rhubarb::tsv(&text, &mut draft),
        Format::RhubarbJson => rhubarb::json(&text, &mut draft),
        Format::RhubarbXml => rhubarb::xml(&text, &mut draft),
        Format::XLabel => labels::xlabel(&text, &mut draft),
        Format::Htk => labels::htk(&text, &mut draft),
        Format::FestivalUtterance => utterance::read(&text, &mut draft),
        Format::MaryXml => mary::read(&text, &mut draft),
        Format::MaryDurations => labels::mary(&text, &mut draft),
        Format::Mbrola => mbrola::read(&text, &mut draft),
        Format::WebVtt => webvtt::read(&text, &mut draft),
        Format::SubRip => webvtt::subrip(&text, &mut draft),
        Format::Eaf => eaf::read(&text, &mut draft),
        Format::WordTimes => timings::read(&text, &mut draft),
        Format::TalkingHead => talking_head::read(&text, &mut draft),
    };
    read.and_then(|()| draft.finish(&text))
        .map_err(|bad| bad.in_text(&text))
}

//! Speech markup: SABLE's containers and empty elements (GEVH D.4), and the clauses that speak
//! without it.

use crate::Span;
use crate::record::{Field, Record, Value, Visit, record, words};

/// Level of a speech property such as pitch or rate: a SABLE word, a change in percent, or a
/// number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// One of the level words that the attribute allows.
    Word(&'static str),
    /// A change of the enclosing value in percent.
    Percent(f64),
    /// The value itself.
    Number(f64),
}

impl Default for Level {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl Field for Level {
    fn set(&mut self, value: Value) {
        match value {
            Value::Word(word) => *self = Self::Word(word),
            Value::Percent(percent) => *self = Self::Percent(percent),
            Value::Number(number) => *self = Self::Number(number),
            _ => {}
        }
    }

    fn get(&self) -> Value {
        match *self {
            Self::Word(word) => Value::Word(word),
            Self::Percent(percent) => Value::Percent(percent),
            Self::Number(number) => Value::Number(number),
        }
    }
}

record! {
    /// Emphasises (GEVH D.4.7).
    Emph = "emph" {
        /// Strength of the emphasis; numbers as in SABLE: 0 reduced, 0.5 none, 1 moderate, 2
        /// strong.
        level: Level = "level",
    }
}

record! {
    /// Speaks replacement text on one speech engine (GEVH D.4.8).
    Engine = "engine" {
        /// The engine's name.
        id: String = "id",
        /// Replacement text.
        data: String = "data",
    }
}

record! {
    /// Changes the pitch (GEVH D.4.9). Numbers are in hertz.
    Pitch = "pitch" {
        /// The base line.
        base: Option<Level> = "base",
        /// The middle line.
        middle: Option<Level> = "middle",
        /// The range.
        range: Option<Level> = "range",
    }
}

record! {
    /// Specifies the pronunciation of text (GEVH D.4.10).
    Pron = "pron" {
        /// Pronunciation in the International Phonetic Alphabet.
        ipa: Option<String> = "ipa",
        /// Pronunciation as a spelling that sounds alike.
        sub: Option<String> = "sub",
        /// Language of the text's origin.
        origin: Option<String> = "origin",
    }
}

record! {
    /// Changes the pace (GEVH D.4.11). Numbers are words a minute.
    Rate = "rate" {
        /// Speech rate.
        speed: Level = "speed",
    }
}

words! {
    /// Type of a text (GEVH D.4.12).
    SayAsMode {
        /// Letters to be spelt.
        Literal = "literal",
        /// A date.
        Date = "date",
        /// A time of day.
        Time = "time",
        /// A telephone number.
        Phone = "phone",
        /// An address on the net.
        Net = "net",
        /// A postal address.
        Postal = "postal",
        /// An amount of money.
        Currency = "currency",
        /// A formula.
        Math = "math",
        /// A fraction.
        Fraction = "fraction",
        /// A quantity with its unit.
        Measure = "measure",
        /// A rank.
        Ordinal = "ordinal",
        /// A count.
        Cardinal = "cardinal",
        /// A name.
        Name = "name",
    }
}

words! {
    /// The order of the parts of a date, a time or a net address.
    SayAsType {
        /// Day, month, year.
        Dmy = "DMY",
        /// Month, day, year.
        Mdy = "MDY",
        /// Year, month, day.
        Ymd = "YMD",
        /// Year, month.
        Ym = "YM",
        /// Month, year.
        My = "MY",
        /// Month, day.
        Md = "MD",
        /// Hour, minute.
        Hm = "HM",
        /// Hour, minute, second.
        Hms = "HMS",
        /// An address of electronic mail.
        Email = "EMAIL",
        /// An address of a page.
        Url = "URL",
    }
}

record! {
    /// Specifies the type of a text (GEVH D.4.12).
    SayAs = "sayas" {
        /// Type of the text.
        mode: SayAsMode = "mode",
        /// The order of its parts.
        mode_type: Option<SayAsType> = "modetype",
    }
}

record! {
    /// Changes the volume (GEVH D.4.13). Numbers are gains, 1 unchanged.
    Volume = "volume" {
        /// Volume.
        level: Level = "level",
    }
}

record! {
    /// Changes the language (SABLE's LANGUAGE; extension).
    Language = "language" {
        /// The language's name or code.
        id: String = "id",
        /// The coding of its characters.
        code: Option<String> = "code",
    }
}

words! {
    /// A speaker's sex.
    Gender {
        /// A man.
        Male = "male",
        /// A woman.
        Female = "female",
    }
}

words! {
    /// A speaker's age.
    Age {
        /// Old.
        Older = "older",
        /// Middle-aged speaker.
        Middle = "middle",
        /// Young.
        Younger = "younger",
        /// Teenage speaker.
        Teen = "teen",
        /// A child.
        Child = "child",
    }
}

record! {
    /// Changes the speaker (SABLE's SPEAKER; extension).
    Speaker = "speaker" {
        /// The sex.
        gender: Option<Gender> = "gender",
        /// The age.
        age: Option<Age> = "age",
        /// The voice's name.
        name: Option<String> = "name",
    }
}

/// SABLE container in speech, with its effect on the enclosed text.
#[derive(Clone, Debug, PartialEq)]
pub enum Markup {
    /// Emphasises it.
    Emph(Emph),
    /// Replaces it on one engine.
    Engine(Engine),
    /// Changes its pitch.
    Pitch(Pitch),
    /// Pronounces it.
    Pron(Pron),
    /// Changes its pace.
    Rate(Rate),
    /// Specifies the type of the text.
    SayAs(SayAs),
    /// Changes its volume.
    Volume(Volume),
    /// Changes its language.
    Language(Language),
    /// Changes the speaker.
    Speaker(Speaker),
}

impl Markup {
    /// Returns the name of the container element.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Emph(_) => "emph",
            Self::Engine(_) => "engine",
            Self::Pitch(_) => "pitch",
            Self::Pron(_) => "pron",
            Self::Rate(_) => "rate",
            Self::SayAs(_) => "sayas",
            Self::Volume(_) => "volume",
            Self::Language(_) => "language",
            Self::Speaker(_) => "speaker",
        }
    }

    pub(crate) fn record(&mut self) -> &mut dyn Record {
        match self {
            Self::Emph(record) => record,
            Self::Engine(record) => record,
            Self::Pitch(record) => record,
            Self::Pron(record) => record,
            Self::Rate(record) => record,
            Self::SayAs(record) => record,
            Self::Volume(record) => record,
            Self::Language(record) => record,
            Self::Speaker(record) => record,
        }
    }
}

words! {
    /// Mixing of a recording with the speech.
    AudioMode {
        /// The speech waits for it.
        Insertion = "insertion",
        /// Beneath the speech.
        Background = "background",
    }
}

record! {
    /// Plays a recording (GEVH D.4.4).
    Audio = "audio" {
        /// Address (URL or path) of the recording.
        src: String = "src",
        /// Mixing with the speech.
        mode: AudioMode = "mode",
        /// Volume of the recording, 1 as recorded.
        level: f64 = "level",
    }
}

words! {
    /// Punctuation mark whose intonation precedes a pause.
    Boundary {
        /// Intonation that ends a question.
        Question = "?",
        /// Intonation that ends an exclamation.
        Exclamation = "!",
        /// Intonation that ends a statement.
        Statement = ".",
        /// Intonation that announces a continuation.
        Comma = ",",
    }
}

words! {
    /// Operation on the text or file of a [`VoiceSay`].
    VoiceOperation {
        /// Speaks the text.
        Text = "text",
        /// Speaks the file.
        File = "file",
        /// Synthesise the text without speaking it.
        PreprocessText = "preprocessText",
        /// Synthesise the file without speaking it.
        PreprocessFile = "preprocessFile",
        /// Speaks the text without delaying the next clause.
        AsynchronousText = "asynchronousText",
        /// Speaks the file without delaying the next clause.
        AsynchronousFile = "asynchronousFile",
    }
}

words! {
    /// Format of a text or file.
    UtteranceKind {
        /// Plain text.
        Text = "text",
        /// A SABLE document.
        Sable = "sable",
    }
}

/// Clause that speaks a text or a file without time markers (GEVH D.4.2, D.4.14).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoiceSay {
    /// Operation on the queue of utterances.
    pub operation: VoiceOperation,
    /// Format of the text or file.
    pub kind: UtteranceKind,
    /// True if a file is in the library instead of next to the story.
    pub is_resources_relative: bool,
    /// The text, or the path of the file.
    pub content: String,
    /// Span of the content.
    pub content_span: Span,
}

impl Record for VoiceSay {
    fn element(&self) -> &'static str {
        "voice-say"
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("voiceOperation", &mut self.operation);
        visitor.field("type", &mut self.kind);
        visitor.field(
            "isResourcesRelativeFilePath",
            &mut self.is_resources_relative,
        );
    }
}

impl VoiceSay {
    /// Returns true if its content is the path of a file.
    #[must_use]
    pub fn is_file(&self) -> bool {
        matches!(
            self.operation,
            VoiceOperation::File
                | VoiceOperation::PreprocessFile
                | VoiceOperation::AsynchronousFile
        )
    }

    /// Returns true if the next clause waits until it is spoken.
    #[must_use]
    pub fn is_waited_for(&self) -> bool {
        matches!(self.operation, VoiceOperation::Text | VoiceOperation::File)
    }

    /// Returns true if it is audible, rather than only prepared.
    #[must_use]
    pub fn is_heard(&self) -> bool {
        !matches!(
            self.operation,
            VoiceOperation::PreprocessText | VoiceOperation::PreprocessFile
        )
    }
}

record! {
    /// Sets the tension of the story from here on (extension).
    Beat = "beat" {
        /// Tension from 0, at ease, to 1, the climax; none: derived from the text.
        tension: Option<f64> = "tension",
    }
}

record! {
    /// Gives a referent of the speech a place on the stage from its time on (extension).
    Place = "place" {
        /// Name of the referent; a later place of the same name moves it.
        name: String = "name",
        /// Units to the speaker's left.
        x: f64 = "x",
        /// Units upwards.
        y: f64 = "y",
        /// Units to the back.
        z: f64 = "z",
        /// Words that mention the referent, with spaces between them; none: its name.
        words: Option<String> = "words",
    }
}

record! {
    /// Changes the voice of all speech from now on (GEVH D.4.15).
    VoiceChange = "voice-change" {
        /// Name of the voice, such as `don_diphone`.
        voice: String = "voice",
    }
}

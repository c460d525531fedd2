//! Reading of a file in any of the formats.

use raconteur_eml::{Diagnostic, Document, quoted, thinned};

use crate::gestura::{Transcription, check};
use crate::xml::{self, Element};
use crate::{Anchoring, anvil, bml, encoding, sigml, to_eml};

/// Format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Annotation of ANVIL.
    Anvil,
    /// Behavior Markup Language: a block, or an element that contains blocks.
    Bml,
    /// Signing Gesture Markup Language.
    Sigml,
}

impl Format {
    /// Formats with the root element of their files.
    const ROOTS: [(Self, &'static str); 3] = [
        (Self::Anvil, "annotation"),
        (Self::Bml, bml::ROOT),
        (Self::Sigml, "sigml"),
    ];

    /// Returns the format of a file by its root element. Any other element with blocks of BML in it
    /// is BML.
    #[must_use]
    pub fn of(root: &Element) -> Option<Self> {
        let mut roots = Self::ROOTS.iter();
        let found = roots.find(|(_, name)| root.name.eq_ignore_ascii_case(name));
        let has_blocks = || root.child(bml::ROOT).map(|_| Self::Bml);
        found.map(|(format, _)| *format).or_else(has_blocks)
    }
}

/// Result of reading a transcription.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Read {
    /// Text of the file.
    pub text: String,
    /// Transcription; empty if the file has none.
    pub transcription: Transcription,
    /// Problems, with spans in the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a transcription and checks it against the rules of GestuRA.
#[must_use]
pub fn read_transcription(bytes: &[u8]) -> Read {
    let (text, mut problems) = encoding::decode(bytes);
    let transcription = xml::parse(&text, &mut problems)
        .and_then(|root| match Format::of(&root) {
            Some(Format::Anvil) => Some(transcription(&root, &mut problems)),
            Some(Format::Bml | Format::Sigml) => {
                let message = "the file is a script, not a transcription";
                problems.push(Diagnostic::error("annotate::format", root.tag, message));
                None
            }
            None => {
                unknown(&root, &mut problems);
                None
            }
        })
        .unwrap_or_default();
    Read {
        text,
        transcription,
        diagnostics: thinned(problems),
    }
}

fn transcription(root: &Element, problems: &mut Vec<Diagnostic>) -> Transcription {
    let annotation = anvil::read(root, problems);
    let transcription = anvil::to_transcription(&annotation, problems);
    problems.extend(check(&transcription));
    transcription
}

fn unknown(root: &Element, problems: &mut Vec<Diagnostic>) {
    let message = format!("{} is not the root of a known format", quoted(&root.name));
    let hint =
        "an annotation of ANVIL starts with `annotation`, BML with `bml`, SiGML with `sigml`";
    problems.push(Diagnostic::error("annotate::format", root.tag, message).hint(hint));
}

/// Result of an import.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// Text of the file.
    pub text: String,
    /// Script that performs it.
    pub document: Document,
    /// Problems, with spans in the text: what is lost, and how what is missing was filled in.
    pub diagnostics: Vec<Diagnostic>,
}

/// Converts a file in any of the formats to a script. The anchoring is that of transcriptions.
#[must_use]
pub fn import(bytes: &[u8], anchoring: Anchoring) -> Imported {
    let (text, mut problems) = encoding::decode(bytes);
    let root = xml::parse(&text, &mut problems);
    let document = root.map_or_else(Document::default, |root| match Format::of(&root) {
        Some(Format::Anvil) => {
            let transcription = transcription(&root, &mut problems);
            let (document, more) = to_eml(&transcription, anchoring);
            problems.extend(more);
            document
        }
        Some(Format::Bml) => bml::convert(&root, &mut problems),
        Some(Format::Sigml) => sigml::convert(&root, &mut problems),
        None => {
            unknown(&root, &mut problems);
            Document::default()
        }
    });
    Imported {
        text,
        document,
        diagnostics: thinned(problems),
    }
}

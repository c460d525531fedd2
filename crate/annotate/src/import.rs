//! Reading of a file in any of the formats.

use raconteur_eml::{Diagnostic, Document, quoted, thinned};

use crate::elan::{self, Mapping};
use crate::gestura::{Transcription, check};
use crate::xml::{self, Element};
use crate::{Anchoring, anvil, bml, encoding, sigml, to_eml};

/// Format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Annotation of ANVIL.
    Anvil,
    /// Annotation of ELAN.
    Elan,
    /// Behavior Markup Language: a block, or an element that contains blocks.
    Bml,
    /// Signing Gesture Markup Language.
    Sigml,
}

impl Format {
    /// Formats with the root element of their files.
    const ROOTS: [(Self, &'static str); 4] = [
        (Self::Anvil, "annotation"),
        (Self::Elan, "ANNOTATION_DOCUMENT"),
        (Self::Bml, bml::ROOT),
        (Self::Sigml, "sigml"),
    ];

    /// Returns the format of a file by its root element. Any other element with blocks of BML in it
    /// is BML.
    #[must_use]
    pub fn from_root(root: &Element) -> Option<Self> {
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

/// Reads a transcription and checks it against the rules of GestuRA. Without a mapping, the tiers of
/// ELAN are guessed, with a note of what is assumed.
#[must_use]
pub fn read_transcription(bytes: &[u8], mapping: Option<&Mapping>) -> Read {
    let (text, mut problems) = encoding::decode(bytes);
    let transcription = xml::parse(&text, &mut problems).and_then(|root| {
        let read = transcription(&root, mapping, &mut problems);
        if read.is_none() && Format::from_root(&root).is_some() {
            let message = "the file is a script, not a transcription";
            problems.push(Diagnostic::error("annotate::format", root.tag, message));
        }
        read
    });
    Read {
        text,
        transcription: transcription.unwrap_or_default(),
        diagnostics: thinned(problems),
    }
}

/// Reads a transcription from the root of its file; `None` if the format is of scripts. An unknown
/// format is reported.
fn transcription(
    root: &Element,
    mapping: Option<&Mapping>,
    problems: &mut Vec<Diagnostic>,
) -> Option<Transcription> {
    let annotation = match Format::from_root(root) {
        Some(Format::Anvil) => {
            let annotation = anvil::read(root, problems);
            annotation.check_remarks(problems);
            annotation
        }
        Some(Format::Elan) => {
            let elan = elan::read(root, problems);
            let guessed = mapping.is_none().then(|| elan::guess(&elan));
            if let Some((_, told)) = &guessed {
                let message = format!("without a mapping: {}", told.join("; "));
                problems.push(Diagnostic::warning("elan::guess", root.tag, message));
            }
            let mapping = mapping.or(guessed.as_ref().map(|(mapping, _)| mapping))?;
            elan::to_annotation(&elan, mapping, problems)
        }
        Some(Format::Bml | Format::Sigml) => return None,
        None => {
            let message = format!("{} is not the root of a known format", quoted(&root.name));
            let hint = "files of ANVIL start with `annotation`, of ELAN with \
                        `ANNOTATION_DOCUMENT`, BML with `bml`, SiGML with `sigml`";
            problems.push(Diagnostic::error("annotate::format", root.tag, message).hint(hint));
            return None;
        }
    };
    let transcription = anvil::to_transcription(&annotation, problems);
    problems.extend(check(&transcription));
    Some(transcription)
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

/// Converts a file in any of the formats to a script. Mapping and anchoring are those of
/// transcriptions.
#[must_use]
pub fn import(bytes: &[u8], mapping: Option<&Mapping>, anchoring: Anchoring) -> Imported {
    let (text, mut problems) = encoding::decode(bytes);
    let root = xml::parse(&text, &mut problems);
    let document = root.map_or_else(Document::default, |root| match Format::from_root(&root) {
        Some(Format::Bml) => bml::convert(&root, &mut problems),
        Some(Format::Sigml) => sigml::convert(&root, &mut problems),
        Some(Format::Anvil | Format::Elan) | None => {
            let read = transcription(&root, mapping, &mut problems);
            read.map_or_else(Document::default, |transcription| {
                let (document, more) = to_eml(&transcription, anchoring);
                problems.extend(more);
                document
            })
        }
    });
    Imported {
        text,
        document,
        diagnostics: thinned(problems),
    }
}

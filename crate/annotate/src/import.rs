//! Reading of a file in any of the formats.

use raconteur_eml::{Diagnostic, Document, quoted, thinned};

use crate::elan::{self, Mapping};
use crate::gestura::{Transcription, check};
use crate::xml::{self, Element};
use crate::{Anchoring, anvil, encoding, to_eml};

/// Format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Annotation of ANVIL.
    Anvil,
    /// Annotation of ELAN.
    Elan,
}

impl Format {
    /// Formats with the root element of their files.
    const ROOTS: [(Self, &'static str); 2] = [
        (Self::Anvil, "annotation"),
        (Self::Elan, "ANNOTATION_DOCUMENT"),
    ];

    /// Returns the format of a file by its root element.
    #[must_use]
    pub fn from_root(root: &Element) -> Option<Self> {
        let mut roots = Self::ROOTS.iter();
        let found = roots.find(|(_, name)| root.name.eq_ignore_ascii_case(name))?;
        Some(found.0)
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
    let transcription = xml::parse(&text, &mut problems)
        .and_then(|root| transcription(&root, mapping, &mut problems))
        .unwrap_or_default();
    problems.extend(check(&transcription));
    Read {
        text,
        transcription,
        diagnostics: thinned(problems),
    }
}

fn transcription(
    root: &Element,
    mapping: Option<&Mapping>,
    problems: &mut Vec<Diagnostic>,
) -> Option<Transcription> {
    match Format::from_root(root) {
        Some(Format::Anvil) => {
            let annotation = anvil::read(root, problems);
            Some(anvil::to_transcription(&annotation, problems))
        }
        Some(Format::Elan) => {
            let elan = elan::read(root, problems);
            let guessed = mapping.is_none().then(|| elan::guess(&elan));
            if let Some((_, told)) = &guessed {
                let message = format!("without a mapping: {}", told.join("; "));
                problems.push(Diagnostic::warning("elan::guess", root.tag, message));
            }
            let mapping = mapping.or(guessed.as_ref().map(|(mapping, _)| mapping))?;
            let annotation = elan::to_annotation(&elan, mapping, problems);
            Some(anvil::to_transcription(&annotation, problems))
        }
        None => {
            let message = format!("{} is not the root of a known format", quoted(&root.name));
            let hint = "files of ANVIL start with `annotation`, of ELAN with `ANNOTATION_DOCUMENT`";
            problems.push(Diagnostic::error("annotate::format", root.tag, message).hint(hint));
            None
        }
    }
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

/// Converts a file in any of the formats to a script. The mapping is that of
/// [`read_transcription`].
#[must_use]
pub fn import(bytes: &[u8], mapping: Option<&Mapping>, anchoring: Anchoring) -> Imported {
    let read = read_transcription(bytes, mapping);
    let (document, problems) = to_eml(&read.transcription, anchoring);
    let mut diagnostics = read.diagnostics;
    diagnostics.extend(problems);
    Imported {
        text: read.text,
        document,
        diagnostics: thinned(diagnostics),
    }
}

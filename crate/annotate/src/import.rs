//! Reading of a file in any of the formats.

use raconteur_eml::{Diagnostic, Document, quoted, thinned};

use crate::gestura::{Transcription, check};
use crate::xml::{self, Element};
use crate::{Anchoring, anvil, encoding, to_eml};

/// Format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Annotation of ANVIL.
    Anvil,
}

impl Format {
    /// Formats with the root element of their files.
    const ROOTS: [(Self, &'static str); 1] = [(Self::Anvil, "annotation")];

    /// Returns the format of a file by its root element.
    #[must_use]
    pub fn of(root: &Element) -> Option<Self> {
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

/// Reads a transcription and checks it against the rules of GestuRA.
#[must_use]
pub fn read_transcription(bytes: &[u8]) -> Read {
    let (text, mut problems) = encoding::decode(bytes);
    let transcription = xml::parse(&text, &mut problems)
        .and_then(|root| transcription(&root, &mut problems))
        .unwrap_or_default();
    problems.extend(check(&transcription));
    Read {
        text,
        transcription,
        diagnostics: thinned(problems),
    }
}

fn transcription(root: &Element, problems: &mut Vec<Diagnostic>) -> Option<Transcription> {
    match Format::of(root) {
        Some(Format::Anvil) => {
            let annotation = anvil::read(root, problems);
            Some(anvil::to_transcription(&annotation, problems))
        }
        None => {
            let message = format!("{} is not the root of a known format", quoted(&root.name));
            let hint = "an annotation of ANVIL starts with `annotation`";
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

/// Converts a file in any of the formats to a script.
#[must_use]
pub fn import(bytes: &[u8], anchoring: Anchoring) -> Imported {
    let read = read_transcription(bytes);
    let (document, problems) = to_eml(&read.transcription, anchoring);
    let mut diagnostics = read.diagnostics;
    diagnostics.extend(problems);
    Imported {
        text: read.text,
        document,
        diagnostics: thinned(diagnostics),
    }
}

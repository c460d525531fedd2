//! Signing Gesture Markup Language: HamNoSys in XML (ViSiCAST, eSIGN).
//!
//! A sign becomes a preparation to its posture, a stroke with its motions, and a hold; the signs
//! follow one another. Signs in the tokens of HamNoSys become elements of gestural SiGML first.

mod motion;
mod posture;
mod read_motion;
mod read_posture;
mod shapes;
mod sign;
mod token_tables;
mod tokens;
mod vocabulary;

use raconteur_eml::{Diagnostic, Document, quoted};

use crate::xml::Element;
use sign::SignSequence;

/// Maximum number of signs; later ones are left out. It bounds the time, since a sign may have many
/// nested motions.
const MAX_SIGNS: usize = 5_000;

/// Converts all signs of a file to a script.
pub(crate) fn convert(root: &Element, problems: &mut Vec<Diagnostic>) -> Document {
    let mut signs = SignSequence::default();
    for (index, sign) in root.children.iter().enumerate() {
        if index >= MAX_SIGNS {
            let message = format!("there are more than {MAX_SIGNS} signs");
            problems.push(Diagnostic::error("sigml::too-large", sign.tag, message));
            break;
        }
        match sign.name.as_str() {
            "hns_sign" | "hamgestural_sign" | "hamnosys_sign" => add(&mut signs, sign, problems),
            _ => {
                let message = format!("{} is not a sign", quoted(&sign.name));
                let hint = "signs are `hns_sign`, `hamgestural_sign` and `hamnosys_sign`";
                let problem = Diagnostic::warning("sigml::unknown-element", sign.tag, message);
                problems.push(problem.hint(hint));
            }
        }
    }
    signs.finish();
    signs.builder.document
}

/// Adds the manual parts of a sign.
fn add(signs: &mut SignSequence, sign: &Element, problems: &mut Vec<Diagnostic>) {
    let mut count = 0;
    for child in &sign.children {
        match child.name.as_str() {
            "sign_manual" if !child.children.is_empty() => {
                count += 1;
                signs.add(sign, child, problems);
            }
            "hamnosys_manual" if !child.children.is_empty() => {
                count += 1;
                let manual = tokens::manual(child, problems);
                signs.add(sign, &manual, problems);
            }
            "sign_manual" | "hamnosys_manual" => {}
            "sign_nonmanual" | "hamnosys_nonmanual" if child.children.is_empty() => {}
            "sign_nonmanual" | "hamnosys_nonmanual" => {
                let message = "mouth, face and body of the sign are not performed";
                problems.push(Diagnostic::warning("sigml::nonmanual", child.tag, message));
            }
            _ => {
                let message = format!("{} is not a part of a sign", quoted(&child.name));
                problems.push(Diagnostic::warning(
                    "sigml::unknown-element",
                    child.tag,
                    message,
                ));
            }
        }
    }
    if count == 0 {
        let message = "the sign has no manual part and is not performed";
        problems.push(Diagnostic::warning("sigml::no-manual", sign.tag, message));
    }
}

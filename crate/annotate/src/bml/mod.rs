//! Behavior Markup Language 1.0 (SAIBA): core behaviours as EML clauses.
//!
//! Sync points become sums of EML's named times and seconds: words of a speech are marks, and a
//! reference to another behaviour is replaced by the sum of that behaviour's own point. So no
//! duration of speech is needed. Each `bml` block whose composition is APPEND starts a group that
//! waits for the content of the one before.

mod behaviour;
mod body;
mod face;
mod gaze;
mod gesture;
mod lexicon;
mod output;
mod places;
mod read;
mod reference;
mod speech;
mod times;

use raconteur_eml::{ClauseKind, Diagnostic, Document, Group, Span};

use crate::xml::Element;
use behaviour::{Behaviour, Kind, Point};
use output::Output;

/// Name of the root element of a block.
pub(crate) const ROOT: &str = "bml";

/// Maximum number of behaviours; later ones are left out. EML scripts have at most 200,000 clauses,
/// and a behaviour makes about ten.
const MAX_BEHAVIOURS: usize = 15_000;

/// Converts the blocks of a file to a script. The root is a block or contains blocks.
pub(crate) fn convert(root: &Element, problems: &mut Vec<Diagnostic>) -> Document {
    let blocks: Vec<&Element> = if root.name.eq_ignore_ascii_case(ROOT) {
        vec![root]
    } else {
        root.all(ROOT).collect()
    };
    let mut reading = read::read(&blocks, problems);
    if reading.behaviours.is_empty() {
        let message = "no behaviour is to be performed";
        problems.push(Diagnostic::warning("bml::empty", root.tag, message));
    }
    reference::link(&mut reading, problems);
    let times = times::resolve(&reading, problems);
    let mut output = Output::new(&reading, times);
    if reading.groups == 1 {
        perform(&mut output, 0);
    } else {
        output.builder.open(None, ClauseKind::Seq(Group::default()));
        for group in 0..reading.groups {
            let name = times::group_name(group);
            output
                .builder
                .open(Some(name), ClauseKind::Par(Group::default()));
            perform(&mut output, group);
            output.builder.close();
        }
        output.builder.close();
    }
    problems.append(&mut output.builder.problems);
    output.builder.document
}

/// Returns a report of something that is not performed as written: an error if it is required.
fn loss(
    is_required: bool,
    code: &'static str,
    span: Span,
    message: impl Into<String>,
) -> Diagnostic {
    if is_required {
        Diagnostic::error(code, span, message)
    } else {
        Diagnostic::warning(code, span, message)
    }
}

/// Adds the clauses of the behaviours of a group.
fn perform(output: &mut Output<'_>, group: usize) {
    let reading = output.reading;
    for (index, behaviour) in reading.behaviours.iter().enumerate() {
        if reading.blocks[behaviour.block].group == group {
            add(output, index, behaviour);
        }
    }
}

fn add(output: &mut Output<'_>, index: usize, behaviour: &Behaviour<'_>) {
    // Each phase of a gesture has its own.
    if !matches!(
        behaviour.kind,
        Kind::Speech | Kind::Gesture | Kind::Pointing | Kind::Locomotion | Kind::Wait
    ) {
        output.check_lengths(index, [(Point::Start, Point::End)]);
    }
    match behaviour.kind {
        Kind::Speech => speech::add(output, index),
        Kind::Gesture => gesture::add_gesture(output, index),
        Kind::Pointing => gesture::add_pointing(output, index),
        Kind::Gaze | Kind::GazeShift => gaze::add_gaze(output, index),
        Kind::HeadDirectionShift => gaze::add_head_direction(output, index),
        Kind::Head => body::add_head(output, index),
        Kind::Posture | Kind::PostureShift => body::add_posture(output, index),
        Kind::Locomotion => body::add_locomotion(output, index),
        Kind::Wait => body::add_wait(output, index),
        Kind::Face | Kind::FaceLexeme | Kind::FaceFacs | Kind::FaceShift => {
            face::add(output, index);
        }
    }
}

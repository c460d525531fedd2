//! Reading of blocks and behaviours.

use std::collections::{BTreeMap, BTreeSet};

use raconteur_eml::{Diagnostic, Name, nearest, quoted};

use super::behaviour::{Behaviour, Block, Course, Kind, Point, Reading, SpeechMark};
use super::{MAX_BEHAVIOURS, gesture, loss};
use crate::xml::Element;

/// Reads all behaviours of some blocks, without their times.
pub(super) fn read<'x>(blocks: &[&'x Element], problems: &mut Vec<Diagnostic>) -> Reading<'x> {
    let mut reader = Reader {
        reading: Reading {
            blocks: Vec::new(),
            groups: 1,
            behaviours: Vec::new(),
            constraints: Vec::new(),
            orders: Vec::new(),
            ids: BTreeMap::new(),
        },
        names: BTreeSet::new(),
        problems,
    };
    for (number, block) in blocks.iter().enumerate() {
        reader.block(number, block);
    }
    reader.reading
}

struct Reader<'x, 'p> {
    reading: Reading<'x>,
    /// Named times used so far.
    names: BTreeSet<Name>,
    problems: &'p mut Vec<Diagnostic>,
}

impl<'x> Reader<'x, '_> {
    fn block(&mut self, number: usize, block: &'x Element) {
        match block.value("composition").unwrap_or("MERGE") {
            "MERGE" => {}
            "APPEND" if number > 0 => self.reading.groups += 1,
            "APPEND" => {}
            "REPLACE" => {
                let message = "a script cannot end behaviours that it plays already: the block \
                               starts after the one before instead of replacing it";
                self.warn("bml::composition", block, message);
                self.reading.groups += usize::from(number > 0);
            }
            other => {
                let message = format!("{} is not a composition; it is merged", quoted(other));
                let hint = "compositions are MERGE, APPEND and REPLACE";
                let problem = Diagnostic::warning("bml::composition", block.tag, message);
                self.problems.push(problem.hint(hint));
            }
        }
        let group = self.reading.groups - 1;
        self.reading.blocks.push(Block {
            element: block,
            group,
        });
        self.children(number, block, false);
    }

    fn children(&mut self, block: usize, parent: &'x Element, is_required: bool) {
        for element in &parent.children {
            let name = element.name.to_ascii_lowercase();
            if let Some((kind, attributes)) = Kind::of_element(&name) {
                self.behaviour(block, element, (kind, attributes), is_required);
            } else if name == "required" {
                // The depth of a file is limited.
                self.children(block, element, true);
            } else if name == "constraint" {
                let constraint = (element, block, is_required);
                self.reading.constraints.push(constraint);
            } else {
                let message = format!(
                    "{} is not a core behaviour; it is not performed",
                    quoted(&element.name)
                );
                let mut problem = loss(is_required, "bml::unknown-element", element.tag, message);
                let known = Kind::ELEMENTS.iter().map(|(name, ..)| *name);
                if let Some(near) = nearest(&element.name, known) {
                    problem = problem.hint(format!("did you mean `{near}`?"));
                }
                self.problems.push(problem);
            }
        }
    }

    fn behaviour(
        &mut self,
        block: usize,
        element: &'x Element,
        (kind, attributes): (Kind, &'static [&'static str]),
        is_required: bool,
    ) {
        let index = self.reading.behaviours.len();
        if index >= MAX_BEHAVIOURS {
            if index == MAX_BEHAVIOURS {
                let message = format!("there are more than {MAX_BEHAVIOURS} behaviours");
                self.problems
                    .push(Diagnostic::error("bml::too-large", element.tag, message));
            }
            return;
        }
        self.check_attributes(element, attributes, is_required);
        if let Some(id) = element.value("id") {
            let known = self.reading.ids.entry((block, id));
            let first = *known.or_insert(index);
            if first != index {
                let message = format!("{} is already the id of a behaviour", quoted(id));
                let problem = Diagnostic::error("bml::same-id", element.tag, message);
                let related = self.reading.behaviours[first].element.tag;
                self.problems
                    .push(problem.related(related, "the first one"));
            }
        }
        let mut behaviour = Behaviour {
            element,
            kind,
            block,
            is_required,
            course: course(kind, element),
            given: BTreeMap::new(),
            ends: None,
            marks: Vec::new(),
        };
        if kind == Kind::Speech {
            self.name_marks(&mut behaviour, index);
        }
        self.reading.behaviours.push(behaviour);
    }

    fn check_attributes(&mut self, element: &Element, known: &[&str], is_required: bool) {
        for attribute in &element.attributes {
            let name = attribute.name.as_str();
            let is_known = |known: &&str| known.eq_ignore_ascii_case(name);
            let is_general = name == "id" || Point::named(name).is_some();
            if !is_general && !known.iter().any(is_known) {
                let message = format!("the attribute {} has no effect", quoted(name));
                let span = attribute.text.span;
                let problem = loss(is_required, "bml::unknown-attribute", span, message);
                self.problems.push(problem);
            }
        }
    }

    /// Gives the start, the end and the syncs of a speech names in EML.
    fn name_marks(&mut self, behaviour: &mut Behaviour<'x>, index: usize) {
        let element = behaviour.element;
        let id = element.value("id").map_or_else(String::new, clean);
        let base = if id.is_empty() {
            format!("speech{index}")
        } else {
            id
        };
        behaviour.ends = Some((self.unique(&base, ""), self.unique(&base, "end")));
        let content = element.child("text").unwrap_or(element);
        for sync in content.all("sync") {
            let Some(id) = sync.value("id") else {
                let message = "the sync has no id, so nothing can refer to it";
                self.warn("bml::no-id", sync, message);
                continue;
            };
            let name = self.unique(&base, &clean(id));
            behaviour.marks.push(SpeechMark {
                id,
                name,
                position: sync.position,
            });
        }
    }

    /// Returns a name for a time that is not used yet.
    fn unique(&mut self, base: &str, part: &str) -> Name {
        let mut name: Name = match part {
            "" => format!("v_{base}"),
            part => format!("v_{base}_{part}"),
        }
        .into();
        let count = self.names.len();
        if self.names.contains(&name) {
            // As many names exist as are counted, so this one is new.
            name = format!("{name}.{count}").into();
        }
        self.names.insert(name.clone());
        name
    }

    fn warn(&mut self, code: &'static str, element: &Element, message: &str) {
        self.problems
            .push(Diagnostic::warning(code, element.tag, message));
    }
}

/// Maximum length of the part of a name that comes from an id, characters.
const MAX_NAME_LENGTH: usize = 40;

/// Returns the characters of an id that names of times may have.
fn clean(id: &str) -> String {
    let kept = id.chars().filter(char::is_ascii_alphanumeric);
    kept.take(MAX_NAME_LENGTH).collect()
}

/// Returns the default course of a behaviour: *designed*, after the storyteller's own gestures.
fn course(kind: Kind, element: &Element) -> Course {
    match kind {
        Kind::Gesture => gesture::course(element.value("lexeme")),
        Kind::Pointing => Course::phases(0.5, 0.4, 0.4, 0.7),
        Kind::Gaze => Course::phases(0.4, 0.5, 0.5, 0.4),
        Kind::GazeShift | Kind::HeadDirectionShift => Course::phases(0.5, 0.0, 0.0, 0.0),
        Kind::Head => {
            let passes = super::body::repetition(element);
            Course::phases(0.0, super::body::HEAD_SECS * f64::from(passes), 0.0, 0.0)
        }
        Kind::Posture => Course::phases(0.8, 1.0, 1.0, 0.8),
        Kind::PostureShift => Course::phases(0.8, 0.0, 0.0, 0.0),
        Kind::Face | Kind::FaceLexeme | Kind::FaceFacs => Course::phases(0.3, 0.4, 0.6, 0.4),
        Kind::FaceShift => Course::phases(0.4, 0.0, 0.0, 0.0),
        Kind::Locomotion => Course::phases(0.0, 2.0, 0.0, 0.0),
        Kind::Wait => {
            let secs = element.value("duration").and_then(|text| text.parse().ok());
            let secs = secs.filter(|secs: &f64| (0.0..=1e5).contains(secs));
            Course::phases(0.0, secs.unwrap_or(0.0), 0.0, 0.0)
        }
        Kind::Speech => Course::phases(0.0, 0.0, 0.0, 0.0),
    }
}

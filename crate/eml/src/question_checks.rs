//! Checks of a lesson: answerable questions, and existing answers, variables and parts.

use crate::clauses::asking::{Assignment, Condition};
use crate::diagnostic::Sink;
use crate::hints::{SuggestionBudget, hinted, twice};
use crate::questions;
use crate::suggest::quoted;
use crate::{ClauseKind, Diagnostic, Document, Span};
use std::collections::{BTreeMap, BTreeSet};

/// Name of the current score in conditions.
const SCORE: &str = "score";

/// The type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum VariableType {
    Number,
    Text,
    Truth,
}

impl VariableType {
    fn from_value(value: &str) -> Self {
        match value {
            "true" | "false" => Self::Truth,
            _ if value.trim().parse::<f64>().is_ok_and(f64::is_finite) => Self::Number,
            _ => Self::Text,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Number => "a number",
            Self::Text => "a text",
            Self::Truth => "true or false",
        }
    }
}

/// Reports problems with questions, variables and parts. A fragment may ask questions; its
/// performance does not continue by parts like a story.
pub(crate) fn lesson(document: &Document, is_fragment: bool, sink: &mut Sink) {
    let mut names = LessonNames::default();
    for clause in &document.clauses {
        names.collect(&clause.kind, clause.tag_span, is_fragment, sink);
    }
    if names.is_empty() {
        return;
    }
    for clause in &document.clauses {
        let span = clause.tag_span;
        match &clause.kind {
            ClauseKind::Ask(ask) => questions::check(document, ask, span, &mut names.looks, sink),
            ClauseKind::If(branch) => names.condition(&branch.condition, span, sink),
            ClauseKind::Pool(pool) => {
                let (count, all) = (pool.draw.count as usize, pool.content.children.len());
                if count > all {
                    let message =
                        format!("{count} clauses are to be drawn from {all}; all are performed");
                    sink.push(Diagnostic::warning("eml::small-pool", span, message));
                }
            }
            ClauseKind::Goto(goto) if !names.parts.contains(goto.to.as_str()) => {
                let message = format!(
                    "there is no part {}; this goto has no effect",
                    quoted(&goto.to)
                );
                let near = names.looks.suggest(&goto.to, &names.parts);
                sink.push(hinted(
                    Diagnostic::error("eml::unknown-part", span, message),
                    near,
                ));
            }
            _ => {}
        }
    }
}

/// The names of a lesson.
#[derive(Default)]
struct LessonNames<'d> {
    questions: BTreeSet<&'d str>,
    parts: BTreeSet<&'d str>,
    variables: BTreeMap<&'d str, Option<VariableType>>,
    conditions: bool,
    gotos: bool,
    looks: SuggestionBudget,
}

impl<'d> LessonNames<'d> {
    fn is_empty(&self) -> bool {
        self.questions.is_empty()
            && self.parts.is_empty()
            && self.variables.is_empty()
            && !self.conditions
            && !self.gotos
    }

    fn collect(&mut self, kind: &'d ClauseKind, span: Span, is_fragment: bool, sink: &mut Sink) {
        let (what, name, set) = match kind {
            ClauseKind::Ask(ask) => ("question", ask.question.name.as_str(), &mut self.questions),
            ClauseKind::Part(part) => ("part", part.heading.name.as_str(), &mut self.parts),
            ClauseKind::Set(assignment) if !is_fragment => {
                return self.variable(assignment, span, sink);
            }
            ClauseKind::If(_) | ClauseKind::Pool(_) => {
                self.conditions = true;
                return;
            }
            ClauseKind::Goto(_) | ClauseKind::Set(_) => {
                self.gotos = true;
                if is_fragment {
                    let message = "branching is only allowed in stories, not in a live performance";
                    sink.push(Diagnostic::error("eml::wrong-parent", span, message));
                }
                return;
            }
            _ => return,
        };
        if !set.insert(name) {
            sink.push(twice(what, name, span));
        }
    }

    fn variable(&mut self, assignment: &'d Assignment, span: Span, sink: &mut Sink) {
        let name = assignment.name.as_str();
        if name == SCORE {
            sink.push(twice("value", name, span));
        }
        let number = assignment.by.map(|_| VariableType::Number);
        let value = assignment.value.as_deref().map(VariableType::from_value);
        let first = self.variables.entry(name).or_default();
        // One whose value could not be read is there all the same.
        *first = first.or(value).or(number);
        let Some(kind) = *first else { return };
        if let Some(other) = [value, number].into_iter().flatten().find(|k| *k != kind) {
            let message = format!(
                "{} is {} elsewhere, and {} here",
                quoted(name),
                kind.name(),
                other.name()
            );
            sink.push(Diagnostic::warning("eml::variable-type", span, message));
        }
    }

    fn condition(&mut self, condition: &Condition, span: Span, sink: &mut Sink) {
        let name = condition.name.as_str();
        let compared = condition.above.is_some() || condition.below.is_some();
        let kind = match self.variables.get(name) {
            Some(Some(kind)) => *kind,
            Some(None) => return,
            None if name == SCORE => VariableType::Number,
            None if self.questions.contains(name) => VariableType::Text,
            None => {
                let message = format!(
                    "nothing sets {}, and no question has this name",
                    quoted(name)
                );
                let known = self.variables.keys().chain(&self.questions);
                let near = self.looks.suggest(name, known);
                sink.push(hinted(
                    Diagnostic::error("eml::unknown-variable", span, message),
                    near,
                ));
                return;
            }
        };
        let values = [&condition.is, &condition.not];
        let differs = values
            .into_iter()
            .flatten()
            .any(|value| kind != VariableType::Text && VariableType::from_value(value) != kind);
        if differs || (compared && kind != VariableType::Number) {
            let message = format!(
                "{} is {}, and is compared with something else",
                quoted(name),
                kind.name()
            );
            sink.push(Diagnostic::warning("eml::variable-type", span, message));
        }
    }
}

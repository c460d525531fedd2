//! Checks of a lesson: questions that can be answered, answers, variables and parts that
//! there are.

use crate::clauses::asking::{AskKind, AskOption, Assignment, Condition};
use crate::clauses::sets::BONES;
use crate::diagnostic::Sink;
use crate::suggest::{MOST_HINTS, nearest, quoted};
use crate::{Ask, ClauseKind, Diagnostic, Document, Span};
use std::collections::{BTreeMap, BTreeSet};

/// What the points so far are called in conditions.
const SCORE: &str = "score";

/// Hints that are looked for in one document, which bounds their cost.
const MOST_LOOKS: usize = 64;

/// The type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Type {
    Number,
    Text,
    Truth,
}

impl Type {
    fn of(value: &str) -> Self {
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

/// Reports what is wrong with questions, variables and parts. A fragment may ask; its performance
/// goes on by other ways than those of a story.
pub(crate) fn lesson(document: &Document, is_fragment: bool, sink: &mut Sink) {
    let mut names = Names::default();
    for clause in &document.clauses {
        names.collect(&clause.kind, clause.tag_span, is_fragment, sink);
    }
    if names.is_empty() {
        return;
    }
    for clause in &document.clauses {
        let span = clause.tag_span;
        match &clause.kind {
            ClauseKind::Ask(ask) => question(document, ask, span, &mut names, sink),
            ClauseKind::If(branch) => names.condition(&branch.condition, span, sink),
            ClauseKind::Goto(goto) if !names.parts.contains(goto.to.as_str()) => {
                let message = format!(
                    "no part has the name {}; this goto leads nowhere",
                    quoted(&goto.to)
                );
                let near = names.near(&goto.to, &names.parts);
                names.looks += 1;
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
struct Names<'d> {
    questions: BTreeSet<&'d str>,
    parts: BTreeSet<&'d str>,
    variables: BTreeMap<&'d str, Option<Type>>,
    conditions: bool,
    gotos: bool,
    looks: usize,
}

impl<'d> Names<'d> {
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
            ClauseKind::If(_) => {
                self.conditions = true;
                return;
            }
            ClauseKind::Goto(_) | ClauseKind::Set(_) => {
                self.gotos = true;
                if is_fragment {
                    let message = "ways through a story belong in stories; a performance that goes on has none";
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
        let number = assignment.by.map(|_| Type::Number);
        let value = assignment.value.as_deref().map(Type::of);
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
            None if name == SCORE => Type::Number,
            None if self.questions.contains(name) => Type::Text,
            None => {
                let message = format!(
                    "nothing sets {}, and no question has the name",
                    quoted(name)
                );
                let near = self.near(name, self.variables.keys().chain(&self.questions));
                self.looks += 1;
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
            .any(|value| kind != Type::Text && Type::of(value) != kind);
        if differs || (compared && kind != Type::Number) {
            let message = format!(
                "{} is {}, and is compared with something else",
                quoted(name),
                kind.name()
            );
            sink.push(Diagnostic::warning("eml::variable-type", span, message));
        }
    }

    /// What may have been meant.
    fn near<'n>(&self, name: &str, known: impl IntoIterator<Item = &'n &'n str>) -> Option<String> {
        if self.looks >= MOST_LOOKS {
            return None;
        }
        nearest(name, known.into_iter().copied().take(MOST_HINTS)).map(str::to_owned)
    }
}

fn hinted(diagnostic: Diagnostic, near: Option<String>) -> Diagnostic {
    match near {
        Some(near) => diagnostic.hint(format!("did you mean `{near}`?")),
        None => diagnostic,
    }
}

fn twice(what: &str, name: &str, span: Span) -> Diagnostic {
    let message = format!("a second {what} with the name {}", quoted(name));
    Diagnostic::error("eml::duplicate-name", span, message)
}

/// Reports a question that nobody can answer, and answers to nothing.
fn question(document: &Document, ask: &Ask, span: Span, names: &mut Names<'_>, sink: &mut Sink) {
    let asked = &ask.question;
    let mut options = BTreeSet::new();
    for option in &asked.options {
        if !options.insert(option.name.as_str()) {
            sink.push(twice("option", &option.name, span));
        }
        if let Some(lack) = lack(asked.kind, option, &asked.prompt) {
            let message = format!(
                "the option {} of a question of type='{}' {lack}",
                quoted(&option.name),
                asked.kind.word()
            );
            sink.push(Diagnostic::error("eml::ask-option", span, message));
        }
        if let Some(bone) = option.at.as_deref().filter(|at| !BONES.contains(at)) {
            let message = format!("there is no bone {}", quoted(bone));
            let near = names.near(bone, BONES);
            names.looks += 1;
            sink.push(hinted(
                Diagnostic::warning("eml::unknown-bone", span, message),
                near,
            ));
        }
    }
    right_options(ask, span, sink);
    for &id in &ask.answers.children {
        let clause = document.clause(id);
        let ClauseKind::Answer(answer) = &clause.kind else {
            continue;
        };
        let to = answer.reaction.to.as_str();
        if !matches!(to, "right" | "wrong") && !options.contains(to) {
            let message = format!(
                "no option has the name {}; this answer is never performed",
                quoted(to)
            );
            let near = names.near(to, &options);
            names.looks += 1;
            sink.push(hinted(
                Diagnostic::error("eml::unknown-option", clause.tag_span, message),
                near,
            ));
        }
    }
}

/// What an option has to have where a question is answered so, in words.
fn lack(kind: AskKind, option: &AskOption, prompt: &str) -> Option<&'static str> {
    let has = |text: &Option<String>| {
        text.as_deref()
            .is_some_and(|t| t.split('|').any(|t| t.contains(char::is_alphanumeric)))
    };
    match kind {
        AskKind::Choice | AskKind::Several | AskKind::Order if option.text.is_empty() => {
            Some("needs `text`")
        }
        AskKind::Match
            if option.text.is_empty() || option.partner.as_deref().unwrap_or("").is_empty() =>
        {
            Some("needs `text` and `partner`")
        }
        AskKind::Gap if !has(&option.accepts) => Some("needs `accepts`"),
        AskKind::Gap if !prompt.contains(&format!("[{}]", option.name)) => {
            Some("needs a gap in the prompt: its name in square brackets")
        }
        AskKind::Text if !has(&option.accepts) && !has(&option.rejects) => {
            Some("needs `accepts` or `rejects`")
        }
        AskKind::Number if option.least.is_none() && option.most.is_none() => {
            Some("needs `least` or `most`")
        }
        AskKind::Number if option.least.zip(option.most).is_some_and(|(l, m)| l > m) => {
            Some("takes no number: `least` is greater than `most`")
        }
        AskKind::Point if option.at.is_none() || option.text.is_empty() => {
            Some("needs `at` and `text`")
        }
        _ => None,
    }
}

/// Reports too few or too many options that are right.
fn right_options(ask: &Ask, span: Span, sink: &mut Sink) {
    let asked = &ask.question;
    let right = asked.options.iter().filter(|o| o.is_right).count();
    let name = quoted(&asked.name);
    let message = match asked.kind {
        AskKind::Order | AskKind::Match if asked.options.len() < 2 => {
            format!("{name} has nothing to put together: it needs two options")
        }
        AskKind::Order | AskKind::Match | AskKind::Gap => return,
        AskKind::Choice if right != 1 => {
            format!("of the options of {name} {right} are right, and one has to be")
        }
        _ if right == 0 => {
            format!("of the options of {name} none is right, and at least one has to be")
        }
        _ => return,
    };
    sink.push(Diagnostic::error("eml::ask-right", span, message));
}

//! Checks of one question: it can be answered, and its answers have a question.

use crate::clauses::asking::{AskKind, AskOption, Question};
use crate::clauses::sets::BONES;
use crate::diagnostic::Sink;
use crate::hints::{SuggestionBudget, hinted, twice};
use crate::suggest::{by_distance, quoted};
use crate::{Ask, ClauseKind, Diagnostic, Document, Span};
use std::collections::BTreeSet;

/// Outcomes available for every question, whatever its options.
const OUTCOMES: [&str; 3] = ["right", "wrong", "answered"];

/// Maximum length of a list of names in a hint, in characters, so no name is cut.
const HINT_LENGTH: usize = 300;

/// Reports a question that cannot be answered, and answers without a question. `span` is its start
/// tag.
pub(crate) fn check(
    document: &Document,
    ask: &Ask,
    span: Span,
    looks: &mut SuggestionBudget,
    sink: &mut Sink,
) {
    let asked = &ask.question;
    let mut names = BTreeSet::new();
    for option in &asked.options {
        if !names.insert(option.name.as_str()) {
            sink.push(twice("option", &option.name, option.span));
        }
        check_option(asked, option, looks, sink);
        picture(&option.picture, &option.alt, option.span, sink);
    }
    if asked.options.is_empty() && (asked.is_graded || !asked.kind.is_free()) {
        let message = format!("{} needs at least one `option` in it", quoted(&asked.name));
        sink.push(Diagnostic::error("eml::missing-child", span, message));
    } else if asked.is_graded {
        right_options(asked, span, sink);
    } else {
        ungraded(asked, span, sink);
    }
    kind_of(asked, span, sink);
    picture(&asked.picture, &asked.alt, span, sink);
    if matches!(asked.kind, AskKind::Order | AskKind::Match) && asked.options.len() == 1 {
        let name = quoted(&asked.name);
        let message = format!("{name} needs at least two options");
        sink.push(Diagnostic::error("eml::ask-right", span, message));
    }
    for &id in &ask.answers.children {
        let clause = document.clause(id);
        let ClauseKind::Answer(answer) = &clause.kind else {
            continue;
        };
        let to = answer.reaction.to.as_str();
        if !asked.is_graded && matches!(to, "right" | "wrong") {
            let message = format!(
                "{} is not graded; this answer is never performed",
                quoted(&asked.name)
            );
            sink.push(
                Diagnostic::warning("eml::unreachable", clause.tag_span, message)
                    .hint("to='answered' is performed after any answer"),
            );
        } else if !OUTCOMES.contains(&to) && !names.contains(to) {
            let message = format!(
                "there is no option {}; this answer is never performed",
                quoted(to)
            );
            let near = looks.suggest(to, names.iter().chain(&OUTCOMES));
            sink.push(hinted(
                Diagnostic::error("eml::unknown-option", clause.tag_span, message),
                near,
            ));
        }
    }
}

fn check_option(
    asked: &Question,
    option: &AskOption,
    looks: &mut SuggestionBudget,
    sink: &mut Sink,
) {
    if let Some(lack) = lack(asked, option) {
        let message = format!(
            "the option {} of a question of type='{}' {lack}",
            quoted(&option.name),
            asked.kind.word()
        );
        sink.push(Diagnostic::error("eml::ask-option", option.span, message));
    }
    if let Some(bone) = option.at.as_deref().filter(|at| !BONES.contains(at)) {
        let message = format!("there is no bone {}", quoted(bone));
        let mut told = Diagnostic::warning("eml::unknown-bone", option.span, message);
        if looks.take_budget() {
            for names in listed(&by_distance(bone, BONES.iter().copied())) {
                told = told.hint(names);
            }
        }
        sink.push(told);
    }
}

/// Returns names in lines that are short enough to be shown whole.
fn listed(names: &[&str]) -> Vec<String> {
    let mut lines = vec!["valid names, nearest first:".to_owned()];
    for name in names {
        let last = lines.len() - 1;
        if lines[last].len() + name.len() > HINT_LENGTH {
            lines.push(format!("or {name}"));
        } else {
            let sign = if lines[last].ends_with(':') { "" } else { "," };
            lines[last] = format!("{}{sign} {name}", lines[last]);
        }
    }
    lines
}

/// Returns a description of the attribute that an option lacks for the answer type of its question.
fn lack(asked: &Question, option: &AskOption) -> Option<&'static str> {
    let has = |text: &Option<String>| {
        text.as_deref()
            .is_some_and(|t| t.split('|').any(|t| t.contains(char::is_alphanumeric)))
    };
    let is_graded = asked.is_graded;
    let says = |text: Option<&str>| text.is_some_and(|text| !text.is_empty());
    // An image with a text alternative is as good as words.
    let is_shown = option.picture.is_some() && says(option.alt.as_deref());
    let is_mute = option.text.is_empty() && !is_shown;
    match asked.kind {
        AskKind::Choice | AskKind::Several | AskKind::Order if is_mute => Some("needs `text`"),
        AskKind::Match if is_mute || option.partner.as_deref().unwrap_or("").is_empty() => {
            Some("needs `text` and `partner`")
        }
        AskKind::Gap if is_graded && !has(&option.accepts) => Some("needs `accepts`"),
        AskKind::Gap if !asked.prompt.contains(&format!("[{}]", option.name)) => {
            Some("needs a gap in the prompt: its name in square brackets")
        }
        AskKind::Text if !has(&option.accepts) && !has(&option.rejects) => {
            Some("needs `accepts` or `rejects`")
        }
        AskKind::Number if option.least.is_none() && option.most.is_none() => {
            Some("needs `least` or `most`")
        }
        AskKind::Number if option.least.zip(option.most).is_some_and(|(l, m)| l > m) => {
            Some("accepts no number: `least` is greater than `most`")
        }
        AskKind::Point if option.at.is_none() || is_mute => Some("needs `at` and `text`"),
        _ => None,
    }
}

/// Reports too few or too many options that are right.
fn right_options(asked: &Question, span: Span, sink: &mut Sink) {
    let right = || asked.options.iter().filter(|o| o.is_right);
    let name = quoted(&asked.name);
    let (at, message) = match (asked.kind, right().count()) {
        (AskKind::Order | AskKind::Match | AskKind::Gap, _) => return,
        (AskKind::Choice, 1) => return,
        // The second one is one too many.
        (AskKind::Choice, count) => (
            right().nth(1).map_or(span, |option| option.span),
            format!("{count} options of {name} are right, but exactly one must be"),
        ),
        (_, 0) => (
            span,
            format!("no option of {name} is right, but at least one must be"),
        ),
        _ => return,
    };
    let told = Diagnostic::error("eml::ask-right", at, message);
    sink.push(match right().next() {
        Some(_) => told,
        None => told.hint("a question with graded='false' has no right answer"),
    });
}

/// Reports attributes without effect on an ungraded question.
fn ungraded(asked: &Question, span: Span, sink: &mut Sink) {
    for option in asked.options.iter().filter(|option| option.is_right) {
        ignored("right", option.span, "if nothing is graded", sink);
    }
    let given = [
        ("points", (asked.points - 1.0).abs() > 0.0),
        ("tries", asked.tries != 1),
        ("hint", asked.hint.is_some()),
        ("partial", asked.is_partial),
        ("feedbackRight", asked.feedback_right.is_some()),
        ("feedbackWrong", asked.feedback_wrong.is_some()),
    ];
    for (attribute, _) in given.into_iter().filter(|(_, is_given)| *is_given) {
        ignored(attribute, span, "if nothing is graded", sink);
    }
}

/// Reports attributes without effect for the answer type of a question.
fn kind_of(asked: &Question, span: Span, sink: &mut Sink) {
    let of = format!("with type='{}'", asked.kind.word());
    if asked.is_graded && asked.is_partial && !asked.kind.has_parts() {
        ignored("partial", span, &of, sink);
    }
    if asked.is_shuffled && !asked.kind.is_listed() {
        ignored("shuffle", span, &of, sink);
    }
}

/// Reports an image without a text alternative, and a text alternative without an image.
fn picture(file: &Option<String>, alt: &Option<String>, span: Span, sink: &mut Sink) {
    match (file, alt) {
        (Some(file), None) => sink.push(
            Diagnostic::warning(
                "eml::missing-alt",
                span,
                format!("the picture {} has no text alternative", quoted(file)),
            )
            .hint("describe it in `alt`, or write alt='' if the text already says it"),
        ),
        (None, Some(_)) => ignored("alt", span, "without `picture`", sink),
        _ => {}
    }
}

fn ignored(attribute: &str, span: Span, beside: &str, sink: &mut Sink) {
    let message = format!("`{attribute}` has no effect {beside}");
    sink.push(Diagnostic::warning("eml::ignored-attribute", span, message));
}

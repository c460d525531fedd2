//! Extensions: questions of a lesson and what follows from their answers.

use crate::record::{record, words};
use crate::{Group, Span};

words! {
    /// How a question is answered.
    AskKind {
        /// By one of its options.
        Choice = "choice",
        /// By all of its options that are right.
        Several = "several",
    }
}

record! {
    /// What one may answer.
    AskOption = "option" {
        /// Its name.
        name: String = "name",
        /// What is read.
        text: String = "text",
        /// Whether it is right.
        is_right: bool = "right",
    }
}

record! {
    /// A question, without what follows from its answers.
    Question = "ask" {
        /// Its name.
        name: String = "name",
        /// How it is answered.
        kind: AskKind = "type",
        /// What is asked, to be read.
        prompt: String = "prompt",
        /// What a right answer counts.
        points: f64 = "points",
        /// How often one may answer.
        tries: u32 = "tries",
        /// What is read after a wrong answer, while there are tries left.
        hint: Option<String> = "hint",
    }
    children {
        /// What one may answer, in order.
        options: Vec<AskOption>
    }
}

record! {
    /// After which answers something is performed.
    Reaction = "answer" {
        /// `right`, `wrong`, or the name of an option.
        to: String = "to",
    }
}

/// A question, with what follows from its answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ask {
    /// The question.
    pub question: Question,
    /// Its answers, one after another in the timeline; which of them is performed is only known
    /// when somebody has answered.
    pub answers: Group,
}

/// What is performed after certain answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// After which.
    pub reaction: Reaction,
    /// Its clauses, together.
    pub content: Group,
}

impl Default for Group {
    fn default() -> Self {
        Self {
            children: Vec::new(),
            repetition_count: 1,
            repetition_span: Span::default(),
            iteration_secs: None,
        }
    }
}

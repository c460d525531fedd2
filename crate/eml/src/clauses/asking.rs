//! Extensions: questions of a lesson and what follows from their answers.

use crate::record::{record, words};

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

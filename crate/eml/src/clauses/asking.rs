//! Extensions: questions of a lesson, the effects of their answers, and branches of a story.

use crate::record::{record, words};

words! {
    /// Answer type of a question.
    AskKind {
        /// Answered by choosing one of the options.
        Choice = "choice",
        /// Answered by choosing all correct options.
        Several = "several",
        /// Answered by putting all options in order.
        Order = "order",
        /// Answered by matching each option with its partner.
        Match = "match",
        /// By text entered into gaps of the prompt.
        Gap = "gap",
        /// Answered by entering a number.
        Number = "number",
        /// Answered by pointing at a part of the figure.
        Point = "point",
        /// Answered by entering free text.
        Text = "text",
    }
}

impl AskKind {
    /// Returns true if the answer is free input instead of an offered option.
    #[must_use]
    pub fn is_free(self) -> bool {
        matches!(self, Self::Number | Self::Text)
    }

    /// Returns true if an answer has parts, which may be partly right.
    #[must_use]
    pub fn has_parts(self) -> bool {
        matches!(self, Self::Several | Self::Order | Self::Match | Self::Gap)
    }

    /// Returns true if its options are shown in a vertical list.
    #[must_use]
    pub fn is_listed(self) -> bool {
        !matches!(self, Self::Gap | Self::Number | Self::Text)
    }
}

record! {
    /// A possible answer, or a rule for accepted answers.
    AskOption = "option" {
        /// Name of the option, used in reactions and results.
        name: String = "name",
        /// Displayed text.
        text: String = "text",
        /// Image shown with it, a file next to the story.
        picture: Option<String> = "picture",
        /// Text alternative of the image.
        alt: Option<String> = "alt",
        /// True if it is a right answer.
        is_right: bool = "right",
        /// Correct partner of the option, for questions of type `match`.
        partner: Option<String> = "partner",
        /// Accepted texts, for `gap` and `text`: separated by bars.
        accepts: Option<String> = "accepts",
        /// Texts that must not occur, for `text`: separated by bars.
        rejects: Option<String> = "rejects",
        /// Smallest accepted number.
        least: Option<f64> = "least",
        /// Largest accepted number.
        most: Option<f64> = "most",
        /// The bone that is pointed at.
        at: Option<String> = "at",
    }
    placed {
        /// Span of the start tag.
        span
    }
}

record! {
    /// A question without the reactions to its answers.
    Question = "ask" {
        /// Name of the question, used in conditions and results.
        name: String = "name",
        /// Answer type.
        kind: AskKind = "type",
        /// Displayed text of the question.
        prompt: String = "prompt",
        /// Image shown with it, a file next to the story.
        picture: Option<String> = "picture",
        /// Text alternative of the image.
        alt: Option<String> = "alt",
        /// True if answers are graded right or wrong; otherwise every answer is accepted.
        is_graded: bool = "graded",
        /// Points for a right answer.
        points: f64 = "points",
        /// Enables points for partly right answers.
        is_partial: bool = "partial",
        /// Enables random order of its options.
        is_shuffled: bool = "shuffle",
        /// Maximum number of tries.
        tries: u32 = "tries",
        /// Text shown after a wrong answer, while tries are left.
        hint: Option<String> = "hint",
        /// Text shown after the final answer.
        feedback: Option<String> = "feedback",
        /// Text shown instead after a right answer.
        feedback_right: Option<String> = "feedbackRight",
        /// Text shown instead after a wrong answer.
        feedback_wrong: Option<String> = "feedbackWrong",
        /// Time limit, seconds; none: unlimited.
        limit_secs: Option<f64> = "limit",
    }
    children {
        /// Possible answers, in order.
        options: Vec<AskOption>
    }
}

record! {
    /// Answers that trigger a reaction.
    Reaction = "answer" {
        /// `right`, `wrong`, `answered`, or the name of an option.
        to: String = "to",
    }
}

record! {
    /// The heading of a part of the story.
    Heading = "part" {
        /// Name of the part, used as the destination of a `goto`.
        name: String = "name",
        /// Displayed text.
        title: String = "title",
    }
}

record! {
    /// Condition on a variable or a question.
    Condition = "if" {
        /// The variable, the question, or `score`.
        name: String = "name",
        /// Value that the variable or answer must equal.
        is: Option<String> = "is",
        /// Value that the variable or answer must not equal.
        not: Option<String> = "not",
        /// Lower bound: the number must be greater.
        above: Option<f64> = "above",
        /// Upper bound: the number must be smaller.
        below: Option<f64> = "below",
    }
}

record! {
    /// Random draw from a pool.
    Draw = "pool" {
        /// Number of clauses drawn for each learner.
        count: u32 = "count",
    }
}

record! {
    /// Assignment of a variable.
    Assignment = "r:set" {
        /// The variable.
        name: String = "name",
        /// Value to assign: a number, `true` or `false`, or any other text.
        value: Option<String> = "value",
        /// Increment of its number, which begins at 0.
        by: Option<f64> = "by",
    }
}

record! {
    /// Continues the story at another part.
    Goto = "goto" {
        /// Name of the destination part.
        to: String = "to",
    }
}

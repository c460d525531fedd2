//! Extensions: questions of a lesson, the effects of their answers, and branches of a story.

use crate::record::{record, words};

words! {
    /// Answer type of a question.
    AskKind {
        /// By one of its options.
        Choice = "choice",
        /// By all of its options that are right.
        Several = "several",
        /// By all of its options in their order.
        Order = "order",
        /// By giving each option its partner.
        Match = "match",
        /// By text entered into gaps of the prompt.
        Gap = "gap",
        /// By a number.
        Number = "number",
        /// By pointing at a part of the figure.
        Point = "point",
        /// By a text of one's own.
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
        /// Its name.
        name: String = "name",
        /// Displayed text.
        text: String = "text",
        /// Image shown with it, a file next to the story.
        picture: Option<String> = "picture",
        /// Text alternative of the image.
        alt: Option<String> = "alt",
        /// True if it is a right answer.
        is_right: bool = "right",
        /// Its right partner, of `match`.
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
        /// Its start tag.
        span
    }
}

record! {
    /// A question without the reactions to its answers.
    Question = "ask" {
        /// Its name.
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
        /// Its name.
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
        /// It is this.
        is: Option<String> = "is",
        /// It is not this.
        not: Option<String> = "not",
        /// It is a greater number than this.
        above: Option<f64> = "above",
        /// It is a smaller number than this.
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
        /// Its value: a number, `true` or `false`, or any other text.
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

//! Extensions: questions of a lesson, what follows from their answers, and ways through a story.

use crate::record::{record, words};

words! {
    /// How a question is answered.
    AskKind {
        /// By one of its options.
        Choice = "choice",
        /// By all of its options that are right.
        Several = "several",
        /// By all of its options in their order.
        Order = "order",
        /// By giving each option its partner.
        Match = "match",
        /// By what is written into gaps of the prompt.
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
    /// Whether it is answered by what somebody writes, which no option has to offer.
    #[must_use]
    pub fn is_free(self) -> bool {
        matches!(self, Self::Number | Self::Text)
    }

    /// Whether an answer has parts, some of which may be right.
    #[must_use]
    pub fn has_parts(self) -> bool {
        matches!(self, Self::Several | Self::Order | Self::Match | Self::Gap)
    }

    /// Whether its options are shown one below the other.
    #[must_use]
    pub fn is_listed(self) -> bool {
        !matches!(self, Self::Gap | Self::Number | Self::Text)
    }
}

record! {
    /// What one may answer, or a rule for what one may.
    AskOption = "option" {
        /// Its name.
        name: String = "name",
        /// What is read.
        text: String = "text",
        /// A picture beside the story that is shown with it.
        picture: Option<String> = "picture",
        /// What the picture shows, for those who do not see it.
        alt: Option<String> = "alt",
        /// Whether it is right.
        is_right: bool = "right",
        /// Its right partner, of `match`.
        partner: Option<String> = "partner",
        /// What is taken, of `gap` and `text`: texts between bars.
        accepts: Option<String> = "accepts",
        /// What must not be there, of `text`: texts between bars.
        rejects: Option<String> = "rejects",
        /// The least number that is taken.
        least: Option<f64> = "least",
        /// The greatest number that is taken.
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
    /// A question, without what follows from its answers.
    Question = "ask" {
        /// Its name.
        name: String = "name",
        /// How it is answered.
        kind: AskKind = "type",
        /// What is asked, to be read.
        prompt: String = "prompt",
        /// A picture beside the story that is shown with it.
        picture: Option<String> = "picture",
        /// What the picture shows, for those who do not see it.
        alt: Option<String> = "alt",
        /// Whether some answers are right and others wrong; else whatever is answered is taken.
        is_graded: bool = "graded",
        /// What a right answer counts.
        points: f64 = "points",
        /// Whether what is right of an answer counts by itself.
        is_partial: bool = "partial",
        /// Whether its options are shown in an order by chance.
        is_shuffled: bool = "shuffle",
        /// How often one may answer.
        tries: u32 = "tries",
        /// What is read after a wrong answer, while there are tries left.
        hint: Option<String> = "hint",
        /// What is read once it is answered for good.
        feedback: Option<String> = "feedback",
        /// What is read in its place after a right answer.
        feedback_right: Option<String> = "feedbackRight",
        /// What is read in its place after a wrong answer.
        feedback_wrong: Option<String> = "feedbackWrong",
        /// How long one may think about it, seconds; none: as long as one likes.
        limit_secs: Option<f64> = "limit",
    }
    children {
        /// What one may answer, in order.
        options: Vec<AskOption>
    }
}

record! {
    /// After which answers something is performed.
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
        /// What is read.
        title: String = "title",
    }
}

record! {
    /// When something is performed: what a variable or a question has to be.
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
    /// How much is drawn of a pool.
    Draw = "pool" {
        /// How many of its clauses each learner has.
        count: u32 = "count",
    }
}

record! {
    /// A variable takes a value.
    Assignment = "r:set" {
        /// The variable.
        name: String = "name",
        /// Its value: a number, `true` or `false`, or any other text.
        value: Option<String> = "value",
        /// What is added to its number, which begins at 0.
        by: Option<f64> = "by",
    }
}

record! {
    /// The story goes on elsewhere.
    Goto = "goto" {
        /// The part where it goes on.
        to: String = "to",
    }
}

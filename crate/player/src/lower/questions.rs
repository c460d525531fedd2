//! Questions of a story at their times.

use raconteur_eml::{AskKind, AskOption, ClauseKind};

use crate::lower::script::Script;

/// Question of a lesson at its story time, with the position of the reactions to its answers.
#[derive(Clone, Debug, PartialEq)]
pub struct QuestionCue {
    /// Position among all entries of the story, which orders simultaneous ones.
    pub order: u32,
    /// Position of the enclosing answer, condition or pool item.
    pub within: Option<u32>,
    /// Time at which the story pauses for the answer, seconds.
    pub at_secs: f64,
    /// Time at which it continues after the reaction, seconds.
    pub end_secs: f64,
    /// Name, the key of its results.
    pub name: String,
    /// Type of answer that the question expects.
    pub kind: AskKind,
    /// Displayed text of the question.
    pub prompt: String,
    /// Image shown with it.
    pub picture: Option<PictureCue>,
    /// True if answers are graded right or wrong.
    pub is_graded: bool,
    /// Points for a right answer; 0 if ungraded.
    pub points: f64,
    /// Enables points for partly right answers.
    pub is_partial: bool,
    /// Enables random order of its options.
    pub is_shuffled: bool,
    /// Maximum number of tries.
    pub tries: u32,
    /// Text shown after a wrong answer, while tries are left.
    pub hint: Option<String>,
    /// Text shown after the final answer.
    pub feedback: FeedbackCue,
    /// Time limit for an answer, seconds; `None` for unlimited.
    pub limit_secs: Option<f64>,
    /// Possible answers, in order.
    pub options: Vec<OptionCue>,
    /// Reactions to the answers, in order.
    pub answers: Vec<AnswerCue>,
}

/// Image of a question or an option, with its text alternative.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureCue {
    /// Path of its file, relative to the story's folder and inside it.
    pub file: String,
    /// Text alternative of the image.
    pub alt: String,
}

impl PictureCue {
    fn new(file: &Option<String>, alt: &Option<String>) -> Option<Self> {
        Some(Self {
            file: file.clone()?,
            alt: alt.clone().unwrap_or_default(),
        })
    }
}

/// Feedback texts shown after the final answer, if the author provides them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FeedbackCue {
    /// Text shown after any answer.
    pub any: Option<String>,
    /// Replacement after a right answer.
    pub right: Option<String>,
    /// Replacement after a wrong answer.
    pub wrong: Option<String>,
}

/// Possible answer of a question, or a rule for accepted answers.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionCue {
    /// Name of the option, reported with the answer.
    pub name: String,
    /// Displayed text of the option.
    pub text: String,
    /// Image shown with it.
    pub picture: Option<PictureCue>,
    /// True if it is a right answer.
    pub is_right: bool,
    /// Correct partner of the option, for questions of type `match`.
    pub partner: Option<String>,
    /// Accepted texts, for `gap` and `text`.
    pub accepts: Vec<String>,
    /// Texts that must not occur, for `text`.
    pub rejects: Vec<String>,
    /// Smallest accepted number, for questions of type `number`.
    pub min: Option<f64>,
    /// Largest accepted number, for questions of type `number`.
    pub max: Option<f64>,
    /// The bone that is pointed at.
    pub at: Option<String>,
}

impl OptionCue {
    fn new(option: &AskOption) -> Self {
        let texts = |bars: &Option<String>| {
            let all = bars.iter().flat_map(|texts| texts.split('|'));
            all.map(str::trim)
                .filter(|t| !t.is_empty())
                .map(str::to_owned)
                .collect()
        };
        Self {
            name: option.name.clone(),
            text: option.text.clone(),
            picture: PictureCue::new(&option.picture, &option.alt),
            is_right: option.is_right,
            partner: option.partner.clone(),
            accepts: texts(&option.accepts),
            rejects: texts(&option.rejects),
            min: option.least,
            max: option.most,
            at: option.at.clone(),
        }
    }
}

/// Reaction to an answer: the times in the story at which it is performed.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerCue {
    /// Position among all entries of the story.
    pub order: u32,
    /// `right`, `wrong`, `answered`, or the name of an option.
    pub to: String,
    /// Start of the reaction, story time, seconds.
    pub start_secs: f64,
    /// End of the reaction, story time, seconds.
    pub end_secs: f64,
}

impl Script {
    /// Returns the questions of the script, sorted by time.
    #[must_use]
    pub fn questions(&self) -> Vec<QuestionCue> {
        let timed = &self.timeline.clauses;
        let mut found: Vec<(u32, QuestionCue)> = Vec::new();
        for (index, at) in (0_u32..).zip(timed) {
            match &self.document.clause(at.clause).kind {
                ClauseKind::Ask(ask) => {
                    let question = &ask.question;
                    let options = question.options.iter().map(OptionCue::new);
                    let cue = QuestionCue {
                        order: index,
                        within: self.optional_around(index, at),
                        at_secs: at.start_secs,
                        end_secs: at.end_secs,
                        name: question.name.clone(),
                        kind: question.kind,
                        prompt: question.prompt.clone(),
                        picture: PictureCue::new(&question.picture, &question.alt),
                        is_graded: question.is_graded,
                        points: if question.is_graded {
                            question.points
                        } else {
                            0.0
                        },
                        is_partial: question.is_partial,
                        is_shuffled: question.is_shuffled,
                        tries: question.tries,
                        hint: question.hint.clone(),
                        feedback: FeedbackCue {
                            any: question.feedback.clone(),
                            right: question.feedback_right.clone(),
                            wrong: question.feedback_wrong.clone(),
                        },
                        limit_secs: question.limit_secs,
                        options: options.collect(),
                        answers: Vec::new(),
                    };
                    found.push((index, cue));
                }
                ClauseKind::Answer(answer) => {
                    // A group precedes its content.
                    let of = at
                        .container
                        .and_then(|ask| found.binary_search_by_key(&ask, |(ask, _)| *ask).ok());
                    if let Some((_, question)) = of.and_then(|of| found.get_mut(of)) {
                        question.answers.push(AnswerCue {
                            order: index,
                            to: answer.reaction.to.clone(),
                            start_secs: at.start_secs,
                            end_secs: at.end_secs,
                        });
                    }
                }
                _ => {}
            }
        }
        found.into_iter().map(|(_, question)| question).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_question_tells_where_its_answers_lie() {
        let text = "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='1'><null time='2'/>\
            <r:ask time='0' name='q' prompt='Who?' tries='2' hint='Green.'><r:option name='a' text='A' right='true'/>\
            <r:option name='b' text='B'/><r:answer to='right'><null time='2'/></r:answer>\
            <r:answer to='wrong'><null time='3'/></r:answer></r:ask><null time='5'/></seq></body></eml>";
        let script = Script::read(text, None);
        assert_eq!(script.diagnostics, []);
        let questions = script.questions();
        assert_eq!(questions.len(), 1);
        let q = &questions[0];
        assert_eq!((q.at_secs, q.end_secs, q.tries), (3.0, 10.0, 2));
        let spans: Vec<_> = q
            .answers
            .iter()
            .map(|a| (&*a.to, a.start_secs, a.end_secs))
            .collect();
        assert_eq!(spans, [("right", 4.0, 6.0), ("wrong", 7.0, 10.0)]);
        assert_eq!(script.timeline.duration_secs, 15.0);
    }
}

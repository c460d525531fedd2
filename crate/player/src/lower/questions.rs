//! Questions of a story, at their times.

use raconteur_eml::{AskKind, AskOption, ClauseKind};

use crate::lower::script::Script;

/// A question, and where in the story what follows from its answers lies.
#[derive(Clone, Debug, PartialEq)]
pub struct QuestionCue {
    /// Its place among all that the story comes to, for what lies at one time.
    pub order: u32,
    /// The place of the answer, condition or item of a pool around it.
    pub within: Option<u32>,
    /// Where the story rests until it is answered, seconds.
    pub at_secs: f64,
    /// Where it goes on after what follows from an answer, seconds.
    pub end_secs: f64,
    /// Its name: results are kept by it.
    pub name: String,
    /// How it is answered.
    pub kind: AskKind,
    /// What is read.
    pub prompt: String,
    /// What is shown with it.
    pub picture: Option<PictureCue>,
    /// Whether answers are right or wrong.
    pub is_graded: bool,
    /// What a right answer counts; 0 where none is right.
    pub points: f64,
    /// Whether what is right of an answer counts by itself.
    pub is_partial: bool,
    /// Whether its options are shown in an order by chance.
    pub is_shuffled: bool,
    /// How often one may answer.
    pub tries: u32,
    /// What is read after a wrong answer, while there are tries left.
    pub hint: Option<String>,
    /// What is read once it is answered for good.
    pub feedback: FeedbackCue,
    /// How long one may think about it, seconds.
    pub limit_secs: Option<f64>,
    /// What one may answer, in order.
    pub options: Vec<OptionCue>,
    /// What follows, in order.
    pub answers: Vec<AnswerCue>,
}

/// A picture of a question or an option.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureCue {
    /// The path of its file, from the story's folder, which it does not leave.
    pub file: String,
    /// What it shows, for those who do not see it.
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

/// What is read once a question is answered for good, where its author says so.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FeedbackCue {
    /// After any answer.
    pub any: Option<String>,
    /// In its place after a right one.
    pub right: Option<String>,
    /// In its place after a wrong one.
    pub wrong: Option<String>,
}

/// What one may answer, or a rule for what one may.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionCue {
    /// Its name.
    pub name: String,
    /// What is read.
    pub text: String,
    /// What is shown with it.
    pub picture: Option<PictureCue>,
    /// Whether it is right.
    pub is_right: bool,
    /// Its right partner, of `match`.
    pub partner: Option<String>,
    /// What is taken, of `gap` and `text`.
    pub accepts: Vec<String>,
    /// What must not be there, of `text`.
    pub rejects: Vec<String>,
    /// The least number that is taken.
    pub least: Option<f64>,
    /// The greatest number that is taken.
    pub most: Option<f64>,
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
            least: option.least,
            most: option.most,
            at: option.at.clone(),
        }
    }
}

/// What follows from an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerCue {
    /// Its place among all that the story comes to.
    pub order: u32,
    /// `right`, `wrong`, `answered`, or the name of an option.
    pub to: String,
    /// Where it begins, seconds.
    pub start_secs: f64,
    /// Where it ends, seconds.
    pub end_secs: f64,
}

impl Script {
    /// The questions, by time.
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
                    // A group stands before what is in it.
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

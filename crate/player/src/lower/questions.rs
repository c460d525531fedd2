//! Questions of a story, at their times.

use raconteur_eml::{AskKind, ClauseKind};

use crate::lower::script::Script;

/// A question, and where in the story what follows from its answers lies.
#[derive(Clone, Debug, PartialEq)]
pub struct QuestionCue {
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
    /// What a right answer counts.
    pub points: f64,
    /// How often one may answer.
    pub tries: u32,
    /// What is read after a wrong answer, while there are tries left.
    pub hint: Option<String>,
    /// What one may answer, in order.
    pub options: Vec<OptionCue>,
    /// What follows, in order.
    pub answers: Vec<AnswerCue>,
}

/// What one may answer.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionCue {
    /// Its name.
    pub name: String,
    /// What is read.
    pub text: String,
    /// Whether it is right.
    pub is_right: bool,
}

/// What follows from an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerCue {
    /// `right`, `wrong`, or the name of an option.
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
                    let options = question.options.iter().map(|option| OptionCue {
                        name: option.name.clone(),
                        text: option.text.clone(),
                        is_right: option.is_right,
                    });
                    let cue = QuestionCue {
                        at_secs: at.start_secs,
                        end_secs: at.end_secs,
                        name: question.name.clone(),
                        kind: question.kind,
                        prompt: question.prompt.clone(),
                        points: question.points,
                        tries: question.tries,
                        hint: question.hint.clone(),
                        options: options.collect(),
                        answers: Vec::new(),
                    };
                    found.push((index, cue));
                }
                ClauseKind::Answer(answer) => {
                    // A group stands before what is in it.
                    let of = found.iter_mut().find(|(ask, _)| Some(*ask) == at.container);
                    if let Some((_, question)) = of {
                        question.answers.push(AnswerCue {
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

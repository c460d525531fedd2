//! Messages to JavaScript about a story's questions and branches.

use raconteur_player::{
    AnswerCue, FeedbackCue, OptionCue, PictureCue, QuestionCue, WayCue, WayKind,
};
use serde::Serialize;

/// Questions of a story and the paths through it, for the page's lesson interface.
#[derive(Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Lesson {
    questions: Vec<Question>,
    ways: Vec<FlowEntry>,
}

impl Lesson {
    /// Creates the lesson from the cues of a script.
    #[must_use]
    pub fn new(questions: Vec<QuestionCue>, ways: Vec<WayCue>) -> Self {
        Self {
            questions: questions.into_iter().map(Question::from).collect(),
            ways: ways.into_iter().map(FlowEntry::from).collect(),
        }
    }
}

/// A question.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Question {
    order: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<u32>,
    at_secs: f64,
    end_secs: f64,
    name: String,
    kind: &'static str,
    prompt: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    picture: Option<Picture>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_ungraded: bool,
    points: f64,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_partial: bool,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_shuffled: bool,
    tries: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    hint: Option<String>,
    feedback: Feedback,
    #[serde(skip_serializing_if = "Option::is_none")]
    limit_secs: Option<f64>,
    options: Vec<Choice>,
    answers: Vec<Answer>,
}

/// An image of a question or an option.
#[derive(Debug, Serialize)]
struct Picture {
    file: String,
    alt: String,
}

impl From<PictureCue> for Picture {
    fn from(PictureCue { file, alt }: PictureCue) -> Self {
        Self { file, alt }
    }
}

/// Texts shown after the final answer.
#[derive(Debug, Serialize)]
struct Feedback {
    #[serde(skip_serializing_if = "Option::is_none")]
    any: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    right: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrong: Option<String>,
}

impl From<FeedbackCue> for Feedback {
    fn from(FeedbackCue { any, right, wrong }: FeedbackCue) -> Self {
        Self { any, right, wrong }
    }
}

/// A possible answer.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Choice {
    name: String,
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    picture: Option<Picture>,
    is_right: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    partner: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    accepts: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rejects: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    least: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    most: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<String>,
}

impl From<OptionCue> for Choice {
    fn from(cue: OptionCue) -> Self {
        Self {
            name: cue.name,
            text: cue.text,
            picture: cue.picture.map(Picture::from),
            is_right: cue.is_right,
            partner: cue.partner,
            accepts: cue.accepts,
            rejects: cue.rejects,
            least: cue.min,
            most: cue.max,
            at: cue.at,
        }
    }
}

/// Reaction to an answer.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Answer {
    order: u32,
    to: String,
    start_secs: f64,
    end_secs: f64,
}

impl From<AnswerCue> for Answer {
    fn from(cue: AnswerCue) -> Self {
        Self {
            order: cue.order,
            to: cue.to,
            start_secs: cue.start_secs,
            end_secs: cue.end_secs,
        }
    }
}

impl From<QuestionCue> for Question {
    fn from(cue: QuestionCue) -> Self {
        Self {
            order: cue.order,
            within: cue.within,
            at_secs: cue.at_secs,
            end_secs: cue.end_secs,
            name: cue.name,
            kind: cue.kind.word(),
            prompt: cue.prompt,
            picture: cue.picture.map(Picture::from),
            is_ungraded: !cue.is_graded,
            points: cue.points,
            is_partial: cue.is_partial,
            is_shuffled: cue.is_shuffled,
            tries: cue.tries,
            hint: cue.hint,
            feedback: cue.feedback.into(),
            limit_secs: cue.limit_secs,
            options: cue.options.into_iter().map(Choice::from).collect(),
            answers: cue.answers.into_iter().map(Answer::from).collect(),
        }
    }
}

/// An entry on a path through a story.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct FlowEntry {
    order: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<u32>,
    at_secs: f64,
    end_secs: f64,
    #[serde(flatten)]
    what: FlowEntryKind,
}

/// Kind of an entry.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
enum FlowEntryKind {
    Part {
        name: String,
        title: String,
    },
    If {
        name: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        is: Option<String>,
        #[serde(skip_serializing_if = "Option::is_none")]
        not: Option<String>,
        #[serde(skip_serializing_if = "Option::is_none")]
        above: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")]
        below: Option<f64>,
    },
    Set {
        name: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        value: Option<String>,
        #[serde(skip_serializing_if = "Option::is_none")]
        by: Option<f64>,
    },
    Pool {
        count: u32,
    },
    Item {
        pool: u32,
    },
    Goto {
        to: String,
    },
}

impl From<WayCue> for FlowEntry {
    fn from(cue: WayCue) -> Self {
        let what = match cue.kind {
            WayKind::Part { name, title } => FlowEntryKind::Part { name, title },
            WayKind::If {
                name,
                is,
                not,
                above,
                below,
            } => FlowEntryKind::If {
                name,
                is,
                not,
                above,
                below,
            },
            WayKind::Set { name, value, by } => FlowEntryKind::Set { name, value, by },
            WayKind::Pool { count } => FlowEntryKind::Pool { count },
            WayKind::Item { pool } => FlowEntryKind::Item { pool },
            WayKind::Goto { to } => FlowEntryKind::Goto { to },
        };
        Self {
            order: cue.order,
            within: cue.within,
            at_secs: cue.at_secs,
            end_secs: cue.end_secs,
            what,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_way_is_one_plain_object() {
        let cue = WayCue {
            order: 3,
            within: None,
            at_secs: 1.0,
            end_secs: 2.0,
            kind: WayKind::If {
                name: "x".into(),
                is: None,
                not: None,
                above: Some(1.0),
                below: None,
            },
        };
        let lesson = Lesson::new(Vec::new(), vec![cue]);
        assert_eq!(
            serde_json::to_value(lesson).unwrap(),
            json!({"questions": [], "ways": [{"order": 3, "atSecs": 1.0, "endSecs": 2.0, "kind": "if", "name": "x", "above": 1.0}]})
        );
    }
}

//! `ask`, `option` and `answer`: questions.

use super::{Attribute, CLAUSE_PARENTS, Content, Element, Kind, Role};
use crate::ClauseKind;
use crate::clauses::asking::AskKind;

const PICTURE: Attribute = Attribute::new(
    "picture",
    Kind::Path,
    "An image shown with it, stored next to the story.",
);
const ALT: Attribute = Attribute::text(
    "alt",
    "A text alternative for the image; empty if the text already says it.",
);

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Asks a question: the story halts until it is answered, then performs the matching answer and continues.",
    ),
    decision: super::reference_text(
        "The spoken question precedes the element, in a voice-text; the prompt is for reading. A number or text that is not graded needs no options. The answers follow each other in the timeline, a second apart, so that a story can be seeked and baked; the player skips those that do not match. A film shows all of them.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><voice-text time='0'>Who sang?</voice-text><r:ask time='0' name='who' prompt='Who sang?'><r:option name='frog' text='A frog' right='true'/><r:option name='stone' text='A stone'/><r:answer to='right'><voice-text time='0'>Yes!</voice-text></r:answer><r:answer to='wrong'><voice-text time='0'>Stones do not sing.</voice-text></r:answer></r:ask></seq></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    attributes: &[
        Attribute::identifier(
            "name",
            "A unique name among the questions; results are stored under it.",
        )
        .required(),
        Attribute::choice(
            "type",
            AskKind::WORDS,
            "How the question is answered: by one option, by all that are right, by ordering all options (they are written in the right order), by giving each its partner, by filling the gaps of the prompt, where the names of options are written in square brackets, by a number, by pointing at the figure, or by a free text.",
        )
        .default("choice"),
        Attribute::text("prompt", "The question, to be read and to be read aloud.").required(),
        PICTURE,
        ALT,
        Attribute::flag(
            "graded",
            "Whether answers are right or wrong. A question that is not graded, as in a survey or a reflection, accepts any answer, immediately and finally, and counts no points.",
        )
        .default("true"),
        Attribute::between("points", 0.0, 1000.0, "The points for a right answer.").default("1"),
        Attribute::flag(
            "partial",
            "Whether a partly right answer earns part of the points: with type='several', the right minus the wrong choices as a share of all right ones; with match and gap, the share that is right; with order, the share of neighbours in the right order.",
        )
        .default("false"),
        Attribute::flag(
            "shuffle",
            "Whether each learner gets the options in a random order, which stays the same when they come back. The options of order and the partners of match are always shuffled; without this flag, in the same order for all learners.",
        )
        .default("false"),
        Attribute::integer("tries", 1, 100, "The number of attempts.").default("1"),
        Attribute::text(
            "hint",
            "Text to read after a wrong answer while attempts remain.",
        ),
        Attribute::text(
            "feedback",
            "Text to read once the question is answered for good. By default, if no answer is performed, it states whether the answer was right, and the right answer.",
        ),
        Attribute::text(
            "feedbackRight",
            "Text to read instead of feedback after a right answer.",
        ),
        Attribute::text(
            "feedbackWrong",
            "Text to read instead of feedback after a wrong answer.",
        ),
        Attribute::seconds_up_to(
            "limit",
            86_400.0,
            "The time limit, after which the question counts as answered wrong. Learners can request more time.",
        ),
    ],
    ..Element::new(
        "ask",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::Ask(Box::default())),
    )
};

pub(super) static OPTION: Element = Element {
    doc: super::reference_text("A possible answer, or a rule for accepted answers."),
    decision: super::reference_text(
        "A text is compared by its letters and digits only, in lower case and without accents, so punctuation does not matter. Of the rules of a number or a text, the first match decides.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:ask time='0' name='q' type='several' prompt='Which are green?'><r:option name='a' text='Frogs' right='true'/><r:option name='b' text='Leaves' right='true'/><r:option name='c' text='Snow'/></r:ask></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::identifier("name", "A unique name among the options of the question.")
            .required(),
        Attribute::text(
            "text",
            "The text of the option. Optional for gaps, numbers and texts, and if a picture expresses it.",
        )
        .default(""),
        PICTURE,
        ALT,
        Attribute::flag(
            "right",
            "Whether it is right; all options of order, match and gap are.",
        )
        .default("false"),
        Attribute::text("partner", "Its matching partner, with type='match'."),
        Attribute::text(
            "accepts",
            "Accepted texts, separated by a vertical bar: the complete content of a gap, or words that a text must contain.",
        ),
        Attribute::text(
            "rejects",
            "Words, separated by a vertical bar, none of which a text may contain.",
        ),
        Attribute::number("least", "The smallest accepted number."),
        Attribute::number("most", "The largest accepted number."),
        Attribute::identifier("at", "The bone to point at, with type='point'."),
    ],
    ..Element::part("option", &["ask"])
};

pub(super) static ANSWER: Element = Element {
    doc: super::reference_text("Content performed after certain answers; plain times count from its start."),
    source: super::reference_text("Extension"),
    example: ELEMENT.example,
    extension: true,
    content: Content::Elements,
    attributes: &[Attribute::identifier(
        "to",
        "right, wrong (when no attempts are left), answered (any answer), or the name of a chosen option; the first matching answer is performed.",
    )
    .required()],
    ..Element::new(
        "answer",
        &["ask"],
        Role::Scene(|| ClauseKind::Answer(Box::default())),
    )
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::codes;
    use crate::{ClauseKind, Timeline, parse};

    const ASK: &str = "<r:ask time='0' name='q' prompt='Who?'><r:option name='a' text='A' right='true'/>\
        <r:option name='b' text='B'/><r:answer to='right'><null time='2'/></r:answer>\
        <r:answer to='b'><event time='1' type='x'/></r:answer></r:ask>";

    fn script(body: &str) -> String {
        format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>")
    }

    #[test]
    fn a_question_has_options_and_answers() {
        let parsed = parse(&script(ASK));
        assert_eq!(parsed.diagnostics, []);
        let ClauseKind::Ask(ask) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        let options: Vec<_> = ask
            .question
            .options
            .iter()
            .map(|o| (&*o.name, o.is_right))
            .collect();
        assert_eq!(options, [("a", true), ("b", false)]);
        assert_eq!((ask.question.points, ask.question.tries), (1.0, 1));
        assert_eq!(ask.answers.children.len(), 2);
    }

    #[test]
    fn answers_follow_each_other_and_the_story_goes_on_after_them() {
        let text = script(&format!(
            "<seq time='3'>{ASK}<event time='0' type='y'/></seq>"
        ));
        let parsed = parse(&text);
        let timeline = Timeline::resolve(&parsed.document, &crate::EstimatedDurations).timeline;
        let spans: Vec<_> = timeline
            .clauses
            .iter()
            .map(|c| {
                (
                    parsed.document.clause(c.clause).kind.name(),
                    c.start_secs,
                    c.end_secs,
                )
            })
            .collect();
        assert_eq!(
            spans,
            [
                ("seq", 3.0, 8.0),
                ("ask", 3.0, 8.0),
                ("answer", 4.0, 6.0),
                ("null", 6.0, 6.0),
                ("answer", 7.0, 8.0),
                ("event", 8.0, 8.0),
                ("event", 8.0, 8.0),
            ]
        );
    }

    #[test]
    fn what_cannot_be_meant_is_told() {
        let with = |inside: &str, kind: &str| {
            codes(&script(&format!(
                "<r:ask time='0' name='q' type='{kind}' prompt='?'><r:option name='a' text='A' right='true'/>{inside}</r:ask>"
            )))
        };
        assert_eq!(with("", "choice"), [""; 0]);
        assert_eq!(
            with("<r:option name='a' text='B'/>", "choice"),
            ["eml::duplicate-name"]
        );
        assert_eq!(
            with("<r:option name='b' text='B' right='true'/>", "choice"),
            ["eml::ask-right"]
        );
        assert_eq!(
            with("<r:option name='b' text='B' right='true'/>", "several"),
            [""; 0]
        );
        assert_eq!(
            with("<r:answer to='c'><null time='1'/></r:answer>", "choice"),
            ["eml::unknown-option"]
        );
        let none = "<r:ask time='0' name='q' prompt='?'><r:option name='a' text='A'/></r:ask>";
        assert_eq!(codes(&script(none)), ["eml::ask-right"]);
        assert_eq!(
            codes(&script(&format!("{ASK}{ASK}"))),
            ["eml::duplicate-name"]
        );
    }

    #[test]
    fn the_option_at_fault_is_marked_and_all_places_are_listed_the_nearest_first() {
        let option = "<r:option name='b' text='B' at='l_wrst'/>";
        let text = script(&format!(
            "<r:ask time='0' name='q' type='point' prompt='?'><r:option name='a' text='A' at='l_elbow' right='true'/>{option}</r:ask>"
        ));
        let told = &parse(&text).diagnostics[0];
        assert_eq!(told.code, "eml::unknown-bone");
        let (from, to) = (told.span.start as usize, told.span.end as usize);
        assert_eq!(&text[from..to], option);
        assert!(
            told.hints[0].starts_with("valid names, nearest first: l_wrist, r_wrist"),
            "{:?}",
            told.hints
        );
        // No name is cut or missing.
        let words = told.hints.join(", ");
        let listed = |bone: &&str| words.split([',', ' ']).any(|word| word == *bone);
        assert!(
            crate::clauses::sets::BONES.iter().all(listed),
            "every bone is listed"
        );
    }

    #[test]
    fn a_fragment_asks_and_leaves_what_follows_to_its_sender() {
        let text = ASK.replace("<r:ask", "<r:ask xmlns:r='urn:raconteur:eml:1'");
        let parsed = crate::parse_fragment(&text);
        assert_eq!(parsed.document.clauses.len(), 1);
        let codes: Vec<_> = parsed.diagnostics.iter().map(|d| d.code).collect();
        assert_eq!(codes, ["eml::wrong-parent"; 2]);
        let way = "<r:goto xmlns:r='urn:raconteur:eml:1' time='0' to='x'/>";
        assert_eq!(
            crate::parse_fragment(way).diagnostics[0].code,
            "eml::wrong-parent"
        );
    }
}

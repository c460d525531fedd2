//! `ask`, `option` and `answer`: questions.

use super::{Attribute, CLAUSE_PARENTS, Content, Element, Kind, Role};
use crate::ClauseKind;
use crate::clauses::asking::AskKind;

const PICTURE: Attribute = Attribute::new(
    "picture",
    Kind::Path,
    "A picture beside the story that is shown with it.",
);
const ALT: Attribute = Attribute::text(
    "alt",
    "What the picture shows, for those who do not see it; empty where the text says it already.",
);

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Asks something: the story rests until it is answered, then performs the answer that fits and goes on.",
    ),
    decision: super::reference_text(
        "What the storyteller says to ask it comes before, in a voice-text; the prompt is what is read. A number and a text that are not graded need no options. Its answers lie one after another in the timeline, a second apart, so that a story may be sought and baked; the player passes over those that do not fit. A film shows them all.",
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
            "A name that no other question has: results are kept by it.",
        )
        .required(),
        Attribute::choice(
            "type",
            AskKind::WORDS,
            "How it is answered: by one option, by all that are right, by putting all in order (they are written in it), by giving each its partner, by filling the gaps of the prompt, where the names of options stand in square brackets, by a number, by pointing at the figure, or by a text of one's own.",
        )
        .default("choice"),
        Attribute::text("prompt", "What is asked, to be read and to be read aloud.").required(),
        PICTURE,
        ALT,
        Attribute::flag(
            "graded",
            "Whether answers are right or wrong. A question that is not graded, as in a survey or a reflection, takes whatever is answered, at once and for good, and counts no points.",
        )
        .default("true"),
        Attribute::between("points", 0.0, 1000.0, "What a right answer counts.").default("1"),
        Attribute::flag(
            "partial",
            "Whether an answer that is right in part counts in part, with type='several' (what is right less what is wrong, of all that is right), match and gap (the share that is right), and order (the share of neighbours in their order).",
        )
        .default("false"),
        Attribute::flag(
            "shuffle",
            "Whether each learner has the options in an order by chance, the same whenever they come back. Those of order, and partners of match, are mixed in any case, else alike for all learners.",
        )
        .default("false"),
        Attribute::integer("tries", 1, 100, "How often one may answer.").default("1"),
        Attribute::text(
            "hint",
            "What is read after a wrong answer, while there are tries left.",
        ),
        Attribute::text(
            "feedback",
            "What is read once it is answered for good. Where no answer is performed, it is by itself whether that was right, and what is right.",
        ),
        Attribute::text(
            "feedbackRight",
            "What is read in its place after a right answer.",
        ),
        Attribute::text(
            "feedbackWrong",
            "What is read in its place after a wrong answer.",
        ),
        Attribute::seconds_up_to(
            "limit",
            86_400.0,
            "How long one may think about it; then it counts as answered wrong. Who asks for more time gets it.",
        ),
    ],
    ..Element::new(
        "ask",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::Ask(Box::default())),
    )
};

pub(super) static OPTION: Element = Element {
    doc: super::reference_text("Something that one may answer, or a rule for what one may."),
    decision: super::reference_text(
        "A text is compared by its letters and digits alone, in small letters and without accents, so that nobody fails by a comma. Of the rules of a number or a text the first one that fits decides.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:ask time='0' name='q' type='several' prompt='Which are green?'><r:option name='a' text='Frogs' right='true'/><r:option name='b' text='Leaves' right='true'/><r:option name='c' text='Snow'/></r:ask></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::identifier("name", "A name that no other option of the question has.")
            .required(),
        Attribute::text(
            "text",
            "What is read; gaps, numbers and texts may do without, and so may what has a picture that says it.",
        )
        .default(""),
        PICTURE,
        ALT,
        Attribute::flag(
            "right",
            "Whether it is right; in order, match and gap all are.",
        )
        .default("false"),
        Attribute::text("partner", "Its right partner, with type='match'."),
        Attribute::text(
            "accepts",
            "What is taken, texts with a bar between them: the whole of what is written into a gap, or words that a text has to hold.",
        ),
        Attribute::text(
            "rejects",
            "Words, with a bar between them, none of which a text may hold.",
        ),
        Attribute::number("least", "The least number that is taken."),
        Attribute::number("most", "The greatest number that is taken."),
        Attribute::identifier("at", "The bone that is pointed at, with type='point'."),
    ],
    ..Element::part("option", &["ask"])
};

pub(super) static ANSWER: Element = Element {
    doc: super::reference_text("What is performed after certain answers; plain times count from its start."),
    source: super::reference_text("Extension"),
    example: ELEMENT.example,
    extension: true,
    content: Content::Elements,
    attributes: &[Attribute::identifier(
        "to",
        "right, wrong (when there are no tries left), answered (whatever it was), or the name of an option that was chosen; the first answer that fits is performed.",
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
            told.hints[0].starts_with("it may be, the nearest first: l_wrist, r_wrist"),
            "{:?}",
            told.hints
        );
        // None of the names is cut, or missing.
        let words = told.hints.join(", ");
        let listed = |bone: &&str| words.split([',', ' ']).any(|word| word == *bone);
        assert!(crate::clauses::sets::BONES.iter().all(listed));
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

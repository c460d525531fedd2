//! `part`, `if`, `pool`, `set` and `goto`: ways through a story.

use super::{Attribute, CLAUSE_PARENTS, Content, Element, Role};
use crate::ClauseKind;

pub(super) static PART: Element = Element {
    doc: super::reference_text(
        "A part of the story with a title: players list the parts, and a goto leads to one.",
    ),
    decision: super::reference_text("Its clauses play together, as in a par; put a seq into it."),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:part time='0' name='hare' title='The hare'><null time='2'/></r:part></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    attributes: &[
        Attribute::identifier("name", "A name that no other part has.").required(),
        Attribute::text("title", "What is read.").required(),
    ],
    ..Element::new(
        "part",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::Part(Box::default())),
    )
};

pub(super) static IF: Element = Element {
    doc: super::reference_text(
        "Performs its clauses where a condition holds, and passes over them else.",
    ),
    decision: super::reference_text(
        "A question is `right` or `wrong` once it is answered for good, or the name of an option that was chosen; `score` is the number of points so far. All conditions that are given have to hold. A variable that was never set is an empty text, and 0 where it is compared. The timeline has room for the clauses in any case, as for answers; without a time it begins a tenth of a second after what is before it, so that it is told apart from that.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><r:set time='0' name='pace' value='slow'/><r:if time='0' name='pace' is='slow'><null time='2'/></r:if></seq></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    one_of: &["is", "not", "above", "below"],
    attributes: &[
        Attribute::identifier("name", "A variable, a question, or `score`.").required(),
        Attribute::text("is", "What it has to be."),
        Attribute::text("not", "What it must not be."),
        Attribute::number("above", "A number that it has to be greater than."),
        Attribute::number("below", "A number that it has to be smaller than."),
    ],
    ..Element::new(
        "if",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::If(Box::default())),
    )
};

pub(super) static POOL: Element = Element {
    doc: super::reference_text(
        "Performs some of its clauses, which are drawn for each learner, one after another, and passes over the others.",
    ),
    decision: super::reference_text(
        "What is drawn is the same whenever the learner comes back, and keeps its order. What is to be drawn together, as a question and what is said before it, stands in a seq. The points of questions that are not drawn do not count, nor does what is not drawn belong to the story that has to be seen. The timeline has room for all clauses, and a film shows them all. Let each begin a tenth of a second after the one before, so that they are told apart.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:pool time='0' count='1'><seq time='0.1'><voice-text time='0'>Who sang?</voice-text><r:ask time='0' name='who' prompt='Who sang?'><r:option name='frog' text='A frog' right='true'/><r:option name='stone' text='A stone'/></r:ask></seq><r:ask time='0.1' name='where' prompt='Where?'><r:option name='pond' text='In a pond' right='true'/><r:option name='tree' text='On a tree'/></r:ask></r:pool></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    attributes: &[Attribute::integer(
        "count",
        1,
        1000,
        "How many of the clauses in it are performed.",
    )
    .required()],
    ..Element::new(
        "pool",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::Pool(Box::default())),
    )
};

pub(super) static SET: Element = Element {
    doc: super::reference_text("Gives a variable a value, when the story comes to it."),
    decision: super::reference_text(
        "A value that reads as a number is one, `true` and `false` are truth values, all else is text; a variable has one type throughout a story. It is done once, unless a goto leads back before it.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:set time='0' name='coins' by='1'/><r:if time='0' name='coins' above='0'><null time='1'/></r:if></body></eml>",
    ),
    extension: true,
    one_of: &["value", "by"],
    attributes: &[
        Attribute::identifier("name", "The variable.").required(),
        Attribute::text("value", "Its value."),
        Attribute::number("by", "What is added to its number, which begins at 0."),
    ],
    ..Element::record("set", || ClauseKind::Set(Box::default()))
};

pub(super) static GOTO: Element = Element {
    doc: super::reference_text("Has the story go on at a part."),
    decision: super::reference_text(
        "Where it leads back, questions and variables from there on are asked and set anew. A way that leads round without a question is an error, and so is one that never comes to an end.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><null time='1'/><r:goto time='0' to='end'/><r:part time='0' name='end' title='The end'><null time='1'/></r:part></seq></body></eml>",
    ),
    extension: true,
    attributes: &[Attribute::identifier("to", "The name of the part.").required()],
    ..Element::record("goto", || ClauseKind::Goto(Default::default()))
};

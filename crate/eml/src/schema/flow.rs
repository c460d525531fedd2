//! `part`, `if`, `pool`, `set` and `goto`: branches of a story.

use super::{Attribute, CLAUSE_PARENTS, Content, Element, Role};
use crate::ClauseKind;

pub(super) static PART: Element = Element {
    doc: super::reference_text(
        "A titled part of the story: players list the parts, and a goto can jump to one.",
    ),
    decision: super::reference_text(
        "Its clauses play simultaneously, as in a par; put a seq into it.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:part time='0' name='hare' title='The hare'><null time='2'/></r:part></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    attributes: &[
        Attribute::identifier("name", "A unique name among the parts.").required(),
        Attribute::text("title", "The displayed title.").required(),
    ],
    ..Element::new(
        "part",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::Part(Box::default())),
    )
};

pub(super) static IF: Element = Element {
    doc: super::reference_text(
        "Performs its clauses if a condition holds, and skips them otherwise.",
    ),
    decision: super::reference_text(
        "A question is `right` or `wrong` once it is answered for good, or the name of a chosen option; `score` is the number of points so far. All given conditions must hold. An unset variable is an empty text, and 0 in numeric comparisons. The timeline always reserves time for the clauses, as for answers. Without a time, the element begins a tenth of a second after the content before it, so that the two can be distinguished.",
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
        Attribute::text("is", "The required value."),
        Attribute::text("not", "The excluded value."),
        Attribute::number("above", "A number that it must exceed."),
        Attribute::number("below", "A number that it must be less than."),
    ],
    ..Element::new(
        "if",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::If(Box::default())),
    )
};

pub(super) static POOL: Element = Element {
    doc: super::reference_text(
        "Performs some of its clauses, drawn at random for each learner, one after another, and skips the others.",
    ),
    decision: super::reference_text(
        "The draw stays the same when the learner comes back, and keeps the order of the clauses. Put clauses that belong together, such as a question and its introduction, into a seq. The points of questions that are not drawn do not count, nor are undrawn clauses required for completion of the story. The timeline reserves time for all clauses, and a film shows all of them. Let each begin a tenth of a second after the one before, so that they can be distinguished.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:pool time='0' count='1'><seq time='0.1'><voice-text time='0'>Who sang?</voice-text><r:ask time='0' name='who' prompt='Who sang?'><r:option name='frog' text='A frog' right='true'/><r:option name='stone' text='A stone'/></r:ask></seq><r:ask time='0.1' name='where' prompt='Where?'><r:option name='pond' text='In a pond' right='true'/><r:option name='tree' text='On a tree'/></r:ask></r:pool></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    attributes: &[
        Attribute::integer("count", 1, 1000, "The number of its clauses to perform.").required(),
    ],
    ..Element::new(
        "pool",
        CLAUSE_PARENTS,
        Role::Scene(|| ClauseKind::Pool(Box::default())),
    )
};

pub(super) static SET: Element = Element {
    doc: super::reference_text("Sets a variable when the story reaches it."),
    decision: super::reference_text(
        "A value that reads as a number is a number, `true` and `false` are booleans, anything else is text; a variable has one type throughout a story. It is set once, unless a goto leads back before it.",
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
        Attribute::number("by", "A number added to its value, which starts at 0."),
    ],
    ..Element::record("set", || ClauseKind::Set(Box::default()))
};

pub(super) static GOTO: Element = Element {
    doc: super::reference_text("Jumps to a part of the story."),
    decision: super::reference_text(
        "If it leads back, questions and variables from there on are asked and set again. A loop without a question is an error, and so is a path that never ends.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><null time='1'/><r:goto time='0' to='end'/><r:part time='0' name='end' title='The end'><null time='1'/></r:part></seq></body></eml>",
    ),
    extension: true,
    attributes: &[Attribute::identifier("to", "The name of the part.").required()],
    ..Element::record("goto", || ClauseKind::Goto(Default::default()))
};

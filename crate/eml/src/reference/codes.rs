//! Diagnostic codes of reading and timing a script.

/// The codes of diagnostics, by name, each with a description of the problem.
pub const CODES: &[(&str, &str)] = &[
    (
        "eml::alias",
        "An alternative spelling is understood, but is not the canonical one.",
    ),
    (
        "eml::ask-option",
        "An option lacks an attribute that its question's type requires, or can never be answered.",
    ),
    (
        "eml::ask-right",
        "A question has no right option, or more than one where one must be chosen.",
    ),
    ("eml::bad-boolean", "A boolean is not true, false, 1 or 0."),
    (
        "eml::bad-choice",
        "A value is not one of the attribute's keywords.",
    ),
    (
        "eml::bad-color",
        "A colour is not `#` with six hexadecimal digits.",
    ),
    (
        "eml::bad-controls",
        "An interpolation has the wrong number of control values.",
    ),
    (
        "eml::bad-name",
        "A name is empty, or cannot be used in time expressions.",
    ),
    (
        "eml::bad-number",
        "A value is not a number, is too large, or is not whole as required.",
    ),
    (
        "eml::bad-path",
        "A path could leave the folder of the story or of the library.",
    ),
    (
        "eml::bad-reference",
        "A character reference does not refer to an XML character.",
    ),
    (
        "eml::bad-time",
        "A time expression or a length in seconds cannot be parsed, or gives an implausible time.",
    ),
    (
        "eml::bad-url",
        "An address is neither relative nor http or https.",
    ),
    ("eml::bare-ampersand", "An `&` does not start a reference."),
    (
        "eml::control-character",
        "The text contains a control character, as binary files do.",
    ),
    (
        "eml::doctype",
        "There is a document type declaration, which EML does not allow.",
    ),
    (
        "eml::duplicate-argument",
        "A function has the same argument twice; the last one counts.",
    ),
    (
        "eml::duplicate-attribute",
        "An element has the same attribute twice; the first one counts.",
    ),
    (
        "eml::duplicate-name",
        "Two times, questions, parts, or options of a question have the same name; the first one counts.",
    ),
    (
        "eml::duplicate-player",
        "An animation player is added under an existing name.",
    ),
    (
        "eml::duplicate-set",
        "Two sets have the same name; the first one counts.",
    ),
    (
        "eml::duplicate-track",
        "A gesture has two tracks of the same feature for one hand; the first one counts.",
    ),
    (
        "eml::emotion-word",
        "An emotion word is not in the table; it is expressed at its point on the disc.",
    ),
    ("eml::empty-body", "The body is empty."),
    ("eml::empty-voice", "There is no text to speak."),
    (
        "eml::endless-ring",
        "A goto forms a loop without a question, or leads to a place from which no path ends.",
    ),
    (
        "eml::foreign-element",
        "An element belongs to another namespace; it is dropped.",
    ),
    (
        "eml::handedness",
        "A track is for a hand that does not take part in the gesture; it is ignored.",
    ),
    (
        "eml::ignored-attribute",
        "An attribute is overridden by another one and has no effect.",
    ),
    (
        "eml::key-order",
        "The keys of a track are not in the order of their times; they are sorted.",
    ),
    ("eml::late-key", "A key is after the end of its gesture."),
    (
        "eml::letter-case",
        "A name differs from the reference in letter case; it is understood.",
    ),
    (
        "eml::malformed",
        "Markup cannot be parsed; parsing continues after it.",
    ),
    (
        "eml::malformed-attribute",
        "An attribute does not have the form name='value'; it is corrected if its meaning is clear.",
    ),
    (
        "eml::malformed-tag",
        "A tag or a quote in it is not closed; the element is dropped.",
    ),
    (
        "eml::mismatched-end",
        "An end tag differs from its start tag in letter case.",
    ),
    (
        "eml::missing-alt",
        "A picture of a question has no text alternative.",
    ),
    (
        "eml::missing-attribute",
        "An element lacks a required attribute; it is dropped, or has no effect.",
    ),
    ("eml::missing-child", "An element lacks a required child."),
    (
        "eml::missing-time",
        "A clause directly in the body has no time; it starts at 0.",
    ),
    (
        "eml::more",
        "There are more problems of one kind than are listed individually.",
    ),
    (
        "eml::no-root",
        "Clauses are not enclosed in `eml` and `body`; they are read as a script.",
    ),
    (
        "eml::no-time",
        "A clause is left out because its time depends on an undefined time.",
    ),
    (
        "eml::not-utf8",
        "The text is not UTF-8, in one place or, if it is UTF-16, as a whole.",
    ),
    ("eml::not-xml", "The text contains no element."),
    (
        "eml::out-of-range",
        "A number is smaller or larger than the attribute allows.",
    ),
    (
        "eml::phone",
        "`phone` and event='onPhone' are not used together.",
    ),
    (
        "eml::phone-not-in-word",
        "The word of a `tm` does not contain its phone; the start of the word is used.",
    ),
    (
        "eml::set-cycle",
        "Sets contain each other; each counts once.",
    ),
    (
        "eml::small-pool",
        "A pool has fewer clauses than are to be drawn.",
    ),
    ("eml::stray-end", "An end tag has no start tag."),
    ("eml::stray-text", "Text has no meaning at its position."),
    (
        "eml::surplus-element",
        "There are more elements of a kind than their parent allows.",
    ),
    (
        "eml::surplus-joints",
        "More joint angles are preferred than the manipulator has joints; the rest is ignored.",
    ),
    (
        "eml::time-cycle",
        "Times depend on each other in a cycle; the chain is printed.",
    ),
    ("eml::too-deep", "Elements are nested too deeply."),
    ("eml::too-large", "The text or its content exceeds a limit."),
    (
        "eml::too-many-attributes",
        "An element has too many attributes.",
    ),
    ("eml::too-many-clauses", "There are too many clauses."),
    (
        "eml::too-many-namespaces",
        "There are too many namespace declarations.",
    ),
    (
        "eml::too-many-repetitions",
        "Repetitions produce too many clauses; they play once.",
    ),
    (
        "eml::too-many-words",
        "A clause or the whole story has too many words.",
    ),
    (
        "eml::unbound-prefix",
        "The prefix of a name is not bound by xmlns.",
    ),
    ("eml::unclosed", "An element has no end tag."),
    (
        "eml::unknown-attribute",
        "An element does not have this attribute.",
    ),
    ("eml::unknown-body-group", "No figure has this body group."),
    ("eml::unknown-bone", "No figure has this bone."),
    (
        "eml::unknown-element",
        "The language does not have this element.",
    ),
    ("eml::unknown-entity", "An entity is not one of XML's five."),
    ("eml::unknown-hand-shape", "No hand shape has this number."),
    (
        "eml::unknown-layer",
        "The name of a layer does not end in its number.",
    ),
    (
        "eml::unknown-name",
        "A time expression refers to an undefined name.",
    ),
    (
        "eml::unknown-option",
        "The question has no such option; this answer is never performed.",
    ),
    (
        "eml::unknown-part",
        "A goto refers to an undefined part; it has no effect.",
    ),
    (
        "eml::unknown-player",
        "No clause adds this animation player.",
    ),
    (
        "eml::unknown-set",
        "The head defines no such set; it counts as empty.",
    ),
    (
        "eml::unknown-variable",
        "A condition refers to neither a variable nor a question; it never holds.",
    ),
    (
        "eml::unreachable",
        "No path through the story reaches this clause; it is never performed.",
    ),
    (
        "eml::variable-type",
        "A variable is used with another type than that of its first assignment.",
    ),
    (
        "eml::wrong-parent",
        "An element is not allowed in its parent.",
    ),
    ("eml::wrong-root", "The outermost element is not `eml`."),
    ("eml::zero-axis", "The normal of a palm is zero."),
];

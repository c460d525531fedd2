//! Every kind of problem that reading and timing a script can report.

/// The codes of diagnostics, by name, each with what is wrong.
pub const CODES: &[(&str, &str)] = &[
    (
        "eml::alias",
        "Another spelling than the reference's; it is understood.",
    ),
    (
        "eml::ask-option",
        "An option lacks what the type of its question needs, or can never be answered.",
    ),
    (
        "eml::ask-right",
        "Of the options of a question none is right, or more than one where one is to be chosen.",
    ),
    (
        "eml::bad-boolean",
        "A truth value is none of true, false, 1 and 0.",
    ),
    (
        "eml::bad-choice",
        "A value is none of the words that the attribute allows.",
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
        "A number is none, is too large, or is not whole where it must be.",
    ),
    (
        "eml::bad-path",
        "A path could leave the folder of the story or of the library.",
    ),
    (
        "eml::bad-reference",
        "A character reference names no character of XML.",
    ),
    (
        "eml::bad-time",
        "A time expression or a length in seconds cannot be read, or comes to an absurd time.",
    ),
    (
        "eml::bad-url",
        "An address is neither relative nor by http or https.",
    ),
    ("eml::bare-ampersand", "An `&` starts no reference."),
    (
        "eml::control-character",
        "The text holds a control character, as binary files do.",
    ),
    (
        "eml::doctype",
        "There is a document type declaration; EML has none.",
    ),
    (
        "eml::duplicate-argument",
        "A function has an argument twice; the last one counts.",
    ),
    (
        "eml::duplicate-attribute",
        "An element has an attribute twice; the first one counts.",
    ),
    (
        "eml::duplicate-name",
        "Two moments, questions, parts, or options of a question have one name; the first one counts.",
    ),
    (
        "eml::duplicate-player",
        "An animation player is added under a name that another has.",
    ),
    (
        "eml::duplicate-set",
        "Two sets have one name; the first one counts.",
    ),
    (
        "eml::duplicate-track",
        "A gesture has two tracks of one feature for one hand; the first one counts.",
    ),
    (
        "eml::emotion-word",
        "A word of emotion beyond the table's; it is felt at its place on the disc.",
    ),
    ("eml::empty-body", "The body is empty."),
    ("eml::empty-voice", "There is nothing to speak."),
    (
        "eml::endless-ring",
        "A goto leads round without a question on the way, or to where no way comes to an end.",
    ),
    (
        "eml::foreign-element",
        "An element is of another namespace; it is dropped.",
    ),
    (
        "eml::handedness",
        "A track is for a hand that takes no part in the gesture; it is ignored.",
    ),
    (
        "eml::ignored-attribute",
        "An attribute does not count beside another one.",
    ),
    (
        "eml::key-order",
        "The keys of a track are not in the order of their times; they are sorted.",
    ),
    ("eml::late-key", "A key lies after the end of its gesture."),
    (
        "eml::letter-case",
        "A name is written in other letters, capital or small, than the reference's; it is understood.",
    ),
    (
        "eml::malformed",
        "Markup cannot be read; reading goes on behind it.",
    ),
    (
        "eml::malformed-attribute",
        "An attribute is not name='value'; it is mended where its meaning is plain.",
    ),
    (
        "eml::malformed-tag",
        "A tag or a quote in it is not closed; the element is dropped.",
    ),
    (
        "eml::mismatched-end",
        "An end tag differs from its start tag in capital letters.",
    ),
    (
        "eml::missing-alt",
        "A picture of a question has no words for those who do not see it.",
    ),
    (
        "eml::missing-attribute",
        "An element lacks an attribute that it needs; it is dropped, or does nothing.",
    ),
    (
        "eml::missing-child",
        "An element lacks a child that it needs.",
    ),
    (
        "eml::missing-time",
        "A clause right in the body has no time; it starts at 0.",
    ),
    (
        "eml::more",
        "There were more problems of a kind than are listed one by one.",
    ),
    (
        "eml::no-root",
        "Clauses stand without `eml` and `body` around them; they are read as a script.",
    ),
    (
        "eml::no-time",
        "A clause is left out because a moment that its time counts from has no time.",
    ),
    (
        "eml::not-utf8",
        "The text is not UTF-8: a place in it, or, as UTF-16, all of it.",
    ),
    ("eml::not-xml", "There is no element at all."),
    (
        "eml::out-of-range",
        "A number is smaller or larger than the attribute allows.",
    ),
    (
        "eml::phone",
        "`phone` and event='onPhone' do not go together here.",
    ),
    (
        "eml::phone-not-in-word",
        "The word that a `tm` is for does not have its phone; the word's start is used.",
    ),
    (
        "eml::set-cycle",
        "Sets contain each other; each counts once.",
    ),
    (
        "eml::small-pool",
        "More is to be drawn of a pool than is in it.",
    ),
    ("eml::stray-end", "An end tag closes nothing."),
    ("eml::stray-text", "Text stands where it means nothing."),
    (
        "eml::surplus-element",
        "There are more elements of a kind than their parent may hold.",
    ),
    (
        "eml::surplus-joints",
        "More joint angles are preferred than the manipulator has joints; the rest is ignored.",
    ),
    (
        "eml::time-cycle",
        "Times wait for each other; the chain is printed.",
    ),
    ("eml::too-deep", "Elements are nested too deep."),
    (
        "eml::too-large",
        "The text or what is in it exceeds a limit.",
    ),
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
        "Repetitions come to too many clauses; they play once.",
    ),
    (
        "eml::too-many-words",
        "A clause or the whole story speaks too many words.",
    ),
    (
        "eml::unbound-prefix",
        "No xmlns binds the prefix of a name.",
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
    (
        "eml::unknown-entity",
        "An entity other than the five of XML.",
    ),
    (
        "eml::unknown-hand-shape",
        "There is no hand shape of this number.",
    ),
    (
        "eml::unknown-layer",
        "A name of a layer does not end in its number.",
    ),
    ("eml::unknown-name", "A time expression names no moment."),
    (
        "eml::unknown-option",
        "A question has no such option; this answer is never performed.",
    ),
    (
        "eml::unknown-part",
        "A goto names no part; it leads nowhere.",
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
        "A condition names no variable and no question; it never holds.",
    ),
    (
        "eml::unreachable",
        "No way through the story leads to this clause; it is never performed.",
    ),
    (
        "eml::variable-type",
        "A variable is used as another type than where it is set first.",
    ),
    (
        "eml::wrong-parent",
        "An element may not stand where it does.",
    ),
    ("eml::wrong-root", "The outermost element is not `eml`."),
    ("eml::zero-axis", "The normal of a palm is zero."),
];

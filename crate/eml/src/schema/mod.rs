//! The language as a table: one small file per element, registered in [`ELEMENTS`], which drives
//! parsing, checks, writing and documentation.

mod affect;
mod animation_style;
mod arg;
mod ask;
mod attribute;
mod audio;
mod beat;
mod bg;
mod body;
mod body_animate_adsr_control_parameter;
mod body_animate_control_parameter;
mod body_configure_deterministic_animation;
mod body_configure_deterministic_track_property;
mod body_configure_geometry;
mod body_configure_manipulator;
mod body_deterministic_primitive;
mod body_expression_configuration;
mod body_load_control_parameter_animation;
mod body_non_deterministic_fk;
mod body_non_deterministic_frame_interpolation;
mod body_non_deterministic_function;
mod body_non_deterministic_jacobian;
mod body_non_deterministic_joint_interpolation;
mod body_non_deterministic_lock;
mod body_non_deterministic_stop;
mod body_player_add;
mod body_player_change_priority;
mod body_player_clear;
mod body_player_remove;
mod body_player_set_exclusive;
mod body_set_control_parameter;
mod bone;
mod bones;
mod break_;
mod camera;
mod common;
mod context;
mod div;
mod eml;
mod emotion;
mod emph;
mod engine;
mod environment;
mod event;
mod flow;
mod function_args;
mod gesture_is_on;
mod gesture_key;
mod gesture_track;
mod group;
mod hand_shapes;
mod head;
mod it;
mod language;
mod light;
mod lookup;
mod ly;
mod marker;
mod meant;
mod motion;
mod music;
mod null;
mod palms;
mod par;
mod performer;
mod pitch;
mod place;
mod posture;
mod pron;
mod rate;
mod record;
mod ref_;
mod reference_text;
mod sayas;
mod seq;
mod set;
mod sets_configuration;
mod speaker;
#[cfg(test)]
mod testing;
mod tm;
mod tracks;
mod values;
mod vh_move;
mod voice_change;
mod voice_say;
mod voice_text;
mod volume;

use crate::ClauseKind;
use crate::clauses::speech::Markup;
pub(crate) use attribute::MAX_NUMBER;
pub use attribute::{Attribute, ConditionalKind, Kind, Presence};
pub(crate) use context::{Context, Fields, Tally};
#[cfg(test)]
pub(crate) use emph::number as emphasis;
pub(crate) use group::read as read_group;
pub(crate) use head::read as read_head;
pub(crate) use lookup::same;
use reference_text::reference_text;
pub(crate) use values::parse as parse_value;
pub(crate) use voice_text::VoiceBuilder;

/// Entry of the schema table for an element of the language; drives parsing, checks, writing and
/// documentation.
#[derive(Debug)]
pub struct Element {
    /// Name of the element. Some names have one entry for each parent.
    pub name: &'static str,
    /// Other spellings that are accepted with a warning.
    pub aliases: &'static [&'static str],
    /// True if it belongs to the extensions' namespace.
    pub extension: bool,
    /// Description, in one or two sentences.
    pub doc: &'static str,
    /// Decision taken where the source is silent or contradicts itself.
    pub decision: &'static str,
    /// A clause, or a whole script, that uses it without fault.
    pub example: &'static str,
    /// Specification of the element.
    pub source: &'static str,
    /// Allowed parent elements; empty for the root.
    pub parents: &'static [&'static str],
    /// Content that the element may have.
    pub content: Content,
    /// Attributes specific to the element; clauses also have [`TIMED`].
    pub attributes: &'static [Attribute],
    /// Attributes of which at least one must be there.
    pub one_of: &'static [&'static str],
    /// Required children, at least one of each.
    pub required_children: &'static [&'static str],
    /// Maximum number per parent.
    pub max_per_parent: Option<u32>,
    /// Role of the element in the document.
    pub(crate) role: Role,
}

impl Element {
    const fn new(name: &'static str, parents: &'static [&'static str], role: Role) -> Self {
        Self {
            name,
            aliases: &[],
            extension: false,
            doc: "",
            decision: "",
            example: "",
            source: "",
            parents,
            content: Content::Empty,
            attributes: &[],
            one_of: &[],
            required_children: &[],
            max_per_parent: None,
            role,
        }
    }

    /// Creates a clause with its own read function.
    const fn clause(name: &'static str, build: BuildClause) -> Self {
        Self::new(name, CLAUSE_PARENTS, Role::Clause(build))
    }

    /// Creates a clause that consists of its attributes and children only.
    const fn record(name: &'static str, blank: fn() -> ClauseKind) -> Self {
        Self::new(name, CLAUSE_PARENTS, Role::Record(blank))
    }

    /// Creates the entry of a container in speech.
    const fn container(name: &'static str, blank: fn() -> Markup) -> Self {
        Self {
            content: Content::Mixed,
            ..Self::new(name, VOICE_PARENTS, Role::Container(blank))
        }
    }

    /// Creates the entry of an element that its parent reads.
    const fn part(name: &'static str, parents: &'static [&'static str]) -> Self {
        Self::new(name, parents, Role::Part)
    }

    /// Returns true if it is a clause: it has its own time and occurs in the body or a group.
    #[must_use]
    pub fn is_clause(&self) -> bool {
        matches!(
            self.role,
            Role::Clause(_) | Role::Record(_) | Role::Group(_) | Role::Scene(_)
        )
    }

    /// Returns all attributes of the element, those of every clause last.
    pub fn all_attributes(&self) -> impl Iterator<Item = &'static Attribute> + Clone {
        self.attributes.iter().chain(self.timed())
    }

    /// Returns the attributes common to all clauses; empty if the element is not a clause.
    fn timed(&self) -> &'static [Attribute] {
        if self.is_clause() { TIMED } else { &[] }
    }

    fn is_allowed_in(&self, parent: &str) -> bool {
        self.parents.iter().any(|p| same(p, parent))
    }
}

/// Markup tree of a document in which each element refers to its schema entry.
pub(crate) type Tree<'a> = crate::markup::Tree<'a, &'static Element>;

/// Allowed content of an element: none, elements, text or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// No content.
    Empty,
    /// Elements only.
    Elements,
    /// Character data only.
    Text,
    /// Text and elements.
    Mixed,
}

impl Content {
    pub(crate) fn has_text(self) -> bool {
        matches!(self, Self::Text | Self::Mixed)
    }
}

/// Function that reads a clause; returns `None` if it must be dropped.
pub(crate) type BuildClause = fn(&mut Context<'_>, usize, &Fields<'_>) -> Option<ClauseKind>;

/// Role of an element, which selects the function that reads it.
#[derive(Clone, Copy)]
pub(crate) enum Role {
    /// Structure of the document.
    Structure,
    /// A clause without clauses inside.
    Clause(BuildClause),
    /// A clause read through its record.
    Record(fn() -> ClauseKind),
    /// A clause that groups clauses.
    Group(fn(crate::Group) -> ClauseKind),
    /// A clause with a record that groups clauses as well.
    Scene(fn() -> ClauseKind),
    /// A part of spoken text.
    Voice(fn(&mut Context<'_>, usize, &Fields<'_>, &mut VoiceBuilder)),
    /// A part of spoken text that contains others.
    Container(fn() -> Markup),
    /// Read by its parent.
    Part,
}

impl PartialEq for Role {
    fn eq(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

impl std::fmt::Debug for Role {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Structure => "Structure",
            Self::Clause(_) | Self::Record(_) => "Clause",
            Self::Group(_) | Self::Scene(_) => "Group",
            Self::Voice(_) | Self::Container(_) => "Voice",
            Self::Part => "Part",
        })
    }
}

/// Allowed parents of a clause.
pub(crate) const CLAUSE_PARENTS: &[&str] = &["body", "seq", "par", "answer", "part", "if", "pool"];

/// Allowed parents of a part of spoken text: SABLE's containers (GEVH D.4).
pub(crate) const VOICE_PARENTS: &[&str] = &[
    "voice-text",
    "div",
    "emph",
    "engine",
    "language",
    "pitch",
    "pron",
    "rate",
    "sayas",
    "speaker",
    "volume",
];

/// Attributes common to all clauses: start time and its name.
pub static TIMED: &[Attribute] = &[
    Attribute::new(
        "time",
        Kind::Time,
        "The start of the clause: a sum of seconds (units s, m, h) and names. A plain number counts from the start of a par, or in a seq from the end of the previous clause; an expression with a name counts from the start of the script.",
    )
    .default("0")
    .unit("s"),
    Attribute::new(
        "timeId",
        Kind::Name,
        "A name for the start of the clause, for use in time expressions.",
    ),
];

/// Returns the element with a name: exact, or else by alias or in another case. Of several with one
/// name it returns the first; extensions are excluded.
pub(crate) fn find(name: &str) -> Option<&'static Element> {
    find_in(false, name)
}

/// Returns the element of the extensions' namespace with this local name; `None` if there is none.
pub(crate) fn find_extension(name: &str) -> Option<&'static Element> {
    find_in(true, name)
}

/// Returns the element of a record by its name; the extension if EML has no such element or the
/// name has the extensions' prefix.
pub(crate) fn recorded(name: &str) -> Option<&'static Element> {
    match name.strip_prefix("r:") {
        Some(local) => find_extension(local),
        None => find(name).or_else(|| find_extension(name)),
    }
}

fn find_in(extension: bool, name: &str) -> Option<&'static Element> {
    let exact = lookup::variants(name).iter();
    let exact = exact.copied().find(|e| e.extension == extension);
    exact.or_else(|| {
        ELEMENTS.iter().copied().find(|e| {
            e.extension == extension
                && (e.name.eq_ignore_ascii_case(name)
                    || e.aliases.iter().any(|a| a.eq_ignore_ascii_case(name)))
        })
    })
}

/// Returns the entry of the same name that is allowed in `parent`.
pub(crate) fn variant_in(element: &'static Element, parent: &str) -> Option<&'static Element> {
    if element.is_allowed_in(parent) {
        return Some(element);
    }
    let mut variants = lookup::variants(element.name).iter().copied();
    variants.find(|e| e.extension == element.extension && e.is_allowed_in(parent))
}

/// Schema table: all elements of the language, sorted by name.
pub static ELEMENTS: &[&Element] = &[
    &animation_style::ELEMENT,
    &ask::ANSWER,
    &arg::ELEMENT,
    &ask::ELEMENT,
    &audio::ELEMENT,
    &beat::ELEMENT,
    &bg::ELEMENT,
    &body::ELEMENT,
    &body_animate_adsr_control_parameter::ELEMENT,
    &body_animate_control_parameter::ELEMENT,
    &body_configure_deterministic_animation::ELEMENT,
    &body_configure_deterministic_track_property::ELEMENT,
    &body_configure_geometry::ELEMENT,
    &body_configure_manipulator::ELEMENT,
    &body_deterministic_primitive::ELEMENT,
    &body_expression_configuration::ELEMENT,
    &body_load_control_parameter_animation::ELEMENT,
    &body_non_deterministic_fk::ELEMENT,
    &body_non_deterministic_frame_interpolation::ELEMENT,
    &body_non_deterministic_function::ELEMENT,
    &body_non_deterministic_jacobian::ELEMENT,
    &body_non_deterministic_joint_interpolation::ELEMENT,
    &body_non_deterministic_lock::ELEMENT,
    &body_non_deterministic_stop::ELEMENT,
    &body_player_add::ELEMENT,
    &body_player_change_priority::ELEMENT,
    &body_player_clear::ELEMENT,
    &body_player_remove::ELEMENT,
    &body_player_set_exclusive::ELEMENT,
    &body_set_control_parameter::ELEMENT,
    &bone::ELEMENT,
    &bones::ELEMENT,
    &break_::ELEMENT,
    &camera::ELEMENT,
    &div::ELEMENT,
    &eml::ELEMENT,
    &emotion::ELEMENT,
    &emph::ELEMENT,
    &engine::ELEMENT,
    &environment::ELEMENT,
    &event::ELEMENT,
    &function_args::ELEMENT,
    &gesture_is_on::ELEMENT,
    &gesture_key::ELEMENT,
    &flow::GOTO,
    &hand_shapes::ELEMENT,
    &head::ELEMENT,
    &flow::IF,
    &it::ELEMENT,
    &hand_shapes::KEY,
    &motion::KEY,
    &palms::KEY,
    &language::ELEMENT,
    &light::ELEMENT,
    &ly::ELEMENT,
    &marker::ELEMENT,
    &motion::ELEMENT,
    &music::ELEMENT,
    &null::ELEMENT,
    &ask::OPTION,
    &palms::ELEMENT,
    &par::ELEMENT,
    &flow::PART,
    &performer::ELEMENT,
    &environment::PIECE,
    &pitch::ELEMENT,
    &place::ELEMENT,
    &flow::POOL,
    &posture::ELEMENT,
    &pron::ELEMENT,
    &rate::ELEMENT,
    &ref_::ELEMENT,
    &sayas::ELEMENT,
    &seq::ELEMENT,
    &set::ELEMENT,
    &flow::SET,
    &sets_configuration::ELEMENT,
    &speaker::ELEMENT,
    &tm::ELEMENT,
    &tracks::ELEMENT,
    &vh_move::ELEMENT,
    &voice_change::ELEMENT,
    &voice_say::ELEMENT,
    &voice_text::ELEMENT,
    &volume::ELEMENT,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_sorted_and_its_references_exist() {
        assert!(
            ELEMENTS.is_sorted_by_key(|e| e.name),
            "the elements are sorted by name"
        );
        let exists = |name: &str| ELEMENTS.iter().any(|e| e.name == name);
        for element in ELEMENTS {
            for parent in element.parents {
                assert!(exists(parent), "{} in {parent}", element.name);
            }
            assert!(
                element.required_children.len() <= context::MAX_REQUIRED,
                "the required children are within the limit"
            );
            for child in element.required_children {
                assert!(exists(child), "{} needs {child}", element.name);
            }
            let attributes: Vec<_> = element.all_attributes().collect();
            assert!(
                attributes.len() <= context::MAX_ATTRIBUTES,
                "{}",
                element.name
            );
            for (i, attribute) in attributes.iter().enumerate() {
                let again = attributes[..i].iter().any(|a| a.name == attribute.name);
                assert!(!again, "{} {}", element.name, attribute.name);
                if let (Kind::Choice(words), Presence::Default(word)) =
                    (attribute.kind, attribute.default)
                {
                    assert!(words.contains(&word), "{} {}", element.name, attribute.name);
                }
            }
        }
    }

    #[test]
    fn names_are_found_in_any_case_and_by_parent() {
        assert_eq!(find("gesture-key").map(|e| e.name), Some("gesture-key"));
        assert_eq!(find("Gesture-Key").map(|e| e.name), Some("gesture-key"));
        assert!(find("gesture").is_none(), "an unknown name is not found");
        let key = find("key").unwrap();
        for (parent, attribute) in [("hand-shapes", "id"), ("palms", "a"), ("motion", "x")] {
            let key = variant_in(key, parent).unwrap();
            assert!(
                key.attributes.iter().any(|a| a.name == attribute),
                "the key has the attribute"
            );
        }
        assert!(
            variant_in(key, "body").is_none(),
            "the variant does not exist in another parent"
        );
    }
}

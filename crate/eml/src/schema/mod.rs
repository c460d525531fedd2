//! The language as a table: one small file an element, registered in [`ELEMENTS`],
//! which drives parsing, checks and documentation.

mod body;
mod break_;
mod context;
mod div;
mod eml;
mod emph;
mod event;
mod gesture_is_on;
mod gesture_key;
mod gesture_track;
mod group;
mod hand_shapes;
mod head;
mod lookup;
mod motion;
mod null;
mod palms;
mod par;
mod seq;
#[cfg(test)]
mod testing;
mod tm;
mod values;
mod voice_text;

use crate::ClauseKind;
pub(crate) use context::{Context, Fields, Tally};
pub(crate) use group::read as read_group;
pub(crate) use lookup::same;
pub(crate) use voice_text::VoiceBuilder;

/// An element of the language.
#[derive(Debug)]
pub struct Element {
    /// Its name. `key` has an entry for each of its parents.
    pub name: &'static str,
    /// Other spellings that are accepted with a warning.
    pub aliases: &'static [&'static str],
    /// What it does, in one or two sentences.
    pub doc: &'static str,
    /// Where it is specified.
    pub source: &'static str,
    /// The elements that it may stand in; none for the root.
    pub parents: &'static [&'static str],
    /// What it may hold.
    pub content: Content,
    /// Its own attributes; clauses also have [`TIMED`].
    pub attributes: &'static [Attribute],
    /// Elements of which it must hold at least one.
    pub required_children: &'static [&'static str],
    /// How many of them one parent may hold.
    pub most_per_parent: Option<u32>,
    /// What becomes of it.
    pub(crate) role: Role,
}

impl Element {
    /// Whether it is a clause: has a time of its own and stands in the body or a group.
    #[must_use]
    pub fn is_clause(&self) -> bool {
        matches!(self.role, Role::Clause(_) | Role::Group(_))
    }

    /// All its attributes, those of every clause last.
    pub fn all_attributes(&self) -> impl Iterator<Item = &'static Attribute> + Clone {
        let timed = if self.is_clause() { TIMED } else { &[] };
        self.attributes.iter().chain(timed)
    }

    fn may_stand_in(&self, parent: &str) -> bool {
        self.parents.iter().any(|p| same(p, parent))
    }
}

/// What an element may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Nothing.
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

/// An attribute of an element.
#[derive(Debug)]
pub struct Attribute {
    /// Its name.
    pub name: &'static str,
    /// Other spellings that are accepted with a warning.
    pub aliases: &'static [&'static str],
    /// What it may hold.
    pub kind: Kind,
    /// What counts when it is left out.
    pub default: Presence,
    /// What it means, with its unit.
    pub doc: &'static str,
}

/// What counts when an attribute is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// It must be there, or the element is dropped.
    Required,
    /// Nothing in particular.
    Optional,
    /// This value.
    Default(&'static str),
}

/// What an attribute may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Any text.
    Text,
    /// A name that time expressions can use.
    Name,
    /// `true`, `false`, `1` or `0`.
    Bool,
    /// A finite number of at most a million either way.
    Number,
    /// A whole number in a range, ends included.
    Integer {
        /// The smallest.
        least: i64,
        /// The largest.
        most: i64,
    },
    /// A length of at least 0: a number of seconds or one with a unit.
    Seconds,
    /// A time expression.
    Time,
    /// An offset in a gesture: seconds, or percent of its duration.
    KeyTime,
    /// One of these words, in any case.
    Choice(&'static [&'static str]),
    /// A number, or one of these words.
    NumberOrChoice(&'static [&'static str]),
}

/// What becomes of an element.
#[derive(Clone, Copy)]
pub(crate) enum Role {
    /// Holds the document together.
    Structure,
    /// A clause without clauses inside.
    Clause(fn(&mut Context<'_>, usize, &Fields<'_>) -> Option<ClauseKind>),
    /// A clause that groups clauses.
    Group(fn(crate::Group) -> ClauseKind),
    /// A part of spoken text.
    Voice(fn(&mut Context<'_>, usize, &Fields<'_>, &mut VoiceBuilder)),
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
            Self::Clause(_) => "Clause",
            Self::Group(_) => "Group",
            Self::Voice(_) => "Voice",
            Self::Part => "Part",
        })
    }
}

/// Where a clause may stand.
pub(crate) const CLAUSE_PARENTS: &[&str] = &["body", "seq", "par"];

/// Where a part of spoken text may stand: SABLE's containers (GEVH D.4).
pub(crate) const VOICE_PARENTS: &[&str] = &["voice-text", "div", "emph"];

/// The attributes of every clause.
pub static TIMED: &[Attribute] = &[
    Attribute {
        name: "time",
        aliases: &[],
        kind: Kind::Time,
        default: Presence::Default("0"),
        doc: "When the clause starts: a sum of seconds (units s, m, h) and named moments. A plain \
              number counts from the start of a par, or from the end of the clause before in a \
              seq; an expression that names a moment counts from the start of the script.",
    },
    Attribute {
        name: "timeId",
        aliases: &[],
        kind: Kind::Name,
        default: Presence::Optional,
        doc: "A name for the start of the clause, to be used in time expressions.",
    },
];

/// Every element, by name.
pub static ELEMENTS: &[&Element] = &[
    &body::ELEMENT,
    &break_::ELEMENT,
    &div::ELEMENT,
    &eml::ELEMENT,
    &emph::ELEMENT,
    &event::ELEMENT,
    &gesture_is_on::ELEMENT,
    &gesture_key::ELEMENT,
    &hand_shapes::ELEMENT,
    &head::ELEMENT,
    &hand_shapes::KEY,
    &motion::KEY,
    &palms::KEY,
    &motion::ELEMENT,
    &null::ELEMENT,
    &palms::ELEMENT,
    &par::ELEMENT,
    &seq::ELEMENT,
    &tm::ELEMENT,
    &voice_text::ELEMENT,
];

/// The element of a name: exact, or else an alias or another case. Of several with
/// one name, the first.
pub(crate) fn find(name: &str) -> Option<&'static Element> {
    lookup::exact(name).or_else(|| {
        ELEMENTS.iter().copied().find(|e| {
            e.name.eq_ignore_ascii_case(name)
                || e.aliases.iter().any(|a| a.eq_ignore_ascii_case(name))
        })
    })
}

/// The entry of the same name that may stand in `parent`.
pub(crate) fn variant_in(element: &'static Element, parent: &str) -> Option<&'static Element> {
    if element.may_stand_in(parent) {
        return Some(element);
    }
    lookup::variants(element.name).find(|e| e.may_stand_in(parent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_sorted_and_its_references_exist() {
        assert!(ELEMENTS.is_sorted_by_key(|e| e.name));
        let exists = |name: &str| ELEMENTS.iter().any(|e| e.name == name);
        for element in ELEMENTS {
            assert!(
                !element.doc.is_empty() && !element.source.is_empty(),
                "{}",
                element.name
            );
            for parent in element.parents {
                assert!(exists(parent), "{} in {parent}", element.name);
            }
            assert!(element.required_children.len() <= context::MOST_REQUIRED);
            for child in element.required_children {
                assert!(exists(child), "{} needs {child}", element.name);
            }
            let attributes: Vec<_> = element.all_attributes().collect();
            assert!(
                attributes.len() <= context::MOST_ATTRIBUTES,
                "{}",
                element.name
            );
            for attribute in attributes {
                assert!(
                    !attribute.doc.is_empty(),
                    "{} {}",
                    element.name,
                    attribute.name
                );
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
        assert!(find("gesture").is_none());
        let key = find("key").unwrap();
        for (parent, attribute) in [("hand-shapes", "id"), ("palms", "a"), ("motion", "x")] {
            let key = variant_in(key, parent).unwrap();
            assert!(key.attributes.iter().any(|a| a.name == attribute));
        }
        assert!(variant_in(key, "body").is_none());
    }
}

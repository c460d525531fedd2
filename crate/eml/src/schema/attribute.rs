//! Attributes as entries of the table.

use crate::MAX_COORDINATE;

/// Entry of the schema table for an attribute of an element: name, kind, default, unit and
/// documentation.
#[derive(Clone, Copy, Debug)]
pub struct Attribute {
    /// Name of the attribute.
    pub name: &'static str,
    /// Other spellings that are accepted with a warning.
    pub aliases: &'static [&'static str],
    /// Kind of its value.
    pub kind: Kind,
    /// Other words for those of a choice, accepted with a warning.
    pub word_aliases: &'static [(&'static str, &'static str)],
    /// Kinds that replace `kind` when another attribute of the element has a given word.
    pub conditional_kinds: &'static [ConditionalKind],
    /// Effect of its absence.
    pub default: Presence,
    /// Unit of its numbers; empty if there is none.
    pub unit: &'static str,
    /// True if it belongs to the extensions' namespace.
    pub extension: bool,
    /// Meaning of the attribute.
    pub doc: &'static str,
}

/// Alternative kind of an attribute's value that applies if another attribute has a given word.
#[derive(Clone, Copy, Debug)]
pub struct ConditionalKind {
    /// The other attribute, a choice.
    pub attribute: &'static str,
    /// Word of the other attribute that selects the kind.
    pub word: &'static str,
    /// Kind in that case.
    pub kind: Kind,
}

/// Presence of an attribute: required, optional or with a default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// Required; the element is dropped without it.
    Required,
    /// No default value.
    Optional,
    /// Optional with this default value.
    Default(&'static str),
}

/// Kind of an attribute's value, with its range; drives parsing, checks and documentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Arbitrary text.
    Text,
    /// A name that time expressions can use.
    Name,
    /// A reference by name: any non-empty text.
    Identifier,
    /// The relative path of a file inside its folder.
    Path,
    /// A relative address, or one by http or https.
    Url,
    /// `true`, `false`, `1` or `0`.
    Bool,
    /// A finite number in a range, ends included.
    Number {
        /// The smallest.
        least: f64,
        /// The largest.
        most: f64,
    },
    /// A whole number in a range, ends included.
    Integer {
        /// The smallest.
        least: i64,
        /// The largest.
        most: i64,
    },
    /// A length of at least 0: a number of seconds or one with a unit.
    Seconds {
        /// The longest, seconds.
        most: f64,
    },
    /// A time expression.
    Time,
    /// An offset in a gesture: seconds, or percent of its duration.
    KeyTime,
    /// One of these words, case-insensitive.
    Choice(&'static [&'static str]),
    /// A number, one of these words, or a change in percent with its sign.
    Level {
        /// The words.
        words: &'static [&'static str],
        /// The smallest and the largest number.
        numbers: [f64; 2],
        /// The smallest and the largest change in percent, if percentages are allowed.
        percent: Option<[f64; 2]>,
    },
    /// A number, or a truth value, which counts as 1 or 0.
    NumberOrBool,
    /// A number, or any other text.
    NumberOrText,
    /// Numbers with spaces between them.
    Numbers,
    /// A colour: `#` and six hexadecimal digits.
    Color,
}

/// Maximum magnitude of a number in a document: keeps products and sums of a few of them finite.
pub(crate) const MAX_NUMBER: f64 = 1e6;

impl Attribute {
    /// Creates an optional attribute of a kind.
    pub(super) const fn new(name: &'static str, kind: Kind, doc: &'static str) -> Self {
        Self {
            name,
            aliases: &[],
            kind,
            word_aliases: &[],
            conditional_kinds: &[],
            default: Presence::Optional,
            unit: "",
            extension: false,
            doc: super::reference_text(doc),
        }
    }

    pub(super) const fn text(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, Kind::Text, doc)
    }

    pub(super) const fn identifier(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, Kind::Identifier, doc)
    }

    pub(super) const fn flag(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, Kind::Bool, doc)
    }

    /// Creates an attribute for any finite number of magnitude up to [`MAX_NUMBER`].
    pub(super) const fn number(name: &'static str, doc: &'static str) -> Self {
        Self::between(name, -MAX_NUMBER, MAX_NUMBER, doc)
    }

    pub(super) const fn between(
        name: &'static str,
        least: f64,
        most: f64,
        doc: &'static str,
    ) -> Self {
        Self::new(name, Kind::Number { least, most }, doc)
    }

    pub(super) const fn integer(
        name: &'static str,
        least: i64,
        most: i64,
        doc: &'static str,
    ) -> Self {
        Self::new(name, Kind::Integer { least, most }, doc)
    }

    pub(super) const fn seconds(name: &'static str, doc: &'static str) -> Self {
        Self::seconds_up_to(name, MAX_NUMBER, doc)
    }

    pub(super) const fn seconds_up_to(name: &'static str, most: f64, doc: &'static str) -> Self {
        Self::new(name, Kind::Seconds { most }, doc).unit("s")
    }

    /// Creates an attribute for a position, an angle or a velocity of a manipulator, within
    /// [`MAX_COORDINATE`].
    pub(super) const fn placed(name: &'static str, doc: &'static str) -> Self {
        Self::between(name, -MAX_COORDINATE, MAX_COORDINATE, doc)
    }

    pub(super) const fn choice(
        name: &'static str,
        words: &'static [&'static str],
        doc: &'static str,
    ) -> Self {
        Self::new(name, Kind::Choice(words), doc)
    }

    pub(super) const fn level(
        name: &'static str,
        words: &'static [&'static str],
        numbers: [f64; 2],
        percent: Option<[f64; 2]>,
        doc: &'static str,
    ) -> Self {
        Self::new(
            name,
            Kind::Level {
                words,
                numbers,
                percent,
            },
            doc,
        )
    }

    pub(super) const fn required(mut self) -> Self {
        self.default = Presence::Required;
        self
    }

    pub(super) const fn default(mut self, value: &'static str) -> Self {
        self.default = Presence::Default(value);
        self
    }

    pub(super) const fn aliases(mut self, aliases: &'static [&'static str]) -> Self {
        self.aliases = aliases;
        self
    }

    pub(super) const fn word_aliases(
        mut self,
        aliases: &'static [(&'static str, &'static str)],
    ) -> Self {
        self.word_aliases = aliases;
        self
    }

    pub(super) const fn with_conditional_kinds(
        mut self,
        kinds: &'static [ConditionalKind],
    ) -> Self {
        self.conditional_kinds = kinds;
        self
    }

    pub(super) const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    pub(super) const fn extension(mut self) -> Self {
        self.extension = true;
        self
    }
}

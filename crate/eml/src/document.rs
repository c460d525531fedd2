//! The typed document: clauses with their values read, times not yet resolved.

use crate::{GestureKey, Name, Span, TimeExpr, VoiceText};

/// The place of a clause in [`Document::clauses`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClauseId(pub u32);

impl ClauseId {
    /// The index into [`Document::clauses`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An EML script. Clauses lie flat in document order, so that walking, cloning and
/// dropping never recurse; groups name their children.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The `name` of the `eml` element.
    pub name: Option<String>,
    /// Every clause, nested ones included, each group before its children.
    pub clauses: Vec<Clause>,
    /// The clauses directly in the body, in document order.
    pub roots: Vec<ClauseId>,
}

impl Document {
    /// The clause of an id that came from this document or its timeline.
    ///
    /// # Panics
    /// When the id comes from another, longer document.
    #[must_use]
    pub fn clause(&self, id: ClauseId) -> &Clause {
        &self.clauses[id.index()]
    }

    /// Every clause with its id, in document order.
    pub fn iter(&self) -> impl Iterator<Item = (ClauseId, &Clause)> {
        (0..).map(ClauseId).zip(&self.clauses)
    }
}

/// One thing to do at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// The whole element, end tag included.
    pub span: Span,
    /// The start tag.
    pub tag_span: Span,
    /// When it starts: absolute when it names a moment or stands in the body, else
    /// relative to its group (GEVH D.2.4, D.2.5).
    pub start: TimeExpr,
    /// The name that other clauses may call its start (GEVH D.2.2).
    pub time_id: Option<Name>,
    /// The seq or par it stands in; none in the body.
    pub parent: Option<ClauseId>,
    /// What it does.
    pub kind: ClauseKind,
}

/// What a clause does.
#[derive(Clone, Debug, PartialEq)]
pub enum ClauseKind {
    /// Speaks a text (GEVH D.4.1).
    VoiceText(VoiceText),
    /// Turns the gesture model on or off (GEVH D.5.1).
    GestureIsOn(bool),
    /// Moves hands through shapes, palm orientations and positions (GEVH D.5.2).
    GestureKey(GestureKey),
    /// Tells listeners that something happened (GEVH D.1.4).
    Event {
        /// The listeners' category.
        kind: Option<Name>,
        /// The character data, references resolved.
        payload: Name,
    },
    /// Keeps the script running until its time (GEVH D.1.5).
    Null,
    /// Its clauses one after another (GEVH D.2.4).
    Seq(Group),
    /// Its clauses together (GEVH D.2.5).
    Par(Group),
}

impl ClauseKind {
    /// The name of the element.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::VoiceText(_) => "voice-text",
            Self::GestureIsOn(_) => "gesture-is-on",
            Self::GestureKey(_) => "gesture-key",
            Self::Event { .. } => "event",
            Self::Null => "null",
            Self::Seq(_) => "seq",
            Self::Par(_) => "par",
        }
    }

    /// The group, when it is a seq or a par.
    #[must_use]
    pub fn group(&self) -> Option<&Group> {
        match self {
            Self::Seq(group) | Self::Par(group) => Some(group),
            _ => None,
        }
    }
}

/// The content of a seq or a par.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The clauses directly inside, in document order.
    pub children: Vec<ClauseId>,
    /// How often the content plays, at least 1 (GEVH D.2.6).
    pub repetition_count: u32,
    /// Where the count is written, else the start tag.
    pub repetition_span: Span,
    /// The length of one iteration in seconds; none: as long as the content.
    pub iteration_secs: Option<f64>,
}

//! Behaviours with their sync points (BML 1.0).

use std::collections::BTreeMap;

use raconteur_eml::{Name, Span};

use crate::xml::Element;

/// Point in the course of a behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Point {
    Start,
    /// End of the preparation; `attackPeak` of a face.
    Ready,
    StrokeStart,
    Stroke,
    StrokeEnd,
    Relax,
    End,
    /// A `sync` in a speech, by its index there.
    Mark(usize),
}

impl Point {
    /// Points that every behaviour has, with their names, in order.
    const NAMES: [(&'static str, Self); 8] = [
        ("start", Self::Start),
        ("ready", Self::Ready),
        ("attackPeak", Self::Ready),
        ("strokeStart", Self::StrokeStart),
        ("stroke", Self::Stroke),
        ("strokeEnd", Self::StrokeEnd),
        ("relax", Self::Relax),
        ("end", Self::End),
    ];

    /// Returns the point of a name.
    pub(super) fn named(name: &str) -> Option<Self> {
        let found = Self::NAMES.iter().find(|(known, _)| *known == name)?;
        Some(found.1)
    }

    /// Returns the names of all points.
    pub(super) fn names() -> impl Iterator<Item = &'static str> {
        Self::NAMES.iter().map(|(name, _)| *name)
    }

    /// Returns its index in a [`Course`]; `None` for a mark.
    fn index(self) -> Option<usize> {
        match self {
            Self::Start => Some(0),
            Self::Ready => Some(1),
            Self::StrokeStart => Some(2),
            Self::Stroke => Some(3),
            Self::StrokeEnd => Some(4),
            Self::Relax => Some(5),
            Self::End => Some(6),
            Self::Mark(_) => None,
        }
    }
}

/// Default times of the points from start to end, seconds after the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course(pub(super) [f64; 7]);

impl Course {
    /// Returns the default time of a point, seconds after the start.
    pub(super) fn secs(&self, point: Point) -> f64 {
        point.index().map_or(0.0, |index| self.0[index])
    }

    /// Returns the course of a behaviour with these lengths of its phases, seconds.
    pub(super) fn phases(preparation: f64, stroke: f64, hold: f64, retraction: f64) -> Self {
        let relax = preparation + stroke + hold;
        Self([
            0.0,
            preparation,
            preparation,
            preparation + stroke / 2.0,
            preparation + stroke,
            relax,
            relax + retraction,
        ])
    }
}

/// Kind of a behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Speech,
    Gesture,
    Pointing,
    Gaze,
    GazeShift,
    Head,
    HeadDirectionShift,
    Posture,
    PostureShift,
    Face,
    FaceLexeme,
    FaceFacs,
    FaceShift,
    Locomotion,
    Wait,
}

impl Kind {
    /// All kinds with their elements and the attributes of each besides `id` and sync points.
    pub(super) const ELEMENTS: [(&'static str, Self, &'static [&'static str]); 15] = [
        ("speech", Self::Speech, &[]),
        ("gesture", Self::Gesture, &["lexeme", "mode"]),
        ("pointing", Self::Pointing, &["target", "mode"]),
        (
            "gaze",
            Self::Gaze,
            &["target", "influence", "offsetAngle", "offsetDirection"],
        ),
        (
            "gazeShift",
            Self::GazeShift,
            &["target", "influence", "offsetAngle", "offsetDirection"],
        ),
        ("head", Self::Head, &["lexeme", "repetition", "amount"]),
        ("headDirectionShift", Self::HeadDirectionShift, &["target"]),
        ("posture", Self::Posture, &[]),
        ("postureShift", Self::PostureShift, &[]),
        ("face", Self::Face, &["amount", "lexeme", "au", "side"]),
        ("faceLexeme", Self::FaceLexeme, &["lexeme", "amount"]),
        ("faceFacs", Self::FaceFacs, &["au", "side", "amount"]),
        (
            "faceShift",
            Self::FaceShift,
            &["amount", "lexeme", "au", "side"],
        ),
        ("locomotion", Self::Locomotion, &["target"]),
        ("wait", Self::Wait, &["duration"]),
    ];

    /// Returns the kind of an element with its attributes.
    pub(super) fn of_element(name: &str) -> Option<(Self, &'static [&'static str])> {
        let mut all = Self::ELEMENTS.iter();
        let found = all.find(|(known, ..)| known.eq_ignore_ascii_case(name))?;
        Some((found.1, found.2))
    }
}

/// Time given to a sync point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Given {
    pub(super) value: GivenTime,
    /// Span of the attribute or reference.
    pub(super) span: Span,
}

/// Constraint that one time is not later than another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Order {
    pub(super) first: GivenTime,
    pub(super) second: GivenTime,
    /// Span of the constraint.
    pub(super) span: Span,
    pub(super) is_required: bool,
}

/// Value of a [`Given`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GivenTime {
    /// Seconds after the start of a group.
    Group(usize, f64),
    /// Seconds after a point of a behaviour, by its index.
    Point(usize, Point, f64),
}

/// Behaviour of a block.
#[derive(Debug)]
pub(super) struct Behaviour<'x> {
    pub(super) element: &'x Element,
    pub(super) kind: Kind,
    /// Index of its block.
    pub(super) block: usize,
    /// True inside `required`.
    pub(super) is_required: bool,
    /// Default course.
    pub(super) course: Course,
    /// Times given to its points.
    pub(super) given: BTreeMap<Point, Given>,
    /// Of a speech: its start and end as named times.
    pub(super) ends: Option<(Name, Name)>,
    /// Of a speech: its syncs, in the order of the text.
    pub(super) marks: Vec<SpeechMark<'x>>,
}

/// `sync` inside a speech.
#[derive(Debug)]
pub(super) struct SpeechMark<'x> {
    /// Id in BML.
    pub(super) id: &'x str,
    /// Mark in EML.
    pub(super) name: Name,
    /// Byte offset in the text.
    pub(super) position: usize,
}

/// Block of behaviours.
#[derive(Debug)]
pub(super) struct Block<'x> {
    pub(super) element: &'x Element,
    /// Number of the group that performs it; blocks of one group start together.
    pub(super) group: usize,
}

/// All behaviours of a file.
#[derive(Debug)]
pub(super) struct Reading<'x> {
    pub(super) blocks: Vec<Block<'x>>,
    /// Number of groups, at least 1.
    pub(super) groups: usize,
    pub(super) behaviours: Vec<Behaviour<'x>>,
    /// `constraint` elements, with their block; true for required ones.
    pub(super) constraints: Vec<(&'x Element, usize, bool)>,
    pub(super) orders: Vec<Order>,
    /// Behaviours by block and id.
    pub(super) ids: BTreeMap<(usize, &'x str), usize>,
}

impl Reading<'_> {
    /// Returns the group of a behaviour.
    pub(super) fn group_of(&self, index: usize) -> usize {
        self.blocks[self.behaviours[index].block].group
    }
}

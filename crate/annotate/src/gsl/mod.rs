//! The Gesture Scripting Language (GEVH C.3.6): hand shapes, palm orientations and positions of a
//! gesture phase as text.
//!
//! ```text
//! 24                                 a hand shape
//! [90;[0;1;0]]                       a palm orientation: angle about the palm's normal
//! [0;10;0]                           a position
//! [[0;0;0];[0;10;0]]                 a sequence, evenly spaced over the phase
//! [[0.12;[-10;0;0]];[50%;[-10;10;0]]] a sequence at seconds and shares of the phase
//! RH=[-10;0;0];LH=[10;0;0]           each hand its own
//! ```
//!
//! A value belongs to one feature, since `[1;2;3]` is a position, and three hand shapes. Positions
//! and normals are in GSL's frame: x to the speaker's left, y up, z to the front (GEVH C.3.6); EML's
//! z is to the back, so conversion negates it.

mod feature;
mod keys;
mod node;
mod write;

use raconteur_base::Side;

pub use feature::{Feature, Palm, Position, Shape};
pub use keys::{InEml, from_tracks, tracks};
pub use node::GslError;

/// Value of a feature over a phase: common to both hands, or per hand.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<F> {
    /// One sequence: of the hand that takes part, or of the dominant hand, mirrored for the other.
    Common(Sequence<F>),
    /// A sequence for each hand, at least one.
    PerHand {
        /// Sequence of the right hand, `RH`.
        right: Option<Sequence<F>>,
        /// Sequence of the left hand, `LH`.
        left: Option<Sequence<F>>,
    },
}

impl<F> Value<F> {
    /// Returns the sequence of a hand; a common one is that of both.
    #[must_use]
    pub fn for_hand(&self, side: Side) -> Option<&Sequence<F>> {
        match self {
            Self::Common(sequence) => Some(sequence),
            Self::PerHand { right, left } => match side {
                Side::Right => right.as_ref(),
                Side::Left => left.as_ref(),
            },
        }
    }
}

/// Sequence of a feature over a phase, at least one item.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence<F> {
    /// Items in the order of the text.
    pub items: Vec<Item<F>>,
}

/// Item of a sequence: a feature, and the time at which it is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Item<F> {
    /// Time after the start of the phase; `None`: evenly between the neighbours.
    pub offset: Option<Offset>,
    /// Feature to reach.
    pub feature: F,
}

/// Time after the start of a phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// Seconds, at least 0.
    Secs(f64),
    /// Share of the phase's duration, percent, 0 to 100.
    Percent(f64),
}

impl Offset {
    /// Returns the offset in seconds in a phase of a duration.
    #[must_use]
    pub fn secs(self, duration_secs: f64) -> f64 {
        match self {
            Self::Secs(secs) => secs,
            // In this order, 100 % is exactly the end.
            Self::Percent(percent) => duration_secs * (percent / 100.0),
        }
    }
}

impl<F> Sequence<F> {
    /// Returns the times of the items in seconds after the start of a phase. Items without an
    /// offset are evenly spaced between timed neighbours, with the ends at 0 and the duration; a
    /// single one is at 0 (GEVH C.3.6).
    #[must_use]
    pub fn offsets_secs(&self, duration_secs: f64) -> Vec<f64> {
        let given = |item: &Item<F>| item.offset.map(|offset| offset.secs(duration_secs));
        let mut times: Vec<Option<f64>> = self.items.iter().map(given).collect();
        let last = times.len().saturating_sub(1);
        if let Some(first) = times.first_mut() {
            first.get_or_insert(0.0);
        }
        let latest = times.iter().flatten().fold(duration_secs, |a, &b| a.max(b));
        if let Some(end) = times.last_mut() {
            end.get_or_insert(latest);
        }
        let mut from = 0;
        for to in 1..=last {
            let (Some(start), Some(end)) = (times[from], times[to]) else {
                continue;
            };
            let steps = (to - from) as f64;
            for (step, time) in times[from + 1..to].iter_mut().enumerate() {
                *time = Some(start + (end - start) * (step + 1) as f64 / steps);
            }
            from = to;
        }
        times.into_iter().flatten().collect()
    }
}

/// Parses the value of a feature.
///
/// # Errors
/// Returns the first error with its range in the text.
pub fn parse<F: Feature>(text: &str) -> Result<Value<F>, GslError> {
    feature::value(text)
}

/// Returns true if a text is meant as GSL rather than as an informal note: it begins as a value
/// does.
#[must_use]
pub fn is_formal(text: &str) -> bool {
    let start = text.trim_start();
    let labelled = ["RH", "LH"].iter().any(|label| {
        let rest = start.get(..2).filter(|s| s.eq_ignore_ascii_case(label));
        rest.is_some() && start[2..].trim_start().starts_with('=')
    });
    labelled || start.starts_with(|c: char| c.is_ascii_digit() || "[-+./".contains(c))
}

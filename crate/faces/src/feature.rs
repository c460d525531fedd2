//! Features: attributes that are one thing at one place of the face. Such an attribute is measured on the
//! skin itself, and it can change alone: let into its segments, and what lies elsewhere stays (F&H 5.1.2).

use crate::segment::Half;

/// What an attribute is on a skin, and where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Feature {
    /// Names of the segments in which it lies.
    pub segments: Vec<String>,
    /// The half in which it lies; none for both.
    pub half: Option<Half>,
    /// By how much one more of a number of a face changes the value, by the number's index: per metre for
    /// shapes. Empty where the value is told by the attribute's direction.
    pub gradient: Vec<(u32, f64)>,
    /// Coefficients of the change that adds 1 of the attribute when it is let into the segments.
    pub alone: Vec<f64>,
}

impl Feature {
    /// What the gradient tells of a difference between two faces; numbers that are missing count as none.
    pub(crate) fn measured(&self, difference: &[f64]) -> f64 {
        let number = |index: u32| difference.get(index as usize).copied().unwrap_or(0.0);
        self.gradient.iter().map(|&(i, g)| g * number(i)).sum()
    }
}

//! Features: attributes of one part of the face. Such an attribute is measured on the skin itself,
//! and it can change separately: the change is masked by its segments, and the rest stays (F&H
//! 5.1.2).

use crate::segment::Half;

/// Location and definition of an attribute on the skin, such as the width of the mouth; lets it
/// change without the rest of the face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Feature {
    /// Names of the segments that contain the feature.
    pub segments: Vec<String>,
    /// Half of the face that contains the feature; `None` for both.
    pub half: Option<Half>,
    /// Change of the value per unit of a number of the face, by the number's index: per metre for
    /// shapes. Empty if the value comes from the attribute's direction.
    pub gradient: Vec<(u32, f64)>,
    /// Coefficients of the change that adds 1 of the attribute when limited to the segments.
    pub alone: Vec<f64>,
}

impl Feature {
    /// Applies the gradient to a difference between two faces; missing numbers count as 0.
    pub(crate) fn measured(&self, difference: &[f64]) -> f64 {
        let number = |index: u32| difference.get(index as usize).copied().unwrap_or(0.0);
        self.gradient.iter().map(|&(i, g)| g * number(i)).sum()
    }
}

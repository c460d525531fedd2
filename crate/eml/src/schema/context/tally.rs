//! Counts the children of an element.

use super::MAX_REQUIRED;
use crate::schema::Element;

/// Number of children of an element up to now, by kind; detects missing and excessive ones.
pub(crate) struct Tally {
    pub(super) parent: &'static Element,
    /// The elements whose number is limited: few, so the first ones need no allocation.
    counts: [Option<(&'static Element, u32)>; 4],
    more_counts: Vec<(&'static Element, u32)>,
    pub(super) seen: [bool; MAX_REQUIRED],
    pub(super) missing: usize,
}

impl Tally {
    pub(crate) fn new(parent: &'static Element) -> Self {
        Self {
            parent,
            counts: [None; 4],
            more_counts: Vec::new(),
            seen: [false; MAX_REQUIRED],
            missing: parent.required_children.len(),
        }
    }

    /// Counts one more of an element.
    pub(super) fn count(&mut self, entry: &'static Element) -> u32 {
        for slot in &mut self.counts {
            let (element, count) = slot.get_or_insert((entry, 0));
            if std::ptr::eq(*element, entry) {
                *count += 1;
                return *count;
            }
        }
        let known = self
            .more_counts
            .iter_mut()
            .find(|(element, _)| std::ptr::eq(*element, entry));
        match known {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                self.more_counts.push((entry, 1));
                1
            }
        }
    }
}

//! Attributes of an element.

use super::MAX_ATTRIBUTES;
use crate::Span;
use crate::markup;
use crate::schema::lookup::same;
use crate::schema::{Attribute, Element, TIMED};
use std::cell::Cell;

/// Attributes of one element, matched with the schema table. Values are parsed on demand
/// (`values.rs`).
pub(crate) struct Fields<'t> {
    pub(crate) element: &'static Element,
    /// The start tag.
    pub(crate) tag: Span,
    /// The name in the start tag.
    pub(crate) name: Span,
    pub(in crate::schema) attributes: &'t [markup::Attribute<'t>],
    /// Index in `attributes` of each attribute of the table.
    pub(super) slots: [u16; MAX_ATTRIBUTES],
    /// Number of the element's attributes in the table.
    pub(super) count: usize,
    /// Table index at which the search for the next attribute starts.
    pub(super) next: Cell<usize>,
    pub(super) complete: bool,
    pub(super) extended: bool,
}

impl<'t> Fields<'t> {
    /// Returns true if every required attribute is present.
    pub(crate) fn is_complete(&self) -> bool {
        self.complete
    }

    /// Returns true if any extension attribute is present.
    pub(crate) fn is_extended(&self) -> bool {
        self.extended
    }

    /// Returns true if an attribute is present.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.get(name).is_some_and(|(_, written)| written.is_some())
    }

    /// Returns the table entry of an attribute and its written form, if present.
    pub(in crate::schema) fn get(
        &self,
        name: &str,
    ) -> Option<(&'static Attribute, Option<&'t markup::Attribute<'t>>)> {
        let (slot, attribute) = self.slot(name)?;
        Some((
            attribute,
            self.attributes.get(usize::from(self.slots[slot])),
        ))
    }

    /// Returns the attribute with exactly this name and its index among the element's attributes.
    /// Scripts and readers mostly follow the order of the table, so the search starts after the
    /// last hit.
    pub(super) fn slot(&self, name: &str) -> Option<(usize, &'static Attribute)> {
        let own = self.element.attributes;
        let mut slot = self.next.get();
        for _ in 0..self.count {
            if slot >= self.count {
                slot = 0;
            }
            let attribute = own.get(slot).unwrap_or_else(|| &TIMED[slot - own.len()]);
            if same(attribute.name, name) {
                self.next.set(slot + 1);
                return Some((slot, attribute));
            }
            slot += 1;
        }
        None
    }

    /// Returns the span of an attribute's value, or else of the start tag.
    pub(crate) fn span_of(&self, name: &str) -> Span {
        self.get(name)
            .and_then(|(_, written)| written)
            .map_or(self.tag, markup::Attribute::value_span)
    }
}

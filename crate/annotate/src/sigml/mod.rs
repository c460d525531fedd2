//! Stub.
use crate::xml::Element;
use raconteur_eml::{Diagnostic, Document};
pub(crate) fn convert(_root: &Element, _problems: &mut Vec<Diagnostic>) -> Document {
    Document::default()
}

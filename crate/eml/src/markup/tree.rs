//! Flat tree: nodes in document order, each with the end of its subtree. The tree does not
//! interpret `E`, the language's knowledge of an element.

use crate::Span;

/// Flat markup tree of a document: nodes in document order, and their attributes.
#[derive(Debug)]
pub(crate) struct Tree<'a, E> {
    /// Nodes in document order, each before its descendants.
    pub(crate) nodes: Vec<Node<'a, E>>,
    /// The attributes of all elements, those of one element together.
    pub(crate) attributes: Vec<Attribute<'a>>,
    /// Body whose elements have been taken out.
    pub(crate) taken_from: Option<u32>,
}

impl<E> Default for Tree<'_, E> {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            attributes: Vec::new(),
            taken_from: None,
        }
    }
}

impl<'a, E> Tree<'a, E> {
    /// Returns the attributes of a node.
    pub(crate) fn attributes_of(&self, node: usize) -> &[Attribute<'a>] {
        let node = &self.nodes[node];
        let start = node.first_attribute as usize;
        &self.attributes[start..start + usize::from(node.attribute_count)]
    }
}

/// Node of the markup tree: an element or a run of text.
#[derive(Debug)]
pub(crate) struct Node<'a, E> {
    /// Kind of the node.
    pub(crate) kind: NodeKind<E>,
    /// The name as written, or the text.
    pub(crate) text: &'a str,
    /// The start tag, or the text.
    pub(crate) span: Span,
    /// Offset after the end tag, or after the text.
    pub(crate) end: u32,
    /// Index of the first node after its descendants.
    pub(crate) subtree_end: u32,
    /// Index of its first attribute.
    pub(crate) first_attribute: u32,
    /// Number of attributes.
    pub(crate) attribute_count: u16,
}

/// Kind of a node: known or unknown element, malformed markup, text or reference.
#[derive(Clone, Copy, Debug)]
pub(crate) enum NodeKind<E> {
    /// An element, with its entry in the schema when it has one.
    Element(Option<E>),
    /// An element whose start tag is malformed: already reported, to be dropped.
    Malformed,
    /// Characters verbatim from the source.
    Text,
    /// Character from a resolved character reference.
    Reference(char),
}

/// Attribute as written in a start tag.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attribute<'a> {
    /// Name of the attribute.
    pub(crate) name: &'a str,
    /// Value between the quotes, with references unresolved.
    pub(crate) value: &'a str,
    /// Offset of the name.
    pub(crate) name_start: u32,
    /// Offset of the value.
    pub(crate) value_start: u32,
    /// True if the value contains no reference.
    pub(crate) is_plain: bool,
}

impl Attribute<'_> {
    /// Returns the span of the name.
    pub(crate) fn name_span(&self) -> Span {
        Span::from_offsets(
            self.name_start as usize,
            self.name_start as usize + self.name.len(),
        )
    }

    /// Returns the span of the value, without its quotes.
    pub(crate) fn value_span(&self) -> Span {
        Span::from_offsets(
            self.value_start as usize,
            self.value_start as usize + self.value.len(),
        )
    }
}

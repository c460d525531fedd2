//! Namespaces of a document: the meaning of a prefix in its scope.

use crate::diagnostic::Sink;
use crate::markup::{Node, NodeKind, Tree};
use crate::{Diagnostic, Span};
use std::ops::Range;

/// Namespace of the player's extensions to the language of the thesis. A document that does not
/// bind it has exactly the meaning defined by GEVH.
pub const EXTENSIONS: &str = "urn:raconteur:eml:1";

/// The prefix that our own documents use for [`EXTENSIONS`]; any other will do.
pub const EXTENSIONS_PREFIX: &str = "r";

/// Bounds the work of looking a prefix up.
const MAX_BINDINGS: usize = 64;

/// Owner of an element or attribute name: the language, its extensions, a foreign namespace, or
/// none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    /// The language itself.
    Language,
    /// [`EXTENSIONS`].
    Extensions,
    /// Another namespace.
    Foreign,
    /// None: the prefix is not bound.
    Unbound,
}

/// Namespace bindings in scope at a point of a document, outer ones first.
#[derive(Debug)]
pub(crate) struct Namespaces<'a> {
    bindings: Vec<Binding<'a>>,
    /// True if the document may have bindings.
    any: bool,
    /// Number of bindings that belong to the ancestors of the body's elements, once those are
    /// reached.
    around: Option<usize>,
    told: bool,
}

#[derive(Debug)]
struct Binding<'a> {
    /// Empty for names without a prefix.
    prefix: &'a str,
    extensions: bool,
    /// Range of nodes in which it holds.
    from: usize,
    to: usize,
}

impl<'a> Namespaces<'a> {
    /// Creates the bindings for a text before it is parsed.
    pub(crate) fn new(source: &str) -> Self {
        Self {
            bindings: Vec::new(),
            any: source.contains("xmlns"),
            around: None,
            told: false,
        }
    }

    /// Returns true if nothing is bound yet.
    pub(crate) fn is_empty(&self) -> bool {
        self.bindings.is_empty()
    }

    /// Collects the bindings for an element of the body that is read before the body is
    /// complete: node `node`, the last in the tree with its subtree.
    pub(crate) fn enter<E>(&mut self, tree: &Tree<'a, E>, node: usize, sink: &mut Sink) {
        if !self.any {
            return;
        }
        match self.around {
            Some(around) => self.bindings.truncate(around),
            None => {
                self.collect(tree, 0..node, sink);
                // The root and the body are still open.
                let is_element = |n: &Node<'_, E>| matches!(n.kind, NodeKind::Element(_));
                let root = tree.nodes.iter().position(is_element);
                let body = tree.taken_from.map(|body| body as usize);
                for binding in &mut self.bindings {
                    if Some(binding.from) == root || Some(binding.from) == body {
                        binding.to = usize::MAX;
                    }
                }
                self.around = Some(self.bindings.len());
            }
        }
        self.collect(tree, node..tree.nodes.len(), sink);
    }

    /// Collects the bindings of a tree that is complete.
    pub(crate) fn finish<E>(&mut self, tree: &Tree<'a, E>, sink: &mut Sink) {
        self.bindings.clear();
        if self.any {
            self.collect(tree, 0..tree.nodes.len(), sink);
        }
    }

    fn collect<E>(&mut self, tree: &Tree<'a, E>, nodes: Range<usize>, sink: &mut Sink) {
        for from in nodes {
            for attribute in tree.attributes_of(from) {
                let Some(prefix) = bound_by(attribute.name) else {
                    continue;
                };
                if self.bindings.len() == MAX_BINDINGS {
                    if !std::mem::replace(&mut self.told, true) {
                        sink.push(Diagnostic::error(
                            "eml::too-many-namespaces",
                            attribute.name_span(),
                            format!("more than {MAX_BINDINGS} namespaces; the rest is not bound"),
                        ));
                    }
                    return;
                }
                self.bindings.push(Binding {
                    prefix,
                    extensions: attribute.value.trim() == EXTENSIONS,
                    from,
                    to: tree.nodes[from].subtree_end as usize,
                });
            }
        }
    }

    /// Returns the owner of a name in the tag of `node`, and the name without its prefix.
    /// Unprefixed attributes belong to their element, so `default_counts` is for elements.
    pub(crate) fn owner<'n>(
        &self,
        name: &'n str,
        node: usize,
        default_counts: bool,
    ) -> (Owner, &'n str) {
        let local = local_name(name);
        let prefix = &name[..(name.len() - local.len()).saturating_sub(1)];
        if prefix == "xml" || prefix == "xmlns" {
            return (Owner::Foreign, local);
        }
        if prefix.is_empty() && !default_counts {
            return (Owner::Language, local);
        }
        let holds = |b: &&Binding<'_>| b.prefix == prefix && (b.from..b.to).contains(&node);
        let owner = match self.bindings.iter().rev().find(holds) {
            Some(binding) if binding.extensions => Owner::Extensions,
            // A script may use any prefix for the namespace of the language itself.
            _ if prefix.is_empty() => Owner::Language,
            Some(_) => Owner::Foreign,
            None => Owner::Unbound,
        };
        (owner, local)
    }
}

/// Returns a name without its prefix.
pub(crate) fn local_name(name: &str) -> &str {
    let colon = name.bytes().position(|b| b == b':');
    colon.map_or(name, |at| &name[at + 1..])
}

/// Returns the prefix that a namespace attribute binds, empty for the default namespace; `None` for
/// any other attribute.
fn bound_by(name: &str) -> Option<&str> {
    match name.strip_prefix("xmlns")? {
        "" => Some(""),
        rest => rest.strip_prefix(':'),
    }
}

/// Returns a warning about an unbound prefix.
pub(crate) fn unbound(name: &str, span: Span, consequence: &str) -> Diagnostic {
    let prefix = name.split(':').next().unwrap_or("");
    let message = format!(
        "the prefix of {} is not bound; {consequence}",
        crate::suggest::quoted(name)
    );
    Diagnostic::error("eml::unbound-prefix", span, message).hint(format!(
        "extensions need xmlns:{}='{EXTENSIONS}' on `eml`",
        if prefix.len() > 20 {
            EXTENSIONS_PREFIX
        } else {
            prefix
        }
    ))
}

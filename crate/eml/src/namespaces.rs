//! The namespaces of a document: what a prefix means where.

use crate::diagnostic::Sink;
use crate::syntax::{NodeKind, Tree};
use crate::{Diagnostic, Span};

/// The namespace of what this player adds to the language of the thesis. A document
/// that does not bind it means exactly what GEVH says.
pub const EXTENSIONS: &str = "urn:raconteur:eml:1";

/// The prefix that our own documents use for [`EXTENSIONS`]; any other will do.
pub const EXTENSIONS_PREFIX: &str = "r";

/// Bounds the work of looking a prefix up.
const MOST_BINDINGS: usize = 64;

/// What a name without or with a prefix belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    /// The language itself.
    Language,
    /// [`EXTENSIONS`].
    Extensions,
    /// Somebody else.
    Foreign,
    /// Nobody: the prefix is not bound.
    Unbound,
}

/// The bindings of a document, outer ones first.
#[derive(Debug, Default)]
pub(crate) struct Namespaces<'t> {
    bindings: Vec<Binding<'t>>,
}

#[derive(Debug)]
struct Binding<'t> {
    /// Empty for names without a prefix.
    prefix: &'t str,
    extensions: bool,
    /// The nodes where it holds.
    from: usize,
    to: usize,
}

impl<'t> Namespaces<'t> {
    /// Collects the bindings of a tree.
    pub(crate) fn of(tree: &'t Tree<'t>, sink: &mut Sink) -> Self {
        let mut bindings: Vec<Binding<'t>> = Vec::new();
        if !tree.attributes.iter().any(|a| a.name.starts_with("xmlns")) {
            return Self::default();
        }
        // While the elements of a body are taken out, the root and the body are open.
        let body = tree.taken_from.map(|body| body as usize);
        let is_element = |kind| !matches!(kind, NodeKind::Text | NodeKind::Reference(_));
        let root = body.and(tree.nodes.iter().position(|n| is_element(n.kind)));
        for (from, node) in tree.nodes.iter().enumerate() {
            let is_open = Some(from) == body || Some(from) == root;
            let to = if is_open && node.subtree_end as usize == from + 1 {
                usize::MAX
            } else {
                node.subtree_end as usize
            };
            for attribute in tree.attributes_of(from) {
                let Some(prefix) = bound_by(attribute.name) else {
                    continue;
                };
                if bindings.len() == MOST_BINDINGS {
                    sink.push(Diagnostic::error(
                        "eml::too-many-namespaces",
                        attribute.name_span(),
                        format!("more than {MOST_BINDINGS} namespaces; the rest is not bound"),
                    ));
                    return Self { bindings };
                }
                bindings.push(Binding {
                    prefix,
                    extensions: attribute.value.trim() == EXTENSIONS,
                    from,
                    to,
                });
            }
        }
        Self { bindings }
    }

    /// What a name in the tag of `node` belongs to, and the name without its prefix.
    /// Unprefixed attributes belong to their element, so `default_counts` is for elements.
    pub(crate) fn owner<'n>(
        &self,
        name: &'n str,
        node: usize,
        default_counts: bool,
    ) -> (Owner, &'n str) {
        let (prefix, local) = name.split_once(':').unwrap_or(("", name));
        if prefix == "xml" || prefix == "xmlns" {
            return (Owner::Foreign, local);
        }
        if prefix.is_empty() && !default_counts {
            return (Owner::Language, local);
        }
        let holds = |b: &&Binding<'_>| b.prefix == prefix && (b.from..b.to).contains(&node);
        let owner = match self.bindings.iter().rev().find(holds) {
            Some(binding) if binding.extensions => Owner::Extensions,
            // Whatever a script calls the namespace of the language itself.
            _ if prefix.is_empty() => Owner::Language,
            Some(_) => Owner::Foreign,
            None => Owner::Unbound,
        };
        (owner, local)
    }
}

/// The prefix that an attribute binds.
fn bound_by(name: &str) -> Option<&str> {
    match name.strip_prefix("xmlns")? {
        "" => Some(""),
        rest => rest.strip_prefix(':'),
    }
}

/// Warns of a prefix that nothing binds.
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

//! The short way through usual markup gives what the general reader gives.

use super::builder::build_with;
use super::tree::{NodeKind, Tree};
use crate::diagnostic::Sink;
use crate::{Diagnostic, Limits};
use proptest::prelude::*;

const LIMITS: Limits = Limits {
    bytes: 1 << 20,
    depth: 6,
    clauses: 1000,
    timed_clauses: 1000,
    clause_words: 1000,
    words: 1000,
    attributes: 3,
    diagnostics: 1000,
};

/// A tree from one node on as text, attributes included.
fn outline(tree: &Tree<'_>, from: usize) -> String {
    let mut out = String::new();
    for (index, node) in tree.nodes.iter().enumerate().skip(from) {
        let kind = match node.kind {
            NodeKind::Element(found) => found.map_or("unknown", |e| e.source),
            NodeKind::Malformed => "malformed",
            NodeKind::Text => "text",
            NodeKind::Reference(_) => "reference",
        };
        let attributes: Vec<_> = tree
            .attributes_of(index)
            .iter()
            .map(|a| (a.name, a.value, a.name_start, a.value_start, a.is_plain))
            .collect();
        let (span, end, subtree) = (node.span, node.end, node.subtree_end);
        out += &format!(
            "{kind} {:?} {span:?} {end} {subtree} {attributes:?}\n",
            node.text
        );
    }
    out
}

/// The elements that were taken, the rest of the tree, and what was reported.
fn read(source: &str, thorough: bool) -> (String, Vec<Diagnostic>) {
    let mut out = String::new();
    let mut sink = Sink::new(LIMITS.diagnostics);
    let mut take = |tree: &Tree<'_>, node: usize, _: &mut Sink| out += &outline(tree, node);
    let tree = build_with(source, &LIMITS, &mut sink, &mut take, thorough);
    (out + &outline(&tree, 0), sink.finish())
}

fn piece() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "<eml>",
        "</eml>",
        "<body>",
        "</body>",
        "<body/>",
        "<seq time='1'>",
        "</seq>",
        "<null/>",
        "<null time = '1'/>",
        "<null time='1'/ >",
        "<null time='1'x='2'/>",
        "<null a=''b=\"\"/>",
        "<null a='1' a='2' b='3' c='4' d='5'/>",
        "<null a='&lt;&amp'/>",
        "<voice-text>",
        "<emph>",
        "</emph>",
        "</voice-text >",
        "</>",
        "</ x>",
        "<x:y>",
        "<é/>",
        "<_a/>",
        "<a.b-c>",
        "<1>",
        "text",
        " ",
        "\n\t",
        "\u{c}",
        "\u{feff}",
        "é",
        "&amp;",
        "&#65;",
        "&",
        "&x",
        "& &",
        ";",
        "<!-- c -->",
        "<!--",
        "<![CDATA[ <x> ]]>",
        "<?pi?>",
        "<?xml version='1.0'?>",
        "<!DOCTYPE e>",
        "<!DOCTYPE",
        "<",
        ">",
        "'",
        "\"",
        "=",
        "/",
        "/>",
        "`",
        "<a",
        "<a b",
        "<a b=",
        "<a b='",
        "<a b='<",
        "<a b='>'>",
        "a='1'",
        "<a\u{c}b='1'/>",
        "<a\nb='1'\r\n/>",
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn both_ways_agree(pieces in prop::collection::vec(piece(), 0..24)) {
        let loose = pieces.concat();
        let wrapped = format!("<eml><body>{loose}</body></eml>");
        for source in [loose, wrapped] {
            prop_assert_eq!(read(&source, false), read(&source, true), "{}", source);
        }
    }
}

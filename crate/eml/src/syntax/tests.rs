//! Structure of the tree for any markup.

use super::builder::build;
use crate::Limits;
use crate::diagnostic::Sink;
use crate::markup::NodeKind;
use crate::schema::Tree;
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

/// Checks that the nodes from an index on are in source order, contain the text at their position,
/// and contain each other.
fn check(source: &str, tree: &Tree<'_>, from: usize) -> Result<(), TestCaseError> {
    let mut open: Vec<u32> = Vec::new();
    let mut at = 0;
    for (index, node) in tree.nodes.iter().enumerate().skip(from) {
        let (start, end) = (node.span.start as usize, node.span.end as usize);
        let shown = source.get(start..end);
        prop_assert!(at <= start && shown.is_some(), "{:?}", node);
        let shown = shown.unwrap_or_default();
        match node.kind {
            NodeKind::Element(_) | NodeKind::Malformed => {
                let inside = shown.strip_prefix('<');
                // The span of a broken tag ends before the white space, the name perhaps behind it.
                let name = node.text.trim_end();
                prop_assert!(inside.is_some_and(|s| s.starts_with(name)), "{:?}", node);
            }
            NodeKind::Text | NodeKind::Reference(_) => prop_assert_eq!(shown, node.text),
        }
        for attribute in tree.attributes_of(index) {
            for (part, span) in [
                (attribute.name, attribute.name_span()),
                (attribute.value, attribute.value_span()),
            ] {
                let (start, end) = (span.start as usize, span.end as usize);
                prop_assert_eq!(source.get(start..end), Some(part));
            }
        }
        open.retain(|&until| until as usize > index);
        prop_assert!(open.last().is_none_or(|&until| node.subtree_end <= until));
        open.push(node.subtree_end);
        at = start;
    }
    Ok(())
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
    fn nodes_are_where_they_say(pieces in prop::collection::vec(piece(), 0..24)) {
        let loose = pieces.concat();
        let wrapped = format!("<eml><body>{loose}</body></eml>");
        for source in [loose, wrapped] {
            let mut taken = Ok(());
            let mut take = |tree: &Tree<'_>, node: usize, _: &mut Sink| {
                let checked = check(&source, tree, node);
                taken = std::mem::replace(&mut taken, Ok(())).and(checked);
            };
            let mut sink = Sink::new(LIMITS.diagnostics);
            let tree = build(&source, &LIMITS, &mut sink, &mut take);
            taken?;
            check(&source, &tree, 0)?;
        }
    }
}

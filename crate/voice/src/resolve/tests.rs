use super::*;
use crate::content::Setting;
use crate::text::SayAs;
use raconteur_eml::emoticon::{EMOJI, EMOTICONS, whole};
use raconteur_speech::emotion::place;

fn text(text: &str) -> Segment {
    Segment::Text(text.to_owned())
}

fn resolve_segments(segments: Vec<Segment>) -> Resolved {
    resolve(&Content { segments }, "festival")
}

#[test]
fn a_word_has_the_style_of_its_first_letter_and_equal_styles_are_one() {
    let strong = || Segment::Open(Markup::Emphasis(2.0));
    let resolved = resolve_segments(vec![
        text("a (un"),
        strong(),
        text("be)lievable b \u{ab}"),
        Segment::Close,
        text("c "),
        strong(),
        text("\u{201c}d\u{201d}"),
    ]);
    let words: Vec<_> = resolved.styled_words();
    let emphases: Vec<_> = words.iter().map(|(w, s)| (*w, s.emphasis)).collect();
    assert_eq!(
        emphases,
        [
            ("a", 0.5),
            ("(unbe)lievable", 0.5),
            ("b", 2.0),
            ("\u{ab}c", 0.5),
            ("\u{201c}d\u{201d}", 2.0)
        ]
    );
    assert_eq!(resolved.styles.len(), 2);
}

#[test]
fn what_is_closed_too_often_or_never_is_tolerated() {
    let mut segments = vec![Segment::Close, Segment::Close, text("a ")];
    let faster = Segment::Open(Markup::Rate(Setting::Factor(1.0001)));
    segments.extend(core::iter::repeat_n(faster, MAX_DEPTH + 5));
    segments.push(text("b "));
    segments.extend(core::iter::repeat_n(Segment::Close, MAX_DEPTH + 5));
    segments.push(text("c"));
    let resolved = resolve_segments(segments);
    let styles: Vec<_> = resolved.styled_words();
    assert!(
        styles[0].1 == styles[2].1 && styles[0].1 != styles[1].1,
        "the styles outside the element are equal"
    );
    assert_eq!(styles.len(), 3);
}

#[test]
fn every_emoticon_has_a_word_of_the_table() {
    for (sign, word) in EMOTICONS {
        assert_eq!(whole(sign), Some((word, "")));
        assert!(place(word).is_some(), "{word}");
    }
    for (word, _) in EMOJI {
        assert!(place(word).is_some(), "{word}");
    }
}

#[test]
fn emoticons_are_found_with_spaces_too() {
    let emotions = |t: &str| {
        let resolved = resolve_segments(vec![text(t)]);
        let signs = resolved.items.iter().map(|item| match item {
            Item::Emoticon(word) => (*word).to_owned(),
            Item::Word { text, .. } | Item::Punctuation(text) => text.clone(),
            other => panic!("{other:?}"),
        });
        signs.collect::<Vec<_>>().join("|")
    };
    assert_eq!(
        emotions("ins ; - ) Endlose : - ( )"),
        "ins|kidding|Endlose|distress|)"
    );
    assert_eq!(
        emotions("nicht : - o mehr :- ) ;-)."),
        "nicht|surprise|mehr|joy|kidding|."
    );
    assert_eq!(emotions("> : - < - ) ; o : - O"), "anger|-|)|;|o|:|-|O");
}

#[test]
fn marks_inside_a_word_come_before_it_and_those_at_its_end_after_it() {
    let mark = |name: &str| Segment::Mark(name.to_owned());
    let resolved = resolve_segments(vec![
        text("one \u{201c}"),
        mark("a"),
        text("two"),
        mark("b"),
        text("fold,"),
        mark("c"),
        text("\u{201d} three"),
    ]);
    let order: Vec<_> = resolved
        .items
        .iter()
        .map(|item| match item {
            Item::Word { text, .. } | Item::Mark(text) => text.as_str(),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(
        order,
        ["one", "a", "b", "\u{201c}twofold,\u{201d}", "c", "three"]
    );
}

#[test]
fn what_is_read_as_one_is_told_apart_from_its_neighbour() {
    let sub = || {
        Segment::Open(Markup::Pronunciation {
            ipa: None,
            sub: Some("lyves".to_owned()),
            origin: None,
        })
    };
    let resolved = resolve_segments(vec![
        sub(),
        text("a b"),
        Segment::Close,
        text(" "),
        sub(),
        Segment::Open(Markup::SayAs(SayAs::Cardinal)),
        text("c"),
        Segment::Close,
        text(" d "),
        Segment::Close,
        Segment::Open(Markup::SayAs(SayAs::Cardinal)),
        text("e"),
        Segment::Close,
        text(" f"),
    ]);
    let together: Vec<_> = resolved
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Word { together, .. } => Some(*together),
            _ => None,
        })
        .collect();
    assert_eq!(together[0], together[1]);
    assert_eq!(together[2], together[3]);
    assert!(
        together[1] != together[2] && together[4] > together[3],
        "adjacent groups have different numbers"
    );
    assert_eq!(together[5], None);
}

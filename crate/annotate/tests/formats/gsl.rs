//! GSL: the examples of GEVH C.3.6, round trips of random values, and malformed texts.

use proptest::prelude::*;
use raconteur_annotate::gsl::{
    self, Feature, Item, Offset, Palm, Position, Sequence, Shape, Value, from_tracks, tracks,
};
use raconteur_base::Side;
use raconteur_eml::{ClauseKind, Span};

fn common<F>(items: Vec<(Option<Offset>, F)>) -> Value<F> {
    let item = |(offset, feature)| Item { offset, feature };
    Value::Common(Sequence {
        items: items.into_iter().map(item).collect(),
    })
}

fn parse<F: Feature>(text: &str) -> Value<F> {
    gsl::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn the_examples_of_the_thesis_are_read() {
    let palm = Palm {
        angle_deg: -90.0,
        axis: [0.0, 0.0, 1.0],
    };
    assert_eq!(
        parse("[-90;[0;0;1]] //Palm facing the left and -90 degrees rotation"),
        common(vec![(None, palm)])
    );
    let origin = Position([0.0, 0.0, 0.0]);
    let up = Position([0.0, 10.0, 0.0]);
    assert_eq!(
        parse("[0;10;0] //10 units above the speaker's frame of reference origin"),
        common(vec![(None, up)])
    );
    assert_eq!(
        parse(
            "[[0;0;0];[0;10;0]]\n\n//Gesture phase starts at the speaker's frame\n//and then raises \
             10 units"
        ),
        common(vec![(None, origin), (None, up)])
    );
    let hands = "RH=[-10;0;0];LH=[10;0;0] /* Right hand is 10 units to the right\nof the speakers' \
                 frame of reference and the left hand 10 units to the\nleft */";
    let Value::PerHand { right, left } = parse::<Position>(hands) else {
        panic!("each hand has its own")
    };
    let single = |sequence: Option<Sequence<Position>>| sequence.map(|s| s.items[0].feature.0);
    assert_eq!(single(right), Some([-10.0, 0.0, 0.0]));
    assert_eq!(single(left), Some([10.0, 0.0, 0.0]));
    assert_eq!(
        parse("[[0.12;[-10;0;0]];[50%;[-10;10;0]]] /* Hand starts moving */"),
        common(vec![
            (Some(Offset::Secs(0.12)), Position([-10.0, 0.0, 0.0])),
            (Some(Offset::Percent(50.0)), Position([-10.0, 10.0, 0.0])),
        ])
    );
    assert_eq!(parse("24"), common(vec![(None, Shape(24))]));
}

#[test]
fn the_feature_decides_what_a_list_means() {
    let shapes = common(vec![(None, Shape(1)), (None, Shape(2)), (None, Shape(3))]);
    assert_eq!(parse("[1;2;3]"), shapes);
    assert_eq!(
        parse("[1;2;3]"),
        common(vec![(None, Position([1.0, 2.0, 3.0]))])
    );
    let pair = common(vec![(None, Shape(0)), (None, Shape(24))]);
    assert_eq!(parse("[0;24]"), pair);
    let timed = common(vec![(Some(Offset::Secs(0.0)), Shape(24))]);
    assert_eq!(parse("[0.0;24]"), timed);
    assert_eq!(parse("[0s;24]"), timed);
    assert_eq!(parse("[ 0 s ; 24 ]"), timed);
    assert_eq!(parse("[[0;24]]"), timed);
    let at = common(vec![(Some(Offset::Secs(0.0)), Position([1.0, 2.0, 3.0]))]);
    assert_eq!(parse("[0;[1;2;3]]"), at);
    let palm = Palm {
        angle_deg: 90.0,
        axis: [0.0, 1.0, 0.0],
    };
    assert_eq!(parse("[90;[0;1;0]]"), common(vec![(None, palm)]));
    assert_eq!(
        parse("[25%;[90;[0;1;0]]]"),
        common(vec![(Some(Offset::Percent(25.0)), palm)])
    );
}

#[test]
fn items_without_times_are_evenly_spaced() {
    let offsets = |text: &str| match parse::<Shape>(text) {
        Value::Common(sequence) => sequence.offsets_secs(2.0),
        Value::PerHand { .. } => panic!("{text} is common"),
    };
    assert_eq!(offsets("7"), [0.0]);
    assert_eq!(offsets("[1;2;3]"), [0.0, 1.0, 2.0]);
    assert_eq!(offsets("[1;[25%;2];3;4]"), [0.0, 0.5, 1.25, 2.0]);
}

/// Error code and quoted place of a text.
fn fault<F: Feature>(text: &str) -> (&'static str, &str) {
    match gsl::parse::<F>(text) {
        Err(error) => (error.code, &text[error.start..error.end]),
        Ok(_) => panic!("{text} is read"),
    }
}

#[test]
fn errors_point_at_their_place() {
    assert_eq!(fault::<Shape>("61"), ("gsl::hand-shape", "61"));
    assert_eq!(fault::<Shape>("[4;2.5]"), ("gsl::hand-shape", "2.5"));
    assert_eq!(fault::<Position>("[1;2]"), ("gsl::unexpected", "1"));
    assert_eq!(fault::<Position>("[0,12;1;0]"), ("gsl::unexpected", ","));
    assert_eq!(fault::<Position>("[1;2;3"), ("gsl::not-closed", "["));
    assert_eq!(fault::<Position>("[1;2;3] /* x"), ("gsl::not-closed", "/*"));
    assert_eq!(fault::<Palm>("[90;[0;0;0]]"), ("gsl::zero-axis", "[0;0;0]"));
    assert_eq!(fault::<Position>("[120%;[1;2;3]]"), ("gsl::offset", "120%"));
    assert_eq!(fault::<Position>("XH=[1;2;3]"), ("gsl::hand", "XH"));
    assert_eq!(fault::<Shape>("RH=1;RH=2"), ("gsl::hand", "RH"));
    assert_eq!(fault::<Shape>("[]"), ("gsl::empty", "[]"));
    assert_eq!(fault::<Shape>(""), ("gsl::unexpected", ""));
    assert_eq!(fault::<Shape>(&"[".repeat(99)), ("gsl::too-large", "["));
}

/// Texts with one character replaced, removed, or everything after it removed.
fn malformed(text: &str) -> Vec<String> {
    let mut out = Vec::new();
    for (at, c) in text.char_indices() {
        let after = at + c.len_utf8();
        out.push(text[..at].to_owned());
        out.push(format!("{}{}", &text[..at], &text[after..]));
        for other in ['[', ']', ';', 'x', '%', '.', '/', '*', 'é', ','] {
            out.push(format!("{}{other}{}", &text[..at], &text[after..]));
        }
    }
    out
}

#[test]
fn malformed_texts_are_read_or_refused_at_a_place() {
    fn refused<F: Feature>(text: &str) -> usize {
        malformed(text)
            .iter()
            .filter(|text| match gsl::parse::<F>(text) {
                Ok(_) => false,
                Err(error) => {
                    assert!(
                        text.get(error.start..error.end).is_some(),
                        "{text}: {error}"
                    );
                    assert!(!error.message.is_empty(), "{text} says nothing");
                    true
                }
            })
            .count()
    }
    let count = refused::<Position>("RH=[[0.12;[-10;0;0]];[50%;[-10;10;0]]];LH=[10;0;0] /* é */")
        + refused::<Palm>("[[0.1;[90;[0;1;0]]];[45;[1;0;0.5]]]")
        + refused::<Shape>("RH=[7;[50%;24]];LH=3 // done");
    assert!(count > 300, "only {count} of them are malformed");
}

/// Reads the text of a value as that value, and its keys as the same keys.
fn round_trips<F>(value: &Value<F>) -> Result<(), TestCaseError>
where
    F: Feature + gsl::InEml + std::fmt::Debug,
{
    let text = value.to_string();
    prop_assert_eq!(
        &gsl::parse::<F>(&text).map_err(|e| e.to_string()),
        &Ok(value.clone()),
        "{}",
        text
    );
    let keys = tracks(value, 10.0, Span::default());
    let again: Value<F> = from_tracks(&keys).expect("GSL expresses what came from it");
    let keys_again = tracks(&again, 10.0, Span::default());
    let flat = |tracks: &[raconteur_eml::Track<F::Key>]| {
        let flat = tracks.iter().flat_map(|track| {
            track
                .keys
                .iter()
                .map(|key| (track.hand, key.offset_secs, key.value.clone()))
        });
        flat.collect::<Vec<_>>()
    };
    prop_assert!(
        flat(&keys) == flat(&keys_again),
        "{} gives other keys",
        text
    );
    for side in Side::BOTH {
        prop_assert_eq!(
            value.for_hand(side).is_some(),
            again.for_hand(side).is_some()
        );
    }
    Ok(())
}

proptest! {
    #[test]
    fn values_are_read_as_they_were_written(
        shapes in crate::random::value(crate::random::shape()),
        palms in crate::random::value(crate::random::palm()),
        positions in crate::random::value(crate::random::position()),
    ) {
        round_trips(&shapes)?;
        round_trips(&palms)?;
        round_trips(&positions)?;
    }

    #[test]
    fn any_text_is_read_or_refused(text in "([\\[\\];=%./* 0-9a-zé-]|RH|LH){0,60}") {
        let _ = gsl::parse::<Shape>(&text);
        let _ = gsl::parse::<Palm>(&text);
        let _ = gsl::parse::<Position>(&text);
    }
}

#[test]
fn keys_are_in_the_frame_of_eml() {
    let value = parse::<Position>("[[1;2;3];[4;5;-6]]");
    let keys = tracks(&value, 0.5, Span::default());
    assert_eq!(keys[0].keys[1].value.position, [4.0, 5.0, 6.0]);
    assert_eq!(keys[0].keys[1].offset_secs, 0.5);
    // The greeting of GEVH figure 3.13: in EML, a palm to the listener has a negative z.
    let eml = "<eml><body><gesture-key time='0' duration='1'><palms><key a='200' x='0' y='0' \
               z='-1'/></palms></gesture-key></body></eml>";
    let document = raconteur_eml::parse(eml).document;
    let ClauseKind::GestureKey(gesture) = &document.clauses[0].kind else {
        panic!("a gesture")
    };
    let value: Value<Palm> = from_tracks(&gesture.palms).expect("a palm");
    assert_eq!(value.to_string(), "[200;[0;0;1]]");
}

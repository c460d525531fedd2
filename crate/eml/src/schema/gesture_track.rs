//! Common parts of hand-shapes, palms and motion: a hand and timed keys.

use super::values::KeyTime;
use super::{Attribute, Context, Element, Fields, Kind};
use crate::{Diagnostic, Handedness, Interpolator, Key, Profile, Space, Track};
use raconteur_base::Side;

/// The hand of a track.
pub(super) const HAND: Attribute = Attribute::choice(
    "hand",
    &["left", "right"],
    "The hand. By default every hand that takes part; palms and motion are then mirrored for the other hand.",
);

/// The time of a key.
pub(super) const KEY_TIME: Attribute = Attribute::new(
    "time",
    Kind::KeyTime,
    "When to reach the value: seconds after the start of the gesture, or percent of its duration. Keys without a time are spaced evenly.",
)
.unit("s");

/// The course of a motion (extension).
pub(super) const INTERPOLATION: Attribute = Attribute::choice(
    "interpolation",
    Interpolator::WORDS,
    "The interpolation to the key, or to each key of the track (GEVH 3.5.1).",
)
.extension();

/// The control values of a course (extension).
pub(super) const CONTROLS: Attribute = Attribute::new(
    "controls",
    Kind::Numbers,
    "For bezier, x and y of two control points, time and distance from 0 to 1; for hermite, the slopes at the start and the end.",
)
.extension();

/// Interpolated quantity of a transition (extension).
pub(super) const SPACE: Attribute = Attribute::choice(
    "space",
    Space::WORDS,
    "Whether positions or joint angles are interpolated (GEVH 3.5.1).",
)
.extension();

/// Parent of a track; one track per hand is allowed.
pub(super) const PARENTS: &[&str] = &["gesture-key"];

/// Placeholder for the offset of a key without a time.
const UNTIMED: f64 = f64::NAN;

/// Maximum capacity reserved for a track's keys from its node count, since nodes may be anything.
const USUAL_KEYS: usize = 64;

/// Reads a track: its hand, and its keys with `value`. `None` if no key is left.
pub(super) fn read<'t, K: Default>(
    cx: &mut Context<'t>,
    node: usize,
    element: &'static Element,
    fields: &Fields<'t>,
    duration_secs: f64,
    mut value: impl FnMut(&mut Context<'t>, &Fields<'t>) -> Option<K>,
) -> Option<Track<K>> {
    let hand = match cx.choice(fields, "hand") {
        Some("left") => Some(Side::Left),
        Some("right") => Some(Side::Right),
        _ => None,
    };
    let profile = profile(cx, fields);
    let nodes = cx.tree.nodes[node].subtree_end as usize - node - 1;
    let mut keys: Vec<Key<K>> = Vec::with_capacity(nodes.min(USUAL_KEYS));
    // Rejected keys still occupy a position among those without a time.
    let mut dropped: Vec<usize> = Vec::new();
    cx.children(node, element, |cx, child, key| {
        let fields = cx.fields(child, key);
        cx.children(child, key, |_, _, _| {});
        let time = key_secs(cx, &fields, duration_secs);
        let read = if fields.is_complete() {
            value(cx, &fields)
        } else {
            None
        };
        let mut key = Key {
            offset_secs: time.unwrap_or(None).unwrap_or(UNTIMED),
            value: K::default(),
            profile: None,
            span: cx.full_span(child),
        };
        match read {
            Some(value) if time.is_ok() => {
                key.value = value;
                key.profile = self::profile(cx, &fields);
            }
            _ => dropped.push(keys.len()),
        }
        keys.push(key);
    });
    spread(&mut keys, duration_secs);
    if !dropped.is_empty() {
        let mut dropped = dropped.into_iter().peekable();
        let mut index = 0..;
        keys.retain(|_| dropped.next_if(|&at| Some(at) == index.next()).is_none());
    }
    if !keys.is_sorted_by_key(|k| k.offset_secs) {
        let message = format!(
            "the keys of `{}` are not in the order of their times",
            element.name
        );
        cx.sink
            .push(Diagnostic::warning("eml::key-order", fields.name, message));
        raconteur_base::order::sort_by_number(&mut keys, |k| k.offset_secs);
    }
    (!keys.is_empty()).then(|| Track {
        hand,
        keys,
        profile,
        span: cx.full_span(node),
    })
}

/// Parses the time of a key, seconds; `None` if it is absent, `Err` if it is invalid.
fn key_secs(
    cx: &mut Context<'_>,
    fields: &Fields<'_>,
    duration_secs: f64,
) -> Result<Option<f64>, ()> {
    let secs = match cx.key_time(fields)? {
        Some(KeyTime::Secs(secs)) => secs,
        Some(KeyTime::Fraction(fraction)) => fraction * duration_secs,
        None => return Ok(None),
    };
    if secs > duration_secs {
        let message =
            format!("the key at {secs} s is after the end of the gesture at {duration_secs} s");
        let span = fields.span_of("time");
        cx.sink
            .push(Diagnostic::warning("eml::late-key", span, message));
    }
    Ok(Some(secs))
}

/// Parses the motion profile (an extension) of a gesture, a track or a key; `None` if it has none.
pub(super) fn profile(cx: &mut Context<'_>, fields: &Fields<'_>) -> Option<Box<Profile>> {
    if !fields.is_extended() {
        return None;
    }
    let mut profile = Profile::default();
    cx.attributes(fields, &mut profile);
    let wanted = profile.interpolator.map_or(0, Interpolator::controls);
    let given = profile.controls.as_ref().map_or(0, Vec::len);
    if given != wanted {
        let message = match profile.interpolator {
            Some(course) => format!(
                "{} takes {wanted} control values, not {given}",
                course.word()
            ),
            None => "control values require an interpolation".to_owned(),
        };
        let span = fields.span_of("controls");
        cx.sink
            .push(Diagnostic::error("eml::bad-controls", span, message));
        profile.controls = None;
        profile.interpolator = None;
    }
    (profile != Profile::default()).then(|| Box::new(profile))
}

/// Adds a track, unless it is for a hand that does not take part or has one already.
pub(super) fn add<K>(
    cx: &mut Context<'_>,
    tracks: &mut Vec<Track<K>>,
    track: Option<Track<K>>,
    handedness: Handedness,
) {
    let Some(track) = track else { return };
    let covers = |track: &Track<K>, side: Side| {
        // The dominant hand is not known yet, so a track may not specify it alone.
        let takes_part = if handedness.is_relative() {
            track.hand.is_none()
        } else {
            handedness.includes(side, Side::Right)
        };
        takes_part && track.hand.is_none_or(|hand| hand == side)
    };
    if !Side::BOTH.iter().any(|&side| covers(&track, side)) {
        cx.sink.push(Diagnostic::warning(
            "eml::handedness",
            track.span,
            if handedness.is_relative() {
                "the dominant hand depends on the speaker; the track of one hand is ignored"
            } else {
                "this hand does not take part in the gesture; the track is ignored"
            },
        ));
        return;
    }
    let taken = tracks.iter().find(|t| {
        Side::BOTH
            .iter()
            .any(|&side| covers(t, side) && covers(&track, side))
    });
    if let Some(first) = taken {
        cx.sink.push(
            Diagnostic::warning(
                "eml::duplicate-track",
                track.span,
                "this hand already has a track of this feature; the track is ignored",
            )
            .related(first.span, "first given here"),
        );
        return;
    }
    // There is mostly one.
    tracks.reserve_exact(1);
    tracks.push(track);
}

/// Assigns times to untimed keys: evenly between their timed neighbours, with the ends at 0 and the
/// duration (GEVH 3.5.2).
fn spread<K>(keys: &mut [Key<K>], duration_secs: f64) {
    let is_untimed = |key: &Key<K>| key.offset_secs.is_nan();
    let last = keys.len().saturating_sub(1);
    if let Some(key) = keys.first_mut().filter(|key| is_untimed(key)) {
        key.offset_secs = 0.0;
    }
    if let Some(true) = keys.last().map(is_untimed) {
        // `max` passes over NaN.
        let times = keys.iter().map(|key| key.offset_secs);
        keys[last].offset_secs = times.fold(duration_secs, f64::max);
    }
    let mut from = 0;
    for to in 1..=last {
        let (start, end) = (keys[from].offset_secs, keys[to].offset_secs);
        if end.is_nan() {
            continue;
        }
        let steps = (to - from) as f64;
        for (step, key) in keys[from + 1..to].iter_mut().enumerate() {
            key.offset_secs = start + (end - start) * (step + 1) as f64 / steps;
        }
        from = to;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::testing::{codes, one};
    use crate::{ClauseKind, GestureKey, Span};

    fn gesture(inner: &str) -> GestureKey {
        let text = format!("<gesture-key time='1' duration='2'>{inner}</gesture-key>");
        let ClauseKind::GestureKey(gesture) = one(&text) else {
            panic!()
        };
        gesture
    }

    fn offsets(keys: &str) -> Vec<f64> {
        let gesture = gesture(&format!("<hand-shapes>{keys}</hand-shapes>"));
        gesture.hand_shapes[0]
            .keys
            .iter()
            .map(|k| k.offset_secs)
            .collect()
    }

    #[test]
    fn keys_without_times_are_spread_evenly() {
        assert_eq!(offsets("<key id='1'/>"), [0.0]);
        assert_eq!(
            offsets("<key id='1'/><key id='2'/><key id='3'/>"),
            [0.0, 1.0, 2.0]
        );
        let mixed = "<key id='1'/><key id='2' time='0.5'/><key id='3'/><key id='4' time='75%'/>";
        assert_eq!(offsets(mixed), [0.0, 0.5, 1.0, 1.5]);
        assert_eq!(
            offsets("<key id='1'/><key id='2' time='0.2s'/>"),
            [0.0, 0.2]
        );
    }

    #[test]
    fn a_dropped_key_does_not_move_the_others() {
        assert_eq!(spread_of(&[None, None, None]), [0.0, 1.0, 2.0]);
        let text = "<eml><body><gesture-key time='1' duration='2'><hand-shapes><key id='1'/>\
                    <key id='99'/><key id='3'/></hand-shapes></gesture-key></body></eml>";
        let parsed = crate::parse(text);
        let ClauseKind::GestureKey(gesture) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        let keys = &gesture.hand_shapes[0].keys;
        assert_eq!((keys[0].offset_secs, keys[1].offset_secs), (0.0, 2.0));
    }

    fn spread_of(times: &[Option<f64>]) -> Vec<f64> {
        let mut keys: Vec<Key<()>> = times
            .iter()
            .map(|&time| Key {
                offset_secs: time.unwrap_or(UNTIMED),
                value: (),
                profile: None,
                span: Span::default(),
            })
            .collect();
        spread(&mut keys, 2.0);
        keys.into_iter().map(|key| key.offset_secs).collect()
    }

    #[test]
    fn a_track_for_a_hand_that_rests_or_is_taken_is_ignored() {
        let body = |handedness: &str, inner: &str| {
            format!(
                "<eml><body><gesture-key time='1' duration='2' handedness='{handedness}'>{inner}\
                 </gesture-key></body></eml>"
            )
        };
        let left = "<hand-shapes hand='left'><key id='1'/></hand-shapes>";
        let both = "<hand-shapes><key id='1'/></hand-shapes>";
        assert_eq!(codes(&body("right", left)), ["eml::handedness"]);
        assert_eq!(
            codes(&body("both", &(both.to_owned() + left))),
            ["eml::duplicate-track"]
        );
        assert_eq!(codes(&body("left", left)), [""; 0]);
    }

    #[test]
    fn times_out_of_order_or_range_are_reported() {
        let body = |keys: &str| {
            format!(
                "<eml><body><gesture-key time='1' duration='2'><hand-shapes>{keys}</hand-shapes>\
                 </gesture-key></body></eml>"
            )
        };
        let swapped = "<key time='1' id='1'/><key time='0' id='2'/>";
        assert_eq!(codes(&body(swapped)), ["eml::key-order"]);
        assert_eq!(offsets_of(&body(swapped)), [0.0, 1.0]);
        assert_eq!(codes(&body("<key time='3' id='1'/>")), ["eml::late-key"]);
        assert_eq!(
            codes(&body("<key id='1'/><key time='-1' id='1'/>")),
            ["eml::out-of-range"]
        );
        assert_eq!(
            codes(&body("<key id='1'/><key time='t1' id='1'/>")),
            ["eml::bad-time"]
        );
    }

    fn offsets_of(text: &str) -> Vec<f64> {
        let parsed = crate::parse(text);
        let ClauseKind::GestureKey(gesture) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        gesture.hand_shapes[0]
            .keys
            .iter()
            .map(|k| k.offset_secs)
            .collect()
    }
}

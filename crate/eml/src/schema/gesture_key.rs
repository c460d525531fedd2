//! `gesture-key`: hand shapes, palm orientations and positions over an interval.

use super::gesture_track;
use super::{Attribute, Content, Context, Element, Fields};
use super::{hand_shapes, motion, palms};
use crate::record::Field as _;
use crate::{ClauseKind, GestureKey, Handedness, Phase};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Moves the hands through shapes, palm orientations and positions. Omitted features keep their value."),
    decision: super::reference_text("The source gives no default for handedness; both is assumed. A track for a hand that does not take part is ignored with a warning, and so is one for the left or right hand in a gesture of the dominant or the other hand. In a preparation or retraction, a single key is at the end of the phase, otherwise at its beginning."),
    source: super::reference_text("GEVH D.5.2"),
    example: super::reference_text("<gesture-key time='0' duration='3' handedness='right'><hand-shapes><key id='24'/></hand-shapes><motion><key x='-7' y='45' z='3'/></motion></gesture-key>"),
    content: Content::Elements,
    attributes: &[
        Attribute::seconds("duration", "The length of the gesture.").required(),
        Attribute::choice(
            "handedness",
            &["both", "left", "right", "dominant", "non-dominant"],
            "The hands that take part. dominant and non-dominant (an extension) are those of the speaker: palms and motion are written for the hand that r:performer specifies, and mirrored if the speaker's dominant hand is the other.",
        )
        .default("both"),
        Attribute::choice(
            "phase",
            Phase::WORDS,
            "The gesture phase (GEVH 3.5.2, appendix C).",
        )
        .extension(),
        Attribute {
            doc: "The motion profile of the whole gesture, above those of its keys: key times are positions on it (GEVH 3.5.1, hierarchies of interpolators).",
            ..gesture_track::INTERPOLATION
        },
        gesture_track::CONTROLS,
    ],
    ..Element::clause("gesture-key", build)
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let word = cx.choice(fields, "handedness");
    let known = Handedness::WORDS.iter().find(|(_, w)| Some(*w) == word);
    let handedness = known.map_or(Handedness::Both, |(handedness, _)| *handedness);
    let duration_secs = cx.number(fields, "duration")?;
    let mut phase: Option<Phase> = None;
    phase.set(cx.value(fields, "phase"));
    let pace = gesture_track::profile(cx, fields);
    let (mut shapes, mut palms, mut motions) = (Vec::new(), Vec::new(), Vec::new());
    cx.children(node, &ELEMENT, |cx, child, element| match element.name {
        "hand-shapes" => {
            let track = hand_shapes::track(cx, child, duration_secs);
            gesture_track::add(cx, &mut shapes, track, handedness);
        }
        "palms" => {
            let track = palms::track(cx, child, duration_secs);
            gesture_track::add(cx, &mut palms, track, handedness);
        }
        _ => {
            let track = motion::track(cx, child, duration_secs);
            gesture_track::add(cx, &mut motions, track, handedness);
        }
    });
    Some(ClauseKind::GestureKey(GestureKey {
        duration_secs,
        handedness,
        phase,
        pace,
        hand_shapes: shapes.into(),
        palms: palms.into(),
        motions: motions.into(),
    }))
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::{codes, one};
    use crate::{ClauseKind, Handedness};

    #[test]
    fn both_hands_take_part_unless_it_says_otherwise() {
        let ClauseKind::GestureKey(gesture) = one("<gesture-key time='1' duration='0.2s'/>") else {
            panic!()
        };
        assert_eq!(
            (gesture.duration_secs, gesture.handedness),
            (0.2, Handedness::Both)
        );
    }

    #[test]
    fn a_gesture_needs_a_length() {
        let body = |x: &str| {
            format!("<eml><body><null time='1'/><gesture-key time='1' {x}/></body></eml>")
        };
        assert_eq!(codes(&body("")), ["eml::missing-attribute"]);
        assert_eq!(codes(&body("duration='-1'")), ["eml::out-of-range"]);
        assert_eq!(codes(&body("duration='long'")), ["eml::bad-time"]);
        assert_eq!(
            codes(&body("duration='1' handedness='boht'")),
            ["eml::bad-choice"]
        );
    }

    #[test]
    fn an_extension_tells_its_phase() {
        let text = "<eml xmlns:p='urn:raconteur:eml:1'><body><gesture-key time='1' duration='1' \
                    p:phase='stroke'/></body></eml>";
        let parsed = crate::parse(text);
        assert_eq!(parsed.diagnostics, []);
        let ClauseKind::GestureKey(gesture) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        assert_eq!(gesture.phase, Some(crate::Phase::Stroke));
    }
}

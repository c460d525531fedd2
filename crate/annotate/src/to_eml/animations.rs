//! Gestures of other classes than gesticulation as keyframe animations (GEVH 3.5.5).

use raconteur_eml::{
    AnimationStyle, ClauseKind, DeterministicPrimitive, PlaybackStyle, PlayerAdd, PlayerKind,
    PrimitiveKind,
};

use super::anchors::Anchors;
use crate::gestura::{Gesture, GestureClass, Transcription, Vocabulary};
use crate::script::{Builder, seconds};

/// Name of the player of the animations.
const PLAYER: &str = "transcribed";

fn is_gesticulation(gesture: &Gesture) -> bool {
    gesture.class == GestureClass::Gesticulation
}

/// Returns the gestures that are performed by animations.
pub(super) fn performed(transcription: &Transcription) -> impl Iterator<Item = &Gesture> {
    let others = transcription
        .gestures
        .iter()
        .filter(|gesture| !is_gesticulation(gesture));
    others.filter(|gesture| gesture.animation.is_some())
}

/// Adds an animation for each such gesture that names one.
pub(super) fn write(builder: &mut Builder, transcription: &Transcription, anchors: &Anchors) {
    for gesture in transcription
        .gestures
        .iter()
        .filter(|g| !is_gesticulation(g))
    {
        if gesture.animation.is_none() {
            let message = format!(
                "the {} names no animation and is not performed",
                gesture.class.word()
            );
            builder.note("gestura::no-animation", gesture.span, message);
        }
    }
    let mut has_player = false;
    for gesture in performed(transcription) {
        if !has_player {
            has_player = true;
            let player = PlayerAdd {
                name: Some(PLAYER.into()),
                kind: PlayerKind::Multiple,
                layers: Some(1),
                ..PlayerAdd::default()
            };
            builder.push(seconds(0.0), ClauseKind::PlayerAdd(player));
        }
        let start_secs = gesture.interval.start_secs;
        let primitive = DeterministicPrimitive {
            primitive: PrimitiveKind::Push,
            player: Some(PLAYER.into()),
            animation: gesture.animation.clone(),
            style: Some(AnimationStyle {
                style: PlaybackStyle::TemporaryIterations,
                iterations: 1,
            }),
            ..DeterministicPrimitive::default()
        };
        let kind = ClauseKind::DeterministicPrimitive(Box::new(primitive));
        builder.push(anchors.time(start_secs, start_secs), kind);
    }
}

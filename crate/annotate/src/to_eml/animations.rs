//! Gestures of other classes than gesticulation as keyframe animations (GEVH 3.5.5).

use raconteur_eml::{
    AnimationStyle, ClauseKind, DeterministicPrimitive, PlaybackStyle, PlayerAdd, PlayerKind,
    PrimitiveKind,
};

use super::anchors::Anchors;
use crate::gestura::{GestureClass, Transcription, Vocabulary};
use crate::script::{Builder, seconds};

/// Name of the player of the animations.
const PLAYER: &str = "transcribed";

/// Adds an animation for each such gesture that names one.
pub(super) fn write(builder: &mut Builder, transcription: &Transcription, anchors: &Anchors) {
    let others = transcription.gestures.iter();
    let others = others.filter(|gesture| gesture.class != GestureClass::Gesticulation);
    let mut has_player = false;
    for gesture in others {
        let Some(animation) = &gesture.animation else {
            let message = format!(
                "the {} names no animation and is not performed",
                gesture.class.word()
            );
            builder.note("gestura::no-animation", gesture.span, message);
            continue;
        };
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
            animation: Some(animation.clone()),
            style: Some(AnimationStyle {
                style: PlaybackStyle::TemporaryIterations,
                ..AnimationStyle::default()
            }),
            ..DeterministicPrimitive::default()
        };
        let kind = ClauseKind::DeterministicPrimitive(Box::new(primitive));
        builder.push(anchors.time(start_secs, start_secs), kind);
    }
}

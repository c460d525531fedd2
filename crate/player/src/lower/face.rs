//! Conversion of a script's emotions and control parameters to plans of the face.

use raconteur_actor::Manner;
use raconteur_actor::nonverbal::PlanBasis;
use raconteur_actor::parameters::ParameterCommand;
use raconteur_eml::{Expressions, Performer};

use crate::lower::cues::UtteranceCue;
use crate::lower::expressed_emotion::ExpressedEmotion;
use crate::lower::requirements::Requirements;
use crate::lower::script::Script;
use crate::lower::{emotions, parameters};

/// Plans of the face for a script: emotions, control parameters and the performer's manner.
#[derive(Default)]
pub(crate) struct FacePlan {
    /// Emotions, in any order.
    pub(crate) emotions: Vec<ExpressedEmotion>,
    /// Commands to control parameters, by time.
    pub(crate) parameters: Vec<(f64, ParameterCommand)>,
    /// Names of the animations of control parameters that it needs.
    pub(crate) parameter_animations: Vec<String>,
    /// Manner in which the character accompanies its speech.
    pub(crate) character: Option<Performer>,
}

/// Plans the face for a script and its utterances.
pub(crate) fn lower(script: &Script, utterances: &[UtteranceCue]) -> FacePlan {
    let clips = Requirements::from_document(&script.document)
        .parameter_animations
        .into_iter();
    FacePlan {
        emotions: emotions::spans(script, utterances),
        parameters: parameters::commands(&script.document, &script.timeline),
        parameter_animations: clips.map(|(name, _)| name.to_owned()).collect(),
        character: script.document.performer.clone(),
    }
}

/// Returns the manner in which a character accompanies speech: from its script, with `otherwise` as
/// default.
pub(crate) fn manner(character: &Performer, otherwise: Manner) -> Manner {
    Manner {
        basis: match character.expressions {
            Some(Expressions::Sound) => PlanBasis::Audio,
            Some(Expressions::Text) => PlanBasis::Text,
            None => otherwise.basis,
        },
        head: character.head.unwrap_or(otherwise.head),
        brows: character.brows.unwrap_or(otherwise.brows),
        blinks: character.blinks.unwrap_or(otherwise.blinks),
        gaze: character.gaze.unwrap_or(otherwise.gaze),
        tilt_share: character.tilt_share.unwrap_or(otherwise.tilt_share),
        brow_share: character.brow_share.unwrap_or(otherwise.brow_share),
        pitch_threshold: character
            .pitch_threshold
            .unwrap_or(otherwise.pitch_threshold),
        accent_glances: character.accent_glances.unwrap_or(otherwise.accent_glances),
        pause_glances: character.pause_glances.unwrap_or(otherwise.pause_glances),
        thinking_secs: character.thinking_secs.unwrap_or(otherwise.thinking_secs),
        thinking_share: character.thinking_share.unwrap_or(otherwise.thinking_share),
        frown_share: character.frown_share.unwrap_or(otherwise.frown_share),
        lick_secs: character.lick_secs.unwrap_or(otherwise.lick_secs),
        head_by_loudness: character
            .head_by_loudness
            .unwrap_or(otherwise.head_by_loudness),
        brows_by_loudness: character
            .brows_by_loudness
            .unwrap_or(otherwise.brows_by_loudness),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_character_is_as_its_script_says_and_else_as_whoever_shows_it() {
        let text = "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer expressions='text' \
                    brows='0.5'/></head><body><voice-text time='0'>a</voice-text></body></eml>";
        let script = Script::read(text, None);
        let character = lower(&script, &[]).character.expect("a character");
        let shown = Manner {
            gaze: 0.25,
            brows: 2.0,
            ..Manner::default()
        };
        let expected = Manner {
            basis: PlanBasis::Text,
            brows: 0.5,
            ..shown
        };
        assert_eq!(manner(&character, shown), expected);
        let plain = Script::read(&text.replace("expressions='text'", ""), None);
        let character = lower(&plain, &[]).character.expect("a character");
        assert_eq!(manner(&character, shown).basis, PlanBasis::Audio);
    }
}

//! Plain data of a transcription.

use super::{
    PlainGesture, PlainLayer, PlainLevel, PlainPhase, PlainPhrase, PlainProsody, PlainSetting,
    PlainStaging, PlainTranscription, PlainUtterance, PlainWord,
};
use crate::gestura::{Noted, Phase, Phrase, Transcription, Vocabulary};

impl From<&Transcription> for PlainTranscription {
    fn from(transcription: &Transcription) -> Self {
        let words = transcription.words.iter().map(|word| PlainWord {
            token: word.token.clone(),
            start: word.interval.start_secs,
            end: word.interval.end_secs,
        });
        let utterances = transcription.utterances.iter().map(|u| PlainUtterance {
            text: u.text.clone(),
            first: *u.words.start(),
            last: *u.words.end(),
        });
        let levels = transcription.levels.iter().map(|span| PlainLevel {
            level: span.level.word().into(),
            first: *span.utterances.start(),
            last: *span.utterances.end(),
        });
        let gestures = transcription.gestures.iter().map(|gesture| PlainGesture {
            class: gesture.class.word().into(),
            confidence: gesture.confidence,
            animation: gesture.animation.clone(),
            start: gesture.interval.start_secs,
            end: gesture.interval.end_secs,
        });
        let prosody = transcription.prosody.iter().map(|prosody| PlainProsody {
            element: prosody.element.clone(),
            attributes: prosody.attributes.clone(),
            first: *prosody.words.start(),
            last: *prosody.words.end(),
        });
        let staging = transcription.staging.iter().map(|staging| PlainStaging {
            element: staging.element.clone(),
            attributes: staging.attributes.clone(),
            start: staging.interval.start_secs,
            end: staging.interval.end_secs,
        });
        let settings = transcription.settings.iter().map(|setting| PlainSetting {
            element: setting.element.clone(),
            attribute: setting.attribute.clone(),
            value: setting.value.clone(),
        });
        let layers = transcription.layers.iter().map(|layer| PlainLayer {
            name: layer.name.clone(),
            phases: layer.phases.iter().map(PlainPhase::from).collect(),
            phrases: layer.phrases.iter().map(PlainPhrase::from).collect(),
        });
        Self {
            media: transcription.media.clone(),
            coder: transcription.coder.clone(),
            words: words.collect(),
            utterances: utterances.collect(),
            levels: levels.collect(),
            gestures: gestures.collect(),
            prosody: prosody.collect(),
            staging: staging.collect(),
            settings: settings.collect(),
            layers: layers.collect(),
        }
    }
}

impl From<&Phase> for PlainPhase {
    fn from(phase: &Phase) -> Self {
        fn text<F>(noted: Option<&Noted<F>>) -> Option<String> {
            noted.map(|noted| noted.text.clone())
        }
        let form = &phase.form;
        Self {
            kind: phase.kind.word().into(),
            start: phase.interval.start_secs,
            end: phase.interval.end_secs,
            source: text(form.source.as_ref()),
            target: text(form.target.as_ref()),
            motion: text(form.motion.as_ref()),
            hand_shapes: text(form.hand_shapes.as_ref()),
            palm_orientations: text(form.palm_orientations.as_ref()),
            body_shape: form.body_shape.clone(),
        }
    }
}

impl From<&Phrase> for PlainPhrase {
    fn from(phrase: &Phrase) -> Self {
        fn word<V: Vocabulary>(value: Option<V>) -> Option<String> {
            value.map(|value| value.word().to_owned())
        }
        let meaning = phrase.meaning.clone();
        Self {
            first: *phrase.phases.start(),
            last: *phrase.phases.end(),
            dimension: word(phrase.dimension),
            handedness: word(phrase.handedness),
            symmetry: phrase.symmetry,
            speaker_frame_position: phrase.speaker_frame_position.clone(),
            confidence: phrase.confidence,
            contribution: phrase.contribution.clone(),
            iconic_body: meaning.iconic_body,
            iconic_motion: meaning.iconic_motion,
            iconic_viewpoint: word(meaning.iconic_viewpoint),
            metaphoric_base: meaning.metaphoric_base,
            metaphoric_referent: meaning.metaphoric_referent,
            metaphoric_motion: meaning.metaphoric_motion,
            deictic_geographic_target: meaning.deictic_geographic_target,
            deictic_narration_target: meaning.deictic_narration_target,
        }
    }
}

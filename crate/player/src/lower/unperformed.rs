//! What the language has and no part of the player performs yet: told once each, so that
//! nobody waits for it in vain.

use raconteur_eml::{Clause, ClauseKind, Diagnostic, Document, Span};

use crate::lower::voice::place_of;

/// One warning for each element and extension of the document that is not performed, at
/// its first place.
pub(crate) fn report(document: &Document) -> Vec<Diagnostic> {
    let mut found = Found::default();
    for (_, clause) in document.iter() {
        found.clause(clause);
    }
    found
        .places
        .into_iter()
        .map(|(name, span, count)| {
            let message = match count {
                _ if name == "emotion" => "`emotion` is in voice and face only; camera and light \
                                           do not follow it yet"
                    .to_owned(),
                1 => format!("`{name}` is not performed yet"),
                _ => format!("`{name}` is not performed yet; it occurs {count} times"),
            };
            Diagnostic::warning("player::not-performed", span, message)
        })
        .collect()
}

/// Names, their first places and how often they occur.
#[derive(Default)]
struct Found {
    places: Vec<(&'static str, Span, u32)>,
}

impl Found {
    fn add(&mut self, name: &'static str, span: Span) {
        match self.places.iter_mut().find(|(n, ..)| *n == name) {
            Some((.., count)) => *count += 1,
            None => self.places.push((name, span, 1)),
        }
    }

    fn clause(&mut self, clause: &Clause) {
        match &clause.kind {
            ClauseKind::VoiceText(_)
            | ClauseKind::VoiceSay(_)
            | ClauseKind::VoiceChange(_)
            | ClauseKind::GestureKey(_)
            | ClauseKind::GestureIsOn(_)
            | ClauseKind::ConfigureGeometry(_)
            | ClauseKind::Event { .. }
            | ClauseKind::Camera(_)
            | ClauseKind::Music(_)
            | ClauseKind::SetControlParameter(_)
            | ClauseKind::AdsrControlParameter(_)
            | ClauseKind::LoadControlParameterAnimation(_)
            | ClauseKind::AnimateControlParameter(_)
            | ClauseKind::DeterministicAnimation(_)
            | ClauseKind::DeterministicTrackProperty(_)
            | ClauseKind::DeterministicPrimitive(_)
            | ClauseKind::PlayerAdd(_)
            | ClauseKind::PlayerSetExclusive(_)
            | ClauseKind::PlayerChangePriority(_)
            | ClauseKind::PlayerRemove(_)
            | ClauseKind::PlayerClear
            | ClauseKind::VhMove(_)
            | ClauseKind::ConfigureManipulator(_)
            | ClauseKind::ForwardKinematics(_)
            | ClauseKind::JointInterpolation(_)
            | ClauseKind::FrameInterpolation(_)
            | ClauseKind::ManipulatorFunction(_)
            | ClauseKind::Jacobian(_)
            | ClauseKind::ManipulatorStop(_)
            | ClauseKind::ManipulatorLock(_)
            | ClauseKind::Null
            | ClauseKind::Seq(_)
            | ClauseKind::Par(_) => {}
            // One whose word is none has been told of.
            ClauseKind::Emotion(emotion)
                if place_of(emotion).is_none() && emotion.kind.is_none() => {}
            kind => self.add(kind.name(), clause.tag_span),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_eml::parse;

    #[test]
    fn what_is_not_performed_is_told_once_each() {
        let text = "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer figure='nuno'/></head>\
                    <body><voice-text time='0'>a <pitch base='low'>b</pitch>\
                    </voice-text><r:light time='1' color='#ffeedd'/><r:light time='2' color='#ffeedd'/>\
                    <r:emotion time='1' type='joy'/></body></eml>";
        let parsed = parse(text);
        assert_eq!(parsed.diagnostics, []);
        let messages: Vec<String> = report(&parsed.document)
            .into_iter()
            .map(|d| d.message)
            .collect();
        assert_eq!(
            messages,
            [
                "`light` is not performed yet; it occurs 2 times",
                "`emotion` is in voice and face only; camera and light do not follow it yet",
            ]
        );
    }
}

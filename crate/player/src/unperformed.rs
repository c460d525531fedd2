//! What the language has and no part of the player performs yet: told once each, so that
//! nobody waits for it in vain.

use raconteur_eml::{
    Clause, ClauseKind, Diagnostic, Document, GestureKey, Piece, Span, Track, VoiceText,
};

/// One warning for each element and extension of the document that is not performed, at
/// its first place.
pub(crate) fn report(document: &Document) -> Vec<Diagnostic> {
    let mut found = Found::default();
    if document.performer.is_some() {
        let start = document
            .clauses
            .first()
            .map_or(Span::new(0, 0), |c| c.tag_span);
        found.add("performer", start);
    }
    for (_, clause) in document.iter() {
        found.clause(clause);
    }
    found
        .places
        .into_iter()
        .map(|(name, span, count)| {
            let message = match count {
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
            ClauseKind::VoiceText(voice) => self.speech(voice),
            ClauseKind::GestureKey(gesture) => self.gesture(gesture, clause.tag_span),
            ClauseKind::GestureIsOn(_)
            | ClauseKind::Event { .. }
            | ClauseKind::Camera(_)
            | ClauseKind::Music(_)
            | ClauseKind::Null
            | ClauseKind::Seq(_)
            | ClauseKind::Par(_) => {}
            kind => self.add(kind.name(), clause.tag_span),
        }
    }

    fn speech(&mut self, voice: &VoiceText) {
        for piece in &voice.pieces {
            match piece {
                Piece::Start { markup, span } if markup.name() != "emph" => {
                    self.add(markup.name(), *span);
                }
                Piece::Audio { span, .. } => self.add("audio", *span),
                Piece::Marker { span, .. } => self.add("marker", *span),
                _ => {}
            }
        }
    }

    fn gesture(&mut self, gesture: &GestureKey, span: Span) {
        if gesture.phase.is_some() {
            self.add("phase", span);
        }
        for track in &gesture.hand_shapes {
            for key in &track.keys {
                if key.value.blend.is_some() {
                    self.add("id2", key.span);
                }
            }
        }
        let profiles = profiles(&gesture.hand_shapes)
            .chain(profiles(&gesture.palms))
            .chain(profiles(&gesture.motions));
        for span in profiles {
            self.add("interpolation", span);
        }
    }
}

/// Where tracks and their keys say how the hand moves.
fn profiles<K>(tracks: &[Track<K>]) -> impl Iterator<Item = Span> {
    tracks.iter().flat_map(|track| {
        let keys = track.keys.iter().map(|key| (&key.profile, key.span));
        let all = [(&track.profile, track.span)].into_iter().chain(keys);
        all.filter_map(|(profile, span)| profile.as_ref().map(|_| span))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_eml::parse;

    #[test]
    fn what_is_not_performed_is_told_once_each() {
        let text = "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer figure='nuno'/></head>\
                    <body><voice-text time='0'>a <pitch base='low'>b</pitch> <emph>c</emph>\
                    </voice-text><body-player-clear time='1'/><body-player-clear time='2'/>\
                    <gesture-key time='3' duration='1' r:phase='stroke'><motion \
                    r:interpolation='cosine'><key x='0' y='40' z='-8'/></motion></gesture-key>\
                    </body></eml>";
        let parsed = parse(text);
        assert_eq!(parsed.diagnostics, []);
        let messages: Vec<String> = report(&parsed.document)
            .into_iter()
            .map(|d| d.message)
            .collect();
        assert_eq!(
            messages,
            [
                "`performer` is not performed yet",
                "`pitch` is not performed yet",
                "`body-player-clear` is not performed yet; it occurs 2 times",
                "`phase` is not performed yet",
                "`interpolation` is not performed yet",
            ]
        );
    }
}

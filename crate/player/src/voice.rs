//! What a script says, and when each word and phone of it is heard.

use raconteur_actor::Library;
use raconteur_eml::{
    Durations, EstimatedDurations, PhoneTime, Piece, VoiceText, VoiceTiming, WordTime,
};
use raconteur_speech::{Bundle, Content, Segment, Utterance};

/// SABLE's emphasis (0 reduced, 0.5 none, 1 moderate, 2 strong) as a level around 1:
/// 0.5 reduced, 1 plain, 1.5 moderate, 2 strong.
fn emphasis_level(sable: f64) -> f64 {
    if sable <= 1.0 {
        0.5 + sable
    } else {
        1.5 + 0.5 * (sable - 1.0)
    }
    .clamp(0.5, 2.0)
}

/// What is to be said, free of EML. Characters of one word that stand on both sides of a
/// tag are joined to the stretch in which the word began, as [`VoiceText::words`] joins
/// them.
#[must_use]
pub fn content_of(voice: &VoiceText) -> Content {
    let mut content = Content::default();
    let mut word_is_open = false;
    for piece in &voice.pieces {
        match piece {
            Piece::Text { text, emphasis, .. } => {
                let mut rest = text.as_str();
                if word_is_open {
                    let head = rest.find(char::is_whitespace).unwrap_or(rest.len());
                    if let Some(Segment::Text { text: begun, .. }) = content.segments.last_mut() {
                        begun.push_str(&rest[..head]);
                        rest = &rest[head..];
                    }
                }
                if !rest.is_empty() {
                    word_is_open = !rest.ends_with(char::is_whitespace);
                    content.segments.push(Segment::Text {
                        text: rest.to_owned(),
                        emphasis: emphasis_level(*emphasis),
                    });
                }
            }
            Piece::Break { msec, .. } => {
                word_is_open = false;
                content.segments.push(Segment::Break { msec: *msec });
            }
            Piece::DivStart { .. } | Piece::DivEnd => {
                word_is_open = false;
                content.segments.push(Segment::Boundary);
            }
            Piece::Audio { .. } => word_is_open = false,
            Piece::Mark { .. } | Piece::Marker { .. } | Piece::Start { .. } | Piece::End => {}
        }
    }
    content
}

/// Answers the timeline from a speech bundle, by estimate where the bundle is silent, and
/// from a library of animations.
pub(crate) struct KnownDurations<'a> {
    pub(crate) bundle: Option<&'a Bundle>,
    pub(crate) library: &'a Library,
}

/// The utterance that was baked for a text, if its words are the text's.
pub(crate) fn find_utterance<'a>(bundle: &'a Bundle, voice: &VoiceText) -> Option<&'a Utterance> {
    let (_, utterance) = bundle.find(&content_of(voice).key())?;
    (utterance.words.len() == voice.words().len()).then_some(utterance)
}

impl Durations for KnownDurations<'_> {
    fn animation(&self, name: &str) -> Option<f64> {
        self.library.get(name).map(|clip| clip.duration_secs())
    }

    fn voice(&self, text: &VoiceText) -> VoiceTiming {
        let Some(utterance) = self.bundle.and_then(|b| find_utterance(b, text)) else {
            return EstimatedDurations.voice(text);
        };
        VoiceTiming {
            duration_secs: utterance.duration_secs,
            words: utterance
                .words
                .iter()
                .map(|w| WordTime {
                    start_secs: w.start_secs,
                    end_secs: w.end_secs,
                })
                .collect(),
            phones: utterance
                .phones
                .iter()
                .filter_map(|p| {
                    Some(PhoneTime {
                        symbol: p.symbol.clone(),
                        start_secs: p.start_secs,
                        end_secs: p.end_secs,
                        word: p.word?,
                    })
                })
                .collect(),
            estimated: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_eml::{ClauseKind, parse};

    fn voice(body: &str) -> VoiceText {
        let source = format!("<eml><body><voice-text time='0'>{body}</voice-text></body></eml>");
        let parsed = parse(&source);
        let clause = parsed.document.clauses.into_iter().next();
        match clause.map(|c| c.kind) {
            Some(ClauseKind::VoiceText(v)) => v,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn content_and_document_count_the_same_words() {
        for body in [
            "Hello world!",
            "<div>Hello <emph><tm name='t' event='onStart'/>world!</emph></div>",
            "un<emph>be</emph>lievable <tm name='x'/> stuff",
            "one<break msec='200'/> two <div>three</div>four",
            "  - dash , comma &amp; and <tm name='e'/>",
            "",
        ] {
            let v = voice(body);
            let words: Vec<String> = v.words().into_iter().map(|w| w.text).collect();
            assert_eq!(content_of(&v).words(), words, "{body}");
        }
    }

    #[test]
    fn emphasis_levels_keep_their_order() {
        let levels = [0.0, 0.5, 1.0, 2.0].map(emphasis_level);
        assert_eq!(levels, [0.5, 1.0, 1.5, 2.0]);
    }
}

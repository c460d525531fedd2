//! Script content for bakers, independent of EML.

use crate::content::{Age, Boundary, Content, Division, Gender, Markup, Segment, Setting, Speaker};
use crate::markup::levels::{self, Property};
use crate::text::{Order, SayAs};
use raconteur_eml as eml;
use raconteur_eml::{ClauseKind, TextSegment, VoiceText};
use raconteur_speech::emotion::EmotionPoint;

use raconteur_spoken::{SpokenClause, spoken_clauses};

/// Speech requested by a clause of a script, as input of the bake.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeechRequest {
    /// The key of its utterance.
    pub key: u64,
    /// Source of the words.
    pub source: Source,
    /// The voice that the script names for it.
    pub voice: Option<String>,
    /// The emotion that the script elicits for it, with its word.
    pub emotion: Option<(String, EmotionPoint)>,
    /// Tension of the story there, 0 to 1, if set by the script.
    pub tension: Option<f64>,
    /// Position in the script.
    pub span: eml::Span,
}

/// Source of spoken words: the script, SABLE markup or a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The script.
    Content(Content),
    /// A document of SABLE in the script.
    Sable(String),
    /// A file.
    File {
        /// Path of the file, which must stay in the script's folder.
        path: String,
        /// True if the file is a SABLE document.
        sable: bool,
        /// True if it is in the asset library instead of next to the story.
        library: bool,
    },
}

/// Returns all speech of a script in document order, as input of a baker.
#[must_use]
pub fn speech_requests(document: &eml::Document) -> Vec<SpeechRequest> {
    let heard = |spoken: SpokenClause<'_>| {
        Some(SpeechRequest {
            key: spoken.key(),
            source: source_of(spoken.kind)?,
            voice: spoken.voice.map(str::to_owned),
            emotion: spoken
                .elicited()
                .map(|(word, place)| (word.unwrap_or_default().to_owned(), place)),
            tension: spoken.tension,
            span: document.clause(spoken.id).tag_span,
        })
    };
    spoken_clauses(document)
        .into_iter()
        .filter_map(heard)
        .collect()
}

fn source_of(kind: &ClauseKind) -> Option<Source> {
    Some(match kind {
        ClauseKind::VoiceText(text) => Source::Content(content_of(text)),
        ClauseKind::VoiceSay(say) => {
            let sable = say.kind == eml::UtteranceKind::Sable;
            if say.is_file() {
                Source::File {
                    path: say.content.clone(),
                    sable,
                    library: say.is_resources_relative,
                }
            } else if sable {
                Source::Sable(say.content.clone())
            } else {
                Source::Content(content_of(&say.text()))
            }
        }
        _ => return None,
    })
}

/// Converts an EML voice text to content independent of EML.
#[must_use]
pub fn content_of(voice: &VoiceText) -> Content {
    let segments = voice.pieces.iter().filter_map(segment_of).collect();
    Content { segments }
}

fn segment_of(piece: &TextSegment) -> Option<Segment> {
    Some(match piece {
        TextSegment::Text { text, .. } => Segment::Text(text.to_string()),
        TextSegment::Break { msec, boundary, .. } => Segment::Break {
            msec: *msec,
            boundary: boundary.map(|b| match b {
                eml::Boundary::Question => Boundary::Question,
                eml::Boundary::Exclamation => Boundary::Exclamation,
                eml::Boundary::Statement => Boundary::Statement,
                eml::Boundary::Comma => Boundary::Comma,
            }),
        },
        TextSegment::DivStart { kind, .. } => Segment::Division(match kind {
            Some(eml::DivKind::Paragraph) => Division::Paragraph,
            _ => Division::Sentence,
        }),
        TextSegment::DivEnd => Segment::Division(Division::Sentence),
        TextSegment::Audio { audio, .. } => Segment::Audio {
            src: audio.src.clone(),
            background: audio.mode == eml::AudioMode::Background,
            level: audio.level,
        },
        TextSegment::Marker { mark, .. } => Segment::Mark(mark.clone()),
        TextSegment::Start { markup, .. } => Segment::Open(markup_of(markup)),
        TextSegment::End => Segment::Close,
        // A named time has no audio.
        TextSegment::Mark { .. } => return None,
    })
}

fn markup_of(markup: &eml::Markup) -> Markup {
    match markup {
        eml::Markup::Emph(emph) => Markup::Emphasis(match emph.level {
            eml::Level::Number(level) => level,
            eml::Level::Word(word) => levels::emphasis(word).unwrap_or(1.0),
            eml::Level::Percent(_) => 1.0,
        }),
        eml::Markup::Engine(engine) => Markup::Engine {
            id: engine.id.clone(),
            data: engine.data.clone(),
        },
        eml::Markup::Pitch(pitch) => Markup::Pitch {
            base: pitch.base.map(|l| setting(l, Property::Height)),
            middle: pitch.middle.map(|l| setting(l, Property::Height)),
            range: pitch.range.map(|l| setting(l, Property::Range)),
        },
        eml::Markup::Pron(pron) => Markup::Pronunciation {
            ipa: pron.ipa.clone(),
            sub: pron.sub.clone(),
            origin: pron.origin.clone(),
        },
        eml::Markup::Rate(rate) => Markup::Rate(setting(rate.speed, Property::Speed)),
        eml::Markup::Volume(volume) => Markup::Volume(setting(volume.level, Property::Loudness)),
        eml::Markup::SayAs(say) => Markup::SayAs(say_as(say)),
        eml::Markup::Language(language) => Markup::Language(language.id.clone()),
        eml::Markup::Speaker(speaker) => Markup::Speaker(Speaker {
            gender: speaker.gender.map(|g| match g {
                eml::Gender::Male => Gender::Male,
                eml::Gender::Female => Gender::Female,
            }),
            age: speaker.age.map(|age| match age {
                eml::Age::Older => Age::Older,
                eml::Age::Middle => Age::Middle,
                eml::Age::Younger => Age::Younger,
                eml::Age::Teen => Age::Teen,
                eml::Age::Child => Age::Child,
            }),
            name: speaker.name.clone(),
        }),
    }
}

/// Converts an EML level. Invalid values, such as a speech rate of zero, become the voice's own.
fn setting(level: eml::Level, property: Property) -> Setting {
    let setting = match level {
        eml::Level::Word(word) => property.word(word),
        eml::Level::Percent(percent) => property.percent(percent),
        eml::Level::Number(number) => property.number(number),
    };
    setting.unwrap_or(Setting::Default)
}

fn say_as(say: &eml::SayAs) -> SayAs {
    let order = say.mode_type.and_then(|kind| {
        Some(match kind {
            eml::SayAsType::Dmy => Order::Dmy,
            eml::SayAsType::Mdy => Order::Mdy,
            eml::SayAsType::Ymd => Order::Ymd,
            eml::SayAsType::Ym => Order::Ym,
            eml::SayAsType::My => Order::My,
            eml::SayAsType::Md => Order::Md,
            _ => return None,
        })
    });
    match say.mode {
        eml::SayAsMode::Literal => SayAs::Literal,
        eml::SayAsMode::Date => SayAs::Date(order),
        eml::SayAsMode::Time => SayAs::Time,
        eml::SayAsMode::Phone => SayAs::Phone,
        eml::SayAsMode::Net => SayAs::Net {
            email: say.mode_type == Some(eml::SayAsType::Email),
        },
        eml::SayAsMode::Postal => SayAs::Postal,
        eml::SayAsMode::Currency => SayAs::Currency,
        eml::SayAsMode::Math => SayAs::Math,
        eml::SayAsMode::Fraction => SayAs::Fraction,
        eml::SayAsMode::Measure => SayAs::Measure,
        eml::SayAsMode::Ordinal => SayAs::Ordinal,
        eml::SayAsMode::Cardinal => SayAs::Cardinal,
        eml::SayAsMode::Name => SayAs::Name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_eml::parse;

    fn voice(body: &str) -> VoiceText {
        let source = format!("<eml><body><voice-text time='0'>{body}</voice-text></body></eml>");
        let parsed = parse(&source);
        let clause = parsed.document.clauses.into_iter().next();
        match clause.map(|c| c.kind) {
            Some(ClauseKind::VoiceText(v)) => v,
            other => panic!("{other:?}"),
        }
    }

    fn planned(content: &Content) -> crate::plan::Plan {
        let lexicon = crate::text::Lexicon::default();
        crate::plan::plan(content, "en", "test", &lexicon).expect("little to say")
    }

    #[test]
    fn content_and_document_count_the_same_words() {
        for body in [
            "Hello world!",
            "<div>Hello <emph><tm name='t' event='onStart'/>world!</emph></div>",
            "un<emph>be</emph>lievable <tm name='x'/> stuff",
            "one<break msec='200'/> two <div>three</div>four",
            "  - dash , comma &amp; and <tm name='e'/>",
            "nicht :-o irdisch ;-) mehr :-oh : - o :- o : o o :-O x ;- ) . :-).",
            "a<audio src='a.wav'/>b",
            "",
        ] {
            let v = voice(body);
            let words: Vec<String> = v.words().into_iter().map(|w| w.text).collect();
            let content = content_of(&v);
            assert_eq!(content.words().len(), words.len(), "{body}");
            assert_eq!(planned(&content).words, words, "{body}");
        }
    }

    #[test]
    fn bakers_and_the_face_find_the_same_words_and_emoticons() {
        const PIECES: [&str; 40] = [
            "one",
            "Two,",
            "three.",
            "go!",
            "a:o",
            "http://x",
            "8:0",
            ":oh",
            "o",
            "O",
            ":-)",
            ":)",
            ":-(",
            ";-)",
            ";)",
            ":D",
            ":-D",
            ":o",
            ":O.",
            ":-o",
            ":-|",
            ":|,",
            "&gt;:-&lt;",
            "(:-)",
            ":",
            "-",
            ":-",
            ")",
            "(",
            "|",
            "😀",
            "Hi😂!",
            "😱no",
            "❤\u{fe0f}",
            "🐇",
            "<break msec='50'/>",
            "<div>in</div>",
            "&gt;",
            "&lt;",
            "<emph>big</emph>",
        ];
        let mut felt = 0;
        for seed in 0..3000 {
            let unit = |i: i64| raconteur_base::noise::unit(seed, 1, i);
            let length = 1 + (12.0 * unit(-1)) as i64;
            let pick = |i| PIECES[(unit(i) * PIECES.len() as f64) as usize % PIECES.len()];
            let text = (0..length).map(pick).collect::<Vec<_>>().join(" ");
            let voice = voice(&text);
            let content = content_of(&voice);
            let words: Vec<String> = voice.words().into_iter().map(|w| w.text).collect();
            assert_eq!(content.words().len(), words.len(), "{text}");
            let plan = planned(&content);
            assert_eq!(plan.words, words, "{text}");
            let found = voice.emoticons();
            let shown: Vec<_> = found.iter().map(|e| (e.before, e.name)).collect();
            assert_eq!(plan.emoticons, shown, "{text}");
            let tokens = plan.sentences.iter().flat_map(|s| &s.sentence.tokens);
            for token in tokens {
                assert!(
                    !token.text.contains(raconteur_eml::emoticon::is_emoji),
                    "{text}"
                );
            }
            felt += shown.len();
        }
        assert!(felt > 3000, "{felt}");
    }

    #[test]
    fn voices_and_emotions_reach_what_follows_them() {
        let parsed = parse(
            "<eml xmlns:r='urn:raconteur:eml:1'><body><voice-change time='0' voice='kal'/>\
             <r:emotion time='0' type='hate' potential='10'/><voice-text time='0'>One</voice-text>\
             <voice-say time='0' voiceOperation='preprocessFile' type='sable'>a.sable</voice-say>\
             <r:emotion time='0' type='neutral'/><voice-text time='3'>Two</voice-text>\
             </body></eml>",
        );
        let said = speech_requests(&parsed.document);
        assert_eq!(said[0].voice.as_deref(), Some("kal"));
        let (word, place) = said[0].emotion.as_ref().unwrap();
        assert_eq!((word.as_str(), place.activation), ("hate", 100.0));
        assert_eq!(
            said[1].source,
            Source::File {
                path: "a.sable".to_owned(),
                sable: true,
                library: true
            }
        );
        assert_eq!(said[2].emotion, None);
    }
}

//! `voice-say`: speaks a text or a file.

use super::{Attribute, Content, Context, Element, Fields};
use crate::{ClauseKind, Diagnostic, UtteranceKind, VoiceOperation, VoiceSay};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Speaks plain text or a file, without time markers. The content is the text, or the path of the file."),
    decision: super::reference_text("GEVH specifies it twice; this is both combined. In GEVH, speech was synthesised during the performance; here it is prepared in advance, so preprocess… takes no time and is not audible. The speech bundle gives the duration of files and SABLE documents; without one they count as having no length."),
    source: super::reference_text("GEVH D.4.2, D.4.14"),
    example: super::reference_text("<voice-say time='7' voiceOperation='text'>Once upon a time.</voice-say>"),
    content: Content::Text,
    attributes: &[Attribute::choice("voiceOperation", VoiceOperation::WORDS, "The operation: text and file speak, preprocess… only synthesise, asynchronous… speak while the following clauses continue.").required(),
Attribute::choice("type", UtteranceKind::WORDS, "The type of the content.").default("text"),
Attribute::flag("isResourcesRelativeFilePath", "Whether the path of a file is relative to the asset library instead of the folder of the story.").default("true")],
    ..Element::clause("voice-say", build)
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let mut say = VoiceSay::default();
    let complete = cx.record(node, fields, &mut say);
    let (content, span) = cx.character_data(node, &ELEMENT);
    (say.content, say.content_span) = (content.into(), span);
    if say.is_file() {
        say.content = say.content.trim().to_owned();
        if !super::values::is_inner_path(&say.content) {
            let message = "the path of the file leads out of the story's folder";
            let hint = "paths are relative, without `..`, `:` and `\\`";
            cx.sink
                .push(Diagnostic::error("eml::bad-path", say.content_span, message).hint(hint));
            return None;
        }
    } else if !say.content.contains(char::is_alphanumeric) {
        let message = "this `voice-say` has no text to speak";
        cx.sink
            .push(Diagnostic::warning("eml::empty-voice", fields.tag, message));
    }
    complete.then(|| ClauseKind::VoiceSay(Box::new(say)))
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, VoiceOperation};

    #[test]
    fn the_content_is_text_or_a_path() {
        let kind = one(
            "<voice-say time='7' voiceOperation='PreprocessFile' type='text'>  poetry/lusiadas.txt </voice-say>",
        );
        let ClauseKind::VoiceSay(say) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(say.operation, VoiceOperation::PreprocessFile);
        assert_eq!(
            (say.content.as_str(), say.spoken_text()),
            ("poetry/lusiadas.txt", None)
        );
        let kind = one("<voice-say time='7' voiceOperation='asynchronousFile'>a.txt</voice-say>");
        let ClauseKind::VoiceSay(say) = kind else {
            panic!("{kind:?}")
        };
        assert!(
            !say.is_waited_for() && say.spoken_text().unwrap().pieces.is_empty(),
            "the clause does not block and has no text"
        );
    }
    #[test]
    fn text_takes_its_time() {
        let kind = one("<voice-say time='7' voiceOperation='text'>One &amp; two</voice-say>");
        let ClauseKind::VoiceSay(say) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(say.spoken_text().unwrap().plain_text(), "One & two");
    }
    #[test]
    fn files_and_texts_are_checked() {
        assert_eq!(
            clause_codes("<voice-say time='0' voiceOperation='file'>/etc/passwd</voice-say>"),
            ["eml::bad-path"]
        );
        assert_eq!(
            clause_codes("<voice-say time='0' voiceOperation='text'/>"),
            ["eml::empty-voice"]
        );
        assert_eq!(
            clause_codes("<voice-say time='0' voiceOperation='text'>a<tm name='t'/></voice-say>"),
            ["eml::wrong-parent"]
        );
    }
}

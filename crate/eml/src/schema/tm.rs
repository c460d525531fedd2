//! `tm`: names a time in a word.

use super::{Attribute, Context, Element, Fields, Kind, Role, VOICE_PARENTS, VoiceBuilder};
use crate::{Diagnostic, MarkEvent, TextSegment};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Names a time in the next word, or the end of the speech if no word follows.",
    ),
    decision: super::reference_text(
        "If the word does not contain the phone, as in the example in GEVH, the start of the word is used, with a warning. Of several such phones, the first is used.",
    ),
    source: super::reference_text("GEVH D.4.3"),
    example: super::reference_text(
        "<voice-text time='1.0'><tm name='t1'/>Hello <tm name='t2' event='onPhone' phone='w'/>world!</voice-text>",
    ),
    attributes: &[
        Attribute::new("name", Kind::Name, "The name, for use in time expressions.").required(),
        Attribute::choice(
            "event",
            &["onStart", "onEnd", "onPhone"],
            "The time: the start or the end of the word, or the start of a phone in it.",
        )
        .default("onStart"),
        Attribute::text(
            "phone",
            "The phone for onPhone, in Festival's notation, such as hh or ow.",
        ),
    ],
    ..Element::new("tm", VOICE_PARENTS, Role::Voice(read))
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    cx.children(node, &ELEMENT, |_, _, _| {});
    let Some(name) = cx.text(fields, "name") else {
        return;
    };
    let phone = cx.text(fields, "phone");
    let event = match (cx.choice(fields, "event"), phone) {
        (Some("onEnd"), None) => MarkEvent::OnEnd,
        (Some("onPhone"), Some(phone)) => {
            MarkEvent::OnPhone(Box::new(phone.trim().to_ascii_lowercase().into()))
        }
        (Some("onPhone"), None) => {
            let message = "onPhone requires `phone`; the start of the word is used";
            cx.sink
                .push(Diagnostic::warning("eml::phone", fields.tag, message));
            MarkEvent::OnStart
        }
        (event, None) if event != Some("onEnd") => MarkEvent::OnStart,
        (event, _) => {
            let message = "`phone` only applies with event='onPhone'";
            cx.sink.push(Diagnostic::warning(
                "eml::phone",
                fields.span_of("phone"),
                message,
            ));
            if event == Some("onEnd") {
                MarkEvent::OnEnd
            } else {
                MarkEvent::OnStart
            }
        }
    };
    voice.pieces.push(TextSegment::Mark {
        name,
        event,
        span: cx.full_span(node),
    });
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::{codes, one};
    use crate::{ClauseKind, MarkEvent};

    #[test]
    fn marks_belong_to_the_next_word() {
        let kind = one(
            "<voice-text time='0'><tm name='a'/>Hello <tm name='b' event='onPhone' \
             phone='W'/>world<tm name='c' event='onend'/>!</voice-text>",
        );
        let ClauseKind::VoiceText(text) = kind else {
            panic!()
        };
        let marks: Vec<_> = text
            .marks()
            .into_iter()
            .map(|m| (m.name, m.event, m.word))
            .collect();
        assert_eq!(marks[0], ("a".into(), MarkEvent::OnStart, 0));
        assert_eq!(
            marks[1],
            ("b".into(), MarkEvent::OnPhone(Box::new("w".into())), 1)
        );
        assert_eq!(marks[2], ("c".into(), MarkEvent::OnEnd, 2));
    }

    #[test]
    fn names_and_phones_are_checked() {
        let with = |tm: &str| {
            codes(&format!(
                "<eml><body><voice-text time='0'>{tm}a</voice-text></body></eml>"
            ))
        };
        assert_eq!(with("<tm/>"), ["eml::missing-attribute"]);
        assert_eq!(with("<tm name='t-1'/>"), ["eml::bad-name"]);
        assert_eq!(with("<tm name='t' event='onPhone'/>"), ["eml::phone"]);
        assert_eq!(with("<tm name='t' phone='hh'/>"), ["eml::phone"]);
        assert_eq!(with("<tm name='t' event='onWord'/>"), ["eml::bad-choice"]);
    }
}

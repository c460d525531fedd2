//! `voice-text`: a text to speak.

use super::{Content, Context, Element, Fields, Role, variant_in};
use crate::markup::NodeKind;
use crate::voice::NO_EMPHASIS;
use crate::{ClauseKind, Diagnostic, Markup, Name, TextSegment, VoiceText};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Speaks a text. Markup inside controls the delivery and names times of words.",
    ),
    decision: super::reference_text(
        "Names of elements and values are in lower case, where SABLE uses capitals; other cases are accepted with a warning.",
    ),
    source: super::reference_text("GEVH D.4.1"),
    example: super::reference_text("<voice-text time='1.0'>Hello world!</voice-text>"),
    content: Content::Mixed,
    ..Element::clause("voice-text", build)
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let inside = node + 1..cx.tree.nodes[node].subtree_end as usize;
    // An element with content has a start and an end.
    let is_around = |&i: &usize| cx.tree.nodes[i].subtree_end as usize > i + 1;
    let most = inside.len() + inside.filter(is_around).count();
    let mut voice = VoiceBuilder {
        pieces: Vec::with_capacity(most),
        emphasis: NO_EMPHASIS,
    };
    voice.content(cx, node, ELEMENT.name);
    let text = VoiceText {
        pieces: voice.pieces,
    };
    if !text.has_words() {
        let message = "this `voice-text` has no text to speak";
        cx.sink
            .push(Diagnostic::warning("eml::empty-voice", fields.tag, message));
    }
    Some(ClauseKind::VoiceText(text))
}

/// Builder of a spoken text: its segments and the current emphasis.
pub(crate) struct VoiceBuilder {
    pub(crate) pieces: Vec<TextSegment>,
    /// SABLE emphasis level of the following text.
    pub(crate) emphasis: f64,
}

impl VoiceBuilder {
    /// Adds the content of a node that represents the container `parent`.
    pub(crate) fn content(&mut self, cx: &mut Context<'_>, node: usize, parent: &'static str) {
        let tree = cx.tree;
        let mut child = node + 1;
        while child < tree.nodes[node].subtree_end as usize {
            let inner = &tree.nodes[child];
            match inner.kind {
                NodeKind::Text => self.text(inner.text.into(), inner.span),
                NodeKind::Reference(c) => {
                    self.text(c.encode_utf8(&mut [0; 4]).into(), inner.span);
                }
                NodeKind::Malformed => {}
                NodeKind::Element(found) => self.element(cx, child, found, parent),
            }
            child = inner.subtree_end as usize;
        }
    }

    /// Adds an element in the container `parent`. Elements not allowed in speech are reported and
    /// their text is spoken.
    fn element(
        &mut self,
        cx: &mut Context<'_>,
        node: usize,
        found: Option<&'static Element>,
        parent: &'static str,
    ) {
        let Some(found) = cx.resolve(node, found, &ELEMENT) else {
            self.content(cx, node, parent);
            return;
        };
        let span = cx.name_span(node);
        let Some(element) = variant_in(found, parent) else {
            let message = format!(
                "`{}` is not allowed in `{parent}`; only its text is used",
                found.name
            );
            cx.sink
                .push(Diagnostic::warning("eml::wrong-parent", span, message));
            self.content(cx, node, parent);
            return;
        };
        cx.report_spelling(cx.tree.nodes[node].text, element.name, span);
        let fields = cx.fields(node, element);
        match element.role {
            Role::Voice(read) if fields.is_complete() => read(cx, node, &fields, self),
            Role::Container(blank) => self.container(cx, node, &fields, blank()),
            _ => {}
        }
    }

    /// Adds a container and its content; only the latter when the container is faulty.
    fn container(
        &mut self,
        cx: &mut Context<'_>,
        node: usize,
        fields: &Fields<'_>,
        mut markup: Markup,
    ) {
        let complete = cx.attributes(fields, markup.record());
        let outside = self.emphasis;
        if complete {
            if let Markup::Emph(emph) = &markup {
                self.emphasis = super::emph::number(emph.level);
            }
            self.pieces.push(TextSegment::Start {
                markup: Box::new(markup),
                span: fields.tag,
            });
        }
        self.content(cx, node, fields.element.name);
        if complete {
            self.pieces.push(TextSegment::End);
        }
        self.emphasis = outside;
    }

    fn text(&mut self, text: Name, span: crate::Span) {
        self.pieces.push(TextSegment::Text {
            text,
            emphasis: self.emphasis,
            span,
        });
    }
}

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, one};

    fn words(inner: &str) -> Vec<String> {
        let ClauseKind::VoiceText(text) =
            one(&format!("<voice-text time='0'>{inner}</voice-text>"))
        else {
            panic!()
        };
        text.words().into_iter().map(|w| w.text).collect()
    }

    #[test]
    fn text_references_and_cdata_are_spoken() {
        assert_eq!(
            words("caf&#233; &amp; <![CDATA[<tea>]]>"),
            ["café &", "<tea>"]
        );
    }

    #[test]
    fn unknown_markup_is_reported_and_its_text_spoken() {
        let text = "<eml><body><voice-text time='0'>a <shout>b <em>c</em></shout> d</voice-text>\
                    </body></eml>";
        assert_eq!(
            codes(text),
            ["eml::unknown-element", "eml::unknown-element"]
        );
        let parsed = crate::parse(text);
        let ClauseKind::VoiceText(voice) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        assert_eq!(voice.plain_text(), "a b c d");
        let text = "<eml><body><voice-text time='0'>...</voice-text></body></eml>";
        assert_eq!(codes(text), ["eml::empty-voice"]);
    }
}

//! `voice-text`: a text to speak.

use super::{
    CLAUSE_PARENTS, Content, Context, Element, Fields, Role, VOICE_PARENTS, find, variant_in,
};
use crate::suggest::{nearest, quoted};
use crate::syntax::NodeKind;
use crate::voice::NO_EMPHASIS;
use crate::{ClauseKind, Diagnostic, Name, Piece, VoiceText};

pub(super) static ELEMENT: Element = Element {
    name: "voice-text",
    aliases: &[],
    doc: "Speaks a text. Markup inside shapes how, and names moments of words.",
    source: "GEVH D.4.1",
    parents: CLAUSE_PARENTS,
    content: Content::Mixed,
    attributes: &[],
    required_children: &[],
    most_per_parent: None,
    role: Role::Clause(build),
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let most = cx.tree.nodes[node].subtree_end as usize - node;
    let mut voice = VoiceBuilder {
        pieces: Vec::with_capacity(most),
        emphasis: NO_EMPHASIS,
    };
    voice.content(cx, node, ELEMENT.name);
    let text = VoiceText {
        pieces: voice.pieces,
    };
    if !text.has_words() {
        let message = "there is nothing to speak in this `voice-text`";
        cx.sink
            .push(Diagnostic::warning("eml::empty-voice", fields.tag, message));
    }
    Some(ClauseKind::VoiceText(text))
}

/// Collects the pieces of a spoken text.
pub(crate) struct VoiceBuilder {
    pub(crate) pieces: Vec<Piece>,
    /// SABLE's emphasis level of the text that comes next.
    pub(crate) emphasis: f64,
}

impl VoiceBuilder {
    /// Adds the content of a node that stands for the container `parent`.
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
                NodeKind::Element(found) => match found.and_then(|e| variant_in(e, parent)) {
                    Some(element) => {
                        cx.report_spelling(inner.text, element.name, cx.name_span(child));
                        let fields = cx.fields(child, element);
                        match element.role {
                            Role::Voice(read) if fields.is_complete() => {
                                read(cx, child, &fields, self);
                            }
                            _ => {}
                        }
                    }
                    None => self.transparent(cx, child, parent),
                },
            }
            child = inner.subtree_end as usize;
        }
    }

    /// An element that does not belong into speech: its text is still spoken.
    fn transparent(&mut self, cx: &mut Context<'_>, node: usize, parent: &'static str) {
        let written = cx.tree.nodes[node].text;
        let span = cx.name_span(node);
        let (code, message) = match find(written) {
            Some(element) => (
                "eml::wrong-parent",
                format!(
                    "`{}` may not stand in `{parent}`; only its text is used",
                    element.name
                ),
            ),
            None => (
                "eml::unknown-element",
                format!(
                    "unknown element {} in speech; only its text is used",
                    quoted(written)
                ),
            ),
        };
        let known = super::ELEMENTS
            .iter()
            .filter(|e| VOICE_PARENTS.iter().any(|p| e.may_stand_in(p)));
        let hint = cx.hint(|| nearest(written, known.map(|e| e.name)));
        cx.push_with_hint(Diagnostic::warning(code, span, message), hint);
        self.content(cx, node, parent);
    }

    fn text(&mut self, text: Name, span: crate::Span) {
        self.pieces.push(Piece::Text {
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
            ["café", "<tea>"]
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

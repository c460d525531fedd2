//! Character and entity references. Only those of XML itself exist: without a DTD, nothing can be
//! declared and nothing is fetched.

use super::tree::Attribute;
use crate::diagnostic::Sink;
use crate::suggest::quoted;
use crate::{Diagnostic, Span};
use std::borrow::Cow;

/// Returns the character of a reference, given the text between `&` and `;`.
pub(crate) fn character(name: &str, span: Span, sink: &mut Sink) -> Option<char> {
    let found = match name {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => None,
    };
    if found.is_some() {
        return found;
    }
    if let Some(digits) = name.strip_prefix('#') {
        let code = match digits.strip_prefix('x') {
            Some(hex) => u32::from_str_radix(hex, 16),
            None => digits.parse(),
        };
        let c = code
            .ok()
            .and_then(char::from_u32)
            .filter(|&c| is_xml_character(c));
        if c.is_none() {
            sink.push(Diagnostic::error(
                "eml::bad-reference",
                span,
                format!("{} is not a character", quoted(&format!("&{name};"))),
            ));
        }
        return c;
    }
    sink.push(
        Diagnostic::error(
            "eml::unknown-entity",
            span,
            format!(
                "unknown entity {}; it is left out",
                quoted(&format!("&{name};"))
            ),
        )
        .hint("only &amp; &lt; &gt; &quot; &apos; and character references exist in EML"),
    );
    None
}

/// Returns true if a character below the surrogates matches XML 1.0's `Char` production.
fn is_xml_character(c: char) -> bool {
    !c.is_control() || matches!(c, '\t' | '\n' | '\r' | '\u{85}')
}

/// Returns an attribute's value with its character and entity references resolved.
pub(crate) fn resolve<'a>(attribute: &Attribute<'a>, sink: &mut Sink) -> Cow<'a, str> {
    if attribute.is_plain {
        Cow::Borrowed(attribute.value)
    } else {
        Cow::Owned(resolved(attribute.value, attribute.value_start, sink))
    }
}

/// Resolves the references in a text that starts at byte `start`.
fn resolved(value: &str, start: u32, sink: &mut Sink) -> String {
    let mut out = String::with_capacity(value.len());
    let mut rest = value;
    let mut at = start as usize;
    while let Some(amp) = rest.find('&') {
        out.push_str(&rest[..amp]);
        let tail = &rest[amp + 1..];
        let name_len = tail
            .find(|c: char| !(c.is_alphanumeric() || c == '#'))
            .unwrap_or(tail.len());
        let here = at + amp;
        let used = if name_len > 0 && tail[name_len..].starts_with(';') {
            let span = Span::from_offsets(here, here + name_len + 2);
            out.extend(character(&tail[..name_len], span, sink));
            name_len + 2
        } else {
            bare_ampersand(Span::from_offsets(here, here + 1), sink);
            out.push('&');
            1
        };
        at = here + used;
        rest = &rest[amp + used..];
    }
    out.push_str(rest);
    out
}

/// Reports an `&` that starts no reference.
pub(crate) fn bare_ampersand(span: Span, sink: &mut Sink) {
    sink.push(
        Diagnostic::error(
            "eml::bare-ampersand",
            span,
            "`&` does not start a reference",
        )
        .hint("write `&amp;`"),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_codes(value: &str) -> (String, Vec<&'static str>) {
        let mut sink = Sink::new(10);
        let text = resolved(value, 0, &mut sink);
        (text, sink.finish().iter().map(|d| d.code).collect())
    }

    #[test]
    fn references_of_xml_are_resolved_and_others_left_out() {
        assert_eq!(
            with_codes("a &lt; b &#233;&#x1F600;"),
            ("a < b é😀".into(), vec![])
        );
        assert_eq!(
            with_codes("x&xxe;y"),
            ("xy".into(), vec!["eml::unknown-entity"])
        );
        assert_eq!(
            with_codes("&#0;&#xD800;"),
            ("".into(), vec!["eml::bad-reference"; 2])
        );
        assert_eq!(
            with_codes("a & b&"),
            ("a & b&".into(), vec!["eml::bare-ampersand"; 2])
        );
    }
}

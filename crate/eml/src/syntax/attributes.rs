//! Reader of the attributes of a start tag. `quick-xml` finds the tag; its attribute iterator gives
//! no positions and stops at the first fault, and a live editor needs both.

use crate::diagnostic::Sink;
use crate::markup::Attribute;
use crate::schema::same;
use crate::suggest::quoted;
use crate::work::step;
use crate::{Diagnostic, Span};

/// Result of parsing a start tag: complete, or broken off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The tag ends at the expected position; every error was repaired.
    Whole,
    /// A quote or the `>` is missing: the next markup starts at this offset of the
    /// source, or nowhere.
    Broken(Option<usize>),
}

/// Reads the attributes of the element `element` in `raw`, which starts at byte `start`
/// of the source and ends before the tag's `>`, and appends them to `out`.
pub(super) fn scan<'a>(
    element: &str,
    raw: &'a str,
    start: usize,
    limit: usize,
    out: &mut Vec<Attribute<'a>>,
    sink: &mut Sink,
) -> Outcome {
    let bytes = raw.as_bytes();
    step(bytes.len());
    let first = out.len();
    let mut i = 0;
    let mut over_limit = false;
    // The first letters of the previous names: names with the same first letter are rare, so most
    // need no comparison.
    let mut initials = 0_u32;
    loop {
        i = skip_space(bytes, i);
        if i >= bytes.len() {
            return Outcome::Whole;
        }
        let name_start = i;
        while i < bytes.len() && CLASS[usize::from(bytes[i])] == Class::Name {
            i += 1;
        }
        if bytes.get(i) == Some(&b'<') {
            return stray(element, start + i, sink);
        }
        let name = &raw[name_start..i];
        let name_span = Span::from_offsets(start + name_start, start + i);
        i = skip_space(bytes, i);
        if name.is_empty() || bytes.get(i) != Some(&b'=') {
            if name.is_empty() {
                i = word_end(bytes, i);
            }
            nameless(&raw[name_start..i], start + name_start, sink);
            continue;
        }
        i = skip_space(bytes, i + 1);
        let quote = i;
        let value = match value(bytes, quote) {
            Ok(value) => value,
            Err(next) => return unclosed(element, start, quote, next, sink),
        };
        match value.marks {
            ValueQuotes::Quotes => {}
            ValueQuotes::Backticks => {
                unquoted(Span::from_offsets(start + quote, start + value.past), sink);
            }
            ValueQuotes::None => unquoted(
                name_span.to(Span::from_offsets(start + quote, start + value.past)),
                sink,
            ),
        }
        i = value.past;
        if out.len() - first >= limit {
            if !over_limit {
                over_limit = true;
                sink.push(Diagnostic::error(
                    "eml::too-many-attributes",
                    name_span,
                    format!("more than {limit} attributes; the rest is ignored"),
                ));
            }
            continue;
        }
        let initial = 1_u32 << (name.as_bytes()[0] & 31);
        let mut known = out[first..].iter().filter(|_| initials & initial != 0);
        if let Some(before) = known.find(|a| same(a.name, name)) {
            let diagnostic = Diagnostic::error(
                "eml::duplicate-attribute",
                name_span,
                format!("{} is given twice; the first one counts", quoted(name)),
            );
            sink.push(diagnostic.related(before.name_span(), "first given here"));
        } else {
            out.push(Attribute {
                name,
                value: &raw[value.from..value.to],
                name_start: name_span.start,
                value_start: Span::from_offsets(start + value.from, 0).start,
                is_plain: value.is_plain,
            });
            initials |= initial;
        }
    }
}

/// Quotes of a value.
enum ValueQuotes {
    Quotes,
    Backticks,
    None,
}

/// Location of a value in the tag.
struct Value {
    from: usize,
    to: usize,
    /// Offset after the value.
    past: usize,
    marks: ValueQuotes,
    /// True if the value contains no reference.
    is_plain: bool,
}

/// Reads the value at this offset. If its quote is not closed, returns the offset of the next
/// markup, if any.
fn value(bytes: &[u8], at: usize) -> Result<Value, Option<usize>> {
    let Some(q @ (b'\'' | b'"' | b'`')) = bytes.get(at).copied() else {
        let end = word_end(bytes, at);
        return Ok(Value {
            from: at,
            to: end,
            past: end,
            marks: ValueQuotes::None,
            is_plain: !bytes[at..end].contains(&b'&'),
        });
    };
    let from = at + 1;
    let mut is_plain = true;
    let mut end = from;
    while end < bytes.len() && bytes[end] != q && bytes[end] != b'<' {
        is_plain &= bytes[end] != b'&';
        end += 1;
    }
    if bytes.get(end) != Some(&q) {
        return Err((end < bytes.len()).then_some(end));
    }
    Ok(Value {
        from,
        to: end,
        past: end + 1,
        marks: if q == b'`' {
            ValueQuotes::Backticks
        } else {
            ValueQuotes::Quotes
        },
        is_plain,
    })
}

/// Returns the end of a run without space and markup.
fn word_end(bytes: &[u8], from: usize) -> usize {
    let ends = |&b: &u8| b.is_ascii_whitespace() || b == b'<';
    bytes[from..]
        .iter()
        .position(ends)
        .map_or(bytes.len(), |n| from + n)
}

fn skip_space(bytes: &[u8], mut i: usize) -> usize {
    while i < bytes.len() && CLASS[usize::from(bytes[i])] == Class::Space {
        i += 1;
    }
    i
}

/// Class of a byte in a tag.
#[derive(Clone, Copy, PartialEq)]
enum Class {
    Name,
    Space,
    /// Ends a name and is no space.
    Mark,
}

/// The class of every byte.
static CLASS: [Class; 256] = {
    let mut table = [Class::Name; 256];
    let mut b = 0;
    while b < table.len() {
        table[b] = match b as u8 {
            b'=' | b'\'' | b'"' | b'`' | b'<' | b'>' | b'/' => Class::Mark,
            space if space.is_ascii_whitespace() => Class::Space,
            _ => Class::Name,
        };
        b += 1;
    }
    table
};

fn stray(element: &str, at: usize, sink: &mut Sink) -> Outcome {
    sink.push(
        Diagnostic::error(
            "eml::malformed-tag",
            Span::from_offsets(at, at + 1),
            format!(
                "`<` inside the tag of {}, which is dropped",
                quoted(element)
            ),
        )
        .hint("is a `>` or `/>` missing before it?"),
    );
    Outcome::Broken(Some(at))
}

fn nameless(what: &str, at: usize, sink: &mut Sink) {
    sink.push(
        Diagnostic::error(
            "eml::malformed-attribute",
            Span::from_offsets(at, at + what.len()),
            format!("expected an attribute, found {}", quoted(what.trim_end())),
        )
        .hint("an attribute is written name='value'"),
    );
}

fn unclosed(
    element: &str,
    start: usize,
    quote: usize,
    next: Option<usize>,
    sink: &mut Sink,
) -> Outcome {
    sink.push(
        Diagnostic::error(
            "eml::malformed-tag",
            Span::from_offsets(start + quote, start + quote + 1),
            format!(
                "the quote that opens here is not closed before the next `<`; {} is dropped",
                quoted(element)
            ),
        )
        .hint("write `&lt;` for `<` inside a value"),
    );
    Outcome::Broken(next.map(|at| start + at))
}

fn unquoted(span: Span, sink: &mut Sink) {
    sink.push(
        Diagnostic::error(
            "eml::malformed-attribute",
            span,
            "the value is not in quotes",
        )
        .hint("quotes are ' or \""),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scanned(raw: &str) -> (Vec<(&str, &str)>, Outcome, Vec<&'static str>) {
        let mut sink = Sink::new(20);
        let mut out = Vec::new();
        let outcome = scan("x", raw, 100, 3, &mut out, &mut sink);
        let pairs = out.iter().map(|a| (a.name, a.value)).collect();
        (
            pairs,
            outcome,
            sink.finish().iter().map(|d| d.code).collect(),
        )
    }

    #[test]
    fn well_formed_attributes_keep_their_order_and_places() {
        let mut out = Vec::new();
        scan(
            "x",
            " a='1' b = \"2>\"",
            100,
            3,
            &mut out,
            &mut Sink::new(1),
        );
        assert_eq!((out[0].name, out[0].value), ("a", "1"));
        assert_eq!((out[1].name, out[1].value), ("b", "2>"));
        assert_eq!((out[1].name_start, out[1].value_start), (107, 112));
    }

    #[test]
    fn slips_are_mended_where_the_meaning_is_plain() {
        let bad = "eml::malformed-attribute";
        assert_eq!(
            scanned("a=1 b='2'"),
            (vec![("a", "1"), ("b", "2")], Outcome::Whole, vec![bad])
        );
        assert_eq!(
            scanned("a=`1`"),
            (vec![("a", "1")], Outcome::Whole, vec![bad])
        );
        assert_eq!(
            scanned("a b='2'"),
            (vec![("b", "2")], Outcome::Whole, vec![bad])
        );
        assert_eq!(scanned("a= "), (vec![("a", "")], Outcome::Whole, vec![bad]));
        assert_eq!(scanned("=é '\"/"), (vec![], Outcome::Whole, vec![bad, bad]));
    }

    #[test]
    fn an_open_quote_breaks_the_tag_at_the_next_markup() {
        let (pairs, outcome, codes) = scanned("a='1 b=2>\n<x c='3'");
        assert_eq!((pairs, outcome), (vec![], Outcome::Broken(Some(110))));
        assert_eq!(codes, ["eml::malformed-tag"]);
        assert_eq!(scanned("a='1").1, Outcome::Broken(None));
        assert_eq!(scanned("a='1' <x").1, Outcome::Broken(Some(106)));
    }

    #[test]
    fn twice_given_and_surplus_attributes_are_reported_once_each() {
        let (pairs, _, codes) = scanned("a='1' a='2' b='' c='' d='' e=''");
        assert_eq!(pairs, [("a", "1"), ("b", ""), ("c", "")]);
        assert_eq!(
            codes,
            ["eml::duplicate-attribute", "eml::too-many-attributes"]
        );
    }
}

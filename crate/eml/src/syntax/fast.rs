//! The markup that nearly all of a script consists of, read without `quick-xml`: tags as
//! they should be. Whatever is only a little unusual is left to the general reader, which
//! gives the same result for these.

use super::tree::Attribute;
use crate::Span;
use crate::schema::same;

/// A start tag as it should be.
pub(super) struct Tag<'a> {
    pub(super) name: &'a str,
    /// Offset after its `>`.
    pub(super) end: usize,
    /// Whether it ends with `/>`.
    pub(super) is_empty: bool,
}

/// Reads the start tag at byte `at`, where a `<` is, and appends its attributes, at most
/// `limit`, to `out`. None for what is unusual; some attributes may have been appended.
pub(super) fn tag<'a>(
    source: &'a str,
    at: usize,
    limit: usize,
    out: &mut Vec<Attribute<'a>>,
) -> Option<Tag<'a>> {
    let bytes = source.as_bytes();
    let first = out.len();
    let mut i = word_end(bytes, at + 1);
    if !bytes.get(at + 1)?.is_ascii_alphabetic() {
        return None;
    }
    let name = &source[at + 1..i];
    let mut initials = 0_u32;
    loop {
        let gap = i;
        i = space_end(bytes, i);
        let ends = match *bytes.get(i)? {
            b'>' => Some((i + 1, false)),
            b'/' if bytes.get(i + 1) == Some(&b'>') => Some((i + 2, true)),
            _ => None,
        };
        if let Some((end, is_empty)) = ends {
            return Some(Tag {
                name,
                end,
                is_empty,
            });
        }
        let name_start = i;
        i = word_end(bytes, i);
        let quote = *bytes.get(i + 1)?;
        let is_written = bytes[i] == b'=' && matches!(quote, b'\'' | b'"');
        if gap == name_start || i == name_start || !is_written {
            return None;
        }
        let attribute_name = &source[name_start..i];
        let value_start = i + 2;
        i = value_start;
        let mut is_plain = true;
        loop {
            i = end_of(bytes, i, |b| !ENDS_VALUE[usize::from(b)]);
            match *bytes.get(i)? {
                b if b == quote => break,
                b'<' => return None,
                b => is_plain &= b != b'&',
            }
            i += 1;
        }
        // Names that begin alike are rare, so most need no comparison.
        let initial = 1_u32 << (attribute_name.as_bytes()[0] & 31);
        let known = &out[first..];
        let is_again =
            initials & initial != 0 && known.iter().any(|a| same(a.name, attribute_name));
        if known.len() >= limit || is_again {
            return None;
        }
        initials |= initial;
        out.push(Attribute {
            name: attribute_name,
            value: &source[value_start..i],
            name_start: Span::of(name_start, 0).start,
            value_start: Span::of(value_start, 0).start,
            is_plain,
        });
        i += 1;
    }
}

/// Reads the end tag at byte `at`, where a `</` is: its name and the offset after it.
pub(super) fn end_tag(source: &str, at: usize) -> Option<(&str, usize)> {
    let end = word_end(source.as_bytes(), at + 2);
    let is_usual = end > at + 2 && source.as_bytes().get(end) == Some(&b'>');
    is_usual.then(|| (&source[at + 2..end], end + 1))
}

/// Where the text from byte `at` on ends: before markup or a reference; and whether it is
/// all white space.
pub(super) fn text_end(source: &str, at: usize) -> (usize, bool) {
    let bytes = source.as_bytes();
    let spaces_end = end_of(bytes, at, |b| b.is_ascii_whitespace());
    let end = end_of(bytes, spaces_end, |b| !matches!(b, b'<' | b'&'));
    (end, end == spaces_end)
}

fn word_end(bytes: &[u8], from: usize) -> usize {
    end_of(bytes, from, |b| IS_WORD[usize::from(b)])
}

fn space_end(bytes: &[u8], from: usize) -> usize {
    end_of(bytes, from, |b| matches!(b, b' ' | b'\t' | b'\n' | b'\r'))
}

/// Where a run of wanted bytes that starts at `from` ends.
#[inline(always)]
fn end_of(bytes: &[u8], from: usize, is_wanted: impl Fn(u8) -> bool) -> usize {
    let mut at = from;
    while bytes.get(at).is_some_and(|&b| is_wanted(b)) {
        at += 1;
    }
    at
}

/// The bytes that mean something in a value.
static ENDS_VALUE: [bool; 256] = {
    let mut table = [false; 256];
    table[b'<' as usize] = true;
    table[b'&' as usize] = true;
    table[b'\'' as usize] = true;
    table[b'"' as usize] = true;
    table
};

/// The bytes of usual names: ASCII letters, digits and `_`, `-`, `.`, `:`.
static IS_WORD: [bool; 256] = {
    let mut table = [false; 256];
    let mut b = 0;
    while b < table.len() {
        table[b] =
            (b as u8).is_ascii_alphanumeric() || matches!(b as u8, b'_' | b'-' | b'.' | b':');
        b += 1;
    }
    table
};

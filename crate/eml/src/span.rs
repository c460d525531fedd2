//! Byte spans and their translation to lines and columns.

/// Range of bytes in the source text, `start` included and `end` excluded; locates diagnostics.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte, never before `start`.
    pub end: u32,
}

impl Span {
    /// Creates the span from `start` to `end`, bytes.
    #[must_use]
    pub fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// Creates the span from byte `start` to byte `end` of a source, which is limited to less than
    /// 4 GiB.
    pub(crate) fn from_offsets(start: usize, end: usize) -> Self {
        debug_assert!(start.max(end) <= u32::MAX as usize);
        Self {
            start: start as u32,
            end: end as u32,
        }
    }

    /// Returns the smallest span that contains both spans.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Returns the spanned part of `source`; empty if out of range.
    #[must_use]
    pub fn slice(self, source: &str) -> &str {
        source
            .get(self.start as usize..self.end as usize)
            .unwrap_or("")
    }
}

/// Line and column of a character in a text; both start at 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1, in the unit of the method that gave it.
    pub column: u32,
}

/// Index that converts byte offsets to lines and columns. O(n) to build, O(log lines) per query,
/// for lines of any length.
#[derive(Clone, Debug)]
pub struct LineIndex<'a> {
    source: &'a str,
    line_starts: Vec<u32>,
    /// Counts before every [`STRIDE`]th byte.
    counts: Vec<Count>,
}

/// Bytes between two counts.
const STRIDE: usize = 1024;

/// Characters and UTF-16 code units.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    characters: usize,
    units: usize,
}

impl Count {
    /// Returns the count increased by the characters that begin in `bytes`.
    fn and(self, bytes: &[u8]) -> Self {
        let begin = bytes.iter().filter(|&&b| b & 0xc0 != 0x80).count();
        // Four bytes in UTF-8 are two units in UTF-16.
        let pairs = bytes.iter().filter(|&&b| b >= 0xf0).count();
        Self {
            characters: self.characters + begin,
            units: self.units + begin + pairs,
        }
    }
}

impl<'a> LineIndex<'a> {
    /// Indexes `source`. Lines end with `\n`; a `\r` before it belongs to the line.
    #[must_use]
    pub fn new(source: &'a str) -> Self {
        let mut line_starts = vec![0];
        line_starts.extend(
            source
                .bytes()
                .enumerate()
                .filter(|&(_, b)| b == b'\n')
                .filter_map(|(i, _)| u32::try_from(i + 1).ok()),
        );
        let mut counts = vec![Count::default()];
        for bytes in source.as_bytes().chunks_exact(STRIDE) {
            counts.push(counts[counts.len() - 1].and(bytes));
        }
        Self {
            source,
            line_starts,
            counts,
        }
    }

    /// Returns line and column in characters (Unicode scalar values). An offset past the end counts
    /// as the end, one inside a character as its start.
    #[must_use]
    pub fn position(&self, offset: u32) -> Position {
        let (line, start, end) = self.split(offset);
        let column = self.before(end).characters - self.before(start).characters;
        Position {
            line,
            column: count(column).saturating_add(1),
        }
    }

    /// Returns line and column in UTF-16 code units, as browsers and editors count.
    #[must_use]
    pub fn position_utf16(&self, offset: u32) -> Position {
        let (line, start, end) = self.split(offset);
        let column = self.before(end).units - self.before(start).units;
        Position {
            line,
            column: count(column).saturating_add(1),
        }
    }

    /// Returns the offset at which a line, from 1, starts; the end of the text if there is no such
    /// line.
    #[must_use]
    pub fn line_start(&self, line: u32) -> u32 {
        let index = line.saturating_sub(1) as usize;
        let start = self.line_starts.get(index).copied();
        start.unwrap_or_else(|| count(self.source.len()))
    }

    /// Returns the text of a line, from 1, without its line end; empty if there is no such line.
    #[must_use]
    pub fn line_text(&self, line: u32) -> &'a str {
        let index = line.saturating_sub(1) as usize;
        let Some(&start) = self.line_starts.get(index) else {
            return "";
        };
        let end = self
            .line_starts
            .get(index + 1)
            .map_or(self.source.len(), |&e| e as usize);
        self.source[start as usize..end].trim_end_matches(['\n', '\r'])
    }

    /// Returns the counts before a byte.
    fn before(&self, at: usize) -> Count {
        let counted = at / STRIDE;
        self.counts[counted].and(&self.source.as_bytes()[counted * STRIDE..at])
    }

    /// Returns the line, from 1, of an offset, the start of the line, and the offset moved to the
    /// start of its character.
    fn split(&self, offset: u32) -> (u32, usize, usize) {
        let mut end = (offset as usize).min(self.source.len());
        while !self.source.is_char_boundary(end) {
            end -= 1;
        }
        let line = self.line_starts.partition_point(|&s| s as usize <= end);
        let start = self.line_starts[line - 1] as usize;
        (count(line), start, end)
    }
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn columns_count_characters_or_utf16_units() {
        let text = "a\n<x y='😀é' z";
        let lines = LineIndex::new(text);
        let z = u32::try_from(text.find('z').unwrap()).unwrap();
        assert_eq!(
            lines.position(z),
            Position {
                line: 2,
                column: 11
            }
        );
        assert_eq!(
            lines.position_utf16(z),
            Position {
                line: 2,
                column: 12
            }
        );
    }

    proptest! {
        /// Checks positions against a character-by-character count, in lines of any length.
        #[test]
        fn positions_are_those_of_the_naive_count(
            text in "([a-zé€😀]{0,40}|\n|\r\n){0,200}", at in any::<prop::sample::Index>(),
        ) {
            let lines = LineIndex::new(&text);
            let mut end = at.index(text.len() + 1);
            let offset = u32::try_from(end).unwrap();
            while !text.is_char_boundary(end) {
                end -= 1;
            }
            let start = text[..end].rfind('\n').map_or(0, |i| i + 1);
            let before = &text[start..end];
            let line = 1 + count(text[..end].matches('\n').count());
            let characters = 1 + count(before.chars().count());
            let units = 1 + count(before.encode_utf16().count());
            prop_assert_eq!(lines.position(offset), Position { line, column: characters });
            prop_assert_eq!(lines.position_utf16(offset), Position { line, column: units });
        }
    }

    #[test]
    fn offsets_outside_characters_are_clamped() {
        let lines = LineIndex::new("é\r\nb");
        assert_eq!(lines.position(1), Position { line: 1, column: 1 });
        assert_eq!(lines.position(999), Position { line: 2, column: 2 });
        assert_eq!(lines.line_text(1), "é");
        assert_eq!(lines.line_text(2), "b");
        assert_eq!(lines.line_text(3), "");
    }
}

//! Diagnostic excerpts: the lines of a text, cut to the columns around the marked positions. A
//! story may be one line of several megabytes with hundreds of diagnostics.

use std::ops::Range;

use codespan_reporting::files::{Error, Files};
use raconteur_base::printable::printable;
use raconteur_eml::{LineIndex, Span};

/// Maximum number of shown characters of a line, including the truncation marks.
const COLUMNS: usize = 200;
/// Number of shown characters before the position.
const BEFORE: usize = 60;
/// Truncation mark.
const CUT: char = '…';

/// Excerpt of the source lines that a diagnostic shows, with their original positions.
pub(crate) struct Excerpt<'a> {
    file: &'a str,
    text: String,
    /// Shown lines, in source order.
    lines: Vec<Line<'a>>,
}

/// Source line, or its shown part.
struct Line<'a> {
    /// Line number in the source, from 1.
    number: u32,
    /// The whole line in the source, bytes.
    whole: Range<usize>,
    /// Shown range of the line.
    shown: Range<usize>,
    /// Shown text with control characters replaced by printable ones, which may be longer.
    source: &'a str,
    /// Characters before that.
    columns_cut: usize,
    /// Start in the excerpt, including a truncation mark.
    at: usize,
    /// The length of that mark, bytes.
    mark: usize,
}

impl<'a> Excerpt<'a> {
    /// Builds the excerpt from the lines at which a diagnostic and its related spans begin, each
    /// once.
    pub(crate) fn from_source(
        file: &'a str,
        index: &LineIndex<'a>,
        primary: Span,
        related: impl Iterator<Item = Span>,
    ) -> Self {
        let mut lines: Vec<Line<'a>> = Vec::new();
        for span in [primary].into_iter().chain(related) {
            let number = index.position(span.start).line;
            if lines.iter().all(|line| line.number != number) {
                lines.push(Line::around(span.start as usize, number, index));
            }
        }
        lines.sort_by_key(|line| line.number);
        let mut text = String::new();
        for line in &mut lines {
            line.at = text.len();
            if line.shown.start > line.whole.start {
                text.push(CUT);
            }
            line.mark = text.len() - line.at;
            text.push_str(&printable(line.source));
            if line.shown.end < line.whole.end {
                text.push(CUT);
            }
            text.push('\n');
        }
        Self { file, text, lines }
    }

    /// Returns the range of a span in the excerpt, limited to the shown part.
    pub(crate) fn range(&self, span: Span) -> Range<usize> {
        let start = span.start as usize;
        let after = self.lines.partition_point(|l| l.whole.start <= start);
        let Some(line) = after.checked_sub(1).and_then(|i| self.lines.get(i)) else {
            return 0..0;
        };
        let place = |offset: usize| {
            let inside = offset.clamp(line.shown.start, line.shown.end);
            // An offset inside a character counts as the start of it.
            let before = line.source.floor_char_boundary(inside - line.shown.start);
            line.at + line.mark + printable(&line.source[..before]).len()
        };
        let (start, end) = (place(start), place(span.end as usize));
        start..end.max(start)
    }

    fn line(&self, index: usize) -> Result<&Line<'a>, Error> {
        let max = self.lines.len();
        let given = index;
        self.lines
            .get(index)
            .ok_or(Error::LineTooLarge { given, max })
    }
}

impl<'a> Line<'a> {
    fn around(offset: usize, number: u32, index: &LineIndex<'a>) -> Self {
        let text = index.line_text(number);
        let start = index.line_start(number) as usize;
        let mut place = offset.saturating_sub(start).min(text.len());
        while !text.is_char_boundary(place) {
            place -= 1;
        }
        let mut from = 0;
        let mut to = text.len();
        if text.char_indices().nth(COLUMNS).is_some() {
            let room = COLUMNS - 2;
            let before = text[..place].char_indices().rev().nth(BEFORE - 1);
            from = before.map_or(0, |(at, _)| at);
            let end = text[from..].char_indices().nth(room);
            to = end.map_or(text.len(), |(at, _)| from + at);
        }
        Self {
            number,
            whole: start..start + text.len(),
            shown: start + from..start + to,
            source: &text[from..to],
            columns_cut: text[..from].chars().count(),
            at: 0,
            mark: 0,
        }
    }
}

impl<'a> Files<'a> for Excerpt<'_> {
    type FileId = ();
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(self.file)
    }

    fn source(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(&self.text)
    }

    fn line_index(&'a self, (): (), byte: usize) -> Result<usize, Error> {
        let after = self.lines.partition_point(|line| line.at <= byte);
        Ok(after.saturating_sub(1))
    }

    fn line_number(&'a self, (): (), index: usize) -> Result<usize, Error> {
        Ok(self.line(index)?.number as usize)
    }

    fn column_number(&'a self, (): (), index: usize, byte: usize) -> Result<usize, Error> {
        let line = self.line(index)?;
        let from = line.at + line.mark;
        let before = self.text.get(from..byte.max(from)).unwrap_or_default();
        Ok(line.columns_cut + before.chars().count() + 1)
    }

    fn line_range(&'a self, (): (), index: usize) -> Result<Range<usize>, Error> {
        let start = self.line(index)?.at;
        let end = self.lines.get(index + 1).map_or(self.text.len(), |l| l.at);
        Ok(start..end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use codespan_reporting::diagnostic::{Diagnostic, Label};
    use codespan_reporting::term;
    use proptest::prelude::*;

    proptest! {
        /// For any text and any spans: printed lines are short, printing succeeds, and line and
        /// column are correct.
        #[test]
        fn excerpts_are_narrow_and_tell_the_place(
            text in "([a-zé😀 ]{0,9}|[a-zé]{400,900}|\n|\r\n){0,30}",
            places in prop::collection::vec((any::<prop::sample::Index>(), 0_u32..2000), 1..4),
        ) {
            let index = LineIndex::new(&text);
            let spans: Vec<Span> = places
                .iter()
                .map(|(at, length)| {
                    let start = u32::try_from(at.index(text.len() + 1)).unwrap();
                    Span::new(start, start + length)
                })
                .collect();
            let excerpt = Excerpt::from_source("x.eml", &index, spans[0], spans[1..].iter().copied());
            for line in excerpt.text.lines() {
                prop_assert!(line.chars().count() <= COLUMNS);
            }
            let labels = spans[1..].iter().map(|s| Label::secondary((), excerpt.range(*s)).with_message("here"));
            let range = excerpt.range(spans[0]);
            let shown = Diagnostic::error()
                .with_message("what")
                .with_label(Label::primary((), range.clone()))
                .with_labels(labels.collect());
            let printed = term::emit_into_string(&term::Config::default(), &excerpt, &shown).unwrap();
            // A caret for each column, and some for the margin.
            for line in printed.lines() {
                prop_assert!(line.chars().count() <= 2 * COLUMNS + 40, "{line}");
            }
            let told = excerpt.location((), range.start).unwrap();
            let meant = index.position(spans[0].start);
            prop_assert_eq!(told.line_number, meant.line as usize);
            // A position at the end of a line counts as the end of its shown part.
            let line = index.line_text(meant.line).chars().count();
            prop_assert_eq!(told.column_number, (meant.column as usize).min(line + 1));
        }
    }
}

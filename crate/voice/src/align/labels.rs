//! Files with one label per line: ESPS xlabel, MARY's realised durations, and those of HTK.

use super::draft::{Draft, Kind, Point, is_silence};
use super::text::{TextError, clip, fields, lines, number};

/// Seconds in HTK's unit of time, 100 ns (The HTK Book, section 6.2).
const HTK_UNITS_A_SEC: f64 = 1e7;

/// Reads xlabel: header lines to `#`, then lines of end in seconds, colour and name, then fields
/// after a separator.
pub(super) fn xlabel(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = Kind::Unsure;
    by_end(text, draft)
}

/// Reads MARY's labels: like xlabel without a header, and always phones.
pub(super) fn mary(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    by_end(text, draft)
}

fn by_end(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let (mut ends, mut separator, mut in_header) = (Vec::new(), ';', true);
    for (at, line) in lines(text) {
        let mut fields = fields(at, line);
        let Some((first_at, first)) = fields.next() else {
            continue;
        };
        if in_header {
            in_header = first != "#";
            if first == "separator" {
                let named = fields.next().and_then(|(_, s)| s.chars().next());
                separator = named.unwrap_or(separator);
            }
            continue;
        }
        if first == "#" {
            continue;
        }
        let secs = number(first_at, first)?;
        let label = match (fields.next(), fields.next()) {
            (Some(_), Some((label_at, _))) => {
                let rest = &line[label_at - at..];
                rest.split(separator).next().unwrap_or_default().trim()
            }
            (Some(_), None) => "",
            (None, _) => {
                return Err(TextError::new(
                    at + line.len(),
                    "a colour and a name should follow",
                ));
            }
        };
        draft.count(at)?;
        let label = label.to_owned();
        ends.push(Point { secs, label, at });
    }
    if in_header {
        return Err(TextError::new(text.len(), "no line \"#\" ends the header"));
    }
    draft.segments_by_end(ends)
}

/// Reads HTK labels: begin and end in units of 100 ns and a name, optionally a score and a word
/// that begins there. Of a master label file, only the first entry is read.
pub(super) fn htk(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let (mut entries, mut is_master, mut ended) = (0_usize, false, false);
    let mut words: Vec<(f64, String, usize)> = Vec::new();
    let mut open: Option<Open> = None;
    for (at, line) in lines(text) {
        let trimmed = line.trim();
        if trimmed == "#!MLF!#" {
            is_master = true;
            continue;
        }
        if is_master && trimmed.starts_with('"') {
            entries += 1;
            ended = entries > 1;
            if entries == 2 {
                draft.warn(at, "more than one file's labels; the first are read");
            }
            continue;
        }
        if trimmed.is_empty() || ended {
            continue;
        }
        if trimmed == "." && is_master {
            ended = true;
            continue;
        }
        // Alternatives of a lattice of transcriptions follow.
        if trimmed == "///" {
            draft.warn(at, "alternative transcriptions; the first is read");
            ended = true;
            continue;
        }
        let mut fields = fields(at, line);
        let mut field = |what: &str| {
            let missing = || TextError::new(at + line.len(), format!("{what} should follow"));
            fields.next().ok_or_else(missing)
        };
        let (start_at, start) = field("a begin")?;
        let start = number(start_at, start)? / HTK_UNITS_A_SEC;
        let (end_at, end) = field("an end")?;
        let end = number(end_at, end)? / HTK_UNITS_A_SEC;
        let (name_at, name) = field("a name")?;
        let phone = current(name);
        if phone.is_empty() {
            return Err(TextError::new(
                name_at,
                format!("no phone in {:?}", clip(name)),
            ));
        }
        draft.segment(start, end, phone, at)?;
        if let Some((word_at, word)) = fields.last()
            && word.parse::<f64>().is_err()
        {
            words.push((start, word.to_owned(), word_at));
        }
        if let Some(context) = Context::parse(name) {
            if open
                .as_ref()
                .is_some_and(|o| context.is_first || start < o.start)
            {
                close(&mut open, draft);
            }
            let syllable = open.get_or_insert(Open {
                start,
                end,
                stress: context.stress,
            });
            syllable.end = syllable.end.max(end);
        } else {
            close(&mut open, draft);
        }
    }
    close(&mut open, draft);
    words.sort_by(|a, b| a.0.total_cmp(&b.0));
    word_ends(&words, draft)
}

/// A syllable that may go on.
struct Open {
    start: f64,
    end: f64,
    stress: u8,
}

fn close(open: &mut Option<Open>, draft: &mut Draft) {
    if let Some(Open { start, end, stress }) = open.take() {
        draft.syllables.push((start, end, stress));
    }
}

/// Computes word ends: a word lasts until the next word or a silence begins.
fn word_ends(words: &[(f64, String, usize)], draft: &mut Draft) -> Result<(), TextError> {
    let mut segments = draft.segments.clone();
    segments.retain(|s| s.end > s.start);
    segments.sort_by(|a, b| a.start.total_cmp(&b.start));
    for (i, (start, word, at)) in words.iter().enumerate() {
        let next = words.get(i + 1).map_or(f64::MAX, |w| w.0);
        let from = segments.partition_point(|s| s.start < *start);
        let own = segments[from..]
            .iter()
            .enumerate()
            .take_while(|(k, s)| *k == 0 || s.start < next && !is_silence(&s.label));
        // Sentence marks appear as words of silence.
        let silent = segments.get(from).is_none_or(|s| is_silence(&s.label));
        if let Some((_, last)) = own.last().filter(|_| !silent) {
            draft.word(*start, last.end, word, *at)?;
        }
    }
    Ok(())
}

/// Returns the phone in a label: the part between `-` and `+` if there is context (`a^b-c+d=e@…`,
/// or HTK's `b-c+d`), otherwise the whole label.
fn current(name: &str) -> &str {
    let before = name.split("/A:").next().unwrap_or(name);
    match (before.find('-'), before.rfind('+')) {
        (Some(minus), Some(plus)) if minus + 1 < plus => {
            let inner = &before[minus + 1..plus];
            // A name after the first `+` is of the context, too: a^b-c+d=e.
            inner.split('+').next().unwrap_or(inner)
        }
        _ => before,
    }
}

/// Syllable context from a full-context HTS label (English questions: `@p6_p7/A:`, position in the
/// syllable from its start; `/B:b1-`, stress).
struct Context {
    is_first: bool,
    stress: u8,
}

impl Context {
    fn parse(name: &str) -> Option<Self> {
        let position = name.split("/A:").next()?.rsplit_once('@')?.1;
        let position = position.split('_').next()?;
        let stress = name.split_once("/B:")?.1.split('-').next()?;
        // Silences have `x` in both.
        position.parse::<u32>().ok()?;
        Some(Self {
            is_first: position == "1",
            stress: stress.parse().ok().filter(|s| *s <= 2)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_phone_of_a_name_in_context() {
        assert_eq!(current("sil^h-@+l=@U@1_2/A:0_0_0/B:1-0-2@1-1"), "@");
        assert_eq!(current("x^x-pau+hh=ax@x_x/A:0_0_0"), "pau");
        assert_eq!(current("t-iy+ch"), "iy");
        assert_eq!(current("aa"), "aa");
        let context = Context::parse("h^@-l+@U=_@2_2/A:0_0_1/B:1-0-2@2-1&1").unwrap();
        assert!(
            !context.is_first && context.stress == 1,
            "the phone is stressed and not the first"
        );
        assert!(
            Context::parse("x^x-pau+hh=ax@x_x/A:0_0_0/B:x-x-x@x-x").is_none(),
            "the context of a silence has no syllable"
        );
    }
}

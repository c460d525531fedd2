//! WebVTT (W3C, "WebVTT: The Web Video Text Tracks Format") whose cues are single words, or contain
//! times, as in karaoke and automatic captions; and SubRip (SRT), which is the same without a
//! signature and with a comma before the milliseconds.
//!
//! Words between two times share the span by their number of letters; so do words of a cue without
//! times, with a warning. Automatic rolling captions repeat the previous line: in a file with inner
//! times, a line without times that repeats the last is omitted.

use super::Units;
use super::draft::{Draft, Kind};
use super::text::{TextError, clip, lines};

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = Kind::Units(Units::None);
    let mut lines = lines(text);
    let signed = lines.next().is_some_and(|(_, line)| {
        let rest = line.strip_prefix("WEBVTT");
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
    });
    if !signed {
        return Err(TextError::new(0, "no \"WEBVTT\" at the begin"));
    }
    cues(text, lines, '.', draft)
}

/// Reads SubRip.
pub(super) fn subrip(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = Kind::Units(Units::None);
    cues(text, lines(text), ',', draft)?;
    if draft.words.is_empty() {
        return Err(TextError::new(0, "no cue with words"));
    }
    Ok(())
}

/// Reads the cues among the lines of a text; `mark`, or a full stop, may precede the milliseconds.
fn cues<'a>(
    text: &str,
    lines: impl Iterator<Item = (usize, &'a str)>,
    mark: char,
    draft: &mut Draft,
) -> Result<(), TextError> {
    let rolls = text
        .match_indices('<')
        .any(|(i, _)| inner_time(&text[i..]).is_some());
    let mut cue: Option<Cue> = None;
    let mut last_line = String::new();
    for (at, line) in lines {
        if line.is_empty() {
            finish(cue.take(), draft)?;
            continue;
        }
        if let Some(arrow) = line.find("-->") {
            finish(cue.take(), draft)?;
            cue = Some(Cue::begin(at, line, arrow, mark)?);
            continue;
        }
        let Some(cue) = &mut cue else {
            // Names of cues, comments, styles and the rest of the header.
            continue;
        };
        let has_time = line
            .match_indices('<')
            .any(|(i, _)| inner_time(&line[i..]).is_some());
        let plain = plain(line);
        if rolls && !has_time && plain == last_line {
            continue;
        }
        cue.add(at, line)?;
        if !plain.is_empty() {
            last_line = plain;
        }
    }
    finish(cue, draft)
}

/// Text span with its start time; it ends at the start of the next.
struct TextSpan {
    start: f64,
    text: String,
    at: usize,
}

struct Cue {
    at: usize,
    end: f64,
    pieces: Vec<TextSpan>,
}

impl Cue {
    fn begin(at: usize, line: &str, arrow: usize, mark: char) -> Result<Self, TextError> {
        let read = |offset: usize, written: &str| {
            let bad = || TextError::new(at + offset, format!("{:?} is not a time", clip(written)));
            time(written, mark).ok_or_else(bad)
        };
        let start = read(0, line[..arrow].trim())?;
        let after = &line[arrow + 3..];
        let blank = after.len() - after.trim_start().len();
        let written = after.split_whitespace().next().unwrap_or_default();
        let end = read(arrow + 3 + blank, written)?;
        let mut cue = Self {
            at,
            end,
            pieces: Vec::new(),
        };
        cue.piece(start, at);
        Ok(cue)
    }

    fn piece(&mut self, start: f64, at: usize) {
        let text = String::new();
        self.pieces.push(TextSpan { start, text, at });
    }

    fn push(&mut self, text: &str) {
        if let Some(piece) = self.pieces.last_mut() {
            piece.text.push_str(text);
        }
    }

    /// Adds a line of the cue's text. Tags do not separate words; line ends do.
    fn add(&mut self, at: usize, line: &str) -> Result<(), TextError> {
        let mut rest = line;
        while let Some(tag) = rest.find('<') {
            let here = at + line.len() - rest.len() + tag;
            self.push(&rest[..tag]);
            rest = &rest[tag..];
            let Some(end) = rest.find('>') else {
                return Err(TextError::new(here, "a tag that does not end"));
            };
            if let Some(start) = inner_time(rest) {
                self.piece(start, here);
            }
            rest = &rest[end + 1..];
        }
        self.push(rest);
        self.push(" ");
        Ok(())
    }
}

fn finish(cue: Option<Cue>, draft: &mut Draft) -> Result<(), TextError> {
    let Some(cue) = cue else {
        return Ok(());
    };
    let alone = cue.pieces.len() == 1;
    for (i, piece) in cue.pieces.iter().enumerate() {
        let end = cue.pieces.get(i + 1).map_or(cue.end, |next| next.start);
        let text = unescape(&piece.text);
        let count = draft.phrase(piece.start, end, &text, piece.at)?;
        if alone && count > 1 {
            draft.warn(
                cue.at,
                format!("{count} words without times; shared out by letters"),
            );
        }
    }
    Ok(())
}

/// Parses a time in angle brackets at the beginning of a text.
fn inner_time(text: &str) -> Option<f64> {
    // The longest time in sense is 99:59:59.999.
    let end = text.bytes().take(20).position(|b| b == b'>')?;
    time(text.get(1..end)?, '.')
}

/// Parses `[hours:]minutes:seconds.milliseconds`, with a point or `mark` before the milliseconds;
/// returns seconds.
fn time(written: &str, mark: char) -> Option<f64> {
    let digits = |part: &str, least: usize| {
        let fine =
            part.len() >= least && part.len() <= 6 && part.bytes().all(|b| b.is_ascii_digit());
        fine.then(|| part.parse::<f64>().ok()).flatten()
    };
    let (whole, thousandths) = written.split_once(['.', mark])?;
    let mut parts = whole.rsplit(':');
    let secs = digits(parts.next()?, 2)?;
    let minutes = digits(parts.next()?, 2)?;
    let hours = parts.next().map_or(Some(0.0), |h| digits(h, 1))?;
    let millis = digits(thousandths, 3).filter(|_| thousandths.len() == 3)?;
    let fine = secs < 60.0 && minutes < 60.0 && parts.next().is_none();
    fine.then_some(hours * 3600.0 + minutes * 60.0 + secs + millis / 1000.0)
}

/// Returns a line without its tags.
fn plain(line: &str) -> String {
    let (mut plain, mut in_tag) = (String::new(), false);
    for c in line.chars() {
        match c {
            '<' => in_tag = true,
            '>' => in_tag = false,
            _ if !in_tag => plain.push(c),
            _ => {}
        }
    }
    plain.trim().to_owned()
}

/// Returns the text with the escapes of WebVTT resolved.
fn unescape(text: &str) -> String {
    const ESCAPES: [(&str, &str); 5] = [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&nbsp;", " "),
        ("&lrm;", ""),
        ("&rlm;", ""),
    ];
    let mut text = text.to_owned();
    for (escape, meant) in ESCAPES {
        text = text.replace(escape, meant);
    }
    text.replace("&amp;", "&")
}

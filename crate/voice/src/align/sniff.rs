//! Detection of the format of bytes by their content, and otherwise by their name.

use super::Format;
use super::text::{decode, fields, lines};
use super::viseme::rhubarb_viseme;

/// Number of bytes examined.
const LOOK: usize = 1 << 16;

/// Number of lines of a table examined.
const MAX_LINES: usize = 50;

/// Detects the format of a file by its content and, if that is ambiguous, by its name (of which
/// only the extension matters). Returns `None` if it is not a format that [`super::read`] supports.
#[must_use]
pub fn detect(name: &str, bytes: &[u8]) -> Option<Format> {
    // An even number of bytes keeps UTF-16 intact except for a pair at the end.
    let mut head = &bytes[..bytes.len().min(LOOK)];
    let text = loop {
        match decode(head) {
            Ok(text) => break text,
            Err(_) if head.len() + 4 > LOOK && !head.is_empty() => head = &head[..head.len() - 1],
            Err(_) => return None,
        }
    };
    let name = name.to_ascii_lowercase();
    let begin = text.trim_start();
    let first_line = lines(begin).next().map_or("", |(_, line)| line);
    if begin.starts_with("WEBVTT") {
        return Some(Format::WebVtt);
    }
    if first_line.trim_end() == "EST_File utterance" {
        return Some(Format::FestivalUtterance);
    }
    if begin.starts_with("#!MLF!#") {
        return Some(Format::Htk);
    }
    if first_line.contains("\"ooTextFile") {
        return Some(Format::TextGrid);
    }
    if begin.starts_with('<') {
        let roots = [
            ("<rhubarbResult", Format::RhubarbXml),
            ("<ANNOTATION_DOCUMENT", Format::Eaf),
            ("maryxml", Format::MaryXml),
        ];
        let found = roots.iter().find(|(root, _)| begin.contains(root));
        return found.map(|(_, format)| *format);
    }
    if begin.starts_with(['{', '[']) {
        return json(begin);
    }
    let timed = |line: &str| line.contains("-->");
    let mut cue = lines(begin).map(|(_, line)| line.trim());
    let number = |line: &str| !line.is_empty() && line.bytes().all(|b| b.is_ascii_digit());
    if timed(first_line) || number(first_line.trim()) && cue.nth(1).is_some_and(timed) {
        return Some(Format::SubRip);
    }
    table(&name, &text)
}

/// Formats of JSON.
fn json(begin: &str) -> Option<Format> {
    let has = |keys: &[&str]| keys.iter().any(|key| begin.contains(&format!("\"{key}\"")));
    if has(&["mouthCues"]) {
        return Some(Format::RhubarbJson);
    }
    if has(&["vtimes", "wtimes", "visemes"]) {
        return Some(Format::TalkingHead);
    }
    let words = [
        "word",
        "words",
        "segments",
        "transcription",
        "items",
        "text",
    ];
    has(&words).then_some(Format::WordTimes)
}

/// Formats of lines of fields.
fn table(name: &str, text: &str) -> Option<Format> {
    let ends_in = |end: &str| name.ends_with(end);
    // The last of a long text may be cut.
    let whole = lines(text)
        .take(MAX_LINES + 1)
        .map(|(at, line)| fields(at, line));
    let mut rows: Vec<Vec<&str>> = whole
        .map(|line| line.map(|(_, field)| field).collect())
        .collect();
    rows.retain(|row| !row.is_empty());
    if rows.len() > MAX_LINES || text.len() + 4 > LOOK {
        rows.pop();
    }
    if let Some(hash) = rows.iter().position(|row| row == &["#"]) {
        let (header, data) = (&rows[..hash], &rows[hash + 1..]);
        let timed = data.iter().all(|row| row.len() >= 2 && is_number(row[0]));
        let has_header = !header.is_empty() && !header.iter().any(|row| is_number(row[0]));
        if timed && (header.is_empty() || has_header && !data.is_empty()) {
            let coloured = !data.is_empty() && data.iter().all(|row| row[1] == "125");
            let mary = ends_in("durations") || header.is_empty() && coloured;
            return Some(if mary {
                Format::MaryDurations
            } else {
                Format::XLabel
            });
        }
    }
    let all = |test: fn(&[&str]) -> bool| !rows.is_empty() && rows.iter().all(|row| test(row));
    if all(|row| row.len() >= 3 && is_whole(row[0]) && is_whole(row[1])) {
        return Some(Format::Htk);
    }
    if all(|row| row.len() == 2 && is_number(row[0]) && rhubarb_viseme(row[1]).is_some()) {
        return Some(Format::RhubarbTsv);
    }
    let spoken = |row: &[&str]| row[0].starts_with(';') || row.len() >= 2 && is_number(row[1]);
    let told = rows.iter().any(|row| !row[0].starts_with(';'));
    if told && rows.iter().all(|row| spoken(row) || row == &["#"]) {
        return Some(Format::Mbrola);
    }
    // A broken file should get its message from the reader that its name calls for.
    let names = [
        (".textgrid", Format::TextGrid),
        (".pho", Format::Mbrola),
        (".utt", Format::FestivalUtterance),
        (".vtt", Format::WebVtt),
        (".srt", Format::SubRip),
        (".eaf", Format::Eaf),
        (".mlf", Format::Htk),
        (".segs", Format::XLabel),
        ("realised_durations", Format::MaryDurations),
        (".maryxml", Format::MaryXml),
    ];
    names.iter().find(|(end, _)| ends_in(end)).map(|(_, f)| *f)
}

fn is_number(field: &str) -> bool {
    field.parse::<f64>().is_ok()
}

fn is_whole(field: &str) -> bool {
    field.parse::<i64>().is_ok()
}

//! Nearest known names, for hints.

use crate::work::step;

/// The most names that a hint is chosen from, which bounds its cost.
pub(crate) const MAX_HINTS: usize = 256;

/// Names longer than this are never near anything; it bounds the work.
const MAX_NAME_CHARS: usize = 48;

/// Returns the candidate nearest to `name` by case-insensitive edit distance, if it is near enough
/// to be the name meant: one edit per three characters.
#[must_use]
pub fn nearest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    if name.len() > MAX_NAME_CHARS {
        return None;
    }
    candidates
        .into_iter()
        .map(|c| (distance(name, c), c))
        .filter(|&(d, c)| {
            let longer = name.len().max(c.len());
            d < longer && d <= (longer / 3).max(1)
        })
        // Among names that differ only in case, the one written as `name` is selected.
        .min_by_key(|&(d, c)| (d, capitals(name).abs_diff(capitals(c))))
        .map(|(_, c)| c)
}

/// Returns the candidates sorted by edit distance to `name`, nearest first; unsorted if the name is
/// absurdly long.
pub(crate) fn by_distance<'c>(
    name: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Vec<&'c str> {
    let mut all: Vec<&str> = candidates.into_iter().collect();
    if name.len() <= MAX_NAME_CHARS {
        all.sort_by_cached_key(|candidate| distance(name, candidate));
    }
    all
}

fn capitals(name: &str) -> usize {
    name.bytes().filter(u8::is_ascii_uppercase).count()
}

/// Returns the edit distance with neighbouring swaps as one edit (optimal string alignment), over
/// lower-case bytes.
fn distance(a: &str, b: &str) -> usize {
    step(a.len() * b.len());
    let a = a.to_ascii_lowercase().into_bytes();
    let b = b.to_ascii_lowercase().into_bytes();
    let mut before = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let changed = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (last[j] + 1).min(row[j - 1] + 1).min(last[j - 1] + changed);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

/// Returns a name in backticks for a message: shortened if it is very long, and with control
/// characters made visible, so a file cannot control a terminal.
#[must_use]
pub fn quoted(name: &str) -> String {
    let (shown, more) = match name.char_indices().nth(40) {
        Some((cut, _)) => (&name[..cut], "…"),
        None => (name, ""),
    };
    let mut quoted = String::from("`");
    for c in shown.chars() {
        // The standard library's character names would add tables of all characters.
        if c.is_control() {
            quoted.extend(c.escape_default());
        } else {
            quoted.push(c);
        }
    }
    quoted + more + "`"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_near_and_other_words_are_not() {
        let names = ["gesture-key", "hand-shapes", "event"];
        assert_eq!(nearest("gesture-kye", names), Some("gesture-key"));
        assert_eq!(nearest("handshapes", names), Some("hand-shapes"));
        assert_eq!(nearest("smile", names), None);
        assert_eq!(nearest("Jyo", ["joy", "Joy"]), Some("Joy"));
        assert_eq!(nearest("jyo", ["Joy", "joy"]), Some("joy"));
        assert_eq!(nearest(";", ["?", "!"]), None);
        assert_eq!(nearest(&"x".repeat(10_000), names), None);
    }

    #[test]
    fn long_and_hostile_names_are_made_harmless() {
        assert_eq!(quoted("a\u{1b}[2J"), r"`a\u{1b}[2J`");
        assert_eq!(quoted("tm"), "`tm`");
        assert_eq!(quoted(&"é".repeat(99)), format!("`{}…`", "é".repeat(40)));
    }
}

//! Sanitising of untrusted text for a terminal: stories, file names and messages must not move the
//! cursor, change colours or reverse the direction of adjacent text.

use std::borrow::Cow;

/// Returns true if a character affects a terminal instead of being shown: control characters, and
/// directional formatting characters (Unicode Standard Annex 9), which change the reading order of
/// a line. Line feeds and tabs are layout.
fn acts(c: char) -> bool {
    let is_layout = matches!(c, '\n' | '\t');
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    (c.is_control() && !is_layout) || turns
}

/// Returns the replacement for such a character: the symbol of ASCII's control characters, else the
/// replacement character. One column wide, as expected for a marked line.
fn printable_char(c: char) -> char {
    match u32::from(c) {
        code @ 0..0x20 => char::from_u32(0x2400 + code),
        0x7f => Some('\u{2421}'),
        _ => None,
    }
    .unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// Replaces the characters of a text that a terminal would interpret.
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.contains(acts) {
        return text.into();
    }
    let clean = text
        .chars()
        .map(|c| if acts(c) { printable_char(c) } else { c });
    clean.collect::<String>().into()
}

/// Escapes the same characters in JSON: they occur only inside strings, where an escape is
/// equivalent.
#[must_use]
pub fn printable_json(text: &str) -> Cow<'_, str> {
    // JSON escapes all ASCII control characters except DEL; the remaining ones have at most four
    // digits.
    let left = |c: char| acts(c) && c != '\r';
    if !text.contains(left) {
        return text.into();
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if left(c) {
            out.push_str(&format!("\\u{:04x}", u32::from(c)));
        } else {
            out.push(c);
        }
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn what_acts_is_shown() {
        for (given, expected) in [
            ("plain \u{e9}\n\ttext", "plain \u{e9}\n\ttext"),
            ("\u{1b}[31mred", "\u{241b}[31mred"),
            ("a\rb\u{7f}", "a\u{240d}b\u{2421}"),
            ("\u{9b}2J \u{202e}x", "\u{fffd}2J \u{fffd}x"),
        ] {
            assert_eq!(printable(given), expected);
        }
        assert_eq!(printable_json("\"a\u{9b}\u{7f}\""), "\"a\\u009b\\u007f\"");
    }

    proptest! {
        #[test]
        fn nothing_is_left_that_acts(text in any::<String>()) {
            let shown = printable(&text);
            prop_assert!(!shown.contains(acts));
            prop_assert_eq!(shown.chars().count(), text.chars().count());
        }
    }
}

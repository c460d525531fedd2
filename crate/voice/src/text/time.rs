//! Times of day: 14:30, 14:30:15, 2:05pm, 14h30.

/// Half of a twelve-hour day: before or after noon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Half {
    Morning,
    Afternoon,
}

/// Time of day as written in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Clock {
    /// 0..=24.
    pub(super) hour: u64,
    /// 0..=59.
    pub(super) minute: Option<u64>,
    /// 0..=60, a leap second included.
    pub(super) second: Option<u64>,
    /// Written "am" or "pm".
    pub(super) half: Option<Half>,
}

/// Parses "am", "p.m" and similar, without a final dot.
pub(super) fn half(text: &str) -> Option<Half> {
    match text.to_ascii_lowercase().as_str() {
        "am" | "a.m" | "a.m." => Some(Half::Morning),
        "pm" | "p.m" | "p.m." => Some(Half::Afternoon),
        _ => None,
    }
}

fn part(text: &str, widths: std::ops::RangeInclusive<usize>, most: u64) -> Option<u64> {
    if !widths.contains(&text.len()) || !text.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    text.parse().ok().filter(|&n| n <= most)
}

/// Parses `text` as a time with parts separated by `sign`; an hour alone only with its half of the
/// day. `sign` is `:`; other signs where the context allows them.
pub(super) fn parse(text: &str, sign: char) -> Option<Clock> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '.');
    let suffix = text.get(digits.len()..).unwrap_or_default();
    let half = match suffix {
        "" => None,
        _ => Some(half(suffix)?),
    };
    let mut parts = digits.split(sign);
    let hour = part(parts.next()?, 1..=2, if half.is_some() { 12 } else { 24 })?;
    let minute = match parts.next() {
        Some(text) => Some(part(text, 2..=2, 59)?),
        None => None,
    };
    let second = match parts.next() {
        Some(text) => Some(part(text, 2..=2, 60)?),
        None => None,
    };
    let clear = minute.is_some() || half.is_some();
    (clear && parts.next().is_none()).then_some(Clock {
        hour,
        minute,
        second,
        half,
    })
}

/// Parses a time in Portuguese notation: "14h30" or "14h".
pub(super) fn parse_with_h(text: &str) -> Option<Clock> {
    let (hour, minute) = text.split_once('h')?;
    let hour = part(hour, 1..=2, 24)?;
    let minute = match minute.trim_end_matches("min") {
        "" => None,
        text => Some(part(text, 2..=2, 59)?),
    };
    Some(Clock {
        hour,
        minute,
        second: None,
        half: None,
    })
}

//! Dates written with digits, in the orders of SABLE's `MODETYPE`.

use super::Order;
use super::language::Language;

pub(super) use raconteur_base::text::months::{MONTHS, is_month};

/// Date in a text, of which parts may be unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Date {
    /// 1..=31.
    pub(super) day: Option<u32>,
    /// 1..=12.
    pub(super) month: Option<u32>,
    /// Year as written: two digits stay two.
    pub(super) year: Option<u64>,
    /// True if the day was written before the month; English speech follows that order.
    pub(super) day_first: bool,
}

/// Returns the default order of three date numbers in a language.
pub(super) fn usual_order(language: Language, month_first: bool) -> Order {
    match language {
        Language::English if month_first => Order::Mdy,
        _ => Order::Dmy,
    }
}

/// Parses `text` as a date. A given order is tried first; content that does not fit it (a month of
/// 25) is tried in the others. Without an order only an unambiguous date is accepted: three
/// numbers, or a year with a month.
pub(super) fn parse(
    text: &str,
    order: Option<Order>,
    language: Language,
    month_first: bool,
) -> Option<Date> {
    let sign = text.chars().find(|c| !c.is_ascii_digit());
    let parts: Vec<&str> = match sign {
        Some(sign @ ('/' | '.' | '-')) => text.split(sign).collect(),
        Some(_) => return None,
        None => compact(text, order?)?,
    };
    let digits =
        |part: &&str| (1..=4).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_digit());
    if !parts.iter().all(digits) {
        return None;
    }
    let usual = usual_order(language, month_first);
    let other = if usual == Order::Mdy {
        Order::Dmy
    } else {
        Order::Mdy
    };
    let candidates: &[Order] = match parts.len() {
        3 => &[Order::Ymd, usual, other],
        2 if order.is_some() => &[Order::My, Order::Ym, Order::Md],
        2 => &[Order::My, Order::Ym],
        _ => return None,
    };
    order
        .iter()
        .chain(candidates)
        .find_map(|&order| arrange(&parts, order, language))
}

/// Digits without signs, cut by the order's usual widths: 19981225, 251298.
fn compact(text: &str, order: Order) -> Option<Vec<&str>> {
    let year = match (text.len(), order) {
        (8, Order::Dmy | Order::Mdy | Order::Ymd) | (6, Order::Ym | Order::My) => 4,
        (6, _) | (4, Order::Ym | Order::My | Order::Md) => 2,
        _ => return None,
    };
    let cuts = match order {
        Order::Dmy | Order::Mdy => vec![2, 4],
        Order::Ymd => vec![year, year + 2],
        Order::Ym => vec![year],
        Order::My | Order::Md => vec![2],
    };
    let mut parts = Vec::new();
    let mut from = 0;
    for cut in cuts {
        parts.push(text.get(from..cut)?);
        from = cut;
    }
    parts.push(text.get(from..)?);
    Some(parts)
}

fn arrange(parts: &[&str], order: Order, language: Language) -> Option<Date> {
    let (year, month, day) = match (order, parts) {
        (Order::Dmy, [d, m, y]) | (Order::Mdy, [m, d, y]) => (Some(y), m, Some(d)),
        (Order::Ymd, [y, m, d]) => (Some(y), m, Some(d)),
        (Order::Ym, [y, m]) | (Order::My, [m, y]) => (Some(y), m, None),
        (Order::Md, [m, d]) => (None, m, Some(d)),
        _ => return None,
    };
    let month: u32 = month.parse().ok().filter(|m| (1..=12).contains(m))?;
    let day = match day {
        Some(text) if text.len() <= 2 => Some(text.parse().ok().filter(|d| (1..=31).contains(d))?),
        Some(_) => return None,
        None => None,
    };
    let year = match year {
        // A two-digit year with only a month would be a fraction or a score.
        Some(text) if text.len() == 4 || text.len() == 2 && day.is_some() => {
            Some(text.parse().ok()?)
        }
        Some(_) => return None,
        None => None,
    };
    let day_first = order == Order::Dmy || language != Language::English;
    Some(Date {
        day,
        month: Some(month),
        year,
        day_first,
    })
}

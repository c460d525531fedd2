//! Decimal numbers, read and written without the standard library's tables.
//!
//! `str::parse::<f64>` adds 10 KB of incompressible powers of ten to every page. For up to 19
//! digits and 37 decimal places in either direction, the result here is the same to the bit; beyond
//! that, the last digits may differ. It accepts the same texts.

/// Maximum number of arbitrary decimal digits that fit in 64 bits.
const MAX_DIGITS: u32 = 19;
/// 10 to this power still leaves a bit of 128 for the doubling below.
const MAX_POWER: u32 = 37;
/// Powers of ten that an `f64` represents exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];
/// Exponent limit: numbers with more places are zero or infinite.
const MAX_PLACES: i32 = 400;

/// Parses a decimal of at most 15 digits and a point, without sign or exponent, as nearly all
/// numbers are; otherwise `None`. Digits and power are exact floats, so the division rounds once
/// (Clinger 1990).
pub fn parse_short(text: &[u8]) -> Option<f64> {
    if text.len() > 15 {
        return None;
    }
    let (mut whole, mut digits, mut places, mut pointed) = (0_u64, 0_usize, 0_usize, false);
    for &byte in text {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            whole = whole * 10 + u64::from(digit);
            digits += 1;
            places += usize::from(pointed);
        } else if byte == b'.' && !pointed {
            pointed = true;
        } else {
            return None;
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "15 digits fit")]
    (digits > 0).then(|| whole as f64 / EXACT_POWERS[places])
}

/// Parses `text` as a number; `None` if it is not one. Too large numbers become infinite.
pub fn parse(text: &str) -> Option<f64> {
    let (sign, rest) = match text.as_bytes() {
        [b'-', rest @ ..] => (-1.0, rest),
        [b'+', rest @ ..] => (1.0, rest),
        rest => (1.0, rest),
    };
    if let Some(value) = parse_short(rest) {
        return Some(sign * value);
    }
    if rest.first().is_some_and(u8::is_ascii_alphabetic) {
        return word(rest).map(|value| sign * value);
    }
    let mut exponent = 0_i32;
    let mut digits = rest;
    if let Some(at) = rest.iter().position(|b| matches!(b, b'e' | b'E')) {
        digits = &rest[..at];
        exponent = integer(&rest[at + 1..])?;
    }
    let (mut whole, mut taken, mut any, mut pointed) = (0_u64, 0, false, false);
    for &byte in digits {
        if byte == b'.' && !pointed {
            pointed = true;
            continue;
        }
        if !byte.is_ascii_digit() {
            return None;
        }
        any = true;
        if taken < MAX_DIGITS {
            whole = whole * 10 + u64::from(byte - b'0');
            // Leading zeros are not significant digits.
            taken += u32::from(whole > 0);
            exponent = exponent.saturating_sub(i32::from(pointed));
        } else {
            exponent = exponent.saturating_add(i32::from(!pointed));
        }
    }
    any.then(|| sign * scaled(whole, exponent.clamp(-MAX_PLACES, MAX_PLACES)))
}

/// Parses a value written as a word: `inf`, `infinity` or `nan` in any case; otherwise `None`.
fn word(text: &[u8]) -> Option<f64> {
    let is = |name: &str| text.eq_ignore_ascii_case(name.as_bytes());
    if is("inf") || is("infinity") {
        return Some(f64::INFINITY);
    }
    is("nan").then_some(f64::NAN)
}

/// Parses an exponent; one beyond the range of floats is clamped to an equivalent value.
fn integer(text: &[u8]) -> Option<i32> {
    let (sign, digits) = match text {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        rest => (1, rest),
    };
    let mut value = 0_i32;
    for &byte in digits {
        if !byte.is_ascii_digit() {
            return None;
        }
        value = value
            .saturating_mul(10)
            .saturating_add(i32::from(byte - b'0'));
    }
    (!digits.is_empty()).then_some(sign * value)
}

/// `whole · 10^exponent`, rounded once where the power fits.
#[expect(
    clippy::cast_precision_loss,
    reason = "this is the rounding to the nearest that is wanted"
)]
fn scaled(whole: u64, exponent: i32) -> f64 {
    if whole == 0 {
        return 0.0;
    }
    let power = exponent.unsigned_abs();
    // As in `parse_short`.
    if whole < 1 << 53
        && let Some(ten) = EXACT_POWERS.get(power as usize)
    {
        let whole = whole as f64;
        return if exponent < 0 {
            whole / ten
        } else {
            whole * ten
        };
    }
    let ten = 10_u128.pow(power.min(MAX_POWER));
    let mut value = if exponent < 0 {
        // Binary long division until more bits are known than a number stores; the last bit records
        // any remainder.
        let (mut quotient, mut left) = (u128::from(whole) / ten, u128::from(whole) % ten);
        let mut halvings = 1.0_f64;
        while quotient < 1 << 55 {
            left *= 2;
            quotient = quotient * 2 + u128::from(left >= ten);
            left %= ten;
            halvings *= 0.5;
        }
        (quotient | u128::from(left > 0)) as f64 * halvings
    } else if let Some(product) = u128::from(whole).checked_mul(ten) {
        product as f64
    } else {
        whole as f64 * ten as f64
    };
    for _ in MAX_POWER..power {
        value = if exponent < 0 {
            value / 10.0
        } else {
            value * 10.0
        };
    }
    value
}

/// Maximum number of decimal places written.
const MAX_WRITTEN: usize = 19;

/// Formats `value` with a number of decimal places (at most 19), rounded once, halves to even, like
/// `format!("{value:.places$}")` but without the standard library's tables. Numbers beyond ±2⁶³ are
/// written as ±2⁶³.
#[must_use]
pub fn fixed(value: f64, places: usize) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    if !value.is_finite() {
        return if value.is_nan() {
            "NaN".to_owned()
        } else {
            [sign, "inf"].concat()
        };
    }
    let places = places.min(MAX_WRITTEN);
    let bits = value.abs().min(9_223_372_036_854_775_808.0).to_bits();
    let mantissa = bits & ((1 << 52) - 1) | u64::from(bits >> 52 > 0) << 52;
    // The value is the mantissa times two to this power.
    let power = (bits >> 52).max(1) as i32 - 1075;
    let ten = 10_u128.pow(places as u32);
    let (whole, part) = if power >= 0 {
        (mantissa << power, 0)
    } else {
        let shift = power.unsigned_abs();
        let scaled = u128::from(mantissa) * ten;
        let halves = scaled.checked_shr(shift - 1).unwrap_or(0);
        let below = scaled.trailing_zeros() < shift - 1;
        let up = halves & 1 == 1 && (below || halves & 2 == 2);
        let rounded = (halves >> 1) + u128::from(up);
        ((rounded / ten) as u64, (rounded % ten) as u64)
    };
    if places == 0 {
        format!("{sign}{whole}")
    } else {
        format!("{sign}{whole}.{part:0places$}")
    }
}

/// Formats `value` with the fewest places that identify it, like `format!("{value}")`: exactly so
/// from 1e-3 to 1e9. Beyond that range, the even one of two equally near texts is taken, all digits
/// of whole numbers are written, and small ones end at the nineteenth place.
#[must_use]
pub fn shortest(value: f64) -> String {
    for places in 0..MAX_WRITTEN {
        let text = fixed(value, places);
        if parse(&text) == Some(value) {
            return text;
        }
    }
    fixed(value, MAX_WRITTEN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writes_as_the_standard_library_does() {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            state >> 11
        };
        let check = |value: f64| {
            for places in [0, 1, 2, 7, 19] {
                assert_eq!(fixed(value, places), format!("{value:.places$}"), "{value}");
            }
        };
        for _ in 0..20_000 {
            // Quarters and eighths are ties at some decimal place.
            let value = match next() % 4 {
                0 => (next() % 100_000) as f64 / 8.0,
                1 => (next() % 100_000) as f64 / 1000.0,
                2 => next() as f64,
                _ => f64::from_bits(next() << 10),
            };
            if value.abs() < 9e18 {
                check(value);
                check(-value);
            }
            if value == 0.0 || (1e-3..1e9).contains(&value) {
                assert_eq!(shortest(value), value.to_string());
                assert_eq!(shortest(-value), (-value).to_string());
            }
        }
        for value in [
            0.0,
            0.005,
            0.5,
            1.5,
            2.5,
            0.25,
            1e-19,
            5e-20,
            4e-20,
            f64::MIN_POSITIVE,
            5e-324,
        ] {
            check(value);
            check(-value);
        }
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(fixed(value, 2), format!("{value:.2}"));
            assert_eq!(shortest(value), format!("{value}"));
        }
        assert_eq!(fixed(-1e300, 1), "-9223372036854775808.0");
    }

    #[test]
    fn agrees_with_the_standard_library_to_the_bit() {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            state >> 20
        };
        for _ in 0..20_000 {
            let digits = next() % 10_u64.pow((next() % 13) as u32 + 1);
            let text = match next() % 4 {
                0 => format!("{digits}"),
                1 => format!("{digits}.{}", next() % 100_000),
                2 => format!("-.{digits}"),
                _ => format!("{digits}e{}", next() as i64 % 24 - 12),
            };
            let bits = |v: f64| v.to_bits();
            assert_eq!(
                parse(&text).map(bits),
                text.parse().ok().map(bits),
                "{text}"
            );
            // Printed numbers round trip.
            let value = f64::from_bits(next() << 8 | 0x3e00_0000_0000_0000);
            if (1e-18..1e15).contains(&value) {
                assert_eq!(parse(&value.to_string()), Some(value));
            }
        }
    }

    #[test]
    fn takes_and_refuses_the_same_texts() {
        for text in [
            "",
            "+",
            "-",
            ".",
            "-.",
            "1.",
            ".5",
            "1..2",
            "1e",
            "1e+",
            "e5",
            "1e5.5",
            "--1",
            "+-1",
            "1 ",
            " 1",
            "1,5",
            "0x10",
            "٣",
            "inf",
            "-Infinity",
            "NaN",
            "infin",
            "1e999",
            "-1e999",
            "1e-999",
            "1e99999999999",
            "0e99999999999",
            "-0",
            "00.500",
            "1_0",
            "1E3",
            "+7",
        ] {
            let ours = parse(text);
            let theirs = text.parse::<f64>().ok();
            assert_eq!(ours.is_some(), theirs.is_some(), "{text}");
            let (a, b) = (ours.unwrap_or(0.0), theirs.unwrap_or(0.0));
            assert!(
                a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan(),
                "{text}: {a} {b}"
            );
        }
    }
}

//! Numbers and words of `prosody` and of `soundLevel`.
//!
//! SSML's words specify levels of the voice, independent of their context, so they are read as the
//! voice's own value with a factor; the factors are SABLE's. Its percentages of pitch, range and
//! loudness are changes of their context, and a percentage of the rate is one of the voice's own
//! rate.

use raconteur_base::ops;

use crate::content::Setting;
use crate::markup::levels::{change_text, number, shifted, shifted_text};

/// Against which a change of pitch in hertz is a factor, hertz: between the usual means of
/// men (about 120) and women (about 210). *Designed*.
const NOMINAL_HZ: f64 = 160.0;

/// Against which words a minute are a percentage for other engines.
const NOMINAL_WORDS: f64 = 180.0;

/// Gains of the words for loudness; SABLE's, with `x-soft` *designed* as half of `soft`.
const LOUDNESSES: [(&str, f64); 6] = [
    ("silent", 0.0),
    ("x-soft", 0.25),
    ("soft", 0.5),
    ("medium", 1.0),
    ("loud", 1.5),
    ("x-loud", 2.0),
];

const HEIGHTS: [(&str, f64); 5] = [
    ("x-low", 0.8),
    ("low", 0.9),
    ("medium", 1.0),
    ("high", 1.1),
    ("x-high", 1.2),
];

const RATES: [(&str, f64); 5] = [
    ("x-slow", 0.6),
    ("slow", 0.8),
    ("medium", 1.0),
    ("fast", 1.2),
    ("x-fast", 1.5),
];

/// Nested settings parsed from an SSML attribute, and a problem to report.
pub(super) type Settings = (Vec<Setting>, Option<&'static str>);

fn level(words: &[(&str, f64)], text: &str) -> Option<Vec<Setting>> {
    if text == "default" {
        return Some(vec![Setting::Default]);
    }
    let (_, factor) = words.iter().find(|(word, _)| *word == text)?;
    Some(vec![Setting::Default, Setting::Factor(*factor)])
}

fn is_signed(text: &str) -> bool {
    text.starts_with(['+', '-'])
}

fn factor(factor: f64) -> Option<Vec<Setting>> {
    (factor.is_finite() && factor > 0.0).then(|| vec![Setting::Factor(factor)])
}

/// Parses SSML's `pitch` or `range`: a word, hertz, or a change in percent, semitones or hertz.
pub(super) fn height(text: &str) -> Option<Settings> {
    let text = text.trim();
    if let Some(settings) = level(&HEIGHTS, text) {
        return Some((settings, None));
    }
    let strip = |unit: &str| text.strip_suffix(unit).map(str::trim_end);
    if let Some(percent) = strip("%") {
        return Some((factor(1.0 + shifted(percent, -2)?)?, None));
    }
    if let Some(semitones) = strip("st") {
        return Some((factor(ops::pow(2.0, number(semitones)? / 12.0))?, None));
    }
    // SSML 1.0 has changes without a unit.
    let hertz = strip("Hz").or_else(|| strip("hz"));
    let value = number(hertz.unwrap_or(text))?;
    if is_signed(text) {
        let note = "a change in hertz counts against 160 Hz";
        Some((factor((NOMINAL_HZ + value) / NOMINAL_HZ)?, Some(note)))
    } else {
        hertz?;
        (value > 0.0).then(|| (vec![Setting::Value(value)], None))
    }
}

/// Formats a pitch for [`height`], as accurately as possible.
pub(super) fn height_text(setting: Setting) -> String {
    match setting {
        Setting::Default => "default".to_owned(),
        Setting::Value(hertz) => format!("{hertz}Hz"),
        Setting::Factor(factor) => change_text(factor),
    }
}

/// Parses SSML's `rate`: a word or a percentage of the voice's own rate. Signed changes and plain
/// factors belong to SSML 1.0.
pub(super) fn rate(text: &str) -> Option<Settings> {
    let text = text.trim();
    if let Some(settings) = level(&RATES, text) {
        return Some((settings, None));
    }
    let Some(percent) = text.strip_suffix('%').map(str::trim_end) else {
        let settings = factor(number(text).filter(|_| !is_signed(text))?)?;
        return Some((settings, Some("a rate without % is SSML 1.0's factor")));
    };
    let share = shifted(percent, -2)?;
    if is_signed(percent) {
        let note = "a rate with a sign is SSML 1.0's change";
        Some((factor(1.0 + share)?, Some(note)))
    } else {
        let mut settings = vec![Setting::Default];
        settings.extend(factor(share)?);
        Some((settings, None))
    }
}

/// Formats a factor on the voice's own rate as a percentage.
pub(super) fn rate_text(factor: f64) -> String {
    format!("{}%", shifted_text(factor, 2))
}

/// Words a minute for engines that do not know them.
pub(super) fn rate_of_words(words: f64) -> String {
    rate_text((words / NOMINAL_WORDS).clamp(0.25, 4.0))
}

/// Parses SSML's `volume`: a word or a change in decibels. SSML 1.0 uses numbers from 0 to 100 and
/// percentages.
pub(super) fn loudness(text: &str) -> Option<Settings> {
    let text = text.trim();
    if text == "default" {
        return Some((vec![Setting::Default], None));
    }
    if let Some((_, gain)) = LOUDNESSES.iter().find(|(word, _)| *word == text) {
        return Some((vec![Setting::Value(*gain)], None));
    }
    if let Some(gain) = decibels(text) {
        return Some((vec![Setting::Factor(gain)], None));
    }
    let note = Some("a volume without dB is SSML 1.0's");
    if let Some(percent) = text.strip_suffix('%').map(str::trim_end) {
        let gain = (1.0 + shifted(percent, -2)?).max(0.0);
        return Some((vec![Setting::Factor(gain)], note));
    }
    let gain = number(text).filter(|_| !is_signed(text))? / 100.0;
    Some((vec![Setting::Value(gain.min(1.0))], note))
}

/// Parses a gain in decibels, for example `+6dB`.
pub(super) fn decibels(text: &str) -> Option<f64> {
    let text = text.trim();
    let number = number(
        text.strip_suffix("dB")
            .or(text.strip_suffix("db"))?
            .trim_end(),
    )?;
    // Beyond this range, nothing or everything is audible.
    Some(ops::pow(10.0, number.clamp(-200.0, 200.0) / 20.0))
}

/// Formats a gain factor above 0 so that [`decibels`] parses it, within a millionth of a decibel.
pub(super) fn decibels_text(gain: f64) -> String {
    let exact: f64 = 20.0 * ops::ln(gain) / core::f64::consts::LN_10;
    let db = (exact * 1e6).round() / 1e6;
    let sign = if db < 0.0 { "" } else { "+" };
    format!("{sign}{}dB", db.clamp(-200.0, 200.0) + 0.0)
}

/// Formats a loudness for [`loudness`], as accurately as possible.
pub(super) fn loudness_text(setting: Setting) -> String {
    match setting {
        Setting::Default => "default".to_owned(),
        Setting::Factor(gain) if gain > 0.0 => decibels_text(gain),
        Setting::Factor(_) => "silent".to_owned(),
        Setting::Value(gain) => {
            let far = |g: f64| (g - gain).abs();
            let nearest = LOUDNESSES
                .iter()
                .min_by(|(_, a), (_, b)| far(*a).total_cmp(&far(*b)));
            nearest.map_or("medium", |(word, _)| *word).to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Setting::{Default, Factor, Value};

    #[test]
    fn heights_are_words_hertz_and_changes() {
        let of = |text: &str| height(text).map(|(settings, _)| settings);
        assert_eq!(of("x-high"), Some(vec![Default, Factor(1.2)]));
        assert_eq!(of("default"), Some(vec![Default]));
        assert_eq!(of("120Hz"), Some(vec![Value(120.0)]));
        assert_eq!(of("-10%"), Some(vec![Factor(0.9)]));
        assert_eq!(of("+12st"), Some(vec![Factor(2.0)]));
        assert_eq!(of("-12st"), Some(vec![Factor(0.5)]));
        assert_eq!(of("+16Hz"), Some(vec![Factor(1.1)]));
        assert!(
            height("+16Hz").unwrap().1.is_some(),
            "a change in hertz is reported"
        );
        for bad in [
            "", "120", "0Hz", "-100%", "-200Hz", "high ish", "1e5Hz", "st",
        ] {
            assert_eq!(of(bad), None, "{bad}");
        }
    }

    #[test]
    fn rates_are_percentages_of_the_voices_own() {
        let of = |text: &str| rate(text).map(|(settings, _)| settings);
        assert_eq!(of("100%"), Some(vec![Default, Factor(1.0)]));
        assert_eq!(of("150%"), Some(vec![Default, Factor(1.5)]));
        assert_eq!(of("slow"), Some(vec![Default, Factor(0.8)]));
        assert_eq!(of("-20%"), Some(vec![Factor(0.8)]));
        assert_eq!(of("1.5"), Some(vec![Factor(1.5)]));
        for bad in ["0%", "-100%", "+1.5", "quick", ""] {
            assert_eq!(of(bad), None, "{bad}");
        }
        assert_eq!(of(&rate_text(1.44)), Some(vec![Default, Factor(1.44)]));
    }

    #[test]
    fn loudnesses_are_words_and_decibels() {
        let of = |text: &str| loudness(text).map(|(settings, _)| settings);
        assert_eq!(of("silent"), Some(vec![Value(0.0)]));
        assert_eq!(of("loud"), Some(vec![Value(1.5)]));
        assert_eq!(of("+0dB"), Some(vec![Factor(1.0)]));
        assert_eq!(of("+20dB"), Some(vec![Factor(10.0)]));
        assert_eq!(of("50"), Some(vec![Value(0.5)]));
        assert_eq!(of("-50%"), Some(vec![Factor(0.5)]));
        assert_eq!(of("louder"), None);
        for gain in [0.5, 1.0, 1.5, 2.0, 0.01] {
            let back = decibels(&decibels_text(gain)).unwrap();
            // A millionth of a decibel is 1.2e-7 of the gain.
            assert!((back / gain - 1.0).abs() < 1.2e-7, "{gain} {back}");
        }
        assert_eq!(decibels_text(1.0), "+0dB");
    }
}

//! What a mouth does for each phone of English: targets, dominance and viseme.
//!
//! The ten channels follow the visual-speech set of F&H section 3.1.3 (Albrecht):
//! contraction and protrusion of the orbicularis oris, mentalis, risorius (`spread`),
//! depressor labii inferioris, with jaw and tongue parameters, and an aperture of the
//! lips for faces without muscles. Her numbers are not published: **targets and
//! dominances are designed**. Bilabials get a dominance that keeps neighbours 80 ms away
//! within a few hundredths of closed; rounding begins early and decays slowly. Symbols:
//! Festival's `radio_phones.scm` and `mrpa_phones.scm`, SAMPA, and espeak-ng's English.
//! Visemes are the fifteen of OpenXR's `XR_META_face_tracking_visemes`.

/// Number of mouth channels.
pub const CHANNELS: usize = 10;

/// Mouth channels in the order of [`PhoneTargets::channels`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Channel {
    /// Opening of the jaw, 0..1.
    Jaw,
    /// Aperture between the lips, 0..1.
    LipOpen,
    /// Contraction of the orbicularis oris, 0..1.
    OoContract,
    /// Protrusion (positive) or retraction of the lips, −1..1.
    Protrude,
    /// Corners pulled apart (risorius), 0..1.
    Spread,
    /// Chin raised, lower lip pushed up, 0..1.
    Mentalis,
    /// Lower lip pulled down, 0..1.
    DeprLabii,
    /// Tip of the tongue raised to the ridge, 0..1.
    TongueTip,
    /// Back of the tongue raised to the velum, 0..1.
    TongueBack,
    /// Tongue between the teeth, 0..1.
    TongueOut,
}

impl Channel {
    /// Index of the dominance magnitude that rules each channel, in [`PhoneTargets::alphas`].
    pub const ALPHA: [usize; CHANNELS] = [0, 0, 1, 1, 2, 0, 0, 3, 3, 3];
}

/// Manner, as far as the lips care.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Steady vowel.
    Vowel,
    /// Vowel that glides; see [`PhoneTargets::glide`].
    Diphthong,
    /// p, b: lips closed, then released.
    BilabialStop,
    /// m: lips closed throughout.
    BilabialNasal,
    /// f, v: lower lip at the upper teeth.
    Labiodental,
    /// Any other consonant.
    Consonant,
    /// No sound.
    Silence,
}

/// Visual targets of one phone.
#[derive(Clone, Debug, PartialEq)]
pub struct PhoneTargets {
    symbols: [&'static str; 4],
    /// Viseme: one of sil PP FF TH DD kk CH SS nn RR aa E ih oh ou.
    pub viseme: &'static str,
    /// Manner.
    pub class: Class,
    glide_viseme: &'static str,
    /// Targets in the order of [`Channel`].
    pub channels: [f64; CHANNELS],
    /// Dominance magnitudes for opening, rounding, spreading and tongue.
    pub alphas: [f64; 4],
    /// Rates at which dominance rises before and falls after the peak, 1/s.
    pub thetas_per_s: [f64; 2],
}

impl PhoneTargets {
    /// The target of one channel.
    #[must_use]
    pub fn channel(&self, channel: Channel) -> f64 {
        self.channels[channel as usize]
    }

    /// What a diphthong glides to in its second part.
    #[must_use]
    pub fn glide(&self) -> Option<&'static Self> {
        let symbol = match self.glide_viseme {
            "ih" => "ih",
            "ou" => "uh",
            "E" => "eh",
            _ => return None,
        };
        find("radio", symbol)
    }
}

/// Names of the phone sets that [`find`] knows.
pub const PHONE_SETS: [&str; 4] = ["radio", "sampa", "espeak", "mrpa"];

/// Targets of a symbol in a phone set (one of [`PHONE_SETS`]; any other name is read as
/// `radio`). Upper case and stress digits of the CMU dictionary are understood in `radio`;
/// leading stress marks in `espeak`. `None` for an unknown symbol.
#[must_use]
pub fn find(phone_set: &str, symbol: &str) -> Option<&'static PhoneTargets> {
    let column = PHONE_SETS.iter().position(|s| *s == phone_set).unwrap_or(0);
    let bare = match column {
        0 => symbol.trim_end_matches(|c: char| c.is_ascii_digit()),
        2 => symbol.trim_start_matches(['\'', ',']),
        _ => symbol,
    };
    let same = |s: &str| {
        !s.is_empty()
            && if column == 0 {
                s.eq_ignore_ascii_case(bare)
            } else {
                s == bare
            }
    };
    TABLE.iter().find(|row| same(row.symbols[column]))
}

/// Silence: the closed mouth at rest.
#[must_use]
pub fn silence() -> &'static PhoneTargets {
    &TABLE[SILENCE]
}

/// A phone that says little about the lips (schwa): what an unknown symbol is shown as.
#[must_use]
pub fn neutral() -> &'static PhoneTargets {
    &TABLE[SCHWA]
}

const fn row(
    symbols: [&'static str; 4],
    viseme: &'static str,
    class: Class,
    glide_viseme: &'static str,
    channels: [f64; CHANNELS],
    alphas: [f64; 4],
    thetas_per_s: [f64; 2],
) -> PhoneTargets {
    PhoneTargets {
        symbols,
        viseme,
        class,
        glide_viseme,
        channels,
        alphas,
        thetas_per_s,
    }
}

const SCHWA: usize = 3;
const SILENCE: usize = TABLE.len() - 3;

/// Symbols (radio, SAMPA, espeak, MRPA), viseme, class, glide, channels, alphas, thetas.
#[rustfmt::skip]
static TABLE: [PhoneTargets; 56] = [
    row(["aa", "A:", "A:", "aa"], "aa", Class::Vowel, "", [0.65, 0.55, 0.0, 0.0, 0.05, 0.0, 0.35, 0.0, 0.1, 0.0], [1.0, 0.6, 0.8, 1.0], [12.0, 12.0]),
    row(["ae", "{", "a", "a"], "aa", Class::Vowel, "", [0.55, 0.55, 0.0, 0.0, 0.25, 0.0, 0.35, 0.0, 0.1, 0.0], [1.0, 0.6, 0.8, 1.0], [12.0, 12.0]),
    row(["ah", "V", "V", "uh"], "aa", Class::Vowel, "", [0.45, 0.42, 0.0, 0.0, 0.05, 0.0, 0.35, 0.0, 0.1, 0.0], [1.0, 0.6, 0.8, 1.0], [12.0, 12.0]),
    row(["ax", "@", "@", "@"], "E", Class::Vowel, "", [0.25, 0.28, 0.0, 0.0, 0.08, 0.0, 0.3, 0.2, 0.1, 0.0], [0.6, 0.4, 0.4, 0.5], [12.0, 12.0]),
    row(["ix", "1", "I#", "i"], "ih", Class::Vowel, "", [0.2, 0.3, 0.0, -0.05, 0.2, 0.0, 0.25, 0.5, 0.3, 0.0], [0.6, 0.4, 0.5, 0.6], [12.0, 12.0]),
    row(["ao", "O:", "O:", "oo"], "oh", Class::Vowel, "", [0.48, 0.4, 0.35, 0.45, 0.0, 0.05, 0.2, 0.0, 0.4, 0.0], [1.0, 1.3, 0.8, 1.0], [8.0, 10.0]),
    row(["", "Q", "0", "o"], "oh", Class::Vowel, "", [0.52, 0.4, 0.2, 0.25, 0.0, 0.05, 0.2, 0.0, 0.4, 0.0], [1.0, 1.3, 0.8, 1.0], [8.0, 10.0]),
    row(["eh", "e", "E", "e"], "E", Class::Vowel, "", [0.38, 0.4, 0.0, 0.0, 0.25, 0.0, 0.3, 0.2, 0.1, 0.0], [1.0, 0.6, 0.9, 1.0], [12.0, 12.0]),
    row(["er", "3:", "3:", "@@"], "RR", Class::Vowel, "", [0.25, 0.28, 0.25, 0.3, 0.0, 0.05, 0.1, 0.3, 0.4, 0.0], [1.0, 1.1, 0.8, 1.0], [12.0, 12.0]),
    row(["axr", "@r", "3", "@"], "RR", Class::Vowel, "", [0.2, 0.24, 0.25, 0.3, 0.0, 0.05, 0.1, 0.3, 0.4, 0.0], [0.7, 1.0, 0.7, 0.8], [12.0, 12.0]),
    row(["ih", "I", "I", "i"], "ih", Class::Vowel, "", [0.22, 0.3, 0.0, -0.05, 0.4, 0.0, 0.25, 0.5, 0.3, 0.0], [1.0, 0.7, 1.1, 1.2], [12.0, 12.0]),
    row(["iy", "i:", "i:", "ii"], "ih", Class::Vowel, "", [0.15, 0.3, 0.0, -0.05, 0.55, 0.0, 0.25, 0.6, 0.3, 0.0], [1.0, 0.7, 1.1, 1.2], [12.0, 12.0]),
    row(["uh", "U", "U", "u"], "ou", Class::Vowel, "", [0.22, 0.2, 0.4, 0.5, 0.0, 0.1, 0.1, 0.0, 0.5, 0.0], [1.0, 1.6, 0.8, 1.0], [7.0, 10.0]),
    row(["uw", "u:", "u:", "uu"], "ou", Class::Vowel, "", [0.18, 0.2, 0.6, 0.75, 0.0, 0.1, 0.1, 0.0, 0.5, 0.0], [1.0, 1.6, 0.8, 1.0], [7.0, 10.0]),
    row(["ey", "eI", "eI", "ei"], "E", Class::Diphthong, "ih", [0.38, 0.4, 0.0, 0.0, 0.25, 0.0, 0.3, 0.2, 0.1, 0.0], [1.0, 0.6, 0.9, 1.0], [12.0, 12.0]),
    row(["ay", "aI", "aI", "ai"], "aa", Class::Diphthong, "ih", [0.65, 0.55, 0.0, 0.0, 0.05, 0.0, 0.35, 0.0, 0.1, 0.0], [1.0, 0.6, 0.8, 1.0], [12.0, 12.0]),
    row(["aw", "aU", "aU", "au"], "aa", Class::Diphthong, "ou", [0.65, 0.55, 0.0, 0.0, 0.05, 0.0, 0.35, 0.0, 0.1, 0.0], [1.0, 0.6, 0.8, 1.0], [12.0, 12.0]),
    row(["ow", "@U", "oU", "ou"], "oh", Class::Diphthong, "ou", [0.42, 0.4, 0.35, 0.45, 0.0, 0.05, 0.2, 0.0, 0.4, 0.0], [1.0, 1.3, 0.8, 1.0], [8.0, 10.0]),
    row(["oy", "OI", "OI", "oi"], "oh", Class::Diphthong, "ih", [0.42, 0.4, 0.35, 0.45, 0.0, 0.05, 0.2, 0.0, 0.4, 0.0], [1.0, 1.3, 0.8, 1.0], [8.0, 10.0]),
    row(["", "I@", "i@3", "i@"], "ih", Class::Diphthong, "E", [0.22, 0.3, 0.0, -0.05, 0.4, 0.0, 0.25, 0.5, 0.3, 0.0], [1.0, 0.7, 1.1, 1.2], [12.0, 12.0]),
    row(["", "e@", "e@", "e@"], "E", Class::Diphthong, "E", [0.38, 0.4, 0.0, 0.0, 0.25, 0.0, 0.3, 0.2, 0.1, 0.0], [1.0, 0.6, 0.9, 1.0], [12.0, 12.0]),
    row(["", "U@", "U@", "u@"], "ou", Class::Diphthong, "E", [0.18, 0.2, 0.6, 0.75, 0.0, 0.1, 0.1, 0.0, 0.5, 0.0], [1.0, 1.6, 0.8, 1.0], [7.0, 10.0]),
    row(["p", "p", "p", "p"], "PP", Class::BilabialStop, "", [0.05, 0.0, 0.35, 0.05, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0], [25.0, 0.5, 0.5, 0.05], [24.0, 28.0]),
    row(["b", "b", "b", "b"], "PP", Class::BilabialStop, "", [0.05, 0.0, 0.35, 0.05, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0], [25.0, 0.5, 0.5, 0.05], [24.0, 28.0]),
    row(["t", "t", "t", "t"], "DD", Class::Consonant, "", [0.15, 0.2, 0.0, 0.0, 0.1, 0.0, 0.2, 1.0, 0.0, 0.0], [0.9, 0.3, 0.4, 4.0], [24.0, 24.0]),
    row(["d", "d", "d", "d"], "DD", Class::Consonant, "", [0.15, 0.2, 0.0, 0.0, 0.1, 0.0, 0.2, 1.0, 0.0, 0.0], [0.9, 0.3, 0.4, 4.0], [24.0, 24.0]),
    row(["k", "k", "k", "k"], "kk", Class::Consonant, "", [0.18, 0.25, 0.0, 0.0, 0.05, 0.0, 0.2, 0.0, 1.0, 0.0], [0.6, 0.3, 0.3, 4.0], [22.0, 22.0]),
    row(["g", "g", "g", "g"], "kk", Class::Consonant, "", [0.18, 0.25, 0.0, 0.0, 0.05, 0.0, 0.2, 0.0, 1.0, 0.0], [0.6, 0.3, 0.3, 4.0], [22.0, 22.0]),
    row(["ch", "tS", "tS", "ch"], "CH", Class::Consonant, "", [0.1, 0.25, 0.3, 0.45, 0.0, 0.1, 0.2, 0.8, 0.2, 0.0], [2.0, 2.0, 1.0, 3.0], [14.0, 18.0]),
    row(["jh", "dZ", "dZ", "jh"], "CH", Class::Consonant, "", [0.1, 0.25, 0.3, 0.45, 0.0, 0.1, 0.2, 0.8, 0.2, 0.0], [2.0, 2.0, 1.0, 3.0], [14.0, 18.0]),
    row(["f", "f", "f", "f"], "FF", Class::Labiodental, "", [0.1, 0.1, 0.15, 0.0, 0.05, 0.35, 0.0, 0.0, 0.0, 0.0], [12.0, 0.5, 0.6, 0.1], [22.0, 26.0]),
    row(["v", "v", "v", "v"], "FF", Class::Labiodental, "", [0.1, 0.1, 0.15, 0.0, 0.05, 0.35, 0.0, 0.0, 0.0, 0.0], [12.0, 0.5, 0.6, 0.1], [22.0, 26.0]),
    row(["th", "T", "T", "th"], "TH", Class::Consonant, "", [0.18, 0.2, 0.0, 0.0, 0.05, 0.0, 0.15, 0.35, 0.0, 0.35], [1.4, 0.4, 0.5, 4.0], [22.0, 22.0]),
    row(["dh", "D", "D", "dh"], "TH", Class::Consonant, "", [0.18, 0.2, 0.0, 0.0, 0.05, 0.0, 0.15, 0.35, 0.0, 0.35], [1.4, 0.4, 0.5, 4.0], [22.0, 22.0]),
    row(["s", "s", "s", "s"], "SS", Class::Consonant, "", [0.06, 0.2, 0.0, 0.0, 0.25, 0.0, 0.25, 0.8, 0.0, 0.0], [3.0, 0.4, 0.8, 4.0], [22.0, 22.0]),
    row(["z", "z", "z", "z"], "SS", Class::Consonant, "", [0.06, 0.2, 0.0, 0.0, 0.25, 0.0, 0.25, 0.8, 0.0, 0.0], [3.0, 0.4, 0.8, 4.0], [22.0, 22.0]),
    row(["sh", "S", "S", "sh"], "CH", Class::Consonant, "", [0.1, 0.25, 0.3, 0.45, 0.0, 0.1, 0.2, 0.8, 0.2, 0.0], [2.0, 2.0, 1.0, 3.0], [14.0, 18.0]),
    row(["zh", "Z", "Z", "zh"], "CH", Class::Consonant, "", [0.1, 0.25, 0.3, 0.45, 0.0, 0.1, 0.2, 0.8, 0.2, 0.0], [2.0, 2.0, 1.0, 3.0], [14.0, 18.0]),
    row(["m", "m", "m", "m"], "PP", Class::BilabialNasal, "", [0.05, 0.0, 0.35, 0.05, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0], [25.0, 0.5, 0.5, 0.05], [24.0, 28.0]),
    row(["n", "n", "n", "n"], "nn", Class::Consonant, "", [0.16, 0.2, 0.0, 0.0, 0.08, 0.0, 0.2, 1.0, 0.0, 0.0], [0.8, 0.3, 0.4, 4.0], [22.0, 22.0]),
    row(["ng", "N", "N", "ng"], "kk", Class::Consonant, "", [0.18, 0.25, 0.0, 0.0, 0.05, 0.0, 0.2, 0.0, 1.0, 0.0], [0.6, 0.3, 0.3, 4.0], [22.0, 22.0]),
    row(["l", "l", "l", "l"], "nn", Class::Consonant, "", [0.16, 0.2, 0.0, 0.0, 0.08, 0.0, 0.2, 1.0, 0.0, 0.0], [0.8, 0.3, 0.4, 4.0], [22.0, 22.0]),
    row(["r", "r", "r", "r"], "RR", Class::Consonant, "", [0.14, 0.18, 0.25, 0.3, 0.0, 0.05, 0.1, 0.6, 0.4, 0.0], [0.7, 1.4, 0.8, 2.0], [14.0, 16.0]),
    row(["y", "j", "j", "y"], "ih", Class::Consonant, "", [0.12, 0.3, 0.0, -0.05, 0.4, 0.0, 0.25, 0.7, 0.3, 0.0], [0.7, 0.5, 1.3, 2.0], [14.0, 14.0]),
    row(["w", "w", "w", "w"], "ou", Class::Consonant, "", [0.12, 0.2, 0.75, 0.85, 0.0, 0.1, 0.1, 0.0, 0.5, 0.0], [1.6, 3.0, 1.6, 1.0], [12.0, 12.0]),
    row(["hh", "h", "h", "h"], "E", Class::Consonant, "", [0.22, 0.25, 0.0, 0.0, 0.0, 0.0, 0.3, 0.0, 0.1, 0.0], [0.15, 0.15, 0.15, 0.15], [12.0, 12.0]),
    row(["hv", "h", "h", "h"], "E", Class::Consonant, "", [0.22, 0.25, 0.0, 0.0, 0.0, 0.0, 0.3, 0.0, 0.1, 0.0], [0.15, 0.15, 0.15, 0.15], [12.0, 12.0]),
    row(["dx", "4", "t#", "t"], "DD", Class::Consonant, "", [0.15, 0.2, 0.0, 0.0, 0.1, 0.0, 0.2, 1.0, 0.0, 0.0], [0.5, 0.2, 0.3, 3.0], [28.0, 28.0]),
    row(["nx", "4~", "n", "n"], "nn", Class::Consonant, "", [0.16, 0.2, 0.0, 0.0, 0.08, 0.0, 0.2, 1.0, 0.0, 0.0], [0.5, 0.2, 0.3, 3.0], [28.0, 28.0]),
    row(["el", "l=", "@L", "l"], "nn", Class::Consonant, "", [0.16, 0.2, 0.0, 0.0, 0.08, 0.0, 0.2, 1.0, 0.0, 0.0], [0.8, 0.3, 0.4, 4.0], [22.0, 22.0]),
    row(["em", "m=", "m-", "m"], "PP", Class::BilabialNasal, "", [0.05, 0.0, 0.35, 0.05, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0], [25.0, 0.5, 0.5, 0.05], [24.0, 28.0]),
    row(["en", "n=", "n-", "n"], "nn", Class::Consonant, "", [0.16, 0.2, 0.0, 0.0, 0.08, 0.0, 0.2, 1.0, 0.0, 0.0], [0.8, 0.3, 0.4, 4.0], [22.0, 22.0]),
    row(["q", "?", "?", ""], "sil", Class::Consonant, "", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.1, 0.1, 0.1, 0.1], [12.0, 12.0]),
    row(["pau", "_", "_:", "#"], "sil", Class::Silence, "", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [1.4, 1.0, 1.0, 1.0], [10.0, 10.0]),
    row(["brth", "_", "_:", "#"], "sil", Class::Silence, "", [0.12, 0.15, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [1.4, 1.0, 1.0, 1.0], [10.0, 10.0]),
    row(["h#", "_", "_:", "#"], "sil", Class::Silence, "", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [1.4, 1.0, 1.0, 1.0], [10.0, 10.0]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_symbol_of_the_radio_set_is_known() {
        let radio = "aa ae ah ao aw ax axr ay b ch d dh dx eh el em en er ey f g hh hv ih iy jh k l m n \
                     ng nx ow oy p r s sh t th uh uw v w y z zh pau brth h#";
        for symbol in radio.split_whitespace() {
            assert!(find("radio", symbol).is_some(), "{symbol}");
        }
        assert_eq!(find("radio", "AH0"), find("radio", "ah"));
        assert_eq!(find("espeak", "'i:").map(|p| p.viseme), Some("ih"));
        assert!(find("radio", "xyzzy").is_none());
    }

    #[test]
    fn the_same_letter_means_another_vowel_in_another_set() {
        assert_eq!(find("mrpa", "uh"), find("radio", "ah"));
        assert_eq!(find("mrpa", "oo"), find("radio", "ao"));
    }

    #[test]
    fn silence_is_closed_and_the_fallback_is_a_schwa() {
        assert_eq!(silence().class, Class::Silence);
        assert_eq!(silence().channels, [0.0; CHANNELS]);
        assert_eq!(find("radio", "pau"), Some(silence()));
        assert_eq!(find("radio", "ax"), Some(neutral()));
    }

    #[test]
    fn diphthongs_and_nothing_else_glide() {
        for row in &TABLE {
            assert_eq!(
                row.class == Class::Diphthong,
                row.glide().is_some(),
                "{:?}",
                row.symbols
            );
        }
    }

    #[test]
    fn targets_stay_in_range() {
        for row in &TABLE {
            for (i, v) in row.channels.iter().enumerate() {
                let low = if i == Channel::Protrude as usize {
                    -1.0
                } else {
                    0.0
                };
                assert!((low..=1.0).contains(v), "{:?}", row.symbols);
            }
            assert!(
                row.alphas.iter().all(|a| *a > 0.0) && row.thetas_per_s.iter().all(|t| *t > 0.0)
            );
        }
    }
}

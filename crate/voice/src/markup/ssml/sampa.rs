//! Conversion of X-SAMPA to the International Phonetic Alphabet (J. C. Wells, *Computer-coding the
//! IPA*, 1995).

/// Signs; longer ones precede their prefixes.
const SIGNS: &[(&str, &str)] = &[
    ("r\\`", "ɻ"),
    ("s\\", "ɕ"),
    ("z\\", "ʑ"),
    ("r\\", "ɹ"),
    ("R\\", "ʀ"),
    ("p\\", "ɸ"),
    ("B\\", "ʙ"),
    ("G\\", "ɢ"),
    ("h\\", "ɦ"),
    ("H\\", "ʜ"),
    ("j\\", "ʝ"),
    ("J\\", "ɟ"),
    ("K\\", "ɮ"),
    ("l\\", "ɺ"),
    ("L\\", "ʟ"),
    ("M\\", "ɰ"),
    ("N\\", "ɴ"),
    ("v\\", "ʋ"),
    ("x\\", "ɧ"),
    ("X\\", "ħ"),
    ("3\\", "ɞ"),
    ("@\\", "ɘ"),
    ("I\\", "ᵻ"),
    ("U\\", "ᵿ"),
    ("?\\", "ʕ"),
    (":\\", "ˑ"),
    ("=\\", "ǂ"),
    ("!\\", "ǃ"),
    ("|\\", "ǀ"),
    ("O\\", "ʘ"),
    ("_~", "\u{303}"),
    ("_h", "ʰ"),
    ("_w", "ʷ"),
    ("_j", "ʲ"),
    ("_0", "\u{325}"),
    ("_d", "\u{32a}"),
    ("_>", "ʼ"),
    ("_=", "\u{329}"),
    ("_^", "\u{32f}"),
    ("_v", "\u{32c}"),
    ("_G", "ˠ"),
    ("_e", "\u{334}"),
    ("_?\\", "ˤ"),
    ("_}", "\u{31a}"),
    ("_n", "ⁿ"),
    ("_l", "ˡ"),
    ("_t", "\u{324}"),
    ("_k", "\u{330}"),
    ("_a", "\u{33a}"),
    ("_m", "\u{33b}"),
    ("_o", "\u{31e}"),
    ("_r", "\u{31d}"),
    ("_+", "\u{31f}"),
    ("_-", "\u{320}"),
    ("@`", "ɚ"),
    ("3`", "ɝ"),
    ("d`", "ɖ"),
    ("l`", "ɭ"),
    ("n`", "ɳ"),
    ("r`", "ɽ"),
    ("s`", "ʂ"),
    ("t`", "ʈ"),
    ("z`", "ʐ"),
    ("||", "‖"),
    ("A", "ɑ"),
    ("B", "β"),
    ("C", "ç"),
    ("D", "ð"),
    ("E", "ɛ"),
    ("F", "ɱ"),
    ("G", "ɣ"),
    ("H", "ɥ"),
    ("I", "ɪ"),
    ("J", "ɲ"),
    ("K", "ɬ"),
    ("L", "ʎ"),
    ("M", "ɯ"),
    ("N", "ŋ"),
    ("O", "ɔ"),
    ("P", "ʋ"),
    ("Q", "ɒ"),
    ("R", "ʁ"),
    ("S", "ʃ"),
    ("T", "θ"),
    ("U", "ʊ"),
    ("V", "ʌ"),
    ("W", "ʍ"),
    ("X", "χ"),
    ("Y", "ʏ"),
    ("Z", "ʒ"),
    ("g", "ɡ"),
    ("@", "ə"),
    ("{", "æ"),
    ("}", "ʉ"),
    ("1", "ɨ"),
    ("2", "ø"),
    ("3", "ɜ"),
    ("4", "ɾ"),
    ("5", "ɫ"),
    ("6", "ɐ"),
    ("7", "ɤ"),
    ("8", "ɵ"),
    ("9", "œ"),
    ("&", "ɶ"),
    ("?", "ʔ"),
    (":", "ː"),
    ("\"", "ˈ"),
    ("%", "ˌ"),
    ("'", "ʲ"),
    ("~", "\u{303}"),
    ("=", "\u{329}"),
    ("`", "˞"),
    ("$", "."),
    (".", "."),
    ("|", "|"),
    ("-", ""),
    (" ", " "),
];

/// Converts a pronunciation to the International Phonetic Alphabet; `None` if it contains a sign
/// that X-SAMPA does not have.
pub(super) fn to_ipa(sampa: &str) -> Option<String> {
    let mut rest = sampa;
    let mut ipa = String::new();
    'signs: while let Some(first) = rest.chars().next() {
        for (sign, symbol) in SIGNS {
            if let Some(after) = rest.strip_prefix(sign) {
                ipa.push_str(symbol);
                rest = after;
                continue 'signs;
            }
        }
        // The other small letters are themselves.
        if !first.is_ascii_lowercase() {
            return None;
        }
        ipa.push(first);
        rest = &rest[1..];
    }
    Some(ipa)
}

#[cfg(test)]
mod tests {
    use super::to_ipa;

    #[test]
    fn words_of_several_languages_come_out_right() {
        for (sampa, ipa) in [
            ("t@\"meItoU", "təˈmeɪtoʊ"),
            ("b{t", "bæt"),
            ("\"S2:n@", "ˈʃøːnə"),
            ("s6~w~", "sɐ\u{303}w\u{303}"),
            ("r\\Ed", "ɹɛd"),
            ("t_hAp", "tʰɑp"),
            ("fa\"D@`", "faˈðɚ"),
        ] {
            assert_eq!(to_ipa(sampa).as_deref(), Some(ipa), "{sampa}");
        }
        assert_eq!(to_ipa("ə"), None);
        assert_eq!(to_ipa("a\\b"), None);
    }
}

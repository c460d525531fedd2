//! Manner of articulation of phones, as far as it affects their durations and audio.

use raconteur_speech::bundle::SILENCE;
use raconteur_speech::phones::{Class, find};

/// Manner of articulation of a phone, as relevant for changing its duration and pitch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// Vowels and diphthongs.
    Vowel,
    /// Nasals, liquids and glides.
    Sonorant,
    /// Closure and release.
    Plosive,
    /// Friction, affricates with it.
    Fricative,
    /// Silence, or a recording between words.
    Silence,
}

/// Returns the manner of a phone. An unknown phone counts as a fricative, which has no expected
/// features.
#[must_use]
pub fn manner(phone_set: &str, symbol: &str) -> Manner {
    if symbol == SILENCE || symbol == raconteur_speech::bundle::SOUND {
        return Manner::Silence;
    }
    let Some(targets) = find(phone_set, symbol) else {
        return Manner::Fricative;
    };
    match (targets.class, targets.viseme) {
        // Breath has the mouth shape of the following phone.
        (Class::Consonant, _) if symbol.starts_with(['h', 'H']) => Manner::Fricative,
        (Class::Vowel | Class::Diphthong, _) => Manner::Vowel,
        (Class::Silence, _) => Manner::Silence,
        (Class::BilabialStop, _) => Manner::Plosive,
        (Class::BilabialNasal, _) | (Class::Consonant, "nn" | "RR" | "ih" | "ou" | "oh" | "E") => {
            Manner::Sonorant
        }
        (Class::Consonant, "DD" | "kk") => {
            let first = symbol.trim_start_matches(['\'', ',']).chars().next();
            match first {
                Some('t' | 'd' | 'k' | 'g') => Manner::Plosive,
                // Flaps and the velar nasal are visible as their stops are.
                Some('r' | 'n' | 'N' | '*' | 'l' | 'L') => Manner::Sonorant,
                _ => Manner::Fricative,
            }
        }
        (Class::Labiodental | Class::Consonant, _) => Manner::Fricative,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phones_have_their_manner() {
        for (symbols, expected) in [
            ("aa ay er iy ax", Manner::Vowel),
            ("m n ng l r w y", Manner::Sonorant),
            ("p b t d k g", Manner::Plosive),
            ("f v s z sh th hh ch jh", Manner::Fricative),
            ("pau snd", Manner::Silence),
        ] {
            for symbol in symbols.split(' ') {
                assert_eq!(manner("radio", symbol), expected, "{symbol}");
            }
        }
    }
}

//! Words that negate, in the supported languages.

/// Words that negate: English, German, Portuguese.
const NEGATIONS: [&str; 27] = [
    "no", "not", "never", "nothing", "nobody", "none", "nowhere", "neither", "cannot", "nein",
    "nicht", "nie", "niemals", "niemand", "nichts", "kein", "keine", "keinen", "keiner", "keinem",
    "não", "nunca", "jamais", "nada", "ninguém", "nenhum", "nenhuma",
];

/// Returns true if a word with its punctuation negates.
pub(super) fn is_negation(text: &str) -> bool {
    let word = text.trim_matches(|c: char| !c.is_alphanumeric());
    if word.len() > 12 {
        return false;
    }
    let word = word.to_lowercase();
    NEGATIONS.contains(&word.as_str()) || word.ends_with("n't") || word.ends_with("n’t")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negations_are_found_with_their_punctuation() {
        for text in ["No,", "“not", "don't", "can’t!", "Nicht", "não.", "NEVER"] {
            assert!(is_negation(text), "{text} negates");
        }
        for text in ["", "know", "note", "nose", "“", "Nina", "ant", "want"] {
            assert!(!is_negation(text), "{text} does not negate");
        }
    }
}

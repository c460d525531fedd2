//! What is to be said, independent of the language that a script was written in.

use core::fmt::Write as _;

use raconteur_base::decimal::fixed;

/// One stretch of an utterance.
#[derive(Clone, Debug, PartialEq)]
pub enum Segment {
    /// Words, with their emphasis: 0 reduced … 1 none … 2 strong.
    Text {
        /// The words, any white space.
        text: String,
        /// Emphasis level; 1 is plain.
        emphasis: f64,
    },
    /// Silence, milliseconds.
    Break {
        /// Length.
        msec: u32,
    },
    /// A sentence or paragraph ends here.
    Boundary,
}

/// The content of one utterance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Content {
    /// Its stretches in order.
    pub segments: Vec<Segment>,
}

impl Content {
    /// A canonical text of the content: white space collapsed, markup made visible. Two
    /// utterances that sound alike have the same.
    #[must_use]
    pub fn canonical(&self) -> String {
        let mut out = String::new();
        for segment in &self.segments {
            match segment {
                Segment::Text { text, emphasis } => {
                    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
                    if words.is_empty() {
                        continue;
                    }
                    if (emphasis - 1.0).abs() < 1e-9 {
                        let _ = write!(out, "{words} ");
                    } else {
                        let _ = write!(out, "[{}|{words}] ", fixed(*emphasis, 2));
                    }
                }
                Segment::Break { msec } => {
                    let _ = write!(out, "[pause {msec}] ");
                }
                Segment::Boundary => {
                    if !out.is_empty() && !out.ends_with("[/] ") {
                        out.push_str("[/] ");
                    }
                }
            }
        }
        out.trim_end().trim_end_matches("[/]").trim_end().to_owned()
    }

    /// The key by which a bundle knows the utterance: FNV-1a (64 bits) of
    /// [`Content::canonical`], 16 hexadecimal digits.
    #[must_use]
    pub fn key(&self) -> String {
        let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
        for byte in self.canonical().bytes() {
            hash ^= u64::from(byte);
            hash = hash.wrapping_mul(0x0100_0000_01b3);
        }
        format!("{hash:016x}")
    }

    /// The words in order: tokens between white space that hold a letter or digit;
    /// punctuation stays attached.
    #[must_use]
    pub fn words(&self) -> Vec<&str> {
        self.segments
            .iter()
            .filter_map(|s| match s {
                Segment::Text { text, .. } => Some(text.split_whitespace()),
                _ => None,
            })
            .flatten()
            .filter(|w| w.chars().any(char::is_alphanumeric))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(t: &str, emphasis: f64) -> Segment {
        Segment::Text {
            text: t.to_owned(),
            emphasis,
        }
    }

    #[test]
    fn white_space_does_not_change_the_key_but_emphasis_does() {
        let a = Content {
            segments: vec![text(" Hello\n  world! ", 1.0)],
        };
        let b = Content {
            segments: vec![text("Hello", 1.0), text("world!", 1.0), Segment::Boundary],
        };
        let c = Content {
            segments: vec![text("Hello", 1.0), text("world!", 1.5)],
        };
        assert_eq!(a.key(), b.key());
        assert_ne!(a.key(), c.key());
        assert_eq!(b.words(), ["Hello", "world!"]);
    }
}

//! `performer`: the performer and its voice, language and manner.

use super::{Attribute, Element, Kind};
use crate::{Expressions, PreferredHand};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Specifies who performs the script, with which voice and language, and how much the character moves face and head when it speaks. A host or a bake may choose another figure, voice and language.",
    ),
    decision: super::reference_text(
        "By default, nonverbal behaviour is derived from the speech audio (F&H section 4.2), and for an utterance with unknown pitch from its text (4.3). Amounts are multiples of those published in F&H; none of them, not even zero, changes the lips. If a figure is unavailable, the default figure performs.",
    ),
    source: super::reference_text("Extension; GEVH 3.1, 3.4; F&H 4.2, 4.3"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer figure='papous' expressions='text' brows='0.6'/></head><body><null time='1'/></body></eml>",
    ),
    extension: true,
    one_of: &[
        "figure",
        "voice",
        "language",
        "handedness",
        "expressions",
        "formality",
        "head",
        "brows",
        "blinks",
        "gaze",
        "tilts",
        "browShare",
        "pitchThreshold",
        "accentGlances",
        "pauseGlances",
        "thinkingPause",
        "thinking",
        "frowns",
        "lickInterval",
        "headByLoudness",
        "browsByLoudness",
    ],
    max_per_parent: Some(1),
    attributes: &[
        Attribute::new(
            "figure",
            Kind::Path,
            "The figure: a name from the library, or a file next to the story.",
        ),
        Attribute::identifier(
            "voice",
            "The voice of text that names no other: VOICE or ENGINE:VOICE for the baker, or the name of a voice of the browser.",
        ),
        Attribute::identifier(
            "language",
            "The language of text that names no other, as in BCP 47.",
        ),
        Attribute::choice(
            "handedness",
            PreferredHand::WORDS,
            "The dominant hand for which the script is written; right by default. The host may choose the other one, and so may the figure if the script does not specify one: gestures of the dominant and the other hand are then mirrored.",
        ),
        Attribute::choice(
            "expressions",
            Expressions::WORDS,
            "The source of nonverbal behaviour: the audio or the text.",
        ),
        Attribute::between(
            "formality",
            0.0,
            1.0,
            "The formality of the occasion, 0 casual to 1 formal; here 0.5. It prefers some rest postures: hands behind the back or fingertips together, or one hand on the hip or in a pocket.",
        ),
        Attribute::between(
            "head",
            0.0,
            1.0,
            "The amount of head raises and tilts, relative to the published amount.",
        ),
        Attribute::between("brows", 0.0, 2.0, "The amount of brow raises and frowns."),
        Attribute::between(
            "blinks",
            0.0,
            4.0,
            "The blink rate, relative to 22 blinks per minute in speech and 17 in silence.",
        ),
        Attribute::between("gaze", 0.0, 2.0, "The amount of gaze aversion."),
        Attribute::between(
            "tilts",
            0.0,
            1.0,
            "The share of raises in which the head tilts to a side (F&H 4.3.5: 0.75).",
        ),
        Attribute::between(
            "browShare",
            0.0,
            1.0,
            "The share of pitch maxima at which the brows are raised (F&H 4.3.5: 0.71).",
        ),
        Attribute::between(
            "pitchThreshold",
            0.1,
            24.0,
            "How far a pitch maximum must stand out from the adjacent minima to count, in semitones (F&H 4.2.1, speaker-dependent; here 2.5).",
        ),
        Attribute::between(
            "accentGlances",
            0.0,
            1.0,
            "The share of accented syllables on which the speaker looks at the listener (F&H 4.3.5: 0.7).",
        ),
        Attribute::between(
            "pauseGlances",
            0.0,
            1.0,
            "The same share for pauses between phrases (F&H 4.3.5: 0.7).",
        ),
        Attribute::between(
            "thinkingPause",
            0.15,
            60.0,
            "The minimum length in seconds of a thinking pause inside a sentence (F&H 4.2.1, speaker-dependent; here 0.7).",
        ),
        Attribute::between(
            "thinking",
            0.0,
            1.0,
            "The share of such pauses that show thinking; all by default.",
        ),
        Attribute::between(
            "frowns",
            0.0,
            1.0,
            "The share of these that show a frown at the floor instead of an upward look with raised brows (F&H 4.2.1: 0.25).",
        ),
        Attribute::between(
            "lickInterval",
            1.0,
            3600.0,
            "The mean time in seconds between two moistenings of the lips in speech (F&H 4.2.1; here 25).",
        ),
        Attribute::between(
            "headByLoudness",
            0.0,
            1.0,
            "The influence of the intensity on head raises (F&H 4.2.1; here 0.4).",
        ),
        Attribute::between(
            "browsByLoudness",
            0.0,
            1.0,
            "The influence of the intensity on brow raises (F&H 4.2.1; here 0.25).",
        ),
    ],
    ..Element::part("performer", &["head"])
};

#[cfg(test)]
mod tests {
    use crate::Expressions;

    #[test]
    fn the_choice_is_kept() {
        let text = "<eml xmlns:x='urn:raconteur:eml:1'><head><x:performer figure='papous' expressions='text' formality='0.9' brows='2'/></head>\
                    <body><null time='1'/></body></eml>";
        let parsed = crate::parse(text);
        assert_eq!(parsed.diagnostics, []);
        let performer = parsed.document.performer.unwrap();
        assert_eq!(performer.figure.as_deref(), Some("papous"));
        assert_eq!(performer.expressions, Some(Expressions::Text));
        assert_eq!((performer.brows, performer.gaze), (Some(2.0), None));
        assert_eq!(performer.formality, Some(0.9));
    }

    #[test]
    fn every_amount_of_the_manner_is_read_and_kept_in_its_range() {
        use crate::schema::testing::codes;
        let of = |attributes: &str| {
            format!(
                "<eml xmlns:x='urn:raconteur:eml:1'><head><x:performer {attributes}/></head>\
                 <body><null time='1'/></body></eml>"
            )
        };
        let parsed = crate::parse(&of("tilts='0.1' browShare='0.2' pitchThreshold='3' \
            accentGlances='0.4' pauseGlances='0.5' thinkingPause='1.5' thinking='0.6' frowns='0.7' \
            lickInterval='9' headByLoudness='0.8' browsByLoudness='0.9'"));
        assert_eq!(parsed.diagnostics, []);
        let p = parsed.document.performer.unwrap();
        assert_eq!(
            [
                p.tilt_share,
                p.brow_share,
                p.pitch_threshold,
                p.accent_glances,
                p.pause_glances,
                p.thinking_secs,
                p.thinking_share,
                p.frown_share,
                p.lick_secs,
                p.head_by_loudness,
                p.brows_by_loudness,
            ],
            [0.1, 0.2, 3.0, 0.4, 0.5, 1.5, 0.6, 0.7, 9.0, 0.8, 0.9].map(Some)
        );
        assert_eq!(codes(&of("frowns='1.5'"))[0], "eml::out-of-range");
    }
}

//! `environment`, `piece`: the expression of emotions by camera, light and music, and the set of
//! the story.

use super::{Attribute, Content, Element, Kind};
use crate::{Arousal, Fidelity, StageSet, Valence};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Chooses the set of the story, and disables channels by which the environment expresses emotions.",
    ),
    decision: super::reference_text(
        "All three channels are enabled by default. r:camera, r:light and r:music override their channel until one of them with by='emotion' returns control.",
    ),
    source: super::reference_text("Extension; GEVH 3.5.4"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:environment set='fireside' music='false'/></head><body><null time='1'/></body></eml>",
    ),
    extension: true,
    content: Content::Elements,
    max_per_parent: Some(1),
    attributes: &[
        Attribute::flag(
            "camera",
            "Whether the strongest emotion controls distance and angle of the camera.",
        )
        .default("true"),
        Attribute::flag(
            "light",
            "Whether the strongest emotion controls colour and brightness of the light.",
        )
        .default("true"),
        Attribute::flag("music", "Whether the mood controls the music.").default("true"),
        Attribute::choice("set", StageSet::WORDS, "The set of the story.").default("curtain"),
        Attribute::choice(
            "fidelity",
            Fidelity::WORDS,
            "How closely the lighting follows the thesis: `stage`, scaled so that the face stays readable and no emotion starts with a jump; `thesis`, the full colours of table 3.2, the unmodified attenuations of equations 3.1 and 3.2 (a strong negative emotion is dark), and a key light between figure and camera.",
        )
        .default("stage"),
        Attribute::integer(
            "seed",
            0,
            1_000_000,
            "The random seed that draws the music of each valence from the library's three pieces. By default the host chooses it.",
        ),
    ],
    ..Element::part("environment", &["head"])
};

pub(super) static PIECE: Element = Element {
    doc: super::reference_text("A piece of music that replaces the library's in a mood."),
    decision: super::reference_text(
        "It repeats when it ends. If there are pieces for both low and high arousal of a mood, each plays in its own.",
    ),
    source: super::reference_text("Extension; GEVH 3.5.4.3"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:environment><r:piece valence='positive' file='music/reel.opus' bar='1.5'/></r:environment></head><body><null time='1'/></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::choice("valence", Valence::WORDS, "The mood in which it plays.").required(),
        Attribute::choice(
            "arousal",
            Arousal::WORDS,
            "The arousal of that mood; any by default.",
        ),
        Attribute::new("file", Kind::Path, "A file next to the story.").required(),
        Attribute::seconds_up_to(
            "bar",
            60.0,
            "The length of a bar: pieces change at bar boundaries.",
        )
        .default("2"),
    ],
    ..Element::part("piece", &["environment"])
};

#[cfg(test)]
mod tests {
    use crate::{Arousal, StageSet, Valence, parse};

    #[test]
    fn channels_are_on_until_one_says_otherwise() {
        let text = "<eml xmlns:x='urn:raconteur:eml:1'><head><x:environment light='false' set='night'>\
                    <x:piece valence='negative' arousal='high' file='music/storm.opus'/>\
                    </x:environment></head><body><null time='1'/></body></eml>";
        let parsed = parse(text);
        assert_eq!(parsed.diagnostics, []);
        let environment = parsed.document.environment.expect("an environment");
        let channels = (environment.camera, environment.light, environment.music);
        assert_eq!(channels, (true, false, true));
        assert_eq!(environment.set, StageSet::Night);
        let piece = &environment.pieces[0];
        let mood = (piece.valence, piece.arousal, piece.bar_secs);
        assert_eq!(mood, (Valence::Negative, Some(Arousal::High), 2.0));
    }
}

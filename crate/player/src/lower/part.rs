//! A script lowered for one figure: what it asks of arms and voice, and what it tells.

use raconteur_actor::animation::PlayerCommand;
use raconteur_actor::gesture::TrunkShape;
use raconteur_actor::parameters::ParameterCommand;
use raconteur_actor::{
    Accent, ArmScript, GestureStroke, Library, ManipulatorScript, ParameterScript, Performance,
    PlayerScript, Sex, SpokenUtterance,
};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Side};
use raconteur_speech::bundle::Voice;
use raconteur_speech::{Phone, Utterance, Word};

use crate::lower::animations;
use crate::lower::cues::{self, Cue, UtteranceCue};
use crate::lower::feelings::{self, Felt};
use crate::lower::geometry::{self, Switch};
use crate::lower::gestures::{self, Hands};
use crate::lower::manipulators;
use crate::lower::music::{self, MusicClause};
use crate::lower::script::Script;
use crate::lower::units::Units;
use crate::lower::views::{self, ShotCue};
use crate::options::Options;

/// How strong the accents of an emphasised word are; 1 is an ordinary accent. Designed.
const EMPHASIS_ACCENT: f64 = 1.4;
/// How long a syllable is at most in a word that was not baked, seconds. Designed.
const SYLLABLE_SECS: f64 = 0.3;

/// A story, or a fragment of a live performance, at its times.
pub(crate) struct Part {
    /// Strokes of the left and right arm.
    pub(crate) strokes: [Vec<GestureStroke>; 2],
    /// What manipulators are asked for.
    pub(crate) manipulators: ManipulatorScript,
    /// When gestures are turned on and off, by time.
    switches: Vec<(f64, bool)>,
    /// What animation players are asked for, by time.
    pub(crate) players: Vec<(f64, PlayerCommand)>,
    /// What of the figure is drawn, by time.
    pub(crate) geometry: Vec<Switch>,
    speech: Vec<SpokenUtterance>,
    /// What is felt, and what control parameters are asked for.
    pub(crate) felt: Felt,
    /// Shots of the camera, by time.
    pub(crate) shots: Vec<ShotCue>,
    /// Music, by time.
    pub(crate) music: Vec<MusicClause>,
    /// What is said, by time.
    pub(crate) utterances: Vec<UtteranceCue>,
    /// What listeners are told, by time.
    pub(crate) cues: Vec<Cue>,
}

impl Part {
    /// Lowers a script. `first_utterance` is the index of its first utterance, `fragment` the
    /// number of a live fragment.
    pub(crate) fn new(
        script: &Script,
        units: &Units,
        hands: Hands,
        first_utterance: usize,
        fragment: Option<u32>,
    ) -> Self {
        let (document, timeline) = (&script.document, &script.timeline);
        let utterances = cues::utterances(script);
        Self {
            strokes: Side::BOTH
                .map(|side| gestures::strokes(document, timeline, side, units, hands)),
            manipulators: manipulators::script(document, timeline, units),
            switches: gestures::switches(document, timeline),
            players: animations::commands(document, timeline).0,
            geometry: geometry::switches(document, timeline),
            speech: utterances.iter().map(|u| spoken(script, u)).collect(),
            felt: feelings::lower(script, &utterances),
            shots: views::shots(script),
            music: music::clauses(script),
            cues: cues::cues(script, &utterances, first_utterance, fragment),
            utterances,
        }
    }
}

/// What parts that are forgotten have asked for and what stays, by time.
#[derive(Default)]
pub(crate) struct Carried {
    /// Of animation players.
    pub(crate) players: Vec<(f64, PlayerCommand)>,
    /// Of control parameters.
    pub(crate) parameters: Vec<(f64, ParameterCommand)>,
}

/// What the figure does when all parts are performed together.
pub(crate) fn performance<'a>(
    parts: impl Iterator<Item = &'a Part> + Clone,
    carried: &Carried,
    library: &Library,
    options: &Options,
    trunk: TrunkShape,
    sex: Sex,
    listener_in_world: DVec3,
) -> Performance {
    let mut switches: Vec<(f64, bool)> = parts
        .clone()
        .flat_map(|p| p.switches.iter().copied())
        .collect();
    sort_by_number(&mut switches, |(time_secs, _)| *time_secs);
    let on = gestures::on_spans(&switches);
    let character = parts.clone().find_map(|p| p.felt.character.as_ref());
    let players = parts.clone().flat_map(|p| p.players.iter());
    let parameters = parts.clone().flat_map(|p| p.felt.parameters.iter());
    Performance {
        players: PlayerScript {
            commands: carried.players.iter().chain(players).cloned().collect(),
        },
        emotions: parts
            .clone()
            .flat_map(|p| p.felt.emotions.iter().copied())
            .collect(),
        parameters: ParameterScript {
            commands: carried
                .parameters
                .iter()
                .chain(parameters)
                .cloned()
                .collect(),
        },
        library: library.clone(),
        arms: Side::BOTH.map(|side| ArmScript {
            strokes: parts
                .clone()
                .flat_map(|p| p.strokes[side.index()].iter().cloned())
                .collect(),
            on: on.clone(),
        }),
        manipulators: manipulators::together(parts.clone().map(|p| &p.manipulators)),
        speech: parts.flat_map(|p| p.speech.iter().cloned()).collect(),
        seed: options.seed,
        motion_amount: options.motion_amount,
        manner: character.map_or(options.manner, |of| feelings::manner(of, options.manner)),
        listener_in_world,
        sex,
        dominant: options.handedness.unwrap_or(Side::Right),
        trunk: Some(trunk),
        welcomes: false,
    }
}

/// Whether a script asks anything of manipulators.
pub(crate) fn is_asked(script: &ManipulatorScript) -> bool {
    !(script.commands.is_empty() && script.moves.is_empty())
}

/// What the actor needs to know of an utterance: phones for the lips, words, and what the
/// bundle tells of its melody.
fn spoken(script: &Script, cue: &UtteranceCue) -> SpokenUtterance {
    let phones = script.phones(cue.clause);
    let baked = script.utterance(cue.clause);
    let melody = baked.cloned().unwrap_or_default();
    SpokenUtterance {
        start_secs: cue.start_secs,
        duration_secs: cue.duration_secs,
        phones: match script.voice(cue.clause) {
            Some(voice) => phones.iter().map(|p| seen(p, voice)).collect(),
            None => murmured(cue),
        },
        words: cue
            .words
            .iter()
            .map(|w| Word {
                text: w.text.clone(),
                start_secs: w.start_secs - cue.start_secs,
                end_secs: w.end_secs - cue.start_secs,
            })
            .collect(),
        accents: accents(baked, cue),
        phrases: melody.phrases,
        sentences: melody.sentences,
        emotions: melody.emotions,
        f0: melody.f0,
        intensity: melody.intensity,
    }
}

/// Accented syllables; where none are known, the beginnings of emphasised words.
fn accents(baked: Option<&Utterance>, cue: &UtteranceCue) -> Vec<Accent> {
    let is_emphasized = |word: usize| cue.words.get(word).is_some_and(|w| w.emphasized);
    let known = baked.into_iter().flat_map(|u| {
        u.accents.iter().filter_map(move |accent| {
            let syllable = u.syllables.get(accent.syllable)?;
            let phones = u
                .phones
                .get(syllable.first_phone..)?
                .get(..syllable.phones)?;
            let (first, last) = phones.first().zip(phones.last())?;
            let strong = first.word.is_some_and(is_emphasized);
            Some(Accent {
                start_secs: first.start_secs,
                end_secs: last.end_secs,
                strength: if strong { EMPHASIS_ACCENT } else { 1.0 },
                label: accent.label.clone(),
            })
        })
    });
    let known: Vec<Accent> = known.collect();
    if !known.is_empty() {
        return known;
    }
    let written = cue.words.iter().filter(|w| w.emphasized);
    written
        .map(|w| {
            let start_secs = w.start_secs - cue.start_secs;
            Accent {
                start_secs,
                end_secs: start_secs + (w.end_secs - w.start_secs).min(SYLLABLE_SECS),
                strength: EMPHASIS_ACCENT,
                label: String::new(),
            }
        })
        .collect()
}

/// A phone as the mouth knows it.
fn seen(phone: &Phone, voice: &Voice) -> Phone {
    Phone {
        symbol: voice.row(&phone.symbol).to_owned(),
        ..phone.clone()
    }
}

/// Phones for a text that was not baked, so that the lips move with the captions: one
/// consonant and one vowel for every three letters of a word. Designed; a diagnostic has
/// said that the voice is missing.
fn murmured(cue: &UtteranceCue) -> Vec<Phone> {
    const SYLLABLES: [[&str; 2]; 4] = [["m", "aa"], ["d", "eh"], ["s", "iy"], ["n", "ow"]];
    let mut phones = Vec::new();
    let mut push = |symbol: &str, start_secs: f64, end_secs: f64, word: Option<usize>| {
        if end_secs > start_secs {
            phones.push(Phone {
                symbol: symbol.to_owned(),
                start_secs,
                end_secs,
                word,
            });
        }
    };
    let mut now = 0.0;
    for (index, word) in cue.words.iter().enumerate() {
        let (start, end) = (
            word.start_secs - cue.start_secs,
            word.end_secs - cue.start_secs,
        );
        push("pau", now, start, None);
        let letters = word.text.chars().filter(|c| c.is_alphanumeric()).count();
        let syllables = letters.div_ceil(3).clamp(1, 8);
        let step = (end - start) / syllables as f64;
        for s in 0..syllables {
            let from = start + step * s as f64;
            let [consonant, vowel] = SYLLABLES[(index + s) % SYLLABLES.len()];
            push(consonant, from, from + 0.4 * step, Some(index));
            push(vowel, from + 0.4 * step, from + step, Some(index));
        }
        now = end;
    }
    push("pau", now, cue.duration_secs, None);
    phones
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_body::Skeleton;
    use raconteur_speech::bundle::SentenceKind;

    /// The speech of a story that is shipped.
    fn speech(eml: &str, bundle: Option<&str>) -> Vec<SpokenUtterance> {
        let script = Script::read(eml, bundle.map(str::as_bytes));
        let hands = Hands::of(&script.document, None, Side::Right);
        Part::new(&script, &Units::of(&Skeleton::example()), hands, 0, None).speech
    }

    #[test]
    fn the_actor_learns_the_melody_of_what_was_baked() {
        let eml = include_str!("../../../../assets/stories/hello-world/story.eml");
        let json = include_str!("../../../../assets/stories/hello-world/voice/speech.json");
        let speech = speech(eml, Some(json));
        let u = &speech[0];
        assert_eq!(u.accents.len(), 2);
        for (accent, word) in u.accents.iter().zip(&u.words) {
            assert_eq!(accent.label, "H*");
            assert!(word.start_secs <= accent.start_secs && accent.end_secs <= word.end_secs);
        }
        assert_eq!(
            (u.phrases.len(), u.sentences[0].kind),
            (1, SentenceKind::Exclamation)
        );
        let frames = 100.0 * u.duration_secs;
        for track in [&u.f0, &u.intensity] {
            assert!((track.len() as f64 - frames).abs() < 3.0);
        }
    }

    #[test]
    fn what_was_not_baked_has_the_accents_that_are_written() {
        let eml = "<eml><body><voice-text>one <emph>two</emph> three</voice-text></body></eml>";
        let speech = speech(eml, None);
        let u = &speech[0];
        assert_eq!(u.accents.len(), 1);
        assert_eq!(u.accents[0].start_secs, u.words[1].start_secs);
        assert!(u.accents[0].strength > 1.0 && u.f0.is_empty());
    }
}

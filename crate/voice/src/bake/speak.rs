//! One utterance from its content to its audio.

use crate::assemble::{Recording, Speech, SpokenSentence, assemble};
use crate::content::{Age, Content, Gender, Setting, Speaker};
use crate::delivery::deliver;
use crate::emotion::{emotion_spans, moved_pauses, place_of, word_phrases};
use crate::plan::{Plan, Planned, plan};
use crate::prosody::Prosody;
use crate::realise::{VoiceBaseline, realise};
use crate::signal::f0::{self, PitchTrack};
use crate::signal::{resample, rms};
use crate::spoken::{Sentence, Spoken, SpokenSyllable};
use crate::style::{NO_EMPHASIS, Style};
use crate::text::Lexicon;
use anyhow::{Context as _, Result};
use raconteur_base::text::script::Script;
use raconteur_speech::bundle::FRAME_SECS;
use raconteur_speech::emotion::EmotionPoint;
use raconteur_speech::phones::{find, translate};

use super::STORY_PACE;
use super::cast::{Cast, Role};

/// Loudness of plain speech without its pauses, root mean square against full scale: as loud
/// as leaves room for speech at twice the loudness.
const LOUDNESS: f64 = 0.065;

/// Conversion of an adult voice to other ages: factors for the vocal tract resonances, for the
/// pitch of a man's and of a woman's voice, and for the speech rate. Resonances follow the length
/// of the vocal tract, which is 17 cm in men, 14.5 in women and about 12 in children of seven (Fant
/// 1960; Fitch and Giedd 1999, doi:10.1121/1.427148); pitch as measured for ages by Lee, Potamianos
/// and Narayanan 1999, doi:10.1121/1.426686. Old age is *designed*.
const AGES: [(Age, f64, f64, f64, f64); 5] = [
    (Age::Child, 1.18, 1.9, 1.35, 0.95),
    (Age::Teen, 1.08, 1.3, 1.1, 1.0),
    (Age::Younger, 1.0, 1.05, 1.03, 1.03),
    (Age::Middle, 1.0, 1.0, 1.0, 1.0),
    (Age::Older, 0.97, 0.9, 0.88, 0.9),
];

/// Content of an utterance with everything that affects its audio.
pub(super) struct RenderInput<'a> {
    /// Text and markup to speak.
    pub content: &'a Content,
    /// The voice, where the text names no other.
    pub role: &'a Role,
    /// Emotion in force: its name and its position in the emotion space; `None` for neutral speech.
    pub emotion: Option<&'a (String, EmotionPoint)>,
    /// Tension of the story, 0 to 1, if set by its author.
    pub tension: Option<f64>,
    /// Pace of everything; 1 is the voice's own.
    pub pace: f64,
}

/// Speech plan of an utterance with the voice of each sentence.
pub(super) struct Casting {
    pub plan: Plan,
    pub roles: Vec<Role>,
    /// Warnings about deviations from the author's request or unspoken text, with a fix.
    pub warnings: Vec<String>,
}

/// Plans an utterance.
///
/// # Errors
/// Returns an error if the utterance cannot be planned, or an engine is missing.
pub(super) fn cast(work: &RenderInput<'_>, cast: &Cast, lexicon: &Lexicon) -> Result<Casting> {
    // A voice named by a clause speaks its own language.
    let own = cast
        .language
        .as_ref()
        .filter(|_| *work.role == cast.primary);
    let language = own.unwrap_or(&work.role.voice.language);
    let mut plan = plan(work.content, language, &work.role.engine, lexicon)?;
    deliver(&mut plan, work.tension);
    let mut warnings = Vec::new();
    let mut roles = Vec::with_capacity(plan.sentences.len());
    let mut unread = Vec::new();
    for (at, planned) in plan.sentences.iter().enumerate() {
        let tag = planned.sentence.language.as_str();
        if let Some(script) = foreign_script(&planned.sentence, language)
            && !cast.speaks(work.role, tag)
        {
            let words = planned.sentence.tokens.iter().map(|t| t.text.as_str());
            warnings.push(format!(
                "{:?} is in {} and not said, only shown: no voice that is here speaks {tag:?}; \
                 espeak-ng speaks most languages",
                words.collect::<Vec<_>>().join(" "),
                script.name()
            ));
            unread.push(at);
            continue;
        }
        let role = match cast.role(work.role, &planned.speaker, tag) {
            Err(error) if planned.speaker.name.is_some() => {
                let nameless = Speaker {
                    name: None,
                    ..planned.speaker.clone()
                };
                let role = cast.role(work.role, &nameless, tag)?;
                warnings.push(format!("{error:#}; {} speaks instead", role.voice.name));
                role
            }
            role => role?,
        };
        roles.push(role);
    }
    for at in unread.into_iter().rev() {
        plan.sentences.remove(at);
    }
    warnings.dedup();
    Ok(Casting {
        plan,
        roles,
        warnings,
    })
}

/// Returns the script of a sentence if the `language` of its voice is written in another one;
/// otherwise `None`.
fn foreign_script(sentence: &Sentence, language: &str) -> Option<Script> {
    let token = sentence.tokens.first()?;
    Script::from_word(&token.text).filter(|script| !script.is_read_in(language))
}

/// Speaks a planned utterance. `recordings` returns those of the plan at a sample rate.
///
/// # Errors
/// Returns an error if an engine fails.
pub(super) fn speak(
    work: &RenderInput<'_>,
    casting: &Casting,
    cast: &Cast,
    recordings: &dyn Fn(f64) -> Result<Vec<Recording>>,
) -> Result<Speech> {
    let Casting { plan, roles, .. } = casting;
    let mut spoken = by_role(&plan.sentences, roles, work.pace, cast)?;
    let rate_hz = rate_of(spoken.iter().map(|s| s.rate_hz));
    for (one, role) in spoken.iter_mut().zip(roles) {
        one.samples = resample(&one.samples, one.rate_hz, rate_hz);
        one.rate_hz = rate_hz;
        if one.phone_set.is_empty() {
            one.phone_set.clone_from(&role.voice.phone_set);
        }
    }
    level(&mut spoken, roles);
    // The speaker's size is applied before everything else.
    let ages: Vec<SpeakerVoice> = plan
        .sentences
        .iter()
        .zip(roles)
        .map(|(planned, role)| SpeakerVoice::for_role(planned, role))
        .collect();
    for (one, voicing) in spoken.iter_mut().zip(&ages) {
        voicing.resize(one);
    }
    let tracks: Vec<PitchTrack> = spoken
        .iter()
        .map(|s| f0::track_voice(&s.samples, s.rate_hz, FRAME_SECS))
        .collect();
    for ((one, planned), track) in spoken.iter_mut().zip(&plan.sentences).zip(&tracks) {
        accents(one, planned, track);
    }
    let phrases = word_phrases(&plan.sentences, &spoken);
    let emotions = emotion_spans(plan, &phrases, work.emotion);
    let place = |word: usize| place_of(&emotions, word);
    let moved = moved_pauses(&plan.sentences, &spoken, &place);
    let mut parts = Vec::with_capacity(spoken.len());
    for (i, (planned, moved_pauses)) in plan.sentences.iter().zip(moved).enumerate() {
        // Absolute values are relative to this voice in this utterance.
        let same = (0..spoken.len()).filter(|k| roles[*k] == roles[i] && ages[*k] == ages[i]);
        let own = VoiceBaseline::measure(same.map(|k| (&spoken[k], &tracks[k])));
        let engine = cast.engine(&roles[i])?;
        let feeling = engine.feeling();
        // The engine's own changes are not repeated.
        let pace = match engine.keeps_pace() {
            true => 1.0,
            false => work.pace * planned.sentence.pace,
        };
        let styles: Vec<Style> = planned
            .sentence
            .tokens
            .iter()
            .map(|t| ages[i].applied(&plan.styles[t.style], pace))
            .collect();
        let styled: Vec<(&Style, EmotionPoint)> = styles
            .iter()
            .zip(&planned.sentence.tokens)
            .map(|(style, token)| (style, place(token.word).scaled(feeling)))
            .collect();
        let mut spoken = realise(&spoken[i], &tracks[i], &styled, &own);
        guest(&mut spoken, &work.role.voice.phone_set);
        parts.push(SpokenSentence {
            spoken,
            // The lengths of pauses are a storyteller's, for any engine.
            pauses: pauses(&styled, &own) * pace * STORY_PACE / work.pace,
            moved_pauses,
        });
    }
    Ok(assemble(
        plan,
        &parts,
        &recordings(rate_hz)?,
        &emotions,
        rate_hz,
    ))
}

/// Converts the phones of a guest, who may speak another language, to the symbols of the bundle's
/// voice, where it has equivalents.
fn guest(spoken: &mut Spoken, phone_set: &str) {
    if spoken.phone_set == phone_set {
        return;
    }
    for segment in spoken.segments.iter_mut().filter(|s| !s.is_silent()) {
        if let Some(symbol) = translate(&spoken.phone_set, &segment.symbol, phone_set) {
            symbol.clone_into(&mut segment.symbol);
        }
    }
    phone_set.clone_into(&mut spoken.phone_set);
}

/// Returns the factor for pauses not set by the text: slow speech has longer pauses.
fn pauses(styled: &[(&Style, EmotionPoint)], own: &VoiceBaseline) -> f64 {
    let one = |(style, place): &(&Style, EmotionPoint)| {
        let prosody = Prosody::from_point(*place);
        prosody.pause_duration / (style.rate.factor_on(own.words_a_minute) * prosody.rate)
    };
    styled.iter().map(one).sum::<f64>() / styled.len().max(1) as f64
}

/// Adds accents: emphasised words are accented at their stress, reduced ones are not. If an engine
/// reports no accents, stressed syllables are accented; if it reports no stress either, the highest
/// syllable of each word of more than three phones.
fn accents(spoken: &mut Spoken, planned: &Planned, track: &PitchTrack) {
    if spoken.syllables.iter().all(|s| s.stress == 0) {
        stress_highest(spoken, track);
    }
    let untold = spoken.syllables.iter().all(|s| s.accent.is_empty());
    for syllable in &mut spoken.syllables {
        let token = spoken.segments.get(syllable.first).and_then(|s| s.token);
        let token = token.and_then(|t| planned.sentence.tokens.get(t));
        let emphasis = token.map_or(NO_EMPHASIS, |t| t.emphasis);
        if emphasis < NO_EMPHASIS {
            syllable.accent.clear();
        } else if syllable.accent.is_empty()
            && syllable.stress == 1
            && (untold || emphasis > NO_EMPHASIS)
        {
            "*".clone_into(&mut syllable.accent);
        }
    }
}

fn stress_highest(spoken: &mut Spoken, track: &PitchTrack) {
    let tokens = spoken.segments.iter().filter_map(|s| s.token).max();
    for token in 0..=tokens.unwrap_or(0) {
        let phones = spoken.segments.iter().filter(|s| s.token == Some(token));
        if phones.count() <= 3 {
            continue;
        }
        let height = |s: &SpokenSyllable| {
            let end = |i: usize| spoken.segments.get(i).map_or(0.0, |s| s.end_secs);
            let start = s.first.checked_sub(1).map_or(0.0, end);
            let stop = end((s.first + s.count).max(1) - 1);
            let own = spoken.segments.get(s.first).and_then(|s| s.token);
            (own == Some(token)).then(|| track.hz_near((start + stop) / 2.0, 0.05))
        };
        let highest = spoken
            .syllables
            .iter()
            .enumerate()
            .filter_map(|(i, s)| Some((height(s)?, i)))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, highest)) = highest {
            spoken.syllables[highest].stress = 1;
        }
    }
}

/// Returns the sample rate of an utterance, Hz: one that MPEG-1 layer III supports, which all
/// browsers play.
fn rate_of(rates: impl Iterator<Item = f64>) -> f64 {
    let most = rates.fold(0.0, f64::max);
    if most > 32_000.0 { 48_000.0 } else { 32_000.0 }
}

/// Speaks runs of sentences of one voice together. Emphasis is applied to the audio; the engine's
/// own treatment of it is not reported.
fn by_role(sentences: &[Planned], roles: &[Role], pace: f64, cast: &Cast) -> Result<Vec<Spoken>> {
    let mut out = Vec::with_capacity(sentences.len());
    let mut from = 0;
    while from < sentences.len() {
        let role = &roles[from];
        let to = from + roles[from..].iter().take_while(|r| *r == role).count();
        let asked: Vec<Sentence> = sentences[from..to]
            .iter()
            .map(|s| {
                let mut sentence = s.sentence.clone();
                sentence.pace *= pace;
                let tokens = sentence.tokens.iter_mut();
                tokens.for_each(|t| t.emphasis = NO_EMPHASIS);
                sentence
            })
            .collect();
        let spoken = cast
            .engine(role)?
            .speak(&role.voice.name, &asked)
            .with_context(|| format!("{} with the voice {}", role.engine, role.voice.name))?;
        anyhow::ensure!(
            spoken.len() == asked.len(),
            "{} spoke {} of {} sentences",
            role.engine,
            spoken.len(),
            asked.len()
        );
        out.extend(spoken);
        from = to;
    }
    Ok(out)
}

/// Makes all voices equally loud, each over all its sentences.
fn level(spoken: &mut [Spoken], roles: &[Role]) {
    for role in roles {
        let mut speech = Vec::new();
        for (one, _) in spoken.iter().zip(roles).filter(|(_, r)| *r == role) {
            let mut start = 0;
            for segment in &one.segments {
                let end = ((segment.end_secs * one.rate_hz) as usize).min(one.samples.len());
                if !segment.is_silent() && start < end {
                    speech.extend_from_slice(&one.samples[start..end]);
                }
                start = end;
            }
        }
        let power = rms(&speech);
        if power > 0.0 {
            let gain = LOUDNESS / power;
            for (one, _) in spoken.iter_mut().zip(roles).filter(|(_, r)| *r == role) {
                one.samples.iter_mut().for_each(|s| *s *= gain);
            }
        }
    }
}

/// Voice modified for a speaker's age.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SpeakerVoice {
    /// Factor on the resonance frequencies of the vocal tract.
    resonance: f64,
    pitch: f64,
    pace: f64,
}

impl SpeakerVoice {
    fn for_role(planned: &Planned, role: &Role) -> Self {
        let age = planned.speaker.age;
        let found = AGES.iter().find(|(a, ..)| Some(*a) == age);
        let (_, resonance, man, woman, pace) = found.copied().unwrap_or(AGES[3]);
        Self {
            resonance,
            pitch: if role.voice.gender == Some(Gender::Female) {
                woman
            } else {
                man
            },
            pace,
        }
    }

    /// Plays the sound faster, which makes the mouth smaller, the pitch higher and the words
    /// shorter; the last two are made good again by [`SpeakerVoice::applied`].
    fn resize(&self, spoken: &mut Spoken) {
        if self.resonance == 1.0 {
            return;
        }
        spoken.samples = resample(
            &spoken.samples,
            spoken.rate_hz * self.resonance,
            spoken.rate_hz,
        );
        for segment in &mut spoken.segments {
            segment.end_secs /= self.resonance;
        }
    }

    fn applied(&self, style: &Style, pace: f64) -> Style {
        let mut style = style.clone();
        let pitch = Setting::Factor(self.pitch / self.resonance);
        // Requested values refer to the voice as heard, not to the modified one. A base line alone
        // moves everything with it and stays alone.
        let lines = match (
            style.pitch_base.is_default(),
            style.pitch_middle.is_default(),
        ) {
            (false, true) => vec![&mut style.pitch_base],
            (true, _) => vec![&mut style.pitch_middle],
            (false, false) => vec![&mut style.pitch_base, &mut style.pitch_middle],
        };
        for amount in lines {
            if amount.value.is_none() && self.pitch != self.resonance {
                *amount = amount.with(pitch);
            }
        }
        if style.rate.value.is_none() && (self.resonance, self.pace, pace) != (1.0, 1.0, 1.0) {
            style.rate = style
                .rate
                .with(Setting::Factor(self.pace * pace / self.resonance));
        }
        style
    }
}

/// Returns a recorded utterance: only the loudness of its audio is changed.
pub(super) fn recorded(
    plan: &Plan,
    mut spoken: Spoken,
    elicited: Option<&(String, EmotionPoint)>,
) -> Speech {
    let rate_hz = rate_of([spoken.rate_hz].into_iter());
    spoken.samples = resample(&spoken.samples, spoken.rate_hz, rate_hz);
    spoken.rate_hz = rate_hz;
    // Alignments come in many phone sets; the bundle's voice has one.
    for segment in &mut spoken.segments {
        if let Some(row) = find(&spoken.phone_set, &segment.symbol)
            && !segment.is_silent()
        {
            row.name.clone_into(&mut segment.symbol);
        }
    }
    let role = Role::default();
    level(core::slice::from_mut(&mut spoken), &[role]);
    let whole = Planned {
        sentence: Sentence {
            tokens: plan
                .sentences
                .iter()
                .flat_map(|s| s.sentence.tokens.iter().cloned())
                .collect(),
            ..plan
                .sentences
                .last()
                .map(|s| s.sentence.clone())
                .unwrap_or_default()
        },
        pauses: Vec::new(),
        ..Planned::default()
    };
    let plan = Plan {
        sentences: vec![whole],
        sounds: Vec::new(),
        lead_pause_secs: 0.0,
        ..plan.clone()
    };
    let phrases = word_phrases(&plan.sentences, core::slice::from_ref(&spoken));
    let emotions = emotion_spans(&plan, &phrases, elicited);
    let part = SpokenSentence {
        spoken,
        pauses: 1.0,
        moved_pauses: Vec::new(),
    };
    assemble(&plan, &[part], &[], &emotions, rate_hz)
}

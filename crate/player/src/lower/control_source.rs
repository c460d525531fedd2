//! Control of an environment channel over time: the script where it specifies a value, otherwise
//! the strongest emotion (GEVH 3.5.4).

use raconteur_base::order::sort_by_number;
use raconteur_eml::{ControlSource, Document, Fidelity};
use raconteur_stage::{EmotionEnvelope, EmotionTimeline};

/// Environment channels (camera, light, music) that express emotions: enabled or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Channels {
    pub(crate) camera: bool,
    pub(crate) light: bool,
    /// The light is that of the thesis, to the letter.
    pub(crate) strict_light: bool,
    pub(crate) music: bool,
}

impl Channels {
    /// Returns the channels of a script; all if unspecified.
    pub(crate) fn from_document(document: &Document) -> Self {
        let on = |of: fn(&raconteur_eml::Environment) -> bool| {
            document.environment.as_ref().is_none_or(of)
        };
        Self {
            camera: on(|e| e.camera),
            light: on(|e| e.light),
            strict_light: document
                .environment
                .as_ref()
                .is_some_and(|e| e.fidelity == Fidelity::Thesis),
            music: on(|e| e.music),
        }
    }
}

/// Current controller of an environment channel: a script clause, by its index, or the strongest
/// emotion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ActiveControl {
    /// A cue of the script, by index.
    Script(usize),
    /// The strongest emotion; `None` for no emotion.
    Emotion(Option<EmotionEnvelope>),
}

/// Returns the controllers of a channel, by time. `cues` are the times of the script's cues with
/// the controller from then on, by time; `follows` is true if emotions control it initially. An
/// emotion holds control for at least `least_secs` unless the script takes it, and as long as its
/// successor is the `same`. Later events never change earlier results.
pub(crate) fn leaders(
    cues: &[(f64, ControlSource)],
    feelings: &EmotionTimeline,
    follows: bool,
    least_secs: f64,
    same: impl Fn(Option<&EmotionEnvelope>, Option<&EmotionEnvelope>) -> bool,
) -> Vec<(f64, ActiveControl)> {
    let felt = feelings.all();
    let mut times: Vec<(f64, Option<usize>)> = felt
        .iter()
        .flat_map(|f| [f.start_secs, f.in_force_until_secs()])
        .map(|t| (t, None))
        .chain(cues.iter().enumerate().map(|(i, (t, _))| (*t, Some(i))))
        .collect();
    sort_by_number(&mut times, |(t, _)| *t);
    let mut taken = Vec::new();
    let mut by_script = !follows;
    let mut now: Option<EmotionEnvelope> = None;
    let (mut since_secs, mut due_secs) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut next = times.into_iter().peekable();
    loop {
        let event = next.next_if(|(t, _)| *t <= due_secs);
        let (t, cue) = match event {
            Some(event) => event,
            None if due_secs.is_finite() => (std::mem::replace(&mut due_secs, f64::INFINITY), None),
            None => break,
        };
        if let Some(i) = cue {
            by_script = cues[i].1 == ControlSource::Script;
            if by_script {
                taken.push((t, ActiveControl::Script(i)));
                due_secs = f64::INFINITY;
                continue;
            }
            // Emotions take over again, from the last value of the script.
            now = feelings.strongest(t, None);
            (since_secs, due_secs) = (t, f64::INFINITY);
            taken.push((t, ActiveControl::Emotion(now)));
            continue;
        }
        if by_script {
            continue;
        }
        let strongest = feelings.strongest(t, now.as_ref());
        if same(now.as_ref(), strongest.as_ref()) {
            continue;
        }
        if t < since_secs + least_secs {
            due_secs = since_secs + least_secs;
            continue;
        }
        now = strongest;
        (since_secs, due_secs) = (t, f64::INFINITY);
        taken.push((t, ActiveControl::Emotion(now)));
    }
    taken
}

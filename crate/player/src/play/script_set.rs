//! All performed parts: the story, and the fragments that have joined it.

use raconteur_actor::Library;
use raconteur_base::order::sort_by_number;
use raconteur_stage::EmotionTimeline;

use crate::live::{self, LivePerformance};
use crate::lower::cues::{Cue, UtteranceCue};
use crate::lower::expressed_emotion;
use crate::lower::moods::MoodMusic;
use crate::lower::music::{self, MusicCue};
use crate::lower::music_stem::MusicClause;
use crate::lower::plan::ScriptPlan;

/// Everything that is performed: the story and the live fragments that have joined it.
pub(crate) struct ScriptSet {
    pub(crate) story: ScriptPlan,
    pub(crate) live: LivePerformance,
}

impl ScriptSet {
    pub(crate) fn new(story: ScriptPlan) -> Self {
        Self {
            live: LivePerformance::new(story.utterances.len()),
            story,
        }
    }

    /// Returns the story and the live fragments, in order of arrival.
    pub(crate) fn plans(&self) -> impl Iterator<Item = &ScriptPlan> + Clone {
        [&self.story].into_iter().chain(self.live.plans())
    }

    /// Returns an utterance by its index, from the story or from the remembered live fragments.
    pub(crate) fn utterance(&self, index: usize) -> Option<&UtteranceCue> {
        let live = || self.live.utterances().find(|(i, _)| *i == index);
        self.story
            .utterances
            .get(index)
            .or_else(|| live().map(|(_, u)| u))
    }

    /// Returns the utterance audible at a time, with its index; of several, the last to begin.
    pub(crate) fn utterance_at(&self, time_secs: f64) -> Option<(usize, &UtteranceCue)> {
        let story = &self.story.utterances;
        let begun = story.partition_point(|u| u.timed.start_secs <= time_secs);
        let last = begun.checked_sub(1).map(|i| (i, &story[i]));
        let is_heard = |u: &UtteranceCue| {
            let offset_secs = u.timed.offset_secs(time_secs);
            (0.0..u.timed.utterance.duration_secs).contains(&offset_secs)
        };
        last.into_iter()
            .chain(self.live.utterances())
            .filter(|(_, u)| is_heard(u))
            .max_by(|(_, a), (_, b)| a.timed.start_secs.total_cmp(&b.timed.start_secs))
    }

    /// Returns all emotions of a performance up to a time; `library` has the animations of control
    /// parameters.
    pub(crate) fn feelings(&self, library: &Library, end_secs: f64) -> EmotionTimeline {
        let parameters = self.live.carried().parameters.iter();
        let parameters = parameters.chain(self.plans().flat_map(|p| &p.face.parameters));
        let led = expressed_emotion::of_parameters(parameters, library, end_secs);
        let spans = self.plans().flat_map(|p| &p.face.emotions);
        EmotionTimeline::new(spans.filter_map(expressed_emotion::of_span).chain(led))
    }

    /// Returns the music of all scripts and of moods up to a time, sorted by time.
    pub(crate) fn music(&self, feelings: &EmotionTimeline, end_secs: f64) -> Vec<MusicCue> {
        let plans = self.plans();
        let mut clauses: Vec<MusicClause> = plans
            .clone()
            .flat_map(|p| p.music.iter().cloned())
            .collect();
        sort_by_number(&mut clauses, |c| c.start_secs);
        let scoring = MoodMusic {
            emotions: feelings,
            repertoire: self.story.repertoire,
            own: &self.story.pieces,
            follows: self.story.channels.music,
            end_secs,
        };
        music::cues(&scoring.music(clauses), plans.flat_map(|p| &p.utterances))
    }

    /// Returns the cues after the first time up to and including the second, sorted by time.
    pub(crate) fn take_cues(&mut self, (from_secs, to_secs): (f64, f64)) -> Vec<Cue> {
        let mut cues = self.live.take_cues(from_secs, to_secs);
        cues.extend_from_slice(live::between(&self.story.cues, from_secs, to_secs));
        sort_by_number(&mut cues, |c| c.time_secs);
        cues
    }
}

//! Amounts and rates of a character's accompaniment of speech.

/// Source from which facial expressions of speech are planned: audio or text (F&H sections 4.2 and
/// 4.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanBasis {
    /// From the audio: fundamental frequency and pauses (section 4.2). An utterance of unknown
    /// frequency is planned from the text.
    #[default]
    Audio,
    /// Planned from accents, phrases and sentence types of the text (section 4.3).
    Text,
}

/// Amounts and frequencies of a character's non-verbal expressions. The default uses the published
/// numbers, where there are any; other numbers give other temperaments (section 4.2.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// Source of the plan.
    pub basis: PlanBasis,
    /// Amount of head raise and tilt, 0 to 1: at 1 the highest pitch raises it by
    /// [`HEAD_RAISE_RAD`](super::HEAD_RAISE_RAD).
    pub head: f64,
    /// Share of head raises with a tilt to one side (section 4.3.5: 0.75).
    pub tilt_share: f64,
    /// Amount of raising and drawing together the brows, 0 to 2.
    pub brows: f64,
    /// Share of the highest pitches at which the brows are raised (section 4.3.5 after Cavé et al.
    /// 1996: 0.71).
    pub brow_share: f64,
    /// Prominence of a pitch maximum over the neighbouring minima from which it is shown,
    /// semitones. Designed; F&H describe it as speaker-dependent.
    pub pitch_threshold: f64,
    /// Blinks, as a multiple of the natural frequency (22 a minute in speech, 17 in silence), 0 to 4.
    pub blinks: f64,
    /// Amount of gaze aversion, 0 to 2.
    pub gaze: f64,
    /// Share of accented syllables with a look at the listener (section 4.3.5: 0.7).
    pub accent_glances: f64,
    /// Share of pauses between intonational phrases with a look at the listener (section 4.3.5:
    /// 0.7).
    pub pause_glances: f64,
    /// Minimum length of a thinking pause inside a sentence, seconds. Designed; F&H describe it as
    /// speaker-dependent.
    pub thinking_secs: f64,
    /// Share of such pauses in which thinking is visible.
    pub thinking_share: f64,
    /// Share of these with a look at the floor and a frown, instead of a look up with raised brows
    /// (section 4.2.1: 0.25).
    pub frown_share: f64,
    /// Mean time between two moistenings of the lips in speech, seconds. Designed.
    pub lick_secs: f64,
    /// Influence of loudness on the head's raises, 0 to 1 (section 4.2.1). Designed.
    pub head_by_loudness: f64,
    /// Influence of loudness on the brow raises, 0 to 1 (section 4.2.1). Designed.
    pub brows_by_loudness: f64,
}

impl Default for Manner {
    fn default() -> Self {
        Self {
            basis: PlanBasis::Audio,
            head: 1.0,
            tilt_share: 0.75,
            brows: 1.0,
            brow_share: 0.71,
            pitch_threshold: 2.5,
            blinks: 1.0,
            gaze: 1.0,
            accent_glances: 0.7,
            pause_glances: 0.7,
            thinking_secs: 0.7,
            thinking_share: 1.0,
            frown_share: 0.25,
            lick_secs: 25.0,
            head_by_loudness: 0.4,
            brows_by_loudness: 0.25,
        }
    }
}

impl Manner {
    /// Returns the manner with every value clamped to its range; NaN becomes the minimum.
    #[must_use]
    pub(super) fn in_range(mut self) -> Self {
        // Comparisons with NaN are false, so NaN becomes the minimum.
        let within = |x: f64, least: f64, most: f64| if x > least { x.min(most) } else { least };
        for (amount, most) in [
            (&mut self.head, 1.0),
            (&mut self.tilt_share, 1.0),
            (&mut self.brows, 2.0),
            (&mut self.brow_share, 1.0),
            (&mut self.blinks, 4.0),
            (&mut self.gaze, 2.0),
            (&mut self.accent_glances, 1.0),
            (&mut self.pause_glances, 1.0),
            (&mut self.thinking_share, 1.0),
            (&mut self.frown_share, 1.0),
            (&mut self.head_by_loudness, 1.0),
            (&mut self.brows_by_loudness, 1.0),
        ] {
            *amount = within(*amount, 0.0, most);
        }
        self.pitch_threshold = within(self.pitch_threshold, 0.1, 24.0);
        self.thinking_secs = within(self.thinking_secs, 0.15, 60.0);
        self.lick_secs = within(self.lick_secs, 1.0, 3600.0);
        self
    }
}

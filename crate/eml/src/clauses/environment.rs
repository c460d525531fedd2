//! Extensions: the performer, emotions, and their expression by camera, light and music (GEVH 3.5.4
//! describes them without a syntax).

use crate::record::{record, words};
use raconteur_base::Side;

words! {
    /// Adjustment if a gesture begins before the hand can reach its start.
    RunUp {
        /// The whole script waits.
        Delay = "delay",
        /// The stroke is delayed.
        Late = "late",
        /// The hand is there all the same.
        Snap = "snap",
    }
}

words! {
    /// Source of the expressions that accompany speech.
    Expressions {
        /// The sound: its pitch and pauses (F&H section 4.2).
        Sound = "sound",
        /// The text: accents, phrases and kinds of sentences (F&H section 4.3).
        Text = "text",
    }
}

words! {
    /// The character's dominant hand.
    PreferredHand {
        /// The left one.
        Left = "left",
        /// The right one.
        Right = "right",
    }
}

impl PreferredHand {
    /// Returns the side of the body of the preferred hand.
    #[must_use]
    pub fn side(self) -> Side {
        match self {
            Self::Left => Side::Left,
            Self::Right => Side::Right,
        }
    }
}

record! {
    /// Performer of the script, with voice, language and manner.
    Performer = "performer" {
        /// Figure: a name in the library, or a file next to the story.
        figure: Option<String> = "figure",
        /// The voice's name.
        voice: Option<String> = "voice",
        /// The language of the speech, as in BCP 47.
        language: Option<String> = "language",
        /// The dominant hand.
        handedness: Option<PreferredHand> = "handedness",
        /// Source of the expressions that accompany speech.
        expressions: Option<Expressions> = "expressions",
        /// Formality of the occasion, 0 (casual) to 1 (formal).
        formality: Option<f64> = "formality",
        /// Amount of head raise and tilt with speech.
        head: Option<f64> = "head",
        /// Amount of brow movement with speech.
        brows: Option<f64> = "brows",
        /// Blink rate, relative to the natural frequency.
        blinks: Option<f64> = "blinks",
        /// Amount of gaze aversion.
        gaze: Option<f64> = "gaze",
        /// Share of head raises with a tilt to one side, 0 to 1.
        tilt_share: Option<f64> = "tilts",
        /// Share of the highest pitches at which the brows are raised, 0 to 1.
        brow_share: Option<f64> = "browShare",
        /// Prominence from which a pitch is shown, semitones.
        pitch_threshold: Option<f64> = "pitchThreshold",
        /// Share of accents with a look at the listener.
        accent_glances: Option<f64> = "accentGlances",
        /// Share of pauses between phrases with a look at the listener, 0 to 1.
        pause_glances: Option<f64> = "pauseGlances",
        /// Minimum length of a thinking pause, seconds.
        thinking_secs: Option<f64> = "thinkingPause",
        /// Share of such pauses in which thinking is visible.
        thinking_share: Option<f64> = "thinking",
        /// Share of these with a look down and a frown.
        frown_share: Option<f64> = "frowns",
        /// Mean time between two moistenings of the lips, seconds.
        lick_secs: Option<f64> = "lickInterval",
        /// Influence of the loudness on the head's raises.
        head_by_loudness: Option<f64> = "headByLoudness",
        /// Influence of the loudness on the brow raises, 0 to 1.
        brows_by_loudness: Option<f64> = "browsByLoudness",
    }
}

words! {
    /// Set in which the story takes place.
    StageSet {
        /// A theatre's curtain and boards.
        Curtain = "curtain",
        /// A room with a hearth.
        Fireside = "fireside",
        /// A lawn before a hedge.
        Garden = "garden",
        /// Night scene under the stars.
        Night = "night",
        /// A classroom.
        School = "school",
    }
}

words! {
    /// Adherence of the light to the thesis.
    Fidelity {
        /// Scaled so a face stays readable and nothing jumps.
        Stage = "stage",
        /// Lights exactly as specified in GEVH 3.5.4.2.
        Thesis = "thesis",
    }
}

words! {
    /// Arousal of a mood.
    Arousal {
        /// Calm.
        Low = "low",
        /// Excited.
        High = "high",
    }
}

record! {
    /// The author's music piece, which replaces the library's.
    Piece = "piece" {
        /// The mood in which it is played.
        valence: Valence = "valence",
        /// Arousal of that mood; none: any.
        arousal: Option<Arousal> = "arousal",
        /// A file next to the story.
        file: String = "file",
        /// Length of a bar, seconds: another piece takes over on a bar line.
        bar_secs: f64 = "bar",
    }
}

record! {
    /// Environment channels that express emotions (GEVH 3.5.4), and the set.
    Environment = "environment" {
        /// Enables the camera.
        camera: bool = "camera",
        /// Enables the light.
        light: bool = "light",
        /// Enables music.
        music: bool = "music",
        /// Set in which the story takes place.
        set: StageSet = "set",
        /// Adherence of the light to the thesis.
        fidelity: Fidelity = "fidelity",
        /// Random seed of the mood's music; none: chosen by the host of the story.
        seed: Option<u32> = "seed",
    }
    children {
        /// The author's own music.
        pieces: Vec<Piece>
    }
}

words! {
    /// Source of control for a channel of the environment from a clause on.
    ControlSource {
        /// The script's own values.
        Script = "script",
        /// The strongest emotion, or the mood.
        Emotion = "emotion",
    }
}

words! {
    /// The emotions of Ortony, Clore and Collins, additional ones named by F&H, and `neutral`.
    EmotionKind {
        /// No particular emotion.
        Neutral = "neutral",
        /// Joy.
        Joy = "joy",
        /// Distress.
        Distress = "distress",
        /// Pleased about another person's good fortune.
        HappyFor = "happy-for",
        /// Sorry about another person's misfortune.
        SorryFor = "sorry-for",
        /// Resentment.
        Resentment = "resentment",
        /// Gloating.
        Gloating = "gloating",
        /// Hope.
        Hope = "hope",
        /// Fear.
        Fear = "fear",
        /// Satisfaction.
        Satisfaction = "satisfaction",
        /// Confirmation of a fear.
        FearsConfirmed = "fears-confirmed",
        /// Relief.
        Relief = "relief",
        /// Disappointment.
        Disappointment = "disappointment",
        /// Pride.
        Pride = "pride",
        /// Shame.
        Shame = "shame",
        /// Admiration.
        Admiration = "admiration",
        /// Reproach.
        Reproach = "reproach",
        /// Gratification.
        Gratification = "gratification",
        /// Remorse.
        Remorse = "remorse",
        /// Gratitude.
        Gratitude = "gratitude",
        /// Anger.
        Anger = "anger",
        /// Love.
        Love = "love",
        /// Hate.
        Hate = "hate",
        /// Liking.
        Liking = "liking",
        /// Disliking.
        Disliking = "disliking",
        /// Surprise (F&H section 4.4.3).
        Surprise = "surprise",
        /// Disgust (F&H table 4.1).
        Disgust = "disgust",
        /// Joking, with a wink (F&H table 4.1).
        Kidding = "kidding",
        /// A weak fear (F&H figure 4.17).
        Anxiety = "anxiety",
        /// A strong fear (F&H figure 4.17).
        Panic = "panic",
    }
}

words! {
    /// Emotion space in which an expression is blended from the six basic ones.
    EmotionSpace {
        /// Activation, evaluation and power (F&H section 4.4.4).
        Sphere = "sphere",
        /// Activation and evaluation (F&H section 4.4.3).
        Disc = "disc",
    }
}

record! {
    /// Elicits an emotion.
    Emotion = "emotion" {
        /// Emotion word; none: a place without a word.
        kind: Option<EmotionKind> = "type",
        /// Passive to active, −100 to 100; none: that of its word.
        activation: Option<f64> = "activation",
        /// Negative to positive, likewise.
        evaluation: Option<f64> = "evaluation",
        /// Submissive to dominant, likewise.
        power: Option<f64> = "power",
        /// Space in which its expression is blended.
        space: EmotionSpace = "space",
        /// Potential (strength) of the emotion, 0 to 10 (GEVH 3.5.4.1).
        potential: f64 = "potential",
        /// Threshold subtracted from the potential, 0 to 10.
        threshold: f64 = "threshold",
        /// Duration at full strength, seconds.
        duration_secs: f64 = "duration",
        /// Decay time if no other emotion follows, seconds.
        decay_secs: f64 = "decay",
    }
}

impl Emotion {
    /// Returns the intensity: the part of its potential above the threshold, 0 to 10.
    #[must_use]
    pub fn intensity(&self) -> f64 {
        (self.potential - self.threshold).max(0.0)
    }
}

words! {
    /// Shot size of the camera (GEVH 3.5.4.1).
    ShotKind {
        /// A detail, such as the eyes.
        ExtremeCloseUp = "extremeCloseUp",
        /// The face.
        CloseUp = "closeUp",
        /// Medium shot: the figure from the waist up.
        Medium = "medium",
        /// The whole figure.
        Full = "full",
        /// The figure and its surroundings.
        Long = "long",
        /// Figure from the waist up with the eyes on the upper third; wider while a gesture needs
        /// more space.
        Storyteller = "storyteller",
    }
}

words! {
    /// Vertical camera angle (GEVH 3.5.4.1).
    CameraAngle {
        /// At the height of its target.
        Eye = "eye",
        /// High angle: the camera looks down.
        High = "high",
        /// Low angle: the camera looks up.
        Low = "low",
    }
}

record! {
    /// Sets the shot of the camera.
    Camera = "camera" {
        /// Source of control from here on.
        by: ControlSource = "by",
        /// Shot size; none: unchanged.
        shot: Option<ShotKind> = "shot",
        /// Camera angle; none: unchanged.
        angle: Option<CameraAngle> = "angle",
        /// Transition time, seconds; 0 is a cut.
        transition_secs: f64 = "transition",
    }
}

record! {
    /// Changes the key light (GEVH 3.5.4.2).
    Light = "light" {
        /// Source of control from here on.
        by: ControlSource = "by",
        /// Colour as red, green, blue in sRGB; none: unchanged.
        color: Option<[u8; 3]> = "color",
        /// Brightness, 1 as in the stage's own light; none: unchanged.
        brightness: Option<f64> = "brightness",
        /// Transition time, seconds.
        transition_secs: f64 = "transition",
    }
}

words! {
    /// The mood of a piece of music (GEVH 3.5.4.3).
    Valence {
        /// Neither.
        Neutral = "neutral",
        /// A good mood.
        Positive = "positive",
        /// A bad mood.
        Negative = "negative",
    }
}

record! {
    /// Plays music: from the library by its mood, or a file.
    Music = "music" {
        /// Source of control from here on.
        by: ControlSource = "by",
        /// Mood of the music; none: silence, unless there is a file.
        valence: Option<Valence> = "valence",
        /// A file next to the story.
        file: Option<String> = "file",
        /// Volume of the music, 1 as recorded.
        volume: f64 = "volume",
        /// Cross-fade time with the previous music, seconds.
        fade_secs: f64 = "fade",
    }
}

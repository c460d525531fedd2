//! Extensions: the performer, emotions, and how camera, light and music tell it
//! (GEVH 3.5.4 describes them without a syntax).

use crate::record::{record, words};
use raconteur_base::Side;

words! {
    /// What gives way where a gesture begins sooner than the hand can be there.
    RunUp {
        /// The whole script waits.
        Delay = "delay",
        /// The stroke comes late.
        Late = "late",
        /// The hand is there all the same.
        Snap = "snap",
    }
}

words! {
    /// What expressions beside speech are made from.
    Expressions {
        /// The sound: its pitch and pauses (F&H section 4.2).
        Sound = "sound",
        /// The text: accents, phrases and kinds of sentences (F&H section 4.3).
        Text = "text",
    }
}

words! {
    /// The hand that somebody writes and points with.
    PreferredHand {
        /// The left one.
        Left = "left",
        /// The right one.
        Right = "right",
    }
}

impl PreferredHand {
    /// Its side.
    #[must_use]
    pub fn side(self) -> Side {
        match self {
            Self::Left => Side::Left,
            Self::Right => Side::Right,
        }
    }
}

record! {
    /// Who performs the script, in what voice and language, and in which manner.
    Performer = "performer" {
        /// The figure: a name of the library, or a file beside the story.
        figure: Option<String> = "figure",
        /// The voice's name.
        voice: Option<String> = "voice",
        /// The language of the speech, as in BCP 47.
        language: Option<String> = "language",
        /// The dominant hand.
        handedness: Option<PreferredHand> = "handedness",
        /// What expressions beside speech are made from.
        expressions: Option<Expressions> = "expressions",
        /// How far the head is raised and tilted with speech.
        head: Option<f64> = "head",
        /// How far the brows are.
        brows: Option<f64> = "brows",
        /// How often the eyes blink, against the natural frequency.
        blinks: Option<f64> = "blinks",
        /// How far the gaze goes aside.
        gaze: Option<f64> = "gaze",
        /// In which share of the raises the head tilts.
        tilt_share: Option<f64> = "tilts",
        /// At which share of the highest pitches the brows are raised.
        brow_share: Option<f64> = "browShare",
        /// How far a pitch stands out to be shown, semitones.
        pitch_threshold: Option<f64> = "pitchThreshold",
        /// On which share of accents the speaker looks at the listener.
        accent_glances: Option<f64> = "accentGlances",
        /// The same of pauses between phrases.
        pause_glances: Option<f64> = "pauseGlances",
        /// From which length on a pause is one for thinking, seconds.
        thinking_secs: Option<f64> = "thinkingPause",
        /// Which share of such pauses shows it.
        thinking_share: Option<f64> = "thinking",
        /// Which share of these is a look down with a frown.
        frown_share: Option<f64> = "frowns",
        /// Mean time between two moistenings of the lips, seconds.
        lick_secs: Option<f64> = "lickInterval",
        /// How far the loudness rules the head's raises.
        head_by_loudness: Option<f64> = "headByLoudness",
        /// The same for the brows.
        brows_by_loudness: Option<f64> = "browsByLoudness",
    }
}

words! {
    /// Where the story is told.
    Scenery {
        /// A theatre's curtain and boards.
        Curtain = "curtain",
        /// A room with a hearth.
        Fireside = "fireside",
        /// A lawn before a hedge.
        Garden = "garden",
        /// Under the stars.
        Night = "night",
        /// A classroom.
        School = "school",
    }
}

words! {
    /// How closely the light keeps to the thesis.
    Fidelity {
        /// Scaled so that a face is read and nothing jumps.
        Stage = "stage",
        /// As GEVH 3.5.4.2 has it.
        Thesis = "thesis",
    }
}

words! {
    /// How active a mood is.
    Arousal {
        /// Calm.
        Low = "low",
        /// Excited.
        High = "high",
    }
}

record! {
    /// A piece of the author's in place of the library's.
    Piece = "piece" {
        /// The mood in which it is played.
        valence: Valence = "valence",
        /// How active that mood is; none: however active.
        arousal: Option<Arousal> = "arousal",
        /// A file beside the story.
        file: String = "file",
        /// How many seconds a bar takes: another piece takes over on a bar line.
        bar_secs: f64 = "bar",
    }
}

record! {
    /// Which channels of the environment express emotions (GEVH 3.5.4), and where.
    Environment = "environment" {
        /// Whether the camera does.
        camera: bool = "camera",
        /// Whether the light does.
        light: bool = "light",
        /// Whether music does.
        music: bool = "music",
        /// Where the story is told.
        set: Scenery = "set",
        /// How closely the light keeps to the thesis.
        fidelity: Fidelity = "fidelity",
        /// What draws the music of a mood; none: whoever shows the story.
        seed: Option<u32> = "seed",
    }
    children {
        /// The author's own music.
        pieces: Vec<Piece>
    }
}

words! {
    /// Who leads a channel of the environment from a clause on.
    Lead {
        /// What the script writes.
        Script = "script",
        /// The strongest emotion, or the mood.
        Emotion = "emotion",
    }
}

words! {
    /// The emotions of Ortony, Clore and Collins, those that F&H name besides, and `neutral`.
    EmotionKind {
        /// None in particular.
        Neutral = "neutral",
        /// Joy.
        Joy = "joy",
        /// Distress.
        Distress = "distress",
        /// Glad for somebody.
        HappyFor = "happy-for",
        /// Sorry for somebody.
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
        /// What was feared came true.
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
    /// In which space an expression is blended of the six basic ones.
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
        /// Which one; none: a place without a word.
        kind: Option<EmotionKind> = "type",
        /// Passive to active, −100 to 100; none: that of its word.
        activation: Option<f64> = "activation",
        /// Negative to positive, likewise.
        evaluation: Option<f64> = "evaluation",
        /// Submissive to dominant, likewise.
        power: Option<f64> = "power",
        /// Where its expression is blended.
        space: EmotionSpace = "space",
        /// Its potential, 0 to 10 (GEVH 3.5.4.1).
        potential: f64 = "potential",
        /// What of the potential is not felt, 0 to 10.
        threshold: f64 = "threshold",
        /// How long it is kept up, in seconds.
        duration_secs: f64 = "duration",
        /// How long it takes to go when nothing follows, in seconds.
        decay_secs: f64 = "decay",
    }
}

impl Emotion {
    /// What of its potential is felt, 0 to 10.
    #[must_use]
    pub fn intensity(&self) -> f64 {
        (self.potential - self.threshold).max(0.0)
    }
}

words! {
    /// How much of the figure the camera shows (GEVH 3.5.4.1).
    ShotKind {
        /// A detail, such as the eyes.
        ExtremeCloseUp = "extremeCloseUp",
        /// The face.
        CloseUp = "closeUp",
        /// From the waist up.
        Medium = "medium",
        /// The whole figure.
        Full = "full",
        /// The figure and its surroundings.
        Long = "long",
        /// From the waist up with the eyes on the upper third; wider while a gesture needs it.
        Storyteller = "storyteller",
    }
}

words! {
    /// From where the camera looks (GEVH 3.5.4.1).
    CameraAngle {
        /// At the height of what it looks at.
        Eye = "eye",
        /// From above.
        High = "high",
        /// From below.
        Low = "low",
    }
}

record! {
    /// Takes a shot.
    Camera = "camera" {
        /// Who leads from here on.
        by: Lead = "by",
        /// How much it shows; none: unchanged.
        shot: Option<ShotKind> = "shot",
        /// From where; none: unchanged.
        angle: Option<CameraAngle> = "angle",
        /// How long the way there takes in seconds; 0 is a cut.
        transition_secs: f64 = "transition",
    }
}

record! {
    /// Changes the key light (GEVH 3.5.4.2).
    Light = "light" {
        /// Who leads from here on.
        by: Lead = "by",
        /// Its colour as red, green, blue in sRGB; none: unchanged.
        color: Option<[u8; 3]> = "color",
        /// Its brightness, 1 as in the stage's own light; none: unchanged.
        brightness: Option<f64> = "brightness",
        /// How long the change takes in seconds.
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
        /// Who leads from here on.
        by: Lead = "by",
        /// The mood; none: silence, unless there is a file.
        valence: Option<Valence> = "valence",
        /// A file beside the story.
        file: Option<String> = "file",
        /// Its volume, 1 as recorded.
        volume: f64 = "volume",
        /// How long it fades in, and the music before out, in seconds.
        fade_secs: f64 = "fade",
    }
}

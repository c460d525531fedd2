//! Emotional expression of the environment (GEVH 3.5.4): the rules for shots, the colours of table
//! 3.2, equations 3.1 and 3.2, and the valence of music.

use crate::camera::Shot;

/// Maximum potential and intensity. GEVH does not bound them. Designed.
pub const STRONGEST: f64 = 10.0;

/// Vertical camera angle towards the figure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Angle {
    /// At the height of its target.
    #[default]
    Eye,
    /// Camera above the figure, looking down.
    High,
    /// Camera below the figure, looking up.
    Low,
}

impl Angle {
    /// Returns the elevation of the camera over eye height about its target, radians. Designed: a
    /// visible difference that still shows the face.
    #[must_use]
    pub fn elevation_rad(self) -> f64 {
        match self {
            Self::Eye => 0.0,
            Self::High => 0.30,
            Self::Low => -0.20,
        }
    }
}

/// Valence of an emotion or a mood: negative, neutral or positive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Valence {
    /// Bad.
    Negative,
    /// Neither.
    #[default]
    Neutral,
    /// Good.
    Positive,
}

impl Valence {
    /// Returns −1 for negative, 0 for neutral, 1 for positive.
    #[must_use]
    pub fn sign(self) -> f64 {
        f64::from(self as i8) - 1.0
    }
}

/// Effect of an emotion on lamps in addition to colour and brightness, at full strength. Designed:
/// long, hard shadows threaten, light from below is uncanny, light from above weighs down, soft
/// frontal light is friendly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LampManner {
    /// Azimuth of the key light away from the front, radians.
    pub(crate) turn_rad: f64,
    /// Elevation of the key light, radians.
    pub(crate) lift_rad: f64,
    /// Softness of its shadows, relative to the stage's own.
    pub(crate) softness: f64,
    /// Mist on the stage, 0 to 1.
    pub(crate) mist: f64,
}

const PLAIN: LampManner = LampManner {
    turn_rad: 0.0,
    lift_rad: 0.0,
    softness: 1.0,
    mist: 0.0,
};
const OPEN: LampManner = LampManner {
    turn_rad: -0.30,
    softness: 1.9,
    ..PLAIN
};
const PROUD: LampManner = LampManner {
    turn_rad: 0.10,
    lift_rad: 0.12,
    ..PLAIN
};
const HARD: LampManner = LampManner {
    turn_rad: 0.45,
    lift_rad: -0.22,
    softness: 0.45,
    mist: 0.0,
};
const UNCANNY: LampManner = LampManner {
    turn_rad: 0.25,
    lift_rad: -0.75,
    softness: 0.6,
    mist: 0.35,
};
const HEAVY: LampManner = LampManner {
    turn_rad: 0.0,
    lift_rad: 0.35,
    softness: 2.2,
    mist: 0.6,
};

/// Emotion type of Ortony, Clore and Collins, with the light and the camera that express it in the
/// environment.
#[derive(Debug, PartialEq)]
pub struct EmotionType {
    /// Name of the emotion type.
    pub name: &'static str,
    /// Valence of the emotion.
    pub valence: Valence,
    /// The colour of the key light, sRGB (GEVH table 3.2).
    pub key_color: [u8; 3],
    /// Camera angle (GEVH 3.5.4.1, rules 1 and 2).
    pub angle: Angle,
    pub(crate) lamp: LampManner,
}

const RED: [u8; 3] = [255, 0, 0];
const GREY: [u8; 3] = [200, 200, 200];
const GREEN_YELLOW: [u8; 3] = [220, 255, 0];
const DARK_GREY: [u8; 3] = [153, 153, 153];
const WHITE: [u8; 3] = [255, 255, 255];
const BRIGHT_YELLOW: [u8; 3] = [255, 255, 200];
const YELLOW: [u8; 3] = [255, 255, 0];

const fn emotion(
    name: &'static str,
    valence: Valence,
    key_color: [u8; 3],
    lamp: LampManner,
) -> EmotionType {
    EmotionType {
        name,
        valence,
        key_color,
        angle: Angle::Eye,
        lamp,
    }
}

impl EmotionType {
    const fn from(self, angle: Angle) -> Self {
        Self { angle, ..self }
    }
}

use Valence::{Negative, Neutral, Positive};

/// No emotion, and the types. Table 3.2 has colours for twelve of them; the others use that of the
/// most similar type. Designed.
pub static EMOTIONS: [EmotionType; 25] = [
    emotion("neutral", Neutral, WHITE, PLAIN),
    emotion("joy", Positive, YELLOW, OPEN),
    emotion("happy-for", Positive, YELLOW, OPEN),
    emotion("gloating", Positive, GREEN_YELLOW, HARD),
    emotion("hope", Positive, BRIGHT_YELLOW, OPEN),
    emotion("satisfaction", Positive, BRIGHT_YELLOW, OPEN),
    emotion("relief", Positive, WHITE, OPEN),
    emotion("pride", Positive, YELLOW, PROUD).from(Angle::Low),
    emotion("admiration", Positive, BRIGHT_YELLOW, OPEN),
    emotion("gratification", Positive, YELLOW, PROUD),
    emotion("gratitude", Positive, BRIGHT_YELLOW, OPEN),
    emotion("love", Positive, BRIGHT_YELLOW, OPEN),
    emotion("liking", Positive, BRIGHT_YELLOW, OPEN),
    emotion("distress", Negative, DARK_GREY, HEAVY),
    emotion("sorry-for", Negative, DARK_GREY, HEAVY),
    emotion("resentment", Negative, RED, HARD),
    emotion("fear", Negative, WHITE, UNCANNY).from(Angle::High),
    emotion("fears-confirmed", Negative, GREY, UNCANNY),
    emotion("disappointment", Negative, GREY, HEAVY),
    emotion("shame", Negative, DARK_GREY, HEAVY),
    emotion("reproach", Negative, RED, HARD),
    emotion("remorse", Negative, DARK_GREY, HEAVY),
    emotion("anger", Negative, RED, HARD).from(Angle::Low),
    emotion("hate", Negative, RED, HARD),
    emotion("disliking", Negative, GREEN_YELLOW, HARD),
];

/// Additional words of F&H, and the types used for them in the environment. Designed.
const KIN: [(&str, &str); 5] = [
    ("surprise", "neutral"),
    ("disgust", "disliking"),
    ("kidding", "joy"),
    ("anxiety", "fear"),
    ("panic", "fear"),
];

impl EmotionType {
    /// Returns the type for no emotion.
    #[must_use]
    pub fn neutral() -> &'static Self {
        &EMOTIONS[0]
    }

    /// Returns the type for a word: its own name, or a synonym that F&H use; `None` for an unknown
    /// word.
    #[must_use]
    pub fn named(word: &str) -> Option<&'static Self> {
        let kin = KIN.iter().find(|(other, _)| *other == word);
        let name = kin.map_or(word, |(_, name)| name);
        EMOTIONS.iter().find(|e| e.name == name)
    }

    /// Returns the camera distance at a potential (GEVH 3.5.4.1, rules 3 to 6; each band without
    /// its upper end).
    #[must_use]
    pub fn distance(potential: f64) -> Shot {
        match potential {
            p if p < 1.5 => Shot::Full,
            p if p < 2.5 => Shot::Medium,
            p if p < 4.5 => Shot::Close,
            _ => Shot::ExtremeClose,
        }
    }

    /// Returns the attenuation of the key light at an intensity, 0 to 1 (GEVH equations 3.1 and
    /// 3.2); 0 without emotion.
    #[must_use]
    pub fn attenuation(&self, intensity: f64) -> f64 {
        let share = (intensity / STRONGEST).clamp(0.0, 1.0);
        match self.valence {
            Positive => (1.0 - share).min(0.5),
            Negative => share.max(0.25),
            Neutral => 0.0,
        }
    }

    /// Returns the brightness of the key light at an intensity relative to the stage's own light.
    /// Equations 3.1 and 3.2 start at different values; the result is scaled so both start at the
    /// stage's own light, and no emotion begins with a jump.
    #[must_use]
    pub fn brightness(&self, intensity: f64) -> f64 {
        (1.0 - self.attenuation(intensity)) / (1.0 - self.attenuation(0.0))
    }
}

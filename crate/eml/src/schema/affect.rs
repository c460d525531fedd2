//! Words of emotion beyond the table's, each with its position on the disc of activation and
//! evaluation (F&H 4.4.1 and figure 4.10).

use crate::suggest::quoted;
use crate::{Diagnostic, Span};

/// Nouns and adjectives with their place: activation and evaluation, −100 to 100. *Designed*, by
/// the quadrant of the disc and the neighbours that Russell gives such words (1980,
/// doi:10.1037/h0077714), on the scale of F&H table 4.4.
const WORDS: [(&str, [f64; 2]); 47] = [
    ("amazement amazed astonishment astonished awe", [75.0, 20.0]),
    ("amusement amused mirth", [25.0, 45.0]),
    (
        "annoyance annoyed irritation irritated grumpiness grumpy",
        [22.0, -30.0],
    ),
    ("anticipation expectant expectation", [35.0, 15.0]),
    ("apathy apathetic indifference indifferent", [-45.0, -10.0]),
    (
        "bliss blissful euphoria euphoric ecstasy ecstatic",
        [55.0, 60.0],
    ),
    ("boredom bored tedium", [-55.0, -25.0]),
    (
        "calm calmness serenity serene peace peaceful tranquillity",
        [-45.0, 40.0],
    ),
    (
        "cheerfulness cheerful happiness happy merry glee gleeful gladness glad",
        [25.0, 50.0],
    ),
    (
        "compassion compassionate sympathy sympathetic pity empathy",
        [-10.0, -15.0],
    ),
    (
        "concern concerned worry worried unease uneasy",
        [15.0, -30.0],
    ),
    (
        "confidence confident courage courageous bravery brave",
        [25.0, 35.0],
    ),
    (
        "confusion confused bewilderment bewildered puzzlement puzzled perplexed",
        [25.0, -12.0],
    ),
    (
        "contempt contemptuous scorn scornful disdain",
        [15.0, -45.0],
    ),
    (
        "contentment content contented satisfied pleased pleasure",
        [-20.0, 45.0],
    ),
    (
        "curiosity curious interest interested fascination fascinated",
        [40.0, 25.0],
    ),
    ("delight delighted joyful elation elated", [40.0, 58.0]),
    (
        "depression depressed gloom gloomy melancholy melancholic",
        [-45.0, -50.0],
    ),
    (
        "despair desperate desperation hopelessness hopeless",
        [-15.0, -70.0],
    ),
    ("determination determined resolve resolute", [35.0, 15.0]),
    (
        "dread terror terrified horror horrified scared frightened",
        [60.0, -65.0],
    ),
    ("eagerness eager enthusiasm enthusiastic zeal", [50.0, 45.0]),
    (
        "embarrassment embarrassed awkwardness awkward",
        [25.0, -25.0],
    ),
    ("envy envious jealousy jealous", [35.0, -45.0]),
    ("excitement excited thrill thrilled", [65.0, 40.0]),
    (
        "fatigue tired tiredness exhaustion exhausted weariness weary",
        [-65.0, -20.0],
    ),
    (
        "frustration frustrated exasperation exasperated",
        [40.0, -48.0],
    ),
    ("fury furious rage outrage outraged wrath", [75.0, -60.0]),
    (
        "grief grieving sorrow sorrowful mourning heartbreak",
        [-25.0, -65.0],
    ),
    ("guilt guilty regret regretful repentance", [-5.0, -45.0]),
    (
        "homesickness homesick longing yearning nostalgia nostalgic wistful",
        [-20.0, -10.0],
    ),
    ("humiliation humiliated", [20.0, -55.0]),
    ("hurt offended indignation indignant", [30.0, -50.0]),
    ("impatience impatient restlessness restless", [45.0, -20.0]),
    ("inspiration inspired", [45.0, 50.0]),
    ("loneliness lonely", [-35.0, -45.0]),
    ("mischief mischievous playful playfulness", [35.0, 35.0]),
    (
        "nervousness nervous tension tense stress stressed",
        [45.0, -30.0],
    ),
    ("optimism optimistic", [20.0, 40.0]),
    ("pain agony", [40.0, -65.0]),
    ("relaxation relaxed ease", [-55.0, 35.0]),
    (
        "sadness sad unhappiness unhappy misery miserable",
        [-25.0, -50.0],
    ),
    ("shock shocked", [90.0, -25.0]),
    ("shyness shy timidity timid", [-10.0, -20.0]),
    ("sleepiness sleepy drowsiness drowsy", [-75.0, 5.0]),
    (
        "suspicion suspicious distrust doubt doubtful scepticism sceptical",
        [15.0, -25.0],
    ),
    (
        "tenderness tender affection affectionate trust trusting warmth",
        [-10.0, 45.0],
    ),
];

/// Adjectives of the table's own words.
const FORMS: [(&str, &str); 22] = [
    ("joyous", "joy"),
    ("distressed", "distress"),
    ("gloat", "gloating"),
    ("resentful", "resentment"),
    ("hopeful", "hope"),
    ("afraid", "fear"),
    ("fearful", "fear"),
    ("relieved", "relief"),
    ("disappointed", "disappointment"),
    ("proud", "pride"),
    ("admiring", "admiration"),
    ("ashamed", "shame"),
    ("reproachful", "reproach"),
    ("grateful", "gratitude"),
    ("thankful", "gratitude"),
    ("angry", "anger"),
    ("remorseful", "remorse"),
    ("loving", "love"),
    ("hatred", "hate"),
    ("surprised", "surprise"),
    ("disgusted", "disgust"),
    ("anxious", "anxiety"),
];

/// Meaning of an emotion word that is not in the table: a synonym or a position on the
/// activation-evaluation disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WordMeaning {
    /// A word of the table.
    Word(&'static str),
    /// A place: activation and evaluation.
    Place([f64; 2]),
}

/// Returns the meaning of an emotion word outside the table; `None` for an unknown word.
pub(super) fn meant(word: &str) -> Option<WordMeaning> {
    let is = |own: &str| own.eq_ignore_ascii_case(word);
    if let Some((_, own)) = FORMS.iter().find(|(form, _)| is(form)) {
        return Some(WordMeaning::Word(own));
    }
    let place = WORDS.iter().find(|(words, _)| words.split(' ').any(is));
    place.map(|(_, place)| WordMeaning::Place(*place))
}

/// Reports a word that has a place.
pub(super) fn report_place(
    word: &str,
    [activation, evaluation]: [f64; 2],
    span: Span,
) -> Diagnostic {
    let message = format!(
        "{} is not in the table of emotions; it is expressed at its point on the disc, activation {activation} and evaluation {evaluation}",
        quoted(word)
    );
    Diagnostic::warning("eml::emotion-word", span, message)
        .hint("write activation and evaluation to choose another point, or use one of the words in the table")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::testing::codes;
    use crate::{ClauseKind, Emotion, EmotionKind, EmotionSpace};

    fn emotion(attributes: &str) -> Emotion {
        let script = format!(
            "<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='0' {attributes}/></body></eml>"
        );
        match crate::parse(&script)
            .document
            .clauses
            .into_iter()
            .next()
            .map(|c| c.kind)
        {
            Some(ClauseKind::Emotion(emotion)) => emotion,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn each_word_is_there_once_and_none_of_the_tables() {
        let all: Vec<&str> = WORDS
            .iter()
            .flat_map(|(words, _)| words.split(' '))
            .chain(FORMS.iter().map(|(form, _)| *form))
            .collect();
        for (at, word) in all.iter().enumerate() {
            assert!(!all[..at].contains(word), "{word}");
            assert!(!EmotionKind::WORDS.contains(word), "{word}");
        }
    }

    #[test]
    fn words_beyond_the_table_have_a_place() {
        for (word, activation, evaluation) in [
            ("jealousy", 35.0, -45.0),
            ("Bored", -55.0, -25.0),
            ("curiosity", 40.0, 25.0),
        ] {
            let emotion = emotion(&format!("type='{word}'"));
            assert_eq!(emotion.kind, None);
            assert_eq!(
                (emotion.activation, emotion.evaluation),
                (Some(activation), Some(evaluation))
            );
            assert_eq!(emotion.space, EmotionSpace::Disc);
        }
        let angry = emotion("type='Angry' power='3'");
        assert_eq!(
            (angry.kind, angry.activation),
            (Some(EmotionKind::Anger), None)
        );
        let envy = emotion("type='envy' evaluation='-5' space='sphere'");
        assert_eq!((envy.activation, envy.evaluation), (Some(35.0), Some(-5.0)));
        assert_eq!(envy.space, EmotionSpace::Sphere);
    }

    #[test]
    fn the_place_is_told_and_nonsense_is_an_error() {
        let of = |word: &str| {
            codes(&format!(
                "<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='0' type='{word}'/></body></eml>"
            ))
        };
        assert_eq!(of("jealousy"), ["eml::emotion-word"]);
        assert_eq!(of("angry"), ["eml::alias"]);
        assert_eq!(of("blargh")[0], "eml::bad-choice");
    }
}

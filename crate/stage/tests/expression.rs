//! Every emotion in every band of its strength, compared with a table written from GEVH 3.5.4
//! before the code: `tests/suite/environment/expression.tsv`.

use raconteur_stage::Shot;
use raconteur_stage::emotion::{Angle, EMOTIONS, EmotionType, Valence};

const TABLE: &str = include_str!("../../../tests/suite/environment/expression.tsv");

#[test]
fn shots_angles_colours_attenuation_and_valence_are_the_published_ones() {
    let mut seen = 0;
    for line in TABLE.lines().skip(1) {
        let cells: Vec<&str> = line.split('\t').collect();
        let [
            name,
            potential,
            shot,
            angle,
            red,
            green,
            blue,
            attenuation,
            valence,
            _,
        ] = cells[..]
        else {
            panic!("{line}")
        };
        let emotion = EmotionType::named(name).expect(name);
        let potential: f64 = potential.parse().expect(line);
        let distance = match EmotionType::distance(potential) {
            Shot::Full => "full",
            Shot::Medium => "medium",
            Shot::Close => "closeUp",
            Shot::ExtremeClose => "extremeCloseUp",
            other => panic!("{other:?}"),
        };
        assert_eq!(distance, shot, "{line}");
        let from = match emotion.angle {
            Angle::Eye => "eye",
            Angle::High => "high",
            Angle::Low => "low",
        };
        assert_eq!(from, angle, "{line}");
        let color = [red, green, blue].map(|c| c.parse::<u8>().expect(line));
        assert_eq!(emotion.key_color, color, "{line}");
        let wanted: f64 = attenuation.parse().unwrap_or(0.0);
        assert!(
            (emotion.attenuation(potential) - wanted).abs() < 1e-12,
            "{line}"
        );
        let sign = match emotion.valence {
            Valence::Negative => "negative",
            Valence::Neutral => "neutral",
            Valence::Positive => "positive",
        };
        assert_eq!(sign, valence, "{line}");
        seen += 1;
    }
    assert_eq!(seen, 4 * EMOTIONS.len());
}

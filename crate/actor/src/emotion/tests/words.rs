//! Tests of emotion words: they differ, grow with their potential and keep their strength.

use super::*;

/// Words to which F&H assign one face: table 4.4 has them at one place, or section 4.4.3 equates
/// them.
const SAME: [[&str; 2]; 3] = [
    ["joy", "happy-for"],
    ["distress", "sorry-for"],
    ["hate", "disgust"],
];

/// Returns the visible signs of an emotion, with angles scaled by plainly visible ones.
fn seen(word: &str, intensity: f64) -> Vec<f64> {
    let affect = Affect::named(word).expect(word);
    let mut mixture = ExpressionWeights::from_affect(affect);
    mixture.scale(intensity);
    let signs = EmotionSigns::from_affect(affect).scaled(intensity);
    let angles = [
        signs.gaze_down_rad,
        signs.head_down_rad,
        signs.head_turn_rad,
        signs.head_tilt_rad,
    ];
    let mut all = mixture.expression().values.to_vec();
    all.push(signs.blush);
    all.extend(angles.map(|angle| angle / 0.35));
    all
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

#[test]
fn no_two_words_look_alike() {
    let mut pairs = Vec::new();
    for (i, (one, _)) in WORDS.iter().enumerate() {
        for (other, _) in &WORDS[..i] {
            let apart = distance(&seen(one, 1.0), &seen(other, 1.0));
            let is_same = SAME
                .iter()
                .any(|same| same.contains(one) && same.contains(other));
            assert!(!is_same || apart < 1e-9, "{one} {other}: {apart}");
            if !is_same {
                pairs.push((apart, *one, *other));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (apart, one, other) in &pairs[..24] {
        println!("{apart:.3} {one} {other}");
    }
    // A third of a face: one muscle of both sides by a quarter of its range.
    assert!(pairs[0].0 > 0.35, "{:?}", pairs[0]);
}

#[test]
fn every_word_grows_with_its_potential_all_the_way() {
    for (word, _) in WORDS {
        let mut before = vec![0.0; seen(word, 0.0).len()];
        let none = before.clone();
        for tenth in 1..=100 {
            // A potential of 5 is the strength of the table.
            let now = seen(word, 0.02 * f64::from(tenth));
            let grown = distance(&now, &none) - distance(&before, &none);
            assert!(grown > 1e-4, "{word} at {tenth}: {grown}");
            assert!(
                now[..FACE_CONTROLS].iter().all(|v| v.abs() <= 1.0),
                "{word}"
            );
            before = now;
        }
        let [seven, ten] = [1.4, 2.0].map(|intensity| seen(word, intensity));
        let apart = distance(&seven, &ten);
        println!("{word}: {apart:.2} from 7 to 10");
        assert!(apart > 0.15, "{word}: {apart}");
    }
}

#[test]
fn up_to_their_own_strength_the_basic_six_are_what_they_were_given() {
    for basic in BasicEmotion::ALL {
        let named = ExpressionWeights::from_affect(Affect::named(basic.word()).expect("a word"));
        assert_eq!(
            named.expression(),
            Expression::from_basic(basic),
            "{basic:?}"
        );
    }
    // The meanings of emoticons (F&H table 4.1, section 4.3.5: 100 %).
    for (word, basic) in [
        ("joy", BasicEmotion::Joy),
        ("distress", BasicEmotion::Sadness),
        ("surprise", BasicEmotion::Surprise),
        ("anger", BasicEmotion::Anger),
        ("disgust", BasicEmotion::Disgust),
    ] {
        let face =
            ExpressionWeights::from_affect(Affect::named(word).expect("a word")).expression();
        assert!(
            apart(&face, &Expression::from_basic(basic)) < 1e-9,
            "{word}"
        );
    }
    // Anxiety and panic are fear, scaled (F&H figure 4.17).
    for (word, ratio) in [("anxiety", 0.5), ("panic", 2.0)] {
        let own = ExpressionWeights::from_affect(Affect::named(word).expect("a word"));
        assert_eq!(
            own,
            ExpressionWeights::scaled(BasicEmotion::Fear, ratio),
            "{word}"
        );
        let disc = ExpressionWeights::on_disc(place(word).expect("a word")).expression();
        assert!(apart(&disc, &own.expression()) < 1e-2, "{word}");
    }
}

#[test]
fn faces_of_all_words() {
    // Prints the weights of the six basic expressions for each word, for inspection with
    // --nocapture.
    for (word, _) in WORDS {
        let place = place(word).expect("a word");
        let percent = |s: EmotionSpace| {
            let free = ExpressionWeights::from_point(place, s).free;
            let six: Vec<f64> = free[..BASICS].iter().map(|f| (100.0 * f).round()).collect();
            six
        };
        let (disc, sphere) = (percent(EmotionSpace::Disc), percent(EmotionSpace::Sphere));
        println!("{word:16} disc {disc:?} sphere {sphere:?}");
        assert!(sphere.iter().sum::<f64>() > 10.0, "{word}");
    }
}

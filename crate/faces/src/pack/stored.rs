//! File content of a pack after its header.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{
    DependentNumbers, FaceModel, LookNumber, MAX_BYTES, MAX_MODES, NamedAttribute, PersonRecord,
    TextureModel,
};
use crate::age_model::AgeModel;
use crate::attribute::Attribute;
use crate::error::FaceError;
use crate::feature::Feature;
use crate::segment::{Half, Segment, Segments};
use crate::space::FaceSpace;

/// Name, version and part.
const SHAPE: &[u8; 8] = b"RFACES\x03S";
const TEXTURE: &[u8; 8] = b"RFACES\x03T";
/// Steps of a mode's largest number.
const STEPS: f64 = 127.0;
/// Minimum quantisation step of a mode at one standard deviation: metres for shapes, logarithms for
/// textures. Finer steps are not visible, and noise compresses badly.
const MIN_SHAPE_STEP: f64 = 1.5e-5;
const MIN_TEXTURE_STEP: f64 = 1e-3;
/// Steps of a standard deviation in coefficients of the database.
const EXAMPLE_STEPS: f64 = 31.0;

#[derive(Serialize, Deserialize)]
struct StoredSpace {
    mean: Vec<f32>,
    deviations: Vec<f32>,
    steps: Vec<f32>,
    modes: Vec<i8>,
}

/// Effects stored like modes: one byte per number, each row with its own step.
#[derive(Serialize, Deserialize)]
struct StoredFollower {
    mean: Vec<f32>,
    steps: Vec<f32>,
    effects: Vec<i8>,
}

#[derive(Serialize, Deserialize)]
struct StoredAttribute {
    group: String,
    name: String,
    low: String,
    high: String,
    derived: Option<String>,
    direction: Vec<f32>,
    feature: Option<StoredFeature>,
}

#[derive(Serialize, Deserialize)]
struct StoredFeature {
    segments: Vec<String>,
    /// −1 for the right half, 1 for the left one, 0 for both.
    half: i8,
    gradient: Vec<(u32, f32)>,
    alone: Vec<f32>,
}

#[derive(Serialize, Deserialize)]
struct StoredShape {
    space: StoredSpace,
    cage: StoredFollower,
    organs: StoredFollower,
    reference: Vec<f32>,
    triangles: Vec<[u32; 3]>,
    segments: Vec<Segment>,
    landmarks: Vec<(String, u32)>,
    attributes: Vec<StoredAttribute>,
    life: Vec<Vec<f32>>,
    examples: Vec<Vec<i8>>,
    people: Vec<[f32; 5]>,
}

#[derive(Serialize, Deserialize)]
struct StoredTexture {
    space: StoredSpace,
    looks: Vec<(String, f32)>,
    attributes: Vec<StoredAttribute>,
    life: Vec<Vec<f32>>,
    examples: Vec<Vec<i8>>,
    figures: Vec<(String, Vec<f32>)>,
}

fn single(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|&x| x as f32).collect()
}

fn double(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|&x| f64::from(x)).collect()
}

/// Coefficients in steps of the deviations.
fn of_database(space: &FaceSpace, faces: &[Vec<f64>]) -> Vec<Vec<i8>> {
    let one = |face: &Vec<f64>| {
        let parts = face.iter().zip(space.deviations());
        let step = |(c, d): (&f64, &f64)| (EXAMPLE_STEPS * c / d).round().clamp(-STEPS, STEPS);
        parts.map(|part| step(part) as i8).collect()
    };
    faces.iter().map(one).collect()
}

fn database(space: &FaceSpace, faces: &[Vec<i8>]) -> Option<Vec<Vec<f64>>> {
    let one = |face: &Vec<i8>| {
        let parts = face.iter().zip(space.deviations());
        let numbers = parts.map(|(&step, d)| f64::from(step) * d / EXAMPLE_STEPS);
        (face.len() == space.dimensions()).then(|| numbers.collect())
    };
    faces.iter().map(one).collect()
}

/// Returns the numbers in double precision; `None` if one is not finite.
fn finite(numbers: &[f32]) -> Option<Vec<f64>> {
    let is_finite = numbers.iter().all(|x| x.is_finite());
    is_finite.then(|| double(numbers))
}

fn bad(why: &str) -> FaceError {
    FaceError::BadPack {
        why: why.to_owned(),
    }
}

fn write<T: Serialize>(format: &[u8; 8], stored: &T) -> Result<Vec<u8>, FaceError> {
    postcard::to_extend(stored, format.to_vec()).map_err(|e| bad(&e.to_string()))
}

fn read<T: DeserializeOwned>(bytes: &[u8], format: &[u8; 8]) -> Result<T, FaceError> {
    if bytes.len() > MAX_BYTES {
        return Err(bad("it is larger than any pack"));
    }
    let Some(rest) = bytes.strip_prefix(format) else {
        let is_ours = bytes.starts_with(&format[..6]);
        let is_version = is_ours && bytes.get(6) == Some(&format[6]);
        return Err(bad(match (is_ours, is_version) {
            (true, true) => "it is another part of a pack",
            (true, false) => "it is of another version",
            _ => "it is not a face pack",
        }));
    };
    postcard::from_bytes(rest).map_err(|e| bad(&e.to_string()))
}

pub(super) fn shape(model: &FaceModel) -> Result<Vec<u8>, FaceError> {
    let person = |p: &PersonRecord| {
        let [a, b, c] = p.ancestry;
        [p.sex, p.age_years, a, b, c].map(|x| x as f32)
    };
    write(
        SHAPE,
        &StoredShape {
            space: StoredSpace::from_space(&model.shape, MIN_SHAPE_STEP),
            cage: StoredFollower::from_follower(&model.cage),
            organs: StoredFollower::from_follower(&model.organs),
            reference: single(&model.reference),
            triangles: model.triangles.clone(),
            segments: model.segments.all().to_vec(),
            landmarks: model.landmarks.clone(),
            attributes: model
                .attributes
                .iter()
                .map(StoredAttribute::from_attribute)
                .collect(),
            life: model.life.effects.iter().map(|e| single(e)).collect(),
            examples: of_database(&model.shape, &model.examples),
            people: model.people.iter().map(person).collect(),
        },
    )
}

pub(super) fn texture(model: &TextureModel) -> Result<Vec<u8>, FaceError> {
    let look = |l: &LookNumber| (l.name.clone(), l.weight as f32);
    let figure = |(name, own): &(String, Vec<f64>)| (name.clone(), single(own));
    write(
        TEXTURE,
        &StoredTexture {
            space: StoredSpace::from_space(&model.space, MIN_TEXTURE_STEP),
            looks: model.looks.iter().map(look).collect(),
            attributes: model
                .attributes
                .iter()
                .map(StoredAttribute::from_attribute)
                .collect(),
            life: model.life.effects.iter().map(|e| single(e)).collect(),
            examples: of_database(&model.space, &model.examples),
            figures: model.figures.iter().map(figure).collect(),
        },
    )
}

const APART: &str = "its parts do not belong together";

pub(super) fn read_shape(bytes: &[u8]) -> Result<FaceModel, FaceError> {
    let stored: StoredShape = read(bytes, SHAPE)?;
    stored.read().ok_or_else(|| bad(APART))
}

pub(super) fn read_texture(bytes: &[u8]) -> Result<TextureModel, FaceError> {
    let stored: StoredTexture = read(bytes, TEXTURE)?;
    stored.read().ok_or_else(|| bad(APART))
}

/// Quantises rows of numbers to one byte each. Returns them with the step of each row, which is at
/// least the given minimum.
fn stepped<'a>(rows: impl Iterator<Item = (&'a [f64], f64)>) -> (Vec<f32>, Vec<i8>) {
    let (mut steps, mut all) = (Vec::new(), Vec::new());
    for (row, finest) in rows {
        let most = row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let step = (most / STEPS).max(finest) as f32;
        steps.push(step);
        let part = |x: &f64| {
            let share = if step > 0.0 { x / f64::from(step) } else { 0.0 };
            share.round().clamp(-STEPS, STEPS) as i8
        };
        all.extend(row.iter().map(part));
    }
    (steps, all)
}

/// Decodes the rows of [`stepped`], each of `length` numbers; `None` for invalid data.
fn unstepped(steps: &[f32], all: &[i8], length: usize) -> Option<Vec<Vec<f64>>> {
    let is_whole = all.len() == steps.len().checked_mul(length)?;
    let steps = finite(steps).filter(|_| is_whole)?;
    if length == 0 {
        return Some(vec![Vec::new(); steps.len()]);
    }
    let rows = all.chunks_exact(length).zip(steps);
    Some(
        rows.map(|(row, step)| row.iter().map(|&x| f64::from(x) * step).collect())
            .collect(),
    )
}

/// Makes rows orthonormal again that rounding has turned by a thousandth, one after another.
fn orthonormalize(rows: &mut [Vec<f64>]) {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for i in 0..rows.len() {
        let (done, rest) = rows.split_at_mut(i);
        let Some(row) = rest.first_mut() else { return };
        for before in &*done {
            let share = product(row, before);
            for (x, b) in row.iter_mut().zip(before) {
                *x -= share * b;
            }
        }
        let length = product(row, row).sqrt();
        if length > 0.0 {
            row.iter_mut().for_each(|x| *x /= length);
        }
    }
}

impl StoredSpace {
    fn from_space(space: &FaceSpace, finest: f64) -> Self {
        let modes = (0..space.dimensions()).map(|i| space.mode(i));
        // A step of 1 removes everything of a mode of length 1; deviations near zero would exceed
        // it.
        let finest = space.deviations().iter().map(|d| (finest / d).min(1.0));
        let (steps, modes) = stepped(modes.zip(finest));
        Self {
            mean: single(space.mean()),
            deviations: single(space.deviations()),
            steps,
            modes,
        }
    }

    fn read(self) -> Option<FaceSpace> {
        let count = self.deviations.len();
        if count > MAX_MODES || count != self.steps.len() {
            return None;
        }
        let mut modes = unstepped(&self.steps, &self.modes, self.mean.len())?;
        orthonormalize(&mut modes);
        FaceSpace::from_parts(
            finite(&self.mean)?,
            modes.concat(),
            double(&self.deviations),
        )
    }
}

impl StoredFollower {
    fn from_follower(follower: &DependentNumbers) -> Self {
        let effects = follower.effects.iter().map(Vec::as_slice);
        let (steps, effects) = stepped(effects.zip(core::iter::repeat(0.0)));
        Self {
            mean: single(&follower.mean),
            steps,
            effects,
        }
    }

    /// Reads a follower with `count` coefficients, or an empty one if it has no numbers.
    fn read(self, count: usize) -> Option<DependentNumbers> {
        let effects = unstepped(&self.steps, &self.effects, self.mean.len())?;
        let fits = effects.len() == count || self.mean.is_empty();
        fits.then_some(DependentNumbers {
            effects,
            mean: finite(&self.mean)?,
        })
    }
}

impl StoredAttribute {
    fn from_attribute(named: &NamedAttribute) -> Self {
        let [low, high] = named.terms.clone();
        Self {
            group: named.group.clone(),
            name: named.attribute.name.clone(),
            low,
            high,
            derived: named.derived.clone(),
            direction: single(named.attribute.direction()),
            feature: named.feature.as_ref().map(StoredFeature::from_feature),
        }
    }

    fn read(self, space: &FaceSpace) -> Option<NamedAttribute> {
        if self.direction.len() != space.dimensions() {
            return None;
        }
        let direction = double(&self.direction);
        let feature = match self.feature {
            None => None,
            Some(feature) => Some(feature.read(space)?),
        };
        // Features are measured on the modes as stored.
        let attribute = match &feature {
            Some(f) if !f.gradient.is_empty() => {
                Attribute::measured(&self.name, space, &f.gradient)
            }
            _ => Attribute::along(self.name, space, direction),
        };
        Some(NamedAttribute {
            feature,
            group: self.group,
            terms: [self.low, self.high],
            derived: self.derived,
            attribute: attribute.ok()?,
        })
    }
}

impl StoredFeature {
    fn from_feature(feature: &Feature) -> Self {
        let gradient = feature.gradient.iter();
        Self {
            segments: feature.segments.clone(),
            half: match feature.half {
                None => 0,
                Some(Half::Left) => 1,
                Some(Half::Right) => -1,
            },
            gradient: gradient.map(|&(i, g)| (i, g as f32)).collect(),
            alone: single(&feature.alone),
        }
    }

    fn read(self, space: &FaceSpace) -> Option<Feature> {
        let is_within = |&(i, g): &(u32, f32)| (i as usize) < space.length() && g.is_finite();
        let fits = self.alone.len() == space.dimensions() && self.gradient.iter().all(is_within);
        let gradient = self.gradient.iter().map(|&(i, g)| (i, f64::from(g)));
        Some(Feature {
            alone: finite(&self.alone).filter(|_| fits)?,
            gradient: gradient.collect(),
            half: match self.half {
                0 => None,
                1 => Some(Half::Left),
                -1 => Some(Half::Right),
                _ => return None,
            },
            segments: self.segments,
        })
    }
}

/// Reads the age model for a number of coefficients.
fn life(stored: &[Vec<f32>], modes: usize) -> Option<AgeModel> {
    let effects = stored.iter().map(|effect| double(effect)).collect();
    Some(AgeModel { effects }).filter(|life| life.fits(modes))
}

/// Reads the attributes of a space; `None` if one is invalid.
fn attributes(stored: Vec<StoredAttribute>, space: &FaceSpace) -> Option<Vec<NamedAttribute>> {
    stored.into_iter().map(|a| a.read(space)).collect()
}

impl StoredShape {
    fn read(self) -> Option<FaceModel> {
        let shape = self.space.read()?;
        let (length, count) = (shape.length(), shape.dimensions());
        let named = self.landmarks.iter().map(|(_, v)| v);
        let mut vertices = self.triangles.iter().flatten().chain(named);
        let is_mesh = length.is_multiple_of(3) && vertices.all(|&v| (v as usize) < length / 3);
        let is_known = self.people.is_empty() || self.people.len() == self.examples.len();
        let person = |p: &[f32; 5]| {
            let [sex, age_years, a, b, c] = p.map(f64::from);
            let all = [sex, age_years, a, b, c];
            all.iter().all(|x| x.is_finite()).then_some(PersonRecord {
                sex,
                age_years,
                ancestry: [a, b, c],
            })
        };
        let reference = finite(&self.reference)?;
        let is_head = reference.is_empty() || reference.len() == length;
        if !(is_mesh && is_known && is_head) {
            return None;
        }
        Some(FaceModel {
            cage: self.cage.read(count)?,
            organs: self.organs.read(count)?,
            segments: Segments::new(self.segments, length / 3)?,
            reference,
            triangles: self.triangles,
            landmarks: self.landmarks,
            attributes: attributes(self.attributes, &shape)?,
            life: life(&self.life, count)?,
            examples: database(&shape, &self.examples)?,
            people: self.people.iter().map(person).collect::<Option<_>>()?,
            shape,
            texture: None,
        })
    }
}

impl StoredTexture {
    fn read(self) -> Option<TextureModel> {
        let space = self.space.read()?;
        let count = space.dimensions();
        let look = |(name, weight): (String, f32)| {
            let is_weight = weight.is_finite() && weight > 0.0;
            is_weight.then(|| LookNumber {
                name,
                weight: f64::from(weight),
            })
        };
        let figure = |(name, own): (String, Vec<f32>)| {
            let fits = own.len() == count;
            Some((name, finite(&own).filter(|_| fits)?))
        };
        if self.looks.len() > space.length() {
            return None;
        }
        Some(TextureModel {
            looks: self.looks.into_iter().map(look).collect::<Option<_>>()?,
            attributes: attributes(self.attributes, &space)?,
            life: life(&self.life, count)?,
            examples: database(&space, &self.examples)?,
            figures: self
                .figures
                .into_iter()
                .map(figure)
                .collect::<Option<_>>()?,
            space,
        })
    }
}

//! What is in the files of a pack after their names.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{FaceModel, Follower, LookNumber, MOST_BYTES, NamedAttribute, Personal, TextureModel};
use crate::attribute::Attribute;
use crate::error::FaceError;
use crate::segment::{Segment, Segments};
use crate::space::FaceSpace;

/// Name, version and part.
const SHAPE: &[u8; 8] = b"RFACES\x02S";
const TEXTURE: &[u8; 8] = b"RFACES\x02T";
/// Steps of a mode's largest number.
const STEPS: f64 = 127.0;

#[derive(Serialize, Deserialize)]
struct StoredSpace {
    mean: Vec<f32>,
    deviations: Vec<f32>,
    steps: Vec<f32>,
    modes: Vec<i8>,
}

#[derive(Serialize, Deserialize)]
struct StoredFollower {
    mean: Vec<f32>,
    effects: Vec<Vec<f32>>,
}

#[derive(Serialize, Deserialize)]
struct StoredAttribute {
    group: String,
    name: String,
    low: String,
    high: String,
    derived: Option<String>,
    direction: Vec<f32>,
}

#[derive(Serialize, Deserialize)]
struct StoredShape {
    space: StoredSpace,
    cage: StoredFollower,
    organs: StoredFollower,
    triangles: Vec<[u32; 3]>,
    segments: Vec<Segment>,
    landmarks: Vec<(String, u32)>,
    attributes: Vec<StoredAttribute>,
    examples: Vec<Vec<f32>>,
    people: Vec<[f32; 5]>,
}

#[derive(Serialize, Deserialize)]
struct StoredTexture {
    space: StoredSpace,
    looks: Vec<(String, f32)>,
    attributes: Vec<StoredAttribute>,
    examples: Vec<Vec<f32>>,
    figures: Vec<(String, Vec<f32>)>,
}

fn single(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|&x| x as f32).collect()
}

fn double(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|&x| f64::from(x)).collect()
}

fn singles(rows: &[Vec<f64>]) -> Vec<Vec<f32>> {
    rows.iter().map(|row| single(row)).collect()
}

/// Rows of a length whose numbers are finite.
fn doubles(rows: &[Vec<f32>], length: usize) -> Option<Vec<Vec<f64>>> {
    let row = |row: &Vec<f32>| (row.len() == length).then(|| finite(row)).flatten();
    rows.iter().map(row).collect()
}

/// The numbers, where all are finite.
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
    if bytes.len() > MOST_BYTES {
        return Err(bad("it is larger than any pack"));
    }
    let Some(rest) = bytes.strip_prefix(format) else {
        let is_ours = bytes.starts_with(&format[..6]);
        let is_version = is_ours && bytes.get(6) == Some(&format[6]);
        return Err(bad(match (is_ours, is_version) {
            (true, true) => "it is another part of a pack",
            (true, false) => "it is of another version",
            _ => "it is no pack of faces",
        }));
    };
    postcard::from_bytes(rest).map_err(|e| bad(&e.to_string()))
}

pub(super) fn shape(model: &FaceModel) -> Result<Vec<u8>, FaceError> {
    let person = |p: &Personal| {
        let [a, b, c] = p.ancestry;
        [p.sex, p.age_years, a, b, c].map(|x| x as f32)
    };
    write(
        SHAPE,
        &StoredShape {
            space: StoredSpace::of(&model.shape),
            cage: StoredFollower::of(&model.cage),
            organs: StoredFollower::of(&model.organs),
            triangles: model.triangles.clone(),
            segments: model.segments.all().to_vec(),
            landmarks: model.landmarks.clone(),
            attributes: model.attributes.iter().map(StoredAttribute::of).collect(),
            examples: singles(&model.examples),
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
            space: StoredSpace::of(&model.space),
            looks: model.looks.iter().map(look).collect(),
            attributes: model.attributes.iter().map(StoredAttribute::of).collect(),
            examples: singles(&model.examples),
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

impl StoredSpace {
    fn of(space: &FaceSpace) -> Self {
        let mut steps = Vec::new();
        let mut modes = Vec::new();
        for mode in (0..space.dimensions()).map(|i| space.mode(i)) {
            let most = mode.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let step = f64::from((most / STEPS) as f32);
            steps.push(step as f32);
            let part = |x: &f64| (x / step).round().clamp(-STEPS, STEPS) as i8;
            modes.extend(mode.iter().map(part));
        }
        Self {
            mean: single(space.mean()),
            deviations: single(space.deviations()),
            steps,
            modes,
        }
    }

    fn read(self) -> Option<FaceSpace> {
        let (length, count) = (self.mean.len(), self.deviations.len());
        let is_whole =
            self.steps.len() == count && self.modes.len() == count.checked_mul(length)?;
        let steps = finite(&self.steps).filter(|_| is_whole)?;
        let rows = self.modes.chunks_exact(length.max(1)).zip(steps);
        let modes = rows
            .flat_map(|(mode, step)| mode.iter().map(move |&x| f64::from(x) * step))
            .collect();
        FaceSpace::from_parts(finite(&self.mean)?, modes, double(&self.deviations))
    }
}

impl StoredFollower {
    fn of(follower: &Follower) -> Self {
        Self {
            mean: single(&follower.mean),
            effects: singles(&follower.effects),
        }
    }

    /// A follower of so many coefficients, or of none where it has no numbers.
    fn read(self, count: usize) -> Option<Follower> {
        let fits = self.effects.len() == count || self.mean.is_empty();
        Some(Follower {
            effects: doubles(&self.effects, self.mean.len()).filter(|_| fits)?,
            mean: finite(&self.mean)?,
        })
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
            derived: named.derived.clone(),
            direction: single(named.attribute.direction()),
        }
    }

    fn read(self, space: &FaceSpace) -> Option<NamedAttribute> {
        if self.direction.len() != space.dimensions() {
            return None;
        }
        let direction = double(&self.direction);
        Some(NamedAttribute {
            group: self.group,
            terms: [self.low, self.high],
            derived: self.derived,
            attribute: Attribute::along(self.name, space, direction).ok()?,
        })
    }
}

/// The attributes of a space.
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
            all.iter().all(|x| x.is_finite()).then_some(Personal {
                sex,
                age_years,
                ancestry: [a, b, c],
            })
        };
        if !(is_mesh && is_known) {
            return None;
        }
        Some(FaceModel {
            cage: self.cage.read(count)?,
            organs: self.organs.read(count)?,
            segments: Segments::new(self.segments, length / 3)?,
            triangles: self.triangles,
            landmarks: self.landmarks,
            attributes: attributes(self.attributes, &shape)?,
            examples: doubles(&self.examples, count)?,
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
            examples: doubles(&self.examples, count)?,
            figures: self
                .figures
                .into_iter()
                .map(figure)
                .collect::<Option<_>>()?,
            space,
        })
    }
}

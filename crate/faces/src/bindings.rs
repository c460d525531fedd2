//! Functions exported to web pages: a face being edited. The wasm file is separate from the
//! player's.

use std::cell::RefCell;

use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use crate::change_cache::ChangeCache;
use crate::{Affine, Change, Constraint, Editor, Face, FaceModel, Half, Part, Region};

/// Contents of a pack; `FacePack` in `web/element/face/faces.ts`.
#[derive(Serialize)]
struct Contents<'a> {
    vertices: usize,
    faces: usize,
    attributes: Vec<AttributeEntry<'a>>,
    segments: Vec<SegmentEntry<'a>>,
    people: Vec<PersonEntry>,
    figures: Vec<&'a str>,
}

#[derive(Serialize)]
struct AttributeEntry<'a> {
    part: &'static str,
    group: &'a str,
    name: &'a str,
    terms: &'a [String; 2],
    derived: Option<&'a str>,
}

#[derive(Serialize)]
struct SegmentEntry<'a> {
    name: &'a str,
    parent: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PersonEntry {
    sex: f64,
    age_years: f64,
    ancestry: [f64; 3],
}

/// A constraint; `FaceConstraint` in `web/element/face/faces.ts`.
#[derive(Deserialize)]
struct FaceConstraint {
    part: String,
    name: String,
    value: f64,
    #[serde(default)]
    segments: Vec<String>,
    half: Option<String>,
}

fn part(name: &str) -> Result<Part, JsError> {
    match name {
        "shape" => Ok(Part::Shape),
        "texture" => Ok(Part::Texture),
        other => Err(JsError::new(&format!(
            "a part is shape or texture, not {other}"
        ))),
    }
}

fn half(name: Option<&str>) -> Result<Option<Half>, JsError> {
    match name {
        None => Ok(None),
        Some("left") => Ok(Some(Half::Left)),
        Some("right") => Ok(Some(Half::Right)),
        Some(other) => Err(JsError::new(&format!(
            "a half is left or right, not {other}"
        ))),
    }
}

/// Converts a list to three finite numbers; an error otherwise.
fn three(numbers: &[f64]) -> Result<[f64; 3], JsError> {
    let all: Result<[f64; 3], _> = numbers.try_into();
    all.ok()
        .filter(|all| all.iter().all(|x| x.is_finite()))
        .ok_or_else(|| JsError::new("expected three finite numbers"))
}

fn finite(number: f64) -> Result<f64, JsError> {
    if number.is_finite() {
        Ok(number)
    } else {
        Err(JsError::new("expected a finite number"))
    }
}

/// Names of segments and of a half, and the region that they are.
type AskedRegion = ((Vec<String>, Option<String>), Region);

/// Face model and a face that is being edited, for web pages.
#[wasm_bindgen]
pub struct Faces {
    editor: Editor,
    face: Face,
    lately: ChangeCache,
    /// Last requested region, with its segments and half as the key.
    region: RefCell<Option<AskedRegion>>,
    /// Correction that removed self-intersections from the last displayed face.
    straightened: Vec<f64>,
}

#[wasm_bindgen]
#[allow(
    clippy::needless_pass_by_value,
    reason = "lists of names arrive as owned only"
)]
impl Faces {
    /// Reads a pack's file of shapes. The exception's message names the fault.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8]) -> Result<Self, JsError> {
        let editor = Editor::new(FaceModel::from_bytes(bytes)?)?;
        let face = editor.average();
        Ok(Self {
            editor,
            face,
            lately: ChangeCache::default(),
            region: RefCell::new(None),
            straightened: Vec::new(),
        })
    }

    /// Reads the pack's file of textures; the face gets the average one.
    #[wasm_bindgen(js_name = addTexture)]
    pub fn add_texture(&mut self, bytes: &[u8]) -> Result<(), JsError> {
        self.editor.add_texture(bytes)?;
        self.face.texture = self.editor.average().texture;
        Ok(())
    }

    /// Returns the contents of the pack (attributes, segments, faces) as a JavaScript object.
    pub fn contents(&self) -> Result<JsValue, JsError> {
        let model = self.editor.model();
        let entries = [(Part::Shape, "shape"), (Part::Texture, "texture")].into_iter();
        let attributes = entries.flat_map(|(part, name)| {
            let all = self.editor.attributes(part).iter();
            all.map(move |a| AttributeEntry {
                part: name,
                group: &a.group,
                name: &a.attribute.name,
                terms: &a.terms,
                derived: a.derived.as_deref(),
            })
        });
        let segments = model.segments.all().iter().map(|s| SegmentEntry {
            name: &s.name,
            parent: s.parent,
        });
        let people = model.people.iter().map(|p| PersonEntry {
            sex: p.sex,
            age_years: p.age_years,
            ancestry: p.ancestry,
        });
        let texture = model.texture.as_ref();
        let figures = texture.map_or(&[][..], |t| t.figures.as_slice());
        let contents = Contents {
            vertices: model.vertices(),
            faces: model.examples.len(),
            attributes: attributes.collect(),
            segments: segments.collect(),
            people: people.collect(),
            figures: figures.iter().map(|(name, _)| name.as_str()).collect(),
        };
        Ok(contents.serialize(&Serializer::json_compatible())?)
    }

    /// Replaces the edited face by the average one.
    pub fn average(&mut self) {
        self.face = self.editor.average();
    }

    /// Sets a random face; the same seed gives the same face.
    pub fn random(&mut self, seed: u32) {
        self.face = self.editor.random(u64::from(seed));
    }

    /// Replaces the edited face by a face of the database.
    pub fn example(&mut self, index: usize) -> Result<(), JsError> {
        self.face = self.editor.example(index)?;
        Ok(())
    }

    fn region(&self, segments: &[String], side: Option<&str>) -> Result<Region, JsError> {
        let key = (segments.to_vec(), side.map(str::to_owned));
        if let Some((_, region)) = self.region.borrow().as_ref().filter(|(of, _)| *of == key) {
            return Ok(region.clone());
        }
        let names: Vec<&str> = segments.iter().map(String::as_str).collect();
        let region = self.editor.region(&names, half(side)?)?;
        *self.region.borrow_mut() = Some((key, region.clone()));
        Ok(region)
    }

    /// Returns a mask that is 1 at the vertices of the segments and all their parts, 0 elsewhere.
    pub fn mask(&self, segments: Vec<String>) -> Result<Vec<f64>, JsError> {
        let all = &self.editor.model().segments;
        let find = |name: &String| {
            let found = all.find(name);
            found.ok_or_else(|| JsError::new(&format!("there is no segment {name}")))
        };
        let chosen: Vec<usize> = segments.iter().map(find).collect::<Result<_, _>>()?;
        Ok(all.mask(&chosen, self.editor.model().vertices()))
    }

    /// Returns the name of the smallest segment that contains a vertex.
    #[wasm_bindgen(js_name = segmentAt)]
    pub fn segment_at(&self, vertex: u32) -> Option<String> {
        let found = self.editor.model().segments.segment_of(vertex);
        found.map(|s| s.name.clone())
    }

    /// Returns the database index of the person most similar to the random face of a seed.
    #[wasm_bindgen(js_name = randomPerson)]
    pub fn random_person(&self, seed: u32) -> Option<usize> {
        self.editor.random_person(u64::from(seed))
    }

    /// Returns the value of an attribute for the edited face.
    pub fn value(&self, of: &str, name: &str) -> Result<f64, JsError> {
        Ok(self.editor.value(&self.face, part(of)?, name)?)
    }

    /// Returns the face's values of all attributes of a part, in the order of the contents.
    pub fn values(&self, of: &str) -> Result<Vec<f64>, JsError> {
        Ok(self.editor.values(&self.face, part(of)?)?)
    }

    /// Adds an amount of an attribute in a region: segments, on one half or both; the whole head if
    /// no segments are given. `with_all` also adds the traits that correlate with it in people.
    pub fn add(
        &mut self,
        of: &str,
        name: &str,
        amount: f64,
        with_all: bool,
        segments: Vec<String>,
        half: Option<String>,
    ) -> Result<(), JsError> {
        let key = format!(
            "{of}\n{name}\n{with_all}\n{half:?}\n{}",
            segments.join("\n")
        );
        self.add_change(key, amount, |own| {
            let region = own.region(&segments, half.as_deref())?;
            Ok(if with_all {
                own.editor.change_with_all(part(of)?, name, &region)?
            } else {
                own.editor.attribute_change(part(of)?, name, &region)?
            })
        })
    }

    /// Adds an amount of the change with the given key, and computes the change if it is not
    /// cached.
    fn add_change(
        &mut self,
        key: String,
        amount: f64,
        make: impl FnOnce(&Self) -> Result<Change, JsError>,
    ) -> Result<(), JsError> {
        let amount = finite(amount)?;
        let mut lately = core::mem::take(&mut self.lately);
        let mut face = core::mem::take(&mut self.face);
        let added = lately.add(&mut face, key, amount, || make(self));
        (self.lately, self.face) = (lately, face);
        added
    }

    /// Adds an amount of an attribute in isolation: a feature changes only its own segments; a
    /// trait of the whole person changes the whole head so that other attributes of its part keep
    /// their values.
    #[wasm_bindgen(js_name = addAlone)]
    pub fn add_alone(
        &mut self,
        of: &str,
        name: &str,
        amount: f64,
        kept: Vec<String>,
    ) -> Result<(), JsError> {
        let key = format!("{of}\n{name}\nalone\n{}", kept.join("\n"));
        self.add_change(key, amount, |own| {
            let kept: Vec<&str> = kept.iter().map(String::as_str).collect();
            Ok(own.editor.change_alone(part(of)?, name, &kept)?)
        })
    }

    /// Ages the face of a region by a number of years (negative: makes it younger), by the average
    /// change for its sex, in shape and texture. Ages are from 8 to 80.
    #[wasm_bindgen(js_name = addYears)]
    pub fn add_years(
        &mut self,
        years: f64,
        segments: Vec<String>,
        half: Option<String>,
    ) -> Result<(), JsError> {
        let region = self.region(&segments, half.as_deref())?;
        let by = finite(years)?;
        let value = |name: &str| self.editor.value(&self.face, Part::Shape, name);
        let (age, sex) = (self.editor.years_of(value("age")?), 0.5 + value("sex")?);
        let parts = [Part::Shape, Part::Texture].into_iter();
        let changes = parts
            .filter(|part| !self.editor.attributes(*part).is_empty())
            .map(|part| {
                self.editor
                    .change_of_years(part, [age, age + by], sex, &region)
            })
            .collect::<Result<Vec<_>, _>>()?;
        for change in changes {
            self.face.add(&change, 1.0);
        }
        Ok(())
    }

    /// Exaggerates a region: above 1 a caricature, below nearer to everybody.
    pub fn caricature(
        &mut self,
        of: &str,
        level: f64,
        segments: Vec<String>,
        half: Option<String>,
    ) -> Result<(), JsError> {
        let region = self.region(&segments, half.as_deref())?;
        let (of, level) = (part(of)?, finite(level)?);
        self.editor.caricature(&mut self.face, of, level, &region);
        Ok(())
    }

    /// Copies a region from a face of the database.
    #[wasm_bindgen(js_name = importFrom)]
    pub fn import_from(
        &mut self,
        index: usize,
        of: &str,
        segments: Vec<String>,
        half: Option<String>,
    ) -> Result<(), JsError> {
        let region = self.region(&segments, half.as_deref())?;
        let from = self.editor.example(index)?;
        self.editor
            .import(&mut self.face, &from, part(of)?, &region);
        Ok(())
    }

    /// Scales a region about its middle, turns it (radians about x, y, z) and moves it (metres).
    pub fn transform(
        &mut self,
        scale: &[f64],
        turn_rad: &[f64],
        way_m: &[f64],
        segments: Vec<String>,
        half: Option<String>,
    ) -> Result<(), JsError> {
        let region = self.region(&segments, half.as_deref())?;
        let affine = Affine {
            scale: three(scale)?,
            turn_rad: three(turn_rad)?,
            translation_m: three(way_m)?,
        };
        self.editor.transform(&mut self.face, &affine, &region);
        Ok(())
    }

    /// Adds a multiple of the texture's own detail; 0.7 is usual.
    #[wasm_bindgen(js_name = addDetail)]
    pub fn add_detail(&mut self, strength: f64) -> Result<(), JsError> {
        let (own, strength) = (self.face.clone(), finite(strength)?);
        self.editor
            .add_detail(&mut self.face, &own, Part::Texture, strength);
        Ok(())
    }

    /// Brings the face to given attribute values; the exception names the first conflicting
    /// constraint.
    pub fn constrain(&mut self, held: JsValue) -> Result<(), JsError> {
        let held: Vec<FaceConstraint> = serde_wasm_bindgen::from_value(held)?;
        let all: Vec<Constraint> = held
            .into_iter()
            .map(|h| {
                Ok(Constraint {
                    part: part(&h.part)?,
                    value: finite(h.value)?,
                    region: self.region(&h.segments, h.half.as_deref())?,
                    name: h.name,
                })
            })
            .collect::<Result<_, JsError>>()?;
        self.editor.constrain(&mut self.face, &all)?;
        Ok(())
    }

    /// Returns the edited face as bytes, without any loss.
    pub fn keep(&self) -> Vec<u8> {
        let parts = [&self.face.shape, &self.face.organs, &self.face.texture];
        let mut bytes = Vec::with_capacity(8 * parts.iter().map(|part| part.len()).sum::<usize>());
        for x in parts.into_iter().flatten() {
            bytes.extend_from_slice(&x.to_le_bytes());
        }
        bytes
    }

    /// Restores a face saved by [`Self::keep`] from the same pack.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), JsError> {
        let numbers: Vec<f64> = bytes
            .as_chunks()
            .0
            .iter()
            .map(|b| f64::from_le_bytes(*b))
            .collect();
        let average = self.editor.average();
        let lengths = [&average.shape, &average.organs, &average.texture].map(Vec::len);
        let is_whole = bytes.len() == 8 * lengths.iter().sum::<usize>();
        if !(is_whole && numbers.iter().all(|x| x.is_finite())) {
            return Err(JsError::new("these bytes are not a face of this pack"));
        }
        let (shape, rest) = numbers.split_at(lengths[0]);
        let (organs, texture) = rest.split_at(lengths[1]);
        self.face = Face {
            shape: shape.to_vec(),
            organs: organs.to_vec(),
            texture: texture.to_vec(),
        };
        Ok(())
    }

    /// Returns x, y, z of each vertex of the skin; metres, frame of the head. A face that `moves`
    /// reuses the self-intersection correction of the last displayed face, so that a small change
    /// takes no time.
    pub fn skin(&mut self, moves: bool) -> Vec<f64> {
        let shape = &self.face.shape;
        if !moves || self.straightened.len() != shape.len() {
            let drawn = self.editor.drawn(&self.face);
            self.straightened = drawn
                .iter()
                .zip(shape)
                .map(|(to, from)| to - from)
                .collect();
            return drawn;
        }
        shape
            .iter()
            .zip(&self.straightened)
            .map(|(x, by)| x + by)
            .collect()
    }

    /// Returns the values of the inner parts of the head: centres of the eyes, rotations that close
    /// the lids, height of the chin.
    pub fn organs(&self) -> Vec<f64> {
        self.face.organs.clone()
    }

    /// Returns the factors for a figure's own colours: of each vertex of the skin, of the irises,
    /// of the brows; `None` if the pack does not contain the figure.
    pub fn factors(&self, figure: &str) -> Option<Vec<f64>> {
        let texture = self.editor.model().texture.as_ref()?;
        let factors = texture.factors(&self.face.texture, figure)?;
        let mut all = factors.skin;
        all.extend(factors.iris);
        all.extend(factors.brows);
        Some(all)
    }
}

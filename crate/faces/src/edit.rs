//! Face editing (F&H 5.1): attributes, features of other faces, caricature, moves, for the whole
//! face or segments of it, separately for shape and texture.
//!
//! An edited face may leave the spaces, so it is stored as all of its numbers.

mod affine;
mod constrain;
#[cfg(feature = "learn")]
mod learn;
mod random;
mod region;
#[cfg(test)]
pub(crate) mod tests;

use crate::age_model::GROWN_YEARS;
use crate::attribute::set_apart;
use crate::blend::VertexNeighbours;
use crate::error::FaceError;
use crate::lips::Lips;
use crate::order_constraints::OrderConstraints;
use crate::pack::{Difference, FaceModel, NamedAttribute};
use crate::space::FaceSpace;

pub use affine::Affine;
pub use constrain::Constraint;
#[cfg(feature = "learn")]
pub use learn::FeatureMeasure;
pub use region::Region;

/// Part of a face that is edited separately: shape or texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Geometry of the skin.
    Shape,
    /// Appearance of the skin.
    Texture,
}

/// Face as vertex positions, inner parts and texture; the object that an [`Editor`] changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Face {
    /// x, y and z of each vertex of the skin, metres, frame of the head.
    pub shape: Vec<f64>,
    /// Values of the inner parts of the head, as in [`FaceModel::organs`].
    pub organs: Vec<f64>,
    /// Logarithms of linear red, green and blue of each vertex, then the appearance numbers; empty
    /// without a texture part.
    pub texture: Vec<f64>,
}

/// Change of a face: numbers to add to those of a [`Face`], scaled by an amount.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    part: Part,
    numbers: Vec<f64>,
    organs: Vec<f64>,
}

/// Face model with precomputed data for editing faces (F&H 5.1): attributes, imported features,
/// caricatures and moves.
///
/// # Examples
///
/// ```
/// use raconteur_faces::{Editor, FaceModel};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let pack = std::fs::read("../../assets/faces/people.faces")?;
/// let editor = Editor::new(FaceModel::from_bytes(&pack)?)?;
/// let face = editor.average();
/// assert_eq!(editor.drawn(&face).len(), 3 * editor.model().vertices());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Editor {
    model: FaceModel,
    neighbours: VertexNeighbours,
    untangle: Option<OrderConstraints>,
    lips: Option<Lips>,
}

/// Random stream of textures, distinct from that of shapes.
const TEXTURE_STREAM: u64 = 0x7E77;

/// Groups of attributes that are made of many features.
const OF_PERSONS: [&str; 3] = ["overall", "ethnicity", "life"];

/// Strength of detail that looks good according to F&H 5.1.9.
pub const USUAL_DETAIL: f64 = 0.7;

impl Editor {
    /// Creates an editor for the faces of a model.
    ///
    /// # Errors
    /// Returns an error if the model's triangles do not match its vertices.
    pub fn new(mut model: FaceModel) -> Result<Self, FaceError> {
        let neighbours = VertexNeighbours::from_triangles(&model.triangles, model.vertices());
        let neighbours = neighbours.ok_or_else(|| FaceError::BadPack {
            why: "its triangles are not of its vertices".to_owned(),
        })?;
        separate(&model.shape, &mut model.attributes);
        if let Some(texture) = &mut model.texture {
            separate(&texture.space, &mut texture.attributes);
        }
        let lips = Lips::find(&model.segments, &model.triangles, model.shape.mean());
        let untangle = OrderConstraints::find(&model.reference, &model.triangles);
        Ok(Self {
            model,
            neighbours,
            untangle,
            lips,
        })
    }

    /// Returns the face model.
    #[must_use]
    pub fn model(&self) -> &FaceModel {
        &self.model
    }

    /// Reads the texture part of the model.
    ///
    /// # Errors
    /// Returns the same errors as [`FaceModel::add_texture`].
    pub fn add_texture(&mut self, bytes: &[u8]) -> Result<(), FaceError> {
        self.model.add_texture(bytes)?;
        if let Some(texture) = &mut self.model.texture {
            separate(&texture.space, &mut texture.attributes);
        }
        Ok(())
    }

    /// Returns the face with these shape and texture coefficients; missing ones are zero.
    #[must_use]
    pub fn face(&self, shape: &[f64], texture: &[f64]) -> Face {
        let textures = self.model.texture.as_ref();
        Face {
            shape: self.model.shape.face(shape),
            organs: self.model.organs.evaluate(shape),
            texture: textures.map_or_else(Vec::new, |t| t.space.face(texture)),
        }
    }

    /// Returns the average face of the model.
    #[must_use]
    pub fn average(&self) -> Face {
        self.face(&[], &[])
    }

    /// Returns the shape of a face for display, without self-intersections. Edits continue from the
    /// uncorrected face.
    #[must_use]
    pub fn drawn(&self, face: &Face) -> Vec<f64> {
        let mut shape = face.shape.clone();
        if let Some(lips) = self
            .lips
            .as_ref()
            .filter(|_| shape.len() == self.model.shape.length())
        {
            lips.separate(&self.neighbours, &mut shape);
        }
        if let Some(untangle) = &self.untangle {
            untangle.straighten(&mut shape);
        }
        shape
    }

    /// Returns a face of the model's database by its index.
    ///
    /// # Errors
    /// Returns an error if there is no face with this index.
    pub fn example(&self, index: usize) -> Result<Face, FaceError> {
        let own = self.model.examples.get(index);
        let shape = own.ok_or(FaceError::NoExample {
            index,
            count: self.model.examples.len(),
        })?;
        let textures = self.model.texture.as_ref();
        let texture = textures.and_then(|t| t.examples.get(index));
        Ok(self.face(shape, texture.map_or(&[], Vec::as_slice)))
    }

    /// Returns the coefficients of the face in the space of a part that is nearest to a face.
    ///
    /// # Errors
    /// Returns an error if the face is from another model, or there are no textures.
    pub fn coefficients(&self, face: &Face, part: Part) -> Result<Vec<f64>, FaceError> {
        self.space(part)?.coefficients(face.part(part))
    }

    /// Returns the attribute value of a face: 0 for the average.
    ///
    /// # Errors
    /// Returns an error if this part has no such attribute, or the face is from another model.
    pub fn value(&self, face: &Face, part: Part, name: &str) -> Result<f64, FaceError> {
        let named = self.named(part, name)?;
        let space = self.space(part)?;
        let own = difference(face.part(part), space)?;
        Ok(named.value_of(space, &Difference::new(&own)))
    }

    /// Returns the values of all attributes of a part of a face, in the order of
    /// [`Self::attributes`].
    ///
    /// # Errors
    /// Returns an error if the face is from another model, or there are no textures.
    pub fn values(&self, face: &Face, part: Part) -> Result<Vec<f64>, FaceError> {
        let space = self.space(part)?;
        let own = difference(face.part(part), space)?;
        let own = Difference::new(&own);
        let all = self.attributes(part).iter();
        Ok(all.map(|a| a.value_of(space, &own)).collect())
    }

    /// Returns the change for one unit of an attribute in a region; other features change little.
    /// For a feature on the whole head, the change is limited to the feature's own segments.
    ///
    /// # Errors
    /// Returns an error if this part has no such attribute.
    pub fn attribute_change(
        &self,
        part: Part,
        name: &str,
        region: &Region,
    ) -> Result<Change, FaceError> {
        let named = self.named(part, name)?;
        let Some(feature) = &named.feature else {
            let mut along = vec![0.0; self.space(part)?.dimensions()];
            named.attribute.add(&mut along, 1.0);
            return self.change_of(part, &along, region);
        };
        if region.is_of_segments() {
            return self.change_of(part, &feature.alone, region);
        }
        let names: Vec<&str> = feature.segments.iter().map(String::as_str).collect();
        let own = self.region(&names, region.half().or(feature.half))?;
        let mut change = self.change_of(part, &feature.alone, &own)?;
        if region.half().is_none() {
            // Numbers of a pack are rounded; one more is one more.
            let value = named.value_of(self.space(part)?, &Difference::new(&change.numbers));
            change.scale(1.0 / value);
        }
        Ok(change)
    }

    /// Returns [`Self::attribute_change`] together with all traits that correlate with the
    /// attribute in people.
    ///
    /// # Errors
    /// Returns an error if this part has no such attribute.
    pub fn change_with_all(
        &self,
        part: Part,
        name: &str,
        region: &Region,
    ) -> Result<Change, FaceError> {
        let attribute = &self.named(part, name)?.attribute;
        self.change_of(part, &attribute.with_all(self.space(part)?), region)
    }

    /// Returns the age for a value of the age attribute, years; the ends of the range are two
    /// standard deviations of people from their mean. Returns the adult age if the model has no age
    /// data.
    #[must_use]
    pub fn years_of(&self, value: f64) -> f64 {
        let ages = || self.model.people.iter().map(|p| p.age_years);
        let count = self.model.people.len() as f64;
        if count == 0.0 {
            return GROWN_YEARS;
        }
        let mean = ages().sum::<f64>() / count;
        let square = ages().map(|age| (age - mean) * (age - mean)).sum::<f64>();
        mean + 2.0 * (square / count).sqrt() * value
    }

    /// Returns the change between two ages for a person of a sex (0 male to 1) in a region: growth
    /// to 20 years, ageing after that; ages from 8 to 80. Empty if the model has no age data.
    ///
    /// # Errors
    /// Returns an error if there are no textures.
    pub fn change_of_years(
        &self,
        part: Part,
        years: [f64; 2],
        sex: f64,
        region: &Region,
    ) -> Result<Change, FaceError> {
        let [from, to] = years;
        let along = match part {
            Part::Shape => self.model.life.change(from, to, sex),
            Part::Texture => {
                let texture = self.model.texture.as_ref().ok_or(FaceError::NoTexture)?;
                texture.life.change(from, to, sex)
            }
        };
        self.change_of(part, &along, region)
    }

    /// Returns the change that face-space coefficients make in a region.
    pub(crate) fn change_of(
        &self,
        part: Part,
        along: &[f64],
        region: &Region,
    ) -> Result<Change, FaceError> {
        let numbers = self.space(part)?.difference(along);
        let organs = match part {
            Part::Shape => self.model.organs.change(along),
            Part::Texture => Vec::new(),
        };
        Ok(self.restrict(
            Change {
                part,
                numbers,
                organs,
            },
            region,
        ))
    }

    /// Limits a change of the whole head to a region.
    fn restrict(&self, change: Change, region: &Region) -> Change {
        let Some(mask) = region.mask() else {
            return change;
        };
        let vertices = 3 * self.model.vertices();
        let (colours, looks) = change.numbers.split_at(vertices);
        let mut numbers = self.neighbours.blended(colours, mask);
        let shares = looks.iter().enumerate();
        numbers.extend(shares.map(|(i, x)| x * region.look_share(i)));
        let shares = change.organs.iter().enumerate();
        Change {
            part: change.part,
            numbers,
            organs: shares.map(|(i, x)| x * region.organ_share(i)).collect(),
        }
    }

    /// Scales the difference from the average face by `level` in a region (F&H 3.2.2): a caricature
    /// above 1, a more average face below.
    pub fn caricature(&self, face: &mut Face, part: Part, level: f64, region: &Region) {
        let average = self.average();
        let change = self.restrict(Change::between(&average, face, part), region);
        face.add(&change, level - 1.0);
    }

    /// Copies a region of shape or texture from another face (F&H 5.1.5).
    pub fn import(&self, face: &mut Face, from: &Face, part: Part, region: &Region) {
        let change = self.restrict(Change::between(face, from, part), region);
        face.add(&change, 1.0);
    }

    /// Moves, turns and scales a region about its middle.
    pub fn transform(&self, face: &mut Face, affine: &Affine, region: &Region) {
        let middle = region.middle(&face.shape);
        let go = |p: &[f64; 3]| affine.apply(*p, middle);
        let moved: Vec<f64> = face.shape.as_chunks::<3>().0.iter().flat_map(go).collect();
        let mut organs = face.organs.clone();
        for eye in organs.as_chunks_mut::<3>().0.iter_mut().take(2) {
            *eye = affine.apply(*eye, middle);
        }
        let other = Face {
            shape: moved,
            organs,
            texture: face.texture.clone(),
        };
        self.import(face, &other, Part::Shape, region);
    }

    /// Adds a multiple of the detail of another face that is finer than some 5 mm (F&H 5.1.9).
    pub fn add_detail(&self, face: &mut Face, from: &Face, part: Part, strength: f64) {
        let vertices = 3 * self.model.vertices();
        if let Some(numbers) = from.part(part).get(..vertices) {
            let detail = self.neighbours.detail(numbers);
            for (x, d) in face.part_mut(part).iter_mut().zip(detail) {
                *x += strength * d;
            }
        }
    }

    fn space(&self, part: Part) -> Result<&FaceSpace, FaceError> {
        match part {
            Part::Shape => Ok(&self.model.shape),
            Part::Texture => {
                let texture = self.model.texture.as_ref();
                texture.map(|t| &t.space).ok_or(FaceError::NoTexture)
            }
        }
    }

    /// Returns the attributes of shape or texture; empty for textures that were not loaded.
    #[must_use]
    pub fn attributes(&self, part: Part) -> &[NamedAttribute] {
        match part {
            Part::Shape => &self.model.attributes,
            Part::Texture => {
                let texture = self.model.texture.as_ref();
                texture.map_or(&[], |t| t.attributes.as_slice())
            }
        }
    }

    pub(crate) fn named(&self, part: Part, name: &str) -> Result<&NamedAttribute, FaceError> {
        let mut all = self.attributes(part).iter();
        let found = all.find(|a| a.attribute.name == name);
        found.ok_or_else(|| FaceError::NoAttribute {
            name: name.to_owned(),
        })
    }
}

/// Returns the difference of a face from the average.
fn difference(numbers: &[f64], space: &FaceSpace) -> Result<Vec<f64>, FaceError> {
    if numbers.len() != space.length() {
        return Err(FaceError::Correspondence {
            example: 0,
            found: numbers.len(),
            expected: space.length(),
        });
    }
    let pairs = numbers.iter().zip(space.mean());
    Ok(pairs.map(|(x, mean)| x - mean).collect())
}

/// Decorrelates the changes of features; traits of the whole person may change all of them.
fn separate(space: &FaceSpace, attributes: &mut [NamedAttribute]) {
    let features = attributes.iter_mut();
    let features =
        features.filter(|a| a.derived.is_none() && !OF_PERSONS.contains(&a.group.as_str()));
    set_apart(space, features.map(|a| &mut a.attribute).collect());
}

impl Face {
    /// Returns the numbers of shape or texture.
    #[must_use]
    pub fn part(&self, part: Part) -> &[f64] {
        match part {
            Part::Shape => &self.shape,
            Part::Texture => &self.texture,
        }
    }

    fn part_mut(&mut self, part: Part) -> &mut [f64] {
        match part {
            Part::Shape => &mut self.shape,
            Part::Texture => &mut self.texture,
        }
    }

    /// Adds a change, multiplied by `amount`, to the face.
    pub fn add(&mut self, change: &Change, amount: f64) {
        let numbers = self.part_mut(change.part).iter_mut();
        for (x, by) in numbers.zip(&change.numbers) {
            *x += amount * by;
        }
        for (x, by) in self.organs.iter_mut().zip(&change.organs) {
            *x += amount * by;
        }
    }
}

impl Change {
    fn scale(&mut self, by: f64) {
        let all = self.numbers.iter_mut().chain(&mut self.organs);
        all.for_each(|x| *x *= by);
    }

    /// Returns the numbers added to those of its part.
    #[cfg(any(test, target_arch = "wasm32", feature = "learn"))]
    pub(crate) fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// Returns the part that it changes.
    #[cfg(any(test, target_arch = "wasm32"))]
    pub(crate) fn part(&self) -> Part {
        self.part
    }

    /// Returns the numbers added to the values of the inner parts of the head.
    #[cfg(any(test, target_arch = "wasm32"))]
    pub(crate) fn organs(&self) -> &[f64] {
        &self.organs
    }

    fn between(from: &Face, to: &Face, part: Part) -> Self {
        let difference = |a: &[f64], b: &[f64]| b.iter().zip(a).map(|(b, a)| b - a).collect();
        Self {
            part,
            numbers: difference(from.part(part), to.part(part)),
            organs: match part {
                Part::Shape => difference(&from.organs, &to.organs),
                Part::Texture => Vec::new(),
            },
        }
    }
}

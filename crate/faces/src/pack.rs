//! Files of a face model: a part for shape, which suffices to start, and a part for texture.
//!
//! Modes are stored as one byte per number, each mode with its own step: a 127th of its largest
//! number. The rest is in single precision. `postcard` reads and writes it, after eight bytes that
//! specify the format, its version and the part.

mod stored;
#[cfg(test)]
mod tests;

use core::cell::OnceCell;

use raconteur_base::ops;

use crate::age_model::AgeModel;
use crate::attribute::Attribute;
use crate::error::FaceError;
use crate::feature::Feature;
use crate::person::PersonRecord;
use crate::segment::Segments;
use crate::space::FaceSpace;

/// A part of a pack is not larger, bytes.
pub const MAX_BYTES: usize = 64 << 20;
/// Maximum number of modes of a space in a pack: more make no visible difference and slow down
/// reading.
pub const MAX_MODES: usize = 256;

/// Face model (F&H 3.2): shape space, segments, attributes, database faces and, optionally,
/// textures; stored in a pack.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceModel {
    /// Shapes: x, y and z of each vertex of the skin, metres, in the frame of the head.
    pub shape: FaceSpace,
    /// Positions of the head's cage, millimetres, linear in the coefficients of the shape.
    pub cage: DependentNumbers,
    /// Values of the inner parts of the head, linear in the coefficients like the cage: centres of
    /// the eyes (metres), rotations that close the lids (radians), height of the chin (metres);
    /// empty if unknown.
    pub organs: DependentNumbers,
    /// Reference head without self-intersections, as [`Self::shape`]; empty if there is none.
    pub reference: Vec<f64>,
    /// The triangles of the skin, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Segments of the face.
    pub segments: Segments,
    /// Named vertices of the skin.
    pub landmarks: Vec<(String, u32)>,
    /// The attributes of shape.
    pub attributes: Vec<NamedAttribute>,
    /// Change of shapes with age.
    pub life: AgeModel,
    /// Database that features are imported from: the coefficients of its faces.
    pub examples: Vec<Vec<f64>>,
    /// Records of the people of the database; one per face, or none.
    pub people: Vec<PersonRecord>,
    /// Texture part of the model; `None` if it was not read.
    pub texture: Option<TextureModel>,
}

/// Texture part of a face model: texture space with attributes and database faces.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureModel {
    /// Textures: natural logarithms of linear red, green and blue of each vertex of the skin, then
    /// [`Self::looks`].
    pub space: FaceSpace,
    /// Appearance numbers at the end of a texture, in addition to the vertex colours: irises,
    /// brows, skin properties.
    pub looks: Vec<LookNumber>,
    /// The attributes of texture.
    pub attributes: Vec<NamedAttribute>,
    /// Change of textures with age.
    pub life: AgeModel,
    /// Coefficients of the database's faces, in the order of [`FaceModel::examples`].
    pub examples: Vec<Vec<f64>>,
    /// Coefficients of figures by name: the appearance of their own maps.
    pub figures: Vec<(String, Vec<f64>)>,
}

/// Appearance number at the end of a texture, for example of irises or brows.
#[derive(Clone, Debug, PartialEq)]
pub struct LookNumber {
    /// Name of the appearance number.
    pub name: String,
    /// Weight of one unit relative to the colours, natural logarithms.
    pub weight: f64,
}

/// Attribute as shown to users, with its group, terms for both ends and location.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedAttribute {
    /// Group of the attribute in Table 5.2 of F&H.
    pub group: String,
    /// Terms for −1 and for +1.
    pub terms: [String; 2],
    /// Formula of an impression derived without ratings; `None` if the attribute was measured or
    /// rated.
    pub derived: Option<String>,
    /// Direction of the attribute in the face space.
    pub attribute: Attribute,
    /// Feature on the skin; `None` for a trait of the whole person.
    pub feature: Option<Feature>,
}

impl NamedAttribute {
    /// Returns the change of the attribute value for a difference between two faces.
    pub(crate) fn value_of(&self, space: &FaceSpace, difference: &Difference<'_>) -> f64 {
        match &self.feature {
            Some(feature) if !feature.gradient.is_empty() => feature.measured(difference.numbers),
            _ => self.attribute.value(space, difference.along(space)),
        }
    }
}

/// Difference between two faces, with its projection on the modes computed on first use.
pub(crate) struct Difference<'n> {
    numbers: &'n [f64],
    along: OnceCell<Vec<f64>>,
}

impl<'n> Difference<'n> {
    pub(crate) fn new(numbers: &'n [f64]) -> Self {
        Self {
            numbers,
            along: OnceCell::new(),
        }
    }

    fn along(&self, space: &FaceSpace) -> &[f64] {
        self.along.get_or_init(|| space.along(self.numbers))
    }
}

/// Numbers that depend linearly on face-space coefficients, such as the positions of the control
/// mesh or of the eyes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DependentNumbers {
    mean: Vec<f64>,
    /// Effect of each coefficient on each number.
    effects: Vec<Vec<f64>>,
}

impl DependentNumbers {
    /// Fits the linear function to examples by least squares. The coefficients are uncorrelated, so
    /// each has its own effect. `values` belong to `coefficients`.
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

    /// Returns the dependent numbers for the coefficients of a face.
    #[must_use]
    pub fn evaluate(&self, coefficients: &[f64]) -> Vec<f64> {
        let change = self.change(coefficients);
        self.mean.iter().zip(change).map(|(m, c)| m + c).collect()
    }

    /// Returns the change of the numbers caused by coefficients.
    #[must_use]
    pub fn change(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut numbers = vec![0.0; self.mean.len()];
        for (effect, c) in self.effects.iter().zip(coefficients) {
            for (number, by) in numbers.iter_mut().zip(effect) {
                *number += c * by;
            }
        }
        numbers
    }
}

impl FaceModel {
    /// Returns the number of vertices in the skin.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.shape.length() / 3
    }

    /// Serialises the shape part to a file. The same model gives the same bytes.
    ///
    /// # Errors
    /// Returns an error if the part is too large for the format.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FaceError> {
        stored::shape(self)
    }

    /// Reads the output of [`Self::to_bytes`]; add textures with [`Self::add_texture`].
    ///
    /// # Errors
    /// Returns an error if the bytes are of another format, damaged, or of another version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, FaceError> {
        stored::read_shape(bytes)
    }

    /// Reads the texture part that [`TextureModel::to_bytes`] wrote into the model.
    ///
    /// # Errors
    /// Returns an error if the bytes are of another format, damaged, of another version or of
    /// another model; the model is then unchanged.
    pub fn add_texture(&mut self, bytes: &[u8]) -> Result<(), FaceError> {
        let texture = stored::read_texture(bytes)?;
        let vertices = texture.space.length().checked_sub(texture.looks.len());
        let fits = vertices == Some(self.shape.length())
            && (texture.examples.is_empty() || texture.examples.len() == self.examples.len());
        if !fits {
            return Err(FaceError::BadPack {
                why: "its textures are of another model than its shapes".to_owned(),
            });
        }
        self.texture = Some(texture);
        Ok(())
    }
}

impl TextureModel {
    /// Serialises the texture part to a file. The same model gives the same bytes.
    ///
    /// # Errors
    /// Returns an error if the part is too large for the format.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FaceError> {
        stored::texture(self)
    }

    /// Returns the appearance numbers of a texture, in the order of [`Self::looks`].
    #[must_use]
    pub fn look_values(&self, texture: &[f64]) -> Vec<f64> {
        let colours = self.space.length() - self.looks.len();
        let numbers = texture.get(colours..).unwrap_or_default();
        let parts = numbers.iter().zip(&self.looks);
        parts.map(|(x, look)| x / look.weight).collect()
    }

    /// Returns the factors that turn a figure's own colours into a texture; `None` if its map is
    /// unknown.
    #[must_use]
    pub fn factors(&self, texture: &[f64], figure: &str) -> Option<Factors> {
        let (_, own) = self.figures.iter().find(|(name, _)| name == figure)?;
        let colours = self.space.length() - self.looks.len();
        let own = self.space.face(own);
        if texture.len() != own.len() {
            return None;
        }
        let [to, from] = [texture, &own].map(|t| self.look_values(t));
        let factor = |name: &str| {
            let index = self.looks.iter().position(|look| look.name == name);
            index.map_or(1.0, |i| ops::exp(to[i] - from[i]))
        };
        let of = |what: &str| {
            ["red", "green", "blue"].map(|c| factor(&format!("{c} part of the {what}")))
        };
        let pairs = texture[..colours].iter().zip(&own);
        Some(Factors {
            skin: pairs.map(|(to, from)| ops::exp(to - from)).collect(),
            iris: of("iris"),
            brows: of("brows"),
        })
    }
}

/// Factors by which a face multiplies the colours of a figure's skin, irises and brows; linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Factors {
    /// Red, green and blue at each vertex of the skin.
    pub skin: Vec<f64>,
    /// Colour factor of the irises: red, green and blue, linear.
    pub iris: [f64; 3],
    /// Colour factor of brows and lashes: red, green and blue, linear.
    pub brows: [f64; 3],
}

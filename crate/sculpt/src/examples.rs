//! Random heads in correspondence: the examples for learning a face space (F&H 3.2.1, which used
//! scans).

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side, noise};

use crate::head::{
    BareSkin, Binding, FIELDS, HeadParams, HeadSegment, KnownMeasure, ModelHeadShape, Organs,
    expression_fields, field_index, known_measures,
};
use crate::looks::{self, Look};
use crate::model::{Detail, Model, ModelError, Traits};
use crate::people::{self, FigureParams};
use crate::person::Person;
use crate::population;
use crate::skin::SkinParams;
use crate::skin::tone::Tones;

/// Generator of random heads in correspondence, the examples from which the face space of a crowd
/// is learned.
pub struct Examples<'m> {
    model: &'m Model,
    details: Vec<Detail>,
    /// Mean values of details. The body model's mean matches no real person: its eyes are small,
    /// its mouth is high and narrow. Details vary around those of the bundled figures, which were
    /// fitted to surveys.
    centre: BTreeMap<String, f64>,
    binding: Binding,
    tones: Tones,
    like: FigureParams,
    seed: u64,
}

/// Computes the mean amounts of the head details over the bundled figures.
fn centre() -> BTreeMap<String, f64> {
    let mut sums: BTreeMap<String, f64> = BTreeMap::new();
    let figures: Vec<FigureParams> = people::NAMES
        .iter()
        .filter_map(|n| people::preset(n))
        .collect();
    for (name, amount) in figures.iter().flat_map(|f| &f.head.traits.details) {
        *sums.entry(name.clone()).or_default() += amount / figures.len() as f64;
    }
    sums
}

/// Maximum amount of a detail.
const MAX_DETAIL: f64 = 0.95;

/// Randomly generated person before the crowd is matched to the statistics of its population.
#[derive(Clone, Debug)]
pub struct Draft {
    /// The person of the body model.
    pub traits: Traits,
    /// Amounts of [`FIELDS`], in their order.
    pub fields: Vec<f64>,
    /// Appearance apart from the shape.
    pub look: Look,
    /// Head shape at the cage of the head; expression fields are added only after matching to the
    /// population, because the measured people have neutral faces.
    pub bound: ModelHeadShape,
}

/// Random head of a crowd with its skin, tone and measures; one example for learning the face
/// space.
#[derive(Clone, Debug)]
pub struct Example {
    /// Person, with the head matched to the population.
    pub draft: Draft,
    /// Vertices of the rendered skin, x, y, z of each; metres in the frame of the head.
    pub skin: Vec<f64>,
    /// Natural logarithms of linear red, green and blue of each vertex.
    pub tone: Vec<f64>,
    /// Inner parts of the head.
    pub organs: Organs,
    /// The triangles of the skin, the same for all.
    pub triangles: Vec<[u32; 3]>,
    /// Segments of the skin, the same for all.
    pub segments: Vec<HeadSegment>,
    /// Measures of the head by name, millimetres.
    pub measures: Vec<(&'static str, f64)>,
    /// Named vertices of the skin.
    pub landmarks: Vec<(String, u32)>,
    /// Crests of the left and the right brow from their inner ends, millimetres in the frame of the head.
    pub brows: [Vec<DVec3>; 2],
}

impl Example {
    /// Returns the measure with a name, millimetres; `None` for an unknown name.
    #[must_use]
    pub fn measure(&self, name: &str) -> Option<f64> {
        let found = self.measures.iter().find(|(known, _)| *known == name);
        found.map(|(_, mm)| *mm)
    }

    /// Returns a named landmark of the skin, millimetres in the frame of the head.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<DVec3> {
        let found = self.landmarks.iter().find(|(known, _)| known == name)?;
        let p = self.skin.as_chunks::<3>().0.get(found.1 as usize)?;
        Some(DVec3::from_array(*p) * 1e3)
    }

    /// Returns the amount of the local field with a name; `None` for an unknown name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<f64> {
        self.draft.fields.get(field_index(name)?).copied()
    }

    /// Returns the appearance number with a name, for example `moles`; `None` for an unknown name.
    #[must_use]
    pub fn look_value(&self, name: &str) -> Option<f64> {
        let index = looks::NAMES.iter().position(|known| *known == name)?;
        Some(self.draft.look[index])
    }

    /// Returns the shares of European, Asian and African ancestry, which sum to 1.
    #[must_use]
    pub fn ancestry(&self) -> [f64; 3] {
        let a = self.draft.traits.ancestry;
        let all = a.european + a.asian + a.african;
        [a.european, a.asian, a.african].map(|share| share / all)
    }
}

impl<'m> Examples<'m> {
    /// Creates the generator of a crowd from a seed. The heads vary; everything else is taken from
    /// `like`.
    ///
    /// # Errors
    /// Returns an error if the model cannot be read.
    pub fn new(model: &'m Model, like: FigureParams, seed: u64) -> Result<Self, ModelError> {
        Ok(Self {
            details: model.details()?,
            centre: centre(),
            binding: Binding::new(model.faces()),
            tones: Tones::new(&like.person, &like.head),
            like,
            model,
            seed,
        })
    }

    /// Generates person number `index` from the body model's statistics, with additional
    /// deformation fields.
    ///
    /// # Errors
    /// Returns an error if the model lacks a target that the traits name.
    pub fn draft(&self, index: u64) -> Result<Draft, ModelError> {
        let mut traits = Traits::random(&self.details, self.seed, index);
        for detail in &self.details {
            let all = detail.names.iter().filter_map(|n| self.centre.get(n));
            let centre = all.sum::<f64>() / detail.names.len() as f64;
            for name in &detail.names {
                let amount = traits.details.entry(name.clone()).or_default();
                *amount = (*amount + centre).clamp(-MAX_DETAIL, MAX_DETAIL);
            }
        }
        let bell = |k: i64| -> f64 {
            (0..3)
                .map(|j| noise::signed(self.seed ^ 0xF1E1D, index, 3 * k + j))
                .sum()
        };
        let fields: Vec<f64> = (0..)
            .zip(&FIELDS)
            .map(|(k, field)| field.deviation * bell(k))
            .collect();
        Ok(Draft {
            bound: self
                .binding
                .bind(&self.model.shape(&traits)?)
                .with_fields(&of_expressions(&fields, false)),
            look: looks::random(&traits, self.seed, index),
            traits,
            fields,
        })
    }

    /// Matches a crowd to the measures of the population.
    #[must_use]
    pub fn fitted_to_population(&self, drafts: Vec<Draft>) -> Vec<Draft> {
        let people: Vec<Traits> = drafts.iter().map(|d| d.traits.clone()).collect();
        let mut heads: Vec<ModelHeadShape> = drafts.iter().map(|d| d.bound.clone()).collect();
        let drawn = |traits: &Traits, bound: &ModelHeadShape| {
            let params = params_of(&self.like, traits.clone(), bound.clone());
            let skin = BareSkin::build(&params.person, &params.head);
            let taken = measured_mm(&|name| place(&skin, name));
            core::array::from_fn(|i| taken.get(i).map_or(0.0, |(_, mm)| *mm))
        };
        population::fit_population(&people, &mut heads, &drawn);
        let both = drafts.into_iter().zip(heads);
        let posed = |(draft, bound): (Draft, ModelHeadShape)| Draft {
            bound: bound.with_fields(&of_expressions(&draft.fields, true)),
            ..draft
        };
        both.map(posed).collect()
    }

    /// Builds the head of a draft and takes its measures.
    #[must_use]
    pub fn make(&self, draft: Draft) -> Example {
        let params = params_of(&self.like, draft.traits.clone(), draft.bound.clone());
        let skin = BareSkin::build(&params.person, &params.head);
        let measures = measured_mm(&|name| place(&skin, name));
        let coordinates = skin.positions.iter().flat_map(DVec3::to_array);
        Example {
            skin: coordinates.collect(),
            tone: self.tone(&draft.look),
            organs: skin.organs,
            triangles: skin.faces.iter().flat_map(|f| fan(f)).collect(),
            measures,
            landmarks: skin.landmarks,
            segments: skin.segments,
            brows: [Side::Left, Side::Right].map(|side| draft.bound.brow_of(side)),
            draft,
        }
    }

    /// Returns, for each expression field by its index in [`FIELDS`], the displacement of the mean
    /// head's skin at amount 1.
    #[must_use]
    pub fn expressions(&self) -> Vec<(usize, Vec<f64>)> {
        let skin = |amounts: &[f64]| {
            let bound = ModelHeadShape::default().with_fields(amounts);
            let head = HeadParams {
                bound,
                ..self.like.head.clone()
            };
            BareSkin::build(&self.like.person, &head).positions
        };
        let effect = |field: usize| {
            let at = |by: f64| {
                let mut amounts = vec![0.0; FIELDS.len()];
                amounts[field] = by * FIELDS[field].deviation;
                skin(&amounts)
            };
            let (more, less) = (at(1.0), at(-1.0));
            let step = 2.0 * FIELDS[field].deviation;
            let ways = more.iter().zip(&less);
            ways.flat_map(|(a, b)| ((*a - *b) / step).to_array())
                .collect()
        };
        expression_fields()
            .map(|field| (field, effect(field)))
            .collect()
    }

    /// Returns the tone of a look, in the format of [`Example::tone`].
    #[must_use]
    pub fn tone(&self, look: &Look) -> Vec<f64> {
        let skin = looks::skin(look, &SkinParams::plain());
        self.tones.evaluate(&skin, looks::brows(look))
    }
}

/// Returns a named landmark of a skin, metres; for the pupils, the centres of the eyes.
fn place(skin: &BareSkin, name: &str) -> Option<DVec3> {
    let [left, right] = skin.organs.eye_centres;
    let found = skin.landmarks.iter().find(|(known, _)| known == name);
    match name {
        "p_l" => Some(left),
        "p_r" => Some(right),
        _ => Some(skin.positions[found?.1 as usize]),
    }
}

/// Returns the amounts of the expression fields only, or of all others.
fn of_expressions(fields: &[f64], are_they: bool) -> Vec<f64> {
    let mut own = if are_they {
        vec![0.0; fields.len()]
    } else {
        fields.to_vec()
    };
    for field in expression_fields() {
        own[field] = if are_they { fields[field] } else { 0.0 };
    }
    own
}

/// Returns the parameters of a figure with this head: its body has mean measures for its sex and
/// age, all else is taken from `like`.
#[must_use]
pub fn params_of(like: &FigureParams, traits: Traits, bound: ModelHeadShape) -> FigureParams {
    FigureParams {
        person: Person {
            sex: traits.sex,
            age_years: traits.age_years,
            stature_m: stature_m(&traits),
            build: 0.0,
        },
        head: HeadParams {
            traits,
            bound,
            ..like.head.clone()
        },
        ..like.clone()
    }
}

/// Splits a polygon into a fan of triangles about its first corner.
fn fan(face: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    face.windows(2)
        .skip(1)
        .map(|pair| [face[0], pair[0], pair[1]])
}

/// Returns approximately the mean stature for a sex and an age, metres; only the head matters here.
#[must_use]
pub fn stature_m(traits: &Traits) -> f64 {
    let grown = ((traits.age_years - 8.0) / 9.0).clamp(0.0, 1.0);
    let adult = 1.75 - 0.13 * traits.sex;
    1.28 + (adult - 1.28) * grown
}

/// Computes the measures of a head from its landmarks in metres; returns millimetres, by name.
#[must_use]
pub fn measured_mm(place: &dyn Fn(&str) -> Option<DVec3>) -> Vec<(&'static str, f64)> {
    known_measures()
        .filter_map(|measure| Some((measure.name, distance_mm(&measure, place)?)))
        .collect()
}

/// Returns the distance between the two landmarks of a measure on the skin, millimetres; `None` if
/// a landmark is missing.
fn distance_mm(measure: &KnownMeasure, place: &dyn Fn(&str) -> Option<DVec3>) -> Option<f64> {
    let (from, to) = measure.landmarks.split_once('-')?;
    // Paired landmarks are taken on the left.
    let side = |name: &str| place(name).or_else(|| place(&format!("{name}_l")));
    let way = side(from)? - side(to)?;
    Some(
        1e3 * measure
            .along
            .map_or(way.length(), |axis| way.dot(axis).abs()),
    )
}

#[cfg(test)]
mod tests {
    use crate::head::{BareSkin, ModelHeadShape, build};
    use crate::people::preset;

    #[test]
    fn the_places_of_a_head_are_numbers_and_back() {
        for name in ["sofia", "papous"] {
            let bound = preset(name).expect("a figure").head.bound;
            let numbers = bound.flat_coordinates_mm();
            let again = ModelHeadShape::from_numbers(&numbers).expect("a head");
            assert_eq!(again.flat_coordinates_mm(), numbers);
            assert_eq!(ModelHeadShape::from_numbers(&numbers[1..]), None);
        }
    }

    #[test]
    fn a_bare_skin_is_that_of_the_head() {
        let params = preset("kenji").expect("a figure");
        let head = build(&params.person, &params.head);
        let bare = BareSkin::build(&params.person, &params.head);
        let skin = head.skin();
        let positions: Vec<_> = skin.vertices.iter().map(|v| v.position).collect();
        assert_eq!(bare.positions, positions);
        assert_eq!(bare.faces, skin.faces);
        assert_eq!(bare.landmarks, head.landmarks);
        assert_eq!(bare.segments, head.segments);
    }
}

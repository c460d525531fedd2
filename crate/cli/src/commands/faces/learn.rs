//! `raconteur faces learn`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use raconteur_base::Side;
use raconteur_faces::{
    AgeModel, Attribute, DependentNumbers, Editor, FaceModel, FaceSpace, FeatureMeasure, Half,
    LookNumber, NamedAttribute, PersonRecord, Segment, Segments, TextureModel,
};
use raconteur_sculpt::examples::{Example, Examples};
use raconteur_sculpt::head::{FIELDS, HeadSegment, known_measures};
use raconteur_sculpt::labels::{Affects, LABELS, Label};
use raconteur_sculpt::looks::{self, Look};
use raconteur_sculpt::people;
use raconteur_voice::files::disk::replace;

use super::crossing::WeldedSkin;
use super::examples::Crowd;
use super::fair::fair;
use super::pack::texture_beside;
use crate::{Outcome, terminal};

/// Learn a face space with its attributes from random heads, and write it as a pack: shapes into
/// one file, textures into another next to it.
#[derive(Args)]
pub(super) struct Learn {
    #[command(flatten)]
    crowd: Crowd,
    /// The pack's file of shapes; that of textures has the extension `skins`.
    #[arg(short, long)]
    output: PathBuf,
    /// Share of the variance of held-out faces that the kept modes must explain.
    #[arg(long, default_value_t = 0.99)]
    explains: f64,
}

/// Hold-out interval: one head of this many is held out.
const HELD_OUT: usize = 10;
/// Share of the colours' variance assigned to each appearance number.
const LOOK_SHARE: f64 = 0.02;

impl Learn {
    pub(super) fn run(&self) -> Result<Outcome> {
        let mut examples = self.crowd.make()?;
        fair(&mut examples)?;
        ensure!(
            examples.len() > HELD_OUT,
            "a face space needs more than {HELD_OUT} heads"
        );
        let weights = look_weights(&examples);
        let shapes: Vec<Vec<f64>> = examples.iter().map(|e| e.skin.clone()).collect();
        let textures: Vec<Vec<f64>> = examples
            .iter()
            .map(|e| textured(e.tone.clone(), &e.draft.look, &weights))
            .collect();
        let [shape, texture] = [(&shapes, "shape"), (&textures, "texture")]
            .map(|(faces, name)| self.space(faces, name));
        let shape = with_local(&shape?, &shapes, &examples)?;
        let mut model = shape_model(shape, &shapes, &examples)?;
        let texture = self.texture_model(texture?, &textures, &examples, &weights)?;
        model.texture = Some(texture);
        report(&model, &examples)?;
        self.calm(&mut model, &examples)?;
        let texture = model.texture.as_ref().context("textures")?;
        let files = [
            (self.output.clone(), model.to_bytes()?),
            (texture_beside(&self.output), texture.to_bytes()?),
        ];
        let mut out = terminal::out();
        for (path, bytes) in files {
            replace(&path, &bytes)?;
            writeln!(out, "{}: {} bytes", path.display(), bytes.len())?;
        }
        Ok(Outcome::Fine)
    }

    /// Returns the space of faces, with enough modes for the held-out ones.
    fn space(&self, faces: &[Vec<f64>], name: &str) -> Result<FaceSpace> {
        let (held, kept): (Vec<_>, Vec<_>) = (0..)
            .zip(faces)
            .partition(|(i, _)| *i % HELD_OUT == HELD_OUT - 1);
        let [held, kept]: [Vec<Vec<f64>>; 2] =
            [held, kept].map(|of| of.into_iter().map(|(_, face)| face.clone()).collect());
        let space = FaceSpace::learn(&kept)?;
        let errors = space.errors_by_modes(&held)?;
        let modes = required_modes(&errors, self.explains);
        let mut out = terminal::out();
        writeln!(out, "modes of {name}\trms of faces held out")?;
        for (count, error) in errors.iter().enumerate() {
            if count <= 10 || (count % 10 == 0 && count <= 150) || count == modes {
                // Of a vertex, not of one of its three numbers; shapes in millimetres.
                let unit = if name == "shape" { 1e3 } else { 1.0 };
                writeln!(out, "{count}\t{:.3}", unit * error * 3.0_f64.sqrt())?;
            }
        }
        writeln!(
            out,
            "{name}: {} faces, {modes} modes of {} numbers",
            kept.len(),
            space.length()
        )?;
        Ok(space.truncated(modes))
    }

    /// Removes residual expressions from the faces of the database, so that stored people look
    /// neutral by default.
    fn calm(&self, model: &mut FaceModel, examples: &[Example]) -> Result<()> {
        let body = self.crowd.model()?;
        let crowd = Examples::new(&body, Crowd::like()?, self.crowd.seed)?;
        for (field, effect) in crowd.expressions() {
            let along = model.shape.along(&effect);
            for (face, example) in model.examples.iter_mut().zip(examples) {
                let amount = example.draft.fields[field];
                for (c, by) in face.iter_mut().zip(&along) {
                    *c -= amount * by;
                }
            }
        }
        Ok(())
    }

    fn texture_model(
        &self,
        space: FaceSpace,
        textures: &[Vec<f64>],
        examples: &[Example],
        weights: &[f64],
    ) -> Result<TextureModel> {
        let own = coefficients(&space, textures)?;
        let model = self.crowd.model()?;
        let crowd = Examples::new(&model, Crowd::like()?, self.crowd.seed)?;
        let figure = |name: &&str| {
            let params = people::preset(name).with_context(|| format!("no figure {name}"))?;
            let look = looks::look_of(&params);
            let texture = textured(crowd.tone(&look), &look, weights);
            Ok(((*name).to_owned(), space.coefficients(&texture)?))
        };
        let names = looks::NAMES.iter().chain(&looks::COLOURS);
        let numbers = names.zip(weights);
        Ok(TextureModel {
            looks: numbers
                .map(|(name, weight)| LookNumber {
                    name: (*name).to_owned(),
                    weight: *weight,
                })
                .collect(),
            attributes: attributes(&space, &own, examples, Affects::Texture)?,
            figures: people::NAMES.iter().map(figure).collect::<Result<_>>()?,
            life: AgeModel::learn(&people(examples), &own),
            examples: own,
            space,
        })
    }
}

/// Threshold of explained variance below which an attribute gets its own mode in addition to the
/// principal components.
const TOLD: f64 = 0.9;

/// Returns the space with local modes: for independently varying fields, and for attributes too
/// small for the principal components.
fn with_local(space: &FaceSpace, shapes: &[Vec<f64>], examples: &[Example]) -> Result<FaceSpace> {
    let own = coefficients(space, shapes)?;
    let fields = (0..FIELDS.len()).map(|k| examples.iter().map(|e| e.draft.fields[k]).collect());
    let mut signals: Vec<Vec<f64>> = fields.collect();
    for label in LABELS.iter().filter(|l| l.affects != Affects::Texture) {
        let labels = label.of_all(examples);
        let labels = labels.with_context(|| format!("no head has a {}", label.name))?;
        let attribute = Attribute::learn(label.name, space, &own, &labels)?;
        if explained_variance(space, &attribute, &own, &labels) < TOLD {
            signals.push(labels);
        }
    }
    for known in known_measures() {
        let taken = examples.iter().map(|e| e.measure(known.name));
        let taken: Vec<f64> = taken.collect::<Option<_>>().context("a measure")?;
        let attribute = Attribute::learn(known.name, space, &own, &taken)?;
        let mean = taken.iter().sum::<f64>() / taken.len() as f64;
        let centred: Vec<f64> = taken.iter().map(|mm| mm - mean).collect();
        if explained_variance(space, &attribute, &own, &centred) < TOLD {
            signals.push(taken);
        }
    }
    let all = space.with_local(shapes, &signals)?;
    writeln!(
        terminal::out(),
        "{} local modes and {} principal components",
        all.dimensions() - space.dimensions(),
        space.dimensions()
    )?;
    Ok(all)
}

/// Returns the share of the labels' variance that an attribute explains, 0 to 1.
fn explained_variance(
    space: &FaceSpace,
    attribute: &Attribute,
    own: &[Vec<f64>],
    labels: &[f64],
) -> f64 {
    let of = |(face, label): (&Vec<f64>, &f64)| {
        let off = attribute.value(space, face) - label;
        [off * off, label * label]
    };
    let sums = own.iter().zip(labels).map(of);
    let [off, all] = sums.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    1.0 - off / all
}

/// Returns a texture: colours, then the appearance numbers.
fn textured(mut tone: Vec<f64>, look: &Look, weights: &[f64]) -> Vec<f64> {
    let numbers = looks::numbers(look);
    tone.extend(numbers.iter().zip(weights).map(|(x, weight)| x * weight));
    tone
}

/// Returns the weights of appearance numbers, so that each contributes its share to the variance of
/// textures.
fn look_weights(examples: &[Example]) -> Vec<f64> {
    let variance = |numbers: &dyn Fn(&Example) -> f64| {
        let count = examples.len() as f64;
        let mean = examples.iter().map(numbers).sum::<f64>() / count;
        let square = |e: &Example| (numbers(e) - mean) * (numbers(e) - mean);
        examples.iter().map(square).sum::<f64>() / count
    };
    let length = examples.first().map_or(0, |e| e.tone.len());
    // Every thirtieth colour suffices for all statistics.
    const STEP: usize = 30;
    let colours: f64 = (0..length)
        .step_by(STEP)
        .map(|i| variance(&|e| e.tone[i]) * STEP as f64)
        .sum();
    (0..looks::NAMES.len() + looks::COLOURS.len())
        .map(|k| {
            let own = variance(&|e| looks::numbers(&e.draft.look)[k]);
            (LOOK_SHARE * colours / own.max(1e-9)).sqrt()
        })
        .collect()
}

/// Returns the minimum number of modes that explains a share of the variance.
fn required_modes(errors: &[f64], explains: f64) -> usize {
    let all = errors[0] * errors[0];
    let is_enough = |error: &f64| error * error <= (1.0 - explains) * all;
    errors
        .iter()
        .position(is_enough)
        .unwrap_or(errors.len() - 1)
}

fn coefficients(space: &FaceSpace, faces: &[Vec<f64>]) -> Result<Vec<Vec<f64>>> {
    let own = faces.iter().map(|face| space.coefficients(face));
    Ok(own.collect::<Result<_, _>>()?)
}

/// Returns the attributes that change only one part, or both.
fn attributes(
    space: &FaceSpace,
    own: &[Vec<f64>],
    examples: &[Example],
    affects: Affects,
) -> Result<Vec<NamedAttribute>> {
    let labels = LABELS.iter();
    let wanted = labels.filter(|l| l.affects == affects || l.affects == Affects::Both);
    let named = |label: &Label| {
        let labels = label
            .of_all(examples)
            .with_context(|| format!("no head has a {}", label.name))?;
        Ok(NamedAttribute {
            group: label.group.to_owned(),
            terms: label.terms.map(str::to_owned),
            derived: label.derived.map(str::to_owned),
            attribute: Attribute::learn(label.name, space, own, &labels)?,
            feature: None,
        })
    };
    wanted.map(named).collect()
}

fn shape_model(shape: FaceSpace, shapes: &[Vec<f64>], examples: &[Example]) -> Result<FaceModel> {
    let own = coefficients(&shape, shapes)?;
    let cages: Vec<Vec<f64>> = examples
        .iter()
        .map(|e| e.draft.bound.flat_coordinates_mm())
        .collect();
    let organs: Vec<Vec<f64>> = examples.iter().map(|e| e.organs.numbers()).collect();
    let first = examples.first().context("a head")?;
    let segment = |of: &HeadSegment| Segment {
        name: of.name.to_owned(),
        parent: of.parent.map(|p| p as u32),
        runs: of.runs.clone(),
    };
    let segments = first.segments.iter().map(segment).collect();
    let measures = measures(examples)?;
    let mut attributes = attributes(&shape, &own, examples, Affects::Shape)?;
    for measure in measures.iter().filter(|m| !m.gradient.is_empty()) {
        let found = attributes
            .iter_mut()
            .find(|a| a.attribute.name == measure.name);
        if let Some(named) = found {
            named.attribute = Attribute::measured(&measure.name, &shape, &measure.gradient)?;
        }
    }
    let people = people(examples);
    let model = FaceModel {
        reference: reference(&shape, shapes, &first.triangles),
        triangles: first.triangles.clone(),
        landmarks: first.landmarks.clone(),
        segments: Segments::new(segments, shape.length() / 3)
            .context("segments of another head")?,
        cage: DependentNumbers::learn(&shape, &own, &cages),
        organs: DependentNumbers::learn(&shape, &own, &organs),
        attributes,
        life: AgeModel::learn(&people, &own),
        people,
        examples: own,
        shape,
        texture: None,
    };
    with_features(model, &measures)
}

/// Returns the head nearest to the average whose skin does not intersect itself. The mean of heads
/// need not have that property.
fn reference(space: &FaceSpace, shapes: &[Vec<f64>], triangles: &[[u32; 3]]) -> Vec<f64> {
    let far = |shape: &Vec<f64>| -> f64 {
        let pairs = shape.iter().zip(space.mean());
        pairs.map(|(x, mean)| (x - mean) * (x - mean)).sum()
    };
    let mut nearest: Vec<&Vec<f64>> = shapes.iter().collect();
    nearest.sort_by(|a, b| far(a).total_cmp(&far(b)));
    let joined = WeldedSkin::weld(space.mean(), triangles);
    let sound = nearest
        .iter()
        .find(|shape| joined.crossings(shape).is_empty());
    sound
        .or(nearest.first())
        .map_or_else(Vec::new, |shape| shape.to_vec())
}

/// Returns the person records of examples.
fn people(examples: &[Example]) -> Vec<PersonRecord> {
    let person = |e: &Example| PersonRecord {
        sex: e.draft.traits.sex,
        age_years: e.draft.traits.age_years,
        ancestry: e.ancestry(),
    };
    examples.iter().map(person).collect()
}

/// Returns the measurable shape features of faces, with their segments and units from the examples.
fn measures(examples: &[Example]) -> Result<Vec<FeatureMeasure>> {
    let average = Example::average(examples).context("a head")?;
    let features = LABELS.iter().filter_map(|l| Some((l, l.segments()?)));
    let measure = |(label, segments): (&Label, &[&str])| {
        let unit = label.unit(examples);
        let unit = unit.with_context(|| format!("no head has a {}", label.name))?;
        Ok(FeatureMeasure {
            name: label.name.to_owned(),
            segments: segments.iter().map(|&s| s.to_owned()).collect(),
            half: label.side().map(|side| match side {
                Side::Left => Half::Left,
                Side::Right => Half::Right,
            }),
            gradient: label.gradient(&average, unit),
        })
    };
    features.map(measure).collect()
}

/// Returns the model with the isolated changes of its features.
fn with_features(mut model: FaceModel, measures: &[FeatureMeasure]) -> Result<FaceModel> {
    let features = Editor::new(model.clone())?.learn_features(measures)?;
    for (measure, feature) in measures.iter().zip(features) {
        let mut all = model.attributes.iter_mut();
        let named = all.find(|a| a.attribute.name == measure.name);
        named.context("an attribute of shape")?.feature = Some(feature);
    }
    Ok(model)
}

/// Reports the quality of each attribute: the share of its labels' variance that it explains.
fn report(model: &FaceModel, examples: &[Example]) -> Result<()> {
    let mut out = terminal::out();
    writeln!(out, "attribute\tshape\ttexture")?;
    for label in &LABELS {
        let Some(labels) = label.of_all(examples) else {
            continue;
        };
        let explained = |space: &FaceSpace, all: &[NamedAttribute], own: &[Vec<f64>]| {
            let found = all.iter().find(|a| a.attribute.name == label.name)?;
            Some(explained_variance(space, &found.attribute, own, &labels))
        };
        let shown = |share: Option<f64>| share.map_or_else(String::new, |s| format!("{s:.2}"));
        let shape = explained(&model.shape, &model.attributes, &model.examples);
        let texture = model.texture.as_ref();
        let texture = texture.and_then(|t| explained(&t.space, &t.attributes, &t.examples));
        writeln!(out, "{}\t{}\t{}", label.name, shown(shape), shown(texture))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_modes_are_kept_as_explain_the_share() {
        let errors = [10.0, 5.0, 2.0, 1.0, 0.9];
        assert_eq!(
            [0.0, 0.5, 0.95, 0.99, 0.999].map(|s| required_modes(&errors, s)),
            [0, 1, 2, 3, 4]
        );
    }
}

//! Separate changes of features: the likeliest change in the segments that adds one, stays in them
//! and leaves other features unchanged.

use faer::Mat;
use faer::linalg::solvers::Solve as _;

use super::{Editor, Part};
use crate::error::FaceError;
use crate::feature::Feature;
use crate::segment::Half;

/// Definition of a shape feature by its measure: attribute, segments and gradient; input for
/// learning a [`Feature`].
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureMeasure {
    /// Name of the attribute.
    pub name: String,
    /// Names of the segments that contain the feature, see [`Feature::segments`].
    pub segments: Vec<String>,
    /// Half of the face that contains the feature, see [`Feature::half`].
    pub half: Option<Half>,
    /// Change of the measured value per unit of a face number, see [`Feature::gradient`].
    pub gradient: Vec<(u32, f64)>,
}

/// Cost of one standard deviation of another feature, relative to one of the face itself (1).
const COST: f64 = 2.0;
/// Required share of the squared displacement of all vertices that lies within the segments.
const INSIDE: f64 = 0.92;
/// Candidate costs of the squared displacement outside the segments, per square metre; the first
/// sufficient one is used. At 10,000, 0.1 mm at ten thousand vertices costs as much as a standard
/// deviation.
const OUTSIDE_COSTS: [f64; 6] = [1e3, 1e4, 1e5, 1e6, 1e7, 1e8];

/// Displacements of each mode within some segments: one column per mode, for one standard deviation
/// each.
struct SegmentModes {
    images: Mat<f64>,
    /// Gram matrix of the displacements outside the segments.
    outside: Mat<f64>,
    inside: Mat<f64>,
}

impl Editor {
    /// Learns the features of these measures and returns them in the same order.
    ///
    /// # Errors
    /// Returns an error if an attribute or a segment does not exist, or if the segments do not
    /// affect the measure.
    pub fn learn_features(&self, measures: &[FeatureMeasure]) -> Result<Vec<Feature>, FaceError> {
        let mut features = vec![Feature::default(); measures.len()];
        for (i, measure) in measures.iter().enumerate() {
            if !features[i].alone.is_empty() {
                continue;
            }
            let within = self.within_segments(&measure.segments, measure.half)?;
            let effects: Vec<Vec<f64>> = measures
                .iter()
                .map(|other| self.effects(other, &within.images))
                .collect::<Result<_, _>>()?;
            for (j, own) in measures.iter().enumerate() {
                if own.segments == measure.segments && own.half == measure.half {
                    features[j] = self.learn_feature(own, j, &within, &effects)?;
                }
            }
        }
        Ok(features)
    }

    fn within_segments(
        &self,
        segments: &[String],
        half: Option<Half>,
    ) -> Result<SegmentModes, FaceError> {
        let names: Vec<&str> = segments.iter().map(String::as_str).collect();
        let region = self.region(&names, half)?;
        let space = &self.model().shape;
        let modes = space.dimensions();
        let mut images = Mat::<f64>::zeros(space.length(), modes);
        for (mode, deviation) in space.deviations().iter().enumerate() {
            let mut along = vec![0.0; modes];
            along[mode] = *deviation;
            let change = self.change_of(Part::Shape, &along, &region)?;
            for (row, x) in change.numbers().iter().enumerate() {
                images[(row, mode)] = *x;
            }
        }
        let mask = self.marked(&names, half)?;
        let products = |is_in: bool| {
            let part = Mat::from_fn(space.length(), modes, |row, mode| {
                let own = (mask[row / 3] > 0.0) == is_in;
                if own { images[(row, mode)] } else { 0.0 }
            });
            part.transpose() * &part
        };
        Ok(SegmentModes {
            outside: products(false),
            inside: products(true),
            images,
        })
    }

    /// Returns the effect of each mode within the segments on a measure.
    fn effects(&self, measure: &FeatureMeasure, images: &Mat<f64>) -> Result<Vec<f64>, FaceError> {
        let space = &self.model().shape;
        let gradient = if measure.gradient.is_empty() {
            self.named(Part::Shape, &measure.name)?
                .attribute
                .gradient(space)
        } else {
            let mut all = vec![0.0; space.length()];
            for &(i, g) in &measure.gradient {
                all[i as usize] += g;
            }
            all
        };
        let effect = |mode: usize| {
            (0..space.length())
                .map(|row| gradient[row] * images[(row, mode)])
                .sum()
        };
        Ok((0..space.dimensions()).map(effect).collect())
    }

    fn learn_feature(
        &self,
        measure: &FeatureMeasure,
        index: usize,
        within: &SegmentModes,
        effects: &[Vec<f64>],
    ) -> Result<Feature, FaceError> {
        let modes = self.model().shape.dimensions();
        let others = effects.iter().enumerate().filter(|(k, _)| *k != index);
        let mut base = Mat::<f64>::identity(modes, modes);
        for (_, effect) in others {
            // In units of an attribute's ends, which are two deviations from the mean.
            let cost = 2.0 * COST;
            for i in 0..modes {
                for j in 0..modes {
                    base[(i, j)] += cost * cost * effect[i] * effect[j];
                }
            }
        }
        let own = Mat::from_fn(modes, 1, |i, _| effects[index][i]);
        let mut best = None;
        for cost in OUTSIDE_COSTS {
            let matrix = Mat::from_fn(modes, modes, |i, j| {
                base[(i, j)] + cost * within.outside[(i, j)]
            });
            let solution = matrix.full_piv_lu().solve(&own);
            let square = |m: &Mat<f64>| (solution.transpose() * m * &solution)[(0, 0)];
            let (inside, outside) = (square(&within.inside), square(&within.outside));
            let value: f64 = (own.transpose() * &solution)[(0, 0)];
            let change: Vec<f64> = (0..modes).map(|i| solution[(i, 0)] / value).collect();
            let is_enough = inside >= INSIDE * (inside + outside);
            best = Some(change);
            if is_enough {
                break;
            }
        }
        let deviations = self.model().shape.deviations();
        let alone: Vec<f64> = best
            .iter()
            .flatten()
            .zip(deviations)
            .map(|(x, d)| x * d)
            .collect();
        if alone.iter().all(|c| c.is_finite()) {
            Ok(Feature {
                segments: measure.segments.clone(),
                half: measure.half,
                gradient: measure.gradient.clone(),
                alone,
            })
        } else {
            Err(FaceError::NoDirection {
                name: measure.name.clone(),
            })
        }
    }
}

//! Regions of a face: segments in any combination, on one half or both.

use raconteur_base::curve::smooth;

use super::Editor;
use crate::blend::SoftMask;
use crate::error::FaceError;
use crate::segment::Half;

/// Region of the head to which a change of a face is limited: segments, on one half or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Mask of the region; `None` for the whole head.
    mask: Option<SoftMask>,
    /// True if the region consists of segments, not of the whole head or a half.
    is_of_segments: bool,
    half: Option<Half>,
    /// Vertices of the region.
    vertices: Vec<u32>,
    /// Weights of the inner parts of the head: left eye, right eye, chin.
    organs: [f64; 3],
    /// Weights of the appearance numbers: of irises, brows, lips, all others.
    looks: [f64; 4],
    /// Kind of each appearance number, as an index into these weights.
    kinds: Vec<usize>,
}

/// Distances from a region along the skin at which blending starts to fade and at which it has
/// ended, metres. They limit the smoothing where vertices are far apart.
const BLEND_M: [f64; 2] = [0.018, 0.04];

/// Names that assign appearance numbers to segments.
const LOOK_KINDS: [(&str, &str); 3] = [
    ("iris", "eyes and lids"),
    ("brows", "eyebrows"),
    ("lips", "upper lip"),
];

impl Region {
    /// Returns the region of the whole head.
    #[must_use]
    pub fn whole_head() -> Self {
        Self {
            mask: None,
            is_of_segments: false,
            half: None,
            vertices: Vec::new(),
            organs: [1.0; 3],
            looks: [1.0; 4],
            kinds: Vec::new(),
        }
    }

    /// Returns true if the region consists of segments, not of the whole head or a half.
    pub(super) fn is_of_segments(&self) -> bool {
        self.is_of_segments
    }

    /// Returns the half of the head that the region covers; `None` for both.
    pub(super) fn half(&self) -> Option<Half> {
        self.half
    }

    pub(super) fn mask(&self) -> Option<&SoftMask> {
        self.mask.as_ref()
    }

    /// Returns the weight of an inner-part value: centres of the left and the right eye, rotations
    /// of the left and the right lid, the chin.
    pub(super) fn organ_share(&self, number: usize) -> f64 {
        match number {
            0..=2 | 6 => self.organs[0],
            3..=5 | 7 => self.organs[1],
            _ => self.organs[2],
        }
    }

    pub(super) fn look_share(&self, number: usize) -> f64 {
        let kind = self.kinds.get(number).copied();
        kind.and_then(|k| self.looks.get(k)).copied().unwrap_or(1.0)
    }

    /// Returns the centre of the region on a shape, frame of the head, metres; the mean of all
    /// vertices for the whole head.
    pub(super) fn middle(&self, shape: &[f64]) -> [f64; 3] {
        let all = shape.as_chunks::<3>().0;
        let mean = |places: &mut dyn Iterator<Item = &[f64; 3]>| {
            let mut sum = [0.0; 4];
            for p in places {
                for (s, x) in sum.iter_mut().zip(p.iter().chain(&[1.0])) {
                    *s += x;
                }
            }
            [sum[0], sum[1], sum[2]].map(|x| x / sum[3].max(1.0))
        };
        if self.vertices.is_empty() {
            mean(&mut all.iter())
        } else {
            mean(&mut self.vertices.iter().filter_map(|&v| all.get(v as usize)))
        }
    }
}

impl Editor {
    /// Returns the region of the named segments, on one half or both; the whole head if no segments
    /// and no half are given.
    ///
    /// # Errors
    /// Returns an error if a segment does not exist.
    pub fn region(&self, names: &[&str], half: Option<Half>) -> Result<Region, FaceError> {
        if names.is_empty() && half.is_none() {
            return Ok(Region::whole_head());
        }
        let mask = self.marked(names, half)?;
        let own = (0u32..).zip(&mask).filter(|(_, share)| **share > 0.0);
        let looks = self.model.texture.as_ref();
        let looks = looks.map_or(&[][..], |t| t.looks.as_slice());
        let kind = |name: &str| {
            let found = LOOK_KINDS.iter().position(|(word, _)| name.contains(word));
            found.unwrap_or(LOOK_KINDS.len())
        };
        let mut soft = self.neighbours.softened(&mask);
        let places = self.model.shape.mean().as_chunks::<3>().0;
        let far = self.neighbours.distances(places, &mask, BLEND_M[1]);
        let [from, to] = BLEND_M;
        let share = |far: &f64| 1.0 - smooth(((far - from) / (to - from)).clamp(0.0, 1.0));
        soft.lessen(&far.iter().map(share).collect::<Vec<f64>>());
        let share = |segment, half| self.share(&soft, segment, half);
        let [iris, brows, lips] = LOOK_KINDS.map(|(_, segment)| share(segment, None));
        Ok(Region {
            vertices: own.map(|(v, _)| v).collect(),
            organs: [
                share("eyes and lids", Some(Half::Left)),
                share("eyes and lids", Some(Half::Right)),
                share("chin tip", None),
            ],
            looks: [iris, brows, lips, share("face", None)],
            kinds: looks.iter().map(|l| kind(&l.name)).collect(),
            is_of_segments: !names.is_empty(),
            half,
            mask: Some(soft),
        })
    }

    /// Marks with 1 the vertices of segments with their parts, on one half or both; of the whole head where
    /// there are no segments.
    pub(crate) fn marked(&self, names: &[&str], half: Option<Half>) -> Result<Vec<f64>, FaceError> {
        let segments = &self.model.segments;
        let find = |name: &&str| {
            let found = segments.find(name);
            found.ok_or_else(|| FaceError::NoSegment {
                name: (*name).to_owned(),
            })
        };
        let chosen: Vec<usize> = names.iter().map(find).collect::<Result<_, _>>()?;
        let vertices = self.model.vertices();
        let mut mask = if chosen.is_empty() {
            vec![1.0; vertices]
        } else {
            segments.mask(&chosen, vertices)
        };
        let places = self.model.shape.mean().as_chunks::<3>().0;
        for (share, place) in mask.iter_mut().zip(places) {
            let is_other = match half {
                Some(Half::Left) => place[0] < 0.0,
                Some(Half::Right) => place[0] > 0.0,
                None => false,
            };
            if is_other {
                *share = 0.0;
            }
        }
        Ok(mask)
    }

    /// Returns the share of a segment that a mask covers: the mean over its vertices, on one half
    /// or both.
    fn share(&self, mask: &SoftMask, segment: &str, half: Option<Half>) -> f64 {
        let Some(index) = self.model.segments.find(segment) else {
            return 0.0;
        };
        let places = self.model.shape.mean().as_chunks::<3>().0;
        let own = self.model.segments.mask(&[index], self.model.vertices());
        let is_on = |x: f64| match half {
            Some(Half::Left) => x > 0.0,
            Some(Half::Right) => x < 0.0,
            None => true,
        };
        let chosen = (0..).zip(own.iter().zip(places));
        let chosen = chosen.filter(|(_, (share, place))| **share > 0.0 && is_on(place[0]));
        let [sum, count] = chosen.fold([0.0; 2], |[sum, count], (v, _)| {
            [sum + mask.weight(v), count + 1.0]
        });
        sum / f64::max(count, 1.0)
    }
}

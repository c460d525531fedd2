//! Segments of the face (F&H 5.1.2, Table 5.1): parts that can change while the others stay.

use serde::{Deserialize, Serialize};

/// Half of the face to which a region is limited: left (positive x) or right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// The left one, at positive x.
    Left,
    /// The right one.
    Right,
}

/// Segment of the face (F&H 5.1.2, Table 5.1): a part that can be changed separately, possibly
/// inside another segment.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Segment {
    /// Name of the segment.
    pub name: String,
    /// Index of the parent segment; `None` for the whole face.
    pub parent: Option<u32>,
    /// Vertices of the segment without those of its subsegments, as runs of (first, count).
    pub runs: Vec<[u32; 2]>,
}

/// Hierarchy of face segments, parents before their subsegments.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Segments {
    all: Vec<Segment>,
}

impl Segments {
    /// Builds the hierarchy over a number of vertices; `None` if a parent does not precede its
    /// part, or if a vertex is out of range.
    #[must_use]
    pub fn new(all: Vec<Segment>, vertices: usize) -> Option<Self> {
        let is_before = |(i, s): (usize, &Segment)| s.parent.is_none_or(|p| (p as usize) < i);
        let is_within = |run: &[u32; 2]| {
            let end = u64::from(run[0]) + u64::from(run[1]);
            end <= vertices as u64
        };
        let fits = all.iter().enumerate().all(is_before)
            && all.iter().all(|s| s.runs.iter().all(is_within));
        fits.then_some(Self { all })
    }

    /// Returns all segments, parents first.
    #[must_use]
    pub fn all(&self) -> &[Segment] {
        &self.all
    }

    /// Returns the index of a segment by name; `None` if there is none.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.all.iter().position(|s| s.name == name)
    }

    /// Returns the segment to which a vertex belongs directly, not counting enclosing segments.
    #[must_use]
    pub fn segment_of(&self, vertex: u32) -> Option<&Segment> {
        let is_in = |run: &[u32; 2]| vertex >= run[0] && vertex - run[0] < run[1];
        self.all.iter().find(|s| s.runs.iter().any(is_in))
    }

    /// Returns a mask that is 1 at the vertices of the segments and all their parts, 0 elsewhere.
    #[must_use]
    pub fn mask(&self, chosen: &[usize], vertices: usize) -> Vec<f64> {
        let mut is_in = vec![false; self.all.len()];
        let mut mask = vec![0.0; vertices];
        for (i, segment) in self.all.iter().enumerate() {
            is_in[i] = chosen.contains(&i) || segment.parent.is_some_and(|p| is_in[p as usize]);
            for [first, count] in segment.runs.iter().filter(|_| is_in[i]) {
                let run = *first as usize..(first + count) as usize;
                mask[run].fill(1.0);
            }
        }
        mask
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(name: &str, parent: Option<u32>, run: [u32; 2]) -> Segment {
        Segment {
            name: name.to_owned(),
            parent,
            runs: vec![run],
        }
    }

    #[test]
    fn a_mask_holds_a_segment_with_its_parts() {
        let all = vec![
            segment("face", None, [0, 2]),
            segment("nose", Some(0), [2, 2]),
            segment("tip", Some(1), [4, 1]),
            segment("mouth", Some(0), [5, 1]),
        ];
        let segments = Segments::new(all.clone(), 6).expect("a hierarchy");
        let of = |names: &[&str]| {
            let chosen: Vec<usize> = names.iter().map(|n| segments.find(n).unwrap()).collect();
            segments.mask(&chosen, 6)
        };
        assert_eq!(of(&["nose"]), [0.0, 0.0, 1.0, 1.0, 1.0, 0.0]);
        assert_eq!(of(&["tip", "mouth"]), [0.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
        assert_eq!(of(&["face"]), [1.0; 6]);
        assert_eq!(of(&[]), [0.0; 6]);
        assert_eq!(Segments::new(all.clone(), 5), None);
        let mut orphan = all;
        orphan[1].parent = Some(2);
        assert_eq!(Segments::new(orphan, 6), None);
    }
}

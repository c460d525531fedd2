//! Junctions of fused muscles (F&H section 3.1.2, "Properties" and "Muscle Deformation"): linked
//! points meet at a centre in which those of more contracted muscles have more weight, and keep
//! their distances from it.

use core::ops::Range;

use super::Muscle;
use super::tissue::{Fibre, Tissue};

/// Pull of a relaxed muscle, relative to 1 of a fully contracted one. Designed: just enough to keep
/// the centre of relaxed muscles at rest.
const AT_REST: f32 = 0.005;
/// Sum of its links above which a muscle's end is wholly attached to the ring of the mouth and
/// keeps its distance from it; below, part of its fibres end in the skin and give. Designed: above
/// mentalis and platysma, at the minimum of the others.
const WHOLE: f32 = 0.6;
/// Exponent of the link weights of ring points in the attachment position of an end: nearby points
/// dominate. Designed.
const NEXT_TO: i32 = 4;

/// Returns the pull of a point on its junction, 0 to 1: it grows more than proportionally to its
/// muscle's tension, so that the stronger muscle dominates.
fn pull(tension: f32) -> f32 {
    (AT_REST + tension) * (AT_REST + tension)
}

/// Returns the share of a free muscle's movement that its own contraction causes, 0 to 1.
pub(super) fn own_share(contraction: f32) -> f32 {
    let pulled = contraction * contraction;
    pulled / (pulled + AT_REST * AT_REST)
}

/// A linear fibre's end at a point of the ring.
#[derive(Clone, Debug)]
struct FibreJoin {
    end: usize,
    weight: f32,
    /// Links of the end's whole muscle to that point.
    of_muscle: f32,
}

/// A point of the ring with the ends that are grown to it.
#[derive(Clone, Debug)]
struct JunctionPoint {
    ring: usize,
    joins: Range<usize>,
    /// Current total pull of its members.
    pulls: f32,
}

/// Ring point with its weight in the attachment position of an end.
#[derive(Clone, Debug)]
struct Anchor {
    meeting: usize,
    /// Weight of the point; weights of an end sum to 1.
    share: f32,
    /// Links of the end's whole muscle to that point.
    weight: f32,
}

/// The end of a linear fibre in the ring.
#[derive(Clone, Debug)]
struct End {
    point: usize,
    /// Degree of attachment, 0 to 1.
    grown: f32,
    anchors: Range<usize>,
}

/// Junctions at which muscles of a face are attached to each other, so that they pull each other
/// along.
#[derive(Clone, Debug)]
pub(super) struct Junctions {
    meetings: Vec<JunctionPoint>,
    joins: Vec<FibreJoin>,
    ends: Vec<End>,
    anchors: Vec<Anchor>,
}

impl Junctions {
    pub(super) fn new(tissue: &Tissue) -> Self {
        // The muscle of each end; points that end no fibre belong to none.
        let owner = |end: usize| -> Option<Muscle> {
            let is_last = |f: &&Fibre| usize::from(f.first) + usize::from(f.count) == end + 1;
            tissue.fibres.iter().find(is_last).map(|f| f.muscle)
        };
        let mut links: Vec<(usize, usize, f32)> = tissue
            .links
            .iter()
            .map(|l| (usize::from(l.ring), usize::from(l.end), l.weight))
            .collect();
        // Sorted by point, so that nothing depends on the order of links.
        links.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        let mut meetings: Vec<JunctionPoint> = Vec::new();
        for (i, &(ring, ..)) in links.iter().enumerate() {
            match meetings.last_mut() {
                Some(last) if last.ring == ring => last.joins.end = i + 1,
                _ => meetings.push(JunctionPoint {
                    ring,
                    joins: i..i + 1,
                    pulls: 1.0,
                }),
            }
        }
        let mut points: Vec<usize> = links.iter().map(|l| l.1).collect();
        points.sort_unstable();
        points.dedup();
        let mut anchors = Vec::new();
        let ends = points
            .iter()
            .map(|&point| {
                let muscle = owner(point);
                let first = anchors.len();
                let mut greatest = 0.0_f32;
                for (m, meeting) in meetings.iter().enumerate() {
                    let joins = &links[meeting.joins.clone()];
                    let Some(own) = joins.iter().find(|l| l.1 == point) else {
                        continue;
                    };
                    let of_muscle = joins.iter().filter(|l| owner(l.1) == muscle);
                    let weight = of_muscle.map(|l| l.2).sum();
                    greatest = greatest.max(weight);
                    anchors.push(Anchor {
                        meeting: m,
                        share: own.2.powi(NEXT_TO),
                        weight,
                    });
                }
                let sum: f32 = anchors[first..].iter().map(|a| a.share).sum();
                for anchor in &mut anchors[first..] {
                    anchor.share /= sum.max(1e-12);
                }
                End {
                    point,
                    grown: (greatest / WHOLE).min(1.0),
                    anchors: first..anchors.len(),
                }
            })
            .collect();
        let join = |&(ring, end, weight): &(usize, usize, f32)| {
            let muscle = owner(end);
            let same = links.iter().filter(|l| l.0 == ring && owner(l.1) == muscle);
            FibreJoin {
                end,
                weight,
                of_muscle: same.map(|l| l.2).sum(),
            }
        };
        Self {
            joins: links.iter().map(join).collect(),
            meetings,
            ends,
            anchors,
        }
    }

    /// Moves the points of the ring to equilibrium with their attachments: by the link weights,
    /// towards their weighted centre. `moved` holds the displacement wanted by each point alone and
    /// `tension` its strength, 0 to 1.
    pub(super) fn relax(&mut self, tension: &[f32], moved: &mut [[f32; 3]]) {
        for meeting in &mut self.meetings {
            let asked = moved[meeting.ring];
            let mut pulls = pull(tension[meeting.ring]);
            let mut centre = asked.map(|x| x * pulls);
            // The ring's share of the centre's movement: according to its links, where stronger
            // muscles have more weight.
            let (mut held, mut joined) = (0.0, 0.0);
            for join in &self.joins[meeting.joins.clone()] {
                let by = join.weight * pull(tension[join.end]);
                pulls += by;
                joined += by;
                for k in 0..3 {
                    centre[k] += moved[join.end][k] * by;
                }
                held += by * join.of_muscle.min(1.0);
            }
            let held = held / joined.max(1e-12);
            moved[meeting.ring] =
                [0, 1, 2].map(|k| asked[k] + (centre[k] / pulls - asked[k]) * held);
            meeting.pulls = pulls;
        }
    }

    /// Returns, for the end of a linear fibre, the displacement of its attachment position, so that
    /// their distance is restored, and the share of it caused by its own muscle. `None` for a free
    /// end. Valid after [`Self::relax`].
    pub(super) fn end(
        &self,
        point: usize,
        tension: f32,
        moved: &[[f32; 3]],
    ) -> Option<([f32; 3], f32)> {
        let at = self.ends.binary_search_by_key(&point, |e| e.point).ok()?;
        let end = &self.ends[at];
        let mut to = moved[point].map(|x| x * (1.0 - end.grown));
        let mut own = own_share(tension) * (1.0 - end.grown);
        for anchor in &self.anchors[end.anchors.clone()] {
            let meeting = &self.meetings[anchor.meeting];
            let share = anchor.share * end.grown;
            for k in 0..3 {
                to[k] += moved[meeting.ring][k] * share;
            }
            own += share * anchor.weight * pull(tension) / meeting.pulls;
        }
        Some((to, own.min(1.0)))
    }

    /// Returns the wholly attached ends, each with its attachment position: points of the ring and
    /// their weights.
    #[cfg(test)]
    pub(super) fn whole_ends(&self) -> impl Iterator<Item = (usize, Vec<(usize, f32)>)> + '_ {
        let whole = self.ends.iter().filter(|e| e.grown >= 1.0);
        whole.map(|end| {
            let anchors = &self.anchors[end.anchors.clone()];
            let places = anchors
                .iter()
                .map(|a| (self.meetings[a.meeting].ring, a.share));
            (end.point, places.collect())
        })
    }
}

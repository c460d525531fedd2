//! Mass-spring network of the skin (F&H section 3.1.2, "Mass Spring Network"), in its own units:
//! point masses of 1, seconds, metres.
//!
//! Stiffnesses are per mass, 1/s². A step is a 120th of a second; leapfrog Verlet integration is
//! stable while the stiffest mode stays under (2 / step)² = 57,600, which [their
//! stiffnesses](super::layout) satisfy with a margin.

use super::lanes::{LANES, Vector, dot, length, squares, vector, whole_fours, xyz};
use super::layout::{
    ConnectingSprings, Edge, STEP_SECS, STEPS_PER_S, SpringX4, around_nodes, leaders, pairs_of,
    skin,
};

/// Stretch beyond which skin resists more (biphasic). F&H gives no numbers; skin stiffens at 10 to
/// 20 %.
const SLACK: f32 = 1.15;
/// Maximum length of a skin spring relative to its rest length: a longer one is shortened
/// immediately (Provot 1995, "Deformation Constraints in a Mass-Spring Model to Describe Rigid
/// Cloth Behavior").
const MAX_STRETCH: f32 = 2.15;
/// Length to which it is shortened: slightly less than the maximum, for faster convergence.
const SHORTENED: f32 = 2.1;
/// Maximum number of passes over possibly overlong springs, because shortening one spring stretches
/// its neighbours.
const MAX_RELAXATIONS: usize = 256;
/// Over-relaxation factor: a node's displacement relative to the mean of the corrections of its
/// overlong springs, weighted by their size.
const OVER_RELAXATION: f32 = 1.5;
/// Additional stiffness factor of a spring beyond its slack.
const STRAIN_STIFFENING: f32 = 3.0;
/// Length below which a vector has no direction, metres.
const MIN_M: f32 = 1e-9;

/// Position and direction at which a node is held in the current step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NodeHold {
    /// Position of the node without other forces.
    pub(super) place: Vector,
    /// Outward direction at the position, unit length.
    pub(super) outwards: Vector,
}

/// Set of indices with fixed capacity, also in a copy.
#[derive(Clone, Debug)]
struct IndexSet {
    items: Vec<u32>,
    count: usize,
    is_in: Vec<bool>,
}

impl IndexSet {
    fn with_capacity(all: usize) -> Self {
        Self {
            items: vec![0; all],
            count: 0,
            is_in: vec![false; all],
        }
    }

    fn put(&mut self, item: u32) {
        let is_in = &mut self.is_in[item as usize];
        if !*is_in {
            *is_in = true;
            self.items[self.count] = item;
            self.count += 1;
        }
    }

    fn clear(&mut self) {
        for &item in &self.items[..self.count] {
            self.is_in[item as usize] = false;
        }
        self.count = 0;
    }
}

/// Point masses and springs of the skin, and their state.
#[derive(Clone, Debug)]
pub(super) struct Springs {
    /// The nodes at the ends of each spring of the skin, the lower one first, sorted.
    ends: Vec<[u16; 2]>,
    /// Their lengths at rest.
    rest: Vec<f32>,
    /// All springs in groups of four, with the strength of their pull in a step.
    fours: Vec<SpringX4>,
    pulls: Vec<f32>,
    /// Counted after the springs where both are meant.
    edges: Vec<Edge>,
    connecting: Vec<ConnectingSprings>,
    /// Positions of the nodes, padded to a multiple of four with fixed ones.
    pub(super) places: Vec<Vector>,
    /// Positions at the previous step.
    pub(super) before: Vec<Vector>,
    /// Leader of each node, itself or another, and the offset from it.
    leaders: Vec<(u16, Vector)>,
    velocities: Vec<Vector>,
    /// Forces during a step, or correction and weight of overlong springs; otherwise 0.
    forces: Vec<Vector>,
    /// Start of each node's springs in `around`, plus one entry for the end.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// True if any spring may be overlong, false if only `suspects` may be.
    has_stepped: bool,
    suspects: IndexSet,
    /// Suspected overlong springs of the previous round.
    looked_at: IndexSet,
    /// Nodes at the ends of those that are too long.
    pulled: IndexSet,
}

impl Springs {
    /// Builds the springs from rest positions, faces, and for each node the distance to the layer
    /// under it and its grip; lists of equal length, indices in range.
    pub(super) fn new(rest: &[[f32; 3]], quads: &[[u16; 4]], depth: &[f32], grip: &[f32]) -> Self {
        let mut places: Vec<Vector> = rest.iter().copied().map(vector).collect();
        let nodes = places.len();
        let pairs = pairs_of(quads);
        let leaders = leaders(&places, pairs.iter().map(|(ends, _)| *ends));
        let edges = Edge::all(&places, &leaders, &pairs);
        let (ends, of) = skin(&places, &leaders, pairs);
        let fours = SpringX4::all(&ends, &of);
        let count = ends.len() + edges.len();
        let all = || ends.iter().copied().chain(edges.iter().map(|e| e.leaders));
        let (starts, around) = around_nodes(nodes, all);
        let leaders = (0..nodes)
            .map(|i| (leaders[i], places[i] - places[usize::from(leaders[i])]))
            .collect();
        places.resize(whole_fours(nodes), Vector::default());
        let still = vec![Vector::default(); places.len()];
        Self {
            has_stepped: true,
            suspects: IndexSet::with_capacity(count),
            looked_at: IndexSet::with_capacity(count),
            pulled: IndexSet::with_capacity(nodes),
            edges,
            starts,
            around,
            connecting: ConnectingSprings::all(depth, grip),
            before: places.clone(),
            leaders,
            velocities: still.clone(),
            forces: still,
            pulls: vec![0.0; fours.len() * LANES],
            fours,
            rest: of.iter().map(|[_, rest]| *rest).collect(),
            ends,
            places,
        }
    }

    /// Returns the number of springs, including the connecting springs.
    pub(super) fn count(&self) -> usize {
        self.ends.len() + 2 * self.leaders.len()
    }

    /// Resets every node to its hold position, moving as its hold does.
    pub(super) fn reset(&mut self, holds: &[NodeHold], earlier: &[NodeHold]) {
        self.has_stepped = true;
        for (i, (hold, earlier)) in holds.iter().zip(earlier).enumerate() {
            self.places[i] = hold.place;
            self.before[i] = earlier.place;
            self.velocities[i] = (hold.place - earlier.place) * STEPS_PER_S;
        }
    }

    /// Performs one step, from the previous hold positions of the nodes to the current ones.
    pub(super) fn step(&mut self, holds: &[NodeHold], earlier: &[NodeHold]) {
        self.has_stepped = true;
        self.find_pulls();
        self.pull();
        self.move_nodes(holds, earlier);
    }

    /// Finds how strongly the springs of the skin pull, against their lengths now.
    fn find_pulls(&mut self) {
        for (pulls, springs) in self.pulls.as_chunks_mut().0.iter_mut().zip(&self.fours) {
            let now = squares(springs.directions(&self.places)).sqrt();
            let now = now.fast_max(Vector::splat(MIN_M));
            let beyond = (now - springs.rest * SLACK).fast_max(Vector::splat(0.0));
            let longer = now - springs.rest + beyond * STRAIN_STIFFENING;
            *pulls = (springs.stiffness * longer / now).to_array();
        }
    }

    /// Adds the forces of the skin springs to their ends. Forces on a shared first end are summed
    /// in registers.
    fn pull(&mut self) {
        let mut all = &self.pulls[..];
        for own in self.ends.chunk_by(|x, y| x[0] == y[0]) {
            let (pulls, later) = all.split_at(own.len());
            let first = usize::from(own[0][0]);
            let (place, mut force) = (self.places[first], self.forces[first]);
            for ([_, end], pull) in own.iter().zip(pulls) {
                let end = usize::from(*end);
                let by = (self.places[end] - place) * *pull;
                force += by;
                self.forces[end] -= by;
            }
            self.forces[first] = force;
            all = later;
        }
    }

    /// Moves nodes by their forces, then clears these.
    fn move_nodes(&mut self, holds: &[NodeHold], earlier: &[NodeHold]) {
        let nodes = self.places.as_chunks_mut::<LANES>().0.iter_mut();
        let moving = self.velocities.as_chunks_mut::<LANES>().0.iter_mut();
        let forces = self.forces.as_chunks_mut::<LANES>().0.iter_mut();
        let before = self.before.as_chunks_mut::<LANES>().0.iter_mut();
        let holds = holds.as_chunks::<LANES>().0.iter();
        let earlier = earlier.as_chunks::<LANES>().0.iter();
        for ((((places, before), (velocities, forces)), (holds, earlier)), connecting) in nodes
            .zip(before)
            .zip(moving.zip(forces))
            .zip(holds.zip(earlier))
            .zip(&self.connecting)
        {
            *before = *places;
            let off: [Vector; LANES] = core::array::from_fn(|k| holds[k].place - places[k]);
            for deep in [-connecting.deep, connecting.deep].map(Vector::to_array) {
                let ends: [Vector; LANES] =
                    core::array::from_fn(|k| off[k] + holds[k].outwards * deep[k]);
                let now = squares(ends).sqrt().fast_max(Vector::splat(MIN_M));
                let pull = connecting.stiffness * (now - connecting.rest) / now;
                let pull = pull.to_array();
                for k in 0..LANES {
                    forces[k] += ends[k] * pull[k];
                }
            }
            let drag = (connecting.drag * STEPS_PER_S).to_array();
            let slower = (1.0 / (connecting.drag + 1.0)).to_array();
            for k in 0..LANES {
                let along = holds[k].place - earlier[k].place;
                let sped = velocities[k] + forces[k] * STEP_SECS;
                velocities[k] = (sped + along * drag[k]) * slower[k];
                forces[k] = Vector::default();
                places[k] += velocities[k] * STEP_SECS;
            }
        }
    }

    /// Moves led nodes to their leaders.
    pub(super) fn follow(&mut self) {
        for (node, (leader, off)) in self.leaders.iter().enumerate() {
            let leader = usize::from(*leader);
            if leader != node {
                self.places[node] = self.places[leader] + *off;
                self.before[node] = self.before[leader] + *off;
                self.velocities[node] = self.velocities[leader];
            }
        }
    }

    /// Returns true if a node is led by another one.
    pub(super) fn is_led(&self, node: usize) -> bool {
        usize::from(self.leaders[node].0) != node
    }

    /// Returns the position of a node after it has followed its leader.
    pub(super) fn position(&self, node: usize) -> Vector {
        let (leader, off) = self.leaders[node];
        self.places[usize::from(leader)] + off
    }

    /// Shortens overlong springs, and those that become overlong by this, until none is left;
    /// returns true if there was any.
    pub(super) fn limit(&mut self) -> bool {
        if self.has_stepped {
            self.has_stepped = false;
            self.suspect();
            for i in self.ends.len()..self.ends.len() + self.edges.len() {
                if self.too_long(i, SHORTENED).is_some() {
                    self.suspects.put(i as u32);
                }
            }
        }
        let mut was_any = false;
        for _ in 0..MAX_RELAXATIONS {
            core::mem::swap(&mut self.suspects, &mut self.looked_at);
            self.suspects.clear();
            let looked_at = &self.looked_at.items[..self.looked_at.count];
            let is_too_long = |&i: &u32| self.too_long(i as usize, MAX_STRETCH).is_some();
            if !looked_at.iter().any(is_too_long) {
                break;
            }
            was_any = true;
            // Nearly overlong springs are included, each by the amount of its demand: a node must
            // not jump at the threshold of a spring's length, because the last digits would make
            // the halves of a face differ.
            for k in 0..self.looked_at.count {
                let i = self.looked_at.items[k] as usize;
                if let Some((ends, by)) = self.too_long(i, SHORTENED) {
                    let much = length(by);
                    for (end, way) in ends.into_iter().zip([1.0, -1.0]) {
                        let [x, y, z] = xyz(by * way);
                        self.forces[end] += Vector::new([x, y, z, 1.0]) * much;
                        self.pulled.put(end as u32);
                    }
                }
            }
            // All springs apply simultaneously, because their order would make the halves of a face
            // differ.
            for k in 0..self.pulled.count {
                let node = self.pulled.items[k] as usize;
                let [x, y, z, much] = core::mem::take(&mut self.forces[node]).to_array();
                self.shift(
                    node,
                    vector([x, y, z]) * (OVER_RELAXATION / much.max(1e-12)),
                );
            }
            self.pulled.clear();
        }
        was_any
    }

    /// Finds which springs of the skin may be too long.
    fn suspect(&mut self) {
        for (first, springs) in (0u32..).step_by(LANES).zip(&self.fours) {
            let most = springs.rest * SHORTENED;
            let beyond = squares(springs.directions(&self.places)).simd_gt(most * most);
            if beyond.any() {
                let which = beyond.to_bitmask();
                for i in (first..self.ends.len() as u32).take(LANES) {
                    if which >> (i - first) & 1 == 1 {
                        self.suspects.put(i);
                    }
                }
            }
        }
    }

    /// Returns the ends of a spring or edge longer than `longest` times its rest length, and the
    /// correction of each end, in the first one's direction.
    fn too_long(&self, i: usize, longest: f32) -> Option<([usize; 2], Vector)> {
        let (ends, off, rest) = if i < self.ends.len() {
            (self.ends[i], Vector::default(), self.rest[i])
        } else {
            let edge = self.edges[i - self.ends.len()];
            (edge.leaders, edge.off, edge.rest)
        };
        let [a, b] = ends.map(usize::from);
        let way = self.places[b] - self.places[a] + off;
        let square = dot(way, way);
        let most = longest * rest;
        (square > most * most).then(|| {
            let now = square.sqrt();
            ([a, b], (way * (0.5 * (now - SHORTENED * rest) / now)))
        })
    }

    /// Moves a node that may not be where the step left it, by its leader.
    pub(super) fn shift(&mut self, node: usize, by: Vector) {
        let node = usize::from(self.leaders[node].0);
        self.places[node] += by;
        self.velocities[node] += by * STEPS_PER_S;
        for i in self.starts[node]..self.starts[node + 1] {
            self.suspects.put(self.around[i as usize]);
        }
    }

    /// Returns the speed of the fastest node, m/s.
    pub(super) fn fastest(&self) -> f32 {
        self.velocities
            .iter()
            .map(|v| length(*v))
            .fold(0.0, f32::max)
    }

    /// Returns the largest stretch of a spring or an edge of the skin, relative to its rest length.
    pub(super) fn most_stretched(&self) -> f32 {
        let springs = self.ends.iter().zip(&self.rest);
        let springs = springs.map(|(ends, rest)| (*ends, Vector::default(), *rest));
        let edges = self.edges.iter().map(|e| (e.leaders, e.off, e.rest));
        springs
            .chain(edges)
            .map(|(ends, off, rest)| {
                let [a, b] = ends.map(|i| self.places[usize::from(i)]);
                length(b - a + off) / rest
            })
            .fold(0.0, f32::max)
    }
}

//! Springs of a face's skin, derived from its geometry once: those of the skin, those that hold the
//! nodes, and the nodes that form one mass. Stiffnesses are per mass, 1/s².

use super::lanes::{LANES, Vector, four, length, xyz};

/// Steps of the network a second.
pub(super) const STEPS_PER_S: f32 = 120.0;
pub(super) const STEP_SECS: f32 = 1.0 / STEPS_PER_S;

/// Stiffness of the springs along the edges of the skin, 1/s²; diagonals, which resist shear, have
/// a part of it. Designed.
const SKIN_PER_S2: f32 = 900.0;
const DIAGONAL: f32 = 0.5;
/// Stiffness of each of the two springs that hold a node over its position: to the layer under it,
/// and mirrored outwards.
const CONNECTING_PER_S2: f32 = 6000.0;
/// Below this grip those springs are softer.
const FIRM_GRIP: f32 = 0.3;
/// Factor of their additional stiffness at the lips, which must follow speech.
const LIP: f32 = 1.0;
/// Friction between the skin and the layer under it, relative to the critical damping of a node's
/// lateral hold, and its minimum, 1/s. It acts on the velocity difference, so skin does not lag
/// behind a muscle that moves uniformly. Designed.
const FRICTION: f32 = 0.55;
const MIN_FRICTION_PER_S: f32 = 60.0;
/// Distance below which nodes form one mass, metres: in the corners of the mouth the rings of both
/// lips crowd, and no time step would be short enough for springs of a tenth of a millimetre.
const APART_M: f32 = 0.001;

/// Slope by which, of nodes equally far in front, the upper one counts as foremost.
const ASLANT: f32 = 0.37;

/// Returns the leader of each node: the foremost node among those joined by edges too short for
/// springs. Unlike index order, the choice is invariant under mirroring.
pub(super) fn leaders(places: &[Vector], edges: impl Iterator<Item = [u16; 2]>) -> Vec<u16> {
    let mut leaders: Vec<u16> = (0..places.len() as u16).collect();
    let ahead = |i: u16| {
        let p = xyz(places[usize::from(i)]);
        p[2] + ASLANT * p[1]
    };
    for ends in edges {
        let [a, b] = ends.map(usize::from);
        if length(places[a] - places[b]) < APART_M && leaders[a] != leaders[b] {
            let (mut from, mut to) = (leaders[a], leaders[b]);
            if ahead(from) > ahead(to) {
                (from, to) = (to, from);
            }
            for leader in &mut leaders {
                if *leader == from {
                    *leader = to;
                }
            }
        }
    }
    leaders
}

/// Edge or diagonal of the skin with at least one end led by another node. The spring is between
/// the leaders; this edge has a length limit too.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) leaders: [u16; 2],
    /// Offset from one end to the other while their leaders coincide.
    pub(super) off: Vector,
    pub(super) rest: f32,
}

/// Four springs of the skin, processed together with SIMD.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpringX4 {
    pub(super) ends: [[u16; 2]; LANES],
    pub(super) stiffness: Vector,
    pub(super) rest: Vector,
}

impl SpringX4 {
    /// Returns the springs between these nodes, with the stiffness and the rest length of each.
    pub(super) fn all(ends: &[[u16; 2]], of: &[[f32; 2]]) -> Vec<Self> {
        (0..ends.len())
            .step_by(LANES)
            .map(|from| {
                let own = four(from, ends.len());
                Self {
                    ends: own.map(|i| ends[i]),
                    stiffness: Vector::new(own.map(|i| of[i][0])),
                    rest: Vector::new(own.map(|i| of[i][1])),
                }
            })
            .collect()
    }

    /// Returns the vectors from their first ends to their second.
    #[inline]
    pub(super) fn directions(&self, places: &[Vector]) -> [Vector; LANES] {
        self.ends
            .map(|[a, b]| places[usize::from(b)] - places[usize::from(a)])
    }
}

/// Connecting springs of four nodes, two each, which hold the skin over the layers beneath.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConnectingSprings {
    /// Distance from the node to their ends.
    pub(super) deep: Vector,
    pub(super) rest: Vector,
    pub(super) stiffness: Vector,
    /// Friction of a step.
    pub(super) drag: Vector,
}

impl ConnectingSprings {
    /// Builds the springs from each node's distance to the layer under it and its grip.
    pub(super) fn all(depth: &[f32], grip: &[f32]) -> Vec<Self> {
        let of: Vec<Vector> = depth
            .iter()
            .zip(grip)
            .map(|(&d, &g)| hold_vector(d, g))
            .collect();
        (0..of.len())
            .step_by(LANES)
            .map(|from| {
                let own = four(from, of.len()).map(|i| of[i]);
                let [deep, rest, stiffness, drag] = Vector::transpose(own);
                Self {
                    deep,
                    rest,
                    stiffness,
                    drag,
                }
            })
            .collect()
    }
}

impl Edge {
    /// Returns the edges between the nodes of `pairs`.
    pub(super) fn all(places: &[Vector], leaders: &[u16], pairs: &[([u16; 2], f32)]) -> Vec<Self> {
        let mut pairs: Vec<[u16; 2]> = pairs.iter().map(|(ends, _)| *ends).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
            .into_iter()
            .filter_map(|ends| {
                let [a, b] = ends.map(usize::from);
                let own = [leaders[a], leaders[b]];
                let off = |i: usize| places[i] - places[usize::from(leaders[i])];
                (own != ends && own[0] != own[1]).then(|| Self {
                    leaders: own,
                    off: off(b) - off(a),
                    rest: length(places[b] - places[a]),
                })
            })
            .collect()
    }
}

/// Returns the edges and diagonals of faces, the lower node first, with their stiffness; edges
/// between two faces occur twice.
pub(super) fn pairs_of(quads: &[[u16; 4]]) -> Vec<([u16; 2], f32)> {
    let mut pairs = Vec::with_capacity(quads.len() * 6);
    for q in quads {
        for k in 0..4 {
            let (a, b) = (q[k], q[(k + 1) % 4]);
            pairs.push(([a.min(b), a.max(b)], SKIN_PER_S2));
        }
        pairs.push(([q[0], q[2]], SKIN_PER_S2 * DIAGONAL));
        pairs.push(([q[1], q[3]], SKIN_PER_S2 * DIAGONAL));
    }
    pairs
}

/// Computes the springs of the skin: sorted ends, and the stiffness and the rest length of each.
pub(super) fn skin(
    places: &[Vector],
    leaders: &[u16],
    mut pairs: Vec<([u16; 2], f32)>,
) -> (Vec<[u16; 2]>, Vec<[f32; 2]>) {
    for (ends, _) in &mut pairs {
        let [a, b] = ends.map(|i| leaders[usize::from(i)]);
        *ends = [a.min(b), a.max(b)];
    }
    // Of the springs between the same nodes the stiffest.
    pairs.sort_unstable_by(|(a, k), (b, l)| a.cmp(b).then(l.total_cmp(k)));
    pairs.dedup_by_key(|(ends, _)| *ends);
    // A node needs no spring to itself.
    pairs.retain(|([a, b], _)| a != b);
    let with_rest = |(ends, stiffness): ([u16; 2], f32)| {
        let [a, b] = ends.map(|i| places[usize::from(i)]);
        (ends, [stiffness, length(b - a)])
    };
    pairs.into_iter().map(with_rest).unzip()
}

/// Springs by their nodes: where those of each node begin in the list of all, with one more for
/// its end, and that list.
pub(super) fn around_nodes<E: Iterator<Item = [u16; 2]>>(
    nodes: usize,
    ends: impl Fn() -> E,
) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0; nodes + 1];
    for i in ends().flatten() {
        starts[usize::from(i) + 1] += 1;
    }
    for i in 1..starts.len() {
        starts[i] += starts[i - 1];
    }
    let mut filled = starts.clone();
    let mut around = vec![0; starts[nodes] as usize];
    for (own, ends) in (0u32..).zip(ends()) {
        for i in ends.map(usize::from) {
            around[filled[i] as usize] = own;
            filled[i] += 1;
        }
    }
    (starts, around)
}

/// Returns the hold parameters of a node: distance to the ends of its connecting springs, their
/// rest length and stiffness, and the friction per step.
fn hold_vector(depth: f32, grip: f32) -> Vector {
    let depth = depth.clamp(0.001, 0.05);
    // A node with little grip lies in a fold, and follows its neighbours. Muscle holds the lips on
    // all sides.
    let lip = 1.0 + LIP * ((grip - 0.75) / 0.1).clamp(0.0, 1.0);
    let firm = (grip / FIRM_GRIP).clamp(0.1, 1.0) * lip;
    let (stiffness, grip) = (CONNECTING_PER_S2 * firm, grip.clamp(0.05, 1.0));
    let critical = 2.0 * (2.0 * stiffness * grip).sqrt();
    let friction = (FRICTION * critical).max(MIN_FRICTION_PER_S);
    Vector::new([depth, depth * (1.0 - grip), stiffness, friction * STEP_SECS])
}

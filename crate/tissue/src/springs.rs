//! The mass-spring network of the skin (F&H section 3.1.2, "Mass Spring Network"), in its
//! own small world: point masses of 1, seconds, metres.
//!
//! Stiffnesses are per mass, 1/s². A step is a 120th of a second; leapfrog Verlet integration
//! is stable while the stiffest mode stays under (2 / step)² = 57,600, which
//! [`SKIN_PER_S2`] and [`CONNECTING_PER_S2`] keep with a margin.

/// Steps of the network a second.
pub(super) const STEPS_PER_S: f32 = 120.0;
const STEP_SECS: f32 = 1.0 / STEPS_PER_S;

/// Of the edges of the skin; diagonals, which resist shear, have a part of it. Designed.
const SKIN_PER_S2: f32 = 900.0;
const DIAGONAL: f32 = 0.5;
/// Skin that is stretched beyond this resists more (biphasic). F&H gives no numbers; skin
/// stiffens at 10 to 20 %.
const SLACK: f32 = 1.15;
/// No spring of the skin is left longer than this, against its length at rest: what a step
/// has stretched more is shortened at once (Provot 1995, "Deformation Constraints in a
/// Mass-Spring Model to Describe Rigid Cloth Behavior").
const LONGEST: f32 = 2.15;
/// What it is shortened to: a little less, so that it is soon done with.
const SHORTENED: f32 = 2.1;
/// How often what may be too long is gone through, as shortening one spring stretches its
/// neighbours.
const MOST_RELAXATIONS: usize = 256;
/// What a node moves by, against the mean of what its springs that are too long ask for, in
/// which each counts as much as it asks for.
const OVER_RELAXATION: f32 = 1.5;
/// How much stiffer a spring is beyond its slack.
const STRAIN_STIFFENING: f32 = 3.0;
/// Of each of the two springs that hold a node over its place: to what lies under it, and
/// mirrored outwards.
const CONNECTING_PER_S2: f32 = 6000.0;
/// Below this grip those springs are softer.
const FIRM_GRIP: f32 = 0.3;
/// How much stiffer they are at the lips, which must follow speech.
const LIP: f32 = 1.0;
/// Friction between the skin and what it lies on, against the critical damping of how a node is
/// held sideways, and the least of it, 1/s. It acts on the difference of their velocities, so
/// that skin does not lag behind a muscle that moves evenly. Designed.
const FRICTION: f32 = 0.55;
const LEAST_FRICTION_PER_S: f32 = 60.0;

/// Four numbers a node, the last unused: a processor takes them in one go.
pub(super) type Vector = [f32; 4];

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
}

fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

fn times(a: Vector, k: f32) -> Vector {
    [a[0] * k, a[1] * k, a[2] * k, a[3] * k]
}

fn length(a: Vector) -> f32 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

/// A spring of the skin.
#[derive(Clone, Copy, Debug)]
struct Spring {
    ends: [u16; 2],
    stiffness: f32,
    rest: f32,
}

/// Where a node is held now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hold {
    /// Where it would be if nothing else pulled.
    pub(super) place: Vector,
    /// Way outwards there, unit length.
    pub(super) outwards: Vector,
}

/// Nodes nearer to each other than this are one mass, metres: in the corners of the mouth the
/// rings of both lips crowd, and between springs of a tenth of a millimetre none would be
/// short enough to hold.
const APART_M: f32 = 0.001;

/// Of nodes equally far in front the upper one counts as foremost.
const ASLANT: f32 = 0.37;

/// For each node the one that leads it: of those that edges too short for springs join, the
/// foremost. Which one that is does not change in a mirror, as their order does.
fn leaders(places: &[Vector], edges: impl Iterator<Item = [u16; 2]>) -> Vec<u16> {
    let mut leaders: Vec<u16> = (0..places.len() as u16).collect();
    let ahead = |i: u16| {
        let p = places[usize::from(i)];
        p[2] + ASLANT * p[1]
    };
    for ends in edges {
        let [a, b] = ends.map(usize::from);
        if length(minus(places[a], places[b])) < APART_M && leaders[a] != leaders[b] {
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

/// An edge or diagonal of the skin of which at least one end is led by another node. Between
/// their leaders there is a spring; this one may not get too long either.
#[derive(Clone, Copy, Debug)]
struct Edge {
    leaders: [u16; 2],
    /// From one end to the other, while their leaders are at one place.
    off: Vector,
    rest: f32,
}

/// Some of a number of things, each once; with room for all, also in a copy.
#[derive(Clone, Debug)]
struct Chosen {
    items: Vec<u32>,
    count: usize,
    is_in: Vec<bool>,
}

impl Chosen {
    fn of(all: usize) -> Self {
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

/// Masses and springs.
#[derive(Clone, Debug)]
pub(super) struct Springs {
    springs: Vec<Spring>,
    /// Counted after the springs where both are meant.
    edges: Vec<Edge>,
    /// Distance to the ends of the connecting springs, their length at rest, their stiffness,
    /// and the friction of a step.
    connecting: Vec<[f32; 4]>,
    pub(super) places: Vec<Vector>,
    /// Places one step ago.
    pub(super) before: Vec<Vector>,
    /// Which node leads each, itself or another, and the way from that one.
    leaders: Vec<(u16, Vector)>,
    velocities: Vec<Vector>,
    /// Of a step, or how far the springs that are too long pull, and their weight; else 0.
    forces: Vec<Vector>,
    /// Where the springs of each node begin in `around`; one more for the end.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// Whether any spring may be too long, or only `suspects`.
    has_stepped: bool,
    suspects: Chosen,
    /// Those of the round before.
    looked_at: Chosen,
    /// Nodes at the ends of those that are too long.
    pulled: Chosen,
}

impl Springs {
    /// From places at rest, faces, and for each node the distance to what lies under it and
    /// its grip; lists of one length, indices within.
    pub(super) fn new(rest: &[[f32; 3]], quads: &[[u16; 4]], depth: &[f32], grip: &[f32]) -> Self {
        let places: Vec<Vector> = rest.iter().map(|p| [p[0], p[1], p[2], 0.0]).collect();
        let mut pairs: Vec<([u16; 2], f32)> = Vec::with_capacity(quads.len() * 4);
        for q in quads {
            for k in 0..4 {
                let (a, b) = (q[k], q[(k + 1) % 4]);
                pairs.push(([a.min(b), a.max(b)], SKIN_PER_S2));
            }
            pairs.push(([q[0], q[2]], SKIN_PER_S2 * DIAGONAL));
            pairs.push(([q[1], q[3]], SKIN_PER_S2 * DIAGONAL));
        }
        let leaders = leaders(&places, pairs.iter().map(|(ends, _)| *ends));
        let mut led_pairs: Vec<[u16; 2]> = pairs.iter().map(|(ends, _)| *ends).collect();
        led_pairs.sort_unstable();
        led_pairs.dedup();
        let edges: Vec<Edge> = led_pairs
            .into_iter()
            .filter_map(|ends| {
                let [a, b] = ends.map(usize::from);
                let own = [leaders[a], leaders[b]];
                let off = |i: usize| minus(places[i], places[usize::from(leaders[i])]);
                (own != ends && own[0] != own[1]).then(|| Edge {
                    leaders: own,
                    off: minus(off(b), off(a)),
                    rest: length(minus(places[b], places[a])),
                })
            })
            .collect();
        for (ends, _) in &mut pairs {
            let [a, b] = ends.map(|i| leaders[usize::from(i)]);
            *ends = [a.min(b), a.max(b)];
        }
        // Most edges belong to two faces; of what lies between the same nodes, the stiffest.
        pairs.sort_unstable_by(|(a, k), (b, l)| a.cmp(b).then(l.total_cmp(k)));
        pairs.dedup_by_key(|(ends, _)| *ends);
        let springs = pairs
            .into_iter()
            .filter_map(|(ends, stiffness)| {
                let [a, b] = ends.map(|i| places[usize::from(i)]);
                let rest = length(minus(b, a));
                // A node needs no spring to itself.
                (ends[0] != ends[1]).then_some(Spring {
                    ends,
                    stiffness,
                    rest,
                })
            })
            .collect::<Vec<Spring>>();
        let connecting = depth
            .iter()
            .zip(grip)
            .map(|(&d, &g)| {
                let d = d.clamp(0.001, 0.05);
                // What is hardly gripped lies in a fold, and follows its neighbours.
                // Lips are held by muscle on all sides.
                let lip = 1.0 + LIP * ((g - 0.75) / 0.1).clamp(0.0, 1.0);
                let firm = (g / FIRM_GRIP).clamp(0.1, 1.0) * lip;
                {
                    let (stiffness, grip) = (CONNECTING_PER_S2 * firm, g.clamp(0.05, 1.0));
                    let critical = 2.0 * (2.0 * stiffness * grip).sqrt();
                    let friction = (FRICTION * critical).max(LEAST_FRICTION_PER_S);
                    [d, d * (1.0 - grip), stiffness, friction * STEP_SECS]
                }
            })
            .collect();
        let leaders = (0..places.len())
            .map(|i| {
                (
                    leaders[i],
                    minus(places[i], places[usize::from(leaders[i])]),
                )
            })
            .collect();
        let still = vec![[0.0; 4]; places.len()];
        let ends = || {
            let springs = springs.iter().map(|s| s.ends);
            springs.chain(edges.iter().map(|e| e.leaders))
        };
        let count = springs.len() + edges.len();
        let mut starts = vec![0; places.len() + 1];
        for i in ends().flatten() {
            starts[usize::from(i) + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut filled = starts.clone();
        let mut around = vec![0; 2 * count];
        for (own, ends) in (0u32..).zip(ends()) {
            for i in ends.map(usize::from) {
                around[filled[i] as usize] = own;
                filled[i] += 1;
            }
        }
        Self {
            has_stepped: true,
            suspects: Chosen::of(count),
            looked_at: Chosen::of(count),
            pulled: Chosen::of(places.len()),
            edges,
            starts,
            around,
            connecting,
            before: places.clone(),
            leaders,
            velocities: still.clone(),
            forces: still,
            springs,
            places,
        }
    }

    /// How many springs there are, with those that hold the nodes.
    pub(super) fn count(&self) -> usize {
        self.springs.len() + 2 * self.connecting.len()
    }

    /// Puts every node where it is held, moving as its hold does.
    pub(super) fn reset(&mut self, holds: &[Hold], earlier: &[Hold]) {
        self.has_stepped = true;
        for (i, (hold, earlier)) in holds.iter().zip(earlier).enumerate() {
            self.places[i] = hold.place;
            self.before[i] = earlier.place;
            self.velocities[i] = times(minus(hold.place, earlier.place), STEPS_PER_S);
        }
    }

    /// One step, from where the nodes were held before it to where they are held now.
    pub(super) fn step(&mut self, holds: &[Hold], earlier: &[Hold]) {
        self.has_stepped = true;
        for spring in &self.springs {
            let [a, b] = spring.ends.map(usize::from);
            let way = minus(self.places[b], self.places[a]);
            let now = length(way).max(1e-9);
            let beyond = (now - SLACK * spring.rest).max(0.0);
            let pull = spring.stiffness * (now - spring.rest + STRAIN_STIFFENING * beyond) / now;
            let force = times(way, pull);
            self.forces[a] = plus(self.forces[a], force);
            self.forces[b] = minus(self.forces[b], force);
        }
        let held = holds.iter().zip(earlier).zip(&self.connecting);
        let nodes = self.places.iter_mut().zip(&mut self.before);
        let moving = self.velocities.iter_mut().zip(&mut self.forces);
        for (
            ((hold, earlier), &[deep, rest, stiffness, drag]),
            ((place, before), (velocity, force)),
        ) in held.zip(nodes.zip(moving))
        {
            let off = minus(hold.place, *place);
            let down = times(hold.outwards, deep);
            let mut pull = core::mem::take(force);
            for end in [minus(off, down), plus(off, down)] {
                let now = length(end).max(1e-9);
                pull = plus(pull, times(end, stiffness * (now - rest) / now));
            }
            let along = minus(hold.place, earlier.place);
            let sped = plus(*velocity, times(pull, STEP_SECS));
            *velocity = times(
                plus(sped, times(along, drag * STEPS_PER_S)),
                1.0 / (1.0 + drag),
            );
            *before = *place;
            *place = plus(*place, times(*velocity, STEP_SECS));
        }
    }

    /// Puts the nodes that are led where their leaders are.
    pub(super) fn follow(&mut self) {
        for (node, (leader, off)) in self.leaders.iter().enumerate() {
            let leader = usize::from(*leader);
            if leader != node {
                self.places[node] = plus(self.places[leader], *off);
                self.before[node] = plus(self.before[leader], *off);
                self.velocities[node] = self.velocities[leader];
            }
        }
    }

    /// Whether a node goes with another one.
    pub(super) fn is_led(&self, node: usize) -> bool {
        usize::from(self.leaders[node].0) != node
    }

    /// Where a node is, or will be once it has followed its leader.
    pub(super) fn at(&self, node: usize) -> Vector {
        let (leader, off) = self.leaders[node];
        plus(self.places[usize::from(leader)], off)
    }

    /// Shortens what is too long, and what that has made too long, until nothing is; tells
    /// whether anything was.
    pub(super) fn limit(&mut self) -> bool {
        if self.has_stepped {
            self.has_stepped = false;
            for i in 0..self.springs.len() + self.edges.len() {
                if self.too_long(i, SHORTENED).is_some() {
                    self.suspects.put(i as u32);
                }
            }
        }
        let mut was_any = false;
        for _ in 0..MOST_RELAXATIONS {
            core::mem::swap(&mut self.suspects, &mut self.looked_at);
            self.suspects.clear();
            let looked_at = &self.looked_at.items[..self.looked_at.count];
            let is_too_long = |&i: &u32| self.too_long(i as usize, LONGEST).is_some();
            if !looked_at.iter().any(is_too_long) {
                break;
            }
            was_any = true;
            // With them those that are nearly as long, and each by how much it asks for: what a
            // node does must not jump where a spring hardly is or hardly is not too long, or
            // the last digits would make halves of a face differ.
            for k in 0..self.looked_at.count {
                let i = self.looked_at.items[k] as usize;
                if let Some((ends, by)) = self.too_long(i, SHORTENED) {
                    let much = length(by);
                    for (end, way) in ends.into_iter().zip([1.0, -1.0]) {
                        let by = [way * by[0], way * by[1], way * by[2], 1.0];
                        self.forces[end] = plus(self.forces[end], times(by, much));
                        self.pulled.put(end as u32);
                    }
                }
            }
            // All at once, or the order of springs would make halves of a face differ.
            for k in 0..self.pulled.count {
                let node = self.pulled.items[k] as usize;
                let [x, y, z, much] = core::mem::take(&mut self.forces[node]);
                self.shift(
                    node,
                    times([x, y, z, 0.0], OVER_RELAXATION / much.max(1e-12)),
                );
            }
            self.pulled.clear();
        }
        was_any
    }

    /// The ends of a spring or edge that is longer than `longest` times its length at rest, and
    /// what each has to move by, the first one's way.
    fn too_long(&self, i: usize, longest: f32) -> Option<([usize; 2], Vector)> {
        let (ends, off, rest) = if let Some(spring) = self.springs.get(i) {
            (spring.ends, [0.0; 4], spring.rest)
        } else {
            let edge = self.edges[i - self.springs.len()];
            (edge.leaders, edge.off, edge.rest)
        };
        let [a, b] = ends.map(usize::from);
        let way = plus(minus(self.places[b], self.places[a]), off);
        let square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
        let most = longest * rest;
        (square > most * most).then(|| {
            let now = square.sqrt();
            ([a, b], times(way, 0.5 * (now - SHORTENED * rest) / now))
        })
    }

    /// Moves a node that may not be where the step left it, by its leader.
    pub(super) fn shift(&mut self, node: usize, by: Vector) {
        let node = usize::from(self.leaders[node].0);
        self.places[node] = plus(self.places[node], by);
        self.velocities[node] = plus(self.velocities[node], times(by, STEPS_PER_S));
        for i in self.starts[node]..self.starts[node + 1] {
            self.suspects.put(self.around[i as usize]);
        }
    }

    /// The fastest node, metres a second.
    pub(super) fn fastest(&self) -> f32 {
        self.velocities
            .iter()
            .map(|v| length(*v))
            .fold(0.0, f32::max)
    }

    /// The most that a spring or an edge of the skin is stretched, against its length at rest.
    pub(super) fn most_stretched(&self) -> f32 {
        let springs = self.springs.iter().map(|s| (s.ends, [0.0; 4], s.rest));
        let edges = self.edges.iter().map(|e| (e.leaders, e.off, e.rest));
        springs
            .chain(edges)
            .map(|(ends, off, rest)| {
                let [a, b] = ends.map(|i| self.places[usize::from(i)]);
                length(plus(minus(b, a), off)) / rest
            })
            .fold(0.0, f32::max)
    }
}

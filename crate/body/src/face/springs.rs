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
/// How often those are gone through, as shortening one stretches its neighbours.
const ROUNDS: usize = 64;
/// How much more.
const STIFFER: f32 = 3.0;
/// Of each of the two springs that hold a node over its place: to what lies under it, and
/// mirrored outwards.
const CONNECTING_PER_S2: f32 = 6000.0;
/// Below this grip those springs are softer.
const FIRM_GRIP: f32 = 0.3;
/// How much stiffer they are at the lips, which must follow speech.
const LIP: f32 = 0.8;
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

/// For each node the one that leads it: of those that edges too short for springs join, the
/// first.
fn leaders(places: &[Vector], edges: impl Iterator<Item = [u16; 2]>) -> Vec<u16> {
    let mut leaders: Vec<u16> = (0..places.len() as u16).collect();
    for ends in edges {
        let [a, b] = ends.map(usize::from);
        if length(minus(places[a], places[b])) < APART_M {
            let (from, to) = (leaders[a].max(leaders[b]), leaders[a].min(leaders[b]));
            for leader in &mut leaders {
                if *leader == from {
                    *leader = to;
                }
            }
        }
    }
    leaders
}

/// Masses and springs.
#[derive(Clone, Debug)]
pub(super) struct Springs {
    springs: Vec<Spring>,
    /// Distance to the ends of the connecting springs, their length at rest, their stiffness,
    /// and the friction of a step.
    connecting: Vec<[f32; 4]>,
    pub(super) places: Vec<Vector>,
    /// Places one step ago.
    pub(super) before: Vec<Vector>,
    /// Nodes that go with another, which leads them, and their way from it.
    led: Vec<([u16; 2], Vector)>,
    velocities: Vec<Vector>,
    forces: Vec<Vector>,
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
        for (ends, _) in &mut pairs {
            let [a, b] = ends.map(|i| leaders[usize::from(i)]);
            *ends = [a.min(b), a.max(b)];
        }
        // Most edges belong to two faces.
        pairs.sort_unstable_by_key(|(ends, _)| *ends);
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
        let led = (0u16..)
            .zip(&leaders)
            .filter(|(i, leader)| i != *leader)
            .map(|(i, &leader)| {
                let off = minus(places[usize::from(i)], places[usize::from(leader)]);
                ([i, leader], off)
            })
            .collect();
        let still = vec![[0.0; 4]; places.len()];
        Self {
            connecting,
            before: places.clone(),
            led,
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
        for (i, (hold, earlier)) in holds.iter().zip(earlier).enumerate() {
            self.places[i] = hold.place;
            self.before[i] = earlier.place;
            self.velocities[i] = times(minus(hold.place, earlier.place), STEPS_PER_S);
        }
    }

    /// One step, from where the nodes were held before it to where they are held now.
    pub(super) fn step(&mut self, holds: &[Hold], earlier: &[Hold]) {
        self.forces.fill([0.0; 4]);
        for spring in &self.springs {
            let [a, b] = spring.ends.map(usize::from);
            let way = minus(self.places[b], self.places[a]);
            let now = length(way).max(1e-9);
            let beyond = (now - SLACK * spring.rest).max(0.0);
            let pull = spring.stiffness * (now - spring.rest + STIFFER * beyond) / now;
            let force = times(way, pull);
            self.forces[a] = plus(self.forces[a], force);
            self.forces[b] = minus(self.forces[b], force);
        }
        let held = holds.iter().zip(earlier).zip(&self.connecting);
        let nodes = self.places.iter_mut().zip(&mut self.before);
        let moving = self.velocities.iter_mut().zip(&self.forces);
        for (
            ((hold, earlier), &[deep, rest, stiffness, drag]),
            ((place, before), (velocity, force)),
        ) in held.zip(nodes.zip(moving))
        {
            let off = minus(hold.place, *place);
            let down = times(hold.outwards, deep);
            let mut pull = *force;
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
        for ([node, leader], off) in &self.led {
            let (node, leader) = (usize::from(*node), usize::from(*leader));
            self.places[node] = plus(self.places[leader], *off);
            self.before[node] = plus(self.before[leader], *off);
            self.velocities[node] = self.velocities[leader];
        }
    }

    /// Shortens what is too long.
    pub(super) fn limit(&mut self) {
        let last = self.springs.len();
        for round in 0..ROUNDS {
            let mut is_done = true;
            for i in 0..last {
                // There and back, or a chain would pass what it has too much on one way only.
                let spring = self.springs[if round % 2 == 0 { i } else { last - 1 - i }];
                let [a, b] = spring.ends.map(usize::from);
                let way = minus(self.places[b], self.places[a]);
                let most = LONGEST * spring.rest;
                let square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
                if square > most * most {
                    let now = square.sqrt();
                    let by = times(way, 0.5 * (now - most) / now);
                    self.shift(a, by);
                    self.shift(b, minus([0.0; 4], by));
                    is_done = false;
                }
            }
            if is_done {
                break;
            }
        }
    }

    /// Moves a node that may not be where the step left it.
    pub(super) fn shift(&mut self, node: usize, by: Vector) {
        self.places[node] = plus(self.places[node], by);
        self.velocities[node] = plus(self.velocities[node], times(by, STEPS_PER_S));
    }

    /// The fastest node, metres a second.
    pub(super) fn fastest(&self) -> f32 {
        self.velocities
            .iter()
            .map(|v| length(*v))
            .fold(0.0, f32::max)
    }

    /// The most that a spring of the skin is stretched, against its length at rest.
    pub(super) fn most_stretched(&self) -> f32 {
        self.springs
            .iter()
            .map(|s| {
                let [a, b] = s.ends.map(|i| self.places[usize::from(i)]);
                length(minus(b, a)) / s.rest
            })
            .fold(0.0, f32::max)
    }
}

//! Face in motion: controls move muscles and jaw, these move the network, and that moves the skin.

use super::contact::{Contacts, JawPlace, PenetrationDepths};
use super::lanes::{LANES, Vector, squares, vector, whole_fours, xyz};
use super::layout::STEPS_PER_S;
use super::muscles::Muscles;
use super::smoothing::Smoothing;
use super::springs::{NodeHold, Springs};
use super::tissue::{Column, LipNode};
use super::{Anatomy, FaceControls, Jaw, Muscle, NodeState, Tissue};

/// Maximum number of rounds per step that relax overlong springs and resolve the resulting
/// contacts. A speaking face needs one; muscles that jump over their full range need about ten, and
/// skin is then within half a millimetre of its limits.
const TURNS: usize = 64;
/// Number of steps after which a face is at rest, for any controls.
const WARM_UP_STEPS: usize = 90;
/// Share of a gap that the lower lip closes where it closes most; see [`LipNode::closes`].
const LOWER_CLOSES: f32 = 0.64;
/// Overlap by which sealed lips press each other, metres on the reference head; contact stops them.
const PRESS_M: f32 = 0.0012;

/// Share of each kind of wrinkle in the age lines: those across the root of the nose and around the
/// lips are the faintest. Chosen by eye.
const AGE_LINES: [f32; 3] = [1.0, 0.75, 0.45];

/// A node whose skin a muscle folds.
#[derive(Clone, Copy, Debug)]
struct Fold {
    node: u16,
    /// Index of the channel in [`NodeState::wrinkles`].
    channel: u8,
    muscle: Muscle,
    /// Share of the muscle's movement that the node follows.
    weight: f32,
    strength: f32,
}

impl Fold {
    fn all(tissue: &Tissue, anatomy: &Anatomy) -> Vec<Self> {
        let mut by_point = vec![None; tissue.points.len()];
        for fibre in &tissue.fibres {
            let first = usize::from(fibre.first);
            let fold = anatomy.fold(fibre.muscle).map(|fold| (fibre.muscle, fold));
            by_point[first..first + usize::from(fibre.count)].fill(fold);
        }
        let starts = (0u16..).zip(tissue.starts.windows(2));
        starts
            .flat_map(|(node, own)| {
                let own = &tissue.attachments[own[0] as usize..own[1] as usize];
                own.iter().map(move |hold| (node, hold))
            })
            .filter_map(|(node, hold)| {
                let (muscle, (channel, strength)) = by_point[usize::from(hold.point)]?;
                Some(Self {
                    node,
                    channel,
                    muscle,
                    weight: hold.weight,
                    strength,
                })
            })
            .collect()
    }
}

/// Dynamic state of the tissue of one face, a network of point masses and springs. It depends only
/// on the controls since [`Network::reset`]; a step allocates nothing.
#[derive(Clone, Debug)]
pub struct Network {
    muscles: Muscles,
    springs: Springs,
    contacts: Contacts,
    /// Outward direction of each node at rest.
    outwards: Vec<Vector>,
    holds: Vec<NodeHold>,
    earlier: Vec<NodeHold>,
    /// Current position of the layer under each node, without muscles.
    bones: Vec<[Vector; 2]>,
    jaw: JawPlace,
    /// Displacement of the lips of each column while they are closed.
    gaps: Vec<[f32; 3]>,
    /// Displacement of each node by muscles.
    pulls: Vec<Vector>,
    folds: Vec<Fold>,
    contraction: Vec<f64>,
    blush: f32,
    depths: PenetrationDepths,
    smoothing: Smoothing,
    /// Interpolated positions between the last two steps, from the last write.
    shown: Vec<Vector>,
    normals: Vec<Vector>,
}

impl Network {
    /// Creates the network of a face at rest with the built-in muscles.
    #[must_use]
    pub fn new(tissue: &Tissue) -> Self {
        Self::with(tissue, &Anatomy::SHIPPED)
    }

    /// Creates the network of a face at rest with the muscles of a table.
    #[must_use]
    pub fn with(tissue: &Tissue, anatomy: &Anatomy) -> Self {
        let places: Vec<Vector> = tissue.rest.iter().copied().map(vector).collect();
        let nodes = whole_fours(tissue.rest.len());
        let mut normals = vec![Vector::default(); nodes];
        normals_of(&tissue.quads, &places, &mut normals);
        let outwards = normals[..places.len()].to_vec();
        let mut holds: Vec<NodeHold> = places
            .iter()
            .zip(&outwards)
            .map(|(&place, &outwards)| NodeHold { place, outwards })
            .collect();
        holds.resize(nodes, NodeHold::default());
        let springs = Springs::new(&tissue.rest, &tissue.quads, &tissue.depth, &tissue.grip);
        Self {
            muscles: Muscles::new(tissue, anatomy),
            contacts: Contacts::new(tissue, &springs),
            springs,
            earlier: holds.clone(),
            bones: places
                .iter()
                .zip(&outwards)
                .map(|(&p, &n)| [p, n])
                .collect(),
            jaw: JawPlace::new(tissue.hinge, 0.0, 0.0, [0.0; 3]),
            gaps: vec![[0.0; 3]; tissue.columns.len()],
            pulls: vec![Vector::default(); places.len()],
            folds: Fold::all(tissue, anatomy),
            smoothing: Smoothing::new(tissue),
            shown: vec![Vector::default(); nodes],
            contraction: vec![0.0; anatomy.count()],
            blush: 0.0,
            depths: PenetrationDepths::default(),
            outwards,
            holds,
            normals,
        }
    }

    /// Resets all nodes to the positions given by `controls`, moving as from `earlier`, one step
    /// before.
    pub fn reset(&mut self, tissue: &Tissue, controls: &FaceControls, earlier: &FaceControls) {
        self.set_controls(tissue, earlier, &[]);
        self.set_controls(tissue, controls, &[]);
        self.springs.reset(&self.holds, &self.earlier);
        self.depths = self
            .contacts
            .resolve(tissue, &mut self.springs, &self.bones, &self.jaw);
        self.resolve_constraints(tissue);
    }

    /// Moves the face to its rest state under these controls.
    pub fn settle(&mut self, tissue: &Tissue, controls: &FaceControls) {
        self.reset(tissue, controls, controls);
        for _ in 0..WARM_UP_STEPS {
            self.step(tissue, controls);
        }
    }

    /// Advances by a 120th of a second, to these controls at its end.
    pub fn step(&mut self, tissue: &Tissue, controls: &FaceControls) {
        self.step_with(tissue, controls, &[]);
    }

    /// Advances the network as [`step`](Self::step) does, with contractions of muscles beyond the
    /// built-in ones, in the order of their table; missing values are 0.
    pub fn step_with(&mut self, tissue: &Tissue, controls: &FaceControls, more: &[f64]) {
        self.set_controls(tissue, controls, more);
        self.springs.step(&self.holds, &self.earlier);
        self.depths = self
            .contacts
            .resolve(tissue, &mut self.springs, &self.bones, &self.jaw);
        self.resolve_constraints(tissue);
    }

    /// Shortens overlong springs, and resolves the resulting contacts; each partly undoes the
    /// other.
    fn resolve_constraints(&mut self, tissue: &Tissue) {
        let mut turns = 0;
        while self.springs.limit() && turns < TURNS {
            self.contacts
                .resolve(tissue, &mut self.springs, &self.bones, &self.jaw);
            turns += 1;
        }
        self.springs.follow();
    }

    /// Applies the controls to muscles and jaw and computes the hold position of each node.
    fn set_controls(&mut self, tissue: &Tissue, controls: &FaceControls, more: &[f64]) {
        core::mem::swap(&mut self.holds, &mut self.earlier);
        let asked = controls.contraction.iter().chain(more).copied();
        let asked = asked.chain(core::iter::repeat(0.0));
        for (own, asked) in self.contraction.iter_mut().zip(asked) {
            *own = asked;
        }
        self.blush = controls.blush.clamp(-1.0, 1.0) as f32;
        self.muscles
            .contract(tissue, &self.contraction, controls.protrusion);
        let jaw = controls.jaw;
        let asked = [jaw.pitch_rad, jaw.yaw_rad, jaw.forward_m, jaw.down_m];
        let [pitch, yaw, forward, down]: [f64; 4] =
            core::array::from_fn(|k| asked[k].clamp(Jaw::RANGES[k][0], Jaw::RANGES[k][1]));
        let slide = [0.0, -down as f32, forward as f32];
        self.jaw = JawPlace::new(tissue.hinge, pitch, yaw, slide);
        for (i, &rest) in tissue.rest.iter().enumerate() {
            let share = tissue.jaw[i];
            let mut place = vector(rest);
            let mut outwards = self.outwards[i];
            if share > 0.0 {
                let turned = self.jaw.turned(xyz(outwards));
                place += (self.jaw.moved(rest) - place) * share;
                outwards += (turned - outwards) * share;
            }
            self.bones[i] = [place, outwards];
            let own = tissue.starts[i] as usize..tissue.starts[i + 1] as usize;
            let attachments = &tissue.attachments[own];
            if self.muscles.pull_otherwise(attachments) {
                self.pulls[i] = self.muscles.pull(attachments);
            }
            let place = place + self.pulls[i];
            self.holds[i] = NodeHold { place, outwards };
        }
        self.close(tissue, controls);
    }

    /// Closes the lips and moves the lower lip to the teeth.
    fn close(&mut self, tissue: &Tissue, controls: &FaceControls) {
        let seal = controls.seal.clamp(0.0, 1.0) as f32;
        let bite = controls.bite.clamp(0.0, 1.0) as f32;
        if seal == 0.0 && bite == 0.0 {
            return;
        }
        let press = [0.0, PRESS_M * tissue.scale, 0.0];
        for (gap, column) in self.gaps.iter_mut().zip(&tissue.columns) {
            let [above, below] = column.contact.map(usize::from);
            let off = |i: usize, k: usize| self.holds[i].place.as_array()[k] - tissue.rest[i][k];
            *gap = [0, 1, 2].map(|k| (off(above, k) - off(below, k) + press[k]) * seal);
        }
        self.move_lips(tissue, |lip| lip.closes);
        for (gap, column) in self.gaps.iter_mut().zip(&tissue.columns) {
            let lip = xyz(self.holds[usize::from(column.contact[1])].place);
            *gap = [0, 1, 2].map(|k| (column.edge[k] - lip[k]) * column.bites * bite);
        }
        // Only the lower lip moves to the teeth, all of its red by the same distance.
        self.move_lips(tissue, |lip| lip.closes.max(0.0) / LOWER_CLOSES);
        if seal > 0.0 && bite > 0.0 {
            // Between m and f the lower lip is at the teeth already, and the upper one on it.
            for (gap, column) in self.gaps.iter_mut().zip(&tissue.columns) {
                let [above, below] = column.contact.map(usize::from);
                let off = |i: usize| self.holds[i].place.as_array()[1] - tissue.rest[i][1];
                *gap = [0.0, (off(above) - off(below) + press[1]) * seal, 0.0];
            }
            self.move_lips(tissue, |lip| lip.closes.min(0.0) / (1.0 - LOWER_CLOSES));
        }
    }

    /// Moves the nodes of the lips by a share of their columns' displacement.
    fn move_lips(&mut self, tissue: &Tissue, share: impl Fn(&LipNode) -> f32) {
        for lip in &tissue.lips {
            let gap = self.gaps[usize::from(lip.column)];
            let place = &mut self.holds[usize::from(lip.node)].place;
            *place += vector(gap) * share(lip);
        }
    }

    /// Writes the state of the nodes between the last two steps, 0 the one before, 1 the last:
    /// displacement from rest, smoothed except on lips, lids and nose, rotation of the normal,
    /// wrinkles and blood. `nodes` must have an entry for every node.
    pub fn write(&mut self, tissue: &Tissue, share: f32, nodes: &mut [NodeState]) {
        let steps = self.springs.before.iter().zip(&self.springs.places);
        for (shown, (a, b)) in self.shown.iter_mut().zip(steps) {
            *shown = *a + (*b - *a) * share;
        }
        self.smoothing.apply(&tissue.rest, &mut self.shown);
        normals_of(&tissue.quads, &self.shown, &mut self.normals);
        for (i, node) in nodes.iter_mut().enumerate() {
            node.displacement = xyz(self.shown[i] - vector(tissue.rest[i]));
            node.wrinkles = AGE_LINES.map(|share| share * tissue.lines.clamp(0.0, 1.0));
            node.blush = self.blush * tissue.flush[i];
            node.normal_delta = xyz(self.normals[i] - self.outwards[i]);
        }
        for fold in &self.folds {
            let contraction = self.contraction[fold.muscle.index()].clamp(0.0, 1.0) as f32;
            let node = &mut nodes[usize::from(fold.node)];
            let strength = &mut node.wrinkles[usize::from(fold.channel)];
            *strength = (*strength + fold.weight * contraction * fold.strength).min(1.0);
        }
    }

    /// Returns the number of point masses and the number of springs.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.outwards.len(), self.springs.count())
    }

    /// Returns the penetration depths at the end of the last step, before they were resolved.
    #[must_use]
    pub fn depths(&self) -> PenetrationDepths {
        self.depths
    }

    /// Returns the penetration depths that remain after the last step. For diagnostics: it copies
    /// the network.
    #[must_use]
    pub fn left(&self, tissue: &Tissue) -> PenetrationDepths {
        // Each kind uses its own copy, because a correction moves the others.
        let lips_m = Contacts::part_lips(tissue, &mut self.springs.clone());
        let mut springs = self.springs.clone();
        PenetrationDepths {
            lips_m,
            ..self
                .contacts
                .resolve(tissue, &mut springs, &self.bones, &self.jaw)
        }
    }

    /// Returns the largest vertical distance between the lips, beyond that at rest; metres.
    #[must_use]
    pub fn lips_apart_m(&self, tissue: &Tissue) -> f32 {
        let apart = |c: &Column| {
            let [above, below] = c.contact.map(usize::from);
            let height = |i: usize| self.springs.places[i].as_array()[1];
            let now = height(above) - height(below);
            now - (tissue.rest[above][1] - tissue.rest[below][1])
        };
        tissue.columns.iter().map(apart).fold(0.0, f32::max)
    }

    /// Returns the distance of the lower lip from its contact with the upper teeth, in the middle;
    /// metres.
    #[must_use]
    pub fn lip_to_teeth_m(&self, tissue: &Tissue) -> f32 {
        let from_teeth = |c: &Column| {
            let lip = xyz(self.springs.places[usize::from(c.contact[1])]);
            let way = [0, 1, 2].map(|k| lip[k] - c.edge[k]);
            (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt()
        };
        let middle = tissue.columns.iter().filter(|c| c.bites > 0.99);
        middle.map(from_teeth).fold(0.0, f32::max)
    }

    /// Returns the position of the bone under a node, moved by the jaw, in the axes of the figure
    /// at rest; `None` under the lips, where there are teeth.
    #[must_use]
    pub fn bone_under(&self, tissue: &Tissue, node: usize) -> Option<[f32; 3]> {
        let [place, outwards] = self.bones.get(node)?.map(xyz);
        let depth = self
            .contacts
            .is_over_bone(node)
            .then_some(tissue.depth[node])?;
        Some([0, 1, 2].map(|k| place[k] - depth * outwards[k]))
    }

    /// Returns the speed of the fastest node, m/s.
    #[must_use]
    pub fn fastest_m_per_s(&self) -> f32 {
        self.springs.fastest()
    }

    /// Returns the largest stretch of an edge or diagonal of the skin, relative to its rest length.
    #[must_use]
    pub fn most_stretched_edge(&self) -> f32 {
        self.springs.most_stretched()
    }

    /// Returns the current position of a node, bind pose, metres.
    #[must_use]
    pub fn place(&self, node: usize) -> [f32; 3] {
        xyz(self.springs.places[node])
    }

    /// Returns the current position of a point of a fibre ([`Tissue::points`]), bind pose, metres.
    #[must_use]
    pub fn fibre_place(&self, tissue: &Tissue, point: usize) -> [f32; 3] {
        let (p, moved) = (&tissue.points[point], self.muscles.moved[point]);
        let with_jaw = xyz(self.jaw.moved(p.rest));
        [0, 1, 2].map(|k| p.rest[k] + (with_jaw[k] - p.rest[k]) * p.jaw + moved[k])
    }

    /// Returns the current contraction of a muscle, 0 to 1.
    #[must_use]
    pub fn contraction(&self, muscle: Muscle) -> f64 {
        let own = self.contraction.get(muscle.index());
        own.map_or(0.0, |own| own.clamp(0.0, 1.0))
    }

    /// Returns the number of simulation steps per second.
    #[must_use]
    pub fn steps_per_s() -> f64 {
        f64::from(STEPS_PER_S)
    }
}

/// Computes the unit normals of nodes, weighted by the area of the adjacent faces.
fn normals_of(quads: &[[u16; 4]], places: &[Vector], normals: &mut [Vector]) {
    normals.fill(Vector::default());
    for quad in quads {
        let [a, b, c, d] = quad.map(|i| places[usize::from(i)]);
        let (u, v) = (xyz(c - a), xyz(d - b));
        let area = vector([
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ]);
        for i in quad {
            normals[usize::from(*i)] += area;
        }
    }
    for normals in normals.as_chunks_mut::<LANES>().0 {
        let lengths = squares(*normals).sqrt().fast_max(Vector::splat(1e-12));
        let lengths = lengths.to_array();
        for k in 0..LANES {
            normals[k] /= lengths[k];
        }
    }
}

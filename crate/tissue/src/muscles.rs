//! Muscle deformation: the motion of the points of muscle fibres (F&H section 3.1.2, "Muscle
//! Deformation").

use core::ops::Range;

use super::cord;
use super::junction::{Junctions, own_share};
use super::lanes::{Vector, vector};
use super::tissue::{Attachment, Fibre, FibreCurve, FibrePoint, Tissue};
use super::{Anatomy, Muscle};

use Muscle as M;

/// Forward movement of the vermilion at full protrusion, and of the outermost fibres; and backward
/// movement at full retraction. Millimetres on the reference head. Designed.
const FORWARD_MM: [f32; 2] = [8.0, 4.0];
const BACK_MM: [f32; 2] = [3.2, 0.8];
/// Additional forward movement of the corners, because the ring gets shorter.
const CORNER_FORWARD_MM: f32 = 2.4;
/// Outward roll of protruding lips and inward roll of retracted ones.
const ROLL_MM: f32 = 0.9;
/// Additional movement of the vermilion border towards the other lip, relative to the edge, when
/// lips roll in: they look thinner (AU 23, 24 and 28 of FACS). Designed.
const THIN_MM: f32 = 2.2;

/// Thickness of a mimic muscle, by which stretching thins it: millimetres on the reference head.
/// Designed, within the 1 to 4 mm that ultrasound shows of them.
const THICK_MM: f32 = 2.5;

/// Muscles of a face and the movement of their fibres under the current contractions.
#[derive(Clone, Debug)]
pub(super) struct Muscles {
    /// Middle of the mouth at rest.
    mouth: [f32; 3],
    /// Half the width of the mouth, metres.
    half_width: f32,
    junctions: Junctions,
    /// Shortening and bulge, metres, of each fibre's muscle.
    mechanics: Vec<(f32, f32)>,
    /// Displacement of each point of a fibre, without the jaw.
    pub(super) moved: Vec<[f32; 3]>,
    /// Share of the displacement caused by the point's own muscle, 0 to 1; the rest is passive.
    pub(super) own: Vec<f32>,
    segments: Vec<Segment>,
    /// Strength with which each point holds the position given by its own muscle, 0 to 1.
    tension: Vec<f32>,
    /// Displacement of the points by their own muscles.
    asked: Vec<[f32; 3]>,
    /// Rows of one fibre's spreading.
    rows: Vec<([f32; 3], f32)>,
    /// Positions of the points of one fibre.
    scratch: Vec<[f32; 3]>,
}

/// Movement of a fibre from one of its points to the next.
#[derive(Clone, Copy, Debug, Default)]
struct Segment {
    /// Movement of the point.
    start: Vector,
    /// Difference from the movement of this point to the movement of the next.
    way: Vector,
    /// Value of [`Muscles::own`] for the point.
    own: f32,
    /// True if the last contraction changed it.
    is_new: bool,
}

impl Segment {
    fn set(&mut self, start: [f32; 3], end: [f32; 3], own: f32) {
        let before = (self.start, self.way, self.own);
        let bits = |(a, b, own): (Vector, Vector, f32)| {
            (
                a.to_array().map(f32::to_bits),
                b.to_array().map(f32::to_bits),
                own.to_bits(),
            )
        };
        self.start = vector(start);
        self.way = vector(end) - self.start;
        self.own = own;
        self.is_new = bits(before) != bits((self.start, self.way, self.own));
    }
}

fn add(a: &mut [f32; 3], b: [f32; 3], share: f32) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += b * share;
    }
}

fn plus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

impl Muscles {
    pub(super) fn new(tissue: &Tissue, anatomy: &Anatomy) -> Self {
        let mut low = [f32::MAX; 3];
        let mut high = [f32::MIN; 3];
        for fibre in &tissue.fibres {
            if matches!(fibre.course, FibreCurve::Oris { out, .. } if out <= 0.0) {
                for point in points_of(tissue, fibre) {
                    for k in 0..3 {
                        low[k] = low[k].min(point.rest[k]);
                        high[k] = high[k].max(point.rest[k]);
                    }
                }
            }
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 3], [0.0; 3]);
        }
        Self {
            mouth: core::array::from_fn(|k| 0.5 * (low[k] + high[k])),
            half_width: (0.5 * (high[0] - low[0])).max(1e-3),
            junctions: Junctions::new(tissue),
            mechanics: tissue
                .fibres
                .iter()
                .map(|f| anatomy.mechanics(f.muscle))
                .collect(),
            moved: vec![[0.0; 3]; tissue.points.len()],
            own: vec![1.0; tissue.points.len()],
            asked: vec![[0.0; 3]; tissue.points.len()],
            rows: Vec::with_capacity(usize::from(u8::MAX)),
            segments: vec![Segment::default(); tissue.points.len()],
            tension: vec![0.0; tissue.points.len()],
            scratch: Vec::with_capacity(usize::from(u8::MAX)),
        }
    }

    /// Moves the points by contractions, indexed by muscle, and by the protrusion of both lips.
    /// Values out of range are clamped.
    ///
    /// First, every muscle moves according to its own contraction. Then connected fibres settle
    /// between the positions that their members require, and linear muscles extend from their
    /// origins to the settled positions (F&H section 3.1.2, "Muscle Deformation"). The result does
    /// not depend on the order of fibres and links, or on earlier controls.
    pub(super) fn contract(&mut self, tissue: &Tissue, contraction: &[f64], protrusion: [f64; 2]) {
        let of = |muscle: Muscle| {
            let asked = contraction.get(muscle.index());
            asked.map_or(0.0, |asked| asked.clamp(0.0, 1.0) as f32)
        };
        let lips = Lips {
            contraction: [M::OrbicularisOrisUpper, M::OrbicularisOrisLower].map(of),
            protrusion: protrusion.map(|p| p.clamp(-1.0, 1.0) as f32),
        };
        for (k, fibre) in tissue.fibres.iter().enumerate() {
            self.ask(tissue, k, of(fibre.muscle), &lips);
        }
        self.asked.copy_from_slice(&self.moved);
        self.junctions.relax(&self.tension, &mut self.moved);
        for fibre in &tissue.fibres {
            if let FibreCurve::Oris { out, .. } = fibre.course {
                let own = range_of(fibre);
                cord::spread(
                    &self.asked[own.clone()],
                    &mut self.moved[own],
                    &mut self.rows,
                );
                self.thin_out(tissue, fibre, out);
            }
        }
        for (k, fibre) in tissue.fibres.iter().enumerate() {
            if fibre.course == FibreCurve::Linear {
                self.reach(tissue, k, of(fibre.muscle));
            }
        }
        for (k, segment) in self.segments.iter_mut().enumerate() {
            let next = (k + 1).min(self.moved.len() - 1);
            segment.set(self.moved[k], self.moved[next], self.own[k]);
        }
    }

    /// Returns true if the last contraction changed the movement of these attachments.
    pub(super) fn pull_otherwise(&self, attachments: &[Attachment]) -> bool {
        let mut points = attachments.iter().map(|hold| usize::from(hold.point));
        points.any(|point| self.segments[point].is_new)
    }

    /// Returns the displacement of the skin at these attachments. Active movements add up; passive
    /// movement fills only the remaining share, otherwise connected fibres would each add the same
    /// movement.
    pub(super) fn pull(&self, attachments: &[Attachment]) -> Vector {
        let (mut by, mut done) = (Vector::default(), Vector::default());
        let (mut pulling, mut following) = (0.0, 0.0);
        for hold in attachments {
            let segment = &self.segments[usize::from(hold.point)];
            let own = segment.own * hold.weight;
            let rest = hold.weight - own;
            let moved = segment.start + segment.way * hold.on;
            by += moved * own;
            done += moved * rest;
            pulling += own;
            following += rest;
        }
        if following > 1e-6 {
            let share = following.min((1.0 - pulling).max(0.0)) / following;
            by += done * share;
        }
        by
    }

    /// Moves the points of a fibre to where its own muscle wants them.
    fn ask(&mut self, tissue: &Tissue, k: usize, contraction: f32, lips: &Lips) {
        let (fibre, (shortens, bulges)) = (&tissue.fibres[k], self.mechanics[k]);
        let own = range_of(fibre);
        let (moved, tension) = (&mut self.moved[own.clone()], &mut self.tension[own]);
        let points = points_of(tissue, fibre);
        tension.fill(contraction);
        self.own[range_of(fibre)].fill(match fibre.course {
            FibreCurve::Oris { .. } => 1.0,
            FibreCurve::Linear | FibreCurve::Towards(_) => own_share(contraction),
        });
        match fibre.course {
            FibreCurve::Linear => along_course(points, contraction * shortens, moved),
            FibreCurve::Towards(centre) => {
                for (point, moved) in points.iter().zip(moved) {
                    let way = subtract(centre, point.rest);
                    *moved = way.map(|x| x * contraction * shortens);
                    add(moved, point.outwards, contraction * bulges * tissue.scale);
                }
            }
            FibreCurve::Oris { is_lower, out } => {
                for ((point, moved), tension) in points.iter().zip(moved).zip(tension) {
                    let aside =
                        ((point.rest[0] - self.mouth[0]) / self.half_width).clamp(-1.0, 1.0);
                    let [contraction, protrusion] = lips.displacement(is_lower, aside);
                    *tension = contraction.max(protrusion.abs());
                    let lip = Lip {
                        contraction: contraction * shortens,
                        protrusion,
                        bulge: contraction * bulges * tissue.scale,
                        down: if is_lower { -1.0 } else { 1.0 },
                        out,
                        corner: aside * aside,
                    };
                    *moved = lip.moved(
                        subtract(point.rest, self.mouth),
                        point.outwards,
                        tissue.scale,
                    );
                }
            }
        }
    }

    /// Stretches a linear fibre from its origin to its moved end, with a bulge by its contraction
    /// and thinning by its stretch.
    fn reach(&mut self, tissue: &Tissue, k: usize, contraction: f32) {
        let (fibre, (shortens, bulges)) = (&tissue.fibres[k], self.mechanics[k]);
        let own = range_of(fibre);
        let points = points_of(tissue, fibre);
        let end = self.junctions.end(own.end - 1, contraction, &self.moved);
        let moved = &mut self.moved[own.clone()];
        let mut thinner = 0.0;
        if let Some((end, pulled)) = end {
            let asked = length_of(points, |k| points[k].rest) * (1.0 - contraction * shortens);
            let longer = stretched(points, asked, end, moved, &mut self.scratch);
            thinner = thinning(longer) * tissue.scale;
            self.own[own].fill(pulled);
        }
        let thicker = contraction * bulges * tissue.scale - thinner;
        let last = (points.len() - 1) as f32;
        for (k, (point, moved)) in points.iter().zip(moved).enumerate() {
            let t = k as f32 / last;
            add(moved, point.outwards, thicker * 4.0 * t * (1.0 - t));
        }
    }

    /// Thins a fibre of the ring uniformly by its elongation under other muscles.
    fn thin_out(&mut self, tissue: &Tissue, fibre: &Fibre, out: f32) {
        let points = points_of(tissue, fibre);
        let moved = &mut self.moved[range_of(fibre)];
        let rest = length_of(points, |k| points[k].rest);
        let now = length_of(points, |k| plus(points[k].rest, moved[k]));
        let thinner = thinning(now / rest.max(1e-6)) * tissue.scale * (1.0 - out);
        if thinner == 0.0 {
            return;
        }
        for (point, moved) in points.iter().zip(moved) {
            // At the corners, the halves of the ring meet and face away from each other.
            let aside = ((point.rest[0] - self.mouth[0]) / self.half_width).clamp(-1.0, 1.0);
            add(moved, point.outwards, -thinner * (1.0 - aside * aside));
        }
    }
}

fn range_of(fibre: &Fibre) -> Range<usize> {
    let first = usize::from(fibre.first);
    first..first + usize::from(fibre.count)
}

fn points_of<'a>(tissue: &'a Tissue, fibre: &Fibre) -> &'a [FibrePoint] {
    &tissue.points[range_of(fibre)]
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let d = subtract(b, a);
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}

/// Returns the length of a fibre with points at these positions.
fn length_of(points: &[FibrePoint], at: impl Fn(usize) -> [f32; 3]) -> f32 {
    (1..points.len()).map(|k| distance(at(k - 1), at(k))).sum()
}

/// Returns the thinning of a muscle that is `longer` than by itself, metres on the reference head:
/// its volume is preserved.
fn thinning(longer: f32) -> f32 {
    if longer > 1.0 {
        THICK_MM * 1e-3 * (1.0 - 1.0 / longer.sqrt())
    } else {
        0.0
    }
}

/// Points go along the fibre's course towards its first by a share of its length.
fn along_course(points: &[FibrePoint], shorter: f32, moved: &mut [[f32; 3]]) {
    let last = points.len() - 1;
    for (k, moved) in moved.iter_mut().enumerate() {
        let at = k as f32 * (1.0 - shorter);
        let before = (at as usize).min(last - 1);
        let on = at - before as f32;
        let (a, b) = (points[before].rest, points[before + 1].rest);
        *moved = core::array::from_fn(|c| a[c] + (b[c] - a[c]) * on - points[k].rest[c]);
    }
}

/// Moves the points of a linear fibre from the positions wanted by its muscle, with length `asked`,
/// so that it starts at its origin and its last point has moved by `end`. A slack fibre leaves its
/// course and straightens before it stretches; its segments keep their proportions. Returns the
/// length relative to `asked`.
fn stretched(
    points: &[FibrePoint],
    asked: f32,
    end: [f32; 3],
    moved: &mut [[f32; 3]],
    places: &mut Vec<[f32; 3]>,
) -> f32 {
    let last = points.len() - 1;
    let off = subtract(end, moved[last]);
    let origin = points[0].rest;
    let to = plus(points[last].rest, end);
    let along = |k: usize| k as f32 / last as f32;
    places.clear();
    places.extend((0..=last).map(|k| {
        let place = plus(points[k].rest, moved[k]);
        [0, 1, 2].map(|c| place[c] + off[c] * along(k))
    }));
    let (curved, straight) = (length_of(points, |k| places[k]), distance(origin, to));
    let slack = (curved - straight).max(1e-6);
    let straight_share = ((curved - asked) / slack).clamp(0.0, 1.0);
    for (k, place) in places.iter_mut().enumerate() {
        for c in 0..3 {
            let line = origin[c] + (to[c] - origin[c]) * along(k);
            place[c] += (line - place[c]) * straight_share;
        }
    }
    let now = length_of(points, |k| places[k]);
    let rest = length_of(points, |k| points[k].rest);
    let scale = now / rest.max(1e-6);
    // Along the current fibre, at the same shares of the length as at rest.
    let (mut wanted, mut before, mut passed) = (0.0, 0, 0.0);
    for k in 1..last {
        wanted += distance(points[k - 1].rest, points[k].rest) * scale;
        let mut piece = distance(places[before], places[before + 1]);
        while passed + piece < wanted && before + 2 <= last {
            passed += piece;
            before += 1;
            piece = distance(places[before], places[before + 1]);
        }
        let on = ((wanted - passed) / piece.max(1e-9)).min(1.0);
        let (a, b) = (places[before], places[before + 1]);
        moved[k] = [0, 1, 2].map(|c| a[c] + (b[c] - a[c]) * on - points[k].rest[c]);
    }
    moved[0] = [0.0; 3];
    moved[last] = end;
    now / asked.max(1e-6)
}

/// Controls of both lips, upper and lower.
struct Lips {
    contraction: [f32; 2],
    protrusion: [f32; 2],
}

impl Lips {
    /// Returns contraction and protrusion at a position from the right corner, −1, to the left, 1.
    fn displacement(&self, is_lower: bool, aside: f32) -> [f32; 2] {
        let (own, other) = if is_lower { (1, 0) } else { (0, 1) };
        // At the corner the halves of the ring are one.
        let shared = 0.5 * aside * aside * aside * aside;
        [self.contraction, self.protrusion].map(|v| v[own] + (v[other] - v[own]) * shared)
    }
}

/// The ring of the mouth at one of its points.
struct Lip {
    contraction: f32,
    protrusion: f32,
    bulge: f32,
    /// 1 in the upper lip, −1 in the lower.
    down: f32,
    out: f32,
    corner: f32,
}

impl Lip {
    /// Returns the displacement; `from` is the vector from the middle of the mouth.
    fn moved(&self, from: [f32; 3], outwards: [f32; 3], scale: f32) -> [f32; 3] {
        let c = self.contraction * (1.0 - 0.45 * self.out);
        let mm = 1e-3 * scale;
        let between = |[inner, outer]: [f32; 2]| inner + (outer - inner) * self.out;
        let forth = self.protrusion.max(0.0);
        let back = (-self.protrusion).max(0.0);
        let free = 1.0 - self.corner;
        let border = 4.0 * self.out * (1.0 - self.out);
        let roll = ROLL_MM * (1.0 - self.out) * self.protrusion - THIN_MM * border * back;
        let roll = roll * mm * free * self.down;
        let forward = between(FORWARD_MM) + CORNER_FORWARD_MM * self.corner;
        let mut moved = [
            -c * from[0] + 0.05 * back * from[0],
            -0.25 * c * from[1] + roll,
            (forth * forward - back * between(BACK_MM) * free) * mm,
        ];
        add(&mut moved, outwards, self.bulge * (1.0 - self.out));
        moved
    }
}

#[cfg(test)]
mod tests;

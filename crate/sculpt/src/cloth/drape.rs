//! Position-based drape (Müller et al. 2007, doi:10.1016/j.jvcir.2007.01.005) against the body's
//! field.

use std::collections::{BTreeMap, BTreeSet};

use raconteur_base::{DVec3, noise};

use crate::subdivide::edge_faces;
use crate::torso::{CM, Field, Regions, Shell};

/// Parameters of the cloth simulation that drapes a garment: steps, gravity and collision regions;
/// lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct DrapeParams {
    /// Number of simulation steps.
    pub steps: usize,
    /// Sweeps over all links a step.
    pub sweeps: usize,
    /// Fall a step², metres.
    pub gravity: f64,
    /// Body regions that the cloth collides with.
    pub regions: Regions,
    /// Seed of the first disturbance and of the order of links.
    pub seed: u64,
}

impl Default for DrapeParams {
    fn default() -> Self {
        Self {
            steps: 40,
            sweeps: 8,
            gravity: 8e-5,
            regions: Regions::ALL,
            seed: 1,
        }
    }
}

/// State of a garment while it is draped on the body.
#[derive(Clone, Debug)]
pub struct Draping {
    /// Cloth surface in its present state.
    pub shell: Shell,
    /// Positions whose distances are the cloth's rest lengths.
    pub rest: Vec<DVec3>,
    /// 0 free to 1 fixed.
    pub pin: Vec<f64>,
}

/// Distance constraint between two points.
struct Link {
    a: u32,
    b: u32,
    rest: f64,
    stiffness: f64,
    /// Bending links resist only shortening.
    one_sided: bool,
}

fn links(cloth: &Draping, seed: u64) -> Vec<Link> {
    let faces = &cloth.shell.faces;
    let span = |a: u32, b: u32| cloth.rest[a as usize].distance(cloth.rest[b as usize]);
    let mut out = Vec::new();
    let edges = edge_faces(faces);
    for &(a, b) in edges.keys() {
        out.push(Link {
            a,
            b,
            rest: span(a, b),
            stiffness: 0.9,
            one_sided: false,
        });
    }
    for f in faces {
        for (a, b) in [(f[0], f[2]), (f[1], f[3])] {
            out.push(Link {
                a,
                b,
                rest: span(a, b),
                stiffness: 0.35,
                one_sided: false,
            });
        }
    }
    for (a, b) in bends(faces, &edges) {
        out.push(Link {
            a,
            b,
            rest: span(a, b) * 0.97,
            stiffness: 0.25,
            one_sided: true,
        });
    }
    // A random order prevents a drift of the sweeps.
    let mut order: Vec<(u64, usize)> = (0..out.len())
        .map(|i| (noise::hash(seed, 1, i as i64), i))
        .collect();
    order.sort_unstable();
    let mut shuffled: Vec<Option<Link>> = out.into_iter().map(Some).collect();
    order
        .into_iter()
        .filter_map(|(_, i)| shuffled[i].take())
        .collect()
}

/// Points two apart across each edge.
fn bends(faces: &[Vec<u32>], edges: &BTreeMap<(u32, u32), Vec<u32>>) -> BTreeSet<(u32, u32)> {
    let mut out = BTreeSet::new();
    // The neighbour of `v` in face `f` that is not `other`.
    let beyond = |f: u32, v: u32, other: u32| {
        let face = &faces[f as usize];
        let at = face.iter().position(|&x| x == v).unwrap_or(0);
        let n = face.len();
        let (next, before) = (face[(at + 1) % n], face[(at + n - 1) % n]);
        if next == other { before } else { next }
    };
    for (&(a, b), sides) in edges {
        if let [f, g] = sides[..] {
            for (v, w) in [(a, b), (b, a)] {
                let (p, q) = (beyond(f, v, w), beyond(g, v, w));
                out.insert((p.min(q), p.max(q)));
            }
        }
    }
    out
}

fn sweep(points: &mut [DVec3], links: &[Link], free: &[f64]) {
    for l in links {
        let (a, b) = (l.a as usize, l.b as usize);
        let share = free[a] + free[b];
        if share == 0.0 {
            continue;
        }
        let d = points[b] - points[a];
        let length = d.length() + 1e-11;
        if l.one_sided && length > l.rest {
            continue;
        }
        let move_by = d * (l.stiffness * (length - l.rest) / length / share);
        points[a] += move_by * free[a];
        points[b] -= move_by * free[b];
    }
}

/// Pushes the points outside the body by `thickness`; contact adds some friction.
fn collide(
    points: &mut [DVec3],
    before: Option<&[DVec3]>,
    thickness: &[f64],
    field: &Field,
    regions: Regions,
) {
    for (v, p) in points.iter_mut().enumerate() {
        // The value overestimates the distance nowhere by more than this.
        if field.value(*p, regions, 1.0) > thickness[v] * 1.6 {
            continue;
        }
        let (d, n) = field.value_and_normal(*p, regions, 1.0);
        if d >= thickness[v] {
            continue;
        }
        *p += n * (thickness[v] - d).min(if before.is_some() { 1.5 * CM } else { 3.0 * CM });
        if let Some(before) = before {
            let normal_part = n * (*p - before[v]).dot(n);
            *p = *p * 0.55 + (before[v] + normal_part) * 0.45;
        }
    }
}

/// Drapes the cloth; `thickness` is its distance from the body at a point.
pub fn drape(
    cloth: &mut Draping,
    p: &DrapeParams,
    field: &Field,
    thickness: &impl Fn(DVec3) -> f64,
) {
    let links = links(cloth, p.seed);
    let free: Vec<f64> = cloth.pin.iter().map(|x| 1.0 - x).collect();
    let points = &mut cloth.shell.points;
    let thick: Vec<f64> = points.iter().map(|q| thickness(*q)).collect();
    // A little disorder starts the folds.
    for (v, q) in points.iter_mut().enumerate() {
        let jitter = [2, 3, 4].map(|id| noise::signed(p.seed, id, v as i64));
        *q += DVec3::from_array(jitter) * 0.08 * CM * free[v];
    }
    let mut before = points.clone();
    for _ in 0..p.steps {
        for ((q, last), free) in points.iter_mut().zip(&mut before).zip(&free) {
            let velocity = (*q - *last) * 0.88;
            *last = *q;
            *q += velocity * *free;
            q.y -= p.gravity * free;
        }
        for _ in 0..p.sweeps {
            sweep(points, &links, &free);
        }
        collide(points, Some(&before), &thick, field, p.regions);
    }
    for _ in 0..3 {
        collide(points, None, &thick, field, p.regions);
    }
}

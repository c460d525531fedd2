//! Grows strands from their roots and gathers them into locks.

use raconteur_base::curve::{lerp, ramp, smooth};
use raconteur_base::{DVec3, noise, ops};

use super::HairParams;
use super::card::Strand;
use super::colour::Palette;
use super::cut::{Cut, Layer, Where, slope};
use super::ground::Ground;
use super::roots::roots;
use crate::head::{Head, ScalpPoint};

/// Length of a step, metres on the common head.
const STEP: f64 = 0.004;
/// Most steps of a strand.
const LONGEST: usize = 120;
/// Least height of any hair above the skin, metres.
pub(super) const CLEAR: f64 = 0.0012;

/// A path in fine steps.
struct Path {
    curve: Vec<DVec3>,
    normals: Vec<DVec3>,
}

/// A lock: where it is rooted and the way its middle goes.
struct Lock {
    root: DVec3,
    path: Path,
}

/// All strands of a style, from the scalp outwards.
pub(super) fn strands(
    head: &Head,
    p: &HairParams,
    cut: &dyn Cut,
    cover: &[f64],
    ground: &Ground<'_>,
    palette: &Palette,
) -> Vec<Strand> {
    let locks = locks(head, p, cut, cover, ground);
    let mut out = Vec::new();
    for (l, layer) in cut.layers().iter().enumerate() {
        for (i, root) in roots(head, cut, cover, layer, p.seed, l as u64)
            .into_iter()
            .enumerate()
        {
            let id = (l * 1000 + i) as i64;
            out.extend(strand(p, cut, ground, layer, &locks, palette, root, id));
        }
    }
    for (i, coil) in cut.extra().into_iter().enumerate() {
        let id = (900_000 + i) as i64;
        out.push(Strand {
            width: coil.width * ground.size(),
            curve: coil.curve.iter().map(|c| uncommon(head, *c)).collect(),
            normals: coil.normals,
            root: 0.8,
            tip: 0.8,
            weave: super::cut::Weave::Dense,
            dice: noise::unit(p.seed, 77, id),
            colour: palette.lock(p.seed, id, 0.12),
            open: [0.6, 0.9],
        });
    }
    out
}

/// The place on this head that answers to one on the common head.
fn uncommon(head: &Head, c: DVec3) -> DVec3 {
    let q = head.scalp.proportions.common(c);
    // The map is linear in each octant, so its inverse scales the other way.
    let back = |c: f64, q: f64| if q == 0.0 { c } else { c * c / q };
    DVec3::new(back(c.x, q.x), back(c.y, q.y), back(c.z, q.z))
}

/// Middles of the locks, spread over the scalp.
fn locks(
    head: &Head,
    p: &HairParams,
    cut: &dyn Cut,
    cover: &[f64],
    ground: &Ground<'_>,
) -> Vec<Lock> {
    let wanted = cut.locks();
    let layer = Layer {
        cards: wanted.count,
        height: 0.008,
        ..super::cut::LAYER
    };
    roots(head, cut, cover, &layer, p.seed, 60)
        .into_iter()
        .enumerate()
        .map(|(i, root)| Lock {
            root: root.position,
            path: grow(p, cut, ground, &layer, &root, lock_turn(p, cut, i)),
        })
        .collect()
}

/// The turn of lock `i` against the combing, as a tangent.
fn lock_turn(p: &HairParams, cut: &dyn Cut, i: usize) -> f64 {
    cut.locks().unruly * noise::signed(p.seed, 61, i as i64)
}

fn nearest(locks: &[Lock], at: DVec3) -> Option<usize> {
    (0..locks.len()).min_by(|&a, &b| {
        let d = |i: usize| locks[i].root.distance_squared(at);
        d(a).total_cmp(&d(b))
    })
}

/// Follows the combing from a root until the hair is cut, meets an ear or has its length.
fn grow(
    p: &HairParams,
    cut: &dyn Cut,
    ground: &Ground<'_>,
    layer: &Layer,
    root: &ScalpPoint,
    turn: f64,
) -> Path {
    let size = ground.size();
    let from = ground.common(root.position);
    let full = cut.length(from) * p.length * layer.length;
    let length = full.min(layer.longest);
    let steps = ((length / STEP) as usize).clamp(3, LONGEST);
    let step = length / steps as f64 * size;
    let wish = cut.comb(from);
    let flat = |d: DVec3, n: DVec3| (d - n * d.dot(n)).try_normalize();
    let along = flat(wish, root.normal).unwrap_or(DVec3::NEG_Y);
    let aside = root.normal.cross(along);
    let mut direction = (along + aside * turn + root.normal * cut.lift(from)).normalize();
    let over_ear = cut.over_ear(from);
    let mut at = root.position - root.normal * 0.0005;
    let mut normal = root.normal;
    let mut path = Path {
        curve: vec![at],
        normals: vec![normal],
    };
    let per_cm = step / size / 0.01;
    for i in 1..=steps {
        let arc = i as f64 * step / size;
        let here = ground.common(at);
        direction = (direction + cut.bend(here, from, arc / full) * per_cm).normalize();
        let bump = if over_ear { ground.over_ear(at) } else { 0.0 };
        let height = CLEAR
            + layer.height
                * p.volume
                * cut.volume(here)
                * size
                * smooth(arc / (0.02 + 3.5 * layer.height))
            + bump;
        let cling = (cut.cling(here) * per_cm).min(1.0);
        let (mut next, found) = ground.settle(at + direction * step, height, cling);
        // One step goes as far as the others, or cards would bunch.
        if let Some(d) = (next - at).try_normalize() {
            next = at + d * step;
            direction = (direction * 0.5 + d * 0.5).try_normalize().unwrap_or(d);
            next = ground.settle(next, 0.7 * height, 0.0).0;
        }
        if over_ear {
            next = ground.beside_ear(next);
        } else if ground.in_ear(next) {
            break;
        }
        let here = ground.common(next);
        if cut.hem(from, here).is_some_and(|hem| here.y < hem) {
            break;
        }
        at = next;
        normal = found.unwrap_or(normal);
        path.curve.push(at);
        path.normals.push(normal);
    }
    path
}

#[allow(
    clippy::too_many_arguments,
    reason = "one strand is made of all of these"
)]
fn strand(
    p: &HairParams,
    cut: &dyn Cut,
    ground: &Ground<'_>,
    layer: &Layer,
    locks: &[Lock],
    palette: &Palette,
    mut root: ScalpPoint,
    id: i64,
) -> Option<Strand> {
    let random = |k: u64| noise::signed(p.seed, 100 + k, id);
    if layer.roots == Where::Parting {
        // Fine hair stands in a line where the hair divides.
        let off = slope(-0.05, -0.03, ground.common(root.position).z);
        let x = lerp(root.position.x, p.parting_x, 0.65 * off);
        let (q, n) = ground.settle(root.position.with_x(x), 0.0, 1.0);
        root.position = q;
        root.normal = n.unwrap_or(root.normal);
    }
    let home = nearest(locks, root.position)?;
    let own = 0.12 * cut.locks().unruly * random(5);
    let path = grow(p, cut, ground, layer, &root, lock_turn(p, cut, home) + own);
    if path.curve.len() < 4 {
        return None;
    }
    let over_ear = cut.over_ear(ground.common(root.position));
    let mut curve = gathered(&path, &locks[home], cut.locks().gather, layer.height);
    wave(
        &mut curve,
        &path.normals,
        cut.wave(),
        home,
        p.seed,
        random(2),
    );
    let mut curve = smoothed(curve);
    for c in curve.iter_mut().skip(2) {
        *c = ground.settle(*c, CLEAR + 0.25 * layer.height, 0.0).0;
        if over_ear {
            *c = ground.beside_ear(*c);
        }
    }
    if !over_ear {
        let stop = curve.iter().position(|c| ground.in_ear(*c));
        curve.truncate(stop.unwrap_or(curve.len()));
        if curve.len() < 4 {
            return None;
        }
    }
    let (curve, normals) = thinned(&curve, &path.normals[..curve.len()], layer.spans);
    let full = layer.roots == Where::All;
    // Where hair begins to thin, its deep layers lie open and must not show as dark bars.
    let dense = slope(0.55, 1.0, root.density);
    Some(Strand {
        curve,
        normals,
        width: layer.width * lerp(0.55, 1.0, dense) * ground.size() * (1.0 + 0.25 * random(3)),
        // At the line a broad root would be seen as a blunt end on the bare skin.
        root: if layer.roots == Where::Hairline {
            0.15
        } else {
            lerp(0.12, 0.5, dense)
        },
        tip: if full { 0.62 } else { 0.4 },
        weave: layer.weave,
        dice: noise::unit(p.seed, 111, id),
        colour: palette.lock(p.seed, id, 0.07),
        open: layer.open.map(|o| lerp(0.9, o, dense)),
    })
}

/// Draws the far part of a path to its lock.
fn gathered(path: &Path, lock: &Lock, gather: f64, height: f64) -> Vec<DVec3> {
    let last = path.curve.len() - 1;
    path.curve
        .iter()
        .enumerate()
        .map(|(i, &c)| {
            let t = i as f64 / last as f64;
            let middle = lock.path.curve[i.min(lock.path.curve.len() - 1)];
            let to = middle - c;
            // What lies far apart is parted hair and stays so; depth stays too.
            let n = path.normals[i];
            let across = to - n * to.dot(n) * 0.8;
            let near = 1.0 - ramp(0.018, 0.032, to.length());
            c + across * (gather * near * smooth((t - 0.15) / 0.85)) + n * (0.1 * height * t)
        })
        .collect()
}

fn smoothed(mut curve: Vec<DVec3>) -> Vec<DVec3> {
    for _ in 0..3 {
        let before = curve.clone();
        for i in 1..before.len() - 1 {
            curve[i] = before[i] * 0.5 + (before[i - 1] + before[i + 1]) * 0.25;
        }
    }
    curve
}

/// The path at the card's own points: closer together near the root, where hair bends.
fn thinned(curve: &[DVec3], normals: &[DVec3], spans: usize) -> (Vec<DVec3>, Vec<DVec3>) {
    let last = curve.len() - 1;
    (0..=spans)
        .map(|i| {
            let t = ops::pow(i as f64 / spans as f64, 1.5) * last as f64;
            let k = (t as usize).min(last - 1);
            let f = t - k as f64;
            let n = normals[k].lerp(normals[k + 1], f);
            (
                curve[k].lerp(curve[k + 1], f),
                n.try_normalize().unwrap_or(normals[k]),
            )
        })
        .unzip()
}

/// Waves, in step within a lock.
fn wave(curve: &mut [DVec3], normals: &[DVec3], width: f64, lock: usize, seed: u64, random: f64) {
    if width <= 0.0 {
        return;
    }
    let phase = core::f64::consts::PI * noise::signed(seed, 71, lock as i64) + 0.35 * random;
    let pace = 0.085 * (1.0 + 0.2 * noise::signed(seed, 72, lock as i64));
    let straight = curve.to_vec();
    let n = straight.len();
    let mut arc = 0.0;
    for i in 1..n {
        arc += straight[i].distance(straight[i - 1]);
        let along = (straight[(i + 1).min(n - 1)] - straight[i - 1]).normalize_or_zero();
        let side = along.cross(normals[i]).normalize_or_zero();
        let amount = width * ramp(0.04, 0.15, arc);
        let turn = arc / pace * core::f64::consts::TAU + phase;
        curve[i] +=
            side * (amount * ops::sin(turn)) + normals[i] * (amount * 0.6 * (ops::cos(turn) + 0.6));
    }
}

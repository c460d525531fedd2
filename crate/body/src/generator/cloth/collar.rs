//! What lies round the neck: a shirt's collar and a hood that hangs down.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, ops};

use super::fade;
use super::strip::Lay;
use super::wearer::Wearer;
use crate::generator::torso::{CM, Field, Regions, Shell};
use crate::skeleton::Bone;

/// Rows of rings joined by quads; weights from the body below.
fn loft(
    rows: &[Vec<DVec3>],
    wearer: &Wearer<'_>,
    round: bool,
    outwards: impl Fn(DVec3) -> DVec3,
) -> Shell {
    let body = Lay::new(&wearer.cage.shell);
    let mut out = Shell::default();
    for p in rows.iter().flatten() {
        out.points.push(*p);
        out.weights.push(body.at(*p).weights);
    }
    let m = rows.first().map_or(0, Vec::len);
    let at = |i: usize, k: usize| (i * m + k % m) as u32;
    for i in 0..rows.len().saturating_sub(1) {
        for k in 0..if round { m } else { m - 1 } {
            out.faces
                .push(vec![at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    let agree: f64 = out
        .normals()
        .iter()
        .zip(&out.points)
        .map(|(n, p)| n.dot(outwards(*p)))
        .sum();
    if agree < 0.0 {
        for face in &mut out.faces {
            face.reverse();
        }
    }
    out
}

/// Keeps a point at least `off` metres from the body.
fn keep_off(field: &Field, p: &mut DVec3, off: f64) {
    for _ in 0..3 {
        let (d, n) = field.value_and_normal(*p, Regions::ALL, 1.1);
        *p += n * (off - d).clamp(0.0, 3.0 * CM);
    }
}

/// A shirt's collar, buttoned: stand, fold and a fall with points, as one closed profile.
#[must_use]
pub fn shirt_collar(wearer: &Wearer<'_>) -> Shell {
    const STATIONS: usize = 37;
    /// Degrees from the middle where the collar's ends stand.
    const GAP: f64 = 5.0;
    /// (how far down the fall, distance outwards in cm, least distance from the body in cm)
    const FALL: [(f64, f64, f64); 6] = [
        (0.25, 1.05, 0.0),
        (0.55, 1.55, 1.55),
        (0.85, 2.05, 1.8),
        (1.0, 2.25, 1.75),
        (0.96, 1.85, 1.4),
        (0.5, 1.1, 0.9),
    ];
    let unit = CM * wearer.scale;
    let field = wearer.field;
    let base = wearer.joints.at(Bone::Cervical).y + 3.6 * unit;
    let mut rows: Vec<Vec<DVec3>> = vec![Vec::new(); 5 + FALL.len()];
    for i in 0..STATIONS {
        let deg = lerp(GAP, 360.0 - GAP, i as f64 / (STATIONS - 1) as f64);
        let a = deg.to_radians();
        let (front, back) = (ops::cos(a).max(0.0), (-ops::cos(a)).max(0.0));
        let from_middle = deg.min(360.0 - deg);
        // 1 at the collar's points.
        let point = ops::exp(-ops::pow((from_middle - GAP) / 20.0, 2.0));
        let side = if deg < 180.0 { 1.0 } else { -1.0 };
        let foot = base - (4.4 * front - 1.0 * back) * unit;
        let stand = 3.1 * (1.0 - 0.30 * front) * unit;
        let fall = (3.7 + 2.4 * point) * unit;
        let at = |up: f64, off_cm: f64| field.neck_point(a, foot + up, off_cm * unit);
        for (k, (up, off)) in [
            (-unit, 0.55),
            (0.5 * stand, 0.65),
            (0.92 * stand, 0.75),
            (stand, 0.95),
            (0.9 * stand, 1.2),
        ]
        .into_iter()
        .enumerate()
        {
            rows[k].push(at(up, off));
        }
        for (k, (down, off, clear)) in FALL.into_iter().enumerate() {
            // The ends spread apart as they fall.
            let turned = a + side * (13.0 * down * point).to_radians();
            let out = (off + 0.9 * point * down) * unit;
            let mut p = field.neck_point(turned, foot + stand - fall * down, out);
            keep_off(field, &mut p, (clear + 0.25 * point) * unit);
            rows[5 + k].push(p);
        }
    }
    let axis = field.neck_point(0.0, base, 0.0);
    loft(&rows, wearer, false, |p| {
        // Most of the profile is the fall.
        DVec3::new(p.x, 0.0, p.z - axis.z * 0.3)
    })
}

/// A hood that hangs down: a roll round the neck, open in front, with a bag behind.
#[must_use]
pub fn hood(wearer: &Wearer<'_>, clear_cm: f64) -> Shell {
    const STATIONS: usize = 37;
    const AROUND: usize = 12;
    let unit = CM * wearer.scale;
    let field = wearer.field;
    let neck_y = wearer.joints.at(Bone::Cervical).y;
    let mut rows = Vec::with_capacity(STATIONS);
    for i in 0..STATIONS {
        let t = i as f64 / (STATIONS - 1) as f64;
        let a = lerp(7.0, 353.0, t).to_radians();
        let (front, back) = (ops::cos(a).max(0.0), (-ops::cos(a)).max(0.0));
        let end = smooth(t.min(1.0 - t) / 0.07);
        // The roll is uneven, as thick cloth is.
        let waves = 1.0 + 0.07 * ops::sin(9.0 * a) * ops::sin(4.0 * a + 1.0);
        let radius = (1.9 + 1.3 * back) * lerp(0.3, 1.0, end) * waves * unit;
        let y = neck_y + (3.2 - 4.4 * front + 0.6 * back) * unit;
        let centre = field.neck_point(a, y, (1.5 + 0.9 * back) * unit + radius * 0.6);
        let out = DVec3::new(ops::sin(a), 0.0, ops::cos(a));
        let ring = (0..AROUND)
            .map(|k| {
                let (s, c) = ops::sincos(core::f64::consts::TAU * k as f64 / AROUND as f64);
                // The bag hangs behind: below and outside the roll is drawn long.
                let bag = back * back * fade(-s, 0.0, 0.9);
                let drop = 1.0 + 4.2 * bag;
                let crumple = 1.0 + 0.05 * bag * ops::sin(13.0 * a);
                let mut p = centre
                    + out * (c * radius * (1.0 - 0.25 * bag) * crumple + bag * 1.4 * unit)
                    + DVec3::Y * (s * radius * drop);
                keep_off(field, &mut p, clear_cm * unit);
                p
            })
            .collect();
        rows.push(ring);
    }
    let middles: Vec<DVec3> = rows
        .iter()
        .map(|r: &Vec<DVec3>| r.iter().copied().sum::<DVec3>() / r.len() as f64)
        .collect();
    loft(&rows, wearer, true, |p| {
        let near = middles
            .iter()
            .min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)));
        p - near.copied().unwrap_or(p)
    })
}

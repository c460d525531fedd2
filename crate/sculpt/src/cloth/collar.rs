//! Collars: a shirt's collar and a hanging hood.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, ops};

use super::fade;
use super::strip::LayingSurface;
use super::wearer::Wearer;
use crate::torso::{CM, Field, Regions, Shell};
use raconteur_body::skeleton::Bone;

/// Treatment of the ends of rows.
#[derive(Clone, Copy)]
enum Ends {
    /// Rows are closed rings.
    Joined,
    /// Faces between four rows close them.
    Closed(&'static [[usize; 4]]),
}

/// Rows joined by quads; weights from the body below.
fn loft(
    rows: &[Vec<DVec3>],
    wearer: &Wearer<'_>,
    ends: Ends,
    outwards: impl Fn(DVec3) -> DVec3,
) -> Shell {
    let body = LayingSurface::new(&wearer.cage.shell);
    let mut out = Shell::default();
    for p in rows.iter().flatten() {
        out.points.push(*p);
        out.weights.push(body.project(*p).weights);
    }
    let m = rows.first().map_or(0, Vec::len);
    let at = |i: usize, k: usize| (i * m + k % m) as u32;
    for i in 0..rows.len().saturating_sub(1) {
        let round = matches!(ends, Ends::Joined);
        for k in 0..if round { m } else { m - 1 } {
            out.faces
                .push(vec![at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    if let Ends::Closed(caps) = ends {
        for cap in caps {
            out.faces.push(cap.map(|i| at(i, 0)).to_vec());
            out.faces
                .push(cap.iter().rev().map(|&i| at(i, m - 1)).collect());
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

/// Pushes a point to at least `off` metres from the body.
fn push_off(field: &Field, p: &mut DVec3, off: f64) {
    for _ in 0..3 {
        let (d, n) = field.value_and_normal(*p, Regions::ALL, 1.1);
        *p += n * (off - d).clamp(0.0, 3.0 * CM);
    }
}

/// Profile of a collar's stand, from its foot inside the shirt up along the neck and over its top:
/// (share of the stand's height, or of a centimetre below its foot; distance from the skin in cm).
const STAND_ROWS: [(f64, f64); 5] = [
    (-1.0, 0.05),
    (0.5, 0.10),
    (0.92, 0.14),
    (1.0, 0.38),
    (0.9, 0.68),
];
/// Profile of the fall, down its outside, round its edge and up again below: (share of the way
/// down, distance outwards in cm, minimum distance from the body in cm).
const FALL_ROWS: [(f64, f64, f64); 6] = [
    (0.25, 0.95, 1.25),
    (0.55, 1.45, 1.65),
    (0.85, 1.95, 1.8),
    (1.0, 2.15, 1.75),
    (0.96, 1.80, 1.4),
    (0.5, 0.95, 0.85),
];
/// Outside of the stand, which is visible between the ends of the fall; format of [`STAND_ROWS`].
const BACK_ROWS: [(f64, f64); 2] = [(0.86, 0.42), (-1.0, 0.40)];
/// Rows between which the ends of the fall are closed.
const CAPS: [[usize; 4]; 3] = [[4, 5, 10, 11], [5, 6, 9, 10], [6, 7, 8, 9]];

/// Builds a buttoned shirt collar: stand, fold and a fall with points, as one closed profile. The
/// stand lies against the neck and its ends meet at the throat; those of the fall diverge.
#[must_use]
pub fn shirt_collar(wearer: &Wearer<'_>) -> Shell {
    const STATIONS: usize = 35;
    let profiles: Vec<Vec<DVec3>> = (0..STATIONS)
        .map(|i| profile(wearer, i as f64 / (STATIONS - 1) as f64))
        .collect();
    let rows: Vec<Vec<DVec3>> = (0..profiles[0].len())
        .map(|k| profiles.iter().map(|p| p[k]).collect())
        .collect();
    let middle = wearer.field.neck_centre(base(wearer)).z;
    loft(&rows, wearer, Ends::Closed(&CAPS), |p| {
        // Most of the profile is the fall.
        DVec3::new(p.x, 0.0, p.z - middle * 0.3)
    })
}

/// Returns the height of the collar's base at the sides of the neck, metres.
fn base(wearer: &Wearer<'_>) -> f64 {
    wearer.joints.position_of(Bone::Cervical).y + 3.6 * CM * wearer.scale
}

/// Returns the profile of a collar at a share of its way round the neck, from one end over the
/// left.
fn profile(wearer: &Wearer<'_>, turn: f64) -> Vec<DVec3> {
    /// Degrees from the middle where the fall's ends begin.
    const GAP: f64 = 3.0;
    let unit = CM * wearer.scale;
    let (field, neck) = (wearer.field, wearer.neck);
    let deg = 360.0 * turn;
    let a = deg.to_radians();
    let (front, back) = (ops::cos(a).max(0.0), (-ops::cos(a)).max(0.0));
    let from_middle = deg.min(360.0 - deg);
    // 1 at the collar's points.
    let point = ops::exp(-ops::pow(from_middle / 20.0, 2.0));
    let side = if deg < 180.0 { 1.0 } else { -1.0 };
    let foot = base(wearer) - (4.4 * front - 1.0 * back) * unit;
    let stand = 3.1 * (1.0 - 0.30 * front) * unit;
    let fall = (3.7 + 2.4 * point + 0.9 * back) * unit;
    let standing = |(up, off): (f64, f64)| {
        let up = if up < 0.0 { up * unit } else { up * stand };
        neck.point(a, foot + up, off * unit)
    };
    let falling = |(down, off, clear): (f64, f64, f64)| {
        // The ends spread apart as they fall.
        let turned = a + side * ((GAP + 13.0 * down) * point).to_radians();
        let out = (off + 0.9 * point * down) * unit;
        // The collar hangs along the neck; the parts below push it outwards.
        let (top, hem) = (foot + stand, foot + stand - fall * down);
        let along = field.neck_centre(hem) - field.neck_centre(top);
        let mut p = neck.point(turned, top, out) + along;
        push_off(field, &mut p, (clear + 0.25 * point) * unit);
        p
    };
    let rows = STAND_ROWS.into_iter().map(standing);
    let rows = rows.chain(FALL_ROWS.into_iter().map(falling));
    rows.chain(BACK_ROWS.into_iter().map(standing)).collect()
}

/// Builds a hanging hood: a roll around the neck, open in front, with a bag behind.
#[must_use]
pub fn hood(wearer: &Wearer<'_>, clear_cm: f64) -> Shell {
    const STATIONS: usize = 37;
    const AROUND: usize = 12;
    let unit = CM * wearer.scale;
    let field = wearer.field;
    let neck_y = wearer.joints.position_of(Bone::Cervical).y;
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
                // The bag hangs behind: it extends below and outside the roll.
                let bag = back * back * fade(-s, 0.0, 0.9);
                let drop = 1.0 + 4.2 * bag;
                let crumple = 1.0 + 0.05 * bag * ops::sin(13.0 * a);
                let mut p = centre
                    + out * (c * radius * (1.0 - 0.25 * bag) * crumple + bag * 1.4 * unit)
                    + DVec3::Y * (s * radius * drop);
                push_off(field, &mut p, clear_cm * unit);
                p
            })
            .collect();
        rows.push(ring);
    }
    let middles: Vec<DVec3> = rows
        .iter()
        .map(|r: &Vec<DVec3>| r.iter().copied().sum::<DVec3>() / r.len() as f64)
        .collect();
    loft(&rows, wearer, Ends::Joined, |p| {
        let near = middles
            .iter()
            .min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)));
        p - near.copied().unwrap_or(p)
    })
}

//! Where the named points lie: the table, one person's forms, and the rings that follow
//! from it (lid margins on the globe, lips, nostrils, ears).

use std::sync::OnceLock;

use raconteur_base::{DVec3, ops};

use super::cage::{Key, Points};
use super::ear::ear_points;
use super::ear_shape::EarShape;
use super::form::{Form, reach};
use super::surface::nearest;

/// Radius of the eyeball, mm (adult mean 12.0–12.2; Bekerman et al. 2014,
/// doi:10.1155/2014/503645; *paper*).
pub(crate) const GLOBE_RADIUS_MM: f64 = 12.2;
/// Centre of the left eyeball of the mean head, mm.
const GLOBE_CENTRE_MM: DVec3 = DVec3::new(31.2, 22.0, 73.6);
const TABLE: &str = include_str!("points.tsv");

/// The constrained points of the left half of a head that is bound to the body model.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    pub(crate) points: Points,
    /// Centre of the left eyeball, mm.
    pub(crate) globe: DVec3,
    /// Crest of the left brow from its inner end, mm.
    pub(crate) brow: Vec<DVec3>,
}

/// What makes one person out of the table.
#[derive(Clone, Debug, Default)]
pub(crate) struct Individual {
    /// Forms and their amounts.
    pub(crate) terms: Vec<(&'static Form, f64)>,
    /// Where the body model has the points, for a person who is bound to it.
    pub(crate) fitted: Option<Fitted>,
}

impl Individual {
    fn globe_shift(&self) -> DVec3 {
        self.terms.iter().map(|(f, amount)| f.globe * *amount).sum()
    }

    /// Centre of the left eyeball, mm.
    pub(crate) fn globe_centre(&self) -> DVec3 {
        match &self.fitted {
            Some(fitted) => fitted.globe,
            None => GLOBE_CENTRE_MM + self.globe_shift(),
        }
    }

    /// Where a named point of the table lies, before the eye's and the ear's own rules.
    pub(super) fn place(&self, key: Key, base: DVec3) -> DVec3 {
        if let Some(&place) = self.fitted.as_ref().and_then(|f| f.points.get(&key)) {
            return place;
        }
        let mut own = base + self.globe_shift() * eye_block(key);
        for (form, amount) in &self.terms {
            own += (form.displace)(key, base) * *amount;
        }
        if key.on_midline() {
            own.x = 0.0;
        }
        own
    }

    /// The ear: the mean one with the forms' changes, on the side of this head.
    pub(crate) fn ear(&self) -> EarShape {
        let mut ear = EarShape::MEAN;
        for (form, amount) in &self.terms {
            ear = ear.plus(&form.ear, *amount);
        }
        // The root follows the side of the head; it keeps to the origin's height and depth.
        let root = DVec3::new(72.6, 0.0, 6.0);
        ear.shift.x += self.place(Key::Grid(12, 9), root).x - root.x;
        ear
    }
}

/// Where a point of the table lies on the mean head.
pub(crate) fn named(key: Key) -> Option<DVec3> {
    table().iter().find(|row| row.0 == key).map(|row| row.1)
}

/// Shift of a named point of this person against the mean head.
pub(crate) fn shift(individual: &Individual, key: Key) -> DVec3 {
    let base = named(key).unwrap_or_default();
    individual.place(key, base) - base
}

/// How far a point follows the eyeball.
fn eye_block(key: Key) -> f64 {
    if matches!(key, Key::Eye(..)) {
        1.0 - reach(key)
    } else {
        0.0
    }
}

struct Row {
    key: Key,
    base: DVec3,
    own: DVec3,
    on_globe: bool,
}

fn rows(individual: &Individual) -> Vec<Row> {
    table()
        .iter()
        .map(|&(key, base)| Row {
            key,
            base,
            own: individual.place(key, base),
            on_globe: base.z == 0.0 && matches!(key, Key::Eye(5, _)),
        })
        .collect()
}

/// The key in the first three fields of a table's row: ring, number of the ring, position.
pub(super) fn key(fields: &[&str]) -> Option<Key> {
    let number = |i: usize| fields.get(i)?.parse::<u8>().ok();
    let (a, b) = (number(1)?, number(2)?);
    Some(match *fields.first()? {
        "grid" => Key::Grid(a, b),
        "eye" if b < 16 => Key::eye(a, usize::from(b)),
        "mouth" if b < 13 => Key::mouth(a, usize::from(b)),
        "nostril" => Key::Nostril(a, b),
        "ear" => Key::Ear(a, b),
        "crown" => Key::Crown(a, b),
        _ => return None,
    })
}

/// The points of the mean head.
#[allow(
    clippy::expect_used,
    reason = "the table is part of the program and tested"
)]
pub(crate) fn table() -> &'static [(Key, DVec3)] {
    static ROWS: OnceLock<Vec<(Key, DVec3)>> = OnceLock::new();
    ROWS.get_or_init(|| {
        TABLE
            .lines()
            .skip(2)
            .map(|line| {
                let fields: Vec<&str> = line.split('\t').collect();
                let number = |i: usize| fields[i].parse().expect("a number");
                let place = DVec3::new(number(3), number(4), number(5));
                (key(&fields).expect("a key"), place)
            })
            .collect()
    })
}

pub(super) fn ring<const N: usize>(points: &Points, key: impl Fn(usize) -> Key) -> [DVec3; N] {
    core::array::from_fn(|k| points[&key(k)])
}

/// Every constrained point of the left half, mm.
pub(crate) fn points(individual: &Individual) -> Points {
    if let Some(fitted) = &individual.fitted {
        return fitted.points.clone();
    }
    let rows = rows(individual);
    let mut all: Points = rows.iter().map(|r| (r.key, r.own)).collect();
    eye(&mut all, &rows, individual.globe_centre());
    mouth(&mut all, &rows);
    nostril(&mut all, 0.5);
    all.extend(ear_points(&individual.ear()));
    all
}

/// Share of each position that belongs to a canthus and leaves the globe.
pub(super) const CANTHUS: [f64; 16] = [
    1.0, 0.55, 0.1, 0.0, 0.0, 0.0, 0.0, 0.1, 0.5, 0.1, 0.0, 0.0, 0.0, 0.0, 0.1, 0.55,
];

fn eye(all: &mut Points, rows: &[Row], centre: DVec3) {
    // Lashes root on a sphere a little outside the globe: the thickness of the lid.
    let outer = GLOBE_RADIUS_MM + 1.5;
    for row in rows.iter().filter(|r| r.on_globe) {
        let d = (row.own - centre).truncate();
        let z = centre.z + (outer * outer - d.length_squared()).max(1.0).sqrt();
        all.insert(row.key, DVec3::new(row.own.x, row.own.y, z));
    }
    line_lids(all, centre);
    let margin: [DVec3; 16] = ring(all, |k| Key::eye(5, k));
    let crease: [DVec3; 16] = ring(all, |k| Key::eye(3, k));
    for k in 0..16 {
        let c = CANTHUS[k];
        let half = (crease[k] + margin[k]) / 2.0;
        let d = half - centre;
        let plate = centre + d * ((outer + 0.45).max(d.length()) / d.length());
        all.insert(Key::eye(4, k), if c > 0.3 { half } else { plate });
    }
}

/// The lids' inner margin and their lining behind it, from the lash line.
pub(super) fn line_lids(all: &mut Points, centre: DVec3) {
    let margin: [DVec3; 16] = ring(all, |k| Key::eye(5, k));
    let opening = DVec3::new(centre.x, centre.y - 0.4, 0.0);
    for k in 0..16 {
        let c = CANTHUS[k];
        let d = margin[k] - centre;
        let inner = centre + d * ((GLOBE_RADIUS_MM + 0.12) / d.length());
        let inner = inner.lerp(margin[k] + DVec3::new(0.0, 0.0, -2.2), c);
        all.insert(Key::eye(6, k), inner);
        let out = (inner - centre).normalize();
        let radial = DVec3::new(inner.x - opening.x, inner.y - opening.y, 0.0).normalize();
        for (r, turn, radius) in [
            (7, 0.35, GLOBE_RADIUS_MM + 0.35),
            (8, 0.8, GLOBE_RADIUS_MM + 0.5),
        ] {
            let d = out * ops::cos(turn) + radial * ops::sin(turn);
            let mut lining = centre + d.normalize() * radius;
            if (r, k) == (7, 8) {
                // The outer corner leaves the globe; its lining would fold back on the lid.
                lining += DVec3::new(0.6, 0.0, -0.3);
            }
            all.insert(Key::eye(r, k), lining);
        }
    }
}

/// Height of the line where the lips meet, mm, at positions 0, 2, … 12.
const CONTACT_MM: [f64; 7] = [-46.9, -46.6, -47.4, -48.3, -47.6, -46.8, -47.1];
/// How far the named points of each lip keep from that line, mm, from the middle to the
/// corner: the skin bulges by a tenth less between them, so that the lips touch there and do
/// not pass into each other.
pub(super) const LIP_BULGE_MM: [f64; 7] = [0.66, 0.65, 0.62, 0.55, 0.53, 0.40, 0.0];

fn mouth(all: &mut Points, rows: &[Row]) {
    let fixed: Points = rows.iter().map(|r| (r.key, r.base)).collect();
    let border: [DVec3; 13] = ring(all, |k| Key::mouth(1, k));
    let full: [DVec3; 13] = ring(all, |k| Key::mouth(3, k));
    let roll: [DVec3; 13] = ring(all, |k| Key::mouth(4, k));
    let moved: [f64; 13] = core::array::from_fn(|k| roll[k].y - fixed[&Key::mouth(4, k)].y);
    for k in 0..13 {
        let low = ((k as f64 - 6.0) / 2.0).clamp(0.0, 1.0);
        let inset = border[k].lerp(full[k], 0.22 + 0.16 * low)
            + DVec3::new(0.0, 0.0, 0.35 * (1.0 + 0.6 * low));
        all.insert(Key::mouth(2, k), inset);
        let up = upward(k);
        let line = if k % 2 == 0 {
            CONTACT_MM[k / 2]
        } else {
            (CONTACT_MM[k / 2] + CONTACT_MM[k / 2 + 1]) / 2.0
        } + (moved[k] + moved[12 - k]) / 2.0;
        let mut p = roll[k];
        let bulge = LIP_BULGE_MM[k.min(12 - k)] * up.signum();
        p.y += bulge;
        all.insert(Key::mouth(4, k), p);
        p.y = 0.3 * p.y + 0.7 * (line + bulge);
        p.z -= 2.6;
        p.x *= 0.985;
        all.insert(Key::mouth(5, k), p);
    }
    line_mouth(all);
}

/// 1 on the upper lip, −1 on the lower, 0 at the corner.
pub(super) fn upward(k: usize) -> f64 {
    ((6.0 - k as f64) * 0.7).clamp(-1.0, 1.0)
}

/// The vestibule and the bag behind the line where the lips meet.
pub(super) fn line_mouth(all: &mut Points) {
    for k in 0..13 {
        let mut p = all[&Key::mouth(5, k)];
        for (r, step, widen) in [
            (6, [6.5, -2.8], 1.0),
            (7, [5.5, -8.0], 1.16),
            (8, [2.0, -32.0], 1.0),
        ] {
            p += DVec3::new(0.0, step[0] * upward(k), step[1]);
            p.x *= widen;
            all.insert(Key::mouth(r, k), p);
        }
    }
}

/// Tip of the nose before its base on the mean head, mm.
const MEAN_PROTRUSION_MM: f64 = 15.3;

/// Lines the nostril, whose rim it rounds towards an ellipse by a share of `rounding`.
pub(super) fn nostril(all: &mut Points, rounding: f64) {
    let rim: [DVec3; 8] = ring(all, |k| Key::nostril(0, k));
    let centre = rim.iter().sum::<DVec3>() / 8.0;
    // Axes of the rim: the long one by power iteration on the covariance.
    let spread = |v: DVec3| {
        rim.iter()
            .map(|&p| (p - centre) * (p - centre).dot(v))
            .sum::<DVec3>()
    };
    let mut long = DVec3::new(0.3, 0.0, 1.0);
    for _ in 0..60 {
        long = spread(long).normalize();
    }
    let mut across = DVec3::X;
    for _ in 0..60 {
        across = spread(across - long * across.dot(long));
        across = (across - long * across.dot(long)).normalize();
    }
    let normal = long.cross(across);
    let half = |axis: DVec3| spread(axis).dot(axis).max(1e-9).sqrt();
    let (a, b) = (half(long), half(across));
    // A small nose has a shallow cavity, or it would pierce the ala.
    let reach = all[&Key::Grid(0, 11)].z - all[&Key::Grid(0, 15)].z;
    let rise = (reach / MEAN_PROTRUSION_MM).clamp(0.6, 1.1);
    let way = DVec3::new(0.05, 0.92, 0.25);
    // Its rim rolls in less still, so that the lining has room behind it.
    // It goes in nearly square to the rim, which stands aslant where the wings are raised.
    let inward = normal * normal.dot(way).signum();
    let (up, deeper) = (
        inward.lerp(way, 0.3) * (rise * rise),
        way * ops::pow(rise, 1.5),
    );
    for (k, &p) in rim.iter().enumerate() {
        let d = p - centre;
        let turn = ops::atan2(d.dot(across) / b, d.dot(long) / a);
        let round = long * (ops::cos(turn) * a * 0.5)
            + across * (ops::sin(turn) * b * 0.5)
            + normal * d.dot(normal);
        all.insert(Key::nostril(0, k), centre + d.lerp(round, rounding));
        all.insert(
            Key::nostril(1, k),
            centre + (d * 0.2 + round * 0.8) * 0.78 + up * 1.6,
        );
        all.insert(Key::nostril(2, k), centre + round * 0.7 + deeper * 5.0);
        let deep = round * 0.45 + deeper * 10.0 + DVec3::new(-1.0, 0.0, -2.0);
        all.insert(Key::nostril(3, k), centre + deep);
    }
}

/// Carries a place on the unshifted head to this person's: the mean shift of the nearest
/// points of the table.
pub(crate) fn warp(individual: &Individual) -> impl Fn(DVec3) -> DVec3 + use<> {
    let rows: Vec<(DVec3, DVec3)> = rows(individual)
        .into_iter()
        .filter(|r| !r.on_globe)
        .map(|r| (r.base, r.own - r.base))
        .collect();
    let places: Vec<DVec3> = rows.iter().map(|r| r.0).collect();
    move |p| {
        let near = nearest(&places, p, 6, 2.0);
        p + near
            .iter()
            .map(|&(i, w)| rows[i as usize].1 * w)
            .sum::<DVec3>()
    }
}

//! Skull and lower jaw, fitted under the skin of the face.
//!
//! The skull is a radial map about the centre of the brain: in every direction the outermost skin,
//! minus the soft tissue over bone there, with orbits and nose carved in and a flat base.
//! Soft-tissue depths are means of adults after Stephan and Simpson 2008, "Facial soft tissue
//! depths in craniofacial identification (part I)", J. Forensic Sci. 53(6), 1257–1272, doi
//! 10.1111/j.1556-4029.2008.00852.x (recalled to the half millimetre, not read again); between its
//! points they are interpolated.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, Side, ops};

use super::head_skin::{COLUMNS, RINGS, Skin, direction};
use super::rigid;
use crate::part::MeshPart;
use crate::solid::{Section, Solid};
use raconteur_body::figure::Figure;
use raconteur_body::skeleton::Bone;

/// Minimum soft tissue over any bone of the head, metres; the test requires 1.5 mm.
const MIN_M: f64 = 0.003;

/// Tissue depths: position relative to the midpoint between the eyes (x outwards, y up, z front, mm
/// for the reference head), and depth, mm.
const DEPTHS: [([f64; 3], f64); 19] = [
    ([0.0, 105.0, -75.0], 5.0),   // vertex
    ([0.0, 62.0, 8.0], 5.0),      // forehead
    ([0.0, 24.0, 22.0], 5.5),     // glabella
    ([0.0, 8.0, 18.0], 6.5),      // nasion
    ([32.0, 20.0, 14.0], 6.0),    // over the orbit
    ([32.0, -24.0, 12.0], 7.0),   // under the orbit
    ([0.0, 10.0, -165.0], 6.5),   // opisthocranion
    ([0.0, -45.0, -150.0], 16.0), // nape: muscles
    ([68.0, 15.0, -30.0], 9.5),   // temple: its muscle
    ([75.0, 55.0, -85.0], 5.0),   // side of the vault
    ([62.0, -22.0, -25.0], 6.5),  // cheekbone's arch
    ([48.0, -22.0, 2.0], 8.5),    // cheekbone
    ([0.0, -44.0, 22.0], 12.5),   // under the nose
    ([0.0, -54.0, 20.0], 11.0),   // middle of the philtrum
    ([0.0, -64.0, 20.0], 11.5),   // upper lip
    ([20.0, -56.0, 14.0], 10.0),  // over the canine
    ([40.0, -58.0, -4.0], 26.0),  // cheek over the molars
    ([60.0, -60.0, -30.0], 30.0), // before the jaw's branch
    ([70.0, -35.0, -90.0], 12.0), // mastoid
];

fn depth_mm(relative_mm: DVec3) -> f64 {
    let p = DVec3::new(relative_mm.x.abs(), relative_mm.y, relative_mm.z);
    let (mut sum, mut weights) = (0.0, 0.0);
    for (place, depth) in DEPTHS {
        let d2 = (p - DVec3::from_array(place)).length_squared() + 60.0;
        let w = 1.0 / (d2 * d2);
        sum += depth * w;
        weights += w;
    }
    sum / weights
}

/// Returns the carving depths of orbits and nose at a position of the front, 0 to 1 each.
fn carved(skin: &Skin, relative_mm: DVec3) -> (f64, f64) {
    let p = relative_mm;
    let gap = skin.half_gap * 1000.0 / skin.scale + 3.0;
    let x = (p.x.abs() - gap) / 20.0;
    let y = (p.y + 1.0 - 0.12 * (p.x.abs() - gap)) / 17.0;
    let round = ops::pow(ops::pow(x.abs(), 2.6) + ops::pow(y.abs(), 2.6), 1.0 / 2.6);
    let orbit = 1.0 - smooth((round - 0.62) / 0.42);
    // A pear, narrow above.
    let t = ((-17.0 - p.y) / 30.0).clamp(0.0, 1.0);
    let half = lerp(4.0, 12.5, smooth(t * 1.3));
    let upright = ((p.y + 33.0) / 16.5).abs();
    let pear = ops::pow(
        ops::pow((p.x / half).abs(), 2.4) + ops::pow(upright, 2.6),
        0.4,
    );
    let nose = 1.0 - smooth((pear - 0.6) / 0.45);
    (orbit, if p.z > -20.0 { nose } else { 0.0 })
}

/// Returns the front limit of the bone along the middle of the face, mm in front of the eyes;
/// includes nasal bones and upper jaw, not the nose.
fn front_limit_mm(p: DVec3) -> f64 {
    let bridge = lerp(12.0, 21.0, ((6.0 - p.y) / 22.0).clamp(0.0, 1.0));
    let side = (p.x.abs() / 11.0).min(2.0);
    let jaw = 11.0 - 0.006 * p.x * p.x;
    let above = bridge - 5.5 * side * side;
    lerp(above.max(jaw - 6.0), jaw, smooth((-14.0 - p.y) / 8.0))
}

fn skull(skin: &Skin) -> Solid {
    let mm = 0.001 * skin.scale;
    let centre = DVec3::new(
        0.0,
        lerp(skin.eyes.y, skin.top, 0.28),
        skin.eyes.z - 78.0 * mm,
    );
    let raw: Vec<Vec<f64>> = skin
        .outermost_map(centre)
        .into_iter()
        .map(|row| {
            let known = |d: Option<f64>| d.unwrap_or(0.1 * skin.scale);
            row.into_iter().map(known).collect()
        })
        .collect();
    let relative = |p: DVec3| (p - skin.eyes) / mm;
    let rings: Vec<Vec<DVec3>> = (0..RINGS)
        .map(|i| {
            (0..COLUMNS)
                .map(|j| {
                    let d = direction(i, j);
                    let mut r = raw[i][j];
                    let at = relative(centre + d * r);
                    // Ears protrude, so the nearest part of the head around them counts.
                    if at.x.abs() > 50.0 && at.z < -35.0 && at.y.abs() < 60.0 {
                        for a in -5i32..=5 {
                            for b in -5i32..=5 {
                                let ring = i.saturating_add_signed(a as isize).min(RINGS - 1);
                                let column = (j as i32 + b).rem_euclid(COLUMNS as i32) as usize;
                                r = r.min(raw[ring][column]);
                            }
                        }
                    }
                    let at = relative(centre + d * r);
                    r -= depth_mm(at) * mm;
                    let at = relative(centre + d * r);
                    if at.z > -5.0 && at.x.abs() < 24.0 && d.z > 0.2 {
                        let limit = front_limit_mm(at);
                        r -= ((at.z - limit).max(0.0) * mm) / d.z;
                    }
                    let (orbit, nose) = carved(skin, relative(centre + d * r));
                    if d.z > 0.3 {
                        r -= (30.0 * orbit + 15.0 * nose * (1.0 - orbit)) * mm;
                    }
                    // The base: from the nape forwards and down to the teeth.
                    let at = relative(centre + d * r);
                    let base = lerp(-30.0, -66.0, smooth((at.z + 95.0) / 85.0));
                    if at.y < base && d.y < 0.0 {
                        let floor = (skin.eyes.y + base * mm - centre.y) / d.y;
                        r = r.min(floor.max(0.01));
                    }
                    // Under the cheekbones the upper jaw is narrow.
                    let at = relative(centre + d * r);
                    let wide = lerp(56.0, 31.0, smooth((-27.0 - at.y) / 16.0));
                    if at.z > -45.0 && at.y < -27.0 && at.x.abs() > wide {
                        r *= wide / at.x.abs();
                    }
                    centre + d * r
                })
                .collect()
        })
        .collect();
    let mut solid = Solid::from_rings(&rings);
    smooth_out(&mut solid, 1);
    shrink_below_skin(&mut solid, skin, |_| centre);
    solid
}

/// Moves every point half way to the mean of its neighbours, for `rounds` rounds.
fn smooth_out(solid: &mut Solid, rounds: usize) {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); solid.points.len()];
    for face in &solid.faces {
        for k in 0..face.len() {
            around[face[k] as usize].push(face[(k + 1) % face.len()]);
        }
    }
    for _ in 0..rounds {
        let before = solid.points.clone();
        for (p, near) in solid.points.iter_mut().zip(&around) {
            let sum: DVec3 = near.iter().map(|&i| before[i as usize]).sum();
            *p = p.lerp(sum / near.len().max(1) as f64, 0.5);
        }
    }
}

/// Moves points towards `anchor` until enough skin covers them.
fn shrink_below_skin(solid: &mut Solid, skin: &Skin, anchor: impl Fn(DVec3) -> DVec3) {
    for p in &mut solid.points {
        let goal = anchor(*p);
        for _ in 0..24 {
            let way = *p - goal;
            let length = way.length();
            let covered = skin
                .nearest(*p)
                .is_none_or(|(d, behind)| behind && d >= MIN_M);
            if covered {
                break;
            }
            *p = goal + way * (1.0 - 0.0012 / length.max(0.0024));
        }
    }
}

/// Builds the zygomatic arch from the face to the ear.
fn arch(skin: &Skin, side: Side) -> Solid {
    let mm = 0.001 * skin.scale;
    let at = |x: f64, y: f64, z: f64| skin.eyes + DVec3::new(x * side.sign(), y, z) * mm;
    let cover = |p: DVec3| {
        let from = DVec3::new(0.0, p.y, p.z);
        let way = DVec3::X * side.sign();
        let skin_x = skin.outermost(from, way).unwrap_or(0.07);
        from + way * (skin_x - 8.0 * mm).min((p.x - from.x).abs())
    };
    let path = [
        (at(44.0, -20.0, -4.0), 8.0, 6.0),
        (at(54.0, -21.0, -16.0), 6.0, 4.0),
        (at(62.0, -21.0, -34.0), 4.5, 3.0),
        (at(64.0, -20.0, -52.0), 4.5, 3.0),
        (at(60.0, -17.0, -70.0), 5.0, 4.0),
    ]
    .map(|(p, wide, thick)| (cover(p), wide * mm, thick * mm));
    let mut solid = Solid::rod(&path, DVec3::Y, 8);
    shrink_below_skin(&mut solid, skin, |p| DVec3::new(p.x * 0.5, p.y, p.z));
    solid
}

/// Builds the lower jaw as one tube from hinge to hinge, high and thin at the branches, rounder at
/// the chin.
fn mandible(skin: &Skin) -> Solid {
    let mm = 0.001 * skin.scale;
    let level = skin.chin.y + 21.0 * mm;
    let middle = DVec3::new(0.0, level, lerp(skin.hinge.z, skin.eyes.z, 0.30));
    // Means: 11 mm over the chin, 18 next to it, 21 over the molars, 12 at the angle.
    let arc = |degrees: f64, depth: f64, y: f64| {
        let (s, c) = ops::sincos(degrees.to_radians());
        let way = DVec3::new(s, 0.0, c);
        let from = middle + DVec3::Y * y * mm;
        let r = skin.outermost(from, way).unwrap_or(0.06) - depth * mm;
        from + way * r
    };
    let hinge_y = skin.hinge.y;
    let lateral = skin
        .outermost(skin.hinge + DVec3::Z * 6.0 * mm, DVec3::X)
        .unwrap_or(0.07);
    let condyle = DVec3::new(
        (lateral - 21.0 * mm).min(52.0 * mm),
        hinge_y - 2.0 * mm,
        skin.hinge.z,
    );
    let angle = arc(88.0, 15.0, 2.0).with_z(skin.hinge.z + 8.0 * mm);
    let branch = |t: f64, forward: f64| angle.lerp(condyle, t) + DVec3::Z * forward * mm;
    // From the left hinge to the chin: centre, half extent along the branch's width or the
    // body's height, half thickness, and the direction of the first.
    let z = DVec3::Z;
    let y = DVec3::Y;
    let left: [(DVec3, f64, f64, DVec3); 9] = [
        (condyle, 4.5, 8.0, z),
        (branch(0.86, 1.0), 6.5, 4.5, z),
        (branch(0.55, 7.0), 15.5, 4.0, z),
        (branch(0.22, 9.0), 17.0, 4.5, (z + y * 0.25).normalize()),
        (
            angle.lerp(arc(66.0, 20.0, 1.0), 0.55),
            15.0,
            5.5,
            (z * 0.3 + y).normalize(),
        ),
        (arc(60.0, 20.0, 1.0), 13.5, 6.0, y),
        (arc(40.0, 17.0, 0.0), 13.5, 6.0, y),
        (arc(20.0, 12.5, -1.0), 14.0, 6.0, y),
        (arc(0.0, 11.0, -2.0), 14.5, 6.5, y),
    ];
    let mirror = |p: DVec3| DVec3::new(-p.x, p.y, p.z);
    let chain: Vec<_> = left
        .iter()
        .copied()
        .chain(left[..8].iter().rev().map(|s| (mirror(s.0), s.1, s.2, s.3)))
        .collect();
    let sections: Vec<Section> = (0..chain.len())
        .map(|i| {
            let (p, tall, thick, up) = chain[i];
            let before = chain[i.saturating_sub(1)].0;
            let after = chain[(i + 1).min(chain.len() - 1)].0;
            let along = (after - before).try_normalize().unwrap_or(DVec3::X);
            let up = (up - along * up.dot(along))
                .try_normalize()
                .unwrap_or(DVec3::Y);
            (p, up * tall * mm, along.cross(up) * thick * mm)
        })
        .collect();
    let mut solid = Solid::tube(&sections, 12);
    shrink_below_skin(&mut solid, skin, |p| {
        // Inwards: to the middle of the mouth's floor, or along the branch towards the middle.
        let t = ((p.y - level) / (hinge_y - level)).clamp(0.0, 1.0);
        DVec3::new(
            p.x * 0.35,
            lerp(level + 4.0 * mm, p.y, t),
            lerp(middle.z, p.z, t),
        )
    });
    solid
}

/// Builds the skull with the zygomatic arches, and the lower jaw on its own joint.
pub(super) fn parts(figure: &Figure) -> Vec<MeshPart> {
    let skin = Skin::from_figure(figure);
    let mut cheeks = arch(&skin, Side::Left);
    cheeks.append(arch(&skin, Side::Right));
    vec![
        rigid("skull", skull(&skin), Bone::Skull),
        rigid("cheekbones", cheeks, Bone::Skull),
        rigid("mandible", mandible(&skin), Bone::Chin),
    ]
}

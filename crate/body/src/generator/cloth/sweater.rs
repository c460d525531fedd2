//! A knitted sweater: close on the shoulders, folds on forearm and waist, ribbed bands.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, Side, mirror_vector};

use super::band::{Band, along_edge};
use super::drape::{DrapeParams, Draping, drape};
use super::fade;
use super::finish::{Chart, cloth_part};
use crate::figure::Material;
use crate::generator::part::Part;
use crate::generator::torso::cage::Tag;
use crate::generator::torso::{CM, Cage, Field, Joints, Regions, Shell};
use crate::skeleton::Bone;

/// Rows of the trunk that the knit covers, before the bands.
const TRUNK_ROWS: core::ops::Range<usize> = 3..15;
/// The last span of an arm's rings that it covers; the cuff follows.
const LAST_ARM_SPAN: usize = 12;

/// The finished sweater and where it ends.
#[derive(Clone, Debug)]
pub struct Sweater {
    /// Knit and bands, ready to join.
    pub parts: Vec<Part>,
    /// All of its surface, for hair to lie on.
    pub shell: Shell,
}

/// Distance along the nearer arm from its shoulder, metres; negative inside the trunk.
pub(super) fn along_arm(joints: &Joints, p: DVec3) -> f64 {
    let left = if p.x >= 0.0 { p } else { mirror_vector(p) };
    (left - joints.at(Bone::LShoulder)).dot(Joints::arm_axis())
}

/// The knit before draping: the cage's faces, subdivided and set off from the field.
fn offset_shell(field: &Field, cage: &Cage) -> (Shell, Vec<Tag>) {
    let wanted = |tag: Tag| match tag {
        Tag::Trunk(r) => TRUNK_ROWS.contains(&r),
        Tag::Arm(j) => j <= LAST_ARM_SPAN,
        Tag::Leg(_) => false,
    };
    let tags: Vec<Tag> = cage.tags.iter().copied().filter(|t| wanted(*t)).collect();
    let (mut shell, _) = cage.part(wanted).subdivided(1);
    let (low, high) = (Cage::row_height(field, 10), Cage::row_height(field, 13));
    for _ in 0..4 {
        for p in &mut shell.points {
            // Softened, the field bridges hollows as cloth does; the neck is close.
            let neck = fade(p.y, high, high + 4.0 * CM);
            let (d, n) = field.value_and_normal(*p, Regions::ALL, lerp(1.3, 1.0, neck));
            let ease = CM * lerp(lerp(0.8, 0.55, fade(p.y, low, high)), 0.35, neck);
            *p += n * (ease - d).clamp(-3.0 * CM, 3.0 * CM) * 0.9;
        }
        shell.relax(2);
    }
    (shell, tags)
}

struct Edges {
    neck: Vec<u32>,
    hem: Vec<u32>,
    cuffs: Vec<Vec<u32>>,
}

fn edges(shell: &Shell) -> Edges {
    let mean = |ring: &[u32], f: &dyn Fn(usize) -> f64| {
        ring.iter().map(|&v| f(v as usize)).sum::<f64>() / ring.len() as f64
    };
    let on_arm = |v: usize| {
        Side::BOTH
            .iter()
            .map(|s| shell.weights[v].arm(*s))
            .sum::<f64>()
    };
    let (cuffs, mut trunk): (Vec<_>, Vec<_>) = shell
        .loops()
        .into_iter()
        .partition(|ring| mean(ring, &on_arm) > 0.5);
    trunk.sort_by(|a, b| {
        mean(a, &|v| shell.points[v].y).total_cmp(&mean(b, &|v| shell.points[v].y))
    });
    Edges {
        neck: trunk.last().cloned().unwrap_or_default(),
        hem: trunk.first().cloned().unwrap_or_default(),
        cuffs,
    }
}

/// Pins, rest lengths and the tightened cuffs and hem.
fn prepare(mut shell: Shell, field: &Field, joints: &Joints) -> Draping {
    let Edges { neck, hem, cuffs } = edges(&shell);
    let on_arm: Vec<f64> = shell
        .weights
        .iter()
        .map(|w| Side::BOTH.iter().map(|s| w.arm(*s)).sum())
        .collect();
    let along: Vec<f64> = shell
        .points
        .iter()
        .zip(&on_arm)
        .map(|(p, arm)| {
            if *arm > 0.5 {
                along_arm(joints, *p)
            } else {
                0.0
            }
        })
        .collect();
    let shoulder = joints.at(Bone::LShoulder);
    let upper_arm = joints.at(Bone::LElbow).distance(shoulder);
    let end = along.iter().copied().fold(0.0, f64::max) - 0.3 * CM;
    let start = cuffs
        .iter()
        .flatten()
        .map(|&v| along[v as usize])
        .fold(f64::MAX, f64::min)
        - 3.0 * CM;
    let yoke = Cage::row_height(field, 11);
    let mut pin = vec![0.0; shell.points.len()];
    for v in 0..pin.len() {
        let p = shell.points[v];
        // The cuff sits close.
        let (d, n) = field.value_and_normal(p, Regions::ALL, 1.0);
        shell.points[v] -= n * (d - 0.7 * CM).clamp(0.0, 5.0 * CM) * fade(along[v], start, end);
        let near_neck = fade(p.y, shoulder.y + 2.0 * CM, shoulder.y + 5.0 * CM)
            * f64::from(u8::from(p.x.abs() < shoulder.x));
        // Yoke and sleeve cap are tailored, not draped: excess there would puff.
        let hold = if on_arm[v] > 0.5 {
            fade(along[v] / upper_arm, 0.62, 0.37)
        } else {
            fade(p.y, yoke - 4.0 * CM, yoke + 3.0 * CM)
        };
        pin[v] = near_neck
            .max(fade(along[v], start + CM, end))
            .max(0.985 * hold);
    }
    for &v in neck.iter().chain(cuffs.iter().flatten()) {
        pin[v as usize] = 1.0;
    }
    let mut rest = stretched(&shell, &along, joints, upper_arm);
    hold_hem_in(&mut shell, &mut rest, &hem, &on_arm);
    Draping { shell, rest, pin }
}

/// Rest shape: a copy with excess length along the sleeves and down the trunk, which must
/// turn into folds.
fn stretched(shell: &Shell, along: &[f64], joints: &Joints, upper_arm: f64) -> Vec<DVec3> {
    let top = joints.at(Bone::Cervical).y - 20.0 * CM;
    shell
        .points
        .iter()
        .zip(along)
        .zip(&shell.weights)
        .map(|((p, a), w)| {
            let mut q = *p;
            for side in Side::BOTH {
                let axis = Joints::arm_axis() * DVec3::new(side.sign(), 1.0, 1.0);
                let excess = (a - 0.45 * upper_arm).max(0.0) * 0.07;
                q += axis * excess * fade(w.arm(side), 0.3, 0.9);
            }
            let is_trunk = Side::BOTH.iter().all(|s| w.arm(*s) < 0.01);
            if is_trunk {
                q.y -= 0.02 * (top - p.y).clamp(0.0, 60.0 * CM);
            }
            q
        })
        .collect()
}

/// Ribbing holds the bottom edge in.
fn hold_hem_in(shell: &mut Shell, rest: &mut [DVec3], hem: &[u32], on_arm: &[f64]) {
    let centre: DVec3 =
        hem.iter().map(|&v| shell.points[v as usize]).sum::<DVec3>() / hem.len().max(1) as f64;
    let top = hem
        .iter()
        .map(|&v| shell.points[v as usize].y)
        .fold(f64::MIN, f64::max);
    for v in 0..rest.len() {
        if on_arm[v] < 0.3 {
            let k = fade(shell.points[v].y, top + 5.0 * CM, top) * 0.06;
            let pull =
                |p: DVec3, k: f64| DVec3::new(lerp(p.x, centre.x, k), p.y, lerp(p.z, centre.z, k));
            shell.points[v] = pull(shell.points[v], k * 0.6);
            rest[v] = pull(rest[v], k);
        }
    }
}

/// Charts of trunk, left sleeve and right sleeve.
fn charts(joints: &Joints) -> [Chart; 3] {
    let sleeve = |side: Side| {
        let mirror = |v: DVec3| {
            if side == Side::Left {
                v
            } else {
                mirror_vector(v)
            }
        };
        Chart {
            origin: mirror(joints.at(Bone::LShoulder)),
            axis: -mirror(Joints::arm_axis()),
            front: mirror(Joints::arm_up()),
            radius: 5.5 * CM,
        }
    };
    let trunk = Chart {
        // Coordinates within ±1 m store small.
        origin: DVec3::new(0.0, 1.2, -1.5 * CM),
        axis: DVec3::Y,
        front: DVec3::Z,
        radius: 14.0 * CM,
    };
    [trunk, sleeve(Side::Left), sleeve(Side::Right)]
}

/// Knits the sweater on a body.
#[must_use]
pub fn sweater(field: &Field, cage: &Cage, joints: &Joints, material: &Material) -> Sweater {
    let (shell, tags) = offset_shell(field, cage);
    let cloth = prepare(shell, field, joints);
    let waist = Cage::row_height(field, 6) + 5.0 * CM;
    // Another garment lies below from the waist down.
    let thickness = |p: DVec3| {
        let hip = p.x.abs() < 0.25;
        CM * (0.55
            + if hip {
                fade(p.y, waist, waist - 10.0 * CM)
            } else {
                0.0
            })
    };
    let mut draped = drape(cloth, &DrapeParams::default(), field, &thickness).shell;
    draped.relax(1);

    let charts = charts(joints);
    // Each cage face became sixteen.
    let chart_of = |f: usize| match tags[f / 16] {
        Tag::Trunk(_) => 0,
        Tag::Arm(_) | Tag::Leg(_) => {
            let x: f64 = draped.faces[f]
                .iter()
                .map(|&v| draped.points[v as usize].x)
                .sum();
            if x > 0.0 { 1 } else { 2 }
        }
    };
    let mut parts = vec![cloth_part(
        "sweater", &draped, field, material, &charts, chart_of,
    )];
    let edges = edges(&draped);
    let rib = |direction: DVec3, width_cm: f64, ease_cm: f64, regions: Regions| Band {
        direction,
        width: width_cm * CM,
        thickness: 0.22 * CM,
        ease: ease_cm * CM,
        regions,
        spacing: 0.75 * CM,
        ribs: 4,
    };
    let up_the_neck = DVec3::new(0.0, 1.0, 0.25).normalize();
    let neckband = rib(up_the_neck, 2.6, 0.35, Regions::ALL);
    let hem = rib(DVec3::NEG_Y, 4.5, 1.4, Regions::LOWER);
    let mut bands: Vec<(Shell, usize)> = vec![
        (along_edge(&draped, &edges.neck, &neckband, field), 0),
        (along_edge(&draped, &edges.hem, &hem, field), 0),
    ];
    for cuff in &edges.cuffs {
        let right = draped.points[cuff[0] as usize].x < 0.0;
        let axis = Joints::arm_axis();
        let axis = if right { mirror_vector(axis) } else { axis };
        let band = rib(axis, 5.5, 0.55, Regions::UPPER);
        bands.push((
            along_edge(&draped, cuff, &band, field),
            1 + usize::from(right),
        ));
    }
    let mut shell = draped.clone();
    for (band, chart) in bands {
        parts.push(cloth_part(
            "sweater",
            &band,
            field,
            material,
            &charts,
            |_| chart,
        ));
        shell.append(band);
    }
    Sweater { parts, shell }
}

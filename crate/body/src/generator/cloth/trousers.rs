//! Straight trousers.

use raconteur_base::{DVec3, Side};

use super::band::{Band, along_edge};
use super::drape::{DrapeParams, Draping, drape};
use super::fade;
use super::finish::{Chart, cloth_part};
use crate::figure::Material;
use crate::generator::part::Part;
use crate::generator::torso::cage::Tag;
use crate::generator::torso::{CM, Cage, Field, Joints, Regions, Shell};
use crate::skeleton::Bone;

/// Rows of the trunk that they cover.
const TRUNK_ROWS: usize = 4;
/// The last span of a leg's rings that they cover.
const LAST_LEG_SPAN: usize = 14;

fn offset_shell(field: &Field, cage: &Cage, joints: &Joints) -> (Shell, Vec<Tag>) {
    let wanted = |tag: Tag| match tag {
        Tag::Trunk(r) => r < TRUNK_ROWS,
        Tag::Arm(_) => false,
        Tag::Leg(j) => j <= LAST_LEG_SPAN,
    };
    let tags: Vec<Tag> = cage.tags.iter().copied().filter(|t| wanted(*t)).collect();
    let (mut shell, _) = cage.part(wanted).subdivided(1);
    let hip = joints.at(Bone::LHip).y;
    for _ in 0..4 {
        for p in &mut shell.points {
            let (d, n) = field.value_and_normal(*p, Regions::LOWER, 1.8);
            let ease = CM * (0.8 + 1.1 * fade(hip - p.y, 8.0 * CM, 60.0 * CM));
            *p += n * (ease - d).clamp(-3.0 * CM, 3.0 * CM) * 0.9;
        }
        shell.relax(2);
    }
    for (p, w) in shell.points.iter_mut().zip(&shell.weights) {
        // The legs never cross the middle.
        if w.leg(Side::Left) > 0.8 {
            p.x = p.x.max(0.35 * CM);
        }
        if w.leg(Side::Right) > 0.8 {
            p.x = p.x.min(-0.35 * CM);
        }
    }
    (shell, tags)
}

/// Makes trousers for a body.
#[must_use]
pub fn trousers(field: &Field, cage: &Cage, joints: &Joints, material: &Material) -> Vec<Part> {
    let (shell, tags) = offset_shell(field, cage, joints);
    let top = shell.points.iter().map(|p| p.y).fold(f64::MIN, f64::max);
    let mut pin: Vec<f64> = shell
        .points
        .iter()
        .map(|p| fade(p.y, top - 6.0 * CM, top))
        .collect();
    for ring in shell.loops() {
        for v in ring {
            if shell.points[v as usize].y < 0.3 {
                pin[v as usize] = 0.97;
            }
        }
    }
    let hip = joints.at(Bone::LHip);
    let down = (joints.at(Bone::LSubtalar) - hip).normalize();
    let rest = shell
        .points
        .iter()
        .zip(&shell.weights)
        .map(|(p, w)| {
            let mut q = *p;
            for side in Side::BOTH {
                let mirror = DVec3::new(side.sign(), 1.0, 1.0);
                let along = (*p - hip * mirror).dot(down * mirror).max(0.0);
                q += down * mirror * along * 0.022 * fade(w.leg(side), 0.3, 0.9);
            }
            q
        })
        .collect();
    let params = DrapeParams {
        regions: Regions::LOWER,
        steps: [70, 0],
        seed: 2,
        ..DrapeParams::default()
    };
    let mut draped = drape(Draping { shell, rest, pin }, &params, field, &|_| 0.45 * CM).shell;
    draped.relax(1);

    let chart = |x: f64, radius: f64| Chart {
        origin: DVec3::new(x, 0.5, 0.0),
        axis: DVec3::Y,
        front: DVec3::Z,
        radius,
    };
    let charts = [
        chart(0.0, 15.0 * CM),
        chart(hip.x, 8.0 * CM),
        chart(-hip.x, 8.0 * CM),
    ];
    let leg_chart = |x: f64| if x > 0.0 { 1 } else { 2 };
    let mut parts = vec![cloth_part(
        "trousers",
        &draped,
        field,
        material,
        &charts,
        |f| match tags[f / 4] {
            Tag::Trunk(_) => 0,
            Tag::Arm(_) | Tag::Leg(_) => leg_chart(
                draped.faces[f]
                    .iter()
                    .map(|&v| draped.points[v as usize].x)
                    .sum(),
            ),
        },
    )];
    for ring in draped.loops() {
        let first = draped.points[ring[0] as usize];
        if first.y < 0.3 {
            let hem = Band {
                direction: DVec3::NEG_Y,
                width: 2.0 * CM,
                thickness: 0.12 * CM,
                ease: 1.7 * CM,
                regions: Regions::LOWER,
                spacing: 1.2 * CM,
                ribs: 0,
            };
            let band = along_edge(&draped, &ring, &hem, field);
            parts.push(cloth_part(
                "trousers",
                &band,
                field,
                material,
                &charts,
                |_| leg_chart(first.x),
            ));
        }
    }
    parts
}

//! Visible part of a shirt under a cardigan.

use raconteur_base::DVec3;

use super::band::{Band, BandPath, along_edge};
use super::collar::shirt_collar;
use super::dressed::{Dressed, Neckline, cloth, collar_part, leather, trim};
use super::finish::{Fabric, plain_part};
use super::sheet::Sheet;
use super::strip::{LayingSurface, Strip, button, strip};
use super::wardrobe::Cardigan;
use super::wearer::Wearer;
use crate::torso::cage::Tag;
use crate::torso::{CM, Cage, Joints, Regions};
use raconteur_body::figure::MaterialKind;
use raconteur_body::skeleton::Bone;

/// Adds the visible parts of the shirt: its front in the V, the collar, the cuffs.
pub(super) fn shirt(made: &mut Dressed, wearer: &Wearer<'_>, c: &Cardigan, vee: &Neckline) {
    let unit = CM * wearer.scale;
    let woven = cloth(MaterialKind::Woven, c.shirt);
    let rows = Cage::row_at(0.66)..Cage::row_at(0.842);
    let mut sheet = Sheet::extract(
        wearer.cage,
        |t| matches!(t, Tag::Trunk(r) if rows.contains(&r)),
    );
    sheet.settle(wearer.field, Regions::ALL, |_| 1.1, |_| 0.35 * unit);
    sheet.retain(|shell, f| {
        let face = &shell.faces[f];
        let middle = face
            .iter()
            .map(|&v| shell.points[v as usize])
            .sum::<DVec3>()
            / face.len() as f64;
        // Up to the foot of the collar, which climbs from the front to the nape.
        let round = DVec3::new(middle.x, 0.0, middle.z + 2.5 * unit).normalize_or_zero();
        middle.z > -2.0 * unit
            && middle.y < vee.high + (2.9 - 3.2 * round.z.max(0.0)) * unit
            && middle.y > vee.low - 4.0 * unit
            && middle.x.abs() < vee.half_width(middle.y + 3.0 * unit) + 1.6 * unit
    });
    made.parts.push(trim(wearer, &sheet.shell, woven));
    let lay = LayingSurface::new(&sheet.shell);
    let neck = vee.high - 1.8 * unit;
    let front = lay.path(
        &[
            DVec3::new(0.0, vee.low - 2.0 * unit, 0.3),
            DVec3::new(0.0, neck, 0.3),
        ],
        1.2 * unit,
    );
    let placket = strip(
        &front,
        &Strip {
            width: 2.8 * unit,
            thickness: 0.12 * unit,
            closed: false,
        },
    );
    made.parts.push(trim(wearer, &placket, woven.shaded(0.98)));
    for i in 0..3 {
        let mut spot =
            lay.project_along_z(DVec3::new(0.0, neck - (1.6 + 6.5 * i as f64) * unit, 0.3));
        spot.place += spot.normal * 0.1 * unit;
        let disc = button(&spot, 0.5 * unit);
        made.parts.push(plain_part(
            "button",
            &disc,
            wearer.field,
            leather([0.6, 0.59, 0.55]),
        ));
    }
    let collar = shirt_collar(wearer);
    made.parts.push(collar_part(trim(wearer, &collar, woven)));
    made.surface.append(collar);
    cuffs(made, wearer, woven);
}

/// Adds the shirt's cuffs that show below those of the cardigan.
fn cuffs(made: &mut Dressed, wearer: &Wearer<'_>, fabric: Fabric) {
    let unit = CM * wearer.scale;
    let first = Cage::arm_ring_at(1.85);
    let mut sheet = Sheet::extract(wearer.cage, |t| matches!(t, Tag::Arm(j) if j >= first));
    sheet.settle(wearer.field, Regions::UPPER, |_| 1.0, |_| 0.9 * unit);
    made.parts.push(trim(wearer, &sheet.shell, fabric));
    for ring in sheet.shell.loops() {
        let x: f64 = ring.iter().map(|&v| sheet.shell.points[v as usize].x).sum();
        let axis = Joints::arm_axis() * DVec3::new(x.signum(), 1.0, 1.0);
        let wrist = wearer.joints.position_of(Bone::LWrist).y;
        let low = ring
            .iter()
            .map(|&v| sheet.shell.points[v as usize].y)
            .fold(f64::MAX, f64::min);
        if low > wrist + 2.0 * unit {
            continue;
        }
        let band = Band {
            direction: axis,
            width: 1.0 * unit,
            thickness: 0.16 * unit,
            ease: 0.92 * unit,
            round: BandPath::Body(wearer.field, Regions::UPPER),
            billow: 0.0,
            every: 1,
        };
        let edge = along_edge(&sheet.shell, &ring, &band);
        made.parts.push(trim(wearer, &edge, fabric));
    }
}

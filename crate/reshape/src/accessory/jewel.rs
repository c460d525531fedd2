//! Jewellery of ears and nose.

use std::f64::consts::TAU;

use raconteur_base::{DVec3, ops};

use super::solid::Solid;
use super::{AccessoryKind, Fit, landmark, material};
use raconteur_body::figure::{MaterialKind, Mesh};

const BALL_M: f64 = 0.0024;
/// Radius of an ear's ring, and of its wire.
const RING_M: f64 = 0.011;
const WIRE_M: f64 = 0.0007;
/// Height of the hole above the lowest point of the lobe.
const HOLE_M: f64 = 0.0045;

fn studs(fit: &Fit) -> Solid {
    let mut solid = Solid::default();
    for v in landmark::SUBAURALE {
        let low = fit.position(v);
        let hole = low + DVec3::Y * HOLE_M;
        // On the outer face of the lobe.
        let outer = fit
            .side(low.x.signum(), hole.y, hole.z, 0.004)
            .unwrap_or(low.x.abs());
        solid.join(Solid::ball(
            DVec3::new(low.x.signum() * outer, hole.y, hole.z),
            BALL_M,
        ));
    }
    solid
}

fn rings(fit: &Fit) -> Solid {
    let mut solid = Solid::default();
    for v in landmark::SUBAURALE {
        let low = fit.position(v);
        let centre = low + DVec3::Y * (HOLE_M - RING_M);
        let point = |i: i32| {
            let turn = TAU * f64::from(i) / 32.0;
            centre
                + RING_M
                    * DVec3::new(
                        0.15 * low.x.signum() * ops::sin(turn),
                        ops::cos(turn),
                        ops::sin(turn),
                    )
        };
        let points: Vec<DVec3> = (0..32).map(point).collect();
        solid.join(Solid::rod(&points, WIRE_M, true));
    }
    solid
}

/// Returns a stud on the left wing of the nose, at its widest point.
fn nose_stud(fit: &Fit) -> Solid {
    let tip = fit
        .skin
        .iter()
        .max_by(|a, b| a.z.total_cmp(&b.z))
        .copied()
        .unwrap_or(DVec3::ZERO);
    let is_wing = |p: &DVec3| {
        p.z < tip.z - 0.008
            && p.z > tip.z - 0.022
            && p.x > 0.0
            && p.x < 0.026
            && (p.y - tip.y).abs() < 0.006
    };
    let wing = (0..fit.skin.len())
        .filter(|&v| is_wing(&fit.skin[v]))
        .max_by(|&a, &b| fit.skin[a].x.total_cmp(&fit.skin[b].x));
    wing.map_or_else(Solid::default, |v| {
        Solid::ball(fit.position(v) + fit.normal(v) * 0.0004, 0.0013)
    })
}

/// Returns the meshes of jewellery of a kind and colour, fitted to a head.
pub(super) fn meshes(kind: AccessoryKind, colour: [f32; 3], fit: &Fit) -> Vec<Mesh> {
    let solid = match kind {
        AccessoryKind::EarStuds => studs(fit),
        AccessoryKind::EarRings => rings(fit),
        _ => nose_stud(fit),
    };
    vec![fit.mesh("jewel", solid, material(MaterialKind::Plain, colour, 0.25))]
}

//! Trousers: waistband, fly, pockets, seams, folds at the crotch, the knee and the ankle.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, Side};

use super::band::{Band, BandPath, along_edge};
use super::drape::{DrapeParams, Draping, drape};
use super::fade;
use super::finish::{Fabric, UnrollAxis, Unrolling, cloth_part};
use super::fold::{Fold, Line, Ring, SeededRandom, crease};
use super::seam::{Stitch, sew};
use super::sheet::Sheet;
use super::strip::{LayingSurface, Strip, strip};
use super::wearer::Wearer;
use crate::part::MeshPart;
use crate::torso::cage::{COLUMNS, Key, Tag};
use crate::torso::{CM, Cage, Regions, Shell};
use raconteur_body::skeleton::Bone;

/// Height of the top of the waistband, share of an adult's stature.
const TOP: f64 = 0.580;

/// Style of the leg ends of trousers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LegEnd {
    /// A plain hem that breaks on the shoe.
    Plain,
    /// Turned up outside.
    Rolled,
}

/// Cut of trousers, from which [`trousers`] makes them; centimetres on a body of 175 cm.
#[derive(Clone, Copy, Debug)]
pub struct TrouserCut {
    /// Fabric of the trousers.
    pub fabric: Fabric,
    /// Distance from the body at hip and ankle.
    pub ease_cm: [f64; 2],
    /// Excess of the legs' length, share.
    pub slack: f64,
    /// Height of the folds.
    pub gather: f64,
    /// Style of the leg ends.
    pub end: LegEnd,
    /// Adds patch pockets behind, as on jeans.
    pub back_pockets: bool,
    /// Seed of the folds.
    pub seed: u64,
}

/// Tailors trousers for a body and returns their parts and their surface, on which other garments
/// rest.
#[must_use]
pub fn trousers(wearer: &Wearer<'_>, cut: &TrouserCut) -> (Vec<MeshPart>, Shell) {
    let unit = CM * wearer.scale;
    let mut sheet = draped(wearer, cut);
    let loops = sheet.shell.loops();
    seams(&mut sheet, unit);
    let (charts, hip_x) = charts(wearer);
    let leg_chart = |x: f64| if x > 0.0 { 1 } else { 2 };
    let shell = &sheet.shell;
    let chart_of = |f: usize| match sheet.tags[f] {
        Tag::Trunk(_) => 0,
        Tag::Arm(_) | Tag::Leg(_) => leg_chart(
            shell.faces[f]
                .iter()
                .map(|&v| shell.points[v as usize].x)
                .sum(),
        ),
    };
    let part_of =
        |shell: &Shell, shade: &[f64], fabric: Fabric, chart_of: &dyn Fn(usize) -> usize| {
            let unrolling = Unrolling {
                charts: &charts,
                chart_of,
            };
            cloth_part("trousers", shell, shade, wearer.field, fabric, unrolling)
        };
    let mut parts = vec![part_of(shell, &sheet.shade, cut.fabric, &chart_of)];
    let mut surface = sheet.shell.clone();
    for ring in loops {
        let first = shell.points[ring[0] as usize];
        let is_leg = first.y < 0.3;
        let band = along_edge(shell, &ring, &edge_band(wearer, cut, is_leg));
        let chart = if is_leg { leg_chart(first.x) } else { 0 };
        parts.push(part_of(&band, &[], cut.fabric.shaded(0.96), &|_| chart));
        // The waistband's rim would distort the layers above it.
        if is_leg {
            surface.append(band);
        }
    }
    let lay = LayingSurface::new(&sheet.shell);
    for piece in trimmings(&sheet, &lay, cut, hip_x, unit) {
        parts.push(part_of(&piece, &[], cut.fabric.shaded(0.9), &|_| 0));
    }
    (parts, surface)
}

fn edge_band<'a>(wearer: &Wearer<'a>, cut: &TrouserCut, is_leg: bool) -> Band<'a> {
    let unit = CM * wearer.scale;
    let rolled = cut.end == LegEnd::Rolled;
    let (direction, width, thickness, ease) = match (is_leg, rolled) {
        (false, _) => (DVec3::Y, 2.6, 0.12, 0.4),
        (true, false) => (DVec3::NEG_Y, 2.4, 0.16, cut.ease_cm[1] + 0.2),
        (true, true) => (DVec3::NEG_Y, 4.4, 0.55, cut.ease_cm[1] + 0.3),
    };
    Band {
        direction,
        width: width * unit,
        thickness: thickness * unit,
        ease: ease * unit,
        round: BandPath::Body(wearer.field, Regions::LOWER),
        billow: 0.0,
        every: 1,
    }
}

fn charts(wearer: &Wearer<'_>) -> ([UnrollAxis; 3], f64) {
    let hip_x = wearer.joints.position_of(Bone::LHip).x;
    let chart = |x: f64, radius_cm: f64| UnrollAxis {
        origin: DVec3::new(x, 0.5, 0.0),
        axis: DVec3::Y,
        front: DVec3::Z,
        radius: radius_cm * CM * wearer.scale,
    };
    (
        [chart(0.0, 15.0), chart(hip_x, 8.0), chart(-hip_x, 8.0)],
        hip_x,
    )
}

/// Returns the weight with which the waist and the leg ends are held at their cut positions, 0..1.
fn pins(shell: &Shell, unit: f64) -> Vec<f64> {
    let top = shell.points.iter().map(|p| p.y).fold(f64::MIN, f64::max);
    let mut pin: Vec<f64> = shell
        .points
        .iter()
        .map(|p| fade(p.y, top - 6.0 * unit, top))
        .collect();
    for v in shell.loops().into_iter().flatten() {
        if shell.points[v as usize].y < 0.3 {
            pin[v as usize] = 0.97;
        }
    }
    pin
}

fn draped(wearer: &Wearer<'_>, cut: &TrouserCut) -> Sheet {
    let unit = CM * wearer.scale;
    let joints = wearer.joints;
    let top_row = Cage::row_at(TOP);
    let last_span = Cage::leg_ring_at(1.96);
    let mut sheet = Sheet::extract(wearer.cage, |tag| match tag {
        Tag::Trunk(r) => r < top_row,
        Tag::Arm(_) => false,
        Tag::Leg(j) => j <= last_span,
    });
    let hip = joints.position_of(Bone::LHip);
    let length = hip.y - joints.position_of(Bone::LSubtalar).y;
    let down = (joints.position_of(Bone::LSubtalar) - hip).normalize();
    sheet.settle(
        wearer.field,
        Regions::LOWER,
        |_| 1.8,
        |p| {
            unit * lerp(
                cut.ease_cm[0],
                cut.ease_cm[1],
                fade(hip.y - p.y, 0.1 * length, 0.75 * length),
            )
        },
    );
    let shell = &mut sheet.shell;
    for (p, w) in shell.points.iter_mut().zip(&shell.weights) {
        // The legs never cross the middle.
        if w.leg(Side::Left) > 0.8 {
            p.x = p.x.max(0.35 * CM);
        }
        if w.leg(Side::Right) > 0.8 {
            p.x = p.x.min(-0.35 * CM);
        }
    }
    let pin = pins(shell, unit);
    let folds = folds(&sheet, wearer, cut);
    let shell = &mut sheet.shell;
    let normals = shell.normals();
    let side_of: Vec<Option<Side>> = shell
        .weights
        .iter()
        .map(|w| Side::BOTH.into_iter().find(|s| w.leg(*s) > 0.55))
        .collect();
    let strokes: Vec<Fold> = folds.iter().map(|f| f.1).collect();
    crease(&mut shell.points, &normals, &strokes, |f, v| {
        match folds[f].0 {
            Some(side) => side_of[v] == Some(side),
            None => true,
        }
    });
    let rest = shell
        .points
        .iter()
        .zip(&shell.weights)
        .map(|(p, w)| {
            let mut q = *p;
            for side in Side::BOTH {
                let mirror = DVec3::new(side.sign(), 1.0, 1.0);
                let along = (*p - hip * mirror).dot(down * mirror).max(0.0);
                q += down * mirror * along * cut.slack * fade(w.leg(side), 0.3, 0.9);
            }
            q
        })
        .collect();
    let params = DrapeParams {
        regions: Regions::LOWER,
        seed: cut.seed,
        ..DrapeParams::default()
    };
    let mut cloth = Draping {
        shell: shell.clone(),
        rest,
        pin,
    };
    drape(&mut cloth, &params, wearer.field, &|_| 0.45 * unit);
    sheet.shell = cloth.shell;
    sheet.shell.relax(1);
    sheet
}

/// Returns the folds: whiskers at the crotch, breaks at the knee, the stack on the shoe. `None` may
/// affect the whole cloth, a side only its leg.
fn folds(sheet: &Sheet, wearer: &Wearer<'_>, cut: &TrouserCut) -> Vec<(Option<Side>, Fold)> {
    let unit = CM * wearer.scale;
    let joints = wearer.joints;
    let mut out = Vec::new();
    for side in Side::BOTH {
        let chance = SeededRandom(cut.seed + side.index() as u64);
        let mirror = DVec3::new(side.sign(), 1.0, 1.0);
        let column = |q: usize| {
            if side == Side::Left {
                q
            } else {
                (COLUMNS - q) % COLUMNS
            }
        };
        let trunk = |r: usize, q: usize| sheet.point(Key::Trunk(r, column(q)));
        let leg = |j: usize, k: usize| sheet.point(Key::Leg(side, j, k));
        let lines = [
            (sheet.point(Key::Crotch(0)), trunk(2, 3), 1.0, 0.40),
            (leg(0, 0), trunk(1, 5), 1.2, 0.36),
            (leg(2, 15), leg(0, 5), 1.3, 0.30),
            (sheet.point(Key::Crotch(2)), leg(1, 8), 1.4, 0.40),
            (leg(1, 12), leg(3, 8), 1.3, 0.34),
        ];
        for (n, (from, to, width, height)) in lines.into_iter().enumerate() {
            if let (Some(from), Some(to)) = (from, to) {
                let fold = Line {
                    from,
                    to,
                    bow: DVec3::new(0.0, -0.6 * unit, 0.0),
                    width: width * unit,
                    height: height * cut.gather * (1.0 + 0.3 * chance.sample(6, n)) * unit,
                };
                out.push((None, Fold::Line(fold)));
            }
        }
        let hip = joints.position_of(Bone::LHip) * mirror;
        let down = (joints.position_of(Bone::LSubtalar) * mirror - hip).normalize();
        let thigh = joints
            .position_of(Bone::LKnee)
            .distance(joints.position_of(Bone::LHip));
        let shank = joints
            .position_of(Bone::LSubtalar)
            .distance(joints.position_of(Bone::LKnee));
        let mut ring =
            |n: usize, along: f64, angle: f64, span: f64, tilt_cm: f64, size: [f64; 2]| {
                let fold = Ring {
                    origin: hip,
                    axis: down,
                    front: DVec3::Z,
                    along: along + 0.6 * unit * chance.sample(1, n),
                    angle: angle + 0.3 * chance.sample(2, n),
                    span,
                    tilt: (tilt_cm + 0.4 * chance.sample(3, n)) * unit,
                    width: size[0] * unit,
                    height: size[1] * cut.gather * (1.0 + 0.25 * chance.sample(4, n)) * unit,
                };
                out.push((Some(side), Fold::Ring(fold)));
            };
        // Behind the knee the cloth folds, above it in front it bags.
        for i in 0..4 {
            let way = if i % 2 == 0 { 1.0 } else { -1.0 };
            let along = thigh + (i as f64 - 1.2) * 3.2 * unit;
            ring(
                i,
                along,
                core::f64::consts::PI + 0.5 * way,
                1.7,
                1.4 * way,
                [1.4, 0.5],
            );
        }
        ring(4, thigh - 4.5 * unit, 0.6, 1.2, -1.8, [1.6, 0.34]);
        ring(5, thigh + 5.0 * unit, -0.5, 1.3, 1.6, [1.6, 0.36]);
        // The legs break on the shoe.
        for i in 0..4 {
            let way = if i % 2 == 0 { 1.0 } else { -1.0 };
            let along = thigh + shank * (0.62 + 0.1 * i as f64);
            let height = 0.34 + 0.10 * i as f64;
            ring(6 + i, along, 0.9 * way, 2.2, 1.6 * way, [1.35, height]);
        }
    }
    out
}

/// Sews the outer and the inner seams of the legs, and the seam from the fly between the legs to
/// the back.
fn seams(sheet: &mut Sheet, unit: f64) {
    let top = Cage::row_at(TOP);
    let mut lines = Vec::new();
    for side in Side::BOTH {
        let six = if side == Side::Left { 6 } else { COLUMNS - 6 };
        let hip = (0..=top).rev().map(|r| Key::Trunk(r, six));
        let rings = 0..=Cage::leg_ring_at(2.05);
        let outside = hip.chain(rings.clone().map(|j| Key::Leg(side, j, 6)));
        lines.push(sheet.line(outside));
        let inside = core::iter::once(Key::Crotch(1)).chain(rings.map(|j| Key::Leg(side, j, 14)));
        lines.push(sheet.line(inside));
    }
    let front = (0..=top).rev().map(|r| Key::Trunk(r, 0));
    let back = (0..=top).map(|r| Key::Trunk(r, COLUMNS / 2));
    lines.push(sheet.line(front.chain((0..3).map(Key::Crotch)).chain(back)));
    let stitch = Stitch {
        reach: 0.35 * unit,
        depth: 0.14 * unit,
        swell: 0.07 * unit,
    };
    sew(sheet, &lines, stitch);
}

/// Builds the flap of the fly, the openings of the side pockets and the patch pockets at the back.
fn trimmings(
    sheet: &Sheet,
    lay: &LayingSurface<'_>,
    cut: &TrouserCut,
    hip_x: f64,
    unit: f64,
) -> Vec<Shell> {
    let welt = Strip {
        width: 0.7 * unit,
        thickness: 0.16 * unit,
        closed: false,
    };
    let top = sheet
        .shell
        .points
        .iter()
        .map(|p| p.y)
        .fold(f64::MIN, f64::max);
    let mut out = Vec::new();
    let mut sew_on = |corners: &[DVec3], spacing_cm: f64| {
        out.push(strip(&lay.path(corners, spacing_cm * unit), &welt));
    };
    let v = DVec3::new;
    // The flap turns in below.
    sew_on(
        &[
            v(1.9 * unit, top, 0.3),
            v(1.9 * unit, top - 8.5 * unit, 0.3),
            v(0.2 * unit, top - 11.5 * unit, 0.3),
        ],
        1.2,
    );
    for side in Side::BOTH {
        let s = side.sign();
        sew_on(
            &[
                v(s * (hip_x + 2.6 * unit), top, 0.3),
                v(s * (hip_x + 5.6 * unit), top - 7.0 * unit, 0.2),
                v(s * (hip_x + 7.6 * unit), top - 13.0 * unit, 0.1),
            ],
            1.3,
        );
        if cut.back_pockets {
            let (x, y) = (s * (hip_x + 0.4 * unit), top - 9.0 * unit);
            let (w, h) = (5.4 * unit, 11.5 * unit);
            sew_on(
                &[
                    v(x - w, y, -0.3),
                    v(x - w * 0.92, y - h * 0.8, -0.3),
                    v(x, y - h, -0.3),
                    v(x + w * 0.92, y - h * 0.8, -0.3),
                    v(x + w, y, -0.3),
                    v(x - w, y, -0.3),
                ],
                1.6,
            );
        }
    }
    out
}

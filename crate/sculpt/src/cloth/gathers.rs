//! Gathers of a top: at elbows and cuffs, from the armpits, above the hem.

use raconteur_base::{DVec3, Side};

use super::cut::{ClothZone, Top, TopCut, mirrored_to};
use super::fold::{Fold, Line, Ring, SeededRandom};
use super::wearer::Wearer;
use crate::torso::cage::{HOLE, Key};
use crate::torso::{CM, Cage, Joints};
use raconteur_body::skeleton::Bone;

/// Returns the folds of a top garment with the zones that they affect.
pub(super) fn folds(top: &Top, wearer: &Wearer<'_>, cut: &TopCut) -> Vec<(ClothZone, Fold)> {
    let mut out = Vec::new();
    for side in Side::BOTH {
        sleeve_folds(&mut out, wearer, cut, side);
        chest_folds(&mut out, top, wearer, cut, side);
    }
    waist_folds(&mut out, top, wearer, cut);
    out
}

fn sleeve_folds(out: &mut Vec<(ClothZone, Fold)>, wearer: &Wearer<'_>, cut: &TopCut, side: Side) {
    let unit = CM * wearer.scale;
    let joints = wearer.joints;
    let upper = joints
        .position_of(Bone::LElbow)
        .distance(joints.position_of(Bone::LShoulder));
    let fore = joints
        .position_of(Bone::LWrist)
        .distance(joints.position_of(Bone::LElbow));
    let chance = SeededRandom(cut.seed + side.index() as u64);
    // The inside of the elbow faces forwards.
    let front = side.sign() * core::f64::consts::FRAC_PI_2;
    let mut ring = |n: usize, along: f64, angle: f64, span: f64, tilt_cm: f64, height_cm: f64| {
        let fold = Ring {
            origin: mirrored_to(side, joints.position_of(Bone::LShoulder)),
            axis: mirrored_to(side, Joints::arm_axis()),
            front: mirrored_to(side, Joints::arm_up()),
            along: along + 0.5 * unit * chance.sample(1, n),
            angle: angle + 0.35 * chance.sample(2, n),
            span,
            tilt: (tilt_cm + 0.25 * chance.sample(3, n)) * unit,
            width: (1.15 + 0.2 * chance.sample(4, n)) * unit,
            height: height_cm * cut.gather * (1.0 + 0.25 * chance.sample(5, n)) * unit,
        };
        out.push((ClothZone::Sleeve(side), Fold::Ring(fold)));
    };
    // Soft diagonals on the upper arm, from the armpit outwards.
    ring(0, 0.56 * upper, front + 2.6, 1.5, 1.5, 0.42);
    ring(1, 0.74 * upper, front - 2.2, 1.6, -1.3, 0.48);
    // A zigzag over the inside of the elbow.
    for i in 0..4 {
        let way = if i % 2 == 0 { 1.0 } else { -1.0 };
        let along = upper + (i as f64 - 1.6) * 2.7 * unit;
        ring(2 + i, along, front + 0.5 * way, 2.0, 1.2 * way, 0.70);
    }
    // The forearm's cloth stacks on the cuff.
    for i in 0..4 {
        let way = if i % 2 == 0 { -1.0 } else { 1.0 };
        let along = upper + fore * (0.42 + 0.125 * i as f64);
        ring(
            6 + i,
            along,
            front + 1.9 * way,
            2.3,
            0.9 * way,
            0.50 + 0.06 * i as f64,
        );
    }
}

fn chest_folds(
    out: &mut Vec<(ClothZone, Fold)>,
    top: &Top,
    wearer: &Wearer<'_>,
    cut: &TopCut,
    side: Side,
) {
    let unit = CM * wearer.scale;
    let chance = SeededRandom(cut.seed + 10 + side.index() as u64);
    let column = |q: usize| if side == Side::Left { q } else { (24 - q) % 24 };
    let row = Cage::row_at;
    let at = |r: usize, q: usize| top.sheet.point(Key::Trunk(r, column(q)));
    let mut line =
        |n: usize, from: Option<DVec3>, to: Option<DVec3>, bow: DVec3, size: [f64; 2]| {
            if let (Some(from), Some(to)) = (from, to) {
                let fold = Line {
                    from,
                    to,
                    bow: bow * unit,
                    width: size[0] * (1.0 + 0.15 * chance.sample(1, n)) * unit,
                    height: 1.4 * size[1] * cut.gather * (1.0 + 0.3 * chance.sample(2, n)) * unit,
                };
                out.push((ClothZone::Trunk, Fold::Line(fold)));
            }
        };
    let low = HOLE.0;
    // From the armpit over the chest and the back.
    line(
        0,
        at(low + 1, 4),
        at(row(0.69), 2),
        DVec3::new(0.0, -1.2, 0.0),
        [1.3, 0.38],
    );
    line(
        1,
        at(low, 4),
        at(row(0.65), 3),
        DVec3::new(0.0, -0.8, 0.0),
        [1.4, 0.34],
    );
    line(
        2,
        at(low + 1, 8),
        at(row(0.68), 10),
        DVec3::new(0.0, -1.0, 0.0),
        [1.5, 0.42],
    );
    line(
        3,
        at(low - 1, 7),
        at(row(0.63), 9),
        DVec3::new(0.0, -0.5, 0.0),
        [1.5, 0.34],
    );
    // The cloth falls from the fullest part of the chest to the hip.
    let bow = DVec3::new(side.sign() * 0.8, 0.0, 0.0);
    line(4, at(row(0.70), 3), at(row(0.58), 2), bow, [1.8, 0.34]);
    line(5, at(row(0.69), 4), at(row(0.57), 4), bow, [1.7, 0.30]);
    line(6, at(row(0.70), 8), at(row(0.59), 8), bow, [1.9, 0.30]);
}

/// Adds folds of cloth that slides down and gathers above the hem, more at the sides.
fn waist_folds(out: &mut Vec<(ClothZone, Fold)>, top: &Top, wearer: &Wearer<'_>, cut: &TopCut) {
    let unit = CM * wearer.scale;
    let chance = SeededRandom(cut.seed + 20);
    let hem = top
        .hem
        .iter()
        .map(|&v| top.sheet.shell.points[v as usize].y)
        .fold(f64::MIN, f64::max);
    let origin = DVec3::new(0.0, hem, -1.5 * unit);
    let mut ring = |n: usize, up_cm: f64, angle: f64, span: f64, tilt_cm: f64, size: [f64; 2]| {
        let fold = Ring {
            origin,
            axis: DVec3::NEG_Y,
            front: DVec3::Z,
            along: -(up_cm + 0.6 * chance.sample(1, n)) * unit,
            angle: angle + 0.2 * chance.sample(2, n),
            span,
            tilt: tilt_cm * unit,
            width: size[0] * unit,
            height: size[1] * cut.gather * (1.0 + 0.3 * chance.sample(3, n)) * unit,
        };
        out.push((ClothZone::Trunk, Fold::Ring(fold)));
    };
    ring(0, 2.6, 0.0, 4.0, 0.0, [1.7, 0.42]);
    for (i, way) in [1.0, -1.0].into_iter().enumerate() {
        let n = 10 * (i + 1);
        ring(n, 6.0, 1.35 * way, 1.15, -2.2 * way, [1.5, 0.48]);
        ring(n + 1, 9.6, 1.75 * way, 1.0, 2.6 * way, [1.5, 0.44]);
        ring(n + 2, 13.0, 1.30 * way, 0.9, -2.8 * way, [1.5, 0.36]);
        ring(n + 3, 5.0, 2.6 * way, 0.8, 1.8 * way, [1.6, 0.42]);
        ring(n + 4, 8.4, 0.5 * way, 0.7, 1.4 * way, [1.6, 0.26]);
    }
}

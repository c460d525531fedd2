//! Spine, ribs, breastbone and pelvis. The spine follows the skin of the back, the ribs the chest's
//! wall.

use raconteur_base::curve::lerp;
use raconteur_base::{DMat3, DVec3, Side, mirror_vector, ops};

use super::{Frame, rigid};
use crate::part::MeshPart;
use crate::solid::Solid;
use crate::torso::Regions;
use raconteur_body::skeleton::Bone;

/// Presacral vertebrae: 7 of the neck, 12 of the chest, 5 of the loins, from above.
const VERTEBRAE: usize = 24;
const NECK: usize = 7;
const CHEST: usize = 12;
/// Pairs of ribs that are built; the last two are floating and left out.
const RIBS: usize = 10;

/// The body of a vertebra: centre, and half a vertebra's height.
struct Level {
    centre: DVec3,
    half_height: f64,
    name: String,
    bone: Bone,
}

fn levels(frame: &Frame) -> Vec<Level> {
    let k = frame.scale;
    let top = frame.position_of(Bone::Skull).y - 0.012 * k;
    let bottom = frame.position_of(Bone::Sacroiliac).y + 0.035 * k;
    // Vertebrae grow downwards: 15 mm in the neck, 22 to 27 in the chest, 35 in the loins.
    let pitch = |i: usize| match i {
        0..NECK => 1.0,
        i if i < NECK + CHEST => 1.4 + 0.06 * (i - NECK) as f64,
        _ => 2.25,
    };
    let total: f64 = (0..VERTEBRAE).map(pitch).sum();
    let mut y = top;
    (0..VERTEBRAE)
        .map(|i| {
            let height = pitch(i) / total * (top - bottom);
            let middle = y - height / 2.0;
            y -= height;
            let inside = DVec3::new(0.0, middle, -0.01);
            // The spinous process and the back's muscles lie under the skin.
            let back = frame.exit(inside, DVec3::NEG_Z, Regions::UPPER);
            let depth = lerp(0.044, 0.056, i as f64 / (VERTEBRAE - 1) as f64) * k;
            let centre = inside - DVec3::Z * (back - depth).max(0.0);
            let (name, bone) = match i {
                0..NECK => (format!("cervical{}", i + 1), Bone::Cervical),
                i if i < NECK + CHEST => (format!("thoracic{}", i - NECK + 1), Bone::Thoracic),
                _ => (format!("lumbar{}", i - NECK - CHEST + 1), Bone::Lumbar),
            };
            Level {
                centre,
                half_height: height * 0.42,
                name,
                bone,
            }
        })
        .collect()
}

fn vertebra(level: &Level, index: usize, k: f64) -> Solid {
    let t = index as f64 / (VERTEBRAE - 1) as f64;
    let (wide, deep) = (lerp(0.010, 0.023, t) * k, lerp(0.009, 0.017, t) * k);
    let ring = |y: f64, s: f64| {
        let at = level.centre + DVec3::Y * y * level.half_height;
        (at, DVec3::X * wide * s, DVec3::Z * deep * s)
    };
    let mut solid = Solid::tube(
        &[
            ring(0.75, 1.0),
            ring(0.4, 0.92),
            ring(-0.4, 0.92),
            ring(-0.75, 1.0),
        ],
        10,
    );
    let behind = level.centre - DVec3::Z * (deep + 0.012 * k);
    let spine = Solid::rod(
        &[
            (behind, 0.010 * k, 0.006 * k),
            (
                behind + DVec3::new(0.0, -0.006, -0.008) * k,
                0.003 * k,
                0.006 * k,
            ),
            (
                behind + DVec3::new(0.0, -0.012, -0.014) * k,
                0.003 * k,
                0.005 * k,
            ),
        ],
        DVec3::X,
        8,
    );
    let wings = Solid::rod(
        &[
            (
                behind + DVec3::X * lerp(0.020, 0.032, t) * k,
                0.004 * k,
                0.004 * k,
            ),
            (behind, 0.006 * k, 0.006 * k),
            (
                behind - DVec3::X * lerp(0.020, 0.032, t) * k,
                0.004 * k,
                0.004 * k,
            ),
        ],
        DVec3::Y,
        8,
    );
    solid.append(spine);
    solid.append(wings);
    solid
}

/// Builds one rib of the left side, from its vertebra around the chest to the breastbone or the
/// costal arch.
fn rib(frame: &Frame, index: usize, head: DVec3) -> Solid {
    let k = frame.scale;
    let i = index as f64 / (RIBS - 1) as f64;
    // Upper ribs are short and slope steeply, the longest reach lowest at the side.
    let drop = lerp(0.030, 0.105, i.min(0.7) / 0.7) * k;
    let end = if index < 7 {
        0.18
    } else {
        0.18 + 0.22 * (index - 6) as f64
    };
    let rise = if index < 4 {
        0.0
    } else {
        0.016 * (index - 3) as f64 * k
    };
    let steps = 11;
    let path: Vec<(DVec3, f64, f64)> = (0..=steps)
        .map(|s| {
            let t = f64::from(s) / f64::from(steps);
            let angle = lerp(2.80, end, t);
            let fall = drop * ops::sin(t * core::f64::consts::FRAC_PI_2);
            let lift = rise * ((t - 0.7) / 0.3).max(0.0);
            let axis = DVec3::new(0.0, head.y - fall + lift, head.z + 0.075 * k);
            let (sin, cos) = ops::sincos(angle);
            let way = DVec3::new(sin, 0.0, cos);
            let inset = lerp(0.026, 0.014, t) * k;
            // Where the first ribs pass under the shoulder, the wall is the dome of the chest.
            let dome = lerp(0.062, 0.20, ops::pow(i, 0.55)) * k;
            let out = (frame.exit(axis, way, Regions::LOWER) - inset).min(dome);
            (axis + way * out.max(0.02), 0.006 * k, 0.0035 * k)
        })
        .collect();
    let mut path = path;
    path.insert(0, (head + DVec3::X * 0.012 * k, 0.004 * k, 0.004 * k));
    Solid::rod(&path, DVec3::Y, 6)
}

fn pelvis(frame: &Frame) -> Solid {
    let k = frame.scale;
    let hip = frame.position_of(Bone::LHip);
    let root = frame.position_of(Bone::Sacroiliac);
    let v = |x: f64, y: f64, z: f64| hip + DVec3::new(x, y, z) * k;
    let keep = |s: Solid| s.mapped(|p| frame.inside(p, Regions::LOWER));
    let joint = DVec3::new(0.030 * k, root.y + 0.012 * k, root.z - 0.034 * k);
    let wing = [
        v(0.004, 0.022, 0.004),
        v(0.022, 0.060, 0.034),
        v(0.030, 0.100, 0.012),
        v(0.012, 0.122, -0.022),
        DVec3::new(
            joint.x + 0.012 * k,
            joint.y + 0.038 * k,
            joint.z + 0.004 * k,
        ),
        joint,
        v(-0.022, 0.030, -0.038),
    ];
    let normal = (wing[3] - wing[0])
        .cross(wing[5] - wing[0])
        .try_normalize()
        .unwrap_or(DVec3::X);
    let mut half = Solid::plate(&wing, normal * 0.010 * k);
    half.append(Solid::blob(
        v(-0.010, 0.0, 0.0),
        DMat3::from_diagonal(DVec3::new(0.020, 0.029, 0.028) * k),
        10,
    ));
    let symphysis = DVec3::new(0.006 * k, hip.y - 0.012 * k, hip.z + 0.050 * k);
    let seat = v(-0.022, -0.062, -0.026);
    half.append(Solid::rod(
        &[
            (v(-0.014, 0.004, 0.016), 0.011 * k, 0.010 * k),
            (v(-0.036, 0.0, 0.042), 0.008 * k, 0.007 * k),
            (symphysis, 0.016 * k, 0.007 * k),
        ],
        DVec3::Y,
        8,
    ));
    half.append(Solid::rod(
        &[
            (v(-0.014, -0.008, -0.016), 0.015 * k, 0.013 * k),
            (seat, 0.013 * k, 0.014 * k),
            (v(-0.040, -0.058, 0.008), 0.007 * k, 0.006 * k),
            (symphysis - DVec3::Y * 0.014 * k, 0.007 * k, 0.006 * k),
        ],
        DVec3::X,
        8,
    ));
    let mut out = keep(half.clone());
    out.append(keep(half.mapped(mirror_vector)));
    let top = DVec3::new(0.0, root.y + 0.034 * k, root.z - 0.026 * k);
    let sacrum = Solid::rod(
        &[
            (top, 0.044 * k, 0.018 * k),
            (
                top + DVec3::new(0.0, -0.034, -0.024) * k,
                0.036 * k,
                0.014 * k,
            ),
            (
                top + DVec3::new(0.0, -0.074, -0.034) * k,
                0.022 * k,
                0.009 * k,
            ),
            (
                top + DVec3::new(0.0, -0.112, -0.026) * k,
                0.007 * k,
                0.006 * k,
            ),
        ],
        DVec3::X,
        10,
    );
    out.append(keep(sacrum));
    out
}

/// Builds spine, ribs, breastbone and pelvis.
pub(super) fn parts(frame: &Frame) -> Vec<MeshPart> {
    let k = frame.scale;
    let levels = levels(frame);
    let keep = |s: Solid| s.mapped(|p| frame.inside(p, Regions::UPPER));
    let mut out: Vec<MeshPart> = levels
        .iter()
        .enumerate()
        .map(|(i, level)| rigid(&level.name, keep(vertebra(level, i, k)), level.bone))
        .collect();
    for side in Side::BOTH {
        for i in 0..RIBS {
            let head = levels[NECK + i].centre - DVec3::Z * 0.012 * k;
            let left = rib(frame, i, head);
            let (solid, letter) = match side {
                Side::Left => (left, "l"),
                Side::Right => (left.mapped(mirror_vector), "r"),
            };
            out.push(rigid(
                &format!("{letter}_rib{}", i + 1),
                keep(solid),
                Bone::Thoracic,
            ));
        }
    }
    // The breastbone, from the notch between the collarbones.
    let front = |y: f64, inset: f64| {
        let from = DVec3::new(0.0, y, -0.01);
        from + DVec3::Z * (frame.exit(from, DVec3::Z, Regions::LOWER) - inset * k)
    };
    let (top, low) = (levels[NECK + 2].centre.y, levels[NECK + 8].centre.y);
    let rod = |t: f64, wide: f64| (front(lerp(top, low, t), 0.013), wide * k, 0.005 * k);
    let sternum = Solid::rod(
        &[
            rod(0.0, 0.026),
            rod(0.2, 0.024),
            rod(0.32, 0.012),
            rod(0.7, 0.018),
            rod(0.88, 0.010),
            rod(1.0, 0.004),
        ],
        DVec3::X,
        8,
    );
    out.push(rigid("sternum", keep(sternum), Bone::Thoracic));
    out.push(rigid("pelvis", pelvis(frame), Bone::Sacroiliac));
    out
}

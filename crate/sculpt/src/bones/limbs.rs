//! Collarbones, shoulder blades, and the bones of arms, legs and feet. Lengths come from the
//! figure's joints; widths are designed for an adult of 1.70 m and scaled by stature.

use raconteur_base::{DMat3, DVec3, Side};

use super::{Frame, build_part, rigid};
use crate::part::{JointRef, MeshPart};
use crate::solid::{Section, Solid};
use crate::torso::Regions;
use raconteur_body::skeleton::{Bone, Drive};

/// Builds a long bone between two points: for each share of its length, the offsets towards `side`
/// and `front` and the half widths along them, metres.
fn shaft(
    from: DVec3,
    to: DVec3,
    side: DVec3,
    scale: f64,
    profile: &[(f64, [f64; 2], [f64; 2])],
) -> Solid {
    let along = (to - from).try_normalize().unwrap_or(DVec3::NEG_Y);
    let side = (side - along * side.dot(along))
        .try_normalize()
        .unwrap_or(DVec3::X);
    let front = {
        let f = side.cross(along);
        if f.z < 0.0 { -f } else { f }
    };
    let sections: Vec<Section> = profile
        .iter()
        .map(|&(t, [a, b], [ra, rb])| {
            let p = from.lerp(to, t) + (side * a + front * b) * scale;
            (p, side * ra * scale, front * rb * scale)
        })
        .collect();
    Solid::tube(&sections, 10)
}

fn ball(centre: DVec3, radii: DVec3) -> Solid {
    Solid::blob(centre, DMat3::from_diagonal(radii), 10)
}

/// Builds shoulder girdles, arms, legs and feet.
pub(super) fn parts(frame: &Frame) -> Vec<MeshPart> {
    Side::BOTH
        .into_iter()
        .flat_map(|side| {
            let mut parts = girdle(frame, side);
            parts.extend(arm(frame, side));
            parts.extend(leg(frame, side));
            parts.extend(foot(frame, side));
            parts
        })
        .collect()
}

fn letter(side: Side) -> &'static str {
    if side == Side::Left { "l" } else { "r" }
}

fn girdle(frame: &Frame, side: Side) -> Vec<MeshPart> {
    let (k, out) = (frame.scale, DVec3::X * side.sign());
    let scapula = Bone::on(side, "scapula");
    let shoulder = frame.position_of(Bone::on(side, "shoulder"));
    let v = |x: f64, y: f64, z: f64| DVec3::new(x * side.sign(), y, z) * k;
    let keep = |s: Solid| s.mapped(|p| frame.inside(p, Regions::UPPER));
    // From the top of the breastbone in an S to the tip of the shoulder.
    let notch = frame.position_of(scapula);
    let front = frame.exit(notch, DVec3::Z, Regions::UPPER) - 0.014 * k;
    let sternal = notch + DVec3::Z * front;
    let tip = shoulder + v(0.012, 0.026, 0.004);
    let span = tip - sternal;
    let clavicle = Solid::rod(
        &[
            (sternal, 0.011 * k, 0.010 * k),
            (
                sternal + span * 0.3 + v(0.0, 0.004, 0.010),
                0.0065 * k,
                0.0065 * k,
            ),
            (
                sternal + span * 0.7 + v(0.0, 0.006, -0.008),
                0.0065 * k,
                0.006 * k,
            ),
            (tip, 0.010 * k, 0.005 * k),
        ],
        DVec3::Z,
        8,
    );
    let socket = shoulder + v(-0.024, 0.0, -0.004);
    let upper = shoulder + v(-0.085, 0.028, -0.045);
    let lower = shoulder + v(-0.070, -0.105, -0.062);
    let inner = shoulder + v(-0.098, 0.0, -0.055);
    let lateral = shoulder + v(-0.042, -0.042, -0.034);
    let normal = (lower - upper).cross(socket - upper);
    let normal = normal.try_normalize().unwrap_or(DVec3::Z);
    let blade = Solid::plate(&[socket, upper, inner, lower, lateral], normal * 0.008 * k);
    let behind = |p: DVec3| p - DVec3::Z * 0.010 * k;
    let spine = Solid::rod(
        &[
            (behind(inner + v(0.012, 0.012, 0.004)), 0.006 * k, 0.004 * k),
            (
                behind(shoulder + v(-0.035, 0.020, -0.032)),
                0.010 * k,
                0.005 * k,
            ),
            (shoulder + v(0.006, 0.027, -0.018), 0.012 * k, 0.005 * k),
            (tip + v(0.004, -0.002, -0.004), 0.012 * k, 0.005 * k),
        ],
        out,
        8,
    );
    let mut shoulder_blade = blade;
    shoulder_blade.append(spine);
    shoulder_blade.append(ball(socket, DVec3::new(0.008, 0.018, 0.012) * k));
    let l = letter(side);
    vec![
        rigid(&format!("{l}_clavicle"), keep(clavicle), scapula),
        rigid(&format!("{l}_scapula"), keep(shoulder_blade), scapula),
    ]
}

fn arm(frame: &Frame, side: Side) -> Vec<MeshPart> {
    let k = frame.scale;
    let [shoulder, elbow, wrist] = ["shoulder", "elbow", "wrist"].map(|n| Bone::on(side, n));
    let [a, b, c] = [shoulder, elbow, wrist].map(|bone| frame.position_of(bone));
    let keep = |s: Solid| s.mapped(|p| frame.inside(p, Regions::UPPER));
    // Across the elbow's hinge: up and down with the arm stretched out sideways.
    let along = (c - b).try_normalize().unwrap_or(DVec3::X);
    let up = (DVec3::Y - along * along.y)
        .try_normalize()
        .unwrap_or(DVec3::Y);
    let mut humerus = shaft(
        a,
        b,
        up,
        k,
        &[
            (0.02, [0.010, 0.0], [0.022, 0.022]),
            (0.10, [0.004, 0.0], [0.018, 0.017]),
            (0.22, [0.0, 0.0], [0.0125, 0.012]),
            (0.55, [0.0, 0.0], [0.011, 0.011]),
            (0.82, [0.0, 0.0], [0.015, 0.009]),
            (0.94, [0.0, 0.0], [0.027, 0.009]),
            (0.995, [0.0, 0.002], [0.022, 0.010]),
        ],
    );
    humerus.append(ball(a - up * 0.004 * k, DVec3::splat(0.021 * k)));
    // The thumb's side at the wrist.
    let radial = frame.rotations[wrist.index()] * DVec3::Y;
    let ulna = shaft(
        b - along * 0.012 * k,
        c,
        -radial,
        k,
        &[
            (0.0, [0.006, 0.0], [0.011, 0.012]),
            (0.08, [0.004, 0.0], [0.013, 0.012]),
            (0.2, [0.005, 0.0], [0.0085, 0.008]),
            (0.6, [0.010, 0.0], [0.0065, 0.0065]),
            (0.9, [0.0125, 0.0], [0.006, 0.006]),
            (0.965, [0.0135, 0.0], [0.0078, 0.0078]),
        ],
    );
    // With the palm down the radius crosses the ulna from above to the thumb's side.
    let from = b + up * 0.011 * k + along * 0.006 * k;
    let towards = c + radial * 0.010 * k - along * 0.005 * k;
    let across = radial;
    let rod = |t: f64, wide: f64, thick: f64| {
        let bow = up * 0.006 * k * (4.0 * t * (1.0 - t));
        (from.lerp(towards, t) + bow, wide * k, thick * k)
    };
    let radius = Solid::rod(
        &[
            rod(0.0, 0.0105, 0.0105),
            rod(0.05, 0.010, 0.010),
            rod(0.10, 0.0068, 0.0068),
            rod(0.5, 0.0075, 0.0065),
            rod(0.85, 0.010, 0.0075),
            rod(0.97, 0.0145, 0.0095),
            rod(1.0, 0.0135, 0.009),
        ],
        across,
        10,
    );
    let span = (c - b).dot(along);
    let l = letter(side);
    vec![
        rigid(&format!("{l}_humerus"), keep(humerus), shoulder),
        rigid(&format!("{l}_ulna"), keep(ulna), elbow),
        // Pronation rolls the radius about an axis through its own head: each part of it takes the
        // share of the wrist's twist that lies behind it.
        build_part(&format!("{l}_radius"), keep(radius), |p| {
            let t = ((p - b).dot(along) / span).clamp(0.0, 1.0) * 3.0;
            let stops = [
                Drive::Bone(elbow),
                Drive::Twist(wrist, 1.0 / 3.0),
                Drive::Twist(wrist, 2.0 / 3.0),
            ];
            let i = (t as usize).min(1);
            let share = (t - i as f64).min(1.0);
            vec![
                (JointRef(stops[i]), 1.0 - share),
                (JointRef(stops[i + 1]), share),
            ]
        }),
    ]
}

fn leg(frame: &Frame, side: Side) -> Vec<MeshPart> {
    let (k, out) = (frame.scale, DVec3::X * side.sign());
    let [hip, knee, ankle] = ["hip", "knee", "subtalar"].map(|n| Bone::on(side, n));
    let (a, b, c) = (
        frame.position_of(hip),
        frame.position_of(knee),
        frame.position_of(ankle),
    );
    let keep = |s: Solid| s.mapped(|p| frame.inside(p, Regions::LOWER));
    let mut femur = shaft(
        a,
        b,
        out,
        k,
        &[
            (0.03, [0.045, -0.004], [0.013, 0.014]),
            (0.08, [0.046, -0.004], [0.017, 0.017]),
            (0.16, [0.036, 0.0], [0.016, 0.016]),
            (0.45, [0.020, 0.008], [0.0135, 0.0135]),
            (0.78, [0.006, 0.006], [0.016, 0.014]),
            (0.92, [0.0, -0.002], [0.033, 0.022]),
            (0.985, [0.0, -0.006], [0.036, 0.027]),
        ],
    );
    let neck = Solid::rod(
        &[
            (a, 0.014 * k, 0.014 * k),
            (
                a + (out * 0.046 - DVec3::Y * 0.026) * k,
                0.017 * k,
                0.014 * k,
            ),
        ],
        DVec3::Y,
        10,
    );
    femur.append(neck);
    femur.append(ball(a, DVec3::splat(0.0225 * k)));
    let tibia = shaft(
        b - DVec3::Y * 0.008 * k,
        c + DVec3::Y * 0.022 * k,
        out,
        k,
        &[
            (0.01, [0.0, -0.004], [0.035, 0.024]),
            (0.06, [0.0, 0.0], [0.032, 0.024]),
            (0.16, [-0.003, 0.008], [0.018, 0.018]),
            (0.5, [-0.005, 0.006], [0.0115, 0.013]),
            (0.85, [-0.004, 0.002], [0.011, 0.011]),
            (0.98, [-0.005, 0.0], [0.020, 0.017]),
        ],
    );
    let fibula = shaft(
        b - DVec3::Y * 0.02 * k,
        c + DVec3::Y * 0.008 * k,
        out,
        k,
        &[
            (0.03, [0.034, -0.018], [0.009, 0.009]),
            (0.12, [0.032, -0.017], [0.0055, 0.0055]),
            (0.6, [0.027, -0.012], [0.006, 0.006]),
            (0.92, [0.025, -0.008], [0.008, 0.008]),
            (1.0, [0.025, -0.006], [0.008, 0.010]),
        ],
    );
    let cap = ball(
        b + DVec3::new(0.0, -0.006, 0.031) * k,
        DVec3::new(0.020, 0.022, 0.009) * k,
    );
    let l = letter(side);
    vec![
        rigid(&format!("{l}_femur"), keep(femur), hip),
        rigid(&format!("{l}_patella"), keep(cap), knee),
        rigid(&format!("{l}_tibia"), keep(tibia), knee),
        rigid(&format!("{l}_fibula"), keep(fibula), knee),
    ]
}

/// Builds a foot: heel bone, ankle bone, the midfoot as one block, and five rays of metatarsals and
/// toes.
fn foot(frame: &Frame, side: Side) -> Vec<MeshPart> {
    let k = frame.scale;
    let [ankle, middle, front] = ["subtalar", "midtarsal", "metatarsal"].map(|n| Bone::on(side, n));
    let (a, b, c) = (
        frame.position_of(ankle),
        frame.position_of(middle),
        frame.position_of(front),
    );
    let v = |x: f64, y: f64, z: f64| DVec3::new(x * side.sign(), y, z) * k;
    let l = letter(side);
    let floor = DVec3::new(a.x, 0.0, a.z);
    let heel = Solid::rod(
        &[
            (floor + v(0.0, 0.026, -0.051), 0.014 * k, 0.016 * k),
            (floor + v(0.0, 0.030, -0.026), 0.017 * k, 0.020 * k),
            (floor + v(0.0, 0.034, 0.0), 0.016 * k, 0.017 * k),
            (floor + v(0.006, 0.036, 0.034), 0.014 * k, 0.014 * k),
        ],
        DVec3::X,
        10,
    );
    let talus = ball(
        a + v(-0.002, 0.010, 0.008),
        DVec3::new(0.019, 0.016, 0.026) * k,
    );
    let block = Solid::rod(
        &[
            (b + v(-0.002, 0.018, -0.024), 0.022 * k, 0.014 * k),
            (b + v(0.0, 0.012, 0.006), 0.028 * k, 0.011 * k),
        ],
        DVec3::X,
        10,
    );
    let mut parts = vec![
        rigid(&format!("{l}_calcaneus"), heel, ankle),
        rigid(&format!("{l}_talus"), talus, ankle),
        rigid(&format!("{l}_tarsals"), block, middle),
    ];
    for ray in 0..5 {
        let i = f64::from(ray);
        let (base_x, head_x) = (-0.020 + 0.0105 * i, -0.026 + 0.0145 * i);
        let big: f64 = if ray == 0 { 1.55 } else { 1.0 };
        let from = b + v(base_x, 0.014 - 0.002 * i, 0.012 - 0.003 * i);
        let to = c + v(head_x, 0.012 - 0.001 * i, -0.008 - 0.006 * i * i / 4.0);
        let mid = from.lerp(to, 0.5) + v(0.0, 0.004, 0.0);
        let metatarsal = Solid::rod(
            &[
                (from, 0.006 * k * big.min(1.3), 0.007 * k),
                (mid, 0.0042 * k * big, 0.0045 * k * big),
                (to, 0.006 * k * big, 0.006 * k * big.min(1.3)),
            ],
            DVec3::X,
            8,
        );
        let reach = if ray == 0 { 0.048 } else { 0.036 - 0.004 * i };
        let start = to + v(0.0005, -0.001, 0.010);
        let tip = to + v(0.001, -0.005, 0.010 + reach);
        let toe = Solid::rod(
            &[
                (start, 0.0055 * k * big, 0.005 * k * big.min(1.3)),
                (start.lerp(tip, 0.4), 0.0038 * k * big, 0.0038 * k * big),
                (tip, 0.0042 * k * big, 0.0034 * k * big),
            ],
            DVec3::X,
            8,
        );
        parts.push(rigid(
            &format!("{l}_metatarsal{}", ray + 1),
            metatarsal,
            middle,
        ));
        parts.push(rigid(&format!("{l}_toe{}", ray + 1), toe, front));
    }
    parts
}

//! The ear: one outline, and for each ring a scale and an outward offset.

use raconteur_base::{DVec3, ops};

use super::cage::{Key, Points};
use super::ear_shape::EarShape;

/// (back, up) of the rim, mm, counter-clockwise from the tragus over the top.
const OUTLINE: [[f64; 2]; 18] = [
    [0.0, -1.0],
    [-0.5, 7.0],
    [1.0, 17.0],
    [4.0, 25.0],
    [10.0, 29.5],
    [17.5, 30.5],
    [25.0, 27.5],
    [30.5, 20.5],
    [33.0, 12.5],
    [33.0, 4.0],
    [31.0, -5.0],
    [28.0, -13.0],
    [25.0, -20.0],
    [20.6, -27.0],
    [14.0, -30.4],
    [7.0, -27.6],
    [1.2, -20.0],
    [-0.5, -10.0],
];
/// How much a position belongs to the free rear part.
const REAR: [f64; 18] = [
    0.0, 0.1, 0.5, 0.9, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.95, 0.75, 0.2, 0.0,
];
/// Rings 1..=10: scale and outward offset (mm) of the rear part, then of the front.
const PROFILE: [[f64; 4]; 10] = [
    [0.60, 0.5, 1.22, 0.1],
    [0.78, 2.5, 1.15, 0.1],
    [0.97, 8.0, 1.08, 0.2],
    [1.00, 11.2, 1.00, 0.5],
    [0.93, 12.3, 0.92, 1.2],
    [0.85, 8.6, 0.82, 2.6],
    [0.72, 7.6, 0.68, 4.6],
    [0.60, 10.4, 0.50, 5.2],
    [0.47, 4.5, 0.40, 0.2],
    [0.20, -2.5, 0.20, -3.5],
];

fn bump(k: f64, at: f64, width: f64) -> f64 {
    let d = (k - at) / width;
    ops::exp(-d * d)
}

/// The constrained points of the left ear, mm. The front third of the outer rings is left
/// free, so that it flows into the cheek.
pub(crate) fn ear_points(shape: &EarShape) -> Points {
    let mut points = Points::new();
    let (lean, out) = (
        shape.tilt_deg.to_radians(),
        shape.protrusion_deg.to_radians(),
    );
    for ring in 1..=10usize {
        let [rear_scale, rear_out, front_scale, front_out] = PROFILE[ring - 1];
        for k in 0..18 {
            if (ring <= 2 && (k <= 2 || k >= 15)) || (ring <= 4 && (k == 0 || k >= 16)) {
                continue;
            }
            let at = k as f64;
            let lobe = bump(at, 13.9, 1.5);
            let tragus = bump((at + 9.0) % 18.0, 8.2, 0.9);
            let fossa = bump(at, 5.2, 1.6);
            let rear = REAR[k];
            let mut s = rear * rear_scale + (1.0 - rear) * front_scale;
            let mut w = rear * rear_out + (1.0 - rear) * front_out;
            // The lobe is a flat pad with a round edge as thick as a pencil.
            match ring {
                3 => {
                    w += lobe * (2.6 - w);
                    s += lobe * (0.99 - s);
                }
                4 => {
                    w += lobe * (5.4 - w);
                    s += lobe * (1.03 - s);
                }
                5 => {
                    w += lobe * (8.2 - w);
                    s += lobe * (0.99 - s);
                }
                6 => {
                    w += lobe * (9.2 - w);
                    s += lobe * (0.84 - s);
                }
                7 => {
                    w += lobe * (8.6 - w) + 2.2 * tragus - 1.6 * fossa;
                    s *= 1.0 - 0.2 * lobe;
                }
                8 => {
                    // Antitragus.
                    w += lobe * (9.6 - w) + 4.0 * tragus - 1.0 * fossa;
                    s = s * (1.0 - 0.2 * lobe) - 0.14 * tragus;
                    s *= 1.0 - 0.24 * fossa;
                }
                9 => s *= (1.0 - 0.2 * lobe) * (1.0 - 0.24 * fossa),
                10 => s *= 1.0 - 0.2 * lobe,
                _ => {}
            }
            // The crus of the helix runs into the concha.
            if (k == 1 || k == 2) && (6..=9).contains(&ring) {
                w += [0.2, 0.6, -0.5, 3.0][ring - 6] * if k == 1 { 1.0 } else { 0.4 };
            }
            let [mut a, mut b] = [
                11.0 + s * (OUTLINE[k][0] - 11.0),
                -3.0 + s * (OUTLINE[k][1] + 3.0),
            ];
            if b < -12.0 {
                b -= shape.lobe_drop * ((-12.0 - b) / 14.0).min(1.3);
            }
            a = 11.0 + (a - 11.0) * shape.breadth;
            b *= shape.height;
            w *= shape.breadth;
            let back = a + b * ops::sin(lean) * 0.9;
            let p = DVec3::new(
                72.2 + 0.055 * b + back * ops::sin(out) * 0.62 + w * ops::cos(out),
                b,
                3.5 - (back * ops::cos(out) - w * ops::sin(out) * 0.6),
            );
            points.insert(Key::ear(ring as u8, k), p + shape.shift);
        }
    }
    points
}

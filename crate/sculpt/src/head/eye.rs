//! Eyeballs with their wet layer, and the caruncles.

use core::f64::consts::TAU;

use raconteur_base::{DVec3, Side, ops};

use super::lining::GLOBE_RADIUS_MM;
use crate::part::{JointRef, MeshPart, PartVertex};
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};
use raconteur_body::skeleton::{Bone, Drive};

/// Radius of the cornea's sphere, mm (7.8; Gray's Anatomy; *paper*).
const CORNEA_RADIUS_MM: f64 = 7.8;
/// Distance of the corneal apex in front of the globe's own sphere, mm. Chosen by eye slightly
/// below anatomy, so that the closed lid clears it.
const BULGE_MM: f64 = 0.9;
const SEGMENTS: usize = 24;

/// Rings of a surface of revolution about the z axis; the pole is one vertex.
struct Dome {
    points: Vec<DVec3>,
    faces: Vec<Vec<u32>>,
}

fn dome(angles: &[f64], radius: impl Fn(f64) -> f64) -> Dome {
    let mut points = vec![DVec3::Z * radius(0.0)];
    let mut faces = Vec::new();
    for (ring, &a) in angles.iter().enumerate() {
        let base = points.len() as u32;
        for s in 0..SEGMENTS {
            let turn = TAU * s as f64 / SEGMENTS as f64;
            let d = DVec3::new(
                ops::sin(a) * ops::cos(turn),
                ops::sin(a) * ops::sin(turn),
                ops::cos(a),
            );
            points.push(d * radius(a));
            let (here, next) = (s as u32, ((s + 1) % SEGMENTS) as u32);
            faces.push(match ring {
                0 => vec![0, base + here, base + next],
                _ => {
                    let inner = base - SEGMENTS as u32;
                    vec![inner + here, base + here, base + next, inner + next]
                }
            });
        }
    }
    Dome { points, faces }
}

/// Returns the distance of the cornea's sphere from the centre of the globe at an angle from the
/// optical axis, mm; 0 outside the cornea.
fn cornea_radius(angle: f64) -> f64 {
    let offset = GLOBE_RADIUS_MM + BULGE_MM - CORNEA_RADIUS_MM;
    let c = ops::cos(angle);
    let inside = CORNEA_RADIUS_MM * CORNEA_RADIUS_MM - offset * offset * (1.0 - c * c);
    if inside <= 0.0 {
        0.0
    } else {
        offset * c + inside.sqrt()
    }
}

/// Material parameters of a part of the eye.
struct Look {
    kind: MaterialKind,
    roughness: f32,
    color: [f64; 3],
}

fn part(name: &str, look: &Look, dome: Dome, centre: DVec3, joint: Drive) -> MeshPart {
    let color = look.color;
    let vertices = dome
        .points
        .iter()
        .map(|&p| {
            let d = p.normalize();
            PartVertex {
                position: (centre + p) * 1e-3,
                uv: [0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y],
                color: [color[0], color[1], color[2], 1.0],
                weights: vec![(JointRef(joint), 1.0)],
            }
        })
        .collect();
    MeshPart {
        name: name.to_owned(),
        material: Material {
            kind: look.kind,
            base_color: [1.0; 4],
            roughness: look.roughness,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices,
        faces: dome.faces,
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

/// Builds eyeball, wet layer and caruncle of one side; `iris` is the linear colour of the iris,
/// stored in the eyeball's vertex colour for the shader.
pub(crate) fn eye(
    side: Side,
    centre_mm: DVec3,
    caruncle_mm: DVec3,
    iris: [f64; 3],
) -> Vec<MeshPart> {
    let letter = if side == Side::Left { "left" } else { "right" };
    let even =
        |n: usize, last: f64| -> Vec<f64> { (1..=n).map(|i| last * i as f64 / n as f64).collect() };
    // Beyond 115°, the ball is never visible, for any gaze.
    let ball = dome(&even(16, 2.0), |_| GLOBE_RADIUS_MM - 0.12);
    let wet = dome(&even(12, 1.25), |a| cornea_radius(a).max(GLOBE_RADIUS_MM));
    // Flattened ball in the inner corner, visible from the front only.
    let mut flesh = dome(&even(6, 2.2), |_| 1.0);
    let size = DVec3::new(1.9, 1.0, 0.9);
    for p in &mut flesh.points {
        *p *= size;
    }
    vec![
        part(
            &format!("eye_{letter}"),
            &Look {
                kind: MaterialKind::Eye,
                roughness: 0.25,
                color: iris,
            },
            ball,
            centre_mm,
            Drive::Eye(side),
        ),
        part(
            &format!("cornea_{letter}"),
            &Look {
                kind: MaterialKind::Cornea,
                roughness: 0.05,
                color: [1.0; 3],
            },
            wet,
            centre_mm,
            Drive::Eye(side),
        ),
        part(
            &format!("caruncle_{letter}"),
            &Look {
                kind: MaterialKind::Mouth,
                roughness: 0.65,
                color: [0.20, 0.10, 0.085],
            },
            flesh,
            caruncle_mm,
            Drive::Bone(Bone::Skull),
        ),
    ]
}

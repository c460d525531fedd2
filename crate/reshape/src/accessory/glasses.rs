//! Glasses: rims in front of the eyes, a bridge on the nose, and temples to the ears.

use std::f64::consts::TAU;

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, ops};

use super::solid::Solid;
use super::{AccessoryKind, Fit, landmark, material};
use raconteur_body::figure::{MaterialKind, Mesh};

/// Distance from the centre of the eyeball to the lens, metres: 12 mm to the cornea, and the usual
/// 13 mm to the back of the lens.
const BEFORE_EYE_M: f64 = 0.025;
/// Clearance of the lenses from lashes and cheeks.
const OFF_SKIN_M: f64 = 0.002;
/// The lower rim is nearer to the face by this angle's tangent (pantoscopic tilt of 8°).
const TILT: f64 = 0.14;
/// Rims go back to the sides as on a sphere of this radius (base curve of 4 dioptres).
const CURVE_M: f64 = 0.13;
const POINTS: usize = 48;

/// The rim of a glass.
struct Rim {
    /// Half width and half height of the rim, metres.
    half: [f64; 2],
    /// Exponent of the superellipse: 2 is round, more is square.
    corner: f64,
    radius: f64,
}

impl Rim {
    fn for_kind(kind: AccessoryKind) -> Self {
        match kind {
            AccessoryKind::RoundGlasses => Self {
                half: [0.0222, 0.0215],
                corner: 2.1,
                radius: 0.0009,
            },
            AccessoryKind::SquareGlasses => Self {
                half: [0.0255, 0.0175],
                corner: 3.6,
                radius: 0.0017,
            },
            _ => Self {
                half: [0.0275, 0.021],
                corner: 2.8,
                radius: 0.0016,
            },
        }
    }

    /// Returns a point of the rim relative to its centre, metres, at an angle in radians; x points
    /// outwards.
    fn point(&self, turn: f64) -> [f64; 2] {
        let bent = |x: f64| x.signum() * ops::pow(x.abs(), 2.0 / self.corner);
        [
            self.half[0] * bent(ops::cos(turn)),
            self.half[1] * bent(ops::sin(turn)),
        ]
    }
}

/// Position and orientation of the glasses.
struct Frame {
    rim: Rim,
    /// Middle between the glasses, at the height of the pupils.
    height: f64,
    /// Distance from the middle of the face to the centre of a lens, metres.
    apart: f64,
    front: f64,
}

impl Frame {
    fn new(kind: AccessoryKind, fit: &Fit) -> Self {
        let [left, right] = fit.eyes;
        let mut rim = Rim::for_kind(kind);
        // As wide as the eyes are apart: a child's are smaller.
        let apart = ((left.x - right.x) / 2.0).clamp(0.022, 0.045);
        let size = (apart / 0.0315).clamp(0.75, 1.2);
        rim.half = rim.half.map(|x| x * size);
        // Rims do not touch above the nose.
        let apart = apart.max(rim.half[0] + 0.007);
        let height = (left.y + right.y) / 2.0 - 0.003;
        let mut frame = Self {
            rim,
            height,
            apart,
            front: 0.0,
        };
        let mut front = (left.z + right.z) / 2.0 + BEFORE_EYE_M;
        for side in [1.0, -1.0] {
            for i in 0..POINTS {
                let p = frame.on_rim(side, TAU * i as f64 / POINTS as f64);
                if let Some(skin) = fit.front(p.x, p.y, 0.004) {
                    front = front.max(skin + OFF_SKIN_M - p.z);
                }
            }
        }
        frame.front = front;
        frame
    }

    /// Returns the point of the plane of the glasses at a position of the frontal plane.
    fn plane(&self, x: f64, y: f64) -> DVec3 {
        DVec3::new(
            x,
            y,
            self.front - x * x / (2.0 * CURVE_M) + TILT * (y - self.height),
        )
    }

    fn on_rim(&self, side: f64, turn: f64) -> DVec3 {
        let [x, y] = self.rim.point(turn);
        self.plane(side * (self.apart + x), self.height + y)
    }

    fn rim(&self, side: f64) -> Vec<DVec3> {
        (0..POINTS)
            .map(|i| self.on_rim(side, TAU * i as f64 / POINTS as f64))
            .collect()
    }

    /// Returns the path of the bridge from rim to rim over the nose, metres.
    fn bridge(&self, fit: &Fit) -> Vec<DVec3> {
        let from = self.apart - self.rim.half[0] * 0.97;
        let y = self.height + self.rim.half[1] * 0.38;
        let nose = fit
            .front(0.0, y, 0.004)
            .unwrap_or(self.front)
            .max(fit.position(landmark::SELLION).z);
        (0..=12)
            .map(|i| {
                let t = f64::from(i) / 6.0 - 1.0;
                let rise = 1.0 - t * t;
                let p = self.plane(from * t, y + 0.002 * rise);
                DVec3::new(p.x, p.y, p.z.max(nose + OFF_SKIN_M) + 0.001 * rise)
            })
            .collect()
    }

    /// Returns the path of a temple from the outside of a rim to behind the ear, metres.
    fn bow(&self, side: f64, fit: &Fit) -> Vec<DVec3> {
        let hinge = self.on_rim(side, 0.35);
        // The temple of the glasses lies on the root of the ear, slightly above the tragion, which
        // is at height and depth 0.
        let ear = DVec3::new(0.0, 0.024_f64.min(hinge.y + 0.004), -0.008);
        let points = (0..=16).map(|i| {
            let t = f64::from(i) / 16.0;
            let (y, z) = (lerp(hinge.y, ear.y, smooth(t)), lerp(hinge.z, ear.z, t));
            let skin = fit.side(side, y, z, 0.006).map_or(0.0, |x| x + 0.0015);
            // The ear itself is farther out: the bow passes inside it.
            let skin = if z < 0.012 {
                skin.min(side * hinge.x + 0.004)
            } else {
                skin
            };
            DVec3::new(side * skin.max(side * hinge.x + 0.001), y, z)
        });
        let mut all: Vec<DVec3> = points.collect();
        let last = all[all.len() - 1];
        // Down behind the ear.
        all.extend((1..=6).map(|i| {
            let t = f64::from(i) / 6.0;
            last + DVec3::new(-side * 0.008 * t, -0.026 * t * t, -0.02 * t)
        }));
        all
    }

    fn glass(&self, side: f64) -> Solid {
        let rows: Vec<Vec<DVec3>> = (0..=4)
            .map(|ring| {
                let share = f64::from(ring) / 4.0;
                (0..POINTS)
                    .map(|i| {
                        let [x, y] = self.rim.point(TAU * i as f64 / POINTS as f64);
                        self.plane(side * (self.apart + x * share), self.height + y * share)
                    })
                    .collect()
            })
            .collect();
        Solid::sheet(&rows, true)
    }
}

/// Glasses for a face.
pub(super) fn meshes(kind: AccessoryKind, colour: [f32; 3], fit: &Fit) -> Vec<Mesh> {
    let frame = Frame::new(kind, fit);
    let radius = frame.rim.radius;
    let mut solid = Solid::rod(&frame.bridge(fit), radius * 0.9, false);
    for side in [1.0, -1.0] {
        solid.join(Solid::rod(&frame.rim(side), radius, true));
        solid.join(Solid::rod(&frame.bow(side, fit), radius * 0.85, false));
    }
    let mut all = vec![fit.mesh(
        "glasses",
        solid,
        material(MaterialKind::Plain, colour, 0.35),
    )];
    if kind == AccessoryKind::Sunglasses {
        let mut glass = frame.glass(1.0);
        glass.join(frame.glass(-1.0));
        all.push(fit.mesh(
            "glass",
            glass,
            material(MaterialKind::Plain, [0.012, 0.011, 0.01], 0.12),
        ));
    }
    all
}

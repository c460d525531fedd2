//! Edges of a figure's triangles, rendered without a device; hidden lines are removed.

use raconteur_base::{DVec3, ops};
use raconteur_body::{Figure, MaterialKind};
use raconteur_stage::Camera;

use super::posture::PosedFigure;
use crate::skinning::{skin, world_from_bind};

/// Samples a pixel on each side.
const FINER: usize = 2;
const PAPER: f64 = 0.13;
const SURFACE: f64 = 0.24;
const INK: f64 = 0.86;
/// Depth tolerance of a visible edge in front of the surface, share of the distance.
const BIAS: f64 = 2.0e-3;

/// Point in the image: x and y in samples, z the distance along the view, metres.
type Point = [f64; 3];

struct View {
    camera: Camera,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// Samples per unit of tangent.
    scale: f64,
    size: (usize, usize),
}

impl View {
    fn new(camera: &Camera, size: (usize, usize)) -> Self {
        let forward = (camera.target_in_world - camera.eye_in_world).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(DVec3::Y).normalize_or(DVec3::X);
        Self {
            camera: *camera,
            forward,
            right,
            up: right.cross(forward),
            scale: 0.5 * size.1 as f64 / ops::tan(0.5 * camera.fov_y_rad),
            size,
        }
    }

    /// Projects a point; `None` in front of the near plane.
    fn project(&self, p: DVec3) -> Option<Point> {
        let d = p - self.camera.eye_in_world;
        let z = d.dot(self.forward);
        (z > self.camera.near_m).then(|| {
            let (x, y) = (d.dot(self.right) / z, d.dot(self.up) / z);
            [
                0.5 * self.size.0 as f64 + x * self.scale,
                0.5 * self.size.1 as f64 - y * self.scale,
                z,
            ]
        })
    }
}

struct Canvas {
    size: (usize, usize),
    depth: Vec<f64>,
    grey: Vec<f64>,
}

impl Canvas {
    /// Fills the depth of one triangle.
    fn fill(&mut self, [a, b, c]: [Point; 3]) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area.abs() < 1e-9 {
            return;
        }
        let bound = |k: usize, limit: usize| {
            let low = a[k].min(b[k]).min(c[k]).floor().max(0.0) as usize;
            let high = a[k].max(b[k]).max(c[k]).ceil().clamp(0.0, limit as f64) as usize;
            low..high
        };
        for y in bound(1, self.size.1) {
            for x in bound(0, self.size.0) {
                let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
                let side =
                    |p: Point, q: Point| (q[0] - p[0]) * (py - p[1]) - (q[1] - p[1]) * (px - p[0]);
                let (u, v, w) = (side(b, c) / area, side(c, a) / area, side(a, b) / area);
                if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                    let z = 1.0 / (u / a[2] + v / b[2] + w / c[2]);
                    let at = y * self.size.0 + x;
                    if z < self.depth[at] {
                        self.depth[at] = z;
                        self.grey[at] = SURFACE;
                    }
                }
            }
        }
    }

    /// Draws the unoccluded part of an edge.
    fn line(&mut self, a: Point, b: Point) {
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil();
        if steps > 8.0 * (self.size.0 + self.size.1) as f64 {
            return;
        }
        for i in 0..=steps as usize {
            let t = if steps > 0.0 { i as f64 / steps } else { 0.0 };
            let [x, y, z] = [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t);
            if x < 0.0 || y < 0.0 || x >= self.size.0 as f64 || y >= self.size.1 as f64 {
                continue;
            }
            let at = y as usize * self.size.0 + x as usize;
            if z <= self.depth[at] * (1.0 + BIAS) {
                self.grey[at] = INK;
            }
        }
    }

    /// Returns the opaque RGBA pixels, each the mean of its samples.
    fn rgba(&self) -> Vec<u8> {
        let (w, h) = (self.size.0 / FINER, self.size.1 / FINER);
        let mut out = Vec::with_capacity(4 * w * h);
        for (y, x) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
            let sum: f64 = (0..FINER * FINER)
                .map(|k| {
                    let (dx, dy) = (k % FINER, k / FINER);
                    self.grey[(y * FINER + dy) * self.size.0 + x * FINER + dx]
                })
                .sum();
            let grey = (255.0 * sum / (FINER * FINER) as f64).round() as u8;
            out.extend([grey, grey, grey, 255]);
        }
        out
    }
}

/// Draws skin, clothes and the layers under them; hair and lashes would hide the head.
pub(super) fn draw(
    figure: &Figure,
    posed: &PosedFigure,
    camera: &Camera,
    size: (u32, u32),
) -> Vec<u8> {
    let size = (size.0 as usize * FINER, size.1 as usize * FINER);
    let view = View::new(camera, size);
    let mut canvas = Canvas {
        size,
        depth: vec![f64::MAX; size.0 * size.1],
        grey: vec![PAPER; size.0 * size.1],
    };
    let matrices = world_from_bind(figure, &posed.world_from_joint);
    let hidden = [MaterialKind::Hair, MaterialKind::Lash, MaterialKind::Cornea];
    let mut triangles: Vec<[Point; 3]> = Vec::new();
    for mesh in &figure.meshes {
        if hidden.contains(&mesh.material.kind) {
            continue;
        }
        let skinned = skin(mesh, &matrices, &posed.morph_weights, &posed.tissue);
        let points: Vec<Option<Point>> =
            skinned.positions.iter().map(|p| view.project(*p)).collect();
        triangles.extend(mesh.indices.chunks_exact(3).filter_map(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| points[i as usize]);
            Some([a?, b?, c?])
        }));
    }
    for &triangle in &triangles {
        canvas.fill(triangle);
    }
    for [a, b, c] in triangles {
        canvas.line(a, b);
        canvas.line(b, c);
        canvas.line(c, a);
    }
    canvas.rgba()
}

//! Ambient occlusion of vertices: the mesh is rendered as a depth map from many directions, and
//! each vertex counts the directions from which it is visible.

use raconteur_base::{DVec3, ops};

const DIRECTIONS: usize = 96;
/// Side of a depth map, pixels.
const SIZE: usize = 320;

struct View {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
    low: [f64; 2],
    pixels_per_unit: f64,
    depth: Vec<f64>,
}

impl View {
    fn new(points: &[DVec3], toward: DVec3) -> Self {
        let helper = if toward.y.abs() < 0.9 {
            DVec3::Y
        } else {
            DVec3::X
        };
        let right = helper.cross(toward).normalize();
        let up = toward.cross(right);
        let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
        for p in points {
            for (axis, x) in [p.dot(right), p.dot(up)].into_iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        let extent = (high[0] - low[0]).max(high[1] - low[1]).max(1e-9);
        Self {
            right,
            up,
            toward,
            low,
            pixels_per_unit: (SIZE - 1) as f64 / extent,
            depth: vec![f64::MIN; SIZE * SIZE],
        }
    }

    fn project(&self, p: DVec3) -> DVec3 {
        DVec3::new(
            (p.dot(self.right) - self.low[0]) * self.pixels_per_unit,
            (p.dot(self.up) - self.low[1]) * self.pixels_per_unit,
            p.dot(self.toward),
        )
    }

    fn draw(&mut self, [a, b, c]: [DVec3; 3]) {
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area.abs() < 1e-12 {
            return;
        }
        let range = |x: [f64; 3]| {
            let low = x[0].min(x[1]).min(x[2]).floor().max(0.0) as usize;
            let high = x[0].max(x[1]).max(x[2]).ceil().max(0.0) as usize;
            low..=high.min(SIZE - 1)
        };
        for y in range([a.y, b.y, c.y]) {
            for x in range([a.x, b.x, c.x]) {
                let (px, py) = (x as f64, y as f64);
                let u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
                let v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
                let w = 1.0 - u - v;
                if u >= -1e-9 && v >= -1e-9 && w >= -1e-9 {
                    let z = u * a.z + v * b.z + w * c.z;
                    let slot = &mut self.depth[y * SIZE + x];
                    *slot = slot.max(z);
                }
            }
        }
    }

    fn sees(&self, p: DVec3, bias: f64) -> bool {
        let q = self.project(p);
        let (x, y) = (q.x.round(), q.y.round());
        if x < 0.0 || y < 0.0 || x >= SIZE as f64 || y >= SIZE as f64 {
            return true;
        }
        self.depth[y as usize * SIZE + x as usize] <= q.z + bias
    }
}

/// Returns the cosine-weighted share of the open hemisphere at each receiver (position, normal),
/// 0..1. `bias` lifts receivers off the occluding surface, in the unit of the surface.
pub(crate) fn openness(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    receivers: &[(DVec3, DVec3)],
    bias: f64,
) -> Vec<f64> {
    let mut open = vec![0.0; receivers.len()];
    let mut all = vec![0.0; receivers.len()];
    let golden = core::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    for i in 0..DIRECTIONS {
        // Fibonacci sphere.
        let y = 1.0 - 2.0 * (i as f64 + 0.5) / DIRECTIONS as f64;
        let r = (1.0 - y * y).sqrt();
        let turn = golden * i as f64;
        let toward = DVec3::new(r * ops::cos(turn), y, r * ops::sin(turn));
        let mut view = View::new(points, toward);
        let projected: Vec<DVec3> = points.iter().map(|&p| view.project(p)).collect();
        for t in triangles {
            view.draw(t.map(|v| projected[v as usize]));
        }
        for (n, &(p, normal)) in receivers.iter().enumerate() {
            let cosine = normal.dot(toward);
            if cosine > 0.0 {
                all[n] += cosine;
                if view.sees(p + normal * bias, bias) {
                    open[n] += cosine;
                }
            }
        }
    }
    open.iter()
        .zip(&all)
        .map(|(o, a)| if *a > 0.0 { o / a } else { 1.0 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lid_over_a_floor_hides_it_and_is_open_itself() {
        let quad =
            |y: f64, s: f64| [[-s, -s], [-s, s], [s, s], [s, -s]].map(|[x, z]| DVec3::new(x, y, z));
        let points: Vec<DVec3> = quad(0.0, 10.0).into_iter().chain(quad(1.0, 10.0)).collect();
        let t = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let at = [(DVec3::ZERO, DVec3::Y), (DVec3::Y, DVec3::Y)];
        let open = openness(&points, &t, &at, 0.05);
        assert!(open[0] < 0.05 && open[1] > 0.95, "{open:?}");
    }
}

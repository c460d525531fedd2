//! Hand data for the skin's baking: regions, creases, slack lines, veins.

use raconteur_base::{DVec3, curve, noise, ops};

use super::anatomy::{Anatomy, FINGER_COUNT, Finger};
use super::chart::Chart;
use super::crease::CREASES;
use super::nail::Nail;
use super::surface::{Skin, bell};

/// Skin of the hand as input of the texture baking. Both hands share it as mirror images.
#[derive(Clone, Debug, Default)]
pub(crate) struct HandSheet {
    /// Texture coordinates of each vertex in the atlas, 0..1.
    pub(crate) uv: Vec<[f64; 2]>,
    /// Triangles.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Vertex positions of the right hand, frame of its anatomy (radial, distal, palmar), mm.
    pub(crate) at: Vec<DVec3>,
    /// Unit normals.
    pub(crate) normals: Vec<DVec3>,
    /// Anatomical region of each vertex.
    pub(crate) regions: Vec<HandRegion>,
    /// Lines that every hand has: depth in mm.
    pub(crate) creases: Vec<HandLine>,
    /// Lines of slack and aged skin, painted by age.
    pub(crate) slack: Vec<HandLine>,
    /// Courses of the veins on the back.
    pub(crate) veins: Vec<HandLine>,
}

/// Line on the skin of the hand, for example a crease or a vein, which the texture baker paints.
#[derive(Clone, Debug)]
pub(crate) struct HandLine {
    /// Points on the surface, mm.
    pub(crate) through: Vec<DVec3>,
    /// Depth or strength.
    pub(crate) strength: f64,
    /// Half width of the line, mm.
    pub(crate) width: f64,
    /// Share of its length lost to gaps.
    pub(crate) broken: f64,
}

/// Membership of a vertex in the regions of the hand, each 0..1.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HandRegion {
    /// Palm and inner side of the fingers.
    pub(crate) palm: f64,
    /// Fingertip, inner side.
    pub(crate) tip: f64,
    /// Membership in the skin over a joint on the back.
    pub(crate) knuckle: f64,
    /// Around a nail.
    pub(crate) nail: f64,
    /// Balls of the thumb and the little finger, heads of the metacarpals.
    pub(crate) cushion: f64,
}

/// Collects all of it.
pub(super) fn sheet(anatomy: &Anatomy, skin: &Skin, chart: &Chart) -> HandSheet {
    let of = |v: &u32| *v as usize;
    let regions: Vec<HandRegion> = (0..skin.positions.len())
        .map(|v| {
            region(
                anatomy,
                skin.positions[v],
                skin.normals[v],
                &skin.ownership[v],
            )
        })
        .collect();
    let mut drawing = Drawing {
        skin,
        drawn: 0,
        lines: Vec::new(),
    };
    drawing.palm();
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        drawing.finger(finger, f);
    }
    let creases = core::mem::take(&mut drawing.lines);
    drawing.slack(anatomy);
    let slack = core::mem::take(&mut drawing.lines);
    drawing.veins(anatomy);
    HandSheet {
        uv: chart.uv.clone(),
        triangles: chart
            .faces
            .iter()
            .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
            .collect(),
        at: chart.source.iter().map(|v| skin.positions[of(v)]).collect(),
        normals: chart.source.iter().map(|v| skin.normals[of(v)]).collect(),
        regions: chart.source.iter().map(|v| regions[of(v)]).collect(),
        creases,
        slack,
        veins: drawing.lines,
    }
}

fn region(anatomy: &Anatomy, p: DVec3, normal: DVec3, owned: &[f64; FINGER_COUNT]) -> HandRegion {
    let body = 1.0 - curve::smooth(owned.iter().sum());
    let mut r = HandRegion {
        palm: curve::smooth((normal.z + 0.15) / 0.6) * body,
        ..HandRegion::default()
    };
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        let mine = curve::smooth((owned[f] - 0.3) / 0.5);
        if mine > 0.0 {
            let local = finger.local(p);
            let section = finger.section(local.y);
            let q = finger.joint_coordinate(local.y);
            let height = local.z / section.palmar;
            let inner = curve::smooth((height + 0.2) / 0.6);
            r.palm = r.palm.max(inner * mine);
            r.tip = r.tip.max(mine * inner * curve::smooth((q - 2.2) / 0.5));
            let dorsal = curve::smooth((-local.z / section.dorsal - 0.2) / 0.6);
            for joint in &finger.joints()[1..3] {
                r.knuckle = r.knuckle.max(mine * dorsal * bell((local.y - joint) / 6.0));
            }
            if local.z < 0.0 {
                let (e, v) = Nail::for_finger(f).outline(finger, local);
                let fold = bell((e - 0.6) / 1.4) * curve::smooth((0.95 - v) / 0.3);
                r.nail = r.nail.max(mine * fold);
            }
        }
        if f > 0 {
            let knuckle = finger.origin - DVec3::Z * 12.0;
            r.knuckle = r.knuckle.max(0.9 * bell((p - knuckle).length() / 9.0));
        }
    }
    let at = |x: f64, y: f64, z: f64| bell((p - DVec3::new(x, y, z)).length() / 19.0);
    let heads = bell((p.y - 90.0) / 9.0) * f64::from(u8::from(p.z > 5.0));
    r.cushion = r.palm
        * at(-26.0, 34.0, 20.0)
            .max(at(28.0, 28.0, 30.0))
            .max(0.6 * heads);
    r
}

struct Drawing<'a> {
    skin: &'a Skin,
    drawn: u64,
    lines: Vec<HandLine>,
}

impl Drawing<'_> {
    fn between(&mut self, a: f64, b: f64) -> f64 {
        self.drawn += 1;
        a + (b - a) * noise::unit(0x4A4D, self.drawn, 0)
    }

    /// Projects x and y to the surface of the back (−1) or palm (1).
    fn drop(&self, x: f64, y: f64, side: f64) -> DVec3 {
        let d = |v: &usize| {
            let p = self.skin.positions[*v];
            (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)
        };
        let near = (0..self.skin.positions.len())
            .filter(|&v| self.skin.normals[v].z * side > 0.3)
            .min_by(|a, b| d(a).total_cmp(&d(b)));
        DVec3::new(x, y, near.map_or(0.0, |v| self.skin.positions[v].z))
    }

    fn put(&mut self, through: Vec<DVec3>, strength: f64, width: f64, broken: f64) {
        self.lines.push(HandLine {
            through,
            strength,
            width,
            broken,
        });
    }

    fn palm(&mut self) {
        for crease in &CREASES {
            let through: Vec<DVec3> = crease
                .points
                .iter()
                .map(|&(x, y)| self.drop(x, y, 1.0))
                .collect();
            self.put(through.clone(), 0.45 * crease.depth_mm, 0.75, 0.12);
            // A finer one runs along it.
            let beside = through
                .iter()
                .map(|p| *p + DVec3::new(1.4, 1.1, 0.0))
                .collect();
            self.put(beside, 0.10 * crease.depth_mm, 0.45, 0.7);
        }
        for _ in 0..46 {
            let (x, y) = (self.between(-32.0, 26.0), self.between(8.0, 80.0));
            let (dx, dy) = (self.between(-9.0, 9.0), self.between(-11.0, 11.0));
            let bow = self.between(-1.5, 1.5);
            let through = vec![
                self.drop(x, y, 1.0),
                self.drop(x + 0.5 * dx + bow, y + 0.5 * dy, 1.0),
                self.drop(x + dx, y + dy, 1.0),
            ];
            let depth = self.between(0.04, 0.12);
            self.put(through, depth, 0.45, 0.35);
        }
    }

    /// Across a finger at a distance along it, on the back (−1) or the inner side (1), from
    /// one share of the half width to another; the ends lean by `lean` mm.
    fn ring(finger: &Finger, along: f64, side: f64, from: f64, to: f64, lean: f64) -> Vec<DVec3> {
        (0..=8)
            .map(|i| {
                let t = from + (to - from) * f64::from(i) / 8.0;
                let y = along + lean * t * t;
                let s = finger.section(y);
                let height = if side < 0.0 { s.dorsal } else { s.palmar };
                let rest = ops::pow(1.0 - ops::pow(t.abs().min(0.98), 2.3), 1.0 / 2.3);
                finger.point(DVec3::new(t * s.half_width, y, side * height * rest))
            })
            .collect()
    }

    fn finger(&mut self, finger: &Finger, f: usize) {
        let joints = finger.joints();
        for (k, lines) in [(1, 3), (2, 2)] {
            for i in 0..lines {
                let off = 1.7 * (f64::from(i) - f64::from(lines - 1) / 2.0);
                let (a, b) = (self.between(0.7, 0.95), self.between(0.7, 0.95));
                let off = off + self.between(-0.3, 0.3);
                let through = Self::ring(finger, joints[k] + off, 1.0, -a, b, -0.8);
                let depth = self.between(0.20, 0.34) * if i == 1 || lines == 1 { 1.0 } else { 0.6 };
                self.put(through, depth, 0.6, 0.1);
            }
        }
        if f > 0 {
            for off in [-0.6, 1.3] {
                let through = Self::ring(finger, finger.along(0.405) + off, 1.0, -0.9, 0.9, -0.6);
                self.put(through, 0.22, 0.6, 0.2);
            }
        }
        // Slack skin over the joints, straight across in the middle and bowed away from it
        // at the ends.
        for (k, reach, lines) in [(1, 5.4, 9), (2, 2.9, 6)] {
            for i in 0..lines {
                let off = reach * (2.0 * f64::from(i) / f64::from(lines - 1) - 1.0);
                let along = joints[k] + off + self.between(-0.35, 0.35);
                let (a, b) = (self.between(0.3, 0.8), self.between(0.3, 0.8));
                let through = Self::ring(finger, along, -1.0, -a, b, 0.45 * off);
                let depth = self.between(0.12, 0.26) * (1.0 - 0.4 * (off / reach).abs());
                self.put(through, depth, 0.5, 0.2);
            }
        }
    }

    /// Adds the crossing fine lines on the back of the hand, with the strength of old age.
    fn slack(&mut self, anatomy: &Anatomy) {
        for _ in 0..170 {
            let (x, y) = (self.between(-36.0, 30.0), self.between(-6.0, 84.0));
            let across = self.between(-1.0, 1.0) > -0.2;
            let long = self.between(5.0, 15.0);
            let (dx, dy) = if across {
                (long, self.between(-0.35, 0.35) * long)
            } else {
                (self.between(-0.7, 0.7) * long, 0.8 * long)
            };
            let bow = self.between(-1.2, 1.2);
            let through = vec![
                self.drop(x, y, -1.0),
                self.drop(x + 0.5 * dx, y + 0.5 * dy + bow, -1.0),
                self.drop(x + dx, y + dy, -1.0),
            ];
            let depth = self.between(0.05, 0.17);
            self.put(through, depth, 0.5, 0.3);
        }
        for finger in &anatomy.fingers {
            let joints = finger.joints();
            for _ in 0..22 {
                let q = self.between(0.35 * joints[1], joints[2] - 2.0);
                let (a, b) = (self.between(-0.8, 0.2), self.between(0.1, 0.8));
                let lean = self.between(-2.5, 2.5);
                let through = Self::ring(finger, q, -1.0, a, a.max(b), lean);
                let depth = self.between(0.05, 0.14);
                self.put(through, depth, 0.42, 0.3);
            }
        }
    }

    /// Adds the dorsal network: a vein between each two knuckles, arches that join them, and the
    /// cephalic and basilic stems at the wrist. Strength 0..1.
    fn veins(&mut self, anatomy: &Anatomy) {
        let mut stems = Vec::new();
        for f in 1..4 {
            let mid = (anatomy.fingers[f].origin + anatomy.fingers[f + 1].origin) / 2.0;
            let (a, b) = (self.between(-3.0, 3.0), self.between(-4.0, 4.0));
            let foot = mid.x * 0.55;
            let at = |x: f64, y: f64| self.drop(x, y, -1.0);
            let through = vec![
                at(mid.x, mid.y - 2.0),
                at(mid.x * 0.9 + a, mid.y - 22.0),
                at((mid.x + foot) / 2.0 + b, 38.0),
                at(foot, 14.0),
                at(foot + 0.5 * a, -12.0),
                at(foot - 0.4 * b, -45.0),
            ];
            stems.push(through.clone());
            self.put(through, 0.9, 1.7, 0.25);
        }
        for (a, b) in [(0, 1), (1, 2)] {
            let (i, j) = (2 + a % 2, 1 + b % 2);
            let through = vec![
                stems[a][i],
                (stems[a][i] + stems[b][j]) / 2.0 + DVec3::Y * 3.0,
                stems[b][j],
            ];
            self.put(through, 0.7, 1.4, 0.2);
        }
        let at = |x: f64, y: f64| self.drop(x, y, -1.0);
        let thumb = vec![
            at(26.0, 52.0),
            at(21.0, 34.0),
            at(22.0, 10.0),
            at(24.0, -20.0),
        ];
        self.put(thumb, 0.75, 1.6, 0.25);
    }
}

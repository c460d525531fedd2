//! Seams: along selected edges, the stitches draw the cloth in.
//!
//! The faces next to a seam are split a few millimetres from it, so that the groove is narrow for
//! any face size, and the cloth stays one surface.

use std::collections::{BTreeMap, BTreeSet};

use super::sheet::Sheet;
use crate::torso::weights::Weights;

/// Dimensions of a sewn seam in cloth; metres.
#[derive(Clone, Copy, Debug)]
pub struct Stitch {
    /// Half width of the groove, metres.
    pub reach: f64,
    /// Depth of the seam.
    pub depth: f64,
    /// Height of the swelling of the cloth next to the seam.
    pub swell: f64,
}

fn edge(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Sews all the lines in one pass: they may cross, and may end only at the cloth's edges or on each
/// other.
pub fn sew(sheet: &mut Sheet, lines: &[Vec<u32>], stitch: Stitch) {
    let mut seam: BTreeSet<(u32, u32)> = BTreeSet::new();
    let mut on: BTreeSet<u32> = BTreeSet::new();
    for line in lines {
        seam.extend(line.windows(2).map(|w| edge(w[0], w[1])));
        on.extend(line);
    }
    let normals = sheet.shell.normals();
    let mut split = Splits {
        sheet: &mut *sheet,
        made: BTreeMap::new(),
        stitch,
    };
    let (old_faces, old_tags) = (
        core::mem::take(&mut split.sheet.shell.faces),
        core::mem::take(&mut split.sheet.tags),
    );
    for (face, tag) in old_faces.into_iter().zip(old_tags) {
        let pieces = split.pieces(&face, &seam, &on);
        split
            .sheet
            .tags
            .extend(core::iter::repeat_n(tag, pieces.len()));
        split.sheet.shell.faces.extend(pieces);
    }
    let beside: Vec<(u32, u32)> = split.made.iter().map(|(k, v)| (k.0, *v)).collect();
    for (s, m) in beside {
        sheet.shell.points[m as usize] += normals[s as usize] * stitch.swell;
    }
    for &v in &on {
        sheet.shell.points[v as usize] -= normals[v as usize] * stitch.depth;
        sheet.shade[v as usize] = 0.5;
    }
}

struct Splits<'a> {
    sheet: &'a mut Sheet,
    /// Points next to a seam point, keyed by the point and its neighbour.
    made: BTreeMap<(u32, u32), u32>,
    stitch: Stitch,
}

impl Splits<'_> {
    fn beside(&mut self, s: u32, o: u32) -> u32 {
        if let Some(&v) = self.made.get(&(s, o)) {
            return v;
        }
        let shell = &mut self.sheet.shell;
        let (p, q) = (shell.points[s as usize], shell.points[o as usize]);
        let t = (self.stitch.reach / p.distance(q).max(1e-6)).min(0.4);
        let w = shell.weights[s as usize].lerp(&shell.weights[o as usize], t);
        shell.points.push(p.lerp(q, t));
        shell.weights.push(w);
        self.sheet.shade.push(1.0);
        let v = self.sheet.shell.points.len() as u32 - 1;
        self.made.insert((s, o), v);
        v
    }

    /// Returns a point inside a face, near its corner `a` towards the opposite one.
    fn inside(&mut self, face: &[u32], a: usize) -> u32 {
        let at = |i: usize| face[(a + i) % 4];
        let [p, b, c, d] = [0, 1, 2, 3].map(|i| self.sheet.shell.points[at(i) as usize]);
        let s = (self.stitch.reach / p.distance(b).max(1e-6)).min(0.4);
        let t = (self.stitch.reach / p.distance(d).max(1e-6)).min(0.4);
        let corners = [
            (at(0), (1.0 - s) * (1.0 - t)),
            (at(1), s * (1.0 - t)),
            (at(2), s * t),
            (at(3), (1.0 - s) * t),
        ];
        let shell = &mut self.sheet.shell;
        let point = p * corners[0].1 + b * corners[1].1 + c * corners[2].1 + d * corners[3].1;
        let w = Weights::mix(
            corners
                .iter()
                .map(|&(v, w)| (&shell.weights[v as usize], w)),
        );
        shell.points.push(point);
        shell.weights.push(w);
        self.sheet.shade.push(1.0);
        self.sheet.shell.points.len() as u32 - 1
    }

    fn pieces(
        &mut self,
        face: &[u32],
        seam: &BTreeSet<(u32, u32)>,
        on: &BTreeSet<u32>,
    ) -> Vec<Vec<u32>> {
        let whole = vec![face.to_vec()];
        if face.len() != 4 || !face.iter().any(|v| on.contains(v)) {
            return whole;
        }
        let is_seam = |i: usize| seam.contains(&edge(face[i % 4], face[(i + 1) % 4]));
        let sewn: Vec<usize> = (0..4).filter(|&i| is_seam(i)).collect();
        match sewn[..] {
            [] => {
                let Some(a) = (0..4).find(|&i| on.contains(&face[i])) else {
                    return whole;
                };
                let [a0, b, c, d] = [0, 1, 2, 3].map(|i| face[(a + i) % 4]);
                let x = self.inside(face, a);
                let (m, n) = (self.beside(a0, b), self.beside(a0, d));
                vec![vec![a0, m, x, n], vec![m, b, c, x], vec![n, x, c, d]]
            }
            [i] => {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| face[(i + k) % 4]);
                let (m, n) = (self.beside(a, d), self.beside(b, c));
                vec![vec![a, b, n, m], vec![m, n, c, d]]
            }
            [i, j] if j == i + 2 => {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| face[(i + k) % 4]);
                let (m, n) = (self.beside(a, d), self.beside(b, c));
                let (o, p) = (self.beside(c, b), self.beside(d, a));
                vec![vec![a, b, n, m], vec![m, n, o, p], vec![p, o, c, d]]
            }
            [i, j] => {
                // The corner between both: after the first of two that follow each other.
                let first = if j == i + 1 { i } else { j };
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| face[(first + k) % 4]);
                let x = self.inside(face, (first + 1) % 4);
                let (m, n) = (self.beside(a, d), self.beside(c, d));
                vec![vec![a, b, x, m], vec![b, c, n, x], vec![m, x, n, d]]
            }
            _ => whole,
        }
    }
}

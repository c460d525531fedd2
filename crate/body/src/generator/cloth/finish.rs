//! From draped shells to parts: texture coordinates in metres, occlusion, colours.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, ops};

use crate::figure::{Maps, Material, MaterialKind};
use crate::generator::part::{Part, PartVertex};
use crate::generator::torso::{Field, Regions, Shell};

/// A straight axis about which cloth is unrolled.
#[derive(Clone, Copy, Debug)]
pub struct Chart {
    /// A point of the axis.
    pub origin: DVec3,
    /// Along the axis; v grows this way.
    pub axis: DVec3,
    /// Where the angle is zero, away from the seam.
    pub front: DVec3,
    /// Metres of u in one radian.
    pub radius: f64,
}

impl Chart {
    fn angle(&self, p: DVec3) -> f64 {
        let d = p - self.origin;
        ops::atan2(d.dot(self.front.cross(self.axis)), d.dot(self.front))
    }

    fn along(&self, p: DVec3) -> f64 {
        (p - self.origin).dot(self.axis)
    }
}

/// Occlusion of a surface point by the body: steps along the normal that the field's
/// distance falls short of.
#[must_use]
pub fn openness(field: &Field, p: DVec3, normal: DVec3) -> f64 {
    let mut shortfall = 0.0;
    let mut weight = 0.5;
    for h in [0.02, 0.05, 0.10, 0.18] {
        let d = field.value(p + normal * h, Regions::ALL, 1.0);
        shortfall += weight * ((h - d) / h).clamp(0.0, 1.0);
        weight *= 0.8;
    }
    (1.0 - 0.75 * shortfall).clamp(0.12, 1.0)
}

/// How far folds hide each point: the mean of the neighbours above the tangent plane,
/// over the edges' length.
fn fold_openness(shell: &Shell, normals: &[DVec3]) -> Vec<f64> {
    let (around, _) = shell.neighbours();
    let mut out: Vec<f64> = (0..shell.points.len())
        .map(|v| {
            let p = shell.points[v];
            let (mut rise, mut length) = (0.0, 1e-9);
            for &i in &around[v] {
                let d = shell.points[i as usize] - p;
                rise += d.dot(normals[v]);
                length += d.length();
            }
            rise / length
        })
        .collect();
    for _ in 0..2 {
        let before = out.clone();
        for (v, x) in out.iter_mut().enumerate() {
            let sum: f64 = around[v].iter().map(|&i| before[i as usize]).sum();
            *x = 0.5 * *x + 0.5 * sum / around[v].len().max(1) as f64;
        }
    }
    out.into_iter()
        .map(|rise| (1.0 - 2.2 * rise.max(0.0)).clamp(0.45, 1.0))
        .collect()
}

/// Makes a part of a shell; `chart_of` gives the index of each face's chart.
#[must_use]
pub fn cloth_part(
    name: &str,
    shell: &Shell,
    field: &Field,
    material: &Material,
    charts: &[Chart],
    chart_of: impl Fn(usize) -> usize,
) -> Part {
    let normals = shell.normals();
    let folds = fold_openness(shell, &normals);
    let open: Vec<f64> = (0..shell.points.len())
        .map(|v| folds[v] * openness(field, shell.points[v], normals[v]))
        .collect();
    let mut part = Part {
        name: name.to_owned(),
        material: material.clone(),
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
    };
    // A vertex is doubled where charts meet and where a chart closes on itself.
    let mut made: BTreeMap<(u32, usize, i32), u32> = BTreeMap::new();
    for (f, face) in shell.faces.iter().enumerate() {
        let index = chart_of(f);
        let chart = &charts[index];
        let centre: DVec3 = face
            .iter()
            .map(|&v| shell.points[v as usize])
            .sum::<DVec3>()
            / face.len() as f64;
        let middle = chart.angle(centre);
        let corners = face
            .iter()
            .map(|&v| {
                let p = shell.points[v as usize];
                let raw = chart.angle(p);
                let turn = ((middle - raw) / core::f64::consts::TAU).round();
                let uv = [
                    (raw + turn * core::f64::consts::TAU) * chart.radius,
                    chart.along(p),
                ];
                *made.entry((v, index, turn as i32)).or_insert_with(|| {
                    part.vertices.push(PartVertex {
                        position: p,
                        uv,
                        color: [1.0, 1.0, 1.0, open[v as usize]],
                        weights: shell.weights[v as usize].refs(),
                    });
                    part.vertices.len() as u32 - 1
                })
            })
            .collect();
        part.faces.push(corners);
    }
    part
}

/// A cloth or leather of one colour (linear RGB).
#[must_use]
pub fn dyed(kind: MaterialKind, rgb: [f64; 3], roughness: f32) -> Material {
    let [r, g, b] = rgb.map(|x| x as f32);
    Material {
        kind,
        base_color: [r, g, b, 1.0],
        roughness,
        double_sided: kind == MaterialKind::Cloth,
        maps: Maps::default(),
    }
}

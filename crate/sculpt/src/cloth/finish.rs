//! Conversion of draped shells to parts: texture coordinates in metres, occlusion, colours.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, ops};

use crate::part::{MeshPart, PartVertex};
use crate::torso::{Field, Regions, Shell};
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};

/// Straight axis about which a piece of cloth is unrolled into texture coordinates.
#[derive(Clone, Copy, Debug)]
pub struct UnrollAxis {
    /// A point of the axis.
    pub origin: DVec3,
    /// Direction along the axis; v grows along it.
    pub axis: DVec3,
    /// Direction of angle zero, away from the seam.
    pub front: DVec3,
    /// Metres of u in one radian.
    pub radius: f64,
}

impl UnrollAxis {
    fn angle(&self, p: DVec3) -> f64 {
        let d = p - self.origin;
        ops::atan2(d.dot(self.front.cross(self.axis)), d.dot(self.front))
    }

    fn along(&self, p: DVec3) -> f64 {
        (p - self.origin).dot(self.axis)
    }
}

/// Returns the ambient visibility of a cloth point next to the body, 0.12 (occluded) to 1 (open),
/// from distances along the normal.
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

/// Returns the occlusion of each point by folds: the mean height of its neighbours above the
/// tangent plane, relative to the edge length.
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

/// Material of a piece of clothing: kind of cloth and dye.
#[derive(Clone, Copy, Debug)]
pub struct Fabric {
    /// Weave, leather or plain.
    pub kind: MaterialKind,
    /// Dye of the cloth, linear RGB.
    pub dye: [f64; 3],
}

impl Fabric {
    /// Returns the same cloth with its dye multiplied by a factor, darker or lighter.
    #[must_use]
    pub fn shaded(self, by: f64) -> Self {
        Self {
            dye: self.dye.map(|x| x * by),
            ..self
        }
    }

    /// Returns a fabric of another kind with the same dye.
    #[must_use]
    pub fn woven(self, kind: MaterialKind) -> Self {
        Self { kind, ..self }
    }

    fn material(self) -> Material {
        let cloth = self.kind.weave().is_some();
        Material {
            kind: self.kind,
            base_color: [1.0; 4],
            roughness: if cloth { 0.88 } else { 0.42 },
            double_sided: cloth,
            maps: TextureMaps::default(),
        }
    }
}

/// Assignment of the faces of a cloth surface to the axes about which they are unrolled.
#[derive(Clone, Copy)]
pub struct Unrolling<'a> {
    /// Axes of its parts.
    pub charts: &'a [UnrollAxis],
    /// Index of a face's axis.
    pub chart_of: &'a dyn Fn(usize) -> usize,
}

/// Makes a part of a shell. `shade` is further light that is lost at each point.
#[must_use]
pub fn cloth_part(
    name: &str,
    shell: &Shell,
    shade: &[f64],
    field: &Field,
    fabric: Fabric,
    unrolling: Unrolling<'_>,
) -> MeshPart {
    let normals = shell.normals();
    let folds = fold_openness(shell, &normals);
    let [r, g, b] = fabric.dye;
    let light = |v: usize| {
        let seam = shade.get(v).copied().unwrap_or(1.0);
        seam * folds[v] * openness(field, shell.points[v], normals[v])
    };
    let mut part = MeshPart {
        name: name.to_owned(),
        material: fabric.material(),
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
        bound: Vec::new(),
    };
    // A vertex is duplicated where charts meet and where a chart closes on itself.
    let mut made: BTreeMap<(u32, usize, i32), u32> = BTreeMap::new();
    for (f, face) in shell.faces.iter().enumerate() {
        let index = (unrolling.chart_of)(f);
        let chart = &unrolling.charts[index];
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
                        color: [r, g, b, light(v as usize)],
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

/// Builds a part whose texture coordinates matter little: small items, leather.
#[must_use]
pub fn plain_part(name: &str, shell: &Shell, field: &Field, fabric: Fabric) -> MeshPart {
    let normals = shell.normals();
    let [r, g, b] = fabric.dye;
    MeshPart {
        name: name.to_owned(),
        material: fabric.material(),
        vertices: shell
            .points
            .iter()
            .zip(&shell.weights)
            .zip(&normals)
            .map(|((p, w), n)| PartVertex {
                position: *p,
                uv: [p.x, p.y - 1.0],
                color: [r, g, b, openness(field, *p, *n)],
                weights: w.refs(),
            })
            .collect(),
        faces: shell.faces.clone(),
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

/// Merges the materials of all parts of a kind so that they share a draw call: the colour is the
/// maximum of each channel, and the vertices carry their share of it.
pub fn share_materials(parts: &mut [MeshPart]) {
    let mut brightest: BTreeMap<MaterialKind, [f64; 3]> = BTreeMap::new();
    for part in parts.iter() {
        let most = brightest.entry(part.material.kind).or_insert([1e-4; 3]);
        for v in &part.vertices {
            for (most, c) in most.iter_mut().zip(v.color) {
                *most = most.max(c);
            }
        }
    }
    for part in parts {
        let Some(most) = brightest.get(&part.material.kind) else {
            continue;
        };
        for v in &mut part.vertices {
            for (c, most) in v.color.iter_mut().zip(most) {
                *c /= most;
            }
        }
        let [r, g, b] = most.map(|x| x as f32);
        part.material.base_color = [r, g, b, 1.0];
    }
}

//! Wavefront OBJ, readable by every modelling program.

use std::fmt::Write as _;

use raconteur_body::{Figure, MaterialKind, Mesh};

use crate::sheet::PosedFigure;
use crate::skinning::{Skinned, skin, world_from_bind};

/// Returns the posed figure as OBJ text, one object per mesh; metres, y up. Linear RGB colours
/// follow the positions (a common extension).
pub(super) fn write(figure: &Figure, posed: &PosedFigure) -> String {
    let matrices = world_from_bind(figure, &posed.world_from_joint);
    let mut out = format!("# {}, made by raconteur; metres, y up\n", figure.name);
    let mut first = 1;
    for mesh in &figure.meshes {
        let skinned = skin(mesh, &matrices, &posed.morph_weights, &posed.tissue);
        // Writing to a string cannot fail.
        let _ = write_mesh(&mut out, mesh, &skinned, first);
        first += mesh.positions.len();
    }
    out
}

fn write_mesh(out: &mut String, mesh: &Mesh, skinned: &Skinned, first: usize) -> std::fmt::Result {
    let kind = MaterialKind::NAMES
        .iter()
        .find(|(k, _)| *k == mesh.material.kind)
        .map_or("plain", |(_, name)| name);
    writeln!(out, "o {}\ng {kind}", mesh.name.replace(' ', "_"))?;
    let base = mesh.material.base_color;
    for (p, color) in skinned.positions.iter().zip(&mesh.colors) {
        let [r, g, b] = [0, 1, 2].map(|k| f32::from(color[k]) / 255.0 * base[k]);
        writeln!(
            out,
            "v {:.6} {:.6} {:.6} {r:.4} {g:.4} {b:.4}",
            p.x, p.y, p.z
        )?;
    }
    for [u, v] in &mesh.uvs {
        // OBJ counts v from the bottom, glTF from the top.
        writeln!(out, "vt {u:.5} {:.5}", 1.0 - v)?;
    }
    for n in &skinned.normals {
        writeln!(out, "vn {:.4} {:.4} {:.4}", n.x, n.y, n.z)?;
    }
    for t in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(|i| first + i as usize);
        writeln!(out, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
    }
    Ok(())
}

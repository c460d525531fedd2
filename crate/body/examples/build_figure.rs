//! Writes a named figure: `cargo run -p raconteur-body --features generator --release
//! --example build_figure -- sofia assets/figures/sofia.glb`.

use raconteur_body::generator::{build, people, write};

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut args = std::env::args().skip(1);
    let (Some(name), Some(path)) = (args.next(), args.next()) else {
        return Err("usage: build_figure NAME FILE".into());
    };
    let params = people::preset(&name).ok_or_else(|| format!("no figure is named {name}"))?;
    let start = std::time::Instant::now();
    let figure = build(&params);
    let bytes = write::to_glb(&figure);
    for mesh in &figure.meshes {
        println!(
            "{:10} {:7} vertices {:7} triangles {:3} morphs",
            mesh.name,
            mesh.positions.len(),
            mesh.indices.len() / 3,
            mesh.morphs.len()
        );
    }
    let triangles: usize = figure.meshes.iter().map(|m| m.indices.len() / 3).sum();
    println!("{triangles} triangles, {} bytes, {:.1} s", bytes.len(), start.elapsed().as_secs_f64());
    std::fs::write(path, bytes)?;
    Ok(())
}

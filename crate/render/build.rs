//! Removes the comments of the shaders from the browser build: half of their text.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src/shader");
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    for entry in fs::read_dir("src/shader")? {
        let path: PathBuf = entry?.path();
        let text = fs::read_to_string(&path)?;
        // WGSL has no string literals, so two slashes always begin a comment.
        let code = text
            .lines()
            .map(|line| line.split("//").next().unwrap_or_default());
        let lines = code.map(str::trim_end).filter(|line| !line.is_empty());
        let text: String = lines.map(|line| format!("{line}\n")).collect();
        if let Some(name) = path.file_name() {
            fs::write(Path::new(&out).join(name), text)?;
        }
    }
    Ok(())
}

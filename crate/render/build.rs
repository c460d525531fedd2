//! Takes comments and needless space out of the shaders: they travel to the browser as text.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src/shader");
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    for entry in fs::read_dir("src/shader")? {
        let path = entry?.path();
        let Some(name) = path.file_name() else {
            continue;
        };
        let text = fs::read_to_string(&path)?;
        // WGSL has no string literals, so two slashes always begin a comment.
        let lines = text
            .lines()
            .map(|line| line.split("//").next().unwrap_or_default().trim())
            .filter(|line| !line.is_empty());
        let lean: String = lines.map(|line| tight(line) + "\n").collect();
        fs::write(Path::new(&out).join(name), lean)?;
    }
    Ok(())
}

/// Leaves out spaces beside punctuation. Minus, ampersand and bar keep theirs: two of them
/// together mean something else.
fn tight(line: &str) -> String {
    let closes = |c: char| "(){},;:=*+/<>".contains(c);
    let mut out = String::with_capacity(line.len());
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        let beside =
            out.chars().last().is_some_and(closes) || rest.peek().is_some_and(|n| closes(*n));
        if c != ' ' || !beside {
            out.push(c);
        }
    }
    out
}

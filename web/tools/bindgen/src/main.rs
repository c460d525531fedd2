//! Writes the JavaScript side of a wasm build: `raconteur-bindgen IN.wasm OUT_FOLDER`.
//!
//! wasm-bindgen's own module targets keep one wasm instance in a module variable. A page
//! may hold several players, and a trap must end only one of them, so this program takes
//! the target without modules and wraps it in a function: each call of the default export
//! is a fresh instance.

use std::{env, fs, path::Path};

use anyhow::{Context, Result, bail};
use wasm_bindgen_cli_support::Bindgen;

/// Stem of the files that are written.
const NAME: &str = "raconteur";

fn main() -> Result<()> {
    let mut arguments = env::args().skip(1);
    let (Some(input), Some(output), None) = (arguments.next(), arguments.next(), arguments.next())
    else {
        bail!("usage: raconteur-bindgen IN.wasm OUT_FOLDER");
    };
    let output = Path::new(&output);
    Bindgen::new()
        .input_path(&input)
        .no_modules(true)?
        .typescript(true)
        .out_name(NAME)
        .generate(output)
        .with_context(|| format!("wasm-bindgen refused {input}"))?;
    edit(&output.join(format!("{NAME}.js")), |script| {
        format!(
            "// A fresh instance for each call, so that a trap ends one player only.\n\
             export default function instantiate() {{\n{script}\nreturn wasm_bindgen;\n}}\n"
        )
    })?;
    edit(&output.join(format!("{NAME}.d.ts")), |types| {
        format!("{types}\nexport default function instantiate(): typeof wasm_bindgen;\n")
    })
}

fn edit(path: &Path, change: impl FnOnce(&str) -> String) -> Result<()> {
    let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
    fs::write(path, change(&text)).with_context(|| path.display().to_string())
}

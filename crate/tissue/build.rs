//! Turns the table of muscles, `src/muscles.tsv`, into what the program knows of them.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

#[path = "src/table.rs"]
mod table;

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src/muscles.tsv");
    println!("cargo::rerun-if-changed=src/table.rs");
    let text = fs::read_to_string("src/muscles.tsv")?;
    let rows =
        table::read(&text).map_err(|wrong| io::Error::other(format!("muscles.tsv: {wrong}")))?;
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    let written = program(&rows).map_err(io::Error::other)?;
    fs::write(Path::new(&out).join("muscles.rs"), written)
}

/// The source text: how many there are, a constant for each, its row, and ARKit's shares.
fn program(rows: &[table::Row<'_>]) -> Result<String, std::fmt::Error> {
    let all: Vec<_> = table::each(rows).collect();
    let mut out = String::new();
    writeln!(
        out,
        "/// How many muscles a face has, left and right counted apart."
    )?;
    writeln!(out, "pub const MUSCLES: usize = {};", all.len())?;
    writeln!(
        out,
        "#[allow(missing_docs, non_upper_case_globals, reason = \"the names are the anatomical ones\")]"
    )?;
    writeln!(out, "impl Muscle {{")?;
    for (place, (row, side)) in all.iter().enumerate() {
        writeln!(out, "pub const {}{side}: Self = Self({place});", row.code)?;
    }
    writeln!(out, "}}\nstatic ROWS: [Row; MUSCLES] = [")?;
    for (row, side) in &all {
        let known = match *side {
            "" => "None".to_owned(),
            side => format!("Some(Side::{side})"),
        };
        writeln!(
            out,
            "Row {{ name: \"{}{side}\", side: {known}, shortens: {:?}, bulge_mm: {:?}, fold: {:?} }},",
            row.name, row.shortens, row.bulge_mm, row.fold
        )?;
    }
    let shares: Vec<(String, &str, u8)> = rows
        .iter()
        .flat_map(|row| {
            let side = if row.is_pair { "Left" } else { "" };
            let own = row.arkit.iter();
            own.map(move |&(target, percent)| (format!("{}{side}", row.code), target, percent))
        })
        .collect();
    writeln!(
        out,
        "];\n/// By how many percent a muscle that is fully contracted, of a pair the left one, moves a\n/// target of ARKit of its side; targets by ARKit's names without their sides. Designed, after what\n/// the muscles do (F&H section 3.1.1) and the action units that the targets are named for."
    )?;
    writeln!(
        out,
        "pub const ARKIT: [(Muscle, &str, u8); {}] = [",
        shares.len()
    )?;
    for (code, target, percent) in shares {
        writeln!(out, "(Muscle::{code}, \"{target}\", {percent}),")?;
    }
    writeln!(out, "];")?;
    Ok(out)
}

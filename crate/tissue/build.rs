//! Generates Rust code from the muscle tables `src/muscles.tsv` and `src/antagonists.tsv`.

use std::fmt::{self, Write as _};
use std::path::Path;
use std::{env, fs, io};

#[path = "src/antagonists.rs"]
mod antagonists;
#[path = "src/table.rs"]
mod table;

use antagonists::Antagonists;
use table::Row;

fn main() -> io::Result<()> {
    for read in [
        "muscles.tsv",
        "antagonists.tsv",
        "table.rs",
        "antagonists.rs",
    ] {
        println!("cargo::rerun-if-changed=src/{read}");
    }
    let wrong = |file: &'static str| move |w: String| io::Error::other(format!("{file}: {w}"));
    let muscles = fs::read_to_string("src/muscles.tsv")?;
    let rows = table::read(&muscles).map_err(wrong("muscles.tsv"))?;
    let against = fs::read_to_string("src/antagonists.tsv")?;
    let against = antagonists::read(&against, &rows).map_err(wrong("antagonists.tsv"))?;
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    let mut written = String::new();
    muscles_of(&rows, &mut written)
        .and_then(|()| shares(&rows, &mut written))
        .and_then(|()| pairs(&rows, &against, &mut written))
        .map_err(io::Error::other)?;
    fs::write(Path::new(&out).join("muscles.rs"), written)
}

/// Writes the number of muscles, a constant for each, and its row.
fn muscles_of(rows: &[Row<'_>], out: &mut String) -> fmt::Result {
    let all: Vec<_> = table::for_each_muscle(rows).collect();
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
    writeln!(out, "}}\nstatic ROWS: [Traits; MUSCLES] = [")?;
    for (row, side) in &all {
        let known = match *side {
            "" => "None".to_owned(),
            side => format!("Some(Side::{side})"),
        };
        writeln!(
            out,
            "Traits {{ name: Cow::Borrowed(\"{}{side}\"), side: {known}, shortens: {:?}, bulge_mm: {:?}, fold: {:?} }},",
            row.name, row.shortens, row.bulge_mm, row.fold
        )?;
    }
    writeln!(out, "];")
}

/// Writes lists of muscles with numbers, limited to those that have one.
fn shares(rows: &[Row<'_>], out: &mut String) -> fmt::Result {
    let arkit = rows.iter().flat_map(|row| {
        let left = format!("{}{}", row.code, table::sides(row)[0]);
        let own = row.arkit.iter();
        own.map(move |(target, percent)| format!("Muscle::{left}, \"{target}\", {percent}"))
    });
    list(
        "ARKIT",
        "&str, u8",
        "By how many percent a muscle that is fully contracted, of a pair the left one, moves a
target of ARKit of its side; targets by ARKit's names without their sides. Designed, after what
the muscles do (F&H section 3.1.1) and the action units that the targets are named for.",
        arkit,
        out,
    )?;
    let each = || table::for_each_muscle(rows);
    let apart = each().filter_map(|(row, side)| {
        let [seal, bite] = row.closures?;
        Some(format!("Muscle::{}{side}, {seal}, {bite}", row.code))
    });
    list(
        "APART",
        "u8, u8",
        "Muscles that pull the lips apart, and how much of each a closure takes off, percent: sealed
lips, the lower lip at the teeth. Designed: what raises or lowers the red of the lips yields, what
draws the corners yields in part.",
        apart,
        out,
    )?;
    let closing = each().filter(|(row, _)| row.closes_jaw > 0);
    let closing = closing.map(|(r, side)| format!("Muscle::{}{side}, {}", r.code, r.closes_jaw));
    list(
        "CLOSES_JAW",
        "u8",
        "Muscles that raise the lower jaw, and how many percent of its opening each takes off at full
contraction.",
        closing,
        out,
    )
}

/// Writes a constant list of muscles with their values.
fn list(
    name: &str,
    types: &str,
    told: &str,
    items: impl Iterator<Item = String>,
    out: &mut String,
) -> fmt::Result {
    let items: Vec<String> = items.collect();
    for line in told.lines() {
        writeln!(out, "/// {line}")?;
    }
    let count = items.len();
    writeln!(out, "pub const {name}: [(Muscle, {types}); {count}] = [")?;
    for item in items {
        writeln!(out, "({item}),")?;
    }
    writeln!(out, "];")
}

/// Sets of muscles against sets of muscles.
fn pairs(rows: &[Row<'_>], against: &[Antagonists<'_>], out: &mut String) -> fmt::Result {
    // Of a set those muscles whose names end so; those of the middle are on every side.
    let set = |names: &[&str], wanted: Option<&str>| {
        let all = table::for_each_muscle(rows).filter(|(row, side)| {
            let is_there = wanted.is_none_or(|w| side.is_empty() || *side == w);
            is_there && names.contains(&row.name)
        });
        let all: Vec<String> = all
            .map(|(row, side)| format!("Muscle::{}{side}", row.code))
            .collect();
        format!("&[{}]", all.join(", "))
    };
    let mut pairs = Vec::new();
    for Antagonists { sets, is_by_side } in against {
        let wanted: &[Option<&str>] = if *is_by_side {
            &[Some("Left"), Some("Right")]
        } else {
            &[None]
        };
        for side in wanted {
            pairs.push(sets.each_ref().map(|names| set(names, *side)));
        }
    }
    writeln!(
        out,
        "/// Muscles that pull against each other (F&H table 4.6); what they call one muscle is here\n/// its fibres or sides that are controlled apart."
    )?;
    let count = pairs.len();
    writeln!(
        out,
        "pub const ANTAGONISTS: [(&[Muscle], &[Muscle]); {count}] = ["
    )?;
    for [one, other] in pairs {
        writeln!(out, "({one}, {other}),")?;
    }
    writeln!(out, "];")
}

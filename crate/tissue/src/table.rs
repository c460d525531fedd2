//! Reader of the table of muscles, `muscles.tsv`. It runs when this crate is built (`build.rs`), so
//! that the compiler checks names and nothing is read at run time; the figure generator also uses
//! it later.

/// Row of the muscle table: a muscle in the middle of the face, or a pair.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row<'a> {
    /// Name of the muscle in stories, without its side.
    pub(crate) name: &'a str,
    /// True if there is one muscle on each side.
    pub(crate) is_pair: bool,
    /// Name of the muscle in the code, without its side.
    pub(crate) code: &'a str,
    /// Share of its length that it loses at full contraction, 0 to 1.
    pub(crate) shortens: f32,
    /// Thickening of its middle, millimetres on the reference head.
    pub(crate) bulge_mm: f32,
    /// Channel of the wrinkle map into which it folds the skin, 0 to 2, and the strength.
    pub(crate) fold: Option<(u8, f32)>,
    /// ARKit targets that it moves, in percent.
    pub(crate) arkit: Vec<(&'a str, u8)>,
    /// Reduction by closures in percent: sealed lips, the lower lip at the teeth.
    pub(crate) closures: Option<[u8; 2]>,
    /// Reduction of the jaw's opening at full contraction, in percent.
    pub(crate) closes_jaw: u8,
}

/// Names of the columns; further columns are for documentation only.
const COLUMNS: [&str; 9] = [
    "name",
    "sides",
    "code",
    "shortens",
    "bulge_mm",
    "fold",
    "arkit",
    "closures",
    "closes_jaw",
];

/// Parses the rows of a table; returns an error message if it is invalid.
pub(crate) fn read(text: &str) -> Result<Vec<Row<'_>>, String> {
    let rows = lines(text, &COLUMNS, row)?;
    for (k, row) in rows.iter().enumerate() {
        let is_same = |other: &Row<'_>| other.name == row.name || other.code == row.code;
        if rows[..k].iter().any(is_same) {
            return Err(format!("{} is there twice", row.name));
        }
    }
    Ok(rows)
}

/// Parses the rows of a table whose first columns have the given names.
pub(crate) fn lines<'a, T>(
    text: &'a str,
    columns: &[&str],
    mut row: impl FnMut(&'a str) -> Result<T, String>,
) -> Result<Vec<T>, String> {
    let mut lines = text
        .lines()
        .filter(|l| !l.trim().is_empty() && !l.starts_with('#'));
    let head: Vec<&str> = lines.next().unwrap_or_default().split('\t').collect();
    if !head.starts_with(columns) {
        return Err(format!("the first columns are {columns:?}, not {head:?}"));
    }
    lines
        .map(|line| row(line).map_err(|wrong| format!("{wrong} in {line:?}")))
        .collect()
}

fn row(line: &str) -> Result<Row<'_>, String> {
    let cells: Vec<&str> = line.split('\t').collect();
    let &[
        name,
        sides,
        code,
        shortens,
        bulge_mm,
        fold,
        arkit,
        closures,
        closes_jaw,
        ..,
    ] = &cells[..]
    else {
        return Err("too few columns".to_owned());
    };
    let is_name =
        |s: &str| s.starts_with(char::is_alphabetic) && s.chars().all(char::is_alphanumeric);
    if !(is_name(name) && is_name(code)) {
        return Err(format!("{name} and {code} are not names"));
    }
    let is_pair = match sides {
        "pair" => true,
        "middle" => false,
        other => return Err(format!("{other} is neither pair nor middle")),
    };
    let shortens = number(shortens)?;
    if !(0.0..1.0).contains(&shortens) {
        return Err(format!("no muscle loses {shortens} of its length"));
    }
    Ok(Row {
        name,
        is_pair,
        code,
        shortens,
        bulge_mm: number(bulge_mm)?,
        fold: fold_of(fold)?,
        arkit: targets(arkit)?,
        closures: match closures {
            "-" => None,
            some => {
                let (seal, bite) = share(some)?;
                Some([percent(seal)?, percent(bite)?])
            }
        },
        closes_jaw: percent(closes_jaw)?,
    })
}

fn fold_of(cell: &str) -> Result<Option<(u8, f32)>, String> {
    if cell == "-" {
        return Ok(None);
    }
    let (channel, strength) = share(cell)?;
    let channel = channel.parse().ok().filter(|c| *c < 3);
    let channel = channel.ok_or("there are channels 0 to 2")?;
    Ok(Some((channel, number(strength)?)))
}

fn targets(cell: &str) -> Result<Vec<(&str, u8)>, String> {
    let parts = cell.split(' ').filter(|part| *part != "-");
    parts
        .map(|part| {
            let (target, much) = share(part)?;
            Ok((target, percent(much)?))
        })
        .collect()
}

fn number(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|x: &f32| x.is_finite());
    number.ok_or_else(|| format!("{text} is not a number"))
}

fn percent(text: &str) -> Result<u8, String> {
    let percent = text.parse().ok().filter(|x: &u8| *x <= 100);
    percent.ok_or_else(|| format!("{text} is not a percentage"))
}

fn share(text: &str) -> Result<(&str, &str), String> {
    text.split_once(':')
        .ok_or_else(|| format!("{text} is not of the form what:how much"))
}

/// Returns the name suffixes of a row's muscles, one for each.
pub(crate) fn sides(row: &Row<'_>) -> &'static [&'static str] {
    if row.is_pair {
        &["Left", "Right"]
    } else {
        &[""]
    }
}

/// Calls a function for each muscle of a table, by index, with its row and name suffix.
pub(crate) fn for_each_muscle<'t, 'a>(
    rows: &'t [Row<'a>],
) -> impl Iterator<Item = (&'t Row<'a>, &'static str)> {
    rows.iter()
        .flat_map(|row| sides(row).iter().map(move |side| (row, *side)))
}

//! Reads the table of muscles, `muscles.tsv`. Done where this crate is built (`build.rs`), so
//! that names are checked by the compiler and nothing is read at run time.

/// A row of the table: a muscle in the middle of the face, or a pair.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row<'a> {
    /// Its name in stories, without its side.
    pub(crate) name: &'a str,
    /// Whether there is one on each side.
    pub(crate) is_pair: bool,
    /// Its name in the program, without its side.
    pub(crate) code: &'a str,
    /// Share of its length that it loses at full contraction, 0 to 1.
    pub(crate) shortens: f32,
    /// How much thicker its middle becomes, millimetres on the reference head.
    pub(crate) bulge_mm: f32,
    /// Which channel of the wrinkle map it folds the skin into, 0 to 2, and how strongly.
    pub(crate) fold: Option<(u8, f32)>,
    /// Which targets of ARKit it moves, by how many percent.
    pub(crate) arkit: Vec<(&'a str, u8)>,
}

/// What the columns are; those after them are for pages and people.
const COLUMNS: [&str; 7] = [
    "name", "sides", "code", "shortens", "bulge_mm", "fold", "arkit",
];

/// The rows of a table, or what is wrong with it.
pub(crate) fn read(text: &str) -> Result<Vec<Row<'_>>, String> {
    let mut lines = text
        .lines()
        .filter(|l| !l.trim().is_empty() && !l.starts_with('#'));
    let head: Vec<&str> = lines.next().unwrap_or_default().split('\t').collect();
    if !head.starts_with(&COLUMNS) {
        return Err(format!("the first columns are {COLUMNS:?}, not {head:?}"));
    }
    lines
        .map(|line| row(line).map_err(|wrong| format!("{wrong} in {line:?}")))
        .collect()
}

fn row(line: &str) -> Result<Row<'_>, String> {
    let cells: Vec<&str> = line.split('\t').collect();
    let &[name, sides, code, shortens, bulge_mm, fold, arkit, ..] = &cells[..] else {
        return Err("too few columns".to_owned());
    };
    let is_name =
        |s: &str| s.starts_with(char::is_alphabetic) && s.chars().all(char::is_alphanumeric);
    if !(is_name(name) && is_name(code)) {
        return Err(format!("{name} and {code} are no names"));
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
    let fold = match fold {
        "-" => None,
        some => {
            let (channel, strength) = share(some)?;
            let channel = channel.parse().ok().filter(|c| *c < 3);
            Some((
                channel.ok_or("there are channels 0 to 2")?,
                number(strength)?,
            ))
        }
    };
    let mut targets = Vec::new();
    for part in arkit.split(' ').filter(|part| *part != "-") {
        let (target, percent) = share(part)?;
        let percent = percent
            .parse()
            .map_err(|_| format!("{percent} is no percentage"))?;
        targets.push((target, percent));
    }
    Ok(Row {
        name,
        is_pair,
        code,
        shortens,
        bulge_mm: number(bulge_mm)?,
        fold,
        arkit: targets,
    })
}

fn number(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|x: &f32| x.is_finite());
    number.ok_or_else(|| format!("{text} is no number"))
}

fn share(text: &str) -> Result<(&str, &str), String> {
    text.split_once(':')
        .ok_or_else(|| format!("{text} is not of the form what:how much"))
}

/// Each muscle of a table by its place: its row, and what follows its names.
pub(crate) fn each<'t, 'a>(
    rows: &'t [Row<'a>],
) -> impl Iterator<Item = (&'t Row<'a>, &'static str)> {
    rows.iter().flat_map(|row| {
        let sides: &[&str] = if row.is_pair {
            &["Left", "Right"]
        } else {
            &[""]
        };
        sides.iter().map(move |side| (row, *side))
    })
}

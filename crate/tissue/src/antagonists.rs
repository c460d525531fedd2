//! Reader of the table of antagonists, `antagonists.tsv` (F&H table 4.6), at build time.

use crate::table::{Row, lines};

/// Two sets of muscles that pull against each other, so that only one set contracts at a time (F&H
/// table 4.6).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Antagonists<'a> {
    /// Names without sides.
    pub(crate) sets: [Vec<&'a str>; 2],
    /// True if each side forms its own pair of sets; otherwise both sides are in one.
    pub(crate) is_by_side: bool,
}

/// Parses the table of antagonists, which must be muscles of `rows`; returns an error message if it
/// is invalid.
pub(crate) fn read<'a>(text: &'a str, rows: &[Row<'_>]) -> Result<Vec<Antagonists<'a>>, String> {
    lines(text, &["one", "other", "sides"], |line| {
        let cells: Vec<&str> = line.split('\t').collect();
        let &[one, other, sides] = &cells[..] else {
            return Err("expected three columns".to_owned());
        };
        let set = |names: &'a str| -> Result<Vec<&'a str>, String> {
            let names: Vec<&str> = names.split(' ').collect();
            match names.iter().find(|n| rows.iter().all(|r| r.name != **n)) {
                Some(unknown) => Err(format!("{unknown} is not a muscle")),
                None => Ok(names),
            }
        };
        let is_by_side = match sides {
            "each" => true,
            "both" => false,
            other => return Err(format!("{other} is neither each nor both")),
        };
        Ok(Antagonists {
            sets: [set(one)?, set(other)?],
            is_by_side,
        })
    })
}

//! The mimic muscles (F&H section 3.1.1, table 3.1 and figure 3.3), as `muscles.tsv` lists them.
//!
//! A muscle is a row of that table, and grids on the reference head where it lies (`layout.rs`
//! of the figures' generator). Names in stories, sliders of pages, mechanics, wrinkles and the
//! shares of ARKit's targets follow from the row. Rows are added at the end: places of muscles
//! are kept in figures' files and counted by pages.

use core::fmt;

use raconteur_base::Side;

/// A mimic muscle, by its place in the table. The reference head of F&H has 24 major ones; here
/// paired muscles are two, and the frontal belly and the ring of the mouth are told apart as
/// their fibres are controlled apart.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Muscle(u8);

/// What the table says of one muscle.
struct Row {
    name: &'static str,
    side: Option<Side>,
    shortens: f32,
    bulge_mm: f32,
    fold: Option<(u8, f32)>,
}

include!(concat!(env!("OUT_DIR"), "/muscles.rs"));

impl fmt::Debug for Muscle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Muscle {
    /// All muscles in the order of [`FaceControls::contraction`](super::FaceControls).
    pub fn all() -> impl Iterator<Item = Self> {
        (0..MUSCLES as u8).map(Self)
    }

    /// Its place in [`FaceControls::contraction`](super::FaceControls).
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    fn row(self) -> &'static Row {
        &ROWS[self.index()]
    }

    /// Its name in stories: anatomical, with its side at the end if it has one.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The muscle of a name; letters may be great or small.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().find(|muscle| muscle.name().eq_ignore_ascii_case(name))
    }

    /// On which side of the face it is; `None` in the middle.
    #[must_use]
    pub fn side(self) -> Option<Side> {
        self.row().side
    }

    /// The same muscle of the other side; itself in the middle.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self.side() {
            Some(Side::Left) => Self(self.0 + 1),
            Some(Side::Right) => Self(self.0 - 1),
            None => self,
        }
    }

    /// Share of its length that it loses at full contraction, 0 to 1, and how much thicker its
    /// middle becomes, metres on the reference head. Designed: by what the skin at its end was
    /// seen to travel.
    pub(super) fn mechanics(self) -> (f32, f32) {
        (self.row().shortens, self.row().bulge_mm * 1e-3)
    }

    /// Which channel of the wrinkle map it folds the skin into, and how strongly.
    pub(super) fn fold(self) -> Option<(u8, f32)> {
        self.row().fold
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table;

    #[test]
    fn muscles_stand_at_their_index_and_sides_are_mirrored() {
        assert_eq!(Muscle::all().count(), MUSCLES);
        for (i, muscle) in Muscle::all().enumerate() {
            assert_eq!(muscle.index(), i);
            assert_eq!(Muscle::by_name(&muscle.name().to_lowercase()), Some(muscle));
            assert_eq!(muscle.mirrored().mirrored(), muscle);
            assert_eq!(
                muscle.mirrored().side(),
                muscle.side().map(Side::opposite),
                "{muscle:?}"
            );
            assert!(muscle.mechanics().0 > 0.0, "{muscle:?}");
        }
    }

    #[test]
    fn the_program_knows_what_the_table_says() {
        let rows = table::read(include_str!("muscles.tsv")).expect("a table");
        let told: Vec<_> = table::each(&rows).collect();
        assert_eq!(told.len(), MUSCLES);
        for (muscle, (row, side)) in Muscle::all().zip(told) {
            assert_eq!(muscle.name(), format!("{}{side}", row.name));
            assert_eq!(muscle.mechanics(), (row.shortens, row.bulge_mm * 1e-3));
            assert_eq!(muscle.fold(), row.fold);
        }
        let shares: usize = rows.iter().map(|r| r.arkit.len()).sum();
        assert_eq!(ARKIT.len(), shares);
    }

    /// `UPDATE=1` writes the table of `docs/face.md` anew.
    #[test]
    fn the_reference_lists_every_muscle() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/face.md");
        let page = std::fs::read_to_string(path).expect("the page of the face");
        let (begin, end) = ("<!-- muscles -->\n", "<!-- /muscles -->\n");
        let (before, rest) = page.split_once(begin).expect("the table's begin");
        let (_, after) = rest.split_once(end).expect("the table's end");
        let mut table = "| muscle | | |\n|---|---|---|\n".to_owned();
        for line in include_str!("muscles.tsv").lines().skip(1) {
            let cells: Vec<&str> = line.split('\t').collect();
            let sides = if cells[1] == "pair" { "…" } else { "" };
            table += &format!("| `{}{sides}` | {} | {} |\n", cells[0], cells[8], cells[9]);
        }
        let wanted = format!("{before}{begin}{table}{end}{after}");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, &wanted).expect("the page is written");
        }
        assert!(
            page == wanted,
            "run it again with UPDATE=1 to write docs/face.md"
        );
    }

    #[test]
    fn a_broken_table_is_told() {
        let head = "name\tsides\tcode\tshortens\tbulge_mm\tfold\tarkit\n";
        let bad = [
            "".to_owned(),
            "name\tsides\n".to_owned(),
            format!("{head}A\tpair\tA\t0.2\n"),
            format!("{head}A\tboth\tA\t0.2\t1\t-\t-\n"),
            format!("{head}A\tpair\tA\t1.2\t1\t-\t-\n"),
            format!("{head}A\tpair\tA\t0.2\tNaN\t-\t-\n"),
            format!("{head}A\tpair\tA\t0.2\t1\t3:1\t-\n"),
            format!("{head}A\tpair\tA\t0.2\t1\t-\tjaw\n"),
            format!("{head}A b\tpair\tA\t0.2\t1\t-\t-\n"),
        ];
        for text in bad {
            assert!(table::read(&text).is_err(), "{text}");
        }
    }
}

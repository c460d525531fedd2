//! The mimic muscles (F&H section 3.1.1, table 3.1 and figure 3.3), as listed in `muscles.tsv`.
//!
//! A muscle is a row of that table, plus rows of `fibres.tsv` of the figure generator, which
//! specify its position on the reference head. The row determines names in stories, sliders of
//! pages, mechanics, wrinkles, the shares of ARKit's targets, the reduction by lip closures and the
//! effect on the jaw; `antagonists.tsv` lists the opposing muscles. New rows are added at the end,
//! because figure files store indices of muscles and pages count them.

use core::fmt;
use std::borrow::Cow;

use raconteur_base::Side;

/// Facial muscle, as an index in the table. Paired muscles count as two; the frontal belly and the
/// ring of the mouth are divided, because their fibres are controlled separately. The reference
/// head of F&H has 24 major muscles.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Muscle(u8);

/// Traits of one muscle from the table, as used by the tissue.
#[derive(Clone, Debug)]
struct Traits {
    name: Cow<'static, str>,
    side: Option<Side>,
    shortens: f32,
    bulge_mm: f32,
    fold: Option<(u8, f32)>,
}

include!(concat!(env!("OUT_DIR"), "/muscles.rs"));

impl fmt::Debug for Muscle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match Anatomy::SHIPPED.0.get(self.index()) {
            Some(traits) => f.write_str(&traits.name),
            None => write!(f, "muscle {}", self.0),
        }
    }
}

/// Set of facial muscles, in the order of its table: the built-in table or one read from text.
#[derive(Clone, Debug)]
pub struct Anatomy(Cow<'static, [Traits]>);

impl Anatomy {
    /// Muscles of the built-in table.
    pub const SHIPPED: Self = Self(Cow::Borrowed(&ROWS));

    /// Parses a table of muscles, at most 256 with both sides counted.
    ///
    /// # Errors
    /// Returns an error message that describes the problem in the table.
    pub fn read(text: &str) -> Result<Self, String> {
        let rows = crate::table::read(text)?;
        let all = crate::table::for_each_muscle(&rows).map(|(row, side)| Traits {
            name: Cow::Owned(format!("{}{side}", row.name)),
            side: Side::BOTH.into_iter().find(|s| format!("{s:?}") == side),
            shortens: row.shortens,
            bulge_mm: row.bulge_mm,
            fold: row.fold,
        });
        let all: Vec<Traits> = all.collect();
        if all.len() > 256 {
            return Err(format!("{} muscles are too many", all.len()));
        }
        Ok(Self(Cow::Owned(all)))
    }

    /// Returns the number of muscles.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns the muscle with a name, regardless of case; `None` for an unknown name.
    #[must_use]
    pub fn by_name(&self, name: &str) -> Option<Muscle> {
        let is_it = |traits: &Traits| traits.name.eq_ignore_ascii_case(name);
        let place = self.0.iter().position(is_it)?;
        Some(Muscle(place as u8))
    }

    /// Returns the share of its length that a muscle loses at full contraction, 0 to 1, and the
    /// thickening of its middle, metres on the reference head. Designed: from the observed travel
    /// of the skin at its end. A muscle not in this table has no effect.
    pub(super) fn mechanics(&self, muscle: Muscle) -> (f32, f32) {
        let traits = self.0.get(muscle.index());
        traits.map_or((0.0, 0.0), |t| (t.shortens, t.bulge_mm * 1e-3))
    }

    /// Returns the channel of the wrinkle map into which the muscle folds the skin, and the
    /// strength.
    pub(super) fn fold(&self, muscle: Muscle) -> Option<(u8, f32)> {
        self.0.get(muscle.index())?.fold
    }
}

impl Muscle {
    /// Iterates over all muscles in the order of
    /// [`FaceControls::contraction`](super::FaceControls).
    pub fn all() -> impl Iterator<Item = Self> {
        (0..MUSCLES as u8).map(Self)
    }

    /// Returns the index of the muscle in [`FaceControls::contraction`](super::FaceControls).
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// Returns the name of the muscle in stories: anatomical, with its side at the end if it has
    /// one.
    #[must_use]
    pub fn name(self) -> &'static str {
        &ROWS[self.index()].name
    }

    /// Returns the muscle with a name, regardless of case; `None` for an unknown name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Anatomy::SHIPPED.by_name(name)
    }

    /// Returns the side of the face; `None` for the midline.
    #[must_use]
    pub fn side(self) -> Option<Side> {
        ROWS[self.index()].side
    }

    /// Returns the same muscle on the other side; a muscle in the middle returns itself.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self.side() {
            Some(Side::Left) => Self(self.0 + 1),
            Some(Side::Right) => Self(self.0 - 1),
            None => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{antagonists, table};

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
            assert!(Anatomy::SHIPPED.mechanics(muscle).0 > 0.0, "{muscle:?}");
        }
    }

    #[test]
    fn the_program_knows_what_the_table_says() {
        let rows = table::read(include_str!("muscles.tsv")).expect("a table");
        let told: Vec<_> = table::for_each_muscle(&rows).collect();
        assert_eq!(told.len(), MUSCLES);
        for (muscle, (row, side)) in Muscle::all().zip(told) {
            assert_eq!(muscle.name(), format!("{}{side}", row.name));
            let anatomy = Anatomy::SHIPPED;
            assert_eq!(
                anatomy.mechanics(muscle),
                (row.shortens, row.bulge_mm * 1e-3)
            );
            assert_eq!(anatomy.fold(muscle), row.fold);
            let closed = APART.iter().find(|a| a.0 == muscle).map(|a| [a.1, a.2]);
            assert_eq!(closed, row.closures);
            let jaw = CLOSES_JAW.iter().find(|a| a.0 == muscle);
            assert_eq!(jaw.map_or(0, |a| a.1), row.closes_jaw);
        }
        let shares: usize = rows.iter().map(|r| r.arkit.len()).sum();
        assert_eq!(ARKIT.len(), shares);
    }

    #[test]
    fn a_table_read_later_is_the_same_as_one_built_in() {
        let read = Anatomy::read(include_str!("muscles.tsv")).expect("a table");
        assert_eq!(read.count(), MUSCLES);
        for (a, b) in read.0.iter().zip(&ROWS) {
            assert_eq!(format!("{a:?}"), format!("{b:?}"));
        }
    }

    /// F&H table 4.6.
    #[test]
    fn antagonists_are_those_of_their_table() {
        let told: Vec<String> = ANTAGONISTS.map(|sets| format!("{sets:?}")).into();
        assert_eq!(
            told,
            [
                "([ZygomaticusMajorLeft], [DepressorAnguliOrisLeft])",
                "([ZygomaticusMajorRight], [DepressorAnguliOrisRight])",
                "([OrbicularisOrisUpper, OrbicularisOrisLower], [RisoriusLeft, RisoriusRight])",
                "([MentalisLeft, MentalisRight], \
                 [DepressorLabiiInferiorisLeft, DepressorLabiiInferiorisRight])",
            ]
        );
    }

    #[test]
    fn a_broken_table_of_antagonists_is_told() {
        let rows = table::read(include_str!("muscles.tsv")).expect("a table");
        for text in [
            "",
            "one\tother\n",
            "one\tother\tsides\nMentalis\tWiggler\tboth\n",
            "one\tother\tsides\nMentalis\tRisorius\tsome\n",
            "one\tother\tsides\nMentalis\tRisorius\n",
        ] {
            assert!(antagonists::read(text, &rows).is_err(), "{text}");
        }
    }

    /// `UPDATE=1` rewrites the table of `docs/face.md`.
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
            table += &format!(
                "| `{}{sides}` | {} | {} |\n",
                cells[0], cells[10], cells[11]
            );
        }
        let wanted = format!("{before}{begin}{table}{end}{after}");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, &wanted).expect("the page is written");
        }
        let page = std::fs::read_to_string(path).expect("the page of the face");
        assert!(
            page == wanted,
            "docs/face.md is stale: UPDATE=1 cargo test -p raconteur-tissue"
        );
    }

    #[test]
    fn a_broken_table_is_told() {
        let head = "name\tsides\tcode\tshortens\tbulge_mm\tfold\tarkit\tclosures\tcloses_jaw\n";
        let row = |cells: &str| format!("{head}{}\n", cells.replace(' ', "\t"));
        let good = row("A pair A 0.2 1 - - 30:20 5");
        assert!(table::read(&good).is_ok(), "the valid table is accepted");
        let bad = [
            "".to_owned(),
            "name\tsides\n".to_owned(),
            row("A pair A 0.2"),
            row("A both A 0.2 1 - - - 0"),
            row("A pair A 1.2 1 - - - 0"),
            row("A pair A 0.2 NaN - - - 0"),
            row("A pair A 0.2 1 3:1 - - 0"),
            row("A pair A 0.2 1 - jaw - 0"),
            row("A. pair A 0.2 1 - - - 0"),
            row("A pair A 0.2 1 - - 30 0"),
            row("A pair A 0.2 1 - - 30:101 0"),
            row("A pair A 0.2 1 - - - much"),
            format!("{good}A\tpair\tB\t0.2\t1\t-\t-\t-\t0\n"),
        ];
        for text in bad {
            assert!(table::read(&text).is_err(), "{text}");
        }
    }
}

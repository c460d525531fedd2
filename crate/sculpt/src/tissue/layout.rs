//! Layout of the mimic muscles on the reference head: grids of a few points, transferred to each
//! figure by its landmarks and fitted between skull and skin there (F&H section 3.1.2, "Building
//! Muscles"). The grids are in `fibres.tsv`, one fibre per row; only both rings of the mouth follow
//! from the lips' own nodes.
//!
//! Origins and insertions after Prometheus (Schünke, Schulte and Schumacher), as given in F&H
//! section 3.1.1 and table 3.1, and those of ear and temple after Gray's Anatomy; positions on the
//! mean head (millimetres, left half; origin between the tragions, x left, y up, z front) are
//! chosen by eye against its named points.

use raconteur_base::Side;

use raconteur_tissue::{Anatomy, Muscle};

pub(super) const FIBRES: &str = include_str!("fibres.tsv");

type Place = [f64; 3];

/// Direction of the fibres of a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Runs {
    /// Each fibre runs from its origin over intermediate points to its end in the skin.
    Linear,
    /// Along a curve, and towards a point.
    Towards(Place),
}

/// Area of skin that a sheet of muscle moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Moves {
    /// Skin of the face.
    Face,
    /// Skin at the side of the head, from the scalp to the jaw's angle.
    Aside,
    /// The same and the ear, which follows the fibre's end as a whole.
    Ear,
}

/// Sheet of fibres of one muscle in the layout on the mean head.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sheet {
    /// Sides of the sheet and its muscle on each. In the middle of the face it has only the left
    /// side if all of it is on the midline, otherwise both.
    pub(super) muscles: Vec<(Side, Muscle)>,
    pub(super) runs: Runs,
    /// Left fibres, or those of the midline: a few points each, on or over the skin, which are
    /// moved under it.
    pub(super) fibres: Vec<Vec<Place>>,
    /// Distances from a fibre up to which the skin follows fully, and beyond which it does not
    /// follow, mm.
    pub(super) reach: [f64; 2],
    /// Share of the fibre's movement that the skin over it follows.
    pub(super) pull: f64,
    /// Attachment of its ends to the ring of the mouth: middle of the position along it, as in
    /// [`crate::head::LipPlace::position`], half its width there, and the share of its movement
    /// that the ring follows.
    pub(super) ring: Option<[f64; 3]>,
    pub(super) moves: Moves,
}

/// Header of the table.
const COLUMNS: &str = "muscle\tcourse\treach_mm\tpull\tgrown_in\tskin\tplaces_mm";

/// The sheets of the shipped muscles.
#[allow(
    clippy::expect_used,
    reason = "the table is part of the program and tested"
)]
pub(super) fn shipped() -> Vec<Sheet> {
    read(FIBRES, &Anatomy::SHIPPED).expect("a table of fibres")
}

/// Reads the sheets of a table: consecutive rows of one muscle that differ only in their positions
/// form one sheet.
pub(super) fn read(text: &str, anatomy: &Anatomy) -> Result<Vec<Sheet>, String> {
    let mut lines = text.lines().filter(|l| !l.trim().is_empty());
    if lines.next() != Some(COLUMNS) {
        return Err(format!("the columns are {COLUMNS:?}"));
    }
    let mut sheets: Vec<Sheet> = Vec::new();
    for line in lines {
        let mut sheet = row(line, anatomy).map_err(|wrong| format!("{wrong} in {line:?}"))?;
        if let Some(last) = sheets.last_mut() {
            let fibres = core::mem::take(&mut last.fibres);
            let own = core::mem::take(&mut sheet.fibres);
            let is_same = *last == sheet;
            last.fibres = fibres;
            if is_same {
                last.fibres.extend(own);
                continue;
            }
            sheet.fibres = own;
        }
        sheets.push(sheet);
    }
    Ok(sheets)
}

fn row(line: &str, anatomy: &Anatomy) -> Result<Sheet, String> {
    let cells: Vec<&str> = line.split('\t').collect();
    let &[name, course, reach, pull, grown, skin, places] = &cells[..] else {
        return Err("expected seven columns".to_owned());
    };
    let fibre: Vec<Place> = places
        .split(' ')
        .map(|place| numbers(place, ','))
        .collect::<Result<_, _>>()?;
    if !(2..=100).contains(&fibre.len()) {
        return Err("a fibre has 2 to 100 places".to_owned());
    }
    let [pull] = numbers(pull, ' ')?;
    let of_side = |side: Side| anatomy.by_name(&format!("{name}{side:?}"));
    let muscles = match anatomy.by_name(name) {
        Some(muscle) if fibre.iter().all(|p| p[0] == 0.0) => vec![(Side::Left, muscle)],
        Some(muscle) => Side::BOTH.map(|side| (side, muscle)).into(),
        None => Side::BOTH
            .into_iter()
            .map(|side| Some((side, of_side(side)?)))
            .collect::<Option<_>>()
            .ok_or_else(|| format!("{name} is not a muscle"))?,
    };
    Ok(Sheet {
        muscles,
        runs: match course {
            "line" => Runs::Linear,
            centre => Runs::Towards(numbers(centre, ',')?),
        },
        fibres: vec![fibre],
        reach: numbers(reach, ':')?,
        pull,
        ring: match grown {
            "-" => None,
            some => Some(numbers(some, ':')?),
        },
        moves: match skin {
            "face" => Moves::Face,
            "aside" => Moves::Aside,
            "ear" => Moves::Ear,
            other => return Err(format!("{other} is not a skin region moved by muscles")),
        },
    })
}

/// Parses exactly `N` finite numbers separated by a character.
fn numbers<const N: usize>(text: &str, between: char) -> Result<[f64; N], String> {
    let number = |part: &str| part.parse().ok().filter(|x: &f64| x.is_finite());
    let all: Option<Vec<f64>> = text.split(between).map(number).collect();
    let all = all.and_then(|all| all.try_into().ok());
    all.ok_or_else(|| format!("{text:?} is not {N} numbers"))
}

/// Regions in which blood shows: positions on the mean head (left half), radius, mm, and strength.
/// Cheeks first, then nose, chin and forehead (by eye).
pub(super) const FLUSH: [([f64; 3], f64, f64); 6] = [
    ([44.0, -16.0, 84.0], 17.0, 1.0),
    ([28.0, -12.0, 91.0], 13.0, 0.7),
    ([0.0, -10.0, 119.0], 13.0, 0.6),
    ([0.0, -80.0, 101.0], 16.0, 0.35),
    ([18.0, 58.0, 94.0], 26.0, 0.25),
    ([0.0, -45.0, 106.0], 14.0, 0.35),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_muscle_but_the_rings_of_the_mouth_has_fibres() {
        let sheets = shipped();
        for muscle in Muscle::all() {
            let has_own = sheets
                .iter()
                .any(|sheet| sheet.muscles.iter().any(|(_, own)| *own == muscle));
            let is_ring = muscle.name().starts_with("OrbicularisOris");
            assert_ne!(has_own, is_ring, "{muscle:?}");
        }
    }

    #[test]
    fn rows_that_differ_in_places_alone_are_one_sheet() {
        let row = |cells: &str| format!("{}\n", cells.replace(' ', "\t").replace('_', " "));
        let text = format!("{COLUMNS}\n")
            + &row("Procerus line 5:12 0.9 - face 0,10,107_0,20,98")
            + &row("Mentalis line 6:15 0.7 22:10:0.3 face 5,-65,98_5,-70,99")
            + &row("Mentalis line 6:15 0.7 22:10:0.3 face 6,-65,98_6,-70,99")
            + &row("Mentalis line 6:15 0.8 - aside 5,-65,98_5,-70,99");
        let sheets = read(&text, &Anatomy::SHIPPED).expect("sheets");
        let told: Vec<_> = sheets
            .iter()
            .map(|s| (s.muscles.len(), s.fibres.len(), s.moves))
            .collect();
        let (face, aside) = (Moves::Face, Moves::Aside);
        assert_eq!(told, [(1, 1, face), (2, 2, face), (2, 1, aside)]);
        for bad in [
            "Wiggler line 5:12 0.9 - face 0,10,107_0,20,98",
            "Procerus line 5:12 0.9 - face 0,10,107",
            "Procerus line 5:12 0.9 - face 0,10_0,20",
            "Procerus bowed 5:12 0.9 - face 0,10,107_0,20,98",
            "Procerus line 5 0.9 - face 0,10,107_0,20,98",
            "Procerus line 5:12 NaN - face 0,10,107_0,20,98",
            "Procerus line 5:12 0.9 1:2 face 0,10,107_0,20,98",
            "Procerus line 5:12 0.9 - back 0,10,107_0,20,98",
            "Procerus line 5:12 0.9 - face",
        ] {
            let text = format!("{COLUMNS}\n{}", row(bad));
            assert!(read(&text, &Anatomy::SHIPPED).is_err(), "{bad}");
        }
        assert!(
            read("", &Anatomy::SHIPPED).is_err(),
            "an empty layout is rejected"
        );
    }
}

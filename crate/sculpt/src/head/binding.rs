//! Head as a proxy of the body model: the positions of the cage's vertices on the model's surface,
//! determined once on its mean head, and therefore for every person of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::sync::OnceLock;

use raconteur_base::{DQuat, DVec3, Side, mirror_vector};

use super::cage::{Key, Points};
use super::refined::{InFace, Refined};
use crate::model::{Model, ModelError, Traits, eye_centres};
use crate::subdivide::Stencil;

const TABLE: &str = include_str!("binding.tsv");
/// Rotation about x, degrees, from the model's head frame to this crate's: fitted to 33 landmarks
/// of the mean head.
const TILT_DEG: f64 = -2.581;
/// Tragion; the origin is the midpoint between the two.
const TRAGION: Key = Key::Grid(12, 9);

/// Kind of a point that is bound to the body model: a cage vertex or a point of the brow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Mark {
    /// A vertex of the cage.
    Cage(Key),
    /// The crest of the brow, from its inner end.
    Brow(u8),
}

impl Mark {
    /// Parses the mark from the first three fields of a table row; `None` if they are invalid.
    fn read(fields: &[&str]) -> Option<Self> {
        if *fields.first()? == BROW {
            return Some(Self::Brow(fields.get(2)?.parse().ok()?));
        }
        Some(Self::Cage(Key::read(fields)?))
    }

    fn parts(self) -> (&'static str, u8, u8) {
        match self {
            Self::Cage(key) => key.parts(),
            Self::Brow(k) => (BROW, 0, k),
        }
    }
}

const BROW: &str = "brow";

/// Point on the model's surface.
#[derive(Clone, Copy, Debug)]
struct Place {
    mark: Mark,
    side: Side,
    /// Face of the body.
    face: u32,
    at: InFace,
}

/// Bound points of both halves; midline ones count as left.
#[allow(
    clippy::expect_used,
    reason = "the table is part of the program and tested"
)]
fn table() -> &'static [Place] {
    static ROWS: OnceLock<Vec<Place>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let mut rows = Vec::new();
        for line in TABLE.lines().skip(2) {
            let fields: Vec<&str> = line.split('\t').collect();
            let mark = Mark::read(&fields).expect("a mark");
            for (side, place) in Side::BOTH.into_iter().zip(fields[3..].chunks(3)) {
                let number = |i: usize| place[i].parse().expect("a number");
                rows.push(Place {
                    mark,
                    side,
                    face: place[0].parse().expect("a face"),
                    at: [number(1), number(2)],
                });
            }
        }
        rows
    })
}

/// Returns the bound points in a fixed order.
fn keys() -> BTreeSet<(Mark, Side)> {
    table().iter().map(|p| (p.mark, p.side)).collect()
}

/// Refines the model's surface around the bound points.
pub(super) fn refined(faces: &[[u32; 4]]) -> Refined {
    Refined::new(faces, table().iter().map(|p| p.face).collect())
}

/// Binding of the head's cage (coarse control mesh) to the body model: each bound point is a
/// weighted sum over the vertices of the model's base mesh.
#[derive(Clone, Debug)]
pub struct Binding {
    stencils: Vec<Stencil>,
}

impl Binding {
    /// Prepares binding to a head model with these quads (vertex indices): for each bound point, the
    /// weights of the model's vertices after two subdivision steps. Only quads near bound points are
    /// subdivided.
    #[must_use]
    pub fn new(faces: &[[u32; 4]]) -> Self {
        let refined = refined(faces);
        let places = table().iter();
        Self {
            stencils: places.map(|p| refined.stencil(p.face, p.at)).collect(),
        }
    }

    /// Computes the transform from the model's frame to that of a person's head.
    fn frame(&self, shape: &[DVec3]) -> Frame {
        let turn = DQuat::from_rotation_x(TILT_DEG.to_radians());
        let ends = table().iter().zip(&self.stencils);
        let ends = ends.filter(|(place, _)| place.mark == Mark::Cage(TRAGION));
        let sum: DVec3 = ends
            .map(|(_, stencil)| turn * evaluate_stencil(stencil, shape))
            .sum();
        Frame {
            turn,
            origin: sum / 2.0,
        }
    }

    /// Evaluates the bound points of a person, in the frame of the head.
    #[must_use]
    pub fn bind(&self, shape: &[DVec3]) -> ModelHeadShape {
        let frame = self.frame(shape);
        let places = table().iter().zip(&self.stencils);
        ModelHeadShape {
            places: places
                .map(|(p, stencil)| {
                    (
                        (p.mark, p.side),
                        frame.apply(evaluate_stencil(stencil, shape)),
                    )
                })
                .collect(),
            globes: eye_centres(shape).map(|p| frame.apply(p)),
        }
    }

    /// Transforms the vertices of a person of the model to the frame of the head.
    pub(super) fn in_frame(&self, shape: &[DVec3]) -> Vec<DVec3> {
        let frame = self.frame(shape);
        shape.iter().map(|&p| frame.apply(p)).collect()
    }
}

/// Evaluates a weighted sum over the vertices of a person.
fn evaluate_stencil(stencil: &Stencil, shape: &[DVec3]) -> DVec3 {
    stencil.iter().map(|&(i, w)| shape[i as usize] * w).sum()
}

/// Transform from the frame of the model to the frame of a head.
struct Frame {
    turn: DQuat,
    /// Between the tragions, turned.
    origin: DVec3,
}

impl Frame {
    fn apply(&self, p: DVec3) -> DVec3 {
        self.turn * p - self.origin
    }
}

/// Head shape of one person of the body model: positions of the cage vertices, millimetres. Frame
/// of the head: origin between the tragions, x left, y up, z front.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelHeadShape {
    places: BTreeMap<(Mark, Side), DVec3>,
    globes: [DVec3; 2],
}

impl ModelHeadShape {
    /// Evaluates the body model for the traits of a person.
    ///
    /// # Errors
    /// Returns an error if the model lacks a target that the traits name.
    pub fn evaluate(model: &Model, traits: &Traits) -> Result<Self, ModelError> {
        Ok(Binding::new(model.faces()).bind(&model.shape(traits)?))
    }

    /// Parses the output of [`Self::to_text`]; `None` if the format is invalid.
    #[must_use]
    pub fn from_text(text: &str) -> Option<Self> {
        let mut bound = Self {
            places: BTreeMap::new(),
            globes: [DVec3::ZERO; 2],
        };
        for line in text.lines().skip(2) {
            let fields: Vec<&str> = line.split('\t').collect();
            let numbers: Vec<f64> = fields
                .get(3..)?
                .iter()
                .map(|s| s.parse())
                .collect::<Result<_, _>>()
                .ok()?;
            for (side, p) in Side::BOTH.into_iter().zip(numbers.chunks_exact(3)) {
                let p = DVec3::new(p[0], p[1], p[2]);
                if fields[0] == "globe" {
                    bound.globes[side.index()] = p;
                } else {
                    bound.places.insert((Mark::read(&fields)?, side), p);
                }
            }
        }
        table()
            .iter()
            .all(|p| bound.places.contains_key(&(p.mark, p.side)))
            .then_some(bound)
    }

    /// Returns all coordinates in one list, in the same order for all heads; millimetres.
    #[must_use]
    pub fn flat_coordinates_mm(&self) -> Vec<f64> {
        let bound = keys().into_iter().filter_map(|key| self.places.get(&key));
        bound
            .chain(&self.globes)
            .flat_map(DVec3::to_array)
            .collect()
    }

    /// Builds the head from the output of [`Self::flat_coordinates_mm`]; `None` if the count differs.
    #[must_use]
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let keys = keys();
        if numbers.len() != 3 * (keys.len() + 2) {
            return None;
        }
        let mut points = numbers
            .chunks_exact(3)
            .map(|p| DVec3::new(p[0], p[1], p[2]));
        let places = keys.into_iter().zip(points.by_ref()).collect();
        Some(Self {
            places,
            globes: [points.next()?, points.next()?],
        })
    }

    /// Formats the positions as a table, to a hundredth of a millimetre.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::from(
            "# Generated table. A person of the body model: places of the cage's vertices, mm, left and right.\n\
             ring\ta\tb\tx\ty\tz\tx\ty\tz\n",
        );
        let mut row = |name: &str, a: u8, b: u8, places: &[DVec3]| {
            let _ = write!(text, "{name}\t{a}\t{b}");
            for p in places {
                let _ = write!(text, "\t{:.2}\t{:.2}\t{:.2}", p.x, p.y, p.z);
            }
            text.push('\n');
        };
        row("globe", 0, 0, &self.globes);
        for (&(mark, side), &left) in &self.places {
            if side == Side::Right {
                continue;
            }
            let (name, a, b) = mark.parts();
            match self.places.get(&(mark, Side::Right)) {
                Some(&right) => row(name, a, b, &[left, right]),
                None => row(name, a, b, &[left]),
            }
        }
        text
    }

    /// Returns the position of a mark; `None` if it is not bound on that side.
    pub(super) fn position_of(&self, mark: Mark, side: Side) -> Option<DVec3> {
        self.places.get(&(mark, side)).copied()
    }

    /// Returns the head with every position displaced by `by`.
    pub(super) fn moved(&self, by: impl Fn(DVec3) -> DVec3) -> Self {
        let places = self.places.iter();
        Self {
            places: places.map(|(&key, &p)| (key, p + by(p))).collect(),
            globes: self.globes.map(|p| p + by(p)),
        }
    }

    /// Returns the position of a vertex of the cage; `None` if it is not bound.
    pub(super) fn place(&self, key: Key, side: Side) -> Option<DVec3> {
        self.position_of(Mark::Cage(key), side)
    }

    /// Returns the mean of a position and its mirror image, on the left.
    fn symmetric_at(&self, mark: Mark) -> Option<DVec3> {
        let left = *self.places.get(&(mark, Side::Left))?;
        let right = self.places.get(&(mark, Side::Right)).copied();
        Some((left + mirror_vector(right.unwrap_or(left))) / 2.0)
    }

    /// Returns the left half of the symmetrised head (mean of the head and its mirror image), mm.
    pub(super) fn symmetric(&self) -> Points {
        self.places
            .keys()
            .filter_map(|&(mark, side)| match mark {
                Mark::Cage(key) if side == Side::Left => Some((key, self.symmetric_at(mark)?)),
                _ => None,
            })
            .collect()
    }

    /// Returns the crest of the brow on a side, from its inner end outwards, mm.
    #[must_use]
    pub fn brow_of(&self, side: Side) -> Vec<DVec3> {
        (0..)
            .map_while(|k| self.position_of(Mark::Brow(k), side))
            .collect()
    }

    /// Returns the crest of the left brow of the symmetrised head, from its inner end outwards, mm.
    pub(super) fn brow(&self) -> Vec<DVec3> {
        (0..)
            .map_while(|k| self.symmetric_at(Mark::Brow(k)))
            .collect()
    }

    /// Returns the offset of a vertex of the cage from its position on the symmetric head; zero if
    /// it is not bound.
    pub(super) fn asymmetry(&self, key: Key, side: Side) -> DVec3 {
        let mark = Mark::Cage(key);
        let own = self.place(key, side);
        let Some((own, left)) = own.zip(self.symmetric_at(mark)) else {
            return DVec3::ZERO;
        };
        if side == Side::Left {
            own - left
        } else {
            own - mirror_vector(left)
        }
    }

    /// Returns the head with each eyeball moved outwards by `by_mm`, mm.
    pub(crate) fn with_eyes_apart(mut self, by_mm: f64) -> Self {
        self.globes[0].x += by_mm;
        self.globes[1].x -= by_mm;
        self
    }

    /// Returns the centre of the left eyeball of the symmetrised head, mm.
    pub(super) fn globe(&self) -> DVec3 {
        (self.globes[0] + mirror_vector(self.globes[1])) / 2.0
    }
}

/// Returns the table with some bindings replaced, by vertex of the cage and side.
pub(super) fn rewritten(found: &BTreeMap<(Key, Side), (u32, InFace)>) -> String {
    let mut text: String = TABLE
        .lines()
        .take(2)
        .map(|line| format!("{line}\n"))
        .collect();
    for place in table() {
        let own = match place.mark {
            Mark::Cage(key) => found.get(&(key, place.side)).copied(),
            Mark::Brow(_) => None,
        };
        let (face, [u, v]) = own.unwrap_or((place.face, place.at));
        if place.side == Side::Left {
            let (name, a, b) = place.mark.parts();
            let _ = write!(text, "{name}\t{a}\t{b}");
        }
        let _ = write!(text, "\t{face}\t{u:.4}\t{v:.4}");
        let is_last = match place.mark {
            Mark::Cage(key) => key.on_midline() || place.side == Side::Right,
            Mark::Brow(_) => place.side == Side::Right,
        };
        if is_last {
            text.push('\n');
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Columns of a plane of quads that replaces the model in tests.
    const COLUMNS: u32 = 120;

    /// Faces of the plane and its vertices; face `i` has its first corner at column and row of `i`.
    fn plane() -> (Vec<[u32; 4]>, Vec<DVec3>) {
        let last = table().iter().map(|p| p.face).max().unwrap();
        let rows = last / COLUMNS + 1;
        let wide = COLUMNS + 1;
        let at = |column: u32, row: u32| row * wide + column;
        let faces = (0..rows * COLUMNS)
            .map(|i| (i % COLUMNS, i / COLUMNS))
            .map(|(c, r)| [at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)])
            .collect();
        let mut points: Vec<DVec3> = (0..(rows + 1) * wide)
            .map(|v| DVec3::new(f64::from(v % wide), f64::from(v / wide), 0.0))
            .collect();
        // The model's spheres of the eyes have the last of the vertices that are read.
        points.resize(points.len().max(14742), DVec3::ZERO);
        (faces, points)
    }

    #[test]
    fn a_place_lies_where_the_table_says() {
        let (faces, points) = plane();
        let bound = Binding::new(&faces).bind(&points);
        let back = DQuat::from_rotation_x(-TILT_DEG.to_radians());
        let on_plane = |p: &Place| {
            let corner = DVec3::new(
                f64::from(p.face % COLUMNS),
                f64::from(p.face / COLUMNS),
                0.0,
            );
            corner + DVec3::new(p.at[0], p.at[1], 0.0)
        };
        let first = &table()[0];
        let origin = on_plane(first) - back * bound.places[&(first.mark, first.side)];
        for place in table() {
            let got = back * bound.places[&(place.mark, place.side)] + origin;
            let error = got.distance(on_plane(place));
            assert!(error < 1e-9, "{place:?}: {error}");
        }
    }

    #[test]
    fn both_halves_are_bound_and_the_origin_lies_between_the_tragions() {
        let keys: BTreeSet<(Mark, Side)> = table().iter().map(|p| (p.mark, p.side)).collect();
        assert_eq!(keys.len(), table().len());
        for &(mark, side) in &keys {
            let is_middle = matches!(mark, Mark::Cage(key) if key.on_midline());
            assert!(
                is_middle != keys.contains(&(mark, side.opposite())),
                "{mark:?}"
            );
        }
        let (faces, points) = plane();
        let bound = Binding::new(&faces).bind(&points);
        let ends = Side::BOTH.map(|side| bound.places[&(Mark::Cage(TRAGION), side)]);
        assert!(
            (ends[0] + ends[1]).length() < 1e-9,
            "both tragions are symmetric about the origin"
        );
    }

    #[test]
    fn a_table_of_a_person_comes_back_and_a_broken_one_does_not() {
        let (faces, points) = plane();
        let bound = Binding::new(&faces).bind(&points);
        let text = bound.to_text();
        let back = ModelHeadShape::from_text(&text).unwrap();
        for (name, place) in &bound.places {
            assert!(back.places[name].distance(*place) < 0.01, "{name:?}");
        }
        assert_eq!(
            ModelHeadShape::from_text(&back.to_text())
                .unwrap()
                .to_text(),
            back.to_text()
        );
        let cut = text.lines().count() / 2;
        let half: String = text.lines().take(cut).map(|l| format!("{l}\n")).collect();
        let shipped = crate::people::preset("sofia").unwrap();
        assert!(
            shipped.head.bound.to_text().len() > half.len(),
            "the truncated table is shorter than the complete one"
        );
        for broken in [
            "",
            "a\nb\nc\n",
            &half,
            &text.replace("grid\t0\t0", "grid\tx\t0"),
        ] {
            assert!(
                ModelHeadShape::from_text(broken).is_none(),
                "a broken head table is rejected"
            );
        }
    }
}

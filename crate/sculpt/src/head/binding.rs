//! The head as a proxy of the body model: where the cage's vertices lie on the model's
//! surface, found once on its mean head, and so on every person of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::sync::OnceLock;

use raconteur_base::{DQuat, DVec3, Side, mirror_vector};

use super::cage::{Key, Points};
use super::points::key;
use crate::model::{Model, ModelError, Traits, eye_centres};
use crate::subdivide::{Stencil, subdivide};

const TABLE: &str = include_str!("binding.tsv");
/// Turn about x, degrees, that brings the model's head into our frame: the fit of 33 landmarks
/// of the mean head.
const TILT_DEG: f64 = -2.581;
/// Where the tragions lie, between which is the origin.
const TRAGION: Key = Key::Grid(12, 9);

/// What lies at a bound place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Mark {
    /// A vertex of the cage.
    Cage(Key),
    /// The crest of the brow, from its inner end.
    Brow(u8),
}

impl Mark {
    /// In the first three fields of a table's row.
    fn read(fields: &[&str]) -> Option<Self> {
        if *fields.first()? == BROW {
            return Some(Self::Brow(fields.get(2)?.parse().ok()?));
        }
        Some(Self::Cage(key(fields)?))
    }

    fn parts(self) -> (&'static str, u8, u8) {
        match self {
            Self::Cage(key) => key.parts(),
            Self::Brow(k) => (BROW, 0, k),
        }
    }
}

const BROW: &str = "brow";

/// A place on the model's surface.
#[derive(Clone, Copy, Debug)]
struct Place {
    mark: Mark,
    side: Side,
    /// Face of the body.
    face: u32,
    /// From its first corner along its first edge and along its last, 0..1.
    at: [f64; 2],
}

/// The places of both halves; midline ones count as left.
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

/// Child of a quad that a place lies in, and the place in it.
fn child([u, v]: [f64; 2]) -> (usize, [f64; 2]) {
    match (u > 0.5, v > 0.5) {
        (false, false) => (0, [2.0 * u, 2.0 * v]),
        (true, false) => (1, [2.0 * v, 2.0 * (1.0 - u)]),
        (true, true) => (2, [2.0 * (1.0 - u), 2.0 * (1.0 - v)]),
        (false, true) => (3, [2.0 * (1.0 - v), 2.0 * u]),
    }
}

/// The bound places as sums over the vertices of the model's base mesh.
#[derive(Clone, Debug)]
pub struct Binding {
    stencils: Vec<Stencil>,
}

impl Binding {
    /// Composes the table with two steps of subdivision, of the model's faces round the bound
    /// ones alone.
    #[must_use]
    pub fn new(faces: &[[u32; 4]]) -> Self {
        let bound: BTreeSet<u32> = table().iter().map(|p| p.face).collect();
        let mut near = bound;
        // Within two steps a face feels its neighbours' neighbours.
        for _ in 0..2 {
            let touched: BTreeSet<u32> = near.iter().flat_map(|&f| faces[f as usize]).collect();
            near = (0u32..)
                .zip(faces)
                .filter(|(_, f)| f.iter().any(|v| touched.contains(v)))
                .map(|(i, _)| i)
                .collect();
        }
        let vertices: Vec<u32> = {
            let all: BTreeSet<u32> = near.iter().flat_map(|&f| faces[f as usize]).collect();
            all.into_iter().collect()
        };
        let index: BTreeMap<u32, u32> = vertices.iter().copied().zip(0u32..).collect();
        let local: Vec<Vec<u32>> = near
            .iter()
            .map(|&f| faces[f as usize].iter().map(|v| index[v]).collect())
            .collect();
        let place_of: BTreeMap<u32, usize> = near.iter().copied().zip(0..).collect();
        let fine = subdivide(&local, vertices.len(), 2);
        let stencils = table()
            .iter()
            .map(|place| {
                let (first, at) = child(place.at);
                let (second, [u, v]) = child(at);
                let quad = &fine.faces[4 * (4 * place_of[&place.face] + first) + second];
                let corners = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
                let mut sum: BTreeMap<u32, f64> = BTreeMap::new();
                for (&corner, weight) in quad.iter().zip(corners) {
                    for &(i, w) in &fine.stencils[corner as usize] {
                        *sum.entry(vertices[i as usize]).or_default() += w * weight;
                    }
                }
                sum.into_iter().collect()
            })
            .collect();
        Self { stencils }
    }

    /// The bound places of a person, in the frame of the head.
    #[must_use]
    pub fn bind(&self, shape: &[DVec3]) -> Bound {
        let turn = DQuat::from_rotation_x(TILT_DEG.to_radians());
        let mut places: BTreeMap<(Mark, Side), DVec3> = table()
            .iter()
            .zip(&self.stencils)
            .map(|(place, stencil)| {
                let p: DVec3 = stencil.iter().map(|&(i, w)| shape[i as usize] * w).sum();
                ((place.mark, place.side), turn * p)
            })
            .collect();
        let origin: DVec3 = Side::BOTH
            .iter()
            .filter_map(|&side| places.get(&(Mark::Cage(TRAGION), side)))
            .sum::<DVec3>()
            / 2.0;
        for p in places.values_mut() {
            *p -= origin;
        }
        Bound {
            places,
            globes: eye_centres(shape).map(|p| turn * p - origin),
        }
    }
}

/// The head of one person of the model: where it puts the cage's vertices, in millimetres.
/// Frame of the head: origin between the tragions, x left, y up, z front.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    places: BTreeMap<(Mark, Side), DVec3>,
    globes: [DVec3; 2],
}

impl Bound {
    /// Evaluates the model.
    ///
    /// # Errors
    /// When the model lacks what the traits name.
    pub fn of(model: &Model, traits: &Traits) -> Result<Self, ModelError> {
        Ok(Binding::new(model.faces()).bind(&model.shape(traits)?))
    }

    /// Reads what [`Self::to_text`] wrote; `None` when it is something else.
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

    /// The places as a table, to a hundredth of a millimetre.
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

    /// The mean of a place and its mirror image, on the left.
    fn symmetric_at(&self, mark: Mark) -> Option<DVec3> {
        let left = *self.places.get(&(mark, Side::Left))?;
        let right = self.places.get(&(mark, Side::Right)).copied();
        Some((left + mirror_vector(right.unwrap_or(left))) / 2.0)
    }

    /// The left half of the mean of the head and its mirror image.
    pub(super) fn symmetric(&self) -> Points {
        self.places
            .keys()
            .filter_map(|&(mark, side)| match mark {
                Mark::Cage(key) if side == Side::Left => Some((key, self.symmetric_at(mark)?)),
                _ => None,
            })
            .collect()
    }

    /// The crest of the left brow from its inner end, symmetric.
    pub(super) fn brow(&self) -> Vec<DVec3> {
        (0..)
            .map_while(|k| self.symmetric_at(Mark::Brow(k)))
            .collect()
    }

    /// How far a vertex of the cage lies from where it is on the symmetric head; nothing for one
    /// that is not bound.
    pub(super) fn asymmetry(&self, key: Key, side: Side) -> DVec3 {
        let mark = Mark::Cage(key);
        let own = self.places.get(&(mark, side));
        let Some((&own, left)) = own.zip(self.symmetric_at(mark)) else {
            return DVec3::ZERO;
        };
        if side == Side::Left {
            own - left
        } else {
            own - mirror_vector(left)
        }
    }

    /// The left eye's centre in the model, symmetric.
    pub(super) fn globe(&self) -> DVec3 {
        (self.globes[0] + mirror_vector(self.globes[1])) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of a plane of quads that stands in for the model.
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
        assert!((ends[0] + ends[1]).length() < 1e-9);
    }

    #[test]
    fn a_table_of_a_person_comes_back_and_a_broken_one_does_not() {
        let (faces, points) = plane();
        let bound = Binding::new(&faces).bind(&points);
        let text = bound.to_text();
        let back = Bound::from_text(&text).unwrap();
        for (name, place) in &bound.places {
            assert!(back.places[name].distance(*place) < 0.01, "{name:?}");
        }
        assert_eq!(
            Bound::from_text(&back.to_text()).unwrap().to_text(),
            back.to_text()
        );
        let cut = text.lines().count() / 2;
        let half: String = text.lines().take(cut).map(|l| format!("{l}\n")).collect();
        let shipped = crate::people::preset("sofia").unwrap();
        assert!(shipped.head.traits.is_some() && shipped.head.bound.is_some());
        for broken in [
            "",
            "a\nb\nc\n",
            &half,
            &text.replace("grid\t0\t0", "grid\tx\t0"),
        ] {
            assert!(Bound::from_text(broken).is_none());
        }
    }
}

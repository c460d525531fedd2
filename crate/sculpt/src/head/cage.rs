//! Topology of the cage: a grid over the head with concentric rings about eyes, mouth, nostrils and
//! ears, half of it mirrored.
//!
//! The base grid has 21 columns (0 on the front midline, 20 on the back midline) and 32 rows (0
//! near the hairline, 31 at the neck's base). Rectangular holes are filled with rings whose ring 0
//! is the hole's own border, so that every inner corner of a hole becomes a pole of five edges at a
//! usual modelling position. The crown is a patch folded onto row 0.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side};

/// Last column of the grid.
pub(crate) const LAST_COLUMN: u8 = 20;
/// Last row of the grid, the neck's rim.
pub(crate) const LAST_ROW: u8 = 31;
const CROWN_WIDTH: u8 = 6;
const CROWN_LENGTH: u8 = 8;
/// Rings of eye, mouth, nostril and ear, ring 0 included.
const RINGS: [u8; 4] = [9, 9, 4, 11];

/// Positions of the cage vertices on the left half of a head, mm.
pub(crate) type Points = BTreeMap<Key, DVec3>;

/// Key of a vertex in one half of the head's cage (coarse control mesh). Rings: (ring, position
/// along it).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Key {
    /// Column, row.
    Grid(u8, u8),
    /// Ring 0 orbital rim, 1 sulcus, 2 fold, 3 crease, 4 lid plate, 5 lash edge, 6 inner
    /// margin, 7 and 8 lining; 16 positions: 0 inner corner, 4 upper middle, 8 outer corner.
    Eye(u8, u8),
    /// Ring 0 perioral, 1 border of the red, 2 just inside, 3 fullest, 4 roll-in, 5
    /// contact, 6 vestibule, 7 and 8 bag; 13 positions: 0 upper middle, 6 corner, 12 lower.
    Mouth(u8, u8),
    /// Rim, inset, two rising rings; 8 positions.
    Nostril(u8, u8),
    /// Root, back, outer back, rim, rim inside, scapha, antihelix foot, concha edge, concha
    /// floor, canal; 18 positions.
    Ear(u8, u8),
    /// Patch on top: along the midline from the front, across.
    Crown(u8, u8),
}

const EYE_BORDER: [(u8, u8); 16] = [
    (4, 6),
    (4, 5),
    (4, 4),
    (5, 4),
    (6, 4),
    (7, 4),
    (8, 4),
    (8, 5),
    (8, 6),
    (8, 7),
    (8, 8),
    (7, 8),
    (6, 8),
    (5, 8),
    (4, 8),
    (4, 7),
];
const MOUTH_BORDER: [(u8, u8); 13] = [
    (0, 16),
    (1, 16),
    (2, 16),
    (3, 16),
    (4, 16),
    (4, 17),
    (4, 18),
    (4, 19),
    (4, 20),
    (3, 20),
    (2, 20),
    (1, 20),
    (0, 20),
];
const NOSTRIL_BORDER: [(u8, u8); 8] = [
    (1, 13),
    (1, 12),
    (2, 12),
    (3, 12),
    (3, 13),
    (3, 14),
    (2, 14),
    (1, 14),
];
const EAR_BORDER: [(u8, u8); 18] = [
    (12, 9),
    (12, 8),
    (12, 7),
    (12, 6),
    (13, 6),
    (14, 6),
    (15, 6),
    (15, 7),
    (15, 8),
    (15, 9),
    (15, 10),
    (15, 11),
    (15, 12),
    (14, 12),
    (13, 12),
    (12, 12),
    (12, 11),
    (12, 10),
];

impl Key {
    /// Returns an eye vertex; ring 0 lies on the grid, positions wrap.
    pub(crate) fn eye(ring: u8, k: usize) -> Self {
        let (c, r) = EYE_BORDER[k % 16];
        if ring == 0 {
            Self::Grid(c, r)
        } else {
            Self::Eye(ring, (k % 16) as u8)
        }
    }

    /// Returns a mouth vertex; ring 0 lies on the grid.
    pub(crate) fn mouth(ring: u8, k: usize) -> Self {
        let (c, r) = MOUTH_BORDER[k];
        if ring == 0 {
            Self::Grid(c, r)
        } else {
            Self::Mouth(ring, k as u8)
        }
    }

    /// Returns a nostril vertex; ring 0 lies on the grid, positions wrap.
    pub(crate) fn nostril(ring: u8, k: usize) -> Self {
        let (c, r) = NOSTRIL_BORDER[k % 8];
        if ring == 0 {
            Self::Grid(c, r)
        } else {
            Self::Nostril(ring, (k % 8) as u8)
        }
    }

    /// Returns an ear vertex; ring 0 lies on the grid, positions wrap.
    pub(crate) fn ear(ring: u8, k: usize) -> Self {
        let (c, r) = EAR_BORDER[k % 18];
        if ring == 0 {
            Self::Grid(c, r)
        } else {
            Self::Ear(ring, (k % 18) as u8)
        }
    }

    /// Returns a crown vertex; three of the patch's sides lie on row 0.
    pub(crate) fn crown(p: u8, q: u8) -> Self {
        if p == 0 {
            Self::Grid(q, 0)
        } else if p == CROWN_LENGTH {
            Self::Grid(LAST_COLUMN - q, 0)
        } else if q == CROWN_WIDTH {
            Self::Grid(CROWN_WIDTH + p, 0)
        } else {
            Self::Crown(p, q)
        }
    }

    /// Parses the key from the first three fields of a table row, in the notation of
    /// [`Self::parts`]; `None` if they are invalid.
    pub(crate) fn read(fields: &[&str]) -> Option<Self> {
        let number = |i: usize| fields.get(i)?.parse::<u8>().ok();
        let (a, b) = (number(1)?, number(2)?);
        Some(match *fields.first()? {
            "grid" => Self::Grid(a, b),
            "eye" if b < 16 => Self::eye(a, usize::from(b)),
            "mouth" if b < 13 => Self::mouth(a, usize::from(b)),
            "nostril" => Self::Nostril(a, b),
            "ear" => Self::Ear(a, b),
            "crown" => Self::Crown(a, b),
            _ => return None,
        })
    }

    /// Returns the notation of the key in tables: ring name, ring number, position along the ring.
    pub(crate) fn parts(self) -> (&'static str, u8, u8) {
        match self {
            Self::Grid(a, b) => ("grid", a, b),
            Self::Eye(a, b) => ("eye", a, b),
            Self::Mouth(a, b) => ("mouth", a, b),
            Self::Nostril(a, b) => ("nostril", a, b),
            Self::Ear(a, b) => ("ear", a, b),
            Self::Crown(a, b) => ("crown", a, b),
        }
    }

    /// Returns true if both halves share the vertex.
    pub(crate) fn on_midline(self) -> bool {
        match self {
            Self::Grid(c, _) => c == 0 || c == LAST_COLUMN,
            Self::Mouth(_, k) => k == 0 || k == 12,
            Self::Crown(_, q) => q == 0,
            _ => false,
        }
    }

    /// Returns ring and position on the mouth's rings, ring 0 included; `None` for other vertices.
    pub(crate) fn mouth_position(self) -> Option<(u8, usize)> {
        match self {
            Self::Mouth(r, k) => Some((r, usize::from(k))),
            Self::Grid(c, r) => MOUTH_BORDER
                .iter()
                .position(|&b| b == (c, r))
                .map(|k| (0, k)),
            _ => None,
        }
    }
}

/// Zone of a cage face, which selects its material and part. Rings count from the outer one of the
/// two that bound the zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Zone {
    /// Outside all rings: the column and row of its upper inner corner.
    Grid(u8, u8),
    /// Between two rings of an eye.
    Eye(u8),
    /// Between two rings of the mouth; 8 is the bag's back.
    Mouth(u8),
    /// Between two rings of a nostril; 3 is its end.
    Nostril(u8),
    /// Between two rings of an ear; 10 is the canal's end.
    Ear(u8),
    /// Zone at the top of the skull.
    Crown,
}

/// Cage (coarse control mesh) of the whole head, shared by all people.
#[derive(Clone, Debug)]
pub(crate) struct Cage {
    /// Faces, counter-clockwise from outside.
    pub(crate) faces: Vec<Vec<u32>>,
    /// Zone of each face.
    pub(crate) zones: Vec<Zone>,
    /// Key and side of each vertex; midline vertices count as left.
    pub(crate) keys: Vec<(Key, Side)>,
    index: BTreeMap<(Key, Side), u32>,
}

fn half_faces() -> Vec<(Vec<Key>, Zone)> {
    let mut faces = Vec::new();
    let within = |i: u8, j: u8, c: core::ops::Range<u8>, r: core::ops::Range<u8>| {
        c.contains(&i) && r.contains(&j)
    };
    for j in 0..LAST_ROW {
        for i in 0..LAST_COLUMN {
            let hole = within(i, j, 4..8, 4..8)
                || within(i, j, 0..4, 16..20)
                || within(i, j, 1..3, 12..14)
                || within(i, j, 12..15, 6..12);
            if !hole {
                let g = Key::Grid;
                let quad = vec![g(i, j), g(i, j + 1), g(i + 1, j + 1), g(i + 1, j)];
                faces.push((quad, Zone::Grid(i, j)));
            }
        }
    }
    type Ring = (fn(u8, usize) -> Key, fn(u8) -> Zone, usize);
    let rings: [Ring; 4] = [
        (Key::eye, Zone::Eye, 16),
        (Key::mouth, Zone::Mouth, 12),
        (Key::nostril, Zone::Nostril, 8),
        (Key::ear, Zone::Ear, 18),
    ];
    for ((key, zone, n), count) in rings.into_iter().zip(RINGS) {
        for r in 0..count - 1 {
            for k in 0..n {
                let quad = vec![key(r, k), key(r + 1, k), key(r + 1, k + 1), key(r, k + 1)];
                faces.push((quad, zone(r)));
            }
        }
    }
    for p in 0..CROWN_LENGTH {
        for q in 0..CROWN_WIDTH {
            let c = Key::crown;
            let quad = vec![c(p, q), c(p, q + 1), c(p + 1, q + 1), c(p + 1, q)];
            faces.push((quad, Zone::Crown));
        }
    }
    let (canal, end) = (RINGS[3] - 1, RINGS[2] - 1);
    faces.push((
        (0..18).rev().map(|k| Key::ear(canal, k)).collect(),
        Zone::Ear(canal),
    ));
    faces.push((
        (0..8).rev().map(|k| Key::nostril(end, k)).collect(),
        Zone::Nostril(end),
    ));
    faces
}

impl Cage {
    /// Builds the topology; there is only one.
    pub(crate) fn new() -> Self {
        let mut cage = Self {
            faces: Vec::new(),
            zones: Vec::new(),
            keys: Vec::new(),
            index: BTreeMap::new(),
        };
        for (half, zone) in half_faces() {
            for side in Side::BOTH {
                let mut face: Vec<u32> = half.iter().map(|&k| cage.intern(k, side)).collect();
                if side == Side::Right {
                    face.reverse();
                }
                cage.faces.push(face);
                cage.zones.push(zone);
            }
        }
        // The back of the mouth bag spans both halves.
        let bag = RINGS[1] - 1;
        let left = (0..13).map(|k| (k, Side::Left));
        let right = (1..12).rev().map(|k| (k, Side::Right));
        let back = left
            .chain(right)
            .rev()
            .map(|(k, s)| cage.intern(Key::mouth(bag, k), s))
            .collect();
        cage.faces.push(back);
        cage.zones.push(Zone::Mouth(bag));
        cage
    }

    fn intern(&mut self, key: Key, side: Side) -> u32 {
        let side = if key.on_midline() { Side::Left } else { side };
        *self.index.entry((key, side)).or_insert_with(|| {
            self.keys.push((key, side));
            self.keys.len() as u32 - 1
        })
    }

    /// Returns the number of vertices.
    pub(crate) fn len(&self) -> usize {
        self.keys.len()
    }

    /// Returns true if the cage has the vertex.
    pub(crate) fn has(&self, key: Key) -> bool {
        self.index.contains_key(&(key, Side::Left))
    }

    /// Index of a vertex.
    ///
    /// # Panics
    /// Panics if the key does not name a vertex; keys come from code.
    #[allow(
        clippy::expect_used,
        reason = "keys come from code and the topology is fixed"
    )]
    pub(crate) fn vertex(&self, key: Key, side: Side) -> usize {
        let side = if key.on_midline() { Side::Left } else { side };
        *self.index.get(&(key, side)).expect("a vertex of the cage") as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subdivide::edge_faces;

    #[test]
    fn neighbouring_faces_turn_the_same_way() {
        let cage = Cage::new();
        let mut seen = std::collections::BTreeSet::new();
        for face in &cage.faces {
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                let keys = (cage.keys[a as usize], cage.keys[b as usize]);
                assert!(seen.insert((a, b)), "{keys:?}");
            }
        }
    }

    #[test]
    fn the_cage_is_manifold_and_open_at_the_neck_and_behind_the_lids_only() {
        let cage = Cage::new();
        let edges = edge_faces(&cage.faces);
        assert!(
            edges.values().all(|f| f.len() <= 2),
            "no edge of the cage has more than two faces"
        );
        for (&(a, b), f) in &edges {
            if f.len() == 1 {
                for v in [a, b] {
                    let key = cage.keys[v as usize].0;
                    assert!(
                        matches!(key, Key::Grid(_, LAST_ROW) | Key::Eye(8, _)),
                        "{key:?}"
                    );
                }
            }
        }
    }
}

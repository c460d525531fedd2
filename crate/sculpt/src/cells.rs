//! Points in cubic cells, for searches by position.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

/// Points indexed by cubic grid cell, to find those near a position.
pub(crate) struct Cells {
    width: f64,
    cells: BTreeMap<[i32; 3], Vec<u32>>,
}

impl Cells {
    /// Sorts points into cells of a width, in the points' unit.
    pub(crate) fn new(points: &[DVec3], width: f64) -> Self {
        let mut sorted = Self {
            width,
            cells: BTreeMap::new(),
        };
        for (i, &p) in (0u32..).zip(points) {
            let cell = sorted.cell(p);
            sorted.cells.entry(cell).or_default().push(i);
        }
        sorted
    }

    fn cell(&self, p: DVec3) -> [i32; 3] {
        (p / self.width).floor().to_array().map(|x| x as i32)
    }

    /// Returns the points of a position's cell and of the 26 around it: all within a cell's width,
    /// and some beyond.
    pub(crate) fn neighbours(&self, p: DVec3) -> impl Iterator<Item = u32> + '_ {
        let [x, y, z] = self.cell(p);
        (0..27)
            .map(move |i| [x + i / 9 - 1, y + i / 3 % 3 - 1, z + i % 3 - 1])
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .copied()
    }
}

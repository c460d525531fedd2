//! Canvas of a sheet and its tile layout.

use super::caption;

/// Space between tiles, pixels.
const GAP: u32 = 4;
/// Strip under a tile for its caption, pixels.
const STRIP: u32 = 22;
/// Pixels of a caption's dot.
const DOT: u32 = 2;
const PAPER: [u8; 4] = [28, 28, 30, 255];
const INK: [u8; 4] = [232, 230, 224, 255];

/// RGBA image of a contact sheet; rows from the top.
pub(crate) struct Picture {
    width: u32,
    height: u32,
    rgba: Vec<u8>,
}

/// Layout of a contact sheet: the position of each tile, row after row, and the size.
pub(crate) struct Layout {
    /// Upper left corner of each tile.
    pub(crate) places: Vec<(u32, u32)>,
    size: (u32, u32),
}

impl Layout {
    /// Lays tiles of one height and these widths, at most `row` pixels to a row.
    pub(crate) fn new(widths: &[u32], height: u32, row: u32) -> Self {
        let (mut x, mut y, mut right) = (GAP, GAP, 0);
        let mut places = Vec::new();
        for &width in widths {
            if x > GAP && x + width + GAP > row {
                (x, y) = (GAP, y + height + STRIP);
            }
            places.push((x, y));
            x += width + GAP;
            right = right.max(x);
        }
        Self {
            places,
            size: (right.max(1), y + height + STRIP),
        }
    }

    /// Lays tiles of one height in cells as wide as the widest, `columns` to a row, edge to
    /// edge.
    pub(crate) fn grid(widths: &[u32], height: u32, columns: u32) -> Self {
        let cell = widths.iter().copied().max().unwrap_or(1);
        let columns = columns.max(1);
        let count = u32::try_from(widths.len()).unwrap_or(u32::MAX);
        let places = (0..count).map(|i| (i % columns * cell, i / columns * height));
        Self {
            places: places.collect(),
            size: (
                columns.min(count.max(1)) * cell,
                count.div_ceil(columns).max(1) * height,
            ),
        }
    }
}

impl Picture {
    /// Creates an empty image for a layout.
    pub(crate) fn new(layout: &Layout) -> Self {
        let (width, height) = layout.size;
        Self {
            width,
            height,
            rgba: PAPER.repeat(width as usize * height as usize),
        }
    }

    /// Returns width and height, pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Returns the RGBA pixels, row by row from the top.
    pub(crate) fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// Lays a tile down.
    pub(crate) fn place_tile(&mut self, (x, y): (u32, u32), (width, _): (u32, u32), tile: &[u8]) {
        let bytes = 4 * width as usize;
        for (row, line) in tile.chunks_exact(bytes).enumerate() {
            let at = 4 * ((y as usize + row) * self.width as usize + x as usize);
            self.rgba[at..at + bytes].copy_from_slice(line);
        }
    }

    /// Writes a tile's caption under it.
    pub(crate) fn write_under(
        &mut self,
        (x, y): (u32, u32),
        (width, height): (u32, u32),
        text: &str,
    ) {
        let top = y + height + (STRIP - caption::HEIGHT * DOT) / 2;
        let (mut right, paper) = (x + width, &mut self.rgba);
        right = right.min(self.width);
        caption::dots(text, |dx, dy| {
            for (px, py) in (0..DOT).flat_map(|a| (0..DOT).map(move |b| (a, b))) {
                let (px, py) = (x + 2 + dx * DOT + px, top + dy * DOT + py);
                if px < right && py < self.height {
                    let at = 4 * (py * self.width + px) as usize;
                    paper[at..at + 4].copy_from_slice(&INK);
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_go_to_the_next_row_and_none_is_cut() {
        let layout = Layout::new(&[100, 50, 100], 80, 180);
        let picture = Picture::new(&layout);
        let (width, height) = picture.size();
        assert_eq!(layout.places.len(), 3);
        assert!(
            layout.places[2].1 > layout.places[0].1,
            "the third tile is in the next row"
        );
        for (place, tile) in layout.places.iter().zip([100, 50, 100]) {
            assert!(
                place.0 + tile <= width && place.1 + 80 < height,
                "the tile and its caption are within the sheet"
            );
        }
    }

    #[test]
    fn a_grid_leaves_no_gaps() {
        let layout = Layout::grid(&[80; 5], 80, 2);
        assert_eq!(
            layout.places,
            [(0, 0), (80, 0), (0, 80), (80, 80), (0, 160)]
        );
        assert_eq!(Picture::new(&layout).size(), (160, 240));
        assert_eq!(Picture::new(&Layout::grid(&[], 80, 8)).size(), (1, 80));
    }
}

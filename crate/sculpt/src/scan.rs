//! Head mesh of another source, from a Wavefront OBJ file.

use raconteur_base::DVec3;

/// Maximum number of points of an accepted mesh.
const MAX_POINTS: usize = 1 << 20;
/// Maximum number of corners of a face.
const CORNERS: usize = 64;

/// Imported head mesh as read from an OBJ file, in the file's own units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scan {
    /// Positions of the points.
    pub points: Vec<DVec3>,
    /// Linear RGB of each point, 0 to 1, if the file contains colours.
    pub colors: Vec<[f64; 3]>,
    /// Corners of each face, counter-clockwise from outside.
    pub faces: Vec<Vec<u32>>,
}

/// Error returned for a line that is not valid OBJ; contains the line number, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {0} of the mesh is not understood")]
pub struct BadLine(pub usize);

impl Scan {
    /// Reads `v` and `f`; texture coordinates, normals and materials are ignored. Vertex colours
    /// are used only if every vertex has one.
    ///
    /// # Errors
    /// Returns an error if a line cannot be read, or the mesh has more than a million points or
    /// faces.
    pub fn read(obj: &str) -> Result<Self, BadLine> {
        let mut scan = Self::default();
        for (i, line) in obj.lines().enumerate() {
            let bad = BadLine(i + 1);
            let mut words = line.split_ascii_whitespace();
            match words.next() {
                Some("v") if scan.points.len() < MAX_POINTS => {
                    let numbers: Vec<f64> = words.map_while(|w| w.parse().ok()).collect();
                    if numbers.len() < 3 || numbers.iter().any(|x: &f64| !x.is_finite()) {
                        return Err(bad);
                    }
                    scan.points
                        .push(DVec3::new(numbers[0], numbers[1], numbers[2]));
                    if let &[_, _, _, r, g, b] = &numbers[..] {
                        scan.colors.push([r, g, b].map(|x| x.clamp(0.0, 1.0)));
                    }
                }
                Some("f") if scan.faces.len() < MAX_POINTS => {
                    scan.faces.push(face(words).ok_or(bad)?);
                }
                Some("v" | "f") => return Err(bad),
                _ => {}
            }
        }
        let count = scan.points.len();
        if scan.colors.len() != count {
            scan.colors.clear();
        }
        scan.faces
            .retain(|f| f.len() > 2 && f.iter().all(|&v| (v as usize) < count));
        Ok(scan)
    }

    /// Iterates over the faces, split into triangles about their first corner.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let fan = |f: &Vec<u32>| {
            let first = f[0];
            f[1..]
                .windows(2)
                .map(|w| [first, w[0], w[1]])
                .collect::<Vec<_>>()
        };
        self.faces.iter().flat_map(fan)
    }
}

/// Corners of a face, counted from 0.
fn face<'a>(words: impl Iterator<Item = &'a str>) -> Option<Vec<u32>> {
    let corner = |w: &str| w.split('/').next()?.parse::<u32>().ok()?.checked_sub(1);
    let corners: Vec<u32> = words.take(CORNERS + 1).map(corner).collect::<Option<_>>()?;
    (corners.len() <= CORNERS).then_some(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_is_read_and_nonsense_is_refused() {
        let scan = Scan::read(
            "# x\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 2\nf 1/1 2/2/2 3\nf 1 2 9\n",
        )
        .unwrap();
        assert_eq!(scan.points.len(), 3);
        assert_eq!(scan.colors[2], [0.0, 0.0, 1.0]);
        assert_eq!(scan.faces, [[0, 1, 2]]);
        assert_eq!(scan.triangles().count(), 1);
        assert_eq!(Scan::read("v 1 2"), Err(BadLine(1)));
        assert_eq!(Scan::read("v 1 2 nan"), Err(BadLine(1)));
        assert_eq!(Scan::read("\nf 0 1 2"), Err(BadLine(2)));
        assert_eq!(
            Scan::read(&format!("f {}", "1 ".repeat(65))),
            Err(BadLine(1))
        );
    }
}

//! Normals of polygonal surfaces.

use crate::DVec3;

/// Returns, for each position, twice the sum of the area vectors of the adjacent faces:
/// proportional to area, pointing outwards if faces are counter-clockwise seen from outside. Faces
/// reference the indices of their corners' positions.
#[must_use]
pub fn area_vectors<F: AsRef<[u32]>>(
    positions: &[DVec3],
    faces: impl IntoIterator<Item = F>,
) -> Vec<DVec3> {
    let mut vectors = vec![DVec3::ZERO; positions.len()];
    for face in faces {
        let face = face.as_ref();
        let at = |v: u32| positions[v as usize];
        // Newell's sum is twice the area vector of any polygon.
        let mut area = DVec3::ZERO;
        for side in face.windows(2).skip(1) {
            area += (at(side[0]) - at(face[0])).cross(at(side[1]) - at(face[0]));
        }
        for &v in face {
            vectors[v as usize] += area;
        }
    }
    vectors
}

/// Returns unit normals of positions, weighted by the area of the adjacent faces; +y for positions
/// without faces.
#[must_use]
pub fn vertex_normals<F: AsRef<[u32]>>(
    positions: &[DVec3],
    faces: impl IntoIterator<Item = F>,
) -> Vec<DVec3> {
    area_vectors(positions, faces)
        .into_iter()
        .map(|n| n.try_normalize().unwrap_or(DVec3::Y))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_faces_as_its_triangles_do() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        let whole = area_vectors(&square, [[0, 1, 2, 3]]);
        assert_eq!(whole, [DVec3::Z * 2.0; 4]);
        let halves = area_vectors(&square, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(halves, [2.0, 1.0, 2.0, 1.0].map(|area| DVec3::Z * area));
        let of_halves = vertex_normals(&square, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(of_halves, vertex_normals(&square, [[0, 1, 2, 3]]));
        assert_eq!(vertex_normals(&square, [[0; 3]]), [DVec3::Y; 4]);
    }
}

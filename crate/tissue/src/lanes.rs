//! Four-lane vectors that a processor computes simultaneously. Only lane-wise operations are used,
//! and sums over lanes are added in order, so the bits are the same on every machine.

/// SIMD displacement or position, metres; the fourth number is 0 unless specified otherwise.
pub(super) type Vector = wide::f32x4;

/// Number of SIMD lanes.
pub(super) const LANES: usize = 4;

#[inline]
pub(super) fn vector([x, y, z]: [f32; 3]) -> Vector {
    Vector::new([x, y, z, 0.0])
}

#[inline]
pub(super) fn xyz(v: Vector) -> [f32; 3] {
    let [x, y, z, _] = v.to_array();
    [x, y, z]
}

#[inline]
pub(super) fn dot(a: Vector, b: Vector) -> f32 {
    let [x, y, z, _] = (a * b).to_array();
    x + y + z
}

#[inline]
pub(super) fn length(v: Vector) -> f32 {
    dot(v, v).sqrt()
}

/// Squares of the lengths of four vectors.
#[inline]
pub(super) fn squares(vectors: [Vector; LANES]) -> Vector {
    let [x, y, z, _] = Vector::transpose(vectors);
    x * x + y * y + z * z
}

/// Rounds a count up to a multiple of four.
pub(super) fn whole_fours(count: usize) -> usize {
    count.next_multiple_of(LANES)
}

/// Returns the indices of four items from `from` on, of `count`; the last index replaces those out
/// of range.
#[inline]
pub(super) fn four(from: usize, count: usize) -> [usize; LANES] {
    core::array::from_fn(|k| (from + k).min(count - 1))
}

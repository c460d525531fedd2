//! Cord model of the mouth ring's fibres: where a muscle pulls, the adjacent segments follow in a
//! curve, and the middle of a lip between two levators rises with both sides.

/// Spread of a pull along the fibre, in points; at half this distance it has fallen to 60 %. About
/// 8 mm of a mouth of 50 mm. Designed: enough for two levators to raise a lip in one arch.
const SPREAD_POINTS: f32 = 4.5;

/// Spreads displacements along a fibre. `asked` holds the displacement of the points by their own
/// muscle and `moved` the current one; the ends stay. The result minimises changes from point to
/// point while it stays near the input: a tridiagonal system, solved by elimination.
pub(super) fn spread(asked: &[[f32; 3]], moved: &mut [[f32; 3]], work: &mut Vec<([f32; 3], f32)>) {
    let Some(last) = moved.len().checked_sub(1).filter(|last| *last > 1) else {
        return;
    };
    let off = |k: usize, moved: &[[f32; 3]]| [0, 1, 2].map(|c| moved[k][c] - asked[k][c]);
    if (1..last).all(|k| off(k, moved) == [0.0; 3]) && off(0, moved) == off(last, moved) {
        return;
    }
    let stiff = SPREAD_POINTS * SPREAD_POINTS;
    // The remainder of each row and its factor for the next.
    work.clear();
    work.push((off(0, moved), 0.0));
    for k in 1..last {
        let (before, factor) = work[k - 1];
        let own = off(k, moved);
        let pivot = 1.0 / (1.0 + 2.0 * stiff - stiff * factor);
        work.push((
            [0, 1, 2].map(|c| (own[c] + stiff * before[c]) * pivot),
            stiff * pivot,
        ));
    }
    let mut next = off(last, moved);
    for k in (1..last).rev() {
        let (own, factor) = work[k];
        next = [0, 1, 2].map(|c| own[c] + factor * next[c]);
        moved[k] = [0, 1, 2].map(|c| asked[k][c] + next[c]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread_of(asked: [f32; 25], moved: [f32; 25]) -> Vec<f32> {
        let along = |all: [f32; 25]| all.map(|y| [0.0, y, 0.0]);
        let mut out = along(moved);
        spread(&along(asked), &mut out, &mut Vec::new());
        out.iter().map(|p| p[1]).collect()
    }

    #[test]
    fn two_pulls_raise_what_is_between_them() {
        let mut moved = [0.0; 25];
        (moved[7], moved[17]) = (1.0, 1.0);
        let out = spread_of([0.0; 25], moved);
        let (peak, middle) = (out[7], out[12]);
        assert!(middle > 0.55 * peak, "{out:?}");
        assert!(
            (out[0], out[24]) == (0.0, 0.0),
            "the ends of the cord stay fixed"
        );
        for k in 0..12 {
            assert!(
                (out[k] - out[24 - k]).abs() < 1e-6,
                "the halves differ: {out:?}"
            );
        }
    }

    #[test]
    fn what_the_ring_does_itself_stays() {
        let asked: [f32; 25] = std::array::from_fn(|k| 0.01 * (k as f32 * 0.7).fract());
        assert_eq!(spread_of(asked, asked), asked);
        // Moved as a whole, it is moved as a whole.
        let lifted = asked.map(|y| y + 0.25);
        for (a, b) in spread_of(asked, lifted).iter().zip(lifted) {
            assert!(
                (a - b).abs() < 1e-6,
                "a common displacement moves the whole cord"
            );
        }
    }
}

//! Tests of the space of a basis.

use proptest::prelude::*;
use raconteur_base::noise;

use super::FaceSpace;
use super::tests::distance;
use crate::error::FaceError;
use crate::sample::examples;

/// Returns the scalar product of two vectors.
fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

proptest! {
    #[test]
    fn faces_of_a_basis_lie_in_its_space(count in 1..9_u64, vertices in 1..20_i64, seed: u64) {
        let mut basis = examples(count, 3 * vertices, seed);
        // A vector that depends on the others.
        basis.push(basis[0].iter().map(|x| 0.5 * x).collect());
        let mean = examples(1, 3 * vertices, !seed).remove(0);
        let space = FaceSpace::of_basis(mean.clone(), &basis).expect("corresponding");
        prop_assert!(space.dimensions() <= count.min(3 * vertices as u64) as usize);
        let mut face = mean;
        for (k, vector) in (0..).zip(&basis) {
            let c = 3.0 * noise::signed(seed, 99, k);
            for (value, x) in face.iter_mut().zip(vector) {
                *value += c * x;
            }
        }
        let again = space.face(&space.coefficients(&face).expect("corresponding"));
        prop_assert!(distance(&again, &face) < 1e-9);
        // Multiples of deviation 1 are independent: along a mode their variances add up.
        for (i, deviation) in space.deviations().iter().enumerate() {
            let along = basis.iter().map(|v| product(v, space.mode(i)));
            let variance: f64 = along.map(|x| x * x).sum();
            prop_assert!((variance.sqrt() - deviation).abs() < 1e-9);
            for j in 0..=i {
                let is_same = f64::from(u8::from(i == j));
                prop_assert!((product(space.mode(i), space.mode(j)) - is_same).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn the_examples_differences_are_a_basis_of_their_space() {
    let faces = examples(10, 60, 7);
    let learned = FaceSpace::learn(&faces).expect("corresponding");
    let scaled = |face: &Vec<f64>| {
        let pairs = face.iter().zip(learned.mean());
        pairs.map(|(x, m)| (x - m) / 10.0_f64.sqrt()).collect()
    };
    let basis: Vec<Vec<f64>> = faces.iter().map(scaled).collect();
    let same = FaceSpace::of_basis(learned.mean().to_vec(), &basis).expect("corresponding");
    assert_eq!(same.dimensions(), learned.dimensions());
    assert!(
        distance(same.deviations(), learned.deviations()) < 1e-12,
        "the basis has the deviations of its examples"
    );
}

#[test]
fn a_basis_of_others_is_refused_and_none_leaves_the_mean() {
    let mean = vec![1.0; 3];
    let alone = FaceSpace::of_basis(mean.clone(), &[]).expect("a mean");
    assert_eq!((alone.dimensions(), alone.face(&[2.0])), (0, mean.clone()));
    let flat = FaceSpace::of_basis(mean.clone(), &[vec![0.0; 3]]).expect("a mean");
    assert_eq!(flat.dimensions(), 0);
    let wrong = FaceError::Correspondence {
        example: 2,
        found: 2,
        expected: 3,
    };
    let basis = [vec![1.0; 3], vec![1.0; 2]];
    assert_eq!(FaceSpace::of_basis(mean.clone(), &basis), Err(wrong));
    assert_eq!(
        FaceSpace::of_basis(mean, &[vec![f64::INFINITY; 3]]),
        Err(FaceError::NotFinite { example: 1 })
    );
}

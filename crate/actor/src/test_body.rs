//! The example skeleton of GEVH table A.1, for tests.

use raconteur_base::DVec3;
use raconteur_body::skeleton::{FacePlaces, zero_frames};
use raconteur_body::{Bone, Skeleton};

/// The male example of the thesis, 1.956 m tall.
pub(crate) fn example() -> Skeleton {
    let positions = Bone::ALL.map(Bone::example_position_m);
    let eyes = [
        DVec3::new(0.031, 1.80, 0.08),
        DVec3::new(-0.031, 1.80, 0.08),
    ];
    Skeleton::from_bind(
        &positions,
        &zero_frames(),
        FacePlaces { eye_centres: eyes },
        1.956,
    )
}

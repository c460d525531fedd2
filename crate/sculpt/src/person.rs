//! Description of a person, the input of the generator.

use serde::{Deserialize, Serialize};

/// Sex, age, stature and build of a person, by which survey means are selected; without measures of
/// the face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Person {
    /// 0 male to 1 female.
    pub sex: f64,
    /// Years, 8 to 80.
    pub age_years: f64,
    /// Standing height without shoes, metres.
    pub stature_m: f64,
    /// −1 lean to +1 heavy.
    pub build: f64,
}

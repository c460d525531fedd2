//! Named figures: their persons and clothes.

mod amara;
pub mod hair_donors;
mod kenji;
mod lia;
mod nuno;
mod papous;
mod sofia;

use serde::{Deserialize, Serialize};

use super::cloth::Outfit;
use super::hair::HairParams;
use super::hand::{HandParams, HandProportions};
use super::head::{HeadParams, ModelHeadShape};
use super::model::Traits;
use super::person::Person;
use super::skin::SkinParams;
use super::torso::BodyParams;

/// Complete parameters of a figure, from which its mesh, skeleton and tissue are generated.
///
/// # Examples
///
/// ```
/// use raconteur_sculpt::people::preset;
///
/// let sofia = preset("sofia").expect("a figure of the library");
/// assert!(preset("no figure").is_none());
/// // `raconteur_sculpt::build` makes the meshes, which takes some seconds.
/// let _ = sofia.hands();
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FigureParams {
    /// Name, for example `sofia`.
    pub name: String,
    /// Sex, age, stature and build.
    pub person: Person,
    /// Size of the bust, 1 = average. Women only.
    pub bust: f64,
    /// Parameters of the head and the face.
    pub head: HeadParams,
    /// Skin of head and hands.
    pub skin: SkinParams,
    /// Size of the hands relative to the mean.
    pub hand: HandProportions,
    /// Hair style and beard.
    pub hair: HairParams,
    /// Outfit and its colours.
    pub wardrobe: Outfit,
}

impl FigureParams {
    /// Returns the measures of trunk and limbs.
    pub(super) fn body(&self) -> BodyParams {
        let p = self.person;
        BodyParams {
            sex: p.sex,
            age_years: p.age_years,
            stature_m: p.stature_m,
            build: p.build,
            bust: self.bust,
        }
    }

    /// Returns the measures of the hands.
    #[must_use]
    pub fn hands(&self) -> HandParams {
        HandParams::from_person(&self.person, &self.hand, self.skin.base_colour())
    }
}

/// The traits in a file of this folder.
#[allow(
    clippy::expect_used,
    reason = "the files are part of the program and tested"
)]
fn traits(text: &str) -> Traits {
    serde_json::from_str(text).expect("traits")
}

/// The head in a file of this folder.
#[allow(
    clippy::expect_used,
    reason = "the files are part of the program and tested"
)]
fn bound(text: &str) -> ModelHeadShape {
    ModelHeadShape::from_text(text).expect("a head")
}

/// Colour of brown eyes, linear RGB.
const BROWN: [f64; 3] = [0.15, 0.085, 0.042];

/// Names of the bundled figures, accepted by [`preset`].
pub const NAMES: [&str; 6] = ["sofia", "papous", "nuno", "amara", "kenji", "lia"];

/// Returns the parameters of a named figure; `None` for an unknown name. Known: [`NAMES`].
#[must_use]
pub fn preset(name: &str) -> Option<FigureParams> {
    match name {
        "sofia" => Some(sofia::params()),
        "papous" => Some(papous::params()),
        "nuno" => Some(nuno::params()),
        "amara" => Some(amara::params()),
        "kenji" => Some(kenji::params()),
        "lia" => Some(lia::params()),
        _ => None,
    }
}

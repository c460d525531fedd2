//! Figures whose hair the library provides as separate files, by the hair's name.

use super::{FigureParams, preset};
use crate::hair::{BeardCut, BeardParams, HairParams, HairStyle};

/// Names of the hair styles that other figures can wear on the scalp.
pub const HAIR: [&str; 20] = [
    "buzz", "crop", "side", "swept", "tousled", "receding", "thinning", "balding", "coily", "afro",
    "pixie", "page", "bob", "wavy", "curly", "long", "straight", "ponytail", "bun", "braid",
];

/// Names of the beards that other figures can wear.
pub const BEARDS: [&str; 7] = [
    "moustache",
    "handlebar",
    "goatee",
    "circle",
    "curtain",
    "boxed",
    "full",
];

/// Root density of a borrowed beard; it is high because no painted beard covers the skin beneath.
const DENSITY: f64 = 1.7;

/// Returns a bundled person whose hair is replaced by a style; `None` for an unknown person.
fn styled(like: &str, style: HairStyle) -> Option<FigureParams> {
    let mut person = preset(like)?;
    person.hair = HairParams {
        style,
        beard: None,
        recession: 0.0,
        thinning: 0.0,
        square: person.person.sex < 0.5,
        colour: HairParams::default().colour,
        length: HairParams::default().length,
        ..person.hair
    };
    Some(person)
}

fn with(person: Option<FigureParams>, change: impl Fn(&mut HairParams)) -> Option<FigureParams> {
    let mut person = person?;
    change(&mut person.hair);
    Some(person)
}

fn beard(cut: BeardCut, length_m: f64) -> Option<FigureParams> {
    let mut person = preset("papous")?;
    person.hair = HairParams {
        style: HairStyle::Bald,
        beard: Some(BeardParams {
            length_m,
            cut,
            density: DENSITY,
        }),
        ..HairParams::default()
    };
    Some(person)
}

/// Returns the parameters of a donor of hair or a beard by name; `None` for an unknown one. Known:
/// [`HAIR`] and [`BEARDS`].
#[must_use]
pub fn params(name: &str) -> Option<FigureParams> {
    use HairStyle::{
        Balding, Bob, Braid, Bun, Buzz, Coily, Crop, Curly, Long, Ponytail, Swept, Tousled, Wavy,
    };
    let person = match name {
        "buzz" => styled("kenji", Buzz),
        "crop" => styled("kenji", Crop),
        "side" => with(styled("kenji", Swept), |h| {
            h.length = 1.25;
            h.volume = 1.2;
        }),
        "swept" => styled("papous", Swept),
        "tousled" => styled("nuno", Tousled),
        "receding" => with(styled("papous", Swept), |h| {
            h.recession = 0.85;
            h.thinning = 0.2;
        }),
        "thinning" => with(styled("kenji", Crop), |h| {
            h.recession = 0.4;
            h.thinning = 0.62;
        }),
        "balding" => styled("papous", Balding),
        "coily" => with(styled("kenji", Coily), |h| h.length = 0.7),
        "afro" => with(styled("amara", Coily), |h| {
            h.length = 1.4;
            h.volume = 1.4;
        }),
        "pixie" => with(styled("sofia", Crop), |h| {
            h.length = 1.35;
            h.volume = 1.2;
        }),
        "page" => with(styled("lia", Bob), |h| h.length = 0.72),
        "bob" => styled("sofia", Bob),
        "wavy" => styled("sofia", Wavy),
        "curly" => styled("sofia", Curly),
        "long" => styled("lia", Long),
        "straight" => with(styled("sofia", Long), |h| {
            h.length = 1.15;
            h.parting_x = 0.001;
        }),
        "ponytail" => styled("sofia", Ponytail),
        "bun" => styled("amara", Bun),
        "braid" => styled("lia", Braid),
        "moustache" => beard(BeardCut::Moustache, 0.012),
        "handlebar" => beard(BeardCut::Handlebar, 0.012),
        "goatee" => beard(BeardCut::Goatee, 0.022),
        "circle" => beard(BeardCut::Circle, 0.013),
        "curtain" => beard(BeardCut::Curtain, 0.020),
        "boxed" => beard(BeardCut::Full, 0.010),
        "full" => beard(BeardCut::Full, 0.030),
        _ => None,
    };
    person.map(|person| FigureParams {
        name: name.to_owned(),
        ..person
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_hair_or_a_beard() {
        for name in HAIR {
            let hair = params(name).expect(name).hair;
            assert!(
                hair.beard.is_none() && hair.style != HairStyle::Bald,
                "{name}"
            );
        }
        for name in BEARDS {
            let hair = params(name).expect(name).hair;
            assert!(
                hair.beard.is_some() && hair.style == HairStyle::Bald,
                "{name}"
            );
        }
        assert!(
            params("wig").is_none(),
            "an unknown hair name has no parameters"
        );
    }
}

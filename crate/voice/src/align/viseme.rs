//! Mouth shapes of other programs, and their phones.

/// Set of mouth shapes (visemes) that lip-sync programs write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VisemeSet {
    /// Shapes A to H of Rhubarb Lip Sync; its X is silence.
    Rhubarb,
    /// The fifteen of OpenXR's `XR_META_face_tracking_visemes`, without `viseme_`.
    Oculus,
}

/// The fifteen shapes.
pub(super) const OCULUS: [&str; 15] = [
    "sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou",
];

/// Returns the OpenXR mouth shape that a name denotes: with or without `viseme_`, in any case, or
/// in the alternative spellings of Oculus' documents and Ready Player Me avatars.
pub(super) fn oculus(name: &str) -> Option<&'static str> {
    let bare = name.trim();
    let bare = match bare.get(..7) {
        Some(prefix) if prefix.eq_ignore_ascii_case("viseme_") => &bare[7..],
        _ => bare,
    };
    let meant = match bare {
        "I" | "i" => "ih",
        "O" | "o" => "oh",
        "U" | "u" => "ou",
        other => other,
    };
    OCULUS.into_iter().find(|s| s.eq_ignore_ascii_case(meant))
}

/// Returns the OpenXR mouth shape nearest to a shape of Rhubarb Lip Sync (A to H, X).
///
/// The mapping follows the descriptions in Rhubarb's README, "Mouth shapes": A closed lips (P, B,
/// M), B teeth together (most consonants and EE), C open (EH, AE), D wide open (AA), E slightly
/// rounded (AO, ER), F puckered (UW, OW, W), G teeth on lip (F, V), H tongue raised (long L), X
/// idle. Several visemes fit B; `DD`, an open slit with the teeth close together, is chosen.
#[must_use]
pub fn rhubarb_viseme(shape: &str) -> Option<&'static str> {
    Some(match shape {
        "A" => "PP",
        "B" => "DD",
        "C" => "E",
        "D" => "aa",
        "E" => "oh",
        "F" => "ou",
        "G" => "FF",
        "H" => "nn",
        "X" => "sil",
        _ => return None,
    })
}

/// Returns a phone of the set `radio` with the shape, so that [`raconteur_speech::phones::find`]
/// can drive the mouth by visemes. Silence is `""`, `sil` or `X`. `None` for a shape that the set
/// does not have.
#[must_use]
pub fn phone_of_viseme(set: VisemeSet, shape: &str) -> Option<&'static str> {
    if shape.is_empty() {
        return Some("pau");
    }
    let oculus = match set {
        VisemeSet::Rhubarb => rhubarb_viseme(shape)?,
        VisemeSet::Oculus => shape,
    };
    Some(match oculus {
        "sil" => "pau",
        "PP" => "m",
        "FF" => "f",
        "TH" => "th",
        "DD" => "d",
        "kk" => "k",
        "CH" => "ch",
        "SS" => "s",
        "nn" => "n",
        "RR" => "r",
        "aa" => "aa",
        "E" => "eh",
        "ih" => "ih",
        "oh" => "ao",
        "ou" => "uw",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_speech::phones;

    #[test]
    fn every_viseme_has_a_phone_of_its_own_shape() {
        for shape in OCULUS {
            let phone = phone_of_viseme(VisemeSet::Oculus, shape).unwrap();
            assert_eq!(phones::find("radio", phone).unwrap().viseme, shape);
        }
        for shape in ["A", "B", "C", "D", "E", "F", "G", "H", "X"] {
            let viseme = rhubarb_viseme(shape).unwrap();
            assert!(
                OCULUS.contains(&viseme),
                "the viseme is one of the Oculus set"
            );
            let phone = phone_of_viseme(VisemeSet::Rhubarb, shape).unwrap();
            assert_eq!(phones::find("radio", phone).unwrap().viseme, viseme);
        }
        assert_eq!(phone_of_viseme(VisemeSet::Oculus, "A"), None);
        assert_eq!(rhubarb_viseme("I"), None);
    }

    #[test]
    fn shapes_are_known_by_the_names_of_avatars() {
        for (name, shape) in [
            ("I", Some("ih")),
            ("viseme_O", Some("oh")),
            ("Viseme_U", Some("ou")),
            ("viseme_PP", Some("PP")),
            ("pp", Some("PP")),
            ("viseme_sil", Some("sil")),
            ("e", Some("E")),
            ("viseme_", None),
            ("mouthOpen", None),
            ("vis\u{e9}me_U", None),
        ] {
            assert_eq!(oculus(name), shape, "{name}");
        }
    }
}

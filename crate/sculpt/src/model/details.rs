//! Differences between people's heads: the model's details in pairs of opposites.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::{Model, ModelError, text};

/// Groups of the model that shape the head.
const GROUPS: [&str; 9] = [
    "cheek", "chin", "ears", "eyebrows", "eyes", "forehead", "head", "mouth", "nose",
];
/// Details of those groups that move a part to one side, the head on its neck, or make ears of
/// fable: no usual face has them.
const UNUSUAL: [&str; 7] = [
    "mouth-trans-in-out",
    "nose-trans-in-out",
    "head-trans-in-out",
    "head-trans-down-up",
    "head-trans-backward-forward",
    "head-age-decr-incr",
    "ear-shape-pointed-triangle",
];

/// Morphological detail of the head in the body model, with equal amounts on both sides in a usual
/// head.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Names in [`super::Traits::details`]: one for the whole head, or those of left and right.
    pub names: Vec<String>,
}

#[derive(Deserialize)]
struct Group {
    categories: Vec<Category>,
}

#[derive(Deserialize)]
struct Category {
    name: String,
    has_left_and_right: bool,
    #[serde(default)]
    opposites: Option<BTreeMap<String, String>>,
}

impl Category {
    fn is_pair(&self) -> bool {
        self.opposites.is_some() && !UNUSUAL.contains(&self.name.as_str())
    }

    fn names(&self, group: &str) -> Vec<String> {
        if self.has_left_and_right {
            ["l", "r"]
                .map(|side| format!("{group}/{side}-{}", self.name))
                .into()
        } else {
            vec![format!("{group}/{}", self.name)]
        }
    }
}

impl Model {
    /// Returns the details that shape a usual head, in the order of the names of their groups.
    ///
    /// # Errors
    /// Returns an error if the model's list of targets is missing or damaged.
    pub fn details(&self) -> Result<Vec<Detail>, ModelError> {
        let path = self.folder.join("targets/target.json");
        of_heads(&text(&path)?).map_err(|e| ModelError::Format {
            path,
            line: e.line(),
            fault: "expected groups of targets with categories",
        })
    }
}

/// Parses the details of heads from the model's list of targets.
fn of_heads(list: &str) -> serde_json::Result<Vec<Detail>> {
    let groups: BTreeMap<String, Group> = serde_json::from_str(list)?;
    let own = groups
        .iter()
        .filter(|(name, _)| GROUPS.contains(&name.as_str()));
    Ok(own
        .flat_map(|(group, all)| {
            let pairs = all.categories.iter().filter(|c| c.is_pair());
            pairs.map(|c| Detail {
                names: c.names(group),
            })
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_of_heads_are_read_and_others_left_out() {
        let list = r#"{
            "nose": { "categories": [
                { "name": "nose-hump-decr-incr", "has_left_and_right": false, "opposites": {} },
                { "name": "nose-trans-in-out", "has_left_and_right": false, "opposites": {} },
                { "name": "nose-alone", "has_left_and_right": false }
            ] },
            "eyes": { "categories": [
                { "name": "eye-bag-in-out", "has_left_and_right": true, "opposites": {} }
            ] },
            "legs": { "categories": [
                { "name": "calf-in-out", "has_left_and_right": true, "opposites": {} }
            ] }
        }"#;
        let details = of_heads(list).unwrap();
        let names: Vec<_> = details.iter().map(|d| d.names.join(" ")).collect();
        assert_eq!(
            names,
            [
                "eyes/l-eye-bag-in-out eyes/r-eye-bag-in-out",
                "nose/nose-hump-decr-incr"
            ]
        );
        assert!(
            of_heads("{\"nose\": 1}").is_err(),
            "an invalid list of details is rejected"
        );
    }
}

//! Places of the targets of pointing, gaze and locomotion. BML takes them from a world that it does
//! not describe.

use std::collections::BTreeMap;

/// Places of directions and of the listener, speaker coordinates in skeleton units: *designed*. A
/// direction is far enough for both eyes, and the listener's eyes are at the height of the speaker's.
const KNOWN: [(&str, [f64; 3]); 15] = [
    ("LISTENER", [0.0, 35.0, -80.0]),
    ("USER", [0.0, 35.0, -80.0]),
    ("AUDIENCE", [0.0, 35.0, -80.0]),
    ("CAMERA", [0.0, 35.0, -80.0]),
    ("FRONT", [0.0, 30.0, -80.0]),
    ("LEFT", [70.0, 30.0, -40.0]),
    ("RIGHT", [-70.0, 30.0, -40.0]),
    ("UP", [0.0, 90.0, -60.0]),
    ("DOWN", [0.0, -30.0, -50.0]),
    ("UPLEFT", [60.0, 80.0, -50.0]),
    ("UPRIGHT", [-60.0, 80.0, -50.0]),
    ("DOWNLEFT", [50.0, -20.0, -45.0]),
    ("DOWNRIGHT", [-50.0, -20.0, -45.0]),
    ("BACK", [-40.0, 30.0, 40.0]),
    ("SELF", [0.0, 16.0, -6.0]),
];

/// Places of unknown targets in the order of their first use: *designed*, spread over the stage.
const CHOSEN: [[f64; 3]; 6] = [
    [-50.0, 22.0, -45.0],
    [50.0, 22.0, -45.0],
    [-25.0, 18.0, -60.0],
    [25.0, 18.0, -60.0],
    [-65.0, 25.0, -25.0],
    [65.0, 25.0, -25.0],
];

/// Places of the targets of a file.
#[derive(Default)]
pub(super) struct Places<'x> {
    chosen: BTreeMap<&'x str, [f64; 3]>,
}

/// Place of a target.
pub(super) struct FoundPlace {
    pub(super) position: [f64; 3],
    /// True if the place was chosen now.
    pub(super) is_new: bool,
}

/// Returns the names of the known places.
pub(super) fn names() -> String {
    let names: Vec<&str> = KNOWN.iter().map(|(name, _)| *name).collect();
    names.join(", ")
}

impl<'x> Places<'x> {
    /// Returns the place of a target.
    pub(super) fn find(&mut self, name: &'x str) -> FoundPlace {
        let bare: String = name
            .chars()
            .take(16)
            .filter(char::is_ascii_alphabetic)
            .collect();
        let mut known = KNOWN.iter();
        let known = known.find(|(known, _)| known.eq_ignore_ascii_case(&bare));
        if let Some((_, position)) = known {
            return FoundPlace {
                position: *position,
                is_new: false,
            };
        }
        let next = CHOSEN[self.chosen.len() % CHOSEN.len()];
        let count = self.chosen.len();
        let position = *self.chosen.entry(name).or_insert(next);
        FoundPlace {
            position,
            is_new: self.chosen.len() > count,
        }
    }
}

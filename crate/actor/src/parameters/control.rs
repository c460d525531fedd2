//! Single parameters of a face: its muscles, and the direct parameters without a muscle.

use raconteur_body::face::{FaceControls, Jaw, MUSCLES, Muscle};

/// Maximum turn of the eyes by a script, radians: beyond it the head must follow. Designed.
const GAZE_RAD: f64 = 0.5;

/// A direct parameter: its name, and true if it is signed (−1 to 1) instead of unsigned (0 to 1).
const DIRECT: [(&str, bool); 18] = [
    ("Jaw", false),
    ("JawYaw", true),
    ("JawForward", true),
    ("JawDown", false),
    ("UpperLidLeft", true),
    ("UpperLidRight", true),
    ("LowerLidLeft", false),
    ("LowerLidRight", false),
    ("LipProtrusionUpper", true),
    ("LipProtrusionLower", true),
    ("LipSeal", false),
    ("LipBite", false),
    ("TongueTip", false),
    ("TongueBack", false),
    ("TongueOut", false),
    ("Blush", true),
    ("GazeX", true),
    ("GazeY", true),
];

/// Number of face controls: all muscles and the direct parameters.
pub const FACE_CONTROLS: usize = MUSCLES + DIRECT.len();

/// Face control that can be set individually: a muscle, or a direct parameter of a part that no
/// muscle moves. Holds its index; muscles come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FaceControl(u8);

impl FaceControl {
    /// Opening of the jaw, 0 to 1.
    pub const JAW: Self = Self::direct(0);
    /// The upper lid: closed (positive) or wide open (negative).
    pub const UPPER_LID_LEFT: Self = Self::direct(4);
    /// Raising of the left lower lid.
    pub const LOWER_LID_LEFT: Self = Self::direct(6);
    /// Protrusion (positive) or retraction of the jaw.
    pub const JAW_FORWARD: Self = Self::direct(2);
    /// The upper lip pushed forwards (positive) or drawn back and rolled in.
    pub const LIP_PROTRUSION_UPPER: Self = Self::direct(8);
    /// Protrusion of the lower lip (positive), or drawing back and rolling in.
    pub const LIP_PROTRUSION_LOWER: Self = Self::direct(9);

    const fn direct(place: usize) -> Self {
        Self((MUSCLES + place) as u8)
    }

    /// Returns the face control of a muscle.
    #[must_use]
    pub const fn from_muscle(muscle: Muscle) -> Self {
        Self(muscle.index() as u8)
    }

    /// Returns the control of an index; `None` beyond the last.
    #[must_use]
    pub fn from_index(index: usize) -> Option<Self> {
        (index < FACE_CONTROLS).then_some(Self(index as u8))
    }

    /// Returns the index of the control: muscles first, then direct parameters.
    #[must_use]
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// Returns the name of the control in stories, for example `Jaw`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.index().checked_sub(MUSCLES) {
            Some(place) => DIRECT[place].0,
            None => Muscle::all().nth(self.index()).map_or("", Muscle::name),
        }
    }

    /// Returns true if its range is −1 to 1 instead of 0 to 1.
    #[must_use]
    pub fn is_signed(self) -> bool {
        let place = self.index().checked_sub(MUSCLES);
        place.is_some_and(|place| DIRECT[place].1)
    }

    /// Returns the same control on the right side of the face; itself if it is on the midline or on
    /// the right.
    #[must_use]
    pub fn with_right_half(self) -> Self {
        // The right one of two always follows the left one.
        if self.name().ends_with("Left") {
            Self(self.0 + 1)
        } else {
            self
        }
    }

    /// Adds a value to the controls of a face. The gaze is no part of that: see
    /// [`gaze_rad`](Self::gaze_rad).
    pub fn add(self, value: f64, controls: &mut FaceControls) {
        let Some(place) = self.index().checked_sub(MUSCLES) else {
            controls.contraction[self.index()] += value;
            return;
        };
        let jaw = &mut controls.jaw;
        let to_end = |[least, most]: [f64; 2]| {
            if value < 0.0 {
                -value * least
            } else {
                value * most
            }
        };
        match place {
            0 => jaw.pitch_rad += to_end(Jaw::RANGES[0]),
            1 => jaw.yaw_rad += to_end(Jaw::RANGES[1]),
            2 => jaw.forward_m += to_end(Jaw::RANGES[2]),
            3 => jaw.down_m += to_end(Jaw::RANGES[3]),
            4 | 5 => controls.upper_lid[place - 4] += value,
            6 | 7 => controls.lower_lid[place - 6] += value,
            8 | 9 => controls.protrusion[place - 8] += value,
            10 => controls.seal += value,
            11 => controls.bite += value,
            12 => controls.tongue_tip += value,
            13 => controls.tongue_back += value,
            14 => controls.tongue_out += value,
            15 => controls.blush += value,
            _ => {}
        }
    }

    /// Returns the turn of the eyes for a value: yaw to the figure's left and pitch down, radians;
    /// positive values of `GazeX` look to the left, those of `GazeY` up.
    #[must_use]
    pub fn gaze_rad(self, value: f64) -> [f64; 2] {
        match self.index().checked_sub(MUSCLES) {
            Some(16) => [GAZE_RAD * value, 0.0],
            Some(17) => [0.0, -GAZE_RAD * value],
            _ => [0.0; 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_dial_moves_what_its_name_says_and_nothing_else() {
        let rest = FaceControls::default();
        let mut seen: Vec<String> = Vec::new();
        for i in 0..FACE_CONTROLS {
            let dial = FaceControl::from_index(i).expect("a dial");
            assert_eq!(dial.index(), i);
            assert!(!dial.name().is_empty(), "the dial has a name");
            let mut asked = rest;
            dial.add(0.5, &mut asked);
            assert_eq!(
                asked == rest,
                dial.name().starts_with("Gaze"),
                "{}",
                dial.name()
            );
            seen.push(format!("{asked:?} {:?}", dial.gaze_rad(0.5)));
            if dial.name().ends_with("Left") {
                let right = dial.with_right_half().name().replace("Right", "Left");
                assert_eq!(right, dial.name());
            } else {
                assert_eq!(dial.with_right_half(), dial);
            }
        }
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), FACE_CONTROLS, "no two move the same");
        assert_eq!(FaceControl::from_index(FACE_CONTROLS), None);
        assert_eq!(FaceControl::JAW.name(), "Jaw");
        assert_eq!(FaceControl::UPPER_LID_LEFT.name(), "UpperLidLeft");
        assert_eq!(FaceControl::LOWER_LID_LEFT.name(), "LowerLidLeft");
        assert_eq!(FaceControl::JAW_FORWARD.name(), "JawForward");
        assert_eq!(
            FaceControl::from_muscle(Muscle::PlatysmaRight).name(),
            "PlatysmaRight"
        );
    }

    #[test]
    fn full_values_reach_the_ends_of_the_ranges() {
        let mut asked = FaceControls::default();
        for i in 0..FACE_CONTROLS {
            FaceControl::from_index(i)
                .expect("a dial")
                .add(1.0, &mut asked);
        }
        assert_eq!(asked.jaw.pitch_rad, 0.35);
        assert_eq!(asked.jaw.forward_m, 0.008);
        assert_eq!((asked.upper_lid, asked.blush), ([1.0; 2], 1.0));
        assert!(
            asked.contraction.iter().all(|v| *v == 1.0),
            "full values contract every muscle fully"
        );
        let mut limited = asked;
        limited.limit();
        assert_eq!(limited, asked);
    }
}

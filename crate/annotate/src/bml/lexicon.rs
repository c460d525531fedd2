//! Gestures by their lexemes.
//!
//! BML names `BEAT` only and leaves the others to the realizer; all forms are *designed*, with hand
//! shapes, palms and positions like those of the shipped stories. Values are those of the right
//! hand: positions of the wrist in skeleton units from the speaker's pelvis, x to the left, y up, z
//! to the back; palms as normal and angle (GEVH D.5.4).

use raconteur_eml::Handedness;

/// Form of a gesture.
pub(super) struct Form {
    /// Lexeme in BML.
    pub(super) lexeme: &'static str,
    /// Hands unless the behaviour names them.
    pub(super) hands: Handedness,
    /// Hand shape.
    pub(super) shape: u8,
    /// Angle of the palm, degrees, and its normal.
    pub(super) palm: (f64, [f64; 3]),
    /// Positions during the stroke, evenly spaced in time.
    pub(super) path: &'static [[f64; 3]],
    /// Usual length of the stroke, seconds.
    pub(super) stroke_secs: f64,
}

const fn form(
    lexeme: &'static str,
    hands: Handedness,
    shape: u8,
    palm: (f64, [f64; 3]),
    path: &'static [[f64; 3]],
) -> Form {
    let stroke_secs = 0.25 + 0.15 * path.len() as f64;
    Form {
        lexeme,
        hands,
        shape,
        palm,
        path,
        stroke_secs,
    }
}

use Handedness::{Both, Right};

/// Palm to the listener with the fingers up.
const FRONT: (f64, [f64; 3]) = (180.0, [0.0, 0.0, -1.0]);
/// Palm to the other side with the fingers to the front.
const INWARD: (f64, [f64; 3]) = (90.0, [1.0, 0.0, 0.0]);
/// Palm down with the fingers to the front.
const DOWN: (f64, [f64; 3]) = (90.0, [0.0, -1.0, 0.0]);
/// Palm up and to the other side with the fingers to the front.
const OPEN: (f64, [f64; 3]) = (90.0, [0.6, 0.8, 0.0]);
/// Palm to the speaker with the fingers to the other side.
const SELF: (f64, [f64; 3]) = (90.0, [0.0, 0.0, 1.0]);

/// All gestures.
pub(super) static FORMS: [Form; 29] = [
    form(
        "BEAT",
        Right,
        0,
        (90.0, [0.8, -0.6, 0.0]),
        &[[-8.0, 14.0, -13.0], [-8.5, 9.5, -14.5]],
    ),
    form(
        "BIG",
        Both,
        10,
        INWARD,
        &[[-5.0, 13.0, -13.0], [-15.0, 16.0, -11.0]],
    ),
    form("BYE", Right, 4, FRONT, WAVE),
    form(
        "CALM",
        Both,
        1,
        DOWN,
        &[[-8.0, 15.0, -14.0], [-8.0, 10.0, -14.0]],
    ),
    form(
        "COME",
        Right,
        57,
        SELF,
        &[[-9.0, 14.0, -17.0], [-6.0, 16.0, -9.0]],
    ),
    form(
        "CONTRAST",
        Both,
        57,
        (90.0, [0.0, 1.0, 0.0]),
        &[[-9.0, 11.0, -14.0], [-13.0, 9.0, -13.0]],
    ),
    form(
        "FRAME",
        Both,
        25,
        FRONT,
        &[[-5.0, 20.0, -13.0], [-11.0, 20.0, -12.0]],
    ),
    form("HELLO", Right, 4, FRONT, WAVE),
    form(
        "ME",
        Right,
        1,
        SELF,
        &[[-8.0, 15.0, -10.0], [-6.5, 17.0, -6.5]],
    ),
    form(
        "NO",
        Right,
        1,
        DOWN,
        &[[-2.0, 16.0, -14.0], [-13.0, 16.0, -13.0]],
    ),
    form(
        "OFFER",
        Both,
        57,
        OPEN,
        &[[-5.0, 11.0, -10.0], [-8.0, 12.0, -15.0]],
    ),
    form(
        "OK",
        Right,
        27,
        FRONT,
        &[[-8.0, 17.0, -11.0], [-8.0, 20.0, -14.0]],
    ),
    form("ONE", Right, 19, FRONT, COUNT),
    form(
        "POINT",
        Right,
        19,
        DOWN,
        &[[-7.0, 15.0, -11.0], [-6.0, 18.0, -18.0]],
    ),
    form(
        "POINT_DOWN",
        Right,
        19,
        (0.0, [0.0, 0.0, 1.0]),
        &[[-7.0, 15.0, -13.0], [-7.0, 10.0, -15.0]],
    ),
    form(
        "POINT_LEFT",
        Right,
        19,
        (180.0, [0.0, -1.0, 0.0]),
        &[[-5.0, 16.0, -12.0], [3.0, 18.0, -15.0]],
    ),
    form(
        "POINT_RIGHT",
        Right,
        19,
        (30.0, [0.0, -1.0, 0.0]),
        &[[-8.0, 16.0, -12.0], [-17.0, 18.0, -11.0]],
    ),
    form(
        "POINT_UP",
        Right,
        19,
        FRONT,
        &[[-8.0, 18.0, -11.0], [-9.0, 27.0, -12.0]],
    ),
    form(
        "QUESTION",
        Both,
        4,
        OPEN,
        &[[-8.0, 11.0, -12.0], [-12.0, 13.0, -12.0]],
    ),
    form(
        "SMALL",
        Both,
        9,
        INWARD,
        &[[-9.0, 12.0, -12.0], [-4.3, 11.0, -13.0]],
    ),
    form(
        "STOP",
        Right,
        1,
        FRONT,
        &[[-6.0, 18.0, -9.0], [-6.0, 20.0, -15.0]],
    ),
    form(
        "TALL",
        Right,
        1,
        DOWN,
        &[[-9.0, 14.0, -13.0], [-10.0, 30.0, -11.0]],
    ),
    form("THREE", Right, 43, FRONT, COUNT),
    form(
        "THUMBS_UP",
        Right,
        16,
        INWARD,
        &[[-7.0, 13.0, -11.0], [-7.0, 16.0, -16.0]],
    ),
    form("TWO", Right, 38, FRONT, COUNT),
    form("US", Right, 1, SELF, AROUND),
    form("WAVE", Right, 4, FRONT, WAVE),
    form("WE", Right, 1, SELF, AROUND),
    form(
        "YOU",
        Right,
        1,
        OPEN,
        &[[-6.0, 14.0, -10.0], [-6.0, 17.0, -17.0]],
    ),
];

/// Swings of a raised hand.
const WAVE: &[[f64; 3]] = &[
    [-10.0, 25.0, -10.0],
    [-15.0, 25.0, -9.0],
    [-10.0, 25.0, -10.0],
    [-15.0, 25.0, -9.0],
];
/// A hand that shows its fingers.
const COUNT: &[[f64; 3]] = &[[-8.0, 17.0, -11.0], [-8.0, 20.0, -13.0]];
/// From the speaker to the listeners and back.
const AROUND: &[[f64; 3]] = &[[-9.0, 15.0, -12.0], [-3.0, 15.0, -16.0], [-6.0, 16.5, -7.0]];

/// Returns the form of a lexeme.
pub(super) fn find(lexeme: &str) -> Option<&'static Form> {
    FORMS
        .iter()
        .find(|form| form.lexeme.eq_ignore_ascii_case(lexeme))
}

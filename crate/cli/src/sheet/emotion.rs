//! Tiles of a face with an emotion or a blink.

use raconteur_actor::Affect;
use raconteur_actor::articulation::hold_closures;
use raconteur_actor::emotion::{EmotionSigns, ExpressionWeights};
use raconteur_actor::nonverbal::{CLOSED_SECS, CLOSING_SECS, OPENING_SECS};
use raconteur_base::curve::smooth;
use raconteur_base::{DQuat, DVec3};
use raconteur_body::Bone;
use raconteur_speech::emotion::WORDS;
use raconteur_tissue::FaceControls;

use super::posture::Posture;
use super::tile::{Maker, Tile, middle_of_head};
use super::view::before;

/// Frame rate of the blink tiles, frames per second.
const FRAMES_PER_S: f64 = 60.0;

/// Potential at which an emotion has its nominal strength.
const PLAIN_POTENTIAL: f64 = 5.0;

/// Emotion of a portrait and its strength: friendly, lips closed.
const FRIENDLY: (&str, f64) = ("joy", 2.0);

impl<'a> Maker<'a> {
    /// Returns the posture with the named emotion.
    fn with_emotion(&self, word: &str, potential: f64) -> Posture<'a> {
        let affect = Affect::named(word).unwrap_or_default();
        let share = potential / PLAIN_POTENTIAL;
        let mut controls = FaceControls::default();
        let mut mixture = ExpressionWeights::from_affect(affect);
        mixture.scale(share);
        mixture.expression().add(&mut controls);
        let signs = EmotionSigns::from_affect(affect).scaled(share);
        controls.blush = signs.blush;
        hold_closures(&mut controls);
        let mut posture = self.standing();
        posture.facing(0.3);
        let [turned, down, tilted] = signs.head();
        let moved = DQuat::from_rotation_y(turned)
            * DQuat::from_rotation_x(down)
            * DQuat::from_rotation_z(-tilted);
        posture.turn(Bone::Skull, moved);
        posture.face(controls);
        posture
    }

    /// Returns a tile for every emotion word at a plain intensity, and for fear at four
    /// intensities.
    pub(super) fn emotions(&self) -> Vec<Tile> {
        let one = |word: &str, potential: f64| {
            self.head(
                &format!("{word} {potential:.0}"),
                self.with_emotion(word, potential),
            )
        };
        let words = WORDS.map(|(word, _)| one(word, PLAIN_POTENTIAL));
        let strengths = [2.0, 5.0, 7.0, 10.0].map(|potential| one("fear", potential));
        words.into_iter().chain(strengths).collect()
    }

    /// Returns a tile with a friendly portrait of head and shoulders.
    pub(super) fn portrait(&self) -> Tile {
        let (word, potential) = FRIENDLY;
        self.tile("portrait", 1.0, self.with_emotion(word, potential), |at| {
            let d = at.pupils_m();
            before(middle_of_head(at) - 0.3 * d * DVec3::Y, 2.6 * d, 0.0, 0.0)
        })
    }

    /// Returns tiles of the eyes during a blink with three phases, at 60 frames per second.
    pub(super) fn blink(&self) -> Vec<Tile> {
        let closed = CLOSING_SECS + CLOSED_SECS;
        let open = closed + OPENING_SECS;
        let frames = (open * FRAMES_PER_S).ceil() as u32;
        (0..=frames)
            .map(|i| {
                let time = f64::from(i) / FRAMES_PER_S;
                let phase = if time < CLOSING_SECS {
                    "closing"
                } else if time < closed {
                    "closed"
                } else {
                    "opening"
                };
                let mut controls = FaceControls::default();
                let shut = smooth(time / CLOSING_SECS);
                controls.close_lids(shut - smooth((time - closed) / OPENING_SECS));
                let mut posture = self.standing();
                posture.face(controls);
                let caption = format!("{:.0} ms {phase}", 1e3 * time);
                self.tile(&caption, 2.0, posture, |at| {
                    before(at.between_eyes(), 0.5 * at.pupils_m(), 0.0, 0.0)
                })
            })
            .collect()
    }
}

//! Posture of the whole body during speech: trunk and shoulders follow the strokes of the hands,
//! weight and feet follow the sentences, and the body turns to the sides of characters.
//!
//! Everything is planned once from strokes, speech and discourse structure as superposed movements
//! and is then a function of time. Sources: EMOTE (Chi, Costa, Zhao and Badler 2000,
//! doi:10.1145/344779.352172) for the part of the torso in gestures; Cassell, Nakano, Bickmore,
//! Sidner and Rich 2001 (ACL P01-1016) for posture shifts at discourse boundaries.

mod engagement;
mod footwork;
mod heading;
mod sentences;

use raconteur_speech::emotion::EmotionPoint;

use crate::body_posture::BodyPosture;
use crate::discourse::Discourse;
use crate::facial_behaviour::FacialBehaviour;
use crate::gesture::ArmPlan;
use crate::superposition::SuperposedTrack;

pub(crate) use engagement::Engagement;
pub(crate) use footwork::FootPose;
pub(crate) use heading::Heading;
pub(crate) use sentences::{SentenceSpan, sentence_spans};

/// Influence of activation on the size of body movements. Designed; angry and happy speakers move
/// more and faster than neutral ones (Busso et al. 2007, doi:10.1109/TASL.2006.889803).
const SIZE_BY_ACTIVATION: f64 = 0.3;
/// Share of the movements that sorrow removes. Designed.
const SORROW_STILLS: f64 = 0.75;

/// Planned posture of a performance.
#[derive(Clone, Debug, Default)]
pub(crate) struct Posture {
    engagement: Engagement,
    /// Posture shifts at sentences: lean, roll, yaw of the trunk.
    shifts: SuperposedTrack<3>,
}

/// Size of body movements over time, from tension and emotion.
pub(crate) struct Vigour<'a> {
    pub(crate) discourse: &'a Discourse,
    pub(crate) feeling: &'a FacialBehaviour,
    pub(crate) amount: f64,
}

impl Vigour<'_> {
    /// Returns the factor on body movements at a time; 1 in ordinary lively telling.
    pub(crate) fn size_at(&self, time_secs: f64) -> f64 {
        let tense = self.discourse.size_at(time_secs);
        let felt = self.feeling.affect(time_secs);
        let lively = 1.0 + SIZE_BY_ACTIVATION * felt.activation / 100.0;
        self.amount * tense * lively * (1.0 - SORROW_STILLS * self.sorrow(time_secs))
    }

    /// Returns the degree of sorrow at a time, 0 to 1.
    pub(crate) fn sorrow(&self, time_secs: f64) -> f64 {
        sorrow(&self.feeling.affect(time_secs))
    }
}

/// Returns the degree of sorrow of an emotion, 0 to 1: passive and negative.
fn sorrow(felt: &EmotionPoint) -> f64 {
    let [passive, negative] =
        [-felt.activation, -felt.evaluation].map(|x| (x / 40.0).clamp(0.0, 1.0));
    passive * negative
}

impl Posture {
    /// Plans the posture for the gestures of both arms and the sentences of the speech.
    pub(crate) fn new(
        plans: &[ArmPlan; 2],
        sentences: &[SentenceSpan],
        vigour: &Vigour<'_>,
        seed: u64,
    ) -> Self {
        Self {
            engagement: Engagement::new(plans, vigour, seed),
            shifts: engagement::shifts(sentences, vigour, seed),
        }
    }

    /// Returns the posture at a time. `turn_rad` is the turn to a side that the heading asks of
    /// the trunk, `felt` the emotion.
    pub(crate) fn sample(
        &self,
        time_secs: f64,
        turn_rad: f64,
        felt: &EmotionPoint,
        amount: f64,
    ) -> BodyPosture {
        let mut posture = self.engagement.sample(time_secs);
        let [lean, roll, yaw] = self.shifts.sample(time_secs);
        let [lean_felt, shrug_felt] = engagement::posture_of_emotion(felt).map(|x| amount * x);
        posture.pelvis.yaw += 0.5 * turn_rad + 0.6 * yaw;
        posture.pelvis.roll += 0.4 * roll;
        posture.pelvis.lean += 0.25 * lean_felt.max(-0.02);
        posture.lumbar.yaw += 0.2 * turn_rad + 0.2 * yaw;
        // The chest counters the tilt of the pelvis.
        posture.lumbar.roll -= 0.7 * roll;
        posture.lumbar.lean += 0.4 * (lean + lean_felt);
        posture.thoracic.yaw += 0.3 * turn_rad + 0.2 * yaw;
        posture.thoracic.roll -= 0.3 * roll;
        posture.thoracic.lean += 0.6 * lean + 0.35 * lean_felt;
        posture.shrug = posture.shrug.map(|shrug| shrug + shrug_felt);
        posture
    }
}

//! Posture of the whole body during speech: trunk and shoulders follow the strokes of the hands,
//! weight and feet follow the sentences, and the body turns to the sides of characters.
//!
//! Everything is planned once from strokes, speech and discourse structure as superposed movements
//! and is then a function of time. Sources: EMOTE (Chi, Costa, Zhao and Badler 2000,
//! doi:10.1145/344779.352172) for the part of the torso in gestures; Cassell, Nakano, Bickmore,
//! Sidner and Rich 2001 (ACL P01-1016) for posture shifts at discourse boundaries.

mod command;
mod engagement;
mod footwork;
mod heading;
mod sentences;

use raconteur_speech::emotion::EmotionPoint;

use crate::body_posture::{BodyPosture, PostureCommand};
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
/// Largest size of body movements, of ordinary lively telling. Designed: an angry climax looks
/// driven and not thrown about.
const MAX_SIZE: f64 = 1.35;
/// Share of the movements that sorrow removes. Designed.
const SORROW_STILLS: f64 = 0.75;

/// Lean of pelvis, lumbar spine and chest for a secret, and elevation of the shoulders, radians.
/// Designed: 9° in all.
const LEAN_IN_RAD: [f64; 3] = [0.05, 0.06, 0.05];
const LEAN_IN_SHRUG_RAD: f64 = 0.03;
/// Time in which a figure leans in or back, its lead before the first word, and the pause in which it
/// stays, seconds. Designed.
const LEAN_IN_SECS: f64 = 0.9;
const LEAN_IN_LEAD_SECS: f64 = 0.5;
const LEAN_IN_PAUSE_SECS: f64 = 1.5;

/// Planned posture of a performance.
#[derive(Clone, Debug, Default)]
pub(crate) struct Posture {
    engagement: Engagement,
    /// Posture shifts at sentences: lean, roll, yaw of the trunk.
    shifts: SuperposedTrack<3>,
    /// Leaning in for secrets, 0 to 1.
    lean_in: SuperposedTrack<1>,
    /// Postures that the script sets.
    commanded: SuperposedTrack<5>,
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
        let size = (tense * lively).min(MAX_SIZE);
        self.amount * size * (1.0 - SORROW_STILLS * sorrow(&felt))
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
    /// Plans the posture for the gestures of both arms, the sentences of the speech, and the
    /// commands of the script.
    pub(crate) fn new(
        plans: &[ArmPlan; 2],
        sentences: &[SentenceSpan],
        commands: &[PostureCommand],
        vigour: &Vigour<'_>,
        seed: u64,
    ) -> Self {
        Self {
            engagement: Engagement::new(plans, vigour, seed),
            shifts: engagement::shifts(sentences, vigour, seed),
            lean_in: lean_in(vigour),
            commanded: command::track(commands),
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
        let [secret] = self.lean_in.sample(time_secs);
        posture.pelvis.yaw += 0.5 * turn_rad + 0.6 * yaw;
        posture.pelvis.roll += 0.4 * roll;
        posture.pelvis.lean += 0.25 * lean_felt.max(-0.02) + LEAN_IN_RAD[0] * secret;
        posture.lumbar.yaw += 0.2 * turn_rad + 0.2 * yaw;
        // The chest counters the tilt of the pelvis.
        posture.lumbar.roll -= 0.7 * roll;
        posture.lumbar.lean += 0.4 * (lean + lean_felt) + LEAN_IN_RAD[1] * secret;
        posture.thoracic.yaw += 0.3 * turn_rad + 0.2 * yaw;
        posture.thoracic.roll -= 0.3 * roll;
        posture.thoracic.lean += 0.6 * lean + 0.35 * lean_felt + LEAN_IN_RAD[2] * secret;
        let shrug_felt = shrug_felt + LEAN_IN_SHRUG_RAD * secret;
        posture.shrug = posture.shrug.map(|shrug| shrug + shrug_felt);
        command::add(self.commanded.sample(time_secs), &mut posture);
        posture
    }
}

/// Returns the leaning in for hushed speech.
fn lean_in(vigour: &Vigour<'_>) -> SuperposedTrack<1> {
    let spans = &vigour.discourse.hushed;
    let mut targets = Vec::new();
    for (i, span) in spans.iter().enumerate() {
        let start_secs = span.start_secs - LEAN_IN_LEAD_SECS;
        targets.push((start_secs, LEAN_IN_SECS, [vigour.amount]));
        let next_secs = spans
            .get(i + 1)
            .map_or(f64::INFINITY, |next| next.start_secs);
        if next_secs - span.end_secs > LEAN_IN_PAUSE_SECS {
            targets.push((span.end_secs, LEAN_IN_SECS, [0.0]));
        }
    }
    SuperposedTrack::new(targets)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nonverbal::Manner;
    use crate::performance::Performance;
    use crate::time_span::TimeSpan;
    use raconteur_base::DVec3;

    /// Returns the posture of a silent performance without gestures at a time.
    fn posture(hushed: &[TimeSpan], commands: &[PostureCommand], time_secs: f64) -> BodyPosture {
        let discourse = Discourse {
            hushed: hushed.to_vec(),
            ..Discourse::default()
        };
        let feeling = FacialBehaviour::new(
            &Performance::default(),
            &discourse,
            &Manner::default(),
            DVec3::Y,
        );
        let vigour = Vigour {
            discourse: &discourse,
            feeling: &feeling,
            amount: 1.0,
        };
        let posture = Posture {
            engagement: Engagement::default(),
            shifts: SuperposedTrack::default(),
            lean_in: lean_in(&vigour),
            commanded: command::track(commands),
        };
        posture.sample(time_secs, 0.0, &EmotionPoint::default(), 1.0)
    }

    fn lean(posture: &BodyPosture) -> f64 {
        posture.pelvis.lean + posture.lumbar.lean + posture.thoracic.lean
    }

    #[test]
    fn the_figure_leans_in_for_secrets_and_back() {
        let span = |start_secs: f64, end_secs: f64| TimeSpan {
            start_secs,
            end_secs,
        };
        let hushed = [span(5.0, 7.0), span(8.0, 9.0)];
        let at = |t: f64| lean(&posture(&hushed, &[], t));
        assert_eq!(at(4.0), 0.0, "it stands before");
        let full: f64 = LEAN_IN_RAD.iter().sum();
        for t in [6.0, 7.9, 8.9] {
            assert!(
                (at(t) - full).abs() < 1e-9,
                "it leans at {t}, also in the pause"
            );
        }
        assert!(at(11.0).abs() < 1e-9, "it stands after");
    }

    #[test]
    fn commands_move_spine_and_shoulders() {
        let commands = [
            PostureCommand {
                start_secs: 1.0,
                duration_secs: 1.0,
                lean_rad: 0.2,
                turn_rad: -0.3,
                shoulders_rad: [0.1, -0.05],
                ..PostureCommand::default()
            },
            PostureCommand {
                start_secs: 5.0,
                duration_secs: 1.0,
                ..PostureCommand::default()
            },
            PostureCommand {
                start_secs: f64::NAN,
                lean_rad: 1.0,
                ..PostureCommand::default()
            },
        ];
        let there = posture(&[], &commands, 3.0);
        let yaw = there.pelvis.yaw + there.lumbar.yaw + there.thoracic.yaw;
        assert!((lean(&there) - 0.2).abs() < 1e-9, "the parts lean together");
        assert!((yaw + 0.3).abs() < 1e-9, "they turn together");
        assert_eq!(there.shrug, [0.1, -0.05], "the shoulders");
        let after = posture(&[], &commands, 6.5);
        assert!(
            lean(&after).abs() < 1e-9,
            "a posture without angles is upright"
        );
    }
}

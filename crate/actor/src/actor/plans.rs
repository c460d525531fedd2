//! Plans of face, arms and body of a performance, in the order in which they depend on each other.

use std::sync::Arc;

use raconteur_base::DVec3;
use raconteur_body::{Bone, Pose, Skeleton};

use super::EYES_FROM_SKULL_M;
use crate::facial_behaviour::FacialBehaviour;
use crate::gesture::rest_choice::RestMood;
use crate::gesture::{ArmPlan, ArmScript, IdleSettings, RestSchedule};
use crate::gesture::{amplitude, deixis, second_hand};
use crate::kinematics::world_from_bone;
use crate::limb::ArmRig;
use crate::nonverbal::Manner;
use crate::performance::Performance;
use crate::posture::{Heading, Posture, Vigour, sentence_spans};

/// Planned behaviour of face, feet, arms and trunk.
pub(super) struct BodyPlans {
    pub(super) feeling: FacialBehaviour,
    pub(super) heading: Heading,
    pub(super) arms: [ArmPlan; 2],
    pub(super) posture: Posture,
}

impl BodyPlans {
    /// Plans a performance for the arms of a figure.
    pub(super) fn new(
        performance: &Performance,
        skeleton: &Skeleton,
        rigs: &[Arc<ArmRig>; 2],
        life: &IdleSettings,
    ) -> Self {
        let IdleSettings { seed, amount, .. } = *life;
        let manner = scaled_manner(&performance.manner, amount);
        let discourse = performance.discourse.usable();
        let at = |bone| world_from_bone(skeleton, &Pose::zero(), bone).translation;
        let eyes = at(Bone::Skull) + EYES_FROM_SKULL_M;
        let feeling = FacialBehaviour::new(performance, &discourse, &manner, eyes);
        let vigour = Vigour {
            discourse: &discourse,
            feeling: &feeling,
            amount,
        };
        let sentences = sentence_spans(&performance.speech, &discourse.paragraphs);
        let axis = DVec3::new(0.0, 0.0, at(Bone::Lumbar).z);
        let heading = Heading::new(
            &sentences,
            &vigour,
            (skeleton.scale(), axis),
            (seed, !is_moved(performance)),
        );
        let mut scripts = scripts_in_figure(performance, &heading);
        if amount > 0.0 {
            amplitude::scale_by_tension(&mut scripts, &discourse, skeleton.scale());
            second_hand::vary(&mut scripts, life.dominant, (seed, skeleton.scale()));
            deixis::indicate(&mut scripts, &discourse.mentions, rigs);
        }
        let mood_at = |t: f64| RestMood::new(&feeling.affect(t), performance.formality);
        let told_secs = (performance.speech.iter())
            .map(raconteur_speech::TimedUtterance::end_secs)
            .filter(|t| t.is_finite())
            .fold(f64::NEG_INFINITY, f64::max);
        let rests = Arc::new(RestSchedule::in_mood(&scripts, life, told_secs, &mood_at));
        let mut arms = rigs.each_ref().map(|rig| {
            let script = &scripts[rig.side().index()];
            let body = (skeleton, Arc::clone(rig));
            ArmPlan::with_rests(script, body, life, Arc::clone(&rests), &discourse)
        });
        let size_at = |t: f64| vigour.size_at(t) * skeleton.scale();
        let [left, right] = arms.each_ref().map(ArmPlan::moving);
        for (arm, others) in arms.iter_mut().zip([right, left]) {
            arm.add_beats(feeling.accents(), &others, &size_at);
        }
        let posture = Posture::new(&arms, &sentences, &performance.postures, &vigour, seed);
        Self {
            feeling,
            heading,
            arms,
            posture,
        }
    }
}

/// Returns true if the performance moves limbs or the whole figure by animations or manipulators.
pub(super) fn is_moved(performance: &Performance) -> bool {
    let way = &performance.manipulators;
    !(way.moves.is_empty() && way.commands.is_empty() && performance.players.commands.is_empty())
}

/// Returns the arm scripts in the axes of a figure that the performance moves about, at its first
/// place and heading.
fn scripts_in_figure(performance: &Performance, heading: &Heading) -> [ArmScript; 2] {
    let way = performance.manipulators.figure_from_world();
    performance.arms.each_ref().map(|script| {
        script.from_viewpoint(|t| {
            let carried = heading.carry(t).inverse();
            match &way {
                Some(way) => carried * way(t),
                None => carried,
            }
        })
    })
}

/// Returns the manner with its amounts of head, brow, blink and gaze motion multiplied by `amount`.
fn scaled_manner(manner: &Manner, amount: f64) -> Manner {
    Manner {
        head: amount * manner.head,
        brows: amount * manner.brows,
        blinks: amount * manner.blinks,
        gaze: amount * manner.gaze,
        ..*manner
    }
}

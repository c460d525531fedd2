//! Evaluates one figure of a story at one time.

mod arms;
mod face;
mod gaze;
mod plans;

use std::sync::Arc;

use raconteur_base::curve::lerp;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side};
use raconteur_body::face::FaceControls;
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_speech::TimedUtterance;

use crate::animation::Players;
use crate::body_posture::BodyPosture;
use crate::face::FaceRig;
use crate::facial_behaviour::FacialBehaviour;
use crate::gesture::contact::Contact;
use crate::gesture::smoothing::JumpSmoothing;
use crate::gesture::{ArmPlan, IdleSettings};
use crate::idle::stance::{Stance, Support};
use crate::idle::trunk::{SpeechRhythm, TrunkMotion};
use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::{ARM_BONES, ArmRig, ArmSolution, BodySpace};
use crate::lips::{LipTrack, MouthTargets};
use crate::manipulator::Manipulators;
use crate::performance::Performance;
use crate::posture::{Heading, Posture};
use plans::BodyPlans;

/// Results that [`Actor`] reports in addition to the pose of a figure at one time: arm solutions,
/// wrist errors, driven limbs, mouth targets and face controls.
#[derive(Clone, Copy, Debug)]
pub struct EvaluationReport {
    /// Solutions of the left and right arm as driven by gestures and rest.
    pub arms: [ArmSolution; 2],
    /// Targets of the left and right wrist, world, metres.
    pub wrist_goals_in_world: [DVec3; 2],
    /// Distance of each wrist of the pose from its target, metres.
    pub wrist_errors_m: [f64; 2],
    /// World from target, per limb driven by a manipulator or, without a turn, by a gesture; in the
    /// order of [`Limb::ALL`](crate::limb::Limb::ALL) without the head.
    pub limb_targets: [Option<DAffine3>; 4],
    /// State of the mouth at the evaluated time, from speech and from visemes set by the script.
    pub mouth: MouthTargets,
    /// The controls of the face.
    pub controls: FaceControls,
}

/// Performance prepared for one figure; computes pose and face at any story time. Evaluation is a
/// pure function of time: it stores no state and allocates nothing.
///
/// # Examples
///
/// ```
/// use raconteur_actor::face::FaceRig;
/// use raconteur_actor::{Actor, Performance};
/// use raconteur_body::Pose;
/// use raconteur_body::read::read_figure;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let figure = read_figure("nuno", &std::fs::read("../../assets/figures/nuno.glb")?)?;
/// let actor = Actor::new(&Performance::default(), &figure.skeleton);
/// let mut pose = Pose::zero();
/// let mut weights = vec![0.0; figure.morph_names.len()];
/// actor.evaluate(&figure.skeleton, &FaceRig::new(&figure), 1.0, &mut pose, &mut weights);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Actor {
    plans: [ArmPlan; 2],
    /// Time spans in which arm motion would jump and is smoothed.
    calming: [JumpSmoothing; 2],
    rigs: [Arc<ArmRig>; 2],
    /// Animation players and manipulators of the figure; `None` if the performance uses neither.
    motion: Option<BodyMotion>,
    space: BodySpace,
    contact: Contact,
    stance: Stance,
    heading: Heading,
    posture: Posture,
    trunk: TrunkMotion,
    rhythm: SpeechRhythm,
    feeling: FacialBehaviour,
    /// Start of each utterance, ascending, and its lips.
    lips: Vec<(f64, LipTrack)>,
    skull_zero: DQuat,
    seed: u64,
    amount: f64,
    listener_in_world: DVec3,
    welcomes: bool,
}

/// Time before and after speech within which breath follows its phrases, seconds.
const BREATH_NEAR_SECS: f64 = 1.5;
/// Middle of the eyes from the skull's joint in the zero pose, metres.
const EYES_FROM_SKULL_M: DVec3 = DVec3::new(0.0, 0.07, 0.08);

/// Largest weight on one foot, as a share of the ordinary one in rest.
const MAX_WEIGHT: f64 = 1.3;

/// Players and manipulators of one performance.
#[derive(Clone, Debug)]
struct BodyMotion {
    players: Players,
    manipulators: Manipulators,
}

/// Returns the amount of motion of a performance, clamped to 0 to 1; 1 if it is not finite.
fn motion_amount(performance: &Performance) -> f64 {
    if performance.motion_amount.is_finite() {
        performance.motion_amount.clamp(0.0, 1.0)
    } else {
        1.0
    }
}

impl Actor {
    /// Prepares a performance: plans the arms, resolves phones, plans the behaviour that
    /// accompanies speech.
    #[must_use]
    pub fn new(performance: &Performance, skeleton: &Skeleton) -> Self {
        let seed = performance.seed;
        let mut speech: Vec<&TimedUtterance> = performance.speech.iter().collect();
        raconteur_base::order::sort_by_number(&mut speech, |u| u.start_secs);
        let spans: Vec<(f64, f64)> = speech
            .iter()
            .map(|u| (u.start_secs, u.end_secs()))
            .collect();
        let amount = motion_amount(performance);
        let life = IdleSettings {
            seed,
            amount,
            dominant: performance.dominant,
        };
        let build = &performance.build;
        let rigs = ArmRig::both(skeleton, build);
        let space = *rigs[0].space();
        let way = &performance.manipulators;
        let is_moved = plans::is_moved(performance);
        let plans = BodyPlans::new(performance, skeleton, &rigs, &life);
        let mut actor = Self {
            posture: plans.posture,
            heading: plans.heading,
            plans: plans.arms,
            calming: Default::default(),
            // Manipulators start from the pose of all other layers, so they come last.
            motion: is_moved.then(|| BodyMotion {
                players: Players::new(
                    &performance.players,
                    &performance.library,
                    skeleton,
                    build.sex,
                    rigs.clone(),
                )
                .0,
                manipulators: Manipulators::at_rest(skeleton, build.sex, rigs.clone()),
            }),
            rigs,
            contact: Contact::new(skeleton, &space, life.dominant),
            space,
            stance: Stance::new(skeleton, build.sex, seed),
            trunk: TrunkMotion { seed },
            rhythm: SpeechRhythm::new(&spans),
            feeling: plans.feeling,
            lips: speech
                .iter()
                .map(|u| (u.start_secs, LipTrack::new(&u.utterance.phones)))
                .collect(),
            skull_zero: rotation_of(&world_from_bone(skeleton, &Pose::zero(), Bone::Skull)),
            seed,
            amount,
            listener_in_world: performance.listener_in_world,
            welcomes: performance.welcomes,
        };
        if actor.welcomes {
            actor
                .plans
                .iter_mut()
                .for_each(|p| p.use_welcome_posture(skeleton));
        }
        let manipulators = actor.motion.as_ref().map(|motion| {
            let idle = |t: f64, pose: &mut Pose| {
                let posture = actor.trunk(skeleton, t, pose);
                let animated = motion.players.apply(skeleton, t, pose);
                let animated = animated.as_ref();
                actor.arms(skeleton, t, (animated, &posture), pose);
                actor.head(skeleton, t, actor.listener_in_world, animated, pose);
            };
            Manipulators::new(way, skeleton, build.sex, actor.rigs.clone(), &idle)
        });
        if let (Some(motion), Some(manipulators)) = (&mut actor.motion, manipulators) {
            motion.manipulators = manipulators;
        }
        actor.calming = actor.calming(skeleton);
        actor
    }

    /// Finds where the gestures of the arms would make them snap.
    fn calming(&self, skeleton: &Skeleton) -> [JumpSmoothing; 2] {
        Side::BOTH.map(|side| {
            let arm_at = |t: f64| {
                let mut pose = Pose::zero();
                let posture = self.trunk(skeleton, t, &mut pose);
                let motion = self.motion.as_ref();
                let animated = motion.and_then(|m| m.players.apply(skeleton, t, &mut pose));
                if let Some(motion) = motion {
                    motion.manipulators.lean(skeleton, t, &mut pose);
                }
                let with = (animated.as_ref(), &posture);
                let (arms, ..) = self.arms(skeleton, t, with, &mut pose);
                arms[side.index()]
            };
            let changing = self.plans[side.index()].changing();
            JumpSmoothing::find(changing.into_iter(), &arm_at)
        })
    }

    /// Moves the listener, for example with the camera. Applies to later evaluations.
    pub fn look_at(&mut self, listener_in_world: DVec3) {
        self.listener_in_world = listener_in_world;
    }

    /// Returns the planned gesture motion of the arm on one side.
    #[must_use]
    pub fn plan(&self, side: Side) -> &ArmPlan {
        &self.plans[side.index()]
    }

    /// Returns true if the script cuts a limb to other joints after one story time and up to
    /// another, seconds.
    #[must_use]
    pub fn cuts_between(&self, after_secs: f64, to_secs: f64) -> bool {
        let cuts = |motion: &BodyMotion| motion.manipulators.cuts_between(after_secs, to_secs);
        self.motion.as_ref().is_some_and(cuts)
    }

    /// Returns world from figure axes at a story time, following the moves in the script; `None` if
    /// the script never moves the figure.
    #[must_use]
    pub fn world_from_figure(&self, time_secs: f64) -> Option<DAffine3> {
        let motion = self.motion.as_ref()?;
        motion.manipulators.world_from_figure(time_secs)
    }

    /// Returns world from gesture space at a story time: scripted places relative to the speaker
    /// follow where the figure stands and faces.
    #[must_use]
    pub fn world_from_gestures(&self, time_secs: f64) -> DAffine3 {
        let carried = self.heading.carry(time_secs);
        match self.world_from_figure(time_secs) {
            Some(moved) => moved * carried,
            None => carried,
        }
    }

    /// Evaluates the figure at a story time into a pose and morph weights (in the order of the
    /// figure's morph names). Overwrites the pose; weights of morphs that the actor does not use
    /// keep their values.
    pub fn evaluate(
        &self,
        skeleton: &Skeleton,
        face: &FaceRig,
        time_secs: f64,
        pose: &mut Pose,
        morph_weights: &mut [f32],
    ) -> EvaluationReport {
        // The order matters: each step uses the joints that the previous steps set.
        let t = if time_secs.is_finite() {
            time_secs
        } else {
            0.0
        };
        // All steps use the axes of the figure until the last one, because the figure may be
        // moving.
        let moved = self.world_from_figure(t);
        let listener = match &moved {
            Some(moved) => moved.inverse().transform_point3(self.listener_in_world),
            None => self.listener_in_world,
        };
        let posture = self.trunk(skeleton, t, pose);
        let motion = self.motion.as_ref();
        let animated = motion.and_then(|motion| motion.players.apply(skeleton, t, pose));
        let animated = animated.as_ref();
        if let Some(motion) = motion {
            motion.manipulators.lean(skeleton, t, pose);
        }
        let (arms, mut wrist_goals_in_world, rest_shares) =
            self.arms(skeleton, t, (animated, &posture), pose);
        let led = motion.map_or([None; 4], |motion| {
            motion.manipulators.limbs(skeleton, t, pose)
        });
        for (i, led) in led.iter().take(2).enumerate() {
            if let Some(led) = led {
                wrist_goals_in_world[i] = led.position;
            }
        }
        let wrist_errors_m = Side::BOTH.map(|side| {
            let i = side.index();
            let wrist = world_from_bone(skeleton, pose, ARM_BONES[i][3]).translation;
            if led[i].is_none() && animated.is_some() {
                // An arm at rest is where its animations have it.
                wrist_goals_in_world[i] = wrist_goals_in_world[i].lerp(wrist, rest_shares[i]);
            }
            wrist.distance_to(wrist_goals_in_world[i])
        });
        let mut led = led.map(|led| {
            let target = led?;
            Some(DAffine3::from_rotation_translation(
                target.rotation,
                target.position,
            ))
        });
        // A gesture drives an arm that neither rests nor follows a manipulator.
        for i in 0..2 {
            if led[i].is_none() && rest_shares[i] < 0.5 {
                led[i] = Some(DAffine3::from_translation(wrist_goals_in_world[i]));
            }
        }
        self.head(skeleton, t, listener, animated, pose);
        if let Some(motion) = motion {
            motion.manipulators.head(skeleton, t, pose);
        }
        let eye_pitch_rad = self.eyes(skeleton, face, t, listener, pose);
        let mouth = self.mouth(t);
        let controls = self.face(&mouth, t);
        face.write(&controls, eye_pitch_rad, pose, morph_weights);
        if let Some(moved) = &moved {
            let turned = rotation_of(moved);
            pose.root_rotation = (turned * pose.root_rotation).normalized();
            pose.root_offset_in_world = moved.transform_point3(pose.root_offset_in_world);
            wrist_goals_in_world = wrist_goals_in_world.map(|w| moved.transform_point3(w));
            led = led.map(|led| led.map(|led| *moved * led));
        }
        EvaluationReport {
            arms,
            wrist_goals_in_world,
            wrist_errors_m,
            limb_targets: led,
            mouth,
            controls,
        }
    }

    /// Returns the filling of the lungs at a time, −1 (exhaled) to 1.6 (a deep breath): with the
    /// phrases near speech, regular without it.
    fn breath(&self, t: f64) -> f64 {
        let breathing = self.feeling.breath(t);
        let regular = self.trunk.breath(&self.rhythm, t, &breathing);
        let spoken = self.rhythm.near(t, BREATH_NEAR_SECS);
        lerp(regular, breathing.depth * self.feeling.lungs(t), spoken)
    }

    /// Returns the contribution of posture at a time.
    fn posture(&self, t: f64) -> BodyPosture {
        let turn_rad = self.heading.turn_rad(t);
        self.posture
            .sample(t, turn_rad, &self.feeling.affect(t), self.amount)
    }

    /// Poses legs and spine in their stance, sway and posture, on a zero pose. Returns the posture.
    fn trunk(&self, skeleton: &Skeleton, t: f64, pose: &mut Pose) -> BodyPosture {
        *pose = Pose::zero();
        let posture = self.posture(t);
        let (place, heading_rad) = self.heading.body(t);
        let idle = (self.stance.weight_at(t) + posture.weight).clamp(-MAX_WEIGHT, MAX_WEIGHT);
        let weight = self.heading.weight(t, idle);
        let support = Support {
            weight,
            place,
            heading_rad,
            pelvis: posture.pelvis,
            width: self.heading.stance_width(),
            feet: self.heading.feet(t),
        };
        self.stance
            .stand(skeleton, t, (self.amount, &support), pose);
        let with = (self.breath(t), &posture);
        let [lumbar, thoracic] = (self.trunk).turns(&self.rhythm, t, weight, self.amount, with);
        pose.set(Bone::Lumbar, lumbar);
        pose.set(Bone::Thoracic, thoracic);
        posture
    }
}

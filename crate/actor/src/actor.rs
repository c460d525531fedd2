//! Evaluates everything that one figure does in a story at one time.

use std::sync::Arc;

use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side, noise};
use raconteur_body::face::{FaceControls, Muscle};
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_speech::TimedUtterance;

use crate::animation::{Animated, Players};
use crate::articulation::{articulate, hold_closures};
use crate::face::FaceRig;
use crate::feeling::Feeling;
use crate::gesture::calm::Calming;
use crate::gesture::contact::{Contact, PlacedHand};
use crate::gesture::{ArmPlan, ArmScript, HandTarget, Life};
use crate::idle::gaze::{HEAD_SHARE, angles_of, eye_towards};
use crate::idle::stance::Stance;
use crate::idle::stream;
use crate::idle::trunk::{SpeechRhythm, Trunk, spine};
use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::{ARM_BONES, ArmGoal, ArmRig, ArmSolution, BodySpace};
use crate::lips::{LipTrack, MouthTargets};
use crate::manipulator::Manipulators;
use crate::nonverbal::Manner;
use crate::score::Performance;

/// Smile of a figure that has nothing else to show. Designed: friendly, not grinning.
const RESTING_SMILE: f64 = 0.14;

/// Smile of a figure that waits to begin. Designed: a welcome to the audience.
const WELCOME_SMILE: f64 = 0.34;
/// How far its head is tilted, radians. Designed.
const WELCOME_TILT_RAD: f64 = 0.045;

/// What an evaluation reports besides the pose.
#[derive(Clone, Copy, Debug)]
pub struct Report {
    /// Solutions of the left and right arm as gestures and rest lead them.
    pub arms: [ArmSolution; 2],
    /// Targets of the left and right wrist, world, metres.
    pub wrist_goals_in_world: [DVec3; 2],
    /// How far each wrist of the pose is from there, metres.
    pub wrist_errors_m: [f64; 2],
    /// World from the target of each limb that a manipulator or, without a turn, a gesture
    /// leads, in the order of [`Limb::ALL`](crate::manipulator::Limb::ALL) without the head.
    pub led: [Option<DAffine3>; 4],
    /// The mouth.
    pub mouth: MouthTargets,
    /// The controls of the face.
    pub controls: FaceControls,
}

/// A performance made ready for one figure. Evaluation is a function of time: it keeps
/// nothing, and allocates nothing.
#[derive(Clone, Debug)]
pub struct Actor {
    plans: [ArmPlan; 2],
    /// Where arms would snap.
    calming: [Calming; 2],
    rigs: [Arc<ArmRig>; 2],
    /// Only where the performance has players or manipulators.
    motion: Option<Motion>,
    space: BodySpace,
    contact: Contact,
    stance: Stance,
    trunk: Trunk,
    rhythm: SpeechRhythm,
    feeling: Feeling,
    /// Start of each utterance, ascending, and its lips.
    lips: Vec<(f64, LipTrack)>,
    skull_zero: DQuat,
    seed: u64,
    amount: f64,
    listener_in_world: DVec3,
    welcomes: bool,
}

/// Players and manipulators of one performance.
#[derive(Clone, Debug)]
struct Motion {
    players: Players,
    manipulators: Manipulators,
}

/// The scripts of the arms as a figure sees them that the performance moves about.
fn seen_on_the_way(performance: &Performance) -> [ArmScript; 2] {
    let way = performance.manipulators.figure_from_world();
    performance.arms.each_ref().map(|script| match &way {
        Some(way) => script.seen_by(way),
        None => script.clone(),
    })
}

/// The amount of motion of a performance, 0 to 1.
fn motion_amount(performance: &Performance) -> f64 {
    if performance.motion_amount.is_finite() {
        performance.motion_amount.clamp(0.0, 1.0)
    } else {
        1.0
    }
}

/// A manner with all that moves scaled by the amount of motion.
fn scaled_manner(manner: &Manner, amount: f64) -> Manner {
    Manner {
        head: amount * manner.head,
        brows: amount * manner.brows,
        blinks: amount * manner.blinks,
        gaze: amount * manner.gaze,
        ..*manner
    }
}

impl Actor {
    /// Makes a performance ready: plans the arms, resolves phones, plans what accompanies speech.
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
        let manner = scaled_manner(&performance.manner, amount);
        let life = Life {
            seed,
            amount,
            dominant: performance.dominant,
        };
        let build = &performance.build;
        let rigs = ArmRig::both(skeleton, build);
        let space = *rigs[0].space();
        let way = &performance.manipulators;
        let seen = (!way.moves.is_empty()).then(|| seen_on_the_way(performance));
        let arms = seen.as_ref().unwrap_or(&performance.arms);
        let is_moved = !(way.moves.is_empty()
            && way.commands.is_empty()
            && performance.players.commands.is_empty());
        let mut actor = Self {
            plans: rigs.each_ref().map(|rig| {
                let script = &arms[rig.side().index()];
                ArmPlan::new(script, skeleton, Arc::clone(rig), &life)
            }),
            calming: Default::default(),
            // Manipulators start from the figure as it is without them, so they come last.
            motion: is_moved.then(|| Motion {
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
            trunk: Trunk { seed },
            rhythm: SpeechRhythm::new(&spans),
            feeling: Feeling::new(performance, &manner),
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
            actor.plans.iter_mut().for_each(|p| p.welcome(skeleton));
        }
        let manipulators = actor.motion.as_ref().map(|motion| {
            let idle = |t: f64, pose: &mut Pose| {
                actor.trunk(skeleton, t, pose);
                let animated = motion.players.apply(skeleton, t, pose);
                let animated = animated.as_ref();
                actor.arms(skeleton, t, animated, pose);
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
    fn calming(&self, skeleton: &Skeleton) -> [Calming; 2] {
        Side::BOTH.map(|side| {
            let arm_at = |t: f64| {
                let mut pose = Pose::zero();
                self.trunk(skeleton, t, &mut pose);
                let motion = self.motion.as_ref();
                let animated = motion.and_then(|m| m.players.apply(skeleton, t, &mut pose));
                if let Some(motion) = motion {
                    motion.manipulators.lean(skeleton, t, &mut pose);
                }
                let (arms, ..) = self.arms(skeleton, t, animated.as_ref(), &mut pose);
                arms[side.index()]
            };
            let moving = self.plans[side.index()].moving();
            Calming::find(moving.into_iter(), &arm_at)
        })
    }

    /// Moves the listener, for example with the camera; holds for evaluations to come.
    pub fn look_at(&mut self, listener_in_world: DVec3) {
        self.listener_in_world = listener_in_world;
    }

    /// The plan of one arm.
    #[must_use]
    pub fn plan(&self, side: Side) -> &ArmPlan {
        &self.plans[side.index()]
    }

    /// Whether the script cuts a limb to other joints after a story time, up to another one,
    /// seconds.
    #[must_use]
    pub fn cuts_between(&self, after_secs: f64, to_secs: f64) -> bool {
        let cuts = |motion: &Motion| motion.manipulators.cuts_between(after_secs, to_secs);
        self.motion.as_ref().is_some_and(cuts)
    }

    /// World from figure axes at a story time: where the script has moved the figure; none
    /// where it never does.
    #[must_use]
    pub fn world_from_figure(&self, time_secs: f64) -> Option<DAffine3> {
        let motion = self.motion.as_ref()?;
        motion.manipulators.world_from_figure(time_secs)
    }

    /// Evaluates the figure at a story time into a pose and morph weights (in the order of
    /// the figure's morph names). The pose is overwritten; weights of morphs that the
    /// actor does not use keep their values.
    pub fn evaluate(
        &self,
        skeleton: &Skeleton,
        face: &FaceRig,
        time_secs: f64,
        pose: &mut Pose,
        morph_weights: &mut [f32],
    ) -> Report {
        // The order matters: each step stands on the joints that the steps before it set.
        let t = if time_secs.is_finite() {
            time_secs
        } else {
            0.0
        };
        // Until the end everything is in the axes of the figure, which may be on its way.
        let moved = self.world_from_figure(t);
        let listener = match &moved {
            Some(moved) => moved.inverse().transform_point3(self.listener_in_world),
            None => self.listener_in_world,
        };
        self.trunk(skeleton, t, pose);
        let motion = self.motion.as_ref();
        let animated = motion.and_then(|motion| motion.players.apply(skeleton, t, pose));
        let animated = animated.as_ref();
        if let Some(motion) = motion {
            motion.manipulators.lean(skeleton, t, pose);
        }
        let (arms, mut wrist_goals_in_world, rest_shares) = self.arms(skeleton, t, animated, pose);
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
        // A gesture leads an arm that does not rest and that no manipulator leads.
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
        Report {
            arms,
            wrist_goals_in_world,
            wrist_errors_m,
            led,
            mouth,
            controls,
        }
    }

    /// How active the emotions of a time are, 0 (calm or passive) to 1; pupils widen with it.
    #[must_use]
    pub fn arousal(&self, time_secs: f64) -> f64 {
        self.feeling.arousal(time_secs)
    }

    /// The controls of the face at a story time: one face for figures of every kind.
    /// Every value is within its range.
    #[must_use]
    pub fn controls(&self, time_secs: f64) -> FaceControls {
        let t = if time_secs.is_finite() {
            time_secs
        } else {
            0.0
        };
        self.face(&self.mouth(t), t)
    }

    /// Speech first, then all else that moves a face, each adding to what is there
    /// (F&H section 4.3.5: contractions are summed, then limited).
    fn face(&self, mouth: &MouthTargets, t: f64) -> FaceControls {
        let mut controls = FaceControls::default();
        articulate(mouth, self.feeling.loudness(t), &mut controls);
        self.expression(t, &mut controls);
        self.feeling.add(t, &mut controls);
        controls.raise_jaw();
        // Closures have their way with the sum, and a blink, which closes the lids whatever
        // else they do, with the lids.
        hold_closures(&mut controls);
        controls.close_lids(self.feeling.closure(t));
        controls
    }

    /// Legs and spine as they stand and sway, on a pose of zero.
    fn trunk(&self, skeleton: &Skeleton, t: f64, pose: &mut Pose) {
        *pose = Pose::zero();
        self.stance.apply(skeleton, t, self.amount, pose);
        let weight = self.stance.weight_at(t);
        let breathing = self.feeling.breath(t);
        self.trunk
            .apply(&self.rhythm, t, weight, self.amount, &breathing, pose);
    }

    fn arms(
        &self,
        skeleton: &Skeleton,
        t: f64,
        animated: Option<&Animated>,
        pose: &mut Pose,
    ) -> ([ArmSolution; 2], [DVec3; 2], [f64; 2]) {
        let thorax = world_from_bone(skeleton, pose, Bone::Thoracic);
        let targets = self.plans.each_ref().map(|plan| plan.at(t));
        // What rests goes with the trunk; what gestures is in the world.
        let moved = thorax * self.rigs[0].world_from_thorax_zero().inverse();
        let turned = rotation_of(&moved);
        let mut hands =
            Side::BOTH.map(|side| self.place(side, &targets[side.index()], &moved, turned));
        let breathing = self.feeling.breath(t);
        let solve = |side: Side, hand: &PlacedHand| {
            let i = side.index();
            let goal = ArmGoal {
                wrist_in_world: hand.wrist,
                hand_in_world: Some(hand.hand),
                shrug_rad: self
                    .trunk
                    .shrug(&self.rhythm, t, i as u64, self.amount, &breathing),
            };
            self.rigs[i].solve(&thorax, &goal)
        };
        let mut arms = Side::BOTH.map(|side| solve(side, &hands[side.index()]));
        // Hands meet as they are, which is not always as they are wanted.
        let met = Side::BOTH.map(|side| {
            let i = side.index();
            PlacedHand {
                hand: self.rigs[i].hand_of(&thorax, &arms[i]),
                ..hands[i]
            }
        });
        let axes = [turned * DVec3::X, turned * DVec3::Z];
        let apart = self.contact.apart([&met[0], &met[1]], axes);
        if apart != DVec3::ZERO {
            hands[0].wrist += apart * 0.5;
            hands[1].wrist -= apart * 0.5;
            arms = Side::BOTH.map(|side| solve(side, &hands[side.index()]));
        }
        for side in Side::BOTH {
            let i = side.index();
            self.calming[i].lead(side, t, &mut arms[i]);
            arms[i].apply(side, pose);
            for (bone, rotation) in hands[i].fingers {
                pose.set(bone, rotation);
            }
            if let Some(animated) = animated {
                let fingers = targets[i].finger_rest_share;
                animated.blend_arm(side, targets[i].rest_share, fingers, pose);
            }
        }
        let rest_shares = targets.each_ref().map(|target| target.rest_share);
        (arms, hands.map(|hand| hand.wrist), rest_shares)
    }

    /// A target as a hand in the world, outside the body.
    fn place(
        &self,
        side: Side,
        target: &HandTarget,
        moved: &DAffine3,
        turned: DQuat,
    ) -> PlacedHand {
        let carried = target
            .wrist
            .lerp(moved.transform_point3(target.wrist), target.rest_share);
        let in_body = moved.inverse().transform_point3(carried);
        let hand = DQuat::IDENTITY.slerp(turned, target.hand_rest_share) * target.hand;
        let mut placed = PlacedHand {
            wrist: self.space.keep_out(in_body),
            hand: (turned.inverse() * hand).normalized(),
            fingers: target.shape.rotations(side),
        };
        placed.wrist += self.contact.way_out(side, &placed);
        placed.wrist = carried + turned * (placed.wrist - in_body);
        placed.hand = hand.normalized();
        placed
    }

    fn head(
        &self,
        skeleton: &Skeleton,
        t: f64,
        listener: DVec3,
        animated: Option<&Animated>,
        pose: &mut Pose,
    ) {
        // Animations are added to the gaze, which must not undo them.
        let moved = animated.filter(|a| a.moves_head()).map(|_| {
            [Bone::Cervical, Bone::Skull].map(|bone| {
                let played = pose.rotation(bone);
                pose.set(bone, DQuat::IDENTITY);
                (bone, played)
            })
        });
        let head = world_from_bone(skeleton, pose, Bone::Skull);
        let axes = rotation_of(&head) * self.skull_zero.inverse();
        // The middle of the eyes is some 7 cm above the skull bone's joint.
        let eyes = head.translation + axes * DVec3::new(0.0, 0.07, 0.08);
        let [yaw, pitch] = angles_of(axes.inverse() * (listener - eyes));
        let motion = self.trunk.head_motion(&self.rhythm, t, self.amount);
        let mut pitch = (HEAD_SHARE * pitch).clamp(-0.4, 0.4) + motion.x;
        let mut yaw = (HEAD_SHARE * yaw).clamp(-0.7, 0.7) + motion.z;
        let mut roll = motion.y + if self.welcomes { WELCOME_TILT_RAD } else { 0.0 };
        let felt = self.feeling.head(t);
        pitch += felt.pitch;
        yaw += felt.yaw;
        roll += felt.roll;
        // Neck and skull share the turn.
        pose.set(Bone::Cervical, spine(0.4 * pitch, 0.4 * roll, 0.4 * yaw));
        pose.set(Bone::Skull, spine(0.6 * pitch, 0.6 * roll, 0.6 * yaw));
        for (bone, played) in moved.into_iter().flatten() {
            pose.set(bone, (played * pose.rotation(bone)).normalized());
        }
    }

    fn eyes(
        &self,
        skeleton: &Skeleton,
        face: &FaceRig,
        t: f64,
        listener: DVec3,
        pose: &mut Pose,
    ) -> [f64; 2] {
        let skull = world_from_bone(skeleton, pose, Bone::Skull);
        let axes = DAffine3::from_rotation_translation(
            rotation_of(&skull) * self.skull_zero.inverse(),
            skull.translation,
        );
        let away = self.feeling.eyes(t);
        let mut pitch = [0.0; 2];
        for (i, eye) in face.eyes_in_skull().into_iter().enumerate() {
            let eye_in_world = skull.transform_point3(eye);
            (pose.eyes[i], pitch[i]) = eye_towards(&axes, eye_in_world, listener, away);
        }
        pitch
    }

    /// The mouth: of speech, and of visemes that the script sets.
    fn mouth(&self, t: f64) -> MouthTargets {
        let mut mouth = self.spoken_mouth(t);
        if let Some(asked) = self.feeling.visemes(t) {
            let channels = mouth.channels.iter_mut().zip(asked.channels);
            channels.for_each(|(value, more)| *value += more);
            mouth.press = (mouth.press + asked.press).min(1.0);
            mouth.bite = (mouth.bite + asked.bite).min(1.0);
        }
        mouth
    }

    /// Everything that is said: when it begins, story seconds, and its lips.
    #[must_use]
    pub fn lips(&self) -> &[(f64, LipTrack)] {
        &self.lips
    }

    fn spoken_mouth(&self, t: f64) -> MouthTargets {
        let i = self.lips.partition_point(|(start, _)| *start <= t);
        let track = |i: usize| self.lips.get(i).map(|(start, track)| (t - start, track));
        // The one that has begun, else the one about to.
        let begun = i
            .checked_sub(1)
            .and_then(track)
            .filter(|(at, track)| track.covers(*at));
        match begun.or_else(|| track(i).filter(|(at, track)| track.covers(*at))) {
            Some((at, track)) => track.at(at),
            None => MouthTargets::default(),
        }
    }

    /// Adds a resting smile and a little unrest.
    fn expression(&self, t: f64, controls: &mut FaceControls) {
        let n =
            |id: u64, hz: f64| noise::perlin(self.seed, stream::FACE + id, hz * t) * self.amount;
        let speaking = self.rhythm.speaking(t) * self.amount;
        // One does not smile to oneself in tears.
        let resting = if self.welcomes {
            WELCOME_SMILE
        } else {
            RESTING_SMILE
        };
        let resting = resting * (1.0 - self.feeling.strength(t));
        let smile = resting + 0.05 * n(0, 0.11) - 0.03 * speaking;
        let smile = [smile + 0.012 * n(1, 0.2), smile - 0.012 * n(1, 0.2)];
        let inner = 0.05 * n(2, 0.3).max(0.0) + 0.03 * speaking;
        let down = 0.05 * (-n(2, 0.3)).max(0.0);
        let squint = 0.04 + 0.03 * n(3, 0.17);
        for (i, smile) in smile.into_iter().enumerate() {
            for (muscle, contraction) in [
                (Muscle::ZygomaticusMajorLeft, smile),
                (Muscle::OrbicularisOculiLeft, squint + 0.25 * smile),
                (Muscle::FrontalisMedialLeft, inner),
                (Muscle::CorrugatorLeft, 0.8 * down),
                (Muscle::DepressorSuperciliiLeft, 0.8 * down),
            ] {
                controls.contraction[muscle.index() + i] += contraction;
            }
        }
    }
}

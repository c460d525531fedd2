//! Animation players prepared for a figure, and their effect at any time.

use std::sync::Arc;

use raconteur_base::curve::{minimum_jerk, smooth};
use raconteur_base::{DAffine3, DQuat, Length, Side};
use raconteur_body::hand_shape::finger_bones;
use raconteur_body::{Bone, Pose, Skeleton};

use super::bound::{BoundClip, ClipSkeleton, WeightedClip};
use super::groups::BoneSet;
use super::layering::BlendedLayers;
use super::library::Library;
use super::schedule::{Interval, Intervals, PlayerPlan, PlayingClip, Schedule, Track};
use super::script::{CommandProblem, PlayerKind, PlayerScript};

use crate::kinematics::world_from_bone;
use crate::limb::{ARM_BONES, ArmRig, LEG_BONES, Sex};

/// Maximum number of concurrent fades; older ones are shown at their end.
const MAX_FADES: usize = 16;
/// Minimum total weight. Layers are scaled up to full weight where others have nothing to play, at
/// most by the inverse of this value, so the last of a weight still fades. Designed.
const MIN_WEIGHT: f64 = 0.1;
/// Share of the idle sway that stays alive over an animation of the legs. Designed.
const SWAY_LEFT: f64 = 0.25;
/// The last of a leg's reach, in which its knee eases out, as a share of it. Designed: 3 mm.
const SPARE: f64 = 0.0035;
/// A foot this high is not stood on, share of stature.
const LIFTED: f64 = 0.03;

/// Animation players of a script over a whole story, prepared for one figure; computes the pose
/// that they give at any time.
#[derive(Clone, Debug)]
pub struct Players {
    schedule: Schedule,
    clips: Vec<BoundClip>,
    body: ClipSkeleton,
}

/// Standing pose of the figure without players.
struct StandingPose {
    pelvis: DAffine3,
    legs: [[DQuat; 3]; 2],
}

/// Pose of a figure from its animation players at one time; later steps (gestures, gaze, speech)
/// build on it.
#[derive(Clone, Copy, Debug)]
pub struct AnimatedPose {
    layers: BlendedLayers,
}

impl Players {
    /// Returns the problems of a script's commands that do not depend on the performing figure.
    #[must_use]
    pub fn problems(script: &PlayerScript) -> Vec<CommandProblem> {
        Schedule::new(script, &|_| false, &|_| 0.0).1
    }

    /// Makes a script ready. Faulty commands are reported and left out.
    #[must_use]
    pub fn new(
        script: &PlayerScript,
        library: &Library,
        skeleton: &Skeleton,
        sex: Sex,
        arms: [Arc<ArmRig>; 2],
    ) -> (Self, Vec<CommandProblem>) {
        let exists = |name: &str| library.get(name).is_some();
        let length = |name: &str| library.get(name).map_or(0.0, |c| c.duration_secs());
        let (schedule, problems) = Schedule::new(script, &exists, &length);
        let body = ClipSkeleton::new(skeleton, arms, sex);
        let bind = |name: &String| {
            let clip = library.get(name).unwrap_or_default();
            BoundClip::new(clip, skeleton, &body)
        };
        let clips = schedule.clips.iter().map(bind).collect();
        let players = Self {
            schedule,
            clips,
            body,
        };
        (players, problems)
    }

    /// Returns the weights of a player's layers at a time. Players are indexed in the order in
    /// which they were added.
    pub fn weights_at(&self, player: usize, time_secs: f64) -> impl Iterator<Item = f64> {
        let plan = self.schedule.players.get(player);
        let tracks = plan.into_iter().flat_map(|p| &p.tracks);
        tracks.map(move |t| t.weight.sample(time_secs))
    }

    /// Applies the animations of a time to an idle pose. Returns `None` and leaves the pose
    /// unchanged when there are none. Allocates nothing.
    ///
    /// The spine keeps its idle motion and the body its sway. The arms keep the idle pose, because
    /// gestures are applied later: see [`AnimatedPose::blend_arm`].
    #[must_use]
    pub fn apply(
        &self,
        skeleton: &Skeleton,
        time_secs: f64,
        pose: &mut Pose,
    ) -> Option<AnimatedPose> {
        let layers = self.layers(skeleton, time_secs)?;
        let idle = StandingPose {
            pelvis: world_from_bone(skeleton, pose, Bone::Sacroiliac),
            legs: LEG_BONES.map(|leg| leg.map(|bone| pose.rotation(bone))),
        };
        for bone in Bone::ALL {
            let share = layers.shares[bone.index()];
            if share <= 0.0 || is_arm(bone) {
                continue;
            }
            let (own, below) = (layers.rotations[bone.index()], pose.rotation(bone));
            let rotation = if matches!(bone, Bone::Lumbar | Bone::Thoracic) {
                // Breath and sway go on on top of animations.
                DQuat::IDENTITY.slerp(own, share) * below
            } else {
                below.slerp(own, share)
            };
            pose.set(bone, rotation.normalized());
        }
        pose.root_offset_in_world +=
            (layers.root - pose.root_offset_in_world * (1.0 - SWAY_LEFT)) * layers.root_share;
        self.plant_feet(skeleton, &idle, &layers, pose);
        Some(AnimatedPose { layers })
    }

    /// Places the feet: a share-weighted mix of the layers that move them and of the idle stance.
    fn plant_feet(
        &self,
        skeleton: &Skeleton,
        idle: &StandingPose,
        layers: &BlendedLayers,
        pose: &mut Pose,
    ) {
        let touched = |b: Bone| layers.shares[b.index()] > 0.0;
        let legs = LEG_BONES.as_flattened();
        let pelvis_moves = touched(Bone::Sacroiliac) || layers.root_share > 0.0;
        if !pelvis_moves && !legs.iter().any(|b| touched(*b)) {
            return;
        }
        let mut pelvis = world_from_bone(skeleton, pose, Bone::Sacroiliac);
        let feet = Side::BOTH.map(|side| {
            let i = side.index();
            let (leg, foot) = (&self.body.legs[i], &layers.feet[i]);
            let own = LEG_BONES[i].map(|b| pose.rotation(b));
            // A leg is not planted if a player moves only single joints of it.
            if LEG_BONES[i].iter().any(|b| touched(*b)) && foot.share <= 0.0 {
                return None;
            }
            let (at, turned, _) = leg.placed(&idle.pelvis, idle.legs[i]);
            let (_, _, knee) = leg.placed(&pelvis, own);
            let ball = self.body.ball(i, at, turned);
            let ball = ball.lerp(foot.ball_in_world, foot.share);
            let turned = turned.slerp(foot.rotation, foot.share);
            Some((self.body.ankle(i, ball, turned), turned, knee))
        });
        // A leg that stretches to its end snaps, so the withheld part fades in with the players.
        let cover = [layers.shares[Bone::Sacroiliac.index()], layers.root_share]
            .into_iter()
            .chain(layers.feet.iter().map(|f| f.share))
            .fold(0.0, f64::max);
        let mut spare_m = [0.0; 2];
        // The figure sinks as far as its planted feet require.
        let mut short: f64 = 0.0;
        for (i, foot) in feet.iter().enumerate() {
            let leg = &self.body.legs[i];
            if let Some((at, ..)) = foot {
                let high = at.y - leg.world_from_ankle().translation.y;
                let stood_on = 1.0 - smooth(high / (LIFTED * self.body.stature_m));
                spare_m[i] = SPARE * leg.reach_m() * (1.0 - stood_on * (1.0 - cover));
                let missing = leg.shortage_m(&pelvis, *at, spare_m[i]);
                short = short.max(stood_on * missing);
            }
        }
        pose.root_offset_in_world.y -= short;
        pelvis.translation.y -= short;
        for (i, foot) in feet.into_iter().enumerate() {
            if let Some((at, turned, knee)) = foot {
                let leg = &self.body.legs[i];
                let at = leg.eased(&pelvis, at, spare_m[i]);
                for (bone, q) in LEG_BONES[i]
                    .into_iter()
                    .zip(leg.solve(&pelvis, at, turned, knee))
                {
                    pose.set(bone, q);
                }
            }
        }
    }

    /// Returns the blend of all players; `None` when there is no player.
    fn layers(&self, skeleton: &Skeleton, t: f64) -> Option<BlendedLayers> {
        let orders = &self.schedule.orders;
        orders.started_by(t).next()?;
        let mut sum = BlendedLayers::EMPTY;
        let mut anything = false;
        in_order(orders, t, |order, share| {
            let mut layers = BlendedLayers::EMPTY;
            anything |= !order.is_empty();
            // The loop runs from the top player down to the first one that covers all others.
            for &player in order.iter().rev() {
                let plan = &self.schedule.players[player];
                let mut below = self.player(skeleton, plan, t, layers.covered());
                below.cover(&layers);
                layers = below;
            }
            sum.fade(&layers, share);
        });
        anything.then_some(sum)
    }

    /// Returns the blend of one player, without clips that move only hidden bones.
    fn player(
        &self,
        skeleton: &Skeleton,
        plan: &PlayerPlan,
        t: f64,
        hidden: BoneSet,
    ) -> BlendedLayers {
        let mut out = BlendedLayers::EMPTY;
        let scale = self.scale(plan, t);
        for track in &plan.tracks {
            let weight = track.weight.sample(t).max(0.0) * track.presence_factor(t) * scale;
            if weight <= 0.0 {
                continue;
            }
            let still = plan.kind == PlayerKind::Pose;
            track.visit_audible(t, |playing, share| {
                let clip = &self.clips[playing.clip];
                if clip.moved(track.bones).without(hidden).is_empty() {
                    return;
                }
                let length_secs = clip.clip.duration_secs();
                let played = track.speed.integral(t) - playing.start_secs;
                let played = if still { 0.0 } else { played };
                let place = playing
                    .style
                    .place(played, length_secs, clip.clip.is_closed());
                let (body, bones) = (&self.body, track.bones);
                let (seam_secs, seam) = place.seam.unwrap_or((0.0, 0.0));
                let share = weight * share;
                for (time_secs, share) in [
                    (place.at_secs, share * (1.0 - seam)),
                    (seam_secs, share * seam),
                ] {
                    let part = WeightedClip {
                        time_secs,
                        bones,
                        share,
                    };
                    clip.add(skeleton, body, part, &mut out);
                }
            });
        }
        out
    }

    /// Returns the factor that scales layer weights so the playing layers share the full weight.
    fn scale(&self, plan: &PlayerPlan, t: f64) -> f64 {
        if plan.kind == PlayerKind::BodyGroup {
            return 1.0;
        }
        // A layer with zero weight does not block the others while they fade.
        let (mut sum, mut most, mut counted) = (0.0, 0.0_f64, 0.0_f64);
        for track in &plan.tracks {
            let mut heard = 0.0;
            track.visit_audible(t, |_, share| heard += share);
            let present = heard * track.presence_factor(t);
            let weight = track.weight.sample(t).max(0.0);
            let counts = (weight / MIN_WEIGHT).min(1.0);
            sum += weight * present;
            most = most.max(present * counts);
            counted = counted.max(counts);
        }
        if counted <= 0.0 {
            return 0.0;
        }
        most / (counted * sum.max(MIN_WEIGHT))
    }
}

impl AnimatedPose {
    /// Blends an arm posed by a gesture or idle motion towards the animation: `rest_share` is 1 at
    /// rest, 0 in a gesture. `finger_share` is the same for fingers, which may gesture while the
    /// arm rests.
    pub fn blend_arm(&self, side: Side, rest_share: f64, finger_share: f64, pose: &mut Pose) {
        let arm = ARM_BONES[side.index()].iter().map(|b| (b, rest_share));
        let fingers = finger_bones(side)
            .iter()
            .map(|b| (b, rest_share.min(finger_share)));
        for (&bone, rest_share) in arm.chain(fingers) {
            let i = bone.index();
            let share = self.layers.shares[i] * rest_share;
            if share > 0.0 {
                let own = self.layers.rotations[i];
                pose.set(bone, pose.rotation(bone).slerp(own, share).normalized());
            }
        }
    }

    /// Returns true if the neck or the head is moved.
    #[must_use]
    pub fn moves_head(&self) -> bool {
        [Bone::Cervical, Bone::Skull]
            .iter()
            .any(|b| self.layers.shares[b.index()] > 0.0)
    }
}

fn is_arm(bone: Bone) -> bool {
    ARM_BONES.as_flattened().contains(&bone)
        || Side::BOTH.iter().any(|s| finger_bones(*s).contains(&bone))
}

impl Track {
    /// Returns the enabled share of the track.
    fn presence_factor(&self, t: f64) -> f64 {
        minimum_jerk(self.on.sample(t))
    }

    /// Visits the clips that contribute to the output: the top of the stack and those it fades over
    /// from. Shares sum to 1 where the stack was never empty.
    fn visit_audible(&self, t: f64, mut each: impl FnMut(&PlayingClip, f64)) {
        let mut left = 1.0;
        for (i, stretch) in self.top.started_by(t).enumerate() {
            let share = faded(stretch, t, i) * left;
            if let Some(playing) = &stretch.value {
                each(playing, share);
            }
            left -= share;
            if left <= 0.0 {
                return;
            }
        }
    }
}

/// Returns the fade-in share of an interval; the oldest interval considered counts as fully faded
/// in.
fn faded<T>(stretch: &Interval<T>, t: f64, age: usize) -> f64 {
    if stretch.fade_secs <= 0.0 || age + 1 >= MAX_FADES {
        return 1.0;
    }
    minimum_jerk((t - stretch.from_secs) / stretch.fade_secs)
}

/// Visits the active intervals, oldest first, with the share by which each has faded in over the
/// earlier ones.
fn in_order<T>(stretches: &Intervals<T>, t: f64, mut each: impl FnMut(&T, f64)) {
    let mut seen = 0;
    for (i, stretch) in stretches.started_by(t).enumerate() {
        seen = i + 1;
        if faded(stretch, t, i) >= 1.0 {
            break;
        }
    }
    for i in (0..seen).rev() {
        if let Some(stretch) = stretches.started_by(t).nth(i) {
            each(&stretch.value, faded(stretch, t, i));
        }
    }
}

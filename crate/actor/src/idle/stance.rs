//! Standing: the weight shifts slowly from foot to foot while the feet stay planted.
//!
//! The pelvis sways, tilts slightly and sinks as far as the legs need to bend; both legs follow in
//! closed form.

use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side, noise};
use raconteur_body::{Bone, Pose, Skeleton};

use super::stream;
use crate::body_posture::Turn;
use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::limits::limits;
use crate::limb::two_bone::TwoBone;
use crate::limb::{LEG_BONES, Limb, Sex};

/// Mean time that the weight stays on one foot, seconds. Designed.
const SHIFT_SECS: f64 = 9.0;
/// Duration of a weight shift, seconds. Designed.
const SHIFT_LENGTH_SECS: f64 = 1.8;
/// Sideways travel of the pelvis to either side, for a stature of 1.7 m, metres. Designed.
const SWAY_M: f64 = 0.042;
/// Tilt of the pelvis with it, radians: the side without weight sinks. Designed.
const TILT_RAD: f64 = 0.055;
/// Clearance for the knees: the pelvis is lowered by this from straight legs, metres. A knee bends
/// by about 15° for 9 mm, so a small value suffices.
const SINK_M: f64 = 0.0008;
/// The same for a figure that tells: its knees are soft. Designed.
const SOFT_SINK_M: f64 = 0.004;
/// Displacement of each foot of a figure that tells: outwards, and to the front (left) or back
/// (right), for a stature of 1.7 m, metres; and its toes outwards, radians. Designed: feet about as
/// far apart as the hips are wide.
const OPEN_M: [f64; 2] = [0.024, 0.016];
const OPEN_RAD: f64 = 0.1;

/// Standing motion of a figure: shifts the weight between planted feet and solves both legs.
#[derive(Clone, Debug)]
pub struct Stance {
    legs: [Leg; 2],
    scale: f64,
    seed: u64,
}

/// Standing place of a figure at one time: weight, place and heading, pelvis and feet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    /// Weight, −1 on the right foot to 1 on the left.
    pub(crate) weight: f64,
    /// Displacement of the body on the floor, metres.
    pub(crate) place: DVec3,
    /// Turn of the body on the floor, radians.
    pub(crate) heading_rad: f64,
    /// Turn of the pelvis on the feet.
    pub(crate) pelvis: Turn,
    /// Width of the stance, 0 (the feet of the zero pose) to 1 (that of a person who tells).
    pub(crate) width: f64,
    /// Transform of the floor under each foot, its lift, metres, and its pitch, radians.
    pub(crate) feet: [(DAffine3, f64, f64); 2],
}

impl Default for Support {
    fn default() -> Self {
        Self {
            weight: 0.0,
            place: DVec3::ZERO,
            heading_rad: 0.0,
            pelvis: Turn::default(),
            width: 0.0,
            feet: [(DAffine3::IDENTITY, 0.0, 0.0); 2],
        }
    }
}

/// Measures of one leg of a figure that do not depend on the pose; solve its joints for a foot
/// position.
#[derive(Clone, Debug)]
pub(crate) struct Leg {
    chain: TwoBone,
    hip_in_pelvis: DVec3,
    hip_zero: DQuat,
    knee_zero: DQuat,
    ankle_zero: DQuat,
    /// World from ankle in the zero pose.
    ankle_in_world: DAffine3,
}

impl Stance {
    /// Measures the legs of a skeleton; `seed` selects the random weight shifts.
    #[must_use]
    pub fn new(skeleton: &Skeleton, sex: Sex, seed: u64) -> Self {
        Self {
            legs: Side::BOTH.map(|side| Leg::new(skeleton, side, sex)),
            scale: skeleton.scale(),
            seed,
        }
    }

    /// Returns the weight distribution at a time: −1 on the right foot, 1 on the left.
    #[must_use]
    pub fn weight_at(&self, time_secs: f64) -> f64 {
        let side = |bucket: i64| {
            let size = 0.45 + 0.55 * noise::unit(self.seed, stream::STANCE + 1, bucket);
            // Mostly to the other side, sometimes only less or more on the same.
            let flip = if noise::unit(self.seed, stream::STANCE + 2, bucket) < 0.2 {
                -1.0
            } else {
                1.0
            };
            if bucket.rem_euclid(2) == 0 {
                size * flip
            } else {
                -size * flip
            }
        };
        let bucket = (time_secs / SHIFT_SECS).floor();
        let delay = 5.0 * noise::unit(self.seed, stream::STANCE, bucket as i64);
        let s = minimum_jerk((time_secs - bucket * SHIFT_SECS - delay) / SHIFT_LENGTH_SECS);
        let before = side((bucket as i64).wrapping_sub(1));
        let shift = before + (side(bucket as i64) - before) * s;
        0.8 * shift + 0.2 * noise::perlin(self.seed, stream::STANCE + 3, 0.19 * time_secs)
    }

    /// Sways the pelvis and plants the feet, without speech. `amount` 0..1 scales the motion.
    pub fn apply(&self, skeleton: &Skeleton, time_secs: f64, amount: f64, pose: &mut Pose) {
        let support = Support {
            weight: self.weight_at(time_secs),
            ..Support::default()
        };
        self.stand(skeleton, time_secs, (amount, &support), pose);
    }

    /// Stands on its feet with the weight of `support`.
    pub(crate) fn stand(
        &self,
        skeleton: &Skeleton,
        time_secs: f64,
        (amount, support): (f64, &Support),
        pose: &mut Pose,
    ) {
        let weight = amount * support.weight;
        let forth = amount * noise::perlin(self.seed, stream::STANCE + 4, 0.13 * time_secs);
        let Turn { lean, roll, yaw } = support.pelvis;
        let tilt = DQuat::from_rotation_z(TILT_RAD * weight - roll) * DQuat::from_rotation_x(lean);
        let turn = DQuat::from_rotation_y(0.02 * weight + support.heading_rad + yaw);
        let pelvis = Bone::Sacroiliac;
        let zero = skeleton.joints()[pelvis.index()].zero_rotation;
        let sway = DVec3::new(SWAY_M * weight, 0.0, 0.006 * forth) * self.scale;
        let headed = DQuat::from_rotation_y(support.heading_rad);
        let pelvis_at = skeleton.joints()[pelvis.index()].translation_in_parent;
        pose.root_offset_in_world += support.place + headed * (sway + pelvis_at)
            - pelvis_at
            - DVec3::Y * (lerp(SINK_M, SOFT_SINK_M, support.width) * amount * self.scale);
        pose.set(pelvis, (zero.inverse() * turn * tilt * zero).normalized());

        let feet: [(DVec3, DQuat); 2] = core::array::from_fn(|i| {
            let (floor, lift_m, pitch_rad) = support.feet[i];
            let open = self.legs[i].open(Side::BOTH[i], amount * support.width, self.scale);
            self.legs[i].foot(&(floor * open, lift_m, pitch_rad))
        });
        // Sink until both legs reach their feet.
        let pelvis_in_world = world_from_bone(skeleton, pose, pelvis);
        let short = self
            .legs
            .iter()
            .zip(&feet)
            .map(|(leg, foot)| leg.shortage_m(&pelvis_in_world, foot.0, 0.0))
            .fold(0.0, f64::max);
        pose.root_offset_in_world.y -= short;
        let pelvis_in_world = DAffine3 {
            translation: pelvis_in_world.translation - DVec3::Y * short,
            ..pelvis_in_world
        };
        for ((leg, (at, foot)), [hip, knee, ankle]) in self.legs.iter().zip(feet).zip(LEG_BONES) {
            // The knee is directed as the foot is.
            let ahead = foot * rotation_of(&leg.ankle_in_world).inverse() * DVec3::Z;
            let [h, k, a] = leg.solve(&pelvis_in_world, at, foot, ahead);
            pose.set(hip, h);
            pose.set(knee, k);
            pose.set(ankle, a);
        }
    }
}

impl Leg {
    /// Returns the ankle's place and rotation, world, for the transform of the floor under the
    /// foot, its lift, metres, and its pitch, radians.
    fn foot(&self, (floor, lift_m, pitch_rad): &(DAffine3, f64, f64)) -> (DVec3, DQuat) {
        let at = floor.transform_point3(self.ankle_in_world.translation) + DVec3::Y * *lift_m;
        let turned = rotation_of(floor) * DQuat::from_rotation_x(*pitch_rad);
        (
            at,
            (turned * rotation_of(&self.ankle_in_world)).normalized(),
        )
    }

    /// Returns the transform of the floor under a foot that opens the stance, about the ankle.
    fn open(&self, side: Side, width: f64, scale: f64) -> DAffine3 {
        let [out_m, front_m] = OPEN_M;
        let ankle = self.ankle_in_world.translation;
        let by = DVec3::new(side.sign() * out_m, 0.0, side.sign() * front_m) * (scale * width);
        let turned = DQuat::from_rotation_y(side.sign() * OPEN_RAD * width);
        DAffine3::from_rotation_translation(turned, ankle + by - turned * ankle)
    }

    /// Measures one leg of a skeleton.
    pub(crate) fn new(skeleton: &Skeleton, side: Side, sex: Sex) -> Self {
        let zero = Pose::zero();
        let joints = skeleton.joints();
        let [hip, knee, ankle] = LEG_BONES[side.index()];
        let knee_in_world = rotation_of(&world_from_bone(skeleton, &zero, knee));
        Self {
            // A positive turn about the figure's left carries the shank backwards.
            chain: TwoBone::new(
                joints[knee.index()].translation_in_parent,
                joints[ankle.index()].translation_in_parent,
                joints[knee.index()].zero_rotation,
                knee_in_world.inverse() * DVec3::X,
                limits([Limb::LeftLeg, Limb::RightLeg][side.index()], sex)[2].max_rad,
            ),
            hip_in_pelvis: joints[hip.index()].translation_in_parent,
            hip_zero: joints[hip.index()].zero_rotation,
            knee_zero: joints[knee.index()].zero_rotation,
            ankle_zero: joints[ankle.index()].zero_rotation,
            ankle_in_world: world_from_bone(skeleton, &zero, ankle),
        }
    }

    /// Returns the transform from ankle to world in the zero pose.
    pub(crate) fn world_from_ankle(&self) -> &DAffine3 {
        &self.ankle_in_world
    }

    /// Returns the drop of the pelvis required for the leg to reach an ankle with `spare_m` to
    /// spare, metres.
    pub(crate) fn shortage_m(
        &self,
        world_from_pelvis: &DAffine3,
        ankle_in_world: DVec3,
        spare_m: f64,
    ) -> f64 {
        let to = ankle_in_world - world_from_pelvis.transform_point3(self.hip_in_pelvis);
        let sideways = to.x * to.x + to.z * to.z;
        let reach = self.chain.reach_m() - spare_m;
        let most = (reach * reach - sideways).max(0.0).sqrt();
        // A straight knee is stiff, so a minimal flexion remains.
        (-to.y - most + 1e-4).max(0.0)
    }

    /// Returns an ankle position that the leg reaches without snapping, metres. Within the last
    /// `spare_m` of the reach the knee would stretch ever faster, so positions there and beyond are
    /// eased.
    pub(crate) fn eased(&self, world_from_pelvis: &DAffine3, ankle: DVec3, spare_m: f64) -> DVec3 {
        let to = ankle - world_from_pelvis.transform_point3(self.hip_in_pelvis);
        let distance = to.magnitude();
        let back = distance - self.chain.eased_m(distance, spare_m);
        if back > 0.0 {
            ankle - to * (back / distance)
        } else {
            ankle
        }
    }

    /// Returns the length of the stretched leg, metres.
    pub(crate) fn reach_m(&self) -> f64 {
        self.chain.reach_m()
    }

    /// Solves the local rotations of hip, knee and ankle that place the ankle at a position with a
    /// given foot rotation (world from ankle), the knee pointing along `knee` (world, any length).
    /// The direction of a position out of reach is preserved.
    pub(crate) fn solve(
        &self,
        world_from_pelvis: &DAffine3,
        ankle: DVec3,
        foot: DQuat,
        knee: DVec3,
    ) -> [DQuat; 3] {
        let pelvis = rotation_of(world_from_pelvis);
        let to = ankle - world_from_pelvis.transform_point3(self.hip_in_pelvis);
        let flexion = self.chain.flexion_for(to.magnitude());
        let direction = to.try_normalized().unwrap_or(DVec3::NEG_Y);
        let hip_in_world = self.chain.aim(flexion, direction, knee);
        let flexed = self.chain.flexed(flexion);
        let shank = hip_in_world * self.knee_zero * flexed;
        let hip = (pelvis * self.hip_zero).inverse() * hip_in_world;
        let ankle = (shank * self.ankle_zero).inverse() * foot;
        [hip.normalized(), flexed, ankle.normalized()]
    }

    /// Returns world from ankle, and the knee direction, for local rotations of hip, knee and
    /// ankle: the inverse of [`Leg::solve`].
    pub(crate) fn placed(
        &self,
        world_from_pelvis: &DAffine3,
        [hip, knee, ankle]: [DQuat; 3],
    ) -> (DVec3, DQuat, DVec3) {
        let hip_in_world = rotation_of(world_from_pelvis) * self.hip_zero * hip;
        let shank = hip_in_world * self.knee_zero * knee;
        let hip_at = world_from_pelvis.transform_point3(self.hip_in_pelvis);
        let ankle_at = hip_at + hip_in_world * self.chain.hinge() + shank * self.chain.lower();
        let axis = hip_in_world * self.knee_zero * self.chain.axis();
        (
            ankle_at,
            (shank * self.ankle_zero * ankle).normalized(),
            (ankle_at - hip_at).cross(axis),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feet_stay_planted_while_the_pelvis_sways() {
        let skeleton = Skeleton::example();
        let stance = Stance::new(&skeleton, Sex::Male, 42);
        let zero = Pose::zero();
        let (mut least, mut most, mut worst) = (f64::MAX, f64::MIN, 0.0_f64);
        for i in 0..1_200 {
            let mut pose = Pose::zero();
            stance.apply(&skeleton, f64::from(i) * 0.1, 1.0, &mut pose);
            for bone in [
                Bone::LSubtalar,
                Bone::RSubtalar,
                Bone::LMetatarsal,
                Bone::RMetatarsal,
            ] {
                let a = world_from_bone(&skeleton, &zero, bone);
                let b = world_from_bone(&skeleton, &pose, bone);
                worst = worst.max(a.translation.distance(b.translation));
            }
            least = least.min(pose.root_offset_in_world.x);
            most = most.max(pose.root_offset_in_world.x);
            assert!(
                pose.rotations
                    .iter()
                    .all(|q| q.is_finite() && q.is_normalized()),
                "all rotations are finite and normalised"
            );
        }
        assert!(worst < 1e-6, "{worst} m");
        assert!(most - least > 0.015, "{least} {most}");
    }

    #[test]
    fn a_leg_is_found_again_from_where_it_stands() {
        let skeleton = Skeleton::example();
        for side in Side::BOTH {
            let leg = Leg::new(&skeleton, side, Sex::Male);
            let pelvis = world_from_bone(&skeleton, &Pose::zero(), Bone::Sacroiliac);
            let at = leg.world_from_ankle().translation + DVec3::new(0.1 * side.sign(), 0.2, 0.15);
            let foot = DQuat::from_rotation_x(0.4) * rotation_of(leg.world_from_ankle());
            let knee = DVec3::new(0.5 * side.sign(), 0.1, 1.0);
            let solved = leg.solve(&pelvis, at, foot, knee);
            let (there, turned, looks) = leg.placed(&pelvis, solved);
            assert!(
                there.distance(at) < 1e-9 && turned.angle_between(foot) < 1e-6,
                "the ankle reaches the position and rotation of the goal"
            );
            for (q, again) in solved.iter().zip(leg.solve(&pelvis, there, turned, looks)) {
                assert!(
                    q.angle_between(again) < 1e-6,
                    "solving the placed leg gives the same rotations"
                );
            }
        }
    }

    #[test]
    fn knees_bend_forward() {
        let skeleton = Skeleton::example();
        let stance = Stance::new(&skeleton, Sex::Male, 1);
        let mut pose = Pose::zero();
        pose.root_offset_in_world = DVec3::new(0.0, -0.15, 0.0);
        stance.apply(&skeleton, 3.0, 1.0, &mut pose);
        for bone in [Bone::LKnee, Bone::RKnee] {
            let z = world_from_bone(&skeleton, &pose, bone).translation.z;
            assert!(z > bone.example_position_m().z + 0.05, "{z}");
        }
    }
}

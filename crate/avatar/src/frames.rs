//! Skeleton of an imported avatar: the positions of its 54 bones, and the rotation of each in the
//! avatar's rest pose relative to the zero pose.
//!
//! A rest pose may be anything from a T to hanging arms. The line to the next joint determines a
//! bone's direction; the bend of the elbow and the row of knuckles determine its twist, and
//! otherwise the shortest rotation applies.

use raconteur_base::{DAffine3, DMat3, DQuat, DVec3, Side, ops};

use super::align::Alignment;
use super::humanoid::Humanoid;
use super::tree::Tree;
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::{Bone, FaceJoints, Skeleton, zero_frames};

/// Rest pose of an imported figure mapped to the engine's 54-bone skeleton.
pub(super) struct RestSkeleton {
    pub(super) skeleton: Skeleton,
    /// Joint from world in the rest pose.
    pub(super) inverse_bind: Vec<DAffine3>,
    /// Positions of the bones in the rest pose, world, metres.
    pub(super) places: [DVec3; Bone::COUNT],
}

/// Finds the skeleton.
pub(super) fn rest(tree: &Tree<'_>, humanoid: &Humanoid, alignment: &Alignment) -> RestSkeleton {
    let place_of = |node: usize| {
        alignment
            .ours_from_theirs
            .transform_point3(tree.place(node))
    };
    let mut found = BoneFinder {
        places: [None; Bone::COUNT],
        turns: [DQuat::IDENTITY; Bone::COUNT],
        tips: humanoid
            .tips
            .iter()
            .map(|(b, n)| (*b, place_of(*n)))
            .collect(),
        zero: zero_frames(),
        stature_m: alignment.stature_m,
    };
    for bone in Bone::ALL {
        found.places[bone.index()] = humanoid.get(bone).map(place_of);
    }
    for side in Side::BOTH {
        // A hand of several joints is at their centre.
        let wrist = Bone::on(side, "wrist");
        let palms: Vec<DVec3> = humanoid
            .further
            .iter()
            .filter(|(_, b)| *b == wrist)
            .map(|(n, _)| place_of(*n))
            .collect();
        if !palms.is_empty() {
            found.places[wrist.index()] =
                Some(palms.iter().copied().sum::<DVec3>() / palms.len() as f64);
        }
    }
    found.trunk();
    for side in Side::BOTH {
        found.leg(side);
        found.arm(side);
    }
    let places = found.places.map(Option::unwrap_or_default);
    let skull = places[Bone::Skull.index()];
    let face = FaceJoints {
        eye_centres: Side::BOTH.map(|side| {
            humanoid.eyes[side.index()].map_or_else(
                || skull + DVec3::new(0.0186 * side.sign(), 0.0241, 0.049) * alignment.stature_m,
                place_of,
            )
        }),
    };
    let bind: [DQuat; Bone::COUNT] = core::array::from_fn(|i| found.turns[i] * found.zero[i]);
    let skeleton = Skeleton::from_bind(&places, &bind, face, alignment.stature_m);
    let mut pose = Pose::zero();
    for bone in Bone::ALL {
        let local = bone.parent().map_or(bind[bone.index()], |p| {
            bind[p.index()].inverse() * bind[bone.index()]
        });
        let zero = skeleton.joints()[bone.index()].zero_rotation;
        pose.set(bone, (zero.inverse() * local).normalize());
    }
    let mut world = Vec::new();
    skeleton.solve(&pose, &mut world);
    RestSkeleton {
        inverse_bind: world.iter().map(DAffine3::inverse).collect(),
        skeleton,
        places,
    }
}

struct BoneFinder {
    places: [Option<DVec3>; Bone::COUNT],
    /// World rotation from the zero pose to the rest pose.
    turns: [DQuat; Bone::COUNT],
    tips: Vec<(Bone, DVec3)>,
    zero: [DQuat; Bone::COUNT],
    stature_m: f64,
}

impl BoneFinder {
    fn position_of(&self, bone: Bone) -> Option<DVec3> {
        self.places[bone.index()]
    }

    /// Returns the position of a bone, set to `guess` if the file has none.
    fn or(&mut self, bone: Bone, guess: DVec3) -> DVec3 {
        *self.places[bone.index()].get_or_insert(guess)
    }

    fn turn(&self, bone: Bone) -> DQuat {
        self.turns[bone.index()]
    }

    fn set_turn(&mut self, bone: Bone, turn: DQuat) {
        self.turns[bone.index()] = turn.normalize();
    }

    /// Returns a vector given for the left side in shares of stature.
    fn share(&self, side: Side, x: f64, y: f64, z: f64) -> DVec3 {
        DVec3::new(x * side.sign(), y, z) * self.stature_m
    }

    /// Returns the offset between two bones of the example skeleton (GEVH table A.1), scaled to
    /// this figure's stature, metres.
    fn example_offset(&self, from: Bone, to: Bone) -> DVec3 {
        let example_stature_m = 77.0 * raconteur_base::METRES_PER_INCH;
        (to.example_position_m() - from.example_position_m()) * (self.stature_m / example_stature_m)
    }

    /// Builds the frames of trunk, neck and head. They preserve the figure's posture: a chest in
    /// front of the hips is part of the stance, not a bend.
    fn trunk(&mut self) {
        let hips = self.or(Bone::Sacroiliac, DVec3::ZERO);
        let skull = self.or(Bone::Skull, hips + DVec3::Y * (0.37 * self.stature_m));
        let shoulders = 0.5
            * (self.position_of(Bone::LShoulder).unwrap_or(skull)
                + self.position_of(Bone::RShoulder).unwrap_or(skull));
        let neck = self.or(Bone::Cervical, shoulders.lerp(skull, 0.3));
        let chest = self.or(Bone::Thoracic, hips.lerp(neck, 0.55));
        // With one joint in the spine, both bones turn about it.
        self.or(Bone::Lumbar, chest);
        self.or(
            Bone::Chin,
            skull + self.share(Side::Left, 0.0, 0.0097, 0.0096),
        );
        let spine = (neck - hips).normalize_or(DVec3::Y);
        // 25°: less is posture.
        if spine.y < 0.906 {
            let lean = DQuat::from_rotation_arc(DVec3::Y, spine);
            for bone in [
                Bone::Sacroiliac,
                Bone::Lumbar,
                Bone::Thoracic,
                Bone::LScapula,
                Bone::RScapula,
            ] {
                self.set_turn(bone, lean);
            }
        }
    }

    /// Returns the rotation that follows `before` and brings the bone's x axis onto `direction`.
    fn along(&self, before: DQuat, bone: Bone, direction: DVec3) -> DQuat {
        let from = before * (self.zero[bone.index()] * DVec3::X);
        direction.try_normalize().map_or(before, |d| {
            DQuat::from_rotation_arc(from.normalize(), d) * before
        })
    }

    fn leg(&mut self, side: Side) {
        let [hip, knee, ankle, mid, toe] =
            ["hip", "knee", "subtalar", "midtarsal", "metatarsal"].map(|part| Bone::on(side, part));
        let pelvis = self.position_of(Bone::Sacroiliac).unwrap_or_default();
        let hip_at = self.or(hip, pelvis + self.share(side, 0.0525, -0.023, 0.012));
        let knee_at = self.or(knee, hip_at + self.share(side, 0.0, -0.24, 0.0));
        let shin = (knee_at - hip_at).normalize_or(DVec3::NEG_Y) * (0.236 * self.stature_m);
        let ankle_at = self.or(ankle, knee_at + shin);
        let toe_at = self.or(toe, ankle_at + self.share(side, 0.007, -0.032, 0.078));
        self.or(mid, ankle_at.lerp(toe_at, 0.5));

        let thigh = self.along(DQuat::IDENTITY, hip, knee_at - hip_at);
        let shank = self.along(thigh, knee, ankle_at - knee_at);
        self.set_turn(hip, thigh);
        self.set_turn(knee, shank);
        // Standing figures have flat feet in any direction; for other figures, the feet are assumed
        // perpendicular to the shank. The threshold is 20°.
        let stands = [knee_at - hip_at, ankle_at - knee_at]
            .iter()
            .all(|d| d.normalize_or_zero().y < -0.94);
        if !stands {
            for bone in [ankle, mid, toe] {
                self.set_turn(bone, shank);
            }
        }
    }

    fn arm(&mut self, side: Side) {
        let [scapula, shoulder, elbow, wrist] =
            ["scapula", "shoulder", "elbow", "wrist"].map(|part| Bone::on(side, part));
        let chest = self.position_of(Bone::Thoracic).unwrap_or_default();
        let shoulder_at = self.or(shoulder, chest + self.share(side, 0.084, 0.09, 0.0));
        let inner = DVec3::new(
            0.018 * self.stature_m * side.sign(),
            shoulder_at.y + 0.02 * self.stature_m,
            shoulder_at.z,
        );
        self.or(scapula, inner);
        let elbow_at = self.or(elbow, shoulder_at + self.share(side, 0.15, 0.0, 0.0));
        let upper = elbow_at - shoulder_at;
        let wrist_at = self.or(wrist, elbow_at + upper * 0.85);
        let lower = wrist_at - elbow_at;

        let mut upper_turn = self.along(self.turn(scapula), shoulder, upper);
        // A bent elbow shows its hinge: flexion turns about +z.
        let (u, f) = (upper.normalize_or_zero(), lower.normalize_or_zero());
        let bend = ops::acos_clamped(u.dot(f));
        let hinge = upper_turn * (self.zero[shoulder.index()] * DVec3::Z);
        if let Some(shown) = u.cross(f).try_normalize()
            && shown.dot(hinge) > 0.0
        {
            // From 8° on, wholly from 25° on: less is the modeller's hand.
            let sure = raconteur_base::curve::smooth((bend.to_degrees() - 8.0) / 17.0);
            let angle = signed_angle(hinge, shown, u) * sure;
            upper_turn = DQuat::from_axis_angle(u, angle) * upper_turn;
        }
        self.set_turn(shoulder, upper_turn);
        let lower_turn = self.along(upper_turn, elbow, lower);
        self.set_turn(elbow, lower_turn);
        let hand = self.hand(side, wrist_at, lower_turn);
        self.set_turn(wrist, hand);
        self.fingers(side, wrist_at);
    }

    /// Returns the rotation of the hand from its knuckles, or that of the forearm if they are
    /// unknown.
    fn hand(&self, side: Side, wrist_at: DVec3, forearm: DQuat) -> DQuat {
        let wrist = Bone::on(side, "wrist");
        let known: Vec<Bone> = ["index0", "middle0", "ring0", "pinky0"]
            .iter()
            .map(|part| Bone::on(side, part))
            .filter(|b| self.position_of(*b).is_some())
            .collect();
        let (Some(&first), Some(&last)) = (known.first(), known.last()) else {
            return forearm;
        };
        // Basis of the line to the knuckles and of the knuckles' row.
        let basis = |wrist_at: DVec3, first: DVec3, last: DVec3| {
            let along = (0.5 * (first + last) - wrist_at).try_normalize()?;
            let row = (first - last)
                .reject_from_normalized(along)
                .try_normalize()?;
            Some(DMat3::from_cols(along, row, along.cross(row)))
        };
        let ours = basis(
            wrist.example_position_m(),
            first.example_position_m(),
            last.example_position_m(),
        );
        let theirs = self
            .position_of(first)
            .zip(self.position_of(last))
            .and_then(|(first, last)| basis(wrist_at, first, last));
        let Some((ours, theirs)) = ours.zip(theirs) else {
            let middle = self.position_of(first).unwrap_or(wrist_at);
            return self.along(forearm, wrist, middle - wrist_at);
        };
        let turn = DQuat::from_mat3(&(theirs * ours.transpose()));
        // A wrist turns about 90° either way from palms down; more indicates a broken rig.
        if turn.angle_between(forearm) < 2.1 {
            turn
        } else {
            self.along(forearm, wrist, theirs.x_axis)
        }
    }

    fn fingers(&mut self, side: Side, wrist_at: DVec3) {
        let wrist = Bone::on(side, "wrist");
        let hand = self.turn(wrist);
        for finger in ["index", "middle", "ring", "pinky", "thumb"] {
            let row = [0, 1, 2].map(|i| Bone::on(side, &format!("{finger}{i}")));
            let mut before = (wrist, wrist_at, hand);
            for (i, &bone) in row.iter().enumerate() {
                let (parent, parent_at, turn) = before;
                let here = self.or(bone, parent_at + turn * self.example_offset(parent, bone));
                let next = row
                    .get(i + 1)
                    .and_then(|b| self.position_of(*b))
                    .or_else(|| {
                        let tip = self.tips.iter().find(|(b, _)| *b == bone);
                        tip.map(|(_, at)| *at)
                    });
                let own = match next {
                    None => turn,
                    // A thumb's axes do not follow its joints in the source.
                    Some(next) if finger == "thumb" && i < 2 => {
                        let ours = turn * self.example_offset(bone, row[i + 1]);
                        (next - here).try_normalize().map_or(turn, |d| {
                            DQuat::from_rotation_arc(ours.normalize(), d) * turn
                        })
                    }
                    Some(next) => self.along(turn, bone, next - here),
                };
                self.set_turn(bone, own);
                before = (bone, here, own);
            }
        }
    }
}

/// Returns the signed angle about `axis` from one perpendicular vector to another, radians.
fn signed_angle(from: DVec3, to: DVec3, axis: DVec3) -> f64 {
    ops::atan2(from.cross(to).dot(axis), from.dot(to))
}

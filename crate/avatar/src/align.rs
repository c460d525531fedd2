//! Alignment of an imported avatar with the generated figures: upright, facing +z, in metres, soles
//! at zero.

use raconteur_base::{DAffine3, DQuat, DVec3, Side, ops};

use super::error::{DiagnosticSink, ImportError};
use super::humanoid::Humanoid;
use super::tree::Tree;
use raconteur_body::skeleton::Bone;

/// Range of plausible statures from a file's unit, metres: from a small doll to a giant.
const BELIEVED_M: core::ops::Range<f64> = 0.4..2.7;
/// Statures that are believed of another unit, metres.
const LIKELY_M: core::ops::Range<f64> = 0.9..2.4;
/// Metres in the units that files are written in by mistake: centimetres, inches,
/// millimetres.
const UNITS: [f64; 3] = [0.01, raconteur_base::METRES_PER_INCH, 0.001];
/// Stature of a figure whose size is implausible, metres.
const USUAL_M: f64 = 1.70;
/// Height of the hips' joint over stature; the generator's own figures have it there.
const HIPS_SHARE: f64 = 0.545;

/// Orientation and stance of an imported figure in its file, used to turn it upright and facing +z.
pub(super) struct RestStance {
    /// Upright and facing +z from the file's world.
    pub(super) turn: DQuat,
    has_legs: bool,
}

/// Transform from an imported file to the engine's frame (upright, facing +z, metres, soles at
/// zero), and the stature.
pub(super) struct Alignment {
    /// Our world from the file's.
    pub(super) ours_from_theirs: DAffine3,
    /// Standing height, metres.
    pub(super) stature_m: f64,
}

impl RestStance {
    /// Determines the up and front directions of the figure; swaps sides that are misnamed.
    pub(super) fn find(
        tree: &Tree<'_>,
        humanoid: &mut Humanoid,
        notes: &mut DiagnosticSink,
    ) -> Result<Self, ImportError> {
        let at = |h: &Humanoid, bone: Bone| h.get(bone).map(|n| tree.place(n));
        let needed = |h: &Humanoid, bone: Bone| {
            at(h, bone).ok_or_else(|| ImportError::NotHumanoid("a bone was lost".to_owned()))
        };
        let hips = needed(humanoid, Bone::Sacroiliac)?;
        let shoulders = [
            needed(humanoid, Bone::LShoulder)?,
            needed(humanoid, Bone::RShoulder)?,
        ];
        let middle = 0.5 * (shoulders[0] + shoulders[1]);
        let up = (needed(humanoid, Bone::Skull)? - hips).try_normalize();
        let across = (shoulders[0] - shoulders[1]).try_normalize();
        let (Some(up), Some(across)) = (up, across) else {
            return Err(ImportError::NotHumanoid(
                "the head is inside the hips, or both shoulders coincide".to_owned(),
            ));
        };
        if across.dot(up).abs() > 0.7 || (middle - hips).dot(up) <= 0.0 {
            return Err(ImportError::NotHumanoid(
                "the shoulders do not lie across the trunk".to_owned(),
            ));
        }
        let legs: Vec<DVec3> = [Bone::LKnee, Bone::RKnee]
            .into_iter()
            .filter_map(|b| at(humanoid, b))
            .collect();
        let has_legs = legs.len() == 2;
        if has_legs {
            let down = (0.5 * (legs[0] + legs[1]) - hips).normalize_or_zero();
            if down.dot(up) > -0.35 {
                return Err(ImportError::NotHumanoid(
                    "the legs are not below the trunk as in a human; is it an animal?".to_owned(),
                ));
            }
        }
        // Leaning a little is a posture; lying is an axis gone wrong.
        let upright = if up.y > 0.7 {
            DQuat::IDENTITY
        } else if !has_legs {
            return Err(ImportError::NotHumanoid(
                "the trunk is horizontal, and no legs show which way is up; is it an animal?"
                    .to_owned(),
            ));
        } else {
            notes.add(
                "turned-upright",
                "the figure is lying down in its file and was set upright",
                "",
            );
            DQuat::from_rotation_arc(up, DVec3::Y)
        };
        let mut yaw = facing(upright * across);
        if toes_point_back(tree, humanoid, yaw * upright) {
            humanoid.swap_sides();
            yaw = facing(upright * -across);
            notes.add(
                "sides-swapped",
                "names of the left side are on the right; the sides were exchanged",
                "",
            );
        }
        Ok(Self {
            turn: yaw * upright,
            has_legs,
        })
    }

    /// Scales and positions the figure; `low` and `high` bound the rotated figure's vertices in the
    /// file's unit.
    pub(super) fn align(
        &self,
        tree: &Tree<'_>,
        humanoid: &Humanoid,
        low: DVec3,
        high: DVec3,
        notes: &mut DiagnosticSink,
    ) -> Result<Alignment, ImportError> {
        let hips = humanoid
            .get(Bone::Sacroiliac)
            .map_or(DVec3::ZERO, |n| self.turn * tree.place(n));
        let height = if self.has_legs {
            high.y - low.y
        } else {
            (high.y - hips.y) / (1.0 - HIPS_SHARE)
        };
        if !(height.is_finite() && height > 1e-9) {
            return Err(ImportError::NotHumanoid(
                "the figure has no height".to_owned(),
            ));
        }
        let scale = if BELIEVED_M.contains(&height) {
            1.0
        } else if let Some(unit) = UNITS.into_iter().find(|u| LIKELY_M.contains(&(u * height))) {
            notes.add(
                "rescaled",
                format!("it would be {height:.3} m tall; its unit was taken for {unit} m"),
                "",
            );
            unit
        } else {
            notes.add(
                "rescaled",
                format!("it would be {height:.3} m tall and was brought to {USUAL_M} m"),
                "export it in metres",
            );
            USUAL_M / height
        };
        let stature_m = scale * height;
        let floor = if self.has_legs {
            low.y * scale
        } else {
            hips.y * scale - HIPS_SHARE * stature_m
        };
        // The hips are slightly behind the midpoint of the ankles, as in generated figures.
        let offset = DVec3::new(-hips.x * scale, -floor, -0.012 * stature_m - hips.z * scale);
        Ok(Alignment {
            ours_from_theirs: DAffine3::from_scale_rotation_translation(
                DVec3::splat(scale),
                self.turn,
                offset,
            ),
            stature_m,
        })
    }
}

/// Returns the rotation about the vertical that brings `across`, which points to the left, to +x.
fn facing(across: DVec3) -> DQuat {
    let yaw = ops::atan2(-across.z, across.x);
    // A figure that faces nearly along an axis is meant to face along it; the exact symmetry is
    // preserved.
    let quarter = core::f64::consts::FRAC_PI_2;
    let nearest = (yaw / quarter).round() * quarter;
    let yaw = if (yaw - nearest).abs() < 0.06 {
        nearest
    } else {
        yaw
    };
    let half = -0.5 * yaw;
    DQuat::from_xyzw(0.0, ops::sin(half), 0.0, ops::cos(half))
}

/// Returns true if both feet point backwards after `turn`.
fn toes_point_back(tree: &Tree<'_>, humanoid: &Humanoid, turn: DQuat) -> bool {
    Side::BOTH.iter().all(|&side| {
        let [ankle, toe] = ["subtalar", "metatarsal"].map(|p| humanoid.get(Bone::on(side, p)));
        ankle.zip(toe).is_some_and(|(ankle, toe)| {
            let foot = turn * (tree.place(toe) - tree.place(ankle));
            foot.z < -0.5 * foot.length()
        })
    })
}

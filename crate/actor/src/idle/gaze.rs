//! Where the eyes look: at the listener, with small saccades and brief glances away, the
//! head taking its part.

use raconteur_base::curve::{minimum_jerk, smooth};
use raconteur_base::{DAffine3, DQuat, DVec3, noise, ops};

use super::stream;

/// Largest turn of an eye, radians (some 35° before the head must follow).
const EYE_MAX_RAD: f64 = 0.6;
/// Share of a direction that head and neck take. Designed.
pub const HEAD_SHARE: f64 = 0.55;
/// Time of a saccade, seconds (30 to 60 ms for up to 15°).
const SACCADE_SECS: f64 = 0.045;
/// Stretch of one fixation while looking at a face, seconds.
const FIXATION_SECS: f64 = 0.9;
/// Stretch that holds at most one unprompted glance away, seconds.
const GLANCE_STRETCH_SECS: f64 = 7.0;

/// A look away from the listener.
#[derive(Clone, Copy, Debug)]
struct Glance {
    start_secs: f64,
    end_secs: f64,
    /// Yaw (left) and pitch (down), radians.
    angles: [f64; 2],
}

/// When the eyes look away and where.
#[derive(Clone, Debug)]
pub struct Gaze {
    prompted: Vec<Glance>,
    seed: u64,
}

impl Gaze {
    /// From the beginnings of clauses (story time, seconds): speakers look away as they
    /// begin and back as they end (Kendon 1967, doi:10.1016/0001-6918(67)90005-4); a share
    /// of clauses does.
    #[must_use]
    pub fn new(clause_starts: &[f64], seed: u64) -> Self {
        let mut starts: Vec<f64> = clause_starts
            .iter()
            .copied()
            .filter(|t| t.is_finite())
            .collect();
        raconteur_base::order::sort_by_number(&mut starts, |t| *t);
        let mut prompted: Vec<Glance> = Vec::new();
        for (i, start) in starts.into_iter().enumerate() {
            let r = |k| noise::unit(seed, stream::GLANCE + k, i as i64);
            let start_secs = start - 0.25 + 0.2 * r(1);
            let crowded = prompted
                .last()
                .is_some_and(|g| start_secs < g.end_secs + 2.5);
            if r(0) < 0.4 && !crowded {
                let end_secs = start_secs + 0.5 + 0.7 * r(2);
                prompted.push(Glance {
                    start_secs,
                    end_secs,
                    angles: aside(r(3), r(4)),
                });
            }
        }
        Self { prompted, seed }
    }

    /// How far the gaze is from the listener at a time: yaw (left) and pitch (down), radians.
    /// `amount` scales glances and saccades.
    #[must_use]
    pub fn away(&self, time_secs: f64, speaking: f64, amount: f64) -> [f64; 2] {
        let i = self.prompted.partition_point(|g| g.start_secs <= time_secs);
        let prompted = i
            .checked_sub(1)
            .map_or([0.0; 2], |i| self.prompted[i].at(time_secs));
        // Unprompted ones fade while speaking, when the clauses rule.
        let stretch = (time_secs / GLANCE_STRETCH_SECS).floor() as i64;
        let free = self
            .unprompted(stretch)
            .map_or([0.0; 2], |g| g.at(time_secs));
        let micro = self.fixation(time_secs);
        core::array::from_fn(|k| amount * (prompted[k] + free[k] * (1.0 - speaking) + micro[k]))
    }

    fn unprompted(&self, stretch: i64) -> Option<Glance> {
        let r = |k| noise::unit(self.seed, stream::GLANCE + 8 + k, stretch);
        let start_secs = (stretch as f64 + 0.1 + 0.6 * r(1)) * GLANCE_STRETCH_SECS;
        let end_secs = start_secs + 0.5 + 1.0 * r(2);
        (r(0) < 0.6).then(|| Glance {
            start_secs,
            end_secs,
            angles: aside(r(3), r(4)),
        })
    }

    /// Small steps between the listener's eyes and mouth.
    fn fixation(&self, time_secs: f64) -> [f64; 2] {
        let bucket = (time_secs / FIXATION_SECS).floor();
        let i = bucket as i64;
        let late = 0.6 * FIXATION_SECS * noise::unit(self.seed, stream::SACCADE, i);
        let s = minimum_jerk((time_secs - bucket * FIXATION_SECS - late) / SACCADE_SECS);
        core::array::from_fn(|k| {
            let at = |i: i64| 0.013 * noise::signed(self.seed, stream::SACCADE + 1 + k as u64, i);
            let before = at(i.wrapping_sub(1));
            before + (at(i) - before) * s
        })
    }
}

/// A direction aside: mostly sideways and down, at times up.
fn aside(u: f64, v: f64) -> [f64; 2] {
    let yaw = if u < 0.5 {
        -0.12 - 0.4 * u
    } else {
        0.12 + 0.4 * (u - 0.5)
    };
    [yaw, if v < 0.7 { 0.05 + 0.12 * v } else { -0.08 }]
}

impl Glance {
    fn at(&self, time_secs: f64) -> [f64; 2] {
        let away = minimum_jerk((time_secs - self.start_secs) / (1.5 * SACCADE_SECS));
        let back = minimum_jerk((time_secs - self.end_secs) / (1.5 * SACCADE_SECS));
        self.angles.map(|a| a * (away - back))
    }

    /// The head goes along, later and more slowly.
    fn head_at(&self, time_secs: f64) -> [f64; 2] {
        let away = smooth((time_secs - self.start_secs - 0.04) / 0.45);
        let back = smooth((time_secs - self.end_secs - 0.04) / 0.55);
        self.angles.map(|a| a * (away - back))
    }
}

impl Gaze {
    /// The head's part in prompted glances: yaw (left) and pitch (down), radians.
    #[must_use]
    pub fn head_away(&self, time_secs: f64, amount: f64) -> [f64; 2] {
        let i = self.prompted.partition_point(|g| g.start_secs <= time_secs);
        let last = i
            .checked_sub(1)
            .map_or([0.0; 2], |i| self.prompted[i].head_at(time_secs));
        last.map(|a| 0.45 * amount * a)
    }
}

/// Yaw (left) and pitch (down) of a direction in axes x left, y up, z front, radians.
#[must_use]
pub fn angles_of(direction: DVec3) -> [f64; 2] {
    let flat = ops::hypot(direction.x, direction.z);
    [
        ops::atan2(direction.x, direction.z),
        -ops::atan2(direction.y, flat),
    ]
}

/// Rotation of one eye in the skull's zero axes that looks at a point, turned by `away`,
/// within the eye's range; and its pitch (positive down), radians.
#[must_use]
pub fn eye_towards(
    world_from_skull_axes: &DAffine3,
    eye_in_world: DVec3,
    target_in_world: DVec3,
    away: [f64; 2],
) -> (DQuat, f64) {
    let to = world_from_skull_axes.matrix3.transpose() * (target_in_world - eye_in_world);
    let [yaw, pitch] = if to.length() > 1e-6 {
        angles_of(to)
    } else {
        [0.0; 2]
    };
    let yaw = soft(yaw + away[0]);
    let pitch = soft(pitch + away[1]);
    (
        DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch),
        pitch,
    )
}

/// Approaches [`EYE_MAX_RAD`] instead of passing it.
fn soft(angle: f64) -> f64 {
    let free = 0.8 * EYE_MAX_RAD;
    let over = angle.abs() - free;
    let rest = EYE_MAX_RAD - free;
    if over <= 0.0 {
        angle
    } else {
        angle.signum() * (free + rest * over / (over + rest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eye_looks_at_its_target() {
        let eye = DVec3::new(0.03, 1.6, 0.08);
        for target in [DVec3::new(0.4, 1.5, 2.0), DVec3::new(-0.7, 1.9, 2.5)] {
            let (q, _) = eye_towards(&DAffine3::IDENTITY, eye, target, [0.0; 2]);
            assert!((q * DVec3::Z).angle_between(target - eye) < 1e-6);
        }
        let (q, pitch) = eye_towards(&DAffine3::IDENTITY, eye, eye - DVec3::Z, [0.0; 2]);
        assert!(q.is_finite() && pitch.abs() <= EYE_MAX_RAD);
    }

    #[test]
    fn the_listener_gets_most_of_the_gaze() {
        let clauses: Vec<f64> = (0..60).map(|i| f64::from(i) * 4.0).collect();
        let gaze = Gaze::new(&clauses, 5);
        let away = |i: i32| {
            let [yaw, pitch] = gaze.away(f64::from(i) * 0.05, 1.0, 1.0);
            ops::hypot(yaw, pitch)
        };
        let looking = (0..4_800).filter(|i| away(*i) < 0.03).count();
        assert!((3_300..4_700).contains(&looking), "{looking} of 4800");
        assert!((0..4_800).all(|i| away(i) < 0.45));
    }
}

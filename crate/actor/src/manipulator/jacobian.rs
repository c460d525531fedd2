//! Inverse velocity: joint speeds for given speeds of a limb's end effector, damped where the
//! joints cannot follow (GEVH section 3.3.3).

use raconteur_base::{DVec3, Length};

use crate::limb::RigidFrame;
use crate::limb::wrist::rotation_vector;

/// Length in metres that counts as much as a radian.
const METRES_PER_RAD: f64 = 0.3;
/// Below this measure of manipulability (the root of the determinant of J·Jᵀ) damping sets
/// in, and its greatest value (Nakamura and Hanafusa 1986, doi:10.1115/1.3143764). An arm
/// that is bent by 10° measures 0.37, one that is bent by 90° 1.4.
const MANIPULABLE: f64 = 0.37;
const DAMPING: f64 = 0.05;

/// Linear and angular velocity of a limb's end, figure axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Linear velocity, m/s.
    pub linear: DVec3,
    /// Angular velocity, rad/s.
    pub angular: DVec3,
}

impl Twist {
    /// Returns the velocity that takes one frame to another in one second.
    #[must_use]
    pub fn between(from: &RigidFrame, to: &RigidFrame) -> Self {
        let turn = (to.rotation * from.rotation.inverse()).normalized();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        Self {
            linear: to.position - from.position,
            angular: rotation_vector(turn),
        }
    }
}

/// Returns joint speeds for the velocity of an end at `end` (figure axes, metres): damped least
/// squares over joints given by axis and a point on it. Axes of length zero do not move.
#[must_use]
pub fn joint_speeds(axes: &[(DVec3, DVec3); 7], end: DVec3, twist: &Twist) -> [f64; 7] {
    let columns = axes.map(|(axis, at)| {
        let linear = axis.cross(end - at) / METRES_PER_RAD;
        [linear.x, linear.y, linear.z, axis.x, axis.y, axis.z]
    });
    let mut square = [[0.0; 6]; 6];
    for (i, row) in square.iter_mut().enumerate() {
        for (j, cell) in row.iter_mut().enumerate() {
            *cell = columns.iter().map(|c| c[i] * c[j]).sum();
        }
    }
    let l = twist.linear / METRES_PER_RAD;
    let a = twist.angular;
    let wanted = [l.x, l.y, l.z, a.x, a.y, a.z];
    // The product of the diagonal is the measure of manipulability.
    let measure = |l: &[[f64; 6]; 6]| (0..6).map(|i| l[i][i]).product::<f64>();
    let plain = cholesky(&square, 1e-12);
    let lacking = 1.0 - measure(&plain) / MANIPULABLE;
    let lower = if lacking > 0.0 {
        cholesky(&square, 1e-12 + DAMPING * lacking * lacking)
    } else {
        plain
    };
    let solved = solve(&lower, wanted);
    columns.map(|c| c.iter().zip(&solved).map(|(a, b)| a * b).sum())
}

/// Returns the Cholesky factor of a damped matrix: the lower triangle L with L·Lᵀ = `square` +
/// `damping`·1.
fn cholesky(square: &[[f64; 6]; 6], damping: f64) -> [[f64; 6]; 6] {
    let mut lower = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            lower[i][j] = if i == j {
                (square[i][i] + damping - known).max(1e-18).sqrt()
            } else {
                (square[i][j] - known) / lower[j][j]
            };
        }
    }
    lower
}

/// Solves L·Lᵀ·x = `right`.
fn solve(lower: &[[f64; 6]; 6], right: [f64; 6]) -> [f64; 6] {
    let mut x = right;
    for i in 0..6 {
        let known: f64 = (0..i).map(|k| lower[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / lower[i][i];
    }
    for i in (0..6).rev() {
        let known: f64 = (i + 1..6).map(|k| lower[k][i] * x[k]).sum();
        x[i] = (x[i] - known) / lower[i][i];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_crossed_axes_follow_exactly() {
        // Three hinges through the end and three far from it.
        let far = DVec3::new(0.0, 0.3, 0.4);
        let axes = [
            (DVec3::X, DVec3::ZERO),
            (DVec3::Y, DVec3::ZERO),
            (DVec3::Z, DVec3::ZERO),
            (DVec3::X, far),
            (DVec3::Y, DVec3::new(0.5, 0.0, 0.1)),
            (DVec3::Z, DVec3::new(0.4, -0.3, 0.0)),
            (DVec3::ZERO, DVec3::ZERO),
        ];
        let twist = Twist {
            linear: DVec3::new(0.1, -0.2, 0.3),
            angular: DVec3::new(0.5, 0.1, -0.4),
        };
        let speeds = joint_speeds(&axes, DVec3::ZERO, &twist);
        let (mut linear, mut angular) = (DVec3::ZERO, DVec3::ZERO);
        for (speed, (axis, at)) in speeds.iter().zip(axes) {
            linear += axis.cross(-at) * *speed;
            angular += axis * *speed;
        }
        assert!(linear.distance(twist.linear) < 1e-9, "{linear}");
        assert!(angular.distance(twist.angular) < 1e-9, "{angular}");
    }

    #[test]
    fn where_joints_cannot_follow_they_stay_slow() {
        let along = (DVec3::Z, DVec3::new(0.5, 0.0, 0.0));
        let axes = [along; 7];
        let twist = Twist {
            linear: DVec3::X,
            angular: DVec3::X,
        };
        let speeds = joint_speeds(&axes, DVec3::ZERO, &twist);
        assert!(speeds.iter().all(|s| s.abs() < 100.0), "{speeds:?}");
    }
}

//! Measures of pelvis, chest and head.

use raconteur_base::{DQuat, DVec3, Length, ops};

use super::recording::Recording;
use super::signal::{Distribution, deviation, rates};
use super::{Measure, people};

/// Names of the angles of [`angles_deg`].
const ANGLES: [&str; 3] = ["yaw", "pitch", "roll"];

/// Returns the measures of pelvis, chest and head.
pub(super) fn measures(recording: &Recording) -> Vec<Measure> {
    let [pelvis, chest, head] = [&recording.pelvis, &recording.chest, &recording.head]
        .map(|turns| recording.smoothed_turns(turns));
    let mut all = deviations("chest", &chest, people::CHEST_SD_DEG);
    let speed = Distribution::new(recording.turn_speeds_deg_s(&recording.chest).into_iter());
    all.extend([
        Measure::new("chest-speed-mean", "°/s", speed.mean())
            .with_amount(people::CHEST_MEAN_SPEED_DEG_S),
        Measure::new("chest-speed-p95", "°/s", speed.quantile(0.95))
            .with_amount(people::CHEST_P95_SPEED_DEG_S),
    ]);
    all.extend(deviations(
        "chest-on-pelvis",
        &relative(&pelvis, &chest),
        people::CHEST_ON_PELVIS_SD_DEG,
    ));
    all.extend(pelvis_measures(recording, &pelvis));
    all.extend(deviations("head", &head, people::HEAD_SD_DEG));
    let speed = Distribution::new(recording.turn_speeds_deg_s(&recording.head).into_iter());
    let values = [
        ("mean", speed.mean()),
        ("median", speed.median()),
        ("p90", speed.quantile(0.9)),
        ("p99", speed.quantile(0.99)),
    ];
    for ((name, value), lively) in values.into_iter().zip(people::HEAD_SPEED_DEG_S) {
        let measure = Measure::new(format!("head-speed-{name}"), "°/s", value);
        all.push(measure.with_amount(lively));
    }
    all.extend(deviations(
        "head-on-chest",
        &relative(&chest, &head),
        people::HEAD_ON_CHEST_SD_DEG,
    ));
    all
}

fn pelvis_measures(recording: &Recording, turns: &[DQuat]) -> [Measure; 4] {
    let place = recording.smoothed(&recording.pelvis_at);
    let velocities = rates(&place, &recording.runs);
    let speed = Distribution::new(velocities.iter().map(|v| 1e2 * v.with_y(0.0).magnitude()));
    let [yaw, ..] = angles_deg(turns);
    let deviation_cm = |axis: DVec3| deviation(place.iter().map(|p| 1e2 * p.dot(axis)));
    [
        Measure::new("pelvis-yaw-sd", "°", deviation(yaw.iter().copied()))
            .with_amount(people::PELVIS_YAW_SD_DEG),
        Measure::new("pelvis-across-sd", "cm", deviation_cm(DVec3::X))
            .with_amount(people::PELVIS_ACROSS_SD_CM),
        Measure::new("pelvis-along-sd", "cm", deviation_cm(DVec3::Z))
            .with_amount(people::PELVIS_ALONG_SD_CM),
        Measure::new("pelvis-speed-mean", "cm/s", speed.mean())
            .with_amount(people::PELVIS_MEAN_SPEED_CM_S),
    ]
}

/// Returns the standard deviations of the three angles of rotations.
fn deviations(part: &str, turns: &[DQuat], lively: [f64; 3]) -> Vec<Measure> {
    let angles = angles_deg(turns);
    let named = ANGLES.iter().zip(&angles).zip(lively);
    let measures = named.map(|((angle, values), lively)| {
        let value = deviation(values.iter().copied());
        Measure::new(format!("{part}-{angle}-sd"), "°", value).with_amount(lively)
    });
    measures.collect()
}

/// Returns rotations relative to others.
fn relative(to: &[DQuat], turns: &[DQuat]) -> Vec<DQuat> {
    let pairs = to.iter().zip(turns);
    pairs.map(|(to, turn)| to.inverse() * *turn).collect()
}

/// Returns yaw about y, pitch about x and roll about z of rotations, in degrees: the rotations turn
/// first by roll, then by pitch, then by yaw. The yaw is continuous.
pub(super) fn angles_deg(turns: &[DQuat]) -> [Vec<f64>; 3] {
    let mut angles = [const { Vec::new() }; 3];
    let mut yaw_before = 0.0;
    for turn in turns {
        let [left, up, front] = DVec3::AXES.map(|axis| *turn * axis);
        let yaw = ops::atan2(front.x, front.z);
        yaw_before += ops::wrap_angle(yaw - yaw_before);
        angles[0].push(yaw_before.to_degrees());
        angles[1].push(ops::asin_clamped(-front.y).to_degrees());
        angles[2].push(ops::atan2(left.y, up.y).to_degrees());
    }
    angles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_rotation_and_the_yaw_is_continuous() {
        let turns: Vec<DQuat> = (0..100)
            .map(|i| {
                let step = f64::from(i).to_radians();
                DQuat::from_rotation_y(5.0 * step)
                    * DQuat::from_rotation_x(0.3 * step)
                    * DQuat::from_rotation_z(-0.2 * step)
            })
            .collect();
        let angles = angles_deg(&turns);
        for i in 0..100 {
            for (values, rate) in angles.iter().zip([5.0, 0.3, -0.2]) {
                let off = (values[i] - rate * i as f64).abs();
                assert!(off < 1e-6, "sample {i}: {off}");
            }
        }
    }
}

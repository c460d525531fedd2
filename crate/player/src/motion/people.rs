//! Motion of people, for comparison.
//!
//! Source: the clip `067_Speech_2` of ZeroEGGS in YoungSeng/UnifiedGesture: a trained actress
//! orates, standing, for 68.8 s at 30 Hz. The values were computed from her joints, smoothed at
//! about 7 Hz (movements at about 4 Hz). One lively clip of one person is an upper band, not an
//! average. Arrays of angles are in the order yaw, pitch, roll; arrays of hands left, right.

/// Conversation compared with the lively performer: about half.
pub const CALM_SHARE: f64 = 0.5;

/// Standard deviation of the chest's angles in space, degrees.
pub const CHEST_SD_DEG: [f64; 3] = [13.3, 3.5, 5.3];
/// Mean angular speed of the chest in space, degrees per second.
pub const CHEST_MEAN_SPEED_DEG_S: f64 = 22.0;
/// 95th percentile of the chest's angular speed in space, degrees per second.
pub const CHEST_P95_SPEED_DEG_S: f64 = 64.0;
/// Standard deviation of the chest's angles on the hips, degrees.
pub const CHEST_ON_PELVIS_SD_DEG: [f64; 3] = [5.0, 4.2, 7.4];

/// Standard deviation of the yaw of the hips in space, degrees.
pub const PELVIS_YAW_SD_DEG: f64 = 10.0;
/// Standard deviation of the place of the hips across the body, centimetres.
pub const PELVIS_ACROSS_SD_CM: f64 = 11.0;
/// Standard deviation of the place of the hips along the line of sight, centimetres.
pub const PELVIS_ALONG_SD_CM: f64 = 6.0;
/// Mean speed of the hips, centimetres per second.
pub const PELVIS_MEAN_SPEED_CM_S: f64 = 12.0;

/// Standard deviation of the head's angles in space, degrees.
pub const HEAD_SD_DEG: [f64; 3] = [12.2, 7.9, 4.7];
/// Mean, median, 90th and 99th percentile of the head's angular speed in space, degrees per second.
pub const HEAD_SPEED_DEG_S: [f64; 4] = [30.0, 22.0, 66.0, 137.0];
/// Standard deviation of the head's angles on the chest, degrees.
pub const HEAD_ON_CHEST_SD_DEG: [f64; 3] = [14.1, 7.5, 6.1];

/// Steps of both feet per minute.
pub const STEPS_PER_MINUTE: f64 = 8.8;
/// Length of a step, centimetres: the middle of 8 to 10.
pub const STEP_LENGTH_CM: f64 = 9.0;
/// Time in which a foot moves in a step, seconds: the middle of 0.2 to 0.3.
pub const STEP_SECS: f64 = 0.25;

/// Speed of each wrist: mean, median, 90th, 95th and 99th percentile, and maximum, metres per
/// second.
pub const WRIST_SPEED_M_S: [[f64; 6]; 2] = [
    [0.50, 0.35, 1.08, 1.35, 2.1, 3.6],
    [0.55, 0.33, 1.33, 1.74, 2.5, 3.4],
];
/// Acceleration of each wrist: median, 90th, 95th and 99th percentile, metres per second squared.
pub const WRIST_ACCELERATION_M_S2: [[f64; 4]; 2] =
    [[2.2, 9.0, 14.0, 25.0], [2.0, 15.0, 24.0, 41.0]];

/// Movements of each hand per minute: from one minimum of its speed to the next, with a peak above
/// 0.4 m/s between.
pub const MOVEMENTS_PER_MINUTE: [f64; 2] = [85.0, 93.0];
/// Duration of each hand's movements: lower quartile, median and upper quartile, seconds.
pub const MOVEMENT_SECS: [[f64; 3]; 2] = [[0.23, 0.40, 0.60], [0.17, 0.30, 0.55]];
/// Peak speed of a movement relative to its mean speed, median.
pub const PEAK_TO_MEAN_SPEED: f64 = 1.52;
/// Time of the peak speed as a share of the movement's duration, median.
pub const PEAK_PLACE: f64 = 0.50;

/// Holds of each hand per minute: slower than 0.1 m/s for more than 0.15 s.
pub const HOLDS_PER_MINUTE: [f64; 2] = [11.0, 15.0];
/// Median duration of each hand's holds, seconds.
pub const HOLD_SECS: [f64; 2] = [0.27, 0.30];

/// Share of the time with a hand faster than 0.2 m/s in which both are, percent.
pub const BOTH_HANDS_PERCENT: f64 = 73.0;
/// Share of the same time in which only one hand is: left, right; percent.
pub const ONE_HAND_PERCENT: [f64; 2] = [14.0, 13.0];

//! Time functions for the motion of limbs and whole figures (GEVH D.1.6 and D.3.23).
//!
//! A [`Path`] is the path as scripted; [`TimedPath`] fills its open values from the limb's current
//! position. Curves begin and, unless they loop, end at rest.

use core::f64::consts::TAU;

use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DMat3, DQuat, DVec3, Length, ops};

use crate::limb::RigidFrame;

/// Placement with optional components; an absent one keeps its present value. Positions in metres,
/// figure axes (world for the whole figure); angles in radians: yaw about y, then pitch about x,
/// then roll about z, each in the rotated axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// x, y and z.
    pub position: [Option<f64>; 3],
    /// Yaw, pitch and roll.
    pub angles: [Option<f64>; 3],
}

impl Placement {
    fn position_or(&self, other: DVec3) -> DVec3 {
        let [x, y, z] = self.position;
        DVec3::new(
            x.unwrap_or(other.x),
            y.unwrap_or(other.y),
            z.unwrap_or(other.z),
        )
    }

    fn angles_or(&self, other: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.angles;
        [
            a.unwrap_or(other[0]),
            b.unwrap_or(other[1]),
            c.unwrap_or(other[2]),
        ]
    }
}

/// Returns the rotation of yaw, pitch and roll, radians.
#[must_use]
pub fn rotation_from([yaw, pitch, roll]: [f64; 3]) -> DQuat {
    DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch) * DQuat::from_rotation_z(roll)
}

/// Returns the rotation of pitch and roll.
fn tilt_of([_, pitch, roll]: [f64; 3]) -> DQuat {
    rotation_from([0.0, pitch, roll])
}

/// Returns yaw, pitch and roll of a rotation, radians, with the pitch in −π/2..π/2.
#[must_use]
pub fn angles_of(rotation: DQuat) -> [f64; 3] {
    let m = DMat3::from_quat(rotation);
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let level = (z.x * z.x + z.z * z.z).sqrt();
    let pitch = ops::atan2(-z.y, level);
    if level > 1e-9 {
        [ops::atan2(z.x, z.z), pitch, ops::atan2(x.y, y.y)]
    } else {
        [0.0, pitch, ops::atan2(-y.x, x.x)]
    }
}

/// Geometric shape of a path: line, wave, Bézier or Hermite curve, ellipse or helix, or lemniscate.
#[derive(Clone, Debug, PartialEq)]
pub enum PathShape {
    /// A straight line.
    Segment,
    /// A straight line with a wave across it.
    Sinusoid {
        /// Height of the wave and its direction, metres.
        across: DVec3,
        /// Number of waves along the path.
        cycles: f64,
    },
    /// A cubic Bézier curve.
    Bezier {
        /// The two inner control points.
        controls: [Placement; 2],
    },
    /// A cubic Hermite curve.
    Hermite {
        /// Velocities at its ends, metres in one period.
        tangents: [DVec3; 2],
    },
    /// A circle, an ellipse or, with a rise, a helix.
    Round {
        /// Centre of the ellipse.
        centre: Placement,
        /// Direction that its plane faces; any length, the front where it is zero.
        normal: DVec3,
        /// Half axes of the ellipse in its plane, sideways and upwards, metres.
        radii: [f64; 2],
        /// Angle at which it starts, from sideways (the figure's left when the plane faces
        /// the front) upwards, radians.
        from_rad: f64,
        /// Revolutions in one period; negative reverses the direction.
        turns: f64,
        /// Displacement along the normal in one period, metres.
        rise: f64,
    },
    /// Bernoulli's lemniscate, a lying eight.
    Lemniscate {
        /// Centre of the lemniscate.
        centre: Placement,
        /// Direction that its plane faces, as above.
        normal: DVec3,
        /// Distance from the centre to either end, metres.
        half_width: f64,
        /// Rotation about the normal, radians.
        tilt_rad: f64,
        /// Rounds in one period.
        turns: f64,
    },
}

/// Scripted path of a limb or of the whole figure as a function of time; components left open use
/// the present place.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Geometric shape of the path.
    pub shape: PathShape,
    /// Start; `None` is the present place of the limb. Round shapes use the angles only.
    pub from: Placement,
    /// End; `None` repeats the start.
    pub to: Placement,
    /// Duration of one pass, seconds.
    pub period_secs: f64,
    /// True if it repeats after its period.
    pub looping: bool,
}

#[derive(Clone, Debug)]
enum PathGeometry {
    /// Bézier control points, a wave across and its number.
    Cubic([DVec3; 4], DVec3, f64),
    /// Centre, the two half axes, the displacement along the normal, first angle and revolutions.
    Round([DVec3; 4], f64, f64),
    /// Centre and the two half axes, rounds.
    Eight([DVec3; 3], f64),
}

impl PathGeometry {
    fn position_at(&self, share: f64) -> DVec3 {
        match self {
            Self::Cubic([a, b, c, d], across, cycles) => {
                let (s, r) = (share, 1.0 - share);
                let on = *a * (r * r * r)
                    + *b * (3.0 * r * r * s)
                    + *c * (3.0 * r * s * s)
                    + *d * (s * s * s);
                on + *across * ops::sin(TAU * cycles * s)
            }
            Self::Round([centre, u, v, rise], from, turns) => {
                let (s, c) = ops::sincos(from + TAU * turns * share);
                *centre + *u * c + *v * s + *rise * share
            }
            Self::Eight([centre, u, v], turns) => {
                let (s, c) = ops::sincos(TAU * turns * share);
                let scale = 1.0 / (1.0 + s * s);
                *centre + *u * (c * scale) + *v * (s * c * scale)
            }
        }
    }
}

/// Sideways and upwards in the plane that faces a direction, and that direction; unit.
fn plane(normal: DVec3) -> [DVec3; 3] {
    let n = normal.try_normalized().unwrap_or(DVec3::Z);
    let u = DVec3::Y.cross(n).try_normalized().unwrap_or(DVec3::X);
    [u, n.cross(u), n]
}

/// Time in which a curve gathers speed, seconds, and the most of its period.
const GATHER_SECS: f64 = 0.3;
const GATHER_SHARE: f64 = 1.0 / 3.0;
/// Fastest that a limb hurries to a curve that begins elsewhere: mean speed, m/s and rad/s.
/// Designed: a quick reach has some 1 m/s.
const HURRY_M_PER_S: f64 = 0.9;
const HURRY_RAD_PER_S: f64 = 3.0;

/// Peak speed of [`eased`] to its mean.
const EASED_PEAK: f64 = 4.0 / 3.0;
/// Maximum turn rate of a figure along its path, radians per second: one and a half revolutions per
/// second, as in a dancer's pirouette.
pub const MAX_TURN_RAD_PER_S: f64 = 1.5 * TAU;

/// Path with its open components filled in from the start position, ready to be sampled.
#[derive(Clone, Debug)]
pub struct TimedPath {
    form: PathGeometry,
    from_angles: [f64; 3],
    to_angles: [f64; 3],
    /// True to turn by the yaw, including full revolutions; false to take the shortest way.
    by_angles: bool,
    period_secs: f64,
    looping: bool,
    /// Offset from the start of the path to the initial place of the limb; it decays.
    lag: OffsetDecay,
    /// Offset from the start of the path to its end, made up in the next round of a loop.
    seam: OffsetDecay,
}

/// A difference that is made up in some time.
#[derive(Clone, Copy, Debug)]
struct OffsetDecay {
    position: DVec3,
    rotation: DQuat,
    secs: f64,
}

impl OffsetDecay {
    fn between(from: &RigidFrame, to: &RigidFrame, most_secs: f64) -> Self {
        let position = to.position - from.position;
        let rotation = (to.rotation * from.rotation.inverse()).normalized();
        let turn = rotation.angle_between(DQuat::IDENTITY);
        let secs = (position.magnitude() / HURRY_M_PER_S).max(turn / HURRY_RAD_PER_S);
        Self {
            position,
            rotation,
            secs: secs.min(most_secs),
        }
    }

    fn left(&self, frame: RigidFrame, secs: f64) -> RigidFrame {
        if self.secs <= 0.0 || secs >= self.secs {
            return frame;
        }
        let left = 1.0 - minimum_jerk(secs / self.secs);
        RigidFrame {
            position: frame.position + self.position * left,
            rotation: (DQuat::IDENTITY.slerp(self.rotation, left) * frame.rotation).normalized(),
        }
    }
}

impl PathGeometry {
    /// Returns the geometry of a path for a limb or figure that is at `now`.
    fn new(path: &Path, now: &RigidFrame) -> Self {
        let start = path.from.position_or(now.position);
        let end = path.to.position_or(start);
        match &path.shape {
            PathShape::Segment => cubic(start, end, DVec3::ZERO, 0.0),
            PathShape::Sinusoid { across, cycles } => cubic(start, end, *across, *cycles),
            PathShape::Bezier { controls } => {
                let [b, c] = [controls[0].position_or(start), controls[1].position_or(end)];
                PathGeometry::Cubic([start, b, c, end], DVec3::ZERO, 0.0)
            }
            PathShape::Hermite { tangents } => {
                let [b, c] = [start + tangents[0] / 3.0, end - tangents[1] / 3.0];
                PathGeometry::Cubic([start, b, c, end], DVec3::ZERO, 0.0)
            }
            PathShape::Round {
                centre,
                normal,
                radii,
                from_rad,
                turns,
                rise,
            } => {
                let [u, v, n] = plane(*normal);
                let (u, v) = (u * radii[0], v * radii[1]);
                let (s, c) = ops::sincos(*from_rad);
                let own = centre.position_or(now.position - u * c - v * s);
                PathGeometry::Round([own, u, v, n * *rise], *from_rad, *turns)
            }
            PathShape::Lemniscate {
                centre,
                normal,
                half_width,
                tilt_rad,
                turns,
            } => {
                let [u, v, n] = plane(*normal);
                let tilt = DQuat::from_axis_angle(n, *tilt_rad);
                let (u, v) = (tilt * u * *half_width, tilt * v * *half_width);
                let own = centre.position_or(now.position - u);
                PathGeometry::Eight([own, u, v], *turns)
            }
        }
    }
}

impl TimedPath {
    /// Fills in open components of a path from the current place of the limb or figure. `by_angles`
    /// turns by the yaw from start to end, including full revolutions, as a figure may, and tilts
    /// the shortest way; it takes longer than its period where it would turn faster than
    /// [`MAX_TURN_RAD_PER_S`]. Without it all rotations take the shortest way, as for a hand.
    #[must_use]
    pub fn new(path: &Path, now: &RigidFrame, by_angles: bool) -> Self {
        let now_angles = angles_of(now.rotation);
        let form = PathGeometry::new(path, now);
        let from_angles = path.from.angles_or(now_angles);
        let none = OffsetDecay {
            position: DVec3::ZERO,
            rotation: DQuat::IDENTITY,
            secs: 0.0,
        };
        let mut curve = Self {
            form,
            from_angles,
            to_angles: path.to.angles_or(from_angles),
            by_angles,
            period_secs: path.period_secs.max(0.0),
            looping: path.looping && path.period_secs > 0.0,
            lag: none,
            seam: none,
        };
        if by_angles {
            let (from, to) = (curve.from_angles, curve.to_angles);
            let tilt = tilt_of(from).angle_between(tilt_of(to));
            let turn = (to[0] - from[0]).abs() + tilt;
            let least_secs = EASED_PEAK * turn / MAX_TURN_RAD_PER_S;
            curve.period_secs = curve.period_secs.max(least_secs);
        }
        let (first, last) = (curve.on_form(0.0), curve.on_form(1.0));
        if by_angles && curve.looping {
            // Time to turn back in half a round.
            let back = first.rotation.angle_between(last.rotation);
            curve.period_secs = curve.period_secs.max(2.0 * back / HURRY_RAD_PER_S);
        }
        let most = if curve.looping {
            0.5 * curve.period_secs
        } else {
            f64::INFINITY
        };
        curve.lag = OffsetDecay::between(&first, now, f64::INFINITY);
        curve.seam = OffsetDecay::between(&first, &last, most);
        curve
    }

    /// Returns position and orientation at the start of the path.
    #[must_use]
    pub fn start(&self) -> RigidFrame {
        self.on_form(0.0)
    }

    fn on_form(&self, share: f64) -> RigidFrame {
        let (from, to) = (self.from_angles, self.to_angles);
        let rotation = if self.by_angles {
            // The tilt takes the shortest rotation; interpolating its two angles separately would
            // not.
            let [from_tilt, to_tilt] = [from, to].map(tilt_of);
            let yaw = DQuat::from_rotation_y(lerp(from[0], to[0], share));
            (yaw * from_tilt.slerp(to_tilt, share)).normalized()
        } else {
            let (from, to) = (rotation_from(from), rotation_from(to));
            from.slerp(to, share).normalized()
        };
        RigidFrame {
            position: self.form.position_at(share),
            rotation,
        }
    }

    /// Returns the duration, including the approach to its start, seconds; infinite in a loop.
    #[must_use]
    pub fn secs(&self) -> f64 {
        if self.looping {
            f64::INFINITY
        } else {
            self.period_secs.max(self.lag.secs)
        }
    }

    /// Returns position and orientation of the path `secs` after the start of the motion.
    #[must_use]
    pub fn sample(&self, secs: f64) -> RigidFrame {
        let secs = secs.max(0.0);
        let period = self.period_secs;
        if period <= 0.0 {
            return self.lag.left(self.on_form(1.0), secs);
        }
        let gather = GATHER_SECS.min(GATHER_SHARE * period);
        let frame = if self.looping {
            let run = eased(secs, gather);
            let round = (run / period).floor();
            let within = run - round * period;
            let frame = self.on_form(within / period);
            if round > 0.0 {
                self.seam.left(frame, within)
            } else {
                frame
            }
        } else {
            let run = eased(secs.min(period), gather);
            let run = period - eased(period - run, gather);
            self.on_form(run / period)
        };
        self.lag.left(frame, secs)
    }
}

fn cubic(start: DVec3, end: DVec3, across: DVec3, cycles: f64) -> PathGeometry {
    let [b, c] = [start.lerp(end, 1.0 / 3.0), start.lerp(end, 2.0 / 3.0)];
    PathGeometry::Cubic([start, b, c, end], across, cycles)
}

/// Returns time that starts with zero speed and catches up with `secs` after `gather` seconds.
fn eased(secs: f64, gather: f64) -> f64 {
    let s = secs / gather;
    if s >= 1.0 || gather <= 0.0 {
        secs
    } else {
        gather * s * s * (2.0 - s)
    }
}

#[cfg(test)]
mod tests;

//! What one limb does over time: its commands as segments, each beginning where the one
//! before has brought the limb.

use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DAffine3, DQuat, DVec3};

use super::aim::Aim;
use super::between;
use super::path::Curve;
use crate::limb::solve::AT_EASE;
use crate::limb::swivel::Preference;
use crate::limb::{Frame, Joints};

/// Time in which a limb that is stopped comes to rest, seconds. Designed: as fast as muscles
/// brake.
pub(super) const BRAKE_SECS: f64 = 0.2;
/// Time in which elbow and girdle take their own way again after a change of motion, seconds.
pub(super) const SETTLE_SECS: f64 = 0.6;
/// Time in which a limb is given back, seconds.
const RELEASE_SECS: f64 = 0.5;
/// Time in which limits and the girdle's own motion set in, seconds.
const SET_IN_SECS: f64 = 0.4;
/// Time that gathering and losing speed takes at a given joint speed, seconds.
const RAMP_SECS: f64 = 0.2;

/// A limb held by its joints.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Held {
    pub(super) joints: Joints,
    /// The wrist as the girdle is to take it, trunk axes, metres.
    pub(super) cue: DVec3,
    /// Lean of the spine that the limb asks for, rotation vector.
    pub(super) lean: DVec3,
    /// What it asks for more because the other arm leans the spine away from it.
    pub(super) help: DVec3,
}

impl Held {
    /// The wrist as the girdle is to take it on a trunk for what is aimed at, trunk axes, metres.
    pub(super) fn cued(&self, aim: Option<&Aim>, trunk: &DAffine3) -> DVec3 {
        self.cue + aim.map_or(DVec3::ZERO, |aim| aim.moved_on(trunk))
    }

    fn toward(&self, to: &Self, share: f64) -> Self {
        Self {
            joints: between(&self.joints, &to.joints, share),
            cue: self.cue.lerp(to.cue, share),
            lean: self.lean.lerp(to.lean, share),
            help: self.help.lerp(to.help, share),
        }
    }
}

/// What a limb is to do at one moment.
#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "goals are made at every evaluation, which allocates nothing"
)]
pub(super) enum Goal {
    /// Joints as they are given, and where they are to bring the end, if that is said.
    Joints(Held, Option<Aim>),
    /// The end in a place.
    Frame {
        frame: Frame,
        /// How far elbow or knee are turned from their natural way, radians.
        swivel_rad: f64,
        /// What the girdle's cue is off the target, trunk axes, metres.
        cue_lag: DVec3,
        /// What the spine's lean is off what the target asks for, rotation vector: its own, and
        /// what it asks for more because of the other arm.
        lean_lag: [DVec3; 2],
    },
}

/// How a segment moves.
#[derive(Clone, Debug)]
pub(super) enum MotionKind {
    /// Joint angles, with minimum jerk or at an even speed.
    Joints {
        from: Held,
        to: Held,
        /// Where `to` is to bring the end; none where the angles themselves are asked for.
        aim: Option<Box<Aim>>,
        secs: f64,
        even: bool,
    },
    /// Joint angles from its beginning on.
    Cut(Held),
    /// A straight line with the shortest turn.
    Line { from: Frame, to: Frame, secs: f64 },
    /// A function of time.
    Curve(Curve),
    /// Joint angles at even steps, and where they bring the end.
    Samples {
        steps: Vec<(Held, Aim)>,
        step_secs: f64,
        /// The target that they are on the way to, if there is one.
        to: Option<Box<Frame>>,
    },
    /// A place in the world.
    Lock(Frame),
}

impl MotionKind {
    /// How long it moves, seconds; infinite for a loop.
    fn secs(&self) -> f64 {
        match self {
            Self::Joints { secs, .. } | Self::Line { secs, .. } => *secs,
            Self::Curve(curve) => curve.secs(),
            Self::Samples {
                steps, step_secs, ..
            } => steps.len() as f64 * step_secs,
            Self::Cut(_) | Self::Lock(_) => 0.0,
        }
    }
}

/// A motion from where the limb was.
#[derive(Clone, Debug)]
pub(super) struct LimbMotion {
    pub(super) kind: MotionKind,
    /// Where elbow or knee were turned at its beginning, radians from their natural way.
    pub(super) swivel_rad: f64,
    /// What the girdle's cue was off the place, trunk axes, metres.
    pub(super) cue_lag: DVec3,
    /// The spine's lean minus the target's, rotation vector: its own, and what it asked for more
    /// because of the other arm.
    pub(super) lean_lag: [DVec3; 2],
    /// What its joints were off, radians, and its upper bone, base axes.
    pub(super) mend: Mend,
}

/// What joints are off from where they are to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mend {
    /// Each joint, radians; of limbs those of the shoulder or hip are 0.
    pub(super) joints: Joints,
    /// The turn of the upper bone of a limb, which has two sets of angles.
    pub(super) upper: DQuat,
}

impl Default for Mend {
    fn default() -> Self {
        Self {
            joints: Joints::default(),
            upper: DQuat::IDENTITY,
        }
    }
}

/// A course from a time on.
#[derive(Clone, Copy, Debug)]
struct Segment {
    start_secs: f64,
    /// Which course.
    course: usize,
    /// Its time at the segment's beginning, seconds.
    from_secs: f64,
    /// Whether it comes to rest from there.
    brakes: bool,
}

impl Segment {
    /// The time of its course at a time, seconds.
    fn run(&self, time_secs: f64) -> f64 {
        let since = time_secs - self.start_secs;
        self.from_secs
            + if !self.brakes {
                since
            } else if since < BRAKE_SECS {
                since - since * since / (2.0 * BRAKE_SECS)
            } else {
                0.5 * BRAKE_SECS
            }
    }
}

/// A switch thrown at a time.
#[derive(Clone, Copy, Debug)]
struct Switch {
    time_secs: f64,
    on: bool,
    /// How much it was on just before, 0 to 1.
    before: f64,
}

impl Switch {
    fn at(&self, time_secs: f64, secs: f64) -> f64 {
        let to = f64::from(u8::from(self.on));
        lerp(
            self.before,
            to,
            minimum_jerk((time_secs - self.time_secs) / secs),
        )
    }
}

/// The last switch up to a time.
fn last(switches: &[Switch], time_secs: f64) -> Option<&Switch> {
    let thrown = switches.partition_point(|s| s.time_secs <= time_secs);
    switches.get(thrown.checked_sub(1)?)
}

/// The commands of one limb.
#[derive(Clone, Debug, Default)]
pub(super) struct LimbTrack {
    motions: Vec<LimbMotion>,
    segments: Vec<Segment>,
    control: Vec<Switch>,
    limits: Vec<Switch>,
    /// Joint angles that are preferred from a time on; none: those at ease.
    preferred: Vec<(f64, Option<Joints>)>,
    /// Whether control sets in by and by.
    sets_in: bool,
}

impl LimbTrack {
    /// The track of a limb whose joints are not all of those of its bones, so that no motion
    /// can begin quite where it is: control sets in by and by.
    pub(super) fn setting_in() -> Self {
        Self {
            sets_in: true,
            ..Self::default()
        }
    }

    /// How far the limb is under control at a time, 0 to 1. It is at once when a motion
    /// begins, since that begins where the limb is, unless it can't.
    pub(super) fn weight(&self, time_secs: f64) -> f64 {
        match last(&self.control, time_secs) {
            None => 0.0,
            Some(s) if s.on && !self.sets_in => 1.0,
            Some(s) if s.on => s.at(time_secs, SET_IN_SECS),
            Some(s) => s.at(time_secs, RELEASE_SECS),
        }
    }

    /// How far girdle and limits have set in, 0 to 1.
    pub(super) fn set_in(&self, time_secs: f64) -> f64 {
        match last(&self.control, time_secs) {
            None => 0.0,
            Some(s) if s.on => s.at(time_secs, SET_IN_SECS),
            Some(_) => 1.0,
        }
    }

    /// How much joint limits count, 0 to 1.
    pub(super) fn limited(&self, time_secs: f64) -> f64 {
        last(&self.limits, time_secs).map_or(1.0, |s| s.at(time_secs, SET_IN_SECS))
    }

    /// Whether a motion is in control, or the limb was given back.
    pub(super) fn in_control(&self) -> bool {
        self.control.last().is_some_and(|s| s.on)
    }

    /// Takes control, or gives the limb back.
    pub(super) fn switch_control(&mut self, time_secs: f64, on: bool) {
        if self.in_control() != on {
            let before = self.weight(time_secs);
            self.control.push(Switch {
                time_secs,
                on,
                before,
            });
        }
    }

    /// Takes control all at once, whatever the limb did before.
    pub(super) fn cut_control(&mut self, time_secs: f64) {
        self.control.push(Switch {
            time_secs,
            on: true,
            before: 1.0,
        });
    }

    /// A time, or the last one up to `now_secs` when the limb came under control, whichever is
    /// later.
    pub(super) fn begun_by(&self, now_secs: f64, time_secs: f64) -> f64 {
        let mut thrown = self.control.iter().rev();
        let begun = thrown.find(|s| s.on && s.time_secs <= now_secs);
        begun.map_or(time_secs, |s| time_secs.max(s.time_secs))
    }

    /// What joints still are off at a time from where they were at the beginning of their
    /// course; none once that is made up for.
    pub(super) fn mend(&self, time_secs: f64) -> Option<Mend> {
        let segment = self.segment(time_secs)?;
        let mend = &self.motions[segment.course].mend;
        let left = 1.0 - minimum_jerk(segment.run(time_secs) / SETTLE_SECS);
        (left > 0.0).then(|| Mend {
            joints: mend.joints.map(|off| left * off),
            upper: DQuat::IDENTITY.slerp(mend.upper, left),
        })
    }

    /// Lets the last course begin with its elbow or knee off by so much, radians.
    pub(super) fn swivel_last(&mut self, off_rad: f64) {
        if let Some(course) = self.motions.last_mut() {
            course.swivel_rad = off_rad;
        }
    }

    /// Lets the last course begin with its joints off by so much.
    pub(super) fn mend_last(&mut self, off: Mend) {
        if let Some(course) = self.motions.last_mut() {
            course.mend = off;
        }
    }

    /// Turns joint limits on or off.
    pub(super) fn switch_limits(&mut self, time_secs: f64, on: bool) {
        let before = self.limited(time_secs);
        self.limits.push(Switch {
            time_secs,
            on,
            before,
        });
    }

    /// Prefers solutions near angles of the first joints, radians; near none if there are none.
    pub(super) fn prefer(&mut self, time_secs: f64, angles_rad: &[f64]) {
        let mut joints = AT_EASE;
        for (joint, angle) in joints.iter_mut().zip(angles_rad) {
            *joint = *angle;
        }
        let is_said = !angles_rad.is_empty();
        self.preferred.push((time_secs, is_said.then_some(joints)));
    }

    /// The preference at a time; elbow or knee take their new way as slowly as after a
    /// change of motion.
    pub(super) fn preference(&self, time_secs: f64) -> Preference {
        let said = self.preferred.partition_point(|(t, _)| *t <= time_secs);
        let nth = |i: Option<usize>| i.and_then(|i| self.preferred.get(i));
        let Some((since, now)) = nth(said.checked_sub(1)) else {
            return Preference::default();
        };
        let before = nth(said.checked_sub(2)).and_then(|(_, joints)| *joints);
        let share = minimum_jerk((time_secs - since) / SETTLE_SECS);
        Preference([(before, 1.0 - share), (*now, share)])
    }

    /// Whether limits were last turned on.
    pub(super) fn has_limits(&self) -> bool {
        self.limits.last().is_none_or(|s| s.on)
    }

    /// The segment that is on at a time.
    fn segment(&self, time_secs: f64) -> Option<Segment> {
        let begun = self.segments.partition_point(|s| s.start_secs <= time_secs);
        self.segments.get(begun.checked_sub(1)?).copied()
    }

    /// Begins a course at a time, not before that of the last one.
    pub(super) fn begin(&mut self, time_secs: f64, course: LimbMotion) {
        self.segments.push(Segment {
            start_secs: time_secs,
            course: self.motions.len(),
            from_secs: 0.0,
            brakes: false,
        });
        self.motions.push(course);
    }

    /// Stops the motion that is on at a time; what has stopped stays.
    pub(super) fn brake(&mut self, time_secs: f64) {
        if let Some(on) = self.segment(time_secs).filter(|s| !s.brakes) {
            self.segments.push(Segment {
                start_secs: time_secs,
                course: on.course,
                from_secs: time_secs - on.start_secs,
                brakes: true,
            });
        }
    }

    /// How long after a time the limb still moves by itself, seconds; infinite for a loop.
    pub(super) fn rests_after_secs(&self, time_secs: f64) -> f64 {
        let Some(segment) = self.segment(time_secs) else {
            return 0.0;
        };
        let left = if segment.brakes {
            BRAKE_SECS
        } else {
            self.motions[segment.course].kind.secs() - segment.run(time_secs)
        };
        left.max(0.0) + SETTLE_SECS
    }

    /// Whether the end is locked to a place from some time before this one.
    pub(super) fn is_locked(&self, time_secs: f64) -> bool {
        let on = self.segment(time_secs);
        on.is_some_and(|s| matches!(self.motions[s.course].kind, MotionKind::Lock(_)))
    }

    /// What the limb is to do at a time; `figure_from_world` at that time. None before the
    /// first motion.
    pub(super) fn goal(&self, time_secs: f64, figure_from_world: &DAffine3) -> Option<Goal> {
        let segment = self.segment(time_secs)?;
        let course = &self.motions[segment.course];
        Some(course.goal(segment.run(time_secs), figure_from_world))
    }
}

impl LimbMotion {
    fn goal(&self, secs: f64, figure_from_world: &DAffine3) -> Goal {
        let frame = match &self.kind {
            MotionKind::Joints {
                from,
                to,
                aim,
                secs: whole,
                even,
            } => {
                let share = if *even {
                    evenly(secs, *whole)
                } else {
                    minimum_jerk(secs / whole.max(1e-9))
                };
                let aim = aim.as_ref().map(|aim| aim.counting(share, aim.frame));
                return Goal::Joints(from.toward(to, share), aim);
            }
            MotionKind::Cut(held) => return Goal::Joints(*held, None),
            MotionKind::Samples {
                steps,
                step_secs,
                to,
            } => {
                let last = steps.len().saturating_sub(1);
                let at = (secs / step_secs).clamp(0.0, last as f64);
                let index = at.floor() as usize;
                let ((a, aim), (b, next)) = (&steps[index], &steps[(index + 1).min(last)]);
                let share = at - index as f64;
                // Velocities lead the joints, and to no place.
                let aim = to.as_ref().map(|to| {
                    let aim = aim.toward(next, share);
                    // It begins where the limb is, whatever led it there.
                    let counts = minimum_jerk(secs / SETTLE_SECS);
                    let is_over = at >= last as f64;
                    let target = if is_over { **to } else { aim.frame };
                    aim.counting(counts, target)
                });
                return Goal::Joints(a.toward(b, share), aim);
            }
            MotionKind::Line {
                from,
                to,
                secs: whole,
            } => from.toward(to, minimum_jerk(secs / whole.max(1e-9))),
            MotionKind::Curve(curve) => curve.at(secs),
            MotionKind::Lock(frame) => frame.moved(figure_from_world),
        };
        let left = 1.0 - minimum_jerk(secs / SETTLE_SECS);
        Goal::Frame {
            frame,
            swivel_rad: self.swivel_rad * left,
            cue_lag: self.cue_lag * left,
            lean_lag: self.lean_lag.map(|lag| lag * left),
        }
    }
}

/// Share of a way gone at an even speed, with time added at both ends to gather and lose it:
/// [`even_secs`] is the whole.
fn evenly(secs: f64, whole: f64) -> f64 {
    let ramp = RAMP_SECS.min(0.5 * whole);
    if ramp <= 0.0 {
        return f64::from(u8::from(secs > 0.0));
    }
    // The integral of a smooth ramp of speed from 0 to 1.
    let gathered = |s: f64| {
        let s = s.clamp(0.0, 1.0);
        s * s * s * (1.0 - 0.5 * s)
    };
    let secs = secs.clamp(0.0, whole);
    let first = ramp * gathered(secs / ramp);
    let last = ramp * gathered((whole - secs) / ramp);
    let cruise = (secs.min(whole - ramp) - ramp).max(0.0);
    let way = if secs < whole - ramp {
        first + cruise
    } else {
        whole - ramp - last
    };
    way / (whole - ramp)
}

/// Time that a way of `rad` takes at an even speed of `rad_per_sec`, seconds.
pub(super) fn even_secs(rad: f64, rad_per_sec: f64) -> f64 {
    let cruise = rad / rad_per_sec;
    // A short way never comes to its speed.
    cruise + RAMP_SECS.min(cruise)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_way_is_even_and_smooth_at_its_ends() {
        let whole = even_secs(3.0, 1.5);
        assert!((whole - 2.2).abs() < 1e-12);
        let h = 1e-4;
        let speed = |t: f64| 3.0 * (evenly(t + h, whole) - evenly(t - h, whole)) / (2.0 * h);
        for i in 0..100 {
            let t = 0.25 + 1.7 * f64::from(i) / 100.0;
            assert!((speed(t) - 1.5).abs() < 1e-6, "{t}: {}", speed(t));
        }
        assert!(speed(0.01) < 0.1 && speed(whole - 0.01) < 0.1);
        assert_eq!(evenly(0.0, whole), 0.0);
        assert!((evenly(whole, whole) - 1.0).abs() < 1e-12);
        // Ways shorter than the ramps keep below the speed.
        let short = even_secs(0.1, 1.5);
        assert!((evenly(short, short) - 1.0).abs() < 1e-12);
        let step = (evenly(0.51 * short, short) - evenly(0.49 * short, short)) * 0.1;
        assert!(step / (0.02 * short) < 1.6);
    }
}

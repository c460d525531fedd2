//! Commands of one limb over time as segments, each starting at the end state of the previous one.

use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DAffine3, DQuat};

use super::motion::{JointCorrection, LimbMotion, MotionGoal, MotionKind, SETTLE_SECS};
use crate::limb::Joints;
use crate::limb::solve::AT_EASE;
use crate::limb::swivel::JointPreference;

/// Braking time of a stopped limb, seconds. Designed: as fast as muscles brake.
pub(super) const BRAKE_SECS: f64 = 0.2;
/// Release time of a limb, seconds.
const RELEASE_SECS: f64 = 0.5;
/// Time in which limits and the girdle's own motion set in, seconds.
const SET_IN_SECS: f64 = 0.4;
/// A course from a time on.
#[derive(Clone, Copy, Debug)]
struct TrackSegment {
    start_secs: f64,
    /// Index of the course.
    course: usize,
    /// Time on the motion's own clock at the start of the segment, seconds.
    from_secs: f64,
    /// True if it comes to rest from there.
    brakes: bool,
}

impl TrackSegment {
    /// Returns the time on the motion's own clock at a story time, seconds.
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
    /// Weight just before, 0 to 1.
    before: f64,
}

impl Switch {
    fn weight_at(&self, time_secs: f64, secs: f64) -> f64 {
        let to = f64::from(u8::from(self.on));
        lerp(
            self.before,
            to,
            minimum_jerk((time_secs - self.time_secs) / secs),
        )
    }
}

/// Returns the last switch at or before a time; `None` before the first.
fn last(switches: &[Switch], time_secs: f64) -> Option<&Switch> {
    let thrown = switches.partition_point(|s| s.time_secs <= time_secs);
    switches.get(thrown.checked_sub(1)?)
}

/// Compiled commands of one limb over the story: motions, segments, and switches of control and
/// limits.
#[derive(Clone, Debug, Default)]
pub(super) struct LimbTrack {
    motions: Vec<LimbMotion>,
    segments: Vec<TrackSegment>,
    control: Vec<Switch>,
    limits: Vec<Switch>,
    /// Preferred joint angles from a time on; `None` prefers those at ease.
    preferred: Vec<(f64, Option<Joints>)>,
    /// True if control sets in gradually.
    sets_in: bool,
}

impl LimbTrack {
    /// Creates the track of a limb whose joints do not cover all of its bones, so no motion can
    /// begin exactly at its present pose: control sets in gradually.
    pub(super) fn setting_in() -> Self {
        Self {
            sets_in: true,
            ..Self::default()
        }
    }

    /// Returns the degree of control of the limb at a time, 0 to 1. It is 1 immediately when a
    /// motion begins at the limb's present pose, else it grows gradually.
    pub(super) fn weight(&self, time_secs: f64) -> f64 {
        match last(&self.control, time_secs) {
            None => 0.0,
            Some(s) if s.on && !self.sets_in => 1.0,
            Some(s) if s.on => s.weight_at(time_secs, SET_IN_SECS),
            Some(s) => s.weight_at(time_secs, RELEASE_SECS),
        }
    }

    /// Returns the degree to which girdle and limits have set in, 0 to 1.
    pub(super) fn set_in(&self, time_secs: f64) -> f64 {
        match last(&self.control, time_secs) {
            None => 0.0,
            Some(s) if s.on => s.weight_at(time_secs, SET_IN_SECS),
            Some(_) => 1.0,
        }
    }

    /// Returns the weight of the joint limits, 0 to 1.
    pub(super) fn limited(&self, time_secs: f64) -> f64 {
        last(&self.limits, time_secs).map_or(1.0, |s| s.weight_at(time_secs, SET_IN_SECS))
    }

    /// Returns true if a motion is in control; false after the limb was released.
    pub(super) fn in_control(&self) -> bool {
        self.control.last().is_some_and(|s| s.on)
    }

    /// Takes control, or releases the limb.
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

    /// Takes control immediately, whatever the limb did before.
    pub(super) fn cut_control(&mut self, time_secs: f64) {
        self.control.push(Switch {
            time_secs,
            on: true,
            before: 1.0,
        });
    }

    /// Returns a time, or the last time up to `now_secs` when the limb came under control,
    /// whichever is later.
    pub(super) fn begun_by(&self, now_secs: f64, time_secs: f64) -> f64 {
        let mut thrown = self.control.iter().rev();
        let begun = thrown.find(|s| s.on && s.time_secs <= now_secs);
        begun.map_or(time_secs, |s| time_secs.max(s.time_secs))
    }

    /// Returns the remaining joint offset at a time from the start of the course; `None` once it is
    /// corrected.
    pub(super) fn correct_start(&self, time_secs: f64) -> Option<JointCorrection> {
        let segment = self.segment(time_secs)?;
        let mend = &self.motions[segment.course].mend;
        let left = 1.0 - minimum_jerk(segment.run(time_secs) / SETTLE_SECS);
        (left > 0.0).then(|| JointCorrection {
            joints: mend.joints.map(|off| left * off),
            upper: DQuat::IDENTITY.slerp(mend.upper, left),
        })
    }

    /// Starts the last course with an elbow or knee offset, radians.
    pub(super) fn swivel_last(&mut self, off_rad: f64) {
        if let Some(course) = self.motions.last_mut() {
            course.swivel_rad = off_rad;
        }
    }

    /// Starts the last course with a joint offset.
    pub(super) fn correct_last(&mut self, off: JointCorrection) {
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

    /// Prefers solutions near angles of the first joints, radians; an empty list removes the
    /// preference.
    pub(super) fn prefer(&mut self, time_secs: f64, angles_rad: &[f64]) {
        let mut joints = AT_EASE;
        for (joint, angle) in joints.iter_mut().zip(angles_rad) {
            *joint = *angle;
        }
        let is_said = !angles_rad.is_empty();
        self.preferred.push((time_secs, is_said.then_some(joints)));
    }

    /// Returns the preference at a time; elbow or knee move to it as slowly as after a change of
    /// motion.
    pub(super) fn preference(&self, time_secs: f64) -> JointPreference {
        let said = self.preferred.partition_point(|(t, _)| *t <= time_secs);
        let nth = |i: Option<usize>| i.and_then(|i| self.preferred.get(i));
        let Some((since, now)) = nth(said.checked_sub(1)) else {
            return JointPreference::default();
        };
        let before = nth(said.checked_sub(2)).and_then(|(_, joints)| *joints);
        let share = minimum_jerk((time_secs - since) / SETTLE_SECS);
        JointPreference([(before, 1.0 - share), (*now, share)])
    }

    /// Returns true if limits were last turned on.
    pub(super) fn has_limits(&self) -> bool {
        self.limits.last().is_none_or(|s| s.on)
    }

    /// Returns the segment that is active at a time; `None` before the first.
    fn segment(&self, time_secs: f64) -> Option<TrackSegment> {
        let begun = self.segments.partition_point(|s| s.start_secs <= time_secs);
        self.segments.get(begun.checked_sub(1)?).copied()
    }

    /// Begins a course at a time, not before that of the last one.
    pub(super) fn begin(&mut self, time_secs: f64, course: LimbMotion) {
        self.segments.push(TrackSegment {
            start_secs: time_secs,
            course: self.motions.len(),
            from_secs: 0.0,
            brakes: false,
        });
        self.motions.push(course);
    }

    /// Stops the active motion at a time; a stopped motion stays stopped.
    pub(super) fn brake(&mut self, time_secs: f64) {
        if let Some(on) = self.segment(time_secs).filter(|s| !s.brakes) {
            self.segments.push(TrackSegment {
                start_secs: time_secs,
                course: on.course,
                from_secs: time_secs - on.start_secs,
                brakes: true,
            });
        }
    }

    /// Returns the time for which the limb still moves after a given time, seconds; infinite for a
    /// loop.
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

    /// Returns true if the end is already locked to a place at this time.
    pub(super) fn is_locked(&self, time_secs: f64) -> bool {
        let on = self.segment(time_secs);
        on.is_some_and(|s| matches!(self.motions[s.course].kind, MotionKind::Lock(_)))
    }

    /// Returns the goal of the limb at a time; `figure_from_world` at that time. `None` before the
    /// first motion.
    pub(super) fn goal(&self, time_secs: f64, figure_from_world: &DAffine3) -> Option<MotionGoal> {
        let segment = self.segment(time_secs)?;
        let course = &self.motions[segment.course];
        Some(course.goal(segment.run(time_secs), figure_from_world))
    }
}

//! Joint paths that replace a limb's target where the target alone would make the limb snap.
//!
//! Joints that depend only on the body's position and the target make play and seek equal. No such
//! choice can be continuous everywhere: the elbow's circle has no continuous direction around a
//! whole sphere, a position inside the shortest reach has two nearest solutions, and beyond the
//! limits one approximation replaces another. When a script is compiled ([`super::scan`]), every
//! limb is sampled at even times; where its joints snap or turn faster than [`MAX_RAD_PER_S`], a
//! path through the joints is recorded. Evaluation follows that record by a uniform cubic B-spline,
//! whose speed is a mean of the speeds between the even times, and the target everywhere else.

use core::f64::consts::PI;

use raconteur_base::curve::smooth;
use raconteur_base::ops;

use crate::limb::Joints;
use crate::limb::chain::{LimbRig, ROLL};
use crate::limb::solve::variation;

/// Maximum turn rate of a bone driven by a manipulator, radians per second. Human knees and elbows
/// reach 10 to 20 rad/s in fast movement without a run-up; only throws and kicks are faster (a
/// kicking knee 28 rad/s: Lees et al. 2010, doi:10.1080/02640414.2010.481305). A clause that
/// requests more arrives later.
pub const MAX_RAD_PER_S: f64 = 20.0;

/// Even times a second.
pub(super) const EVEN_HZ: f64 = 30.0;

/// Weights of the uniform cubic B-spline for the even times around a share of a step.
pub(super) fn spline(u: f64) -> [f64; 4] {
    let v = 1.0 - u;
    let (u2, u3) = (u * u, u * u * u);
    [
        v * v * v / 6.0,
        (3.0 * u3 - 6.0 * u2 + 4.0) / 6.0,
        (-3.0 * u3 + 3.0 * u2 + 3.0 * u + 1.0) / 6.0,
        u3 / 6.0,
    ]
}

/// State of a limb at one even time step: its joints, and whether they drive the limb instead of
/// the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) joints: Joints,
    /// True if the joints drive the limb there instead of the target: for the whole limb, and for
    /// its end.
    pub(super) follows_joints: [bool; 2],
}

/// Unbroken run of even time steps during which the joints of a limb are recorded, from its motion
/// until it rests.
#[derive(Clone, Debug)]
pub(super) struct Interval {
    /// The even time from which it counts.
    pub(super) from: i64,
    /// The even time of the first sample, not after `from`.
    pub(super) first: i64,
    pub(super) samples: Vec<Sample>,
    /// True if the limb rests at its end; otherwise it continues in a loop, which has not been
    /// followed farther.
    pub(super) rests: bool,
    /// Last even times at which the joints certainly drive the limb.
    pub(super) lead_to: [i64; 2],
    /// True if a command takes over the limb in it, just after `from`.
    pub(super) takes: bool,
}

/// Recorded joints that drive a limb at one time, with their weights relative to the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct SmoothedPath {
    pub(super) joints: Joints,
    /// Weights of the whole limb's joints and of its end's, 0 to 1.
    pub(super) weights: [f64; 2],
    /// Weight where the target cannot be met: a limb at rest then keeps its joints; otherwise the
    /// sway of the body would change the deviation.
    pub(super) weight_unmet: f64,
}

/// Smoothed intervals of one limb, sorted by time; avoid jumps of the joints.
#[derive(Clone, Debug, Default)]
pub(super) struct SmoothedPaths {
    pub(super) intervals: Vec<Interval>,
    /// Times at which the limb is cut to other joints, in order, seconds: no interval extends
    /// beyond them.
    pub(super) cuts_secs: Vec<f64>,
}

impl SmoothedPaths {
    /// Returns the driving joints at a time; `None` if the limb is not followed, or no joints ever
    /// drive it.
    pub(super) fn sample(&self, time_secs: f64, rig: Option<&LimbRig>) -> Option<SmoothedPath> {
        let even = (time_secs * EVEN_HZ).floor();
        let begun = self.intervals.partition_point(|s| s.from as f64 <= even);
        let on = self.intervals.get(begun.checked_sub(1)?)?;
        let cut = self.cuts_secs.partition_point(|cut| *cut <= time_secs);
        let cut = cut.checked_sub(1).and_then(|last| self.cuts_secs.get(last));
        if cut.is_some_and(|cut| on.from as f64 / EVEN_HZ <= *cut) {
            return None;
        }
        on.sample(time_secs, rig)
    }

    /// Returns true if the limb is cut to other joints between an even time and the one before it.
    pub(super) fn is_cut_before(&self, even: i64) -> bool {
        let before_secs = (even - 1) as f64 / EVEN_HZ;
        self.cuts_secs.last().is_some_and(|cut| *cut >= before_secs)
    }
}

impl Interval {
    /// Time after its end in which a limb comes to rest on its joints, in even times.
    const RESTING: f64 = 10.0;

    /// Number of samples around a driven sample that are driven too: two for the spline between two
    /// samples, and two for the joints to be driven when the target begins to snap.
    const AROUND: usize = 4;

    /// Begins at an even time.
    pub(super) fn new(from: i64, first: i64, joints: Joints) -> Self {
        Self {
            from,
            first,
            samples: vec![Sample {
                joints,
                follows_joints: [false; 2],
            }],
            rests: true,
            lead_to: [first; 2],
            takes: false,
        }
    }

    /// Appends an even time.
    pub(super) fn push(&mut self, joints: Joints, leads: [bool; 2]) {
        let next = self.next();
        let recent = self.samples.len().saturating_sub(Self::AROUND);
        for (i, _) in leads.iter().enumerate().filter(|(_, leads)| **leads) {
            for sample in &mut self.samples[recent..] {
                sample.follows_joints[i] = true;
            }
            self.lead_to[i] = next + Self::AROUND as i64;
        }
        self.samples.push(Sample {
            joints,
            follows_joints: self.lead_to.map(|to| next <= to),
        });
    }

    /// Extends the driven interval.
    pub(super) fn follow(&mut self) {
        let to = self.next() + Self::AROUND as i64;
        if let Some(last) = self.samples.last() {
            for (lead_to, leads) in self.lead_to.iter_mut().zip(last.follows_joints) {
                if leads {
                    *lead_to = to;
                }
            }
        }
    }

    /// Returns true if a command took over the limb so shortly before the next even time that
    /// joints driven there are already driven when it comes.
    pub(super) fn begins(&self) -> bool {
        self.takes && self.next() - self.from <= 2 * Self::AROUND as i64
    }

    /// Delays a limb that snaps just after a command took it over: it continues as before for the
    /// look-ahead of the spline, so it starts from its present place. Returns the last joints of
    /// that, and true if they are those of the next even time; `None` if no command took it over.
    pub(super) fn delay_snap(&mut self, rig: Option<&LimbRig>) -> Option<(Joints, bool)> {
        let taken = usize::try_from(self.from - self.first).ok()?;
        let done = self.samples.len().checked_sub(taken + 1)?;
        if !self.begins() {
            return None;
        }
        let last = self.samples[taken].joints;
        let before = nearest(&self.samples[taken.checked_sub(1)?].joints, &last, rig);
        let on = |steps: usize| {
            let mut joints = last;
            for (joint, (last, before)) in joints.iter_mut().zip(last.iter().zip(&before)) {
                *joint += steps.min(Self::AROUND) as f64 * (last - before);
            }
            joints
        };
        for (i, sample) in self.samples[taken..].iter_mut().enumerate() {
            *sample = Sample {
                joints: on(i),
                follows_joints: [true; 2],
            };
        }
        Some(if done < Self::AROUND {
            (on(done + 1), true)
        } else {
            (on(done), false)
        })
    }

    /// Returns the even time step after the last sample.
    pub(super) fn next(&self) -> i64 {
        self.first + self.samples.len() as i64
    }

    fn sample(&self, time_secs: f64, rig: Option<&LimbRig>) -> Option<SmoothedPath> {
        let at = time_secs * EVEN_HZ - self.first as f64;
        let last = self.samples.len().checked_sub(1)?;
        let after = at - last as f64;
        let weight_unmet = if self.rests {
            smooth(after / Self::RESTING)
        } else {
            0.0
        };
        // Later ones are as the last.
        let at = at.clamp(0.0, last as f64 + 2.0);
        let index = at.floor() as usize;
        let around = [0, 1, 2, 3].map(|k| (index + k).saturating_sub(1).min(last));
        let weights = spline(at - index as f64);
        let mut lead = SmoothedPath {
            joints: self.samples[around[1]].joints,
            weights: [0.0; 2],
            weight_unmet,
        };
        for (i, weight) in around.into_iter().zip(weights) {
            for (sum, leads) in lead.weights.iter_mut().zip(self.samples[i].follows_joints) {
                *sum += weight * f64::from(u8::from(leads));
            }
        }
        // A resting limb follows its target again as far as the target is reachable.
        for sum in &mut lead.weights {
            *sum *= 1.0 - weight_unmet;
        }
        if lead.weights[1] > 0.0 {
            let [a, b, c, d] = around.map(|i| &self.samples[i].joints);
            let c = nearest(c, b, rig);
            let mut a = nearest(a, b, rig);
            if index == 0 {
                // Without an earlier sample, the path starts at the first one.
                for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                    *a = 2.0 * b - c;
                }
            }
            let around = [a, *b, c, nearest(d, &c, rig)];
            lead.joints = Joints::default();
            for (joints, weight) in around.iter().zip(weights) {
                for (sum, joint) in lead.joints.iter_mut().zip(joints) {
                    *sum += weight * joint;
                }
            }
        }
        (lead.weights[1] > 0.0 || weight_unmet > 0.0).then_some(lead)
    }
}

/// Returns equivalent joints of the same bones, nearest to other joints.
pub(super) fn nearest(joints: &Joints, to: &Joints, rig: Option<&LimbRig>) -> Joints {
    let mut near = *joints;
    // The joint triple of wrist, ankle or skull has two equivalent solutions.
    let end = if let Some(rig) = rig {
        near = rig.alike(joints, to, false);
        3
    } else {
        2
    };
    let mut turned = near;
    turned[end] += PI;
    turned[end + 1] = PI - near[end + 1];
    turned[end + 2] += PI;
    if variation(&turned, to) < variation(&near, to) {
        near = turned;
    }
    for (joint, to) in near.iter_mut().zip(to) {
        *joint = to + ops::wrap_angle(*joint - to);
    }
    near
}

/// Interpolates joints by a share; joints within limits stay within.
pub(super) fn lerp_joints(from: &Joints, to: &Joints, share: f64, limited: bool) -> Joints {
    let mut joints = *from;
    for (i, (joint, to)) in joints.iter_mut().zip(to).enumerate() {
        let way = to - *joint;
        let way = if limited && i != ROLL {
            way
        } else {
            ops::wrap_angle(way)
        };
        *joint += share * way;
    }
    joints
}

//! The soft face over time: steps of the tissue behind the clock.
//!
//! The network has a state, but the picture of a time must not depend on how the clock came
//! there. So time is cut into segments, and what the network is in a segment follows from the
//! controls since a fixed moment before it, where it begins at rest under them: the
//! difference to what came before has died away long before the segment begins (to less than
//! a thousandth of a millimetre). While one segment plays, the warm-up of the next is
//! simulated a step at a time; a seek simulates at most a segment with both warm-ups, 1.2 s.

use core::mem::swap;

use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};

/// Steps of a segment, and of the warm-up before it.
const SEGMENT: i64 = 96;
const WARM_UP: i64 = 24;

/// A simulation that runs through a segment.
#[derive(Clone)]
struct SegmentRun {
    network: Network,
    segment: i64,
    /// The step it has come to.
    step: i64,
}

impl SegmentRun {
    /// Begins the warm-up of a segment.
    fn begin(&mut self, tissue: &Tissue, segment: i64, controls: &Controls<'_>) {
        self.segment = segment;
        self.step = segment * SEGMENT - WARM_UP;
        let (now, earlier) = (controls(secs(self.step)), controls(secs(self.step - 1)));
        self.network.reset(tissue, &now, &earlier);
    }

    fn advance(&mut self, tissue: &Tissue, to: i64, controls: &Controls<'_>) {
        while self.step < to {
            self.step += 1;
            self.network.step(tissue, &controls(secs(self.step)));
        }
    }
}

/// Controls of the face at a time, seconds.
type Controls<'a> = dyn Fn(f64) -> FaceControls + 'a;

fn secs(step: i64) -> f64 {
    step as f64 / Network::steps_per_s()
}

/// The tissue of one face at any time.
pub(crate) struct SoftFace {
    now: SegmentRun,
    next: SegmentRun,
}

/// A segment that no time has.
const NEVER: i64 = i64::MIN;

impl SoftFace {
    pub(crate) fn new(tissue: &Tissue) -> Self {
        let run = SegmentRun {
            network: Network::new(tissue),
            segment: NEVER,
            step: 0,
        };
        Self {
            next: run.clone(),
            now: run,
        }
    }

    /// The network as it was at the last requested step.
    pub(crate) fn network(&self) -> &Network {
        &self.now.network
    }

    /// Forgets what was simulated: the controls have changed.
    pub(crate) fn forget(&mut self) {
        self.now.segment = NEVER;
        self.next.segment = NEVER;
    }

    /// Brings the nodes to a time. `nodes` has room for all; allocates nothing.
    pub(crate) fn at(
        &mut self,
        tissue: &Tissue,
        time_secs: f64,
        controls: &Controls<'_>,
        nodes: &mut [NodeState],
    ) {
        let exact = time_secs * Network::steps_per_s();
        let step = exact.ceil() as i64;
        let share = 1.0 - (step as f64 - exact);
        let segment = step.div_euclid(SEGMENT);
        if self.now.segment != segment && self.next.segment == segment {
            swap(&mut self.now, &mut self.next);
        }
        if self.now.segment != segment || self.now.step > step {
            self.now.begin(tissue, segment, controls);
        }
        self.now.advance(tissue, step, controls);
        // The warm-up of the next segment, evenly over this one.
        if self.next.segment != segment + 1 {
            self.next.begin(tissue, segment + 1, controls);
        }
        let gone = step - segment * SEGMENT;
        let ahead = (segment + 1) * SEGMENT - WARM_UP + gone * WARM_UP / SEGMENT;
        self.next.advance(tissue, ahead, controls);
        self.now.network.write(tissue, share as f32, nodes);
    }
}

//! The soft face over time: steps of the tissue behind the clock.

use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};

use super::segments::{SegmentGrid, Segments, Simulation, WarmUpPolicy};

/// 0.8 s and 0.2 s: what came before moves no node by a thousandth of a millimetre any more.
const CUT: SegmentGrid = SegmentGrid {
    segment: 96,
    warm_up: 24,
    pace: WarmUpPolicy::Even,
};

/// Controls of the face at a time, seconds.
type Controls<'a> = dyn Fn(f64) -> FaceControls + 'a;

fn secs(step: i64) -> f64 {
    step as f64 / Network::steps_per_s()
}

/// The tissue under its controls.
struct DrivenTissue<'a> {
    tissue: &'a Tissue,
    controls: &'a Controls<'a>,
}

impl Simulation<Network> for DrivenTissue<'_> {
    fn rest(&mut self, network: &mut Network, step: i64) {
        let (now, earlier) = ((self.controls)(secs(step)), (self.controls)(secs(step - 1)));
        network.reset(self.tissue, &now, &earlier);
    }

    fn step(&mut self, network: &mut Network, step: i64) {
        network.step(self.tissue, &(self.controls)(secs(step)));
    }
}

/// The tissue of one face at any time.
pub(crate) struct SoftFace {
    segments: Segments<Network>,
}

impl SoftFace {
    pub(crate) fn new(tissue: &Tissue) -> Self {
        Self {
            segments: Segments::new(CUT, Network::new(tissue)),
        }
    }

    /// The network as it was at the last requested step.
    pub(crate) fn network(&self) -> &Network {
        self.segments.state()
    }

    /// Forgets what was simulated: the controls have changed.
    pub(crate) fn forget(&mut self) {
        self.segments.forget();
    }

    /// Brings the nodes to a time. `nodes` has room for all; allocates nothing.
    pub(crate) fn advance_to(
        &mut self,
        tissue: &Tissue,
        time_secs: f64,
        controls: &Controls<'_>,
        nodes: &mut [NodeState],
    ) {
        let exact = time_secs * Network::steps_per_s();
        let step = exact.ceil();
        self.segments
            .advance_to(step as i64, &mut DrivenTissue { tissue, controls });
        let share = 1.0 - (step - exact);
        self.segments
            .states_mut()
            .0
            .write(tissue, share as f32, nodes);
    }
}

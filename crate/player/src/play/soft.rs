//! Soft face over time: steps of the tissue that follow the clock.

use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};

use super::segments::{SegmentGrid, Segments, Simulation, WarmUpPolicy};

/// Segments of 0.8 s with 0.2 s warm-up, after which earlier motion moves no node by more than a
/// thousandth of a millimetre.
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

/// Simulated tissue of one face; gives its state at any time.
pub(crate) struct SoftFace {
    segments: Segments<Network>,
}

impl SoftFace {
    pub(crate) fn new(tissue: &Tissue) -> Self {
        Self {
            segments: Segments::new(CUT, Network::new(tissue)),
        }
    }

    /// Returns the tissue network at the last requested step.
    pub(crate) fn network(&self) -> &Network {
        self.segments.state()
    }

    /// Clears the simulation, because the controls have changed.
    pub(crate) fn forget(&mut self) {
        self.segments.forget();
    }

    /// Advances the nodes to a time. `nodes` has room for all; allocates nothing.
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

//! From body-configure-geometry (GEVH D.3.4) to what a frame shows of the figure.

use raconteur_base::order::sort_by_number;
use raconteur_eml::{ClauseKind, ConfigureGeometry, Document, FillMode, Timeline, VisibleMeshes};
use raconteur_stage::{Fill, Shown};

/// Switches that are remembered one by one; of a live performance that sends more, the
/// earliest become where the others start from.
const MOST: usize = 256;

/// A switch and its time, story seconds.
pub(crate) type Switch = (f64, ConfigureGeometry);

/// The switches of a performance, and what they come to at any time.
#[derive(Default)]
pub(crate) struct Geometry {
    /// What is shown before the first switch.
    before: Shown,
    /// By time.
    switches: Vec<Switch>,
}

/// What a script switches, by time.
pub(crate) fn switches(document: &Document, timeline: &Timeline) -> Vec<Switch> {
    let clauses = timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &document.clause(timed.clause).kind {
            ClauseKind::ConfigureGeometry(switch) => Some((timed.start_secs, switch.clone())),
            _ => None,
        })
        .collect()
}

impl Geometry {
    /// Adds what a script, or a fragment of a live performance, switches.
    pub(crate) fn add(&mut self, switches: &[Switch]) {
        self.switches.extend_from_slice(switches);
        sort_by_number(&mut self.switches, |(time_secs, _)| *time_secs);
        let over = self.switches.len().saturating_sub(MOST);
        for (_, switch) in self.switches.drain(..over) {
            turn(&mut self.before, &switch);
        }
    }

    /// What is shown at a time.
    pub(crate) fn at(&self, time_secs: f64) -> Shown {
        let mut shown = self.before;
        for (_, switch) in self.switches.iter().take_while(|(t, _)| *t <= time_secs) {
            turn(&mut shown, switch);
        }
        shown
    }
}

/// Sets what a switch names.
fn turn(shown: &mut Shown, switch: &ConfigureGeometry) {
    if let Some(fill) = switch.fill_mode {
        shown.fill = match fill {
            FillMode::Solid => Fill::Solid,
            FillMode::Wireframe => Fill::Wireframe,
            FillMode::Point => Fill::Points,
        };
    }
    if let Some(meshes) = switch.meshes {
        shown.body = meshes != VisibleMeshes::Bones;
        shown.bones = meshes != VisibleMeshes::Body;
    }
    for (flag, said) in [
        (&mut shown.frames, switch.frames_visible),
        (&mut shown.centers, switch.centers_visible),
        (&mut shown.materials, switch.materials_active),
        (&mut shown.textures, switch.textures_active),
        (&mut shown.manipulators, switch.manipulators_visible),
    ] {
        *flag = said.unwrap_or(*flag);
    }
}

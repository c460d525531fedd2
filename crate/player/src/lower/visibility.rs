//! Conversion of body-configure-geometry (GEVH D.3.4) to the visible parts of the figure in a
//! frame.

use raconteur_base::order::sort_by_number;
use raconteur_eml::{ClauseKind, ConfigureGeometry, Document, FillMode, Timeline, VisibleMeshes};
use raconteur_stage::{Fill, Visibility};

/// Maximum number of stored switches; in a live performance with more, the earliest are merged into
/// the initial state.
const MAX_SWITCHES: usize = 256;

/// Visibility change of the figure, with its story time, seconds.
pub(crate) type Switch = (f64, ConfigureGeometry);

/// Visibility changes of a performance; gives the visible parts of the figure at any time.
#[derive(Default)]
pub(crate) struct VisibilityTrack {
    /// The drawing before the first switch.
    before: Visibility,
    /// True for a live switch, its time, and the switch; by time.
    switches: Vec<(bool, f64, ConfigureGeometry)>,
}

/// Returns the visibility switches of a script, by time.
pub(crate) fn switches(document: &Document, timeline: &Timeline) -> Vec<Switch> {
    let clauses = timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &document.clause(timed.clause).kind {
            ClauseKind::ConfigureGeometry(switch) => Some((timed.start_secs, switch.clone())),
            _ => None,
        })
        .collect()
}

impl VisibilityTrack {
    /// Replaces the story's switches.
    pub(crate) fn retell(&mut self, story: &[Switch]) {
        self.switches.retain(|(live, ..)| *live);
        self.add(false, story);
    }

    /// Adds the switches of a live fragment permanently.
    pub(crate) fn join(&mut self, fragment: &[Switch]) {
        self.add(true, fragment);
    }

    /// Removes the live switches after a time.
    pub(crate) fn interrupt(&mut self, at_secs: f64) {
        self.switches
            .retain(|(live, secs, _)| !live || *secs < at_secs);
    }

    fn add(&mut self, live: bool, switches: &[Switch]) {
        let new = switches
            .iter()
            .map(|(at, switch)| (live, *at, switch.clone()));
        self.switches.extend(new);
        sort_by_number(&mut self.switches, |(_, time_secs, _)| *time_secs);
        let over = self.switches.len().saturating_sub(MAX_SWITCHES);
        for (.., switch) in self.switches.drain(..over) {
            turn(&mut self.before, &switch);
        }
    }

    /// Returns the visibility of body and bones at a story time, seconds.
    pub(crate) fn sample(&self, time_secs: f64) -> Visibility {
        let mut shown = self.before;
        for (.., switch) in self.switches.iter().take_while(|(_, t, _)| *t <= time_secs) {
            turn(&mut shown, switch);
        }
        shown
    }
}

/// Applies a switch.
fn turn(shown: &mut Visibility, switch: &ConfigureGeometry) {
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
        (&mut shown.body, switch.body_visible),
        (&mut shown.springs, switch.springs_visible),
        (&mut shown.muscles, switch.muscles_visible),
        (&mut shown.skull, switch.skull_visible),
    ] {
        *flag = said.unwrap_or(*flag);
    }
}

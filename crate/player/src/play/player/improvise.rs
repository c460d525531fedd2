//! Live performance: fragments join the story and can be interrupted.

use super::Player;
use crate::live::cut::is_interrupt;
use crate::live::{FragmentOutcome, FragmentText, LiveContext};

impl Player {
    /// Performs EML that arrives during playback (GEVH 3.6): a list of clauses or a whole script.
    /// Plain times count from `now_secs` (story time), names are those of the fragment, of earlier
    /// ones and of the script. It waits until its hands are in place and until nobody else speaks.
    /// The message `<interrupt/>` is [`Player::interrupt`]. `mind` identifies the sender; each has
    /// a send budget; see [`live::limits`](crate::live::limits).
    ///
    /// The same fragments at the same times give the same frames, regardless of the frames
    /// evaluated in between.
    pub fn perform(&mut self, mind: u32, fragment: &str, now_secs: f64) -> FragmentOutcome {
        let now_secs = story_secs(now_secs);
        if is_interrupt(fragment) {
            let mut performed = self.scripts.live.admit_interrupt(mind, now_secs);
            if performed.interrupts {
                performed.cut_secs = self.interrupt(now_secs);
            }
            return performed;
        }
        let base_secs = self.actors.next_change_secs(now_secs);
        let scene = LiveContext {
            cast: &self.cast,
            library: &self.animations.library,
            script: &self.script,
            story: &self.scripts.story,
            actor: self.actors.actor(),
        };
        let fragment = FragmentText {
            mind,
            text: fragment,
            now_secs,
            base_secs,
        };
        let performed = self.scripts.live.admit(&fragment, &scene);
        if !performed.clauses.is_empty() {
            self.change_over(base_secs);
            if let Some(joined) = self.scripts.live.plans().last() {
                self.shots.join(&joined.geometry);
            }
        }
        performed
    }

    /// Ends the actions of live fragments from now on; parts that have not begun are dropped. The
    /// story continues, and so do switched states: shots, music, parameters. The ends are reported
    /// in the next [`Player::drain_events`]. Returns the story time of the end, which is shortly
    /// after `now_secs` if a fragment has just joined; `None` if there is nothing to end.
    ///
    /// Frames up to that time are unchanged.
    pub fn interrupt(&mut self, now_secs: f64) -> Option<f64> {
        let told_secs = self.clock.reported_secs();
        let now_secs = story_secs(now_secs).max(told_secs);
        let at_secs = self.actors.next_change_secs(now_secs);
        let (story, actor) = (&self.scripts.story, self.actors.actor());
        let live = &mut self.scripts.live;
        if !live.interrupt(at_secs, told_secs, story, actor) {
            return None;
        }
        self.shots.interrupt(at_secs);
        self.change_over(at_secs);
        Some(at_secs)
    }

    /// Eases the figure into the updated performance.
    fn change_over(&mut self, from_secs: f64) {
        self.direct();
        let (actor, needs) = self.rehearse();
        self.actors.change(from_secs, actor, needs);
        self.forget_motion();
    }

    /// Returns true if a mind may send a fragment at a story time without exceeding its rate limit.
    #[must_use]
    pub fn has_room(&self, mind: u32, now_secs: f64) -> bool {
        self.scripts.live.has_room(mind, now_secs)
    }
}

/// Returns a valid story time: at least 0; 0 if it is not finite.
fn story_secs(secs: f64) -> f64 {
    if secs.is_finite() { secs.max(0.0) } else { 0.0 }
}

//! Choosing the quality by how long frames take.

use crate::{Quality, RenderOptions};

/// From the cheapest to the best.
const RUNGS: [RenderOptions; 4] = [
    rung(Quality::Low, true),
    rung(Quality::Low, false),
    rung(Quality::Medium, false),
    rung(Quality::High, false),
];

const fn rung(quality: Quality, half_size: bool) -> RenderOptions {
    RenderOptions { quality, half_size }
}

/// Mean frame time above which the picture is made cheaper: under 38 a second.
const SLOW_MS: f64 = 26.0;
/// Mean frame time above which two rungs are left at once.
const VERY_SLOW_MS: f64 = 50.0;
/// Mean frame time below which a better picture is tried: 50 a second. A screen of 60 Hz
/// never tells less than 16.7.
const QUICK_MS: f64 = 20.0;
/// Frames that are looked at before the picture is made cheaper.
const LOOK_FRAMES: u32 = 12;
/// Frames after a change that do not count: the first ones compile.
const SETTLE_FRAMES: u32 = 4;
/// Time of quick frames before a better picture is tried.
const PATIENCE_MS: f64 = 4_000.0;
/// Longest frame that counts; a hidden page sleeps longer.
const PAUSE_MS: f64 = 400.0;
/// How often a rung is tried that was too slow before; each time waits four times longer.
const TRIES: u32 = 3;

/// Watches frame times and says when to draw otherwise.
///
/// It drops fast and climbs slowly, and since a rung that proved too slow is tried again
/// only twice, the number of changes is bounded whatever the times are.
#[derive(Clone, Debug)]
pub struct Pace {
    at: usize,
    automatic: bool,
    mean_ms: f64,
    frames: u32,
    quick_ms: f64,
    failed: [u32; RUNGS.len()],
}

impl Default for Pace {
    /// Automatic, from the middle.
    fn default() -> Self {
        Self {
            at: 2,
            automatic: true,
            mean_ms: 0.0,
            frames: 0,
            quick_ms: 0.0,
            failed: [0; RUNGS.len()],
        }
    }
}

impl Pace {
    /// What to draw with now.
    #[must_use]
    pub fn options(&self) -> RenderOptions {
        RUNGS[self.at]
    }

    /// Holds a quality whatever frames take; with `None`, frame times decide again.
    pub fn choose(&mut self, fixed: Option<Quality>) {
        self.automatic = fixed.is_none();
        if let Some(quality) = fixed {
            self.go(1 + quality as usize);
        }
    }

    /// Takes the time between two frames, milliseconds; whether [`Self::options`] changed.
    pub fn report(&mut self, frame_ms: f64) -> bool {
        if !self.automatic || !(frame_ms > 0.0 && frame_ms < PAUSE_MS) {
            return false;
        }
        self.frames += 1;
        if self.frames <= SETTLE_FRAMES {
            return false;
        }
        let seen = self.frames - SETTLE_FRAMES;
        self.mean_ms += (frame_ms - self.mean_ms) / f64::from(seen.min(LOOK_FRAMES));
        if seen < LOOK_FRAMES {
            return false;
        }
        if self.mean_ms > SLOW_MS && self.at > 0 {
            self.failed[self.at] += 1;
            let down = if self.mean_ms > VERY_SLOW_MS { 2 } else { 1 };
            self.go(self.at.saturating_sub(down));
            return true;
        }
        // A hitch stops the count of quick time for a while; it does not start it anew.
        if self.mean_ms >= QUICK_MS {
            return false;
        }
        self.quick_ms += frame_ms;
        let Some(&failed) = self.failed.get(self.at + 1) else {
            return false;
        };
        if failed < TRIES && self.quick_ms >= PATIENCE_MS * f64::from(4_u32.pow(failed)) {
            self.go(self.at + 1);
            return true;
        }
        false
    }

    fn go(&mut self, rung: usize) {
        self.at = rung;
        self.mean_ms = 0.0;
        self.frames = 0;
        self.quick_ms = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs for some seconds on a device that takes these times on the rungs; changes.
    fn run(pace: &mut Pace, secs: f64, rung_ms: [f64; 4]) -> Vec<usize> {
        let (mut now, mut changes) = (0.0, Vec::new());
        while now < secs * 1e3 {
            let ms = rung_ms[pace.at];
            now += ms;
            if pace.report(ms) {
                changes.push(pace.at);
            }
        }
        changes
    }

    #[test]
    fn a_quick_device_climbs_once_and_stays() {
        let mut pace = Pace::default();
        assert_eq!(run(&mut pace, 3.0, [16.7; 4]), [0_usize; 0]);
        assert_eq!(run(&mut pace, 300.0, [16.7; 4]), [3]);
        assert_eq!(pace.options().quality, Quality::High);
    }

    #[test]
    fn a_weak_device_drops_within_a_second() {
        let mut pace = Pace::default();
        run(&mut pace, 1.0, [20.0, 30.0, 40.0, 80.0]);
        assert_eq!(pace.at, 1);
        run(&mut pace, 1.0, [20.0, 30.0, 40.0, 80.0]);
        assert_eq!(pace.at, 0);
        let mut worse = Pace::default();
        run(&mut worse, 1.5, [70.0; 4]);
        assert_eq!(worse.at, 0, "two rungs at once");
    }

    #[test]
    fn a_rung_that_is_too_slow_is_tried_ever_more_rarely_then_never() {
        let mut pace = Pace::default();
        let changes = run(&mut pace, 600.0, [9.0, 12.0, 16.7, 40.0]);
        assert_eq!(changes, [3, 2, 3, 2, 3, 2]);
        assert_eq!(run(&mut pace, 600.0, [9.0, 12.0, 16.7, 40.0]), [0_usize; 0]);
    }

    #[test]
    fn between_slow_and_quick_nothing_changes() {
        for ms in [20.0, 21.0, 23.5, 26.0] {
            assert_eq!(
                run(&mut Pace::default(), 100.0, [ms; 4]),
                [0_usize; 0],
                "{ms}"
            );
        }
    }

    #[test]
    fn single_hitches_and_pauses_count_little() {
        let mut pace = Pace::default();
        for i in 0..10_000 {
            let ms = match i % 200 {
                0 => 120.0,
                1 => 5_000.0,
                2 => f64::NAN,
                _ => 16.7,
            };
            pace.report(ms);
        }
        assert_eq!(pace.at, 3);
    }

    #[test]
    fn whatever_the_times_changes_are_few() {
        for seed in 0..60 {
            let mut pace = Pace::default();
            let changes = (0..40_000)
                .filter(|&i| {
                    // Load that comes and goes in stretches of some hundred frames.
                    let r = raconteur_base::noise::unit(seed, 7, i / (150 + 7 * seed as i64));
                    pace.report(8.0 + 60.0 * r)
                })
                .count();
            // Three rungs fail by three tries each at most, and two are lost and climbed.
            assert!(changes <= 3 * 3 * TRIES as usize + 1, "{seed}: {changes}");
        }
    }

    #[test]
    fn a_chosen_quality_is_kept() {
        for (quality, _) in Quality::NAMES {
            let mut pace = Pace::default();
            pace.choose(Some(quality));
            run(&mut pace, 60.0, [200.0; 4]);
            run(&mut pace, 60.0, [5.0; 4]);
            assert_eq!(pace.options(), rung(quality, false));
            pace.choose(None);
            run(&mut pace, 10.0, [200.0; 4]);
            assert_eq!(pace.at, 0);
        }
    }
}

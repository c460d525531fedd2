//! Selection of the quality by frame times.

use crate::{Quality, RenderOptions};

/// A quality step between software rendering and a graphics card.
#[derive(Clone, Copy)]
struct QualityStep {
    quality: Quality,
    /// Maximum number of pixels; the browser enlarges the image for a larger canvas.
    most_pixels: Option<u32>,
}

/// Quality steps, from the cheapest to the best.
const RUNGS: [QualityStep; 5] = [
    // 0.4 of the width and height of a player that is as wide as a page's text.
    step(Quality::Lowest, Some(90_000)),
    step(Quality::Lowest, None),
    step(Quality::Low, None),
    step(Quality::Medium, None),
    step(Quality::High, None),
];

const fn step(quality: Quality, most_pixels: Option<u32>) -> QualityStep {
    QualityStep {
        quality,
        most_pixels,
    }
}

/// Initial step with a graphics card.
const MIDDLE: usize = 3;

/// Frame time above which quality is reduced: under 38 fps.
const SLOW_MS: f64 = 26.0;
/// Frame time above which quality is reduced by two steps.
const VERY_SLOW_MS: f64 = 50.0;
/// Frame time that no graphics card needs: only the lowest rung may do.
const HOPELESS_MS: f64 = 100.0;
/// Frame time below which a higher quality is tried: 50 fps. A 60 Hz display never reports less
/// than 16.7.
const QUICK_MS: f64 = 20.0;
/// Number of frames observed before quality is reduced, unless they take longer than [`LOOK_MS`].
const LOOK_FRAMES: usize = 12;
/// Time after which fewer frames are enough.
const LOOK_MS: f64 = 400.0;
/// Number of ignored frames after a change, since the first ones compile, unless they take longer
/// than [`SETTLE_MS`].
const SETTLE_FRAMES: u32 = 4;
/// Time after which the next frame counts.
const SETTLE_MS: f64 = 150.0;
/// Time of quick frames before a higher quality is tried.
const PATIENCE_MS: f64 = 4_000.0;
/// Longest frame that counts; a hidden page sleeps longer.
const PAUSE_MS: f64 = 4_000.0;
/// Maximum number of tries of a quality step that was too slow before; the wait grows fourfold each
/// time.
const TRIES: u32 = 3;

/// Automatic quality control: adapts the rendering options to measured frame times.
///
/// Quality drops fast and climbs slowly. A quality step that proved too slow is tried again only
/// twice, so the number of changes is bounded for any frame times. Decisions use the median of the
/// last frames, so a single hitch changes nothing.
#[derive(Clone, Debug)]
pub struct FramePacer {
    at: usize,
    automatic: bool,
    /// Frames since the last change, and their total time.
    frames: u32,
    settled_ms: f64,
    /// Recent counted frame times, a ring buffer indexed by `seen`.
    last_ms: [f64; LOOK_FRAMES],
    seen: usize,
    quick_ms: f64,
    failed: [u32; RUNGS.len()],
}

impl FramePacer {
    /// Creates automatic control that starts at the middle step, or at the lowest if the device is
    /// `software`.
    #[must_use]
    pub fn new(software: bool) -> Self {
        Self {
            at: if software { 0 } else { MIDDLE },
            automatic: true,
            frames: 0,
            settled_ms: 0.0,
            last_ms: [0.0; LOOK_FRAMES],
            seen: 0,
            quick_ms: 0.0,
            failed: [0; RUNGS.len()],
        }
    }

    /// Returns the current rendering options.
    #[must_use]
    pub fn options(&self) -> RenderOptions {
        RenderOptions {
            quality: RUNGS[self.at].quality,
        }
    }

    /// Returns the maximum number of pixels of an image during playback.
    #[must_use]
    pub fn most_pixels(&self) -> Option<u32> {
        RUNGS[self.at].most_pixels
    }

    /// Fixes a quality whatever the frame times; with `None`, frame times decide again.
    pub fn choose(&mut self, fixed: Option<Quality>) {
        self.automatic = fixed.is_none();
        let Some(quality) = fixed else { return };
        if let Some(rung) = RUNGS.iter().position(|r| r.quality == quality) {
            self.set_step(rung);
        }
    }

    /// Takes the time between two frames, milliseconds; returns true if the rendering options
    /// changed.
    pub fn report(&mut self, frame_ms: f64) -> bool {
        let counts = frame_ms > 0.0 && frame_ms < PAUSE_MS;
        if !self.automatic || !counts {
            return false;
        }
        if self.frames < SETTLE_FRAMES && self.settled_ms < SETTLE_MS {
            self.frames += 1;
            self.settled_ms += frame_ms;
            return false;
        }
        self.last_ms[self.seen % LOOK_FRAMES] = frame_ms;
        self.seen += 1;
        let looked = &self.last_ms[..self.seen.min(LOOK_FRAMES)];
        // Two slow frames distinguish a hitch from a slow device.
        let enough =
            looked.len() == LOOK_FRAMES || looked.len() > 1 && looked.iter().sum::<f64>() > LOOK_MS;
        if !enough {
            return false;
        }
        let typical_ms = lower_median(looked);
        if typical_ms > SLOW_MS && self.at > 0 {
            self.failed[self.at] += 1;
            self.set_step(match typical_ms {
                HOPELESS_MS.. => 0,
                VERY_SLOW_MS.. => self.at.saturating_sub(2),
                _ => self.at - 1,
            });
            return true;
        }
        // A hitch pauses the count of fast frames; it does not restart the count.
        if typical_ms >= QUICK_MS {
            return false;
        }
        self.quick_ms += frame_ms;
        let Some(&failed) = self.failed.get(self.at + 1) else {
            return false;
        };
        if failed < TRIES && self.quick_ms >= PATIENCE_MS * f64::from(4_u32.pow(failed)) {
            self.set_step(self.at + 1);
            return true;
        }
        false
    }

    fn set_step(&mut self, rung: usize) {
        self.at = rung;
        self.frames = 0;
        self.settled_ms = 0.0;
        self.seen = 0;
        self.quick_ms = 0.0;
    }
}

/// Returns the median of some times; the lower one of two middle values.
fn lower_median(times: &[f64]) -> f64 {
    let mut sorted = [f64::INFINITY; LOOK_FRAMES];
    sorted[..times.len()].copy_from_slice(times);
    sorted.sort_by(f64::total_cmp);
    sorted[(times.len() - 1) / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulates some seconds on a device with these frame times per quality step; returns the
    /// changes.
    fn run(pace: &mut FramePacer, secs: f64, rung_ms: [f64; 5]) -> Vec<usize> {
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
        let mut pace = FramePacer::new(false);
        assert_eq!(run(&mut pace, 3.0, [16.7; 5]), [0_usize; 0]);
        assert_eq!(run(&mut pace, 300.0, [16.7; 5]), [4]);
        assert_eq!(pace.options().quality, Quality::High);
    }

    #[test]
    fn a_weak_device_drops_within_a_second() {
        let mut pace = FramePacer::new(false);
        run(&mut pace, 1.0, [16.0, 20.0, 24.0, 40.0, 80.0]);
        assert_eq!(pace.at, 2);
        let mut worse = FramePacer::new(false);
        run(&mut worse, 1.0, [70.0; 5]);
        assert_eq!(worse.at, 1, "two rungs at once");
    }

    /// Checks that software rendering is detected within two seconds; it takes a third of a second
    /// or more above the lowest step.
    #[test]
    fn a_processor_is_found_out_within_two_seconds() {
        for ms in [120.0, 350.0, 600.0] {
            let mut pace = FramePacer::new(false);
            run(&mut pace, 1.9, [40.0, 90.0, ms, ms, ms]);
            assert_eq!(pace.at, 0, "{ms}");
        }
        // WebGPU in software: three frames.
        let mut pace = FramePacer::new(false);
        run(&mut pace, 5.0, [100.0, 400.0, 1200.0, 1700.0, 2000.0]);
        assert_eq!(pace.at, 0);
        // With a known quality, nothing above it is rendered, and an insufficient step is soon
        // abandoned.
        let mut known = FramePacer::new(true);
        assert_eq!(
            run(&mut known, 600.0, [40.0, 90.0, 350.0, 350.0, 350.0]),
            [0_usize; 0]
        );
    }

    #[test]
    fn a_rung_that_is_too_slow_is_tried_ever_more_rarely_then_never() {
        let mut pace = FramePacer::new(false);
        let times = [9.0, 10.0, 12.0, 16.7, 40.0];
        assert_eq!(run(&mut pace, 600.0, times), [4, 3, 4, 3, 4, 3]);
        assert_eq!(run(&mut pace, 600.0, times), [0_usize; 0]);
    }

    #[test]
    fn between_slow_and_quick_nothing_changes() {
        for ms in [20.0, 21.0, 23.5, 26.0] {
            let mut pace = FramePacer::new(false);
            assert_eq!(run(&mut pace, 100.0, [ms; 5]), [0_usize; 0], "{ms}");
        }
    }

    #[test]
    fn single_hitches_and_pauses_count_little() {
        let mut pace = FramePacer::new(false);
        for i in 0..10_000 {
            let ms = match i % 200 {
                0 => 120.0,
                1 => 5_000.0,
                2 => f64::NAN,
                3 => 900.0,
                _ => 16.7,
            };
            pace.report(ms);
        }
        assert_eq!(pace.at, 4);
    }

    #[test]
    fn whatever_the_times_changes_are_few() {
        for seed in 0..60 {
            let mut pace = FramePacer::new(false);
            let changes = (0..40_000)
                .filter(|&i| {
                    // Load that varies in intervals of some hundred frames.
                    let r = raconteur_base::noise::unit(seed, 7, i / (150 + 7 * seed as i64));
                    pace.report(8.0 + 160.0 * r * r)
                })
                .count();
            // Each rung but the lowest fails by three tries at most, and each fall is climbed again.
            let falls = (RUNGS.len() - 1) * TRIES as usize;
            assert!(changes <= falls * RUNGS.len(), "{seed}: {changes}");
        }
    }

    #[test]
    fn a_chosen_quality_is_kept() {
        for (quality, _) in Quality::NAMES {
            let mut pace = FramePacer::new(false);
            pace.choose(Some(quality));
            run(&mut pace, 60.0, [200.0; 5]);
            run(&mut pace, 60.0, [5.0; 5]);
            assert_eq!(pace.options().quality, quality);
            pace.choose(None);
            run(&mut pace, 10.0, [200.0; 5]);
            assert_eq!(pace.at, 0);
        }
    }
}

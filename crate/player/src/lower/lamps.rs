//! Stage light as a function of time: the light of a script and that of the strongest emotion (GEVH
//! 3.5.4.2), eased from one to the next.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::order::sort_by_number;
use raconteur_eml::{ClauseKind, ControlSource};
use raconteur_stage::illumination::linear;
use raconteur_stage::{EmotionEnvelope, EmotionTimeline, Illumination};

use crate::lower::control_source::{ActiveControl, leaders};
use crate::lower::script::Script;

/// Minimum duration of a light change, seconds. Changes scripted more densely blend into each other
/// below 3 Hz, where nothing flashes (WCAG 2.2, success criterion 2.3.1).
pub(crate) const MIN_SECS: f64 = 1.0;
/// Fade time of an emotion's light, seconds. Designed.
const MOVE_SECS: f64 = 1.4;

/// Lighting change set by a script: colour, brightness and transition from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LampCue {
    pub(crate) start_secs: f64,
    transition_secs: f64,
    by: ControlSource,
    /// Linear RGB; `None`: unchanged.
    color: Option<[f32; 3]>,
    /// Brightness; `None`: unchanged.
    brightness: Option<f64>,
}

/// Returns the lighting changes of a script, sorted by time.
pub(crate) fn lamps(script: &Script) -> Vec<LampCue> {
    let clauses = script.timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &script.document.clause(timed.clause).kind {
            ClauseKind::Light(light) => Some(LampCue {
                start_secs: timed.start_secs,
                // Light at the start of a story applies without a transition.
                transition_secs: if timed.start_secs <= script.timeline.lead_in_secs {
                    light.transition_secs
                } else {
                    light.transition_secs.max(MIN_SECS)
                },
                by: light.by,
                color: light.color.map(linear),
                brightness: light.brightness,
            }),
            _ => None,
        })
        .collect()
}

/// The light from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LightState {
    start_secs: f64,
    settled_secs: f64,
    light: Illumination,
}

/// Settings for the expression of emotions by light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightChannel {
    /// True if emotions control the light unless a script does.
    pub(crate) follows: bool,
    /// The light is that of the thesis, to the letter.
    pub(crate) is_strict: bool,
}

impl LightChannel {
    /// Returns the light without emotion.
    fn neutral(self) -> Illumination {
        match self.is_strict {
            true => Illumination::strict_default(),
            false => Illumination::default(),
        }
    }

    /// Returns the lighting that expresses an emotion; neutral for `None`.
    fn illumination(self, felt: Option<&EmotionEnvelope>) -> Illumination {
        match felt {
            None => self.neutral(),
            Some(f) if self.is_strict => Illumination::strictly(f.kind, f.intensity),
            Some(f) => Illumination::from_emotion(f.kind, f.intensity),
        }
    }
}

/// Lighting of a performance over time, from script and emotions; before its first change, the
/// set's own.
#[derive(Default)]
pub(crate) struct LampSequence {
    own: Illumination,
    lit: Vec<LightState>,
}

impl LampSequence {
    /// Builds the lighting of a performance from script cues and emotions.
    pub(crate) fn new(
        mut cues: Vec<LampCue>,
        feelings: &EmotionTimeline,
        channel: LightChannel,
    ) -> Self {
        sort_by_number(&mut cues, |c| c.start_secs);
        let leads: Vec<(f64, ControlSource)> = cues.iter().map(|c| (c.start_secs, c.by)).collect();
        let same = |a: Option<&EmotionEnvelope>, b: Option<&EmotionEnvelope>| {
            channel.illumination(a) == channel.illumination(b)
        };
        let mut now = channel.neutral();
        let lit = leaders(&leads, feelings, channel.follows, MIN_SECS, same)
            .into_iter()
            .map(|(start_secs, leader)| {
                let transition_secs = match leader {
                    ActiveControl::Script(i) => {
                        let cue = &cues[i];
                        let color = cue.color.unwrap_or(now.color);
                        let brightness = cue.brightness.unwrap_or(now.brightness);
                        now = Illumination {
                            strict: channel.neutral().strict,
                            ..Illumination::written(color, brightness)
                        };
                        cue.transition_secs
                    }
                    ActiveControl::Emotion(felt) => {
                        now = channel.illumination(felt.as_ref());
                        MOVE_SECS
                    }
                };
                LightState {
                    start_secs,
                    settled_secs: start_secs + transition_secs,
                    light: now,
                }
            });
        Self {
            own: channel.neutral(),
            lit: lit.collect(),
        }
    }

    /// Returns the lighting at a story time, eased between changes.
    pub(crate) fn sample(&self, time_secs: f64) -> Illumination {
        let begun = self.lit.partition_point(|l| l.start_secs <= time_secs);
        let begun = &self.lit[..begun];
        let settled = begun.iter().rposition(|l| l.settled_secs <= time_secs);
        let (base, moving) = match settled {
            Some(i) => (begun[i].light, &begun[i + 1..]),
            None => (self.own, begun),
        };
        moving.iter().fold(base, |light, lit| {
            let way_secs = lit.settled_secs - lit.start_secs;
            let s = minimum_jerk((time_secs - lit.start_secs) / way_secs);
            light.towards(&lit.light, s)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: LightChannel = LightChannel {
        follows: true,
        is_strict: false,
    };

    fn sequence(body: &str) -> LampSequence {
        let text = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let script = Script::read(&text, None);
        assert_eq!(script.diagnostics, []);
        LampSequence::new(lamps(&script), &EmotionTimeline::default(), FREE)
    }

    #[test]
    fn a_script_lights_the_stage_and_gives_it_back() {
        let lamps = sequence(
            "<r:light time='0' color='#ff0000'/><r:light time='5' brightness='0.5' transition='2'/>\
             <r:light time='10' by='emotion'/>",
        );
        let red = [1.0, 0.0, 0.0];
        assert_eq!(
            (lamps.sample(0.0).color, lamps.sample(0.0).brightness),
            (red, 1.0)
        );
        assert_eq!(
            (lamps.sample(6.0).color, lamps.sample(6.0).brightness),
            (red, 0.75)
        );
        assert_eq!(lamps.sample(9.0).brightness, 0.5);
        assert_eq!(lamps.sample(12.0), Illumination::default());
    }

    #[test]
    fn nothing_flashes_however_densely_lights_are_written() {
        for hz in [1.0, 2.0, 3.0, 4.0, 6.0, 10.0, 25.0] {
            let body: Vec<String> = (0..200)
                .map(|i| {
                    let (time, brightness) = (1.0 + f64::from(i) * 0.5 / hz, 2 * (i % 2));
                    format!("<r:light time='{time}' brightness='{brightness}'/>")
                })
                .collect();
            let lamps = sequence(&body.concat());
            // A flash is a pair of opposing changes of a tenth of the brightest or more.
            let end_secs = 1.0 + 100.0 / hz;
            let (mut turns, mut least, mut most, mut rises) = (0, 0.0_f64, 2.0_f64, true);
            let mut t = 2.5;
            while t < end_secs {
                let b = lamps.sample(t).brightness;
                (least, most) = if rises {
                    (least, b.max(most))
                } else {
                    (b.min(least), most)
                };
                if rises && b < most - 0.2 {
                    (rises, least, turns) = (false, b, turns + 1);
                } else if !rises && b > least + 0.2 {
                    (rises, most, turns) = (true, b, turns + 1);
                }
                t += 0.01;
            }
            let flashes = 0.5 * f64::from(turns) / (end_secs - 2.5).max(1.0);
            assert!(flashes <= 3.0, "{hz} Hz: {flashes}");
        }
    }
}

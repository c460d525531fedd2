//! Emotions over the time of a story (F&H sections 4.3.5 and 4.4.4).

use raconteur_base::curve::{last_at_or_before, smooth};
use raconteur_base::order::sort_by_number;
use raconteur_body::face::FaceControls;
use raconteur_speech::emotion::EmotionPoint;

use super::blend::{Affect, ExpressionWeights};
use super::signs::EmotionSigns;
use super::wink;
use crate::parameters::{Curve, FaceControl, SET_SECS};

/// Shortest onset or fade of an emotion, seconds. Designed: the quickest onsets of genuine
/// expressions.
pub const MIN_SECS: f64 = 0.25;
/// Greatest strength of an emotion, relative to that of its place.
const STRONGEST: f64 = 4.0;
/// Maximum number of emotion spans in force at one time; more are left out. A story needs fewer,
/// and the limit bounds the work.
const LANES: usize = 16;

/// Emotion that is in force for an interval of story time, with onset, apex and decay.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EmotionSpan {
    /// Start of the onset, story seconds.
    pub start_secs: f64,
    /// Time of full strength, story seconds.
    pub apex_secs: f64,
    /// End of the sustained phase, story time, seconds; a time at or before the apex means no
    /// sustain.
    pub until_secs: f64,
    /// End of the fade, story seconds.
    pub end_secs: f64,
    /// Emotion to express.
    pub affect: Affect,
    /// Strength; 1 is that of its place.
    pub intensity: f64,
}

impl EmotionSpan {
    /// Returns the span with its times in order and no onset or fade shorter than [`MIN_SECS`];
    /// `None` when a time or a place is not finite.
    fn ordered(self) -> Option<Self> {
        let all = [
            self.start_secs,
            self.apex_secs,
            self.end_secs,
            self.intensity,
            self.affect.place.activation,
            self.affect.place.evaluation,
            self.affect.place.power,
        ];
        if !all.iter().all(|x| x.is_finite()) {
            return None;
        }
        let until_secs = if self.until_secs.is_finite() {
            self.until_secs.max(self.apex_secs)
        } else {
            self.apex_secs
        };
        Some(Self {
            start_secs: self.start_secs.min(self.apex_secs - MIN_SECS),
            end_secs: self.end_secs.max(until_secs + MIN_SECS),
            until_secs,
            intensity: self.intensity.clamp(0.0, STRONGEST),
            affect: Affect {
                place: self.affect.place.scaled(1.0),
                ..self.affect
            },
            ..self
        })
    }

    /// Returns the strength at a time, 0 to 1: linear from the start to the apex and from there to
    /// the end (F&H section 4.3.5), eased.
    fn strength(&self, t: f64) -> f64 {
        let up = (t - self.start_secs) / (self.apex_secs - self.start_secs);
        let down = (self.end_secs - t) / (self.end_secs - self.until_secs);
        smooth(up.min(down))
    }
}

/// Full effect of an emotion, computed once.
#[derive(Clone, Copy, Debug, Default)]
struct EmotionEffect {
    mixture: ExpressionWeights,
    signs: EmotionSigns,
    place: EmotionPoint,
    strength: f64,
    /// Closure of one eye by a wink, for a span at its apex. It is not part of sums.
    wink: f64,
}

impl EmotionEffect {
    /// Returns the effect of a transient emotion; its wink has its own timing.
    fn from_affect(affect: Affect, intensity: f64) -> Self {
        let mut effect = Self::default();
        let mut full = Self::sustained(affect);
        let (mixture, share) = full.mixture.split_wink();
        full.mixture = mixture;
        effect.add(&full, intensity);
        effect.strength = 1.0;
        effect.wink = wink::amount(share, intensity);
        effect
    }

    /// Returns the effect of a sustained emotion, including its wink, if any.
    fn sustained(affect: Affect) -> Self {
        Self {
            mixture: ExpressionWeights::from_affect(affect),
            signs: EmotionSigns::from_affect(affect),
            place: affect.place,
            strength: 1.0,
            wink: 0.0,
        }
    }

    fn add(&mut self, other: &Self, factor: f64) {
        self.mixture.add(&other.mixture, factor);
        self.signs.add(&other.signs, factor);
        self.place.activation += factor * other.place.activation;
        self.place.evaluation += factor * other.place.evaluation;
        self.place.power += factor * other.place.power;
        self.strength += factor * other.strength;
    }
}

/// Breathing of the figure at one time: phase lead and depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breathing {
    /// Lead of the breath over calm breath, seconds: the phase at a time is that of calm breath at
    /// the time plus this lead. It grows at the breathing rate less 1.
    pub lead_secs: f64,
    /// Factor on the depth.
    pub depth: f64,
}

impl Breathing {
    /// Breathing without emotion: no lead, depth 1.
    pub const CALM: Self = Self {
        lead_secs: 0.0,
        depth: 1.0,
    };
}

/// Emotions of a performance, prepared; gives expression and other signs at any story time.
/// Evaluation is a pure function of time and allocates nothing.
///
/// Simultaneous emotions are blended by their strengths, whose sum is never more than 1. Where
/// their muscles are antagonists, the stronger ones win (F&H equation 4.10).
#[derive(Clone, Debug, Default)]
pub struct EmotionTrack {
    /// Spans one after the other: each begins when the one before it in its lane is over.
    lanes: Vec<Vec<(EmotionSpan, EmotionEffect)>>,
    /// Emotions that are set by name.
    scripted: Vec<(EmotionEffect, Curve)>,
    /// Times between which the breathing rate is linear, ascending; the rates less 1, and their
    /// integral up to each.
    knots: Vec<f64>,
    rates: Vec<f64>,
    leads: Vec<f64>,
}

impl EmotionTrack {
    /// Creates the track from emotions in any order and those set by name (see
    /// [`ParameterTrack::emotions`](crate::parameters::ParameterTrack::emotions)). Values that are
    /// not finite are left out.
    #[must_use]
    pub fn new(spans: &[EmotionSpan], scripted: &[(&str, Curve)]) -> Self {
        let mut spans: Vec<EmotionSpan> = spans.iter().filter_map(|s| s.ordered()).collect();
        sort_by_number(&mut spans, |span| span.start_secs);
        let mut lanes: Vec<Vec<(EmotionSpan, EmotionEffect)>> = Vec::new();
        for span in spans {
            let is_free = |lane: &Vec<(EmotionSpan, EmotionEffect)>| {
                let last = lane.last();
                last.is_none_or(|(last, _)| last.end_secs <= span.start_secs)
            };
            let free = lanes.iter().position(is_free).unwrap_or(lanes.len());
            if free == lanes.len() && free < LANES {
                lanes.push(Vec::new());
            }
            if let Some(lane) = lanes.get_mut(free) {
                lane.push((
                    span,
                    EmotionEffect::from_affect(span.affect, span.intensity),
                ));
            }
        }
        let mut track = Self {
            lanes,
            scripted: scripted
                .iter()
                .map(|(word, curve)| {
                    let affect = Affect::named(word).unwrap_or_default();
                    (EmotionEffect::sustained(affect), curve.clone())
                })
                .collect(),
            ..Self::default()
        };
        track.plan_breath();
        track
    }

    /// Integrates the breathing rate, taken as linear between the times at which an emotion begins
    /// or ends.
    fn plan_breath(&mut self) {
        let spans = self.lanes.iter().flatten().flat_map(|(s, _)| {
            let half = |a: f64, b: f64| a + 0.5 * (b - a);
            [
                s.start_secs,
                half(s.start_secs, s.apex_secs),
                s.apex_secs,
                s.until_secs,
                half(s.until_secs, s.end_secs),
                s.end_secs,
            ]
        });
        let courses = self.scripted.iter().flat_map(|(_, curve)| curve.starts());
        let courses = courses.flat_map(|start| [*start, start + SET_SECS]);
        let mut knots: Vec<f64> = spans.chain(courses).collect();
        sort_by_number(&mut knots, |t| *t);
        knots.dedup();
        let rate = |t: f64| self.sum(t).signs.limited().breath_rate;
        let rates: Vec<f64> = knots.iter().map(|t| rate(*t)).collect();
        let mut lead = 0.0;
        let leads = (0..knots.len()).map(|i| {
            if i > 0 {
                lead += 0.5 * (rates[i - 1] + rates[i]) * (knots[i] - knots[i - 1]);
            }
            lead
        });
        self.leads = leads.collect();
        (self.knots, self.rates) = (knots, rates);
    }

    /// Returns the sum of all emotions at a time.
    fn sum(&self, t: f64) -> EmotionEffect {
        let mut sum = EmotionEffect::default();
        let mut winks: f64 = 0.0;
        let mut take = |effect: &EmotionEffect, strength: f64| {
            if strength > 0.0 {
                sum.add(effect, strength);
            }
        };
        for lane in &self.lanes {
            let begun = lane.partition_point(|(span, _)| span.start_secs <= t);
            if let Some((span, effect)) = begun.checked_sub(1).and_then(|i| lane.get(i)) {
                take(effect, span.strength(t));
                winks = winks.max(effect.wink * wink::closure(t - span.apex_secs));
            }
        }
        for (effect, curve) in &self.scripted {
            take(effect, curve.sample(t));
        }
        if sum.strength > 1.0 {
            let mut mean = EmotionEffect::default();
            mean.add(&sum, 1.0 / sum.strength);
            sum = mean;
        }
        sum.wink = winks;
        sum
    }

    /// Adds the expression, the lids and the blush at a time to the face controls.
    pub fn add(&self, time_secs: f64, controls: &mut FaceControls) {
        let mut sum = self.sum(time_secs);
        let mut expression = sum.mixture.expression();
        if sum.wink > 0.0 {
            let lid = expression.value(FaceControl::UPPER_LID_LEFT);
            sum.mixture.wink(sum.wink);
            expression = sum.mixture.expression();
            // The lid always closes fully, from any position.
            expression.values[FaceControl::UPPER_LID_LEFT.index()] = lid;
        }
        expression.add(controls);
        wink::close(sum.wink, controls);
        controls.blush += sum.signs.limited().blush;
    }

    /// Returns the place in the emotion space at a time; the middle when calm.
    #[must_use]
    pub fn sample(&self, time_secs: f64) -> EmotionPoint {
        self.sum(time_secs).place.scaled(1.0)
    }

    /// Returns the strength of emotion, 0 (calm) to 1 (one emotion in full, or several together).
    #[must_use]
    pub fn strength(&self, time_secs: f64) -> f64 {
        self.sum(time_secs).strength
    }

    /// Returns the factor that an emotion applies to unscripted motion at a time; 1 when calm.
    #[must_use]
    pub fn liveliness(&self, time_secs: f64) -> f64 {
        1.0 + self.sum(time_secs).signs.limited().liveliness
    }

    /// Returns the turn of the eyes from their gaze direction: yaw to the figure's left and pitch
    /// down, radians.
    #[must_use]
    pub fn gaze(&self, time_secs: f64) -> [f64; 2] {
        [0.0, self.sum(time_secs).signs.limited().gaze_down_rad]
    }

    /// Returns the turn of the head: yaw to the figure's left, pitch down, roll to the left,
    /// radians.
    #[must_use]
    pub fn head(&self, time_secs: f64) -> [f64; 3] {
        self.sum(time_secs).signs.limited().head()
    }

    /// Returns phase lead and depth of breathing at a story time, seconds.
    #[must_use]
    pub fn breath(&self, time_secs: f64) -> Breathing {
        let lead_secs = match last_at_or_before(&self.knots, time_secs) {
            None => 0.0,
            Some(i) => {
                let since = time_secs - self.knots[i];
                let slope = match (self.knots.get(i + 1), self.rates.get(i + 1)) {
                    (Some(knot), Some(rate)) => (rate - self.rates[i]) / (knot - self.knots[i]),
                    _ => 0.0,
                };
                self.leads[i] + since * (self.rates[i] + 0.5 * slope * since)
            }
        };
        Breathing {
            lead_secs,
            depth: 1.0 + self.sum(time_secs).signs.limited().breath_depth,
        }
    }
}

#[cfg(test)]
mod tests;

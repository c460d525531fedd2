//! Gaze of a speaker: at the listener, aside, away or at an imagined object (F&H sections 4.2.1 and
//! 4.3.5).
//!
//! Accents, pauses and questions create demands to look at the listener or away. The eyes jump
//! between demands, never during one, so that the gaze of an accent is never farther away at its
//! end than at its start. Durations and directions of saccades are those of Lee, Badler and Badler
//! 2002 ("Eyes Alive", doi:10.1145/566654.566629); their magnitudes are smaller, because F&H
//! require small differences between consecutive positions.

use raconteur_base::order::sort_by_number;
use raconteur_base::{noise, ops};

use super::Manner;
use super::speech_features::{BoundaryKind, SpeechFeatures};
use super::think::ThinkingPause;
use super::track::Track;
use crate::discourse::Discourse;
use crate::idle::stream;

/// A target within this angle of the listener counts as the listener, radians: from the
/// chin to the hair at 2 m.
pub const AT_LISTENER_RAD: f64 = 0.03;
/// Small offsets while looking at the listener, radians: from eye to eye to mouth. Designed.
const ON_FACE_RAD: f64 = 0.012;
/// Minimum and maximum angle of a look aside, radians, and the mean of the part above the minimum.
/// Designed; Lee et al. have a mean of 6.9° including the head's part.
const ASIDE_RAD: [f64; 3] = [0.06, 0.2, 0.05];
/// Mean length of a small step aside, radians. Designed.
const STEP_RAD: f64 = 0.025;
/// Time of a saccade of no length, seconds, and per radian (Lee et al. 2002: 20 to 30 ms and
/// 2 to 2.7 ms a degree).
const SACCADE_SECS: [f64; 2] = [0.025, 0.0024 * 180.0 / core::f64::consts::PI];
/// Frequencies of saccades to the right, up right, up and so on counter-clockwise, in percent (Lee
/// et al. 2002, table 1).
const DIRECTIONS: [f64; 8] = [15.54, 6.46, 17.69, 7.44, 16.80, 7.89, 20.38, 7.80];
/// Correlation of neighbouring accents in having a glance. Designed: with 0.7 of the accents this
/// makes glances of 3 s on average, as Lee et al. measured in speakers (94 frames at 30 frames per
/// second at the listener, 28 away).
const PERSISTENCE: f64 = 1.0 / 3.0;
/// Decrease of the share of the next glance after a surplus glance. Designed.
const CORRECTION: f64 = 0.15;
/// Increase of the share of glances at the listener at tension 1, decrease at 0. Designed.
const TENSION_GLANCES: f64 = 0.2;
/// Between two demands the eyes go aside in this time or not at all, seconds.
const MIN_GAP_SECS: f64 = 0.12;
/// Time for a small movement, seconds.
const STEP_SECS: f64 = 0.05;
/// Small movements between two demands at most; more are in no pause of a turn.
const MAX_ROVES: usize = 6;
/// Minimum duration of the look at the listener that begins a question, seconds. Designed.
const ASKING_SECS: f64 = 0.3;
/// Time before a turn at which the speaker looks away, and time after it until which this lasts,
/// seconds. Designed.
const TURN_SECS: [f64; 2] = [0.35, 0.6];
/// Time for which a speaker looks at the listener after ending, seconds. Designed.
const AFTER_TURN_SECS: f64 = 1.2;
/// Share of the head in a look aside, away, and in thought. Designed.
const HEAD_ASIDE: f64 = 0.25;
const HEAD_AWAY: f64 = 0.5;
/// Share of the head in a look at a referent or a character. Designed.
const HEAD_REFERENT: f64 = 0.7;
/// Duration of the head turn, seconds. Designed.
const HEAD_SECS: f64 = 0.45;
/// Factor by which a speaker who searches for a word moves more slowly (F&H section 4.2.1).
const THINKING_SLOWER: f64 = 1.8;

/// Purpose of a gaze demand.
#[derive(Clone, Copy, Debug, PartialEq)]
enum GazePurpose {
    /// A look at the listener.
    Listener,
    /// Do not; the eyes are aside when it begins.
    Aside,
    /// Do not; the eyes may go aside when it begins.
    AsideNow,
    /// Turn away.
    Away,
    /// A fixed direction, yaw (left) and pitch (down).
    Place([f64; 2]),
    /// Direction of a referent or a character, likewise.
    Referent([f64; 2]),
}

/// Look at a place: its span, seconds, and its direction relative to the listener, yaw (left) and
/// pitch (down), radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlacedLook {
    pub(crate) start_secs: f64,
    pub(crate) end_secs: f64,
    pub(crate) direction_rad: [f64; 2],
}

/// A gaze demand over a span of time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct GazeDemand {
    start_secs: f64,
    end_secs: f64,
    want: GazePurpose,
    /// Priority; of overlapping demands the one with the higher rank applies.
    rank: u8,
}

/// Gaze of a speaker over a story: yaw (left) and pitch (down) of eyes and head, relative to the
/// listener.
#[derive(Clone, Debug, Default)]
pub(super) struct Gaze {
    /// The whole of it.
    pub(super) eyes: [Track; 2],
    /// The head's part.
    pub(super) head: [Track; 2],
}

impl Gaze {
    /// Plans the gaze of all turns.
    pub(super) fn new(
        heard: &SpeechFeatures,
        (thoughts, looks): (&[ThinkingPause], &[PlacedLook]),
        discourse: &Discourse,
        manner: &Manner,
        seed: u64,
    ) -> Self {
        let mut all = demands(heard, thoughts, discourse, manner, seed);
        all.extend(looks.iter().map(|look| GazeDemand {
            start_secs: look.start_secs,
            end_secs: look.end_secs,
            want: GazePurpose::Referent(look.direction_rad),
            rank: 3,
        }));
        sort_by_number(&mut all, |d| d.start_secs);
        let demands = resolved(all);
        let mut way = GazePlan {
            gaze: Self::default(),
            at: [0.0; 2],
            seed,
            count: 0,
            amount: manner.gaze,
        };
        let mut free_secs = f64::NEG_INFINITY;
        for (i, demand) in demands.iter().enumerate() {
            way.satisfy(demand, free_secs);
            free_secs = demand.end_secs;
            // The gaze returns before a long silence, in which other behaviours decide.
            let silent_secs = demands
                .get(i + 1)
                .map_or(f64::INFINITY, |d| d.start_secs - free_secs);
            if silent_secs > AFTER_TURN_SECS {
                way.shift_gaze(free_secs, [0.0; 2], 0.0, 1.0);
            }
        }
        way.gaze
    }
}

/// Returns all gaze demands of speech, pauses and thought, sorted by time.
fn demands(
    heard: &SpeechFeatures,
    thoughts: &[ThinkingPause],
    discourse: &Discourse,
    manner: &Manner,
    seed: u64,
) -> Vec<GazeDemand> {
    let mut all = Vec::new();
    let mut demand = |span: [f64; 2], want: GazePurpose, rank: u8| {
        all.push(GazeDemand {
            start_secs: span[0],
            end_secs: span[1],
            want,
            rank,
        });
    };
    // Accents and pauses in one row: the eyes leave the listener only where there is time
    // to, and the changes that this forces are made good elsewhere.
    let accents = heard
        .stresses
        .iter()
        .map(|s| (s.start_secs, s.end_secs, true));
    let pauses = heard.pauses.iter().filter_map(|p| {
        let part = matches!(p.parts, BoundaryKind::Phrases | BoundaryKind::Sentences);
        part.then_some((p.start_secs, p.end_secs, false))
    });
    let mut moments: Vec<(f64, f64, bool)> = accents.chain(pauses).collect();
    sort_by_number(&mut moments, |m| m.0);
    let (mut looks, mut excess, mut free_secs) = (true, 0.0, f64::NEG_INFINITY);
    for (i, (start, end, is_accent)) in moments.into_iter().enumerate() {
        let chance = noise::unit(seed, stream::GLANCE, i as i64);
        if heard.question_at(start).is_some() {
            (looks, free_secs) = (true, end);
            demand([start, end], GazePurpose::Listener, 2);
        } else if is_accent {
            let same = if looks { PERSISTENCE } else { 0.0 };
            // At the climax the eyes hold the listener.
            let tense = TENSION_GLANCES * (2.0 * discourse.tension_at(start) - 1.0);
            let mean = (manner.accent_glances * (1.0 + tense)).min(1.0);
            let share = mean * (1.0 - PERSISTENCE) + same - CORRECTION * excess;
            looks = chance < share || looks && start - free_secs < MIN_GAP_SECS;
            excess += f64::from(u8::from(looks)) - mean;
            excess = excess.clamp(-5.0, 5.0);
            let want = if looks {
                GazePurpose::Listener
            } else {
                GazePurpose::Aside
            };
            free_secs = end;
            demand([start, end], want, 2);
        } else {
            looks = chance < manner.pause_glances;
            let want = if looks {
                GazePurpose::Listener
            } else {
                GazePurpose::AsideNow
            };
            // Time to go aside before the next word.
            free_secs = end - MIN_GAP_SECS.min(0.4 * (end - start));
            demand([start, free_secs], want, 2);
        }
    }
    for thought in thoughts {
        demand(
            [thought.start_secs, thought.end_secs],
            GazePurpose::Place(thought.place),
            3,
        );
    }
    for question in &heard.questions {
        let (start, end) = (question.start_secs, question.end_secs);
        let last_word = question.last_word_secs[0].max(start + ASKING_SECS);
        demand([start, start + ASKING_SECS], GazePurpose::Listener, 4);
        demand([last_word, end], GazePurpose::Listener, 4);
    }
    for [start, last_word, end] in &heard.turns {
        demand(
            [start - TURN_SECS[0], start + TURN_SECS[1]],
            GazePurpose::Away,
            1,
        );
        demand(
            [*last_word, end + AFTER_TURN_SECS],
            GazePurpose::Listener,
            4,
        );
    }
    sort_by_number(&mut all, |d| d.start_secs);
    all
}

/// Demands that do not overlap: of two at a time the one of higher rank, else the earlier.
fn resolved(all: Vec<GazeDemand>) -> Vec<GazeDemand> {
    /// Minimum duration of a demand, seconds; shorter ones are ignored.
    const MIN_SECS: f64 = 0.02;
    let mut kept: Vec<GazeDemand> = Vec::with_capacity(all.len());
    for mut demand in all {
        while let Some(last) = kept.last_mut() {
            if last.end_secs <= demand.start_secs {
                break;
            }
            if demand.rank <= last.rank {
                demand.start_secs = last.end_secs;
                break;
            }
            last.end_secs = demand.start_secs;
            if last.end_secs - last.start_secs >= MIN_SECS {
                break;
            }
            kept.pop();
        }
        if demand.end_secs - demand.start_secs >= MIN_SECS {
            kept.push(demand);
        }
    }
    kept
}

/// The gaze while it is planned.
struct GazePlan {
    gaze: Gaze,
    /// Direction of the eyes.
    at: [f64; 2],
    seed: u64,
    count: i64,
    amount: f64,
}

impl GazePlan {
    fn unit(&mut self) -> f64 {
        self.count += 1;
        noise::unit(self.seed, stream::GAZE, self.count)
    }

    /// Moves the eyes to the direction of a demand. They may move from `free_secs` on.
    fn satisfy(&mut self, demand: &GazeDemand, free_secs: f64) {
        let start = demand.start_secs;
        let gap_secs = start - free_secs;
        // Before a turn one listens.
        if demand.want != GazePurpose::Away {
            self.rove(free_secs, start - MIN_GAP_SECS);
        }
        let is_away = self.is_away();
        // A random time before the demand, early enough to arrive at its start.
        let early = |way: &mut Self, lead_secs: f64| {
            let room_secs = gap_secs.min(0.5) - lead_secs;
            (room_secs >= 0.0).then(|| start - lead_secs - way.unit() * room_secs)
        };
        match demand.want {
            GazePurpose::Listener if is_away => {
                let to = self.on_face();
                self.shift_gaze(start, to, 0.0, 1.0);
            }
            GazePurpose::Listener => {
                if let Some(from) = early(self, STEP_SECS) {
                    let to = self.on_face();
                    self.shift_gaze(from, to, 0.0, 1.0);
                }
            }
            GazePurpose::Aside => {
                if let Some(from) = early(self, MIN_GAP_SECS)
                    && !is_away
                {
                    let to = self.aside(false);
                    self.shift_gaze(from, to, HEAD_ASIDE, 1.0);
                }
            }
            GazePurpose::AsideNow => {
                let to = self.aside(is_away);
                self.shift_gaze(start, to, HEAD_ASIDE, 1.0);
            }
            GazePurpose::Away => {
                let side = if self.unit() < 0.5 { -1.0 } else { 1.0 };
                let to = [side * (0.2 + 0.1 * self.unit()), 0.05 + 0.07 * self.unit()];
                let to = to.map(|a| a * self.amount);
                self.shift_gaze(start, to, HEAD_AWAY, 1.0);
            }
            GazePurpose::Referent(to) => {
                self.shift_gaze(start, to.map(|a| a * self.amount), HEAD_REFERENT, 1.0);
            }
            GazePurpose::Place(to) => {
                self.shift_gaze(
                    start,
                    to.map(|a| a * self.amount),
                    HEAD_AWAY,
                    THINKING_SLOWER,
                );
            }
        }
    }

    /// Adds small movements while there is no demand, so the eyes are never still for long: over
    /// the face, or from direction to direction aside.
    fn rove(&mut self, from_secs: f64, to_secs: f64) {
        let mut at_secs = from_secs;
        for _ in 0..MAX_ROVES {
            at_secs += 0.08 + 0.6 * self.unit();
            if at_secs >= to_secs - STEP_SECS || !at_secs.is_finite() {
                return;
            }
            if self.is_away() {
                let to = self.aside(true);
                self.shift_gaze(at_secs, to, HEAD_ASIDE, 1.0);
            } else {
                let to = self.on_face();
                self.shift_gaze(at_secs, to, 0.0, 1.0);
            }
        }
    }

    fn is_away(&self) -> bool {
        ops::hypot(self.at[0], self.at[1]) > AT_LISTENER_RAD
    }

    /// Moves eyes and head.
    fn shift_gaze(&mut self, from_secs: f64, to: [f64; 2], head_share: f64, slower: f64) {
        // After the movement before.
        let from_secs = from_secs.max(self.gaze.eyes[0].end_secs());
        let way = ops::hypot(to[0] - self.at[0], to[1] - self.at[1]);
        let secs = slower * (SACCADE_SECS[0] + SACCADE_SECS[1] * way);
        for (track, to) in self.gaze.eyes.iter_mut().zip(to) {
            track.move_to(from_secs, secs, to);
        }
        for (track, to) in self.gaze.head.iter_mut().zip(to) {
            track.move_to(from_secs + 0.04, slower * HEAD_SECS, head_share * to);
        }
        self.at = to;
    }

    /// Returns a random gaze direction within the listener's face: yaw and pitch, radians.
    fn on_face(&mut self) -> [f64; 2] {
        [0, 1].map(|_| ON_FACE_RAD * (2.0 * self.unit() - 1.0) * self.amount.min(1.0))
    }

    /// Returns a direction aside, near the present one if the eyes are already aside.
    fn aside(&mut self, is_away: bool) -> [f64; 2] {
        let [least, most, mean] = ASIDE_RAD;
        let mean = if is_away { STEP_RAD } else { mean };
        let length = -mean * ops::ln(1.0 - 0.98 * self.unit());
        let (sin, cos) = ops::sincos(self.direction());
        let from = if is_away {
            self.at
        } else {
            [least * cos, least * sin]
        };
        let to = [from[0] + length * cos, from[1] + length * sin];
        let distance = ops::hypot(to[0], to[1]);
        if distance < 1e-6 {
            return [least * self.amount, 0.0];
        }
        let amount = if is_away { 1.0 } else { self.amount };
        let [least, most] = [least, most].map(|a| a * self.amount);
        let fitted = (amount * distance).clamp(least, most.max(least));
        to.map(|a| a * fitted / distance)
    }

    /// Returns a random direction of a saccade as an angle from left towards down, radians.
    fn direction(&mut self) -> f64 {
        let mut left = self.unit() * DIRECTIONS.iter().sum::<f64>();
        let mut eighth = 0.0;
        for share in DIRECTIONS {
            if left < share {
                break;
            }
            left -= share;
            eighth += 1.0;
        }
        // The table turns from the right over up; yaw is positive to the left and pitch down.
        let turned = (eighth + self.unit() - 0.5) * core::f64::consts::FRAC_PI_4;
        core::f64::consts::PI + turned
    }
}

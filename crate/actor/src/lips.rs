//! Lip synchronisation: phones to mouth channels with coarticulation.
//!
//! The dominance model of Cohen and Massaro as in F&H section 3.1.3: each channel is the average of
//! the phones' targets weighted by α·exp(−θ·|τ|), over the current phone and eleven to either side,
//! the twelfth fading by a Hermite step. Closures are held: p, b from their start to the release,
//! m, f, v throughout; silence keeps its dominance over its length, so that the mouth closes and
//! stays closed. A gate shuts the lips in a closure regardless of its neighbours, because viewers
//! first notice a gap in a "p". With the gate, closures need no overwhelming dominance, and the
//! adjacent vowels open as they should.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::ops;
use raconteur_speech::Phone;
use raconteur_speech::phones::{CHANNELS, Channel, Class, PhoneRow, PhoneTargets};

/// Segments considered to either side (F&H 3.1.3: the greatest known reach of
/// coarticulation).
const REACH: usize = 11;
/// Time at which a diphthong turns to its glide, as a share of its length. Designed.
const GLIDE_AT: f64 = 0.55;
/// Time of release of p and b, as a share of their length; the burst follows. Designed.
const RELEASE_AT: f64 = 0.75;
/// Dominance magnitude over lip opening of a held closure in the average. Its own (12 to 25) would
/// flatten the neighbouring vowels, and the gate closes the lips anyway.
const HELD_ALPHA: f64 = 1.5;
/// Time in which lips close before a closure and open after it, seconds. Designed; measured lip
/// closing gestures take 50 to 100 ms in all.
const CLOSING_SECS: f64 = 0.055;
const OPENING_SECS: f64 = 0.05;
/// Lead of closures over their sound, seconds: skin follows muscles with a delay of about this.
/// Designed.
const AHEAD_SECS: f64 = 0.016;
/// The same lead for a lower lip that moves to the teeth, a longer path. Designed.
const BITE_AHEAD_SECS: f64 = 0.026;
/// Time in which silence closes the mouth, and in which the mouth leaves it before the next phone,
/// seconds. Designed.
const SILENCE_CLOSES_SECS: f64 = 0.10;
const SILENCE_OPENS_SECS: f64 = 0.12;
/// Time before and after an utterance in which the mouth may still move, seconds.
const MARGIN_SECS: f64 = 0.6;

/// State of the mouth at one time: mouth channels, lip pressing and lip biting; drives lips, jaw
/// and tongue.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MouthTargets {
    /// The ten channels in the order of [`Channel`].
    pub channels: [f64; CHANNELS],
    /// Pressure of a bilabial on the lips, 0..1.
    pub press: f64,
    /// Closure of the lower lip against the upper teeth (f, v), 0..1.
    pub bite: f64,
}

impl MouthTargets {
    /// Returns the state of a mouth fully at the targets of one phone.
    #[must_use]
    pub fn from_phone(phone: &PhoneTargets) -> Self {
        let held = |classes: &[Class]| f64::from(u8::from(classes.contains(&phone.class)));
        Self {
            channels: phone.channels,
            press: held(&[Class::BilabialStop, Class::BilabialNasal]),
            bite: held(&[Class::Labiodental]),
        }
    }

    /// Returns the value of one mouth channel.
    #[must_use]
    pub fn channel(&self, channel: Channel) -> f64 {
        self.channels[channel as usize]
    }
}

/// Lip synchronisation of one utterance: phones with their dominance functions for coarticulation
/// (F&H section 3.1.3).
#[derive(Clone, Debug)]
pub struct LipTrack {
    segments: Vec<LipSegment>,
    starts: Vec<f64>,
}

/// A phone, or a part of a diphthong.
#[derive(Clone, Copy, Debug)]
struct LipSegment {
    start: f64,
    end: f64,
    /// Dominance stays at its peak between these; equal when there is one peak.
    held: [f64; 2],
    targets: &'static PhoneTargets,
    /// Dominance magnitudes for opening, rounding, spreading and tongue.
    alphas: [f64; 4],
}

impl LipTrack {
    /// Creates the track from an utterance's phones (seconds from its start, ascending): a segment
    /// for each, two for a diphthong, with the interval of constant dominance. The utterance is
    /// assumed to have silence on both sides.
    #[must_use]
    pub fn new(phones: &[Phone]) -> Self {
        let mut segments = Vec::with_capacity(phones.len() + 8);
        let first = phones.first().map_or(0.0, |p| p.start_secs);
        let last = phones.last().map_or(0.0, |p| p.end_secs);
        let silence = PhoneRow::SILENCE.targets();
        segments.push(LipSegment::new(silence, first - MARGIN_SECS, first));
        for phone in phones {
            let targets = phone.row.targets();
            let (start, end) = (phone.start_secs, phone.end_secs.max(phone.start_secs));
            match targets.glide() {
                Some(glide) => {
                    let turn = lerp(start, end, GLIDE_AT);
                    segments.push(LipSegment::new(targets, start, turn));
                    segments.push(LipSegment::new(glide, turn, end));
                }
                None => segments.push(LipSegment::new(targets, start, end)),
            }
        }
        segments.push(LipSegment::new(silence, last, last + MARGIN_SECS));
        Self::from_segments(segments)
    }

    fn from_segments(segments: Vec<LipSegment>) -> Self {
        let starts = segments.iter().map(|s| s.start).collect();
        Self { segments, starts }
    }

    /// Returns the segments in order, for plots of dominance: name of the phone's row, start, end,
    /// and the interval of its peak (seconds from the utterance's start), its magnitudes for
    /// opening, rounding, spreading and tongue, and the rates at which it rises before and falls
    /// after the peak, 1/s: α·exp(−θ·|τ|) (F&H 3.1.3).
    pub fn segments(&self) -> impl Iterator<Item = (&'static str, [f64; 10])> {
        self.segments.iter().map(|s| {
            let ([held, until], [o, r, w, g]) = (s.held, s.alphas);
            let [before, after] = s.targets.thetas_per_s;
            let numbers = [s.start, s.end, held, until, o, r, w, g, before, after];
            (s.targets.name, numbers)
        })
    }

    /// Returns true if the mouth may move at this offset.
    #[must_use]
    pub fn covers(&self, offset_secs: f64) -> bool {
        let first = self.segments.first().map_or(0.0, |s| s.start);
        let last = self.segments.last().map_or(0.0, |s| s.end);
        (first..=last).contains(&offset_secs)
    }

    /// Returns the state of the mouth at an offset from the start of the utterance, seconds. O(log
    /// n), no allocation.
    #[must_use]
    pub fn sample(&self, offset_secs: f64) -> MouthTargets {
        let t = offset_secs;
        let Some(last) = self.segments.len().checked_sub(1) else {
            return MouthTargets::default();
        };
        let now = self
            .starts
            .partition_point(|s| *s <= t)
            .saturating_sub(1)
            .min(last);
        let current = &self.segments[now];
        let passed = smooth((t - current.start) / (current.end - current.start).max(1e-6));
        let from = now.saturating_sub(REACH + 1);
        let to = (now + REACH + 1).min(last);

        let mut sums = [0.0; CHANNELS];
        let mut weights = [0.0; CHANNELS];
        for (i, segment) in self.segments.iter().enumerate().take(to + 1).skip(from) {
            let window = if i + REACH < now {
                1.0 - passed
            } else if i > now + REACH {
                passed
            } else {
                1.0
            };
            let decay = window * segment.decay(t);
            for c in 0..CHANNELS {
                let weight = segment.alphas[Channel::ALPHA[c]] * decay;
                sums[c] += weight * segment.targets.channels[c];
                weights[c] += weight;
            }
        }
        let mut channels = [0.0; CHANNELS];
        for c in 0..CHANNELS {
            if weights[c] > 1e-12 {
                channels[c] = sums[c] / weights[c];
            }
        }
        self.close(t, now, channels)
    }

    /// Applies the closures near a time.
    fn close(&self, t: f64, now: usize, mut channels: [f64; CHANNELS]) -> MouthTargets {
        let mut out = MouthTargets::default();
        // Parts of a diphthong can be as short as 20 ms: three of them and the rest of the current
        // one last longer than a lip closure.
        let near = now.saturating_sub(2)..(now + 5).min(self.segments.len());
        for segment in &self.segments[near] {
            let gate = segment.gate(t);
            if gate <= 0.0 {
                continue;
            }
            for c in [
                Channel::Jaw,
                Channel::LipOpen,
                Channel::DeprLabii,
                Channel::Mentalis,
            ] {
                let c = c as usize;
                channels[c] = lerp(channels[c], segment.targets.channels[c], gate);
            }
            match segment.targets.class {
                Class::Labiodental => out.bite = out.bite.max(gate),
                Class::Silence => {}
                _ => out.press = out.press.max(gate),
            }
        }
        out.channels = channels;
        out
    }
}

impl LipSegment {
    fn new(targets: &'static PhoneTargets, start: f64, end: f64) -> Self {
        let length = end - start;
        let held = match targets.class {
            Class::BilabialStop => [start, start + RELEASE_AT * length],
            Class::BilabialNasal | Class::Labiodental => [start, end],
            Class::Silence => {
                let a = start + SILENCE_CLOSES_SECS.min(0.5 * length);
                [a, (end - SILENCE_OPENS_SECS).max(a)]
            }
            _ => [start + 0.5 * length; 2],
        };
        let [open, round, spread, tongue] = targets.alphas;
        let open = match targets.class {
            Class::BilabialStop | Class::BilabialNasal | Class::Labiodental => open.min(HELD_ALPHA),
            _ => open,
        };
        Self {
            start,
            end,
            held,
            targets,
            alphas: [open, round, spread, tongue],
        }
    }

    /// Returns exp(−θ·|τ|); 1 while held.
    fn decay(&self, t: f64) -> f64 {
        let [before, after] = self.targets.thetas_per_s;
        ops::exp(-(before * (self.held[0] - t).max(0.0) + after * (t - self.held[1]).max(0.0)))
    }

    /// Returns the strength of the segment's closure, 0..1.
    fn gate(&self, t: f64) -> f64 {
        let mut ahead = AHEAD_SECS;
        let (firm, closing, opening) = match self.targets.class {
            Class::BilabialStop | Class::BilabialNasal => (1.0, CLOSING_SECS, OPENING_SECS),
            Class::Labiodental => {
                ahead = BITE_AHEAD_SECS;
                (1.0, CLOSING_SECS, OPENING_SECS)
            }
            // Only a real pause; the mouth closes over its first tenth of a second.
            Class::Silence if self.end - self.start > SILENCE_CLOSES_SECS + SILENCE_OPENS_SECS => {
                (1.0, 1.6 * SILENCE_CLOSES_SECS, 1.2 * SILENCE_OPENS_SECS)
            }
            _ => return 0.0,
        };
        let early = smooth((t - self.held[0] + closing + ahead) / closing);
        let late = 1.0 - smooth((t - self.held[1]) / opening);
        firm * early * late
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::noise;

    fn phone(symbol: &str, start_secs: f64, end_secs: f64) -> Phone {
        Phone::new(symbol, start_secs, end_secs, None)
    }

    const SOME: [&str; 24] = [
        "aa", "ae", "ah", "ao", "aw", "ay", "eh", "er", "ey", "iy", "ow", "oy", "uw", "d", "k",
        "s", "sh", "th", "l", "r", "w", "n", "hh", "z",
    ];

    /// Creates a random test utterance in which every fourth phone is `every`.
    fn random(every: &str, seed: u64) -> Vec<Phone> {
        let mut t = 0.0;
        (0..60)
            .map(|i| {
                let length = 0.045 + 0.12 * noise::unit(seed, 1, i);
                let pick = (noise::unit(seed, 2, i) * SOME.len() as f64) as usize;
                let symbol = if i % 4 == 2 {
                    every
                } else {
                    SOME[pick.min(SOME.len() - 1)]
                };
                t += length;
                phone(symbol, t - length, t)
            })
            .collect()
    }

    #[test]
    fn one_segment_alone_returns_its_own_target() {
        for symbol in ["aa", "iy", "uw", "s", "w"] {
            let targets = PhoneRow::named(symbol).expect("a row").targets();
            let track = LipTrack::from_segments(vec![LipSegment::new(targets, 0.0, 0.2)]);
            for i in -20..40 {
                let m = track.sample(f64::from(i) * 0.01);
                for (value, wanted) in m.channels.iter().zip(targets.channels) {
                    assert!((value - wanted).abs() < 1e-12, "{symbol}");
                }
            }
        }
    }

    #[test]
    fn bilabials_close_the_lips_in_any_context() {
        for (k, every) in ["p", "b", "m"].into_iter().cycle().take(60).enumerate() {
            let list = random(every, k as u64);
            let track = LipTrack::new(&list);
            for p in list.iter().filter(|p| p.symbol == every) {
                let share = if every == "m" { 1.0 } else { RELEASE_AT };
                for i in 0..=10 {
                    let t = lerp(
                        p.start_secs,
                        lerp(p.start_secs, p.end_secs, share),
                        f64::from(i) / 10.0,
                    );
                    let m = track.sample(t);
                    assert!(
                        m.channel(Channel::LipOpen) < 0.03,
                        "{every} {}",
                        m.channel(Channel::LipOpen)
                    );
                    assert!(m.channel(Channel::Jaw) < 0.08, "bilabials close the jaw");
                    assert!(m.press > 0.97, "bilabials press the lips");
                }
            }
        }
    }

    #[test]
    fn labiodentals_bring_the_lip_to_the_teeth() {
        let list = random("f", 4);
        let track = LipTrack::new(&list);
        for p in list.iter().filter(|p| p.symbol == "f") {
            let m = track.sample(0.5 * (p.start_secs + p.end_secs));
            assert!(m.bite > 0.89 && m.channel(Channel::LipOpen) < 0.16, "{m:?}");
        }
    }

    #[test]
    fn silence_closes_the_mouth() {
        let mut list = random("aa", 8);
        let t = list.last().map_or(0.0, |p| p.end_secs);
        list.push(phone("pau", t, t + 0.5));
        list.push(phone("aa", t + 0.5, t + 0.8));
        let track = LipTrack::new(&list);
        for t in [t + 0.15, t + 0.25, t + 0.35, -0.5, t + 1.3] {
            let m = track.sample(t);
            assert!(
                m.channel(Channel::LipOpen) < 0.03 && m.channel(Channel::Jaw) < 0.03,
                "{t} {m:?}"
            );
        }
        assert_eq!(LipTrack::new(&[]).sample(0.3).channel(Channel::Jaw), 0.0);
    }

    #[test]
    fn the_mouth_never_jumps() {
        let mut worst: f64 = 0.0;
        for seed in 0..40 {
            let list = random(["p", "pau", "f", "m"][seed as usize % 4], seed);
            let track = LipTrack::new(&list);
            let end = list.last().map_or(0.0, |p| p.end_secs) + 0.6;
            let mut last = track.sample(-0.6);
            for i in 0..((end + 0.6) * 1000.0) as i32 {
                let m = track.sample(-0.6 + f64::from(i) * 1e-3);
                for c in 0..CHANNELS {
                    worst = worst.max((m.channels[c] - last.channels[c]).abs());
                }
                last = m;
            }
        }
        // 0.65 of jaw or lip in the 50 ms of a release, at 1.5 times the mean speed.
        assert!(worst < 0.03, "{worst} a millisecond");
    }

    #[test]
    fn vowels_open_and_rounding_begins_early() {
        let list = [
            phone("s", 0.0, 0.1),
            phone("t", 0.1, 0.17),
            phone("uw", 0.17, 0.35),
        ];
        let track = LipTrack::new(&list);
        assert!(
            track.sample(0.26).channel(Channel::Protrude) > 0.6,
            "the rounded vowel protrudes the lips"
        );
        assert!(
            track.sample(0.08).channel(Channel::Protrude) > 0.15,
            "rounding begins before the vowel"
        );
        let between = LipTrack::new(&[
            phone("b", 0.0, 0.08),
            phone("aa", 0.08, 0.22),
            phone("b", 0.22, 0.3),
        ]);
        assert!(
            between.sample(0.15).channel(Channel::Jaw) > 0.35,
            "the jaw stays open between vowels"
        );
        let open = LipTrack::new(&[phone("k", 0.0, 0.08), phone("aa", 0.08, 0.25)]);
        assert!(
            open.sample(0.165).channel(Channel::Jaw) > 0.45,
            "the jaw opens for the vowel"
        );
    }
}

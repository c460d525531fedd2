//! Instruments: each converts one note to audio samples.
//!
//! All are made from a few textbook parts: sawtooths without aliasing, plucked strings after
//! Karplus and Strong (1983, doi:10.2307/3680062), frequency modulation after Chowning (1973),
//! filters after Simper (2013) and shaped noise. Levels, times and filters are set by ear and
//! spectrogram: designed.

use serde::Deserialize;

use super::drum;
use super::note::Note;
use super::signal::{Filter, Noise, RATE_HZ, Stereo, add, frequency_hz, sine};

/// Instrument of the built-in synthesiser.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Instrument {
    /// A soft choir of sawtooths.
    Pad,
    /// Bowed strings, brighter than the pad, with a swell within each note.
    Strings,
    /// A plucked string, as of a guitar.
    Pluck,
    /// A plucked string, muted, with a low body.
    Bass,
    /// An electric piano.
    Piano,
    /// A glass bell.
    Bell,
    /// A wooden bar, struck.
    Marimba,
    /// A flute.
    Flute,
    /// Bright lead of three sawtooths.
    Lead,
    Kick,
    Snare,
    Clap,
    Hat,
    OpenHat,
    Shaker,
    Tom,
    Crash,
    /// Noise that rises through the length of the note.
    Riser,
}

impl Instrument {
    /// Adds a note to a channel pair, which ends at the end of the piece. `noise` is the note's
    /// own.
    pub(crate) fn play(self, note: &Note, noise: &mut Noise, out: &mut Stereo) {
        match self {
            Self::Pad => ensemble(note, noise, out, &PAD),
            Self::Strings => ensemble(note, noise, out, &STRINGS),
            Self::Lead => ensemble(note, noise, out, &LEAD),
            Self::Pluck => string(note, noise, out, &GUITAR),
            Self::Bass => string(note, noise, out, &BASS),
            Self::Piano => modulated(note, noise, out, &PIANO),
            Self::Bell => modulated(note, noise, out, &BELL),
            Self::Marimba => marimba(note, noise, out),
            Self::Flute => flute(note, noise, out),
            Self::Kick => drum::kick(note, out),
            Self::Tom => drum::tom(note, out),
            Self::Snare => drum::snare(note, noise, out),
            Self::Clap => drum::clap(note, noise, out),
            Self::Hat => drum::hat(note, noise, out, 0.035),
            Self::OpenHat => drum::hat(note, noise, out, 0.22),
            Self::Shaker => drum::shaker(note, noise, out),
            Self::Crash => drum::crash(note, noise, out),
            Self::Riser => drum::riser(note, noise, out),
        }
    }
}

/// Returns the amplitude of a held note: linear attack and release, both in seconds.
fn envelope(t: f64, length: f64, attack: f64, release: f64) -> f64 {
    let up = (t / attack).min(1.0);
    let down = 1.0 - ((t - length) / release).clamp(0.0, 1.0);
    // A square sounds rounder than a straight line.
    up * down * down
}

/// A choir of sawtooths through a filter that opens and closes with the note.
struct Ensemble {
    voices: usize,
    /// Detuning of the outer voices, share of the frequency.
    detune: f64,
    attack: f64,
    release: f64,
    /// The filter at rest and fully open, multiples of the frequency.
    cutoff: [f64; 2],
    /// Opening time of the filter, seconds.
    opening: f64,
    level: f64,
}

const PAD: Ensemble = Ensemble {
    voices: 5,
    detune: 0.0045,
    attack: 0.35,
    release: 0.9,
    cutoff: [1.8, 3.2],
    opening: 1.2,
    level: 0.11,
};
const STRINGS: Ensemble = Ensemble {
    voices: 7,
    detune: 0.0055,
    attack: 0.18,
    release: 0.45,
    cutoff: [2.5, 6.5],
    opening: 0.5,
    level: 0.10,
};
const LEAD: Ensemble = Ensemble {
    voices: 3,
    detune: 0.0035,
    attack: 0.012,
    release: 0.16,
    cutoff: [9.0, 4.5],
    opening: 0.25,
    level: 0.13,
};

fn ensemble(note: &Note, noise: &mut Noise, out: &mut Stereo, how: &Ensemble) {
    let pitch_hz = frequency_hz(note.pitch);
    let mut voices: Vec<(f64, f64, f64)> = (0..how.voices)
        .map(|i| {
            let side = 2.0 * i as f64 / (how.voices - 1) as f64 - 1.0;
            let step = pitch_hz * (1.0 + how.detune * side) / RATE_HZ;
            // Voices alternate between the channels, so that adjacent pitches are separated.
            let pan = if i % 2 == 0 { side } else { -side };
            (noise.unit(), step, pan)
        })
        .collect();
    let mut filters = [Filter::default(), Filter::default()];
    let level = how.level * note.velocity;
    let length = note.length_secs;
    add(out, note.start_secs, length + how.release, |t| {
        let mut sum = [0.0; 2];
        for (phase, step, pan) in &mut voices {
            *phase += *step;
            *phase -= phase.floor();
            let saw = sawtooth(*phase, *step);
            sum[0] += saw * (1.0 - 0.6 * *pan);
            sum[1] += saw * (1.0 + 0.6 * *pan);
        }
        let open = (t / how.opening).min(1.0);
        let multiple = how.cutoff[0] + (how.cutoff[1] - how.cutoff[0]) * open;
        let cutoff_hz = (multiple * pitch_hz + 120.0).min(9000.0);
        let gain = level * envelope(t, length, how.attack, how.release);
        [0, 1].map(|c| gain * filters[c].low(sum[c], cutoff_hz, 0.8))
    });
}

/// Returns a sawtooth with its discontinuity rounded by a polynomial to reduce aliasing (PolyBLEP,
/// Välimäki and Huovilainen 2007, doi:10.1109/MSP.2007.323276).
fn sawtooth(phase: f64, step: f64) -> f64 {
    let plain = 2.0 * phase - 1.0;
    if phase < step {
        let x = phase / step;
        plain - (x + x - x * x - 1.0)
    } else if phase > 1.0 - step {
        let x = (phase - 1.0) / step;
        plain - (x * x + x + x + 1.0)
    } else {
        plain
    }
}

/// Plucked string: a noise burst that circulates in a delay line and loses its brightness.
struct Plucked {
    /// Filter of the burst, Hz: how hard the finger is.
    burst_hz: f64,
    /// Time in which a string of 220 Hz falls by 60 dB, seconds.
    ring_secs: f64,
    /// Brightness retained per round, 0..1.
    bright: f64,
    /// Pluck position, share of the string's length.
    place: f64,
    release: f64,
    /// A sine of the same pitch beneath.
    body: f64,
    level: f64,
}

const GUITAR: Plucked = Plucked {
    burst_hz: 5200.0,
    ring_secs: 3.2,
    bright: 0.75,
    place: 0.21,
    release: 0.35,
    body: 0.0,
    level: 0.42,
};
const BASS: Plucked = Plucked {
    burst_hz: 1500.0,
    ring_secs: 3.0,
    bright: 0.55,
    place: 0.13,
    release: 0.07,
    body: 0.34,
    level: 0.62,
};

fn string(note: &Note, noise: &mut Noise, out: &mut Stereo, how: &Plucked) {
    let pitch_hz = frequency_hz(note.pitch);
    // The averaging filter below delays by `1 - bright` halves of a sample at most.
    let period = RATE_HZ / pitch_hz - (1.0 - how.bright) * 0.5;
    let whole = period.floor() as usize;
    let part = period - whole as f64;
    let mut soften = Filter::default();
    let hardness = how.burst_hz * (0.55 + 0.45 * note.velocity.min(1.5));
    let burst: Vec<f64> = (0..=whole)
        .map(|_| soften.low(noise.signed(), hardness, 0.7))
        .collect();
    // A string plucked at a fifth lacks the fifth partial: the burst less itself, later.
    let comb = ((how.place * period) as usize).max(1);
    let mut line: Vec<f64> = (0..=whole)
        .map(|i| burst[i] - burst[(i + whole + 1 - comb) % (whole + 1)])
        .collect();
    let mean = line.iter().sum::<f64>() / line.len() as f64;
    let power = line.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / line.len() as f64;
    let even = 1.0 / (power.sqrt() + 1e-9);
    line.iter_mut().for_each(|x| *x = (*x - mean) * even);
    // Lower strings ring longer, by the square root of their period.
    let ring = how.ring_secs * (220.0 / pitch_hz).sqrt();
    let loss = libm::pow(0.001, 1.0 / (ring * pitch_hz));
    let (mut at, mut last) = (0, 0.0);
    let level = 0.35 * how.level * note.velocity;
    let length = note.length_secs;
    let pan = 0.25 * noise.signed();
    add(out, note.start_secs, length + how.release, |t| {
        let next = (at + 1) % line.len();
        let read = line[at] * (1.0 - part) + line[next] * part;
        let dull = how.bright * read + (1.0 - how.bright) * 0.5 * (read + last);
        last = read;
        line[at] = loss * dull;
        at = next;
        let body = how.body * 2.4 * sine(t * pitch_hz) * libm::exp(-2.2 * t) * (t / 0.004).min(1.0);
        let end = 1.0 - ((t - length) / how.release).clamp(0.0, 1.0);
        let sound = level * (read + body) * end * (t / 0.001).min(1.0);
        [sound * (1.0 - pan), sound * (1.0 + pan)]
    });
}

/// Frequency modulation: a carrier, a modulator, and a second pair for the stroke.
struct FrequencyModulation {
    /// Frequency of the modulator, multiple of the carrier's.
    ratio: f64,
    /// Modulation index at the stroke and later, radians.
    index: [f64; 2],
    /// Decay rate of the tone, 1/s.
    decay: f64,
    release: f64,
    /// Frequency and level of the stroke's own partial.
    tine: (f64, f64),
    level: f64,
}

const PIANO: FrequencyModulation = FrequencyModulation {
    ratio: 1.0,
    index: [1.9, 0.35],
    decay: 0.75,
    release: 0.25,
    tine: (14.0, 0.055),
    level: 0.26,
};
const BELL: FrequencyModulation = FrequencyModulation {
    ratio: 3.5,
    index: [2.2, 0.25],
    decay: 1.15,
    release: 1.6,
    tine: (7.0, 0.05),
    level: 0.17,
};

fn modulated(note: &Note, noise: &mut Noise, out: &mut Stereo, how: &FrequencyModulation) {
    let pitch_hz = frequency_hz(note.pitch);
    let level = how.level * note.velocity;
    let length = note.length_secs;
    let force = (0.5 + 0.5 * note.velocity).min(1.4);
    // High keys are duller and shorter.
    let high = (pitch_hz / 440.0).sqrt();
    let drift = 0.0006 * (1.0 + noise.unit());
    add(out, note.start_secs, length + how.release, |t| {
        let fall = libm::exp(-how.decay * high * t);
        let index = force / high.max(0.7)
            * (how.index[1] + (how.index[0] - how.index[1]) * libm::exp(-5.0 * t));
        let end = 1.0 - ((t - length) / how.release).clamp(0.0, 1.0);
        let gain = level * fall * end * end * (t / 0.0025).min(1.0);
        let tine = if how.tine.0 * pitch_hz < 12_000.0 {
            how.tine.1 * sine(t * how.tine.0 * pitch_hz) * libm::exp(-11.0 * t)
        } else {
            0.0
        };
        // The two channels are a little out of tune with each other: a chorus.
        [1.0 - drift, 1.0 + drift].map(|tune| {
            let f = pitch_hz * tune;
            let turn = index * sine(t * how.ratio * f) / std::f64::consts::TAU;
            gain * (sine(t * f + turn) + tine)
        })
    });
}

/// Renders a marimba note: three partials that decay quickly, with the ratios of a tuned bar, 1 : 4
/// : 9.2 (Fletcher and Rossing, The Physics of Musical Instruments, 19.4).
fn marimba(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    let pitch_hz = frequency_hz(note.pitch);
    let level = 0.34 * note.velocity;
    let pan = 0.3 * noise.signed();
    let high = (pitch_hz / 262.0).sqrt();
    add(out, note.start_secs, 1.6, |t| {
        let partials = [(1.0, 1.0, 3.6), (4.0, 0.32, 11.0), (9.2, 0.10, 28.0)];
        let mut sum = 0.0;
        for (ratio, share, decay) in partials {
            if ratio * pitch_hz < 14_000.0 {
                sum += share * sine(t * ratio * pitch_hz) * libm::exp(-decay * high * t);
            }
        }
        let sound = level * sum * (t / 0.001).min(1.0) * (1.0 - t / 1.6);
        [sound * (1.0 - pan), sound * (1.0 + pan)]
    });
}

/// Plays a flute: few partials, breath noise, and a delayed vibrato.
fn flute(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    let pitch_hz = frequency_hz(note.pitch);
    let level = 0.2 * note.velocity;
    let length = note.length_secs;
    let mut breath = Filter::default();
    let mut phase = 0.0;
    add(out, note.start_secs, length + 0.22, |t| {
        let swing = ((t - 0.25) / 0.6).clamp(0.0, 1.0);
        let vibrato = 0.0045 * swing * sine(5.1 * t);
        phase += pitch_hz * (1.0 + vibrato) / RATE_HZ;
        let tone = sine(phase)
            + 0.24 * sine(2.0 * phase)
            + 0.09 * sine(3.0 * phase)
            + 0.03 * sine(4.0 * phase);
        let puff = 0.05 + 0.25 * libm::exp(-22.0 * t);
        let air = puff * breath.band(noise.signed(), (2.0 * pitch_hz).min(6000.0), 1.4);
        let gain =
            level * envelope(t, length, 0.07, 0.22) * (1.0 + 0.1 * swing * sine(5.1 * t + 0.2));
        [gain * (tone + air), gain * (tone + 0.9 * air)]
    });
}

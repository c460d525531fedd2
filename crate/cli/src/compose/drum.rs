//! Drums.

use super::note::Note;
use super::signal::{Filter, Noise, Stereo, add, frequency_hz, sine};

/// Adds a drum sound: a sine that falls in pitch (`hz` from and to, `bend` in 1/s) and in level
/// (`decay` in 1/s).
fn thump(note: &Note, out: &mut Stereo, hz: [f64; 2], bend: f64, decay: f64, level: f64) {
    let level = level * note.velocity;
    add(out, note.start_secs, 5.0 / decay, |t| {
        // The integral of the falling frequency.
        let cycles = hz[1] * t + (hz[0] - hz[1]) * (1.0 - libm::exp(-bend * t)) / bend;
        let click = 0.25 * libm::exp(-700.0 * t);
        let sound = level * (sine(cycles) + click) * libm::exp(-decay * t) * (t / 0.0008).min(1.0);
        [sound; 2]
    });
}

pub(crate) fn kick(note: &Note, out: &mut Stereo) {
    thump(note, out, [165.0, 48.0], 38.0, 8.5, 0.95);
}

pub(crate) fn tom(note: &Note, out: &mut Stereo) {
    // The pitch is audible where the score has a degree or note: C3 is 48.
    let hz = if note.pitch > 0.0 {
        frequency_hz(note.pitch)
    } else {
        110.0
    };
    thump(note, out, [1.5 * hz, hz], 14.0, 6.0, 0.6);
}

pub(crate) fn snare(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    let level = 0.42 * note.velocity;
    let mut wires = [Filter::default(), Filter::default()];
    add(out, note.start_secs, 0.32, |t| {
        let shell = 0.7 * (sine(186.0 * t) + 0.6 * sine(331.0 * t)) * libm::exp(-24.0 * t);
        let rattle = libm::exp(-15.0 * t);
        [0, 1].map(|c| {
            level
                * (shell + 1.1 * rattle * wires[c].band(noise.signed(), 3400.0, 0.55))
                * (1.0 - t / 0.32)
        })
    });
}

/// Plays a clap: several hands with small delays, then reverberation.
pub(crate) fn clap(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    const HANDS_SECS: [f64; 3] = [0.0, 0.011, 0.021];
    let level = 0.6 * note.velocity;
    let mut tone = [Filter::default(), Filter::default()];
    add(out, note.start_secs, 0.34, |t| {
        let mut gain = 0.0;
        for at in HANDS_SECS {
            if t >= at {
                gain = libm::exp(-150.0 * (t - at));
            }
        }
        if t >= 0.03 {
            gain += 0.75 * libm::exp(-17.0 * (t - 0.03));
        }
        [0, 1].map(|c| level * gain * tone[c].band(noise.signed(), 1350.0, 0.9) * (1.0 - t / 0.34))
    });
}

pub(crate) fn hat(note: &Note, noise: &mut Noise, out: &mut Stereo, decay_secs: f64) {
    let level = 0.16 * note.velocity;
    let mut bright = [Filter::default(), Filter::default()];
    let length = 5.0 * decay_secs;
    add(out, note.start_secs, length, |t| {
        let gain = level * libm::exp(-t / decay_secs) * (1.0 - t / length) * (t / 0.0006).min(1.0);
        [0, 1].map(|c| gain * bright[c].high(noise.signed(), 7600.0, 0.9))
    });
}

pub(crate) fn shaker(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    let level = 0.13 * note.velocity;
    let mut tone = Filter::default();
    add(out, note.start_secs, 0.13, |t| {
        // The beads take some time to gather.
        let gain = level * (t / 0.018).min(1.0) * libm::exp(-26.0 * t) * (1.0 - t / 0.13);
        let sound = gain * tone.band(noise.signed(), 6200.0, 0.8);
        [0.8 * sound, 1.2 * sound]
    });
}

pub(crate) fn crash(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    let level = 0.2 * note.velocity;
    let mut bright = [Filter::default(), Filter::default()];
    add(out, note.start_secs, 2.6, |t| {
        let gain =
            level * (0.8 * libm::exp(-2.2 * t) + 0.5 * libm::exp(-14.0 * t)) * (1.0 - t / 2.6);
        [0, 1].map(|c| gain * bright[c].high(noise.signed(), 4300.0, 0.7))
    });
}

pub(crate) fn riser(note: &Note, noise: &mut Noise, out: &mut Stereo) {
    let level = 0.16 * note.velocity;
    let length = note.length_secs;
    let mut sweep = [Filter::default(), Filter::default()];
    add(out, note.start_secs, length, |t| {
        let s = t / length;
        let hz = 350.0 * libm::pow(18.0, s);
        let gain = level * s * s * ((length - t) / 0.03).min(1.0);
        [0, 1].map(|c| gain * sweep[c].band(noise.signed(), hz, 1.6))
    });
}

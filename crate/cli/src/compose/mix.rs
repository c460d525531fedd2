//! Mixing of parts to the finished piece: tracks, echo, reverberation, loudness and limiter.

use std::f64::consts::FRAC_1_SQRT_2;

use super::instrument::Instrument;
use super::lufs;
use super::score::{Part, Score, gain};
use super::signal::{Filter, Noise, RATE_HZ, Stereo, sine};

/// Maximum sample level, dB relative to full scale; leaves room for the overshoot of encoders.
const CEILING_DB: f64 = -1.5;

/// Mixes a score at the loudness that it specifies, without clipping.
pub(crate) fn mix(score: &Score, parts: &[Part]) -> Stereo {
    let length = score.length_secs() + score.tail;
    let count = (length * RATE_HZ).round() as usize;
    // In a repeating piece, the tail beyond the end continues at the start.
    let ring = if score.tail == 0.0 {
        (4.0 * RATE_HZ) as usize
    } else {
        0
    };
    let silence = || [vec![0.0; count + ring], vec![0.0; count + ring]];
    let kicks: Vec<f64> = parts
        .iter()
        .filter(|p| p.track.instrument == Instrument::Kick)
        .flat_map(|p| p.notes.iter().map(|n| n.start_secs))
        .collect();
    let [mut dry, mut room, mut echo] = [silence(), silence(), silence()];
    for (number, part) in parts.iter().enumerate() {
        let mut track = silence();
        for (i, note) in part.notes.iter().enumerate() {
            let mut noise = Noise::new(score.seed, number as u64, i as u64);
            let mut note = *note;
            // No two strokes of a hand are alike: half a decibel.
            note.velocity *= 1.0 + 0.06 * noise.signed();
            part.track.instrument.play(&note, &mut noise, &mut track);
        }
        duck(&mut track, part.track.duck, &kicks);
        let level = gain(part.track.level);
        // Equal power to both sides.
        let angle = (part.track.pan.clamp(-1.0, 1.0) + 1.0) / 8.0;
        let sides = [sine(0.25 + angle), sine(angle)].map(|s| s * level / FRAC_1_SQRT_2);
        for c in 0..2 {
            for (i, sample) in track[c].iter().enumerate() {
                let sound = sample * sides[c];
                dry[c][i] += sound;
                room[c][i] += sound * part.track.room;
                echo[c][i] += sound * part.track.echo;
            }
        }
    }
    let echoes = repeat(&echo, 0.75 * 60.0 / score.bpm);
    for c in 0..2 {
        for i in 0..dry[c].len() {
            dry[c][i] += echoes[c][i];
            room[c][i] += 0.3 * echoes[c][i];
        }
    }
    let hall = reverberate(&room);
    for c in 0..2 {
        let mut rumble = Filter::default();
        for i in 0..dry[c].len() {
            dry[c][i] = rumble.high(dry[c][i] + hall[c][i], 28.0, FRAC_1_SQRT_2);
        }
        for i in count..count + ring {
            let late = dry[c][i];
            dry[c][i - count] += late;
        }
        dry[c].truncate(count);
    }
    // Limiting reduces the loudness slightly, so it is set twice.
    for _ in 0..2 {
        let louder = gain(score.loudness - lufs(&dry));
        dry.iter_mut().flatten().for_each(|x| *x *= louder);
        limit(&mut dry);
    }
    dry
}

/// Steps back at each stroke of the kick drum and returns within a third of a second.
fn duck(track: &mut Stereo, amount: f64, kicks_secs: &[f64]) {
    const RETURN_SECS: f64 = 0.32;
    if amount <= 0.0 {
        return;
    }
    for kick in kicks_secs {
        let first = (kick * RATE_HZ) as usize;
        for channel in track.iter_mut() {
            for (i, sample) in channel
                .iter_mut()
                .skip(first)
                .take((RETURN_SECS * RATE_HZ) as usize)
                .enumerate()
            {
                let s = i as f64 / (RETURN_SECS * RATE_HZ);
                // Two milliseconds down, then up along a parabola.
                let down = (i as f64 / (0.002 * RATE_HZ)).min(1.0);
                *sample *= 1.0 - amount * down * (1.0 - s) * (1.0 - s);
            }
        }
    }
}

/// Echoes that change sides.
fn repeat(sent: &Stereo, delay_secs: f64) -> Stereo {
    let delay = (delay_secs * RATE_HZ).round().max(1.0) as usize;
    let mut out = [vec![0.0; sent[0].len()], vec![0.0; sent[1].len()]];
    let mut dull = [Filter::default(), Filter::default()];
    for i in delay..sent[0].len() {
        for c in 0..2 {
            let again = sent[c][i - delay] + 0.42 * out[1 - c][i - delay];
            out[c][i] = dull[c].low(again, 3600.0, FRAC_1_SQRT_2);
        }
    }
    out
}

/// Adds the reverberation of a room: a feedback delay network of eight lines with high-frequency
/// loss (Jot and Chaigne 1991).
fn reverberate(sent: &Stereo) -> Stereo {
    /// Lengths without common factors, samples: walls 9 to 18 m apart.
    const DELAYS: [usize; 8] = [1277, 1487, 1613, 1783, 1931, 2111, 2281, 2473];
    /// Time to fall by 60 dB, seconds.
    const RING_SECS: f64 = 2.1;
    let mut lines: [Vec<f64>; 8] = DELAYS.map(|d| vec![0.0; d]);
    let loss = DELAYS.map(|d| libm::pow(0.001, d as f64 / RATE_HZ / RING_SECS));
    let mut dull = [Filter::default(); 8];
    let mut out = [vec![0.0; sent[0].len()], vec![0.0; sent[1].len()]];
    // The first reflection arrives after 18 ms.
    let early = (0.018 * RATE_HZ) as usize;
    for i in early..sent[0].len() {
        let mut heard = [0.0; 8];
        for (k, line) in lines.iter().enumerate() {
            heard[k] = loss[k] * dull[k].low(line[i % line.len()], 4800.0, FRAC_1_SQRT_2);
        }
        let mean = heard.iter().sum::<f64>() / 4.0;
        for (k, line) in lines.iter_mut().enumerate() {
            let at = i % line.len();
            line[at] = heard[k] - mean + sent[k % 2][i - early];
        }
        for c in 0..2 {
            out[c][i] = 0.35 * (heard[c] - heard[c + 2] + heard[c + 4] - heard[c + 6]);
        }
    }
    out
}

/// Limits every sample to the ceiling: the gain falls smoothly over 5 ms before a peak and recovers
/// over 120 ms.
fn limit(sound: &mut Stereo) {
    let ceiling = gain(CEILING_DB);
    let ahead = (0.005 * RATE_HZ) as usize;
    let count = sound[0].len();
    let wanted: Vec<f64> = (0..count)
        .map(|i| ceiling / sound[0][i].abs().max(sound[1][i].abs()).max(ceiling))
        .collect();
    let back = libm::exp(-1.0 / (0.12 * RATE_HZ));
    // The smallest upcoming gain, held while it is near, released slowly.
    let mut now: f64 = 1.0;
    let mut least = std::collections::VecDeque::new();
    let held: Vec<f64> = (0..count + ahead)
        .map(|i| {
            if i < count {
                while least
                    .back()
                    .is_some_and(|&k: &usize| wanted[k] >= wanted[i])
                {
                    least.pop_back();
                }
                least.push_back(i);
            }
            while least.front().is_some_and(|&k| k + ahead < i) {
                least.pop_front();
            }
            let low = least.front().map_or(1.0, |&k| wanted[k]);
            now = (1.0 - (1.0 - now) * back).min(low);
            now
        })
        .collect();
    // The mean over the look-ahead reaches a peak's value exactly at its time.
    let mut sum: f64 = held[..ahead].iter().sum();
    for i in 0..count {
        sum += held[i + ahead];
        let level = (sum / (ahead + 1) as f64).min(wanted[i]);
        sum -= held[i];
        sound[0][i] *= level;
        sound[1][i] *= level;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limiter_keeps_peaks_below_its_ceiling_and_quiet_passages_alone() {
        let mut sound: Stereo = [0, 1].map(|c| {
            (0..96_000)
                .map(|i| {
                    let loud = if (30_000..60_000).contains(&i) {
                        2.0
                    } else {
                        0.3
                    };
                    loud * sine(220.0 * f64::from(i) / RATE_HZ + 0.1 * f64::from(c))
                })
                .collect()
        });
        let before = sound[0][2_000];
        limit(&mut sound);
        let peak = sound.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(
            peak <= gain(CEILING_DB) + 1e-12 && peak > 0.8 * gain(CEILING_DB),
            "{peak}"
        );
        assert_eq!(sound[0][2_000], before);
    }
}

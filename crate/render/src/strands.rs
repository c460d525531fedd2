//! Strand atlas of the hair cards: 16 strips side by side in u, v from root to tip, from dense to
//! single hairs. Red is coverage, green height within the bundle, blue a number of each strand. It
//! is generated here, from strands that clump, wander and end at random.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{noise, ops};

use crate::texture::Level;

/// Size, texels: a strip is 128 across.
const WIDTH: usize = 2048;
const HEIGHT: usize = 512;
const STRIPS: usize = 16;
const STRIP: usize = WIDTH / STRIPS;
const SEED: u64 = 3;

/// Arrangement of the strands in a strip.
#[derive(Clone, Copy)]
struct Bundle {
    strands: usize,
    clumps: usize,
    /// Share by which strands converge to the middle of their clump at the tip.
    clump: f64,
    /// Deviation of clumps, relative to the strip's width.
    wander: f64,
    /// Deviation of single strands, relative to the strip's width.
    frizz: f64,
    /// Half width of a strand, texels.
    half: f64,
    /// Share of the strip that is left free at the sides.
    edge: f64,
    /// Spread of the ends, relative to the length.
    ends: f64,
    /// Share of strands that leave the bundle.
    stray: f64,
}

const DENSE: Bundle = Bundle {
    strands: 165,
    clumps: 7,
    clump: 0.55,
    wander: 0.025,
    frizz: 0.010,
    half: 0.92,
    edge: 0.10,
    ends: 0.34,
    stray: 0.10,
};
const BODY: Bundle = Bundle {
    strands: 95,
    clumps: 5,
    clump: 0.80,
    wander: 0.04,
    frizz: 0.011,
    half: 0.88,
    edge: 0.16,
    ends: 0.40,
    stray: 0.12,
};
const LOOSE: Bundle = Bundle {
    strands: 42,
    clumps: 4,
    clump: 0.80,
    wander: 0.06,
    frizz: 0.016,
    half: 0.80,
    edge: 0.22,
    ends: 0.5,
    stray: 0.2,
};
const WISP: Bundle = Bundle {
    strands: 12,
    clumps: 3,
    clump: 0.6,
    wander: 0.10,
    frizz: 0.03,
    half: 0.72,
    edge: 0.3,
    ends: 0.6,
    stray: 0.4,
};
const SINGLE: Bundle = Bundle {
    strands: 4,
    clumps: 2,
    clump: 0.5,
    wander: 0.15,
    frizz: 0.05,
    half: 0.68,
    edge: 0.4,
    ends: 0.5,
    stray: 0.6,
};

fn bundle(strip: usize) -> Bundle {
    match strip {
        0..5 => DENSE,
        5..10 => BODY,
        10..13 => LOOSE,
        13..15 => WISP,
        _ => SINGLE,
    }
}

/// Strand of hair in a strip of the strand atlas.
struct Strand {
    /// Position across the strip at each row, texels.
    across: Vec<f64>,
    /// Height in the bundle and number, 0..1.
    height: f64,
    number: f64,
    /// Start and end, 0..1.
    from: f64,
    to: f64,
    half: f64,
}

/// A texel while strands are laid: cover, height, number.
type Texel = [f32; 3];

/// Returns the strand atlas (texture of hair cards) with its mip levels as RGBA bytes, the finest
/// first.
pub(crate) fn atlas() -> Vec<Level> {
    let mut texels: Vec<Texel> = vec![[0.0, 0.5, 0.5]; WIDTH * HEIGHT];
    for strip in 0..STRIPS {
        let mut strands = strands(strip);
        // The highest strands cover the others.
        strands.sort_by(|a, b| a.height.total_cmp(&b.height));
        for s in &strands {
            paint(&mut texels, strip, s);
        }
    }
    levels(texels)
}

fn normal(id: u64, i: i64) -> f64 {
    noise::normal(std::array::from_fn(|k| {
        noise::unit(SEED, id * 4 + k as u64, i)
    }))
}

/// Returns smooth noise along a strand, approximately normal at its knots.
fn wobble(id: u64, i: i64, knots: f64, v: f64) -> f64 {
    let x = v * knots;
    let k = x.floor();
    let at = |k: f64| normal(id, i * 32 + k as i64);
    lerp(at(k), at(k + 1.0), smooth(x - k))
}

fn strands(strip: usize) -> Vec<Strand> {
    let b = bundle(strip);
    let id = 100 * (strip as u64 + 1);
    let clumps = b.clumps as f64;
    let middle = |c: i64| {
        let even = (c as f64 + 0.5) / clumps + 0.12 / clumps * normal(id, c);
        0.5 + (even - 0.5) * (1.0 - b.edge)
    };
    (0..b.strands as i64)
        .map(|i| {
            let dice = |k: u64| noise::unit(SEED, id + k, i);
            let start = 0.5 + (dice(0) - 0.5) * (1.0 - 0.6 * b.edge);
            let aim = start + 0.05 * normal(id + 1, i);
            let clump = (0..b.clumps as i64)
                .min_by(|x, y| {
                    let far = |c: &i64| (middle(*c) - aim).abs();
                    far(x).total_cmp(&far(y))
                })
                .unwrap_or(0);
            let own = 0.275 / clumps * normal(id + 2, i);
            let strays = dice(5) < b.stray;
            let across = (0..HEIGHT)
                .map(|row| {
                    let v = row as f64 / (HEIGHT - 1) as f64;
                    let w = b.clump * v;
                    let drawn = middle(clump)
                        + b.wander * v * wobble(id + 3, clump, 3.0, v)
                        + own * (1.0 - 0.6 * v);
                    let mut x = lerp(start, drawn, w)
                        + b.frizz
                            * (0.3 + v)
                            * (wobble(id + 4, i, 3.0, v) + 0.22 * wobble(id + 6, i, 9.0, v));
                    if strays {
                        x += 0.10 * v * wobble(id + 7, i, 2.0, v);
                    }
                    x.clamp(0.015, 0.985) * STRIP as f64
                })
                .collect();
            let off = 2.0 * (start - 0.5).abs();
            let lost = 0.45 * ops::pow(dice(8), 1.5)
                + 0.35 * off * off * dice(9)
                + 0.30 * noise::unit(SEED, id + 10, clump);
            let level = 0.55 * dice(11) + 0.45 * noise::unit(SEED, id + 12, clump);
            Strand {
                across,
                height: 0.25 + 0.75 * level,
                number: (0.5 + 0.22 * normal(id + 13, i) + 0.16 * normal(id + 14, clump))
                    .clamp(0.0, 1.0),
                from: 0.012 * dice(15) + 0.05 * ops::pow(dice(16), 4.0),
                to: 1.0 - b.ends * lost,
                half: b.half * (0.7 + 0.6 * dice(17)),
            }
        })
        .collect()
}

/// Lays a strand over those below it.
fn paint(texels: &mut [Texel], strip: usize, s: &Strand) {
    for (row, &x) in s.across.iter().enumerate() {
        let v = row as f64 / (HEIGHT - 1) as f64;
        if v < s.from || v > s.to {
            continue;
        }
        // Hairs taper over their last fifth.
        let half = s.half
            * ((s.to - v) / 0.22).clamp(0.0, 1.0).sqrt()
            * (0.55 + (v - s.from) / 0.08).clamp(0.3, 1.0);
        let low = (x - half - 1.0).floor().max(1.0) as usize;
        let high = ((x + half + 1.0).ceil() as usize).min(STRIP - 2);
        for column in low..=high {
            let d = (column as f64 + 0.5 - x).abs();
            let a = (half + 0.5 - d).clamp(0.0, 1.0) * (2.0 * half).min(1.0);
            if a <= 0.0 {
                continue;
            }
            let round = 1.0 - ops::pow(d / (half + 0.5), 2.0).min(1.0);
            let height = s.height * (0.72 + 0.28 * round);
            let a = a as f32;
            let t = &mut texels[row * WIDTH + strip * STRIP + column];
            t[0] = 1.0 - (1.0 - t[0]) * (1.0 - a);
            t[1] += (height as f32 - t[1]) * a;
            t[2] += (s.number as f32 - t[2]) * a;
        }
    }
}

/// Returns the share of a strip's texels with more than half coverage after coverage is multiplied
/// by `gain`.
fn covered(texels: &[Texel], width: usize, strip: usize, gain: f32) -> f64 {
    let across = width / STRIPS;
    let rows = texels.chunks_exact(width);
    let (mut count, mut all) = (0u32, 0u32);
    for row in rows {
        for t in &row[strip * across..(strip + 1) * across] {
            count += u32::from(t[0] * gain > 0.5);
            all += 1;
        }
    }
    f64::from(count) / f64::from(all.max(1))
}

/// Computes mip levels: box filter, weighted by coverage, with coverage raised so distant strands
/// do not vanish (Castaño 2010, "Computing alpha mipmaps"); only halfway, since strands must not
/// thicken.
fn levels(finest: Vec<Texel>) -> Vec<Level> {
    const HALFWAY: f32 = 0.6;
    let wanted: Vec<f64> = (0..STRIPS)
        .map(|s| covered(&finest, WIDTH, s, 1.0))
        .collect();
    let (mut w, mut h) = (WIDTH, HEIGHT);
    let mut texels = finest;
    let mut out = vec![bytes(w, h, &texels, &[1.0; STRIPS])];
    while w > STRIPS && h > 1 {
        texels = halved(w, h, &texels);
        (w, h) = (w / 2, h / 2);
        let gains: [f32; STRIPS] = std::array::from_fn(|s| {
            let (mut low, mut high) = (0.8f32, 1.8f32);
            for _ in 0..8 {
                let middle = 0.5 * (low + high);
                if covered(&texels, w, s, middle) < wanted[s] {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            1.0 + (0.5 * (low + high) - 1.0) * HALFWAY
        });
        out.push(bytes(w, h, &texels, &gains));
    }
    out
}

fn halved(w: usize, h: usize, texels: &[Texel]) -> Vec<Texel> {
    let mut out = Vec::with_capacity(w * h / 4);
    for y in 0..h / 2 {
        for x in 0..w / 2 {
            let at = |i: usize, j: usize| texels[(2 * y + j) * w + 2 * x + i];
            let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
            let cover: f32 = four.iter().map(|t| t[0]).sum();
            let mean = |k: usize| -> f32 {
                let sum: f32 = four.iter().map(|t| t[k] * (t[0] + 1e-3)).sum();
                sum / (cover + 4e-3)
            };
            out.push([0.25 * cover, mean(1), mean(2)]);
        }
    }
    out
}

fn bytes(w: usize, h: usize, texels: &[Texel], gains: &[f32; STRIPS]) -> Level {
    let across = w / STRIPS;
    let rgba = texels
        .iter()
        .enumerate()
        .flat_map(|(i, t)| {
            let cover = (t[0] * gains[i % w / across]).min(1.0);
            [cover, t[1], t[2], 1.0].map(|x| (x * 255.0).round() as u8)
        })
        .collect();
    (w as u32, h as u32, rgba)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cover(level: &Level, strip: usize) -> f64 {
        let (w, h, rgba) = level;
        let across = *w as usize / STRIPS;
        let mut sum = 0.0;
        for row in rgba.chunks_exact(4 * *w as usize) {
            for texel in row[4 * strip * across..4 * (strip + 1) * across].chunks_exact(4) {
                sum += f64::from(texel[0]) / 255.0;
            }
        }
        sum / (across as f64 * f64::from(*h))
    }

    #[test]
    fn strips_go_from_dense_to_single_hairs_and_thin_to_their_tips() {
        let levels = atlas();
        assert_eq!((levels[0].0, levels[0].1), (2048, 512));
        let shares: Vec<f64> = (0..STRIPS).map(|s| cover(&levels[0], s)).collect();
        assert!(shares[..5].iter().all(|s| *s > 0.6), "{shares:?}");
        assert!(shares[15] < 0.12 && shares[15] > 0.005, "{shares:?}");
        let (w, _, rgba) = &levels[0];
        let row = |y: usize| -> u32 {
            rgba[4 * y * *w as usize..4 * (y + 1) * *w as usize]
                .chunks_exact(4)
                .map(|t| u32::from(t[0]))
                .sum()
        };
        assert!(
            row(500) * 3 < row(200),
            "the tips have less coverage than the roots"
        );
    }

    #[test]
    fn far_strands_neither_vanish_nor_thicken() {
        let levels = atlas();
        for strip in 0..STRIPS {
            let near = cover(&levels[0], strip);
            let far = cover(&levels[4], strip);
            assert!(
                far > 0.85 * near && far < 1.6 * near + 0.02,
                "{strip}: {near} {far}"
            );
        }
    }
}

//! Sets of the story: their motion does not flash, and they are still where required.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

mod device;

use device::headless;
use raconteur_base::ops;
use raconteur_render::{Headless, Quality};
use raconteur_stage::{Camera, Frame, FramingMargin, Set, Shot, Span, StageSet};

const WIDTH: u32 = 128;
const HEIGHT: u32 = 72;
/// Frames per second.
const RATE: usize = 25;
/// Side of the blocks with monitored light, pixels: a hundredth of the image's area each.
const BLOCK: usize = 12;
/// Opposing changes of relative luminance that count as a flash, and their allowed number per
/// second (WCAG 2.2, success criterion 2.3.1).
const FLASH: f64 = 0.1;
const MAX_FLASHES: usize = 3;

fn camera(set: &Set) -> Camera {
    let aspect = f64::from(WIDTH) / f64::from(HEIGHT);
    let room = FramingMargin {
        span: Span::at_rest(aspect),
        aside: set.aside(),
        ..FramingMargin::default()
    };
    Shot::Storyteller.frame(raconteur_base::DVec3::ZERO, 1.66, aspect, room)
}

/// Renders the set at a time, at a quality.
fn drawn(device: &mut Headless, kind: StageSet, time_secs: f64) -> Vec<u8> {
    let mut frame = Frame::with_capacity(0, 0);
    frame.time_secs = time_secs;
    frame.set = Set {
        time_secs,
        ..Set::from_kind(kind)
    };
    frame.lighting = frame.set.lighting();
    frame.camera = camera(&frame.set);
    device.render_rgba(&frame, WIDTH, HEIGHT).expect("drawn")
}

/// Relative luminance of each block.
fn blocks(picture: &[u8]) -> Vec<f64> {
    let linear = |byte: u8| ops::pow(f64::from(byte) / 255.0, 2.2);
    let (wide, high) = (WIDTH as usize / BLOCK, HEIGHT as usize / BLOCK);
    (0..wide * high)
        .map(|block| {
            let (x0, y0) = (block % wide * BLOCK, block / wide * BLOCK);
            let light = |i: usize| {
                let at = 4 * ((y0 + i / BLOCK) * WIDTH as usize + x0 + i % BLOCK);
                0.2126 * linear(picture[at])
                    + 0.7152 * linear(picture[at + 1])
                    + 0.0722 * linear(picture[at + 2])
            };
            (0..BLOCK * BLOCK).map(light).sum::<f64>() / (BLOCK * BLOCK) as f64
        })
        .collect()
}

/// Returns the frame numbers at which the light reverses after a change of [`FLASH`] or more.
fn turns(light: &[f64]) -> Vec<usize> {
    let (mut low, mut high, mut rises, mut out) = (light[0], light[0], None, Vec::new());
    for (i, &l) in light.iter().enumerate() {
        (low, high) = (low.min(l), high.max(l));
        if l >= low + FLASH && rises != Some(true) {
            (rises, high) = (Some(true), l);
            out.push(i);
        } else if l <= high - FLASH && rises != Some(false) {
            (rises, low) = (Some(false), l);
            out.push(i);
        }
    }
    out
}

#[test]
fn what_moves_in_a_place_does_not_flash() {
    let mut device = headless(Quality::Medium);
    for (name, kind) in Set::NAMES {
        let pictures: Vec<Vec<u8>> = (0..4 * RATE)
            .map(|i| drawn(&mut device, kind, i as f64 / RATE as f64))
            .collect();
        let moves = pictures.iter().any(|p| *p != pictures[0]);
        let is_still = matches!(kind, StageSet::Curtain | StageSet::School);
        assert_eq!(moves, !is_still, "{name}");
        let light: Vec<Vec<f64>> = pictures.iter().map(|p| blocks(p)).collect();
        for block in 0..light[0].len() {
            let turns = turns(&light.iter().map(|l| l[block]).collect::<Vec<_>>());
            for (i, from) in turns.iter().enumerate() {
                let within = turns[i..].iter().take_while(|t| **t < from + RATE).count();
                assert!(
                    within / 2 <= MAX_FLASHES,
                    "{name}, block {block}: {turns:?}"
                );
            }
        }
    }
}

#[test]
fn a_flash_is_seen_as_one() {
    let blinking: Vec<f64> = (0..50).map(|i| 0.3 + 0.2 * f64::from(i / 3 % 2)).collect();
    assert!(
        turns(&blinking).len() > 12,
        "the blinking light has more than 12 turns"
    );
    let slow: Vec<f64> = (0..50).map(|i| 0.3 + 0.01 * f64::from(i)).collect();
    assert_eq!(turns(&slow).len(), 1);
}

#[test]
fn at_the_lowest_quality_a_place_is_a_still_layer() {
    let mut device = headless(Quality::Lowest);
    for (name, kind) in Set::NAMES {
        // The first frame renders directly, the second stores the still.
        drawn(&mut device, kind, 0.0);
        let still = drawn(&mut device, kind, 0.4);
        for i in 2..12 {
            assert_eq!(
                drawn(&mut device, kind, 0.4 * f64::from(i)),
                still,
                "{name}"
            );
        }
    }
}

//! One frame of the shipped folk tale without pixels, and the loading of its story. Budget (one
//! core of a two-core cloud machine): 0.25 ms per frame without tissue, 0.1 ms with eight animation
//! players, five manipulators and gestures.

#[path = "../../../crate/player/tests/common/mod.rs"]
mod common;

use std::hint::black_box;

use common::{asset, equip, figure, perform, text};
use criterion::{Criterion, criterion_group, criterion_main};
use raconteur_player::Options;
use raconteur_player::body::read::read_figure;

fn frames(c: &mut Criterion) {
    let glb = asset("figures/sofia.glb");
    let eml = text("stories/white-rabbit/story.eml");
    let bundle = asset("stories/white-rabbit/voice/speech.json");
    let load = || perform(&eml, Some(&bundle), figure(), Options::default()).player;
    let mut player = load();
    let end = player.duration_secs();
    let mut n = 0_u32;
    c.bench_function("frame of white-rabbit, no pixels", |b| {
        b.iter(|| {
            // Steps of 60 Hz through the whole story, round and round.
            n += 1;
            let t = f64::from(n) / 60.0 % end;
            black_box(player.frame(t, 1.6).time_secs)
        });
    });
    c.bench_function("a fragment joins white-rabbit", |b| {
        let mut live = load();
        live.set_open_ended(true);
        // One clause per hour: each is removed when the next one arrives.
        let mut hour = 0_u32;
        b.iter(|| {
            hour += 1;
            let line = "<voice-text time='0'>Once upon a time</voice-text>";
            black_box(
                live.perform(1, line, f64::from(hour) * 3600.0)
                    .clauses
                    .len(),
            )
        });
    });
    let all = include_str!("whole-body.eml");
    let mut whole_body = perform(all, None, figure(), Options::default()).player;
    assert_eq!(equip(&mut whole_body), [""; 0]);
    c.bench_function(
        "frame with eight players, five manipulators and gestures, no pixels",
        |b| {
            b.iter(|| {
                n += 1;
                black_box(whole_body.frame(f64::from(n) / 60.0 % 60.0, 1.6).time_secs)
            });
        },
    );
    c.bench_function("load white-rabbit", |b| {
        b.iter(|| black_box(load().duration_secs()));
    });
    c.bench_function("read sofia", |b| {
        b.iter(|| black_box(read_figure("sofia", &glb).map(|f| f.meshes.len()).ok()));
    });
}

criterion_group!(benches, frames);
criterion_main!(benches);

//! One frame of the shipped folk tale without pixels, and the loading of its story.
//! Budget (one core of a two-core cloud machine): 0.25 ms a frame without tissue, 0.1 ms with
//! eight animation players, five manipulators and gestures.

use std::fs;
use std::hint::black_box;
use std::path::PathBuf;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use raconteur_player::body::read::read_figure;
use raconteur_player::{Options, Player, StoryInput};

fn asset(path: &str) -> Vec<u8> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../assets")
        .join(path);
    fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Eight players, five manipulators and gestures, with the animations that they want.
fn whole_body(figure: Arc<raconteur_player::body::Figure>) -> Player {
    let mut player = Player::load(StoryInput {
        eml: include_str!("whole-body.eml"),
        bundle: None,
        figure,
        options: Options::default(),
    })
    .player;
    let texts: Vec<(String, String)> = player
        .wanted_animations()
        .into_iter()
        .map(|name| {
            let text = asset(&format!("animations/{name}.json"));
            (name, String::from_utf8(text).expect("UTF-8"))
        })
        .collect();
    let clips: Vec<(&str, Option<&str>)> = texts
        .iter()
        .map(|(name, text)| (name.as_str(), Some(text.as_str())))
        .collect();
    assert!(player.provide_animations(&clips).is_empty());
    player
}

fn frames(c: &mut Criterion) {
    let glb = asset("figures/sofia.glb");
    let eml = asset("stories/white-rabbit/story.eml");
    let eml = String::from_utf8(eml).expect("UTF-8");
    let bundle = asset("stories/white-rabbit/voice/speech.json");
    let figure = Arc::new(read_figure("sofia", &glb).expect("a figure"));
    let load = || {
        Player::load(StoryInput {
            eml: &eml,
            bundle: Some(&bundle),
            figure: Arc::clone(&figure),
            options: Options::default(),
        })
        .player
    };
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
        // A clause an hour: each is forgotten when the next one comes.
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
    let mut whole_body = whole_body(Arc::clone(&figure));
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

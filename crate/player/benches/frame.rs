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

/// Both hands gesture every two seconds, and all five manipulators circle without an end.
fn busy() -> String {
    let gesture = |at: u32| {
        format!(
            "<gesture-key time='{at}' duration='1' handedness='both'><hand-shapes>\
             <key id='{}'/></hand-shapes><palms><key a='90' x='1' y='0' z='0'/></palms>\
             <motion><key x='-8' y='14' z='-12'/><key x='-12' y='20' z='-10'/></motion>\
             </gesture-key>",
            at % 60
        )
    };
    let circle = |manipulator: &str, centre: [f64; 3], radius: f64| {
        let [x, y, z] = centre;
        format!(
            "<body-non-deterministic-function time='0' manipulator='{manipulator}' \
             functionName='circle' isLooping='true'><function-args>\
             <arg name='timePeriod' value='3'/><arg name='centerX' value='{x}'/>\
             <arg name='centerY' value='{y}'/><arg name='centerZ' value='{z}'/>\
             <arg name='radius' value='{radius}'/></function-args>\
             </body-non-deterministic-function>"
        )
    };
    let gestures: String = (1..30).map(|i| gesture(2 * i)).collect();
    let arms =
        circle("leftArm", [9.0, 55.0, -17.0], 4.0) + &circle("rightArm", [-9.0, 55.0, -17.0], 4.0);
    let legs =
        circle("leftLeg", [5.0, 5.0, -2.0], 1.5) + &circle("rightLeg", [-5.0, 5.0, -2.0], 1.5);
    let head = "<body-non-deterministic-function time='0' manipulator='head' \
                functionName='segment' isLooping='true'><function-args>\
                <arg name='timePeriod' value='2'/><arg name='endYaw' value='20'/>\
                </function-args></body-non-deterministic-function>";
    gestures + &arms + &legs + head
}

/// Eight players, four of steps and four of arms, each with two layers that play, and `more`.
fn lesson(figure: Arc<raconteur_player::body::Figure>, more: &str) -> Player {
    let names = ["step-march", "step-touch", "step-v", "step-mambo"];
    let arms = ["arms-curl", "arms-punch", "arms-roll", "arms-clap"];
    let mut body = String::new();
    for (i, (step, arm)) in names.iter().zip(arms).enumerate() {
        for (kind, clip, other) in [("s", *step, "step-sway"), ("a", arm, "arms-row")] {
            let player = format!("{kind}{i}");
            body += &format!(
                "<body-player-add time='0' name='{player}' type='multiple' numberOfLayers='2'/>"
            );
            for (layer, name) in [clip, other].into_iter().enumerate() {
                body += &format!(
                    "<body-deterministic-primitive time='0' primitive='push' player='{player}' \
                     animationSetName='{name}'><tracks><ly index='{layer}'/></tracks>\
                     </body-deterministic-primitive>"
                );
            }
        }
    }
    let mut player = Player::load(StoryInput {
        eml: &format!("<eml><body>{body}{more}<null time='60'/></body></eml>"),
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
    let mut busy = lesson(Arc::clone(&figure), &busy());
    c.bench_function(
        "frame with eight players, five manipulators and gestures, no pixels",
        |b| {
            b.iter(|| {
                n += 1;
                black_box(busy.frame(f64::from(n) / 60.0 % 60.0, 1.6).time_secs)
            });
        },
    );
    let mut lesson = lesson(Arc::clone(&figure), "");
    c.bench_function("frame with eight animation players, no pixels", |b| {
        b.iter(|| {
            n += 1;
            black_box(lesson.frame(f64::from(n) / 60.0 % 60.0, 1.6).time_secs)
        });
    });
    c.bench_function("load white-rabbit", |b| {
        b.iter(|| black_box(load().duration_secs()));
    });
    c.bench_function("read sofia", |b| {
        b.iter(|| black_box(read_figure("sofia", &glb).map(|f| f.meshes.len()).ok()));
    });
}

criterion_group!(benches, frames);
criterion_main!(benches);

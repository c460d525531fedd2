//! Expression of emotions by camera, light and music (GEVH 3.5.4), over random stories.

mod common;

use std::sync::{Arc, OnceLock};

use common::{figure, perform, story, without_tissue};
use raconteur_player::base::ops;
use raconteur_player::body::Figure;
use raconteur_player::eml::Severity;
use raconteur_player::stage::emotion::{Angle, EMOTIONS, Valence};
use raconteur_player::stage::{Camera, Lighting, Set, Shot};
use raconteur_player::sweep::check_framing;
use raconteur_player::{Options, Player};
use raconteur_tier::sized;

/// Choices from a seed: Sebastiano Vigna's splitmix64.
struct SeededRandom(u64);

impl SeededRandom {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.share()
    }

    fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[(self.share() * items.len() as f64) as usize % items.len()]
    }
}

/// A story at random: emotions of every kind that overlap or not, gestures between waist and crown.
fn at_random(seed: u64, head: &str) -> String {
    let mut dice = SeededRandom(seed);
    let mut body = String::new();
    let mut t = 1.0;
    while t < 24.0 {
        let kind = EMOTIONS[1 + (dice.share() * 24.0) as usize % 24].name;
        let (potential, secs) = (dice.between(0.2, 10.0), dice.between(0.0, 6.0));
        let (threshold, decay) = (dice.pick(&[0.0, 0.0, 1.0]), dice.between(0.5, 5.0));
        body += &format!(
            "<r:emotion time='{t:.2}' type='{kind}' potential='{potential:.2}' duration='{secs:.2}' \
             threshold='{threshold}' decay='{decay:.2}'/>"
        );
        t += dice.between(0.3, 7.0);
    }
    let mut t = 1.5;
    while t < 26.0 {
        let hands = dice.pick(&["left", "right", "both"]);
        let [x, y, z] = [
            dice.between(4.0, 13.0),
            dice.between(4.0, 24.0),
            dice.between(-16.0, -9.0),
        ];
        let x = if hands == "right" { -x } else { x };
        body += &format!(
            "<gesture-key time='{t:.2}' duration='0.8' handedness='{hands}'><hand-shapes><key time='0' id='1'/>\
             </hand-shapes><motion coords='speaker'><key time='0' x='{x:.1}' y='{y:.1}' z='{z:.1}'/>\
             <key time='0.6' x='{:.1}' y='{:.1}' z='{z:.1}'/></motion></gesture-key>",
            0.8 * x,
            y + 1.0
        );
        t += dice.between(1.2, 6.0);
    }
    format!(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:environment {head}/></head><body>{body}<null time='30'/>\
         </body></eml>"
    )
}

fn player(eml: &str) -> Player {
    // The face has no part in how it is filmed and lit.
    static SOFIA: OnceLock<Arc<Figure>> = OnceLock::new();
    told_by(SOFIA.get_or_init(|| without_tissue("sofia")), eml)
}

fn told_by(figure: &Arc<Figure>, eml: &str) -> Player {
    let loaded = perform(eml, None, Arc::clone(figure), Options::default());
    let errors = loaded
        .diagnostics
        .iter()
        .filter(|d| d.severity == Severity::Error);
    assert_eq!(errors.count(), 0, "{:?}", loaded.diagnostics);
    loaded.player
}

#[test]
fn no_shot_is_short_hands_stay_in_it_and_no_face_is_cut() {
    let mut worst: Vec<(&str, f64)> = Vec::new();
    for seed in 0..sized(8, 1000) as u64 {
        let mut player = player(&at_random(seed, ""));
        for check in check_framing(&mut player) {
            assert!(check.is_ok(), "story {seed}: {check:?}");
            match worst.iter_mut().find(|(name, _)| *name == check.name) {
                Some((_, most)) => *most = most.max(check.worst),
                None => worst.push((check.name, check.worst)),
            }
        }
    }
    println!("worst of all: {worst:?}");
}

#[test]
fn poses_do_not_depend_on_the_environment() {
    for seed in 0..sized(3, 50) as u64 {
        // All of the pose, the face too.
        let mut on = told_by(&figure(), &at_random(seed, ""));
        let without = "camera='false' light='false' music='false' set='night'";
        let mut off = told_by(&figure(), &at_random(seed, without));
        for i in 0..30 {
            let t = f64::from(i);
            assert_eq!(on.digest(t), off.digest(t), "story {seed} at {t}");
        }
        assert!(
            off.music().is_empty() && !on.music().is_empty(),
            "only the environment has music"
        );
        let quiet = off.frame(12.0, 1.6).lighting;
        assert_eq!(quiet, off.frame(0.0, 1.6).lighting);
    }
}

/// Returns the environment at a time.
fn shown(player: &mut Player, t: f64) -> (Camera, Lighting, Set, Vec<String>) {
    let music = player.environment_expression(t).music;
    let frame = player.frame(t, 1.6);
    (frame.camera, frame.lighting, frame.set, music)
}

#[test]
fn seeking_shows_what_playing_shows() {
    let mut player = player(&at_random(7, "set='garden'"));
    let played: Vec<_> = (0..120)
        .map(|i| shown(&mut player, 0.25 * f64::from(i)))
        .collect();
    for i in (0..120).rev() {
        let i = (i * 37) % 120;
        player.seek(0.25 * f64::from(i));
        let sought = shown(&mut player, 0.25 * f64::from(i));
        assert!(sought == played[i as usize], "at {}", 0.25 * f64::from(i));
    }
}

#[test]
fn no_channel_is_faster_than_it_says() {
    const STEP_SECS: f64 = 1.0 / 60.0;
    for seed in 0..sized(4, 200) as u64 {
        let mut player = player(&at_random(seed, ""));
        let mut last: Option<(Lighting, f64)> = None;
        for i in 0..1800 {
            let t = STEP_SECS * f64::from(i);
            let frame = player.frame(t, 1.6);
            let light = frame.lighting;
            let height = ops::tan(0.5 * frame.camera.fov_y_rad);
            if let Some((before, was)) = last {
                // From zero to twice the stage's own light in 1.4 s, eased: 1.875 times the mean.
                let most = (2.0 * 1.875 * STEP_SECS / 1.4) as f32;
                for c in 0..3 {
                    let step = (light.key.irradiance[c] - before.key.irradiance[c]).abs();
                    assert!(step <= most, "story {seed} at {t}: {step}");
                }
                // A continued shot and a transition to a shot zoom; a cut does not.
                let zoom = ops::ln(height / was).abs();
                let cut = player.environment_expression(t).shot
                    != player.environment_expression(t - STEP_SECS).shot;
                assert!(zoom < 0.05 || cut, "story {seed} at {t}: {zoom}");
            }
            last = Some((light, height));
        }
    }
}

#[test]
fn the_white_rabbit_is_filmed_lit_and_scored_as_it_feels() {
    let player = story("white-rabbit", figure(), Options::default()).player;
    let felt: Vec<_> = (0..1500)
        .map(|i| player.environment_expression(0.1 * f64::from(i)))
        .collect();
    let find = |name: &str| {
        let mut all = felt
            .iter()
            .filter(|e| e.emotion.is_some_and(|e| e.name == name));
        let strongest = all
            .clone()
            .max_by(|a, b| a.intensity.total_cmp(&b.intensity));
        (all.any(|e| e.angle == Angle::Low), strongest.expect(name))
    };
    let (low, anger) = find("anger");
    // A gel: the room is red, the face is not.
    let ([red, green, _], [_, on_walls, _]) = (anger.light.color, anger.light.room_color);
    assert!(low && red == 1.0 && green > 0.8 && green < 0.9, "{anger:?}");
    assert!(on_walls < 0.6, "{anger:?}");
    let (_, sorrow) = find("sorry-for");
    assert!(sorrow.light.brightness < 1.0, "{sorrow:?}");
    let (_, joy) = find("joy");
    assert!(
        joy.light.brightness >= 1.0 && joy.light.room_color[2] < 0.7,
        "{joy:?}"
    );
    let shots: Vec<Shot> = felt.iter().map(|e| e.shot).collect();
    for shot in [Shot::Storyteller, Shot::Close] {
        assert!(shots.contains(&shot), "{shot:?}");
    }
    let moods: Vec<Valence> = felt.iter().map(|e| e.mood.sign()).collect();
    for sign in [Valence::Negative, Valence::Neutral, Valence::Positive] {
        assert!(moods.contains(&sign), "{sign:?}");
    }
    let music = player.music();
    for piece in ["neutral.opus", "negative-calm.opus", "positive-lively.opus"] {
        assert!(
            music.iter().any(|cue| cue.file == piece),
            "{piece}: {music:?}"
        );
    }
    // Consecutive pieces change on bar lines; two play simultaneously during a transition.
    for t in 0..1500 {
        let heard = player.environment_expression(0.1 * f64::from(t)).music;
        assert!(heard.len() <= 4, "{heard:?}");
    }
}

#[test]
fn the_seed_draws_the_music_of_moods_scripts_and_live_fragments_alike() {
    let files = |seed: u64| {
        let eml = "<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='2' type='joy' potential='9' \
                   duration='20'/><r:music time='40' valence='positive'/><null time='50'/></body></eml>";
        let options = Options {
            seed,
            ..Options::default()
        };
        let mut player = perform(eml, None, figure(), options).player;
        let live = "<eml xmlns:r='urn:raconteur:eml:1'><body><r:music time='1' valence='positive'/></body></eml>";
        player.perform(0, live, 44.0);
        let good: Vec<_> = player
            .music()
            .into_iter()
            .filter(|cue| cue.file.starts_with("positive") && !cue.file.contains("rise"))
            .collect();
        assert!(good.iter().all(|cue| cue.file == good[0].file), "{good:?}");
        // That of the mood, of the script and of the fragment.
        assert_eq!(good.len(), 3, "{good:?}");
        good[0].file.clone()
    };
    let mut drawn: Vec<String> = (0..8).map(files).collect();
    assert_eq!(drawn[5], files(5));
    drawn.sort();
    drawn.dedup();
    assert_eq!(drawn.len(), 3, "{drawn:?}");
}

#[test]
fn a_flood_of_feelings_is_filmed_like_any_other() {
    let pieces = "<r:piece valence='positive' file='music/a.opus' bar='0'/>".repeat(2000);
    let felt: String = (0..20_000)
        .map(|i| {
            let (time, kind) = (0.01 * f64::from(i), EMOTIONS[1 + i as usize % 24].name);
            format!(
                "<r:emotion time='{time}' type='{kind}' potential='{}'/>",
                i % 11
            )
        })
        .collect();
    let switches = "<r:camera time='3' by='emotion'/><r:light time='3' by='emotion'/>\
                    <r:music time='3' by='emotion'/>"
        .repeat(500);
    let mut player = player(&format!(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:environment>{pieces}</r:environment></head>\
         <body>{felt}{switches}<null time='300'/></body></eml>"
    ));
    let music = player.music();
    assert!(music.len() < 200, "{}", music.len());
    let mut shots = 0;
    let mut last = None;
    for i in 0..200 {
        let now = player.environment_expression(f64::from(i)).shot;
        shots += usize::from(last.replace(now) != Some(now));
    }
    assert!(shots < 60, "{shots}");
    assert!(
        player.frame(100.0, 1.6).camera.fov_y_rad.is_finite(),
        "the field of view of the camera is finite"
    );
}

#[test]
fn no_level_of_music_jumps() {
    const RATE_HZ: f64 = 48_000.0;
    let mut players: Vec<Player> = (0..20).map(|seed| player(&at_random(seed, ""))).collect();
    players.push(story("white-rabbit", figure(), Options::default()).player);
    let mut steepest = 0.0_f64;
    for player in &players {
        for cue in player.music() {
            assert_eq!(cue.level_at(cue.start_secs), 0.0, "{cue:?}");
            for pair in cue.level.windows(2) {
                let [(from_secs, from), (to_secs, to)] = pair else {
                    continue;
                };
                steepest = steepest.max((to - from).abs() / (to_secs - from_secs));
            }
        }
    }
    // From one sample to the next, of a piece at full scale.
    let step_db = 20.0 * ops::ln(steepest / RATE_HZ) / std::f64::consts::LN_10;
    println!("{step_db:.1} dB");
    assert!(step_db < -50.0, "{step_db} dB");
}

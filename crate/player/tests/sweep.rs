//! The shipped stories, swept.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use raconteur_player::body::read::read_figure;
use raconteur_player::sweep::{Check, sweep};
use raconteur_player::{Options, Player, StoryInput};

fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

/// The folders of the shipped stories, in order.
fn stories() -> Vec<PathBuf> {
    let entries = fs::read_dir(assets().join("stories")).expect("the stories");
    let mut folders: Vec<PathBuf> = entries
        .map(|e| e.expect("an entry").path())
        .filter(|p| p.join("story.eml").is_file())
        .collect();
    folders.sort();
    folders
}

fn swept(story: &Path, figure: &str, motion_amount: f64) -> Vec<Check> {
    let file = assets().join(format!("figures/{figure}.glb"));
    let bytes = fs::read(file).expect("a figure");
    let figure = read_figure(figure, &bytes).expect("a figure");
    let eml = fs::read_to_string(story.join("story.eml")).expect("a story");
    let bundle = fs::read(story.join("voice/speech.json")).ok();
    let mut player = Player::load(StoryInput {
        eml: &eml,
        bundle: bundle.as_deref(),
        figure: Arc::new(figure),
        options: Options {
            motion_amount,
            ..Options::default()
        },
    })
    .player;
    sweep(&mut player)
}

#[test]
fn nothing_in_the_shipped_stories_would_make_a_viewer_wince() {
    let stories = stories();
    assert!(stories.len() >= 2);
    let mut wrong = Vec::new();
    for story in &stories {
        // A man and a boy tell one story each: what differs is the body.
        let all = story.ends_with("white-rabbit");
        let others: &[&str] = if all { &["papous", "nuno"] } else { &[] };
        for figure in ["sofia"].iter().chain(others) {
            for check in swept(story, figure, 1.0) {
                if !check.is_ok() {
                    wrong.push(format!("{figure}, {}: {check:?}", story.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn an_elbow_bent_backwards_is_found() {
    let figure = fs::read(assets().join("figures/sofia.glb")).expect("a figure");
    let figure = read_figure("sofia", &figure).expect("a figure");
    let eml = "<eml><body>
        <body-configure-manipulator time='0' manipulator='rightArm' isOn='true'
            jointLimitsActive='false'/>
        <body-non-deterministic-fk time='0.5' manipulator='rightArm' j1='90' j2='0' j3='-40'
            j4='0' j5='0' j6='0'/>
        <null time='2'/></body></eml>";
    let mut player = Player::load(StoryInput {
        eml,
        bundle: None,
        figure: Arc::new(figure),
        options: Options::default(),
    })
    .player;
    let checks = sweep(&mut player);
    let wrong: Vec<_> = checks.iter().filter(|c| !c.is_ok()).collect();
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(
        (wrong[0].name, wrong[0].part),
        ("beyond-limits", "bone_r_elbow")
    );
    assert!((wrong[0].worst - 40.0).abs() < 1.0, "{wrong:?}");
}

//! The poses of the shipped stories, to the last bit, as they were when `tests/digests` was
//! written: what changes only the code's form changes none of them. `UPDATE=1` writes them anew.

mod common;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use common::{read, stories, story};
use raconteur_player::{Options, body::Figure};

/// Moments of a story that are compared, evenly from its start to its end.
const TIMES: usize = 200;

/// Digests on a line of the file.
const A_LINE: usize = 10;

/// A story's name and its digests, [`A_LINE`] to a line.
fn digests(name: &str, figure: &Arc<Figure>) -> String {
    let mut player = story(name, Arc::clone(figure), Options::default()).player;
    let step = player.end_secs() / (TIMES - 1) as f64;
    let mut text = format!("{name}\n");
    for k in 0..TIMES {
        let end = if k % A_LINE == A_LINE - 1 { '\n' } else { ' ' };
        let digest = player.digest(k as f64 * step);
        write!(text, "{digest:016x}{end}").expect("a String takes all");
    }
    text
}

/// Compares every story, performed by one figure, with `tests/digests/FIGURE.txt`.
fn poses_are_as_written(figure: &str) {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../tests/digests/{figure}.txt"));
    let performer = read(figure);
    let played: String = stories().iter().map(|s| digests(s, &performer)).collect();
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&path, played).expect("the digests are written");
        return;
    }
    let written = fs::read_to_string(&path).expect("the digests");
    let mut story = "";
    for (i, (now, then)) in played.lines().zip(written.lines()).enumerate() {
        if !now.contains(' ') {
            story = now;
        }
        assert_eq!(
            now,
            then,
            "{figure}, {story}: line {} of {}",
            i + 1,
            path.display()
        );
    }
    assert_eq!(played.lines().count(), written.lines().count(), "{figure}");
}

#[test]
fn sofias_poses_are_as_written() {
    poses_are_as_written("sofia");
}

#[test]
fn papous_poses_are_as_written() {
    poses_are_as_written("papous");
}

#[test]
fn nunos_poses_are_as_written() {
    poses_are_as_written("nuno");
}

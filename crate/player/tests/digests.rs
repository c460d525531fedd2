//! Poses of the shipped stories, equal to the last bit to those in `tests/digests`: changes of only
//! the code's form change none of them. `UPDATE=1` writes them again.

mod common;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use common::{read, stories, story, turn};
use raconteur_player::{Options, body::Figure};
use raconteur_tier::{FIGURES, share};

/// Number of compared times of a story, evenly from its start to its end.
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

/// Compares stories performed by one figure, its share of them or in the long tier all, with
/// `tests/digests/FIGURE.txt`.
fn poses_are_as_written(figure: &str) {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../tests/digests/{figure}.txt"));
    let performer = read(figure);
    let all = stories();
    if std::env::var_os("UPDATE").is_some() {
        let played: String = all.iter().map(|s| digests(s, &performer)).collect();
        fs::write(&path, played).expect("the digests are written");
        return;
    }
    let written = fs::read_to_string(&path).expect("the digests");
    let written = by_story(&written);
    let names: Vec<&str> = written.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, all, "{}", path.display());
    for (name, then) in share(&written, turn(figure), FIGURES.len()) {
        let played = digests(name, &performer);
        for (i, (now, then)) in played.lines().skip(1).zip(then.iter()).enumerate() {
            assert_eq!(now, *then, "{figure}, {name}: line {} of its", i + 1);
        }
        assert_eq!(played.lines().count(), then.len() + 1, "{figure}, {name}");
    }
}

/// Returns the lines of each story: digests contain spaces, names do not.
fn by_story(text: &str) -> Vec<(&str, Vec<&str>)> {
    let mut stories: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in text.lines() {
        match stories.last_mut() {
            Some((_, lines)) if line.contains(' ') => lines.push(line),
            _ => stories.push((line, Vec::new())),
        }
    }
    stories
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

#[test]
fn amaras_poses_are_as_written() {
    poses_are_as_written("amara");
}

#[test]
fn kenjis_poses_are_as_written() {
    poses_are_as_written("kenji");
}

#[test]
fn lias_poses_are_as_written() {
    poses_are_as_written("lia");
}

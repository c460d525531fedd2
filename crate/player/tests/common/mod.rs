//! Helpers shared by tests of the player: files of the library, figures, and players with all
//! requirements of their stories.

#![allow(dead_code, reason = "each test uses some of it")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use raconteur_player::body::Figure;
use raconteur_player::body::read::read_figure;
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput};
use raconteur_tier::FIGURES;

/// The folder of the library.
pub(crate) fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

/// A file of the library.
pub(crate) fn asset(path: &str) -> Vec<u8> {
    let path = assets().join(path);
    fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A file of the library as text.
pub(crate) fn text(path: &str) -> String {
    String::from_utf8(asset(path)).expect("UTF-8")
}

/// Returns a figure's index among them: its own share of a distributed check.
pub(crate) fn turn(figure: &str) -> usize {
    let place = FIGURES.iter().position(|f| *f == figure);
    place.expect("a shipped figure")
}

/// A figure of the library.
pub(crate) fn read(figure: &str) -> Arc<Figure> {
    let bytes = asset(&format!("figures/{figure}.glb"));
    Arc::new(read_figure(figure, &bytes).expect("a figure"))
}

/// Returns a library figure without the tissue of its face, for checks that do not involve the
/// face.
pub(crate) fn without_tissue(figure: &str) -> Arc<Figure> {
    let mut figure = Arc::unwrap_or_clone(read(figure));
    figure.tissue = None;
    Arc::new(figure)
}

/// `sofia`, read once.
pub(crate) fn figure() -> Arc<Figure> {
    static FIGURE: OnceLock<Arc<Figure>> = OnceLock::new();
    Arc::clone(FIGURE.get_or_init(|| read("sofia")))
}

/// A text performed by a figure.
pub(crate) fn perform(
    eml: &str,
    bundle: Option<&[u8]>,
    figure: Arc<Figure>,
    options: Options,
) -> LoadedPlayer {
    Player::load(StoryInput {
        eml,
        bundle,
        figure,
        options,
    })
}

/// The names of the shipped stories, in order: folders with a script, in folders of folders.
pub(crate) fn stories() -> Vec<String> {
    let (mut names, mut open) = (Vec::new(), vec![String::new()]);
    while let Some(folder) = open.pop() {
        let path = assets().join("stories").join(&folder);
        if path.join("story.eml").is_file() {
            names.push(folder);
            continue;
        }
        for entry in fs::read_dir(path).expect("the stories") {
            let entry = entry.expect("an entry");
            if entry.path().is_dir() {
                let name = entry.file_name().into_string().expect("UTF-8");
                open.push(
                    format!("{folder}/{name}")
                        .trim_start_matches('/')
                        .to_owned(),
                );
            }
        }
    }
    names.sort();
    names
}

/// A story of the library with its voice, if it has one, and its animations.
pub(crate) fn story(name: &str, figure: Arc<Figure>, options: Options) -> LoadedPlayer {
    let voice = assets().join(format!("stories/{name}/voice/speech.json"));
    let bundle = fs::read(voice).ok();
    let eml = text(&format!("stories/{name}/story.eml"));
    let mut loaded = perform(&eml, bundle.as_deref(), figure, options);
    let told = equip(&mut loaded.player);
    assert_eq!(told, [""; 0], "{name}");
    loaded
}

/// Provides the animations that a player needs from the library; returns the codes of diagnostics.
pub(crate) fn equip(player: &mut Player) -> Vec<&'static str> {
    let wanted = player.needed_animations();
    let texts: Vec<Option<String>> = wanted
        .iter()
        .map(|name| fs::read_to_string(assets().join(format!("animations/{name}.json"))).ok())
        .collect();
    let clips: Vec<(&str, Option<&str>)> = wanted
        .iter()
        .zip(&texts)
        .map(|(name, text)| (name.as_str(), text.as_deref()))
        .collect();
    if clips.is_empty() {
        return Vec::new();
    }
    let told = player.provide_animations(&clips);
    told.into_iter().map(|d| d.code).collect()
}

//! Location and reading of a story and its resources.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use raconteur_avatar as avatar;
use raconteur_base::encoding;
use raconteur_body::Figure;
use raconteur_eml::{Diagnostic, decode, nearest, quoted};
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput};
use raconteur_stage::Shot;

use raconteur_voice::files::{input, inside};

use crate::{Outcome, assets, report, terminal};

/// The default performer, as in the element.
pub(crate) const USUAL_FIGURE: &str = "sofia";

/// The largest story file that is read, bytes; the parser's own limit is lower.
const MAX_STORY_BYTES: u64 = 64 << 20;
/// The largest description of a speech bundle that is read, bytes.
pub(crate) const MAX_BUNDLE_BYTES: u64 = 256 << 20;
/// The largest figure that is read, bytes.
const MAX_FIGURE_BYTES: u64 = 512 << 20;

/// Story files, found from a path that names the script or its folder.
pub(crate) struct StoryFiles {
    /// The script.
    pub(crate) script: PathBuf,
    /// Text of the script.
    pub(crate) text: String,
    /// Diagnostic about bytes that are not valid text.
    pub(crate) undecoded: Option<Diagnostic>,
}

impl StoryFiles {
    /// Reads the script at `path`, or `story.eml` in the folder `path`.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let script = if path.is_dir() {
            path.join("story.eml")
        } else {
            path.to_owned()
        };
        let bytes = input::bytes(&script, MAX_STORY_BYTES).context("the story")?;
        let decoded = decode(bytes);
        Ok(Self {
            script,
            text: decoded.text,
            undecoded: decoded.problem,
        })
    }

    /// Returns the folder of the story.
    pub(crate) fn folder(&self) -> &Path {
        self.script.parent().unwrap_or(Path::new(""))
    }

    /// Returns the folder of the speech bundle.
    pub(crate) fn voice(&self) -> PathBuf {
        self.folder().join("voice")
    }

    /// Returns the JSON description of the speech bundle; `None` if the story has none.
    pub(crate) fn bundle(&self) -> Option<Vec<u8>> {
        let path = ok_or_report(inside::find(self.folder(), "voice/speech.json"))??;
        ok_or_report(input::bytes(&path, MAX_BUNDLE_BYTES))
    }

    /// Reads the story with its speech but without a figure, which suffices for times and
    /// diagnostics.
    pub(crate) fn script(&self) -> raconteur_player::Script {
        let mut script = raconteur_player::Script::read(&self.text, self.bundle().as_deref());
        let wanted = script.needed_animations();
        if !wanted.is_empty() {
            let mut library = raconteur_player::Library::default();
            for name in wanted {
                // Missing or broken files are reported by the commands that perform.
                if let Some(text) = find_animation(&name, &self.script)
                    && library.add(&name, &text).is_err()
                {
                    let _ = library.add_parameters(&name, &text);
                }
            }
            script.retime(&library);
        }
        script.diagnostics.splice(0..0, self.undecoded.clone());
        script
    }

    /// Returns the performing figure: the requested one, otherwise the story's choice, otherwise
    /// the default; and a problem with the story's choice.
    fn figure(&self, asked: Option<&str>) -> Result<(Figure, Option<Diagnostic>)> {
        if let Some(name) = asked {
            return Ok((find_figure(name)?, None));
        }
        let document = raconteur_eml::parse(&self.text).document;
        let usual = || find_figure(USUAL_FIGURE);
        let Some(name) = document.performer.and_then(|p| p.figure) else {
            return Ok((usual()?, None));
        };
        // A story reaches no file outside its folder.
        let folder = self.folder();
        let chosen = if Path::new(&name).extension().is_some() {
            inside::find(folder, &name)
                .and_then(|path| path.context("there is no such file next to the story"))
                .and_then(|path| find_figure(&path.to_string_lossy()))
        } else {
            find_figure(&name)
        };
        match chosen {
            Ok(figure) => Ok((figure, None)),
            Err(error) => {
                let message = format!(
                    "the figure {} cannot be used: {error:#}; {USUAL_FIGURE} performs",
                    quoted(&name)
                );
                let span = document.performer_span;
                let mut warning = Diagnostic::warning("player::no-figure", span, message);
                let known = assets::figure_names();
                if let Some(near) = nearest(&name, known.iter().map(String::as_str)) {
                    warning = warning.hint(format!("did you mean `{near}`?"));
                }
                Ok((usual()?, Some(warning)))
            }
        }
    }

    /// Returns diagnostics for question pictures missing from the folder of the story.
    fn lacking_pictures(&self) -> Vec<Diagnostic> {
        let document = raconteur_eml::parse(&self.text).document;
        let lacking = document.pictures().filter_map(|(path, span)| {
            let why = match inside::find(self.folder(), path) {
                Ok(Some(_)) => return None,
                Ok(None) => "there is no such file next to the story".to_owned(),
                Err(error) => format!("{error:#}"),
            };
            let message = format!("the picture {} cannot be shown: {why}", quoted(path));
            Some(Diagnostic::warning("player::no-picture", span, message))
        });
        lacking.collect()
    }

    /// Loads the story for performance with the figure of this name, or else the one that the story
    /// chooses, or else the default one.
    pub(crate) fn player(&self, figure: Option<&str>, shot: Shot) -> Result<LoadedPlayer> {
        let (figure, trouble) = self.figure(figure)?;
        let mut loaded = Player::load(StoryInput {
            eml: &self.text,
            bundle: self.bundle().as_deref(),
            figure: figure.into(),
            options: Options {
                shot,
                ..Options::default()
            },
        });
        let lacking = self.lacking_pictures();
        let before = self
            .undecoded
            .clone()
            .into_iter()
            .chain(trouble)
            .chain(lacking);
        loaded.diagnostics.splice(0..0, before);
        let found: Vec<(String, Option<String>)> = loaded
            .player
            .needed_animations()
            .into_iter()
            .map(|name| {
                let text = find_animation(&name, &self.script);
                (name, text)
            })
            .collect();
        if !found.is_empty() {
            let clips: Vec<(&str, Option<&str>)> = found
                .iter()
                .map(|(name, text)| (name.as_str(), text.as_deref()))
                .collect();
            let told = loaded.player.provide_animations(&clips);
            loaded.diagnostics.extend(told);
        }
        Ok(loaded)
    }
}

/// Returns the value; on error, reports it on standard error and returns `None`, and the story
/// continues without it.
fn ok_or_report<T>(read: Result<T>) -> Option<T> {
    // A closed pipe must not end the program.
    read.inspect_err(|why| drop(writeln!(terminal::err(), "raconteur: {why:#}")))
        .ok()
}

/// Returns the text of an animation: for a bare name, `animations/NAME.json` of the asset library;
/// otherwise a file in the story's folder, JSON or glTF (`FILE.glb#NAME` for one of several
/// animations). If there is no such file, an XML file next to the story, or `None`.
fn find_animation(name: &str, story: &Path) -> Option<String> {
    if !name.contains(['/', '.', '\\']) {
        let Ok(bytes) = assets::read(&format!("animations/{name}.json")) else {
            return find_xml(name, story);
        };
        let text = encoding::utf8(&bytes).map(str::to_owned);
        return ok_or_report(text.with_context(|| format!("the animation {name}")));
    }
    let (path, part) = name.split_once('#').unwrap_or((name, ""));
    // A story reaches no file outside its folder.
    let Some(path) = inside::find(story.parent()?, path).ok()? else {
        return find_xml(path, story);
    };
    let is = |ending: &str| path.extension().is_some_and(|e| e == ending);
    if is("json") || is("xml") {
        return ok_or_report(input::text(&path, input::MAX_TEXT_BYTES));
    }
    let bytes = ok_or_report(input::bytes(&path, MAX_FIGURE_BYTES))?;
    let text = avatar::convert_animation(part, &bytes);
    ok_or_report(text.with_context(|| format!("the animation {name}")))
}

/// Returns the text of the XML file next to a story in place of an animation. It is not
/// interpreted, but the player reports it.
fn find_xml(name: &str, story: &Path) -> Option<String> {
    let stem = name.strip_suffix(".json").unwrap_or(name);
    let path = inside::find(story.parent()?, &format!("{stem}.xml")).ok()??;
    ok_or_report(input::text(&path, input::MAX_TEXT_BYTES))
}

/// Extensions of figure files.
const FIGURE_ENDINGS: [&str; 3] = ["glb", "vrm", "gltf"];

/// Loads a figure by name from the asset library, or from the path of a `.glb`, `.vrm` or `.gltf`
/// file of any origin. Losses in the import are reported on standard error.
pub(crate) fn find_figure(name: &str) -> Result<Figure> {
    let by_path = Path::new(name);
    let ending = by_path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    let bytes = if ending.is_some_and(|e| FIGURE_ENDINGS.iter().any(|f| e == *f)) {
        input::bytes(by_path, MAX_FIGURE_BYTES)
            .context("the figure")?
            .into()
    } else {
        assets::read(&format!("figures/{name}.glb"))?
    };
    let stem = by_path.file_stem().unwrap_or_default().to_string_lossy();
    let imported =
        avatar::open_figure(&stem, &bytes).with_context(|| format!("the figure {name}"))?;
    for d in &imported.diagnostics {
        let hint = if d.hint.is_empty() {
            String::new()
        } else {
            format!(" ({})", d.hint)
        };
        // A closed pipe must not end the program.
        let _ = writeln!(
            terminal::err(),
            "the figure {name}: {}{hint} [{}]",
            d.message,
            d.code
        );
    }
    Ok(imported.figure)
}

/// Loads each story with its performer, prints its diagnostics, and plays it: `play` gets the file
/// name of the script and the player.
pub(crate) fn play_each(
    paths: &[PathBuf],
    figure: Option<&str>,
    play: &mut dyn FnMut(String, &mut Player) -> Result<Outcome>,
) -> Result<Outcome> {
    let mut worst = Outcome::Fine;
    for path in paths {
        let files = StoryFiles::read(path)?;
        let file = files.script.display().to_string();
        let mut loaded = files.player(figure, Shot::Storyteller)?;
        report::print(&file, &files.text, &loaded.diagnostics)?;
        for outcome in [
            report::outcome(&loaded.diagnostics),
            play(file, &mut loaded.player)?,
        ] {
            if outcome == Outcome::Errors {
                worst = Outcome::Errors;
            }
        }
    }
    Ok(worst)
}

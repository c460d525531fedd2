//! Finding and reading a story and what it needs.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use raconteur_player::body::{Figure, import};
use raconteur_player::eml::{Diagnostic, nearest, quoted};
use raconteur_player::stage::Shot;
use raconteur_player::{Loaded, Options, Player, StoryInput};

/// Who performs when nobody is asked for, as in the element.
pub(crate) const USUAL_FIGURE: &str = "sofia";

/// The largest story file that is read, bytes; the parser's own limit is lower.
const LARGEST_STORY: u64 = 64 << 20;

/// A story's files, found from a path that names the script or its folder.
pub(crate) struct StoryFiles {
    /// The script.
    pub(crate) script: PathBuf,
    /// Its text.
    pub(crate) text: String,
}

impl StoryFiles {
    /// Reads the script at `path`, or `story.eml` in the folder `path`.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let script = if path.is_dir() {
            path.join("story.eml")
        } else {
            path.to_owned()
        };
        let size = fs::metadata(&script)
            .with_context(|| format!("cannot read the story {}", script.display()))?
            .len();
        if size > LARGEST_STORY {
            bail!(
                "the story {} is {size} bytes long; the limit is {LARGEST_STORY}",
                script.display()
            );
        }
        let bytes = fs::read(&script)
            .with_context(|| format!("cannot read the story {}", script.display()))?;
        // What is not UTF-8 is replaced, so that the parser can still say where it stands.
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|e| String::from_utf8_lossy(e.as_bytes()).into_owned());
        Ok(Self { script, text })
    }

    /// The folder of the speech bundle.
    pub(crate) fn voice(&self) -> PathBuf {
        self.script.parent().unwrap_or(Path::new("")).join("voice")
    }

    /// The bundle's description, if the story has one.
    pub(crate) fn bundle(&self) -> Option<Vec<u8>> {
        fs::read(self.voice().join("speech.json")).ok()
    }

    /// The story with its voice, without a figure: enough for times and diagnostics.
    pub(crate) fn script(&self) -> raconteur_player::Script {
        let mut script = raconteur_player::Script::read(&self.text, self.bundle().as_deref());
        let wanted = script.wanted_animations();
        if !wanted.is_empty() {
            let mut library = raconteur_player::Library::default();
            for name in wanted {
                // What is missing or broken is told by those who perform.
                if let Some(text) = find_animation(&name, &self.script)
                    && library.add(&name, &text).is_err()
                {
                    let _ = library.add_parameters(&name, &text);
                }
            }
            script.retime(&library);
        }
        script
    }

    /// The figure that performs: the one of this name, else the one that the story chooses, else
    /// the usual one; and what is wrong with the story's choice.
    fn figure(&self, asked: Option<&str>) -> Result<(Figure, Option<Diagnostic>)> {
        if let Some(name) = asked {
            return Ok((find_figure(name, &self.script)?, None));
        }
        let document = raconteur_player::eml::parse(&self.text).document;
        let usual = || find_figure(USUAL_FIGURE, &self.script);
        let Some(name) = document.performer.and_then(|p| p.figure) else {
            return Ok((usual()?, None));
        };
        // A story reaches no file outside its folder.
        let beside = self.script.parent().unwrap_or(Path::new("")).join(&name);
        let path = beside.to_string_lossy();
        let chosen = if Path::new(&name).extension().is_some() {
            find_figure(&path, &self.script)
        } else {
            find_figure(&name, &self.script)
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
                let known = self.figures();
                if let Some(near) = nearest(&name, known.iter().map(String::as_str)) {
                    warning = warning.hint(format!("did you mean `{near}`?"));
                }
                Ok((usual()?, Some(warning)))
            }
        }
    }

    /// The names of the figures of the library.
    fn figures(&self) -> Vec<String> {
        let usual = find_asset(&format!("figures/{USUAL_FIGURE}.glb"), &self.script);
        let folder = usual.ok().and_then(|p| fs::read_dir(p.parent()?).ok());
        let files = folder.into_iter().flatten().flatten();
        let names = files.filter_map(|f| {
            let name = f.file_name().into_string().ok()?;
            name.strip_suffix(".glb").map(str::to_owned)
        });
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// The story ready to be performed: by the figure of this name, else by the one that the
    /// story chooses, else by the usual one.
    pub(crate) fn player(&self, figure: Option<&str>, shot: Shot) -> Result<Loaded> {
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
        loaded.diagnostics.splice(0..0, trouble);
        let found: Vec<(String, Option<String>)> = loaded
            .player
            .wanted_animations()
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

/// A file of the asset library, from the folder `assets` of the folders above the story or
/// the working folder; `path` does not leave it.
pub(crate) fn find_asset(path: &str, story: &Path) -> Result<PathBuf> {
    let near = story.canonicalize().unwrap_or_else(|_| story.to_owned());
    let here = std::env::current_dir().unwrap_or_default();
    near.ancestors()
        .chain(here.ancestors())
        .map(|folder| folder.join("assets").join(path))
        .find(|p| p.is_file())
        .with_context(|| format!("no {path} in an assets folder"))
}

/// The text of an animation: of a bare name, `NAME.json` in `assets/animations` of the folders
/// above the story or the working folder; else of a file in the story's folder, JSON or glTF
/// (`FILE.glb#NAME` for one of several animations).
fn find_animation(name: &str, story: &Path) -> Option<String> {
    if !name.contains(['/', '.', '\\']) {
        let path = find_asset(&format!("animations/{name}.json"), story).ok()?;
        return fs::read_to_string(path).ok();
    }
    let (path, part) = name.split_once('#').unwrap_or((name, ""));
    let relative = Path::new(path);
    // A story reaches no file outside its folder.
    let inside = |c: std::path::Component<'_>| matches!(c, std::path::Component::Normal(_));
    if !relative.components().all(inside) {
        return None;
    }
    let bytes = fs::read(story.parent()?.join(relative)).ok()?;
    if relative.extension().is_some_and(|e| e == "json") {
        return String::from_utf8(bytes).ok();
    }
    import::convert_animation(part, &bytes).ok()
}

/// Endings of files that hold a figure.
const FIGURE_ENDINGS: [&str; 3] = ["glb", "vrm", "gltf"];

/// A figure by name, from `assets/figures` of the folders above the story or the working
/// folder, or by the path of a `.glb`, `.vrm` or `.gltf` file of any origin. What of a
/// foreign file could not be kept goes to the standard error.
pub(crate) fn find_figure(name: &str, near: &Path) -> Result<Figure> {
    let by_path = Path::new(name);
    let ending = by_path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    let path = if ending.is_some_and(|e| FIGURE_ENDINGS.iter().any(|f| e == *f)) {
        by_path.to_owned()
    } else {
        find_asset(&format!("figures/{name}.glb"), near)?
    };
    let bytes =
        fs::read(&path).with_context(|| format!("cannot read the figure {}", path.display()))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let imported = import::open_figure(&stem, &bytes)
        .with_context(|| format!("the figure {}", path.display()))?;
    for d in &imported.diagnostics {
        let hint = if d.hint.is_empty() {
            String::new()
        } else {
            format!(" ({})", d.hint)
        };
        // A closed pipe must not end the program.
        let _ = writeln!(
            std::io::stderr(),
            "the figure {}: {}{hint} [{}]",
            path.display(),
            d.message,
            d.code
        );
    }
    Ok(imported.figure)
}

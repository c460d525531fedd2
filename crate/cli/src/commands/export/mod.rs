//! `raconteur export`: a story as one file that a learning management system, or any server, takes.

mod manifest;
mod page;
mod parts;

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use clap::{ArgGroup, Args};
use raconteur_eml::Severity;
use raconteur_stage::Shot;

use crate::Outcome;
use crate::report;
use crate::story::StoryFiles;
use manifest::Standard;
use parts::Parts;

/// Pack a story as a course, or for a plain site: one zip that plays from any server, without a
/// network beyond it.
#[derive(Args)]
#[command(group(ArgGroup::new("standard").required(true).args(["scorm12", "scorm2004", "cmi5", "xapi", "html"])))]
pub(crate) struct Export {
    /// A script, or a folder that holds a story.eml.
    file: PathBuf,
    /// For learning management systems with SCORM 1.2.
    #[arg(long)]
    scorm12: bool,
    /// For learning management systems with SCORM 2004, 4th edition.
    #[arg(long)]
    scorm2004: bool,
    /// For systems with cmi5.
    #[arg(long)]
    cmi5: bool,
    /// For a record store of xAPI that a launch link names, as Tin Can packages have it.
    #[arg(long)]
    xapi: bool,
    /// For any server: the browser keeps what the learner did.
    #[arg(long)]
    html: bool,
    /// Where to write the zip.
    #[arg(short, long)]
    output: PathBuf,
    /// What the course is called; else as the story is, or its folder.
    #[arg(long)]
    title: Option<String>,
    /// What records call the course, an address that is the author's own; else one of its title.
    #[arg(long, value_name = "IRI", value_parser = parse_iri)]
    id: Option<String>,
    /// The share of the story that a learner has to see, percent.
    #[arg(long, default_value_t = 90, value_parser = clap::value_parser!(u8).range(0..=100))]
    watched: u8,
    /// The share of the points of its questions that is enough to pass, percent; without it nobody
    /// passes or fails.
    #[arg(long, value_parser = clap::value_parser!(u8).range(0..=100))]
    pass: Option<u8>,
    /// A figure of the library; without it, the story's choice, else sofia.
    #[arg(long, value_parser = parse_figure)]
    figure: Option<String>,
    /// The folder that `npm run build` has made; else `dist` beside the folder of the library.
    #[arg(long, value_name = "FOLDER")]
    player: Option<PathBuf>,
}

/// What a course says of itself.
pub(crate) struct About {
    pub(crate) title: String,
    /// A name of letters, digits, hyphens and points, for the manifests of SCORM.
    pub(crate) identifier: String,
    /// What records call it.
    pub(crate) iri: String,
    /// A tag of BCP 47.
    pub(crate) language: String,
    pub(crate) standard: Standard,
    /// 0 to 1.
    pub(crate) watched: f64,
    /// 0 to 1.
    pub(crate) pass: Option<f64>,
    /// The script's address in the package.
    pub(crate) story: String,
    /// The figure that the page asks for, where it is not the story's choice.
    pub(crate) figure: Option<String>,
}

impl Export {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let files = StoryFiles::read(&self.file)?;
        let loaded = files.player(self.figure.as_deref(), Shot::Storyteller)?;
        let name = files.script.display().to_string();
        report::print(&name, &files.text, &loaded.diagnostics)?;
        if loaded
            .diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
        {
            return Ok(Outcome::Errors);
        }
        let document = raconteur_eml::parse(&files.text).document;
        let title = self.title(&files, document.name.as_deref());
        let performer = document.performer.unwrap_or_default();
        let mut parts = Parts::of_player(self.player.as_deref())?;
        parts.add_story(&files, &loaded.player)?;
        parts.add_figure(
            &files,
            self.figure.as_deref().or(performer.figure.as_deref()),
        )?;
        let about = About {
            iri: self
                .id
                .clone()
                .unwrap_or_else(|| format!("urn:raconteur:course:{}", slug(&title))),
            identifier: format!("raconteur.{}", slug(&title)),
            language: performer.language.unwrap_or_else(|| "en".into()),
            standard: self.standard(),
            watched: f64::from(self.watched) / 100.0,
            pass: self.pass.map(|share| f64::from(share) / 100.0),
            story: parts.story().to_owned(),
            figure: self.figure.clone(),
            title,
        };
        for (path, text) in page::files(&about) {
            parts.add(path, text.into_bytes());
        }
        if let Some((path, text)) = manifest::of(&about, &parts.paths()) {
            parts.add(path, text.into_bytes());
        }
        parts
            .write(&self.output)
            .with_context(|| format!("cannot write {}", self.output.display()))?;
        Ok(report::outcome(&loaded.diagnostics))
    }

    const fn standard(&self) -> Standard {
        match self {
            Self { scorm12: true, .. } => Standard::Scorm12,
            Self {
                scorm2004: true, ..
            } => Standard::Scorm2004,
            Self { cmi5: true, .. } => Standard::Cmi5,
            Self { xapi: true, .. } => Standard::Xapi,
            _ => Standard::Html,
        }
    }

    fn title(&self, files: &StoryFiles, named: Option<&str>) -> String {
        let folder = || {
            let folder = files.folder().canonicalize().ok()?;
            Some(folder.file_name()?.to_string_lossy().into_owned())
        };
        let given = self.title.clone().or_else(|| named.map(str::to_owned));
        given.or_else(folder).unwrap_or_else(|| "Story".into())
    }
}

/// Files of other folders are not packed: who has one lays it beside the story, which then names it.
fn parse_figure(name: &str) -> Result<String, String> {
    if name.is_empty() || name.contains(['/', '\\', '.']) {
        return Err("the name of a figure of the library, such as sofia".into());
    }
    Ok(name.to_owned())
}

fn parse_iri(text: &str) -> Result<String, String> {
    let (scheme, rest) = text.split_once(':').unwrap_or_default();
    let is_scheme = scheme.starts_with(|c: char| c.is_ascii_alphabetic())
        && scheme
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    if is_scheme
        && !rest.is_empty()
        && !text.contains(|c: char| c.is_whitespace() || c.is_control())
    {
        return Ok(text.to_owned());
    }
    Err("an address such as https://example.org/courses/frog".into())
}

/// A title as a name without spaces: what XML and systems take for an identifier.
fn slug(title: &str) -> String {
    let kept = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    let words: String = title.chars().map(kept).collect();
    let words: Vec<&str> = words.split('-').filter(|w| !w.is_empty()).collect();
    if words.is_empty() {
        return "story".into();
    }
    words.join("-")
}

/// A file of the folder that the player's build has made.
///
/// # Errors
/// When that folder is not there.
fn player_folder(named: Option<&Path>) -> Result<PathBuf> {
    let folder = match named {
        Some(named) => named.to_owned(),
        None => crate::assets::built_page()
            .context("no built page beside the library: run `npm run build`, or name its folder with --player")?,
    };
    ensure!(
        folder.join(parts::LIST).is_file(),
        "{} holds no player: `npm run build` makes one",
        folder.display()
    );
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use super::{parse_figure, parse_iri, slug};

    #[test]
    fn identifiers_are_plain_names() {
        assert_eq!(slug("The White Rabbit!"), "the-white-rabbit");
        assert_eq!(slug("«»"), "story");
    }

    #[test]
    fn figures_are_of_the_library() {
        assert!(parse_figure("papous").is_ok());
        for bad in ["", "a.glb", "../papous", "a\\b"] {
            assert!(parse_figure(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn addresses_have_a_scheme() {
        for good in ["https://a.example/x", "urn:a:b"] {
            assert_eq!(parse_iri(good).as_deref(), Ok(good));
        }
        for bad in ["", "frog", ":x", "1a:x", "a: b", "https:"] {
            assert!(parse_iri(bad).is_err(), "{bad}");
        }
    }
}

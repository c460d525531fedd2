//! `raconteur export`: a story as one file for a learning management system or any server.

mod manifest;
mod page;
mod parts;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use clap::{ArgGroup, Args};
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
    /// Script, or folder that contains a story.eml; several become the lessons of one course.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Package for learning management systems with SCORM 1.2.
    #[arg(long)]
    scorm12: bool,
    /// Package for learning management systems with SCORM 2004, 4th edition.
    #[arg(long)]
    scorm2004: bool,
    /// Package for systems with cmi5.
    #[arg(long)]
    cmi5: bool,
    /// Package for an xAPI record store named by a launch link, as in Tin Can packages.
    #[arg(long)]
    xapi: bool,
    /// For any web server: the browser stores the learner's progress.
    #[arg(long)]
    html: bool,
    /// Output zip file.
    #[arg(short, long)]
    output: PathBuf,
    /// Title of the course; by default that of the story, or its folder name. Required for several
    /// lessons.
    #[arg(long)]
    title: Option<String>,
    /// Identifier of the course in records, an address owned by the author; by default derived from
    /// its title.
    #[arg(long, value_name = "IRI", value_parser = parse_iri)]
    id: Option<String>,
    /// The share of the story that a learner has to see, percent.
    #[arg(long, default_value_t = 90, value_parser = clap::value_parser!(u8).range(0..=100))]
    watched: u8,
    /// Pass mark, percent of the points of the questions; without it there is no pass or fail.
    #[arg(long, value_parser = clap::value_parser!(u8).range(0..=100))]
    pass: Option<u8>,
    /// A figure of the library; without it, the story's choice, else sofia.
    #[arg(long, value_parser = parse_figure)]
    figure: Option<String>,
    /// Output folder of `npm run build`; by default `dist` next to the library folder.
    #[arg(long, value_name = "FOLDER")]
    player: Option<PathBuf>,
}

/// Metadata of an exported course: title, identifiers, standard, completion rules and lessons.
pub(crate) struct About {
    pub(crate) title: String,
    /// A name of letters, digits, hyphens and points, for the manifests of SCORM.
    pub(crate) identifier: String,
    /// Identifier in records.
    pub(crate) iri: String,
    /// A tag of BCP 47.
    pub(crate) language: String,
    pub(crate) standard: Standard,
    /// 0 to 1.
    pub(crate) watched: f64,
    /// 0 to 1.
    pub(crate) pass: Option<f64>,
    /// Lessons in the order of learning; at least one.
    pub(crate) lessons: Vec<Lesson>,
}

/// Lesson of an exported course: one story with its page and files.
pub(crate) struct Lesson {
    pub(crate) title: String,
    /// Identifier in records; that of the course if the course has no other lesson.
    pub(crate) iri: String,
    /// A tag of BCP 47.
    pub(crate) language: String,
    /// The address of its page in the package.
    pub(crate) page: String,
    /// The folder of its files in the package.
    pub(crate) folder: String,
    /// The script's address in the package.
    pub(crate) story: String,
    /// Figure requested by the page, if it differs from the story's choice.
    pub(crate) figure: Option<String>,
}

impl Export {
    pub(crate) fn run(&self) -> Result<Outcome> {
        ensure!(
            self.files.len() == 1 || self.title.is_some(),
            "several lessons are a course of their own, which needs a name: --title"
        );
        let mut parts = Parts::of_player(self.player.as_deref())?;
        let mut lessons = Vec::new();
        let mut outcome = Outcome::Fine;
        for file in &self.files {
            let (lesson, told) = self.lesson(file, lessons.len(), &mut parts)?;
            if told == Outcome::Errors {
                outcome = Outcome::Errors;
            }
            lessons.push(lesson);
        }
        if outcome == Outcome::Errors {
            return Ok(outcome);
        }
        let about = self.about(lessons);
        for (path, text) in page::files(&about) {
            parts.add(&path, text.into_bytes());
        }
        if let Some((path, text)) = manifest::manifest(&about, &parts.paths()) {
            parts.add(path, text.into_bytes());
        }
        parts
            .write(&self.output)
            .with_context(|| format!("cannot write {}", self.output.display()))?;
        Ok(outcome)
    }

    /// Adds a story to the package, and reports its problems.
    fn lesson(&self, file: &Path, place: usize, parts: &mut Parts) -> Result<(Lesson, Outcome)> {
        let files = StoryFiles::read(file)?;
        let loaded = files.player(self.figure.as_deref(), Shot::Storyteller)?;
        let name = files.script.display().to_string();
        report::print(&name, &files.text, &loaded.diagnostics)?;
        let document = raconteur_eml::parse(&files.text).document;
        let title = story_title(&files, document.name.as_deref());
        let performer = document.performer.unwrap_or_default();
        let (page, folder) = if self.files.len() == 1 {
            ("index.html".to_owned(), "story".to_owned())
        } else {
            let number = place + 1;
            (format!("lesson-{number}.html"), format!("story-{number}"))
        };
        let story = parts.add_story(&files, &loaded.player, &folder)?;
        let figure = self.figure.as_deref().or(performer.figure.as_deref());
        parts.add_figure(&files, figure, &folder)?;
        let lesson = Lesson {
            title,
            iri: String::new(),
            language: performer.language.unwrap_or_else(|| "en".into()),
            page,
            folder,
            story,
            figure: self.figure.clone(),
        };
        Ok((lesson, report::outcome(&loaded.diagnostics)))
    }

    fn about(&self, mut lessons: Vec<Lesson>) -> About {
        let first = lessons.first();
        let title = self
            .title
            .clone()
            .or_else(|| first.map(|lesson| lesson.title.clone()))
            .unwrap_or_default();
        let language = first.map_or_else(|| "en".into(), |lesson| lesson.language.clone());
        let own = || format!("urn:raconteur:course:{}", slug(&title));
        let iri = self.id.clone().unwrap_or_else(own);
        if let [lesson] = lessons.as_mut_slice() {
            lesson.iri.clone_from(&iri);
            lesson.title.clone_from(&title);
        } else {
            name_lessons(&mut lessons, &iri);
        }
        About {
            identifier: format!("raconteur.{}", slug(&title)),
            iri,
            language,
            standard: self.standard(),
            watched: f64::from(self.watched) / 100.0,
            pass: self.pass.map(|share| f64::from(share) / 100.0),
            title,
            lessons,
        }
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
}

/// Returns the title of a story: its own name, otherwise that of its folder.
fn story_title(files: &StoryFiles, named: Option<&str>) -> String {
    let folder = || {
        let folder = files.folder().canonicalize().ok()?;
        Some(folder.file_name()?.to_string_lossy().into_owned())
    };
    let named = named.map(str::to_owned);
    named.or_else(folder).unwrap_or_else(|| "Story".into())
}

/// Derives the addresses of lessons from that of their course and their titles, so that they are
/// stable under reordering. A repeated title gets a number.
fn name_lessons(lessons: &mut [Lesson], course: &str) {
    let end = course.find(['?', '#']).unwrap_or(course.len());
    let (path, rest) = course.split_at(end);
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    for lesson in lessons {
        let name = slug(&lesson.title);
        let count = names.entry(name.clone()).or_default();
        *count += 1;
        let number = if *count > 1 {
            format!("-{count}")
        } else {
            String::new()
        };
        lesson.iri = format!(
            "{}/lessons/{name}{number}{rest}",
            path.trim_end_matches('/')
        );
    }
}

/// Parses a figure name. Files of other folders are not packed: place the figure next to the story
/// and name it there.
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

/// Converts a title to a name without spaces, valid as an identifier in XML and learning systems.
/// Letters of other scripts become a number, so that different titles have different names.
fn slug(title: &str) -> String {
    let kept = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    let words: String = title.chars().map(kept).collect();
    let mut words: Vec<&str> = words.split('-').filter(|w| !w.is_empty()).collect();
    if words.is_empty() {
        words.push("story");
    }
    let number = format!("{:08x}", fnv(title));
    if title.chars().any(|c| c.is_alphanumeric() && !c.is_ascii()) {
        words.push(&number);
    }
    words.join("-")
}

/// Returns the 32-bit FNV-1a hash of the text's bytes.
fn fnv(text: &str) -> u32 {
    let mix = |hash: u32, byte: u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    text.bytes().fold(0x811c_9dc5, mix)
}

/// Returns the folder of the built player, which contains the list of its files.
///
/// # Errors
/// Returns an error if the folder does not exist.
fn player_folder(named: Option<&Path>) -> Result<PathBuf> {
    let folder = match named {
        Some(named) => named.to_owned(),
        None => crate::assets::built_page()
            .context("no built page next to the library: run `npm run build`, or pass its folder with --player")?,
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
    use super::{Lesson, name_lessons, parse_figure, parse_iri, slug};

    #[test]
    fn identifiers_are_plain_names() {
        assert_eq!(slug("The White Rabbit!"), "the-white-rabbit");
        assert_eq!(slug("«»"), "story");
    }

    #[test]
    fn titles_of_any_script_have_names_of_their_own() {
        let titles = [
            "Лягушка",
            "Сова",
            "蛙",
            "梟",
            "Урок 1",
            "Тест 1",
            "Frösche",
            "Früsche",
            "ضفدع",
        ];
        let names: Vec<_> = titles.iter().map(|title| slug(title)).collect();
        for (at, name) in names.iter().enumerate() {
            assert!(!names[..at].contains(name), "{name}");
            assert!(
                name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-'),
                "{name}"
            );
        }
        assert!(
            names[4].starts_with("1-") && names[6].starts_with("fr-sche-"),
            "file names keep the ASCII letters of the title"
        );
    }

    fn lesson(title: &str) -> Lesson {
        Lesson {
            title: title.into(),
            iri: String::new(),
            language: "en".into(),
            page: "lesson-1.html".into(),
            folder: "story-1".into(),
            story: "story-1/story.eml".into(),
            figure: None,
        }
    }

    #[test]
    fn lessons_have_addresses_below_their_course() {
        let mut lessons = ["The frog", "The owl", "The frog"].map(lesson);
        name_lessons(&mut lessons, "https://a.example/course/?v=1#x");
        assert_eq!(
            lessons.map(|l| l.iri),
            [
                "https://a.example/course/lessons/the-frog?v=1#x",
                "https://a.example/course/lessons/the-owl?v=1#x",
                "https://a.example/course/lessons/the-frog-2?v=1#x"
            ]
        );
    }

    #[test]
    fn figures_are_of_the_library() {
        assert!(
            parse_figure("papous").is_ok(),
            "a library figure is accepted"
        );
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

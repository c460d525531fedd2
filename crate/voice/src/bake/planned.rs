//! Planned speech of a story: its texts and files, planned and cast.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::content::Content;
use crate::markup::{Problem, plain, sable, ssml};
use crate::{Source, SpeechRequest};
use anyhow::{Context as _, Result, anyhow};
use raconteur_base::printable::printable;

use super::cast::Role;
use super::digest::Digest;
use super::speak::{self, Casting, RenderInput};
use super::{BakeOptions, REVISION, sounds};
use crate::files::{input, inside, media};

/// Utterance to synthesise, with the hashes that decide if its audio is up to date.
pub(super) struct PlannedUtterance<'a> {
    /// The key of the utterance.
    pub(super) key: u64,
    /// Hash of everything that affects its audio.
    pub(super) digest: u64,
    /// Hash of the part that comes from the story.
    pub(super) source: u64,
    /// Index among the spoken utterances of the story, from 0.
    pub(super) place: usize,
    pub(super) content: Content,
    pub(super) request: &'a SpeechRequest,
    pub(super) role: Role,
    pub(super) casting: Casting,
    pub(super) sounds: Vec<PathBuf>,
}

/// Returns all utterances to be spoken, each once, and the missing files with spoken content.
///
/// # Errors
/// Returns an error if a file cannot be read, or a text cannot be planned.
pub(super) fn all<'a>(
    said: &'a [SpeechRequest],
    folder: &Path,
    options: &BakeOptions,
    library: &dyn Fn(&str) -> Result<PathBuf>,
) -> Result<(Vec<PlannedUtterance<'a>>, Vec<PathBuf>)> {
    let mut seen = BTreeSet::new();
    let mut wanted = Vec::new();
    let mut absent = Vec::new();
    for (place, said) in said.iter().enumerate() {
        // Two clauses with the same speech share an utterance; the first determines its position.
        if seen.insert(said.key) {
            match content(said, folder, library)? {
                Ok(content) => {
                    let one = plan_utterance(said, content, place, folder, options)?;
                    for warning in &one.casting.warnings {
                        let told = format!("{:?}: {warning}", short(&one.content.plain_text()));
                        eprintln!("{}", printable(&told));
                    }
                    wanted.push(one);
                }
                Err(file) => absent.push(file),
            }
        }
    }
    // A dance without a word has no voice.
    wanted.retain(|w| !w.content.words().is_empty() || !w.sounds.is_empty());
    Ok((wanted, absent))
}

/// Returns the content, or the path of the missing file next to the story: the other diagnostics
/// are still reported, because the file may be added later.
fn content(
    said: &SpeechRequest,
    folder: &Path,
    library: &dyn Fn(&str) -> Result<PathBuf>,
) -> Result<Result<Content, PathBuf>> {
    Ok(Ok(match &said.source {
        Source::Content(content) => content.clone(),
        Source::Sable(text) => sable_document("the document in the script", text)?,
        Source::File {
            path,
            sable,
            library: from_library,
        } => {
            let told = || format!("cannot read the spoken text {path}");
            // The library, and for files next to the story also that folder.
            let file = match inside::find(folder, path).with_context(told)? {
                Some(file) => file,
                None if *from_library => library(path)?,
                None => return Ok(Err(folder.join(path))),
            };
            let text = input::text(&file, input::MAX_TEXT_BYTES).with_context(told)?;
            if *sable {
                sable_document(path, &text)?
            } else if path.ends_with(".ssml") {
                let is_there = |src: &str| sounds::find(folder, src).is_ok();
                document(path, ssml::read_beside(&text, &is_there))?
            } else {
                plain::read(&text)
            }
        }
    }))
}

/// Casts and plans one utterance.
pub(super) fn plan_utterance<'a>(
    said: &'a SpeechRequest,
    content: Content,
    place: usize,
    folder: &Path,
    options: &BakeOptions,
) -> Result<PlannedUtterance<'a>> {
    let role = match &said.voice {
        Some(name) => options.cast.named(name)?,
        None => options.cast.primary.clone(),
    };
    let work = RenderInput {
        content: &content,
        role: &role,
        emotion: said.emotion.as_ref(),
        tension: said.tension,
        pace: options.pace,
    };
    let casting = speak::cast(&work, &options.cast, &options.lexicon)
        .with_context(|| format!("planning {:?}", short(&content.plain_text())))?;
    let mut sounds = Vec::new();
    let mut digest = Digest::new();
    digest.number(u64::from(REVISION));
    digest.text(&format!(
        "{} {:?} {:?}",
        options.pace, said.emotion, said.tension
    ));
    digest.text(&options.lexicon_text);
    let mut source = digest.clone();
    source.text(&format!("{:?} {:?}", said.voice, content));
    digest.text(&format!("{:?}", casting.plan));
    for role in [&role].into_iter().chain(&casting.roles) {
        digest.text(options.cast.version(role)?);
        digest.text(&role.voice.name);
        digest.text(&options.cast.engine(role)?.state(said.key, place)?);
    }
    for sound in &casting.plan.sounds {
        let path = sounds::find(folder, &sound.src)?;
        let bytes = input::bytes(&path, media::MAX_BYTES)?;
        digest.bytes(&bytes);
        source.bytes(&bytes);
        sounds.push(path);
    }
    Ok(PlannedUtterance {
        key: said.key,
        digest: digest.value(),
        source: source.value(),
        place,
        content,
        request: said,
        role,
        casting,
        sounds,
    })
}

fn sable_document(name: &str, text: &str) -> Result<Content> {
    document(name, sable::read(text))
}

/// Unwraps the parsed document and reports its problems.
fn document(name: &str, read: Result<(Content, Vec<Problem>), Problem>) -> Result<Content> {
    let (content, problems) = read.map_err(|p| anyhow!("{name}: {p}"))?;
    for problem in problems {
        eprintln!("{}", printable(&format!("{name}: {problem}")));
    }
    Ok(content)
}

/// Returns the beginning of a text, for messages.
pub(super) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

//! `raconteur bake`.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::thread;

use anyhow::{Context as _, Result};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use raconteur_base::printable::printable;
use raconteur_player::Script;
use raconteur_voice::language;
use raconteur_voice::text::Lexicon;
use serde_json::{Value, json};

use crate::story::StoryFiles;
use raconteur_voice::files::{input, inside};

use crate::{Format, Outcome, assets, report, terminal};
use raconteur_voice::bake::engine::{self, ENGINES, EngineOptions, VoiceInfo};
use raconteur_voice::bake::program::MissingPrograms;
use raconteur_voice::bake::{self, BakeOptions, BakeReport, Cast, STORY_PACE};

/// Make or refresh the speech bundles of stories: synthesised speech with its words and phones.
#[derive(Args)]
pub(crate) struct Bake {
    /// Scripts, or folders that contain a story.eml.
    #[arg(required_unless_present = "list_voices")]
    files: Vec<PathBuf>,
    /// The speech engine; without it, the one of the story's voice, else kokoro, or where that
    /// is not installed the first of festival, flite and espeak-ng that is.
    #[arg(long, value_parser = ENGINES)]
    engine: Option<String>,
    /// Default voice, by its engine's name. Without it, the voice chosen by the story
    /// (`r:performer`), otherwise one of the engine in the story's language, or its first English
    /// voice if the story has no language.
    #[arg(long)]
    voice: Option<String>,
    /// List the voices of the engine, or of all that are installed.
    #[arg(long)]
    list_voices: bool,
    /// Change nothing; fail if a bundle is out of date.
    #[arg(long, conflicts_with = "list_voices")]
    check: bool,
    /// Pace of everything, 1 for the voice's own.
    #[arg(long, default_value_t = STORY_PACE)]
    pace: f64,
    /// Pronunciation lexicon: a file with lines WORD = RESPELLING or WORD = /IPA/. Without it,
    /// lexicon.txt next to the story, if it exists.
    #[arg(long)]
    lexicon: Option<PathBuf>,
    /// Address of a MaryTTS server.
    #[arg(long, default_value = "localhost:59125")]
    server: String,
    /// Folder of recordings, with their alignments next to them.
    #[arg(long)]
    recordings: Option<PathBuf>,
    /// Number of utterances baked in parallel; by default one per processor.
    #[arg(long)]
    jobs: Option<usize>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

impl Bake {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let options = EngineOptions {
            server: self.server.clone(),
            recordings: self.recordings.clone(),
        };
        if self.list_voices {
            return list(self.engine.as_deref(), &options, self.format);
        }
        let mut worst = Outcome::Fine;
        let mut reports = Vec::new();
        for path in &self.files {
            let files = StoryFiles::read(path)?;
            let name = files.script.display().to_string();
            let script = files.script();
            // This command provides the missing or stale voice, so these problems are ignored.
            let problems: Vec<_> = script
                .diagnostics
                .iter()
                .filter(|d| !d.code.starts_with("player::"))
                .cloned()
                .collect();
            report::print(&name, &files.text, &problems)?;
            if report::outcome(&problems) == Outcome::Errors {
                worst = Outcome::Errors;
            }
            let folder = files.script.parent().unwrap_or(Path::new(""));
            let lexicon_text = self.lexicon_text(folder)?;
            let bake_options = BakeOptions {
                cast: self.cast(&script, options.clone())?,
                pace: self.pace,
                lexicon: Lexicon::parse(&lexicon_text).context("reading the lexicon")?,
                lexicon_text,
                jobs: self
                    .jobs
                    .or_else(|| thread::available_parallelism().ok().map(usize::from))
                    .unwrap_or(1),
                check: self.check,
            };
            let baked = bake_with_bar(&script, folder, &bake_options)
                .with_context(|| format!("baking {name}"))?;
            for file in &baked.absent {
                writeln!(
                    terminal::err(),
                    "{name}: there is no {}; nothing is said in its place until it is there and \
                     the story is baked again",
                    file.display()
                )?;
            }
            for (text, remark) in &baked.remarks {
                let hint = match remark.hint {
                    "" => String::new(),
                    hint => format!("; {hint}"),
                };
                let told = format!(
                    "{name}: {text:?}: {}{hint} [{}]",
                    remark.message, remark.code
                );
                writeln!(terminal::err(), "{}", printable(&told))?;
            }
            self.report_engines(&name, &baked, &bake_options.cast)?;
            if self.check && (!baked.synthesised.is_empty() || baked.removed > 0) {
                worst = Outcome::Errors;
            }
            match self.format {
                Format::Text => self.report(&name, &baked)?,
                Format::Json => reports.push(in_json(&name, &baked)),
            }
        }
        if self.format == Format::Json {
            writeln!(terminal::out(), "{}", terminal::json(&reports)?)?;
        }
        Ok(worst)
    }

    /// Returns the speaking voice: engine and voice of the options, or else those that the story
    /// chooses.
    fn cast(&self, script: &Script, options: EngineOptions) -> Result<Cast> {
        let performer = script.document.performer.as_ref();
        let (engine, voice) = (self.engine.as_deref(), self.voice.as_deref());
        let named = performer.and_then(|p| p.voice.as_deref());
        let mut cast = match named.filter(|_| voice.is_none()) {
            Some(named) => match engine::find_voice(named) {
                Some((of, voice)) if engine.is_none_or(|asked| asked == of) => {
                    Cast::new(Some(&of), Some(&voice), options)?
                }
                Some(_) => Cast::new(engine, None, options)?,
                None => {
                    let mut cast = Cast::new(engine, None, options)?;
                    cast.primary = cast.named(named).context("the story chooses its voice")?;
                    cast
                }
            },
            None => Cast::new(engine, voice, options)?,
        };
        // A voice set by an option speaks its own language.
        let language = performer.and_then(|p| p.language.as_deref());
        if let Some(name) = language.filter(|_| voice.is_none()) {
            let tag = language::tag(name).with_context(|| {
                format!("the story requests the language {name}, which is not a BCP 47 tag")
            })?;
            cast.speak_in(tag)?;
        }
        Ok(cast)
    }

    fn lexicon_text(&self, folder: &Path) -> Result<String> {
        // A lexicon named by the user may be anywhere.
        let path = match &self.lexicon {
            Some(path) => Some(path.clone()),
            None => inside::find(folder, "lexicon.txt")?,
        };
        path.map_or(Ok(String::new()), |path| {
            input::text(&path, input::MAX_TEXT_BYTES).context("the lexicon")
        })
    }

    /// Reports the use of another engine than the default one, or that none is available.
    fn report_engines(&self, name: &str, baked: &BakeReport, cast: &Cast) -> Result<()> {
        let mut err = terminal::err();
        if let Some(missing) = &baked.compared_without {
            writeln!(
                err,
                "{name}: only texts and sounds were compared, not the versions of engines: {missing}"
            )?;
        } else if let Some(usual) = &cast.instead_of
            && !baked.synthesised.is_empty()
        {
            let lead = &cast.primary;
            let better = engine::local().iter().map(|(name, _)| *name);
            let better: Vec<&str> = better.take_while(|name| *name != lead.engine).collect();
            let are = if better.len() == 1 { "is" } else { "are" };
            writeln!(
                err,
                "{name}: spoken by {} with the voice {}, as {} {are} not here: {usual}",
                lead.engine,
                lead.voice.name,
                better.join(" and "),
            )?;
        }
        Ok(())
    }

    fn report(&self, name: &str, baked: &BakeReport) -> Result<()> {
        let mut out = terminal::out();
        if self.check {
            for text in &baked.synthesised {
                writeln!(out, "{name}: not up to date: {text}")?;
            }
            if baked.removed > 0 {
                writeln!(out, "{name}: {} utterances too many", baked.removed)?;
            }
            if baked.synthesised.is_empty() && baked.removed == 0 {
                writeln!(out, "{name}: up to date, {} utterances", baked.utterances)?;
            }
            return Ok(());
        }
        let each = |bytes: u64| bytes as f64 / baked.duration_secs.max(1e-9);
        writeln!(
            out,
            "{name}: {} utterances, {:.1} s of speech, {} synthesised, {} old files removed; \
             bytes per second: Ogg Opus {:.0}, MP3 {:.0}, times and intonation {:.0}",
            baked.utterances,
            baked.duration_secs,
            baked.synthesised.len(),
            baked.removed,
            each(baked.opus_bytes),
            each(baked.mp3_bytes),
            each(baked.text_bytes),
        )?;
        let heard = &baked.sound.heard;
        if let Some((softest, loudest)) = baked.sound.lufs {
            writeln!(
                out,
                "  measured in the synthesised audio: {:.1} % of {} bursts at their phones, {:.1} % of {} \
                 vowels voiced, pauses {:.0} dB under speech, {softest:.1} to {loudest:.1} LUFS",
                heard.bursts.percent(),
                heard.bursts.of,
                heard.vowels.percent(),
                heard.vowels.of,
                heard.pauses_under_db(),
            )?;
        }
        Ok(())
    }
}

/// Lists voices: of an engine, else of every installed one.
pub(super) fn list(
    engine: Option<&str>,
    options: &EngineOptions,
    format: Format,
) -> Result<Outcome> {
    let mut rows = Vec::new();
    let mut missing = MissingPrograms::default();
    let asked = ENGINES
        .into_iter()
        .filter(|e| engine.is_none_or(|engine| engine == *e));
    for name in asked {
        // An engine that is not installed or not running has no voices.
        match Cast::voices_of(name, options) {
            Ok(voices) => rows.extend(voices.into_iter().map(|v| (name, v))),
            // Servers and recordings are used only on request.
            Err(error) if engine.is_some() || error.is::<MissingPrograms>() => {
                missing.add(&MissingPrograms::from_error(&error));
            }
            Err(_) => {}
        }
    }
    if rows.is_empty() && !missing.is_empty() {
        writeln!(terminal::err(), "no voice is available: {missing}")?;
    }
    let mut out = terminal::out();
    if format == Format::Json {
        let voices: Vec<_> = rows
            .iter()
            .map(|(engine, voice)| row(engine, voice))
            .collect();
        writeln!(out, "{}", terminal::json(&voices)?)?;
        return Ok(Outcome::Fine);
    }
    for (engine, voice) in rows {
        writeln!(
            out,
            "{engine}:{:32} {:8} {}",
            voice.name, voice.language, voice.what
        )?;
    }
    Ok(Outcome::Fine)
}

fn row(engine: &str, voice: &VoiceInfo) -> Value {
    json!({
        "engine": engine,
        "voice": voice.name,
        "language": voice.language,
        "phone_set": voice.phone_set,
        "what": voice.what,
    })
}

/// Bakes a story with a progress bar.
fn bake_with_bar(script: &Script, folder: &Path, options: &BakeOptions) -> Result<BakeReport> {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {wide_msg}")?;
    let bar = ProgressBar::new(0).with_style(style);
    let baked = bake::bake(
        &raconteur_voice::speech_requests(&script.document),
        folder,
        options,
        &assets::find,
        &|done, of, text| {
            bar.set_length(of as u64);
            bar.set_position(done as u64);
            bar.set_message(printable(text).into_owned());
        },
    );
    bar.finish_and_clear();
    baked
}

/// Returns the output of `--format json` for a story.
fn in_json(name: &str, baked: &BakeReport) -> Value {
    json!({
        "file": name,
        "utterances": baked.utterances,
        "stale": baked.synthesised,
        "removed": baked.removed,
        "remarks": baked.remarks.iter().map(|(text, r)| json!({
            "text": text, "code": r.code, "message": r.message, "hint": r.hint,
        })).collect::<Vec<_>>(),
        "heard": baked.sound.lufs.map(|(softest, loudest)| json!({
            "bursts": baked.sound.heard.bursts.percent(),
            "vowels": baked.sound.heard.vowels.percent(),
            "final_vowels": baked.sound.heard.final_vowels.percent(),
            "pauses_under_db": baked.sound.heard.pauses_under_db(),
            "lufs": [softest, loudest],
        })),
        "absent": baked.absent.iter().map(|p| p.display().to_string()).collect::<Vec<_>>(),
        "duration": baked.duration_secs,
        "bytes": {
            "opus": baked.opus_bytes,
            "mp3": baked.mp3_bytes,
            "text": baked.text_bytes,
        },
    })
}

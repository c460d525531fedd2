//! `raconteur`: checks, times, poses, renders and bakes stories without a browser. [`run`] is the
//! whole program; the parsers of untrusted bytes are public too.
//!
//! Errors go to stderr as `file:line:column: severity[code]: message` with an excerpt and a hint.
//! Exit status: 0 success, 1 errors in the input, 2 wrong usage.

mod assets;
mod commands;
pub mod compose;
mod excerpt;
mod film;
mod parallel;
mod picture;
mod report;
pub mod serve;
mod sheet;
mod skinning;
mod soundtrack;
mod story;
mod terminal;

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand, ValueEnum};
use raconteur_voice::files::on_open;

/// Raconteur, a virtual storyteller.
#[derive(Parser)]
#[command(name = "raconteur", version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Folder of figures, animations and music. By default, figures and animations are those in the
    /// program, and everything else is in a folder `assets` next to the program.
    #[arg(long, global = true, value_name = "FOLDER")]
    assets: Option<PathBuf>,
    /// Report opened files on standard error.
    #[arg(long, global = true)]
    log_files: bool,
}

/// Output format of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Text for people.
    Text,
    /// JSON for programs, on standard output.
    Json,
}

#[derive(Subcommand)]
enum Command {
    /// Make the folder of a new story that plays.
    New(commands::new::New),
    /// Report problems in stories.
    Check(commands::check::Check),
    /// Write stories in their canonical form.
    Fmt(commands::fmt::Fmt),
    /// Print the resolved clauses of a story in time order.
    Timeline(commands::timeline::Timeline),
    /// Print joint positions at given times.
    Pose(commands::pose::Pose),
    /// Render an image or film of a story.
    Render(commands::render::Render),
    /// Make or refresh the speech bundles of stories.
    Bake(commands::bake::Bake),
    /// Measure and inspect voices.
    Voice(commands::voice::Voice),
    /// Play stories without rendering and report visible faults.
    Sweep(commands::sweep::Sweep),
    /// Play stories without rendering and compare the motion of the body with people's.
    Motion(commands::motion::Motion),
    /// Show how camera, light and music express emotions.
    Express(commands::express::Express),
    /// Play a score on the built-in synthesiser.
    Compose(commands::compose::Compose),
    /// Convert a transcription of gestures into a story.
    Import(commands::import::Import),
    /// Check transcriptions of gestures and count them.
    Transcription(commands::transcription::Transcription),
    /// Pack a story as a course for a learning management system, or for a plain site.
    Export(commands::export::Export),
    /// Perform fragments sent by minds while the story plays.
    Serve(commands::serve::Serve),
    /// Make and inspect figures.
    Figure(commands::figure::Figure),
    /// Learn faces from examples, and make new ones.
    Faces(Box<commands::faces::Faces>),
}

impl Command {
    fn run(self) -> Result<Outcome> {
        match self {
            Self::New(c) => c.run(),
            Self::Check(c) => c.run(),
            Self::Fmt(c) => c.run(),
            Self::Timeline(c) => c.run(),
            Self::Pose(c) => c.run(),
            Self::Render(c) => c.run(),
            Self::Bake(c) => c.run(),
            Self::Voice(c) => c.run(),
            Self::Sweep(c) => c.run(),
            Self::Motion(c) => c.run(),
            Self::Express(c) => c.run(),
            Self::Compose(c) => c.run(),
            Self::Import(c) => c.run(),
            Self::Transcription(c) => c.run(),
            Self::Export(c) => c.run(),
            Self::Serve(c) => c.run(),
            Self::Figure(c) => c.run(),
            Self::Faces(c) => c.run(),
        }
    }
}

/// Outcome of a command, from which the exit status follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// No problem found.
    Fine,
    /// The input has errors; they have been reported.
    Errors,
}

/// Runs the program with the arguments it was called with.
#[must_use]
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.log_files {
        on_open(|path| terminal::report(format_args!("opened {}", path.display())));
    }
    let outcome = arguments
        .assets
        .map_or(Ok(()), assets::prepend_folder)
        .and_then(|()| {
            assets::offer_voices();
            arguments.command.run()
        });
    match outcome {
        Ok(Outcome::Fine) => ExitCode::SUCCESS,
        Ok(Outcome::Errors) => ExitCode::from(1),
        // The reader of the pipe has closed it.
        Err(error)
            if error.downcast_ref::<io::Error>().map(io::Error::kind)
                == Some(io::ErrorKind::BrokenPipe) =>
        {
            ExitCode::SUCCESS
        }
        Err(error) => {
            terminal::report(format_args!("raconteur: {error:#}"));
            ExitCode::from(1)
        }
    }
}

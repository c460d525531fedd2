//! `raconteur`: checks, times, poses, renders and bakes stories without a browser.
//!
//! Errors go to stderr as `file:line:column: severity[code]: message` with an excerpt and a
//! hint. Exit status: 0 fine, 1 errors in the input, 2 wrong usage.

mod bake;
mod commands;
mod compose;
mod disk;
mod film;
mod inside;
mod media;
mod picture;
mod report;
mod serve;
mod sheet;
mod skinning;
mod soundtrack;
mod story;

use std::io;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

/// Raconteur, a virtual storyteller.
#[derive(Parser)]
#[command(name = "raconteur", version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// How a command reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people.
    Text,
    /// For programs, on standard output.
    Json,
}

#[derive(Subcommand)]
enum Command {
    /// Report problems in stories.
    Check(commands::check::Check),
    /// Write stories in their canonical form.
    Fmt(commands::fmt::Fmt),
    /// Print the resolved clauses of a story in time order.
    Timeline(commands::timeline::Timeline),
    /// Print where the joints are at given times.
    Pose(commands::pose::Pose),
    /// Draw a picture or film of a story.
    Render(commands::render::Render),
    /// Make or refresh the speech bundles of stories.
    Bake(commands::bake::Bake),
    /// Measure voices and look at them.
    Voice(commands::voice::Voice),
    /// Play stories without pixels and report what a viewer would notice.
    Sweep(commands::sweep::Sweep),
    /// Play a score on the built-in synthesiser.
    Compose(commands::compose::Compose),
    /// Perform what minds send while the story plays.
    Serve(commands::serve::Serve),
    /// Make figures and look at them.
    Figure(commands::figure::Figure),
}

/// What a command found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Nothing wrong.
    Fine,
    /// The input has errors; they have been reported.
    Errors,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Check(c) => c.run(),
        Command::Fmt(c) => c.run(),
        Command::Timeline(c) => c.run(),
        Command::Pose(c) => c.run(),
        Command::Render(c) => c.run(),
        Command::Bake(c) => c.run(),
        Command::Voice(c) => c.run(),
        Command::Sweep(c) => c.run(),
        Command::Compose(c) => c.run(),
        Command::Serve(c) => c.run(),
        Command::Figure(c) => c.run(),
    };
    match outcome {
        Ok(Outcome::Fine) => ExitCode::SUCCESS,
        Ok(Outcome::Errors) => ExitCode::from(1),
        // Whoever read the output has seen enough.
        Err(error)
            if error.downcast_ref::<io::Error>().map(io::Error::kind)
                == Some(io::ErrorKind::BrokenPipe) =>
        {
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("raconteur: {error:#}");
            ExitCode::from(1)
        }
    }
}

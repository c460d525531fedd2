//! Runner of the programs that baking and composing need.

use core::fmt;
use std::collections::BTreeSet;
use std::io::{ErrorKind, Read as _};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, anyhow, bail};

/// Time limit of a step, for a page of text; beyond it the program counts as hung.
const LIMIT: Duration = Duration::from_secs(300);

/// Program that encodes Ogg Opus.
pub const OPUSENC: Program = Program {
    name: "opusenc",
    package: "opus-tools",
};
/// Program that encodes and decodes most audio formats.
pub const FFMPEG: Program = Program {
    name: "ffmpeg",
    package: "ffmpeg",
};

/// Programs missing on this machine and the packages that provide them, collected so that one
/// command installs all of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MissingPrograms {
    /// Programs, libraries and voices.
    names: BTreeSet<&'static str>,
    /// Debian's packages.
    packages: BTreeSet<&'static str>,
    /// Problems that no package solves, for example why a server cannot be queried.
    others: BTreeSet<String>,
}

impl MissingPrograms {
    /// Creates the entry of one program and the packages that provide it, separated by spaces.
    pub fn one(name: &'static str, packages: &'static str) -> Self {
        Self {
            names: [name].into(),
            packages: packages.split(' ').collect(),
            others: BTreeSet::new(),
        }
    }

    /// Creates an entry that no Debian package provides; `what` describes the fix.
    pub fn without_package(what: String) -> Self {
        Self {
            others: [what].into(),
            ..Self::default()
        }
    }

    /// Extracts the missing programs from an error, or records the error itself.
    pub fn from_error(error: &anyhow::Error) -> Self {
        let known = error.downcast_ref().cloned();
        known.unwrap_or_else(|| Self::without_package(format!("{error:#}")))
    }

    /// Adds the missing programs of another collection.
    pub fn add(&mut self, other: &Self) {
        self.names.extend(&other.names);
        self.packages.extend(&other.packages);
        self.others.extend(other.others.iter().cloned());
    }

    /// Returns true if no program is missing.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Returns those of the programs that are not on the path.
    pub fn not_found(programs: &[&Program]) -> Self {
        let mut missing = Self::default();
        for program in programs.iter().filter(|p| !p.is_there()) {
            missing.add(&Self::one(program.name, program.package));
        }
        missing
    }

    /// Converts to a result: an error that lists the missing programs, if any.
    pub fn into_result(self) -> Result<()> {
        if self.is_empty() {
            Ok(())
        } else {
            Err(self.into())
        }
    }
}

impl fmt::Display for MissingPrograms {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |items: &BTreeSet<&'static str>, between: &str| {
            items.iter().copied().collect::<Vec<_>>().join(between)
        };
        let mut between = "";
        if !self.names.is_empty() {
            write!(
                f,
                "this needs {}, which this machine does not have; on Debian and Ubuntu: apt-get install {}",
                list(&self.names, ", "),
                list(&self.packages, " ")
            )?;
            between = "; ";
        }
        for other in &self.others {
            write!(f, "{between}{other}")?;
            between = "; ";
        }
        Ok(())
    }
}

impl std::error::Error for MissingPrograms {}

/// External program and the Debian package that provides it.
pub struct Program {
    /// The program, found on the path.
    pub name: &'static str,
    /// Package to install if it is missing.
    pub package: &'static str,
}

impl Program {
    /// Returns true if the program is on the path.
    pub fn is_there(&self) -> bool {
        let path = std::env::var_os("PATH").unwrap_or_default();
        std::env::split_paths(&path).any(|folder| {
            let file = folder.join(self.name);
            file.is_file() || cfg!(windows) && file.with_extension("exe").is_file()
        })
    }

    /// Creates a command that runs the program. Arguments are passed unchanged: no shell reads
    /// them.
    pub fn command(&self) -> Command {
        let mut command = Command::new(self.name);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// Runs a command to completion and returns its standard output.
    ///
    /// # Errors
    /// Returns an error if the program is missing, fails or does not end.
    pub fn run(&self, mut command: Command) -> Result<String> {
        let mut child = command.spawn().map_err(|error| match error.kind() {
            ErrorKind::NotFound => MissingPrograms::one(self.name, self.package).into(),
            _ => anyhow!(error).context(format!("starting {}", self.name)),
        })?;
        // Both pipes are drained simultaneously, because a full one would stop the program.
        let drain = |pipe: Option<Box<dyn std::io::Read + Send>>| {
            thread::spawn(move || {
                let mut bytes = Vec::new();
                if let Some(mut pipe) = pipe {
                    // Output read before an error still helps to explain a failure.
                    let _ = pipe.read_to_end(&mut bytes);
                }
                String::from_utf8_lossy(&bytes).into_owned()
            })
        };
        let stdout = drain(child.stdout.take().map(|p| Box::new(p) as _));
        let stderr = drain(child.stderr.take().map(|p| Box::new(p) as _));
        let begun = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().context("waiting for a program")? {
                break status;
            }
            if begun.elapsed() > LIMIT {
                child
                    .kill()
                    .and_then(|()| child.wait())
                    .context("stopping a program")?;
                bail!("{} did not end within {} s", self.name, LIMIT.as_secs());
            }
            thread::sleep(Duration::from_millis(5));
        };
        let stdout = stdout.join().unwrap_or_default();
        let stderr = stderr.join().unwrap_or_default();
        if !status.success() {
            let said = stderr.trim();
            let said = if said.is_empty() { stdout.trim() } else { said };
            bail!("{} failed ({status}): {said}", self.name);
        }
        Ok(stdout)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_program_is_named_with_its_package() {
        let program = Program {
            name: "raconteur-no-such-program",
            package: "no-such-package",
        };
        let error = program.run(program.command()).unwrap_err().to_string();
        assert!(
            error.contains("raconteur-no-such-program")
                && error.contains("apt-get install no-such-package"),
            "{error}"
        );
    }

    #[test]
    fn all_that_is_missing_is_told_at_once() {
        let none = |name, package| Program { name, package };
        let (one, two) = (
            none("raconteur-no-such", "that other"),
            none("raconteur-nor-such", "this that"),
        );
        let mut missing = MissingPrograms::not_found(&[&one, &two]);
        missing.add(&MissingPrograms::from_error(
            &anyhow!("nobody answers").context("asking a server"),
        ));
        missing.add(&MissingPrograms::from_error(
            &anyhow!(MissingPrograms::one("libx", "x-data")).context("a voice"),
        ));
        assert_eq!(
            missing.into_result().unwrap_err().to_string(),
            "this needs libx, raconteur-no-such, raconteur-nor-such, which this machine does not have; \
             on Debian and Ubuntu: apt-get install other that this x-data; asking a server: nobody answers"
        );
        assert!(
            MissingPrograms::not_found(&[]).into_result().is_ok(),
            "no missing program is not an error"
        );
    }
}

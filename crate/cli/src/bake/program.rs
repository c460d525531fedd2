//! Runs the programs that baking and composing need.

use std::io::{ErrorKind, Read as _};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, anyhow, bail};

/// No step takes this long for a page of text; a program that does hangs.
const LIMIT: Duration = Duration::from_secs(300);

/// Encodes Ogg Opus.
pub(crate) const OPUSENC: Program = Program {
    name: "opusenc",
    package: "opus-tools",
};
/// Encodes and decodes nearly everything.
pub(crate) const FFMPEG: Program = Program {
    name: "ffmpeg",
    package: "ffmpeg",
};

/// A program and the Debian package that brings it.
pub(crate) struct Program {
    /// What is run, found on the path.
    pub(crate) name: &'static str,
    /// What to install when it is missing.
    pub(crate) package: &'static str,
}

impl Program {
    /// A command for it. Arguments go to it as they are: no shell reads them.
    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(self.name);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// Runs a command to its end and returns what it wrote to standard output.
    ///
    /// # Errors
    /// When the program is missing, fails or does not end.
    pub(crate) fn run(&self, mut command: Command) -> Result<String> {
        let mut child = command.spawn().map_err(|error| match error.kind() {
            ErrorKind::NotFound => anyhow!(
                "this needs the program {}, which is not installed; on Debian and Ubuntu: apt-get install {}",
                self.name,
                self.package
            ),
            _ => anyhow!(error).context(format!("starting {}", self.name)),
        })?;
        // Both pipes are drained at once: a full one would stop the program.
        let drain = |pipe: Option<Box<dyn std::io::Read + Send>>| {
            thread::spawn(move || {
                let mut bytes = Vec::new();
                if let Some(mut pipe) = pipe {
                    // What was read before an error still helps to explain a failure.
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
}

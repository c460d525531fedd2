//! `raconteur fmt`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use raconteur_eml::{Diagnostic, HARMLESS, parse, write_with_comments};

use crate::story::StoryFiles;
use raconteur_voice::files::disk;

use crate::{Outcome, report, terminal};

/// Format stories canonically. Comments stay, before their clause. A story that would lose content
/// is left unchanged, with a message.
#[derive(Args)]
pub(crate) struct Fmt {
    /// Scripts, or folders that contain a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Only report stories that are not in canonical form.
    #[arg(long)]
    check: bool,
}

impl Fmt {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        let mut worst = Outcome::Fine;
        for path in &self.files {
            let files = StoryFiles::read(path)?;
            let name = files.script.display().to_string();
            let formatted = match formatted(&files.text, files.undecoded.clone()) {
                Ok(formatted) => formatted,
                Err(losses) => {
                    report::print(&name, &files.text, &losses)?;
                    writeln!(out, "{name}: unchanged; fix the reported problems first")?;
                    worst = Outcome::Errors;
                    continue;
                }
            };
            if formatted == files.text {
                continue;
            }
            if self.check {
                writeln!(out, "{name}: not in canonical form")?;
                worst = Outcome::Errors;
            } else {
                disk::replace(&files.script, formatted.as_bytes())?;
            }
        }
        Ok(worst)
    }
}

/// Returns the canonical text, or the diagnostics that prevent an equivalent one.
fn formatted(source: &str, undecoded: Option<Diagnostic>) -> Result<String, Vec<Diagnostic>> {
    let parsed = parse(source);
    let told = undecoded.into_iter().chain(parsed.diagnostics);
    let losses: Vec<Diagnostic> = told.filter(|d| !HARMLESS.contains(&d.code)).collect();
    if !losses.is_empty() {
        return Err(losses);
    }
    Ok(write_with_comments(&parsed.document, source))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_story_is_written_anew_only_when_nothing_is_lost() {
        let text = formatted(
            "<eml><body><!-- hm --><Null time='1.0'/></body></eml>",
            None,
        )
        .unwrap();
        assert_eq!(
            text,
            "<eml>\n  <body>\n    <!-- hm -->\n    <null time='1'/>\n  </body>\n</eml>\n"
        );
        assert_eq!(formatted(&text, None).unwrap(), text);
        for lossy in [
            "<eml><body><null time='1' colour='red'/></body></eml>",
            "<eml><body><null time='1'></body></eml>",
        ] {
            assert!(formatted(lossy, None).is_err(), "{lossy}");
        }
    }
}

//! Standard output and error for people. The output quotes stories, file names and messages of
//! other programs; a terminal must show them without interpreting control characters.

use std::io::{self, StderrLock, StdoutLock, Write};

use anyhow::Result;
use raconteur_base::printable::{printable, printable_json};
use serde::Serialize;

/// Text stream for terminals that prints control characters visibly instead of sending them.
pub(crate) struct Printable<W>(W);

impl<W: Write> Write for Printable<W> {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        // Formatting hands over whole pieces of UTF-8.
        let shown = String::from_utf8_lossy(text);
        self.0.write_all(printable(&shown).as_bytes())?;
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Returns standard output with control characters made visible.
pub(crate) fn out() -> Printable<StdoutLock<'static>> {
    Printable(io::stdout().lock())
}

/// Returns standard error with control characters made visible.
pub(crate) fn err() -> Printable<StderrLock<'static>> {
    Printable(io::stderr().lock())
}

/// Writes a line to standard error. A closed pipe does not end the program.
pub(crate) fn report(line: impl std::fmt::Display) {
    let _ = writeln!(err(), "{line}");
}

/// Returns a value as JSON on separate lines, which [`out`] prints unchanged.
pub(crate) fn json_lines(value: &impl Serialize) -> Result<String> {
    Ok(printable_json(&serde_json::to_string_pretty(value)?).into_owned())
}

/// Returns the reports on stories as JSON on separate lines: one story is one report, several are a
/// list of them.
pub(crate) fn reports_json(reports: &[impl Serialize]) -> Result<String> {
    match reports {
        [report] => json_lines(report),
        all => json_lines(&all),
    }
}

/// Returns a value as single-line JSON that [`out`] prints unchanged.
pub(crate) fn json(value: &impl Serialize) -> Result<String> {
    Ok(printable_json(&serde_json::to_string(value)?).into_owned())
}

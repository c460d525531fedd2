//! `raconteur figure hair`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use raconteur_body::annotation::Annotations;
use raconteur_body::write;
use raconteur_sculpt::people::hair_donors;
use raconteur_voice::files::disk::replace;

use crate::{Outcome, parallel, terminal};

/// Make hair and beards that figures with other faces can wear, each a file.
#[derive(Args)]
pub(super) struct Hair {
    /// Their names; all without.
    names: Vec<String>,
    /// The folder to write them into.
    #[arg(short, long)]
    output: PathBuf,
}

impl Hair {
    pub(super) fn run(&self) -> Result<Outcome> {
        let all = hair_donors::HAIR.into_iter().chain(hair_donors::BEARDS);
        let all: Vec<&str> = all.collect();
        let names: Vec<&str> = match &self.names[..] {
            [] => all.clone(),
            some => some.iter().map(String::as_str).collect(),
        };
        parallel::map(0..names.len() as u64, |i| {
            let name = names[i as usize];
            let params = hair_donors::params(name).with_context(|| {
                format!(
                    "there is no hair named {name}; there are {}",
                    all.join(", ")
                )
            })?;
            let lender = raconteur_sculpt::lender(&params);
            let glb = write::to_packed_glb(&lender, &Annotations::default());
            let path = self.output.join(format!("{name}.glb"));
            replace(&path, &glb)?;
            writeln!(terminal::out(), "{}: {} bytes", path.display(), glb.len())?;
            Ok(())
        })?;
        Ok(Outcome::Fine)
    }
}

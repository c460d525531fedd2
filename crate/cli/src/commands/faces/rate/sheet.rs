//! `raconteur faces rate sheet`.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use raconteur_base::noise;
use raconteur_faces::{FaceModel, Ratings};
use raconteur_voice::files::disk::replace;

use super::read;
use crate::Outcome;

/// Render random examples of a pack: their images, and a rating form.
#[derive(Args)]
pub(super) struct Sheet {
    /// A pack that `faces learn` wrote.
    pack: PathBuf,
    /// Rated attributes, separated by commas.
    #[arg(
        long = "attribute",
        value_name = "NAME",
        value_delimiter = ',',
        required = true
    )]
    attributes: Vec<String>,
    /// Number of faces.
    #[arg(long)]
    faces: usize,
    /// Another seed draws other faces.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Output folder for the images, `faces.png`, and the form, `ratings.tsv`.
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
}

/// Function that renders images of some of a pack's examples, by index, into a folder.
pub(super) type DrawSheet<'a> = dyn Fn(&FaceModel, &[usize], &Path) -> Result<()> + 'a;

/// The form in its folder.
const FORM: &str = "ratings.tsv";

impl Sheet {
    pub(super) fn run(&self, draw_sheet: &DrawSheet<'_>, out: &mut impl Write) -> Result<Outcome> {
        let names = names(&self.attributes)?;
        let model = read(&self.pack)?;
        let examples = model.examples.len();
        ensure!(
            (2..=examples).contains(&self.faces),
            "--faces takes 2 to {examples}, the number of examples in the pack"
        );
        // Raters may write their lines to one file.
        let lines = self.faces.saturating_mul(names.len());
        ensure!(
            lines < Ratings::MAX_LINES / 2,
            "{lines} ratings are too many for one form"
        );
        let indices = draw(examples, self.faces, self.seed);
        fs::create_dir_all(&self.output)
            .with_context(|| format!("cannot make the folder {}", self.output.display()))?;
        let form = self.output.join(FORM);
        ensure!(
            !form.exists(),
            "a form exists already, and its ratings would be lost: {}",
            form.display()
        );
        replace(&form, Ratings::form(&indices, &names).as_bytes())?;
        draw_sheet(&model, &indices, &self.output)?;
        let listed: Vec<String> = indices.iter().map(usize::to_string).collect();
        writeln!(out, "faces: {}", listed.join(", "))?;
        writeln!(out, "{}: {lines} ratings", form.display())?;
        Ok(Outcome::Fine)
    }
}

/// Validates names of attributes for use in a table.
fn names(given: &[String]) -> Result<Vec<String>> {
    let mut names: Vec<String> = Vec::new();
    for name in given {
        let name = name.trim();
        ensure!(
            !name.is_empty() && !name.contains(char::is_control),
            "--attribute takes names of one line each, separated by commas"
        );
        ensure!(
            !names.iter().any(|n| n == name),
            "--attribute has {name} twice"
        );
        names.push(name.to_owned());
    }
    Ok(names)
}

/// Returns a random selection of `count` example indices, ascending.
fn draw(examples: usize, count: usize, seed: u64) -> Vec<usize> {
    let mut drawn: Vec<usize> = (0..examples).collect();
    drawn.sort_by_key(|&index| noise::hash(seed, index as u64, 0));
    drawn.truncate(count);
    drawn.sort_unstable();
    drawn
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::super::sample::pack;
    use super::*;

    /// Creates test options for a rating form of 36 faces and two attributes.
    fn sheet(pack: &Path, output: &Path) -> Sheet {
        Sheet {
            pack: pack.to_owned(),
            attributes: ["friendly", " odd"].map(str::to_owned).to_vec(),
            faces: 36,
            seed: 5,
            output: output.to_owned(),
        }
    }

    #[test]
    fn a_form_asks_for_each_attribute_of_the_faces_that_are_drawn() {
        let folder = tempfile::tempdir().expect("a folder");
        let of = sheet(&pack(folder.path()), &folder.path().join("a/b"));
        let drawn = RefCell::new(Vec::new());
        let draw_sheet = |_: &FaceModel, indices: &[usize], _: &Path| -> Result<()> {
            drawn.borrow_mut().extend_from_slice(indices);
            Ok(())
        };
        let mut out = Vec::new();
        of.run(&draw_sheet, &mut out).expect("a form");
        let drawn = drawn.take();
        assert_eq!(drawn, draw(40, 36, 5));
        assert_ne!(drawn, draw(40, 36, 6));
        assert!(
            drawn.windows(2).all(|pair| pair[0] < pair[1]) && drawn[35] < 40,
            "the selected faces are sorted, distinct and in range"
        );
        let form = fs::read_to_string(folder.path().join("a/b").join(FORM)).expect("a form");
        let asked = form.lines().filter(|l| l.ends_with("\todd\t")).count();
        assert_eq!((asked, Ratings::parse(&form).is_ok()), (36, true));
        let told = String::from_utf8(out).expect("text");
        assert!(
            told.starts_with(&format!("faces: {}, ", drawn[0])),
            "{told}"
        );
        // It may have been filled in by now.
        let again = of
            .run(&|_, _, _| Ok(()), &mut Vec::new())
            .expect_err("a form is there");
        assert!(again.to_string().contains("would be lost"), "{again}");
        for faces in [0, 1, 41] {
            let of = Sheet {
                faces,
                ..sheet(&of.pack, folder.path())
            };
            assert!(
                of.run(&|_, _, _| Ok(()), &mut Vec::new()).is_err(),
                "{faces}"
            );
        }
        assert!(
            names(&["a".to_owned(), " a".to_owned()]).is_err(),
            "a repeated attribute name is rejected"
        );
        assert!(
            names(&["a\tb".to_owned()]).is_err(),
            "an attribute name with a tab is rejected"
        );
    }
}

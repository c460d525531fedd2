//! `raconteur faces rate learn`.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context as _, Result, bail, ensure};
use clap::Args;
use raconteur_faces::{Agreement, Attribute, FaceModel, NamedAttribute, Ratings};
use raconteur_voice::files::disk::replace;
use raconteur_voice::files::input;

use super::read;
use crate::{Outcome, terminal};

/// Learn attributes from filled-in forms, and write a pack that has them.
#[derive(Args)]
pub(super) struct Learn {
    /// The pack whose faces were rated.
    pack: PathBuf,
    /// The forms, of one rater or of several each.
    #[arg(required = true)]
    ratings: Vec<PathBuf>,
    /// The new pack.
    #[arg(short, long)]
    output: PathBuf,
    /// Terms for the ends of an attribute: `--terms friendly=cold,warm`.
    #[arg(long, value_name = "NAME=LOW,HIGH")]
    terms: Vec<String>,
    /// Also learn attributes on which raters disagree.
    #[arg(long)]
    anyway: bool,
}

/// The group of attributes that are impressions.
const GROUP: &str = "impression";
/// Default terms for −1 and +1.
const TERMS: [&str; 2] = ["less", "more"];
/// Raters whose mean can be relied on less agree poorly: Cicchetti 1994
/// (doi:10.1037/1040-3590.6.4.284) calls an intraclass correlation below 0.40 that.
const MIN_AGREEMENT: f64 = 0.4;

impl Learn {
    pub(super) fn run(&self, out: &mut impl Write) -> Result<Outcome> {
        let mut model = read(&self.pack)?;
        let ratings = self.read_ratings(model.examples.len())?;
        let terms = terms(&self.terms)?;
        if let Some(name) = terms.keys().find(|name| ratings.get(name).is_none()) {
            bail!("--terms names {name}, which has no ratings");
        }
        writeln!(out, "attribute\traters\tfaces\tICC(2,1)\tICC(2,k)")?;
        let (mut learned, mut refused) = (Vec::new(), Vec::new());
        for (name, of) in ratings.attributes() {
            let agreement = of.agreement();
            print(name, agreement, out)?;
            if is_poor(agreement) && !self.anyway {
                refused.push(name);
                continue;
            }
            let labels = of.labels(model.examples.len());
            let terms = terms.get(name).copied().unwrap_or(TERMS);
            learned.push((name, learn(&mut model, name, &labels, terms)?));
        }
        let why = format!(
            "raters agree too little to learn {} (ICC(2,k) below {MIN_AGREEMENT}, or unknown); \
             --anyway does",
            refused.join(", ")
        );
        ensure!(!learned.is_empty(), "{why}");
        replace(&self.output, &model.to_bytes()?)?;
        for (name, faces) in learned {
            let pack = self.output.display();
            writeln!(out, "{pack}: {name}, from {faces} faces")?;
        }
        if refused.is_empty() {
            return Ok(Outcome::Fine);
        }
        terminal::report(why);
        Ok(Outcome::Errors)
    }

    /// Reads all the forms, about faces of a pack with this number of examples.
    fn read_ratings(&self, examples: usize) -> Result<Ratings> {
        let mut all = Ratings::default();
        for path in &self.ratings {
            let text = input::text(path, input::MAX_TEXT_BYTES)?;
            let added = Ratings::parse(&text).and_then(|ratings| {
                ratings.check_faces(examples)?;
                all.merge(ratings)
            });
            added.with_context(|| format!("cannot use {}", path.display()))?;
        }
        ensure!(
            all.attributes().next().is_some(),
            "no face has a rating in the given forms"
        );
        Ok(all)
    }
}

/// Parses the terms for the ends of attributes.
fn terms(given: &[String]) -> Result<BTreeMap<&str, [&str; 2]>> {
    let mut terms = BTreeMap::new();
    for one in given {
        let parts = one
            .split_once('=')
            .and_then(|(name, ends)| Some((name.trim(), ends.split_once(',')?)));
        let (name, (low, high)) = parts.context("--terms takes NAME=LOW,HIGH")?;
        let before = terms.insert(name, [low.trim(), high.trim()]);
        ensure!(before.is_none(), "--terms has {name} twice");
    }
    Ok(terms)
}

/// Prints the row of an attribute.
fn print(name: &str, agreement: Agreement, out: &mut impl Write) -> Result<()> {
    let Agreement { raters, faces, .. } = agreement;
    let [single, average] = [agreement.single, agreement.average]
        .map(|x| x.map_or_else(|| "–".to_owned(), |x| format!("{x:.2}")));
    writeln!(out, "{name}\t{raters}\t{faces}\t{single}\t{average}")?;
    Ok(())
}

fn is_poor(agreement: Agreement) -> bool {
    agreement.average.is_none_or(|x| x < MIN_AGREEMENT)
}

/// Learns an attribute from the labelled faces, and replaces one of the same name. Returns the
/// number of faces.
fn learn(
    model: &mut FaceModel,
    name: &str,
    labels: &[Option<f64>],
    terms: [&str; 2],
) -> Result<usize> {
    let pairs = model.examples.iter().zip(labels);
    let (faces, labels): (Vec<Vec<f64>>, Vec<f64>) = pairs
        .filter_map(|(face, label)| Some((face.clone(), (*label)?)))
        .unzip();
    let named = NamedAttribute {
        feature: None,
        group: GROUP.to_owned(),
        terms: terms.map(str::to_owned),
        derived: None,
        attribute: Attribute::learn(name, &model.shape, &faces, &labels)?,
    };
    let place = model
        .attributes
        .iter_mut()
        .find(|a| a.attribute.name == name);
    if let Some(old) = place {
        *old = named;
    } else {
        model.attributes.push(named);
    }
    Ok(faces.len())
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::super::sample::{pack, visible_value};
    use super::*;

    /// Returns a form filled in by a simulated rater: a multiple of the visible value, for each
    /// attribute.
    fn filled(form: &str, rater: &str, friendly: f64, odd: f64) -> String {
        let line = |line: &str| {
            let columns: Vec<&str> = line.split('\t').collect();
            let ["", face, attribute, ""] = columns[..] else {
                return format!("{line}\n");
            };
            let times = if attribute == "odd" { odd } else { friendly };
            let value = times * visible_value(face.parse().expect("an index"));
            format!("{rater}\t{face}\t{attribute}\t{value:.1}\n")
        };
        form.lines().map(line).collect()
    }

    /// Writes the forms of three raters who agree on "friendly", but not on "odd".
    fn rated(folder: &Path) -> Vec<PathBuf> {
        let faces: Vec<usize> = (0..36).collect();
        let form = Ratings::form(&faces, &["friendly", "odd"].map(str::to_owned));
        [("a", 2.0, 2.0), ("b", 1.5, -2.0), ("c", 2.5, 1.0)]
            .map(|(rater, friendly, odd)| {
                let path = folder.join(rater);
                fs::write(&path, filled(&form, rater, friendly, odd)).expect("written");
                path
            })
            .to_vec()
    }

    #[test]
    fn what_raters_agree_about_is_learned() {
        let folder = tempfile::tempdir().expect("a folder");
        let pack = pack(folder.path());
        let mut of = Learn {
            ratings: rated(folder.path()),
            pack,
            output: folder.path().join("new"),
            terms: vec!["friendly=cold, warm".to_owned()],
            anyway: false,
        };
        let mut out = Vec::new();
        let outcome = of.run(&mut out).expect("one is learned");
        let told = String::from_utf8(out).expect("text");
        assert_eq!(outcome, Outcome::Errors, "{told}");
        assert!(told.contains("\nfriendly\t3\t36\t0.9"), "{told}");
        assert!(told.contains("\nodd\t3\t36\t-"), "{told}");
        assert!(told.contains("friendly, from 36 faces"), "{told}");
        let model = read(&of.output).expect("a pack");
        let [named] = &model.attributes[..] else {
            panic!("{} attributes", model.attributes.len());
        };
        assert_eq!(
            (named.group.as_str(), named.terms[1].as_str()),
            (GROUP, "warm")
        );
        let value = |i: usize| named.attribute.value(&model.shape, &model.examples[i]);
        let mut order: Vec<usize> = (0..40).collect();
        order.sort_by(|a, b| visible_value(*a).total_cmp(&visible_value(*b)));
        assert!(
            value(order[0]) < -0.3 && value(order[39]) > 0.3,
            "the learned values follow the order of the ratings"
        );
        // A second run on the new pack replaces its attribute.
        of.pack = of.output.clone();
        of.anyway = true;
        of.terms = Vec::new();
        assert_eq!(of.run(&mut Vec::new()).expect("learned"), Outcome::Fine);
        let again = read(&of.output).expect("a pack").attributes;
        let names: Vec<&str> = again.iter().map(|a| a.attribute.name.as_str()).collect();
        assert_eq!(
            (names, again[0].terms[0].as_str()),
            (vec!["friendly", "odd"], "less")
        );
    }

    #[test]
    fn what_is_wrong_is_named_and_nothing_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let pack = pack(folder.path());
        let told = |text: &str, terms: &str| {
            let path = folder.path().join("ann.tsv");
            fs::write(&path, text).expect("written");
            let of = Learn {
                pack: pack.clone(),
                ratings: vec![path],
                output: folder.path().join("new"),
                terms: vec![terms.to_owned()],
                anyway: false,
            };
            let error = of.run(&mut Vec::new()).expect_err("wrong");
            assert!(!of.output.exists(), "a rejected rating writes no output");
            format!("{error:#}")
        };
        let header = "rater\tface\tattribute\tvalue\n";
        for (lines, terms, named) in [
            ("a\t0\tshy\t9\n", "shy=a,b", "ann.tsv: line 2"),
            ("a\t40\tshy\t1\n", "shy=a,b", "no face 40 among 40"),
            ("\t4\tshy\t\n", "shy=a,b", "no face has a rating"),
            ("a\t4\tshy\t1\n", "shy=a", "NAME=LOW,HIGH"),
            ("a\t4\tshy\t1\n", "sly=a,b", "sly, which has no ratings"),
            ("a\t4\tshy\t1\n", "shy=a,b", "to learn shy"),
        ] {
            let told = told(&format!("{header}{lines}"), terms);
            assert!(told.contains(named), "{told}");
        }
    }
}

//! Face edits as options of a command.

use anyhow::{Context as _, Result, bail};
use clap::Args;
use raconteur_faces::{Affine, Constraint, Editor, Face, Half, Part, Region};

/// Choice of the face and its changes. Every change may end in a region: `@nose`, `@eyes+mouth`,
/// `@cheeks/left`, `@/right`; without one it applies to the whole head.
#[derive(Args)]
pub(super) struct Edits {
    /// Draw a face at random.
    #[arg(long, conflicts_with = "face")]
    seed: Option<u64>,
    /// A face of the database, by its number.
    #[arg(long)]
    face: Option<usize>,
    /// Copy a region of another face of the database: `--import 17@nose`.
    #[arg(long, value_name = "NUMBER@REGION")]
    import: Vec<String>,
    /// Scale a region about its middle, along x, y and z: `--scale 1.1,1,1@mouth`.
    #[arg(long, value_name = "X,Y,Z@REGION", allow_hyphen_values = true)]
    scale: Vec<String>,
    /// Turn a region about its middle, degrees about x, y and z.
    #[arg(long, value_name = "X,Y,Z@REGION", allow_hyphen_values = true)]
    turn: Vec<String>,
    /// Move a region, millimetres.
    #[arg(long = "move", value_name = "X,Y,Z@REGION", allow_hyphen_values = true)]
    moves: Vec<String>,
    /// Attribute and its value, −1 to 1: `--set "width of the mouth=-0.5"`, limited to `shape:` or
    /// `texture:` with that prefix. Each value is held while the others change.
    #[arg(
        long = "set",
        value_name = "ATTRIBUTE=VALUE@REGION",
        allow_hyphen_values = true
    )]
    values: Vec<String>,
    /// Exaggerate the difference of the face from the average: 1.5 for a caricature, 0.5 for a more
    /// average face.
    #[arg(long, value_name = "LEVEL@REGION")]
    caricature: Vec<String>,
    /// Strength of detail in the texture that is added to the face's own; 0.7 is usual.
    #[arg(long)]
    detail: Option<f64>,
}

/// Splits an argument into its text and the region after `@`.
fn split<'a>(editor: &Editor, argument: &'a str) -> Result<(&'a str, Region)> {
    let (what, place) = argument.rsplit_once('@').unwrap_or((argument, ""));
    let (names, half) = place.split_once('/').unwrap_or((place, ""));
    let half = match half {
        "" => None,
        "left" => Some(Half::Left),
        "right" => Some(Half::Right),
        other => bail!("a half is left or right, not {other}"),
    };
    let names: Vec<&str> = names.split('+').filter(|n| !n.is_empty()).collect();
    let region = editor.region(&names, half).map_err(|error| {
        let all = editor.model().segments.all().iter();
        let known: Vec<&str> = all.map(|s| s.name.as_str()).collect();
        anyhow::anyhow!("{error}; there are {}", known.join(", "))
    })?;
    Ok((what, region))
}

/// Parses three finite numbers separated by commas.
fn three(text: &str) -> Result<[f64; 3]> {
    let all: Vec<f64> = text
        .split(',')
        .map(|x| x.trim().parse::<f64>())
        .collect::<Result<_, _>>()
        .with_context(|| format!("expected three numbers, found {text}"))?;
    let all: Result<[f64; 3], _> = all.try_into();
    all.ok()
        .filter(|all| all.iter().all(|x| x.is_finite()))
        .with_context(|| format!("expected three numbers, found {text}"))
}

fn number(text: &str) -> Result<f64> {
    let number: f64 = text
        .trim()
        .parse()
        .with_context(|| format!("not a number: {text}"))?;
    number
        .is_finite()
        .then_some(number)
        .context("expected a finite number")
}

impl Edits {
    /// Returns the face that the options choose, with their edits applied.
    pub(super) fn face(&self, editor: &Editor) -> Result<Face> {
        let mut face = match (self.seed, self.face) {
            (Some(seed), _) => editor.random(seed),
            (_, Some(index)) => editor.example(index)?,
            _ => editor.average(),
        };
        self.change(editor, &mut face)?;
        Ok(face)
    }

    /// Applies the requested changes to a face.
    pub(super) fn change(&self, editor: &Editor, face: &mut Face) -> Result<()> {
        for import in &self.import {
            let (index, region) = split(editor, import)?;
            let index = index.parse().context("the number of a face")?;
            let from = editor.example(index)?;
            for part in [Part::Shape, Part::Texture] {
                editor.import(face, &from, part, &region);
            }
        }
        self.transform(editor, face)?;
        self.constrain(editor, face)?;
        for caricature in &self.caricature {
            let (level, region) = split(editor, caricature)?;
            let level = number(level)?;
            for part in [Part::Shape, Part::Texture] {
                editor.caricature(face, part, level, &region);
            }
        }
        if let Some(strength) = self.detail {
            let own = face.clone();
            editor.add_detail(face, &own, Part::Texture, strength);
        }
        Ok(())
    }

    fn transform(&self, editor: &Editor, face: &mut Face) -> Result<()> {
        let mut apply = |all: &[String], of: &dyn Fn([f64; 3]) -> Affine| -> Result<()> {
            for one in all {
                let (numbers, region) = split(editor, one)?;
                editor.transform(face, &of(three(numbers)?), &region);
            }
            Ok(())
        };
        apply(&self.scale, &|scale| Affine {
            scale,
            ..Affine::NONE
        })?;
        apply(&self.turn, &|turn| Affine {
            turn_rad: turn.map(f64::to_radians),
            ..Affine::NONE
        })?;
        apply(&self.moves, &|way| Affine {
            translation_m: way.map(|mm| mm * 1e-3),
            ..Affine::NONE
        })
    }

    /// Sets all attribute values simultaneously.
    fn constrain(&self, editor: &Editor, face: &mut Face) -> Result<()> {
        let mut held = Vec::new();
        for value in &self.values {
            let (what, region) = split(editor, value)?;
            let (name, value) = what
                .split_once('=')
                .context("--set takes ATTRIBUTE=VALUE")?;
            let (wanted, name) = match name.split_once(':') {
                Some(("shape", name)) => (&[Part::Shape][..], name),
                Some(("texture", name)) => (&[Part::Texture][..], name),
                _ => (&[Part::Shape, Part::Texture][..], name),
            };
            let value = number(value).with_context(|| format!("the value of {name}"))?;
            let has = |part: &&Part| {
                let mut all = editor.attributes(**part).iter();
                all.any(|a| a.attribute.name == name)
            };
            let parts: Vec<&Part> = wanted.iter().filter(has).collect();
            if parts.is_empty() {
                bail!(
                    "no attribute {name}; there are {}",
                    known(editor).join(", ")
                );
            }
            held.extend(parts.into_iter().map(|&part| Constraint {
                part,
                name: name.to_owned(),
                value,
                region: region.clone(),
            }));
        }
        Ok(editor.constrain(face, &held)?)
    }
}

/// Names of all attributes.
fn known(editor: &Editor) -> Vec<&str> {
    let mut names: Vec<&str> = [Part::Shape, Part::Texture]
        .into_iter()
        .flat_map(|part| editor.attributes(part))
        .map(|a| a.attribute.name.as_str())
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_numbers_are_three_and_finite() {
        assert_eq!(three("1, -2,0.5").expect("numbers"), [1.0, -2.0, 0.5]);
        for wrong in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "1,2,NaN"] {
            assert!(three(wrong).is_err(), "{wrong}");
        }
        assert!(
            number("NaN").is_err() && number("1e3").is_ok(),
            "NaN is rejected and an exponent is accepted"
        );
    }
}

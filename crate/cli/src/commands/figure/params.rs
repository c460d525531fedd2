//! Figure descriptions: a figure of the library with changes from a JSON file.

use std::io::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use clap::Args;
use raconteur_sculpt::head::ModelHeadShape;
use raconteur_sculpt::model::Model;
use raconteur_sculpt::people::{self, FigureParams};
use serde_json::Value;

use raconteur_voice::files::input;

use crate::{Outcome, terminal};

/// Print the description of a figure of the library, as JSON.
#[derive(Args)]
pub(super) struct Params {
    /// Name of the figure.
    name: String,
}

impl Params {
    pub(super) fn run(&self) -> Result<Outcome> {
        let value = serde_json::to_value(preset(&self.name)?)?;
        writeln!(terminal::out(), "{}", terminal::json_lines(&value)?)?;
        Ok(Outcome::Fine)
    }
}

/// Returns the parameters of a figure of the library.
pub(super) fn preset(name: &str) -> Result<FigureParams> {
    people::preset(name).with_context(|| {
        let known = people::NAMES.join(", ");
        format!("there is no figure named {name}; there are {known}")
    })
}

/// Reads a description from a file; `model` is the body model's folder, for heads that are not in the program.
pub(super) fn read(path: &Path, model: &Path) -> Result<FigureParams> {
    let text = input::text(path, MAX_FILE_BYTES as u64).context("the description")?;
    parse(&text, model).with_context(|| path.display().to_string())
}

/// Largest description that is read, bytes; a full one has some 5 kB.
const MAX_FILE_BYTES: usize = 1 << 20;

fn parse(text: &str, model: &Path) -> Result<FigureParams> {
    if text.len() > MAX_FILE_BYTES {
        bail!("a description has at most {MAX_FILE_BYTES} bytes");
    }
    let Value::Object(mut given) = serde_json::from_str(text)? else {
        bail!("a description is a JSON object");
    };
    let base = match given.remove("base") {
        None => people::NAMES[0].to_owned(),
        Some(Value::String(name)) => name,
        Some(other) => bail!("base: expected a name, found {other}"),
    };
    let base = preset(&base)?;
    let mut whole = serde_json::to_value(&base)?;
    overlay("", &mut whole, Value::Object(given))?;
    let mut params: FigureParams = serde_json::from_value(whole)?;
    check(&params)?;
    let own = &params.head.traits;
    params.head.bound = if *own == base.head.traits {
        base.head.bound
    } else {
        ModelHeadShape::evaluate(&Model::open(model)?, own)?
    };
    Ok(params)
}

/// Returns true if a value is an enum variant with contents, `{"Bob": …}`; such values are replaced
/// as a whole.
fn is_variant(value: &Value) -> bool {
    let only = value.as_object().filter(|o| o.len() == 1);
    only.and_then(|o| o.keys().next())
        .is_some_and(|name| name.starts_with(char::is_uppercase))
}

/// Overrides existing values by given ones; `place` is the path with a trailing dot.
fn overlay(place: &str, there: &mut Value, given: Value) -> Result<()> {
    let name = place.trim_end_matches('.');
    match (&mut *there, given) {
        (Value::Object(fields), Value::Object(given))
            if !is_variant(&Value::Object(fields.clone())) =>
        {
            for (key, value) in given {
                // Any detail of the body model may be set.
                if place.ends_with(".details.") {
                    fields.insert(key, value);
                    continue;
                }
                let Some(field) = fields.get_mut(&key) else {
                    let known: Vec<&str> = fields.keys().map(String::as_str).collect();
                    bail!("{place}{key} is not a field; known: {}", known.join(", "));
                };
                overlay(&format!("{place}{key}."), field, value)?;
            }
        }
        (Value::Array(items), Value::Array(given)) => {
            if items.len() != given.len() {
                bail!(
                    "{name}: expected {} values, found {}",
                    items.len(),
                    given.len()
                );
            }
            for (i, (item, value)) in items.iter_mut().zip(given).enumerate() {
                overlay(&format!("{place}{i}."), item, value)?;
            }
        }
        (Value::Number(_), given) if !given.is_number() => {
            bail!("{name}: expected a number, found {given}")
        }
        (Value::Bool(_), given) if !given.is_boolean() => {
            bail!("{name}: expected true or false, found {given}")
        }
        (Value::Array(_), given) => bail!("{name}: expected a list, found {given}"),
        (Value::String(_), given @ (Value::Number(_) | Value::Bool(_) | Value::Array(_))) => {
            bail!("{name}: expected a word, found {given}")
        }
        (Value::Object(_), given) if !given.is_object() && !given.is_string() => {
            bail!("{name}: expected an object, found {given}")
        }
        (_, given) => *there = given,
    }
    Ok(())
}

/// Checks that the parameters are within the generator's tables.
fn check(params: &FigureParams) -> Result<()> {
    let person = &params.person;
    for (name, value, low, high) in [
        ("person.sex", person.sex, 0.0, 1.0),
        ("person.age_years", person.age_years, 8.0, 80.0),
        ("person.stature_m", person.stature_m, 1.0, 2.2),
        ("person.build", person.build, -1.0, 1.0),
    ] {
        if !(low..=high).contains(&value) {
            bail!("{name}: expected {low} to {high}, found {value}");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parses test parameters that need no body model.
    fn parse(text: &str) -> Result<FigureParams> {
        super::parse(text, Path::new("nowhere"))
    }

    fn fault(text: &str) -> String {
        format!("{:#}", parse(text).unwrap_err())
    }

    #[test]
    fn an_empty_description_is_the_default_figure() {
        assert_eq!(parse("{}").unwrap(), preset("sofia").unwrap());
        assert_eq!(
            parse(r#"{"base": "nuno"}"#).unwrap(),
            preset("nuno").unwrap()
        );
    }

    #[test]
    fn what_is_known_of_the_person_reaches_every_region() {
        let params = parse(r#"{"person": {"age_years": 60, "stature_m": 1.6}}"#).unwrap();
        assert_eq!(params.person.age_years, 60.0);
        assert_eq!(params.hands().age_years, 60.0);
        let as_long = |p: &FigureParams| p.hands().length_m;
        assert!(
            as_long(&params) < as_long(&preset("sofia").unwrap()),
            "the arm is shorter than that of the adult"
        );
        let own = r#"{"person": {"stature_m": 1.6}, "hand": {"length": 1.1}}"#;
        assert!(
            as_long(&parse(own).unwrap()) > 1.05 * as_long(&params),
            "a shorter person has shorter hands"
        );
    }

    #[test]
    fn faults_name_their_field() {
        for (text, place) in [
            (r#"{"head": {"wobble": 1}}"#, "head.wobble"),
            (r#"{"person": {"age_years": "old"}}"#, "person.age_years"),
            (r#"{"person": {"age_years": 3}}"#, "person.age_years"),
            (r#"{"head": {"brow": 4}}"#, "head.brow"),
            (
                r#"{"head": {"traits": {"age_years": "old"}}}"#,
                "head.traits.age_years",
            ),
            // Another head wants the body model.
            (
                r#"{"head": {"traits": {"age_years": 60}}}"#,
                "npm run model",
            ),
            (r#"{"name": 4}"#, "name"),
            (r#"{"base": "nobody"}"#, "nobody"),
            ("[1]", "object"),
            ("{", "line 1"),
        ] {
            let fault = fault(text);
            assert!(fault.contains(place), "{text}: {fault}");
        }
    }
}

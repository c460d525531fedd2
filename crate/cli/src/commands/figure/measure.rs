//! `raconteur figure measure`.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use clap::Args;
use raconteur_body::annotation::{Annotations, annotations};
use raconteur_body::{Figure, read::read_figure};
use raconteur_sculpt::measure::{Reading, readings};
use raconteur_sculpt::physique::body_readings;
use raconteur_sculpt::reference_face::{Deviation, ReferenceFace, deviation};
use raconteur_sculpt::{AnnotatedFigure, FigureParams, people};
use serde_json::json;

use raconteur_voice::files::input;

use crate::{Format, Outcome, terminal};

/// The largest figure, and the largest table of measures, that is read, bytes.
const MAX_FIGURE_BYTES: u64 = 512 << 20;
const MAX_REFERENCE_BYTES: u64 = 256 << 20;

/// Measure a figure and compare it with the population.
#[derive(Args)]
pub(super) struct Measure {
    /// A figure's name, or the path of a .glb file.
    figure: String,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Sex of the population to compare with, 0 male to 1 female; the figure's own where it
    /// is known by name, else 0.5.
    #[arg(long)]
    sex: Option<f64>,
    /// Age to compare with, years; the figure's own where it is known by name, else 30.
    #[arg(long)]
    age: Option<f64>,
    /// Reference face for the distance: an OBJ file with vertex_indices.json next to it.
    #[arg(long)]
    against: Option<PathBuf>,
}

impl Measure {
    pub(super) fn run(&self) -> Result<Outcome> {
        let (built, params) = self.load()?;
        let AnnotatedFigure {
            figure,
            annotations: names,
        } = &built;
        let mut person = params.as_ref().map_or(
            raconteur_sculpt::Person {
                sex: 0.5,
                age_years: 30.0,
                stature_m: figure.skeleton.stature_m(),
                build: 0.0,
            },
            |p| p.person,
        );
        person.sex = self.sex.unwrap_or(person.sex);
        person.age_years = self.age.unwrap_or(person.age_years);
        if !(0.0..=1.0).contains(&person.sex) || !(8.0..=80.0).contains(&person.age_years) {
            bail!("statistics cover a sex of 0 to 1 and ages of 8 to 80");
        }
        let mut all = readings(
            figure,
            names,
            person,
            params.as_ref().map(FigureParams::hands).as_ref(),
        );
        // Only of a figure that is known by name is the body under the clothes known.
        if let Some(params) = &params {
            all.extend(body_readings(params, person, &built));
        }
        if all.is_empty() {
            bail!("{} has no landmarks to measure between", self.figure);
        }
        let against = self
            .against
            .as_deref()
            .map(|path| compare(path, figure, names))
            .transpose()?;
        match self.format {
            Format::Json => print_json(&self.figure, person, &all, against)?,
            Format::Text => print_text(&all, against)?,
        }
        Ok(Outcome::Fine)
    }

    /// Returns the figure with its landmarks and segments, and its parameters if it is a preset.
    fn load(&self) -> Result<(AnnotatedFigure, Option<FigureParams>)> {
        if let Some(params) = people::preset(&self.figure) {
            let built = raconteur_sculpt::build(&params);
            return Ok((built, Some(params)));
        }
        let path = Path::new(&self.figure);
        let glb = input::bytes(path, MAX_FIGURE_BYTES).context("the figure")?;
        let name = path
            .file_stem()
            .map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let figure = read_figure(&name, &glb).with_context(|| format!("in {}", path.display()))?;
        let annotations = annotations(&glb).with_context(|| format!("in {}", path.display()))?;
        let built = AnnotatedFigure {
            figure,
            annotations,
        };
        Ok((built, people::preset(&name)))
    }
}

fn compare(path: &Path, figure: &Figure, names: &Annotations) -> Result<Deviation> {
    let read = |p: &Path| input::text(p, MAX_REFERENCE_BYTES);
    let list = path.with_file_name("vertex_indices.json");
    let yardstick = ReferenceFace::read(&read(path)?, &read(&list)?)
        .with_context(|| format!("in {}", path.display()))?;
    deviation(figure, names, &yardstick).with_context(|| format!("against {}", path.display()))
}

/// Hundredths.
fn round(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

fn print_json(
    figure: &str,
    person: raconteur_sculpt::Person,
    all: &[Reading],
    against: Option<Deviation>,
) -> Result<()> {
    let measures: Vec<_> = all
        .iter()
        .map(|r| {
            json!({
                "name": r.name,
                "landmarks": r.landmarks,
                "mm": round(r.mm),
                "meanMm": round(r.norm.mean),
                "sdMm": round(r.norm.sd),
                "z": round(r.deviations()),
                "source": r.source,
            })
        })
        .collect();
    let mut report = json!({
        "figure": figure,
        "sex": person.sex,
        "ageYears": person.age_years,
        "measures": measures,
    });
    if let Some(d) = against {
        report["against"] = json!({
            "rmsMm": round(d.rms_mm),
            "p95Mm": round(d.p95_mm),
            "landmarksMm": round(d.landmarks_mm),
            "scale": round(d.scale),
            "points": d.count,
        });
    }
    writeln!(terminal::out(), "{}", terminal::json_lines(&report)?)?;
    Ok(())
}

fn print_text(all: &[Reading], against: Option<Deviation>) -> Result<()> {
    let mut out = terminal::out();
    writeln!(
        out,
        "{:26} {:>8} {:>8} {:>6} {:>6}",
        "mm", "own", "mean", "sd", "z"
    )?;
    for r in all {
        writeln!(
            out,
            "{:26} {:8.1} {:8.1} {:6.1} {:+6.2}  {}",
            r.name,
            r.mm,
            r.norm.mean,
            r.norm.sd,
            r.deviations(),
            r.landmarks,
        )?;
    }
    let within = all.iter().filter(|r| r.deviations().abs() <= 1.0).count();
    writeln!(
        out,
        "{within} of {} within one standard deviation",
        all.len()
    )?;
    if let Some(d) = against {
        writeln!(
            out,
            "from the yardstick: {:.2} mm RMS, {:.2} mm at the 95th percentile, over {} points",
            d.rms_mm, d.p95_mm, d.count
        )?;
    }
    Ok(())
}

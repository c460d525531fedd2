//! `raconteur faces check`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use indicatif::ProgressBar;
use raconteur_base::DVec3;
use raconteur_body::annotation::annotations;
use raconteur_body::read::read_figure;
use raconteur_faces::{Editor, FaceModel, PersonRecord};
use raconteur_sculpt::examples::measured_mm;
use raconteur_sculpt::head::{KnownMeasure, Measure, known_measures};
use raconteur_sculpt::population::known_correlation;

use super::put_on::PutOn;
use super::{crossing, pack};
use crate::commands::story_check::{self, StoryCheck};
use crate::story::StoryFiles;
use crate::{Outcome, assets, parallel, terminal};

/// Compare random faces of a pack with the population, and let some of them perform a story.
#[derive(Args)]
pub(super) struct Check {
    /// A pack that `faces learn` wrote.
    pack: PathBuf,
    /// Number of measured faces.
    #[arg(long, default_value_t = 1000)]
    count: u64,
    /// Number of faces checked for self-intersecting skin.
    #[arg(long, default_value_t = 200)]
    look: u64,
    /// Story performed by the faces: a script, or a folder that contains a story.eml.
    #[arg(long)]
    story: Option<PathBuf>,
    /// Number of faces that perform it.
    #[arg(long, default_value_t = 200)]
    tell: u64,
    /// Figure that wears the performing faces.
    #[arg(long, default_value = "kenji")]
    like: String,
}

/// Above it the sides of a head are the skull's, metres over the ears' entrances.
const SKULL_M: f64 = 0.035;
/// Means differ by a share at most, deviations by a share, correlations by so much.
const LIMITS: [f64; 3] = [0.03, 0.15, 0.15];

impl Check {
    pub(super) fn run(&self) -> Result<Outcome> {
        let editor = Editor::new(pack::read(&self.pack)?)?;
        let mut is_fine = self.measure(&editor)?;
        is_fine &= crossing::check(&editor, self.look)?;
        if let Some(story) = &self.story {
            let files = StoryFiles::read(story)?;
            is_fine &= self.perform_stories(&editor, &files)?;
        }
        Ok(if is_fine {
            Outcome::Fine
        } else {
            Outcome::Errors
        })
    }

    /// Returns true if the random faces match the population.
    fn measure(&self, editor: &Editor) -> Result<bool> {
        let model = editor.model();
        ensure!(
            !model.people.is_empty(),
            "the pack does not describe its people"
        );
        let of = |seed: u64| -> Result<Vec<f64>> {
            let face = editor.random(seed);
            let places = face.shape.as_chunks::<3>().0;
            let place = |name: &str| {
                let eye = |i: usize| face.organs.as_chunks::<3>().0.get(i);
                let found = model.landmarks.iter().find(|(known, _)| known == name);
                let p = match name {
                    // When a person looks straight ahead, the pupils are in front of the centres of
                    // the eyes.
                    "p_l" => eye(0),
                    "p_r" => eye(1),
                    // The broadest point of a skull differs between heads.
                    "eu_l" | "eu_r" => broadest(model, places, name == "eu_l"),
                    _ => places.get(found?.1 as usize),
                };
                p.map(|p| DVec3::from_array(*p))
            };
            Ok(measured_mm(&place).into_iter().map(|(_, mm)| mm).collect())
        };
        let found = MeasureStatistics::from_rows(&parallel::map(0..self.count, of)?);
        let all: Vec<KnownMeasure> = known_measures().collect();
        ensure!(found.mean.len() == all.len(), "the pack lacks landmarks");
        let wanted = MeasureStatistics::expected(&all, &model.people);
        let mut out = terminal::out();
        writeln!(
            out,
            "measure\tmean mm\twanted\toff %\tdeviation\twanted\toff %"
        )?;
        let mut is_fine = true;
        for (i, measure) in all.iter().enumerate() {
            let off = |a: f64, b: f64| a / b - 1.0;
            let mean = off(found.mean[i], wanted.mean[i]);
            let deviation = off(found.deviation[i], wanted.deviation[i]);
            let is_off = mean.abs() > LIMITS[0] || deviation.abs() > LIMITS[1];
            is_fine &= !is_off;
            writeln!(
                out,
                "{}\t{:.1}\t{:.1}\t{:+.1}\t{:.2}\t{:.2}\t{:+.1}{}",
                measure.name,
                found.mean[i],
                wanted.mean[i],
                100.0 * mean,
                found.deviation[i],
                wanted.deviation[i],
                100.0 * deviation,
                if is_off { "\toff" } else { "" }
            )?;
        }
        let measures: Vec<Measure> = Measure::all().collect();
        for i in 0..all.len() {
            for j in 0..i {
                if known_correlation(measures[i], measures[j]).is_none() {
                    continue;
                }
                let off = found.correlation(i, j) - wanted.correlation(i, j);
                if off.abs() > LIMITS[2] {
                    is_fine = false;
                    writeln!(
                        out,
                        "{} and {}: correlation off by {off:+.2}",
                        all[i].name, all[j].name
                    )?;
                }
            }
        }
        Ok(is_fine)
    }

    /// Returns true if random faces perform a story without a fault.
    fn perform_stories(&self, editor: &Editor, files: &StoryFiles) -> Result<bool> {
        let bytes = assets::read(&format!("figures/{}.glb", self.like))?;
        let names = annotations(&bytes)?;
        let on = PutOn::new(read_figure(&self.like, &bytes)?, editor.model())?;
        let bundle = files.bundle();
        let telling = StoryCheck {
            text: &files.text,
            bundle: bundle.as_deref(),
        };
        let bar = ProgressBar::new(self.tell);
        let told = parallel::map(0..self.tell, |seed| {
            let figure = on
                .figure(editor, &editor.random(seed))
                .with_context(|| format!("face {seed}"))?;
            bar.inc(1);
            Ok(telling.by(&format!("face {seed}"), figure, &names))
        })?;
        bar.finish_and_clear();
        let mut out = terminal::out();
        for wrong in told.iter().flat_map(|t| &t.wrong) {
            writeln!(out, "{wrong}")?;
        }
        story_check::summary(&told.iter().collect::<Vec<_>>())?;
        Ok(told.iter().all(|t| t.wrong.is_empty()))
    }
}

/// Returns the point of a head's skull above the ears that is farthest to a side.
fn broadest<'p>(model: &FaceModel, places: &'p [[f64; 3]], is_left: bool) -> Option<&'p [f64; 3]> {
    let skull = |(v, p): &(u32, &[f64; 3])| {
        p[1] > SKULL_M
            && model
                .segments
                .segment_of(*v)
                .is_none_or(|s| s.name != "ears")
    };
    let out = |p: &[f64; 3]| if is_left { p[0] } else { -p[0] };
    let above = (0u32..).zip(places).filter(skull);
    above
        .map(|(_, p)| p)
        .max_by(|a, b| out(a).total_cmp(&out(b)))
}

/// Means, deviations and products of measures.
struct MeasureStatistics {
    mean: Vec<f64>,
    deviation: Vec<f64>,
    /// Covariances, row by row.
    covariance: Vec<Vec<f64>>,
}

impl MeasureStatistics {
    /// Computes mean and covariance of rows of measures.
    fn from_rows(rows: &[Vec<f64>]) -> Self {
        let width = rows.first().map_or(0, Vec::len);
        let count = rows.len().max(1) as f64;
        let mean: Vec<f64> = (0..width)
            .map(|i| rows.iter().map(|r| r[i]).sum::<f64>() / count)
            .collect();
        let both = |i: usize, j: usize| {
            let product = |r: &Vec<f64>| (r[i] - mean[i]) * (r[j] - mean[j]);
            rows.iter().map(product).sum::<f64>() / count
        };
        let covariance: Vec<Vec<f64>> = (0..width)
            .map(|i| (0..width).map(|j| both(i, j)).collect())
            .collect();
        Self {
            deviation: (0..width).map(|i| covariance[i][i].sqrt()).collect(),
            mean,
            covariance,
        }
    }

    /// Returns the expected statistics of the population for people of these sexes and ages:
    /// variation within an age and a sex, and between them.
    fn expected(measures: &[KnownMeasure], people: &[PersonRecord]) -> Self {
        let norms: Vec<Vec<[f64; 2]>> = people
            .iter()
            .map(|p| {
                let norm = |m: &KnownMeasure| m.row.norm_at(p.sex, p.age_years);
                measures
                    .iter()
                    .map(|m| [norm(m).mean, norm(m).sd])
                    .collect()
            })
            .collect();
        let between: Vec<Vec<f64>> = norms
            .iter()
            .map(|row| row.iter().map(|n| n[0]).collect())
            .collect();
        let mut all = Self::from_rows(&between);
        let kinds: Vec<Measure> = Measure::all().collect();
        let count = norms.len().max(1) as f64;
        for i in 0..measures.len() {
            for j in 0..measures.len() {
                let known = if i == j {
                    1.0
                } else {
                    known_correlation(kinds[i], kinds[j]).unwrap_or(0.0)
                };
                let within = norms.iter().map(|n| n[i][1] * n[j][1]).sum::<f64>() / count;
                all.covariance[i][j] += known * within;
            }
        }
        all.deviation = (0..measures.len())
            .map(|i| all.covariance[i][i].sqrt())
            .collect();
        all
    }

    fn correlation(&self, i: usize, j: usize) -> f64 {
        self.covariance[i][j] / (self.deviation[i] * self.deviation[j])
    }
}

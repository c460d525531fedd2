//! `raconteur figure crowd`.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use clap::Args;
use raconteur_base::DVec3;
use raconteur_body::Figure;
use raconteur_body::annotation::Annotations;
use raconteur_player::sweep::sweep;
use raconteur_player::{Options, Player, StoryInput};
use raconteur_sculpt::crossing::{Skin, crossings};
use raconteur_sculpt::head::{Binding, HeadParams};
use raconteur_sculpt::model::{Detail, Model, Traits};
use raconteur_sculpt::{FigureParams, Person, build_face, examples, people};

use super::bind::MODEL;
use crate::story::StoryFiles;
use crate::{Outcome, parallel, terminal};

/// Let people drawn at random from the body model tell a story, and report what a viewer would
/// notice of their faces.
#[derive(Args)]
pub(super) struct Crowd {
    /// A script, or a folder that holds a story.eml.
    story: PathBuf,
    /// How many people.
    #[arg(long, default_value_t = 20)]
    count: u64,
    /// Number of the first of them.
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Another seed is another crowd.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
}

/// What everyone shares.
struct Stage {
    model: Model,
    details: Vec<Detail>,
    binding: Binding,
    text: String,
    bundle: Option<Vec<u8>>,
    seed: u64,
}

/// What was found of one person: worst values by what they are, and what is beyond its limit.
struct Found {
    worst: BTreeMap<&'static str, f64>,
    wrong: Vec<String>,
    evaluation: Duration,
}

impl Crowd {
    pub(super) fn run(&self) -> Result<Outcome> {
        let model = Model::open(&self.model)?;
        let files = StoryFiles::read(&self.story)?;
        let stage = Stage {
            details: model.details()?,
            binding: Binding::new(model.faces()),
            model,
            text: files.text.clone(),
            bundle: files.bundle(),
            seed: self.seed,
        };
        let all = parallel::each(self.first..self.first + self.count, |index| {
            let found = stage.look(index)?;
            let mut out = terminal::out();
            for wrong in &found.wrong {
                writeln!(out, "{wrong}")?;
            }
            Ok(found)
        })?;
        summary(&all)?;
        let is_fine = all.iter().all(|found| found.wrong.is_empty());
        Ok(if is_fine {
            Outcome::Fine
        } else {
            Outcome::Errors
        })
    }
}

impl Stage {
    fn look(&self, index: u64) -> Result<Found> {
        let traits = Traits::random(&self.details, self.seed, index);
        let shape = self.model.shape(&traits)?;
        // Again, with its targets read.
        let began = Instant::now();
        let bound = self.binding.bind(&self.model.shape(&traits)?);
        let evaluation = began.elapsed();
        drop(shape);
        let a = traits.ancestry;
        let whole = (a.african + a.asian + a.european) / 100.0;
        let who = format!(
            "{index}: {} of {:.0}, African {:.0} %, Asian {:.0} %, European {:.0} %",
            if traits.sex > 0.5 { "woman" } else { "man" },
            traits.age_years,
            a.african / whole,
            a.asian / whole,
            a.european / whole,
        );
        let like = people::preset("sofia").context("a figure to start from")?;
        let params = FigureParams {
            person: Person {
                sex: traits.sex,
                age_years: traits.age_years,
                stature_m: examples::stature_m(&traits),
                build: 0.0,
            },
            head: HeadParams {
                traits,
                bound,
                ..like.head
            },
            ..like
        };
        let built = build_face(&params);
        let mut worst = crossed(&built.figure, &built.annotations);
        let mut wrong: Vec<String> = worst
            .iter()
            .filter(|(place, count)| **place != "crossing elsewhere" && **count > 0.0)
            .map(|(place, count)| format!("{who}: {place}: {count} triangles"))
            .collect();
        let mut player = Player::load(StoryInput {
            eml: &self.text,
            bundle: self.bundle.as_deref(),
            figure: built.figure.into(),
            options: Options::default(),
        })
        .player;
        for check in sweep(&mut player)
            .into_iter()
            .filter(|c| is_of_face(c.name))
        {
            worst.insert(check.name, check.worst);
            if !check.is_ok() {
                wrong.push(format!(
                    "{who}: {}: {:.3} of {} {} at {:.3} s, {}",
                    check.name, check.worst, check.limit, check.unit, check.at_secs, check.location
                ));
            }
        }
        Ok(Found {
            worst,
            wrong,
            evaluation,
        })
    }
}

/// Whether a check of a sweep looks at the face: bodies are all alike here.
fn is_of_face(check: &str) -> bool {
    ["lip", "lids", "mouth", "skin"]
        .iter()
        .any(|start| check.starts_with(start))
}

/// How near to its landmarks a crossing belongs to lids or lips, metres, and those landmarks.
const LIDS: (f64, [&str; 8]) = (
    0.009,
    [
        "en_l", "ex_l", "ps_l", "pi_l", "en_r", "ex_r", "ps_r", "pi_r",
    ],
);
const LIPS: (f64, [&str; 8]) = (
    0.012,
    [
        "ch_l", "ch_r", "cph_l", "cph_r", "sto", "li", "mvi_l", "mvi_r",
    ],
);

/// Pairs of triangles that cross at lids, at lips and elsewhere.
fn crossed(figure: &Figure, names: &Annotations) -> BTreeMap<&'static str, f64> {
    let skin = Skin::of(figure);
    let place = |name: &&str| {
        let landmark = names.landmark(name)?;
        let p = figure.meshes[landmark.mesh].positions[landmark.vertex as usize];
        Some(DVec3::from_array(p.map(f64::from)))
    };
    let is_near = |p: DVec3, (most, landmarks): &(f64, [&str; 8])| {
        landmarks
            .iter()
            .filter_map(place)
            .any(|at| at.distance(p) < *most)
    };
    let mut counts = BTreeMap::from([
        ("crossing at lids", 0.0),
        ("crossing at lips", 0.0),
        ("crossing elsewhere", 0.0),
    ]);
    for [a, _] in crossings(&skin.points, &skin.triangles) {
        let p = skin.points[skin.triangles[a][0] as usize];
        let name = if is_near(p, &LIDS) {
            "crossing at lids"
        } else if is_near(p, &LIPS) {
            "crossing at lips"
        } else {
            "crossing elsewhere"
        };
        *counts.entry(name).or_default() += 1.0;
    }
    counts
}

fn summary(all: &[Found]) -> Result<()> {
    let mut out = terminal::out();
    let fine = all.iter().filter(|f| f.wrong.is_empty()).count();
    writeln!(
        out,
        "{fine} of {} people tell it without a fault",
        all.len()
    )?;
    let names = all.first().map(|f| f.worst.keys()).into_iter().flatten();
    for name in names {
        let mut values: Vec<f64> = all
            .iter()
            .filter_map(|f| f.worst.get(name))
            .copied()
            .collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[((values.len() - 1) as f64 * share) as usize];
        writeln!(
            out,
            "  {name:<26} median {:8.3}, 95 % {:8.3}, worst {:8.3}",
            at(0.5),
            at(0.95),
            at(1.0)
        )?;
    }
    let total: Duration = all.iter().map(|f| f.evaluation).sum();
    let mean = total.as_secs_f64() * 1e3 / all.len().max(1) as f64;
    writeln!(out, "  evaluation of a head, mean {mean:.1} ms")?;
    Ok(())
}

//! Visible faults of storytelling faces, at rest and in motion.

use std::collections::BTreeMap;
use std::io::Write as _;

use anyhow::Result;
use raconteur_base::DVec3;
use raconteur_base::self_intersection::crossings;
use raconteur_body::Figure;
use raconteur_body::annotation::Annotations;
use raconteur_player::sweep::sweep;
use raconteur_player::{Options, Player, StoryInput};
use raconteur_sculpt::crossing::Skin;

use crate::terminal;

/// Story for face checks: script text and its speech bundle.
pub(crate) struct StoryCheck<'a> {
    /// The script.
    pub(crate) text: &'a str,
    /// Speech bundle of the story; `None` for a story without one.
    pub(crate) bundle: Option<&'a [u8]>,
}

/// Findings about one face in a performed story: the worst value of each check, and the values
/// beyond their limit.
pub(crate) struct FaceReport {
    pub(crate) worst: BTreeMap<&'static str, f64>,
    pub(crate) wrong: Vec<String>,
}

impl StoryCheck<'_> {
    /// Performs the story with a figure; `who` names it in the findings.
    pub(crate) fn by(&self, who: &str, figure: Figure, names: &Annotations) -> FaceReport {
        let mut worst = crossed(&figure, names);
        let mut wrong: Vec<String> = worst
            .iter()
            .filter(|(place, count)| **place != "crossing elsewhere" && **count > 0.0)
            .map(|(place, count)| format!("{who}: {place}: {count} triangles"))
            .collect();
        let mut player = Player::load(StoryInput {
            eml: self.text,
            bundle: self.bundle,
            figure: figure.into(),
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
        FaceReport { worst, wrong }
    }
}

/// Returns true if a sweep check concerns the face: all bodies are equal here.
fn is_of_face(check: &str) -> bool {
    ["lip", "lids", "mouth", "skin"]
        .iter()
        .any(|start| check.starts_with(start))
}

/// Maximum distance of an intersection from lid or lip landmarks, metres, and those landmarks.
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
    let skin = Skin::from_figure(figure);
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

/// Prints the number of faultless performances, and each value over all of them.
pub(crate) fn summary(all: &[&FaceReport]) -> Result<()> {
    let mut out = terminal::out();
    let fine = all.iter().filter(|f| f.wrong.is_empty()).count();
    writeln!(
        out,
        "{fine} of {} people perform it without a fault",
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
    Ok(())
}

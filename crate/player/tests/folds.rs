//! Dents: no muscle activity makes a deep narrow fold where faces have none.

mod common;

use common::{read, turn};
use raconteur_actor::articulation::{ORDINARY_LOUDNESS, articulate, hold_closures};
use raconteur_actor::emotion::{BasicEmotion, Expression};
use raconteur_actor::lips::MouthTargets;
use raconteur_base::noise;
use raconteur_player::body::Figure;
use raconteur_player::body::face::{FaceControls, Muscle, Network, NodeState, Tissue};
use raconteur_player::sweep::{Fold, Folds, MAX_FOLD_DEPTH_MM};
use raconteur_speech::phones;
use raconteur_tier::{FIGURES, share, sized};

/// A face with its measuring points.
struct Face {
    figure: std::sync::Arc<Figure>,
    network: Network,
    folds: Folds,
    nodes: Vec<NodeState>,
}

impl Face {
    fn read(name: &str) -> Self {
        let figure = read(name);
        let tissue = figure.tissue.as_ref().expect("tissue");
        Self {
            network: Network::new(tissue),
            folds: Folds::new(&figure).expect("a face"),
            nodes: vec![NodeState::default(); tissue.rest.len()],
            figure,
        }
    }

    /// The deepest fold once the face is at rest under these controls.
    fn fold(&mut self, controls: &FaceControls) -> Fold {
        let tissue: &Tissue = self.figure.tissue.as_ref().expect("tissue");
        self.network.settle(tissue, controls);
        self.network.write(tissue, 1.0, &mut self.nodes);
        self.folds.deepest(&self.figure, &self.nodes)
    }
}

fn phone(row: &phones::PhoneTargets) -> FaceControls {
    let mut controls = FaceControls::default();
    articulate(
        &MouthTargets::from_phone(row),
        ORDINARY_LOUDNESS,
        &mut controls,
    );
    controls
}

/// Returns all test controls of a figure: single muscles, its share of the phones in each of six
/// expressions, and random sums.
fn all(name: &str) -> Vec<(String, FaceControls)> {
    let mut all = Vec::new();
    for muscle in Muscle::all() {
        let mut controls = FaceControls::default();
        controls.contraction[muscle.index()] = 1.0;
        all.push((format!("{muscle:?}"), controls));
    }
    let rows: Vec<_> = phones::all().collect();
    for row in share(&rows, turn(name), FIGURES.len()) {
        for basic in BasicEmotion::ALL {
            let mut controls = phone(row);
            Expression::from_basic(basic).add(&mut controls);
            all.push((format!("{} in {basic:?}", row.name), controls));
        }
    }
    for i in 0..sized(20, 84) {
        let u = |id: u64| noise::unit(turn(name) as u64, id, i);
        let mut controls = phone(rows[(u(0) * rows.len() as f64) as usize]);
        // A third of the muscles, up to all they can.
        for muscle in Muscle::all() {
            let id = 1 + muscle.index() as u64;
            if u(id) < 0.33 {
                controls.contraction[muscle.index()] += u(100 + id);
            }
        }
        all.push((format!("random {i}"), controls));
    }
    for (_, controls) in &mut all {
        hold_closures(controls);
        controls.limit();
    }
    all
}

#[test]
fn no_muscle_phone_or_expression_dents_a_face() {
    let mut wrong = Vec::new();
    for name in FIGURES {
        let mut face = Face::read(name);
        assert!(face.folds.count() > 800, "{}", face.folds.count());
        for (what, controls) in all(name) {
            let fold = face.fold(&controls);
            let depth_mm = 1e3 * f64::from(fold.depth_m);
            if depth_mm > MAX_FOLD_DEPTH_MM {
                let place = fold.place.map(|x| (x * 1e3).round());
                wrong.push(format!("{name} {what}: {depth_mm:.2} mm at {place:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}\n{}", wrong.len(), wrong.join("\n"));
}

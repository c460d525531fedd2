//! Springs and muscles of a face as lines over the body.

mod common;

use common::figure;
use raconteur_player::stage::Line;
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput};

fn perform(clauses: &str) -> Player {
    let eml =
        format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{clauses}<null time='9'/></body></eml>");
    let LoadedPlayer {
        player,
        diagnostics,
    } = Player::load(StoryInput {
        eml: &eml,
        bundle: None,
        figure: figure(),
        options: Options::default(),
    });
    assert_eq!(diagnostics, []);
    player
}

fn lines(player: &mut Player, time_secs: f64) -> Vec<Line> {
    player.frame(time_secs, 1.0).lines.clone()
}

#[test]
fn every_spring_and_fibre_is_drawn_where_the_face_is() {
    let figure = figure();
    let tissue = figure.tissue.as_ref().expect("a tissue");
    let pieces: usize = tissue.fibres.iter().map(|f| usize::from(f.count) - 1).sum();
    let springs = 2 * tissue.quads.len();
    let mut plain = perform("");
    assert_eq!(lines(&mut plain, 3.0), []);
    for (attributes, count) in [
        ("r:areSpringsVisible='true'", springs),
        ("r:areMusclesVisible='true'", pieces),
        (
            "r:areSpringsVisible='true' r:areMusclesVisible='true'",
            springs + pieces,
        ),
    ] {
        let mut player = perform(&format!("<body-configure-geometry time='1' {attributes}/>"));
        assert_eq!(lines(&mut player, 0.9), []);
        let drawn = lines(&mut player, 3.0);
        assert_eq!(drawn.len(), count, "{attributes}");
        let stature_m = figure.skeleton.stature_m() as f32;
        for line in drawn {
            for [x, y, z] in [line.from_in_world, line.to_in_world] {
                assert!(x.abs() < 0.2 && z.abs() < 0.3, "{x} {z}");
                assert!((0.8..1.05).contains(&(y / stature_m)), "{y}");
            }
        }
        assert_eq!(lines(&mut player, 0.9), [], "sought back");
    }
}

#[test]
fn bone_lies_under_the_skin_and_goes_with_the_jaw() {
    let show = "<body-configure-geometry time='0' r:isSkullVisible='true'/>";
    let open = "<body-set-control-parameter time='0' parameterId='Jaw' value='1'/>";
    let mut rest = perform(show);
    let mut opened = perform(&format!("{show}{open}"));
    let (rest, opened) = (lines(&mut rest, 3.0), lines(&mut opened, 3.0));
    assert!(
        rest.len() > 4000 && rest.len() == opened.len(),
        "{}",
        rest.len()
    );
    let both = rest.iter().zip(&opened);
    let drops = both.map(|(a, b)| a.from_in_world[1] - b.from_in_world[1]);
    // The chin drops by a centimetre and more; the forehead stays.
    assert!(
        drops.fold(0.0, f32::max) > 0.01,
        "the chin moves with the jaw"
    );
    let highest = |all: &[Line]| all.iter().map(|l| l.from_in_world[1]).fold(0.0, f32::max);
    assert!(
        (highest(&rest) - highest(&opened)).abs() < 1e-3,
        "the top of the skull stays in place"
    );
}

#[test]
fn a_muscle_that_contracts_is_shorter_and_brighter() {
    let figure = figure();
    let tissue = figure.tissue.as_ref().expect("a tissue");
    let shown = "<body-configure-geometry time='0' r:areMusclesVisible='true'/>";
    let set = "<body-set-control-parameter time='0' parameterId='ZygomaticusMajorLeft' value='1'/>";
    let mut rest = perform(shown);
    let mut smile = perform(&format!("{shown}{set}"));
    let (rest, smile) = (lines(&mut rest, 3.0), lines(&mut smile, 3.0));
    let length = |l: &Line| {
        let [a, b] = [l.from_in_world, l.to_in_world];
        let way = [0, 1, 2].map(|k| f64::from(b[k] - a[k]));
        (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt()
    };
    let mut at = 0;
    let mut seen = 0;
    for fibre in &tissue.fibres {
        let own = at..at + usize::from(fibre.count) - 1;
        at = own.end;
        let lengths = [&rest, &smile].map(|l| l[own.clone()].iter().map(length).sum::<f64>());
        if fibre.muscle.name() == "ZygomaticusMajorLeft" {
            seen += 1;
            assert!(lengths[1] < 0.9 * lengths[0], "{lengths:?}");
            assert!(
                smile[own.start].color[0] > rest[own.start].color[0],
                "a contracted muscle is brighter"
            );
        } else if fibre.muscle.name() == "FrontalisMedialRight" {
            assert!((lengths[1] / lengths[0] - 1.0).abs() < 0.02, "{lengths:?}");
        }
    }
    assert!(seen > 0, "at least one muscle is compared");
}

//! Faces of the model on figures of the library: each speaks immediately.

mod common;

use std::sync::{Arc, OnceLock};

use common::{asset, perform, read, text};
use raconteur_faces::{Editor, FaceModel};
use raconteur_player::Options;
use raconteur_player::body::Figure;
use raconteur_player::reshape::{NewFace, NewOrgans, Reshaper};
use raconteur_player::sweep::sweep;

fn editor() -> &'static Editor {
    static EDITOR: OnceLock<Editor> = OnceLock::new();
    EDITOR.get_or_init(|| {
        let model = FaceModel::from_bytes(&asset("faces/people.faces")).expect("a pack");
        let mut editor = Editor::new(model).expect("a mesh");
        let textures = asset("faces/people.skins");
        editor.add_texture(&textures).expect("textures");
        editor
    })
}

/// A figure with a random face.
fn with_face(figure: &Figure, seed: u64) -> Arc<Figure> {
    let editor = editor();
    let face = editor.random(seed);
    let texture = editor.model().texture.as_ref().expect("textures");
    let factors = texture.factors(&face.texture, &figure.name);
    let factors = factors.expect("a figure of the library");
    let reshaper = Reshaper::new(figure.clone(), editor.model().vertices()).expect("our head");
    let made = reshaper.with_face(&NewFace {
        skin: &editor.drawn(&face),
        tone: &factors.skin,
        organs: NewOrgans::from_numbers(&face.organs).expect("organs"),
        iris: factors.iris,
        brows: factors.brows,
    });
    Arc::new(made.expect("a face"))
}

/// Returns true for sweep checks of the face.
fn of_face(name: &str) -> bool {
    ["lip", "lids", "mouth", "skin"]
        .iter()
        .any(|start| name.starts_with(start))
}

#[test]
fn random_faces_tell_hello_world_well() {
    let eml = text("stories/hello-world/story.eml");
    let bundle = asset("stories/hello-world/voice/speech.json");
    let mut wrong = Vec::new();
    for (name, seed) in [("sofia", 1), ("kenji", 2), ("lia", 3), ("amara", 4)] {
        let figure = with_face(&read(name), seed);
        let mut player = perform(&eml, Some(&bundle), figure, Options::default()).player;
        let faults = sweep(&mut player).into_iter();
        let faults = faults.filter(|check| of_face(check.name) && !check.is_ok());
        wrong.extend(faults.map(|check| format!("{name} with face {seed}: {check:?}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_face_that_comes_in_the_middle_changes_no_movement() {
    let eml = text("stories/hello-world/story.eml");
    let bundle = asset("stories/hello-world/voice/speech.json");
    let sofia = read("sofia");
    let play = || perform(&eml, Some(&bundle), Arc::clone(&sofia), Options::default()).player;
    let (mut own, mut other) = (play(), play());
    own.frame(1.0, 1.0);
    other.frame(1.0, 1.0);
    other.set_face(with_face(&sofia, 9));
    for time in [1.04, 1.5, 2.0, 0.3] {
        let joints = |player: &mut raconteur_player::Player| {
            let frame = player.frame(time, 1.0);
            // Everything except the eyes and their descendants is unchanged.
            frame.world_from_joint[..54].to_vec()
        };
        assert_eq!(joints(&mut own), joints(&mut other), "{time}");
        assert_eq!(
            own.last_frame().tissue.len(),
            other.last_frame().tissue.len()
        );
    }
}

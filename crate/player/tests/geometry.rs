//! body-configure-geometry: every attribute changes the frame at its time.

use std::sync::Arc;

use raconteur_player::body::{Figure, Skeleton};
use raconteur_player::stage::{Fill, Visibility};
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput};

/// Every figure with a skeleton answers the switches.
fn perform(clauses: &str) -> Player {
    let figure = Figure {
        name: "example".to_owned(),
        skeleton: Skeleton::example(),
        inverse_bind: Vec::new(),
        meshes: Vec::new(),
        morph_names: Vec::new(),
        lid_closure_rad: [0.0; 2],
        sex: None,
        dominant_hand: raconteur_player::base::Side::Right,
        images: Vec::new(),
        tissue: None,
        springs: raconteur_body::Springs::default(),
    };
    let LoadedPlayer {
        player,
        diagnostics,
    } = Player::load(StoryInput {
        eml: &format!(
            "<eml xmlns:r='urn:raconteur:eml:1'><body>{clauses}<null time='10'/></body></eml>"
        ),
        bundle: None,
        figure: Arc::new(figure),
        options: Options::default(),
    });
    assert_eq!(diagnostics, []);
    player
}

fn shown(player: &mut Player, time_secs: f64) -> Visibility {
    player.frame(time_secs, 1.6).visibility
}

#[test]
fn every_attribute_switches_from_its_time_on() {
    type Expected = fn(&mut Visibility);
    let cases: [(&str, Expected); 14] = [
        ("fillMode='wireframe'", |s| s.fill = Fill::Wireframe),
        ("fillMode='point'", |s| s.fill = Fill::Points),
        ("visibleMeshes='bones'", |s| {
            s.body = false;
            s.bones = true;
        }),
        ("visibleMeshes='both'", |s| s.bones = true),
        ("visibleMeshes='body'", |_| {}),
        ("areFramesVisible='true'", |s| s.frames = true),
        ("areHierarchyCentersVisible='true'", |s| s.centers = true),
        ("areMaterialsActive='false'", |s| s.materials = false),
        ("areTexturesActive='false'", |s| s.textures = false),
        ("areManipulatorsVisible='true'", |s| s.manipulators = true),
        ("r:isBodyVisible='false'", |s| s.body = false),
        ("r:areSpringsVisible='true'", |s| s.springs = true),
        ("r:areMusclesVisible='true'", |s| s.muscles = true),
        ("r:isSkullVisible='true'", |s| s.skull = true),
    ];
    for (attribute, change) in cases {
        let mut player = perform(&format!("<body-configure-geometry time='2' {attribute}/>"));
        let mut expected = Visibility::default();
        assert_eq!(shown(&mut player, 1.999), expected, "before {attribute}");
        change(&mut expected);
        assert_eq!(shown(&mut player, 2.0), expected, "{attribute}");
        assert_eq!(shown(&mut player, 9.0), expected, "after {attribute}");
        assert_eq!(
            shown(&mut player, 0.0),
            Visibility::default(),
            "sought back"
        );
    }
}

#[test]
fn what_is_left_out_stays_and_what_is_said_again_changes_back() {
    let mut player = perform(
        "<body-configure-geometry time='1' fillMode='point' areFramesVisible='true'/>\
         <body-configure-geometry time='2' visibleMeshes='both'/>\
         <body-configure-geometry time='3' fillMode='solid'/>",
    );
    let both = Visibility {
        fill: Fill::Points,
        frames: true,
        bones: true,
        ..Visibility::default()
    };
    assert_eq!(shown(&mut player, 2.5), both);
    let solid = Visibility {
        fill: Fill::Solid,
        ..both
    };
    assert_eq!(shown(&mut player, 3.5), solid);
}

#[test]
fn live_clauses_switch_it_for_good() {
    let mut player = perform("<body-configure-geometry time='6' areFramesVisible='true'/>");
    player.set_open_ended(true);
    let fragment = "<body-configure-geometry time='0' areTexturesActive='false'/>";
    assert_eq!(player.perform(1, fragment, 3.0).diagnostics, []);
    assert!(
        shown(&mut player, 2.9).textures,
        "textures are visible before the clause"
    );
    assert!(
        !shown(&mut player, 3.0).textures,
        "textures are hidden after the clause"
    );
    let later = shown(&mut player, 7.0);
    assert!(
        !later.textures && later.frames,
        "frames are visible after the second clause"
    );
    // Regardless of the number of clauses, the first ones keep their effect.
    for i in 0..300 {
        let now_secs = 10.0 + f64::from(i);
        let on = i % 2 == 0;
        let fragment = format!("<body-configure-geometry time='0' areFramesVisible='{on}'/>");
        assert_eq!(player.perform(1, &fragment, now_secs).diagnostics, []);
    }
    let last = shown(&mut player, 400.0);
    assert!(
        !last.textures && !last.frames,
        "frames are hidden after the last clause"
    );
    assert!(
        shown(&mut player, 308.5).frames,
        "an earlier clause keeps its effect"
    );
}

#[test]
fn handles_tell_where_gestures_lead_the_hands() {
    let mut player = perform(
        "<gesture-key time='3' duration='1' handedness='right'><motion>\
         <key x='-8' y='20' z='-14'/></motion></gesture-key>",
    );
    let resting = &player.frame(0.5, 1.6).handles;
    assert!(resting.is_empty(), "{resting:?}");
    let wanted = player.hand_targets(3.5)[1].target_in_world;
    let handles = &player.frame(3.5, 1.6).handles;
    let told: Vec<_> = handles.iter().map(|h| h.translation).collect();
    assert_eq!(told, [wanted]);
}

#[test]
fn a_leg_has_a_handle_while_its_manipulator_leads_it() {
    let mut player = perform(
        "<body-non-deterministic-frame-interpolation time='1' manipulator='leftLeg' \
         timePeriod='1' posX='7.5' posY='20' posZ='-10' roll='-90'/>",
    );
    assert!(
        player.frame(0.5, 1.6).handles.is_empty(),
        "no handle exists before the manipulator starts"
    );
    let wanted = player.units().world_point([7.5, 20.0, -10.0]);
    let handles = &player.frame(4.0, 1.6).handles;
    assert_eq!(handles.len(), 1);
    assert!(
        handles[0].translation.distance(wanted) < 1e-6,
        "the handle is at the position of its manipulator"
    );
}

//! Allocation test: playing allocates nothing, as counted by the allocator.

mod common;
#[path = "../../body/tests/common/counting.rs"]
mod counting;

use common::{figure, perform, story};
use counting::counted;
use raconteur_player::{Options, Player};
use raconteur_tier::sized;

/// Gestures with all features: courses, phases, mixed shapes, hands that meet.
const GESTURES: &str = "<eml xmlns:r='urn:raconteur:eml:1'><body>
    <gesture-key time='1' duration='1' handedness='both' r:phase='preparation'>
      <hand-shapes><key id='24' r:id2='7'/></hand-shapes>
      <palms r:space='joint'><key a='90' x='1' y='0' z='0'/></palms>
      <motion><key x='-2' y='12' z='-11'/></motion>
    </gesture-key>
    <gesture-key time='2' duration='1' handedness='both' r:interpolation='hermite'
        r:controls='0 2'>
      <motion r:space='joint' r:interpolation='cosine'>
        <key x='-2' y='12' z='-11'/><key x='-9' y='18' z='-12'/>
      </motion>
    </gesture-key>
    <gesture-key time='3' duration='1' handedness='both' r:phase='retraction'/>
    <null time='6'/></body></eml>";

/// Emotions one after the other and together, and control parameters of every kind.
const FACE: &str = "<eml xmlns:r='urn:raconteur:eml:1'><body>
    <r:emotion time='0' type='joy'/><r:emotion time='1' type='fear' duration='2'/>
    <r:emotion time='1' type='hate'/>
    <body-set-control-parameter time='0.5' parameterId='Surprise' value='0.7'/>
    <body-set-control-parameter time='0.5' parameterId='PP' value='1'/>
    <body-set-control-parameter time='2' parameterId='GazeX' value='1'/>
    <body-animate-ADSR-control-parameter time='2' parameterId='Frontalis'
        attackDurationTime='1' releaseDurationTime='1'/>
    <null time='6'/></body></eml>";

/// Duration of a story played in the gate, seconds.
const GATE_SECS: f64 = 20.0;

/// Allocations while a story is played at 60 frames a second, the first frame aside.
fn allocations(mut player: Player) -> usize {
    player.frame(0.0, 1.6);
    let secs = sized(player.end_secs().min(GATE_SECS), player.end_secs());
    let frames = (secs * 60.0) as u32;
    counted(|| {
        for i in 0..frames {
            player.frame(f64::from(i) / 60.0, 1.6);
        }
    })
}

#[test]
fn a_frame_of_gestures_allocates_nothing() {
    let player = perform(GESTURES, None, figure(), Options::default()).player;
    assert_eq!(allocations(player), 0);
}

#[test]
fn a_frame_of_a_story_allocates_nothing() {
    // Gestures; animation players; manipulators.
    for name in ["white-rabbit", "step-lesson", "mathematical-dance"] {
        let player = story(name, figure(), Options::default()).player;
        assert_eq!(allocations(player), 0, "{name}");
    }
}

#[test]
fn a_frame_of_a_face_that_feels_allocates_nothing() {
    let player = perform(FACE, None, figure(), Options::default()).player;
    assert_eq!(allocations(player), 0);
}

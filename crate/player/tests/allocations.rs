//! Playing allocates nothing: counted by the allocator.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use raconteur_player::body::read::read_figure;
use raconteur_player::{Options, Player, StoryInput};

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, which counts what this thread asks for.
struct Counting;

#[expect(unsafe_code, reason = "an allocator cannot be written without")]
// SAFETY: everything is passed on to the system's allocator as it comes.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promises are the system allocator's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        // SAFETY: as above.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Gestures with everything that they may have: courses, phases, mixed shapes, hands that
/// meet.
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

fn assets() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

/// Allocations while a story is played at 60 frames a second, the first frame aside.
fn allocations(eml: &str, bundle: Option<&[u8]>) -> usize {
    let file = assets().join("figures/sofia.glb");
    let figure = read_figure("sofia", &fs::read(file).expect("a figure")).expect("a figure");
    let mut player = Player::load(StoryInput {
        eml,
        bundle,
        figure: Arc::new(figure),
        options: Options::default(),
    })
    .player;
    player.frame(0.0, 1.6);
    let frames = (player.end_secs() * 60.0) as u32;
    let before = COUNT.with(Cell::get);
    for i in 0..frames {
        player.frame(f64::from(i) / 60.0, 1.6);
    }
    COUNT.with(Cell::get) - before
}

#[test]
fn the_count_counts() {
    let before = COUNT.with(Cell::get);
    drop(std::hint::black_box(Box::new(1)));
    assert_eq!(COUNT.with(Cell::get) - before, 1);
}

#[test]
fn a_frame_of_gestures_allocates_nothing() {
    assert_eq!(allocations(GESTURES, None), 0);
}

#[test]
fn a_frame_of_a_story_allocates_nothing() {
    let story = assets().join("stories/white-rabbit");
    let eml = fs::read_to_string(story.join("story.eml")).expect("a story");
    let bundle = fs::read(story.join("voice/speech.json")).expect("its voice");
    assert_eq!(allocations(&eml, Some(&bundle)), 0);
}

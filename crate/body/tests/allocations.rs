//! A step of the soft face allocates nothing: counted by the allocator.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use raconteur_base::noise;
use raconteur_body::face::{FaceControls, Network, NodeState};
use raconteur_body::read::read_figure;

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

fn counted(what: impl FnOnce()) -> usize {
    let before = COUNT.with(Cell::get);
    what();
    COUNT.with(Cell::get) - before
}

#[test]
fn the_count_counts() {
    assert_eq!(counted(|| drop(std::hint::black_box(Box::new(1)))), 1);
}

#[test]
fn a_face_that_jumps_allocates_nothing_and_neither_does_its_copy() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../assets/figures/sofia.glb"
    );
    let figure = read_figure("sofia", &std::fs::read(path).expect("a figure")).expect("a figure");
    let tissue = figure.tissue.as_ref().expect("tissue");
    let mut network = Network::new(tissue);
    let mut nodes = vec![NodeState::default(); tissue.rest.len()];
    for _ in 0..2 {
        let rest = FaceControls::default();
        let count = counted(|| {
            network.reset(tissue, &rest, &rest);
            for i in 0..100 {
                let mut controls = rest;
                for (k, c) in (0u64..).zip(&mut controls.contraction) {
                    *c = noise::unit(3, k, i);
                }
                controls.seal = noise::unit(3, 100, i);
                controls.bite = noise::unit(3, 101, i);
                controls.jaw.pitch_rad = 0.3 * noise::unit(3, 102, i);
                network.step(tissue, &controls);
                network.write(tissue, 0.5, &mut nodes);
                for mesh in &figure.meshes {
                    for moved in mesh.binding.iter().flat_map(|b| b.apply(&nodes)) {
                        std::hint::black_box(moved);
                    }
                }
            }
        });
        assert_eq!(count, 0);
        network = network.clone();
    }
}

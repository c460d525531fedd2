//! Memory costs of a script: bytes and allocations per clause, at the peak of reading and in the
//! memory that stays in use.

#[path = "../../../crate/eml/tests/script/mod.rs"]
mod script;

use raconteur_eml::{EstimatedDurations, Limits, Timeline, parse_with};
use script::script;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The system's allocator with a tally.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static CALLS: AtomicUsize = AtomicUsize::new(0);

fn count(more: usize, less: usize) {
    let held = HELD.fetch_add(more, Relaxed) + more;
    HELD.fetch_sub(less, Relaxed);
    PEAK.fetch_max(held - less, Relaxed);
    CALLS.fetch_add(usize::from(more > 0), Relaxed);
}

#[expect(unsafe_code, reason = "an allocator cannot be written without")]
// SAFETY: every call is handed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 0);
        // SAFETY: as above.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        count(0, layout.size());
        // SAFETY: as above.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size, layout.size());
        // SAFETY: as above.
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Returns the result of `work`, with its retained bytes, peak bytes and number of allocations.
fn measured<T>(work: impl FnOnce() -> T) -> (T, [usize; 3]) {
    let (held, calls) = (HELD.load(Relaxed), CALLS.load(Relaxed));
    PEAK.store(held, Relaxed);
    let kept = work();
    let figures = [
        HELD.load(Relaxed).saturating_sub(held),
        PEAK.load(Relaxed).saturating_sub(held),
        CALLS.load(Relaxed) - calls,
    ];
    (kept, figures)
}

fn main() {
    let limits = Limits {
        bytes: 1 << 30,
        clauses: 2_000_000,
        ..Limits::default()
    };
    println!("bytes kept, bytes at the peak and allocations, a clause");
    println!("clauses  source        document             timeline");
    for clauses in [1_000, 10_000, 100_000, 1_000_000] {
        let source = script(clauses);
        let each = |n: usize| n as f64 / clauses as f64;
        let (parsed, document) = measured(|| parse_with(&source, &limits));
        let (resolved, timeline) =
            measured(|| Timeline::resolve(&parsed.document, &EstimatedDurations));
        assert_eq!(resolved.timeline.clauses.len(), clauses);
        println!(
            "{clauses:>7} {:>7.0} {:>6.0} {:>6.0} {:>5.2} {:>6.0} {:>6.0} {:>5.2}",
            each(source.len()),
            each(document[0]),
            each(document[1]),
            each(document[2]),
            each(timeline[0]),
            each(timeline[1]),
            each(timeline[2]),
        );
    }
}

//! Parsing, checking and resolving a thousand to a million clauses, compared with a bare
//! `quick-xml` event loop over the same bytes. The bound is a ratio of at most 8, and linear
//! growth; both are printed first.
//!
//! The reference is the minimum work of a program on `quick-xml`: a `Reader` with its default
//! configuration over the same `&str`, `read_event` until the end, every event dropped immediately.
//! It finds markup and compares the names of end tags; attributes are neither split nor decoded,
//! text is not decoded, nothing is stored. The measured side is `parse` (document and all
//! diagnostics) and `Timeline::resolve` (document to sorted, indexed timeline), both including
//! their allocations and deallocations.

#[path = "../../../crate/eml/tests/script/mod.rs"]
mod script;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use quick_xml::Reader;
use quick_xml::events::Event;
use raconteur_eml::{EstimatedDurations, Limits, Timeline, parse_with};
use script::script;
use std::hint::black_box;
use std::time::{Duration, Instant};

const SIZES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Roomy enough for the largest script here.
const LIMITS: Limits = Limits {
    bytes: 1 << 30,
    clauses: 2_000_000,
    timed_clauses: 2_000_000,
    depth: 64,
    attributes: 64,
    diagnostics: 200,
    clause_words: usize::MAX,
    words: usize::MAX,
};

fn bare(source: &str) -> usize {
    let mut reader = Reader::from_str(source);
    let mut events = 0;
    loop {
        match reader.read_event() {
            Ok(Event::Eof) | Err(_) => return events,
            Ok(event) => {
                black_box(&event);
                events += 1;
            }
        }
    }
}

/// The loop of a typical reader: attributes are looked at too.
fn with_attributes(source: &str) -> usize {
    let mut reader = Reader::from_str(source);
    let mut count = 0;
    loop {
        match reader.read_event() {
            Ok(Event::Eof) | Err(_) => return count,
            Ok(Event::Start(tag) | Event::Empty(tag)) => {
                count += tag
                    .attributes()
                    .map_while(Result::ok)
                    .map(black_box)
                    .count();
            }
            Ok(event) => {
                black_box(&event);
            }
        }
    }
}

fn parsed(source: &str) -> usize {
    parse_with(source, &LIMITS).document.clauses.len()
}

fn full(source: &str) -> usize {
    let parsed = parse_with(source, &LIMITS);
    Timeline::resolve(&parsed.document, &EstimatedDurations)
        .timeline
        .clauses
        .len()
}

/// Returns the shortest run of each kind of work, which excludes disturbances. The kinds take
/// turns, so that a busy machine affects all of them equally.
fn shortest<const N: usize>(source: &str, runs: usize, work: [Work; N]) -> [f64; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..runs {
        for (best, work) in best.iter_mut().zip(work) {
            let start = Instant::now();
            black_box(work(source));
            *best = start.elapsed().min(*best);
        }
    }
    best.map(|time| time.as_secs_f64())
}

/// Prints the ratios for scripts of all sizes, and the time a clause, which must not grow.
fn report() {
    println!("clauses      KiB  event loop  +attributes    parse  parse+check+resolve  ns/clause");
    for clauses in SIZES {
        let source = script(clauses);
        let runs = (3_000_000 / clauses).clamp(5, 60);
        let [bare, attributes, parse, full] =
            shortest(&source, runs, [bare, with_attributes, parsed, full]);
        println!(
            "{clauses:>7} {:>8} {:>8.2} ms {:>10.2} x {:>6.2} x {:>18.2} x {:>10.0}",
            source.len() >> 10,
            bare * 1e3,
            attributes / bare,
            parse / bare,
            full / bare,
            full * 1e9 / clauses as f64,
        );
    }
    println!("bound: 8 x");
}

type Work = fn(&str) -> usize;

fn benches(c: &mut Criterion) {
    let source = script(10_000);
    let parsed_once = parse_with(&source, &LIMITS);
    assert_eq!(
        (
            parsed_once.document.clauses.len(),
            parsed_once.diagnostics.len()
        ),
        (10_000, 0)
    );
    report();
    let mut group = c.benchmark_group("clauses");
    for clauses in SIZES {
        let source = script(clauses);
        group.throughput(Throughput::Elements(clauses as u64));
        group.sample_size(if clauses > 10_000 { 10 } else { 50 });
        let works: [(&str, Work); 3] = [
            ("event_loop", bare),
            ("parse", parsed),
            ("parse_check_resolve", full),
        ];
        for (name, work) in works {
            group.bench_with_input(BenchmarkId::new(name, clauses), &source, |b, source| {
                b.iter(|| work(source));
            });
        }
    }
    group.finish();
}

criterion_group!(all, benches);
criterion_main!(all);

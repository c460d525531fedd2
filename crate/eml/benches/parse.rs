//! Parsing and resolving ten thousand clauses, against a bare `quick-xml` event loop
//! over the same bytes. The budget is a ratio of at most 4; it is printed first.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use quick_xml::Reader;
use quick_xml::events::Event;
use raconteur_eml::{EstimatedDurations, Timeline, parse};
use std::fmt::Write as _;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A script as a person would write it: speech, gestures that hang on its words,
/// groups and events.
fn script(clauses: usize) -> String {
    let mut out = String::from("<eml name='bench'>\n <body>\n");
    for i in 0..clauses / 5 {
        let before = i * 4;
        let _ = write!(
            out,
            "  <voice-text time='{before}' timeId='v{i}'>
   <div type='sentence'>Once upon a time there was a <tm name='w{i}'/>small <emph>white</emph>
   rabbit, who went to the garden to fetch some cabbages for her soup.</div>
  </voice-text>
  <gesture-key time='w{i}-0.1s' duration='0.8' handedness='right'>
   <hand-shapes><key time='0' id='7'/></hand-shapes>
   <palms><key time='0' a='200' x='0.0' y='0.0' z='-1.0'/></palms>
   <motion coords='speaker'>
    <key time='0' x='-7.0' y='45.0' z='3.0'/>
    <key time='50%' x='-15.0' y='40.0' z='3.0'/>
   </motion>
  </gesture-key>
  <seq time='v{i}+1'>
   <event time='0.5' type='cue'>lights</event>
   <null time='1'/>
  </seq>
"
        );
    }
    out.push_str(" </body>\n</eml>\n");
    out
}

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

fn full(source: &str) -> usize {
    let parsed = parse(source);
    Timeline::resolve(&parsed.document, &EstimatedDurations)
        .timeline
        .clauses
        .len()
}

/// The shortest of several runs: what the work costs without what disturbs it.
fn shortest(mut work: impl FnMut() -> usize) -> Duration {
    let run = |_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed()
    };
    (0..60).map(run).min().unwrap_or_default()
}

/// Prints the ratios for a script of so many clauses. The small one shows what the work
/// costs while it fits into the caches, both together that it is linear.
fn report(clauses: usize) {
    let source = script(clauses);
    let loop_time = shortest(|| bare(&source));
    let ratio = |time: Duration| time.as_secs_f64() / loop_time.as_secs_f64();
    println!(
        "{clauses} clauses, {} KiB: event loop {loop_time:.1?}, with attributes {:.2} x, parse \
         {:.2} x, parse and resolve {:.2} x (budget 4 x)",
        source.len() >> 10,
        ratio(shortest(|| with_attributes(&source))),
        ratio(shortest(|| parse(&source).document.clauses.len())),
        ratio(shortest(|| full(&source))),
    );
}

fn benches(c: &mut Criterion) {
    let source = script(10_000);
    let parsed = parse(&source);
    assert_eq!(
        (parsed.document.clauses.len(), parsed.diagnostics.len()),
        (10_000, 0)
    );
    report(500);
    report(10_000);
    let mut group = c.benchmark_group("ten_thousand_clauses");
    group.throughput(Throughput::Bytes(source.len() as u64));
    group.bench_function("event_loop", |b| b.iter(|| bare(&source)));
    group.bench_function("event_loop_with_attributes", |b| {
        b.iter(|| with_attributes(&source));
    });
    group.bench_function("parse", |b| b.iter(|| parse(&source)));
    group.bench_function("parse_and_resolve", |b| b.iter(|| full(&source)));
    group.finish();
}

criterion_group!(all, benches);
criterion_main!(all);

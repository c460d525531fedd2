//! Meaning of times, with speech of known words and phones (GEVH D.2, D.4.3).

use proptest::prelude::*;
use raconteur_eml::{
    ClauseId, ClauseKind, Diagnostic, Durations, EstimatedDurations, Limits, MAX_PER_KIND,
    PhoneTime, Resolved, Timeline, VoiceText, VoiceTiming, WordTime, parse,
};

/// Speech timing with one second per word, the last 0.2 s silent; its two phones are `a` and `b`.
struct Metronome;

impl Durations for Metronome {
    fn voice(&self, _: ClauseId, text: &VoiceText) -> VoiceTiming {
        let count = text.words().len();
        let words = (0..count).map(|i| WordTime {
            start_secs: i as f64,
            end_secs: i as f64 + 0.8,
        });
        let phones = (0..2 * count).map(|i| PhoneTime {
            symbol: ["a", "b"][i % 2].to_owned(),
            start_secs: 0.5 * i as f64,
            end_secs: 0.5 * i as f64 + 0.3,
            word: i / 2,
        });
        VoiceTiming {
            duration_secs: count as f64,
            words: words.collect(),
            phones: phones.collect(),
            estimated: false,
        }
    }
}

fn resolve(body: &str) -> Resolved {
    let parsed = parse(&format!("<eml><body>{body}</body></eml>"));
    assert_eq!(parsed.diagnostics, [], "{body}");
    Timeline::resolve(&parsed.document, &Metronome)
}

fn mark(resolved: &Resolved, name: &str) -> f64 {
    *resolved.timeline.marks.get(name).expect(name)
}

fn told(diagnostics: &[Diagnostic]) -> Vec<(&str, &str)> {
    diagnostics
        .iter()
        .map(|d| (d.code, d.message.as_str()))
        .collect()
}

#[test]
fn marks_are_the_start_the_end_and_a_phone_of_the_next_word() {
    let resolved = resolve(
        "<voice-text time='10'>one <tm name='start'/>two <tm name='end' event='onEnd'/>three \
         <tm name='phone' event='onPhone' phone='b'/>four<tm name='after'/></voice-text>\
         <event time='phone+0.25'/>",
    );
    assert_eq!(resolved.diagnostics, []);
    assert_eq!(mark(&resolved, "start"), 11.0);
    assert_eq!(mark(&resolved, "end"), 12.8);
    assert_eq!(mark(&resolved, "phone"), 13.5);
    assert_eq!(mark(&resolved, "after"), 14.0);
    assert_eq!(resolved.timeline.clauses[1].start_secs, 13.75);
}

#[test]
fn a_phone_that_the_word_lacks_is_told_and_its_start_is_used() {
    let resolved = resolve(
        "<voice-text time='0'>one <tm name='m' event='onPhone' phone='zh'/>two</voice-text>",
    );
    assert_eq!(mark(&resolved, "m"), 1.0);
    let message = "the next word has no phone `zh`; its start is used";
    assert_eq!(
        told(&resolved.diagnostics),
        [("eml::phone-not-in-word", message)]
    );
}

#[test]
fn names_are_usable_before_they_are_given() {
    let resolved = resolve(
        "<event time='later+1' timeId='first'/><seq time='0'><null time='word-0.5' timeId='n'/>\
         </seq><voice-text time='last'>one <tm name='word'/>two</voice-text>\
         <null time='7' timeId='last'/><null time='n' timeId='later'/>",
    );
    assert_eq!(resolved.diagnostics, []);
    assert_eq!(mark(&resolved, "word"), 8.0);
    assert_eq!(mark(&resolved, "later"), 7.5);
    assert_eq!(mark(&resolved, "first"), 8.5);
}

#[test]
fn what_starts_before_0_delays_the_whole_script() {
    let resolved = resolve(
        "<gesture-key time='v-1.5' duration='1' timeId='g'/><voice-text time='0' \
         timeId='v'>one <tm name='w'/>two</voice-text><event time='3'/>",
    );
    let timeline = &resolved.timeline;
    assert_eq!((timeline.lead_in_secs, timeline.duration_secs), (1.5, 4.5));
    let starts: Vec<f64> = timeline.clauses.iter().map(|c| c.start_secs).collect();
    assert_eq!(starts, [0.0, 1.5, 4.5]);
    assert_eq!([mark(&resolved, "g"), mark(&resolved, "w")], [0.0, 2.5]);
}

#[test]
fn cycles_and_names_that_nothing_has_print_the_whole_chain() {
    let resolved = resolve(
        "<null time='b+1' timeId='a'/><null time='c' timeId='b'/><null time='a' timeId='c'/>",
    );
    let cycle = "these times depend on each other: `a` -> `b` -> `c` -> `a`";
    assert_eq!(told(&resolved.diagnostics), [("eml::time-cycle", cycle)]);

    let resolved = resolve(
        "<null time='b' timeId='a'/><par time='c' timeId='x'><null time='1' timeId='b'/></par>\
         <null time='nowhere' timeId='c'/>",
    );
    assert_eq!(
        told(&resolved.diagnostics),
        [
            (
                "eml::no-time",
                "this `null` is left out because its time depends on an undefined time: \
                 `b` -> `c` -> `nowhere`"
            ),
            (
                "eml::no-time",
                "this `par` is left out because its time depends on an undefined time: \
                 `c` -> `nowhere`"
            ),
            (
                "eml::unknown-name",
                "`nowhere` is not defined; this `null` is left out"
            ),
        ]
    );
    assert!(resolved.timeline.clauses.is_empty(), "no clause has a time");
}

#[test]
fn nested_repetitions_beyond_the_limit_play_once_and_cost_nothing() {
    let depth = 60;
    let billions = "<seq time='0' repetitionCount='1000000000'>".repeat(depth);
    let resolved = resolve(&format!(
        "{billions}<event time='1'/>{}<par time='0' duration='1' repetitionCount='4000000000'/>",
        "</seq>".repeat(depth)
    ));
    // Each clause occurs once: nothing was expanded, neither in the list nor before.
    assert_eq!(resolved.timeline.clauses.len(), depth + 2);
    let codes: Vec<&str> = resolved.diagnostics.iter().map(|d| d.code).collect();
    let (last, told) = codes.split_last().expect("diagnostics");
    assert_eq!(told, vec!["eml::too-many-repetitions"; MAX_PER_KIND]);
    assert_eq!(*last, "eml::more");
    let count = format!("and {} more ", depth - MAX_PER_KIND);
    let counted = resolved
        .diagnostics
        .last()
        .map(|d| d.message.starts_with(&count));
    assert_eq!(counted, Some(true));
}

#[test]
fn the_limit_of_repetitions_can_be_set() {
    let body = "<par time='0' repetitionCount='10'><null time='1'/></par>";
    let parsed = parse(&format!("<eml><body>{body}</body></eml>"));
    let count = |timed_clauses| {
        let limits = Limits {
            timed_clauses,
            ..Limits::default()
        };
        let resolved = Timeline::resolve_with(&parsed.document, &EstimatedDurations, &limits);
        (resolved.timeline.clauses.len(), resolved.diagnostics.len())
    };
    assert_eq!(count(11), (11, 0));
    assert_eq!(count(10), (2, 1));
}

/// A clause of written or spoken length, without a name.
#[derive(Clone, Debug)]
struct Leaf {
    wait: f64,
    spoken: Option<usize>,
    length: f64,
}

impl Leaf {
    fn eml(&self) -> String {
        let wait = self.wait;
        match self.spoken {
            Some(words) => format!(
                "<voice-text time='{wait}'>{}</voice-text>",
                "word ".repeat(words)
            ),
            None => format!("<gesture-key time='{wait}' duration='{}'/>", self.length),
        }
    }
}

fn leaves() -> impl Strategy<Value = Vec<Leaf>> {
    let leaf = (0.0..9.0_f64, prop::option::of(1_usize..5), 0.0..9.0_f64);
    let leaf = leaf.prop_map(|(wait, spoken, length)| Leaf {
        wait,
        spoken,
        length,
    });
    prop::collection::vec(leaf, 1..6)
}

/// Start and end of every leaf in document order.
fn leaf_times(body: &str) -> Vec<(f64, f64)> {
    let parsed = parse(&format!("<eml><body>{body}</body></eml>"));
    assert_eq!(parsed.diagnostics, [], "{body}");
    let resolved = Timeline::resolve(&parsed.document, &Metronome);
    assert_eq!(resolved.diagnostics, [], "{body}");
    let mut times: Vec<_> = resolved
        .timeline
        .clauses
        .iter()
        .filter(|c| {
            !matches!(
                parsed.document.clause(c.clause).kind,
                ClauseKind::Seq(_) | ClauseKind::Par(_)
            )
        })
        .map(|c| (c.clause, (c.start_secs, c.end_secs)))
        .collect();
    times.sort_by_key(|(clause, _)| *clause);
    times.into_iter().map(|(_, times)| times).collect()
}

proptest! {
    /// Checks that consecutive or simultaneous parts may be grouped in any way: groups start after
    /// the part before them, or with the whole, without delay.
    #[test]
    fn seq_and_par_are_associative(
        a in leaves(),
        b in leaves(),
        c in leaves(),
        start in 0.0..50.0_f64,
        group in prop::sample::select(vec!["seq", "par"]),
    ) {
        let [a, b, c] = [a, b, c].map(|part| part.iter().map(Leaf::eml).collect::<String>());
        let outer = |inner: &str| format!("<{group} time='{start}'>{inner}</{group}>");
        let inner = |parts: &str| format!("<{group} time='0'>{parts}</{group}>");
        let flat = leaf_times(&outer(&format!("{a}{b}{c}")));
        let left = leaf_times(&outer(&format!("{}{c}", inner(&format!("{a}{b}")))));
        let right = leaf_times(&outer(&format!("{a}{}", inner(&format!("{b}{c}")))));
        for bracketed in [left, right] {
            prop_assert_eq!(flat.len(), bracketed.len());
            for (flat, bracketed) in flat.iter().zip(bracketed) {
                prop_assert!((flat.0 - bracketed.0).abs() < 1e-9);
                prop_assert!((flat.1 - bracketed.1).abs() < 1e-9);
            }
        }
    }
}

//! Robustness for any input: no panic, no hang, bounded memory, and consistent times.

#[path = "holds/edits.rs"]
mod edits;
mod holds;

use edits::{apply, edit};
use proptest::prelude::*;
use raconteur_eml::{
    Diagnostic, EstimatedDurations, Limits, MAX_PER_KIND, Severity, Timeline, parse, parse_bytes,
    schema,
};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// The sources of the suite, as a base for mutations.
static SUITE: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/suite/eml");
    let mut cases: Vec<_> = fs::read_dir(folder)
        .expect("the folder of the suite")
        .map(|entry| entry.expect("an entry of the suite").path())
        .filter(|path| path.extension().is_some_and(|e| e == "eml"))
        .collect();
    cases.sort();
    cases
        .iter()
        .map(|path| fs::read(path).expect("a case"))
        .collect()
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn mutated_scripts_never_panic(
        case in any::<prop::sample::Index>(),
        edits in prop::collection::vec(edit(), 1..12),
    ) {
        let mut source = case.get(&SUITE).clone();
        edits.iter().for_each(|edit| apply(&mut source, edit));
        holds::document(&source);
    }

    #[test]
    fn arbitrary_text_never_panics(text in "\\PC*") {
        holds::document(text.as_bytes());
    }

    /// Checks that moving every clause of the body by the same time moves the whole timeline: by
    /// that time where nothing starts early, and never backwards.
    #[test]
    fn a_later_script_plays_the_same_but_later(
        clauses in prop::collection::vec((0_u8..6, 0.0..20.0_f64, 0_usize..8), 1..20),
        shift in 0.0..50.0_f64,
    ) {
        let script = |shift: f64| {
            let body: String = clauses
                .iter()
                .enumerate()
                .map(|(i, &(kind, time, other))| {
                    // Only backward references, so that there are no cycles.
                    let time = match i.checked_sub(other + 1) {
                        Some(earlier) if other < 4 => format!("n{earlier}+{time}"),
                        _ => format!("{}", time + shift),
                    };
                    let head = format!("time='{time}' timeId='n{i}'");
                    match kind {
                        0 => format!("<voice-text {head}>a word or two</voice-text>"),
                        1 => format!("<gesture-key {head} duration='1.5'/>"),
                        2 => format!("<seq {head} repetitionCount='2'><null time='1'/></seq>"),
                        3 => format!("<par {head} duration='2'><null time='1'/></par>"),
                        4 => format!("<event {head}/>"),
                        _ => format!("<null {head}/>"),
                    }
                })
                .collect();
            let parsed = parse(&format!("<eml><body>{body}</body></eml>"));
            prop_assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
            let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
            prop_assert!(resolved.diagnostics.is_empty(), "{:?}", resolved.diagnostics);
            Ok(resolved.timeline)
        };
        let (now, later) = (script(0.0)?, script(shift)?);
        prop_assert_eq!(now.clauses.len(), later.clauses.len());
        for (name, secs) in now.marks.iter() {
            prop_assert!((later.marks.get(name).expect("the same names") - secs - shift).abs() < 1e-9);
        }
        prop_assert!((later.duration_secs - now.duration_secs - shift).abs() < 1e-9);
    }
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<&'static str> {
    diagnostics.iter().map(|d| d.code).collect()
}

#[test]
fn ten_megabytes_are_read() {
    let clause = "  <gesture-key time='1.5' duration='0.4'><motion><key x='1' y='2' z='3'/></motion></gesture-key>\n";
    let count = 10_000_000 / clause.len();
    let source = format!("<eml>\n <body>\n{}</body>\n</eml>\n", clause.repeat(count));
    let parsed = parse(&source);
    assert!(
        parsed.diagnostics.is_empty(),
        "the large file has no diagnostics"
    );
    assert_eq!(parsed.document.clauses.len(), count);
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    assert_eq!(resolved.timeline.clauses.len(), count);
}

#[test]
fn what_exceeds_a_limit_is_refused_with_one_diagnostic() {
    let limits = Limits {
        bytes: 1000,
        clauses: 3,
        ..Limits::default()
    };
    let body = |inner: &str| format!("<eml><body>{inner}</body></eml>");
    let parsed = parse_bytes(body(&" ".repeat(1000)).as_bytes(), &limits);
    assert_eq!(codes(&parsed.diagnostics), ["eml::too-large"]);
    let parsed = parse_bytes(body(&"<null time='1'/>".repeat(9)).as_bytes(), &limits);
    assert_eq!(codes(&parsed.diagnostics), ["eml::too-many-clauses"]);
    assert_eq!(parsed.document.clauses.len(), 3);
}

#[test]
fn ten_thousand_deep_nesting_is_one_diagnostic() {
    let source = format!(
        "<eml><body>{}<null time='1'/>{}<null time='2'/></body></eml>",
        "<seq time='0'>".repeat(10_000),
        "</seq>".repeat(10_000)
    );
    let parsed = parse(&source);
    assert_eq!(codes(&parsed.diagnostics), ["eml::too-deep"]);
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    assert_eq!(resolved.timeline.duration_secs, 2.0);
    holds::document(
        format!(
            "<eml><body>{}",
            "<voice-text time='0'><emph>".repeat(10_000)
        )
        .as_bytes(),
    );
}

#[test]
fn diagnostics_are_capped() {
    let source = format!("<eml><body>{}</body></eml>", "<oops/>".repeat(1000));
    let parsed = parse(&source);
    assert_eq!(parsed.diagnostics.len(), MAX_PER_KIND + 1);
    let last = parsed.diagnostics.last().expect("a last diagnostic");
    assert_eq!(
        (last.code, last.message.as_str()),
        ("eml::more", "and 980 more of the kind eml::unknown-element")
    );
}

#[test]
fn long_chains_of_names_resolve_without_recursion() {
    let n = 100_000;
    let clauses: String = (0..n)
        .map(|i| format!("<null time='n{}+1' timeId='n{i}'/>", i + 1))
        .collect();
    let source = format!("<eml><body>{clauses}<null time='0' timeId='n{n}'/></body></eml>");
    let parsed = parse(&source);
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    assert_eq!(resolved.diagnostics, []);
    assert_eq!(resolved.timeline.duration_secs, f64::from(n));
}

/// An extension's name without its prefix, with a slip, or as a word of a longer name.
#[test]
fn extensions_are_suggested_under_near_names() {
    for element in schema::ELEMENTS
        .iter()
        .filter(|e| e.extension && e.is_clause())
    {
        let name = element.name;
        // The remainder of a short name is not a misspelling of it.
        let slip = (name.len() > 4).then(|| format!("{}{}", &name[..2], &name[3..]));
        let whole = [name.to_owned(), format!("expression-{name}")];
        for written in whole.into_iter().chain(slip) {
            let parsed = parse(&format!("<eml><body><{written} time='1'/></body></eml>"));
            let unknown = parsed
                .diagnostics
                .iter()
                .find(|d| matches!(d.code, "eml::unknown-element" | "eml::wrong-parent"));
            let hints = unknown.map(|d| d.hints.join(" ")).unwrap_or_default();
            let meant = format!("r:{name}");
            assert!(
                hints.contains(&meant) && hints.contains("xmlns:r="),
                "{written}: {hints}"
            );
        }
    }
    let script = "<eml xmlns:r='urn:raconteur:eml:1'><body><r:null time='1'/></body></eml>";
    let hints = &parse(script).diagnostics[0].hints;
    assert!(hints[0].contains("without the prefix"), "{hints:?}");
}

/// Returns a number of attributes with distinct names.
fn distinct(name: &str, n: usize) -> String {
    (0..n).map(|i| format!("{name}{i}='1' ")).collect()
}

#[test]
fn attributes_beyond_the_limit_are_one_diagnostic() {
    for n in [65, 1000, 100_000] {
        let parsed = parse(&format!(
            "<eml><body><null {}/></body></eml>",
            distinct("a", n)
        ));
        let about_all = codes(&parsed.diagnostics);
        let told = about_all
            .iter()
            .filter(|c| **c == "eml::too-many-attributes");
        assert_eq!(told.count(), 1);
        assert!(about_all.len() <= MAX_PER_KIND + 3, "{about_all:?}");
    }
}

/// Checks inputs whose naive treatment takes quadratic time or memory; at these sizes that would be
/// minutes.
#[test]
fn hostile_shapes_stay_linear() {
    let n = 100_000;
    let knot: String = (0..n).map(|_| "<null time='last'/>").collect();
    let shapes = [
        "<a '".repeat(n),
        "<a b=\"<".repeat(n),
        "<a ".repeat(n) + ">",
        "</a>".repeat(n),
        "<".repeat(n),
        "<!--".repeat(n),
        "<![CDATA[".repeat(n),
        "&".repeat(n),
        "<eml><body>".to_owned() + &"<body/>".repeat(n),
        "<eml><body><voice-text>".to_owned() + &"<tm name='a'/>".repeat(n),
        "<eml><body><voice-text>".to_owned() + &"&#65;".repeat(n),
        format!(
            "<eml><body><seq time='0'><par time='0'>{knot}</par>{}<null time='0' timeId='last'/>\
             </seq></body></eml>",
            "<null time='0'/>".repeat(n)
        ),
        format!("<eml><body><null time='{}'/></body></eml>", "+1".repeat(n)),
        format!("<eml><body><null {}/></body></eml>", "a='1' ".repeat(n)),
        format!("<eml><body><null {}/></body></eml>", distinct("a", n)),
        format!("<eml><body><null {}/></body></eml>", distinct("xmlns:a", n)),
        format!("<eml {}><body/></eml>", distinct("r:a", n)),
    ];
    for shape in shapes {
        let parsed = parse(&shape);
        let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
        let all = parsed.diagnostics.iter().chain(&resolved.diagnostics);
        assert!(
            all.clone().count() <= 402,
            "the number of diagnostics is bounded"
        );
        assert!(
            all.clone().any(|d| d.severity == Severity::Error) || shape.contains("+1"),
            "a hostile shape is reported as an error"
        );
    }
}

//! Invariants of any input, shared by the tests and the fuzz targets.
#![allow(dead_code, reason = "each program that includes this uses some of it")]

use raconteur_eml::{
    Diagnostic, EstimatedDurations, Limits, LineIndex, Parsed, Timeline, parse, parse_bytes,
    parse_fragment,
};

/// A script.
pub(crate) fn document(source: &[u8]) {
    let parsed = parse_bytes(source, &Limits::default());
    assert_invariants(source, &parsed);
}

/// Checks a fragment sent by a mind.
pub(crate) fn fragment(source: &[u8]) {
    if let Ok(text) = std::str::from_utf8(source) {
        assert_invariants(source, &parse_fragment(text));
    }
}

/// Checks a time expression: an attribute value, so without its terminators.
pub(crate) fn time(source: &[u8]) {
    let Ok(text) = std::str::from_utf8(source) else {
        return;
    };
    let text = text.replace(['\'', '<'], "");
    let script = format!(
        "<eml><body><null time='1' timeId='a'/><par time='{text}' timeId='t' duration='{text}'>\
         <voice-text time='{text}'>one <tm name='b'/>two</voice-text></par><seq time='a'>\
         <gesture-key time='{text}' duration='2'><hand-shapes><key time='{text}' id='1'/>\
         </hand-shapes></gesture-key></seq></body></eml>"
    );
    assert_invariants(script.as_bytes(), &parse(&script));
}

/// Resolves a parsed document and checks the invariants for any input.
fn assert_invariants(source: &[u8], parsed: &Parsed) {
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    let text = String::from_utf8_lossy(source);
    let lines = LineIndex::new(&text);
    for Diagnostic { span, related, .. } in parsed.diagnostics.iter().chain(&resolved.diagnostics) {
        for span in related.iter().map(|(span, _)| span).chain([span]) {
            assert!(
                span.start <= span.end && span.end as usize <= text.len() + 1,
                "{span:?}"
            );
            assert!(
                lines.position(span.start).line >= 1,
                "the line number is at least 1"
            );
        }
    }
    let timeline = &resolved.timeline;
    assert!(
        timeline.clauses.is_sorted_by_key(|c| c.start_secs),
        "the clauses are sorted by start time"
    );
    assert!(timeline.lead_in_secs >= 0.0, "the lead-in is not negative");
    for clause in &timeline.clauses {
        assert!(
            clause.start_secs >= 0.0 && clause.end_secs >= clause.start_secs,
            "the clause ends after its start"
        );
        assert!(
            clause.end_secs <= timeline.duration_secs && clause.end_secs.is_finite(),
            "the clause ends within the timeline"
        );
        if let Some(container) = clause.container {
            let group = parsed
                .document
                .clause(timeline.clauses[container as usize].clause);
            assert!(
                group
                    .kind
                    .group()
                    .is_some_and(|g| g.children.contains(&clause.clause)),
                "the group contains the clause"
            );
        }
    }
    for t in [0.0, 0.5, 1.0, timeline.duration_secs] {
        let active: Vec<usize> = timeline.active_at(t).map(|(i, _)| i).collect();
        let scanned: Vec<usize> = (0..timeline.clauses.len())
            .filter(|&i| timeline.clauses[i].start_secs <= t && timeline.clauses[i].end_secs > t)
            .collect();
        assert_eq!(active, scanned);
    }
}

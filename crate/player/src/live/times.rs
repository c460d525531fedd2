//! Times of a live fragment: plain numbers count from the current time, names refer to the running
//! story's clock.
//!
//! The timeline resolves one document alone. External times, those of the story and of earlier
//! fragments, are therefore written into the fragment's expressions first, as seconds from its own
//! start.

use raconteur_eml::{ClauseKind, Diagnostic, Document, Name, NameTerm};

use crate::lower::anchor::{ANCHOR, add_anchor};

/// Replaces the names that a fragment does not define itself by their times. `base_secs` is the
/// story time of the fragment's start, `outside` the story time of a name. If a sum of outside
/// markers has passed, the clause starts immediately, with a warning.
pub(super) fn bind(
    document: &mut Document,
    base_secs: f64,
    outside: impl Fn(&str) -> Option<f64>,
) -> Vec<Diagnostic> {
    let mut own: Vec<Name> = Vec::new();
    for (_, clause) in document.iter() {
        own.extend(clause.time_id.clone());
        if let ClauseKind::VoiceText(voice) = &clause.kind {
            own.extend(voice.marks().into_iter().map(|m| m.name));
        }
    }
    let mut warnings = Vec::new();
    let mut anchored = false;
    for clause in &mut document.clauses {
        let expr = &mut clause.start;
        if !expr.is_absolute() {
            continue;
        }
        // The timeline counts a fragment's own names from the fragment's start; the difference
        // between their sum and a time of the story is a number of bases.
        let (mut own_names, mut foreign_secs, mut any_foreign) = (0.0, 0.0, false);
        expr.names.retain(|term| {
            let sign = if term.negative { -1.0 } else { 1.0 };
            if !own.contains(&term.name)
                && let Some(at) = outside(&term.name)
            {
                foreign_secs += sign * at;
                any_foreign = true;
                return false;
            }
            own_names += sign;
            true
        });
        expr.offset_secs += foreign_secs + (own_names - 1.0) * base_secs;
        if !expr.names.is_empty() || !any_foreign {
            continue;
        }
        if expr.offset_secs < 0.0 {
            let late = -expr.offset_secs;
            let message =
                format!("this time passed {late:.1} s ago; the clause starts immediately");
            warnings.push(Diagnostic::warning("live::late", expr.span, message));
            expr.offset_secs = 0.0;
        }
        if clause.parent.is_some() {
            // Without a name it would count from its group.
            anchored = true;
            expr.names.push(NameTerm {
                name: ANCHOR.into(),
                negative: false,
                span: expr.span,
            });
        }
    }
    if anchored {
        add_anchor(document);
    }
    warnings
}

/// Returns the number of clauses with all repetitions played, up to `most`.
pub(super) fn played_out(document: &Document, most: u64) -> u64 {
    let mut counts = vec![1_u64; document.clauses.len()];
    // Children come after their group, so in reverse order they are ready before it.
    for (i, clause) in document.clauses.iter().enumerate().rev() {
        if let Some(group) = clause.kind.group() {
            let inside: u64 = group.children.iter().map(|c| counts[c.index()]).sum();
            counts[i] = (1 + inside.saturating_mul(u64::from(group.repetition_count))).min(most);
        }
    }
    let all: u64 = document.roots.iter().map(|r| counts[r.index()]).sum();
    all.min(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::anchor::is_anchor;
    use raconteur_eml::{EstimatedDurations, Timeline, parse_fragment};

    /// Starts of a fragment's clauses in document order, story time, and the warnings' codes.
    fn starts(fragment: &str, base: f64) -> (Vec<f64>, Vec<&'static str>) {
        let mut parsed = parse_fragment(fragment);
        assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
        let outside = |name: &str| match name {
            "t1" => Some(10.0),
            "t2" => Some(14.0),
            _ => None,
        };
        let warnings = bind(&mut parsed.document, base, outside);
        let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
        assert!(
            resolved.diagnostics.is_empty(),
            "{:?}",
            resolved.diagnostics
        );
        let mut clauses: Vec<_> = resolved
            .timeline
            .clauses
            .iter()
            .filter(|c| !is_anchor(parsed.document.clause(c.clause)))
            .collect();
        clauses.sort_by_key(|c| c.clause);
        (
            clauses.iter().map(|c| base + c.start_secs).collect(),
            warnings.iter().map(|w| w.code).collect(),
        )
    }

    #[test]
    fn numbers_count_from_now_and_names_from_the_story() {
        assert_eq!(starts("<null time='1'/>", 12.0), (vec![13.0], vec![]));
        assert_eq!(starts("<null time='t2+1'/>", 12.0), (vec![15.0], vec![]));
        assert_eq!(
            starts("<null time='1' timeId='a'/><null time='a+0.5'/>", 12.0).0,
            [13.0, 13.5]
        );
        // 2 s after a named time, but not before the story has reached t2: sums mix.
        let mixed = "<null time='1' timeId='a'/><null time='a+t2-t1'/>";
        assert_eq!(starts(mixed, 12.0).0, [13.0, 17.0]);
    }

    #[test]
    fn names_inside_a_group_do_not_count_from_it() {
        let (at, _) = starts(
            "<seq time='3'><null time='1'/><null time='t2'/></seq>",
            12.0,
        );
        assert_eq!(at, [15.0, 16.0, 14.0]);
    }

    #[test]
    fn what_has_passed_is_done_at_once() {
        let (at, codes) = starts("<null time='t1+0.5'/>", 12.0);
        assert_eq!((at, codes), (vec![12.0], vec!["live::late"]));
    }

    #[test]
    fn a_fragments_own_name_hides_the_storys() {
        assert_eq!(
            starts("<null time='1' timeId='t1'/><null time='t1+1'/>", 12.0).0,
            [13.0, 14.0]
        );
    }

    #[test]
    fn repetitions_are_counted_without_being_played() {
        let nested = "<seq time='0' repetitionCount='1000000'><seq time='0' \
                      repetitionCount='1000000'><null time='0'/></seq></seq>";
        assert_eq!(played_out(&parse_fragment(nested).document, 5000), 5000);
        let twice = "<seq time='0' repetitionCount='2'><null time='0'/><null time='0'/></seq>";
        assert_eq!(played_out(&parse_fragment(twice).document, 5000), 5);
    }
}

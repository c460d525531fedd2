//! Branches of a story: unreachable parts and endless loops.
//!
//! The timeline is cut at gotos, where branches leave it, and at parts, where they enter it.
//! Between two cuts, the story continues linearly.

use super::Timeline;
use crate::diagnostic::Sink;
use crate::suggest::quoted;
use crate::{ClauseId, ClauseKind, Diagnostic, Document};
use std::collections::BTreeMap;

/// An interval of the timeline between two cuts.
#[derive(Default)]
struct Interval {
    /// First effective clause that starts in it.
    first: Option<ClauseId>,
    /// True if a question in it is asked on every path through it.
    waits: bool,
    /// Goto that ends it, and the interval to which it leads.
    goto: Option<(ClauseId, Option<usize>)>,
    /// True if every path through it takes the goto.
    always: bool,
}

impl Interval {
    /// Returns the possible next intervals; one past the last is the end.
    fn next(&self, here: usize) -> impl Iterator<Item = usize> + use<> {
        let to = self.goto.and_then(|(_, to)| to);
        let on = (!self.always || to.is_none()).then_some(here + 1);
        on.into_iter().chain(to)
    }
}

/// Reports unreachable clauses, and gotos in endless loops.
pub(super) fn check(document: &Document, timeline: &Timeline, sink: &mut Sink) {
    let is_goto =
        |c: &super::TimedClause| matches!(document.clause(c.clause).kind, ClauseKind::Goto(_));
    if !timeline.clauses.iter().any(is_goto) {
        return;
    }
    let stretches = stretches(document, timeline);
    let reached = spread(stretches.len(), &[0], |at| {
        stretches
            .get(at)
            .into_iter()
            .flat_map(move |s| s.next(at))
            .collect()
    });
    for stretch in stretches
        .iter()
        .enumerate()
        .filter(|(at, _)| !reached[*at])
        .map(|(_, s)| s)
    {
        if let Some(id) = stretch.first {
            let clause = document.clause(id);
            let message = format!(
                "no path reaches this `{}`; it is never performed",
                clause.kind.name()
            );
            sink.push(Diagnostic::warning(
                "eml::unreachable",
                clause.tag_span,
                message,
            ));
        }
    }
    for id in endless(&stretches, &reached) {
        let clause = document.clause(id);
        let ClauseKind::Goto(goto) = &clause.kind else {
            continue;
        };
        let message = format!(
            "the path to {} is a loop without a question, or never ends",
            quoted(&goto.to)
        );
        sink.push(
            Diagnostic::error("eml::endless-ring", clause.tag_span, message)
                .hint("add a question to the path, or a condition around the goto"),
        );
    }
}

fn stretches(document: &Document, timeline: &Timeline) -> Vec<Interval> {
    let mut all = vec![Interval::default()];
    let mut parts: BTreeMap<&str, usize> = BTreeMap::new();
    // Whether the content of a clause can be skipped. Containers precede their content.
    let mut optional = vec![false; timeline.clauses.len()];
    for (at, timed) in timeline.clauses.iter().enumerate() {
        let within = timed.container.is_some_and(|c| optional[c as usize]);
        // If a pool is not drawn completely, its selected questions are unknown.
        let is_drawn = timed.container.is_some_and(|c| {
            let around = document.clause(timeline.clauses[c as usize].clause);
            matches!(around.kind, ClauseKind::Pool(_))
        });
        let kind = &document.clause(timed.clause).kind;
        optional[at] =
            within || is_drawn || matches!(kind, ClauseKind::If(_) | ClauseKind::Answer(_));
        if let ClauseKind::Part(part) = kind {
            all.push(Interval::default());
            parts.entry(&part.heading.name).or_insert(all.len() - 1);
        }
        let last = all.len() - 1;
        let stretch = &mut all[last];
        stretch.waits |= !within && matches!(kind, ClauseKind::Ask(_));
        if !matches!(kind, ClauseKind::Null) {
            stretch.first.get_or_insert(timed.clause);
        }
        if let ClauseKind::Goto(_) = kind {
            stretch.goto = Some((timed.clause, None));
            stretch.always = !within;
            all.push(Interval::default());
        }
    }
    for stretch in &mut all {
        if let Some((id, to)) = &mut stretch.goto
            && let ClauseKind::Goto(goto) = &document.clause(*id).kind
        {
            *to = parts.get(goto.to.as_str()).copied();
        }
    }
    all
}

/// Returns the reachable intervals, including the end after them.
fn spread(count: usize, from: &[usize], next: impl Fn(usize) -> Vec<usize>) -> Vec<bool> {
    let mut reached = vec![false; count + 1];
    let mut open = from.to_vec();
    while let Some(at) = open.pop() {
        if !std::mem::replace(&mut reached[at], true) {
            open.extend(next(at));
        }
    }
    reached
}

/// Returns the gotos of loops without a question, and of paths from which the end is unreachable.
fn endless(stretches: &[Interval], reached: &[bool]) -> Vec<ClauseId> {
    let mut before = vec![Vec::new(); stretches.len() + 1];
    for (at, stretch) in stretches.iter().enumerate() {
        for to in stretch.next(at) {
            before[to].push(at);
        }
    }
    let ends = spread(stretches.len(), &[stretches.len()], |at| before[at].clone());
    let round = rings(stretches, reached);
    let leads_round = |(at, stretch): (usize, &Interval)| {
        let (id, to) = stretch.goto?;
        let back = to.is_some_and(|to| to <= at);
        (reached[at] && back && (round[at] || !ends[at])).then_some(id)
    };
    stretches
        .iter()
        .enumerate()
        .filter_map(leads_round)
        .collect()
}

/// Returns the intervals whose goto closes a loop of intervals without waiting: depth first, with
/// an explicit stack.
fn rings(stretches: &[Interval], reached: &[bool]) -> Vec<bool> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut closes = vec![false; stretches.len()];
    let mut state = vec![State::New; stretches.len()];
    let goes = |at: usize| at < stretches.len() && reached[at] && !stretches[at].waits;
    for root in 0..stretches.len() {
        if state[root] != State::New || !goes(root) {
            continue;
        }
        state[root] = State::Open;
        let mut path = vec![(root, stretches[root].next(root))];
        while let Some((at, next)) = path.last_mut() {
            let at = *at;
            match next.next() {
                None => {
                    state[at] = State::Done;
                    path.pop();
                }
                Some(to) if goes(to) && state[to] == State::New => {
                    state[to] = State::Open;
                    path.push((to, stretches[to].next(to)));
                }
                Some(to) if goes(to) && state[to] == State::Open => closes[at] = true,
                Some(_) => {}
            }
        }
    }
    closes
}

#[cfg(test)]
mod tests {
    use crate::{EstimatedDurations, Timeline, parse};

    fn codes(body: &str) -> Vec<&'static str> {
        let text = format!(
            "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'>{body}</seq></body></eml>"
        );
        let parsed = parse(&text);
        assert_eq!(parsed.diagnostics, []);
        let told = Timeline::resolve(&parsed.document, &EstimatedDurations).diagnostics;
        told.iter().map(|d| d.code).collect()
    }

    fn part(name: &str, inside: &str) -> String {
        format!("<r:part time='0' name='{name}' title='T'><seq time='0'>{inside}</seq></r:part>")
    }

    const ASK: &str = "<r:ask time='0' name='q' prompt='?'><r:option name='a' text='A' right='true'/>\
        <r:answer to='wrong'><r:goto time='0' to='one'/></r:answer></r:ask>";
    const SET: &str = "<r:set time='0' name='x' by='1'/>";

    fn goto(to: &str) -> String {
        format!("<r:goto time='0' to='{to}'/>")
    }

    fn maybe(inside: &str) -> String {
        format!("{SET}<r:if time='0' name='x' below='3'>{inside}</r:if>")
    }

    #[test]
    fn what_is_leapt_over_and_led_to_by_nothing_is_told() {
        let event = "<event time='1' type='x'/>";
        let leap = format!("{}{event}{}", goto("end"), part("end", event));
        assert_eq!(codes(&leap), ["eml::unreachable"]);
        let both = format!(
            "{}{}{}{}",
            maybe(&goto("b")),
            part("a", &goto("end")),
            part("b", event),
            part("end", event)
        );
        assert_eq!(codes(&both), [""; 0]);
        let lost = format!(
            "{}{}{}",
            goto("end"),
            part("lost", event),
            part("end", event)
        );
        assert_eq!(codes(&lost), ["eml::unreachable"]);
    }

    #[test]
    fn rings_have_questions_and_ends() {
        assert_eq!(codes(&part("one", &goto("one"))), ["eml::endless-ring"]);
        // A condition is no wait.
        assert_eq!(
            codes(&part("one", &maybe(&goto("one")))),
            ["eml::endless-ring"]
        );
        assert_eq!(codes(&part("one", ASK)), [""; 0]);
        // A question that is repeated endlessly.
        let asked = ASK.replace("<r:goto time='0' to='one'/>", "<null time='1'/>");
        assert_eq!(
            codes(&part("one", &format!("{asked}{}", goto("one")))),
            ["eml::endless-ring"]
        );
        // A question that may be passed over.
        let passed = format!("{}{}", maybe(&asked), maybe(&goto("one")));
        assert_eq!(codes(&part("one", &passed)), ["eml::endless-ring"]);
    }

    #[test]
    fn rings_of_several_gotos_are_found() {
        let body = format!(
            "{}{}{}",
            part("a", &goto("c")),
            part("b", &goto("a")),
            part("c", &maybe(&goto("b")))
        );
        assert_eq!(codes(&body), ["eml::endless-ring"]);
    }

    #[test]
    fn ten_thousand_of_them_are_gone_through() {
        let part = |i: usize| {
            let to = (i * 7919 + 13) % 10_000;
            part(&format!("p{i}"), &maybe(&goto(&format!("p{to}"))))
        };
        let body: String = (0..10_000).map(part).collect();
        assert!(
            codes(&body).iter().all(|code| matches!(
                *code,
                "eml::endless-ring" | "eml::unreachable" | "eml::more"
            )),
            "only unreachable and endless clauses are reported"
        );
    }
}

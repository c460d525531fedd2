//! Branches of a story at their times.

use raconteur_eml::{ClauseKind, TimedClause};

use crate::lower::script::Script;

/// Entry of a story's flow, such as a part, condition or jump, with its times; the page decides
/// which are performed.
#[derive(Clone, Debug, PartialEq)]
pub struct WayCue {
    /// Position among all entries of the story, which orders simultaneous ones.
    pub order: u32,
    /// Position of the enclosing answer, condition or pool item.
    pub within: Option<u32>,
    /// Start of the entry, story time, seconds.
    pub at_secs: f64,
    /// End, seconds; equal to the start for entries of zero duration.
    pub end_secs: f64,
    /// Kind of the entry.
    pub kind: WayKind,
}

/// Kind of a flow entry, with its data.
#[derive(Clone, Debug, PartialEq)]
pub enum WayKind {
    /// A part of the story.
    Part {
        /// Name used by gotos.
        name: String,
        /// Displayed text.
        title: String,
    },
    /// A section that is skipped unless all of these conditions hold.
    If {
        /// A variable, a question, or `score`.
        name: String,
        /// Value that must be equal.
        is: Option<String>,
        /// Value that must not be equal.
        not: Option<String>,
        /// Lower bound: the value must be greater.
        above: Option<f64>,
        /// Upper bound: the value must be smaller.
        below: Option<f64>,
    },
    /// Assignment of a variable.
    Set {
        /// The variable.
        name: String,
        /// Value to assign.
        value: Option<String>,
        /// Increment of its number.
        by: Option<f64>,
    },
    /// Pool from which some of the contained items are performed.
    Pool {
        /// Number to draw.
        count: u32,
    },
    /// A clause of a pool, listed before the clause itself, at the same position.
    Item {
        /// Position of the pool.
        pool: u32,
    },
    /// A jump to another part of the story.
    Goto {
        /// Name of the destination part.
        to: String,
    },
}

impl Script {
    /// Returns the entries on all paths through the story, in the order of traversal.
    #[must_use]
    pub fn flow_entries(&self) -> Vec<WayCue> {
        let timed = (0_u32..).zip(&self.timeline.clauses);
        timed
            .flat_map(|(order, at)| {
                let itself = self.flow_entry_kind(at).map(|kind| WayCue {
                    order,
                    within: self.optional_around(order, at),
                    at_secs: at.start_secs,
                    end_secs: at.end_secs,
                    kind,
                });
                self.item(order, at).into_iter().chain(itself)
            })
            .collect()
    }

    fn flow_entry_kind(&self, at: &TimedClause) -> Option<WayKind> {
        Some(match &self.document.clause(at.clause).kind {
            ClauseKind::Part(part) => WayKind::Part {
                name: part.heading.name.clone(),
                title: part.heading.title.clone(),
            },
            ClauseKind::If(branch) => {
                let condition = &branch.condition;
                WayKind::If {
                    name: condition.name.clone(),
                    is: condition.is.clone(),
                    not: condition.not.clone(),
                    above: condition.above,
                    below: condition.below,
                }
            }
            ClauseKind::Set(set) => WayKind::Set {
                name: set.name.clone(),
                value: set.value.clone(),
                by: set.by,
            },
            ClauseKind::Goto(goto) => WayKind::Goto {
                to: goto.to.clone(),
            },
            ClauseKind::Pool(pool) => WayKind::Pool {
                count: pool.draw.count,
            },
            _ => return None,
        })
    }

    /// Returns the pool item of a clause directly in a pool.
    fn item(&self, order: u32, at: &TimedClause) -> Option<WayCue> {
        let pool = at.container?;
        let around = self.timeline.clauses.get(pool as usize)?;
        self.is_pool(around).then(|| WayCue {
            order,
            within: self.optional_around(pool, around),
            at_secs: at.start_secs,
            end_secs: at.end_secs,
            kind: WayKind::Item { pool },
        })
    }

    fn is_pool(&self, timed: &TimedClause) -> bool {
        matches!(self.document.clause(timed.clause).kind, ClauseKind::Pool(_))
    }

    /// Returns the position of the innermost answer, condition or pool item that contains or is a
    /// clause at a position: its content may be skipped.
    pub(super) fn optional_around(&self, order: u32, timed: &TimedClause) -> Option<u32> {
        let mut inner = order;
        let mut container = timed.container;
        while let Some(at) = container {
            let around = self.timeline.clauses.get(at as usize)?;
            if self.is_pool(around) {
                return Some(inner);
            }
            let kind = &self.document.clause(around.clause).kind;
            if matches!(kind, ClauseKind::Answer(_) | ClauseKind::If(_)) {
                return Some(at);
            }
            inner = at;
            container = around.container;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_lie_where_their_clauses_do() {
        let text = "<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><r:set time='0' name='x' value='2'/>\
            <r:if time='1' name='x' above='1'><r:goto time='2' to='end'/></r:if>\
            <r:part time='0' name='end' title='The end'><null time='4'/></r:part></seq></body></eml>";
        let script = Script::read(text, None);
        assert_eq!(script.diagnostics, []);
        let ways = script.flow_entries();
        let spans: Vec<_> = ways
            .iter()
            .map(|w| (w.order, w.at_secs, w.end_secs))
            .collect();
        assert_eq!(
            spans,
            [(1, 0.0, 0.0), (2, 1.0, 3.0), (3, 3.0, 3.0), (4, 3.0, 7.0)]
        );
        let within: Vec<_> = ways.iter().map(|w| w.within).collect();
        assert_eq!(within, [None, None, Some(2), None]);
        assert_eq!(ways[2].kind, WayKind::Goto { to: "end".into() });
    }

    #[test]
    fn items_of_a_pool_are_what_all_in_them_stands_in() {
        let ask = "<r:ask time='0.1' name='N' prompt='?'><r:option name='a' text='A' right='true'/></r:ask>";
        let text = format!(
            "<eml xmlns:r='urn:raconteur:eml:1'><body><r:pool time='1' count='2'>{}             <seq time='0.1'><null time='2'/>{}</seq><r:if time='0.1' name='one' is='right'><null time='1'/></r:if></r:pool></body></eml>",
            ask.replace('N', "one"),
            ask.replace('N', "two"),
        );
        let script = Script::read(&text, None);
        assert_eq!(script.diagnostics, []);
        let ways: Vec<_> = script
            .flow_entries()
            .into_iter()
            .map(|w| {
                (
                    w.order,
                    w.within,
                    matches!(w.kind, WayKind::Item { pool: 0 }),
                )
            })
            .collect();
        assert_eq!(
            ways,
            [
                (0, None, false),
                (1, None, true),
                (2, None, true),
                (5, None, true),
                (5, Some(5), false)
            ]
        );
        let questions: Vec<_> = script
            .questions()
            .into_iter()
            .map(|q| (q.order, q.within))
            .collect();
        assert_eq!(questions, [(1, Some(1)), (4, Some(2))]);
    }
}

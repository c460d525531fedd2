//! Ways through a story, at their times.

use raconteur_eml::{ClauseKind, TimedClause};

use crate::lower::script::Script;

/// Something on the way through a story.
#[derive(Clone, Debug, PartialEq)]
pub struct WayCue {
    /// Its place among all that the story comes to, for what lies at one time.
    pub order: u32,
    /// The place of the answer or condition around it.
    pub within: Option<u32>,
    /// Where it begins, seconds.
    pub at_secs: f64,
    /// Where it ends, seconds; of what takes no time, where it begins.
    pub end_secs: f64,
    /// What it is.
    pub kind: WayKind,
}

/// What is on the way.
#[derive(Clone, Debug, PartialEq)]
pub enum WayKind {
    /// A part of the story.
    Part {
        /// Gotos lead to it by it.
        name: String,
        /// What is read.
        title: String,
    },
    /// What is passed over unless all of these hold.
    If {
        /// A variable, a question, or `score`.
        name: String,
        /// It is this.
        is: Option<String>,
        /// It is not this.
        not: Option<String>,
        /// It is greater.
        above: Option<f64>,
        /// It is smaller.
        below: Option<f64>,
    },
    /// A variable takes a value.
    Set {
        /// The variable.
        name: String,
        /// Its value.
        value: Option<String>,
        /// What is added to its number.
        by: Option<f64>,
    },
    /// The story goes on at a part.
    Goto {
        /// Its name.
        to: String,
    },
}

impl Script {
    /// What is on the ways through the story, in the order in which it is come to.
    #[must_use]
    pub fn ways(&self) -> Vec<WayCue> {
        let timed = (0_u32..).zip(&self.timeline.clauses);
        let cue = |(order, at): (u32, &TimedClause)| {
            let kind = match &self.document.clause(at.clause).kind {
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
                _ => return None,
            };
            Some(WayCue {
                order,
                within: self.optional_around(at),
                at_secs: at.start_secs,
                end_secs: at.end_secs,
                kind,
            })
        };
        timed.filter_map(cue).collect()
    }

    /// The place of the innermost answer or condition around a clause: what is in it may be passed
    /// over.
    pub(super) fn optional_around(&self, timed: &TimedClause) -> Option<u32> {
        let mut container = timed.container;
        while let Some(at) = container {
            let around = self.timeline.clauses.get(at as usize)?;
            let kind = &self.document.clause(around.clause).kind;
            if matches!(kind, ClauseKind::Answer(_) | ClauseKind::If(_)) {
                return Some(at);
            }
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
        let ways = script.ways();
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
}

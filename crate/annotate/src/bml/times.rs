//! Resolution of sync points to sums of named times and seconds.

use std::collections::{BTreeMap, BTreeSet};

use raconteur_eml::{Diagnostic, Name, Span, TimeExpr};

use super::behaviour::{Given, GivenTime, Kind, Order, Point, Reading};
use super::loss;
use crate::script::{after, seconds};

/// Deviation of two times that does not matter, seconds.
const TOLERANCE_SECS: f64 = 1e-6;

/// Time as seconds after a base.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct When {
    pub(super) base: Base,
    pub(super) secs: f64,
}

/// Origin of a [`When`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Base {
    /// Start of a group of blocks.
    Group(usize),
    /// Named time in a speech.
    Mark(Name),
}

impl When {
    /// Returns the seconds from an earlier time to this one; `None` if they have other bases.
    pub(super) fn secs_since(&self, earlier: &Self) -> Option<f64> {
        (self.base == earlier.base).then_some(self.secs - earlier.secs)
    }

    /// Returns the time some seconds later.
    pub(super) fn plus(&self, secs: f64) -> Self {
        Self {
            base: self.base.clone(),
            secs: self.secs + secs,
        }
    }

    /// Returns the time expression in a clause of a group.
    pub(super) fn expression(&self, group: usize) -> TimeExpr {
        match &self.base {
            Base::Group(base) if *base == group => seconds(self.secs),
            Base::Group(base) => after(group_name(*base), self.secs),
            Base::Mark(name) => after(name.clone(), self.secs),
        }
    }
}

/// Returns the named time of the start of a group.
pub(super) fn group_name(group: usize) -> Name {
    format!("block{group}").into()
}

/// Point of a behaviour.
type Node = (usize, Point);

/// Times of the sync points of all behaviours, except the marks of speeches.
pub(super) type Times = BTreeMap<Node, When>;

/// Points of every behaviour in their order.
const POINTS: [Point; 7] = [
    Point::Start,
    Point::Ready,
    Point::StrokeStart,
    Point::Stroke,
    Point::StrokeEnd,
    Point::Relax,
    Point::End,
];

/// Resolves all sync points. Reports cycles, times out of order, and orders that do not hold.
pub(super) fn resolve(reading: &Reading<'_>, problems: &mut Vec<Diagnostic>) -> Times {
    let mut solver = Solver {
        reading,
        times: Times::new(),
        dropped: BTreeSet::new(),
        problems,
    };
    for index in 0..reading.behaviours.len() {
        for point in POINTS {
            solver.solve((index, point));
        }
        solver.check_sequence(index);
    }
    for order in &reading.orders {
        solver.check_order(order);
    }
    solver.times
}

struct Solver<'r, 'x, 'p> {
    reading: &'r Reading<'x>,
    times: Times,
    /// Given times that are part of a cycle.
    dropped: BTreeSet<Node>,
    problems: &'p mut Vec<Diagnostic>,
}

impl Solver<'_, '_, '_> {
    /// Resolves a point and everything on which it depends, depth first, with its own stack.
    fn solve(&mut self, root: Node) {
        let mut stack = vec![root];
        let mut open = BTreeSet::from([root]);
        while let Some(&node) = stack.last() {
            if self.times.contains_key(&node) {
                stack.pop();
                open.remove(&node);
                continue;
            }
            let missing = self.dependencies(node).into_iter().flatten();
            let missing = missing
                .into_iter()
                .find(|needed| !self.times.contains_key(needed));
            match missing {
                None => {
                    let when = self.evaluate(node);
                    self.times.insert(node, when);
                }
                Some(needed) if open.contains(&needed) => {
                    // What depends on the time that is left out is not needed here any more.
                    let dropped = self.break_cycle(&stack, needed);
                    while stack.last().is_some_and(|node| *node != dropped) {
                        if let Some(node) = stack.pop() {
                            open.remove(&node);
                        }
                    }
                }
                Some(needed) => {
                    stack.push(needed);
                    open.insert(needed);
                }
            }
        }
    }

    fn given(&self, node: Node) -> Option<&Given> {
        let given = self.reading.behaviours[node.0].given.get(&node.1)?;
        (!self.dropped.contains(&node)).then_some(given)
    }

    fn is_speech(&self, index: usize) -> bool {
        self.reading.behaviours[index].kind == Kind::Speech
    }

    /// Returns the given points of a behaviour next before and next after a point.
    fn neighbours(&self, (index, point): Node) -> [Option<Node>; 2] {
        let node = |at: Point| Some((index, at)).filter(|node| self.given(*node).is_some());
        let before = POINTS.into_iter().rev().filter(|at| *at < point);
        let behind = POINTS.into_iter().filter(|at| *at > point);
        [
            before.into_iter().find_map(node),
            behind.into_iter().find_map(node),
        ]
    }

    /// Returns the points on which a point depends.
    fn dependencies(&self, node: Node) -> [Option<Node>; 2] {
        let (index, point) = node;
        if let Some(given) = self.given(node) {
            return match given.value {
                GivenTime::Group(..) => [None, None],
                GivenTime::Point(other, at, _) => [Some((other, at)), None],
            };
        }
        if self.is_speech(index) {
            // Its marks follow from its start.
            let start = (index, Point::Start);
            return [(point != Point::Start).then_some(start), None];
        }
        self.neighbours(node)
    }

    /// Returns the time of a point whose dependencies are resolved.
    fn evaluate(&self, node: Node) -> When {
        let (index, point) = node;
        let behaviour = &self.reading.behaviours[index];
        let group = self.reading.group_of(index);
        let block_start = When {
            base: Base::Group(group),
            secs: 0.0,
        };
        if let Some((start, end)) = &behaviour.ends
            && point != Point::Start
        {
            let name = match point {
                Point::Mark(mark) => behaviour.marks.get(mark).map(|mark| &mark.name),
                Point::End => Some(end),
                _ => None,
            };
            return When {
                base: Base::Mark(name.unwrap_or(start).clone()),
                secs: 0.0,
            };
        }
        if let Some(given) = self.given(node) {
            return match given.value {
                GivenTime::Group(group, secs) => When {
                    base: Base::Group(group),
                    secs,
                },
                GivenTime::Point(other, at, secs) => self.reference(other, at).plus(secs),
            };
        }
        let course = behaviour.course;
        let [before, behind] = self
            .neighbours(node)
            .map(|node| node.and_then(|node| Some((node.1, self.times.get(&node)?))));
        let after_of = |(at, when): (Point, &When)| when.plus(course.secs(point) - course.secs(at));
        let when = match (before, behind) {
            (Some(before), Some(behind)) => self
                .between(index, point, before, behind)
                .unwrap_or_else(|| {
                    // On different words, the stroke decides, then the start.
                    let is_stroke = behind.0 <= Point::StrokeEnd;
                    after_of(if is_stroke { behind } else { before })
                }),
            (Some(only), None) | (None, Some(only)) => after_of(only),
            (None, None) => block_start.plus(course.secs(point)),
        };
        // A gesture at the start of a block begins there, with less preparation.
        match when.base {
            Base::Group(_) if when.secs < 0.0 && before.is_none() => When { secs: 0.0, ..when },
            _ => when,
        }
    }

    /// Returns the time to which a reference to a point refers.
    fn reference(&self, index: usize, point: Point) -> When {
        let behaviour = &self.reading.behaviours[index];
        if let (Some((start, _)), Point::Start) = (&behaviour.ends, point) {
            return When {
                base: Base::Mark(start.clone()),
                secs: 0.0,
            };
        }
        self.times.get(&(index, point)).cloned().unwrap_or(When {
            base: Base::Group(self.reading.group_of(index)),
            secs: 0.0,
        })
    }

    /// Returns a point between two given ones on one base: a longer time goes to the hold, if it is
    /// in between, else all phases are scaled.
    fn between(
        &self,
        index: usize,
        point: Point,
        (before_at, before): (Point, &When),
        (behind_at, behind): (Point, &When),
    ) -> Option<When> {
        let length = behind.secs_since(before)?.max(0.0);
        let course = self.reading.behaviours[index].course;
        let (first, last) = (course.secs(before_at), course.secs(behind_at));
        let usual = last - first;
        let has_hold = before_at <= Point::StrokeEnd && behind_at >= Point::Relax;
        Some(if length > usual && has_hold {
            if point <= Point::StrokeEnd {
                before.plus(course.secs(point) - first)
            } else {
                behind.plus(course.secs(point) - last)
            }
        } else if usual > 0.0 {
            before.plus(length * (course.secs(point) - first) / usual)
        } else {
            before.clone()
        })
    }

    /// Drops a given time of the cycle that closes at a node of the stack, and reports it. Returns
    /// its point.
    fn break_cycle(&mut self, stack: &[Node], closing: Node) -> Node {
        let from = stack.iter().position(|node| *node == closing).unwrap_or(0);
        let cycle = stack.iter().skip(from);
        let referring: Vec<(Node, Span)> = cycle
            .filter_map(|node| {
                let given = self.given(*node)?;
                matches!(given.value, GivenTime::Point(..)).then_some((*node, given.span))
            })
            .collect();
        let Some(&(last, span)) = referring.last() else {
            // A cycle without a reference does not exist; the first point would be its own start.
            self.times.insert(
                closing,
                When {
                    base: Base::Group(self.reading.group_of(closing.0)),
                    secs: 0.0,
                },
            );
            return closing;
        };
        self.dropped.insert(last);
        let message = "these times depend on each other; this one is left out";
        let mut problem = Diagnostic::error("bml::cycle", span, message);
        for (_, other) in referring.iter().rev().skip(1).take(3) {
            problem = problem.related(*other, "depends on it as well");
        }
        if referring.len() == 1 {
            let tag = self.reading.behaviours[last.0].element.tag;
            problem = problem.related(tag, "the behaviour");
        }
        self.problems.push(problem);
        last
    }

    /// Reports given points of a behaviour that are not in the order of its phases.
    fn check_sequence(&mut self, index: usize) {
        let mut last: Option<(Span, &When)> = None;
        let mut found = None;
        for point in POINTS {
            let Some(given) = self.given((index, point)) else {
                continue;
            };
            let Some(when) = self.times.get(&(index, point)) else {
                continue;
            };
            if let Some((span, earlier)) = last
                && when
                    .secs_since(earlier)
                    .is_some_and(|secs| secs < -TOLERANCE_SECS)
            {
                found = Some((given.span, span));
            }
            last = Some((given.span, when));
        }
        if let Some((span, earlier)) = found {
            let message = "the sync point is before an earlier one of the same behaviour";
            let problem = Diagnostic::error("bml::order", span, message);
            self.problems
                .push(problem.related(earlier, "the earlier one"));
        }
    }

    /// Reports two times in the wrong order, or on different words.
    fn check_order(&mut self, order: &Order) {
        let when = |time: GivenTime| match time {
            GivenTime::Group(group, secs) => When {
                base: Base::Group(group),
                secs,
            },
            GivenTime::Point(index, point @ Point::Mark(_), secs) => {
                self.evaluate((index, point)).plus(secs)
            }
            GivenTime::Point(index, point, secs) => self.reference(index, point).plus(secs),
        };
        let (first, second) = (when(order.first), when(order.second));
        let message = match second.secs_since(&first) {
            Some(secs) if secs < -TOLERANCE_SECS => "the constraint does not hold",
            Some(_) => return,
            None => "only the speech tells whether this constraint holds; it is not enforced",
        };
        let problem = loss(order.is_required, "bml::constraint", order.span, message);
        self.problems.push(problem);
    }
}

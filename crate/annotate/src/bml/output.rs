//! Script under construction, with the times and the reports of behaviours.

use std::collections::BTreeSet;

use raconteur_eml::{ClauseKind, Diagnostic, Handedness, Place, Span, TimeExpr};

use super::behaviour::{Behaviour, Point, Reading};
use super::places::Places;
use super::times::{Times, When};
use crate::script::{Builder, permitted, seconds};
use crate::xml::Element;

/// Maximum number of clauses for behaviours. EML scripts have at most 200,000, and some more are
/// needed for groups, places and animation players.
const MAX_CLAUSES: usize = 150_000;

/// Script under construction.
pub(super) struct Output<'r> {
    pub(super) reading: &'r Reading<'r>,
    times: Times,
    pub(super) builder: Builder,
    places: Places<'r>,
    is_full: bool,
    /// Hands, start and end of the latest gestures.
    pub(super) gestures: Vec<(Handedness, When, When)>,
    /// Animation players added so far.
    pub(super) players: BTreeSet<String>,
}

impl<'r> Output<'r> {
    pub(super) fn new(reading: &'r Reading<'r>, times: Times) -> Self {
        Self {
            reading,
            times,
            builder: Builder::default(),
            places: Places::default(),
            is_full: false,
            gestures: Vec::new(),
            players: BTreeSet::new(),
        }
    }

    pub(super) fn behaviour(&self, index: usize) -> &'r Behaviour<'r> {
        &self.reading.behaviours[index]
    }

    /// Returns the time of a sync point.
    pub(super) fn when(&self, index: usize, point: Point) -> When {
        let start = || When {
            base: super::times::Base::Group(self.reading.group_of(index)),
            secs: 0.0,
        };
        self.times
            .get(&(index, point))
            .cloned()
            .unwrap_or_else(start)
    }

    /// Returns the time expression of a sync point.
    pub(super) fn time(&self, index: usize, point: Point) -> TimeExpr {
        self.when(index, point)
            .expression(self.reading.group_of(index))
    }

    /// Returns the seconds between two sync points, at least 0: the usual ones if they depend on
    /// different words.
    pub(super) fn length_secs(&self, index: usize, from: Point, to: Point) -> f64 {
        let known = self.when(index, to).secs_since(&self.when(index, from));
        let course = self.behaviour(index).course;
        let secs = known.unwrap_or_else(|| course.secs(to) - course.secs(from));
        crate::script::rounded(secs.max(0.0))
    }

    /// Reports a behaviour with a part whose start and end depend on different words: its length
    /// is then unknown, and it lasts as long as usual.
    pub(super) fn check_lengths(
        &mut self,
        index: usize,
        parts: impl IntoIterator<Item = (Point, Point)>,
    ) {
        let is_known = |(from, to): (Point, Point)| {
            let (from, to) = (self.when(index, from), self.when(index, to));
            to.secs_since(&from).is_some()
        };
        if !parts.into_iter().all(is_known) {
            let tag = self.behaviour(index).element.tag;
            let message = "start and end depend on different words; it lasts as long as usual";
            self.lost(index, "bml::end", tag, message);
        }
    }

    /// Adds a clause at a sync point. Beyond the limit of a script, nothing is added, and reported
    /// once.
    pub(super) fn push(&mut self, index: usize, point: Point, kind: ClauseKind) {
        if self.builder.document.clauses.len() >= MAX_CLAUSES {
            if !self.is_full {
                self.is_full = true;
                let message = format!("the script has more than {MAX_CLAUSES} clauses");
                let span = self.behaviour(index).element.tag;
                let problem = Diagnostic::error("bml::too-large", span, message);
                self.builder.problems.push(problem);
            }
            return;
        }
        let time = self.time(index, point);
        self.builder.push(time, kind);
    }

    /// Reports something that is not performed as written: an error in a required behaviour.
    pub(super) fn lost(
        &mut self,
        index: usize,
        code: &'static str,
        span: Span,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        let problem = super::loss(self.behaviour(index).is_required, code, span, message);
        let problems = &mut self.builder.problems;
        problems.push(problem);
        let last = problems.len() - 1;
        &mut problems[last]
    }

    /// Reports children of a behaviour other than the known ones.
    pub(super) fn check_children(&mut self, index: usize, element: &Element, known: &[&str]) {
        for child in &element.children {
            if !known
                .iter()
                .any(|name| child.name.eq_ignore_ascii_case(name))
            {
                let message = format!("{} is not performed", raconteur_eml::quoted(&child.name));
                self.lost(index, "bml::unknown-element", child.tag, message);
            }
        }
    }

    /// Returns the number of an attribute within a range, else a default.
    pub(super) fn number(
        &mut self,
        element: &Element,
        name: &str,
        (least, most): (f64, f64),
        default: f64,
    ) -> f64 {
        let problems = &mut self.builder.problems;
        let Some(number) = element.number(name, "bml::number", problems) else {
            return default;
        };
        if !(least..=most).contains(&number) {
            let span = element
                .attribute(name)
                .map_or(element.tag, |text| text.span);
            let message = format!("`{name}` is outside {least} to {most}; the nearest is used");
            problems.push(Diagnostic::warning("bml::number", span, message));
        }
        number.clamp(least, most)
    }

    /// Returns the place of the target of a behaviour, speaker coordinates in skeleton units. The
    /// place of a target that BML does not define is chosen, reported, and given to the referent of
    /// that name.
    pub(super) fn target(&mut self, index: usize, element: &Element) -> Option<[f64; 3]> {
        let Some(text) = element.attribute("target").filter(|t| !t.value.is_empty()) else {
            let message = format!("this {} has no target", element.name);
            self.lost(index, "bml::target", element.tag, message);
            return None;
        };
        let behaviours = &self.reading.behaviours;
        let name: &'r str = behaviours[index].element.value("target").unwrap_or("");
        let found = self.places.find(name);
        if found.is_new {
            let message = format!(
                "the place of {} is unknown; one was chosen",
                raconteur_eml::quoted(name)
            );
            let hint = format!(
                "change the place `r:place` in the script, or use a direction: {}",
                super::places::names()
            );
            let span = text.span;
            let problem = self.lost(index, "bml::target", span, message);
            problem.hints.push(hint);
            let [x, y, z] = found.position;
            let place = Place {
                name: permitted(name),
                x,
                y,
                z,
                words: None,
            };
            self.builder
                .push(seconds(0.0), ClauseKind::Place(Box::new(place)));
        }
        Some(found.position)
    }
}

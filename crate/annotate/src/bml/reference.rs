//! Times of sync points: seconds, references and constraints.

use std::collections::BTreeMap;

use raconteur_eml::{Diagnostic, Span, nearest, quoted};

use super::behaviour::{Given, GivenTime, Kind, Order, Point, Reading};
use super::loss;
use crate::xml::{Element, Text};

/// Maximum magnitude of times, seconds: EML's limit is higher, so that sums stay below it.
const MAX_SECS: f64 = 1e5;

/// Message and hint about a time that cannot be used.
struct Fault {
    message: String,
    hint: String,
}

fn fault(message: impl Into<String>, hint: impl Into<String>) -> Fault {
    Fault {
        message: message.into(),
        hint: hint.into(),
    }
}

/// Reads the times of all sync points.
pub(super) fn link(reading: &mut Reading<'_>, problems: &mut Vec<Diagnostic>) {
    let mut blocks = BTreeMap::new();
    for (index, block) in reading.blocks.iter().enumerate() {
        if let Some(id) = block.element.value("id") {
            blocks.entry(id).or_insert(index);
        }
    }
    let mut linker = Linker {
        reading,
        blocks,
        problems,
    };
    for index in 0..linker.reading.behaviours.len() {
        linker.attributes(index);
    }
    for (element, block, is_required) in linker.reading.constraints.clone() {
        linker.constraint(element, block, is_required);
    }
}

struct Linker<'r, 'x, 'p> {
    reading: &'r mut Reading<'x>,
    /// Blocks by id.
    blocks: BTreeMap<&'x str, usize>,
    problems: &'p mut Vec<Diagnostic>,
}

impl Linker<'_, '_, '_> {
    fn attributes(&mut self, index: usize) {
        let behaviour = &self.reading.behaviours[index];
        let (element, block, is_required) =
            (behaviour.element, behaviour.block, behaviour.is_required);
        for attribute in &element.attributes {
            if let Some(point) = Point::named(&attribute.name)
                && let Some(value) = self.time(&attribute.text, block)
            {
                let span = attribute.text.span;
                self.give(index, point, Given { value, span }, is_required);
            }
        }
    }

    fn constraint(&mut self, element: &Element, block: usize, is_required: bool) {
        for relation in &element.children {
            let name = relation.name.to_ascii_lowercase();
            if !matches!(name.as_str(), "synchronize" | "before" | "after") {
                let message = format!("{} is not a constraint", quoted(&relation.name));
                let hint = "constraints are `synchronize`, `before` and `after`";
                let problem = loss(is_required, "bml::unknown-element", relation.tag, message);
                self.problems.push(problem.hint(hint));
                continue;
            }
            let Some(reference) = self.required_reference(relation, block) else {
                continue;
            };
            for sync in relation.all("sync") {
                if let Some(time) = self.required_reference(sync, block) {
                    let order = Order {
                        first: time,
                        second: reference,
                        span: sync.tag,
                        is_required,
                    };
                    self.relate(&name, order);
                }
            }
        }
    }

    /// Returns the time of the attribute `ref`, which must be there.
    fn required_reference(&mut self, element: &Element, block: usize) -> Option<GivenTime> {
        match element.attribute("ref") {
            Some(text) => self.time(text, block),
            None => {
                let message = format!("{} has no `ref`", quoted(&element.name));
                self.error(element.tag, fault(message, ""));
                None
            }
        }
    }

    /// Applies one relation between the time of a `sync` and that of its constraint.
    fn relate(&mut self, relation: &str, mut order: Order) {
        let (reference, span, is_required) = (order.second, order.span, order.is_required);
        let GivenTime::Point(index, point, offset_secs) = order.first else {
            let message = "the start of a block cannot be moved";
            return self.error(span, fault(message, "refer to a sync point of a behaviour"));
        };
        let is_given = self.reading.behaviours[index].given.contains_key(&point);
        if relation != "synchronize" {
            if relation == "after" {
                std::mem::swap(&mut order.first, &mut order.second);
            }
            self.reading.orders.push(order);
            let is_speech = self.reading.behaviours[index].kind == Kind::Speech;
            if is_given || is_speech {
                return;
            }
        }
        let value = match reference {
            GivenTime::Group(group, secs) => GivenTime::Group(group, secs - offset_secs),
            GivenTime::Point(i, p, secs) => GivenTime::Point(i, p, secs - offset_secs),
        };
        self.give(index, point, Given { value, span }, is_required);
    }

    /// Gives a time to a point. The words of a speech have their own times, so another behaviour
    /// follows them instead.
    fn give(&mut self, index: usize, point: Point, given: Given, is_required: bool) {
        let behaviour = &mut self.reading.behaviours[index];
        if behaviour.kind == Kind::Speech && point != Point::Start {
            if let GivenTime::Point(other, other_point, secs) = given.value
                && self.reading.behaviours[other].kind != Kind::Speech
                && !self.reading.behaviours[other]
                    .given
                    .contains_key(&other_point)
                && matches!(point, Point::End | Point::Mark(_))
            {
                let value = GivenTime::Point(index, point, -secs);
                let span = given.span;
                let other = &mut self.reading.behaviours[other];
                other.given.insert(other_point, Given { value, span });
                return;
            }
            let message = "the words of a speech determine its times; only its start can be set";
            let problem = loss(is_required, "bml::speech-time", given.span, message);
            self.problems.push(problem);
            return;
        }
        if let Some(first) = behaviour.given.get(&point) {
            let message = "the sync point has a time already, which stays";
            let problem = loss(is_required, "bml::two-times", given.span, message);
            self.problems.push(problem.related(first.span, "the time"));
            return;
        }
        behaviour.given.insert(point, given);
    }

    fn error(&mut self, span: Span, fault: Fault) {
        let mut problem = Diagnostic::error("bml::time", span, fault.message);
        if !fault.hint.is_empty() {
            problem = problem.hint(fault.hint);
        }
        self.problems.push(problem);
    }

    /// Returns the time that a text names; `None` and a report if it names none.
    fn time(&mut self, text: &Text, block: usize) -> Option<GivenTime> {
        match self.parse(&text.value, block) {
            Ok(time) => Some(time),
            Err(fault) => {
                self.error(text.span, fault);
                None
            }
        }
    }

    /// Parses seconds, or a reference with an optional offset in seconds.
    fn parse(&self, text: &str, block: usize) -> Result<GivenTime, Fault> {
        let group = self.reading.blocks[block].group;
        if let Ok(secs) = text.parse::<f64>() {
            return if secs.abs() <= MAX_SECS {
                Ok(GivenTime::Group(group, secs))
            } else {
                let message = format!("times are at most {MAX_SECS} seconds");
                Err(fault(message, ""))
            };
        }
        let (target, offset_secs) = match self.lookup(text, block) {
            Ok(target) => (target, 0.0),
            Err(whole) => match split_offset(text) {
                Some((reference, secs)) => (self.lookup(reference, block)?, secs),
                None => return Err(whole),
            },
        };
        let own = group;
        let (group, time) = match target {
            GivenTime::Group(group, secs) => (group, GivenTime::Group(group, secs + offset_secs)),
            GivenTime::Point(index, point, secs) => (
                self.reading.group_of(index),
                GivenTime::Point(index, point, secs + offset_secs),
            ),
        };
        if group > own {
            let message = "a behaviour cannot wait for a block that starts after its own";
            return Err(fault(
                message,
                "remove the composition APPEND of that block",
            ));
        }
        Ok(time)
    }

    /// Returns the point that `id:point`, `block:id:point` or `bml:start` names.
    fn lookup(&self, text: &str, block: usize) -> Result<GivenTime, Fault> {
        let parts: Vec<&str> = text.splitn(4, ':').map(str::trim).collect();
        match parts[..] {
            ["bml", "start"] => Ok(GivenTime::Group(self.reading.blocks[block].group, 0.0)),
            [id, point] => match self.reading.ids.get(&(block, id)) {
                Some(&index) => self.point(index, point),
                None => self.block_start(id, point, block),
            },
            [other, id, point] => {
                let Some(&other) = self.blocks.get(other) else {
                    let message = format!("there is no block {}", quoted(other));
                    return Err(fault(message, self.near_id(id, block)));
                };
                match self.reading.ids.get(&(other, id)) {
                    Some(&index) => self.point(index, point),
                    None => {
                        let message = format!("the block has no behaviour {}", quoted(id));
                        Err(fault(message, self.near_id(id, other)))
                    }
                }
            }
            _ => Err(fault(
                format!("{} is not a time", quoted(text)),
                "times are seconds, such as 1.5, or sync points, such as `speech1:start + 0.5`",
            )),
        }
    }

    fn block_start(&self, id: &str, point: &str, block: usize) -> Result<GivenTime, Fault> {
        match (self.blocks.get(id), point) {
            (Some(&found), "start") => Ok(GivenTime::Group(self.reading.blocks[found].group, 0.0)),
            (Some(_), _) => Err(fault(
                "only the start of a block can be referred to",
                "a block with composition APPEND starts at the end of the one before",
            )),
            (None, _) => {
                let message = format!("there is no behaviour {}", quoted(id));
                Err(fault(message, self.near_id(id, block)))
            }
        }
    }

    fn near_id(&self, id: &str, block: usize) -> String {
        let range = (block, "")..(block + 1, "");
        let ids = self.reading.ids.range(range).map(|((_, id), _)| *id);
        nearest(id, ids).map_or_else(String::new, |near| {
            format!("did you mean {}?", quoted(near))
        })
    }

    fn point(&self, index: usize, name: &str) -> Result<GivenTime, Fault> {
        let behaviour = &self.reading.behaviours[index];
        let point = if behaviour.kind == Kind::Speech {
            let is_end = matches!(name, "start" | "end");
            let own = is_end.then(|| Point::named(name)).flatten();
            let mut marks = behaviour.marks.iter();
            own.or_else(|| {
                let mark = marks.position(|mark| mark.id == name)?;
                Some(Point::Mark(mark))
            })
        } else {
            Point::named(name)
        };
        if let Some(point) = point {
            return Ok(GivenTime::Point(index, point, 0.0));
        }
        let element = &behaviour.element.name;
        let message = format!("this {element} has no sync point {}", quoted(name));
        let hint = if behaviour.kind == Kind::Speech {
            "a speech has `start`, `end` and the ids of its syncs".to_owned()
        } else {
            let names: Vec<&str> = Point::names().collect();
            format!("sync points are {}", names.join(", "))
        };
        Err(fault(message, hint))
    }
}

/// Splits a reference from its offset in seconds, which begins with the last sign.
fn split_offset(text: &str) -> Option<(&str, f64)> {
    let at = text.rfind(['+', '-'])?;
    let (reference, offset) = text.split_at(at);
    let sign = if offset.starts_with('-') { -1.0 } else { 1.0 };
    let number = offset[1..].trim();
    let number = number.strip_suffix('s').unwrap_or(number).trim_end();
    let is_plain = number.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    let secs: f64 = number.parse().ok().filter(|_| is_plain)?;
    (secs <= MAX_SECS).then_some((reference.trim_end(), sign * secs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_offset_begins_with_the_last_sign() {
        assert_eq!(split_offset("s1:t1+0.5"), Some(("s1:t1", 0.5)), "plus");
        assert_eq!(
            split_offset("s-1:t1 - 2 s"),
            Some(("s-1:t1", -2.0)),
            "minus"
        );
        assert_eq!(split_offset("s-1:t1"), None, "a sign inside an id");
        assert_eq!(
            split_offset("s1:t1+-2"),
            Some(("s1:t1+", -2.0)),
            "two signs"
        );
        assert_eq!(split_offset("s1:t1+1e9"), None, "no plain number");
        assert_eq!(split_offset("é+"), None, "no number");
    }
}

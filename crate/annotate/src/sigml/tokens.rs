//! Tokens of HamNoSys 4 as elements of gestural SiGML.
//!
//! A notation is a flat list: symmetry, hand shape, orientation, location, motions. Brackets group
//! parts, and `hamplus` separates those of the dominant and the other hand.

use raconteur_eml::{Diagnostic, nearest, quoted};

use super::read_motion::is_motion;
use super::token_tables::{
    CONTACTS, FINGERS, IGNORED, LOCATIONS, MANNERS, MODIFIERS, REPETITIONS, SHAPES, SYMMETRIES,
    WRISTS,
};
use crate::xml::{Attribute, Element, Text};

/// Maximum nesting of brackets.
const MAX_DEPTH: usize = 8;
/// Separator of the hands in brackets, as an element.
const PLUS: &str = "hamplus";

/// Returns the `sign_manual` of the tokens of a `hamnosys_manual`.
pub(super) fn manual(tokens: &Element, problems: &mut Vec<Diagnostic>) -> Element {
    let mut parser = Parser {
        tokens: &tokens.children,
        position: 0,
        problems,
        manual: Vec::new(),
    };
    let children = parser.items(None, 0);
    let attributes = parser.manual;
    Element {
        name: "sign_manual".to_owned(),
        tag: tokens.tag,
        attributes,
        children,
        ..Element::default()
    }
}

struct Parser<'t, 'p> {
    tokens: &'t [Element],
    position: usize,
    problems: &'p mut Vec<Diagnostic>,
    /// Attributes of the whole.
    manual: Vec<Attribute>,
}

fn element(name: &str, token: &Element) -> Element {
    Element {
        name: name.to_owned(),
        tag: token.tag,
        ..Element::default()
    }
}

fn attribute(name: &str, value: &str, token: &Element) -> Attribute {
    let mut text = Text::from(value.to_owned());
    text.span = token.tag;
    Attribute {
        name: name.to_owned(),
        text,
    }
}

/// Returns an element with one attribute.
fn with(name: &str, (key, value): (&str, &str), token: &Element) -> Element {
    let mut element = element(name, token);
    element.attributes.push(attribute(key, value, token));
    element
}

impl<'t> Parser<'t, '_> {
    /// Reads items up to a closing token, or all. Groups are limited in depth.
    fn items(&mut self, end: Option<&str>, depth: usize) -> Vec<Element> {
        let mut items: Vec<Element> = Vec::new();
        while let Some(token) = self.tokens.get(self.position) {
            self.position += 1;
            let name = token.name.as_str();
            if Some(name) == end {
                return items;
            }
            match name {
                "hamparbegin" => self.group(token, ("hamparend", "par_motion"), depth, &mut items),
                "hamseqbegin" => self.group(token, ("hamseqend", "seq_motion"), depth, &mut items),
                "hamfusionbegin" => {
                    self.group(token, ("hamfusionend", "seq_motion"), depth, &mut items);
                }
                PLUS => items.push(element(PLUS, token)),
                "hamreplace" => {
                    let mut target = element("tgt_motion", token);
                    target.children.push(element("changeposture", token));
                    items.push(target);
                }
                _ => self.item(token, &mut items),
            }
        }
        items
    }

    /// Reads one token that is no bracket.
    fn item(&mut self, token: &'t Element, items: &mut Vec<Element>) {
        let name = token.name.as_str();
        let find = |table: &[(&'static str, &'static str)]| {
            let found = table.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| *value)
        };
        if let Some(value) = find(&SYMMETRIES) {
            for key in value.split(' ') {
                self.manual.push(attribute(key, "true", token));
            }
        } else if let Some(shape) = find(&SHAPES) {
            posture(items, with("handconfig", ("handshape", shape), token));
        } else if let Some(value) = find(&MODIFIERS) {
            let key = if value.starts_with(['o', 'a']) {
                "thumbpos"
            } else {
                "mainbend"
            };
            self.modify(items, (key, value), token);
        } else if let Some(digit) = find(&FINGERS) {
            self.modify(items, ("specialfingers", digit), token);
        } else if let Some(letters) = name.strip_prefix("hamextfinger") {
            self.direction(items, ("extfidir", letters), token);
        } else if let Some(letters) = name.strip_prefix("hampalm").filter(|l| !l.is_empty()) {
            self.direction(items, ("palmor", letters), token);
        } else if let Some(value) = find(&LOCATIONS) {
            self.location(items, value, token);
        } else if let Some(value) = find(&CONTACTS) {
            self.contact(items, value, token);
        } else if let Some(value) = find(&REPETITIONS) {
            repeat(items, value, token);
        } else if !self.motion(token, items) && !IGNORED.contains(&name) {
            self.unknown(token);
        }
    }

    fn unknown(&mut self, token: &Element) {
        let message = format!("the token {} has no effect", quoted(&token.name));
        let mut problem = Diagnostic::warning("sigml::unknown-token", token.tag, message);
        let tables: [&[(&str, &str)]; 5] = [&SHAPES, &MODIFIERS, &LOCATIONS, &CONTACTS, &WRISTS];
        let known = tables.into_iter().flatten().map(|(name, _)| *name);
        if let Some(near) = nearest(&token.name, known) {
            problem = problem.hint(format!("did you mean `{near}`?"));
        }
        self.problems.push(problem);
    }

    /// Reads a token of a motion or of its manner.
    fn motion(&mut self, token: &Element, items: &mut Vec<Element>) -> bool {
        let name = token.name.as_str();
        if let Some(letters) = name.strip_prefix("hammove") {
            items.push(with("directedmotion", ("direction", letters), token));
        } else if let Some(letters) = name.strip_prefix("hamcircle") {
            items.push(with("circularmotion", ("axis", letters), token));
        } else if let Some(wrist) = WRISTS.iter().find(|(known, _)| *known == name) {
            items.push(with("wristmotion", ("motion", wrist.1), token));
        } else if name == "hamfingerplay" {
            items.push(element("fingerplay", token));
        } else if name == "hamnomotion" {
            items.push(element("nomotion", token));
        } else if let Some(manner) = MANNERS.iter().find(|(known, ..)| *known == name) {
            let last = items.last_mut().filter(|last| is_motion(last));
            let Some(last) = last else {
                return false;
            };
            let value = attribute(manner.1, manner.2, token);
            last.attributes.push(value);
        } else {
            return false;
        }
        true
    }

    /// Reads a group in brackets and adds it.
    fn group(
        &mut self,
        token: &Element,
        (end, name): (&str, &str),
        depth: usize,
        items: &mut Vec<Element>,
    ) {
        if depth >= MAX_DEPTH {
            let message = format!("more than {MAX_DEPTH} brackets in each other");
            let problem = Diagnostic::error("sigml::too-large", token.tag, message);
            self.problems.push(problem);
            self.position = self.tokens.len();
            return;
        }
        let content = self.items(Some(end), depth + 1);
        let mut hands = content
            .split(|item| item.name == PLUS)
            .map(<[Element]>::to_vec);
        let dominant = hands.next().unwrap_or_default();
        let Some(other) = hands.next() else {
            let (motions, postures): (Vec<_>, Vec<_>) = dominant.into_iter().partition(is_motion);
            for item in postures {
                posture(items, item);
            }
            if !motions.is_empty() {
                let mut group = element(name, token);
                group.children = motions;
                items.push(group);
            }
            return;
        };
        for (split, part) in [
            ("split_handconfig", "handconfig"),
            ("split_location", "location_bodyarm"),
        ] {
            let sides = [&dominant, &other].map(|items| merged(items, part, token));
            if sides.iter().any(|side| !side.attributes.is_empty()) {
                let mut group = element(split, token);
                group.children = sides.into();
                posture(items, group);
            }
        }
        let motions = [dominant, other].map(|items| {
            let mut motions: Vec<Element> = items.into_iter().filter(is_motion).collect();
            if motions.len() == 1 {
                return motions.remove(0);
            }
            let mut group = element(if motions.is_empty() { "nomotion" } else { name }, token);
            group.children = motions;
            group
        });
        if motions.iter().any(|motion| motion.name != "nomotion") {
            let mut group = element("split_motion", token);
            group.children = motions.into();
            items.push(group);
        }
    }

    /// Adds an attribute to the last hand configuration.
    fn modify(&mut self, items: &mut [Element], (key, value): (&str, &str), token: &Element) {
        let last = last_posture(items).filter(|last| last.name == "handconfig");
        match last {
            Some(last) => {
                let known = last.attributes.iter_mut().find(|known| known.name == key);
                match known {
                    Some(known) => known.text.value.push_str(value),
                    None => last.attributes.push(attribute(key, value, token)),
                }
            }
            None => self.unknown(token),
        }
    }

    /// Adds a direction of the hand. One after `hambetween` is between the one before and itself.
    fn direction(&mut self, items: &mut Vec<Element>, value: (&str, &str), token: &Element) {
        let before = self.position.checked_sub(2);
        let before = before.and_then(|before| self.tokens.get(before));
        if before.is_some_and(|before| before.name == "hambetween") {
            self.modify(items, value, token);
        } else {
            posture(items, with("handconfig", value, token));
        }
    }

    /// Adds a location, with a side that was noted before it.
    fn location(&mut self, items: &mut Vec<Element>, value: &str, token: &Element) {
        let before = last_posture(items)
            .filter(|last| last.name == "location_bodyarm" && last.value("location").is_none());
        match before {
            Some(side) => side.attributes.push(attribute("location", value, token)),
            None => posture(items, with("location_bodyarm", ("location", value), token)),
        }
    }

    /// Adds a side or contact to the last location. A side before its location is the left one.
    fn contact(&mut self, items: &mut Vec<Element>, value: &str, token: &Element) {
        let is_side = matches!(value, "at" | "beside");
        let last = last_posture(items).filter(|last| last.name == "location_bodyarm");
        match (last, is_side) {
            (Some(last), true) => {
                let side = format!("right_{value}");
                last.attributes.push(attribute("side", &side, token));
            }
            (Some(last), false) => last.attributes.push(attribute("contact", value, token)),
            (None, true) => {
                let side = format!("left_{value}");
                posture(items, with("location_bodyarm", ("side", &side), token));
            }
            (None, false) => {
                let hands = with("handconstellation", ("contact", value), token);
                posture(items, hands);
            }
        }
    }
}

/// Adds a posture: to the last change of posture, if there is one.
fn posture(items: &mut Vec<Element>, item: Element) {
    match items.last_mut().filter(|last| last.name == "tgt_motion") {
        Some(target) => target.children.push(item),
        None => items.push(item),
    }
}

/// Returns the last posture, also within a change of posture.
fn last_posture(items: &mut [Element]) -> Option<&mut Element> {
    let last = items.last_mut()?;
    if last.name == "tgt_motion" {
        last.children.last_mut()
    } else {
        Some(last)
    }
}

/// Returns one element with the attributes of all elements of a name.
fn merged(items: &[Element], name: &str, token: &Element) -> Element {
    let mut all = element(name, token);
    for item in items.iter().filter(|item| item.name == name) {
        all.attributes.extend(item.attributes.iter().cloned());
    }
    all
}

/// Repeats all motions so far.
fn repeat(items: &mut Vec<Element>, repetition: &str, token: &Element) {
    let all = core::mem::take(items);
    let (motions, postures): (Vec<_>, Vec<_>) = all.into_iter().partition(is_motion);
    *items = postures;
    let mut group = with("rpt_motion", ("repetition", repetition), token);
    group.children = motions;
    items.push(group);
}

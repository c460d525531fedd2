//! Reading of postures.

use raconteur_base::DVec3;
use raconteur_eml::{Diagnostic, ShapeKey, nearest, quoted};

use super::posture::{Change, Changes, Contact, Hands};
use super::shapes;
use super::vocabulary::{self, direction};
use crate::xml::Element;

/// Elements that describe a posture.
const POSTURES: [&str; 6] = [
    "handconfig",
    "split_handconfig",
    "location_bodyarm",
    "split_location",
    "location_hand",
    "handconstellation",
];

/// Returns true if an element describes a posture.
pub(super) fn is_posture(element: &Element) -> bool {
    POSTURES.contains(&element.name.as_str())
}

/// Reader of postures.
pub(super) struct PostureReader<'p> {
    pub(super) hands: Hands,
    pub(super) problems: &'p mut Vec<Diagnostic>,
}

impl PostureReader<'_> {
    /// Adds the change of an element of a posture.
    pub(super) fn read(&mut self, element: &Element, changes: &mut Changes) {
        match element.name.as_str() {
            "handconfig" => {
                let change = self.config(element);
                for (hand, known) in changes.iter_mut().enumerate() {
                    if self.hands.moves[hand] {
                        known.add(&self.oriented(change, hand));
                    }
                }
            }
            "split_handconfig" => {
                for (known, child) in changes.iter_mut().zip(element.all("handconfig")) {
                    let mut change = self.config(child);
                    change.mirror = Some(DVec3::ONE);
                    known.add(&change);
                }
            }
            "location_bodyarm" => {
                let place = self.location(element);
                self.place_both(place, changes);
            }
            "split_location" => {
                for (hand, child) in element.children.iter().enumerate().take(2) {
                    let place = self.location(child);
                    changes[hand].place = place;
                }
            }
            "location_hand" => self.at_other_hand(element, changes),
            "handconstellation" => self.constellation(element, changes),
            _ => {}
        }
    }

    fn oriented(&self, mut change: Change, hand: usize) -> Change {
        if change.fingers.is_some() || change.palm.is_some() {
            change.mirror = Some(self.hands.mirror_of(hand));
        }
        change
    }

    fn warn(&mut self, code: &'static str, element: &Element, name: &str, message: String) {
        let span = element
            .attribute(name)
            .map_or(element.tag, |text| text.span);
        self.problems.push(Diagnostic::warning(code, span, message));
    }

    /// Reads a `handconfig`.
    fn config(&mut self, element: &Element) -> Change {
        let mut change = Change {
            shape: self.shape(element),
            fingers: self.direction(element, "extfidir"),
            palm: self.direction(element, "palmor"),
            ..Change::default()
        };
        if let Some(palm) = change.palm
            && palm.z.abs() > 1e-9
        {
            let message = "palms are written as with the fingers to the front: u, d, l, r and \
                           between";
            self.warn("sigml::direction", element, "palmor", message.to_owned());
            change.palm = None;
        }
        for attribute in &element.attributes {
            let name = attribute.name.as_str();
            let known = [
                "handshape",
                "thumbpos",
                "mainbend",
                "bend1",
                "bend2",
                "bend3",
                "bend4",
                "bend5",
                "specialfingers",
                "extfidir",
                "palmor",
            ];
            if !known.contains(&name) {
                let message = format!("the attribute {} has no effect", quoted(name));
                self.warn("sigml::unperformed", element, name, message);
            }
        }
        change
    }

    fn direction(&mut self, element: &Element, name: &str) -> Option<DVec3> {
        let value = element.value(name)?;
        let found = direction(value);
        if found.is_none() {
            let message = format!("{} is not a direction", quoted(value));
            self.warn("sigml::direction", element, name, message);
            if let Some(last) = self.problems.last_mut() {
                let hint = "directions are combinations of u, d, l, r, o and i";
                last.hints.push(hint.to_owned());
            }
        }
        found
    }

    /// Reads the shape of a `handconfig` with its reach.
    fn shape(&mut self, element: &Element) -> Option<(ShapeKey, f64)> {
        let name = element.value("handshape")?;
        let Some((_, base)) = BASES.iter().find(|(known, _)| *known == name) else {
            let message = format!("the hand shape {} is unknown", quoted(name));
            self.warn("sigml::hand-shape", element, "handshape", message);
            let names = BASES.iter().map(|(known, _)| *known);
            let known: Vec<&str> = names.clone().collect();
            let hint = match nearest(name, names) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("known are {}", known.join(", ")),
            };
            if let Some(last) = self.problems.last_mut() {
                last.hints.push(hint);
            }
            return None;
        };
        let mut modifiers: Vec<&str> = Vec::new();
        for attribute in ["thumbpos", "mainbend", "bend2"] {
            let Some(value) = element.value(attribute) else {
                continue;
            };
            match MODIFIERS.iter().find(|(known, _)| *known == value) {
                Some((_, modifier)) => modifiers.push(modifier),
                None => {
                    let message = format!("{} is unknown here", quoted(value));
                    self.warn("sigml::hand-shape", element, attribute, message);
                }
            }
        }
        for digit in element.value("specialfingers").unwrap_or("").chars() {
            let finger = digit
                .to_digit(6)
                .and_then(|digit| FINGERS.get(digit as usize));
            modifiers.extend(finger.filter(|name| !name.is_empty()));
        }
        let found = shapes::nearest(base, &modifiers);
        if !found.is_exact {
            let message = format!("the nearest hand shape is number {}", found.key.id);
            self.warn("sigml::nearest-shape", element, "handshape", message);
        }
        Some((found.key, shapes::reach(base)))
    }

    /// Reads a location on the body, for the dominant hand: its position, and the part of the hand
    /// that is there.
    fn location(&mut self, element: &Element) -> Option<(DVec3, Contact)> {
        let name = element.value("location").unwrap_or("neutralspace");
        let Some(place) = vocabulary::place(name) else {
            let message = format!("the location {} is unknown", quoted(name));
            self.warn("sigml::location", element, "location", message);
            if let Some(near) = nearest(name, vocabulary::place_names())
                && let Some(last) = self.problems.last_mut()
            {
                last.hints.push(format!("did you mean {near}?"));
            }
            return None;
        };
        // Right is negative.
        let half = place.half_width;
        let side = match element.value("side") {
            None if place.is_paired => -half,
            None | Some("front") => 0.0,
            Some("right_at") => -half,
            Some("left_at") => half,
            Some("right_beside") => -half - BESIDE,
            Some("left_beside") => half + BESIDE,
            Some(other) => {
                let message = format!("the side {} has no effect", quoted(other));
                self.warn("sigml::location", element, "side", message);
                0.0
            }
        };
        let (distance, touches) = match element.value("contact") {
            Some("touch") => (TOUCH, true),
            Some("close") => (CLOSE, true),
            Some("armextended") => (EXTENDED, false),
            None => (APART, false),
            Some(other) => {
                let message = format!("the contact {} has no effect", quoted(other));
                self.warn("sigml::location", element, "contact", message);
                (APART, false)
            }
        };
        let outward = if name == "headtop" || name == "shouldertop" {
            DVec3::Y
        } else if name.starts_with("ear") {
            DVec3::X * side.signum()
        } else {
            DVec3::NEG_Z
        };
        let distance = if name == "neutralspace" {
            0.0
        } else {
            distance
        };
        let is_at_tips = place.position.y > HEAD_HEIGHT || element.child("location_hand").is_some();
        let contact = match (touches, is_at_tips) {
            (true, true) => Contact::Tips,
            (true, false) => Contact::Either,
            (false, _) => Contact::Middle,
        };
        let position = place.position + DVec3::X * side + outward * distance;
        Some((position, contact))
    }

    /// Gives a place of the dominant hand to the hands that move, mirrored for the other one.
    fn place_both(&self, place: Option<(DVec3, Contact)>, changes: &mut Changes) {
        let Some((position, contact)) = place else {
            return;
        };
        let both = self.hands.moves == [true, true];
        for (hand, known) in changes.iter_mut().enumerate() {
            if !self.hands.moves[hand] {
                continue;
            }
            let mut own = position;
            if both && position.x.abs() < APART_X {
                own.x = -APART_X;
            }
            if hand == 1 {
                own.x = -own.x;
            }
            known.place = Some((own, contact));
        }
    }

    /// Places the dominant hand at the other one.
    fn at_other_hand(&mut self, element: &Element, changes: &mut Changes) {
        let message = "the contact of the hands is approximate";
        self.warn(
            "sigml::approximate",
            element,
            "location",
            message.to_owned(),
        );
        let other = changes[1].place.map_or(CENTRE, |(position, _)| position);
        changes[1].place = Some((other, Contact::Middle));
        let gap = match element.value("contact") {
            Some("touch") => HAND_THICKNESS,
            _ => HAND_THICKNESS + CLOSE,
        };
        changes[0].place = Some((other + DVec3::new(-gap, 1.0, 0.0), Contact::Middle));
    }

    /// Places both hands at each other.
    fn constellation(&mut self, element: &Element, changes: &mut Changes) {
        let message = "the contact of the hands is approximate";
        self.warn("sigml::approximate", element, "contact", message.to_owned());
        let body = element.child("location_bodyarm");
        let centre = body.and_then(|body| self.location(body));
        let (centre, _) = centre.unwrap_or((CENTRE, Contact::Middle));
        let gap = match element.value("contact") {
            Some("touch" | "interlock") => HAND_THICKNESS,
            _ => HAND_THICKNESS + CLOSE,
        };
        let half = DVec3::X * (gap / 2.0);
        changes[0].place = Some((centre - half, Contact::Middle));
        changes[1].place = Some((centre + half, Contact::Middle));
    }
}

/// Distances of a hand from a place on the body, skeleton units: *designed*. Half a hand's thickness
/// remains where it touches.
const TOUCH: f64 = 1.0;
const CLOSE: f64 = 3.0;
const APART: f64 = 8.0;
const EXTENDED: f64 = 15.0;
/// Distance to the side of a place that is beside it.
const BESIDE: f64 = 4.0;
/// Distance of both hands from the middle, if they are at one place there.
const APART_X: f64 = 3.0;
/// Distance of the middles of two hands that touch.
const HAND_THICKNESS: f64 = 2.5;
/// Height from which a place is touched with the fingertips: the neck.
const HEAD_HEIGHT: f64 = 28.0;
/// Place of two hands at each other: the neutral space.
const CENTRE: DVec3 = DVec3::new(0.0, 15.0, -14.0);

/// Hand shapes of SiGML with their tokens of HamNoSys.
const BASES: [(&str, &str); 14] = [
    ("fist", "hamfist"),
    ("flat", "hamflathand"),
    ("finger2", "hamfinger2"),
    ("finger23", "hamfinger23"),
    ("finger23spread", "hamfinger23spread"),
    ("finger2345", "hamfinger2345"),
    ("pinch12", "hampinch12"),
    ("pinchall", "hampinchall"),
    ("pinch12open", "hampinch12open"),
    ("cee12", "hamcee12"),
    ("ceeall", "hamceeall"),
    ("cee12open", "hamceeopen"),
    ("ceeopen", "hamceeopen"),
    ("ceeallopen", "hamceeopen"),
];

/// Positions of the thumb and bends with their tokens of HamNoSys.
const MODIFIERS: [(&str, &str); 9] = [
    ("out", "hamthumboutmod"),
    ("across", "hamthumbacrossmod"),
    ("opposed", "hamthumbopenmod"),
    ("bent", "hamfingerstraightmod"),
    ("halfbent", "hamfingerstraightmod"),
    ("round", "hamfingerbendmod"),
    ("hooked", "hamfingerhookmod"),
    ("dblbent", "hamdoublebent"),
    ("dblhooked", "hamdoublehooked"),
];

/// Tokens of the fingers by their digits.
const FINGERS: [&str; 6] = [
    "",
    "hamthumb",
    "hamindexfinger",
    "hammiddlefinger",
    "hamringfinger",
    "hampinky",
];

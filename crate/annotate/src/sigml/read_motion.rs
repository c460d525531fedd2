//! Reading of motions.

use raconteur_base::DVec3;
use raconteur_eml::{Diagnostic, quoted};

use super::motion::{DISTANCE, Motion, Repetition, circle_start};
use super::posture::{Changes, Hands};
use super::read_posture::{PostureReader, is_posture};
use super::vocabulary::direction;
use crate::xml::Element;

/// Maximum nesting of motions.
const MAX_DEPTH: usize = 5;
/// Maximum number of motions of a sign.
const MAX_MOTIONS: usize = 64;
/// Factors of small and big sizes.
const SMALL: f64 = 0.5;
const BIG: f64 = 1.7;
/// Radius of a circle of usual size, skeleton units: *designed*.
const RADIUS: f64 = 4.0;
/// Height of a curve or wave, as a share of its length.
const BULGE: f64 = 0.3;

/// Reader of motions.
pub(super) struct MotionReader<'p> {
    pub(super) hands: Hands,
    pub(super) problems: &'p mut Vec<Diagnostic>,
    /// Motions read so far.
    pub(super) count: usize,
}

/// Motions of SiGML.
const MOTIONS: [&str; 14] = [
    "directedmotion",
    "circularmotion",
    "crossmotion",
    "wristmotion",
    "fingerplay",
    "changeposture",
    "nomotion",
    "nonman_motion",
    "par_motion",
    "seq_motion",
    "split_motion",
    "rpt_motion",
    "tgt_motion",
    "timed_motion",
];

/// Returns true if an element describes a motion.
pub(super) fn is_motion(element: &Element) -> bool {
    MOTIONS.contains(&element.name.as_str())
}

impl MotionReader<'_> {
    fn warn(&mut self, code: &'static str, element: &Element, name: &str, message: String) {
        let span = element
            .attribute(name)
            .map_or(element.tag, |text| text.span);
        self.problems.push(Diagnostic::warning(code, span, message));
    }

    /// Reads a motion. Reports motions that are nested too deeply or too many.
    pub(super) fn read(&mut self, element: &Element, depth: usize) -> Motion {
        self.count += 1;
        if depth > MAX_DEPTH || self.count > MAX_MOTIONS {
            if depth > MAX_DEPTH || self.count == MAX_MOTIONS + 1 {
                let message =
                    format!("more than {MAX_DEPTH} levels or {MAX_MOTIONS} motions of a sign");
                let problem = Diagnostic::error("sigml::too-large", element.tag, message);
                self.problems.push(problem);
            }
            return Motion::Hold;
        }
        let motion = match element.name.as_str() {
            "directedmotion" | "crossmotion" => self.line(element),
            "circularmotion" => self.circle(element),
            "wristmotion" => self.wrist(element),
            "fingerplay" => Motion::Fingers,
            "par_motion" => Motion::Parallel(self.children(element, depth)),
            "seq_motion" => Motion::Sequence(self.children(element, depth)),
            "split_motion" => Motion::Split(self.children(element, depth)),
            "rpt_motion" => self.repeat(element, depth),
            "tgt_motion" => self.target(element, depth),
            "nonman_motion" => {
                let message = "motions of the body are not performed".to_owned();
                self.warn("sigml::unperformed", element, "", message);
                Motion::Hold
            }
            _ => Motion::Hold,
        };
        let flag = |name: &str| matches!(element.value(name), Some("true" | "1"));
        let factor = match (flag("fast"), flag("slow")) {
            (true, false) => 0.6,
            (false, true) => 1.7,
            _ => return motion,
        };
        Motion::Paced(Box::new(motion), factor)
    }

    fn children(&mut self, element: &Element, depth: usize) -> Vec<Motion> {
        let mut all = Vec::new();
        for child in &element.children {
            if is_motion(child) {
                all.push(self.read(child, depth + 1));
            } else if !is_posture(child) {
                let message = format!("{} is not a motion", quoted(&child.name));
                self.warn("sigml::unknown-element", child, "", message);
            }
        }
        all
    }

    fn direction(&mut self, element: &Element, name: &str) -> Option<DVec3> {
        let value = element.value(name)?;
        let found = direction(value);
        if found.is_none() {
            let message = format!("{} is not a direction", quoted(value));
            self.warn("sigml::direction", element, name, message);
        }
        found
    }

    fn size(&mut self, element: &Element) -> f64 {
        match element.value("size") {
            None | Some("medium") => 1.0,
            Some("small") => SMALL,
            Some("big" | "large") => BIG,
            Some(other) => {
                let message = format!("{} is not a size", quoted(other));
                self.warn("sigml::size", element, "size", message);
                1.0
            }
        }
    }

    fn line(&mut self, element: &Element) -> Motion {
        let Some(direction) = self.direction(element, "direction") else {
            if element.value("direction").is_none() {
                let message = "the motion has no direction".to_owned();
                self.warn("sigml::direction", element, "", message);
            }
            return Motion::Hold;
        };
        let vector = direction * DISTANCE * self.size(element);
        let waves = match element.value("zigzag_style") {
            None => 0,
            Some("wavy" | "zigzag") => 3,
            Some(other) => {
                let message = format!("{} is not a style of waves", quoted(other));
                self.warn("sigml::size", element, "zigzag_style", message);
                0
            }
        };
        let bulge = self.direction(element, "curve");
        let side = bulge.or((waves > 0).then(|| circle_start(direction)));
        let bulge = side.map_or(DVec3::ZERO, |side| side * vector.length() * BULGE);
        Motion::Line {
            vector,
            bulge,
            waves,
        }
    }

    fn circle(&mut self, element: &Element) -> Motion {
        let axis = self.direction(element, "axis").unwrap_or(DVec3::NEG_Z);
        let radius = RADIUS * self.size(element);
        let turns = match element.value("clockplus") {
            Some("true" | "1") => 2.0,
            _ => 1.0,
        };
        Motion::Circle {
            axis,
            radius,
            turns,
        }
    }

    fn wrist(&mut self, element: &Element) -> Motion {
        let axis = match element.value("motion").unwrap_or("") {
            "swinging" | "swing" => DVec3::X,
            "twisting" | "twist" => DVec3::Y,
            "nodding" | "nod" => DVec3::Z,
            "stircw" | "stirccw" => DVec3::new(0.7, 0.0, 0.7),
            other => {
                let message = format!("{} is not a motion of the wrist", quoted(other));
                self.warn("sigml::motion", element, "motion", message);
                return Motion::Hold;
            }
        };
        Motion::Wrist(axis)
    }

    fn repeat(&mut self, element: &Element, depth: usize) -> Motion {
        let motion = Box::new(Motion::Sequence(self.children(element, depth)));
        let repetition = element.value("repetition").unwrap_or("fromstart");
        let (kind, several) = match repetition.strip_suffix("_several") {
            Some(kind) => (kind, true),
            None => (repetition, false),
        };
        let kind = match kind {
            "fromstart" => Repetition::FromStart,
            "reverse" | "swap" => Repetition::Back,
            "continue" => Repetition::Continued,
            _ => {
                let message = format!("{} is not a repetition", quoted(repetition));
                self.warn("sigml::repetition", element, "repetition", message);
                Repetition::FromStart
            }
        };
        Motion::Repeat {
            motion,
            count: if several { 3 } else { 2 },
            kind,
        }
    }

    fn target(&mut self, element: &Element, depth: usize) -> Motion {
        let mut motions = self.children(element, depth);
        let motion = match motions.len() {
            0 => Motion::Hold,
            1 => motions.remove(0),
            _ => Motion::Sequence(motions),
        };
        let mut changes = Changes::default();
        let mut reader = PostureReader {
            hands: self.hands,
            problems: self.problems,
        };
        for child in element.children.iter().filter(|child| is_posture(child)) {
            reader.read(child, &mut changes);
        }
        Motion::Target(Box::new(motion), Box::new(changes))
    }
}

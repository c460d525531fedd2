//! Features: what a nested list means as hand shapes, palm orientations or positions.

use raconteur_base::Side;

use super::node::{GslError, Lexer, Node, Number, Unit};
use super::{Item, Offset, Sequence, Value};

/// Number of the last hand shape (GEVH C.Fig.4; the table of this project has 0 to 60).
const MAX_SHAPE: f64 = 60.0;
/// Maximum size of a coordinate, as in EML.
const MAX_COORDINATE: f64 = raconteur_eml::MAX_COORDINATE;

/// Hand shape by its number in the table of Portuguese Sign Language, 0 to 60.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape(pub u8);

/// Palm orientation: the palm's outward normal, and an angle about it by the left-hand rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palm {
    /// Angle about the normal, degrees.
    pub angle_deg: f64,
    /// Normal, not zero, not normalised: x left, y up, z front.
    pub axis: [f64; 3],
}

/// Wrist position in speaker coordinates, skeleton units: x left, y up, z front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position(pub [f64; 3]);

impl Position {
    /// Returns the distance to another position, skeleton units.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        let [x, y, z] = std::array::from_fn(|axis| self.0[axis] - other.0[axis]);
        raconteur_base::ops::hypot(raconteur_base::ops::hypot(x, y), z)
    }
}

/// Feature of a gesture phase that GSL describes.
pub trait Feature: Clone + PartialEq + sealed::Written {
    /// Name of the feature in messages.
    const NAME: &'static str;
}

pub(super) mod sealed {
    use super::super::node::{GslError, Node};

    /// Reading and writing of one feature.
    pub trait Written: Sized {
        /// Returns true if a node has the structure of one feature.
        #[doc(hidden)]
        fn is_feature(node: &Node) -> bool;
        /// Reads a node that has the structure.
        #[doc(hidden)]
        fn read(node: &Node) -> Result<Self, GslError>;
        /// Appends the text of the feature.
        #[doc(hidden)]
        fn write(&self, out: &mut String);
        /// True if a list of two numbers could also be two features.
        #[doc(hidden)]
        const IS_NUMBER: bool;
    }
}

impl Feature for Shape {
    const NAME: &'static str = "hand shape";
}

impl sealed::Written for Shape {
    const IS_NUMBER: bool = true;

    fn is_feature(node: &Node) -> bool {
        node.number().is_some()
    }

    fn read(node: &Node) -> Result<Self, GslError> {
        let number = node.number().filter(|number| number.unit == Unit::None);
        let id = number.map(|number| number.value);
        match id.filter(|id| (0.0..=MAX_SHAPE).contains(id) && id.fract() == 0.0) {
            Some(id) => Ok(Self(id as u8)),
            None => Err(node.error(
                "gsl::hand-shape",
                "this is not the number of a hand shape",
                "hand shapes have the numbers 0 to 60",
            )),
        }
    }

    fn write(&self, out: &mut String) {
        out.push_str(&self.0.to_string());
    }
}

impl Feature for Palm {
    const NAME: &'static str = "palm orientation";
}

impl sealed::Written for Palm {
    const IS_NUMBER: bool = false;

    fn is_feature(node: &Node) -> bool {
        let Some([angle, axis]) = node.list() else {
            return false;
        };
        angle.number().is_some() && Position::is_feature(axis)
    }

    fn read(node: &Node) -> Result<Self, GslError> {
        let Some([angle, axis]) = node.list() else {
            return Err(expected::<Self>(node));
        };
        let angle_deg = plain(angle)?;
        let Position(components) = Position::read(axis)?;
        if components.iter().map(|c| c * c).sum::<f64>() < f64::MIN_POSITIVE {
            return Err(axis.error(
                "gsl::zero-axis",
                "the palm's normal is zero",
                "it gives the direction that the palm faces, such as [0;0;1] for the front",
            ));
        }
        Ok(Self {
            angle_deg,
            axis: components,
        })
    }

    fn write(&self, out: &mut String) {
        out.push_str(&format!("[{};", self.angle_deg + 0.0));
        Position(self.axis).write(out);
        out.push(']');
    }
}

impl Feature for Position {
    const NAME: &'static str = "position";
}

impl sealed::Written for Position {
    const IS_NUMBER: bool = false;

    fn is_feature(node: &Node) -> bool {
        let is_number = |node: &Node| node.number().is_some();
        node.list()
            .is_some_and(|list| list.len() == 3 && list.iter().all(is_number))
    }

    fn read(node: &Node) -> Result<Self, GslError> {
        let Some([x, y, z]) = node.list() else {
            return Err(expected::<Self>(node));
        };
        Ok(Self([plain(x)?, plain(y)?, plain(z)?]))
    }

    fn write(&self, out: &mut String) {
        let [x, y, z] = self.0.map(|c| c + 0.0);
        out.push_str(&format!("[{x};{y};{z}]"));
    }
}

/// Reads a number without unit, in the range of coordinates.
fn plain(node: &Node) -> Result<f64, GslError> {
    match node.number() {
        Some(Number {
            value,
            unit: Unit::None,
            ..
        }) if value.abs() <= MAX_COORDINATE => Ok(value),
        Some(Number {
            unit: Unit::None, ..
        }) => {
            let message = format!("numbers are limited to {MAX_COORDINATE}");
            Err(node.error("gsl::number", message, ""))
        }
        _ => Err(node.error("gsl::unexpected", "expected a number without a unit", "")),
    }
}

fn expected<F: Feature>(node: &Node) -> GslError {
    let hint = match F::NAME {
        "position" => "positions look like [0;10;0]",
        "palm orientation" => "palm orientations look like [90;[0;1;0]]",
        _ => "hand shapes are whole numbers",
    };
    node.error("gsl::unexpected", format!("expected a {}", F::NAME), hint)
}

/// Parses a text.
pub(super) fn value<F: Feature>(text: &str) -> Result<Value<F>, GslError> {
    let mut lexer = Lexer::new(text);
    let Some(first) = lexer.label()? else {
        let sequence = sequence(&lexer.node(0)?)?;
        end(&mut lexer)?;
        return Ok(Value::Common(sequence));
    };
    let mut hands: [Option<Sequence<F>>; 2] = [None, None];
    let mut label = Some(first);
    while let Some((start, end, is_right)) = label {
        let side = if is_right { Side::Right } else { Side::Left };
        let read = sequence(&lexer.node(0)?)?;
        if hands[side.index()].replace(read).is_some() {
            return Err(GslError {
                code: "gsl::hand",
                start,
                end,
                message: "this hand is given twice".into(),
                hint: "",
            });
        }
        label = if lexer.take(';')? {
            lexer.label()?
        } else {
            None
        };
    }
    end(&mut lexer)?;
    let mut of = |side: Side| hands[side.index()].take();
    Ok(Value::PerHand {
        right: of(Side::Right),
        left: of(Side::Left),
    })
}

fn end(lexer: &mut Lexer<'_>) -> Result<(), GslError> {
    match lexer.peek()? {
        None => Ok(()),
        Some(_) => Err(lexer.unexpected("the end")),
    }
}

fn sequence<F: Feature>(node: &Node) -> Result<Sequence<F>, GslError> {
    let items = if F::is_feature(node) {
        vec![untimed(node)?]
    } else if is_timed::<F>(node, true) {
        vec![timed(node)?]
    } else {
        let list = node.list().ok_or_else(|| expected::<F>(node))?;
        let item = |node: &Node| {
            if F::is_feature(node) {
                untimed(node)
            } else if is_timed::<F>(node, false) {
                timed(node)
            } else {
                Err(expected::<F>(node))
            }
        };
        list.iter().map(item).collect::<Result<_, _>>()?
    };
    Ok(Sequence { items })
}

/// Returns true if a node is a pair of an offset and a feature. Two numbers alone are two hand
/// shapes, unless the first one is written as a time.
fn is_timed<F: Feature>(node: &Node, alone: bool) -> bool {
    let Some([offset, feature]) = node.list() else {
        return false;
    };
    let is_time =
        |number: Number| !F::IS_NUMBER || !alone || number.unit != Unit::None || number.has_point;
    offset.number().is_some_and(is_time) && F::is_feature(feature)
}

fn untimed<F: Feature>(node: &Node) -> Result<Item<F>, GslError> {
    Ok(Item {
        offset: None,
        feature: F::read(node)?,
    })
}

fn timed<F: Feature>(node: &Node) -> Result<Item<F>, GslError> {
    let Some([time, feature]) = node.list() else {
        return Err(expected::<F>(node));
    };
    let number = time.number().ok_or_else(|| expected::<F>(node))?;
    let most = match number.unit {
        Unit::Percent => 100.0,
        Unit::Secs | Unit::None => MAX_COORDINATE,
    };
    if !(0.0..=most).contains(&number.value) {
        return Err(time.error(
            "gsl::offset",
            "times of a phase are 0 s or later, and at most 100 %",
            "",
        ));
    }
    let offset = match number.unit {
        Unit::Percent => Offset::Percent(number.value),
        Unit::Secs | Unit::None => Offset::Secs(number.value),
    };
    Ok(Item {
        offset: Some(offset),
        feature: F::read(feature)?,
    })
}

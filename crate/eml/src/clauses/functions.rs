//! Functions of time with named arguments (GEVH D.1.6, D.3.23).

use crate::record::{Field, Value, record};

/// Value of a function argument: a number or a text.
#[derive(Clone, Debug, PartialEq)]
pub enum ArgValue {
    /// A number.
    Number(f64),
    /// Anything else.
    Text(String),
}

impl Default for ArgValue {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl Field for ArgValue {
    fn set(&mut self, value: Value) {
        match value {
            Value::Number(number) => *self = Self::Number(number),
            Value::Text(text) => *self = Self::Text(text.into()),
            _ => {}
        }
    }

    fn get(&self) -> Value {
        match self {
            Self::Number(number) => Value::Number(*number),
            Self::Text(text) => Value::Text(text.into()),
        }
    }
}

record! {
    /// An argument of a function.
    Arg = "arg" {
        /// Name of the argument.
        name: String = "name",
        /// Value of the argument.
        value: ArgValue = "value",
    }
}

record! {
    /// The arguments of a function, in order.
    FunctionArgs = "function-args" {}
    children {
        /// The arguments. Of several with one name the last counts.
        args: Vec<Arg>
    }
}

impl FunctionArgs {
    /// Returns the number given by an argument; `None` if it is absent or a text.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        self.args
            .iter()
            .rev()
            .find(|arg| arg.name == name)
            .and_then(|arg| match arg.value {
                ArgValue::Number(number) => Some(number),
                ArgValue::Text(_) => None,
            })
    }

    /// Returns the period of the function, seconds, at least 0; 0 if it is not given.
    #[must_use]
    pub fn period_secs(&self) -> f64 {
        self.number("timePeriod").unwrap_or(0.0).max(0.0)
    }
}

record! {
    /// Moves the whole figure along a function (GEVH D.1.6).
    VhMove = "vh-move" {
        /// Name of the function, such as `segment`.
        function: String = "functionName",
        /// True if it repeats after its period.
        is_looping: bool = "isLooping",
    }
    children {
        /// Arguments of the function that describes the motion.
        args: Option<FunctionArgs>
    }
}

//! Texts as nested lists of numbers, before a feature gives them a meaning.

use std::fmt;

/// Maximum nesting of lists: a palm in a timed item of a sequence has four levels.
const MAX_DEPTH: usize = 8;
/// Maximum number of numbers and lists in a text.
const MAX_NODES: usize = 10_000;

/// Error in a GSL text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GslError {
    /// Machine-readable code of the problem.
    pub code: &'static str,
    /// Range of bytes in the text.
    pub start: usize,
    /// End of the range.
    pub end: usize,
    /// Message in one sentence.
    pub message: String,
    /// Hint for a fix; may be empty.
    pub hint: &'static str,
}

impl fmt::Display for GslError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.start, self.message)
    }
}

impl std::error::Error for GslError {}

/// Number or list, with its range in the text.
#[derive(Clone, Debug)]
pub struct Node {
    pub(super) kind: NodeKind,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// Kind of a node.
#[derive(Clone, Debug)]
pub(super) enum NodeKind {
    Number(Number),
    List(Vec<Node>),
}

/// Number with its unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number {
    pub(super) value: f64,
    pub(super) unit: Unit,
    /// True if it is written with a decimal point.
    pub(super) has_point: bool,
}

/// Unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    None,
    Secs,
    Percent,
}

impl Node {
    /// Returns the elements of a list; `None` for a number.
    pub(super) fn list(&self) -> Option<&[Node]> {
        match &self.kind {
            NodeKind::List(list) => Some(list),
            NodeKind::Number(_) => None,
        }
    }

    /// Returns the number; `None` for a list.
    pub(super) fn number(&self) -> Option<Number> {
        match self.kind {
            NodeKind::Number(number) => Some(number),
            NodeKind::List(_) => None,
        }
    }

    /// Returns an error about the node.
    pub(super) fn error(
        &self,
        code: &'static str,
        message: impl Into<String>,
        hint: &'static str,
    ) -> GslError {
        GslError {
            code,
            start: self.start,
            end: self.end,
            message: message.into(),
            hint,
        }
    }
}

/// Reader of a text.
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
    nodes: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            text,
            at: 0,
            nodes: 0,
        }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Returns the next character after white space and comments; `None` at the end.
    pub(super) fn peek(&mut self) -> Result<Option<char>, GslError> {
        loop {
            self.at = self.text.len() - self.rest().trim_start().len();
            let rest = self.rest();
            if rest.starts_with("//") {
                self.at += rest.find('\n').unwrap_or(rest.len());
            } else if let Some(comment) = rest.strip_prefix("/*") {
                let Some(length) = comment.find("*/") else {
                    let message = "the comment that opens here is not closed";
                    return Err(self.error("gsl::not-closed", 2, message, ""));
                };
                self.at += length + 4;
            } else {
                return Ok(rest.chars().next());
            }
        }
    }

    /// Passes over a character if it is the next one.
    pub(super) fn take(&mut self, wanted: char) -> Result<bool, GslError> {
        let is_next = self.peek()? == Some(wanted);
        if is_next {
            self.at += wanted.len_utf8();
        }
        Ok(is_next)
    }

    /// Returns the range of the label of a hand, `RH` or `LH`, and whether it is the right one;
    /// `None` if no letter is next.
    pub(super) fn label(&mut self) -> Result<Option<(usize, usize, bool)>, GslError> {
        if !self.peek()?.is_some_and(char::is_alphabetic) {
            return Ok(None);
        }
        let start = self.at;
        let rest = self.rest();
        let length = rest
            .find(|c: char| !c.is_alphanumeric())
            .unwrap_or(rest.len());
        let word = &rest[..length];
        let is_right = word.eq_ignore_ascii_case("RH");
        if !is_right && !word.eq_ignore_ascii_case("LH") {
            let message = format!("{} is no hand", raconteur_eml::quoted(word));
            return Err(self.error("gsl::hand", length, message, "the hands are RH and LH"));
        }
        self.at += length;
        if !self.take('=')? {
            return Err(self.unexpected("`=` after the hand"));
        }
        Ok(Some((start, start + length, is_right)))
    }

    /// Reads a number or a list. Recursion is limited by [`MAX_DEPTH`].
    pub(super) fn node(&mut self, depth: usize) -> Result<Node, GslError> {
        self.nodes += 1;
        if depth > MAX_DEPTH || self.nodes > MAX_NODES {
            let message = "lists are too deep or too long";
            return Err(self.error("gsl::too-large", 1, message, ""));
        }
        let next = self.peek()?;
        let start = self.at;
        if next != Some('[') {
            let number = self.number()?;
            return Ok(Node {
                kind: NodeKind::Number(number),
                start,
                end: self.at,
            });
        }
        self.at += 1;
        let mut list = Vec::new();
        if self.take(']')? {
            let mut error = self.error("gsl::empty", 0, "the list is empty", "");
            (error.start, error.end) = (start, self.at);
            return Err(error);
        }
        loop {
            list.push(self.node(depth + 1)?);
            if self.take(';')? {
                continue;
            }
            if self.take(']')? {
                break;
            }
            if self.rest().is_empty() {
                return Err(GslError {
                    code: "gsl::not-closed",
                    start,
                    end: start + 1,
                    message: "the list that opens here is not closed".into(),
                    hint: "lists look like [0;10;0]",
                });
            }
            return Err(self.unexpected("`;` or `]`"));
        }
        Ok(Node {
            kind: NodeKind::List(list),
            start,
            end: self.at,
        })
    }

    fn number(&mut self) -> Result<Number, GslError> {
        let rest = self.rest();
        let unsigned = rest.strip_prefix(['-', '+', '\u{2212}']).unwrap_or(rest);
        let sign = rest.len() - unsigned.len();
        let digits = unsigned
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(unsigned.len());
        let is_negative = rest.starts_with(['-', '\u{2212}']);
        let number = &unsigned[..digits];
        if !number.contains(|c: char| c.is_ascii_digit()) {
            return Err(self.unexpected("a number or `[`"));
        }
        let value: f64 = match number.parse() {
            Ok(value) => value,
            Err(_) => {
                let message = format!("{} is not a number", raconteur_eml::quoted(number));
                return Err(self.error("gsl::number", sign + digits, message, ""));
            }
        };
        if !value.is_finite() {
            let message = "the number is too large";
            return Err(self.error("gsl::number", sign + digits, message, ""));
        }
        self.at += sign + digits;
        let spaces = self.rest().len() - self.rest().trim_start().len();
        if self.rest().trim_start().starts_with(['%', 's', 'S']) {
            self.at += spaces;
        }
        let unit = if self.rest().starts_with('%') {
            self.at += 1;
            Unit::Percent
        } else if self.rest().starts_with(['s', 'S']) {
            self.at += 1;
            Unit::Secs
        } else {
            Unit::None
        };
        if self.rest().starts_with(char::is_alphabetic) {
            return Err(self.unexpected("`;` or `]`"));
        }
        Ok(Number {
            value: if is_negative { -value } else { value },
            unit,
            has_point: number.contains('.'),
        })
    }

    /// Returns an error about the next `length` bytes.
    fn error(
        &self,
        code: &'static str,
        length: usize,
        message: impl Into<String>,
        hint: &'static str,
    ) -> GslError {
        GslError {
            code,
            start: self.at,
            end: (self.at + length).min(self.text.len()),
            message: message.into(),
            hint,
        }
    }

    /// Returns an error about the next character.
    pub(super) fn unexpected(&self, wanted: &str) -> GslError {
        let next = self.rest().chars().next();
        let found = next.map_or("the end".to_owned(), |c| format!("`{}`", c.escape_debug()));
        let hint = match next {
            Some(',') => "a point is the decimal separator, and `;` separates list items",
            _ => "",
        };
        let length = next.map_or(0, char::len_utf8);
        let message = format!("expected {wanted}, found {found}");
        self.error("gsl::unexpected", length, message, hint)
    }
}

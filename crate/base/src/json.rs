//! JSON (RFC 8259) read whole into values that know their place.
//!
//! A page downloads this reader with the player, so it is small: one kind of value for every
//! use, objects as plain lists, numbers by [`crate::decimal`]. General libraries bring ten
//! times as much into the page, most of it readers made for each type.

use std::borrow::Cow;
use std::fmt;
use std::ops::Index;

/// Lists and objects may lie in each other this deep; texts from outside must not exhaust
/// the stack.
pub const MOST_DEPTH: usize = 127;

/// A value and where it begins; borrows from the text that it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct Json<'a> {
    /// What it is.
    pub value: Value<'a>,
    /// Where it begins in the text.
    pub place: Place,
}

/// What a value is.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// `null`; also what stands for an absent member.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A finite number.
    Number(f64),
    /// A string without its escapes.
    Text(Cow<'a, str>),
    /// An array.
    List(Vec<Json<'a>>),
    /// An object's members as written. Of those with one name the last counts.
    Object(Vec<(Cow<'a, str>, Json<'a>)>),
}

/// A place in a text, both numbers from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Line.
    pub line: u32,
    /// Column, in bytes.
    pub column: u32,
}

/// Why a text is not the JSON that is wanted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong.
    pub what: String,
    /// Where.
    pub place: Place,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Place { line, column } = self.place;
        write!(f, "{} at line {line} column {column}", self.what)
    }
}

impl std::error::Error for Fault {}

/// What stands for a value that is not there.
pub static ABSENT: Json<'static> = Json {
    value: Value::Null,
    place: Place { line: 0, column: 0 },
};

impl<'a> Json<'a> {
    /// Reads a text that is one value.
    ///
    /// # Errors
    /// When the text is not UTF-8 or not JSON, has numbers beyond those of `f64`, or lies
    /// deeper than [`MOST_DEPTH`].
    pub fn read(text: &'a [u8]) -> Result<Self, Fault> {
        if crate::encoding::is_utf16(text) {
            return Err(Fault {
                what: "this is UTF-16 text, not UTF-8; save the file as UTF-8".to_owned(),
                place: Place { line: 1, column: 1 },
            });
        }
        let (whole, broken) = match str::from_utf8(text) {
            Ok(whole) => (whole, false),
            Err(e) => {
                let valid = &text[..e.valid_up_to()];
                (str::from_utf8(valid).unwrap_or_default(), true)
            }
        };
        let mut reader = Reader {
            text: whole,
            at: 0,
            line: 1,
            line_start: 0,
        };
        let read = reader.value(0).and_then(|value| {
            reader.skip_space();
            if reader.at < whole.len() {
                return reader.fault("something follows the end");
            }
            Ok(value)
        });
        // Where the valid part ends, the fault is that it ends.
        if broken && reader.at >= whole.len() {
            return reader.fault("not UTF-8");
        }
        read
    }

    /// A member by name; `null` where this is no object or has none.
    #[must_use]
    pub fn get(&self, name: &str) -> &Self {
        let member = self.members().iter().rfind(|(n, _)| n == name);
        member.map_or(&ABSENT, |(_, value)| value)
    }

    /// The members of an object; none where this is something else.
    #[must_use]
    pub fn members(&self) -> &[(Cow<'a, str>, Self)] {
        match &self.value {
            Value::Object(members) => members,
            _ => &[],
        }
    }

    /// The values of a list; none where this is something else.
    #[must_use]
    pub fn items(&self) -> &[Self] {
        match &self.value {
            Value::List(items) => items,
            _ => &[],
        }
    }

    /// The text, if this is one.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The number, if this is one.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self.value {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    /// The number, if this is a whole one from 0 to 2⁵³.
    #[must_use]
    pub fn whole(&self) -> Option<u64> {
        let number = self.number()?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "compared below; as casts saturate"
        )]
        let whole = number as u64;
        #[expect(clippy::cast_precision_loss, reason = "up to 2^53 there is none")]
        let same = whole as f64 == number;
        (same && whole <= 1 << 53).then_some(whole)
    }

    /// The number, if this is one that can count what is in memory.
    #[must_use]
    pub fn index(&self) -> Option<usize> {
        usize::try_from(self.whole()?).ok()
    }

    /// The truth, if this is one.
    #[must_use]
    pub fn truth(&self) -> Option<bool> {
        match self.value {
            Value::Bool(truth) => Some(truth),
            _ => None,
        }
    }

    /// Whether this is `null` or absent.
    #[must_use]
    pub fn is_null(&self) -> bool {
        matches!(self.value, Value::Null)
    }

    /// Whether this is an object.
    #[must_use]
    pub fn is_object(&self) -> bool {
        matches!(self.value, Value::Object(_))
    }

    /// Whether this is a list.
    #[must_use]
    pub fn is_list(&self) -> bool {
        matches!(self.value, Value::List(_))
    }

    /// What is wrong with this value.
    #[must_use]
    pub fn fault(&self, what: String) -> Fault {
        Fault {
            what,
            place: self.place,
        }
    }
}

impl<'a> Index<&str> for Json<'a> {
    type Output = Json<'a>;

    fn index(&self, name: &str) -> &Self::Output {
        self.get(name)
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    line: u32,
    /// Offset of the line's first byte.
    line_start: usize,
}

impl<'a> Reader<'a> {
    fn place(&self) -> Place {
        #[expect(clippy::cast_possible_truncation, reason = "nobody counts further")]
        let column = (self.at - self.line_start) as u32;
        Place {
            line: self.line,
            column: column.saturating_add(1),
        }
    }

    #[cold]
    #[inline(never)]
    fn fault<T>(&self, what: &str) -> Result<T, Fault> {
        Err(Fault {
            what: what.to_owned(),
            place: self.place(),
        })
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while let Some(byte) = self.peek()
            && matches!(byte, b' ' | b'\n' | b'\r' | b'\t')
        {
            self.at += 1;
            if byte == b'\n' {
                self.line = self.line.saturating_add(1);
                self.line_start = self.at;
            }
        }
    }

    /// Steps over a byte if it comes next.
    fn take(&mut self, byte: u8) -> bool {
        let comes = self.peek() == Some(byte);
        self.at += usize::from(comes);
        comes
    }

    fn value(&mut self, depth: usize) -> Result<Json<'a>, Fault> {
        self.skip_space();
        let place = self.place();
        let value = match self.peek() {
            Some(b'"') => Value::Text(self.string()?),
            Some(b'-' | b'0'..=b'9') => self.number()?,
            Some(open @ (b'[' | b'{')) => {
                if depth >= MOST_DEPTH {
                    return self.fault("nested too deep");
                }
                self.at += 1;
                self.group(open == b'{', depth)?
            }
            _ => self.word()?,
        };
        Ok(Json { value, place })
    }

    fn word(&mut self) -> Result<Value<'a>, Fault> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let (word, value) = match rest.as_bytes().first() {
            Some(b'n') => ("null", Value::Null),
            Some(b't') => ("true", Value::Bool(true)),
            _ => ("false", Value::Bool(false)),
        };
        if !rest.starts_with(word) {
            return self.fault(if rest.is_empty() {
                "the text ends within a value"
            } else {
                "expected a value"
            });
        }
        self.at += word.len();
        Ok(value)
    }

    /// What follows `[` or `{`.
    fn group(&mut self, named: bool, depth: usize) -> Result<Value<'a>, Fault> {
        let close = if named { b'}' } else { b']' };
        let (mut members, mut items) = (Vec::new(), Vec::new());
        self.skip_space();
        let mut ended = self.take(close);
        while !ended {
            if named {
                self.skip_space();
                if self.peek() != Some(b'"') {
                    return self.fault("expected a member's name");
                }
                let name = self.string()?;
                self.skip_space();
                if !self.take(b':') {
                    return self.fault("expected `:`");
                }
                members.push((name, self.value(depth + 1)?));
            } else {
                items.push(self.value(depth + 1)?);
            }
            self.skip_space();
            ended = self.take(close);
            if !ended && !self.take(b',') {
                return self.fault(if named {
                    "expected `,` or `}`"
                } else {
                    "expected `,` or `]`"
                });
            }
        }
        Ok(if named {
            Value::Object(members)
        } else {
            Value::List(items)
        })
    }

    /// Steps over digits; whether there were any.
    fn digits(&mut self) -> bool {
        let from = self.at;
        while self.peek().is_some_and(|b| b.is_ascii_digit()) {
            self.at += 1;
        }
        self.at > from
    }

    fn number(&mut self) -> Result<Value<'a>, Fault> {
        let from = self.at;
        self.take(b'-');
        // Nothing may follow a leading zero but a point or an exponent.
        let mut fine = self.take(b'0') || self.digits();
        if self.take(b'.') {
            fine &= self.digits();
        }
        if self.take(b'e') || self.take(b'E') {
            if !self.take(b'+') {
                self.take(b'-');
            }
            fine &= self.digits();
        }
        let written = self.text.get(from..self.at).unwrap_or_default();
        match crate::decimal::parse(written) {
            Some(number) if fine && number.is_finite() => Ok(Value::Number(number)),
            Some(_) if fine => self.fault("a number is out of range"),
            _ => self.fault("a number is incomplete"),
        }
    }

    /// A string, from its opening quote on.
    fn string(&mut self) -> Result<Cow<'a, str>, Fault> {
        self.at += 1;
        let mut from = self.at;
        let mut built = String::new();
        loop {
            let Some(byte) = self.peek() else {
                return self.fault("the text ends within a string");
            };
            if byte != b'"' && byte != b'\\' {
                if byte < b' ' {
                    return self.fault("a control character in a string");
                }
                self.at += 1;
                continue;
            }
            // Quotes and backslashes never lie within a character.
            let plain = self.text.get(from..self.at).unwrap_or_default();
            self.at += 1;
            if byte == b'"' {
                return Ok(if built.is_empty() {
                    Cow::Borrowed(plain)
                } else {
                    built.push_str(plain);
                    Cow::Owned(built)
                });
            }
            built.push_str(plain);
            match self.escape() {
                Some(c) => built.push(c),
                None => return self.fault("an escape that means nothing"),
            }
            from = self.at;
        }
    }

    /// What follows a backslash.
    fn escape(&mut self) -> Option<char> {
        let byte = self.peek()?;
        self.at += 1;
        Some(match byte {
            b'"' | b'\\' | b'/' => char::from(byte),
            b'b' => '\u{8}',
            b'f' => '\u{c}',
            b'n' => '\n',
            b'r' => '\r',
            b't' => '\t',
            b'u' => {
                let mut code = self.hex()?;
                if code & 0xfc00 == 0xd800 {
                    // The other half of a UTF-16 pair.
                    let low = if self.take(b'\\') && self.take(b'u') {
                        self.hex()?
                    } else {
                        0
                    };
                    if low & 0xfc00 != 0xdc00 {
                        return None;
                    }
                    code = 0x1_0000 + ((code & 0x3ff) << 10 | low & 0x3ff);
                }
                char::from_u32(code)?
            }
            _ => return None,
        })
    }

    /// Four hexadecimal digits.
    fn hex(&mut self) -> Option<u32> {
        let mut code = 0;
        for _ in 0..4 {
            code = code << 4 | char::from(self.peek()?).to_digit(16)?;
            self.at += 1;
        }
        Some(code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same text as a well-known reader sees it.
    fn theirs(text: &[u8]) -> Option<serde_json::Value> {
        serde_json::from_slice(text).ok()
    }

    fn same(ours: &Json<'_>, theirs: &serde_json::Value) -> bool {
        use serde_json::Value as Their;
        match (&ours.value, theirs) {
            (Value::Null, Their::Null) => true,
            (Value::Bool(a), Their::Bool(b)) => a == b,
            // Theirs may be off in the last bit.
            (Value::Number(a), Their::Number(b)) => b
                .as_f64()
                .is_some_and(|b| (a - b).abs() <= b.abs() * f64::EPSILON),
            (Value::Text(a), Their::String(b)) => a == b,
            (Value::List(a), Their::Array(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
            }
            (Value::Object(_), Their::Object(b)) => b.iter().all(|(n, b)| same(&ours[n], b)),
            _ => false,
        }
    }

    fn agree(text: &[u8]) {
        let shown = String::from_utf8_lossy(text);
        match (Json::read(text), theirs(text)) {
            (Ok(a), Some(b)) => assert!(same(&a, &b), "{shown}: {a:?} {b:?}"),
            (Err(_), None) => {}
            (a, b) => panic!("{shown}: {a:?} {b:?}"),
        }
    }

    const SAMPLE: &str = r#" {"a": [1, -2.5e-3, 0.1, true, false, null, {}, []],
        "text": "q\"\\\/\b\f\n\r\t\u00e9\ud83d\ude00é😀", "b" : {"a": {"a": "a"}}, "a": 7} "#;

    #[test]
    fn reads_what_others_read() {
        for text in [
            "0",
            "-0",
            "01",
            "1.",
            ".5",
            "-",
            "1e5",
            "1E+5",
            "1e",
            "1e+",
            "1e400",
            "-1e-400",
            "18446744073709551615",
            "18446744073709551616",
            "+1",
            "NaN",
            "tru",
            "true1",
            "nul",
            "\"",
            "\"\\u12\"",
            "\"\\ud800\"",
            "\"\\ud800\\u0041\"",
            "\"\\udc00\"",
            "\"\\x\"",
            "\"a\nb\"",
            "\"\u{7f}\"",
            "[",
            "[1,]",
            "[,1]",
            "[1 2]",
            "{\"a\":1,}",
            "{a:1}",
            "{\"a\" 1}",
            "{\"a\"}",
            "{1:1}",
            "",
            " ",
            "1 1",
            "[]]",
            "\u{feff}1",
            "'a'",
        ] {
            agree(text.as_bytes());
        }
        agree(SAMPLE.as_bytes());
        agree(b"\"\xff\"");
        agree(b"[1]\xc3");
    }

    #[test]
    fn damaged_texts_are_refused_or_read_as_others_do() {
        let whole = SAMPLE.as_bytes();
        for cut in 0..whole.len() {
            agree(&whole[..cut]);
            for byte in b"\"\\{}[]:,0-e.tn \n\x01\xff" {
                let mut damaged = whole.to_vec();
                damaged[cut] = *byte;
                agree(&damaged);
                damaged.insert(cut, *byte);
                agree(&damaged);
                damaged.remove(cut);
                damaged.remove(cut);
                agree(&damaged);
            }
        }
    }

    #[test]
    fn depth_ends_before_the_stack_does() {
        for open in ["[", "{\"a\":"] {
            let close = if open == "[" { "]" } else { "}" };
            let nested = |depth| [open.repeat(depth), "1".to_owned(), close.repeat(depth)].concat();
            agree(nested(MOST_DEPTH).as_bytes());
            assert!(Json::read(nested(MOST_DEPTH).as_bytes()).is_ok());
            agree(nested(MOST_DEPTH + 1).as_bytes());
            assert!(Json::read(open.repeat(1_000_000).as_bytes()).is_err());
        }
    }

    #[test]
    fn a_fault_names_its_place() {
        let fault = |text: &str| Json::read(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(
            fault("{\n  \"a\": [1,\n   x]}"),
            "expected a value at line 3 column 4"
        );
        assert_eq!(fault("[1"), "expected `,` or `]` at line 1 column 3");
        assert_eq!(
            Json::read(b"{\n\"\xff\"}").unwrap_err().to_string(),
            "not UTF-8 at line 2 column 2"
        );
        let json = Json::read(b"{\n  \"a\": 1}").unwrap();
        assert_eq!(
            json["a"].fault("no text".to_owned()).to_string(),
            "no text at line 2 column 8"
        );
    }

    #[test]
    fn members_that_are_not_there_are_null_and_types_are_told_apart() {
        let json = Json::read(SAMPLE.as_bytes()).unwrap();
        assert!(json["nothing"]["at all"].is_null());
        assert_eq!(json["a"].whole(), Some(7));
        assert_eq!(json["a"].text(), None);
        assert!(json["a"].items().is_empty() && json["a"].members().is_empty());
        let numbers = Json::read(b"[3, 3.5, -1, 9007199254740992, 1e300]").unwrap();
        let wholes: Vec<_> = numbers.items().iter().map(Json::whole).collect();
        assert_eq!(wholes, [Some(3), None, None, Some(1 << 53), None]);
    }

    #[test]
    fn numbers_are_those_nearest_to_what_is_written() {
        let mut state = 1_u64;
        for _ in 0..20_000 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let number = (state as f64 / 2f64.powi(63) - 1.0) * 1e3;
            let text = number.to_string();
            assert_eq!(Json::read(text.as_bytes()).unwrap().number(), Some(number));
        }
    }
}

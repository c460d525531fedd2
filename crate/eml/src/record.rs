//! Shared code to read, write and generate every clause: a record names its attributes and children
//! once, and a visitor traverses them.

use crate::{Name, Span};

/// Value of an attribute, parsed by its kind in the schema table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// Absent value.
    None,
    Text(Name),
    Number(f64),
    Flag(bool),
    /// Word from the attribute's choices in the table.
    Word(&'static str),
    /// A change in percent.
    Percent(f64),
    Numbers(Vec<f64>),
    Color([u8; 3]),
}

/// Field of a record that stores the value of one attribute.
pub(crate) trait Field {
    /// Sets a value of the kind declared in the table.
    fn set(&mut self, value: Value);
    /// Returns the value.
    fn get(&self) -> Value;
}

/// EML element with attributes and children that is read, written and generated generically by a
/// visitor.
pub(crate) trait Record {
    /// Returns the name of the EML element.
    fn element(&self) -> &'static str;
    /// Shows every field and every list of children to the visitor.
    fn visit(&mut self, visitor: &mut dyn Visit);
    /// Stores the span of its start tag, for fields that keep it.
    fn place(&mut self, _span: Span) {}
}

/// Visitor that processes the attributes and children of a record.
pub(crate) trait Visit {
    /// Visits an attribute by its name in the schema table.
    fn field(&mut self, name: &'static str, field: &mut dyn Field);
    /// Visits the list of child elements, in order.
    fn children(&mut self, list: &mut dyn List);
}

/// List of child records that a visitor can extend or read.
pub(crate) trait List {
    /// Adds an empty child with this element's name; `None` if the list has no such child.
    fn add(&mut self, element: &str) -> Option<&mut dyn Record>;
    /// Removes the last child.
    fn remove_last(&mut self);
    /// Returns the child at an index.
    fn item_mut(&mut self, index: usize) -> Option<&mut dyn Record>;
}

/// Record that can be created as a child of another record by its element name.
pub(crate) trait Child: Record + Sized {
    /// Returns an empty child, if `element` is such a child.
    fn blank(element: &str) -> Option<Self>;
}

impl<C: Child> List for Vec<C> {
    fn add(&mut self, element: &str) -> Option<&mut dyn Record> {
        self.push(C::blank(element)?);
        self.last_mut().map(|child| child as &mut dyn Record)
    }

    fn remove_last(&mut self) {
        self.pop();
    }

    fn item_mut(&mut self, index: usize) -> Option<&mut dyn Record> {
        self.get_mut(index).map(|child| child as &mut dyn Record)
    }
}

impl<C: Child> List for Option<C> {
    fn add(&mut self, element: &str) -> Option<&mut dyn Record> {
        *self = Some(C::blank(element)?);
        self.as_mut().map(|child| child as &mut dyn Record)
    }

    fn remove_last(&mut self) {
        *self = None;
    }

    fn item_mut(&mut self, index: usize) -> Option<&mut dyn Record> {
        let child = self.as_mut().filter(|_| index == 0);
        child.map(|child| child as &mut dyn Record)
    }
}

/// A field of one Rust type and one kind of value.
macro_rules! field {
    ($type:ty, $kind:ident, $value:ident => $taken:expr, $shown:expr) => {
        impl Field for $type {
            fn set(&mut self, value: Value) {
                if let Value::$kind($value) = value {
                    *self = $taken;
                }
            }

            fn get(&self) -> Value {
                let shown: fn(&Self) -> _ = $shown;
                Value::$kind(shown(self))
            }
        }
    };
}

field!(String, Text, text => text.into(), |text| text.into());
field!(f64, Number, number => number, |n| *n);
field!(u32, Number, number => number as u32, |n| f64::from(*n));
field!(i32, Number, number => number as i32, |n| f64::from(*n));
field!(bool, Flag, flag => flag, |flag| *flag);
field!(Vec<f64>, Numbers, numbers => numbers, Self::clone);
field!([u8; 3], Color, color => color, |color| *color);

impl<F: Field + Default> Field for Option<F> {
    fn set(&mut self, value: Value) {
        *self = match value {
            Value::None => None,
            value => {
                let mut field = F::default();
                field.set(value);
                Some(field)
            }
        };
    }

    fn get(&self) -> Value {
        self.as_ref().map_or(Value::None, Field::get)
    }
}

/// Returns the index of a word; 0 if it is not in the list.
pub(crate) fn place_of(words: &[&str], word: &str) -> usize {
    words.iter().position(|w| *w == word).unwrap_or(0)
}

/// An enumeration whose values EML writes as words; the first is the default.
macro_rules! words {
    (
        $(#[$meta:meta])* $name:ident {
            $(#[$first_doc:meta])* $first:ident = $first_word:literal,
            $($(#[$doc:meta])* $variant:ident = $word:literal,)*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum $name {
            $(#[$first_doc])* #[default] $first,
            $($(#[$doc])* $variant,)*
        }

        impl $name {
            /// Words of all values, in the order of the variants.
            pub const WORDS: &'static [&'static str] = &[$first_word, $($word),*];
            const ALL: &'static [Self] = &[Self::$first, $(Self::$variant),*];

            /// Returns the EML word of the value.
            #[must_use]
            pub fn word(self) -> &'static str {
                Self::WORDS[self as usize]
            }
        }

        impl $crate::record::Field for $name {
            fn set(&mut self, value: $crate::record::Value) {
                if let $crate::record::Value::Word(word) = value {
                    *self = Self::ALL[$crate::record::place_of(Self::WORDS, word)];
                }
            }

            fn get(&self) -> $crate::record::Value {
                $crate::record::Value::Word(self.word())
            }
        }
    };
}
pub(crate) use words;

/// A structure whose fields are the attributes and children of one element.
macro_rules! record {
    (
        $(#[$meta:meta])* $name:ident = $element:literal {
            $($(#[$doc:meta])* $field:ident: $type:ty = $attribute:literal,)*
        }
        $(children { $(#[$list_doc:meta])* $list:ident: $list_type:ty })?
        $(placed { $(#[$place_doc:meta])* $place:ident })?
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $name {
            $($(#[$doc])* pub $field: $type,)*
            $($(#[$list_doc])* pub $list: $list_type,)?
            $($(#[$place_doc])* pub $place: $crate::Span,)?
        }

        impl $crate::record::Record for $name {
            fn element(&self) -> &'static str {
                $element
            }

            fn visit(&mut self, visitor: &mut dyn $crate::record::Visit) {
                $(visitor.field($attribute, &mut self.$field);)*
                $(visitor.children(&mut self.$list);)?
                let _ = visitor;
            }

            $(fn place(&mut self, span: $crate::Span) {
                self.$place = span;
            })?
        }

        impl $crate::record::Child for $name {
            fn blank(element: &str) -> Option<Self> {
                (element == $element).then(Self::default)
            }
        }
    };
}
pub(crate) use record;

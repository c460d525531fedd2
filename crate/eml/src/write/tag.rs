//! Writer of tags.

use crate::namespaces::EXTENSIONS_PREFIX;
use crate::record::{Field, List, Record, Value, Visit};
use crate::schema::{self, Element, Presence};
use crate::{Coords, GestureKey, Handedness, Key, Profile, Track};
use quick_xml::escape::partial_escape;
use raconteur_base::Side;

/// EML element with its attributes as text, ready to be written.
pub(super) struct Tag {
    element: &'static Element,
    /// Start time, written before the other attributes.
    timed: String,
    attributes: String,
    extended: bool,
    pub(super) children: Vec<Tag>,
}

impl Tag {
    /// Creates a tag without attributes and children.
    pub(super) fn new(element: &'static str) -> Self {
        Self::inside(element, "")
    }

    /// Creates an empty tag of the element allowed in `parent`.
    fn inside(element: &'static str, parent: &str) -> Self {
        let element = schema::recorded(element).unwrap_or(schema::ELEMENTS[0]);
        Self {
            element: schema::variant_in(element, parent).unwrap_or(element),
            timed: String::new(),
            attributes: String::new(),
            extended: element.extension,
            children: Vec::new(),
        }
    }

    /// Creates the tag of a record with its attributes and children.
    pub(super) fn from_record(record: &mut dyn Record) -> Self {
        let mut tag = Self::new(record.element());
        record.visit(&mut tag);
        tag
    }

    /// Returns the element name, with the prefix of extensions.
    pub(super) fn name(&self) -> String {
        if self.element.extension {
            format!("{EXTENSIONS_PREFIX}:{}", self.element.name)
        } else {
            self.element.name.to_owned()
        }
    }

    /// Returns the attributes as text, each preceded by a space.
    pub(super) fn attributes(&self) -> String {
        format!("{}{}", self.timed, self.attributes)
    }

    /// Returns true if it is an extension or has an extension attribute.
    pub(super) fn is_extended(&self) -> bool {
        self.extended
    }

    /// Adds when a clause starts.
    pub(super) fn time(&mut self, time: &str, name: Option<&str>) {
        self.timed = format!(" time='{time}'");
        if let Some(name) = name {
            self.timed.push_str(&format!(" timeId='{}'", escaped(name)));
        }
    }

    pub(super) fn text(&mut self, name: &str, text: Option<&str>) {
        self.value(
            name,
            text.map_or(Value::None, |text| Value::Text(text.into())),
        );
    }

    pub(super) fn number(&mut self, name: &str, number: Option<f64>) {
        self.value(name, number.map_or(Value::None, Value::Number));
    }

    pub(super) fn word(&mut self, name: &str, word: Option<&'static str>) {
        self.value(name, word.map_or(Value::None, Value::Word));
    }

    pub(super) fn flag(&mut self, name: &str, flag: bool) {
        self.value(name, Value::Flag(flag));
    }

    /// Adds an attribute, unless its value is the default.
    fn value(&mut self, name: &str, value: Value) {
        let Some(attribute) = self.element.all_attributes().find(|a| a.name == name) else {
            return;
        };
        if let Presence::Default(text) = attribute.default
            && schema::parse_value(attribute.kind, text).is_ok_and(|default| default == value)
        {
            return;
        }
        let text = match value {
            Value::None => return,
            Value::Text(text) => escaped(&text),
            Value::Number(value) => number(value),
            Value::Flag(flag) => flag.to_string(),
            Value::Word(word) => word.to_owned(),
            Value::Percent(percent) if percent < 0.0 => format!("{}%", number(percent)),
            Value::Percent(percent) => format!("+{}%", number(percent)),
            Value::Numbers(numbers) => {
                let words: Vec<String> = numbers.into_iter().map(number).collect();
                words.join(" ")
            }
            Value::Color([red, green, blue]) => format!("#{red:02x}{green:02x}{blue:02x}"),
        };
        let prefix = if attribute.extension {
            self.extended = true;
            format!("{EXTENSIONS_PREFIX}:")
        } else {
            String::new()
        };
        self.attributes
            .push_str(&format!(" {prefix}{name}='{text}'"));
    }

    /// Adds the content of a gesture-key. All key times are written explicitly, so none is spread.
    pub(super) fn gesture(&mut self, gesture: &GestureKey) {
        self.number("duration", Some(gesture.duration_secs));
        let words = Handedness::WORDS.iter();
        let mut word = words.filter(|(handedness, _)| *handedness == gesture.handedness);
        self.word("handedness", word.next().map(|(_, word)| *word));
        self.word("phase", gesture.phase.map(crate::Phase::word));
        self.profile(gesture.pace.as_deref());
        for track in &gesture.hand_shapes {
            self.track("hand-shapes", track, |tag, key| {
                tag.number("id", Some(f64::from(key.id)));
                if let Some((id, weight)) = key.blend {
                    tag.number("id2", Some(f64::from(id)));
                    tag.number("weight", Some(weight));
                }
            });
        }
        for track in &gesture.palms {
            self.track("palms", track, |tag, key| {
                tag.number("a", Some(key.angle_deg));
                tag.vector(key.axis);
            });
        }
        for track in &gesture.motions {
            self.track("motion", track, |tag, key| tag.vector(key.position));
            let world = track
                .keys
                .first()
                .is_some_and(|k| k.value.coords == Coords::World);
            if let Some(tag) = self.children.last_mut() {
                tag.word("coords", Some(if world { "world" } else { "speaker" }));
            }
        }
    }

    fn vector(&mut self, [x, y, z]: [f64; 3]) {
        self.number("x", Some(x));
        self.number("y", Some(y));
        self.number("z", Some(z));
    }

    fn track<K>(&mut self, name: &'static str, track: &Track<K>, add: impl Fn(&mut Tag, &K)) {
        let mut tag = Tag::new(name);
        tag.word(
            "hand",
            track.hand.map(|hand| match hand {
                Side::Left => "left",
                Side::Right => "right",
            }),
        );
        tag.profile(track.profile.as_deref());
        for Key {
            offset_secs,
            value,
            profile,
            ..
        } in &track.keys
        {
            let mut key = Tag::inside("key", name);
            key.number("time", Some(*offset_secs));
            add(&mut key, value);
            key.profile(profile.as_deref());
            tag.extended |= key.extended;
            tag.children.push(key);
        }
        self.extended |= tag.extended;
        self.children.push(tag);
    }

    fn profile(&mut self, profile: Option<&Profile>) {
        if let Some(profile) = profile {
            profile.clone().visit(self);
        }
    }
}

impl Visit for Tag {
    fn field(&mut self, name: &'static str, field: &mut dyn Field) {
        self.value(name, field.get());
    }

    fn children(&mut self, list: &mut dyn List) {
        let mut index = 0;
        while let Some(child) = list.item_mut(index) {
            let tag = Tag::from_record(child);
            self.extended |= tag.extended;
            self.children.push(tag);
            index += 1;
        }
    }
}

/// Returns the shortest decimal that parses to this number.
pub(super) fn number(number: f64) -> String {
    // Without the sign of a negative zero.
    format!("{}", number + 0.0)
}

/// Escapes text between tags or apostrophes. Every XML reader preserves line ends in it.
pub(super) fn escaped(text: &str) -> String {
    // Values are in apostrophes, so that quotes need no reference; `escape` would replace them.
    partial_escape(text).replace('\'', "&apos;")
}

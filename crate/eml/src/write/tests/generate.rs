//! Documents generated from the table, for the test that writing is lossless.

use crate::clauses::speech::Markup;
use crate::record::{Child as _, Field, List, Record, Value, Visit};
use crate::schema::{self, Attribute, ELEMENTS, Element, Kind, Presence, Role, parse_value};
use crate::{
    Clause, ClauseId, ClauseKind, Coords, DivKind, Document, Environment, GestureKey, Group,
    Handedness, Key, MarkEvent, MotionKey, Name, NameTerm, PalmKey, Performer, Phase, Profile, Set,
    ShapeKey, Span, TextSegment, TimeExpr, Track, VoiceText,
};
use raconteur_base::Side;

/// Returns a random document of about the given number of clauses. The same seed gives the same
/// document.
pub(super) fn document(seed: u64, clauses: usize) -> Document {
    let mut dice = SeededRandom(seed);
    let mut document = Document {
        name: dice.one_in(2).then(|| dice.text()),
        ..Document::default()
    };
    if dice.one_in(2) {
        let mut performer = Performer::default();
        dice.fill(&mut performer);
        document.performer = Some(performer);
    }
    if dice.one_in(2) {
        let mut environment = Environment::default();
        dice.fill(&mut environment);
        document.environment = Some(environment);
    }
    for _ in 0..dice.below(3) {
        let mut set = Set::default();
        dice.fill(&mut set);
        document.sets.push(set);
    }
    for _ in 0..clauses {
        let id = dice.clause(&mut document, None, 0);
        document.roots.push(id);
    }
    document
}

/// A source of choices: Sebastiano Vigna's splitmix64.
struct SeededRandom(u64);

impl SeededRandom {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len())]
    }

    /// Some text, not empty.
    fn text(&mut self) -> String {
        let parts = [
            "a", "Word", "&", "<b>", "'", "\"", "é", "😀", " ", "\n", "]]>", "\r", "1", "-",
        ];
        (0..=self.below(6)).map(|_| self.pick(&parts)).collect()
    }

    fn identifier(&mut self) -> String {
        let parts = ["a", "B", "left_arm", "&", "'", "é", "_", "7", "x y"];
        (0..=self.below(3)).map(|_| self.pick(&parts)).collect()
    }

    fn name(&mut self) -> String {
        self.pick(&["t1", "t_2", "é.x", "end"]).to_owned()
    }

    fn number(&mut self, least: f64, most: f64) -> f64 {
        let spread = (most - least).min(2000.0);
        let from = least.max(-1000.0);
        let number = match self.below(3) {
            0 => from + self.below(spread as usize + 1) as f64,
            1 => from + spread * (self.below(1001) as f64 / 1000.0),
            _ => from + spread * (self.next() >> 11) as f64 / (1_u64 << 53) as f64,
        };
        number.clamp(least, most)
    }

    fn value(&mut self, kind: Kind) -> Value {
        match kind {
            Kind::Text => Value::Text(self.text().into()),
            Kind::Name => Value::Text(self.name().into()),
            Kind::Identifier => Value::Text(self.identifier().into()),
            Kind::Path => Value::Text(self.pick(&["a/b.xml", "x y&z", "é.ogg"]).into()),
            Kind::Url => Value::Text(self.pick(&["a.ogg?x=1&y", "https://x.org/'"]).into()),
            Kind::Bool => Value::Flag(self.one_in(2)),
            Kind::Number { least, most } => Value::Number(self.number(least, most)),
            Kind::Integer { least, most } => {
                let (least, most) = (least.max(-500) as f64, most.min(500) as f64);
                Value::Number(self.number(least, most).floor())
            }
            Kind::Seconds { most } => Value::Number(self.number(0.0, most.min(100.0))),
            Kind::Time | Kind::KeyTime => Value::None,
            Kind::Choice(words) => Value::Word(self.pick(words)),
            Kind::Level {
                words,
                numbers: [least, most],
                percent,
            } => match (self.below(3), percent) {
                (0, Some([least, most])) => Value::Percent(self.number(least, most)),
                (1, _) => Value::Number(self.number(least, most)),
                _ => Value::Word(self.pick(words)),
            },
            // A switch is a valid value of such a number.
            Kind::NumberOrBool => Value::Number(self.below(2) as f64),
            Kind::NumberOrText if self.one_in(2) => Value::Text("left&'".into()),
            Kind::NumberOrText => Value::Number(self.number(-100.0, 100.0)),
            Kind::Numbers => Value::Numbers((0..4).map(|_| self.number(-2.0, 2.0)).collect()),
            Kind::Color => Value::Color([self.next() as u8, self.next() as u8, 7]),
        }
    }

    fn fill(&mut self, record: &mut dyn Record) {
        let name = record.element();
        let element =
            schema::recorded(name).unwrap_or_else(|| panic!("{name} is not in the table"));
        record.visit(&mut Filler {
            dice: self,
            element,
        });
    }

    fn time(&mut self) -> TimeExpr {
        let names = (0..self.below(3)).map(|_| NameTerm {
            name: self.name().into(),
            negative: self.one_in(2),
            span: Span::default(),
        });
        TimeExpr {
            names: names.collect(),
            offset_secs: if self.one_in(2) {
                self.number(-100.0, 100.0)
            } else {
                0.0
            },
            span: Span::default(),
        }
    }

    fn clause(
        &mut self,
        document: &mut Document,
        parent: Option<ClauseId>,
        depth: u32,
    ) -> ClauseId {
        let inside = parent.map_or("body", |id| document.clause(id).kind.name());
        let may = |e: &&Element| e.is_clause() && e.parents.contains(&inside);
        let elements: Vec<&Element> = ELEMENTS.iter().copied().filter(may).collect();
        let element = self.pick(&elements);
        let id = ClauseId(u32::try_from(document.clauses.len()).unwrap());
        let kind = match element.role {
            Role::Record(blank) | Role::Scene(blank) => {
                let mut kind = blank();
                self.fill(kind.record().unwrap());
                kind
            }
            Role::Group(wrap) => wrap(Group {
                children: Vec::new(),
                repetition_count: 1 + self.below(3) as u32,
                repetition_span: Span::default(),
                iteration_secs: self.one_in(2).then(|| self.number(0.0, 10.0)),
            }),
            _ => match element.name {
                "voice-text" => ClauseKind::VoiceText(self.voice()),
                "voice-say" => self.say(),
                "gesture-is-on" => ClauseKind::GestureIsOn(self.one_in(2)),
                "gesture-key" => ClauseKind::GestureKey(self.gesture()),
                "event" => ClauseKind::Event {
                    kind: self.one_in(2).then(|| self.text().into()),
                    payload: if self.one_in(3) {
                        Name::default()
                    } else {
                        self.text().into()
                    },
                },
                "body-player-clear" => ClauseKind::PlayerClear,
                _ => ClauseKind::Null,
            },
        };
        document.clauses.push(Clause {
            span: Span::default(),
            tag_span: Span::default(),
            start: self.time(),
            time_id: self.one_in(3).then(|| self.name().into()),
            parent,
            kind,
        });
        if let Role::Group(_) | Role::Scene(_) = element.role
            && depth < 4
        {
            for _ in 0..self.below(4) {
                let child = self.clause(document, Some(id), depth + 1);
                let kind = &mut document.clauses[id.index()].kind;
                kind.group_mut().unwrap().children.push(child);
            }
        }
        id
    }

    fn say(&mut self) -> ClauseKind {
        let mut say = crate::VoiceSay::default();
        self.fill(&mut say);
        say.content = if say.is_file() {
            "poetry/a.txt".to_owned()
        } else {
            self.text()
        };
        ClauseKind::VoiceSay(Box::new(say))
    }

    fn gesture(&mut self) -> GestureKey {
        let handedness = self.pick(&Handedness::WORDS).0;
        let mut phase: Option<Phase> = None;
        if self.one_in(2) {
            phase.set(self.value(Kind::Choice(Phase::WORDS)));
        }
        let coords = self.pick(&[Coords::Speaker, Coords::World]);
        let mut sides = || match handedness {
            Handedness::Left => vec![Some(Side::Left)],
            Handedness::Right => vec![None],
            Handedness::Both if self.one_in(2) => vec![Some(Side::Right), Some(Side::Left)],
            Handedness::Both | Handedness::Dominant | Handedness::NonDominant => vec![None],
        };
        let (shapes, palms, motions) = (sides(), sides(), sides());
        GestureKey {
            duration_secs: self.number(0.0, 10.0),
            handedness,
            phase,
            pace: self.profile(false),
            hand_shapes: self.tracks(&shapes, false, |dice| ShapeKey {
                id: dice.below(61) as u8,
                blend: dice
                    .one_in(2)
                    .then(|| (dice.below(61) as u8, dice.number(0.0, 1.0))),
            }),
            palms: self.tracks(&palms, true, |dice| PalmKey {
                angle_deg: dice.number(-360.0, 360.0),
                axis: [1.0, dice.number(-1.0, 1.0), dice.number(-1.0, 1.0)],
            }),
            motions: self.tracks(&motions, true, |dice| MotionKey {
                position: [dice.number(-50.0, 50.0), dice.number(0.0, 80.0), -5.0],
                coords,
            }),
        }
    }

    fn tracks<K>(
        &mut self,
        sides: &[Option<Side>],
        has_space: bool,
        value: impl Fn(&mut Self) -> K,
    ) -> Box<[Track<K>]> {
        let mut tracks = Vec::new();
        for &hand in sides {
            let mut offset_secs = 0.0;
            let keys = (0..=self.below(3)).map(|_| {
                offset_secs += self.number(0.0, 2.0);
                Key {
                    offset_secs,
                    value: value(self),
                    profile: self.profile(false),
                    span: Span::default(),
                }
            });
            let keys = keys.collect();
            tracks.push(Track {
                hand,
                keys,
                profile: self.profile(has_space),
                span: Span::default(),
            });
        }
        tracks.into()
    }

    fn profile(&mut self, has_space: bool) -> Option<Box<Profile>> {
        let mut profile = Profile::default();
        if self.one_in(3) {
            profile
                .interpolator
                .set(self.value(Kind::Choice(crate::Interpolator::WORDS)));
            let count = profile
                .interpolator
                .map_or(0, crate::Interpolator::controls);
            if count > 0 {
                profile.controls = Some((0..count).map(|_| self.number(-2.0, 2.0)).collect());
            }
        }
        if has_space && self.one_in(3) {
            profile
                .space
                .set(self.value(Kind::Choice(crate::Space::WORDS)));
        }
        (profile != Profile::default()).then(|| Box::new(profile))
    }

    /// Returns any element that contains spoken text.
    fn container(&mut self) -> Markup {
        let containers: Vec<fn() -> Markup> = ELEMENTS
            .iter()
            .filter_map(|e| match e.role {
                Role::Container(blank) => Some(blank),
                _ => None,
            })
            .collect();
        let mut markup = self.pick(&containers)();
        self.fill(markup.record());
        markup
    }

    fn voice(&mut self) -> VoiceText {
        let mut pieces = Vec::new();
        let mut open: Vec<(bool, f64)> = Vec::new();
        let mut emphasis = crate::voice::NO_EMPHASIS;
        let span = Span::default();
        for _ in 0..self.below(12) {
            match self.below(8) {
                0 => pieces.push(TextSegment::Break {
                    msec: self.pick(&[0, 150, 350, 800, 1234]),
                    boundary: None,
                    span,
                }),
                1 => {
                    let mut audio = crate::Audio::blank("audio").unwrap();
                    self.fill(&mut audio);
                    let audio = Box::new(audio);
                    pieces.push(TextSegment::Audio { audio, span });
                }
                2 => pieces.push(TextSegment::Marker {
                    mark: self.identifier(),
                    span,
                }),
                3 => {
                    let name = self.name().into();
                    let event = match self.below(3) {
                        0 => MarkEvent::OnStart,
                        1 => MarkEvent::OnEnd,
                        _ => MarkEvent::OnPhone(Box::new("hh".into())),
                    };
                    pieces.push(TextSegment::Mark { name, event, span });
                }
                4 => {
                    let kind =
                        self.pick(&[None, Some(DivKind::Sentence), Some(DivKind::Paragraph)]);
                    pieces.push(TextSegment::DivStart { kind, span });
                    open.push((true, emphasis));
                }
                5 => {
                    let markup = self.container();
                    open.push((false, emphasis));
                    if let Markup::Emph(emph) = &markup {
                        emphasis = schema::emphasis(emph.level);
                    }
                    let markup = Box::new(markup);
                    pieces.push(TextSegment::Start { markup, span });
                }
                6 => {
                    if let Some((division, outside)) = open.pop() {
                        emphasis = outside;
                        pieces.push(if division {
                            TextSegment::DivEnd
                        } else {
                            TextSegment::End
                        });
                    }
                }
                _ => {
                    let text = self.text().into();
                    pieces.push(TextSegment::Text {
                        text,
                        emphasis,
                        span,
                    });
                }
            }
        }
        while let Some((division, _)) = open.pop() {
            pieces.push(if division {
                TextSegment::DivEnd
            } else {
                TextSegment::End
            });
        }
        VoiceText { pieces }
    }
}

/// Fills a record with values that its entry in the table allows.
struct Filler<'g> {
    dice: &'g mut SeededRandom,
    element: &'static Element,
}

impl Filler<'_> {
    fn needs(&self, attribute: &Attribute) -> bool {
        attribute.default == Presence::Required || self.element.one_of.contains(&attribute.name)
    }
}

impl Visit for Filler<'_> {
    fn field(&mut self, name: &'static str, field: &mut dyn Field) {
        let attribute = self.element.all_attributes().find(|a| a.name == name);
        let attribute = attribute.unwrap_or_else(|| panic!("{} {name}", self.element.name));
        let value = if self.needs(attribute) || self.dice.one_in(2) {
            self.dice.value(attribute.kind)
        } else if let Presence::Default(text) = attribute.default {
            parse_value(attribute.kind, text).unwrap()
        } else {
            return;
        };
        field.set(value);
    }

    fn children(&mut self, list: &mut dyn List) {
        let parent = self.element;
        let mut have = 0;
        for element in ELEMENTS.iter().filter(|e| e.parents.contains(&parent.name)) {
            let required = parent.required_children.contains(&element.name);
            let most = element.max_per_parent.map_or(3, |n| n as usize);
            let count = self.dice.below(most + 1).max(usize::from(required));
            for _ in 0..count {
                let Some(child) = list.add(element.name) else {
                    break;
                };
                self.dice.fill(child);
                have += 1;
            }
        }
        assert!(have < 100, "the generator adds fewer than 100 children");
    }
}

//! Round trip of random contents through both formats: the words, their styles and everything
//! between them are unchanged.

use super::{sable, ssml};
use crate::content::{Age, Boundary, Content, Division, Gender, Markup, Segment, Setting, Speaker};
use crate::resolve::{Item, resolve};
use crate::style::Style;
use crate::text::{Order, SayAs};

/// A generator of Marsaglia's (xorshift, 2003): the cases are the same everywhere.
struct CaseGenerator(u64);

impl CaseGenerator {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n as u64) as usize
    }

    fn one<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())].clone()
    }

    fn maybe<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        (self.below(2) == 0).then(|| make(self))
    }

    fn unit(&mut self) -> f64 {
        self.below(1 << 30) as f64 / f64::from(1 << 30)
    }

    fn text(&mut self) -> String {
        const WORDS: [&str; 14] = [
            "rain",
            "<&>\"'",
            "]]>",
            "\u{e9}t\u{e9}",
            "b\r\nc",
            "\t",
            " ",
            "\n\n",
            "so, ",
            "it's ",
            ":-) ",
            "\u{65e5}\u{672c}",
            "- ",
            "42 ",
        ];
        (0..=self.below(4)).map(|_| self.one(&WORDS)).collect()
    }

    /// Returns a random name that is neither empty nor only white space.
    fn name(&mut self) -> String {
        self.one(&[
            "de",
            "pt-BR",
            "German",
            "kal",
            "a b",
            "<\"&'>",
            "x\ty\nz",
            "l\u{e6}vz",
        ])
        .to_owned()
    }

    fn setting(&mut self, own: f64) -> Setting {
        match self.below(8) {
            0 => Setting::Default,
            1 => Setting::Value((own * (0.5 + self.unit())).round()),
            2 => Setting::Value(own * (0.5 + self.unit())),
            3 => Setting::Factor(self.one(&[0.8, 0.9, 1.0, 1.1, 1.2, 1.5, 0.6, 2.0])),
            4 => Setting::Factor(self.one(&[0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e300])),
            5 => Setting::Value(self.one(&[0.0, -1.0, f64::NAN, f64::INFINITY, 5e-324, 1e300])),
            _ => Setting::Factor(0.2 + 4.0 * self.unit()),
        }
    }

    fn say_as(&mut self) -> SayAs {
        let order = self.one(&[
            Order::Dmy,
            Order::Mdy,
            Order::Ymd,
            Order::Ym,
            Order::My,
            Order::Md,
        ]);
        let email = self.below(2) == 0;
        self.one(&[
            SayAs::Literal,
            SayAs::Date(None),
            SayAs::Date(Some(order)),
            SayAs::Time,
            SayAs::Phone,
            SayAs::Net { email },
            SayAs::Postal,
            SayAs::Currency,
            SayAs::Math,
            SayAs::Fraction,
            SayAs::Measure,
            SayAs::Ordinal,
            SayAs::Cardinal,
            SayAs::Name,
        ])
    }

    fn markup(&mut self) -> Markup {
        match self.below(11) {
            0 => Markup::Emphasis(self.one(&[0.0, 0.5, 1.0, 2.0, 1.37, 9.0, f64::NAN])),
            1 => Markup::Pitch {
                base: self.maybe(|c| c.setting(100.0)),
                middle: self.maybe(|c| c.setting(150.0)),
                range: self.maybe(|c| c.setting(80.0)),
            },
            2 => Markup::Rate(self.setting(180.0)),
            3 => Markup::Volume(self.setting(1.0)),
            4 => {
                let (ipa, sub) = (self.maybe(Self::name), self.maybe(Self::name));
                let is_empty = ipa.is_none() && sub.is_none();
                let origin = (is_empty || self.below(2) == 0).then(|| self.name());
                Markup::Pronunciation { ipa, sub, origin }
            }
            5 => Markup::SayAs(self.say_as()),
            6 => Markup::Language(self.name()),
            7 => Markup::Speaker(Speaker {
                gender: self.maybe(|c| c.one(&[Gender::Male, Gender::Female])),
                age: self.maybe(|c| {
                    c.one(&[Age::Older, Age::Middle, Age::Younger, Age::Teen, Age::Child])
                }),
                name: self.maybe(Self::name),
            }),
            8 => Markup::Engine {
                id: self.one(&["festival", "flite"]).to_owned(),
                data: self.one(&["", "other words", "<&>"]).to_owned(),
            },
            9 => Markup::Emotion {
                name: self.one(&["joy", "", "blue"]).to_owned(),
                activation: 250.0 * (self.unit() - 0.5),
                evaluation: 200.0 * (self.unit() - 0.5),
                power: 33.0,
            },
            _ => Markup::Other,
        }
    }

    fn segment(&mut self) -> Segment {
        match self.below(16) {
            0 => Segment::Break {
                msec: self.below(5000) as u32,
                boundary: self.maybe(|c| {
                    c.one(&[
                        Boundary::Question,
                        Boundary::Exclamation,
                        Boundary::Statement,
                        Boundary::Comma,
                    ])
                }),
            },
            1 | 2 => Segment::Division(self.one(&[Division::Sentence, Division::Paragraph])),
            3 => Segment::Audio {
                src: self.name(),
                background: self.below(2) == 0,
                level: self.one(&[0.0, 1.0, 0.5, 0.7, 1.9]),
            },
            4 => Segment::Mark(self.name()),
            5..=8 => Segment::Open(self.markup()),
            9 | 10 => Segment::Close,
            _ => Segment::Text(self.text()),
        }
    }

    fn content(&mut self) -> Content {
        let count = self.below(40);
        Content {
            segments: (0..count).map(|_| self.segment()).collect(),
        }
    }
}

/// Returns the spoken items, each with its style. Consecutive divisions count as one, which
/// separates paragraphs if any of them does.
fn heard(content: &Content) -> Vec<(Item, Option<Style>, Option<usize>)> {
    let resolved = resolve(content, "festival");
    let mut heard: Vec<(Item, Option<Style>, Option<usize>)> = Vec::new();
    // Only the grouping of words counts, not the group numbers.
    let mut groups: Vec<usize> = Vec::new();
    for item in resolved.items {
        match (item, heard.last_mut()) {
            (Item::Division(d), Some((Item::Division(before), _, _))) => {
                if d == Division::Paragraph {
                    *before = d;
                }
            }
            (
                Item::Word {
                    text,
                    style,
                    together,
                    behind,
                },
                _,
            ) => {
                let group = together.map(|t| {
                    let known = groups.iter().position(|g| *g == t);
                    known.unwrap_or_else(|| {
                        groups.push(t);
                        groups.len() - 1
                    })
                });
                let word = Item::Word {
                    text,
                    style: 0,
                    together: None,
                    behind,
                };
                heard.push((word, resolved.styles.get(style).cloned(), group));
            }
            (item, _) => heard.push((item, None, None)),
        }
    }
    heard
}

#[test]
fn sable_says_what_a_content_says() {
    let mut chance = CaseGenerator(0x5ab1e);
    for case in 0..4000 {
        let content = chance.content();
        let text = sable::write(&content);
        let (back, problems) = sable::read(&text).unwrap_or_else(|p| panic!("{case}: {p}\n{text}"));
        assert_eq!(heard(&back), heard(&content), "{case}: {text}\n{content:?}");
        assert_eq!(problems, [], "{case}: {text}");
        assert_eq!(
            heard(&sable::read(&sable::write(&back)).unwrap().0),
            heard(&content)
        );
    }
}

#[test]
fn ssml_says_what_a_content_says() {
    let mut chance = CaseGenerator(0x55317);
    for case in 0..4000 {
        let content = chance.content();
        let text = ssml::write(&content, "en");
        let (back, problems) = ssml::read(&text).unwrap_or_else(|p| panic!("{case}: {p}\n{text}"));
        assert_eq!(heard(&back), heard(&content), "{case}: {text}\n{content:?}");
        assert_eq!(problems, [], "{case}: {text}");
        assert_eq!(
            heard(&ssml::read(&ssml::write(&back, "en")).unwrap().0),
            heard(&content)
        );
    }
}

#[test]
fn each_language_says_what_the_other_said() {
    let mut chance = CaseGenerator(77);
    for _ in 0..1000 {
        let content = chance.content();
        let (of_sable, _) = sable::read(&sable::write(&content)).unwrap();
        let (of_ssml, _) = ssml::read(&ssml::write(&of_sable, "pt")).unwrap();
        assert_eq!(heard(&of_ssml), heard(&content));
    }
}

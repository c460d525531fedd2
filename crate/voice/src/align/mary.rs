//! MaryXML with phones: the namespaced dialect (ACOUSTPARAMS, REALISED_ACOUSTPARAMS) and that of
//! 2005 (F&H table 4.3), which writes `sampa` at each token and has no times.
//!
//! A phone's `end` excludes the pauses of boundaries; in files where it includes them, the gap
//! before the next phone shows it. Times that restart at 0, as some versions write for each
//! sentence, continue from the previous sentence.

use super::draft::{Draft, Point};
use super::sampa;
use super::text::{TextError, clip, number};
use super::xml::{Element, Xml, XmlEvent};

/// The default length of a phone: about the mean of read English and German.
const PHONE_SECS: f64 = 0.08;

/// Duration of a boundary without one in a file without times.
const BOUNDARY_SECS: f64 = 0.2;

/// Maximum length of a token's transcription, in bytes, which limits the time for finding phones.
const MAX_TRANSCRIPTION: usize = 1000;

/// Tolerance below which two times are equal: durations are whole milliseconds.
const SAME_SECS: f64 = 0.0015;

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let mut reader = Reader {
        draft,
        now: 0.0,
        clock: 0.0,
        pause: 0.0,
        untimed: None,
        token: None,
        syllable: None,
        emotion: None,
    };
    let (mut xml, mut rooted) = (Xml::new(text), false);
    while let Some(piece) = xml.next()? {
        match piece {
            XmlEvent::Start(element) => {
                if !rooted && element.name() != "maryxml" {
                    let name = clip(element.name());
                    return Err(TextError::new(
                        element.at,
                        format!("{name:?} is not \"maryxml\""),
                    ));
                }
                rooted = true;
                reader.start(&element)?;
            }
            XmlEvent::Text(text) => {
                if let Some(token) = &mut reader.token {
                    token.text.push_str(&text);
                }
            }
            XmlEvent::End(name) => reader.end(&name)?,
        }
    }
    if reader.draft.segments.is_empty() {
        return Err(TextError::new(text.len(), "no phones"));
    }
    if let Some(at) = reader.untimed {
        reader
            .draft
            .warn(at, "phones without times; 80 ms are taken for each");
    }
    Ok(())
}

/// A token that has begun.
struct Token {
    at: usize,
    text: String,
    transcription: String,
    accent: String,
    /// The first segment of it.
    first: usize,
    /// The span of its stressed syllable.
    stressed: Option<(f64, f64)>,
    is_accented: bool,
}

/// A syllable that has begun.
struct Open {
    at: usize,
    first: usize,
    stress: u8,
    accent: String,
    tone: String,
}

struct Reader<'d> {
    draft: &'d mut Draft,
    /// Time in the sound.
    now: f64,
    /// Time in the file's own count.
    clock: f64,
    /// Length of the pause since the last phone.
    pause: f64,
    /// The first phone without times.
    untimed: Option<usize>,
    token: Option<Token>,
    syllable: Option<Open>,
    /// An emotion whose name may follow.
    emotion: Option<usize>,
}

impl Reader<'_> {
    fn start(&mut self, element: &Element<'_>) -> Result<(), TextError> {
        let text = |name: &str| Ok(element.attribute(name)?.unwrap_or_default());
        let at = element.at;
        match element.name() {
            "t" => {
                let transcription = match element.attribute("ph")? {
                    Some(ph) => ph,
                    None => text("sampa")?,
                };
                self.token = Some(Token {
                    at,
                    text: String::new(),
                    transcription,
                    accent: text("accent")?,
                    first: self.draft.segments.len(),
                    stressed: None,
                    is_accented: false,
                });
            }
            "syllable" => {
                let stress = element.number("stress")?;
                self.syllable = Some(Open {
                    at,
                    first: self.draft.segments.len(),
                    stress: stress.map_or(0, |s| if s == 1.0 { 1 } else { 2 * u8::from(s == 2.0) }),
                    accent: text("accent")?,
                    tone: text("tone")?,
                });
            }
            "ph" => self.phone(element)?,
            "boundary" => self.boundary(element)?,
            "emotion" => match element.attribute("type")? {
                Some(name) => self.feel(name, at)?,
                None => self.emotion = Some(at),
            },
            "category" => {
                if let (Some(at), Some(name)) = (self.emotion, element.attribute("name")?) {
                    self.feel(name, at)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn end(&mut self, name: &str) -> Result<(), TextError> {
        match name {
            "t" => self.end_token(),
            "syllable" => self.end_syllable(),
            "emotion" => {
                self.emotion = None;
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn feel(&mut self, name: String, at: usize) -> Result<(), TextError> {
        self.draft.count(at)?;
        self.draft.emotions.push(Point {
            secs: self.now,
            label: name,
            at,
        });
        Ok(())
    }

    fn phone(&mut self, element: &Element<'_>) -> Result<(), TextError> {
        let at = element.at;
        let missing = || TextError::new(at, "a phone without \"p\"");
        let name = element.attribute("p")?.ok_or_else(missing)?;
        let duration = element.number("d")?.map(|ms| ms / 1000.0);
        let (start, length) = match (element.number("end")?, duration) {
            (Some(end), Some(length)) => {
                let mut step = end - length - self.clock;
                let anew = end <= self.clock && (end - length).abs() < SAME_SECS;
                let has_pause = self.pause > 0.0 && (step - self.pause).abs() <= 0.5 * self.pause;
                if anew {
                    step = 0.0;
                } else if has_pause {
                    step -= self.pause;
                }
                self.clock = end;
                (self.now + step, length)
            }
            (Some(end), None) => {
                let anew = end <= self.clock && end > 0.0;
                let length = if anew { end } else { end - self.clock };
                self.clock = end;
                (self.now, length)
            }
            (None, Some(length)) => {
                self.clock += length;
                (self.now, length)
            }
            (None, None) => {
                self.untimed.get_or_insert(at);
                (self.now, PHONE_SECS)
            }
        };
        self.pause = 0.0;
        self.draft.segment(start, start + length, &name, at)?;
        self.now = start + length;
        let list = element.attribute("f0")?.unwrap_or_default();
        for pair in list.split(['(', ')']).filter(|p| !p.trim().is_empty()) {
            let Some((percent, hz)) = pair.split_once(',') else {
                let message = format!("{:?} is not a pair of percent and hertz", clip(pair));
                return Err(TextError::new(at, message));
            };
            self.draft.count(at)?;
            let secs = start + length * number(at, percent)? / 100.0;
            self.draft.f0.push((secs, number(at, hz)?, at));
        }
        Ok(())
    }

    fn boundary(&mut self, element: &Element<'_>) -> Result<(), TextError> {
        let at = element.at;
        let break_index = match element.attribute("breakindex")?.as_deref() {
            None | Some("none" | "") => None,
            Some(written) => match written.trim().parse::<u8>() {
                Ok(index) if index <= 6 => Some(index),
                _ => {
                    let message = format!("{:?} is not a break index", clip(written));
                    return Err(TextError::new(at, message));
                }
            },
        };
        let label = element.attribute("tone")?.unwrap_or_default();
        self.draft.count(at)?;
        let secs = self.now;
        self.draft
            .tones
            .push((Point { secs, label, at }, break_index));
        let pause = match element.number("duration")? {
            Some(ms) => ms / 1000.0,
            None if self.untimed.is_some() => BOUNDARY_SECS,
            None => 0.0,
        };
        if pause < 0.0 {
            return Err(TextError::new(at, "a negative pause"));
        }
        if pause > 0.0 {
            self.draft.segment(self.now, self.now + pause, "_", at)?;
            self.now += pause;
            self.pause += pause;
        }
        Ok(())
    }

    /// Returns the time span from the begin of a segment to the last one.
    fn span_from(&self, first: usize) -> Option<(f64, f64)> {
        let first = self.draft.segments.get(first)?;
        let last = self.draft.segments.last()?;
        Some((first.start, last.end))
    }

    fn end_syllable(&mut self) -> Result<(), TextError> {
        let Some(open) = self.syllable.take() else {
            return Ok(());
        };
        let Some((start, end)) = self.span_from(open.first) else {
            return Ok(());
        };
        self.draft.count(open.at)?;
        self.draft.syllables.push((start, end, open.stress));
        if let Some(token) = &mut self.token {
            token.is_accented |= !open.accent.is_empty();
            if open.stress == 1 {
                token.stressed.get_or_insert((start, end));
            }
        }
        self.accent(open.accent, (start, end), open.at);
        if !open.tone.is_empty() {
            let (secs, label, at) = (end, open.tone, open.at);
            self.draft.tones.push((Point { secs, label, at }, None));
        }
        Ok(())
    }

    fn accent(&mut self, label: String, (start, end): (f64, f64), at: usize) {
        if !label.is_empty() {
            let secs = start.midpoint(end);
            self.draft.accents.push(Point { secs, label, at });
        }
    }

    fn end_token(&mut self) -> Result<(), TextError> {
        // A syllable lies within its token.
        self.end_syllable()?;
        let Some(mut token) = self.token.take() else {
            return Ok(());
        };
        if self.draft.segments.len() == token.first {
            self.pronounce(&mut token)?;
        }
        let Some((start, end)) = self.span_from(token.first) else {
            // Punctuation.
            return Ok(());
        };
        let text = token.text.split_whitespace().collect::<Vec<_>>().join(" ");
        self.draft.word(start, end, &text, token.at)?;
        if !token.is_accented {
            let place = token.stressed.unwrap_or((start, end));
            self.accent(token.accent, place, token.at);
        }
        Ok(())
    }

    /// Phones of a token from its transcription.
    fn pronounce(&mut self, token: &mut Token) -> Result<(), TextError> {
        let transcription = std::mem::take(&mut token.transcription);
        if transcription.len() > MAX_TRANSCRIPTION {
            let message = format!("a transcription of {} bytes", transcription.len());
            return Err(TextError::new(token.at, message));
        }
        let mut open: Option<(usize, f64, u8)> = None;
        let phones = sampa::split(&transcription);
        for (i, phone) in phones.iter().enumerate() {
            self.untimed.get_or_insert(token.at);
            let start = self.now;
            self.now += PHONE_SECS;
            self.draft.segment(start, self.now, phone.phone, token.at)?;
            let (_, begin, stress) = *open
                .filter(|(syllable, ..)| *syllable == phone.syllable)
                .get_or_insert((phone.syllable, start, phone.stress));
            open = Some((phone.syllable, begin, stress));
            if phones
                .get(i + 1)
                .is_none_or(|next| next.syllable != phone.syllable)
            {
                self.draft.count(token.at)?;
                self.draft.syllables.push((begin, self.now, stress));
                if stress == 1 {
                    token.stressed.get_or_insert((begin, self.now));
                }
            }
        }
        Ok(())
    }
}

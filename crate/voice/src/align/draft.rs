//! Draft of an alignment: the reader's results so far, and their conversion to a consistent
//! alignment.

use super::text::{LineCounter, TextError, clip};
use super::{Accent, Alignment, Fault, Interval, MAX_INTERVALS, MAX_SECS};
use super::{IPA, Syllable, Tone, Units};
use crate::ipa;
use raconteur_speech::phones::{self, PHONE_SETS};

/// Maximum gap or overlap attributed to rounding to whole milliseconds.
const ROUNDING_SECS: f64 = 0.0015;

/// Warnings beyond these are counted only.
const MAX_WARNINGS: usize = 100;

/// Number of labels used to detect the phone set.
const SAMPLE: usize = 2000;

/// Time interval with its label as written in the file.
#[derive(Clone, Debug)]
pub(super) struct Raw {
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) label: String,
    /// Position in the text.
    pub(super) at: usize,
}

/// Point in time with its label as written in the file.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) secs: f64,
    pub(super) label: String,
    pub(super) at: usize,
}

/// Type of the segments, if the format determines it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Sounds.
    #[default]
    Phones,
    /// Phones or words: the labels decide.
    Unsure,
    /// Type as specified in the file.
    Units(Units),
}

/// Draft of an alignment: everything that a reader found, in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) kind: Kind,
    pub(super) segments: Vec<Raw>,
    pub(super) words: Vec<Raw>,
    /// Begin, end, stress.
    pub(super) syllables: Vec<(f64, f64, u8)>,
    pub(super) accents: Vec<Point>,
    pub(super) tones: Vec<(Point, Option<u8>)>,
    /// Time in seconds, frequency in hertz, position in the text.
    pub(super) f0: Vec<(f64, f64, usize)>,
    pub(super) emotions: Vec<Point>,
    /// Silence lasts to here at least.
    pub(super) end_secs: f64,
    warnings: Vec<(usize, String)>,
    warned: usize,
    counted: usize,
}

impl Draft {
    pub(super) fn warn(&mut self, at: usize, message: impl Into<String>) {
        self.warned += 1;
        if self.warnings.len() < MAX_WARNINGS {
            self.warnings.push((at, message.into()));
        }
    }

    /// Counts a kept interval, point or event; call it for each.
    pub(super) fn count(&mut self, at: usize) -> Result<(), TextError> {
        self.counted += 1;
        if self.counted > MAX_INTERVALS {
            let message = format!("more than {MAX_INTERVALS} intervals");
            return Err(TextError::new(at, message));
        }
        Ok(())
    }

    pub(super) fn segment(
        &mut self,
        start: f64,
        end: f64,
        label: &str,
        at: usize,
    ) -> Result<(), TextError> {
        self.count(at)?;
        self.segments.push(raw(start, end, label, at));
        Ok(())
    }

    pub(super) fn word(
        &mut self,
        start: f64,
        end: f64,
        label: &str,
        at: usize,
    ) -> Result<(), TextError> {
        self.count(at)?;
        self.words.push(raw(start, end, label, at));
        Ok(())
    }

    /// Divides a time span shared by several words by the number of their letters; returns the
    /// number of words.
    pub(super) fn phrase(
        &mut self,
        start: f64,
        end: f64,
        text: &str,
        at: usize,
    ) -> Result<usize, TextError> {
        let letters = |word: &str| word.chars().count() as f64;
        let all: f64 = text.split_whitespace().map(letters).sum();
        let (mut now, mut count) = (start, 0);
        for word in text.split_whitespace() {
            let next = now + (end - start) * letters(word) / all;
            self.word(now, next, word, at)?;
            (now, count) = (next, count + 1);
        }
        Ok(count)
    }

    /// Segments that each begin where the one before ends, from their ends.
    pub(super) fn segments_by_end(&mut self, mut ends: Vec<Point>) -> Result<(), TextError> {
        self.sort(&mut ends);
        let mut start = ends.first().map_or(0.0, |first| first.secs.min(0.0));
        for Point { secs, label, at } in ends {
            self.segment(start, secs, &label, at)?;
            start = secs;
        }
        Ok(())
    }

    /// Builds contiguous segments from their start times. A last one labelled `closing` only marks
    /// the end of the one before; any other lasts `last_secs`.
    pub(super) fn segments_by_start(
        &mut self,
        mut starts: Vec<Point>,
        closing: &str,
        last_secs: f64,
    ) -> Result<(), TextError> {
        self.sort(&mut starts);
        let ends: Vec<f64> = starts.iter().skip(1).map(|p| p.secs).collect();
        for (i, Point { secs, label, at }) in starts.into_iter().enumerate() {
            match ends.get(i) {
                Some(end) => self.segment(secs, *end, &label, at)?,
                None if label == closing && i > 0 => {}
                None => self.segment(secs, secs + last_secs, &label, at)?,
            }
        }
        Ok(())
    }

    fn sort(&mut self, points: &mut [Point]) {
        if let Some(pair) = points.windows(2).find(|p| p[1].secs < p[0].secs) {
            self.warn(pair[1].at, "earlier than the line before; sorted");
            points.sort_by(|a, b| a.secs.total_cmp(&b.secs));
        }
    }

    /// Returns the alignment, or an error that cannot be repaired.
    pub(super) fn finish(mut self, text: &str) -> Result<Alignment, TextError> {
        let units = self.units();
        if units == Units::None && self.words.is_empty() {
            self.words = std::mem::take(&mut self.segments);
        }
        if units == Units::None {
            self.part_phrases()?;
        }
        let shapes = matches!(units, Units::Visemes { .. });
        let mut segments = std::mem::take(&mut self.segments);
        for segment in &mut segments {
            if is_silence(&segment.label) || shapes && segment.label == "X" {
                segment.label.clear();
            }
        }
        let segments = self.settle(segments)?;
        let segments = self.tile(segments);
        let mut words = std::mem::take(&mut self.words);
        for word in &mut words {
            // These two are words, too.
            let real = ["pause", "silence"].contains(&word.label.as_str());
            if is_silence(&word.label) && !real {
                word.label.clear();
            }
        }
        let words = self.settle(words)?;
        let words = words.into_iter().filter(|w| !w.label.is_empty());
        let words = words.map(Interval::from).collect();
        let syllables = syllables(&self.syllables, &segments);
        let accents = self.moments(|d| &mut d.accents)?;
        let emotions = self.moments(|d| &mut d.emotions)?;
        let tones = self.tones()?;
        let f0 = self.pitch()?;
        let untold = self.warned - self.warnings.len();
        self.warnings.sort_by_key(|(at, _)| *at);
        if untold > 0 {
            let last = self.warnings.last().map_or(0, |(at, _)| *at);
            self.warnings.push((last, format!("{untold} repairs more")));
        }
        let mut walk = LineCounter::new(text);
        let told = self.warnings.into_iter().map(|(at, message)| {
            let (line, column) = walk.to(at);
            Fault {
                line,
                column,
                message,
            }
        });
        let warnings = told.collect();
        let accent = |p: Point| Accent {
            at_secs: p.secs,
            label: p.label,
        };
        Ok(Alignment {
            units,
            segments,
            words,
            syllables,
            accents: accents.into_iter().map(accent).collect(),
            tones,
            f0,
            emotions: emotions.into_iter().map(|p| (p.secs, p.label)).collect(),
            warnings,
        })
    }

    /// Labels of several words, as people write them into tiers, become those words.
    fn part_phrases(&mut self) -> Result<(), TextError> {
        if !self
            .words
            .iter()
            .any(|w| w.label.contains(char::is_whitespace))
        {
            return Ok(());
        }
        for raw in std::mem::take(&mut self.words) {
            if !raw.label.contains(char::is_whitespace) {
                self.words.push(raw);
                continue;
            }
            let count = self.phrase(raw.start, raw.end, &raw.label, raw.at)?;
            let label = clip(&raw.label);
            self.warn(
                raw.at,
                format!("{label:?} has one time for {count} words; shared out by letters"),
            );
        }
        Ok(())
    }

    fn units(&self) -> Units {
        if let Kind::Units(units) = self.kind {
            return units;
        }
        let labels = || {
            let labels = self.segments.iter().map(|s| s.label.as_str());
            labels.filter(|l| !is_silence(l)).take(SAMPLE)
        };
        let all = labels().count();
        let (mut most, mut best) = (0, None);
        for set in PHONE_SETS {
            let known = labels().filter(|l| phones::find(set, l).is_some()).count();
            if known > most {
                (most, best) = (known, Some(set));
            }
        }
        let in_ipa = labels().filter(|l| ipa::is_phone(l)).count();
        if in_ipa > most {
            (most, best) = (in_ipa, Some(IPA));
        }
        let few = most * 5 < all * 4;
        if self.segments.is_empty() || self.kind == Kind::Unsure && few && all > 0 {
            return Units::None;
        }
        let set = if few { None } else { best };
        Units::Phones { set }
    }

    /// Sorts the segments, starting at 0, without empty or overlapping ones.
    fn settle(&mut self, mut raws: Vec<Raw>) -> Result<Vec<Raw>, TextError> {
        for raw in &raws {
            check(raw.start, raw.at)?;
            check(raw.end, raw.at)?;
        }
        if let Some(first) = raws.first()
            && raws.iter().all(|r| r.end <= 0.0)
            && raws.iter().any(|r| r.start < 0.0)
        {
            return Err(TextError::new(first.at, "every time is negative"));
        }
        if let Some(pair) = raws.windows(2).find(|r| r[1].start < r[0].start) {
            self.warn(pair[1].at, "begins before the one before it; sorted");
            raws.sort_by(|a, b| a.start.total_cmp(&b.start));
        }
        let mut settled: Vec<Raw> = Vec::with_capacity(raws.len());
        for mut raw in raws {
            if raw.end <= raw.start {
                let how = if raw.end < raw.start {
                    "ends before it begins"
                } else {
                    "is empty"
                };
                self.warn(raw.at, format!("{:?} {how}; dropped", clip(&raw.label)));
                continue;
            }
            if raw.start < 0.0 {
                let what = if raw.end <= 0.0 { "dropped" } else { "cut" };
                let label = clip(&raw.label);
                self.warn(raw.at, format!("{label:?} begins before 0; {what}"));
                if raw.end <= 0.0 {
                    continue;
                }
                raw.start = 0.0;
            }
            while let Some(last) = settled.last_mut().filter(|last| last.end > raw.start) {
                let (over, at, label) = (last.end - raw.start, last.at, clip(&last.label));
                last.end = raw.start;
                let empty = last.end <= last.start;
                if empty {
                    settled.pop();
                    self.warn(at, format!("{label:?} is covered by the next; dropped"));
                } else if over > ROUNDING_SECS {
                    self.warn(at, format!("{label:?} runs {over:.3} s into the next; cut"));
                }
            }
            settled.push(raw);
        }
        Ok(settled)
    }

    /// Converts raw intervals to intervals without gaps, from 0 to the known end.
    fn tile(&mut self, raws: Vec<Raw>) -> Vec<Interval> {
        let mut tiles: Vec<Interval> = Vec::with_capacity(raws.len());
        let mut end = 0.0;
        for mut raw in raws {
            let gap = raw.start - end;
            if gap > ROUNDING_SECS {
                self.warn(
                    raw.at,
                    format!("a gap of {gap:.3} s is filled with silence"),
                );
                tiles.push(silence(end, raw.start));
            } else if let Some(last) = tiles.last_mut() {
                last.end_secs = raw.start;
            } else {
                raw.start = 0.0;
            }
            end = raw.end;
            tiles.push(Interval::from(raw));
        }
        let rest = self.end_secs - end;
        if !tiles.is_empty() && rest > ROUNDING_SECS && self.end_secs <= MAX_SECS {
            tiles.push(silence(end, self.end_secs));
        }
        tiles
    }

    fn moments(
        &mut self,
        which: fn(&mut Self) -> &mut Vec<Point>,
    ) -> Result<Vec<Point>, TextError> {
        let mut points = std::mem::take(which(self));
        for point in &mut points {
            check(point.secs, point.at)?;
            if point.secs < 0.0 {
                let label = clip(&point.label);
                self.warn(point.at, format!("{label:?} is before 0; put there"));
                point.secs = 0.0;
            }
        }
        points.sort_by(|a, b| a.secs.total_cmp(&b.secs));
        Ok(points)
    }

    fn tones(&mut self) -> Result<Vec<Tone>, TextError> {
        let mut tones = Vec::with_capacity(self.tones.len());
        for (point, break_index) in std::mem::take(&mut self.tones) {
            check(point.secs, point.at)?;
            tones.push(Tone {
                at_secs: point.secs.max(0.0),
                label: point.label,
                break_index,
            });
        }
        tones.sort_by(|a, b| a.at_secs.total_cmp(&b.at_secs));
        Ok(tones)
    }

    fn pitch(&mut self) -> Result<Vec<(f64, f64)>, TextError> {
        let mut f0 = Vec::with_capacity(self.f0.len());
        for (secs, hz, at) in std::mem::take(&mut self.f0) {
            check(secs, at)?;
            if !hz.is_finite() || hz <= 0.0 || secs < 0.0 {
                self.warn(at, format!("a pitch of {hz} Hz at {secs} s; dropped"));
            } else {
                f0.push((secs, hz));
            }
        }
        f0.sort_by(|a: &(f64, f64), b| a.0.total_cmp(&b.0));
        Ok(f0)
    }
}

impl From<Raw> for Interval {
    fn from(raw: Raw) -> Self {
        Self {
            start_secs: raw.start,
            end_secs: raw.end,
            label: raw.label,
        }
    }
}

fn raw(start: f64, end: f64, label: &str, at: usize) -> Raw {
    let label = label.trim().to_owned();
    Raw {
        start,
        end,
        label,
        at,
    }
}

fn silence(start_secs: f64, end_secs: f64) -> Interval {
    Interval {
        start_secs,
        end_secs,
        label: String::new(),
    }
}

/// Refuses times that cannot be of a recording.
fn check(secs: f64, at: usize) -> Result<(), TextError> {
    if !secs.is_finite() {
        return Err(TextError::new(at, "a time that is not finite"));
    }
    if secs.abs() > MAX_SECS {
        let message = format!("{secs} s is more than {MAX_SECS} s");
        return Err(TextError::new(at, message));
    }
    Ok(())
}

/// Returns true for labels that aligners and engines use for silence and for the edges of an
/// utterance. A breath has its own mouth shape and is not silence.
pub(super) fn is_silence(label: &str) -> bool {
    const NAMES: [&str; 20] = [
        "", "pau", "sil", "sp", "ssil", "silence", "<sil>", "<p:>", "<p>", "<eps>", "<s>", "</s>",
        "_", "_:", "__", "#", "##", "h#", "#h", "pause",
    ];
    NAMES.iter().any(|name| name.eq_ignore_ascii_case(label))
}

/// Assigns syllables to the segments whose middles they contain.
fn syllables(spans: &[(f64, f64, u8)], segments: &[Interval]) -> Vec<Syllable> {
    let middle = |s: &Interval| s.start_secs.midpoint(s.end_secs);
    let mut found: Vec<Syllable> = Vec::with_capacity(spans.len());
    let mut spans: Vec<_> = spans
        .iter()
        .filter(|s| s.0.is_finite() && s.1.is_finite())
        .collect();
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (start, end, stress) in spans {
        let after = found.last().map_or(0, |s| s.first_segment + s.count);
        let first_segment = segments.partition_point(|s| middle(s) < *start).max(after);
        let past = segments.partition_point(|s| middle(s) < *end);
        let count = past.saturating_sub(first_segment);
        if count > 0 {
            found.push(Syllable {
                first_segment,
                count,
                stress: *stress,
            });
        }
    }
    found
}

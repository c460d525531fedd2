//! Tracks of an annotation as a GestuRA transcription (GEVH C.4).

use std::collections::{BTreeMap, HashMap};
use std::ops::RangeInclusive;

use raconteur_eml::{Diagnostic, Span, quoted};

use super::{Annotation, Extent, Track, TrackElement, TrackKind};
use super::{spread, subdivisions};
use crate::gestura::{
    Attributes, Form, Gesture, GestureClass, Interval, Layer, LevelSpan, Meaning, Noted, Phase,
    Phrase, Prosody, Staging, Transcription, Utterance, Vocabulary, Word,
};
use crate::names::*;

/// Maximum number of tracks between an element and its times.
const MAX_REFERENCES: usize = 16;

/// Converts an annotation. Elements whose parents do not exist, and values outside their lists, are
/// reported and left out.
pub fn to_transcription(annotation: &Annotation, problems: &mut Vec<Diagnostic>) -> Transcription {
    let mut converter = Converter {
        annotation,
        indices: annotation.tracks.iter().map(indices).collect(),
        problems,
    };
    let outside = subdivisions::check(annotation, |track, element| {
        converter.interval(track, element, MAX_REFERENCES)
    });
    converter.problems.extend(outside);
    let words = converter.words();
    let utterances = converter.utterances(&words);
    let levels = converter.levels(&words, &utterances);
    let gestures = converter.gestures();
    let prosody = converter.prosody(&words);
    let staging = converter.staging();
    let layers = converter.layers();
    let told = [
        !words.is_empty(),
        !gestures.is_empty(),
        layers.iter().any(|layer| !layer.phases.is_empty()),
    ];
    if told.iter().all(|any| !any) {
        let hint = "GEVH C.4 names them: words, utterances, discourse-levels, gestures, \
                    gesticulation.phases.layer1, gesticulation.phrases.layer1";
        let message = "the annotation has no track of GestuRA with elements";
        problems.push(Diagnostic::error("gestura::no-track", Span::new(0, 0), message).hint(hint));
    }
    let coder = annotation.info.iter().find(|info| info.key == CODER);
    let mut media: Vec<_> = annotation.media.iter().collect();
    media.sort_by_key(|media| !media.is_master);
    Transcription {
        media: media
            .into_iter()
            .map(|media| media.source.clone())
            .collect(),
        coder: coder.map(|info| info.text.clone()),
        words,
        utterances,
        levels,
        gestures,
        prosody,
        staging,
        settings: annotation.settings(),
        layers,
    }
}

/// Positions of the elements of a track by their index.
type Indices = HashMap<usize, usize>;

fn indices(track: &Track) -> Indices {
    let elements = track.elements.iter().enumerate();
    elements
        .map(|(position, element)| (element.index, position))
        .collect()
}

struct Converter<'a, 'p> {
    annotation: &'a Annotation,
    /// Those of each track.
    indices: Vec<Indices>,
    problems: &'p mut Vec<Diagnostic>,
}

impl<'a> Converter<'a, '_> {
    fn number_of(&self, name: &str) -> Option<usize> {
        let mut tracks = self.annotation.tracks.iter();
        tracks.position(|track| track.name.eq_ignore_ascii_case(name))
    }

    fn elements(&self, name: &str) -> &'a [TrackElement] {
        self.annotation
            .track(name)
            .map_or(&[], |track| &track.elements)
    }

    /// Returns the time span of an element, by its references if it has no times.
    fn interval(&self, track: &Track, element: &TrackElement, depth: usize) -> Option<Interval> {
        match element.extent {
            Extent::Times(interval) => Some(interval),
            Extent::Elements(..) if depth == 0 => None,
            Extent::Elements(first, last) => {
                let number = self.number_of(track.kind.reference()?)?;
                let target = &self.annotation.tracks[number];
                let of = |index: usize| {
                    let element = &target.elements[*self.indices[number].get(&index)?];
                    self.interval(target, element, depth - 1)
                };
                Some(of(first)?.to(of(last)?))
            }
        }
    }

    /// Returns the times of an element of a track, or reports that it has none.
    fn time_of(&mut self, name: &str, element: &TrackElement) -> Option<Interval> {
        let track = &self.annotation.tracks[self.number_of(name)?];
        let found = self.interval(track, element, MAX_REFERENCES);
        if found.is_none() {
            self.outside_parent(element, &track.kind);
        }
        found
    }

    fn outside_parent(&mut self, element: &TrackElement, kind: &TrackKind) {
        let message = match kind.reference().map(quoted) {
            Some(parent) => format!("the element refers to elements that {parent} does not have"),
            None => "the element covers nothing: no element lies in its time".to_owned(),
        };
        self.problems.push(Diagnostic::error(
            "gestura::outside-parent",
            element.span,
            message,
        ));
    }

    /// Returns the positions in `kept` that an element covers. `kept` gives the position of each
    /// element of the track `parent` that was converted.
    fn covered(
        &mut self,
        name: &str,
        element: &TrackElement,
        (parent, kept): (&str, &BTreeMap<usize, usize>),
        intervals: &[Interval],
    ) -> Option<RangeInclusive<usize>> {
        let track = &self.annotation.tracks[self.number_of(name)?];
        let is_direct = track
            .kind
            .reference()
            .is_some_and(|r| r.eq_ignore_ascii_case(parent));
        let found = match element.extent {
            Extent::Elements(first, last) if is_direct => {
                let number = self.number_of(parent);
                let has =
                    |index: &usize| number.is_some_and(|n| self.indices[n].contains_key(index));
                let exist = has(&first) && has(&last);
                let mut inside = kept.range(first..=last).map(|(_, position)| *position);
                let first = inside.next().filter(|_| exist);
                first.map(|first| first..=inside.next_back().unwrap_or(first))
            }
            _ => {
                let whole = self.interval(track, element, MAX_REFERENCES);
                whole.and_then(|whole| within(intervals, whole))
            }
        };
        if found.is_none() {
            self.outside_parent(element, &track.kind);
        }
        found
    }

    fn word<V: Vocabulary>(&mut self, element: &TrackElement, name: &str) -> Option<V> {
        let text = element
            .attribute(name)
            .filter(|text| !text.value.is_empty())?;
        let value = V::from_word(&text.value);
        if value.is_none() {
            let message = format!("{} is not a value of `{name}`", quoted(&text.value));
            self.problems.push(
                Diagnostic::error("gestura::value", text.span, message)
                    .hint(format!("the values are {}", V::list())),
            );
        }
        value
    }

    fn required<V: Vocabulary>(&mut self, element: &TrackElement, name: &str) -> Option<V> {
        if element.value(name).is_none() {
            let message = format!("the element has no `{name}`");
            self.problems.push(
                Diagnostic::error("gestura::missing", element.span, message)
                    .hint(format!("the values are {}", V::list())),
            );
            return None;
        }
        self.word(element, name)
    }

    fn confidence(&mut self, element: &TrackElement) -> Option<u8> {
        let text = element
            .attribute(CONFIDENCE)
            .filter(|text| !text.value.is_empty())?;
        let number = text.value.parse::<f64>().ok();
        let level = number.filter(|n| (1.0..=4.0).contains(n) && n.fract() == 0.0);
        if level.is_none() {
            let message = format!("{} is not a confidence", quoted(&text.value));
            self.problems.push(
                Diagnostic::error("gestura::value", text.span, message)
                    .hint("1 is marginally confident, 4 totally certain"),
            );
        }
        level.map(|level| level as u8)
    }

    fn words(&mut self) -> Vec<Word> {
        if self.elements(WORDS).is_empty() {
            return spread::words(self.elements(UTTERANCES), self.problems);
        }
        let mut words = Vec::new();
        for element in self.elements(WORDS) {
            let Some(interval) = self.time_of(WORDS, element) else {
                continue;
            };
            words.push(Word {
                token: element.value(TOKEN).unwrap_or_default(),
                interval,
                span: element.span,
            });
        }
        words
    }

    /// Returns the positions of the elements of a track of which all with times were converted.
    fn kept(&self, name: &str) -> BTreeMap<usize, usize> {
        let Some(number) = self.number_of(name) else {
            return BTreeMap::new();
        };
        let track = &self.annotation.tracks[number];
        let has_times =
            |element: &&TrackElement| self.interval(track, element, MAX_REFERENCES).is_some();
        let kept = track.elements.iter().filter(has_times).enumerate();
        kept.map(|(position, element)| (element.index, position))
            .collect()
    }

    fn utterances(&mut self, words: &[Word]) -> Vec<Utterance> {
        let kept = self.kept(WORDS);
        let intervals: Vec<Interval> = words.iter().map(|word| word.interval).collect();
        let mut utterances = Vec::new();
        for element in self.elements(UTTERANCES) {
            let parent = (WORDS, &kept);
            let Some(words) = self.covered(UTTERANCES, element, parent, &intervals) else {
                continue;
            };
            utterances.push(Utterance {
                text: element.value(TEXT).unwrap_or_default(),
                words,
                span: element.span,
            });
        }
        utterances
    }

    fn levels(&mut self, words: &[Word], utterances: &[Utterance]) -> Vec<LevelSpan> {
        // Positions of the utterances that were kept, by their span, which is unique.
        let by_span: BTreeMap<Span, usize> = utterances
            .iter()
            .enumerate()
            .map(|(at, utterance)| (utterance.span, at))
            .collect();
        let elements = self.elements(UTTERANCES).iter();
        let kept: BTreeMap<usize, usize> = elements
            .filter_map(|element| Some((element.index, *by_span.get(&element.span)?)))
            .collect();
        let intervals: Vec<Interval> = utterances
            .iter()
            .map(|utterance| {
                let words = &words[utterance.words.clone()];
                words
                    .iter()
                    .map(|word| word.interval)
                    .reduce(Interval::to)
                    .unwrap_or_default()
            })
            .collect();
        let mut levels = Vec::new();
        for element in self.elements(LEVELS) {
            let parent = (UTTERANCES, &kept);
            let covered = self.covered(LEVELS, element, parent, &intervals);
            if let (Some(utterances), Some(level)) = (covered, self.required(element, LEVEL)) {
                levels.push(LevelSpan {
                    level,
                    utterances,
                    span: element.span,
                });
            }
        }
        levels
    }

    fn gestures(&mut self) -> Vec<Gesture> {
        let mut gestures = Vec::new();
        for element in self.elements(GESTURES) {
            let Some(interval) = self.time_of(GESTURES, element) else {
                continue;
            };
            let Some(class) = self.required::<GestureClass>(element, TYPE) else {
                continue;
            };
            gestures.push(Gesture {
                class,
                confidence: self.confidence(element),
                animation: element.value(ANIMATION),
                interval,
                span: element.span,
            });
        }
        gestures
    }

    /// Reads the tracks of a group whose names are elements of EML.
    fn prosody(&mut self, words: &[Word]) -> Vec<Prosody> {
        let kept = self.kept(WORDS);
        let intervals: Vec<Interval> = words.iter().map(|word| word.interval).collect();
        let annotation = self.annotation;
        let mut all = Vec::new();
        for track in &annotation.tracks {
            let Some(name) = layer_name(&track.name, PROSODY) else {
                continue;
            };
            for element in &track.elements {
                if let Some(words) = self.covered(&track.name, element, (WORDS, &kept), &intervals)
                {
                    all.push(Prosody {
                        element: name.to_owned(),
                        attributes: attributes(element),
                        words,
                        span: element.span,
                    });
                }
            }
        }
        all
    }

    fn staging(&mut self) -> Vec<Staging> {
        let annotation = self.annotation;
        let mut all = Vec::new();
        for track in &annotation.tracks {
            let Some(name) = layer_name(&track.name, STAGING) else {
                continue;
            };
            for element in &track.elements {
                if let Some(interval) = self.time_of(&track.name, element) {
                    all.push(Staging {
                        element: name.to_owned(),
                        attributes: attributes(element),
                        interval,
                        span: element.span,
                    });
                }
            }
        }
        all
    }

    fn layers(&mut self) -> Vec<Layer> {
        let annotation = self.annotation;
        let mut layers = Vec::new();
        for track in &annotation.tracks {
            let Some(name) = layer_name(&track.name, PHASES) else {
                continue;
            };
            let (phases, kept) = self.phases(track);
            let intervals: Vec<Interval> = phases.iter().map(|phase| phase.interval).collect();
            let phrases = annotation.tracks.iter();
            let mut phrases = phrases.filter(|other| {
                let own = layer_name(&other.name, PHRASES);
                let parent = other.kind.reference().filter(|_| own.is_some());
                parent.is_some_and(|parent| parent.eq_ignore_ascii_case(&track.name))
                    || own.is_some_and(|own| own.eq_ignore_ascii_case(name))
            });
            let phrases = phrases.next().map_or(Vec::new(), |phrases| {
                self.phrases(phrases, (&track.name, &kept), &intervals)
            });
            layers.push(Layer {
                name: name.to_owned(),
                phases,
                phrases,
            });
        }
        layers
    }

    fn phases(&mut self, track: &'a Track) -> (Vec<Phase>, BTreeMap<usize, usize>) {
        let (mut phases, mut kept) = (Vec::new(), BTreeMap::new());
        for element in &track.elements {
            let Some(interval) = self.time_of(&track.name, element) else {
                continue;
            };
            let Some(kind) = self.required(element, PHASE) else {
                continue;
            };
            kept.insert(element.index, phases.len());
            phases.push(Phase {
                kind,
                interval,
                form: self.form(element),
                span: element.span,
            });
        }
        (phases, kept)
    }

    fn form(&mut self, element: &TrackElement) -> Form {
        macro_rules! noted {
            ($name:expr) => {
                element
                    .attribute($name)
                    .and_then(|text| Noted::read(text, self.problems))
            };
        }
        Form {
            source: noted!(SOURCE),
            target: noted!(TARGET),
            motion: noted!(MOTION),
            hand_shapes: noted!(HAND_SHAPES),
            palm_orientations: noted!(PALM_ORIENTATIONS),
            body_shape: element.value(BODY_SHAPE),
        }
    }

    fn phrases(
        &mut self,
        track: &'a Track,
        parent: (&str, &BTreeMap<usize, usize>),
        intervals: &[Interval],
    ) -> Vec<Phrase> {
        let mut phrases = Vec::new();
        for element in &track.elements {
            let Some(phases) = self.covered(&track.name, element, parent, intervals) else {
                continue;
            };
            let symmetry = element
                .value(SYMMETRY)
                .map(|text| matches!(text.to_lowercase().as_str(), "true" | "yes" | "1"));
            phrases.push(Phrase {
                phases,
                dimension: self.word(element, PHRASE),
                handedness: self.word(element, HANDEDNESS),
                symmetry,
                speaker_frame_position: element.value(SPEAKER_FRAME_POSITION),
                confidence: self.confidence(element),
                contribution: element.value(CONTRIBUTION),
                meaning: Meaning {
                    iconic_body: element.value(ICONIC_BODY),
                    iconic_motion: element.value(ICONIC_MOTION),
                    iconic_viewpoint: self.word(element, ICONIC_VIEWPOINT),
                    metaphoric_base: element.value(METAPHORIC_BASE),
                    metaphoric_referent: element.value(METAPHORIC_REFERENT),
                    metaphoric_motion: element.value(METAPHORIC_MOTION),
                    deictic_geographic_target: element.value(DEICTIC_GEOGRAPHIC),
                    deictic_narration_target: element.value(DEICTIC_NARRATION),
                },
                span: element.span,
            });
        }
        phrases
    }
}

fn attributes(element: &TrackElement) -> Attributes {
    let attributes = element.attributes.iter();
    attributes
        .map(|(name, text)| (name.clone(), text.value.clone()))
        .collect()
}

/// Returns the run of intervals of which at least half lies in another one.
fn within(intervals: &[Interval], whole: Interval) -> Option<RangeInclusive<usize>> {
    let inside = |interval: &Interval| {
        let middle = 0.5 * (interval.start_secs + interval.end_secs);
        (whole.start_secs..=whole.end_secs).contains(&middle)
    };
    let first = intervals.iter().position(inside)?;
    let last = intervals.iter().rposition(inside)?;
    Some(first..=last)
}

/// Returns the last part of a track name in a group, such as `layer1` of
/// `gesticulation.phases.layer1`.
fn layer_name<'n>(track: &'n str, group: &str) -> Option<&'n str> {
    let (start, name) = track.rsplit_once('.')?;
    start.eq_ignore_ascii_case(group).then_some(name)
}

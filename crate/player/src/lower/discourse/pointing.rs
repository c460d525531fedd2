//! One-handed gestures to a side, which give the word that they accompany a place.

use raconteur_actor::gesture::GesturePhase;
use raconteur_actor::{GestureStroke, TimeSpan};
use raconteur_base::order::sort_by_number;
use raconteur_base::text::function_words::is_function_word;
use raconteur_base::{DVec3, Length};

use super::referents::GesturePlace;
use super::spoken::TimedWord;

/// Minimum sideways distance of the wrist, metres on a figure of 1.7 m.
const LATERAL_M: f64 = 0.33;
/// Interval around the start of a stroke in which its word begins, seconds.
const WORD_SECS: (f64, f64) = (-0.15, 0.7);
/// Minimum number of letters of a word that names something.
const LETTERS: usize = 3;
/// Horizontal distance of the place from the shoulders, and its height, metres on a figure of
/// 1.7 m. *Designed*: beyond the hand, at the height of the shoulders.
const PLACE_M: (f64, f64) = (2.0, 1.4);
/// Minimum length of a stroke, seconds: a stroke may be a single time.
const MIN_STROKE_SECS: f64 = 1e-3;

/// Measures of a figure that convert a wrist position to a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shoulders {
    /// Middle between the shoulder joints, in the axes of the figure, metres.
    pub(super) middle: DVec3,
    /// Size of the figure relative to one of 1.7 m.
    pub(super) scale: f64,
}

impl Shoulders {
    /// Returns the place to which a wrist points; `None` if it is not to a side.
    fn place(&self, wrist: DVec3) -> Option<DVec3> {
        let (far, high) = PLACE_M;
        let level = DVec3::new(wrist.x - self.middle.x, 0.0, wrist.z - self.middle.z);
        let length = level.magnitude();
        let is_lateral = wrist.is_finite() && wrist.x.abs() > LATERAL_M * self.scale;
        (is_lateral && length > 0.0).then(|| {
            let direction = level / length * far * self.scale;
            DVec3::new(
                self.middle.x + direction.x,
                high * self.scale,
                self.middle.z + direction.z,
            )
        })
    }
}

/// Intervals in which an arm has strokes.
struct BusyIntervals {
    /// Start of each stroke, and the last end up to it; by start.
    strokes: Vec<(f64, f64)>,
}

impl BusyIntervals {
    fn new(strokes: &[GestureStroke]) -> Self {
        let mut all: Vec<(f64, f64)> = strokes.iter().map(interval).collect();
        sort_by_number(&mut all, |(start, _)| *start);
        let mut last = f64::NEG_INFINITY;
        for (_, end) in &mut all {
            last = last.max(*end);
            *end = last;
        }
        Self { strokes: all }
    }

    fn overlaps(&self, (start_secs, end_secs): (f64, f64)) -> bool {
        let begun = self.strokes.partition_point(|(start, _)| *start < end_secs);
        let last = begun.checked_sub(1).and_then(|i| self.strokes.get(i));
        last.is_some_and(|(_, end)| *end > start_secs)
    }
}

fn interval(stroke: &GestureStroke) -> (f64, f64) {
    let start = stroke.start_secs;
    (start, stroke.end_secs.max(start + MIN_STROKE_SECS))
}

/// Returns the places that the one-handed strokes of both arms set. `on` are the intervals in which
/// gestures are on; `words` are sorted by time.
pub(super) fn gesture_places(
    strokes: &[Vec<GestureStroke>; 2],
    on: &[TimeSpan],
    words: &[TimedWord],
    shoulders: &Shoulders,
) -> Vec<GesturePlace> {
    let busy = [
        BusyIntervals::new(&strokes[0]),
        BusyIntervals::new(&strokes[1]),
    ];
    let mut found: Vec<(&GestureStroke, DVec3)> = Vec::new();
    for (side, own) in strokes.iter().enumerate() {
        let other = &busy[1 - side];
        for stroke in own {
            let wrist = stroke.keys.iter().rev().find_map(|key| key.wrist_in_world);
            let place = wrist.and_then(|wrist| shoulders.place(wrist));
            let is_timed = stroke.start_secs.is_finite() && stroke.end_secs.is_finite();
            if let Some(place) = place
                && stroke.phase == GesturePhase::Stroke
                && is_timed
                && is_on(on, stroke.start_secs)
                && !other.overlaps(interval(stroke))
            {
                found.push((stroke, place));
            }
        }
    }
    if found.is_empty() {
        return Vec::new();
    }
    let named: Vec<&TimedWord> = words.iter().filter(|word| is_name(&word.bare)).collect();
    let mut places: Vec<GesturePlace> = found
        .into_iter()
        .filter_map(|(stroke, place_in_figure)| {
            let (from, to) = WORD_SECS;
            let from_secs = stroke.start_secs + from;
            let next = named.partition_point(|word| word.start_secs < from_secs);
            let word = named.get(next)?;
            (word.start_secs <= stroke.start_secs + to).then(|| GesturePlace {
                start_secs: stroke.start_secs,
                end_secs: stroke.end_secs.max(stroke.start_secs),
                word: (*word).clone(),
                place_in_figure,
            })
        })
        .collect();
    sort_by_number(&mut places, |place| place.start_secs);
    places
}

/// Returns true if gestures are on at a time.
fn is_on(on: &[TimeSpan], time_secs: f64) -> bool {
    let begun = on.partition_point(|span| span.start_secs <= time_secs);
    // A gesture before the story's start is performed as well.
    let span = on.get(begun.saturating_sub(1));
    span.is_some_and(|span| time_secs < span.end_secs)
}

/// Returns true if a bare word may name something.
fn is_name(word: &str) -> bool {
    word.chars().filter(|c| c.is_alphabetic()).count() >= LETTERS && !is_function_word(word)
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_actor::HandKey;

    const SHOULDERS: Shoulders = Shoulders {
        middle: DVec3::new(0.0, 1.4, 0.0),
        scale: 1.0,
    };
    const ALWAYS: [TimeSpan; 1] = [TimeSpan {
        start_secs: 0.0,
        end_secs: f64::INFINITY,
    }];

    fn stroke(start_secs: f64, wrists: &[[f64; 3]]) -> GestureStroke {
        GestureStroke {
            start_secs,
            end_secs: start_secs + 1.0,
            keys: wrists
                .iter()
                .map(|wrist| HandKey {
                    time_secs: start_secs,
                    wrist_in_world: Some(DVec3::from_array(*wrist)),
                    ..HandKey::default()
                })
                .collect(),
            ..GestureStroke::default()
        }
    }

    fn words(texts: &[(&str, f64)]) -> Vec<TimedWord> {
        let word = |(text, start_secs): &(&str, f64)| TimedWord {
            bare: (*text).to_owned(),
            start_secs: *start_secs,
            end_secs: start_secs + 0.3,
        };
        texts.iter().map(word).collect()
    }

    fn bound(strokes: &[Vec<GestureStroke>; 2], words: &[TimedWord]) -> Vec<(f64, String, DVec3)> {
        let places = gesture_places(strokes, &ALWAYS, words, &SHOULDERS);
        let shown =
            |place: GesturePlace| (place.start_secs, place.word.bare, place.place_in_figure);
        places.into_iter().map(shown).collect()
    }

    #[test]
    fn a_hand_to_the_side_places_the_next_word_that_names_something() {
        let strokes = [
            vec![stroke(2.0, &[[0.0, 1.0, 0.4], [0.4, 1.2, 0.3]])],
            vec![],
        ];
        let spoken = words(&[("fox", 1.7), ("the", 1.9), ("ox", 2.1), ("goat", 2.4)]);
        let expected = (2.0, "goat".to_owned(), DVec3::new(1.6, 1.4, 1.2));
        assert_eq!(
            bound(&strokes, &spoken),
            [expected],
            "the word and the place"
        );
        for (texts, expected) in [
            (&[("goat", 1.85), ("cow", 2.2)][..], Some("goat")),
            (&[("goat", 1.8), ("cow", 2.7)], Some("cow")),
            (&[("goat", 1.8), ("cow", 2.75)], None),
            (&[], None),
        ] {
            let found = bound(&strokes, &words(texts));
            let word = found.first().map(|(_, word, _)| word.as_str());
            assert_eq!(word, expected, "{texts:?}");
        }
    }

    #[test]
    fn other_strokes_place_nothing() {
        let spoken = words(&[("goat", 2.1)]);
        let side = || stroke(2.0, &[[-0.4, 1.2, 0.3]]);
        assert_eq!(bound(&[vec![], vec![side()]], &spoken).len(), 1, "one hand");
        let later = stroke(2.9, &[[0.1, 1.2, 0.3]]);
        assert_eq!(
            bound(&[vec![later], vec![side()]], &spoken),
            [],
            "two hands"
        );
        let after = stroke(3.0, &[[0.1, 1.2, 0.3]]);
        assert_eq!(
            bound(&[vec![after], vec![side()]], &spoken).len(),
            1,
            "one after another"
        );
        let near = stroke(2.0, &[[-0.4, 1.2, 0.3], [-0.3, 1.2, 0.3]]);
        assert_eq!(
            bound(&[vec![], vec![near]], &spoken),
            [],
            "the last place is in front"
        );
        let hold = GestureStroke {
            phase: GesturePhase::Hold,
            ..side()
        };
        assert_eq!(bound(&[vec![], vec![hold]], &spoken), [], "a hold");
        let nowhere = stroke(f64::NAN, &[[-0.4, 1.2, 0.3]]);
        assert_eq!(bound(&[vec![], vec![nowhere]], &spoken), [], "no time");
        let off = [TimeSpan {
            start_secs: 0.0,
            end_secs: 1.0,
        }];
        let strokes = [vec![], vec![side()]];
        let found = gesture_places(&strokes, &off, &spoken, &SHOULDERS);
        assert_eq!(found, [], "gestures are off");
    }
}

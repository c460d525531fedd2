//! Referents with a place, and the words that mention them.

use std::collections::BTreeMap;

use raconteur_actor::Mention;
use raconteur_base::DVec3;
use raconteur_base::order::sort_by_number;

use super::spoken::TimedWord;

/// Mentions of one referent that are closer than this are one, seconds.
const MERGE_SECS: f64 = 0.3;
/// Minimum time between mentions of a referent placed by a gesture, seconds. *Designed*: the
/// storyteller does not turn to it with every word.
const SPACING_SECS: f64 = 4.0;
/// Times that should be equal differ by less, seconds.
const ROUNDING_SECS: f64 = 1e-6;
/// Endings of plurals and possessives that a mention may have, longest first.
const ENDINGS: [&str; 5] = ["'s", "es", "en", "s", "n"];

/// Place of a referent from a time on, set by an `r:place`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlaceCue {
    /// Time, story time, seconds.
    pub(crate) start_secs: f64,
    /// Name of the referent.
    pub(crate) name: String,
    /// Words that mention it, bare; empty if the cue sets none.
    pub(crate) words: Vec<String>,
    /// Its place, in the axes of the figure, metres.
    pub(crate) place_in_figure: DVec3,
}

/// Place of a referent from a one-handed gesture with its first mention.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GesturePlace {
    /// Start of the stroke, story time, seconds.
    pub(crate) start_secs: f64,
    /// End of the stroke, story time, seconds.
    pub(crate) end_secs: f64,
    /// Word that the stroke accompanies, bare.
    pub(crate) word: TimedWord,
    /// Direction of the hand as a place, in the axes of the figure, metres.
    pub(crate) place_in_figure: DVec3,
}

/// Values from a time on, in order of time.
type FromTime<T> = Vec<(f64, T)>;

/// Returns the last value set at a time or before.
fn value_at<T>(values: &[(f64, T)], time_secs: f64) -> Option<&T> {
    let set = values.partition_point(|(from, _)| *from <= time_secs + ROUNDING_SECS);
    values.get(set.checked_sub(1)?).map(|(_, value)| value)
}

/// Referents set by `r:place`.
struct Referents {
    /// Referents by the words that mention them.
    by_word: BTreeMap<String, FromTime<usize>>,
    /// Places of each referent.
    places: Vec<FromTime<DVec3>>,
}

impl Referents {
    /// Collects the referents of place cues.
    fn new<'c>(cues: impl Iterator<Item = &'c PlaceCue>) -> Self {
        let mut cues: Vec<&PlaceCue> = cues.filter(|cue| cue.start_secs.is_finite()).collect();
        sort_by_number(&mut cues, |cue| cue.start_secs);
        let mut by_name: BTreeMap<&str, usize> = BTreeMap::new();
        let mut by_word: BTreeMap<String, FromTime<usize>> = BTreeMap::new();
        let mut places: Vec<FromTime<DVec3>> = Vec::new();
        for cue in cues {
            let is_new = !by_name.contains_key(cue.name.as_str());
            let referent = *by_name.entry(&cue.name).or_insert(places.len());
            if is_new {
                places.push(Vec::new());
            }
            places[referent].push((cue.start_secs, cue.place_in_figure));
            // A cue that only moves its referent sets no words.
            let default = if is_new && cue.words.is_empty() {
                words_of(&cue.name)
            } else {
                Vec::new()
            };
            for word in cue.words.iter().chain(&default) {
                let set = by_word.entry(word.clone()).or_default();
                set.push((cue.start_secs, referent));
            }
        }
        Self { by_word, places }
    }

    /// Returns the referent mentioned by a word at a time, and its place then.
    fn mentioned(&self, word: &str, time_secs: f64) -> Option<(usize, DVec3)> {
        let found = |form: &str| {
            let referent = *value_at(self.by_word.get(form)?, time_secs)?;
            Some((referent, *value_at(&self.places[referent], time_secs)?))
        };
        forms(word).find_map(found)
    }
}

/// Returns a bare word and what it may be a plural or possessive of.
fn forms(word: &str) -> impl Iterator<Item = &str> {
    let stems = ENDINGS
        .iter()
        .filter_map(move |ending| word.strip_suffix(ending));
    let plural_possessive = word.strip_suffix('\'');
    std::iter::once(word)
        .chain(plural_possessive)
        .chain(stems)
        .filter(|form| !form.is_empty())
}

/// Returns the bare words of a list with spaces between them.
pub(super) fn words_of(list: &str) -> Vec<String> {
    let words = list.split_whitespace().map(super::spoken::bare);
    words.filter(|word| !word.is_empty()).collect()
}

/// Returns the mentions of all referents, sorted by start: of those set by `r:place`, and of those
/// that gestures place. `words` are sorted by time.
pub(super) fn mentions<'c>(
    cues: impl Iterator<Item = &'c PlaceCue>,
    gestures: impl Iterator<Item = &'c GesturePlace>,
    words: &[&TimedWord],
) -> Vec<Mention> {
    let referents = Referents::new(cues);
    let mut mentions = authored(&referents, words);
    // A place that the author has set takes precedence over the direction of a hand.
    let free = |gesture: &&GesturePlace| {
        let word = &gesture.word;
        let secs = word.start_secs;
        referents.mentioned(&word.bare, secs).is_none()
    };
    let gestures: Vec<&GesturePlace> = gestures.filter(free).collect();
    mentions.extend(gestured(&gestures, &referents, words));
    sort_by_number(&mut mentions, |mention| mention.start_secs);
    mentions
}

/// Returns the mentions of referents set by `r:place`.
fn authored(referents: &Referents, words: &[&TimedWord]) -> Vec<Mention> {
    let mut mentions: Vec<Mention> = Vec::new();
    // Last mention of each referent.
    let mut last: BTreeMap<usize, usize> = BTreeMap::new();
    for word in words {
        let Some((referent, place_in_figure)) = referents.mentioned(&word.bare, word.start_secs)
        else {
            continue;
        };
        if let Some(previous) = last.get(&referent).and_then(|at| mentions.get_mut(*at))
            && word.start_secs - previous.end_secs < MERGE_SECS
            && previous.place_in_figure == place_in_figure
        {
            previous.end_secs = previous.end_secs.max(word.end_secs);
            continue;
        }
        last.insert(referent, mentions.len());
        mentions.push(Mention {
            start_secs: word.start_secs,
            end_secs: word.end_secs,
            place_in_figure,
        });
    }
    mentions
}

/// Returns the mentions of referents that gestures place: the strokes, and later occurrences of
/// their words.
fn gestured(
    gestures: &[&GesturePlace],
    referents: &Referents,
    words: &[&TimedWord],
) -> Vec<Mention> {
    let mut mentions: Vec<Mention> = gestures
        .iter()
        .map(|gesture| Mention {
            start_secs: gesture.start_secs,
            end_secs: gesture.end_secs,
            place_in_figure: gesture.place_in_figure,
        })
        .collect();
    let mut by_word: BTreeMap<&str, FromTime<(f64, DVec3)>> = BTreeMap::new();
    for gesture in gestures {
        let set = by_word.entry(gesture.word.bare.as_str()).or_default();
        // The word may begin shortly before the stroke.
        let from_secs = gesture.start_secs.min(gesture.word.start_secs);
        set.push((from_secs, (gesture.start_secs, gesture.place_in_figure)));
    }
    for set in by_word.values_mut() {
        sort_by_number(set, |(from, _)| *from);
    }
    // Last mention of each referent by a word.
    let mut last: BTreeMap<&str, f64> = BTreeMap::new();
    for word in words {
        let placed = |form: &str| {
            let (own, set) = by_word.get_key_value(form)?;
            Some((*own, value_at(set, word.start_secs)?))
        };
        let Some((own, (stroke_secs, place))) = forms(&word.bare).find_map(placed) else {
            continue;
        };
        let since_secs = last.get(own).map_or(*stroke_secs, |l| l.max(*stroke_secs));
        if word.start_secs - since_secs < SPACING_SECS
            || referents.mentioned(&word.bare, word.start_secs).is_some()
        {
            continue;
        }
        last.insert(own, word.start_secs);
        mentions.push(Mention {
            start_secs: word.start_secs,
            end_secs: word.end_secs,
            place_in_figure: *place,
        });
    }
    mentions
}

//! Festival's utterances as written by `utt.save`: items with features, and relations that are
//! trees over items (Edinburgh Speech Tools, `EST_UtteranceFile`, ASCII version 2).

use std::cell::Cell;
use std::collections::BTreeMap;

use super::draft::{Draft, Point};
use super::text::{TextError, clip, fields, lines, number};

/// Utterance item: its relevant features and its position.
#[derive(Clone, Default)]
struct Item {
    at: usize,
    features: Vec<(String, String)>,
}

impl Item {
    fn get(&self, name: &str) -> Option<&str> {
        let found = self.features.iter().find(|(n, _)| n == name);
        found.map(|(_, value)| value.as_str())
    }

    fn number(&self, name: &str) -> Result<Option<f64>, TextError> {
        self.get(name)
            .map(|value| number(self.at, value))
            .transpose()
    }
}

/// Retained features; an utterance also has scores for each of many models.
const KEPT: [&str; 8] = [
    "name", "end", "stress", "pbreak", "pos", "f0", "emotion", "accented",
];

/// A node of a relation.
#[derive(Clone, Copy)]
struct Node {
    item: usize,
    down: usize,
    next: usize,
    prev: usize,
    /// Mother node if a list of daughters begins here, from the file; otherwise 0.
    up: usize,
}

type Relation = BTreeMap<usize, Node>;

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let mut lines = lines(text);
    header(&mut lines, text)?;
    let mut items: BTreeMap<usize, Item> = BTreeMap::new();
    let mut relations: BTreeMap<String, Relation> = BTreeMap::new();
    let mut open: Option<String> = None;
    let mut in_relations = false;
    for (at, line) in lines {
        let word = line.split_whitespace().next().unwrap_or_default();
        match word {
            "" => {}
            "End_of_Utterance" => {
                let nodes: usize = relations.values().map(BTreeMap::len).sum();
                let whole = Whole {
                    items,
                    relations,
                    steps_left: Cell::new(8 * nodes),
                };
                return whole.append_to(draft, text.len());
            }
            "End_of_Stream_Items" | "Stream_Items" => {}
            "Relations" => in_relations = true,
            "End_of_Relations" => in_relations = false,
            "End_of_Relation" => open = None,
            "Relation" => open = fields(at, line).nth(1).map(|(_, name)| name.to_owned()),
            _ if in_relations => {
                let Some(name) = &open else {
                    return Err(TextError::new(at, "a node outside of a relation"));
                };
                draft.count(at)?;
                let (id, node) = node(at, line)?;
                relations.entry(name.clone()).or_default().insert(id, node);
            }
            _ => {
                draft.count(at)?;
                let id = index(at, word)?;
                items.insert(id, item(at, line, word)?);
            }
        }
    }
    Err(TextError::new(text.len(), "no End_of_Utterance"))
}

fn header<'a>(
    lines: &mut impl Iterator<Item = (usize, &'a str)>,
    text: &str,
) -> Result<(), TextError> {
    if lines
        .next()
        .is_none_or(|(_, l)| l.trim() != "EST_File utterance")
    {
        return Err(TextError::new(0, "no \"EST_File utterance\""));
    }
    for (at, line) in lines {
        let mut words = fields(at, line);
        match (words.next().map(|w| w.1), words.next()) {
            (Some("Stream_Items"), _) => return Ok(()),
            (Some("DataType"), Some((at, kind))) if kind != "ascii" => {
                let message = format!("data of type {:?}; only ascii is read", clip(kind));
                return Err(TextError::new(at, message));
            }
            (Some("version"), Some((at, version))) if version != "2" && version != "1.2" => {
                let message = format!("version {:?}; 2 is read", clip(version));
                return Err(TextError::new(at, message));
            }
            _ => {}
        }
    }
    Err(TextError::new(text.len(), "no Stream_Items"))
}

fn index(at: usize, field: &str) -> Result<usize, TextError> {
    let bad = || {
        TextError::new(
            at,
            format!("{:?} is not the number of an item or node", clip(field)),
        )
    };
    field.parse().map_err(|_| bad())
}

fn node(at: usize, line: &str) -> Result<(usize, Node), TextError> {
    let mut numbers = [0; 6];
    let mut fields = fields(at, line);
    for slot in &mut numbers {
        let missing = || TextError::new(at + line.len(), "a node is six numbers");
        let (at, field) = fields.next().ok_or_else(missing)?;
        *slot = index(at, field)?;
    }
    let [id, item, up, down, next, prev] = numbers;
    let node = Node {
        item,
        up,
        down,
        next,
        prev,
    };
    Ok((id, node))
}

/// Parses an item, `number key value ; key value ;`, in which a value may be quoted.
fn item(at: usize, line: &str, id: &str) -> Result<Item, TextError> {
    let mut item = Item {
        at,
        features: Vec::new(),
    };
    let mut rest = line.trim_start().strip_prefix(id).unwrap_or_default();
    loop {
        rest = rest.trim_start().trim_start_matches(';').trim_start();
        let here = at + line.len() - rest.len();
        let Some(key) = rest.split_whitespace().next() else {
            return Ok(item);
        };
        rest = rest[key.len()..].trim_start();
        let (value, length) =
            value(rest).ok_or_else(|| TextError::new(here, "a text does not end"))?;
        if KEPT.contains(&key) {
            item.features.push((key.to_owned(), value));
        }
        rest = &rest[length..];
        if !rest.trim_start().starts_with(';') && !rest.trim().is_empty() {
            let here = at + line.len() - rest.trim_start().len();
            return Err(TextError::new(here, "\";\" should follow a feature"));
        }
    }
}

/// Returns a feature's value and its length in bytes: quoted with `\` as escape, or everything up
/// to ` ;`, which may be a list in brackets.
fn value(rest: &str) -> Option<(String, usize)> {
    if !rest.starts_with('"') {
        let end = rest
            .find(" ;")
            .or_else(|| rest.strip_suffix(';').map(str::len));
        let end = end.unwrap_or(rest.len());
        return Some((rest[..end].trim().to_owned(), end));
    }
    let (mut value, mut escaped) = (String::new(), false);
    for (i, c) in rest.char_indices().skip(1) {
        match c {
            _ if escaped => {
                value.push(c);
                escaped = false;
            }
            '\\' => escaped = true,
            '"' => return Some((value, i + 1)),
            _ => value.push(c),
        }
    }
    None
}

struct Whole {
    items: BTreeMap<usize, Item>,
    relations: BTreeMap<String, Relation>,
    /// Step limit: no valid relation of an utterance shares nodes, and one that does could loop
    /// forever.
    steps_left: Cell<usize>,
}

impl Whole {
    fn relation(&self, name: &str) -> Option<&Relation> {
        self.relations.get(name)
    }

    fn item(&self, node: Node) -> Option<&Item> {
        self.items.get(&node.item)
    }

    /// Nodes from one on, by `next`.
    fn chain(&self, relation: &Relation, from: usize) -> impl Iterator<Item = Node> {
        let mut id = from;
        std::iter::from_fn(move || {
            let left = self.steps_left.get().checked_sub(1)?;
            self.steps_left.set(left);
            let node = relation.get(&id).copied()?;
            id = node.next;
            Some(node)
        })
    }

    /// Iterates over the top nodes of a relation: all that follow from the node without predecessor
    /// and mother.
    fn tops(&self, relation: &Relation) -> impl Iterator<Item = Node> {
        let with_daughters = relation.values().filter(|n| n.down != 0);
        let mut daughters: Vec<usize> = with_daughters.map(|n| n.down).collect();
        daughters.sort_unstable();
        let is_top =
            |id: &usize, n: &Node| n.prev == 0 && n.up == 0 && daughters.binary_search(id).is_err();
        let first = relation.iter().find(|(id, node)| is_top(id, node));
        self.chain(relation, first.map_or(0, |(id, _)| *id))
    }

    fn append_to(&self, draft: &mut Draft, end: usize) -> Result<(), TextError> {
        let Some(segments) = self.relation("Segment") else {
            return Err(TextError::new(end, "no relation Segment"));
        };
        // Begin and end of each item that lasts.
        let mut spans: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
        let mut ends = Vec::new();
        let mut before = 0.0;
        for node in self.tops(segments) {
            let Some(item) = self.item(node) else {
                return Err(TextError::new(
                    end,
                    format!("no item {} of Segment", node.item),
                ));
            };
            let Some(secs) = item.number("end")? else {
                return Err(TextError::new(item.at, "a segment without \"end\""));
            };
            spans.insert(node.item, (before, secs));
            before = secs;
            ends.push(Point {
                secs,
                label: item.get("name").unwrap_or_default().to_owned(),
                at: item.at,
            });
        }
        draft.segments_by_end(ends)?;
        let breaks = self.structure(&mut spans, draft)?;
        self.intonation(&spans, &breaks, draft)?;
        self.targets(draft)
    }

    /// Builds words and syllables over segments. Returns the tone that ends with each syllable.
    fn structure(
        &self,
        spans: &mut BTreeMap<usize, (f64, f64)>,
        draft: &mut Draft,
    ) -> Result<BTreeMap<usize, usize>, TextError> {
        let mut breaks = BTreeMap::new();
        let Some(structure) = self.relation("SylStructure") else {
            return Ok(breaks);
        };
        let mut last_words = Vec::new();
        if let Some(phrases) = self.relation("Phrase") {
            for phrase in self.tops(phrases) {
                let last = self.chain(phrases, phrase.down).last();
                last_words.extend(last.map(|node| node.item));
            }
        }
        last_words.sort_unstable();
        for word in self.tops(structure) {
            let (mut word_span, mut last) = (None, 0);
            for syllable in self.chain(structure, word.down) {
                let mut span: Option<(f64, f64)> = None;
                for leaf in self.chain(structure, syllable.down) {
                    span = join(span, spans.get(&leaf.item).copied());
                }
                let (Some((start, end)), Some(item)) = (span, self.item(syllable)) else {
                    continue;
                };
                draft.count(item.at)?;
                let stress = item.get("stress").and_then(|s| s.parse().ok());
                let stress = stress.filter(|s| *s <= 2).unwrap_or(0);
                draft.syllables.push((start, end, stress));
                spans.insert(syllable.item, (start, end));
                word_span = join(word_span, span);
                last = syllable.item;
            }
            // Punctuation is a word without sounds.
            let (Some((start, end)), Some(item)) = (word_span, self.item(word)) else {
                continue;
            };
            let name = item.get("name").unwrap_or_default();
            draft.word(start, end, name, item.at)?;
            let of_phrase = last_words.binary_search(&word.item).is_ok();
            let break_index = match item.get("pbreak") {
                Some("BB") => Some(4),
                Some("B") => Some(3),
                _ if of_phrase => Some(4),
                _ => None,
            };
            if break_index.is_some() {
                breaks.insert(last, draft.tones.len());
                draft.tones.push((point(end, "", item.at), break_index));
            }
        }
        Ok(breaks)
    }

    /// Accents and boundary tones, which hang from syllables.
    fn intonation(
        &self,
        spans: &BTreeMap<usize, (f64, f64)>,
        breaks: &BTreeMap<usize, usize>,
        draft: &mut Draft,
    ) -> Result<(), TextError> {
        let Some(intonation) = self.relation("Intonation") else {
            return Ok(());
        };
        for syllable in self.tops(intonation) {
            let Some((start, end)) = spans.get(&syllable.item).copied() else {
                continue;
            };
            for event in self.chain(intonation, syllable.down) {
                let Some(item) = self.item(event) else {
                    continue;
                };
                draft.count(item.at)?;
                let name = item.get("name").unwrap_or_default();
                if name.contains('*') {
                    let middle = start.midpoint(end);
                    draft.accents.push(point(middle, name, item.at));
                    continue;
                }
                // A tone at a phrase's end belongs to the break that is there.
                let there = breaks.get(&syllable.item);
                match there.and_then(|i| draft.tones.get_mut(*i)) {
                    Some((tone, _)) if tone.label.is_empty() => name.clone_into(&mut tone.label),
                    _ => draft.tones.push((point(end, name, item.at), None)),
                }
            }
        }
        Ok(())
    }

    fn targets(&self, draft: &mut Draft) -> Result<(), TextError> {
        for node in self.relation("Target").into_iter().flat_map(|r| r.values()) {
            let Some(item) = self.item(*node) else {
                continue;
            };
            if let (Some(secs), Some(hz)) = (item.number("pos").ok().flatten(), item.number("f0")?)
            {
                draft.f0.push((secs, hz, item.at));
            }
        }
        Ok(())
    }
}

fn point(secs: f64, label: &str, at: usize) -> Point {
    let label = label.to_owned();
    Point { secs, label, at }
}

/// Returns the span that covers both spans; if one is missing, the other.
fn join(a: Option<(f64, f64)>, b: Option<(f64, f64)>) -> Option<(f64, f64)> {
    match (a, b) {
        (Some(a), Some(b)) => Some((a.0.min(b.0), a.1.max(b.1))),
        (a, b) => a.or(b),
    }
}

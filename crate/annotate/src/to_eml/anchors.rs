//! Words to which times refer.

use std::collections::BTreeSet;

use raconteur_base::order::order_by_number;
use raconteur_eml::{Name, TimeExpr};

use super::Anchoring;
use crate::gestura::Transcription;
use crate::script::{after, seconds};

/// Words with a mark, and the times that refer to them.
pub(super) struct Anchors {
    /// Start times of spoken words in ascending order, with their indices. Empty: times are seconds.
    starts: Vec<(f64, usize)>,
    chosen: BTreeSet<usize>,
}

impl Anchors {
    pub(super) fn new(transcription: &Transcription, anchoring: Anchoring) -> Self {
        let words = transcription.words.iter().enumerate();
        let spoken = words.filter(|(_, word)| word.is_spoken());
        let mut starts: Vec<(f64, usize)> = match anchoring {
            Anchoring::Words => spoken
                .map(|(i, word)| (word.interval.start_secs, i))
                .collect(),
            Anchoring::Seconds => Vec::new(),
        };
        if let Some(order) = order_by_number(&starts, |(start, _)| *start) {
            starts = order.into_iter().map(|i| starts[i]).collect();
        }
        Self {
            starts,
            chosen: BTreeSet::new(),
        }
    }

    /// Returns true if times refer to words.
    pub(super) fn are_words(&self) -> bool {
        !self.starts.is_empty()
    }

    /// Returns the word that begins nearest to a time, with its start.
    fn nearest(&self, secs: f64) -> Option<(f64, usize)> {
        let next = self.starts.partition_point(|(start, _)| *start < secs);
        let near = [next.checked_sub(1), Some(next)].into_iter().flatten();
        near.filter_map(|i| self.starts.get(i).copied())
            .reduce(|a, b| {
                if (b.0 - secs).abs() < (a.0 - secs).abs() {
                    b
                } else {
                    a
                }
            })
    }

    /// Gives the word nearest to a time a mark.
    pub(super) fn choose(&mut self, secs: f64) {
        let nearest = self.nearest(secs);
        self.chosen.extend(nearest.map(|(_, word)| word));
    }

    /// Returns the mark of a word; `None` if no time refers to it.
    pub(super) fn mark(&self, word: usize) -> Option<Name> {
        self.chosen.contains(&word).then(|| name(word))
    }

    /// Returns the expression of a time, relative to the word nearest to `anchor_secs`, which has
    /// been chosen.
    pub(super) fn time(&self, secs: f64, anchor_secs: f64) -> TimeExpr {
        match self.nearest(anchor_secs) {
            Some((start, word)) => after(name(word), secs - start),
            None => seconds(secs),
        }
    }
}

fn name(word: usize) -> Name {
    format!("w{word}").into()
}

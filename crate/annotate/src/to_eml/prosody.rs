//! Prosody as containers around words.

use raconteur_eml::TextSegment;

use super::elements;
use crate::gestura::Prosody;
use crate::script::Builder;

/// Containers of the words of one utterance, properly nested.
#[derive(Default)]
pub(super) struct Containers {
    /// Segments without content, with the number of the word that they precede.
    before: Vec<(usize, TextSegment)>,
    /// Containers, outer ones first, with the numbers of their first and last word.
    around: Vec<(usize, usize, TextSegment)>,
}

impl Containers {
    /// Returns the segments without content before a word.
    pub(super) fn before(&self, index: usize) -> impl Iterator<Item = &TextSegment> {
        self.before
            .iter()
            .filter(move |(at, _)| *at == index)
            .map(|(_, segment)| segment)
    }

    /// Returns the containers that open at a word, outer ones first.
    pub(super) fn opening(&self, index: usize) -> impl Iterator<Item = &TextSegment> {
        self.around
            .iter()
            .filter(move |(first, ..)| *first == index)
            .map(|(.., segment)| segment)
    }

    /// Returns the number of containers that close after a word.
    pub(super) fn closing(&self, index: usize) -> usize {
        self.around
            .iter()
            .filter(|(_, last, _)| *last == index)
            .count()
    }
}

/// Returns the containers of some words, in the order of time. A container that crosses another one
/// ends where that one ends, with a note.
pub(super) fn of_words(builder: &mut Builder, all: &[Prosody], words: &[usize]) -> Containers {
    let mut found: Vec<(usize, usize, &Prosody)> = Vec::new();
    for prosody in all {
        let inside = |word: &usize| prosody.words.contains(word);
        if let (Some(first), Some(last)) = (
            words.iter().position(inside),
            words.iter().rposition(inside),
        ) {
            found.push((first, last, prosody));
        }
    }
    // Outer containers first; of equal ones, the first in the file.
    found.sort_by_key(|&(first, last, _)| (first, std::cmp::Reverse(last)));
    let mut containers = Containers::default();
    let mut open: Vec<usize> = Vec::new();
    for (first, last, prosody) in found {
        let problems = &mut builder.problems;
        let read = elements::segment(
            &prosody.element,
            &prosody.attributes,
            prosody.span,
            problems,
        );
        let Some((segment, is_container)) = read else {
            continue;
        };
        if !is_container {
            containers.before.push((first, segment));
            continue;
        }
        while open.last().is_some_and(|&end| end < first) {
            open.pop();
        }
        let end = open.last().map_or(last, |&outer| last.min(outer));
        if end < last {
            let message = format!(
                "the {} ends with the one around its first word",
                prosody.element
            );
            builder.note("gestura::overlap", prosody.span, message);
        }
        open.push(end);
        containers.around.push((first, end, segment));
    }
    containers
}

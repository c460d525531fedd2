//! Distribution of words between pauses, where only their letters and punctuation are known.
//!
//! Every longer pause is the end of some word. The selected sequence needs the least stretching of
//! the words in between, and the fewest pauses without punctuation and commas without a pause. The
//! weights are *designed*.

/// Unit spoken as one word, to which a share of the audio is assigned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct SpokenUnit<'a> {
    /// Letters of the unit.
    pub(in super::super) text: &'a str,
    /// True if punctuation follows it.
    pub(in super::super) ends: bool,
}

/// Pause between audible stretches of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pause {
    /// Audible time before the pause, seconds.
    pub(super) at_secs: f64,
    /// Seconds of quiet.
    pub(super) length_secs: f64,
}

/// Shortest pause that is the end of a word, seconds.
const MIN_SECS: f64 = 0.15;
/// Cost of a pause without punctuation, and of punctuation without a pause.
const BARE: f64 = 0.3;
const PASSED: f64 = 0.1;
/// Time added to the expected length of a stretch, seconds, so that short ones may vary.
const SLACK_SECS: f64 = 0.2;
/// Number of words before and after the expected one that are tried for each pause.
const REACH: usize = 24;

/// Words, and the positions at which they end if all letters take the same time.
pub(super) struct Words {
    /// Letters up to the end of each word, from 0 before the first.
    letters: Vec<f64>,
    /// Words with punctuation up to each, likewise.
    punctuated: Vec<f64>,
}

impl Words {
    pub(super) fn from_units(words: &[SpokenUnit<'_>]) -> Self {
        let (mut letters, mut punctuated) = (vec![0.0], vec![0.0]);
        for word in words {
            let count = word.text.chars().filter(|c| c.is_alphanumeric()).count();
            letters.push(letters[letters.len() - 1] + count.max(1) as f64);
            punctuated.push(punctuated[punctuated.len() - 1] + f64::from(u8::from(word.ends)));
        }
        Self {
            letters,
            punctuated,
        }
    }

    pub(super) fn count(&self) -> usize {
        self.letters.len() - 1
    }

    /// Letters from the end of one word to that of another.
    pub(super) fn between(&self, from: usize, to: usize) -> f64 {
        self.letters[to] - self.letters[from]
    }

    /// Returns the cost of a duration for the words after `from` up to `to`.
    fn cost(&self, from: usize, to: usize, secs: f64, secs_a_letter: f64) -> f64 {
        let expected = self.between(from, to) * secs_a_letter;
        let passed = self.punctuated[to] - self.punctuated[from];
        let own = self.punctuated[to] - self.punctuated[to - 1];
        let bare = if to < self.count() {
            BARE * (1.0 - own)
        } else {
            0.0
        };
        (secs - expected).powi(2) / (expected + SLACK_SECS) + PASSED * (passed - own) + bare
    }

    /// Pauses that are ends of words: the longest, if there are more than that.
    fn longest_pauses(&self, pauses: &[Pause], total_secs: f64) -> Vec<f64> {
        let inner = |p: &&Pause| p.at_secs > 0.0 && p.at_secs < total_secs;
        let long = |p: &&Pause| p.length_secs >= MIN_SECS;
        let mut kept: Vec<&Pause> = pauses.iter().filter(inner).filter(long).collect();
        kept.sort_by(|a, b| b.length_secs.total_cmp(&a.length_secs));
        kept.truncate(self.count().saturating_sub(1));
        let mut times: Vec<f64> = kept.into_iter().map(|p| p.at_secs).collect();
        times.sort_by(f64::total_cmp);
        times
    }

    /// Returns the known ends of words: the number of words before, and the audible time in
    /// seconds, from start to end.
    pub(super) fn anchors(&self, pauses: &[Pause], total_secs: f64) -> Vec<(usize, f64)> {
        let mut times = vec![0.0];
        times.extend(self.longest_pauses(pauses, total_secs));
        times.push(total_secs);
        let secs_a_letter = total_secs / self.between(0, self.count()).max(1.0);
        // For each time, the words that may end there, with the least cost and the index of the
        // predecessor in the previous row.
        let mut rows: Vec<Vec<(usize, f64, usize)>> = vec![vec![(0, 0.0, 0)]];
        for (i, pair) in times.windows(2).enumerate() {
            let left = times.len() - 2 - i;
            let expected = pair[1] / secs_a_letter;
            let middle = self.letters.partition_point(|l| *l < expected);
            let (least, most) = match left {
                0 => (self.count(), self.count()),
                _ => (middle.saturating_sub(REACH), middle + REACH),
            };
            let cost = |from, to| self.cost(from, to, pair[1] - pair[0], secs_a_letter);
            let row =
                (least.max(1)..=most.min(self.count().saturating_sub(left))).filter_map(|to| {
                    let ways = rows[i].iter().enumerate().filter(|(_, way)| way.0 < to);
                    let ways = ways.map(|(k, way)| (to, way.1 + cost(way.0, to), k));
                    ways.min_by(|a, b| a.1.total_cmp(&b.1))
                });
            let row = row.collect();
            rows.push(row);
        }
        let mut anchors = Vec::with_capacity(rows.len());
        let mut place = 0;
        for (row, secs) in rows.iter().rev().zip(times.iter().rev()) {
            // No solution: pauses are too close together for words between them.
            let Some((word, _, before)) = row.get(place) else {
                return vec![(0, 0.0), (self.count(), total_secs)];
            };
            anchors.push((*word, *secs));
            place = *before;
        }
        anchors.reverse();
        anchors
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spoken_words(text: &str) -> Vec<SpokenUnit<'_>> {
        let words = text.split(' ');
        words
            .map(|text| SpokenUnit {
                text,
                ends: text.ends_with([',', '.']),
            })
            .collect()
    }

    fn ends(text: &str, pauses: &[(f64, f64)], total: f64) -> Vec<usize> {
        let pauses: Vec<Pause> = pauses
            .iter()
            .map(|&(at_secs, length_secs)| Pause {
                at_secs,
                length_secs,
            })
            .collect();
        let anchors = Words::from_units(&spoken_words(text)).anchors(&pauses, total);
        assert_eq!(anchors[0], (0, 0.0));
        assert!(
            anchors.is_sorted_by(|a, b| a.0 < b.0 && a.1 <= b.1) || anchors.len() == 2,
            "the anchors are sorted"
        );
        anchors.into_iter().map(|a| a.0).collect()
    }

    #[test]
    fn pauses_are_where_punctuation_is_near() {
        let text = "one two, three four five, six";
        assert_eq!(ends(text, &[(0.7, 0.4), (1.6, 0.4)], 2.0), [0, 2, 5, 6]);
        // A short pause does not count, and one far from any comma follows the nearest word.
        assert_eq!(ends(text, &[(0.7, 0.1)], 2.0), [0, 6]);
        assert_eq!(ends("one two six ten", &[(1.0, 0.4)], 2.0), [0, 2, 4]);
    }

    #[test]
    fn more_pauses_than_words_and_no_words_at_all() {
        assert_eq!(
            ends("one two", &[(0.2, 0.2), (0.5, 0.9), (0.7, 0.3)], 1.0),
            [0, 1, 2]
        );
        assert_eq!(ends("one", &[(0.5, 0.9)], 1.0), [0, 1]);
        assert_eq!(Words::from_units(&[]).anchors(&[], 1.0).len(), 2);
        let far = "a ".repeat(200) + "b";
        let many: Vec<(f64, f64)> = (1..100).map(|i| (0.001 * f64::from(i), 0.3)).collect();
        ends(&far, &many, 60.0);
    }
}

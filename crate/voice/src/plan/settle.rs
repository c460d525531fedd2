//! Assignment of isolated signs to the preceding or the following word.

use super::{Planner, Waiting};
use raconteur_base::text::script::Script;
use raconteur_base::text::signs;

impl Planner<'_> {
    /// Assigns the signs since the last word to it, or to the `next`, which is then the last.
    pub(super) fn settle_signs(&mut self, next: Option<(&str, usize, Option<usize>)>) {
        let signs = core::mem::take(&mut self.signs);
        // After a pause, they belong to the following word.
        let previous = self.waiting.last().map(|_| self.plan.words.len() - 1);
        let count = signs::belonging_to_previous(
            &signs.iter().map(String::as_str).collect::<Vec<_>>(),
            previous.map(|word| self.plan.words[word].as_str()),
            next.map(|(text, ..)| text),
        );
        let (before, after) = signs.split_at(count);
        if let Some(word) = previous {
            for sign in before {
                signs::attach(&mut self.plan.words[word], sign);
                self.wait_sign(word, sign, next.and_then(|(_, _, together)| together));
            }
        }
        let Some((text, style, together)) = next else {
            return;
        };
        let script = Script::from_word(text).filter(|script| !script.is_read_in(self.language));
        let other = self.waiting.last().is_some_and(|w| {
            w.together != together || !self.alike(w.style, style) || self.script != script
        });
        if other {
            self.flush_pending();
        }
        self.script = script;
        let word = self.plan.words.len();
        for sign in after {
            self.waiting.push(Waiting {
                word,
                is_sign: true,
                text: sign.clone(),
                after: String::new(),
                style,
                together,
            });
        }
        self.plan
            .words
            .push([after, &[text.to_owned()]].concat().join(" "));
    }

    /// Queues signs after a word, to be read with it. `next` is the group of the word after them.
    fn wait_sign(&mut self, word: usize, sign: &str, next: Option<usize>) {
        let Some(last) = self.waiting.last_mut() else {
            return;
        };
        // A token for several words, or a group of words, already contains the inner signs.
        if last.together.is_some() {
            let signs = match last.together == next {
                true => &mut last.text,
                false => &mut last.after,
            };
            let is_dash = sign.contains(['-', '\u{2013}', '\u{2014}']);
            signs.push_str(if is_dash { "," } else { sign });
            return;
        }
        let style = last.style;
        self.waiting.push(Waiting {
            word,
            is_sign: true,
            text: sign.to_owned(),
            after: String::new(),
            style,
            together: None,
        });
    }
}

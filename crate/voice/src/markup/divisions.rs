//! Boundaries of sentences and paragraphs, as elements around the text in between.

use super::build::is_blank;
use crate::content::{Division, Segment};

/// Start or end tag of a division (sentence, paragraph) in a document to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DivisionTag {
    Start(Division),
    End(Division),
    /// A point that has no other to reach to.
    Empty(Division),
}

/// Returns the tags before each segment; most have none. Elements never cross the borders of
/// markup. Parsed again, they divide the same words in the same way.
pub(crate) fn tags(segments: &[Segment]) -> Vec<Vec<DivisionTag>> {
    let mut tags = vec![Vec::new(); segments.len()];
    // For each open markup, its divisions: position and kind.
    let mut levels: Vec<Vec<(usize, Division)>> = vec![Vec::new()];
    let mut is_behind_division = false;
    for (place, segment) in segments.iter().enumerate() {
        match segment {
            Segment::Division(division) => {
                let level = levels.last_mut();
                match level {
                    Some(level) if is_behind_division => {
                        if let (Some(last), Division::Paragraph) = (level.last_mut(), division) {
                            last.1 = *division;
                        }
                    }
                    Some(level) => level.push((place, *division)),
                    None => {}
                }
                is_behind_division = true;
            }
            _ if is_blank(segment) => {}
            _ => {
                is_behind_division = false;
                match segment {
                    Segment::Open(_) => levels.push(Vec::new()),
                    Segment::Close if levels.len() > 1 => {
                        pair(&levels.pop().unwrap_or_default(), &mut tags);
                    }
                    _ => {}
                }
            }
        }
    }
    for level in &levels {
        pair(level, &mut tags);
    }
    tags
}

/// Makes elements of the divisions of one level.
fn pair(level: &[(usize, Division)], tags: &mut [Vec<DivisionTag>]) {
    use Division::{Paragraph, Sentence};
    let is_paragraph = |&(_, division): &(usize, Division)| division == Paragraph;
    let first = level.iter().position(is_paragraph).unwrap_or(level.len());
    let last = level.iter().rposition(is_paragraph).unwrap_or(0);
    // For the text between two divisions: whether it is in a paragraph, and whether it is a
    // sentence.
    let in_paragraph = |i: usize| i >= first && i < last;
    let is_sentence = |i: usize| {
        let whole = is_paragraph(&level[i]) && is_paragraph(&level[i + 1]);
        !(in_paragraph(i) && whole)
    };
    for (i, (place, division)) in level.iter().enumerate() {
        let Some(out) = tags.get_mut(*place) else {
            continue;
        };
        let has_next = i + 1 < level.len();
        let ends = *division == Paragraph && i > 0 && in_paragraph(i - 1);
        let starts = *division == Paragraph && has_next && in_paragraph(i);
        if i > 0 && is_sentence(i - 1) {
            out.push(DivisionTag::End(Sentence));
        }
        if ends {
            out.push(DivisionTag::End(Paragraph));
        }
        if level.len() == 1 || (*division == Paragraph && !ends && !starts) {
            out.push(DivisionTag::Empty(*division));
        }
        if starts {
            out.push(DivisionTag::Start(Paragraph));
        }
        if has_next && is_sentence(i) {
            out.push(DivisionTag::Start(Sentence));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::Markup;

    /// Segments from signs: `S` and `P` part, brackets are markup, the rest is text.
    fn written(signs: &str) -> String {
        let segments: Vec<_> = signs
            .chars()
            .map(|c| match c {
                'S' => Segment::Division(Division::Sentence),
                'P' => Segment::Division(Division::Paragraph),
                '[' => Segment::Open(Markup::Other),
                ']' => Segment::Close,
                c => Segment::Text(c.to_string()),
            })
            .collect();
        let name = |d: &Division| if *d == Division::Sentence { 's' } else { 'p' };
        let mut out = String::new();
        for (c, tags) in signs.chars().zip(tags(&segments)) {
            if !matches!(c, 'S' | 'P') {
                out.push(c);
            }
            for tag in tags {
                out += &match &tag {
                    DivisionTag::Start(d) => format!("<{}>", name(d)),
                    DivisionTag::End(d) => format!("</{}>", name(d)),
                    DivisionTag::Empty(d) => format!("<{}/>", name(d)),
                };
            }
        }
        out
    }

    #[test]
    fn divisions_reach_to_the_next_one() {
        for (signs, elements) in [
            ("PaP PbP", "<p>a</p><p> b</p>"),
            ("PSaSSbSP", "<p><s>a</s><s>b</s></p>"),
            ("PaSbP", "<p><s>a</s><s>b</s></p>"),
            ("SaPbP", "<s>a</s><p>b</p>"),
            ("SaPbS", "<s>a</s><p/><s>b</s>"),
            ("PaPbScP", "<p>a</p><p><s>b</s><s>c</s></p>"),
            ("a[bSc]dSe", "a[b<s/>c]d<s/>e"),
            ("Sa[SbS]S", "<s>a[<s>b</s>]</s>"),
            ("]S a [P", "]<s/> a [<p/>"),
        ] {
            assert_eq!(written(signs), elements, "{signs}");
        }
    }
}

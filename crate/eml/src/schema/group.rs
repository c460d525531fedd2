//! Common parts of seq and par: repetition and the contained clauses.

use super::{Attribute, Context, Fields};
use crate::Group;

/// The attributes of both.
pub(super) static REPETITION: &[Attribute] = &[
    Attribute::integer(
        "repetitionCount",
        1,
        u32::MAX as i64,
        "The number of repetitions of the content. Names inside refer to the first one.",
    )
    .aliases(&["repeatCount"])
    .default("1"),
    Attribute::seconds(
        "duration",
        "The length of one repetition; clauses that still play then are cut. By default as long as the content.",
    )
    .aliases(&["dur"]),
];

/// Reads the attributes of a group, without its children.
pub(crate) fn read(cx: &mut Context<'_>, fields: &Fields<'_>) -> Group {
    let count = cx.number(fields, "repetitionCount");
    Group {
        children: Vec::new(),
        repetition_count: count.map_or(1, |n| n as u32),
        repetition_span: fields.span_of("repetitionCount"),
        iteration_secs: cx.number(fields, "duration"),
    }
}

//! What seq and par have in common: repetition and the clauses inside.

use super::{Attribute, Context, Fields, Kind, Presence};
use crate::Group;

/// The attributes of both.
pub(super) static REPETITION: &[Attribute] = &[
    Attribute {
        name: "repetitionCount",
        aliases: &["repeatCount"],
        kind: Kind::Integer {
            least: 1,
            most: u32::MAX as i64,
        },
        default: Presence::Default("1"),
        doc: "How often the content plays. Names inside mean the first time.",
    },
    Attribute {
        name: "duration",
        aliases: &["dur"],
        kind: Kind::Seconds,
        default: Presence::Optional,
        doc: "The length of one repetition in seconds: what still plays then is cut. As long as \
              the content when left out.",
    },
];

/// Reads the attributes of a group, without its children.
pub(crate) fn read(cx: &mut Context<'_>, fields: &Fields<'_>) -> Group {
    let count = cx
        .integer(fields, "repetitionCount")
        .and_then(|n| u32::try_from(n).ok());
    Group {
        children: Vec::new(),
        repetition_count: count.unwrap_or(1),
        repetition_span: fields.span_of("repetitionCount"),
        iteration_secs: cx.seconds(fields, "duration"),
    }
}

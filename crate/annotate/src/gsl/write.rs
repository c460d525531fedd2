//! Writer: each value has one text, from which it is read again.

use std::fmt;

use super::{Feature, Item, Offset, Sequence, Value};

impl<F: Feature> fmt::Display for Value<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Common(sequence) => sequence.fmt(f),
            Self::PerHand { right, left } => {
                let hands = [("RH", right), ("LH", left)];
                let given = hands
                    .iter()
                    .filter_map(|(label, s)| Some((label, s.as_ref()?)));
                for (index, (label, sequence)) in given.enumerate() {
                    let separator = if index == 0 { "" } else { ";" };
                    write!(f, "{separator}{label}={sequence}")?;
                }
                Ok(())
            }
        }
    }
}

impl<F: Feature> fmt::Display for Sequence<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut out = String::new();
        // A timed pair alone in a list of one is a sequence of it, in all features.
        let is_list = self.items.len() != 1 || self.items[0].offset.is_some();
        if is_list {
            out.push('[');
        }
        for (index, item) in self.items.iter().enumerate() {
            if index > 0 {
                out.push(';');
            }
            write_item(item, &mut out);
        }
        if is_list {
            out.push(']');
        }
        f.write_str(&out)
    }
}

fn write_item<F: Feature>(item: &Item<F>, out: &mut String) {
    let Some(offset) = item.offset else {
        item.feature.write(out);
        return;
    };
    let time = match offset {
        // With a decimal point, a time differs from the number of a hand shape.
        Offset::Secs(secs) if secs.fract() == 0.0 => format!("{:.1}", secs + 0.0),
        Offset::Secs(secs) => secs.to_string(),
        Offset::Percent(percent) => format!("{}%", percent + 0.0),
    };
    out.push_str(&format!("[{time};"));
    item.feature.write(out);
    out.push(']');
}

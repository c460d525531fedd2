//! Random changes of a file.

use proptest::prelude::*;

/// A change of a file at any position.
#[derive(Clone, Debug)]
pub(crate) enum Edit {
    Delete(usize, usize),
    Insert(usize, &'static str),
    Copy(usize, usize, usize),
    Byte(usize, u8),
}

/// Any edit, mostly of markup.
pub(crate) fn edit() -> impl Strategy<Value = Edit> {
    let markup = [
        "<",
        ">",
        "/>",
        "</",
        "'",
        "\"",
        "&",
        "&#x0;",
        "&xxe;",
        "<![CDATA[",
        "]]>",
        "<!--",
        "-->",
        "<?",
        "?>",
        "<!DOCTYPE x [",
        "<seq time='0'>",
        "</seq>",
        "<par time='t1'",
        "time='t2'",
        " timeId='t1'",
        " repetitionCount='9999'",
        "1e309",
        "NaN",
        "-",
        "é😀",
        "\0",
        "<key ",
        "<tm name='t1'/>",
        "duration='0'",
    ];
    let at = any::<usize>();
    prop_oneof![
        (at, 0_usize..30).prop_map(|(i, n)| Edit::Delete(i, n)),
        (at, prop::sample::select(markup.to_vec())).prop_map(|(i, s)| Edit::Insert(i, s)),
        (at, 0_usize..80, at).prop_map(|(i, n, to)| Edit::Copy(i, n, to)),
        (at, any::<u8>()).prop_map(|(i, b)| Edit::Byte(i, b)),
    ]
}

/// Makes an edit.
pub(crate) fn apply(source: &mut Vec<u8>, edit: &Edit) {
    let at = |i: usize| i % (source.len() + 1);
    match *edit {
        Edit::Delete(i, n) => {
            let start = at(i);
            let end = (start + n).min(source.len());
            source.drain(start..end);
        }
        Edit::Insert(i, text) => {
            let start = at(i);
            source.splice(start..start, text.bytes());
        }
        Edit::Copy(i, n, to) => {
            let (start, to) = (at(i), at(to));
            let end = (start + n).min(source.len());
            let part = source[start..end].to_vec();
            source.splice(to..to, part);
        }
        Edit::Byte(i, b) => {
            let start = at(i);
            if let Some(byte) = source.get_mut(start) {
                *byte = b;
            }
        }
    }
}

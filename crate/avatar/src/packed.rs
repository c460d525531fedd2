//! Views compressed by `EXT_meshopt_compression`, with its filters.

use meshoptimizer_rs::codec::{BufferView, Filter, Mode};
use meshoptimizer_rs::{Error, Workspace};
use raconteur_body::read::ReadError;
use raconteur_body::read::packed::EXTENSION;
use serde_json::Value;

/// Returns the part of a view's JSON that describes its stream.
pub(super) fn stream_of(view: &Value) -> Option<&Value> {
    view["extensions"].get(EXTENSION)
}

/// Returns true if a buffer is an empty fallback, which programs that support the extension do not
/// read.
pub(super) fn is_fallback(buffer: &Value) -> bool {
    buffer["extensions"][EXTENSION]["fallback"].as_bool() == Some(true)
}

/// Decompresses a buffer view from its stream, at most `most` bytes; `describe` is the JSON of the
/// compression extension.
pub(super) fn unpack(
    view: &Value,
    describe: &Value,
    stream: &[u8],
    most: usize,
) -> Result<Vec<u8>, ReadError> {
    let number = |of: &Value, key: &str| of[key].as_u64().and_then(|n| usize::try_from(n).ok());
    let needed = |key: &str| number(describe, key).ok_or(Error::InvalidParameter);
    let layout = || {
        let mode = Mode::parse(describe["mode"].as_str().unwrap_or_default())?;
        let filter = Filter::parse(describe["filter"].as_str().unwrap_or("NONE"))?;
        let layout = BufferView::new(mode, filter, needed("count")?, needed("byteStride")?)?;
        let length = number(view, "byteLength").unwrap_or(0);
        layout.validate_parent(length, number(view, "byteStride"))?;
        Ok(layout)
    };
    let broken = |_: Error| ReadError::Packed { what: "a view" };
    let layout = layout().map_err(broken)?;
    if layout.byte_length() > most {
        return Err(ReadError::TooLarge);
    }
    layout
        .decode(stream, &mut Workspace::default())
        .map_err(broken)
}

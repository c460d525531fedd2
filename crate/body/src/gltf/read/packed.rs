//! Views compressed by `EXT_meshopt_compression`, without filters: filters lose precision,
//! generated files have none, and they would add 3 KB to players. The decoder allocates only as
//! much as a stream can contain, and rejects invalid streams.

use meshoptimizer_rs::Workspace;
use meshoptimizer_rs::codec::{
    Mode, decode_index_buffer, decode_index_sequence, decode_vertex_buffer,
};
use serde_json::Value;

use super::ReadError;

/// Name of the glTF extension for compressed buffer views.
pub const EXTENSION: &str = "EXT_meshopt_compression";

/// Location and format of the compressed stream of a buffer view.
pub struct CompressedView {
    buffer: usize,
    byte_offset: usize,
    byte_length: usize,
    stride: usize,
    count: usize,
    /// Compression mode; `None` for an unsupported kind.
    mode: Option<Mode>,
}

impl CompressedView {
    /// Parses the JSON of a view, if the view is compressed.
    pub(super) fn from_json(view: &Value) -> Option<Self> {
        let stream = view["extensions"].get(EXTENSION)?;
        let number = |key: &str| stream[key].as_u64().and_then(|n| usize::try_from(n).ok());
        // A missing required field becomes an out-of-range value.
        let needed = |key: &str| number(key).unwrap_or(usize::MAX);
        let unfiltered = stream["filter"].as_str().is_none_or(|f| f == "NONE");
        let mode = stream["mode"].as_str().filter(|_| unfiltered);
        Some(Self {
            buffer: needed("buffer"),
            byte_offset: number("byteOffset").unwrap_or(0),
            byte_length: needed("byteLength"),
            stride: needed("byteStride"),
            count: needed("count"),
            mode: mode.and_then(|m| Mode::parse(m).ok()),
        })
    }

    /// Decompresses the view to `length` bytes, with the view's own stride if it has one.
    pub(super) fn unpack(
        &self,
        bin: &[u8],
        length: usize,
        stride: Option<usize>,
        what: &'static str,
    ) -> Result<Vec<u8>, ReadError> {
        let mode = self
            .mode
            .ok_or_else(|| ReadError::Extension(format!("{EXTENSION} with a filter")))?;
        if self.buffer != 0 {
            return Err(ReadError::OutOfRange { what });
        }
        let end = self.byte_offset.checked_add(self.byte_length);
        let stream = end.and_then(|end| bin.get(self.byte_offset..end));
        let stream = stream.ok_or(ReadError::Truncated { what })?;
        let fits = self.count.checked_mul(self.stride) == Some(length)
            && stride.is_none_or(|s| s == self.stride);
        let decode = match mode {
            Mode::Attributes => decode_vertex_buffer,
            Mode::Triangles => decode_index_buffer,
            Mode::Indices => decode_index_sequence,
        };
        if !fits {
            return Err(ReadError::Packed { what });
        }
        decode(self.count, self.stride, stream, &mut Workspace::default())
            .map_err(|_| ReadError::Packed { what })
    }
}

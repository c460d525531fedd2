//! Tissue of a face and its mesh bindings, read from three accessors named by a mesh's extras:
//! nodes and weights, row by row, and their number for each vertex.

use super::accessor::Source;
use super::document::Mesh;
use super::{ReadError, same_count};
use crate::face::file::from_bytes;
use crate::face::{Binding, Tissue};

/// The arrangement that is understood.
const VERSION: u64 = 1;

/// Messages of faults.
const BINDING: &str = "a binding to tissue";

/// Reads the facial tissue of a figure; `None` if the file has none.
pub(super) fn tissue(source: &mut Source<'_>) -> Result<Option<Tissue>, ReadError> {
    let Some(view) = source.root.tissue else {
        return Ok(None);
    };
    let bytes = source.view_bytes(view, "the tissue of the face")?;
    Ok(Some(from_bytes(&bytes)?))
}

/// Reads the binding of a mesh of `count` vertices to the facial tissue; `None` if it has none. The
/// weights of a vertex sum to at most 1.
pub(super) fn binding(
    source: &mut Source<'_>,
    mesh: &Mesh,
    count: usize,
) -> Result<Option<Binding>, ReadError> {
    let Some(b) = &mesh.binding else {
        return Ok(None);
    };
    if b.version != VERSION {
        return Err(ReadError::Type { what: BINDING });
    }
    let counts = same_count(source.integers::<1>(b.counts, BINDING)?, count, BINDING)?;
    let nodes = source.integers::<1>(b.nodes, BINDING)?;
    let weights = same_count(
        source.integers::<1>(b.weights, BINDING)?,
        nodes.len(),
        BINDING,
    )?;
    let out_of_range = || ReadError::OutOfRange { what: BINDING };
    let mut out = Binding {
        starts: vec![0],
        ..Binding::default()
    };
    let mut end = 0usize;
    for (vertex, [size]) in (0u32..).zip(counts) {
        if size == 0 {
            continue;
        }
        let start = end;
        end = end.saturating_add(size as usize);
        let row = weights.get(start..end).ok_or_else(out_of_range)?;
        // In 255ths.
        if row.iter().map(|[w]| u64::from(*w)).sum::<u64>() > 255 {
            return Err(out_of_range());
        }
        out.vertices.push(vertex);
        out.starts.push(end as u32);
    }
    if end != nodes.len() {
        return Err(ReadError::Count { what: BINDING });
    }
    for [node] in nodes {
        out.nodes
            .push(u16::try_from(node).map_err(|_| out_of_range())?);
    }
    out.weights = weights.iter().map(|[w]| *w as f32 / 255.0).collect();
    Ok(Some(out))
}

//! Mesh bindings to the tissue of a face, as three accessors: the number of nodes for each vertex
//! (0: none), and row by row the nodes and their weights in 255ths. Without vertex attributes and
//! extensions, other readers accept the file unchanged.

use serde_json::{Value, json};

use super::buffer::{Buffer, Packing, UNSIGNED_BYTE, UNSIGNED_SHORT};
use crate::face::Binding;

/// The arrangement, as the file states it.
const VERSION: u32 = 1;

/// Writes a valid binding of a mesh of `count` vertices; returns the content of its extras.
pub(super) fn write(buffer: &mut Buffer, binding: &Binding, count: usize) -> Value {
    let mut counts = vec![0u8; count];
    let mut nodes = Vec::new();
    let mut weights = Vec::new();
    for (&vertex, ends) in binding.vertices.iter().zip(binding.starts.windows(2)) {
        let row = ends[0] as usize..ends[1] as usize;
        let bound = binding.nodes[row.clone()].iter().copied();
        let mut heavy: Vec<(u16, f32)> = bound.zip(binding.weights[row].iter().copied()).collect();
        if heavy.is_empty() {
            heavy.push((0, 0.0));
        }
        // A byte counts them.
        heavy.sort_by(|a, b| b.1.total_cmp(&a.1));
        heavy.truncate(255);
        let quantised = row_in_255ths(&heavy);
        // Nodes with zero weight are omitted, but one remains, because a bound vertex does not
        // follow the jaw.
        let kept = quantised.iter().filter(|w| **w > 0).count().max(1);
        counts[vertex as usize] = kept as u8;
        for ((node, _), weight) in heavy.iter().zip(quantised).take(kept) {
            nodes.extend(node.to_le_bytes());
            weights.push(weight);
        }
    }
    let entries = weights.len();
    let bytes = Packing::Attributes { stride: 4 };
    let indices = Packing::Indices { width: 2 };
    let mut list = |bytes: &[u8], packing: Packing, component: u32, count: usize| {
        let view = buffer.packable(bytes, packing);
        json!({
            "bufferView": view, "componentType": component, "count": count, "type": "SCALAR",
        })
    };
    let counts = list(&counts, bytes, UNSIGNED_BYTE, count);
    let nodes = list(&nodes, indices, UNSIGNED_SHORT, entries);
    let mut weights = list(&weights, bytes, UNSIGNED_BYTE, entries);
    weights["normalized"] = json!(true);
    json!({
        "version": VERSION,
        "counts": buffer.accessor(counts),
        "nodes": buffer.accessor(nodes),
        "weights": buffer.accessor(weights),
    })
}

/// Returns weights, heaviest first, in 255ths whose sum is the sum's own 255ths: the loss by
/// rounding down goes to the largest remainders, which keeps the order.
fn row_in_255ths(row: &[(u16, f32)]) -> Vec<u8> {
    let exact: Vec<f64> = row.iter().map(|(_, w)| f64::from(*w) * 255.0).collect();
    let total = exact.iter().sum::<f64>().round().min(255.0) as usize;
    let mut out: Vec<u8> = exact.iter().map(|x| x.floor() as u8).collect();
    let given: usize = out.iter().map(|w| usize::from(*w)).sum();
    let mut order: Vec<usize> = (0..row.len()).collect();
    order.sort_by(|&a, &b| exact[b].fract().total_cmp(&exact[a].fract()));
    for &i in order.iter().take(total.saturating_sub(given)) {
        out[i] = out[i].saturating_add(1);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_sum_and_their_order() {
        let row = |weights: &[f32]| -> Vec<u8> {
            row_in_255ths(&weights.iter().map(|w| (0, *w)).collect::<Vec<_>>())
        };
        let sum = |row: &[u8]| row.iter().map(|w| u32::from(*w)).sum::<u32>();
        assert_eq!(row(&[1.0]), [255]);
        assert_eq!(row(&[1.0 / 3.0; 3]), [85; 3]);
        let seventh = row(&[1.0 / 7.0; 7]);
        assert_eq!(sum(&seventh), 255);
        assert!(
            seventh.iter().all(|w| (36..=37).contains(w)),
            "the seven weights are 36 or 37 each"
        );
        // Half a row stays half.
        assert_eq!(sum(&row(&[0.3, 0.2])), 128);
        let many = row(&[0.5, 0.2, 0.1, 0.1, 0.0951, 0.003, 0.0019]);
        assert_eq!(sum(&many), 255);
        assert!(many.is_sorted_by(|a, b| a >= b), "{many:?}");
        assert!(row(&[]).is_empty(), "an empty row stays empty");
    }
}

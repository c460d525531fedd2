//! JSON fields of a document. A field of a wrong type counts as absent.

use serde_json::Value;

/// Returns a JSON value as a list index.
pub(super) fn as_index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

pub(super) fn items<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}

pub(super) fn index(value: &Value, key: &str) -> Option<usize> {
    as_index(&value[key])
}

/// Returns a required index; `usize::MAX` if it is absent or invalid.
pub(super) fn needed_index(value: &Value, key: &str) -> usize {
    index(value, key).unwrap_or(usize::MAX)
}

pub(super) fn indices(value: &Value, key: &str) -> Vec<usize> {
    items(value, key)
        .iter()
        .map(|v| as_index(v).unwrap_or(usize::MAX))
        .collect()
}

pub(super) fn whole(value: &Value, key: &str) -> u64 {
    value[key].as_u64().unwrap_or(0)
}

pub(super) fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or_default().to_owned()
}

pub(super) fn texts(value: &Value, key: &str) -> Vec<String> {
    items(value, key)
        .iter()
        .filter_map(Value::as_str)
        .map(str::to_owned)
        .collect()
}

pub(super) fn numbers<const N: usize>(value: &Value, key: &str) -> Option<[f64; N]> {
    let list = items(value, key);
    if list.len() != N {
        return None;
    }
    let mut out = [0.0; N];
    for (o, v) in out.iter_mut().zip(list) {
        *o = v.as_f64()?;
    }
    Some(out)
}

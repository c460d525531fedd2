//! Map as a sorted list: built once, read often.

use std::borrow::Borrow;

/// Map stored as a list sorted by key; built in one step and then mostly read.
#[derive(Clone, Debug, PartialEq)]
pub struct SortedMap<K, V> {
    entries: Vec<(K, V)>,
}

impl<K, V> Default for SortedMap<K, V> {
    fn default() -> Self {
        Self {
            entries: Vec::new(),
        }
    }
}

impl<K: Ord, V> SortedMap<K, V> {
    /// Creates a map from entries sorted by key, without duplicates.
    pub(crate) fn from_sorted(entries: Vec<(K, V)>) -> Self {
        debug_assert!(entries.is_sorted_by(|a, b| a.0 < b.0));
        Self { entries }
    }

    /// Returns the value of a key, or `None`. O(log n).
    #[must_use]
    pub fn get<Q: Ord + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        let at = self.entries.partition_point(|(k, _)| k.borrow() < key);
        let (found, value) = self.entries.get(at)?;
        (found.borrow() == key).then_some(value)
    }

    /// Returns the entries sorted by key.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&K, &V)> {
        self.entries.iter().map(|(key, value)| (key, value))
    }

    /// Returns the values in key order, mutably.
    pub fn values_mut(&mut self) -> impl ExactSizeIterator<Item = &mut V> {
        self.entries.iter_mut().map(|(_, value)| value)
    }

    /// Returns the number of entries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Returns true if there is no entry.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_found_and_others_are_not() {
        let map = SortedMap::from_sorted(vec![("a".to_owned(), 1), ("c".to_owned(), 3)]);
        assert_eq!((map.get("a"), map.get("c")), (Some(&1), Some(&3)));
        assert_eq!(
            (map.get(""), map.get("b"), map.get("d")),
            (None, None, None)
        );
        let keys: Vec<&String> = map.iter().map(|(key, _)| key).collect();
        assert_eq!(keys, ["a", "c"]);
    }
}

//! Lookup of elements by name in constant time.

use super::{ELEMENTS, Element};

/// Number of slots: more than twice the number of elements, so few names share one.
const SLOTS: usize = 512;
const EMPTY: u8 = u8::MAX;

/// Hash table of element names: for each hash, or the next free slot after it, the first element of
/// a name.
static TABLE: [u8; SLOTS] = build();

const fn build() -> [u8; SLOTS] {
    assert!(
        ELEMENTS.len() * 2 < SLOTS && ELEMENTS.len() < EMPTY as usize,
        "the table has enough slots for its elements"
    );
    let mut table = [EMPTY; SLOTS];
    let mut i = 0;
    while i < ELEMENTS.len() {
        let name = ELEMENTS[i].name.as_bytes();
        // The table is sorted, so entries of one name are adjacent.
        if i == 0 || !same_bytes(name, ELEMENTS[i - 1].name.as_bytes()) {
            let mut slot = hash(name);
            while table[slot] != EMPTY {
                slot = (slot + 1) % SLOTS;
            }
            table[slot] = i as u8;
        }
        i += 1;
    }
    table
}

/// Computes a hash from length, first, middle and last letter, which distinguish most names.
const fn hash(name: &[u8]) -> usize {
    let n = name.len();
    if n == 0 {
        return 0;
    }
    let mixed = n * 37 + name[0] as usize * 5 + name[n / 2] as usize * 19;
    (mixed + name[n - 1] as usize * 83) % SLOTS
}

const fn same_bytes(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}

/// Returns true if two names are equal. Names are short and mostly differ early, so this is faster
/// than a call of the string comparison.
pub(crate) fn same(a: &str, b: &str) -> bool {
    let is_same = |(a, b): (u8, u8)| a == b;
    a.len() == b.len() && (std::ptr::eq(a, b) || a.bytes().zip(b.bytes()).all(is_same))
}

/// Returns all elements with exactly this name, which are contiguous.
pub(super) fn variants(name: &str) -> &'static [&'static Element] {
    let mut slot = hash(name.as_bytes());
    while TABLE[slot] != EMPTY {
        let from = usize::from(TABLE[slot]);
        let found = ELEMENTS[from].name;
        if same(found, name) {
            let others = &ELEMENTS[from + 1..];
            let count = others.iter().position(|e| !same(e.name, found));
            return &ELEMENTS[from..=from + count.unwrap_or(others.len())];
        }
        slot = (slot + 1) % SLOTS;
    }
    &[]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_found_and_others_are_not() {
        for element in ELEMENTS {
            let first = variants(element.name).first();
            assert_eq!(first.map(|e| e.name), Some(element.name));
            let all = ELEMENTS.iter().filter(|e| e.name == element.name).count();
            assert_eq!(variants(element.name).len(), all);
        }
        for name in ["", "emL", "bodyy", "é", "\0"] {
            assert!(variants(name).is_empty(), "{name}");
        }
    }
}

//! Likely meanings of an unknown element name.

use super::{Element, find, find_extension};
use crate::namespaces;
use crate::suggest::nearest;

/// Returns a hint at the element probably meant by an unknown one: its name without the prefix, its
/// extension flag, and its allowed context.
pub(super) fn element_meant(local: &str, extended: bool, parent: &Element) -> Option<String> {
    let of = |extension: bool| {
        let all = super::ELEMENTS.iter();
        all.filter(move |e| e.extension == extension)
    };
    let fitting = |extension: bool| {
        let all = of(extension).filter(|e| e.is_allowed_in(parent.name));
        nearest(local, all.map(|e| e.name))
    };
    let any = |extension: bool| nearest(local, of(extension).map(|e| e.name));
    let plain = |name: &str| format!("did you mean `{name}`?");
    if extended {
        let unprefixed = find(local).filter(|e| !e.extension);
        return unprefixed
            .map(|e| {
                format!(
                    "`{}` is not an extension: write it without the prefix",
                    e.name
                )
            })
            .or_else(|| fitting(true).or_else(|| any(true)).map(plain));
    }
    if let Some(Element { name, .. }) = find_extension(local) {
        return Some(unprefixed(name));
    }
    let prefix = namespaces::EXTENSIONS_PREFIX;
    let bind = bound();
    // For example the thesis's `expression-emotion`, which this language defines.
    let is_word = |e: &&&Element| {
        local
            .split('-')
            .any(|word| word.eq_ignore_ascii_case(e.name))
    };
    let meant = |name: &str| format!("did you mean the extension `{prefix}:{name}`? {bind}");
    of(true)
        .find(is_word)
        .map(|e| meant(e.name))
        .or_else(|| fitting(false).map(plain))
        .or_else(|| fitting(true).map(meant))
        .or_else(|| any(false).map(plain))
        .or_else(|| any(true).map(meant))
}

/// Returns the declaration of the extensions' prefix.
fn bound() -> String {
    let prefix = namespaces::EXTENSIONS_PREFIX;
    format!("bind xmlns:{prefix}='{}' on `eml`", namespaces::EXTENSIONS)
}

/// Returns the correction for an extension's name without its prefix.
pub(super) fn unprefixed(name: &str) -> String {
    let prefix = namespaces::EXTENSIONS_PREFIX;
    format!(
        "`{name}` is an extension: write {prefix}:{name} and {}",
        bound()
    )
}

//! Texts of the language reference, which only documentation shows.

/// Returns a text for readers of the language reference. No page shows it, and it would add 12 KB
/// to a player's download (gzip), so wasm builds omit it.
pub(super) const fn reference_text(text: &'static str) -> &'static str {
    if cfg!(target_arch = "wasm32") {
        ""
    } else {
        text
    }
}

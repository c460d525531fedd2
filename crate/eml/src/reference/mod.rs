//! Description of the language for its reference page, its schema and editors. All of it comes from
//! the table, so that none can disagree with the parser.

mod codes;
mod json;
mod markdown;
mod relax_ng;

use crate::schema::{ELEMENTS, Element};

pub use codes::CODES;
pub use json::json;
pub use markdown::markdown;
pub use relax_ng::relax_ng;

/// Returns the elements allowed in a parent, in the order of the table.
fn children_of(parent: &Element) -> impl Iterator<Item = &'static Element> + Clone {
    let name = parent.name;
    let extension = parent.extension;
    ELEMENTS.iter().copied().filter(move |e| {
        // A name shared by two namespaces would need a prefix here; no such name exists.
        e.parents.contains(&name) && (!extension || e.name != name)
    })
}

/// Returns the displayed name of an element or attribute, with the extension prefix if it is an
/// extension.
fn display_name(extension: bool, name: &str) -> String {
    if extension {
        format!("{}:{name}", crate::EXTENSIONS_PREFIX)
    } else {
        name.to_owned()
    }
}

/// Returns a complete script around an example that is a single clause.
#[must_use]
pub fn whole_example(example: &str) -> String {
    if example.starts_with("<eml") {
        example.to_owned()
    } else {
        format!("<eml><body>{example}</body></eml>")
    }
}

//! Names of languages.

/// Names as SABLE's texts write them, with BCP 47 tags.
const NAMES: [(&str, &str); 24] = [
    ("english", "en"),
    ("german", "de"),
    ("deutsch", "de"),
    ("portuguese", "pt"),
    ("portugu\u{ea}s", "pt"),
    ("spanish", "es"),
    ("espa\u{f1}ol", "es"),
    ("french", "fr"),
    ("fran\u{e7}ais", "fr"),
    ("italian", "it"),
    ("italiano", "it"),
    ("dutch", "nl"),
    ("swedish", "sv"),
    ("danish", "da"),
    ("norwegian", "nb"),
    ("finnish", "fi"),
    ("polish", "pl"),
    ("czech", "cs"),
    ("russian", "ru"),
    ("greek", "el"),
    ("turkish", "tr"),
    ("latin", "la"),
    ("welsh", "cy"),
    ("catalan", "ca"),
];

/// Returns the BCP 47 tag of a language given by its tag or name; `None` if it is neither.
#[must_use]
pub fn tag(name: &str) -> Option<String> {
    let name = name.trim().replace('_', "-");
    let lower = name.to_lowercase();
    if let Some((_, tag)) = NAMES.iter().find(|(n, _)| *n == lower) {
        return Some((*tag).to_owned());
    }
    let mut parts = lower.split('-');
    let language = parts.next()?;
    let fine = (2..=3).contains(&language.len())
        && lower.len() <= 35
        && lower.split('-').all(|part| {
            (1..=8).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_alphanumeric())
        });
    fine.then_some(name)
}

/// Returns the primary language of a tag, without its region, in lower case.
#[must_use]
pub fn primary(tag: &str) -> String {
    let first = tag.split(['-', '_']).next();
    first.unwrap_or_default().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_and_names_are_understood() {
        for (name, expected) in [
            ("German", Some("de")),
            ("pt_PT", Some("pt-PT")),
            ("en-GB", Some("en-GB")),
            ("x", None),
            ("Klingonisch", None),
            ("de; rm", None),
        ] {
            assert_eq!(tag(name).as_deref(), expected, "{name}");
        }
        assert_eq!(primary("pt-PT"), "pt");
    }
}

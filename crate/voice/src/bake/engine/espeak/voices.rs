//! espeak-ng voices: a language, and optionally a variant of its voice.

use std::collections::BTreeSet;

use anyhow::{Result, bail, ensure};

use super::super::VoiceInfo;
use super::{Host, phone_set, set};
use crate::content::Gender;

/// Folder of languages in its data; the next constant is that of variants.
const LANGUAGES: &str = "lang";
const VARIANTS: &str = "voices/!v";

/// Returns the voices of all languages, by name.
pub(super) fn all(host: &dyn Host) -> Result<Vec<VoiceInfo>> {
    let mut out = Vec::new();
    for path in host.files(LANGUAGES)? {
        let about = host.text(&format!("{LANGUAGES}/{path}"))?;
        let file = path.rsplit('/').next().unwrap_or(&path);
        out.extend(voice_of(file, &about));
    }
    out.sort_by(|a: &VoiceInfo, b| a.name.cmp(&b.name));
    Ok(out)
}

/// Returns the voice with a name, with the sex of its variant; `None` for an unknown name.
pub(super) fn named(host: &dyn Host, name: &str) -> Result<Option<VoiceInfo>> {
    let base = file_of(known(name, host)?);
    let found = all(host)?.into_iter().find(|v| v.name == base);
    let Some(voice) = found else {
        return Ok(None);
    };
    let variant = name.split_once('+').map(|(_, variant)| variant);
    let of_variant = match variant {
        Some(variant) => variant_gender(&host.text(&format!("{VARIANTS}/{variant}"))?),
        None => None,
    };
    Ok(Some(VoiceInfo {
        gender: of_variant.or(voice.gender),
        name: name.to_owned(),
        ..voice
    }))
}

/// Validates a voice's name (`de`, `en-us+f2`) and returns its language. A name with other
/// characters could be a path, and the library ignores a missing variant.
pub(super) fn known<'a>(voice: &'a str, host: &dyn Host) -> Result<&'a str> {
    let (base, variant) = voice.split_once('+').unwrap_or((voice, ""));
    let plain = |name: &str| {
        name.bytes()
            .all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_')
    };
    ensure!(
        !base.is_empty() && plain(base) && plain(variant),
        "{voice:?} is not the name of an espeak-ng voice: a language with an optional plus sign and variant, such as en-us+f2"
    );
    if !variant.is_empty() {
        let variants: BTreeSet<String> = host.files(VARIANTS)?.into_iter().collect();
        if !variants.contains(variant) {
            let names: Vec<&str> = variants.iter().map(String::as_str).collect();
            bail!(
                "espeak-ng has no variant {variant:?}; there are {}",
                names.join(", ")
            );
        }
    }
    Ok(base)
}

/// Returns the sex of a voice from the file of a variant.
fn variant_gender(about: &str) -> Option<Gender> {
    let line = about
        .lines()
        .find_map(|l| l.trim().strip_prefix("gender"))?;
    match line.split_whitespace().next()? {
        "female" => Some(Gender::Female),
        "male" => Some(Gender::Male),
        _ => None,
    }
}

/// Returns the voice file of a language tag: lower case, without the region if the language's main
/// voice belongs to it.
pub(super) fn file_of(tag: &str) -> String {
    match tag.to_ascii_lowercase().as_str() {
        "en-gb" => "en".to_owned(),
        "pt-pt" => "pt".to_owned(),
        "de-de" => "de".to_owned(),
        name => name.to_owned(),
    }
}

/// Parses a voice's file.
pub(super) fn voice_of(file: &str, about: &str) -> Option<VoiceInfo> {
    let value = |key: &str| {
        about.lines().find_map(|line| {
            let (k, v) = line.trim().split_once(char::is_whitespace)?;
            (k == key).then(|| v.trim())
        })
    };
    let language = value("language")?.split_whitespace().next()?;
    let what = value("name").unwrap_or(file);
    Some(VoiceInfo {
        name: file.to_lowercase(),
        language: tag(language),
        gender: match value("gender").and_then(|g| g.split_whitespace().next()) {
            Some("female") => Some(Gender::Female),
            // Its voices are male unless specified otherwise.
            _ => Some(Gender::Male),
        },
        phone_set: phone_set(set(language)).to_owned(),
        rate_hz: 22_050.0,
        what: format!("formants, {what}"),
    })
}

/// Converts an espeak-ng language name to a BCP 47 tag with the usual capitals.
pub(super) fn tag(language: &str) -> String {
    let parts = language
        .split('-')
        .enumerate()
        .map(|(i, part)| match (i, part.len()) {
            (1.., 2) => part.to_uppercase(),
            _ => part.to_owned(),
        });
    parts.collect::<Vec<_>>().join("-")
}

//! Writer of annotation files.

use quick_xml::events::{BytesDecl, BytesText, Event};
use quick_xml::writer::Writer;

use super::{Annotation, Extent, Track, TrackElement};

/// Returns the text of an annotation file, in UTF-8. Tracks precede those that refer to them, as
/// ANVIL demands.
#[must_use]
pub fn write(annotation: &Annotation) -> String {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 1);
    // Writing to memory does not fail.
    let _ = write_to(&mut writer, annotation);
    let mut text = String::from_utf8(writer.into_inner()).unwrap_or_default();
    text.push('\n');
    text
}

type Out = Writer<Vec<u8>>;

fn write_to(out: &mut Out, annotation: &Annotation) -> std::io::Result<()> {
    out.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    out.create_element("annotation")
        .write_inner_content(|out| {
            out.create_element("head")
                .write_inner_content(|out| head(out, annotation))?;
            out.create_element("body").write_inner_content(|out| {
                ordered(&annotation.tracks)
                    .into_iter()
                    .try_for_each(|track| write_track(out, track))
            })?;
            Ok(())
        })?;
    Ok(())
}

fn head(out: &mut Out, annotation: &Annotation) -> std::io::Result<()> {
    if let Some(path) = &annotation.specification {
        let tag = out.create_element("specification");
        tag.with_attribute(("src", path.as_str())).write_empty()?;
    }
    for media in &annotation.media {
        let mut tag = out
            .create_element(media.kind.as_str())
            .with_attribute(("src", media.source.as_str()));
        if media.is_master {
            tag = tag.with_attribute(("master", "true"));
        }
        tag.write_empty()?;
    }
    for info in &annotation.info {
        out.create_element("info")
            .with_attribute(("key", info.key.as_str()))
            .with_attribute(("type", info.kind.as_str()))
            .write_text_content(BytesText::new(&info.text))?;
    }
    Ok(())
}

/// Returns tracks in an order in which referenced ones come first. Those in a cycle keep their
/// place.
fn ordered(tracks: &[Track]) -> Vec<&Track> {
    let mut rest: Vec<&Track> = tracks.iter().collect();
    let mut out: Vec<&Track> = Vec::with_capacity(rest.len());
    while !rest.is_empty() {
        let waits = |track: &&Track| {
            let needed = track.kind.reference();
            needed.is_some_and(|name| rest.iter().any(|other| other.name == name))
        };
        let next = rest.iter().position(|track| !waits(track)).unwrap_or(0);
        out.push(rest.remove(next));
    }
    out
}

fn write_track(out: &mut Out, track: &Track) -> std::io::Result<()> {
    let mut tag = out
        .create_element("track")
        .with_attribute(("name", track.name.as_str()))
        .with_attribute(("type", track.kind.name()));
    if let Some(reference) = track.kind.reference() {
        tag = tag.with_attribute(("ref", reference));
    }
    if track.elements.is_empty() {
        tag.write_empty()?;
        return Ok(());
    }
    tag.write_inner_content(|out| {
        track
            .elements
            .iter()
            .try_for_each(|element| write_element(out, element))
    })?;
    Ok(())
}

fn write_element(out: &mut Out, element: &TrackElement) -> std::io::Result<()> {
    let (start, end) = match element.extent {
        Extent::Times(interval) => (
            interval.start_secs.to_string(),
            interval.end_secs.to_string(),
        ),
        Extent::Elements(first, last) => (first.to_string(), last.to_string()),
    };
    let tag = out
        .create_element("el")
        .with_attribute(("index", element.index.to_string().as_str()))
        .with_attribute(("start", start.as_str()))
        .with_attribute(("end", end.as_str()));
    if element.attributes.is_empty() && element.comment.is_none() {
        tag.write_empty()?;
        return Ok(());
    }
    tag.write_inner_content(|out| {
        for (name, text) in &element.attributes {
            out.create_element("attribute")
                .with_attribute(("name", name.as_str()))
                .write_text_content(BytesText::new(&text.value))?;
        }
        if let Some(comment) = &element.comment {
            out.create_element("comment")
                .write_text_content(BytesText::new(comment))?;
        }
        Ok(())
    })?;
    Ok(())
}

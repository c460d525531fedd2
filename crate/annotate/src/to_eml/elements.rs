//! Elements of EML from their names and attributes, by way of EML's own parser.

use quick_xml::escape::escape;
use raconteur_eml::schema::{Attribute, ELEMENTS, Element};
use raconteur_eml::{
    Clause, ClauseKind, Diagnostic, Document, EXTENSIONS, EXTENSIONS_PREFIX, Parsed, Span,
    TextSegment, parse,
};

/// Returns the entry of an element.
fn entry(name: &str) -> Option<&'static Element> {
    ELEMENTS
        .iter()
        .copied()
        .find(|element| element.name == name)
}

/// Returns the start tag of an element without its end, with the prefixes of extensions.
fn start_tag(element: &Element, attributes: &[(String, String)], more: &str) -> String {
    let prefix = |is_extension: bool| {
        if is_extension {
            format!("{EXTENSIONS_PREFIX}:")
        } else {
            String::new()
        }
    };
    let mut tag = format!("<{}{}{more}", prefix(element.extension), element.name);
    for (name, value) in attributes {
        let known = element
            .attributes
            .iter()
            .find(|attribute| attribute.name == name);
        let is_extension = known.is_some_and(|a: &Attribute| a.extension) && !element.extension;
        // A name that is no XML name must not become markup.
        if name.chars().all(char::is_alphanumeric) {
            tag.push_str(&format!(
                " {}{name}=\"{}\"",
                prefix(is_extension),
                escape(value)
            ));
        }
    }
    tag
}

/// Returns the end tag of an element.
fn end_tag(element: &Element) -> String {
    let prefix = if element.extension {
        format!("{EXTENSIONS_PREFIX}:")
    } else {
        String::new()
    };
    format!("</{prefix}{}>", element.name)
}

fn script(head: &str, body: &str) -> String {
    format!("<eml xmlns:{EXTENSIONS_PREFIX}='{EXTENSIONS}'>{head}<body>{body}</body></eml>")
}

/// Moves the problems of a generated script to the place of its annotation.
fn report(parsed: &Parsed, span: Span, problems: &mut Vec<Diagnostic>) {
    let told = parsed
        .diagnostics
        .iter()
        .filter(|problem| problem.code != "eml::empty-body");
    problems.extend(told.map(|problem| Diagnostic {
        span,
        related: Vec::new(),
        ..problem.clone()
    }));
}

fn unknown(name: &str, what: &str, span: Span) -> Diagnostic {
    let message = format!("{} is not {what} of EML", raconteur_eml::quoted(name));
    Diagnostic::error("gestura::element", span, message)
}

/// Returns a clause without its time. `length_secs` is its duration if it has one and the attributes
/// do not tell it.
pub(super) fn clause(
    name: &str,
    attributes: &[(String, String)],
    length_secs: f64,
    span: Span,
    problems: &mut Vec<Diagnostic>,
) -> Option<ClauseKind> {
    let Some(element) = entry(name).filter(|element| element.is_clause()) else {
        problems.push(unknown(name, "a clause", span));
        return None;
    };
    let mut attributes = attributes.to_vec();
    let lasts = element
        .attributes
        .iter()
        .any(|attribute| attribute.name == "duration");
    if lasts && length_secs > 0.0 && attributes.iter().all(|(name, _)| name != "duration") {
        let secs = crate::script::rounded(length_secs);
        attributes.push(("duration".into(), secs.to_string()));
    }
    let tag = start_tag(element, &attributes, " time='0'");
    let parsed = parse(&script("", &format!("{tag}/>")));
    report(&parsed, span, problems);
    let clauses = parsed.document.clauses.into_iter();
    clauses.map(|clause: Clause| clause.kind).next()
}

/// Returns the segment with which a container of spoken text opens, or a segment without content;
/// the flag is true for a container.
pub(super) fn segment(
    name: &str,
    attributes: &[(String, String)],
    span: Span,
    problems: &mut Vec<Diagnostic>,
) -> Option<(TextSegment, bool)> {
    let Some(element) = entry(name).filter(|e| e.parents.contains(&"voice-text")) else {
        problems.push(unknown(name, "an element in spoken text", span));
        return None;
    };
    let tag = start_tag(element, attributes, "");
    let with_text = format!(
        "<voice-text time='0'>{tag}>x{}</voice-text>",
        end_tag(element)
    );
    let empty = format!("<voice-text time='0'>{tag}/>x</voice-text>");
    let opens = |parsed: &Parsed| {
        let Some(ClauseKind::VoiceText(text)) = parsed.document.clauses.first().map(|c| &c.kind)
        else {
            return None;
        };
        text.pieces
            .iter()
            .find(|piece| !matches!(piece, TextSegment::Text { .. }))
            .cloned()
    };
    let parsed = parse(&script("", &with_text));
    if let Some(start @ TextSegment::Start { .. }) = opens(&parsed) {
        report(&parsed, span, problems);
        return Some((start, true));
    }
    let parsed = parse(&script("", &empty));
    report(&parsed, span, problems);
    opens(&parsed).map(|piece| (piece, false))
}

/// Applies settings to the head of a script.
pub(super) fn settings(
    settings: &[crate::gestura::Setting],
    document: &mut Document,
    problems: &mut Vec<Diagnostic>,
) {
    let of = |name: &str| {
        let all = settings.iter().filter(|setting| setting.element == name);
        all.map(|s| (s.attribute.clone(), s.value.clone()))
            .collect::<Vec<_>>()
    };
    let mut head = String::new();
    for name in ["performer", "environment"] {
        if let Some(element) = entry(name)
            && !of(name).is_empty()
        {
            head.push_str(&format!("{}/>", start_tag(element, &of(name), "")));
        }
    }
    let root = entry("eml").map_or_else(String::new, |root| start_tag(root, &of("eml"), ""));
    let text = format!(
        "{root} xmlns:{EXTENSIONS_PREFIX}='{EXTENSIONS}'><head>{head}</head><body><null \
         time='0'/></body></eml>"
    );
    let parsed = parse(&text);
    report(&parsed, Span::default(), problems);
    for setting in settings {
        if !["performer", "environment", "eml"].contains(&setting.element.as_str()) {
            problems.push(unknown(
                &setting.element,
                "an element of the head",
                Span::default(),
            ));
        }
    }
    document.name = parsed.document.name;
    document.run_up = parsed.document.run_up;
    document.performer = parsed.document.performer;
    document.environment = parsed.document.environment;
}

//! The page of a course: the player, and its title.

use quick_xml::escape::escape;

use super::About;

/// Only what is in the package, or on the server that has it.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
    img-src 'self' data:; media-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; connect-src 'self'";

const STYLE: &str = include_str!("course.css");

/// The page with its style, by path.
pub(super) fn files(about: &About) -> [(&'static str, String); 2] {
    [("index.html", page(about)), ("course.css", STYLE.into())]
}

fn page(about: &About) -> String {
    let About {
        identifier: _,
        title,
        iri,
        language,
        standard,
        watched,
        pass,
        story,
        figure,
    } = about;
    let figure = figure.as_ref().map_or(String::new(), |name| {
        format!(" figure=\"{}\"", escape(name.as_str()))
    });
    let pass = pass.map_or(String::new(), |share| format!(" data-pass=\"{share}\""));
    let [title, language, story, iri] =
        [title, language, story, iri].map(|text| escape(text.as_str()));
    format!(
        r#"<!doctype html>
<html lang="{language}">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width" />
    <meta http-equiv="Content-Security-Policy" content="{POLICY}{store}" />
    <title>{title}</title>
    <link rel="stylesheet" href="course.css" />
    <script type="module" src="player/raconteur-course.js"></script>
  </head>
  <body data-record="{record}" data-course="{iri}" data-watched="{watched}"{pass}>
    <main>
      <h1>{title}</h1>
      <nav></nav>
      <raconteur-player src="{story}" label="{title}"{figure} loading="eager" controls captions></raconteur-player>
      <output></output>
      <section aria-labelledby="result" hidden></section>
    </main>
  </body>
</html>
"#,
        record = standard.record(),
        // The launch says where the store is.
        store = if standard.has_store() {
            " https: http:"
        } else {
            ""
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::export::manifest::Standard;

    #[test]
    fn what_an_author_writes_is_text() {
        let about = About {
            title: "<script>alert('&')</script>".into(),
            identifier: "raconteur.x".into(),
            iri: "urn:\" onload=\"x".into(),
            language: "en\" onload=\"x".into(),
            standard: Standard::Html,
            watched: 0.9,
            pass: Some(0.5),
            story: "story/a\"b.eml".into(),
            figure: Some("\"><b>".into()),
        };
        let [(_, page), _] = files(&about);
        assert!(page.contains(" data-pass=\"0.5\">"));
        assert_eq!(page.matches("<script").count(), 1);
        assert!(
            !page.contains("<b>") && !page.contains("\" onload"),
            "{page}"
        );
    }
}

//! Page of a course: the player and its title.

use quick_xml::escape::escape;

use super::manifest::Standard;
use super::{About, Lesson};

/// Content security policy: only files of the package, or of the server that hosts it.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
    img-src 'self' data:; media-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; connect-src 'self'";

const STYLE: &str = include_str!("course.css");

/// Script that shows the progress of each lesson of a list.
const LIST: &str = include_str!("list.js");

/// Returns the pages with their style sheets, by path. If several lessons are not listed elsewhere,
/// the first page lists them.
pub(super) fn files(about: &About) -> Vec<(String, String)> {
    let pages = about.lessons.iter();
    let mut files: Vec<_> = pages
        .map(|lesson| (lesson.page.clone(), page(about, lesson)))
        .collect();
    files.push(("course.css".into(), STYLE.into()));
    if has_list(about) {
        files.push(("index.html".into(), list(about)));
        files.push(("list.js".into(), LIST.into()));
    }
    files
}

fn has_list(about: &About) -> bool {
    about.standard == Standard::Html && about.lessons.len() > 1
}

fn page(about: &About, lesson: &Lesson) -> String {
    let Lesson {
        title,
        iri,
        language,
        story,
        figure,
        ..
    } = lesson;
    let figure = figure.as_ref().map_or(String::new(), |name| {
        format!(" figure=\"{}\"", escape(name.as_str()))
    });
    let pass = about
        .pass
        .map_or(String::new(), |share| format!(" data-pass=\"{share}\""));
    let back = if has_list(about) {
        let course = escape(about.title.as_str());
        format!("<a href=\"index.html\">{course}</a>")
    } else {
        String::new()
    };
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
      <nav>{back}</nav>
      <raconteur-player src="{story}" label="{title}"{figure} loading="eager" controls captions></raconteur-player>
      <output></output>
      <section aria-labelledby="result" hidden></section>
    </main>
  </body>
</html>
"#,
        record = about.standard.record(),
        watched = about.watched,
        // The launch parameters specify the store.
        store = if about.standard.has_store() {
            " https: http:"
        } else {
            ""
        },
    )
}

/// Returns the page that lists the lessons with the progress of each.
fn list(about: &About) -> String {
    let item = |lesson: &Lesson| {
        let Lesson {
            title,
            iri,
            language,
            page,
            ..
        } = lesson;
        let [title, iri, language, page] =
            [title, iri, language, page].map(|text| escape(text.as_str()));
        format!(
            "        <li data-course=\"{iri}\"><a href=\"{page}\" lang=\"{language}\">{title}</a> \
             <progress max=\"1\" value=\"0\" aria-label=\"{title}\"></progress> <span></span></li>\n"
        )
    };
    let items: String = about.lessons.iter().map(item).collect();
    let [title, language] = [&about.title, &about.language].map(|text| escape(text.as_str()));
    format!(
        r#"<!doctype html>
<html lang="{language}">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width" />
    <meta http-equiv="Content-Security-Policy" content="{POLICY}" />
    <title>{title}</title>
    <link rel="stylesheet" href="course.css" />
    <script type="module" src="list.js"></script>
  </head>
  <body>
    <main>
      <h1>{title}</h1>
      <ol>
{items}      </ol>
    </main>
  </body>
</html>
"#
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Creates a test course whose texts contain markup and code.
    fn hostile(lessons: usize) -> About {
        let lesson = |_| Lesson {
            title: "<script>alert('&')</script>".into(),
            iri: "urn:\" onload=\"x".into(),
            language: "en\" onload=\"x".into(),
            page: "lesson-1.html".into(),
            folder: "story".into(),
            story: "story/a\"b.eml".into(),
            figure: Some("\"><b>".into()),
        };
        About {
            title: "<script>alert('&')</script>".into(),
            identifier: "raconteur.x".into(),
            iri: "urn:\" onload=\"x".into(),
            language: "en\" onload=\"x".into(),
            standard: Standard::Html,
            watched: 0.9,
            pass: Some(0.5),
            lessons: (0..lessons).map(lesson).collect(),
        }
    }

    #[test]
    fn several_lessons_have_a_list_where_nobody_else_lists_them() {
        let pages = files(&hostile(2));
        let [.., (name, list), _] = pages.as_slice() else {
            panic!("{}", pages.len())
        };
        assert_eq!(name, "index.html");
        assert_eq!(list.matches("<script").count(), 1);
        assert!(!list.contains("\" onload"), "{list}");
        assert_eq!(list.matches("<li ").count(), 2);
        assert!(
            pages[0].1.contains("<nav><a href=\"index.html\">"),
            "the page links to the list of lessons"
        );
        let scorm = About {
            standard: Standard::Scorm12,
            ..hostile(2)
        };
        assert!(
            files(&scorm).iter().all(|(name, _)| name != "index.html"),
            "a SCORM package has no list of lessons"
        );
    }

    #[test]
    fn what_an_author_writes_is_text() {
        let page = &files(&hostile(1))[0].1;
        assert!(
            page.contains(" data-pass=\"0.5\">"),
            "the page has the required pass ratio"
        );
        assert_eq!(page.matches("<script").count(), 1);
        assert!(
            !page.contains("<b>") && !page.contains("\" onload"),
            "{page}"
        );
    }
}

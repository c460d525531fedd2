//! Package manifests: the content of a package, and the page that a system opens.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::{About, Lesson};

/// Packaging standard of an exported course.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Standard {
    /// SCORM 1.2, Content Aggregation Model.
    Scorm12,
    /// SCORM 2004, 4th edition.
    Scorm2004,
    /// cmi5, the current specification.
    Cmi5,
    /// xAPI, launched as Tin Can packages are.
    Xapi,
    /// Plain HTML site for any web server.
    Html,
}

impl Standard {
    /// Returns the standard's name in the page's script.
    pub(super) const fn record(self) -> &'static str {
        match self {
            Self::Scorm12 => "scorm12",
            Self::Scorm2004 => "scorm2004",
            Self::Cmi5 => "cmi5",
            Self::Xapi => "xapi",
            Self::Html => "html",
        }
    }

    /// Returns true if the page communicates with a record store.
    pub(super) const fn has_store(self) -> bool {
        matches!(self, Self::Cmi5 | Self::Xapi)
    }
}

/// Returns the manifest of a package with these files, and its path; `None` if the standard has
/// none.
pub(super) fn manifest(about: &About, paths: &[String]) -> Option<(&'static str, String)> {
    match about.standard {
        Standard::Scorm12 | Standard::Scorm2004 => Some(("imsmanifest.xml", scorm(about, paths))),
        Standard::Cmi5 => Some(("cmi5.xml", cmi5(about))),
        Standard::Xapi => Some(("tincan.xml", tin_can(about))),
        Standard::Html => None,
    }
}

/// Returns the course structure (cmi5, 13): a unit for each lesson, done when completed, and passed
/// if it has a pass mark.
fn cmi5(about: &About) -> String {
    let done = match about.pass {
        Some(share) => format!("moveOn=\"CompletedAndPassed\" masteryScore=\"{share}\""),
        None => "moveOn=\"Completed\"".to_owned(),
    };
    let [iri, title, language] =
        [&about.iri, &about.title, &about.language].map(|t| escape(t.as_str()));
    let unit = |lesson: &Lesson| {
        // No unit of a course may have the identifier of the course.
        let part = if lesson.iri == about.iri {
            "#story"
        } else {
            ""
        };
        let [iri, title, language, page] =
            [&lesson.iri, &lesson.title, &lesson.language, &lesson.page]
                .map(|t| escape(t.as_str()));
        format!(
            r#"  <au id="{iri}{part}" {done} launchMethod="AnyWindow">
    <title><langstring lang="{language}">{title}</langstring></title>
    <description><langstring lang="{language}">{title}</langstring></description>
    <url>{page}</url>
  </au>
"#
        )
    };
    let units: String = about.lessons.iter().map(unit).collect();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<courseStructure xmlns="https://w3id.org/xapi/profiles/cmi5/v1/CourseStructure.xsd">
  <course id="{iri}">
    <title><langstring lang="{language}">{title}</langstring></title>
    <description><langstring lang="{language}">{title}</langstring></description>
  </course>
{units}</courseStructure>
"#
    )
}

/// Returns the Tin Can manifest, launched with a link that names the store: an activity for each
/// lesson.
fn tin_can(about: &About) -> String {
    let kind = if about.lessons.len() == 1 {
        "course"
    } else {
        "lesson"
    };
    let activity = |lesson: &Lesson| {
        let [iri, title, language, page] =
            [&lesson.iri, &lesson.title, &lesson.language, &lesson.page]
                .map(|t| escape(t.as_str()));
        format!(
            r#"    <activity id="{iri}" type="http://adlnet.gov/expapi/activities/{kind}">
      <name lang="{language}">{title}</name>
      <description lang="{language}">{title}</description>
      <launch lang="{language}">{page}</launch>
    </activity>
"#
        )
    };
    let activities: String = about.lessons.iter().map(activity).collect();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<tincan xmlns="http://projecttincan.com/tincan.xsd">
  <activities>
{activities}  </activities>
</tincan>
"#
    )
}

/// Differences between the manifests of the two SCORM versions.
struct Version {
    names: &'static str,
    number: &'static str,
    kind: &'static str,
    /// Rollup elements of an item, from the status of its part.
    item: &'static str,
    /// Elements of the course as a whole that allow free navigation between its items.
    whole: &'static str,
}

const SCORM_12: Version = Version {
    names: "xmlns=\"http://www.imsproject.org/xsd/imscp_rootv1p1p2\" xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_rootv1p2\"",
    number: "1.2",
    kind: "adlcp:scormtype",
    item: "",
    whole: "",
};
const SCORM_2004: Version = Version {
    names: "xmlns=\"http://www.imsglobal.org/xsd/imscp_v1p1\" xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_v1p3\" \
         xmlns:imsss=\"http://www.imsglobal.org/xsd/imsss\"",
    number: "2004 4th Edition",
    kind: "adlcp:scormType",
    item: "\n        <imsss:sequencing><imsss:deliveryControls completionSetByContent=\"true\" objectiveSetByContent=\"true\" /></imsss:sequencing>",
    whole: "      <imsss:sequencing><imsss:controlMode choice=\"true\" flow=\"true\" /></imsss:sequencing>\n",
};

/// Returns the manifest of a SCORM package: a part for each lesson, and their common files.
fn scorm(about: &About, paths: &[String]) -> String {
    let version = match about.standard {
        Standard::Scorm12 => SCORM_12,
        _ => SCORM_2004,
    };
    let several = about.lessons.len() > 1;
    let mut items = String::new();
    let mut resources = String::new();
    for (place, lesson) in about.lessons.iter().enumerate() {
        // File names of single-part courses predate those of multi-part courses.
        let number = if several {
            format!("-{}", place + 1)
        } else {
            String::new()
        };
        let title = escape(lesson.title.as_str());
        let _ = write!(
            items,
            "      <item identifier=\"item{number}\" identifierref=\"resource{number}\">\n        \
             <title>{title}</title>{}\n      </item>\n",
            version.item
        );
        let _ = writeln!(
            resources,
            "    <resource identifier=\"resource{number}\" type=\"webcontent\" {}=\"sco\" href=\"{}\">",
            version.kind, lesson.page
        );
        resources += &files(paths, |path| !several || belongs(path, lesson));
        if several {
            resources += "      <dependency identifierref=\"common\" />\n";
        }
        resources += "    </resource>\n";
    }
    if several {
        let _ = writeln!(
            resources,
            "    <resource identifier=\"common\" type=\"webcontent\" {}=\"asset\">",
            version.kind
        );
        let is_common = |path: &str| !about.lessons.iter().any(|lesson| belongs(path, lesson));
        resources += &files(paths, is_common);
        resources += "    </resource>\n";
    }
    let title = escape(about.title.as_str());
    let identifier = &about.identifier;
    let whole = if several { version.whole } else { "" };
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="{identifier}" version="1.0" {names}>
  <metadata>
    <schema>ADL SCORM</schema>
    <schemaversion>{number}</schemaversion>
  </metadata>
  <organizations default="organization">
    <organization identifier="organization">
      <title>{title}</title>
{items}{whole}    </organization>
  </organizations>
  <resources>
{resources}  </resources>
</manifest>
"#,
        names = version.names,
        number = version.number,
    )
}

/// Returns true if a file belongs to one lesson only.
fn belongs(path: &str, lesson: &Lesson) -> bool {
    path == lesson.page
        || path
            .strip_prefix(&lesson.folder)
            .is_some_and(|rest| rest.starts_with('/'))
}

fn files(paths: &[String], is_listed: impl Fn(&str) -> bool) -> String {
    let listed = paths.iter().filter(|path| is_listed(path));
    let mut text = String::new();
    for path in listed {
        let _ = writeln!(text, "      <file href=\"{}\" />", escape(address(path)));
    }
    text
}

/// Percent-encodes a path as a URL.
fn address(path: &str) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"/-._~!$&'()*+,;=:@".contains(&b);
    path.bytes()
        .map(|b| {
            if plain(b) {
                char::from(b).to_string()
            } else {
                format!("%{b:02X}")
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn about(standard: Standard) -> About {
        About {
            title: "Rock & <Roll>".into(),
            identifier: "raconteur.rock-roll".into(),
            iri: "https://a.example/?a=1&b=2".into(),
            language: "en".into(),
            standard,
            watched: 0.9,
            pass: None,
            lessons: vec![lesson("index.html", "story", "https://a.example/?a=1&b=2")],
        }
    }

    fn lesson(page: &str, folder: &str, iri: &str) -> Lesson {
        Lesson {
            title: "Rock & <Roll>".into(),
            iri: iri.into(),
            language: "en".into(),
            page: page.into(),
            folder: folder.into(),
            story: format!("{folder}/story.eml"),
            figure: None,
        }
    }

    fn several(standard: Standard) -> About {
        About {
            lessons: vec![
                lesson("lesson-1.html", "story-1", "urn:a/lessons/one"),
                lesson("lesson-2.html", "story-2", "urn:a/lessons/two"),
            ],
            ..about(standard)
        }
    }

    #[test]
    fn several_lessons_are_several_parts() {
        let paths = [
            "course.css",
            "lesson-1.html",
            "lesson-2.html",
            "player/x.js",
            "story-1/story.eml",
            "story-2/story.eml",
        ]
        .map(str::to_owned);
        for (standard, kind) in [
            (Standard::Scorm12, "adlcp:scormtype"),
            (Standard::Scorm2004, "adlcp:scormType"),
        ] {
            let (_, text) = manifest(&several(standard), &paths).unwrap();
            assert_xml(&text);
            assert_eq!(text.matches("<item ").count(), 2);
            assert_eq!(text.matches(&format!("{kind}=\"sco\"")).count(), 2);
            assert_eq!(text.matches(&format!("{kind}=\"asset\"")).count(), 1);
            assert_eq!(
                text.matches("<dependency identifierref=\"common\" />")
                    .count(),
                2
            );
            // Each file once, each where it belongs.
            for path in &paths {
                assert_eq!(text.matches(&format!("<file href=\"{path}\"")).count(), 1);
            }
            let common = &text[text.find("identifier=\"common\"").unwrap()..];
            assert!(
                common.contains("player/x.js") && !common.contains("story-1"),
                "shared files exclude the lessons"
            );
            assert_eq!(
                text.contains("controlMode"),
                standard == Standard::Scorm2004
            );
        }
        let (_, text) = manifest(&several(Standard::Cmi5), &[]).unwrap();
        assert_xml(&text);
        assert!(
            text.contains("<au id=\"urn:a/lessons/one\"")
                && text.contains("<url>lesson-2.html</url>"),
            "the manifest lists each lesson and its page"
        );
        let (_, text) = manifest(&several(Standard::Xapi), &[]).unwrap();
        assert_xml(&text);
        assert_eq!(text.matches("activities/lesson\"").count(), 2);
    }

    /// Reads it as XML, which it has to be.
    fn assert_xml(text: &str) {
        let mut reader = quick_xml::Reader::from_str(text);
        let mut open = 0;
        loop {
            match reader.read_event().unwrap() {
                quick_xml::events::Event::Start(_) => open += 1,
                quick_xml::events::Event::End(_) => open -= 1,
                quick_xml::events::Event::Eof => break,
                _ => {}
            }
        }
        assert_eq!(open, 0);
        assert!(
            text.contains("Rock &amp; &lt;Roll&gt;"),
            "the manifest escapes the title"
        );
    }

    #[test]
    fn manifests_of_scorm_list_every_file() {
        let paths = [
            "index.html".to_owned(),
            "story/two words & é.eml".to_owned(),
        ];
        for (standard, version) in [
            (Standard::Scorm12, "1.2"),
            (Standard::Scorm2004, "2004 4th Edition"),
        ] {
            let (name, text) = manifest(&about(standard), &paths).unwrap();
            assert_eq!(name, "imsmanifest.xml");
            assert_xml(&text);
            assert!(
                text.contains(&format!("<schemaversion>{version}</schemaversion>")),
                "the manifest declares its schema version"
            );
            assert!(
                text.contains("href=\"story/two%20words%20&amp;%20%C3%A9.eml\""),
                "{text}"
            );
        }
    }

    #[test]
    fn those_of_records_name_the_course_and_its_page() {
        for (standard, at) in [(Standard::Cmi5, "cmi5.xml"), (Standard::Xapi, "tincan.xml")] {
            let (name, text) = manifest(&about(standard), &[]).unwrap();
            assert_eq!(name, at);
            assert_xml(&text);
            assert!(
                text.contains("id=\"https://a.example/?a=1&amp;b=2\"")
                    && text.contains(">index.html<"),
                "the manifest names the course and its page"
            );
        }
        assert_eq!(manifest(&about(Standard::Html), &[]), None);
        let passed = About {
            pass: Some(0.8),
            ..about(Standard::Cmi5)
        };
        let (_, text) = manifest(&passed, &[]).unwrap();
        assert!(
            text.contains("moveOn=\"CompletedAndPassed\" masteryScore=\"0.8\""),
            "the manifest sets the mastery score"
        );
    }
}

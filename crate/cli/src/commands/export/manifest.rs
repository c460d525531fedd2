//! The manifests of packages: what a package has, and what a system opens.

use quick_xml::escape::escape;

use super::About;

/// What takes a package.
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
    /// Any server.
    Html,
}

impl Standard {
    /// What the script of the page calls it.
    pub(super) const fn record(self) -> &'static str {
        match self {
            Self::Scorm12 => "scorm12",
            Self::Scorm2004 => "scorm2004",
            Self::Cmi5 => "cmi5",
            Self::Xapi => "xapi",
            Self::Html => "html",
        }
    }

    /// Whether the page speaks with a record store, wherever that is.
    pub(super) const fn has_store(self) -> bool {
        matches!(self, Self::Cmi5 | Self::Xapi)
    }
}

/// The manifest of a package with these files, and where a system looks for it; none where its
/// standard has none.
pub(super) fn of(about: &About, paths: &[String]) -> Option<(&'static str, String)> {
    match about.standard {
        Standard::Scorm12 | Standard::Scorm2004 => Some(("imsmanifest.xml", scorm(about, paths))),
        Standard::Cmi5 => Some(("cmi5.xml", cmi5(about))),
        Standard::Xapi => Some(("tincan.xml", tin_can(about))),
        Standard::Html => None,
    }
}

/// The course structure (cmi5, 13): one unit, done when it is completed, and passed where there is
/// something to pass.
fn cmi5(about: &About) -> String {
    let done = match about.pass {
        Some(share) => format!("moveOn=\"CompletedAndPassed\" masteryScore=\"{share}\""),
        None => "moveOn=\"Completed\"".to_owned(),
    };
    let [iri, title, language] =
        [&about.iri, &about.title, &about.language].map(|t| escape(t.as_str()));
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<courseStructure xmlns="https://w3id.org/xapi/profiles/cmi5/v1/CourseStructure.xsd">
  <course id="{iri}">
    <title><langstring lang="{language}">{title}</langstring></title>
    <description><langstring lang="{language}">{title}</langstring></description>
  </course>
  <au id="{iri}#story" {done} launchMethod="AnyWindow">
    <title><langstring lang="{language}">{title}</langstring></title>
    <description><langstring lang="{language}">{title}</langstring></description>
    <url>index.html</url>
  </au>
</courseStructure>
"#
    )
}

/// What is launched with a link that names the store.
fn tin_can(about: &About) -> String {
    let [iri, title, language] =
        [&about.iri, &about.title, &about.language].map(|t| escape(t.as_str()));
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<tincan xmlns="http://projecttincan.com/tincan.xsd">
  <activities>
    <activity id="{iri}" type="http://adlnet.gov/expapi/activities/course">
      <name lang="{language}">{title}</name>
      <description lang="{language}">{title}</description>
      <launch lang="{language}">index.html</launch>
    </activity>
  </activities>
</tincan>
"#
    )
}

/// The manifest of a SCORM package.
fn scorm(about: &About, paths: &[String]) -> String {
    let (names, version, kind) = match about.standard {
        Standard::Scorm12 => (
            "xmlns=\"http://www.imsproject.org/xsd/imscp_rootv1p1p2\" xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_rootv1p2\"",
            "1.2",
            "adlcp:scormtype",
        ),
        _ => (
            "xmlns=\"http://www.imsglobal.org/xsd/imscp_v1p1\" xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_v1p3\" \
             xmlns:imsss=\"http://www.imsglobal.org/xsd/imsss\"",
            "2004 4th Edition",
            "adlcp:scormType",
        ),
    };
    // A course of one part is rolled up from what that part tells.
    let sequencing = if about.standard == Standard::Scorm2004 {
        "\n        <imsss:sequencing><imsss:deliveryControls completionSetByContent=\"true\" objectiveSetByContent=\"true\" /></imsss:sequencing>"
    } else {
        ""
    };
    let files: String = paths
        .iter()
        .map(|path| format!("      <file href=\"{}\" />\n", escape(address(path))))
        .collect();
    let title = escape(about.title.as_str());
    let identifier = &about.identifier;
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="{identifier}" version="1.0" {names}>
  <metadata>
    <schema>ADL SCORM</schema>
    <schemaversion>{version}</schemaversion>
  </metadata>
  <organizations default="organization">
    <organization identifier="organization">
      <title>{title}</title>
      <item identifier="item" identifierref="resource">
        <title>{title}</title>{sequencing}
      </item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="resource" type="webcontent" {kind}="sco" href="index.html">
{files}    </resource>
  </resources>
</manifest>
"#
    )
}

/// A path as an address: what has a meaning there is written by its number.
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
            story: "story/story.eml".into(),
            figure: None,
        }
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
        assert!(text.contains("Rock &amp; &lt;Roll&gt;"));
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
            let (name, text) = of(&about(standard), &paths).unwrap();
            assert_eq!(name, "imsmanifest.xml");
            assert_xml(&text);
            assert!(text.contains(&format!("<schemaversion>{version}</schemaversion>")));
            assert!(
                text.contains("href=\"story/two%20words%20&amp;%20%C3%A9.eml\""),
                "{text}"
            );
        }
    }

    #[test]
    fn those_of_records_name_the_course_and_its_page() {
        for (standard, at) in [(Standard::Cmi5, "cmi5.xml"), (Standard::Xapi, "tincan.xml")] {
            let (name, text) = of(&about(standard), &[]).unwrap();
            assert_eq!(name, at);
            assert_xml(&text);
            assert!(
                text.contains("id=\"https://a.example/?a=1&amp;b=2\"")
                    && text.contains(">index.html<")
            );
        }
        assert_eq!(of(&about(Standard::Html), &[]), None);
        let passed = About {
            pass: Some(0.8),
            ..about(Standard::Cmi5)
        };
        let (_, text) = of(&passed, &[]).unwrap();
        assert!(text.contains("moveOn=\"CompletedAndPassed\" masteryScore=\"0.8\""));
    }
}

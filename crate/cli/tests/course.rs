//! Courses: the output of `new --course`, missing images, and packages of several lessons.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use zip::ZipArchive;

/// Creates a separate empty folder below the library's.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("course-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn raconteur(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the program runs")
}

fn stderr_of(out: &Output) -> String {
    let both = [&out.stdout[..], &out.stderr[..]].concat();
    String::from_utf8_lossy(&both).into_owned()
}

#[test]
fn a_new_course_asks_everything_and_has_no_fault() {
    let place = folder("new").join("pond");
    let pond = place.to_str().expect("a path");
    let out = raconteur(&["new", "--course", pond]);
    assert!(out.status.success(), "{}", stderr_of(&out));
    let out = raconteur(&["check", pond]);
    assert!(
        out.status.success() && stderr_of(&out).trim().is_empty(),
        "{}",
        stderr_of(&out)
    );
    let text = fs::read_to_string(place.join("story.eml")).expect("a story");
    for kind in [
        "several", "order", "match", "gap", "number", "point", "text",
    ] {
        assert!(text.contains(&format!("type='{kind}'")), "{kind}");
    }
    for what in [
        "graded='false'",
        "partial='true'",
        "shuffle='true'",
        "<r:pool",
        "picture=",
    ] {
        assert!(text.contains(what), "{what}");
    }
    let out = raconteur(&["bake", "--check", pond]);
    assert!(out.status.success(), "{}", stderr_of(&out));
}

/// Creates a story with a title and a question with a picture.
fn story(name: &str, title: &str) -> PathBuf {
    let folder = folder(name);
    let text = format!(
        "<eml name='{title}' xmlns:r='urn:raconteur:eml:1'><body><r:ask time='0' name='q' prompt='?' picture='a b.svg' alt='A'>\
         <r:option name='a' picture='gone.svg' alt='A' right='true'/></r:ask></body></eml>"
    );
    fs::write(folder.join("story.eml"), text).expect("a story");
    fs::write(
        folder.join("a b.svg"),
        "<svg xmlns='http://www.w3.org/2000/svg'/>",
    )
    .expect("a picture");
    folder
}

#[test]
fn a_picture_that_is_not_there_is_told_at_its_option() {
    let place = story("gone", "Gone");
    let out = raconteur(&["check", place.to_str().expect("a path")]);
    let told = stderr_of(&out);
    assert_eq!(told.matches("player::no-picture").count(), 1, "{told}");
    assert!(told.contains("`gone.svg`"), "{told}");
}

/// The files of a package of two lessons.
fn exported(standard: &str) -> (ZipArchive<File>, Vec<String>) {
    let player = folder(&format!("player{standard}"));
    fs::write(
        player.join("course.json"),
        r#"{"player":["raconteur-course.js"],"speech":[]}"#,
    )
    .expect("a list");
    fs::write(player.join("raconteur-course.js"), "").expect("a script");
    let stories = [
        story(&format!("one{standard}"), "Лягушка"),
        story(&format!("two{standard}"), "Сова"),
    ];
    let zip = player.join("course.zip");
    let [one, two, zip, player] =
        [&stories[0], &stories[1], &zip, &player].map(|path| path.to_str().expect("a path"));
    let without = raconteur(&[
        "export", one, two, standard, "--player", player, "--output", zip,
    ]);
    assert!(
        !without.status.success() && stderr_of(&without).contains("--title"),
        "the export without a title reports `--title`"
    );
    let out = raconteur(&[
        "export", one, two, standard, "--title", "The pond", "--player", player, "--output", zip,
    ]);
    assert!(out.status.success(), "{}", stderr_of(&out));
    let archive = ZipArchive::new(File::open(zip).expect("a package")).expect("a zip");
    let names = archive
        .file_names()
        .map(|name| name.expect("a name").into_owned())
        .collect();
    (archive, names)
}

fn text(archive: &mut ZipArchive<File>, name: &str) -> String {
    let mut text = String::new();
    let mut file = archive.by_name(name).expect("a file");
    file.read_to_string(&mut text).expect("a text");
    text
}

#[test]
fn several_lessons_are_one_package_with_their_pictures() {
    let (mut archive, names) = exported("--scorm12");
    for name in [
        "lesson-1.html",
        "lesson-2.html",
        "story-1/story.eml",
        "story-1/a b.svg",
        "story-2/a b.svg",
        "player/raconteur-course.js",
    ] {
        assert!(names.iter().any(|it| it == name), "{name} of {names:?}");
    }
    let manifest = text(&mut archive, "imsmanifest.xml");
    assert_eq!(manifest.matches("scormtype=\"sco\"").count(), 2);
    assert!(
        manifest.contains("<title>Лягушка</title>") && manifest.contains("<title>Сова</title>"),
        "the manifest has both titles"
    );
}

#[test]
fn a_site_of_several_lessons_lists_them_by_addresses_of_their_own() {
    let (mut archive, _) = exported("--html");
    let list = text(&mut archive, "index.html");
    let addresses: Vec<_> = list
        .split("data-course=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    assert_eq!(addresses.len(), 2);
    assert_ne!(addresses[0], addresses[1]);
    for (place, address) in addresses.iter().enumerate() {
        assert!(
            address.starts_with("urn:raconteur:course:the-pond/lessons/"),
            "{address}"
        );
        let page = text(&mut archive, &format!("lesson-{}.html", place + 1));
        assert!(
            page.contains(&format!("data-course=\"{address}\"")),
            "{page}"
        );
    }
}

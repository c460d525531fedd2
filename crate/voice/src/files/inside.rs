//! Files that a story may read: those of its own folder and of the asset library. A story is
//! untrusted, and so are its folder and the links in it.

use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context as _, Result, bail, ensure};

/// Returns the path of a file in a folder, with links resolved, or `None` if it does not exist.
///
/// # Errors
/// Returns an error if `path` is an address, if it leaves the folder, directly or through a link,
/// or if it is not a regular file, because a device or a pipe may never end.
pub fn find(folder: &Path, path: &str) -> Result<Option<PathBuf>> {
    let relative = Path::new(path);
    let inner = |c: Component<'_>| matches!(c, Component::Normal(_) | Component::CurDir);
    ensure!(
        !path.contains(':') && !path.contains('\\'),
        "{path:?} is not next to the story; put it there and use its path"
    );
    if path.is_empty() || !relative.components().all(inner) {
        bail!("the path {path:?} leaves the story's folder");
    }
    let here = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let told = || format!("looking for {}", folder.join(path).display());
    let found = match here.canonicalize() {
        Ok(root) => match root.join(relative).canonicalize() {
            Ok(found) => {
                ensure!(
                    found.starts_with(&root),
                    "{} is a link to a target outside the folder {}; put the file itself there",
                    folder.join(path).display(),
                    here.display()
                );
                found
            }
            Err(error) if is_absent(error.kind()) => return Ok(None),
            Err(error) => return Err(error).with_context(told),
        },
        Err(error) if is_absent(error.kind()) => return Ok(None),
        Err(error) => return Err(error).with_context(told),
    };
    let about = fs::metadata(&found).with_context(told)?;
    ensure!(
        about.is_file(),
        "{} is not a plain file",
        folder.join(path).display()
    );
    Ok(Some(found))
}

/// Checks that a nested folder, if it exists, is inside the outer one, without a link that leads
/// out.
///
/// # Errors
/// Returns an error if the nested folder is not inside the outer one.
pub fn check_folder(folder: &Path, inner: &Path) -> Result<()> {
    let here = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    if let (Ok(root), Ok(found)) = (here.canonicalize(), inner.canonicalize()) {
        ensure!(
            found.starts_with(&root) && found.is_dir(),
            "{} is a link to a target outside the story",
            inner.display()
        );
    }
    Ok(())
}

fn is_absent(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::NotFound | ErrorKind::NotADirectory)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_stay_in_their_folder() {
        let folder = tempfile::tempdir().unwrap();
        let story = folder.path().join("story");
        fs::create_dir_all(story.join("sound")).unwrap();
        fs::write(story.join("sound/a.wav"), "x").unwrap();
        fs::write(folder.path().join("secret"), "x").unwrap();
        let found = find(&story, "sound/a.wav").unwrap().unwrap();
        assert!(
            found.is_absolute() && found.ends_with("story/sound/a.wav"),
            "the found path is absolute and in the story"
        );
        assert_eq!(find(&story, "./sound/a.wav").unwrap(), Some(found));
        for absent in ["sound/b.wav", "no/such", "sound/a.wav/more"] {
            assert_eq!(find(&story, absent).unwrap(), None, "{absent}");
        }
        assert_eq!(find(&folder.path().join("none"), "a").unwrap(), None);
        for bad in [
            "../secret",
            "sound/../../secret",
            "/etc/passwd",
            "http://example.org/a.wav",
            "file:/etc/passwd",
            "concat:a|b",
            "c:\\a",
            "",
            "sound",
        ] {
            assert!(find(&story, bad).is_err(), "{bad}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_in_their_folder_and_devices_are_refused() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let story = folder.path().join("story");
        fs::create_dir(&story).unwrap();
        fs::write(story.join("a"), "x").unwrap();
        fs::write(folder.path().join("secret"), "x").unwrap();
        symlink("a", story.join("inner")).unwrap();
        symlink("../secret", story.join("outer")).unwrap();
        symlink("..", story.join("up")).unwrap();
        symlink("/dev/zero", story.join("zero")).unwrap();
        symlink("nowhere", story.join("dangling")).unwrap();
        assert!(
            find(&story, "inner").unwrap().unwrap().ends_with("story/a"),
            "the inner link is followed"
        );
        assert_eq!(find(&story, "dangling").unwrap(), None);
        for bad in ["outer", "up/secret", "up/story/../secret", "zero"] {
            assert!(find(&story, bad).is_err(), "{bad}");
        }
        // The folder itself may be reached by a link: its owner has named it.
        symlink("story", folder.path().join("link")).unwrap();
        assert!(
            find(&folder.path().join("link"), "a").unwrap().is_some(),
            "a linked story folder is accepted"
        );
        assert!(
            find(Path::new("/dev"), "zero").is_err(),
            "a device is rejected"
        );
    }
}

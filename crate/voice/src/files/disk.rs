//! Atomic file writing: a reader, also after a crash, has the complete old file or the complete new
//! one.
//!
//! A file is written under another name in the same folder, made durable, and renamed. All commands
//! that write use this module; tests replace the real [`Disk`] with one that fails.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::{Context as _, Result, bail};

/// File system operations that modify files; replaceable for fault-injection tests.
pub trait Disk: Sync {
    /// Makes a file that was not there, with these bytes, and waits until they are stored.
    ///
    /// # Errors
    /// Returns the error of the system; a partial file may then exist.
    fn create(&self, path: &Path, bytes: &[u8]) -> io::Result<()>;

    /// Replaces a file by another.
    ///
    /// # Errors
    /// Returns the error of the system; nothing has then changed.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;

    /// Removes a file.
    ///
    /// # Errors
    /// Returns the error of the system.
    fn remove(&self, path: &Path) -> io::Result<()>;

    /// Waits until the names in a folder are stored.
    ///
    /// # Errors
    /// Returns the error of the system.
    fn sync_folder(&self, folder: &Path) -> io::Result<()>;
}

/// Disk of this machine, with synced writes.
pub struct SystemDisk;

impl Disk for SystemDisk {
    fn create(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
        file.write_all(bytes)?;
        file.sync_all()
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        // Folders can be opened only on Unix; elsewhere the system does this automatically.
        if cfg!(unix) {
            File::open(folder)?.sync_all()
        } else {
            Ok(())
        }
    }
}

/// Marks the names of files that are being made.
const PART: &str = ".part";

/// Returns true if the name is that of an unfinished temporary file.
pub fn is_part(name: &str) -> bool {
    let ends = |name: &str| name.ends_with(PART);
    name.starts_with('.') && (ends(name) || name.rsplit_once('.').is_some_and(|(n, _)| ends(n)))
}

/// Returns an unused name next to `place`, with the same extension, by which some programs choose
/// the format.
fn part_of(place: &Path) -> PathBuf {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    loop {
        let mut name = OsString::from(".");
        name.push(place.file_stem().unwrap_or_default());
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        name.push(format!(".{}-{count}{PART}", std::process::id()));
        if let Some(ending) = place.extension() {
            name.push(".");
            name.push(ending);
        }
        let part = place.with_file_name(name);
        // A program of the same number may have ended badly.
        if fs::symlink_metadata(&part).is_err() {
            return part;
        }
    }
}

/// Returns the folder that contains a file.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Writes a file on a disk; a link at that path is replaced, not followed.
///
/// # Errors
/// Returns the error of the system. The old file is then intact, unless only the last step failed:
/// storing the name of the new file.
pub fn replace_on(disk: &dyn Disk, path: &Path, bytes: &[u8]) -> Result<()> {
    let part = part_of(path);
    disk.create(&part, bytes)
        .and_then(|()| disk.rename(&part, path))
        .inspect_err(|_| {
            // The partial file is useless; a failure to remove it changes nothing.
            let _ = disk.remove(&part);
        })
        .and_then(|()| disk.sync_folder(folder_of(path)))
        .with_context(|| format!("cannot write {}", path.display()))
}

/// Writes a file named by the user. A link is followed, the file's permissions are preserved, and a
/// device, such as `/dev/stdout`, is written directly.
///
/// # Errors
/// Returns an error if the file cannot be written; the old file is then intact.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    let part = PendingFile::for_target(path)?;
    if part.is_direct() {
        return fs::write(path, bytes).with_context(|| format!("cannot write {}", path.display()));
    }
    SystemDisk
        .create(&part.part, bytes)
        .with_context(|| format!("cannot write {}", path.display()))?;
    part.commit()
}

/// File being written, by this program or by another that receives its path. It is removed unless
/// committed.
pub struct PendingFile {
    part: PathBuf,
    place: PathBuf,
}

impl PendingFile {
    /// Creates a pending file for the target path that a user specified.
    ///
    /// # Errors
    /// Returns an error if a folder has that name, or the folder of the file does not exist.
    pub fn for_target(path: &Path) -> Result<Self> {
        let told = || format!("cannot write {}", path.display());
        let place = match fs::metadata(path) {
            Ok(about) if about.is_dir() => bail!("{}: it is a folder", told()),
            Ok(about) if !about.is_file() => {
                return Ok(Self::direct(path));
            }
            Ok(_) => fs::canonicalize(path).with_context(told)?,
            Err(error) if error.kind() == ErrorKind::NotFound => path.to_owned(),
            Err(error) => return Err(error).with_context(told),
        };
        if place.file_name().is_none() || !folder_of(&place).is_dir() {
            bail!("{}: there is no such folder", told());
        }
        Ok(Self {
            part: part_of(&place),
            place,
        })
    }

    /// Creates an output that is written in place, for example many files after a pattern.
    pub fn direct(path: &Path) -> Self {
        Self {
            part: path.to_owned(),
            place: path.to_owned(),
        }
    }

    /// Returns the temporary path for writing.
    pub fn path(&self) -> &Path {
        &self.part
    }

    /// Returns true if it is written in place, because the target is not a regular file.
    fn is_direct(&self) -> bool {
        self.part == self.place
    }

    /// Moves the file to its final path.
    ///
    /// # Errors
    /// Returns an error if the move fails; the old file is then intact.
    pub fn commit(self) -> Result<()> {
        if self.is_direct() {
            return Ok(());
        }
        let done = || {
            if let Ok(about) = fs::metadata(&self.place) {
                fs::set_permissions(&self.part, about.permissions())?;
            }
            File::open(&self.part)?.sync_all()?;
            SystemDisk.rename(&self.part, &self.place)?;
            SystemDisk.sync_folder(folder_of(&self.place))
        };
        done().with_context(|| format!("cannot write {}", self.place.display()))
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        if !self.is_direct() {
            // After a commit it is not there any more.
            let _ = fs::remove_file(&self.part);
        }
    }
}

#[cfg(test)]
pub mod faulty;

#[cfg(test)]
mod tests {
    use super::faulty::{AfterFailure, Faulty};
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn whatever_step_fails_the_file_is_the_old_or_the_new_one() {
        for then in [AfterFailure::Killed, AfterFailure::GoesOn] {
            let mut failed = 0;
            for k in 0.. {
                let folder = tempfile::tempdir().unwrap();
                let path = folder.path().join("story.eml");
                fs::write(&path, "old").unwrap();
                let disk = Faulty::at_step(k, then);
                let result = replace_on(&disk, &path, b"the new one");
                let now = fs::read_to_string(&path).unwrap();
                assert!(now == "old" || now == "the new one", "{k}: {now}");
                if result.is_ok() {
                    assert_eq!(now, "the new one");
                    assert_eq!(names(folder.path()), ["story.eml"]);
                    break;
                }
                failed += 1;
                if then == AfterFailure::GoesOn {
                    assert_eq!(names(folder.path()), ["story.eml"], "{k}");
                }
            }
            assert!(failed >= 3, "{failed}");
        }
    }

    #[test]
    fn a_full_disk_leaves_the_old_file_and_nothing_else() {
        for room in 0..11 {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.opus");
            fs::write(&path, "old").unwrap();
            let disk = Faulty::with_room(room);
            assert!(
                replace_on(&disk, &path, b"the new one").is_err(),
                "a full disk rejects the replacement"
            );
            assert_eq!(fs::read(&path).unwrap(), b"old");
            assert_eq!(names(folder.path()), ["a.opus"]);
        }
    }

    #[test]
    fn names_of_parts_are_known() {
        for name in ["a.opus", "speech.json", "film.mp4", "plain", ".hidden"] {
            let part = part_of(&Path::new("x").join(name));
            let part = part.file_name().unwrap().to_str().unwrap().to_owned();
            assert!(is_part(&part), "{part}");
            assert!(!is_part(name), "the name is not that of a partial file");
        }
        for other in ["a.part", "part", ".", "", ".part.of.it", "x.part.opus"] {
            assert!(!is_part(other) || other == ".part", "{other}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_permissions_stay_and_devices_are_written_as_they_are() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("file", &link).unwrap();
        replace(&link, b"new").unwrap();
        assert!(
            fs::symlink_metadata(&link).unwrap().is_symlink(),
            "the link stays a link"
        );
        assert_eq!(fs::read(&file).unwrap(), b"new");
        let mode = fs::metadata(&file).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
        replace(Path::new("/dev/null"), b"gone").unwrap();
        assert!(
            !fs::metadata("/dev/null").unwrap().is_file(),
            "the device stays a device"
        );
        assert!(
            replace(folder.path(), b"").is_err(),
            "a folder is not replaced"
        );
        assert!(
            replace(&folder.path().join("no/such"), b"").is_err(),
            "a missing folder is rejected"
        );
    }
}

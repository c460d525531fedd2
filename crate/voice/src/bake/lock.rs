//! Exclusive lock of a story's bake.
//!
//! The lock is the system's lock on a file in the folder (`flock` on Unix). The system releases it
//! when the program ends, however that ends, so a leftover file of a terminated program locks
//! nothing and is reused.

use std::fs::{self, File, TryLockError};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};

/// The file's name in the folder; it is there only while a bake is at work.
const NAME: &str = ".bake.lock";

/// Lock on a bundle's folder, so that two bakes do not write to it at once; released when dropped.
#[derive(Debug)]
pub(super) struct Lock {
    file: File,
    path: PathBuf,
}

impl Lock {
    /// Locks a folder, and makes it where it is not there.
    ///
    /// # Errors
    /// Returns an error if another program has locked the folder, or if the folder cannot be
    /// written.
    pub(super) fn acquire(folder: &Path) -> Result<Self> {
        let told = || format!("locking {}", folder.display());
        let path = folder.join(NAME);
        loop {
            fs::create_dir_all(folder).with_context(told)?;
            // A link could name anybody's file, which would be emptied below.
            if fs::symlink_metadata(&path).is_ok_and(|about| !about.is_file()) {
                bail!("{} is not a plain file; remove it", path.display());
            }
            let mut options = File::options();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = match options.open(&path) {
                Ok(file) => file,
                // The other bake has just ended and removed the folder, empty as it was.
                Err(_) if !folder.is_dir() => continue,
                Err(error) => return Err(error).with_context(told),
            };
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let mut number = String::new();
                    // Only a help for the reader of the message.
                    let _ = (&file).take(20).read_to_string(&mut number);
                    let who = match number.trim().parse::<u32>() {
                        Ok(number) => format!("process {number}"),
                        Err(_) => "another process".to_owned(),
                    };
                    bail!(
                        "{who} is baking this story; try again when it has ended ({})",
                        path.display()
                    );
                }
                Err(TryLockError::Error(error)) => return Err(error).with_context(told),
            }
            if !is_at(&file, &path) {
                // Its last owner removed the file after it was opened here; others lock a new one.
                continue;
            }
            let number = std::process::id().to_string();
            file.set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| file.write_all(number.as_bytes()))
                .with_context(told)?;
            return Ok(Self { file, path });
        }
    }
}

/// Returns true if a path still names this file.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let same = |a: &fs::Metadata, b: &fs::Metadata| (a.dev(), a.ino()) == (b.dev(), b.ino());
    let both = file.metadata().ok().zip(fs::symlink_metadata(path).ok());
    both.is_some_and(|(a, b)| same(&a, &b))
}

/// Returns true if a path still names this file: on this system an open file cannot be removed.
#[cfg(not(unix))]
fn is_at(_file: &File, _path: &Path) -> bool {
    true
}

impl Drop for Lock {
    fn drop(&mut self) {
        // The file is removed while locked: a program that opened it in the meantime detects the
        // removal.
        let _ = fs::remove_file(&self.path);
        let _ = self.file.unlock();
        if let Some(folder) = self.path.parent() {
            // Only an empty folder is removed.
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;

    #[test]
    fn a_folder_is_locked_once_and_what_the_dead_left_locks_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let voice = folder.path().join("voice");
        let lock = Lock::acquire(&voice).unwrap();
        let error = Lock::acquire(&voice).unwrap_err().to_string();
        assert!(
            error.contains(&format!("process {} is baking", std::process::id())),
            "{error}"
        );
        drop(lock);
        assert!(!voice.exists(), "nothing stays");
        fs::create_dir(&voice).unwrap();
        fs::write(voice.join(NAME), "4000000000 and more than a number").unwrap();
        drop(Lock::acquire(&voice).unwrap());
        assert!(!voice.exists(), "the abandoned folder is removed");
    }

    #[test]
    fn never_two_have_it() {
        let folder = tempfile::tempdir().unwrap();
        let voice = folder.path().join("voice");
        let (inside, taken) = (AtomicUsize::new(0), AtomicUsize::new(0));
        thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..2_000 {
                        if let Ok(_lock) = Lock::acquire(&voice) {
                            assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                            taken.fetch_add(1, Ordering::SeqCst);
                            thread::yield_now();
                            inside.fetch_sub(1, Ordering::SeqCst);
                        }
                    }
                });
            }
        });
        assert!(
            taken.load(Ordering::SeqCst) > 0,
            "the lock is taken at least once"
        );
    }
}

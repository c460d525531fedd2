//! Disk that fails on demand, for tests.

use std::fs;
use std::io::{self, Error, ErrorKind, Write as _};
use std::path::Path;
use std::sync::Mutex;

use super::{Disk, SystemDisk};

/// Behaviour of a test disk after the injected failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AfterFailure {
    /// The program was killed: no further changes.
    Killed,
    /// Only the one step fails; later steps succeed.
    GoesOn,
}

/// Test disk that does not sync its writes, because tests take thousands of steps.
pub struct Unsynced;

impl Disk for Unsynced {
    fn create(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let mut options = fs::OpenOptions::new();
        let mut file = options.write(true).create_new(true).open(path)?;
        file.write_all(bytes)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        SystemDisk.rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        SystemDisk.remove(path)
    }

    fn sync_folder(&self, _folder: &Path) -> io::Result<()> {
        Ok(())
    }
}

/// Test disk that fails at one step, or when its capacity is used up.
pub struct Faulty {
    then: AfterFailure,
    state: Mutex<State>,
}

struct State {
    /// Steps until the one that fails.
    steps: usize,
    /// Bytes that can still be written.
    room: usize,
    failed: bool,
}

impl Faulty {
    /// Creates a disk that fails at step `k`, counted from 0.
    pub fn at_step(k: usize, then: AfterFailure) -> Self {
        Self::new(k, usize::MAX, then)
    }

    /// Creates a disk with a capacity in bytes.
    pub fn with_room(bytes: usize) -> Self {
        Self::new(usize::MAX, bytes, AfterFailure::GoesOn)
    }

    fn new(steps: usize, room: usize, then: AfterFailure) -> Self {
        let failed = false;
        let state = Mutex::new(State {
            steps,
            room,
            failed,
        });
        Self { then, state }
    }

    /// Counts a step; `Err` when it is the one that fails, or when the program is dead.
    fn step(&self) -> io::Result<()> {
        let mut state = self.state.lock().unwrap();
        if state.failed && self.then == AfterFailure::Killed {
            return Err(Error::other("the program is dead"));
        }
        if state.steps == 0 && !state.failed {
            state.failed = true;
            return Err(Error::other("this step fails"));
        }
        state.steps = state.steps.saturating_sub(1);
        Ok(())
    }
}

impl Disk for Faulty {
    fn create(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let dead = {
            let state = self.state.lock().unwrap();
            state.failed && self.then == AfterFailure::Killed
        };
        if let Err(error) = self.step() {
            if !dead {
                // It fails in the middle.
                fs::write(path, &bytes[..bytes.len() / 2])?;
            }
            return Err(error);
        }
        let fits = {
            let mut state = self.state.lock().unwrap();
            let fits = bytes.len().min(state.room);
            state.room -= fits;
            fits
        };
        Unsynced.create(path, &bytes[..fits])?;
        if fits < bytes.len() {
            return Err(ErrorKind::StorageFull.into());
        }
        Ok(())
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.step()?;
        Unsynced.rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        self.step()?;
        Unsynced.remove(path)
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        self.step()?;
        Unsynced.sync_folder(folder)
    }
}

//! Connections before their greeting.
//!
//! Any client can open a connection and send nothing, or a byte now and then. Such connections wait
//! here, separate from the minds' slots: at most [`MAX_PENDING`] simultaneously, each until
//! [`super::mind::PATIENCE`] has passed. A further connection replaces the oldest one. Strangers
//! therefore occupy no mind's slot, and a client that greets immediately is accepted immediately.
//! Rejected clients stay until they have read the reason.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Maximum number of awaited greetings on all ports together.
const MAX_PENDING: usize = 64;
/// Duration for which data of a rejected peer is still read, so that it receives the reason.
const FAREWELL: Duration = Duration::from_secs(3);
/// Maximum amount of that data, bytes.
const FAREWELL_BYTES: usize = 1 << 20;

/// Connections that have not sent their greeting yet, limited in number and time.
#[derive(Clone, Default)]
pub(crate) struct PendingConnections(Arc<Mutex<PendingConnection>>);

#[derive(Default)]
struct PendingConnection {
    begun: u64,
    /// The longest waiting first.
    streams: VecDeque<(u64, TcpStream)>,
}

/// Entry of a connection among the pending ones, removed on drop.
pub(crate) struct PendingGuard {
    lobby: PendingConnections,
    id: u64,
}

impl PendingConnections {
    /// Adds a connection, and evicts the oldest one if the list is full: its reads end.
    ///
    /// # Errors
    /// Returns an error if no more handles are available.
    pub(crate) fn enter(&self, stream: &TcpStream) -> io::Result<PendingGuard> {
        let handle = stream.try_clone()?;
        let mut waiting = self.lock();
        waiting.begun += 1;
        let id = waiting.begun;
        waiting.streams.push_back((id, handle));
        if waiting.streams.len() > MAX_PENDING
            && let Some((_, oldest)) = waiting.streams.pop_front()
        {
            // The connection may have closed already.
            let _ = oldest.shutdown(Shutdown::Both);
        }
        Ok(PendingGuard {
            lobby: self.clone(),
            id,
        })
    }

    fn lock(&self) -> MutexGuard<'_, PendingConnection> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for PendingGuard {
    fn drop(&mut self) {
        self.lobby.lock().streams.retain(|(id, _)| *id != self.id);
    }
}

/// TCP stream with a common deadline for all reads: with a timeout per read, a peer could send
/// single bytes forever.
pub(crate) struct DeadlineStream {
    stream: TcpStream,
    until: Option<Instant>,
}

impl DeadlineStream {
    /// Creates a stream with a time limit for all reads together.
    pub(crate) fn new(stream: TcpStream, patience: Duration) -> Self {
        Self {
            stream,
            until: Some(Instant::now() + patience),
        }
    }

    /// Removes the common deadline; from then on each read times out after `turn`.
    pub(crate) fn settle(&mut self, turn: Duration) -> io::Result<()> {
        self.until = None;
        self.stream.set_read_timeout(Some(turn))
    }

    /// Closes the connection after the written data. Pending input is read first, because a
    /// connection closed with unread bytes is reset and the peer would lose the message.
    pub(crate) fn farewell(mut self) {
        self.until = Some(Instant::now() + FAREWELL);
        let _ = self.stream.shutdown(Shutdown::Write);
        let mut bytes = [0; 4096];
        let mut left = FAREWELL_BYTES;
        while let Ok(n) = self.read(&mut bytes) {
            left = left.saturating_sub(n);
            if n == 0 || left == 0 {
                return;
            }
        }
    }
}

impl Read for DeadlineStream {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if let Some(until) = self.until {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(ErrorKind::TimedOut.into());
            }
            self.stream.set_read_timeout(Some(left))?;
        }
        self.stream.read(bytes)
    }
}

impl Write for DeadlineStream {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

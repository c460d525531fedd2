//! Connected mind: incoming and outgoing messages.

use std::io::{self, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, TrySendError, sync_channel};
use std::time::Duration;

use serde::Serialize;

use super::pending::PendingConnections;
use crate::terminal;

/// Fragments of one mind that wait to be performed; a mind that sends more is not read.
const WAITING: usize = 16;
/// Maximum number of unsent lines per mind; a mind that does not read them misses the rest.
const UNREAD: usize = 1024;
/// Maximum number of connected minds.
const MAX_MINDS: usize = 32;
/// Interval at which a connection checks for lines to send while it waits for fragments.
pub(crate) const TURN: Duration = Duration::from_millis(20);
/// Timeout for a mind's greeting, and for reading a line.
pub(crate) const PATIENCE: Duration = Duration::from_secs(5);

/// Line of JSON to send to a mind (a program that controls a live performance), without line end.
pub(crate) type Line = Arc<str>;

/// Connected mind (a program that sends EML clauses during a live performance), as seen by the
/// performing thread.
pub(crate) struct Mind {
    /// Identifier of the mind.
    pub(crate) id: u32,
    inbox: Receiver<String>,
    outbox: Outbox,
    lost: u64,
}

enum Outbox {
    Connection(SyncSender<Line>),
    StandardOutput,
}

/// Channels from a connection thread to the performing thread: fragments in, lines out.
pub(crate) struct MindLink {
    inbox: SyncSender<String>,
    outbox: Receiver<Line>,
    /// A fragment for which there was no room yet.
    held: Option<String>,
}

/// Shared state with which connection threads register new minds at the performance.
#[derive(Clone)]
pub(crate) struct ConnectionSender {
    token: Arc<str>,
    /// True if every WebSocket must present the token, including those of this machine.
    pub(crate) guarded: bool,
    /// A mind that is silent for so long is gone.
    pub(crate) idle: Duration,
    /// Connections that have not greeted yet.
    pub(crate) lobby: PendingConnections,
    arrivals: SyncSender<Mind>,
    connected: Arc<AtomicUsize>,
}

/// Slot among the connected minds, released on drop.
pub(crate) struct ConnectionSlot(Arc<AtomicUsize>);

impl Drop for ConnectionSlot {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Error returned when the other side of the connection is gone.
pub(crate) struct Disconnected;

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum MindMessage {
    Lost { count: u64 },
}

impl ConnectionSender {
    /// Creates an entry point, and the receiver of the minds that enter.
    pub(crate) fn new(token: &str, guarded: bool, idle: Duration) -> (Self, Receiver<Mind>) {
        let (arrivals, arrived) = sync_channel(MAX_MINDS);
        let door = Self {
            token: token.into(),
            guarded,
            idle,
            lobby: PendingConnections::default(),
            arrivals,
            connected: Arc::default(),
        };
        (door, arrived)
    }

    /// Returns a free slot for a mind, if there is one.
    pub(crate) fn place(&self) -> Option<ConnectionSlot> {
        let before = self.connected.fetch_add(1, Ordering::Relaxed);
        let place = ConnectionSlot(Arc::clone(&self.connected));
        (before < MAX_MINDS).then_some(place)
    }

    /// Returns true if a token is valid. The duration of the comparison reveals only lengths.
    pub(crate) fn opens(&self, token: &str) -> bool {
        let pairs = self.token.bytes().zip(token.bytes());
        let differences = pairs.fold(0, |sum, (a, b)| sum | (a ^ b));
        differences == 0 && self.token.len() == token.len()
    }

    /// Registers a mind.
    pub(crate) fn enter(&self) -> Result<MindLink, Disconnected> {
        let (inbox, fragments) = sync_channel(WAITING);
        let (lines, outbox) = sync_channel(UNREAD);
        let mind = Mind::new(fragments, Outbox::Connection(lines));
        self.arrivals.send(mind).map_err(|_| Disconnected)?;
        Ok(MindLink {
            inbox,
            outbox,
            held: None,
        })
    }

    /// Registers the mind at standard input; its input goes into the returned sender.
    pub(crate) fn enter_by_input(&self) -> Result<SyncSender<String>, Disconnected> {
        let (inbox, fragments) = sync_channel(WAITING);
        let mind = Mind::new(fragments, Outbox::StandardOutput);
        self.arrivals.send(mind).map_err(|_| Disconnected)?;
        Ok(inbox)
    }
}

impl Mind {
    fn new(inbox: Receiver<String>, outbox: Outbox) -> Self {
        Self {
            id: 0,
            inbox,
            outbox,
            lost: 0,
        }
    }

    /// Returns the next fragment, if there is one; `Gone` if there will be none.
    pub(crate) fn next(&self) -> Result<Option<String>, Disconnected> {
        match self.inbox.try_recv() {
            Ok(fragment) => Ok(Some(fragment)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(Disconnected),
        }
    }

    /// Waits for the next fragment.
    pub(crate) fn next_fragment(&self) -> Result<String, Disconnected> {
        self.inbox.recv().map_err(|_| Disconnected)
    }

    /// Returns true for the mind at standard input.
    pub(crate) fn is_at_input(&self) -> bool {
        matches!(self.outbox, Outbox::StandardOutput)
    }

    /// Sends a line. Never blocks on a connection: unread lines are counted.
    pub(crate) fn send_line(&mut self, line: &Line) -> io::Result<()> {
        let lines = match &self.outbox {
            Outbox::StandardOutput => {
                let mut out = terminal::out();
                writeln!(out, "{line}")?;
                return out.flush();
            }
            Outbox::Connection(lines) => lines,
        };
        if self.lost > 0 {
            let note = serde_json::to_string(&MindMessage::Lost { count: self.lost })?;
            if lines.try_send(note.into()).is_ok() {
                self.lost = 0;
            }
        }
        // The inbox detects a disconnected mind.
        if let Err(TrySendError::Full(_)) = lines.try_send(Arc::clone(line)) {
            self.lost += 1;
        }
        Ok(())
    }
}

impl MindLink {
    /// Returns the next line to send to the mind; `None` if there is none.
    pub(crate) fn line(&self) -> Result<Option<Line>, Disconnected> {
        match self.outbox.try_recv() {
            Ok(line) => Ok(Some(line)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(Disconnected),
        }
    }

    /// Returns true if the mind may be read. Otherwise its connection fills up, which slows it
    /// down.
    pub(crate) fn is_free(&mut self) -> Result<bool, Disconnected> {
        match self.held.take() {
            None => Ok(true),
            Some(fragment) => {
                self.forward(fragment)?;
                Ok(self.held.is_none())
            }
        }
    }

    /// Hands a fragment on, now or when there is room.
    pub(crate) fn forward(&mut self, fragment: String) -> Result<(), Disconnected> {
        match self.inbox.try_send(fragment) {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(fragment)) => {
                self.held = Some(fragment);
                Ok(())
            }
            Err(TrySendError::Disconnected(_)) => Err(Disconnected),
        }
    }
}

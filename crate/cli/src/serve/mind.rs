//! A connected mind: the messages from it and to it.

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
/// Lines that wait to be sent to one mind; one that does not read them misses the rest.
const UNREAD: usize = 1024;
/// Minds connected at once.
const MAX_MINDS: usize = 32;
/// How often a connection looks for lines to send while it waits for fragments.
pub(crate) const TURN: Duration = Duration::from_millis(20);
/// A mind that has not greeted by then, or takes longer to read a line, is gone.
pub(crate) const PATIENCE: Duration = Duration::from_secs(5);

/// A line for a mind, without the end of line.
pub(crate) type Line = Arc<str>;

/// What the performer holds of a mind.
pub(crate) struct Mind {
    /// Tells minds apart.
    pub(crate) id: u32,
    inbox: Receiver<String>,
    outbox: Outbox,
    lost: u64,
}

enum Outbox {
    Connection(SyncSender<Line>),
    StandardOutput,
}

/// What a connection holds of the performer.
pub(crate) struct MindLink {
    inbox: SyncSender<String>,
    outbox: Receiver<Line>,
    /// A fragment for which there was no room yet.
    held: Option<String>,
}

/// Where connections come in.
#[derive(Clone)]
pub(crate) struct ConnectionSender {
    token: Arc<str>,
    /// Whether every WebSocket must say the token, too: those of this machine as well.
    pub(crate) guarded: bool,
    /// A mind that is silent for so long is gone.
    pub(crate) idle: Duration,
    /// Where connections wait before they come in.
    pub(crate) lobby: PendingConnections,
    arrivals: SyncSender<Mind>,
    connected: Arc<AtomicUsize>,
}

/// A place among the connected minds; leaving gives it back.
pub(crate) struct ConnectionSlot(Arc<AtomicUsize>);

impl Drop for ConnectionSlot {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// The connection's other side is gone.
pub(crate) struct Disconnected;

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum MindMessage {
    Lost { count: u64 },
}

impl ConnectionSender {
    /// A door, and where those who came through it are found.
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

    /// A place for a mind, unless all are taken.
    pub(crate) fn place(&self) -> Option<ConnectionSlot> {
        let before = self.connected.fetch_add(1, Ordering::Relaxed);
        let place = ConnectionSlot(Arc::clone(&self.connected));
        (before < MAX_MINDS).then_some(place)
    }

    /// Whether a token opens the door. The time that this takes tells nothing but lengths.
    pub(crate) fn opens(&self, token: &str) -> bool {
        let pairs = self.token.bytes().zip(token.bytes());
        let differences = pairs.fold(0, |sum, (a, b)| sum | (a ^ b));
        differences == 0 && self.token.len() == token.len()
    }

    /// Brings a mind in.
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

    /// Brings in the mind at the standard input; what it sends goes into the sender.
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

    /// The next fragment, if there is one; `Gone` when there will be none.
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

    /// Whether it is the one at the standard input.
    pub(crate) fn is_at_input(&self) -> bool {
        matches!(self.outbox, Outbox::StandardOutput)
    }

    /// Tells a line. Never waits for a connection: what a mind does not read is counted.
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
        // That a mind is gone is seen at its inbox.
        if let Err(TrySendError::Full(_)) = lines.try_send(Arc::clone(line)) {
            self.lost += 1;
        }
        Ok(())
    }
}

impl MindLink {
    /// A line to send, if there is one.
    pub(crate) fn line(&self) -> Result<Option<Line>, Disconnected> {
        match self.outbox.try_recv() {
            Ok(line) => Ok(Some(line)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(Disconnected),
        }
    }

    /// Whether the mind may be read. While it may not, its connection fills up and slows it.
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

//! Minds that connect by plain TCP: a greeting and fragments in, JSON lines out.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::net::TcpStream;
use std::time::Instant;

use raconteur_player::live::limits;

use super::framing::Framer;
use super::greeting::{self, Greeting};
use super::heartbeat::{Heartbeat, HeartbeatAction};
use super::mind::{ConnectionSender, Disconnected, MindLink, PATIENCE, TURN};
use super::pending::DeadlineStream;

/// Response to an invalid greeting.
const REFUSED: &str = r#"{"kind":"failed","code":"serve::token","message":"the first line must be: raconteur 1 TOKEN"}
"#;
/// Response to an HTTP request.
const NO_PAGES: &str = "HTTP/1.1 400 Bad Request\r\ncontent-type: text/plain\r\nconnection: close\r\n\r\n\
                        This port takes no HTTP. A mind says first: raconteur 1 TOKEN\n";
/// Response to a mind if all slots are taken.
const FULL: &str = r#"{"kind":"failed","code":"serve::full","message":"all places are taken; try again later"}
"#;
/// Ping that requests a line from a silent mind; an empty one suffices.
const PING: &str = "{\"kind\":\"ping\"}\n";
/// The message to a mind that did not answer.
const IDLE: &str = r#"{"kind":"failed","code":"serve::idle","message":"no data arrived for too long; an empty line answers a ping"}
"#;

/// Serves one connection until it ends.
pub(crate) fn serve(stream: TcpStream, door: &ConnectionSender) -> io::Result<()> {
    let stay = door.lobby.enter(&stream)?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let mut wire = DeadlineStream::new(stream, PATIENCE);
    let refusal = match greet(&mut wire, door) {
        Ok(()) => None,
        Err(RejectReason::Silent(error)) => return Err(error),
        Err(RejectReason::Notified(why)) => Some(why),
    };
    // A rejected connection never occupies a slot.
    let place = refusal.is_none().then(|| door.place()).flatten();
    if let Some(why) = refusal.or(place.is_none().then_some(FULL)) {
        wire.write_all(why.as_bytes())?;
        wire.farewell();
        return Ok(());
    }
    drop(stay);
    wire.settle(TURN)?;
    let ended = match door.enter() {
        Ok(link) => talk(&mut wire, link, door),
        Err(Disconnected) => Ok(()),
    };
    drop(place);
    ended
}

/// Reason for rejecting a connection.
enum RejectReason {
    /// Rejected with a message to the peer.
    Notified(&'static str),
    /// Rejected without a message: the peer is gone or timed out.
    Silent(io::Error),
}

/// Reads the greeting, byte by byte so that nothing after it is consumed.
fn greet(wire: &mut DeadlineStream, door: &ConnectionSender) -> Result<(), RejectReason> {
    let mut bytes = Vec::new();
    let mut byte = [0];
    loop {
        match wire.read(&mut byte) {
            Ok(0) => return Err(RejectReason::Silent(ErrorKind::UnexpectedEof.into())),
            Ok(_) => bytes.push(byte[0]),
            Err(e) if e.kind() == ErrorKind::Interrupted => continue,
            Err(e) if would_block(&e) => return Err(RejectReason::Notified(REFUSED)),
            Err(e) => return Err(RejectReason::Silent(e)),
        }
        match greeting::read(&bytes) {
            Greeting::Begun => {}
            Greeting::Token(token) if door.opens(token) => return Ok(()),
            Greeting::Token(_) | Greeting::Other => return Err(RejectReason::Notified(REFUSED)),
            Greeting::Http => return Err(RejectReason::Notified(NO_PAGES)),
        }
    }
}

fn talk(wire: &mut DeadlineStream, mut link: MindLink, door: &ConnectionSender) -> io::Result<()> {
    let mut framer = Framer::new(limits::FRAGMENT_BYTES);
    let mut read: VecDeque<String> = VecDeque::new();
    let mut bytes = [0; 4096];
    let mut ended = false;
    let mut pulse = Heartbeat::new(door.idle, Instant::now());
    loop {
        loop {
            match link.line() {
                Ok(Some(line)) => wire.write_all(format!("{line}\n").as_bytes())?,
                Ok(None) => break,
                Err(Disconnected) => return Ok(()),
            }
        }
        match link.is_free() {
            Err(Disconnected) => return Ok(()),
            Ok(false) => {
                // Not to be read is not to be silent.
                pulse.record_activity(Instant::now());
                std::thread::sleep(TURN);
                continue;
            }
            Ok(true) => match read.pop_front() {
                Some(fragment) => {
                    if link.forward(fragment).is_err() {
                        return Ok(());
                    }
                    continue;
                }
                None if ended => return Ok(()),
                None => match wire.read(&mut bytes) {
                    Ok(0) => {
                        ended = true;
                        read.extend(framer.finish());
                    }
                    Ok(n) => {
                        pulse.record_activity(Instant::now());
                        read.extend(framer.push(&bytes[..n]));
                    }
                    Err(e) if would_block(&e) => {}
                    Err(e) => return Err(e),
                },
            },
        }
        match pulse.beat(Instant::now()) {
            HeartbeatAction::Steady => {}
            HeartbeatAction::Ask => wire.write_all(PING.as_bytes())?,
            HeartbeatAction::Dead => return wire.write_all(IDLE.as_bytes()),
        }
    }
}

/// Returns true if a read had no data yet and did not fail.
pub(crate) fn would_block(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
    )
}

//! Minds that connect by WebSocket: one fragment per incoming message, one JSON object per outgoing
//! message.

use std::net::TcpStream;
use std::time::Instant;

use raconteur_player::live::limits;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::server::{Request, Response};
use tungstenite::http::{HeaderMap, Response as HttpResponse, StatusCode};
use tungstenite::protocol::frame::coding::CloseCode;
use tungstenite::protocol::{CloseFrame, WebSocketConfig};
use tungstenite::{Bytes, Error, Message, Utf8Bytes, WebSocket, accept_hdr_with_config};

use super::heartbeat::{Heartbeat, HeartbeatAction};
use super::mind::{ConnectionSender, Disconnected, MindLink, PATIENCE, TURN};
use super::pending::DeadlineStream;
use super::tcp::would_block;

/// A longer message ends the connection; those between are refused one by one.
const MAX_MESSAGE_LENGTH: usize = 4 * limits::FRAGMENT_BYTES;

/// Serves one connection until it ends.
pub(crate) fn serve(stream: TcpStream, door: &ConnectionSender) -> Result<(), Error> {
    let stay = door.lobby.enter(&stream)?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let config = WebSocketConfig::default()
        .max_message_size(Some(MAX_MESSAGE_LENGTH))
        .max_frame_size(Some(MAX_MESSAGE_LENGTH));
    #[allow(
        clippy::result_large_err,
        reason = "the library asks for this kind of answer"
    )]
    let greet = |request: &Request, response: Response| match admit(request, door) {
        Ok(()) => Ok(response),
        Err(why) => {
            let mut refusal = HttpResponse::new(Some(why.to_owned()));
            *refusal.status_mut() = StatusCode::FORBIDDEN;
            Err(refusal)
        }
    };
    let wire = DeadlineStream::new(stream, PATIENCE);
    // Rejected clients have received their response.
    let Ok(mut socket) = accept_hdr_with_config(wire, greet, Some(config)) else {
        return Ok(());
    };
    socket.get_mut().settle(TURN)?;
    let place = door.place();
    let ended = if place.is_none() {
        Err(End::with(CloseCode::Again, "all places are taken"))
    } else {
        drop(stay);
        let link = door.enter().map_err(End::from);
        link.and_then(|link| talk(&mut socket, link, door))
    };
    let Err(End::Closed(code, why)) = ended else {
        return Ok(());
    };
    let frame = CloseFrame {
        code,
        reason: Utf8Bytes::from_static(why),
    };
    socket.close(Some(frame))?;
    drop(place);
    socket.into_inner().farewell();
    Ok(())
}

/// End of a conversation.
enum End {
    /// Close frame with a reason.
    Closed(CloseCode, &'static str),
    /// The mind has left.
    Left,
}

impl End {
    fn with(code: CloseCode, why: &'static str) -> Self {
        Self::Closed(code, why)
    }
}

impl From<Disconnected> for End {
    fn from(_: Disconnected) -> Self {
        Self::with(CloseCode::Away, "the performance is over")
    }
}

impl From<Error> for End {
    fn from(error: Error) -> Self {
        match error {
            Error::Capacity(_) => Self::with(CloseCode::Size, "the message is too long"),
            Error::Utf8(_) => Self::with(CloseCode::Invalid, "the text is not UTF-8"),
            Error::Protocol(ProtocolError::ResetWithoutClosingHandshake) => Self::Left,
            Error::Protocol(_) => Self::with(CloseCode::Protocol, "this is not a WebSocket"),
            _ => Self::Left,
        }
    }
}

fn talk(
    socket: &mut WebSocket<DeadlineStream>,
    mut link: MindLink,
    door: &ConnectionSender,
) -> Result<(), End> {
    let mut pulse = Heartbeat::new(door.idle, Instant::now());
    loop {
        while let Some(line) = link.line()? {
            socket.write(Message::text(&*line))?;
        }
        socket.flush()?;
        if !link.is_free()? {
            // Not to be read is not to be silent.
            pulse.record_activity(Instant::now());
            std::thread::sleep(TURN);
            continue;
        }
        match socket.read() {
            Ok(message) => {
                pulse.record_activity(Instant::now());
                match message {
                    Message::Text(text) => link.forward(text.to_string())?,
                    Message::Binary(bytes) => {
                        link.forward(String::from_utf8_lossy(&bytes).into_owned())?;
                    }
                    // The library has answered.
                    _ => {}
                }
            }
            Err(Error::Io(e)) if would_block(&e) => {}
            Err(error) => return Err(error.into()),
        }
        match pulse.beat(Instant::now()) {
            HeartbeatAction::Steady => {}
            HeartbeatAction::Ask => socket.write(Message::Ping(Bytes::new()))?,
            HeartbeatAction::Dead => return Err(End::with(CloseCode::Away, "no answer to pings")),
        }
    }
}

/// Admits a request, or returns the reason for rejection. Browsers let any page connect to any
/// address, including loopback, but send its origin: without the token only local pages and
/// programs may connect, and only if the entry point is not guarded.
fn admit(request: &Request, door: &ConnectionSender) -> Result<(), &'static str> {
    let headers = request.headers();
    let in_query = request
        .uri()
        .query()
        .and_then(|q| q.split('&').find_map(|pair| pair.strip_prefix("token=")));
    let in_header = header(headers, "authorization").and_then(|a| a.strip_prefix("Bearer "));
    match (in_header.or(in_query), header(headers, "origin")) {
        (Some(token), _) if door.opens(token) => Ok(()),
        (None, origin) if !door.guarded && origin.is_none_or(is_local) => Ok(()),
        _ => Err("the token is missing or wrong: ?token=… or Authorization: Bearer …"),
    }
}

fn header<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    headers.get(name)?.to_str().ok()
}

/// Returns true if a page's origin is this machine.
fn is_local(origin: &str) -> bool {
    let host = origin.split_once("://").map_or("", |(_, rest)| rest);
    let host = match host.strip_prefix('[') {
        Some(v6) => v6.split(']').next().unwrap_or_default(),
        None => host.split(':').next().unwrap_or_default(),
    };
    host == "localhost"
        || host
            .parse()
            .is_ok_and(|ip: std::net::IpAddr| ip.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_pages_of_this_machine_are_local() {
        for origin in [
            "http://localhost:4173",
            "https://127.0.0.1",
            "http://[::1]:80",
        ] {
            assert!(is_local(origin), "{origin}");
        }
        for origin in [
            "https://evil.example",
            "null",
            "http://localhost.evil.example",
            "http://127.0.0.1.nip.io",
        ] {
            assert!(!is_local(origin), "{origin}");
        }
    }
}

//! Minds that connect by WebSocket: a fragment a message in, a JSON object a message out.

use std::net::TcpStream;

use raconteur_player::live::limits;
use tungstenite::handshake::server::{Request, Response};
use tungstenite::http::{HeaderMap, Response as HttpResponse, StatusCode};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, accept_hdr_with_config};

use super::mind::{Door, Gone, PATIENCE, TURN};
use super::tcp::waits;

/// A longer message ends the connection; those between are refused one by one.
const LONGEST_MESSAGE: usize = 4 * limits::FRAGMENT_BYTES;

/// Serves one connection until it ends.
pub(crate) fn serve(stream: TcpStream, door: &Door) -> Result<(), Error> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let config = WebSocketConfig::default()
        .max_message_size(Some(LONGEST_MESSAGE))
        .max_frame_size(Some(LONGEST_MESSAGE));
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
    // Those who are refused have had their answer.
    let Ok(mut socket) = accept_hdr_with_config(stream, greet, Some(config)) else {
        return Ok(());
    };
    socket.get_ref().set_read_timeout(Some(TURN))?;
    let Ok(mut link) = door.enter() else {
        return Ok(());
    };
    loop {
        loop {
            match link.line() {
                Ok(Some(line)) => socket.write(Message::text(&*line))?,
                Ok(None) => break,
                Err(Gone) => return Ok(()),
            }
        }
        socket.flush()?;
        match link.is_free() {
            Err(Gone) => return Ok(()),
            Ok(false) => std::thread::sleep(TURN),
            Ok(true) => match socket.read() {
                Ok(Message::Text(text)) => {
                    if link.give(text.to_string()).is_err() {
                        return Ok(());
                    }
                }
                Ok(Message::Binary(bytes)) => {
                    let text = String::from_utf8_lossy(&bytes).into_owned();
                    if link.give(text).is_err() {
                        return Ok(());
                    }
                }
                Ok(_) => {}
                Err(Error::Io(e)) if waits(&e) => {}
                Err(Error::ConnectionClosed) => return Ok(()),
                Err(error) => return Err(error),
            },
        }
    }
}

/// Whether a request may come in, or why not. Browsers let any page connect to any address,
/// the loopback one included, but say which page: without a token only local pages may.
fn admit(request: &Request, door: &Door) -> Result<(), &'static str> {
    let headers = request.headers();
    if door.token.is_none() {
        return match header(headers, "origin") {
            Some(origin) if !is_local(origin) => {
                Err("pages of other hosts need a token: raconteur serve --token")
            }
            _ => Ok(()),
        };
    }
    let in_query = request
        .uri()
        .query()
        .and_then(|q| q.split('&').find_map(|pair| pair.strip_prefix("token=")));
    let in_header = header(headers, "authorization").and_then(|a| a.strip_prefix("Bearer "));
    match in_header.or(in_query) {
        Some(token) if door.opens(token) => Ok(()),
        _ => Err("the token is missing or wrong: ?token=… or Authorization: Bearer …"),
    }
}

fn header<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    headers.get(name)?.to_str().ok()
}

/// Whether a page's origin is this machine.
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

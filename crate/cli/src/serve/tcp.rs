//! Minds that connect by plain TCP: fragments in, JSON lines out.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::net::TcpStream;
use std::time::Instant;

use raconteur_player::live::limits;

use super::framing::Framer;
use super::mind::{Door, Gone, Link, PATIENCE, TURN};

/// The longest token line, bytes.
const LONGEST_TOKEN: usize = 1024;
/// What a wrong token is answered.
const REFUSED: &str =
    r#"{"kind":"failed","code":"serve::token","message":"the first line must be the token"}"#;

/// Serves one connection until it ends.
pub(crate) fn serve(stream: &TcpStream, door: &Door) -> io::Result<()> {
    stream.set_read_timeout(Some(TURN))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let mut wire = stream;
    if door.token.is_some() {
        let token = first_line(stream)?;
        if !token.is_some_and(|t| door.opens(&t)) {
            return writeln!(wire, "{REFUSED}");
        }
    }
    let Ok(link) = door.enter() else {
        return Ok(());
    };
    talk(stream, link)
}

fn talk(mut stream: &TcpStream, mut link: Link) -> io::Result<()> {
    let mut framer = Framer::new(limits::FRAGMENT_BYTES);
    let mut read: VecDeque<String> = VecDeque::new();
    let mut bytes = [0; 4096];
    let mut ended = false;
    loop {
        loop {
            match link.line() {
                Ok(Some(line)) => stream.write_all(format!("{line}\n").as_bytes())?,
                Ok(None) => break,
                Err(Gone) => return Ok(()),
            }
        }
        match link.is_free() {
            Err(Gone) => return Ok(()),
            Ok(false) => std::thread::sleep(TURN),
            Ok(true) => match read.pop_front() {
                Some(fragment) => {
                    if link.give(fragment).is_err() {
                        return Ok(());
                    }
                }
                None if ended => return Ok(()),
                None => match stream.read(&mut bytes) {
                    Ok(0) => {
                        ended = true;
                        read.extend(framer.finish());
                    }
                    Ok(n) => read.extend(framer.push(&bytes[..n])),
                    Err(e) if waits(&e) => {}
                    Err(e) => return Err(e),
                },
            },
        }
    }
}

/// The first line, read byte by byte so that nothing after it is taken; none when it is too
/// long or does not come.
fn first_line(mut stream: &TcpStream) -> io::Result<Option<String>> {
    let since = Instant::now();
    let mut line = Vec::new();
    let mut byte = [0];
    while line.len() < LONGEST_TOKEN && since.elapsed() < PATIENCE {
        match stream.read(&mut byte) {
            Ok(0) => return Ok(None),
            Ok(_) if byte == *b"\n" => {
                let line = String::from_utf8_lossy(&line);
                return Ok(Some(line.trim_end_matches('\r').to_owned()));
            }
            Ok(_) => line.push(byte[0]),
            Err(e) if waits(&e) => {}
            Err(e) => return Err(e),
        }
    }
    Ok(None)
}

/// Whether a read found nothing yet, rather than failed.
pub(crate) fn waits(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
    )
}

//! As much of HTTP as asking a speech server on the local network needs: one POST, one
//! reply, with limits of time and size.

use std::io::{Read as _, Write as _};
use std::net::{TcpStream, ToSocketAddrs as _};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, bail, ensure};

/// Longest wait to be let in.
const CONNECT: Duration = Duration::from_secs(5);

/// Longest wait for a reply.
const LIMIT: Duration = Duration::from_secs(120);

/// Most bytes of a reply.
const MOST_BYTES: usize = 256 << 20;

/// Most bytes before its body.
const MOST_HEADER: usize = 64 << 10;

/// Is this `host:port`, and nothing that could be more than that in a request?
pub(super) fn is_address(address: &str) -> bool {
    address.rsplit_once(':').is_some_and(|(host, port)| {
        !host.is_empty()
            && host
                .bytes()
                .all(|b| b.is_ascii_alphanumeric() || b"-._[]:".contains(&b))
            && port.parse::<u16>().is_ok()
    })
}

/// Posts a form to a path and returns the body of the reply.
///
/// # Errors
/// When no server answers, nothing comes within two minutes, more than 256 MiB come, or the
/// server does not answer with 200.
pub(super) fn post(address: &str, path: &str, form: &[(&str, &str)]) -> Result<Vec<u8>> {
    let told = || format!("asking the server {address}");
    let target = address
        .to_socket_addrs()
        .with_context(told)?
        .next()
        .with_context(told)?;
    let mut stream = TcpStream::connect_timeout(&target, CONNECT).with_context(told)?;
    stream.set_write_timeout(Some(LIMIT))?;
    let body = form
        .iter()
        .map(|(key, value)| format!("{}={}", escaped(key), escaped(value)))
        .collect::<Vec<_>>()
        .join("&");
    // Of version 1.0, so that the reply comes in one piece and ends with the connection.
    let request = format!(
        "POST {path} HTTP/1.0\r\nHost: {address}\r\nContent-Type: application/x-www-form-urlencoded; charset=UTF-8\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{body}",
        body.len()
    );
    stream.write_all(request.as_bytes()).with_context(told)?;
    let begun = Instant::now();
    let mut reply = Vec::new();
    let mut piece = vec![0; 64 << 10];
    loop {
        let left = LIMIT.saturating_sub(begun.elapsed());
        ensure!(
            !left.is_zero(),
            "the server {address} did not end its reply"
        );
        stream.set_read_timeout(Some(left))?;
        let count = stream.read(&mut piece).with_context(told)?;
        if count == 0 {
            break;
        }
        reply.extend_from_slice(&piece[..count]);
        ensure!(
            reply.len() <= MOST_BYTES,
            "the server {address} sends more than {MOST_BYTES} bytes"
        );
    }
    body_of(reply).with_context(told)
}

/// The body of a reply.
fn body_of(mut reply: Vec<u8>) -> Result<Vec<u8>> {
    let end = reply[..reply.len().min(MOST_HEADER)]
        .windows(4)
        .position(|w| w == b"\r\n\r\n")
        .context("its reply is not of HTTP")?;
    let header = String::from_utf8_lossy(&reply[..end]).into_owned();
    let body = reply.split_off(end + 4);
    let mut lines = header.lines();
    let status = lines
        .next()
        .filter(|l| l.starts_with("HTTP/1."))
        .and_then(|l| l.split_whitespace().nth(1))
        .context("its reply is not of HTTP")?;
    if status != "200" {
        let said: String = String::from_utf8_lossy(&body).chars().take(300).collect();
        bail!("it answered {status}: {said}");
    }
    for line in lines {
        let Some((name, value)) = line.split_once(':') else {
            continue;
        };
        if name.eq_ignore_ascii_case("content-length") {
            let length: usize = value.trim().parse().context("the length of its reply")?;
            ensure!(
                body.len() == length,
                "its reply ends after {} of {length} bytes",
                body.len()
            );
        }
        ensure!(
            !name.eq_ignore_ascii_case("transfer-encoding"),
            "its reply comes in pieces, which was not asked for"
        );
    }
    Ok(body)
}

/// Percent encoding of a value.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for b in text.bytes() {
        if b.is_ascii_alphanumeric() || b"-._~".contains(&b) {
            out.push(char::from(b));
        } else {
            out.push_str(&format!("%{b:02X}"));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replies_are_read_whole_or_not_at_all() {
        let body = |reply: &[u8]| body_of(reply.to_vec()).ok();
        assert_eq!(body(b"HTTP/1.1 200 OK\r\n\r\nab").unwrap(), b"ab");
        let with_length = b"HTTP/1.0 200 OK\r\ncontent-length: 2\r\n\r\nab";
        assert_eq!(body(with_length).unwrap(), b"ab");
        for bad in [
            &b""[..],
            b"hello",
            b"HTTP/1.1 500 No\r\n\r\nwhat",
            b"HTTP/1.1 200 OK\r\nContent-Length: 3\r\n\r\nab",
            b"HTTP/1.1 200 OK\r\nContent-Length: x\r\n\r\nab",
            b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n2",
        ] {
            assert!(body(bad).is_none(), "{}", String::from_utf8_lossy(bad));
        }
    }

    #[test]
    fn nothing_but_an_address_is_one_and_values_stay_values() {
        for (address, fine) in [
            ("localhost:59125", true),
            ("[::1]:59125", true),
            ("localhost", false),
            (":80", false),
            ("a b:80", false),
            ("a\r\nX: y:80", false),
            ("a:99999", false),
        ] {
            assert_eq!(is_address(address), fine, "{address}");
        }
        assert_eq!(escaped("a b&c=\u{e9}\r\n"), "a%20b%26c%3D%C3%A9%0D%0A");
    }
}

//! Requests to a speech server on the local network: one POST, one reply, with limits of time and
//! size.

use std::time::Duration;

use anyhow::{Context as _, Result, anyhow};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use ureq::Agent;

/// Connection timeout.
const CONNECT: Duration = Duration::from_secs(5);

/// Longest wait for a reply.
const LIMIT: Duration = Duration::from_secs(120);

/// Maximum size of a reply, bytes.
const MAX_BYTES: u64 = 256 << 20;

/// Maximum size of a reply's header, bytes.
const MAX_HEADER: usize = 64 << 10;

/// Characters that are percent-encoded in a value: all but the unreserved characters (RFC 3986,
/// section 2.3).
const CODED: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~');

/// Posts a form to a path and returns the body of the reply.
///
/// # Errors
/// Returns an error if no server answers, no data arrives within two minutes, more than 256 MiB
/// arrive, or the server's status is not 200.
pub(super) fn post(address: &str, path: &str, form: &[(&str, &str)]) -> Result<Vec<u8>> {
    let told = || format!("asking the server {address}");
    let agent: Agent = Agent::config_builder()
        .timeout_connect(Some(CONNECT))
        .timeout_global(Some(LIMIT))
        .max_response_header_size(MAX_HEADER)
        .max_redirects(0)
        .max_redirects_will_error(false)
        .http_status_as_error(false)
        // No proxy is needed between this machine and its network.
        .proxy(None)
        .build()
        .into();
    let body = form
        .iter()
        .map(|(key, value)| format!("{}={}", escaped(key), escaped(value)))
        .collect::<Vec<_>>()
        .join("&");
    let mut reply = agent
        .post(format!("http://{address}{path}"))
        .content_type("application/x-www-form-urlencoded; charset=UTF-8")
        .send(body)
        .with_context(told)?;
    let status = reply.status();
    let body = reply
        .body_mut()
        .with_config()
        .limit(MAX_BYTES)
        .read_to_vec()
        .with_context(told)?;
    if status != 200 {
        let said: String = String::from_utf8_lossy(&body).chars().take(300).collect();
        return Err(anyhow!("it answered {}: {said}", status.as_u16())).with_context(told);
    }
    Ok(body)
}

/// Returns a value with percent encoding.
fn escaped(text: &str) -> String {
    utf8_percent_encode(text, CODED).to_string()
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};
    use std::net::TcpListener;
    use std::thread;

    use super::*;

    /// Returns the body read from a server that always gives this response.
    fn body(reply: &'static [u8]) -> Result<Vec<u8>> {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let server = thread::spawn(move || {
            let (mut stream, _) = listener.accept().unwrap();
            let mut asked = Vec::new();
            let mut piece = [0; 1024];
            while !asked.ends_with(b"a=b") {
                let count = stream.read(&mut piece).unwrap();
                asked.extend_from_slice(&piece[..count]);
            }
            stream.write_all(reply).unwrap();
        });
        let body = post(&address, "/", &[("a", "b")]);
        server.join().unwrap();
        body
    }

    #[test]
    fn replies_are_read_whole_or_not_at_all() {
        assert_eq!(body(b"HTTP/1.1 200 OK\r\n\r\nab").unwrap(), b"ab");
        let with_length = b"HTTP/1.0 200 OK\r\ncontent-length: 2\r\n\r\nab";
        assert_eq!(body(with_length).unwrap(), b"ab");
        for bad in [
            &b""[..],
            b"hello",
            b"HTTP/1.1 500 No\r\n\r\nwhat",
            b"HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:1/\r\n\r\nwhat",
            b"HTTP/1.1 200 OK\r\nContent-Length: 3\r\n\r\nab",
            b"HTTP/1.1 200 OK\r\nContent-Length: x\r\n\r\nab",
            b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n2",
        ] {
            assert!(body(bad).is_err(), "{}", String::from_utf8_lossy(bad));
        }
    }

    #[test]
    fn values_stay_values() {
        assert_eq!(escaped("a b&c=\u{e9}\r\n"), "a%20b%26c%3D%C3%A9%0D%0A");
    }
}

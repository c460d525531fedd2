//! A running server for a test, and minds that connect to it.

use std::io::{BufRead as _, BufReader, ErrorKind, Write as _};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tungstenite::client::IntoClientRequest as _;
use tungstenite::{Message, WebSocket};

/// Timeout longer than anything on the slowest machine.
pub(crate) const LONG: Duration = Duration::from_secs(60);

pub(crate) fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_raconteur"));
    command
        .arg("serve")
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// A server that ends with its test.
pub(crate) struct Server {
    pub(crate) child: Child,
    /// Reported listening addresses, in order.
    pub(crate) addresses: Vec<String>,
    /// Reported greeting for a mind by TCP, including the end of the line.
    pub(crate) greeting: String,
}

impl Server {
    /// Starts a server with this number of transports.
    pub(crate) fn start(arguments: &[&str], ways: usize) -> Self {
        let mut child = command(arguments).spawn().expect("the program runs");
        let stderr = child.stderr.take().expect("standard error");
        let mut lines = BufReader::new(stderr).lines();
        let mut addresses = Vec::new();
        let mut greeting = String::new();
        let by_tcp = arguments.contains(&"--tcp");
        while addresses.len() < ways || (by_tcp && greeting.is_empty()) {
            let line = lines.next().expect("an address").expect("text");
            if let Some((_, first)) = line.split_once("its first line is: ") {
                greeting = format!("{first}\n");
            }
            let Some((_, at)) = line.split_once(" at ") else {
                continue;
            };
            let at = at.trim_start_matches("ws://").trim_end_matches('/');
            addresses.push(at.to_owned());
        }
        // A reader must consume the rest of the output.
        std::thread::spawn(move || lines.count());
        Self {
            child,
            addresses,
            greeting,
        }
    }

    /// Connects an admitted mind by TCP.
    pub(crate) fn mind(&self) -> Tcp {
        let address = self.addresses.last().expect("an address");
        let mut mind = Tcp::connect(address);
        mind.send(&self.greeting);
        mind
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A mind by TCP.
pub(crate) struct Tcp {
    pub(crate) stream: TcpStream,
    pub(crate) lines: BufReader<TcpStream>,
}

impl Tcp {
    pub(crate) fn connect(address: &str) -> Self {
        let stream = TcpStream::connect(address).expect("a connection");
        stream.set_read_timeout(Some(LONG)).expect("a timeout");
        stream.set_write_timeout(Some(LONG)).expect("a timeout");
        let lines = BufReader::new(stream.try_clone().expect("a second handle"));
        Self { stream, lines }
    }

    pub(crate) fn send(&mut self, text: &str) {
        self.stream.write_all(text.as_bytes()).expect("sent");
    }

    /// Returns the next line; `None` if the connection has ended.
    pub(crate) fn next(&mut self) -> Option<Value> {
        let mut line = String::new();
        match self.lines.read_line(&mut line) {
            Ok(0) => None,
            Ok(_) => Some(serde_json::from_str(&line).unwrap_or_else(|e| panic!("{e}: {line}"))),
            Err(e) if e.kind() == ErrorKind::ConnectionReset => None,
            Err(e) => panic!("{e}"),
        }
    }

    /// Returns the next line that satisfies a predicate.
    pub(crate) fn until(&mut self, holds: impl Fn(&Value) -> bool) -> Value {
        let since = Instant::now();
        while since.elapsed() < LONG {
            let line = self.next().expect("the connection is open");
            if holds(&line) {
                return line;
            }
        }
        panic!("it did not come");
    }
}

pub(crate) fn is(line: &Value, kind: &str) -> bool {
    line["kind"] == kind
}

pub(crate) fn websocket(
    url: &str,
    header: Option<(&'static str, &str)>,
) -> Result<WebSocket<TcpStream>, u16> {
    let mut request = url.into_client_request().expect("a request");
    if let Some((name, value)) = header {
        let value = value.parse().expect("a header");
        request.headers_mut().insert(name, value);
    }
    let host = request.uri().authority().expect("a host").to_string();
    let stream = TcpStream::connect(host).expect("a connection");
    stream.set_read_timeout(Some(LONG)).expect("a timeout");
    match tungstenite::client(request, stream) {
        Ok((socket, _)) => Ok(socket),
        Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(response))) => {
            Err(response.status().as_u16())
        }
        Err(error) => panic!("{error}"),
    }
}

pub(crate) fn receive(socket: &mut WebSocket<TcpStream>) -> Value {
    loop {
        if let Message::Text(text) = socket.read().expect("a message") {
            return serde_json::from_str(&text).expect("JSON");
        }
    }
}

/// Returns the close code of a WebSocket.
pub(crate) fn closing(socket: &mut WebSocket<TcpStream>) -> Option<u16> {
    loop {
        match socket.read() {
            Ok(Message::Close(frame)) => return frame.map(|f| f.code.into()),
            Ok(_) => {}
            Err(e) => panic!("{e}"),
        }
    }
}

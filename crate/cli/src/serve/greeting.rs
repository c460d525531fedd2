//! First line of a TCP mind: `raconteur 1 TOKEN`.
//!
//! Any web page can make a browser send bytes to any port of this machine, for example the body of
//! a form, and cannot read the reply. It cannot make them begin with this line: a browser's bytes
//! begin with its own, and no page knows the token.

/// Start of the line: program and protocol version.
const OPENING: &str = "raconteur 1 ";
/// The longest line, bytes.
const MAX_GREETING_BYTES: usize = 1024;
/// Prefixes of HTTP requests.
const METHODS: [&str; 10] = [
    "GET ", "HEAD ", "POST ", "PUT ", "DELETE ", "CONNECT ", "OPTIONS ", "TRACE ", "PATCH ", "PRI ",
];

/// Classification of the bytes that a TCP connection has sent before its greeting is complete.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Greeting<'a> {
    /// Possible prefix of the greeting line.
    Begun,
    /// The line, with this token.
    Token(&'a str),
    /// A request of HTTP.
    Http,
    /// Any other data.
    Other,
}

/// Returns the greeting line for a token, without line end.
pub(crate) fn line(token: &str) -> String {
    format!("{OPENING}{token}")
}

/// Classifies the received bytes, none of which is after the end of the line.
pub(crate) fn read(bytes: &[u8]) -> Greeting<'_> {
    let alike = |whole: &str| bytes.iter().zip(whole.as_bytes()).all(|(a, b)| a == b);
    if !alike(OPENING) {
        let method = METHODS.into_iter().find(|method| alike(method));
        return match method {
            Some(method) if bytes.len() >= method.len() => Greeting::Http,
            // It can only become a request; it is refused when it is known to be one.
            Some(_) => Greeting::Begun,
            None => Greeting::Other,
        };
    }
    match bytes.strip_suffix(b"\n") {
        Some(line) => {
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            let token = line
                .get(OPENING.len()..)
                .and_then(|t| str::from_utf8(t).ok());
            token.map_or(Greeting::Other, Greeting::Token)
        }
        None if bytes.len() >= MAX_GREETING_BYTES => Greeting::Other,
        None => Greeting::Begun,
    }
}

/// Checks the invariants for any bytes: they are classified within a bounded length, and a token is
/// the rest of one line.
///
/// # Panics
/// Panics if an invariant does not hold.
pub fn assert_valid(bytes: &[u8]) {
    for n in 0..=bytes.len().min(MAX_GREETING_BYTES) {
        match read(&bytes[..n]) {
            Greeting::Begun => assert!(
                n < MAX_GREETING_BYTES,
                "an incomplete greeting is below its size limit"
            ),
            Greeting::Token(token) => {
                assert!(
                    bytes.starts_with(line(token).as_bytes()),
                    "the greeting starts with its line"
                );
                return;
            }
            Greeting::Http | Greeting::Other => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns the classification of a stream read byte by byte, and the number of bytes needed.
    fn found(stream: &[u8]) -> Option<(Greeting<'_>, usize)> {
        (1..=stream.len()).find_map(|n| match read(&stream[..n]) {
            Greeting::Begun => None,
            greeting => Some((greeting, n)),
        })
    }

    #[test]
    fn only_the_line_is_a_greeting() {
        let told = |stream: &'static str| found(stream.as_bytes()).map(|(greeting, _)| greeting);
        assert_eq!(
            told("raconteur 1 abc\n<null/>"),
            Some(Greeting::Token("abc"))
        );
        assert_eq!(told("raconteur 1 abc\r\n"), Some(Greeting::Token("abc")));
        assert_eq!(told("raconteur 1 \n"), Some(Greeting::Token("")));
        assert_eq!(told("raconteur 1 abc"), None);
        for other in [
            "raconteur 2 abc\n",
            "raconteur\n",
            "abc\n",
            "\n",
            "<null/>\n",
            "\u{16}\u{3}\u{1}",
        ] {
            assert_eq!(told(other), Some(Greeting::Other), "{other:?}");
        }
        assert_eq!(told("POST / HTTP/1.1\r\n"), Some(Greeting::Http));
        let long = format!("raconteur 1 {}", "x".repeat(MAX_GREETING_BYTES));
        assert_eq!(
            found(long.as_bytes()),
            Some((Greeting::Other, MAX_GREETING_BYTES))
        );
    }

    proptest! {
        #[test]
        fn requests_are_known_by_their_method(method in 0..METHODS.len(), rest in "[ -~\r\n]{0,200}") {
            let request = format!("{}{rest}", METHODS[method]);
            prop_assert_eq!(
                found(request.as_bytes()),
                Some((Greeting::Http, METHODS[method].len()))
            );
        }

        #[test]
        fn every_stream_is_decided_in_bounded_bytes(
            stream in prop::collection::vec(any::<u8>(), MAX_GREETING_BYTES..MAX_GREETING_BYTES + 8)
        ) {
            prop_assert!(found(&stream).is_some());
        }
    }
}
